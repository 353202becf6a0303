"""The locally best dyads of a task: every minimum of the residual, by true distance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_descent import circle_minima, reach, sharpened_circles
from burmester.dyads.critical_points import COUNT, CriticalDyads, critical_dyads
from burmester.dyads.minima_within_limits import LimitedDyads, limited_dyads
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.dyads.start_pivots import pivots_of_fits
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.weights import shares, weights_or_ones
from burmester.tasks.limits import Limits
from burmester.tasks.options import Norm
from burmester.tasks.pose_sample import PoseSample

__all__ = ["BestDyads", "best_dyads", "is_hard", "starts_down"]

# Generic factors by which one of each pair of conjugate points is picked.
CONJUGATE_PICK = np.sqrt([2.0, 3.0, 5.0, 7.0])
START_LENGTH = 20.0  # characteristic lengths; the links that start along a line
ROUGH_DISTANCE = 0.1  # characteristic lengths, rms; from it on for the best start, more are made
# Of more poses a sample of about so many is followed to minima, and all from these on.
MAX_POSES_FOLLOWED = 500
LITTLE_TURN = 400.0  # inverse mean squared turn; from it on more starts are made


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
        search = limited_dyads(poses, weights, exact, limits, norm)
        distance = search.circles[:, None].residual(search.frames.to_canonical(poses))
        return _with_errors(search, search.circles, search.sliders, distance)
    critical = critical_dyads(poses, weights)
    _, seen = CanonicalFrames.of(poses, weights)  # with less rounding than by these frames
    share = shares(weights, poses.shape)
    lines = [lines(seen, weights)[0][0] for lines in (fixed_lines, moving_lines)]
    points, more = critical.points[: int(critical.found)], np.zeros((0, 4))
    hard = is_hard(points, seen, share, int(critical.at_infinity))
    if hard:
        origin = np.concatenate([critical.frames.fixed_origin, critical.frames.moving_origin])
        more = (pivots_of_fits(poses, weights) - origin) / critical.frames.length
    some, weight = seen, weights
    if many := seen.shape[0] > MAX_POSES_FOLLOWED:
        sample = PoseSample.of(poses, weights, MAX_POSES_FOLLOWED)
        some, weight = seen[sample.index], sample.cells
    starts = starts_down(points, lines, some, weight, more)
    found = circle_minima(starts, some, shares(weight, some.shape), narrow=hard)
    if many:
        found = circle_minima(found.z, seen, share, narrow=hard)._replace(
            unfinished=found.unfinished
        )
    circles = RR(found.z[:, :2], found.z[:, 2:4], found.z[:, 4])
    # Ways down that were given up where they were better already than the second dyad.
    second = np.append(found.cost, [np.inf, np.inf])[1]
    unfinished = int((found.unfinished < second).sum())
    if not hard:
        return _with_errors(
            critical, circles, tuple(lines), circles[:, None].residual(seen), unfinished
        )
    given = critical.frames.circle_from_canonical(circles)
    dyads, distance, at_rest = sharpened_circles(given, poses, share)
    order = np.argsort(distance**2 @ share, kind="stable")
    unfinished += int((~at_rest[order][:2]).sum())
    distance = distance[order] / critical.frames.length
    best = _with_errors(critical, circles[order], tuple(lines), distance, unfinished)
    return replace(best, dyads=dyads[order])


def is_hard(
    points: ComplexArray, seen: Displacement, share: FloatArray, at_infinity: int = 0
) -> bool:
    """Whether the body turns so little that ways down are narrow, or critical points are lost.

    at_infinity: how many of the critical points are known to be there.
    """
    return len(points) + at_infinity < COUNT or float(reach(seen, share)) > LITTLE_TURN


def starts_down(
    points: ComplexArray,
    lines: Sequence[PR | RP],
    seen: Displacement,
    weights: FloatArray | None,
    more: FloatArray,
) -> FloatArray:
    """Circles (k, 5) from which ways lead down to the minima, for poses in canonical frames.

    points: (c, 4), complex, the critical points of the squared residual; lines: the best sliders;
    more: (p, 4), other pivots.
    """
    pivots = points[points.imag @ CONJUGATE_PICK >= 0].real
    # With zeros, where the frames' origins stay close.
    pivots = np.concatenate([pivots, np.zeros((1, 4)), more])
    if _is_rough(pivots, seen, weights, shares(weights, seen.shape)):
        pivots = np.concatenate([pivots, _beside(points)])
    starts = [_circles_about(pivots, seen, weights)]
    return np.concatenate(starts + [_circles_along(line, seen, weights) for line in lines])


def _with_errors(
    search: CriticalDyads | LimitedDyads,
    circles: RR,
    sliders: tuple[PR | RP, ...],
    distance: FloatArray,
    unfinished: int = 0,
) -> BestDyads:
    """The dyads with the rms and the greatest of their distances (k, N)."""
    unit, dyads = search.frames.length, search.frames.circle_from_canonical(circles)
    rms, worst = np.sqrt((distance**2).mean(axis=-1)), np.abs(distance).max(axis=-1)
    return BestDyads(search, circles, dyads, sliders, rms * unit, worst * unit, unfinished)


def _is_rough(
    pivots: FloatArray, seen: Displacement, weights: FloatArray | None, share: FloatArray
) -> bool:
    """Whether no circle about pivots (k, 4) comes near to the poses, so that there is no valley.

    The true distance has minima of its own then.
    """
    circles = _circles_about(pivots, seen, weights)
    distance = RR(circles[:, :2], circles[:, 2:4], circles[:, 4])[:, None].residual(seen)
    return bool((distance**2 @ share).min() > ROUGH_DISTANCE**2)


def _beside(points: ComplexArray) -> FloatArray:
    """Real pivots (k, 4) beside the complex ones of critical points: real and imaginary parts."""
    complex_ones = points[points.imag @ CONJUGATE_PICK > 0]
    return np.concatenate(
        [complex_ones.real + complex_ones.imag, complex_ones.real - complex_ones.imag]
    )


def _circles_about(
    pivots: FloatArray, poses: Displacement, weights: FloatArray | None
) -> FloatArray:
    """Circles (k, 5), c, m, r, with pivots (k, 4) and the best radius."""
    share = weights_or_ones(weights, poses.shape)
    centred = RR(pivots[:, :2], pivots[:, 2:], np.zeros(len(pivots)))
    radius = centred[:, None].residual(poses) @ share / share.sum()
    return np.concatenate([pivots, radius[:, None]], axis=-1)


def _circles_along(line: PR | RP, poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """Circles (2, 5) with long links that nearly follow a line, one on either side of it."""
    n = np.stack([np.cos(line.normal_angle), np.sin(line.normal_angle)])
    if isinstance(line, RP):
        inverse = PR(line.normal_angle, line.offset, line.fixed_pivot)
        return _circles_along(inverse, poses.inverse(), weights)[:, [2, 3, 0, 1, 4]]
    foot = poses.act(line.moving_pivot).mean(axis=0)
    foot = foot - (foot @ n - line.offset) * n
    centres = foot + np.outer([-START_LENGTH, START_LENGTH], n)
    pivots = np.concatenate([centres, np.tile(line.moving_pivot, (2, 1))], axis=-1)
    return _circles_about(pivots, poses, weights)
