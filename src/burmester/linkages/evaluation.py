"""Linkages judged: their errors, defects, uncertainty, and whether they are as asked; ranked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import FoundDyad, same_dyad
from burmester.fourbar.defects import Defect, Verdict, judge
from burmester.fourbar.dyad import RR, Dyad
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.linkages.constraints import AllConstraints
from burmester.linkages.found_linkage import FoundLinkage, Pair, Side, with_driver_first
from burmester.linkages.requirement_check import Violation, violations
from burmester.linkages.rounding import rounded
from burmester.linkages.target import Target
from burmester.linkages.tolerances import spread
from burmester.linkages.uncertainty import covariance, links_deviation, pose_sigma, uncertainties
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.numerics.bundles import take
from burmester.numerics.differences import DifferenceQuotients
from burmester.numerics.weights import weights_or_ones
from burmester.tasks.motion_task import Task
from burmester.tasks.problem import SynthesisProblem

__all__ = ["Candidates", "Evaluation"]

REACH = 0.1  # sizes of the motion; a pose missed by more is not met at all
SHORTEST = 1e-6  # sizes; a ground link or a coupler shorter than this is none
DETERMINED = 0.05  # spans; pivots known worse than this are not determined
EXACT = 1e8  # weights: what an exact pose counts as, to say what its errors do
QUOTIENTS = DifferenceQuotients(stride=1e-7)  # of limits, by the dimensions
TOUCHING = 1e-9  # lengths; a limit that is nearer than this is touched
FIXED, MOVING = slice(0, 2), slice(2, 4)
ROUNDED = 5  # linkages are rounded where that is asked, at most


class Candidates(NamedTuple):
    """Linkages (k,) with the rows (k, N, 3) of their places, and the pairs that they come from.

    from_search: (k,), which were looked for under conditions.
    own: the same in the task's own frames, where not a digit is to be lost.
    """

    stack: LinkageBatch
    rows: FloatArray
    pairs: list[Pair]
    from_search: NDArray[np.bool_]
    own: LinkageBatch | None = None


@final
@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """What linkages are judged by."""

    problem: SynthesisProblem
    aim: Target

    @property
    def task(self) -> Task:
        """The task, with every pose once."""
        return self.problem.task

    def stacked(self, pairs: Sequence[Pair]) -> LinkageBatch:
        """Pairs of dyads in the frames in which they are judged."""
        linkages = [Linkage(first.dyad, second.dyad) for first, second in pairs]
        return LinkageBatch.of(linkages).seen(self.aim.frames)

    def told(self, made: Candidates) -> list[FoundLinkage]:
        """The linkages with all that is to be said of them, ranked."""
        made = take(made, np.flatnonzero(_sizable(made.stack)))
        own = made.stack.back(self.aim.frames) if made.own is None else made.own
        places = self.aim.frames.unseen(self._places(made.rows))
        errors = [PoseError.at(places[k], self.task.poses) for k in range(len(own))]
        verdicts = self._verdicts(own, places, errors)
        sides = np.tile(np.arange(2), (len(own), 1))
        out = []
        for k, verdict in enumerate(verdicts):
            linkage = own.linkage(k)
            better, missing, works = self._driver(linkage, verdict)
            parts = linkage, verdict, better, made.pairs[k]
            if better == "second" and len(self.task.limits) < 2:
                sides[k] = (1, 0)
                parts = _exchanged(linkage, verdict, made.pairs[k])
            linkage, verdict, better, (one, two) = parts  # noqa: PLW2901
            dyads = self.dyad(one, linkage.first), self.dyad(two, linkage.second)
            said = (dyads, linkage, errors[k], verdict, better, works, missing)
            out.append(FoundLinkage("", 0, *said, bool(made.from_search[k])))
        rows = np.arange(len(own))[:, None]
        stack = LinkageBatch(made.stack.kinds[rows, sides], made.stack.dimensions[rows, sides])
        return self.ranked(self._measured(out, stack, made.rows))

    def ranked(self, found: list[FoundLinkage]) -> list[FoundLinkage]:
        """Those that work first, then by worst error; the same linkage once.

        Of one pair of dyads that does not work, whatever is made of it, the closest is told.
        """

        def order(each: FoundLinkage) -> tuple[bool, float]:
            worst = np.round(each.error.worst / (ROUNDING * self.problem.length_per_radian))
            return not each.usable, float(worst)

        size = float(self.aim.frames.length)
        out: list[FoundLinkage] = []
        failed = set()
        for each in sorted(found, key=order):  # stable: the order of the dyads stays
            pair = frozenset(dyad.id for dyad in each.dyads)
            if any(_same(each.linkage, other.linkage, size) for other in out):
                continue
            if each.usable or pair not in failed:
                out.append(each)
            if not each.usable:
                failed.add(pair)
        return out

    def rounded(self, found: list[FoundLinkage]) -> list[FoundLinkage]:
        """The best of them with lengths and pivots rounded, judged again."""
        out: list[FoundLinkage] = []
        frames, options = self.aim.frames, self.problem.options
        for each in found[:ROUNDED]:
            stack = LinkageBatch.of([each.linkage]).seen(frames)
            rows = rows_of(frames.see(each.error.places), self.aim.length)[None]
            driver = np.array([int(each.preferred_driver == "second")])
            own, rows = rounded(
                stack, rows, self.aim, options.rounding_step, options.stock_lengths, driver
            )
            from_search = np.array([each.from_search])
            new = self.told(Candidates(own.seen(frames), rows, [each.dyads], from_search, own))
            if not new:
                lost = Violation("rounding", "rounded so coarsely its pivots would fall together")
                new = [replace(each, usable=False, violations=(*each.violations, lost))]
            out += [replace(one, error_before_rounding=each.error) for one in new]
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
        self, own: LinkageBatch, places: Displacement, errors: list[PoseError]
    ) -> list[Verdict]:
        shape = (len(own), self.task.poses.shape[0])
        position = np.array([error.position for error in errors]).reshape(shape)
        turn = np.array([error.angle for error in errors]).reshape(shape)
        asked, within = self.task.requirements, self.task.requirements.within
        missed = (
            position
            if within is not None
            else np.hypot(position, self.problem.length_per_radian * turn)
        )
        reach = REACH * float(self.aim.frames.length) if within is None else within
        numbers = self.problem.pose_numbers
        given = self.task.names or ("",) * len(numbers)
        names = [name or str(number + 1) for name, number in zip(given, numbers, strict=True)]
        out: list[Verdict | None] = [None] * len(own)
        for index, linkage in own.alike():
            verdicts = judge(
                linkage,
                places[index],
                missed=missed[index],
                reach=reach,
                length=self.problem.length_per_radian,
                names=names,
                any_order=asked.any_order,
            )
            for k, verdict in zip(index, verdicts, strict=True):
                out[k] = _numbered(verdict, numbers)
        return [verdict for verdict in out if verdict is not None]

    def _driver(
        self, linkage: Linkage, verdict: Verdict
    ) -> tuple[Side, tuple[Violation, ...], bool]:
        """The better driver, what is unmet with it, and whether it leads through the poses."""
        asked = self.task.requirements
        sides: tuple[Side, ...] = ("first", "second")
        if asked.driver in sides:
            sides = (asked.driver,)

        def judged(side: Side) -> tuple[tuple[float, ...], tuple[Violation, ...]]:
            driven = verdict.first if side == "first" else verdict.second
            missing = violations(
                with_driver_first(linkage, side), driven, asked, self.task.length_unit
            )
            wrong = len(driven.defects), len(missing)
            weak = -round(float(np.nan_to_num(driven.least_over_range)), 6)  # no rounding decides
            poses = sum(len(each.poses) for each in driven.defects)
            return (*map(float, wrong), poses, 0.0 if driven.turns_fully else 1.0, weak), missing

        ranked = {side: judged(side) for side in sides}
        best = min(sides, key=lambda side: ranked[side][0])
        (defects, missing, *_), reasons = ranked[best]
        return best, reasons, not (verdict.defects or defects or missing)

    def _measured(
        self, found: list[FoundLinkage], stack: LinkageBatch, rows: FloatArray
    ) -> list[FoundLinkage]:
        """The linkages with what errors of the poses, and of building, do to them."""
        sound = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
        if not len(sound):
            return found
        unit, places = float(self.aim.frames.length), self._places(rows[sound])
        position, angle = pose_sigma(self.task)
        weights = self.task.weights
        if self.task.exact is not None:
            weights = weights_or_ones(weights, self.task.exact.shape)
            weights = np.where(self.task.exact, EXACT, weights)
        held = _held_by(self.aim, stack[sound], rows[sound])
        spreads = covariance(
            stack[sound],
            places,
            self.aim.length,
            (position / unit, angle),
            weights=weights,
            fixed=held,
        )
        regions = uncertainties(spreads, stack[sound], places, unit)
        deviation = links_deviation(stack[sound], spreads)
        built = None
        if self.problem.options.manufacturing_tolerance is not None:
            tolerance = self.problem.options.manufacturing_tolerance / unit
            built = spread(stack[sound], self.aim.poses, places, self.aim.length, tolerance)
        span = np.linalg.norm(np.ptp(self.task.poses.translation, axis=0))
        size = max(float(span), self.problem.length_per_radian)
        out = list(found)
        for at, k in enumerate(sound):
            determined = max(each.half_width for each in regions[at]) <= DETERMINED * size
            tie = bool(abs(_excess(stack.dimensions[k])) <= 2 * deviation[at])
            out[k] = replace(out[k], uncertainty=regions[at], determined=determined, tie=tie)
            if built is not None:
                out[k] = replace(out[k], spread=built.one(at, unit))
        return out


def _sizable(stack: LinkageBatch) -> NDArray[np.bool_]:
    """Whether ground links and couplers (k,) between pins have a length."""
    kinds, z = stack.kinds, stack.dimensions
    ground, coupler = (np.linalg.norm(z[:, 1, at] - z[:, 0, at], axis=-1) for at in (FIXED, MOVING))
    return np.asarray(
        ((kinds == 1).any(axis=1) | (ground > SHORTEST))
        & ((kinds == 2).any(axis=1) | (coupler > SHORTEST))
    )


def _exchanged(
    linkage: Linkage, verdict: Verdict, pair: Pair
) -> tuple[Linkage, Verdict, Side, Pair]:
    """The same with the second dyad first, as the better driver."""
    turned = Verdict(verdict.defects, verdict.second, verdict.first)
    return with_driver_first(linkage, "second"), turned, "first", pair[::-1]


def _excess(z: FloatArray) -> float:
    """The shortest and the longest link less the others, of a 4R's dimensions (2, 5)."""
    ground, coupler = (float(np.linalg.norm(z[1, at] - z[0, at])) for at in (FIXED, MOVING))
    s, p, q, longest = sorted((ground, coupler, float(z[0, 4]), float(z[1, 4])))
    return s + longest - p - q


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


def _held_by(aim: Target, stack: LinkageBatch, rows: FloatArray) -> FloatArray | None:
    """The limits that hold linkages (k,): their derivatives (k, m, 10), zero where they do not."""
    if not aim.kept:
        return None
    keep = AllConstraints(aim.kept)
    count, size = len(stack), 2 * DIMENSIONS
    z = QUOTIENTS.points(stack.dimensions.reshape(count, size), np.eye(size)[:, None])
    every, times = np.tile(np.arange(count), len(z)), (len(z), 1, 1)
    beside = LinkageBatch(stack.kinds[every], z.reshape(-1, 2, DIMENSIONS))
    value, equal = keep(beside, np.tile(rows, times), every)
    value = value.reshape(len(z), count, -1)
    jacobian = QUOTIENTS.jacobian(value)
    return np.where((equal | (value[0] > -TOUCHING))[..., None], jacobian, 0.0)
