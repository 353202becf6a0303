"""Solutions of one Alt-Burmester problem carried over to another, all of them in one batch.

Straight ways in points, turns of poses and pivots; Runge and Kutta's prediction of fourth order,
Newton's correction, steps that adapt to each path.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.linear_algebra import solve_where_regular
from burmester.points.alt_burmester import Positions, System, jet, reduced, system

__all__ = ["Paths", "polished", "tracked"]

FIRST_STEP: Final = 0.02  # of the way
ACCURACY: Final = 3e-4  # relative; Newton's first step on a prediction, beyond it the step was long
SETTLED: Final = 1e-9  # relative; Newton's last step on a point of a path
ROUNDED: Final = 1e-6  # the same where rounding keeps a near-singular point from settling
NEWTON_STEPS: Final = 3  # that correct a prediction, at most
MOST_STEPS: Final = 3000  # of a path
LEAST_STEP: Final = 1e-13  # of the way; a path that needs shorter ones is lost
GROWTH, CUT = 2.0, 0.2  # of a step to the next, at most and at least
SAFETY: Final = 0.8  # of the step that accuracy allows
ORDER: Final = 5  # of the error of one step
LAST_NEWTON_STEPS: Final = 6  # at the end


class Paths(NamedTuple):
    """The ends of paths.

    x: (n, 8); turns: (n, J); arrived: (n,); steps: (n,), how many each took.
    """

    x: ComplexArray
    turns: ComplexArray
    arrived: NDArray[np.bool_]
    steps: NDArray[np.int_]


class _Way(NamedTuple):
    """A straight way from one problem to another: start + s change, s from 0 to 1."""

    start: Positions
    change: Positions

    def at(self, s: FloatArray) -> Positions:
        """The positions at s (n,)."""
        return Positions(
            *(a + s[:, None] * b for a, b in zip(self.start, self.change, strict=True))
        )


def tracked(
    x: ComplexArray,
    turns: ComplexArray,
    start: Positions,
    end: Positions,
    *,
    accuracy: float = ACCURACY,
    watch: Callable[[float], object] | None = None,
) -> Paths:
    """Solutions x (n, 8) with turns (n, J) of a problem, carried over to another one.

    watch: called now and then with the share of paths that have ended.
    """
    x, turns, n = x.copy(), turns.copy(), len(x)
    way = _Way(start, Positions(*(b - a for a, b in zip(start, end, strict=True))))
    m = start.further_poses
    done, step = np.zeros(n), np.full(n, FIRST_STEP)
    steps, arrived, lost = np.zeros(n, dtype=int), np.zeros(n, dtype=bool), np.zeros(n, dtype=bool)
    for number in range(MOST_STEPS):
        run = np.flatnonzero(~(arrived | lost))
        if not len(run):
            break
        if watch is not None and number % 4 == 0:
            watch(float(done.mean()))
        s, here, there = done[run], x[run], turns[run]
        h = np.minimum(step[run], 1 - s)
        with np.errstate(all="ignore"):
            guess, guess_turns = _predicted(here, there, way, s, h)
            at = way.at(s + h)
            guess_turns[:, :m] = at.T
            good, miss, new, new_turns = _corrected(guess, guess_turns, at, accuracy)
            factor = np.clip(SAFETY * (accuracy / miss) ** (1 / ORDER), CUT, GROWTH)
        factor = np.where(np.isfinite(factor), factor, CUT)
        factor = np.where(good, factor, np.minimum(factor, 0.5))
        steps[run] += 1
        won = run[good]
        x[won], turns[won] = new[good], new_turns[good]
        done[won] = np.where(h >= 1 - s, 1.0, s + h)[good]
        arrived[won] = done[won] >= 1
        step[run] = h * factor
        lost[run] = ~arrived[run] & (step[run] < LEAST_STEP)
    return Paths(x, turns, arrived, steps)


def polished(
    x: ComplexArray, turns: ComplexArray, positions: Positions
) -> tuple[ComplexArray, ComplexArray, FloatArray]:
    """Solutions after Newton's steps, and the relative length (n,) of the shortest of these."""
    best = np.full(len(x), np.inf)
    out, out_turns = x.copy(), turns.copy()
    with np.errstate(all="ignore"):
        for _ in range(LAST_NEWTON_STEPS):
            dx, dt = _newton(x, turns, positions)
            length = _length(dx, dt, x, turns)
            x, turns = x + dx, turns + dt
            better = length < best
            out[better], out_turns[better], best[better] = x[better], turns[better], length[better]
    return out, out_turns, best


def _predicted(
    x: ComplexArray, turns: ComplexArray, way: _Way, s: FloatArray, h: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """Runge and Kutta's prediction at s + h."""

    def velocity(y: ComplexArray, t: ComplexArray, ahead: FloatArray) -> _Step:
        return _velocity(y, t, way.at(s + ahead), way.change)

    full, half = h[:, None], h[:, None] / 2
    k1 = velocity(x, turns, 0 * h)
    k2 = velocity(x + half * k1.x, turns + half * k1.turns, h / 2)
    k3 = velocity(x + half * k2.x, turns + half * k2.turns, h / 2)
    k4 = velocity(x + full * k3.x, turns + full * k3.turns, h)
    return (
        x + full / 6 * (k1.x + 2 * (k2.x + k3.x) + k4.x),
        turns + full / 6 * (k1.turns + 2 * (k2.turns + k3.turns) + k4.turns),
    )


class _Step(NamedTuple):
    """A step of the unknowns (n, 8) and of the turns (n, J)."""

    x: ComplexArray
    turns: ComplexArray


class _Right(NamedTuple):
    """Right sides: of the dyads (n, 2, J) and pivots (n, k, 2); the step of given turns."""

    dyads: ComplexArray
    pivots: ComplexArray
    turns: ComplexArray


def _velocity(
    x: ComplexArray, turns: ComplexArray, positions: Positions, change: Positions
) -> _Step:
    """How solutions move with the problem (Davidenko's equation)."""
    here, m = jet(x, turns, positions), positions.further_poses
    linear = system(x, turns, here, positions)
    right = -(here.fv * change.P + here.fw * change.Pb)
    right[..., :m] -= linear.by_turn[..., :m] * change.T
    return _solved(linear, _Right(right, np.stack([change.G, change.Gb], -1), change.T), positions)


def _newton(x: ComplexArray, turns: ComplexArray, positions: Positions) -> _Step:
    """Newton's step."""
    here = jet(x, turns, positions)
    linear = system(x, turns, here, positions)
    k = positions.pivots
    fixed = positions.G - (x[:, [0, 4]] + x[:, [2, 6]])[:, :k]
    conjugate = positions.Gb - (x[:, [1, 5]] + x[:, [3, 7]])[:, :k]
    still = np.zeros(positions.further_poses, dtype=complex)
    return _solved(linear, _Right(-here.f, np.stack([fixed, conjugate], -1), still), positions)


def _solved(linear: System, right: _Right, positions: Positions) -> _Step:
    """The step of a linear system; the turns of points follow by least squares from both dyads."""
    n, m = len(linear.matrix), positions.further_poses
    pivots = np.broadcast_to(right.pivots, (n, *right.pivots.shape[1:]))
    pivots = pivots.reshape(n, 2 * positions.pivots)
    side = np.concatenate([reduced(right.dyads, linear.by_turn, positions), pivots], axis=1)
    step, regular = solve_where_regular(linear.matrix, side)
    step[~regular] = np.nan
    own = (linear.rows[..., m:, :] * step.reshape(n, 2, 1, 4)).sum(axis=-1)
    rest, h = right.dyads[..., m:] - own, linear.by_turn[..., m:]
    free = (h.conj() * rest).sum(axis=1) / (h.real**2 + h.imag**2).sum(axis=1)
    return _Step(step, np.concatenate([np.broadcast_to(right.turns, (n, m)), free], axis=1))


def _corrected(
    x: ComplexArray, turns: ComplexArray, positions: Positions, accuracy: float
) -> tuple[NDArray[np.bool_], FloatArray, ComplexArray, ComplexArray]:
    """Predictions corrected: which are good, how far they were off, and the points (n, ...)."""
    first = last = np.full(len(x), np.inf)
    ready = np.zeros(len(x), dtype=bool)
    for number in range(NEWTON_STEPS):
        run = np.flatnonzero(~ready)
        if not len(run):
            break
        some = Positions(*(each[run] for each in positions))
        dx, dt = _newton(x[run], turns[run], some)
        length = _length(dx, dt, x[run], turns[run])
        before, last = last, last.copy()
        last[run] = length
        if number == 0:
            first = last
        x[run] += dx
        turns[run] += dt
        # Settled, or so small that the next step would be (Newton's steps square); or steps that
        # no longer shrink, at the floor that rounding sets near a singular point.
        slow = (last[run] > 0.1 * before[run]) & (last[run] < ROUNDED)
        bad = ~(first[run] < accuracy) & (number == 0)
        ready[run] = (
            (last[run] < SETTLED)
            | (last[run] < 1e-3 * first[run]) & (last[run] ** 2 < SETTLED * first[run])
            | slow
            | bad
        )
    good = ready & (first < accuracy)
    return good, first, x, turns


def _length(dx: ComplexArray, dt: ComplexArray, x: ComplexArray, turns: ComplexArray) -> FloatArray:
    """The length (n,) of steps, relative to each dyad and each turn."""
    size = 1 + np.abs(x.reshape(-1, 2, 4)).max(axis=-1, keepdims=True)
    far = (np.abs(dx).reshape(-1, 2, 4) / size).max(axis=(1, 2))
    if turns.shape[1]:
        far = np.maximum(far, (np.abs(dt) / np.abs(turns)).max(axis=1))
    return np.asarray(far)
