"""Dyads joined in pairs: every linkage refined, judged, and ranked by whether it works.

A linkage works where its coupler meets all poses on one circuit, on one branch of a drive, in
their order, and keeps to what is asked of it.  Where the closest linkage does not, the search goes
on under these conditions (`search`), so that the answer is not only what fails, and why.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from typing import Literal, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.accuracy import PoseError, error_frames, nearest, on_circuits, rows_of
from burmester.candidates import ROUNDING, FoundDyad, same_dyad
from burmester.conditions import Conditions, Kept, Together
from burmester.defects import Defect, Driven, Verdict, judge
from burmester.displacement import Displacement, FloatArray
from burmester.dyad import PP, RR, Dyad
from burmester.linkage import Linkage
from burmester.rounding import rounded
from burmester.search import Aim, linkages_that_work, links_of_map
from burmester.stack import DIMENSIONS, STACKED, LinkageStack
from burmester.task import Task
from burmester.tolerance import Spread, spread
from burmester.uncertainty import DyadUncertainty, covariance, pose_sigma, uncertainties
from burmester.unmet import Unmet, unmet

__all__ = ["FoundLinkage", "Pair", "Wish", "joined"]

Pair: TypeAlias = tuple[FoundDyad, FoundDyad]
Side: TypeAlias = Literal["first", "second"]

REACH = 0.1  # sizes of the motion; a pose missed by more is not met at all
TWICE = 2.0  # times the least greatest distance; one circuit may miss by so much for being one
ROUGH, FINE = 12, 48  # steps of refining, for all linkages and for those that come near
GOOD, NEAR = 4, 100.0  # those: so many, and all whose sum of squares is no more times the least
SHORTEST = 1e-6  # sizes; a ground link or a coupler shorter than this is none
DETERMINED = 0.05  # spans; pivots known worse than this are not determined
MANY, ENOUGH = 1000, 60  # poses; of more so many are refined for, or looked for linkages with
EXACT = 1e8  # weights: what an exact pose counts as, to say what its errors do
STRIDE, TOUCHING = 1e-7, 1e-9  # of difference quotients; of a limit that is touched
FIXED, MOVING = slice(0, 2), slice(2, 4)
FEW = 5  # linkages found under conditions are kept, at most
ROUNDED = 5  # linkages are rounded where that is asked, at most


@final
@dataclass(frozen=True, slots=True, eq=False)
class FoundLinkage:
    """A linkage made of two of the dyads found, refined as a whole, and what is to be said of it.

    dyads: with their dimensions in this linkage, the better driver first unless the task has two
        limits, whose order they keep; ids say from which of the dyads found they come.
    error: at the places where the coupler is for the poses, all on one circuit unless there is
        a circuit defect.
    verdict: circuit, branch and order for either driver.
    better: which dyad is the better driver, or the only one allowed.
    usable: whether it leads through all poses, driven by that dyad, and is as asked.
    unmet: what is asked of it and not so, driven by that dyad.
    sought: whether it was looked for under conditions, the closest ones not being usable.
    uncertainty: what errors of the poses leave open of both dyads.
    spread: of the error, where links and pivots are built within a tolerance.
    exact_error: that of the linkage before its dimensions were rounded, where that was asked.
    """

    id: str
    rank: int
    dyads: Pair
    linkage: Linkage
    error: PoseError
    verdict: Verdict
    better: Side
    usable: bool
    unmet: tuple[Unmet, ...] = ()
    sought: bool = False
    uncertainty: tuple[DyadUncertainty, DyadUncertainty] | None = None
    determined: bool = True
    spread: Spread | None = None
    exact_error: PoseError | None = None

    @property
    def driver(self) -> Side | None:
        """Which dyad drives; None where the linkage is not usable."""
        return self.better if self.usable else None

    @property
    def driven(self) -> Driven:
        """How it does with the better driver."""
        return self.verdict.first if self.better == "first" else self.verdict.second

    @property
    def defects(self) -> tuple[Defect, ...]:
        """Why it is not usable: of the linkage, and of its better driver."""
        return self.verdict.defects + self.driven.defects

    @property
    def led(self) -> Linkage:
        """The linkage with the better driver first."""
        return _led(self.linkage, self.better)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Wish:
    """How linkages are made of dyads.

    length: what a radian counts as in the task's unit.
    refine: whether all dimensions are refined; worst: for the greatest distance, not squares.
    tolerance: to which links and pivots are built, in the task's unit; None says nothing of it.
    step: to which lengths and pivots are rounded; stock: the lengths that links come in.
    """

    length: float
    refine: bool = True
    worst: bool = False
    tolerance: float | None = None
    step: float | None = None
    stock: tuple[float, ...] = ()


class _Candidates(NamedTuple):
    """Linkages (k,) with the rows (k, N, 3) of their places, and the pairs that they come from.

    own: the same in the task's own frames, where not a digit is to be lost.
    """

    stack: LinkageStack
    rows: FloatArray
    pairs: list[Pair]
    sought: bool = False
    own: LinkageStack | None = None

    def some(self, index: NDArray[np.intp]) -> _Candidates:
        """Those at the indices."""
        pairs = [self.pairs[k] for k in index]
        own = None if self.own is None else self.own[index]
        return _Candidates(self.stack[index], self.rows[index], pairs, self.sought, own)


def joined(
    task: Task, pairs: Sequence[Pair], wish: Wish, numbers: Sequence[int] | None = None
) -> tuple[FoundLinkage, ...]:
    """The linkages of pairs of dyads, those that work first, then by rising worst position error.

    task: with every pose once; numbers: what its poses are called (from 0), where some were left
    out as repeats.  Pairs with a PP dyad are passed over: they have no one drive.
    """
    pairs = [pair for pair in pairs if not any(isinstance(each.dyad, PP) for each in pair)]
    if not pairs:
        return ()
    if len(task.limits) < 2:  # pairs of the same kinds are looked at together
        kind = {each.id: STACKED.index(type(each.dyad)) for pair in pairs for each in pair}
        pairs = [(b, a) if kind[b.id] < kind[a.id] else (a, b) for a, b in pairs]
    judging = _Judging(task, _aim(task, wish), wish, numbers)
    start = judging.stacked(pairs)
    found = judging.told(_of_pairs(start, pairs, judging.aim, wish))
    closest = min(found, key=lambda each: each.error.worst, default=None)
    if wish.refine and closest is not None and not closest.usable:
        found = judging.ranked(found + _sought(start, pairs, judging, found))
    if wish.step is not None or wish.stock:
        found = judging.rounded(found)
    return tuple(
        replace(each, id=f"L{rank}", rank=rank) for rank, each in enumerate(found, start=1)
    )


def _aim(task: Task, wish: Wish) -> Aim:
    frames = error_frames(task.poses, wish.length)
    kept: tuple[Conditions, ...] = ()
    if task.limits:
        kept = tuple(
            Kept(side, task.limits[min(side, len(task.limits) - 1)], frames) for side in (0, 1)
        )
    return Aim(
        frames.see(task.poses),
        wish.length / float(frames.length),
        frames,
        task.requirements,
        kept,
        task.weights,
        task.exact,
        wish.worst,
    )


def _of_pairs(start: LinkageStack, pairs: list[Pair], aim: Aim, wish: Wish) -> _Candidates:
    """The pairs with their places, on one circuit where that is nearly as near as any."""
    every = np.arange(len(start))
    rows = rows_of(on_circuits(start, aim.poses, aim.length), aim.length)
    one = rows[every, np.nan_to_num(aim.cost(rows), nan=np.inf).argmin(axis=1)]
    places = nearest(Displacement(rows[..., :2], rows[..., 2] / aim.length), aim.poses, aim.length)
    best = rows_of(places, aim.length)
    wanted = rows_of(aim.poses, aim.length)
    away, least = (
        np.sqrt(np.nan_to_num(((each - wanted) ** 2).sum(axis=-1), nan=np.inf)).max(axis=1)
        for each in (one, best)
    )
    apart = away > np.maximum(TWICE * least, ROUNDING)
    both = apart & np.isfinite(away) & np.isfinite(least) & wish.refine
    index = np.concatenate([every, np.flatnonzero(both)])
    rows = np.concatenate([np.where(apart[:, None, None], best, one), one[both]])
    made = _Candidates(start[index], rows, [pairs[k] for k in index])
    return _refined(made, aim) if wish.refine else made


def _refined(made: _Candidates, aim: Aim) -> _Candidates:
    """The linkages refined, but for those that meet the poses up to rounding already.

    All of them by some steps, and those that come near by as many as it takes.
    """
    cost = aim.cost(made.rows)
    some = np.flatnonzero(cost > ROUNDING**2 * made.rows.shape[1])
    if not len(some):
        return made
    if (thin := aim.thinned(MANY)) is not aim:
        stack = _refined(made._replace(rows=thin.places(made.stack)), thin).stack
        return made._replace(stack=stack, rows=aim.places(stack))
    kept = Together(aim.kept) if aim.kept else None
    dimensions, rows = made.stack.dimensions.copy(), made.rows.copy()
    for steps in (ROUGH, FINE):
        stack = LinkageStack(made.stack.kinds[some], dimensions[some])
        refined = aim.refine(stack, rows[some], conditions=kept, worst=aim.worst, steps=steps)
        with np.errstate(invalid="ignore"):
            better = refined.met & (aim.worst | (aim.cost(refined.rows) <= cost[some]))
        dimensions[some[better]] = refined.stack.dimensions[better]
        rows[some[better]] = refined.rows[better]
        cost = aim.cost(rows)
        near = np.sort(np.nan_to_num(cost, nan=np.inf))[: min(GOOD, len(cost))]
        some = some[~refined.settled]
        some = some[cost[some] <= max(NEAR * near[0], near[-1])]
        if aim.worst or kept is not None or aim.exact is not None or not len(some):
            break
    return made._replace(stack=LinkageStack(made.stack.kinds, dimensions), rows=rows)


def _sought(
    start: LinkageStack, pairs: list[Pair], judging: _Judging, plain: list[FoundLinkage]
) -> list[FoundLinkage]:
    """Linkages that work and come nearer to the poses than the plain ones that do."""
    found: list[FoundLinkage] = []
    best = min((each.error.worst for each in plain if each.usable), default=np.inf)
    aim = judging.aim.thinned(ENOUGH)
    for stack, origin in _more(start, pairs, judging, best):
        more = linkages_that_work(stack, aim)
        if more is not None:
            index = np.flatnonzero(more.refined.met)
            found_stack, rows = more.refined.stack[index], more.refined.rows[index]
            if aim is not judging.aim:
                rows = judging.aim.places(found_stack)
            came = [origin[k] for k in more.pair[index]]
            told = judging.told(_Candidates(found_stack, rows, came, sought=True))
            found += [each for each in told if each.usable and each.error.worst < best][:FEW]
        if found:
            break
    return found


def _more(
    start: LinkageStack, pairs: list[Pair], judging: _Judging, best: float
) -> Iterator[tuple[LinkageStack, list[Pair]]]:
    """Where to start from: the pairs, and if nothing works so far, links of the pivot map."""
    yield start, pairs
    if np.isfinite(best) or judging.task.limits:
        return
    links = links_of_map(judging.aim.poses, judging.task.weights)
    own = {each.id: each for pair in pairs for each in pair}
    frames = judging.aim.frames
    map_ = [
        judging.dyad(f"M{number}", frames.circle_back(link[None])[0])
        for number, link in enumerate(links, start=1)
    ]
    more = [*combinations(map_, 2), *product(own.values(), map_)]
    if more:
        yield judging.stacked(more), more


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Judging:
    """What linkages are judged by."""

    task: Task
    aim: Aim
    wish: Wish
    numbers: Sequence[int] | None

    def stacked(self, pairs: Sequence[Pair]) -> LinkageStack:
        """Pairs of dyads in the frames in which they are judged."""
        linkages = [Linkage(first.dyad, second.dyad) for first, second in pairs]
        return LinkageStack.of(linkages).seen(self.aim.frames)

    def told(self, made: _Candidates) -> list[FoundLinkage]:
        """The linkages with all that is to be said of them, ranked."""
        made = made.some(np.flatnonzero(_sizable(made.stack)))
        own = made.stack.back(self.aim.frames) if made.own is None else made.own
        places = self.aim.frames.unseen(self._places(made.rows))
        errors = [PoseError.at(places[k], self.task.poses) for k in range(len(own))]
        verdicts = self._verdicts(own, places, errors)
        order = np.tile(np.arange(2), (len(own), 1))
        out = []
        for k, verdict in enumerate(verdicts):
            linkage, pair = own.linkage(k), made.pairs[k]
            better, missing, works = self._driver(linkage, verdict)
            if better == "second" and len(self.task.limits) < 2:
                order[k], pair, linkage = order[k, ::-1], pair[::-1], _led(linkage, better)
                verdict, better = Verdict(verdict.defects, verdict.second, verdict.first), "first"  # noqa: PLW2901
            dyads = self.dyad(pair[0], linkage.first), self.dyad(pair[1], linkage.second)
            said = (dyads, linkage, errors[k], verdict, better, works, missing, made.sought)
            out.append(FoundLinkage("", 0, *said))
        rows = np.arange(len(own))[:, None]
        led = LinkageStack(made.stack.kinds[rows, order], made.stack.dimensions[rows, order])
        return self.ranked(self._measured(out, led, made.rows))

    def ranked(self, found: list[FoundLinkage]) -> list[FoundLinkage]:
        """Those that work first, then by worst error; the same linkage once."""

        def order(each: FoundLinkage) -> tuple[bool, float]:
            worst = np.round(each.error.worst / (ROUNDING * self.wish.length))
            return not each.usable, float(worst)

        size = float(self.aim.frames.length)
        out: list[FoundLinkage] = []
        for each in sorted(found, key=order):  # stable: the order of the dyads stays
            if not any(_same(each.linkage, other.linkage, size) for other in out):
                out.append(each)
        return out

    def rounded(self, found: list[FoundLinkage]) -> list[FoundLinkage]:
        """The best of them with lengths and pivots rounded, judged again."""
        out: list[FoundLinkage] = []
        frames, wish = self.aim.frames, self.wish
        for each in found[:ROUNDED]:
            stack = LinkageStack.of([each.linkage]).seen(frames)
            rows = rows_of(frames.see(each.error.places), self.aim.length)[None]
            driver = np.array([int(each.better == "second")])
            own, rows = rounded(stack, rows, self.aim, wish.step, wish.stock, driver)
            new = self.told(_Candidates(own.seen(frames), rows, [each.dyads], each.sought, own))
            if not new:
                lost = Unmet("rounding", "rounded so coarsely its pivots would fall together")
                new = [replace(each, usable=False, unmet=(*each.unmet, lost))]
            out += [replace(one, exact_error=each.error) for one in new]
        return self.ranked(out)

    def dyad(self, origin: FoundDyad | str, dyad: Dyad) -> FoundDyad:
        """A dyad with its own distance from the poses, called as that from which it comes."""
        miss = np.abs(dyad.residual(self.task.poses))
        rms, worst = float(np.sqrt((miss**2).mean())), float(miss.max())
        if isinstance(origin, str):
            return FoundDyad(origin, dyad, rms, worst, False)
        return replace(origin, dyad=dyad, rms_error=rms, max_error=worst)

    def _places(self, rows: FloatArray) -> Displacement:
        return Displacement(rows[..., :2], rows[..., 2] / self.aim.length)

    def _verdicts(
        self, own: LinkageStack, places: Displacement, errors: list[PoseError]
    ) -> list[Verdict]:
        shape = (len(own), self.task.poses.shape[0])
        position = np.array([error.position for error in errors]).reshape(shape)
        turn = np.array([error.angle for error in errors]).reshape(shape)
        asked, within = self.task.requirements, self.task.requirements.within
        missed = position if within is not None else np.hypot(position, self.wish.length * turn)
        reach = REACH * float(self.aim.frames.length) if within is None else within
        numbers = list(range(shape[1])) if self.numbers is None else list(self.numbers)
        names = self.task.names or [str(number + 1) for number in numbers]
        out: list[Verdict | None] = [None] * len(own)
        for index, linkage in own.alike():
            verdicts = judge(
                linkage,
                places[index],
                missed=missed[index],
                reach=reach,
                length=self.wish.length,
                names=names,
                any_order=asked.any_order,
            )
            for k, verdict in zip(index, verdicts, strict=True):
                out[k] = _numbered(verdict, numbers)
        return [verdict for verdict in out if verdict is not None]

    def _driver(self, linkage: Linkage, verdict: Verdict) -> tuple[Side, tuple[Unmet, ...], bool]:
        """The better driver, what is unmet with it, and whether it leads through the poses."""
        asked = self.task.requirements
        sides: tuple[Side, ...] = ("first", "second")
        if asked.driver in sides:
            sides = (asked.driver,)

        def judged(side: Side) -> tuple[tuple[float, ...], tuple[Unmet, ...]]:
            driven = verdict.first if side == "first" else verdict.second
            missing = unmet(_led(linkage, side), driven, asked, self.task.length_unit)
            wrong = len(driven.defects), len(missing)
            weak = -float(np.nan_to_num(driven.least_over_range))
            return (*map(float, wrong), 0.0 if driven.turns_fully else 1.0, weak), missing

        ranked = {side: judged(side) for side in sides}
        best = min(sides, key=lambda side: ranked[side][0])
        (defects, missing, *_), reasons = ranked[best]
        return best, reasons, not (verdict.defects or defects or missing)

    def _measured(
        self, found: list[FoundLinkage], stack: LinkageStack, rows: FloatArray
    ) -> list[FoundLinkage]:
        """The linkages with what errors of the poses, and of building, do to them."""
        sound = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
        if not len(sound):
            return found
        unit, places = float(self.aim.frames.length), self._places(rows[sound])
        position, angle = pose_sigma(self.task)
        weights = self.task.weights
        if self.task.exact is not None:
            weights = np.where(self.task.exact, EXACT, 1.0 if weights is None else weights)
        held = _held_by(self.aim, stack[sound], rows[sound])
        spreads = covariance(
            stack[sound], places, self.aim.length, (position / unit, angle), weights, held
        )
        regions = uncertainties(spreads, stack[sound], places, unit)
        built = None
        if self.wish.tolerance is not None:
            tolerance = self.wish.tolerance / unit
            built = spread(stack[sound], self.aim.poses, places, self.aim.length, tolerance)
        span = np.linalg.norm(np.ptp(self.task.poses.translation, axis=0))
        size = max(float(span), self.wish.length)
        out = list(found)
        for at, k in enumerate(sound):
            determined = max(each.half_width for each in regions[at]) <= DETERMINED * size
            out[k] = replace(out[k], uncertainty=regions[at], determined=determined)
            if built is not None:
                out[k] = replace(out[k], spread=built.one(at, unit))
        return out


def _led(linkage: Linkage, driver: Side) -> Linkage:
    """With the dyad that drives first."""
    return Linkage(linkage.second, linkage.first) if driver == "second" else linkage


def _sizable(stack: LinkageStack) -> NDArray[np.bool_]:
    """Whether ground links and couplers (k,) between pins have a length."""
    kinds, z = stack.kinds, stack.dimensions
    ground, coupler = (np.linalg.norm(z[:, 1, at] - z[:, 0, at], axis=-1) for at in (FIXED, MOVING))
    return np.asarray(
        ((kinds == 1).any(axis=1) | (ground > SHORTEST))
        & ((kinds == 2).any(axis=1) | (coupler > SHORTEST))
    )


def _same(a: Linkage, b: Linkage, size: float) -> bool:
    """Whether two linkages are one, whichever dyad comes first."""
    pairs = ((a.first, b.first), (a.second, b.second)), ((a.first, b.second), (a.second, b.first))
    return any(all(_alike(x, y, size) for x, y in pair) for pair in pairs)


def _alike(a: Dyad, b: Dyad, size: float) -> bool:
    if isinstance(a, RR) and isinstance(b, RR):
        size = max(size, float(a.radius))
    return same_dyad(a, b, size)


def _numbered(verdict: Verdict, numbers: Sequence[int]) -> Verdict:
    """With the poses' own numbers in the defects."""

    def told(defects: tuple[Defect, ...]) -> tuple[Defect, ...]:
        return tuple(replace(each, poses=tuple(numbers[i] for i in each.poses)) for each in defects)

    first, second = (
        replace(each, defects=told(each.defects)) for each in (verdict.first, verdict.second)
    )
    return Verdict(told(verdict.defects), first, second)


def _held_by(aim: Aim, stack: LinkageStack, rows: FloatArray) -> FloatArray | None:
    """The limits that hold linkages (k,): their derivatives (k, m, 10), zero where they do not."""
    if not aim.kept:
        return None
    keep = Together(aim.kept)
    every = np.arange(len(stack))
    value, equal = keep(stack, rows, every)
    slope = np.zeros((*value.shape, 2 * DIMENSIONS))
    flat = stack.dimensions.reshape(len(stack), -1)
    for j in range(2 * DIMENSIONS):
        moved = flat.copy()
        moved[:, j] += STRIDE
        nudged = LinkageStack(stack.kinds, moved.reshape(stack.dimensions.shape))
        slope[..., j] = (keep(nudged, rows, every)[0] - value) / STRIDE
    return np.where((equal | (value > -TOUCHING))[..., None], slope, 0.0)
