"""The refinement of linkages under constraints, exact poses among them (SQP).

Each step solves a quadratic program of the equations linearised here (`quadratic_program`), for the
sum of squares plus penalties of all violations (Fletcher, Practical methods of optimization, 1987).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray, put, take, where
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import matvec
from burmester.numerics.quadratic_program import SoftProgram
from burmester.refinement.residuals import (
    SIZE,
    Linearisation,
    Problem,
    State,
    all_constraints,
    linearised,
    power_ratio,
    secant,
)
from burmester.refinement.starts import distinct

# Relative, of the Hessian's scaled diagonal: first value, floor, and the value that ends a descent.
START_DAMPING, MIN_DAMPING, MAX_DAMPING = 1e-4, 1e-14, 1e8
CONVERGED_STEP = 1e-13  # relative; a smaller step is rounding and ends the descent
STEPS_BEFORE_CURVATURE = 4  # number of successful steps before the Hessian estimate is in use
COST_ROUNDING = 1e-14  # relative; a smaller decrease of the cost is rounding
# Penalty weight of a constraint's violation: initial value, growth factor, maximum.
START_PENALTY, PENALTY_GROWTH, MAX_PENALTY = 1.0, 4.0, 1e5
# Once feasible, the penalty drops to this many times the largest multiplier.
MULTIPLIER_FACTOR = 3.0
# Floor on the column norms used to scale the damping, relative to the largest one.
MIN_COLUMN_NORM = 1e-3
FEASIBLE = 1e-9  # lengths; a constraint violated by less is met
# A step that promises to take less than this share off the cost ends a descent, unless the damping
# holds it back.
SETTLED_SHARE, SETTLED_DAMPING = 1e-11, 1.0
# A descent ends that has not gained this share of the cost in so many steps, taken or refused, and
# violates constraints by less (lengths): it creeps along a curved one, on and off it.
CREEPING_STEPS, CREEPING_SHARE, CREEPING_MISS = 8, 1e-4, 1e-6
# After its last choice a selection lets no descent go on that would be behind the best one after so
# many times what it gained in those steps.
HOPE = 32.0
ACTIVE_MULTIPLIER = 1e-6  # relative to the penalty; a constraint with a smaller one is inactive


Selection: TypeAlias = Sequence[tuple[int, int]]
"""Numbers of steps, and after each of them the number of the best linkages that go on."""


class _Point(NamedTuple):
    """Linkages (k,) with residuals and constraints (k, m), and their Jacobians by unknowns."""

    state: State
    model: Linearisation
    constraints: Linearisation

    @classmethod
    def at(cls, problem: Problem, which: NDArray[np.intp], state: State, power: float) -> _Point:
        with np.errstate(all="ignore"):
            value, jacobian, _ = all_constraints(problem, which, state)
            model = linearised(problem, which, state, power)
        return cls(state, model, Linearisation(value, jacobian))

    @property
    def sound(self) -> NDArray[np.bool_]:
        """Which are finite, (k,)."""
        out = np.ones(len(self.state.z), dtype=bool)
        for part in (self.state.z, self.state.rows, *self.model, *self.constraints):
            out &= np.isfinite(part).all(axis=tuple(range(1, part.ndim)))
        return out


class _ScaledProgram(NamedTuple):
    """The programs of linkages (k,), in unknowns that are scaled by size (k, n)."""

    program: SoftProgram
    size: FloatArray

    def promise(self, step: FloatArray) -> FloatArray:
        """How much (k,) steps (k, n) of the unknowns decrease what is quadratic."""
        hessian, gradient = self.program.hessian, self.program.gradient
        step = step * self.size
        return np.asarray(-((gradient + matvec(hessian, step) / 2) * step).sum(axis=1))

    def solved(self, start: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The steps (k, n) of the unknowns, and the multipliers (k, m), from others (k, m)."""
        step, multipliers = self.program.solved(start)
        return step / self.size, multipliers

    def corrected(self, index: NDArray[np.intp], value: FloatArray) -> _ScaledProgram:
        """Some of them with other values of the constraints."""
        program, size = take(self, index)
        return _ScaledProgram(program._replace(value=value), size)


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Descent:
    """Linkages (k,) on their way down under constraints; the arrays are written to.

    What decreases is half the sum of squares plus `penalty` times the constraints' violation.
    hessian_estimate: (k, n, n), of the residuals' curvature; good_steps: (k,), taken in a row;
    refused: (k,), the last step; multipliers: (k, m), of the last step taken.
    tried: (k,), number of steps tried; places: (k, N, 3), where they are; merit: (k,), what is left
    there, and `marked`: (k,), some steps ago; score: (k,), by which the selection chooses: with a
    penalty no lower than the first one; given_up: (k,), by the selection.
    """

    problem: Problem
    power: float
    start: _Point
    equal: NDArray[np.bool_]
    penalty: FloatArray
    hessian_estimate: FloatArray
    good_steps: NDArray[np.intp]
    refused: NDArray[np.bool_]
    multipliers: FloatArray
    selection: Selection
    tried: NDArray[np.intp]
    places: FloatArray
    merit: FloatArray
    score: FloatArray
    marked: FloatArray
    given_up: NDArray[np.bool_]

    @classmethod
    def of(
        cls, problem: Problem, z: FloatArray, rows: FloatArray, power: float, selection: Selection
    ) -> _Descent:
        count, every = len(z), np.arange(len(z))
        start = _Point.at(problem, every, problem.state_ahead(every, z.copy(), rows), power)
        one = every[:1]
        equal = all_constraints(problem, one, take(start.state, one))[2]
        unknowns = start.model.jacobian.shape[-1]
        return cls(
            problem,
            power,
            start,
            equal,
            np.full(count, START_PENALTY),
            np.zeros((count, unknowns, unknowns)),
            np.zeros(count, dtype=np.intp),
            np.zeros(count, dtype=bool),
            np.zeros(start.constraints.residual.shape),
            selection,
            np.zeros(count, dtype=np.intp),
            start.state.rows.copy(),
            np.full(count, np.nan),
            np.full(count, np.nan),
            np.full(count, np.inf),
            np.zeros(count, dtype=bool),
        )

    def violation(self, value: FloatArray) -> FloatArray:
        """The sum (k,) of what constraints (k, m) are violated by."""
        off = np.where(self.equal, np.abs(value), np.maximum(value, 0.0))
        return np.asarray(off.sum(axis=1))

    def program(self, rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> _ScaledProgram:
        """The quadratic programs of linkages `rows` (r,) at their points."""
        use_curvature = (self.good_steps[rows] >= STEPS_BEFORE_CURVATURE)[:, None, None]
        estimate = np.where(use_curvature, self.hessian_estimate[rows], 0.0)
        hessian, size = _hessian(here.model.jacobian, estimate)
        hessian = hessian + damping[:, None, None] * np.eye(hessian.shape[-1])
        gradient = (here.model.residual[:, None] @ here.model.jacobian)[:, 0] / size
        value, jacobian = here.constraints
        high = np.broadcast_to(self.penalty[rows][:, None], value.shape)
        low = np.where(self.equal, -high, 0.0)
        scaled = jacobian / size[:, None]
        return _ScaledProgram(SoftProgram(hessian, gradient, value, scaled, low, high), size)

    def moved(
        self, rows: NDArray[np.intp], here: _Point, step: FloatArray
    ) -> tuple[FloatArray, _Point, FloatArray]:
        """The steps (r, n), no longer than places may go, where they lead, and what it costs."""
        problem = self.problem
        step, shift = problem.limited(here.state, step)
        z = here.state.z + step[:, :SIZE]
        state = problem.state_ahead(rows, z, here.state.rows + shift)
        there = _Point.at(problem, rows, state, self.power)
        with np.errstate(all="ignore"):
            after = (there.model.residual**2).sum(axis=1) / 2
            if self.power != 2.0:  # measured in the top distance of before
                after = after * power_ratio(problem, here.state, state, self.power)
            after = after + self.penalty[rows] * self.violation(there.constraints.residual)
        sound = problem.sound(rows, z) & there.sound
        return step, there, np.where(sound, after, np.inf)

    def attempt(self, rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> Attempt[_Point]:
        """A step of the linkages `rows` (r,), with Fletcher's second-order correction."""
        free_unknowns, penalty = self.problem.free_unknowns(rows), self.penalty[rows]
        value, jacobian = here.constraints
        program = self.program(rows, here, damping)
        step, multipliers = program.solved(self.multipliers[rows])
        step = np.where(free_unknowns, step, 0.0)  # but for rounding it is so
        before = self.violation(value)
        cost = (here.model.residual**2).sum(axis=1) / 2 + penalty * before
        ahead = self.violation(value + matvec(jacobian, step))
        promise = program.promise(step) + penalty * (before - ahead)
        step, there, after = self.moved(rows, here, step)
        enough = cost * (1 + COST_ROUNDING)
        with np.errstate(invalid="ignore"):
            missed = self.violation(there.constraints.residual) > CONVERGED_STEP
            again = np.flatnonzero(~(after <= enough) & missed)
        if len(again):  # the same step for constraints with the curvature met on the way
            some = take(here, again)
            off = there.constraints.residual[again] - matvec(jacobian[again], step[again])
            second, own = program.corrected(again, off).solved(multipliers[again])
            second = np.where(free_unknowns[again], second, 0.0)
            second, other, later = self.moved(rows[again], some, second)
            won = later <= enough[again]
            at = again[won]
            step[at], multipliers[at], after[at] = second[won], own[won], later[won]
            put(there, at, take(other, won))
        better = after <= enough
        with np.errstate(all="ignore"):
            gain = (cost - after) / np.maximum(promise, np.finfo(float).tiny)
        fall = np.where(self.refused[rows], 0.5, 0.1)  # not at once to what was refused before
        factor = np.select([~better, gain > 0.75, gain > 0.25], [10.0, fall, 0.5], 3.0)
        self.refused[rows] = ~better
        damping = np.maximum(damping * factor, MIN_DAMPING)
        good_steps = self.good_steps[rows]
        refused = np.where(good_steps >= STEPS_BEFORE_CURVATURE, 0, good_steps)
        self.good_steps[rows] = np.where(better, good_steps + 1, refused)
        self._learn(rows[better], step[better], here, there, multipliers[better], taken=better)
        miss = np.where(better, self.violation(there.constraints.residual), before)
        stuck = (miss > FEASIBLE) & (ahead > before / 2) & (penalty < MAX_PENALTY)
        least = np.maximum(MULTIPLIER_FACTOR * np.abs(multipliers).max(axis=1, initial=0), FEASIBLE)
        self.penalty[rows] = np.select(
            [stuck, (miss <= FEASIBLE) | (ahead <= FEASIBLE)],
            [PENALTY_GROWTH * penalty, np.minimum(penalty, least)],
            penalty,
        )
        small = np.abs(step).max(axis=-1) < CONVERGED_STEP * (1 + np.abs(here.state.z).max(axis=-1))
        idle = better & (cost - after < COST_ROUNDING * cost)
        settled = (np.abs(promise) < SETTLED_SHARE * cost) & (damping < SETTLED_DAMPING)
        self.tried[rows] += 1
        self.merit[rows] = np.where(better, after, cost)
        self.score[rows] = self.merit[rows] + np.maximum(START_PENALTY - penalty, 0.0) * miss
        self.places[rows] = np.where(better[:, None, None], there.state.rows, here.state.rows)
        ended = (small | idle | settled | (damping > MAX_DAMPING)) & ~stuck
        ended |= self._creeping(rows, miss) | self._not_selected(rows)
        return Attempt(there, better, damping, ended)

    def _creeping(self, rows: NDArray[np.intp], miss: FloatArray) -> NDArray[np.bool_]:
        """Which (r,) have gained too little in the last `CREEPING_STEPS` to go on."""
        now = self.tried[rows] % CREEPING_STEPS == 0
        merit = self.merit[rows]
        gained = np.abs(self.marked[rows] - merit)
        self.marked[rows[now]] = merit[now]
        creeping = (miss < CREEPING_MISS) & (gained < CREEPING_SHARE * merit)
        if self.selection and (now & (self.tried[rows] > self.selection[-1][0])).any():
            best = np.nanmin(self.score[~self.given_up], initial=np.inf)
            creeping |= merit - HOPE * gained > best
        return np.asarray(now & creeping)

    def _not_selected(self, rows: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Which (r,) do not go on; linkages that lead to the same places are one."""
        for steps, most in self.selection:
            if len(rows) and self.tried[rows[0]] == steps:
                best = distinct(self.places, 2 * self.score, most)
                self.given_up[:] = True
                self.given_up[best] = False
        return self.given_up[rows]

    def _learn(
        self,
        rows: NDArray[np.intp],
        step: FloatArray,
        here: _Point,
        there: _Point,
        multipliers: FloatArray,
        *,
        taken: NDArray[np.bool_],
    ) -> None:
        """Keep the multipliers of steps taken, and how the equations bent from points to points."""
        before, after = (
            Linearisation(
                np.concatenate([each.model.residual[taken], multipliers], axis=1),
                np.concatenate([each.model.jacobian, each.constraints.jacobian], axis=1)[taken],
            )
            for each in (here, there)
        )
        self.hessian_estimate[rows] = secant(self.hessian_estimate[rows], step, before, after)
        self.multipliers[rows] = multipliers


def refine_constrained(
    problem: Problem,
    z: FloatArray,
    rows: FloatArray,
    power: float,
    steps: int,
    *,
    selection: Selection = (),
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], NDArray[np.bool_]]:
    """Linkages refined under constraints: z, rows, whether they converged, whether all hold.

    A step that bends away from the conditions is taken again (Fletcher's second-order correction).
    What a selection gives up comes back as it came, and does not hold.
    """
    way = _Descent.of(problem, z, rows, power, selection)
    ends, done = damped_descent(
        way.attempt,
        way.start,
        np.flatnonzero(way.start.sound),
        damping=10 * START_DAMPING,
        max_steps=steps,
    )
    which = np.flatnonzero(~way.given_up)
    before, state = take(way.start.state, which), take(ends.state, which)
    active = np.abs(way.multipliers[which]) > ACTIVE_MULTIPLIER * way.penalty[which, None]
    state, met = _made_feasible(problem, which, state, active | way.equal, way.equal)
    if (
        problem.places_are_free and problem.metric is None
    ):  # the nearest places, where they do as well
        near = problem.state(which, state.z, state.rows)
        also = problem.state_ahead(which, state.z, near.rows)
        value, _, _ = all_constraints(problem, which, also)
        good = np.array(met & (_greatest_violation(value, way.equal) < FEASIBLE), dtype=np.bool_)
        state = where(good, also, state)
    # What kept all constraints from the start is not given up for less.
    kept = _greatest_violation(way.start.constraints.residual[which], way.equal) < FEASIBLE
    with np.errstate(invalid="ignore"):
        worse = _cost(problem, which, before) < _cost(problem, which, state)
    back = np.array(way.start.sound[which] & kept & (~met | worse), dtype=np.bool_)
    state = where(back, before, state)
    z, rows, all_met = z.copy(), way.start.state.rows.copy(), ~way.given_up
    z[which], rows[which], all_met[which] = state.z, state.rows, met | back
    done[which] &= ~back
    return z, rows, done & ~way.given_up, all_met


def _cost(problem: Problem, which: NDArray[np.intp], state: State) -> FloatArray:
    """The weighted sum (k,) of squared distances from the poses."""
    gap = problem.share[:, None] * problem.counted(which, state.rows - problem.wanted)
    return np.asarray((gap * gap).sum(axis=(1, 2)))


def _greatest_violation(value: FloatArray, equal: NDArray[np.bool_]) -> FloatArray:
    """The greatest violation (k,) of constraints (k, m); infinite where one has no value."""
    off = np.where(equal, np.abs(value), value)
    return np.asarray(np.nan_to_num(off, nan=np.inf).max(axis=-1, initial=0))


def _hessian(jacobian: FloatArray, estimate: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The Hessian (k, n, n) of half the squares, made positive, in unknowns scaled by (k, n)."""
    flat = np.swapaxes(jacobian, -1, -2) @ jacobian
    size = np.sqrt(np.einsum("kii->ki", flat))
    size = np.maximum(size, MIN_COLUMN_NORM * size.max(axis=1, keepdims=True))
    size = np.where(size > 0, size, 1.0)  # every pose is exact, and nothing else counts
    values, axes = np.linalg.eigh((flat + estimate) / (size[:, None] * size[..., None]))
    values = np.maximum(np.abs(values), 1e-10)
    return (axes * values[:, None]) @ np.swapaxes(axes, -1, -2), size


def _made_feasible(
    problem: Problem,
    which: NDArray[np.intp],
    state: State,
    active: NDArray[np.bool_],
    equal: NDArray[np.bool_],
) -> tuple[State, NDArray[np.bool_]]:
    """States moved to meet the active constraints to rounding, by Newton's shortest steps."""
    value, jacobian, _ = all_constraints(problem, which, state)
    free_unknowns = problem.free_unknowns(which)
    for _ in range(6):
        active = active | (value > 0)
        gap = np.where(active, value, 0.0)
        if not (np.abs(gap) > CONVERGED_STEP).any():
            break
        rows = np.where(active[..., None], jacobian, 0.0)
        with np.errstate(invalid="ignore"):
            sound = np.isfinite(rows).all(axis=(1, 2)) & np.isfinite(gap).all(axis=1)
        step = np.zeros((len(which), jacobian.shape[-1]))
        step[sound] = -matvec(np.linalg.pinv(rows[sound], rcond=1e-10), gap[sound])
        step = np.where((np.abs(step).max(axis=-1) < 0.1)[:, None] & free_unknowns, step, 0.0)
        start = state.rows + matvec(state.place_jacobian, step[:, None])
        new = problem.state_ahead(which, state.z + step[:, :SIZE], start)
        state = where(np.asarray(np.isfinite(new.rows).all(axis=(1, 2))), new, state)
        value, jacobian, _ = all_constraints(problem, which, state)
    return state, np.asarray(_greatest_violation(value, equal) < FEASIBLE)
