"""The four planar dyads: RR, PR, RP and PP, their letters read from ground to coupler.

The dimensions are arrays with the same leading axes, so that one dyad and a million are the
same type.  `residual` is the signed distance of a displacement from those that the dyad
allows, in the task's length unit (radians for PP); `coefficients` is its constraint manifold.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Self, TypeAlias, TypeVar, final

import numpy as np

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, weights_or_ones


class _Dimensions:
    """The common part of the four kinds: float arrays, and indices along the leading axes."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for name in self.__match_args__:  # type: ignore[attr-defined]
            value = np.asarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, value)

    def __getitem__(self, index: Any) -> Self:
        """Pick along the leading axes (indices, slices, masks, new axes)."""
        points = index
        if isinstance(index, tuple) and any(part is Ellipsis for part in index):
            points = (*index, slice(None))
        picked = object.__new__(type(self))  # its parts need no conversion
        for name in self.__match_args__:  # type: ignore[attr-defined]
            part = getattr(self, name)[points if name.endswith("pivot") else index]
            object.__setattr__(picked, name, part)
        return picked


@final
@dataclass(frozen=True, slots=True, eq=False)
class RR(_Dimensions):
    """A link with two pins: a point of M stays on a circle of F.

    Attributes
    ----------
    fixed_pivot : (*, 2) array of float
        The centre of the circle, in F, in the task's length unit.
    moving_pivot : (*, 2) array of float
        The point of M.
    radius : (*,) array of float
        The length of the link.

    Examples
    --------
    >>> from burmester import Displacement
    >>> crank = RR(fixed_pivot=[0, 0], moving_pivot=[1, 0], radius=2)
    >>> float(crank.residual(Displacement([2.0, 0.0], 0.0)))
    1.0
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
    """A slider on the ground with a pin on it: a point of M stays on a line of F.

    The line is n · X = offset with n = (cos, sin)(normal_angle) in F.

    Attributes
    ----------
    normal_angle : (*,) array of float
        In radians, in F.
    offset : (*,) array of float
        The signed distance of the line from the origin of F, in the task's length unit.
    moving_pivot : (*, 2) array of float
        The point of M.

    Examples
    --------
    >>> from burmester import Displacement
    >>> slider = PR(normal_angle=0, offset=0.5, moving_pivot=[0, 0])
    >>> float(slider.residual(Displacement([3.0, 1.0], 0.0)))
    2.5
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

    def pins(self, places: Displacement) -> FloatArray:
        """Where the pin is, (*, N, 2) in F, at places (*, N)."""
        return places.act(self.moving_pivot[..., None, :])

    def along(self, places: Displacement) -> FloatArray:
        """The pin's coordinates (*, N) on the line, a quarter turn ahead of the normal."""
        pins, angle = self.pins(places), self.normal_angle[..., None]
        return np.asarray(np.cos(angle) * pins[..., 1] - np.sin(angle) * pins[..., 0])

    def middle_of_travel(self, places: Displacement) -> FloatArray:
        """The middles (*, 2) in F of the stretches of lines (*,) that places (*, N) use.

        Places that are nan do not count; without any it is the foot of the normal.
        """
        n = np.stack([np.cos(self.normal_angle), np.sin(self.normal_angle)], axis=-1)
        ahead = np.stack([-n[..., 1], n[..., 0]], axis=-1)
        along = self.along(places)
        low, high = (f.reduce(along, axis=-1, initial=np.nan) for f in (np.fmin, np.fmax))
        middle = np.nan_to_num((low + high) / 2)
        return np.asarray(self.offset[..., None] * n + middle[..., None] * ahead)


@final
@dataclass(frozen=True, slots=True, eq=False)
class RP(_Dimensions):
    """A pin on the ground in a slot of the body: a point of F stays on a line of M.

    The line is n · x = offset with n = (cos, sin)(normal_angle) in M.

    Attributes
    ----------
    fixed_pivot : (*, 2) array of float
        The point of F, in the task's length unit.
    normal_angle : (*,) array of float
        In radians, in M.
    offset : (*,) array of float
        The signed distance of the line from the origin of M.

    Examples
    --------
    >>> from burmester import Displacement
    >>> slot = RP(fixed_pivot=[3, 1], normal_angle=0, offset=2)
    >>> float(slot.residual(Displacement([0.0, 0.0], 0.0)))
    1.0
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
        return self._held.residual(poses.inverse())

    def gradient(self, poses: Displacement) -> FloatArray:
        """The derivatives (*, 3) of the residual by d1, d2 and the angle."""
        normal = np.stack([np.cos(self.normal_angle), np.sin(self.normal_angle)], axis=-1)
        return _wrench(-poses.rotate(normal), self.fixed_pivot - poses.translation)

    def middle_of_travel(self, places: Displacement) -> FloatArray:
        """The middles (*, 2) in M of the stretches of lines (*,) that places (*, N) use.

        Places that are nan do not count; without any it is the foot of the normal.
        """
        return self._held.middle_of_travel(places.inverse())

    def pins(self, places: Displacement) -> FloatArray:
        """Where the pin is, (*, N, 2) in M, at places (*, N)."""
        return self._held.pins(places.inverse())

    def along(self, places: Displacement) -> FloatArray:
        """The pin's coordinates (*, N) on the line, a quarter turn ahead of the normal."""
        return self._held.along(places.inverse())

    @property
    def _held(self) -> PR:
        """The same as one sees it from M, where the line stays."""
        return PR(self.normal_angle, self.offset, self.fixed_pivot)


@final
@dataclass(frozen=True, slots=True, eq=False)
class PP(_Dimensions):
    """Two sliders, one on the other: M only translates.

    Attributes
    ----------
    angle : (*,) array of float
        The angle of M, in radians, which stays.

    Examples
    --------
    >>> from burmester import Displacement
    >>> float(PP(angle=0.5).residual(Displacement([7.0, 8.0], 0.75)))
    0.25
    """

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
    """A force and its moment about the origin of M, put at `at` from there: (*, 3)."""
    moment = at[..., 0] * force[..., 1] - at[..., 1] * force[..., 0]
    x, y = force[..., 0], force[..., 1]
    return np.stack(np.broadcast_arrays(x, y, moment), axis=-1)


def line_direction_deg(normal_angle: FloatArray) -> FloatArray:
    """The directions (*,) of sliders' lines in their own frames, degrees in (-90, 90]."""
    turned = np.degrees(normal_angle) % 180  # that of the normal, in [0, 180)
    return np.where(turned > 0, turned - 90, 90.0)


def refitted_circles(
    p: FloatArray, poses: Displacement, weights: FloatArray | None = None
) -> tuple[RR, FloatArray, FloatArray]:
    """The circles (*, k) of manifolds p (*, k, 8), with radii refitted to the poses (*, N).

    The mean distance of the moving pivot from the fixed one is the radius with the least sum of
    squares.  The radius in p itself is not used: noise makes its two versions disagree.

    Formula `refitted-radius` of the theory.

    Returns circles, and the root mean square and the greatest residual (*, k) over the poses.
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
