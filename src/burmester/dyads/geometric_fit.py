"""The last step of a fit: true distances from a circle or a line, least squares or least worst.

A dyad is a vector z here, (c1, c2, m1, m2, r) or (normal angle, offset, m1, m2), that may move
along z + basis y.  Poses may be exact: there the distance stays zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = [
    "SURE",
    "Distances",
    "Misses",
    "Polished",
    "circle_misses",
    "circle_terms",
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
NOTHING = 1e-100  # distances below this are none
STEPS, SHORTER, SETTLED = 40, 20, 1e-13
SURE = 1e-10  # share of the sum of squares; Newton's last steps gain less
PLAIN, HIGHEST = 32, 4096  # powers: from where it may be plain which are the worst; the last
FEW = 1e-3  # share of the pull on the worst, below which a pose is none of the worst
LEVEL = 1e-9  # relative: worst distances this near to each other are equal


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
        bend = swing[..., :, None] * swing[..., None, :] / size[..., None, None]
        return Distances(miss, slope, bend)

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
    return _least_powers(misses, z, basis, np.where(exact, 0.0, share), exact, 2, steps)


def _least_powers(  # noqa: PLR0917
    misses: Misses,
    z: FloatArray,
    basis: FloatArray,
    weight: FloatArray,
    exact: NDArray[np.bool_],
    power: int,
    steps: int,
) -> Polished:
    """The same for the sum of weight (N,) times some even power of the distance."""
    z, settled = _restored(misses, z, basis, exact), False
    here = misses(z)
    for _ in range(steps):
        slope = here.slope @ basis
        free = _null_space(slope[exact])
        if not free.shape[1]:  # the exact poses leave no way to go
            settled = True
            break
        directions = basis @ free
        top = float(np.abs(here.miss[weight > 0]).max(initial=NOTHING))
        lean = weight * np.minimum(np.abs(here.miss) / top, 1.0) ** (power - 2)
        pull = lean * here.miss
        pull = pull + _multipliers(slope, pull, exact)
        downhill, reduced = directions.T @ (here.slope.T @ pull), here.slope @ directions
        flat = ((power - 1) * lean[:, None] * reduced).T @ reduced
        curved = flat + directions.T @ np.tensordot(pull, here.bend, axes=1) @ directions
        along, convex = _downhill(curved, flat, downhill)
        step = -directions @ along
        before, factor = _sum(weight, here.miss / top, power), 1.0
        # Newton's last steps gain so little that the sum would tell by its rounding only.
        sure = convex and power == 2 and along @ downhill < SURE * before * top**2
        for _ in range(SHORTER):
            to = _restored(misses, z + factor * step, basis, exact)
            there = misses(to)
            if sure or _sum(weight, there.miss / top, power) <= before * (1 + 1e-13):
                break
            factor /= 4
        else:
            settled = True
            break
        moved = np.abs(to - z).max()
        z, here = to, there
        if moved < SETTLED * (1 + np.abs(z).max()):
            settled = True
            break
    top = float(np.abs(here.miss[weight > 0]).max(initial=NOTHING))
    pull = weight * np.minimum(np.abs(here.miss) / top, 1.0) ** (power - 2) * here.miss
    return Polished(z, pull + _multipliers(here.slope @ basis, pull, exact), settled)


def _sum(weight: FloatArray, miss: FloatArray, power: int) -> float:
    with np.errstate(over="ignore"):
        return float(weight[weight > 0] @ miss[weight > 0] ** power)


def _downhill(
    curved: FloatArray, flat: FloatArray, gradient: FloatArray
) -> tuple[FloatArray, bool]:
    """The inverse of the Hessian times the gradient, if that is convex, or of its positive part."""
    if not len(gradient):
        return gradient, True
    values, vectors = np.linalg.eigh(curved)
    convex = bool(values[0] > 1e-12 * values[-1])
    if not convex:
        values, vectors = np.linalg.eigh(flat)
    known = values > 1e-14 * max(values[-1], TINY)
    return np.asarray(vectors[:, known] @ ((gradient @ vectors[:, known]) / values[known])), convex


def least_worst(
    misses: Misses,
    z: FloatArray,
    basis: FloatArray,
    share: FloatArray,
    exact: NDArray[np.bool_],
) -> Polished:
    """A local minimum of the worst distance, counted by the root of share / mean share.

    Sums of ever higher powers of the distances; and once it is plain which poses are the worst,
    Newton's method on their distances being equal.
    """
    root = np.where(exact, 1.0, np.sqrt(share / share[~exact].mean()))
    loose = np.where(exact, 0.0, 1.0)

    def counted(z: FloatArray) -> Distances:
        miss, slope, bend = misses(z)
        return Distances(root * miss, root[:, None] * slope, root[:, None, None] * bend)

    power, best = 2, least_squares(misses, z, basis, share, exact)
    if np.abs(loose * counted(best.z).miss).max() < SETTLED:
        return best
    while power < HIGHEST:
        power *= 2
        best = _least_powers(counted, best.z, basis, loose, exact, power, STEPS)
        level = _levelled(counted, best, basis, exact) if power >= PLAIN else None
        if level is not None:
            best = level
            break
    return Polished(best.z, root * best.pull, level is not None)


def _levelled(
    misses: Misses, near: Polished, basis: FloatArray, exact: NDArray[np.bool_]
) -> Polished | None:
    """Where the worst distances are equal and the exact poses met, if that is a minimum.

    Newton's method on z, the level, and the shares of these poses in holding it.
    """
    miss, slope, bend = misses(near.z)
    held, size = np.flatnonzero(exact), np.where(exact, 0.0, np.abs(miss))
    shares = np.where(exact, 0.0, np.abs(near.pull))
    worst = np.argsort(-shares, kind="stable")[: max(basis.shape[1] - len(held) + 1, 0)]
    worst = worst[shares[worst] > FEW * shares.max()]
    sign, before = np.sign(miss[worst]), float(size.max())
    z, level, count, free = near.z, before, len(worst), basis.shape[1]
    holds = np.zeros(0)
    for _ in range(20):
        top = np.column_stack([sign[:, None] * (slope[worst] @ basis), -np.ones(count)])
        below = np.column_stack([slope[held] @ basis, np.zeros(len(held))])
        matrix = np.concatenate([top, below])
        gap = np.concatenate([sign * miss[worst] - level, miss[held]])
        right = np.append(np.zeros(free), 1.0)
        if not len(holds):
            holds = np.linalg.lstsq(matrix.T, -right, rcond=None)[0]
        pull = np.zeros(len(miss))
        pull[worst], pull[held] = holds[:count] * sign, holds[count:]
        curved = np.zeros((free + 1, free + 1))
        curved[:free, :free] = basis.T @ np.tensordot(pull, bend, axes=1) @ basis
        whole = np.block([[curved, matrix.T], [matrix, np.zeros((len(gap), len(gap)))]])
        uneven = np.concatenate([right + matrix.T @ holds, gap])
        step = -np.linalg.lstsq(whole, uneven, rcond=None)[0]
        z, level, holds = z + basis @ step[:free], level + step[free], holds + step[free + 1 :]
        if not np.isfinite(z).all() or np.abs(step[:free]).max(initial=0) > 10:
            return None
        miss, slope, bend = misses(z)
        if np.abs(step[: free + 1]).max() < SETTLED * (1 + np.abs(z).max()):
            break
    pull = np.zeros(len(miss))
    pull[worst], pull[held] = holds[:count] * sign, holds[count:]
    balanced = np.abs(pull @ slope @ basis).max(initial=0) < 1e-8 * (1 + np.abs(pull).max())
    highest = np.abs(miss[~exact]).max()
    sound = highest <= level * (1 + LEVEL) and highest <= before * (1 + LEVEL)
    met = np.abs(miss[held]).max(initial=0) < 1e-11 * (1 + np.abs(z).max())
    if not (balanced and sound and met and (holds[:count] > -1e-9).all()):
        return None
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
