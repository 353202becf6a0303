"""A linkage that is let go: how it swings under its loads, without friction.

I q'' + I' q'² / 2 + T(q) = 0, where T is the effort that would hold it.  Between the places at
which a spring goes slack or a force sets in, I and T are smooth along the motion, so they are
polynomials (Chebyshev's) whose last coefficients have died out.  Time goes on by the rule of
Dormand and Prince, with steps that keep the error small.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Final, NamedTuple, Self

import numpy as np
from numpy.polynomial import chebyshev

from burmester.loads.loaded_motion import LoadedLinkage
from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import malformed

DEGREE: Final = 256
LOOKS: Final = 721  # places at which it is looked whether a spring goes slack between them
PARTS, ROUNDS = 32, 6  # of an interval in which one does, and of each that is left
MERGED: Final = 1e-9  # of the way; places that are nearer are one
LEAST_STEP: Final = 1e-6  # of the time between two of those told
DEAD: Final = 1e-15  # relative; coefficients below it are rounding
STEP_ERROR: Final = 1e-12  # relative, of one step
_STEPS: Final = (
    (),
    (1 / 5,),
    (3 / 40, 9 / 40),
    (44 / 45, -56 / 15, 32 / 9),
    (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
    (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
    (35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
)
_FOURTH: Final = np.array(
    [5179 / 57600, 0, 7571 / 16695, 393 / 640, -92097 / 339200, 187 / 2100, 1 / 40]
)


class Swing(NamedTuple):
    """At times (n,) in s: share of the way, the driver's coordinate, its speed, the energy in J.

    ended: whether it came to an end of the motion before the last time.
    """

    time: FloatArray
    share: FloatArray
    drive: FloatArray
    speed: FloatArray
    energy: FloatArray
    ended: bool


def swing(linkage: LoadedLinkage, start: float, seconds: float, count: int = 201) -> Swing:
    """A linkage that is let go at rest at a share of the driver's way.

    Raises E177 where nothing that moves has a mass.
    """
    bends = _bends(linkage)
    drives, middle = linkage.at_driver(bends).drive, float(linkage.at(2).drive.mean())
    pieces = [_Smooth.of(linkage, low, high) for low, high in pairwise(bends)]
    ends, half = drives[[0, -1]], float(abs(np.ptp(drives[[0, -1]]))) / 2
    inner, sense = np.sort(drives[1:-1]), int(np.sign(ends[1] - ends[0]))

    def values(q: float) -> FloatArray:
        return pieces[::sense][int(np.searchsorted(inner, q))].at(q)

    def rates(state: FloatArray) -> FloatArray:
        inertia, slope, effort, _ = values(state[0])
        return np.array([state[1], -(slope * state[1] ** 2 / 2 + effort) / inertia])

    state = np.array([ends[0] + (ends[1] - ends[0]) * start, 0.0])
    times, rows, step, now = np.linspace(0, seconds, count), [state], seconds / count / 4, 0.0
    size = np.array([abs(half), abs(half) / seconds])
    for until in times[1:]:
        while now < until:
            take = min(step, until - now)
            new, off = _step(rates, state, take)
            error = float(np.abs(off / (size + np.abs(state))).max())
            if error <= STEP_ERROR or take < LEAST_STEP * times[1]:
                now, state = (until if take == until - now else now + take), new
            step = take * min(4.0, max(0.2, 0.9 * (STEP_ERROR / max(error, 1e-30)) ** 0.2))
        if not abs(state[0] - middle) <= abs(half):
            break
        rows.append(state)
    q, speed = np.array(rows).T
    inertia, _, _, potential = np.array([values(each) for each in q]).T
    share = (q - ends[0]) / (ends[1] - ends[0])
    energy = potential + inertia * speed**2 / 2
    return Swing(times[: len(q)], share, q, speed, energy, len(q) < count)


class _Smooth(NamedTuple):
    """I, I', T and the potential energy as series over a part of the way, from place to place."""

    middle: float
    half: float
    series: FloatArray

    @classmethod
    def of(cls, linkage: LoadedLinkage, low: float, high: float) -> Self:
        """Between two shares of the driver's way."""
        nodes = chebyshev.chebpts1(DEGREE + 1)
        loaded = linkage.at_driver(low + (nodes + 1) / 2 * (high - low))
        ends = linkage.at_driver(np.array([low, high])).drive
        table = np.stack([loaded.inertia[0], loaded.inertia[1], loaded.effort, loaded.energy])
        if not (table[0] > 0).all():
            help = "give the body or the links a mass, or the links plates"
            raise malformed(
                "nothing that moves has a mass, so it has no motion of its own", help=help
            )
        series = 2.0 / (DEGREE + 1) * table @ chebyshev.chebvander(nodes, DEGREE)
        series[:, 0] /= 2
        alive = np.abs(series) > DEAD * np.abs(series).max(axis=1, keepdims=True)
        kept = np.flatnonzero(alive.any(axis=0)).max() + 1
        return cls(float(ends.mean()), float(ends[1] - ends[0]) / 2, series[:, :kept])

    def at(self, drive: float) -> FloatArray:
        """Their values (4,) at a place of the driver."""
        x = min(1.0, max(-1.0, (drive - self.middle) / self.half))
        return np.asarray(self.series @ np.cos(np.arange(self.series.shape[1]) * math.acos(x)))


def _bends(linkage: LoadedLinkage) -> FloatArray:
    """Shares of the driver's way, from 0 to 1, between which all that loads it is smooth."""
    reached = {at for force in linkage.loads.forces for at in (force.from_pose, force.to_pose)}
    ends = linkage.at(2).drive
    poses = [linkage.at_poses[at - 1] for at in reached if at is not None]
    met = (np.array(poses) - ends[0]) / (ends[1] - ends[0])
    out = [np.array([0.0, 1.0]), met[(met > MERGED) & (met < 1 - MERGED)]]
    shares = np.linspace(0.0, 1.0, LOOKS)
    for number, course in enumerate(linkage.at_driver(shares).springs):
        apart = course.length - course.slack
        low = shares[:-1][apart[:-1] * apart[1:] < 0]
        wide = 1 / (LOOKS - 1)
        for _ in range(ROUNDS if len(low) else 0):
            parts = low[:, None] + wide * np.linspace(0.0, 1.0, PARTS + 1)
            length = linkage.at_driver(parts.ravel()).springs[number].length
            apart = length.reshape(parts.shape) - course.slack
            low = parts[np.arange(len(low)), (apart[:, :-1] * apart[:, 1:] <= 0).argmax(axis=1)]
            wide /= PARTS
        out.append(low + wide / 2)
    every = np.unique(np.concatenate(out))
    return np.delete(every, np.flatnonzero(np.diff(every) < MERGED))


def _step(
    rates: Callable[[FloatArray], FloatArray], state: FloatArray, step: float
) -> tuple[FloatArray, FloatArray]:
    """The state a step later, of fifth order, and how far that of fourth order is from it."""
    slopes = list[FloatArray]()
    for row in _STEPS:
        there = state + step * sum(
            (a * k for a, k in zip(row, slopes, strict=True)), start=0 * state
        )
        slopes.append(rates(there))
    every = np.array(slopes)
    return there, step * ((np.array([*_STEPS[-1], 0]) - _FOURTH) @ every)
