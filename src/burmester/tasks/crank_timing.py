"""Poses timed by the crank: the angle of the driver at them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, median, wrapped_angle
from burmester.values import real_numbers

USUAL_SHARE: Final = 0.05  # of the range of crank angles; what they may be missed by, if unstated
SAME_ANGLE: Final = 1e-9  # radians; angles that differ by less are the same


@final
@dataclass(frozen=True, slots=True, eq=False)
class CrankTiming:
    """The angles of the driving link at N poses.

    Attributes
    ----------
    angles : (N,) array
        Of the link from its fixed to its moving pivot, counterclockwise, in radians; nan at a pose
        that is not timed.  All of them may be shifted by one angle, unless they are `absolute`.
    absolute : bool
        Whether the angles are directions in F, and not rotations from the first timed pose.
    within : float, optional
        How far each angle may be missed, in radians; by default a twentieth of their range.

    Angles count but for whole turns.  Where one of them is negative, or more than a turn from the
    first, and they only rise or only fall, they also say in which sense the driver turns.

    Raises
    ------
    InputError
        E186 (no row of numbers, too few of them, a bound that is not above zero).

    Examples
    --------
    >>> import numpy as np
    >>> timing = CrankTiming(np.radians([0, np.nan, 342.3, 324.8]))
    >>> timing.timed.tolist()
    [0, 2, 3]
    >>> np.degrees(timing.turns).round(1).tolist()
    [0.0, 342.3, 324.8]
    >>> timing.sense, CrankTiming(np.radians([0, -17.7, -35.2])).sense
    (0, -1)
    """

    angles: FloatArray
    absolute: bool = False
    within: float | None = None

    def __post_init__(self) -> None:
        angles = real_numbers(self.angles, (None,), "the crank angles", code="E186", finite=False)
        if np.isinf(angles).any():
            raise InputError(
                "E186",
                "the crank angles are no angles",
                why="each is a number, or nan at a pose that is not timed",
                help="give the angle of the crank at each pose, or leave the crank angles out",
            )
        if (known := int(np.isfinite(angles).sum())) < self._least:
            few = "give the crank angle at two poses or more, or leave the crank angles out"
            raise InputError(
                "E186",
                f"{known} crank angle{'' if known == 1 else 's'}: too few to say anything",
                why=None if self.absolute else "the angles count from the first of them",
                help=few
                if self.absolute or not known
                else Help.of(
                    "{}; or say that it is a direction on the ground, with {}",
                    few,
                    Cure("absolute", True, "--absolute-crank"),
                ),
            )
        if self.within is not None and not 0 < self.within < math.inf:
            raise InputError(
                "E186",
                f"a crank angle within {math.degrees(self.within):g}° is impossible",
                help="give an angle above zero, or leave it out",
            )
        object.__setattr__(self, "angles", angles)

    @property
    def _least(self) -> int:
        """How many angles say anything."""
        return 1 if self.absolute else 2

    @property
    def timed(self) -> NDArray[np.intp]:
        """The numbers of the poses that are timed."""
        return np.flatnonzero(np.isfinite(self.angles))

    @property
    def turns(self) -> FloatArray:
        """The angles (T,) at the timed poses, from the first one on unless they are absolute."""
        known = self.angles[self.timed]
        return known if self.absolute else np.asarray(known - known[0])

    @property
    def sense(self) -> int:
        """1 or -1 where the angles say in which sense the driver turns, else 0."""
        known = self.angles[self.timed]
        steps, far = np.diff(known), known - known[0]
        if not len(steps) or ((far >= 0) & (far <= 2 * math.pi + SAME_ANGLE)).all():
            return 0
        return 1 if (steps > 0).all() else -1 if (steps < 0).all() else 0

    @property
    def conditions(self) -> int:
        """How many equations the angles are for a dyad, beside those of its poses."""
        return len(self.timed) - (not self.absolute)

    @property
    def bound(self) -> float:
        """How far an angle may be missed, in radians."""
        if self.within is not None:
            return self.within
        steps = np.abs(wrapped_angle(self.turns[:, None] - self.turns))
        return USUAL_SHARE * max(float(steps.max()), math.radians(1.0))

    def at(self, index: NDArray[np.intp]) -> CrankTiming | None:
        """The same at some poses; None where it says nothing of them."""
        return self._with(self.angles[index])

    def merged(self, group: NDArray[np.intp]) -> CrankTiming | None:
        """The same with repeated poses once; group: (N,), which of the distinct ones each is."""
        angles = np.full(int(group.max()) + 1, np.nan)
        for k in self.timed[::-1].tolist():
            angles[group[k]] = self.angles[k]
        return self._with(angles)

    def _with(self, angles: FloatArray) -> CrankTiming | None:
        enough = int(np.isfinite(angles).sum()) >= self._least
        return replace(self, angles=angles) if enough else None

    def missed(self, inputs: ArrayLike) -> FloatArray:
        """How far driver angles (*, N) are from those stated (*, N), signed; nan where untimed.

        The one angle by which all of those may be shifted is the median of the gaps, so that one
        wrong angle stands out.  Along a stated sense whole turns count.
        """
        gap = np.asarray(inputs, dtype=np.float64) - self.angles
        index = self.timed
        known = gap[..., index]
        if not self.sense:
            known = wrapped_angle(known - (0.0 if self.absolute else known[..., :1]))
        elif self.absolute:
            known = known - 2 * math.pi * np.round(known[..., :1] / (2 * math.pi))
        if not self.absolute:
            known = known - median(known, axis=-1)
        out = np.full(gap.shape, np.nan)
        out[..., index] = known
        return out

    def require_fitting(self, poses: Displacement) -> None:
        """Refuse angles of another number of poses, and such that no crank can have: E186."""
        if self.angles.shape != poses.shape:
            raise InputError(
                "E186",
                f"crank angles of {len(self.angles)} poses, and {poses.shape[0]} poses",
                help="give a crank angle for every pose, nan where there is none",
            )
        index = self.timed
        turns, turned = self.turns, np.exp(1j * poses.angle[index])
        same = np.abs(wrapped_angle(turns[:, None] - turns)) <= SAME_ANGLE
        at = poses.translation[index]
        reach = SAME_ANGLE * max(float(np.abs(at).max()), float(np.ptp(at, axis=0).max()))
        moved = np.abs(at[:, None] - at).max(axis=-1) > reach
        moved |= np.abs(turned[:, None] - turned) > SAME_ANGLE
        for clash, message, why in (
            (
                same & moved,
                "the crank has the same angle at pose {} and pose {}, and the body has moved",
                "a crank that stands where it stood has its linkage where it was",
            ),
            (
                ~same & ~moved,
                "pose {} and pose {} are the same, and the crank has turned",
                "a body that is where it was has its links where they were",
            ),
        ):
            if clash.any():
                one, other = (index[np.argwhere(clash)[0]] + 1).tolist()
                help = "correct one of the two crank angles, or leave it blank"
                raise InputError("E186", message.format(one, other), why=why, help=help)
