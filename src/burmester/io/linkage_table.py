"""The linkages of a synthesis as a terminal shows them: the best in a sentence, all in tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from rich import box
from rich.console import Console, Group
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from burmester.describe.digits import degrees, links, misses, parts
from burmester.linkages import explanation
from burmester.linkages.found_linkage import FoundLinkage
from burmester.linkages.uncertainty import DyadUncertainty, pose_sigma
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import Synthesis
from burmester.tasks import wording
from burmester.wording import with_article

__all__ = [
    "best_sentences",
    "closest_three",
    "dimensions",
    "footnotes",
    "new_table",
    "unusable",
    "usable_table",
]

SHOWN = 8  # linkages that are not usable; the rest are counted
THREE = 3
INDENT = 5


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


def best_sentences(synthesis: Synthesis) -> Iterator[Text]:
    """What the best usable linkage does, and why it is not another one."""
    best, task, size = synthesis.usable[0], synthesis.task, synthesis.length
    kind = best.type.replace("change-point", "change-point linkage")
    least = wording.least_angle(best.driven.least_over_range)
    yield Text(
        f"Best: {best.id}, {with_article(kind)} driven by {best.dyads_driver_first[0].id}, "
        f"{_meets(synthesis, best)}, transmission angle {least} or more."
    )
    nearest = explanation.by_nearness(synthesis.linkages, size)[0]
    if nearest.usable is False and _nearer(nearest, best, size):
        yield Text(
            f"This one works and {explanation.met(best, task, size)}; "
            f"the closest one, {nearest.id}, "
            f"{explanation.in_short(nearest, task, size)}."
        )
    if not best.determined:
        better = next((each for each in synthesis.usable if each.determined), None)
        if better is not None:
            yield Text(
                f"Its pivots are uncertain; those of {better.id} are not, and it "
                f"{explanation.met(better, task, size)}."
            )


def closest_three(synthesis: Synthesis) -> list[FoundLinkage]:
    """The nearest ones, where none is usable."""
    if synthesis.usable:
        return []
    return explanation.by_nearness(synthesis.linkages, synthesis.length)[:THREE]


def usable_table(synthesis: Synthesis, console: Console) -> Table:
    """Those that work, with as many columns as there is room for."""
    usable = synthesis.usable
    all_pins = any(found.linkage.links is not None for found in usable)
    unlimited = console.options.update(max_width=10 * console.width)
    for pins, gap in ((all_pins, 1), (all_pins, 0)):
        table = _usable(synthesis, usable, pins, gap)
        if console.measure(table, options=unlimited).maximum <= console.width:
            return table
    return _usable(synthesis, usable, False, 1)


def _usable(synthesis: Synthesis, usable: Sequence[FoundLinkage], pins: bool, gap: int) -> Table:
    table = new_table("Usable, by worst miss", gap)
    table.add_column("", no_wrap=True)
    table.add_column("type")
    table.add_column("dyads", no_wrap=True)
    for name in ("ground", "driver", "coupler", "follower") if pins else ():
        table.add_column(name, justify="right", no_wrap=True)
    for name in ("worst", "angle", "transm."):
        table.add_column(name, justify="right", no_wrap=True)
    for found in usable:
        # Of the longest name, the second word stands under the first.
        kind = found.type.replace("inverted ", "inverted\n")
        table.add_row(
            found.id,
            kind,
            " ".join(dyad.id for dyad in found.dyads_driver_first),
            *(links(synthesis, found) if pins else ()),
            *misses(synthesis, found),
            wording.least_angle(found.driven.least_over_range),
        )
    return table


def unusable(synthesis: Synthesis, found: Sequence[FoundLinkage]) -> Group:
    """Linkages that do not work, each with its reasons under it."""
    rows: list[Text | Padding] = []
    for each in found[:SHOWN]:
        dyads = " ".join(dyad.id for dyad in each.dyads_driver_first)
        how = explanation.met(each, synthesis.task, synthesis.length)
        angle = float(each.error.angle.max())
        if math.isfinite(angle) and not explanation.exact(each, synthesis.length):
            how += f" and {degrees(angle)}"
        if each.error_before_rounding is not None:
            before = wording.length_of(each.error_before_rounding.worst, synthesis.task)
            how += f" (before rounding {before})"
        head = Text(f"{each.id:<{INDENT - 1}} {each.type}, {dyads}: {how}")
        reasons = "; ".join(explanation.reasons(each, synthesis.task))
        rows += [head, Padding(Text(reasons), (0, 0, 0, INDENT))]
    if len(found) > SHOWN:
        rows.append(Text(f"and {len(found) - SHOWN} more, see --json"))
    return Group(*rows)


def dimensions(synthesis: Synthesis) -> Iterator[Text | Table]:
    """The best usable linkage in full: its dimensions, and how certain they are."""
    best, task = synthesis.usable[0], synthesis.task
    unit = f", in {task.length_unit}" if task.length_unit else ""
    yield Text(f"\n{best.id} in full{unit}", style="bold")
    table = Table.grid(padding=(0, 2, 0, 0))
    certain = (
        not any(task.resolution) or best.error_before_rounding is not None
    )  # rounded: as it is said
    regions: Sequence[DyadUncertainty | None] = best.uncertainty or (None, None)
    for dyad, region in zip(best.dyads, regions, strict=True):
        name = dyad.id
        for what, value, give in parts(synthesis, best, dyad.dyad, None if certain else region):
            table.add_row(name, what, value, *(() if certain else (give,)))
            name = ""
    yield table
    if not certain:
        position, angle = pose_sigma(task)
        given = wording.length_of(position, task) if task.resolution[0] else "0"
        turned = f"{wording.figure(math.degrees(angle))}°" if task.resolution[1] else "0°"
        yield Text(
            "±: 95 % regions, of a pivot in its worst direction, if the poses err by "
            f"{given} and {turned} "
            "(standard deviations: from their digits, or --pose-sigma).",
            style="dim",
        )
    if best.spread is not None:
        assert synthesis.options.manufacturing_tolerance is not None
        within = f"to ±{wording.length_of(synthesis.options.manufacturing_tolerance, task)}"
        yield Text(
            f"Built {within}: position errors of up to "
            f"{wording.length_of(float(best.spread.greatest_95), task)} (95 % of linkages), "
            "at most "
            f"{wording.length_of(float(best.spread.bound), task)}."
        )
    if best.error_before_rounding is not None:
        yield Text(_rounded(synthesis, best))


def _rounded(synthesis: Synthesis, best: FoundLinkage) -> str:
    """What rounding does to the error."""
    assert best.error_before_rounding is not None
    task, options = synthesis.task, synthesis.options
    how = []
    if options.rounding_step is not None:
        how.append(f"rounded to {wording.length_of(options.rounding_step, task)}")
    if options.stock_lengths:
        how.append("with links from stock")
    text = " and ".join(how) or "rounded"
    before, after = (
        "by nothing but rounding errors"
        if each.worst < ROUNDING * synthesis.length
        else f"by {wording.length_of(each.worst, task)}"
        for each in (best.error_before_rounding, best.error)
    )
    return f"{text[0].upper()}{text[1:]}: {best.id} misses {after}, instead of {before}."


def footnotes(synthesis: Synthesis) -> str:
    """What the tables' columns are, and their order."""
    unit = synthesis.task.length_unit or "the unit of the poses"
    notes = f"Lengths in {unit}; F is the ground, M the body."
    if synthesis.linkages:
        notes += " Usable linkages come first, then those that miss least."
    if any(dyad.id[0] == "M" for found in synthesis.linkages for dyad in found.dyads):
        notes += " Dyads M come from the pivot map."
    if synthesis.usable:
        notes += (
            " The first of two dyads drives; worst and angle: the greatest misses at a pose; "
            "transm.: the least transmission angle between the poses."
        )
    return notes


def _meets(synthesis: Synthesis, best: FoundLinkage) -> str:
    if explanation.exact(best, synthesis.length):
        return "passes every pose exactly, up to rounding"
    worst = wording.length_of(best.error.worst, synthesis.task)
    return f"passes every pose within {worst} and {degrees(float(best.error.angle.max()))}"


def _nearer(one: FoundLinkage, other: FoundLinkage, size: float) -> bool:
    return one.error.worst < other.error.worst - ROUNDING * size
