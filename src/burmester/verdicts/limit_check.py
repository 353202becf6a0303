"""The check of a linkage against the limits of its dyads, and of its clearance."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from burmester.clearance.least_clearance import Clearance, clearance_between_poses
from burmester.errors import Finding
from burmester.fourbar.defects import Verdict
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon, Region
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.notation import length_of, poses_in_words
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import Side, with_driver_first
from burmester.wording import figure, listed

LIMIT_TOLERANCE = 1e-6  # motion sizes; a limit missed by less is met


def limit_violations(
    linkage: Linkage,
    limits: Sequence[Limits],
    size: float,
    unit: str | None = None,
    places: Displacement | None = None,
) -> tuple[Finding, ...]:
    """The limits that a linkage breaks: places of pivots, lengths, kinds, rails and slots.

    limits: none, one for both dyads, or two, in the order of the dyads.  size: of the motion;
    unit: the task's length unit, for messages.  places: (*,), of the body from pose to pose, at
    which pins have to keep the travel of their rails; None leaves that out.
    """
    if not limits:
        return ()
    sides = zip((linkage.first, linkage.second), (limits[0], limits[-1]), strict=True)
    slack = LIMIT_TOLERANCE * size
    return tuple(
        Finding("limit", message)
        for dyad, each in sides
        for message in (
            *_broken(dyad, each, slack, unit),
            *_off_rail(dyad, each, slack, unit, places),
        )
    )


def _broken(dyad: Dyad, limits: Limits, slack: float, unit: str | None) -> Iterator[str]:
    """What one dyad does not keep of its limits."""
    kind = type(dyad).__name__
    if kind not in limits.allowed:
        allowed = listed([name for name in KINDS if name in limits.allowed], "or")
        yield f"its {kind} dyad is not of a kind allowed ({allowed})"
    pivots: list[tuple[str, Region | None, FloatArray]] = []
    if isinstance(dyad, RR | RP):
        pivots.append(("fixed", limits.fixed_pivot, dyad.fixed_pivot))
    if isinstance(dyad, RR | PR):
        pivots.append(("moving", limits.moving_pivot, dyad.moving_pivot))
    for name, region, at in pivots:
        if region is None:
            continue
        yield from off_region(f"the {name} pivot", at, outside(region, at), slack, unit)
    if isinstance(dyad, RR):
        yield from wrong_length("a link", float(dyad.radius), limits, slack)


def off_region(
    what: str, at: FloatArray, away: float, slack: float, unit: str | None
) -> Iterator[str]:
    """That a pivot is so far outside its region, if it is."""
    if not away <= slack:
        x, y = (f"{float(value):.6g}" for value in at)
        yield f"{what} at ({x}, {y}) is {_length(away, unit)} outside its region"


def wrong_length(what: str, length: float, limits: Limits, slack: float) -> Iterator[str]:
    """That a link is too short or too long, if it is."""
    least, most = limits.length
    if length < least - slack:
        yield f"{what} is {length:.4g} long; at least {least:g} is asked for"
    elif length > most + slack:
        yield f"{what} is {length:.4g} long; at most {most:g} is allowed"


def _off_rail(
    dyad: Dyad, limits: Limits, slack: float, unit: str | None, places: Displacement | None
) -> Iterator[str]:
    """What a slider does not keep of its rail or slot."""
    rail = limits.line
    if rail is None or not isinstance(dyad, PR | RP):
        return
    what, line = "rail" if isinstance(dyad, PR) else "slot", (dyad.normal_angle, dyad.offset)
    if rail.heading is not None:
        off, within = float(rail.turned(line[0])), rail.heading[1]
        if not abs(off) <= within + LIMIT_TOLERANCE:
            allowed = f"at most {math.degrees(within):g}°" if within else "no angle"
            turned = f"its {what} is turned by {math.degrees(off):.3g}° from its direction"
            yield f"{turned}; {allowed} is allowed"
    if not (beside := float(rail.passed(*line))) <= slack:
        place = "the line of its travel" if rail.is_thin else "what it is to pass through"
        yield f"its {what} lies {_length(beside, unit)} beside {place}"
    if places is None or rail.travel is None:
        return
    if (beyond := float(np.nanmax(rail.travel_excess(dyad.pins(places))))) > slack:
        yield f"the pin on its {what} goes {_length(beyond, unit)} beyond its travel"


def outside(region: Region, at: FloatArray) -> float:
    """The distance of a point outside a region; 0 or less inside."""
    if isinstance(region, Polygon):
        return float(region.signed_distance(np.asarray(at)))
    return float(region.distance(np.asarray(at)))


def _length(value: float, unit: str | None) -> str:
    return f"{figure(value)}{f' {unit}' if unit else ''}"


def clearance_of(
    linkage: Linkage, verdict: Verdict, driver: Side, problem: SynthesisProblem
) -> Clearance | None:
    """The least clearance of a linkage with its driver; its poses are those of the task as given.

    None without surroundings, and for a linkage that does not come from pose to pose.
    """
    task = problem.task
    driven = verdict.first if driver == "first" else verdict.second
    if task.surroundings is None or verdict.defects or driven.defects:
        return None
    led = with_driver_first(linkage, driver)
    clearance = clearance_between_poses(led, driven, task.body, task.surroundings)
    if clearance is None:
        return None
    one, two = (problem.pose_numbers[k] for k in clearance.poses)
    return replace(clearance, poses=(min(one, two), max(one, two)))


def too_close(clearance: Clearance | None, problem: SynthesisProblem) -> tuple[Finding, ...]:
    """The violation where something touches, or comes nearer than the margin; else none."""
    around = problem.task.surroundings
    if clearance is None or around is None:
        return ()
    if clearance.least > 0 and clearance.least >= around.margin:
        return ()
    return (Finding("clearance", clearance_in_words(clearance, problem)),)


def clearance_in_words(clearance: Clearance, problem: SynthesisProblem) -> str:
    """What comes nearest to what, where: "the body touches 'bumper' between poses 1 and 2, ..."."""
    task = problem.given
    one, two = clearance.poses
    when = f"at {poses_in_words(task, [one])}"
    if one != two:
        when = f"between {poses_in_words(task, [one, two])}"
    x, y = (figure(float(value)) for value in clearance.place.translation)
    turned = figure(round(math.degrees(float(clearance.place.angle)), 3))
    where = f"{when}, with the body at ({x}, {y}) and {turned}°"
    if clearance.touches:
        return f"{clearance.part} touches {clearance.obstacle} {where}"
    near = length_of(clearance.least, task)
    text = f"{clearance.part} comes within {near} of {clearance.obstacle} {where}"
    margin = 0.0 if task.surroundings is None else task.surroundings.margin
    if clearance.least < margin:
        text += f"; a margin of {length_of(margin, task)} is asked for"
    return text
