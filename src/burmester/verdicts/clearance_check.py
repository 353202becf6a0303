"""The clearance of a linkage between its poses, and the violation where it is too small."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from burmester.errors import Finding
from burmester.fourbar.defects import Verdict
from burmester.fourbar.linkage import Linkage
from burmester.tasks.notation import length_of, poses_in_words
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import Side, with_driver_first
from burmester.wording import figure

if TYPE_CHECKING:
    from burmester.clearance.least_clearance import Clearance


def clearance_of(
    linkage: Linkage, verdict: Verdict, driver: Side, problem: SynthesisProblem
) -> Clearance | None:
    """The least clearance of a linkage with its driver; its poses are those of the task as given.

    None without surroundings, and for a linkage that does not come from pose to pose.
    """
    task = problem.task
    driven = verdict.first if driver == "first" else verdict.second
    if task.surroundings is None or verdict.defects or driven.defects:
        return None
    # Shapely is imported for tasks with surroundings only.
    from burmester.clearance.least_clearance import clearance_between_poses  # noqa: PLC0415

    led = with_driver_first(linkage, driver)
    clearance = clearance_between_poses(led, driven, task.body, task.surroundings)
    if clearance is None:
        return None
    one, two = (problem.pose_numbers[k] for k in clearance.poses)
    return replace(clearance, poses=(min(one, two), max(one, two)))


def too_close(clearance: Clearance | None, problem: SynthesisProblem) -> tuple[Finding, ...]:
    """The violation where something touches, or comes nearer than the margin; else none."""
    around = problem.task.surroundings
    if clearance is None or around is None:
        return ()
    if clearance.least > 0 and clearance.least >= around.margin:
        return ()
    return (Finding("clearance", clearance_in_words(clearance, problem)),)


def clearance_in_words(clearance: Clearance, problem: SynthesisProblem) -> str:
    """What comes nearest to what, where: "the body touches 'bumper' between poses 1 and 2, ..."."""
    task = problem.given
    one, two = clearance.poses
    when = f"at {poses_in_words(task, [one])}"
    if one != two:
        when = f"between {poses_in_words(task, [one, two])}"
    x, y = (figure(float(value)) for value in clearance.place.translation)
    turned = figure(round(math.degrees(float(clearance.place.angle)), 3))
    where = f"{when}, with the body at ({x}, {y}) and {turned}°"
    if clearance.touches:
        return f"{clearance.part} touches {clearance.obstacle} {where}"
    near = length_of(clearance.least, task)
    text = f"{clearance.part} comes within {near} of {clearance.obstacle} {where}"
    margin = 0.0 if task.surroundings is None else task.surroundings.margin
    if clearance.least < margin:
        text += f"; a margin of {length_of(margin, task)} is asked for"
    return text
