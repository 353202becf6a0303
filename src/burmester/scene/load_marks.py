"""Springs, counterweights and the arrow of a hand, as lines of a display list."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final

import numpy as np

from burmester.loads.masses import body_named
from burmester.mechanisms.bodies import Bodies, Joint, LinkPlaces
from burmester.mechanisms.rates import rates
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.tasks.loads import Spring
from burmester.verdicts.motion import Motion

COILS: Final = 7
LEAD: Final = 0.15  # of a coil spring's length: the straight part at each end
BARREL: Final = 0.6  # of a gas spring's length: its cylinder
HALF_WIDTH: Final = 0.022  # of the linkage's size: half the width of a spring
ARROW: Final = 0.35  # of the linkage's size: the length of a hand's arrow
STRAIGHT: Final = ("extension", "compression", "gas", "constant")
TURNS: Final = 2.25  # of the spiral of a torsion spring
ROUND: Final = 3.0  # half widths of a spring: the radius of a spiral or a counterweight


def spring_line(kind: str, one: FloatArray, other: FloatArray, half: float) -> FloatArray:
    """A spring from one end (2,) to the other: a line (n, 2), half as wide as stated.

    A coil spring is a zigzag, a gas spring a cylinder with its rod, another one a straight line.
    """
    along = other - one
    length = float(np.hypot(*along))
    if kind == "constant" or length == 0:
        return np.stack([one, other])
    across = half * np.array([-along[1], along[0]]) / length
    if kind == "gas":
        middle = one + BARREL * along
        rim = [one + across, middle + across, middle]
        return np.stack([*rim, other, middle, middle - across, one - across, one + across])
    share = np.concatenate([[0.0], np.linspace(LEAD, 1 - LEAD, 2 * COILS + 1), [1.0]])
    out = np.zeros(share.shape)
    out[2:-2] = np.where(np.arange(2 * COILS - 1) % 2, -1.0, 1.0)
    return one + share[:, None] * along + out[:, None] * across


def ends_of(spring: Spring, bodies: Bodies, places: LinkPlaces) -> tuple[FloatArray, FloatArray]:
    """Both ends (*, 2) of a spring with the bodies at places (*,), in the task's unit."""
    at = (places[body_named(end.link, bodies)].act(np.array(end.point)) for end in spring.ends)
    return next(at), next(at)


def joint_of(spring: Spring, bodies: Bodies) -> Joint | None:
    """The joint that a torsion spring turns about; None where its links share none."""
    links = {body_named(end.link, bodies) for end in spring.ends}
    return next((each for each in bodies.joints if {*each.links} == links), None)


def middle_of(spring: Spring, bodies: Bodies, places: LinkPlaces) -> FloatArray | None:
    """Where a torsion spring or a counterweight is (*, 2), with the bodies at places (*,)."""
    if spring.kind == "counterweight":
        return ends_of(spring, bodies, places)[1]
    joint = joint_of(spring, bodies)
    return None if joint is None else places[joint.holder].act(joint.hole(joint.holder))


def round_line(kind: str, at: FloatArray, half: float) -> FloatArray:
    """A torsion spring, a spiral, or a counterweight, a disc with a cross, about a point (2,)."""
    if kind == "torsion":
        turn = np.linspace(0.0, 2 * np.pi * TURNS, 73)
        way = np.stack([np.cos(turn), np.sin(turn)], axis=-1) * (turn / turn[-1])[:, None]
    else:
        turn = np.linspace(0.0, 2 * np.pi, 37)
        rim = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        way = np.concatenate([rim, rim[[18]], rim[27:], rim[[0]], rim[[9]], rim[[27]]])
    return np.asarray(at + ROUND * half * way)


def drawn_springs(chosen: Candidate, places: LinkPlaces, size: float) -> list[FloatArray]:
    """The springs of a linkage with its bodies at a place (), as lines."""
    assert chosen.task.loads is not None
    bodies, half, out = chosen.bodies, HALF_WIDTH * size, list[FloatArray]()
    for each in chosen.task.loads.springs:
        if each.kind in STRAIGHT:
            out.append(spring_line(each.kind, *ends_of(each, bodies, places), half))
        elif (at := middle_of(each, bodies, places)) is not None:
            out.append(round_line(each.kind, at, half))
    return out


@lru_cache(maxsize=4)
def _sense(chosen: Candidate) -> float:
    """1 where the driver's coordinate grows from the first pose to the last, else -1."""
    first, last = Motion.of(chosen, 2).drive.tolist()
    return math.copysign(1.0, last - first)


def hand_arrow(chosen: Candidate, places: LinkPlaces, size: float) -> FloatArray | None:
    """The arrow of a hand that moves the body on towards the last pose: a line (5, 2).

    None without a hand, and at a dead point of the driver.
    """
    loads, bodies = chosen.task.loads, chosen.bodies
    if loads is None or loads.hand is None:
        return None
    one = LinkPlaces({name: places[name][None] for name in ("ground", *bodies.moving)})
    body = one[bodies.body]
    arm = body.rotate(loads.hand)
    (way,) = rates(bodies, one).of_point(bodies.body, arm)
    speed = float(np.hypot(*way))
    if not speed > 0:
        return None
    (at,) = body.act(loads.hand)
    ahead = _sense(chosen) * way / speed
    across = np.array([-ahead[1], ahead[0]])
    tip = at + ARROW * size * ahead
    barbs = [tip - 0.25 * ARROW * size * (ahead + side * 0.6 * across) for side in (1.0, -1.0)]
    return np.stack([at, tip, barbs[0], tip, barbs[1]])
