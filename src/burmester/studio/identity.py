"""Which linkages of a new answer are those that were there before: a card keeps its linkage."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from burmester.fourbar.dyad import PP, RR
from burmester.fourbar.linkage_batch import DYAD_KINDS, LinkageBatch
from burmester.linkages.found_linkage import FoundLinkage
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Synthesis
from burmester.web.data import scene_of

__all__ = ["matched", "standing"]

# Sizes of what is compared.  A linkage that moved along with the poses is off by some thousandths
# from where a search finds it; two linkages of one answer are a tenth and more apart.
SAME: Final = 0.02


def standing(linkages: Sequence[FoundLinkage]) -> list[dict[str, Any]]:
    """The dimensions of linkages, by their ids, as `matched` takes them."""
    known = _of_links(linkages)
    batch = LinkageBatch.of([each.linkage for each in known])
    rows = zip(known, batch.kinds.tolist(), batch.dimensions.tolist(), strict=True)
    return [
        {"id": found.id, "kinds": kinds, "dimensions": dimensions}
        for found, kinds, dimensions in rows
    ]


def matched(before: Sequence[dict[str, Any]], synthesis: Synthesis) -> dict[str, str]:
    """For linkages of a synthesis the id that each had before, where it is the same linkage.

    before: what `standing` said of the linkages at the same task.  None is taken twice: of several
    that are near each other the nearest pair counts first.
    """
    new = _of_links(synthesis.linkages)
    if not new or not before:
        return {}
    batch = LinkageBatch.of([each.linkage for each in new])
    old = LinkageBatch(
        np.array([each["kinds"] for each in before], dtype=batch.kinds.dtype),
        np.array([each["dimensions"] for each in before], dtype=np.float64),
    )
    scene = scene_of(synthesis)
    away = np.minimum(_away(batch, old, scene), _away(batch, old.exchanged(), scene))
    out: dict[str, str] = {}
    while away.min() < SAME:
        i, j = divmod(int(away.argmin()), len(before))
        out[new[i].id] = before[j]["id"]
        away[i, :] = away[:, j] = np.inf
    return out


def _of_links(linkages: Sequence[FoundLinkage]) -> list[FoundLinkage]:
    """Those without a dyad that only slides, which has no place."""
    return [each for each in linkages if not any(isinstance(d.dyad, PP) for d in each.dyads)]


def _away(new: LinkageBatch, old: LinkageBatch, scene: float) -> FloatArray:
    """How far new linkages (n,) are from old ones (m,), in their sizes: (n, m)."""
    alike = (new.kinds[:, None] == old.kinds).all(axis=-1)
    one, other = _lengths(new, scene), _lengths(old, scene)
    size = np.maximum(scene, np.abs(other).max(axis=(1, 2)))
    gap = np.abs(one[:, None] - other).max(axis=(2, 3)) / size
    return np.where(alike, gap, np.inf)


def _lengths(batch: LinkageBatch, scene: float) -> FloatArray:
    """Dyads as lengths (k, 2, 6) that are equal for equal dyads.

    A line is its point nearest to the origin and twice its angle, as its normal has two directions.
    """
    z = batch.dimensions
    out = np.zeros((*z.shape[:2], 6))
    for kind, at in ((1, 0), (2, 2)):  # where the line of a PR stands, and that of an RP
        line = batch.kinds == kind
        angle, offset = z[line][:, at], z[line][:, at + 1]
        out[line, 0], out[line, 1] = scene * np.cos(2 * angle), scene * np.sin(2 * angle)
        out[line, 2], out[line, 3] = offset * np.cos(angle), offset * np.sin(angle)
        out[line, 4:] = z[line][:, 2 - at : 4 - at]
    link = batch.kinds == DYAD_KINDS.index(RR)
    out[link, :5] = z[link]
    return out
