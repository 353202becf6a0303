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
    left = set(range(len(pieces)))
    loops: list[Curve] = []
    open_ends: list[int] = []
    while left:
        chain, end = _followed(min(left), node, at_node)
        left -= {piece for piece, _ in chain}
        if end is None:
            loops.append(_loop(chain, pieces))
        else:
            open_ends += [end, *([] if len(chain) < 1 else [_other_end(chain)])]
    return (
        closed + loops,
        _least_gap(ends[np.unique(open_ends)] if open_ends else ends[:0]),
        (len(pieces) - sum(each.kind.count("+") + 1 for each in loops)),
    )


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


_Chain = list[tuple[int, bool]]  # pieces, and whether each is run through from its first point


def _followed(
    start: int, node: np.ndarray, at_node: dict[int, list[int]]
) -> tuple[_Chain, int | None]:
    """The pieces that hang together with one, and an open end, or None where they close."""
    chain: _Chain = [(start, True)]
    seen = {start}
    for forwards in (True, False):
        end = 2 * start + (1 if forwards else 0)
        while True:
            here = at_node[int(node[end])]
            others = [each for each in here if each != end]
            if len(others) != 1:
                break  # an end, or a branch
            piece = others[0] // 2
            if piece in seen:
                return chain, None  # back at the beginning
            seen.add(piece)
            from_first = others[0] % 2 == 0
            if forwards:
                chain.append((piece, from_first))
            else:
                chain.insert(0, (piece, not from_first))
            end = others[0] ^ 1
        if not forwards:
            return chain, end
    raise AssertionError("unreachable")


def _other_end(chain: _Chain) -> int:
    piece, forwards = chain[-1]
    return 2 * piece + (1 if forwards else 0)


def _loop(chain: _Chain, pieces: list[Curve]) -> Curve:
    """The closed curve of a chain of pieces."""
    points = [pieces[k].points if forwards else pieces[k].points[::-1] for k, forwards in chain]
    kinds = [pieces[k].kind for k, _ in chain]
    return Curve(
        np.concatenate([part[:-1] for part in points]), True, " + ".join(kinds),
        pieces[chain[0][0]].names,
    )  # fmt: skip


def _least_gap(ends: FloatArray) -> OpenEnds:
    """The two open ends that are nearest to each other."""
    if len(ends) < 2:
        return OpenEnds(np.nan, np.full(2, np.nan))
    some = ends[:1000]
    apart = np.hypot(*np.moveaxis(some[:, None] - some, -1, 0))
    apart[np.diag_indices(len(some))] = np.inf
    k = int(apart.min(axis=1).argmin())
    return OpenEnds(float(apart[k].min()), some[k])
