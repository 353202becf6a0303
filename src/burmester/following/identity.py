"""Which dyads of a new task are those of the task before: identity by nearness."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from burmester.dyads.selection import FoundDyad
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.constraint_manifold import INVARIANT
from burmester.numerics.arrays import FloatArray

__all__ = ["Identities", "identities"]

FARTHEST = 0.1  # sine of the angle between two manifolds; farther ones are never one dyad
AS_NEAR = 3.0  # ratio of the distances from two dyads, up to which neither is surely the one
ROUNDING = 1e-6  # sine; dyads that moved by less are themselves, whatever is near


class Identities(NamedTuple):
    """old: for each new dyad the number of the old one that it continues, or -1.

    doubtful: pairs of an old dyad and another one that came as near to the same new one.
    """

    old: list[int]
    doubtful: list[tuple[int, int]]


def identities(
    before: Sequence[FoundDyad],
    after: Sequence[FoundDyad],
    moves: Sequence[tuple[Dyad, Dyad]],
    frames: CanonicalFrames,
) -> Identities:
    """Each new dyad with the old one nearest to it, each old one once, nearest pairs first.

    Near as points of the space of manifolds, where a long link on one side of its slider is
    beside one on the other side.  Dyads under different limits are never one.
    moves: dyads of which it is known where they went; these are looked for there.
    """
    one, two = (_vectors([each.dyad for each in some], frames) for some in (before, after))
    if moves and len(one):
        start, end = (_vectors(some, frames) for some in zip(*moves, strict=True))
        near = _sines(one, start)
        nearest = near.argmin(axis=1)
        known = near.min(axis=1) < ROUNDING
        one = np.where(known[:, None], end[nearest], one)
    chosen = [-1] * len(after)
    if not len(one) or not len(two):
        return Identities(chosen, [])
    sine = _sines(two, one)
    limits = [np.array([each.limits for each in some]) for some in (after, before)]
    sine = np.where(limits[0][:, None] == limits[1], sine, np.inf)
    doubtful, free = [], set(range(len(before)))
    for at in np.argsort(sine, axis=None, kind="stable"):
        new, old = divmod(int(at), len(before))
        if not sine[new, old] <= FARTHEST:
            break
        if chosen[new] < 0 and old in free:
            chosen[new] = old
            free.discard(old)
            others = np.delete(sine[new], old)
            moved = sine[new, old]
            if moved > ROUNDING and len(others) and others.min() < AS_NEAR * moved:
                other = int(others.argmin())
                doubtful.append((old, other + (other >= old)))
    return Identities(chosen, doubtful)


def _sines(one: FloatArray, two: FloatArray) -> FloatArray:
    """The sines (k, n) of the angles between unit vectors (k, 8) and (n, 8)."""
    cosine = one @ two.T
    return np.asarray(np.linalg.norm(one[:, None] - cosine[..., None] * two, axis=-1))


def _vectors(dyads: Sequence[Dyad], frames: CanonicalFrames) -> FloatArray:
    """The manifolds of dyads, as unit vectors (k, 8) that rotations turn only."""
    out = np.zeros((len(dyads), 8))
    links = [k for k, dyad in enumerate(dyads) if isinstance(dyad, RR)]
    for k, dyad in enumerate(dyads):
        if not isinstance(dyad, RR):
            out[k] = _slider_in(frames, dyad).coefficients()
    if links:
        some = [dyad for dyad in dyads if isinstance(dyad, RR)]
        unit = frames.length
        fixed = np.array([each.fixed_pivot for each in some]) - frames.fixed_origin
        moving = np.array([each.moving_pivot for each in some]) - frames.moving_origin
        radius = np.array([each.radius for each in some])
        out[links] = RR(fixed / unit, moving / unit, radius / unit).coefficients()
    out /= INVARIANT
    return np.asarray(out / np.linalg.norm(out, axis=-1, keepdims=True))


def _slider_in(frames: CanonicalFrames, dyad: Dyad) -> Dyad:
    """A slider as canonical frames see it; a PP dyad is the same in all."""
    unit, fixed, moving = frames.length, frames.fixed_origin, frames.moving_origin
    if not isinstance(dyad, PR | RP):
        return dyad
    n = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    if isinstance(dyad, PR):
        offset = (dyad.offset - n @ fixed) / unit
        return PR(dyad.normal_angle, offset, (dyad.moving_pivot - moving) / unit)
    offset = (dyad.offset - n @ moving) / unit
    return RP((dyad.fixed_pivot - fixed) / unit, dyad.normal_angle, offset)
