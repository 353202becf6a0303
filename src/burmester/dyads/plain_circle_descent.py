"""Newton's plain step from circles down to their distance from the poses, many at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec

__all__ = ["newton_step"]

FLAT_EIGENVALUE = 1e-14  # share of the greatest; smaller eigenvalues are taken for this one


def newton_step(
    terms: tuple[FloatArray, ...], share: FloatArray
) -> tuple[FloatArray, NDArray[np.bool_], FloatArray]:
    """Newton's step, or Gauss and Newton's where the sum of squares is not convex.

    Returns the steps (k, 5), whether the sum is convex (k,), and what the steps gain (k,).
    """
    distance, jacobian, tangent, arm = terms
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
    return step, convex, gain
