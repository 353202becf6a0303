"""Pairs of dyads that may work, told by the transmission angles at the poses alone.

All pairs of some hundred dyads are a hundred thousand linkages.  A linkage that stays on one
branch has the same side of its dead point at all poses: the sine of its transmission angle keeps
its sign.  This, and the proportions of the links, rule out most pairs before any is judged.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.families.dyad_samples import DyadSamples
from burmester.families.open_task import Conditions
from burmester.fourbar.linkage_batch import DYAD_KINDS
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.requirements.links import LINK_RATIO, LONGEST_LINK, SHORTEST_LINK

RR_KIND, PR_KIND, RP_KIND = range(3)  # indices in DYAD_KINDS
NEARLY: Final = 1.6  # ratio by which links may be beyond their bounds where few pairs keep them
FOUR: Final = 4  # number of links of a 4R linkage
TINY: Final = 1e-24  # squared lengths; keeps a division from zero


class Pairs(NamedTuple):
    """Pairs (k,): the driving dyad, the other one, and how well they transmit at the poses.

    least: (k,), the least sine of the transmission angle over the poses; where its sign changes,
    minus the greatest one on the other side.  seen: how many pairs there were.
    """

    driver: NDArray[np.intp]
    follower: NDArray[np.intp]
    least: FloatArray
    seen: int


class _AtPoses(NamedTuple):
    """Dyads (k,) of one kind at poses (N,).

    at: (k,), their numbers; radius: (k,).  Vectors (N, k, 2): pin, the moving pivot; lever, the
    unit vector from the fixed pivot to it, or the line's normal; normal, of an RP's line.
    ground: (k, 2), the fixed pivot.
    """

    kind: int
    at: NDArray[np.intp]
    radius: FloatArray
    pin: FloatArray
    lever: FloatArray
    normal: FloatArray
    ground: FloatArray


def promising_pairs(
    drivers: DyadSamples,
    followers: DyadSamples,
    poses: Displacement,
    conditions: Conditions,
    *,
    kinds: Set[frozenset[type]],
    most: int,
) -> Pairs:
    """At most about `most` pairs of each two kinds, of dyads (k,) and (m,) through poses (N,).

    Those that transmit at the poses as is asked; where there are fewer than `most`, the next best
    ones as well, and those whose links are nearly within the bounds.  kinds: the pairs of kinds
    that are allowed.

    Formula `transmission-at-poses` of the theory.
    """
    found = [(np.empty(0, np.intp), np.empty(0, np.intp), np.empty(0))]
    seen = 0
    for one in _by_kind(drivers, poses):
        for other in _by_kind(followers, poses):
            if frozenset({DYAD_KINDS[one.kind], DYAD_KINDS[other.kind]}) not in kinds:
                continue
            same = drivers is followers and one.kind == other.kind
            keep = _sane(one, other, conditions, 1.0, same=same)
            if np.count_nonzero(keep) < most:
                keep = _sane(one, other, conditions, NEARLY, same=same)
            seen += keep.size
            i, j = np.nonzero(keep)
            least = _least_sine(one, other)[i, j]
            index = _chosen(least, np.sin(conditions.transmission), most)
            found.append((one.at[i[index]], other.at[j[index]], least[index]))
    driver, follower, least = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return Pairs(driver, follower, least, seen)


def _chosen(least: FloatArray, enough: float, most: int) -> NDArray[np.intp]:
    """The best half of `most` pairs (k,) and others spread over those that reach `enough`."""
    if len(least) <= most:
        return np.arange(len(least))
    reached = np.flatnonzero(least >= enough)
    if len(reached) <= most:
        return np.argpartition(-least, most)[:most]
    half = most // 2
    spread = reached[np.linspace(0, len(reached) - 1, half).astype(np.intp)]
    return np.union1d(reached[np.argpartition(-least[reached], half)[:half]], spread)


def _by_kind(dyads: DyadSamples, poses: Displacement) -> Iterator[_AtPoses]:
    """The dyads of each kind, at the poses."""
    every = poses[:, None]
    for kind in np.unique(dyads.kinds).tolist():
        index = np.flatnonzero(dyads.kinds == kind)
        z = dyads.dimensions[index]
        pin = lever = normal = np.zeros((*poses.shape, len(index), 2))
        if kind != RP_KIND:
            pin = every.act(z[:, 2:4])
            lever = _unit(pin - z[:, :2]) if kind == RR_KIND else _normals(z[:, 0]) + normal
        else:
            normal = _normals(z[:, 2] + every.angle)
        yield _AtPoses(kind, index, z[:, 4], pin, lever, normal, z[:, :2])


def _least_sine(one: _AtPoses, other: _AtPoses) -> FloatArray:
    """The least sines (k, m) of transmission over the poses; dyads (k,) drive, (m,) follow."""
    low = np.full((len(one.at), len(other.at)), np.inf)
    high = -low
    if one.kind == other.kind == RP_KIND:
        return np.ones_like(low)
    for n in range(len(one.pin)):
        if one.kind == RP_KIND:
            sine = _cross(one.normal[n], other.lever[n])
        elif other.kind == RP_KIND:
            push = other.normal[n]
            at = push[:, 0] * other.ground[:, 1] - push[:, 1] * other.ground[:, 0]
            sine = (-_cross(one.pin[n], push) - at) / _distance(one.pin[n], other.ground)
        else:
            pin, lever = other.pin[n], other.lever[n]
            at = pin[:, 0] * lever[:, 1] - pin[:, 1] * lever[:, 0]
            sine = (at - _cross(one.pin[n], lever)) / _distance(one.pin[n], pin)
        np.minimum(low, sine, out=low)
        np.maximum(high, sine, out=high)
    # On one side of the dead points low or -high is positive: the least sine.
    return np.asarray(np.maximum(low, -high))


def _sane(
    one: _AtPoses, other: _AtPoses, conditions: Conditions, slack: float, *, same: bool
) -> NDArray[np.bool_]:
    """Which different pairs (k, m) have links within the bounds times a factor `slack`."""
    shape = (len(one.at), len(other.at))
    links = []
    if one.kind == RR_KIND:
        links.append(np.broadcast_to(one.radius[:, None], shape))
    if other.kind == RR_KIND:
        links.append(np.broadcast_to(other.radius, shape))
    if PR_KIND not in (one.kind, other.kind):
        links.append(_distance(one.ground, other.ground))
    if RP_KIND not in (one.kind, other.kind):
        links.append(_distance(one.pin[0], other.pin[0]))
    least, most, asked = np.full(shape, np.inf), np.zeros(shape), conditions.asked
    for each in links:
        least, most = np.minimum(least, each), np.maximum(most, each)
    keep = (slack * least >= asked[SHORTEST_LINK]) & (most <= slack * asked[LONGEST_LINK])
    if len(links) == FOUR:
        keep &= most <= slack * asked.get(LINK_RATIO, np.inf) * least
    if same:
        np.fill_diagonal(keep, val=False)
    return np.asarray(keep)


def _normals(angle: FloatArray) -> FloatArray:
    """Unit vectors (*, 2) at angles (*,)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _unit(vectors: FloatArray) -> FloatArray:
    length = np.sqrt((vectors * vectors).sum(axis=-1, keepdims=True))
    return np.asarray(vectors / np.maximum(length, TINY))


def _cross(one: FloatArray, other: FloatArray) -> FloatArray:
    """The cross products (k, m) of vectors (k, 2) and (m, 2)."""
    return np.asarray(one @ np.stack([other[:, 1], -other[:, 0]]))


def _distance(one: FloatArray, other: FloatArray) -> FloatArray:
    """The distances (k, m) between points (k, 2) and (m, 2)."""
    square = (one * one).sum(axis=1)[:, None] + (other * other).sum(axis=1) - 2 * one @ other.T
    return np.asarray(np.sqrt(np.maximum(square, TINY)))
