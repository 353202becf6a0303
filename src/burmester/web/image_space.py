"""The image space of a linkage as plain data: both constraint manifolds in a box around the poses.

Everything is in the chart Z4 = 1, after F is moved amid the poses, M is turned to their middle
angle and lengths are measured in the motion's size: so no pose is near the plane at infinity if
the poses turn by less than half a turn to either side.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

MARGIN = 1.3  # size of the box, in sizes of what it holds
WIDEST = 2.0  # sizes of the poses' own box: the motion's curve widens it no further
STEEPEST = np.tan(np.radians(80))  # Z3 = tan(half the angle): a place beyond it is not shown
THIN = 0.15  # widest sides of the box: the least size of another side


def chart_of(poses: Displacement, length: float) -> dict[str, Any]:
    """Origin in F, angle of M (radians) and unit length, under which image points are taken."""
    angle = np.unwrap(poses.angle)
    origin = (poses.translation.min(axis=0) + poses.translation.max(axis=0)) / 2
    middle = float(angle.min() + angle.max()) / 2
    return {"origin": origin.tolist(), "angle": middle, "length": length}


def space_of(
    dyads: Linkage | None, poses: Displacement, places: Displacement | None, chart: dict[str, Any]
) -> dict[str, Any]:
    """The box, and the symmetric 4 x 4 matrices (row by row) of two dyads in its coordinates.

    The box is [-1, 1]³ in its own coordinates q, with (Z1, Z2, Z3) = centre + half * q; a matrix
    C holds its manifold as (q, 1) C (q, 1) = 0.
    places: (n,), along the coupler's motion, or None.
    """
    points = _points(poses, chart)
    points = points[np.abs(points[:, 2]) < STEEPEST]
    if not len(points):
        points = np.zeros((1, 3))
    low, high = points.min(axis=0), points.max(axis=0)
    size = np.maximum(high - low, THIN * (high - low).max())
    size = np.where(size > 0, size, 1.0)
    if places is not None and len(places.angle):
        curve = _points(places, chart)
        near = (np.abs(curve - (low + high) / 2) <= WIDEST * size / 2).all(axis=1)
        if near.any():
            low, high = np.minimum(low, curve[near].min(0)), np.maximum(high, curve[near].max(0))
    centre = (low + high) / 2
    half = MARGIN * np.maximum(high - low, THIN * (high - low).max()) / 2
    half = np.where(half > 0, half, 1.0)
    pair = () if dyads is None else (dyads.first, dyads.second)
    return {
        "centre": centre.tolist(),
        "half": half.tolist(),
        "quadrics": [_quadric(each, chart, centre, half).ravel().tolist() for each in pair],
    }


def _points(places: Displacement, chart: dict[str, Any]) -> FloatArray:
    """Points (n, 3) of the chart: (Z1, Z2, Z3) / Z4."""
    d = (places.translation - chart["origin"]) / chart["length"]
    with np.errstate(over="ignore", invalid="ignore"):
        z = Displacement(d, places.angle - chart["angle"]).as_image_point()
        return np.asarray(z[..., :3] / z[..., 3:])


def _quadric(dyad: Dyad, chart: dict[str, Any], centre: FloatArray, half: FloatArray) -> FloatArray:
    """The matrix (4, 4) of a dyad's manifold in the box, its greatest number 1."""
    origin, unit, turn = np.array(chart["origin"]), chart["length"], chart["angle"]
    if isinstance(dyad, RR):
        hand = _turned(dyad.moving_pivot, turn) / unit
        seen: Dyad = RR((dyad.fixed_pivot - origin) / unit, hand, dyad.radius / unit)
        c = constraint_manifold.matrix(seen.coefficients())
    elif isinstance(dyad, PR):
        normal = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
        hand = _turned(dyad.moving_pivot, turn) / unit
        seen = PR(dyad.normal_angle, (dyad.offset - normal @ origin) / unit, hand)
        c = constraint_manifold.matrix(seen.coefficients())
    elif isinstance(dyad, RP):
        pivot = (dyad.fixed_pivot - origin) / unit
        seen = RP(pivot, dyad.normal_angle + turn, dyad.offset / unit)
        c = constraint_manifold.matrix(seen.coefficients())
    else:
        # The coefficients of PP are those of a double plane, whose gradient vanishes on it.
        angle = (float(dyad.angle) - turn) / 2
        c = np.zeros((4, 4))
        c[2, 3] = c[3, 2] = np.cos(angle) / 2
        c[3, 3] = -np.sin(angle)
    to_chart = np.diag([*half, 1.0])
    to_chart[:3, 3] = centre
    c = to_chart.T @ c @ to_chart
    return np.asarray(c / np.abs(c).max())


def _turned(point: FloatArray, angle: float) -> FloatArray:
    return Displacement(np.zeros(2), np.array(angle)).act(point)
