"""Foot points: the places of a linkage's coupler nearest to given ones, by Newton's method.

Places are rows (x, y, length x angle), in frames where lengths are about 1
(`pose_error.error_frames`), and near means a small Euclidean distance of rows.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from burmester.fourbar.linkage_batch import ConstraintForms, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, complex_of, wrapped_angle
from burmester.numerics.bundles import take

__all__ = [
    "ConstraintNormals",
    "constraint_normals",
    "foot_points",
    "newton_step",
    "places_of",
    "rows_of",
    "wrapped",
]

MAX_NEWTON_STEPS: Final = 30  # number of steps to a foot point at most
MAX_STEP_LENGTH: Final = 0.3  # lengths; a longer step is shortened to it
CONVERGED_STEP: Final = 1e-12  # relative; after a smaller step the next would be rounding
SLOW_RESIDUAL: Final = 1e-9  # lengths; an end of slow steps with less counts as on the linkage
MIN_CURVATURE: Final = 0.2  # floor on the curvature of half the squared distance along the circuit
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

    By Newton's method (`newton_step`), so each is the end of a descent from its start and may be a
    local minimum.  nan where the method does not converge on the linkage.
    """
    shape = start.shape
    linkage = np.repeat(np.arange(len(batch)), shape[1])
    ends, target = start.reshape(-1, 3).copy(), np.broadcast_to(target, shape).reshape(-1, 3)
    run = np.flatnonzero(np.isfinite(ends).all(axis=-1))
    converged = np.zeros(len(ends), dtype=bool)
    every = batch.forms()
    forms, here, wanted = take(every, linkage[run]), ends[run, None], target[run, None]
    for _ in range(max_steps):
        step, size = newton_step(forms, here, wanted, length)
        here = here + step
        moving = size[:, 0] > converged_step * (1 + np.abs(here[:, 0]).max(axis=-1))
        if not moving.all():
            ends[run[~moving]], converged[run[~moving]] = here[~moving, 0], True
            run, forms = run[moving], take(forms, moving)
            here, wanted = here[moving], wanted[moving]
        if not len(run):
            break
    ends[run] = here[:, 0]
    if len(run):  # slow ones count where they are on the linkage
        d, turn = complex_of(ends[run, None]), np.exp(1j * ends[run, None, 2] / length)
        residual, _, _ = take(every, linkage[run]).at(d[:, None], turn[:, None])
        converged[run] = (np.abs(residual) < SLOW_RESIDUAL).all(axis=(1, 2))
    ends[~converged] = np.nan
    return ends.reshape(shape)


def newton_step(
    forms: ConstraintForms, here: FloatArray, target: FloatArray, length: float
) -> tuple[FloatArray, FloatArray]:
    """The step (k, n, 3) from rows (k, n, 3) towards foot points, and its size (k, n).

    Back onto both manifolds, and along their intersection to the place nearest to target
    (k, n, 3).
    """
    d, turn = complex_of(here)[:, None], np.exp(1j * here[:, None, :, 2] / length)
    residual, force, swing = forms.at(d, turn)
    moment = -swing.imag / length
    f1, f2, force1, force2 = residual[:, 0], residual[:, 1], force[:, 0], force[:, 1]
    moment1, moment2 = moment[:, 0], moment[:, 1]
    to = target - here
    to_d, to_a = complex_of(to), to[..., 2]
    a = force1.real**2 + force1.imag**2 + moment1**2
    c = force2.real**2 + force2.imag**2 + moment2**2
    mixed = force1.conj() * force2
    b = mixed.real + moment1 * moment2
    det = np.maximum(a * c - b * b, PARALLEL_FORCES * a * c) + TINY
    # The target's distance as a combination of both forces, and the manifolds' curvature under it.
    product1 = (force1.conj() * to_d).real + moment1 * to_a
    product2 = (force2.conj() * to_d).real + moment2 * to_a
    along, omega = -1j * (force1 * moment2 - force2 * moment1), mixed.imag
    bend = forms.bend(turn, swing, along[:, None], omega[:, None] / length)
    coefficient1, coefficient2 = c * product1 - b * product2, a * product2 - b * product1
    curvature = 1 + (coefficient1 * bend[:, 0] + coefficient2 * bend[:, 1]) / det**2
    distance = (along.conj() * to_d).real + omega * to_a
    distance = distance / det / np.maximum(curvature, MIN_CURVATURE)
    back1, back2 = (c * f1 - b * f2) / det, (a * f2 - b * f1) / det
    step_d = distance * along - back1 * force1 - back2 * force2
    step_a = distance * omega - back1 * moment1 - back2 * moment2
    step = np.stack([step_d.real, step_d.imag, step_a], axis=-1)
    size = np.abs(step).max(axis=-1)
    part = np.minimum(1.0, MAX_STEP_LENGTH / np.maximum(size, MAX_STEP_LENGTH))
    return step * part[..., None], size
