"""Least squares and minimax of the true output angle."""

import numpy as np
import pytest
from scipy.optimize import minimize

from burmester.functions.kept_requirements import KeptRequirements
from burmester.functions.refinement import refined
from burmester.synthesis.function_generation import generate_function
from burmester.tasks.function_task import (
    FunctionTask,
    SampledFunction,
    chebyshev_spacing,
    even_spacing,
)
from tests.oracles import function_loops
from tests.oracles.generators import drawn


def task_of(values, x, input_deg, output_deg, **how):
    """A function at 61 even inputs."""
    function = SampledFunction("f", values, x, np.radians(input_deg), np.radians(output_deg))
    return FunctionTask(*function.at(even_spacing(61)), function=function, **how)


def test_least_squares_is_a_minimum_of_the_driven_error():
    one, inputs, outputs = drawn(7, count=12)
    outputs = outputs + 0.01 * np.random.default_rng(7).normal(size=12)
    anything = KeptRequirements(np.zeros(1), np.full(1, np.inf))
    end, error, arrived = refined(one, FunctionTask(inputs, outputs), anything)
    assert arrived.all()
    assert error == pytest.approx(np.sqrt((end.error(inputs, outputs) ** 2).mean(axis=1)))
    found = np.array([end.input_link[0], end.coupler[0], end.output_link[0]])
    phases = np.array([end.input_phase[0], end.output_phase[0]])

    def cost(v):
        changed = type(end)(*np.exp(v[:3]), *v[3:], end.side[0])
        driven = function_loops.outputs(changed, inputs)
        return (np.angle(np.exp(1j * (driven - outputs))) ** 2).sum()

    start = np.array([*np.log(found), *phases])
    least = cost(start)
    for step in 1e-4 * np.eye(5):
        assert cost(start + step) > least
        assert cost(start - step) > least


def test_minimax_errors_alternate_at_one_level():
    """Five unknowns: six greatest errors of alternate sign, which no small change lowers."""
    task = task_of(np.log10, (1, 2), 60, 60, minimax=True)
    best = generate_function(task).prices[0]
    error = np.degrees(best.errors)
    level = np.abs(error).max()
    assert level == pytest.approx(0.00365, abs=1e-5)
    at = np.flatnonzero(np.abs(error) > level * (1 - 1e-6))
    assert len(at) == 6
    assert (np.diff(np.sign(error[at])) != 0).all()


# The figures of another program (a prototype), with 61 samples, in degrees: least greatest errors.
@pytest.mark.parametrize(
    ("values", "x", "ranges", "expected"),
    [
        (np.log10, (1, 2), (60, -60), 0.00101),
        (np.log10, (1, 2), (90, 90), 0.0152),
        (np.sin, (0, np.pi / 2), (90, 90), 0.191),
    ],
)
def test_least_greatest_errors(values, x, ranges, expected):
    best = generate_function(task_of(values, x, *ranges, minimax=True)).prices[0]
    assert np.degrees(np.abs(best.errors).max()) == pytest.approx(expected, rel=0.02)
    inputs = np.radians(ranges[0]) * even_spacing(13)
    driven = np.degrees(function_loops.outputs(best.generator, inputs))
    y = values(x[0] + (x[1] - x[0]) * even_spacing(13))
    asked = ranges[1] * (y - y[0]) / (y[-1] - y[0])
    error = (driven - asked + 180) % 360 - 180
    assert np.abs(error).max() < expected * 1.02


@pytest.mark.parametrize(
    ("values", "x", "ranges"),
    [(np.log10, (1, 2), (60, 60)), (np.sin, (0, np.pi / 2), (90, 90))],
)
def test_scipys_minimax_finds_no_lower_level(values, x, ranges):
    """The level and five dimensions, by sequential quadratic programs on the driven error."""
    task = task_of(values, x, *ranges, minimax=True)
    best = generate_function(task).prices[0]
    g, level = best.generator, np.abs(best.errors).max()
    at = np.array([g.input_link, g.coupler, g.output_link, g.input_phase, g.output_phase]).ravel()
    side = float(g.side.ravel()[0])

    def error(v):
        a, r, b, p, q = v[:5]
        to = a * np.exp(1j * (p + task.inputs)) - 1  # from the output's pivot to the input's pin
        cosine = (b * b + np.abs(to) ** 2 - r * r) / (2 * b * np.abs(to))
        driven = to * np.exp(-1j * side * np.arccos(np.clip(cosine, -1, 1)))
        return np.angle(driven * np.exp(-1j * (q + task.outputs)))

    assert np.allclose(error(at), best.errors[: len(task.inputs)], atol=1e-9)
    rng, ends = np.random.default_rng(0), []
    sides = np.array([[1.0], [-1.0]])
    for spread in (1e-6, 0.003, 0.01, 0.03):
        start = at * (1 + spread * rng.normal(size=5))
        start = np.append(start, np.abs(error(start)).max() / level)
        below = {"type": "ineq", "fun": lambda v: (v[5] - sides * error(v) / level).ravel()}
        bounds = [(0.1, 10)] * 3 + [(-9, 9)] * 2 + [(0, None)]
        end = minimize(lambda v: v[5], start, constraints=below, method="SLSQP", bounds=bounds)
        ends.append(np.abs(error(end.x)).max() / level)
    assert min(ends) > 1 - 1e-4
    assert np.min(ends) < 1.05  # it comes near


def test_no_local_search_finds_less_than_all_critical_points_lead_to():
    """Nelder and Mead from random linkages, on the driven error: none is below the best."""
    one, inputs, outputs = drawn(11, count=10)
    outputs = outputs + 0.02 * np.random.default_rng(1).normal(size=10)
    found = generate_function(FunctionTask(inputs, outputs)).generators
    least = min((each.errors**2).sum() for each in found if np.isfinite(each.errors).all())
    rng = np.random.default_rng(2)

    def cost(v):
        g = type(one)(*np.exp(np.clip(v[:3], -2.3, 2.3)), *v[3:], side)
        error = g.error(inputs, outputs)
        return 100.0 if np.isnan(error).any() else (error**2).sum()

    ends = []
    for trial in range(30):
        side = 1.0 if trial % 2 else -1.0
        start = [*rng.uniform(-1, 1, 3), *rng.uniform(-np.pi, np.pi, 2)]
        ends.append(minimize(cost, start, method="Nelder-Mead", options={"maxfev": 800}).fun)
    assert min(ends) >= least * (1 - 1e-9)


def test_sizes_are_bounded():
    task = task_of(lambda x: x**2, (-1, 1), 90, 60)
    for each in generate_function(task).generators:
        assert each.generator.sizes.max() <= 10.0 + 1e-9
        assert each.generator.sizes.min() >= 0.1 - 1e-9


def test_chebyshev_spacing_is_that_of_the_polynomial():
    for count in (3, 4, 5, 8):
        zeros = np.polynomial.chebyshev.chebroots([0] * count + [1])
        assert np.allclose(np.sort(2 * chebyshev_spacing(count) - 1), np.sort(zeros))
