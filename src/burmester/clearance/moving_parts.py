"""The moving parts of a linkage: the body's outline, and its links as bars with round ends.

A grounded link of two pins is a bar between its pivots; a slider on the ground is a bar without
length at its pivot; a slot in the body is part of the body.  The coupler is a bar between its two
moving pivots.  The width of the bars is taken off the distances of their middle lines.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple, final

import numpy as np

from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.geometry.shapes import distances
from burmester.numerics.arrays import FloatArray
from burmester.tasks.surroundings import Surroundings

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
class Pair:
    """A moving part of a linkage and what it must not touch.

    part, obstacle: their names.
    body, bar: the part, one of the two, or both where they must not touch each other; the bar, a
        number of `BAR_NAMES`, is then shortened by `lug` at its moving pivot.
    pins: (m, 2), of the bar in M.
    region: the obstacle in F.
    width: of the bar.
    """

    linkage: Linkage
    part: str
    obstacle: str
    body: Polygon | None
    bar: int | None
    pins: FloatArray
    region: Polygon | None
    width: float
    lug: float = 0.0

    def distances(self, places: Displacement) -> FloatArray:
        """How far apart they are at places (n,), not below 0."""
        apart = distances(*self.shapes(places)) - self.width / 2
        return np.maximum(apart, 0.0)

    def shapes(self, places: Displacement) -> tuple[FloatArray, FloatArray]:
        """The corners of both in F at places (n,), the bar without its width."""
        if self.bar is None:
            assert self.body is not None
            assert self.region is not None
            return places[:, None].act(self.body.vertices), self.region.vertices
        one = Linkage(self.linkage.first[None], self.linkage.second[None])
        ends = bars_of(one, places[None])[0, :, self.bar]
        if self.region is not None:
            return ends, self.region.vertices
        assert self.body is not None
        own = shortened(ends, np.asarray(self.lug))
        return own, places[:, None].act(self.body.vertices)

    def way(self, ways: Ways) -> FloatArray:
        """The longest way (n,) of any of their points, of both together where both move."""
        out = np.zeros_like(ways.turn)
        if self.body is not None:
            out = out + ways.of_points(self.body.vertices)
        if self.bar is not None:
            # Of a grounded link no point goes farther than its moving pivot.
            out = out + ways.of_points(self.pins)
        return out


def pairs_of(linkage: Linkage, body: Polygon | None, around: Surroundings) -> list[Pair]:
    """All that must not touch of one linkage, driven by its first dyad."""
    dyads, width, out = (linkage.first, linkage.second), around.link_width, list[Pair]()
    pins = {k: dyad.moving_pivot[None] for k, dyad in enumerate(dyads) if isinstance(dyad, RR | PR)}
    if len(pins) == 2:
        pins[2] = np.concatenate([pins[0], pins[1]])
    for name, keep_out in zip(around.names, around.keep_out, strict=True):
        region = keep_out.polygon
        if body is not None:
            out.append(Pair(linkage, BODY, name, body, None, np.empty((0, 2)), region, 0.0))
        for bar, own in pins.items():
            out.append(Pair(linkage, BAR_NAMES[bar], name, None, bar, own, region, width))
    if body is not None and around.body_in_plane:
        for bar, dyad in enumerate(dyads):
            if not isinstance(dyad, RR):
                continue
            lug = float(lugs(pins[bar], body, around)[0])
            if np.isfinite(lug):
                own = pins[bar]
                out.append(Pair(linkage, BAR_NAMES[bar], BODY, body, bar, own, None, width, lug))
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
