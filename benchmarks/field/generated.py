"""Tasks drawn at random, of every kind, from seeds: anybody has the same ones."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from benchmarks.field.known import dyads_of_five, given_pivots, solving
from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import EXACT, NO_LINKAGE, NOISE, FieldTask, Pivots
from benchmarks.field.tracer import branches, trace

Rng = np.random.Generator

FIVE = "five poses, exact"
MANY = "six poses or more, exact"
NOISY = "noisy poses"
PARALLEL = "near-parallelograms"
SMALL = "small rotations"
SLIDERS = "sliders"
DEFECTS = "the exact or closest linkage has a defect"
FEW = "three or four poses"
BOX = "ground pivots within limits"
GIVEN = "ground pivots given"
SMOOTH = "motions that no four-bar makes"
PATH = "paths: points without angles"
CLOSED, OPEN = "closed shapes", "open shapes"
TIMED = "paths timed by the crank"
FUNCTIONS = "functions"
KINDS = (FIVE, MANY, NOISY, PARALLEL, SMALL, SLIDERS, DEFECTS, FEW, BOX, GIVEN, SMOOTH, PATH)
KINDS += (CLOSED, OPEN, TIMED, FUNCTIONS)


def _point(rng: Rng, spread: float = 1.0) -> complex:
    return complex(*rng.normal(size=2)) * spread


def _four_bar(rng: Rng) -> FourBar:
    """Two links: pivots a few units apart, links from a third of that to twice it."""
    first, second = _point(rng, 2), _point(rng, 2)
    hands = _point(rng, 1.5), _point(rng, 1.5)
    lengths = rng.uniform(0.7, 4, 2)
    pairs = zip((first, second), hands, lengths, strict=True)
    return FourBar(*(Dyad("RR", fixed, hand, float(size)) for fixed, hand, size in pairs))


def _near_parallelogram(rng: Rng) -> FourBar:
    """Opposite links alike but for a hundredth or three: two branches nearly meet."""
    size, ground = rng.uniform(1, 2), rng.uniform(2, 4)
    first = Dyad("RR", 0j, _point(rng), float(size))
    along = np.exp(1j * rng.uniform(0, 2 * np.pi))
    off = 1 + rng.choice([-1, 1], 2) * rng.uniform(0.01, 0.03, 2)
    second = Dyad("RR", ground * along, first.moving + ground * off[0], float(size * off[1]))
    return FourBar(first, second)


def _slider(rng: Rng) -> FourBar:
    """A link and a slider on the ground, a link and a slot, or a slider and a slot."""
    link = Dyad("RR", _point(rng), _point(rng), float(rng.uniform(0.7, 2)))
    normal = float(rng.uniform(0, 2 * np.pi))
    rail = Dyad("PR", 0j, _point(rng), float(rng.normal()), normal)
    slot = Dyad("RP", _point(rng, 2), 0j, float(rng.normal()), float(rng.uniform(0, 2 * np.pi)))
    pairs = ((link, rail), (link, slot), (rail, slot))
    return FourBar(*pairs[int(rng.integers(3))])


def _motion(four_bar: FourBar, rng: Rng, count: int, share: tuple[float, float]) -> np.ndarray:
    """Poses (N, 3) one after the other on a branch, or none where it has no branch long enough."""
    stand_in = FieldTask("", "", "", np.array([[-3.0, -3, 0], [3, 3, 0]]), EXACT)
    found = [b for b in branches(four_bar.first, four_bar.second, stand_in) if len(b.at) > 60]
    if not found:
        return np.empty((0, 3))
    branch = found[int(rng.integers(len(found)))]
    low, high = branch.at[0], branch.at[-1]
    room = high - low
    begin, end = low + 0.08 * room, high - 0.08 * room
    used = (end - begin) * rng.uniform(*share)
    start = begin + (end - begin - used) * rng.uniform()
    steps = np.sort(rng.uniform(0.3, 1.7, count).cumsum())
    at = start + used * (steps - steps[0]) / (steps[-1] - steps[0])
    d, phi = branch.body(at)
    rows = np.column_stack([d.real, d.imag, np.unwrap(phi)])
    return rows if rng.random() < 0.5 else rows[::-1]


def _drawn(
    rng: Rng,
    make: Callable[[Rng], FourBar],
    count: int,
    share: tuple[float, float] = (0.3, 0.8),
    turn: tuple[float, float] = (0.5, 5.0),
) -> tuple[FourBar, np.ndarray]:
    """A linkage and poses of it, the body turning as much as asked (radians), none too close."""
    for _ in range(100_000):
        four_bar = make(rng)
        rows = _motion(four_bar, rng, count, share)
        if len(rows) < count or not turn[0] < np.ptp(rows[:, 2]) < turn[1]:
            continue
        span = np.hypot(*np.ptp(rows[:, :2], axis=0))
        apart = np.hypot(*np.diff(rows[:, :2], axis=0).T)
        if 0.5 < span < 12 and apart.min() > 0.1 * span / count:
            return four_bar, rows
    raise RuntimeError("no such linkage was drawn")


def _solved_by(task: FieldTask, four_bar: FourBar) -> bool:
    return trace(four_bar, task).in_order <= task.tolerance


def _exact(
    kind: str, seed: int, index: int, make: Callable[[Rng], FourBar], counts: tuple[int, ...], **how
) -> FieldTask:
    rng = np.random.default_rng([seed, KINDS.index(kind), index])
    name, source = f"{kind} {index + 1}", "generated"
    while True:
        four_bar, rows = _drawn(rng, make, counts[index % len(counts)], **how)
        task = FieldTask(name, kind, source, rows, EXACT, known=(four_bar,))
        if _solved_by(task, four_bar):
            return task


def five(seed: int, index: int) -> FieldTask:
    """Five poses of a linkage; all pairs of their dyads that work are known."""
    task = _exact(FIVE, seed, index, _four_bar, (5,))
    return replace(task, known=solving(task, dyads_of_five(task)))


def many(seed: int, index: int) -> FieldTask:
    return _exact(MANY, seed, index, _four_bar, (6, 8, 10, 12, 50))


def near_parallelogram(seed: int, index: int) -> FieldTask:
    return _exact(PARALLEL, seed, index, _near_parallelogram, (5, 8, 10), turn=(0.002, 5.0))


def small_rotation(seed: int, index: int) -> FieldTask:
    return _exact(SMALL, seed, index, _four_bar, (8, 10), turn=(0.03, 0.17), share=(0.1, 0.8))


def slider(seed: int, index: int) -> FieldTask:
    return _exact(SLIDERS, seed, index, _slider, (6, 8, 10))


def noisy(seed: int, index: int, kind: str = NOISY, noise: float | None = None) -> FieldTask:
    """Poses of a linkage with noise on x, y and angle, which the linkage still solves."""
    rng = np.random.default_rng([seed, KINDS.index(kind), index])
    size = (0.002, 0.005, 0.01)[index % 3] if noise is None else noise
    while True:
        four_bar, rows = _drawn(rng, _four_bar, (8, 10, 20, 60)[index % 4] if noise is None else 8)
        span = np.hypot(*np.ptp(rows[:, :2], axis=0))
        rows = rows + rng.normal(size=rows.shape) * size * np.array([span, span, 1.0])
        task = FieldTask(f"{kind} {index + 1}", kind, "generated", rows, NOISE * size)
        if _solved_by(task, four_bar):
            return task


def defect(seed: int, index: int) -> FieldTask:
    """Five poses of a smooth motion whose exact linkages all fail; or coarse noise on eight."""
    if index % 2:
        return noisy(seed, index, DEFECTS, 0.03)
    rng = np.random.default_rng([seed, KINDS.index(DEFECTS), index])
    while True:
        task = _smooth(rng, f"{DEFECTS} {index + 1}", DEFECTS, 5, NO_LINKAGE)
        dyads = dyads_of_five(task)
        exact = replace(task, tolerance=EXACT)
        if len(dyads) >= 2 and not solving(exact, dyads):
            return task


def _smooth(rng: Rng, name: str, kind: str, count: int, tolerance: float) -> FieldTask:
    """Poses along three harmonics, as a designer draws a motion: no linkage is behind it."""
    share = np.linspace(0, 1, count)
    waves = np.stack([share, np.sin(np.pi * share), np.sin(2 * np.pi * share) / 3], axis=1)
    size = rng.uniform(0.3, 1, (3, 3)) * rng.choice([-1, 1], (3, 3))
    size[1, 2] *= 0.3  # the angle goes one way
    size[2] *= (0.4, 0.4, 0.1)
    rows = waves @ size * [100, 100, 1.5]
    return FieldTask(name, kind, "generated", np.round(rows, 4), tolerance)


def smooth(seed: int, index: int) -> FieldTask:
    rng = np.random.default_rng([seed, KINDS.index(SMOOTH), index])
    return _smooth(rng, f"{SMOOTH} {index + 1}", SMOOTH, (6, 7, 8, 9)[index % 4], NO_LINKAGE)


def few(seed: int, index: int) -> FieldTask:
    rng = np.random.default_rng([seed, KINDS.index(FEW), index])
    return _smooth(rng, f"{FEW} {index + 1}", FEW, (3, 4)[index % 2], EXACT)


def box(seed: int, index: int) -> FieldTask:
    """Four poses, or eight with noise, and a box in which both ground pivots have to be."""
    rng = np.random.default_rng([seed, KINDS.index(BOX), index])
    count, size = ((4, 0.0), (8, 0.005))[index % 2]
    while True:
        four_bar, rows = _drawn(rng, _four_bar, count)
        span = np.hypot(*np.ptp(rows[:, :2], axis=0))
        rows = rows + rng.normal(size=rows.shape) * size * np.array([span, span, 1.0])
        a, b = four_bar.first.fixed, four_bar.second.fixed
        wide = 0.25 * span
        low = complex(min(a.real, b.real) - wide, min(a.imag, b.imag) - wide)
        high = complex(max(a.real, b.real) + wide, max(a.imag, b.imag) + wide)
        tolerance = NOISE * size if size else EXACT
        pivots = Pivots("box", (low, high))
        task = FieldTask(f"{BOX} {index + 1}", BOX, "generated", rows, tolerance, pivots)
        if _solved_by(task, four_bar):
            return task


def given(seed: int, index: int) -> FieldTask:
    """Three poses and both ground pivots, which one linkage has."""
    rng = np.random.default_rng([seed, KINDS.index(GIVEN), index])
    while True:
        four_bar, rows = _drawn(rng, _four_bar, 3)
        pivots = Pivots("points", (four_bar.first.fixed, four_bar.second.fixed))
        task = FieldTask(f"{GIVEN} {index + 1}", GIVEN, "generated", rows, EXACT, pivots)
        known = solving(task, given_pivots(task))
        if known:
            return replace(task, known=known)


def path(seed: int, index: int) -> FieldTask:
    """Five or nine points of a coupler curve."""
    task = _exact(PATH, seed, index, _four_bar, (5, 9, 5, 9))
    return replace(task, rows=task.rows[:, :2], known=())


MAKERS: dict[str, Callable[[int, int], FieldTask]] = {
    FIVE: five,
    MANY: many,
    NOISY: noisy,
    PARALLEL: near_parallelogram,
    SMALL: small_rotation,
    SLIDERS: slider,
    DEFECTS: defect,
    FEW: few,
    BOX: box,
    GIVEN: given,
    SMOOTH: smooth,
    PATH: path,
}


def generated(seed: int, count: int) -> Iterator[FieldTask]:
    """So many tasks of every kind, the first of each kind first."""
    for index in range(count):
        for make in MAKERS.values():
            yield make(seed, index)
