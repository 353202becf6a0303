"""All stationary points of every shape of system: those that paths find, other people's roots."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import unique_rows
from burmester.polynomials import stationary_points as module
from burmester.polynomials.bilinear_fit import Parameters, circle_shape
from burmester.polynomials.elimination import finite_count
from burmester.polynomials.parameter_homotopy import ARRIVED, LOST, tracked_points
from burmester.polynomials.stationary_points import stationary_points
from tests.oracles.bilinear_systems import (
    SHAPES,
    draw,
    gradient,
    hessian,
    of_poses,
    one,
    stacked,
    with_twins,
)
from tests.oracles.witness import random_four_bar, random_poses
from tests.samples import some_of


def tracked(shape, p):
    """All finite solutions (k, size) of a system, by paths."""
    ends, state = tracked_points(shape, one(p))
    assert not (state == LOST).any()
    return unique_rows(ends[state == ARRIVED], 1e-6, "maximum")


@pytest.fixture
def no_paths(monkeypatch):
    """Paths are not allowed."""

    def refused(*_):
        raise AssertionError("paths were followed")

    monkeypatch.setattr(module, "tracked_points", refused)


def require_the_points_of_paths(shape, p, found):
    """Paths share the equations with the eigenproblem, and nothing else."""
    ends = tracked(shape, p)
    assert found.finite == len(ends)
    real = (np.abs(ends.imag) < 1e-7 * (1 + np.abs(ends).max(axis=1))[:, None]).all(axis=1)
    assert len(found.points) == real.sum()
    for points, among in (
        (found.points, ends[real].real),
        (found.complex_parts, ends[~real].real),
    ):
        twins = with_twins(shape, among)[:, : shape.unknowns]
        gap = np.abs(points[:, None] - twins).max(axis=-1).min(axis=1, initial=np.inf)
        assert (gap < 1e-6 * (1 + np.abs(points).max(axis=1, initial=0))).all()


@pytest.mark.parametrize("shape", some_of(SHAPES, 16), ids=lambda shape: shape.name)
def test_the_points_are_those_that_paths_find(shape):
    rng = np.random.default_rng(7)
    systems = [of_poses(shape, rng) for _ in range(2)]
    for p, found in zip(systems, stationary_points(shape, stacked(systems)), strict=True):
        require_the_points_of_paths(shape, p, found)
        assert finite_count(shape) in (0, found.finite)


@pytest.mark.parametrize("shape", [circle_shape(1, 1, 0, "soft"), circle_shape(2, 1, 0, "none")])
@pytest.mark.parametrize("turn", [1.0, 0.1])
def test_so_they_are_for_poses_in_a_mirror_and_for_little_turn(shape, turn):
    t = np.linspace(-1, 1, 9)
    rows = np.column_stack([t - t**3 / 3, t**2 / 2, turn * t])
    p = of_poses(shape, np.random.default_rng(8), rows=rows)
    require_the_points_of_paths(shape, p, stationary_points(shape, one(p))[0])


@pytest.mark.parametrize("shape", [*filter(finite_count, SHAPES)], ids=lambda shape: shape.name)
@pytest.mark.parametrize("count", [6, 12])
def test_random_poses_need_no_paths(shape, count, no_paths):
    rng = np.random.default_rng(3)
    systems = stacked([of_poses(shape, rng, count=count) for _ in range(20)])
    for found in stationary_points(shape, systems):
        assert (found.finite, found.away, found.lost) == (finite_count(shape), 0, 0)


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


@pytest.mark.parametrize("shape", some_of(SHAPES, 16), ids=lambda shape: shape.name)
def test_minima_are_those_of_the_lagrangian_where_the_conditions_hold(shape):
    rng, n = np.random.default_rng(6), shape.unknowns
    for _ in range(4):
        p = of_poses(shape, rng)
        found = stationary_points(shape, one(p))[0]
        ends = with_twins(shape, tracked(shape, p))
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
