"""Stephenson's six-bars of many chains, their drivers judged at once.

The body carries G of a dyad FG through the five poses themselves, and is the last link of a 3R
chain A, C, E.  Then one dyad is left, and it is one of five poses as well: in the third class from
the ground to the link CE, in the first from the crank FG to the crank AC (Soh and McCarthy 2008
for the chain; the names of the joints are ours).

Or the body is the coupler of a four-bar through the poses, and the chain is a dyad F, G, E that
drives it.  Such a four-bar may lock at a dead point of its own cranks: F passes it.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.circles import meeting
from burmester.mechanisms.transmission import least_transmission_angle
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of, concatenate, take
from burmester.sixbar.added_dyads import ThreeRChain, dyads_but, size_of, with_first_dyad
from burmester.sixbar.candidates import Candidates, Conditions, box_diagonal, steps_along
from burmester.sixbar.travel import along
from burmester.stephenson.chain import Chain
from burmester.stephenson.linkage import CLASSES, StephensonLinkage, dead_angles

THIRD: Final = CLASSES["Stephenson III six-bar"].skeleton
FIRST: Final = CLASSES["Stephenson I six-bar"].skeleton
PLACES: Final = 65  # of a four-bar, at which a dyad is looked at that drives it


def third_class_candidates(
    chains: ThreeRChain, poses: Displacement, side: FloatArray, conditions: Conditions
) -> Candidates:
    """All Stephenson III six-bars of chains (k,) through poses (k, 5) that A or B drives.

    The body is the link EG.  As `watt_candidates`.
    """
    bars, (own, number) = with_first_dyad(chains, poses, side), _distinct(poses)
    of, body_dyads = _dyads_of(own)
    row, dyad = _pairs(number[bars.task], of)
    chain = bars.task[row]
    links, loop, last = chains[chain], bars.dyad[row], body_dyads[dyad]
    f, g = _ends(last, poses[chain])
    joints = np.concatenate([bars.joints[row], np.stack([f, g], axis=-1)], axis=-1)
    a, b = joints[:, 0, 0], joints[:, 0, 1]
    base = np.abs(b - a)
    linkage = StephensonLinkage(
        THIRD.name,
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
    own, number = _distinct(poses)
    of, body_dyads = _dyads_of(own)
    row, dyad = _pairs(number[reached], of)
    chain = reached[row]
    links, last, c = chains[chain], body_dyads[dyad], elbow[chain]
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
        FIRST.name,
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


def driven_four_bar_candidates(
    chains: ThreeRChain, poses: Displacement, side: FloatArray, conditions: Conditions
) -> Candidates:
    """All four-bars through poses (k, 5) that chains (k,), as dyads F, G, E, drive at F.

    The body is the coupler.  Whether F turns one way is seen at places along the range, so that a
    short turn back between two of them is missed.
    """
    own, number = _distinct(poses)
    of, first, second, circuits, ends = _four_bars(own, conditions)
    chain, bar = _pairs(number, of)
    steps = ends[:, :1] + np.diff(ends) * np.linspace(0, 1, PLACES)
    body = circuits.couplers(steps)
    one, other, links = first[bar], second[bar], chains[chain]
    f = complex_of(links.fixed_pivot)
    linkage = StephensonLinkage(
        THIRD.name,
        "coupler",
        _chain_of(one, other, links),
        _pair(one.fixed_pivot, other.fixed_pivot),
        _pair(one.moving_pivot, other.moving_pivot),
    )

    def joints(places: Displacement, index: NDArray[np.intp]) -> ComplexArray:
        """The joints (n, p, 7) of some where their bodies are at places (n, p)."""
        points = one.moving_pivot, other.moving_pivot, links.body_joint
        c, d, e = (complex_of(places.act(each[index, None])) for each in points)
        start = f[index, None] + 0 * e
        lengths = links.first_length[index, None], links.second_length[index, None]
        g = meeting(start, lengths[0], e, lengths[1], side[chain[index], None])
        pivots = (complex_of(each.fixed_pivot)[index, None] + 0 * e for each in (one, other))
        return np.stack([*pivots, c, d, e, start, g], axis=-1)

    every = np.arange(len(chain))
    there = joints(body[bar], every)
    drive = np.unwrap(np.angle(there[..., 6] - there[..., 5]), axis=-1)
    turn = np.diff(drive, axis=-1)
    good = np.flatnonzero((turn > 0).all(axis=-1) | (turn < 0).all(axis=-1))  # nan is neither
    there = there[good]
    return Candidates(
        chain=chain[good],
        design=good,
        linkages=linkage[good],
        joints=joints(poses[chain[good]], good),
        driver=np.full(len(good), THIRD.drivers.index("F")),
        transmission=least_transmission_angle(THIRD, there, "F").min(axis=-1, initial=np.pi / 2),
        extent=box_diagonal(there),
        designs=len(chain),
    )


def _four_bars(
    poses: Displacement, conditions: Conditions
) -> tuple[NDArray[np.intp], RR, RR, Circuits, FloatArray]:
    """The four-bars (m,) that meet poses (k, 5) on one circuit and in order.

    The number of their poses, both dyads, the circuit, and the range (m, 2) of its parameter from
    the first pose to the last; all round where the driver must turn fully.
    """
    task, dyad = _dyads_of(poses)
    one, other = _pairs(task, task)
    each_pair_once = one < other
    one, other = one[each_pair_once], other[each_pair_once]
    task, first, second = task[one], dyad[one], dyad[other]
    circuits = Circuits.of(Linkage(first, second))
    where = circuits.locate(poses[task])
    same = (where.circuit == where.circuit[:, :1]).all(axis=-1) & (where.circuit[:, 0] >= 0)
    no_end = np.full((len(task), 1), np.nan)
    way = along(where.parameter, no_end, same, any_order=conditions.any_order)
    at = np.flatnonzero(way.works)
    low, high = way.drive[at].min(axis=-1), way.drive[at].max(axis=-1)
    if conditions.crank:
        high = low + 2 * np.pi
    ends = np.stack([low, high], axis=-1)
    return task[at], first[at], second[at], circuits[at, where.circuit[at, 0]], ends


def _chain_of(one: RR, other: RR, links: ThreeRChain) -> Chain:
    """The dimensions of four-bars (n,) whose couplers carry E of a dyad each."""
    a, b = complex_of(one.fixed_pivot), complex_of(other.fixed_pivot)
    c, d = complex_of(one.moving_pivot), complex_of(other.moving_pivot)
    f, e = complex_of(links.fixed_pivot), complex_of(links.body_joint)
    return Chain(
        base=np.abs(b - a),
        f=(f - a) * np.abs(b - a) / (b - a),
        first=one.radius,
        second=other.radius,
        arm=np.abs(e - c),
        d=(d - c) * np.abs(e - c) / (e - c),
        upper=links.second_length,
        lower=links.first_length,
    )


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
        at, own = at[works], take(own, works)
        dead = dead_angles(own, side[at, 0])
        way = along(drive[at], dead, same[at], any_order=conditions.any_order)
        good = way.works & (way.turns_fully | (not conditions.crank))
        at, own, links = at[good], take(own, good), linkage[at[good]]
        there = take(own, (slice(None), None)).joints(
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
    return concatenate(parts)


def _distinct(poses: Displacement) -> tuple[Displacement, NDArray[np.intp]]:
    """The distinct sets among poses (k, 5), and the number of each set among them: (k,).

    One set where none of the five poses is free, else all of them.
    """
    count = poses.shape[0]
    rows = np.concatenate([poses.translation, poses.angle[..., None]], axis=-1)
    if (rows == rows[:1]).all():
        return poses[:1], np.zeros(count, dtype=np.intp)
    return poses, np.arange(count)


def _dyads_of(poses: Displacement) -> tuple[NDArray[np.intp], RR]:
    """The dyads (n,) through poses (k, 5): of which poses, and they."""
    none = np.full((poses.shape[0], 2), np.nan)
    return dyads_but(poses, none, none, size_of(poses))


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
