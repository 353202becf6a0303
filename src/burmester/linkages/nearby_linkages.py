"""Better linkages near one that exists, and how far its pivots move.

The linkage is refined with either dyad driving, on the branch where it is, under what the task asks
and under transmission angles that rise from the standard's.  What the first steps give is judged as
well as the end, since a smaller move may do.  A heuristic: that no better linkage is nearer is not
proved.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from operator import attrgetter
from typing import NamedTuple, final

import numpy as np

from burmester.dyads.selection import FoundDyad
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.bearing_linkages import bearing_linkages
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.progress import goes_on, time_for
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.defect_free_search import (
    defect_free_linkages,
    driving_sides,
    refined_on_branch,
)
from burmester.refinement.least_error import Refined
from burmester.refinement.target import Target
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.ranking import digits_leave_open, farthest_recommended

# Numbers of steps of the refinements: after a few of them a linkage may be better and still near.
STEPS = (1, 4, 12, 36)
TRANSMISSION_GAINS = (10.0, 25.0)  # degrees that are tried above the given linkage's angle
MOST_TRANSMISSION = 75.0  # degrees; a higher angle is not asked for
EXACT_SHARE = 1e-6  # motion sizes; a pose that is to be met exactly may be missed by so much
ANGLE_GAIN = math.radians(2.0)  # radians; a linkage that transmits better by less is as good
ERROR_GAIN = 0.9  # ratio of combined errors; a linkage that is nearer by less is as near
MOST_KEPT = 3  # number of better linkages
SAME_SHARE = 1e-3  # motion sizes; linkages whose pivots differ by less are one


@final
class Move(NamedTuple):
    """How far one dyad of a linkage moves, in the task's unit; None for what it does not have.

    fixed_pivot, moving_pivot: distances.  length: what the link gains.  line: the distance of the
    middle of the old travel from the new line; turn: the angle between both lines, radians.
    """

    dyad: str
    fixed_pivot: float | None = None
    moving_pivot: float | None = None
    length: float | None = None
    line: float | None = None
    turn: float | None = None

    @property
    def greatest(self) -> float:
        """The greatest of these lengths."""
        lengths = (self.fixed_pivot, self.moving_pivot, self.length, self.line)
        return max(abs(each) for each in lengths if each is not None)


def moves(given: FoundLinkage, other: FoundLinkage) -> list[Move]:
    """How far the dyads of a linkage move to become those of another one, by their ids."""
    known = {each.id: each.dyad for each in other.dyads}
    return [
        _move(each, known[each.id], given) for each in sorted(given.dyads, key=attrgetter("id"))
    ]


def greatest_move(given: FoundLinkage, other: FoundLinkage) -> float:
    """The greatest move of a pivot, a length or a line."""
    return max(each.greatest for each in moves(given, other))


def _move(own: FoundDyad, new: Dyad, given: FoundLinkage) -> Move:
    old = own.dyad
    if isinstance(old, RR) and isinstance(new, RR):
        return Move(
            own.id,
            _apart(old.fixed_pivot, new.fixed_pivot),
            _apart(old.moving_pivot, new.moving_pivot),
            float(new.radius - old.radius),
        )
    if isinstance(old, PR) and isinstance(new, PR):
        line, turn = _line_move(old, new, given)
        moving = _apart(old.moving_pivot, new.moving_pivot)
        return Move(own.id, moving_pivot=moving, line=line, turn=turn)
    assert isinstance(old, RP)
    assert isinstance(new, RP)
    line, turn = _line_move(old, new, given)
    return Move(own.id, _apart(old.fixed_pivot, new.fixed_pivot), line=line, turn=turn)


def _apart(one: FloatArray, other: FloatArray) -> float:
    return float(np.hypot(*(other - one)))


def _line_move(old: PR | RP, new: PR | RP, given: FoundLinkage) -> tuple[float, float]:
    """How far a line moves at the middle of its travel, and turns."""
    middle = old.middle_of_travel(given.error.places)
    normal = np.array([math.cos(new.normal_angle), math.sin(new.normal_angle)])
    turn = float(wrapped_angle(2 * (new.normal_angle - old.normal_angle))) / 2
    return abs(float(normal @ middle - new.offset)), abs(turn)


def nearby_linkages(given: FoundLinkage, evaluation: Evaluation) -> list[FoundLinkage]:
    """Better linkages near a given one, the nearest first; the standard says what is better.

    Where it does not work, those that do; else those that meet the standard where it does not,
    transmit better, or come nearer to the poses.
    """
    target, found = evaluation.target, []
    batch = LinkageBatch.of([given.linkage]).to_canonical(target.frames)
    if np.isfinite(given.error.angle).all():
        rows = target.rows_at(given.error.places[evaluation.problem.pose_numbers])[None]
        kept = AllConstraints(target.kept) if target.kept else None
        searches = list(product([None, *_targets(given, evaluation)], STEPS))
        for number, (each, steps) in enumerate(searches, start=1):
            if not goes_on(number, len(searches), "search", has_steps=True):
                break
            if each is None:  # as near as the poses alone ask for
                refined = target.refine(
                    batch, rows, constraints=kept, steps=steps, constrained_steps=steps
                )
            else:
                sides = np.array(driving_sides(each.requirements))
                every = np.zeros(len(sides), dtype=int)
                refined = refined_on_branch(batch[every], rows[every], each, sides, steps=steps)
            found += _judged(given, refined, evaluation)
    found += bearing_linkages([given], evaluation)
    better = _better(given, found, evaluation)
    if not (better or given.usable) and time_for("looking for linkages that work"):
        searched = defect_free_linkages(batch, target, np.array([[0, 1]]))
        if searched is not None:
            better = _better(given, _judged(given, searched.refined, evaluation), evaluation)
    return better


def _judged(given: FoundLinkage, refined: Refined, evaluation: Evaluation) -> list[FoundLinkage]:
    """The linkages of a refinement that work and meet the exact poses."""
    sound = np.flatnonzero(np.isfinite(refined.rows).all(axis=(1, 2)))
    if not len(sound):
        return []
    pairs, batch, rows = [given.dyads] * len(sound), refined.batch[sound], refined.rows[sound]
    found = evaluation.members(Candidates(batch, rows, pairs, from_search=True))
    problem, exact = evaluation.problem, evaluation.task.exact
    if exact is None:
        return [each for each in found if each.usable]
    most = max(digits_leave_open(problem), EXACT_SHARE * problem.motion_size)
    length = problem.length_per_radian
    return [
        each for each in found if each.usable and (each.error.combined(length)[exact] <= most).all()
    ]


def _targets(given: FoundLinkage, evaluation: Evaluation) -> Iterator[Target]:
    """What the linkage is refined for: what the task asks, the standard, better transmission."""
    target, asked = evaluation.target, evaluation.task.requirements
    yield target
    sound = asked.with_standard()
    least = float(np.nan_to_num(given.driven.least_over_range))
    levels = [math.degrees(least) + gain for gain in TRANSMISSION_GAINS]
    for level in [sound.transmission_deg, *levels]:
        if sound.transmission_deg <= level <= MOST_TRANSMISSION:
            yield replace(target, requirements=replace(sound, transmission_deg=level))


def _better(
    given: FoundLinkage, found: Sequence[FoundLinkage], evaluation: Evaluation
) -> list[FoundLinkage]:
    """The better ones: the nearest, the nearest sound one, the closest, the best transmission."""
    problem = evaluation.problem
    open_ = digits_leave_open(problem)
    most = max(farthest_recommended(given, problem), open_) if given.usable else math.inf
    good = [
        each
        for each in found
        if each.combined_error <= most and (not given.usable or _gains(given, each, open_))
    ]
    good.sort(key=lambda each: greatest_move(given, each))
    sound = [each for each in good if not each.shortcomings] or good
    wanted = [
        *sound[:1],
        *sorted(sound, key=lambda each: max(each.combined_error, open_))[:1],
        *sorted(sound, key=lambda each: -each.driven.least_over_range)[:1],
    ]
    chosen: list[FoundLinkage] = []
    same = SAME_SHARE * problem.motion_size
    for each in wanted:
        if all(greatest_move(each, other) > same for other in chosen):
            chosen.append(each)
    chosen.sort(key=lambda each: greatest_move(given, each))
    return [one for each in chosen[:MOST_KEPT] for one in _evaluated(each, evaluation)]


def _evaluated(found: FoundLinkage, evaluation: Evaluation) -> list[FoundLinkage]:
    """A linkage with its uncertainty."""
    target = evaluation.target
    own = LinkageBatch.of([found.linkage])
    rows = target.rows_at(found.error.places)[None]
    one = Candidates(own.to_canonical(target.frames), rows, [found.dyads], True, own)
    return evaluation.evaluate(one)


def _gains(given: FoundLinkage, other: FoundLinkage, open_: float) -> bool:
    """Whether a linkage that works is better than another one that does, and in nothing worse."""
    if len(other.shortcomings) > len(given.shortcomings):
        return False
    nearer = max(other.combined_error, open_) < ERROR_GAIN * max(given.combined_error, open_)
    least, before = other.driven.least_over_range, given.driven.least_over_range
    transmits = least > before + ANGLE_GAIN
    if len(other.shortcomings) < len(given.shortcomings):
        return True
    worse = least < before - ANGLE_GAIN or other.combined_error * ERROR_GAIN > max(
        given.combined_error, open_
    )
    return (nearer or transmits) and not worse
