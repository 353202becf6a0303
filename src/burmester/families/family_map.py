"""The map of a family: which pairs of the dyads of three or four poses make a linkage that works.

Four poses leave a curve of RR dyads (`burmester_curve`): the map is a square, with the place of the
one dyad along the curve on one axis and that of the other dyad on the other.  Three poses leave a
plane of them (`three_poses`), one for each fixed pivot: the map is a rectangle of fixed pivots in
F, beside one dyad that is chosen.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burmester.dyads.burmester_curve import dyad_curve
from burmester.dyads.pivot_map import grid
from burmester.dyads.three_poses import dyad_with_fixed_pivot
from burmester.errors import InputError
from burmester.families.pair_verdicts import (
    Ground,
    PairBounds,
    PairClass,
    PairVerdicts,
    judged_pairs,
    meets_limits,
)
from burmester.fourbar.dyad import PP, RP, RR, broadcast_to
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import span

CURVE_SAMPLES = 200  # dyads along the curve of four poses
COLUMNS, ROWS = 160, 120  # fixed pivots of the map of three poses
LIMITED_BORDER = 0.05  # of the longer side: the same around regions for pivots
BORDER = 0.6  # spans of the motion around poses and pivots that the map of three poses shows


@final
@dataclass(frozen=True, slots=True, eq=False)
class FamilyMap:
    """The map of a family.

    kind: "curve" for the square of four poses, "plane" for the rectangle of three.
    task: of the poses.
    first: the first dyads.  Of a curve: RR (n,), in order along it, loop by loop.  Of a plane: the
        one that was chosen, (), of any kind but PP.
    second: the second dyads.  Of a curve: the same RR (n,).  Of a plane: RR (rows, columns), row by
        row from the lowest fixed pivots, columns from the left.
    verdicts: of the pairs, (n, n) with the first dyad along the first axis and equal for both
        orders of a pair; or (rows, columns).
    loop, position: (n,), of a curve: the number of the closed loop that each dyad is on, and its
        place along it as a share of the loop's length in [0, 1), by the metric of `dyad_curve`.
        Empty for a plane.
    bounds: what pairs are held to, beside the task's own limits and requirements.
    """

    kind: Literal["curve", "plane"]
    task: Task
    first: Ground
    second: RR
    verdicts: PairVerdicts
    loop: NDArray[np.int8]
    position: FloatArray
    bounds: PairBounds

    @property
    def poles(self) -> FloatArray:
        """The poles (m, 2) in F: about each the body turns from one pose to another.

        In the order of the pairs 1-2, 1-3, ...; not finite where it only moves along.
        """
        i, j = np.triu_indices(self.task.poses.shape[0], 1)
        turns = self.task.poses[j] @ self.task.poses[i].inverse()
        x, y, w = np.moveaxis(turns.as_image_point()[:, :3], -1, 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(np.stack([x, y], axis=-1) / w[:, None])

    def places_of(self, linkage: Linkage) -> list[int] | None:
        """The numbers of a linkage's dyads along the curve; None where one is not on it."""
        dyads = [each for each in (linkage.first, linkage.second) if isinstance(each, RR)]
        known = [place for each in dyads if (place := self.nearest(each)) is not None]
        return known if len(known) == 2 else None

    def nearest(self, dyad: Ground) -> int | None:
        """The number of the sample of a curve that is nearest to a dyad, by both pivots.

        None for a slider, and where no sample is nearer than its neighbours are to it: then the
        dyad is not on the curve.
        """
        if not isinstance(dyad, RR) or not isinstance(self.first, RR):
            return None
        here = _pivots(self.first)
        away = np.linalg.norm(here - _pivots(dyad), axis=-1)
        k = int(np.nanargmin(away))
        own = np.flatnonzero(self.loop == self.loop[k])
        place = int(np.searchsorted(own, k))
        beside = own[[place - 1, (place + 1) % len(own)]]
        step = np.linalg.norm(here[beside] - here[k], axis=-1).max()
        return k if away[k] <= step else None

    def best_partner(self) -> tuple[NDArray[np.int8], FloatArray]:
        """For each dyad (n,) of a curve the best class it makes, and the greatest angle there.

        The angle, in radians, is the greatest least transmission angle among the pairs of that
        class; nan where all have defects.
        """
        classes, angle, _ = self.verdicts
        best = classes.min(axis=1)
        angle = np.where(classes == best[:, None], angle, np.nan)
        return best, np.fmax.reduce(angle, axis=1)


def curve_map(
    task: Task, bounds: PairBounds | None = None, samples: int = CURVE_SAMPLES
) -> FamilyMap:
    """The map of four poses: every dyad of the curve with every other.

    Parameters
    ----------
    task : Task
        Four different poses, with limits and requirements.  Its body and surroundings are not
        looked at.
    bounds : PairBounds, optional
        What pairs are held to; by default `PairBounds.of(task)`.
    samples : int, default 200
        Dyads along the curve, about.

    Returns
    -------
    FamilyMap
        Of kind "curve".

    Raises
    ------
    InputError
        E121 (another number of poses), E124 (the four poses do not determine a curve).
    """
    curve = dyad_curve(task.poses, samples)
    sizes = [each.radius.size for each in curve.components]
    dyads = RR(
        *(
            np.concatenate([getattr(each, name) for each in curve.components])
            for name in ("fixed_pivot", "moving_pivot", "radius")
        )
    )
    bounds = PairBounds.of(task) if bounds is None else bounds
    n = dyads.radius.size
    one, other = np.triu_indices(n, 1)
    judged = judged_pairs(dyads[one], dyads[other], task, bounds)
    classes = np.full((n, n), PairClass.NO_LINKAGE, dtype=np.int8)
    transmission, driver = np.full((n, n), np.nan), np.zeros((n, n), dtype=np.int8)
    for rows, columns, turned in ((one, other, 0), (other, one, 1)):
        classes[rows, columns] = judged.classes
        transmission[rows, columns] = judged.transmission
        driver[rows, columns] = judged.driver ^ turned
    verdicts = PairVerdicts(classes, transmission, driver)
    loop = np.repeat(np.arange(len(sizes), dtype=np.int8), sizes)
    position = np.concatenate([(np.arange(size) + 0.5) / size for size in sizes])
    return FamilyMap("curve", task, dyads, dyads, verdicts, loop, position, bounds)


def plane_map(
    task: Task,
    chosen: Ground,
    low: ArrayLike,
    high: ArrayLike,
    *,
    columns: int = COLUMNS,
    rows: int = ROWS,
    bounds: PairBounds | None = None,
) -> FamilyMap:
    """The map of three poses: one dyad with the dyad of every fixed pivot in a rectangle of F.

    Parameters
    ----------
    task : Task
        Three different poses, with limits and requirements; see `curve_map`.
    chosen : RR, PR or RP
        Shape (), the first dyad.  It meets the poses.
    low, high : (2,) array_like
        Two opposite corners of the rectangle, in F.
    columns, rows : int
        Of the grid of fixed pivots.
    bounds : PairBounds, optional
        What pairs are held to; by default `PairBounds.of(task)`.

    Returns
    -------
    FamilyMap
        Of kind "plane".

    Raises
    ------
    InputError
        E121 (another number of poses).
    """
    bounds = PairBounds.of(task) if bounds is None else bounds
    second = dyad_with_fixed_pivot(task.poses, grid(low, high, columns, rows))
    row = second[np.unravel_index(np.arange(rows * columns), (rows, columns))]
    judged = judged_pairs(broadcast_to(chosen, (rows * columns,)), row, task, bounds)
    shape = rows, columns
    verdicts = PairVerdicts(
        judged.classes.reshape(shape),
        judged.transmission.reshape(shape),
        judged.driver.reshape(shape),
    )
    none = np.zeros(0)
    return FamilyMap("plane", task, chosen, second, verdicts, none.astype(np.int8), none, bounds)


def family_map(
    task: Task,
    recommended: Linkage | None = None,
    bounds: PairBounds | None = None,
    *,
    samples: int = CURVE_SAMPLES,
    columns: int = COLUMNS,
    rows: int = ROWS,
) -> FamilyMap | None:
    """The map of a task of three or four different poses; None where there is no dyad to choose.

    Parameters
    ----------
    task : Task
        Three or four different poses; see `curve_map`.
    recommended : Linkage, optional
        Of three poses, its first dyad is the one that is chosen: its second where the second is no
        RR, or alone is where limits want a pivot at a point or on a line.  The rectangle holds its
        fixed pivots, and the regions for fixed pivots, or the poses where there are none.
    bounds : PairBounds, optional
        What pairs are held to; by default `PairBounds.of(task)`.
    samples : int
        Dyads along the curve of four poses, about.
    columns, rows : int
        Of the grid of three poses.

    Raises
    ------
    InputError
        E121 (another number of poses), E123 (tolerances of poses; limits that put a pivot at a
        point or on a line, so that no dyad of a map is within them), E124 (four poses that do not
        determine a curve).
    """
    count = task.poses.shape[0]
    if count not in (3, 4):
        raise InputError(
            "E121",
            f"the map of a family takes 3 or 4 different poses, not {count}",
            why="two poses leave more freedom than a map shows, five leave none",
            help="leave the map out",
        )
    if task.tolerances is not None:
        raise InputError(
            "E123",
            "the map of a family is one of poses that are met exactly",
            why="poses within tolerances have dyads beside those of a map",
            help="leave the map out, or the tolerances",
        )
    exact = [limits.conditions for limits in task.limits]
    if sum(exact) if count == 4 or len(exact) < 2 else min(exact):
        raise InputError(
            "E123",
            "limits that put a pivot at a point or on a line leave no family to map",
            why="no dyad of the map meets them, but for a few between its samples",
            help="leave the map out, or give regions in place of points and lines",
        )
    if count == 4:
        return curve_map(task, bounds, samples)
    if recommended is None:
        return None
    dyads = recommended.first, recommended.second
    at_a_place = [limits for limits in task.limits if limits.conditions]
    choices = [
        one
        for one, other in (dyads, dyads[::-1])
        if not isinstance(one, PP)
        and isinstance(other, RR)
        and all(meets_limits(one, limits, task) for limits in at_a_place)
    ]
    if not choices:
        return None
    chosen = choices[0]
    low, high = _rectangle(task, [each.fixed_pivot for each in dyads if isinstance(each, RR | RP)])
    return plane_map(task, chosen, low, high, columns=columns, rows=rows, bounds=bounds)


def _pivots(dyads: RR) -> FloatArray:
    """Both pivots (*, 4) of dyads (*,)."""
    return np.concatenate([dyads.fixed_pivot, dyads.moving_pivot], axis=-1)


def _rectangle(task: Task, pivots: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Two corners of a 4 to 3 rectangle around pivots and limits, or poses, with a border."""
    regions = [each.fixed_pivot for each in task.limits if each.fixed_pivot is not None]
    limited = bool(regions) and len(regions) == len(task.limits)
    edges = [region.corners() for region in regions] if limited else [task.poses.translation]
    known = [each for each in edges if each is not None]
    points = np.concatenate([*known, np.reshape(pivots, (-1, 2))])
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    border = LIMITED_BORDER * size if limited else BORDER * max(span(task), size / 4)
    half = (high - low) / 2 + max(border, LIMITED_BORDER * span(task))
    half = np.maximum(half, half[::-1] * np.array([COLUMNS / ROWS, ROWS / COLUMNS]))
    return (low + high) / 2 - half, (low + high) / 2 + half
