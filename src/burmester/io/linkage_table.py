"""The linkages of a synthesis as tables for a terminal, and the best one in full."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich import box
from rich.console import Console, Group
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from burmester.describe import sentences
from burmester.describe.digits import links, worst_errors
from burmester.describe.dimensions import certain, decimals_of, dimensions
from burmester.linkages import explanation
from burmester.linkages.found_linkage import FoundLinkage
from burmester.synthesis.result import Synthesis
from burmester.tasks import notation
from burmester.wording import count

__all__ = [
    "closest_three",
    "in_full",
    "new_table",
    "unusable",
    "usable_table",
]

MOST_UNUSABLE = 8  # linkages in full; the rest are counted
CLOSEST = 3  # linkages in the outcome, where none is usable
LINKS = ("ground", "driver", "coupler", "follower")
MOST_CUT = 3  # decimals that link lengths in the table may lose on a narrow screen
INDENT = 5  # columns of reasons under their linkage


def new_table(title: str | None = None, gap: int = 1) -> Table:
    """A table with one line under its heads, and `gap` more spaces than one between columns."""
    return Table(
        title=title and f"\n{title}",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
        padding=(0, gap, 0, 0),
        pad_edge=False,
        show_edge=False,
    )


def closest_three(synthesis: Synthesis) -> list[FoundLinkage]:
    """The closest linkages where none is usable, else none."""
    if synthesis.usable:
        return []
    return explanation.by_nearness(synthesis.linkages, synthesis.length)[:CLOSEST]


def usable_table(synthesis: Synthesis, console: Console) -> Table:
    """Usable linkages, with as many columns and decimals as the console has room for."""
    usable = synthesis.usable
    decimals = [decimals_of(synthesis, found).lengths for found in usable]
    pins = [places for places, found in zip(decimals, usable, strict=True) if found.linkage.links]
    most = max(pins, default=0)
    unlimited = console.options.update(max_width=10 * console.width)
    trials = [(most, 1), *((most - cut, 0) for cut in range(min(MOST_CUT, most) + 1))]
    for places, gap in trials if pins else ():
        table = _usable(synthesis, usable, [min(each, places) for each in decimals], gap)
        if places < most:
            table.title = f"{table.title}; links to {count(places, 'decimal')}"
        if console.measure(table, options=unlimited).maximum <= console.width:
            return table
    return _usable(synthesis, usable, None, 1)


def _usable(
    synthesis: Synthesis,
    usable: Sequence[FoundLinkage],
    decimals: Sequence[int] | None,
    gap: int,
) -> Table:
    table = new_table("Usable, the best first", gap)
    table.add_column("", no_wrap=True)
    table.add_column("type")
    table.add_column("dyads", no_wrap=True)
    for name in LINKS if decimals is not None else ():
        table.add_column(name, justify="right", no_wrap=True)
    for name in ("worst", "angle", "transm."):
        table.add_column(name, justify="right", no_wrap=True)
    for k, found in enumerate(usable):
        # Of the longest name, the second word stands under the first.
        kind = found.type.replace("inverted ", "inverted\n") + (" ±" if found.other_types else "")
        table.add_row(
            found.id,
            kind,
            " ".join(dyad.id for dyad in found.dyads_driver_first),
            *(() if decimals is None else links(found, decimals[k])),
            *worst_errors(synthesis, found),
            notation.least_angle(found.driven.least_over_range),
        )
    return table


def unusable(synthesis: Synthesis, found: Sequence[FoundLinkage]) -> Group:
    """Unusable linkages, each with its reasons under it."""
    rows: list[Text | Padding] = []
    for each in found[:MOST_UNUSABLE]:
        dyads = " ".join(dyad.id for dyad in each.dyads_driver_first)
        how = explanation.nearness(each, synthesis.task, synthesis.length)
        if each.error_before_rounding is not None:
            before = notation.length_of(each.error_before_rounding.worst, synthesis.task)
            how += f" (before rounding {before})"
        doubt = sentences.type_doubt(synthesis, each)
        kind = f"{each.type} ({doubt})" if doubt else each.type
        head = Text(f"{each.id:<{INDENT - 1}} {kind}, {dyads}: {how}")
        reasons = "; ".join(explanation.reasons(each, synthesis.task))
        rows += [head, Padding(Text(reasons), (0, 0, 0, INDENT))]
    if len(found) > MOST_UNUSABLE:
        rows.append(Text(f"and {len(found) - MOST_UNUSABLE} more, see --json"))
    return Group(*rows)


def in_full(synthesis: Synthesis) -> Iterator[Text | Table]:
    """The best usable linkage: its dimensions, how certain they are, and what follows of that."""
    best, unit = synthesis.usable[0], synthesis.task.length_unit
    yield Text(f"\n{best.id} in full{f', in {unit}' if unit else ''}", style="bold")
    table = Table.grid(padding=(0, 2, 0, 0))
    exact, last = certain(synthesis, best), None
    for dyad, what, value, give in dimensions(synthesis, best):
        table.add_row("" if dyad == last else dyad, what, value, *(() if exact else (give,)))
        last = dyad
    yield table
    digits, uncertainty = sentences.digits_note, sentences.uncertainty_note
    made = (sentences.tolerance_note, sentences.rounding_note)
    for note in (digits, uncertainty, sentences.type_note, *made):
        text = note(synthesis, best)
        if text is not None:
            yield Text(text, style="dim" if note is uncertainty else "")
