"""The answers of a stack of tasks at a depth, its dyads in groups that are searched together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.critical_search import COUNT
from burmester.dyads.local_minima import ManyBestDyads
from burmester.dyads.pencil import MIN_POSES, fit_pencil
from burmester.dyads.selection import (
    CIRCLE,
    FIXED_LINE,
    KINDS,
    MOVING_LINE,
    Found,
    FoundDyad,
    GivenPoses,
    same_dyads,
    within_digits,
)
from burmester.dyads.sliders import OUT_OF_SIGHT, nearly_sliders
from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PP, PR, RR, line_direction_deg
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import concatenate, take
from burmester.stacked.answers import (
    Depth,
    DyadRows,
    LinkageRows,
    Outcome,
    StackedAnswers,
    Status,
    joined,
)
from burmester.stacked.pair_linkages import USABLE, Scales, pair_linkages
from burmester.stacked.task_stack import TaskStack
from burmester.synthesis.dyad_search import (
    Searched,
    dyads_of_motion,
    dyads_of_tasks,
    exact_dyads,
    search_dyads,
    with_method,
)
from burmester.synthesis.outcome import NEAR_DIGITS, dyad_advice
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_kinds import Undetermined
from burmester.tasks.motion_task import CONDITIONS
from burmester.tasks.option_table import Method
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.plain_motions import plain_motions
from burmester.tasks.problem import SynthesisProblem

# Poses of the tasks that are computed together: bounds the memory, and fits a cache.  The ways down
# to best dyads need more room.
POSES_AT_ONCE, POSES_DOWN_AT_ONCE = 20_000, 4_000


Indices = NDArray[np.intp]
SOLVED = StackedAnswers.OUTCOMES.index("solved")
# Of the dyads of each method.
STATUS: dict[Method, Status] = {"pencil": "pencil", "exact": "exact", "complete": "locally best"}


def stacked_answers(stack: TaskStack, depth: Depth) -> StackedAnswers:
    """The dyads of many tasks, and with the depth "linkages" the pairs of them.

    A bad task changes no bit of its neighbours' answers.
    """
    count = stack.poses.shape[1]
    most = POSES_DOWN_AT_ONCE if depth != "pencil" and count > CONDITIONS else POSES_AT_ONCE
    size = max(1, most // max(1, count))
    starts = range(0, max(1, len(stack)), size)
    return joined([_answers(stack[start : start + size], depth) for start in starts])


def _answers(stack: TaskStack, depth: Depth) -> StackedAnswers:
    """The answers of tasks that are computed together."""
    outcome, code = np.zeros(len(stack), dtype=np.int8), np.full(len(stack), "", dtype="<U4")
    rows, linkages = [DyadRows.blank(0)], [LinkageRows.blank(0)]
    warnings: list[tuple[int, str]] = []
    poses, weights = stack.displacements, stack.weights
    scales = Scales.of(poses, weights) if depth == "linkages" else None
    for each in groups_of(stack, depth):
        index = each.tasks
        outcome[index], code[index] = each.outcome, each.code
        warnings += each.warnings
        table = rows_of_found(each.found, poses[index], each.status)
        rows.append(replace(table, task=index[table.task]))
        if scales is not None and each.given is not None:
            own = each.given.poses, each.given.weights, take(scales, index)
            pairs = pair_linkages(each.found, *own)
            linkages.append(replace(pairs, task=index[pairs.task]))
    dyads, made = concatenate(rows), concatenate(linkages)
    dyads = take(dyads, np.argsort(dyads.task, kind="stable"))
    made = take(made, np.argsort(made.task, kind="stable"))
    if depth == "linkages":
        count = np.bincount(made.task, minlength=len(stack))
        usable = np.bincount(made.task[made.verdict == USABLE], minlength=len(stack)) > 0
        solved = outcome == SOLVED
        code[solved] = np.where(count > 0, np.where(usable, "R300", "R301"), "R302")[solved]
        outcome[solved & ~usable] = StackedAnswers.OUTCOMES.index("none usable")
        outcome[solved & (count == 0)] = StackedAnswers.OUTCOMES.index("too few dyads")
    return StackedAnswers(
        dyads,
        made if depth == "linkages" else None,
        outcome,
        code,
        tuple(sorted(warnings, key=lambda each: each[0])),
    )


def rows_of_found(found: Found, poses: Displacement, status: NDArray[np.int8]) -> DyadRows:
    """The dyads (D,) of tasks with poses (T, N) as rows; status: (D,)."""
    rows, z, kind = DyadRows.blank(len(found.task)), found.dimensions, found.kind
    rows.task[:], rows.kind[:], rows.status[:] = found.task, kind, status
    rows.rms[:], rows.worst[:] = found.rms, found.worst
    circle, fixed, moving = (kind == each for each in (CIRCLE, FIXED_LINE, MOVING_LINE))
    rows.fixed[circle | moving] = z[circle | moving, :2]
    rows.moving[circle | fixed] = z[circle | fixed, 2:4]
    rows.length[circle] = z[circle, 4]
    angles = kind == KINDS.index(PP)
    rows.angle_deg[angles] = np.degrees(z[angles, 0])
    for of, normal, pivot in ((fixed, 0, 2), (moving, 2, 0)):
        if not len(index := np.flatnonzero(of)):
            continue
        line = PR(z[index, normal], z[index, normal + 1], z[index, pivot : pivot + 2])
        places = poses[found.task[index]]
        rows.direction_deg[index] = line_direction_deg(line.normal_angle)
        rows.normal_deg[index], rows.offset[index] = np.degrees(line.normal_angle), line.offset
        rows.point[index] = line.middle_of_travel(places.inverse() if normal else places)
    return rows


class Group(NamedTuple):
    """Tasks (V,) by their indices in a stack, rising, and their dyads (D,).

    given: the poses, each once, for which there are dyads; None where there are none.
    status: (D,), in `DyadRows.STATUSES`; outcome, code: (V,), as `StackedAnswers` has them;
    warnings: the index of a task in the stack, and a code.
    """

    tasks: Indices
    given: GivenPoses | None
    found: Found
    status: NDArray[np.int8]
    outcome: NDArray[np.int8]
    code: NDArray[np.str_]
    warnings: Sequence[tuple[int, str]]


def groups_of(stack: TaskStack, depth: Depth) -> list[Group]:
    """The tasks of a stack with their dyads, those without any left out but for their outcomes.

    Plain tasks are searched together with those that a closer look finds to be general.  Others,
    special or with repeated or exact poses, are searched one by one.
    """
    count = stack.poses.shape[1]
    method: Method = "exact" if count == CONDITIONS else "complete"
    method = "pencil" if depth == "pencil" else method
    sound, fit, values = np.flatnonzero(stack.computable), None, None
    if count < (MIN_POSES if method == "pencil" else CONDITIONS):
        sound = sound[:0]
    some = stack[sound]
    if method == "pencil" and len(sound):
        fit = fit_pencil(some.displacements, some.weights)
        values = fit.singular_values if some.weights is None else None
    nullity, groups = np.full(len(stack), -1, dtype=np.intp), []
    if len(sound):
        plain, known = plain_motions(some.displacements, stack.resolution, values)
        nullity[sound[plain]] = known[plain]
    for index in np.flatnonzero(nullity < 0).tolist():
        problem = _looked_at(stack, index, method)
        if isinstance(problem, Group):
            groups.append(problem)
        elif index in sound and not problem.is_merged and problem.options.method == method:
            nullity[index] = 0 if problem.motion is None else problem.motion.nullity
        else:
            groups.append(_searched_alone(index, problem))
    general = np.flatnonzero(nullity >= 0)
    if len(general):
        if fit is not None:
            fit = take(fit, np.searchsorted(sound, general))
        given = stack[general]
        poses, weights = given.displacements, given.weights
        length = CanonicalFrames.of(poses, weights)[0].length if fit is None else fit.frames.length
        tasks = GivenPoses(poses, weights, length, stack.resolution)
        searched = dyads_of_tasks(method, tasks, fit=fit)
        groups.append(_group(searched, method, general, nullity[general]))
    return groups


def _group(some: Searched, method: Method, tasks: Indices, nullity: Indices) -> Group:
    """Tasks that were searched together, with W204, W205, W206 and W207 of their dyads."""
    given, found, count = some.given, some.found, len(tasks)

    def any_of(rows: NDArray[np.bool_] | Indices) -> NDArray[np.bool_]:
        return np.asarray(np.bincount(found.task[rows], minlength=count) > 0)

    dyads = np.bincount(found.task, minlength=count)
    twice = np.bincount(same_dyads(found, given.length)[0], minlength=count)
    span = np.linalg.norm(np.ptp(given.poses.translation, axis=1), axis=1)
    size = np.maximum(span, given.length)[found.task]
    long = (found.kind == CIRCLE) & (found.dimensions[:, 4] > OUT_OF_SIGHT * size)
    index = np.flatnonzero(long)
    z = found.dimensions[index]
    links = RR(z[:, :2], z[:, 2:4], z[:, 4])
    near = nearly_sliders(links, given.poses[found.task[index]], size[index])
    missing = np.zeros(count, dtype=bool)
    if method == "exact":
        missing = any_of(~some.nearest & ~within_digits(found, given))
    elif isinstance(some.fit, ManyBestDyads):
        known = some.fit.search.found + some.fit.search.at_infinity
        times = np.where(known == COUNT, NEAR_DIGITS, 1.0)[found.task]
        meeting = np.bincount(found.task[within_digits(found, given, times)], minlength=count)
        expected = exact_dyads(nullity, given.poses.shape[1])
        missing = (meeting < expected) | (known < COUNT) | (some.fit.unfinished > 0)
    said = {"W204": any_of(index[near]), "W207": missing, "W206": found.left_out > 0}
    said["W205"] = twice > 0
    of, which = np.nonzero(np.stack(list(said.values()), axis=1))
    codes = [list(said)[k] for k in which.tolist()]
    none = dyads * (dyads - 1) // 2 == twice
    own, nearest = (DyadRows.STATUSES.index(each) for each in (STATUS[method], "nearest"))
    return Group(
        tasks,
        given,
        found,
        np.where(some.nearest, nearest, own).astype(np.int8),
        np.where(none, StackedAnswers.OUTCOMES.index("too few dyads"), SOLVED).astype(np.int8),
        np.where(none, "R302", ""),
        list(zip(tasks[of].tolist(), codes, strict=True)),
    )


def _looked_at(stack: TaskStack, index: int, method: Method) -> SynthesisProblem | Group:
    """One task with the method that it gets; or what came of it, if it is not to be searched."""
    try:
        task = stack.task(index)
    except InputError as error:
        return _of_one(index, ("refused", error.code))
    options = SynthesisOptions(method="pencil" if method == "pencil" else "auto")
    problem = SynthesisProblem.of(task, classify_motion(task), options)
    if problem.is_special:
        return _special(index, problem)
    if method != "pencil" and max(problem.missing_conditions) > 0:
        return _of_one(index, ("infinitely many", "R303"), _repeats(problem))
    try:
        return with_method(problem)
    except InputError as error:
        return _of_one(index, ("not at this depth", error.code), _repeats(problem))


def _special(index: int, problem: SynthesisProblem) -> Group:
    """A task whose motion itself says which dyads there are."""
    assert problem.motion is not None
    kind = problem.motion.kind
    if isinstance(kind, Undetermined):
        return _of_one(index, ("not determined", kind.code))
    dyads = dyads_of_motion(kind, problem.given)
    given = GivenPoses.of(problem.merged().task, problem.length) if len(dyads) > 1 else None
    status: Status = "of the motion"
    told: tuple[Outcome, str] = ("special motion", kind.code)
    return _of_one(index, told, (), dyads, statuses=[status] * len(dyads), given=given)


def _searched_alone(index: int, problem: SynthesisProblem) -> Group:
    """A task with dyads of its own method, or of poses of its own."""
    found = search_dyads(problem)
    pairs, twice = found.pairs(problem.length)
    advice = [each.code for each in dyad_advice(problem, found)] + ["W205"] * len(twice)
    statuses: list[Status] = [STATUS[problem.options.method]] * found.meeting
    statuses += ["nearest"] * (len(found.dyads) - found.meeting)
    told: tuple[Outcome, str] = ("solved", "") if pairs else ("too few dyads", "R302")
    warnings = [*_repeats(problem), *dict.fromkeys(advice)]
    given = GivenPoses.of(problem.task, problem.length)
    return _of_one(index, told, warnings, found.dyads, statuses=statuses, given=given)


def _repeats(problem: SynthesisProblem) -> list[str]:
    return ["W208"] if problem.is_merged else []


def _of_one(
    index: int,
    told: tuple[Outcome, str],
    warnings: Sequence[str] = (),
    dyads: Sequence[FoundDyad] = (),
    *,
    statuses: Sequence[Status] = (),
    given: GivenPoses | None = None,
) -> Group:
    """What came of one task; told: the outcome and its code."""
    return Group(
        np.array([index]),
        given,
        Found.of(dyads),
        np.array([DyadRows.STATUSES.index(each) for each in statuses], dtype=np.int8),
        np.array([StackedAnswers.OUTCOMES.index(told[0])], dtype=np.int8),
        np.array([told[1]]),
        [(index, each) for each in warnings],
    )
