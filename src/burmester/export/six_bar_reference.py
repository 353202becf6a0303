"""The six-bar that its files are compared with: its joints at the poses, in a unit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self, final

import numpy as np

from burmester.export.options import MILLIMETRES, Options, unit_of
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.skeleton import Joints, Skeleton

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["SixBarReference", "plates_of"]


def plates_of(skeleton: Skeleton) -> dict[str, str]:
    """The name of the plate of each link; that of a link "body" is no frame M."""
    return {
        link: "body-link" if link == "body" else link.replace(" ", "-") for link in skeleton.links
    }


@final
@dataclass(frozen=True, slots=True, eq=False)
class SixBarReference:
    """A six-bar in a unit of length.

    found: in that unit.  at: its joints (N, 2) at the poses.
    places: (N,), of the body; poses: (N,), of the task.
    span: diagonal of the box around all joints; scale: of this unit per unit of the task.
    """

    found: FoundSixBar
    at: Joints
    places: Displacement
    poses: Displacement
    span: float
    scale: float

    @classmethod
    def of(cls, chosen: FoundSixBar, options: Options, unit: str = "mm") -> Self:
        """The six-bar in a unit; raises E162."""
        scale = MILLIMETRES[unit_of(chosen, options)] / MILLIMETRES[unit]
        found, poses = chosen.scaled(scale), chosen.task.poses
        at = found.joints(found.drive)
        places = found.body(found.drive)
        points = np.concatenate([places.translation, *at.values()])
        span = math.hypot(*np.ptp(points, axis=0).tolist())
        wanted = Displacement(poses.translation * scale, poses.angle)
        return cls(found, at, places, wanted, span, scale)

    @property
    def plates(self) -> dict[str, str]:
        """The joints of each plate, by its name."""
        skeleton = self.found.skeleton
        return {plate: skeleton.links[link] for link, plate in plates_of(skeleton).items()}
