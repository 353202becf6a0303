"""True distances of dyads from a circle or a line, and what a fit to them minimises.

A dyad is a vector z here, (c1, c2, m1, m2, r) or (normal angle, offset, m1, m2), that may move
along the range of a projector.  Poses may be exact: there the distance stays zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_kernel import distance_terms, distances
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

DIVISOR_FLOOR = 1e-300  # lengths; keeps 0 / 0 away from a pivot that meets its centre
NEGLIGIBLE_GAIN = 1e-10  # share of the sum of squares; a step that gains less is not checked by it


class Distances(NamedTuple):
    """Distances (k, N) of dyads z (k, n) over poses, and their derivatives by z.

    jacobian: (k, N, n); second, other: (k, N, n), vectors of which the second derivatives are
    made: the symmetric part of second otherᵀ.
    """

    distance: FloatArray
    jacobian: FloatArray
    second: FloatArray
    other: FloatArray

    def curvature(self, by_distance: FloatArray) -> FloatArray:
        """The sum (k, n, n) of all second derivatives times the factors (k, N)."""
        product = np.swapaxes(by_distance[..., None] * self.second, -1, -2) @ self.other
        return np.asarray((product + np.swapaxes(product, -1, -2)) / 2)


class Point(NamedTuple):
    """Dyads z (k, n), and their distances."""

    z: FloatArray
    here: Distances


class DistanceFunction(NamedTuple):
    """Distances as a function of dyads z (k, n), with their derivatives or without.

    level: the coordinate of z that is taken off every distance: the radius, or the offset.
    """

    of: Callable[[FloatArray], Distances]
    only: Callable[[FloatArray], FloatArray]
    level: int

    def at(self, z: FloatArray) -> Point:
        """Dyads z (k, n) with their distances."""
        return Point(z, self.of(z))

    def times(self, factor: FloatArray) -> DistanceFunction:
        """The distances multiplied by factors (N,)."""

        def of(z: FloatArray) -> Distances:
            distance, jacobian, second, other = self.of(z)
            wide = factor[:, None]
            return Distances(factor * distance, wide * jacobian, wide * second, other)

        return DistanceFunction(of, lambda z: factor * self.only(z), self.level)


class FitProblem(NamedTuple):
    """What dyads z (k, n) are fitted to.

    distances: of the poses (N,); weights: (N,); exact: (N,), where the distance is to be zero.
    """

    distances: DistanceFunction
    weights: FloatArray
    exact: NDArray[np.bool_]

    @property
    def loose(self) -> FloatArray:
        """The weights (N,) of the poses that are not exact, 0 of the others."""
        return np.where(self.exact, 0.0, self.weights)


class GeometricFit(NamedTuple):
    """Where fits ended: dyads, and the objective's derivatives (k, N) by the distances.

    The objective's gradient by z is by_distance @ jacobian, exact poses included: there the
    derivative is the multiplier.  settled: (k,), whether the steps came to an end.
    """

    at: Point
    by_distance: FloatArray
    settled: NDArray[np.bool_]

    @property
    def z(self) -> FloatArray:
        """The dyads (k, n)."""
        return self.at.z


def circle_distances(poses: Displacement) -> DistanceFunction:
    """The distances of the moving pivot from its circle, over poses (N,)."""
    seen, terms = _seen(poses), circle_terms(poses)

    def of(z: FloatArray) -> Distances:
        distance, jacobian, tangent, arm = terms(z)
        return Distances(distance, jacobian, tangent, tangent / arm[..., None])

    def only(z: FloatArray) -> FloatArray:
        distance = np.empty((len(z), seen.shape[1]))
        distances(np.ascontiguousarray(z), seen, distance)
        return distance

    return DistanceFunction(of, only, 4)


def circle_terms(poses: Displacement) -> Callable[[FloatArray], tuple[FloatArray, ...]]:
    """What the distances of circles z (*, 5) over poses (N,) consist of.

    Returns a function of z, to the distances (*, N), their Jacobian (*, N, 5), and the vectors
    tangent (*, N, 5) and arms (*, N) of which the second derivatives are made:
    tangent tangentᵀ / arm.
    """
    seen = _seen(poses)

    def terms(z: FloatArray) -> tuple[FloatArray, ...]:
        flat, shape = np.ascontiguousarray(z).reshape(-1, 5), (*z.shape[:-1], seen.shape[1])
        parts = [np.empty((len(flat), seen.shape[1], *last)) for last in ((), (5,), (5,), ())]
        distance_terms(flat, seen, *parts)
        return tuple(each.reshape(*shape, *each.shape[2:]) for each in parts)

    return terms


def _seen(poses: Displacement) -> FloatArray:
    """Poses (N,) as the kernel takes them, (4, N): cosine, sine, x, y."""
    return np.stack([np.cos(poses.angle), np.sin(poses.angle), *poses.translation.T])


def line_distances(poses: Displacement) -> DistanceFunction:
    """The distances of the moving pivot from its line, over poses (N,)."""
    cos, sin = np.cos(poses.angle), np.sin(poses.angle)

    def distances(z: FloatArray) -> Distances:
        n1, n2 = np.cos(z[:, :1]), np.sin(z[:, :1])
        x, y = np.moveaxis(poses.act(z[:, None, 2:]), -1, 0)
        along, across = n1 * x + n2 * y, n1 * y - n2 * x
        in_body, turned = (cos * n1 + sin * n2, cos * n2 - sin * n1), cos * -n2 + sin * n1
        zero, one = np.zeros_like(along), np.ones_like(along)
        jacobian = np.stack([across, -one, *in_body], axis=-1)
        second = np.stack([one, zero, zero, zero], axis=-1)
        other = np.stack([-along, zero, 2 * turned, 2 * in_body[0]], axis=-1)
        return Distances(along - z[:, 1:2], jacobian, second, other)

    return DistanceFunction(distances, lambda z: distances(z).distance, 1)
