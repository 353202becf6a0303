"""The cognates of a linkage, judged where its coupler point is at the points of the task."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import numpy as np

from burmester.describe.cognates import cognates_of
from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation, pair_of
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Synthesis
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.data import linkage_report

FRAMES: Final = 181  # along each way of a cognate


def cognate_reports(synthesis: Synthesis | None, linkage: object) -> dict[str, Any]:
    """The cognates of one linkage of a synthesis, each as the page draws a linkage.

    linkage: its id.  No cognates where some angle counts, or where there are none.  Raises
    InputError E151 (no such linkage).
    """
    found = next((e for e in synthesis.linkages if e.id == linkage), None) if synthesis else None
    if synthesis is None or found is None:
        raise InputError("E151", "there is no such linkage", help="give the id of one, such as L1")
    every = cognates_of(found, synthesis.problem.given)
    shared = found.driver_first
    reports = []
    for number, each in enumerate(every, start=1):
        # Which fixed pivot a cognate shares with the linkage says which link its body turns as.
        own, links = each.first, (shared.first, shared.second)
        turns = next(
            (d for d in links if isinstance(d, RR) and isinstance(own, RR) and _same(d, own)), None
        )
        if turns is not None:
            judged = replace(_judged(synthesis, found, each, turns), id=f"C{number}")
            reports.append(linkage_report(synthesis, judged, FRAMES))
    return {"of": found.id, "linkages": reports}


def _same(one: RR, other: RR) -> bool:
    return bool(np.array_equal(one.fixed_pivot, other.fixed_pivot))


def _judged(synthesis: Synthesis, found: FoundLinkage, cognate: Linkage, link: RR) -> FoundLinkage:
    """A cognate at the places at which the linkage is; its body turns as `link` of it does."""
    problem = synthesis.problem
    target = target_of(problem)
    evaluation = Evaluation(problem, target)
    there = found.error.places
    arm = there.act(link.moving_pivot) - link.fixed_pivot
    angle: FloatArray = np.unwrap(np.arctan2(arm[..., 1], arm[..., 0]))
    own = LinkageBatch.of([cognate])
    rows = target.rows_at(Displacement(there.translation, angle))
    pair = pair_of(cognate.first, cognate.second, evaluation.task.poses)
    batch, searched = own.to_canonical(target.frames), np.zeros(1, dtype=bool)
    (judged,) = evaluation.members(Candidates(batch, rows[None], [pair], searched, own))
    return judged
