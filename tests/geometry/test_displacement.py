"""The group of planar displacements and the kinematic mapping, as laws."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement, image_multiply

coordinate = st.floats(-1e3, 1e3)
displacements = st.builds(
    lambda x, y, a: Displacement(np.array([x, y]), np.array(a)),
    coordinate,
    coordinate,
    st.floats(-20, 20),
)
points = st.tuples(coordinate, coordinate).map(np.array)


def same(a: Displacement, b: Displacement, tolerance=1e-9):
    assert np.allclose(a.as_matrix(), b.as_matrix(), rtol=0, atol=tolerance)


@given(displacements, points)
def test_matrix_of_eq_1_moves_points(a, p):
    moved = a.as_matrix() @ np.array([*p, 1.0])
    assert np.allclose(a.act(p), moved[:2], rtol=0, atol=1e-9)


@given(displacements, displacements, displacements)
def test_group_axioms(a, b, c):
    same((a @ b) @ c, a @ (b @ c))
    same(a @ a.inverse(), Displacement.identity())
    same(a.inverse() @ a, Displacement.identity())
    same(a @ Displacement.identity(), a)


@given(displacements, displacements, points)
def test_composition_acts_right_to_left(a, b, p):
    assert np.allclose((a @ b).act(p), a.act(b.act(p)), rtol=0, atol=1e-9)
    assert np.allclose((a @ b).as_matrix(), a.as_matrix() @ b.as_matrix(), rtol=0, atol=1e-9)


@given(displacements)
def test_image_point_of_eq_2_and_back_by_eq_3(a):
    z = a.as_image_point()
    assert np.isclose(z[2] ** 2 + z[3] ** 2, 1.0, rtol=0, atol=1e-15)
    z1, z2, z3, z4 = z
    eq3 = [
        [z4**2 - z3**2, -2 * z3 * z4, 2 * (z1 * z3 + z2 * z4)],
        [2 * z3 * z4, z4**2 - z3**2, 2 * (z2 * z3 - z1 * z4)],
        [0, 0, z3**2 + z4**2],
    ]
    assert np.allclose(eq3, a.as_matrix(), rtol=0, atol=1e-10)
    same(Displacement.from_image_point(z), a)
    same(Displacement.from_image_point(-3.7 * z), a)
    same(Displacement.from_matrix(a.as_matrix()), a)


@given(displacements, displacements)
def test_kinematic_mapping_is_a_homomorphism(a, b):
    product = image_multiply(a.as_image_point(), b.as_image_point())
    assert np.allclose(product, (a @ b).as_image_point(), rtol=0, atol=1e-9)


@given(displacements)
def test_half_turns_and_whole_turns_are_ordinary(a):
    turned = Displacement(a.translation, a.angle + 2 * np.pi)
    assert np.allclose(turned.as_image_point(), -a.as_image_point(), rtol=0, atol=1e-9)
    half = Displacement(a.translation, np.array(np.pi))
    same(Displacement.from_image_point(half.as_image_point()), half)


def test_a_stack_is_its_members():
    rng = np.random.default_rng(0)
    rows = rng.normal(size=(3, 4, 3))
    batch = Displacement.from_poses(rows)
    other = Displacement.from_poses(rng.normal(size=3))
    for i, j in np.ndindex(3, 4):
        one = Displacement.from_poses(rows[i, j])
        same(batch[i, j], one)
        same((batch @ other)[i, j], one @ other)
        same(batch.inverse()[i, j], one.inverse())
        assert np.array_equal(batch.as_image_point()[i, j], one.as_image_point())


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_not_finite_are_refused_by_name(bad):
    rows = np.zeros((6, 3))
    rows[3, 1] = bad
    with pytest.raises(InputError, match="pose 4") as caught:
        Displacement.from_poses(rows).require_finite()
    assert caught.value.code == "E103"
