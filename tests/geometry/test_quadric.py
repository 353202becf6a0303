"""General quadrics: their kinds against exact arithmetic, and the fit against known surfaces."""

from __future__ import annotations

import functools
import itertools

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry import constraint_manifold, quadric
from burmester.geometry.displacement import Displacement
from burmester.geometry.quadric import QuadricKind as Kind
from burmester.geometry.quadric import classify, fit_quadric
from burmester.io import cases

DIAGONAL = {
    Kind.ELLIPSOID: (1, 1, 1, -1),
    Kind.IMAGINARY_ELLIPSOID: (1, 1, 1, 1),
    Kind.ONE_SHEET: (1, 1, -1, -1),
    Kind.TWO_SHEETS: (1, 1, -1, 1),
    Kind.CONE: (1, 1, -1, 0),
    Kind.IMAGINARY_CONE: (1, 1, 1, 0),
    Kind.ELLIPTIC_CYLINDER: (1, 1, 0, -1),
    Kind.IMAGINARY_CYLINDER: (1, 1, 0, 1),
    Kind.HYPERBOLIC_CYLINDER: (1, -1, 0, 1),
    Kind.INTERSECTING_PLANES: (1, -1, 0, 0),
    Kind.IMAGINARY_INTERSECTING_PLANES: (1, 1, 0, 0),
    Kind.PARALLEL_PLANES: (1, 0, 0, -1),
    Kind.IMAGINARY_PARALLEL_PLANES: (1, 0, 0, 1),
    Kind.DOUBLED_PLANE: (1, 0, 0, 0),
    Kind.DOUBLED_INFINITY: (0, 0, 0, 1),
    Kind.WHOLE_SPACE: (0, 0, 0, 0),
}
WITH_2Z = {  # Z3 Z4 + Z4 Z3 on top of the diagonal
    Kind.ELLIPTIC_PARABOLOID: (1, 1, 0, 0),
    Kind.HYPERBOLIC_PARABOLOID: (1, -1, 0, 0),
    Kind.PARABOLIC_CYLINDER: (1, 0, 0, 0),
    Kind.ONE_PLANE: (0, 0, 0, 0),
}


def canonical(kind: Kind) -> np.ndarray:
    if kind in DIAGONAL:
        return np.diag(np.array(DIAGONAL[kind], dtype=float))
    c = np.diag(np.array(WITH_2Z[kind], dtype=float))
    c[2, 3] = c[3, 2] = 1.0
    return c


def affine_maps(rng: np.random.Generator, count: int) -> np.ndarray:
    """Maps of the chart with singular values of the linear part between 1/2 and 2."""
    maps = np.zeros((count, 4, 4))
    left, right = (np.linalg.qr(rng.normal(size=(count, 3, 3)))[0] for _ in range(2))
    stretch = 2 ** rng.uniform(-1, 1, (count, 1, 3))
    maps[:, :3, :3] = (left * stretch) @ right
    maps[:, :3, 3] = rng.normal(size=(count, 3))
    maps[:, 3, 3] = 1.0
    return maps


def congruent(c: np.ndarray, by: np.ndarray) -> np.ndarray:
    return np.swapaxes(by, -1, -2) @ c @ by


def in_unit(c: np.ndarray, unit: np.ndarray) -> np.ndarray:
    """The same quadrics when lengths (Z1, Z2) are measured in another unit."""
    ones = np.ones_like(unit)
    return c * np.einsum("...i,...j->...ij", *2 * [np.stack([unit, unit, ones, ones], -1)])


def random_unit_points(rng: np.random.Generator, *shape: int) -> np.ndarray:
    poses = Displacement(rng.normal(size=(*shape, 2)), rng.uniform(-np.pi, np.pi, shape))
    return poses.as_image_point()


def same_up_to_scale(a: np.ndarray, b: np.ndarray, tolerance: float) -> bool:
    a, b = a.ravel() / np.linalg.norm(a), b.ravel() / np.linalg.norm(b)
    return bool(min(np.abs(a - b).max(), np.abs(a + b).max()) < tolerance)


# Kinds


def test_every_kind_has_a_canonical_equation():
    assert {*DIAGONAL, *WITH_2Z} == set(Kind)


@pytest.mark.parametrize("kind", Kind)
def test_an_affine_map_a_factor_and_a_unit_keep_the_kind(kind):
    rng = np.random.default_rng(11)
    moved = congruent(canonical(kind), affine_maps(rng, 200))
    factor = rng.choice([-1, 1], 200) * 10 ** rng.uniform(-200, 200, 200)
    unit = 10 ** rng.uniform(-6, 6, 200)
    assert (classify(canonical(kind)) == kind).all()
    assert (classify(moved) == kind).all()
    assert (classify(factor[:, None, None] * in_unit(moved, unit)) == kind).all()
    for edge in (1e-6, 1e6):
        assert (classify(in_unit(moved, np.full(200, edge))) == kind).all()


def integer_matrices(rng: np.random.Generator, total: int) -> list[list[list[int]]]:
    """Symmetric, with small integers; half of them sums of a few squares, some of those flat."""
    matrices = []
    for k in range(total):
        if k % 2:
            upper = np.triu(rng.integers(-3, 4, (4, 4)))
            c = upper + np.triu(upper, 1).T
        else:
            count = rng.integers(0, 6)
            forms = rng.integers(-2, 3, (count, 4))
            forms[:, :3] *= rng.integers(0, 2, (count, 1))
            signs = rng.choice([-1, 1], count) if k % 4 else np.ones(count, dtype=int)
            c = (forms.T * signs) @ forms
        if k % 5 == 0:
            c[:3, :3] = 0
        if k % 7 == 0:
            c[2, :2] = c[:2, 2] = c[2, 2] = 0
        matrices.append([[int(x) for x in row] for row in c])
    return matrices


def characteristic_polynomial(c: list[list[int]]) -> list[int]:
    """det(x I - C) in exact integers, highest power first, by Faddeev and LeVerrier."""
    n = len(c)
    polynomial, m = [1], [[0] * n for _ in range(n)]
    for k in range(1, n + 1):
        m = [
            [sum(c[i][a] * m[a][j] for a in range(n)) + polynomial[-1] * (i == j) for j in range(n)]
            for i in range(n)
        ]
        trace = sum(c[i][a] * m[a][i] for i in range(n) for a in range(n))
        assert trace % k == 0
        polynomial.append(-trace // k)
    return polynomial


def exact_inertia(c: list[list[int]]) -> tuple[int, int]:
    """Positive and negative eigenvalues by Descartes' rule: exact where all roots are real."""

    def changes(coefficients: list[int]) -> int:
        signs = [x > 0 for x in coefficients if x]
        return sum(a != b for a, b in itertools.pairwise(signs))

    polynomial = characteristic_polynomial(c)
    return changes(polynomial), changes([x * (-1) ** k for k, x in enumerate(polynomial)])


def textbook_kind(c: list[list[int]]) -> Kind:  # noqa: PLR0911, PLR0912
    """The textbook's way: ranks, the sign of the determinant, and which signs agree.

    Zwillinger, CRC Standard Mathematical Tables, "Quadrics", and the three kinds that it
    leaves out, whose second-degree terms vanish.
    """
    p, n = exact_inertia([row[:3] for row in c[:3]])
    whole_p, whole_n = exact_inertia(c)
    definite, whole_definite = not (p and n), not (whole_p and whole_n)
    positive_determinant = whole_n % 2 == 0
    match p + n, whole_p + whole_n:
        case 3, 4 if definite:
            return Kind.IMAGINARY_ELLIPSOID if positive_determinant else Kind.ELLIPSOID
        case 3, 4:
            return Kind.ONE_SHEET if positive_determinant else Kind.TWO_SHEETS
        case 3, 3:
            return Kind.IMAGINARY_CONE if definite else Kind.CONE
        case 2, 4:
            return Kind.HYPERBOLIC_PARABOLOID if positive_determinant else Kind.ELLIPTIC_PARABOLOID
        case 2, 3 if definite:
            return Kind.IMAGINARY_CYLINDER if whole_definite else Kind.ELLIPTIC_CYLINDER
        case 2, 3:
            return Kind.HYPERBOLIC_CYLINDER
        case 2, 2:
            return Kind.IMAGINARY_INTERSECTING_PLANES if definite else Kind.INTERSECTING_PLANES
        case 1, 3:
            return Kind.PARABOLIC_CYLINDER
        case 1, 2:
            return Kind.IMAGINARY_PARALLEL_PLANES if whole_definite else Kind.PARALLEL_PLANES
        case 1, 1:
            return Kind.DOUBLED_PLANE
        case 0, 2:
            return Kind.ONE_PLANE
        case 0, 1:
            return Kind.DOUBLED_INFINITY
        case 0, 0:
            return Kind.WHOLE_SPACE
    raise AssertionError(c)


def test_the_kind_agrees_with_exact_arithmetic():
    matrices = integer_matrices(np.random.default_rng(2012), 4000)
    exact = [textbook_kind(c) for c in matrices]
    assert set(exact) == set(Kind), "the sample misses a kind"
    found = classify(np.array(matrices, dtype=float))
    wrong = [(c, str(f), e) for c, f, e in zip(matrices, found, exact, strict=True) if f != e]
    assert wrong == []


@pytest.mark.parametrize("unit", [1e-6, 1e-3, 1.0, 25.4, 1e6])
def test_constraint_manifolds_have_the_kinds_of_their_dyads(unit):
    rng = np.random.default_rng(4)
    fixed, moving = unit * rng.normal(size=(2, 300, 2))
    radius, angle = unit * rng.uniform(0.1, 10, 300), rng.uniform(-np.pi, np.pi, 300)
    rr = constraint_manifold.coefficients_of_circle(fixed, moving, radius)
    assert (classify(constraint_manifold.matrix(rr)) == Kind.ONE_SHEET).all()  # Eq. (10)
    # A circle without a radius: a rotation about one point, a line of the image space.
    point = constraint_manifold.coefficients_of_circle(fixed, moving, np.zeros(300))
    assert (classify(constraint_manifold.matrix(point)) == Kind.IMAGINARY_INTERSECTING_PLANES).all()
    # p1 = 0: no term of the second degree in (Z1, Z2), and the cross terms are a rotation.
    pr = constraint_manifold.coefficients_of_fixed_line(angle, fixed[:, 0], moving)
    rp = constraint_manifold.coefficients_of_moving_line(fixed, angle, moving[:, 0])
    assert (classify(constraint_manifold.matrix(pr)) == Kind.HYPERBOLIC_PARABOLOID).all()
    assert (classify(constraint_manifold.matrix(rp)) == Kind.HYPERBOLIC_PARABOLOID).all()
    pp = constraint_manifold.coefficients_of_rotation(angle)
    assert (classify(constraint_manifold.matrix(pp)) == Kind.DOUBLED_PLANE).all()
    half_turn = constraint_manifold.matrix(constraint_manifold.coefficients_of_rotation(np.pi))
    assert classify(half_turn) == Kind.DOUBLED_INFINITY


@pytest.mark.parametrize(
    ("case", "table"),
    [
        ("ge2012-exact", "singular_vectors_table4"),
        ("ge2012-approximate", "singular_vectors_table7"),
    ],
)
def test_eigen_quadrics_of_the_paper(case, table):
    v1_and_v2 = constraint_manifold.matrix(cases.load(case)["printed"][table])
    assert classify(v1_and_v2).tolist() == [Kind.ELLIPSOID, Kind.TWO_SHEETS]  # Figs. 3 and 7


def test_constraint_manifolds_of_the_paper():
    matrices = [
        cases.load(f"ge2012-{c}")["printed"][k]
        for c in ("exact", "approximate")
        for k in ("C1", "C2")
    ]
    assert (classify(matrices) == Kind.ONE_SHEET).all()


def test_the_tolerance_says_what_is_on_the_border():
    nearly = np.diag([1, 1, 1e-4, -1.0])
    assert classify(nearly) == Kind.ELLIPSOID
    assert classify(nearly, tolerance=1e-3) == Kind.ELLIPTIC_CYLINDER


def test_a_length_decides_what_is_small():
    nearly_slider = np.array([[1e-8, 0, 1, 0], [0, 1e-8, 0, 1], [1, 0, 1, 0], [0, 1, 0, 1]])
    assert classify(nearly_slider, tolerance=1e-6) == Kind.ONE_SHEET
    assert classify(nearly_slider, tolerance=1e-6, length=1.0) == Kind.HYPERBOLIC_PARABOLOID
    batch = classify([nearly_slider] * 2, tolerance=1e-6, length=[1e6, 1.0])
    assert batch.tolist() == [Kind.ONE_SHEET, Kind.HYPERBOLIC_PARABOLOID]


@pytest.mark.parametrize("zero", [(0, 0), (0, 1), (1, 1)])
def test_a_unit_is_found_where_a_block_vanishes(zero):
    """Lengths squared, to the power of 1 or of 0: two of the three are enough."""
    blocks = np.random.default_rng(12).integers(-3, 4, (2, 2, 2, 2))
    blocks[zero] = blocks[zero[::-1]] = 0
    c = np.block([[blocks[0, 0], blocks[0, 1]], [blocks[0, 1].T, blocks[1, 1]]])
    c = c + c.T
    kind = textbook_kind(c.tolist())
    for unit in 10.0 ** np.arange(-9, 10):
        assert classify(in_unit(c, unit)) == kind


def test_an_eigenvalue_on_the_threshold_still_has_a_kind():
    """A double eigenvalue of the block is one of the whole; rounding parts the two."""
    rng = np.random.default_rng(10)
    for turn in np.linalg.qr(rng.normal(size=(500, 3, 3)))[0]:
        c = rng.normal(size=(4, 4))
        c[:3, :3] = turn * [0.3, 0.3, -1] @ turn.T
        c[3, :3] = c[:3, 3]
        share = 0.3 / np.abs(np.linalg.eigvalsh(c)).max()
        assert classify(c, tolerance=share, length=1.0).item() in list(Kind)


def test_only_the_symmetric_part_counts():
    rng = np.random.default_rng(8)
    skew = np.triu(rng.normal(size=(4, 4)), 1)
    for kind in Kind:
        assert classify(canonical(kind) + skew - skew.T) == kind or kind == Kind.WHOLE_SPACE


# Coefficients


def test_the_monomials_stand_in_the_order_of_the_paper():
    assert quadric.monomials([2, 3, 5, 7]).tolist() == [4, 9, 25, 6, 10, 15, 14, 21, 35, 49]


def test_the_matrix_is_the_form_of_the_coefficients():
    rng = np.random.default_rng(5)
    q, z = rng.normal(size=(50, 10)), rng.normal(size=(50, 4))
    form = np.einsum("ki,kij,kj->k", z, quadric.matrix(q), z)
    np.testing.assert_allclose(form, (q * quadric.monomials(z)).sum(-1), rtol=0, atol=1e-13)


def test_equation_12_leads_to_the_manifold_of_a_dyad():
    p1, p2, p3, p4, p5, p6, p7, p8 = p = np.random.default_rng(6).normal(size=8)
    q = [p1, p1, p2, 0, p3, p4, p5, p6, p7, p8]
    np.testing.assert_array_equal(quadric.matrix(q), constraint_manifold.matrix(p))


# The fit


def on_circle(rng: np.random.Generator, fixed, moving, radius, count: int) -> np.ndarray:
    """Image points of displacements that leave the moving pivot on the circle."""
    turn, place = rng.uniform(-np.pi, np.pi, (2, count))
    target = fixed + radius * np.stack([np.cos(place), np.sin(place)], axis=-1)
    turned = Displacement(np.zeros(2), turn).act(moving)
    return Displacement(target - turned, turn).as_image_point()


def on_line(rng: np.random.Generator, normal_angle, offset, moving, count: int) -> np.ndarray:
    """Image points of displacements that leave the moving pivot on the line."""
    turn, along = rng.uniform(-np.pi, np.pi, count), offset * rng.normal(size=(count, 1))
    n = np.array([np.cos(normal_angle), np.sin(normal_angle)])
    target = offset * n + along * np.array([-n[1], n[0]])
    turned = Displacement(np.zeros(2), turn).act(moving)
    return Displacement(target - turned, turn).as_image_point()


def on_quadric(rng: np.random.Generator, c: np.ndarray, count: int) -> np.ndarray:
    """Real points of Zᵀ C Z = 0: where random lines meet it."""
    points: list[np.ndarray] = []
    while len(points) < count:
        a, b = rng.normal(size=(2, 4))
        roots = np.roots([b @ c @ b, 2 * a @ c @ b, a @ c @ a])
        points += [a + t.real * b for t in roots if t.imag == 0]
    z = np.array(points[:count])
    return z / np.linalg.norm(z[:, 2:], axis=-1, keepdims=True)


@pytest.mark.parametrize("seed", range(20))
def test_points_of_an_rr_manifold_give_it_back(seed):
    rng = np.random.default_rng(seed)
    fixed, moving = rng.normal(size=(2, 2))
    radius = rng.uniform(0.3, 3)
    fit = fit_quadric(on_circle(rng, fixed, moving, radius, 40))
    known = constraint_manifold.matrix(
        constraint_manifold.coefficients_of_circle(fixed, moving, radius)
    )
    assert same_up_to_scale(fit.matrix(), known, 1e-9)
    assert fit.kind() == Kind.ONE_SHEET
    assert fit.singular_values[0] < 1e-12
    assert fit.singular_values[1] > 1e-3  # a surface leaves one quadric


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_points_of_a_slider_manifold_give_it_back(unit):
    rng = np.random.default_rng(3)
    moving = unit * rng.normal(size=2)
    fit = fit_quadric(on_line(rng, 0.7, 1.3 * unit, moving, 40))
    known = constraint_manifold.matrix(
        constraint_manifold.coefficients_of_fixed_line(0.7, 1.3 * unit, moving)
    )
    assert same_up_to_scale(fit.matrix(), known, 1e-9)
    assert fit.kind() == Kind.HYPERBOLIC_PARABOLOID


@pytest.mark.parametrize("seed", range(20))
def test_points_of_a_general_quadric_give_it_back(seed):
    rng = np.random.default_rng(seed)
    stretch = np.diag([1, 1, -1, rng.choice([-1, 1])]) * rng.uniform(0.5, 2, 4)
    c = congruent(stretch, affine_maps(rng, 1)[0])
    fit = fit_quadric(on_quadric(rng, c, 60))
    assert same_up_to_scale(fit.matrix(), c, 1e-8)
    assert fit.kind() == classify(c)


@pytest.mark.parametrize("count", [10, 11, 25, 400])
def test_rms_is_that_of_the_residual_and_the_least_there_is(count):
    rng = np.random.default_rng(count)
    z = random_unit_points(rng, count)
    fit = fit_quadric(z)
    residual = np.einsum("ki,ij,kj->k", z, fit.matrix(), z)
    np.testing.assert_allclose(fit.rms, np.sqrt((residual**2).mean()), rtol=1e-10)
    np.testing.assert_allclose(fit.rms, fit.singular_values[0] / np.sqrt(count), rtol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(fit.coefficients), 1, rtol=1e-14)
    other = rng.normal(size=(1000, 10))
    other /= np.linalg.norm(other, axis=-1, keepdims=True)
    assert (np.linalg.norm(other @ quadric.monomials(z).T, axis=-1) > fit.singular_values[0]).all()


@pytest.mark.parametrize("count", [10, 11, 200_000])  # a factor of N x N would be 320 GB
def test_the_fit_is_numpys_svd(count):
    design = quadric.monomials(z := random_unit_points(np.random.default_rng(1), count))
    fit = fit_quadric(z)
    _, values, vectors = np.linalg.svd(design, full_matrices=False)
    np.testing.assert_allclose(fit.singular_values, values[::-1], rtol=0, atol=1e-13 * values[0])
    overlap = np.abs((fit.vectors * vectors[::-1]).sum(-1))
    np.testing.assert_allclose(overlap, 1, rtol=0, atol=1e-11)


@pytest.mark.parametrize("count", [4, 9, 30])
def test_a_stack_of_fits_is_the_single_fits(count):
    z = random_unit_points(np.random.default_rng(7), 2, 3, count)
    batch = fit_quadric(z)
    for index in np.ndindex(2, 3):
        single = fit_quadric(z[index])
        np.testing.assert_allclose(batch.singular_values[index], single.singular_values, atol=1e-13)
        np.testing.assert_allclose(batch.rms[index], single.rms, atol=1e-13)
        np.testing.assert_allclose(batch.length[index], single.length, rtol=1e-13)
        if count >= 9:
            assert same_up_to_scale(batch.coefficients[index], single.coefficients, 1e-10)
            assert batch.kind()[index] == single.kind()


@pytest.mark.parametrize("count", range(1, 10))
def test_few_points_leave_quadrics_open_and_all_are_given(count):
    z = random_unit_points(np.random.default_rng(count), count)
    fit = fit_quadric(z)
    assert (fit.singular_values == 0).sum() == 10 - count
    assert fit.rms == 0
    through = fit.vectors[: 10 - count]
    assert np.abs(quadric.monomials(z) @ through.T).max() < 1e-13
    np.testing.assert_allclose(fit.vectors @ fit.vectors.T, np.eye(10), atol=1e-13)


def test_points_of_a_four_bar_motion_leave_a_pencil():
    """The paper's linkage (Fig. 2) driven: its image curve lies on a pencil of quadrics."""
    first, second = cases.load("ge2012-exact")["printed"]["linkage"]
    c1, m1, c2, m2 = (
        complex(*dyad[key]) for dyad in (first, second) for key in ("fixed_pivot", "moving_pivot")
    )
    pin = c1 + first["radius"] * np.exp(1j * np.linspace(0, 6, 50))
    # |pin + (m2 - m1) exp(i angle) - c2| = r2, by the law of cosines
    gap, coupler = pin - c2, m2 - m1
    cosine = (second["radius"] ** 2 - abs(gap) ** 2 - abs(coupler) ** 2) / 2
    angle = np.angle(gap) - np.angle(coupler) + np.arccos(cosine / abs(gap * coupler))
    origin = pin - m1 * np.exp(1j * angle)
    motion = Displacement(np.stack([origin.real, origin.imag], axis=-1), angle)
    values = fit_quadric(motion.as_image_point()).singular_values
    assert values[1] < 1e-13
    assert values[2] > 1e-4


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e300])
def test_numbers_that_are_not_finite_are_refused(bad):
    z = random_unit_points(np.random.default_rng(0), 3, 12)
    z[1, 4, 2] = bad
    with pytest.raises(InputError, match=r"image point 2, 5 ") as caught:
        fit_quadric(z)
    assert caught.value.code == "E103"


def test_a_matrix_that_is_not_finite_is_refused():
    with pytest.raises(InputError) as caught:
        classify(np.diag([1, 1, np.nan, 1]))
    assert caught.value.code == "E103"


def test_no_points_are_refused():
    with pytest.raises(InputError) as caught:
        fit_quadric(np.empty((0, 4)))
    assert caught.value.code == "E121"


@pytest.mark.parametrize(
    "call",
    [functools.partial(fit_quadric, np.ones((5, 3))), functools.partial(classify, np.eye(3))],
)
def test_wrong_shapes_are_a_callers_mistake(call):
    with pytest.raises(ValueError, match="shape"):
        call()
