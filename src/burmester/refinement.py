"""The last step to a linkage: all its dimensions at once, for the least error at the poses.

Two dyads that are best one by one do not make the best linkage.  Here the places of the coupler
nearest to the poses, on the circuits where they are, are brought nearer by Gauss and Newton's
method in all ten dimensions of both dyads (four of each slider), by exact derivatives: at a place
x nearest to a pose only what is normal to the motion counts, and there J dx = -F dz, with J the
forces of both dyads and F the derivatives of their equations by the dimensions z.

Under conditions (limits, a branch to be kept, exact poses) each step is the best one for the
equations as they are here (`soft_program`), by the sum of squares and of all that is not kept
(Fletcher, Practical methods of optimization, 1987).  Where conditions look at the places, these
need not be the nearest ones: they are unknowns too, one each, the way along the motion.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.accuracy import Normal, newton_step, normal, rows_of
from burmester.conditions import Conditions
from burmester.displacement import Displacement, FloatArray
from burmester.soft_program import soft_step
from burmester.stack import DIMENSIONS, LinkageStack

__all__ = ["Refined", "refine"]

SIZE = 2 * DIMENSIONS
NEARER, CLOSE = 6, 1e-6  # Newton's steps to the nearest place; a step whose next is rounding
OFF = 1e-6  # a place farther off its linkage is lost
FAR = 0.25  # lengths that a place may move in a step
STEPS = 60  # of Gauss and Newton, at most
HELD = 120  # steps under conditions, at most
DAMPING, LEAST, MOST = 1e-4, 1e-14, 1e8  # relative, of Levenberg and Marquardt
SETTLED = 1e-13  # a relative step that is rounding
CURVED = 4  # good steps, before those take the residuals' curvature into account
GAIN = 1e-14  # relative; less of it ends the steps
STIFF, STIFFER, STIFFEST = 1.0, 4.0, 1e5  # what a condition's miss counts as: at first, at most
OVER = 3.0  # times the greatest multiplier, that it counts as once all are met
COARSE = 1e-3  # of the greatest slope; a dimension that tells less is damped as if it told so much
MET = 1e-9  # a condition missed by less is met
TOUCHED = 1e-6  # of `stiff`; what presses less on a condition does not touch it
FEW = 64  # places that may be unknowns
STRIDE = 1e-7  # of the difference quotients of conditions
FARTHEST = 1e4  # lengths; a dimension beyond it is on its way to nowhere
POWERS = (2.0, 8.0, 32.0, 128.0, 512.0)  # sums of ever higher powers lead to the least worst
PLACES = 4096  # poses whose derivatives are held in memory together


@final
@dataclass(frozen=True, slots=True, eq=False)
class Refined:
    """Linkages (k,) as they came out, in the frames they were given in.

    rows: (k, N, 3), the coupler's places as x, y, length x angle; nan where a linkage was lost.
    cost: (k,), half the weighted sum of squared distances (or the greatest distance).
    settled: (k,), whether the steps came to an end; met: whether all conditions hold.
    """

    stack: LinkageStack
    rows: FloatArray
    cost: FloatArray
    settled: NDArray[np.bool_]
    met: NDArray[np.bool_]


class _State(NamedTuple):
    """Linkages (k,) with their places: misses u (k, N, 2) normal to the motion, and derivatives."""

    z: FloatArray
    rows: FloatArray
    miss: FloatArray
    slope: FloatArray
    moved: FloatArray

    def some(self, index: NDArray[Any]) -> _State:
        """Those at the indices, or where a mask says so."""
        return _State(*(part[index] for part in self))

    def but(self, where: NDArray[np.bool_], other: _State) -> _State:
        """The same, but where a mask (k,) says so the other."""

        def merged(old: FloatArray, new: FloatArray) -> FloatArray:
            return np.where(where.reshape(-1, *[1] * (new.ndim - 1)), new, old)

        return _State(*(merged(old, new) for old, new in zip(self, other, strict=True)))


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Problem:
    kinds: NDArray[np.int8]
    wanted: FloatArray
    length: float
    share: FloatArray  # (N,), roots of the weights, 0 for exact poses
    exact: NDArray[np.bool_]
    conditions: Conditions | None
    free: NDArray[np.bool_]

    def stack(self, which: NDArray[np.intp], z: FloatArray) -> LinkageStack:
        return LinkageStack(self.kinds[which], z.reshape(-1, 2, DIMENSIONS))

    def state(self, which: NDArray[np.intp], z: FloatArray, rows: FloatArray) -> _State:
        """The linkages z (k, 10) with the places nearest to the poses that rows lead to."""
        stack = self.stack(which, z)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            surfaces = stack.surfaces()
            for _ in range(NEARER):
                step, size = newton_step(surfaces, rows, self.wanted, self.length)
                rows = rows + step
                if not (size > CLOSE).any():
                    break
            places = Displacement(rows[..., :2], rows[..., 2] / self.length)
            miss, force, partial = stack.bearing(places)
            off = ~(np.abs(miss) < OFF).all(axis=(1, 2))
            rows[off] = np.nan
            at = normal(miss, force, self.length)
            return _State(z, rows, *_normal_part(at, rows - self.wanted, partial))

    @property
    def loose(self) -> bool:
        """Whether places are unknowns."""
        looked_at = self.conditions is not None and getattr(self.conditions, "placed", True)
        return looked_at and len(self.wanted) <= FEW

    def placed(self, which: NDArray[np.intp], z: FloatArray, rows: FloatArray) -> _State:
        """The linkages z (k, 10) with the places (k, N) that are straight ahead of rows.

        Misses are whole gaps (k, N, 3), and the ways along the motion are unknowns N + 10.
        """
        if not self.loose:
            return self.state(which, z, rows)
        stack, number = self.stack(which, z), rows.shape[1]
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            surfaces = stack.surfaces()
            for _ in range(NEARER):
                step, size = newton_step(surfaces, rows, rows, self.length)
                rows = rows + step
                if not (size > CLOSE).any():
                    break
            places = Displacement(rows[..., :2], rows[..., 2] / self.length)
            miss, force, partial = stack.bearing(places)
            off = ~(np.abs(miss) < OFF).all(axis=(1, 2))
            rows[off] = np.nan
            at, gap = normal(miss, force, self.length), rows - self.wanted
            every = np.arange(number)
            moved = np.zeros((*gap.shape, SIZE + number))
            moved[..., :SIZE] = _normal_part(at, gap, partial)[2]
            moved[:, every, :, SIZE + every] = np.moveaxis(at.along, 1, 0)
            return _State(z, rows, gap, moved, moved)

    def limits(
        self, which: NDArray[np.intp], state: _State
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
        """The conditions (k, m), and their derivatives (k, m, n), places moving along."""
        unknowns = state.moved.shape[-1]
        if self.conditions is None:
            none = np.empty((len(which), 0, unknowns))
            return none[..., 0], none, np.empty(0, dtype=bool)
        nudge = STRIDE * np.eye(unknowns)[:, None, :SIZE]
        z = np.concatenate([state.z[None], state.z + nudge])
        steps = STRIDE * np.moveaxis(state.moved, -1, 0)
        rows = np.concatenate([state.rows[None], state.rows + steps])
        count, number = len(which), state.rows.shape[1]
        every = np.tile(which, unknowns + 1)
        value, equal = self.conditions(
            self.stack(every, z.reshape(-1, SIZE)), rows.reshape(-1, number, 3), every
        )
        value = value.reshape(unknowns + 1, count, -1)
        slope = np.moveaxis((value[1:] - value[0]) / STRIDE, 0, -1)
        return value[0], np.where(self.may(which)[:, None], slope, 0.0), equal

    def may(self, which: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Which unknowns (k, n) may change."""
        ways = np.ones((len(which), len(self.wanted) if self.loose else 0), dtype=bool)
        return np.concatenate([self.free[which], ways], axis=1)

    def rooted(self, state: _State, power: float) -> tuple[FloatArray, FloatArray]:
        """Residuals (k, *) and their derivatives (k, *, n) whose squares are to be least."""
        count, unknowns = state.slope.shape[0], state.slope.shape[-1]
        miss = self.share[:, None] * state.miss
        slope = self.share[:, None, None] * state.slope
        if power == 2.0:
            number = miss.shape[1] * miss.shape[2]  # given, as there may be no linkages
            return miss.reshape(count, number), slope.reshape(count, number, unknowns)
        size = np.sqrt((miss * miss).sum(axis=-1)) + np.finfo(float).tiny
        top = size.max(axis=-1, keepdims=True)
        toward = (miss[..., None] * slope).sum(axis=-2) / size[..., None]
        root = (size / top) ** (power / 2)
        return top * root, (power / 2 * root / size * top)[..., None] * toward


def refine(
    stack: LinkageStack,
    places: Displacement,
    poses: Displacement,
    length: float,
    *,
    weights: FloatArray | None = None,
    exact: NDArray[np.bool_] | None = None,
    conditions: Conditions | None = None,
    free: NDArray[np.bool_] | None = None,
    worst: bool = False,
    steps: int = STEPS,
    held_steps: int = HELD,
) -> Refined:
    """Linkages (k,) with the least error at poses (N,), from those given and their places (k, N).

    In frames where lengths are about 1 (`accuracy.error_frames`).  The places go along
    continuously, so they stay on their circuits.  free: (k, 10), which dimensions may change.
    worst: the greatest distance is to be least, not the sum of squares; by sums of ever higher
    powers of the distances, so to about half a percent.  steps, and held_steps where something
    is held: at most.
    All minima are local ones.
    """
    count, number = len(stack), poses.shape[0]
    exact = np.zeros(number, dtype=bool) if exact is None else exact
    weights = np.ones(number) if weights is None else weights / weights.mean()
    share = np.where(exact, 0.0, np.sqrt(weights))
    slots = np.ones((count, 2, DIMENSIONS), dtype=bool)
    slots[..., -1] = stack.kinds == 0
    used = slots.reshape(count, SIZE) & (True if free is None else free)
    problem = _Problem(stack.kinds, rows_of(poses, length), length, share, exact, conditions, used)
    state = problem.state(
        np.arange(count), stack.dimensions.reshape(count, SIZE), rows_of(places, length)
    )
    held = bool(exact.any()) or conditions is not None
    rows, met = state.rows, np.ones(count, dtype=bool)
    for power in POWERS if worst else POWERS[:1]:
        if held:
            z, rows, done, met = _held(problem, state.z, rows, power, held_steps)
            state = state._replace(z=z)
        else:
            state, done = _descend(problem, state, power, steps)
            rows = state.rows
    size = share * np.sqrt(((rows - problem.wanted) ** 2).sum(axis=-1))
    cost = size.max(axis=-1) if worst else (size * size).sum(axis=-1) / 2
    lost = ~np.isfinite(cost)
    return Refined(problem.stack(np.arange(count), state.z), rows, cost, done & ~lost, met & ~lost)


def _normal_part(
    at: Normal, gap: FloatArray, partial: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Of gaps (k, N, 3) what is normal to the motion, (k, N, 2), in an orthonormal basis.

    With its derivatives (k, N, 2, 10) by the dimensions, and those of the places (k, N, 3, 10).
    """
    a, b, _ = np.moveaxis(at.gram, -1, 0)
    first, height = np.sqrt(a), np.sqrt(at.det / a)
    basis = np.empty_like(at.force)
    basis[..., 0, :] = at.force[..., 0, :] / first[..., None]
    basis[..., 1, :] = (at.force[..., 1, :] - (b / a)[..., None] * at.force[..., 0, :]) / height[
        ..., None
    ]
    slope = np.zeros((*gap.shape[:-1], 2, SIZE))
    slope[..., 0, :DIMENSIONS] = -partial[:, 0] / first[..., None]
    slope[..., 1, :DIMENSIONS] = (b / a / height)[..., None] * partial[:, 0]
    slope[..., 1, DIMENSIONS:] = -partial[:, 1] / height[..., None]
    moved = np.swapaxes(basis, -1, -2) @ slope
    return (basis @ gap[..., None])[..., 0], slope, moved


def _descend(
    problem: _Problem, state: _State, power: float, steps: int
) -> tuple[_State, NDArray[np.bool_]]:
    """Levenberg and Marquardt's method without conditions."""
    z, rows = state.z.copy(), state.rows.copy()
    parts = [np.array(part) for part in (state.miss, state.slope, state.moved)]
    count = len(z)
    run = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
    bent, trust = np.zeros((count, SIZE, SIZE)), np.zeros(count, dtype=int)
    done, damping = np.zeros(count, dtype=bool), np.full(count, DAMPING)
    here = _State(z, rows, *parts).some(run)
    residual, slope = _free_part(problem, run, here, power)
    for _ in range(steps):
        if not len(run):
            break
        cost = (residual * residual).sum(axis=-1)
        step = _step(residual, slope, damping[run], problem.free[run])
        curved = trust[run] >= CURVED
        if curved.any():
            step[curved] = _curved_step(
                residual[curved], slope[curved], bent[run[curved]], damping[run[curved]]
            )
        step = np.where(problem.free[run], step, 0.0)  # but for rounding it is so
        shift = (here.moved @ step[:, None, :, None])[..., 0]
        part = np.minimum(1.0, FAR / np.maximum(np.abs(shift).max(axis=(1, 2)), FAR))
        step, shift = part[:, None] * step, part[:, None, None] * shift
        to, start = here.z + step, here.rows + shift
        there = problem.state(run, to, start)
        next_residual, next_slope = _free_part(problem, run, there, power)
        with np.errstate(invalid="ignore", over="ignore"):
            after = (next_residual * next_residual).sum(axis=-1)
        if power != 2.0:  # measured in the top distance of before
            after = after * _rescaled(problem, here, there, power)
        radius = to.reshape(-1, 2, DIMENSIONS)[..., -1]
        sound = ((radius > 0) | (problem.kinds[run] > 0)).all(axis=-1)
        sound &= np.abs(to).max(axis=-1) < FARTHEST
        better = sound & (after <= cost * (1 + GAIN))
        small = np.abs(step).max(axis=-1) < SETTLED * (1 + np.abs(here.z).max(axis=-1))
        idle = better & (cost - after < GAIN * cost)
        trust[run] = np.where(better, trust[run] + 1, np.where(curved, 0, trust[run]))
        go = np.flatnonzero(better)
        bent[run[go]] = _secant(
            bent[run[go]], step[go], residual[go], slope[go], next_residual[go], next_slope[go]
        )
        here = here.but(better, there)
        residual = np.where(better[:, None], next_residual, residual)
        slope = np.where(better[:, None, None], next_slope, slope)
        damping[run] = np.clip(np.where(better, damping[run] / 10, damping[run] * 10), LEAST, None)
        for whole, part in zip((z, rows, *parts), here, strict=True):
            whole[run] = part
        end = small | idle | (damping[run] > MOST)
        done[run[end]] = True
        here, residual, slope, run = here.some(~end), residual[~end], slope[~end], run[~end]
    return _State(z, rows, *parts), done


def _rescaled(problem: _Problem, here: _State, there: _State, power: float) -> FloatArray:
    """What the sum of powers at `there` is multiplied by, to be compared with that at `here`."""
    top = [
        np.sqrt(((problem.share[:, None] * each.miss) ** 2).sum(axis=-1)).max(axis=-1)
        for each in (here, there)
    ]
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        return np.asarray((top[1] / top[0]) ** (power - 2))


def _free_part(
    problem: _Problem, which: NDArray[np.intp], state: _State, power: float
) -> tuple[FloatArray, FloatArray]:
    """Residuals (k, *) and derivatives (k, *, n) by what may change."""
    residual, slope = problem.rooted(state, power)
    return residual, np.where(problem.may(which)[:, None], slope, 0.0)


def _all_conditions(
    problem: _Problem, which: NDArray[np.intp], state: _State
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Exact poses (equalities) and conditions: values (k, m), derivatives, which are to be 0."""
    count = len(which)
    value, slope, equalities = problem.limits(which, state)
    exact = state.miss[:, problem.exact].reshape(count, -1)
    turn = state.slope[:, problem.exact].reshape(count, -1, state.slope.shape[-1])
    turn = np.where(problem.may(which)[:, None], turn, 0.0)
    equal = np.concatenate([np.ones(exact.shape[1], dtype=bool), equalities])
    return np.concatenate([exact, value], axis=1), np.concatenate([turn, slope], axis=1), equal


def _step(
    residual: FloatArray, slope: FloatArray, damping: FloatArray, free: NDArray[np.bool_]
) -> FloatArray:
    """Levenberg and Marquardt's step (k, 10)."""
    size = np.sqrt((slope * slope).sum(axis=1))
    top = size.max(axis=-1, keepdims=True) + np.finfo(float).tiny
    size = np.where(free, np.maximum(size, 1e-12 * top), top)
    whole = np.concatenate([slope / size[:, None], residual[..., None]], axis=-1)
    low = np.zeros((len(residual), SIZE, SIZE + 1))
    low[:, range(SIZE), range(SIZE)] = np.sqrt(damping)[:, None]
    upper = np.asarray(np.linalg.qr(np.concatenate([whole, low], axis=1), mode="r"))
    return np.asarray(
        -np.linalg.solve(upper[:, :SIZE, :SIZE], upper[:, :SIZE, SIZE:])[..., 0] / size
    )


def _curved_step(
    residual: FloatArray, slope: FloatArray, bent: FloatArray, damping: FloatArray
) -> FloatArray:
    """Newton's step (k, 10), with what is known of the curvature of the residuals."""
    flat = np.swapaxes(slope, -1, -2) @ slope
    size = np.sqrt(np.maximum(np.einsum("kii->ki", flat), np.finfo(float).tiny))
    size = np.maximum(size, 1e-12 * size.max(axis=-1, keepdims=True))
    downhill = (np.swapaxes(slope, -1, -2) @ residual[..., None])[..., 0] / size
    values, axes = np.linalg.eigh((flat + bent) / (size[:, None] * size[..., None]))
    values = np.maximum(np.abs(values), 1e-8) + damping[:, None]
    along = (np.swapaxes(axes, -1, -2) @ downhill[..., None])[..., 0] / values
    return np.asarray(-(axes @ along[..., None])[..., 0] / size)


def _secant(  # noqa: PLR0917
    bent: FloatArray,
    step: FloatArray,
    residual: FloatArray,
    slope: FloatArray,
    next_residual: FloatArray,
    next_slope: FloatArray,
) -> FloatArray:
    """The residuals' own curvature (k, 10, 10), learnt from a step.

    Dennis, Gay and Welsch, An adaptive nonlinear least-squares algorithm, ACM TOMS 7, 1981.
    """

    def against(rows: FloatArray, values: FloatArray) -> FloatArray:
        return np.asarray((np.swapaxes(rows, -1, -2) @ values[..., None])[..., 0])

    ahead = against(next_slope, next_residual)
    own, gained = ahead - against(slope, next_residual), ahead - against(slope, residual)
    curve = (gained * step).sum(axis=-1)
    guess = (bent @ step[..., None])[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        shrink = np.minimum(np.abs((step * own).sum(-1) / (step * guess).sum(-1)), 1.0)
        shrink = np.where(np.isfinite(shrink), shrink, 1.0)[:, None]
        rest = (own - shrink * guess) / curve[:, None]
        lean = (step * rest).sum(axis=-1) / curve
        mixed = rest[..., None] * gained[:, None]
        new = shrink[..., None] * bent + mixed + np.swapaxes(mixed, -1, -2)
        new = new - lean[:, None, None] * gained[..., None] * gained[:, None]
    sound = (curve > 0) & np.isfinite(new).all(axis=(1, 2))
    return np.where(sound[:, None, None], new, bent)


class _Seen(NamedTuple):
    """Linkages (k,) with residuals (k, *) and conditions (k, m), and derivatives by unknowns."""

    state: _State
    residual: FloatArray
    slope: FloatArray
    value: FloatArray
    turn: FloatArray

    @classmethod
    def of(cls, problem: _Problem, which: NDArray[np.intp], state: _State, power: float) -> _Seen:
        with np.errstate(all="ignore"):
            value, turn, _ = _all_conditions(problem, which, state)
            return cls(state, *_free_part(problem, which, state, power), value, turn)

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

    problem: _Problem
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
    def of(cls, problem: _Problem, z: FloatArray, rows: FloatArray, power: float) -> _Way:
        count, every = len(z), np.arange(len(z))
        seen = _Seen.of(problem, every, problem.placed(every, z.copy(), rows), power)
        one = every[:1]
        equal = _all_conditions(problem, one, seen.state.some(one))[2]
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
                after = after * _rescaled(problem, here.state, place, self.power)
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
        self.curved[go] = _secant(
            self.curved[go],
            step,
            np.concatenate([here.residual, press], axis=1),
            slope,
            np.concatenate([there.residual, press], axis=1),
            ahead,
        )
        self.pressed[go] = press
        self.seen.put(go, there)


def _held(
    problem: _Problem, z: FloatArray, rows: FloatArray, power: float, steps: int
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], NDArray[np.bool_]]:
    """The same with conditions and exact poses: z, rows, whether they came to an end, if all hold.

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
        value, _, _ = _all_conditions(problem, every, also)
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
    problem: _Problem, state: _State, active: NDArray[np.bool_], equal: NDArray[np.bool_]
) -> tuple[_State, NDArray[np.bool_]]:
    """What is held met to rounding: Newton's method, by the shortest step."""
    every = np.arange(len(state.z))
    value, slope, _ = _all_conditions(problem, every, state)
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
        value, slope, _ = _all_conditions(problem, every, state)
    return state, np.asarray(_most(value, equal) < MET)
