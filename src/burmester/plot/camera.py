"""A camera before a box of the image space, and the chart in which the box lies.

Drawings are made in the chart Z4 = 1: a displacement is the point (Z1/Z4, Z2/Z4, Z3/Z4), the last
being the tangent of half its angle.  Half turns are at infinity there.  For the eye, the box is
scaled so that Z1 and Z2 keep one scale and Z3, which is no length, has its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.numerics.arrays import FloatArray

MARGIN = 0.12  # share of the points' extent left free around them


def chart(points: ArrayLike) -> FloatArray:
    """Image points (*, 4) in the chart Z4 = 1: (*, 3); not finite at half turns."""
    z = np.asarray(points, dtype=np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(z[..., :3] / z[..., 3:])


@final
@dataclass(frozen=True, slots=True, eq=False)
class Box:
    """A box of the chart Z4 = 1 of the image space, and its proportions in a picture.

    Attributes
    ----------
    low, high : (3,) array
        Two opposite corners.
    height : float
        Height of Z3 in the picture, where the longer side of Z1 and Z2 has the length 2.

    Raises
    ------
    ValueError
        Where the corners are not of shape (3,), or the first is not the lower one.

    Examples
    --------
    >>> from burmester import plot
    >>> plot.Box([-1, -1, 0], [1, 1, 2]).half.tolist()
    [1.0, 1.0, 1.0]
    """

    low: FloatArray
    high: FloatArray
    height: float = 2.0

    def __post_init__(self) -> None:
        low, high = (np.asarray(v, dtype=np.float64) for v in (self.low, self.high))
        if low.shape != (3,) or high.shape != (3,) or not (high > low).all():
            raise ValueError("a box needs two corners of shape (3,), the lower one first")
        object.__setattr__(self, "low", low)
        object.__setattr__(self, "high", high)

    @classmethod
    def around(cls, points: ArrayLike, room: float = MARGIN, height: float = 2.0) -> Self:
        """The box around finite points (*, 3) of the chart, equally wide in Z1 and Z2."""
        p = np.asarray(points, dtype=np.float64).reshape(-1, 3)
        p = p[np.isfinite(p).all(axis=-1)]
        low, high = p.min(axis=0), p.max(axis=0)
        half = (high - low) / 2
        half[:2] = half[:2].max()
        half = np.where(half > 0, half, 1.0) * (1 + 2 * room)
        middle = (low + high) / 2
        return cls(middle - half, middle + half, height)

    @property
    def scale(self) -> FloatArray:
        """What the axes (3,) are multiplied by for the eye."""
        size = self.high - self.low
        flat = 2.0 / float(size[:2].max())
        return np.array([flat, flat, self.height / float(size[2])])

    @property
    def half(self) -> FloatArray:
        """Half of the sides (3,) that the eye sees; the middle is its origin."""
        return np.asarray((self.high - self.low) / 2 * self.scale)

    def to_box(self, points: ArrayLike) -> FloatArray:
        """Points (*, 3) of the chart, as the eye has them."""
        p = np.asarray(points, dtype=np.float64)
        return np.asarray((p - (self.low + self.high) / 2) * self.scale)

    def forms(self, matrices: ArrayLike) -> FloatArray:
        """Quadrics (*, 4, 4) of the image space, as forms in (seen point, 1)."""
        back = np.diag([*(1 / self.scale), 1.0])
        back[:3, 3] = (self.low + self.high) / 2
        return np.asarray(back.T @ np.asarray(matrices, dtype=np.float64) @ back)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Camera:
    """The eye, and the picture's plane through the middle of the box.

    A point of the picture (x, y) is seen along the ray eye + t (ahead + x right + y up); it lies in
    the plane at t = 1.

    Attributes
    ----------
    eye : (3,) array
        The position of the eye.
    right, up : (3,) array
        Unit vectors of the plane.
    ahead : (3,) array
        From the eye to the middle of the box.

    Examples
    --------
    >>> import math
    >>> from burmester import plot
    >>> plot.Camera.at(0.0, math.pi / 2).eye.round(9).tolist()
    [0.0, 0.0, 9.0]
    """

    eye: FloatArray
    right: FloatArray
    up: FloatArray
    ahead: FloatArray

    @classmethod
    def at(cls, azimuth: float, elevation: float, distance: float = 9.0) -> Self:
        """From a direction, in radians: azimuth from the Z1 axis towards Z2, elevation above."""
        ca, sa, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
        eye = distance * np.array([ce * ca, ce * sa, se])
        return cls(eye, np.array([-sa, ca, 0.0]), np.array([-se * ca, -se * sa, ce]), -eye)

    def directions(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Of the rays of picture points (*,): (*, 3)."""
        return np.asarray(self.ahead + x[..., None] * self.right + y[..., None] * self.up)

    def project(self, points: FloatArray) -> FloatArray:
        """Where points (*, 3) are in the picture, and at which t of their rays: (*, 3)."""
        away = points - self.eye
        t = away @ self.ahead / (self.ahead @ self.ahead)
        return np.stack([away @ self.right / t, away @ self.up / t, t], axis=-1)
