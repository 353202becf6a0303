"""Links that exist, placed at the phases that fit a task best.

A linkage whose lengths are known has up to two phases and a side left.  The output phase that is
best follows from the errors in closed form; the input phase is looked for on a grid, and then on
finer ones around its best places.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.functions.generator import Generator
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.tasks.function_task import FunctionTask

GRID: Final = 1440  # input phases in a turn
KEPT: Final = 8  # places of the grid that are looked at closer
FINER: Final = 41  # places of each finer grid, over two steps of the one before
LEVELS: Final = 7  # of finer grids; each is 20 times as fine


def placed_links(
    input_link: float, coupler: float, output_link: float, task: FunctionTask, side: float | None
) -> Generator:
    """The generator with links in ground links, at the given phases of a task or at the best.

    Best is the least sum of squared structural errors, or the least greatest one for `minimax`; an
    input at which the linkage is open counts as half a turn.
    side: 1 or -1; None: the better one.
    """
    sides = np.array([1.0, -1.0] if side is None else [side])
    if task.input_phase is not None:
        phases = np.repeat(task.input_phase, len(sides))
        return _best(*_placed((input_link, coupler, output_link), phases, sides, task))
    grid = np.arange(GRID) * 2 * np.pi / GRID
    phases, every = np.tile(grid, len(sides)), np.repeat(sides, GRID)
    step = 2 * np.pi / GRID
    for _ in range(LEVELS):
        found, cost = _placed((input_link, coupler, output_link), phases, every, task)
        near = np.argsort(cost, kind="stable")[:KEPT]
        around = np.linspace(-step, step, FINER)
        phases = (phases[near, None] + around).ravel()
        every = np.repeat(every[near], FINER)
        step *= 2 / (FINER - 1)
    return _best(found, cost)


def _placed(
    links: tuple[float, float, float], phases: FloatArray, sides: FloatArray, task: FunctionTask
) -> tuple[Generator, FloatArray]:
    """Generators (k,) at input phases (k,) on sides (k,), and what their errors cost."""
    a, r, b = (np.full(len(phases), each) for each in links)
    inputs, outputs = task.compared()
    zero = np.zeros(len(phases))
    found = Generator(a, r, b, phases, zero, sides)
    angle = found.outputs(inputs) - outputs
    is_open = np.isnan(angle)
    share = np.ones(len(inputs))
    if task.function is None and task.weights is not None:
        share = task.weights
    if task.output_phase is not None:
        best = np.full(len(phases), task.output_phase)
    else:
        turns = np.where(is_open, 0.0, np.exp(1j * angle)) @ share
        best = np.angle(turns)
        off = wrapped_angle(angle - best[:, None])
        if task.minimax:
            low = np.where(is_open, np.inf, off).min(axis=1)
            high = np.where(is_open, -np.inf, off).max(axis=1)
            shift = (low + high) / 2
        else:
            shift = np.where(is_open, 0.0, off) @ share / share.sum()
        best = best + np.where(np.isfinite(shift), shift, 0.0)
    error = np.where(is_open, np.pi, np.abs(wrapped_angle(angle - best[:, None])))
    cost = error.max(axis=1) if task.minimax else error**2 @ share
    return Generator(a, r, b, phases, best, sides), cost


def _best(found: Generator, cost: FloatArray) -> Generator:
    return found[int(cost.argmin())]
