"""The whole road: from a task to dyads, from dyads to linkages, everything kept and ranked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Literal, final

import numpy as np

from burmester.accuracy import PoseError
from burmester.candidates import (
    LONG,
    ROUNDING,
    Fit,
    FoundDyad,
    characteristic_length,
    found_dyads,
    known,
    same_dyad,
)
from burmester.critical import COUNT
from burmester.dyad import RR
from burmester.errors import InputError
from burmester.exact import FivePoseDyads, dyads_of_five
from burmester.linkage import Linkage
from burmester.optimal import BestDyads, best_dyads
from burmester.pencil import fit_pencil
from burmester.task import Task

__all__ = [
    "Advice",
    "FoundDyad",
    "FoundLinkage",
    "Method",
    "Outcome",
    "Synthesis",
    "synthesize",
]

Method = Literal["auto", "pencil", "exact", "complete"]


@final
@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a task: a stable code, and a sentence."""

    code: str
    message: str


@final
@dataclass(frozen=True, slots=True)
class Advice:
    """A warning with what to do about it."""

    code: str
    message: str
    help: str


@final
@dataclass(frozen=True, slots=True, eq=False)
class FoundLinkage:
    """A linkage made of two of the dyads found, and how well it meets the poses."""

    id: str
    rank: int
    dyads: tuple[FoundDyad, FoundDyad]
    linkage: Linkage
    error: PoseError


@final
@dataclass(frozen=True, slots=True, eq=False)
class Synthesis:
    """All that came of a task, nothing thrown away.

    length: the characteristic length of the task (see `frames`), in its unit; it weighs
        angles against positions in `FoundLinkage.error`.
    dyads: every dyad found, by rising rms error (shorter links first among exact ones).
    linkages: every pair of them, by rising worst position error.  Whether a linkage meets the
        poses in one piece and in order (circuit, branch and order defects) is not judged.
    fit: what the method learnt (singular values, all roots), or None where it does not apply.
    """

    task: Task
    method: Method
    outcome: Outcome
    length: float | None
    dyads: tuple[FoundDyad, ...]
    linkages: tuple[FoundLinkage, ...]
    warnings: tuple[Advice, ...]
    fit: Fit | None


def synthesize(task: Task, method: Method = "auto", *, normalise: bool = True) -> Synthesis:
    """The dyads of a task and the linkages made of them.

    method: "pencil" is the paper's, for 6 or more poses, met as closely as it can; "exact"
        solves Burmester's problem for 5; "complete" finds every locally best dyad of 6 or more;
        "auto" is exact for 5 poses and the pencil for more.
    normalise: False lets the pencil fit the numbers as they come, as the paper does.
    Three or four poses have infinitely many dyads: see `exact` and `curve` for them all.
    Raises InputError E121 where the method does not take that number of poses, and E123 where
    it cannot do without normalising.
    """
    count = task.poses.shape[0]
    if method == "auto":
        method = "pencil" if count >= 6 else "exact"
    if method != "pencil" and not normalise:
        raise InputError(
            "E123",
            f"only the pencil can be fitted raw, not the {method} method",
            help="leave --raw out, or use --method pencil",
        )
    if method == "pencil":
        return _finish(task, method, fit_pencil(task.poses, task.weights, normalise=normalise))
    if method == "complete" and count >= 6:
        return _finish(task, method, best_dyads(task.poses, task.weights))
    if count > 5 or method == "complete":
        takes = "6 poses or more" if method == "complete" else "5 poses"
        raise InputError(
            "E121",
            f"the {method} method takes {takes}, not {count}",
            why="up to five poses are met exactly, six or more only by chance",
            help="leave --method out, and the number of poses decides",
        )
    if count < 5:
        family = "a two-parameter family" if count == 3 else "a one-parameter family"
        calls = "dyad_with_moving_pivot" if count == 3 else "dyad_curve"
        return Synthesis(
            task,
            method,
            Outcome(
                "R303",
                f"{count} poses leave infinitely many linkages: {family} of dyads passes "
                "through all of them",
            ),
            None,
            (),
            (),
            (
                Advice(
                    "W203",
                    f"{count} poses do not determine a linkage",
                    f"add {5 - count} more pose{'s' if count == 3 else ''} to get all that pass "
                    f"exactly, or choose from the family in Python: burmester.{calls}",
                ),
            ),
            None,
        )
    return _finish(task, method, dyads_of_five(task.poses))


def _finish(task: Task, method: Method, fit: Fit) -> Synthesis:
    """Join the dyads of a fit to linkages, rank them, and say what came of it."""
    length = characteristic_length(task)
    if (special := _special(task, fit)) is not None:
        return Synthesis(task, method, special, length, (), (), (), fit)
    found, left_out = found_dyads(fit, task)
    warnings = [
        Advice(
            "W204",
            f"{item.id} has a link of {item.dyad.radius / length:.0f} times the motion's size: "
            "nearly a slider",
            "use a slider in its place if a link that long cannot be built",
        )
        for item in found
        if isinstance(item.dyad, RR) and item.dyad.radius > LONG * length
    ]
    if isinstance(fit, BestDyads) and fit.critical.found < COUNT:
        warnings.append(
            Advice(
                "W207",
                f"{fit.critical.found} of {COUNT} critical points were told apart: a locally best "
                "dyad may be missing",
                "compare with --method pencil; poses of a special motion are the usual reason",
            )
        )
    if left_out:
        warnings.append(
            Advice(
                "W206",
                f"{_count(left_out, 'solution')} left out as no dyad: an endless link with no "
                "slider in its place, poses with two different angles only, or all digits lost",
                "give poses that differ more, above all in their angles",
            )
        )
    pairs = []
    for first, second in combinations(found, 2):
        if same_dyad(first.dyad, second.dyad, length):
            warnings.append(
                Advice(
                    "W205",
                    f"{first.id} and {second.id} are the same dyad within rounding",
                    "only one constraint was found; give more poses, or more different ones",
                )
            )
            continue
        linkage = Linkage(first.dyad, second.dyad)
        pairs.append(((first, second), linkage, PoseError.of(linkage, task.poses, length)))
    # Stable: where errors are mere rounding the order of the dyads stays.
    pairs.sort(key=lambda pair: np.round(pair[2].worst / (ROUNDING * length)))
    linkages = tuple(
        FoundLinkage(f"L{rank}", rank, dyads, linkage, error)
        for rank, (dyads, linkage, error) in enumerate(pairs, start=1)
    )
    outcome = _outcome(fit, found, linkages)
    return Synthesis(task, method, outcome, length, tuple(found), linkages, tuple(warnings), fit)


def _special(task: Task, fit: Fit) -> Outcome | None:
    """The outcome where more quadrics contain the poses than the method can tell apart.

    The least singular value that must not vanish is held against what the rounding of the
    poses makes of a zero.  With digits coarser than COARSE that is a heuristic.
    """
    noise = known(task, float(fit.frames.length)) * np.sqrt(task.poses.shape[0] / 3)
    if fit.gap > 3 * noise:
        return None
    poses, nullity = task.poses, 3 if isinstance(fit, FivePoseDyads) else 2
    turns = np.stack([np.cos(poses.angle), np.sin(poses.angle)], axis=-1)
    rows = np.concatenate([poses.translation / fit.frames.length, turns], axis=-1)
    different = len(np.unique(np.round(rows, 12), axis=0))
    reason = (
        f"only {different} of the {len(rows)} poses are different"
        if different < len(rows)
        else "the motion is a special one (a translation, a turn about one point, a parallelogram, "
        "two sliders) or too small for the digits given"
    )
    return Outcome(
        "R304",
        f"the poses do not determine the dyads: more than {nullity} independent quadrics contain "
        f"them; {reason}",
    )


def _outcome(fit: Fit, found: Sequence[FoundDyad], linkages: Sequence[FoundLinkage]) -> Outcome:
    if isinstance(fit, FivePoseDyads):
        dyads = _count(len(found), "real dyad") + " (of the 4 that five poses have)"
    elif isinstance(fit, BestDyads):
        dyads = _count(len(found), "locally best dyad")
        dyads += f" ({fit.critical.found} of {COUNT} critical points accounted for)"
    else:
        dyads = _count(len(found), "dyad")
    if linkages:
        return Outcome("R300", f"{_count(len(linkages), 'four-bar')} from {dyads}")
    return Outcome("R302", f"no four-bar: {dyads}, and it takes two different ones")


def _count(number: int, noun: str) -> str:
    """A number of things in words: "no dyads", "1 dyad", "2 dyads"."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"
