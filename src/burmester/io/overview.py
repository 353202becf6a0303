"""A task before synthesis: its poses as read, its motion class, and the findings of the checks.

For people (`show`) and as an object ready for JSON (`check_data`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from rich.console import Console

from burmester.describe import generator_words
from burmester.diagnosis.checks import Diagnosis
from burmester.diagnosis.pair_checks import reversals
from burmester.errors import Advice
from burmester.io.function_result import function_task_data
from burmester.io.linkage_table import show_read
from burmester.io.message import show as show_message
from burmester.io.result import motion_data, task_data
from burmester.synthesis.point_conditions import point_conditions
from burmester.tasks.crank_timing import CrankTiming
from burmester.tasks.function_task import FunctionTask
from burmester.tasks.motion_kinds import General
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.traced_path import LEAST_TIMED, TracedPath
from burmester.wording import count as count_of
from burmester.wording import figure

EXPECT = {  # of a general motion, by the number of independent quadrics that hold the poses
    0: "no linkage passes all poses exactly; the nearest ones are looked for",
    1: "one link at most meets all poses exactly, so no linkage does; the nearest are looked for",
    2: "one linkage at most passes all poses exactly",
    3: "four links at most meet all poses exactly, so six linkages at most do",
}
SCHEMA, FUNCTION_SCHEMA = "burmester.check/1", "burmester.function-check/1"
LEAST_CLOSED = 6  # points of a path that may be closed
NEAR_ENDS = 1.5  # steps between neighbours; ends of a path that are nearer nearly meet


def check_data(diagnosis: Diagnosis) -> dict[str, Any]:
    """What `burmester check --json` prints."""
    motion = diagnosis.motion
    return {
        "schema": SCHEMA,
        "task": task_data(diagnosis.task),
        "read_as": diagnosis.task.read_as,
        "motion": None if motion is None else motion_data(motion),
        "singular_values": None if motion is None else motion.singular_values.tolist(),
        "warnings": [each.to_dict() for each in (*diagnosis.task.notes, *diagnosis.findings)],
    }


def show(diagnosis: Diagnosis, console: Console, *, verbose: bool = False) -> None:
    """The poses as they were read, what they are, and what stands out.

    verbose: also what a mathematician would ask, the quadrics that hold them.
    """
    task = diagnosis.task
    # Free angles say nothing of a motion.
    turns = task.path is None and point_conditions(task) is None
    motion = diagnosis.motion if turns else None
    show_read(_columns(task), _facts(diagnosis, verbose), (), console)
    if motion is not None and not isinstance(motion.kind, General):
        console.print()
        show_message("result", motion.kind, console)
    for each in (*task.notes, *diagnosis.findings):
        console.print()
        show_message("warning", each, console)


def _columns(task: Task) -> dict[str, list[str]]:
    """The poses by columns, angles in degrees whatever the file has."""
    count, unit = task.poses.shape[0], f" [{task.length_unit}]" if task.length_unit else ""
    columns: dict[str, list[str]] = {"pose": [str(i + 1) for i in range(count)]}
    if task.names is not None:
        columns["name"] = list(task.names)
    x, y = task.poses.translation.T
    values = {f"x{unit}": x, f"y{unit}": y}
    if task.path is None:
        values["angle [°]"] = np.degrees(task.poses.angle)
    elif task.path.crank_angles is not None:
        values["crank [°]"] = np.degrees(task.path.crank_angles)
    if task.timing is not None:
        values["crank [°]"] = np.degrees(task.timing.angles)
    for head, column in values.items():
        columns[head] = ["" if math.isnan(value) else f"{value:.10g}" for value in column]
    if task.weights is not None:
        columns["weight"] = [f"{value:g}" for value in task.weights]
    if task.tolerances is not None and (task.path is None or task.tolerances.gives_room):
        _add_tolerances(columns, task.tolerances, unit)
    if task.exact is not None:
        columns["exact"] = ["yes" if mark else "" for mark in task.exact]
    return columns


def _add_tolerances(columns: dict[str, list[str]], tolerances: PoseTolerances, unit: str) -> None:
    """Put `free` in place of the values that do not count, and add columns of tolerances."""
    free, bounds = tolerances.free, tolerances.bounds * [1.0, 1.0, 180 / math.pi]
    for k, (name, of) in enumerate((("x", unit), ("y", unit), ("angle", " [°]"))):
        head = f"{name}{of}"
        if head not in columns:  # of a path
            continue
        shown = zip(columns[head], free[:, k], strict=True)
        columns[head] = ["free" if mark else value for value, mark in shown]
        columns[f"tol. {head}"] = [
            f"{bound:.6g}" if math.isfinite(bound) else "free" for bound in bounds[:, k].tolist()
        ]
    if "body" in tolerances.axes:
        columns["along"] = [{"fixed": "F", "body": "the body"}[each] for each in tolerances.axes]


def _facts(diagnosis: Diagnosis, verbose: bool) -> Iterator[tuple[str, str]]:
    """The facts about the poses as a whole, each with its name."""
    task = diagnosis.task
    motion = diagnosis.motion if task.path is None else None
    unit = f" {task.length_unit}" if task.length_unit else ""
    width, height = np.ptp(task.poses.translation, axis=0)
    length, angle = task.resolution
    size = " by ".join(f"{each:.4g}" if each < 1e4 else figure(each) for each in (width, height))
    if task.read_as:
        yield "read", task.read_as
    yield "extent", f"{size}{unit or ', no unit stated'}"
    if task.path is not None:
        yield "path", _path(task, task.path)
    points = point_conditions(task)
    if motion is not None and points is None:
        yield "rotation", f"{math.degrees(motion.rotation):.4g}°"
    if length or angle:
        positions = f"positions to ±{figure(length)}{unit}" if length else "positions are exact"
        angles = f", angles to ±{figure(math.degrees(angle))}°" if angle else ", angles are exact"
        yield "accuracy", f"{positions}{'' if task.angles_are_free else angles}"
    else:
        yield "accuracy", "taken as exact, unless --pose-sigma says otherwise"
    if task.timing is not None:
        yield "crank", _crank(task.timing)
    if task.path is not None:
        yield "asks", _asked_of_path(task, task.path)
    elif points is not None:
        yield "asks", points.in_words()
    elif motion is not None:
        general = isinstance(motion.kind, General)
        if general:
            few = f"infinitely many linkages pass {count_of(task.poses.shape[0], 'pose')}"
            yield "expect", EXPECT.get(motion.nullity, f"{few}; the best are looked for")
        if verbose or not general:
            yield "motion", motion.kind.message if general else motion.kind.name
        if not verbose:
            return
        quadrics = {0: "no quadric holds", 1: "1 quadric holds"}.get(
            motion.nullity, f"{motion.nullity} independent quadrics hold"
        )
        yield "rank", f"{8 - motion.nullity} of 8: {quadrics} all poses in image space"


def _crank(timing: CrankTiming) -> str:
    """What the angles of the crank say."""
    number = len(timing.timed)
    how = "as directions on the ground" if timing.absolute else "counted from the first of them"
    sense = {1: ", counterclockwise", -1: ", clockwise", 0: ""}[timing.sense]
    within = f"; each within {figure(math.degrees(timing.bound))}°" if timing.within else ""
    many = f"{count_of(number, 'pose')} {'is' if number == 1 else 'are'} timed"
    return f"{many} by the crank, its angles {how}{sense}{within}"


def _path(task: Task, path: TracedPath) -> str:
    """How a path is traced; of an open one whose ends meet nearly, how it is closed."""
    turned, points = path.crank_angles, task.poses.translation
    timed = (
        ""
        if turned is None
        else f", timed by a crank that turns {math.degrees(float(np.ptp(turned))):.4g}°"
    )
    if path.closed:
        return f"closed{timed}"
    gap = float(np.hypot(*(points[-1] - points[0])))
    step = float(np.median(np.hypot(*np.diff(points, axis=0).T)))
    if not 0 < gap <= NEAR_ENDS * step or len(points) < LEAST_CLOSED:
        return f"open{timed}"
    return (
        f"open{timed}; its ends are {length_of(gap, task)} apart, about as neighbours are: "
        "--closed leads back to the first point"
    )


def _asked_of_path(task: Task, path: TracedPath) -> str:
    """What is looked for, and what is assumed."""
    points = count_of(task.poses.shape[0], "point")
    if path.crank_angles is not None and task.poses.shape[0] == LEAST_TIMED:
        return f"the four-bars through {points} at their crank angles"
    near = f"four-bars near {points}" + ("" if path.crank_angles is None else ", timed")
    stated = task.requirements.within is not None or task.gives_room
    return near + (", within a tolerance" if stated else "; no tolerance is stated: one is assumed")


# --- pairs of angles


def function_check_data(task: FunctionTask, findings: tuple[Advice, ...]) -> dict[str, Any]:
    """What `burmester check --json` prints of a function task."""
    low, high = task.input_ends
    pairs, needed = len(task.inputs), task.exact_count
    return {
        "schema": FUNCTION_SCHEMA,
        "task": function_task_data(task),
        "asks": {
            "pairs": pairs,
            "open_phases": task.free_phases,
            "kind": "phases" if pairs < needed else "exact" if pairs == needed else "nearest",
            "solutions": task.solutions,
        },
        "input_range_deg": math.degrees(high - low),
        "output_range_deg": math.degrees(task.output_span),
        "reversals": reversals(*task.compared()),
        "warnings": [each.to_dict() for each in findings],
    }


def show_function_check(task: FunctionTask, findings: tuple[Advice, ...], console: Console) -> None:
    """The pairs as they were read, what is asked, and what stands out."""
    columns = {
        "pair": [str(k + 1) for k in range(len(task.inputs))],
        "input [°]": [f"{each:.10g}" for each in np.degrees(task.inputs).tolist()],
        "output [°]": [f"{each:.10g}" for each in np.degrees(task.outputs).tolist()],
    }
    if task.weights is not None:
        columns["weight"] = [f"{each:g}" for each in task.weights.tolist()]
    show_read(columns, generator_words.facts(task), findings, console)
