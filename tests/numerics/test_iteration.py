"""Iterations of many rows, bundles of rows, and the small tools beside them, row by row."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import approx_fprime, least_squares, minimize

from burmester.numerics.arrays import (
    concatenate,
    copied,
    put,
    shares,
    take,
    unique_rows,
    weights_of_mean_one,
    weights_or_ones,
    where,
)
from burmester.numerics.differences import DifferenceQuotients
from burmester.numerics.iteration import iterate, shortened
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import matvec, solve_or_shortest
from burmester.numerics.quadratic_program import SoftProgram


@dataclass(frozen=True)
class Inner:
    value: np.ndarray
    nothing: None = None


class Outer(NamedTuple):
    inner: Inner
    pair: tuple
    names: list


def bundle(start, count):
    k = np.arange(start, start + count)
    parts = (1.0 * k, np.stack([k, -k], axis=-1))
    return Outer(Inner(np.stack([k, k**2], axis=-1)), parts, [f"row {i}" for i in k])


def rows_of(one):
    """A bundle as plain rows, written out by hand."""
    columns = (one.inner.value.tolist(), one.pair[0].tolist(), one.pair[1].tolist(), one.names)
    return list(zip(*columns, strict=True))


def test_bundles_are_taken_and_joined_row_by_row():
    one, two = bundle(0, 4), bundle(10, 3)
    assert rows_of(take(one, [2, 0, 2])) == [rows_of(one)[k] for k in (2, 0, 2)]
    mask = np.array([True, False, True, True])
    assert rows_of(take(one, mask)) == [rows_of(one)[k] for k in (0, 2, 3)]
    assert rows_of(concatenate([one, two, one])) == rows_of(one) + rows_of(two) + rows_of(one)
    assert take(one, [1]).inner.nothing is None


def test_bundles_are_merged_and_overwritten_row_by_row():
    one, two = bundle(0, 4)[:2], bundle(20, 4)[:2]
    mask = np.array([False, True, True, False])
    merged, before = where(mask, two, one), copied(one)
    for k, chosen in enumerate(mask):
        source = two if chosen else one
        assert (merged[0].value[k] == source[0].value[k]).all()
        assert (merged[1][1][k] == source[1][1][k]).all()
    put(one, np.array([3, 1]), take(two, [0, 2]))
    assert one[0].value.tolist() == [[0, 0], [22, 484], [2, 4], [20, 400]]
    assert before[0].value.tolist() == [[0, 0], [1, 1], [2, 4], [3, 9]]


def test_every_row_of_an_iteration_goes_as_far_as_it_would_alone():
    """Collatz' sequences: rows end at different steps, some not at all, one does not start."""

    def advance(rows, here):
        number, calls = here
        after = np.where(number % 2, 3 * number + 1, number // 2)
        seen.append(list(rows))
        return (after, calls + 1), after == 1

    seen, limit = [], 20
    numbers = np.array([6, 27, 2, 97, 7, 5, 8])
    run = np.array([0, 1, 2, 3, 4, 6])  # all but the row of 5
    (ends, calls), ended_at = iterate(advance, (numbers, np.zeros(7, dtype=int)), run, limit)
    for k in range(len(numbers)):
        number, steps = int(numbers[k]), 0
        while k in run and steps < limit and (number != 1 or not steps):
            number, steps = (3 * number + 1 if number % 2 else number // 2), steps + 1
        assert (ends[k], calls[k]) == (number, steps)
        assert ended_at[k] == (steps if k in run and number == 1 else 0)
        assert sum(k in rows for rows in seen) == steps
    assert numbers.tolist() == [6, 27, 2, 97, 7, 5, 8]


@pytest.mark.parametrize("lead", [(), (5,)])
def test_a_step_is_quartered_until_it_makes_nothing_worse(lead):
    step = np.broadcast_to([1.0, 2.0], (*lead, 2))
    limit = np.array(1e-2) if not lead else np.array([2.0, 0.3, 1e-2, 0.25, 1e-30])
    there, worse = shortened(lambda s: s, step, lambda s: s[..., 0] > limit)
    for k in np.ndindex(lead):
        power = next((n for n in range(20) if 4.0**-n <= limit[k]), 19)
        assert there[k].tolist() == [4.0**-power, 2 * 4.0**-power]
        assert worse[k] == (4.0**-power > limit[k])


def test_a_damped_descent_ends_where_scipy_ends_and_never_goes_up():
    """Circles through scattered points, each row with points of its own and steps of one kind."""
    rng = np.random.default_rng(1)
    points, start = rng.normal(size=(6, 9, 2)), np.tile([0.3, -0.2, 0.8], (6, 1))

    def residuals(x, at):
        away = at - x[..., None, :2]
        distance = np.linalg.norm(away, axis=-1)
        by_centre = -away / distance[..., None]
        by_radius = -np.ones((*distance.shape, 1))
        return distance - x[..., 2:], np.concatenate([by_centre, by_radius], axis=-1)

    costs = [[] for _ in points]

    def attempt(rows, here, damping):
        residual, jacobian = residuals(here, points[rows])
        back = np.swapaxes(jacobian, -1, -2)
        normal = back @ jacobian + damping[:, None, None] * np.eye(3)
        step = -np.linalg.solve(normal, back @ residual[..., None])[..., 0]
        there = here + step
        before, after = (residual**2).sum(-1), (residuals(there, points[rows])[0] ** 2).sum(-1)
        for row, cost in zip(rows, before, strict=True):
            costs[row].append(cost)
        better = after <= before
        ended = np.abs(step).max(axis=-1) < 1e-12
        return Attempt(there, better, np.where(better, damping / 10, damping * 10), ended)

    ends, ended = damped_descent(attempt, start, np.arange(6), damping=1e-3, max_steps=200)
    assert ended.all()
    for k in range(6):
        other = least_squares(
            lambda x, k=k: residuals(x, points[k])[0],
            start[k],
            jac=lambda x, k=k: residuals(x, points[k])[1],
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-12,
        )
        assert ends[k] == pytest.approx(other.x, abs=1e-7)
        assert all(np.diff(costs[k]) <= 0)
    none, ended = damped_descent(attempt, start, np.arange(2), damping=1e-3, max_steps=1)
    assert not ended.any()
    assert (none[2:] == start[2:]).all()
    assert (none[:2] != start[:2]).any()


@pytest.mark.parametrize(("central", "close"), [(False, 1e-6), (True, 1e-9)])
def test_difference_quotients_are_derivatives_along_directions(central, close):
    rng = np.random.default_rng(2)
    x, directions = rng.normal(size=(4, 3)), rng.normal(size=(2, 1, 3))

    def function(x):
        return np.stack([np.sin(x[..., 0]) * x[..., 1], x[..., 2] ** 2], axis=-1)

    quotients = DifferenceQuotients(1e-6 if central else 1e-7, central)
    points = quotients.points(x, directions)
    jacobian = quotients.jacobian(function(points))
    assert central or (points[0] == x).all()
    for k in range(4):
        exact = np.array(
            [[np.cos(x[k, 0]) * x[k, 1], np.sin(x[k, 0]), 0.0], [0.0, 0.0, 2 * x[k, 2]]]
        )
        assert jacobian[k] == pytest.approx(exact @ directions[:, 0].T, abs=close)
        by_scipy = approx_fprime(x[k], function)
        assert jacobian[k] == pytest.approx(by_scipy @ directions[:, 0].T, abs=1e-6)


def test_the_solution_of_a_singular_system_is_the_shortest_least_squares_one():
    matrices = np.array([[[2.0, 1.0], [0.0, 3.0]], [[1.0, 1.0], [1.0, 1.0]]])
    right = np.array([[3.0, 3.0], [2.0, 4.0]])
    x = solve_or_shortest(matrices, right)
    assert matvec(matrices[0], x[0]) == pytest.approx(right[0])
    assert x[1] == pytest.approx(np.linalg.lstsq(matrices[1], right[1], rcond=None)[0])
    assert solve_or_shortest(matrices[:1], right[:1])[0] == pytest.approx([1.0, 1.0])


@pytest.mark.parametrize("norm", ["euclidean", "maximum"])
def test_each_row_is_there_once_the_first_of_its_like(norm):
    rng = np.random.default_rng(3)
    places = rng.normal(size=(6, 3)) + 1j * rng.normal(size=(6, 3))
    which = rng.integers(0, 6, size=40)
    rows = places[which] + 1e-9 * rng.normal(size=(40, 3))
    first = [k for k in range(40) if which[k] not in which[:k]]
    assert (unique_rows(rows, 1e-6, norm) == rows[first]).all()
    assert len(unique_rows(rows, 1e-12, norm)) == 40
    assert unique_rows(rows[:0], 1e-6, norm).shape == (0, 3)


def test_the_norm_decides_which_rows_are_one():
    rows = np.array([[0.0, 0.0, 0.0], [0.8, 0.8, 0.8]])  # sqrt(3) 0.8 > 1
    assert len(unique_rows(rows, 1.0, "maximum")) == 1
    assert len(unique_rows(rows, 1.0, "euclidean")) == 2


def test_weights_are_as_given_or_one_and_scaled_by_sum_or_mean():
    w = np.array([1.0, 2.0, 5.0])
    assert weights_or_ones(None, (2, 3)).tolist() == [[1, 1, 1], [1, 1, 1]]
    assert weights_or_ones(w, (2, 3)).tolist() == [[1, 2, 5], [1, 2, 5]]
    assert shares(w, (2, 3)).tolist() == [[1 / 8, 2 / 8, 5 / 8]] * 2
    assert shares(None, (4,)).tolist() == [0.25] * 4
    assert weights_of_mean_one(w, (3,)) == pytest.approx(w / (8 / 3))
    assert weights_of_mean_one(None, (3,)).tolist() == [1.0, 1.0, 1.0]


def test_soft_programs_are_solved_as_scipy_solves_them():
    """Penalties of random programs, by slack variables in SciPy's SLSQP."""
    rng = np.random.default_rng(4)
    n, m, count = 3, 4, 5
    root = rng.normal(size=(count, n, n))
    hessian = root @ np.swapaxes(root, -1, -2) + 0.3 * np.eye(n)
    gradient, value = rng.normal(size=(count, n)), rng.normal(size=(count, m))
    jacobian, high = rng.normal(size=(count, m, n)), np.full((count, m), 2.0)
    equal = np.array([True, False, False, False])
    low = np.where(equal, -high, 0.0)
    steps, multipliers = SoftProgram(hessian, gradient, value, jacobian, low, high).solved()

    def objective(s, k):
        w = value[k] + jacobian[k] @ s
        penalty = np.where(equal, np.abs(w), np.maximum(w, 0.0)).sum()
        return s @ hessian[k] @ s / 2 + gradient[k] @ s + 2.0 * penalty

    for k in range(count):
        start = np.concatenate([np.zeros(n), np.full(m + 1, 10.0)])  # s, slacks, one more for |w|

        def smooth(v, k=k):
            s = v[:n]
            return s @ hessian[k] @ s / 2 + gradient[k] @ s + 2.0 * v[n:].sum()

        def room(v, k=k):
            w = value[k] + jacobian[k] @ v[:n]
            return np.concatenate([v[n : n + m] - w, v[n:], [v[-1] + w[0]]])

        other = minimize(
            smooth,
            start,
            method="SLSQP",
            constraints={"type": "ineq", "fun": room},
            options={"ftol": 1e-14, "maxiter": 1000},
        )
        assert objective(steps[k], k) <= objective(other.x[:n], k) + 1e-7
        assert steps[k] == pytest.approx(other.x[:n], abs=1e-4)
        pull = hessian[k] @ steps[k] + gradient[k] + jacobian[k].T @ multipliers[k]
        assert np.abs(pull).max() < 1e-9
        assert (multipliers[k] <= high[k]).all()
        assert (multipliers[k] >= low[k]).all()


def test_soft_programs_are_solved_from_others_like_them_and_with_dependent_constraints():
    """The conditions that hold at the least value, of programs each constraint given twice."""
    rng = np.random.default_rng(11)
    n, m, count = 6, 5, 40
    root = rng.normal(size=(count, n, n))
    hessian = root @ np.swapaxes(root, -1, -2) + 0.1 * np.eye(n)
    gradient, value = rng.normal(size=(count, n)), rng.normal(size=(count, m))
    jacobian, high = rng.normal(size=(count, m, n)), np.full((count, m), 3.0)
    value, jacobian = np.tile(value, (1, 2)), np.tile(jacobian, (1, 2, 1))
    high = np.tile(high, (1, 2))
    low = np.where(np.arange(2 * m) % m < 2, -high, 0.0)
    program = SoftProgram(hessian, gradient, value, jacobian, low, high)
    first, others = program.solved()
    for start in (None, low, others, others + 0.3 * rng.normal(size=high.shape)):
        step, multipliers = program.solved(start)
        assert np.abs(step - first).max() < 1e-6
        pull = matvec(hessian, step) + gradient + matvec(np.swapaxes(jacobian, -1, -2), multipliers)
        assert np.abs(pull).max() < 1e-8
        off = value + matvec(jacobian, step)
        assert (off[multipliers < high - 1e-9] < 1e-6).all()
        assert (off[multipliers > low + 1e-9] > -1e-6).all()
