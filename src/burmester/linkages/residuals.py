"""What refining makes less: the misses of linkages, and how they and the places change.

At a place x nearest to a pose only what is normal to the motion counts, and there J dx = -F dz,
with J the forces of both dyads and F the derivatives of their equations by the dimensions z.
Where places need not be the nearest ones, the ways along the motion are unknowns beside z.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.foot_points import ConstraintNormals, constraint_normals, newton_step
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.constraints import Constraints
from burmester.numerics.arrays import FloatArray
from burmester.numerics.differences import DifferenceQuotients
from burmester.numerics.linear_algebra import matvec

__all__ = [
    "SIZE",
    "Linearisation",
    "Problem",
    "State",
    "all_conditions",
    "free_part",
    "rescaled",
    "secant",
]

SIZE = 2 * DIMENSIONS
NEARER, CLOSE = 6, 1e-6  # Newton's steps to the nearest place; a step whose next is rounding
OFF = 1e-6  # a place farther off its linkage is lost
FEW = 64  # places that may be unknowns
QUOTIENTS = DifferenceQuotients(stride=1e-7)  # of the constraints, by all unknowns
MAX_SHIFT = 0.25  # lengths that a place may move in a step
MAX_DIMENSION = 1e4  # lengths; a linkage with a longer one is on its way to infinity


class State(NamedTuple):
    """Linkages (k,) with their places: misses u (k, N, 2) normal to the motion, and derivatives."""

    z: FloatArray
    rows: FloatArray
    miss: FloatArray
    slope: FloatArray
    moved: FloatArray


class Linearisation(NamedTuple):
    """Residuals (k, m) of linkages, and their Jacobians (k, m, n) by what may change."""

    residual: FloatArray
    jacobian: FloatArray

    def gradient(self, residual: FloatArray) -> FloatArray:
        """The Jacobian's transpose times residuals (k, m): (k, n)."""
        return matvec(np.swapaxes(self.jacobian, -1, -2), residual)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """What is asked of linkages of kinds (k, 2), whose dimensions are z (k, 10) all along.

    wanted: (N, 3), the poses as rows of x, y, length x angle; share: (N,), roots of their weights,
    0 for exact ones; free: (k, 10), which dimensions may change.
    """

    kinds: NDArray[np.int8]
    wanted: FloatArray
    length: float
    share: FloatArray
    exact: NDArray[np.bool_]
    conditions: Constraints | None
    free: NDArray[np.bool_]

    def stack(self, which: NDArray[np.intp], z: FloatArray) -> LinkageBatch:
        """The linkages at the indices with dimensions z."""
        return LinkageBatch(self.kinds[which], z.reshape(-1, 2, DIMENSIONS))

    def state(self, which: NDArray[np.intp], z: FloatArray, rows: FloatArray) -> State:
        """The linkages z (k, 10) with the places nearest to the poses that rows lead to."""
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            rows, at, partial = self._brought(self.stack(which, z), rows, self.wanted)
            return State(z, rows, *_normal_part(at, rows - self.wanted, partial))

    def _brought(
        self, stack: LinkageBatch, rows: FloatArray, target: FloatArray | None
    ) -> tuple[FloatArray, ConstraintNormals, FloatArray]:
        """Rows brought to where target is nearest (None: straight ahead), nan where they are lost.

        With what both dyads do there, and the derivatives by their dimensions.
        """
        surfaces = stack.surfaces()
        for _ in range(NEARER):
            to = rows if target is None else target
            step, size = newton_step(surfaces, rows, to, self.length)
            rows = rows + step
            if not (size > CLOSE).any():
                break
        places = Displacement(rows[..., :2], rows[..., 2] / self.length)
        miss, force, partial = stack.bearing(places)
        off = ~(np.abs(miss) < OFF).all(axis=(1, 2))
        rows[off] = np.nan
        return rows, constraint_normals(miss, force, self.length), partial

    @property
    def loose(self) -> bool:
        """Whether places are unknowns."""
        looked_at = self.conditions is not None and getattr(self.conditions, "placed", True)
        return looked_at and len(self.wanted) <= FEW

    def placed(self, which: NDArray[np.intp], z: FloatArray, rows: FloatArray) -> State:
        """The linkages z (k, 10) with the places (k, N) that are straight ahead of rows.

        Misses are whole gaps (k, N, 3), and the ways along the motion are unknowns N + 10.
        """
        if not self.loose:
            return self.state(which, z, rows)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            rows, at, partial = self._brought(self.stack(which, z), rows, None)
            gap, every = rows - self.wanted, np.arange(rows.shape[1])
            moved = np.zeros((*gap.shape, SIZE + len(every)))
            moved[..., :SIZE] = _normal_part(at, gap, partial)[2]
            moved[:, every, :, SIZE + every] = np.moveaxis(at.tangent, 1, 0)
            return State(z, rows, gap, moved, moved)

    def limits(
        self, which: NDArray[np.intp], state: State
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
        """The conditions (k, m), and their derivatives (k, m, n), places moving along."""
        unknowns = state.moved.shape[-1]
        if self.conditions is None:
            none = np.empty((len(which), 0, unknowns))
            return none[..., 0], none, np.empty(0, dtype=bool)
        z = QUOTIENTS.points(state.z, np.eye(unknowns)[:, None, :SIZE])
        rows = QUOTIENTS.points(state.rows, np.moveaxis(state.moved, -1, 0))
        count, number = len(which), state.rows.shape[1]
        every = np.tile(which, unknowns + 1)
        value, equal = self.conditions(
            self.stack(every, z.reshape(-1, SIZE)), rows.reshape(-1, number, 3), every
        )
        value = value.reshape(unknowns + 1, count, -1)
        slope = QUOTIENTS.jacobian(value)
        return value[0], np.where(self.may(which)[:, None], slope, 0.0), equal

    def may(self, which: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Which unknowns (k, n) may change."""
        ways = np.ones((len(which), len(self.wanted) if self.loose else 0), dtype=bool)
        return np.concatenate([self.free[which], ways], axis=1)

    def limited(self, state: State, step: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Steps (k, n) that move no place by more than `MAX_SHIFT`, and the shifts (k, N, 3)."""
        shift = matvec(state.moved, step[:, None])
        longest = np.abs(shift).max(axis=(1, 2))
        part = np.minimum(1.0, MAX_SHIFT / np.maximum(longest, MAX_SHIFT))
        return part[:, None] * step, part[:, None, None] * shift

    def sound(self, which: NDArray[np.intp], z: FloatArray) -> NDArray[np.bool_]:
        """Whether dimensions z (k, 10) are those of linkages: radii positive, nothing endless."""
        radius = z.reshape(-1, 2, DIMENSIONS)[..., -1]
        positive = ((radius > 0) | (self.kinds[which] > 0)).all(axis=-1)
        return np.asarray(positive & (np.abs(z).max(axis=-1) < MAX_DIMENSION))

    def rooted(self, state: State, power: float) -> tuple[FloatArray, FloatArray]:
        """Residuals (k, *) and their derivatives (k, *, n) whose squares are to be least."""
        count, unknowns = state.slope.shape[0], state.slope.shape[-1]
        miss = self.share[:, None] * state.miss
        slope = self.share[:, None, None] * state.slope
        if power == 2.0:
            number = miss.shape[1] * miss.shape[2]  # given, as there may be no linkages
            return miss.reshape(count, number), slope.reshape(count, number, unknowns)
        size = np.sqrt((miss * miss).sum(axis=-1)) + np.finfo(float).tiny
        top = size.max(axis=-1, keepdims=True)
        toward = (miss[..., None] * slope).sum(axis=-2) / size[..., None]
        root = (size / top) ** (power / 2)
        return top * root, (power / 2 * root / size * top)[..., None] * toward


def _normal_part(
    at: ConstraintNormals, gap: FloatArray, partial: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Of gaps (k, N, 3) what is normal to the motion, (k, N, 2), in an orthonormal basis.

    With its derivatives (k, N, 2, 10) by the dimensions, and those of the places (k, N, 3, 10).
    """
    a, b, _ = np.moveaxis(at.gram, -1, 0)
    first, height = np.sqrt(a), np.sqrt(at.det / a)
    basis = np.empty_like(at.force)
    basis[..., 0, :] = at.force[..., 0, :] / first[..., None]
    basis[..., 1, :] = (at.force[..., 1, :] - (b / a)[..., None] * at.force[..., 0, :]) / height[
        ..., None
    ]
    slope = np.zeros((*gap.shape[:-1], 2, SIZE))
    slope[..., 0, :DIMENSIONS] = -partial[:, 0] / first[..., None]
    slope[..., 1, :DIMENSIONS] = (b / a / height)[..., None] * partial[:, 0]
    slope[..., 1, DIMENSIONS:] = -partial[:, 1] / height[..., None]
    moved = np.swapaxes(basis, -1, -2) @ slope
    return (basis @ gap[..., None])[..., 0], slope, moved


def rescaled(problem: Problem, here: State, there: State, power: float) -> FloatArray:
    """What the sum of powers at `there` is multiplied by, to be compared with that at `here`."""
    top = [
        np.sqrt(((problem.share[:, None] * each.miss) ** 2).sum(axis=-1)).max(axis=-1)
        for each in (here, there)
    ]
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        return np.asarray((top[1] / top[0]) ** (power - 2))


def free_part(
    problem: Problem, which: NDArray[np.intp], state: State, power: float
) -> Linearisation:
    """Residuals (k, *) and derivatives (k, *, n) by what may change."""
    residual, slope = problem.rooted(state, power)
    return Linearisation(residual, np.where(problem.may(which)[:, None], slope, 0.0))


def all_conditions(
    problem: Problem, which: NDArray[np.intp], state: State
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Exact poses (equalities) and conditions: values (k, m), derivatives, which are to be 0."""
    count = len(which)
    value, slope, equalities = problem.limits(which, state)
    exact = state.miss[:, problem.exact].reshape(count, -1)
    turn = state.slope[:, problem.exact].reshape(count, -1, state.slope.shape[-1])
    turn = np.where(problem.may(which)[:, None], turn, 0.0)
    equal = np.concatenate([np.ones(exact.shape[1], dtype=bool), equalities])
    return np.concatenate([exact, value], axis=1), np.concatenate([turn, slope], axis=1), equal


def secant(
    estimate: FloatArray, step: FloatArray, here: Linearisation, there: Linearisation
) -> FloatArray:
    """The residuals' part of the Hessian (k, n, n), learnt from a step (k, n) from here to there.

    Dennis, Gay and Welsch, An adaptive nonlinear least-squares algorithm, ACM TOMS 7, 1981.
    """
    ahead = there.gradient(there.residual)
    own = ahead - here.gradient(there.residual)
    gained = ahead - here.gradient(here.residual)
    curve = (gained * step).sum(axis=-1)
    guess = matvec(estimate, step)
    with np.errstate(divide="ignore", invalid="ignore"):
        shrink = np.minimum(np.abs((step * own).sum(-1) / (step * guess).sum(-1)), 1.0)
        shrink = np.where(np.isfinite(shrink), shrink, 1.0)[:, None]
        rest = (own - shrink * guess) / curve[:, None]
        lean = (step * rest).sum(axis=-1) / curve
        mixed = rest[..., None] * gained[:, None]
        new = shrink[..., None] * estimate + mixed + np.swapaxes(mixed, -1, -2)
        new = new - lean[:, None, None] * gained[..., None] * gained[:, None]
    sound = (curve > 0) & np.isfinite(new).all(axis=(1, 2))
    return np.where(sound[:, None, None], new, estimate)
