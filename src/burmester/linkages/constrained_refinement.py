"""Linkages refined under conditions, and so that exact poses stay exact.

Each step is the best one for the equations as they are here (`soft_program`), by the sum of
squares and of all that is not kept (Fletcher, Practical methods of optimization, 1987).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import DIMENSIONS
from burmester.linkages.residuals import (
    SIZE,
    Problem,
    State,
    all_conditions,
    free_part,
    rescaled,
    secant,
)
from burmester.numerics.arrays import FloatArray
from burmester.numerics.quadratic_program import soft_step

__all__ = ["held"]

FAR = 0.25  # lengths that a place may move in a step
DAMPING, LEAST, MOST = 1e-4, 1e-14, 1e8  # relative, of Levenberg and Marquardt
SETTLED = 1e-13  # a relative step that is rounding
CURVED = 4  # good steps, before those take the residuals' curvature into account
GAIN = 1e-14  # relative; less of it ends the steps
STIFF, STIFFER, STIFFEST = 1.0, 4.0, 1e5  # what a condition's miss counts as: at first, at most
OVER = 3.0  # times the greatest multiplier, that it counts as once all are met
COARSE = 1e-3  # of the greatest slope; a dimension that tells less is damped as if it told so much
MET = 1e-9  # a condition missed by less is met
TOUCHED = 1e-6  # of `stiff`; what presses less on a condition does not touch it
FARTHEST = 1e4  # lengths; a dimension beyond it is on its way to nowhere


class _Seen(NamedTuple):
    """Linkages (k,) with residuals (k, *) and conditions (k, m), and derivatives by unknowns."""

    state: State
    residual: FloatArray
    slope: FloatArray
    value: FloatArray
    turn: FloatArray

    @classmethod
    def of(cls, problem: Problem, which: NDArray[np.intp], state: State, power: float) -> _Seen:
        with np.errstate(all="ignore"):
            value, turn, _ = all_conditions(problem, which, state)
            return cls(state, *free_part(problem, which, state, power), value, turn)

    def some(self, index: NDArray[Any]) -> _Seen:
        """Those at the indices, or where a mask says so."""
        return _Seen(self.state.some(index), *(part[index] for part in self[1:]))

    def put(self, index: NDArray[np.intp], other: _Seen) -> None:
        """Write others in their place."""
        for whole, part in zip((*self.state, *self[1:]), (*other.state, *other[1:]), strict=True):
            whole[index] = part

    @property
    def sound(self) -> NDArray[np.bool_]:
        """Which are finite, (k,)."""
        out = np.ones(len(self.value), dtype=bool)
        for part in (self.state.z, self.state.rows, *self[1:]):
            out &= np.isfinite(part).all(axis=tuple(range(1, part.ndim)))
        return out


class _Program(NamedTuple):
    """What `soft_step` takes for linkages (k,), in unknowns scaled by size (k, n)."""

    bowl: FloatArray
    pull: FloatArray
    value: FloatArray
    turn: FloatArray
    low: FloatArray
    high: FloatArray
    size: FloatArray

    def solved(self) -> tuple[FloatArray, FloatArray]:
        """The steps (k, n) of the unknowns, and what presses against the conditions (k, m)."""
        step, press = soft_step(*self[:-1])
        return step / self.size, press

    def bent(self, index: NDArray[np.intp], value: FloatArray) -> _Program:
        """Some of them with other values of the conditions."""
        return _Program(*(part[index] for part in self))._replace(value=value)


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Way:
    """Linkages (k,) on their way down, under conditions; the arrays are written to.

    By the sum of half the squares and of `stiff` times what is not kept.
    """

    problem: Problem
    power: float
    seen: _Seen
    equal: NDArray[np.bool_]
    stiff: FloatArray
    damping: FloatArray
    curved: FloatArray
    trust: NDArray[np.intp]
    pressed: FloatArray
    done: NDArray[np.bool_]

    @classmethod
    def of(cls, problem: Problem, z: FloatArray, rows: FloatArray, power: float) -> _Way:
        count, every = len(z), np.arange(len(z))
        seen = _Seen.of(problem, every, problem.placed(every, z.copy(), rows), power)
        one = every[:1]
        equal = all_conditions(problem, one, seen.state.some(one))[2]
        unknowns = seen.slope.shape[-1]
        return cls(
            problem,
            power,
            seen,
            equal,
            np.full(count, STIFF),
            np.full(count, 10 * DAMPING),
            np.zeros((count, unknowns, unknowns)),
            np.zeros(count, dtype=np.intp),
            np.zeros(seen.value.shape),
            np.zeros(count, dtype=bool),
        )

    def left(self, value: FloatArray) -> FloatArray:
        """How much of conditions (k, m) is not kept, (k,)."""
        off = np.where(self.equal, np.abs(value), np.maximum(value, 0.0))
        return np.asarray(off.sum(axis=1))

    def program(self, run: NDArray[np.intp], here: _Seen) -> _Program:
        """The equations as they are here."""
        trusted = (self.trust[run] >= CURVED)[:, None, None]
        bowl, size = _bowl(here.slope, np.where(trusted, self.curved[run], 0.0))
        bowl = bowl + self.damping[run][:, None, None] * np.eye(bowl.shape[-1])
        pull = (here.residual[:, None] @ here.slope)[:, 0] / size
        high = np.broadcast_to(self.stiff[run][:, None], here.value.shape)
        low = np.where(self.equal, -high, 0.0)
        return _Program(bowl, pull, here.value, here.turn / size[:, None], low, high, size)

    def tried(
        self, run: NDArray[np.intp], here: _Seen, step: FloatArray
    ) -> tuple[FloatArray, _Seen, FloatArray]:
        """The steps (k, n), no longer than places may go, where they lead, and what it costs."""
        problem = self.problem
        shift = (here.state.moved @ step[:, None, :, None])[..., 0]
        part = np.minimum(1.0, FAR / np.maximum(np.abs(shift).max(axis=(1, 2)), FAR))[:, None]
        to = here.state.z + (part * step)[:, :SIZE]
        place = problem.placed(run, to, here.state.rows + part[..., None] * shift)
        there = _Seen.of(problem, run, place, self.power)
        with np.errstate(all="ignore"):
            after = (there.residual**2).sum(axis=1) / 2
            if self.power != 2.0:  # measured in the top distance of before
                after = after * rescaled(problem, here.state, place, self.power)
            after = after + self.stiff[run] * self.left(there.value)
        radius = to.reshape(-1, 2, DIMENSIONS)[..., -1]
        sound = ((radius > 0) | (problem.kinds[run] > 0)).all(axis=-1) & there.sound
        sound &= np.abs(to).max(axis=-1) < FARTHEST
        return part * step, there, np.where(sound, after, np.inf)

    def advanced(self, run: NDArray[np.intp]) -> NDArray[np.intp]:
        """A step of the linkages run (n,); those that have not come to an end."""
        here, weight = self.seen.some(run), self.stiff[run]
        program = self.program(run, here)
        step, press = program.solved()
        step = np.where(self.problem.may(run), step, 0.0)  # but for rounding it is so
        before = self.left(here.value)
        cost = (here.residual**2).sum(axis=1) / 2 + weight * before
        ahead = self.left(here.value + (here.turn @ step[..., None])[..., 0])
        model = ((here.residual + (here.slope @ step[..., None])[..., 0]) ** 2).sum(axis=1) / 2
        step, there, after = self.tried(run, here, step)
        enough = cost * (1 + GAIN)
        with np.errstate(invalid="ignore"):
            again = np.flatnonzero(~(after <= enough) & (self.left(there.value) > SETTLED))
        if len(again):  # from how much it bends away from the conditions
            some = here.some(again)
            off = there.value[again] - (some.turn @ step[again, :, None])[..., 0]
            second, own = program.bent(again, off).solved()
            second = np.where(self.problem.may(run[again]), second, 0.0)
            second, other, later = self.tried(run[again], some, second)
            won = later <= enough[again]
            at = again[won]
            step[at], press[at], after[at] = second[won], own[won], later[won]
            there.put(at, other.some(won))
        better = after <= enough
        with np.errstate(all="ignore"):
            gain = (cost - after) / np.maximum(cost - model - weight * ahead, np.finfo(float).tiny)
        factor = np.select([~better, gain > 0.75, gain > 0.25], [10.0, 0.1, 0.5], 3.0)
        self.damping[run] = np.maximum(self.damping[run] * factor, LEAST)
        trust = self.trust[run]
        self.trust[run] = np.where(better, trust + 1, np.where(trust >= CURVED, 0, trust))
        go = np.flatnonzero(better)
        self._learn(run[go], step[go], here.some(go), there.some(go), press[go])
        miss = self.left(self.seen.value[run])
        stuck = (miss > MET) & (ahead > before / 2) & (weight < STIFFEST)
        least = np.maximum(OVER * np.abs(press).max(axis=1, initial=0), MET)
        self.stiff[run] = np.select(
            [stuck, miss <= MET], [STIFFER * weight, np.minimum(weight, least)], weight
        )
        small = np.abs(step).max(axis=-1) < SETTLED * (1 + np.abs(here.state.z).max(axis=-1))
        idle = better & (cost - after < GAIN * cost)
        end = (small | idle | (self.damping[run] > MOST)) & ~stuck
        self.done[run[end]] = True
        return np.asarray(run[~end])

    def _learn(
        self, go: NDArray[np.intp], step: FloatArray, here: _Seen, there: _Seen, press: FloatArray
    ) -> None:
        """Linkages go (n,) are there now; how the equations bent on the way."""
        slope, ahead = (np.concatenate([each.slope, each.turn], axis=1) for each in (here, there))
        self.curved[go] = secant(
            self.curved[go],
            step,
            np.concatenate([here.residual, press], axis=1),
            slope,
            np.concatenate([there.residual, press], axis=1),
            ahead,
        )
        self.pressed[go] = press
        self.seen.put(go, there)


def held(
    problem: Problem, z: FloatArray, rows: FloatArray, power: float, steps: int
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], NDArray[np.bool_]]:
    """Linkages refined under conditions: z, rows, whether they came to an end, if all hold.

    A step that bends away from the conditions is taken again (Fletcher's second-order correction).
    """
    way = _Way.of(problem, z, rows, power)
    every, run = np.arange(len(z)), np.flatnonzero(way.seen.sound)
    for _ in range(steps):
        if not len(run):
            break
        run = way.advanced(run)
    active = way.equal | (np.abs(way.pressed) > TOUCHED * way.stiff[:, None])
    state, met = _closed(problem, way.seen.state, active, way.equal)
    if problem.loose:  # the nearest places, where they do as well
        near = problem.state(every, state.z, state.rows)
        also = problem.placed(every, state.z, near.rows)
        value, _, _ = all_conditions(problem, every, also)
        good = np.array(met & (_most(value, way.equal) < MET), dtype=np.bool_)
        state = state.but(good, also)
    return state.z, state.rows, way.done, met


def _most(value: FloatArray, equal: NDArray[np.bool_]) -> FloatArray:
    """By how much conditions (k, m) are missed at the most, (k,); infinite where there is none."""
    off = np.where(equal, np.abs(value), value)
    return np.asarray(np.nan_to_num(off, nan=np.inf).max(axis=-1, initial=0))


def _bowl(slope: FloatArray, bent: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The curvature (k, n, n) of half the squares, scaled by size (k, n); not negative."""
    flat = np.swapaxes(slope, -1, -2) @ slope
    size = np.sqrt(np.einsum("kii->ki", flat))
    size = np.maximum(size, COARSE * size.max(axis=1, keepdims=True))
    size = np.where(size > 0, size, 1.0)  # every pose is exact, and nothing else counts
    values, axes = np.linalg.eigh((flat + bent) / (size[:, None] * size[..., None]))
    values = np.maximum(np.abs(values), 1e-10)
    return (axes * values[:, None]) @ np.swapaxes(axes, -1, -2), size


def _closed(
    problem: Problem, state: State, active: NDArray[np.bool_], equal: NDArray[np.bool_]
) -> tuple[State, NDArray[np.bool_]]:
    """What is held met to rounding: Newton's method, by the shortest step."""
    every = np.arange(len(state.z))
    value, slope, _ = all_conditions(problem, every, state)
    may = problem.may(every)
    for _ in range(6):
        active = active | (value > 0)
        gap = np.where(active, value, 0.0)
        if not (np.abs(gap) > SETTLED).any():
            break
        rows = np.where(active[..., None], slope, 0.0)
        with np.errstate(invalid="ignore"):
            sound = np.isfinite(rows).all(axis=(1, 2)) & np.isfinite(gap).all(axis=1)
        step = np.zeros((len(every), slope.shape[-1]))
        step[sound] = -(np.linalg.pinv(rows[sound], rcond=1e-10) @ gap[sound, :, None])[..., 0]
        step = np.where((np.abs(step).max(axis=-1) < 0.1)[:, None] & may, step, 0.0)
        start = state.rows + (state.moved @ step[:, None, :, None])[..., 0]
        new = problem.placed(every, state.z + step[:, :SIZE], start)
        state = state.but(np.asarray(np.isfinite(new.rows).all(axis=(1, 2))), new)
        value, slope, _ = all_conditions(problem, every, state)
    return state, np.asarray(_most(value, equal) < MET)
