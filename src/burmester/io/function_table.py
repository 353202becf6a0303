"""Function tasks and syntheses on a terminal: pairs and findings, then generators."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Final

import numpy as np
from rich.console import Console
from rich.text import Text

from burmester.errors import Advice
from burmester.functions.found_generator import ROUNDING, FoundGenerator
from burmester.functions.function_task import FunctionTask
from burmester.functions.pair_checks import reversals
from burmester.io.function_result import function_task_data
from burmester.io.linkage_table import new_table, show_read, show_warnings, table_of
from burmester.io.message import draw, message, print_trimmed, show, wrapped
from burmester.synthesis.function_generation import FunctionSynthesis
from burmester.wording import count, figure, listed, with_article

CHECK_SCHEMA: Final = "burmester.function-check/1"

NARROW = 76  # columns; in a narrower terminal the table has fewer
MOST_PAIRS = 20  # in a table; of more there is none
MOST_ROWS = 8  # linkages in the table where not all are asked for


def show_function(
    synthesis: FunctionSynthesis, console: Console, *, everything: bool = False
) -> None:
    """What to build first, then the other linkages, and what has been found in all."""
    outcome, task = synthesis.outcome, synthesis.task
    usable = synthesis.usable
    if usable:
        judged = synthesis.method == "judged"
        _best(usable[0], task, console, f"{usable[0].id} is" if judged else "")
    else:
        show("result", outcome, console)
    everything |= synthesis.method == "judged"
    shown = list(synthesis.generators if everything else synthesis.leading(MOST_ROWS))
    if usable and not everything:
        shown = [each for each in shown if each.usable]
    if len(shown) > 1 or (shown and not usable):
        _table(shown, task, console)
    if synthesis.price_note:
        draw(wrapped(synthesis.price_note, console.width), console)
    if synthesis.method == "judged" and len(task.inputs) <= MOST_PAIRS:
        _pair_errors(shown[0], task, console)
    if usable:
        console.print()
        draw(message("result", outcome.code, outcome.message, width=console.width), console)
        if (rest := len(synthesis.generators) - len(shown)) and not everything:
            print_trimmed(Text(f"{rest} more: --all."), console)
    show_warnings(synthesis.warnings, console)


def _best(found: FoundGenerator, task: FunctionTask, console: Console, named: str = "") -> None:
    """The linkage to build, with its dimensions; named: what is said in place of `Build`."""
    kind = with_article(found.type)
    where = "over the range" if task.function else "at the pairs"
    error = (
        "meets all pairs exactly"
        if found.is_exact
        else f"misses by {_degrees(found.max_error)} deg at most {where} "
        f"({figure(100 * found.max_error / task.output_span)} % of the output's range), "
        f"{_degrees(found.rms_error)} deg rms"
    )
    head = f"{named or f'Build {found.id}:'} {kind} that {error}."
    print_trimmed(Text(head, style="bold"), console)
    one = found.generator
    table = new_table(gap=1)
    table.show_header = False
    for _ in range(2):
        table.add_column(no_wrap=True)
    table.add_column(justify="right", no_wrap=True)
    table.add_column()
    at = {
        "input link": (one.input_phase, "where the input is 0"),
        "output link": (one.output_phase, "where the output is 0"),
    }
    for name, length in found.lengths(task.ground).items():
        phase = at.get(name)
        text = (
            "" if phase is None else f"at {math.degrees(float(phase[0])) % 360:.4f} deg {phase[1]}"
        )
        table.add_row("", name, f"{length:.6g}", text)
    print_trimmed(table, console)
    side = "left" if float(one.side) > 0 else "right"
    notes = [
        "Angles are from the ground link, counter-clockwise. Seen from the input link's pin to "
        f"the output's pivot, the coupler's other pin lies on the {side}.",
        f"Least transmission angle over the range: {math.degrees(found.least_transmission):.1f} "
        f"deg. The box of all pivots has a diagonal of {figure(found.extent * task.ground)}.",
    ]
    if found.shortcomings:
        notes.append(f"It {listed(found.shortcomings)}.")
    for text in notes:
        print_trimmed(Text(text), console)


def _pair_errors(found: FoundGenerator, task: FunctionTask, console: Console) -> None:
    """Each pair, and what the linkage makes of it."""
    rows = []
    for k, (x, y, error) in enumerate(
        zip(task.inputs, task.outputs, found.errors, strict=True), start=1
    ):
        made = "-" if math.isnan(error) else f"{math.degrees(y + error):.4f}"
        angles = f"{math.degrees(x):.10g}", f"{math.degrees(y):.10g}"
        rows.append((str(k), *angles, made, _degrees(float(error))))
    heads = ("pair", "input", "output", "is made", "error")
    print_trimmed(table_of(heads, rows, "At the pairs, in degrees", left=0), console)


def _table(shown: list[FoundGenerator], task: FunctionTask, console: Console) -> None:
    wide = console.width >= NARROW
    some = 1 if wide else 3
    figures = ("max error", "%", "rms", "transm.")[::some]
    rows = []
    for each in shown:
        _, *lengths = each.lengths(task.ground).values()
        least = math.degrees(each.least_transmission)
        cells = (
            f"{_degrees(each.max_error)}°",
            "0" if each.is_exact else figure(100 * each.max_error / task.output_span),
            f"{_degrees(each.rms_error)}°",
            f"{least:.0f}°" if math.isfinite(least) else "-",
        )
        rows.append((each.id, each.type, *(f"{each:.4g}" for each in lengths), *cells[::some]))
    heads = ("", "type", "input", "coupler", "output", *figures)
    title = "Function generators, the best first"
    print_trimmed(table_of(heads, rows, title, left=2, gap=1 if wide else 0), console)
    for each in shown:
        if not each.usable:
            reasons = f"{each.id} {listed([d.message for d in each.defects])}"
            draw(wrapped(reasons, console.width, hang=4), console)


def _degrees(angle: float) -> str:
    """An error in degrees, "exact" where it is rounding, "open" where there is none."""
    if not math.isfinite(angle):
        return "-"
    return "0" if abs(angle) < ROUNDING else figure(math.degrees(angle))


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
    show_read(columns, _facts(task), findings, console)


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
