"""What came of a task, in words: the outcome, the warnings, and the method that it got."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias, final

from burmester.candidates import LONG, Fit, FoundDyad
from burmester.critical import COUNT, CriticalDyads
from burmester.dyad import RR
from burmester.errors import InputError
from burmester.exact import FivePoseDyads
from burmester.fingerprint import Fingerprint
from burmester.limited import LimitedDyads, Norm
from burmester.optimal import BestDyads
from burmester.task import CONDITIONS, Task
from burmester.uncertainty import pivot_uncertainty

__all__ = [
    "Advice",
    "Method",
    "Outcome",
    "advice",
    "chosen_method",
    "count",
    "family",
    "outcome",
]

Method: TypeAlias = Literal["auto", "pencil", "exact", "complete"]


@final
@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a task: a stable code, a sentence, and what to do where nothing came.

    R300 linkages; R302 too few dyads for one; R303 infinitely many; R306 none within the limits;
    R307 approximate ones, for want of two real dyads; R310 and above: see `motion_kind`.
    """

    code: str
    message: str
    help: str | None = None


@final
@dataclass(frozen=True, slots=True)
class Advice:
    """A warning with what to do about it."""

    code: str
    message: str
    help: str


def chosen_method(  # noqa: PLR0917
    task: Task,
    motion: Fingerprint | None,
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
            help="leave --certify out, or the rest",
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


def advice(
    task: Task, fits: Sequence[Fit], dyads: Sequence[FoundDyad], left_out: int, length: float
) -> list[Advice]:
    """What a user should know about the dyads."""
    warnings = [
        Advice(
            "W204",
            f"{item.id} has a link of {item.dyad.radius / length:.0f} times the motion's size: "
            "nearly a slider",
            "use a slider in its place if a link that long cannot be built",
        )
        for item in dyads
        if isinstance(item.dyad, RR) and item.dyad.radius > LONG * length
    ]
    for item in dyads:
        loose = pivot_uncertainty(item.dyad, task) if isinstance(item.dyad, RR) else None
        if loose is not None and max(loose) > length:
            warnings.append(
                Advice(
                    "W209",
                    f"the digits of the poses leave the pivots of {item.id} free by about "
                    f"{max(loose):.2g}, more than the motion's own size",
                    "give more digits, or poses with more rotation between them",
                )
            )
    for fit in fits:
        search = fit.search if isinstance(fit, BestDyads) else None
        if isinstance(search, CriticalDyads) and (told := _accounted(search)) < COUNT:
            warnings.append(
                Advice(
                    "W207",
                    f"{told} of {COUNT} critical points were told apart: a locally best "
                    "dyad may be missing",
                    "compare with --method pencil; poses of a special motion are the usual reason",
                )
            )
        if isinstance(search, LimitedDyads) and (search.lost or search.unsettled):
            warnings.append(
                Advice(
                    "W207",
                    f"{count(search.lost, 'path')} of the search and "
                    f"{count(search.unsettled, 'way')} down from it were lost: a locally best "
                    "dyad may be missing",
                    "move a limit a little and compare",
                )
            )
    if left_out:
        warnings.append(
            Advice(
                "W206",
                f"{count(left_out, 'solution')} left out as no dyad: an endless link with no "
                "slider in its place, poses with two different angles only, or all digits lost",
                "give poses that differ more, above all in their angles",
            )
        )
    return warnings


def family(task: Task, whole: int, freedom: Sequence[int]) -> tuple[Outcome, Advice]:
    """What to say of a task with too few conditions, by how many for each limit.

    whole: how many poses it had before the repeated ones were merged.
    """
    distinct, free = task.poses.shape[0], max(freedom)
    poses = count(whole, "pose") + (f", {distinct} of them different," if distinct < whole else "")
    on_pivots = CONDITIONS - free - distinct
    given = poses + (f" and {count(on_pivots, 'condition')} on a pivot" if on_pivots else "")
    which = "the other dyad: " if free > min(freedom) <= 0 else ""
    parameter = {1: "one", 2: "two", 3: "three"}.get(free, str(free))
    help = (
        f"add {count(free, 'more pose')} to get all that pass exactly, or put pivots on lines "
        "(one condition each) or at points (two)"
    )
    calls = {3: "dyad_with_moving_pivot", 4: "dyad_curve"}.get(distinct)
    if calls and not task.limits:
        help += f", or choose from the family in Python: burmester.{calls}"
    return (
        Outcome(
            "R303",
            f"{given} leave infinitely many linkages: {which}a {parameter}-parameter family of "
            "dyads passes through all of them",
        ),
        Advice("W203", f"{given} do not determine a linkage", help),
    )


def outcome(  # noqa: PLR0917
    task: Task,
    method: Method,
    fits: Sequence[Fit],
    found: Sequence[FoundDyad],
    real: int,
    linkages: int,
) -> Outcome:
    """What came of a task, in one sentence; `real`: how many dyads are no mere neighbours."""
    first = fits[0]
    if isinstance(first, FivePoseDyads):
        dyads = count(real, "real dyad") + " (of the 4 that five poses have)"
        if real < len(found):
            best = found[real]
            dyads += f"; the nearest other one misses the poses by {best.rms_error:.2g} rms"
    elif isinstance(first, BestDyads) and isinstance(first.search, CriticalDyads):
        dyads = count(len(found), "locally best dyad")
        dyads += f" ({_accounted(first.search)} of {COUNT} critical points accounted for)"
    elif isinstance(first, BestDyads):
        faces = sum(
            f.search.systems
            for f in fits
            if isinstance(f, BestDyads) and isinstance(f.search, LimitedDyads)
        )
        what = "dyad" if method == "exact" else "locally best dyad"
        dyads = count(len(found), what)
        if task.limits:
            dyads += f" within the limits ({count(faces, 'face')} of these searched)"
    else:
        dyads = count(len(found), "dyad")
    if linkages:
        code = "R307" if isinstance(first, FivePoseDyads) and real < 2 else "R300"
        return Outcome(code, f"{count(linkages, 'four-bar')} from {dyads}")
    wider = "widen a limit, or allow another kind of dyad"
    if task.limits and not found:
        return Outcome("R306", f"no four-bar: {dyads}", wider)
    message = f"no four-bar: {dyads}, and it takes two different ones"
    return Outcome("R302", message, wider if task.limits else "change a pose, or drop one")


def _accounted(search: CriticalDyads) -> int:
    """How many critical points were found, those at infinity included."""
    return int(search.found + search.at_infinity)


def count(number: int, noun: str) -> str:
    """A number of things in words: "no dyads", "1 dyad", "2 dyads"."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"
