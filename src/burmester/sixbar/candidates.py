"""Six-bars of many chains, judged at once, with the figures by which they are chosen."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.requirements.figures import Figures, Values
from burmester.requirements.requirement import Bounds
from burmester.requirements.table import excess, standard
from burmester.requirements.transmission import TRANSMISSION
from burmester.sixbar.added_dyads import FourBars, with_first_dyad, with_second_dyad
from burmester.sixbar.motion import Sides, joints_at
from burmester.sixbar.three_r_chain import ThreeRChain
from burmester.sixbar.travel import first_loop_works, least_transmission, travel
from burmester.sixbar.watt import JOINTS, Drive, WattLinkage

__all__ = [
    "DRIVERS",
    "Candidates",
    "Conditions",
    "candidates",
    "extent_of",
    "figures_of",
    "joined",
]

PLACES = 33  # along the range, at which the extent is looked at
COLUMNS = "chain", "design", "joints", "driver", "drive", "room", "transmission", "extent"
DRIVERS: tuple[Drive, ...] = ("first", "second")


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
    """Six-bars (n,) that work, each with one driver.

    chain: (n,), which of the chains given; design: (n,), a number that the two drivers of one
    six-bar share; designs: how many six-bars were judged in all.
    joints: (n, N, 7), at the poses.  transmission: (n,), radians; extent: (n,), a length.
    """

    chain: NDArray[np.intp]
    design: NDArray[np.intp]
    linkages: WattLinkage
    joints: ComplexArray
    driver: NDArray[np.intp]
    drive: FloatArray
    room: FloatArray
    sides: Sides
    transmission: FloatArray
    extent: FloatArray
    designs: int

    def take(self, index: NDArray[np.intp]) -> Candidates:
        """Some of them."""
        picked = {name: getattr(self, name)[index] for name in ("linkages", *COLUMNS)}
        sides = self.sides.at(index)
        return self._replace(**picked, sides=sides)

    @property
    def figures(self) -> Figures:
        """What they measure (n,)."""
        return figures_of(self.linkages, self.transmission, True, self.extent)

    def excess(self, size: float) -> FloatArray:
        """How far beyond the standard link ratio, lengths and extent are: (n,), logarithms.

        Zero is within.  size: of the motion.
        """
        return excess(standard({}, size, (TRANSMISSION,)), self.figures)

    def merit(self, size: float) -> FloatArray:
        """What a search climbs (n,): the least transmission angle in degrees, less `excess`."""
        return np.asarray(np.degrees(self.transmission) - TRANSMISSION.standard * self.excess(size))


def figures_of(
    linkage: WattLinkage, transmission: Values, turns: Values, extent: Values = math.nan
) -> Figures:
    """The figures of six-bars (*,) by which they are held to what is asked.

    transmission: the least angle of both loops over the range, radians.
    """
    lengths = linkage.lengths()
    least, most = lengths.min(axis=-1), lengths.max(axis=-1)
    return Figures(transmission, least, most, most / least, turns=turns, extent=extent, joints=True)


def candidates(
    chains: ThreeRChain, poses: Displacement, side: FloatArray, conditions: Conditions
) -> Candidates:
    """All six-bars of chains (k,) through poses (k, N = 5) that work with a driver.

    Of the conditions only that on the driver and the order are asked here.
    side: (k,), of the elbow.  A four-bar whose poses no driver reaches is not gone on with.
    """
    order = {"any_order": conditions.any_order}
    bars = with_first_dyad(chains, poses, side)
    good = np.zeros(len(bars.task), dtype=bool)
    for driver in DRIVERS:
        good |= first_loop_works(bars.joints, driver, **order)
    bars = FourBars(bars.task[good], bars.joints[good], bars.dyad[good])
    added = with_second_dyad(chains[bars.task], poses[bars.task], bars)
    chain = bars.task[added.task]
    linkages, joints = added.linkages, added.joints
    parts = []
    for number, driver in enumerate(DRIVERS):
        way = travel(linkages, joints, driver, **order)
        at = np.flatnonzero(way.works & (np.isinf(way.room).all(axis=-1) | (not conditions.crank)))
        way, links, there = way.take(at), linkages[at], joints[at]
        parts.append(
            Candidates(
                chain=chain[at],
                design=at,
                linkages=links,
                joints=there,
                driver=np.full(len(at), number),
                drive=way.drive,
                room=way.room,
                sides=way.sides,
                transmission=least_transmission(links, way, driver, there),
                extent=extent_of(links, way.drive, way.sides, driver),
                designs=len(added.task),
            )
        )
    return joined(parts, len(added.task))


def joined(parts: list[Candidates], designs: int) -> Candidates:
    """Several in one; designs: of all of them."""
    linkages = WattLinkage(
        *(
            np.concatenate([getattr(each.linkages, name) for each in parts])
            for name in WattLinkage.__match_args__
        )
    )
    sides = Sides(*(np.concatenate(each) for each in zip(*(p.sides for p in parts), strict=True)))
    columns = {name: np.concatenate([getattr(each, name) for each in parts]) for name in COLUMNS}
    return Candidates(linkages=linkages, sides=sides, designs=designs, **columns)


def extent_of(linkage: WattLinkage, drive: FloatArray, sides: Sides, driver: Drive) -> FloatArray:
    """The diagonals (n,) of the boxes around all joints at places along the range."""
    low, high = drive.min(axis=-1)[:, None], drive.max(axis=-1)[:, None]
    steps = low + (high - low) * np.linspace(0, 1, PLACES)
    joints = joints_at(linkage[:, None], steps, sides.at((slice(None), None)), driver)
    joints = joints.reshape(len(joints), PLACES * len(JOINTS))
    parts = joints.real, joints.imag
    # An end of the range that is beside a dead point may be nan by rounding.
    width, height = (np.fmax.reduce(p, axis=-1) - np.fmin.reduce(p, axis=-1) for p in parts)
    return np.asarray(np.hypot(width, height))
