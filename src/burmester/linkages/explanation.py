"""Why a linkage does not work, and what would help: in words, from what is known of it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from burmester.fourbar.defects import Defect
from burmester.linkages.found_linkage import FoundLinkage
from burmester.numerics.arrays import ROUNDING
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.tasks.wording import called, figure, length_of

__all__ = ["by_nearness", "exact", "in_short", "met", "reasons", "way_on"]

FEW = 3  # poses missed that are called by their names
HINTS = 2  # ways on that are told


def exact(found: FoundLinkage, size: float) -> bool:
    """Whether all poses are met, up to rounding, by a linkage of a task of characteristic size."""
    worst = float(np.nan_to_num(found.error.angle, nan=np.inf).max())
    return found.error.worst < ROUNDING * size and worst < 10 * ROUNDING


def met(found: FoundLinkage, task: Task, size: float) -> str:
    """How near it comes: "passes every pose exactly", "misses by 0.15 mm"."""
    if not math.isfinite(found.error.worst):
        return "cannot be assembled near every pose"
    if exact(found, size):
        return "passes every pose exactly"
    return f"misses by {length_of(found.error.worst, task)}"


def by_nearness(linkages: Sequence[FoundLinkage], size: float) -> list[FoundLinkage]:
    """By rising worst position error, in the order they have where that is mere rounding."""

    def worst(each: FoundLinkage) -> float:
        return float(np.round(each.error.worst / (ROUNDING * size)))

    return sorted(linkages, key=worst)


def reasons(found: FoundLinkage, task: Task) -> list[str]:
    """Why it is not usable: defects, missed poses first; then what is asked and not so."""
    said = [_too_far(found, task, each) or each.message for each in found.defects]
    locks = any(each.kind == "branch" for each in found.defects)  # without any transmission there
    return said + [
        each.message for each in found.violations if not (locks and each.kind == "transmission")
    ]


def in_short(found: FoundLinkage, task: Task, size: float) -> str:
    """How near it comes and why it is not usable: "misses by 0.15 mm but locks between ..."."""
    far = any(each.kind == "assembly" for each in found.defects)
    return f"{met(found, task, size)}{':' if far else ' but'} {'; '.join(reasons(found, task))}"


def _too_far(found: FoundLinkage, task: Task, defect: Defect) -> str | None:
    """An assembly defect by how much it misses, if it comes near the poses at all."""
    poses = list(defect.poses)
    if defect.kind != "assembly" or not np.isfinite(found.error.position[poses]).all():
        return None
    away = length_of(float(found.error.position[poses].max()), task)
    turned = figure(math.degrees(float(found.error.angle[poses].max())))
    if len(poses) <= FEW:
        which = called(task, poses)
    else:
        total = task.poses.shape[0]
        which = f"all {total} poses" if len(poses) == total else f"{len(poses)} of {total} poses"
    return f"too far from {which} ({'' if len(poses) == 1 else 'up to '}{away} and {turned}°)"


def way_on(linkages: Sequence[FoundLinkage], task: Task, size: float) -> str:
    """What would help where none of the linkages is usable, and would leave one."""
    near = by_nearness(linkages, size)
    ways: dict[tuple[str, ...], FoundLinkage] = {}
    for each in near:
        options = _options(each, task)
        if options:
            ways.setdefault(tuple(option.split()[0] for option in options), each)
    nearest = sorted(ways.values(), key=lambda each: len(_options(each, task)))
    softer = ways.get(("--min-transmission",))
    if softer is not None:  # the nearest one; and one that transmits best
        alike = [each for each in near if {way.kind for way in each.violations} == {"transmission"}]
        alike = [each for each in alike if not each.defects]
        best = max(alike, key=lambda each: each.driven.least_over_range)
        if best is not softer:
            nearest.insert(1, best)
    said = [_would_do(each, task, size) for each in nearest[:HINTS]]
    if near[0].error_before_rounding is not None:
        said.insert(0, "round less")
    stuck = next((each for each in near[0].defects if each.kind in ("circuit", "branch")), None)
    if stuck is not None and stuck.poses and len(said) < HINTS:
        few = len(stuck.poses) <= FEW + 1
        text = f"move {called(task, stuck.poses, 'or')}" if few else "move a pose"
        if task.poses.shape[0] > CONDITIONS and not task.limits:
            text += ", or leave one out"
        said.append(text)
    if task.limits:
        said.append("give the limits more room")
    return "; or ".join(said) or "move a pose"


def _would_do(found: FoundLinkage, task: Task, size: float) -> str:
    options = _options(found, task)
    how = met(found, task, size)
    if options[0].startswith("--within"):
        turned = figure(math.degrees(float(found.error.angle.max())))
        how = f"is off by {length_of(found.error.worst, task)} and {turned}°"
    return f"with {' '.join(options)} {found.id} would do (it {how})"


def _options(found: FoundLinkage, task: Task) -> tuple[str, ...]:
    """The options with which the linkage would be usable; none where no option helps."""
    asked, options = task.requirements, []
    for defect in found.defects:
        if defect.kind == "order" and not asked.any_order:
            options.append("--any-order")
        elif defect.kind == "assembly" and math.isfinite(found.error.worst):
            options.append(f"--within {_above(found.error.worst)}")
        else:
            return ()
    links = found.linkage.links
    for each in found.violations:
        if each.kind == "transmission" and np.isfinite(found.driven.least_over_range):
            degrees = math.floor(10 * math.degrees(found.driven.least_over_range)) / 10
            options.append(f"--min-transmission {degrees:g}")
        elif each.kind == "link ratio" and links is not None:
            lengths = [float(length) for length in links]
            options.append(f"--link-ratio {_above(max(lengths) / min(lengths))}")
        elif each.kind == "type":
            name = found.driver_first.type
            options.append(f'--type "{name}"' if " " in name else f"--type {name}")
        elif each.kind == "driver":
            options.append("--driver any")
        else:
            return ()
    return tuple(sorted(set(options), reverse=True))  # --within first


def _above(value: float) -> str:
    """The value rounded up to three digits."""
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return f"{math.ceil(value / step) * step:.3g}"
