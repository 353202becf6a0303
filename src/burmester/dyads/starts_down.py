"""Where ways down to the locally best circles start, for tasks (T,) at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.pencil import MIN_POSES, fit_pencil
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.tasks.repeated_poses import spanning

QUINTUPLES = 3  # of poses, at most; more found nothing new in a campaign

# Generic factors by which one of each pair of conjugate points is picked.
CONJUGATE_PICK = np.sqrt([2.0, 3.0, 5.0, 7.0])
START_LENGTH = 20.0  # characteristic lengths; the links that start along a line
ROUGH_DISTANCE = 0.1  # characteristic lengths, rms; from it on for the best start, more are made

Indices = NDArray[np.intp]


def starts_down(
    points: ComplexArray,
    lines: tuple[PR, RP],
    seen: Displacement,
    share: FloatArray,
    more: FloatArray | None = None,
) -> tuple[Indices, FloatArray]:
    """Circles (k, 5) from which ways lead down to the minima, and the tasks (k,) of them.

    points: (T, c, 4), the critical points of the squared residual; lines: (T,), the best sliders
    of each kind; seen, share: (T, N), poses in canonical frames and their shares; more: (T, p, 4),
    other pivots.
    """
    tasks = np.arange(len(points))
    side = points.imag @ CONJUGATE_PICK
    task, number = np.nonzero(side >= 0)  # one of each two conjugate points
    # With zeros, where the frames' origins stay close.
    parts = [points[task, number].real, np.zeros((len(tasks), 4))]
    owners = [task, tasks]
    if more is not None:
        parts.append(more.reshape(-1, 4))
        owners.append(np.repeat(tasks, more.shape[1]))
    task = np.concatenate(owners)
    circles, cost = _circles_about(np.concatenate(parts), task, seen, share)
    least = np.full(len(tasks), np.inf)
    np.minimum.at(least, task, cost)
    # Far from any circle the distance has minima of its own, and complex points lead to them.
    rough, number = np.nonzero((least > ROUGH_DISTANCE**2)[:, None] & (side > 0))
    beside = points[rough, number]
    pivots = np.concatenate([beside.real + beside.imag, beside.real - beside.imag])
    rough = np.tile(rough, 2)
    every, owners = [circles, _circles_about(pivots, rough, seen, share)[0]], [task, rough]
    on_ground, in_body = lines
    back = PR(in_body.normal_angle, in_body.offset, in_body.fixed_pivot)
    for line, motion, order in (
        (on_ground, seen, [0, 1, 2, 3]),
        (back, seen.inverse(), [2, 3, 0, 1]),
    ):
        for along in _pivots_along(line, motion):
            every.append(_circles_about(along[:, order], tasks, seen, share)[0])
            owners.append(tasks)
    return np.concatenate(owners), np.concatenate(every)


def _circles_about(
    pivots: FloatArray, task: Indices, seen: Displacement, share: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Circles (k, 5) with pivots (k, 4) and the best radius, and their mean squares (k,)."""
    centred = RR(pivots[:, :2], pivots[:, 2:], np.zeros(len(pivots)))
    distance = centred[:, None].residual(seen[task])
    radius = (distance * share[task]).sum(axis=1)
    cost = (share[task] * (distance - radius[:, None]) ** 2).sum(axis=1)
    return np.concatenate([pivots, radius[:, None]], axis=1), cost


def _pivots_along(line: PR, motion: Displacement) -> tuple[FloatArray, FloatArray]:
    """Pivots (T, 4) of long links that nearly follow lines (T,), one on either side of each."""
    n = np.stack([np.cos(line.normal_angle), np.sin(line.normal_angle)], axis=-1)
    foot = motion.act(line.moving_pivot[:, None]).mean(axis=1)
    foot = foot - ((foot * n).sum(axis=1) - line.offset)[:, None] * n
    first, second = (
        np.concatenate([foot + side * START_LENGTH * n, line.moving_pivot], axis=1)
        for side in (-1, 1)
    )
    return first, second


def pivots_of_fits(poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """Pivots (k, 4), c and m, of the pencil's dyads and of those through five of the poses (N,).

    The first five poses are those that span the most, the next five span the most of the rest.
    """
    found = []
    if poses.shape[0] >= MIN_POSES:
        found.append(fit_pencil(poses, weights).dyads)
    _, seen = CanonicalFrames.of(poses, weights)
    design = constraint_manifold.monomials(seen.as_image_point()) * constraint_manifold.INVARIANT
    rest = np.arange(poses.shape[0])
    for _ in range(min(QUINTUPLES, len(rest) // 5)):
        five = spanning(design[rest], 5)
        found.append(dyads_of_five(poses[rest[five]]).dyads)
        rest = np.delete(rest, five)
    pivots = np.concatenate([np.hstack([each.fixed_pivot, each.moving_pivot]) for each in found])
    return np.asarray(pivots[np.isfinite(pivots).all(axis=-1)])
