"""The limits that a task states, one by one, and how far each is loosened to let a linkage in.

Loosened is one limit alone: a region of pivots, a length, the kinds of dyads, a requirement, a
keep-out region.  The numbers of the looser limit are rounded to the safe side: the linkage for
which it is loosened keeps it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from burmester.cures import Cure, Help
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.regions import Polygon
from burmester.requirements.footprint import FOOTPRINT
from burmester.synthesis.wider_region import (
    DIGITS,
    cleared,
    plain,
    region_text,
    wider,
    wider_all_around,
)
from burmester.tasks.limits import KINDS
from burmester.tasks.motion_task import Task
from burmester.tasks.stated_limits import PIVOTS, StatedLimit, with_limits
from burmester.verdicts.explanation import below
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.requirement_check import pivots_of, places_between
from burmester.wording import figure, listed


@final
@dataclass(frozen=True, slots=True, eq=False)
class Loosening:
    """One limit of a task loosened, the others as they are.

    message: what is looser, and by how much; option: what to state instead.
    size: how much, in motion sizes, radians or as the logarithm of a ratio; 1 for what is allowed
        or not.
    task: with the looser limit.  found: a linkage that keeps all but that limit of the task as
        stated, judged by it.
    """

    limit: StatedLimit
    message: str
    option: str
    size: float
    task: Task
    found: FoundLinkage


def loosened(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float = 1.0
) -> Loosening | None:
    """The task with one limit loosened so far that a linkage keeps it; None where it needs nothing.

    size: of the motion.  share: how much of the way, above 1 for some room to spare.
    """
    make = {
        **dict.fromkeys(PIVOTS, _pivots),
        "footprint": _footprint,
        "length": _length,
        "kinds": _kinds,
        "keep-out": _moved_away,
        "margin": _margin,
    }.get(limit.kind, _requirement)
    return make(task, limit, found, size, share)


def loosened_all_around(task: Task, limit: StatedLimit, by: float) -> Task | None:
    """The task with one limit wider on all sides, by a length; None where it is none of lengths."""
    if limit.kind == "footprint":
        region = task.requirements.footprint
        assert region is not None
        asked = replace(task.requirements, footprint=wider_all_around(region, by))
        return replace(task, requirements=asked)
    own = task.limits[limit.number] if limit.number < len(task.limits) else None
    if own is None:
        return None
    if limit.kind == "length":
        least, most = own.length
        return with_limits(task, limit.number, length=(max(least - by, 0.0), most + by))
    if limit.kind in PIVOTS:
        name = limit.kind.replace(" ", "_")
        region = wider_all_around(getattr(own, name), by)
        return None if region is None else with_limits(task, limit.number, **{name: region})
    return None


def _footprint(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """A footprint that holds the pivots of a linkage."""
    region = task.requirements.footprint
    assert region is not None
    swept = pivots_of(found.linkage, places_between(found.driver_first, found.driven))
    told = wider(region, np.concatenate([points for _, points in swept]), share, task)
    if told is None:
        return None
    assert isinstance(told.region, Polygon)
    changed = replace(task, requirements=replace(task.requirements, footprint=told.region))
    words = f"a footprint {told.words}"
    option = Help(replace(FOOTPRINT.given(told.region), text=region_text(told.region)))
    return Loosening(limit, words, option, told.by / size, changed, found)


def _dyads_of(task: Task, number: int, found: FoundLinkage) -> tuple[Dyad, ...]:
    """The dyads that a task's limits with this number are for."""
    both = found.linkage.first, found.linkage.second
    return both if len(task.limits) == 1 else both[number : number + 1]


def _pivots(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """Room for the pivots of a linkage."""
    fixed = limit.kind == "fixed pivot"
    name = "fixed_pivot" if fixed else "moving_pivot"
    region = getattr(task.limits[limit.number], name)
    holds = RR | RP if fixed else RR | PR
    dyads = _dyads_of(task, limit.number, found)
    points = [getattr(dyad, name) for dyad in dyads if isinstance(dyad, holds)]
    told = wider(region, np.array(points), share, task) if points else None
    if told is None:
        return None
    changed = with_limits(task, limit.number, **{name: told.region})
    regions = [getattr(each, name) for each in changed.limits]
    option = Help([Cure(name, each or "any", text=region_text(each)) for each in regions])
    x, y = (figure(float(value)) for value in told.near)
    what = f"{limit.kind}s" if len(dyads) > 1 else f"the {limit.kind}{_whose(task, limit.number)}"
    words = f"{what} {told.words}, near ({x}, {y})"
    return Loosening(limit, words, option, told.by / size, changed, found)


def _whose(task: Task, number: int) -> str:
    if len(task.limits) == 1:
        return ""
    return f" of the {('first', 'second')[number]} dyad"


def _moved_away(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """A keep-out region out of the way of a linkage."""
    assert task.surroundings is not None
    told = cleared(task, limit.number, found, size, share)
    if told is None:
        return None
    changed, shift = told
    name, by = task.surroundings.names[limit.number], ", ".join(map(plain, shift))
    words = f"{name} moved by ({by})"
    if found.clearance is not None and found.clearance.touches:
        words += f", out of the way of {found.clearance.part}"
    option = f"({by}) added to all corners of keep-out {name}"
    return Loosening(limit, words, option, float(np.linalg.norm(shift)) / size, changed, found)


def _length(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """A range of lengths that holds the links of a linkage."""
    dyads = _dyads_of(task, limit.number, found)
    radii = [float(dyad.radius) for dyad in dyads if isinstance(dyad, RR)]
    least, most = task.limits[limit.number].length
    if not radii or (least <= min(radii) and max(radii) <= most):
        return None
    words, range_ = [], [least, most]
    if min(radii) < least:
        low = _rounded(max(least - share * (least - min(radii)), 0.0), min(radii) - least)
        range_[0] = low
        words.append(f"a link of {_exact_length(low, task)} instead of at least {plain(least)}")
    if max(radii) > most:
        high = _rounded(most + share * (max(radii) - most), max(radii) - most)
        range_[1] = high
        words.append(f"a link of up to {_exact_length(high, task)} instead of {plain(most)}")
    changed = with_limits(task, limit.number, length=tuple(range_))
    cures = [Cure("length", e.length, text=_range_text(*e.length)) for e in changed.limits]
    by = abs(range_[0] - least) + (range_[1] - most if math.isfinite(most) else 0.0)
    whose = _whose(task, limit.number)
    return Loosening(limit, listed(words) + whose, Help(cures), by / size, changed, found)


def _kinds(
    task: Task, limit: StatedLimit, found: FoundLinkage, _size: float, _share: float
) -> Loosening | None:
    """The kinds of the dyads of a linkage beside those allowed."""
    sides = (found.linkage.first, found.linkage.second)
    own = [type(dyad).__name__ for dyad in sides]
    limits = []
    for number, each in enumerate(task.limits):
        more = own if len(task.limits) == 1 else own[number : number + 1]
        limits.append(replace(each, kinds=each.kinds | {kind for kind in KINDS if kind in more}))
    new = sorted(
        {
            kind
            for each, old in zip(limits, task.limits, strict=True)
            for kind in each.kinds - old.kinds
        }
    )
    if not new:
        return None
    kinds = [",".join(kind for kind in KINDS if kind in each.kinds) for each in limits]
    option = Help([Cure("kinds", e.kinds, text=t) for e, t in zip(limits, kinds, strict=True)])
    words = f"a dyad of kind {listed(new, 'or')} as well"
    return Loosening(limit, words, option, 1.0, replace(task, limits=tuple(limits)), found)


def _requirement(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """A requirement that a linkage meets."""
    asked = task.requirements
    requirement = next(each for each in asked.bounds if each.kind == limit.kind)
    looser = requirement.looser(asked.bounds[requirement], found.figures, share)
    if looser is None:
        return None
    option = Help(requirement.given(looser.bound))
    new = replace(task, requirements=replace(asked, **{requirement.name: looser.bound}))
    return Loosening(limit, looser.words, option, looser.size, new, found)


def _margin(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """Less room about what moves: a smaller margin, or thinner links."""
    around = task.surroundings
    assert around is not None
    if not around.margin or found.clearance is None or not found.clearance.least > 0:
        return None
    least = float(found.clearance.least)
    if least >= around.margin:
        return None
    margin = float(below(max(around.margin - share * (around.margin - least), 0.0)))
    words = f"a margin of {_exact_length(margin, task)} instead of {plain(around.margin)}"
    by = (around.margin - margin) / size
    changed = replace(task, surroundings=replace(around, margin=margin))
    return Loosening(limit, words, f"margin = {margin:g}", by, changed, found)


def _rounded(value: float, amount: float) -> float:
    """A length rounded away from zero, or for a negative amount towards it, by its digits."""
    step = 10.0 ** (math.floor(math.log10(abs(amount))) - DIGITS + 1)
    outward = math.ceil(value / step - 1e-9) if amount > 0 else math.floor(value / step + 1e-9)
    return float(f"{max(outward * step, 0.0):.12g}")


def _exact_length(value: float, task: Task) -> str:
    """A length with the digits that it has, and its unit."""
    return plain(value) + (f" {task.length_unit}" if task.length_unit else "")


def _range_text(least: float, most: float) -> str:
    if (least, most) == (0.0, math.inf):
        return "any"
    return f"{least:.12g}:" + (f"{most:.12g}" if math.isfinite(most) else "")
