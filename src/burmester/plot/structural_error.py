"""The structural error of function generators over the input."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from burmester.functions.found_generator import ROUNDING, FoundGenerator
from burmester.plot.style import BLACK, BLUE, GREEN, GREY, VERMILION, figure
from burmester.synthesis.function_generation import FunctionSynthesis

MOST_CURVES = 4  # linkages in one figure
FAR = 5.0  # times the greatest error of the first; worse linkages are left out


def structural_error(ax: Axes, found: FoundGenerator, color: str = BLUE) -> list[Line2D]:
    """The error of the output over the input, in degrees: a curve for a function, else points."""
    task = found.task
    inputs = np.degrees(task.compared()[0])
    error = np.degrees(found.range_errors)
    name = f"{found.id}, {found.type}"
    if task.function is None:
        order = np.argsort(inputs)
        lines = ax.plot(inputs[order], error[order], "o-", color=color, lw=0.8, label=name)
    else:
        lines = ax.plot(inputs, error, color=color, lw=1.6, label=name)
        if len(task.inputs) <= 12:
            at = np.degrees(found.errors)
            lines += ax.plot(np.degrees(task.inputs), at, "o", color=color, ms=4)
    return lines


def structural_error_figure(synthesis: FunctionSynthesis) -> Figure:
    """The best linkages of a synthesis, each with its error."""
    task = synthesis.task
    drawing = figure(7.0, 4.2)
    ax = drawing.add_axes((0.12, 0.14, 0.84, 0.72))
    best = (synthesis.usable or synthesis.generators)[:MOST_CURVES]
    chosen = [c for c in best if not c.max_error > FAR * max(best[0].max_error, ROUNDING)]
    for found, color in zip(chosen, (BLUE, VERMILION, GREEN, GREY), strict=False):
        structural_error(ax, found, color)
    ax.axhline(0.0, color=BLACK, lw=0.6)
    ax.set_xlabel("input (deg)")
    ax.set_ylabel("structural error of the output (deg)")
    ax.grid(True, lw=0.4, alpha=0.5)
    name = task.function.text if task.function else f"{len(task.inputs)} pairs of angles"
    ax.set_title(f"{name}: the output less what is asked for", loc="left", pad=22)
    if chosen:
        ax.legend(
            loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, frameon=False, fontsize="small"
        )
    return drawing
