"""Linkages that solve a task, by Newton's method from many starts."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask
from benchmarks.field.tracer import trace

STARTS = 4000
ROUNDS = 40
FOUND = 1e-10  # of the span: what the equations leave, where a dyad is found
SAME = 1e-6  # of the span: two ends of Newton's method that are one dyad
FAR = 100.0  # spans: farther pivots are left out, here and of what is asked for


def dyads_of_five(task: FieldTask, seed: int = 0) -> list[Dyad]:
    """The RR dyads of five poses, at most four: every real solution that the starts lead to.

    Unknowns are both pivots; the squared length at each pose less that at the first one is four
    equations, quadratic in them.
    """
    rng = np.random.default_rng(seed)
    centre, scale = task.places.mean(), task.span
    places, turn = (task.places - centre) / scale, np.exp(1j * task.angles)
    spread = 10 ** rng.uniform(-1, 1, (STARTS, 2))
    x = (rng.normal(size=(STARTS, 4)) * np.repeat(spread, 2, axis=1)).astype(float)
    for _ in range(ROUNDS):
        value, slope = _equations(x, places, turn)
        with np.errstate(all="ignore"):
            scaled = slope / np.linalg.norm(slope, axis=2, keepdims=True)
            good = np.abs(np.linalg.det(scaled)) > 1e-14
        x, value, slope = x[good], value[good], slope[good]
        x = x - np.linalg.solve(slope, value[..., None])[..., 0]
        x = x[np.abs(x).max(axis=1) < 1e6]
    value, _ = _equations(x, places, turn)
    size = 1 + (x**2).sum(axis=1)
    found: list[np.ndarray] = []
    for row in x[np.abs(value).max(axis=1) / size < FOUND]:
        new = all(np.abs(row - other).max() > SAME * size_of(row) for other in found)
        if new and np.abs(row).max() < FAR:
            found.append(row)
    out = []
    for a, b, c, d in found:
        fixed, moving = centre + scale * complex(a, b), scale * complex(c, d)
        reach = abs(task.places + turn * moving - fixed)
        out.append(Dyad("RR", fixed, moving, float(reach.mean())))
    return sorted(out, key=lambda dyad: (dyad.fixed.real, dyad.fixed.imag))


def size_of(row: np.ndarray) -> float:
    """How large the unknowns are, one or more."""
    return 1 + float(np.abs(row).max())


def _equations(
    x: np.ndarray, places: np.ndarray, turn: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Four equations (S, 4) and their derivatives (S, 4, 4) by both pivots."""
    fixed, moving = x[:, 0] + 1j * x[:, 1], x[:, 2] + 1j * x[:, 3]
    to = places + turn * moving[:, None] - fixed[:, None]
    square = abs(to) ** 2
    by_moving = 2 * np.conj(to) * turn  # Re of it by the real part, -Im by the imaginary one
    by_fixed = -2 * to
    all_of = np.stack([by_fixed.real, by_fixed.imag, by_moving.real, -by_moving.imag], axis=-1)
    return square[:, 1:] - square[:, :1], all_of[:, 1:] - all_of[:, :1]


def solving(task: FieldTask, dyads: list[Dyad]) -> tuple[FourBar, ...]:
    """The pairs of dyads that solve a task: the tracer says so."""
    pairs = (FourBar(*pair) for pair in combinations(dyads, 2))
    return tuple(pair for pair in pairs if trace(pair, task).in_order <= task.tolerance)


def given_pivots(task: FieldTask) -> list[Dyad]:
    """The dyads of three poses with given ground pivots: centres of circles, seen from the body."""
    assert task.pivots is not None
    out = []
    for fixed in task.pivots.places:
        seen = (fixed - task.places) * np.exp(-1j * task.angles)
        rows = np.column_stack([2 * seen.real, 2 * seen.imag, np.ones(len(seen))])
        x, y, _ = np.linalg.solve(rows, abs(seen) ** 2)
        moving = complex(x, y)
        out.append(Dyad("RR", fixed, moving, float(abs(seen[0] - moving))))
    return out
