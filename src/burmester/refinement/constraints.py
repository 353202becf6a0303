"""Constraints on linkages while all their dimensions are refined: limits, branch, requirements.

Each is a number that must be at most 0 (equal to 0, where `equal` is true), for linkages (k,) and
their coupler's places, in the frames of `pose_error.error_frames` and their unit of length.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Final, NamedTuple, Protocol, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.linkage_batch import (
    DIMENSIONS,
    LeastTransmission,
    LinkageBatch,
    Transmission,
    pin_distances,
)
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray, complex_of, wrapped_angle
from burmester.numerics.differences import DifferenceQuotients
from burmester.tasks.requirements import Requirements

CLEARANCE_ANGLE: Final = np.radians(5.0)  # least transmission angle in a search for linkages
TRANSMISSION_MARGIN: Final = 1e-7  # radians; kept above a required transmission angle
MIN_INPUT_STEP: Final = 2e-3  # radians or lengths; least step of the input from pose to pose
# The index of the shortest of ground, driver, coupler and follower in each of Grashof's types.
SHORTEST_LINK: Final = {"double-crank": 0, "crank-rocker": 1, "double-rocker": 2, "rocker-crank": 3}
TINY_GAP: Final = 1e-12  # lengths; pins that are nearer have no direction from one to the other
PROPORTION_MARGIN: Final = 1e-6  # relative; kept from the border of a type or a ratio

ConstraintValues: TypeAlias = tuple[FloatArray, NDArray[np.bool_]]
ConstraintSlopes: TypeAlias = tuple[FloatArray, FloatArray, NDArray[np.bool_]]
QUOTIENTS: Final = DifferenceQuotients(stride=1e-7)  # of constraints, by their unknowns


class Constraints(Protocol):
    """A function of linkages (k,) and rows (k, N, 3) of places: values (k, m), to be at most 0.

    With a mask (m,) of the values that must be 0.  The indices (k,) are those of the linkages in
    the batch that is refined.  Constraints that ignore the places have `uses_places = False`.
    """

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues: ...

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """Also the derivatives (k, m, n) by the unknowns, by which places have place_jacobian.

        place_jacobian: (k, N, 3, n).  The unknowns are the ten dimensions, and if n is more, a step
        along the motion for each place.
        """


class FromSlopes:
    """Constraints whose values are computed with their derivatives."""

    __slots__ = ()

    def __call__(
        self: Constraints, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        still = np.zeros((*rows.shape, 2 * DIMENSIONS))
        value, _, equal = self.differentiated(batch, rows, which, still)
        return value, equal


@final
@dataclass(frozen=True, slots=True, eq=False)
class AllConstraints:
    """Several constraints, one after the other."""

    parts: tuple[Constraints, ...]

    @property
    def uses_places(self) -> bool:
        """Whether one of them depends on the places."""
        return any(getattr(part, "uses_places", True) for part in self.parts)

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        values, equal = zip(*(part(batch, rows, which) for part in self.parts), strict=True)
        return np.concatenate(values, axis=1), np.concatenate(equal)

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """The values of all parts, and their derivatives."""
        parts = (part.differentiated(batch, rows, which, place_jacobian) for part in self.parts)
        values, slopes, equal = zip(*parts, strict=True)
        return (
            np.concatenate(values, axis=1),
            np.concatenate(slopes, axis=1),
            np.concatenate(equal),
        )


class DrivenBranch(NamedTuple):
    """A branch of each linkage (k,), and the side that drives.

    driver: (k,), 0 or 1.
    sign: (k,), of the signed `Transmission.sine` on the branch.
    middle: (k,), the input halfway between its dead points; nan where it has none, or slides.
    """

    driver: NDArray[np.intp]
    sign: FloatArray
    middle: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class BranchAndOrder:
    """The constraint that all poses are on one branch, clear of its dead points, and in order.

    length: the length that a radian counts as in rows.  driver: (k,), the side that drives.
    sign: (k,), of the signed `Transmission.sine` on the branch; clear: (k,), its least size.
    sense: (k,), +1 or -1, of the input; ways: (k, N - 1), the steps from pose to pose in that sense
    at the start, which decide on whole turns.  ordered: whether each step must have that sense.
    """

    length: float
    driver: NDArray[np.intp]
    sign: FloatArray
    clear: FloatArray
    sense: FloatArray
    ways: FloatArray
    ordered: bool
    uses_places: ClassVar[bool] = True

    @classmethod
    def of(
        cls,
        batch: LinkageBatch,
        rows: FloatArray,
        length: float,
        branch: DrivenBranch,
        requirements: Requirements,
    ) -> BranchAndOrder:
        """The constraint on a branch, in the order nearest to that of places rows (k, N, 3)."""
        driver, sign, middle = branch
        least = max(CLEARANCE_ANGLE, requirements.transmission + TRANSMISSION_MARGIN)
        clear = np.full(len(batch), np.sin(least))
        _, drive, turns = Transmission.of(batch, rows, length, driver)
        round_ = turns & np.isnan(middle)
        between = drive - np.nan_to_num(middle)[:, None]
        between = np.where((turns & ~round_)[:, None], wrapped_angle(between), between)
        step = np.diff(between, axis=1)
        step = np.where(round_[:, None], wrapped_angle(step), step)
        forward = 2 * (step > 0).sum(axis=1) >= step.shape[1]  # also of one pose, which has no step
        # An input that turns fully may meet all poses within one turn, in one of the two senses.
        turn = np.stack([step, -step]) % (2 * np.pi)
        total = turn.sum(axis=-1)
        once = round_ & (total.min(axis=0) < 2 * np.pi)
        forward = np.where(once, total[0] <= total[1], forward)
        sense = np.where(forward, 1.0, -1.0)
        around = np.where(forward[:, None], turn[0], turn[1])
        ways = np.where(once[:, None], around, sense[:, None] * step)
        return cls(length, driver, sign, clear, sense, ways, not requirements.any_order)

    def transmitting(self, least: FloatArray) -> BranchAndOrder:
        """The same with a least transmission angle (k,) of each linkage's own, where it is more."""
        return replace(self, clear=np.maximum(self.clear, np.sin(least + TRANSMISSION_MARGIN)))

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        there = Transmission.of(batch, rows, self.length, self.driver[which])
        least = LeastTransmission.of(batch, self.driver[which])
        return _at_most(self._values(there, least, which)[0])

    def least_transmission(self, batch: LinkageBatch, rows: FloatArray) -> FloatArray:
        """The least transmission angle (k,) at and between places rows (k, N, 3), in radians.

        Below 0 on the other side of a dead point.
        """
        there = Transmission.of(batch, rows, self.length, self.driver)
        least = LeastTransmission.of(batch, self.driver)
        _, passed = self._values(there, least, np.arange(len(batch)))
        sine = (self.sign[:, None] * there.sine).min(axis=1)
        between = np.arccos(np.clip(np.abs(least.cosine), 0.0, 1.0))
        between = np.where(passed, between, np.inf).min(axis=1)
        return np.asarray(np.minimum(np.arcsin(np.clip(sine, -1, 1)), between))

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """Also the derivatives."""
        there, by_sine, by_drive = Transmission.differentiated(
            batch, rows, self.length, self.driver[which], place_jacobian
        )
        least = LeastTransmission.of(batch, self.driver[which])
        values, passed = self._values(there, least, which)
        slopes = [-self.sign[which, None, None] * by_sine]
        if self.ordered:
            by_drive = self.sense[which, None, None] * by_drive
            whole = np.where(there.turns[:, None, None], by_drive[:, -1:] - by_drive[:, :1], 0.0)
            slopes += [-np.diff(by_drive, axis=1), whole]
        between = np.zeros((len(batch), 2, place_jacobian.shape[-1]))
        by_cosine = np.sign(least.cosine)[..., None] * least.slope
        between[..., : 2 * DIMENSIONS] = np.where(passed[..., None], by_cosine, 0.0)
        value, equal = _at_most(values)
        return value, np.concatenate([*slopes, between], axis=1), equal

    def _values(
        self, there: Transmission, least: LeastTransmission, which: NDArray[np.intp]
    ) -> tuple[list[FloatArray], NDArray[np.bool_]]:
        """The values, and which (k, 2) of the least transmission angles are between the poses."""
        sense, ways, clear = self.sense[which, None], self.ways[which], self.clear[which, None]
        turns = there.turns[:, None]
        out = [clear - self.sign[which, None] * there.sine]
        more = sense * np.diff(there.drive, axis=1) - ways
        step = ways + np.where(turns, wrapped_angle(more), more)
        along = np.concatenate([np.zeros((len(step), 1)), np.cumsum(step, axis=1)], axis=1)
        if self.ordered:
            whole = along[:, -1:] - 2 * np.pi + MIN_INPUT_STEP
            out += [MIN_INPUT_STEP - step, np.where(turns, whole, -1.0)]
        # Between the poses, too, it stays clear.
        start = along.min(axis=1, keepdims=True)
        ahead = sense * (least.at - there.drive[:, :1]) - start
        ahead = np.where(turns, ahead % (2 * np.pi), ahead)
        passed = (ahead > 0) & (ahead < along.max(axis=1, keepdims=True) - start)
        out.append(np.where(passed, np.abs(least.cosine) - np.sqrt(1 - clear**2), -1.0))
        return out, passed


@final
@dataclass(frozen=True, slots=True, eq=False)
class LinkProportions:
    """The constraints on the links' proportions, the linkage's type and the pivots' footprint.

    driver: (k,), the side that drives; types: (k,), the required type, "" for any.
    """

    length: float
    frames: CanonicalFrames
    requirements: Requirements
    driver: NDArray[np.intp]
    types: NDArray[np.str_]
    uses_places: ClassVar[bool] = True

    @property
    def _asks(self) -> bool:
        """Whether there is anything to be met."""
        asked = self.requirements
        limited = np.isfinite(asked.link_ratio) or asked.footprint is not None
        return bool(limited or (self.types != "").any())

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        out = [np.full((len(batch), 1), -1.0)]
        if not self._asks:
            return _at_most(out)
        links = _links(batch, self.driver[which])
        if np.isfinite(self.requirements.link_ratio):
            ratio = self.requirements.link_ratio * (1 - PROPORTION_MARGIN)
            excess = links[:, :, None] - ratio * links[:, None]
            out.append(excess.reshape(len(batch), -1))
        if (self.types != "").any():
            out.append(type_excess(batch, self.driver[which], self.types[which].tolist()))
        if self.requirements.footprint is not None:
            out.append(self._footprint(self.requirements.footprint, batch, rows))
        value, equal = _at_most(out)
        return np.where(np.isfinite(value), value, -1.0), equal

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """By difference quotients; those by the places only where places are looked at."""
        count, unknowns, size = len(batch), place_jacobian.shape[-1], 2 * DIMENSIONS
        if not self._asks:
            value, equal = self(batch, rows, which)
            return value, np.zeros((*value.shape, unknowns)), equal
        moved = unknowns if self.requirements.footprint is not None else size
        z = QUOTIENTS.points(batch.dimensions.reshape(count, size), np.eye(moved, size)[:, None])
        places = QUOTIENTS.points(rows, np.moveaxis(place_jacobian[..., :moved], -1, 0))
        beside = LinkageBatch(np.tile(batch.kinds, (moved + 1, 1)), z.reshape(-1, 2, DIMENSIONS))
        value, equal = self(beside, places.reshape(-1, *rows.shape[1:]), np.tile(which, moved + 1))
        value = value.reshape(moved + 1, count, -1)
        slope = np.zeros((*value.shape[1:], unknowns))
        slope[..., :moved] = QUOTIENTS.jacobian(value)
        return value[0], slope, equal

    def _footprint(self, footprint: Polygon, batch: LinkageBatch, rows: FloatArray) -> FloatArray:
        """Distances of fixed pivots, and moving pivots at the places, outside; -1 for lines."""
        unit, origin = float(self.frames.length), self.frames.fixed_origin
        out = []
        turn = np.exp(1j * rows[..., 2] / self.length)
        for side in (0, 1):
            kind, z = batch.kinds[:, side], batch.dimensions[:, side]
            off = footprint.signed_distance(z[:, :2] * unit + origin)
            out.append(np.where(kind == 1, -1.0, off)[:, None])
            pin = complex_of(rows) + complex_of(z[:, 2:4])[:, None] * turn
            at = np.stack([pin.real, pin.imag], axis=-1) * unit + origin
            out.append(np.where((kind == 2)[:, None], -1.0, footprint.signed_distance(at)))
        return np.concatenate(out, axis=1) / unit


@final
@dataclass(frozen=True, slots=True, eq=False)
class LeastLinks:
    """The constraint that no link is shorter than its least length (4,), as in `pin_distances`."""

    least: FloatArray
    uses_places: ClassVar[bool] = False

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        least = self.least * (1 + PROPORTION_MARGIN)
        return _at_most([np.nan_to_num(least - pin_distances(batch), nan=-1.0)])

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """Also the derivatives."""
        value, equal = self(batch, rows, which)
        slope = np.zeros((len(batch), 4, 2, DIMENSIONS))
        slope[:, (0, 1), (0, 1), -1] = -1.0
        for link, at in ((2, slice(0, 2)), (3, slice(2, 4))):
            gap = batch.dimensions[:, 1, at] - batch.dimensions[:, 0, at]
            along = gap / np.maximum(np.linalg.norm(gap, axis=-1, keepdims=True), TINY_GAP)
            slope[:, link, 1, at], slope[:, link, 0, at] = -along, along
        slope[np.isnan(pin_distances(batch))] = 0.0
        out = np.zeros((*value.shape, place_jacobian.shape[-1]))
        out[..., : 2 * DIMENSIONS] = slope.reshape(len(batch), 4, -1)
        return value, out, equal


def _at_most(parts: list[FloatArray]) -> ConstraintValues:
    value = np.concatenate(parts, axis=1)
    return value, np.zeros(value.shape[1], dtype=bool)


def _links(batch: LinkageBatch, driver: NDArray[np.intp]) -> FloatArray:
    """Ground, driver, coupler and follower (k, 4) of 4R linkages; nan of others."""
    every = np.arange(len(batch))
    z, z2 = batch.dimensions[every, driver], batch.dimensions[every, 1 - driver]
    ground, coupler = (np.linalg.norm((z2 - z)[:, at : at + 2], axis=-1) for at in (0, 2))
    links = np.stack([ground, z[:, 4], coupler, z2[:, 4]], axis=1)
    return np.where((batch.kinds == 0).all(axis=1)[:, None], links, np.nan)


def type_excess(batch: LinkageBatch, driver: NDArray[np.intp], types: Sequence[str]) -> FloatArray:
    """Three relative numbers (k, 3), all at most 0 where 4R linkages (k,) are of types (k,)."""
    links, names = _links(batch, driver), np.array(types, dtype=str)
    out = np.full((len(links), 3), -1.0)
    for name, shortest in SHORTEST_LINK.items():
        some = links[names == name]
        others = [i for i in range(4) if i != shortest]
        whole = some.sum(axis=1, keepdims=True)
        out[names == name] = (
            2 * (some[:, [shortest]] + some[:, others]) - whole
        ) / whole + PROPORTION_MARGIN
    some = links[names == "triple-rocker"]
    ends, whole = some.min(axis=1) + some.max(axis=1), some.sum(axis=1)
    out[names == "triple-rocker", 0] = (whole - 2 * ends) / whole + PROPORTION_MARGIN
    return out
