"""The locally best dyads by true distance."""

import json
from importlib import resources

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.dyads.local_minima import best_dyads
from burmester.geometry.displacement import Displacement
from tests.oracles.elsewhere import judged
from tests.oracles.random_starts import distance, local_fits
from tests.oracles.witness import random_four_bar, random_poses


def case_and_poses(name):
    case = json.loads(resources.files("burmester").joinpath(f"cases/{name}.json").read_text())
    rows = np.array(case["poses"])
    return case, Displacement(rows[:, :2], np.radians(rows[:, 2]))


@pytest.mark.parametrize("name", ["ge2012-exact", "ge2012-approximate"])
def test_known_best_dyads_of_the_papers_poses(name):
    case, poses = case_and_poses(name)
    best = best_dyads(poses)
    found = np.column_stack([best.dyads.fixed_pivot, best.dyads.radius, best.dyads.moving_pivot])
    for wanted, squares in zip(
        case["best_dyads_true_distance"], case["best_dyads_sum_of_squares"], strict=True
    ):
        k = np.abs(found - wanted).max(axis=1).argmin()
        # The listed digits are good to 4e-8; a certificate proves ours to 1e-13.
        assert np.allclose(found[k], wanted, rtol=0, atol=5e-8)
        assert np.isclose(best.rms_error[k] ** 2 * 10, squares, rtol=3e-8)


def distance_residual(v, rows):
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    big_x = cos * v[2] - sin * v[3] + rows[:, 0] - v[0]
    big_y = sin * v[2] + cos * v[3] + rows[:, 1] - v[1]
    return np.hypot(big_x, big_y) - v[4]


@pytest.mark.parametrize("seed", range(8))
def test_another_solver_cannot_improve_them(seed):
    rng = np.random.default_rng(seed)
    rows = random_poses(random_four_bar(rng), rng, 10)
    rows = rows + 0.01 * rng.normal(size=rows.shape)
    best = best_dyads(Displacement.from_poses(rows))
    for k in range(len(best.rms_error)):
        dyad = best.dyads[k]
        start = np.array([*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius])
        if np.abs(start).max() > 100:
            continue
        ours = best.rms_error[k]
        assert np.isclose(np.sqrt((distance_residual(start, rows) ** 2).mean()), ours, rtol=1e-7)
        fit = least_squares(distance_residual, start, args=(rows,), method="lm", xtol=1e-14)
        assert ours <= np.sqrt((fit.fun**2).mean()) * (1 + 1e-6)


def test_weights_pull_towards_their_poses():
    rng = np.random.default_rng(3)
    rows = random_poses(random_four_bar(rng), rng, 10)
    rows = rows + 0.01 * rng.normal(size=rows.shape)
    weights = np.ones(10)
    weights[3] = 1e6
    plain = best_dyads(Displacement.from_poses(rows))
    heavy = best_dyads(Displacement.from_poses(rows), weights)
    pose = Displacement.from_poses(rows[3])
    assert abs(heavy.dyads[0].residual(pose)) < 1e-6
    assert abs(plain.dyads[0].residual(pose)) > 1e-4


@pytest.mark.parametrize("case", [124, 219, 269])
def test_minima_in_flat_valleys_settle_to_the_last_digits(case):
    """Where the sum of squares itself tells no more, the way down goes on by its derivatives."""
    loss, other_number = judged(np.random.default_rng([0, case]), "best_dyads")
    assert not other_number
    assert (loss[:, 0] <= loss[:, 2]).all()


@pytest.mark.parametrize("turn", [0.3, 1.0, 3.0])
def test_no_random_start_finds_a_nearer_circle(turn):
    """Wild poses: their true distance has minima that the squared residual lacks."""
    for seed in range(12):
        rng = np.random.default_rng(seed)
        rows = rng.normal(size=(int(rng.integers(6, 16)), 3)) * [1, 1, turn]
        best = best_dyads(Displacement.from_poses(rows))
        d, t = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
        starts = rng.normal(scale=3, size=(100, 4))
        _, rms = local_fits(distance, starts, d, t)
        assert best.rms_error.min() <= rms.min() * (1 + 1e-6)


def test_a_minimum_that_the_squared_residual_lacks_is_found_beside_complex_points():
    """Thirteen wild poses; Newton's method reaches this circle from no real part of a point."""
    rng = np.random.default_rng([9, 54])
    rows = rng.normal(size=(int(rng.integers(6, 16)), 3)) * [1, 1, rng.choice([0.3, 1, 3])]
    d, t = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    (end,), _ = local_fits(distance, np.array([[0.453, -0.403, 0.785, 1.05]]), d, t)
    best = best_dyads(Displacement.from_poses(rows))
    listed = np.column_stack([best.dyads.fixed_pivot, best.dyads.moving_pivot])
    assert np.abs(end - [0.453, -0.403, 0.785, 1.05]).max() < 1e-3
    assert np.abs(listed - end).max(axis=1).min() < 1e-6


@pytest.mark.parametrize("seed", [23, 46, 145])
def test_poses_that_mirror_each_other_lead_to_no_saddle(seed):
    """From a start on the mirror line Newton's method stays on it, and there are saddles there."""
    rng = np.random.default_rng(seed)
    half = rng.normal(size=(3, 3)) * [1, 1, 0.7]
    rows = np.concatenate([half, half * [1, -1, -1]])
    best = best_dyads(Displacement.from_poses(rows))
    assert len(best.rms_error) > 0
    for dyad in (best.dyads[k] for k in range(len(best.rms_error))):
        z = np.array([*dyad.fixed_pivot, *dyad.moving_pivot])
        steps = 1e-3 * np.linalg.norm(z) * rng.normal(size=(2000, 4))
        assert (squared(z + steps, rows) > squared(z, rows)).all()


def squared(z, rows):
    """The sum of squared distances from the best circles about pivots z (*, 4)."""
    x, y, angle = rows.T
    c1, c2, m1, m2 = np.moveaxis(np.asarray(z), -1, 0)[..., None]
    arm = np.hypot(
        np.cos(angle) * m1 - np.sin(angle) * m2 + x - c1,
        np.sin(angle) * m1 + np.cos(angle) * m2 + y - c2,
    )
    return ((arm - arm.mean(axis=-1, keepdims=True)) ** 2).sum(axis=-1)
