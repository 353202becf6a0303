"""The last step of a fit: true distances from a circle or a line, least squares or least worst.

A dyad is a vector z here, (c1, c2, m1, m2, r) or (normal angle, offset, m1, m2), that may move
along z + basis y.  Poses may be exact: there the distance stays zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.displacement import Displacement, FloatArray

__all__ = [
    "Distances",
    "Misses",
    "Polished",
    "circle_misses",
    "least_squares",
    "least_worst",
    "line_misses",
]


class Distances(NamedTuple):
    """Distances (N,), their derivatives (N, k) and second derivatives (N, k, k) by z."""

    miss: FloatArray
    slope: FloatArray
    bend: FloatArray


Misses: TypeAlias = Callable[[FloatArray], Distances]

TINY = 1e-300  # keeps 0 / 0 away from a pivot that meets its centre
STEPS, SHORTER, SETTLED = 40, 20, 1e-13
ROUNDS, EVERY = 400, 20  # of Lawson's weights; after so many, an attempt to finish
LEVEL = 1e-10  # relative: worst deviations this near to each other are equal


class Polished(NamedTuple):
    """Where it ended: z (k,), and `pull` (N,), the objective's derivatives by the distances.

    The objective's gradient is derivatives.T @ pull, exact poses included: there the pull is the
    multiplier.  settled: whether the steps came to an end.
    """

    z: FloatArray
    pull: FloatArray
    settled: bool


def circle_misses(poses: Displacement) -> Misses:
    """The distances of the moving pivot from its circle, over poses (N,)."""
    terms = circle_terms(poses)

    def misses(z: FloatArray) -> Distances:
        miss, slope, swing, size = terms(z)
        return Distances(miss, slope, swing[:, :, None] * swing[:, None, :] / size[:, None, None])

    return misses


def circle_terms(poses: Displacement) -> Callable[[FloatArray], tuple[FloatArray, ...]]:
    """What the distances of circles z (*, 5) over poses (N,) consist of.

    Distances (*, N), their derivatives (*, N, 5), and the vectors (*, N, 5) and sizes (*, N) of
    which the second derivatives are made: swing swingᵀ / size.
    """
    cos, sin = np.cos(poses.angle), np.sin(poses.angle)
    zero, one = np.zeros_like(cos), np.ones_like(cos)
    # Derivatives of the arm R m + d - c, whose length is the distance.
    arm1 = np.stack([-one, zero, cos, -sin, zero], axis=-1)
    arm2 = np.stack([zero, -one, sin, cos, zero], axis=-1)
    radius = np.array([0.0, 0.0, 0.0, 0.0, 1.0])

    def terms(z: FloatArray) -> tuple[FloatArray, ...]:
        arm = poses.act(z[..., None, 2:4]) - z[..., None, :2]
        size = np.maximum(np.hypot(arm[..., 0], arm[..., 1]), TINY)
        u1, u2 = np.moveaxis(arm / size[..., None], -1, 0)[..., None]
        return size - z[..., 4:], u1 * arm1 + u2 * arm2 - radius, u1 * arm2 - u2 * arm1, size

    return terms


def line_misses(poses: Displacement) -> Misses:
    """The distances of the moving pivot from its line, over poses (N,)."""
    cos, sin = np.cos(poses.angle), np.sin(poses.angle)

    def misses(z: FloatArray) -> Distances:
        n1, n2 = np.cos(z[0]), np.sin(z[0])
        point = poses.act(z[2:])
        reach, swing = n1 * point[:, 0] + n2 * point[:, 1], n1 * point[:, 1] - n2 * point[:, 0]
        turned = np.stack([cos * n1 + sin * n2, cos * n2 - sin * n1], axis=-1)
        ones = np.ones_like(cos)
        slope = np.concatenate([np.stack([swing, -ones], axis=-1), turned], axis=-1)
        bend = np.zeros((len(cos), 4, 4))
        bend[:, 0, 0] = -reach
        bend[:, 0, 2] = bend[:, 2, 0] = cos * -n2 + sin * n1
        bend[:, 0, 3] = bend[:, 3, 0] = cos * n1 + sin * n2
        return Distances(reach - z[1], slope, bend)

    return misses


def least_squares(  # noqa: PLR0917
    misses: Misses,
    z: FloatArray,
    basis: FloatArray,
    share: FloatArray,
    exact: NDArray[np.bool_],
    steps: int = STEPS,
) -> Polished:
    """The local minimum of the sum of share (N,) times squared distance, by Newton's method.

    Where the sum is not convex, Gauss and Newton's step is taken.  After every step the exact
    poses are met again; a step is shortened until it helps.
    """
    weight = np.where(exact, 0.0, share)
    z, settled = _restored(misses, z, basis, exact), False
    here = misses(z)
    for _ in range(steps):
        slope = here.slope @ basis
        free = _null_space(slope[exact])
        directions = basis @ free
        pull = weight * here.miss
        pull = pull + _multipliers(slope, pull, exact)
        downhill, reduced = directions.T @ (here.slope.T @ pull), here.slope @ directions
        flat = (weight[:, None] * reduced).T @ reduced
        curved = flat + directions.T @ np.tensordot(pull, here.bend, axes=1) @ directions
        step = -directions @ _downhill(curved, flat, downhill)
        before, factor = float(weight @ here.miss**2), 1.0
        for _ in range(SHORTER):
            to = _restored(misses, z + factor * step, basis, exact)
            there = misses(to)
            if float(weight @ there.miss**2) <= before * (1 + 1e-13):
                break
            factor /= 4
        else:
            settled = True
            break
        moved = np.abs(to - z).max(initial=0)
        z, here = to, there
        if moved < SETTLED * (1 + np.abs(z).max()):
            settled = True
            break
    pull = weight * here.miss
    return Polished(z, pull + _multipliers(here.slope @ basis, pull, exact), settled)


def _downhill(curved: FloatArray, flat: FloatArray, gradient: FloatArray) -> FloatArray:
    """The inverse of the Hessian times the gradient, or of its positive part."""
    if not len(gradient):
        return gradient
    for matrix in (curved, flat):
        values, vectors = np.linalg.eigh(matrix)
        if values[0] > 1e-9 * values[-1] or matrix is flat:
            break
    known = values > 1e-14 * max(values[-1], TINY)
    return np.asarray(vectors[:, known] @ ((gradient @ vectors[:, known]) / values[known]))


def least_worst(
    misses: Misses,
    z: FloatArray,
    basis: FloatArray,
    share: FloatArray,
    exact: NDArray[np.bool_],
) -> Polished:
    """A local minimum of the worst distance, counted by the root of share / mean share.

    Lawson's way: least squares with weights that grow where the distance is great; and once it is
    plain which poses are the worst, Newton's method on their distances being equal.
    """
    root = np.where(exact, 0.0, np.sqrt(share / share[~exact].mean()))
    weight = np.where(exact, 0.0, 1.0 / (~exact).sum())
    best, settled = least_squares(misses, z, basis, share, exact), False
    z = best.z
    for turn in range(ROUNDS):
        size = np.abs(root * misses(z).miss)
        if size.max() <= np.sqrt((weight * size**2).sum()) * (1 + LEVEL):
            settled = True
            break
        if turn % EVERY == EVERY - 1:
            level = _levelled(misses, z, basis, root, weight, exact)
            if level is not None:
                return level
        weight = weight * size
        weight = weight / weight.sum()
        z = least_squares(misses, z, basis, weight * root**2, exact, steps=4).z
    miss, slope, _ = misses(z)
    pull = weight * root**2 * miss
    return Polished(z, pull + _multipliers(slope @ basis, pull, exact), settled)


def _levelled(  # noqa: PLR0917
    misses: Misses,
    z: FloatArray,
    basis: FloatArray,
    root: FloatArray,
    weight: FloatArray,
    exact: NDArray[np.bool_],
) -> Polished | None:
    """Where as many worst distances as there are unknowns are equal, if that is a minimum."""
    count = basis.shape[1] - int(exact.sum()) + 1
    worst = np.argsort(-weight, kind="stable")[:count]
    held = np.flatnonzero(exact)
    if count < 1 or not (weight[worst] > 0).all():
        return None
    sign = np.sign(misses(z).miss[worst])
    level = float((root * np.abs(misses(z).miss)).max())
    for _ in range(12):
        miss, slope, _ = misses(z)
        slope = slope @ basis
        top = np.column_stack([(sign * root[worst])[:, None] * slope[worst], -np.ones(count)])
        below = np.column_stack([slope[held], np.zeros(len(held))])
        gap = np.concatenate([sign * root[worst] * miss[worst] - level, miss[held]])
        matrix = np.concatenate([top, below])
        step = -(np.linalg.pinv(matrix) @ gap)
        z, level = z + basis @ step[:-1], level + step[-1]
        if not np.isfinite(z).all() or np.abs(step).max() > 10:
            return None
    miss, slope, _ = misses(z)
    # The share of each in the gradient: together they pull in no direction.
    shares = np.linalg.svd(matrix.T)[2][-1] if len(held) + count > 1 else np.ones(1)
    right = np.zeros(matrix.shape[1])
    right[-1] = -1.0
    shares = np.linalg.lstsq(matrix.T, right, rcond=None)[0]
    met = np.abs(matrix.T @ shares - right).max() < 1e-8
    top_is_worst = (root * np.abs(miss)).max() <= level * (1 + 1e-9)
    if not (met and top_is_worst and (shares[:count] > -1e-9).all()):
        return None
    pull = np.zeros(len(miss))
    pull[worst] = shares[:count] * sign * root[worst]
    pull[held] = shares[count:]
    return Polished(z, pull, True)


def _restored(
    misses: Misses, z: FloatArray, basis: FloatArray, exact: NDArray[np.bool_]
) -> FloatArray:
    """Move z along the basis to where the exact poses are met, by Newton's method."""
    if not exact.any():
        return z
    for _ in range(8):
        miss, slope, _ = misses(z)
        step = basis @ (np.linalg.pinv(slope[exact] @ basis) @ miss[exact])
        z = z - step
        if np.abs(step).max(initial=0) < SETTLED * (1 + np.abs(z).max()):
            break
    return z


def _null_space(rows: FloatArray) -> FloatArray:
    """Orthonormal columns (d, d - k) that rows (k, d) do not see."""
    if not len(rows):
        return np.eye(rows.shape[1])
    _, values, v = np.linalg.svd(rows)
    rank = int((values > 1e-12 * max(values.max(initial=0), 1e-300)).sum())
    return np.asarray(v[rank:].T)


def _multipliers(slope: FloatArray, pull: FloatArray, exact: NDArray[np.bool_]) -> FloatArray:
    """The pull (N,) of the exact poses that holds against that of the others."""
    held = np.zeros(len(pull))
    if exact.any():
        held[exact] = -(np.linalg.pinv(slope[exact].T) @ (slope.T @ pull))
    return held
