"""Fewer pairs than phases and ratios: the generators of a grid of phases, and the best of them.

Three pairs leave both phases open, or one where the other is given; four pairs leave one.  Each
choice of phases on a grid has its generators in closed form; what works is judged for all at once.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from burmester.functions.exact_pairs import generators_of_phases, other_phases
from burmester.functions.found_generator import MET
from burmester.functions.generator import Generator
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.requirements.links import LINK_RATIO
from burmester.requirements.table import keeps
from burmester.tasks.function_task import FunctionTask
from burmester.verdicts.requirement_check import figures_of

GRID: Final = 72  # phases within half a turn; half a turn more is the same link drawn backwards
FINE_GRID: Final = 360  # the same where one phase is open only
KEPT: Final = 6  # generators that are told
APART: Final = np.radians(15)  # phases; of generators nearer to each other the best is told


INPUT_PHASES: Final = 1440  # input phases in a turn
PLACES_REFINED: Final = 8  # places of the grid that are looked at closer
FINER: Final = 41  # places of each finer grid, over two steps of the one before
LEVELS: Final = 7  # of finer grids; each is 20 times as fine


class PhaseFamily(NamedTuple):
    """generators: (k,), the best first; tried: how many there were; working: how many worked."""

    generators: Generator
    tried: int
    working: int


def best_of_phases(task: FunctionTask) -> PhaseFamily:
    """The best generators of three or four pairs that leave phases open.

    Best is the least greatest structural error of a function; where only pairs are given, which all
    of these meet, the greatest least transmission angle; those that keep what the task asks are
    chosen from, if any does.  A grid is searched, and nothing is said of what lies between its
    phases.
    """
    found = _of_grid(task)
    found = found[np.isfinite(found.sizes).all(axis=-1)]
    found = found.with_better_side(task.inputs, task.outputs)
    tried, (low, high) = len(found), task.input_ends
    error = np.abs(found.error(task.inputs, task.outputs)).max(axis=-1)
    works = found.runs_through(low, high) & (error < MET)
    works &= found.link_ratio <= LINK_RATIO.standard
    found = found[works]
    figures = figures_of(found.linkage(), found.least_transmission(low, high), True)
    kept = keeps(task.requirements.bounds, figures)
    if kept.any():
        found = found[kept]
    if task.function is not None:
        merit = np.abs(found.error(*task.compared())).max(axis=-1)
    else:
        merit = -found.least_transmission(low, high)
    order = np.argsort(merit, kind="stable")
    found = found[order]
    best = found[found.first_apart(APART, KEPT, phases_only=True)]
    return PhaseFamily(best, tried, int(works.sum()))


def _of_grid(task: FunctionTask) -> Generator:
    """The generators (k,) of all phases of the grid; nan where there are none."""
    inputs, outputs = task.input_phase, task.output_phase
    both = task.free_phases == 2
    size = GRID if both and len(task.inputs) == 3 else FINE_GRID
    grid = np.arange(size) * np.pi / size
    if both and len(task.inputs) > 3:
        second, _ = other_phases(task, grid, "input")
        first = np.broadcast_to(grid[:, None], second.shape)
        some = np.isfinite(second)
        first, second = first[some], second[some]
    elif both:
        first, second = (each.ravel() for each in np.meshgrid(grid, grid, indexing="ij"))
    else:
        first = grid if inputs is None else np.full(size, inputs)
        second = grid if outputs is None else np.full(size, outputs)
    found, determined = generators_of_phases(task, first, second)
    return found[determined]


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
    grid = np.arange(INPUT_PHASES) * 2 * np.pi / INPUT_PHASES
    phases, every = np.tile(grid, len(sides)), np.repeat(sides, INPUT_PHASES)
    step = 2 * np.pi / INPUT_PHASES
    for _ in range(LEVELS):
        found, cost = _placed((input_link, coupler, output_link), phases, every, task)
        near = np.argsort(cost, kind="stable")[:PLACES_REFINED]
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
