"""Refinement of function generators by the error of the true output angle, under what they keep.

Freudenstein's residual weighs an error by the links and by the transmission angle, so its minima
are starts only.  From them, and from others, each step solves a quadratic program of the errors
and constraints linearised there (`quadratic_program`): Gauss and Newton's for the least sum of
squares, the least level of all errors for minimax (a sequence of such programs, damped: Fletcher,
Practical methods of optimization, 1987, chapter 14).  A step that the curvature of the constraints
spoils is tried again with their values where it led.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.functions.generator import Generator
from burmester.functions.kept_requirements import MOST_SIZE, SPARE, KeptRequirements
from burmester.numerics.arrays import FloatArray, put, take
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import matvec
from burmester.numerics.quadratic_program import SoftProgram
from burmester.tasks.function_task import FunctionTask

AT_BOUND = 1e-3  # of the logarithm of the greatest size; a length as near to it is at it
SAME_GENERATOR = 1e-4  # of a link, and radians; generators that differ less are one
MAX_STEPS = 120  # taken or refused
START_DAMPING, MIN_DAMPING, MAX_DAMPING = 1e-2, 1e-9, 1e10  # of the squared columns
DAMPING_CUT, DAMPING_GROWTH = 0.2, 4.0
LEVEL_DAMPING = 1e-3  # of the level of minimax, so that the program has one solution
PENALTY: Final = 1000.0  # of a violation, in units of the logarithm of the error
ERROR_FLOOR = 1e-10  # radians; smaller errors are rounding
SETTLED = 1e-9  # relative; a step that promises to take less off the error is none
POOR, GOOD = 0.25, 0.75  # of what a step promises: less is tried again, more frees the next
METRIC_FLOOR = 1e-6  # relative; directions that change the errors less count as that in it
LEAST_COLUMN = 1e-3  # of the largest; a smaller derivative counts as that in the damping
MOST_SHARE = 2.0  # of a multiplier of minimax, which are 1 together
LONGEST_STEP = 0.5  # of the logarithm of a link, and radians


def refined(
    start: Generator,
    task: FunctionTask,
    kept: KeptRequirements,
    *,
    minimax: bool = False,
) -> tuple[Generator, FloatArray, NDArray[np.bool_]]:
    """Generators (k,) downhill of starts: of the least squared or the least greatest error.

    Returns them, their error (k,) over the pairs, root mean square or greatest, and which of them
    (k,) are closed at all pairs and keep what they have to.
    """
    problem = _Problem(task, kept, start.side, minimax)
    phases = np.stack([start.input_phase, start.output_phase], axis=-1)
    unknowns = np.concatenate([np.log(start.sizes[:, 1:]), phases], axis=-1)
    first = problem.point(np.arange(len(start)), unknowns)
    rows = np.flatnonzero(np.isfinite(first.error))
    ends, _ = damped_descent(
        problem.attempt, first, rows, damping=START_DAMPING, max_steps=MAX_STEPS
    )
    return (
        _generator(ends.x, start.side),
        ends.error,
        np.isfinite(ends.error) & (ends.broken < SPARE),
    )


class _Point(NamedTuple):
    """Unknowns x (k, 5), logarithms of the links and phases, and what is known there.

    errors: (k, N), radians, times the roots of their weights for least squares; by_x: (k, N, 5).
    kept: (k, M), the constraints; kept_by_x: (k, M, 5).
    error: (k,), what is to be least, infinite where the linkage is open; broken: (k,), the sum of
    all violations.  multipliers: (k, *), of the last program.
    """

    x: FloatArray
    errors: FloatArray
    by_x: FloatArray
    kept: FloatArray
    kept_by_x: FloatArray
    error: FloatArray
    broken: FloatArray
    multipliers: FloatArray

    @property
    def merit(self) -> FloatArray:
        return np.asarray(np.log(self.error + ERROR_FLOOR) + PENALTY * self.broken)


class _Problem:
    """The errors of a task and what is kept, for the rows of a descent."""

    def __init__(
        self, task: FunctionTask, kept: KeptRequirements, side: FloatArray, minimax: bool
    ) -> None:
        self.task, self.kept, self.side, self.minimax = task, kept, side, minimax
        share = np.ones(len(task.inputs)) if task.weights is None else task.weights
        self.roots = np.ones(len(share)) if minimax else np.sqrt(share / share.sum())
        self.fixed = np.array([task.input_phase is not None, task.output_phase is not None])

    def point(self, rows: NDArray[np.intp], x: FloatArray) -> _Point:
        here = _generator(x, self.side[rows])
        with np.errstate(all="ignore"):
            errors, by_x = _errors(here, self.task)
            by_x[..., 3:][..., self.fixed] = 0.0
            kept = self.kept._replace(
                transmission=self.kept.transmission[rows], ratio=self.kept.ratio[rows]
            )
            values, slopes = kept.constraints(here, *self.task.input_ends)
            slopes = slopes.copy()
            slopes[..., 3:][..., self.fixed] = 0.0
            errors, by_x = self.roots * errors, self.roots[:, None] * by_x
            if self.minimax:
                error = np.abs(errors).max(axis=1)
            else:
                error = np.sqrt((errors**2).sum(axis=1))
            broken = np.maximum(values, 0.0).sum(axis=1)
        sound = np.isfinite(error) & np.isfinite(by_x).all(axis=(1, 2)) & np.isfinite(broken)
        sound &= np.isfinite(slopes).all(axis=(1, 2))
        error = np.where(sound, error, np.inf)
        width = values.shape[1] + (errors.shape[1] if self.minimax else 0)
        return _Point(x, errors, by_x, values, slopes, error, broken, np.zeros((len(x), width)))

    def attempt(self, rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> Attempt[_Point]:
        """A damped step of rows (r,)."""
        program, scale = self._program(here, damping)
        step, multipliers = program.solved(here.multipliers)
        promise = self._promise(here, step / scale)
        there = self._led(rows, here, step / scale)
        gain = here.merit - there.merit
        poor = ~(gain > POOR * promise) & np.isfinite(there.error)
        if poor.any():
            again, y = take(program, poor), multipliers[poor]
            bent = self._values(take(there, poor), here.error[poor])
            bent = bent - matvec(again.jacobian, step[poor])
            second, y = again._replace(value=bent).solved(y)
            corrected = self._led(rows[poor], take(here, poor), second / scale[poor])
            better = take(here, poor).merit - corrected.merit > gain[poor]
            put(there, np.flatnonzero(poor)[better], take(corrected, better))
            multipliers[np.flatnonzero(poor)[better]] = y[better]
            gain = here.merit - there.merit
        damping = np.where(gain > GOOD * promise, damping * DAMPING_CUT, damping)
        damping = np.where(gain > POOR * promise, damping, damping * DAMPING_GROWTH)
        damping = np.maximum(damping, MIN_DAMPING)
        ended = ~(promise > SETTLED) | (damping > MAX_DAMPING)
        there = there._replace(multipliers=multipliers)
        return Attempt(there, gain > 0, damping, ended)

    def _led(self, rows: NDArray[np.intp], here: _Point, step: FloatArray) -> _Point:
        step = step[:, :5]
        most = np.abs(step).max(axis=1, keepdims=True)
        step = step * np.minimum(1.0, LONGEST_STEP / np.maximum(most, LONGEST_STEP))
        return self.point(rows, here.x + step)

    def _values(self, there: _Point, level: FloatArray) -> FloatArray:
        """The values of a program's constraints; level: (k,), the error that is their unit."""
        if not self.minimax:
            return there.kept
        errors = np.abs(there.errors) / (level + ERROR_FLOOR)[:, None] - 1
        return np.concatenate([errors, there.kept], axis=1)

    def _program(self, here: _Point, damping: FloatArray) -> tuple[SoftProgram, FloatArray]:
        """The program of a step in unknowns of unit columns, and the sizes of these (k, n).

        For minimax the level of the errors is a sixth unknown, in units of the present one.
        """
        slopes = here.by_x / (here.error + ERROR_FLOOR)[:, None, None]
        scale = np.linalg.norm(slopes, axis=1)
        scale = np.maximum(scale, LEAST_COLUMN * scale.max(axis=1, keepdims=True))
        slopes, kept = slopes / scale[:, None, :], here.kept_by_x / scale[:, None, :]
        values, eye = self._values(here, here.error), np.eye(5)
        high = np.full(values.shape, PENALTY)
        if not self.minimax:
            errors = here.errors / (here.error + ERROR_FLOOR)[:, None]
            hessian = np.swapaxes(slopes, 1, 2) @ slopes + damping[:, None, None] * eye
            gradient = (errors[:, None, :] @ slopes)[:, 0]
            return SoftProgram(hessian, gradient, values, kept, np.zeros_like(high), high), scale
        hessian = np.zeros((len(scale), 6, 6))
        metric = np.swapaxes(slopes, 1, 2) @ slopes + METRIC_FLOOR * eye
        hessian[:, :5, :5] = damping[:, None, None] * metric
        hessian[:, 5, 5] = LEVEL_DAMPING
        gradient = np.zeros((len(scale), 6))
        gradient[:, 5] = 1.0
        jacobian = np.zeros((*values.shape, 6))
        size = slopes.shape[1]
        jacobian[:, :size, :5] = np.sign(here.errors)[..., None] * slopes
        jacobian[:, :size, 5] = -1.0
        jacobian[:, size:, :5] = kept
        high[:, :size] = MOST_SHARE
        scale = np.concatenate([scale, np.ones((len(scale), 1))], axis=1)
        return SoftProgram(hessian, gradient, values, jacobian, np.zeros_like(high), high), scale

    def _promise(self, here: _Point, step: FloatArray) -> FloatArray:
        """How much less (k,) the merit is by the linearised errors and constraints."""
        level = here.error + ERROR_FLOOR
        errors = here.errors + matvec(here.by_x, step[:, :5])
        if self.minimax:
            less = (here.error - np.abs(errors).max(axis=1)) / level
        else:
            less = (here.error**2 - (errors**2).sum(axis=1)) / (2 * level**2)
        broken = np.maximum(here.kept + matvec(here.kept_by_x, step[:, :5]), 0.0).sum(axis=1)
        return np.asarray(less + PENALTY * (here.broken - broken))


def at_bounds(generators: Generator) -> NDArray[np.bool_]:
    """Which of generators (k,) have a link of the greatest or the least size allowed."""
    size = np.abs(np.log(generators.sizes)).max(axis=-1)
    return np.asarray(np.abs(size - np.log(MOST_SIZE)) < AT_BOUND * np.log(MOST_SIZE))


def _generator(x: FloatArray, side: FloatArray) -> Generator:
    a, r, b = np.exp(x[:, :3]).T
    return Generator(a, r, b, x[:, 3], x[:, 4], side)


def _errors(here: Generator, task: FunctionTask) -> tuple[FloatArray, FloatArray]:
    """The errors (k, N) of generators at the pairs, and their derivatives (k, N, 5)."""
    error = here.error(task.inputs, task.outputs)
    theta = here.input_phase[:, None] + task.inputs
    phi = here.output_phase[:, None] + task.outputs + error
    a, r, b = (v[:, None] for v in (here.input_link, here.coupler, here.output_link))
    between = theta - phi
    by_phi = -2 * b * np.sin(phi) - 2 * a * b * np.sin(between)
    jacobian = np.empty((*error.shape, 5))
    jacobian[..., 0] = -a * (2 * a - 2 * np.cos(theta) - 2 * b * np.cos(between)) / by_phi
    jacobian[..., 1] = 2 * r * r / by_phi
    jacobian[..., 2] = -b * (2 * b + 2 * np.cos(phi) - 2 * a * np.cos(between)) / by_phi
    jacobian[..., 3] = -(2 * a * np.sin(theta) + 2 * a * b * np.sin(between)) / by_phi
    jacobian[..., 4] = -1.0
    return error, jacobian
