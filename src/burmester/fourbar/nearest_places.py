"""How near an assembled linkage comes to the poses: the error that a user will see.

For each pose the nearest place of the coupler is looked for on each circuit of the linkage: near
means the least |position difference|² + (length x angle difference)².
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits, circuit_of, locate
from burmester.fourbar.linkage_batch import ConstraintForms, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, complex_of, wrapped_angle
from burmester.numerics.bundles import take

__all__ = [
    "Normal",
    "nearest",
    "newton_step",
    "normal",
    "on_circuits",
    "on_own_circuits",
    "rows_of",
    "settled",
    "wrapped",
]

SAMPLES, FEWER = 128, 48  # places looked at on a circuit, for up to MANY poses and for more
SPLITS, HALVED = 4, 16  # times that more are put between, and how many of the widest gaps
MANY, BLOCK = 1000, 256  # poses; those looked at together
VALLEYS, FEW = 3, 1  # of these places, the local minima followed, for few poses and many
REACH = 2.0  # of the samples on an endless circuit: half of them lie within it
STEPS, QUICK = 30, 12  # at most, of the way to the nearest place; where it can be closed in on
WIDE = 0.2  # of a gap between samples, in lengths, that wants more of them
FAR = 0.3  # the longest of them
SETTLED = 1e-12  # a step after which the next is rounding
ROUNDS, LOOKS = 4, 17  # where it does not do: times looked closer, and places each time
TWICE = 2.0  # the way to the next sample: no place beside a sample is farther from it
EDGE = 1e-6  # of an endless circuit, left out
ON, SAME = 1e-10, 1e-9  # a place that far from a linkage is on it; as near as another
MEETING = 1e-9  # a circuit's margin at which it meets the other
FLAT = 0.2  # the least curvature that a step along the circuit counts with
PARALLEL = 1e-20  # squared sine between two forces that are taken for parallel


class Normal(NamedTuple):
    """What both dyads' equations do in the space of (x, y, length x angle), at places (*,).

    miss: (*, 2), force: (*, 2, 3); gram: (*, 3), the products 11, 12, 22 of the forces, and
    det: (*,), their determinant, kept from zero.
    """

    miss: FloatArray
    force: FloatArray
    gram: FloatArray
    det: FloatArray

    def solve(self, right: FloatArray) -> FloatArray:
        """The forces' shares (*, 2) whose products with both forces are right (*, 2)."""
        a, b, c = np.moveaxis(self.gram, -1, 0)
        first, second = right[..., 0], right[..., 1]
        shares = np.stack([c * first - b * second, a * second - b * first], axis=-1)
        return np.asarray(shares / self.det[..., None])

    @property
    def along(self) -> FloatArray:
        """The unit direction (*, 3) in which the coupler can move."""
        cross = np.cross(self.force[..., 0, :], self.force[..., 1, :])
        return np.asarray(cross / np.sqrt(self.det)[..., None])


def normal(miss: FloatArray, force: FloatArray, length: float) -> Normal:
    """The same from the equations (k, 2, *) and forces (k, 2, *, 3) of `LinkageBatch.bearing`."""
    force = np.moveaxis(force, 1, -2) / np.array([1.0, 1.0, length])
    one, two = force[..., 0, :], force[..., 1, :]
    a, b, c = (np.einsum("...i,...i->...", *pair) for pair in ((one, one), (one, two), (two, two)))
    det = np.maximum(a * c - b * b, PARALLEL * a * c) + np.finfo(float).tiny
    return Normal(np.moveaxis(miss, 1, -1), force, np.stack([a, b, c], axis=-1), det)


def rows_of(places: Displacement, length: float) -> FloatArray:
    """Places (*,) as rows (*, 3) of x, y, length x angle."""
    return np.concatenate([places.translation, length * places.angle[..., None]], axis=-1)


def wrapped(gap: FloatArray, length: float) -> FloatArray:
    """Differences (*, 3) of such rows, their angles within half a turn."""
    gap = gap.copy()
    gap[..., 2] = length * wrapped_angle(gap[..., 2] / length)
    return gap


def on_circuits(stack: LinkageBatch, poses: Displacement, length: float) -> Displacement:
    """The nearest places (k, 2, N) to poses (N,) on both circuits of linkages (k,).

    In frames where lengths are about 1 (`error_frames`).  nan where there is no such circuit.
    Followed by Newton's method from the nearest of some hundred places of the circuit; that no
    other minimum is nearer is not proved.  Angles come within half a turn of the poses'.
    """
    count, number = len(stack), poses.shape[0]
    out = np.full((count, 2, number, 3), np.nan)
    wanted = rows_of(poses, length)
    searches = [
        _Search(index, stack[index], Circuits.of(linkage, as_given=True), length, number <= MANY)
        for index, linkage in stack.alike()
    ]
    for at in range(0, number, BLOCK):
        block = wanted[at : at + BLOCK]
        starts = [each.starts(block) for each in searches]
        rows = np.concatenate([each.index[each.row] for each in searches])
        start = np.concatenate([start for start, _ in starts])
        target = np.broadcast_to(block[:, None], start.shape)
        ends = _led(stack[rows], start, target, length)  # of all kinds at once
        done = 0
        for each, (start, sample) in zip(searches, starts, strict=True):
            own = ends[done : done + len(start)]
            out[each.index, :, at : at + BLOCK] = each.nearest(start, sample, own, block)
            done += len(start)
    return Displacement(out[..., :2], out[..., 2] / length)


def on_own_circuits(
    stack: LinkageBatch, rows: FloatArray, poses: Displacement, length: float
) -> FloatArray:
    """The nearest places (k, N, 3) to poses (N,), on the circuits where places rows (k, N, 3) are.

    Of linkages whose places are on both circuits, the nearest ones on either.  What a search that
    went down a valley left behind: another valley of the same circuit may be nearer.  Places that
    are on no circuit, and those on the linkage that are nearer than what is found, stay.
    """
    both = rows_of(on_circuits(stack, poses, length), length)
    wanted, found = rows_of(poses, length), rows.copy()
    every = np.arange(poses.shape[0])
    for index, linkage in stack.alike():
        places = Displacement(rows[index, ..., :2], rows[index, ..., 2] / length)
        circuit = circuit_of(linkage, places, as_given=True).circuit
        mixed = (circuit != circuit[:, :1]).any(axis=1)
        nearer = np.nan_to_num(_away(both[index], wanted), nan=np.inf).argmin(axis=1)
        side = np.where(mixed[:, None], nearer, np.maximum(circuit, 0))
        own = both[index[:, None], side, every]
        found[index] = np.where((circuit >= 0)[..., None], own, rows[index])
    places = Displacement(rows[..., :2], rows[..., 2] / length)
    off = np.abs(stack.bearing(places).miss).max(axis=1) > ON
    better = off | (_away(found, wanted) <= _away(rows, wanted) * (1 + SAME))
    better &= np.isfinite(found).all(axis=-1)
    return np.where(better[..., None], found, rows)


def nearest(places: Displacement, poses: Displacement, length: float) -> Displacement:
    """The nearer (k, N) of the places (k, 2, N) on two circuits; nan where there is none."""
    away = ((rows_of(places, length) - rows_of(poses, length)) ** 2).sum(axis=-1)
    other = np.nan_to_num(away, nan=np.inf).argmin(axis=1)
    row, pose = np.indices(other.shape)
    return places[row, other, pose]


class _Search:
    """Circuits (k, 2) of linkages (k,) of the same kinds, on which places are looked for.

    index: (k,), their numbers among all.
    """

    def __init__(
        self,
        index: NDArray[np.intp],
        stack: LinkageBatch,
        circuits: Circuits,
        length: float,
        few: bool,
    ) -> None:
        self.index, self.stack, self.circuits, self.length = index, stack, circuits, length
        samples, self.valleys = (SAMPLES, VALLEYS) if few else (FEWER, FEW)
        self.row, self.side = np.nonzero(circuits.exists)
        own = circuits[self.row, self.side]
        self.share = np.tile((np.arange(samples) + 0.5) / samples, (len(self.row), 1))
        self.sampled = self._at(own, self.share)
        for _ in range(SPLITS if len(self.row) else 0):
            if not self._split(own):
                break
        after = self._after(self.sampled)
        self.hop = np.maximum(after, np.roll(after, 1, axis=-1))
        gap = np.roll(self.share, -1, axis=-1) - self.share
        gap[:, -1:] += 1
        self.gap = np.maximum(gap, np.roll(gap, 1, axis=-1))

    def _after(self, sampled: FloatArray) -> FloatArray:
        """How far (n, s) the next of places (n, s, 3) is; behind the last one comes the first."""
        hop = wrapped(np.roll(sampled, -1, axis=1) - sampled, self.length)
        return np.nan_to_num(np.sqrt(_away(hop, 0.0)), nan=np.inf)

    def _split(self, own: Circuits) -> bool:
        """Put more samples where the widest gaps are: near change points a place runs fast.

        Whether there were wide ones.
        """
        hop = self._after(self.sampled)[:, :-1]
        far = np.sqrt(_away(self.sampled[:, :-1], 0.0))
        wide = np.nan_to_num(hop / (1 + far), nan=0.0, posinf=0.0)
        if not (wide > WIDE).any():
            return False
        at = np.argpartition(-wide, HALVED, axis=-1)[:, :HALVED]
        middle = (self.share[:, :-1] + self.share[:, 1:]) / 2
        share = np.take_along_axis(middle, at, axis=-1)
        places = np.concatenate([self.sampled, self._at(own, share)], axis=1)
        share = np.concatenate([self.share, share], axis=1)
        order = np.argsort(share, axis=-1)
        self.share = np.take_along_axis(share, order, axis=-1)
        self.sampled = np.take_along_axis(places, order[..., None], axis=1)
        return True

    def starts(self, wanted: FloatArray) -> tuple[FloatArray, NDArray[np.intp]]:
        """Where to start from to wanted (N, 3), places (n, N, *, 3), and their numbers."""
        return _valleys(self.sampled, wanted, self.length, self.valleys)

    def nearest(
        self, start: FloatArray, sample: NDArray[np.intp], ends: FloatArray, wanted: FloatArray
    ) -> FloatArray:
        """The places (k, 2, N, 3) nearest to wanted (N, 3), from what Newton's method led to."""
        out = np.full((len(self.stack), 2, len(wanted), 3), np.nan)
        if not len(self.row):
            return out
        target = np.broadcast_to(wanted[:, None], start.shape)
        # Newton's method may leap to the other circuit, or past the valley.
        astray = ~(_away(ends, target) <= _away(start, target) + SETTLED)
        astray |= self._strayed(self.row, self.side, ends)
        ends[astray] = np.nan
        sound = np.where(astray, np.inf, np.sqrt(_away(ends, target)))
        # Beside a sample no place is nearer than this.
        hop = self.hop[np.arange(len(sample))[:, None, None], sample]
        nearest = np.sqrt(_away(start, target)) - TWICE * hop
        astray &= nearest <= sound.min(axis=-1, keepdims=True)
        if astray.any():
            which = np.nonzero(astray)
            ends[which] = self._closed_in(which[0], sample[which], target[which])
        best = np.nan_to_num(_away(ends, target), nan=np.inf).argmin(axis=-1)[..., None, None]
        out[self.row, self.side] = np.take_along_axis(ends, best, axis=2)[:, :, 0]
        return out

    def _at(self, circuits: Circuits, share: FloatArray) -> FloatArray:
        """Places (*, s, 3) where shares (s,) or (*, s) of circuits (*,) are passed."""
        closed = circuits.closed[..., None]
        if circuits.loop.turns:
            at = np.where(closed, 2 * np.pi * (share % 1), np.pi * np.clip(share, 0, 1))
        else:
            inside = np.clip(share, EDGE, 1 - EDGE)
            at = np.where(closed, 2 * np.pi * (share % 1), REACH * np.tan(np.pi * (inside - 0.5)))
        return rows_of(circuits.couplers(at), self.length)

    def _strayed(
        self, row: NDArray[np.intp], side: NDArray[np.intp], ends: FloatArray
    ) -> NDArray[np.bool_]:
        """Whether places (n, *, 3) are on the other circuit than (n,) of linkages (n,)."""
        out = np.zeros(ends.shape[:-1], dtype=bool)
        two = np.flatnonzero(np.asarray(self.circuits.exists.all(axis=-1))[row])
        if len(two):
            places = Displacement(ends[two, ..., :2], ends[two, ..., 2] / self.length)
            found = locate(self.circuits[row[two]], places)
            own = side[two].reshape(-1, *[1] * (ends.ndim - 2))
            # Where circuits meet, a place is on both.
            out[two] = np.not_equal(found.circuit, own) & np.greater(found.circuit_margin, MEETING)
        return out

    def _closed_in(
        self,
        which: NDArray[np.intp],
        sample: NDArray[np.intp],
        wanted: FloatArray,
    ) -> FloatArray:
        """The places (n, 3) nearest to wanted (n, 3) beside samples (n,), kept to the circuit."""
        circuits, every = self.circuits[self.row[which], self.side[which]], np.arange(len(which))
        share, width = self.share[which, sample], self.gap[which, sample]
        for _ in range(ROUNDS):
            tries = share[:, None] + width[:, None] * np.linspace(-1, 1, LOOKS)
            gap = wrapped(self._at(circuits, tries) - wanted[:, None], self.length)
            best = np.nan_to_num((gap * gap).sum(axis=-1), nan=np.inf).argmin(axis=-1)
            share, near = tries[every, best], wanted + gap[every, best]
            width = width * 2.0 / (LOOKS - 1)
        row, side = self.row[which], self.side[which]
        ends = _led(self.stack[row], near[:, None], wanted[:, None], self.length)[:, 0]
        worse = np.nan_to_num(_away(ends, wanted), nan=np.inf) > _away(near, wanted) + SETTLED
        worse |= self._strayed(row, side, ends)
        return np.where(worse[..., None], near, ends)


def _led(stack: LinkageBatch, start: FloatArray, target: FloatArray, length: float) -> FloatArray:
    """Places (n, *, 3) of linkages (n,) that Newton's method leads to, in a few steps."""
    flat = (len(stack), math.prod(start.shape[1:-1]), 3)
    ends = settled(stack, start.reshape(flat), target.reshape(flat), length, steps=QUICK)
    return ends.reshape(start.shape)


def _away(rows: FloatArray, wanted: FloatArray | float) -> FloatArray:
    """The squared distances (*,) of rows (*, 3)."""
    return np.asarray(((rows - wanted) ** 2).sum(axis=-1))


def _valleys(
    sampled: FloatArray, wanted: FloatArray, length: float, count: int
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Of places (k, s, 3) along circuits the nearest local minima to wanted (N, 3): (k, N, *, 3).

    With angles within half a turn of the wanted ones; and their numbers (k, N, *).
    """
    gap = wrapped(sampled[:, None] - wanted[:, None], length)
    away = np.nan_to_num((gap * gap).sum(axis=-1), nan=np.inf)
    valley = (away <= np.roll(away, 1, axis=-1)) & (away <= np.roll(away, -1, axis=-1))
    valley[..., [0, -1]] = True  # an open circuit ends there
    depth = np.where(valley, away, np.inf)
    best = np.argpartition(depth, count - 1, axis=-1)[..., :count]
    start = wanted[:, None] + np.take_along_axis(gap, best[..., None], axis=2)
    dead = np.isinf(np.take_along_axis(depth, best, axis=-1))  # no valley, but what was left
    return np.where(dead[..., None], np.nan, start), best


def settled(
    stack: LinkageBatch, start: FloatArray, wanted: FloatArray, length: float, steps: int = STEPS
) -> FloatArray:
    """The places (k, n, 3) of linkages (k,) nearest to wanted (n, 3) that starts (k, n, 3) lead to.

    nan where Newton's method (`newton_step`) does not come to rest on the linkage.
    """
    shape = start.shape
    which = np.repeat(np.arange(len(stack)), shape[1])
    ends, target = start.reshape(-1, 3).copy(), np.broadcast_to(wanted, shape).reshape(-1, 3)
    run = np.flatnonzero(np.isfinite(ends).all(axis=-1))
    met = np.zeros(len(ends), dtype=bool)
    every = stack.surfaces()
    for _ in range(steps):
        surfaces = take(every, which[run])
        step, moved = newton_step(surfaces, ends[run, None], target[run, None], length)
        ends[run] += step[:, 0]
        still = moved[:, 0] > SETTLED * (1 + np.abs(ends[run]).max(axis=-1))
        met[run[~still]] = True
        run = run[still]
        if not len(run):
            break
    if len(run):  # slow ones are kept where they are on the linkage
        d, turn = complex_of(ends[run, None]), np.exp(1j * ends[run, None, 2] / length)
        miss, _, _ = take(every, which[run]).at(d[:, None], turn[:, None])
        met[run] = (np.abs(miss) < 1e-9).all(axis=(1, 2))
    ends[~met] = np.nan
    return ends.reshape(shape)


def newton_step(
    surfaces: ConstraintForms, here: FloatArray, target: FloatArray, length: float
) -> tuple[FloatArray, FloatArray]:
    """The step (k, n, 3) from rows (k, n, 3) towards the feet of normals, and its size (k, n).

    Back onto both manifolds, and along their intersection to where target (k, n, 3) is nearest.
    """
    d, turn = complex_of(here)[:, None], np.exp(1j * here[:, None, :, 2] / length)
    miss, push, swing = surfaces.at(d, turn)
    moment = -swing.imag / length
    f1, f2, push1, push2 = miss[:, 0], miss[:, 1], push[:, 0], push[:, 1]
    moment1, moment2 = moment[:, 0], moment[:, 1]
    to = target - here
    to_d, to_a = complex_of(to), to[..., 2]
    a = push1.real**2 + push1.imag**2 + moment1**2
    c = push2.real**2 + push2.imag**2 + moment2**2
    mixed = push1.conj() * push2
    b = mixed.real + moment1 * moment2
    det = np.maximum(a * c - b * b, PARALLEL * a * c) + np.finfo(float).tiny
    # What the poses pull with, as shares of both forces, and how the manifolds bend under it.
    pull1 = (push1.conj() * to_d).real + moment1 * to_a
    pull2 = (push2.conj() * to_d).real + moment2 * to_a
    along, omega = -1j * (push1 * moment2 - push2 * moment1), mixed.imag
    bend = surfaces.bend(turn, swing, along[:, None], omega[:, None] / length)
    share1, share2 = c * pull1 - b * pull2, a * pull2 - b * pull1
    curved = 1 + (share1 * bend[:, 0] + share2 * bend[:, 1]) / det**2
    share = ((along.conj() * to_d).real + omega * to_a) / det / np.maximum(curved, FLAT)
    back1, back2 = (c * f1 - b * f2) / det, (a * f2 - b * f1) / det
    step_d = share * along - back1 * push1 - back2 * push2
    step_a = share * omega - back1 * moment1 - back2 * moment2
    step = np.stack([step_d.real, step_d.imag, step_a], axis=-1)
    size = np.abs(step).max(axis=-1)
    return step * np.minimum(1.0, FAR / np.maximum(size, FAR))[..., None], size
