"""Where a loaded linkage rests by itself: the roots of the effort that holds it.

Places are looked at closely where the effort changes sign, and between neighbours where it comes
near zero and turns; a pair of roots closer than the finer looks may be missed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np

from burmester.numerics.arrays import FloatArray

FINER: Final = 16  # looks between two places where a pair of roots may be
NARROWINGS: Final = 10  # at most; each to a part of FINER, or much less where the effort is smooth
CLOSE: Final = 1e-13  # of the motion; a root between places that are as near is found
EVEN: Final = np.linspace(0.0, 1.0, FINER + 1)[1:-1]
BESIDE: Final = np.concatenate([sign * 10.0 ** -np.arange(1.0, 9.0) for sign in (1.0, -1.0)])


class Equilibrium(NamedTuple):
    """A share of the motion at which nothing holds the linkage; stable: whether it comes back."""

    share: float
    stable: bool


def equilibria(
    shares: FloatArray,
    effort: FloatArray,
    sense: float,
    at: Callable[[FloatArray], FloatArray],
    none: float = 0.0,
) -> tuple[Equilibrium, ...]:
    """The roots of the effort (n,) at shares (n,), in their order.

    at: the effort at further shares.  sense: 1 where the driver's coordinate grows with the shares.
    none: an effort that is not greater is none.  Where there is none from one place to the next the
    linkage rests wherever it is left, and no single place is told.
    """
    near = np.minimum(np.abs(effort[:-1]), np.abs(effort[1:])) < 2 * np.abs(np.diff(effort))
    low, high = effort[:-2], effort[2:]
    turns = (np.abs(effort[1:-1]) <= np.minimum(np.abs(low), np.abs(high))) & (low * high > 0)
    near |= np.append(turns, False) | np.append(False, turns)
    more = (shares[:-1, None] + np.diff(shares)[:, None] * EVEN)[near].ravel()
    if len(more):
        shares, order = np.unique(np.concatenate([shares, more]), return_index=True)
        effort = np.concatenate([effort, at(more)])[order]
    sign = np.where(np.abs(effort) <= none, 0.0, np.sign(effort))
    zero = np.concatenate([[False], sign == 0, [False]])
    alone = zero[1:-1] & ~zero[:-2] & ~zero[2:]
    found = [Equilibrium(float(shares[k]), _rises(effort, int(k), sense))
             for k in np.flatnonzero(alone)]  # fmt: skip
    crossed = np.flatnonzero(sign[:-1] * sign[1:] < 0)
    if len(crossed):
        below, above = shares[crossed], shares[crossed + 1]
        ends = np.stack([effort[crossed], effort[crossed + 1]], axis=1)
        rising = sign[crossed + 1] > 0
        every = np.arange(len(crossed))
        for _ in range(NARROWINGS):
            # Where the effort is smooth, the root is next to that of the chord.
            chord = ends[:, :1] / (ends[:, :1] - ends[:, 1:])
            parts = np.concatenate([EVEN + 0 * chord, np.clip(chord + BESIDE, 0.0, 1.0)], axis=1)
            there = below[:, None] + (above - below)[:, None] * np.sort(parts, axis=1)
            values = at(there.ravel()).reshape(there.shape)
            there = np.column_stack([below, there, above])
            values = np.column_stack([ends[:, 0], values, ends[:, 1]])
            looks = (values[:, 1:-1] > 0) != rising[:, None]
            before = looks.sum(axis=1)  # looks that are before the root
            below, above = there[every, before], there[every, before + 1]
            ends = np.stack([values[every, before], values[every, before + 1]], axis=1)
            if (above - below <= CLOSE).all():
                break
        found += [
            Equilibrium(float(share), bool(up == (sense > 0)))
            for share, up in zip((below + above) / 2, rising, strict=True)
        ]
    return tuple(sorted(found))


def _rises(effort: FloatArray, k: int, sense: float) -> bool:
    """Whether an effort that is zero at a place pushes back on both sides of it."""
    before = sense * effort[k - 1] if k > 0 else -1.0
    after = sense * effort[k + 1] if k + 1 < len(effort) else 1.0
    return bool(before < 0 < after)
