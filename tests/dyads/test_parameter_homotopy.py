"""All stationary points of every shape of system: counts known otherwise, other people's roots.

The witness is the Lagrangian itself, written out.  It is quadratic along every axis, so that
differences with a step of one are its derivatives, exactly.
"""

from math import comb

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from burmester.dyads.parameter_homotopy import (
    Parameters,
    circle_shape,
    equations,
    follow,
    generic_solutions,
    jacobian,
    line_shape,
    stationary_points,
)
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR
from burmester.geometry.displacement import Displacement
from tests.oracles.witness import random_four_bar, random_poses

pytestmark = pytest.mark.slow

SHAPES = [
    circle_shape(i, j, k, kind)
    for i in range(3)
    for j in range(3)
    for kind, most in (("none", i + j + 1), ("soft", 1), ("hard", i + j))
    for k in range(most)
    if i + j
]
SHAPES += [line_shape(j, k) for j in range(3) for k in range(j + 2)]


def lagrangian(shape, x, p):
    """The Lagrangian (*,) at x (*, size), of one system p."""
    kind, size, *_ = shape.name.split("-")
    k, n = shape.conditions, shape.unknowns
    if kind == "circle":
        i, j = int(size[0]), int(size[1])
        u, v = x[..., :i], x[..., i : i + j]
        if i == j == 2:
            (a, b), (c, d) = np.moveaxis(u, -1, 0), np.moveaxis(v, -1, 0)
            products = [a * c + b * d, b * c - a * d]
        else:
            products = [u[..., s] * v[..., t] for s in range(i) for t in range(j)]
        parts = [np.ones_like(x[..., 0]), *np.moveaxis(x[..., :n], -1, 0), *products]
        square = (x[..., :n] ** 2).sum(axis=-1)
    else:
        normal, v = x[..., :2], x[..., 2:n]
        (a, b) = np.moveaxis(normal, -1, 0)
        if n == 4:
            c, d = v[..., 0], v[..., 1]
            products = [a * c + b * d, b * c - a * d]
        else:
            products = [a * v[..., 0], b * v[..., 0]] if n == 3 else []
        parts = [a, b, *products]
        square = a * a + b * b
    w = np.stack(parts, axis=-1)
    value = np.einsum("...i,ij,...j->...", w, p.gram, w) / 2
    value = value + np.einsum("...k,ki,...i->...", x[..., n : n + k], p.rows, w)
    if shape.quadratic != "none":
        t = x[..., -1]
        value = value + t * (square + w @ p.linear - p.square)
        if shape.quadratic == "soft":
            value = value - t * t / 2
    return value


def gradient(shape, x, p):
    """Its derivatives (*, size)."""
    step = np.eye(shape.size)
    at = x[..., None, :]
    return (lagrangian(shape, at + step, p) - lagrangian(shape, at - step, p)) / 2


def hessian(shape, x, p):
    """Its second derivatives (*, size, size)."""
    step = np.eye(shape.size)
    at = x[..., None, :]
    return (gradient(shape, at + step, p) - gradient(shape, at - step, p)) / 2


def draw(shape, rng, *, real=True):
    """Random parameters of a shape, those of a task (real, G of squares) or any complex ones."""
    f, k = len(shape.constant), shape.conditions

    def normal(*size):
        return rng.normal(size=size) + (0 if real else 1j * rng.normal(size=size))

    gram = normal(f + 2, f)
    linear = 0 * normal(f) if shape.name.startswith("line") else normal(f)
    square = np.array(4 * rng.uniform(0.5, 1)) if real else normal()
    return Parameters(gram.T @ gram, normal(k, f), linear, square)


def one(p):
    return Parameters(*(np.asarray(part)[None] for part in p))


def followed(shape, p):
    """All solutions (k, size) of a system; where one is lost on the way, another way."""
    start, points = generic_solutions(shape.name)
    ends, state = follow(shape, points, one(start), one(p))
    if (state != 1).any():
        middle = draw(shape, np.random.default_rng(0), real=False)
        ends, _ = follow(shape, points, one(start), one(middle))
        ends, state = follow(shape, ends, one(middle), one(p))
    assert (state == 1).all()
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
    twins = points
    if shape.name.startswith("line"):
        mirror = np.ones(shape.size)
        mirror[:2] = mirror[shape.unknowns : -1] = -1
        twins = np.concatenate([points, points * mirror])
    gap = np.abs(twins[:, None] - twins).max(axis=-1) + np.eye(len(twins))
    assert gap.min() > 1e-5


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
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
    if shape.name.startswith("line"):
        mirror = np.ones(shape.size)
        mirror[:2] = mirror[shape.unknowns : -1] = -1
        ends = np.concatenate([ends, ends * mirror])
    gap = np.abs(x[:, None] - ends).max(axis=-1).min(axis=1)
    assert (gap < 1e-6 * (1 + np.abs(x).max(axis=1))).all()


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_random_parameters_lose_no_path(shape):
    rng = np.random.default_rng(3)
    systems = [draw(shape, rng) for _ in range(5)]
    stacked = Parameters(*(np.stack(part) for part in zip(*systems, strict=True)))
    count = len(generic_solutions(shape.name)[1])
    for found in stationary_points(shape, stacked):
        assert (found.finite, found.away, found.lost) == (count, 0, 0)


def real_roots(polynomial):
    roots = polynomial.roots()
    return np.sort(roots.real[np.abs(roots.imag) < 1e-7 * (1 + np.abs(roots))])


def determinant(rows):
    """Of a matrix of polynomials."""
    if len(rows) == 1:
        return rows[0][0]
    return sum(
        (-1) ** i * row[0] * determinant([other[1:] for k, other in enumerate(rows) if k != i])
        for i, row in enumerate(rows)
    )


@pytest.mark.parametrize(("fixed", "moving"), [(1, 1), (2, 1), (1, 2)])
def test_real_points_are_the_roots_of_one_polynomial(fixed, moving):
    """The two or one coordinates of one pivot are eliminated: least squares for a given other."""
    shape = circle_shape(fixed, moving, 0, "none")
    rng, seen = np.random.default_rng(4), set()
    for _ in range(20):
        p = draw(shape, rng)
        # Features 1, u, v, then u v by rows of u; t is the pivot kept, s the one eliminated.
        n = 2 if moving == 2 or fixed == 2 else 1
        t_at = 1 if moving == 2 else 1 + fixed
        s_at = [1 + fixed + a for a in range(n)] if moving == 2 else [1 + a for a in range(n)]
        constant = np.zeros((1 + n, len(p.gram), 2))  # coefficients of 1 and t
        constant[0, 0, 0] = constant[0, t_at, 1] = 1.0
        for a, at in enumerate(s_at):
            constant[1 + a, at, 0] = 1.0
            constant[1 + a, 1 + fixed + moving + a, 1] = 1.0
        forms = np.einsum("aip,ij,bjq->abpq", constant, p.gram, constant)
        entry = [[Polynomial([f[0, 0], f[0, 1] + f[1, 0], f[1, 1]]) for f in row] for row in forms]
        top, bottom = determinant(entry), determinant([row[1:] for row in entry[1:]])
        wanted = top.deriv() * bottom - top * bottom.deriv()
        roots = real_roots(wanted.trim(1e-12 * np.abs(wanted.coef).max()))
        got = np.sort(stationary_points(shape, one(p))[0].points[:, t_at - 1])
        assert len(got) == len(roots)
        assert np.allclose(got, roots, rtol=1e-5, atol=1e-6)
        seen.add(len(roots))
    assert len(seen) > 1


@pytest.mark.parametrize("name", ["10", "01"])
def test_a_soft_length_on_a_line_is_a_cubic(name):
    shape = circle_shape(int(name[0]), int(name[1]), 0, "soft")
    rng = np.random.default_rng(5)
    for _ in range(10):
        p = draw(shape, rng)
        p = p._replace(square=p.square * 4)
        g, (l0, l1) = p.gram, p.linear
        gap = Polynomial([l0 - p.square, l1, 1.0])
        total = Polynomial([g[0, 0], 2 * g[0, 1], g[1, 1]]) / 2 + gap * gap / 2
        found = stationary_points(shape, one(p))[0]
        at = np.argsort(found.points[:, 0])
        roots = real_roots(total.deriv())
        assert np.allclose(found.points[at, 0], roots, rtol=1e-7, atol=1e-7)
        assert (found.minimum[at] == (total.deriv(2)(roots) > 0)).all()


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_minima_are_those_of_the_lagrangian_where_the_conditions_hold(shape):
    rng, n = np.random.default_rng(6), shape.unknowns
    for _ in range(4):
        p = draw(shape, rng)
        found = stationary_points(shape, one(p))[0]
        ends = followed(shape, p)
        for x, minimum in zip(found.points, found.minimum, strict=True):
            full = ends[np.abs(ends[:, :n] - x).max(axis=1).argmin()].real
            assert np.abs(gradient(shape, full, p)).max() < 1e-6 * (1 + np.abs(full).max()) ** 3
            whole = hessian(shape, full, p)
            if shape.quadratic == "soft":
                whole = whole[:n, :n] + np.outer(whole[:n, n], whole[:n, n])
                free = np.eye(n)
            else:
                _, values, v = np.linalg.svd(whole[:n, n:].T)
                free = v[len(values) :].T if whole[:n, n:].size else np.eye(n)
            curvature = np.linalg.eigvalsh(free.T @ whole[:n, :n] @ free)
            assert minimum == (curvature > 0).all()


@pytest.mark.parametrize("count", [6, 8, 10])
def test_a_slider_that_fits_exactly_is_three_paths_to_infinity(count):
    """As `critical` counts them, which follows no paths."""
    rng = np.random.default_rng(count)
    rows = random_poses(random_four_bar(rng, PR), rng, count)
    _, seen = CanonicalFrames.of(Displacement.from_poses(rows))
    (x, y), c, s = seen.translation.T, np.cos(seen.angle), np.sin(seen.angle)
    residual = np.stack(
        [x * x + y * y, -2 * x, -2 * y, 2 * (c * x + s * y), 2 * (c * y - s * x), -2 * c, -2 * s],
        axis=-1,
    )
    residual = (residual - residual.mean(axis=0)) / np.sqrt(count)
    p = Parameters(residual.T @ residual, np.empty((0, 7)), np.zeros(7), np.zeros(()))
    found = stationary_points(circle_shape(2, 2, 0, "none"), one(p))[0]
    assert (found.finite, found.away, found.lost) == (22, 3, 0)


def test_paths_that_pass_too_near_to_infinity_go_another_way():
    shape, rng = circle_shape(2, 2, 0, "soft"), np.random.default_rng(0)
    systems = [draw(shape, rng) for _ in range(32)][-2:]
    start, points = generic_solutions(shape.name)
    for p in systems:
        _, state = follow(shape, points, one(start), one(p))
        assert (state == 0).sum() == 1  # lost on the straight way
        found = stationary_points(shape, one(p))[0]
        assert (found.finite, found.away, found.lost) == (33, 0, 0)
