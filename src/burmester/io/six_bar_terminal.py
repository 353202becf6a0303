"""Six-bars on a terminal."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.describe import six_bar_words
from burmester.io.linkage_table import new_table
from burmester.io.message import draw, message, note, print_trimmed
from burmester.sixbar.six_bars import SixBars
from burmester.synthesis.result import Synthesis

__all__ = ["show_six_bars"]

NARROW = 72  # columns; on fewer the table has its first columns only


def show_six_bars(synthesis: Synthesis, result: SixBars, console: Console) -> None:
    """The one to build, in full, and then the others; or why there is none."""
    outcome = synthesis.outcome
    if not result.found:
        draw(message("result", outcome.code, outcome.message, width=console.width), console)
        for label, text in (("why", outcome.why), ("help", outcome.help)):
            if text:
                draw(note(label, text, console.width), console)
        return
    best = result.found[0]
    print_trimmed(Text(six_bar_words.headline(best), style="bold"), console)
    for sentence in six_bar_words.sentences(synthesis, best):
        print_trimmed(Text(sentence), console)
    unit = synthesis.task.length_unit
    rows = [*six_bar_words.joint_rows(best), *six_bar_words.length_rows(best)]
    grid = Table.grid(padding=(0, 2))
    for name, *joints in rows:
        cells = [Text(each) for each in joints if each]
        grid.add_row(name, *(cells if console.width >= NARROW else [Text("\n").join(cells)]))
    print_trimmed(Text("\nDimensions" + (f", in {unit}" if unit else ""), style="bold"), console)
    print_trimmed(grid, console)
    if len(result.found) > 1:
        table = new_table("All of them")
        heads = six_bar_words.HEADS[: len(six_bar_words.HEADS) if console.width >= NARROW else 4]
        for k, head in enumerate(heads):
            table.add_column(head, justify="left" if k < 2 else "right", no_wrap=True)
        for found in result.found:
            table.add_row(*six_bar_words.row(synthesis, found)[: len(heads)])
        print_trimmed(table, console)
    print_trimmed(Text(f"\n{outcome.message}."), console)
