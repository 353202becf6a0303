"""The special motions: each with its numbers, a sentence with them, and what to do.

Their dyads are a whole family or none at all, known without a fit; a fit would give one member
of the family, or invent one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

SIGNIFICANT_DIGITS = 6  # of the motion's size, in messages


class MotionKindBase:
    """The base of all kinds: a stable code, a name, a sentence with numbers, and what to do."""

    __slots__ = ()
    code: ClassVar[str]
    name: ClassVar[str]

    @property
    def message(self) -> str:
        """What the motion is, in one sentence."""
        raise NotImplementedError

    @property
    def help(self) -> str:
        """What to do about it; it works when followed literally."""
        raise NotImplementedError

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        """The dyads that are certain without a fit; some of each family of them."""
        return ()


@final
@dataclass(frozen=True, slots=True, eq=False)
class StraightTranslation(MotionKindBase):
    """The body keeps `angle` and moves along a line in `direction` (in F, [0, pi)), radians."""

    code: ClassVar[str] = "R312"
    name: ClassVar[str] = "translation along a line"
    angle: float
    direction: float

    @property
    def message(self) -> str:
        return (
            f"the body never turns (its angle stays {in_degrees(self.angle)}) and moves along a "
            f"straight line at {in_degrees(self.direction)}: pivots cannot be determined, and one "
            "slider does this"
        )

    @property
    def help(self) -> str:
        return (
            f"guide the body by one slider along the direction {in_degrees(self.direction)}; for a "
            "four-bar give poses whose angles differ"
        )

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        return (PP(np.array(self.angle)),)


@final
@dataclass(frozen=True, slots=True, eq=False)
class CircularTranslation(MotionKindBase):
    """The body keeps `angle` (radians) and its origin runs on a circle: a parallelogram's coupler.

    centre: (2,) in F, of the circle of M's origin; radius: of every point's circle.
    chord: the distance between the two pivots of the parallelogram in `dyads`.
    toward: from the centre to the middle of the arc, radians.
    """

    code: ClassVar[str] = "R313"
    name: ClassVar[str] = "translation along a circular arc"
    angle: float
    centre: FloatArray
    radius: float
    chord: float
    toward: float
    unit: str | None = None

    @property
    def message(self) -> str:
        size = self.radius + self.chord
        return (
            f"the body never turns (its angle stays {in_degrees(self.angle)}) and every point of "
            "it runs on a circle of radius "
            f"{rounded_length(self.radius, size, self.unit)}, its origin about "
            f"{_point(self.centre, size, self.unit)}: a parallelogram linkage does this, and its "
            "pivots may be anywhere"
        )

    @property
    def help(self) -> str:
        first, second = self._links()
        size = self.radius + self.chord
        pairs = " and ".join(
            f"from {_point(link.fixed_pivot, size)} to {_point(link.moving_pivot, size)} of the "
            "body"
            for link in (first, second)
        )
        return (
            f"take two links of {rounded_length(self.radius, size, self.unit)}, {pairs}, or shift "
            "both ends of a link alike; for another four-bar give poses whose angles differ"
        )

    def link(self, moving_pivot: ArrayLike) -> RR:
        """The one RR dyad with each moving pivot (*, 2) of M; any two make a parallelogram."""
        m = np.asarray(moving_pivot, dtype=np.float64)
        turn = Displacement(self.centre, np.array(self.angle))
        return RR(turn.act(m), m, np.full(m.shape[:-1], self.radius))

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        """Two links of a parallelogram, square to its coupler at mid-arc, and the PP dyad."""
        return (*self._links(), PP(np.array(self.angle)))

    def _links(self) -> tuple[RR, RR]:
        across = self.toward + np.pi / 2 - self.angle
        half = self.chord / 2 * np.array([np.cos(across), np.sin(across)])
        return self.link(half), self.link(-half)


@final
@dataclass(frozen=True, slots=True, eq=False)
class FreeTranslation(MotionKindBase):
    """The body keeps `angle` (radians); its points run on a curve that is no line and no circle."""

    code: ClassVar[str] = "R314"
    name: ClassVar[str] = "translation along a curve"
    angle: float

    @property
    def message(self) -> str:
        return (
            f"the body never turns (its angle stays {in_degrees(self.angle)}): every point of it "
            "traces the same curve, so pivots cannot be determined; the curve is neither a line "
            "nor a circular arc, so no parallelogram fits"
        )

    @property
    def help(self) -> str:
        return (
            "guide the body by two sliders, one on the other; for a four-bar give poses whose "
            "angles differ"
        )

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        return (PP(np.array(self.angle)),)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Rotation(MotionKindBase):
    """The body turns about one point: `fixed_centre` (2,) of F, `moving_centre` (2,) of M.

    uncertainty: of the centre, by the errors of the poses; a length.
    scatter: the greatest distance of a pose from the turn, where the poses differ from it by noise
        that their errors do not explain; else 0.
    odd: a pose (number from 0) that is no part of that scatter, and its distance from the turn.
    """

    code: ClassVar[str] = "R315"
    name: ClassVar[str] = "rotation about one point"
    fixed_centre: FloatArray
    moving_centre: FloatArray
    uncertainty: float
    size: float
    scatter: float = 0.0
    odd: tuple[int, float] | None = None
    unit: str | None = None

    @property
    def message(self) -> str:
        about = within = scatter = ""
        if self.scatter:
            within = f" within {self.scatter:.2g}{_unit(self.unit)} at every pose"
            if self.odd is not None:
                off = f"{self.odd[1]:.2g}{_unit(self.unit)}"
                within += f" but pose {self.odd[0] + 1}, which is {off} off"
            scatter = "; the rest scatters from pose to pose, and no linkage follows that"
        elif self.uncertainty > 10.0**-SIGNIFICANT_DIGITS * self.size:
            about = f" (within {self.uncertainty:.1g}{_unit(self.unit)}, as the digits go)"
        return (
            f"the body turns about the point {_point(self.fixed_centre, self._digits, self.unit)}"
            f"{about}: one pin joint does this{within}, you do not need four bars{scatter}"
        )

    @property
    def _digits(self) -> float:
        """The size whose digits are printed: those below a tenth of the uncertainty are noise."""
        if not self.uncertainty > 10.0**-SIGNIFICANT_DIGITS * self.size:
            return self.size
        return max(self.size, 10.0 ** (SIGNIFICANT_DIGITS - 2) * self.uncertainty)

    @property
    def help(self) -> str:
        check = f"correct pose {self.odd[0] + 1} or leave it out, and " if self.odd else ""
        meant = ", or mark one pose as exact if the scatter is meant" if self.scatter else ""
        return (
            f"{check}pin the body at its point {_point(self.moving_centre, self._digits)} to the "
            f"ground at {_point(self.fixed_centre, self._digits)}; for a four-bar give two poses "
            f"or more that do not turn about this point{meant}"
        )


@final
@dataclass(frozen=True, slots=True, eq=False)
class TwoSliders(MotionKindBase):
    """A circle of points of M, each on a line of F: Cardan's motion.  Or the inverse of it.

    In complex numbers the pose is d = c + b exp(-i angle) - R m: M's centre m runs backwards on
    the circle |b| about F's centre c as M turns.  The points of M at the
    distance |b| from m stay on lines through c, a pencil of PR dyads; one RR dyad joins c and
    m.  There is no other dyad.  The inverse motion exchanges F and M: lines fixed in M, RP.

    inverse: whether the lines are fixed in M (and all pass through `moving_centre`) or in F.
    fixed_centre (2,) in F, moving_centre (2,) in M, radius |b|, phase the angle of b;
    middle, rotation: of the least arc of all angles, its middle and its length.  Radians.
    within_digits: whether more digits could show another motion.
    scatter: the greatest distance of a pose from the motion, where the poses differ from it by
        noise that their errors do not explain; else 0.
    """

    code: ClassVar[str] = "R316"
    name: ClassVar[str] = "two-slider motion"
    inverse: bool
    fixed_centre: FloatArray
    moving_centre: FloatArray
    radius: float
    phase: float
    middle: float
    rotation: float
    within_digits: bool = False
    scatter: float = 0.0
    unit: str | None = None

    @property
    def message(self) -> str:
        on, of = ("ground", "body") if self.inverse else ("body", "ground")
        own, other = self.fixed_centre, self.moving_centre
        if not self.inverse:
            own, other = other, own
        within = "within the digits given, " if self.within_digits else ""
        if self.scatter:
            within = (
                f"within {self.scatter:.2g}{_unit(self.unit)}, which scatter from pose to pose, "
            )
        return (
            f"{within}a two-slider motion{' (inverted)' if self.inverse else ''}: "
            f"every point of the {on} on the circle of radius "
            f"{rounded_length(self.radius, self.radius, self.unit)} about its point "
            f"{_point(own, self.radius)} stays on a straight line of the {of} through "
            f"{_point(other, self.radius)}; so the sliders are a whole family, with one crank "
            "that joins the two centres"
        )

    @property
    def help(self) -> str:
        other = "for another four-bar give a pose off this motion"
        if self.within_digits and not self.scatter:
            other = "for another four-bar give more digits, or a pose off this motion"
        if not self.inverse and self.rotation >= np.pi:
            return (
                "no slider of the family drives the body through half a turn without a dead point: "
                f"let it turn less; {other}"
            )
        return (
            "take the two sliders offered, which are square to each other: no pair of the family "
            f"transmits better; or the crank and the second of them; {other}"
        )

    def slider(self, place: ArrayLike) -> PR | RP:
        """The slider whose pivot is at the angle `place` (*,) of its circle, in its own frame."""
        psi = np.asarray(place, dtype=np.float64)
        on = np.stack([np.cos(psi), np.sin(psi)], axis=-1) * self.radius
        normal = (psi + self.phase + np.pi) / 2
        n = np.stack([np.cos(normal), np.sin(normal)], axis=-1)
        if self.inverse:
            return RP(self.fixed_centre + on, normal, n @ self.moving_centre)
        return PR(normal, n @ self.fixed_centre, self.moving_centre + on)

    @property
    def crank(self) -> RR:
        """The one RR dyad."""
        return RR(self.fixed_centre, self.moving_centre, np.array(self.radius))

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        """Two sliders square to each other, the first in mid-stroke at `middle`; and the crank.

        No pair transmits better.  PR: the instant centre is a point of the circle, and runs round
        it by twice the rotation.  A driving slider sees the coupler and the normal of any other
        line at the inscribed angle over the arc to that centre.  So the transmission angle is the
        driver's alone: 90 deg in mid-stroke, less by as much as the body has turned from there.
        The same holds for the crank that drives a slider, at the end of its stroke at `middle`.
        RP: the angle is that between both slots, the same at every place: 90 deg if square.

        The second slider is opposite on the circle, as forces square to each other hold best.
        """
        along = self.phase + 2 * self.middle * (1 if self.inverse else -1)
        return self.slider(along + np.pi), self.slider(along), self.crank


# --- numbers for people


def _unit(unit: str | None) -> str:
    return f" {unit}" if unit else ""


def _rounded(value: float, size: float, digits: int = SIGNIFICANT_DIGITS) -> str:
    """A length to `digits` digits of `size`, so that rounding does not show as 1e-17."""
    step = 10.0 ** (np.floor(np.log10(size)) + 1 - digits) if size > 0 else 1.0
    snapped = round(float(value) / step) * step
    wanted = int(np.log10(abs(snapped) / step)) + 1 if snapped else digits
    return f"{snapped + 0.0:.{min(max(digits, wanted), 15)}g}"


def rounded_length(
    value: float, size: float, unit: str | None = None, digits: int = SIGNIFICANT_DIGITS
) -> str:
    return _rounded(value, size, digits) + _unit(unit)


def _point(value: FloatArray, size: float, unit: str | None = None) -> str:
    return f"({_rounded(value[0], size)}, {_rounded(value[1], size)}){_unit(unit)}"


def in_degrees(angle: float) -> str:
    return f"{_rounded(float(np.degrees(angle)), 10.0)} deg"
