"""The canonical frames of a task, and its limits seen in them.

One pose has no size, and two poses share a pole: of them nothing remains by which the canonical
frames could tell a length.  Then the regions of the pivots give origin and length.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Region
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Limits
from burmester.tasks.rails import moved_region

FEW_POSES = 2  # as many poses at most share a pole


def frames_of(
    poses: Displacement, weights: FloatArray | None, limits: Sequence[Limits]
) -> tuple[CanonicalFrames, Displacement]:
    """The canonical frames of poses (N,) within limits, and the poses seen in them.

    Of three poses and more, and where no pivot is limited, those of the poses.  Of one or two the
    origins are the middle of the regions, and the length is the rms distance from it of their
    corners, at all poses; a line counts by its point nearest to that middle.  So they go along
    with F, M and the unit of length.
    """
    own = CanonicalFrames.of(poses, weights)
    in_f = [each.fixed_pivot for each in limits if each.fixed_pivot is not None]
    in_m = [each.moving_pivot for each in limits if each.moving_pivot is not None]
    fixed, moving = _corners(in_f), _corners(in_m)
    if poses.shape[0] > FEW_POSES or not len(fixed) + len(moving):
        return own
    pulled_back = poses.inverse()[:, None].act(fixed).reshape(-1, 2)
    m = np.concatenate([moving, pulled_back]).mean(axis=0)
    c = poses.act(m).mean(axis=0)
    fixed = np.concatenate([fixed, *(_nearest(region, c) for region in in_f)])
    moving = np.concatenate([moving, *(_nearest(region, m) for region in in_m)])
    # Differences first: far origins cost no digits.
    arms = [poses[:, None].rotate(moving - m) + (poses.act(m) - c)[:, None], fixed - c]
    squares = np.concatenate([(arm.reshape(-1, 2) ** 2).sum(axis=-1) for arm in arms])
    length = np.sqrt(squares.mean())
    if not length > 0:
        return own
    frames = CanonicalFrames(c, m, np.asarray(length))
    return frames, frames.to_canonical(poses)


def _corners(regions: Sequence[Region]) -> FloatArray:
    """The corners (k, 2) of all regions that have some."""
    corners = [region.corners() for region in regions]
    return np.concatenate([np.empty((0, 2)), *(each for each in corners if each is not None)])


def _nearest(region: Region, point: FloatArray) -> FloatArray:
    """The nearest point (1, 2) of a line to another; none (0, 2) of a region with corners."""
    if region.corners() is not None:
        return np.empty((0, 2))
    row = region.equations()[0]
    return np.asarray(point - (point @ row[1:] + row[0]) * row[1:])[None]


def limits_in(frames: CanonicalFrames, limits: Limits) -> Limits:
    """Limits as canonical frames see them."""
    unit = float(frames.length)
    in_f, in_m = (frames.fixed_origin, unit), (frames.moving_origin, unit)
    return replace(
        limits,
        fixed_pivot=moved_region(limits.fixed_pivot, *in_f),
        moving_pivot=moved_region(limits.moving_pivot, *in_m),
        length=(limits.length[0] / unit, limits.length[1] / unit),
        rail=limits.rail and limits.rail.moved(*in_f),
        slot=limits.slot and limits.slot.moved(*in_m),
    )
