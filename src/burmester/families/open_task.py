"""A task that leaves its dyads open, in the frames in which errors are computed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.families.pivot_freedom import PivotFreedom
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.foot_points import places_of, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, DYAD_KINDS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.tasks.options import Preference
from burmester.tasks.surroundings import Surroundings

__all__ = ["Conditions", "DyadFreedom", "OpenTask", "Trials"]

RADIUS_FREEDOM = 9.0  # squared; how much rather a link's length changes than its pivots move


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadFreedom:
    """What one dyad may be: where its pivots lie, how long its link is, and of which kinds it is.

    length: the least and the greatest; kinds: indices in DYAD_KINDS.
    """

    fixed: PivotFreedom
    moving: PivotFreedom
    length: tuple[float, float]
    kinds: tuple[int, ...]

    def metric(self) -> FloatArray:
        """How freely the dimensions of each kind of dyad change: projectors (3, 5, 5)."""
        out = np.zeros((len(DYAD_KINDS), DIMENSIONS, DIMENSIONS))
        out[:, :4, :4] = np.eye(4)
        for kind in (0, 2):
            out[kind, :2, :2] = self.fixed.projector
        for kind in (0, 1):
            out[kind, 2:4, 2:4] = self.moving.projector
        out[0, 4, 4] = RADIUS_FREEDOM
        return out


@final
@dataclass(frozen=True, slots=True, eq=False)
class Trials:
    """Linkages (k,) that are tried.

    offsets: (k, N, 3), how far they leave the poses, along the axes of the tolerances.
    driver: (k,), the side that drives.
    """

    batch: LinkageBatch
    offsets: FloatArray
    driver: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.batch)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Conditions:
    """What linkages of an open task must be; lengths in its frames.

    transmission: the least transmission angle over the range, radians.
    shortest, longest: of the links; ratio: of the longest of four to the shortest.
    span: of the motion, by which the extent is measured.
    prefer: by which figure the recommended linkage is chosen.
    types: (8,), whether 4R linkages are allowed, by the signs of their Grashof sums, in binary.
    kinds: the pairs of kinds of dyads that are allowed; drivers: the sides that may drive.
    around: what body, its outline, and links must stay clear of.
    """

    transmission: float
    shortest: float
    longest: float
    ratio: float
    span: float
    types: NDArray[np.bool_]
    kinds: frozenset[frozenset[type]]
    drivers: tuple[int, ...]
    crank: bool
    any_order: bool
    change_point: bool
    footprint: Polygon | None
    prefer: Preference
    around: Surroundings | None = None
    body: Polygon | None = None


@final
@dataclass(frozen=True, slots=True, eq=False)
class OpenTask:
    """Poses (N,) in error frames, and what the dyads on both sides may be.

    half_widths: (N, 3), the tolerances of x, y and length x angle; zero where a pose is exact.
    axes: (N, 3, 3), their directions, as columns.
    conditions: what linkages must be.
    """

    poses: Displacement
    length: float
    frames: CanonicalFrames
    sides: tuple[DyadFreedom, DyadFreedom]
    half_widths: FloatArray
    axes: FloatArray
    conditions: Conditions

    @property
    def is_exact(self) -> bool:
        """Whether every pose is to be met exactly."""
        return not self.half_widths.any()

    @property
    def is_symmetric(self) -> bool:
        """Whether both dyads may be the same."""
        return self.sides[0] is self.sides[1]

    def rows(self, offsets: FloatArray) -> FloatArray:
        """The places (k, N, 3) at offsets (k, N, 3) from the poses, as rows."""
        moved = np.einsum("nij,knj->kni", self.axes, offsets)
        return np.asarray(rows_of(self.poses, self.length) + moved)

    def places(self, offsets: FloatArray) -> Displacement:
        """The same as places (k, N)."""
        return places_of(self.rows(offsets), self.length)
