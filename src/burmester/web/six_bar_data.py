"""Six-bars as plain JSON data for a page: where their joints are along the branch, and the words.

Angles of the driver are in degrees, lengths in the task's unit.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from burmester.describe import six_bar_words
from burmester.describe.quality_words import load_notes
from burmester.mechanisms.transmission import transmission_angles
from burmester.numerics.arrays import FloatArray, complex_of
from burmester.sixbar.six_bars import RULE
from burmester.synthesis.result import Synthesis
from burmester.tasks.notation import length_of
from burmester.web.data import poses_report, scene_of, transmission_limit
from burmester.web.image_space import chart_of
from burmester.web.loads_data import loads_of, loads_report
from burmester.wording import figure, least_angle

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

SCHEMA: Final = "burmester.six-bar-report/2"
LINKS: Final = (
    "F is the ground, M the body. The frame of another link has its origin at one of its joints, "
    "and another one on its x axis. Links transmit by the angle between them at a joint that both "
    "hold."
)
FRAMES: Final = 360  # for each turn of the driver
DIGITS: Final = 10  # significant ones of a place, counted from the size of the scene
END: Final = 2e-5  # of a branch; nearer to a dead point rounding decides whether loops are closed


def six_bar_report(synthesis: Synthesis) -> dict[str, Any]:
    """The whole report as an object ready for JSON."""
    task, result = synthesis.task, synthesis.six_bars
    found = () if result is None else result.found
    scene = scene_of(synthesis)
    # What to build; what else is to be said of it stands beside its picture.
    best = [f"{six_bar_words.headline(each)}." for each in found[:1]]
    best += [six_bar_words.sentences(synthesis, each)[1] for each in found[:1] if each.usable]
    rule = "" if result is None or result.given else f"{RULE[0].upper()}{RULE[1:]}. "
    return {
        "schema": SCHEMA,
        "outcome": synthesis.outcome.to_dict(),
        "best": best,
        "warnings": [each.to_dict() for each in synthesis.warnings],
        "unit": task.length_unit,
        "poses": poses_report(task),
        "body": None if task.body is None else task.body.vertices.tolist(),
        "loads": loads_report(task),
        "scene": scene,
        "whole": True,
        "chart": chart_of(task.poses, synthesis.length or scene),
        "transmission_limit": transmission_limit(task.requirements),
        "keys": _keys(found),
        "linkages": [_six_bar(synthesis, each, scene) for each in found],
        "table": {
            "caption": "All six-bars, best first",
            "heads": ["", *six_bar_words.HEADS[1:], "falls short"],
            "words": [1, len(six_bar_words.HEADS)],
            "rows": [
                [*six_bar_words.row(synthesis, each), "; ".join(each.shortcomings) or "–"]
                for each in found
            ],
        },
        "footnotes": f"{rule}{LINKS}" if found else "",
    }


def _keys(found: tuple[FoundSixBar, ...]) -> list[tuple[str, str]]:
    """How links are drawn, and what those are."""
    if not found:
        return []
    skeleton, body = found[0].skeleton, found[0].carries
    inner = "links between"
    if {(each.type, each.carries) for each in found} == {(skeleton.name, body)}:
        cranks = {skeleton.crank(pivot) for pivot in skeleton.links[skeleton.ground]}
        links = [each for each in skeleton.moving if each != body and each not in cranks]
        inner = " and ".join(" ".join(dict.fromkeys((e, skeleton.links[e]))) for e in links)
    several = len(skeleton.links[skeleton.ground]) > 2
    return [
        ("side0", "driver (filled)"),
        ("side1", f"other crank{'s' if several else ''} (hollow)"),
        ("inner", inner),
        ("carried", "body, with its frame M"),
    ]


def _six_bar(synthesis: Synthesis, found: FoundSixBar, scene: float) -> dict[str, Any]:
    words, skeleton = six_bar_words, found.skeleton
    row, told = words.row(synthesis, found), words.sentences(synthesis, found)
    met = words.met(synthesis, found)
    legs = skeleton.legs(found.driver_pivot)
    tips = [", ".join(dict.fromkeys(leg[1] for leg in group)) for group in legs]
    which = ("first loop, ", "second loop, ") if len(tips) > 1 else ("the least, ",)
    lacks = f"It {'; '.join(found.shortcomings)}" if found.shortcomings else None
    turn = ", turns fully" if found.turns_fully else f", by {row[2]}"
    works = "works, sound" if not found.shortcomings else "works"
    least = least_angle(found.transmission)
    cranks = sorted(skeleton.links[skeleton.ground], key=lambda each: each != found.driver_pivot)
    ground = found.frames[skeleton.ground]
    way, frame = _way(found, scene)
    transmits = np.degrees(_transmission(found, found.drive))
    drives = np.degrees(found.drive).tolist()
    misses = words.errors(synthesis, found) if met else [("exact", "exact")] * len(drives)
    places = found.body(found.drive)
    return {
        "id": found.id,
        "type": found.type,
        "usable": found.usable,
        "crank": f"{words.driver_name(found)} ",
        "led": [
            {"id": skeleton.arm(each), "name": each, "kind": "crank", "fixed_pivot": _pair(at)}
            for each, at in ((each, ground[each]) for each in cranks)
        ],
        "ground": {name: _pair(at) for name, at in ground.items()},
        **_drawn(found),
        "ways": [way],
        "loads": loads_of(found, [way], [(0, each) for each in frame]),
        "loops": [f"{name}at {tip}" for name, tip in zip(which, tips, strict=False)],
        "pose_errors": [
            {
                "x": x,
                "y": y,
                "angle_deg": math.degrees(angle),
                "position": float(found.error.position[k]),
                "way": 0,
                "frame": frame[k],
                "loops": transmits[:, k].tolist(),
                "said": {"position": misses[k][0], "turned": misses[k][1]},
            }
            for k, (x, y, angle) in enumerate(
                zip(*places.translation.T.tolist(), places.angle.tolist(), strict=True)
            )
        ],
        "columns": [
            [f"driver {words.driver_name(found)}", [f"{each:.1f}°" for each in drives]],
            *(
                [f"{'' if k else 'transm. '}at {tip}", [f"{each:.1f}°" for each in transmits[k]]]
                for k, tip in enumerate(tips)
            ),
        ],
        "card": {
            "verdict": f"✓ {works}" if found.usable else "✕ does not work",
            "facts": [
                ["driver", row[1] + turn],
                ["transmission", f"{least} or more"],
                ["extent", length_of(found.extent, synthesis.task)],
                ["link ratio", figure(found.link_ratio)],
            ],
            "reason": lacks if found.usable else told[1],
        },
        "said": {
            "story": " ".join(told[::2]),
            "facts": [
                *zip(words.HEADS[1:], row[1:], strict=True),
                ("at the poses", met or "exact, up to rounding"),
            ],
            "notes": load_notes(found.loads, found.task),
        },
        "tables": [
            {
                "caption": f"Dimensions of {found.id}",
                "heads": ["link", "joints, or length"],
                "words": [0],
                "lengths": True,
                "rows": [
                    [link, [each for each in joints if each]]
                    for link, *joints in words.dimension_rows(found)
                ],
                "class": "bm-dimensions bm-joints",
            },
            {
                "caption": f"Distances between joints of {found.id}",
                "heads": ["joints", "distance"],
                "words": [0],
                "lengths": True,
                "rows": words.distances(found),
                "folded": "Distances between joints",
            },
        ],
    }


def _drawn(found: FoundSixBar) -> dict[str, Any]:
    """How links are drawn, the lowest first; beside which link a joint's name stands.

    traced: the joints of the body, whose paths are drawn.
    """
    skeleton, body = found.skeleton, found.carries
    outlines = skeleton.corners(found.frames, body)
    ground = skeleton.links[skeleton.ground]
    kinds = {skeleton.crank(pivot): "side1" for pivot in ground}
    kinds |= {skeleton.crank(found.driver_pivot): "side0", body: "carried"}

    def height(link: str) -> int:
        return 2 if link == body else 0 if len(outlines[link]) > 2 else 1

    def beside(joint: str) -> str:
        own = [each for each in skeleton.links_of(joint) if each != skeleton.ground]
        others = [each for each in own if each != body]
        plates = [each for each in others if len(skeleton.links[each]) > 2]
        return skeleton.links[(*plates, *others, *own)[0]]

    return {
        "drawn": [
            {"joints": outlines[link], "kind": kinds.get(link, "inner")}
            for link in sorted((each for each, _, _ in skeleton.tree), key=height)
        ],
        "names": {each: beside(each) for each in skeleton.joints if each not in ground},
        "traced": "".join(each for each in skeleton.links[body] if each not in ground),
    }


def _way(found: FoundSixBar, scene: float) -> tuple[dict[str, Any], list[float]]:
    """Places along the branch, and the frames at which the poses are met.

    Once all round where the driver turns fully, evenly; else until it locks, closer to both ends.
    """
    low, high = found.drive_range
    below, above = found.room.tolist()
    middle, turn = (low + high) / 2, math.pi * found.turns
    low, high = (middle - turn, middle + turn) if found.turns else (low - below, high + above)
    count = FRAMES * max(1, math.ceil((high - low) / (2 * math.pi) - 1e-9))
    share, met = np.linspace(0, 1, count + 1), np.clip((found.drive - low) / (high - low), 0, 1)
    if not found.turns:
        share = (1 - np.cos(np.pi * np.clip(share, END, 1 - END))) / 2
        met = np.arccos(1 - 2 * met) / np.pi
    drive = low + (high - low) * share
    places = found.body(drive)
    # Where rounding keeps loops open at a dead point, the nearest place stands for it.
    known = np.flatnonzero(np.isfinite(places.angle))
    near = known[np.abs(known - np.arange(len(drive))[:, None]).argmin(axis=1)]
    drive, places = drive[near], places[near]
    loops = np.degrees(_transmission(found, drive))
    digits = DIGITS - math.ceil(math.log10(scene))
    x, y = np.round(places.translation.T, digits).tolist()
    ground = found.skeleton.links[found.skeleton.ground]
    way = {
        "circuit": 1,
        "branch": 1,
        "branches": 1,
        "round": found.turns > 0,
        "dead": [not found.turns] * 2,
        "poses": list(range(1, len(found.drive) + 1)),
        "drive": np.degrees(drive).tolist(),
        "x": x,
        "y": y,
        "angle": np.round(np.unwrap(places.angle), DIGITS).tolist(),
        "joints": {
            name: np.round(at.T, digits).tolist()
            for name, at in found.joints(drive).items()
            if name not in ground
        },
        "transmission": np.round(loops.min(axis=0), 4).tolist(),
        "loops": np.round(loops, 4).tolist(),
    }
    return way, (count * met).tolist()


def _transmission(found: FoundSixBar, drive: FloatArray) -> FloatArray:
    """The transmission angles (L, *) of the loops, in radians."""
    at = found.joints(drive)
    joints = np.stack([complex_of(at[name]) for name in found.skeleton.joints], axis=-1)
    return np.stack(transmission_angles(found.skeleton, joints, found.driver_pivot))


def _pair(point: FloatArray) -> list[float]:
    return [float(each) for each in point]
