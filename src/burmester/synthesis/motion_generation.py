"""The whole road: from a task to dyads, from dyads to linkages, everything kept and ranked."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import combinations, product

import numpy as np

from burmester.certificates.certificate import Certificate, certify_five
from burmester.certificates.certificate import certify as certify_best
from burmester.diagnosis.checks import diagnose, disagreement
from burmester.dyads.critical_points import CriticalDyads
from burmester.dyads.five_poses import FivePoseDyads, dyads_of_five
from burmester.dyads.local_minima import BestDyads, best_dyads
from burmester.dyads.minima_within_limits import Norm
from burmester.dyads.pencil import fit_pencil
from burmester.dyads.selection import Fit, FoundDyad, characteristic_length, found_dyads, same_dyad
from burmester.errors import Advice
from burmester.fourbar.dyad import Dyad
from burmester.fourbar.pose_error import PoseError
from burmester.linkages.evaluation import SynthesisOptions
from burmester.linkages.found_linkage import FoundLinkage, Pair
from burmester.linkages.from_dyads import linkages_from_dyads
from burmester.synthesis.method import Method, chosen_method
from burmester.synthesis.outcome import advice, family, linkage_advice, told
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.feasibility import require_feasible
from burmester.tasks.motion_class import MotionClass
from burmester.tasks.motion_kinds import FewPoses, Rest, Undetermined
from burmester.tasks.motion_task import CONDITIONS, Task

__all__ = ["Advice", "FoundDyad", "FoundLinkage", "Method", "Norm", "Outcome", "synthesize"]


def synthesize(
    task: Task,
    method: Method = "auto",
    *,
    normalise: bool = True,
    norm: Norm = "rms",
    certify: bool = False,
    length: float | None = None,
    tolerance: float | None = None,
    step: float | None = None,
    stock: Sequence[float] = (),
) -> Synthesis:
    """The dyads of a task and the linkages made of them.

    method: "complete" finds every locally best dyad of 6 poses or more, and of any task with
        limits; "exact" meets five conditions: five poses, or fewer with pivots at points or on
        lines; "pencil" is the paper's, for 6 or more poses; "auto" is exact where there are five
        conditions and complete where there are more.
    normalise: False lets the pencil fit the numbers as they come, as the paper does.
    norm: what is least, the sum of squared distances, or the worst one.
    certify: ask for a certificate as well, of a task without limits.
    length: what a radian of angle error counts as, in the task's unit; the characteristic length
        of the task if None.
    tolerance: to which links and pivots are built, in the task's unit: the spread of the errors is
        told.
    step, stock: to which lengths and pivots are rounded, and which lengths links come in.
    Linkages are refined as a whole, but those of the pencil are the paper's.
    Fewer than five conditions have infinitely many dyads: see `exact` and `curve` for them all.
    Raises InputError E121 where the method does not take that number of poses, E123 where it does
    not take what was asked, E130 where proofs lack their library, and E132 (limits that no link
    can meet).
    """
    both = task.limits * (2 if len(task.limits) == 1 else 1)
    require_feasible(task.poses, both, task.exact)
    diagnosis = diagnose(task)
    motion, warnings = diagnosis.motion, list(diagnosis.findings)
    whole, size = task, characteristic_length(task)
    options = SynthesisOptions(
        size if length is None else length,
        refine=normalise and method != "pencil",
        worst=norm == "worst",
        tolerance=tolerance,
        step=step,
        stock=tuple(stock),
    )
    if motion is not None:
        # Pivots at points or on lines may settle what too few or too small motions leave open.
        kind, settled = motion.kind, any(each.conditions for each in task.limits)
        few = isinstance(kind, FewPoses) and (settled or (kind.repeats and motion.distinct > 2))
        small = isinstance(kind, Undetermined) and settled
        if not (motion.determined or few or small):
            return _special(task, method, motion, size, options, warnings)
        if motion.distinct < task.poses.shape[0]:
            task = _merged(task, motion)
    free = max(_freedom(task))
    if free > 0 and method in ("auto", "exact"):
        return _family(whole, task, method, motion, size, warnings)
    chosen = chosen_method(task, motion, method, normalise, norm, certify, free)
    fits = _fits(task, motion, chosen, normalise, norm)
    return _finish(whole, task, chosen, motion, size, fits, warnings, certify, options)


def _merged(task: Task, motion: MotionClass) -> Task:
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


def _family(  # noqa: PLR0917
    whole: Task,
    task: Task,
    method: Method,
    motion: MotionClass | None,
    length: float,
    warnings: list[Advice],
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
    told_all = (*warnings, warning)
    return Synthesis(whole, method, said, motion, length, numbered, warnings=told_all)


def _special(  # noqa: PLR0917
    task: Task,
    method: Method,
    motion: MotionClass,
    length: float,
    options: SynthesisOptions,
    warnings: list[Advice],
) -> Synthesis:
    """A special motion: what is certain of it is the whole answer."""
    kind = motion.kind
    found = []
    for number, dyad in enumerate(kind.dyads, start=1):
        miss = np.abs(dyad.residual(task.poses))
        rms = float(np.sqrt((miss**2).mean()))
        found.append(FoundDyad(f"D{number}", dyad, rms, float(miss.max())))
    pairs = list(combinations(found, 2))
    linkages: tuple[FoundLinkage, ...] = ()
    if pairs:
        once = replace(options, refine=False)
        linkages = _joined(task, _merged(task, motion), pairs, once, motion)
    said = Outcome(kind.code, kind.message, kind.help)
    if isinstance(kind, Rest | FewPoses):  # which say themselves what repeats
        warnings = [each for each in warnings if each.code != "W208"]
    advised = (*warnings, *linkage_advice(task, linkages, said.code))
    return Synthesis(
        task, method, said, motion, length, tuple(found), linkages, advised, options=options
    )


def _fits(
    task: Task, motion: MotionClass | None, method: Method, normalise: bool, norm: Norm
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
    motion: MotionClass | None,
    length: float,
    fits: tuple[Fit, ...],
    warnings: list[Advice],
    certify: bool,
    options: SynthesisOptions,
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
    all_of_them = method == "complete" and not task.limits and task.exact is None
    known = [each.dyad for each in dyads] if all_of_them else []
    if (odd := disagreement(whole, motion, known)) is not None:
        warnings.insert(0, odd)
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
        elif len(fits) == 1:  # what meets both of two limits is found twice
            warnings.append(
                Advice(
                    "W205",
                    f"{first.id} and {second.id} are the same dyad within rounding",
                    "only one constraint was found; give more poses, or more different ones",
                )
            )
    linkages = _joined(whole, task, different, options, motion)
    said = told(whole, method, fits, dyads, real, linkages)
    warnings += linkage_advice(whole, linkages, said.code)
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
        options,
    )


def _joined(
    whole: Task,
    task: Task,
    pairs: Sequence[Pair],
    options: SynthesisOptions,
    motion: MotionClass | None,
) -> tuple[FoundLinkage, ...]:
    """The linkages of pairs of dyads, with their errors at all poses, repeated ones too."""
    if motion is None or motion.distinct == whole.poses.shape[0]:
        return linkages_from_dyads(task, pairs, options)
    found = linkages_from_dyads(task, pairs, options, [int(i) for i in motion.first])
    group = motion.group
    return tuple(
        replace(each, error=PoseError.at(each.error.places[group], whole.poses)) for each in found
    )


def _proved(task: Task, fit: Fit, dyads: Sequence[FoundDyad]) -> Certificate:
    """What is proved of the dyads."""
    plain: list[Dyad] = [each.dyad for each in dyads]
    if isinstance(fit, FivePoseDyads):
        return certify_five(task.poses, fit, plain)
    assert isinstance(fit, BestDyads)
    assert isinstance(fit.search, CriticalDyads)
    return certify_best(task.poses, task.weights, fit.search, plain)
