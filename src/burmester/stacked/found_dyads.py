"""The dyads of many fits, each as the circle or the slider that it is: `found_dyads` for stacks.

Solutions and dyads of all tasks are rows, those of one task together.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.long_links import SENSIBLE_SWING, swings
from burmester.dyads.pencil import Pencil
from burmester.dyads.selection import (
    COEFFICIENT_ROUNDING,
    LOST_SHARE,
    MAX_LENGTH,
    MAX_SLIDER_ANGLE,
    SAME_DYAD,
    SLIDER_AS_WELL,
    STRAIGHT_SWING,
)
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage_batch import DIMENSIONS, DYAD_KINDS
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.numerics.bundles import concatenate, take
from burmester.stacked.task_stack import TaskStack
from burmester.tasks.motion_task import COARSE

__all__ = [
    "ANGLES",
    "Fits",
    "Found",
    "Solutions",
    "beside",
    "found_in_stack",
    "least_slider_angle",
    "same_dyads",
]

NEAR = 1 + 1e-9  # times an angle, so that rounding leaves no slider out

Mask = NDArray[np.bool_]
Indices = NDArray[np.intp]


class Fits(NamedTuple):
    """What the fits of tasks (T,) share.

    frames, seen: where they were fitted, and the poses (T, N) seen there; length: (T,), the
    characteristic ones of the tasks.
    exact: whether solutions should meet the poses; minima: whether they are locally best dyads.
    """

    stack: TaskStack
    frames: CanonicalFrames
    seen: Displacement
    length: FloatArray
    exact: bool = False
    minima: bool = False

    @property
    def poses(self) -> Displacement:
        """The poses (T, N) of the tasks."""
        return self.stack.displacements

    @property
    def weights(self) -> FloatArray | None:
        """Their weights (T, N)."""
        return self.stack.weights

    def of_those(self, mask: Mask) -> Fits:
        """Those of some tasks only, by a mask (T,)."""
        frames, seen, length = take((self.frames, self.seen, self.length), mask)
        return self._replace(stack=self.stack[mask], frames=frames, seen=seen, length=length)

    @property
    def relative_resolution(self) -> FloatArray:
        """How exactly poses are known, as a share of the length (T,)."""
        position, angle = self.stack.resolution
        known = np.minimum(position / self.length + angle, COARSE)
        return np.asarray(np.maximum(known, ROUNDING))

    def blur(self, noise: FloatArray, gap: FloatArray) -> FloatArray:
        """The sine (T,) of the angle by which noise turns a manifold from the slider it is."""
        count = self.poses.shape[-1]
        blur = np.maximum(noise, self.relative_resolution * np.sqrt(count))
        blur = np.maximum(blur, COEFFICIENT_ROUNDING)
        return np.asarray(np.minimum(3 * blur / np.maximum(gap, 1e-300), MAX_SLIDER_ANGLE))


class Solutions(NamedTuple):
    """Solutions (k,) of fits: the task of each, by rising task, and its circle.

    coefficients: (k, 8), in the frames of the fit; circle: (k,), in the task's own.
    """

    task: Indices
    coefficients: FloatArray
    circle: RR
    rms: FloatArray
    worst: FloatArray

    @classmethod
    def of(cls, fit: FivePoseDyads | Pencil) -> Solutions:
        """The solutions of fits (T,) that there are, several a task."""
        task, number = np.nonzero(np.isfinite(fit.coefficients).all(axis=-1))
        return cls(
            task,
            fit.coefficients[task, number],
            fit.dyads[task, number],
            fit.rms_error[task, number],
            fit.max_error[task, number],
        )


class Found(NamedTuple):
    """Dyads (D,) of tasks, in the order of `found_dyads`; those of one task together.

    kind: in `DYAD_KINDS`; dimensions: (D, 5), as in `LinkageBatch`, in the task's own frames.
    left_out: (T,), the solutions that are no dyads.
    """

    task: Indices
    kind: NDArray[np.int8]
    dimensions: FloatArray
    rms: FloatArray
    worst: FloatArray
    left_out: NDArray[np.intp]

    def of_those(self, mask: Mask) -> Found:
        """Those of some tasks only, by a mask (T,)."""
        rows, number = mask[self.task], np.cumsum(mask) - 1
        kept = take(self._replace(left_out=self.task), rows)
        return kept._replace(task=number[kept.task], left_out=self.left_out[mask])


class _Rows(NamedTuple):
    """Dyads (k,) before they are put in order; place: of those of one task, which came first."""

    task: Indices
    place: Indices
    kind: NDArray[np.int8]
    dimensions: FloatArray
    rms: FloatArray
    worst: FloatArray


def found_in_stack(
    fits: Fits, solutions: Solutions, blur: FloatArray, *, lines: bool = False
) -> Found:
    """The dyads of the fits of a stack, each once, in the order of `found_dyads`.

    blur: (T,), see `Fits.blur`; lines: whether the best slider of each kind is one of the dyads.
    """
    p, task, radius = solutions.coefficients, solutions.task, solutions.circle.radius
    length, size = fits.length, constraint_manifold.size(solutions.coefficients)
    if fits.minima:
        near = np.abs(p[:, 0]) / size < MAX_SLIDER_ANGLE
    else:
        near = (
            least_slider_angle(p) / size
            < NEAR * np.minimum(blur[task], MAX_SLIDER_ANGLE) + ROUNDING
        )
    straight = np.flatnonzero(near)
    sliders, stands = _nearest_sliders(fits, take(solutions, straight), blur)
    is_circle = np.ones(len(task), dtype=bool)
    is_circle[straight[stands]] = False
    two_angles = np.linalg.norm(p[:, [0, 2, 3, 4, 5]], axis=1) < SAME_DYAD * size
    dropped = two_angles | ~(radius < MAX_LENGTH * length[task])
    if fits.exact:
        dropped |= solutions.rms > LOST_SHARE * np.maximum(length[task], radius)
    dropped &= is_circle
    kept, circle = np.flatnonzero(is_circle & ~dropped), solutions.circle
    pivots = [circle.fixed_pivot, circle.moving_pivot, radius[:, None]]
    circles = _Rows(
        task[kept],
        kept,
        np.zeros(len(kept), dtype=np.int8),
        np.concatenate(pivots, axis=1)[kept],
        solutions.rms[kept],
        solutions.worst[kept],
    )
    parts = [circles, sliders._replace(place=straight[sliders.place])]
    if lines:
        every = np.arange(len(length))
        on_ground, in_body = (
            of(fits.seen, fits.weights)[0][..., 0] for of in (fixed_lines, moving_lines)
        )
        parts.append(_slider_rows(fits, on_ground, every, every + len(task)))
        parts.append(_slider_rows(fits, in_body, every, every + len(task) + 1))
    rows = concatenate(parts)
    rows = take(rows, np.lexsort((rows.place, rows.task)))
    # Circles of exact fits and of pencils are apart, whatever their rounding.
    rows = take(rows, _once(rows, length, every=fits.minima))
    link = np.where(rows.kind == DYAD_KINDS.index(RR), rows.dimensions[:, 4], np.inf)
    shown = np.round(rows.rms / (ROUNDING * length[rows.task]))
    rows = take(rows, np.lexsort((link, shown, rows.task)))
    left_out = np.bincount(solutions.task[dropped], minlength=len(length))
    return Found(rows.task, rows.kind, rows.dimensions, rows.rms, rows.worst, left_out)


def least_slider_angle(p: FloatArray) -> FloatArray:
    """The sine (k,) of the least angle between manifolds p (k, 8) and a slider, times their size.

    A slider has no first coefficient, and one of its two prismatic parts is zero.
    """
    in_f, in_m = constraint_manifold.prismatic_parts(p)
    # The parts are a quarter of sums of two coefficients: 8 times their squares is what these add.
    other = 8 * np.minimum((in_f**2).sum(axis=1), (in_m**2).sum(axis=1))
    return np.asarray(np.sqrt(p[:, 0] ** 2 + other))


def _nearest_sliders(fits: Fits, solutions: Solutions, blur: FloatArray) -> tuple[_Rows, Mask]:
    """The sliders that stand for solutions (k,) with p1 ~ 0, and which of these they stand for."""
    p, task = solutions.coefficients, solutions.task
    in_f, in_m = constraint_manifold.prismatic_parts(p)
    on_ground = np.linalg.norm(in_f, axis=1) >= np.linalg.norm(in_m, axis=1)
    sine, miss = np.empty(len(task)), np.empty(len(task))
    nearest: list[tuple[Indices, PR | RP]] = []
    for of, part, mask in ((fixed_lines, in_f, on_ground), (moving_lines, in_m, ~on_ground)):
        index = np.flatnonzero(mask)
        which = task[index]
        weights = None if fits.weights is None else fits.weights[which]
        lines, rms, _ = of(fits.seen[which], weights)
        normal = lines.normal_angle
        along = np.cos(normal) * part[index, :1] + np.sin(normal) * part[index, 1:]
        pick = np.arange(len(index)), np.abs(along).argmax(axis=1)
        line = lines[pick]
        nearest.append((index, line))
        q, own = (
            each / constraint_manifold.INVARIANT / constraint_manifold.size(each)[:, None]
            for each in (line.coefficients(), p[index])
        )
        sine[index] = np.linalg.norm(own - (own * q).sum(axis=1, keepdims=True) * q, axis=1)
        miss[index] = fits.frames.length[which] * rms[pick]
    stands = _stands(fits, solutions, blur[task], sine, miss)
    parts = []
    for index, line in nearest:
        these = stands[index]
        parts.append(_slider_rows(fits, line[these], task[index[these]], index[these]))
    return concatenate(parts), stands


def _stands(
    fits: Fits, solutions: Solutions, blur: FloatArray, sine: FloatArray, miss: FloatArray
) -> Mask:
    """Whether sliders stand for solutions (k,), at an angle from them, that miss the poses so."""
    swung = swings(solutions.circle, fits.poses[solutions.task])
    double = swung < STRAIGHT_SWING
    known = (fits.relative_resolution * fits.length)[solutions.task]
    rounding = np.finfo(float).eps * solutions.circle.radius  # of a distance so great
    allowed = np.maximum(np.maximum(np.where(double, 2, 1) * solutions.rms, known), rounding)
    as_near = (miss <= allowed) | ~np.isfinite(allowed)
    sensible = (swung > SENSIBLE_SWING) & (solutions.rms <= np.maximum(miss, known))
    stands = (sine < blur) & as_near & ~sensible
    if fits.minima:  # a long link that gains next to nothing is no other dyad than its slider
        stands |= double & (miss <= SLIDER_AS_WELL * solutions.rms)
    return np.asarray(stands)


def _slider_rows(fits: Fits, line: PR | RP, task: Indices, place: Indices) -> _Rows:
    """Lines (k,) that were found in the frames of tasks (k,), as rows; nan beyond all measure."""
    frames, seen, unit = take(fits.frames, task), fits.seen[task], fits.frames.length[task]
    pivot = line.moving_pivot if isinstance(line, PR) else line.fixed_pivot
    distance = unit[:, None] * line[:, None].residual(seen)
    rms, worst = np.sqrt((distance**2).mean(axis=1)), np.abs(distance).max(axis=1)
    near = np.abs(pivot).max(axis=1) < MAX_LENGTH
    own = frames.line_from_canonical(line)
    normal, offset, zero = own.normal_angle[:, None], own.offset[:, None], np.zeros((len(task), 1))
    if isinstance(own, PR):
        dimensions = np.concatenate([normal, offset, own.moving_pivot, zero], axis=1)
    else:
        dimensions = np.concatenate([own.fixed_pivot, normal, offset, zero], axis=1)
    dimensions[~near] = np.nan
    kind = np.full(len(task), DYAD_KINDS.index(type(line)), dtype=np.int8)
    return _Rows(task, place, kind, dimensions, rms, worst)


class _Padded(NamedTuple):
    """Dyads in rows of a table, a row a task: kinds (T, K), -1 for none, dimensions (T, K, 5)."""

    kind: NDArray[np.int8]
    dimensions: FloatArray
    column: Indices

    @classmethod
    def of(cls, rows: _Rows | Found, tasks: int) -> _Padded:
        count = np.bincount(rows.task, minlength=tasks)
        column = np.arange(len(rows.task)) - np.repeat(np.cumsum(count) - count, count)
        shape = tasks, int(count.max(initial=0))
        kind, dimensions = np.full(shape, -1, dtype=np.int8), np.full((*shape, DIMENSIONS), np.nan)
        kind[rows.task, column], dimensions[rows.task, column] = rows.kind, rows.dimensions
        return cls(kind, dimensions, column)

    def same(self, late: int, length: FloatArray) -> Mask:
        """Which of the dyads (T, late) before the one in a column are the same dyad as that."""
        kind = self.kind[:, late]
        most = np.where(ANGLES[kind], SAME_DYAD, SAME_DYAD * length[:, None])
        near = np.abs(self.dimensions[:, :late] - self.dimensions[:, late, None]) < most[:, None]
        return np.asarray((self.kind[:, :late] == kind[:, None]) & near.all(axis=2))


def _once(rows: _Rows, length: FloatArray, *, every: bool) -> Mask:
    """Which of rows (k,), by rising task, are dyads of which no earlier one is the same.

    every: whether circles are compared too, not only sliders.
    """
    table = _Padded.of(rows, len(length))
    kept = np.asarray(np.isfinite(table.dimensions).all(axis=2))
    for late in range(1, kept.shape[1]):
        compared = every | (table.kind[:, late] != DYAD_KINDS.index(RR))
        kept[:, late] &= ~(compared & (table.same(late, length) & kept[:, :late]).any(axis=1))
    return np.asarray(kept[rows.task, table.column])


def beside(first: Found, more: Found, length: FloatArray) -> tuple[Found, Mask]:
    """The dyads of tasks, those of `more` after the first ones, if they are not the same as those.

    Returns them, and which (D,) are of `more`.
    """
    task = np.concatenate([first.task, more.task])
    late = np.arange(len(task)) >= len(first.task)
    order = np.argsort(task, kind="stable")
    both = first._replace(left_out=first.task), more._replace(left_out=more.task)
    rows: Found = take(concatenate(both), order)
    late = late[order]
    table = _Padded.of(rows, len(length))
    kept, of_more = table.kind >= 0, np.zeros(table.kind.shape, dtype=bool)
    of_more[rows.task, table.column] = late
    for column in range(1, kept.shape[1]):
        same = (table.same(column, length) & ~of_more[:, :column]).any(axis=1)
        kept[:, column] = ~(same & of_more[:, column])
    keep = kept[rows.task, table.column]
    return take(rows, keep)._replace(left_out=first.left_out), late[keep]


def same_dyads(found: Found, length: FloatArray) -> Indices:
    """The task of each pair of dyads that are the same."""
    table, tasks = _Padded.of(found, len(length)), [np.zeros(0, dtype=np.intp)]
    for late in range(1, table.kind.shape[1]):
        tasks.append(np.nonzero(table.same(late, length))[0])
    return np.concatenate(tasks)


# Which dimensions of each kind of dyad are angles.
ANGLES = np.zeros((len(DYAD_KINDS), DIMENSIONS), dtype=bool)
ANGLES[DYAD_KINDS.index(PR), 0] = ANGLES[DYAD_KINDS.index(RP), 2] = True
