"""Linkages that work, looked for where the closest ones do not.

From pairs of dyads, on each circuit, with each dyad driving and on each branch, all dimensions are
refined under the conditions that the poses stay on that branch, clear of its dead points, and in
order, and under whatever else is asked.  What is found are local minima: that there is no better
linkage is not proved.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.pivot_map import fixed_pivot_map, grid
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.dyad import RR
from burmester.fourbar.foot_points import newton_step, rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import on_circuits
from burmester.geometry.displacement import Displacement
from burmester.linkages.constraints import (
    CLEAR,
    SHORTEST,
    AllConstraints,
    BranchAndOrder,
    LinkProportions,
    drive_of,
    signed_transmission_sine,
    type_excess,
)
from burmester.linkages.refinement import Refined
from burmester.linkages.target import Target
from burmester.numerics.arrays import FloatArray, complex_of, wrapped_angle
from burmester.numerics.bundles import concatenate, take
from burmester.tasks.requirements import Requirements

__all__ = ["Found", "defect_free_linkages", "links_of_pivot_map", "middle_of"]

STARTS = 96  # at most
STAGES = (24, 24), (60, 8), (120, None)  # steps, and how many of the best then go on
WRONG = 0.1  # lengths squared, that a pose on the wrong branch counts as, to choose starts by
ASTRAY = 0.1, 1.0  # the same of a sine and of a way back; half of the starts by each
UNMET = 10.0  # the same of conditions that are not met
FEW = 64  # pairs, the first ones, of which each circuit is a start
SAME = 1e-3  # lengths; nearer places are the same
AHEAD, ON = 12, 1e-9  # steps from poses onto a linkage, and what is on it
MAP, WIDE, LINKS = 17, 3.0, 80  # pivots each way, how far out, and links kept of both maps
SHORT, LONG = 0.01, 10.0  # lengths of such links


class Found(NamedTuple):
    """Linkages (k,) found under conditions, and the index (k,) of the pair each came from."""

    refined: Refined
    pair: NDArray[np.intp]


class _Starts(NamedTuple):
    """Starts (k,): pair, dimensions, rows (k, N, 3) of places, who drives, the branch's sign.

    middle: (k,), the drive amid its dead points, nan where there are none or it slides.
    """

    pair: NDArray[np.intp]
    stack: LinkageBatch
    rows: FloatArray
    driver: NDArray[np.intp]
    sign: FloatArray
    middle: FloatArray


def defect_free_linkages(stack: LinkageBatch, aim: Target) -> Found | None:
    """The best linkages under all conditions that pairs (k,) of dyads lead to.

    Some steps for all starts, more for the best of them.  None where there is none.
    """
    starts = _likely(stack, aim)
    if not len(starts.pair):
        return None
    for steps, best in STAGES:
        found = aim.refine(
            starts.stack,
            starts.rows,
            conditions=_conditions(starts, aim),
            worst=aim.worst and best is None,
            held_steps=steps,
        )
        if best is None:
            break
        order = np.argsort(np.where(found.met, 0.0, UNMET) + np.nan_to_num(found.cost, nan=np.inf))
        order = _apart(found.rows, order[np.isfinite(found.cost[order])], best)
        if not len(order):  # all were lost
            return None
        starts = take(starts, order)._replace(stack=found.stack[order], rows=found.rows[order])
    return Found(found, starts.pair)


def links_of_pivot_map(poses: Displacement, weights: FloatArray | None = None) -> list[RR]:
    """More links to start from: those that come nearest on maps of fixed and of moving pivots.

    Poses in the frames of `accuracy.error_frames`.
    """
    found = []
    for inverse in (False, True):
        seen = poses.inverse() if inverse else poses
        frames, _ = CanonicalFrames.of(seen, weights)
        reach = WIDE * float(frames.length)
        at = grid(frames.fixed_origin - reach, frames.fixed_origin + reach, MAP, MAP)
        map_ = fixed_pivot_map(seen, at, weights)
        error = np.nan_to_num(map_.rms_error, nan=np.inf).ravel()
        fixed, moving = (
            getattr(map_.dyads, name).reshape(-1, 2) for name in ("fixed_pivot", "moving_pivot")
        )
        radius = map_.dyads.radius.ravel()
        sound = np.isfinite(error) & (radius > SHORT) & (radius < LONG)
        sound &= np.abs(moving).max(axis=-1) < LONG
        ends = (moving, fixed) if inverse else (fixed, moving)
        found += [(error[k], RR(ends[0][k], ends[1][k], radius[k])) for k in np.flatnonzero(sound)]
    found.sort(key=lambda each: each[0])
    return [link for _, link in found[:LINKS]]


def _likely(stack: LinkageBatch, aim: Target) -> _Starts:
    """Of pairs (k,) of dyads the likeliest starts.

    The first few pairs also from where they come nearest to the poses, on each of their circuits.
    """
    starts, score = _at_poses(stack, aim)
    there = _starts(stack[:FEW], aim)
    if len(there.pair):
        sine = signed_transmission_sine(there.stack, there.rows, aim.length, there.driver)
        wrong = (there.sign[:, None] * sine < 0).sum(axis=1)
        score = np.concatenate([score, aim.cost(there.rows) + WRONG * wrong])
        starts = concatenate([starts, there])
    return take(starts, np.argsort(score, kind="stable")[:STARTS])


def _at_poses(stack: LinkageBatch, aim: Target) -> tuple[_Starts, FloatArray]:
    """Starts from pairs (k,) as near to the poses as can be, and how unlikely they are, (k,).

    Judged at the poses themselves, as if the pairs met them: by how far they miss them, on which
    branch they are there, and in which order.
    """
    count, number = len(stack), aim.poses.shape[0]
    wanted = rows_of(aim.poses, aim.length)
    rows = np.broadcast_to(wanted, (count, number, 3))
    share = np.ones(number) if aim.weights is None else aim.weights / aim.weights.mean()
    d, turn = complex_of(wanted), np.exp(1j * aim.poses.angle)
    miss = (stack.surfaces().at(d[None, None], turn[None, None])[0] ** 2 @ share).sum(axis=1)
    found = []
    for side in _sides(aim.requirements):
        lead = np.full(count, side)
        sine = signed_transmission_sine(stack, rows, aim.length, lead)
        drive, turns = drive_of(stack, rows, aim.length, lead)
        step = np.diff(drive, axis=1)
        step = np.where(turns[:, None], wrapped_angle(step), step)
        back = np.min([np.maximum(way * step, 0.0).sum(axis=1) for way in (1, -1)], axis=0)
        round_ = np.min([(way * step % (2 * np.pi)).sum(axis=1) for way in (1, -1)], axis=0)
        back = np.where(turns, np.minimum(back, np.maximum(round_ - 2 * np.pi, 0.0)), back)
        for sign in (1.0, -1.0):
            wrong = np.maximum(np.sin(CLEAR) - sign * sine, 0.0).sum(axis=1)
            wrong += 0.0 if aim.requirements.any_order else back
            found.append(np.stack([np.arange(count), lead, np.full(count, sign), wrong]))
    pair, lead, sign, wrong = np.concatenate(found, axis=1)
    pair = pair.astype(np.intp)
    with np.errstate(invalid="ignore"):
        scores = miss[pair] + np.array(ASTRAY)[:, None] * wrong
    best = np.argsort(np.nan_to_num(scores, nan=np.inf), axis=1, kind="stable")
    best = np.unique(best[:, : STARTS // len(ASTRAY)])
    pair, driver = pair[best], lead[best].astype(np.intp)
    rows, sound = _projected(stack[pair], rows[pair], aim.length)
    pair, driver, best, rows = pair[sound], driver[sound], best[sound], rows[sound]
    middle, places = np.full(len(pair), np.nan), aim.places_of(rows[:, 0])
    for side in (0, 1):
        some = driver == side
        if some.any():
            middle[some] = middle_of(stack[pair[some]], places[some], side)
    starts = _Starts(pair, stack[pair], rows, driver, sign[best], middle)
    return starts, scores[0, best]


def _projected(
    stack: LinkageBatch, rows: FloatArray, length: float
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Places of linkages (k,) straight ahead of rows (k, N, 3), and where there are any, (k,)."""
    surfaces = stack.surfaces()
    with np.errstate(all="ignore"):
        for _ in range(AHEAD):
            rows = rows + newton_step(surfaces, rows, rows, length)[0]
        places = Displacement(rows[..., :2], rows[..., 2] / length)
        on = np.abs(stack.bearing(places).miss) < ON
        return rows, np.asarray(on.all(axis=(1, 2)))


def _apart(rows: FloatArray, order: NDArray[np.intp], most: int) -> NDArray[np.intp]:
    """Of places (k, N, 3), in an order (n,), the first that are not the same as others before."""
    kept: list[int] = []
    for k in order.tolist():
        if all(np.abs(rows[k] - rows[other]).max() > SAME for other in kept):
            kept.append(k)
        if len(kept) == most:
            break
    return np.array(kept, dtype=np.intp)


def _sides(asked: Requirements) -> tuple[int, ...]:
    """The sides that may drive."""
    return {"first": (0,), "second": (1,)}.get(asked.driver, (0, 1))


def _starts(stack: LinkageBatch, aim: Target) -> _Starts:
    """Each pair on each circuit, with each driver, on each branch on which a pose is."""
    places = on_circuits(stack, aim.poses, aim.length)
    rows = rows_of(places, aim.length)
    found = []
    for side in _sides(aim.requirements):
        for circuit in (0, 1):
            some = np.flatnonzero(np.isfinite(rows[:, circuit]).all(axis=(1, 2)))
            leads = np.full(len(some), side)
            sine = signed_transmission_sine(stack[some], rows[some, circuit], aim.length, leads)
            middle = middle_of(stack[some], places[some, circuit, 0], side)
            for sign in (1.0, -1.0):
                on = (sign * sine > 0).any(axis=1)
                whole = np.empty((5, int(on.sum())))
                whole[:] = np.array([[0.0], [circuit], [side], [sign], [0.0]])
                whole[0], whole[4] = some[on], middle[on]
                found.append(whole)
    table = np.concatenate(found, axis=1)
    pair, on_circuit, driver = table[:3].astype(np.intp)
    return _Starts(pair, stack[pair], rows[pair, on_circuit], driver, table[3], table[4])


def middle_of(stack: LinkageBatch, places: Displacement, side: int) -> FloatArray:
    """The drive (k,) amid the dead points of the circuits on which places (k,) are.

    nan where there are none, and for drives that slide.
    """
    out = np.full(len(stack), np.nan)
    for index, linkage in (stack.exchanged() if side else stack).alike():
        circuits = Circuits.of(linkage, as_given=True)
        own = circuit_of(linkage, places[index], as_given=True).circuit
        if not circuits.loop.turns:
            continue
        middle = np.where(circuits.branches == 2, circuits.input_range.mean(axis=-1), np.nan)
        out[index] = np.where(own < 0, np.nan, middle[np.arange(len(index)), np.maximum(own, 0)])
    return out


def _conditions(starts: _Starts, aim: Target) -> AllConstraints:
    """All that the linkages are to keep to."""
    asked = aim.requirements
    _, stack, rows, driver, sign, middle = starts
    journey = BranchAndOrder.of(stack, rows, aim.length, driver, sign, middle, asked)
    types = np.array([_type_to_be(stack, k, int(side), asked) for k, side in enumerate(driver)])
    proportions = LinkProportions(aim.length, aim.frames, asked, driver, types)
    return AllConstraints((journey, proportions, *aim.kept))


def _type_to_be(stack: LinkageBatch, index: int, driver: int, asked: Requirements) -> str:
    """Of the 4R types allowed the one nearest to a linkage, "" where it is one of them."""
    if (stack.kinds[index] != 0).any():
        return ""
    four_bars = {*SHORTEST, "triple-rocker"}
    allowed = four_bars if asked.allowed_types is None else four_bars & asked.allowed_types
    if asked.driver == "crank":
        allowed = allowed & {"crank-rocker", "double-crank"}
    elif asked.types is None:
        return ""
    names = sorted(allowed)
    excess = type_excess(stack[[index] * len(names)], np.full(len(names), driver), names)
    return names[int(excess.max(axis=1).argmin())] if names else ""
