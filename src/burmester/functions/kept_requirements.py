"""What a function generator has to keep, as constraints of its descent.

All are inequalities w <= 0 in the logarithms of the links and the phases, with their derivatives:
the transmission angle where it is extreme over the range, the ratios of links, and the signs of
the sums that tell Grashof's type.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from burmester.fourbar.linkage import GRASHOF_SUMS, TYPE_OF_SIGNS
from burmester.functions.generator import Generator
from burmester.numerics.arrays import FloatArray

MOST_SIZE: Final = 10.0  # ground links; no link is longer, and none shorter than its inverse
LEAST_TRANSMISSION: Final = np.radians(1.0)  # is kept always: who locks sooner is of no use
SPARE: Final = 1e-6  # of each constraint: what is broken by less is kept
SPARE_TYPE: Final = 1e-3  # of all links together; a linkage nearer to a change point may be either
PAIRS: Final = np.array([(i, j) for i in range(4) for j in range(4) if i != j])  # of links


class KeptRequirements(NamedTuple):
    """What generators (k,) have to keep.

    transmission: (k,), radians, at least, over the range; ratio: (k,), of the longest link to the
        shortest, at most.
    types: those allowed; None: all.
    """

    transmission: FloatArray
    ratio: FloatArray
    types: frozenset[str] | None = None

    def constraints(self, g: Generator, low: float, high: float) -> tuple[FloatArray, FloatArray]:
        """The values (k, M) over inputs from low to high, at most 0 where all is kept.

        Returns them and their derivatives (k, M, 5) by the logarithms of input link, coupler and
        output link, and by the phases.
        """
        parts = [self._transmissions(g, low, high), self._ratios(g)]
        if self.types is not None:
            parts.append(self._types(g, self.types))
        values, slopes = zip(*parts, strict=True)
        return np.concatenate(values, axis=1) + SPARE, np.concatenate(slopes, axis=1)

    def _transmissions(
        self, g: Generator, low: float, high: float
    ) -> tuple[FloatArray, FloatArray]:
        """Of the cosine of the angle between coupler and output link, from both sides.

        It is extreme at the ends of the range, or where the input link is in line with the ground
        link; such a place outside of the range counts as the first end.
        """
        a, r, b = (v[:, None] for v in (g.input_link, g.coupler, g.output_link))
        first = (g.input_phase + low)[:, None]
        ahead = np.mod(np.array([0.0, np.pi]) - first, 2 * np.pi)
        ahead = np.where(ahead <= high - low, ahead, 0.0)
        ends = np.broadcast_to([0.0, high - low], (len(g), 2))
        theta = first + np.concatenate([ends, ahead], axis=1)
        twice = 2 * r * b
        cosine = (r * r + b * b - 1 - a * a + 2 * a * np.cos(theta)) / twice
        slope = np.zeros((*cosine.shape, 5))
        slope[..., 0] = 2 * a * (np.cos(theta) - a) / twice
        slope[..., 1] = r / b - cosine
        slope[..., 2] = b / r - cosine
        slope[..., 3] = -2 * a * np.sin(theta) / twice
        most = np.cos(np.maximum(self.transmission, LEAST_TRANSMISSION))[:, None]
        return (
            np.concatenate([cosine - most, -cosine - most], axis=1),
            np.concatenate([slope, -slope], axis=1),
        )

    def _ratios(self, g: Generator) -> tuple[FloatArray, FloatArray]:
        size = np.log(g.sizes)
        with_ground = (PAIRS == 0).any(axis=1)
        most = np.log(np.minimum(self.ratio, MOST_SIZE**2))[:, None]
        most = np.where(with_ground, np.minimum(most, np.log(MOST_SIZE)), most)
        slope = np.zeros((len(PAIRS), 5))
        every = np.arange(len(PAIRS))
        for column, sign in ((0, 1.0), (1, -1.0)):
            link = PAIRS[:, column] - 1
            slope[every[link >= 0], link[link >= 0]] += sign
        value = size[:, PAIRS[:, 0]] - size[:, PAIRS[:, 1]] - most
        return value, np.broadcast_to(slope, (len(g), *slope.shape))

    def _types(self, g: Generator, types: frozenset[str]) -> tuple[FloatArray, FloatArray]:
        """Of the sums that tell the type: those of the allowed type that is nearest."""
        signs = np.array([s for s, name in TYPE_OF_SIGNS.items() if name in types], dtype=float)
        size = g.sizes
        whole = size.sum(axis=1)[:, None]
        sums = size @ GRASHOF_SUMS.T / whole
        slope = (GRASHOF_SUMS * size[:, None, :] - sums[..., None] * size[:, None, :]) / (
            whole[..., None]
        )
        off = np.maximum(SPARE_TYPE - signs * sums[:, None, :], 0.0).sum(axis=2)
        sign = signs[off.argmin(axis=1)]
        slopes = np.zeros((len(g), 3, 5))
        slopes[..., :3] = -sign[..., None] * slope[..., 1:]
        return SPARE_TYPE - sign * sums, slopes
