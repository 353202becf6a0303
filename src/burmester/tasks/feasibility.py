"""Limits that no link can meet at the given poses, refused before anything is solved.

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

CONTRADICTION_MARGIN = 1e-6  # share of the greatest length; a smaller gap is no contradiction


def require_feasible(
    poses: Displacement, limits: tuple[Limits, ...], exact: NDArray[np.bool_] | None = None
) -> None:
    """Refuse limits that no link meets at any of the poses (N,), or not at all the exact ones.

    Also two dyads with one point for a pivot.  What it lets pass may be impossible nevertheless:
    the distances are bounded pose by pose.  Raises InputError E132, which quotes the limits.
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

    Of two lines the least distance counts as zero, as if they crossed.
    """
    fixed, moving = fixed_pivot.corners(), moving_pivot.corners()
    out = np.stack([np.zeros(poses.shape), np.full(poses.shape, np.inf)], axis=-1)
    in_f = None if moving is None else poses[:, None].act(moving)
    in_m = None if fixed is None else poses.inverse()[:, None].act(fixed)
    if in_f is not None:
        out[:, 0] = _nearest_distances(fixed_pivot, in_f)
    if in_m is not None:
        nearest = _nearest_distances(moving_pivot, in_m)
        out[:, 0] = nearest if in_f is None else np.minimum(out[:, 0], nearest)
    if in_f is not None and fixed is not None:
        out[_crossings(fixed, in_f), 0] = 0.0
        # The distance is convex: it is greatest between corners.
        out[:, 1] = np.linalg.norm(in_f[:, :, None] - fixed, axis=-1).max(axis=(1, 2))
    return out


def _nearest_distances(region: Region, corners: FloatArray) -> FloatArray:
    """The least distance (N,) of the corners (N, k, 2) of another region from this one."""
    if isinstance(region, Line):
        row = region.equations()[0]
        side = corners @ row[1:] + row[0]
        between = (side.min(axis=1) < 0) & (side.max(axis=1) > 0)
        return np.where(between, 0.0, np.abs(side).min(axis=1))
    return np.asarray(region.distance(corners).min(axis=1))


def _crossings(ring: FloatArray, rings: FloatArray) -> NDArray[np.bool_]:
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
                why="with two dyads at one pivot the body only turns about it",
                help="give that point to one dyad, and leave the other free",
            )


def _require_a_length(limits: Limits, span: FloatArray) -> None:
    """Refuse lengths outside the range of the distances (N, 2) at every pose."""
    least, most = limits.length
    too_far, too_near = span[:, 0] - most, least - span[:, 1]
    off = np.maximum(too_far, too_near)
    sizes = (span[np.isfinite(span)].max(), least, most if np.isfinite(most) else 0.0)
    if not (off > CONTRADICTION_MARGIN * max(sizes)).all():
        return
    nearest = int(off.argmin())
    if too_far[nearest] > 0:
        help = "allow a longer link, or pivots nearer to each other"
    else:
        help = "allow a shorter link, or pivots farther from each other"
    raise InputError(
        "E132",
        f"the limits contradict each other: fixed pivot {limits.fixed_pivot} and moving pivot "
        f"{limits.moving_pivot} are {_range_in_words(span[:, 0].min(), span[:, 1].max())} apart "
        f"at the poses, and the link must be {_length_in_words(least, most)}",
        why=f"nearest to that is pose {nearest + 1}, "
        f"where they are {_range_in_words(*span[nearest])} apart",
        help=help,
    )


def _require_one_length(limits: Limits, span: FloatArray, exact: NDArray[np.intp]) -> None:
    """Refuse exact poses that need links of different lengths."""
    low, high = exact[span[exact, 0].argmax()], exact[span[exact, 1].argmin()]
    (least, most), (at_least, at_most) = limits.length, (span[low, 0], span[high, 1])
    margin = CONTRADICTION_MARGIN * max(at_least, least)
    regions = f"fixed pivot {limits.fixed_pivot} and moving pivot {limits.moving_pivot}"
    help = "mark fewer poses exact, or give the pivots or the length more room"
    head = "the limits contradict each other"
    if at_least > at_most + margin:
        raise InputError(
            "E132",
            f"{head} and the exact poses: {regions} are {_range_in_words(*span[low])} apart at "
            f"pose {low + 1}, and {_range_in_words(*span[high])} at pose {high + 1}",
            why="a link has one length",
            help=help,
        )
    for pose, off in ((low, at_least > most + margin), (high, at_most < least - margin)):
        if off:
            raise InputError(
                "E132",
                f"{head} and an exact pose: {regions} are {_range_in_words(*span[pose])} apart at "
                f"pose {pose + 1}, and the link must be {_length_in_words(least, most)}",
                help=help,
            )


def _range_in_words(low: float, high: float) -> str:
    if high == np.inf:
        return f"at least {low:.7g}"
    if high - low <= CONTRADICTION_MARGIN * high:
        return f"{high:.7g}"
    return f"between {low:.7g} and {high:.7g}"


def _length_in_words(least: float, most: float) -> str:
    if most == np.inf:
        return f"at least {least:.7g} long"
    if least == 0:
        return f"at most {most:.7g} long"
    return f"{_range_in_words(least, most)} long"
