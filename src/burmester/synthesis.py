"""The whole road: from a task to dyads, from dyads to linkages, everything kept and ranked."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from typing import final

import numpy as np

from burmester.accuracy import PoseError
from burmester.candidates import (
    ROUNDING,
    Fit,
    FoundDyad,
    characteristic_length,
    found_dyads,
    same_dyad,
)
from burmester.certificate import Certificate, certify_five
from burmester.certificate import certify as certify_best
from burmester.critical import CriticalDyads
from burmester.dyad import PP, Dyad
from burmester.exact import FivePoseDyads, dyads_of_five
from burmester.feasible import require_feasible
from burmester.fingerprint import Fingerprint, fingerprint
from burmester.limited import Norm
from burmester.linkage import Linkage
from burmester.motion_kind import FewPoses, Undetermined
from burmester.optimal import BestDyads, best_dyads
from burmester.outcome import Advice, Method, Outcome, advice, chosen_method, family, outcome
from burmester.pencil import fit_pencil
from burmester.task import CONDITIONS, Task

__all__ = [
    "Advice",
    "FoundDyad",
    "FoundLinkage",
    "Method",
    "Norm",
    "Outcome",
    "Synthesis",
    "synthesize",
]


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

    motion: what the poses are, known before any fit; None for one or two of them.
    length: the characteristic length of the task (see `frames`), in its unit; it weighs
        angles against positions in `FoundLinkage.error`.
    dyads: every dyad found, by rising rms error (shorter links first among exact ones).
    linkages: every pair of them, by rising worst position error.  Whether a linkage meets the
        poses in one piece and in order (circuit, branch and order defects) is not judged.
    fits: what the method learnt (singular values, all roots); two where the task has two limits.
    certificate: what of it is proved, where that was asked for.
    """

    task: Task
    method: Method
    outcome: Outcome
    motion: Fingerprint | None
    length: float
    dyads: tuple[FoundDyad, ...] = ()
    linkages: tuple[FoundLinkage, ...] = ()
    warnings: tuple[Advice, ...] = ()
    fits: tuple[Fit, ...] = ()
    certificate: Certificate | None = None


def synthesize(
    task: Task,
    method: Method = "auto",
    *,
    normalise: bool = True,
    norm: Norm = "rms",
    certify: bool = False,
) -> Synthesis:
    """The dyads of a task and the linkages made of them.

    method: "complete" finds every locally best dyad of 6 poses or more, and of any task with
        limits; "exact" meets five conditions: five poses, or fewer with pivots at points or on
        lines; "pencil" is the paper's, for 6 or more poses; "auto" is exact where there are five
        conditions and complete where there are more.
    normalise: False lets the pencil fit the numbers as they come, as the paper does.
    norm: what is least, the sum of squared distances, or the worst one.
    certify: ask for a certificate as well, of a task without limits.
    Fewer than five conditions have infinitely many dyads: see `exact` and `curve` for them all.
    Raises InputError E121 where the method does not take that number of poses, E123 where it does
    not take what was asked, E130 where proofs lack their library, and E132 (limits that no link
    can meet).
    """
    both = task.limits * (2 if len(task.limits) == 1 else 1)
    require_feasible(task.poses, both, task.exact)
    motion = fingerprint(task) if task.poses.shape[0] > 2 else None
    whole, length = task, characteristic_length(task)
    warnings: list[Advice] = []
    if motion is not None:
        # Pivots at points or on lines may settle what too few or too small motions leave open.
        kind, settled = motion.motion, any(each.conditions for each in task.limits)
        few = isinstance(kind, FewPoses) and (settled or (kind.repeats and motion.distinct > 2))
        small = isinstance(kind, Undetermined) and settled
        if not (motion.determined or few or small):
            return _special(task, method, motion, length)
        if motion.distinct < task.poses.shape[0]:
            task = _merged(task, motion)
            warnings.append(
                Advice(
                    "W208",
                    f"only {motion.distinct} of the {len(motion.group)} poses are different; each "
                    "counts once" + ("" if task.weights is None else ", with all its weight"),
                    "delete the repeats; to let a pose count more give it a weight",
                )
            )
    free = max(_freedom(task))
    if free > 0 and method in ("auto", "exact"):
        return _family(whole, task, method, motion, length)
    chosen = chosen_method(task, motion, method, normalise, norm, certify, free)
    fits = _fits(task, motion, chosen, normalise, norm)
    return _finish(whole, task, chosen, motion, length, fits, warnings, certify)


def _merged(task: Task, motion: Fingerprint) -> Task:
    """The task with every repeated pose once; weights add up."""
    size, first, exact, weights = motion.distinct, motion.first, task.exact, task.weights
    if weights is not None:
        weights = np.bincount(motion.group, weights, size).astype(np.float64)
    return replace(
        task,
        poses=task.poses[first],
        weights=weights,
        names=None if task.names is None else tuple(task.names[i] for i in first),
        exact=None if exact is None else np.bincount(motion.group, exact, size) > 0,
    )


def _freedom(task: Task) -> list[int]:
    """How many more conditions it takes until there are finitely many dyads, for each limit."""
    conditions = [limits.conditions for limits in task.limits] or [0]
    return [CONDITIONS - each - task.poses.shape[0] for each in conditions]


def _family(
    whole: Task, task: Task, method: Method, motion: Fingerprint | None, length: float
) -> Synthesis:
    """Too few conditions: infinitely many dyads, if not of both limits then of one."""
    freedom, dyads = _freedom(task), []
    for number, (each, left) in enumerate(zip(task.limits, freedom, strict=False), start=1):
        if left <= 0:
            every = np.full(task.poses.shape, left == 0)
            found, _ = found_dyads(best_dyads(task.poses, None, every, each), task)
            dyads += [replace(one, limits=number) for one in found]
    said, warning = family(task, whole.poses.shape[0], freedom)
    numbered = tuple(replace(each, id=f"D{i}") for i, each in enumerate(dyads, start=1))
    return Synthesis(whole, method, said, motion, length, numbered, warnings=(warning,))


def _special(task: Task, method: Method, motion: Fingerprint, length: float) -> Synthesis:
    """A special motion: what is certain of it is the whole answer."""
    kind = motion.motion
    found = []
    for number, dyad in enumerate(kind.dyads, start=1):
        miss = np.abs(dyad.residual(task.poses))
        rms = float(np.sqrt((miss**2).mean()))
        found.append(FoundDyad(f"D{number}", dyad, rms, float(miss.max())))
    linkages = _linkages(
        task, combinations([f for f in found if not isinstance(f.dyad, PP)], 2), length
    )
    said = Outcome(kind.code, kind.message, kind.help)
    return Synthesis(task, method, said, motion, length, tuple(found), linkages)


def _fits(
    task: Task, motion: Fingerprint | None, method: Method, normalise: bool, norm: Norm
) -> tuple[Fit, ...]:
    """What the method makes of the poses, once for each of the task's limits."""
    if method == "pencil":
        return (fit_pencil(task.poses, task.weights, normalise=normalise),)
    if method == "complete":
        limits = task.limits or (None,)
        return tuple(
            best_dyads(task.poses, task.weights, task.exact, each, norm) for each in limits
        )
    if not task.limits:
        five = slice(None) if motion is None or motion.five is None else motion.five
        return (dyads_of_five(task.poses[five]),)
    every = np.ones(task.poses.shape, dtype=bool)
    return tuple(best_dyads(task.poses, None, every, each) for each in task.limits)


def _finish(  # noqa: PLR0917
    whole: Task,
    task: Task,
    method: Method,
    motion: Fingerprint | None,
    length: float,
    fits: tuple[Fit, ...],
    warnings: list[Advice],
    certify: bool,
) -> Synthesis:
    """Join the dyads of the fits to linkages, rank them, and say what came of it."""
    lists, left_out = [], 0
    for number, fit in enumerate(fits, start=1):
        found, dropped = found_dyads(fit, task)
        left_out += dropped
        lists.append([replace(each, limits=number if len(fits) > 1 else 0) for each in found])
    real = sum(map(len, lists))
    if method == "exact" and len(fits) == 1 and real < 2 and not task.limits:
        nearest, _ = found_dyads(best_dyads(task.poses, task.weights), task)
        known = [each.dyad for each in lists[0]]
        lists[0] += [
            each
            for each in nearest
            if not any(same_dyad(each.dyad, other, length) for other in known)
        ]
    dyads = [each for found in lists for each in found]
    dyads = [replace(each, id=f"D{i}") for i, each in enumerate(dyads, start=1)]
    warnings += advice(task, fits, dyads, left_out, length)
    pairs: Iterable[tuple[FoundDyad, FoundDyad]]
    if len(fits) > 1:
        one, other = ([each for each in dyads if each.limits == k] for k in (1, 2))
        pairs = product(one, other)
    else:
        pairs = combinations(dyads, 2)
    different = []
    for first, second in pairs:
        if not same_dyad(first.dyad, second.dyad, length):
            different.append((first, second))
        else:
            warnings.append(
                Advice(
                    "W205",
                    f"{first.id} and {second.id} are the same dyad within rounding",
                    "only one constraint was found; give more poses, or more different ones",
                )
            )
    linkages = _linkages(whole, different, length)
    said = outcome(task, method, fits, dyads, real, len(linkages))
    certificate = _proved(task, fits[0], dyads) if certify else None
    return Synthesis(
        whole,
        method,
        said,
        motion,
        length,
        tuple(dyads),
        linkages,
        tuple(warnings),
        fits,
        certificate,
    )


def _linkages(
    task: Task, pairs: Iterable[tuple[FoundDyad, FoundDyad]], length: float
) -> tuple[FoundLinkage, ...]:
    """The linkages of pairs of dyads, by rising worst position error."""
    found = []
    for pair in pairs:
        linkage = Linkage(pair[0].dyad, pair[1].dyad)
        found.append((pair, linkage, PoseError.of(linkage, task.poses, length)))
    # Stable: where errors are mere rounding the order of the dyads stays.
    found.sort(key=lambda pair: np.round(pair[2].worst / (ROUNDING * length)))
    return tuple(
        FoundLinkage(f"L{rank}", rank, dyads, linkage, error)
        for rank, (dyads, linkage, error) in enumerate(found, start=1)
    )


def _proved(task: Task, fit: Fit, dyads: Sequence[FoundDyad]) -> Certificate:
    """What is proved of the dyads."""
    plain: list[Dyad] = [each.dyad for each in dyads]
    if isinstance(fit, FivePoseDyads):
        return certify_five(task.poses, fit, plain)
    assert isinstance(fit, BestDyads)
    assert isinstance(fit.search, CriticalDyads)
    return certify_best(task.poses, task.weights, fit.search, plain)
