"""Linkages refined under conditions, and so that exact poses stay exact.

Each step is the best one for the equations as they are here (`quadratic_program`), by the sum of
squares and of all that is not kept (Fletcher, Practical methods of optimization, 1987).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.linkages.residuals import (
    SIZE,
    Linearisation,
    Problem,
    State,
    all_conditions,
    free_part,
    rescaled,
    secant,
)
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import put, take, where
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import matvec
from burmester.numerics.quadratic_program import SoftProgram

__all__ = ["held"]

DAMPING, LEAST, MOST = 1e-4, 1e-14, 1e8  # relative, of Levenberg and Marquardt
SETTLED = 1e-13  # a relative step that is rounding
CURVED = 4  # good steps, before those take the residuals' curvature into account
GAIN = 1e-14  # relative; less of it ends the steps
STIFF, STIFFER, STIFFEST = 1.0, 4.0, 1e5  # what a condition's miss counts as: at first, at most
OVER = 3.0  # times the greatest multiplier, that it counts as once all are met
COARSE = 1e-3  # of the greatest slope; a dimension that tells less is damped as if it told so much
MET = 1e-9  # a condition missed by less is met
TOUCHED = 1e-6  # of `stiff`; what presses less on a condition does not touch it


class _Point(NamedTuple):
    """Linkages (k,) with residuals and constraints (k, m), and their Jacobians by unknowns."""

    state: State
    model: Linearisation
    constraints: Linearisation

    @classmethod
    def at(cls, problem: Problem, which: NDArray[np.intp], state: State, power: float) -> _Point:
        with np.errstate(all="ignore"):
            value, jacobian, _ = all_conditions(problem, which, state)
            model = free_part(problem, which, state, power)
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

    def solved(self) -> tuple[FloatArray, FloatArray]:
        """The steps (k, n) of the unknowns, and the multipliers (k, m) of the constraints."""
        step, multipliers = self.program.solved()
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
    multipliers: (k, m), of the last step taken.
    """

    problem: Problem
    power: float
    start: _Point
    equal: NDArray[np.bool_]
    penalty: FloatArray
    hessian_estimate: FloatArray
    good_steps: NDArray[np.intp]
    multipliers: FloatArray

    @classmethod
    def of(cls, problem: Problem, z: FloatArray, rows: FloatArray, power: float) -> _Descent:
        count, every = len(z), np.arange(len(z))
        start = _Point.at(problem, every, problem.placed(every, z.copy(), rows), power)
        one = every[:1]
        equal = all_conditions(problem, one, take(start.state, one))[2]
        unknowns = start.model.jacobian.shape[-1]
        return cls(
            problem,
            power,
            start,
            equal,
            np.full(count, STIFF),
            np.zeros((count, unknowns, unknowns)),
            np.zeros(count, dtype=np.intp),
            np.zeros(start.constraints.residual.shape),
        )

    def violation(self, value: FloatArray) -> FloatArray:
        """The sum (k,) of what constraints (k, m) are violated by."""
        off = np.where(self.equal, np.abs(value), np.maximum(value, 0.0))
        return np.asarray(off.sum(axis=1))

    def program(self, rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> _ScaledProgram:
        """The quadratic programs of linkages `rows` (r,) at their points."""
        use_curvature = (self.good_steps[rows] >= CURVED)[:, None, None]
        estimate = np.where(use_curvature, self.hessian_estimate[rows], 0.0)
        hessian, size = _hessian(here.model.jacobian, estimate)
        hessian = hessian + damping[:, None, None] * np.eye(hessian.shape[-1])
        gradient = (here.model.residual[:, None] @ here.model.jacobian)[:, 0] / size
        value, jacobian = here.constraints
        high = np.broadcast_to(self.penalty[rows][:, None], value.shape)
        low = np.where(self.equal, -high, 0.0)
        scaled = jacobian / size[:, None]
        return _ScaledProgram(SoftProgram(hessian, gradient, value, scaled, low, high), size)

    def tried(
        self, rows: NDArray[np.intp], here: _Point, step: FloatArray
    ) -> tuple[FloatArray, _Point, FloatArray]:
        """The steps (r, n), no longer than places may go, where they lead, and what it costs."""
        problem = self.problem
        step, shift = problem.limited(here.state, step)
        z = here.state.z + step[:, :SIZE]
        state = problem.placed(rows, z, here.state.rows + shift)
        there = _Point.at(problem, rows, state, self.power)
        with np.errstate(all="ignore"):
            after = (there.model.residual**2).sum(axis=1) / 2
            if self.power != 2.0:  # measured in the top distance of before
                after = after * rescaled(problem, here.state, state, self.power)
            after = after + self.penalty[rows] * self.violation(there.constraints.residual)
        sound = problem.sound(rows, z) & there.sound
        return step, there, np.where(sound, after, np.inf)

    def attempt(self, rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> Attempt[_Point]:
        """A step of the linkages `rows` (r,), with Fletcher's second-order correction."""
        may, penalty = self.problem.may(rows), self.penalty[rows]
        value, jacobian = here.constraints
        program = self.program(rows, here, damping)
        step, multipliers = program.solved()
        step = np.where(may, step, 0.0)  # but for rounding it is so
        before = self.violation(value)
        cost = (here.model.residual**2).sum(axis=1) / 2 + penalty * before
        ahead = self.violation(value + matvec(jacobian, step))
        model = ((here.model.residual + matvec(here.model.jacobian, step)) ** 2).sum(axis=1) / 2
        step, there, after = self.tried(rows, here, step)
        enough = cost * (1 + GAIN)
        with np.errstate(invalid="ignore"):
            missed = self.violation(there.constraints.residual) > SETTLED
            again = np.flatnonzero(~(after <= enough) & missed)
        if len(again):  # the same step for constraints with the curvature met on the way
            some = take(here, again)
            off = there.constraints.residual[again] - matvec(jacobian[again], step[again])
            second, own = program.corrected(again, off).solved()
            second = np.where(may[again], second, 0.0)
            second, other, later = self.tried(rows[again], some, second)
            won = later <= enough[again]
            at = again[won]
            step[at], multipliers[at], after[at] = second[won], own[won], later[won]
            put(there, at, take(other, won))
        better = after <= enough
        with np.errstate(all="ignore"):
            promise = cost - model - penalty * ahead
            gain = (cost - after) / np.maximum(promise, np.finfo(float).tiny)
        factor = np.select([~better, gain > 0.75, gain > 0.25], [10.0, 0.1, 0.5], 3.0)
        damping = np.maximum(damping * factor, LEAST)
        good_steps = self.good_steps[rows]
        refused = np.where(good_steps >= CURVED, 0, good_steps)
        self.good_steps[rows] = np.where(better, good_steps + 1, refused)
        self._learn(
            rows[better], step[better], take(here, better), take(there, better), multipliers[better]
        )
        miss = np.where(better, self.violation(there.constraints.residual), before)
        stuck = (miss > MET) & (ahead > before / 2) & (penalty < STIFFEST)
        least = np.maximum(OVER * np.abs(multipliers).max(axis=1, initial=0), MET)
        self.penalty[rows] = np.select(
            [stuck, miss <= MET], [STIFFER * penalty, np.minimum(penalty, least)], penalty
        )
        small = np.abs(step).max(axis=-1) < SETTLED * (1 + np.abs(here.state.z).max(axis=-1))
        idle = better & (cost - after < GAIN * cost)
        return Attempt(there, better, damping, (small | idle | (damping > MOST)) & ~stuck)

    def _learn(
        self,
        rows: NDArray[np.intp],
        step: FloatArray,
        here: _Point,
        there: _Point,
        multipliers: FloatArray,
    ) -> None:
        """Keep the multipliers of steps taken, and how the equations bent on the way."""
        before, after = (
            Linearisation(
                np.concatenate([each.model.residual, multipliers], axis=1),
                np.concatenate([each.model.jacobian, each.constraints.jacobian], axis=1),
            )
            for each in (here, there)
        )
        self.hessian_estimate[rows] = secant(self.hessian_estimate[rows], step, before, after)
        self.multipliers[rows] = multipliers


def held(
    problem: Problem, z: FloatArray, rows: FloatArray, power: float, steps: int
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], NDArray[np.bool_]]:
    """Linkages refined under conditions: z, rows, whether they came to an end, if all hold.

    A step that bends away from the conditions is taken again (Fletcher's second-order correction).
    """
    way = _Descent.of(problem, z, rows, power)
    every, sound = np.arange(len(z)), np.flatnonzero(way.start.sound)
    ends, done = damped_descent(
        way.attempt, way.start, sound, damping=10 * DAMPING, max_steps=steps
    )
    active = way.equal | (np.abs(way.multipliers) > TOUCHED * way.penalty[:, None])
    state, met = _closed(problem, ends.state, active, way.equal)
    if problem.loose:  # the nearest places, where they do as well
        near = problem.state(every, state.z, state.rows)
        also = problem.placed(every, state.z, near.rows)
        value, _, _ = all_conditions(problem, every, also)
        good = np.array(met & (_most(value, way.equal) < MET), dtype=np.bool_)
        state = where(good, also, state)
    return state.z, state.rows, done, met


def _most(value: FloatArray, equal: NDArray[np.bool_]) -> FloatArray:
    """By how much conditions (k, m) are missed at the most, (k,); infinite where there is none."""
    off = np.where(equal, np.abs(value), value)
    return np.asarray(np.nan_to_num(off, nan=np.inf).max(axis=-1, initial=0))


def _hessian(jacobian: FloatArray, estimate: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The Hessian (k, n, n) of half the squares, made positive, in unknowns scaled by (k, n)."""
    flat = np.swapaxes(jacobian, -1, -2) @ jacobian
    size = np.sqrt(np.einsum("kii->ki", flat))
    size = np.maximum(size, COARSE * size.max(axis=1, keepdims=True))
    size = np.where(size > 0, size, 1.0)  # every pose is exact, and nothing else counts
    values, axes = np.linalg.eigh((flat + estimate) / (size[:, None] * size[..., None]))
    values = np.maximum(np.abs(values), 1e-10)
    return (axes * values[:, None]) @ np.swapaxes(axes, -1, -2), size


def _closed(
    problem: Problem, state: State, active: NDArray[np.bool_], equal: NDArray[np.bool_]
) -> tuple[State, NDArray[np.bool_]]:
    """What is held met to rounding: Newton's method, by the shortest step."""
    every = np.arange(len(state.z))
    value, slope, _ = all_conditions(problem, every, state)
    may = problem.may(every)
    for _ in range(6):
        active = active | (value > 0)
        gap = np.where(active, value, 0.0)
        if not (np.abs(gap) > SETTLED).any():
            break
        rows = np.where(active[..., None], slope, 0.0)
        with np.errstate(invalid="ignore"):
            sound = np.isfinite(rows).all(axis=(1, 2)) & np.isfinite(gap).all(axis=1)
        step = np.zeros((len(every), slope.shape[-1]))
        step[sound] = -matvec(np.linalg.pinv(rows[sound], rcond=1e-10), gap[sound])
        step = np.where((np.abs(step).max(axis=-1) < 0.1)[:, None] & may, step, 0.0)
        start = state.rows + matvec(state.moved, step[:, None])
        new = problem.placed(every, state.z + step[:, :SIZE], start)
        state = where(np.asarray(np.isfinite(new.rows).all(axis=(1, 2))), new, state)
        value, slope, _ = all_conditions(problem, every, state)
    return state, np.asarray(_most(value, equal) < MET)
