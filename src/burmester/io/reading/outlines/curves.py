"""Curves of a drawing: pieces as polylines, joined where their ends meet.

E170 a drawing that cannot be read
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray

FLATNESS: Final = 2e-4  # of the drawing's extent; chords leave arcs and splines by no more
JOINT: Final = 1e-4  # of the drawing's extent; ends no farther apart are joined


class Curve(NamedTuple):
    """A curve as a polyline: points (n, 2), what and where it is in the drawing.

    closed: whether the last point leads back to the first.
    names: its layer, or its id and those of the groups it is in, the nearest first.
    """

    points: FloatArray
    closed: bool
    kind: str
    names: tuple[str, ...]


class Drawing(NamedTuple):
    """The curves of a drawing with y upwards.

    unit: of its lengths, "mm" say, or None where it states none.
    part_word: "layer" or "id"; parts: all that there are.
    assumed: what was assumed in reading, in words.
    """

    curves: list[Curve]
    unit: str | None
    part_word: str
    parts: tuple[str, ...]
    assumed: tuple[str, ...]


class OpenEnds(NamedTuple):
    """The least gap between ends of open curves, and one of the two ends; nan without any."""

    gap: float
    at: FloatArray


def unreadable(why: str, help: str) -> InputError:
    """E170, for a file that is no drawing, or too much of one."""
    return InputError("E170", "the drawing cannot be read", why=why, help=help)


def extent(curves: list[Curve]) -> float:
    """The diagonal of the box about all curves."""
    if not curves:
        return 0.0
    low = np.min([each.points.min(axis=0) for each in curves], axis=0)
    high = np.max([each.points.max(axis=0) for each in curves], axis=0)
    return float(np.hypot(*(high - low)))


def joined(curves: list[Curve], reach: float) -> tuple[list[Curve], OpenEnds, int]:
    """The closed curves, also those of open ones whose ends meet within a reach.

    With the least gap that is left, and the number of open curves.  Where more than two ends meet
    nothing is joined: it would be a guess.
    """
    closed = [_once_round(each, reach) for each in curves if _is_closed(each, reach)]
    pieces = [each for each in curves if not _is_closed(each, reach)]
    if not pieces:
        return closed, OpenEnds(np.nan, np.full(2, np.nan)), 0
    ends = np.concatenate([[each.points[0], each.points[-1]] for each in pieces])
    node = _clusters(ends, reach)
    at_node: dict[int, list[int]] = {}
    for number in range(len(ends)):
        at_node.setdefault(int(node[number]), []).append(number)
    pairs = [each for each in at_node.values() if len(each) == 2]
    other = {one: two for pair in pairs for one, two in (pair, pair[::-1])}
    loops: list[Curve] = []
    in_loops, seen = set[int](), set[int]()
    for first in range(0, len(ends), 2):  # the ends of piece k are 2k and 2k + 1
        end: int | None = first
        entered = list[int]()
        while end is not None and end // 2 not in seen:
            seen.add(end // 2)
            entered.append(end)
            end = other.get(end ^ 1)
        if entered and end == first:
            loops.append(_loop(entered, pieces))
            in_loops |= {each // 2 for each in entered}
    left = [each for each in range(len(ends)) if each not in other and each // 2 not in in_loops]
    return closed + loops, _least_gap(ends[left]), len(pieces) - len(in_loops)


def _is_closed(curve: Curve, reach: float) -> bool:
    ends = float(np.hypot(*(curve.points[0] - curve.points[-1])))
    return curve.closed or (len(curve.points) > 3 and ends <= reach)


def _once_round(curve: Curve, reach: float) -> Curve:
    """A closed curve without its first point at its end."""
    points = curve.points
    while len(points) > 3 and np.hypot(*(points[0] - points[-1])) <= reach:
        points = points[:-1]
    return curve._replace(points=points, closed=True)


def _clusters(ends: FloatArray, reach: float) -> np.ndarray:
    """A number for each end (k, 2): the same for ends that lie together."""
    number = np.full(len(ends), -1)
    order = np.argsort(ends[:, 0], kind="stable")
    sorted_x = ends[order, 0]
    count = 0
    for k in range(len(ends)):
        if number[k] >= 0:
            continue
        low, high = np.searchsorted(sorted_x, [ends[k, 0] - reach, ends[k, 0] + reach * (1 + 1e-9)])
        near = order[low : high + 1]
        near = near[np.hypot(*(ends[near] - ends[k]).T) <= reach]
        number[near[number[near] < 0]] = count
        number[k] = count
        count += 1
    return number


def _loop(entered: list[int], pieces: list[Curve]) -> Curve:
    """The closed curve of pieces, by the ends at which they are entered."""
    points = [pieces[k // 2].points[:: -1 if k % 2 else 1][:-1] for k in entered]
    kind = " + ".join(pieces[k // 2].kind for k in entered)
    return Curve(np.concatenate(points), True, kind, pieces[entered[0] // 2].names)


def _least_gap(ends: FloatArray) -> OpenEnds:
    """The two open ends that are nearest to each other."""
    if len(ends) < 2:
        return OpenEnds(np.nan, np.full(2, np.nan))
    some = ends[:1000]
    apart = np.hypot(*np.moveaxis(some[:, None] - some, -1, 0))
    apart[np.diag_indices(len(some))] = np.inf
    k = int(apart.min(axis=1).argmin())
    return OpenEnds(float(apart[k].min()), some[k])
