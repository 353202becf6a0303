"""Six-bars as plain JSON data for a page: their dimensions, what they do, and the words for it.

The page has the joints of each link in the frame of that link, and the angles of all links at some
places along the branch; in between it turns the links until all joints meet (`widget/six_bar.mjs`).
Angles of the driver are in degrees, others in radians, lengths in the task's unit.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from burmester.describe import six_bar_words
from burmester.io.result import message_data
from burmester.numerics.arrays import FloatArray
from burmester.sixbar.six_bars import RULE, SixBars
from burmester.synthesis.result import Synthesis
from burmester.tasks.notation import least_angle, length_of
from burmester.web.data import poses_report, scene_of
from burmester.web.image_space import chart_of
from burmester.wording import figure

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["six_bar_report"]

SCHEMA: Final = "burmester.six-bar-report/1"
FRAMES: Final = (
    "F is the ground, M the body. The frame of another link has its origin at one of its joints, "
    "and another one on its x axis. Links transmit by the angle between them at a joint that both "
    "hold."
)
DIGITS: Final = 7  # decimals of these angles, from which the page goes on
STEPS: Final = 60  # for each turn of the driver: places along a branch
END: Final = 2e-5  # of a branch; nearer to a dead point rounding decides whether loops are closed


def six_bar_report(synthesis: Synthesis) -> dict[str, Any]:
    """The whole report as an object ready for JSON."""
    task, result = synthesis.task, synthesis.six_bars
    found = () if result is None else result.found
    scene = scene_of(synthesis)
    return {
        "schema": SCHEMA,
        "outcome": message_data(synthesis.outcome),
        "best": _best(synthesis, found[0]) if found else [],
        "warnings": list(map(message_data, synthesis.warnings)),
        "unit": task.length_unit,
        "poses": poses_report(task),
        "body": None if task.body is None else task.body.vertices.tolist(),
        "keep_out": [],
        "scene": scene,
        "chart": chart_of(task.poses, synthesis.length or scene),
        "asked_transmission_deg": task.requirements.transmission_deg or None,
        "heads": list(six_bar_words.HEADS),
        "six_bars": [_six_bar(synthesis, each) for each in found],
        "footnotes": _footnotes(result),
    }


def _footnotes(result: SixBars | None) -> str:
    """How the first one was chosen, and the frames of its dimensions."""
    if result is None or not result.found:
        return ""
    return FRAMES if result.given else f"{RULE[0].upper()}{RULE[1:]}. {FRAMES}"


def _best(synthesis: Synthesis, best: FoundSixBar) -> list[str]:
    """What to build; what else is to be said of it stands beside its picture."""
    told = [f"{six_bar_words.headline(best)}."]
    return [*told, six_bar_words.sentences(synthesis, best)[1]] if best.usable else told


def _six_bar(synthesis: Synthesis, found: FoundSixBar) -> dict[str, Any]:
    skeleton, frames, met = found.skeleton, found.frames, six_bar_words.met(synthesis, found)
    outlines = skeleton.corners(frames, found.carries)
    low, high = (math.degrees(each) for each in found.drive_range)
    below, above = np.degrees(found.room).tolist()
    middle, turn = (low + high) / 2, 180 * found.turns
    ends = (middle - turn, middle + turn) if found.turns else (low - below, high + above)
    return {
        "id": found.id,
        "type": skeleton.name,
        "usable": found.usable,
        "sound": not found.shortcomings,
        "crank": six_bar_words.driver_name(found),
        "driver": skeleton.crank(found.driver_pivot),
        "carries": found.carries,
        "ground": {name: _pair(at) for name, at in frames[skeleton.ground].items()},
        "links": [
            {
                "name": link,
                "on": on,
                "pin": pin,
                "joints": {name: _pair(at) for name, at in frames[link].items()},
                "outline": outlines[link],
            }
            for link, on, pin in skeleton.tree
        ],
        "closures": skeleton.closures,
        "legs": skeleton.legs(found.driver_pivot),
        "angles": _angles(found, *ends),
        "drive_deg": np.degrees(found.drive).tolist(),
        "ends_deg": list(ends),
        "turns_fully": found.turns > 0,
        "said": {
            "story": " ".join(six_bar_words.sentences(synthesis, found)[::2]),
            "shortcomings": list(found.shortcomings),
            "why_not": None if found.usable else six_bar_words.sentences(synthesis, found)[1],
            "met": met,
            "errors": None if met is None else six_bar_words.errors(synthesis, found),
            "transmission": least_angle(found.transmission),
            "link_ratio": figure(found.link_ratio),
            "extent": length_of(found.extent, synthesis.task),
            "row": list(six_bar_words.row(synthesis, found)),
            "dimensions": [
                *six_bar_words.joint_rows(found),
                *six_bar_words.length_rows(found),
            ],
            "distances": six_bar_words.distances(found),
        },
    }


def _angles(found: FoundSixBar, low: float, high: float) -> dict[str, list[float]]:
    """The angles of links at places between two angles of the driver, without jumps.

    Evenly, where the driver turns fully; else closer towards both ends, at which it comes to rest.
    """
    count = 1 + STEPS * max(1, math.ceil((high - low) / 360))
    share = np.linspace(0, 1, count)
    if not found.turns:
        share = (1 - np.cos(np.pi * np.clip(share, END, 1 - END))) / 2
    places = found.links(np.radians(low + (high - low) * share))
    out = {}
    for link in found.skeleton.moving:
        angle = places[link].angle
        known = np.flatnonzero(np.isfinite(angle))
        near = known[np.abs(known - np.arange(count)[:, None]).argmin(axis=1)]
        out[link] = np.round(np.unwrap(angle[near]), DIGITS).tolist()
    return out


def _pair(point: FloatArray) -> list[float]:
    return [float(each) for each in point]
