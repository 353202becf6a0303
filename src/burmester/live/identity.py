"""Which linkages of a new answer are those that were there before: a card keeps its linkage.

This is the one place where that is decided; the page does what it is told.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from burmester.fourbar.dyad import PP, PR, RR, Dyad
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Synthesis
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.data import scene_of

# Sizes of what is compared.  A linkage that moved along with the poses is off by some thousandths
# from where a search finds it; two linkages of one answer are a tenth and more apart.
SAME: Final = 0.02
UNTOLD: Final = 1e-3  # of it: a linkage that a search moved by less is where it was


def snapshot(
    linkages: Sequence[FoundLinkage], seen: Mapping[str, FoundLinkage] = MappingProxyType({})
) -> list[dict[str, Any]]:
    """The dyads of linkages, by their ids, as `match_ids` takes them.

    seen: how some of them were drawn last for the same task, by their ids, where that is not how
    they are: a hand leaves less time to settle than there is when it rests.
    """
    return [
        {
            "id": each.id,
            "kinds": [type(found.dyad).__name__ for found in each.dyads],
            "numbers": [_numbers(found.dyad) for found in each.dyads],
            "seen": [_numbers(found.dyad) for found in seen.get(each.id, each).dyads],
        }
        for each in linkages
    ]


def match_ids(before: Sequence[dict[str, Any]], synthesis: Synthesis) -> dict[str, dict[str, Any]]:
    """For linkages of a synthesis the "id" that each had before, where it is the same linkage.

    "moved" says how far it is from where it was seen last, in its size; 0 for less than is told.
    before: what `snapshot` said of the linkages at the same task.  None is taken twice: of several
    that are near each other the nearest pair counts first.
    """
    new = snapshot(synthesis.linkages)
    if not new or not before:
        return {}
    scene = scene_of(synthesis)
    away, seen = (_away(new, before, scene, key) for key in ("numbers", "seen"))
    out: dict[str, dict[str, Any]] = {}
    while away.min() < SAME:
        i, j = divmod(int(away.argmin()), len(before))
        moved = round(float(seen[i, j]), 4) if seen[i, j] >= UNTOLD else 0
        out[new[i]["id"]] = {"id": before[j]["id"], "moved": moved}
        away[i, :] = away[:, j] = np.inf
    return out


def _numbers(dyad: Dyad) -> list[float]:
    """A direction and lengths that are equal for equal dyads.

    A line is its point nearest to the origin and twice its angle, as its normal has two directions.
    """
    if isinstance(dyad, RR):
        return [0.0, 0.0, *map(float, (*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius))]
    if isinstance(dyad, PP):
        return [float(np.cos(dyad.angle)), float(np.sin(dyad.angle)), *5 * [0.0]]
    angle, pivot = (
        dyad.normal_angle,
        dyad.moving_pivot if isinstance(dyad, PR) else dyad.fixed_pivot,
    )
    line = dyad.offset * np.cos(angle), dyad.offset * np.sin(angle)
    return [*map(float, (np.cos(2 * angle), np.sin(2 * angle), *line, *pivot)), 0.0]


def _away(
    new: Sequence[dict[str, Any]], old: Sequence[dict[str, Any]], scene: float, key: str
) -> FloatArray:
    """How far new linkages (n,) are from old ones (m,), in their sizes: (n, m).

    key: of the numbers of the old ones that count.
    """
    unit = np.array([scene, scene, 1, 1, 1, 1, 1])
    one = unit * np.array([each["numbers"] for each in new])
    both = unit * np.array([each[key] for each in old])
    gaps = []
    for order in ((0, 1), (1, 0)):  # whichever dyad comes first
        alike = [[a["kinds"] == [b["kinds"][k] for k in order] for b in old] for a in new]
        other = both[:, order]
        size = np.maximum(scene, np.abs(other).max(axis=(1, 2)))
        gap = np.abs(one[:, None] - other).max(axis=(2, 3)) / size
        gaps.append(np.where(alike, gap, np.inf))
    return np.minimum(*gaps)
