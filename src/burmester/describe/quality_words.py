"""The quality of a linkage in words: two figures beside its transmission angle, and a note."""

from __future__ import annotations

import math

from burmester.describe.digits import degrees
from burmester.fourbar.dyad import PR
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.quality import Quality
from burmester.wording import figure, listed, spans

COLUMNS = (
    "ext.: the diagonal of the box of all pivots, in spans of the motion; sens.: the position "
    "error at a pose per error of all pivots and lengths"
)


def in_short(quality: Quality | None) -> tuple[str, str]:
    """Extent and sensitivity, "-" where there is none."""
    if quality is None:
        return "-", "-"
    return figure(float(quality.extent)), figure(float(quality.sensitivity))


def quality_note(found: FoundLinkage, task: Task, *, short: bool = False) -> str | None:
    """Room, errors as built and the driver's way, in sentences; None where nothing is known.

    short: the driver's way alone.
    """
    if found.quality is None or not math.isfinite(found.quality.extent):
        return None
    extent, sensitivity = in_short(found.quality)
    turn, reserve, _ = _driver(found, found.quality, task)
    way = f"Its driver {turn}{reserve}."
    if short:
        return way
    return (
        f"Its pivots stay in a box with a diagonal of {extent} times the motion's span. Errors of "
        f"all pivots and lengths come out up to {sensitivity} times as large at a pose. {way}"
    )


def facts(found: FoundLinkage, task: Task) -> dict[str, str]:
    """The figures for a page, by name, each with its unit; {} where nothing is known."""
    if found.quality is None:
        return {}
    _, sensitivity = in_short(found.quality)
    turn, reserve, advantage = _driver(found, found.quality, task)
    return {
        "extent": spans(float(found.quality.extent)),
        "sensitivity": sensitivity,
        "driver's way": turn + reserve,
        "mechanical advantage": advantage,
    }


def _driver(found: FoundLinkage, quality: Quality, task: Task) -> tuple[str, str, str]:
    """How far the driver goes, how much farther it may, and the force that it passes on."""
    slides = isinstance(found.driver_first.first, PR)

    def way(value: float) -> str:
        return length_of(value, task) if slides else degrees(value)

    turn = f"{'slides' if slides else 'turns'} by {way(float(quality.driver_turn))}"
    ends = [
        f"{way(value)} {where}"
        for value, where in zip(quality.reserve.tolist(), ("below", "above"), strict=True)
        if math.isfinite(value)
    ]
    if found.driven.turns_fully:
        reserve = ", and could turn fully"
    elif ends:
        reserve = f"; it would lock {listed(ends, 'and')} that range"
    else:
        reserve = ", and nothing stops it"
    force = [figure(float(each)) if math.isfinite(each) else "∞" for each in quality.advantage]
    per = "" if slides else f"/{task.length_unit}" if task.length_unit else " per length"
    return turn, reserve, f"{force[0]}{per} at the first pose, {force[1]}{per} at the last"
