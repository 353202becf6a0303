"""Poses and what may be off at them as plain data; it loads no more than a reader of tasks does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.tasks.crank_timing import CrankTiming
from burmester.tasks.pose_tolerances import COMPONENTS, PoseTolerances


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


def crank_data(poses: Sequence[dict[str, Any]], timing: CrankTiming) -> dict[str, Any]:
    """Put the angles of the crank into poses, and the key `crank` that says how they are meant."""
    for pose, angle in zip(poses, timing.angles.tolist(), strict=True):
        if math.isfinite(angle):
            pose["crank_deg"] = degrees_of(angle)
    meant: dict[str, Any] = {"absolute": True} if timing.absolute else {}
    if timing.within is not None:
        meant["within_deg"] = degrees_of(timing.within)
    return {"crank": meant} if meant else {}


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
