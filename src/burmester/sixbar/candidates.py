"""Six-bars of many chains, judged at once, with the figures by which they are chosen."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, concatenate
from burmester.requirements.figures import Figures, Values
from burmester.requirements.requirement import Bounds
from burmester.requirements.table import excess, standard
from burmester.requirements.transmission import TRANSMISSION
from burmester.sixbar.added_dyads import FourBars, ThreeRChain, with_first_dyad, with_second_dyad
from burmester.sixbar.kinds import SixBar
from burmester.sixbar.travel import first_loop_works, least_transmission, travel
from burmester.sixbar.watt import WATT_I, Sides, WattLinkage, joints_at, sides_of

PLACES = 33  # along the range, at which the extent is looked at


@final
class Conditions(NamedTuple):
    """What six-bars must be.

    crank: whether the driver must turn fully; any_order: whether the poses may be met in any order.
    asked: what else is asked.
    """

    crank: bool = False
    any_order: bool = False
    asked: Bounds = MappingProxyType({})


@final
class Candidates(NamedTuple):
    """Six-bars (n,) of one class that work, each with one driver.

    chain: (n,), which of the chains given; design: (n,), a number that the drivers of one six-bar
    share; designs: how many six-bars were judged in all.
    joints: (n, N, 7), at the poses; driver: (n,), its number among the skeleton's.
    transmission: (n,), radians; extent: (n,), a length.
    """

    chain: NDArray[np.intp]
    design: NDArray[np.intp]
    linkages: SixBar
    joints: ComplexArray
    driver: NDArray[np.intp]
    transmission: FloatArray
    extent: FloatArray
    designs: int

    @property
    def figures(self) -> Figures:
        """What they measure (n,)."""
        return figures_of(self.linkages, self.transmission, True, self.extent)

    def merit(self, size: float) -> FloatArray:
        """What a search climbs (n,): the least transmission angle, degrees, less the excess."""
        return merit_of(self.figures, size)


def merit_of(figures: Figures, size: float) -> FloatArray:
    """How good figures (*,) are: degrees of transmission, less what is beyond the standard.

    size: of the motion.
    """
    beyond = excess(standard({}, size, (TRANSMISSION,)), figures)
    return np.asarray(np.degrees(figures.transmission) - TRANSMISSION.standard * beyond)


def figures_of(
    linkage: SixBar, transmission: Values, turns: Values, extent: Values = math.nan
) -> Figures:
    """The figures of six-bars (*,) by which they are held to what is asked.

    transmission: the least angle of both loops over the range, radians.
    """
    lengths = linkage.lengths()
    least, most = lengths.min(axis=-1), lengths.max(axis=-1)
    return Figures(transmission, least, most, most / least, turns=turns, extent=extent, joints=True)


def watt_candidates(
    chains: ThreeRChain, poses: Displacement, side: FloatArray, conditions: Conditions
) -> Candidates:
    """All Watt I six-bars of chains (k,) through poses (k, N = 5) that work with a driver.

    Of the conditions only that on the driver and the order are asked here.
    side: (k,), of the elbow.  A four-bar whose poses no driver reaches is not gone on with.
    """
    order = {"any_order": conditions.any_order}
    bars = with_first_dyad(chains, poses, side)
    good = np.zeros(len(bars.task), dtype=bool)
    for driver in WATT_I.drivers:
        good |= first_loop_works(bars.joints, driver, **order)
    bars = FourBars(bars.task[good], bars.joints[good], bars.dyad[good])
    added = with_second_dyad(chains[bars.task], poses[bars.task], bars)
    chain = bars.task[added.task]
    linkages, joints = added.linkages, added.joints
    parts = []
    for number, driver in enumerate(WATT_I.drivers):
        way = travel(linkages, joints, driver, **order)
        at = np.flatnonzero(way.works & (way.turns_fully | (not conditions.crank)))
        drive, links, there = way.drive[at], linkages[at], joints[at]
        parts.append(
            Candidates(
                chain=chain[at],
                design=at,
                linkages=links,
                joints=there,
                driver=np.full(len(at), number),
                transmission=least_transmission(links, drive, driver, there),
                extent=extent_of(links, drive, driver, there),
                designs=len(added.task),
            )
        )
    return concatenate(parts)


def extent_of(
    linkage: WattLinkage, drive: FloatArray, driver: str, joints: ComplexArray
) -> FloatArray:
    """The diagonals (n,) of the boxes around all joints at places along the range.

    drive: (n, N), joints: (n, N, 7), at the poses.
    """
    steps, (first, second) = steps_along(drive), sides_of(joints[:, :1], driver)
    return box_diagonal(joints_at(linkage[:, None], steps, Sides(first, second), driver))


def steps_along(drive: FloatArray) -> FloatArray:
    """Even steps (n, places) over the range of drives (n, N)."""
    low, high = drive.min(axis=-1)[:, None], drive.max(axis=-1)[:, None]
    return np.asarray(low + (high - low) * np.linspace(0, 1, PLACES))


def box_diagonal(joints: ComplexArray) -> FloatArray:
    """The diagonals (*,) of the boxes around joints (*, places, j)."""
    # An end of the range that is beside a dead point may be nan by rounding.
    width, height = (
        np.fmax.reduce(part, axis=(-2, -1)) - np.fmin.reduce(part, axis=(-2, -1))
        for part in (joints.real, joints.imag)
    )
    return np.asarray(np.hypot(width, height))
