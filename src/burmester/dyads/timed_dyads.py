"""Driving links at given angles: dyads through poses of which some are timed by the crank.

With w_j the link at pose j, from the fixed pivot A to the place of the moving pivot b, the links at
two timed poses differ by the rotation of the crank: w_j = e^(i beta_j) w_0, or w_j = r e^(i
beta_j) where the angles are directions in F.  Both are linear in A, b (and r): the standard form
of Erdman and Sandor, whose vectors are W = w_0 and Z, from b to the origin of M at the first pose.
An untimed pose is the equation of a circle.  As many equations as unknowns leave finitely many
dyads; all of them are found where at most two of the equations are circles.
"""

from __future__ import annotations

from itertools import combinations
from typing import Final

import numpy as np

from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage_batch import DIMENSIONS
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, complex_of
from burmester.tasks.crank_timing import CrankTiming

RANK: Final = 1e-11  # relative; singular values below it are zero
MET: Final = 1e-7  # spans; a dyad that misses a pose by less meets it
MOST_TRIPLES: Final = 60  # of timed poses, through which start dyads are laid


def timing_equations(
    dimensions: FloatArray, places: Displacement, timing: CrankTiming
) -> tuple[FloatArray, FloatArray]:
    """What RR dyads (k,) miss their timing by, (k, m), and the derivatives (k, m, 5).

    dimensions: (k, 5), as `LinkageBatch` has them; places: (N,), or (k, N).  Lengths; two values
    for each condition, which are affine in the dimensions.

    Formula `timing-equations` of the theory.
    """
    index, turn = timing.timed, np.exp(1j * timing.turns)
    at, bodies = complex_of(places.translation)[..., index], np.exp(1j * places.angle)[..., index]
    pivot, pin = complex_of(dimensions[:, None, :2]), complex_of(dimensions[:, None, 2:4])
    link = at + bodies * pin - pivot
    ones, swing = np.ones_like(link), np.broadcast_to(bodies, link.shape)
    if timing.absolute:
        value = link - turn * dimensions[:, None, 4]
        by = [-ones, swing]
    else:
        value = link[:, 1:] - turn[1:] * link[:, :1]
        by = [turn[1:] * ones[:, 1:] - ones[:, 1:], swing[:, 1:] - turn[1:] * swing[:, :1]]
    slope = np.zeros((*value.shape, DIMENSIONS), dtype=complex)
    for number, each in enumerate(by):
        slope[..., 2 * number], slope[..., 2 * number + 1] = each, 1j * each
    if timing.absolute:
        slope[..., 4] = -turn * ones
    both = np.concatenate([slope.real, slope.imag], axis=1)
    return np.concatenate([value.real, value.imag], axis=1), both


def timed_dyads(poses: Displacement, timing: CrankTiming) -> list[RR] | None:
    """All RR dyads through poses (N,) at the angles of the crank, where these are finitely many.

    None where equations are too few or too many, or leave more than two circles to intersect.
    """
    count, equations = poses.shape[0], poses.shape[0] + timing.conditions
    if equations != DIMENSIONS:
        return None
    middle = poses.translation.mean(axis=0)
    own = Displacement(poses.translation - middle, poses.angle)
    size = max(float(np.abs(own.translation).max()), 1e-300)
    own = Displacement(own.translation / size, own.angle)
    start, ways = _linear(own, timing)
    loose = np.setdiff1d(np.arange(count), timing.timed)
    if ways.shape[1] != len(loose) or len(loose) > 2:
        return None
    circles = [_circle(own, timing, int(k), start, ways) for k in loose]
    out = []
    for share in _roots(circles):
        z = start + ways @ share
        pins = own.act(z[2:4]) - z[:2]
        radius = float(np.linalg.norm(pins[timing.timed[0]]))
        miss = np.abs(np.linalg.norm(pins, axis=1) - radius).max()
        if radius > 0 and miss <= MET * max(1.0, radius) and (not timing.absolute or z[4] > 0):
            out.append(RR(z[:2] * size + middle, z[2:4] * size, np.array(radius * size)))
    return out


def nearest_timed(poses: Displacement, timing: CrankTiming) -> list[RR]:
    """Dyads through each three timed poses (two, where angles are absolute), some of many; starts.

    Least squares over all timed poses come first.
    """
    index, each = timing.timed, 2 if timing.absolute else 3
    sets = [index, *map(np.array, combinations(index.tolist(), each))]
    some = [sets[k] for k in np.unique(np.linspace(0, len(sets) - 1, MOST_TRIPLES).astype(int))]
    out = []
    for chosen in some:
        part = timing.at(chosen)
        assert part is not None
        z, _ = _linear(poses[chosen], part)
        pins = poses.act(z[2:4]) - z[:2]
        radius = float(np.linalg.norm(pins, axis=1).mean())
        if np.isfinite(z).all() and radius > 0:
            out.append(RR(z[:2], z[2:4], np.array(radius)))
    return out


def _linear(poses: Displacement, timing: CrankTiming) -> tuple[FloatArray, FloatArray]:
    """The shortest solution (5,) of the timing equations, and the ways (5, f) that they leave."""
    value, slope = (part[0] for part in timing_equations(np.zeros((1, DIMENSIONS)), poses, timing))
    used = DIMENSIONS if timing.absolute else DIMENSIONS - 1
    left, size, right = np.linalg.svd(slope[:, :used])
    rank = int((size > RANK * size.max(initial=1e-300)).sum())
    z, ways = np.zeros(DIMENSIONS), np.zeros((DIMENSIONS, used - rank))
    z[:used] = -right[:rank].T @ ((left.T @ value)[:rank] / size[:rank])
    ways[:used] = right[rank:].T
    return z, ways


def _circle(
    poses: Displacement, timing: CrankTiming, pose: int, start: FloatArray, ways: FloatArray
) -> tuple[FloatArray, FloatArray, float]:
    """The quadric s'Qs + 2 p's + c = 0 on which shares s (f,) of the ways meet an untimed pose."""

    def link(at: int) -> FloatArray:  # (2, 5) and a shift: of the link as a function of (A, b, r)
        turn = np.exp(1j * poses.angle[at])
        rows = np.zeros((2, DIMENSIONS + 1))
        rows[:, 0], rows[:, 1] = (-1, 0), (0, -1)
        rows[:, 2], rows[:, 3] = (turn.real, turn.imag), (-turn.imag, turn.real)
        rows[:, 5] = poses.translation[at]
        return rows

    def square(rows: FloatArray) -> FloatArray:
        whole = np.zeros((DIMENSIONS + 1, 1 + ways.shape[1]))
        whole[:DIMENSIONS, 1:], whole[:DIMENSIONS, 0], whole[5, 0] = ways, start, 1.0
        return np.asarray((rows @ whole).T @ (rows @ whole))

    radius = np.zeros((1, DIMENSIONS + 1))
    radius[0, 4] = 1.0
    form = square(link(pose)) - square(radius if timing.absolute else link(int(timing.timed[0])))
    return form[1:, 1:], form[1:, 0], float(form[0, 0])


def _roots(circles: list[tuple[FloatArray, FloatArray, float]]) -> list[FloatArray]:
    """All real common zeros of none, one (in one unknown) or two circles (in two)."""
    if not circles:
        return [np.zeros(0)]
    (q, p, c), *others = circles
    start, way = np.zeros(1), np.ones(1)
    if others:  # one combination of both is a line
        ((r, o, d),) = others
        one, two = float(np.trace(q)), float(np.trace(r))
        if abs(one) < abs(two):
            (q, p, c), (r, o, d), one, two = (r, o, d), (q, p, c), two, one
        if one == 0:
            return []
        share = two / one
        normal, shift = 2 * (o - share * p), d - share * c
        if not (square := float(normal @ normal)) > 0:
            return []
        start, way = -shift * normal / square, np.array([-normal[1], normal[0]]) / square**0.5
    a, b = float(way @ q @ way), 2 * float(way @ (q @ start + p))
    c = float(start @ q @ start + 2 * p @ start) + c
    if abs(a) <= RANK * (abs(b) + abs(c)):
        found = [-c / b] if b else []
    else:
        root = b * b - 4 * a * c
        if root < 0:
            return []
        far = -(b + np.copysign(root**0.5, b)) / 2
        found = [far / a, *([c / far] if far else [])]
    return [start + way * each for each in found]
