"""Points of one rigid body in the plane, measured again and again: their shape and its places."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

MAX_ROUNDS = 100  # of turning all places to the mean shape; a few are enough where noise is small
TURN_TOLERANCE = 1e-14  # radians; the rounds end with a lesser turn


class RigidFit(NamedTuple):
    """The places of a body, in its frame with origin at point 1 and x axis towards point 2."""

    poses: Displacement
    residuals: FloatArray  # (N, K, 2), measured minus fitted points, in the frame of the body
    shape: FloatArray  # (K, 2), the points in the frame of the body
    noise: float  # standard deviation of a coordinate

    @property
    def rms(self) -> float:
        """The root mean square distance between measured and fitted points."""
        return float(np.sqrt((self.residuals**2).sum(axis=2).mean()))

    @property
    def sigma(self) -> tuple[float, float]:
        """Standard deviations of a coordinate of the origin, and of the angle in radians."""
        about_centre = self.shape - self.shape.mean(axis=0)
        inertia = float((about_centre**2).sum())
        arm = float((about_centre[0] ** 2).sum())
        origin = self.noise * np.sqrt(1 / len(self.shape) + arm / (2 * inertia))
        return float(origin), float(self.noise / np.sqrt(inertia))


def fit_rigid_body(points: FloatArray) -> RigidFit:
    """The rigid body nearest to points, in the sense of least squares (Procrustes).

    points: (N, K, 2), K >= 2 points in N places; they do not all coincide.
    Shape and places are fitted together: the shape is the mean of the places turned onto it.
    """
    z = points[..., 0] + 1j * points[..., 1]
    centre = z.mean(axis=1, keepdims=True)
    z = z - centre
    shape = z[0]
    for _ in range(MAX_ROUNDS):
        turn = _direction(z @ shape.conj())
        mean = (z * turn.conj()[:, None]).mean(axis=0)
        change = _direction(np.vdot(shape, mean)[None])[0]
        moved = float(np.abs(mean - shape * change).max())
        shape = mean
        if moved <= TURN_TOLERANCE * float(np.abs(shape).max()):
            break
    axis = _direction((shape[1] - shape[0])[None])[0]
    shape = shape / axis
    turn = _direction(z @ shape.conj())
    origin = centre[:, 0] + turn * shape[0]
    residuals = z * turn.conj()[:, None] - shape
    count, size = z.shape
    freedom = 2 * count * size - 3 * count - (2 * size - 3)
    squares = float((np.abs(residuals) ** 2).sum())
    noise = float(np.sqrt(squares / freedom)) if freedom > 0 else 0.0
    return RigidFit(
        Displacement(_pairs(origin), np.angle(turn)),
        _pairs(residuals),
        _pairs(shape - shape[0]),
        noise,
    )


def _direction(z: np.ndarray) -> np.ndarray:
    """Complex numbers divided by their sizes; 1 for 0."""
    size = np.abs(z)
    return np.where(size > 0, z / np.where(size > 0, size, 1), 1)


def _pairs(z: np.ndarray) -> FloatArray:
    return np.stack([z.real, z.imag], axis=-1)
