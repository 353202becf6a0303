"""Loads as plain data for a page: springs and the hand of a task, and curves of a linkage.

Curves go from the first pose to the last, over the driver, which grows along them, or over time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from burmester.describe.quality_words import load_notes
from burmester.loads.load_curves import LoadCurves, MovingCurves, curves_in_time, load_curves
from burmester.loads.loaded_motion import LoadedLinkage, letter
from burmester.numerics.arrays import FloatArray
from burmester.scene.load_marks import STRAIGHT, ends_of, middle_of
from burmester.synthesis.result import Candidate
from burmester.tasks.loads import BODY, GROUND, End, Spring
from burmester.tasks.motion_task import Task

PLACES: Final = 121  # of a curve
JOINT: Final = "joint"  # in place of a link: the joint of a torsion spring
DIGITS: Final = 6  # significant ones of a curve, counted from its greatest value


def loads_report(task: Task) -> dict[str, Any] | None:
    """What is drawn of the loads of a task: springs by their ends, and the point of the hand."""
    if task.loads is None:
        return None
    loads = task.loads
    return {
        "hand": None if loads.hand is None else loads.hand.tolist(),
        "springs": [
            {
                "kind": each.kind,
                "ends": [{"link": end.link, "point": [*end.point]} for end in _drawn(each)],
            }
            for each in loads.springs
        ],
    }


def _drawn(spring: Spring) -> tuple[End, ...]:
    """The ends that are drawn: of a counterweight its own, of a torsion spring none that it has."""
    if spring.kind == "torsion":
        return (End(JOINT, (0.0, 0.0)),)
    return spring.ends if spring.kind in STRAIGHT else spring.ends[1:]


def loads_of(
    found: Candidate, ways: Sequence[dict[str, Any]], at: Sequence[tuple[int, float] | None]
) -> dict[str, Any] | None:
    """The curves of a linkage, if it has loads; at: the way and the frame of each pose.

    way: on which they are.  said: its figures in sentences.  panels: over the driver.  timed: over
    time, where there is a drive, with the time for each place of the driver.  hand: the direction
    in which the hand pushes, in radians, and its force as a share of the greatest.  moved: ends of
    springs on links that are neither the ground nor the body.  pins: where each pin is, and the
    force of the ground or of the link that holds it on the other link.
    """
    if found.loads is None:
        return None
    linkage = LoadedLinkage.of(found)
    curves = load_curves(linkage, np.linspace(0.0, 1.0, PLACES))
    pose = next((k for k, each in enumerate(at) if each and np.isfinite(linkage.at_poses[k])), None)
    if pose is None:
        return None
    way, frame = at[pose] or (0, 0.0)
    drive = np.asarray(ways[way]["drive"], dtype=float)
    apart = np.interp(frame, np.arange(len(drive)), drive)
    turn = 0.0
    if curves.turns:  # a page counts whole turns of the driver in its own way
        turn = 360 * round(float(apart - np.degrees(linkage.at_poses[pose])) / 360)
    unit = found.unit or ""
    over = _Over(curves.driver + turn)
    out = {
        "way": way,
        "said": load_notes(found.loads, found.task),
        "panels": [over.panel(*each) for each in _still(curves)],
        "hand": _hand(linkage, curves, over),
        "moved": _moved(found, linkage, over),
        "pins": _pins(found, linkage, curves, over),
        "timed": None,
    }
    if found.loads.drive is not None:
        _, moving = curves_in_time(linkage, found.loads.drive.drive, PLACES)
        timed = _Over(moving.time)
        assert curves.moving is not None
        out["timed"] = {
            "time": over.curve(curves.moving.time),
            "panels": [timed.panel(*each) for each in _in_time(moving, curves.turns, unit)],
        }
    return out


Panel = tuple[str, dict[str, FloatArray]]  # a title, and lines by their names


class _Over:
    """What curves are over: values that grow along them."""

    def __init__(self, values: FloatArray) -> None:
        self._falls = bool(values[-1] < values[0])
        self._values = _listed(values[::-1] if self._falls else values, 10)

    def along(self, values: FloatArray, digits: int = DIGITS) -> list[float | None]:
        return _listed(values[::-1] if self._falls else values, digits)

    def curve(self, values: FloatArray) -> dict[str, Any]:
        return {"x": self._values, "y": self.along(values, 9)}

    def panel(self, title: str, lines: dict[str, FloatArray]) -> dict[str, Any]:
        own = [{"name": name, "y": self.along(values)} for name, values in lines.items()]
        return {"title": title, "x": self._values, "lines": own}


def _listed(values: FloatArray, digits: int) -> list[float | None]:
    """Numbers to so many digits of the greatest one; None where there is none."""
    most = float(np.nanmax(np.abs(values), initial=0.0))
    decimals = digits - (math.ceil(math.log10(most)) if most > 0 else 0)
    rounded = np.round(values, decimals).tolist()
    return [each if math.isfinite(each) else None for each in rounded]


def _still(curves: LoadCurves) -> list[Panel]:
    """What is borne where the linkage is held still."""
    panels: list[Panel] = [(_effort(curves.turns, "holds it"), {"": curves.effort})]
    if curves.hand is not None:
        panels.append(("hand force (N)", {"": curves.hand}))
    panels.append(("pin forces (N)", _sizes(curves.pins)))
    panels.append(("potential energy (J)", {"": curves.energy}))
    return panels


def _in_time(moving: MovingCurves, turns: bool, unit: str) -> list[Panel]:
    """What is borne while it moves."""
    panels: list[Panel] = [(_effort(turns, "moves it"), {"": moving.effort})]
    if moving.hand is not None:
        panels.append(("hand force (N)", {"": moving.hand}))
    panels.append(("pin forces (N)", _sizes(moving.pins)))
    panels.append((f"speed of the body's origin ({unit}/s)", {"": moving.body_speed}))
    return panels


def _effort(turns: bool, does: str) -> str:
    return f"driver {'torque' if turns else 'force'} that {does} ({'N·m' if turns else 'N'})"


def _sizes(pins: dict[str, FloatArray]) -> dict[str, FloatArray]:
    return {name: np.hypot(*force.T) for name, force in pins.items()}


def _hand(linkage: LoadedLinkage, curves: LoadCurves, over: _Over) -> dict[str, Any] | None:
    """The direction in which a hand pushes, and how strongly: 1 at its greatest."""
    if curves.hand is None:
        return None
    assert linkage.loads.hand is not None
    path = linkage.way(curves.shares).places.act(linkage.loads.hand)
    onwards = np.gradient(path, axis=0)
    most = float(np.nanmax(np.abs(curves.hand), initial=0.0)) or 1.0
    angle = np.unwrap(np.arctan2(*onwards.T[::-1]))
    return {**over.curve(angle), "force": over.along(curves.hand / most)}


def _pins(
    found: Candidate, linkage: LoadedLinkage, curves: LoadCurves, over: _Over
) -> list[dict[str, Any]]:
    """Pins by their letters: their places, and forces in N; of the ground always on the links."""
    motion = linkage.way(curves.shares)
    places, bodies = found.bodies_at(motion.drive, motion.places), found.bodies
    joints = {letter(each): each for each in bodies.joints}
    at = {name: places[each.holder].act(each.hole(each.holder)) for name, each in joints.items()}
    onto = {  # where the ground holds no pin but a link does, it is the ground that pushes
        name: 1.0 if GROUND in each.links and each.holder != GROUND else -1.0
        for name, each in joints.items()
    }
    return [
        {
            "name": name,
            "at": [over.curve(each) for each in np.broadcast_to(at[name], force.shape).T],
            "force": [over.along(each) for each in onto[name] * force.T],
        }
        for name, force in curves.pins.items()
    ]


def _moved(found: Candidate, linkage: LoadedLinkage, over: _Over) -> list[dict[str, Any]]:
    """The ends of springs that are on other links: spring and end by number, and their places."""
    assert found.task.loads is not None
    motion = linkage.way(np.linspace(0.0, 1.0, PLACES))
    places, bodies = found.bodies_at(motion.drive, motion.places), found.bodies
    out = []
    for number, spring in enumerate(found.task.loads.springs):
        middle = middle_of(spring, bodies, places)
        ends = ends_of(spring, bodies, places) if spring.kind in STRAIGHT else (middle,)
        for k, (end, at) in enumerate(zip(_drawn(spring), ends, strict=True)):
            if end.link not in (GROUND, BODY) and at is not None:
                own = [over.curve(each) for each in np.broadcast_to(at, (PLACES, 2)).T]
                out.append({"spring": number, "end": k, "at": own})
    return out
