"""Feet in the order of their points, against SciPy's isotonic regression."""

import numpy as np
import pytest
from scipy.optimize import isotonic_regression

from burmester.curves.crank_linkages import CrankLinkages
from burmester.curves.order_of_feet import in_order
from tests.oracles.coupler_curves import random_crank


def drawn(seed, count=24):
    rng = np.random.default_rng(seed)
    z, _ = random_crank(rng)
    linkages = CrankLinkages(z[None], np.ones(1))
    even = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return rng, linkages, even + rng.normal(size=count) * 0.3


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("seed", range(3))
def test_open_rows_are_those_of_the_regression(seed, sense):
    _, linkages, t = drawn(seed)
    t = sense * t
    assert (np.diff(t) * sense < 0).any()
    speed = np.abs(linkages.at(t[None]).velocity[0])
    wanted = sense * isotonic_regression(sense * t, weights=speed**2).x
    assert np.allclose(in_order(linkages, t[None], closed=False)[0], wanted)


@pytest.mark.parametrize("seed", range(3))
def test_closed_rows_are_in_order_wherever_they_begin(seed):
    rng, linkages, t = drawn(seed)
    t = rng.uniform(0, 6) + t
    out = in_order(linkages, t[None], closed=True)[0]
    assert (np.diff(out, append=out[:1] + 2 * np.pi) >= -1e-9).all()
    begun = np.concatenate([t[7:], t[:7] + 2 * np.pi])
    again = in_order(linkages, begun[None], closed=True)[0]
    assert np.allclose(np.exp(1j * again), np.exp(1j * np.concatenate([out[7:], out[:7]])))


def test_what_is_in_order_stays():
    _, linkages, t = drawn(1)
    t = 0.9 * t
    rows = np.stack([np.sort(t), -np.sort(t)])
    both = linkages[[0, 0]]
    assert np.array_equal(in_order(both, rows, closed=False), rows)
    assert np.array_equal(in_order(both, rows, closed=True), rows)
