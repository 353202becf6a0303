"""Which method a task gets."""

from __future__ import annotations

from typing import Literal, TypeAlias

from burmester.dyads.minima_within_limits import Norm
from burmester.errors import InputError
from burmester.tasks.motion_class import MotionClass
from burmester.tasks.motion_task import CONDITIONS, Task

__all__ = ["Method", "chosen_method"]

Method: TypeAlias = Literal["auto", "pencil", "exact", "complete"]


def chosen_method(  # noqa: PLR0917
    task: Task,
    motion: MotionClass | None,
    method: Method,
    normalise: bool,
    norm: Norm,
    certify: bool,
    free: int,
) -> Method:
    """The method that a task gets, or an error that says why not the one asked for."""
    number = task.poses.shape[0]
    all_in_five = motion is not None and motion.five is not None and not task.limits
    # Five poses may miss within a box, and then come as near as the box allows.
    box = bool(task.limits and number == CONDITIONS)
    if method == "auto":
        exact = all_in_five or (free == 0 and not box)
        method = "exact" if exact else "complete" if normalise else "pencil"
    marked = task.exact is not None and bool(task.exact.any())
    if method != "pencil" and not normalise:
        raise InputError(
            "E123",
            f"only the pencil can be fitted raw, not the {method} method",
            help="leave --raw out, or use --method pencil",
        )
    asked = [
        name
        for name, given in (
            ("limits", bool(task.limits)),
            ("exact poses", marked),
            ("the least worst distance", norm != "rms"),
        )
        if given
    ]
    if method == "pencil" and asked:
        raise InputError(
            "E123",
            f"the pencil knows nothing of {asked[0]}",
            why="it fits one pencil of quadrics to all poses alike",
            help="use --method complete",
        )
    if certify and (asked or method == "pencil"):
        raise InputError(
            "E123",
            "a certificate is for every locally best dyad without limits, or for five poses",
            why=f"this task has {asked[0]}"
            if asked
            else "the pencil's dyads are not the best ones",
            help="leave --certify out" + (", or what it has" if asked else ""),
        )
    takes = {
        "pencil": number >= 6,
        "complete": free < 0 or box,
        "exact": free == 0 or all_in_five,
    }
    if not takes[method]:
        needs = {"pencil": "6 poses or more", "complete": "6 poses or more", "exact": "5 poses"}
        raise InputError(
            "E121",
            f"the {method} method takes {needs[method]}, not {number}",
            why="up to five poses are met exactly, six or more only by chance",
            help="leave --method out, and the number of poses decides",
        )
    return method
