"""Foot points: the places of a linkage's coupler nearest to given ones, by Newton's method.

Places are rows (x, y, length x angle), in frames where lengths are about 1
(`pose_error.error_frames`), and near means a small Euclidean distance of rows.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from burmester.fourbar.coupler_kernel import walk
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle

MAX_NEWTON_STEPS: Final = 30  # number of steps to a foot point at most
CONVERGED_STEP: Final = 1e-12  # relative; after a smaller step the next would be rounding
SLOW_RESIDUAL: Final = 1e-9  # lengths; an end of slow steps with less counts as on the linkage
# Squared sine between the dyads' forces.  Forces with a smaller one count as having this one.
PARALLEL_FORCES: Final = 1e-20
TINY: Final = float(np.finfo(np.float64).tiny)  # keeps what is above zero from dividing by zero


class ConstraintNormals(NamedTuple):
    """Normals of both dyads' constraints at places (*,), in the space of (x, y, length x angle).

    residual: (*, 2), of the constraint equations.
    force: (*, 2, 3), their gradients.
    gram: (*, 3), the products 11, 12, 22 of the forces; det: (*,), their determinant, above zero.
    """

    residual: FloatArray
    force: FloatArray
    gram: FloatArray
    det: FloatArray

    def solve(self, right: FloatArray) -> FloatArray:
        """The coefficients x (*, 2) of the forces with gram x = right (*, 2)."""
        a, b, c = np.moveaxis(self.gram, -1, 0)
        first, second = right[..., 0], right[..., 1]
        coefficients = np.stack([c * first - b * second, a * second - b * first], axis=-1)
        return np.asarray(coefficients / self.det[..., None])

    @property
    def tangent(self) -> FloatArray:
        """The unit direction (*, 3) in which the coupler can move."""
        cross = np.cross(self.force[..., 0, :], self.force[..., 1, :])
        return np.asarray(cross / np.sqrt(self.det)[..., None])


def constraint_normals(residual: FloatArray, force: FloatArray, length: float) -> ConstraintNormals:
    """The normals, from residuals (k, 2, *) and forces (k, 2, *, 3) of `LinkageBatch.jacobians`."""
    force = np.moveaxis(force, 1, -2) / np.array([1.0, 1.0, length])
    one, two = force[..., 0, :], force[..., 1, :]
    a, b, c = (np.einsum("...i,...i->...", *pair) for pair in ((one, one), (one, two), (two, two)))
    det = np.maximum(a * c - b * b, PARALLEL_FORCES * a * c) + TINY
    return ConstraintNormals(np.moveaxis(residual, 1, -1), force, np.stack([a, b, c], axis=-1), det)


def rows_of(places: Displacement, length: float) -> FloatArray:
    """Places (*,) as rows (*, 3) of x, y, length x angle."""
    return np.concatenate([places.translation, length * places.angle[..., None]], axis=-1)


def places_of(rows: FloatArray, length: float) -> Displacement:
    """Rows (*, 3) of x, y, length x angle as places (*,): the inverse of `rows_of`."""
    return Displacement(rows[..., :2], rows[..., 2] / length)


def wrapped(gap: FloatArray, length: float) -> FloatArray:
    """Differences (*, 3) of such rows, with angles reduced to half a turn."""
    gap = gap.copy()
    gap[..., 2] = length * wrapped_angle(gap[..., 2] / length)
    return gap


def foot_points(
    batch: LinkageBatch,
    start: FloatArray,
    target: FloatArray,
    length: float,
    *,
    max_steps: int = MAX_NEWTON_STEPS,
    converged_step: float = CONVERGED_STEP,
) -> FloatArray:
    """The places (k, n, 3) of linkages (k,) nearest to target (n, 3), from starts (k, n, 3).

    By Newton's method (`newton_steps`), so each is the end of a descent from its start and may be a
    local minimum.  nan where the method does not converge on the linkage.
    """
    ends, size = newton_steps(batch, start, target, length, steps=max_steps, close=converged_step)
    settled = size <= converged_step * (1 + np.abs(ends).max(axis=-1, initial=0.0))
    if not settled.all():  # slow ones count where they are on the linkage
        residual = batch.jacobians(places_of(ends, length)).residual
        ends[~(settled | (np.abs(residual) < SLOW_RESIDUAL).all(axis=1))] = np.nan
    return ends


def newton_steps(
    batch: LinkageBatch,
    start: FloatArray,
    target: FloatArray | None,
    length: float,
    *,
    steps: int = 1,
    close: float = 0.0,
) -> tuple[FloatArray, FloatArray]:
    """The rows (k, n, 3) after Newton's steps from start, and the sizes (k, n) of the last ones.

    Back onto both manifolds, and along their intersection to the places nearest to target
    (broadcast); None: straight ahead.  Steps longer than 0.3 lengths are shortened to it, their
    sizes are told as they were.  Each place until its step is at most `close`, relative to 1 plus
    the greatest number in its row.
    """
    rows, size = np.array(start, dtype=float), np.empty(start.shape[:-1])
    to = rows if target is None else np.broadcast_to(target, rows.shape)
    walk(batch.kinds, batch.dimensions, rows, to, length, target is None, steps, close, size)
    return rows, size
