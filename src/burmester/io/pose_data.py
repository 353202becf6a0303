"""Poses and what may be off at them as plain data; it loads no more than a reader of tasks does."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.tasks.pose_tolerances import COMPONENTS, PoseTolerances

__all__ = ["degrees_of", "poses_data", "tolerances_data"]


def poses_data(poses: Displacement) -> list[dict[str, float]]:
    """Poses (N,) as rows of a file; an angle given as 45.58 degrees is written as 45.58."""
    shown = map(degrees_of, poses.angle.tolist())
    rows = zip(poses.translation.tolist(), shown, strict=True)
    return [{"x": x, "y": y, "angle_deg": angle} for (x, y), angle in rows]


def degrees_of(angle: float) -> float:
    """Radians as degrees; what was given as 45.58 degrees is 45.58."""
    degrees = float(np.degrees(angle))
    short = float(f"{degrees:.15g}")
    return short if np.radians(short) == angle else degrees


def tolerances_data(tolerances: PoseTolerances) -> list[dict[str, Any]]:
    """The keys `tolerance` and `free` of each pose, as a file may hold them."""
    out: list[dict[str, Any]] = []
    for k, (x, y, angle) in enumerate(tolerances.bounds.tolist()):
        bounds = {"x": x, "y": y, "angle_deg": degrees_of(angle)}
        named = zip(COMPONENTS, bounds.values(), strict=True)
        free = [component for component, bound in named if math.isinf(bound)]
        tolerance: dict[str, Any] = {
            key: bound for key, bound in bounds.items() if math.isfinite(bound)
        }
        data = {"tolerance": tolerance | {"axes": tolerances.axes[k]}}
        out.append(data | ({"free": free} if free else {}))
    return out
