"""The nearest coupler curves, from many start values at once: Levenberg and Marquardt's method.

Untimed, each task point counts by its distance from the curve.  Its crank angle t is eliminated:
the derivative of the distance by the dimensions is that of the curve along its normal, with t
fixed (the foot of the normal moves along the curve).  Feet are followed from step to step, so that
they keep the order in which they began.  Timed, both components count, and the crank angles are
given but for one phase.

Sizes are bounded: without bounds some paths run away to infinitely long links.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.curves.crank_linkages import G1, G2, SIZE, A, B, C, CrankLinkages, R, along
from burmester.curves.curve_kernel import normal_equations
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of, pairs_of
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import solve

__all__ = ["CurveFit", "PathTarget", "descend"]

START_DAMPING = 1e-2  # in units of the squared columns of the Jacobian
MIN_DAMPING, MAX_DAMPING = 1e-12, 1e8
SETTLED = 1e-13  # relative gain of the cost below which a step is the last
FOOT_STEPS = 2  # Newton's steps towards the foot of the normal after each step of the dimensions
MAX_TURN = 0.3  # radians; the most that a foot goes in one step
MOST, LEAST = 40.0, 0.01  # lengths of links, in radii of gyration of the task's points
FARTHEST = 80.0  # the same, of a fixed pivot from the task's middle
BUILT_WEIGHT = 10.0  # of squared cosines and logarithms, in squared radii of gyration a point
FULLNESS = 1e-4  # least margin by which a crank turns fully, in sums of all lengths


class PathTarget(NamedTuple):
    """Points (n,) of a path as complex numbers, about 1 in size, and what else is asked.

    share: (n,), square roots of weights; turns: the crank goes all the way round;
    timing: (n,), crank angles but for one phase, or None.
    transmission: the least transmission angle at the feet, or over the whole turn, in radians, and
    ratio: the longest link over the shortest; what they are missed by counts much.
    """

    points: ComplexArray
    share: FloatArray
    turns: bool
    timing: FloatArray | None = None
    transmission: float | None = None
    ratio: float = math.inf


class CurveFit(NamedTuple):
    """Linkages (k,), the crank angles (k, n) of their feet, and the sums of squares (k,)."""

    linkages: CrankLinkages
    t: FloatArray
    cost: FloatArray


class _Point(NamedTuple):
    """Linkages, crank angles, and the normal equations there, in units `scale` (k, m)."""

    z: FloatArray
    assembly: FloatArray
    t: FloatArray
    cost: FloatArray
    scale: FloatArray
    normal: FloatArray
    gradient: FloatArray


def descend(start: CurveFit, target: PathTarget, steps: int) -> CurveFit:
    """The fits after at most so many steps; those that do not assemble keep an infinite cost."""
    first = _point(start.linkages, start.t, target, None)

    def attempt(rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> Attempt[_Point]:
        eye = np.eye(here.gradient.shape[-1])
        step = -solve(here.normal + damping[:, None, None] * eye, here.gradient) / here.scale
        linkages = CrankLinkages(_bounded(here.z + step[:, :SIZE], target.turns), here.assembly)
        t = here.t if target.timing is None else here.t + step[:, SIZE:]
        there = _point(linkages, t, target, here.scale)
        with np.errstate(invalid="ignore"):
            better = there.cost < here.cost
            idle = better & (here.cost - there.cost <= SETTLED * here.cost)
        damping = np.where(better, np.maximum(damping / 5, MIN_DAMPING), damping * 4)
        return Attempt(there, better, damping, idle | (damping > MAX_DAMPING))

    rows = np.flatnonzero(np.isfinite(first.cost))
    ends, _ = damped_descent(attempt, first, rows, damping=START_DAMPING, max_steps=steps)
    return CurveFit(CrankLinkages(ends.z, ends.assembly), ends.t, ends.cost)


def _point(
    linkages: CrankLinkages, t: FloatArray, target: PathTarget, scale: FloatArray | None
) -> _Point:
    sums = _timed_sums if target.timing is not None else _distance_sums
    t, cost, gradient, normal = sums(linkages, t, target)
    if target.transmission is not None:
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            lack, slope = _not_as_built(linkages, t, target)
        swapped = np.nan_to_num(np.swapaxes(slope, -1, -2))
        normal[:, :SIZE, :SIZE] += swapped @ np.swapaxes(swapped, -1, -2)
        gradient[:, :SIZE] += (swapped @ np.nan_to_num(lack)[..., None])[..., 0]
        cost = cost + (lack * lack).sum(axis=1)
    if target.turns:
        cost = np.where(linkages.turns_fully(FULLNESS / 2), cost, np.inf)
    cost = np.where(np.isfinite(cost), cost, np.inf)
    columns = np.sqrt(np.diagonal(normal, axis1=-2, axis2=-1))
    floor = 1e-9 * columns.max(axis=-1, keepdims=True) + np.finfo(float).tiny
    columns = np.maximum(columns, floor)
    scale = columns if scale is None else np.maximum(scale * 0.7, columns)
    normal = normal / scale[:, :, None] / scale[:, None, :]
    return _Point(linkages.dimensions, linkages.assembly, t, cost, scale, normal, gradient / scale)


def _distance_sums(
    linkages: CrankLinkages, t: FloatArray, target: PathTarget
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The crank angles of the feet, sums of squares (k,), gradients (k, 9), normal equations."""
    number = len(linkages)
    feet_at, cost = np.array(t, dtype=np.float64, order="C"), np.empty(number)
    gradient, normal = np.empty((number, SIZE)), np.empty((number, SIZE, SIZE))
    points = np.column_stack([target.points.real, target.points.imag, target.share])
    normal_equations(
        linkages.dimensions,
        linkages.assembly,
        points,
        feet_at,
        FOOT_STEPS,
        MAX_TURN,
        cost,
        gradient,
        normal,
    )
    return feet_at, cost, gradient, normal


def _timed_sums(
    linkages: CrankLinkages, t: FloatArray, target: PathTarget
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The same at given crank angles, of both components; the phase is the tenth unknown."""
    places = linkages.at(t)
    gap, v = places.point - target.points, places.velocity
    with np.errstate(invalid="ignore", over="ignore"):
        cost = ((gap.real**2 + gap.imag**2) * target.share**2).sum(axis=-1)
        ones = np.ones_like(v)
        parts = [
            np.concatenate([linkages.derivatives(places, d), along(d, v)[..., None]], axis=-1)
            * target.share[:, None]
            for d in (ones, 1j * ones)
        ]
        residual = np.concatenate([gap.real * target.share, gap.imag * target.share], axis=1)
    sound = np.isfinite(cost)
    jacobian = np.where(sound[:, None, None], np.concatenate(parts, axis=1), 0.0)
    residual = np.where(sound[:, None], residual, 0.0)
    jacobian, residual = np.nan_to_num(jacobian), np.nan_to_num(residual)
    swapped = np.swapaxes(jacobian, -1, -2)
    return t, cost, (swapped @ residual[..., None])[..., 0], swapped @ jacobian


def _not_as_built(
    linkages: CrankLinkages, t: FloatArray, target: PathTarget
) -> tuple[FloatArray, FloatArray]:
    """What linkages (k,) lack in transmission and proportions (k, m), and derivatives (k, m, 9).

    Transmission by the cosine of the angle between coupler and follower, (b² + r² - |D|²)/(2 b r),
    at the feet, or where the pin of the crank is nearest to G2 and farthest from it.
    """
    assert target.transmission is not None
    z = linkages.dimensions
    weight = math.sqrt(BUILT_WEIGHT * len(target.points))
    g1, g2 = complex_of(z[:, G1])[:, None], complex_of(z[:, G2])[:, None]
    a, b, r = z[:, A, None], z[:, B, None], z[:, R, None]
    if target.turns:
        t = np.angle(g2 - g1) + np.array([0.0, np.pi])
    crank = np.exp(1j * t)
    to = g2 - g1 - a * crank
    cosine = (b * b + r * r - np.abs(to) ** 2) / (2 * b * r)
    lack = np.maximum(np.abs(cosine) - math.cos(target.transmission), 0.0) * weight
    slope = np.zeros((*lack.shape, SIZE))
    slope[..., 0], slope[..., 1] = to.real / (b * r), to.imag / (b * r)
    slope[..., 2], slope[..., 3] = -slope[..., 0], -slope[..., 1]
    slope[..., A] = along(to, crank) / (b * r)
    slope[..., B], slope[..., R] = 1 / r - cosine / b, 1 / b - cosine / r
    slope *= (np.sign(cosine) * (lack > 0) * weight)[..., None]
    if not math.isfinite(target.ratio):
        return lack, slope
    links = np.stack(linkages.lengths(), axis=-1)
    longest, shortest = links.argmax(axis=-1), links.argmin(axis=-1)
    rows = np.arange(len(links))
    over = np.log(links[rows, longest] / links[rows, shortest]) - math.log(target.ratio)
    along_ground = (g2 - g1)[:, 0] / links[:, 0] ** 2
    by_link = np.zeros((len(links), 4, SIZE))  # derivatives of the logarithms
    by_link[:, 0, G2] = pairs_of(along_ground)
    by_link[:, 0, G1] = -by_link[:, 0, G2]
    for number, at in enumerate((A, B, R), start=1):
        by_link[:, number, at] = 1 / z[:, at]
    both = (by_link[rows, longest] - by_link[rows, shortest]) * (over > 0)[:, None] * weight
    lack = np.concatenate([lack, np.maximum(over, 0.0)[:, None] * weight], axis=1)
    return lack, np.concatenate([slope, both[:, None]], axis=1)


def _bounded(z: FloatArray, turns: bool) -> FloatArray:
    """Dimensions (k, 9) within the bounds, the crank turning fully where asked."""
    out = z.copy()
    for at in (G1, G2, C):
        size = np.linalg.norm(out[:, at], axis=-1, keepdims=True)
        out[:, at] *= np.minimum(1.0, FARTHEST / np.maximum(size, LEAST))
    out[:, A : R + 1] = np.clip(out[:, A : R + 1], LEAST, MOST)
    return _with_full_turn(out) if turns else out


def _with_full_turn(z: FloatArray) -> FloatArray:
    """The nearest dimensions, to first order, with which the crank turns fully.

    Each of the three sums of `fullness` is linear in the lengths, and changes by one per unit of
    each length, so that a quarter of what lacks goes to each.
    """
    for _ in range(3):
        to = z[:, G2] - z[:, G1]
        g = np.linalg.norm(to, axis=-1)
        a, b, r = z[:, A], z[:, B], z[:, R]
        side, total = np.sign(g - a), g + a + b + r
        signs = np.stack(
            [
                np.stack([-np.ones_like(g), -np.ones_like(g), np.ones_like(g), np.ones_like(g)], 1),
                np.stack([side, -side, -np.ones_like(g), np.ones_like(g)], 1),
                np.stack([side, -side, np.ones_like(g), -np.ones_like(g)], 1),
            ],
            axis=1,
        )
        lengths = np.stack([g, a, b, r], axis=1)
        lack = FULLNESS * total[:, None] - (signs @ lengths[..., None])[..., 0]
        worst = lack.argmax(axis=1)
        most = np.take_along_axis(lack, worst[:, None], axis=1)
        if not (most > 0).any():
            break
        sign = np.take_along_axis(signs, worst[:, None, None], axis=1)[:, 0]
        new = lengths + np.maximum(most, 0) * sign / 4
        z = z.copy()
        stretch = (new[:, 0] - g)[:, None] * to / np.maximum(g, LEAST)[:, None] / 2
        z[:, G1] -= stretch
        z[:, G2] += stretch
        z[:, A : R + 1] = np.maximum(new[:, 1:], LEAST)
    return z
