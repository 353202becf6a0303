"""The places of an assembled linkage nearest to the poses, on each of its circuits.

Near means a small |position difference|² + (length x angle difference)².  For each pose, samples of
the circuit give starts, and Newton's method (`foot_points`) leads from the nearest of them, and
from the one beside it, to the nearest places.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.foot_points import foot_points, places_of, rows_of, wrapped
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray


class SearchEffort(NamedTuple):
    """The number of samples of each circuit, and of local minima followed for each pose.

    converged_step: relative; a smaller one of Newton's steps is the last.  It squares errors, so
    the root of rounding will do where there are many places.
    """

    samples: int
    minima: int
    converged_step: float


# Up to MAX_POSES_THOROUGH poses, and for more poses.
THOROUGH: Final = SearchEffort(samples=128, minima=3, converged_step=1e-12)
QUICK: Final = SearchEffort(samples=256, minima=1, converged_step=1e-8)
MAX_POSES_THOROUGH: Final = 1000  # number of poses
# Number of places searched for at once, of all linkages, and the least number of poses at once;
# bounds the memory.
PLACES_PER_BLOCK: Final = 20_000
POSES_PER_BLOCK: Final = 256
FAR_AWAY: Final = 1e9  # lengths; where samples count as being that do not exist
# Samples are added where they are far apart: at most REFINEMENTS times, in the GAPS_PER_REFINEMENT
# widest gaps, as long as some gap is wider than WIDE_GAP (lengths, relative to 1 + the distance
# from the origin).
REFINEMENTS: Final = 4
GAPS_PER_REFINEMENT: Final = 16
WIDE_GAP: Final = 0.2
MEDIAN_PARAMETER: Final = 2.0  # lengths; half of the samples of an endless circuit are below it
ENDLESS_MARGIN: Final = 1e-6  # fraction of an endless circuit without samples, at each end
MAX_STEPS: Final = 12  # number of Newton's steps from a sample, before bracketing takes over
# Bracketing where Newton's method fails: number of rounds, and of samples in each round.
BRACKETING_ROUNDS: Final = 4
BRACKETING_SAMPLES: Final = 17
SPACING_SAFETY: Final = 2.0  # factor on the sample spacing, to bound the distance between samples
SAME_SQUARE: Final = 1e-12  # squared lengths; squared distances that differ by less are equal
ON_LINKAGE: Final = 1e-10  # residual, in lengths, of a place on the linkage
EQUALLY_NEAR: Final = 1e-9  # relative; squared distances that differ by less are equal
MEETING_MARGIN: Final = 1e-9  # circuits meet where `Location.circuit_margin` is no larger


def on_circuits(batch: LinkageBatch, poses: Displacement, length: float) -> Displacement:
    """The nearest places (k, 2, N) to poses (N,) or (k, N) on both circuits of linkages (k,).

    In frames where lengths are about 1 (`pose_error.error_frames`).  nan where the circuit does not
    exist.  Newton's method starts from the nearest of some hundred samples of the circuit; that no
    other minimum is nearer is not proved.  Angles are within half a turn of the poses'.
    """
    count, number = len(batch), poses.shape[-1]
    out = np.full((count, 2, number, 3), np.nan)
    target = rows_of(poses, length)
    effort = THOROUGH if number <= MAX_POSES_THOROUGH else QUICK
    if not count:
        return places_of(out, length)
    search = _CircuitSearch.of(batch, length, effort)
    at_once = POSES_PER_BLOCK
    if effort is QUICK:
        at_once = max(POSES_PER_BLOCK, PLACES_PER_BLOCK // (2 * count))
    for at in range(0, number, at_once):
        block = slice(at, at + at_once)
        out[:, :, block] = search.nearest(target[..., block, :])
    return places_of(out, length)


def on_own_circuits(
    batch: LinkageBatch, rows: FloatArray, both: FloatArray, poses: Displacement, length: float
) -> FloatArray:
    """The nearest places (k, N, 3) to poses (N,), on the circuits of given places (k, N, 3).

    both: (k, 2, N, 3), the rows of those on each circuit (`on_circuits`).
    A descent may have left the given places in one local minimum while another one on the same
    circuit is nearer.  Of linkages with given places on both circuits, the nearest ones on either.
    A given place stays where it is on no circuit, and where it is on the linkage and nearer.
    """
    target = rows_of(poses, length)
    linkage, pose = np.indices(rows.shape[:2])
    places = places_of(rows, length)
    circuit = Circuits.of(batch, as_given=True).locate(places).circuit
    mixed = (circuit != circuit[:, :1]).any(axis=1)
    side = np.where(mixed[:, None], _nearest_of(both, target, 1), np.maximum(circuit, 0))
    nearer = np.where((circuit >= 0)[..., None], both[linkage, side, pose], rows)
    off = np.abs(batch.jacobians(places).residual).max(axis=1) > ON_LINKAGE
    least = _squares(rows, target) * (1 + EQUALLY_NEAR)
    better = off | (_squares(nearer, target) <= least)
    better &= np.isfinite(nearer).all(axis=-1)
    return np.where(better[..., None], nearer, rows)


def nearest(places: Displacement, poses: Displacement, length: float) -> Displacement:
    """The nearer (k, N) of the places (k, 2, N) on two circuits; nan where there is none.

    poses: (N,) or (k, N).
    """
    target = rows_of(poses, length)
    side = _nearest_of(rows_of(places, length), target if target.ndim == 2 else target[:, None], 1)
    row, pose = np.indices(side.shape)
    return places[row, side, pose]


@final
@dataclass(frozen=True, slots=True, eq=False)
class _CircuitSearch:
    """The circuits (k, 2) of linkages (k,), with samples of the existing ones.

    row, side: (n,), linkage and circuit of each existing circuit.
    share: (n, s), where on its circuit each sample is, a fraction; gap: (n, s), the distance to the
        farther of its neighbours in these fractions.
    samples: (n, s, 3), their places; spacing: (n, s), the distance to the farther neighbour.
    """

    batch: LinkageBatch
    circuits: Circuits
    length: float
    effort: SearchEffort
    row: NDArray[np.intp]
    side: NDArray[np.intp]
    share: FloatArray
    gap: FloatArray
    samples: FloatArray
    spacing: FloatArray

    @classmethod
    def of(cls, batch: LinkageBatch, length: float, effort: SearchEffort) -> Self:
        """The search on the circuits (k, 2) of linkages (k,), sampled."""
        circuits = Circuits.of(batch, as_given=True)
        row, side = np.nonzero(circuits.exists)
        share, samples = sampled(circuits[row, side], length, effort.samples)
        after = _distance_to_next(samples, length)
        gap = np.roll(share, -1, axis=-1) - share
        gap[:, -1:] += 1
        gap = np.maximum(gap, np.roll(gap, 1, axis=-1))
        spacing = np.maximum(after, np.roll(after, 1, axis=-1))
        return cls(batch, circuits, length, effort, row, side, share, gap, samples, spacing)

    def nearest(self, target: FloatArray) -> FloatArray:
        """The places (k, 2, N, 3) nearest to target (N, 3) or (k, N, 3)."""
        out = np.full((len(self.batch), 2, target.shape[-2], 3), np.nan)
        if not len(self.row):
            return out
        if target.ndim == 3:  # of each circuit
            target = target[self.row]
        # The numbers (n, N, *) of the samples from which Newton's method starts, and their places.
        if self.effort.minima == 1:
            start, sample = _nearest_samples(self.samples, target, self.length)
        else:
            start, sample = _local_minima(self.samples, target, self.length, self.effort.minima)
        wanted = np.broadcast_to(target[..., None, :], start.shape)
        away = np.sqrt(_squares(start, wanted))
        # No place beside a sample is nearer than this.
        spacing = self.spacing[np.arange(len(sample))[:, None, None], sample]
        bound = away - SPACING_SAFETY * spacing
        hopeless = bound > np.fmin.reduce(away, axis=-1, keepdims=True)
        start[hopeless] = bound[hopeless] = np.nan
        ends = _newton_ends(
            self.batch[self.row], start, wanted, self.length, self.effort.converged_step
        )
        # Newton's method may leap to the other circuit, or past the minimum.
        astray = ~(_squares(ends, wanted) <= _squares(start, wanted) + SAME_SQUARE)
        astray |= self._on_other_circuit(self.row, self.side, ends)
        ends[astray] = np.nan
        sound = np.where(astray, np.inf, np.sqrt(_squares(ends, wanted)))
        astray &= bound <= sound.min(axis=-1, keepdims=True)
        if astray.any():
            which = np.nonzero(astray)
            ends[which] = self._bracketed(which[0], sample[which], wanted[which])
        best = _nearest_of(ends, wanted, -1)[..., None, None]
        out[self.row, self.side] = np.take_along_axis(ends, best, axis=2)[:, :, 0]
        return out

    def _on_other_circuit(
        self, row: NDArray[np.intp], side: NDArray[np.intp], ends: FloatArray
    ) -> NDArray[np.bool_]:
        """Whether places (n, *, 3) are not on circuits `side` (n,) of linkages `row` (n,)."""
        out = np.zeros(ends.shape[:-1], dtype=bool)
        two = np.flatnonzero(np.asarray(self.circuits.exists.all(axis=-1))[row])
        if len(two):
            places = Displacement(ends[two, ..., :2], ends[two, ..., 2] / self.length)
            at = self.circuits[row[two]].locate(places)
            own = side[two].reshape(-1, *[1] * (ends.ndim - 2))
            # Where circuits meet, a place is on both.
            apart = np.greater(at.circuit_margin, MEETING_MARGIN)
            out[two] = np.not_equal(at.circuit, own) & apart
        return out

    def _bracketed(
        self,
        which: NDArray[np.intp],
        sample: NDArray[np.intp],
        target: FloatArray,
    ) -> FloatArray:
        """The places (m, 3) nearest to target (m, 3) beside samples (m,) of circuits (m,)."""
        row, side = self.row[which], self.side[which]
        bracket = Bracket(self.share[which, sample, None], self.gap[which, sample, None])

        def away(rows: FloatArray) -> FloatArray:
            gap = wrapped(rows - target[:, None, None], self.length)
            return np.asarray(np.nan_to_num(_squares(gap, 0.0), nan=np.inf))

        _, rows = bracketed_least(
            *(self.circuits[row, side], bracket, away, self.length),
            rounds=BRACKETING_ROUNDS,
            count=BRACKETING_SAMPLES,
        )
        near = target + wrapped(rows[:, 0] - target, self.length)
        ends = _newton_ends(self.batch[row], near[:, None], target[:, None], self.length)[:, 0]
        after = np.nan_to_num(_squares(ends, target), nan=np.inf)
        worse = after > _squares(near, target) + SAME_SQUARE
        worse |= self._on_other_circuit(row, side, ends)
        return np.where(worse[..., None], near, ends)


def sampled(circuits: Circuits, length: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Fractions (n, s) of circuits (n,) and samples (n, s, 3) there, more where they are wide."""
    share = np.tile((np.arange(count) + 0.5) / count, (len(circuits.exists), 1))
    samples = places_at(circuits, share, length)
    for _ in range(REFINEMENTS if len(share) else 0):
        wide = _relative_gaps(samples, length)
        if not (wide > WIDE_GAP).any():
            break
        share, samples = _refined(circuits, share, samples, wide, length)
    return share, samples


def places_at(circuits: Circuits, share: FloatArray, length: float) -> FloatArray:
    """Places (*, s, 3) at fractions (s,) or (*, s) of circuits (*,)."""
    closed, slides = circuits.closed[..., None], ~circuits.turns[..., None]
    parameter = 2 * np.pi * (share % 1)
    if not closed.all():
        parameter = np.where(closed, parameter, np.pi * np.clip(share, 0, 1))
    if (endless := slides & ~closed).any():
        inside = np.clip(share, ENDLESS_MARGIN, 1 - ENDLESS_MARGIN)
        slid = MEDIAN_PARAMETER * np.tan(np.pi * (inside - 0.5))
        parameter = np.where(endless, slid, parameter)
    return rows_of(circuits.couplers(parameter), length)


class Bracket(NamedTuple):
    """Fractions (n, *) of circuits (n,), how far to look on both sides, and where circuits end.

    low, high: (n, 1) or broadcastable.
    """

    middle: FloatArray
    reach: FloatArray
    low: FloatArray = np.full((1, 1), -np.inf)
    high: FloatArray = np.full((1, 1), np.inf)

    def at(self, index: NDArray[np.intp]) -> Bracket:
        """The brackets of some points."""
        return self._replace(middle=self.middle[:, index], reach=self.reach[:, index])


def bracketed_least(
    circuits: Circuits,
    bracket: Bracket,
    measure: Callable[[FloatArray], FloatArray],
    length: float,
    *,
    rounds: int,
    count: int,
) -> tuple[Bracket, FloatArray]:
    """Brackets around the least of a measure of rows, and the rows (n, *, 3) in their middles.

    count: how many places of a bracket are tried in each round.
    """
    middle, reach, low, high = bracket
    steps = np.linspace(-1, 1, count).reshape(-1, *[1] * (middle.ndim - 1))
    for _ in range(rounds):
        tried = (middle[:, None] + reach[:, None] * steps).clip(low[:, None], high[:, None])
        flat = tried.reshape(len(tried), -1)
        rows = places_at(circuits, flat, length).reshape(*tried.shape, 3)
        at = measure(rows).argmin(axis=1)[:, None]
        middle = np.take_along_axis(tried, at, axis=1)[:, 0]
        best = np.take_along_axis(rows, at[..., None], axis=1)[:, 0]
        reach = reach * 2.0 / (count - 1)
    return bracket._replace(middle=middle, reach=reach), best


def _distance_to_next(samples: FloatArray, length: float) -> FloatArray:
    """The distance (n, s) from each place (n, s, 3) to the next; from the last one to the first."""
    gap = wrapped(np.roll(samples, -1, axis=1) - samples, length)
    return np.nan_to_num(np.sqrt(_squares(gap, 0.0)), nan=np.inf)


def _relative_gaps(samples: FloatArray, length: float) -> FloatArray:
    """The gaps (n, s - 1) of samples over 1 + distance from the origin; endless ones 0."""
    gap = _distance_to_next(samples, length)[:, :-1]
    far = np.sqrt(_squares(samples[:, :-1], 0.0))
    return np.asarray(np.nan_to_num(gap / (1 + far), nan=0.0, posinf=0.0))


def _refined(
    circuits: Circuits, share: FloatArray, samples: FloatArray, gaps: FloatArray, length: float
) -> tuple[FloatArray, FloatArray]:
    """Fractions (n, s) and samples (n, s, 3) with more in the middle of the widest gaps."""
    at = np.argpartition(-gaps, GAPS_PER_REFINEMENT, axis=-1)[:, :GAPS_PER_REFINEMENT]
    middle = (share[:, :-1] + share[:, 1:]) / 2
    more = np.take_along_axis(middle, at, axis=-1)
    samples = np.concatenate([samples, places_at(circuits, more, length)], axis=1)
    share = np.concatenate([share, more], axis=1)
    order = np.argsort(share, axis=-1)
    in_order = np.take_along_axis(samples, order[..., None], axis=1)
    return np.take_along_axis(share, order, axis=-1), in_order


def _newton_ends(
    batch: LinkageBatch,
    start: FloatArray,
    target: FloatArray,
    length: float,
    converged_step: float = THOROUGH.converged_step,
) -> FloatArray:
    """The ends (n, *, 3) of a few of Newton's steps on linkages (n,) from start towards target."""
    flat = (len(batch), math.prod(start.shape[1:-1]), 3)
    ends = foot_points(
        batch,
        start.reshape(flat),
        target.reshape(flat),
        length,
        max_steps=MAX_STEPS,
        converged_step=converged_step,
    )
    return ends.reshape(start.shape)


def _squares(rows: FloatArray, target: FloatArray | float) -> FloatArray:
    """The squared distances (*,) of rows (*, 3) from target."""
    return np.asarray(((rows - target) ** 2).sum(axis=-1))


def _nearest_of(rows: FloatArray, target: FloatArray, axis: int) -> NDArray[np.intp]:
    """The index of the rows (*, 3) nearest to target along an axis of (*,); nan is the farthest."""
    return np.asarray(np.nan_to_num(_squares(rows, target), nan=np.inf).argmin(axis=axis))


def _local_minima(
    samples: FloatArray, target: FloatArray, length: float, count: int
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Of samples (n, s, 3) the `count` local minima nearest to target: (n, N, count + 1, 3).

    target: (N, 3) or (n, N, 3).

    The last one is the sample beside the nearest.  With angles within half a turn of the target's,
    and the numbers (n, N, count + 1) of the samples.  nan where there are fewer.
    """
    x, y, swung = np.moveaxis(samples[:, None], -1, 0)
    gap = swung - target[..., None, 2]
    gap -= 2 * np.pi * length * np.round(gap / (2 * np.pi * length))
    away = (x - target[..., None, 0]) ** 2 + (y - target[..., None, 1]) ** 2 + gap * gap
    away[np.isnan(away)] = np.inf
    minimum = np.ones(away.shape, dtype=bool)  # an open circuit ends at its first and last sample
    falls = away[..., 1:] <= away[..., :-1]
    minimum[..., 1:-1] = falls[..., :-1] & (away[..., 1:-1] <= away[..., 2:])
    depth = np.where(minimum, away, np.inf)
    best = np.argpartition(depth, count - 1, axis=-1)[..., :count]
    beside = _beside_nearest(away)
    far = [np.take_along_axis(depth, best, axis=-1), np.take_along_axis(away, beside, axis=-1)]
    best = np.concatenate([best, beside], axis=-1)
    chosen = samples[np.arange(len(samples))[:, None, None], best]
    start = target[..., None, :] + wrapped(chosen - target[..., None, :], length)
    none = np.isinf(np.concatenate(far, axis=-1))
    return np.where(none[..., None], np.nan, start), best


def _beside_nearest(away: FloatArray) -> NDArray[np.intp]:
    """The number (*, 1) of the nearer sample beside the nearest one; away: (*, s)."""
    beside = away.argmin(axis=-1)[..., None] + np.array([-1, 1])
    beside %= away.shape[-1]
    nearer = np.take_along_axis(away, beside, axis=-1).argmin(axis=-1)
    return np.asarray(np.take_along_axis(beside, nearer[..., None], axis=-1))


def _nearest_samples(
    samples: FloatArray, target: FloatArray, length: float
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Of samples (n, s, 3) the one nearest to each target: (n, N, 1, 3), as `_local_minima`."""
    flat = _on_the_circle(np.nan_to_num(samples, nan=FAR_AWAY), length)
    away = (flat * flat).sum(axis=-1)[:, None] / 2
    away = away - _on_the_circle(target, length) @ np.swapaxes(flat, -1, -2)
    best = away.argmin(axis=-1)
    gap = np.take_along_axis(samples, best[..., None], axis=1) - target
    return (target + wrapped(gap, length))[:, :, None], best[..., None]


def _on_the_circle(rows: FloatArray, length: float) -> FloatArray:
    """Rows (*, 3) as points (*, 4): the angle as a point of a circle of that radius."""
    angle = rows[..., 2] / length
    turn = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return np.concatenate([rows[..., :2], length * turn], axis=-1)
