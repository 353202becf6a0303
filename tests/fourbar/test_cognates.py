"""Roberts' cognates, driven one by one."""

import numpy as np
import pytest

from burmester.fourbar.cognates import cognates
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from tests.oracles.witness import misses, places, random_four_bar


class _Rows:
    """Places as the witness reads poses."""

    def __init__(self, translation, angle):
        self.translation, self.angle = translation, angle


def curve(linkage, point, count=24):
    """Points (n,) of the coupler curve, one assembly, and the direction (n,) of the first link."""
    drive = np.linspace(-np.pi, np.pi, count, endpoint=False)
    where, phi = places(linkage.first, linkage.second, drive)
    traced = where[0] + complex(*point) * np.exp(1j * phi[0])
    sound = np.isfinite(traced)
    return traced[sound], drive[sound]


@pytest.mark.parametrize("second", [RR, PR])
@pytest.mark.parametrize("seed", range(5))
def test_cognates_trace_the_same_curve(seed, second):
    rng = np.random.default_rng(seed)
    linkage = Linkage(*random_four_bar(rng, second))
    point = rng.normal(size=2)
    found = cognates(linkage, point)
    assert len(found) == (2 if second is RR else 1)
    for number, cognate in enumerate(found):
        # Drive the linkage by the link that the cognate shares the fixed pivot with.
        own = linkage if number == 0 else Linkage(linkage.second, linkage.first)
        traced, direction = curve(own, point)
        assert len(traced) > 4
        turn = np.exp(1j * direction)
        where = traced - complex(*point) * turn
        poses = _Rows(np.column_stack([where.real, where.imag]), direction)
        assert misses(cognate, poses, 1.0).max() < 1e-6


def test_three_fixed_pivots_are_a_triangle_like_the_coupler():
    rng = np.random.default_rng(11)
    a, b = random_four_bar(rng)
    left, right = cognates(Linkage(a, b), (0.3, -0.7))
    z = lambda p: complex(*p)  # noqa: E731
    coupler = (z((0.3, -0.7)) - z(a.moving_pivot)) / (z(b.moving_pivot) - z(a.moving_pivot))
    ground = (z(left.second.fixed_pivot) - z(a.fixed_pivot)) / (z(b.fixed_pivot) - z(a.fixed_pivot))
    assert abs(coupler - ground) < 1e-12
    assert np.allclose(left.second.fixed_pivot, right.second.fixed_pivot, atol=1e-12)
    # A crank keeps a crank among the cognates: Grashof's rule holds for all three or for none.
    grashof = [each.type != "triple-rocker" for each in (Linkage(a, b), left, right)]
    assert len(set(grashof)) == 1


def test_cognates_of_a_cognate_lead_back():
    rng = np.random.default_rng(5)
    linkage, point = Linkage(*random_four_bar(rng)), (0.4, 0.9)
    left, _ = cognates(linkage, point)
    back, _ = cognates(left, point)
    assert np.allclose(back.second.fixed_pivot, linkage.second.fixed_pivot)
    assert np.allclose([*back.links], [*linkage.links])


def test_other_slider_linkages_have_no_cognate_of_two_dyads():
    pin, slot = RR([0, 0], [1, 0], 2), RP([3, 1], 0.3, 0.5)
    assert cognates(Linkage(pin, slot)) == ()
