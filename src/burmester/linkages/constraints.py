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
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.regions import Polygon, Region
from burmester.numerics.arrays import FloatArray, complex_of, wrapped_angle
from burmester.tasks.limits import Limits
from burmester.tasks.requirements import Requirements

__all__ = [
    "CLEARANCE_ANGLE",
    "SHORTEST_LINK",
    "AllConstraints",
    "BranchAndOrder",
    "Constraints",
    "DrivenBranch",
    "DyadLimitsConstraint",
    "LinkProportions",
    "input_of",
    "least_transmission_inputs",
    "signed_transmission_sine",
    "type_excess",
]

CLEARANCE_ANGLE: Final = np.radians(5.0)  # least transmission angle in a search for linkages
TRANSMISSION_MARGIN: Final = 1e-7  # radians; kept above a required transmission angle
MIN_INPUT_STEP: Final = 2e-3  # radians or lengths; least step of the input from pose to pose
# The index of the shortest of ground, driver, coupler and follower in each of Grashof's types.
SHORTEST_LINK: Final = {"double-crank": 0, "crank-rocker": 1, "double-rocker": 2, "rocker-crank": 3}
MAX_SIDES: Final = 8  # number of sides of a convex polygon that are constraints each
PROPORTION_MARGIN: Final = 1e-6  # relative; kept from the border of a type or a ratio


ConstraintValues: TypeAlias = tuple[FloatArray, NDArray[np.bool_]]


class Constraints(Protocol):
    """A function of linkages (k,) and rows (k, N, 3) of places: values (k, m), to be at most 0.

    With a mask (m,) of the values that must be 0.  The indices (k,) are those of the linkages in
    the batch that is refined.  Constraints that ignore the places have `uses_places = False`.
    """

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues: ...


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


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadLimitsConstraint:
    """The limits of the dyad on one side, the same for all linkages."""

    side: int
    limits: Limits
    frames: CanonicalFrames
    uses_places: ClassVar[bool] = False

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        own = batch.from_canonical(self.frames)
        kind, z = own.kinds[:, self.side], own.dimensions[:, self.side]
        least, most = self.limits.length
        with np.errstate(invalid="ignore"):
            link = np.stack([least - z[:, 4], z[:, 4] - most], axis=1)
        out = [np.where((kind == 0)[:, None] & np.isfinite(link), link, -1.0)]
        equal = [np.zeros(2, dtype=bool)]
        regions = (self.limits.fixed_pivot, 0, 1), (self.limits.moving_pivot, 2, 2)
        for region, at, line in regions:
            if region is not None:
                off = _outside(region, z[:, at : at + 2])
                out.append(np.where((kind == line)[:, None], 0.0 * off, off))
                equal.append(np.arange(off.shape[1]) < len(region.equations()))
        return np.concatenate(out, axis=1) / float(self.frames.length), np.concatenate(equal)


def _outside(region: Region, points: FloatArray) -> FloatArray:
    """Distances (k, m) of points (k, 2) from a region: its equations, then its inequalities.

    Those from the sides of a convex polygon each by itself: its distance has a kink at a corner,
    where a descent would be held.
    """
    if isinstance(region, Polygon):
        sides = _sides(region)
        if sides is None:
            return region.signed_distance(points)[:, None]
        return np.asarray(points @ sides[:, 1:].T + sides[:, 0])
    rows = region.equations()
    off = points @ rows[:, 1:].T + rows[:, 0]
    if len(rows) == 2:
        return np.asarray(off)
    ends = region.corners()
    if ends is None:
        beyond = np.full((len(points), 2), -1.0)
    else:
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        beyond = np.stack([(ends[0] - points) @ along, (points - ends[1]) @ along], axis=1)
    return np.concatenate([off, beyond], axis=1)


def _sides(polygon: Polygon) -> FloatArray | None:
    """The sides of a convex polygon, (k, 3): row · (1, X, Y) at most 0; else None."""
    v = polygon.corners()
    along = np.roll(v, -1, axis=0) - v
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    after = np.roll(along, -1, axis=0)
    turn = along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0]
    if len(v) > MAX_SIDES or (turn < 0).any():
        return None
    outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
    return np.column_stack([-(outward * v).sum(axis=1), outward])


class DrivenBranch(NamedTuple):
    """A branch of each linkage (k,), and the side that drives.

    driver: (k,), 0 or 1.
    sign: (k,), of `signed_transmission_sine` on the branch.
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
    sign: (k,), of `signed_transmission_sine` on the branch; clear: (k,), its least size.
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
        drive, turns = input_of(batch, rows, length, driver)
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
        driver, sense, ways = self.driver[which], self.sense[which, None], self.ways[which]
        clear = self.clear[which, None]
        sine = self.sign[which, None] * signed_transmission_sine(batch, rows, self.length, driver)
        out = [clear - sine]
        drive, turns = input_of(batch, rows, self.length, driver)
        more = sense * np.diff(drive, axis=1) - ways
        step = ways + np.where(turns[:, None], wrapped_angle(more), more)
        along = np.concatenate([np.zeros((len(drive), 1)), np.cumsum(step, axis=1)], axis=1)
        if self.ordered:
            whole = along[:, -1:] - 2 * np.pi + MIN_INPUT_STEP
            out += [MIN_INPUT_STEP - step, np.where(turns[:, None], whole, -1.0)]
        # Between the poses, too, it stays clear.
        at, cosine = least_transmission_inputs(batch, driver)
        start = along.min(axis=1, keepdims=True)
        ahead = sense * (at - drive[:, :1]) - start
        ahead = np.where(turns[:, None], ahead % (2 * np.pi), ahead)
        passed = (ahead > 0) & (ahead < along.max(axis=1, keepdims=True) - start)
        out.append(np.where(passed, np.abs(cosine) - np.sqrt(1 - clear**2), -1.0))
        return _at_most(out)


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

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        out = [np.full((len(batch), 1), -1.0)]
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


def _at_most(parts: list[FloatArray]) -> ConstraintValues:
    value = np.concatenate(parts, axis=1)
    return value, np.zeros(value.shape[1], dtype=bool)


def signed_transmission_sine(
    batch: LinkageBatch, rows: FloatArray, length: float, driver: NDArray[np.intp]
) -> FloatArray:
    """The sine (k, n) of the transmission angle at rows (k, n, 3), signed.

    It changes its sign at the dead points of the side that drives, (k,).  It is the power that the
    driver transmits: the determinant of three wrenches (the driver's effort and both constraints),
    over its lever.
    """
    every = np.arange(len(batch))
    d, turn = complex_of(rows), np.exp(1j * rows[..., 2] / length)
    _, push, swing = batch.forms().at(d[:, None], turn[:, None])
    moment = -swing.imag
    lead, follow = push[every, driver], push[every, 1 - driver]
    own, other = moment[every, driver], moment[every, 1 - driver]
    z, z2 = batch.dimensions[every, driver], batch.dimensions[every, 1 - driver]
    kind, kind2 = batch.kinds[every, driver], batch.kinds[every, 1 - driver]
    slot, slot2 = (kind == 2)[:, None], (kind2 == 2)[:, None]
    hand, hand2 = complex_of(z[:, 2:4])[:, None], complex_of(z2[:, 2:4])[:, None]
    effort, turning = 1j * lead, ((hand * turn).conj() * lead).real
    across = (lead.conj() * follow).imag
    # det(effort, own force, other force), by its moments.
    det = (
        turning * across - own * (effort.conj() * follow).imag + other * (effort.conj() * lead).imag
    )
    pin = d + hand * turn
    far = np.abs(np.where(slot2, complex_of(z2[:, :2])[:, None] - pin, hand2 - hand))
    with np.errstate(invalid="ignore", divide="ignore"):
        sine = np.where(slot, across, det / far)
    return np.where(slot & slot2, 1.0, sine)


def least_transmission_inputs(
    batch: LinkageBatch, driver: NDArray[np.intp]
) -> tuple[FloatArray, FloatArray]:
    """Inputs (k, 2) where the transmission angle may be least between two places, and its cosine.

    These are the ends of the range of f (see `loop_closure`).  The cosine is above 1 where the
    linkage does not close there.  nan for pairs without such a minimum.
    """
    every = np.arange(len(batch))
    z, z2 = batch.dimensions[every, driver].T, batch.dimensions[every, 1 - driver].T
    kind, kind2 = batch.kinds[every, driver], batch.kinds[every, 1 - driver]
    c, m, c2, m2 = (complex_of(part[at : at + 2].T) for part in (z, z2) for at in (0, 2))
    both = np.array([[1.0], [-1.0]])
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        ground, arm = c2 - c, np.abs(m2 - m)
        n, n2, slot2 = np.exp(1j * z[0]), np.exp(1j * z2[0]), np.exp(1j * z2[2])
        rail = np.abs((n.conj() * c2).real - z[1])
        far = np.where(kind == 0, np.abs(np.abs(ground) - both * z[4]), rail)
        pins = (arm**2 + z2[4] ** 2 - far**2) / (2 * arm * z2[4])
        line = (z2[1] - (n2.conj() * c).real - both * z[4]) / arm
        slot = (z2[3] - (slot2.conj() * m).real) / far
        across = (both * np.abs(ground) + (np.exp(-1j * z[2]) * m2).real - z[3]) / z2[4]
    crank, of_slot = np.angle(ground), np.angle(-ground)
    pair = kind * 3 + kind2
    cosine = np.select(
        [pair == 0, pair == 1, pair == 2, pair == 3, pair == 5, pair == 6],
        [pins, line, slot, pins, slot, across],
        np.nan,
    )
    start = np.select(
        [pair == 1, kind == 0, kind == 1], [z2[0], crank, (n.conj() * c2).imag], of_slot
    )
    at = np.stack([start, np.where(kind == 1, np.nan, start + np.pi)], axis=1)
    return at, cosine.T


def input_of(
    batch: LinkageBatch, rows: FloatArray, length: float, driver: NDArray[np.intp]
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """The input (k, n), see `loop_closure`, at rows (k, n, 3), and whether it turns, (k,)."""
    every = np.arange(len(batch))
    z, kind = batch.dimensions[every, driver], batch.kinds[every, driver]
    d, angle = complex_of(rows), rows[..., 2] / length
    pin = d + complex_of(z[:, 2:4])[:, None] * np.exp(1j * angle)
    crank = np.angle(pin - complex_of(z[:, :2])[:, None])
    slide = (pin * np.exp(-1j * z[:, :1])).imag
    kind_ = kind[:, None]
    return np.select([kind_ == 0, kind_ == 1], [crank, slide], angle + z[:, 2:3]), kind != 1


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
