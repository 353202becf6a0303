"""All linkages of an Alt-Burmester problem, counted.

Every linkage of a solved problem is followed to the task.  Where ends are missing, paths that were
lost or came where another one was are followed in smaller steps, and what is missing then is looked
for from a second solved problem.
"""

from __future__ import annotations

from typing import Final, NamedTuple, final

import numpy as np

from burmester.numerics.arrays import ComplexArray
from burmester.numerics.bundles import concatenate, take
from burmester.points.alt_burmester import Positions
from burmester.points.classes import distinct
from burmester.points.path_tracking import ACCURACY, Paths, polished, tracked
from burmester.points.start_systems import CASES, Case, start_system
from burmester.progress import goes_on, step

__all__ = ["AllLinkages", "all_linkages", "case_of"]

SETTLED: Final = 1e-8  # relative; Newton's last step on a linkage
FINER: Final = 1e-2  # share of the accuracy with which lost paths are followed again
HUNDRED: Final = 100  # parts of the way that progress is told in


@final
class AllLinkages(NamedTuple):
    """The linkages that meet a problem, one of each class, real and complex.

    x: (n, 8); turns: (n, J), at the positions beside the base.
    classes: how many there are of a problem in general position; n were found.
    systems: from how many solved problems they were looked for.
    """

    x: ComplexArray
    turns: ComplexArray
    classes: int
    systems: int


def case_of(positions: Positions) -> Case:
    """The case of a problem (leading axis 1)."""
    return Case(positions.further_poses + 1, positions.points, positions.pivots)


def all_linkages(positions: Positions) -> AllLinkages:
    """The linkages of a problem of one of the CASES, its base at 0, its size about 1."""
    case = case_of(positions)
    classes = CASES[case]
    found = None
    for number in range(case.systems):
        x, turns = _ends(case, positions, number, classes)
        if found is not None:
            x, turns = np.concatenate([found[0], x]), np.concatenate([found[1], turns])
        index = distinct(x, positions)
        found = x[index], turns[index]
        if len(index) >= classes:
            break
    assert found is not None
    return AllLinkages(*found, classes, number + 1)


def _ends(
    case: Case, positions: Positions, number: int, classes: int
) -> tuple[ComplexArray, ComplexArray]:
    """The ends of all paths from one of the solved problems of a case, each of them once."""
    again = ", from another solved problem" if number else ""
    step(f"following {classes:,} linkages to the task{again}")

    def watch(share: float) -> None:
        goes_on(1 + int((HUNDRED - 1) * share), HUNDRED, "part")

    start = start_system(case, number)
    paths = tracked(start.x, start.turns, start.positions, positions, watch=watch)
    x, turns, miss = polished(paths.x, paths.turns, positions)
    good = paths.arrived & (miss < SETTLED)
    index = np.flatnonzero(good)[distinct(x[good], positions)]
    if len(index) == classes:
        return x, turns
    missing = np.setdiff1d(np.arange(len(x)), index)
    finer: Paths = tracked(
        start.x[missing],
        start.turns[missing],
        start.positions,
        positions,
        accuracy=ACCURACY * FINER,
    )
    more, more_turns, miss = polished(finer.x, finer.turns, positions)
    some = finer.arrived & (miss < SETTLED)
    return concatenate([(x[good], turns[good]), take((more, more_turns), some)])
