"""Dyads as quadrics: the equations of section 3 of the paper."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement

number = st.floats(-5, 5)
pair = st.tuples(number, number).map(np.array)
circles = st.builds(RR, pair, pair, st.floats(0.1, 5))
poses = st.lists(st.tuples(number, number, number), min_size=3, max_size=8).map(
    lambda rows: Displacement.from_poses(np.array(rows))
)


def quadratic_form(dyad, at):
    z = at.as_image_point()
    return np.einsum("ni,ij,nj->n", z, constraint_manifold.matrix(dyad.coefficients()), z)


@given(circles, poses)
def test_the_form_of_eq_9_is_a_quarter_of_the_circle_equation(dyad, at):
    cos, sin = np.cos(at.angle), np.sin(at.angle)
    x, y = dyad.moving_pivot
    big_x = cos * x - sin * y + at.translation[:, 0]
    big_y = sin * x + cos * y + at.translation[:, 1]
    wanted = (big_x - dyad.fixed_pivot[0]) ** 2 + (big_y - dyad.fixed_pivot[1]) ** 2
    wanted = (wanted - dyad.radius**2) / 4
    assert np.allclose(quadratic_form(dyad, at), wanted, rtol=0, atol=1e-10)


@given(circles)
def test_matrix_of_a_circle_as_printed_in_eqs_7_and_9(dyad):
    (xc, yc), (x, y), c = dyad.fixed_pivot, dyad.moving_pivot, dyad.radius**2 / 4
    s1, s2, t1, t2 = -(x + xc) / 2, -(y + yc) / 2, -(y - yc) / 2, (x - xc) / 2
    eq9 = [
        [1, 0, s1, t1],
        [0, 1, s2, t2],
        [s1, s2, s1**2 + s2**2 - c, s1 * t1 + s2 * t2],
        [t1, t2, s1 * t1 + s2 * t2, t1**2 + t2**2 - c],
    ]
    assert np.allclose(constraint_manifold.matrix(dyad.coefficients()), eq9, rtol=0, atol=1e-12)


@given(circles, st.floats(-3, 3).filter(lambda f: abs(f) > 1e-3))
def test_circle_and_back_whatever_the_factor(dyad, factor):
    fixed, moving, squared = constraint_manifold.circle(factor * dyad.coefficients())
    assert np.allclose(fixed, dyad.fixed_pivot, rtol=0, atol=1e-9)
    assert np.allclose(moving, dyad.moving_pivot, rtol=0, atol=1e-9)
    assert np.allclose(squared, dyad.radius**2, rtol=0, atol=1e-8)


def test_published_dyads_have_the_published_matrices():
    # Eqs. (20) and (21), from the linkage of Fig. 2; r2 as its printed matrix implies.
    first = constraint_manifold.matrix(RR([-2.2, 0.1], [1.24, 0.1], 1.2377).coefficients())
    eq20 = [
        [1, 0, 0.48, 0],
        [0, 1, -0.1, 1.72],
        [0.48, -0.1, -0.1426, -0.172],
        [0, 1.72, -0.172, 2.5754],
    ]
    assert np.allclose(first, eq20, rtol=0, atol=1e-4)
    second = constraint_manifold.matrix(RR([1.15, 0.38], [4.59, 1.34], 4.6712).coefficients())
    eq21 = [
        [1, 0, -2.87, -0.48],
        [0, 1, -0.86, 1.72],
        [-2.87, -0.86, 3.5215, -0.1016],
        [-0.48, 1.72, -0.1016, -2.2662],
    ]
    assert np.allclose(second, eq21, rtol=0, atol=1e-3)


@given(
    st.one_of(
        circles,
        st.builds(PR, number, number, pair),
        st.builds(RP, pair, number, number),
        st.builds(PP, number),
    )
)
def test_every_dyad_fulfils_eq_17(dyad):
    p = dyad.coefficients()
    assert np.allclose(constraint_manifold.conditions(p), 0, atol=1e-9 * (1 + p @ p))


@given(st.lists(number, min_size=8, max_size=8).map(np.array), st.integers(0, 7))
def test_condition_gradients_are_derivatives(p, k):
    step = np.zeros(8)
    step[k] = 1e-5
    numeric = (
        constraint_manifold.conditions(p + step) - constraint_manifold.conditions(p - step)
    ) / 2e-5
    assert np.allclose(constraint_manifold.condition_gradients(p)[:, k], numeric, rtol=0, atol=1e-8)


@given(st.builds(PR, number, number, pair), poses)
def test_fixed_line_form_is_the_signed_distance(dyad, at):
    n = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    wanted = at.act(dyad.moving_pivot) @ n - dyad.offset
    assert np.allclose(quadratic_form(dyad, at), wanted, rtol=0, atol=1e-10)
    fixed, moving = constraint_manifold.prismatic_parts(dyad.coefficients())
    assert np.allclose(fixed, n)
    assert np.allclose(moving, 0, atol=1e-12)


@given(st.builds(RP, pair, number, number), poses)
def test_moving_line_form_is_the_signed_distance(dyad, at):
    n = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    seen = at.inverse().act(dyad.fixed_pivot)
    assert np.allclose(quadratic_form(dyad, at), seen @ n - dyad.offset, rtol=0, atol=1e-10)
    fixed, moving = constraint_manifold.prismatic_parts(dyad.coefficients())
    assert np.allclose(moving, n)
    assert np.allclose(fixed, 0, atol=1e-12)


@given(number, poses)
def test_rotation_form_vanishes_at_its_angle_only(angle, at):
    form = quadratic_form(PP(np.array(angle)), at)
    assert np.allclose(form, np.sin((at.angle - angle) / 2) ** 2, rtol=0, atol=1e-12)


dyads = st.one_of(
    circles,
    st.builds(PR, number, number, pair),
    st.builds(RP, pair, number, number),
    st.builds(PP, number),
)


@given(dyads, st.tuples(number, number, number))
def test_gradients_are_derivatives_of_residuals(dyad, pose):
    at = Displacement.from_poses(np.array(pose))
    if isinstance(dyad, RR) and dyad.residual(at) + dyad.radius < 0.1:
        return  # the distance has no derivative at its centre
    if isinstance(dyad, PP) and abs(dyad.residual(at)) > 3.1:
        return  # the angle jumps at a half turn
    h = 1e-6
    for k in range(3):
        step = h * np.eye(3)[k]
        ahead, behind = (Displacement.from_poses(np.array(pose) + s * step) for s in (1, -1))
        numeric = (dyad.residual(ahead) - dyad.residual(behind)) / (2 * h)
        assert np.isclose(dyad.gradient(at)[k], numeric, rtol=0, atol=1e-6)
