"""Two dyads joined: a linkage, its links, its type, and where its coupler can be.

The coupler moves where both constraint manifolds meet.  At a given coupler angle each of
them is a circle (or a line) in the (Z1, Z2) plane, so the coupler's places are where two
circles meet: one formula for every pair of RR, PR and RP.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np

from burmester.displacement import Displacement, FloatArray
from burmester.dyad import PR, RP, RR, Dyad

__all__ = ["Linkage", "Links", "grashof"]

PARALLEL = 1e-9  # of two lines, or of the line of two circles: its direction is rounding
CHANGE_POINT = 1e-9  # relative excess of link lengths below which Grashof's sum is a tie
BLOCK = 4096  # poses looked at together by `nearest`
TINY = 1e-300  # keeps 0 / 0 away from a pivot that meets its centre
FAR = 0.5  # lengths; the longest step of that projection
STEPS, FEWER_STEPS = 100, 20  # at most, of the projection in `nearest`, for few and many poses;
LAST = 5  # a few are enough near the poses; the last of them end on the linkage

# Coupler angles tried around that of a pose, in radians: dense where the answer will be, and
# every degree and a half where there are not too many poses for that.
_AROUND = np.sort(np.concatenate([[0.0], *((-a, a) for a in np.pi * 0.5 ** np.arange(12))]))
_EVERYWHERE = np.sort(np.concatenate([_AROUND, np.linspace(-np.pi, np.pi, 241)]))
MANY = 1000  # poses
STARTS = 4  # of the projection in `nearest`, beside the pose itself

_TYPES = {
    frozenset({RR, PR}): "slider-crank",
    frozenset({RR, RP}): "inverted slider-crank",
    frozenset({PR}): "double slider",
    frozenset({RP}): "Oldham linkage",
    frozenset({PR, RP}): "Rapson slide",
}


class Links(NamedTuple):
    """The four link lengths of a 4R linkage, (*,) each, in the task's unit."""

    ground: FloatArray
    driver: FloatArray
    coupler: FloatArray
    follower: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class Linkage:
    """A four-bar: a coupler held to the ground by two dyads."""

    first: Dyad
    second: Dyad

    @property
    def links(self) -> Links | None:
        """Link lengths of a 4R linkage; None where a dyad is a slider."""
        a, b = self.first, self.second
        if not (isinstance(a, RR) and isinstance(b, RR)):
            return None
        ground = np.linalg.norm(b.fixed_pivot - a.fixed_pivot, axis=-1)
        coupler = np.linalg.norm(b.moving_pivot - a.moving_pivot, axis=-1)
        return Links(ground, a.radius, coupler, b.radius)

    @property
    def type(self) -> str:
        """The type in words: Grashof's for 4R, else the name of the slider linkage."""
        if (links := self.links) is not None:
            return grashof(links)
        pair = frozenset({type(self.first), type(self.second)})
        return _TYPES.get(pair, "translating linkage")

    def couplers(self, angle: FloatArray) -> Displacement:
        """The coupler's places at coupler angles (*,), radians: displacements (*, 2).

        nan where the linkage cannot be assembled at that angle.  The two places exchange roles
        where they meet.  Not for PP dyads, nor for a coupler that only translates.
        """
        angle = np.asarray(angle, dtype=np.float64)
        s, c = np.sin(angle / 2), np.cos(angle / 2)
        p, q = self.first.coefficients(), self.second.coefficients()
        if abs(q[0]) > abs(p[0]):
            p, q = q, p
        (bp, ep), (bq, eq) = _slice(p, s, c), _slice(q, s, c)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            if p[0] == 0:  # two sliders: two lines
                cross = bp[0] * bq[1] - bp[1] * bq[0]
                least = PARALLEL * np.hypot(*bp) * np.hypot(*bq)
                cross = np.where(np.abs(cross) < least, np.nan, cross)
                z1 = (bp[1] * eq - bq[1] * ep) / cross
                z2 = (bq[0] * ep - bp[0] * eq) / cross
                z = np.stack([[z1, z2], np.full((2, *angle.shape), np.nan)], axis=-1)
            else:
                centre = -bp / (2 * p[0])
                squared = (centre * centre).sum(axis=0) - ep / p[0]
                normal = bq - q[0] / p[0] * bp  # of the line through both common points
                size = np.hypot(*normal)
                size = np.where(size < PARALLEL * np.hypot(*bq), np.nan, size)
                normal = normal / size
                away = (normal * centre).sum(axis=0) + (eq - q[0] / p[0] * ep) / size
                half = np.sqrt(squared - away * away)
                foot, along = centre - away * normal, np.stack([-normal[1], normal[0]])
                z = np.stack([foot - half * along, foot + half * along], axis=-1)
        z = np.where(np.isfinite(z).all(axis=0), z, np.nan)
        points = np.stack(np.broadcast_arrays(z[0], z[1], s[..., None], c[..., None]), axis=-1)
        return Displacement(Displacement.from_image_point(points).translation, angle[..., None])

    def nearest(self, poses: Displacement, length: float) -> Displacement:
        """The coupler's place nearest to each pose (N,), on whichever circuit it lies.

        Near means the least |position difference|² + (length x angle difference)².  Followed by
        projection to a local minimum from five starts: the best four of the valleys that some 500
        places of the coupler show (one, of 50 near the pose, where there are more than 1000 poses),
        and the pose itself.  That no
        other minimum is nearer is not proved.  nan where the linkage reaches no place at all.
        """
        blocks = [poses[at : at + BLOCK] for at in range(0, poses.shape[0], BLOCK)]
        rows = np.concatenate([self._nearest(block, length) for block in blocks])
        return Displacement(rows[:, :2], rows[:, 2] / length)

    def _nearest(self, poses: Displacement, length: float) -> FloatArray:
        """Rows (N, 3) of x, y, length x angle; see `nearest`."""
        wanted = _rows(poses, length)
        few = poses.shape[0] <= MANY
        tries = self.couplers(poses.angle[:, None] + (_EVERYWHERE if few else _AROUND))
        start = _valleys(_rows(tries, length), wanted, STARTS if few else 1)
        reached = self._project(
            np.concatenate(
                [np.where(np.isfinite(start), start, wanted[:, None]), wanted[:, None]], 1
            ),
            wanted[:, None],
            length,
        )
        return _closest(np.concatenate([start, reached], axis=1), wanted[:, None])

    def _project(self, at: FloatArray, wanted: FloatArray, length: float) -> FloatArray:
        """The places (N, k, 3) nearest to wanted (N, 1, 3) that are reached from `at`, or nan.

        Each step goes back to both dyads' tangent planes and along their intersection towards
        the wanted pose; less far along it from then on where a step undoes the one before.
        """
        shape = at.shape
        ends = at.reshape(-1, 3).copy()
        target = np.broadcast_to(wanted, shape).reshape(-1, 3)
        run = np.arange(len(ends))
        before, share = np.zeros_like(ends), np.ones((len(ends), 1))
        steps = STEPS if len(ends) <= MANY * (1 + STARTS) else FEWER_STEPS
        for turn in range(steps):
            here = ends[run]
            (m1, m2), (s1, s2) = self._tangents(here, length)
            # Back: the least step with s1 · step = -m1 and s2 · step = -m2.
            a, b, c = _dot(s1, s1), _dot(s1, s2), _dot(s2, s2)
            size = np.maximum(a * c - b * b, 1e-20 * a * c) + TINY
            back = -(s1 * (c * m1 - b * m2) + s2 * (a * m2 - b * m1)) / size
            line = np.cross(s1, s2)
            along = line * _dot(line, target[run] - here) / size
            # A lost row stays finite.
            if turn >= steps - LAST:  # no more than back
                share = np.zeros_like(share)
            step = np.clip(share * along + back, -FAR * length, FAR * length)
            share = np.where(_dot(step, before) < 0, share / 2, share)
            ends[run] = here + step
            # An error along the curve changes the distance by its square only.
            moving = (np.abs(along) > 1e-8 * length) | (np.abs(back) > 1e-13 * length)
            still = moving.any(axis=-1)
            run, before, share = run[still], step[still], share[still]
            if not len(run):
                break
        miss, _ = self._tangents(ends, length)
        met = (np.abs(miss) < 1e-9 * length).all(axis=0)
        return np.where(met, ends, np.nan).reshape(shape)

    def _tangents(self, rows: FloatArray, length: float) -> tuple[FloatArray, FloatArray]:
        """Residuals (2, *, 1) of both dyads and their gradients (2, *, 3) at rows (*, 3)."""
        place = Displacement(rows[..., :2], rows[..., 2] / length)
        dyads = (self.first, self.second)
        miss = np.stack([dyad.residual(place) for dyad in dyads])
        slope = np.stack([dyad.gradient(place) for dyad in dyads])
        return miss[..., None], slope / np.array([1.0, 1.0, length])


def _rows(places: Displacement, length: float) -> FloatArray:
    return np.concatenate([places.translation, length * places.angle[..., None]], axis=-1)


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("...i,...i->...", a, b)[..., None])


def _valleys(places: FloatArray, wanted: FloatArray, count: int) -> FloatArray:
    """Of places (N, k, 2, 3), along k on two branches, the `count` nearest local minima: (N, *, 3).

    By distance from wanted (N, 3).
    """
    distance = np.linalg.norm(places - wanted[:, None, None], axis=-1)
    distance = np.nan_to_num(distance, nan=np.inf)
    walls = np.pad(distance, ((0, 0), (1, 1), (0, 0)), constant_values=np.inf)
    valley = (distance <= walls[:, :-2]) & (distance <= walls[:, 2:])
    depth = np.where(valley, distance, np.inf).reshape(len(wanted), -1)
    best = np.argpartition(depth, count - 1, axis=1)[:, :count]
    flat = places.reshape(len(wanted), -1, 3)
    return np.take_along_axis(flat, best[..., None], axis=1)


def _closest(places: FloatArray, wanted: FloatArray) -> FloatArray:
    """Of places (N, k, 3), some nan, the one nearest to wanted (N, 1, 3): rows (N, 3)."""
    distance = np.nan_to_num(np.linalg.norm(places - wanted, axis=-1), nan=np.inf)
    best = distance.argmin(axis=1)[:, None]
    found = np.take_along_axis(places, best[..., None], axis=1)[:, 0]
    return np.where(np.isfinite(np.take_along_axis(distance, best, axis=1)), found, np.nan)


def grashof(links: Links) -> str:
    """The type of one 4R linkage from its link lengths (Grashof's rule).

    A tie of s + l and p + q within 1e-9 of their sum is called a change point.
    """
    lengths = np.array([float(length) for length in links])
    s, p, q, longest = np.sort(lengths)
    excess = s + longest - p - q
    if abs(excess) <= CHANGE_POINT * lengths.sum():
        return "change-point"
    if excess > 0:
        return "triple-rocker"
    names = ("double-crank", "crank-rocker", "double-rocker", "rocker-crank")
    return names[int(lengths.argmin())]


def _slice(p: FloatArray, s: FloatArray, c: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The circle p1 |z|² + b · z + e = 0 of a manifold p (8,) at a half angle: b (2, *), e (*,)."""
    b = np.stack([p[2] * s + p[4] * c, p[3] * s + p[5] * c])
    return b, p[1] * s * s + p[6] * s * c + p[7] * c * c
