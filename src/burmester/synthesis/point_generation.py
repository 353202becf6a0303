"""From poses and points to linkages: a task that leaves the angle free at some of its poses.

Where poses, points and pivots at points leave finitely many four-bars (`point_conditions`), all of
them are found (Alt-Burmester).  Each is judged at its own angles.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import Advice
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation, at_given_poses, with_own_dyads
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import where
from burmester.points.point_sets import MOST_MET, PointSet, point_set
from burmester.points.real_linkages import PointLinkages, linkages_through
from burmester.progress import step
from burmester.synthesis.outcome import linkage_advice
from burmester.synthesis.point_conditions import PointConditions, point_conditions, special_curve
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.motion_task import Task, characteristic_length
from burmester.tasks.notation import length_of
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import in_short
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.limit_check import limit_violations
from burmester.verdicts.ranking import ranked
from burmester.wording import count


def through_points(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis | None:
    """All four-bars through poses and points; None where they are not finitely many.

    None as well for points of which a line or a circle holds too many: they are missed.
    """
    task, asked = problem.given, point_conditions(problem.given)
    if asked is None or asked.case is None:
        return None
    if (crossed := special_curve(task)) is not None:
        if asked.is_point.all():
            return None
        return Synthesis(problem, none_on_curve(crossed, task), warnings=tuple(findings))
    points = task.poses.translation[asked.is_point]
    special = None if len(asked.pivots) else point_set(points, task.resolution[0])
    found = linkages_through(task.poses, asked.is_point, asked.pivots)
    linkages = _judged(problem, found, asked) if len(found.batch) else ()
    dyads = tuple(dyad for each in linkages for dyad in each.dyads)
    outcome = _outcome(task, asked, found, linkages)
    warnings = [*findings]
    if special is not None:
        warnings.append(_of_special_points(special))
    elif found.lost:
        warnings.append(_lost(found))
    warnings += linkage_advice(task, linkages, outcome.code)
    return Synthesis(problem, outcome, dyads, linkages, tuple(warnings), points=found)


def _judged(
    problem: SynthesisProblem, found: PointLinkages, asked: PointConditions
) -> tuple[FoundLinkage, ...]:
    """The linkages with errors, verdicts and quality at their own places, ranked."""
    target = target_of(problem)
    evaluation = Evaluation(problem, target)
    step(f"judging {count(len(found.batch), 'linkage')}")
    own, places = _in_order_of_limits(found.batch, asked, problem), found.places
    rows = target.rows_at(Displacement(places[..., :2], places[..., 2]))
    batch = own.to_canonical(target.frames)
    candidates = Candidates.of_own_dyads(batch, rows, own, from_search=False)
    members = ranked(evaluation.members(candidates), problem)
    if problem.options.rounds:
        members = evaluation.rounded(members)
    return at_given_poses(with_own_dyads(evaluation.with_spreads(members)), problem)


def _in_order_of_limits(
    batch: LinkageBatch, asked: PointConditions, problem: SynthesisProblem
) -> LinkageBatch:
    """The linkages with their dyads in the order of two limits, where there are two."""
    limits, size = problem.given.limits, problem.motion_size
    if len(limits) < 2:
        return batch
    other = batch.exchanged()
    if len(asked.pivots):
        return other if asked.later else batch

    def broken(of: LinkageBatch) -> list[int]:
        return [len(limit_violations(of.linkage(k), limits, size)) for k in range(len(of))]

    exchanges = np.array(broken(batch)) > np.array(broken(other))
    return where(exchanges, other, batch)


def _outcome(
    task: Task,
    asked: PointConditions,
    found: PointLinkages,
    linkages: Sequence[FoundLinkage],
) -> Outcome:
    """What came of poses and points."""
    usable = [each for each in linkages if each.usable]
    each = "classes of three cognates" if asked.has_cognates else "linkages"
    why = f"of {found.found:,} {each}, complex ones too, {found.real} are real"
    if found.found < found.classes:
        why = (
            f"of {found.classes:,} {each}, complex ones too, {found.found:,} were found, and "
            f"{found.real} of these are real"
        )
    if not linkages:
        return Outcome(
            "R342",
            f"no linkage: no real four-bar was found through {asked}"
            if found.found < found.classes
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


def is_traced_by_crank(special: PointSet | None, task: Task) -> bool:
    """Whether a crank alone traces all points, and no limit asks for something else."""
    circle = special is not None and special.kind == "circle" and bool(special.on.all())
    return circle and not task.limits


def none_on_curve(special: PointSet, task: Task) -> Outcome:
    """What comes of positions of which a line or a circle holds more than a coupler curve meets."""
    number = task.poses.shape[0]
    where = f"{_how_many(special)} {_rows(task)} lie on a {special.kind}"
    if not is_traced_by_crank(special, task):
        return Outcome(
            "R342",
            f"no linkage: {where}, which a coupler curve meets in {MOST_MET} points at most",
            f"move {number - MOST_MET} of them off the {special.kind}, or leave them out",
            _exceptions(special),
        )
    assert special.centre is not None
    centre = np.round(special.centre / special.radius, 6) * special.radius
    x, y = (length_of(float(each) + 0.0, task) for each in centre)
    crank = f"a crank about ({x}, {y}) with the length {length_of(special.radius, task)}"
    turned = "whatever else the linkage is"
    help: str = Help.of(
        "use a crank alone; where its pivot may not be there, say where pivots may lie ({}), and "
        "linkages near the points are looked for",
        Cure("fixed_pivot"),
    )
    if not task.angles_are_free:
        turned = "and any second dyad through the poses turns the body"
        help = "give the poses alone, and limit one dyad to this crank"
    return Outcome(
        "R343",
        f"infinitely many linkages: {where}",
        help,
        f"{crank} traces it, {turned}",
    )


def missed_on_curve(special: PointSet, task: Task) -> Advice:
    """W222, for points of which a line or a circle holds more than a coupler curve meets."""
    if special.kind == "circle" and special.on.all():
        cure = "use a crank alone, if its pivot may be at the middle of the circle"
    elif special.kind == "line":
        cure = "use a slider where the line has to be met"
    else:
        cure = "move points off the circle where they have to be met"
    return Advice(
        "W222",
        f"{_how_many(special)} {_rows(task)} lie on a {special.kind}, which a coupler curve "
        f"meets in {MOST_MET} points at most: the linkages only come near them",
        cure,
        _exceptions(special),
    )


def _how_many(special: PointSet) -> str:
    """Of how many positions it is said: "all 9", "8 of the 9"."""
    on, number = int(special.on.sum()), len(special.on)
    return f"all {number}" if on == number else f"{on} of the {number}"


def _rows(task: Task) -> str:
    return "points" if task.angles_are_free else "positions"


def _exceptions(special: PointSet) -> str | None:
    """Which curves hold a circle; none holds a line."""
    if special.kind == "line":
        return None
    return (
        "only the curves of a crank's own pin, of parallelograms and of kites hold a circle, and "
        "what else these pass is beyond a change point"
    )


def _of_special_points(special: PointSet) -> Advice:
    """W222, for points on one curve: some linkages are at infinity, or in families."""
    curve = {"line": "a line", "circle": "a circle", "conic": "an ellipse or another conic"}
    return Advice(
        "W222",
        f"{_how_many(special)} points lie on {curve[special.kind]}: fewer linkages than for points "
        "in general position, and perhaps infinitely many beside those that are listed",
        "move one point a little where others are wanted",
    )


def _lost(found: PointLinkages) -> Advice:
    """W223, for linkages that were not found."""
    reached = (
        f"points in general position have {found.classes:,}, counted with complex ones; "
        f"{found.found:,} were reached from {count(found.systems, 'solved problem')}"
    )
    if found.family:
        return Advice(
            "W223",
            f"{found.lost} of {found.classes:,} solutions were not found: some are no single "
            "linkages but families of infinitely many, and none of a family is listed",
            "leave out a point: good linkages are then chosen from infinitely many; or move one "
            "a little",
            f"{reached}; points that are symmetric, or of which two are one, leave families",
        )
    return Advice(
        "W223",
        f"{found.lost} of {found.classes:,} solutions were not found; a real linkage may be among "
        "them",
        "move a point a little, and compare",
        reached,
    )
