"""The figures by which linkages of any kind are held to what is asked."""

from __future__ import annotations

import math
from collections.abc import Set
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from burmester.fourbar.linkage import TYPES
from burmester.numerics.arrays import FloatArray

Values: TypeAlias = Any  # a number, or an array (*,) of them


class Figures(NamedTuple):
    """What linkages (*,) measure and do; nan where they have no such figure.

    transmission: the least angle over the range, radians.
    shortest, longest: of the links, lengths; ratio: of four links, the longest to the shortest.
    change: the least Grashof excess, as a share of all four links.
    type: a number in `fourbar.linkage.TYPES`.  turns: whether the driver turns fully.
    outside: how far a pivot leaves the footprint, a length; pivot: which one, in words.
    extent: of all joints over the range, a length.
    hand_force, driver_torque, pin_force: the greatest magnitudes under loads, N or N m; hand_least,
    hand_greatest: of a hand on the way from the first pose to the last, with its sign; stays: the
    poses at which it stays, by name and number; closes: how far the body is turned from the first
    pose and still closes by itself, radians; body_speed, body_acceleration: the greatest.
    joints: whether lengths are distances between joints of links with more than two.
    """

    transmission: Values = math.nan
    shortest: Values = math.nan
    longest: Values = math.nan
    ratio: Values = math.nan
    change: Values = math.nan
    type: Values = -1
    turns: Values = True
    outside: Values = 0.0
    pivot: str = ""
    extent: Values = math.nan
    joints: bool = False
    hand_force: Values = math.nan
    hand_least: Values = math.nan
    hand_greatest: Values = math.nan
    driver_torque: Values = math.nan
    pin_force: Values = math.nan
    stays: frozenset[str] | None = None
    closes: Values = math.nan
    body_speed: Values = math.nan
    body_acceleration: Values = math.nan

    @property
    def none(self) -> FloatArray:
        """That nothing is exceeded, (*,)."""
        return np.zeros(np.shape(self.transmission))

    @property
    def type_name(self) -> str:
        """The type of one linkage."""
        return TYPES[int(self.type)]

    def is_not(self, types: Set[str]) -> FloatArray:
        """Of which linkages (*,) the type is none of these: 1, else 0."""
        return np.array([float(name not in types) for name in TYPES])[self.type]

    @staticmethod
    def below(figure: Values, bound: float) -> FloatArray:
        """How far figures (*,) are below a bound, as logarithms of ratios; nan is not."""
        with np.errstate(divide="ignore"):
            return np.asarray(np.log(np.fmax(bound / np.maximum(figure, 1e-300), 1.0)))

    @staticmethod
    def beyond(figure: Values, bound: float) -> FloatArray:
        """How far figures (*,) are above a bound, as logarithms of ratios; nan is not."""
        with np.errstate(divide="ignore"):  # of poses at one place the bound is zero
            return np.asarray(np.log(np.fmax(np.asarray(figure) / bound, 1.0)))

    @staticmethod
    def lack(figure: Values, bound: float, unknown: float = 0.0) -> FloatArray:
        """How much figures (*,) are less than a bound; unknown: what nan lacks."""
        short = bound - np.asarray(figure)
        return np.where(np.isnan(short), unknown, np.maximum(short, 0.0))
