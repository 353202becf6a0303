"""Pivot maps against SciPy's fit of each single pivot, and against every critical point."""

import tracemalloc

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.dyads.critical_points import critical_dyads
from burmester.dyads.pivot_map import fixed_pivot_map, grid, moving_pivot_map
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from tests.oracles.witness import random_four_bar, random_poses


def random_task(seed, count=9):
    rng = np.random.default_rng([5, seed])
    rows = random_poses(random_four_bar(rng), rng, count) + 0.02 * rng.normal(size=(count, 3))
    return rng, rows, Displacement.from_poses(rows)


def squared(c, m, rows):
    """|R m + d - c|² (N,), in complex numbers."""
    return abs(m * np.exp(1j * rows[:, 2]) + rows[:, 0] + 1j * rows[:, 1] - c) ** 2


def best_partner(pivot, rows, share, *, fixed):
    """SciPy's other pivot, and the weighted rms of what it leaves of the squared residual."""
    at = complex(*pivot)

    def left(other):
        other = complex(*other)
        value = squared(at, other, rows) if fixed else squared(other, at, rows)
        return np.sqrt(share) * (value - share @ value)

    fit = least_squares(left, np.zeros(2), method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return fit.x, np.sqrt(2 * fit.cost)


@pytest.mark.parametrize("fixed", [True, False])
@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_every_pivot_gets_its_best_partner(seed, fixed, weighted):
    rng, rows, poses = random_task(seed)
    weights = rng.uniform(0.1, 5, len(rows)) if weighted else None
    share = np.ones(len(rows)) if weights is None else weights
    share = share / share.sum()
    pivots = rng.normal(scale=2, size=(3, 5, 2))
    found = (fixed_pivot_map if fixed else moving_pivot_map)(poses, pivots, weights)
    given = found.dyads.fixed_pivot if fixed else found.dyads.moving_pivot
    other = found.dyads.moving_pivot if fixed else found.dyads.fixed_pivot
    assert np.array_equal(given, pivots)
    for at in np.ndindex(3, 5):
        partner, residual = best_partner(pivots[at], rows, share, fixed=fixed)
        assert np.allclose(other[at], partner, rtol=1e-5, atol=1e-5)
        assert found.residual[at] == pytest.approx(residual, rel=1e-7)
        c, m = complex(*found.dyads.fixed_pivot[at]), complex(*found.dyads.moving_pivot[at])
        far = np.sqrt(squared(c, m, rows))
        radius = np.sqrt(share @ far**2)
        assert found.dyads.radius[at] == pytest.approx(radius, rel=1e-9)
        assert found.rms_error[at] == pytest.approx(np.sqrt(((far - radius) ** 2).mean()), rel=1e-7)
        assert found.max_error[at] == pytest.approx(abs(far - radius).max(), rel=1e-7)


def test_the_valley_of_a_grid_is_in_its_row_and_column():
    rng = np.random.default_rng(3)
    dyads = random_four_bar(rng)
    poses = Displacement.from_poses(random_poses(dyads, rng, 8))
    x, y = dyads[0].fixed_pivot
    # 7 columns one apart and 4 rows two apart; the pivot is in column 5 and row 1.
    points = grid((x - 5, y - 2), (x + 1, y + 4), 7, 4)
    assert points.shape == (4, 7, 2)
    assert np.allclose(points[1, 5], (x, y))
    assert np.allclose(points[0, 0], (x - 5, y - 2))
    assert np.allclose(points[0, 6], (x + 1, y - 2))
    residual = fixed_pivot_map(poses, points).residual
    assert np.unravel_index(residual.argmin(), residual.shape) == (1, 5)
    assert residual[1, 5] < 1e-9
    assert np.sort(residual.ravel())[2] > 1e-3  # the other dyad's pivot may be near a point, too


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_maps_go_along_with_frames_and_units(unit):
    rng, _, poses = random_task(11)
    fixed = Displacement(30 * rng.normal(size=2), np.array(2.0))
    moving = Displacement(30 * rng.normal(size=2), np.array(-1.0))
    moved = fixed @ poses @ moving.inverse()
    moved = Displacement(moved.translation * unit, moved.angle)
    pivots = rng.normal(scale=2, size=(20, 2))
    one = fixed_pivot_map(poses, pivots)
    other = fixed_pivot_map(moved, fixed.act(pivots) * unit)
    assert np.allclose(other.dyads.moving_pivot / unit, moving.act(one.dyads.moving_pivot))
    assert np.allclose(other.residual / unit**2, one.residual, rtol=1e-7)
    assert np.allclose(other.rms_error / unit, one.rms_error, rtol=1e-7)
    assert np.allclose(other.max_error / unit, one.max_error, rtol=1e-7)


def test_a_pose_of_weight_two_counts_as_if_given_twice():
    rng, rows, poses = random_task(12)
    weights = np.ones(len(rows))
    weights[2] = 2
    pivots = rng.normal(size=(6, 2))
    heavy = fixed_pivot_map(poses, pivots, weights)
    twice = fixed_pivot_map(Displacement.from_poses(np.vstack([rows, rows[2]])), pivots)
    assert np.allclose(heavy.dyads.moving_pivot, twice.dyads.moving_pivot, rtol=1e-8)
    assert np.allclose(heavy.residual, twice.residual, rtol=1e-8)


@pytest.mark.parametrize("seed", range(6))
def test_the_lowest_point_of_a_fine_grid_is_the_best_critical_dyad(seed):
    _, _, poses = random_task(seed)
    best = critical_dyads(poses)
    for make, pivot in (
        (fixed_pivot_map, best.dyads.fixed_pivot[0]),
        (moving_pivot_map, best.dyads.moving_pivot[0]),
    ):
        at = make(poses, pivot)
        assert at.residual == pytest.approx(best.residual[0], rel=1e-6)
        assert np.allclose(at.dyads.radius, best.dyads.radius[0], rtol=1e-6)
        step = 1e-3 * float(best.dyads.radius[0])
        around = make(poses, grid(pivot - 10 * step, pivot + 10 * step, 21, 21)).residual
        assert np.unravel_index(around.argmin(), around.shape) == (10, 10)
        assert around.min() >= best.residual[0] * (1 - 1e-9)
    wide = fixed_pivot_map(poses, grid((-20, -20), (20, 20), 201, 201)).residual
    assert wide.min() >= best.residual[0] * (1 - 1e-9)


def test_a_turn_about_the_pivot_leaves_its_partner_open():
    angle = np.linspace(0, 2, 7)
    pole = np.array([0.3, -0.2])
    centre = complex(*pole)
    there = centre - np.exp(1j * angle) * centre
    there = np.column_stack([there.real, there.imag])
    poses = Displacement(there, angle)
    assert np.allclose(poses.act(pole), pole)
    found = fixed_pivot_map(poses, np.array([pole, pole + 1.0]))
    assert np.isnan(found.dyads.moving_pivot[0]).all()
    assert np.isfinite(found.dyads.moving_pivot[1]).all()


def test_many_pivots_take_little_memory_at_a_time():
    _, _, poses = random_task(1, 40)
    pivots = np.random.default_rng(1).normal(size=(60_000, 2))
    fixed_pivot_map(poses, pivots[:10])
    tracemalloc.start()
    found = fixed_pivot_map(poses, pivots)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # All the residuals at once would be 19 MB an array, and there are a dozen of them.
    assert peak < 80e6
    one = fixed_pivot_map(poses, pivots[-1])
    assert found.residual[-1] == pytest.approx(float(one.residual), rel=1e-9)


def test_numbers_that_are_not_finite_are_refused():
    with pytest.raises(InputError) as caught:
        fixed_pivot_map(Displacement(np.full((5, 2), np.nan), np.zeros(5)), np.zeros(2))
    assert caught.value.code == "E103"
