"""The reference that every file is compared with: a linkage's bodies and joints in a unit.

E160 the file does not contain the linkage        E163 a linkage that does not reach the poses
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.cures import Cure, Help
from burmester.errors import BurmesterError, InputError
from burmester.export.options import Options, unit_of
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import Bodies, LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.refinement.tolerance_boxes import poses_counted
from burmester.synthesis.result import Candidate
from burmester.tasks.length_units import MILLIMETRES
from burmester.verdicts.found_linkage import FoundLinkage

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

PRECISION = 1e-9  # of the span: the largest deviation of a file from the linkage


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
