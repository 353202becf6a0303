"""A polygon's half-planes and whether it is convex, beside Shapely."""

import numpy as np
import shapely

from burmester import Polygon


def test_half_planes_and_convexity_are_those_of_shapely():
    rng, both = np.random.default_rng(8), set()
    for _ in range(60):
        turns = (np.arange(5) + rng.uniform(0, 0.6, 5)) * 2 * np.pi / 5
        corners = np.exp(1j * turns)
        corners[2] *= rng.choice([1.0, 0.4])
        corners = np.column_stack([corners.real, corners.imag])[:: rng.choice([1, -1])]
        polygon, other = Polygon(corners), shapely.Polygon(corners)
        convex = other.convex_hull.area < other.area * (1 + 1e-9)
        assert polygon.is_convex == convex
        both.add(convex)
        if convex:
            points = rng.uniform(-1, 1, (50, 2))
            beyond = (points @ polygon.outward > polygon.reach).any(axis=1)
            assert beyond.tolist() == (~shapely.contains_xy(other, *points.T)).tolist()
    assert both == {True, False}
