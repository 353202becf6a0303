"""Burmester's problem for five poses, and the family of three."""

import json
from importlib import resources
from itertools import combinations_with_replacement, product

import numpy as np
import pytest
from scipy.optimize import fsolve

from burmester.dyads import five_poses
from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.three_poses import dyad_with_fixed_pivot, dyad_with_moving_pivot
from burmester.errors import InputError
from burmester.fourbar.linkage import Linkage
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from tests.oracles.conics import as_rows, circle_equations, in_fifty_digits
from tests.oracles.witness import misses, places, random_four_bar, random_poses, span


@pytest.mark.parametrize("name", ["motiongen-shoulder", "motiongen-mixed5"])
def test_published_five_pose_tasks(name):
    case = json.loads(resources.files("burmester").joinpath(f"cases/{name}.json").read_text())
    rows = np.array(case["poses"])
    rows[:, 2] = np.radians(rows[:, 2])
    five = dyads_of_five(Displacement.from_poses(rows))
    assert five.real.sum() == case["real_dyads"]
    wanted = np.array(case["exact_dyads"])[:, [0, 1, 3, 4, 2]]
    found = as_rows(five.dyads)
    order = np.argsort(found[:, 0])
    assert np.allclose(found[order], wanted, rtol=1e-10, atol=1e-9)


@pytest.mark.parametrize("seed", range(60))
def test_true_dyads_of_random_four_bars_are_among_the_answers(seed):
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, 5)
    five = dyads_of_five(Displacement.from_poses(rows))
    found = as_rows(five.dyads)
    for dyad in dyads:
        truth = np.array([*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius])
        nearest = found[np.abs(found - truth).max(axis=1).argmin()]
        if np.abs(nearest - truth).max() > 1e-9 * span(rows):
            # The poses were rounded to doubles: what counts is the dyad of the rounded ones.
            truth = in_fifty_digits(truth, rows)
        assert np.abs(nearest - truth).max() < 1e-9 * span(rows)


@pytest.mark.parametrize("seed", range(8))
def test_digits_that_rounding_has_cost_are_put_right(seed):
    """Five poses close together magnify rounding; the answer keeps what doubles can hold."""
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng)
    while True:
        where, phi = places(*dyads, rng.uniform(-np.pi, np.pi) + rng.uniform(0, 0.2, 5))
        if np.isfinite(where[0]).all():
            break
    rows = np.column_stack([where[0].real, where[0].imag, phi[0]])
    found = as_rows(dyads_of_five(Displacement.from_poses(rows)).dyads)
    for dyad in dyads:
        truth = np.array([*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius])
        nearest = found[np.abs(found - truth).max(axis=1).argmin()]
        exact = in_fifty_digits(nearest, rows)
        assert np.abs(nearest - exact).max() < 1e-9 * max(1.0, np.abs(truth).max())


@pytest.mark.parametrize("seed", range(12))
def test_no_real_dyad_is_missed_or_invented(seed):
    """Three hundred random starts of another solver find the same real dyads."""
    rng = np.random.default_rng(100 + seed)
    rows = rng.normal(size=(5, 3))
    found = as_rows(dyads_of_five(Displacement.from_poses(rows)).dyads)
    others = []
    for _ in range(300):
        start = np.array([*rng.normal(scale=3, size=4), rng.uniform(0.1, 20)])
        root, _, status, _ = fsolve(circle_equations, start, (rows,), full_output=True, xtol=1e-13)
        if status == 1 and np.abs(circle_equations(root, rows)).max() < 1e-10 and root[4] > 0:
            others.append([*root[:4], np.sqrt(root[4])])
    for other in others:
        assert np.abs(found - other).max(axis=1).min() < 1e-6 * np.abs(other).max()
    for row in found:
        assert np.abs(circle_equations([*row[:4], row[4] ** 2], rows)).max() < 1e-9 * row[4] ** 2


@pytest.mark.parametrize("seed", range(10))
def test_every_pair_of_dyads_is_a_linkage_that_meets_the_poses(seed):
    rng = np.random.default_rng(seed)
    rows = random_poses(random_four_bar(rng), rng, 5)
    poses = Displacement.from_poses(rows)
    five = dyads_of_five(poses)
    real = np.flatnonzero(five.real)
    for i in range(len(real)):
        for j in range(i):
            linkage = Linkage(five.dyads[real[i]], five.dyads[real[j]])
            size = max(span(rows), float(np.nanmax(five.dyads.radius)))
            assert misses(linkage, poses, 1.0).max() < 1e-7 * size


def test_all_four_roots_are_accounted_for():
    rng = np.random.default_rng(4)
    rows = rng.normal(size=(400, 5, 3))
    five = dyads_of_five(Displacement.from_poses(rows))
    assert five.determined.all()
    assert (five.residual < 1e-12).all()
    assert set(np.unique(five.real.sum(axis=1))) == {0, 2, 4}
    for p, real in zip(five.roots, five.real, strict=True):
        # Roots that are not real come in conjugate pairs, up to a complex factor.
        for q in p[~real]:
            overlap = np.abs(p.conj() @ q.conj())
            assert np.isclose(overlap.max(), 1.0, atol=1e-9)
    # No root twice: four different points unless the separation says so.
    assert (five.separation > 1e-6).all()


def test_a_stack_of_tasks_is_its_members():
    rng = np.random.default_rng(11)
    rows = rng.normal(size=(3, 2, 5, 3))
    batch = dyads_of_five(Displacement.from_poses(rows))
    for i, j in np.ndindex(3, 2):
        one = dyads_of_five(Displacement.from_poses(rows[i, j]))
        assert np.array_equal(batch.real[i, j], one.real)
        assert np.allclose(as_rows(batch.dyads[i, j]), as_rows(one.dyads), rtol=1e-9)


def test_a_slider_has_no_first_coefficient():
    """Five poses of a slider-crank: one root is a line, p1 = 0."""
    angle = np.array([0.1, 0.7, 1.5, 2.2, 3.0])
    crank, rod = 1.0, 3.0
    pin = crank * np.column_stack([np.cos(angle), np.sin(angle)])
    tilt = np.arcsin(-pin[:, 1] / rod)  # the rod's far end stays on y = 0
    five = dyads_of_five(Displacement(pin, tilt))
    leading = np.abs(five.coefficients[:, 0])
    assert leading.min() < 1e-12
    p = five.coefficients[leading.argmin()].real
    fixed, moving = constraint_manifold.prismatic_parts(p)
    assert np.abs(moving).max() < 1e-10
    assert abs(fixed[0]) < 1e-10 * abs(fixed[1])


def test_families_are_told_from_isolated_answers():
    rng = np.random.default_rng(2)
    a, b = rng.uniform(0, 2 * np.pi, (2, 5))
    cases = {
        "two sliders": Displacement(np.column_stack([2 * np.cos(a), np.zeros(5)]), -a),
        "a pole": Displacement(np.zeros((5, 2)), a),
        "a translation": Displacement(rng.normal(size=(5, 2)), np.full(5, 0.3)),
        "four different poses": Displacement.from_poses(rng.normal(size=(4, 3))[[0, 1, 2, 3, 3]]),
    }
    for name, poses in cases.items():
        five = dyads_of_five(poses)
        assert not five.determined or five.singular_values[0] < 1e-12, name
    assert dyads_of_five(Displacement(np.column_stack([a, b]), b)).determined


def test_three_poses_circumcentre_and_its_inverse():
    rng = np.random.default_rng(8)
    poses = Displacement.from_poses(rng.normal(size=(3, 3)))
    pivots = rng.normal(size=(50, 2))
    by_moving = dyad_with_moving_pivot(poses, pivots)
    by_fixed = dyad_with_fixed_pivot(poses, pivots)
    for dyads in (by_moving, by_fixed):
        for pose in poses.as_matrix():
            point = dyads.moving_pivot @ pose[:2, :2].T + pose[:2, 2]
            distance = np.linalg.norm(point - dyads.fixed_pivot, axis=1)
            assert np.allclose(distance, dyads.radius, rtol=1e-9)
    there_and_back = dyad_with_fixed_pivot(poses, by_moving.fixed_pivot)
    assert np.allclose(there_and_back.moving_pivot, pivots, atol=1e-8)


@pytest.mark.parametrize("solve", [dyads_of_five, lambda p: dyad_with_moving_pivot(p, [0, 0])])
def test_the_number_of_poses_is_checked(solve):
    with pytest.raises(InputError, match="not 4") as caught:
        solve(Displacement.from_poses(np.zeros((4, 3))))
    assert caught.value.code == "E121"


def test_conics_that_share_a_curve_are_told_without_a_decomposition_of_all():
    """Two conics that nearly have a line in common: what the singular values say is told."""
    rng = np.random.default_rng(4)
    quadratic = list(combinations_with_replacement(range(3), 2))
    common, own = rng.normal(size=(400, 1, 3)), rng.normal(size=(400, 2, 3))
    outer = common[..., :, None] * own[..., None, :]
    conics = np.stack([outer[..., i, j] + (i < j) * outer[..., j, i] for i, j in quadratic], -1)
    conics += 10.0 ** np.linspace(-12, -7, 400)[:, None, None] * rng.normal(size=conics.shape)
    conics /= np.linalg.norm(conics, axis=-1, keepdims=True)
    _, isolated = five_poses.conic_intersections(conics)
    monomials = list(combinations_with_replacement(range(3), 3))
    rows = np.zeros((400, 6, 10))
    for row, (k, which) in enumerate(product(range(3), range(2))):
        for at, pair in enumerate(quadratic):
            rows[:, row, monomials.index(tuple(sorted((*pair, k))))] = conics[:, which, at]
    least = np.linalg.svd(rows, compute_uv=False)[:, -1]
    sure = np.abs(np.log10(least / five_poses.ISOLATED_TOLERANCE)) > 0.1
    assert (isolated == (least > five_poses.ISOLATED_TOLERANCE))[sure].all()
    assert 0 < isolated.sum() < 400
