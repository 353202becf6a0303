"""The locally best dyads of a task: every minimum of the residual, by true distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.critical_points import CriticalDyads, critical_dyads
from burmester.dyads.geometric_fit import SURE, circle_terms
from burmester.dyads.minima_within_limits import LimitedDyads, limited_dyads
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Limits
from burmester.tasks.options import Norm

__all__ = ["BestDyads", "best_dyads"]

STEPS, SHORTER = 60, 20
SETTLED, SAME = 1e-9, 1e-6  # relative: a step that is rounding; two circles that are one
ONE_OF_TWO = np.sqrt([2.0, 3.0, 5.0, 7.0])  # tells a complex point from its conjugate
LONG_LINK, ENDLESS = 20.0, 1e3  # characteristic lengths: of a start along a line; of no circle
FLAT = 1e-14  # relative curvature below which a direction is as good as flat


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
        return self.frames.circle_back(self.circles)

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
    """The locally best dyads of poses (N,), by distance from their circles and lines.

    Without limits, exact poses and `norm`, N >= 5: the minima of the distance |R m + d - c| - r to
    which Newton's method leads from every critical point of the squared residual (from the real
    part of a complex one) and from long links along the best lines; and the best slider of each
    kind; else as `limited_dyads` says.  That the distance has no minimum elsewhere is not proved;
    its minima go over into those of the residual as the errors become small.
    Raises InputError as `critical_dyads` does.
    """
    if limits is not None or norm != "rms" or (exact is not None and exact.any()):
        search = limited_dyads(poses, weights, exact, limits, norm)
        miss = search.circles[:, None].residual(search.frames.see(poses))
        return _told(search, search.circles, search.sliders, miss)
    critical = critical_dyads(poses, weights)
    seen = critical.frames.see(poses)
    share = np.ones(poses.shape) if weights is None else weights
    lines = [lines(seen, weights)[0][0] for lines in (fixed_lines, moving_lines)]
    points = critical.points[: int(critical.found)]
    pivots = points[points.imag @ ONE_OF_TWO >= 0].real
    pivots = np.concatenate([pivots, np.zeros((1, 4))])  # where the frames' origins stay close
    starts = [_circles_about(pivots, seen, share), *(_nearly(line, seen, share) for line in lines)]
    z = _least_distance(np.concatenate(starts), seen, share / share.sum())
    circles = RR(z[:, :2], z[:, 2:4], z[:, 4])
    return _told(critical, circles, tuple(lines), circles[:, None].residual(seen))


def _told(
    search: CriticalDyads | LimitedDyads,
    circles: RR,
    sliders: tuple[PR | RP, ...],
    miss: FloatArray,
) -> BestDyads:
    unit = search.frames.length
    rms, worst = np.sqrt((miss**2).mean(axis=-1)), np.abs(miss).max(axis=-1)
    return BestDyads(search, circles, sliders, rms * unit, worst * unit)


def _circles_about(pivots: FloatArray, poses: Displacement, share: FloatArray) -> FloatArray:
    """Circles (k, 5), c, m, r, with pivots (k, 4) and the best radius."""
    centred = RR(pivots[:, :2], pivots[:, 2:], np.zeros(len(pivots)))
    radius = centred[:, None].residual(poses) @ share / share.sum()
    return np.concatenate([pivots, radius[:, None]], axis=-1)


def _nearly(line: PR | RP, poses: Displacement, share: FloatArray) -> FloatArray:
    """Circles (k, 5) with long links, on either side of a line and nearly the same."""
    n = np.stack([np.cos(line.normal_angle), np.sin(line.normal_angle)])
    if isinstance(line, RP):
        swapped = PR(line.normal_angle, line.offset, line.fixed_pivot)
        return _nearly(swapped, poses.inverse(), share)[:, [2, 3, 0, 1, 4]]
    foot = poses.act(line.moving_pivot).mean(axis=0)
    foot = foot - (foot @ n - line.offset) * n
    centres = foot + np.outer([-LONG_LINK, LONG_LINK], n)
    pivots = np.concatenate([centres, np.tile(line.moving_pivot, (2, 1))], axis=-1)
    return _circles_about(pivots, poses, share)


def _least_distance(z: FloatArray, poses: Displacement, share: FloatArray) -> FloatArray:
    """The local minima (k, 5) of the sum of squares that circles (*, 5) lead to, each once.

    Newton's method; where the sum is not convex, Gauss and Newton's step; shortened until it
    helps.  Left out is what comes to no rest, or to rest so far out that it is a slider.
    """
    terms = circle_terms(poses)
    ends = []
    here = terms(z)
    for _ in range(STEPS):
        step, convex, gain = _newton_step(here, share)
        before, factor = here[0] ** 2 @ share, np.ones(len(z))
        sure = convex & (gain < SURE * before)  # the sum itself would tell by its rounding only
        for _ in range(SHORTER):
            to = z + factor[:, None] * step
            there = terms(to)
            worse = ~sure & (there[0] ** 2 @ share > before)
            if not worse.any():
                break
            factor = np.where(worse, factor / 4, factor)
        to = np.where(worse[:, None], z, to)
        size = 1 + np.abs(to).max(axis=-1)
        settled = convex & (np.abs(to - z).max(axis=-1) < SETTLED * size)
        ends.append(to[settled])
        run = ~(settled | (worse & ~convex) | (size > ENDLESS))
        if not run.any():
            break
        z, here = to[run], tuple(part[run] for part in (terms(to) if worse.any() else there))
    found = np.concatenate(ends)
    cost = terms(found)[0] ** 2 @ share
    found = found[np.argsort(cost, kind="stable")]
    apart = np.abs(found[:, None] - found[None]).max(axis=-1)
    same = apart < SAME * (1 + np.abs(found).max(axis=-1))
    return np.asarray(found[~np.tril(same, -1).any(axis=1)])


def _newton_step(
    terms: tuple[FloatArray, ...], share: FloatArray
) -> tuple[FloatArray, NDArray[np.bool_], FloatArray]:
    """Newton's step (k, 5), where the sum of squares is convex (k,), and what the step gains."""
    miss, slope, swing, size = terms
    pull = share * miss
    gradient = (pull[:, None] @ slope)[:, 0]
    flat = np.swapaxes(share[:, None] * slope, -1, -2) @ slope
    curved = flat + np.swapaxes((pull / size)[..., None] * swing, -1, -2) @ swing
    values, axes = np.linalg.eigh(curved)
    convex = values[:, 0] > 0
    if not convex.all():
        values[~convex], axes[~convex] = np.linalg.eigh(flat[~convex])
    values = np.maximum(values, FLAT * values[:, -1:])
    along = (gradient[:, None] @ axes)[:, 0] / values
    step = -(axes @ along[..., None])[..., 0]
    return step, convex, -(gradient * step).sum(axis=-1)
