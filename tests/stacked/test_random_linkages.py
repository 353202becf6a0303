"""Random linkages are what they say, and each is a function of seed and number alone."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import TYPES, Linkage
from burmester.stacked import SampleOptions, datasheet, random_linkages
from tests.oracles.random_dyads import stacked
from tests.oracles.tracer import NEAR, met_at, walks

EVERY = SampleOptions(seed=3, poses=7, noise=1e-3, curve=16)


def test_each_is_a_function_of_seed_and_number_alone():
    whole = random_linkages(EVERY, np.arange(40))
    for number in (np.array([31]), np.arange(39, -1, -1), np.array([5, 31, 7])):
        some = random_linkages(EVERY, number)
        for name in ("type", "poses", "exact_poses", "transmission_deg", "curve", "inputs"):
            own = getattr(whole, name)[number]
            assert own.tobytes() == getattr(some, name).tobytes(), name
        dimensions = whole.linkages.dimensions[number]
        assert dimensions.tobytes() == some.linkages.dimensions.tobytes()
    other = random_linkages(SampleOptions(seed=4, poses=7, noise=1e-3, curve=16), np.arange(40))
    assert (other.poses != whole.poses).mean() > 0.99


def test_a_tracer_that_knows_no_drive_meets_the_poses_in_their_order():
    sample = random_linkages(EVERY, np.arange(24))
    twice = np.repeat(np.arange(24), 2)
    dyads = [sample.linkages.linkage(k) for k in range(24)]
    for slides in (False, True):
        here = [k for k in twice if isinstance(dyads[k].second, PR) == slides]
        both = Linkage(*(stacked([pair(dyads[k]) for k in here]) for pair in (first, second)))
        sense = np.tile([1.0, -1.0], len(here) // 2)
        found, _ = walks(both, sample.exact_poses[here, 0], sense)
        met = [met_at(walk, sample.exact_poses[k]) for walk, k in zip(found, here, strict=True)]
        good = [far.max() < NEAR and (np.diff(at) > 0).all() for far, at in met]
        assert np.reshape(good, (-1, 2)).any(axis=1).all()
        names = [TYPES[sample.type[k]] for k in here]
        assert names == [dyads[k].type for k in here]


def first(linkage):
    return linkage.first


def second(linkage):
    return linkage.second


def test_the_transmission_angle_is_that_between_coupler_and_follower():
    sample = random_linkages(EVERY, np.arange(60))
    assert (sample.transmission_deg >= EVERY.transmission_deg).all()
    for k in range(60):
        linkage, rows = sample.linkages.linkage(k), sample.exact_poses[k]
        turn, d = np.exp(1j * rows[:, 2]), rows[:, :2] @ [1, 1j]
        one, two = (
            d + turn * (dyad.moving_pivot @ [1, 1j]) for dyad in (linkage.first, linkage.second)
        )
        if isinstance(linkage.second, RR):
            across = two - linkage.second.fixed_pivot @ [1, 1j]
        else:
            across = np.exp(1j * linkage.second.normal_angle)
        between = np.degrees(np.abs(np.angle((two - one) / across)))
        angle = np.minimum(between, 180 - between)
        assert angle.min() >= sample.transmission_deg[k] - 1e-9


def test_curves_lie_on_both_dyads_and_go_all_round_where_the_driver_does():
    sample = random_linkages(EVERY, np.arange(60))
    x, y, angle = np.moveaxis(sample.curve, -1, 0)
    turn, d = np.exp(1j * angle), x + 1j * y
    z = sample.linkages.dimensions
    driver = d + turn * (z[:, 0, 2:4] @ [1, 1j])[:, None] - (z[:, 0, :2] @ [1, 1j])[:, None]
    np.testing.assert_allclose(np.abs(driver), np.repeat(z[:, :1, 4], 16, axis=1), rtol=1e-12)
    step = np.angle(driver[:, 1:] / driver[:, :-1])
    full = sample.arc[:, 1] >= 2 * np.pi
    assert 0 < full.sum() < 60
    np.testing.assert_allclose(step[full], 2 * np.pi / 16, atol=1e-9)
    np.testing.assert_allclose(step.sum(axis=1)[~full], sample.arc[~full, 1], atol=1e-9)
    slides = sample.linkages.kinds[:, 1] == 1
    other = d + turn * (z[:, 1, 2:4] @ [1, 1j])[:, None]
    off = np.abs(other - (z[:, 1, :2] @ [1, 1j])[:, None]) - z[:, 1, 4:]
    np.testing.assert_allclose(off[~slides], 0.0, atol=1e-12)
    normal = np.exp(1j * z[slides, 1, 0])[:, None]
    height = (other[slides] * normal.conj()).real - z[slides, 1, 1:2]
    np.testing.assert_allclose(height, 0.0, atol=1e-12)


def test_noise_and_types_are_those_asked_for():
    sample = random_linkages(SampleOptions(seed=1, poses=4, noise=0.01, curve=0), np.arange(4000))
    off = sample.poses - sample.exact_poses
    span = np.hypot(*(np.ptp(sample.exact_poses[..., k], axis=1) for k in (0, 1)))
    for k, size in enumerate((span, span, np.ones(4000))):
        assert (off[..., k] / size[:, None]).std() == pytest.approx(0.01, rel=0.02)
    shares = np.bincount(sample.type, minlength=len(TYPES)) / 4000
    for name in SampleOptions.TYPES_DRAWN:
        assert shares[TYPES.index(name)] == pytest.approx(1 / 6, abs=0.025)
    only = random_linkages(SampleOptions(types=("double-rocker",), curve=0), np.arange(50))
    assert {TYPES[k] for k in only.type} == {"double-rocker"}


@pytest.mark.parametrize(
    "wrong",
    [{"poses": 1}, {"noise": -1}, {"types": ("tandem",)}, {"transmission_deg": 0}, {"curve": -1}],
)
def test_options_that_make_no_sample_are_refused(wrong):
    with pytest.raises(InputError) as caught:
        SampleOptions(**wrong)
    assert caught.value.code == "E134"


def test_the_datasheet_tells_what_was_asked_for():
    page = datasheet(
        SampleOptions(seed=11, poses=9, noise=2e-3, types=("crank-rocker",)), 5000, "1"
    )
    for told in ("5,000", "seed 11", "9 of each", "0.002 rad", "crank-rocker", "100 %", "30°"):
        assert told in page
    parts = ("for", "How they were drawn", "distribution", "not covered", "Known limits")
    assert all(f"{part}\n" in page for part in parts)
    assert "normal distribution" not in datasheet(SampleOptions(), 10, "1")
