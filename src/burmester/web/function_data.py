"""A function synthesis as plain JSON data for a page: its generators with their curves and motion.

Angles are in degrees; the drive of a way is the input.  Each generator has a scene of its own, in
which its coupler is the body that moves; the stops of its player are the pairs, or even places
where these are many.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from burmester.describe import generator_words as words
from burmester.functions.found_generator import FoundGenerator
from burmester.io.linkage_data import numbers
from burmester.io.pose_data import poses_data
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.function_generation import FunctionSynthesis, coupler_synthesis
from burmester.tasks.function_task import FunctionTask
from burmester.web.data import linkage_report, scene_of, transmission_limit
from burmester.web.image_space import chart_of
from burmester.wording import figure

SCHEMA: Final = "burmester.function-report/2"
MOST: Final = 8  # generators that are shown
FRAMES: Final = 361  # along the way of each
MOST_DOTS: Final = 40  # pairs whose dots stand on a curve
MOST_ROWS: Final = 30  # pairs; more of them are there to unfold
MOST_STOPS: Final = 13  # pairs that the player stops at; of more, even places


def function_report(synthesis: FunctionSynthesis) -> dict[str, Any]:
    """The whole report as an object ready for JSON."""
    task = synthesis.task
    shown = synthesis.leading(MOST)
    rest = len(synthesis.generators) - len(shown)
    more = f" {len(shown)} of {len(synthesis.generators)} are shown." if rest else ""
    linkages = [_generator(synthesis, each) for each in shown]
    asked = [f"{name.capitalize()}: {text}." for name, text in words.facts(task)]
    return {
        "schema": SCHEMA,
        "outcome": synthesis.outcome.to_dict(),
        "best": words.best_sentences(synthesis) + asked,
        "warnings": [each.to_dict() for each in synthesis.warnings],
        "overline": "function report",
        "whole": True,
        "stop": "place",
        "transmission_limit": transmission_limit(task.requirements),
        "keys": [("side0", "input link (filled)"), ("side1", "output link (hollow)")],
        "linkages": linkages,
        "table": {
            "caption": "All linkages, best first",
            "heads": words.HEADS,
            "words": [1, len(words.HEADS) - 1],
            "rows": [words.row(synthesis, each) for each in shown],
        },
        "footnotes": "Angles are from the ground link, counter-clockwise, and counted from where "
        "input and output are 0. The structural error is the output that the linkage makes, less "
        f"the one that is wanted.{more}",
    }


def _generator(synthesis: FunctionSynthesis, found: FoundGenerator) -> dict[str, Any]:
    """A generator as a linkage that guides its coupler, with its own words and curves."""
    task, transmission = found.task, words.transmission(found)
    lacks = "; ".join(each.message for each in found.faults)
    report, picture = _motion(found)
    pairs = words.pair_rows(found)
    way = report["ways"][0] if report["ways"] else {"drive": [], "output": []}
    dots = np.degrees(np.stack([task.inputs, task.outputs], axis=1)).tolist()
    dots = dots if len(dots) <= MOST_DOTS else []
    title = "output (°)" + (", wanted as dots" if dots else "")
    transmits = {"–": "–", "0°": "down to 0°"}.get(transmission, f"{transmission} or more")
    links = [f"{name} {length:.4g}" for name, length in found.lengths.items()]
    reasons = "; ".join(filter(None, (lacks, *found.shortcomings)))
    return {
        **report,
        "id": found.id,
        "type": found.type,
        "usable": found.usable,
        "picture": picture,
        "panels": [
            {"title": title, "x": way["drive"], "y": way["output"], "dots": dots},
            _error_panel(found),
        ],
        "card": {
            "verdict": "✓ usable" if found.usable else "✕ not usable",
            "facts": [
                ["greatest error", words.angle(found.max_error)],
                ["transmission", transmits],
                ["links", links],
            ],
            "reason": f"It {reasons}" if reasons else None,
        },
        "said": {
            "story": f"Usable: it {words.miss(found)}." if found.usable else f"It {lacks}.",
            "facts": [
                *words.dimension_rows(found),
                ("least transmission angle", transmission),
                ("longest link / shortest", figure(float(found.generator.link_ratio))),
            ],
            "notes": words.notes(synthesis, found),
        },
        "tables": [],
        "stops": {
            "caption": f"Pairs of angles, and what {found.id} makes of them",
            "heads": words.PAIR_HEADS,
            "rows": pairs,
            "class": "bm-pair-table",
            "folded": f"{len(pairs)} pairs" if len(pairs) > MOST_ROWS else None,
        },
    }


def _error_panel(found: FoundGenerator) -> dict[str, Any]:
    """The structural error: of a function along the range, else at the pairs."""
    task = found.task
    inputs, errors = np.degrees(task.inputs).tolist(), numbers(np.degrees(found.errors))
    pairs = zip(inputs, errors, strict=True) if len(inputs) <= MOST_DOTS else ()
    whole = task.function is not None
    return {
        "title": "structural error (°)" + ("" if whole else ", at the pairs"),
        "x": np.degrees(task.compared()[0]).tolist(),
        "y": numbers(np.degrees(found.range_errors)),
        "dots": [each for each in pairs if each[1] is not None],
        "stems": not whole,
    }


def _motion(found: FoundGenerator) -> tuple[dict[str, Any], dict[str, Any]]:
    """The linkage whose body is the coupler, on the way that it takes, and the scene around it."""
    task = found.task
    stops, names = _stops(task)
    known = np.isfinite(found.generator.outputs(stops))
    judged = coupler_synthesis(found, stops[known])
    (linkage,) = judged.linkages
    report = linkage_report(judged, linkage, FRAMES)
    del report["space"]
    _keep_one_way(report)
    for way in report["ways"]:
        _count_inputs(way, found)
    numbered = {name: k for k, name in enumerate(map(str, range(1, len(task.inputs) + 1)))}
    poses: list[dict[str, Any]] = [dict(each) for each in poses_data(judged.task.poses)]
    for pose, name in zip(poses, (names[k] for k in np.flatnonzero(known)), strict=True):
        row = numbered.get(name)
        called = name if row is None else f"pair {name}"
        pose |= {"name": name, "row": row, "called": called}
    scene = scene_of(judged)
    chart = chart_of(judged.task.poses, judged.length or scene)
    return report, {"poses": poses, "scene": scene, "chart": chart}


def _count_inputs(way: dict[str, Any], found: FoundGenerator) -> None:
    """Let the drive of a way be the input, in degrees, and put the output beside it."""
    task = found.task
    drive = np.array(way["drive"]) - math.degrees(float(found.generator.input_phase))
    middle = math.degrees(sum(task.input_ends) / 2)
    at = int(np.abs((drive - middle + 180) % 360 - 180).argmin())
    drive -= 360 * np.round((drive[at] - middle) / 360)
    output = found.generator.outputs(np.radians(drive))
    known = np.flatnonzero(np.isfinite(output))
    output = np.degrees(
        np.unwrap(np.interp(np.arange(len(drive)), known, np.unwrap(output[known])))
    )
    inputs, wanted = task.compared()
    near = math.degrees(wanted[int(np.abs(inputs - math.radians(drive[at])).argmin())])
    output -= 360 * np.round((output[at] - near) / 360)
    way["drive"], way["output"] = drive.tolist(), output.tolist()
    way["told"] = [
        {"name": "input", "digits": 2, "values": way["drive"]},
        {"name": "output", "digits": 3, "values": way["output"], "panel": 1},
    ]


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
