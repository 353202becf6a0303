"""Linkages through nine points of an open arc, to start from where all its points are to be traced.

A four-bar can be made to pass nine points, and all that do are found (`points.real_linkages`).
Those whose crank goes one way through the nine pass the others not far from them as a rule.
"""

from __future__ import annotations

import numpy as np

from burmester.curves.crank_linkages import CrankLinkages
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, even_numbers
from burmester.points.point_sets import line_or_circle
from burmester.points.real_linkages import linkages_through

__all__ = ["nine_point_starts"]

NINE = 9


def nine_point_starts(points: FloatArray) -> list[tuple[CrankLinkages, FloatArray]]:
    """Linkages (k,) through nine of points (N, 2), evenly chosen, and crank angles (k, N) at all.

    By each of their dyads as the crank.  None where nine points lie on a line or a circle.
    """
    index = even_numbers(len(points), NINE)
    nine = points[index]
    if len(nine) < NINE or line_or_circle(nine) is not None:
        return []
    found = linkages_through(Displacement(nine, np.zeros(NINE)), np.ones(NINE, dtype=bool))
    out = []
    for batch in (found.batch, found.batch.exchanged()):
        linkages, t = CrankLinkages.of(batch, found.places)
        steps = np.diff(t, axis=1)
        one_way = (steps > 0).all(axis=1) | (steps < 0).all(axis=1)
        every = [np.interp(np.arange(len(points)), index, row) for row in t[one_way]]
        out.append((linkages[one_way], np.reshape(every, (int(one_way.sum()), len(points)))))
    return out
