"""The way down to the nearest circle: Newton's method in valleys that are narrow, long and bent.

Where the body turns little, or nearly as a parallelogram's coupler does, the sum of squared
distances hardly changes as both pivots move together.  The steps are made from a triangle of the
Jacobian, as its square would have half of the digits, and bend as the valley does.

Plain ways down are made by `circle_kernel`, which is compiled: one circle after the other, so what
becomes of a circle depends on its own task alone, to the last bit, whatever tasks it comes with.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_kernel import steps_down, sums_of_squares
from burmester.dyads.geometric_fit import DIVISOR_FLOOR, NEGLIGIBLE_GAIN, circle_terms
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage_batch import row_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, unique_index, where
from burmester.numerics.iteration import iterate, shortened
from burmester.numerics.linear_algebra import matvec
from burmester.progress import goes_on

MAX_NEWTON_STEPS = 60  # from each start
START_BITS = 20  # of a start's coordinates; no rounding of where it comes from is in these

MAX_VALLEY_STEPS = 240  # from each start, where the body turns little
SETTLED_STEP = 1e-9  # relative; a shorter step along a valley is the last one
ROUNDING = float(np.finfo(np.float64).eps)  # of a circle's size; a smaller distance is zero
SAME_DYAD = 1e-6  # relative; circles whose coordinates differ by less are one
MAX_LENGTH = 1e3  # times how far pivots are; a circle with greater coordinates is a line
FLAT_SINGULAR_VALUE = 1e-15  # share of the greatest; smaller ones are taken for this one
ROTATION_ROUNDING = 1e-28  # mean squared turn; a smaller one is rounding
FLAT_NOT_CONVEX = 1e-7  # the same where the sum of squares is not convex
ARM_FLOOR = 1e-100  # lengths; a pivot that meets its centre is as far from it
SHARPENING_STEPS = 40  # in the longest floating point; at most
MAX_LOST_STEPS = 4  # in a row without a gain, after which all digits are taken for restored
MAX_SHARPENING = 0.1  # of a dyad's size; a longer step does not remove rounding
MET_ROUNDING = 4.0  # units in the last place of a circle's size; within them it meets the poses


class CircleMinima(NamedTuple):
    """Circles z (m, 5), c, m, r, each a local minimum: by rising task, then by sum of squares.

    unfinished: (T,), how many ways down were given up where they were better already than the
    second minimum.
    """

    task: NDArray[np.intp]
    z: FloatArray
    unfinished: NDArray[np.intp]


class _Point(NamedTuple):
    """Circles z (k, 5), the terms of their distances, and whether they have come to rest (k,)."""

    z: FloatArray
    terms: tuple[FloatArray, ...]
    settled: NDArray[np.bool_]


def circle_minima(
    z: FloatArray,
    task: NDArray[np.intp],
    poses: Displacement,
    share: FloatArray,
    *,
    narrow: bool,
) -> CircleMinima:
    """The local minima of the sum of squares that circles (k, 5) of tasks (k,) lead to, each once.

    Newton's method; where the sum is not convex, Gauss and Newton's step; shortened until it
    helps.  A circle that grows so far that it is a slider is left out.
    poses, share: (T, N); narrow: whether valleys of one task are to be followed that keep half of
    the digits; that takes longer.
    """
    if narrow:
        descent = _narrow_descent(z, poses[0], share[0])
    else:
        longest = MAX_LENGTH * reach(poses, share)
        descent = plain_descent(steady_starts(z), task, poses, share, longest)
    once, unfinished = minima_of(descent, task, len(share))
    return CircleMinima(task[once], descent.z[once], unfinished)


def _narrow_descent(z: FloatArray, poses: Displacement, share: FloatArray) -> Descent:
    """The way down from circles (k, 5) to the poses (N,) along narrow valleys."""
    terms, longest = circle_terms(poses), MAX_LENGTH * float(reach(poses, share))

    def cost(terms: tuple[FloatArray, ...]) -> FloatArray:
        return np.asarray(terms[0] ** 2 @ share)

    def point(z: FloatArray) -> _Point:
        return _Point(z, terms(z), np.zeros(len(z), dtype=bool))

    def advance(_: NDArray[np.intp], here: _Point) -> tuple[_Point, NDArray[np.bool_]]:
        step, bent, convex, gain = _narrow_step(here.terms, share)
        before = cost(here.terms)
        # Newton's last steps gain so little that the sum would tell by its rounding only.
        negligible = convex & (gain < NEGLIGIBLE_GAIN * before)

        def worse(there: _Point) -> NDArray[np.bool_]:
            return np.asarray(~negligible & (cost(there.terms) > before))

        there = point(here.z + step + bent)
        failed = worse(there)
        if failed.any():
            straight, stuck = shortened(lambda step: point(here.z + step), step, worse)
            there = where(failed, where(stuck, here, straight), there)
            failed &= stuck
        size = 1 + np.abs(there.z).max(axis=-1)
        moved = np.abs(there.z - here.z).max(axis=-1)
        settled = (moved < SETTLED_STEP * size) | (before < (ROUNDING * size) ** 2)
        settled &= convex & (size <= longest)
        ended = settled | (failed & ~convex) | (size > longest)
        return there._replace(settled=settled), ended

    ends, ended_at = iterate(advance, point(z), np.arange(len(z)), MAX_VALLEY_STEPS)
    return Descent(ends.z, cost(ends.terms), ends.settled, ended_at)


def further_down(
    z: FloatArray, poses: Displacement, share: FloatArray, steps: int = MAX_NEWTON_STEPS
) -> Descent:
    """Circles (k, 5) after so many steps of the plain way down, at most, for poses (N,)."""
    one, longest = np.zeros(len(z), dtype=np.intp), MAX_LENGTH * reach(poses, share)
    return plain_descent(z, one, poses[None], share[None], np.atleast_1d(longest), steps=steps)


def minima_of(
    descent: Descent, task: NDArray[np.intp], tasks: int
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The minima to which circles (k,) of tasks (k,) came, each once: indices (m,).

    By task, then by rising sum of squares.  Also returns how many ways down of each task were
    given up, (tasks,), where they were better already than the second minimum.
    """
    order = np.lexsort((descent.ended_at, descent.cost, task))
    order = order[descent.settled[order]]
    count = np.bincount(task[order], minlength=tasks)
    column = np.arange(len(order)) - np.repeat(np.cumsum(count) - count, count)
    table = np.full((tasks, int(count.max(initial=0)), descent.z.shape[-1]), np.nan)
    table[task[order], column] = descent.z[order]
    order = order[unique_index(table, SAME_DYAD, "maximum")[task[order], column]]
    count = np.bincount(task[order], minlength=tasks)
    second = np.full(tasks, np.inf)
    two = count >= 2
    second[two] = descent.cost[order[(np.cumsum(count) - count)[two] + 1]]
    better = (descent.ended_at == 0) & (descent.cost < second[task])
    return order, np.bincount(task[better], minlength=tasks)


def reach(poses: Displacement, share: FloatArray) -> FloatArray:
    """How far away pivots are (*,), in units of what the best rotation leaves of the poses (*, N).

    That rest is of second order in the turn of the body.  1 where the body turns much.
    """
    turn = np.exp(1j * poses.angle)
    middle = (share * turn).sum(axis=-1, keepdims=True)
    spread = (share * np.abs(turn - middle) ** 2).sum(axis=-1)
    return np.asarray(np.maximum(1.0, 1 / np.maximum(spread, ROTATION_ROUNDING)))


def sharpened_circles(
    circles: RR, poses: Displacement, share: FloatArray
) -> tuple[RR, FloatArray, NDArray[np.bool_]]:
    """Circles (k,) with the digits restored that rounding took, by Newton's method.

    In the poses' own frames, where pivots may be nearer than in canonical ones, with distances
    in the machine's longest floating point (80 bits on x86, else 64).
    Returns the circles, their distances (k, N), and which have come to rest (k,).
    """
    long = np.longdouble
    d = poses.translation.astype(long)
    cos, sin = np.cos(poses.angle.astype(long)), np.sin(poses.angle.astype(long))
    one, zero = np.ones(poses.shape), np.zeros(poses.shape)
    c, s = np.asarray(cos, dtype=np.float64), np.asarray(sin, dtype=np.float64)
    first = np.stack([-one, zero, c, -s, zero], axis=-1)
    second = np.stack([zero, -one, s, c, zero], axis=-1)
    radius = np.array([0.0, 0.0, 0.0, 0.0, 1.0])

    def terms(z: NDArray[np.longdouble]) -> tuple[FloatArray, ...]:
        c1, c2, m1, m2, r = np.moveaxis(z, -1, 0)[..., None]
        a1, a2 = cos * m1 - sin * m2 + d[:, 0] - c1, sin * m1 + cos * m2 + d[:, 1] - c2
        arm = np.maximum(np.hypot(a1, a2), DIVISOR_FLOOR)
        distance, length, u1, u2 = (
            np.asarray(each, dtype=np.float64) for each in (arm - r, arm, a1 / arm, a2 / arm)
        )
        u1, u2 = u1[..., None], u2[..., None]
        return distance, u1 * first + u2 * second - radius, u1 * second - u2 * first, length

    z = row_of(circles).astype(long)
    here = terms(z)
    at_rest, share_of_step, lost = np.zeros(len(z), dtype=bool), np.ones(len(z)), 0
    for _ in range(SHARPENING_STEPS):
        step, bent, convex, _ = _narrow_step(here, share)
        size = np.abs(z).max(axis=-1, initial=0)
        short = convex & (np.abs(step).max(axis=-1, initial=0) < MAX_SHARPENING * size)
        at_rest |= convex & (np.abs(step).max(axis=-1, initial=0) < SETTLED_STEP * size)
        factor = np.where(short, share_of_step, 0.0)[:, None]
        # What is kept in the end are doubles, so their distances are compared.
        trial = (z + factor * step + factor**2 * bent).astype(np.float64).astype(long)
        there = terms(trial)
        better = there[0] ** 2 @ share < here[0] ** 2 @ share
        z, here = where(better, (trial, there), (z, here))
        share_of_step = np.where(better, 1.0, share_of_step / 4)
        lost = 0 if better.any() else lost + 1
        if at_rest.all() or lost == MAX_LOST_STEPS:
            break
    distance = here[0]
    kept = np.asarray(z, dtype=np.float64)
    zero = MET_ROUNDING * ROUNDING * (np.abs(kept).max(axis=-1, initial=0) + np.abs(d).max())
    at_rest |= np.asarray(np.sqrt(distance**2 @ share) < zero)
    return RR(kept[:, :2], kept[:, 2:4], kept[:, 4]), distance, at_rest


def _narrow_step(
    terms: tuple[FloatArray, ...], share: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], FloatArray]:
    """The same step with all digits.

    In coordinates in which all terms of the Hessian are at most one, by a triangle of the
    Jacobian: Gauss and Newton's matrix would lose half of the digits where the body turns little.
    Returns the steps (k, 5), what joins them to follow a curved valley (k, 5), whether the sum is
    convex (k,), and what the steps gain (k,).
    """
    distance, jacobian, tangent, arm = terms
    arm = np.maximum(arm, ARM_FLOOR)
    root = np.sqrt(share)[:, None]
    rows = np.concatenate([jacobian, distance[..., None]], axis=-1) * root
    missing = max(0, 6 - rows.shape[-2])
    if missing:
        rows = np.concatenate([rows, np.zeros((len(rows), missing, 6))], axis=-2)
    triangle = np.asarray(np.linalg.qr(rows, mode="r"))[:, :6]
    # Not where a pivot went beyond all measure: there no step is made.
    sound = np.isfinite(triangle).all(axis=(-2, -1))
    triangle = np.where(sound[:, None, None], triangle, 0.0)
    tangent = np.where(sound[:, None, None], tangent, 0.0)
    distance = np.where(sound[:, None], distance, 0.0)
    unit = np.maximum(np.linalg.norm(triangle[:, :, :5], axis=1), np.finfo(float).tiny)
    left, values, right = np.linalg.svd(triangle[:, :5, :5] / unit[:, None])
    values = np.maximum(values, FLAT_SINGULAR_VALUE * values[:, :1])
    turned = root * tangent @ (np.swapaxes(right, -1, -2) / unit[..., None])
    counted = (distance / arm)[..., None]
    scale = np.sqrt(np.finfo(float).tiny + values**2 + (np.abs(counted) * turned**2).sum(axis=-2))
    turned = turned / scale[:, None]
    hessian = np.swapaxes(counted * turned, -1, -2) @ turned
    hessian[:, range(5), range(5)] += (values / scale) ** 2
    sound &= np.isfinite(hessian).all(axis=(-2, -1))
    hessian[~sound] = np.eye(5)
    bend, axes = np.linalg.eigh(hessian)
    convex = sound & (bend[:, 0] > 0)
    gradient = (triangle[:, None, :5, 5] @ left)[:, 0] * values / scale
    steep = np.maximum(values, FLAT_NOT_CONVEX * values[:, :1]) / scale
    axes[~convex], bend[~convex] = np.eye(5), steep[~convex] ** 2
    along = (gradient[:, None] @ axes)[:, 0]

    def dimensions(along: FloatArray) -> FloatArray:
        """A step (k, 5) of the dimensions from one along the axes."""
        return np.asarray(((matvec(axes, along) / scale)[:, None] @ right)[:, 0] / unit)

    step = -dimensions(along / bend)
    # Half of what the distances change by in second order along the step, taken off again.
    second = share * matvec(tangent, step) ** 2 / arm
    gradient = matvec(right, (second[:, None] @ jacobian)[:, 0] / unit) / scale
    bent = -dimensions((gradient[:, None] @ axes)[:, 0] / bend) / 2
    slight = np.abs(bent * unit).max(axis=1) < np.abs(step * unit).max(axis=1)
    bent *= (convex & slight)[:, None]
    return step, bent, convex, (along**2 / bend).sum(axis=-1)


class Descent(NamedTuple):
    """Where circles (k,) ended: z (k, 5), c, m, r, with sums of squares (k,).

    settled: whether they came to rest at a minimum; ended_at: the step, from 1, 0 for no end.
    """

    z: FloatArray
    cost: FloatArray
    settled: NDArray[np.bool_]
    ended_at: NDArray[np.intp]


def plain_descent(
    z: FloatArray,
    task: NDArray[np.intp],
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
    count, angle = len(z), poses.angle
    x, y = np.moveaxis(poses.translation, -1, 0)
    seen = np.stack(np.broadcast_arrays(np.cos(angle), np.sin(angle), x, y, share), axis=1)
    ends, cost, run = np.array(z, dtype=float), np.empty(count), np.arange(count)
    settled, ended = np.zeros((2, count), dtype=np.uint8)
    ended_at = np.zeros(count, dtype=np.intp)
    sums_of_squares(ends, task, seen, cost)
    for number in range(1, steps + 1):
        if not len(run) or not goes_on(number, steps):
            break
        steps_down(run, ends, cost, task, seen, longest, settled, ended)
        ended_at[run[ended[run] > 0]] = number
        run = run[ended[run] == 0]
    return Descent(ends, cost, settled > 0, ended_at)


def steady_starts(z: FloatArray) -> FloatArray:
    """Circles (k, 5) to start from, with START_BITS of the greatest coordinate of each.

    Where the sum is not convex a way may turn by the last bit of its start: it would end elsewhere
    on another machine, or with another eigenproblem.
    """
    _, exponent = np.frexp(np.abs(z).max(axis=1, keepdims=True))
    return np.asarray(np.ldexp(np.round(np.ldexp(z, START_BITS - exponent)), exponent - START_BITS))
