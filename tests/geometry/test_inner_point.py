"""A point well inside a polygon: inside by the angles of corners, deep by brute force."""

import numpy as np
import pytest

from burmester.geometry.outlines import inner_point

HORSESHOE = [(0, 0), (5, 0), (5, 4), (4, 4), (4, 1), (1, 1), (1, 4), (0, 4)]
WALL = [(0, 0), (1, 0), (1, 30), (0, 30)]
SLANTED = [(0, 0), (9, 7), (8.5, 7.5), (-0.5, 0.5)]


def depth(corners, point):
    """How far inside a point is, by the angles and by points along the edges; below 0 outside."""
    z = np.asarray(corners, dtype=float) @ [1, 1j] - complex(*point)
    turns = np.angle(np.roll(z, -1) / z).sum() / (2 * np.pi)
    share = np.linspace(0, 1, 400)[:, None]
    near = np.abs(z + share * (np.roll(z, -1) - z)).min()
    return near if abs(turns) > 0.5 else -near


@pytest.mark.parametrize("corners", [HORSESHOE, WALL, SLANTED, HORSESHOE[::-1]])
@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
def test_it_is_deep_inside(corners, scale):
    corners = np.array(corners) * scale
    found = depth(corners, inner_point(corners))
    low, high = corners.min(axis=0), corners.max(axis=0)
    tried = np.random.default_rng(3).uniform(low, high, (3000, 2))
    assert found > 0.8 * max(depth(corners, each) for each in tried)


def test_in_a_long_wall_it_is_near_the_middle():
    assert inner_point(np.array(WALL, dtype=float)) == pytest.approx([0.5, 15], abs=1)


def test_one_too_thin_for_the_grid_gets_a_point_of_its_edge():
    splinter = np.array([(0, 0), (7, 3), (10, 0.1), (7, 3 + 1e-9)])
    assert inner_point(splinter) == pytest.approx([3.5, 1.5])
