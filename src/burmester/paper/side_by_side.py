"""The paper's two tasks by five methods, side by side.

The paper holds its method against three others on poses that it does not print; here they are held
against one another, and against the complete method, on the poses that it does print.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, final

from burmester.io.cases import load
from burmester.paper.five_methods import Answer, by_every_method
from burmester.progress import step
from burmester.tasks.motion_task import Task


@final
@dataclass(frozen=True, slots=True, eq=False)
class SideBySide:
    """What five methods make of one of the paper's tasks."""

    title: str
    case: str
    answers: tuple[Answer, ...]


def side_by_side(starts: int = 100, seed: int = 2012) -> tuple[SideBySide, ...]:
    """The paper's two tasks by five methods; the same seed gives the same starts."""
    tasks = {"Table 2 (pose 6 at 52.87 deg)": "ge2012-exact", "Table 5": "ge2012-approximate"}
    result = []
    for title, case in tasks.items():
        step(f"solving {title} by every method")
        poses = Task.from_rows(load(case)["poses"], angle_unit="deg").poses
        result.append(SideBySide(title, case, by_every_method(poses, starts, seed)))
    return tuple(result)


def side_by_side_data(task: SideBySide) -> dict[str, Any]:
    """One task as plain data."""
    answers = [_answer_data(answer) for answer in task.answers]
    return {"title": task.title, "case": task.case, "answers": answers}


def _answer_data(answer: Answer) -> dict[str, Any]:
    dyads = [
        {
            "fixed_pivot": answer.dyads.fixed_pivot[k].tolist(),
            "moving_pivot": answer.dyads.moving_pivot[k].tolist(),
            "radius": float(answer.dyads.radius[k]),
            "rms_error": float(answer.rms_error[k]),
            "max_error": float(answer.max_error[k]),
        }
        for k in range(len(answer.rms_error))
    ]
    needed = answer.needed
    return {
        "method": answer.method,
        "dyads": dyads,
        "starts": answer.starts,
        "settled": answer.settled,
        "reached": answer.reached,
        "starts_needed": needed if needed is not None and math.isfinite(needed) else None,
        "seconds_on_this_machine": answer.seconds,
    }
