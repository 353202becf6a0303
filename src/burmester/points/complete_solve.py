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
from burmester.points.families import is_in_family
from burmester.points.path_tracking import ACCURACY, polished, tracked
from burmester.points.start_systems import CASES, Case, start_system
from burmester.progress import goes_on, step

__all__ = ["AllLinkages", "all_linkages", "case_of"]

SETTLED: Final = 1e-7  # relative; Newton's last step on a linkage
FINER: Final = 1e-2  # share of the accuracy with which lost paths are followed again
HUNDRED: Final = 100  # parts of the way that progress is told in
FAR: Final = 100.0  # sizes of the problem; a path that stops farther leads to infinity
MOST_TRIED: Final = 20  # ends of paths that are looked at for families


@final
class AllLinkages(NamedTuple):
    """The linkages that meet a problem, one of each class, real and complex.

    x: (n, 8); turns: (n, J), at the positions beside the base.
    classes: how many there are of a problem in general position; n were found.
    followed: how many of them were followed to the task; fewer where a time limit ended it.
    systems: from how many solved problems they were looked for.
    family: whether linkages are left that are not alone: infinitely many meet the problem.
    """

    x: ComplexArray
    turns: ComplexArray
    classes: int
    followed: int
    systems: int
    family: bool = False


def case_of(positions: Positions) -> Case:
    """The case of a problem (leading axis 1)."""
    return Case(positions.further_poses + 1, positions.points, positions.pivots)


def all_linkages(positions: Positions) -> AllLinkages:
    """The linkages of a problem of one of the CASES, its base at 0, its size about 1."""
    case = case_of(positions)
    classes = CASES[case]
    x, turns, followed, others, other_turns = _ends(case, positions, 0)
    stopped = zip(others[:MOST_TRIED], other_turns[:MOST_TRIED], strict=True)
    systems, family = 1, any(is_in_family(*each, positions) for each in stopped)
    while len(x) < followed == classes and systems < case.systems:
        again = _ends(case, positions, systems)
        x, turns = concatenate([(x, turns), (again.x, again.turns)])
        x, turns = take((x, turns), distinct(x, positions))
        systems += 1
    return AllLinkages(x, turns, classes, followed, systems, family)


class _Ends(NamedTuple):
    """The ends x (n, 8) with turns (n, J) of so many paths, each of them once.

    others: (k, 8), where paths stopped that did not arrive, with their turns (k, J).
    """

    x: ComplexArray
    turns: ComplexArray
    followed: int
    others: ComplexArray
    other_turns: ComplexArray


def _ends(case: Case, positions: Positions, number: int) -> _Ends:
    """The ends of all paths from one of the solved problems of a case."""
    again = ", from another solved problem" if number else ""
    step(f"following {CASES[case]:,} linkages to the task{again}", whole=False)

    def watch(share: float) -> bool:
        return goes_on(1 + int((HUNDRED - 1) * share), HUNDRED, "part")

    start = start_system(case, number).nearest_to(positions)
    paths = tracked(start.x, start.turns, start.positions, positions, watch=watch)
    begun = paths.steps > 0
    x, turns, miss = polished(paths.x, paths.turns, positions)
    good = paths.arrived & (miss < SETTLED)
    index = np.flatnonzero(good)[distinct(x[good], positions)]
    missing = np.setdiff1d(np.flatnonzero(begun), index)
    stopped = begun & ~paths.arrived & (np.abs(paths.x).max(axis=1, initial=0.0) < FAR)
    others = paths.x[stopped], paths.turns[stopped]
    if begun.all() and len(missing):
        finer = tracked(
            *take((start.x, start.turns), missing),
            start.positions,
            positions,
            accuracy=ACCURACY * FINER,
            watch=watch,
        )
        more, more_turns, miss = polished(finer.x, finer.turns, positions)
        some = finer.arrived & (miss < SETTLED)
        x, turns = concatenate([(x[good], turns[good]), take((more, more_turns), some)])
        index = distinct(x, positions)
    return _Ends(x[index], turns[index], int(begun.sum()), *others)
