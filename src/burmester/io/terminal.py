"""A synthesis as a terminal shows it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.describe import sentences, six_bar_words
from burmester.describe.dimensions import dyad_in_words
from burmester.describe.quality_words import improvements
from burmester.io import linkage_table
from burmester.io.linkage_table import new_table, show_warnings, table_of
from burmester.io.message import draw, message, note, print_trimmed, show
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.verdicts.explanation import by_nearness
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import in_unit

if TYPE_CHECKING:
    from burmester.synthesis.function_generation import AnySynthesis

# Columns; in a narrower terminal both sides of a dyad are in one column, or its length as well.
NARROW, SLIM = 64, 48
WIDE = 72  # columns; on fewer tables of six-bars and generators have their first columns only
CLOSEST = 3  # linkages in the outcome, where none is usable
MOST_USABLE, MOST_GENERATORS = 4, 8  # linkages in the table, unless all are asked for
PLAIN = ("R300", "R305", "R307", "R308", "R340")  # outcomes that are told without their code


def show_synthesis(
    synthesis: AnySynthesis,
    console: Console,
    *,
    everything: bool = False,
    dyads: bool = False,
    verbose: bool = False,
) -> None:
    """What to build first, then the other usable linkages, and what has been found in all.

    everything: all usable linkages, and those that are not, with the reasons; dyads: also the
    dyads; verbose: also why these come first, and what the columns are.
    """
    if not isinstance(synthesis, Synthesis):
        from burmester.describe import generator_words

        first = synthesis.generators if everything else synthesis.leading(MOST_GENERATORS)
        told = [each for each in first if each.usable or everything] or first
        _in_words(synthesis, told, generator_words, console, given=synthesis.method == "judged")
        if len(told) < len(synthesis.generators):
            more = len(synthesis.generators) - len(told)
            print_trimmed(Text(f"{more} more: --all."), console)
        show_warnings(synthesis.warnings, console)
        return
    if (six_bars := synthesis.six_bars) is not None:
        _in_words(synthesis, six_bars.found, six_bar_words, console, given=six_bars.given)
        show_warnings(synthesis.warnings, console)
        return
    rest: list[FoundLinkage] = []
    hidden = 0
    if synthesis.outcome.code in JUDGED:
        _judged(synthesis, console)
    elif synthesis.usable:
        shown = synthesis.usable if everything else _first_usable(synthesis)
        hidden = len(synthesis.usable) - len(shown)
        _answer(synthesis, shown, console, verbose=verbose)
        rest = [each for each in synthesis.linkages if not each.usable]
    else:
        ordered = synthesis.outcome.code == "R352"  # they are ranked by nearness
        every = synthesis.linkages if ordered else by_nearness(synthesis.linkages, synthesis.length)
        three = every[:CLOSEST]
        _no_answer(synthesis, three, console)
        rest = [each for each in synthesis.linkages if each not in three]
    if everything and rest:
        title = "Not usable, and why" if synthesis.usable else "Not usable either"
        print_trimmed(Text(f"\n{title}", style="bold"), console)
        print_trimmed(linkage_table.unusable(synthesis, rest, console.width), console)
    # Without a linkage the dyads are all there is.
    if synthesis.dyads and (dyads or not synthesis.linkages):
        print_trimmed(_dyads(synthesis, console.width), console)
    if synthesis.outcome.code not in JUDGED:
        left = 0 if everything else len(rest)
        _in_all(synthesis, (hidden, left), console, dyads=dyads, verbose=verbose)
    _certificate(synthesis, console)
    show_warnings(synthesis.warnings, console)
    if synthesis.dyads and verbose:
        print_trimmed(Text(f"\n{sentences.footnotes(synthesis)}", style="dim"), console)


def _first_usable(synthesis: Synthesis) -> list[FoundLinkage]:
    """The usable linkages of the table: the first ones, and those that words name."""
    told = [] if synthesis.family else [*sentences.alternatives(synthesis)]
    for each in synthesis.warnings:
        told += (each.message, each.help or "")
    named = set(re.findall(r"\bL\d+\b", " ".join(told)))
    return [each for k, each in enumerate(synthesis.usable) if k < MOST_USABLE or each.id in named]


def _certificate(synthesis: Synthesis, console: Console) -> None:
    """What is proved and what is computed, where a certificate was asked for."""
    if synthesis.certificate is None:
        return
    for head, lines in (
        (
            "Proved, of all digits (--json), for the poses as given",
            synthesis.certificate.proved,
        ),
        ("Computed, not proved", synthesis.certificate.numerical),
    ):
        if lines:
            print_trimmed(Text(f"\n{head}:", style="bold"), console)
            print_trimmed(_bullets(lines), console)


def _in_words(
    synthesis: AnySynthesis, shown: Sequence[Any], words: Any, console: Console, *, given: bool
) -> None:
    """The linkage to build, in full, and the others, or why there is none; words: of its kind."""
    outcome, wide = synthesis.outcome, console.width >= WIDE
    works = any(each.usable for each in shown)
    if given or not works:
        show("result", outcome, console)
    if given or works:
        best = shown[0]
        print_trimmed(Text(words.headline(best), style="bold"), console)
        for sentence in words.notes(synthesis, best):
            print_trimmed(Text(sentence), console)
        if given:
            title, heads, rows = words.place_table(synthesis, best)
            print_trimmed(table_of(heads[: None if wide else words.NARROW], rows, title), console)
        unit = in_unit(best.unit)
        grid = Table.grid(padding=(0, 2))
        for name, *joints in words.dimension_rows(best):
            cells = [Text(each) for each in joints if each]
            grid.add_row(name, *(cells if wide else [Text("\n").join(cells)]))
        print_trimmed(Text(f"\nDimensions{unit and ','}{unit}", style="bold"), console)
        print_trimmed(grid, console)
    if len(shown) > 1 or not (given or works):
        rows = [words.row(synthesis, each) for each in shown]
        heads = words.HEADS[: words.WIDE if wide else words.NARROW]
        which = "All" if len(shown) == len(synthesis.candidates) else "The best"
        print_trimmed(table_of(heads, rows, f"{which} of them", left=2, gap=int(wide)), console)
    for sentence in words.beside(synthesis, shown):
        print_trimmed(Text(sentence), console)
    if works and not given:
        print_trimmed(Text(f"\n{outcome.message}."), console)


def _answer(
    synthesis: Synthesis, usable: Sequence[FoundLinkage], console: Console, *, verbose: bool
) -> None:
    """The linkage to build, in a sentence and in full; then the first usable ones in a table."""
    if synthesis.outcome.code not in PLAIN:
        show("result", synthesis.outcome, console)
    print_trimmed(Text(sentences.headline(synthesis), style="bold"), console)
    # Of a family the table has their figures.
    for sentence in sentences.alternatives(synthesis) if verbose or not synthesis.family else ():
        print_trimmed(Text(sentence), console)
    short = len(usable) > 1 and not verbose
    for part in linkage_table.in_full(synthesis, usable[0], console, short=short):
        print_trimmed(part, console)
    if len(usable) > 1:
        print_trimmed(linkage_table.usable_table(synthesis, usable, console), console)


def _judged(synthesis: Synthesis, console: Console) -> None:
    """A linkage that was given, in full whether it works or not."""
    outcome, given = synthesis.outcome, synthesis.linkages[0]
    draw(message("result", outcome.code, outcome.message, width=console.width), console)
    if not given.usable:
        print_trimmed(linkage_table.unusable(synthesis, [given], console.width), console)
    elif outcome.why:
        draw(note("why", outcome.why, console.width), console)
    if outcome.help:
        draw(note("help", outcome.help, console.width), console)
    if given.usable:
        print_trimmed(Text(sentences.headline(synthesis), style="bold"), console)
    for part in linkage_table.in_full(synthesis, given, console):
        print_trimmed(part, console)
    if better := improvements(synthesis):
        print_trimmed(Text("\nBetter ones near it, the nearest first", style="bold"), console)
        print_trimmed(_bullets(better), console)
        for part in linkage_table.in_full(synthesis, synthesis.linkages[1], console):
            print_trimmed(part, console)


def _no_answer(synthesis: Synthesis, three: Sequence[FoundLinkage], console: Console) -> None:
    """The outcome, and the closest linkages with the reasons why they are not usable."""
    outcome = synthesis.outcome
    draw(message("result", outcome.code, outcome.message, width=console.width), console)
    if three:
        print_trimmed(linkage_table.unusable(synthesis, three, console.width), console)
    told = synthesis.family is not None or synthesis.causes or outcome.code == "R352"
    if outcome.why and (told or not three):
        draw(note("why", outcome.why, console.width), console)
    if outcome.help:
        draw(note("help", outcome.help, console.width), console)


def _in_all(
    synthesis: Synthesis, left: tuple[int, int], console: Console, *, dyads: bool, verbose: bool
) -> None:
    """How many there are, and how the rest is listed; left: usable and other ones not listed."""
    told, family = [], synthesis.family
    if synthesis.usable and synthesis.outcome.code in PLAIN:
        message = synthesis.outcome.message
        if family is not None and not verbose:
            message = message.removesuffix(family.rule).rstrip(" .")
        told.append(f"{message}.")
    options, (usable, other) = [], left
    if usable:
        options.append(f"{usable} more{f', and {other} not usable' * bool(other)}: --all")
    elif other:
        options.append(f"{other} more, not usable: --all")
    if synthesis.linkages and synthesis.dyads and not dyads:
        options.append("the dyads: --dyads")
    if synthesis.usable and not verbose:
        options.append("how to read this: --verbose")
    if options:
        text = "; ".join(options)
        told.append(f"{text[0].upper()}{text[1:]}.")
    if told:
        print_trimmed(Text("\n" + " ".join(told)), console)


def _dyads(synthesis: Synthesis, width: int) -> Table:
    table = new_table(sentences.dyads_title(synthesis), gap=1 if width >= 80 else 0)
    table.add_column("", no_wrap=True)
    table.add_column("kind", no_wrap=True)
    narrow, slim = width < NARROW, width < SLIM
    if narrow:
        table.add_column("in F, M, length" if slim else "in F, then M")
    else:
        table.add_column("on the ground (F)")
        table.add_column("on the body (M)")
    if not slim:
        table.add_column("length", justify="right", no_wrap=True)
    table.add_column("rms miss", justify="right", no_wrap=True)
    if width >= 80:
        table.add_column("worst", justify="right", no_wrap=True)
    for found in synthesis.dyads:
        ground, body, length, *errors = dyad_in_words(found, synthesis.task).values()
        where: tuple[str, ...] = (ground, body, length)
        if narrow:
            where = ("\n".join(where),) if slim else (f"{ground}\n{body}", length)
        row = found.id, type(found.dyad).__name__, *where, *errors
        table.add_row(*row[: len(table.columns)])
    return table


def _bullets(lines: Sequence[str]) -> Table:
    grid = Table.grid(padding=(0, 1))
    for line in lines:
        grid.add_row("-", Text(line))
    return grid
