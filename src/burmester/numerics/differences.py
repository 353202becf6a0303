"""Derivatives by difference quotients: points beside a point, and the Jacobian they give."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.numerics.arrays import FloatArray


class DifferenceQuotients(NamedTuple):
    """A way to take derivatives: function values at `points` make the `jacobian`.

    stride: the length of a step, in units of the directions.
    central: steps both ways, with an error of second order; else only ahead, with one of first
    order, and the point itself comes first.
    """

    stride: float
    central: bool = False

    def points(self, x: FloatArray, directions: FloatArray) -> FloatArray:
        """The points at which the function is needed, for x (*) and directions (d, *).

        Returns (2 d, *), those ahead before those behind, or (1 + d, *), x itself before those
        ahead.  The leading axes of x and of a direction broadcast.
        """
        ahead = x + self.stride * directions
        if self.central:
            return np.concatenate([ahead, x - self.stride * directions])
        return np.concatenate([np.broadcast_to(x, (1, *ahead.shape[1:])), ahead])

    def jacobian(self, values: FloatArray) -> FloatArray:
        """The derivatives (*, d) along the directions, from function values at the points."""
        if self.central:
            ahead, behind = np.split(values, 2)
            quotients = (ahead - behind) / (2 * self.stride)
        else:
            quotients = (values[1:] - values[0]) / self.stride
        return np.asarray(np.moveaxis(quotients, 0, -1))
