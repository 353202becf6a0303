"""At which of given frames parts of many linkages are too close: a condition in a search.

At the frames the distances are exact but for the outline of a body of many corners, which is taken
with fewer: to a five-hundredth of its size.  Between the frames nothing is looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.clearance.moving_parts import lugs, shortened
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.geometry.shapes import distances, simplified
from burmester.numerics.arrays import FloatArray
from burmester.tasks.surroundings import Surroundings

FEW_CORNERS: Final = 48  # an outline of more is taken with fewer
OUTLINE_TOLERANCE: Final = 2e-3  # of the outline's size


class _Pair(NamedTuple):
    """A part of linkages (k,) and an obstacle, at frames (n,).

    bounds: (k, n), below which no distance is; infinite where there is nothing.
    distances_at: the distances at rows and frames.
    """

    bounds: FloatArray
    distances_at: Callable[[NDArray[np.intp], NDArray[np.intp]], FloatArray]


def _pairs(
    places: Displacement,
    bars: FloatArray,
    body: Polygon | None,
    around: Surroundings,
    enough: float,
) -> Iterator[_Pair]:
    """All that must not touch; distances up to `enough` may be told as any up to it."""
    finite = np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1)
    half = around.link_width / 2
    for each in around.keep_out:
        if body is not None:
            yield _body_and_region(places, finite, body, each.polygon, enough)
        for number in range(bars.shape[2]):
            yield _bars_and_region(bars[:, :, number], each.polygon, half, enough)
    if body is not None and around.body_in_plane:
        for number in (0, 1):
            yield _links_and_body(places, bars[:, :, number], body, around, enough)


def shares_too_close(
    places: Displacement,
    bars: FloatArray,
    body: Polygon | None,
    around: Surroundings,
    slack: float,
) -> FloatArray:
    """The share (k,) of places of linkages (k, n) at which something is too close.

    It tells how far a linkage is from allowed.  Too close is what touches, or is nearer than the
    margin, by less than `slack` even where that is kept: for what comes nearer between the frames.
    bars: (k, n, m, 2, 2), their ends in F, `moving_parts.bars_of`; nan for bars that there are not.
    Places that are not finite are not too close.  body: its outline, in M.
    """
    within = around.margin + slack
    simple = None if body is None else _simplified(body)
    close = np.zeros(places.shape, dtype=bool)
    for bounds, distances_at in _pairs(places, bars, simple, around, within):
        row, frame = np.nonzero((bounds <= within) & ~close)
        if len(row):
            close[row, frame] = distances_at(row, frame) <= within
    return np.asarray(close.mean(axis=1))


def _body_and_region(
    places: Displacement,
    finite: NDArray[np.bool_],
    body: Polygon,
    region: Polygon,
    enough: float,
) -> _Pair:
    """The body and a region; whichever has fewer corners is moved."""
    middle = (body.vertices.min(axis=0) + body.vertices.max(axis=0)) / 2
    reach = float(np.linalg.norm(body.vertices - middle, axis=-1).max())
    at = places.act(middle)
    bounds = np.where(finite, _from_box(at, at, region) - reach, np.inf)

    def distances_at(row: NDArray[np.intp], frame: NDArray[np.intp]) -> FloatArray:
        some = places[row, frame]
        if len(region.vertices) < len(body.vertices):
            return distances(some.inverse()[:, None].act(region.vertices), body.vertices, enough)
        return distances(some[:, None].act(body.vertices), region.vertices, enough)

    return _Pair(bounds, distances_at)


def _bars_and_region(ends: FloatArray, region: Polygon, half: float, enough: float) -> _Pair:
    """Bars (k, n, 2, 2) and a region."""
    one, other = ends[..., 0, :], ends[..., 1, :]
    gap = _from_box(np.minimum(one, other), np.maximum(one, other), region)
    bounds = np.where(np.isnan(gap), np.inf, gap - half)
    return _Pair(bounds, lambda *at: distances(ends[at], region.vertices, enough + half) - half)


def _links_and_body(
    places: Displacement, ends: FloatArray, body: Polygon, around: Surroundings, enough: float
) -> _Pair:
    """The body and links (k, n, 2, 2) in its plane, those that have a length."""
    half = around.link_width / 2
    long = np.isfinite(ends).all(axis=(-1, -2)) & np.any(ends[:, :, 0] != ends[:, :, 1], axis=-1)
    long &= np.isfinite(places.angle)

    def distances_at(row: NDArray[np.intp], frame: NDArray[np.intp]) -> FloatArray:
        own = places[row, frame].inverse()[:, None].act(ends[row, frame])
        _, first, linkage = np.unique(row, return_index=True, return_inverse=True)
        lug = lugs(own[first, 1], body, around)[linkage]
        return distances(shortened(own, lug), body.vertices, enough + half) - half

    return _Pair(np.where(long, -np.inf, np.inf), distances_at)


def _from_box(low: FloatArray, high: FloatArray, region: Polygon) -> FloatArray:
    """How far boxes from low to high (*, 2) are from the box about a region, (*,); nan stays."""
    least, most = region.vertices.min(axis=0), region.vertices.max(axis=0)
    square = np.zeros(low.shape[:-1])
    for k in (0, 1):  # an axis of two is slow to reduce
        gap = np.maximum(np.maximum(least[k] - high[..., k], low[..., k] - most[k]), 0.0)
        square = square + gap * gap
    return np.sqrt(square)


def _simplified(body: Polygon) -> Polygon:
    """An outline with fewer corners, where it has many."""
    if len(body.vertices) <= FEW_CORNERS:
        return body
    size = float(np.linalg.norm(np.ptp(body.vertices, axis=0)))
    return Polygon(simplified(body.vertices, OUTLINE_TOLERANCE * size))
