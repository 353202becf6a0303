"""What an answer is worth: said by the tracer, for every tool alike."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask
from benchmarks.field.tracer import trace

COUNTED = 50  # of a tool's answers, from the first on
ALIKE = 0.01  # of the span (and of how far a pivot is away): two dyads that are one


def scores(task: FieldTask, answers: Sequence[FourBar]) -> dict[str, Any]:
    """The scores of a tool's answers to a task.

    solved, solved_first: whether one of the answers, or the first of them, meets every pose within
    the tolerance, on one branch and in order, and has its ground pivots where they may be; for a
    path, whether the curve follows it between the points as well.
    best_error: the least greatest error, in spans, of an answer whose pivots are right; None if
    none comes near.  one_branch, anywhere: the same without the order, and without the branch.
    known_found: how many of the known linkages are among the answers.
    meets_points, for a path: how many of the answers meet its points, whatever is between them.
    """
    counted = list(answers)[:COUNTED]
    traces = [trace(answer, task) for answer in counted]
    allowed = [_in_place(task, answer) for answer in counted]
    met = [
        good and each.in_order <= task.tolerance for each, good in zip(traces, allowed, strict=True)
    ]
    solved = met
    if task.is_path:
        solved = [both and each.follows for each, both in zip(traces, met, strict=True)]
    kept = [each for each, good in zip(traces, allowed, strict=True) if good]
    found = sum(any(_same(task, known, answer) for answer in counted) for known in task.known)
    return {
        "answers": len(answers),
        "solved": any(solved),
        "solved_first": bool(solved) and solved[0],
        "solving": sum(solved),
        "best_error": _least([each.in_order for each in kept]),
        "one_branch": _least([each.one_branch for each in kept]),
        "anywhere": _least([each.anywhere for each in kept]),
        "known": len(task.known),
        "known_found": found,
        **({"meets_points": sum(met)} if task.is_path else {}),
    }


def _least(errors: list[float]) -> float | None:
    least = min(errors, default=np.inf)
    return float(f"{least:.3e}") if np.isfinite(least) else None


def _in_place(task: FieldTask, answer: FourBar) -> bool:
    """Whether the ground pivots are where the task wants them, within its tolerance."""
    if task.pivots is None:
        return True
    pivots = [answer.first.ground_pivot, answer.second.ground_pivot]
    room = task.tolerance * task.span
    if any(pivot is None or task.pivots.off(pivot) > room for pivot in pivots):
        return False
    if task.pivots.kind != "points":
        return True
    return all(min(abs(pivot - place) for pivot in pivots) <= room for place in task.pivots.places)


def _same(task: FieldTask, known: FourBar, answer: FourBar) -> bool:
    a, b = known.first, known.second
    pairs = ((answer.first, answer.second), (answer.second, answer.first))
    return any(_alike(task, a, c) and _alike(task, b, d) for c, d in pairs)


def _alike(task: FieldTask, a: Dyad, b: Dyad) -> bool:
    if a.kind != b.kind:
        return False
    middle = task.places.mean()
    far = task.span + max(abs(a.fixed - middle) if a.kind != "PR" else 0.0, abs(a.moving))
    near = ALIKE * far
    if a.kind == "RR":
        return abs(a.fixed - b.fixed) < near and abs(a.moving - b.moving) < near
    normal, other = np.exp(1j * a.normal), np.exp(1j * b.normal)
    side = 1.0 if (normal * np.conj(other)).real > 0 else -1.0  # a line has two normals
    line = abs(normal - side * other) < ALIKE
    # A line is compared where the body is: its offset there, not far away.
    shift = (np.conj(normal - side * other) * middle).real if a.kind == "PR" else 0.0
    line = line and abs(a.size - side * b.size - shift) < near
    pin = a.moving - b.moving if a.kind == "PR" else a.fixed - b.fixed
    return bool(line and abs(pin) < near)
