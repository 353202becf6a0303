"""Canonical frames: the two points that stay closest together."""

import numpy as np
import pytest
from scipy.optimize import minimize

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement


@pytest.mark.parametrize("seed", range(6))
def test_no_other_pair_of_points_stays_closer(seed):
    rng = np.random.default_rng(seed)
    poses = Displacement.from_poses(rng.normal(size=(9, 3)))
    weights = rng.uniform(0.5, 2, 9)
    frames, seen = CanonicalFrames.of(poses, weights)

    def cost(x):
        return (weights * ((poses.act(x[2:]) - x[:2]) ** 2).sum(axis=1)).sum()

    found = minimize(cost, np.zeros(4), tol=1e-14)
    ours = np.concatenate([frames.fixed_origin, frames.moving_origin])
    assert cost(ours) <= found.fun * (1 + 1e-9)
    assert np.allclose(ours, found.x, atol=1e-4)
    rest = (weights * (seen.translation**2).sum(axis=1)).sum() / weights.sum()
    assert np.isclose(rest, 1.0)
    assert np.allclose(frames.to_canonical(poses).translation, seen.translation, atol=1e-12)


def test_dyads_come_back_to_the_task_frames():
    rng = np.random.default_rng(1)
    poses = Displacement.from_poses(rng.normal(size=(7, 3)) * [50, 50, 1] + [1e3, -500, 2])
    frames, seen = CanonicalFrames.of(poses)
    circles = RR(*rng.normal(size=(2, 3, 2)), rng.uniform(1, 2, 3))
    back = frames.circle_from_canonical(circles)
    for k in range(3):
        wanted = circles[k].residual(seen) * frames.length
        assert np.allclose(back[k].residual(poses), wanted, atol=1e-9)
    for line in (PR(0.7, 0.3, [1, 2]), RP([1, 2], 0.7, 0.3)):
        wanted = line.residual(seen) * frames.length
        assert np.allclose(frames.line_from_canonical(line).residual(poses), wanted, atol=1e-9)


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.0, np.pi])
@pytest.mark.parametrize("count", [5, 6, 7, 11])
def test_a_translation_leaves_the_moving_origin_where_it_is(angle, count):
    rng = np.random.default_rng(count)
    rows = np.column_stack([rng.normal(size=(count, 2)), np.full(count, angle)])
    frames, seen = CanonicalFrames.of(Displacement.from_poses(rows))
    assert np.array_equal(frames.moving_origin, [0, 0])
    assert np.allclose(frames.fixed_origin, rows[:, :2].mean(axis=0))
    assert np.isclose((seen.translation**2).sum(axis=1).mean(), 1.0)
