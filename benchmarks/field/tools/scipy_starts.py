"""SciPy's least squares from many random starts: each dyad, then pairs of them as linkages."""

from __future__ import annotations

import time
from itertools import combinations

import numpy as np

from benchmarks.field.linkage import FourBar, Kind
from benchmarks.field.task import FieldTask
from benchmarks.field.tools import generators
from benchmarks.field.tools.closure import (
    Free,
    Scaled,
    by_parameters,
    equation,
    point_errors,
    pose_errors,
    runs_well,
)
from benchmarks.field.tools.coupler_curves import is_dense, searched

TITLE = "SciPy least squares, many starts"
PACKAGE = "scipy"
CALLED = (
    "Poses: `least_squares` on each dyad's closure, with exact derivatives, from 280 starts.",
    "Then on the pose errors of each pair of the best dyads; limits as bounds or fewer unknowns.",
    "Paths of up to nine points: on both closures, the angles unknown too, from 500 starts.",
    "Other paths: 60,000 random cranks are laid over the path, closed ones by Fourier transform.",
    "The best 400 are fitted, all dimensions and crank angles at once, with exact derivatives.",
    "The best 80 of these again, with weights towards the least greatest distance.",
    "Functions: on the output's error, from 400 random linkages.",
    'Then `minimize(method="SLSQP")` on the greatest error of the best 50.',
    "Linkages that run through the poses in order come first.",
)
STARTS: dict[Kind, int] = {"RR": 200, "PR": 40, "RP": 40}
KEPT: dict[Kind, int] = {"RR": 9, "PR": 2, "RP": 2}
FAMILY = 36  # dyads kept where poses or limits leave infinitely many
FAR = 100.0  # spans
EXACT = 1e-10
ANSWERS = 50
PATH_STARTS = 500
FUNCTION_STARTS = 400


def refuses(task: FieldTask) -> str | None:
    return None


def solve(task: FieldTask, seconds: float) -> list[FourBar]:
    if task.is_function:
        return _functions(task, seconds)
    return _paths(task, seconds) if task.is_path else _guides(task, seconds)


def _start(kind: Kind, rng: np.random.Generator, scaled: Scaled) -> np.ndarray:
    spread = 10 ** rng.uniform(-0.5, 0.7)
    fixed, moving = (spread * complex(*rng.normal(size=2)) for _ in range(2))
    arms = scaled.places + scaled.turn * moving
    if kind == "RR":
        reach = float(abs(arms - fixed).mean())
        return np.array([fixed.real, fixed.imag, moving.real, moving.imag, reach])
    angle = rng.uniform(0, np.pi)
    if kind == "PR":
        offset = (np.exp(-1j * angle) * arms).real.mean()
        return np.array([angle, offset, moving.real, moving.imag])
    offset = (np.conj(scaled.turn * np.exp(1j * angle)) * (fixed - scaled.places)).real.mean()
    return np.array([angle, offset, fixed.real, fixed.imag])


def _fitted(kind: Kind, x: np.ndarray, scaled: Scaled, free: Free) -> tuple[float, np.ndarray]:
    """A dyad's rms closure error over the poses, a local minimum, and its parameters."""
    from scipy.optimize import least_squares

    many = len(scaled.places) >= len(free.ways) and not free.bounded
    found = least_squares(
        lambda u: equation(kind, free.full(u), scaled.places, scaled.turn)[0],
        free.inside(x),
        lambda u: by_parameters(kind, free.full(u), scaled.places, scaled.turn) @ free.ways.T,
        method="lm" if many else "trf",
        **({} if many else {"bounds": (free.low, free.high)}),
        xtol=1e-14,
        ftol=1e-14,
        gtol=1e-14,
        max_nfev=300,
    )
    return float(np.sqrt(np.mean(found.fun**2))), free.full(found.x)


def _dyads(
    scaled: Scaled, which: int, until: float, rng: np.random.Generator
) -> list[tuple[float, Kind, np.ndarray]]:
    """The best distinct dyads that the starts lead to."""
    kinds: list[Kind] = ["RR", "PR", "RP"] if scaled.pivots is None else ["RR", "RP"]
    out: list[tuple[float, Kind, np.ndarray]] = []
    for kind in kinds:
        free = Free(kind, scaled.pivots, which)
        family = len(scaled.places) < len(free.ways)
        found: list[tuple[float, np.ndarray]] = []
        for _ in range(STARTS[kind]):
            if time.process_time() > until:
                break
            error, x = _fitted(kind, _start(kind, rng, scaled), scaled, free)
            if np.isfinite(x).all() and abs(x).max() < FAR:
                found.append((error, x))
        if family:  # any of infinitely many; a stable sort keeps their random order
            found.sort(key=lambda each: each[0] > EXACT)
        else:
            found.sort(key=lambda each: each[0])
        kept: list[tuple[float, np.ndarray]] = []
        for error, x in found:
            if len(kept) == (FAMILY if family and kind == "RR" else KEPT[kind]):
                break
            if all(not _alike(kind, x, other) for _, other in kept):
                kept.append((error, x))
        out += [(error, kind, x) for error, x in kept]
    return out


def _alike(kind: Kind, x: np.ndarray, y: np.ndarray) -> bool:
    if kind != "RR":
        # A line has two normals.
        turned = np.round((x[0] - y[0]) / np.pi)
        y = np.array([y[0] + turned * np.pi, y[1] * (-1) ** int(turned), y[2], y[3]])
    return bool(abs(x - y).max() < 1e-4 * (1 + abs(x).max()))


def _guides(task: FieldTask, seconds: float) -> list[FourBar]:
    from scipy.optimize import least_squares

    begun, rng = time.process_time(), np.random.default_rng(0)
    scaled = Scaled(task)
    two = scaled.pivots is not None and scaled.pivots.kind == "points"
    half = begun + 0.4 * seconds
    first = _dyads(scaled, 0, begun + 0.2 * seconds if two else half, rng)
    if two:
        second = _dyads(scaled, 1, half, rng)
        pairs = [(a, b) for a in first for b in second]
    else:
        pairs = list(combinations(first, 2))
    pairs.sort(key=lambda pair: max(pair[0][0], pair[1][0]))
    found: list[tuple[bool, float, FourBar]] = []
    for (e, kind, x), (f, other, y) in pairs:
        if time.process_time() - begun > 0.75 * seconds:
            break
        kinds, free = (kind, other), [Free(kind, scaled.pivots), Free(other, scaled.pivots, two)]
        z = np.concatenate([x, y])
        cut = len(free[0].ways)

        def full(u: np.ndarray, free: list[Free] = free, cut: int = cut) -> np.ndarray:
            return np.concatenate([free[0].full(u[:cut]), free[1].full(u[cut:])])

        cost = float((pose_errors(kinds, z, scaled) ** 2).sum())
        if max(e, f) > EXACT:
            low = np.concatenate([each.low for each in free])
            high = np.concatenate([each.high for each in free])
            begin = np.concatenate([free[0].inside(x), free[1].inside(y)])
            plain = not np.isfinite(low).any() and 3 * len(task.rows) >= len(begin)
            better = least_squares(
                lambda u, kinds=kinds, full=full: pose_errors(kinds, full(u), scaled),
                begin,
                method="lm" if plain else "trf",
                **({} if plain else {"bounds": (low, high)}),
                max_nfev=60 * (len(begin) + 1 if plain else 1),
            )
            if 2 * better.cost < cost:
                cost, z = 2 * better.cost, full(better.x)
        if kind == other and _alike(kind, z[: len(x)], z[len(x) :]):
            continue  # both dyads became one
        well = runs_well(kinds, z, scaled)
        found.append((not well, cost, scaled.four_bar(kinds, z)))
    found.sort(key=lambda each: each[:2])
    return [four_bar for _, _, four_bar in found[:ANSWERS]]


def path_fit(
    z: np.ndarray, angles: np.ndarray, scaled: Scaled, free: tuple[Free, Free], rounds: int = 200
) -> tuple[float, np.ndarray, np.ndarray]:
    """Two links whose closure at the points of a path is best; the body's angles are free.

    Returns the greatest closure error, the parameters (10,) and the angles (N,).
    """
    from scipy.optimize import least_squares

    count, cut = len(scaled.places), len(free[0].ways)
    size = cut + len(free[1].ways)

    def parts(u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        angle = np.concatenate([angles[:1], u[size:]])
        return free[0].full(u[:cut]), free[1].full(u[cut:size]), angle

    def value(u: np.ndarray) -> np.ndarray:
        x, y, angle = parts(u)
        turn = np.exp(1j * angle)
        at = scaled.places
        return np.concatenate([equation("RR", x, at, turn)[0], equation("RR", y, at, turn)[0]])

    def slope(u: np.ndarray) -> np.ndarray:
        x, y, angle = parts(u)
        turn = np.exp(1j * angle)
        out = np.zeros((2 * count, len(u)))
        for k, (part, one) in enumerate(((x, free[0]), (y, free[1]))):
            rows = slice(k * count, (k + 1) * count)
            columns = slice(0, cut) if k == 0 else slice(cut, size)
            out[rows, columns] = by_parameters("RR", part, scaled.places, turn) @ one.ways.T
            by_angle = equation("RR", part, scaled.places, turn)[1][:, 2]
            out[rows, size:] = np.diag(by_angle)[:, 1:]
        return out

    begin = np.concatenate([free[0].inside(z[:5]), free[1].inside(z[5:]), angles[1:]])
    plain = 2 * count >= len(begin)
    found = least_squares(value, begin, slope, method="lm" if plain else "trf", max_nfev=rounds)
    x, y, angle = parts(found.x)
    return float(abs(found.fun).max()), np.concatenate([x, y]), angle


def path_polished(
    z: np.ndarray, angles: np.ndarray, scaled: Scaled, free: tuple[Free, Free]
) -> tuple[float, np.ndarray, np.ndarray]:
    """The same by the distance of the points: the greatest one, parameters and angles."""
    from scipy.optimize import least_squares

    cut = len(free[0].ways)
    size = cut + len(free[1].ways)

    def parts(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        x = np.concatenate([free[0].full(u[:cut]), free[1].full(u[cut:size])])
        return x, np.concatenate([angles[:1], u[size:]])

    begin = np.concatenate([free[0].inside(z[:5]), free[1].inside(z[5:]), angles[1:]])
    found = least_squares(lambda u: point_errors(*parts(u), scaled), begin, max_nfev=60)
    x, angle = parts(found.x)
    away = found.fun[: len(angles)] + 1j * found.fun[len(angles) :]
    return float(abs(away).max()), x, angle


def _functions(task: FieldTask, seconds: float) -> list[FourBar]:
    """Least squares from random linkages, then the best ones by SLSQP."""
    from scipy.optimize import least_squares

    begun, rng = time.process_time(), np.random.default_rng(0)
    found: list[tuple[float, np.ndarray, float]] = []
    for _ in range(FUNCTION_STARTS):
        if time.process_time() - begun > 0.6 * seconds:
            break
        side = float(rng.choice([-1, 1]))
        end = least_squares(
            generators.errors,
            generators.start(rng, side, task.rows),
            generators.by_parameters,
            args=(side, task.rows),
            method="lm",
            max_nfev=200,
        )
        if all(abs(end.x - other).max() > 1e-5 for _, other, _ in found):
            found.append((float(end.cost), end.x, side))
    found.sort(key=lambda each: each[0])
    out: list[tuple[float, FourBar]] = []
    for _, v, side in found[:ANSWERS]:
        if time.process_time() - begun > 0.85 * seconds:
            break
        error, better = generators.minimax(v, side, task.rows)
        out.append((error, generators.four_bar(better)))
    out.sort(key=lambda each: each[0])
    return [four_bar for _, four_bar in out]


def _paths(task: FieldTask, seconds: float) -> list[FourBar]:
    if is_dense(task):
        scaled = Scaled(task)
        fits = list(searched(task, scaled, 0.85 * seconds, FAR))
        fits.sort(key=lambda fit: (fit.faults(task, scaled), fit.error))
        return [fit.four_bar(scaled) for fit in fits[:ANSWERS]]
    begun, rng = time.process_time(), np.random.default_rng(0)
    scaled, count = Scaled(task), len(task.rows)
    free = (Free("RR", scaled.pivots, 0), Free("RR", scaled.pivots, 1))
    found: list[tuple[float, np.ndarray, np.ndarray]] = []
    for _ in range(PATH_STARTS):
        if time.process_time() - begun > 0.5 * seconds:
            break
        share = np.linspace(0, 1, count)
        wave = rng.normal() * 0.5 * np.sin(np.pi * share)
        angles = rng.normal() * 1.5 * share + wave
        scaled.angles, scaled.turn = angles, np.exp(1j * angles)
        z = np.concatenate([_start("RR", rng, scaled) for _ in range(2)])
        error, z, angles = path_fit(z, angles, scaled, free)
        if abs(z).max() < FAR:
            found.append((error, z, angles))
    found.sort(key=lambda each: each[0])
    out: list[tuple[bool, float, FourBar]] = []
    for fitted in found[: 4 * ANSWERS]:
        if time.process_time() - begun > 0.85 * seconds:
            break
        exact = fitted[0] <= EXACT
        error, z, angles = fitted if exact else path_polished(*fitted[1:], scaled, free)
        scaled.angles, scaled.turn = angles, np.exp(1j * angles)
        well = runs_well(("RR", "RR"), z, scaled)
        out.append((not well, error, scaled.four_bar(("RR", "RR"), z)))
    out.sort(key=lambda each: each[:2])
    return [four_bar for _, _, four_bar in out[:ANSWERS]]
