"""The four planar dyads: RR, PR, RP and PP, their letters read from ground to coupler.

Each holds its dimensions as arrays with the same leading axes, so that one dyad and a
million are the same type.  `residual` is how far a displacement is from being possible for
the dyad, signed and in the task's length unit (radians for PP); `coefficients` is its
constraint manifold.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Self, TypeAlias, TypeVar, final

import numpy as np

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import weights_or_ones

__all__ = ["PP", "PR", "RP", "RR", "Dyad", "refitted_circles"]


class _Dimensions:
    """What the four kinds share: fields made float arrays once, and leading axes to pick from."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            value = np.asarray(getattr(self, field.name), dtype=np.float64)
            object.__setattr__(self, field.name, value)

    def __getitem__(self, index: Any) -> Self:
        """Pick along the leading axes (indices, slices, masks, new axes)."""
        points = index
        if isinstance(index, tuple) and any(part is Ellipsis for part in index):
            points = (*index, slice(None))
        picked = object.__new__(type(self))  # what is picked needs no conversion
        for name in self.__match_args__:  # type: ignore[attr-defined]
            part = getattr(self, name)[points if name.endswith("pivot") else index]
            object.__setattr__(picked, name, part)
        return picked


@final
@dataclass(frozen=True, slots=True, eq=False)
class RR(_Dimensions):
    """A point of M stays on a circle of F: a link with two pins.

    fixed_pivot: (*, 2) in F; moving_pivot: (*, 2) in M; radius: (*,), the link's length.
    """

    fixed_pivot: FloatArray
    moving_pivot: FloatArray
    radius: FloatArray

    def coefficients(self) -> FloatArray:
        """The constraint manifold p (*, 8), Eqs. (6), (7) and (13)."""
        return constraint_manifold.coefficients_of_circle(
            self.fixed_pivot, self.moving_pivot, self.radius
        )

    def residual(self, poses: Displacement) -> FloatArray:
        """The distance of the moving pivot from the circle, |R m + d - c| - r."""
        arm = poses.act(self.moving_pivot) - self.fixed_pivot
        return np.hypot(arm[..., 0], arm[..., 1]) - self.radius

    def gradient(self, poses: Displacement) -> FloatArray:
        """The derivatives (*, 3) of the residual by d1, d2 and the angle.

        Zero where the moving pivot is at the fixed one and no direction leads away from it.
        """
        turned = poses.rotate(self.moving_pivot)
        arm = turned + poses.translation - self.fixed_pivot
        size = np.linalg.norm(arm, axis=-1, keepdims=True)
        return _wrench(np.divide(arm, size, out=np.zeros_like(arm), where=size > 0), turned)


@final
@dataclass(frozen=True, slots=True, eq=False)
class PR(_Dimensions):
    """A point of M stays on a line of F: a slider on the ground with a pin on it.

    The line is n · X = offset with n = (cos, sin)(normal_angle) in F, normal_angle (*,) in
    radians, offset (*,); moving_pivot: (*, 2) in M.
    """

    normal_angle: FloatArray
    offset: FloatArray
    moving_pivot: FloatArray

    def coefficients(self) -> FloatArray:
        """The constraint manifold p (*, 8); p1 = 0."""
        return constraint_manifold.coefficients_of_fixed_line(
            self.normal_angle, self.offset, self.moving_pivot
        )

    def residual(self, poses: Displacement) -> FloatArray:
        """The distance of the moving pivot from the line, n · (R m + d) - offset."""
        point = poses.act(self.moving_pivot)
        n1, n2 = np.cos(self.normal_angle), np.sin(self.normal_angle)
        return n1 * point[..., 0] + n2 * point[..., 1] - self.offset

    def gradient(self, poses: Displacement) -> FloatArray:
        """The derivatives (*, 3) of the residual by d1, d2 and the angle."""
        normal = np.stack([np.cos(self.normal_angle), np.sin(self.normal_angle)], axis=-1)
        return _wrench(normal, poses.rotate(self.moving_pivot))


@final
@dataclass(frozen=True, slots=True, eq=False)
class RP(_Dimensions):
    """A point of F stays on a line of M: a pin on the ground in a slot of the body.

    fixed_pivot: (*, 2) in F; the line is n · x = offset with n = (cos, sin)(normal_angle)
    in M, normal_angle (*,) in radians, offset (*,).
    """

    fixed_pivot: FloatArray
    normal_angle: FloatArray
    offset: FloatArray

    def coefficients(self) -> FloatArray:
        """The constraint manifold p (*, 8); p1 = 0."""
        return constraint_manifold.coefficients_of_moving_line(
            self.fixed_pivot, self.normal_angle, self.offset
        )

    def residual(self, poses: Displacement) -> FloatArray:
        """The distance of the fixed pivot from the line, n · R⁻¹(c - d) - offset."""
        return PR(self.normal_angle, self.offset, self.fixed_pivot).residual(poses.inverse())

    def gradient(self, poses: Displacement) -> FloatArray:
        """The derivatives (*, 3) of the residual by d1, d2 and the angle."""
        normal = np.stack([np.cos(self.normal_angle), np.sin(self.normal_angle)], axis=-1)
        return _wrench(-poses.rotate(normal), self.fixed_pivot - poses.translation)


@final
@dataclass(frozen=True, slots=True, eq=False)
class PP(_Dimensions):
    """M only translates: two sliders, one on the other.  angle: (*,), kept, in radians."""

    angle: FloatArray

    def coefficients(self) -> FloatArray:
        """The constraint manifold p (*, 8): a plane of the image space, doubled."""
        return constraint_manifold.coefficients_of_rotation(self.angle)

    def residual(self, poses: Displacement) -> FloatArray:
        """The rotation away from `angle`, in radians, in [-pi, pi]."""
        turn = poses.angle - self.angle
        return np.arctan2(np.sin(turn), np.cos(turn))

    def gradient(self, poses: Displacement) -> FloatArray:
        """The derivatives (*, 3) of the residual by d1, d2 and the angle."""
        shape = np.broadcast_shapes(self.angle.shape, poses.shape)
        return np.broadcast_to(np.array([0.0, 0.0, 1.0]), (*shape, 3))


Dyad: TypeAlias = RR | PR | RP | PP
AnyDyad = TypeVar("AnyDyad", bound=Dyad)


def _wrench(force: FloatArray, at: FloatArray) -> FloatArray:
    """A force and its moment about the origin of M, put at `at` from there: (*, 3).

    A constraint's gradient is the wrench it can bear (the distance grows as it does work).
    """
    moment = at[..., 0] * force[..., 1] - at[..., 1] * force[..., 0]
    x, y = force[..., 0], force[..., 1]
    return np.stack(np.broadcast_arrays(x, y, moment), axis=-1)


def refitted_circles(
    p: FloatArray, poses: Displacement, weights: FloatArray | None = None
) -> tuple[RR, FloatArray, FloatArray]:
    """The circles of p (*, k, 8), their radii refitted to the poses (*, N), and their errors.

    The mean distance of the moving pivot from the fixed one is the radius with the least sum
    of squares.  Returned with the rms and the greatest residual over the poses, (*, k) each.
    The radius that p itself holds is not used: noise makes its two versions disagree.
    """
    fixed_pivot, moving_pivot, _ = constraint_manifold.circle(p)
    centred = RR(fixed_pivot, moving_pivot, np.zeros(fixed_pivot.shape[:-1]))
    with np.errstate(invalid="ignore"):
        distance = centred[..., None].residual(poses[..., None, :])
    share = weights_or_ones(weights, poses.shape)[..., None, :]
    radius = (distance * share).sum(axis=-1) / share.sum(axis=-1)
    miss = distance - radius[..., None]
    rms = np.sqrt((miss**2).mean(axis=-1))
    return RR(fixed_pivot, moving_pivot, radius), rms, np.abs(miss).max(axis=-1)


def shape_of(dyad: Dyad) -> tuple[int, ...]:
    """The leading axes of a dyad."""
    return np.broadcast_shapes(*(shape for _, _, shape in dimensions_of(dyad)))


def broadcast_to(dyad: AnyDyad, shape: tuple[int, ...]) -> AnyDyad:
    """A dyad with its leading axes broadcast to a shape."""
    return type(dyad)(*(np.broadcast_to(v, shape + v.shape[k:]) for v, k, _ in dimensions_of(dyad)))


def dimensions_of(dyad: Dyad) -> list[tuple[FloatArray, int, tuple[int, ...]]]:
    """Each dimension of a dyad with the number and the sizes of its leading axes."""
    values = [(getattr(dyad, f.name), f.name.endswith("pivot")) for f in fields(dyad)]
    return [(v, v.ndim - pivot, v.shape[: v.ndim - pivot]) for v, pivot in values]
