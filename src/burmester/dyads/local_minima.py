"""The locally best dyads of a task: every minimum of the residual, by true distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_minima import circle_minima
from burmester.dyads.critical_points import CriticalDyads, critical_dyads
from burmester.dyads.minima_within_limits import LimitedDyads, limited_dyads
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import shares, weights_or_ones
from burmester.tasks.limits import Limits
from burmester.tasks.options import Norm

__all__ = ["BestDyads", "best_dyads"]

# Generic factors by which one of each pair of conjugate points is picked.
CONJUGATE_PICK = np.sqrt([2.0, 3.0, 5.0, 7.0])
START_LENGTH = 20.0  # characteristic lengths; the links that start along a line


@final
@dataclass(frozen=True, slots=True, eq=False)
class BestDyads:
    """The locally best dyads of a task, by distance from their circles and lines.

    search: what they come from, with the count that says whether all were found.
    circles: (k,) in `frames`, dyads: the same in the task's own.
    sliders: PR and RP dyads in `frames`.
    rms_error, max_error: (k,), the distance of the moving pivot from its circle over the poses, in
        the task's unit.
    """

    search: CriticalDyads | LimitedDyads
    circles: RR
    sliders: tuple[PR | RP, ...]
    rms_error: FloatArray
    max_error: FloatArray

    @property
    def frames(self) -> CanonicalFrames:
        """Where they were found."""
        return self.search.frames

    @property
    def dyads(self) -> RR:
        """The RR dyads (k,), in the task's own frames."""
        return self.frames.circle_from_canonical(self.circles)

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
    part of a complex one) and from long links along the best lines; and the best slider of each
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
    seen = critical.frames.to_canonical(poses)
    lines = [lines(seen, weights)[0][0] for lines in (fixed_lines, moving_lines)]
    points = critical.points[: int(critical.found)]
    pivots = points[points.imag @ CONJUGATE_PICK >= 0].real
    pivots = np.concatenate([pivots, np.zeros((1, 4))])  # where the frames' origins stay close
    starts = [_circles_about(pivots, seen, weights)]
    starts += [_circles_along(line, seen, weights) for line in lines]
    z = circle_minima(np.concatenate(starts), seen, shares(weights, poses.shape))
    circles = RR(z[:, :2], z[:, 2:4], z[:, 4])
    return _with_errors(critical, circles, tuple(lines), circles[:, None].residual(seen))


def _with_errors(
    search: CriticalDyads | LimitedDyads,
    circles: RR,
    sliders: tuple[PR | RP, ...],
    distance: FloatArray,
) -> BestDyads:
    """The dyads with the rms and the greatest of their distances (k, N)."""
    unit = search.frames.length
    rms, worst = np.sqrt((distance**2).mean(axis=-1)), np.abs(distance).max(axis=-1)
    return BestDyads(search, circles, sliders, rms * unit, worst * unit)


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
