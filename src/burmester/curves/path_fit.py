"""The linkages whose coupler point comes nearest to many points, with or without their timing.

Untimed, starts are the curves of the atlas that are like the path; timed, also every locally best
linkage of the poses that the timing makes of the points (`timed_paths`).  All are refined by their
true distances, the better ones longer.  A search: that no better linkage exists is not proved.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from burmester.curves.atlas import Likeness, likenesses
from burmester.curves.crank_linkages import CrankLinkages
from burmester.curves.curve_descent import CurveFit, PathTarget, descend
from burmester.curves.timed_paths import timed_starts
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.numerics.arrays import FloatArray, complex_of, even_numbers
from burmester.numerics.bundles import concatenate, take
from burmester.numerics.weights import weights_of_mean_one
from burmester.progress import goes_on, step

__all__ = [
    "cranks_like_path",
    "cranks_near_points",
    "linkages_near_points",
    "linkages_transmitting_well",
]

MAX_SEARCHED_POINTS = 60  # a search takes so many, evenly chosen; the last refinement takes all
# Steps of a round of refinement, and number of the best linkages that go on after it.
ROUNDS = ((8, 300), (20, 100), (100, 40))
STARTS = 800  # curves of the atlas that are refined
MORE_STEPS = 80  # with all points, where the search took some
LAST, LAST_STEPS = 6, 400  # the best curves are refined to their end; valleys may be long
SAME_CURVE = 2e-3  # radii of gyration; curves that are nearer at all feet are one curve
SAME_SHARE = 0.3  # of the root mean square distance; the same while curves are still refined
# For each least transmission angle: starts, rounds as above, degrees by which a start may transmit
# worse, and margins, degrees and relative, by which the angle and the ratio are kept.
STARTS_OF_LEVEL, ROUNDS_OF_LEVEL = 120, ((8, 40), (20, 12), (60, 8))
LOWER, MARGIN, RATIO_MARGIN = 15.0, 0.2, 0.01
MOST_ALIKE, FEW_STEPS = 3000, 2  # curves of `cranks_like_path`, and their steps of refinement
KEPT = 12  # different curves that are given back


def linkages_near_points(
    points: FloatArray,
    *,
    closed: bool = False,
    crank_angles: FloatArray | None = None,
    weights: FloatArray | None = None,
    most: int = KEPT,
    starts: Sequence[tuple[LinkageBatch, FloatArray]] = (),
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages (k,) whose coupler point comes near to points (N, 2), the nearest first.

    The first dyad of each is the crank, and the coupler point is the origin of the body frame M.

    Parameters
    ----------
    points : (N, 2) array of float
        In the order in which they are traced, in the task's length unit; ten or more untimed.
    closed : bool
        The path leads from the last point back to the first, and the crank goes all the way round.
    crank_angles : (N,) array of float, optional
        The crank angles at the points but for one phase, in radians.
    weights : (N,) array of float, optional
        Of the squared distances.
    most : int
        The number of different curves at most.
    starts : sequence of (LinkageBatch, (k, N, 3) array of float)
        Further linkages to start from, with their places near the points.

    Returns
    -------
    linkages : LinkageBatch
        (k,)
    places : (k, N, 3) array of float
        The nearest places x, y, angle of the body to the points; timed, those at the crank angles.
    """
    linkages, t, _ = cranks_near_points(
        points, closed=closed, crank_angles=crank_angles, weights=weights, most=most, starts=starts
    )
    return linkages.batch(), linkages.rows(t)


def cranks_near_points(
    points: FloatArray,
    *,
    closed: bool = False,
    crank_angles: FloatArray | None = None,
    weights: FloatArray | None = None,
    most: int = KEPT,
    starts: Sequence[tuple[LinkageBatch, FloatArray]] = (),
) -> CurveFit:
    """The same as crank-driven linkages with the crank angles (k, N) at the points.

    Their cost is the weighted sum of squared distances, in the task's unit.
    """
    given = complex_of(np.asarray(points, dtype=np.float64))
    middle = given.mean()
    size = float(np.sqrt((np.abs(given - middle) ** 2).mean())) or 1.0
    every = (given - middle) / size
    share = np.sqrt(weights_of_mean_one(weights, every.shape))
    timing = None if crank_angles is None else np.asarray(crank_angles, dtype=np.float64)
    whole = PathTarget(every, share, closed, timing)
    index = even_numbers(len(every), MAX_SEARCHED_POINTS)
    part = PathTarget(every[index], share[index], closed, None if timing is None else timing[index])
    step("looking for coupler curves like the path")
    alike = likenesses(part.points, closed, STARTS)
    fits = [_started(alike, part)]
    for batch, rows in starts:
        own, t = CrankLinkages.of(batch, rows)
        own = own.moved(np.full(len(own), 1 / size), np.full(len(own), -middle / size))
        fits.append(CurveFit(own, t[:, index], np.zeros(len(own))))
    fit = fits[0] if len(fits) == 1 else concatenate(fits)
    if timing is not None:
        fit = _timed(fit, part)
    step("refining linkages to the points of the path")
    for number, (steps, kept) in enumerate(ROUNDS):
        fit = _best(descend(fit, part, steps), kept)
        if number:
            fit = _different(fit, part, kept, SAME_SHARE)
    if len(index) < len(every):
        fit = _best(descend(_at_all(fit, index, len(every)), whole, MORE_STEPS), len(fit.cost))
    fit = _different(fit, whole, max(most, LAST))
    last = descend(take(fit, slice(0, LAST)), whole, LAST_STEPS)
    fit = _best(concatenate([last, take(fit, slice(LAST, None))]), len(fit.cost))
    return _scaled(_different(fit, whole, most), size, middle)


def cranks_like_path(
    points: FloatArray, *, closed: bool = False, most: int = MOST_ALIKE, steps: int = FEW_STEPS
) -> CurveFit:
    """Linkages (k,) whose curves are like a path, hardly refined, so that they stay different.

    Start values where pivots or links are limited.
    """
    given = complex_of(np.asarray(points, dtype=np.float64))
    middle = given.mean()
    size = float(np.sqrt((np.abs(given - middle) ** 2).mean())) or 1.0
    every = (given - middle) / size
    index = even_numbers(len(every), MAX_SEARCHED_POINTS)
    alike = likenesses(every[index], closed, most)
    fit = CurveFit(alike.linkages, alike.t, np.zeros(len(alike.left)))
    target = PathTarget(every[index], np.ones(len(index)), closed)
    fit = _at_all(_best(descend(fit, target, steps), most), index, len(every))
    return _scaled(fit, size, middle)


def linkages_transmitting_well(
    points: FloatArray,
    levels_deg: Sequence[float],
    *,
    closed: bool = False,
    weights: FloatArray | None = None,
    ratio: float = math.inf,
    most: int = 3,
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages near points (N, 2) that have least transmission angles, as near as each can be.

    For each level the curves of the atlas like the path whose linkages nearly have it, and the
    linkages of the level before, are refined.  The angle is that between coupler and follower, over
    the whole turn of a closed path's crank, else at the points.

    levels_deg: rising, in degrees; ratio: the longest link over the shortest, at most.
    most: the number of linkages of each level at most.
    Returns them with their places (k, N, 3), as `linkages_near_points` does.
    """
    given = complex_of(np.asarray(points, dtype=np.float64))
    middle = given.mean()
    size = float(np.sqrt((np.abs(given - middle) ** 2).mean())) or 1.0
    every = (given - middle) / size
    share = np.sqrt(weights_of_mean_one(weights, every.shape))
    index = even_numbers(len(every), MAX_SEARCHED_POINTS)
    part = PathTarget(every[index], share[index], closed)
    alike = likenesses(part.points, closed, MOST_ALIKE)
    start = CurveFit(alike.linkages, alike.t, np.zeros(len(alike.left)))
    start = _best(descend(start, part, FEW_STEPS), MOST_ALIKE)
    least = np.degrees(start.linkages.least_transmission(None if closed else start.t))
    links = np.stack(start.linkages.lengths(), axis=-1)
    sane = links.max(axis=-1) <= ratio * links.min(axis=-1)
    kept: list[CurveFit] = []
    for number, level in enumerate(levels_deg, start=1):
        if not goes_on(number, len(levels_deg), "transmission angle", has_steps=True):
            break
        near = start.cost + np.where(sane & (least > level - LOWER), 0.0, np.inf)
        order = np.argsort(near, kind="stable")
        fit = concatenate([take(start, order[np.isfinite(near[order])][:STARTS_OF_LEVEL]), *kept])
        built = math.radians(level + MARGIN)
        target = part._replace(transmission=built, ratio=ratio * (1 - RATIO_MARGIN))
        for steps, number_kept in ROUNDS_OF_LEVEL:
            fit = _best(descend(fit, target, steps), number_kept)
        if len(fit.cost):
            kept.append(_different(fit, part, most))
    fits = concatenate(kept) if kept else take(start, slice(0, 0))
    fits = _scaled(_at_all(fits, index, len(every)), size, middle)
    return fits.linkages.batch(), fits.linkages.rows(fits.t)


def _scaled(fit: CurveFit, size: float, middle: complex) -> CurveFit:
    """Fits in the task's unit, from those about 1 in size."""
    number = len(fit.cost)
    linkages = fit.linkages.moved(np.full(number, size + 0j), np.full(number, middle))
    return CurveFit(linkages, fit.t, fit.cost * size**2)


def _started(alike: Likeness, target: PathTarget) -> CurveFit:
    """Curves of the atlas as start values; timed ones are fitted to the curve first, a little."""
    fit = CurveFit(alike.linkages, alike.t, np.zeros(len(alike.left)))
    if target.timing is None:
        return fit
    return _best(descend(fit, target._replace(timing=None), ROUNDS[0][0]), len(alike.left))


def _timed(fit: CurveFit, target: PathTarget) -> CurveFit:
    """Fits with the timing of a target, each by the phase that fits best, and the poses' own."""
    assert target.timing is not None
    linkages, t = timed_starts(target.points, target.timing)
    every = concatenate([fit, CurveFit(linkages, t, np.zeros(len(t)))])
    phase = np.angle(np.exp(1j * (every.t - target.timing)).mean(axis=-1))
    return every._replace(t=phase[:, None] + target.timing)


def _best(fit: CurveFit, most: int) -> CurveFit:
    """The best so many of the fits that assemble, the nearest first."""
    order = np.argsort(fit.cost, kind="stable")
    return take(fit, order[np.isfinite(fit.cost[order])][:most])


def _different(fit: CurveFit, target: PathTarget, most: int, share: float = math.inf) -> CurveFit:
    """Different curves (k,), the nearest of each, cognates being one.

    share: of the root mean square distance of the nearer one, at which they differ at the latest.
    What is on its way to a better end is then not taken for a good curve that it passes.
    """
    traced = fit.linkages.at(fit.t).point
    near = np.minimum(SAME_CURVE, share * np.sqrt(fit.cost / len(target.points)))
    kept: list[int] = []
    for k, curve in enumerate(traced):
        away = np.abs(traced[kept] - curve).max(axis=-1)
        if (away > near[kept]).all():
            kept.append(k)
        if len(kept) == most:
            break
    return take(fit, np.array(kept, dtype=np.intp))


def _at_all(fit: CurveFit, index: NDArray[np.intp], number: int) -> CurveFit:
    """Fits at an even part of the points, with crank angles (k, number) at all of them."""
    every = np.arange(number)
    t = np.stack([np.interp(every, index, row) for row in fit.t]) if len(fit.t) else fit.t
    return fit._replace(t=np.reshape(t, (len(fit.cost), number)))
