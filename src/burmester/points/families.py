"""Whether a linkage that meets an Alt-Burmester problem is alone, or one of infinitely many.

Points that are symmetric, or of which two are one, leave curves of solutions beside those that
stand alone.  Paths end on them where the equations are singular.  There a step along the direction
in which they do not change, and Newton's steps across it, lead to another linkage.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.numerics.arrays import ComplexArray
from burmester.points.alt_burmester import UNKNOWNS, Positions

__all__ = ["is_in_family"]

STEPS: Final = 30  # of Newton's, at most
MET: Final = 1e-10  # of an equation, in lengths of about 1; less is rounding
FLAT: Final = 1e-6  # relative; a singular value below this vanishes
ALONG: Final = 0.05  # length of the step, in the linkage's numbers
MOST: Final = 1e3  # a linkage with greater numbers is on its way to infinity


def is_in_family(x: ComplexArray, turns: ComplexArray, positions: Positions) -> bool:
    """Whether a linkage near x (8,), turns (J,) is one of infinitely many that meet a problem."""
    free = positions.further_poses
    own = _met(np.concatenate([x, turns[free:]]), positions, np.empty(0, dtype=complex), 0.0)
    if own is None:
        return False
    _, rows = _equations(own, positions)
    values, directions = np.linalg.svd(rows)[1:]
    if len(values) == len(own) and values[-1] > FLAT * values[0]:
        return False
    direction = directions[-1].conj()
    other = _met(own + ALONG * direction, positions, direction, own @ direction.conj() + ALONG)
    return other is not None and float(np.abs(other - own).max()) < 1.0


def _met(
    start: ComplexArray, positions: Positions, direction: ComplexArray, at: complex
) -> ComplexArray | None:
    """The solution that Newton's least steps lead to; None where they lead to none.

    direction: empty, or that along which it has to stay `at`.
    """
    own = start
    for _ in range(STEPS):
        miss, rows = _equations(own, positions)
        if direction.size:
            miss = np.append(miss, own @ direction.conj() - at)
            rows = np.vstack([rows, direction.conj()])
        if not (np.isfinite(rows).all() and np.abs(own).max() < MOST):
            return None
        step = np.linalg.lstsq(rows, -miss, rcond=FLAT / 10)[0]
        own = own + step / max(1.0, float(np.abs(step).max()))
    return own if np.abs(_equations(own, positions)[0]).max() < MET else None


def _equations(own: ComplexArray, positions: Positions) -> tuple[ComplexArray, ComplexArray]:
    """The equations of `alt_burmester` (2 J + given,), and their derivatives (*, 8 + points)."""
    P, Pb, poses = positions.P[0], positions.Pb[0], positions.further_poses
    T = np.concatenate([positions.T[0], own[UNKNOWNS:]])
    number = np.arange(len(P))
    misses, every = [], []
    for dyad in (0, 4):
        u, ub, z, zb = own[dyad : dyad + 4]
        v, w = P + (T - 1) * z, Pb + (1 / T - 1) * zb
        rows = np.zeros((len(P), UNKNOWNS + len(P)), dtype=np.complex128)
        rows[:, dyad], rows[:, dyad + 1] = -w, -v
        rows[:, dyad + 2], rows[:, dyad + 3] = (w - ub) * (T - 1), (v - u) * (1 / T - 1)
        rows[number, UNKNOWNS + number] = (w - ub) * z - (v - u) * zb / T**2
        misses.append(v * w - v * ub - w * u)
        every.append(np.delete(rows, UNKNOWNS + number[:poses], axis=1))
    for k in range(positions.pivots):  # u + z is the fixed pivot
        row = np.zeros((2, every[0].shape[1]), dtype=np.complex128)
        row[0, [4 * k, 4 * k + 2]] = row[1, [4 * k + 1, 4 * k + 3]] = 1.0
        u, ub, z, zb = own[4 * k : 4 * k + 4]
        misses.append(np.array([u + z - positions.G[0, k], ub + zb - positions.Gb[0, k]]))
        every.append(row)
    return np.concatenate(misses), np.concatenate(every)
