"""The price list of a path: how much farther a linkage misses that moves or is built better.

The nearest linkage comes first.  Then, for least transmission angles, alone and with link ratios,
the nearest linkage that keeps them.  How near is the greatest distance of a point from the curve
(`FoundLinkage.combined_error`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from burmester.tasks.motion_task import Task
from burmester.tasks.notation import span
from burmester.verdicts.found_linkage import FoundLinkage

MET = 1e-7  # spans of the path; points that are missed by less are met
ANGLES_DEG = (0.0, 20.0, 30.0, 40.0, 60.0)  # least transmission angles; more runs no better
RATIOS = (math.inf, 10.0, 5.0)  # of the longest link to the shortest
SAME_MISS = 1e-4  # relative; misses that differ by less are the same
ALIKE_MISS = 0.1  # relative; a linkage farther by less is hardly farther


class Price(NamedTuple):
    """What a linkage costs, and what it gives.

    miss: the greatest distance of a point from the curve, in the task's unit.
    times: the same, over that of the nearest linkage; None where that one misses by nothing.
    transmission_deg: the least transmission angle on the path; link_ratio: longest over shortest.
    """

    found: FoundLinkage
    miss: float
    times: float | None
    transmission_deg: float
    link_ratio: float


def price_list(linkages: Sequence[FoundLinkage], task: Task) -> list[Price]:
    """The usable linkages of a path that are worth their price, the nearest first.

    Of those that miss by as much, as cognates do, the first.  Left out is a linkage where another
    is as good and hardly farther.
    """
    met = MET * span(task)
    usable = [_priced(each) for each in linkages if each.usable]
    kept: list[Price] = []
    for ratio in RATIOS:
        for angle in ANGLES_DEG if ratio == math.inf else ANGLES_DEG[1:]:
            some = [e for e in usable if e.transmission_deg >= angle and e.link_ratio <= ratio]
            least = max(min((each.miss for each in some), default=0.0), met)
            nearest = next((each for each in some if each.miss <= (1 + SAME_MISS) * least), None)
            if nearest is not None and nearest not in kept:
                kept.append(nearest)
    kept[1:] = sorted(kept[1:], key=lambda price: price.miss)
    kept = kept[:1] + [e for e in kept[1:] if not any(_replaces(one, e) for one in kept)]
    free = not kept or kept[0].miss <= met
    return [e._replace(times=None if free else e.miss / kept[0].miss) for e in kept]


def _priced(found: FoundLinkage) -> Price:
    links = [float(each) for each in found.linkage.links or ()]
    ratio = max(links) / min(links) if links and min(links) > 0 else math.inf
    degrees = math.degrees(found.driven.least_over_range)
    return Price(found, found.combined_error, None, degrees, ratio)


def _marks(price: Price) -> tuple[int, int]:
    """How many of the transmission angles, and of the link ratios, a linkage keeps."""
    angles = sum(price.transmission_deg >= each for each in ANGLES_DEG)
    return angles, sum(price.link_ratio <= each for each in RATIOS)


def _replaces(one: Price, other: Price) -> bool:
    """Whether one linkage keeps more than another and is hardly farther."""
    mine, its = _marks(one), _marks(other)
    as_good = mine[0] >= its[0] and mine[1] >= its[1]
    return mine != its and as_good and one.miss <= (1 + ALIKE_MISS) * other.miss
