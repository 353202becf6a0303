"""The dyads of fits of tasks (T,), each as the circle or the slider that it is.

Solutions and dyads of all tasks are rows, those of one task together.  One task is a stack of one
(`found_dyads`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.critical_points import CriticalDyads
from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.local_minima import BestDyads, ManyBestDyads
from burmester.dyads.pencil import MIN_POSES, Pencil, fit_pencil
from burmester.dyads.sliders import SENSIBLE_SWING, fixed_lines, moving_lines, swings
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage_batch import DIMENSIONS, DYAD_KINDS, dyads_of, row_of
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray, concatenate, take
from burmester.tasks.motion_task import COARSE, Task, characteristic_length

Fit: TypeAlias = Pencil | FivePoseDyads | BestDyads

# Lengths are in characteristic lengths of the task.
MAX_SLIDER_ANGLE = 0.05  # sine; a manifold at a greater angle to a slider's is not that slider
STRAIGHT_SWING = 0.02  # radians; a link that swings less is a slider if that fits half as well
SLIDER_AS_WELL = 1.01  # ratio of errors, up to which a slider stands for a long link beside it
LOST_SHARE = 1e-6  # of the size; a greater error of an exact dyad is no longer rounding
MAX_LENGTH = 1e9  # no link is longer, and no pivot farther away
SAME_DYAD = 1e-6  # length or angle; dyads whose dimensions differ by less are one
MAX_POSE_ERRORS = 2.0  # errors of a pose; a dyad that misses by no more meets it within its digits
DISTANCE_ROUNDING = 64.0  # units in the last place of all that a distance is made of
COEFFICIENT_ROUNDING = 1e-9  # share of a manifold's norm that rounding leaves of a zero
NEAR = 1 + 1e-9  # times an angle, so that rounding leaves no slider out

Mask = NDArray[np.bool_]
Indices = NDArray[np.intp]
KINDS = (*DYAD_KINDS, PP)  # of dyads, by their number
CIRCLE, FIXED_LINE, MOVING_LINE = range(len(DYAD_KINDS))
# Which dimensions of each kind of dyad are angles.
ANGLES = np.zeros((len(KINDS), DIMENSIONS), dtype=bool)
ANGLES[FIXED_LINE, 0] = ANGLES[MOVING_LINE, 2] = ANGLES[KINDS.index(PP), 0] = True


@final
@dataclass(frozen=True, slots=True, eq=False)
class FoundDyad:
    """A dyad with its distance from the poses, in the task's length unit.

    minimum: whether it is a local minimum of what the method minimises; the exact method's
    dyads pass through the poses and are minima all.
    limits: which of the two limits of a task it obeys, 1 or 2; 0 where both dyads have the same.
    """

    id: str
    dyad: Dyad
    rms_error: float
    max_error: float
    minimum: bool = True
    limits: int = 0

    @classmethod
    def of(cls, id: str, dyad: Dyad, poses: Displacement, *, minimum: bool = True) -> Self:
        """A dyad with its distance from poses (N,)."""
        miss = np.abs(dyad.residual(poses))
        return cls(id, dyad, float(np.sqrt((miss**2).mean())), float(miss.max()), minimum)

    def at(self, poses: Displacement) -> Self:
        """The same with its distance from other poses."""
        there = FoundDyad.of(self.id, self.dyad, poses)
        return replace(self, rms_error=there.rms_error, max_error=there.max_error)


def found_dyads(fit: Fit, task: Task) -> tuple[list[FoundDyad], int]:
    """The dyads of the fit of one task, and how many solutions are none: see `dyads_of_fits`."""
    given = GivenPoses.of(task)
    if not isinstance(fit, BestDyads):
        fits = Fits.of(take(fit, None), given)
    else:
        frames, one = take(fit.frames, None), np.zeros(1, dtype=np.intp)
        every = np.zeros(len(fit.rms_error), dtype=np.intp)
        fits = Fits(
            given,
            frames,
            frames.to_canonical(given.poses),
            Solutions(every, fit.coefficients, fit.dyads, fit.rms_error, fit.max_error),
            [(one, line[None]) for line in fit.sliders],
            minima=True,
            limited=not isinstance(fit.search, CriticalDyads),
        )
    found = dyads_of_fits(fits)
    return found.listed(), int(found.left_out[0])


class GivenPoses(NamedTuple):
    """Tasks with poses (T, N), their weights (T, N), and their characteristic lengths (T,).

    resolution: how exactly the poses of all are known, as in `Task`.
    """

    poses: Displacement
    weights: FloatArray | None
    length: FloatArray
    resolution: tuple[float, float]

    @classmethod
    def of(cls, task: Task, length: float | None = None) -> Self:
        """Those of one task; length: where it is known."""
        size = characteristic_length(task) if length is None else length
        weights = None if task.weights is None else task.weights[None]
        return cls(task.poses[None], weights, np.array([size]), task.resolution)

    @property
    def relative_resolution(self) -> FloatArray:
        """How exactly poses are known, as a share of the length (T,)."""
        position, angle = self.resolution
        known = np.minimum(position / self.length + angle, COARSE)
        return np.asarray(np.maximum(known, ROUNDING))


class Solutions(NamedTuple):
    """Solutions (k,) of fits: the task of each, by rising task, and its circle.

    coefficients: (k, 8), in the frames of the fit; circle: (k,), in the task's own.
    """

    task: Indices
    coefficients: FloatArray
    circle: RR
    rms: FloatArray
    worst: FloatArray


class Fits(NamedTuple):
    """Fits of tasks (T,), and what decides which dyads they have.

    frames, seen: where they were fitted, and the poses (T, N) seen there.
    sliders: dyads as they are, in the frames, each kind with its tasks, rising.
    noise: (T,) each, how far noise moves the manifolds, and how far off others are; None where it
    takes a pencil to tell.
    exact: whether solutions should meet the poses; minima: whether they are locally best dyads;
    limited: whether these are so within limits.
    """

    given: GivenPoses
    frames: CanonicalFrames
    seen: Displacement
    solutions: Solutions
    sliders: Sequence[tuple[Indices, PR | RP]] = ()
    noise: tuple[FloatArray, FloatArray] | None = None
    exact: bool = False
    minima: bool = False
    limited: bool = False

    @classmethod
    def of(cls, fit: Pencil | FivePoseDyads | ManyBestDyads, given: GivenPoses) -> Self:
        """Those of tasks with a fit (T,) of all."""
        if isinstance(fit, ManyBestDyads):
            some, every, frames = fit.minima, np.arange(len(given.length)), fit.search.frames
            solutions = Solutions(some.task, some.circles.coefficients(), *some[2:])
            sliders = [(every, line) for line in fit.sliders]
            seen = frames.to_canonical(given.poses)
            return cls(given, frames, seen, solutions, sliders, minima=True)
        at = task, _ = np.nonzero(np.isfinite(fit.coefficients).all(axis=-1))
        parts = fit.coefficients[at], fit.dyads[at], fit.rms_error[at], fit.max_error[at]
        return cls(
            given,
            fit.frames,
            fit.frames.to_canonical(given.poses),
            Solutions(task, *parts),
            noise=(fit.noise, fit.gap),
            exact=isinstance(fit, FivePoseDyads),
        )

    def blur(self, index: Indices) -> FloatArray:
        """The sine (k,) of the angle by which noise turns a manifold of tasks from a slider."""
        count, some = self.seen.shape[-1], take(self.given, index)
        if self.noise is not None:
            noise, gap = (each[index] for each in self.noise)
        elif count < MIN_POSES:
            return np.full(len(index), MAX_SLIDER_ANGLE)
        else:
            pencil = fit_pencil(some.poses, some.weights)
            noise, gap = pencil.noise, pencil.gap
        # Noise turns the null space, and so every manifold in it, by about this angle.
        blur = np.maximum(noise, some.relative_resolution * np.sqrt(count))
        blur = np.maximum(blur, COEFFICIENT_ROUNDING)
        return np.asarray(np.minimum(3 * blur / np.maximum(gap, 1e-300), MAX_SLIDER_ANGLE))


class Found(NamedTuple):
    """Dyads (D,) of tasks, those of one task together.

    kind: in `KINDS`; dimensions: (D, 5), as in `LinkageBatch`, in the task's own frames; of a PP
    dyad its angle.  left_out: (T,), the solutions that are no dyads.
    """

    task: Indices
    kind: NDArray[np.int8]
    dimensions: FloatArray
    rms: FloatArray
    worst: FloatArray
    left_out: NDArray[np.intp]

    @classmethod
    def of(cls, dyads: Sequence[FoundDyad], left_out: int = 0) -> Self:
        """The dyads of one task."""
        rows = [row_of(each.dyad) for each in dyads]
        return cls(
            np.zeros(len(rows), dtype=np.intp),
            np.array([KINDS.index(type(each.dyad)) for each in dyads], dtype=np.int8),
            np.array(rows, dtype=np.float64).reshape(-1, DIMENSIONS),
            np.array([each.rms_error for each in dyads]),
            np.array([each.max_error for each in dyads]),
            np.array([left_out]),
        )

    def listed(self) -> list[FoundDyad]:
        """The dyads one by one, numbered as if they were of one task."""
        errors = zip(self.rms.tolist(), self.worst.tolist(), strict=True)
        return [
            FoundDyad(f"D{k + 1}", dyads_of(int(self.kind[k]), self.dimensions[k]), *both)
            for k, both in enumerate(errors)
        ]


class _Rows(NamedTuple):
    """Dyads (k,) before they are put in order; place: of those of one task, which came first."""

    task: Indices
    place: Indices
    kind: NDArray[np.int8]
    dimensions: FloatArray
    rms: FloatArray
    worst: FloatArray


def dyads_of_fits(fits: Fits) -> Found:
    """The dyads of fits, each as the circle or the slider that it is, and each once.

    A long link is a slider where the line it nearly follows fits the poses as well as the
    circle does, or as well as the poses are known; for noisy poses that is a heuristic.  But a link
    that swings by SENSIBLE_SWING, and meets the poses as the line does, is kept.
    Sorted by rms error; where errors are mere rounding, by the length of the link.

    Left out are solutions that are no dyads: the link would be infinitely long and no slider fits
    in its place, the manifold determines nothing but the angle (two planes, which hold the poses
    where these have two different angles only: a double root, so known to half the digits), or a
    dyad that should be exact is not, as rounding took its digits.
    """
    solutions, length = fits.solutions, fits.given.length
    p, task, radius = solutions.coefficients, solutions.task, solutions.circle.radius
    size, blur = constraint_manifold.size(p), np.full(len(length), MAX_SLIDER_ANGLE)
    if fits.limited:  # it takes a fit of its own, and is seldom asked for
        near = np.zeros(len(task), dtype=bool)
    elif fits.minima:
        near = np.abs(p[:, 0]) < MAX_SLIDER_ANGLE * size
    else:
        blur = fits.blur(np.arange(len(length)))
        near = least_slider_angle(p) < (NEAR * blur[task] + ROUNDING) * size
    is_circle, parts = np.ones(len(task), dtype=bool), []
    if len(straight := np.flatnonzero(near)):
        if fits.minima:
            some = np.unique(task[straight])
            blur[some] = fits.blur(some)
        sliders, stands = _nearest_sliders(fits, take(solutions, straight), blur)
        is_circle[straight[stands]] = False
        parts.append(sliders._replace(place=straight[sliders.place]))
    two_angles = np.linalg.norm(p[:, [0, 2, 3, 4, 5]], axis=1) < SAME_DYAD * size
    dropped = two_angles | ~(radius < MAX_LENGTH * length[task])
    if fits.exact:
        dropped |= solutions.rms > LOST_SHARE * np.maximum(length[task], radius)
    if fits.limited and fits.sliders:  # on their way to one of them
        is_circle &= swings(solutions.circle, fits.given.poses[task]) >= STRAIGHT_SWING
    dropped &= is_circle
    kept = np.flatnonzero(is_circle & ~dropped)
    circles = _Rows(
        task[kept],
        kept,
        np.full(len(kept), CIRCLE, dtype=np.int8),
        row_of(solutions.circle)[kept],
        solutions.rms[kept],
        solutions.worst[kept],
    )
    parts.append(circles)
    for number, (index, line) in enumerate(fits.sliders, start=len(task)):
        parts.append(_slider_rows(fits, line, index, np.full(len(index), number)))
    rows = concatenate(parts)
    rows = take(rows, np.lexsort((rows.place, rows.task)))
    # Circles of exact fits and of pencils are apart, whatever their rounding.
    rows = take(rows, _once(rows, length, every=fits.minima))
    link = np.where(rows.kind == CIRCLE, rows.dimensions[:, 4], np.inf)
    shown = np.round(rows.rms / (ROUNDING * length[rows.task]))
    rows = take(rows, np.lexsort((link, shown, rows.task)))
    left_out = np.bincount(task[dropped], minlength=len(length))
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
        if not len(index):
            continue
        which = task[index]
        weights = None if fits.given.weights is None else fits.given.weights[which]
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
    swung = swings(solutions.circle, fits.given.poses[solutions.task])
    double = swung < STRAIGHT_SWING
    known = (fits.given.relative_resolution * fits.given.length)[solutions.task]
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
    dimensions = row_of(frames.line_from_canonical(line))
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
        compared = every | (table.kind[:, late] != CIRCLE)
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
    task, one, other = same_dyads(rows, length)
    start = np.searchsorted(rows.task, task)
    again = (start + other)[~late[start + one] & late[start + other]]
    kept = np.delete(np.arange(len(late)), again)
    return take(rows, kept)._replace(left_out=first.left_out), late[kept]


def same_dyads(found: Found, length: FloatArray) -> tuple[Indices, Indices, Indices]:
    """The task of each pair of dyads that are the same, and their places, from 0, among its own."""
    table, pairs = _Padded.of(found, len(length)), [np.zeros((2, 0), dtype=np.intp)]
    late = [np.zeros(0, dtype=np.intp)]
    for column in range(1, table.kind.shape[1]):
        pairs.append(np.stack(np.nonzero(table.same(column, length))))
        late.append(np.full(pairs[-1].shape[1], column))
    task, early = np.concatenate(pairs, axis=1)
    return task, early, np.concatenate(late)


def within_digits(found: Found, given: GivenPoses, times: float | FloatArray = 1.0) -> Mask:
    """Which dyads (D,) meet all poses within the errors, or a number (D,) of times as much, that
    their digits leave.
    """
    z, kind, task = found.dimensions, found.kind, found.task
    d, (position, angle) = given.poses.translation, given.resolution
    size = np.abs(d).max(axis=(1, 2))[task]
    first, second = np.abs(z[:, :2]), np.abs(z[:, 2:4])
    parts = np.where(kind == FIXED_LINE, first.sum(axis=1), first.max(axis=1))
    parts = parts + np.where(kind == MOVING_LINE, second.sum(axis=1), second.max(axis=1)) + z[:, 4]
    lever = np.linalg.norm(z[:, 2:4], axis=1)
    slots = np.flatnonzero(kind == MOVING_LINE)
    if len(slots):
        away = z[slots, None, :2] - d[task[slots]]
        lever[slots] = np.linalg.norm(away, axis=-1).max(axis=1)
    turns = np.maximum(1.0, np.abs(given.poses.angle).max(axis=1))[task]
    rounding = DISTANCE_ROUNDING * np.finfo(float).eps * (size + parts + lever * turns)
    allowed = MAX_POSE_ERRORS * (position + lever * angle) + rounding
    return np.asarray(found.worst <= times * allowed)
