"""Regions of the plane: a point, a line, a segment, a polygon, and their faces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Final, NamedTuple, TypeAlias, final

import numpy as np

from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import unit_vectors
from burmester.values import Shape, real_numbers

# Corners of a polygon: every edge is compared with every other one; flattened arcs have some 100.
MAX_CORNERS = 2000
MAX_SEARCHED_CORNERS = 100  # where each edge and corner is searched, a second or two for as many
MAX_COORDINATE = 1e60  # length; fourth powers of greater ones overflow, refused with E112
MIN_WIDTH = 1e-12  # share of a polygon's length; a narrower polygon has no inside
STRAIGHT_CORNER_SINE = 1e-9  # of the turn at a corner; below it both edges count as one line


MAX_SIDES: Final = 8  # number of sides of a convex polygon that are conditions each


class Face(NamedTuple):
    """A piece of a region: origin (2,) + basis (2, dimension) u, for all u.

    inward: (k, 2), unit directions that lead from the face into the region, the outermost of
        them (where they are more than half a turn apart, one between as well); none where the
        region is no wider than the face.
    """

    origin: FloatArray
    basis: FloatArray
    inward: FloatArray


PLANE: Final = Face(np.zeros(2), np.eye(2), np.empty((0, 2)))


@final
@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """One point of the plane.

    Parameters
    ----------
    at : array_like, (2,)
        X, Y; kept as a read-only copy.

    Raises
    ------
    InputError
        E131 (not two finite real numbers), E112 (too large).

    Examples
    --------
    >>> print(Point([1, -2]))
    at (1, -2)
    """

    at: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", _coordinates(self.at, (2,), "a point"))

    def __str__(self) -> str:
        return f"at {_shown(self.at)}"

    def equations(self) -> FloatArray:
        """The linear conditions (k, 3) that it sets: row · (1, X, Y) = 0."""
        x, y = self.at
        return np.array([[-x, 1.0, 0.0], [-y, 0.0, 1.0]])

    def faces(self) -> Iterator[Face]:
        """Its pieces."""
        yield Face(self.at, np.empty((2, 0)), np.empty((0, 2)))

    def distance(self, points: FloatArray) -> FloatArray:
        """How far points (*, 2) lie outside it, (*,)."""
        return np.asarray(np.linalg.norm(points - self.at, axis=-1))

    def corners(self) -> FloatArray:
        """Points (k, 2) whose convex hull holds the region."""
        return self.at[None]


@dataclass(frozen=True, slots=True, eq=False)
class _Straight:
    """A region on the line through two points.

    Parameters
    ----------
    start, end : array_like, (2,)
        Two different points; kept as read-only copies.

    Raises
    ------
    InputError
        E131 (not two finite real numbers each, or twice the same point), E112 (too large, or too
        close together).
    """

    start: FloatArray
    end: FloatArray

    def __post_init__(self) -> None:
        kind = type(self).__name__.lower()
        start = _coordinates(self.start, (2,), f"the start of a {kind}")
        end = _coordinates(self.end, (2,), f"the end of a {kind}")
        if (start == end).all():
            raise InputError(
                "E131",
                f"a {kind} needs two different points, not {_shown(start)} twice",
                help="give another second point, or limit the pivot to that point",
            )
        if not (apart := float(np.hypot(*(end - start)))) > 1 / MAX_COORDINATE:
            raise InputError(
                "E112",
                f"the two points of a {kind} are too close together",
                why=f"the fourth power of {apart:g} is beyond what a number can hold",
                help="write the lengths in another unit",
            )
        object.__setattr__(self, "start", start)
        object.__setattr__(self, "end", end)

    def equations(self) -> FloatArray:
        """The linear conditions (k, 3) that it sets: row · (1, X, Y) = 0."""
        return _line_equation(self.start, self.end)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Line(_Straight):
    """The endless line through two points.

    Examples
    --------
    >>> print(Line([0, 0], [1, 1]))
    on the line through (0, 0) and (1, 1)
    """

    def __str__(self) -> str:
        return f"on the line through {_shown(self.start)} and {_shown(self.end)}"

    def faces(self) -> Iterator[Face]:
        """Its pieces."""
        yield Face(self.start, unit_vectors(self.end - self.start)[:, None], np.empty((0, 2)))

    def distance(self, points: FloatArray) -> FloatArray:
        """How far points (*, 2) lie outside it, (*,)."""
        row = self.equations()[0]
        return np.asarray(np.abs(points @ row[1:] + row[0]))

    def corners(self) -> None:
        """None: no points hold it."""


@final
@dataclass(frozen=True, slots=True, eq=False)
class Segment(_Straight):
    """The straight piece between two points.

    Examples
    --------
    >>> print(Segment([0, 0], [1, 1]))
    on the segment from (0, 0) to (1, 1)
    """

    def __str__(self) -> str:
        return f"on the segment from {_shown(self.start)} to {_shown(self.end)}"

    def faces(self) -> Iterator[Face]:
        """Its pieces."""
        along = unit_vectors(self.end - self.start)
        yield Face(self.start, along[:, None], np.empty((0, 2)))
        for at, inward in ((self.start, along), (self.end, -along)):
            yield Face(at, np.empty((2, 0)), inward[None])

    def distance(self, points: FloatArray) -> FloatArray:
        """How far points (*, 2) lie outside it, (*,)."""
        return _from_segment(points, self.start, self.end)

    def corners(self) -> FloatArray:
        """Points (k, 2) whose convex hull holds the region."""
        return np.stack([self.start, self.end])


@final
@dataclass(frozen=True, slots=True, eq=False)
class Polygon:
    """The inside and the edge of a polygon, convex or not.

    Parameters
    ----------
    vertices : array_like, (n, 2)
        At least three corners, in order around the polygon in either sense; repeats of the corner
        before are left out.  Kept counterclockwise, as a read-only copy.

    Attributes
    ----------
    is_convex : bool
        Whether no corner points into it.
    outward, reach : ndarray, (2, n) and (n,)
        Of each edge, a normal as long as the edge that points out, and its product with the edge's
        points.

    Raises
    ------
    InputError
        E131 (not rows of two finite real numbers, no inside, edges that cross or touch, more than
        2000 corners), E112 (too large).

    Examples
    --------
    >>> triangle = Polygon([(0, 0), (2, 0), (0, 2)])
    >>> triangle.distance(np.array([[0.5, 0.5], [-3.0, 0.0]]))
    array([0., 3.])
    """

    vertices: FloatArray
    is_convex: bool = field(init=False, repr=False)
    outward: FloatArray = field(init=False, repr=False)
    reach: FloatArray = field(init=False, repr=False)

    def __post_init__(self) -> None:
        v = _coordinates(self.vertices, (None, 2), "the corners of a polygon")
        v = v[np.any(v != np.roll(v, 1, axis=0), axis=1)]
        if len(v) > MAX_CORNERS:
            raise InputError(
                "E131",
                f"a polygon of {len(v)} corners",
                why="every edge is compared with every other one",
                help=f"take {MAX_CORNERS} of its corners at most",
            )
        values = np.linalg.svd(v - v[:1], compute_uv=False) if len(v) > 2 else np.zeros(2)
        if len(v) < 3 or values[1] <= _least_width(v):
            raise InputError(
                "E131",
                "a polygon has no inside",
                why=f"its {max(len(v), 1)} different corners lie on one line",
                help="give three corners or more that enclose one, or a line or a point instead",
            )
        if (meeting := first_meeting(v)) is not None:
            raise InputError(
                "E131",
                f"a polygon crosses itself near {_shown(meeting.at)}",
                why=f"the edges behind its corners {meeting.first + 1} and {meeting.second + 1} "
                "meet there",
                help="give its corners in order around it",
            )
        x, y = (v - v[0]).T
        area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
        v = v if area > 0 else v[::-1]
        x, y = np.roll(v, -1, axis=0).T - v.T
        outward = np.stack([y, -x])
        reach = (v * outward.T).sum(axis=1)
        for each in (v, outward, reach):
            each.setflags(write=False)
        object.__setattr__(self, "vertices", v)
        object.__setattr__(self, "outward", outward)
        object.__setattr__(self, "reach", reach)
        turns = x * np.roll(y, -1) >= y * np.roll(x, -1)
        object.__setattr__(self, "is_convex", bool(turns.all()))

    def __str__(self) -> str:
        low, high = self.vertices.min(axis=0), self.vertices.max(axis=0)
        on_bounds = ((self.vertices == low) | (self.vertices == high)).all()
        if on_bounds and len(self.vertices) == 4:
            return f"in the box from {_shown(low)} to {_shown(high)}"
        return "in the polygon " + " ".join(map(_shown, self.vertices))

    def equations(self) -> FloatArray:
        """None: no linear conditions, (0, 3)."""
        return np.empty((0, 3))

    def faces(self) -> Iterator[Face]:
        """Its pieces: the inside, the edges, the corners."""
        yield PLANE
        v = self.vertices
        along = unit_vectors(np.roll(v, -1, axis=0) - v)
        inward = np.stack([-along[:, 1], along[:, 0]], axis=-1)
        for at, edge, inside in zip(v, along, inward, strict=True):
            yield Face(at, edge[:, None], inside[None])
        for k, at in enumerate(v):
            ways = [along[k], -along[k - 1]]
            if (
                along[k] @ inward[k - 1] < STRAIGHT_CORNER_SINE
            ):  # straight, or pointing into the polygon
                ways.append(unit_vectors(inward[k] + inward[k - 1]))
            yield Face(at, np.empty((2, 0)), np.stack(ways))

    def distance(self, points: FloatArray) -> FloatArray:
        """How far points (*, 2) lie outside it, (*,)."""
        return np.maximum(self.signed_distance(points), 0.0)

    def signed_distance(self, points: FloatArray) -> FloatArray:
        """How far points (*, 2) lie outside it, (*,), or inside where negative."""
        return outside_corners(points, self.vertices)

    def corners(self) -> FloatArray:
        """Points (k, 2) whose convex hull holds the region."""
        return self.vertices


Region: TypeAlias = Point | Line | Segment | Polygon


def box(low: Sequence[float], high: Sequence[float]) -> Region:
    """The box between two opposite corners, with sides along X and Y.

    Without a width that its numbers could tell it is a segment, without width and height a point.

    Parameters
    ----------
    low, high : array_like, (2,)
        The lower left and the upper right corner.

    Returns
    -------
    Polygon, Segment or Point

    Raises
    ------
    InputError
        E131 (not two finite real numbers each), E132 (`high` below or left of `low`), E112
        (too large).

    Examples
    --------
    >>> print(box((0, 0), (4, 2.5)))
    in the box from (0, 0) to (4, 2.5)
    >>> print(box((0, 0), (4, 0)))
    on the segment from (0, 0) to (4, 0)
    """
    x0, y0 = _coordinates(low, (2,), "the lower left corner of a box")
    x1, y1 = _coordinates(high, (2,), "the upper right corner of a box")
    for name, least, most in (("x", x0, x1), ("y", y0, y1)):
        if not least <= most:
            raise InputError(
                "E132",
                f"a box is empty: {name} from {least:g} to {most:g}",
                why=f"its least {name}, {least:g}, is above its greatest, {most:g}",
                help="give the lower left corner first, then the upper right one",
            )
    corners = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    if min(x1 - x0, y1 - y0) > _least_width(corners):
        return Polygon(corners)
    return _flat(corners, _least_width(corners))


def box_around(points: FloatArray, margin: float) -> Polygon:
    """The box around points (k, 2), wider by a margin on each side."""
    (left, low), (right, high) = points.min(axis=0) - margin, points.max(axis=0) + margin
    return Polygon(np.array([(left, low), (right, low), (right, high), (left, high)]))


def narrowed(region: Region, width: float) -> Region:
    """What a region thinner than a width is: a segment, or a point if it is as short; else itself.

    They run through its middle.
    """
    corners = region.corners()
    if corners is None or isinstance(region, Point):
        return region
    (_, length), (_, across) = _extents(corners)
    if across > width or (isinstance(region, Segment) and length > width):
        return region
    return _flat(corners, width)


def _flat(corners: FloatArray, width: float) -> Segment | Point:
    """The segment through the middle of corners (k, 2), or a point if it is not longer."""
    (along, length), (across, _) = _extents(corners)
    origin = corners[0]
    shares = (corners - origin) @ np.stack([along, across], axis=-1)
    low, high = shares.min(axis=0), shares.max(axis=0)
    middle = origin + across * (low[1] + high[1]) / 2
    if length <= width:
        return Point(middle + along * (low[0] + high[0]) / 2)
    return Segment(middle + along * low[0], middle + along * high[0])


def _extents(corners: FloatArray) -> list[tuple[FloatArray, float]]:
    """The directions (2,) in which corners (k, 2) reach farthest and least, and how far."""
    offsets = corners - corners[0]
    _, _, axes = np.linalg.svd(offsets - offsets.mean(axis=0), full_matrices=True)
    return [(axis, float(np.ptp(offsets @ axis))) for axis in axes]


def _least_width(corners: FloatArray) -> float:
    """The width below which a polygon of corners (k, 2) has no inside that its numbers tell."""
    rounding = np.finfo(float).eps * len(corners) * np.abs(corners).max(initial=0)
    offsets = corners - corners[:1]
    return float(MIN_WIDTH * np.linalg.norm(offsets, 2) + rounding)


def _coordinates(values: object, shape: Shape, what: str) -> FloatArray:
    """A read-only copy of points that can be computed with, or E131 and E112."""
    points = real_numbers(values, shape, what, code="E131")
    if np.abs(points).max(initial=0.0) > MAX_COORDINATE:
        raise InputError(
            "E112",
            f"{what} is too far away",
            why=f"the fourth power of {np.abs(points).max():g} is beyond what a number can hold",
            help="write the lengths in another unit",
        )
    return points


def _shown(point: FloatArray) -> str:
    return f"({point[0]:g}, {point[1]:g})"


def _line_equation(start: FloatArray, end: FloatArray) -> FloatArray:
    along = unit_vectors(end - start)
    normal = np.array([-along[1], along[0]])
    return np.array([[-normal @ start, *normal]])


def outside_corners(points: FloatArray, vertices: FloatArray) -> FloatArray:
    """How far points (*, 2) lie outside corners (n, 2) in order, or inside where negative."""
    v, p = vertices, points[..., None, :]
    w = np.roll(v, -1, axis=0)
    # The rays to the right of a point inside cross an odd number of edges.
    above = (v[:, 1] > p[..., 1]) != (w[:, 1] > p[..., 1])
    rise = np.where(w[:, 1] == v[:, 1], 1.0, w[:, 1] - v[:, 1])
    crossing = v[:, 0] + (p[..., 1] - v[:, 1]) / rise * (w[:, 0] - v[:, 0])
    inside = (above & (p[..., 0] < crossing)).sum(axis=-1) % 2 == 1
    from_edge = _from_segment(p, v, w).min(axis=-1)
    return np.asarray(np.where(inside, -from_edge, from_edge))


def _from_segment(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """The distance of points (*, 2) from segments (*, 2), broadcast."""
    return np.asarray(np.linalg.norm(points - feet(points, start, end), axis=-1))


def feet(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """The points (*, 2) of segments (*, 2) nearest to points (*, 2), broadcast."""
    along = end - start
    share = ((points - start) * along).sum(axis=-1) / (along * along).sum(axis=-1)
    return np.asarray(start + np.clip(share, 0, 1)[..., None] * along)


class _Meeting(NamedTuple):
    """Two edges of a polygon that meet, by the numbers of the corners they begin at, and where."""

    first: int
    second: int
    at: FloatArray


def first_meeting(v: FloatArray) -> _Meeting | None:
    """The first two edges of a polygon that meet, neighbours only where one goes back."""
    w = np.roll(v, -1, axis=0)
    after = np.roll(w, -1, axis=0)
    back = (_side(v, w, after) == 0) & (((w - v) * (after - w)).sum(axis=-1) < 0)
    if back.any():
        k = int(back.argmax())
        return _Meeting(k, (k + 1) % len(v), w[k])
    low, high, count = np.minimum(v, w), np.maximum(v, w), len(v)
    for i, (a, b) in enumerate(zip(v, w, strict=True)):
        others = np.arange(i + 2, count - (i == 0))
        near = (low[others] <= high[i]).all(axis=-1) & (high[others] >= low[i]).all(axis=-1)
        others = others[near]
        c, d = v[others], w[others]
        ends = _side(a, b, c) * _side(a, b, d) <= 0
        meet = others[ends & (_side(c, d, a) * _side(c, d, b) <= 0)]
        if len(meet):
            j = int(meet[0])
            return _Meeting(i, j, _common_point(a, b, v[j], w[j]))
    return None


def _side(a: FloatArray, b: FloatArray, p: FloatArray) -> FloatArray:
    """On which side of the lines from a to b points lie, all (*, 2), broadcast: -1, 0 or 1."""
    along, to = b - a, p - a
    return np.asarray(np.sign(along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0]))


def _common_point(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> FloatArray:
    """A point (2,) that two segments share, which meet."""
    along, other, to = b - a, d - c, c - a
    cross = along[0] * other[1] - along[1] * other[0]
    if cross != 0:
        share = (to[0] * other[1] - to[1] * other[0]) / cross
    else:  # they overlap
        share = min(float(to @ along), float((d - a) @ along)) / float(along @ along)
    return np.asarray(a + np.clip(share, 0.0, 1.0) * along)


def require_searchable(region: Region) -> None:
    """Refuse a region with more edges and corners than a search goes through: E131."""
    if isinstance(region, Polygon) and len(region.vertices) > MAX_SEARCHED_CORNERS:
        raise InputError(
            "E131",
            f"a polygon of {len(region.vertices)} corners for pivots",
            why="every edge and every corner is searched by itself",
            help=f"take {MAX_SEARCHED_CORNERS} of its corners at most",
        )


def half_planes(region: Region) -> FloatArray | None:
    """Rows (m, 3) whose product with (1, X, Y) is 0 (the region's equations) or at most 0 in it.

    Each side of a convex polygon is one by itself: its distance has a kink at a corner, where a
    descent would be held.  None for other polygons, and such with many sides.
    """
    if isinstance(region, Polygon):
        return _sides(region)
    rows, ends = region.equations(), region.corners()
    if len(rows) == 2:
        return rows
    beyond = np.array([[-1.0, 0.0, 0.0]] * 2)
    if ends is not None:
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        beyond = np.array([[ends[0] @ along, *-along], [-ends[1] @ along, *along]])
    return np.concatenate([rows, beyond])


def _sides(polygon: Polygon) -> FloatArray | None:
    """The sides of a convex polygon, (k, 3): row · (1, X, Y) at most 0; else None."""
    v = polygon.corners()
    along = np.roll(v, -1, axis=0) - v
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    after = np.roll(along, -1, axis=0)
    turn = along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0]
    if len(v) > MAX_SIDES or (turn < 0).any():
        return None
    outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
    return np.column_stack([-(outward * v).sum(axis=1), outward])
