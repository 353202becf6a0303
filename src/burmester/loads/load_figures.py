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
from burmester.loads.masses import body_named
from burmester.loads.peaks import Seen, with_peaks
from burmester.numerics.arrays import FloatArray
from burmester.requirements.figures import Figures
from burmester.requirements.loads import (
    BODY_ACCELERATION,
    BODY_SPEED,
    DRIVER_TORQUE,
    OF_LOADS,
)
from burmester.requirements.table import violations
from burmester.tasks.loads import Drive, Spring
from burmester.verdicts.judged_linkage import LinkageAtPoses

Found = TypeVar("Found", bound=LinkageAtPoses)

IN_TIME = frozenset({DRIVER_TORQUE, BODY_SPEED, BODY_ACCELERATION})
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


class _Looked(NamedTuple):
    """A linkage at shares (n,) of its motion, closer about its extremes.

    rows: (n,) each, by what they are; see `_seen`.
    """

    shares: FloatArray
    rows: dict[str, FloatArray]


@final
@dataclass(frozen=True, eq=False)
class LoadFigures:
    """Of one linkage from the first pose to the last; each is computed where somebody reads it."""

    linkage: LoadedLinkage

    @property
    def turns(self) -> bool:
        """Whether its driver turns: efforts are N m then, else N."""
        return self.linkage.looked[1].rates.turns

    @cached_property
    def _looked(self) -> _Looked:
        linkage = self.linkage
        even, first = linkage.looked
        none = _none(first)  # rounding of an effort that is balanced everywhere has no peaks
        names = _names(first)

        def look(shares: FloatArray) -> Seen:
            return _seen(first if shares is even else linkage.at(shares), none)

        shares, seen = with_peaks(even, look)
        rows = [*seen.values, *seen.others]
        return _Looked(shares, dict(zip(names, rows, strict=True)))

    def _extremes(self, name: str) -> Extremes:
        rows = self._looked.rows
        return extremes(self.linkage, rows["drive"], rows[name])

    @cached_property
    def effort(self) -> Extremes:
        """That holds it still."""
        return self._extremes("effort")

    @cached_property
    def hand(self) -> Extremes | None:
        """Of a hand in place of the driver, positive where it pushes along its way, if there is."""
        return None if self.linkage.loads.hand is None else self._extremes("hand")

    @cached_property
    def rub(self) -> float:
        """How much more of the hand the friction of gas springs takes, at most, in N."""
        return 0.0 if self.hand is None else _greatest(self._looked.rows["rub"])

    @cached_property
    def pins(self) -> dict[str, float]:
        """The greatest force of each pin, in N."""
        rows = self._looked.rows
        return {
            name.removeprefix("pin "): _greatest(row)
            for name, row in rows.items()
            if name.startswith("pin ")
        }

    @cached_property
    def stays(self) -> tuple[int, ...]:
        """The poses, from 0, at which friction holds it, or nothing needs to."""
        shares, rows = self._looked
        reached = np.flatnonzero(np.isfinite(self.linkage.pose_shares))
        at = np.searchsorted(shares, self.linkage.pose_shares[reached])
        held = np.abs(rows["effort"][at]) <= rows["friction"][at] + _none(self.linkage.looked[1])
        return tuple(int(k) for k in reached[held])

    @cached_property
    def springs(self) -> tuple[SpringFigures, ...]:
        """Its springs, but for counterweights."""
        out, metre = [], self.linkage.metre
        for k, course in enumerate(self.linkage.looked[1].springs):
            length, tension = (self._looked.rows[f"{what} {k}"] for what in ("length", "tension"))
            turned = course.spring.kind == "torsion"
            length = np.degrees(length) if turned else length / metre
            ends = ((float(each.min()), float(each.max())) for each in (length, tension))
            out.append(SpringFigures(course.spring, *ends))
        return tuple(out)

    @cached_property
    def drive(self) -> DriveFigures | None:
        """In time; None where the task states no drive, or the linkage cannot keep it."""
        return in_time(self.linkage)

    @cached_property
    def rests(self) -> tuple[Rest, ...]:
        """Its equilibria."""
        (shares, rows), linkage, first = self._looked, self.linkage, self.linkage.looked[1]
        rests = equilibria(
            shares, rows["effort"], first.sense, lambda at: linkage.at(at).effort, _none(first)
        )
        if not rests:
            return ()
        drives = linkage.at(np.array([each.share for each in rests])).drive
        return tuple(
            Rest(float(np.degrees(at)) if self.turns else float(at), each.stable,
                 poses_about(linkage, float(at)))
            for each, at in zip(rests, drives, strict=True)
        )  # fmt: skip

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Springs that are longer or shorter than they allow, and times it cannot keep."""
        linkage, loads = self.linkage, self.linkage.loads
        missed = None if loads.drive is None else linkage.timing(loads.drive).missed
        own = () if springs_fit(linkage) else self._off_springs
        return own if missed is None else (*own, Finding("drive", missed))

    @property
    def _off_springs(self) -> tuple[Finding, ...]:
        out, rows = [], self._looked.rows
        for k, course in enumerate(self.linkage.looked[1].springs):
            length = rows[f"length {k}"]
            off = course.off(length, self.linkage.metre)
            if not off.any():
                continue
            drives = rows["drive"][off]
            poses = sorted({each for at in (drives[0], drives[-1])
                            for each in poses_about(self.linkage, float(at))})  # fmt: skip
            least, most = course.spring.span
            length = length / self.linkage.metre
            message = (
                f"is {length.min():.4g} to {length.max():.4g} long along the motion, and may be "
                f"{least:.4g} to {most:.4g}"
            )
            kind = f"{course.spring.kind} spring {k + 1}"
            out.append(Finding("spring", f"its {kind} {message}", tuple(k - 1 for k in poses)))
        return tuple(out)

    @cached_property
    def measures(self) -> Mapping[str, Any]:
        """What is held to requirements, fields of `requirements.requirement.Figures`.

        Those in time only where the task bounds one of them.
        """
        task, rows = self.linkage.found.task, self._looked.rows
        names = task.names or ("",) * len(self.linkage.pose_shares)
        timed = not IN_TIME.isdisjoint(task.requirements.bounds)
        drive = self.drive if timed else None
        hand = self.hand is not None
        out = {
            "hand_force": _greatest(rows["either way"]) if hand else np.nan,
            "hand_least": float(np.fmin.reduce(rows["onwards"])) if hand else np.nan,
            "hand_greatest": float(np.fmax.reduce(rows["onwards"])) if hand else np.nan,
            "driver_torque": (self.effort if drive is None else drive.effort).magnitude
            if self.turns
            else np.nan,  # one that slides has none
            "pin_force": max(self.pins.values()),
            "stays": frozenset(word for k in self.stays for word in (str(k + 1), names[k]) if word),
            "closes": self._closes,
        }
        if drive is not None:
            out |= {"body_speed": drive.speed, "body_acceleration": drive.acceleration}
        return out

    @property
    def _closes(self) -> float:
        """How far the body may be turned from the first pose, and closes by itself, in radians."""
        rows = self._looked.rows
        angle = np.abs(rows["angle"] - rows["angle"][0])
        back = self.linkage.looked[1].sense * rows["effort"] > rows["friction"]
        open_ = np.flatnonzero(~back)
        return float(angle[open_[0]] if len(open_) else np.inf)


def load_figures(found: LinkageAtPoses) -> LoadFigures | None:
    """The figures of a linkage; None where its task has no loads, or it does not move."""
    if found.task.loads is None:
        return None
    try:
        return LoadFigures(LoadedLinkage.of(found))
    except InputError as error:
        if error.code != "E163":
            raise
        return None


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
    return violations(asked, Figures(**figures.measures), found.unit) if asked else ()


def extremes(linkage: LoadedLinkage, drive: FloatArray, values: FloatArray) -> Extremes:
    """The least and the greatest of values (n,) where the driver is at (n,)."""
    if not np.isfinite(values).any():
        return Extremes(np.nan, np.nan, ((1, 1), (1, 1)))
    low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
    between = (poses_about(linkage, float(drive[k])) for k in (low, high))
    return Extremes(float(values[low]), float(values[high]), (next(between), next(between)))


def poses_about(linkage: LoadedLinkage, drive: float) -> tuple[int, int]:
    """The numbers, from 1, of the poses before and behind a place of the driver."""
    sense = linkage.looked[1].sense
    met = sense * linkage.at_poses
    order = np.argsort(met)
    order = order[np.isfinite(met[order])]
    slack = HELD * float(np.ptp(met[order]))
    at = sense * drive
    before = order[met[order] <= at + slack]
    behind = order[met[order] >= at - slack]
    return int(before[-1] if len(before) else order[0]) + 1, int(
        behind[0] if len(behind) else order[-1]
    ) + 1


def _greatest(values: FloatArray) -> float:
    """The greatest of values (n,) that are not negative; 0 where there is none."""
    return float(np.nanmax(values, initial=0.0))


def _none(loaded: LoadedMotion) -> float:
    """The effort below which there is none but rounding."""
    return HELD * _greatest(loaded.gross)


def _names(here: LoadedMotion) -> list[str]:
    """What the rows are of what is seen."""
    springs = [f"{what} {k}" for k in range(len(here.springs)) for what in ("length", "tension")]
    hand = [] if here.loads.hand is None else ["hand", "rub", "onwards", "either way"]
    pins = [f"pin {name}" for name in here.pins]
    return ["effort", *pins, *springs, *hand, "drive", "friction", "angle"]


def _seen(here: LoadedMotion, none: float) -> Seen:
    """A linkage at places (n,): effort, pins, springs and hand; driver, friction and body."""
    effort = np.where(np.abs(here.effort) <= none, 0.0, here.effort)
    pins = np.array([np.hypot(*force.T) for force in here.pins.values()])
    values = [effort, *np.where(pins <= HELD * _greatest(pins), 0.0, pins)]
    divisors = [np.abs(here.rates.closeness)]
    for course in here.springs:
        values += [course.length, course.tension]
        if course.spring.kind != "torsion":
            divisors.append(course.length)
    if here.loads.hand is not None:
        push, rubs = here.hand_force(effort), np.abs(here.hand_force(here.friction))
        values += [push, rubs, push + rubs, np.abs(push) + rubs]
        divisors.append(here.hand_speed)
    others = [here.drive, here.friction, here.places[here.bodies.body].angle]
    return Seen(np.array(values), np.array(divisors), np.array(others))


def springs_fit(linkage: LoadedLinkage) -> bool:
    """Whether the springs surely are as long as they may be; False where that is to be looked at.

    Between three places a smooth length is beyond the middle one by less than their second
    difference.
    """
    (_, there), metre = linkage.looked, linkage.metre
    for spring in linkage.loads.springs:
        if spring.kind in ("torsion", "counterweight"):
            continue
        least, most = (each * metre for each in spring.span)
        one, two = (
            there.places[body_named(end.link, linkage.bodies)].act(np.array(end.point) * metre)
            for end in spring.ends
        )
        length = np.hypot(*(two - one).T)
        slack = float(np.abs(np.diff(length, 2)).max(initial=0.0))
        if not (length.min() - slack > least and length.max() + slack < most):
            return False
    return True


def in_time(linkage: LoadedLinkage) -> DriveFigures | None:
    """A linkage whose driver moves in time; None where the task states no drive, or it cannot."""
    drive = linkage.loads.drive
    if drive is None:
        return None
    timing = linkage.timing(drive)
    if timing.missed is not None:
        return None
    first, last = linkage.drives(linkage.way(np.array([0.0, 1.0]))).tolist()

    def look(parts: FloatArray) -> Seen:
        """At parts (n,) of the time: effort, speed and acceleration; the driver."""
        course = course_at(timing, parts)
        here = linkage.at_driver(course.share)
        speed, push = course.speed * (last - first), course.acceleration * (last - first)
        effort = here.rates.effort(here.carried(speed, push) - here.applied)
        number = here.rates.number(here.bodies.body)
        moved = (np.hypot(*each[:, number, :2].T) for each in here.rates.in_time(speed, push))
        values = np.stack([effort, *moved])
        return Seen(values, np.abs(here.rates.closeness)[None], here.drive[None])

    _, seen = with_peaks(np.linspace(0.0, 1.0, LOOKS), look)
    effort = extremes(linkage, seen.others[0], seen.values[0])
    speed, acceleration = (float(np.nanmax(each)) / linkage.metre for each in seen.values[1:])
    return DriveFigures(drive, effort, speed, acceleration)
