"""The reference that every file is compared with: a linkage's dimensions and places in a unit.

E160 the file does not contain the linkage        E163 a linkage that does not reach the poses
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike

from burmester.errors import BurmesterError, InputError
from burmester.export.options import MILLIMETRES, Options, unit_of
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.refinement.tolerance_boxes import poses_counted
from burmester.verdicts.found_linkage import FoundLinkage

__all__ = [
    "PRECISION",
    "Reference",
    "as_rows",
    "require_equal",
    "require_places",
]

PRECISION = 1e-9  # of the span: the largest deviation of a file from the linkage


@final
@dataclass(frozen=True, slots=True, eq=False)
class Reference:
    """A linkage in a unit of length: the dimensions of each dyad, None for those it does not have.

    kinds: RR, PR, RP or PP; fixed: pivots in F; moving: pivots in M; radius: link lengths;
    line: the angle of the normal and the offset, in F for PR and in M for RP.
    places: (N,) of the coupler for the poses; poses: (N,) of the task.
    span: diagonal of the box around all pivots; scale: of this unit per unit of the task.
    """

    kinds: tuple[str, str]
    fixed: tuple[FloatArray | None, FloatArray | None]
    moving: tuple[FloatArray | None, FloatArray | None]
    radius: tuple[float | None, float | None]
    line: tuple[tuple[float, float] | None, tuple[float, float] | None]
    places: Displacement
    poses: Displacement
    span: float
    scale: float

    @classmethod
    def of(cls, chosen: FoundLinkage, options: Options, unit: str | None = "mm") -> Reference:
        """The linkage in a unit, None for the task's own; raises E162, and E163 without places."""
        require_places(chosen)
        scale = 1.0
        if unit is not None:
            scale = MILLIMETRES[unit_of(chosen, options)] / MILLIMETRES[unit]
        places, poses = (
            Displacement(each.translation * scale, each.angle)
            for each in (chosen.error.places, poses_counted(chosen.error.places, chosen.task))
        )
        fixed: list[FloatArray | None] = []
        moving: list[FloatArray | None] = []
        radius: list[float | None] = []
        line: list[tuple[float, float] | None] = []
        dyads = (chosen.driver_first.first, chosen.driver_first.second)
        for dyad in dyads:
            fixed.append(dyad.fixed_pivot * scale if isinstance(dyad, RR | RP) else None)
            moving.append(dyad.moving_pivot * scale if isinstance(dyad, RR | PR) else None)
            radius.append(float(dyad.radius) * scale if isinstance(dyad, RR) else None)
            line.append(
                (float(dyad.normal_angle), float(dyad.offset) * scale)
                if isinstance(dyad, PR | RP)
                else None
            )
        points = [places.translation, *(each[None] for each in fixed if each is not None)]
        points += [places.act(each) for each in moving if each is not None]
        span = math.hypot(*np.ptp(np.concatenate(points), axis=0).tolist())
        return cls(
            (type(dyads[0]).__name__, type(dyads[1]).__name__),
            (fixed[0], fixed[1]),
            (moving[0], moving[1]),
            (radius[0], radius[1]),
            (line[0], line[1]),
            places,
            poses,
            span,
            scale,
        )

    @property
    def only_translates(self) -> bool:
        """Whether a dyad is PP."""
        return PP.__name__ in self.kinds

    def closure_error(self, places: Displacement) -> float:
        """The largest misfit of a link at coupler places, in the unit of lengths."""
        worst = 0.0
        c, s = np.cos(places.angle), np.sin(places.angle)
        x, y = places.translation[..., 0], places.translation[..., 1]
        for k in (0, 1):
            fixed, moving, line, radius = (
                self.fixed[k],
                self.moving[k],
                self.line[k],
                self.radius[k],
            )
            if moving is not None:
                px, py = c * moving[0] - s * moving[1] + x, s * moving[0] + c * moving[1] + y
                if line is None:
                    assert fixed is not None
                    assert radius is not None
                    off = np.hypot(px - fixed[0], py - fixed[1]) - radius
                else:
                    off = math.cos(line[0]) * px + math.sin(line[0]) * py - line[1]
            elif fixed is not None:
                assert line is not None
                px, py = fixed[0] - x, fixed[1] - y
                off = math.cos(line[0]) * (c * px + s * py) - line[1]
                off = off + math.sin(line[0]) * (c * py - s * px)
            else:
                continue
            worst = max(worst, float(np.abs(off).max()))
        return worst


def require_places(chosen: FoundLinkage) -> None:
    """Raise E163 where the linkage cannot be put together near some pose."""
    places = chosen.error.places
    missing = ~(np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1))
    if missing.any():
        raise InputError(
            "E163",
            f"linkage {chosen.id} has no place for pose {missing.argmax() + 1}",
            why="its links cannot be put together near that pose",
            help="choose another linkage, one that is usable, with --linkage",
        )


def require_equal(what: str, got: ArrayLike, expected: ArrayLike, tolerance: float) -> None:
    """Raise E160 where numbers read from a file are not those of the linkage."""
    one, two = np.asarray(got, dtype=np.float64), np.asarray(expected, dtype=np.float64)
    if one.shape != two.shape:
        off: float | str = f"{one.shape} numbers where {two.shape} belong"
    else:
        gap = float(np.abs(one - two).max()) if one.size else 0.0
        if gap <= tolerance:
            return
        off = f"off by {gap:.3g}, more than {tolerance:.3g}"
    raise BurmesterError(
        "E160",
        "the written file does not contain the linkage, so it was deleted",
        why=f"{what}: {off}",
        help="this is a fault of burmester: report it, with the result file",
    )


def as_rows(places: Displacement) -> FloatArray:
    """Places (*,) as rows (*, 4): x, y, and the cosine and sine of their angles."""
    return np.concatenate(
        [places.translation, np.cos(places.angle)[..., None], np.sin(places.angle)[..., None]],
        axis=-1,
    )
