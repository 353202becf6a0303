"""Where linkages start beside the pairs of dyads: links of low error, and how near pairs come.

The locally best dyads do not always make the best linkage, and within limits there may be two of
them only.  Links with low errors, their pivots on grids, give thousands of further pairs, of which
`first_order_miss` tells in one step which come near to the poses.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.pivot_map import fixed_pivot_map, grid
from burmester.dyads.rail_sliders import sliders_along_rail
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import newton_steps, places_of, rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point, Polygon, Region
from burmester.numerics.arrays import FloatArray, shares, weights_of_mean_one
from burmester.tasks.limits import Limits, limits_in

PROJECTION_STEPS = 12  # number of Newton's steps from the poses onto a linkage
ON_LINKAGE = 1e-9  # residual, in lengths, of a place on the linkage
MAP_POINTS, MAP_REACH = 17, 3.0  # pivot maps: points in each direction, half-width in motion sizes
REGION_POINTS = 13  # number of points in each direction of a region
MAX_LINKS = 80  # number of links taken from both maps
SAME_PIVOTS = 0.15  # lengths; links whose pivots differ by less are one
# Linkages are one if their places differ by less than this share of the rms error, within the
# bounds, in lengths.
SAME_SHARE, SAME_PLACE = 0.3, (1e-5, 1e-3)
# Lengths; range of these links and of their pivots' distances, where no limit says how far is far.
MIN_LENGTH, MAX_LENGTH = 0.01, 10.0


def links_of_pivot_map(
    poses: Displacement,
    weights: FloatArray | None = None,
    limits: Limits | None = None,
    frames: CanonicalFrames | None = None,
) -> list[RR | PR | RP]:
    """Links with the least errors for each of many fixed and of many moving pivots.

    Of a dyad with a rail or a slot: sliders on lines all over it.

    poses: in the frames of `pose_error.error_frames`, as the links are.  limits: of the pivots and
    of the link's length, in the task's own frame; frames: from that frame.
    """
    limits = limits or Limits()
    if limits.line is not None:
        moved = limits if frames is None else limits_in(frames, limits)
        return [*sliders_along_rail(poses, moved, shares(weights, poses.shape))]
    if "RR" not in limits.allowed:
        return []
    unit = 1.0 if frames is None else float(frames.length)
    fixed, moving = (
        None if region is None else _SeenRegion(region, unit, np.asarray(origin))
        for region, origin in (
            (limits.fixed_pivot, np.zeros(2) if frames is None else frames.fixed_origin),
            (limits.moving_pivot, np.zeros(2)),
        )
    )
    parts = []
    for inverse in (False, True):
        seen = poses.inverse() if inverse else poses
        own, other = (moving, fixed) if inverse else (fixed, moving)
        at = _grid_of_map(seen, weights)
        if own is not None:
            at = np.concatenate([own.points(), at[own.holds(at)]])
        partner = fixed_pivot_map(seen, at, weights).dyads.moving_pivot
        if other is not None:
            free = other.holds(partner)
            at = np.concatenate([at, at[free]])
            best = _best_partner(seen, at[: len(free)], other.points(), weights)
            partner = np.concatenate([best, partner[free]])
        parts.append(np.concatenate([partner, at] if inverse else [at, partner], axis=-1))
    pivots = np.concatenate(parts)
    pivots = pivots[np.isfinite(pivots).all(axis=-1)]
    error, radius = _circle_error(poses, pivots[:, :2], pivots[:, 2:], weights)
    least, most = (bound / unit for bound in limits.length)
    radius = np.clip(radius, least, most)
    sound = np.isfinite(error) & (radius > MIN_LENGTH)
    if moving is None:  # else the limits say how far is far
        sound &= (radius < MAX_LENGTH) | (fixed is not None) | np.isfinite(most)
        sound &= np.abs(pivots[:, 2:]).max(axis=-1) < MAX_LENGTH
    order = np.flatnonzero(sound)[np.argsort(error[sound], kind="stable")]
    chosen: list[int] = []
    for k in order.tolist():
        if (np.abs(pivots[chosen] - pivots[k]).max(axis=1) < SAME_PIVOTS).any():
            continue
        chosen.append(k)
        if len(chosen) == MAX_LINKS:
            break
    return [RR(pivots[k, :2], pivots[k, 2:], radius[k]) for k in chosen]


def best_sliders(poses: Displacement, weights: FloatArray | None = None) -> list[RR | PR | RP]:
    """The best PR and the best RP dyad of poses (N,), unless their pivots are far away."""
    lines: list[PR | RP] = [of(poses, weights)[0][0] for of in (fixed_lines, moving_lines)]
    pivots = [each.moving_pivot if isinstance(each, PR) else each.fixed_pivot for each in lines]
    return [
        line for line, pivot in zip(lines, pivots, strict=True) if np.abs(pivot).max() < MAX_LENGTH
    ]


def _grid_of_map(poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """Pivots (*, 2) around the points that stay closest, or also around a near motion."""
    frames, _ = CanonicalFrames.of(poses, weights)
    around = [(frames.fixed_origin, float(frames.length))]
    if np.hypot(*frames.fixed_origin) > MAP_REACH:
        around.append((np.zeros(2), 1.0))
    parts = [
        grid(middle - MAP_REACH * size, middle + MAP_REACH * size, MAP_POINTS, MAP_POINTS)
        for middle, size in around
    ]
    return np.concatenate(parts).reshape(-1, 2)


class _SeenRegion(NamedTuple):
    """A region of the task's own frame, seen from an origin in a unit."""

    region: Region
    unit: float
    origin: FloatArray

    def points(self) -> FloatArray:
        """Points (*, 2) of it, its edges included; of a line those near its two points."""
        return (_points_of(self.region, self.unit) - self.origin) / self.unit

    def holds(self, points: FloatArray) -> NDArray[np.bool_]:
        """Which of points (k, 2) are inside a polygon; none of any other region."""
        if not isinstance(self.region, Polygon):
            return np.zeros(len(points), dtype=bool)
        inside = self.region.signed_distance(points * self.unit + self.origin) <= 0
        return np.asarray(inside, dtype=bool)


def _points_of(region: Region, unit: float) -> FloatArray:
    """Points (*, 2) of a region, its edges included; of a line those near its two points."""
    if isinstance(region, Point):
        return region.at[None]
    if isinstance(region, Polygon):
        corners = region.corners()
        at = grid(corners.min(axis=0), corners.max(axis=0), REGION_POINTS, REGION_POINTS)
        at = at.reshape(-1, 2)
        return np.concatenate([at[region.signed_distance(at) <= 0], corners])
    share = np.linspace(0, 1, REGION_POINTS)
    start, end = region.start, region.end
    if region.corners() is None:  # endless: around the foot of its frame's origin
        along = (end - start) / np.linalg.norm(end - start)
        foot = start - (start @ along) * along
        start, end = foot - MAP_REACH * unit * along, foot + MAP_REACH * unit * along
    return np.asarray(start + share[:, None] * (end - start))


def _best_partner(
    poses: Displacement, at: FloatArray, other: FloatArray, weights: FloatArray | None
) -> FloatArray:
    """Of moving pivots (j, 2) the one with the least error for each fixed pivot (k, 2)."""
    fixed, moving = np.repeat(at, len(other), axis=0), np.tile(other, (len(at), 1))
    error, _ = _circle_error(poses, fixed, moving, weights)
    return np.asarray(other[error.reshape(len(at), len(other)).argmin(axis=1)])


def _circle_error(
    poses: Displacement, fixed: FloatArray, moving: FloatArray, weights: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """The rms distances (k,) of moving pivots from their circles of the mean radius, and it."""
    share = weights_of_mean_one(weights, poses.shape) / poses.shape[0]
    arm = poses.act(moving[:, None]) - fixed[:, None]
    far = np.hypot(arm[..., 0], arm[..., 1])
    radius = far @ share
    return np.sqrt((far - radius[:, None]) ** 2 @ share), radius


def first_order_miss(
    batch: LinkageBatch, poses: Displacement, length: float, weights: FloatArray | None
) -> FloatArray:
    """The weighted sums (k,) of squared distances from poses to linkages (k,), to first order."""
    wanted = rows_of(poses, length)
    rows = np.broadcast_to(wanted, (len(batch), *wanted.shape))
    with np.errstate(all="ignore"):
        there, size = newton_steps(batch, rows, None, length)
        square = np.maximum(((there - rows) ** 2).sum(axis=-1), size * size)
        miss = square @ weights_of_mean_one(weights, poses.shape)
    return np.asarray(np.nan_to_num(miss, nan=np.inf))


def projected(
    batch: LinkageBatch, rows: FloatArray, length: float
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Places of linkages (k,) straight ahead of rows (k, N, 3), and whether all exist, (k,)."""
    with np.errstate(all="ignore"):
        rows, _ = newton_steps(batch, rows, None, length, steps=PROJECTION_STEPS)
        places = places_of(rows, length)
        on = np.abs(batch.jacobians(places).residual) < ON_LINKAGE
        return rows, np.asarray(on.all(axis=(1, 2)))


def varied(score: FloatArray, parts: NDArray[np.intp], most: int, each: int) -> NDArray[np.intp]:
    """The indices of the lowest finite scores (k,), at most so many, varied in their parts (k, 2).

    No part is in more than `each` of them, so that a few good links do not take all places.
    """
    used: dict[int, int] = {}
    chosen: list[int] = []
    order = np.argsort(score, kind="stable")
    for k in order[np.isfinite(score[order])].tolist():
        own = parts[k].tolist()
        if any(used.get(part, 0) >= each for part in own):
            continue
        for part in own:
            used[part] = used.get(part, 0) + 1
        chosen.append(k)
        if len(chosen) == most:
            break
    return np.array(chosen, dtype=np.intp)


def distinct(
    rows: FloatArray,
    cost: FloatArray,
    most: int,
    known: FloatArray | None = None,
) -> NDArray[np.intp]:
    """Of places (k, N, 3), by rising cost, the first that are not the same as others before.

    cost: (k,), sums of squared distances from the poses; linkages with nan are left out.
    known: (j, N, 3), places that are not to be among them.
    """
    kept: list[int] = []
    others = [] if known is None else list(known)
    order = np.argsort(cost, kind="stable")
    for k in order[np.isfinite(cost[order])].tolist():
        same = np.clip(SAME_SHARE * np.sqrt(cost[k] / rows.shape[1]), *SAME_PLACE)
        if not any(np.abs(rows[k] - other).max() < same for other in others):
            kept.append(k)
            others.append(rows[k])
        if len(kept) == most:
            break
    return np.array(kept, dtype=np.intp)
