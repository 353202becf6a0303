"""Defects as values, each with its message and the poses concerned."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Finding
from burmester.mechanisms.pose_order import BoolArray
from burmester.numerics.arrays import FloatArray
from burmester.wording import LEAST_RUN, count, figure, in_runs, listed, shortened

MAX_NAMES: Final = 6  # poses, ranges of poses, or pairs of poses that one message lists
MAX_ORDER: Final = 12  # poses whose order is told one by one; of more, runs in order are one
UNSURE: Final = ": too close to call"  # the end of messages on defects that are not certain


class PoseNames(NamedTuple):
    """The names of poses in messages: those given, else their numbers from 1."""

    given: Sequence[str] | None

    def one(self, pose: int) -> str:
        """The name of one pose: "3"."""
        return str(pose + 1) if self.given is None else self.given[pose]

    def listed(self, poses: Sequence[int]) -> str:
        """The names of poses in one phrase: "1, 2 and 5"."""
        return in_runs([self.one(pose) for pose in poses], MAX_NAMES)

    def phrase(self, poses: Sequence[int]) -> str:
        """The same with the noun: "pose 3", "poses 1, 2 and 5"."""
        return ("pose " if len(poses) == 1 else "poses ") + self.listed(poses)

    def between(self, pairs: Sequence[tuple[int, int]]) -> str:
        """Pairs of poses in one phrase: "between poses 1 and 2".

        Pairs in a row, as noise near a dead point makes them, are one: "4 times between poses 7
        and 11".
        """
        rows: list[list[tuple[int, int]]] = []
        for pair in pairs:
            if rows and rows[-1][-1][1] == pair[0]:
                rows[-1].append(pair)
            else:
                rows.append([pair])
        between = []
        for row in rows:
            times = f"{count(len(row), 'time')} " if len(row) > 1 else ""
            between.append(f"{times}between {self.phrase((row[0][0], row[-1][1]))}")
        return listed(shortened(between, MAX_NAMES, "times"))

    def in_order(self, poses: Sequence[int]) -> str:
        """Poses in the order in which they are met: "1-2-4-3", of many "1 to 9, 11, 10"."""
        if len(poses) <= MAX_ORDER:
            return "-".join(map(self.one, poses))
        runs: list[list[int]] = []
        for pose in poses:
            run = runs[-1] if runs else []
            sense = run[1] - run[0] if len(run) > 1 else pose - run[0] if run else 0
            if abs(sense) == 1 and pose == run[-1] + sense:
                run.append(pose)
            elif len(runs) > MAX_NAMES:  # what follows is not told
                break
            else:
                runs.append([pose])
        told = []
        for run in runs:
            if len(run) >= LEAST_RUN:
                told.append(f"{self.one(run[0])} to {self.one(run[-1])}")
            else:
                told += map(self.one, run)
        return ", ".join(told if len(told) <= MAX_NAMES else [*told[:MAX_NAMES], "..."])


def assembly_defects(
    far: BoolArray, assembled: BoolArray, missed: FloatArray, names: PoseNames
) -> list[Finding]:
    """The assembly defects of one linkage that is too far from poses `far` (N,)."""
    nowhere, near = pose_numbers(~assembled), pose_numbers(far & assembled)
    defects = []
    if nowhere:
        text = f"it cannot be assembled near {names.phrase(nowhere)}"
        defects.append(Finding("assembly", text, nowhere))
    if near:
        worst = max(near, key=lambda pose: missed[pose])
        text = (
            f"the coupler comes no nearer to pose {names.one(worst)} than {figure(missed[worst])}"
        )
        others = [pose for pose in near if pose != worst]
        if others:
            text += f", and misses {names.phrase(others)} by {figure(min(missed[others]))} or more"
        defects.append(Finding("assembly", text, near))
    return defects


def circuit_defect(
    clear: BoolArray,
    labels: NDArray[np.int8],
    main: int,
    *,
    any_order: bool,
    names: PoseNames,
    change: bool = False,
    other_name: str = "the other",
) -> Finding:
    """The defect of one linkage with clear poses (N,) on several circuits.

    labels: (N,), the circuits of the poses; main: the circuit with most of them.
    change: whether the linkage is at a change point; other_name: of a circuit but the first.
    """
    one, other = _parts(labels, clear, names)
    verb = "is" if one.startswith("pose ") else "are"
    text = f"{one} {verb} on one assembly, {other} on {other_name}"
    if change:
        text += f", and both meet at a change point{UNSURE}"
    elif any_order:
        text += ": it must be taken apart between them"
    else:
        text += f": it must be taken apart {names.between(changes(labels, clear))}"
    return Finding("circuit", text, pose_numbers(clear & (labels != main)), not change)


def branch_defect(
    clear: BoolArray,
    key: NDArray[np.int8],
    *,
    any_order: bool,
    names: PoseNames,
    change: bool = False,
) -> Finding:
    """The defect of one linkage with clear poses (N,) on several branches of a circuit.

    key: (N,), the branches of the poses; change: whether the linkage is at a change point.
    """
    pairs = changes(key, clear)
    poses = tuple(sorted({pose for pair in pairs for pose in pair}))
    if any_order:
        one, other = _parts(key, clear, names)
        verb, point = ("passes", "change") if change else ("locks at", "dead")
        text = f"{verb} a {point} point between {one} and {other}"
    elif change:
        text = f"passes a change point {names.between(pairs)}"
    else:
        at = "a dead point" if len(pairs) == 1 else "dead points"
        text = f"locks {names.between(pairs)}, at {at}"
    return Finding("branch", text + UNSURE * change, poses, not change)


def in_another_order(
    poses: NDArray[np.intp], steps: FloatArray, names: PoseNames, *, all_round: bool
) -> Finding:
    """The order in which poses (n,) are met, of both senses the one with the lower number first.

    steps: (n,), where they are along the way; all_round: whether that closes.
    """
    sequences = []
    for sense in (1, -1):
        sequence = poses[np.lexsort((poses, sense * steps))].tolist()
        start = sequence.index(poses[0]) if all_round else 0
        sequences.append(sequence[start:] + sequence[:start])
    met = min(sequences)
    moved = tuple(a for a, b in zip(poses.tolist(), met, strict=True) if a != b)
    return Finding("order", f"meets the poses in the order {names.in_order(met)}", moved)


def undetermined_defect(on: BoolArray) -> Finding:
    """The uncertain defect of a linkage whose motion rounding leaves open; on: its poses (N,)."""
    text = (
        "its guides are parallel or a link has zero length, within rounding, "
        "so its motion cannot be determined"
    )
    return Finding("branch", text, pose_numbers(on), certain=False)


def pose_numbers(mask: BoolArray) -> tuple[int, ...]:
    """The numbers of the poses that a mask holds."""
    return tuple(np.flatnonzero(mask).tolist())


def changes(key: NDArray[np.int8], clear: BoolArray) -> list[tuple[int, int]]:
    """The pairs of successive poses between which the key changes."""
    return [(a, b) for a, b in pairwise(pose_numbers(clear)) if key[a] != key[b]]


def _parts(key: NDArray[np.int8], clear: BoolArray, names: PoseNames) -> tuple[str, str]:
    """The poses with the key of the first one, and the others."""
    same = clear & (key == key[clear.argmax()])
    return names.phrase(pose_numbers(same)), names.listed(pose_numbers(clear & ~same))
