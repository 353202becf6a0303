"""True distances: derivatives by differences, least squares and least worst by other solvers."""

import numpy as np
import pytest
from scipy.optimize import least_squares as scipy_least_squares
from scipy.optimize import linprog, minimize

from burmester.dyads.face_search import least_worst
from burmester.dyads.geometric_fit import (
    FitProblem,
    circle_distances,
    circle_terms,
    line_distances,
)
from burmester.dyads.least_powers import least_squares
from burmester.dyads.local_minima import best_dyads
from burmester.geometry.displacement import Displacement
from tests.oracles.limits_problems import circle_distance, line_distance
from tests.oracles.witness import random_four_bar, random_poses

KINDS = {
    "circle": (circle_distances, circle_distance, 5),
    "line": (line_distances, line_distance, 4),
}


def random_rows(rng, count=9, noise=0.03):
    rows = random_poses(random_four_bar(rng), rng, count)
    return rows + noise * rng.normal(size=rows.shape)


@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_are_those_of_the_distances_written_out(kind):
    make, distance, size = KINDS[kind]
    rng, h = np.random.default_rng(1), 1e-5
    for _ in range(10):
        rows, z = random_rows(rng), rng.normal(size=size)
        distances = make(Displacement.from_poses(rows))
        here, pull = distances.of(z[None]), rng.normal(size=(1, len(rows)))
        assert np.allclose(here.distance[0], distance(z, rows)[0], rtol=0, atol=1e-13)
        assert np.allclose(distances.only(z[None]), here.distance, rtol=0, atol=1e-15)
        curvature = here.curvature(pull)[0]
        for i, step in enumerate(h * np.eye(size)):
            slope = (distance(z + step, rows)[0] - distance(z - step, rows)[0]) / (2 * h)
            assert np.allclose(here.jacobian[0, :, i], slope, rtol=0, atol=1e-7)
            there, back = (distances.of(to[None]).jacobian[0] for to in (z + step, z - step))
            bend = pull[0] @ (there - back) / (2 * h)
            assert np.allclose(curvature[i], bend, rtol=1e-5, atol=1e-5)
        assert (curvature == curvature.T).all()


def test_many_circles_at_once_are_each_alone():
    rng = np.random.default_rng(2)
    poses = Displacement.from_poses(random_rows(rng))
    z = rng.normal(size=(3, 2, 5))
    miss, slope, *_ = circle_terms(poses)(z)
    for i, j in np.ndindex(3, 2):
        one = circle_distances(poses).of(z[i, j][None])
        assert np.allclose(miss[i, j], one.distance[0], rtol=0, atol=1e-14)
        assert np.allclose(slope[i, j], one.jacobian[0], rtol=0, atol=1e-14)


def started(seed, exact_count, *, basis_size=5, weighted=True):
    """A task, a start near a good dyad, and the directions in which it may move."""
    rng = np.random.default_rng([7, seed])
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, 10) + 0.02 * rng.normal(size=(10, 3))
    d = dyads[0]
    z = np.array([*d.fixed_pivot, *d.moving_pivot, d.radius]) + 0.02 * rng.normal(size=5)
    exact = np.zeros(10, bool)
    exact[rng.permutation(10)[:exact_count]] = True
    share = rng.uniform(0.3, 3, 10) if weighted else np.ones(10)
    basis = np.linalg.qr(rng.normal(size=(5, 5)))[0][:, :basis_size]
    return rows, z, basis, share / share.sum(), exact


def fitted(fit, rows, weighting, z, basis):
    """A fit of one dyad along a basis; weighting: weights and exact poses."""
    problem = FitProblem(circle_distances(Displacement.from_poses(rows)), *weighting)
    return fit(problem, z[None], (basis @ basis.T)[None])


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("basis_size", [5, 3])
def test_least_squares_is_scipys(seed, basis_size):
    rows, z, basis, share, exact = started(seed, 0, basis_size=basis_size)
    found = fitted(least_squares, rows, (share, exact), z, basis)
    assert found.settled.all()
    root = np.sqrt(share)
    other = scipy_least_squares(
        lambda y: root * circle_distance(z + basis @ y, rows)[0],
        np.zeros(basis_size),
        method="lm",
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    (end,) = found.z
    ours = share @ circle_distance(end, rows)[0] ** 2
    assert ours == pytest.approx(2 * other.cost, rel=1e-9)
    assert np.allclose(end, z + basis @ other.x, rtol=1e-5, atol=1e-5)
    off = end - z
    assert np.abs(off - basis @ (basis.T @ off)).max() < 1e-12


def by_slsqp(rows, directions, share, exact, start):
    """The least sum of squares near a start, exact poses held."""
    z, basis = directions
    loose = np.where(exact, 0.0, share)

    def at(y):
        return circle_distance(z + basis @ y, rows)

    def cost(y):
        miss, slope = at(y)
        return 1e3 * (loose @ miss**2), 2e3 * (loose * miss) @ slope @ basis

    held = {
        "type": "eq",
        "fun": lambda y: at(y)[0][exact],
        "jac": lambda y: at(y)[1][exact] @ basis,
    }
    options = {"ftol": 1e-16, "maxiter": 500}
    return (
        minimize(cost, start, jac=True, method="SLSQP", constraints=[held], options=options).fun
        / 1e3
    )


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("exact_count", [1, 2, 3, 4])
def test_exact_poses_are_met_and_their_pulls_balance_the_others(seed, exact_count):
    rows, z, basis, share, exact = started(seed, exact_count)
    found = fitted(least_squares, rows, (share, exact), z, basis)
    (end,), (pull,) = found.z, found.by_distance
    miss, slope = circle_distance(end, rows)
    assert np.abs(miss[exact]).max() < 1e-11 * (1 + np.abs(end).max())
    assert np.allclose(pull[~exact], (share * miss)[~exact], rtol=1e-9, atol=1e-15)
    if not found.settled.all() or np.abs(end).max() > 50:
        return  # on its way to a slider
    assert np.abs(pull @ slope).max() < 1e-9
    ours = np.where(exact, 0, share) @ miss**2
    near = by_slsqp(rows, (z, basis), share, exact, basis.T @ (end - z))
    assert ours <= near * (1 + 1e-6) + 1e-13


def worst(z, rows, share, exact):
    root = np.sqrt(share / share[~exact].mean())
    return np.abs((root * circle_distance(z, rows)[0])[~exact]).max()


def minimax(rows, z, share, exact):
    """The least worst distance near z: linear programs within a trust region that adapts."""
    root, radius = np.sqrt(share / share[~exact].mean()), 0.05
    level = worst(z, rows, share, exact)
    for _ in range(300):
        miss, slope = circle_distance(z, rows)
        miss, slope = root * miss, root[:, None] * slope
        ones = np.ones(((~exact).sum(), 1))
        fit = linprog(
            [0, 0, 0, 0, 0, 1],
            A_ub=np.block([[slope[~exact], -ones], [-slope[~exact], -ones]]),
            b_ub=np.concatenate([-miss[~exact], miss[~exact]]),
            A_eq=np.column_stack([slope, np.zeros(len(miss))])[exact] if exact.any() else None,
            b_eq=-miss[exact] if exact.any() else None,
            bounds=[(-radius, radius)] * 5 + [(0, None)],
        )
        if fit.status != 0:
            radius *= 2
            continue
        to = z + fit.x[:5]
        for _ in range(4 if exact.any() else 0):  # back to the exact poses
            miss, slope = circle_distance(to, rows)
            to = to - np.linalg.pinv(slope[exact]) @ miss[exact]
        after = worst(to, rows, share, exact)
        if after < level:
            z, level, radius = to, after, 1.5 * radius
        else:
            radius /= 3
        if radius < 1e-11:
            break
    return z, level


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("exact_count", [0, 1, 2])
def test_least_worst_is_that_of_linear_programs(seed, exact_count):
    rows, z, _, share, exact = started(seed, exact_count, weighted=seed % 2 == 0)
    first = fitted(least_squares, rows, (share, exact), z, np.eye(5))
    assert first.settled.all()
    (start,) = first.z
    found = fitted(least_worst, rows, (share, exact), start, np.eye(5))
    (end,), (pull,) = found.z, found.by_distance
    assert np.abs(circle_distance(end, rows)[0][exact]).max(initial=0) < 1e-11
    ours = worst(end, rows, share, exact)
    # From the same start to the same place, and no way down from ours.
    _, theirs = minimax(rows, start, share, exact)
    _, further = minimax(rows, end, share, exact)
    assert ours == pytest.approx(theirs, rel=1e-6)
    assert ours <= further * (1 + 1e-6)
    assert ours <= worst(start, rows, share, exact) * (1 + 1e-9)
    slope = circle_distance(end, rows)[1]
    if found.settled.all():
        assert np.abs(pull @ slope).max() < 1e-6 * np.abs(pull).max()


@pytest.mark.parametrize("fit", [least_squares, least_worst])
@pytest.mark.parametrize("exact_count", [0, 2])
def test_each_of_many_dyads_goes_its_own_way(fit, exact_count):
    """Starts of different quality, each along directions of its own, at once and one by one."""
    rows, z, _, share, exact = started(3, exact_count)
    rng = np.random.default_rng(11)
    starts = z + 0.05 * rng.normal(size=(6, 5))
    bases = [np.linalg.qr(rng.normal(size=(5, 5)))[0][:, : 3 + k % 3] for k in range(6)]
    problem = FitProblem(circle_distances(Displacement.from_poses(rows)), share, exact)
    along = np.stack([basis @ basis.T for basis in bases])
    together = fit(problem, starts, along)
    for k in range(6):
        alone = fit(problem, starts[k : k + 1], along[k : k + 1])
        assert alone.settled[0] == together.settled[k]
        if alone.settled[0]:
            assert np.abs(alone.z[0] - together.z[k]).max() < 1e-9


@pytest.mark.parametrize("seed", range(10))
def test_the_least_worst_dyad_is_never_worse_than_that_of_least_squares(seed):
    rng = np.random.default_rng([8, seed])
    poses = Displacement.from_poses(random_rows(rng, int(rng.integers(6, 14)), 0.02))
    by_rms, by_worst = best_dyads(poses), best_dyads(poses, norm="worst")
    assert by_worst.max_error.min() <= by_rms.max_error.min() * (1 + 1e-7)
    # Nor a slider.
    for kind in {type(line) for line in by_rms.sliders}:
        lines = [
            [
                np.abs(line.residual(best.frames.to_canonical(poses))).max() * best.frames.length
                for line in best.sliders
                if isinstance(line, kind)
            ]
            for best in (by_rms, by_worst)
        ]
        assert min(lines[1]) <= min(lines[0]) * (1 + 1e-7)
