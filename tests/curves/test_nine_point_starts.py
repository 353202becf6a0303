"""Starts from linkages through nine points of an open arc."""

from types import SimpleNamespace

import numpy as np

from burmester.curves.crank_linkages import CrankLinkages
from burmester.curves.path_fit import PathSearch
from burmester.numerics.arrays import even_numbers
from burmester.synthesis import path_linkages as module
from burmester.synthesis.path_linkages import nine_point_starts
from tests.oracles.coupler_curves import dyads_of, random_crank, traced


def test_the_linkage_of_the_arc_is_a_start_and_one_that_turns_back_is_none(monkeypatch):
    rng = np.random.default_rng(2)
    z, side = random_crank(rng)
    t = np.linspace(0.4, 2.6, 15)
    curve = traced(dyads_of(z), side, t)
    points = np.column_stack([curve.real, curve.imag])
    index = even_numbers(15, 9)
    own = CrankLinkages(np.stack([z, z]), np.array([1.0, 1.0]))
    if not np.allclose(own.at(t[None]).point[0], curve):
        own = CrankLinkages(own.dimensions, -own.assembly)
    back = t[index].copy()
    back[3:5] = back[[4, 3]]
    rows = own.rows(np.stack([t[index], back]))
    found = SimpleNamespace(batch=own.batch(), places=rows)
    monkeypatch.setattr(module, "linkages_through", lambda *_: found)
    starts = nine_point_starts(points)
    assert sum(len(each) for each, _ in starts) in (1, 2)  # its follower may go one way too
    linkages, angles = starts[0]
    assert np.allclose(linkages.dimensions, z)
    assert np.allclose(np.exp(1j * angles[0, index]), np.exp(1j * t[index]))
    fit = PathSearch.of(points).nearest(starts=starts)
    assert np.sqrt(fit.cost[0] / 15) < 1e-9


def test_nine_points_on_a_line_or_a_circle_have_none():
    x = np.linspace(0, 1, 12)
    assert nine_point_starts(np.column_stack([x, 2 * x])) == []
    assert nine_point_starts(np.column_stack([np.cos(x), np.sin(x)])) == []
