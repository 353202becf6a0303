"""The explanation of a linkage in words: how near it comes, why it is not usable, what helps."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.cures import Cure, Help, for_command
from burmester.errors import Finding
from burmester.fourbar.defects import Verdict
from burmester.fourbar.pose_error import PoseError
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.requirements.loads import KINDS_OF_LOADS
from burmester.requirements.poses import ANY_ORDER, WITHIN, WITHIN_ANGLE
from burmester.requirements.requirement import above
from burmester.requirements.table import cured
from burmester.requirements.transmission import TRANSMISSION
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.tasks.notation import length_of, pose_labels, poses_in_words
from burmester.tasks.pose_tolerances import COMPONENTS
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.judged_linkage import LinkageAtPoses
from burmester.wording import figure, listed

MAX_NAMED_POSES = 3  # number of poses that a reason names; more are counted
MOST_TURN = math.pi / 2  # radians; a crank that is off by more is no crank at these angles
SPRING_HELP = "let a spring help: burmester balance looks for one"
MAX_HINTS = 2  # number of linkages, with options that would make them usable, in one hint


SHARE_DIGITS = 6  # decimals by which shares are compared: of equal ones the first is named
MAX_NAMED = 3  # number of poses that a reason names; more are counted


def meets_exactly(found: LinkageAtPoses, size: float) -> bool:
    """Whether a linkage meets all poses within rounding; size: the task's characteristic length."""
    worst = float(np.nan_to_num(found.error.angle, nan=np.inf).max())
    return found.error.worst < ROUNDING * size and worst < 10 * ROUNDING


def asked_for(task: Task) -> str:
    """What a linkage is to pass: "pose", "point", or "pose and point" where both are asked for."""
    if task.angles_are_free:
        return "point"
    return "pose and point" if task.free_angles.any() else "pose"


def nearness(found: LinkageAtPoses, task: Task, size: float) -> str:
    """How near a linkage comes: "passes every pose exactly", "misses by 0.15 mm and 2.1°"."""
    if not math.isfinite(found.error.worst):
        return f"cannot be assembled near every {asked_for(task)}"
    if meets_exactly(found, size):
        return f"passes every {asked_for(task)} exactly"
    return f"misses by {worst_miss(found, task)}"


def worst_miss(found: LinkageAtPoses, task: Task) -> str:
    """The greatest misses at a pose: "0.15 mm and 2.1°", or "0.15 mm" where angles are free."""
    away = length_of(found.error.worst, task)
    if task.angles_are_free:
        return away
    return f"{away} and {figure(math.degrees(float(found.error.angle.max())))}°"


def by_nearness(linkages: Iterable[FoundLinkage], size: float) -> list[FoundLinkage]:
    """Sorted by both errors in one; linkages equal within rounding keep their order."""

    def error(each: FoundLinkage) -> float:
        return float(np.round(each.combined_error / (ROUNDING * size)))

    return sorted(linkages, key=error)


def reasons(found: LinkageAtPoses, task: Task) -> list[str]:
    """Why a linkage is not usable: its defects, missed poses first; then violated requirements."""
    defects = [_too_far(found, task, each) or each.message for each in found.defects]
    # At a dead point there is no transmission angle anyway.
    locks = any(each.kind == "branch" for each in found.defects)
    return defects + [
        each.message for each in found.violations if not (locks and each.kind == "transmission")
    ]


def in_short(found: LinkageAtPoses, task: Task, size: float) -> str:
    """Nearness and reasons in one phrase: "misses by 0.15 mm but locks between ..."."""
    far = any(each.kind == "assembly" for each in found.defects)
    near = f"{nearness(found, task, size)}{':' if far else ' but'}"
    if found.on_branches:
        near = "meets some poses, but" if far else "meets every pose, but"
    return f"{near} {'; '.join(reasons(found, task))}"


def _too_far(found: LinkageAtPoses, task: Task, defect: Finding) -> str | None:
    """An assembly defect in terms of the distance, if the linkage has places near those poses."""
    poses = list(defect.poses)
    if task.tolerances is not None:
        return None
    if defect.kind != "assembly" or not np.isfinite(found.error.position[poses]).all():
        return None
    return too_far_from(poses, found.error, task)


def too_far_from(poses: Sequence[int], error: PoseError, task: Task) -> str:
    """Poses that are missed by too much, and by how much at most.

    "too far from pose 3 (1.2 mm and 3°)".
    """
    poses = list(poses)
    away = length_of(float(error.position[poses].max()), task)
    if not task.free_angles[poses].all():
        away += f" and {figure(math.degrees(float(error.angle[poses].max())))}°"
    if len(poses) <= MAX_NAMED_POSES:
        which = poses_in_words(task, poses)
    else:
        total = task.poses.shape[0]
        which = f"all {total} poses" if len(poses) == total else f"{len(poses)} of {total} poses"
    return f"too far from {which} ({'' if len(poses) == 1 else 'up to '}{away})"


def hints(
    linkages: Sequence[FoundLinkage], problem: SynthesisProblem, *, own: bool = False
) -> Help:
    """What to change where none of the linkages is usable, so that one becomes usable.

    own: whether it is said beside the one linkage that there is.
    """
    task, size = problem.given, problem.length
    near = by_nearness(linkages, size)
    # For each set of arguments the nearest linkage that they make usable.
    nearest_with: dict[frozenset[str], tuple[FoundLinkage, tuple[Cure, ...]]] = {}
    for each in near:
        if cures := cures_of(each, problem):
            names = frozenset(cure.argument for cure in cures)
            nearest_with.setdefault(names, (each, cures))
    ways = sorted(nearest_with.items(), key=lambda way: len(way[1][1]))
    # To change more for a greater error is no help.
    told = [
        way
        for k, (names, way) in enumerate(ways)
        if not any(
            fewer <= names and other.combined_error <= way[0].combined_error
            for fewer, (other, _) in ways[:k]
        )
    ]
    softer = nearest_with.get(frozenset({TRANSMISSION.name}))
    if softer is not None:  # beside the nearest one, the one with the best transmission angle
        alike = [
            each
            for each in near
            if not each.defects and {why.kind for why in each.violations} == {"transmission"}
        ]
        best = max(alike, key=lambda each: each.driven.least_over_range)
        if best is not softer[0]:
            told.insert(1, (best, cures_of(best, problem)))
    texts: list[str] = [
        Help(
            *(("it would do with ", cures) if own else ("with ", cures, f" {each.id} would do")),
            f" (it {nearness(each, task, size)})",
        )
        for each, cures in told[:MAX_HINTS]
    ]
    if near[0].error_before_rounding is not None:
        texts.insert(0, "round less")
    stuck = next((each for each in near[0].defects if each.kind in ("circuit", "branch")), None)
    if stuck is not None and stuck.poses and len(texts) < MAX_HINTS:
        few = len(stuck.poses) <= MAX_NAMED_POSES + 1
        text = f"move {poses_in_words(task, stuck.poses, 'or')}" if few else "move a pose"
        if task.poses.shape[0] > CONDITIONS and not task.limits:
            text += ", or leave one out"
        texts.append(text)
    if task.limits:
        texts.append("give the limits more room")
    if any(why.kind == "clearance" for why in near[0].violations):
        texts.append("make room where it touches")
    if bears_too_much(near[0]):
        texts.append(SPRING_HELP)
    return Help.joined("; or ", texts or ["move a pose"])


def bears_too_much(found: LinkageAtPoses) -> bool:
    """Whether a linkage bears more than what is asked of its loads."""
    return any(why.kind in KINDS_OF_LOADS for why in found.violations)


def cures_of(found: LinkageAtPoses, problem: SynthesisProblem) -> tuple[Cure, ...]:
    """What would make a linkage usable; nothing where no argument helps."""
    asked, share = problem.given.requirements, found.within_tolerance
    out: list[Cure] = []
    # Nothing but a greatest error keeps it from its poses then, and no tolerance of one.
    bounded = math.isfinite(found.error.worst) and (share is None or bool((share <= 1).all()))
    for defect in found.defects:
        if defect.kind == "order" and not asked.any_order:
            out.append(ANY_ORDER.given(True))
        elif defect.kind == "assembly" and bounded:
            out += _error_bounds(found, problem)
        else:
            return ()
    for each in found.violations:
        if (
            each.kind == "timing"
            and isinstance(found, FoundLinkage)
            and found.timing_error is not None
        ):
            away = float(np.nanmax(np.abs(found.timing_error), initial=0.0))
            if not 0 < away < MOST_TURN:
                return ()
            out.append(Cure("within_crank_deg", above(math.degrees(away)), "--within-crank"))
    others = [each for each in found.violations if each.kind != "timing"]
    cures = cured(others, asked.bounds, found.figures)
    if cures is None:
        return ()
    return tuple(sorted({*out, *cures}, key=lambda each: for_command([each]), reverse=True))


def _error_bounds(found: LinkageAtPoses, problem: SynthesisProblem) -> list[Cure]:
    """What bounds both errors of a linkage from above."""
    asked = problem.given.requirements
    within = above(max(found.error.worst, ROUNDING * problem.length))
    turned = math.degrees(float(found.error.angle.max()))
    bound = asked.within_deg or math.degrees(float(within) / problem.length_per_radian)
    cures = [WITHIN.given(float(within))]
    return cures if turned <= bound else [*cures, WITHIN_ANGLE.given(float(above(turned)))]


def below(value: float) -> str:
    """The value rounded down to three digits; 0 stays."""
    if value <= 0:
        return "0"
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return f"{math.floor(value / step) * step:.3g}"


def in_words_of_tolerances(verdict: Verdict, shares: FloatArray, names: Sequence[str]) -> Verdict:
    """The verdict, its assembly defects said by the tolerances that are exceeded.

    shares: (N, 3), of the tolerances that are used; names: of the poses.
    """
    defects = tuple(
        replace(each, message=outside(each.poses, shares, names))
        if each.kind == "assembly" and np.isfinite(shares[list(each.poses)]).all()
        else each
        for each in verdict.defects
    )
    return Verdict(defects, verdict.first, verdict.second)


def outside(poses: Sequence[int], shares: FloatArray, names: Sequence[str]) -> str:
    """Of which poses tolerances are exceeded, the most exceeded one by how much.

    shares: (N, 3), of the tolerances that are used; names: of all poses.
    """
    shares = np.round(shares, SHARE_DIGITS)
    poses = sorted(poses, key=lambda pose: -shares[pose].max())
    worst, component = poses[0], int(shares[poses[0]].argmax())
    text = f"outside the tolerance of pose {names[worst]} ({COMPONENTS[component]} is off by "
    text += f"{figure(float(shares[worst, component]))} times its tolerance)"
    if not (others := [names[pose] for pose in sorted(poses[1:])]):
        return text
    if len(others) > MAX_NAMED:
        return f"{text}, and of {len(others)} more"
    return f"{text}, and of pose{'s' * (len(others) > 1)} {listed(others)}"


def most_used(found: FoundLinkage, task: Task) -> str:
    """How much of the tolerances a linkage uses: "at most 83 % (x at pose 3)"."""
    assert found.within_tolerance is not None
    shares = np.where(_exact(task), 0.0, found.within_tolerance)
    most = int(np.round(shares, SHARE_DIGITS).argmax())
    pose, component = np.unravel_index(most, shares.shape)
    noun = "point" if task.free_angles[pose] else "pose"
    at = f"{noun} {pose_labels(task, [int(pose)])[0]}"
    return f"at most {percent(float(shares.max()))} ({COMPONENTS[component]} at {at})"


def share_texts(found: FoundLinkage, task: Task) -> list[tuple[str, str, str]]:
    """What each pose uses of its tolerances, x, y and angle: "83 %", "exact", "free"."""
    assert found.within_tolerance is not None
    assert task.tolerances is not None
    free, exact = task.tolerances.free, _exact(task)
    out = []
    for k, shares in enumerate(found.within_tolerance.tolist()):
        x, y, angle = (
            "free" if free[k, c] else "exact" if exact[k, c] and share <= 1 else percent(share)
            for c, share in enumerate(shares)
        )
        out.append((x, y, angle))
    return out


def percent(share: float) -> str:
    """A share in per cent, rounded up, so that 100 % is inside and 101 % is not."""
    if not math.isfinite(share):
        return "-"
    whole = math.ceil(100 * share - 1e-6)
    return f"{whole} %" if whole < 1000 else f"{figure(share)} times"


def _exact(task: Task) -> NDArray[np.bool_]:
    assert task.tolerances is not None
    return task.tolerances.exact
