"""What the report shows of a synthesis, as plain JSON data: numbers, and the words for them.

Numbers that the page computes with keep all the digits that mean something; numbers that it shows
come as text, to the digits that the errors leave.  Angles in degrees where the name says so, else
in radians; lengths in the task's unit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from rich.text import Text

from burmester.describe import digits
from burmester.dyads.pivot_map import fixed_pivot_map, grid
from burmester.dyads.selection import FoundDyad
from burmester.fourbar.dyad import PP, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.io import linkage_table
from burmester.io.linkage_data import dyad_data, linkage_data, number, poses_data
from burmester.io.result import told
from burmester.linkages import explanation
from burmester.linkages.found_linkage import FoundLinkage
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import Synthesis
from burmester.tasks import wording
from burmester.tasks.motion_task import Task
from burmester.web.branches import Motion, motion_of
from burmester.web.image_space import chart_of, space_of

__all__ = ["report_data"]

SCHEMA = "burmester.report/1"
FRAMES = 24_000  # of all linkages together
MOST, LEAST = 361, 61  # frames along a way
WAYS = 3  # of a linkage, for sharing the frames out
COLUMNS, ROWS = 96, 72  # of the pivot map
AROUND = 0.6  # of the scene, that the map reaches beyond it
PIVOTS = 2.0  # of the scene, beyond which a pivot does not widen the map
EXACT = 1e-9  # of the scene: an error below it is rounding
MOSTLY = 0.5  # of the map
MAPPED = 4  # poses that a pivot map takes


def report_data(synthesis: Synthesis) -> dict[str, Any]:
    """The whole report as an object ready for JSON."""
    task, outcome = synthesis.task, synthesis.outcome
    scene = _scene(synthesis)
    chart = chart_of(task.poses, synthesis.length or scene)
    count = max(1, len(synthesis.linkages))
    frames = int(np.clip(FRAMES // (WAYS * count), LEAST, MOST))
    linkages = [_linkage(synthesis, each, scene, frames, chart) for each in synthesis.linkages]
    return {
        "schema": SCHEMA,
        "outcome": told(outcome),
        "best": [text.plain for text in linkage_table.best_sentences(synthesis)]
        if synthesis.usable
        else [],
        "warnings": list(map(told, synthesis.warnings)),
        "method": synthesis.method,
        "unit": task.length_unit,
        "poses": _poses(task),
        "scene": scene,
        "motion": None
        if synthesis.motion is None
        else {
            "code": synthesis.motion.kind.code,
            "name": synthesis.motion.kind.name,
            "message": synthesis.motion.kind.message,
        },
        "dyads": [_dyad(synthesis, each) for each in synthesis.dyads],
        "linkages": linkages,
        "chart": chart,
        "space": space_of(None, task.poses, None, chart),
        "pivot_map": _pivot_map(synthesis, scene),
        "footnotes": linkage_table.footnotes(synthesis),
    }


def _scene(synthesis: Synthesis) -> float:
    """The size of what is drawn, in the task's unit: that of the motion."""
    size = max(wording.span(synthesis.task), synthesis.length)
    return size if size > 0 and math.isfinite(size) else 1.0


def _poses(task: Task) -> list[dict[str, Any]]:
    poses: list[dict[str, Any]] = [dict(each) for each in poses_data(task.poses)]
    for index, pose in enumerate(poses):
        own = "" if task.names is None else task.names[index]
        pose["name"] = own or str(index + 1)
        if task.exact is not None and task.exact[index]:
            pose["exact"] = True
        if task.weights is not None:
            pose["weight"] = float(task.weights[index])
    return poses


def _dyad(synthesis: Synthesis, found: FoundDyad) -> dict[str, Any]:
    """A dyad on its own, and how it is written."""
    places = digits.decimals(synthesis, found.rms_error)
    ground, body, length = digits.sides(found.dyad, places)
    return {
        **dyad_data(found),
        "said": {
            "ground": ground.replace("\n", " "),
            "body": body.replace("\n", " "),
            "length": length,
            "rms": digits.miss(synthesis, found.rms_error),
            "worst": digits.miss(synthesis, found.max_error),
        },
    }


def _linkage(
    synthesis: Synthesis, found: FoundLinkage, scene: float, frames: int, chart: dict[str, Any]
) -> dict[str, Any]:
    """A linkage with all that is said of it, how it moves, and its image space."""
    task = synthesis.task
    tolerance = synthesis.options.manufacturing_tolerance
    motion = motion_of(found, task.poses, scene, frames)
    worst, turned = digits.misses(synthesis, found)
    first, second = found.dyads if found.preferred_driver == "first" else found.dyads[::-1]
    data = linkage_data(found, tolerance)
    return {
        **data,
        "type": found.type,
        "led": [dyad_data(first), dyad_data(second)],
        "said": {
            "verdict": "usable" if found.usable else "not usable",
            "met": explanation.met(found, task, synthesis.length),
            "in_short": explanation.in_short(found, task, synthesis.length),
            "reasons": [] if found.usable else explanation.reasons(found, task),
            "worst": worst,
            "angle": turned,
            "rms": _off(synthesis, found.error.rms),
            "rms_angle": _turned(float(np.sqrt((found.error.angle**2).mean()))),
            "transmission": wording.least_angle(found.driven.least_over_range),
            "turns_fully": found.driven.turns_fully,
            "links": _links(synthesis, found),
            "dimensions": _dimensions(synthesis, found),
            "notes": _notes(synthesis, found),
            "manifolds": [_manifold(each.dyad) for each in (first, second)],
        },
        "pose_errors": _pose_errors(synthesis, found, motion),
        "ways": motion.ways,
        "space": space_of(found.driver_first, task.poses, _all_places(motion), chart),
    }


def _links(synthesis: Synthesis, found: FoundLinkage) -> dict[str, str] | None:
    if found.linkage.links is None:
        return None
    names = ("ground", "driver", "coupler", "follower")
    return dict(zip(names, digits.links(synthesis, found), strict=True))


def _dimensions(synthesis: Synthesis, found: FoundLinkage) -> list[dict[str, str]]:
    """Every dimension of both dyads: what it is, its value, and how certain it is."""
    certain = not any(synthesis.task.resolution) or found.error_before_rounding is not None
    regions = found.uncertainty or (None, None)
    rows = []
    for dyad, region in zip(found.dyads, regions, strict=True):
        known = None if certain else region
        if isinstance(dyad.dyad, PP):
            angle = f"{math.degrees(dyad.dyad.angle):.2f}°"
            rows.append({"dyad": dyad.id, "what": "angle kept", "value": angle, "give": ""})
        for what, value, plus_minus in digits.parts(synthesis, found, dyad.dyad, known):
            give = "" if known is None else plus_minus
            rows.append({"dyad": dyad.id, "what": what, "value": value, "give": give})
    return rows


def _manifold(dyad: Dyad) -> list[str]:
    """The eight coefficients, as they come from the dimensions."""
    return [f"{value:.6g}" for value in np.asarray(dyad.coefficients()).tolist()]


def _notes(synthesis: Synthesis, found: FoundLinkage) -> list[str]:
    """What is to be said under the dimensions: of uncertainty, tolerance and rounding."""
    alone = replace(synthesis, linkages=(replace(found, usable=True),))
    parts = list(linkage_table.dimensions(alone))[1:]
    return [part.plain for part in parts if isinstance(part, Text)]


def _pose_errors(synthesis: Synthesis, found: FoundLinkage, motion: Motion) -> list[dict[str, Any]]:
    """At each pose: the place of the coupler, how far it is from it, and where that is."""
    error, transmission = found.error, found.driven.transmission
    rows = []
    for pose, at in enumerate(motion.at):
        x, y = error.places.translation[pose]
        row: dict[str, Any] = {
            "x": number(x),
            "y": number(y),
            "angle_deg": number(math.degrees(error.places.angle[pose])),
            "position": number(error.position[pose]),
            "turned_deg": number(math.degrees(error.angle[pose])),
            "transmission_deg": number(math.degrees(transmission[pose])),
            "way": None if at is None else at[0],
            "frame": None if at is None else at[1],
        }
        row["said"] = {
            "position": _off(synthesis, float(error.position[pose])),
            "turned": _turned(float(error.angle[pose])),
            "transmission": f"{math.degrees(transmission[pose]):.1f}°"
            if math.isfinite(transmission[pose])
            else "-",
        }
        rows.append(row)
    return rows


def _off(synthesis: Synthesis, error: float) -> str:
    return "exact" if error < ROUNDING * (synthesis.length or 1.0) else wording.figure(error)


def _turned(angle: float) -> str:
    if angle < ROUNDING:
        return "exact"
    return f"{wording.figure(math.degrees(angle))}°" if math.isfinite(angle) else "-"


def _all_places(motion: Motion) -> Displacement | None:
    """The coupler's places along the way with most poses."""
    if not motion.ways:
        return None
    way = max(motion.ways, key=lambda each: len(each["poses"]))
    return Displacement(np.stack([way["x"], way["y"]], axis=-1), np.array(way["angle"]))


def _pivot_map(synthesis: Synthesis, scene: float) -> dict[str, Any] | None:
    """For fixed pivots all around: log10 of the least rms error of a link."""
    task = synthesis.task
    if task.poses.shape[0] < MAPPED:
        return None
    at = task.poses.translation
    low, high = at.min(axis=0), at.max(axis=0)
    middle = (low + high) / 2
    pivots = _fixed_pivots(synthesis.linkages, synthesis.dyads)
    near = pivots[(np.abs(pivots - middle) <= PIVOTS * scene).all(axis=-1)]
    if len(near):
        low, high = np.minimum(low, near.min(axis=0)), np.maximum(high, near.max(axis=0))
    low, high = low - AROUND * scene / 2, high + AROUND * scene / 2
    # As wide as the picture is.
    centre, half = (low + high) / 2, (high - low) / 2
    half = np.maximum(half, half[::-1] * np.array([COLUMNS / ROWS, ROWS / COLUMNS]))
    low, high = centre - half, centre + half
    points = grid(low, high, COLUMNS, ROWS)
    rms = fixed_pivot_map(task.poses, points, task.weights).rms_error
    if (~(rms >= EXACT * scene)).mean() > MOSTLY:
        return None  # most places will do, or nothing is told of them: a translation, a turn
    levels = np.log10(np.maximum(rms, EXACT * scene))
    flat = [None if math.isnan(each) else round(each, 3) for each in levels.ravel().tolist()]
    return {
        "low": low.tolist(),
        "high": high.tolist(),
        "columns": COLUMNS,
        "rows": ROWS,
        "log10_rms": flat,
    }


def _fixed_pivots(linkages: Sequence[FoundLinkage], dyads: Sequence[FoundDyad]) -> np.ndarray:
    """Those of all dyads (n, 2)."""
    every = [*dyads, *(dyad for found in linkages for dyad in found.dyads)]
    points = [each.dyad.fixed_pivot for each in every if isinstance(each.dyad, RR | RP)]
    return np.array(points).reshape(-1, 2)
