"""The force of a spring by its length, and its energy; SI units.

A gas spring is a line through its two nominal forces, 5 mm before each end of its stroke, as makers
print them; they grow with the absolute temperature.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import ROOM_CELSIUS, Spring

NOMINAL: Final = 5e-3  # metres before the ends of the stroke at which a gas spring is measured
ZERO_CELSIUS: Final = 273.15  # K


class SpringLaw(NamedTuple):
    """A straight line: tension = rest + rate (length - start), nowhere below `least`.

    Tension in N pulls both ends together; it is negative where the spring pushes.
    least, most: of the tension; a coil spring neither pushes nor pulls beyond its free length.
    """

    rest: float
    rate: float
    start: float
    least: float = -np.inf
    most: float = np.inf

    @classmethod
    def of(cls, spring: Spring, metre: float, celsius: float) -> SpringLaw:
        """The law of all `count` springs together; metre: the task's unit of lengths in metres."""
        many = float(spring.count)
        if spring.kind == "gas":
            warm = many * (celsius + ZERO_CELSIUS) / (ROOM_CELSIUS + ZERO_CELSIUS)
            longest, stroke = spring["length"] * metre, spring["stroke"] * metre
            first, last = spring["force_N"] * warm, spring["compressed_force_N"] * warm
            rate = (last - first) / max(stroke - 2 * NOMINAL, stroke / 10)
            return cls(-first, rate, longest - NOMINAL)
        if spring.kind == "constant":
            return cls(many * spring["force_N"], 0.0, 0.0)
        rate = many * spring["rate_N_per_mm"] * 1000
        free = spring["free_length"] * metre
        if spring.kind == "extension":
            initial = many * spring["initial_N"]
            return cls(initial, rate, free, least=0.0 if free > 0 else -np.inf)
        return cls(0.0, rate, free, most=0.0)

    @property
    def slack(self) -> float:
        """The length in metres at which it begins to pull or to push; inf where it always does."""
        cut = [each for each in (self.least, self.most) if np.isfinite(each)]
        return self.start + (cut[0] - self.rest) / self.rate if cut else np.inf

    def tension(self, length: FloatArray) -> FloatArray:
        """At lengths (*,) in metres: (*,) in N."""
        line = self.rest + self.rate * (length - self.start)
        return np.clip(line, self.least, self.most)

    def energy(self, length: FloatArray) -> FloatArray:
        """What is stored at lengths (*,), in J, up to a constant."""
        longer = length - self.start
        if self.rate != 0:  # beyond where the line is cut off, at zero, the energy stays
            low, high = sorted((each - self.rest) / self.rate for each in (self.least, self.most))
            longer = np.clip(longer, low, high)
        return np.asarray(longer * (self.rest + self.rate * longer / 2))

    def off(self, length: FloatArray, span: tuple[float, float]) -> NDArray[np.bool_]:
        """Whether lengths (*,) are beyond what the spring allows: least and greatest, in metres."""
        slack = 1e-9 * max(span[1] if np.isfinite(span[1]) else span[0], 1e-3)
        return (length < span[0] - slack) | (length > span[1] + slack)
