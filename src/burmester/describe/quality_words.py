"""The quality of a linkage in words, what it bears under loads, and what a better one moves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from burmester.describe.dimensions import degrees
from burmester.fourbar.dyad import PR
from burmester.linkages.nearby_linkages import Move, greatest_move, moves
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks import notation
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.verdicts import explanation
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.quality import Quality
from burmester.wording import figure, least_angle, listed, spans

if TYPE_CHECKING:
    from burmester.loads.load_figures import Extremes, LoadFigures

COLUMNS = (
    "ext.: the diagonal of the box of all pivots, in spans of the motion; sens.: the position "
    "error at a pose per error of all pivots and lengths"
)


TOLD_CHANGE = 0.1  # relative; a smaller change of extent or sensitivity is not told


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


def improvements(synthesis: Synthesis) -> list[str]:
    """A sentence for each better linkage near a given one; none of other syntheses."""
    if synthesis.outcome.code not in JUDGED:
        return []
    given, *near = synthesis.linkages
    return [moved_pivots(synthesis, given, each) for each in near]


def moved_pivots(synthesis: Synthesis, given: FoundLinkage, better: FoundLinkage) -> str:
    """How far each pivot moves to a better linkage, what gets better, and at what price."""
    task = synthesis.task
    most = notation.length_of(greatest_move(given, better), task)
    parts = [f"{each.dyad}: {', '.join(_parts(each, task))}" for each in moves(given, better)]
    gains, prices = _changes(synthesis, given, better)
    but = f", but {listed(prices)}" if gains and prices else ""
    return (
        f"{better.id} changes nothing by more than {most} ({'; '.join(parts)}): "
        f"it {listed(gains or prices)}{but}."
    )


def _parts(move: Move, task: Task) -> Iterator[str]:
    """What moves of one dyad."""
    if move.fixed_pivot is not None:
        yield f"fixed pivot {notation.length_of(move.fixed_pivot, task)}"
    if move.moving_pivot is not None:
        yield f"moving pivot {notation.length_of(move.moving_pivot, task)}"
    if move.length is not None:
        sign = "+" if move.length > 0 else "-"
        yield f"length {sign}{notation.length_of(abs(move.length), task)}"
    if move.line is not None:
        assert move.turn is not None
        turn = figure(math.degrees(move.turn))
        yield f"line {notation.length_of(move.line, task)} and {turn}°"


def _changes(
    synthesis: Synthesis, given: FoundLinkage, better: FoundLinkage
) -> tuple[list[str], list[str]]:
    """What gets better, and what worse."""
    task, size = synthesis.task, synthesis.length
    gains: list[str] = [] if given.usable else ["works"]
    prices: list[str] = []
    near, was = (explanation.nearness(each, task, size) for each in (better, given))
    if near != was:
        text = f"{near} instead of {was.removeprefix('misses by ')}"
        (gains if better.combined_error <= given.combined_error else prices).append(text)
    locks = any(each.kind == "branch" for each in given.defects)
    before, after = (each.driven.least_over_range for each in (given, better))
    angles = [least_angle(each) for each in (after, before)]
    if math.isfinite(after) and (locks or not math.isfinite(before)):
        gains.append(f"transmits at {angles[0]} or more")
    elif angles[0] != angles[1]:
        text = f"transmits at {angles[0]} or more instead of {angles[1]}"
        (gains if after > before else prices).append(text)
    if given.quality is not None and better.quality is not None:
        for name, text in (
            ("extent", "needs a box of {} instead of {} times the span"),
            ("sensitivity", "errs by {} instead of {} times the errors of its parts"),
        ):
            new, old = (float(getattr(each.quality, name)) for each in (better, given))
            if math.isfinite(new) and math.isfinite(old) and abs(new / old - 1) > TOLD_CHANGE:
                (gains if new < old else prices).append(text.format(figure(new), figure(old)))
    return gains, prices


def load_notes(figures: LoadFigures | None, task: Task) -> list[str]:
    """Sentences, each a line; none where there are no loads."""
    if figures is None:
        return []
    unit = "N·m" if figures.turns else "N"
    held = figures.effort
    out = [f"Held by its driver with {_from_to(held)} {unit}; most {_where(held, task)}."]
    if (hand := figures.hand) is not None:
        rub = f" Friction takes up to {figures.rub:.2g} N more." if figures.rub else ""
        out.append(f"A hand moves it with {_from_to(hand)} N{_sign(hand)}.{rub}")
    # The pins of a link that weighs nothing bear the same but for rounding: the first is told.
    name, force = max(figures.pins.items(), key=lambda pin: float(f"{pin[1]:.9g}"))
    out.append(f"Its pins bear at most {figure(force, 3)} N, pin {name}.")
    out.append(_rests(figures, task))
    for each in figures.springs:
        turned = each.spring.kind == "torsion"
        length = "°" if turned else f" {task.length_unit}"
        low, high = each.length
        out.append(
            f"Its {each.spring.kind} spring goes from {low:.4g} to {high:.4g}{length}, and "
            f"{_push_or_pull(each.tension, 'N·m' if turned else 'N')}."
        )
    if (drive := figures.drive) is not None:
        out.append(
            f"In {drive.drive.duration_s:g} s ({drive.drive.profile}) its driver bears "
            f"{_from_to(drive.effort)} {unit}; the body moves at up to {figure(drive.speed, 3)} "
            f"{task.length_unit}/s."
        )
    return out


def _from_to(values: Extremes) -> str:
    return f"{figure(values.least, 3)} to {figure(values.greatest, 3)}"


def _sign(hand: Extremes) -> str:
    if hand.least < 0 < hand.greatest:
        return "; below zero it holds the body back"
    return ", which hold the body back" if hand.greatest <= 0 else ""


def _push_or_pull(tension: tuple[float, float], unit: str) -> str:
    low, high = sorted(map(abs, tension))
    verb = "pushes" if tension[1] <= 0 else "pulls" if tension[0] >= 0 else "pushes and pulls"
    return f"{verb} with {figure(low, 3)} to {figure(high, 3)} {unit}"


def _where(values: Extremes, task: Task) -> str:
    greatest = abs(values.greatest) >= abs(values.least)
    return _between(values.at_poses[1 if greatest else 0], task)


def _between(poses: tuple[int, int], task: Task) -> str:
    one, two = (named(pose - 1, task) for pose in poses)
    return f"at {one}" if one == two else f"between {one} and {two}"


def named(pose: int, task: Task) -> str:
    """A pose by its name, or its number; pose: from 0."""
    name = task.names[pose] if task.names else ""
    return f"'{name}'" if name else f"pose {pose + 1}"


def _rests(figures: LoadFigures, task: Task) -> str:
    stays = [named(each, task) for each in figures.stays]
    text = f"It stays by itself at {listed(stays)}." if stays else "It stays by itself at no pose."
    stable = [each for each in figures.rests if each.stable]
    if not figures.turns:
        return text
    if stable:
        at = listed([_between(each.between_poses, task) for each in stable])
        text += f" Let go, it comes to rest {at}."
    elif not stays and math.copysign(1, figures.effort.least) == math.copysign(
        1, figures.effort.greatest
    ):
        text += " Let go, it goes all the way to one end."
    return text
