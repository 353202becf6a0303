"""The compiled sums beside a path, against the witness's curve and its difference quotients."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from burmester.curves.curve_kernel import normal_equations
from tests.oracles.coupler_curves import dyads_of, random_crank, traced

STRIDE = 1e-5


def sums(z, side, points, t, steps=30):
    """Crank angles of the feet, cost, gradient and normal equations of one linkage."""
    feet, cost = np.array(t, dtype=float)[None], np.empty(1)
    gradient, normal = np.empty((1, 9)), np.empty((1, 9, 9))
    normal_equations(z[None], np.array([side]), points, feet, steps, 0.3, cost, gradient, normal)
    return feet[0], cost[0], gradient[0], normal[0]


def on_witness(z, points, t, side):
    """The sum of weighted squared distances from the witness's curve, near crank angles."""
    total = 0.0
    for (x, y, share), near in zip(points, t, strict=True):

        def gap(u, p=complex(x, y)):
            return float(abs(traced(dyads_of(z), side, [u])[0] - p) ** 2)

        bounds = (near - 0.05, near + 0.05)
        total += (
            share**2 * minimize_scalar(gap, bounds, method="bounded", options={"xatol": 1e-9}).fun
        )
    return total


@pytest.mark.parametrize("seed", range(2))
def test_sums_and_their_derivatives_are_those_of_the_witness(seed):
    rng = np.random.default_rng(seed)
    z, side = random_crank(rng)
    t = rng.uniform(0, 6, 5)
    curve = traced(dyads_of(z), side, t) + 0.02 * (rng.normal(size=5) + 1j * rng.normal(size=5))
    points = np.column_stack([curve.real, curve.imag, rng.uniform(0.5, 2, 5)])
    cost = on_witness(z, points, t, side)
    both = [(sums(z, sign, points, t), sign) for sign in (-1.0, 1.0)]
    (feet, own, gradient, normal), _ = min(both, key=lambda each: abs(each[0][1] - cost))
    assert own == pytest.approx(cost, rel=1e-6)
    assert np.abs(feet - t).max() < 0.05
    for k, unit in enumerate(np.eye(9)):
        ends = [on_witness(z + sign * STRIDE * unit, points, feet, side) for sign in (1, -1)]
        assert 2 * gradient[k] == pytest.approx((ends[0] - ends[1]) / (2 * STRIDE), abs=2e-5)
    assert np.array_equal(normal, normal.T)
    assert (np.linalg.eigvalsh(normal) > -1e-9).all()


def test_of_one_point_the_normal_equations_are_its_row_twice():
    rng = np.random.default_rng(4)
    z, side = random_crank(rng)
    where = traced(dyads_of(z), side, [1.0])[0] + 0.05j
    _, cost, gradient, normal = min(
        (sums(z, sign, np.array([[where.real, where.imag, 1.5]]), [1.0]) for sign in (-1.0, 1.0)),
        key=lambda each: each[1],
    )
    assert np.allclose(normal * cost, np.outer(gradient, gradient), rtol=1e-9, atol=1e-12)


def test_a_linkage_that_does_not_assemble_costs_without_end():
    z = np.array([0, 0, 10, 0, 1, 1, 1, 0.5, 0.5])
    _, cost, gradient, normal = sums(z, 1.0, np.array([[0.0, 1.0, 1.0]]), [0.0])
    assert cost == np.inf
    assert not gradient.any()
    assert not normal.any()
