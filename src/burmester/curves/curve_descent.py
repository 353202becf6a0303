"""The nearest coupler curves, from many start values: Levenberg and Marquardt's method.

Untimed, each task point counts by its distance from the curve.  Its crank angle t is eliminated:
the derivative of the distance by the dimensions is that of the curve along its normal, with t
fixed (the foot of the normal moves along the curve).  Feet are followed from step to step, so that
they keep the order in which they began.  Timed, both components count, and the crank angles are
given but for one phase.

Between the points the curve may not leave their chords by more than is allowed; what it leaves them
by beyond that counts as a distance does, and more.  Sizes are bounded: without bounds some paths
run away to infinitely long links.  The steps are those of `curve_kernel`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from burmester.curves.crank_linkages import CrankLinkages
from burmester.curves.curve_kernel import descend as descend_one_by_one
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.progress import goes_on

SETTLED = 1e-13  # relative gain of the cost below which a step is the last
AT_ONCE = 50  # linkages that descend between two looks at the time


class PathTarget(NamedTuple):
    """Points (n,) of a path as complex numbers, about 1 in size, and what else is asked.

    share: (n,), square roots of weights; turns: the crank goes all the way round;
    timing: (n,), crank angles but for one phase, or None.
    transmission: the least transmission angle at the feet, or over the whole turn, in radians, and
    ratio: the longest link over the shortest; what they are missed by counts much.
    unbroken: whether linkages have to assemble between the points of an open path as well.
    allowed: (g, 2), how far the arcs between neighbouring points may leave their chords where the
    points are met, and at most where they are missed, or None.
    """

    points: ComplexArray
    share: FloatArray
    turns: bool
    timing: FloatArray | None = None
    transmission: float | None = None
    ratio: float = math.inf
    unbroken: bool = True
    allowed: FloatArray | None = None


class CurveFit(NamedTuple):
    """Linkages (k,), the crank angles (k, n) of their feet, and the sums of squares (k,)."""

    linkages: CrankLinkages
    t: FloatArray
    cost: FloatArray


def descend(
    start: CurveFit, target: PathTarget, steps: int, *, settled: float = SETTLED
) -> CurveFit:
    """The fits after at most so many steps; those that do not assemble keep an infinite cost.

    Crank angles are those of the feet at the end.
    settled: relative gain of the cost below which a step is the last.
    Fits for which there is no time are measured as they begin.
    """
    number = len(start.cost)
    dimensions = np.array(start.linkages.dimensions, dtype=np.float64, order="C")
    assembly = np.array(start.linkages.assembly, dtype=np.float64)
    t, cost = np.array(start.t, dtype=np.float64, order="C"), np.empty(number)
    points = np.column_stack([target.points.real, target.points.imag, target.share])
    timing = np.empty(0) if target.timing is None else np.array(target.timing, dtype=np.float64)
    none = np.empty((0, 2))
    allowed = none if target.allowed is None else np.array(target.allowed, dtype=np.float64)
    cosine = 2.0 if target.transmission is None else math.cos(target.transmission)
    ratio = math.inf if target.transmission is None else target.ratio
    for at in range(0, number, AT_ONCE):
        some = slice(at, at + AT_ONCE)
        descend_one_by_one(
            dimensions[some],
            assembly[some],
            t[some],
            cost[some],
            points,
            timing,
            allowed,
            target.turns,
            target.unbroken and not target.turns,
            cosine,
            ratio,
            steps if goes_on(at + 1, number, "linkage") else 0,
            settled,
        )
    return CurveFit(CrankLinkages(dimensions, assembly), t, cost)
