"""A linkage of plates as bodies with weight, weighed point by point and moved in complex numbers.

Plates are told by their skeletons, not by their outlines: all that is within a radius of a polygon
and in no hole or slot.  A grid of points weighs them.  The motion is that of the witness.
"""

from dataclasses import dataclass

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles import witness
from tests.oracles.handed_over import complex_places

GRID = 40  # points on the width of a link
GRAVITY = 9.80665  # m/s²


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """Kilograms; metres, (3,); kg m², (3, 3) about the centre."""

    mass: float
    centre: np.ndarray
    inertia: np.ndarray


def away(points, corners):
    """The distances of points (complex) from a convex polygon, 0 inside."""
    one, two = corners, np.roll(corners, -1)
    with np.errstate(invalid="ignore"):
        share = ((points[:, None] - one) * (two - one).conj()).real / np.abs(two - one) ** 2
    share = np.clip(np.nan_to_num(share), 0, 1)
    gap = np.abs(points[:, None] - one - share * (two - one)).min(axis=1)
    if len(corners) < 3:
        return gap
    left = (((two - one).conj() * (points[:, None] - one)).imag >= 0).all(axis=1)
    return np.where(left, 0, gap)


def second_moments(plate, low, high, density):
    """Mass, first (3,) and second moments (3, 3) about the frame's origin; the plate in mm."""
    askew = np.exp(0.3j)  # so that no side of the plate is along the grid
    corners, r = plate.skeleton @ [1, 1j] / askew, plate.radius
    step = 2 * r / GRID
    x = np.arange(corners.real.min() - r + step / 2, corners.real.max() + r, step)
    y = np.arange(corners.imag.min() - r + step / 2, corners.imag.max() + r, step)
    points = (x[:, None] + 1j * y).ravel() * askew
    solid = away(points, corners * askew) <= r
    for cx, cy, diameter in plate.holes:
        solid &= np.abs(points - complex(cx, cy)) > diameter / 2
    for x1, y1, x2, y2, width in plate.slots:
        solid &= away(points, np.array([complex(x1, y1), complex(x2, y2)])) > width / 2
    # Two layers of points have the second moments of a slab.
    z = (low + high) / 2 + (high - low) / np.sqrt(12) * np.repeat([-1, 1], solid.sum())
    both = np.tile(points[solid], 2)
    every = np.column_stack([both.real, both.imag, z]) / 1000
    grains = density * (step / 1000) ** 2 * (high - low) / 1000 / 2
    return grains * len(every), grains * every.sum(axis=0), grains * every.T @ every


def cylinder(x, y, radius, heights, density):
    """The same of an upright cylinder, mm, in closed form."""
    low, high = heights
    mass = density * np.pi * radius**2 * (high - low) * 1e-9
    centre = np.array([x, y, (low + high) / 2]) / 1000
    own = np.diag([radius**2 / 4, radius**2 / 4, (high - low) ** 2 / 12]) * 1e-6
    return mass, mass * centre, mass * (np.outer(centre, centre) + own)


def weighed(chosen, made, density=2700.0):
    """The bodies ground, driver, coupler and follower of plates; sliders' pins are bodies."""
    step, thick = made.dimensions.thickness + made.dimensions.gap, made.dimensions.thickness
    parts = {name: [] for name in ("ground", "driver", "coupler", "follower")}
    for plate in made.plates:
        low = plate.layer * step
        parts[plate.owner].append(second_moments(plate, low, low + thick, density))
    sides = {"driver": chosen.linkage.first, "follower": chosen.linkage.second}
    for pin in made.pins:
        owner, x, y = ("ground" if "ground" in pin.plate else "coupler"), pin.x, pin.y
        for name, dyad in sides.items():
            own = dyad.fixed_pivot if isinstance(dyad, RP) else dyad.moving_pivot
            there = owner == ("ground" if isinstance(dyad, RP) else "coupler")
            near = np.hypot(*(own * made.reference.scale - [x, y])) < 1e-6 * made.dimensions.width
            if not isinstance(dyad, RR) and there and near:
                owner, x, y = name, 0.0, 0.0
        radius = pin.diameter / 2
        own = cylinder(x, y, radius, (pin.low * step, pin.high * step + thick), density)
        parts[owner].append(own)
    bodies = {}
    for name, every in parts.items():
        mass, first, second = (sum(each) for each in zip(*every, strict=True))
        centre = first / mass
        spread = second - mass * np.outer(centre, centre)
        bodies[name] = Body(mass, centre, np.trace(spread) * np.eye(3) - spread)
    return bodies


class Weights:
    """The moving bodies of a linkage near its poses: energy and inertia along the driver's way.

    The driver's coordinate: as in the files, radians or metres.  scale: metres per unit.
    """

    def __init__(self, chosen, bodies, scale, up=1j):
        self.dyads = chosen.linkage.first, chosen.linkage.second
        self.bodies, self.scale, self.up = bodies, scale, up
        self.d, self.turn = complex_places(chosen)

    def drive_at(self, k):
        """The driver's coordinate at a pose."""
        dyad, d, turn = self.dyads[0], self.d[k], self.turn[k]
        if isinstance(dyad, RP):
            return float(np.angle(turn) + dyad.normal_angle)
        pin = d + turn * complex(*dyad.moving_pivot)
        if isinstance(dyad, RR):
            return float(np.angle(pin - complex(*dyad.fixed_pivot)))
        return float((pin * np.exp(-1j * dyad.normal_angle)).imag) * self.scale

    def place(self, drive, near):
        """The coupler's place (d, turn) for a drive, of both the one that is near another."""
        first, second = self.dyads
        if isinstance(first, RP):
            phi = np.array([drive - first.normal_angle])
            where = witness.turned(first, second, phi)
            phi = np.stack([phi, phi])
        else:
            value = drive / self.scale if isinstance(first, PR) else drive
            where, phi = witness.places(first, second, np.array([value]))
        turn = np.exp(1j * phi[:, 0])
        size = np.abs(self.d - self.d.mean()).max()
        gap = np.abs(where[:, 0] - near[0]) / size + np.abs(turn - near[1])
        best = int(np.nanargmin(gap))
        return where[best, 0], turn[best]

    def state(self, place):
        """Of each moving body: mass, inertia about z, centre of mass (metres), turn."""
        d, turn = place
        told = []
        for name, dyad in zip(("driver", "follower"), self.dyads, strict=True):
            body = self.bodies[name]
            if isinstance(dyad, RP):
                at, own = complex(*dyad.fixed_pivot), turn
            else:
                at, own = d + turn * complex(*dyad.moving_pivot), 1
                if isinstance(dyad, RR):
                    arm = at - complex(*dyad.fixed_pivot)
                    at, own = complex(*dyad.fixed_pivot), arm / abs(arm)
            told.append((body, at, own))
        told.append((self.bodies["coupler"], d, turn))
        return [
            (
                body.mass,
                body.inertia[2, 2],
                at * self.scale + own * complex(*body.centre[:2]),
                own,
            )
            for body, at, own in told
        ]

    def energy(self, place):
        """The potential energy, joule."""
        return sum(m * GRAVITY * (np.conj(self.up) * c).real for m, _, c, _ in self.state(place))

    def along(self, drive, near, h=1e-4):
        """The generalized force that holds, and the reduced inertia, by differences."""
        h *= self.scale * np.abs(self.d - self.d.mean()).max() if self._slides else 1
        one, two = (self.place(drive + sign * h, near) for sign in (-1, 1))
        force = (self.energy(two) - self.energy(one)) / (2 * h)
        inertia = 0.0
        for (m, i, c1, t1), (_, _, c2, t2) in zip(self.state(one), self.state(two), strict=True):
            inertia += m * abs((c2 - c1) / (2 * h)) ** 2 + i * (np.angle(t2 / t1) / (2 * h)) ** 2
        return force, inertia

    @property
    def _slides(self):
        return isinstance(self.dyads[0], PR)
