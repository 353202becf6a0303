"""Linkages evaluated: their errors, defects, uncertainty, requirements and standard; ranked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import FoundDyad
from burmester.errors import Finding
from burmester.fourbar.defects import Driven, Verdict, judge
from burmester.fourbar.dyad import Dyad
from burmester.fourbar.instantaneous import crossing_angle
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch, pin_distances
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.linkages.judged_places import NearestPlaces, best_places
from burmester.linkages.misses import Misses
from burmester.numerics.arrays import FloatArray, even_numbers, take, weights_or_ones
from burmester.progress import goes_on, step
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.target import Target
from burmester.refinement.tolerance_boxes import counted_error, poses_counted, shares_used
from burmester.requirements.table import shortcomings
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import in_words_of_tolerances
from burmester.verdicts.found_linkage import (
    FoundLinkage,
    Pair,
    Side,
    numbered_pair,
    with_driver_first,
)
from burmester.verdicts.limit_check import clearance_of, limit_violations, too_close
from burmester.verdicts.quality import Quality
from burmester.verdicts.ranking import ranked
from burmester.verdicts.requirement_check import (
    degenerate_defects,
    mistimed,
    places_between,
    standard_of,
    timing_error,
    violations,
)
from burmester.verdicts.tolerances import sensitivity_bound, spread
from burmester.verdicts.tracing import stray_defects, stray_shortcomings
from burmester.verdicts.uncertainty import (
    DETERMINED_SHARE,
    covariance,
    links_covariance,
    pose_sigma,
    possible_types,
    uncertainties,
)
from burmester.wording import count

MIN_LINK = 1e-6  # motion sizes; linkages with a shorter ground link or coupler are dropped
EXACT_WEIGHT = 1e8  # weight of an exact pose in the covariance
ACTIVE_LIMIT = 1e-9  # lengths; a limit nearer than this is active
DRIVEN_FROM_THE_OTHER_SIDE = {"crank-rocker": "rocker-crank", "rocker-crank": "crank-rocker"}
SIDES: tuple[Side, Side] = ("first", "second")
# Sensitivity and uncertainty are computed at so many places at most, evenly chosen: a sum over an
# even part of a motion is that part of the sum over all.
MAX_PLACES_OF_QUALITY = 2000
PLACES_AT_ONCE = 200_000  # number of places judged at once; bounds the memory
MAX_ROUNDED = 5  # round at most this many linkages


def pair_of(first: Dyad, second: Dyad, poses: Displacement) -> Pair:
    """The dyads of a linkage, D1 and D2, with their errors at poses (N,)."""
    one, two = (
        FoundDyad.of(id, dyad, poses, minimum=False) for id, dyad in (("D1", first), ("D2", second))
    )
    return one, two


class Candidates(NamedTuple):
    """Linkages (k,) with the rows (k, N, 3) of their places, and the pairs of dyads behind them.

    from_search: (k,), which come from the search for defect-free linkages, or whether all do.
    own: the same linkages in the task's own frames, with all their digits.
    drivers: (k,), the sides that drive, where that is settled; else the better one does.
    both: (k, 2, N, 3), the nearest places on each circuit, where they are known.
    """

    batch: LinkageBatch
    rows: FloatArray
    pairs: list[Pair]
    from_search: NDArray[np.bool_] | bool = False
    own: LinkageBatch | None = None
    drivers: NDArray[np.intp] | None = None
    both: FloatArray | None = None

    @classmethod
    def of_own_dyads(
        cls, batch: LinkageBatch, rows: FloatArray, own: LinkageBatch, *, from_search: bool
    ) -> Self:
        """Linkages (k,), also in the task's own frames, of dyads that no other one has: D1, ..."""
        pairs = [numbered_pair(own.linkage(k), 2 * k + 1) for k in range(len(own))]
        return cls(batch, rows, pairs, from_search, own)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """The evaluation of linkages against a problem and its target."""

    problem: SynthesisProblem
    target: Target

    @property
    def task(self) -> Task:
        """The task, with every pose once."""
        return self.problem.task

    def sampled(self, sample: PoseSample) -> Evaluation:
        """The same by a sample of the poses."""
        return Evaluation(self.problem.sampled(sample), self.target.sampled(sample))

    def stacked(self, pairs: Sequence[Pair]) -> LinkageBatch:
        """Pairs of dyads, in the frames of the target."""
        linkages = [Linkage(first.dyad, second.dyad) for first, second in pairs]
        return LinkageBatch.of(linkages).to_canonical(self.target.frames)

    def evaluate(self, candidates: Candidates) -> list[FoundLinkage]:
        """The linkages with errors, verdicts, drivers and uncertainties, ranked."""
        return ranked(self.evaluated(candidates), self.problem)

    def evaluated(self, candidates: Candidates) -> list[FoundLinkage]:
        """The same in their own order."""
        found: list[FoundLinkage] = []
        at_once = max(1, PLACES_AT_ONCE // self.target.poses.shape[0])
        for at in range(0, len(candidates.batch), at_once):
            some = take(candidates, np.arange(at, min(at + at_once, len(candidates.batch))))
            found += self._with_uncertainty(*self._where_best(some))
        return found

    def members(
        self, candidates: Candidates, *, quality: bool = True, clearance: bool = True
    ) -> list[FoundLinkage]:
        """The same for linkages of a family, in their order: no pose determines their pivots.

        Where they are, or where they trace a path; where they are not inside the tolerances, at
        their places deepest inside.
        quality, clearance: whether they are told; each takes a third of the time.
        """
        candidates = take(candidates, np.flatnonzero(sizable(candidates.batch)))
        if self.target.path is not None:
            candidates = self._along_path(candidates)
        elif (boxes := self.target.boxes) is not None:
            rows = candidates.rows.copy()
            outside = np.flatnonzero(~(boxes.boxes.share(rows).max(axis=-1) <= 1))
            rows[outside] = self.target.places(candidates.batch[outside], on_both=True)
            candidates = candidates._replace(rows=rows)
        return self._judged(candidates, quality=quality, clearance=clearance)[0]

    def _where_best(
        self, candidates: Candidates
    ) -> tuple[list[FoundLinkage], LinkageBatch, FloatArray]:
        """As `_judged`, each linkage at those of its places that count (`judged_places`).

        Along a path, at its places that trace it.  Where there are tolerances, at its places
        deepest inside, or at those given or nearest to the poses if they are inside as well: these
        may be on another branch, or in another order.
        """
        candidates = take(candidates, np.flatnonzero(sizable(candidates.batch)))
        if self.target.path is not None:
            return self._judged(self._along_path(candidates))
        own, frames = candidates.own, self.target.frames
        if own is None:  # judged by the numbers that are told, to the last digit
            own = candidates.batch.from_canonical(frames)
            candidates = candidates._replace(own=own, batch=own.to_canonical(frames), both=None)
        every, boxes = np.arange(len(candidates.batch)), self.target.boxes
        index, rows, _ = NearestPlaces.of(candidates.batch, self.target, candidates.both).ways()
        if boxes is not None:
            deepest = self.target.places(candidates.batch, on_both=True)
            index, rows = np.r_[every, index], np.concatenate([candidates.rows, rows])
            inside = boxes.boxes.share(rows).max(axis=-1) <= 1
            index = np.r_[every, index[inside]]
            rows = np.concatenate([deepest, rows[inside]])
        found, batch, rows = self._judged(take(candidates, index)._replace(rows=rows))
        ways = [np.flatnonzero(index == k) for k in every]
        best = [int(way[best_places([found[at] for at in way])]) for way in ways]
        return [found[at] for at in best], batch[best], rows[best]

    def _along_path(self, candidates: Candidates) -> Candidates:
        """The candidates at their places that trace the path."""
        traced, cranks = self.target.traced(candidates.batch)
        return candidates._replace(rows=traced, drivers=cranks)

    def _judged(
        self, candidates: Candidates, *, quality: bool = True, clearance: bool = True
    ) -> tuple[list[FoundLinkage], LinkageBatch, FloatArray]:
        """The linkages at their places, as found and as a batch (dyads alike), and the places."""
        own = (
            candidates.batch.from_canonical(self.target.frames)
            if candidates.own is None
            else candidates.own
        )
        places = self.target.frames.from_canonical(self.target.places_of(candidates.rows))
        errors, shares = self.errors(places), self.shares(places)
        sensitivity = self.sensitivities(own, places)
        verdicts = self.verdicts(own, places, errors, sensitivity)
        at_angles = self.target.at_angles(candidates.batch, candidates.rows)
        combined = self.target.combined_error(at_angles) * float(self.target.frames.length)
        if self.target.path is not None:
            combined = np.array([each.worst for each in errors])
        bounds, length = standard_of(self.task), partial(length_of, task=self.task)
        searched = np.broadcast_to(candidates.from_search, len(own))
        distance = np.abs(own.distances(self.task.poses))
        rms, worst = np.sqrt((distance**2).mean(axis=-1)).tolist(), distance.max(axis=-1).tolist()
        sides = np.tile(np.arange(2), (len(own), 1))
        out = []
        for k, verdict in enumerate(verdicts):
            linkage = own.linkage(k)
            settled = None if candidates.drivers is None else SIDES[candidates.drivers[k]]
            driver, missing, usable = self.driver(linkage, verdict, settled)
            room = clearance_of(linkage, verdict, driver, self.problem) if clearance else None
            missing += (close := too_close(room, self.problem))
            usable = usable and not close
            both = linkage.first, linkage.second
            one, two = (
                replace(origin, dyad=dyad, rms_error=error, max_error=most)
                for origin, dyad, error, most in zip(
                    candidates.pairs[k], both, rms[k], worst[k], strict=True
                )
            )
            dyads = one, two
            if driver == "second" and len(self.task.limits) < 2:  # the preferred driver first
                sides[k], dyads, driver = (1, 0), (two, one), "first"
                linkage = with_driver_first(linkage, "second")
                verdict = Verdict(verdict.defects, verdict.second, verdict.first)  # noqa: PLW2901
            found = FoundLinkage(
                0,
                dyads,
                linkage,
                float(combined[k]),
                verdict,
                driver,
                usable,
                id="",
                error=errors[k],
                violations=missing,
                from_search=bool(searched[k]),
                clearance=room,
                within_tolerance=None if shares is None else shares[k],
                task=self.problem.given,
            )
            found = replace(found, timing_error=timing_error(found.driven.inputs, self.task))
            if found.task.loads is not None:
                from burmester.loads.load_figures import loaded  # noqa: PLC0415  few have loads

                found = loaded(found)
            below = shortcomings(bounds, found.figures, length)
            out.append(replace(found, shortcomings=tuple(each.message for each in below)))
        for k, strays in enumerate(stray_shortcomings(out, self.task)):
            if strays:
                out[k] = replace(out[k], shortcomings=(*out[k].shortcomings, *strays))
        if quality:
            out = self._with_quality(out, places, sensitivity)
        return out, candidates.batch.in_order(sides), candidates.rows

    def rounded(self, found: list[FoundLinkage]) -> list[FoundLinkage]:
        """The first MAX_ROUNDED linkages with rounded dimensions, evaluated and ranked again.

        Fewer of them where the time is over, but one at least.
        """
        from burmester.refinement.rounding import rounded  # noqa: PLC0415  seldom asked for

        out: list[FoundLinkage] = []
        frames, options = self.target.frames, self.problem.options
        some = found[:MAX_ROUNDED]
        step(f"rounding the dimensions of {count(len(some), 'linkage')}", whole=False)
        for number, each in enumerate(some, start=1):
            if out and not goes_on(number, len(some), "linkage", has_steps=True):
                break
            batch = LinkageBatch.of([each.linkage]).to_canonical(frames)
            rows = self.target.rows_at(each.error.places)[None]
            driver = np.array([int(each.preferred_driver == "second")])
            own, rows = rounded(
                batch,
                rows,
                self._target_of_rounding(each),
                step=options.rounding_step,
                stock=options.stock_lengths,
                driver=driver,
            )
            new = self.evaluate(
                Candidates(own.to_canonical(frames), rows, [each.dyads], each.from_search, own)
            )
            if not new:
                lost = Finding("rounding", "rounded so coarsely its pivots would fall together")
                new = [replace(each, usable=False, violations=(*each.violations, lost))]
            # Rounded dimensions are exact, whatever the poses leave open; and what few poses leave
            # open of a family is no uncertainty, rounded or not.
            out += [replace(one, error_before_rounding=each.error, other_types=()) for one in new]
            if each.uncertainty is None:
                out[-1] = replace(out[-1], uncertainty=None, determined=each.determined)
        return ranked(out, self.problem)

    def _target_of_rounding(self, found: FoundLinkage) -> Target:
        """What a linkage is rounded by: the poses, free angles being its own.

        Where it is to meet them exactly, or at given angles of its crank, it is to keep its motion.
        """
        target, tolerances = self.target, self.task.tolerances
        if tolerances is None:
            return target
        timed = target.path is not None and target.path.crank_angles is not None
        own = poses_counted(found.error.places, self.task)
        if timed or not tolerances.gives_room:
            target, own = target.without_boxes, found.error.places
        return replace(target, poses=target.frames.to_canonical(own))

    def with_spreads(self, found: list[FoundLinkage]) -> list[FoundLinkage]:
        """The linkages with the spread of errors as built, where a tolerance is given."""
        tolerance = self.problem.options.manufacturing_tolerance
        index = [k for k, each in enumerate(found) if np.isfinite(each.error.worst)]
        if tolerance is None or not index:
            return found
        step(f"building {count(len(index), 'linkage')} within the tolerance", whole=False)
        target, unit, out = self.target, float(self.target.frames.length), list(found)
        batch = LinkageBatch.of([found[k].linkage for k in index]).to_canonical(target.frames)
        places = target.places_of(np.stack([target.rows_at(found[k].error.places) for k in index]))
        spreads = spread(batch, target.poses, places, target.length, tolerance / unit)
        for at, k in enumerate(index):
            out[k] = replace(out[k], spread=spreads.one(at, unit))
        return out

    def errors(self, places: Displacement) -> list[PoseError]:
        """The errors of linkages (k,) at places (k, N) in the task's own frames."""
        return [counted_error(places[k], self.task) for k in range(len(places.angle))]

    def shares(self, places: Displacement) -> FloatArray | None:
        """How much of its tolerance each component uses at places (k, N): (k, N, 3), if any."""
        if self.task.tolerances is None:
            return None
        return shares_used(places, self.task, float(self.target.frames.length))

    def verdicts(
        self,
        own: LinkageBatch,
        places: Displacement,
        errors: list[PoseError],
        sensitivity: FloatArray,
    ) -> list[Verdict]:
        """The verdicts on linkages (k,) in the task's own frames, at their places (k, N).

        sensitivity: (k,), as `sensitivities` has it.
        """
        size, radian = float(self.target.frames.length), self.problem.length_per_radian
        misses = Misses.of(places, errors, self.task, radian, size=size)
        numbers = self.problem.pose_numbers
        given = self.task.names or ("",) * len(numbers)
        names = [name or str(number + 1) for name, number in zip(given, numbers, strict=True)]
        verdicts = judge(
            own,
            places,
            missed=misses.missed,
            reach=misses.reach,
            length=misses.length,
            names=names,
            any_order=self.task.requirements.any_order,
            order_slack=misses.slack,
        )
        if misses.shares is not None:
            verdicts = [
                in_words_of_tolerances(verdict, share, names)
                for verdict, share in zip(verdicts, misses.shares, strict=True)
            ]
        verdicts = stray_defects(own, verdicts, self.task, names)
        if list(numbers) != list(range(len(numbers))):
            verdicts = [_with_numbers(verdict, numbers) for verdict in verdicts]
        if self.target.path is not None and self.target.path.closed:
            verdicts = [_all_round(own.linkage(k), each) for k, each in enumerate(verdicts)]
        degenerate = degenerate_defects(own, sensitivity, self.problem)
        return [
            replace(verdict, defects=verdict.defects + more) if more else verdict
            for verdict, more in zip(verdicts, degenerate, strict=True)
        ]

    def driver(
        self, linkage: Linkage, verdict: Verdict, settled: Side | None = None
    ) -> tuple[Side, tuple[Finding, ...], bool]:
        """The preferred driver, what is violated, and whether the linkage is usable.

        Requirements depend on the driver, limits do not.
        """
        asked, stated = self.task.requirements, self.problem.given.requirements
        sides: tuple[Side, ...] = SIDES if settled is None else (settled,)
        if asked.driver in sides:
            sides = (asked.driver,)

        def merit(side: Side) -> tuple[tuple[float, ...], tuple[Finding, ...]]:
            driven = verdict.first if side == "first" else verdict.second
            missing = violations(
                with_driver_first(linkage, side), driven, stated, self.task.length_unit
            )
            if self.task.timing is not None:
                missing += mistimed(driven.inputs, self.task, self.problem.pose_numbers)
            return driven.rank(len(missing)), missing

        ranked = {side: merit(side) for side in sides}
        best = min(sides, key=lambda side: ranked[side][0])
        (defects, *_), reasons = ranked[best]
        size, unit = float(self.target.frames.length), self.task.length_unit
        between = None
        if any(each.line for each in self.task.limits):  # pins have to keep the travel of rails
            driven = verdict.first if best == "first" else verdict.second
            between = places_between(with_driver_first(linkage, best), driven)
        reasons += limit_violations(linkage, self.task.limits, size, unit, between)
        return best, reasons, not (verdict.defects or defects or reasons)

    def sensitivities(self, own: LinkageBatch, places: Displacement) -> FloatArray:
        """The sensitivity (k,) of linkages in the task's own frames at places (k, N); or nan."""
        target, out = self.target, np.full(len(own), np.nan)
        some = even_numbers(places.shape[1], MAX_PLACES_OF_QUALITY)
        here = target.places_of(target.rows_at(places))[:, some]
        exist = np.flatnonzero(np.isfinite(here.angle).all(axis=1))
        here, there = here[exist], own[exist].to_canonical(target.frames)
        # Within tolerances a place need not be the nearest to its pose: errors count about it.
        poses = target.poses[some] if target.boxes is None else here
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            out[exist] = sensitivity_bound(there, poses, here, target.length).max(axis=-1)
        return out

    def qualities(
        self,
        linkages: Sequence[Linkage],
        places: Displacement,
        driven: Sequence[Driven],
        sensitivity: FloatArray | None = None,
    ) -> list[Quality]:
        """The quality of linkages (k,), the driver first, at places (k, N) in the task's frames.

        sensitivity: (k,), where it is known.
        """
        batch = LinkageBatch.of(linkages)
        if sensitivity is None:
            sensitivity = self.sensitivities(batch, places)
        every = Quality.of(batch, places, driven, sensitivity, size=self.problem.motion_size)
        return [take(every, k) for k in range(len(linkages))]

    def _with_quality(
        self, found: list[FoundLinkage], places: Displacement, sensitivity: FloatArray
    ) -> list[FoundLinkage]:
        """The linkages with their quality, where their places (k, N) exist."""
        sound = [k for k, each in enumerate(found) if math.isfinite(each.combined_error)]
        if not sound:
            return found
        driven = [found[k].driven for k in sound]
        told = self.qualities(
            [found[k].driver_first for k in sound], places[sound], driven, sensitivity[sound]
        )
        out = list(found)
        for k, quality in zip(sound, told, strict=True):
            out[k] = replace(out[k], quality=quality)
        return out

    def _with_uncertainty(
        self, found: list[FoundLinkage], batch: LinkageBatch, rows: FloatArray
    ) -> list[FoundLinkage]:
        """The linkages with the uncertainty that errors of the poses leave."""
        sound = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
        if not len(sound):
            return found
        unit, places = float(self.target.frames.length), self.target.places_of(rows[sound])
        position, angle = pose_sigma(self.task)
        weights = self.task.weights
        if self.task.exact is not None:
            weights = weights_or_ones(weights, self.task.exact.shape)
            weights = np.where(self.task.exact, EXACT_WEIGHT, weights)
        active = _active_limits(self.target, batch[sound], rows[sound])
        count, most = places.shape[1], MAX_PLACES_OF_QUALITY
        some = even_numbers(count, count if self.task.exact is not None else most)
        boxes = self.target.boxes
        spreads = covariance(
            batch[sound],
            places[:, some],
            self.target.length,
            (position / unit, angle),
            weights=None if weights is None else weights[some],
            fixed=active,
            free_directions=None if boxes is None else boxes.free_directions[some],
        )
        spreads = spreads * len(some) / count
        size = self.problem.motion_size
        regions = uncertainties(spreads, batch[sound], places, unit, size)
        links = links_covariance(batch[sound], spreads) * unit**2
        out = list(found)
        for at, k in enumerate(sound):
            widest = max(each.half_width for each in regions[at])
            out[k] = replace(
                out[k],
                uncertainty=regions[at],
                determined=widest <= DETERMINED_SHARE * size,
                other_types=_other_types(out[k], links[at]),
            )
        return out


def numbered(found: Sequence[FoundLinkage], first: int = 1) -> list[FoundLinkage]:
    """The linkages with ids and ranks by their order, from `first` on."""
    ranks = enumerate(found, start=first)
    return [replace(each, id=f"L{rank}", rank=rank) for rank, each in ranks]


def with_own_dyads(found: Sequence[FoundLinkage]) -> list[FoundLinkage]:
    """The same with dyads numbered by the ranks."""
    out = []
    for each in numbered(found):
        one, two = each.dyads
        number = 2 * each.rank
        dyads = replace(one, id=f"D{number - 1}"), replace(two, id=f"D{number}")
        out.append(replace(each, dyads=dyads))
    return out


def at_given_poses(
    found: Sequence[FoundLinkage], problem: SynthesisProblem
) -> tuple[FoundLinkage, ...]:
    """The linkages with their errors at all poses as given, repeated ones too."""
    if problem.motion is None or problem.task.poses.shape == problem.given.poses.shape:
        return tuple(found)
    group, given = problem.motion.group, problem.given
    return tuple(
        replace(
            each,
            error=counted_error(each.error.places[group], given),
            within_tolerance=None
            if each.within_tolerance is None
            else shares_used(each.error.places[group], given, problem.length),
            timing_error=None
            if each.timing_error is None
            else timing_error(each.driven.inputs[group], given),
        )
        for each in found
    )


def transmission_at_given_poses(found: FoundLinkage, problem: SynthesisProblem) -> FloatArray:
    """The transmission angles (N,) of a linkage at all poses as given, repeated ones too."""
    angles = found.driven.transmission
    if problem.motion is None or len(angles) == problem.given.poses.shape[0]:
        return angles
    return np.asarray(angles[problem.motion.group])


def sizable(batch: LinkageBatch, size: float | FloatArray = 1.0) -> NDArray[np.bool_]:
    """Whether ground links and couplers (k,) between pins have a length; size: of the motion."""
    with np.errstate(invalid="ignore"):
        joined = pin_distances(batch)[:, 2:] <= np.reshape(MIN_LINK * size, (-1, 1))
    return np.asarray(~joined.any(axis=1))


def _other_types(found: FoundLinkage, covariance: FloatArray) -> tuple[str, ...]:
    """The other types within the covariance (4, 4) of the links, with the preferred driver."""
    if (links := found.linkage.links) is None:
        return ()
    others = possible_types(links, covariance)[1:]
    if found.preferred_driver == "first":
        return others
    return tuple(DRIVEN_FROM_THE_OTHER_SIDE.get(each, each) for each in others)


def _all_round(linkage: Linkage, verdict: Verdict) -> Verdict:
    """A verdict on a closed path, whose crank goes on from the last point to the first.

    The transmission angle is least where the crank points along the ground link.
    """

    def whole(side: Side, driven: Driven) -> Driven:
        links = with_driver_first(linkage, side).links
        if not driven.turns_fully or links is None:
            return driven
        ground, crank, coupler, follower = (float(each) for each in links)
        away = np.array([ground - crank, ground + crank])
        angle = crossing_angle(np.array(coupler), np.array(follower), away)
        least = float(np.nan_to_num(angle).min())
        return replace(driven, least_over_range=min(driven.least_over_range, least))

    return replace(
        verdict, first=whole("first", verdict.first), second=whole("second", verdict.second)
    )


def _with_numbers(verdict: Verdict, numbers: Sequence[int]) -> Verdict:
    """With the poses' own numbers in the defects."""

    def numbered(defects: tuple[Finding, ...]) -> tuple[Finding, ...]:
        return tuple(replace(each, poses=tuple(numbers[i] for i in each.poses)) for each in defects)

    first, second = (
        replace(each, defects=numbered(each.defects)) for each in (verdict.first, verdict.second)
    )
    return Verdict(numbered(verdict.defects), first, second)


def _active_limits(target: Target, batch: LinkageBatch, rows: FloatArray) -> FloatArray | None:
    """The limits that hold linkages (k,): their derivatives (k, m, 10), zero where they do not."""
    if not target.kept:
        return None
    still = np.zeros((*rows.shape, 2 * DIMENSIONS))
    value, slope, equal = AllConstraints(target.kept).differentiated(
        batch, rows, np.arange(len(batch)), still
    )
    return np.where((equal | (value > -ACTIVE_LIMIT))[..., None], slope, 0.0)
