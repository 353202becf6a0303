"""Whether limits can be met at the given poses at all, asked before anything is solved.

The link of an RR dyad spans the distance between its fixed pivot and its moving pivot at every
pose.  Where both may lie in known regions, that distance is bounded at each pose, and the bounds
may leave no length that the limits allow.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Region
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Limits

__all__ = ["require_feasible", "spans"]

MARGIN = 1e-6  # share of the lengths at hand within which nothing is called a contradiction


def require_feasible(
    poses: Displacement, limits: tuple[Limits, ...], exact: NDArray[np.bool_] | None = None
) -> None:
    """Refuse limits that no link meets at any of the poses (N,), or not at all the exact ones.

    Also two dyads with one point for a pivot.  Getting past here proves nothing: the distances
    are bounded pose by pose.  Raises InputError E132, which quotes the limits.
    """
    if len(limits) == 2:
        _require_two_pivots(*limits)
    for each in limits:
        if each.fixed_pivot is not None and each.moving_pivot is not None:
            span = spans(poses, each.fixed_pivot, each.moving_pivot)
            _require_a_length(each, span)
            if exact is not None and exact.any():
                _require_one_length(each, span, np.flatnonzero(exact))


def spans(poses: Displacement, fixed_pivot: Region, moving_pivot: Region) -> FloatArray:
    """The least and greatest distance (N, 2) between a region of F and one of M at poses (N,).

    Two lines, one of each, are taken to cross.
    """
    fixed, moving = fixed_pivot.corners(), moving_pivot.corners()
    out = np.stack([np.zeros(poses.shape), np.full(poses.shape, np.inf)], axis=-1)
    in_f = None if moving is None else poses[:, None].act(moving)
    in_m = None if fixed is None else poses.inverse()[:, None].act(fixed)
    if in_f is not None:
        out[:, 0] = _nearest(fixed_pivot, in_f)
    if in_m is not None:
        nearest = _nearest(moving_pivot, in_m)
        out[:, 0] = nearest if in_f is None else np.minimum(out[:, 0], nearest)
    if in_f is not None and fixed is not None:
        out[_cross(fixed, in_f), 0] = 0.0
        # The distance is convex: it is greatest between corners.
        out[:, 1] = np.linalg.norm(in_f[:, :, None] - fixed, axis=-1).max(axis=(1, 2))
    return out


def _nearest(region: Region, corners: FloatArray) -> FloatArray:
    """The least distance (N,) of the corners (N, k, 2) of another region from this one."""
    if isinstance(region, Line):
        row = region.equations()[0]
        side = corners @ row[1:] + row[0]
        between = (side.min(axis=1) < 0) & (side.max(axis=1) > 0)
        return np.where(between, 0.0, np.abs(side).min(axis=1))
    return np.asarray(region.distance(corners).min(axis=1))


def _cross(ring: FloatArray, rings: FloatArray) -> NDArray[np.bool_]:
    """Whether an edge of a ring of corners (k, 2) crosses one of each of the rings (N, l, 2)."""
    a, c = ring[None, :, None], rings[:, None]
    b, d = np.roll(a, -1, axis=1), np.roll(c, -1, axis=2)

    def side(start: FloatArray, end: FloatArray, at: FloatArray) -> FloatArray:
        along, to = end - start, at - start
        return np.asarray(along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0])

    crossing = (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)
    return np.asarray(crossing.any(axis=(1, 2)))


def _require_two_pivots(first: Limits, second: Limits) -> None:
    pairs = {
        "fixed": (first.fixed_pivot, second.fixed_pivot),
        "moving": (first.moving_pivot, second.moving_pivot),
    }
    for name, (a, b) in pairs.items():
        if isinstance(a, Point) and isinstance(b, Point) and (a.at == b.at).all():
            raise InputError(
                "E132",
                f"the limits contradict each other: both dyads have the {name} pivot {a}",
                why="two dyads that share a pivot let the body do no more than turn about it",
                help="give that point to one dyad, and leave the other free",
            )


def _require_a_length(limits: Limits, span: FloatArray) -> None:
    """Refuse a length that the distances (N, 2) never come to."""
    least, most = limits.length
    too_far, too_near = span[:, 0] - most, least - span[:, 1]
    off = np.maximum(too_far, too_near)
    sizes = (span[np.isfinite(span)].max(), least, most if np.isfinite(most) else 0.0)
    if not (off > MARGIN * max(sizes)).all():
        return
    nearest = int(off.argmin())
    if too_far[nearest] > 0:
        help = "allow a longer link, or pivots nearer to each other"
    else:
        help = "allow a shorter link, or pivots farther from each other"
    raise InputError(
        "E132",
        f"the limits contradict each other: fixed pivot {limits.fixed_pivot} and moving pivot "
        f"{limits.moving_pivot} are {_range(span[:, 0].min(), span[:, 1].max())} apart at the "
        f"poses, and the link is to be {_long(least, most)}",
        why=f"nearest to that is pose {nearest + 1}, where they are {_range(*span[nearest])} apart",
        help=help,
    )


def _require_one_length(limits: Limits, span: FloatArray, exact: NDArray[np.intp]) -> None:
    """Refuse exact poses at which the link would have to be of different lengths."""
    low, high = exact[span[exact, 0].argmax()], exact[span[exact, 1].argmin()]
    (least, most), (at_least, at_most) = limits.length, (span[low, 0], span[high, 1])
    margin = MARGIN * max(at_least, least)
    regions = f"fixed pivot {limits.fixed_pivot} and moving pivot {limits.moving_pivot}"
    help = "mark fewer poses exact, or give the pivots or the length more room"
    head = "the limits contradict each other"
    if at_least > at_most + margin:
        raise InputError(
            "E132",
            f"{head} and the exact poses: {regions} are {_range(*span[low])} apart at pose "
            f"{low + 1}, and {_range(*span[high])} at pose {high + 1}",
            why="a link has one length",
            help=help,
        )
    for pose, off in ((low, at_least > most + margin), (high, at_most < least - margin)):
        if off:
            raise InputError(
                "E132",
                f"{head} and an exact pose: {regions} are {_range(*span[pose])} apart at pose "
                f"{pose + 1}, and the link is to be {_long(least, most)}",
                help=help,
            )


def _range(low: float, high: float) -> str:
    if high == np.inf:
        return f"at least {low:.7g}"
    return f"{high:.7g}" if high - low <= MARGIN * high else f"between {low:.7g} and {high:.7g}"


def _long(least: float, most: float) -> str:
    if most == np.inf:
        return f"at least {least:.7g} long"
    if least == 0:
        return f"at most {most:.7g} long"
    return f"{_range(least, most)} long"
