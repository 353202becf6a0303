"""The paper's numbers beside ours, as a terminal shows them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import zip_longest

from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.describe.dimensions import short
from burmester.io.linkage_table import new_table
from burmester.io.message import print_trimmed
from burmester.paper.comparison import Section, Verdict
from burmester.paper.five_methods import Answer, SideBySide


def show_reproduction(
    sections: Sequence[Section], tasks: Sequence[SideBySide], console: Console
) -> None:
    """The paper's numbers beside the computed ones, its tasks by five methods, and a count."""
    for section in sections:
        print_trimmed(Text(f"\n{section.title}", style="bold"), console)
        if section.rows:
            print_trimmed(_comparisons(section), console)
        for row in section.rows:
            if row.note:
                print_trimmed(Text(f"{row.item}: {row.note}", style="dim"), console)
        for remark in section.remarks:
            print_trimmed(Text(remark), console)
    if tasks:
        print_trimmed(Text("\nThe same tasks by other methods", style="bold"), console)
        text = (
            "rms and worst: the misses of the circle. starts: how many random ones lead to the "
            "dyad, the same for all; pencil (normalised) and complete method need none."
        )
        print_trimmed(Text(text), console)
    for task in tasks:
        print_trimmed(Text(f"\n{task.title} by five methods", style="bold"), console)
        print_trimmed(_methods(task), console)
        for remark in _of_starts(task.answers):
            print_trimmed(Text(remark), console)
    counts = Counter(row.verdict for section in sections for row in section.rows)
    verdicts = ", ".join(f"{counts[verdict]} {verdict}" for verdict in Verdict)
    print_trimmed(
        Text(f"\n{sum(counts.values())} printed numbers: {verdicts}", style="bold"), console
    )


def _methods(task: SideBySide) -> Table:
    starts = max(answer.starts or 0 for answer in task.answers)
    table = new_table()
    table.add_column("", no_wrap=True)
    for name in ("fixed pivot", "moving pivot", "length", "rms", "worst", f"starts\nof {starts}"):
        table.add_column(name, justify="right", no_wrap=True)
    for answer in task.answers:
        counts = ["none"] if answer.reached is None else [str(n) for n in answer.reached]
        if answer.reached and len(answer.rms_error) > len(counts):
            counts.append("both")  # found at once
        rows = [_circle(answer, k) for k in range(len(answer.rms_error))] or [["-"] * 5]
        for name, row, count in zip_longest([answer.method], rows, counts, fillvalue=""):
            table.add_row(name, *row, count)
    return table


def _circle(answer: Answer, k: int) -> list[str]:
    dyad = answer.dyads[k]
    pivots = [f"({x:.3f}, {y:.3f})" for x, y in (dyad.fixed_pivot, dyad.moving_pivot)]
    errors = [f"{error[k]:.1e}" for error in (answer.rms_error, answer.max_error)]
    return [*pivots, f"{dyad.radius:.3f}", *errors]


def _of_starts(answers: Sequence[Answer]) -> list[str]:
    needed = [f"{a.method} {short(a.needed)}" for a in answers if a.needed is not None]
    settled = [f"{a.method} {a.settled} of {a.starts}" for a in answers if a.starts is not None]
    seconds = [
        f"{a.method} {short(a.seconds)} s"
        if a.seconds >= 0.1
        else f"{a.method} {short(1e3 * a.seconds)} ms"
        for a in answers
    ]
    return [
        f"Random starts until both dyads are found, on average: {', '.join(needed)}.",
        f"Starts that come to rest in a minimum at all: {', '.join(settled)}.",
        f"Time on this machine, all starts together: {', '.join(seconds)}.",
    ]


_STYLE = {Verdict.MISPRINT: "yellow", Verdict.DIFFERS: "bold red", Verdict.AGREES: "green"}


def _comparisons(section: Section) -> Table:
    places = {row.item.partition(", ")[0] for row in section.rows}
    table = new_table()
    table.add_column("", no_wrap=True)
    for name in ("print", "computed", "spread by rounding"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("verdict", no_wrap=True)
    for row in section.rows:
        item, *numbers, verdict = row.cells()
        shown = item if len(places) > 1 else item.partition(", ")[2]
        table.add_row(shown, *numbers, Text(verdict, style=_STYLE.get(row.verdict, "")))
    return table
