"""The gaps between neighbouring points of a path, and the arcs of a curve that cross them.

A curve that passes points need not follow their path: between two of them it may go anywhere.  The
arc of a gap is the curve from one point's place to the next one's in the sense of travel, and its
bulge is the greatest distance of the arc from the chord of the gap.  On a circle of n points that
is tan(pi/2n)/2 chords; on a curve that n points follow at equal steps of arc length it is half a
step at most, however sharp its tips are.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

STEPS: Final = (4, 64, 960)  # steps of a sampled arc at least and at most, and of all arcs together
ROUNDS, TRIED = 6, 5  # of narrowing the bracket of the greatest distance: to a half in each round
MOST_NARROWED: Final = 400  # gaps of each linkage
ALLOWED_STEPS: Final = 0.5  # steps of the points; a bulge of less may be that of the path itself
# Diameters of the path.  A curve leaves it by no more where the points themselves say where it is.
ALLOWED_DIAMETERS: Final = 0.1
DIRECTIONS: Final = 32  # in which the diameter is measured
ROUNDING: Final = 1e-9  # diameters
MOST_OPEN: Final = 9  # points; a linkage can meet so many, and leave the way between them open


def are_drawing(count: int, *, closed: bool, timed: bool) -> bool:
    """Whether so many points of a path say where the curve goes between them, too."""
    return count > MOST_OPEN or (closed and not timed)


class PathGaps(NamedTuple):
    """The gaps (g,) of a path through points (N,), as complex numbers.

    begin, end: (g,), the points beside each; step: (g,), how far neighbours are apart here: the
    longest chord of the gap and the two beside it.
    closed: whether the last gap leads from the last point to the first; diameter: of the points.
    """

    begin: ComplexArray
    end: ComplexArray
    step: FloatArray
    closed: bool
    diameter: float

    @classmethod
    def of(cls, points: FloatArray, *, closed: bool) -> Self:
        """The gaps of points (N, 2), two or more, in the order in which they are traced."""
        z = complex_of(points)
        begin, end = (z, np.roll(z, -1)) if closed else (z[:-1], z[1:])
        chord = np.abs(end - begin)
        beside = np.pad(chord, 1, mode="wrap" if closed else "edge")
        step = np.maximum(chord, np.maximum(beside[:-2], beside[2:]))
        turns = np.exp(1j * np.linspace(0, math.pi, DIRECTIONS, endpoint=False))
        diameter = max(float(np.ptp((z * turn).real)) for turn in turns)
        return cls(begin, end, step, closed, diameter)

    def allowed(self, tolerance: float | FloatArray = 0.0) -> FloatArray:
        """The bulges (g,) up to which an arc follows the path.

        tolerance: by which the points may be missed, one number or of each gap (g,).
        """
        spacing = ALLOWED_STEPS * self.step
        most = np.maximum(spacing, ALLOWED_DIAMETERS * self.diameter)
        return np.asarray(np.minimum(spacing + tolerance, most) + ROUNDING * self.diameter)

    def ends(self, along: FloatArray, period: float | FloatArray = 0.0) -> FloatArray:
        """Parameters (k, g, 2) at both ends of the arcs, from those of the points (k, N).

        period: of the parameter, one number or (k,), where a closed curve goes on from the last
        point to the first; 0 where it goes back.
        """
        begin, end = along[:, :-1], along[:, 1:]
        if self.closed:
            sense = np.sign(along[:, -1] - along[:, 0])
            begin, last = along, along[:, 0] + sense * period
            end = np.concatenate([end, last[:, None]], axis=1)
        return np.stack([begin, end], axis=-1)

    def sampled(self, curve: Callable[[FloatArray], ComplexArray], ends: FloatArray) -> _Arcs:
        """The arcs of linkages (k,) between `ends` (k, g, 2).

        curve: the coupler points (k, m) at parameters (k, m).
        """
        least, most, every = STEPS
        steps = min(max(every // max(len(self.begin), 1), least), most)
        parameter = ends[..., :1] + np.linspace(0, 1, steps + 1) * (ends[..., 1:] - ends[..., :1])
        points = curve(parameter.reshape(len(ends), -1)).reshape(parameter.shape)
        return _Arcs(parameter, points, self.away(points))

    def bulges(self, curve: Callable[[FloatArray], ComplexArray], ends: FloatArray) -> FloatArray:
        """The bulges (k, g) of arcs as in `sampled`; nan where a parameter does not exist.

        Of more than MOST_NARROWED gaps only those are narrowed whose samples stray most.
        """
        arcs = self.sampled(curve, ends)
        away = np.nan_to_num(arcs.away, nan=-1.0)
        bulge = away.max(axis=-1)
        most = min(MOST_NARROWED, bulge.shape[-1])
        excess = bulge - ALLOWED_STEPS * self.step
        gap = np.argpartition(excess, -most, axis=-1)[:, -most:]
        own = np.arange(len(ends))[:, None], gap
        at = away[own].argmax(axis=-1)[..., None]
        middle = np.take_along_axis(arcs.parameter[own], at, axis=-1)
        low, high = ends[own].min(axis=-1, keepdims=True), ends[own].max(axis=-1, keepdims=True)
        reach = (high - low) / (away.shape[-1] - 1)
        for _ in range(ROUNDS):
            tried = np.clip(middle + reach * np.linspace(-1, 1, TRIED), low, high)
            points = curve(tried.reshape(len(ends), -1)).reshape(tried.shape)
            away = np.nan_to_num(self.away(points, gap), nan=-1.0)
            at = away.argmax(axis=-1)[..., None]
            bulge[own] = np.maximum(bulge[own], away.max(axis=-1))
            middle, reach = np.take_along_axis(tried, at, axis=-1), reach / 2
        return np.where(bulge < 0, np.nan, bulge)

    def away(self, points: ComplexArray, gap: NDArray[np.intp] | None = None) -> FloatArray:
        """The distances (k, g, m) of points (k, g, m) from the chords of their gaps.

        gap: (k, g), the numbers of the gaps; None: all of them, in their order.
        """
        begin, end = self.begin[..., None], self.end[..., None]
        if gap is not None:
            begin, end = self.begin[gap][..., None], self.end[gap][..., None]
        chord = end - begin
        to = points - begin
        squared = np.maximum(np.abs(chord) ** 2, np.finfo(float).tiny)
        along = np.clip((chord.conj() * to).real / squared, 0.0, 1.0)
        return np.asarray(np.abs(to - along * chord))


class _Arcs(NamedTuple):
    """Sampled arcs: parameters and coupler points (k, g, m), and how far these are from chords."""

    parameter: FloatArray
    points: ComplexArray
    away: FloatArray
