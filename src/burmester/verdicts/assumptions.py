"""What is assumed of a linkage where a task says nothing.

Few poses leave infinitely many linkages, most of them useless: as long as a street, or locked.  So
what the task leaves open is bounded by conventions of practice, and every bound that was used is
told, with the option that changes it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple, Self, final

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import Advice
from burmester.geometry.regions import Polygon, box_around
from burmester.requirements.requirement import Bounds
from burmester.requirements.table import ASKED, standard
from burmester.tasks.limits import Limits
from burmester.tasks.notation import length_of, span
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.requirement_check import not_asked
from burmester.wording import listed

REACH: Final = 1.0  # motion sizes; how far pivots may lie from the body's places where none says
WIDE: Final = 3.0  # the same, where nothing works within that
FAR: Final = 12.0  # the same, where nothing works at all; poses that hardly turn need it
OUTLINE_SHARE: Final = 0.1  # of an outline's diagonal; how far beside the body its pivots may lie
FIXED_PIVOT: Final = Cure("fixed_pivot", words="the region of fixed pivots")
MOVING_PIVOT: Final = Cure("moving_pivot", words="the region of moving pivots")


class Bound(NamedTuple):
    """Something that is assumed, in words, and the option that changes it."""

    message: str
    option: str


def assumed_advice(code: str, assumed: Sequence[tuple[str, str]]) -> Advice:
    """What was assumed where the task says nothing, and the options that change it."""
    words, options = zip(*assumed, strict=True)
    message = f"assumed: {listed(words)}"
    return Advice(code, message, Help.of("set {}", Help.listed(options, "or")))


@final
@dataclass(frozen=True, slots=True, eq=False)
class Assumptions:
    """Bounds for what the task leaves open.

    fixed, moving: where pivots lie that no limit holds, in F and in M.
    size: of the motion, a length; asked: what the task asks, and what is assumed beside.
    bounds: what of it the task did not say itself.
    """

    fixed: Polygon
    moving: Polygon
    size: float
    asked: Bounds
    bounds: tuple[Bound, ...]

    @classmethod
    def attempts(cls, problem: SynthesisProblem) -> Iterator[tuple[Self, bool]]:
        """What is assumed first, and next if nothing works; and whether something is given up."""
        yield cls.of(problem), False
        limits = problem.task.limits or (Limits(),)
        open_ = any(None in (each.fixed_pivot, each.moving_pivot) for each in limits)
        asked = problem.given.requirements.bounds
        if open_:
            yield cls.of(problem, WIDE), False
        if any(each.assumed and each not in asked for each in ASKED):
            yield cls.of(problem, WIDE if open_ else REACH, strict=False), True
        if open_:
            yield cls.of(problem, FAR), False

    @classmethod
    def of(cls, problem: SynthesisProblem, reach: float = REACH, *, strict: bool = True) -> Self:
        """What is assumed of a problem.

        reach: motion sizes, how far pivots may lie away; strict: whether linkages that one would
        rather not build are left out.
        """
        task, asked = problem.given, problem.given.requirements.bounds
        size = problem.motion_size
        bounds = []
        if not span(task) > 0 and task.body is None:
            words = f"a body of the size {length_of(size, task)}, as its origin stays where it is"
            cure = Cure("body", words="the outline of the body", assumed=(words, None))
            bounds.append(Bound(words, Help(cure)))
        if task.body is None:
            body = np.zeros((1, 2))
            moving, near = reach * size, "the origin of M"
        else:
            body = task.body.vertices
            moving = OUTLINE_SHARE * reach / REACH * float(np.linalg.norm(np.ptp(body, axis=0)))
            near = "the body's outline"
        around = task.poses[:, None].act(body).reshape(-1, 2)
        fixed, own = box_around(around, reach * size), box_around(body, moving)
        limits = task.limits or (Limits(),)
        if any(each.fixed_pivot is None and each.rail is None for each in limits):
            beside = f"fixed pivots within {length_of(reach * size, task)} of the body's places"
            bounds.append(Bound(beside, Help(replace(FIXED_PIVOT, assumed=(beside, fixed)))))
        if any(each.moving_pivot is None and each.slot is None for each in limits):
            away = f"moving pivots within {length_of(moving, task)} of {near}"
            bounds.append(Bound(away, Help(replace(MOVING_PIVOT, assumed=(away, own)))))
        for each in ASKED:
            if each.assumed and each not in asked:
                asked[each] = each.assumed[0 if strict else 1]
                words = each.words(asked[each])
                cure = replace(each.given(), assumed=(words, asked[each]))
                bounds.append(Bound(words, Help(cure)))
        asked |= standard(asked, size, not_asked(task))
        return cls(fixed, own, size, asked, tuple(bounds))
