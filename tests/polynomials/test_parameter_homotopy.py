"""Paths from solved systems of every shape: counts known otherwise, and nothing is missing."""

from math import comb

import numpy as np
import pytest

from burmester.polynomials.bilinear_fit import circle_shape, equations, jacobian
from burmester.polynomials.parameter_homotopy import (
    ARRIVED,
    LOST,
    follow,
    generic_solutions,
    tracked_points,
)
from tests.oracles.bilinear_systems import (
    SHAPES,
    draw,
    gradient,
    hessian,
    one,
    stacked,
    with_twins,
)
from tests.samples import some_of


def followed(shape, p):
    """All solutions (k, size) of a system; where one is lost on the way, another way."""
    start, points = generic_solutions(shape.name)
    ends, state = follow(shape, points, one(start), one(p))
    if (state != ARRIVED).any():
        middle = draw(shape, np.random.default_rng(0), real=False)
        ends, _ = follow(shape, points, one(start), one(middle))
        ends, state = follow(shape, ends, one(middle), one(p))
    assert (state == ARRIVED).all()
    return ends


# What is known without following a path.  A function on a curve of genus g that has d poles, with
# their orders, e of them different, has 2 g - 2 + d + e stationary points (Riemann and Hurwitz).
KNOWN = {
    "circle-22-0-none": 33 - 8,  # Bezout's number of multihomogeneous systems, less 8 at infinity
    "circle-21-0-none": 9,  # u is eliminated: N'D - ND' with degrees 6 and 4
    "circle-12-0-none": 9,
    "circle-11-0-none": 5,  # likewise, with degrees 4 and 2
    "circle-22-3-none": 8 + 4,  # a curve of degree 4 and genus 1: 4 poles of order 2
    "circle-22-4-none": 4,  # two conics
    "circle-12-2-none": -2 + 6 + 3,  # a rational curve of degree 3: 3 poles of order 2
    "circle-21-2-none": -2 + 6 + 3,
    "circle-12-3-none": comb(3, 1),  # three bilinear equations
    "circle-21-3-none": comb(3, 1),
    "circle-11-1-none": -2 + 4 + 2,  # a conic
    "circle-11-2-none": comb(2, 1),
    "circle-11-1-hard": 4,  # a conic and u² + v²: degree 4
    "circle-02-1-hard": 2,  # a line and a circle
    "circle-20-1-hard": 2,
    "circle-02-0-hard": 4,  # a quadratic function on a circle
    "circle-20-0-hard": 4,
    "circle-01-0-soft": 3,  # a quartic's derivative
    "circle-10-0-soft": 3,
    "circle-02-0-soft": 5,  # the secular equation
    "circle-20-0-soft": 5,
    "circle-01-0-hard": 2,
    "circle-10-0-hard": 2,
    **{f"circle-{ij}-{k}-none": 1 for ij in ("01", "10") for k in (0, 1)},
    **{f"circle-{ij}-{k}-none": 1 for ij in ("02", "20") for k in (0, 1, 2)},
    "line-0-0": 2,  # axes of a conic
    "line-0-1": 1,
    "line-1-0": -2 + 4 + 4,  # a rational function of degree 4 on the line of the normals
    "line-1-1": -2 + 4 + 3,  # likewise, with one pole of order 2
    "line-1-2": 2,
    "line-2-0": 2,  # n·v and n x v are free: axes of a conic
    "line-2-1": 2,
    "line-2-2": 2,
    "line-2-3": 1,
}


@pytest.mark.parametrize(("name", "count"), KNOWN.items())
def test_there_are_as_many_start_points_as_is_known_otherwise(name, count):
    assert len(generic_solutions(name)[1]) == count


def test_dyads_read_either_way_have_the_same_number_of_start_points():
    for shape in SHAPES:
        if shape.name.startswith("circle"):
            kind, size, *rest = shape.name.split("-")
            assert len(generic_solutions(shape.name)[1]) == len(
                generic_solutions("-".join([kind, size[::-1], *rest]))[1]
            )


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_equations_are_the_derivatives_of_the_lagrangian(shape):
    rng = np.random.default_rng(1)
    p = draw(shape, rng, real=False)
    x = rng.normal(size=(5, shape.size)) + 1j * rng.normal(size=(5, shape.size))
    assert np.allclose(equations(shape, x, p), gradient(shape, x, p), rtol=1e-11, atol=1e-11)
    assert np.allclose(jacobian(shape, x, p), hessian(shape, x, p), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_start_points_solve_their_system_and_differ(shape):
    p, points = generic_solutions(shape.name)
    size = 1 + np.abs(points).max(axis=1)
    assert np.abs(gradient(shape, points, p)).max() < 1e-9 * size.max() ** 3
    # Newton's step from each: a point that were none would move.
    step = np.linalg.solve(hessian(shape, points, p), gradient(shape, points, p)[..., None])
    assert (np.abs(step[..., 0]).max(axis=1) < 1e-8 * size).all()
    twins = with_twins(shape, points)
    gap = np.abs(twins[:, None] - twins).max(axis=-1) + np.eye(len(twins))
    assert gap.min() > 1e-5


@pytest.mark.parametrize("shape", some_of(SHAPES, 16), ids=lambda shape: shape.name)
def test_newton_from_anywhere_finds_no_other_solution(shape):
    """Complex solutions of a task's real system, from 200 starts."""
    rng = np.random.default_rng(2)
    p = draw(shape, rng)
    ends = followed(shape, p)
    x = rng.normal(size=(200, shape.size)) + 1j * rng.normal(size=(200, shape.size))
    for _ in range(40):
        with np.errstate(all="ignore"):
            slope, value = hessian(shape, x, p), gradient(shape, x, p)
        sound = np.isfinite(slope).all(axis=(1, 2)) & (np.abs(x).max(axis=1) < 1e5)
        x, slope, value = x[sound], slope[sound], value[sound]
        step = np.linalg.solve(slope, value[..., None])[..., 0]
        x = x - step
    x = x[np.abs(step).max(axis=1) < 1e-10 * (1 + np.abs(x).max(axis=1))]
    assert len(x) > 20
    ends = with_twins(shape, ends)
    gap = np.abs(x[:, None] - ends).max(axis=-1).min(axis=1)
    assert (gap < 1e-6 * (1 + np.abs(x).max(axis=1))).all()


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_random_parameters_lose_no_path(shape):
    rng = np.random.default_rng(3)
    _, state = tracked_points(shape, stacked([draw(shape, rng) for _ in range(5)]))
    assert (state == ARRIVED).all()


def test_paths_that_pass_too_near_to_infinity_go_another_way():
    shape, rng = circle_shape(2, 2, 0, "soft"), np.random.default_rng(0)
    systems = [draw(shape, rng) for _ in range(32)][-2:]
    start, points = generic_solutions(shape.name)
    for p in systems:
        _, state = follow(shape, points, one(start), one(p))
        assert (state == LOST).sum() == 1  # lost on the straight way
        _, state = tracked_points(shape, one(p))
        assert (state == ARRIVED).all()
