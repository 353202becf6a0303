"""The last step of a dyad's fit: true distances from a circle or a line, least squares or minimax.

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
from burmester.numerics.iteration import shortened

__all__ = [
    "NEGLIGIBLE_GAIN",
    "DistanceFunction",
    "Distances",
    "FitProblem",
    "GeometricFit",
    "circle_distances",
    "circle_terms",
    "least_squares",
    "least_worst",
    "line_distances",
]

DIVISOR_FLOOR = 1e-300  # lengths; keeps 0 / 0 away from a pivot that meets its centre
MIN_SCALE = 1e-100  # lengths; distances below this are not magnified by higher powers
MAX_NEWTON_STEPS = 40  # of a sum of powers
MAX_MINIMAX_STEPS = 20  # of Newton's method once the worst poses are known
MAX_RESTORING_STEPS = 8  # of Newton's method back to the exact poses
SETTLED_STEP = 1e-13  # relative; a shorter step is rounding, and ends an iteration
NEGLIGIBLE_GAIN = 1e-10  # share of the sum of squares; a step that gains less is not checked by it
FLAT_EIGENVALUE = 1e-14  # share of the greatest; directions below it are not moved along
CONVEX_EIGENVALUE = 1e-12  # share of the greatest, above which a Hessian counts as positive
RANK_TOLERANCE = 1e-12  # share of the greatest singular value, below which one is zero
FIRST_MINIMAX_POWER = 32  # of the distances, from which on the worst poses are looked for
MAX_POWER = 4096  # of the distances; no higher sums are minimised
WORST_POSE_SHARE = 1e-3  # of the greatest multiplier, below which a pose is none of the worst
MAX_MINIMAX_STEP = 10.0  # lengths; a longer step has left the minimum
LEVEL_TOLERANCE = 1e-9  # relative; worst distances this near to each other are equal
BALANCE_TOLERANCE = 1e-8  # relative; what is left of the gradient at a minimax
EXACT_TOLERANCE = 1e-11  # relative; an exact pose missed by less is met


class Distances(NamedTuple):
    """Distances (N,), their Jacobian (N, k) and second derivatives (N, k, k) by z."""

    distance: FloatArray
    jacobian: FloatArray
    second: FloatArray


DistanceFunction: TypeAlias = Callable[[FloatArray], Distances]


class FitProblem(NamedTuple):
    """What a dyad z (k,) is fitted to.

    distances: of the poses (N,), as a function of z; basis: (k, d), orthonormal columns, the
    directions in which z may move; weights: (N,); exact: (N,), where the distance is to be zero.
    """

    distances: DistanceFunction
    basis: FloatArray
    weights: FloatArray
    exact: NDArray[np.bool_]

    def restored(self, z: FloatArray) -> FloatArray:
        """The dyad z moved along the basis to where exact poses are met, by Newton's method."""
        if not self.exact.any():
            return z
        for _ in range(MAX_RESTORING_STEPS):
            distance, jacobian, _ = self.distances(z)
            step = self.basis @ (
                np.linalg.pinv(jacobian[self.exact] @ self.basis) @ distance[self.exact]
            )
            z = z - step
            if np.abs(step).max(initial=0) < SETTLED_STEP * (1 + np.abs(z).max()):
                break
        return z

    def with_multipliers(self, jacobian: FloatArray, gradient: FloatArray) -> FloatArray:
        """The gradient (N,) by the distances, with the multipliers of the exact poses in it.

        jacobian: (N, d), by what may move; gradient: (N,), 0 at exact poses.
        """
        multipliers = np.zeros(len(gradient))
        if self.exact.any():
            transposed = np.linalg.pinv(jacobian[self.exact].T)
            multipliers[self.exact] = -(transposed @ (jacobian.T @ gradient))
        return gradient + multipliers


class GeometricFit(NamedTuple):
    """Where a fit ended: z (k,), and the objective's derivatives (N,) by the distances.

    The objective's gradient by z is jacobian.T @ by_distance, exact poses included: there the
    derivative is the multiplier.  settled: whether the steps came to an end.
    """

    z: FloatArray
    by_distance: FloatArray
    settled: bool


def circle_distances(poses: Displacement) -> DistanceFunction:
    """The distances of the moving pivot from its circle, over poses (N,)."""
    terms = circle_terms(poses)

    def distances(z: FloatArray) -> Distances:
        distance, jacobian, tangent, arm = terms(z)
        second = tangent[..., :, None] * tangent[..., None, :] / arm[..., None, None]
        return Distances(distance, jacobian, second)

    return distances


def circle_terms(poses: Displacement) -> Callable[[FloatArray], tuple[FloatArray, ...]]:
    """What the distances of circles z (*, 5) over poses (N,) consist of.

    Returns a function of z, to the distances (*, N), their Jacobian (*, N, 5), and the vectors
    tangent (*, N, 5) and arms (*, N) of which the second derivatives are made:
    tangent tangentᵀ / arm.
    """
    cos, sin = np.cos(poses.angle), np.sin(poses.angle)
    zero, one = np.zeros_like(cos), np.ones_like(cos)
    # Derivatives of the arm R m + d - c, whose length is the distance.
    arm1 = np.stack([-one, zero, cos, -sin, zero], axis=-1)
    arm2 = np.stack([zero, -one, sin, cos, zero], axis=-1)
    radius = np.array([0.0, 0.0, 0.0, 0.0, 1.0])

    def terms(z: FloatArray) -> tuple[FloatArray, ...]:
        arm = poses.act(z[..., None, 2:4]) - z[..., None, :2]
        length = np.maximum(np.hypot(arm[..., 0], arm[..., 1]), DIVISOR_FLOOR)
        u1, u2 = np.moveaxis(arm / length[..., None], -1, 0)[..., None]
        return length - z[..., 4:], u1 * arm1 + u2 * arm2 - radius, u1 * arm2 - u2 * arm1, length

    return terms


def line_distances(poses: Displacement) -> DistanceFunction:
    """The distances of the moving pivot from its line, over poses (N,)."""
    cos, sin = np.cos(poses.angle), np.sin(poses.angle)

    def distances(z: FloatArray) -> Distances:
        n1, n2 = np.cos(z[0]), np.sin(z[0])
        point = poses.act(z[2:])
        along, across = n1 * point[:, 0] + n2 * point[:, 1], n1 * point[:, 1] - n2 * point[:, 0]
        normal_in_body = np.stack([cos * n1 + sin * n2, cos * n2 - sin * n1], axis=-1)
        ones = np.ones_like(cos)
        jacobian = np.concatenate([np.stack([across, -ones], axis=-1), normal_in_body], axis=-1)
        second = np.zeros((len(cos), 4, 4))
        second[:, 0, 0] = -along
        second[:, 0, 2] = second[:, 2, 0] = cos * -n2 + sin * n1
        second[:, 0, 3] = second[:, 3, 0] = cos * n1 + sin * n2
        return Distances(along - z[1], jacobian, second)

    return distances


def least_squares(
    problem: FitProblem, z: FloatArray, max_steps: int = MAX_NEWTON_STEPS
) -> GeometricFit:
    """The local minimum of the weighted sum of squared distances, by Newton's method.

    Where the sum is not convex, Gauss and Newton's step is taken.  After every step the exact
    poses are met again; a step is shortened until it helps.
    """
    return _least_powers(problem, z, 2, max_steps)


def _least_powers(problem: FitProblem, z: FloatArray, power: int, max_steps: int) -> GeometricFit:
    """The same for the weighted sum of some even power of the distances.

    One dyad at a time: how many ways the exact poses leave is not the same for all.
    """
    weights = np.where(problem.exact, 0.0, problem.weights)

    def scale(distance: FloatArray) -> float:
        return float(np.abs(distance[weights > 0]).max(initial=MIN_SCALE))

    def leaning(distance: FloatArray) -> FloatArray:
        """What a pose (N,) counts as in a sum of squares that has the gradient of the powers."""
        return np.asarray(
            weights * np.minimum(np.abs(distance) / scale(distance), 1.0) ** (power - 2)
        )

    def total(distance: FloatArray, unit: float) -> float:
        with np.errstate(over="ignore"):
            counted = weights > 0
            return float(weights[counted] @ (distance / unit)[counted] ** power)

    def advance(z: FloatArray, here: Distances) -> tuple[FloatArray, Distances, bool]:
        """The next dyad with its distances, and whether this was the last step."""
        jacobian = here.jacobian @ problem.basis
        free = _null_space(jacobian[problem.exact])
        if not free.shape[1]:  # the exact poses leave no way to go
            return z, here, True
        directions = problem.basis @ free
        unit, weighted = scale(here.distance), leaning(here.distance)
        by_distance = problem.with_multipliers(jacobian, weighted * here.distance)
        gradient = directions.T @ (here.jacobian.T @ by_distance)
        reduced = here.jacobian @ directions
        gauss_newton = ((power - 1) * weighted[:, None] * reduced).T @ reduced
        curvature = np.tensordot(by_distance, here.second, axes=1)
        hessian = gauss_newton + directions.T @ curvature @ directions
        along, convex = _newton_step(hessian, gauss_newton, gradient)
        before = total(here.distance, unit)
        # Newton's last steps gain so little that the sum would tell by its rounding only.
        negligible = convex and power == 2 and along @ gradient < NEGLIGIBLE_GAIN * before * unit**2

        def trial(step: FloatArray) -> tuple[FloatArray, Distances]:
            to = problem.restored(z + step)
            return to, problem.distances(to)

        def worse(trial: tuple[FloatArray, Distances]) -> NDArray[np.bool_]:
            after = total(trial[1].distance, unit)
            return np.asarray(not (negligible or after <= before * (1 + 1e-13)))

        (to, there), failed = shortened(trial, -directions @ along, worse)
        if failed:
            return z, here, True
        return to, there, bool(np.abs(to - z).max() < SETTLED_STEP * (1 + np.abs(to).max()))

    z, settled = problem.restored(z), False
    here = problem.distances(z)
    for _ in range(max_steps):
        z, here, settled = advance(z, here)
        if settled:
            break
    by_distance = problem.with_multipliers(
        here.jacobian @ problem.basis, leaning(here.distance) * here.distance
    )
    return GeometricFit(z, by_distance, settled)


def _newton_step(
    hessian: FloatArray, gauss_newton: FloatArray, gradient: FloatArray
) -> tuple[FloatArray, bool]:
    """Newton's step uphill, or Gauss and Newton's where the Hessian is not positive.

    Returns the step (d,) and whether the Hessian is positive.
    """
    if not len(gradient):
        return gradient, True
    values, vectors = np.linalg.eigh(hessian)
    convex = bool(values[0] > CONVEX_EIGENVALUE * values[-1])
    if not convex:
        values, vectors = np.linalg.eigh(gauss_newton)
    known = values > FLAT_EIGENVALUE * max(values[-1], DIVISOR_FLOOR)
    return np.asarray(vectors[:, known] @ ((gradient @ vectors[:, known]) / values[known])), convex


def least_worst(problem: FitProblem, z: FloatArray) -> GeometricFit:
    """A local minimum of the worst distance, counted by the root of weight / mean weight.

    Sums of ever higher powers of the distances; and once it is plain which poses are the worst,
    Newton's method on their distances being equal.
    """
    exact, weights = problem.exact, problem.weights
    root = np.where(exact, 1.0, np.sqrt(weights / weights[~exact].mean()))
    loose = np.where(exact, 0.0, 1.0)

    def counted(z: FloatArray) -> Distances:
        distance, jacobian, second = problem.distances(z)
        return Distances(root * distance, root[:, None] * jacobian, root[:, None, None] * second)

    power, best = 2, least_squares(problem, z)
    if np.abs(loose * counted(best.z).distance).max() < SETTLED_STEP:
        return best
    unweighted = problem._replace(distances=counted, weights=loose)
    minimax = None
    while power < MAX_POWER:
        power *= 2
        best = _least_powers(unweighted, best.z, power, MAX_NEWTON_STEPS)
        minimax = _minimax(unweighted, best) if power >= FIRST_MINIMAX_POWER else None
        if minimax is not None:
            best = minimax
            break
    return GeometricFit(best.z, root * best.by_distance, minimax is not None)


def _minimax(problem: FitProblem, near: GeometricFit) -> GeometricFit | None:
    """Where the worst distances are equal and the exact poses met, if that is a minimum.

    Newton's method on z, the level, and the multipliers of these poses.
    """
    basis, exact = problem.basis, problem.exact
    distance, jacobian, second = problem.distances(near.z)
    held, size = np.flatnonzero(exact), np.where(exact, 0.0, np.abs(distance))
    shares = np.where(exact, 0.0, np.abs(near.by_distance))
    worst = np.argsort(-shares, kind="stable")[: max(basis.shape[1] - len(held) + 1, 0)]
    worst = worst[shares[worst] > WORST_POSE_SHARE * shares.max()]
    sign, before = np.sign(distance[worst]), float(size.max())
    z, level, count, free = near.z, before, len(worst), basis.shape[1]
    multipliers = np.zeros(0)
    for _ in range(MAX_MINIMAX_STEPS):
        top = np.column_stack([sign[:, None] * (jacobian[worst] @ basis), -np.ones(count)])
        below = np.column_stack([jacobian[held] @ basis, np.zeros(len(held))])
        matrix = np.concatenate([top, below])
        gap = np.concatenate([sign * distance[worst] - level, distance[held]])
        right = np.append(np.zeros(free), 1.0)
        if not len(multipliers):
            multipliers = np.linalg.lstsq(matrix.T, -right, rcond=None)[0]
        by_distance = np.zeros(len(distance))
        by_distance[worst], by_distance[held] = multipliers[:count] * sign, multipliers[count:]
        hessian = np.zeros((free + 1, free + 1))
        hessian[:free, :free] = basis.T @ np.tensordot(by_distance, second, axes=1) @ basis
        whole = np.block([[hessian, matrix.T], [matrix, np.zeros((len(gap), len(gap)))]])
        residual = np.concatenate([right + matrix.T @ multipliers, gap])
        step = -np.linalg.lstsq(whole, residual, rcond=None)[0]
        z, level = z + basis @ step[:free], level + step[free]
        multipliers = multipliers + step[free + 1 :]
        if not np.isfinite(z).all() or np.abs(step[:free]).max(initial=0) > MAX_MINIMAX_STEP:
            return None
        distance, jacobian, second = problem.distances(z)
        if np.abs(step[: free + 1]).max() < SETTLED_STEP * (1 + np.abs(z).max()):
            break
    by_distance = np.zeros(len(distance))
    by_distance[worst], by_distance[held] = multipliers[:count] * sign, multipliers[count:]
    gradient = np.abs(by_distance @ jacobian @ basis).max(initial=0)
    balanced = gradient < BALANCE_TOLERANCE * (1 + np.abs(by_distance).max())
    highest = np.abs(distance[~exact]).max()
    sound = all(highest <= most * (1 + LEVEL_TOLERANCE) for most in (level, before))
    met = np.abs(distance[held]).max(initial=0) < EXACT_TOLERANCE * (1 + np.abs(z).max())
    if not (balanced and sound and met and (multipliers[:count] > -1e-9).all()):
        return None
    return GeometricFit(z, by_distance, True)


def _null_space(rows: FloatArray) -> FloatArray:
    """Orthonormal columns (d, d - rank) of the null space of rows (k, d)."""
    if not len(rows):
        return np.eye(rows.shape[1])
    _, values, v = np.linalg.svd(rows)
    rank = int((values > RANK_TOLERANCE * max(values.max(initial=0), DIVISOR_FLOOR)).sum())
    return np.asarray(v[rank:].T)
