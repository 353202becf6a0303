"""Tasks with a rail or a slot that a linkage is known to keep: it is driven by the witness."""

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point, Polygon, Segment, box
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.rails import Rail
from tests.oracles.witness import places

SAMPLES = 121  # places of a planted motion
TRANSMISSION = np.radians(35.0)  # least of a planted linkage at its places
MIXES = (("PR", "RR"), ("RR", "PR"), ("RR", "RP"), ("PR", "RP"))


def planted(rng, count=None):
    """A task of `count` poses (3 to 8), and the two dyads that keep its limits."""
    while True:
        mix = MIXES[rng.integers(len(MIXES))]
        one, two = (_dyad(rng, kind) for kind in mix)
        number = count or int(rng.integers(3, 9))
        body = _motion(rng, one, two)
        if body is None:
            continue
        at = np.sort(rng.choice(np.arange(0, SAMPLES, 4), size=number, replace=False))
        z, phi = (each[at] for each in body)
        if np.ptp(phi) < 0.4 or np.ptp(z.real) + np.ptp(z.imag) < 40:
            continue
        poses = Displacement(np.stack([z.real, z.imag], axis=-1), phi)
        limits = tuple(_limits(rng, each, body) for each in (one, two))
        return Task(poses, limits=limits), (one, two)


def _dyad(rng, kind):
    angle = np.asarray(rng.uniform(0, np.pi))
    if kind == "RR":
        return RR(
            rng.uniform(-150, 150, 2), rng.uniform(-80, 80, 2), np.asarray(rng.uniform(70, 200))
        )
    if kind == "PR":
        return PR(angle, np.asarray(rng.uniform(-100, 100)), rng.uniform(-80, 80, 2))
    return RP(rng.uniform(-150, 150, 2), angle, np.asarray(rng.uniform(-60, 60)))


def _motion(rng, one, two):
    """Places (z, phi) of the body on one branch, or None."""
    if isinstance(one, PR):
        begin, span = rng.uniform(-150, 50), rng.uniform(80, 250)
    else:
        begin, span = rng.uniform(-np.pi, np.pi), rng.uniform(0.5, 1.8)
    drive = np.linspace(begin, begin + span, SAMPLES)
    z, phi = (each[0] for each in places(one, two, drive))
    if not np.isfinite(phi).all():
        return None
    phi = np.unwrap(phi)
    pin = z + np.exp(1j * phi) * complex(*_hand(one))
    if isinstance(two, RR):
        arm = z + np.exp(1j * phi) * complex(*two.moving_pivot) - pin
        link = pin + arm - complex(*two.fixed_pivot)
    elif isinstance(two, PR):
        arm, link = (
            z + np.exp(1j * phi) * complex(*two.moving_pivot) - pin,
            np.exp(1j * two.normal_angle),
        )
    else:
        arm, link = complex(*two.fixed_pivot) - pin, np.exp(1j * (two.normal_angle + phi))
    sine = np.abs((np.conj(arm) * link).imag) / np.abs(arm) / np.abs(link)
    far = np.abs(arm).min() > 30
    return (z, phi) if sine.min() > np.sin(TRANSMISSION) and far else None


def _hand(dyad):
    return dyad.moving_pivot


def _limits(rng, dyad, body):
    """Limits that a dyad keeps: boxes around the pivots, and of a slider its rail or slot."""

    def around(at):
        low, high = rng.uniform(5, 60, 2), rng.uniform(5, 60, 2)
        return box(at - low, at + high)

    if isinstance(dyad, RR):
        return Limits(
            fixed_pivot=around(dyad.fixed_pivot),
            moving_pivot=around(dyad.moving_pivot),
            kinds=frozenset({"RR"}),
        )
    z, phi = body
    if isinstance(dyad, PR):
        pins = z + np.exp(1j * phi) * complex(*dyad.moving_pivot)
    else:
        pins = np.exp(-1j * phi) * (complex(*dyad.fixed_pivot) - z)
    rail = rail_for(rng, float(dyad.normal_angle), float(dyad.offset), pins)
    if isinstance(dyad, PR):
        pivot = around(dyad.moving_pivot) if rng.uniform() < 0.5 else None
        return Limits(rail=rail, moving_pivot=pivot)
    pivot = around(dyad.fixed_pivot) if rng.uniform() < 0.5 else None
    return Limits(slot=rail, fixed_pivot=pivot)


def rail_for(rng, normal_angle, offset, pins):
    """A rail that a line and its pins (complex) keep: tolerance, place and travel at random."""
    along = np.exp(1j * (normal_angle - np.pi / 2))
    foot = offset * np.exp(1j * normal_angle)
    share = ((pins - foot) * np.conj(along)).real
    low, high = share.min() - rng.uniform(3, 40), share.max() + rng.uniform(3, 40)
    side = 1j * along
    if rng.uniform() < 0.15:
        return Rail(travel=Segment(_pair(foot + low * along), _pair(foot + high * along)))
    tolerance = float(rng.choice([0.0, rng.uniform(0.5, 10)]))
    direction = np.degrees(normal_angle) - 90 + rng.uniform(-tolerance, tolerance)
    at = foot + rng.uniform(-150, 150) * along
    ends = at + rng.uniform(2, 40) * side, at - rng.uniform(2, 40) * side * np.exp(0.3j)
    through = [None, Point(_pair(at)), Segment(_pair(ends[0]), _pair(ends[1]))][rng.integers(3)]
    travel = None
    if rng.uniform() < 0.6:
        wide = rng.uniform(3, 30, 2)
        corners = [low * along - wide[0] * side, high * along - wide[0] * side]
        corners += [high * along + wide[1] * side, low * along + wide[1] * side]
        travel = Polygon(np.array([_pair(foot + each) for each in corners]))
    if through is not None and rng.uniform() < 0.2:
        return Rail(through=through, travel=travel)
    return Rail(direction, tolerance, through, travel)


def _pair(z):
    return [z.real, z.imag]
