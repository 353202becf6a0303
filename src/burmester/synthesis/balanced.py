"""Springs for the linkages of a task: each usable linkage with the springs that balance it best."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.loads.balance import Balanced, Offer, balanced
from burmester.numerics.arrays import FloatArray
from burmester.progress import step
from burmester.requirements.loads import OF_LOADS
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.verdicts.judged_linkage import LinkageAtPoses

MOST_LINKAGES = 6  # of an answer, the best first
EACH = 3  # springs that are told of a linkage
WIDER = 0.5  # sizes of the linkage by which the usual region of the ground is wider than its pivots


class BalanceRegions(NamedTuple):
    """Where a spring may attach: boxes (2, 2) of corners in F and in M; None for the usual ones."""

    ground: FloatArray | None = None
    body: FloatArray | None = None


def balance(
    task: Task,
    offers: Sequence[Offer],
    regions: BalanceRegions | None = None,
    options: SynthesisOptions | None = None,
) -> tuple[Synthesis, list[Balanced]]:
    """The answer of a task without bounds on its loads, and its linkages with springs.

    Those that keep all bounds come first, then those with the least force of the hand.  Raises
    InputError E134 where the task has no loads.
    """
    if task.loads is None:
        raise InputError(
            "E134",
            "there is nothing to balance: the task has no loads",
            help="state the mass of the body and where the hand is, in the table loads",
        )
    asked = task.requirements
    free = {each.name: each.default for each in OF_LOADS}
    answer = synthesize(
        replace(task, requirements=replace(asked, **free)), options or SynthesisOptions()
    )
    out = list[Balanced]()
    for found in [each for each in answer.linkages if each.usable][:MOST_LINKAGES]:
        step(f"looking at springs for {found.id}")
        own = replace(found, task=replace(found.task, requirements=asked))
        ground, body = (
            usual if given is None else given
            for given, usual in zip(regions or BalanceRegions(), usual_regions(own), strict=True)
        )
        out += balanced(own, offers, ground, body, EACH)
    return answer, sorted(out, key=lambda each: (not each.keeps, each.worst))


def usual_regions(found: LinkageAtPoses) -> tuple[FloatArray, FloatArray]:
    """Boxes about the pins on the ground, and about the body: its outline, or its pins."""
    bodies = found.bodies
    fixed, moving = (
        np.array([each.holes[name] for each in bodies.joints if name in each.holes])
        for name in ("ground", bodies.body)
    )
    size = max(float(np.ptp(each, axis=0).max()) for each in (fixed, moving))
    wider = WIDER * size
    outline = found.task.body
    own = moving if outline is None else outline.vertices
    return (
        np.array([fixed.min(axis=0) - wider, fixed.max(axis=0) + wider]),
        np.array([own.min(axis=0), own.max(axis=0)]),
    )
