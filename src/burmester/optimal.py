"""The locally best dyads of a task: every minimum of the residual, by true distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.critical import CriticalDyads, critical_dyads
from burmester.displacement import Displacement, FloatArray
from burmester.dyad import PR, RP, RR
from burmester.frames import CanonicalFrames
from burmester.limited import LimitedDyads, Norm, limited_dyads
from burmester.limits import Limits
from burmester.polish import circle_misses
from burmester.prismatic import fixed_lines, moving_lines

__all__ = ["BestDyads", "best_dyads"]

STEPS, SHORTER = 40, 20
FLAT = 1e-14  # relative curvature below which a direction is as good as flat


@final
@dataclass(frozen=True, slots=True, eq=False)
class BestDyads:
    """The locally best dyads of a task, by distance from their circles and lines.

    search: what they come from, with the count that says whether all were found.
    frames: where they were found.
    circles: (k,) in those frames, dyads: the same in the task's own.
    sliders: PR and RP dyads in `frames`.
    rms_error, max_error: (k,), the distance of the moving pivot from its circle over the poses, in
        the task's unit.
    """

    search: CriticalDyads | LimitedDyads
    frames: CanonicalFrames
    circles: RR
    sliders: tuple[PR | RP, ...]
    rms_error: FloatArray
    max_error: FloatArray

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

    Without limits, exact poses and `norm`, N >= 5: every minimum of the squared circle residual,
    followed to a minimum of the distance |R m + d - c| - r by Newton's method, and the best
    slider of each kind; else as `limited_dyads` says.  That the distance has no minimum elsewhere
    is not proved; its minima go over into those of the residual as the errors become small.
    Raises InputError as `critical_dyads` does.
    """
    if limits is not None or norm != "rms" or (exact is not None and exact.any()):
        search = limited_dyads(poses, weights, exact, limits, norm)
        miss = search.circles[:, None].residual(search.frames.see(poses))
        return _told(search, search.circles, search.sliders, miss)
    critical = critical_dyads(poses, weights)
    seen = critical.frames.see(poses)
    z = _least_distance(critical.points[critical.minimum].real, seen, weights)
    circles = RR(z[:, :2], z[:, 2:4], z[:, 4])
    sliders = tuple(lines(seen, weights)[0][0] for lines in (fixed_lines, moving_lines))
    return _told(critical, circles, sliders, circles[:, None].residual(seen))


def _told(
    search: CriticalDyads | LimitedDyads,
    circles: RR,
    sliders: tuple[PR | RP, ...],
    miss: FloatArray,
) -> BestDyads:
    unit, frames = search.frames.length, search.frames
    rms, worst = np.sqrt((miss**2).mean(axis=-1)), np.abs(miss).max(axis=-1)
    return BestDyads(search, frames, circles, sliders, rms * unit, worst * unit)


def _least_distance(
    pivots: FloatArray, poses: Displacement, weights: FloatArray | None
) -> FloatArray:
    """Circles (k, 5), c, m, r, with pivots (k, 4) moved to a local minimum of the sum of squares.

    Newton's method; where the sum is not convex, Gauss and Newton's step; shortened until it helps.
    """
    share = np.ones(poses.shape) if weights is None else weights
    share = share / share.sum()
    misses = circle_misses(poses)
    z = np.concatenate([pivots, np.zeros((len(pivots), 1))], axis=-1)
    z[:, 4] = misses(z).miss @ share
    here = misses(z)
    for _ in range(STEPS if len(z) else 0):
        pull = share * here.miss
        gradient = np.einsum("kn,kni->ki", pull, here.slope)
        flat = np.einsum("n,kni,knj->kij", share, here.slope, here.slope)
        curved = flat + np.einsum("kn,knij->kij", pull, here.bend)
        convex = np.linalg.eigvalsh(curved)[:, 0] > 0
        values, axes = np.linalg.eigh(np.where(convex[:, None, None], curved, flat))
        values = np.maximum(values, FLAT * values[:, -1:])
        along = np.einsum("kij,ki->kj", axes, gradient) / values
        step = -np.einsum("kij,kj->ki", axes, along)
        before, factor = here.miss**2 @ share, np.ones(len(z))
        for _ in range(SHORTER):
            there = misses(z + factor[:, None] * step)
            worse = there.miss**2 @ share > before * (1 + 1e-13)
            if not worse.any():
                break
            factor = np.where(worse, factor / 4, factor)
        factor = np.where(worse, 0.0, factor)
        z = z + factor[:, None] * step
        if (np.abs(factor[:, None] * step).max(axis=-1) < 1e-13 * (1 + np.abs(z).max(-1))).all():
            break
        here = misses(z)
    return z
