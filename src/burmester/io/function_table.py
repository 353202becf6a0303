"""Function tasks and syntheses on a terminal: pairs and findings, then generators."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.describe import generator_words
from burmester.diagnosis.pair_checks import reversals
from burmester.errors import Advice
from burmester.functions.found_generator import FoundGenerator
from burmester.io.function_result import function_task_data
from burmester.io.linkage_table import show_read, table_of
from burmester.io.message import draw, message, print_trimmed, show, wrapped
from burmester.synthesis.function_generation import FunctionSynthesis
from burmester.tasks.function_task import FunctionTask
from burmester.wording import listed

CHECK_SCHEMA: Final = "burmester.function-check/1"

NARROW = 76  # columns; in a narrower terminal the table has fewer
MOST_PAIRS = 20  # in a table; of more there is none
MOST_ROWS = 8  # linkages in the table where not all are asked for


def show_function(
    synthesis: FunctionSynthesis, console: Console, *, everything: bool = False
) -> None:
    """What to build first, then the other linkages, and what has been found in all."""
    outcome, usable = synthesis.outcome, synthesis.usable
    judged = synthesis.method == "judged"
    everything |= judged
    shown = list(synthesis.generators if everything else synthesis.leading(MOST_ROWS))
    if usable and not everything:
        shown = [each for each in shown if each.usable]
    if usable:
        _best(usable[0], console)
    else:
        show("result", outcome, console)
    if len(shown) > 1 or (shown and not usable):
        _table(shown, console)
    for sentence in generator_words.price_note(synthesis):
        draw(wrapped(sentence, console.width), console)
    if judged and len(synthesis.task.inputs) <= MOST_PAIRS:
        rows = generator_words.pair_rows(shown[0])
        print_trimmed(table_of(generator_words.PAIR_HEADS, rows, "At the pairs", left=0), console)
    if usable:
        console.print()
        draw(message("result", outcome.code, outcome.message, width=console.width), console)
        if (rest := len(synthesis.generators) - len(shown)) and not everything:
            print_trimmed(Text(f"{rest} more: --all."), console)


def _best(found: FoundGenerator, console: Console) -> None:
    """The linkage to build, with its dimensions."""
    print_trimmed(Text(f"{generator_words.headline(found)}.", style="bold"), console)
    grid = Table.grid(padding=(0, 2))
    for row in generator_words.dimension_rows(found):
        grid.add_row("", *row)
    print_trimmed(grid, console)
    for text in generator_words.notes(found):
        print_trimmed(Text(text), console)


def _table(shown: list[FoundGenerator], console: Console) -> None:
    wide = console.width >= NARROW
    some = [*range(9)] if wide else [0, 1, 2, 3, 4, 5, 8]
    heads, *rows = (
        [each[k] for k in some]
        for each in (generator_words.HEADS, *map(generator_words.row, shown))
    )
    title = "Function generators, the best first"
    print_trimmed(table_of(heads, rows, title, left=2, gap=1 if wide else 0), console)
    for each in shown:
        if not each.usable:
            reasons = f"{each.id} {listed([d.message for d in each.faults])}"
            draw(wrapped(reasons, console.width, hang=4), console)


# --- before anything is solved


def function_check_data(task: FunctionTask, findings: tuple[Advice, ...]) -> dict[str, Any]:
    """What `burmester check --json` prints of a function task."""
    low, high = task.input_ends
    pairs, needed = len(task.inputs), task.exact_count
    return {
        "schema": CHECK_SCHEMA,
        "task": function_task_data(task),
        "asks": {
            "pairs": pairs,
            "open_phases": task.free_phases,
            "kind": "phases" if pairs < needed else "exact" if pairs == needed else "nearest",
            "solutions": task.solutions,
        },
        "input_range_deg": math.degrees(high - low),
        "output_range_deg": math.degrees(task.output_span),
        "reversals": reversals(*task.compared()),
        "warnings": [each.to_dict() for each in findings],
    }


def show_function_check(task: FunctionTask, findings: tuple[Advice, ...], console: Console) -> None:
    """The pairs as they were read, what is asked, and what stands out."""
    columns = {
        "pair": [str(k + 1) for k in range(len(task.inputs))],
        "input [°]": [f"{each:.10g}" for each in np.degrees(task.inputs).tolist()],
        "output [°]": [f"{each:.10g}" for each in np.degrees(task.outputs).tolist()],
    }
    if task.weights is not None:
        columns["weight"] = [f"{each:g}" for each in task.weights.tolist()]
    show_read(columns, generator_words.facts(task), findings, console)
