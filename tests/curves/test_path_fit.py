"""Linkages near many points: driven by the witness, and against SciPy's own descent."""

import numpy as np
import pytest
from scipy.optimize import minimize

from burmester.curves.path_fit import PathSearch
from tests.oracles.coupler_curves import (
    CABRERA,
    CABRERA_TURNS,
    distances,
    dyads_of,
    random_crank,
    refined_from,
    traced,
)
from tests.samples import EVERY, some_of

NOISE = 0.01


def path(seed, t, noise=NOISE):
    """Points with noise of a random linkage's curve, and the linkage."""
    rng = np.random.default_rng(seed)
    z, side = random_crank(rng)
    z[:] *= 1 / np.sqrt(np.var(traced(dyads_of(z), side, t)))
    p = traced(dyads_of(z), side, t)
    p = p + noise * (rng.normal(size=len(t)) + 1j * rng.normal(size=len(t)))
    return np.column_stack([p.real, p.imag]), z, side


@pytest.mark.parametrize("seed", range(3))
def test_closed_curves_are_met_as_from_the_linkage_that_made_them(seed):
    t = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    points, z, side = path(seed, t)
    fit = PathSearch.of(points, closed=True).nearest()
    assert fit.cost[0] <= refined_from(z, side, t, points) * (1 + 1e-4)
    # What is told is what the linkage does.
    away = distances(dyads_of(fit.linkages.dimensions[0]), points)
    assert np.isclose((away**2).sum(), fit.cost[0], rtol=1e-3)
    assert (np.diff(np.unwrap(fit.t[0])) * np.sign(fit.t[0, 1] - fit.t[0, 0]) > 0).all()


@pytest.mark.parametrize("seed", [1, 2])
def test_open_paths(seed):
    t = 0.7 + np.linspace(0, 2.5, 15)
    points, z, side = path(seed, t)
    fit = PathSearch.of(points).nearest()
    best, rows = fit.linkages.batch().linkage(0), fit.linkages.rows(fit.t)
    away = np.hypot(*(rows[0, :, :2] - points).T)
    driven = distances((best.first, best.second), points)
    assert np.allclose(driven, away, atol=2e-3)
    assert (away**2).sum() <= refined_from(z, side, t, points) * 1.02


def test_exact_points_of_a_curve_find_the_linkage():
    t = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    points, _, _ = path(8, t, noise=0.0)
    fit = PathSearch.of(points, closed=True).nearest()
    assert np.sqrt(fit.cost[0] / 24) < 1e-6
    assert distances(dyads_of(fit.linkages.dimensions[0]), points).max() < 1e-5


def test_many_points_are_all_counted():
    t = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    points, z, side = path(4, t)
    fit = PathSearch.of(points, closed=True).nearest()
    assert fit.cost[0] <= refined_from(z, side, t, points) * (1 + 1e-4)


def test_heavy_points_are_nearer():
    t = np.linspace(0, 2 * np.pi, 30, endpoint=False)
    points, _, _ = path(1, t, noise=0.05)
    weights = np.where(np.arange(30) == 7, 1000.0, 1.0)
    even, heavy = (PathSearch.of(points, closed=True, weights=w).nearest() for w in (None, weights))
    one, two = (distances(dyads_of(each.linkages.dimensions[0]), points) for each in (even, heavy))
    assert two[7] < one[7] / 5


def test_cabreras_eighteen_points():
    timed = PathSearch.of(CABRERA, closed=True, crank_angles=CABRERA_TURNS).nearest()
    assert timed.cost[0] == pytest.approx(9.02888e-3, rel=1e-5)
    z = timed.linkages.dimensions[0]
    at = [traced(dyads_of(z), side, timed.t[0, 0] + CABRERA_TURNS) for side in (0, 1)]
    wanted = CABRERA[:, 0] + 1j * CABRERA[:, 1]
    assert min((np.abs(each - wanted) ** 2).sum() for each in at) == pytest.approx(timed.cost[0])
    free = PathSearch.of(CABRERA, closed=True).nearest()
    assert free.cost[0] < 3.0709e-3
    assert (distances(dyads_of(free.linkages.dimensions[0]), CABRERA) ** 2).sum() < 3.0709e-3


def test_random_starts_of_another_descent_find_nothing_better():
    t = np.linspace(0, 2 * np.pi, 16, endpoint=False)
    points, _, _ = path(6, t, noise=0.05)
    best = PathSearch.of(points, closed=True).nearest().cost[0]
    rng = np.random.default_rng(0)
    for _ in range(8):
        z, side = random_crank(rng)
        found = refined_from(z, side, rng.choice([-1, 1]) * t + rng.uniform(0, 6), points)
        assert found > best * (1 - 1e-3)


@pytest.mark.parametrize("closed", [True, False])
def test_the_greatest_distance_is_as_small_as_nelder_and_meads_search_makes_it(closed):
    t = np.linspace(0, 2 * np.pi if closed else 3.0, 24, endpoint=not closed)
    points, _, _ = path(1, t, noise=0.03)
    found = PathSearch.of(points, closed=closed).nearest()

    def greatest(z):
        return np.nan_to_num(distances(dyads_of(z), points), nan=9.0).max()

    every = np.array([greatest(z) for z in found.linkages.dimensions])
    assert every.min() < 0.9 * every[0]  # the first has the least sum of squares
    for z in found.linkages.dimensions[some_of([int(every.argmin()), 0], 1)]:
        steps = {"maxiter": 300 if EVERY else 60}
        searched = minimize(greatest, z, method="Nelder-Mead", options=steps)
        assert every.min() < 1.03 * searched.fun
