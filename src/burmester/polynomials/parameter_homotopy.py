"""All solutions of a polynomial system, by paths from a generic one of its shape that is solved.

`start_points.npz` holds all solutions of each shape (`bilinear_fit`) for one set of generic complex
parameters (found by monodromy, see `scripts/start_points`), and when the parameters are carried
over to those of a task, every isolated solution of the task is reached with probability one.

The ends are counted: paths that end far away belong to solutions at infinity.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray, take
from burmester.numerics.linear_algebra import solve_or_shortest
from burmester.polynomials.bilinear_fit import Parameters, Shape, equations, jacobian, newton_step

PREDICTION_TOLERANCE = 1e-3  # relative; a step whose prediction is farther off is tried shorter
CORRECTION_TOLERANCE = 1e-10  # relative; Newton's last step on a point of a path
NEWTON_STEPS = 3  # that correct a prediction
FIRST_STEP = 0.05  # of the way from one set of parameters to the other
STEP_GROWTH, STEP_CUT = 1.7, 3.0  # the factor after a good step; the divisor after a bad one
MIN_STEP = 1e-10  # of the way; a path that needs shorter ones has met a singular point
MAX_STEPS = 2000  # of a path, good or bad
MAX_SIZE = 1e7  # of a path's unknowns; a longer one is given up
# A path to infinity grows as a power of the way left; the power lies between these two.
MIN_INFINITY_RATE, MAX_INFINITY_RATE = 0.1, 5.0
MAX_DETOURS = 2  # other ways tried where paths were lost
RUNNING, LOST, ARRIVED, AWAY = -1, 0, 1, 2  # states of a path


def tracked_points(shape: Shape, target: Parameters) -> tuple[ComplexArray, NDArray[np.int_]]:
    """The ends (T, k, size) of all paths to systems (T,) of one shape, and their states (T, k)."""
    start, points = generic_solutions(shape.name)
    ends, state = _carried(shape, points, start, target)
    rng = np.random.default_rng(0)
    for _ in range(MAX_DETOURS):
        again = np.flatnonzero((state == LOST).any(axis=1))
        if not len(again):
            break
        # A path that came too near to infinity goes elsewhere if it begins elsewhere.
        phases = np.exp(2j * np.pi * rng.random(len(start)))
        other_start = Parameters(*(a * phase for a, phase in zip(start, phases, strict=True)))
        other_points, there = _carried(shape, points, start, _one(other_start))
        if (there != ARRIVED).any():
            continue
        other_ends, other_state = _carried(shape, other_points[0], other_start, take(target, again))
        fewer = (other_state == LOST).sum(axis=1) < (state[again] == LOST).sum(axis=1)
        ends[again[fewer]], state[again[fewer]] = other_ends[fewer], other_state[fewer]
    return ends, state


def _one(parameters: Parameters) -> Parameters:
    """One set of parameters with a leading axis."""
    return Parameters(*(a[None] for a in parameters))


def _carried(
    shape: Shape, points: ComplexArray, start: Parameters, target: Parameters
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """Points (k, size) carried over to targets (T,): ends (T, k, size) and states (T, k)."""
    tasks, count = len(target.square), len(points)
    each = np.repeat(np.arange(tasks), count)
    ends, state = follow(shape, np.tile(points, (tasks, 1)), _one(start), take(target, each))
    return ends.reshape(tasks, count, -1), state.reshape(tasks, count)


@cache
def generic_solutions(name: str) -> tuple[Parameters, ComplexArray]:
    """The generic parameters of a shape, and all solutions (k, size) there."""
    from importlib import resources  # noqa: PLC0415  tasks without limits do without it

    with (
        resources.files("burmester.polynomials").joinpath("start_points.npz").open("rb") as file,
        np.load(file, allow_pickle=False) as table,
    ):
        *parameters, points = (table[f"{name}/{part}"] for part in (*Parameters._fields, "points"))
    return Parameters(*parameters), points


# --- the system, its derivatives, and the way from one set of parameters to another


class _Way(NamedTuple):
    """Straight ways (P,) through the parameters: start + s change, s from 0 to 1."""

    start: Parameters
    change: Parameters

    def at(self, s: FloatArray) -> Parameters:
        """The parameters at s (P,)."""

        def moved(start: NDArray[Any], change: NDArray[Any]) -> NDArray[Any]:
            return np.asarray(start + s.reshape(-1, *(1,) * (start.ndim - 1)) * change)

        return Parameters(*map(moved, self.start, self.change))

    def velocity(self, shape: Shape, y: ComplexArray, s: FloatArray) -> ComplexArray:
        """How solutions y (P, size) at s (P,) move with s (Davidenko's equation)."""
        by_s = equations(shape, y, self.change, parameter_free=0.0)
        return -solve_or_shortest(jacobian(shape, y, self.at(s)), by_s)


def follow(
    shape: Shape, points: ComplexArray, start: Parameters, end: Parameters
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """Solutions (P, size) of the systems `start`, carried over to those of `end` (P or 1 each).

    A straight way in the parameters; Runge and Kutta's prediction, Newton's correction, steps that
    adapt.
    Returns the ends and their states (P,): ARRIVED, AWAY (to infinity) or LOST; which of the last
    two is decided by how fast a path runs when it is given up, a heuristic.
    """
    x = points.copy()
    count = len(x)
    start, end = (
        Parameters(*(np.broadcast_to(a, (count, *a.shape[1:])) for a in p)) for p in (start, end)
    )
    ways = _Way(start, Parameters(*(b - a for a, b in zip(start, end, strict=True))))
    # Multipliers grow at a singular point of the conditions; where these leave no freedom, that
    # means nothing but two solutions close together.
    watched = shape.unknowns if shape.size == 2 * shape.unknowns else shape.size
    done, step, state = np.zeros(count), np.full(count, FIRST_STEP), np.full(count, RUNNING)
    for _ in range(MAX_STEPS):
        run = np.flatnonzero(state == RUNNING)
        if not len(run):
            break
        way, s, y = take(ways, run), done[run], x[run]
        h = np.minimum(step[run], 1 - s)
        with np.errstate(all="ignore"):
            guess, first_velocity = _predicted(shape, way, y, s, h)
            corrected, p = guess, way.at(s + h)
            for _ in range(NEWTON_STEPS):
                last = newton_step(shape, corrected, p)
                corrected = corrected - last
            size = shape.sizes(corrected)
            settled = np.abs(last) < CORRECTION_TOLERANCE * size
            near = np.abs(corrected - guess) < PREDICTION_TOLERANCE * size
            good = (settled & near).all(axis=1)
        advanced = run[good]
        x[advanced], done[advanced] = corrected[good], (s + h)[good]
        step[run] = np.where(good, STEP_GROWTH * h, h / STEP_CUT)
        # A point at infinity of the end comes as a power of the way left, so at a steady rate; one
        # that is passed on the way comes much faster, and a singular point stands still.
        growth = np.abs(first_velocity) * (1 - s)[:, None] / shape.sizes(y)
        rate = growth[:, :watched].max(axis=1)
        to_infinity = (rate > MIN_INFINITY_RATE) & (rate < MAX_INFINITY_RATE)
        stop = (step[run] < MIN_STEP) | (shape.sizes(x[run])[:, 0] > MAX_SIZE)
        state[run[stop]] = np.where(to_infinity, AWAY, LOST)[stop]
        state[advanced[done[advanced] >= 1]] = ARRIVED
    state[state == RUNNING] = LOST
    return x, state


def _predicted(
    shape: Shape, way: _Way, y: ComplexArray, s: FloatArray, h: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """Runge and Kutta's prediction (P, size) at s + h, and the velocity at s."""
    half = h[:, None] / 2
    k1 = way.velocity(shape, y, s)
    k2 = way.velocity(shape, y + half * k1, s + h / 2)
    k3 = way.velocity(shape, y + half * k2, s + h / 2)
    k4 = way.velocity(shape, y + 2 * half * k3, s + h)
    return y + half / 3 * (k1 + 2 * k2 + 2 * k3 + k4), k1
