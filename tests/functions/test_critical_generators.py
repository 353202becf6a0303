"""All critical points of Freudenstein's residual: counted, and more than random starts find."""

import numpy as np
import pytest
from scipy.optimize import minimize

from burmester.functions.critical_generators import critical_generators
from burmester.tasks.function_task import FunctionTask
from tests.oracles.generators import drawn


def noisy(seed, count=10):
    one, inputs, outputs = drawn(seed, count=count, span=2.0)
    rng = np.random.default_rng(seed)
    return one, inputs, outputs + 0.02 * rng.normal(size=count)


def cost(v, inputs, outputs, phases=(None, None)):
    """The squared residual of Freudenstein's equation, R3 being the best one."""
    r1, r2, p, q = v
    p = p if phases[0] is None else phases[0]
    q = q if phases[1] is None else phases[1]
    f = r1 * np.cos(q + outputs) - r2 * np.cos(p + inputs) - np.cos(p + inputs - q - outputs)
    return ((f - f.mean()) ** 2).sum()


@pytest.mark.parametrize("count", [6, 10])
@pytest.mark.parametrize("seed", range(3))
def test_generic_pairs_have_28_critical_points_and_6_with_one_phase(seed, count):
    one, inputs, outputs = noisy(seed, count)
    assert critical_generators(FunctionTask(inputs, outputs)).found == 28
    assert critical_generators(FunctionTask(inputs, outputs, float(one.input_phase[0]))).found == 6
    task = FunctionTask(inputs, outputs, None, float(one.output_phase[0]))
    assert critical_generators(task).found == 6


@pytest.mark.parametrize("known", ["none", "input", "output"])
def test_random_starts_end_at_critical_points_that_were_found(known):
    one, inputs, outputs = noisy(4)
    given = {
        "none": (None, None),
        "input": (float(one.input_phase[0]), None),
        "output": (None, float(one.output_phase[0])),
    }[known]
    points = critical_generators(FunctionTask(inputs, outputs, *given))
    at = np.column_stack([points.ratios, points.input_phase, points.output_phase])[points.real]
    costs = np.array([cost(v, inputs, outputs, given) for v in at])
    for v in at:  # they are critical
        slopes = [
            (cost(v + h, inputs, outputs, given) - cost(v - h, inputs, outputs, given)) / 2e-6
            for h in 1e-6 * np.eye(4)
        ]
        assert np.abs(slopes).max() < 1e-5 * (1 + np.abs(v).max())
    rng, met = np.random.default_rng(0), 0
    for _ in range(40):
        start = [*rng.normal(size=2), *rng.uniform(-np.pi, np.pi, 2)]
        end = minimize(cost, start, args=(inputs, outputs, given), method="BFGS", tol=1e-12)
        if np.abs(end.x[:2]).max() < 1e3 and np.abs(end.jac).max() < 1e-6:
            met += 1
            assert np.abs(costs - end.fun).min() < 1e-6 * (1 + end.fun)
    assert met > 5
