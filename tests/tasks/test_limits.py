"""Regions against points sampled from them, their faces against what lies around, and limits."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.tasks.limits import Limits

RNG = np.random.default_rng(5)

SHAPES = {
    "triangle": [(0, 0), (3, 1), (1, 2.5)],
    "clockwise": [(1, 2.5), (3, 1), (0, 0)],
    "box": [(-1, -0.5), (2, -0.5), (2, 1), (-1, 1)],
    "arrow": [(0, 0), (4, 2), (0, 4), (1.5, 2)],
    "corner": [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)],
    "star": [
        (r * np.cos(a), r * np.sin(a))
        for r, a in zip([2, 0.7] * 5, np.pi / 5 * np.arange(10) + 0.1, strict=True)
    ],
    "straight corner": [(0, 0), (1, 0), (2, 0), (2, 2)],
    "corner twice": [(0, 0), (0, 0), (2, 0), (2, 0), (1, 2), (0, 0)],
    "far away": [(1e6, -1e6), (1e6 + 3, -1e6 + 1), (1e6 + 1, -1e6 + 2.5)],
}


def outline(vertices, spacing):
    """Points on the edges, closer together than `spacing`."""
    v = np.asarray(vertices, float)
    pieces = []
    for a, b in zip(v, np.roll(v, -1, axis=0), strict=True):
        share = np.linspace(0, 1, 2 + int(np.linalg.norm(b - a) / spacing))[:, None]
        pieces.append(a + share * (b - a))
    return np.concatenate(pieces)


def turns_around(vertices, points):
    """How often the outline goes around each point: not 0 inside.  Sums of angles, no rays."""
    to = np.asarray(vertices, float) - points[:, None]
    angle = np.arctan2(to[..., 1], to[..., 0])
    step = np.roll(angle, -1, axis=1) - angle
    step = (step + np.pi) % (2 * np.pi) - np.pi
    return np.rint(step.sum(axis=1) / (2 * np.pi)).astype(int)


def around(vertices, count):
    """Random points in and around a shape."""
    v = np.asarray(vertices, float)
    size = np.ptp(v, axis=0)
    return v.mean(axis=0) + RNG.uniform(-1, 1, (count, 2)) * size


@pytest.mark.parametrize("name", SHAPES)
def test_distance_from_a_polygon_is_that_of_the_nearest_point_of_it(name):
    v = SHAPES[name]
    points, edge, spacing = around(v, 500), outline(v, 1e-3), 1e-3
    inside = turns_around(v, points) != 0
    assert 20 < inside.sum() < 480
    got = Polygon(np.array(v)).distance(points)
    assert (got[inside] == 0).all()
    out = points[~inside]
    sampled = np.array([np.linalg.norm(edge - p, axis=1).min() for p in out])
    assert (got[~inside] <= sampled + 1e-9).all()
    assert (got[~inside] >= sampled - spacing).all()


def test_distance_from_points_segments_and_lines():
    points = RNG.normal(scale=3, size=(200, 2))
    start, end = np.array([1.0, -0.5]), np.array([2.0, 3.0])
    share = np.linspace(0, 1, 4001)[:, None]
    for region, reach in ((Segment(start, end), (0, 1)), (Line(start, end), (-40, 40))):
        on_it = start + (reach[0] + share * (reach[1] - reach[0])) * (end - start)
        sampled = np.array([np.linalg.norm(on_it - p, axis=1).min() for p in points])
        spacing = np.linalg.norm(on_it[1] - on_it[0])
        got = region.distance(points)
        assert (got <= sampled + 1e-12).all()
        assert (got >= sampled - spacing).all()
    assert np.allclose(Point(start).distance(points), np.hypot(*(points - start).T))


@pytest.mark.parametrize("shape", [(), (3,), (2, 3)])
def test_distance_takes_any_leading_axes(shape):
    points = RNG.normal(size=(*shape, 2))
    for region in (
        Point([1, 0]),
        Line([0, 0], [1, 1]),
        Segment([0, 0], [1, 1]),
        box([0, 0], [1, 1]),
    ):
        one_by_one = [float(region.distance(p)) for p in points.reshape(-1, 2)]
        assert np.allclose(region.distance(points).ravel(), one_by_one, rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", SHAPES)
def test_every_piece_of_the_outline_is_on_a_face(name):
    faces = list(Polygon(np.array(SHAPES[name])).faces())
    assert [face.basis.shape[1] for face in faces].count(2) == 1
    edges = [face for face in faces if face.basis.shape[1] == 1]
    corners = [face for face in faces if face.basis.shape[1] == 0]
    for p in outline(SHAPES[name], 0.1):
        off = [abs(np.linalg.det(np.stack([p - face.origin, face.basis[:, 0]]))) for face in edges]
        assert min(off) < 1e-9
    different = {tuple(corner) for corner in SHAPES[name]}
    assert {tuple(face.origin) for face in corners} == different


WAYS = np.exp(1j * (np.linspace(0, 2 * np.pi, 180, endpoint=False) + 0.007))
WAYS = np.stack([WAYS.real, WAYS.imag], axis=-1)


@pytest.mark.parametrize("name", SHAPES)
def test_no_way_into_a_polygon_is_missed_by_the_inward_directions(name):
    """A slope that rises along all inward directions of a face rises along all ways in.

    On an edge only slopes across it count: along it the point on the face is the best already.
    """
    v = SHAPES[name]
    shape = Polygon(np.array(v))
    step = 1e-3  # the ways in are those that are inside after one step
    for face in shape.faces():
        at, slopes = face.origin, WAYS
        if face.basis.shape[1] == 2:
            assert len(face.inward) == 0
            continue
        if face.basis.shape[1] == 1:
            along = face.basis[:, 0]
            at = at + 0.3 * along  # every edge is longer than that
            slopes = np.array([[-along[1], along[0]], [along[1], -along[0]]])
        leads_in = WAYS[turns_around(v, at + step * WAYS) != 0]
        assert 0 < len(leads_in) < len(WAYS)
        rises = (slopes @ face.inward.T >= 0).all(axis=1)
        assert (slopes[rises] @ leads_in.T >= -1e-6).all()
        if abs(len(leads_in) - len(WAYS) / 2) > 1:
            assert rises.any() == (len(leads_in) < len(WAYS) / 2)  # nothing is best in a dent
        assert shape.distance(at + step * face.inward).max() < 1e-9
        assert np.allclose(np.linalg.norm(face.inward, axis=1), 1)


def test_inward_directions_of_a_segment_lead_along_it():
    segment = Segment([1, 1], [4, 5])
    line, *ends = segment.faces()
    assert line.basis.shape == (2, 1)
    assert len(line.inward) == 0
    assert {tuple(end.origin) for end in ends} == {(1.0, 1.0), (4.0, 5.0)}
    for end in ends:
        assert segment.distance(end.origin + 0.1 * end.inward).max() < 1e-12
        assert segment.distance(end.origin - 0.1 * end.inward).min() > 0.09


def test_equations_vanish_on_the_region_alone():
    for region, on_it in (
        (Point([2, -1]), [(2, -1)]),
        (Line([0, 1], [2, 2]), [(-4, -1), (0, 1), (6, 4)]),
        (Segment([0, 1], [2, 2]), [(0, 1), (1, 1.5)]),
    ):
        for x, y in on_it:
            assert np.abs(region.equations() @ [1, x, y]).max() < 1e-12
        assert np.abs(region.equations() @ [1, 0.3, 7.0]).max() > 0.1
        assert np.linalg.matrix_rank(region.equations()) == len(region.equations())
    assert len(box([0, 0], [1, 1]).equations()) == 0


def test_corners_hold_the_region():
    for v in SHAPES.values():
        shape = Polygon(np.array(v))
        corners = {tuple(corner) for corner in shape.corners()}
        assert corners == {tuple(map(float, corner)) for corner in v}
    assert Line([0, 0], [1, 0]).corners() is None


def test_regions_are_said_as_their_user_would():
    assert str(box([0, 0], [4, 2.5])) == "in the box from (0, 0) to (4, 2.5)"
    assert str(Polygon(np.array([(0, 0), (1, 0), (0, 2)]))) == "in the polygon (0, 0) (1, 0) (0, 2)"
    assert str(Point([1, -2])) == "at (1, -2)"
    assert "line through (0, 0) and (1, 1)" in str(Line([0, 0], [1, 1]))
    assert "segment from (0, 0) to (1, 1)" in str(Segment([0, 0], [1, 1]))


MALFORMED = {
    "a point of three": lambda: Point([1, 2, 3]),
    "not finite": lambda: Point([1, np.nan]),
    "a line of one point": lambda: Line([1, 2], [1, 2]),
    "a segment of one point": lambda: Segment([1, 2], [1, 2]),
    "two corners": lambda: Polygon(np.array([(0, 0), (1, 1)])),
    "no area": lambda: Polygon(np.array([(0, 0), (1, 0.3), (0.5, 0.15)])),
    "bow tie": lambda: Polygon(np.array([(0, 0), (2, 2), (2, 0), (0, 1)])),
    "folded back": lambda: Polygon(np.array([(0, 0), (4, 0), (2, 0), (3, 3)])),
    "a corner on another edge": lambda: Polygon(np.array([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)])),
    "length not a number": lambda: Limits(length=(np.nan, 2)),
    "length below zero": lambda: Limits(length=(-1, 2)),
    "length zero": lambda: Limits(length=(0, 0)),
    "no kind": lambda: Limits(kinds=frozenset()),
    "unknown kind": lambda: Limits(kinds=frozenset({"RR", "RRR"})),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("name", MALFORMED)
def test_what_is_no_limit_is_refused(name):
    with pytest.raises(InputError) as caught:
        MALFORMED[name]()
    assert caught.value.code == "E131"
    assert caught.value.help


CONTRADICTIONS = {
    "empty box": (lambda: box([1, 0], [0, 2]), ["x from 1 to 0"]),
    "box upside down": (lambda: box([0, 3], [1, 2]), ["y from 3 to 2"]),
    "length": (lambda: Limits(length=(5, 2)), ["at least 5 long", "at most 2 long"]),
    "slider with a fixed pivot": (
        lambda: Limits(fixed_pivot=Point([1, 2]), kinds=frozenset({"PR"})),
        ["fixed pivot at (1, 2)", "PR only"],
    ),
    "slot with a moving pivot": (
        lambda: Limits(moving_pivot=box([0, 0], [1, 1]), kinds=frozenset({"RP", "PP"})),
        ["moving pivot in the box from (0, 0) to (1, 1)", "PP, RP only"],
    ),
    "slider with a length": (
        lambda: Limits(length=(1, 2), kinds=frozenset({"PR", "RP"})),
        ["from 1 to 2 long", "PR, RP only"],
    ),
}


@pytest.mark.parametrize("name", CONTRADICTIONS)
def test_contradictions_are_refused_and_both_limits_are_quoted(name):
    attempt, quoted = CONTRADICTIONS[name]
    with pytest.raises(InputError) as caught:
        attempt()
    assert caught.value.code == "E132"
    for words in quoted:
        assert words in str(caught.value)


def test_kinds_that_a_limited_pivot_leaves():
    assert Limits().allowed == {"RR", "PR", "RP", "PP"}
    assert Limits(fixed_pivot=Point([0, 0])).allowed == {"RR", "RP"}
    assert Limits(moving_pivot=Point([0, 0])).allowed == {"RR", "PR"}
    both = Limits(fixed_pivot=Line([0, 0], [1, 0]), moving_pivot=Point([0, 0]))
    assert both.allowed == {"RR"}
    assert both.conditions == 3
    assert not both.has_length
    assert Limits(length=(0, 3)).has_length


def test_a_polygon_may_have_two_edges_on_one_line():
    bridge = Polygon(np.array([(0, 0), (1, 0), (1, 1), (2, 1), (2, 0), (3, 0), (3, 2), (0, 2)]))
    assert np.array_equal(bridge.distance(np.array([(1.5, 0), (0.5, 0.5)])), [0.5, 0])


def test_a_flat_polygon_is_refused_wherever_it_lies():
    flat = np.array([(0, 0), (1, 0.3), (0.5, 0.15)])
    with pytest.raises(InputError):
        Polygon(flat + np.array([1e6, 1.3e6]))


def test_two_limited_pivots_and_sliders_only_quote_both_pivots():
    with pytest.raises(InputError, match=r"(?s)fixed pivot.*moving pivot"):
        Limits(fixed_pivot=Point([0, 0]), moving_pivot=Point([1, 1]), kinds=frozenset({"PR", "RP"}))


def test_points_of_different_widths_are_refused():
    with pytest.raises(InputError):
        Polygon([(0, 0), (1, 0, 3), (1, 1)])  # type: ignore[arg-type, list-item]


def test_at_a_straight_corner_the_way_across_is_given_too():
    faces = Polygon(np.array(SHAPES["straight corner"])).faces()
    (corner,) = (f for f in faces if f.basis.shape[1] == 0 and tuple(f.origin) == (1, 0))
    falls_inwards = np.array([0.0, -1.0])
    assert (corner.inward @ falls_inwards < 0).any()
