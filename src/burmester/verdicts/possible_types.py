"""The types of a four-bar that the uncertainty of its links leaves possible.

Grashof's type is that of the signs of three sums of the four links, `GRASHOF_SUMS`.  Errors of the
poses leave each sum a deviation, so near zero its sign is open, and with it the type.
"""

from __future__ import annotations

from itertools import compress

import numpy as np

from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import GRASHOF_SUMS, TYPE_OF_SIGNS, Linkage, Links, grashof
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.numerics.arrays import ROUNDING, FloatArray

__all__ = ["links_covariance", "possible_types"]

POSSIBLE_DEVIATIONS = 2.0  # standard deviations; a type farther off is taken as excluded

LEAST_VARIANCE = 1e-12  # of all variances together; a smaller one is rounding


def possible_types(links: Links, covariance: FloatArray) -> tuple[str, ...]:
    """The types of one 4R linkage within the uncertainty of its links, its own type first.

    links: the four lengths; covariance: (4, 4) of them, in their order and unit.

    A pattern of signs is possible where the sums that would have to change theirs can be zero all
    at once within POSSIBLE_DEVIATIONS, to first order.  A change point is the border of types and
    listed only where the links themselves are at one; then it has no other types.
    """
    own = grashof(links)
    if own == "change-point":
        return (own,)
    lengths = np.array([float(length) for length in links])
    sums = GRASHOF_SUMS @ lengths
    spread = GRASHOF_SUMS @ covariance @ GRASHOF_SUMS.T
    # Rounding bounds the deviations from below, and keeps dependent sums apart.
    floor = (ROUNDING * lengths.sum()) ** 2 + LEAST_VARIANCE * np.trace(spread)
    spread = spread + floor * np.eye(len(sums))
    signs = np.sign(sums)
    others = []
    for pattern, name in TYPE_OF_SIGNS.items():
        changed = np.flatnonzero(signs != pattern)
        away = sums[changed] @ np.linalg.solve(spread[np.ix_(changed, changed)], sums[changed])
        others.append(name != own and bool(away <= POSSIBLE_DEVIATIONS**2))
    return (own, *dict.fromkeys(compress(TYPE_OF_SIGNS.values(), others)))


def links_covariance(batch: LinkageBatch, covariance: FloatArray) -> FloatArray:
    """Covariances (k, 4, 4) of the link lengths, in the order of `Links`, to first order.

    covariance: (k, 10, 10), of the dimensions (`uncertainty.covariance`).  nan where a dyad is a
    slider.
    """
    out = np.full((len(batch), 4, 4), np.nan)
    for index, pair in batch.alike():
        a, b = pair.first, pair.second
        if not (isinstance(a, RR) and isinstance(b, RR)):
            continue
        links = Linkage(a, b).links
        assert links is not None
        slope = np.zeros((len(index), 4, 2, DIMENSIONS))
        for link, at, gap, size in (
            (0, 0, b.fixed_pivot - a.fixed_pivot, links.ground),
            (2, 2, b.moving_pivot - a.moving_pivot, links.coupler),
        ):
            toward = np.divide(gap, size[:, None], out=np.zeros_like(gap), where=size[:, None] > 0)
            slope[:, link, 1, at : at + 2] = toward
            slope[:, link, 0, at : at + 2] = -toward
        slope[:, 1, 0, 4] = slope[:, 3, 1, 4] = 1.0  # driver and follower
        flat = slope.reshape(len(index), 4, -1)
        out[index] = flat @ covariance[index] @ flat.swapaxes(1, 2)
    return out
