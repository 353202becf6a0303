"""Linkages of all kinds with a range of their driver, driven by `witness` from end to end."""

from itertools import product

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.witness import places, turned

KINDS = list(product((RR, PR, RP), repeat=2))
LOOKED_FURTHER = 1.0  # radians or lengths, at most, to either side of a start


def dyad_through(kind, rng, d, phi):
    """A random dyad whose constraint a body place d (complex), phi meets."""
    turn = np.exp(1j * phi)
    c, m = rng.normal(size=2), rng.normal(size=2)
    angle = rng.uniform(-np.pi, np.pi)
    if kind is RR:
        return RR(c, m, abs(d + complex(*m) * turn - complex(*c)))
    normal = np.exp(-1j * angle)
    if kind is PR:
        return PR(angle, (normal * (d + complex(*m) * turn)).real, m)
    return RP(c, angle, (normal * (complex(*c) - d) / turn).real)


def input_at(dyad, d, phi):
    """The input of a dyad at a body place: the angle of its link or slot, or the way on a rail."""
    if isinstance(dyad, RP):
        return phi + float(dyad.normal_angle)
    pin = d + complex(*dyad.moving_pivot) * np.exp(1j * phi)
    if isinstance(dyad, RR):
        return np.angle(pin - complex(*dyad.fixed_pivot))
    return (pin * np.exp(-1j * float(dyad.normal_angle))).imag


def driven_to(first, second, drive):
    """Body places, two assemblies each, at inputs (n,) of the first dyad."""
    if isinstance(first, RP):
        phi = drive - float(first.normal_angle)
        where = turned(first, second, phi)
        return where, np.broadcast_to(phi, where.shape)
    return places(first, second, drive)


class DrivenRange:
    """Two dyads, the assembly that is driven, and the ends of its range of inputs."""

    def __init__(self, kinds, rng):
        while True:
            d, phi = complex(*rng.normal(size=2)), rng.uniform(-np.pi, np.pi)
            self.dyads = [dyad_through(kind, rng, d, phi) for kind in kinds]
            start = input_at(self.dyads[0], d, phi)
            where, angle = driven_to(*self.dyads, np.array([start]))
            off = np.nan_to_num(abs(where[:, 0] - d) + abs(np.exp(1j * angle[:, 0] - 1j * phi) - 1))
            if not np.isfinite(where[:, 0]).any():
                continue
            self.side = int(off.argmin())
            below, above = rng.uniform(0.05, LOOKED_FURTHER, 2)
            self.low, self.high = start - below, start + above
            x, y = self.places(np.linspace(self.low, self.high, 401))
            if not (np.isfinite(x).all() and np.isfinite(y).all()):
                continue
            # One branch: nothing jumps.
            step = abs(np.diff(x)) + abs(np.diff(np.exp(1j * y)))
            if step.max() < 0.1 and abs(x).max() < 20:
                return

    def places(self, drive):
        """Body places (x + iy, angle), (n,) each, at inputs (n,)."""
        where, phi = driven_to(*self.dyads, np.asarray(drive, dtype=float))
        return where[self.side], phi[self.side]

    def poses(self, count=4):
        """Rows (count, 3) of places along the range, its ends among them."""
        where, phi = self.places(np.linspace(self.low, self.high, count))
        return np.column_stack([where.real, where.imag, np.unwrap(phi)])

    def pivots(self, count=20_001):
        """All pivots (n,), complex, along the range."""
        where, phi = self.places(np.linspace(self.low, self.high, count))
        out = []
        for dyad in self.dyads:
            if not isinstance(dyad, PR):
                out.append(np.array([complex(*dyad.fixed_pivot)]))
            if not isinstance(dyad, RP):
                out.append(where + complex(*dyad.moving_pivot) * np.exp(1j * phi))
        return np.concatenate(out)

    def stop(self, end, sense, turns):
        """How far the driver goes on from an end until it locks; infinite if it never does."""
        most = 2 * np.pi if turns else 200.0
        way = most * np.linspace(0, 1, 200_001)
        lost = ~np.isfinite(self.places(end + sense * way)[0])
        if not lost.any():
            return np.inf
        at = int(lost.argmax())
        low, high = way[max(at - 1, 0)], way[at]
        for _ in range(50):
            middle = (low + high) / 2
            ok = np.isfinite(self.places(np.array([end + sense * middle]))[0][0])
            low, high = (middle, high) if ok else (low, middle)
        return low
