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
BATCH, BATCHES = 2000, 30
FITS, AGAIN = 400, 80  # cranks that are fitted, and again towards the least greatest distance
MOST_BULGE = 0.5  # of the step between points, by which a curve may leave the path
GAP = 9  # places from one point to the next, both included
REACH, BODY = 1.3, 2.5  # of the logarithms of lengths; of the coupler point, in couplers
TRIES = 60  # evaluations of a fit
ROUNDS, POWER = 4, 8  # towards the least greatest distance: the norm of that power
SHUT, STIFF = 0.995, 2.0  # the cosine beyond which a linkage opens, and what it costs
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

    def faults(self, task: FieldTask, scaled: Scaled) -> int:
        """How many of three it has: the crank turns back, it is open, the curve leaves the path."""
        angles, way = self.angles, scaled.places
        if task.closed:
            full = angles[0] + 2 * np.pi * np.sign(angles[-1] - angles[0])
            angles, way = np.append(angles, full), np.append(way, way[0])
        steps, chord = np.diff(angles), np.diff(way)
        back = not ((steps >= -1e-9).all() or (steps <= 1e-9).all())
        around = abs(steps.sum()) > 2 * np.pi + 1e-9
        between = angles[:-1, None] + steps[:, None] * np.linspace(0, 1, GAP)
        points, _, _, cosine = _traced(self.x, between.ravel(), self.side)
        along = (points.reshape(between.shape) - way[:-1, None]) / chord[:, None]
        bulge = abs(along - np.clip(along.real, 0, 1)).max()
        return sum(map(bool, (back or around, abs(cosine).max() >= 1, bulge > MOST_BULGE)))


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
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Coupler points (N,), their derivatives (N, 9) by the dimensions and (N,) by the angles.

    And the cosine between diagonal and coupler, beyond 1 where the linkage is open.
    """
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
    return pin + hand * turn, by_x, by_angle, cosine


def _openness(x: np.ndarray, angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """By how much a linkage opens at crank angles (K,), and the derivatives (K, 9) of that."""
    a, c, r = x[4:7]
    crank = np.exp(1j * angles)
    to = complex(x[2] - x[0], x[3] - x[1]) - a * crank
    length = np.maximum(abs(to), 1e-12)
    cosine = (c**2 + length**2 - r**2) / (2 * c * length)
    over = np.maximum(abs(cosine) - SHUT, 0)
    one, zero = np.ones_like(crank), np.zeros_like(crank)
    moves = np.stack([-one, -1j * one, one, 1j * one, -crank, *4 * [zero]], axis=1)
    slope = (np.conj(to)[:, None] * moves).real / length[:, None]
    slope *= (1 / c - cosine / length)[:, None]
    slope[:, 5], slope[:, 6] = 1 / length - cosine / c, -r / (c * length)
    return STIFF * over, STIFF * np.where(over > 0, np.sign(cosine), 0)[:, None] * slope


def of_shape(shape: np.ndarray, side: float, window: np.ndarray, laid: Laid) -> Fit:
    """A crank as it is laid over the path."""
    x, angles = laid.start(shape, side, window)
    away = _traced(x, angles, side)[0] - laid.scaled.places
    return Fit(float(abs(away).max()), x, angles, side)


def fitted(start: Fit, laid: Laid, rounds: int = ROUNDS) -> Fit:
    """All dimensions and crank angles by least squares; then the greatest distance made less."""
    from scipy.optimize import least_squares

    x, angles, side = start.x, start.angles, start.side
    places, turned = laid.scaled.places, laid.task.crank
    weights = np.ones(len(places))

    def parts(u: np.ndarray) -> np.ndarray:
        return u[9:] if turned is None else u[9] + turned

    def between(u: np.ndarray) -> np.ndarray:
        """Crank angles from the first point to the last, at even steps."""
        angles = parts(u)
        if laid.task.closed:
            angles = np.append(angles, angles[0] + 2 * np.pi * np.sign(angles[-1] - angles[0]))
        at = np.linspace(0, len(angles) - 1, STEPS)
        return np.interp(at, np.arange(len(angles)), angles)

    def value(u: np.ndarray) -> np.ndarray:
        away = weights * (_traced(u[:9], parts(u), side)[0] - places)
        return np.concatenate([away.real, away.imag, _openness(u[:9], between(u))[0]])

    def slope(u: np.ndarray) -> np.ndarray:
        _, by_x, by_angle, _ = _traced(u[:9], parts(u), side)
        last = np.diag(by_angle) if turned is None else by_angle[:, None]
        rows = weights[:, None] * np.concatenate([by_x, last], axis=1)
        kept = np.zeros((STEPS, len(u)))
        kept[:, :9] = _openness(u[:9], between(u))[1]
        return np.concatenate([rows.real, rows.imag, kept])

    u = np.concatenate([x, angles if turned is None else [angles[0] - turned[0]]])
    method = "lm" if 2 * len(places) >= len(u) else "trf"
    best = Fit(np.inf, x, angles, side)
    for number in range(rounds):
        found = least_squares(value, u, slope, method=method, max_nfev=TRIES, xtol=1e-10)
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
    """Fits from the random cranks that lie best over the path; the best of them fitted again."""
    begun, rng, laid = time.process_time(), np.random.default_rng(0), Laid(task, scaled)
    pool: list[tuple[float, np.ndarray, float, np.ndarray]] = []
    for _ in range(BATCHES):
        shapes, side = drawn(rng, BATCH)
        window = rng.random((BATCH, laid.windows))
        error = laid.of(curves(shapes, side, laid.angles(window)))[0]
        best = np.argsort(error)[:FITS]
        pool += [(float(error[k]), shapes[k], float(side[k]), window[k]) for k in best]
        pool = sorted(pool, key=lambda each: each[0])[:FITS]
        if time.process_time() - begun > 0.3 * seconds:
            break
    found = []
    for _, shape, one, where in pool:
        if time.process_time() - begun > 0.75 * seconds:
            break
        fit = fitted(of_shape(shape, one, where, laid), laid, 1)
        if np.isfinite(fit.error) and abs(fit.x).max() < far:
            found.append(fit)
    found.sort(key=lambda fit: (fit.faults(task, scaled), fit.error))
    for number, fit in enumerate(found):
        if number < AGAIN and time.process_time() - begun < seconds:
            yield fitted(fit, laid)
        else:
            yield fit
