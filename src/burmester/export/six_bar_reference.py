"""The six-bar that its files are compared with: its joints at the poses, in a unit."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self, final

import numpy as np

from burmester.export.options import MILLIMETRES, Options, unit_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.watt import JOINTS, LINKS, WattLinkage

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["SIX_BAR_PLATES", "SixBarReference", "six_bar_scaled"]

# The joints of each link, by the name of its plate.
SIX_BAR_PLATES = {
    "body-link" if name == "body" else name.replace(" ", "-"): joints
    for name, joints in LINKS.items()
}


@final
@dataclass(frozen=True, slots=True, eq=False)
class SixBarReference:
    """A six-bar in a unit of length.

    found: in that unit.  joints: (N, 7, 2), at the poses, in the order of `JOINTS`.
    places: (N,), of the body; poses: (N,), of the task.
    span: diagonal of the box around all joints; scale: of this unit per unit of the task.
    """

    found: FoundSixBar
    joints: FloatArray
    places: Displacement
    poses: Displacement
    span: float
    scale: float

    @classmethod
    def of(cls, chosen: FoundSixBar, options: Options, unit: str = "mm") -> Self:
        """The six-bar in a unit; raises E162."""
        scale = MILLIMETRES[unit_of(chosen, options)] / MILLIMETRES[unit]
        found, poses = six_bar_scaled(chosen, scale), chosen.task.poses
        at = found.joints(found.drive)
        joints = np.stack([at[name] for name in JOINTS], axis=1)
        places = found.body(found.drive)
        points = np.concatenate([places.translation, joints.reshape(-1, 2)])
        span = math.hypot(*np.ptp(points, axis=0).tolist())
        wanted = Displacement(poses.translation * scale, poses.angle)
        return cls(found, joints, places, wanted, span, scale)


def six_bar_scaled(found: FoundSixBar, scale: float) -> FoundSixBar:
    """A six-bar in another unit of length, `scale` of them for one."""
    own = found.linkage
    linkage = WattLinkage(*(getattr(own, name) * scale for name in own.__match_args__))
    return replace(found, linkage=linkage, extent=found.extent * scale)
