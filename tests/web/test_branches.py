"""The ways of a linkage as plain data, in a case made for one rule."""

from types import SimpleNamespace

import numpy as np
import pytest

from burmester import PR, RP, Displacement, Linkage
from burmester.web.branches import branches_of


def test_a_way_with_one_dead_point_says_at_which_end():
    """A pin on the X axis drives a slot that passes 1 beside it, and 0.5 above the axis.

    The pin is no nearer to the slot's pivot than 1: beyond x = ±sqrt(0.75) it slides away without
    end, and on each side comes to one dead point.  The drive rises along both ways, so that one
    begins there and the other ends there, on either assembly.
    """
    rail, slot = PR(np.pi / 2, 0.0, [0.0, 0.0]), RP([0.0, 0.5], 0.0, 1.0)
    linkage = Linkage(rail, slot)
    places = Displacement(np.full((3, 2), np.nan), np.full(3, np.nan))
    found = SimpleNamespace(driver_first=linkage, error=SimpleNamespace(places=places))
    poses = Displacement(np.array([[1.0, 0.0], [2.0, 0.0], [-1.0, 0.0]]), np.zeros(3))
    ways = branches_of(found, poses, 4.0, 101).ways
    nearest = np.sqrt(0.75)
    told = []
    for way in ways:
        x, transmission = np.array(way["x"]), np.array(way["transmission"])
        assert (np.diff(way["drive"]) > 0).all()
        assert np.abs(way["y"]).max() < 1e-9
        at_rest = np.abs(np.abs(x[[0, -1]]) - nearest) < 1e-6
        assert way["dead"] == at_rest.tolist()
        assert transmission[[0, -1]][at_rest] == pytest.approx([0.0], abs=0.01)
        told.append((tuple(way["dead"]), bool(x.min() > 0)))
    assert len(told) == 4
    assert {dead for dead, _ in told} == {(True, False), (False, True)}
    assert len(set(told)) == 2  # the side of the axis says which end it is
