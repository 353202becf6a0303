"""What a better linkage near a given one moves, and what gets better, in one sentence."""

from __future__ import annotations

import math
from collections.abc import Iterator

from burmester.linkages.nearby_linkages import Move, greatest_move, moves
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks import notation
from burmester.tasks.motion_task import Task
from burmester.verdicts import explanation
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import figure, least_angle, listed

TOLD_CHANGE = 0.1  # relative; a smaller change of extent or sensitivity is not told


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
