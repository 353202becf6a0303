"""SciPy's differential evolution on whole linkages, then least squares from where it ends."""

from __future__ import annotations

import time

import numpy as np

from benchmarks.field.linkage import FourBar, Kind
from benchmarks.field.task import DISC, FieldTask
from benchmarks.field.tools import generators
from benchmarks.field.tools.closure import Free, Scaled, pose_errors, runs_well
from benchmarks.field.tools.coupler_curves import (
    REACH,
    Fit,
    Laid,
    curves,
    fitted,
    is_dense,
    of_shape,
)
from benchmarks.field.tools.scipy_starts import path_fit, path_polished

TITLE = "SciPy differential evolution"
PACKAGE = "scipy"
CALLED = (
    "Poses: `differential_evolution` on the whole linkage, driven from pose to pose.",
    "It has penalties where a linkage opens or its crank turns back; up to six runs.",
    "Ground pivots are within 3 spans; strategy `currenttobest1bin`, 20 members a parameter.",
    "Each end is made better by `least_squares`.",
    "Paths of up to nine points: on the curve of a turning crank in 120 steps.",
    "Other paths: on the shape of the crank, its curve laid over the path, then fitted as above.",
    'Functions: on the greatest error, then `minimize(method="SLSQP")`.',
)
GROUND, BODY = 3.0, 2.5  # spans: how far pivots are looked for
RUNS: tuple[Kind, ...] = ("RR", "RR", "RP", "PR", "RR", "RR")
MEMBERS, GENERATIONS = 20, 600
BETWEEN = 3  # places between poses at which it has to hold together
DENSE_RUNS, FUNCTION_RUNS = 12, 8
STEPS = 120  # of a crank that draws a path
DONE = 1e-9


def refuses(task: FieldTask) -> str | None:
    return None


def solve(task: FieldTask, seconds: float) -> list[FourBar]:
    if task.is_function:
        return _functions(task, seconds)
    if is_dense(task):
        return _dense(task, seconds)
    return _paths(task, seconds) if task.is_path else _guides(task, seconds)


def _bounds(kind: Kind, scaled: Scaled, which: int) -> tuple[Free, np.ndarray, np.ndarray]:
    """The free parameters of a dyad without its length or offset, which the poses tell."""
    free = Free(kind, scaled.pivots, which)
    drop = 4 if kind == "RR" else 1
    keep = [k for k in range(len(free.ways)) if free.ways[k, drop] == 0]
    free.ways, free.low, free.high = free.ways[keep], free.low[keep], free.high[keep]
    reach = np.array(
        {"RR": [GROUND] * 2 + [BODY] * 2 + [0], "PR": [np.pi, 0, BODY, BODY]}.get(
            kind, [np.pi, 0, GROUND, GROUND]
        )
    )
    wide = abs(free.ways) @ reach
    wide = np.where(abs(free.ways).sum(axis=1) > 0, wide, 1.0)
    low = np.where(np.isfinite(free.low), free.low, -wide)
    high = np.where(np.isfinite(free.high), free.high, wide)
    if scaled.pivots is not None and scaled.pivots.kind == "line":
        a, b = scaled.pivots.places
        foot = (-a * np.conj(b - a)).real / abs(b - a) ** 2
        low[0], high[0] = foot - GROUND / abs(b - a), foot + GROUND / abs(b - a)
    return free, low, high


def _run(cost, low: np.ndarray, high: np.ndarray, seed: int, until: float) -> np.ndarray:
    from scipy.optimize import differential_evolution

    def late(*_: object, **__: object) -> bool:
        return time.process_time() > until

    found = differential_evolution(
        lambda columns: cost(columns.T),
        list(zip(low, high, strict=True)),
        strategy="currenttobest1bin",
        mutation=(0.4, 0.9),
        recombination=0.9,
        popsize=MEMBERS,
        maxiter=GENERATIONS,
        tol=1e-8,
        rng=seed,
        polish=False,
        vectorized=True,
        updating="deferred",
        callback=late,
    )
    return found.x


def _with_lengths(
    kind: Kind, x: np.ndarray, scaled: Scaled
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Parameters (S, *) with the mean length or offset at the poses; two points of the dyad.

    For a link and a slider the pin at the poses (S, N), and the ground pivot.
    """
    d, turn = scaled.places, scaled.turn
    x = x.copy()
    if kind == "RR":
        pin = d + turn * (x[:, 2] + 1j * x[:, 3])[:, None]
        fixed = (x[:, 0] + 1j * x[:, 1])[:, None]
        x[:, 4] = abs(pin - fixed).mean(axis=1)
        return x, pin, fixed
    point = (x[:, 2] + 1j * x[:, 3])[:, None]
    normal = np.exp(1j * x[:, :1])
    pin = d + turn * point
    if kind == "PR":
        x[:, 1] = (np.conj(normal) * pin).real.mean(axis=1)
    else:
        x[:, 1] = (np.conj(normal * turn) * (point - d)).real.mean(axis=1)
    return x, pin, point


def _closed(
    kind: Kind, y: np.ndarray, pins: np.ndarray, hand: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Re(z exp(i phi)) = e for the body's angle, at crank pins (S, K) that hold its point."""
    point = (y[:, 2] + 1j * y[:, 3])[:, None]
    if kind == "RR":
        to, arm = pins - (y[:, 0] + 1j * y[:, 1])[:, None], point - hand
        return np.conj(to) * arm, (y[:, 4:] ** 2 - abs(to) ** 2 - abs(arm) ** 2) / 2
    normal = np.exp(1j * y[:, :1])
    if kind == "PR":
        z = np.conj(normal) * (point - hand) + 0 * pins
        return z, y[:, 1:2] - (np.conj(normal) * pins).real
    return np.conj(point - pins) * normal, y[:, 1:2] - (np.conj(normal) * hand).real + 0 * pins.real


def _cost(kind: Kind, x: np.ndarray, y: np.ndarray, scaled: Scaled) -> np.ndarray:
    """What is to be least (S,), of cranks x (S, 5) and other dyads y (S, *)."""
    x, pin, fixed = _with_lengths("RR", x, scaled)
    y, _, _ = _with_lengths(kind, y, scaled)
    hand = (x[:, 2] + 1j * x[:, 3])[:, None]
    crank = np.angle(pin - fixed)
    step = (np.diff(crank, axis=1) + np.pi) % (2 * np.pi) - np.pi
    back = np.minimum(np.maximum(step, 0).sum(axis=1), np.maximum(-step, 0).sum(axis=1))
    share = np.arange(1, BETWEEN + 1) / (BETWEEN + 1)
    middle = (crank[:, :-1, None] + step[..., None] * share).reshape(len(x), -1)
    everywhere = fixed + x[:, 4:] * np.exp(1j * np.concatenate([crank, middle], axis=1))
    z, e = _closed(kind, y, everywhere, hand)
    cosine = e / np.maximum(abs(z), 1e-12)
    beyond = np.minimum(np.maximum(abs(cosine) - 1, 0), 10)
    count = crank.shape[1]
    opening = np.arccos(np.clip(cosine[:, :count], -1, 1))
    base, held = -np.angle(z[:, :count]), everywhere[:, :count]
    best = np.full(len(x), np.inf)
    for side in (opening, -opening):
        turn = np.exp(1j * (base + side))
        away = abs(held - turn * hand - scaled.places) ** 2
        best = np.minimum(best, (away + DISC**2 * abs(turn - scaled.turn) ** 2).sum(axis=1))
    return best + (beyond**2).sum(axis=1) + back**2


def _guides(task: FieldTask, seconds: float) -> list[FourBar]:
    from scipy.optimize import least_squares

    begun, scaled = time.process_time(), Scaled(task)
    until = begun + 0.85 * seconds
    others = [kind for kind in RUNS if kind != "PR" or scaled.pivots is None]
    found: list[tuple[bool, float, FourBar]] = []
    for seed, kind in enumerate(others):
        if time.process_time() > until:
            break
        one, low, high = _bounds("RR", scaled, 0)
        two, low2, high2 = _bounds(kind, scaled, 1)
        cut, kinds = len(low), ("RR", kind)
        u = _run(
            lambda v, kind=kind, one=one, two=two, cut=cut: _cost(
                kind, one.full(v[:, :cut]), two.full(v[:, cut:]), scaled
            ),
            np.concatenate([low, low2]),
            np.concatenate([high, high2]),
            seed,
            until,
        )
        x = _with_lengths("RR", one.full(u[None, :cut]), scaled)[0][0]
        y = _with_lengths(kind, two.full(u[None, cut:]), scaled)[0][0]
        free = (Free("RR", scaled.pivots, 0), Free(kind, scaled.pivots, 1))
        size = len(free[0].ways)

        def full(v: np.ndarray, free=free, size=size) -> np.ndarray:
            return np.concatenate([free[0].full(v[:size]), free[1].full(v[size:])])

        ends = [np.concatenate([x, y])]
        better = least_squares(
            lambda v, kinds=kinds, full=full: pose_errors(kinds, full(v), scaled),
            np.concatenate([free[0].inside(x), free[1].inside(y)]),
            bounds=[
                np.concatenate([each.low for each in free]),
                np.concatenate([each.high for each in free]),
            ],
            max_nfev=100,
            xtol=1e-12,
            ftol=1e-12,
        )
        ends.append(full(better.x))
        for z in ends:
            cost = float((pose_errors(kinds, z, scaled) ** 2).sum())
            found.append((not runs_well(kinds, z, scaled), cost, scaled.four_bar(kinds, z)))
        if min(each[:2] for each in found) <= (False, DONE**2):
            break
    found.sort(key=lambda each: each[:2])
    return [four_bar for _, _, four_bar in found]


def _drawn(v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Cranks and rockers (S, 5) of paths: the moving pivot of the crank is on the x axis of M."""
    zero = np.zeros(len(v))
    x = np.stack([v[:, 0], v[:, 1], v[:, 4], zero, v[:, 7]], axis=1)
    y = np.stack([v[:, 2], v[:, 3], v[:, 5], v[:, 6], v[:, 8]], axis=1)
    hand = v[:, 4:5] + 0j
    crank = np.linspace(0, 2 * np.pi, STEPS, endpoint=False)
    pins = (x[:, 0] + 1j * x[:, 1])[:, None] + x[:, 4:] * np.exp(1j * crank)
    z, e = _closed("RR", y, pins, hand)
    cosine = e / np.maximum(abs(z), 1e-12)
    opening = np.where(abs(cosine) <= 1, np.arccos(np.clip(cosine, -1, 1)), np.nan)
    phi = -np.angle(z) + np.stack([opening, -opening])
    return x, y, phi, pins - np.exp(1j * phi) * hand


def _nearest(points: np.ndarray, scaled: Scaled) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For curves (2, S, K) the cost (2, S), the step nearest to each point, and its distance."""
    away = abs(points[..., None] - scaled.places)
    away = np.where(np.isfinite(away), away, 10.0)
    where = away.argmin(axis=2)
    least = np.take_along_axis(away, where[:, :, None], axis=2)[:, :, 0]
    step = (np.diff(where, axis=-1) + STEPS // 2) % STEPS - STEPS // 2
    back = np.minimum(np.maximum(step, 0).sum(axis=-1), np.maximum(-step, 0).sum(axis=-1)) / STEPS
    return (least**2).sum(axis=-1) + back**2, where, least


def _paths(task: FieldTask, seconds: float) -> list[FourBar]:
    begun, scaled = time.process_time(), Scaled(task)
    until = begun + 0.7 * seconds
    low = np.array([-GROUND] * 4 + [0.0] + [-BODY] * 2 + [0.02] * 2)
    high = np.array([GROUND] * 4 + [BODY] * 3 + [GROUND] * 2)
    given = None
    if scaled.pivots is not None:
        a, b = scaled.pivots.places
        given = np.array([a.real, a.imag, b.real, b.imag])
        low[:4], high[:4] = given - 1e-12, given + 1e-12
    free = (Free("RR", scaled.pivots, 0), Free("RR", scaled.pivots, 1))
    found: list[tuple[bool, float, FourBar]] = []
    for seed in range(1000):
        if time.process_time() > until:
            break
        v = _run(lambda w: _nearest(_drawn(w)[3], scaled)[0].min(axis=0), low, high, seed, until)
        x, y, phi, points = _drawn(v[None])
        cost, where, _ = _nearest(points, scaled)
        side = int(cost[:, 0].argmin())
        angles = np.nan_to_num(phi[side, 0][where[side, 0]])
        z = np.concatenate([x[0], y[0]])
        scaled.angles, scaled.turn = angles, np.exp(1j * angles)
        four_bars = [(float(cost.min()) ** 0.5, z, angles)]
        fitted = path_fit(z, angles, scaled, free)
        four_bars += [fitted, path_polished(fitted[1], fitted[2], scaled, free)]
        for error, end, turned in four_bars:
            scaled.angles, scaled.turn = turned, np.exp(1j * turned)
            well = runs_well(("RR", "RR"), end, scaled)
            found.append((not well, error, scaled.four_bar(("RR", "RR"), end)))
        if min(each[:2] for each in found) <= (False, DONE):
            break
    found.sort(key=lambda each: each[:2])
    return [four_bar for _, _, four_bar in found]


def _dense(task: FieldTask, seconds: float) -> list[FourBar]:
    """The shape of a crank whose curve lies best over the path, run after run; then all fitted."""
    begun, scaled = time.process_time(), Scaled(task)
    laid, until = Laid(task, scaled), begun + 0.8 * seconds
    low = np.array([-REACH] * 3 + [-BODY] * 2 + [0.0] * laid.windows)
    high = np.array([REACH] * 3 + [BODY] * 2 + [1.0] * laid.windows)
    found: list[Fit] = []
    for seed in range(DENSE_RUNS):
        if time.process_time() > until:
            break
        side = (-1.0) ** seed

        def cost(v: np.ndarray, side: float = side) -> np.ndarray:
            points = curves(v[:, :5], np.full(len(v), side), laid.angles(v[:, 5:]))
            return laid.of(points)[0]

        v = _run(cost, low, high, seed, until)
        start = of_shape(v[:5], side, v[5:], laid)
        found += [fitted(start, laid, 1), fitted(start, laid)]
    found = [fit for fit in found if np.isfinite(fit.x).all()]
    found.sort(key=lambda fit: (fit.faults(task, scaled), fit.error))
    return [fit.four_bar(scaled) for fit in found]


def _functions(task: FieldTask, seconds: float) -> list[FourBar]:
    """The greatest error of the output, its zero the best, over lengths and the input's zero."""
    begun, pairs = time.process_time(), task.rows
    until = begun + 0.8 * seconds
    found: list[tuple[float, FourBar]] = []
    for seed in range(FUNCTION_RUNS):
        if time.process_time() > until:
            break
        side = (-1.0) ** seed

        def cost(v: np.ndarray, side: float = side) -> np.ndarray:
            output, cosine, _, _ = generators.made(v, side, pairs[:, 0])
            beyond = np.maximum(abs(cosine) - 1, 0).sum(axis=1)
            return np.ptp(output - pairs[:, 1], axis=1) + beyond

        v = _run(cost, np.array([-2.0] * 3 + [-np.pi]), np.array([2.0] * 3 + [np.pi]), seed, until)
        off = generators.made(v, side, pairs[:, 0])[0] - pairs[:, 1]
        v = np.append(v, (off.max() + off.min()) / 2)
        error, better = generators.minimax(v, side, pairs)
        found.append((error, generators.four_bar(better)))
    found.sort(key=lambda each: each[0])
    return [four_bar for _, four_bar in found]
