"""Where a loaded linkage rests: against scans of 20,000 places, and its potential energy."""

import numpy as np
import pytest

from burmester.loads.equilibria import equilibria
from burmester.loads.load_figures import load_figures
from tests.oracles.loaded_linkages import KINDS, loaded_linkage

PLACES = 20_000
LOOKS = np.linspace(0, 1, 361)


def rests_of_a_scan(linkage):
    """The driver's coordinates between which the effort changes its sign, and which way."""
    loaded = linkage.at(PLACES)
    sign = np.sign(loaded.effort)
    changed = np.flatnonzero(sign[:-1] * sign[1:] < 0)
    rises = sign[changed + 1] * np.sign(loaded.drive[changed + 1] - loaded.drive[changed]) > 0
    lower = np.minimum(loaded.drive[changed], loaded.drive[changed + 1])
    upper = np.maximum(loaded.drive[changed], loaded.drive[changed + 1])
    return lower, upper, rises, loaded


@pytest.mark.parametrize("seed", range(40))  # of 13 kinds: 520 tasks
@pytest.mark.parametrize("kind", KINDS)
def test_none_is_missed_and_each_is_what_it_is_said_to_be(kind, seed):
    _, linkage = loaded_linkage(kind, 1000 + seed)
    lower, upper, rises, loaded = rests_of_a_scan(linkage)
    told = load_figures(linkage.found).rests
    unit = np.degrees(1) if loaded.rates.turns else 1.0
    slack = 1e-9 * np.ptp(loaded.drive)
    assert len(told) == len(lower)
    for low, high, stable in zip(lower, upper, rises, strict=True):
        (one,) = (each for each in told if low - slack <= each.driver / unit <= high + slack)
        assert one.stable == stable
    met = linkage.at_poses
    for one in told:
        ends = met[[pose - 1 for pose in one.between_poses]]
        assert ends.min() - slack <= one.driver / unit <= ends.max() + slack
        assert abs(one.between_poses[0] - one.between_poses[1]) <= 1


@pytest.mark.parametrize("number", range(300))
def test_roots_of_polynomials_are_all_found(number):
    """Up to nine roots, some of them very near each other."""
    rng = np.random.default_rng(number)
    roots = np.sort(rng.uniform(0, 1, rng.integers(0, 10)))
    if number % 3 == 0 and len(roots) > 1:
        roots[1] = roots[0] + 10 ** rng.uniform(-3.3, -1)
        roots = np.sort(roots[roots < 1])
    size = 10.0 ** rng.uniform(-6, 6) * rng.choice([-1, 1])
    sense = float(rng.choice([-1, 1]))

    def effort(share):
        return size * np.prod(np.asarray(share)[..., None] - roots, axis=-1)

    told = equilibria(LOOKS, effort(LOOKS), sense, effort)
    assert [each.share for each in told] == pytest.approx(roots, abs=1e-9)
    for each in told:
        behind = effort(each.share + 1e-7) - effort(each.share - 1e-7)
        assert each.stable == (sense * behind > 0)


def test_a_root_at_a_place_that_is_looked_at():
    for sense in (1.0, -1.0):
        for root in (0.0, LOOKS[180], 1.0):

            def effort(share, root=root):
                return share - root

            (told,) = equilibria(LOOKS, effort(LOOKS), sense, effort)
            assert told == (root, sense > 0)
    # Where it touches zero and turns back it does not push back on both sides.
    half = LOOKS[180]
    (told,) = equilibria(LOOKS, (LOOKS - half) ** 2, 1.0, lambda share: (share - half) ** 2)
    assert told == (half, False)


def test_where_nothing_is_needed_no_single_place_is_told():
    rng = np.random.default_rng(0)
    noise = 1e-12 * rng.normal(size=361)
    assert equilibria(LOOKS, noise, 1.0, lambda share: 0 * share, none=1e-9) == ()
    assert equilibria(LOOKS, 0 * LOOKS, 1.0, lambda share: 0 * share) == ()

    def slack(share):  # a spring that is loose up to the middle
        return np.maximum(share - 0.5, 0)

    assert equilibria(LOOKS, slack(LOOKS), 1.0, slack) == ()


def test_a_place_without_a_number_hides_no_other():
    """At a dead point nothing is told; the rest of the motion has its roots."""

    def effort(share):
        return np.where(share == 1.0, np.nan, share - 0.3)

    (told,) = equilibria(LOOKS, effort(LOOKS), 1.0, effort)
    assert told.share == pytest.approx(0.3, abs=1e-12)
    assert told.stable
