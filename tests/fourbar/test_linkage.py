"""Linkages: links and types, and the coupler's places."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage, Links, grashof
from tests.oracles.witness import places, random_four_bar


def turns_fully(dyads):
    """Whether each ground link can go all the way round, by trying every degree of it."""
    sweep = np.linspace(-np.pi, np.pi, 3601)
    return [np.isfinite(places(a, b, sweep)[0]).all() for a, b in (dyads, dyads[::-1])]


@pytest.mark.parametrize("seed", range(150))
def test_type_against_turning_the_links(seed):
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng)
    linkage = Linkage(*dyads)
    lengths = np.sort([float(x) for x in linkage.links])
    if abs(lengths[0] + lengths[3] - lengths[1] - lengths[2]) < 1e-3:
        return  # too close to a change point for a sweep to tell
    wanted = {
        "crank-rocker": [True, False],
        "rocker-crank": [False, True],
        "double-crank": [True, True],
        "double-rocker": [False, False],
        "triple-rocker": [False, False],
    }
    assert turns_fully(dyads) == wanted[linkage.type]
    if linkage.type in ("double-rocker", "triple-rocker"):
        # Only in a Grashof linkage does the coupler go round against the ground.
        angle = np.linspace(-np.pi, np.pi, 3601)
        round_and_round = np.isfinite(linkage.couplers(angle).translation[:, 0, 0]).all()
        assert round_and_round == (linkage.type == "double-rocker")


@pytest.mark.parametrize(
    ("links", "type_"),
    [
        ((4.0, 1.0, 4.0, 4.0), "crank-rocker"),
        ((4.0, 4.0, 4.0, 1.0), "rocker-crank"),
        ((1.0, 3.0, 3.0, 3.0), "double-crank"),
        ((3.0, 3.0, 1.0, 3.0), "double-rocker"),
        ((5.0, 2.0, 2.0, 2.5), "triple-rocker"),
        ((3.0, 1.0, 3.0, 1.0), "change-point"),
        ((0.1 + 0.2, 0.1, 0.3, 0.1), "change-point"),
    ],
)
def test_grashof_by_the_book(links, type_):
    assert grashof(Links(*map(np.float64, links))) == type_


def test_published_linkage_has_the_link_lengths_of_fig_2():
    linkage = Linkage(RR([-2.2, 0.1], [1.24, 0.1], 1.2377), RR([1.15, 0.38], [4.59, 1.34], 4.6712))
    ground, driver, coupler, follower = linkage.links
    assert np.isclose(ground, np.hypot(3.35, 0.28))
    assert np.isclose(coupler, np.hypot(3.35, 1.24))
    assert (driver, follower) == (1.2377, 4.6712)
    assert linkage.type == "crank-rocker"


number = st.floats(-3, 3)
pair = st.tuples(number, number).map(np.array)
kinds = st.one_of(
    st.builds(RR, pair, pair, st.floats(0.3, 4)),
    st.builds(PR, number, number, pair),
    st.builds(RP, pair, number, number),
)


@given(kinds, kinds, st.lists(st.floats(-7, 7), min_size=1, max_size=5))
def test_couplers_stand_on_both_dyads(first, second, angles):
    found = Linkage(first, second).couplers(np.array(angles))
    size = np.abs(found.translation).max(initial=1.0, where=np.isfinite(found.translation))
    for dyad in (first, second):
        miss = dyad.residual(found)
        assert np.nanmax(np.abs(miss), initial=0.0) < 1e-6 * size
    for k, angle in enumerate(angles):
        assert np.array_equal(found.angle[k], [angle, angle])


@pytest.mark.parametrize("second", [RR, PR, RP])
def test_one_coupler_angle_is_as_good_as_many(second):
    linkage = Linkage(*random_four_bar(np.random.default_rng(1), second))
    angles = np.linspace(0, 6, 50)
    many = linkage.couplers(angles)
    for k, angle in enumerate(angles):
        one = linkage.couplers(angle)
        assert np.array_equal(one.translation, many.translation[k], equal_nan=True)
        assert np.array_equal(one.angle, [angle, angle])


@pytest.mark.parametrize("seed", range(20))
def test_couplers_are_all_the_places_a_driven_linkage_has(seed):
    """Whatever place the driven linkage takes is one of the two at its coupler angle."""
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng, (RR, PR, RP)[seed % 3])
    where, phi = places(*dyads, rng.uniform(-np.pi, np.pi, 200))
    sound = np.isfinite(where)
    assert sound.any()
    found = Linkage(*dyads).couplers(phi[sound])
    gap = np.abs(found.translation @ [1, 1j] - where[sound][:, None])
    # Where both places meet, rounding opens a gap of its square root.
    assert np.nanmin(gap, axis=1).max() < 1e-6


def test_the_names_of_slider_linkages():
    crank = RR([0, 0], [0, 0], 1.0)
    rail, slot = PR(0.0, 1.0, [1, 1]), RP([1, 1], 0.0, 1.0)
    names = {
        "slider-crank": (crank, rail),
        "inverted slider-crank": (slot, crank),
        "double slider": (rail, rail),
        "Rapson slide": (slot, rail),
        "Oldham linkage": (slot, slot),
    }
    for name, dyads in names.items():
        assert Linkage(*dyads).type == name
        assert Linkage(*dyads).links is None
