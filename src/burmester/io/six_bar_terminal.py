"""Six-bars on a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.describe import six_bar_words
from burmester.io.linkage_table import new_table
from burmester.io.message import draw, message, note, print_trimmed
from burmester.sixbar.six_bars import SixBars
from burmester.synthesis.result import Synthesis
from burmester.wording import in_unit

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["show_six_bars"]

NARROW = 72  # columns; on fewer the table has its first columns only


def show_six_bars(synthesis: Synthesis, result: SixBars, console: Console) -> None:
    """The one to build, in full, and then the others; or why there is none."""
    outcome = synthesis.outcome
    if result.given or not result.found:
        draw(message("result", outcome.code, outcome.message, width=console.width), console)
        for label, text in (("why", outcome.why), ("help", outcome.help)):
            if text:
                draw(note(label, text, console.width), console)
    if not result.found:
        return
    best = result.found[0]
    print_trimmed(Text(six_bar_words.headline(best), style="bold"), console)
    driven, at_poses, *short = six_bar_words.sentences(synthesis, best)
    # Of one that was given the message has told the reasons.
    told = [driven, *([at_poses] if best.usable else []), *([] if result.given else short)]
    for sentence in told:
        print_trimmed(Text(sentence), console)
    if result.given:
        print_trimmed(_at_poses(synthesis, best, console.width), console)
    unit = in_unit(synthesis.task.length_unit)
    rows = [*six_bar_words.joint_rows(best), *six_bar_words.length_rows(best)]
    grid = Table.grid(padding=(0, 2))
    for name, *joints in rows:
        cells = [Text(each) for each in joints if each]
        grid.add_row(name, *(cells if console.width >= NARROW else [Text("\n").join(cells)]))
    print_trimmed(Text(f"\nDimensions{unit and ','}{unit}", style="bold"), console)
    print_trimmed(grid, console)
    if len(result.found) > 1:
        table = new_table("All of them")
        heads = six_bar_words.HEADS[: len(six_bar_words.HEADS) if console.width >= NARROW else 4]
        for k, head in enumerate(heads):
            table.add_column(head, justify="left" if k < 2 else "right", no_wrap=True)
        for found in result.found:
            table.add_row(*six_bar_words.row(synthesis, found)[: len(heads)])
        print_trimmed(table, console)
    if not result.given:
        print_trimmed(Text(f"\n{outcome.message}."), console)


def _at_poses(synthesis: Synthesis, found: FoundSixBar, width: int) -> Table:
    """What the six-bar does at each pose."""
    rows = six_bar_words.pose_rows(synthesis, found)
    most = len(rows) < len(found.drive)
    title = f"At the poses{' that are missed most' if most else ''}"
    table = new_table(f"{title}, on one branch" if found.on_branches else title)
    for head in six_bar_words.pose_heads(synthesis)[: None if width >= NARROW else 3]:
        table.add_column(head, justify="right" if table.columns else "left", no_wrap=True)
    for row in rows:
        table.add_row(*row[: len(table.columns)])
    return table
