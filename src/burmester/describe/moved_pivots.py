"""What a better linkage near a given one moves, and what gets better, in one sentence."""

from __future__ import annotations

import math
from collections.abc import Iterator

from burmester.linkages import explanation
from burmester.linkages.found_linkage import FoundLinkage
from burmester.linkages.nearby_linkages import Move, greatest_move, moves
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks import notation
from burmester.tasks.motion_task import Task
from burmester.wording import figure, listed

__all__ = ["improvements", "moved_pivots"]


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
    each = "; ".join(
        f"{move.dyad}: {', '.join(_parts(move, task))}" for move in moves(given, better)
    )
    gains = listed(list(_gains(synthesis, given, better)))
    return f"{better.id} changes nothing by more than {most} ({each}): it {gains}."


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


def _gains(synthesis: Synthesis, given: FoundLinkage, better: FoundLinkage) -> Iterator[str]:
    """What gets better, and at what price."""
    task, size = synthesis.task, synthesis.length
    if not given.usable:
        yield "works"
    before, after = (each.driven.least_over_range for each in (given, better))
    if math.isfinite(after):
        text = f"transmits at {notation.least_angle(after)} or more"
        if math.isfinite(before) and not any(each.kind == "branch" for each in given.defects):
            text += f" instead of {notation.least_angle(before)}"
        yield text
    near, was = (explanation.nearness(each, task, size) for each in (better, given))
    if near == was:
        yield near
    else:
        yield f"{near} instead of {was.removeprefix('misses by ').removeprefix('passes ')}"
