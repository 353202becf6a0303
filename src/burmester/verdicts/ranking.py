"""The order of linkages: the one to build first, each once.

Usable linkages stand before others.  Among them those that meet the standard come first
(`requirements.table`), if they come near enough to the poses; within each group the nearest one,
by both errors.  What the digits of the poses leave open makes no linkage nearer than another.
Where the task states a tolerance, all usable linkages keep it, and their quality orders each group
(`quality`).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from burmester.fourbar.dyad import RR, Dyad
from burmester.numerics.arrays import ROUNDING
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import span
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.requirements import Requirements
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.quality import best_first, enough_transmission
from burmester.verdicts.uncertainty import DyadUncertainty

# A linkage that meets the standard comes first if its error is at most this many times the least.
ERROR_RATIO = 3.0
# Sizes of the motion; a pose that is missed by more, or by as much in its angle, is not met, where
# the task states no tolerance.
DEFAULT_TOLERANCE = 0.1
SAME_SHARE = 1e-3  # tolerances of a pose: linkages whose dimensions differ by less are one
SAME_SPAN = 1e-2  # spans of the motion: farther apart, two linkages are never taken for one
# Ratios of the greatest errors of two linkages: it is a trade where one error falls to this, and
# the other rises to no more than that.
TRADE_GAIN, TRADE_PRICE = 0.5, 3.0
ALIKE = 1e-6  # relative; errors that differ by less are rounding


def digits_leave_open(problem: SynthesisProblem) -> float:
    """The combined error, in the task's unit, that the digits of the poses make by themselves.

    Both coordinates and the angle err evenly up to the resolution, so their variances are a third
    of its square.
    """
    position, angle = problem.task.resolution
    length = problem.length_per_radian
    open_ = math.sqrt((2 * position**2 + (length * angle) ** 2) / 3)
    return max(open_, ROUNDING * length)


def states_tolerance(task: Task) -> bool:
    """Whether a task says how far its poses may be missed, so that quality may decide."""
    return task.requirements.within is not None or task.tolerances is not None


def by_quality(found: Sequence[FoundLinkage], asked: Requirements) -> list[FoundLinkage]:
    """Linkages by the rule of `quality.best_first`; asked: what their task asks."""
    names = "transmission", "extent", "sensitivity"
    figures = [
        np.array([np.nan if e.quality is None else getattr(e.quality, name) for e in found])
        for name in names
    ]
    enough = enough_transmission(asked.transmission)
    return [found[k] for k in best_first(*figures, enough=enough).tolist()]


def closest_usable(found: Iterable[FoundLinkage]) -> FoundLinkage | None:
    """The usable linkage of the least combined error."""
    usable = [each for each in found if each.usable]
    return min(usable, key=lambda each: each.combined_error, default=None)


def only_too_far(found: FoundLinkage) -> bool:
    """Whether a linkage would be usable if its poses might be missed by more."""
    far = bool(found.defects) and all(each.kind == "assembly" for each in found.defects)
    return far and not found.violations and found.combined_error < math.inf


def farthest_recommended(closest: FoundLinkage, problem: SynthesisProblem) -> float:
    """The greatest combined error with which a linkage may stand before the closest usable one.

    Any where the task states a tolerance, which all usable ones keep; else ERROR_RATIO times the
    closest one's, or what the digits leave open.
    """
    if states_tolerance(problem.task):
        return math.inf
    return ERROR_RATIO * max(closest.combined_error, digits_leave_open(problem))


def is_trade(other: FoundLinkage, best: FoundLinkage) -> bool:
    """Whether a linkage gains much in one of its greatest errors, and pays little in the other."""
    pairs = (other.error.worst, best.error.worst), (_turned(other), _turned(best))
    gains = any(one < TRADE_GAIN * two for one, two in pairs)
    return other is not best and gains and all(one <= TRADE_PRICE * two for one, two in pairs)


def ranked(found: Sequence[FoundLinkage], problem: SynthesisProblem) -> list[FoundLinkage]:
    """The order of linkages, equal ones once.

    Of several failing linkages from one pair of dyads only the closest is kept, and those of the
    search that are `only_too_far`.  Without a stated
    tolerance the first is never one that another of its group beats in both errors.
    """
    floor, closest = digits_leave_open(problem), closest_usable(found)
    stated = states_tolerance(problem.task)
    asked = problem.task.requirements
    usable = by_quality([each for each in found if each.usable], asked) if stated else []
    place = {id(each): number for number, each in enumerate(usable)}
    most = 0.0 if closest is None else farthest_recommended(closest, problem)

    def order(each: FoundLinkage) -> tuple[bool, bool, float, float]:
        good = each.usable and not each.shortcomings and each.combined_error <= most
        if stated and each.usable:
            return False, not good, float(place[id(each)]), 0.0
        error = max(each.combined_error, floor)
        error = float(round(math.log(error) / ALIKE)) if math.isfinite(error) else math.inf
        least = each.driven.least_over_range
        return not each.usable, not good, error, 0.0 if math.isnan(least) else -round(least, 6)

    size = max(span(problem.task), problem.length)
    kept: list[FoundLinkage] = []
    failed = set()
    for each in sorted(found, key=order):  # stable: the order of the dyads stays
        pair = frozenset(dyad.id for dyad in each.dyads)
        if any(_same(each, other, problem, size) for other in kept):
            continue
        near = each.usable or (each.from_search and only_too_far(each))
        if near or pair not in failed:
            kept.append(each)
        if not each.usable:
            failed.add(pair)
    best = order(kept[0])[:2] if kept else None
    group = [each for each in kept if order(each)[:2] == best]
    first = next(
        (each for each in group if not any(_beats(one, each, floor) for one in group)), None
    )
    if first is not None and not stated:
        kept.remove(first)
        kept.insert(0, first)
    return kept


def _beats(one: FoundLinkage, other: FoundLinkage, floor: float) -> bool:
    """Whether both greatest errors of a linkage are less, by more than what nobody can tell."""
    if other.combined_error <= floor:
        return False
    (far, turned), (far2, turned2) = ((e.error.worst, _turned(e)) for e in (one, other))
    return far < (1 - ALIKE) * far2 and turned < (1 - ALIKE) * turned2


def _turned(found: FoundLinkage) -> float:
    return float(np.nan_to_num(found.error.angle, nan=np.inf).max())


def _same(one: FoundLinkage, other: FoundLinkage, problem: SynthesisProblem, size: float) -> bool:
    """Whether two linkages are one, in either order of their dyads.

    They are where they differ by less than SAME_SHARE of the tolerance of a pose, and where both
    work, or both do not, by less than the poses determine of the first.  size: of the motion.
    """
    within = problem.task.requirements.within
    least = SAME_SHARE * (DEFAULT_TOLERANCE * size if within is None else within)
    regions = other.uncertainty if one.usable == other.usable else None
    known = regions or (None, None)
    mine = one.linkage.first, one.linkage.second
    return any(
        all(
            _alike(a, b, region, least, size)
            for a, b, region in zip(
                pair, (other.linkage.first, other.linkage.second), known, strict=True
            )
        )
        for pair in (mine, mine[::-1])
    )


def _alike(a: Dyad, b: Dyad, region: DyadUncertainty | None, least: float, size: float) -> bool:
    """Whether dyads differ by `least` or less, or by less than b's region leaves open."""
    if type(a) is not type(b):
        return False
    if isinstance(a, RR):
        least = max(least, ROUNDING * float(a.radius))

    def near(name: str) -> bool:
        gap = float(np.abs(getattr(a, name) - getattr(b, name)).max())
        gap *= size if name.endswith("angle") else 1.0
        return gap <= least or gap <= min(_left_open(name, region, size), SAME_SPAN * size)

    return all(map(near, a.__match_args__))


def _left_open(name: str, region: DyadUncertainty | None, size: float) -> float:
    """How far the poses leave a dimension open, as a length."""
    if region is None:
        return 0.0
    if name == "radius":
        return region.length or 0.0
    if name.endswith("pivot"):
        point = region.fixed if name == "fixed_pivot" else region.moving
        return 0.0 if point is None else point.half_width
    if region.line is None:
        return 0.0
    return size * region.line.angle if name == "normal_angle" else region.line.offset
