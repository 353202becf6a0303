"""The locally best dyads of a task: every minimum of the residual, by true distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_descent import circle_minima, reach, sharpened_circles
from burmester.dyads.critical_points import LITTLE_TURN, CriticalDyads, critical_dyads
from burmester.dyads.critical_search import COUNT
from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.pencil import MIN_POSES, fit_pencil
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, concatenate, shares, take
from burmester.tasks.limits import Limits
from burmester.tasks.option_table import Norm
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.repeated_poses import spanning

if TYPE_CHECKING:  # a search of its own, which most tasks do without
    from burmester.dyads.minima_within_limits import LimitedDyads

# Of more poses a sample of about so many is followed to minima, and all from these on.
MAX_POSES_FOLLOWED = 500


QUINTUPLES = 3  # of poses, at most; more found nothing new in a campaign

# Generic factors by which one of each pair of conjugate points is picked.
CONJUGATE_PICK = np.sqrt([2.0, 3.0, 5.0, 7.0])
START_LENGTH = 20.0  # characteristic lengths; the links that start along a line
ROUGH_DISTANCE = 0.1  # characteristic lengths, rms; from it on for the best start, more are made

Indices = NDArray[np.intp]


@final
@dataclass(frozen=True, slots=True, eq=False)
class BestDyads:
    """The locally best dyads of a task, by distance from their circles and lines.

    search: what they come from, with the count that says whether all were found.
    circles: (k,) in `frames`, dyads: the same in the task's own.
    sliders: PR and RP dyads in `frames`.
    rms_error, max_error: (k,), the distance of the moving pivot from its circle over the poses, in
        the task's unit.
    unfinished: how many ways down were given up where they were better already than the second
        dyad, so that a better one may be missing.
    """

    search: CriticalDyads | LimitedDyads
    circles: RR
    dyads: RR
    sliders: tuple[PR | RP, ...]
    rms_error: FloatArray
    max_error: FloatArray
    unfinished: int

    @property
    def frames(self) -> CanonicalFrames:
        """Where they were found."""
        return self.search.frames

    @property
    def coefficients(self) -> FloatArray:
        """Their manifolds (k, 8), in `frames`."""
        return self.circles.coefficients()

    def listed(self) -> list[Dyad]:
        """The circles and then the sliders, in the task's frames."""
        circles: list[Dyad] = [self.dyads[k] for k in range(len(self.rms_error))]
        return circles + [self.frames.line_from_canonical(each) for each in self.sliders]


class Minima(NamedTuple):
    """Circles (m,) of tasks, by rising task: in canonical frames, in the task's own, and errors."""

    task: NDArray[np.intp]
    circles: RR
    dyads: RR
    rms_error: FloatArray
    max_error: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class ManyBestDyads:
    """The locally best dyads of tasks (T,), as `BestDyads` has those of one.

    sliders: (T,), the best of each kind; minima: those of all tasks; unfinished: (T,).
    """

    search: CriticalDyads
    sliders: tuple[PR, RP]
    minima: Minima
    unfinished: NDArray[np.intp]

    def of_one(self) -> BestDyads:
        """Those of the only task."""
        search, sliders = take((self.search, self.sliders), 0)
        return BestDyads(
            search, *self.minima[1:3], sliders, *self.minima[3:], int(self.unfinished[0])
        )


def best_dyads(
    poses: Displacement,
    weights: FloatArray | None = None,
    exact: NDArray[np.bool_] | None = None,
    limits: Limits | None = None,
    norm: Norm = "rms",
) -> BestDyads:
    """The locally best dyads of poses, by distance from their circles and lines.

    Without limits, exact poses and another norm: the minima of the distance |R m + d - c| - r to
    which Newton's method leads from every critical point of the squared residual (from the real
    part of a complex one; for rough poses from that part with the imaginary one added and taken
    off, too) and from long links along the best lines; where the body turns little, or critical
    points are lost, from dyads of the pencil and of five of the poses; and the best slider of each
    kind; else as `limited_dyads` describes.  That the distance has no minimum elsewhere is not
    proved; its minima go over into those of the residual as the errors become small.

    Formula `true-distance` of the theory.

    Parameters
    ----------
    poses : Displacement, (N,)
        N >= 5 poses.
    weights : array, (N,), optional
        Of the squared distances.
    exact : array of bool, (N,), optional
        Poses that a dyad has to meet exactly.
    limits : Limits, optional
        Regions of the pivots and bounds of the link's length.
    norm : {"rms", "worst"}, default "rms"
        Whether the sum of squares or the worst distance is minimised.

    Returns
    -------
    BestDyads
        The dyads by rising error, the sliders, and the search that they come from.

    Raises
    ------
    InputError
        E121 (fewer than 5 poses), E103 (a number that is not finite).

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> best = best_dyads(poses)
    >>> best.dyads.radius.round(4)
    array([1.    , 1.3538])
    >>> best.rms_error.round(4)
    array([0.    , 0.0027])
    """
    if limits is not None or norm != "rms" or (exact is not None and exact.any()):
        from burmester.dyads.minima_within_limits import limited_dyads  # noqa: PLC0415

        search = limited_dyads(poses, weights, exact, limits, norm)
        distance = search.circles[:, None].residual(search.frames.to_canonical(poses))
        return with_errors(search, search.circles, search.sliders, distance)
    return best_dyads_of_tasks(poses[None], None if weights is None else weights[None]).of_one()


def best_dyads_of_tasks(poses: Displacement, weights: FloatArray | None = None) -> ManyBestDyads:
    """The same of many tasks with poses (T, N), without limits, exact poses and another norm."""
    search = critical_dyads(poses, weights)
    _, seen = CanonicalFrames.of(poses, weights)  # with less rounding than by these frames
    lines = fixed_lines(seen, weights)[0][:, 0], moving_lines(seen, weights)[0][:, 0]
    hard = is_hard(search.found + search.at_infinity, seen, shares(weights, poses.shape))
    easy = np.flatnonzero(~hard & (seen.shape[1] <= MAX_POSES_FOLLOWED))
    alone = np.delete(np.arange(len(hard)), easy)
    unfinished, parts = np.zeros(len(hard), dtype=np.intp), []
    together = [easy] if len(easy) or not len(alone) else []
    for index in (*together, *alone[:, None]):
        some = take((search, lines, seen, poses, weights), index)
        rows, unfinished[index] = _minima(*some, hard=bool(hard[index].any()))
        parts.append(rows._replace(task=index[rows.task]))
    rows = concatenate(parts)
    rows = take(rows, np.argsort(rows.task, kind="stable"))
    return ManyBestDyads(search, lines, rows, unfinished)


def _minima(
    search: CriticalDyads,
    lines: tuple[PR, RP],
    seen: Displacement,
    poses: Displacement,
    weights: FloatArray | None,
    *,
    hard: bool,
) -> tuple[Minima, NDArray[np.intp]]:
    """The minima of tasks (T,), and how many ways of each were given up; hard tasks come alone."""
    frames, share, more = search.frames, shares(weights, seen.shape), None
    given = poses[0], None if weights is None else weights[0]  # where there is one task only
    if hard:
        origin = np.concatenate([frames.fixed_origin, frames.moving_origin], axis=-1)
        more = (pivots_of_fits(*given)[None] - origin[:, None]) / frames.length[:, None, None]
    some, part = seen, share
    if seen.shape[1] > MAX_POSES_FOLLOWED:
        sample = PoseSample.of(*given, MAX_POSES_FOLLOWED)
        some = seen[:, sample.index]
        part = shares(sample.cells[None], some.shape)
    task, starts = starts_down(search.points, lines, some, part, more)
    found = circle_minima(starts, task, some, part, narrow=hard)
    unfinished = found.unfinished
    if some is not seen:
        found = circle_minima(found.z, found.task, seen, share, narrow=hard)
    task, frames = found.task, take(frames, found.task)
    circles = RR(found.z[:, :2], found.z[:, 2:4], found.z[:, 4])
    dyads, unit = frames.circle_from_canonical(circles[:, None])[:, 0], frames.length
    if hard:
        dyads, distance, at_rest = sharpened_circles(dyads, poses[0], share[0])
        order = np.argsort(distance**2 @ share[0], kind="stable")
        unfinished = unfinished + int((~at_rest[order][:2]).sum())
        circles, dyads, distance = circles[order], dyads[order], distance[order] / unit[:, None]
    else:
        distance = circles[:, None].residual(seen[task])
    rms, worst = np.sqrt((distance**2).mean(axis=-1)), np.abs(distance).max(axis=-1)
    return Minima(task, circles, dyads, rms * unit, worst * unit), unfinished


def is_hard(known: NDArray[np.int_], seen: Displacement, share: FloatArray) -> NDArray[np.bool_]:
    """Whether bodies turn so little that ways down are narrow, or critical points are lost, (*,).

    known: (*,), how many of the critical points are known.
    """
    return np.asarray((known < COUNT) | (reach(seen, share) > LITTLE_TURN))


def starts_of_one(
    points: ComplexArray, lines: tuple[PR, RP], seen: Displacement, share: FloatArray
) -> FloatArray:
    """The circles of `starts_down`, for one task."""
    on_ground, in_body = lines
    own = on_ground[None], in_body[None]
    return starts_down(points[None], own, seen[None], share[None])[1]


def with_errors(
    search: CriticalDyads | LimitedDyads,
    circles: RR,
    sliders: tuple[PR | RP, ...],
    distance: FloatArray,
    unfinished: int = 0,
) -> BestDyads:
    """The dyads with the rms and the greatest of their distances (k, N)."""
    unit, dyads = search.frames.length, search.frames.circle_from_canonical(circles)
    rms = np.sqrt((distance**2).mean(axis=-1))
    worst = np.abs(distance).max(axis=-1, initial=0)
    return BestDyads(search, circles, dyads, sliders, rms * unit, worst * unit, unfinished)


def starts_down(
    points: ComplexArray,
    lines: tuple[PR, RP],
    seen: Displacement,
    share: FloatArray,
    more: FloatArray | None = None,
) -> tuple[Indices, FloatArray]:
    """Circles (k, 5) from which ways lead down to the minima, and the tasks (k,) of them.

    points: (T, c, 4), the critical points of the squared residual; lines: (T,), the best sliders
    of each kind; seen, share: (T, N), poses in canonical frames and their shares; more: (T, p, 4),
    other pivots.
    """
    tasks = np.arange(len(points))
    side = points.imag @ CONJUGATE_PICK
    task, number = np.nonzero(side >= 0)  # one of each two conjugate points
    # With zeros, where the frames' origins stay close.
    parts = [points[task, number].real, np.zeros((len(tasks), 4))]
    owners = [task, tasks]
    if more is not None:
        parts.append(more.reshape(-1, 4))
        owners.append(np.repeat(tasks, more.shape[1]))
    task = np.concatenate(owners)
    circles, cost = _circles_about(np.concatenate(parts), task, seen, share)
    least = np.full(len(tasks), np.inf)
    np.minimum.at(least, task, cost)
    # Far from any circle the distance has minima of its own, and complex points lead to them.
    rough, number = np.nonzero((least > ROUGH_DISTANCE**2)[:, None] & (side > 0))
    beside = points[rough, number]
    pivots = np.concatenate([beside.real + beside.imag, beside.real - beside.imag])
    rough = np.tile(rough, 2)
    every, owners = [circles, _circles_about(pivots, rough, seen, share)[0]], [task, rough]
    on_ground, in_body = lines
    back = PR(in_body.normal_angle, in_body.offset, in_body.fixed_pivot)
    for line, motion, order in (
        (on_ground, seen, [0, 1, 2, 3]),
        (back, seen.inverse(), [2, 3, 0, 1]),
    ):
        for along in _pivots_along(line, motion):
            every.append(_circles_about(along[:, order], tasks, seen, share)[0])
            owners.append(tasks)
    return np.concatenate(owners), np.concatenate(every)


def _circles_about(
    pivots: FloatArray, task: Indices, seen: Displacement, share: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Circles (k, 5) with pivots (k, 4) and the best radius, and their mean squares (k,)."""
    centred = RR(pivots[:, :2], pivots[:, 2:], np.zeros(len(pivots)))
    distance = centred[:, None].residual(seen[task])
    radius = (distance * share[task]).sum(axis=1)
    cost = (share[task] * (distance - radius[:, None]) ** 2).sum(axis=1)
    return np.concatenate([pivots, radius[:, None]], axis=1), cost


def _pivots_along(line: PR, motion: Displacement) -> tuple[FloatArray, FloatArray]:
    """Pivots (T, 4) of long links that nearly follow lines (T,), one on either side of each."""
    n = np.stack([np.cos(line.normal_angle), np.sin(line.normal_angle)], axis=-1)
    foot = motion.act(line.moving_pivot[:, None]).mean(axis=1)
    foot = foot - ((foot * n).sum(axis=1) - line.offset)[:, None] * n
    first, second = (
        np.concatenate([foot + side * START_LENGTH * n, line.moving_pivot], axis=1)
        for side in (-1, 1)
    )
    return first, second


def pivots_of_fits(poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """Pivots (k, 4), c and m, of the pencil's dyads and of those through five of the poses (N,).

    The first five poses are those that span the most, the next five span the most of the rest.
    """
    found = []
    if poses.shape[0] >= MIN_POSES:
        found.append(fit_pencil(poses, weights).dyads)
    _, seen = CanonicalFrames.of(poses, weights)
    design = constraint_manifold.monomials(seen.as_image_point()) * constraint_manifold.INVARIANT
    rest = np.arange(poses.shape[0])
    for _ in range(min(QUINTUPLES, len(rest) // 5)):
        five = spanning(design[rest], 5)
        found.append(dyads_of_five(poses[rest[five]]).dyads)
        rest = np.delete(rest, five)
    pivots = np.concatenate([np.hstack([each.fixed_pivot, each.moving_pivot]) for each in found])
    return np.asarray(pivots[np.isfinite(pivots).all(axis=-1)])
