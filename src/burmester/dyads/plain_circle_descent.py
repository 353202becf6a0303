"""Newton's plain way from circles down to their distance from the poses, of many tasks at once.

Every sum over the poses of a circle is made pose by pose, for all circles together, and small
systems are solved term by term: so what becomes of a circle depends on its own task alone, to the
last bit, whatever tasks it is computed with.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import DIVISOR_FLOOR, NEGLIGIBLE_GAIN
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.iteration import MAX_QUARTERINGS
from burmester.progress import goes_on

__all__ = ["MAX_NEWTON_STEPS", "Descent", "plain_descent", "steady_starts"]

MAX_NEWTON_STEPS = 60  # from each start
SETTLED_STEP = 1e-9  # relative; a shorter step of Newton's method is its last one
FLAT_EIGENVALUE = 1e-14  # share of the greatest; smaller eigenvalues are taken for this one
START_BITS = 20  # of a start's coordinates; no rounding of where it comes from is in these
LEAST_PIVOT = 1e-12  # share of its diagonal; below it eigenvalues are looked at
ROUNDING = float(np.finfo(np.float64).eps)  # of a circle's size; a smaller distance is zero
SIZE = 5  # of a circle: c1, c2, m1, m2, r

Rows = NDArray[np.intp]
Mask = NDArray[np.bool_]


class Descent(NamedTuple):
    """Where circles (k,) ended: z (k, 5), c, m, r, with sums of squares (k,).

    settled: whether they came to rest at a minimum; ended_at: the step, from 1, 0 for no end.
    """

    z: FloatArray
    cost: FloatArray
    settled: Mask
    ended_at: Rows


class _Poses(NamedTuple):
    """The poses of each circle, and their shares: (N, k) each."""

    cos: FloatArray
    sin: FloatArray
    x: FloatArray
    y: FloatArray
    share: FloatArray

    def at(self, index: Rows | Mask) -> _Poses:
        """Those of some circles."""
        return _Poses(*(each[:, index] for each in self))

    def arms(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The ways R m + d - c from the centres of circles z (5, k) to their points."""
        c1, c2, m1, m2, _ = z
        x = self.cos * m1 - self.sin * m2 + self.x - c1
        return x, self.sin * m1 + self.cos * m2 + self.y - c2

    def cost(self, z: FloatArray) -> FloatArray:
        """The sums of squared distances (k,)."""
        x, y = self.arms(z)
        distance = np.sqrt(x * x + y * y) - z[4]
        return _over_poses(self.share * distance * distance)


def plain_descent(
    z: FloatArray,
    task: Rows,
    poses: Displacement,
    share: FloatArray,
    longest: FloatArray,
    *,
    steps: int = MAX_NEWTON_STEPS,
) -> Descent:
    """The way down from circles z (k, 5), of tasks (k,) with poses (T, N) and shares (T, N).

    Newton's method; where the sum is not convex, Gauss and Newton's step; shortened until it
    helps.  longest: (T,), the greatest coordinate of a circle; one that is greater has left; steps:
    how many of them at most.
    """
    count = len(z)
    x, y = (poses.translation[..., k].T for k in (0, 1))
    table = _Poses(np.cos(poses.angle.T), np.sin(poses.angle.T), x, y, share.T)
    ends, settled = np.array(z.T), np.zeros(count, dtype=bool)
    ended_at, run = np.zeros(count, dtype=np.intp), np.arange(count)
    seen, here = table.at(task), ends.copy()
    before, far = seen.cost(here), longest[task]
    for number in range(1, steps + 1):
        if not len(run) or not goes_on(number, steps):
            break
        step, convex, gain = _step(here, seen)
        # Newton's last steps gain so little that the sum would tell by its rounding only.
        checked = ~(convex & (gain < NEGLIGIBLE_GAIN * before))
        there, after, stuck = _shortened(here, step, before, checked, seen)
        size = 1 + np.abs(there).max(axis=0)
        moved = np.abs(there - here).max(axis=0)
        rest = convex & ((moved < SETTLED_STEP * size) | (before < (ROUNDING * size) ** 2))
        ended = rest | (stuck & ~convex) | (size > far)
        ends[:, run], settled[run] = there, rest
        ended_at[run[ended]] = number
        on = ~ended
        if ended.any():
            run, seen, there, after, far = run[on], seen.at(on), there[:, on], after[on], far[on]
        here, before = there, after
    return Descent(ends.T.copy(), table.at(task).cost(ends), settled, ended_at)


def steady_starts(z: FloatArray) -> FloatArray:
    """Circles (k, 5) to start from, with START_BITS of the greatest coordinate of each.

    Where the sum is not convex a way may turn by the last bit of its start: it would end elsewhere
    on another machine, or with another eigenproblem.
    """
    _, exponent = np.frexp(np.abs(z).max(axis=1, keepdims=True))
    return np.asarray(np.ldexp(np.round(np.ldexp(z, START_BITS - exponent)), exponent - START_BITS))


def _shortened(
    here: FloatArray, step: FloatArray, before: FloatArray, checked: Mask, seen: _Poses
) -> tuple[FloatArray, FloatArray, Mask]:
    """Circles (5, k) after steps that are divided by four until they make nothing worse.

    Returns them with their sums (k,), and which steps made it worse to the last.
    """
    there = here + step
    after = seen.cost(there)
    worse = np.flatnonzero(checked & (after > before))
    factor = 1.0
    for _ in range(MAX_QUARTERINGS - 1):
        if not len(worse):
            break
        factor /= 4
        trial = here[:, worse] + factor * step[:, worse]
        cost = seen.at(worse).cost(trial)
        good = ~(cost > before[worse])
        there[:, worse[good]], after[worse[good]] = trial[:, good], cost[good]
        worse = worse[~good]
    stuck = np.zeros(len(before), dtype=bool)
    stuck[worse] = True
    there[:, worse], after[worse] = here[:, worse], before[worse]
    return there, after, stuck


def _step(z: FloatArray, seen: _Poses) -> tuple[FloatArray, Mask, FloatArray]:
    """Newton's steps (5, k), or Gauss and Newton's where a sum is not convex.

    Returns the steps, whether the sums are convex (k,), and what the steps gain (k,).
    """
    x, y = seen.arms(z)
    arm = np.maximum(np.sqrt(x * x + y * y), DIVISOR_FLOOR)
    u, v = x / arm, y / arm
    a, b = seen.cos * u + seen.sin * v, seen.cos * v - seen.sin * u
    pull = seen.share * (arm - z[4])
    jacobian, tangent = np.array([-u, -v, a, b]), np.array([v, -u, -b, a])
    gradient = np.empty_like(z)
    gradient[:4], gradient[4] = _over_poses(pull * jacobian), -_over_poses(pull)
    # Lower triangles: the squares of the distances' gradients, and of the tangents by which these
    # turn.
    flat = np.empty((SIZE, *z.shape))
    shared, turned = seen.share * jacobian, pull / arm * tangent
    for i in range(4):
        flat[i, : i + 1] = _over_poses(shared[i] * jacobian[: i + 1])
    flat[4, :4], flat[4, 4] = -_over_poses(shared), _over_poses(seen.share)
    hessian = flat.copy()
    for i in range(4):
        hessian[i, : i + 1] += _over_poses(turned[i] * tangent[: i + 1])
    step, convex, sure = _solved(hessian, gradient)
    doubtful = np.flatnonzero(~sure)
    if len(doubtful):
        some = hessian[..., doubtful], flat[..., doubtful], gradient[:, doubtful]
        step[:, doubtful], convex[doubtful] = _by_eigenvalues(*some)
    other = np.flatnonzero(sure & ~convex)
    if len(other):
        step[:, other], _, sure = _solved(flat[..., other], gradient[:, other])
        if len(doubtful := other[~sure]):
            some = flat[..., doubtful], flat[..., doubtful], gradient[:, doubtful]
            step[:, doubtful], _ = _by_eigenvalues(*some)
    return step, convex, -(gradient * step).sum(axis=0)


def _over_poses(values: FloatArray) -> FloatArray:
    """Sums (*, k) of values (*, N, k), in the order of the poses, however many circles.

    NumPy adds a single column in another order.
    """
    if values.shape[-1] > 1:
        return np.asarray(values.sum(axis=-2))
    return np.asarray(np.add.accumulate(values, axis=-2)[..., -1, :])


def _solved(lower: FloatArray, right: FloatArray) -> tuple[FloatArray, Mask, Mask]:
    """The steps (5, k) that take away gradients (5, k), by L D Lᵀ of lower triangles (5, 5, k).

    Returns them, which matrices are positive definite, and of which no pivot is near zero, so that
    this is sure.
    """
    left, x = lower.copy(), -right
    diagonal = np.abs(lower[range(SIZE), range(SIZE)])
    pivots = np.empty_like(right)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for j in range(SIZE):
            pivots[j] = left[j, j]
            column = left[j + 1 :, j] / pivots[j]
            for i in range(j + 1, SIZE):
                left[i, j + 1 : i + 1] -= column[i - j - 1] * left[j + 1 : i + 1, j]
            left[j + 1 :, j] = column
            x[j + 1 :] -= column * x[j]
        x /= pivots
        for j in range(SIZE - 1, 0, -1):
            x[:j] -= left[j, :j] * x[j]
        sure = (np.abs(pivots) > LEAST_PIVOT * diagonal).all(axis=0)
        definite = (pivots > 0).all(axis=0)
    return x, np.asarray(definite), np.asarray(sure)


def _by_eigenvalues(
    hessian: FloatArray, flat: FloatArray, gradient: FloatArray
) -> tuple[FloatArray, Mask]:
    """The same steps (5, k), and whether the sums are convex, by eigenvalues."""
    finite = np.isfinite(hessian[_LOWER]).all(axis=0) & np.isfinite(gradient).all(axis=0)
    lost = np.asarray(~finite)
    matrices, squares = _whole(hessian, lost), _whole(flat, lost)
    values, axes = np.linalg.eigh(matrices)
    convex = values[:, 0] > 0
    if not convex.all():
        values[~convex], axes[~convex] = np.linalg.eigh(squares[~convex])
    values = np.maximum(values, FLAT_EIGENVALUE * values[:, -1:])
    down = np.where(lost, 0.0, gradient)  # beyond all measure no step is made
    along = (axes * down.T[:, :, None]).sum(axis=1) / values
    return -(axes * along[:, None]).sum(axis=2).T, convex & ~lost


_LOWER = np.tril_indices(SIZE)


def _whole(lower: FloatArray, lost: Mask) -> FloatArray:
    """The symmetric matrices (k, 5, 5) of lower triangles (5, 5, k); the unit matrix where lost."""
    whole = np.empty((lower.shape[-1], SIZE, SIZE))
    whole[:, _LOWER[0], _LOWER[1]] = whole[:, _LOWER[1], _LOWER[0]] = lower[_LOWER].T
    whole[lost] = np.eye(SIZE)
    return whole
