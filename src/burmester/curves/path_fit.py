"""The linkages whose coupler point comes nearest to many points, with or without their timing.

Untimed, starts are the curves of the atlas that are like the path; timed, also every locally best
linkage of the poses that the timing makes of the points.  All are refined by their
true distances, the better ones longer.  A search: that no better linkage exists is not proved.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.curves.atlas import likenesses
from burmester.curves.crank_linkages import CrankLinkages, timed_starts
from burmester.curves.curve_kernel import descend as descend_one_by_one
from burmester.fourbar.path_gaps import PathGaps, are_drawing
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import (
    ComplexArray,
    FloatArray,
    complex_of,
    concatenate,
    even_numbers,
    pairs_of,
    take,
    weights_of_mean_one,
)
from burmester.progress import goes_on, step
from burmester.tasks.pose_sample import PoseSample

# A search takes so many points, the refinement of what it finds so many, and the last steps all:
# so many feet of a linkage, in at least and at most so many steps.
MAX_SEARCHED_POINTS, MAX_FITTED_POINTS = 60, 200
FEET_BY_ALL, STEPS_BY_ALL = 200_000, (4, 400)
MOST_ALIKE, FEW_STEPS = 3000, 2  # curves of the atlas laid over the path, and steps that sort them
STARTS = 800  # curves of the atlas that are refined
# The same of open paths, and points times starts: many curves are like an arc of few points.
OPEN_STARTS, OPEN_WORK = 5000, 75_000
FURTHER_STEPS = 200  # of further starts, before they join
# Steps of a round of refinement, and the share of the starts that goes on after it.
ROUNDS = ((8, 3 / 8), (20, 1 / 8), (100, 1 / 20))
MORE_STEPS = 80  # with more points than the search took
LAST, LAST_STEPS = 12, 400  # the best curves are refined to their end; valleys may be long
NEARLY_SETTLED = 1e-6  # relative gain of the cost below which a step before that is the last
SAME_CURVE = 2e-3  # radii of gyration; curves that are nearer at all feet are one curve
SAME_SHARE = 0.3  # of the root mean square distance; the same while curves are still refined
# For each least transmission angle: starts, rounds as above, degrees by which a start may transmit
# worse, and margins, degrees and relative, by which the angle and the ratio are kept.  Of an open
# path the angle is asked for at the points and falls a little between them; of a timed one the
# points outweigh it.
STARTS_OF_LEVEL, ROUNDS_OF_LEVEL = 160, ((8, 60), (20, 20), (60, 12))
LOWER, MARGIN, WIDE_MARGIN, RATIO_MARGIN = 15.0, 0.2, 1.0, 0.01
# Of bulges that make no stray, where points are met, and at most: these are exceeded a little.
ALLOWED_SHARE, MOST_SHARE = 0.98, 0.94
KEPT = 12  # different curves that are given back
# Of the curves that come nearest, so many are refined towards the least greatest distance: rounds
# in which points weigh more by their distances, steps of each, and the least share of such weights.
TOWARDS_WORST, WEIGHINGS, WEIGHED_STEPS, LEAST_WEIGHT = 4, 20, 10, 1e-3
PASSED = 1e-9  # radii of gyration; points missed by less are passed


SETTLED = 1e-13  # relative gain of the cost below which a step is the last
AT_ONCE = 50  # linkages that descend between two looks at the time


@final
@dataclass(frozen=True, slots=True, eq=False)
class PathSearch:
    """A path that linkages are looked for near, and curves of the atlas that are like it.

    every: the path about its middle, in its radii of gyration.
    whole, part: the same by at most MAX_FITTED_POINTS, even along the path and in their number, of
    the weight of those that each stands for; and by MAX_SEARCHED_POINTS of these.
    fitted, searched: the numbers of these points.
    size, middle: that radius, and the middle, in the task's unit.
    alike: (k,), curves of the atlas laid over the part, the most alike first.
    """

    every: PathTarget
    whole: PathTarget
    part: PathTarget
    fitted: NDArray[np.intp]
    searched: NDArray[np.intp]
    size: float
    middle: complex
    alike: CurveFit

    @classmethod
    def of(
        cls,
        points: FloatArray,
        *,
        closed: bool = False,
        crank_angles: FloatArray | None = None,
        weights: FloatArray | None = None,
        any_order: bool = False,
    ) -> Self:
        """The search of a path.

        Parameters
        ----------
        points : (N, 2) array of float
            In the order in which they are traced, in the task's length unit; ten or more untimed.
        closed : bool
            The path leads from the last point back to the first, and the crank goes all the way
            round.
        crank_angles : (N,) array of float, optional
            The crank angles at the points but for one phase, in radians.
        weights : (N,) array of float, optional
            Of the squared distances.
        any_order : bool
            The points may be met in any order, so that none is a neighbour of another.
        """
        step("looking for coupler curves like the path")
        given = complex_of(np.asarray(points, dtype=np.float64))
        middle = complex(given.mean())
        size = float(np.sqrt((np.abs(given - middle) ** 2).mean())) or 1.0
        timing = None if crank_angles is None else np.asarray(crank_angles, dtype=np.float64)
        share = np.sqrt(weights_of_mean_one(weights, given.shape))
        every = PathTarget((given - middle) / size, share, closed, timing)
        whole, fitted = _sampled(every, MAX_FITTED_POINTS)
        some = even_numbers(len(fitted), MAX_SEARCHED_POINTS)
        part, searched = _at(whole, some), fitted[some]
        if not any_order and are_drawing(len(given), closed=closed, timed=timing is not None):
            whole, part = (each._replace(allowed=_allowed(each)) for each in (whole, part))
        linkages, t, _ = likenesses(part.points, closed, max(MOST_ALIKE, STARTS, OPEN_STARTS))
        alike = CurveFit(linkages, t, np.zeros(len(t)))
        return cls(every, whole, part, fitted, searched, size, middle, alike)

    def nearest(
        self, most: int = KEPT, starts: Sequence[tuple[CrankLinkages, FloatArray]] = ()
    ) -> CurveFit:
        """Linkages whose coupler point comes near to the points, at most so many curves.

        starts: further linkages (k,) to start from, with crank angles (k, N) near the points.
        Their crank angles are those of the nearest places, or the given ones; their cost is the
        weighted sum of squared distances, in the task's unit.  The nearest by it come first, and
        behind them those of the least greatest distance.
        """
        whole, part = self.whole, self.part
        fits, number = [self._started()], self._starts()
        for linkages, t in starts:
            smaller, none = np.full(len(linkages), 1 / self.size), np.zeros(len(linkages))
            own = linkages.moved(smaller + 0j, -self.middle * smaller)
            begun = CurveFit(own, t[:, self.searched], none)
            # They are few, and far from the best at first: a round among the others would end them.
            fits.append(_best(descend(begun, part, FURTHER_STEPS), len(none)))
        fit = concatenate(fits)
        if part.timing is not None:
            fit = _timed(fit, part)
        step("refining linkages to the points of the path")
        for steps, share in ROUNDS:
            kept = math.ceil(number * share)
            fit = _best(descend(fit, part, steps, settled=NEARLY_SETTLED), kept)
            if steps > ROUNDS[0][0]:
                fit = _different(fit, part, kept, SAME_SHARE)
        if len(part.points) < len(whole.points):
            begun = _at_others(fit, self.searched, self.fitted)
            fit = _best(descend(begun, whole, MORE_STEPS), len(fit.cost))
        fit = _different(fit, whole, max(most, LAST))
        last = descend(take(fit, slice(0, LAST)), whole, LAST_STEPS)
        fit = _best(concatenate([last, take(fit, slice(LAST, None))]), len(fit.cost))
        fit = _different(fit, whole, most)
        nearer = _towards_worst(take(fit, slice(0, TOWARDS_WORST)), whole)
        if len(whole.points) < len(self.every.points):
            every = np.arange(len(self.every.points))
            fit, nearer = (_at_others(each, self.fitted, every) for each in (fit, nearer))
            steps = int(np.clip(FEET_BY_ALL // len(self.every.points), *STEPS_BY_ALL))
            fit = _best(descend(fit, self.every, steps), len(fit.cost))
        nearer = descend(nearer, self.every, 0)  # to the feet
        return self._in_unit(concatenate([fit, _best(nearer, len(nearer.cost))]))

    def like_path(self) -> CurveFit:
        """Linkages whose curves are like the path, hardly refined, so that they stay different.

        Start values where pivots or links are limited.
        """
        every = np.arange(len(self.every.points))
        return self._in_unit(_at_others(self._sorted(), self.searched, every))

    def transmitting_well(
        self, levels_deg: Sequence[float], *, ratios: Sequence[float] = (math.inf,), most: int = 3
    ) -> CurveFit:
        """Linkages near the points that have least transmission angles, as near as each can be.

        For each ratio and level the curves of the atlas like the path whose linkages nearly have
        them, and the linkages of the level before, are refined.  The angle is that between coupler
        and follower, over the whole turn of a closed path's crank, else at the points.

        levels_deg: rising, in degrees; ratios: the longest link over the shortest, at most.
        most: the number of linkages of each level at most.
        """
        part, start = self.part, self._sorted()
        least = np.degrees(start.linkages.least_transmission(None if part.turns else start.t))
        links = np.stack(start.linkages.lengths(), axis=-1)
        spread = links.max(axis=-1) / links.min(axis=-1)
        margin = MARGIN if part.turns and part.timing is None else WIDE_MARGIN
        every = [(ratio, level) for ratio in ratios for level in levels_deg]
        kept: dict[float, list[CurveFit]] = {ratio: [] for ratio in ratios}
        for number, (ratio, level) in enumerate(every, start=1):
            if not goes_on(number, len(every), "transmission angle", has_steps=True):
                break
            good = (spread <= ratio) & (least > level - LOWER)
            near = start.cost + np.where(good, 0.0, np.inf)
            order = np.argsort(near, kind="stable")
            order = order[np.isfinite(near[order])][:STARTS_OF_LEVEL]
            fit = concatenate([take(start, order), *kept[ratio]])
            built = math.radians(level + margin)
            target = part._replace(transmission=built, ratio=ratio * (1 - RATIO_MARGIN))
            for steps, number_kept in ROUNDS_OF_LEVEL:
                fit = _best(descend(fit, target, steps, settled=NEARLY_SETTLED), number_kept)
            if len(fit.cost):
                kept[ratio].append(_towards_worst(_different(fit, part, most), target))
        fits = concatenate(sum(kept.values(), [take(start, slice(0, 0))]))
        fits = _at_others(fits, self.searched, np.arange(len(self.every.points)))
        return self._in_unit(descend(fits, self.every, 0))  # to the feet

    def _starts(self) -> int:
        """How many curves of the atlas are refined."""
        if self.part.turns:
            return STARTS
        return min(max(OPEN_WORK // len(self.part.points), STARTS), OPEN_STARTS)

    def _started(self) -> CurveFit:
        """Curves as start values; timed ones are fitted to the curve first, a little."""
        fit, part = take(self.alike, slice(0, self._starts())), self.part
        if part.timing is None:
            return fit
        return _best(descend(fit, part._replace(timing=None), ROUNDS[0][0]), len(fit.cost))

    def _sorted(self) -> CurveFit:
        """The curves of the atlas after a few steps, the nearest first."""
        fit, part = take(self.alike, slice(0, MOST_ALIKE)), self.part
        if part.timing is not None:
            fit = _timed(descend(fit, part._replace(timing=None), FEW_STEPS), part)
        return _best(descend(fit, part, FEW_STEPS), MOST_ALIKE)

    def _in_unit(self, fit: CurveFit) -> CurveFit:
        """Fits in the task's unit."""
        number = len(fit.cost)
        middle = np.full(number, self.middle)
        linkages = fit.linkages.moved(np.full(number, self.size + 0j), middle)
        return CurveFit(linkages, fit.t, fit.cost * self.size**2)


def _allowed(path: PathTarget) -> FloatArray:
    """How far arcs (g,) between its points may leave their chords in the search: (g, 2)."""
    gaps = PathGaps.of(pairs_of(path.points), closed=path.turns)
    met = ALLOWED_SHARE * gaps.allowed()
    return np.stack([met, np.maximum(met, MOST_SHARE * gaps.allowed(math.inf))], axis=-1)


def _sampled(path: PathTarget, most: int) -> tuple[PathTarget, NDArray[np.intp]]:
    """At most so many of the points of a path, and their numbers."""
    count = len(path.points)
    if count <= most:
        return path, np.arange(count)
    poses = Displacement(pairs_of(path.points), np.zeros(count))
    sample = PoseSample.of(poses, path.share**2, most)
    share = np.sqrt(sample.cells / sample.cells.mean())
    return _at(path, sample.index)._replace(share=share), sample.index


def _at(path: PathTarget, index: NDArray[np.intp]) -> PathTarget:
    """Some of the points of a path."""
    timing = None if path.timing is None else path.timing[index]
    return path._replace(points=path.points[index], share=path.share[index], timing=timing)


def _at_others(fit: CurveFit, known: NDArray[np.intp], wanted: NDArray[np.intp]) -> CurveFit:
    """Fits with crank angles at some points of a path, with crank angles (k, n) at others."""
    t = [np.interp(wanted, known, row) for row in fit.t]
    return fit._replace(t=np.reshape(t, (len(fit.cost), len(wanted))))


def _timed(fit: CurveFit, target: PathTarget) -> CurveFit:
    """Fits with the timing of a target, each by the phase that fits best, and the poses' own."""
    assert target.timing is not None
    linkages, t = timed_starts(target.points, target.timing)
    every = concatenate([fit, CurveFit(linkages, t, np.zeros(len(t)))])
    phase = np.angle(np.exp(1j * (every.t - target.timing)).mean(axis=-1))
    return every._replace(t=phase[:, None] + target.timing)


def _towards_worst(fit: CurveFit, target: PathTarget) -> CurveFit:
    """Fits (k,) of lesser greatest distances, by Lawson's weights (PhD thesis, UCLA, 1961)."""

    def away(fit: CurveFit) -> FloatArray:
        return np.asarray(np.abs(fit.linkages.at(fit.t).point - target.points)[0])

    out = [take(fit, slice(0, 0))]
    for k in range(len(fit.cost)):
        best = here = take(fit, [k])
        far, weight = away(here), target.share**2
        least = far.max()
        for _ in range(WEIGHINGS):
            if not far.max() > PASSED:
                break
            weight = weight * (far / far.max() + LEAST_WEIGHT)
            weight /= weight.mean()
            here = descend(here, target._replace(share=np.sqrt(weight)), WEIGHED_STEPS)
            if not np.isfinite(here.cost[0]):
                break
            far = away(here)
            if far.max() < least:
                best, least = here, far.max()
        out.append(best)
    return concatenate(out)


def _best(fit: CurveFit, most: int) -> CurveFit:
    """The best so many of the fits that assemble, the nearest first."""
    order = np.argsort(fit.cost, kind="stable")
    return take(fit, order[np.isfinite(fit.cost[order])][:most])


def _different(fit: CurveFit, target: PathTarget, most: int, share: float = math.inf) -> CurveFit:
    """Different curves (k,), the nearest of each; share: of the distance, at which they differ."""
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


class PathTarget(NamedTuple):
    """Points (n,) of a path as complex numbers, about 1 in size, and what else is asked.

    share: (n,), square roots of weights; turns: the crank goes all the way round;
    timing: (n,), crank angles but for one phase, or None.
    transmission: the least transmission angle at the feet, or over the whole turn, in radians, and
    ratio: the longest link over the shortest; what they are missed by counts much.
    unbroken: whether linkages have to assemble between the points of an open path as well.
    allowed: (g, 2), how far the arcs between neighbouring points may leave their chords where the
    points are met, and at most where they are missed, or None.
    """

    points: ComplexArray
    share: FloatArray
    turns: bool
    timing: FloatArray | None = None
    transmission: float | None = None
    ratio: float = math.inf
    unbroken: bool = True
    allowed: FloatArray | None = None


class CurveFit(NamedTuple):
    """Linkages (k,), the crank angles (k, n) of their feet, and the sums of squares (k,)."""

    linkages: CrankLinkages
    t: FloatArray
    cost: FloatArray


def descend(
    start: CurveFit, target: PathTarget, steps: int, *, settled: float = SETTLED
) -> CurveFit:
    """The fits after at most so many steps; those that do not assemble keep an infinite cost.

    Crank angles are those of the feet at the end.
    settled: relative gain of the cost below which a step is the last.
    Fits for which there is no time are measured as they begin.
    """
    number = len(start.cost)
    dimensions = np.array(start.linkages.dimensions, dtype=np.float64, order="C")
    assembly = np.array(start.linkages.assembly, dtype=np.float64)
    t, cost = np.array(start.t, dtype=np.float64, order="C"), np.empty(number)
    points = np.column_stack([target.points.real, target.points.imag, target.share])
    timing = np.empty(0) if target.timing is None else np.array(target.timing, dtype=np.float64)
    none = np.empty((0, 2))
    allowed = none if target.allowed is None else np.array(target.allowed, dtype=np.float64)
    cosine = 2.0 if target.transmission is None else math.cos(target.transmission)
    ratio = math.inf if target.transmission is None else target.ratio
    for at in range(0, number, AT_ONCE):
        some = slice(at, at + AT_ONCE)
        descend_one_by_one(
            dimensions[some],
            assembly[some],
            t[some],
            cost[some],
            points,
            timing,
            allowed,
            target.turns,
            target.unbroken and not target.turns,
            cosine,
            ratio,
            steps if goes_on(at + 1, number, "linkage") else 0,
            settled,
        )
    return CurveFit(CrankLinkages(dimensions, assembly), t, cost)
