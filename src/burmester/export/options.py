"""The options of an export, its unit of lengths, and the reference that files are compared with.

E162 dimensions that cannot be made
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.cures import Cure, Help
from burmester.errors import BurmesterError, InputError
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import Bodies, LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.refinement.tolerance_boxes import poses_counted
from burmester.synthesis.result import Candidate
from burmester.tasks.length_units import MILLIMETRES
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import in_unit

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

PRECISION = 1e-9  # of the span: the largest deviation of a file from the linkage


@final
@dataclass(frozen=True, slots=True)
class Options:
    """The options of an export; a dimension that is None is chosen from the linkage's size.

    Where the unit of lengths is known, it is a size that shops have: see `parts.stock`.

    Attributes
    ----------
    unit : str or None
        Unit of the task's lengths, where the task states none or px; mm where both are None.
    hole, width, thickness, gap, pin : float or None
        Diameter of holes, width of links, thickness of plates, gap between plates that lie on each
        other, diameter of pins; in the unit of the task's lengths.
    pose : int
        The pose at which the assembly is drawn, from 1.
    dimensions : bool
        Whether drawings have dimension lines.
    assembled : bool
        Whether the parts of an STL are in their places, not flat beside each other.
    density : float
        Of the material of all plates and pins, kg/m³, for models with masses; aluminium.
    up : str
        The direction of the ground frame that gravity points away from: x, y, z, -x, -y or -z.
    seconds, frames_per_second, width_px : float, float, int
        Duration, frame rate and width of moving pictures.
    """

    unit: str | None = None
    hole: float | None = None
    width: float | None = None
    thickness: float | None = None
    gap: float | None = None
    pin: float | None = None
    pose: int = 1
    dimensions: bool = True
    assembled: bool = False
    density: float = 2700.0
    up: str = "y"
    seconds: float = 4.0
    frames_per_second: float = 25.0
    width_px: int = 800


def unit_cure(unit: str | None = None) -> Cure:
    """What states a unit of lengths."""
    named = f"the option unit {unit}" if unit else "the option unit"
    return Cure("unit", unit, "--length-unit", words=named)


def unit_of(chosen: Candidate, options: Options) -> str:
    """The unit of the linkage's lengths, a key of `MILLIMETRES`; raises E162.

    Lengths that the task states in another unit, such as px, count as one of the unit that the
    options state.
    """
    known = ", ".join(MILLIMETRES)
    own, stated = chosen.unit, options.unit
    if stated is not None and stated not in MILLIMETRES:
        raise InputError(
            "E162",
            f"there is no unit {stated!r}",
            why=f"the units are {known}",
            help=Help.of("give {}", unit_cure("mm")),
        )
    if own in MILLIMETRES and stated is not None and own != stated:
        raise InputError(
            "E162",
            f"the lengths of this linkage are{in_unit(own)}, not{in_unit(stated)}",
            why="the poses state that unit",
            help=Help.of("leave {} out", unit_cure()),
        )
    if stated is None and own is not None and own not in MILLIMETRES:
        raise InputError(
            "E162",
            f"how long one {own} is has to be known for this format",
            why=f"the lengths of this linkage are{in_unit(own)}, and the units are {known}",
            help=Help(f"say what one {own} counts as: ", unit_cure("mm")),
        )
    return own if own is not None and own in MILLIMETRES else stated or "mm"


def stated_unit(chosen: Candidate, options: Options) -> str | None:
    """The unit in which the task or the options say lengths are; None where nobody does.

    For formats that keep the task's lengths, which may be in px as well; raises E162.
    """
    if options.unit is None and chosen.unit in (None, "px"):
        return chosen.unit
    return unit_of(chosen, options)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Reference(Bodies):
    """A linkage in a unit of length.

    own: the same linkage in that unit.
    at_poses: where the bodies are for the poses (N,); poses: (N,) of the task.
    span: diagonal of the box around all joints; scale: of this unit per unit of the task.
    """

    own: Candidate
    at_poses: LinkPlaces
    poses: Displacement
    span: float
    scale: float

    @classmethod
    def of(cls, chosen: Candidate, options: Options, unit: str | None = "mm") -> Self:
        """The linkage in a unit, None for the task's own; raises E162, and E163 without places."""
        scale = 1.0
        if unit is not None:
            scale = MILLIMETRES[unit_of(chosen, options)] / MILLIMETRES[unit]
        require_places(chosen)
        poses, own = poses_counted(chosen.error.places, chosen.task), chosen.scaled(scale)
        bodies, at_poses = own.bodies, own.at_poses()
        return cls(
            **{each.name: getattr(bodies, each.name) for each in fields(bodies)},
            own=own,
            at_poses=at_poses,
            poses=Displacement(poses.translation * scale, poses.angle),
            span=_diagonal([own.error.places.translation, *bodies.pins(at_poses)]),
            scale=scale,
        )

    @property
    def found(self) -> FoundSixBar | None:
        """Its dimensions in that unit, unless it is a four-bar."""
        return None if isinstance(self.own, FoundLinkage) else self.own

    @property
    def places(self) -> Displacement:
        """Where the body is for the poses (N,)."""
        return self.at_poses[self.body]

    def closure_error(self, places: LinkPlaces) -> float:
        """The largest misfit of a joint where the bodies are, in the unit of lengths."""
        worst = 0.0
        for joint in self.joints:
            pin = places[joint.holder].act(joint.holes[joint.holder])
            if joint.slot is not None:
                pin = places[joint.slot.link].inverse().act(pin)
                off = np.abs(pin @ joint.slot.directions[0] - joint.slot.offset)
            else:
                other = joint.links[1] if joint.links[0] == joint.holder else joint.links[0]
                off = np.linalg.norm(places[other].act(joint.holes[other]) - pin, axis=-1)
            worst = max(worst, float(off.max()))
        return worst


def _diagonal(points: list[FloatArray]) -> float:
    return math.hypot(*np.ptp(np.concatenate(points), axis=0).tolist())


def require_places(chosen: Candidate) -> None:
    """Raise E163 where the linkage cannot be put together near some pose."""
    places = chosen.error.places
    missing = ~(np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1))
    if missing.any():
        raise InputError(
            "E163",
            f"linkage {chosen.id} has no place for pose {missing.argmax() + 1}",
            why="its links cannot be put together near that pose",
            help=Help.of("choose another linkage, one that is usable, with {}", Cure("linkage")),
        )


def require_equal(what: str, got: ArrayLike, expected: ArrayLike, tolerance: float) -> None:
    """Raise E160 where numbers read from a file are not those of the linkage."""
    one, two = np.asarray(got, dtype=np.float64), np.asarray(expected, dtype=np.float64)
    if one.shape != two.shape:
        off: float | str = f"{one.shape} numbers where {two.shape} belong"
    else:
        gap = float(np.abs(one - two).max()) if one.size else 0.0
        if gap <= tolerance:
            return
        off = f"off by {gap:.3g}, more than {tolerance:.3g}"
    raise fault(f"{what}: {off}")


def fault(
    why: str, message: str = "the written file does not contain the linkage, so it was deleted"
) -> BurmesterError:
    """The error E160 of a file that is not what was to be written."""
    help = "this is a fault of burmester: report it, with the result file"
    return BurmesterError("E160", message, why=why, help=help)


def as_rows(places: Displacement) -> FloatArray:
    """Places (*,) as rows (*, 4): x, y, and the cosine and sine of their angles."""
    return np.concatenate(
        [places.translation, np.cos(places.angle)[..., None], np.sin(places.angle)[..., None]],
        axis=-1,
    )
