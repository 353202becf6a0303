"""What is told of a linkage under its loads: efforts, reactions, equilibria, springs, time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, NamedTuple, TypeVar, final

import numpy as np

from burmester.errors import Finding, InputError
from burmester.loads.drive_in_time import course_at
from burmester.loads.equilibria import equilibria
from burmester.loads.loaded_motion import LOOKS, LoadedLinkage, LoadedMotion
from burmester.loads.peaks import with_peaks
from burmester.numerics.arrays import FloatArray
from burmester.requirements.loads import OF_LOADS
from burmester.requirements.requirement import Figures
from burmester.requirements.table import violations
from burmester.tasks.loads import Drive, Spring
from burmester.verdicts.judged_linkage import LinkageAtPoses

Found = TypeVar("Found", bound=LinkageAtPoses)

SAME_SHARE = 1e-9  # of the motion; a place that is nearer to a pose is the pose
HELD = 1e-9  # of the greatest effort of all loads, each by itself; less is none


class Extremes(NamedTuple):
    """The least and the greatest value along the motion; between which poses each is, from 1."""

    least: float
    greatest: float
    at_poses: tuple[tuple[int, int], tuple[int, int]]

    @property
    def magnitude(self) -> float:
        """The greater of both magnitudes."""
        return max(abs(self.least), abs(self.greatest))


class Rest(NamedTuple):
    """An equilibrium: the driver's coordinate, degrees or metres; whether it comes back there."""

    driver: float
    stable: bool
    between_poses: tuple[int, int]


class SpringFigures(NamedTuple):
    """A spring with the least and the greatest of its lengths and forces along the motion.

    length: in the task's unit, or degrees; tension: in N, or N m; positive where it pulls.
    """

    spring: Spring
    length: tuple[float, float]
    tension: tuple[float, float]


class DriveFigures(NamedTuple):
    """The motion in time: effort, and the greatest speed and acceleration of the body's origin.

    speed, acceleration: in the task's unit of lengths, a second and a second squared.
    """

    drive: Drive
    effort: Extremes
    speed: float
    acceleration: float


@final
@dataclass(frozen=True, eq=False)
class LoadFigures:
    """Of one linkage from the first pose to the last.

    motion: at shares (n,) along it, closer about its extremes.  effort: that holds it still.
    hand: of a hand in place of the driver, positive where it pushes along its way; None where there
    is no hand.  rub: how much more of it the friction of gas springs takes, at most, in N.
    pins: the greatest force of each, in N.
    stays: the poses, from 0, at which friction holds it, or nothing needs to.
    findings: springs that are longer or shorter than they allow.
    measures: what is held to requirements, fields of `requirements.requirement`.
    """

    motion: LoadedMotion
    shares: FloatArray
    effort: Extremes
    hand: Extremes | None
    rub: float
    pins: dict[str, float]
    stays: tuple[int, ...]
    springs: tuple[SpringFigures, ...]
    drive: DriveFigures | None
    findings: tuple[Finding, ...]
    measures: Mapping[str, Any]

    @property
    def turns(self) -> bool:
        """Whether its driver turns: efforts are N m then, else N."""
        return self.motion.rates.turns

    @cached_property
    def rests(self) -> tuple[Rest, ...]:
        """Its equilibria."""
        return _rests(self.motion, self.shares)


def load_figures(found: LinkageAtPoses) -> LoadFigures | None:
    """The figures of a linkage; None where its task has no loads, or it does not move."""
    if found.task.loads is None:
        return None
    try:
        linkage = LoadedLinkage.of(found)
    except InputError as error:
        if error.code != "E163":
            raise
        return None
    loaded, shares = _looked_at(linkage)
    effort = loaded.effort
    hand, rub, pushed, onwards = None, 0.0, np.nan, np.full(1, np.nan)
    if loaded.loads.hand is not None:
        static, rubs = (np.abs(loaded.hand_force(each)) for each in (effort, loaded.friction))
        hand, rub = extremes(loaded, loaded.hand_force(effort)), float(np.nanmax(rubs, initial=0))
        pushed = float(np.nanmax(static + rubs, initial=0.0))
        onwards = loaded.hand_force(effort) + rubs
    pins = {
        name: float(np.nanmax(np.hypot(*force.T), initial=0.0))
        for name, force in loaded.pins.items()
    }
    most, stays, drive = extremes(loaded, effort), _stays(loaded, shares), in_time(linkage)
    findings = spring_findings(loaded) + drive_findings(linkage)
    names = found.task.names or ("",) * len(linkage.at_poses)
    measures = {
        "hand_force": pushed,
        "hand_least": float(np.fmin.reduce(onwards)),
        "hand_greatest": float(np.fmax.reduce(onwards)),
        "driver_torque": (most if drive is None else drive.effort).magnitude
        if loaded.rates.turns
        else np.nan,  # one that slides has none
        "pin_force": max(pins.values()),
        "stays": frozenset(word for k in stays for word in (str(k + 1), names[k]) if word),
        "closes": _closes(loaded),
    }
    if drive is not None:
        measures |= {"body_speed": drive.speed, "body_acceleration": drive.acceleration}
    return LoadFigures(
        loaded,
        shares,
        most,
        hand,
        rub,
        pins,
        stays,
        tuple(_spring(loaded, k) for k in range(len(loaded.springs))),
        drive,
        findings,
        measures,
    )


def loaded(found: Found) -> Found:
    """A linkage with what it bears: not usable where a spring is longer or shorter than it allows.

    Of one that does not lead through the poses nothing is told.
    """
    if found.task.loads is None or found.faults:
        return found
    figures = load_figures(found)
    if figures is None:
        return found
    more: dict[str, Any] = {"loads": figures}
    if below := figures.findings + missed(found, figures):
        more["violations"] = found.violations + below
        if "usable" in (each.name for each in fields(found)):
            more["usable"] = False
    return replace(found, **more)


def missed(found: LinkageAtPoses, figures: LoadFigures) -> tuple[Finding, ...]:
    """What a linkage does not keep of what is asked of its loads."""
    bounds = found.task.requirements.bounds
    asked = {each: bound for each, bound in bounds.items() if each in OF_LOADS}
    return violations(asked, Figures(**figures.measures), found.unit)


def extremes(loaded: LoadedMotion, values: FloatArray) -> Extremes:
    """The least and the greatest of values (n,) along a motion."""
    if not np.isfinite(values).any():
        return Extremes(np.nan, np.nan, ((1, 1), (1, 1)))
    low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
    between = (poses_about(loaded, float(loaded.drive[k])) for k in (low, high))
    return Extremes(float(values[low]), float(values[high]), (next(between), next(between)))


def poses_about(loaded: LoadedMotion, drive: float) -> tuple[int, int]:
    """The numbers, from 1, of the poses before and behind a place of the driver."""
    met = loaded.sense * loaded.of.at_poses
    order = np.argsort(met)
    order = order[np.isfinite(met[order])]
    slack = HELD * float(np.ptp(met[order]))
    at = loaded.sense * drive
    before = order[met[order] <= at + slack]
    behind = order[met[order] >= at - slack]
    return int(before[-1] if len(before) else order[0]) + 1, int(
        behind[0] if len(behind) else order[-1]
    ) + 1


def _looked_at(linkage: LoadedLinkage) -> tuple[LoadedMotion, FloatArray]:
    """A linkage at shares (n,) of its motion: even ones, the poses, and more about extremes."""
    met = linkage.pose_shares[np.isfinite(linkage.pose_shares)]
    even = np.linspace(0.0, 1.0, LOOKS)
    apart = np.abs(even[:, None] - met).min(axis=1, initial=1.0)
    even = np.unique(np.concatenate([even[apart > SAME_SHARE], met]))
    first = linkage.at(even)
    none = _none(first)  # rounding of an effort that is balanced everywhere has no peaks

    def look(shares: FloatArray) -> tuple[FloatArray, FloatArray]:
        here = first if shares is even else linkage.at(shares)
        effort = np.where(np.abs(here.effort) <= none, 0.0, here.effort)
        pins = np.array([np.hypot(*force.T) for force in here.pins.values()])
        values = [effort, *np.where(pins <= HELD * np.nanmax(pins, initial=0.0), 0.0, pins)]
        divisors = [np.abs(here.rates.closeness)]
        for course in here.springs:
            values += [course.length, course.tension]
            if course.spring.kind != "torsion":
                divisors.append(course.length)
        if here.loads.hand is not None:
            push, rubs = here.hand_force(effort), np.abs(here.hand_force(here.friction))
            values += [push, rubs, push + rubs, np.abs(push) + rubs]
            divisors.append(here.hand_speed)
        return np.array(values), np.array(divisors)

    shares = with_peaks(even, look)
    return (first if shares is even else linkage.at(shares)), shares


def _rests(loaded: LoadedMotion, shares: FloatArray) -> tuple[Rest, ...]:
    rests = equilibria(
        shares, loaded.effort, loaded.sense, lambda at: loaded.of.at(at).effort, _none(loaded)
    )
    if not rests:
        return ()
    drives = loaded.of.at(np.array([each.share for each in rests])).drive
    return tuple(
        Rest(float(np.degrees(at)) if loaded.rates.turns else float(at), each.stable,
             poses_about(loaded, float(at)))
        for each, at in zip(rests, drives, strict=True)
    )  # fmt: skip


def _stays(loaded: LoadedMotion, shares: FloatArray) -> tuple[int, ...]:
    """The poses at which the friction of springs, or nothing, is enough to hold it."""
    reached = np.flatnonzero(np.isfinite(loaded.of.pose_shares))
    at = np.searchsorted(shares, loaded.of.pose_shares[reached])
    held = np.abs(loaded.effort[at]) <= loaded.friction[at] + _none(loaded)
    return tuple(int(k) for k in reached[held])


def _none(loaded: LoadedMotion) -> float:
    """The effort below which there is none but rounding."""
    return HELD * float(np.nanmax(loaded.gross, initial=0.0))


def _closes(loaded: LoadedMotion) -> float:
    """How far the body may be turned from the first pose, and closes by itself, in radians."""
    angle = loaded.places[loaded.bodies.body].angle
    angle = np.abs(angle - angle[0])
    back = loaded.sense * loaded.effort > loaded.friction
    open_ = np.flatnonzero(~back)
    return float(angle[open_[0]] if len(open_) else np.inf)


def _spring(loaded: LoadedMotion, k: int) -> SpringFigures:
    course = loaded.springs[k]
    turned = course.spring.kind == "torsion"
    length = np.degrees(course.length) if turned else course.length / loaded.of.metre
    return SpringFigures(
        course.spring,
        (float(length.min()), float(length.max())),
        (float(course.tension.min()), float(course.tension.max())),
    )


def spring_findings(loaded: LoadedMotion) -> tuple[Finding, ...]:
    """The springs that are longer or shorter than they allow, with the poses concerned."""
    out = []
    for number, course in enumerate(loaded.springs, start=1):
        off = course.off(loaded.of.metre)
        if not off.any():
            continue
        drives = loaded.drive[off]
        poses = sorted({each for at in (drives[0], drives[-1])
                        for each in poses_about(loaded, float(at))})  # fmt: skip
        least, most = course.spring.span
        length = course.length / loaded.of.metre
        message = (
            f"is {length.min():.4g} to {length.max():.4g} long along the motion, and may be "
            f"{least:.4g} to {most:.4g}"
        )
        kind = f"{course.spring.kind} spring {number}"
        out.append(Finding("spring", f"its {kind} {message}", tuple(k - 1 for k in poses)))
    return tuple(out)


def drive_findings(linkage: LoadedLinkage) -> tuple[Finding, ...]:
    """Why its driver cannot move in time as the task states; () where it can."""
    drive = linkage.loads.drive
    missed = None if drive is None else linkage.timing(drive).missed
    return () if missed is None else (Finding("drive", missed),)


def in_time(linkage: LoadedLinkage) -> DriveFigures | None:
    """A linkage whose driver moves in time; None where the task states no drive, or it cannot."""
    drive = linkage.loads.drive
    if drive is None:
        return None
    timing = linkage.timing(drive)
    if timing.missed is not None:
        return None
    first, last = linkage.drives(linkage.way(np.array([0.0, 1.0]))).tolist()

    def seen(parts: FloatArray) -> tuple[LoadedMotion, FloatArray]:
        """It at parts (n,) of the time, with effort, speed and acceleration: (3, n)."""
        course = course_at(timing, parts)
        here = linkage.at_driver(course.share)
        speed, push = course.speed * (last - first), course.acceleration * (last - first)
        effort = here.rates.effort(here.carried(speed, push) - here.applied)
        number = here.rates.bodies.index(here.bodies.body)
        moved = (np.hypot(*each[:, number, :2].T) for each in here.rates.in_time(speed, push))
        return here, np.stack([effort, *moved])

    def look(parts: FloatArray) -> tuple[FloatArray, FloatArray]:
        here, values = whole if parts is even else seen(parts)
        return values, np.abs(here.rates.closeness)[None]

    even = np.linspace(0.0, 1.0, LOOKS)
    whole = seen(even)
    parts = with_peaks(even, look)
    loaded, values = whole if parts is even else seen(parts)
    speed, acceleration = (float(np.nanmax(each)) / linkage.metre for each in values[1:])
    return DriveFigures(drive, extremes(loaded, values[0]), speed, acceleration)
