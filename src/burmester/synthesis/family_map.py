"""The map of the family of what came of a task of three or four poses."""

from __future__ import annotations

from burmester.families.family_map import COLUMNS, CURVE_SAMPLES, ROWS, FamilyMap, family_map
from burmester.families.pair_verdicts import PairBounds
from burmester.fourbar.linkage import Linkage
from burmester.synthesis.result import Synthesis
from burmester.verdicts.assumptions import Assumptions


def recommended(synthesis: Synthesis) -> Linkage | None:
    """The linkage that stands first, if it works."""
    first = next(iter(synthesis.linkages), None)
    return first.linkage if first is not None and first.usable else None


def family_map_of(
    synthesis: Synthesis,
    *,
    samples: int = CURVE_SAMPLES,
    columns: int = COLUMNS,
    rows: int = ROWS,
) -> FamilyMap | None:
    """The map of the task's family, with the bounds that its linkages were held to.

    Of three poses beside a dyad of the linkage that stands first, whether it works or not.  None
    where there is none, or the motion is a special one, which has no such family.  Raises as
    `family_map`.
    """
    problem = synthesis.problem
    if problem.is_special:
        return None
    first = synthesis.linkages[0].linkage if synthesis.linkages else None
    bounds = None
    if synthesis.family is not None:
        attempts = Assumptions.attempts(problem)
        known = next(each for each, _ in attempts if each.bounds == synthesis.family.bounds)
        bounds = PairBounds.assumed(known)
    return family_map(problem.task, first, bounds, samples=samples, columns=columns, rows=rows)
