"""The residuals of linkages at the poses, and their Jacobians by the dimensions.

At a place x nearest to a pose only the components normal to the motion count, and there
J dx = -F dz, with J the forces of both dyads and F the derivatives of their equations by the
dimensions z.  Where places are free, steps along the motion are unknowns beside z.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.coupler_kernel import normal_parts
from burmester.fourbar.foot_points import newton_steps, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, take, weights_of_mean_one
from burmester.numerics.linear_algebra import matvec
from burmester.refinement.constraints import Constraints

SIZE = 2 * DIMENSIONS
MAX_NEWTON_STEPS = 6  # number of steps to the nearest places at most
CLOSE_STEP = 1e-6  # lengths; after a smaller step the next would be rounding
OFF_LINKAGE = 1e-6  # residual, in lengths; a place with a greater one is lost
MAX_FREE_PLACES = 64  # number of places that may be unknowns; with more, nearest places are used
MAX_SHIFT = 0.25  # lengths; a step moves no place farther
MAX_DIMENSION = 1e4  # lengths; a linkage with a longer dimension is given up


class State(NamedTuple):
    """Linkages (k,) with their places.

    z: (k, 10), dimensions; rows: (k, N, 3), places.
    residual: (k, N, 2), normal to the motion (or (k, N, 3), of free places); jacobian: its
        derivatives by the unknowns.
    place_jacobian: (k, N, 3, n), the derivatives of the places.
    """

    z: FloatArray
    rows: FloatArray
    residual: FloatArray
    jacobian: FloatArray
    place_jacobian: FloatArray


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
    """The refinement problem of linkages of kinds (k, 2), with dimensions z (k, 10).

    wanted: (N, 3), the poses as rows of x, y, length x angle.
    share: (N,), roots of their weights, 0 for exact poses.
    free: (k, 10), which dimensions may change.
    metric: (k, N, 3, 3) or broadcastable, what counts of a gap at each pose is this matrix times
        the gap, where places are free; None: all of it.
    """

    kinds: NDArray[np.int8]
    wanted: FloatArray
    length: float
    share: FloatArray
    exact: NDArray[np.bool_]
    constraints: Constraints | None
    free: NDArray[np.bool_]
    metric: FloatArray | None = None

    @classmethod
    def of(
        cls,
        batch: LinkageBatch,
        poses: Displacement,
        length: float,
        *,
        weights: FloatArray | None,
        exact: NDArray[np.bool_] | None,
        constraints: Constraints | None = None,
        free: NDArray[np.bool_] | None = None,
        metric: FloatArray | None = None,
    ) -> Problem:
        """The problem of linkages (k,) at poses (N,); without exact poses, and all of them free."""
        count, number = len(batch), poses.shape[0]
        exact = np.zeros(number, dtype=bool) if exact is None else exact
        share = np.where(exact, 0.0, np.sqrt(weights_of_mean_one(weights, (number,))))
        slots = np.ones((count, 2, DIMENSIONS), dtype=bool)
        slots[..., -1] = batch.kinds == 0
        used = slots.reshape(count, SIZE) & (True if free is None else free)
        if metric is not None:
            metric = np.broadcast_to(metric, (count, *metric.shape[-3:]))
        wanted = rows_of(poses, length)
        return cls(batch.kinds, wanted, length, share, exact, constraints, used, metric)

    def counted(self, which: NDArray[np.intp], gap: FloatArray) -> FloatArray:
        """What counts of gaps (r, N, 3) of the linkages at the indices."""
        return gap if self.metric is None else matvec(self.metric[which], gap)

    def batch(self, which: NDArray[np.intp], z: FloatArray) -> LinkageBatch:
        """The linkages at the indices with dimensions z."""
        return LinkageBatch(self.kinds[which], z.reshape(-1, 2, DIMENSIONS))

    def part(self, index: NDArray[np.intp]) -> Problem:
        """The problem of the linkages at the indices, without their constraints."""
        kinds, free, metric = take((self.kinds, self.free, self.metric), index)
        return replace(self, kinds=kinds, free=free, metric=metric, constraints=None)

    def state(self, which: NDArray[np.intp], z: FloatArray, rows: FloatArray) -> State:
        """The linkages z (k, 10) with their places nearest to the poses, by steps from rows."""
        return self._state(which, z, rows, self.wanted)

    def start(self, z: FloatArray, rows: FloatArray) -> State:
        """All linkages z (k, 10) with places near rows: free components stay about as they are."""
        near = self.wanted
        if self.metric is not None:
            near = np.where((self.metric != 0).any(axis=-2), near, rows)
        return self._state(np.arange(len(z)), z, rows, near)

    def _state(
        self, which: NDArray[np.intp], z: FloatArray, rows: FloatArray, target: FloatArray | None
    ) -> State:
        """The linkages with the places nearest to target (None: straight ahead of rows).

        What is normal to the motion there.  With a place's step along it for an unknown where it is
        straight ahead.  Places that are lost are nan.
        """
        batch, ahead = self.batch(which, z), target is None
        rows, _ = newton_steps(
            batch, rows, target, self.length, steps=MAX_NEWTON_STEPS, close=CLOSE_STEP
        )
        count, number = rows.shape[:2]
        residual, jacobian = np.empty((count, number, 2)), np.empty((count, number, 2, SIZE))
        by_place = np.zeros((count, number, 3, SIZE + number * ahead))
        normal_parts(
            *(batch.kinds, batch.dimensions, rows, self.wanted, self.length, OFF_LINKAGE),
            *(residual, jacobian, by_place, ahead),
        )
        return State(z, rows, residual, jacobian, by_place)

    @property
    def places_are_free(self) -> bool:
        """Whether steps along the motion are unknowns."""
        looked_at = self.constraints is not None and getattr(self.constraints, "uses_places", True)
        return looked_at and len(self.wanted) <= MAX_FREE_PLACES

    def state_ahead(self, which: NDArray[np.intp], z: FloatArray, rows: FloatArray) -> State:
        """The linkages z (k, 10) with the places (k, N) straight ahead of rows.

        Residuals are all of the differences (k, N, 3), and the unknowns N + 10 include a step along
        the motion for each place.
        """
        if not self.places_are_free:
            return self.state(which, z, rows)
        state = self._state(which, z, rows, None)
        gap, by_place = self.counted(which, state.rows - self.wanted), state.place_jacobian
        jacobian = by_place if self.metric is None else self.metric[which] @ by_place
        return state._replace(residual=gap, jacobian=jacobian)

    def constraint_values(
        self, which: NDArray[np.intp], state: State
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
        """The conditions (k, m), and their derivatives (k, m, n), places moving along."""
        unknowns = state.place_jacobian.shape[-1]
        if self.constraints is None:
            none = np.empty((len(which), 0, unknowns))
            return none[..., 0], none, np.empty(0, dtype=bool)
        value, slope, equal = self.constraints.differentiated(
            self.batch(which, state.z), state.rows, which, state.place_jacobian
        )
        return value, self.held(which, slope), equal

    def held(self, which: NDArray[np.intp], jacobian: FloatArray) -> FloatArray:
        """Derivatives (k, *, n), written to: 0 for unknowns that may not change."""
        np.copyto(jacobian[..., :SIZE], 0.0, where=~self.free[which][:, None])
        return jacobian

    def free_unknowns(self, which: NDArray[np.intp]) -> NDArray[np.bool_]:
        """The unknowns (k, n) that may change."""
        ways = np.ones((len(which), len(self.wanted) if self.places_are_free else 0), dtype=bool)
        return np.concatenate([self.free[which], ways], axis=1)

    def limited(self, state: State, step: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Steps (k, n) that move no place by more than `MAX_SHIFT`, and the shifts (k, N, 3)."""
        shift = matvec(state.place_jacobian, step[:, None])
        longest = np.abs(shift).max(axis=(1, 2))
        part = np.minimum(1.0, MAX_SHIFT / np.maximum(longest, MAX_SHIFT))
        return part[:, None] * step, part[:, None, None] * shift

    def sound(self, which: NDArray[np.intp], z: FloatArray) -> NDArray[np.bool_]:
        """Whether dimensions z (k, 10) are those of linkages: radii positive, nothing endless."""
        radius = z.reshape(-1, 2, DIMENSIONS)[..., -1]
        positive = ((radius > 0) | (self.kinds[which] > 0)).all(axis=-1)
        return np.asarray(positive & (np.abs(z).max(axis=-1) < MAX_DIMENSION))

    def powered(self, state: State, power: float) -> tuple[FloatArray, FloatArray]:
        """Residuals (k, *) whose squares are powers of the distances, and derivatives (k, *, n)."""
        count, unknowns = state.jacobian.shape[0], state.jacobian.shape[-1]
        residual = self.share[:, None] * state.residual
        jacobian = self.share[:, None, None] * state.jacobian
        if power == 2.0:
            number = residual.shape[1] * residual.shape[2]  # given, as there may be no linkages
            return residual.reshape(count, number), jacobian.reshape(count, number, unknowns)
        size = np.sqrt((residual * residual).sum(axis=-1)) + np.finfo(float).tiny
        top = size.max(axis=-1, keepdims=True)
        toward = (residual[..., None] * jacobian).sum(axis=-2) / size[..., None]
        root = (size / top) ** (power / 2)
        return top * root, (power / 2 * root / size * top)[..., None] * toward


def power_ratio(problem: Problem, here: State, there: State, power: float) -> FloatArray:
    """The factor (k,) that makes the sum of powers at `there` comparable with that at `here`."""
    top = [
        np.sqrt(((problem.share[:, None] * each.residual) ** 2).sum(axis=-1)).max(axis=-1)
        for each in (here, there)
    ]
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        return np.asarray((top[1] / top[0]) ** (power - 2))


def linearised(
    problem: Problem, which: NDArray[np.intp], state: State, power: float
) -> Linearisation:
    """Residuals (k, *) and derivatives (k, *, n), 0 for unknowns that may not change."""
    residual, jacobian = problem.powered(state, power)
    return Linearisation(residual, problem.held(which, jacobian))


def all_constraints(
    problem: Problem, which: NDArray[np.intp], state: State
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Exact poses (equalities) and conditions: values (k, m), derivatives, which are to be 0."""
    count = len(which)
    value, jacobian, equalities = problem.constraint_values(which, state)
    exact = state.residual[:, problem.exact].reshape(count, -1)
    turn = state.jacobian[:, problem.exact].reshape(count, -1, state.jacobian.shape[-1])
    turn = problem.held(which, turn)
    equal = np.concatenate([np.ones(exact.shape[1], dtype=bool), equalities])
    return np.concatenate([exact, value], axis=1), np.concatenate([turn, jacobian], axis=1), equal


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
