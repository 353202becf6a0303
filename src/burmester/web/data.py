"""A synthesis as plain JSON data for a page: numbers, and the words for them.

Numbers that the page computes with keep all their significant digits; numbers that it shows come
as text, to the digits that the errors leave.  Angles in degrees where the name says so, else in
radians; lengths in the task's unit.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.cures import Face, for_command, for_page
from burmester.describe import quality_words, sentences
from burmester.describe.dimensions import (
    angle_error,
    decimals_of,
    dimensions,
    dyad_in_words,
    position_error,
    worst_errors,
)
from burmester.describe.dimensions import links as links_of
from burmester.describe.quality_words import improvements, load_notes
from burmester.dyads.selection import FoundDyad
from burmester.geometry.displacement import Displacement
from burmester.geometry.outlines import inner_point
from burmester.io.linkage_data import dyad_data, linkage_data, number
from burmester.io.pose_data import poses_data
from burmester.io.result import pose_sigma_data
from burmester.linkages.evaluation import transmission_at_given_poses
from burmester.refinement.tolerance_boxes import poses_counted
from burmester.requirements.transmission import TRANSMISSION
from burmester.synthesis.result import Synthesis
from burmester.tasks import notation
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements
from burmester.verdicts import explanation
from burmester.verdicts.explanation import share_texts
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.branches import Branches, branches_of
from burmester.web.family_map import family_map
from burmester.web.image_space import chart_of, space_of
from burmester.web.loads_data import loads_of, loads_report
from burmester.web.pivot_map import pivot_map
from burmester.wording import figure, least_angle

SCHEMA = "burmester.report/2"
KINDS = (
    "RR: a link with two pins; PR: a slider on the ground; RP: a pin on the ground in a slot of "
    "the body."
)
KEYS = [("side0", "driver (filled)"), ("side1", "follower (hollow)")]  # how links are drawn
USUAL_LIMIT = (40.0, "a usual limit")  # degrees: where designers begin to hesitate
SOUND = (TRANSMISSION.standard, "of a sound linkage")
LINKS = ("ground", "driver", "coupler", "follower")
FRAMES = 24_000  # frames of all linkages together
MOST_FRAMES, LEAST_FRAMES = 361, 61  # frames along a way
FAR = 100.0  # scenes: pivots that may be moved farther are called open
WAYS = 3  # ways of a linkage, when frames are shared out; most have no more


def report_data(synthesis: Synthesis, face: Face = for_command) -> dict[str, Any]:
    """The whole report as an object ready for JSON; face: in whose words it says what helps."""
    task, outcome = synthesis.task, synthesis.outcome
    scene = scene_of(synthesis)
    poses = _poses_taken(task, next(iter(synthesis.linkages), None))
    chart = chart_of(poses, synthesis.length or scene)
    count = max(1, len(synthesis.linkages))
    frames = int(np.clip(FRAMES // (WAYS * count), LEAST_FRAMES, MOST_FRAMES))
    linkages = [_linkage(synthesis, each, scene, frames, chart) for each in synthesis.linkages]
    return {
        "schema": SCHEMA,
        "outcome": outcome.to_dict(face),
        "best": list(sentences.best_sentences(synthesis)),
        "better": improvements(synthesis),
        "warnings": [each.to_dict(face) for each in synthesis.warnings],
        "method": synthesis.method,
        "unit": task.length_unit,
        "pose_sigma": pose_sigma_data(task),
        "poses": poses_report(task),
        "path": None if task.path is None else {"closed": task.path.closed},
        "body": None if task.body is None else task.body.vertices.tolist(),
        "keep_out": _keep_out(task),
        "loads": loads_report(task),
        "scene": scene,
        "span": synthesis.problem.motion_size,
        "motion": None
        if synthesis.motion is None
        else {
            "code": synthesis.motion.kind.code,
            "name": synthesis.motion.kind.name,
            "message": synthesis.motion.kind.message,
        },
        "certificate": None
        if synthesis.certificate is None
        else {
            "proved": list(synthesis.certificate.proved),
            "numerical": list(synthesis.certificate.numerical),
        },
        "dyads_title": sentences.dyads_title(synthesis),
        "dyads": [dyad_report(each, task) for each in synthesis.dyads],
        "linkages": linkages,
        "chart": chart,
        "space": space_of(None, poses, None, chart),
        "pivot_map": pivot_map(synthesis, scene),
        "family_map": family_map(synthesis),
        "transmission_limit": transmission_limit(task.requirements, USUAL_LIMIT),
        "keys": KEYS if linkages else [],
        "table": _table(synthesis, linkages),
        "footnotes": f"{sentences.footnotes(synthesis)} {KINDS}",
    }


def linkage_report(synthesis: Synthesis, found: FoundLinkage, frames: int) -> dict[str, Any]:
    """One linkage as `report_data` has it; frames: along each of its ways."""
    scene = scene_of(synthesis)
    poses = _poses_taken(synthesis.task, next(iter(synthesis.linkages), None))
    chart = chart_of(poses, synthesis.length or scene)
    return _linkage(synthesis, found, scene, frames, chart)


def transmission_limit(
    requirements: Requirements, usual: tuple[float, str] = SOUND
) -> dict[str, Any]:
    """The transmission angle that a plot marks: the one that is asked for, or else a usual one."""
    asked = requirements.transmission_deg
    degrees, said = (asked, "asked") if asked else usual
    return {"deg": degrees, "said": f"{figure(degrees)}°, {said}"}


def scene_of(synthesis: Synthesis) -> float:
    """The size of the drawing, in the task's unit: that of the motion."""
    size = max(notation.span(synthesis.task), synthesis.length)
    return size if size > 0 and math.isfinite(size) else 1.0


def poses_report(task: Task) -> list[dict[str, Any]]:
    """The poses of a task with their names, and their weights where it states them.

    A point of the body has no angle: None.
    """
    poses: list[dict[str, Any]] = [dict(each) for each in poses_data(task.poses)]
    for index, pose in enumerate(poses):
        own = "" if task.names is None else task.names[index]
        pose["name"] = own or str(index + 1)
        if task.free_angles[index]:
            pose["angle_deg"] = None
        if task.exact is not None and task.exact[index]:
            pose["exact"] = True
        if task.weights is not None:
            pose["weight"] = float(task.weights[index])
    return poses


def _poses_taken(task: Task, found: FoundLinkage | None) -> Displacement:
    """The poses (N,) of a task, free angles being those of a linkage, if there is one."""
    return task.poses if found is None else poses_counted(found.error.places, task)


def _keep_out(task: Task) -> list[dict[str, Any]]:
    """Regions to keep out of: name, outline in F, and a point inside where the name stands."""
    if task.surroundings is None:
        return []
    return [
        {
            "name": each.name or "",
            "outline": each.polygon.vertices.tolist(),
            "at": inner_point(each.polygon.vertices).tolist(),
        }
        for each in task.surroundings.keep_out
    ]


def dyad_report(found: FoundDyad, task: Task) -> dict[str, Any]:
    """A dyad alone: its numbers, and the words for them."""
    words = dyad_in_words(found, task)
    said = {name: text.replace("\n", " ") for name, text in words.items()}
    return {**dyad_data(found, task.poses), "said": said}


def _linkage(
    synthesis: Synthesis, found: FoundLinkage, scene: float, frames: int, chart: dict[str, Any]
) -> dict[str, Any]:
    """A linkage: its numbers, the words for them, its motion and its image space."""
    task = synthesis.task
    tolerance = synthesis.options.manufacturing_tolerance
    branches = branches_of(found, task.poses, scene, frames)
    worst, angle = worst_errors(synthesis, found)
    first, second = found.dyads_driver_first
    data = linkage_data(found, tolerance)
    unit = f" {task.length_unit}" if task.length_unit else ""
    reasons = [] if found.usable else explanation.reasons(found, task)
    free = task.angles_are_free
    turn = "free" if free else angle_error(float(np.sqrt((found.error.angle**2).mean())))
    rms = position_error(synthesis, found.error.rms)
    least = least_angle(found.driven.least_over_range)
    quality = quality_words.facts(found, task)
    texts = links_of(found, decimals_of(synthesis, found))
    links = None if found.linkage.links is None else dict(zip(LINKS, texts, strict=True))
    freedom = _freedom(synthesis, found)
    verdict = "✓ usable" if found.usable else "✕ not usable"
    driver = f"{first.id}, turns fully" if found.driven.turns_fully else first.id
    miss = _misses(worst, angle, unit)
    facts = [
        ("verdict", verdict),
        *((f"{name} link", f"{value}{unit}") for name, value in (links or {}).items()),
        ("worst miss", " and ".join(miss)),
        ("rms miss", " and ".join(_misses(rms, turn, unit))),
        ("least transmission angle", least),
        *quality.items(),
        ("driver", driver),
    ]
    if freedom:
        facts.append(("pivots", freedom.removeprefix("pivots ")))
    said = {
        "story": _story(synthesis, found, reasons, bool(branches.ways)),
        "facts": [[name, "–" if text == "-" else text] for name, text in facts],
        "met": explanation.nearness(found, task, synthesis.length),
        "reasons": reasons,
        "help": None
        if found.usable
        else explanation.hints([found], synthesis.problem, own=True).said(for_page),
        "rounded": sentences.rounding_note(synthesis, found),
        "worst": worst,
        "angle": angle,
        "rms": rms,
        "transmission": least,
        "quality": quality,
        "links": links,
        "dimensions": [each._asdict() for each in dimensions(synthesis, found)],
        "notes": [*sentences.notes(synthesis, found), *load_notes(found.loads, task)],
        # Each by its coefficients p1 to p8, on the scale that the dimensions give them.
        "manifolds": [
            [f"{value:.6g}" for value in np.asarray(each.dyad.coefficients()).tolist()]
            for each in (first, second)
        ],
    }
    return {
        **data,
        "type": found.type,
        "led": [dyad_data(each, found.error.places) for each in (first, second)],
        "card": {
            "verdict": verdict,
            "quiet": freedom,
            "reason": "; ".join(reasons) or None,
        },
        "said": said,
        "pose_errors": _pose_errors(synthesis, found, branches),
        "ways": branches.ways,
        "loads": loads_of(found, branches.ways, branches.at),
        "space": space_of(found.driver_first, _poses_taken(task, found), _places(branches), chart),
    }


def _misses(away: str, angle: str, unit: str) -> list[str]:
    """A position error with its unit, and an angle error where one counts."""
    length = away if away in ("-", "exact") else f"{away}{unit}"
    alone = away == "-" or angle == "free" or (away, angle) == ("exact", "exact")
    return [length] if alone else [length, angle]


def _story(synthesis: Synthesis, found: FoundLinkage, reasons: list[str], moves: bool) -> str:
    """The sentence under a linkage's name."""
    task, driver = synthesis.task, found.dyads_driver_first[0].id
    met = explanation.nearness(found, task, synthesis.length)
    told = f"{'Usable' if found.usable else 'Not usable'}: it {met}"
    if not moves:
        why = "; ".join(reasons) or "its motion is not known"
        return f"{told}. It cannot be shown moving: {why}."
    if found.type == "change-point":
        return (
            f"{told}, driven by {driver}. At a change point, where all links lie in one line, it "
            "may go on either way."
        )
    if found.usable:
        return f"{told}, driven by {driver}."
    return f"Not usable: it {explanation.in_short(found, task, synthesis.length)}."


def _table(synthesis: Synthesis, linkages: list[dict[str, Any]]) -> dict[str, Any]:
    """All linkages, as the page tabulates them; words: the columns of words."""
    unit = f" ({synthesis.task.length_unit})" if synthesis.task.length_unit else ""
    angle = [] if synthesis.task.angles_are_free else ["worst angle"]
    lengths = [f"{name} link" for name in LINKS]
    heads = ["", "verdict", "type", "dyads", "driver", *lengths, "worst miss", *angle]
    heads += ["least transm.", "extent", "sens.", "why not"]
    rows = []
    for each in linkages:
        said = each["said"]
        quality, links = said["quality"], said["links"] or {}
        rows.append(
            [
                *(each["id"], each["card"]["verdict"], each["type"]),
                " ".join(dyad["id"] for dyad in each["dyads"]),
                each["led"][0]["id"],
                *(links.get(name, "–") for name in LINKS),
                *(said["worst"], *([said["angle"]] if angle else []), said["transmission"]),
                quality.get("extent", "–").split(" ")[0],
                quality.get("sensitivity", "–"),
                "; ".join(said["reasons"]) or "–",
            ]
        )
    words = [1, 2, 3, 4, len(heads) - 1]
    return {"caption": f"All linkages{unit}", "heads": heads, "words": words, "rows": rows}


def _freedom(synthesis: Synthesis, found: FoundLinkage) -> str | None:
    """How far the pivots of a usable linkage may be moved, where the poses leave them open."""
    if not found.usable or found.determined:
        return None
    widest = max((each.half_width for each in found.uncertainty or ()), default=math.inf)
    if not widest <= FAR * scene_of(synthesis):
        return "pivots left open by the poses"
    return f"pivots may be moved by ±{notation.length_of(widest, synthesis.task)}"


def _pose_errors(
    synthesis: Synthesis, found: FoundLinkage, branches: Branches
) -> list[dict[str, Any]]:
    """At each pose: the place of the coupler, its errors, and the frame of a way where it is."""
    task, error = synthesis.task, found.error
    transmission = np.degrees(transmission_at_given_poses(found, synthesis.problem)).tolist()
    used = None if found.within_tolerance is None else share_texts(found, task)
    rows = []
    for pose, at in enumerate(branches.at):
        turned, least = float(error.angle[pose]), transmission[pose]
        said = {
            "position": position_error(synthesis, float(error.position[pose])),
            "turned": "free" if task.free_angles[pose] else angle_error(turned),
            "transmission": f"{least:.1f}°" if math.isfinite(least) else "-",
        }
        if used is not None:
            x, y, turn = used[pose]
            for key, share in (("position", f"{x} | {y}"), ("turned", turn)):
                if set(share.split(" | ")) != {said[key]}:
                    said[key] += f" ({share})"
        way, frame = at or (None, None)
        rows.append(
            {
                "x": number(error.places.translation[pose, 0]),
                "y": number(error.places.translation[pose, 1]),
                "angle_deg": number(math.degrees(error.places.angle[pose])),
                "position": number(error.position[pose]),
                "turned_deg": number(math.degrees(turned)),
                "transmission_deg": number(least),
                "way": way,
                "frame": frame,
                "said": said,
            }
        )
    return rows


def _places(branches: Branches) -> Displacement | None:
    """Places of the coupler along the way with most poses."""
    if not branches.ways:
        return None
    way = max(branches.ways, key=lambda each: len(each["poses"]))
    return Displacement(np.stack([way["x"], way["y"]], axis=-1), np.array(way["angle"]))
