"""A synthesis and the reproduction of the paper, as a terminal shows them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.describe.digits import decimals, miss, sides
from burmester.io import linkage_table
from burmester.io.linkage_table import new_table
from burmester.io.message import draw, message, note, show
from burmester.linkages.found_linkage import FoundLinkage
from burmester.synthesis.result import Synthesis

if TYPE_CHECKING:
    pass

__all__ = ["show_synthesis"]

FOUND = ("R300", "R307")  # outcomes that are told by what was found


def show_synthesis(synthesis: Synthesis, console: Console) -> None:
    """What was found, first in a sentence, then as tables of dyads and linkages."""
    three = linkage_table.closest_three(synthesis)
    _outcome(synthesis, three, console)
    if synthesis.dyads:
        console.print(_dyads(synthesis, console.width))
    _linkages(synthesis, three, console)
    if synthesis.certificate is not None:
        for head, sentences in (
            ("Proved, for the poses as given", synthesis.certificate.proved),
            ("Computed, not proved", synthesis.certificate.numerical),
        ):
            if sentences:
                console.print(Text(f"\n{head}:", style="bold"))
                console.print(_bullets(sentences))
    for warning in synthesis.warnings:
        show("warning", warning, console)


def _outcome(synthesis: Synthesis, three: Sequence[FoundLinkage], console: Console) -> None:
    """What came of it, in sentences; the nearest three linkages where none of them works."""
    said = synthesis.outcome
    told = synthesis.usable and said.code in FOUND
    if told:
        console.print(Text(f"{said.message}.", style="bold"))
    else:
        draw(message("result", said.code, said.message, width=console.width), console)
    if three:
        console.print(linkage_table.unusable(synthesis, three))
    elif said.why:
        draw(note("why", said.why, console.width), console)
    if said.help:
        draw(note("help", said.help, console.width), console)
    if synthesis.usable:
        for sentence in linkage_table.best_sentences(synthesis):
            console.print(sentence)


def _linkages(synthesis: Synthesis, three: Sequence[FoundLinkage], console: Console) -> None:
    """The linkages that work, those that do not, and the best one in full."""
    if synthesis.usable:
        console.print(linkage_table.usable_table(synthesis, console))
    rest = [each for each in synthesis.linkages if not each.usable and each not in three]
    if rest:
        title = "Not usable either" if three else "Not usable, and why"
        console.print(Text(f"\n{title}", style="bold"))
        console.print(linkage_table.unusable(synthesis, rest))
    if synthesis.usable:
        for part in linkage_table.dimensions(synthesis):
            console.print(part)
    if synthesis.dyads:
        console.print(Text(f"\n{linkage_table.footnotes(synthesis)}", style="dim"))


def _dyads(synthesis: Synthesis, width: int) -> Table:
    table = new_table("Dyads", gap=1 if width >= 80 else 0)
    table.add_column("", no_wrap=True)
    table.add_column("kind", no_wrap=True)
    table.add_column("on the ground (F)")
    table.add_column("on the body (M)")
    table.add_column("length", justify="right", no_wrap=True)
    table.add_column("rms miss", justify="right", no_wrap=True)
    if width >= 80:
        table.add_column("worst", justify="right", no_wrap=True)
    for found in synthesis.dyads:
        ground, body, length = sides(found.dyad, decimals(synthesis, found.rms_error))
        errors = miss(synthesis, found.rms_error), miss(synthesis, found.max_error)
        row = found.id, type(found.dyad).__name__, ground, body, length, *errors
        table.add_row(*row[: len(table.columns)])
    return table


def _bullets(sentences: Sequence[str]) -> Table:
    grid = Table.grid(padding=(0, 1))
    for sentence in sentences:
        grid.add_row("-", Text(sentence))
    return grid
