"""Chances where the ratio of errors of angles to errors of positions is unknown, against SciPy."""

import numpy as np
import pytest
from benchmarks import odd_pose_chances as campaign
from scipy.optimize import least_squares
from scipy.stats import f

from burmester import Displacement
from burmester.diagnosis.noise_ratio import (
    RATIOS,
    ByRatio,
    first_order_chances,
    fits_by_ratio,
    floor_by_ratio,
)
from burmester.diagnosis.odd_pose import odd_pose
from burmester.diagnosis.sampson_fits import NormalizedPoses
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from tests.oracles.witness import random_four_bar, random_poses, span


def sample(seed, count, ratio, size=3e-4):
    """Normalised poses on a random 4R with noise, and the linkage (1,) that they were made from."""
    rng = np.random.default_rng(seed)
    rows = np.zeros((1, 3))
    while span(rows) < 1:
        dyads = random_four_bar(rng)
        rows = random_poses(dyads, rng, count)
    length = campaign.extent(rows)
    rows = rows + size * np.array([length, length, ratio]) * rng.normal(size=rows.shape)
    seen = NormalizedPoses.of(Displacement.from_poses(rows), None)
    return seen, LinkageBatch.of([Linkage(*dyads)]).to_canonical(seen.frames)


def whitened(z, rows, ratio):
    """Residuals (N, 2) of two circles z (10,) with the covariance I, and roots of determinants."""
    place, turn = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    forces, gaps = [], []
    for c1, c2, m1, m2, r in z.reshape(2, 5):
        arm = place + turn * (m1 + 1j * m2) - c1 - 1j * c2
        along = arm / abs(arm)
        moment = (np.conj(1j * turn * (m1 + 1j * m2)) * along).real
        forces.append(np.stack([along.real, along.imag, ratio * moment], axis=-1))
        gaps.append(abs(arm) - r)
    force, gap = np.stack(forces, axis=1), np.stack(gaps, axis=1)
    lower = np.linalg.cholesky(force @ np.swapaxes(force, 1, 2))
    return np.linalg.solve(lower, gap[..., None])[..., 0], lower[:, 0, 0] * lower[:, 1, 1]


def fitted(start, rows, ratio):
    """The least sum of squares of two circles, and the dimensions."""
    end = least_squares(
        lambda z: whitened(z, rows, ratio)[0].ravel(),
        start,
        x_scale="jac",
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    return 2 * end.cost, end.x, end.jac


@pytest.mark.parametrize(("seed", "wrong"), [(1, 0.0), (2, 0.02)])
def test_sums_of_squares_and_likelihoods_of_every_ratio_are_scipys(seed, wrong):
    seen, batch = sample(seed, 9, 1.0)
    seen.rows[3, 2] += wrong
    seen = seen._replace(poses=Displacement.from_poses(seen.rows))
    zero = np.zeros(len(RATIOS))
    found = fits_by_ratio(seen, batch, batch, 3, zero)
    start, keep = batch.dimensions[0].ravel(), np.arange(9) != 3
    expected = []
    for k, ratio in enumerate(RATIOS):
        without, z, slope = fitted(start, seen.rows[keep], ratio)
        of_all, _, _ = fitted(z, seen.rows, ratio)
        assert found.without[k] == pytest.approx(without, rel=2e-2)
        assert found.of_all[k] == pytest.approx(of_all, rel=0.15 if wrong else 2e-2)
        _, volume = whitened(z, seen.rows[keep], ratio)
        spread = np.linalg.slogdet(slope.T @ slope)[1]
        expected.append(-np.log(volume).sum() - spread / 2 - 3 * np.log(without))
        for number in range(3):

            def residual(v, ratio=ratio, number=number):
                rows = seen.rows.copy()
                rows[3, number] += v[10]
                return whitened(v[:10], rows, ratio)[0].ravel()

            if not wrong:
                end = least_squares(residual, np.append(z, 0.0), x_scale="jac", xtol=1e-14)
                assert found.numbers[k, number] == pytest.approx(2 * end.cost, rel=2e-2)
    expected = np.array(expected)
    likelihood = found.log_likelihood - found.log_likelihood[6]
    assert likelihood == pytest.approx(expected - expected[6], abs=0.15)


@pytest.mark.parametrize("ratio", [5.0, 15.0])
def test_the_ratio_is_read_off_many_poses(ratio):
    """Within a factor of two, whether or not the pose left out has a wrong angle.

    Only large ones: where a radian counts little errors of angles are not seen, and need not be.
    """
    seen, batch = sample(7, 60, ratio)
    for off in (0.0, 0.05):
        rows = seen.rows.copy()
        rows[11, 2] += off * ratio
        moved = seen._replace(rows=rows, poses=Displacement.from_poses(rows))
        found = fits_by_ratio(moved, batch, batch, 11, np.zeros(len(RATIOS)))
        assert 0.5 < RATIOS[found.best_ratio()] / ratio < 2
        assert found.weights.sum() == pytest.approx(1)
        assert (found.chance(60) < 1e-6) == (off > 0)


def test_the_chance_is_a_mean_over_ratios():
    """Two ratios of which one is three times as likely: F tests of SciPy, weighed by hand."""
    _, batch = sample(3, 8, 1.0)
    without, of_all = np.array([1.0, 2.0]), np.array([90.0, 30.0])
    numbers = np.array([[60.0, 70.0, 1.2], [3.0, 29.0, 29.0]])
    log_likelihood = np.log([0.75, 0.25]) - 7
    made = ByRatio(batch, without, of_all, numbers, log_likelihood)
    expected = 0.0
    for k, weight in enumerate((0.75, 0.25)):
        of_pose = 8 * f.sf((of_all[k] / without[k] - 1) * 2, 2, 4)
        of_number = 24 * f.sf((of_all[k] / numbers[k] - 1) * 5, 1, 5).min()
        expected += weight * min(1.0, 2 * min(of_pose, of_number))
    assert made.chance(8) == pytest.approx(expected, rel=0.15)
    assert made.chance(8) >= expected * (1 - 1e-9)
    assert made.deviations(8) == pytest.approx(np.sqrt(89 * 4))
    half = made.bounded(np.array([44.5, 100.0]))
    assert half.of_all == pytest.approx([45.5, 30.0])
    assert half.numbers[0] == pytest.approx([30.5, 35.5, 1.1])
    assert half.numbers[1] == pytest.approx(numbers[1])


def test_chances_to_first_order_are_those_of_the_fits():
    """Of small errors, where first order holds, from one linkage of all poses."""
    seen, batch = sample(5, 12, 3.0, size=1e-5)
    floor = np.full(len(RATIOS), 1e-30)
    quick = first_order_chances(seen, batch, floor)
    for pose in (0, 4, 9):
        found = fits_by_ratio(seen, batch, batch, pose, floor)
        assert quick[pose] == pytest.approx(found.chance(12), rel=0.02)


def test_digits_alone_are_no_disagreement():
    """A ratio r has deviations s and r s; neither is less than that of the digits."""
    floor = floor_by_ratio(10, 1e-4, 1e-3)
    s = np.sqrt(floor / 8)
    assert (s >= 1e-4 * (1 - 1e-9)).all()
    assert (RATIOS * s >= 1e-3 * (1 - 1e-9)).all()
    assert np.isclose(s, 1e-4).any()
    assert np.isclose(RATIOS * s, 1e-3).any()


def test_clean_poses_that_a_fixed_ratio_takes_for_wrong_ones_are_left_alone():
    """Errors of angles ten times those of positions: a test for equal ones names a pose in each."""
    for index in (21, 76, 111, 145):
        made = campaign.clean(np.random.default_rng([1, 10, index]), 10, 10.0)
        assert odd_pose(made.task) is None


def test_single_numbers_are_found_about_as_often_as_by_a_judge_who_knows_the_linkage():
    """A sample of `python -m benchmarks.odd_pose_chances`."""
    found = campaign.counted("single", 25, 1.0, 10, 2)
    assert found["wrong"] == 0
    assert found["found"] >= found["scale"] - 1
    assert found["known"] >= found["scale"] >= 7
    clean = campaign.counted("clean", 12, 0.1, 10, 2)
    assert clean == {"silent": 10}


def test_the_judges_know_a_linkage():
    """Of twenty poses they see nearly all wrong numbers, and nothing in clean ones."""
    rngs = [np.random.default_rng([8, k]) for k in range(10)]
    made = [campaign.single(rng, 20, 1.0) for rng in rngs]
    assert sum(campaign.judged(each)[0] == each.wrong for each in made) >= 8
    assert sum(campaign.judged(each)[1] == each.wrong for each in made) >= 8
    clean = [campaign.clean(np.random.default_rng([9, k]), 20, 1.0) for k in range(10)]
    assert [campaign.judged(each) for each in clean].count([None, None]) >= 9
