"""The branches of a driver: what it drives a mechanism through without a stop.

A branch is an arc of a circuit between two dead points of the driver, or the whole circuit where
there is none.  On it the driver's angle, counted over whole turns, goes one way.  So a place on it
is told by that angle as well, which may pass a turn: the other links need not come back after one.

Dead points come from the kind of the mechanism, which finds all of them.  On each circuit they are
even in number, and the driver turns back at each: where these two checks fail, dead points are
those of a scan.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple, final

import numpy as np

from burmester.mechanisms.circuits import Circuits
from burmester.mechanisms.contract import Mechanism, drive_of
from burmester.numerics.arrays import TURN, ComplexArray, FloatArray, wrapped_angle
from burmester.numerics.iteration import golden_section

STEPS = 720  # of the table of a branch, for each piece of its circuit
SOLVED = 60  # steps of the search for the share of an angle
NARROWEST = 1e-6  # radians; over less a driver does not move
ROUNDING = 1e-15  # of shares, and of angles in radians
AT_DEAD_POINT = 1e-9  # radians; a drive that passes a dead point by less is at it
FAR = 1e-3  # of the longest bar: a dead point is none of a circuit that it misses by more


@final
class Branch(NamedTuple):
    """A branch: of one mechanism, on one circuit, with one driver.

    pivot: of the driver.  low, high: the shares at its ends, which may pass the seam.
    turns: 0 where it ends at dead points; else it is closed, and all is as it was after as many.
    shares, drives: (m,), places from low to high, and the driver's angles there, in radians, in F.
    certain: whether the driver's dead points on its circuit pass both checks.
    """

    circuits: Circuits
    pivot: str
    circuit: int
    low: float
    high: float
    turns: int
    shares: FloatArray
    drives: FloatArray
    certain: bool

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the greatest angle of the driver, infinite where it is closed."""
        if self.turns:
            return -np.inf, np.inf
        return float(self.drives.min()), float(self.drives.max())

    def moved(self, turns: float) -> Branch:
        """The same with angles that are so many turns greater."""
        return self._replace(drives=self.drives + TURN * turns)

    def at_share(self, mechanism: Mechanism, share: FloatArray) -> ComplexArray:
        """The joints (*, j) at shares (*,)."""
        return self.circuits.joints(mechanism, self.circuit, share)

    def at(self, mechanism: Mechanism, drive: FloatArray) -> ComplexArray:
        """The joints (*, j) at angles (*,) of the driver; nan beyond the ends.

        On a branch that is narrower than a turn angles may be off by whole turns.
        """
        return self.at_share(mechanism, self.share(mechanism, drive))

    def drive(self, mechanism: Mechanism, share: FloatArray) -> FloatArray:
        """The driver's angles (*,) at shares (*,) from low to high."""
        near = np.interp(share, self.shares, self.drives)
        there = drive_of(mechanism.skeleton, self.at_share(mechanism, share), self.pivot)
        return np.asarray(near + wrapped_angle(there - near))

    def share(self, mechanism: Mechanism, drive: FloatArray) -> FloatArray:
        """The shares (*,) at angles (*,) of the driver; nan beyond the ends.

        Of a closed branch they go on past its ends, as the angles do.
        """
        drive = np.asarray(drive, dtype=np.float64)
        low, high = float(self.drives.min()), float(self.drives.max())
        period = TURN * self.turns if self.turns else TURN if high - low < TURN else 0.0
        rounds = np.zeros_like(drive)
        if period:
            rounds = np.floor((drive - low + AT_DEAD_POINT) / period)
        within = drive - period * rounds
        outside = (within < low - AT_DEAD_POINT) | (within > high + AT_DEAD_POINT)
        within = np.clip(within, low, high)
        sense = 1.0 if self.drives[-1] > self.drives[0] else -1.0
        share = self._solved(mechanism, within, sense)
        if self.turns:
            return np.asarray(share + sense * rounds * (self.high - self.low))
        return np.where(outside, np.nan, share)

    def _solved(self, mechanism: Mechanism, drive: FloatArray, sense: float) -> FloatArray:
        """The shares (*,) at angles (*,) between the ends.

        Newton's steps with the slope of the parabola through three places, in a bracket.
        """
        table = np.maximum.accumulate(sense * self.drives)  # rounding beside a dead point
        right = np.clip(np.searchsorted(table, sense * drive), 1, len(table) - 1)
        one, other = self.shares[right - 1], self.shares[right]
        at_one, at_other = self.drives[right - 1] - drive, self.drives[right] - drive
        shape = drive.shape
        out, left = np.empty(drive.size), np.arange(drive.size)  # those that are still sought
        drive, one, other, at_one, at_other = (
            each.ravel() for each in (drive, one, other, at_one, at_other)
        )
        with np.errstate(invalid="ignore", divide="ignore"):
            new = (one * at_other - other * at_one) / (at_other - at_one)
        for _ in range(SOLVED):
            new = np.where((new - one) * (new - other) <= 0, new, (one + other) / 2)
            there = drive_of(mechanism.skeleton, self.at_share(mechanism, new), self.pivot)
            off = wrapped_angle(there - drive)
            with np.errstate(invalid="ignore", divide="ignore"):
                slopes = (off - at_one) / (new - one), (at_other - off) / (other - new)
                bend = (slopes[1] - slopes[0]) / (other - one)
                slope = slopes[0] + bend * (new - one)
                step = -off / slope
                left_off = (
                    np.abs(bend) * step**2 + np.abs(off) * (bend * (other - one) / slope) ** 2
                )
            exact = (left_off <= ROUNDING) & ((new + step - one) * (new + step - other) <= 0)
            out[left] = np.where(exact, new + step, new)
            narrow = np.abs(other - one) <= ROUNDING * (1 + np.abs(new))
            more = ~(exact | narrow | (np.abs(off) <= ROUNDING))
            left = left[more]
            if not len(left):
                break
            kept = off * at_other < 0  # the root is between these two
            one, at_one = np.where(kept, new, one), np.where(kept, off, at_one)
            other, at_other = np.where(kept, other, new), np.where(kept, at_other, off)
            drive, one, other, at_one, at_other, new = (
                each[more] for each in (drive, one, other, at_one, at_other, new + step)
            )
        return out.reshape(shape)


def branches_of(mechanism: Mechanism, circuits: Circuits, pivot: str) -> tuple[Branch, ...]:
    """The branches of one mechanism with a driver, circuit by circuit."""
    out = list[Branch]()
    if not len(circuits.first):
        return ()
    own = pivot == mechanism.generator
    dead = None
    if not own:
        joints = mechanism.still(pivot)
        circuit, share, off = circuits.found(mechanism, joints)
        there = off < FAR * float(mechanism.lengths().max())
        dead = circuit[there], share[there]
    for number, length in enumerate(circuits.length.tolist()):
        whole = bool(circuits.whole[circuits.first[number]])
        if dead is None:
            cuts = np.arange(0 if whole else length, dtype=float)
        else:
            cuts = np.sort(np.mod(dead[1][dead[0] == number], length))
        branches, certain = _between(mechanism, circuits, pivot, number, cuts)
        if not certain and not own:
            scan = _scanned(mechanism, circuits, pivot, number)
            branches, certain = _between(mechanism, circuits, pivot, number, scan)
            branches = [each._replace(certain=False) for each in branches]
        out += branches
    return tuple(out)


def _between(
    mechanism: Mechanism, circuits: Circuits, pivot: str, circuit: int, cuts: FloatArray
) -> tuple[list[Branch], bool]:
    """The branches of a circuit between dead points at shares `cuts`, and whether these are all."""
    length, closed = float(circuits.length[circuit]), bool(circuits.closed[circuit])
    if not closed:
        cuts = np.concatenate([[0.0], cuts[(cuts > 0) & (cuts < length)], [length]])
    if not len(cuts):
        cuts, turning = np.array([0.0]), True
    else:
        turning = False
    ends = np.append(cuts, cuts[0] + length) if closed else cuts
    tables = [_table(mechanism, circuits, pivot, circuit, two) for two in pairwise(ends.tolist())]
    senses = [_sense(drives) for _, drives in tables]
    turns = round(abs(tables[0][1][-1] - tables[0][1][0]) / TURN) if turning and tables else 0
    certain = all(senses) and (turns > 0 if turning else True)
    if closed and not turning:
        certain = certain and len(cuts) % 2 == 0
        certain = certain and all(a == -b for a, b in pairwise(senses))
    branches = [
        Branch(circuits, pivot, circuit, shares[0], shares[-1], turns, shares, drives, certain)
        for shares, drives in tables
        if np.ptp(drives) > NARROWEST
    ]
    return branches, certain


def _table(
    mechanism: Mechanism, circuits: Circuits, pivot: str, circuit: int, ends: tuple[float, float]
) -> tuple[FloatArray, FloatArray]:
    """Shares from one end to the other, even ones, and the driver's angles there without jumps."""
    low, high = ends
    shares = np.linspace(low, high, int(np.ceil(STEPS * (high - low))) + 17)
    joints = circuits.joints(mechanism, circuit, shares)
    return shares, np.unwrap(drive_of(mechanism.skeleton, joints, pivot))


def _sense(drives: FloatArray) -> int:
    """Whether angles rise (1) or fall (-1) all along; 0 where neither."""
    steps = np.diff(drives)
    steps = steps[np.abs(steps) > AT_DEAD_POINT]
    return (
        int(np.sign(steps[0])) if len(steps) and (np.sign(steps) == np.sign(steps[0])).all() else 0
    )


def _scanned(mechanism: Mechanism, circuits: Circuits, pivot: str, circuit: int) -> FloatArray:
    """The shares at which a driver turns back, as a scan of its angle finds them."""
    length = float(circuits.length[circuit])
    shares, drives = _table(mechanism, circuits, pivot, circuit, (0.0, length))
    step = float(shares[1] - shares[0])
    steps = np.diff(drives)
    steps = np.append(steps, steps[0])
    back = np.flatnonzero(steps[:-1] * steps[1:] < 0) + 1
    sense = np.sign(steps[back - 1])

    def beyond(share: FloatArray) -> FloatArray:
        joints = circuits.joints(mechanism, circuit, share)
        there = drive_of(mechanism.skeleton, joints, pivot)
        return -sense * wrapped_angle(there - drives[back])

    found, _ = golden_section(beyond, shares[back] - step, shares[back] + step)
    return np.sort(np.mod(found, length))
