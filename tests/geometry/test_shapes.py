"""Distances of shapes against Shapely's, on random and on touching ones."""

import numpy as np
import pytest
import shapely

from burmester.geometry.outlines import convex_hull, grown_hull
from burmester.geometry.regions import first_meeting
from burmester.geometry.shapes import distances, nearest_points, simplified


def ring(rng, count, size=1.0):
    """The corners of a simple polygon with hollows, in either sense."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, count))[:: rng.choice([-1, 1])]
    radius = size * rng.uniform(0.05, 1, count) ** rng.choice([0.3, 2])
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)


def shape(rng, size):
    return (
        ring(rng, rng.integers(4, 30), size)
        if rng.random() < 0.6
        else size * rng.normal(size=(rng.integers(1, 3), 2))
    )


def moved(corners, x, y):
    return corners + np.array([x, y])


def drawn(corners):
    kind = {1: lambda at: shapely.points(at[..., 0, :]), 2: shapely.linestrings}
    return kind.get(corners.shape[-2], shapely.polygons)(corners)


@pytest.mark.parametrize("spans", [0.01, 1.0, 3.0, 300.0])
def test_distances_and_nearest_points_are_those_of_shapely(spans):
    """Of shapes a hundredth to 300 times as large as the others, far from the origin as well."""
    rng = np.random.default_rng(5)
    overlapping = 0
    for k in range(60):
        away = np.array([0.0, [0, 1e4][k % 2]])
        one, others = shape(rng, 1.0) + away, shape(rng, spans)
        others = others + away + rng.normal(size=(40, 1, 2)) * (0.5 + spans)
        wanted = shapely.distance(drawn(one), drawn(others))
        size = np.abs(others).max()
        found = distances(others, one)
        assert found == pytest.approx(wanted, abs=1e-13 * size)
        assert distances(one, others) == pytest.approx(found, abs=1e-13 * size)
        overlapping += int((wanted == 0).sum())
        ends = nearest_points(one, others)
        apart = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=-1)
        assert apart == pytest.approx(wanted, abs=1e-13 * size)
        for each, shapes in ((ends[:, 0], drawn(one)), (ends[:, 1], drawn(others))):
            assert shapely.distance(shapely.points(each), shapes).max() <= 1e-13 * size
        enough = float(np.median(wanted))
        told = distances(others, one, enough)
        assert ((told <= enough) == (found <= enough)).all()
        assert told[found > enough] == pytest.approx(found[found > enough], abs=1e-13 * size)
    assert overlapping > 100


def test_what_touches_is_not_apart():
    """Corners on slanted sides, sides on sides, crossing without a corner inside, all nested."""
    square = np.array([(0.0, 0), (1, 0), (1, 1), (0, 1)])
    turn = np.array([[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]])
    slanted = square @ turn + (123.4, -56.7)
    middle = slanted[1] + 0.37 * (slanted[2] - slanted[1])
    beam = np.array([(-1, 0.4), (2, 0.4), (2, 0.6), (-1, 0.6)])
    for one, other in [
        (square, moved(square, 1, 0.3)),
        (square, moved(square, 1, 1)),
        (square, square),
        (square, beam),
        (square, 0.2 * square + 0.3),
        (square, beam[:2]),
        (square, np.array([(0.5, 0.5)])),
        (slanted, middle[None]),
        (slanted, np.stack([middle, moved(middle, 5, -1)])),
        (beam[:1], beam[:1]),
    ]:
        assert distances(one, other) == 0
        assert distances(other, one) == 0
        assert np.ptp(nearest_points(one, other), axis=0) == pytest.approx(0, abs=1e-13)
    assert distances(square, moved(square, 1 + 1e-9, 0)) == pytest.approx(1e-9, rel=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_fewer_corners_stay_near_and_simple(seed):
    rng = np.random.default_rng(seed)
    corners = ring(rng, 400)
    for tolerance in (1e-3, 0.02, 0.3):
        few = simplified(corners, tolerance)
        assert 3 <= len(few) < 400 or tolerance < 0.02
        assert first_meeting(few) is None
        edge = shapely.LinearRing(few)
        assert shapely.distance(shapely.points(corners), edge).max() <= tolerance


def test_a_grown_hull_holds_all_around_and_its_sides_are_as_far():
    rng = np.random.default_rng(0)
    for count in (1, 2, 3, 5, 12):
        points, by = rng.normal(size=(count, 2)), 0.3
        grown = shapely.Polygon(grown_hull(points, by))
        hull = shapely.MultiPoint(points).convex_hull
        assert grown.buffer(1e-12).contains(hull.buffer(by))
        # No side could be nearer: each touches what is within that length of the hull.
        for start, end in zip(grown.exterior.coords[:-1], grown.exterior.coords[1:], strict=True):
            assert shapely.LineString([start, end]).distance(hull) <= by * 2**0.5 + 1e-12
        assert np.array(convex_hull(points)).shape[1] == 2
