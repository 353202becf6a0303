"""From circles down to the local minima of their distance from the poses, many at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import NEGLIGIBLE_GAIN, circle_terms
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import where
from burmester.numerics.iteration import iterate, shortened
from burmester.numerics.linear_algebra import matvec

__all__ = ["circle_ends", "newton_step"]

MAX_NEWTON_STEPS = 60  # from each start
SETTLED_STEP = 1e-9  # relative; a shorter step of Newton's method is its last one
MAX_LENGTH = 1e3  # characteristic lengths; a circle with greater coordinates is a line
FLAT_EIGENVALUE = 1e-14  # share of the greatest; smaller eigenvalues are taken for this one


class _Point(NamedTuple):
    """Circles z (k, 5), the terms of their distances, and whether they have come to rest (k,)."""

    z: FloatArray
    terms: tuple[FloatArray, ...]
    settled: NDArray[np.bool_]


def circle_ends(
    z: FloatArray, poses: Displacement, share: FloatArray, basis: FloatArray | None = None
) -> tuple[FloatArray, NDArray[np.intp]]:
    """The local minimum (k, 5) of the sum of squares to which each circle (k, 5) leads.

    Newton's method; where the sum is not convex, Gauss and Newton's step; shortened until it
    helps.  Not a number where a circle does not come to rest, or grows so far that it is a slider.
    basis: (k, 5, d), orthonormal columns: the directions in which a circle may move; all if None.
    Returns the minima, and with which step each was reached (k,).
    """
    terms = circle_terms(poses)

    def cost(terms: tuple[FloatArray, ...]) -> FloatArray:
        return np.asarray(terms[0] ** 2 @ share)

    def point(z: FloatArray) -> _Point:
        return _Point(z, terms(z), np.zeros(len(z), dtype=bool))

    def advance(rows: NDArray[np.intp], here: _Point) -> tuple[_Point, NDArray[np.bool_]]:
        along = None if basis is None else basis[rows]
        step, convex, gain = newton_step(here.terms, share, along)
        before = cost(here.terms)
        # Newton's last steps gain so little that the sum would tell by its rounding only.
        negligible = convex & (gain < NEGLIGIBLE_GAIN * before)
        there, failed = shortened(
            lambda step: point(here.z + step),
            step,
            lambda there: ~negligible & (cost(there.terms) > before),
        )
        there = where(failed, here, there)
        size = 1 + np.abs(there.z).max(axis=-1)
        moved = np.abs(there.z - here.z).max(axis=-1)
        settled = convex & (moved < SETTLED_STEP * size)
        ended = settled | (failed & ~convex) | (size > MAX_LENGTH)
        return there._replace(settled=settled), ended

    ends, ended_at = iterate(advance, point(z), np.arange(len(z)), MAX_NEWTON_STEPS)
    return np.where(ends.settled[:, None], ends.z, np.nan), ended_at


def newton_step(
    terms: tuple[FloatArray, ...], share: FloatArray, basis: FloatArray | None = None
) -> tuple[FloatArray, NDArray[np.bool_], FloatArray]:
    """Newton's step along a basis (k, 5, d), or Gauss and Newton's where the sum is not convex.

    Returns the steps (k, 5), whether the sum is convex (k,), and what the steps gain (k,).
    """
    distance, jacobian, tangent, arm = terms
    if basis is not None:
        jacobian, tangent = jacobian @ basis, tangent @ basis
    weighted = share * distance
    gradient = (weighted[:, None] @ jacobian)[:, 0]
    gauss_newton = np.swapaxes(share[:, None] * jacobian, -1, -2) @ jacobian
    curvature = np.swapaxes((weighted / arm)[..., None] * tangent, -1, -2) @ tangent
    values, axes = np.linalg.eigh(gauss_newton + curvature)
    convex = values[:, 0] > 0
    if not convex.all():
        values[~convex], axes[~convex] = np.linalg.eigh(gauss_newton[~convex])
    values = np.maximum(values, FLAT_EIGENVALUE * values[:, -1:])
    along = (gradient[:, None] @ axes)[:, 0] / values
    step = -matvec(axes, along)
    gain = -(gradient * step).sum(axis=-1)
    return step if basis is None else matvec(basis, step), convex, gain
