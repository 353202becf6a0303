"""Six-bars in sentences and rows of tables."""

from __future__ import annotations

import math

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.sixbar.found import FoundSixBar
from burmester.synthesis.result import Synthesis
from burmester.tasks.notation import least_angle, length_of
from burmester.wording import figure, listed

__all__ = [
    "HEADS",
    "distances",
    "driver_name",
    "headline",
    "joint_rows",
    "length_rows",
    "row",
    "sentences",
]

HEADS = ("", "driver", "turns by", "transmits", "link ratio", "extent", "locks after")
DIGITS = 7  # significant ones of dimensions
_PLAIN = {"first crank": "AC", "floating link": "GH"}


def driver_name(found: FoundSixBar) -> str:
    """The crank that drives: "AC" or "BD"."""
    return "AC" if found.driver == "first" else "BD"


def headline(found: FoundSixBar) -> str:
    """What to build, in a sentence."""
    low, high = (math.degrees(each) for each in found.drive_range)
    return (
        f"{found.id} is a six-bar of Watt's first kind, driven at {driver_name(found)} over "
        f"{high - low:.1f}°; it transmits at {least_angle(found.transmission)} or more"
    )


def sentences(synthesis: Synthesis, found: FoundSixBar) -> list[str]:
    """What else is to be said of it."""
    first, last = (math.degrees(each) for each in (found.drive[0], found.drive[-1]))
    out = [
        f"The driver goes from {first:.1f}° to {last:.1f}°"
        + (" and may go round." if found.turns_fully else f"; {_locks(found)}."),
        "All poses are on one branch and in their order: nothing locks on the way.",
    ]
    if synthesis.task.requirements.any_order:
        out[1] = "All poses are on one branch: nothing locks between them."
    if found.shortcomings:
        out.append(f"It {listed(found.shortcomings)}.")
    return out


def joint_rows(found: FoundSixBar) -> list[tuple[str, str, str]]:
    """The two joints of each link that has more than a length, in the frame of the link."""
    linkage = found.linkage
    arm, crank = (np.array([float(x), 0]) for x in (linkage.coupler_arm, linkage.second_crank))
    links: dict[str, dict[str, FloatArray]] = {
        "ground, in F": {"A": linkage.fixed_first, "B": linkage.fixed_second},
        "coupler, C to E along x": {"D": linkage.coupler_joint, "E": arm},
        "second crank, B to D along x": {"D": crank, "G": linkage.crank_joint},
        "body, in M": {"E": linkage.body_joint, "H": linkage.link_joint},
    }
    rows = []
    for name, joints in links.items():
        one, two = (_point(joint, at) for joint, at in joints.items())
        rows.append((name, one, two))
    return rows


def length_rows(found: FoundSixBar) -> list[tuple[str, str, str]]:
    """The lengths of the two links that have no more than that."""
    length = found.lengths
    return [(f"{name}, {bar}", _number(length[bar]), "") for name, bar in _PLAIN.items()]


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
    )


def _locks(found: FoundSixBar) -> str:
    """Where it locks beyond the poses."""
    below, above = (math.degrees(each) for each in found.room.tolist())
    return f"it locks {below:.1f}° below this range and {above:.1f}° above it"


def _point(joint: str, at: FloatArray) -> str:
    return f"{joint} ({_number(at[0])}, {_number(at[1])})"


def _number(value: float) -> str:
    text = f"{float(value):.{DIGITS}g}"
    return "0" if float(text) == 0 else text
