"""The transmission angle and the input of linkages at places, and how both change.

Places are rows (x, y, length x angle), see `foot_points`.  The driver (k,) is the side, 0 or 1,
that drives.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.coupler_kernel import (
    least_transmissions,
    transmission_slopes,
    transmissions,
)
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.numerics.arrays import FloatArray


class Transmission(NamedTuple):
    """Linkages (k,) at places (k, N).

    sine: (k, N), of the transmission angle, signed.  It changes its sign at the dead points of the
    driver.  It is the power that the driver transmits: the determinant of three wrenches (the
    driver's effort and both constraints), over its lever.
    drive: (k, N), the input, see `loop_closure`; turns: (k,), whether it is an angle.

    Formula `signed-transmission` of the theory.
    """

    sine: FloatArray
    drive: FloatArray
    turns: NDArray[np.bool_]

    @classmethod
    def of(
        cls, batch: LinkageBatch, rows: FloatArray, length: float, driver: NDArray[np.intp]
    ) -> Transmission:
        """At rows (k, N, 3)."""
        sine, drive = np.empty((2, *rows.shape[:2]))
        transmissions(batch.kinds, batch.dimensions, rows, length, driver, sine, drive)
        return cls(sine, drive, batch.kinds[np.arange(len(batch)), driver] != 1)

    @classmethod
    def differentiated(
        cls,
        batch: LinkageBatch,
        rows: FloatArray,
        length: float,
        driver: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> tuple[Transmission, FloatArray, FloatArray]:
        """Also the derivatives (k, N, n) of sine and drive, as difference quotients.

        place_jacobian: (k, N, 3, n), of the rows by the unknowns: the ten dimensions, and if n is
        more, a step along the motion for each place.
        """
        shape, own = rows.shape[:2], 2 * DIMENSIONS
        sine, drive = np.empty((2, *shape))
        slopes = np.empty((2, *shape, own + 1))
        transmission_slopes(
            *(batch.kinds, batch.dimensions, rows, place_jacobian, length, driver),
            *(sine, drive, *slopes),
        )
        out = np.zeros((2, *shape, place_jacobian.shape[-1]))
        out[..., :own] = slopes[..., :own]
        if place_jacobian.shape[-1] > own:
            each = np.arange(shape[1])
            out[:, :, each, own + each] = slopes[..., own]
        turns = batch.kinds[np.arange(len(batch)), driver] != 1
        return cls(sine, drive, turns), out[0], out[1]


class LeastTransmission(NamedTuple):
    """Where the transmission angle of linkages (k,) may be least between two places.

    at: (k, 2), inputs, the ends of the range of f (see `loop_closure`); nan for pairs without such
    a minimum.  cosine: (k, 2), of the transmission angle there, above 1 where the linkage does not
    close; slope: (k, 2, 10), its derivatives by the dimensions.
    """

    at: FloatArray
    cosine: FloatArray
    slope: FloatArray

    @classmethod
    def of(cls, batch: LinkageBatch, driver: NDArray[np.intp]) -> LeastTransmission:
        """That of linkages (k,)."""
        at, cosine = np.empty((2, len(batch), 2))
        slope = np.empty((len(batch), 2, 2 * DIMENSIONS))
        least_transmissions(batch.kinds, batch.dimensions, driver, at, cosine, slope)
        return cls(np.where(np.isnan(cosine), np.nan, at), cosine, slope)
