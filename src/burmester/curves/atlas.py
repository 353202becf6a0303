"""An atlas of coupler curves, and those of its curves that are like a path.

Crank-driven linkages are drawn at random, the same ones always.  Each curve is known by points at
equal steps of arc length.  A path's points at equal steps are laid over every stretch of every
curve by turning, stretching and shifting (Procrustes), mirrored and reversed too: with all
stretches at once by the correlation theorem.  A heuristic that finds where to start, no more.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.curves.crank_linkages import SIZE, A, C, CrankLinkages, R
from burmester.numerics.arrays import ComplexArray, FloatArray, pairs_of, take
from burmester.numerics.counted_draws import uniform_draws

SEED = 20
DRAWN = 24_000  # linkages drawn; about half of them have a crank
SAMPLES, STEPS = 64, 128  # of a curve at equal steps of arc length, and of the crank angle
SHORTEST = 0.12  # least length of a link, as a share of the longest link drawn
FARTHEST_POINT = 2.5  # of the coupler point from the middle of the coupler, in couplers
CRANK_SHARE = 0.8  # of the linkages that have the shortest link as the crank; the others, as ground
ARC_POINTS = 12  # points at equal steps by which an open path is known
STRIDES = (1, 2, 3, 4, 5)  # of the curve's samples from point to point of an open path


class Atlas(NamedTuple):
    """Linkages (k,), their curves' points (k, SAMPLES), unwrapped crank angles (k, SAMPLES + 1)."""

    linkages: CrankLinkages
    points: ComplexArray
    t: FloatArray


class Likeness(NamedTuple):
    """Linkages (k,) laid over a path, their crank angles (k, n) at its points, what is left (k,).

    left: the root mean square distance of points at equal steps, in radii of gyration.
    """

    linkages: CrankLinkages
    t: FloatArray
    left: FloatArray


@cache
def the_atlas() -> Atlas:
    """The atlas; made when first needed, in about 0.1 s."""
    u = uniform_draws(SEED, np.arange(DRAWN), 0, 8)
    lengths = SHORTEST ** u[:, :4]
    order = np.argsort(lengths, axis=1)
    shortest = np.take_along_axis(lengths, order[:, :1], axis=1)[:, 0]
    rows, place = np.arange(DRAWN), np.where(u[:, 4] < CRANK_SHARE, 1, 0)  # ground, crank, ...
    lengths[rows, order[:, 0]] = lengths[rows, place]
    lengths[rows, place] = shortest
    z = np.zeros((DRAWN, SIZE))
    z[:, 2] = lengths[:, 0]
    z[:, A : R + 1] = lengths[:, 1:]
    away = FARTHEST_POINT * u[:, 5] * np.exp(2j * np.pi * u[:, 6])
    z[:, C] = pairs_of(lengths[:, 2] * (0.5 + away))
    every = CrankLinkages(z, np.where(u[:, 7] < 0.5, 1.0, -1.0))
    linkages = every[every.turns_fully(1e-3)]
    t = np.linspace(0, 2 * np.pi, STEPS + 1)
    points = linkages.at(np.broadcast_to(t, (len(linkages), STEPS + 1))).point
    arc = np.concatenate(
        [np.zeros((len(linkages), 1)), np.abs(np.diff(points)).cumsum(axis=1)], axis=1
    )
    arc /= arc[:, -1:]
    # One interpolation of all rows, put behind each other on one axis.
    row = np.arange(len(linkages))[:, None] * 2.0
    wanted = np.linspace(0, 1, SAMPLES + 1)
    every_t = np.interp((wanted + row).ravel(), (arc + row).ravel(), np.tile(t, len(linkages)))
    angle = every_t.reshape(len(linkages), SAMPLES + 1)
    return Atlas(linkages, linkages.at(angle[:, :-1]).point, angle)


def likenesses(points: ComplexArray, closed: bool, most: int) -> Likeness:
    """The linkages of the atlas most like a path through points (n,), at most so many."""
    atlas = the_atlas()
    found: list[tuple[FloatArray, NDArray[np.intp], _Laid]] = []
    plan = [(SAMPLES, 1)] if closed else [(ARC_POINTS, stride) for stride in STRIDES]
    for number, stride in plan:
        z, arc = along_path(points, closed, number)
        spread = _spreads(atlas, number, stride, closed)
        for reverse in (False, True):
            for mirror in (False, True):
                laid = _Laid(number, stride, reverse, mirror, closed, arc)
                left, begin = _best_stretches(spread, z, laid)
                found.append((left, begin, laid))
    left = np.stack([each[0] for each in found], axis=1)
    best = np.argsort(left, axis=None, kind="stable")[:most]
    row, way = np.unravel_index(best, left.shape)
    parts = []
    for number, (_, begin, laid) in enumerate(found):
        if not len(some := row[way == number]):
            continue
        parts.append(_laid_over(atlas, points, some, begin[some], laid))
    order = np.argsort(np.concatenate([np.flatnonzero(way == k) for k in range(len(found))]))
    linkages = CrankLinkages(
        np.concatenate([each[0].dimensions for each in parts])[order],
        np.concatenate([each[0].assembly for each in parts])[order],
    )
    return Likeness(
        linkages, np.concatenate([each[1] for each in parts])[order], left.ravel()[best]
    )


class _Laid(NamedTuple):
    """How a path is laid over curves: its points at equal steps, the stride, and the ways round.

    arc: (n,), where the path's own points are, from 0 at its begin to 1 at its end.
    """

    number: int
    stride: int
    reverse: bool
    mirror: bool
    closed: bool
    arc: FloatArray


def along_path(points: ComplexArray, closed: bool, number: int) -> tuple[ComplexArray, FloatArray]:
    """Points (number,) at equal steps along a path through points (n,), and where these are (n,).

    From 0 at its begin to 1 at its end, which is its begin again where it is closed.  Between the
    points the path is a cubic with the slopes of Catmull and Rom.
    """
    ring = np.append(points, points[:1]) if closed else points
    chord = np.abs(np.diff(ring))
    at = np.concatenate([[0.0], np.cumsum(np.maximum(chord, 1e-9 * chord.max()))])
    secant = np.diff(ring) / np.diff(at)
    ends = (secant[-1:], secant[:1]) if closed else (secant[:1], secant[-1:])
    before, after = np.concatenate([ends[0], secant]), np.concatenate([secant, ends[1]])
    step = np.diff(at)
    edge = (step[-1:], step[:1]) if closed else (step[:1], step[-1:])
    left, right = np.concatenate([edge[0], step]), np.concatenate([step, edge[1]])
    slope = (right * before + left * after) / (left + right)
    fine = np.linspace(0, 1, 9)[:-1]
    h = step[:, None]
    s = fine[None, :]
    curve = (
        (1 + 2 * s) * (1 - s) ** 2 * ring[:-1, None]
        + s * (1 - s) ** 2 * h * slope[:-1, None]
        + s * s * (3 - 2 * s) * ring[1:, None]
        - s * s * (1 - s) * h * slope[1:, None]
    )
    curve = np.append(curve.ravel(), ring[-1])
    length = np.concatenate([[0.0], np.abs(np.diff(curve)).cumsum()])
    length /= length[-1]
    wanted = np.linspace(0, 1, number, endpoint=not closed)
    own = length[:: len(fine)]
    return np.interp(wanted, length, curve), own[: len(points)]


def _spreads(atlas: Atlas, number: int, stride: int, closed: bool) -> FloatArray:
    """The sums of squares (k, 1 or SAMPLES) of stretches about their middles, by their begins."""
    size = atlas.points.real**2 + atlas.points.imag**2
    if closed:
        spread = size.sum(axis=1, keepdims=True)
        spread = spread - np.abs(atlas.points.sum(axis=1, keepdims=True)) ** 2 / SAMPLES
    else:
        mask = np.zeros(SAMPLES)
        mask[np.arange(number) * stride % SAMPLES] = 1
        window = np.conj(np.fft.fft(mask))
        total = np.fft.ifft(_transforms() * window)
        squares = np.fft.irfft(np.fft.rfft(size) * window[: SAMPLES // 2 + 1], SAMPLES)
        spread = squares - (total.real**2 + total.imag**2) / number
    return np.asarray(np.maximum(spread, 1e-9 * size.max(axis=1, keepdims=True)))


def _best_stretches(
    spread: FloatArray, z: ComplexArray, laid: _Laid
) -> tuple[FloatArray, NDArray[np.intp]]:
    """What is left (k,) of the best stretch of each curve, and where (k,) it begins."""
    z = z[::-1] if laid.reverse else z
    z = np.conj(z) if laid.mirror else z
    z = z - z.mean()
    power = float((np.abs(z) ** 2).sum())
    comb = np.zeros(SAMPLES, dtype=complex)
    comb[np.arange(laid.number) * laid.stride % SAMPLES] = z
    product = np.fft.ifft(_transforms() * np.conj(np.fft.fft(comb)))
    gain = (product.real**2 + product.imag**2) / spread
    begin = gain.argmax(axis=1)
    left = np.sqrt(np.maximum(1 - gain[np.arange(len(gain)), begin] / power, 0.0))
    return left, begin


@cache
def _transforms() -> ComplexArray:
    """The Fourier transforms (k, SAMPLES) of all curves."""
    return np.fft.fft(the_atlas().points)


def _laid_over(
    atlas: Atlas,
    points: ComplexArray,
    rows: NDArray[np.intp],
    begin: NDArray[np.intp],
    laid: _Laid,
) -> tuple[CrankLinkages, FloatArray]:
    """Linkages of the atlas laid over a path, and their crank angles (k, n) at its points."""
    some = take(atlas, rows)
    steps = SAMPLES if laid.closed else (laid.number - 1) * laid.stride
    share = 1 - laid.arc if laid.reverse else laid.arc
    at = begin[:, None] + share * steps
    if laid.closed and laid.reverse:  # the path backwards begins at its last point at equal steps
        at = at - 1
    turn, within = np.divmod(at, SAMPLES)
    number = np.arange(len(rows))[:, None] * (SAMPLES + 1.0)
    t = np.interp((within + number).ravel(), np.arange(some.t.size), some.t.ravel())
    t = t.reshape(at.shape) + 2 * np.pi * turn
    linkages = some.linkages
    if laid.mirror:
        linkages, t = linkages.mirrored(), -t
    traced = linkages.at(t).point
    middle = traced.mean(axis=1)
    centred = traced - middle[:, None]
    factor = (np.conj(centred) * (points - points.mean())).sum(axis=1)
    factor = factor / (np.abs(centred) ** 2).sum(axis=1)
    moved = linkages.moved(factor, points.mean() - factor * middle)
    return moved, t + np.angle(factor)[:, None]
