"""From poses and points to linkages: a task that leaves the angle free at some of its poses.

A pose that is exact in x and y and free in its angle is a point of the body.  With M poses and N
points, 2 (M - 1) + N = 8, or with nine points, there are finitely many four-bars, and all are found
(Alt-Burmester).  Each is judged at its own angles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import FoundDyad
from burmester.errors import Advice
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation, at_given_poses
from burmester.linkages.from_dyads import target_of
from burmester.points.point_sets import PointSet, point_set
from burmester.points.real_linkages import PointLinkages, linkages_through
from burmester.points.start_systems import CASES, Case
from burmester.progress import step
from burmester.synthesis.outcome import linkage_advice
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.motion_task import Task, characteristic_length
from burmester.tasks.notation import length_of
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import in_short
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.verdicts.ranking import ranked
from burmester.wording import count

__all__ = ["in_words", "points_of", "through_points"]

CONDITIONS = 8  # of a four-bar beyond its first position: a pose is two, a point one
POINTS = 9  # a four-bar traces at most so many


def points_of(task: Task) -> NDArray[np.bool_] | None:
    """Which poses of a task (N,) are points of the body; None where it has other tolerances.

    None too where no pose is a point.
    """
    stated = task.tolerances
    if stated is None or not stated.exact[:, :2].all():
        return None
    is_point = stated.free[:, 2]
    others = stated.exact[:, 2]
    return is_point if is_point.any() and (is_point | others).all() else None


def is_determined(is_point: NDArray[np.bool_]) -> bool:
    """Whether finitely many linkages meet poses and points (N,) in general position."""
    poses, points = int((~is_point).sum()), int(is_point.sum())
    return points == POINTS if not poses else 2 * (poses - 1) + points == CONDITIONS


def in_words(is_point: NDArray[np.bool_]) -> str:
    """How many linkages poses and points (N,) leave, for those who look at a task."""
    asked = _asked(is_point)
    if not is_determined(is_point):
        return f"{asked}: infinitely many four-bars, of which good ones are chosen"
    poses, points = int((~is_point).sum()), int(is_point.sum())
    case = Case(poses, points) if poses else Case(1, points - 1)
    number, also = CASES[case], ""
    if case.poses == 1:
        number, also = 3 * number, " with cognates"
    return f"{asked}: {number:,} four-bars{also}, complex ones counted"


def through_points(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis | None:
    """All four-bars through poses and points; None where they are not finitely many."""
    is_point = points_of(problem.given)
    if is_point is None or not is_determined(is_point):
        return None
    task = problem.given
    special = point_set(task.poses.translation[is_point])
    if special is not None and is_point.all() and special.kind != "conic":
        return Synthesis(problem, _on_a_curve(special, task), warnings=tuple(findings))
    found = linkages_through(task.poses, is_point)
    linkages = _judged(problem, found) if len(found.batch) else ()
    dyads = tuple(dyad for each in linkages for dyad in each.dyads)
    outcome = _outcome(task, is_point, found, linkages)
    warnings = [*findings]
    if special is not None:
        warnings.append(_of_special_points(special, task))
    elif found.lost:
        warnings.append(_lost(found))
    warnings += linkage_advice(task, linkages, outcome.code)
    return Synthesis(problem, outcome, dyads, linkages, tuple(warnings), points=found)


def _judged(problem: SynthesisProblem, found: PointLinkages) -> tuple[FoundLinkage, ...]:
    """The linkages with errors, verdicts and quality at their own places, ranked."""
    target = target_of(problem)
    evaluation = Evaluation(problem, target)
    step(f"judging {count(len(found.batch), 'linkage')}")
    own, places = found.batch, found.places
    rows = target.rows_at(Displacement(places[..., :2], places[..., 2]))
    pairs = [_numbered(own.linkage(k), 2 * k + 1) for k in range(len(own))]
    searched = np.zeros(len(own), dtype=bool)
    candidates = Candidates(own.to_canonical(target.frames), rows, pairs, searched, own)
    members = ranked(evaluation.members(candidates), problem)
    if problem.options.rounds:
        members = evaluation.rounded(members)
    members = [
        replace(each, id=f"L{rank}", rank=rank, dyads=_renumbered(each.dyads, 2 * rank - 1))
        for rank, each in enumerate(evaluation.with_spreads(members), start=1)
    ]
    return at_given_poses(members, problem)


def _numbered(linkage: Linkage, number: int) -> Pair:
    """The dyads of a linkage, numbered from `number`; their errors follow."""
    return (
        FoundDyad(f"D{number}", linkage.first, 0.0, 0.0),
        FoundDyad(f"D{number + 1}", linkage.second, 0.0, 0.0),
    )


def _renumbered(dyads: Pair, number: int) -> Pair:
    """The dyads of a ranked linkage, numbered from `number`."""
    first, second = dyads
    return replace(first, id=f"D{number}"), replace(second, id=f"D{number + 1}")


def _asked(is_point: NDArray[np.bool_]) -> str:
    """What a task asks for: "3 poses and 4 points"."""
    poses, points = int((~is_point).sum()), int(is_point.sum())
    return f"{count(poses, 'pose')} and {count(points, 'point')}" if poses else f"{points} points"


def _outcome(
    task: Task,
    is_point: NDArray[np.bool_],
    found: PointLinkages,
    linkages: Sequence[FoundLinkage],
) -> Outcome:
    """What came of poses and points."""
    asked, usable = _asked(is_point), [each for each in linkages if each.usable]
    alone = int((~is_point).sum()) < 2
    each = "classes of three cognates" if alone else "linkages"
    why = f"of {found.found:,} {each}, complex ones too, {found.real} are real"
    if not linkages:
        return Outcome(
            "R342",
            f"no linkage: no real four-bar was found through {asked}"
            if found.lost
            else f"no linkage: {asked} have no real four-bar",
            "move a point, or give fewer: then linkages are chosen from a family",
            why,
        )
    if not usable:
        nearest = linkages[0]
        return Outcome(
            "R341",
            f"no usable linkage: {count(len(linkages), 'four-bar')} through {asked}, and none "
            "works",
            "move a point, or give fewer: then linkages are chosen from a family",
            f"{why}; the first of them, {nearest.id}, "
            + in_short(nearest, task, characteristic_length(task)),
        )
    works = f"{len(usable)} of {count(len(linkages), 'four-bar')} through {asked} work"
    return Outcome("R340", works + "s" * (len(usable) == 1), why=why)


def _on_a_curve(special: PointSet, task: Task) -> Outcome:
    """Points on a line, or on a circle."""
    if special.kind == "line":
        return Outcome(
            "R343",
            f"no linkage: all {task.poses.shape[0]} points lie on a line, and no four-bar traces "
            "so many points of a line",
            "give fewer points of the line, move some off it by what is allowed, or use a slider",
        )
    assert special.centre is not None
    centre = np.round(special.centre / special.radius, 6) * special.radius
    x, y = (length_of(float(each) + 0.0, task) for each in centre)
    return Outcome(
        "R343",
        f"infinitely many linkages: all {task.poses.shape[0]} points lie on a circle",
        "use a crank alone, or give poses, which say how the body turns",
        f"a crank about ({x}, {y}) with the length {length_of(special.radius, task)} traces it, "
        "whatever else the linkage is",
    )


def _of_special_points(special: PointSet, task: Task) -> Advice:
    """W222, for points on one curve: some linkages are at infinity, or in families."""
    curve = {"line": "a line", "circle": "a circle", "conic": "an ellipse or another conic"}
    return Advice(
        "W222",
        f"the points lie on {curve[special.kind]}: fewer linkages than for points in general "
        "position, and perhaps infinitely many beside those that are listed",
        "move one point a little where others are wanted",
    )


def _lost(found: PointLinkages) -> Advice:
    """W223, for linkages that were not found."""
    return Advice(
        "W223",
        f"{found.lost} of {found.classes:,} solutions were not found; a real linkage may be among "
        "them",
        "move a point a little, and compare",
        f"points in general position have {found.classes:,}, counted with complex ones; "
        f"{found.found:,} were reached from {count(found.systems, 'solved problem')}",
    )
