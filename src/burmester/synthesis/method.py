"""Which method a task gets."""

from __future__ import annotations

from dataclasses import replace

from burmester.errors import InputError
from burmester.tasks.motion_task import CONDITIONS
from burmester.tasks.options import Method
from burmester.tasks.problem import SynthesisProblem

__all__ = ["with_method"]


def with_method(problem: SynthesisProblem) -> SynthesisProblem:
    """The problem with the method that it gets; raises E121 and E123 where that cannot be."""
    options, task = problem.options, problem.task
    method = _chosen(problem)
    if method != "pencil" and not options.normalise:
        raise InputError(
            "E123",
            f"only the pencil can be fitted raw, not the {method} method",
            help="leave --raw out, or use --method pencil",
        )
    conditions = {
        "limits": bool(task.limits),
        "exact poses": task.exact is not None and bool(task.exact.any()),
        "the least worst distance": options.norm != "rms",
    }
    first = next((name for name, given in conditions.items() if given), None)
    if method == "pencil" and first is not None:
        raise InputError(
            "E123",
            f"the pencil knows nothing of {first}",
            why="it fits one pencil of quadrics to all poses alike",
            help="use --method complete",
        )
    if options.certify and (first is not None or method == "pencil"):
        raise InputError(
            "E123",
            "certificates exist only for tasks without limits, or for five poses",
            why="the pencil's dyads are not the best ones"
            if first is None
            else f"this task has {first}",
            help="leave --certify out" + ("" if first is None else ", or what it has"),
        )
    _require_poses(problem, method)
    return replace(problem, options=replace(options, method=method))


def _chosen(problem: SynthesisProblem) -> Method:
    """What "auto" stands for."""
    if problem.options.method != "auto":
        return problem.options.method
    settled = max(problem.missing_conditions) == 0
    if _all_in_five(problem) or (settled and not _five_in_regions(problem)):
        return "exact"
    return "complete" if problem.options.normalise else "pencil"


def _all_in_five(problem: SynthesisProblem) -> bool:
    """Whether five of the poses already determine all dyads."""
    motion = problem.motion
    return motion is not None and motion.five is not None and not problem.task.limits


def _five_in_regions(problem: SynthesisProblem) -> bool:
    """Whether limits may keep five poses from being met, which then are met as nearly as can be.

    A rail may do so with fewer.
    """
    if problem.has_rails:
        return True
    return bool(problem.task.limits) and problem.task.poses.shape[0] == CONDITIONS


def _require_poses(problem: SynthesisProblem, method: Method) -> None:
    """E121 where the method does not take that number of poses."""
    number, free = problem.task.poses.shape[0], max(problem.missing_conditions)
    takes = {
        "pencil": number >= 6,
        "complete": free < 0 or _five_in_regions(problem),
        "exact": free == 0 or _all_in_five(problem),
    }
    if not takes[method]:
        needs = {"pencil": "6 poses or more", "complete": "6 poses or more", "exact": "5 poses"}
        raise InputError(
            "E121",
            f"the {method} method takes {needs[method]}, not {number}",
            why="up to five poses are met exactly, six or more only by chance",
            help="leave --method out, and the number of poses decides",
        )
