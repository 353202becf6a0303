"""Levenberg-Marquardt on functions that are known for being hard."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.numerics.least_squares import levenberg_marquardt

TIMES = np.linspace(0.1, 2, 12)


def rosenbrock(x):
    a, b = x[:, 0], x[:, 1]
    one, zero = np.ones_like(a), np.zeros_like(a)
    miss = np.stack([10 * (b - a**2), 1 - a], axis=-1)
    return miss, np.stack([np.stack([-20 * a, 10 * one], -1), np.stack([-one, zero], -1)], axis=-2)


def two_decays(x):
    """Data of two exponentials, with a misfit that no parameters take away."""
    share, fast, slow = (x[:, k, None] for k in range(3))
    data = np.exp(-TIMES) + 0.5 * np.exp(-4 * TIMES) + 0.01 * np.sin(9 * TIMES)
    e1, e2 = np.exp(-fast * TIMES), np.exp(-slow * TIMES)
    slope = np.stack([e1, -TIMES * share * e1, -TIMES * e2], axis=-1)
    return share * e1 + e2 - data, slope


CASES = {"rosenbrock": (rosenbrock, 2), "two decays": (two_decays, 3)}


@pytest.mark.parametrize("name", CASES)
def test_it_ends_where_scipy_ends(name):
    kernel, size = CASES[name]
    starts = np.random.default_rng(3).uniform(0.2, 3, (20, size))
    ends = levenberg_marquardt(kernel, starts)
    assert ends.converged.all()
    for x, cost in zip(starts, ends.cost, strict=True):
        other = least_squares(lambda v: kernel(v[None])[0][0], x, method="lm", xtol=1e-14)
        assert cost == pytest.approx(2 * other.cost, rel=1e-9, abs=1e-20)


@pytest.mark.parametrize("limit", [2, 5, 10])
@pytest.mark.parametrize("name", CASES)
def test_it_stays_at_the_lowest_that_it_has_seen(name, limit, monkeypatch):
    monkeypatch.setattr("burmester.numerics.least_squares.MAX_STEPS", limit)
    kernel, size = CASES[name]
    for x in np.random.default_rng(4).uniform(-3, 3, (10, 1, size)):
        seen = []

        def watched(v, seen=seen):
            miss, slope = kernel(v)
            seen.append((miss**2).sum())
            return miss, slope

        ends = levenberg_marquardt(watched, x)
        assert ends.cost[0] == min(seen)
        assert ends.evaluations[0] == len(seen)
        assert (kernel(ends.x)[0] ** 2).sum() == ends.cost[0]


def test_a_slope_that_sinks_to_infinity_does_not_converge():
    ends = levenberg_marquardt(lambda x: (np.exp(-x), -np.exp(-x)[..., None]), np.zeros((1, 1)))
    assert ends.cost[0] < 1e-20 or not ends.converged[0]

    def valley(x):
        flat = 1 / (1 + x**2)
        return np.concatenate([1 + flat, flat], -1), np.stack([-2 * x * flat**2] * 2, axis=-2)

    assert not levenberg_marquardt(valley, np.ones((1, 1))).converged[0]
