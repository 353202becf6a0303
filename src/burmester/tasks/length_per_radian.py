"""What an error of the angle counts as: the length of one radian.

An angle error moves a point of the body by its distance from the origin of M.  Averaged over the
body that is its radius of gyration, where its outline is known.  Where it is not, a share of the
body's travel per radian of its turn stands for it: a body that swings about a far point is as a
rule smaller than the way to that point.
"""

from __future__ import annotations

import numpy as np

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray, shares
from burmester.tasks.motion_task import Task

# Of the travel per radian; bodies between a tenth and six tenths of it lose least by this share
# (`python -m benchmarks.angle_weight`).
TRAVEL_SHARE = 1 / 3


def default_length_per_radian(task: Task) -> float:
    """The length, in the task's unit, that counts as much as one radian of angle error.

    The radius of gyration of the body's outline about the origin of M; without an outline a
    third of the travel per radian, at most the span of the poses.  The travel per radian is the
    spread of the origins of M over the spread of the body's directions: for a pure turn the
    distance from its centre.  It scales with the unit, and depends on the frames as position
    errors do: not on F, and on M by its origin.  The order of the poses does not matter.
    """
    if task.body is not None:
        return _radius_of_gyration(task.body)
    return float(lengths_per_radian(task.poses, task.weights))


def lengths_per_radian(poses: Displacement, weights: FloatArray | None = None) -> FloatArray:
    """The same of tasks (*,) without an outline, with poses (*, N)."""
    share = shares(weights, poses.shape)
    d, turn = poses.translation, np.exp(1j * poses.angle)
    middle = (share[..., None] * d).sum(axis=-2, keepdims=True)
    spread = np.sqrt((share * ((d - middle) ** 2).sum(axis=-1)).sum(axis=-1))
    mean = (share * turn).sum(axis=-1, keepdims=True)
    swing = np.sqrt((share * np.abs(turn - mean) ** 2).sum(axis=-1))
    span = np.linalg.norm(np.ptp(d, axis=-2), axis=-1)
    moves = span > 0
    least = TRAVEL_SHARE * spread / np.where(moves, span, 1.0)
    share_of_travel = TRAVEL_SHARE * spread / np.maximum(swing, np.where(moves, least, 1.0))
    return np.where(moves, share_of_travel, CanonicalFrames.of(poses, weights)[0].length)


def _radius_of_gyration(polygon: Polygon) -> float:
    """That of the polygon's inside, about the origin of its frame."""
    a = polygon.vertices
    b = np.roll(a, -1, axis=0)
    cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]  # twice the triangles with the origin
    square = ((a * a) + (a * b) + (b * b)).sum(axis=-1)
    return float(np.sqrt((cross @ square) / cross.sum() / 6))
