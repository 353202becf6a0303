"""Soft programs: the gap between what is reached and what any step can reach, by weak duality."""

import numpy as np
import pytest

from burmester.numerics.quadratic_program import SoftProgram


def programs(seed, n, m, *, equal=0, rank=None, penalty=10.0):
    """Random programs (6,), their constraints of some rank."""
    rng = np.random.default_rng(seed)
    half = rng.normal(size=(6, n, n))
    hessian = half @ np.swapaxes(half, -1, -2) + 1e-3 * np.eye(n)
    jacobian = rng.normal(size=(6, m, n)) * np.exp(rng.normal(size=(6, m, 1)))
    if rank is not None:
        jacobian = rng.normal(size=(6, m, rank)) @ jacobian[:, :rank]
    high = np.full((6, m), penalty)
    low = np.where(np.arange(m) < equal, -high, 0.0)
    return SoftProgram(
        hessian, rng.normal(size=(6, n)), rng.normal(size=(6, m)), jacobian, low, high
    )


def cost(program, step):
    """What a step costs, each violation times the penalty."""
    value = program.value + np.einsum("kmn,kn->km", program.jacobian, step)
    off = np.where(program.low < 0, np.abs(value), np.maximum(value, 0.0))
    bent = np.einsum("kn,knp,kp->k", step, program.hessian, step) / 2
    return bent + (program.gradient * step).sum(1) + (program.high * off).sum(1)


def bound(program, multipliers):
    """Below what no step can cost: the least of the Lagrangian, for multipliers in their bounds."""
    pull = program.gradient + np.einsum("km,kmn->kn", multipliers, program.jacobian)
    least = -np.linalg.solve(program.hessian, pull[..., None])[..., 0]
    return (pull * least).sum(1) / 2 + (multipliers * program.value).sum(1)


@pytest.mark.parametrize(
    ("n", "m", "more"),
    [
        (5, 3, {}),
        (8, 12, {"equal": 4}),
        (12, 90, {}),
        (12, 90, {"equal": 20, "penalty": 1.0}),
        (10, 60, {"rank": 4}),
        (10, 60, {"penalty": 1e3}),
        (6, 0, {}),
    ],
)
def test_no_step_costs_less(n, m, more):
    program = programs(3, n, m, **more)
    step, multipliers = program.solved()
    assert ((program.low <= multipliers) & (multipliers <= program.high)).all()
    reached, least = cost(program, step), bound(program, multipliers)
    still = cost(program, np.zeros_like(step))
    assert reached - least == pytest.approx(0, abs=1e-4 * max(1.0, still.max()))


def test_the_multipliers_of_a_program_like_it_are_a_start():
    program = programs(5, 9, 40)
    _, multipliers = program.solved()
    near = program._replace(value=program.value + 1e-3)
    step, again = near.solved(multipliers)
    assert cost(near, step) - bound(near, again) == pytest.approx(0, abs=1e-7)
