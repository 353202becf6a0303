"""Every locally best RR dyad: nothing missed, nothing invented."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import least_squares

from burmester.dyads.critical_points import critical_dyads
from burmester.dyads.five_poses import dyads_of_five
from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RP
from burmester.geometry.displacement import Displacement
from burmester.polynomials.macaulay import CHARTS, eigen_points
from tests.oracles.cases import poses_of
from tests.oracles.critical_paths import against_the_paths
from tests.oracles.elsewhere import judged
from tests.oracles.random_starts import local_fits, squared
from tests.oracles.witness import random_four_bar, random_poses


def circle_residual(v, rows):
    """|R m + d - c|² less its mean, written out for other people's solvers."""
    xc, yc, x, y = v
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    squared = (cos * x - sin * y + rows[:, 0] - xc) ** 2
    squared += (sin * x + cos * y + rows[:, 1] - yc) ** 2
    return squared - squared.mean()


def random_task(rng):
    if rng.random() < 0.5:
        rows = rng.normal(size=(rng.integers(5, 20), 3)) * [1, 1, rng.uniform(0.2, 3)]
    else:
        rows = random_poses(random_four_bar(rng), rng, int(rng.integers(5, 20)))
        rows = rows + 10 ** rng.uniform(-5, -1) * rng.normal(size=rows.shape)
    return rows


@pytest.mark.parametrize(
    ("name", "distances"),
    [
        ("ge2012-approximate", {-1.98857: 4.6e-3, 1.11635: 4.2e-3}),
        ("ge2012-exact", {-2.20006: 3.2e-5, 1.15280: 1.35e-4}),
    ],
)
def test_the_papers_poses_have_five_real_critical_points(name, distances):
    _, poses = poses_of(name)
    found = critical_dyads(poses)
    assert found.found == 25
    assert found.real.sum() == 5
    assert found.minimum.sum() == 3
    for xc, distance in distances.items():
        k = np.nanargmin(np.abs(found.dyads.fixed_pivot[:, 0] - xc))
        assert found.minimum[k]
        assert np.isclose(found.dyads.fixed_pivot[k, 0], xc, atol=0.02)
        # Half the squared residual over the radius is the distance from the circle.
        ours = found.residual[k] / (2 * found.dyads.radius[k])
        assert np.isclose(ours, distance, rtol=0.02)


@pytest.mark.parametrize("seed", range(25))
def test_no_start_value_finds_a_minimum_that_is_not_listed(seed):
    rng = np.random.default_rng(seed)
    rows = random_task(rng)
    found = critical_dyads(Displacement.from_poses(rows))
    assert found.found == 25
    listed = np.column_stack([found.dyads.fixed_pivot, found.dyads.moving_pivot])[found.minimum]
    starts = rng.normal(scale=3, size=(60, 4))
    fits = [least_squares(circle_residual, x, args=(rows,), method="lm") for x in starts]
    reached = [fit for fit in fits if fit.status > 0 and np.abs(fit.x).max() < 1e3]
    for fit in reached:
        gap = np.abs(listed - fit.x).max(axis=1).min()
        assert gap < 1e-4 * (1 + np.abs(fit.x).max())
    best = np.sqrt(2 * min(fit.cost for fit in reached) / len(rows))
    assert found.residual[0] <= best * (1 + 1e-6) + 1e-12


@pytest.mark.parametrize("seed", range(10))
def test_real_points_are_critical_and_minima_are_minima(seed):
    rng = np.random.default_rng(seed)
    rows = random_task(rng)
    found = critical_dyads(Displacement.from_poses(rows))
    pivots = np.column_stack([found.dyads.fixed_pivot, found.dyads.moving_pivot])
    for x, minimum, residual in zip(pivots, found.minimum, found.residual, strict=True):
        if np.isnan(x).any() or np.abs(x).max() > 100:
            continue
        here = (circle_residual(x, rows) ** 2).sum()
        assert np.isclose(np.sqrt(here / len(rows)), residual, rtol=1e-6, atol=1e-9)
        steps = 1e-3 * rng.normal(size=(60, 4))
        around = np.array([(circle_residual(x + step, rows) ** 2).sum() for step in steps])
        opposite = np.array([(circle_residual(x - step, rows) ** 2).sum() for step in steps])
        # A critical point: what one side gains in first order the other would lose.
        scale = np.abs(around + opposite - 2 * here).max() + 1e-12
        assert np.abs(around - opposite).max() < 0.1 * scale
        assert (around > here).all() == minimum or not minimum


@pytest.mark.parametrize("seed", range(6))
def test_exact_dyads_of_five_poses_are_among_the_minima(seed):
    rng = np.random.default_rng(seed)
    poses = Displacement.from_poses(random_poses(random_four_bar(rng), rng, 5))
    found, five = critical_dyads(poses), dyads_of_five(poses)
    zero = found.dyads[found.minimum & (found.residual < 1e-9)]
    assert len(zero.radius) == five.real.sum()
    for pivot in five.dyads.fixed_pivot[five.real]:
        assert np.abs(zero.fixed_pivot - pivot).max(axis=1).min() < 1e-6 * (1 + np.abs(pivot).max())


@given(st.integers(0, 2**32 - 1), st.floats(-10, 10), st.sampled_from([1e-6, 1.0, 1e6]))
def test_dyads_go_along_with_frames_and_units(seed, turn, unit):
    rng = np.random.default_rng(seed)
    poses = Displacement.from_poses(random_task(rng))
    fixed = Displacement(1e3 * rng.normal(size=2), np.array(turn))
    moving = Displacement(1e3 * rng.normal(size=2), np.array(-2 * turn))
    seen = fixed @ poses @ moving.inverse()
    one = critical_dyads(poses)
    other = critical_dyads(Displacement(seen.translation * unit, seen.angle))
    if min(one.found, other.found) < 25:
        return  # said to be incomplete: nearly repeated poses, one task in a thousand
    best, moved = one.dyads[0], other.dyads[other.minimum]
    gaps = np.column_stack(
        [
            moved.radius / unit - best.radius,
            moved.fixed_pivot / unit - fixed.act(best.fixed_pivot),
            moved.moving_pivot / unit - moving.act(best.moving_pivot),
        ]
    )
    assert np.abs(gaps).max(axis=1).min() < 1e-6 * (1 + float(best.radius) ** 2)


@pytest.mark.parametrize("seed", range(20))
def test_paths_of_another_witness_end_at_the_same_points(seed):
    found, gap, same_real = against_the_paths(random_task(np.random.default_rng(seed)))
    assert found == 25
    assert gap < 1e-7
    assert same_real


def test_three_hundred_starts_end_nowhere_else_and_miss_some():
    missed = 0
    for seed in (*range(12), 69):
        rng = np.random.default_rng(seed)
        rows = random_task(rng)
        found = critical_dyads(Displacement.from_poses(rows))
        listed = np.column_stack([found.dyads.fixed_pivot, found.dyads.moving_pivot])[found.minimum]
        d, t = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
        ends, rms = local_fits(squared, rng.normal(scale=3, size=(300, 4)), d, t)
        near = np.abs(listed - ends[:, None]).max(axis=2) < 1e-3 * (1 + np.abs(ends).max())
        assert len(ends) > 0  # the others are still in some narrow valley
        assert near.any(axis=1).all()
        assert found.residual[0] <= rms.min() * (1 + 1e-6) + 1e-12
        missed += not near.any(axis=0).all()
    assert missed > 0


@pytest.mark.parametrize("seed", range(20))
def test_little_rotation_loses_no_point(seed):
    """The pivots are far away then, and a unit of the motion's size would be a poor one."""
    rng = np.random.default_rng(seed)
    rows = rng.normal(size=(rng.integers(5, 12), 3)) * [1, 1, 10 ** rng.uniform(-1.7, -1)]
    found = critical_dyads(Displacement.from_poses(rows))
    assert found.found == 25
    assert found.charts == 1


@pytest.mark.parametrize("second", [PR, RP])
@pytest.mark.parametrize("count", [5, 9])
def test_a_slider_that_fits_exactly_is_three_points_at_infinity(second, count):
    rng = np.random.default_rng(count)
    poses = Displacement.from_poses(random_poses(random_four_bar(rng, second), rng, count))
    found = critical_dyads(poses)
    assert (found.found, found.at_infinity) == (22, 3)


def test_dyads_that_nearly_coincide_are_told_apart_from_the_saddle_between_them():
    rows = np.array(
        [
            [-0.5632523537275452, -0.042587620533181894, 1.309351468174179],
            [-0.5625110827656609, -0.04380093334172886, 1.2430866017328281],
            [-0.5621588906523353, -0.04401270973087243, 1.2541457717808495],
            [-0.5632410750760467, -0.04251116116940519, 1.3181105789913086],
            [-0.5618678761390565, -0.04415832020076089, 1.267766625412754],
        ]
    )
    found = critical_dyads(Displacement.from_poses(rows))
    assert found.found == 25
    assert (found.residual[found.minimum] < 1e-12).sum() == 4


def test_a_curve_of_dyads_is_not_counted_as_points():
    rows = np.random.default_rng(0).normal(size=(5, 3))
    rows[1] = rows[0]  # four different poses: Burmester's curve
    found = critical_dyads(Displacement.from_poses(rows))
    assert found.found + found.at_infinity < 25
    assert not (found.residual < 1e-9).any()


@pytest.mark.parametrize("method", ["exact", "pencil", "critical", "complete"])
def test_dyads_stay_where_they_are_when_the_task_is_put_elsewhere(method):
    for seed in range(4 if method == "complete" else 10):
        loss, other_number = judged(np.random.default_rng([7, seed]), method)
        assert not other_number
        assert (loss[:, 0] <= loss[:, 2]).all()


def test_weights_count_as_repetition_and_stacks_are_their_members():
    rng = np.random.default_rng(2)
    rows = np.stack([random_poses(random_four_bar(rng), rng, 9) for _ in range(3)])
    rows += 0.01 * rng.normal(size=rows.shape)
    weights = np.ones((3, 9))
    weights[:, 4] = 2
    batch = critical_dyads(Displacement.from_poses(rows), weights)
    for i in range(3):
        doubled = critical_dyads(Displacement.from_poses(np.vstack([rows[i], rows[i, 4]])))
        n = doubled.minimum.sum()
        assert batch.minimum[i].sum() == n
        assert np.allclose(batch.dyads[i].fixed_pivot[:n], doubled.dyads.fixed_pivot[:n], atol=1e-6)
        assert np.allclose(batch.residual[i, :n], doubled.residual[:n], rtol=1e-6)
        assert np.allclose(batch.dyads[i].radius[:n], doubled.dyads.radius[:n], atol=1e-6)


def test_too_few_poses():
    with pytest.raises(InputError) as caught:
        critical_dyads(Displacement.from_poses(np.zeros((4, 3))))
    assert caught.value.code == "E121"


def test_the_rows_of_the_macaulay_matrix_are_independent():
    """Whichever G: the rows that were left out depend on the others, and no other does."""
    rng = np.random.default_rng(12)
    for _ in range(10):
        root = rng.normal(size=(7, 7))
        for chart in range(CHARTS):
            zeros, health = eigen_points(root @ root.T, chart)
            assert health > 1e-5
            assert zeros.shape == (25, 4)
