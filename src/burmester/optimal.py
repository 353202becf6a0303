"""The locally best RR dyads of a task: every minimum of the residual, by true distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.critical import CriticalDyads, critical_dyads
from burmester.displacement import Displacement, FloatArray
from burmester.dyad import RR, refitted_circles
from burmester.frames import CanonicalFrames
from burmester.pencil import Pencil, fit_pencil

__all__ = ["BestDyads", "best_dyads"]

GAUSS_STEPS = 30


@final
@dataclass(frozen=True, slots=True, eq=False)
class BestDyads:
    """The locally best RR dyads of a task, by distance from their circles.

    critical: what they come from, with the count that says whether all were found.
    pencil: fitted to the same poses; its singular values say what the motion is.
    coefficients: (k, 8), the manifolds in `frames`.
    dyads: (k,), in the task's own frames; rms_error, max_error: (k,), the distance of the
        moving pivot from its circle over the poses, in the task's unit.
    """

    critical: CriticalDyads
    pencil: Pencil
    coefficients: FloatArray
    dyads: RR
    rms_error: FloatArray
    max_error: FloatArray

    @property
    def frames(self) -> CanonicalFrames:
        """Where they were found."""
        return self.critical.frames

    @property
    def singular_values(self) -> FloatArray:
        """Those of the pencil (8,)."""
        return self.pencil.singular_values

    @property
    def noise(self) -> FloatArray:
        """That of the pencil ()."""
        return self.pencil.noise

    @property
    def gap(self) -> FloatArray:
        """That of the pencil ()."""
        return self.pencil.gap


def best_dyads(poses: Displacement, weights: FloatArray | None = None) -> BestDyads:
    """The locally best RR dyads of poses (N,), N >= 6, by distance from their circles.

    Every minimum of the squared circle residual, followed to a minimum of the distance
    |R m + d - c| - r by Gauss and Newton.  That the distance has no minimum elsewhere is not
    proved; its minima go over into those of the residual as the errors become small.
    Raises InputError as `critical_dyads` and `fit_pencil` do.
    """
    critical = critical_dyads(poses, weights)
    frames = critical.frames
    seen = frames.see(poses)
    pivots = _least_distance(critical.points[critical.minimum].real, seen, weights)
    radius = np.ones(len(pivots))
    p = RR(pivots[:, :2], pivots[:, 2:], radius).coefficients()
    circles, rms_error, max_error = refitted_circles(p, seen, weights)
    return BestDyads(
        critical,
        fit_pencil(poses, weights),
        circles.coefficients(),
        frames.circle_back(circles),
        rms_error * frames.length,
        max_error * frames.length,
    )


def _least_distance(
    pivots: FloatArray, poses: Displacement, weights: FloatArray | None
) -> FloatArray:
    """Pivots (k, 4) moved to where the distances from the mean circle are least, locally.

    Gauss-Newton with the step shortened until it helps; the radius is the mean distance.
    """
    root = np.sqrt(np.ones(poses.shape) if weights is None else weights)
    share = root**2 / (root**2).sum()
    cos, sin = np.cos(poses.angle), np.sin(poses.angle)

    def distances(x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Weighted residuals (k, N) and their derivatives (k, N, 4)."""
        c, m = RR(x[:, :2], x[:, 2:], np.zeros(len(x)))[:, None], x[:, None, 2:]
        miss, slope = c.residual(poses), np.empty((*x.shape[:1], *poses.shape, 4))
        arm = poses.act(m) - x[:, None, :2]
        u = np.divide(arm, miss[..., None], out=np.zeros_like(arm), where=miss[..., None] > 0)
        slope[..., :2] = -u
        slope[..., 2] = cos * u[..., 0] + sin * u[..., 1]
        slope[..., 3] = cos * u[..., 1] - sin * u[..., 0]
        # The mean is the best radius: take it off, and off the derivatives.
        miss = miss - (share * miss).sum(axis=-1, keepdims=True)
        slope = slope - (share[:, None] * slope).sum(axis=-2, keepdims=True)
        return root * miss, root[:, None] * slope

    def cost(x: FloatArray) -> FloatArray:
        return np.asarray((distances(x)[0] ** 2).sum(axis=-1))

    x = pivots
    for _ in range(GAUSS_STEPS if len(x) else 0):
        miss, slope = distances(x)
        step = -(np.linalg.pinv(slope) @ miss[..., None])[..., 0]
        before, factor = (miss**2).sum(axis=-1), np.ones(len(x))
        for _ in range(20):
            worse = cost(x + factor[:, None] * step) > before * (1 + 1e-12)
            if not worse.any():
                break
            factor = np.where(worse, factor / 4, factor)
        factor = np.where(worse, 0.0, factor)
        x = x + factor[:, None] * step
        if (np.abs(factor[:, None] * step).max(axis=-1) < 1e-13 * (1 + np.abs(x).max(-1))).all():
            break
    return x
