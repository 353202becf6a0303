"""Six-bars in sentences and rows of tables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from burmester.describe.dimensions import degrees
from burmester.describe.quality_words import load_notes
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks.notation import length_of, pose_labels
from burmester.verdicts.explanation import meets_exactly, percent, worst_miss
from burmester.wording import figure, least_angle, listed, with_article

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

HEADS = ("", "driver", "turns by", "transmits", "link ratio", "extent", "locks after", "kind")
WIDE, NARROW = len(HEADS), 4  # columns of tables
POSE_HEADS = ("pose", "off by", "turned by", "driver at", "transmits")
OF_TOLERANCE = "of the tolerance"
MOST_POSES = 20  # of which errors are told one by one; of more those that are missed most
DIGITS = 7  # significant ones of dimensions


def driver_name(found: FoundSixBar) -> str:
    """The crank that drives: "AC" or "BD"."""
    return found.skeleton.arm(found.driver_pivot)


def headline(found: FoundSixBar) -> str:
    """What to build, in a sentence."""
    what = f"{found.id} is {with_article(found.type)}"
    if not found.usable:
        return f"{what}, nearest to the poses driven at {driver_name(found)}"
    low, high = (math.degrees(each) for each in found.drive_range)
    return (
        f"{what}, driven at {driver_name(found)} over "
        f"{high - low:.1f}°; it transmits at {least_angle(found.transmission)} or more"
    )


def sentences(synthesis: Synthesis, found: FoundSixBar) -> list[str]:
    """What else is to be said of it: how it is driven, what it does at the poses, shortcomings."""
    first, last = (math.degrees(each) for each in (found.drive[0], found.drive[-1]))
    way = f"goes from {first:.1f}° to {last:.1f}°"
    low, high = (math.degrees(each) for each in found.drive_range)
    if {first, last} != {low, high}:  # in another order
        way = f"is between {low:.1f}° and {high:.1f}° at the poses"
    below, above = (math.degrees(each) for each in found.room.tolist())
    locks = f"; it locks {below:.1f}° below this range and {above:.1f}° above it."
    out = [
        f"The driver {way}{' and may go round.' if found.turns_fully else locks}",
        _at_poses(synthesis, found),
    ]
    if found.shortcomings:
        out.append(f"It {listed(found.shortcomings)}.")
    return out


def notes(synthesis: Synthesis, found: FoundSixBar) -> list[str]:
    """The same without what the message of a given one has said."""
    driven, at_poses, *short = sentences(synthesis, found)
    given = synthesis.outcome.code in JUDGED
    own = [driven, *([at_poses] if found.usable else []), *([] if given else short)]
    return own + load_notes(found.loads, found.task)


def beside(_synthesis: Synthesis, _shown: Sequence[FoundSixBar]) -> list[str]:
    """What is said of all: nothing more."""
    return []


def dimension_rows(found: FoundSixBar) -> list[tuple[str, ...]]:
    """The links: the joints of each that has more than a length, in its frame; then the lengths."""
    skeleton, rows = found.skeleton, []
    held = skeleton.held(found.carries)
    for link in held:
        joints = dict(found.frames[link])
        frame = "in F" if link == skeleton.ground else "in M"
        if link not in (skeleton.ground, found.carries):
            origin, along = tuple(skeleton.axis(link))
            frame = f"{origin} to {along} along x"
            del joints[origin]
        places = {name: ", ".join(map(_number, at)) for name, at in joints.items()}
        rows.append((f"{link}, {frame}", *(f"{name} ({at})" for name, at in places.items())))
    length = dict(distances(found))
    for link, bar in skeleton.links.items():
        if link not in held:
            rows.append((bar if link == bar else f"{link}, {bar}", length[bar]))
    return rows


def distances(found: FoundSixBar) -> list[tuple[str, str]]:
    """Every distance between two joints of one link, such as ("AB", "30")."""
    return [(bar, _number(length)) for bar, length in found.lengths.items()]


def row(synthesis: Synthesis, found: FoundSixBar) -> tuple[str, ...]:
    """The cells of a six-bar under `HEADS`."""
    low, high = found.drive_range
    room = "never" if found.turns_fully else f"{math.degrees(min(found.room)):.1f}°"
    return (
        found.id,
        driver_name(found),
        f"{math.degrees(high - low):.1f}°",
        least_angle(found.transmission),
        figure(found.link_ratio),
        length_of(found.extent, synthesis.task),
        room,
        found.skeleton.name.removesuffix(" six-bar"),
    )


def place_table(
    synthesis: Synthesis, found: FoundSixBar
) -> tuple[str, tuple[str, ...], list[tuple[str, ...]]]:
    """What it does at the poses: a title, heads and rows; of many those that are missed most."""
    task = synthesis.task
    numbers = np.arange(len(found.drive))
    if len(numbers) > MOST_POSES:
        missed = found.error.combined(synthesis.length_per_radian)
        numbers = np.sort(np.argsort(-missed, kind="stable")[:MOST_POSES])
    transmits = found.transmission_at(found.drive)
    labels = pose_labels(task, numbers.tolist(), "number and name")
    rows = []
    misses = errors(synthesis, found)
    for label, k in zip(labels, numbers.tolist(), strict=True):
        cells = [
            label,
            *misses[k],
            f"{math.degrees(found.drive[k]):.1f}°",
            least_angle(float(transmits[k])),
        ]
        if found.within_tolerance is not None and task.gives_room:
            cells.append(percent(float(found.within_tolerance[k].max())))
        rows.append(tuple(cells))
    heads = (*POSE_HEADS, OF_TOLERANCE) if task.gives_room else POSE_HEADS
    title = f"At the poses{' that are missed most' * (len(rows) < len(found.drive))}"
    return title + ", on one branch" * found.on_branches, heads, rows


def errors(synthesis: Synthesis, found: FoundSixBar) -> list[tuple[str, str]]:
    """How far each pose is missed, and by what angle."""
    task, exact = synthesis.task, ROUNDING * synthesis.length
    free, error = task.free_angles.tolist(), found.error
    return [
        (
            "0" if away < exact else length_of(away, task),
            "free" if any_angle else "0°" if turned < 10 * ROUNDING else degrees(turned),
        )
        for away, turned, any_angle in zip(
            error.position.tolist(), error.angle.tolist(), free, strict=True
        )
    ]


def met(synthesis: Synthesis, found: FoundSixBar) -> str | None:
    """How near it comes to the poses; None where it meets them exactly."""
    if meets_exactly(found, synthesis.length):
        return None
    return f"within {worst_miss(found, synthesis.task)}"


def _at_poses(synthesis: Synthesis, found: FoundSixBar) -> str:
    """What it does at the poses, and between them."""
    task = synthesis.task
    if not found.usable:
        why = synthesis.outcome.why or "it does not work"
        return f"{why[0].upper()}{why[1:]}."
    branch = "All poses are on one branch and in their order: nothing locks on the way."
    if task.requirements.any_order:
        branch = "All poses are on one branch: nothing locks between them."
    if synthesis.outcome.code not in JUDGED:
        return branch
    return f"It passes every pose {met(synthesis, found) or 'exactly'}. {branch}"


def _number(value: float) -> str:
    text = f"{float(value):.{DIGITS}g}"
    return "0" if float(text) == 0 else text
