"""The types within the uncertainty of the links, against links drawn within it."""

import numpy as np
import pytest

from burmester.fourbar.dyad import PR
from burmester.fourbar.linkage import Linkage, Links
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.verdicts.uncertainty import links_covariance, possible_types
from tests.oracles.refits import numbers_of
from tests.oracles.witness import random_four_bar


def type_by_sorting(links):
    """Grashof's rule as the books have it."""
    s, p, q, longest = np.sort(links)
    if s + longest > p + q:
        return "triple-rocker"
    return ("double-crank", "crank-rocker", "double-rocker", "rocker-crank")[int(np.argmin(links))]


def drawn(rng, links, covariance, deviations, count=4000):
    """The types of links drawn on the ellipsoids of so many standard deviations."""
    root = np.linalg.cholesky(covariance)
    way = rng.normal(size=(count, 4))
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    return {type_by_sorting(each) for each in links + deviations * way @ root.T}


@pytest.mark.parametrize("seed", range(40))
def test_types_are_possible_just_where_links_within_two_deviations_have_them(seed):
    """Sizes from a clear type to a near-parallelogram whose four types are all within reach."""
    rng = np.random.default_rng(seed)
    links = rng.uniform(1.0, 3.0, 4)
    if seed % 4 == 0:
        links = np.array([3.0, 1.0, 3.0, 1.0]) + 0.02 * rng.normal(size=4)
    elif seed % 4 == 1:
        links[3] = links[0] + links[1] - links[2] + 0.02 * rng.normal()
        links = np.abs(links) + 0.5
    root = rng.normal(size=(4, 4)) * 10 ** rng.uniform(-3, -1)
    covariance = root @ root.T + 1e-8 * np.eye(4)
    own, *others = possible_types(Links(*links), covariance)
    assert own == type_by_sorting(links)
    near = set().union(*(drawn(rng, links, covariance, r) for r in (0.5, 1.0, 1.5, 1.97)))
    far = set().union(*(drawn(rng, links, covariance, r) for r in (1.0, 2.0, 2.1, 2.3)))
    assert near <= {own, *others} <= far | {own}
    assert own not in others


def test_the_triple_rocker_that_could_be_a_crank_rocker():
    """Sums of pairs: shortest and longest exceed the others by 25.9."""
    links = Links(149.3, 48.3, 81.5, 90.2)
    spread = np.diag([100.0, 1.0, 25.0, 49.0])  # a deviation of 13.2 of that excess
    assert possible_types(links, spread) == ("triple-rocker", "crank-rocker")
    assert possible_types(links, spread / 4) == ("triple-rocker",)
    assert possible_types(Links(149.3, 48.3, 101.0, 96.6), spread) == ("change-point",)
    # All links err as one, or two of them, by far more than they are long.
    one = np.ones(4)
    assert possible_types(links, 1e6 * np.outer(one, one)) == ("triple-rocker",)
    one = np.array([1.0, 1.0, 0.0, 0.0])
    assert possible_types(links, 1e6 * np.outer(one, one)) == ("triple-rocker", "crank-rocker")
    assert len(possible_types(links, 1e6 * np.eye(4))) == 5
    assert possible_types(links, np.zeros((4, 4))) == ("triple-rocker",)


def test_sums_that_err_together_change_their_signs_together():
    """Driver and follower differ by 0.02, and this difference errs by 0.011 alone."""
    links = Links(3.0, 1.0, 3.0, 1.02)
    apart = np.array([0.0, 1.0, 0.0, -1.0])
    spread = (0.02 / 3.6) ** 2 * np.outer(apart, apart)
    assert "rocker-crank" in possible_types(links, spread)
    assert possible_types(links, spread / 2) == ("crank-rocker",)


@pytest.mark.parametrize("seed", range(6))
def test_links_err_as_the_pivots_they_join(seed):
    rng = np.random.default_rng(seed)
    pairs = [random_four_bar(rng) for _ in range(3)] + [random_four_bar(rng, PR)]
    batch = LinkageBatch.of([Linkage(*pair) for pair in pairs])
    root = 1e-7 * rng.normal(size=(4, 10, 10))
    found = links_covariance(batch, root @ root.swapaxes(1, 2))

    def links(z):
        return np.array(
            [abs(complex(*(z[5:7] - z[:2]))), z[4], abs(complex(*(z[7:9] - z[2:4]))), z[9]]
        )

    for k, pair in enumerate(pairs[:3]):
        z = numbers_of(pair)
        off = np.array([(links(z + each) - links(z - each)) / 2 for each in root[k].T])
        assert np.allclose(found[k], off.T @ off, rtol=1e-5, atol=1e-22)
    assert np.isnan(found[3]).all()
