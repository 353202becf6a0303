"""A function task before synthesis: its pairs as read, what is asked, and findings about them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Final

import numpy as np
from rich.console import Console
from rich.text import Text

from burmester.errors import Advice
from burmester.functions.function_task import FunctionTask
from burmester.functions.pair_checks import reversals
from burmester.io.function_result import function_task_data
from burmester.io.linkage_table import new_table
from burmester.io.message import print_trimmed, show, wrapped
from burmester.io.result import message_data
from burmester.wording import count, figure

__all__ = ["SCHEMA", "function_check_data", "show_function_check"]

SCHEMA: Final = "burmester.function-check/1"
MAX_ROWS: Final = 20  # pairs shown; of more, the first 18 and the last 2


def function_check_data(task: FunctionTask, findings: tuple[Advice, ...]) -> dict[str, Any]:
    """What `burmester check --json` prints of a function task."""
    low, high = task.input_ends
    pairs, needed = len(task.inputs), task.exact_count
    return {
        "schema": SCHEMA,
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
        "warnings": [message_data(each) for each in findings],
    }


def show_function_check(task: FunctionTask, findings: tuple[Advice, ...], console: Console) -> None:
    """The pairs as they were read, what is asked, and what stands out."""
    _pairs(task, console)
    console.print()
    for name, text in _facts(task):
        for line in wrapped(text, console.width, Text(f"{name:10}", style="bold")):
            console.print(line, soft_wrap=True)
    for each in findings:
        console.print()
        show("warning", each, console)


def _pairs(task: FunctionTask, console: Console) -> None:
    pairs = len(task.inputs)
    columns = {
        "pair": [str(k + 1) for k in range(pairs)],
        "input [°]": [f"{each:.10g}" for each in np.degrees(task.inputs).tolist()],
        "output [°]": [f"{each:.10g}" for each in np.degrees(task.outputs).tolist()],
    }
    if task.weights is not None:
        columns["weight"] = [f"{each:g}" for each in task.weights.tolist()]
    table = new_table()
    for head in columns:
        table.add_column(Text(head), justify="right", overflow="fold")
    rows = list(zip(*columns.values(), strict=True))
    if pairs > MAX_ROWS:
        rows[MAX_ROWS - 2 : -2] = [("...",) * len(columns)]
    for row in rows:
        table.add_row(*map(Text, row))
    print_trimmed(table, console)


def _facts(task: FunctionTask) -> Iterator[tuple[str, str]]:
    low, high = task.input_ends
    if (function := task.function) is not None:
        yield "function", f"y = {function.text}, x from {function.x[0]:g} to {function.x[1]:g}"
    yield "input", f"{_range(low, high)}{_phase(task.input_phase)}"
    _, outputs = task.compared()
    turns = reversals(*task.compared())
    back = "" if not turns else f"; it turns round {count(turns, 'time')}"
    least, most = float(outputs.min()), float(outputs.max())
    yield "output", f"{_range(least, most)}{_phase(task.output_phase)}{back}"
    yield "asks", _asked(task)


def _range(low: float, high: float) -> str:
    low, high = math.degrees(low), math.degrees(high)
    return f"{figure(high - low)}°, from {low:.4g}° to {high:.4g}°"


def _phase(phase: float | None) -> str:
    return "" if phase is None else f"; {math.degrees(phase):.6g}° from the ground link at 0"


def _asked(task: FunctionTask) -> str:
    """What is to be found, in words."""
    pairs, needed = len(task.inputs), task.exact_count
    phases = {0: "both phases given", 1: "one phase open", 2: "both phases open"}[task.free_phases]
    head = f"{count(pairs, 'pair')}, {phases}: "
    solutions = task.solutions
    if solutions is None:
        rest = f"; {count(needed, 'pair')} leave finitely many" if pairs >= 3 else ""
        few = "" if pairs >= 3 else ", and three pairs are the fewest that are solved"
        return f"{head}infinitely many linkages{rest}{few}"
    if pairs == needed:
        most = "one linkage" if solutions == 1 else f"{solutions} linkages at most"
        return f"{head}{most} through all of them"
    norm = "least greatest error" if task.minimax else "least squared error"
    return f"{head}the {norm}, from {count(solutions, 'critical point')} of the residual"
