"""The moving parts of a linkage: the body's outline, and its links as bars with round ends.

A grounded link of two pins is a bar between its pivots; a slider on the ground is a bar without
length at its pivot; a slot in the body is part of the body.  The coupler is a bar between its two
moving pivots.  The width of the bars is taken off the distances of their middle lines.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple, TypeAlias, final

import numpy as np
import shapely
from numpy.typing import NDArray

from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.tasks.surroundings import Surroundings

Geometries: TypeAlias = NDArray[np.object_]

BODY: Final = "the body"
BAR_NAMES: Final = ("the driver", "the follower", "the coupler")
# Share of the way out of the body, from a pivot within it: about that pivot a link may lie over the
# body so far.  Twice the shortest way: it may leave a straight edge at 30 degrees.
WAYS_OUT: Final = 2.0
LUG: Final = 0.02  # of the outline's size: how far a bar without width may lie over the body


class Ways(NamedTuple):
    """The ways of a coupler between neighbouring frames (n,), none longer than told.

    pivots: the moving pivots in M, those that there are; travel: their ways (pivots, n), lengths;
    turn: (n,), radians.
    """

    pivots: FloatArray
    travel: FloatArray
    turn: FloatArray

    def of_points(self, points: FloatArray) -> FloatArray:
        """The longest way (n,) of points (k, 2) of M: that of a pivot and that about it."""
        away = np.linalg.norm(points - self.pivots[:, None], axis=-1).max(axis=1)
        return np.asarray((self.travel + away[:, None] * self.turn).min(axis=0))


@final
@dataclass(frozen=True, slots=True, eq=False)
class BarOfLinkage:
    """A bar of one linkage: between a point of F, or none, and points of M.

    number: its place in `BAR_NAMES`.
    """

    number: int
    ground: FloatArray | None
    moving: FloatArray

    def ends(self, places: Displacement) -> FloatArray:
        """The ends (n, 2, 2) in F at places (n,)."""
        at = places[:, None].act(self.moving)
        if self.ground is None:
            return np.asarray(at)
        return np.stack([np.broadcast_to(self.ground, at[:, 0].shape), at[:, 0]], axis=1)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Pair:
    """A moving part and what it must not touch.

    part, obstacle: their names.
    body, bar: the part, one of the two, or both where they must not touch each other; the bar is
        then shortened by `lug` at its moving pivot.
    region: the obstacle in F.
    width: of the bar.
    """

    part: str
    obstacle: str
    body: Polygon | None
    bar: BarOfLinkage | None
    region: Polygon | None
    width: float
    lug: float = 0.0

    def distances(self, places: Displacement) -> FloatArray:
        """How far apart they are at places (n,), not below 0."""
        apart = distances(*self.shapes(places)) - self.width / 2
        return np.maximum(apart, 0.0)

    def shapes(self, places: Displacement) -> tuple[np.ndarray, object]:
        """Both as geometries of F at places (n,), the bar without its width."""
        if self.bar is None:
            assert self.body is not None
            assert self.region is not None
            return moved(self.body, places), area(self.region)
        ends = self.bar.ends(places)
        if self.region is not None:
            return segments(ends), area(self.region)
        assert self.body is not None
        return segments(shortened(ends, np.asarray(self.lug))), moved(self.body, places)

    def way(self, ways: Ways) -> FloatArray:
        """The longest way (n,) of any of their points, of both together where both move."""
        out = np.zeros_like(ways.turn)
        if self.body is not None:
            out = out + ways.of_points(self.body.vertices)
        if self.bar is not None:
            # Of a grounded link no point goes farther than its moving pivot.
            out = out + ways.of_points(self.bar.moving)
        return out


def pairs_of(linkage: Linkage, body: Polygon | None, around: Surroundings) -> list[Pair]:
    """All that must not touch of one linkage, driven by its first dyad."""
    bars = _bars(linkage)
    width = around.link_width
    out = []
    for name, region in zip(around.names, around.keep_out, strict=True):
        if body is not None:
            out.append(Pair(BODY, name, body, None, region.polygon, 0.0))
        out += [Pair(BAR_NAMES[b.number], name, None, b, region.polygon, width) for b in bars]
    if body is not None and around.body_in_plane:
        for bar in bars:
            if bar.ground is None:
                continue
            lug = float(lugs(bar.moving, body, around)[0])
            if np.isfinite(lug):
                out.append(Pair(BAR_NAMES[bar.number], BODY, body, bar, None, width, lug))
    return out


def lugs(pivots: FloatArray, body: Polygon, around: Surroundings) -> FloatArray:
    """How far links may lie over the body about their moving pivots (k, 2) of M, (k,)."""
    size = float(np.linalg.norm(np.ptp(body.vertices, axis=0)))
    depth = np.maximum(-body.signed_distance(pivots), 0.0)
    return np.asarray(WAYS_OUT * depth + max(around.link_width + around.margin, LUG * size))


def shortened(ends: FloatArray, lug: FloatArray) -> FloatArray:
    """Bars (*, 2, 2) without their last pieces of length lug (*,); points where none is left."""
    along = ends[..., 1, :] - ends[..., 0, :]
    length = np.linalg.norm(along, axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.clip(1 - lug / length, 0.0, 1.0)
    return np.stack([ends[..., 0, :], ends[..., 0, :] + share[..., None] * along], axis=-2)


def _bars(linkage: Linkage) -> list[BarOfLinkage]:
    """The bars of one linkage."""
    out = []
    pins = []
    for number, dyad in enumerate((linkage.first, linkage.second)):
        if isinstance(dyad, RR | PR):
            pins.append(dyad.moving_pivot)
            ground = dyad.fixed_pivot if isinstance(dyad, RR) else None
            points = dyad.moving_pivot[None] if isinstance(dyad, RR) else np.stack([pins[-1]] * 2)
            out.append(BarOfLinkage(number, ground, points))
    if len(pins) == 2:
        out.append(BarOfLinkage(2, None, np.stack(pins)))
    return out


def bars_of(linkage: Linkage, places: Displacement) -> FloatArray:
    """The ends (k, n, 3, 2, 2) of the bars of linkages (k,) at places (k, n), by `BAR_NAMES`.

    The first end of a grounded link is its fixed pivot.  nan for bars that there are not.
    """
    count, frames = places.shape
    out = np.full((count, frames, 3, 2, 2), np.nan)
    for number, dyad in enumerate((linkage.first, linkage.second)):
        if isinstance(dyad, RR | PR):
            pin = places.act(dyad.moving_pivot[:, None])
            out[:, :, number, 1] = pin
            out[:, :, number, 0] = dyad.fixed_pivot[:, None] if isinstance(dyad, RR) else pin
    out[:, :, 2, 0], out[:, :, 2, 1] = out[:, :, 0, 1], out[:, :, 1, 1]
    return out


def area(polygon: Polygon) -> shapely.Polygon:
    """The inside and the edge of a polygon."""
    return shapely.Polygon(polygon.vertices)


def moved(polygon: Polygon, places: Displacement) -> Geometries:
    """A polygon of M in F, at places (n,); all of its places are finite."""
    return np.asarray(shapely.polygons(places[:, None].act(polygon.vertices)))


def segments(ends: FloatArray) -> Geometries:
    """Segments between ends (n, 2, 2), points where both ends are one."""
    return np.asarray(shapely.linestrings(ends))


def distances(ones: Geometries, others: Geometries | shapely.Geometry) -> FloatArray:
    """How far shapes are apart, (n,); 0 where they touch or overlap."""
    return np.asarray(shapely.distance(ones, others), dtype=np.float64)
