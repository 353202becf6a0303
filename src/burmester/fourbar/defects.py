"""What keeps a linkage from leading its coupler through the poses: a verdict, and its reasons.

Chase and Mirth's defects (Circuits and branches of single-degree-of-freedom planar linkages,
Journal of Mechanical Design 115, 1993): it cannot be assembled at a pose; the poses are on
different circuits; between two poses a drive locks at a dead point; they are met in another
order.  Everything comes from the exact circuits (see `passage`), nothing from sampling.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, Literal, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage import Linkage
from burmester.fourbar.traversal import (
    REPEATED,
    STEP_BACK,
    TOO_CLOSE,
    BoolArray,
    Passage,
    Range,
    Seen,
    detour,
    first_of,
    passage,
    range_of,
)
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.wording import listed, shortened

__all__ = [
    "Defect",
    "DefectKind",
    "Driven",
    "Verdict",
    "judge",
]

DefectKind = Literal["assembly", "circuit", "branch", "order"]

MOST: Final = 12  # poses, or ways between them, that a message lists


@final
@dataclass(frozen=True, slots=True, eq=False)
class Defect:
    """Why a linkage does not lead through the poses.

    poses: the numbers, from 0, of those that it is about: missed; on the lesser circuit; on both
    sides of a dead point; met out of turn.
    certain: False where it is too close to call.
    """

    kind: DefectKind
    message: str
    poses: tuple[int, ...]
    certain: bool = True


@final
@dataclass(frozen=True, slots=True, eq=False)
class Driven:
    """How a linkage does when one of its dyads drives, between the first and the last pose.

    defects: branch and order.
    circuit: the number, in `Circuits.of` of this drive and as given, of the circuit with the most
        poses (of two with as many, the one met first); -1 where nothing can be told.
    turns_fully: whether the drive turns round and round there, without dead points.
    transmission: (N,), at the poses, on whichever circuit; nan where there is no place.
    least_at_poses: the least of these.
    least_over_range: the least over the range between the poses of that circuit: exact, not
        sampled.
    parameter: (N,) along the circuit, see `Circuits`, unwrapped along the journey; nan for poses
        that are not on it.
    drive: (N,) the drive's coordinate (see `DrivenLoop`) along the journey, radians or a length.
    travel: (2,) the least and the greatest drive in that range.

    Where the poses are met in their order, the range runs through them in that order.  Else it is
    the smallest that holds them all.  Where it can be had in either sense, or in any order, another
    is taken instead of one that comes too close to locking.
    """

    defects: tuple[Defect, ...]
    circuit: int
    turns_fully: bool
    transmission: FloatArray
    least_at_poses: float
    least_over_range: float
    drive: FloatArray
    travel: FloatArray
    parameter: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class Verdict:
    """The defects of one linkage.

    defects: assembly and circuit, whichever dyad drives.
    first, second: the rest, driven by the first and by the second dyad.
    """

    defects: tuple[Defect, ...]
    first: Driven
    second: Driven


def judge(
    linkage: Linkage,
    places: Displacement,
    *,
    missed: FloatArray,
    reach: float,
    length: float | None = None,
    names: Sequence[str] | None = None,
    any_order: bool = False,
) -> list[Verdict]:
    """The verdicts on linkages (k,) of one pair of kinds, RR, PR or RP, from either driver.

    places: (k, N), the coupler's places nearest to the poses, in their order; nan where there is
        none: such poses are left out of the other verdicts.
    missed: (k, N), how far each pose is from its place; by more than `reach` is an assembly
        defect.  Both in the unit in which distances between poses are taken.
    length: what a radian counts as in `missed`; None takes the poses as met, whatever they are
        missed by.
    names: what messages call the poses, instead of their numbers from 1.
    any_order: whether the poses may be met in any order.

    A branch defect is certain, but within TOO_CLOSE of a dead point: there, and wherever a
    linkage is within 1e-9 of a change point and passes it, it is called with certain=False.  Such
    a linkage is taken as given (see `Circuits.of`); its poses on one piece between change points
    make no defect.  Order is judged along the branch or, where a drive turns fully, in either
    sense within one turn; with a branch defect, along the circuit, as it would be with help over
    the dead point.  Poses that lie less than REPEATED apart have no order, nor do those that lie
    nearer to each other along the circuit than twice the greatest miss: met half way between, each
    would be missed along the circuit by no more than some pose is across it.  A step back of less
    than STEP_BACK is an order defect that is not certain.
    """
    sides = (linkage, Linkage(linkage.second, linkage.first))
    seen = [Seen.of(side, places) for side in sides]
    change = seen[0].circuits.undecided[:, 0]
    found = np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1)
    one, other = (side.location.circuit for side in seen)
    labels = np.where(one < 0, other, one)
    least = np.fmin(seen[0].transmission, seen[1].transmission)
    weak = change[:, None] & (least < TOO_CLOSE)
    clear = found & (labels >= 0) & ~weak
    count = np.stack([(clear & (labels == number)).sum(axis=1) for number in (0, 1)])
    first_met = np.take_along_axis(labels, first_of(clear, found)[:, None], axis=1)[:, 0]
    main = np.where(count[0] == count[1], first_met, count[1] > count[0])
    on = found & ((labels == main[:, None]) | weak)

    called = _Names(names)
    common: list[list[Defect]] = [[] for _ in found]
    far = ~(missed <= reach) | ~found
    for k in np.flatnonzero(far.any(axis=1)):
        common[k] += _assembly(far[k], found[k], missed[k], called)
    for k in np.flatnonzero((count > 0).all(axis=0)):
        defect = _circuit(clear[k], labels[k], change[k], any_order, called)
        lesser = _numbers(clear[k] & (labels[k] != main[k]))
        common[k].append(Defect("circuit", defect, lesser, not change[k]))
    loose = np.zeros(len(found))
    if length is not None:
        loose = 2 * np.where(found, np.minimum(missed, reach), 0.0).max(axis=1)
    first, second = (
        _driven(side, each, on, (loose, length or 0.0), any_order, called)
        for side, each in zip(sides, seen, strict=True)
    )
    return [
        Verdict(tuple(defects), a, b) for defects, a, b in zip(common, first, second, strict=True)
    ]


def _driven(  # noqa: PLR0917
    linkage: Linkage,
    seen: Seen,
    on: BoolArray,
    loose: tuple[FloatArray, float],
    any_order: bool,
    called: _Names,
) -> list[Driven]:
    """The verdicts on linkages (k,) with one driver, from the poses (k, N) on their circuit.

    loose: the distances (k,) within which poses have no order, and what a radian counts as there.
    """
    journey = passage(linkage, seen, on, loose, any_order)
    journey, ranged = detour(journey, range_of(journey, seen), seen, any_order)
    told, along, circuits = journey.told, journey.order.along, journey.circuits
    parameter = np.where(told, along, np.nan)
    some = told.any(axis=1)
    turns = circuits.closed & (circuits.branches == 1) & some
    lowest = np.fmin.reduce(seen.transmission, axis=1)

    defects: list[list[Defect]] = [[] for _ in range(len(told))]
    close = some & (ranged.least < TOO_CLOSE)
    for k in np.flatnonzero(journey.crossing | close).tolist():
        if journey.crossing[k]:
            defects[k].append(_branch(journey, k, any_order, called))
        else:
            defects[k].append(_close(journey, ranged, k, called))
    for k in np.flatnonzero(
        some & (journey.order.back > np.maximum(REPEATED, journey.order.slack))
    ).tolist():
        defects[k].append(_order(journey, ranged, k, called))
    for k in np.flatnonzero(on.any(axis=1) & ~some).tolist():
        defects[k].append(_untold(on[k]))
    return [
        Driven(
            tuple(defects[k]),
            int(journey.circuit[k]),
            bool(turns[k]),
            seen.transmission[k],
            float(lowest[k]),
            float(ranged.least[k]),
            ranged.drive[k],
            ranged.travel[k],
            parameter[k],
        )
        for k in range(len(told))
    ]


# Words --------------------------------------------------------------------------------------------


class _Names(NamedTuple):
    """What messages call poses."""

    given: Sequence[str] | None

    def one(self, pose: int) -> str:
        return str(pose + 1) if self.given is None else self.given[pose]

    def listed(self, poses: Sequence[int]) -> str:
        return listed(shortened([self.one(pose) for pose in poses], MOST))

    def __call__(self, poses: Sequence[int]) -> str:
        return ("pose " if len(poses) == 1 else "poses ") + self.listed(poses)

    def between(self, pairs: Sequence[tuple[int, int]]) -> str:
        return listed(shortened([f"between {self(pair)}" for pair in pairs], MOST, "times"))


def _numbers(mask: BoolArray) -> tuple[int, ...]:
    return tuple(np.flatnonzero(mask).tolist())


UNSURE = ": too close to call"


def _assembly(far: BoolArray, found: BoolArray, missed: FloatArray, called: _Names) -> list[Defect]:
    nowhere, near = _numbers(~found), _numbers(far & found)
    defects = []
    if nowhere:
        text = f"it cannot be assembled near {called(nowhere)}"
        defects.append(Defect("assembly", text, nowhere))
    if near:
        worst = max(near, key=lambda pose: missed[pose])
        text = f"the coupler comes no nearer to pose {called.one(worst)} than {missed[worst]:.2g}"
        others = [pose for pose in near if pose != worst]
        if others:
            text += f", and misses {called(others)} by {min(missed[others]):.2g} or more"
        defects.append(Defect("assembly", text, near))
    return defects


def _changes(key: NDArray[np.int8], clear: BoolArray) -> list[tuple[int, int]]:
    """The poses, one after the other, between which the key changes."""
    return [(a, b) for a, b in pairwise(_numbers(clear)) if key[a] != key[b]]


def _parts(key: NDArray[np.int8], clear: BoolArray, called: _Names) -> tuple[str, str]:
    """The poses that are with the first, and the others."""
    same = clear & (key == key[clear.argmax()])
    return called(_numbers(same)), called.listed(_numbers(clear & ~same))


def _circuit(
    clear: BoolArray, labels: NDArray[np.int8], change: bool, any_order: bool, called: _Names
) -> str:
    one, other = _parts(labels, clear, called)
    verb = "is" if one.startswith("pose ") else "are"
    text = f"{one} {verb} on one assembly, {other} on the other"
    if change:
        return f"{text}, and both meet at a change point{UNSURE}"
    if any_order:
        return f"{text}: it must be taken apart between them"
    return f"{text}: it must be taken apart {called.between(_changes(labels, clear))}"


def _branch(journey: Passage, k: int, any_order: bool, called: _Names) -> Defect:
    clear, key, change = journey.clear[k], journey.key[k], bool(journey.circuits.undecided[k])
    pairs = _changes(key, clear)
    poses = tuple(sorted({pose for pair in pairs for pose in pair}))
    if any_order:
        one, other = _parts(key, clear, called)
        verb, point = ("passes", "change") if change else ("locks at", "dead")
        text = f"{verb} a {point} point between {one} and {other}"
    elif change:
        text = f"passes a change point {called.between(pairs)}"
    else:
        points = "at a dead point" if len(pairs) == 1 else "at dead points"
        text = f"locks {called.between(pairs)}, {points}"
    return Defect("branch", text + UNSURE * change, poses, not change)


def _close(journey: Passage, ranged: Range, k: int, called: _Names) -> Defect:
    """A range that comes too near to where the drive may lock."""
    at, worst, count = ranged.along[k], ranged.worst[k], journey.told.shape[1]
    least = np.degrees(ranged.least[k])
    if worst < count:
        poses: tuple[int, ...] = (int(worst),)
        place = f"at {called(poses)}"
    else:
        along = at[:count]
        before = int(np.nanargmax(np.where(along <= at[worst], along, np.nan)))
        after = int(np.nanargmin(np.where(along >= at[worst], along, np.nan)))
        poses = tuple(sorted((before, after)))
        place = called.between([(poses[0], poses[1])])
    if journey.circuits.undecided[k]:
        text = f"{'is at' if worst < count else 'passes'} a change point {place}"
    else:
        within = f"within {least:.1g}° of" if least > 1e-4 else "to"
        text = f"comes {within} a dead point {place}"
    return Defect("branch", text + UNSURE, poses, certain=False)


def _order(journey: Passage, ranged: Range, k: int, called: _Names) -> Defect:
    told = journey.told[k]
    # Which way a change point leads is not known.
    passed = journey.circuits.undecided[k] and ranged.least[k] < TOO_CLOSE
    certain = journey.order.back[k] > STEP_BACK and not journey.doubtful[k] and not passed
    poses = np.flatnonzero(told)
    steps = np.round(journey.order.along[k][told] / (REPEATED * journey.size[k]))
    # Of both senses, the one with the lower number first.
    ways = []
    for sense in (1, -1):
        way = poses[np.lexsort((poses, sense * steps))].tolist()
        start = way.index(poses[0]) if journey.round[k] else 0
        ways.append(way[start:] + way[:start])
    met = min(ways)
    moved = tuple(a for a, b in zip(poses.tolist(), met, strict=True) if a != b)
    shown = [called.one(pose) for pose in met[:MOST]] + ["..."] * (len(met) > MOST)
    text = f"meets the poses in the order {'-'.join(shown)}"
    return Defect("order", text + UNSURE * (not certain), moved, bool(certain))


def _untold(on: BoolArray) -> Defect:
    text = "has parallel guides, or a link of no length, but for rounding: its motion is not known"
    return Defect("branch", text, _numbers(on), certain=False)
