"""A synthesis as a terminal shows it."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.describe import sentences
from burmester.describe.digits import dyad_error, fitted_decimals, sides
from burmester.io import linkage_table
from burmester.io.linkage_table import new_table
from burmester.io.message import draw, message, note, show
from burmester.linkages.found_linkage import FoundLinkage
from burmester.synthesis.result import Synthesis

__all__ = ["show_synthesis"]

SUCCESSES = ("R300", "R307")  # outcomes whose message stands alone, without its code


def show_synthesis(synthesis: Synthesis, console: Console) -> None:
    """The outcome in a sentence, then dyads and linkages in tables."""
    three = linkage_table.closest_three(synthesis)
    _outcome(synthesis, three, console)
    if synthesis.dyads:
        console.print(_dyads(synthesis, console.width))
    _linkages(synthesis, three, console)
    if synthesis.certificate is not None:
        for head, lines in (
            (
                "Proved, of all digits (--json), for the poses as given",
                synthesis.certificate.proved,
            ),
            ("Computed, not proved", synthesis.certificate.numerical),
        ):
            if lines:
                console.print(Text(f"\n{head}:", style="bold"))
                console.print(_bullets(lines))
    for warning in synthesis.warnings:
        show("warning", warning, console)


def _outcome(synthesis: Synthesis, three: Sequence[FoundLinkage], console: Console) -> None:
    """The outcome in sentences; the closest three linkages where none is usable."""
    outcome = synthesis.outcome
    if synthesis.usable and outcome.code in SUCCESSES:
        console.print(Text(f"{outcome.message}.", style="bold"))
    else:
        draw(message("result", outcome.code, outcome.message, width=console.width), console)
    if three:
        console.print(linkage_table.unusable(synthesis, three))
    elif outcome.why:
        draw(note("why", outcome.why, console.width), console)
    if outcome.help:
        draw(note("help", outcome.help, console.width), console)
    for sentence in sentences.best_sentences(synthesis):
        console.print(Text(sentence))


def _linkages(synthesis: Synthesis, three: Sequence[FoundLinkage], console: Console) -> None:
    """Usable linkages, unusable ones, and the best one in full."""
    if synthesis.usable:
        console.print(linkage_table.usable_table(synthesis, console))
    rest = [each for each in synthesis.linkages if not each.usable and each not in three]
    if rest:
        title = "Not usable either" if three else "Not usable, and why"
        console.print(Text(f"\n{title}", style="bold"))
        console.print(linkage_table.unusable(synthesis, rest))
    if synthesis.usable:
        for part in linkage_table.in_full(synthesis):
            console.print(part)
    if synthesis.dyads:
        console.print(Text(f"\n{sentences.footnotes(synthesis)}", style="dim"))


def _dyads(synthesis: Synthesis, width: int) -> Table:
    table = new_table(sentences.dyads_title(synthesis), gap=1 if width >= 80 else 0)
    table.add_column("", no_wrap=True)
    table.add_column("kind", no_wrap=True)
    table.add_column("on the ground (F)")
    table.add_column("on the body (M)")
    table.add_column("length", justify="right", no_wrap=True)
    table.add_column("rms miss", justify="right", no_wrap=True)
    if width >= 80:
        table.add_column("worst", justify="right", no_wrap=True)
    for found in synthesis.dyads:
        ground, body, length = sides(found.dyad, fitted_decimals(synthesis, found.dyad))
        errors = dyad_error(synthesis, found.rms_error), dyad_error(synthesis, found.max_error)
        row = found.id, type(found.dyad).__name__, ground, body, length, *errors
        table.add_row(*row[: len(table.columns)])
    return table


def _bullets(lines: Sequence[str]) -> Table:
    grid = Table.grid(padding=(0, 1))
    for line in lines:
        grid.add_row("-", Text(line))
    return grid
