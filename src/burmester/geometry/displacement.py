"""Planar displacements and their image points: Eqs. (1) to (3) of Ge et al. 2012.

A displacement carries the moving frame M, seen in the fixed frame F, to the origin
`translation` and the orientation `angle`.  Kinematic mapping sends it to the image point

    Z = (Z1 : Z2 : Z3 : Z4),   Z3 = sin(angle / 2),   Z4 = cos(angle / 2),

a point of a projective three-space; Z and -Z are the same displacement.  Image points are
kept at unit scale, Z3² + Z4² = 1, so that nothing is singular at half turns.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray
from burmester.values import Shape, real_numbers


@final
@dataclass(frozen=True, slots=True, eq=False)
class Displacement:
    """Rigid displacements of the plane, one or a million, from M to F.

    Leading axes of the two broadcast against each other.

    Parameters
    ----------
    translation : (*, 2) array_like
        The origin of M in F, in the task's length unit.
    angle : (*,) array_like
        The orientation of M in F, in radians, any number of turns.

    Raises
    ------
    InputError
        E125 (no real numbers, or of shapes that do not belong together).

    Examples
    --------
    >>> import numpy as np
    >>> pose = Displacement([3.0, 1.0], np.radians(90))
    >>> pose.act([2.0, 0.0]).round(12) + 0
    array([3., 3.])
    >>> (pose.inverse() @ pose).translation.round(12) + 0
    array([0., 0.])
    """

    translation: FloatArray
    angle: FloatArray

    def __post_init__(self) -> None:
        translation = _numbers(self.translation, (..., 2), "translations")
        angle = _numbers(self.angle, (...,), "angles")
        if translation.shape[:-1] != angle.shape:
            shape = _broadcast(translation.shape[:-1], angle.shape)
            translation = np.broadcast_to(translation, (*shape, 2))
            angle = np.broadcast_to(angle, shape)
        object.__setattr__(self, "translation", translation)
        object.__setattr__(self, "angle", angle)

    @classmethod
    def from_poses(cls, poses: ArrayLike) -> Self:
        """Displacements from rows (x, y, angle in radians), shape (*, 3)."""
        rows = _numbers(poses, (..., 3), "rows of x, y, angle")
        return cls(rows[..., :2], rows[..., 2])

    @classmethod
    def identity(cls, shape: tuple[int, ...] = ()) -> Self:
        """The displacement that leaves M on F."""
        return cls(np.zeros((*shape, 2)), np.zeros(shape))

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> Self:
        """The displacement of a homogeneous (*, 3, 3) matrix, Eq. (1); angle in (-pi, pi]."""
        t = np.asarray(matrix, dtype=np.float64)
        return cls(t[..., :2, 2], np.arctan2(t[..., 1, 0], t[..., 0, 0]))

    @classmethod
    def from_image_point(cls, point: ArrayLike) -> Self:
        """The displacement of an image point (*, 4) of any scale but zero, Eq. (3).

        The angle comes back in (-pi, pi].

        Formula `pose-of-image-point` of the theory.
        """
        z = np.asarray(point, dtype=np.float64)
        z1, z2, z3, z4 = np.moveaxis(z, -1, 0)
        scale = z3**2 + z4**2
        translation = np.stack([2 * (z1 * z3 + z2 * z4), 2 * (z2 * z3 - z1 * z4)], axis=-1)
        angle = np.arctan2(2 * z3 * z4, z4**2 - z3**2)
        return cls(translation / scale[..., None], angle)

    @property
    def x(self) -> FloatArray:
        """The first coordinate of the origin of M in F, shape (*)."""
        return self.translation[..., 0]

    @property
    def y(self) -> FloatArray:
        """The second one."""
        return self.translation[..., 1]

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes: () for one displacement."""
        return self.angle.shape

    def __getitem__(self, index: Any) -> Displacement:
        """Pick along the leading axes (indices, slices, masks)."""
        d1, d2 = self.translation[..., 0][index], self.translation[..., 1][index]
        return Displacement(_vectors(d1, d2), self.angle[index])

    def as_matrix(self) -> FloatArray:
        """Homogeneous matrices (*, 3, 3), Eq. (1)."""
        c, s = np.cos(self.angle), np.sin(self.angle)
        matrix = np.zeros((*self.shape, 3, 3))
        matrix[..., 0, 0] = matrix[..., 1, 1] = c
        matrix[..., 0, 1], matrix[..., 1, 0] = -s, s
        matrix[..., :2, 2] = self.translation
        matrix[..., 2, 2] = 1.0
        return matrix

    def as_image_point(self) -> FloatArray:
        """Unit image points (*, 4), Eq. (2), with Z3² + Z4² = 1.

        Formula `image-point` of the theory.
        """
        s, c = np.sin(self.angle / 2), np.cos(self.angle / 2)
        d1, d2 = self.translation[..., 0], self.translation[..., 1]
        point = np.empty((*self.shape, 4))
        point[..., 0] = (d1 * s - d2 * c) / 2
        point[..., 1] = (d1 * c + d2 * s) / 2
        point[..., 2] = s
        point[..., 3] = c
        return point

    def rotate(self, vectors: ArrayLike) -> FloatArray:
        """Directions of M (*, 2) seen in F: the rotation alone."""
        v = np.asarray(vectors, dtype=np.float64)
        c, s = np.cos(self.angle), np.sin(self.angle)
        x, y = v[..., 0], v[..., 1]
        return _vectors(c * x - s * y, s * x + c * y)

    def act(self, points: ArrayLike) -> FloatArray:
        """Points of M (*, 2) seen in F, Eq. (4).

        Formula `displacement` of the theory.
        """
        return self.rotate(points) + self.translation

    def inverse(self) -> Displacement:
        """The displacement from F to M: the inverse motion."""
        back = Displacement(np.zeros(2), -self.angle)
        return Displacement(-back.rotate(self.translation), -self.angle)

    def __matmul__(self, other: Displacement) -> Displacement:
        """Compose: `(a @ b).act(p) == a.act(b.act(p))`; angles add."""
        return Displacement(self.act(other.translation), self.angle + other.angle)

    def require_finite(self) -> None:
        """Refuse numbers that are not finite; some SVD codes never return on one `inf`.

        Raises InputError E103 naming the first such pose.
        """
        bad = ~(np.isfinite(self.translation).all(axis=-1) & np.isfinite(self.angle))
        if bad.any():
            index = tuple(int(i) for i in np.argwhere(bad)[0])
            x, y = self.translation[index]
            raise InputError(
                "E103",
                f"pose {', '.join(str(i + 1) for i in index)} has a value that is not a "
                f"finite number: x = {x:g}, y = {y:g}, angle = {self.angle[index]:g} rad",
                help="give finite numbers, or delete the pose",
            )


def _vectors(x: FloatArray, y: FloatArray) -> FloatArray:
    """Vectors (*, 2) of components (*,): `np.stack` takes three times as long for a few."""
    out = np.empty((*x.shape, 2))
    out[..., 0], out[..., 1] = x, y
    return out


def _numbers(value: object, shape: Shape, what: str) -> FloatArray:
    """Real numbers of a shape, finite or not; arrays of doubles are taken without a copy."""
    if type(value) is not np.ndarray or value.dtype != np.float64:
        return real_numbers(value, shape, what, finite=False)
    if shape == (...,) or value.shape[-1:] == shape[-1:]:
        return value
    return real_numbers(value, shape, what, finite=False)


def _broadcast(one: tuple[int, ...], other: tuple[int, ...]) -> tuple[int, ...]:
    """The common leading axes, or E125."""
    try:
        return np.broadcast_shapes(one, other)
    except ValueError:
        raise InputError(
            "E125",
            "translations and angles: not as many of one as of the other",
            why=f"their leading axes are {one} and {other}",
            help="give one angle for every translation",
        ) from None


def image_multiply(left: ArrayLike, right: ArrayLike) -> FloatArray:
    """The image point (*, 4) of `a @ b` from those of a and b: a bilinear product.

    So a change of the frame F or M is a linear map of the image space (Bottema and Roth,
    Theoretical Kinematics, chapter 11).

    Formula `composition` of the theory.
    """
    a1, a2, a3, a4 = np.moveaxis(np.asarray(left, dtype=np.float64), -1, 0)
    b1, b2, b3, b4 = np.moveaxis(np.asarray(right, dtype=np.float64), -1, 0)
    return np.stack(
        [
            a1 * b4 + a2 * b3 - a3 * b2 + a4 * b1,
            a2 * b4 - a1 * b3 + a4 * b2 + a3 * b1,
            a3 * b4 + a4 * b3,
            a4 * b4 - a3 * b3,
        ],
        axis=-1,
    )
