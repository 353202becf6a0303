"""Six-bars as plain JSON data for a page: their dimensions, what they do, and the words for it.

Where joints and body are follows from the dimensions and the driver's angle in closed form, and the
page works it out itself (`widget/six_bar.mjs`).  Angles are in degrees, lengths in the task's unit.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from burmester.describe import six_bar_words
from burmester.io.result import message_data
from burmester.numerics.arrays import FloatArray
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.six_bars import RULE, SixBars
from burmester.synthesis.result import Synthesis
from burmester.tasks.notation import least_angle, length_of
from burmester.web.data import poses_report, scene_of
from burmester.web.image_space import chart_of
from burmester.wording import figure

__all__ = ["six_bar_report"]

SCHEMA: Final = "burmester.six-bar-report/1"
FRAMES: Final = (
    "The frame of the coupler has its origin at C, and E on its x axis; that of the second crank "
    "its origin at B, and D on its x axis. F is the ground, M the body. The first loop transmits "
    "where the coupler meets the crank that is driven, the second one at H, from the floating link "
    "to the body."
)


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
    linkage, met = found.linkage, six_bar_words.met(synthesis, found)
    low, high = (math.degrees(each) for each in found.drive_range)
    below, above = np.degrees(found.room).tolist()
    middle = (low + high) / 2
    ends = (middle - 180, middle + 180) if found.turns_fully else (low - below, high + above)
    return {
        "id": found.id,
        "type": found.type,
        "usable": found.usable,
        "sound": not found.shortcomings,
        "driver": found.driver,
        "crank": six_bar_words.driver_name(found),
        "ground": {"A": _pair(linkage.fixed_first), "B": _pair(linkage.fixed_second)},
        "first_crank": float(linkage.first_crank),
        "coupler": {"D": _pair(linkage.coupler_joint), "E": [float(linkage.coupler_arm), 0.0]},
        "second_crank": float(linkage.second_crank),
        "crank_joint": _pair(linkage.crank_joint),
        "floating_link": float(linkage.floating_link),
        "body": {"E": _pair(linkage.body_joint), "H": _pair(linkage.link_joint)},
        "sides": [float(found.sides.first), float(found.sides.second)],
        "drive_deg": np.degrees(found.drive).tolist(),
        "ends_deg": list(ends),
        "turns_fully": found.turns_fully,
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


def _pair(point: FloatArray) -> list[float]:
    return [float(each) for each in point]
