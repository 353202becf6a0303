"""A function synthesis as plain JSON data for a page: its generators with their curves and motion.

Angles are in degrees.  Each generator has a scene of its own, in which its coupler is the body that
moves; the stops of its player are the pairs, or even places where these are many.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from burmester.functions.found_generator import FoundGenerator
from burmester.functions.function_task import FunctionTask
from burmester.io.linkage_data import number
from burmester.io.pose_data import poses_data
from burmester.io.result import message_data
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.function_generation import FunctionSynthesis, coupler_synthesis
from burmester.web.data import linkage_report, scene_of
from burmester.web.image_space import chart_of
from burmester.wording import figure, with_article

__all__ = ["function_report"]

SCHEMA: Final = "burmester.function-report/1"
MOST: Final = 8  # generators that are shown
FRAMES: Final = 181  # along the way of each
MOST_STOPS: Final = 13  # pairs that the player stops at; of more, even places
EXACT: Final = 1e-9  # radians; an error below is rounding


def function_report(synthesis: FunctionSynthesis) -> dict[str, Any]:
    """The whole report as an object ready for JSON."""
    task = synthesis.task
    shown = synthesis.leading(MOST)
    rest = len(synthesis.generators) - len(shown)
    more = f" {len(shown)} of {len(synthesis.generators)} are shown." if rest else ""
    return {
        "schema": SCHEMA,
        "outcome": message_data(synthesis.outcome),
        "best": _best(synthesis),
        "warnings": list(map(message_data, synthesis.warnings)),
        "asked_transmission_deg": task.requirements.transmission_deg or None,
        "generators": [_generator(each, task) for each in shown],
        "footnotes": "Angles are from the ground link, counter-clockwise, and counted from where "
        "input and output are 0. The structural error is the output that the linkage makes, less "
        f"the one that is wanted.{more}",
    }


def _best(synthesis: FunctionSynthesis) -> list[str]:
    """What to build, in a sentence, and what is asked, in another."""
    task = synthesis.task
    wanted = [_asked(task)]
    if not synthesis.usable:
        return wanted
    found = synthesis.usable[0]
    price = [synthesis.price_note] if synthesis.price_note else []
    return [f"{found.id}, {with_article(found.type)}, {_miss(found, task)}.", *price, *wanted]


def _asked(task: FunctionTask) -> str:
    low, high = task.input_ends
    turn, made = figure(math.degrees(high - low)), figure(math.degrees(task.output_span))
    if (function := task.function) is not None:
        x = f"x from {function.x[0]:g} to {function.x[1]:g}"
        way = ", against it" if function.output_range < 0 else ""
        text = f"y = {function.text}, {x}"
        return f"Wanted: {text}; the input link turns by {turn}°, the output link by {made}°{way}."
    pairs = len(task.inputs)
    return f"Wanted: {pairs} pairs of angles; the input turns by {turn}°, the output by {made}°."


def _miss(found: FoundGenerator, task: FunctionTask) -> str:
    where = "over the range" if task.function else "at the pairs"
    if not math.isfinite(found.max_error):
        return "cannot be assembled everywhere"
    if found.max_error < EXACT:
        return "meets all pairs exactly"
    share = figure(100 * found.max_error / task.output_span)
    return f"misses by {_angle(found.max_error)} at most {where}, {share} % of the output's range"


def _generator(found: FoundGenerator, task: FunctionTask) -> dict[str, Any]:
    one, ground = found.generator, task.ground
    low, high = task.input_ends
    inputs, wanted = task.compared()
    return {
        "id": found.id,
        "type": found.type,
        "usable": found.usable,
        "defects": [each.message for each in found.defects],
        "shortcomings": list(found.shortcomings),
        "range": {"low": math.degrees(low), "high": math.degrees(high)},
        "ground": ground,
        "input_link": float(one.input_link) * ground,
        "coupler": float(one.coupler) * ground,
        "output_link": float(one.output_link) * ground,
        "side": float(one.side),
        "input_phase": math.degrees(float(one.input_phase)),
        "output_phase": math.degrees(float(one.output_phase)),
        "curve": {
            "whole": task.function is not None,
            "input": np.degrees(inputs).tolist(),
            "wanted": np.degrees(wanted).tolist(),
            "error": [number(each) for each in np.degrees(found.range_errors).tolist()],
        },
        "pair_at": [
            {"pair": k + 1, "input": x, "wanted": y, "error": number(e)}
            for k, (x, y, e) in enumerate(zip(*_pair_degrees(found, task), strict=True))
        ],
        "pairs": _pair_texts(found, task),
        "said": _said(found, task),
        "motion": _motion(found, task),
    }


def _pair_degrees(found: FoundGenerator, task: FunctionTask) -> tuple[list[float], ...]:
    return tuple(np.degrees(v).tolist() for v in (task.inputs, task.outputs, found.errors))


def _pair_texts(found: FoundGenerator, task: FunctionTask) -> list[list[str]]:
    """Input, output wanted, output made and error of each pair."""
    rows = []
    for x, y, error in zip(*_pair_degrees(found, task), strict=True):
        made = f"{round(y + error, 4) + 0.0:.4f}°" if math.isfinite(error) else "–"
        rows.append([f"{x:.6g}°", f"{y:.6g}°", made, _angle(math.radians(error))])
    return rows


def _angle(angle: float) -> str:
    """An angle in degrees, to two digits."""
    if not math.isfinite(angle):
        return "–"
    return "exact" if abs(angle) < EXACT else f"{figure(math.degrees(angle))}°"


def _said(found: FoundGenerator, task: FunctionTask) -> dict[str, Any]:
    """The figures of a generator in words."""
    one, ground = found.generator, task.ground
    names = ("ground link", "input link", "coupler", "output link")
    lengths = (1.0, float(one.input_link), float(one.coupler), float(one.output_link))
    least = found.least_transmission
    transmission = f"{math.degrees(least):.0f}°" if math.isfinite(least) else "–"
    percent = 100 * found.max_error / task.output_span
    share = f"{figure(percent)} %" if math.isfinite(percent) else "–"
    share = "0 %" if found.max_error < EXACT else share
    reasons = [each.message for each in found.defects]
    story = f"Usable: it {_miss(found, task)}." if found.usable else f"It {'; '.join(reasons)}."
    return {
        "story": story,
        "links": [
            [name, f"{length * ground:.6g}"] for name, length in zip(names, lengths, strict=True)
        ],
        "placed": [
            ["input link, at input 0", f"{math.degrees(float(one.input_phase)) % 360:.4f}°"],
            ["output link, at output 0", f"{math.degrees(float(one.output_phase)) % 360:.4f}°"],
            ["output pin, from input pin to output pivot", "left" if one.side > 0 else "right"],
        ],
        "figures": [
            ["greatest error", _angle(found.max_error)],
            ["of the output's range", share],
            ["rms error", _angle(found.rms_error)],
            ["least transmission angle", transmission],
            ["longest link / shortest", figure(float(one.link_ratio))],
            ["diagonal of the box of all pivots", figure(found.extent * ground)],
        ],
        "max_error": _angle(found.max_error),
        "rms_error": _angle(found.rms_error),
        "percent": share,
        "transmission": transmission,
    }


def _motion(found: FoundGenerator, task: FunctionTask) -> dict[str, Any]:
    """The scene in which the coupler is the body, with one linkage and the way that it takes."""
    stops, names = _stops(task)
    known = np.isfinite(found.generator.outputs(stops))
    judged = coupler_synthesis(task, found, stops[known])
    (linkage,) = judged.linkages
    report = linkage_report(judged, linkage, FRAMES)
    del report["space"]
    _keep_one_way(report)
    poses: list[dict[str, Any]] = [dict(each) for each in poses_data(judged.task.poses)]
    kept = [k for k, good in enumerate(known) if good]
    for pose, k in zip(poses, kept, strict=True):
        pose |= {"name": names[k], "input_deg": math.degrees(stops[k])}
    scene = scene_of(judged)
    return {
        "unit": None,
        "poses": poses,
        "body": None,
        "keep_out": [],
        "scene": scene,
        "chart": chart_of(judged.task.poses, judged.length or scene),
        "linkages": [report],
    }


def _stops(task: FunctionTask) -> tuple[FloatArray, list[str]]:
    """The inputs at which the player stops, rising, and their names."""
    if len(task.inputs) > MOST_STOPS:
        stops = np.linspace(*task.input_ends, MOST_STOPS)
        return stops, [f"{figure(each)}°" for each in np.degrees(stops).tolist()]
    named = [(float(each), str(k + 1)) for k, each in enumerate(task.inputs)]
    if task.function is not None:
        spare = 1e-9 * task.function.input_range
        for end, name in zip(task.input_ends, ("start", "end"), strict=True):
            if np.abs(task.inputs - end).min() > spare:
                named.append((end, name))
    named.sort()
    return np.array([each for each, _ in named]), [name for _, name in named]


def _keep_one_way(report: dict[str, Any]) -> None:
    """Leave the way with most of the stops, for the pairs are on one branch or not met."""
    ways = report["ways"]
    if not ways:
        return
    chosen = max(range(len(ways)), key=lambda k: len(ways[k]["poses"]))
    report["ways"] = [ways[chosen]]
    for row in report["pose_errors"]:
        row["way"] = 0 if row["way"] == chosen else None
        row["frame"] = row["frame"] if row["way"] == 0 else None
