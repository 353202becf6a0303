"""The locally best dyads of a task: every minimum of the residual, by true distance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_descent import circle_minima, reach, sharpened_circles
from burmester.dyads.critical_points import COUNT, CriticalDyads, critical_dyads
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.dyads.start_pivots import pivots_of_fits
from burmester.dyads.starts_down import starts_down
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.weights import shares
from burmester.tasks.limits import Limits
from burmester.tasks.options import Norm
from burmester.tasks.pose_sample import PoseSample

if TYPE_CHECKING:  # a search of its own, which most tasks do without
    from burmester.dyads.minima_within_limits import LimitedDyads

__all__ = ["BestDyads", "best_dyads", "is_hard", "starts_of_one", "with_errors"]

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
    critical = critical_dyads(poses, weights)
    _, seen = CanonicalFrames.of(poses, weights)  # with less rounding than by these frames
    share = shares(weights, poses.shape)
    lines = fixed_lines(seen, weights)[0][0], moving_lines(seen, weights)[0][0]
    points, more = critical.points[: int(critical.found)], None
    hard = is_hard(points, seen, share, int(critical.at_infinity))
    if hard:
        origin = np.concatenate([critical.frames.fixed_origin, critical.frames.moving_origin])
        more = (pivots_of_fits(poses, weights) - origin) / critical.frames.length
    some, weight = seen, weights
    if many := seen.shape[0] > MAX_POSES_FOLLOWED:
        sample = PoseSample.of(poses, weights, MAX_POSES_FOLLOWED)
        some, weight = seen[sample.index], sample.cells
    part = shares(weight, some.shape)
    starts = starts_of_one(points, lines, some, part, more)
    found = circle_minima(starts, some, part, narrow=hard)
    if many:
        found = circle_minima(found.z, seen, share, narrow=hard)._replace(
            unfinished=found.unfinished
        )
    circles = RR(found.z[:, :2], found.z[:, 2:4], found.z[:, 4])
    # Ways down that were given up where they were better already than the second dyad.
    second = np.append(found.cost, [np.inf, np.inf])[1]
    unfinished = int((found.unfinished < second).sum())
    if not hard:
        return with_errors(critical, circles, lines, circles[:, None].residual(seen), unfinished)
    given = critical.frames.circle_from_canonical(circles)
    dyads, distance, at_rest = sharpened_circles(given, poses, share)
    order = np.argsort(distance**2 @ share, kind="stable")
    unfinished += int((~at_rest[order][:2]).sum())
    distance = distance[order] / critical.frames.length
    best = with_errors(critical, circles[order], lines, distance, unfinished)
    return replace(best, dyads=dyads[order])


def is_hard(
    points: ComplexArray, seen: Displacement, share: FloatArray, at_infinity: int = 0
) -> bool:
    """Whether the body turns so little that ways down are narrow, or critical points are lost.

    at_infinity: how many of the critical points are known to be there.
    """
    return len(points) + at_infinity < COUNT or float(reach(seen, share)) > LITTLE_TURN


def starts_of_one(
    points: ComplexArray,
    lines: tuple[PR, RP],
    seen: Displacement,
    share: FloatArray,
    more: FloatArray | None = None,
) -> FloatArray:
    """The circles of `starts_down`, for one task."""
    on_ground, in_body = lines
    pivots = None if more is None else more[None]
    own = on_ground[None], in_body[None]
    return starts_down(points[None], own, seen[None], share[None], pivots)[1]


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
