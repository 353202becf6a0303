"""What SciPy's solvers are given for dense paths: cranks whose curves are laid over the path.

A crank's shape (S, 5) is the logarithms of crank, coupler and rocker beside a ground link of 1, and
the coupler point beside the coupler.  Its curve is laid over a path by turning, stretching and
shifting it, at equal shares of the arc; of a closed one from every point on, both ways round.  Then
all nine dimensions and the crank angle of each point are fitted.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask
from benchmarks.field.tools.closure import Scaled

LEAST_DENSE = 10  # points of an open path
STEPS, SHARES = 96, 64  # of a curve; of the arc at which curves are compared
BATCH = 2000
REACH = 1.3  # of the logarithms of lengths
ROUNDS, POWER = 4, 8  # towards the least greatest distance: the norm of that power
DEAD = 1e-3  # least sine between coupler and rocker that is divided by


def is_dense(task: FieldTask) -> bool:
    """Whether a path is closed, timed, or of many points."""
    many = len(task.rows) >= LEAST_DENSE and task.pivots is None
    return task.closed or task.crank is not None or (task.is_path and many)


@dataclass(frozen=True)
class Fit:
    """A crank in the units of a `Scaled` task, with the crank angles (N,) of its points.

    x: ground pivots, lengths of crank, coupler and rocker, coupler point beside the coupler (9,).
    """

    error: float
    x: np.ndarray
    angles: np.ndarray
    side: float

    def four_bar(self, scaled: Scaled) -> FourBar:
        s, m, x = scaled.span, scaled.middle, self.x
        hand = complex(x[7], x[8])
        return FourBar(
            Dyad("RR", complex(m + s * complex(x[0], x[1])), -s * hand, float(s * abs(x[4]))),
            Dyad("RR", complex(m + s * complex(x[2], x[3])), s * (x[5] - hand), s * abs(x[6])),
        )

    def in_order(self, task: FieldTask) -> bool:
        """Whether the crank turns one way from point to point, once round at most."""
        angles = self.angles
        if task.closed:
            way = np.sign(angles[-1] - angles[0])
            angles = np.append(angles, angles[0] + 2 * np.pi * way)
        steps = np.diff(angles)
        one_way = bool((steps >= -1e-9).all() or (steps <= 1e-9).all())
        return one_way and abs(steps.sum()) < 2 * np.pi + 1e-9


def drawn(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Shapes (count, 5) at random, and the sides of their rockers."""
    shapes = np.concatenate(
        [rng.uniform(-REACH, REACH, (count, 3)), 1.2 * rng.normal(size=(count, 2))], axis=1
    )
    return shapes, rng.choice([-1.0, 1.0], count)


def curves(shapes: np.ndarray, side: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Coupler points (S, K) at crank angles (S, K), nan where a linkage is open."""
    a, c, r = np.exp(shapes[:, :3].T)[..., None]
    pin = a * np.exp(1j * angles)
    to = 1 - pin
    with np.errstate(invalid="ignore"):
        opening = np.arccos((c**2 + abs(to) ** 2 - r**2) / (2 * c * abs(to)))
    turn = to / abs(to) * np.exp(1j * side[:, None] * opening)
    return pin + turn * c * (shapes[:, 3:4] + 1j * shapes[:, 4:5])


class Laid:
    """How curves of cranks lie over a path."""

    def __init__(self, task: FieldTask, scaled: Scaled) -> None:
        self.task, self.scaled = task, scaled
        way = (task.way - scaled.middle) / scaled.span
        at = np.concatenate([[0.0], np.abs(np.diff(way)).cumsum()])
        self.shares = (at / at[-1])[: len(task.rows)]
        even = np.linspace(0, 1, SHARES, endpoint=not task.closed)
        path = scaled.places if task.crank is not None else np.interp(even, at / at[-1], way)
        self.even, self.path = even, path - path.mean()

    @property
    def windows(self) -> int:
        """How many numbers beside the shape say which part of a curve is laid."""
        return 0 if self.task.closed else 1 if self.task.crank is not None else 2

    def angles(self, window: np.ndarray) -> np.ndarray:
        """Crank angles (S, K) of windows (S, 0 to 2) in 0 to 1."""
        if self.task.closed:
            return np.tile(np.linspace(0, 2 * np.pi, STEPS + 1), (len(window), 1))
        begin = 2 * np.pi * window[:, :1]
        if self.task.crank is not None:
            return begin + self.task.crank
        turn = (0.1 + 0.88 * window[:, 1:]) * 2 * np.pi
        return begin + turn * np.linspace(0, 1, STEPS + 1)

    def of(
        self, points: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Mean squared distances (S,) of curves (S, K) laid over the path, and how they lie.

        That is turn and stretch (complex), shift (complex), the first place along the path, and
        whether the curve is run backwards.
        """
        with np.errstate(all="ignore"):
            even = points if self.task.crank is not None else self._even(points)
            middle = even.mean(axis=1)
            c = even - middle[:, None]
            size = (abs(c) ** 2).sum(axis=1)
            best = np.full((4, len(c)), np.nan, dtype=complex)
            best[0] = -1
            ways = (False,) if self.task.crank is not None else (False, True)
            for back in ways:
                if self.task.closed:
                    rows = np.roll(c[:, ::-1], 1, axis=1) if back else c
                    match = np.fft.ifft(np.conj(np.fft.fft(rows)) * np.fft.fft(self.path))
                else:
                    rows = c[:, ::-1] if back else c
                    match = (np.conj(rows) @ self.path)[:, None]
                where = abs(match).argmax(axis=1)
                most = match[np.arange(len(c)), where]
                better = abs(most) > best[0].real
                best[:, better] = np.stack([abs(most), most, where, 0 * where + back])[:, better]
            stretch = best[1] / size
            error = (abs(self.path) ** 2).sum() - abs(best[1]) ** 2 / size
        middle_path = self._middle() - stretch * middle
        error = np.where(np.isfinite(error), error / len(self.path), 10.0)
        return error, stretch, middle_path, best[2].real, best[3].real > 0

    def _middle(self) -> complex:
        """What was taken off the path."""
        if self.task.crank is not None:
            return complex(self.scaled.places.mean())
        way = (self.task.way - self.scaled.middle) / self.scaled.span
        return complex(np.interp(self.even, self._shares_of_way(), way).mean())

    def _shares_of_way(self) -> np.ndarray:
        return np.append(self.shares, 1.0) if self.task.closed else self.shares

    def _even(self, points: np.ndarray) -> np.ndarray:
        at = _arc(points)
        out = np.full((len(points), len(self.even)), np.nan, dtype=complex)
        for k in np.flatnonzero(np.isfinite(at[:, -1])):
            out[k] = np.interp(self.even, at[k], points[k])
        return out

    def start(
        self, shape: np.ndarray, side: float, window: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """The dimensions (9,) of a crank laid over the path, and crank angles (N,) there."""
        angles = self.angles(window[None])
        points = curves(shape[None], np.array([side]), angles)
        _, stretch, shift, first, back = (each[0] for each in self.of(points))
        if self.task.crank is None:
            shares = self.shares - (first / SHARES if self.task.closed else 0)
            if self.task.closed:
                shares = (-shares if back else shares) % 1
            elif back:
                shares = 1 - shares
            inside = np.interp(shares, _arc(points)[0], angles[0])
            if self.task.closed:
                inside = np.unwrap(inside)
        else:
            inside = angles[0]
        a, c, r = abs(stretch) * np.exp(shape[:3])
        hand = c * complex(*shape[3:])
        far = shift + stretch
        x = np.array([shift.real, shift.imag, far.real, far.imag, a, c, r, hand.real, hand.imag])
        return x, inside + np.angle(stretch)


def _arc(points: np.ndarray) -> np.ndarray:
    """Shares (S, K) of the arc of curves."""
    at = np.concatenate([np.zeros((len(points), 1)), abs(np.diff(points)).cumsum(axis=1)], axis=1)
    return at / at[:, -1:]


def _traced(
    x: np.ndarray, angles: np.ndarray, side: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Coupler points (N,), their derivatives (N, 9) by the dimensions and (N,) by the angles."""
    a, c, r, hand = *x[4:7], complex(x[7], x[8])
    crank = np.exp(1j * angles)
    pin = complex(x[0], x[1]) + a * crank
    to = complex(x[2], x[3]) - pin
    length = np.maximum(abs(to), 1e-12)
    cosine = (c**2 + length**2 - r**2) / (2 * c * length)
    turn = to / length * np.exp(1j * side * np.arccos(np.clip(cosine, -1, 1)))
    rocker = pin + c * turn - complex(x[2], x[3])
    bar = np.conj(rocker)
    lever = (bar * 1j * c * turn).real
    lever = np.where(abs(lever) < DEAD * abs(c * r), np.copysign(DEAD * abs(c * r), lever), lever)
    one, zero = np.ones_like(crank), np.zeros_like(crank)
    # How rocker pin and coupler point move while the coupler does not turn.
    pins = np.stack([one, 1j * one, -one, -1j * one, crank, turn, zero, zero, zero], axis=1)
    own = np.stack([one, 1j * one, zero, zero, crank, zero, zero, turn, 1j * turn], axis=1)
    turned = -(bar[:, None] * pins).real
    turned[:, 6] += r
    by_turn = 1j * hand * turn
    by_x = own + by_turn[:, None] * turned / lever[:, None]
    along = 1j * a * crank
    by_angle = along - by_turn * (bar * along).real / lever
    return pin + hand * turn, by_x, by_angle


def fitted(
    x: np.ndarray, angles: np.ndarray, side: float, laid: Laid, rounds: int, tries: int
) -> Fit:
    """All dimensions and crank angles by least squares; then the greatest distance made less."""
    from scipy.optimize import least_squares

    places, turned = laid.scaled.places, laid.task.crank
    weights = np.ones(len(places))

    def parts(u: np.ndarray) -> np.ndarray:
        return u[9:] if turned is None else u[9] + turned

    def value(u: np.ndarray) -> np.ndarray:
        away = weights * (_traced(u[:9], parts(u), side)[0] - places)
        return np.concatenate([away.real, away.imag])

    def slope(u: np.ndarray) -> np.ndarray:
        _, by_x, by_angle = _traced(u[:9], parts(u), side)
        last = np.diag(by_angle) if turned is None else by_angle[:, None]
        rows = weights[:, None] * np.concatenate([by_x, last], axis=1)
        return np.concatenate([rows.real, rows.imag])

    u = np.concatenate([x, angles if turned is None else [angles[0] - turned[0]]])
    method = "lm" if 2 * len(places) >= len(u) else "trf"
    best = Fit(np.inf, x, angles, side)
    for number in range(rounds):
        found = least_squares(value, u, slope, method=method, max_nfev=tries, xtol=1e-10)
        u = found.x
        away = abs(_traced(u[:9], parts(u), side)[0] - places)
        if away.max() < best.error:
            best = Fit(float(away.max()), u[:9].copy(), parts(u).copy(), side)
        elif number > 0:
            break
        power = min(2.0 * 2**number, POWER)
        weights = np.maximum(away / max(away.max(), 1e-300), 0.03) ** (power / 2 - 0.5)
    return best


def searched(task: FieldTask, scaled: Scaled, seconds: float, far: float) -> Iterator[Fit]:
    """Fits from the random cranks that lie best: a quarter of the time for drawing them."""
    begun, rng, laid = time.process_time(), np.random.default_rng(0), Laid(task, scaled)
    pool: list[tuple[float, np.ndarray, float, np.ndarray]] = []
    while time.process_time() - begun < 0.25 * seconds:
        shapes, side = drawn(rng, BATCH)
        window = rng.random((BATCH, laid.windows))
        error = laid.of(curves(shapes, side, laid.angles(window)))[0]
        best = np.argsort(error)[:60]
        pool += [(float(error[k]), shapes[k], float(side[k]), window[k]) for k in best]
        pool = sorted(pool, key=lambda each: each[0])[:600]
    found = []
    for _, shape, one, where in pool:
        if time.process_time() - begun > 0.75 * seconds:
            break
        fit = fitted(*laid.start(shape, one, where), one, laid, 1, 60)
        if np.isfinite(fit.error) and abs(fit.x).max() < far:
            found.append(fit)
    found.sort(key=lambda fit: (not fit.in_order(task), fit.error))
    for fit in found:
        if time.process_time() - begun > seconds:
            break
        yield fitted(fit.x, fit.angles, fit.side, laid, ROUNDS, 60)
