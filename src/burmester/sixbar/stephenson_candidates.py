"""Stephenson's six-bars of many chains, their drivers judged at once.

The body carries G of a dyad FG through the five poses themselves, and is the last link of a 3R
chain A, C, E.  Then one dyad is left, and it is one of five poses as well: in the third class from
the ground to the link CE, in the first from the crank FG to the crank AC (Soh and McCarthy 2008
for the chain; the names of the joints are ours).
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.transmission import least_transmission_angle
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.sixbar.added_dyads import dyads_but, size_of, with_first_dyad
from burmester.sixbar.candidates import Candidates, Conditions, box_diagonal, joined, steps_along
from burmester.sixbar.three_r_chain import ThreeRChain
from burmester.sixbar.travel import along
from burmester.stephenson.chain import Chain
from burmester.stephenson.linkage import CLASSES, StephensonLinkage, dead_angles

__all__ = ["first_class_candidates", "third_class_candidates"]

THIRD: Final = CLASSES["Stephenson III six-bar"]
FIRST: Final = CLASSES["Stephenson I six-bar"]


def third_class_candidates(
    chains: ThreeRChain, poses: Displacement, side: FloatArray, conditions: Conditions
) -> Candidates:
    """All Stephenson III six-bars of chains (k,) through poses (k, 5) that A or B drives.

    The body is the link EG.  As `watt_candidates`.
    """
    bars, own = with_first_dyad(chains, poses, side), _body_dyads(poses)
    row, dyad = _pairs(bars.task, own[0])
    chain = bars.task[row]
    links, loop, last = chains[chain], bars.dyad[row], own[1][dyad]
    f, g = _ends(last, poses[chain])
    joints = np.concatenate([bars.joints[row], np.stack([f, g], axis=-1)], axis=-1)
    a, b = joints[:, 0, 0], joints[:, 0, 1]
    base = np.abs(b - a)
    linkage = StephensonLinkage(
        THIRD,
        "floating link",
        Chain(
            base=base,
            f=(f[:, 0] - a) * base / (b - a),
            first=links.first_length,
            second=loop.radius,
            arm=links.second_length,
            d=complex_of(loop.moving_pivot),
            upper=_apart(links.body_joint, last.moving_pivot),
            lower=last.radius,
        ),
        np.stack([a, b], axis=-1),
        _pair(links.body_joint, last.moving_pivot),
    )
    return _driven(linkage, joints, chain, conditions)


def first_class_candidates(
    chains: ThreeRChain, poses: Displacement, side: FloatArray, conditions: Conditions
) -> Candidates:
    """All Stephenson I six-bars of chains (k,) through poses (k, 5), as `watt_candidates`.

    The body is the link EG.
    """
    elbow = chains.elbows(poses, side)
    reached = np.flatnonzero(np.isfinite(elbow).all(axis=-1))
    own = _body_dyads(poses)
    row, dyad = _pairs(reached, own[0])
    chain = reached[row]
    links, last, c = chains[chain], own[1][dyad], elbow[chain]
    a = complex_of(links.fixed_pivot)[:, None] + 0 * c
    f, g = _ends(last, poses[chain])
    first, second = _crank(a, c), _crank(f, g)
    zero = np.zeros((len(chain), 2))
    size = size_of(poses[chain]) + links.first_length + links.second_length + last.radius
    some, joint = dyads_but(second.inverse() @ first, zero, zero, size)
    chain, links, last = chain[some], links[some], last[some]
    first, second = first[some], second[some]
    a, c, f, g = (each[some] for each in (a, c, f, g))
    k = complex_of(second.act(joint.fixed_pivot[:, None, :]))
    l_ = complex_of(first.act(joint.moving_pivot[:, None, :]))
    e = complex_of(poses[chain].act(links.body_joint[:, None, :]))
    arm = complex_of(joint.moving_pivot)
    linkage = StephensonLinkage(
        FIRST,
        "second floating link",
        Chain(
            base=np.abs(arm),
            f=links.first_length * np.abs(arm) / arm,
            first=np.abs(f[:, 0] - a[:, 0]),
            second=joint.radius,
            arm=last.radius,
            d=complex_of(joint.fixed_pivot),
            upper=_apart(links.body_joint, last.moving_pivot),
            lower=links.second_length,
        ),
        np.stack([a[:, 0], f[:, 0]], axis=-1),
        _pair(links.body_joint, last.moving_pivot),
    )
    joints = np.stack([a, c, e, f, g, k, l_], axis=-1)
    return _driven(linkage, joints, chain, conditions)


def _driven(
    linkage: StephensonLinkage,
    joints: ComplexArray,
    chain: NDArray[np.intp],
    conditions: Conditions,
) -> Candidates:
    """Those of six-bars (n,), with joints (n, 5, 7) at the poses, that work with a driver.

    Drivers at a joint of the loop of four links are looked at: what they do is known in closed
    form for all six-bars at once.
    """
    parts = []
    for number, pivot in enumerate(linkage.skeleton.drivers):
        driven = linkage.kind.in_chain(pivot)
        if driven in "EFG":
            continue
        named = linkage.in_chain(joints, driven)
        drive, (side, last) = Chain.angle(named), Chain.sides(named)
        same = (side == side[:, :1]).all(axis=-1) & (last == last[:, :1]).all(axis=-1)
        at = np.flatnonzero(same & (side[:, 0] != 0) & (last[:, 0] != 0))
        own = linkage[at].renamed(driven)
        locked = own.loop().locked(first=True)  # the loop by itself, before both
        works = along(drive[at], locked, same[at], any_order=conditions.any_order).works
        at, own = at[works], own.at(works)
        dead = dead_angles(own, side[at, 0])
        way = along(drive[at], dead, same[at], any_order=conditions.any_order)
        good = way.works & (way.turns_fully | (not conditions.crank))
        at, own, links = at[good], own.at(good), linkage[at[good]]
        there = own.at((slice(None), None)).joints(
            steps_along(way.drive[good]), side[at, :1], last[at, :1], closed=True
        )
        places = links[:, None].as_named(there, driven)
        parts.append(
            Candidates(
                chain=chain[at],
                design=at,
                linkages=links,
                joints=joints[at],
                driver=np.full(len(at), number),
                transmission=least_transmission_angle(links.skeleton, places, pivot).min(
                    axis=-1, initial=np.pi / 2
                ),
                extent=box_diagonal(places),
                designs=len(chain),
            )
        )
    return joined(parts, len(chain))


def _body_dyads(poses: Displacement) -> tuple[NDArray[np.intp], RR]:
    """The dyads from the ground to the body through poses (k, 5): of which poses, and they."""
    rows = np.concatenate([poses.translation, poses.angle[..., None]], axis=-1)
    once = bool((rows == rows[:1]).all())  # none of the five is free
    some = poses[:1] if once else poses
    none = np.full((some.shape[0], 2), np.nan)
    task, dyad = dyads_but(some, none, none, size_of(some))
    if once:
        count = poses.shape[0]
        task = np.repeat(np.arange(count), len(dyad.radius))
        dyad = dyad[np.tile(np.arange(len(dyad.radius)), count)]
    return task, dyad


def _pairs(one: NDArray[np.intp], other: NDArray[np.intp]) -> tuple[NDArray[np.intp], ...]:
    """The numbers of all pairs of rows with the same value; `other` rises."""
    first, after = np.searchsorted(other, one), np.searchsorted(other, one, side="right")
    count = after - first
    row = np.repeat(np.arange(len(one)), count)
    within = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
    return row, first[row] + within


def _ends(dyad: RR, poses: Displacement) -> tuple[ComplexArray, ComplexArray]:
    """Where the ends of dyads (n,) between ground and body are at poses (n, 5): (n, 5) each."""
    moving = complex_of(poses.act(dyad.moving_pivot[:, None, :]))
    return complex_of(dyad.fixed_pivot)[:, None] + 0 * moving, moving


def _crank(pivot: ComplexArray, end: ComplexArray) -> Displacement:
    """The places of a link with its origin at a pivot and its x axis through `end`."""
    return Displacement(np.stack([pivot.real, pivot.imag], axis=-1), np.angle(end - pivot))


def _pair(one: FloatArray, other: FloatArray) -> ComplexArray:
    return np.stack([complex_of(one), complex_of(other)], axis=-1)


def _apart(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.norm(other - one, axis=-1))
