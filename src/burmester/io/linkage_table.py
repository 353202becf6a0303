"""The linkages of a synthesis as tables for a terminal, and the best one in full."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from rich import box
from rich.cells import cell_len
from rich.console import Console, Group, JustifyMethod
from rich.table import Table
from rich.text import Text

from burmester.describe import sentences
from burmester.describe.cognates import cognate_lines
from burmester.describe.decimals import Decimals
from burmester.describe.dimensions import certain, decimals_of, dimensions, links, worst_errors
from burmester.describe.quality_words import in_short, load_notes, quality_note
from burmester.errors import Advice
from burmester.io.message import print_trimmed, show, wrapped
from burmester.numerics.arrays import FloatArray
from burmester.scene.linkage_scene import scene_at
from burmester.synthesis.result import Synthesis
from burmester.tasks import notation
from burmester.verdicts import explanation
from burmester.verdicts.explanation import share_texts
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import count, figure, in_unit, least_angle

LINKS = ("ground", "driver", "coupler", "follower")
MOST_CUT = 3  # decimals that link lengths in the table may lose on a narrow screen
GAP = 4  # columns between dimensions and sketch
LEAST_SKETCH, MOST_SKETCH = 22, 44  # columns of a sketch beside the dimensions
MAX_POSES = 12  # poses in the table of tolerances
MAX_ROWS = 20  # rows of a task as it was read; of more, the first 18 and the last 2
INDENT = 5  # columns of reasons under their linkage


MOST_ROWS = 14  # lines of the sketch
FAR = 3.0  # sizes of the motion; pivots farther from its middle are outside the sketch
WIDE, HIGH = 2, 4  # dots of a character
# The bit of each dot of a braille character, by row and column.
BITS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
FIXED, MOVING, BLOCK = "▲", "●", "■"  # a pivot on the ground, one on the body, a slider's block
SPARSE = 3  # dots; of the linkage at its last pose one in so many is drawn


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


def table_of(
    heads: Sequence[str],
    rows: Iterable[Sequence[str]],
    title: str | None = None,
    *,
    left: int = 1,
    gap: int = 1,
) -> Table:
    """A table of these columns, the first ones set to the left; what rows have more is left out.

    No cell is wrapped, but that of a type.
    """
    table = new_table(title, gap)
    for k, head in enumerate(heads):
        side: JustifyMethod = "left" if k < left else "right"
        table.add_column(head, justify=side, no_wrap=head != "type")
    for row in rows:
        table.add_row(*row[: len(heads)])
    return table


def show_read(
    columns: Mapping[str, Sequence[str]],
    facts: Iterable[tuple[str, str]],
    findings: Iterable[Advice],
    console: Console,
) -> None:
    """A task as it was read: its rows by columns, of many the first and the last, and facts."""
    table = new_table()
    for head in columns:
        # Square brackets are no style here.
        table.add_column(Text(head), justify="left" if head == "name" else "right", overflow="fold")
    rows = list(zip(*columns.values(), strict=True))
    if len(rows) > MAX_ROWS:
        rows[MAX_ROWS - 2 : -2] = [("...",) * len(columns)]
    for row in rows:
        table.add_row(*map(Text, row))
    print_trimmed(table, console)
    console.print()
    for name, text in facts:
        for line in wrapped(text, console.width, Text(f"{name:10}", style="bold")):
            console.print(line, soft_wrap=True)
    for each in findings:
        console.print()
        show("warning", each, console)


def show_warnings(warnings: Sequence[Advice], console: Console) -> None:
    """Warnings under what came of a task."""
    if warnings:
        console.print()
    for warning in warnings:
        show("warning", warning, console)


def usable_table(synthesis: Synthesis, usable: Sequence[FoundLinkage], console: Console) -> Table:
    """Usable linkages, with as many columns and decimals as the console has room for."""
    decimals = [decimals_of(synthesis, found) for found in usable]
    both = zip(decimals, usable, strict=True)
    most = max((each.lengths for each, found in both if found.linkage.links), default=-1)
    cuts = [most - cut for cut in range(min(MOST_CUT, most) + 1)]
    trials = [(most, 1, True), *((places, 0, dyads) for dyads in (True, False) for places in cuts)]
    for places, gap, dyads in trials if cuts else ():
        shown = [replace(each, lengths=min(each.lengths, places)) for each in decimals]
        table = _usable(synthesis, usable, shown, gap, dyads=dyads)
        if places < most:
            table.title = f"{table.title}; links to {count(places, 'decimal')}"
        if _width(table) <= console.width:
            return table
    for gap, dyads in ((1, True), (0, True), (0, False)):
        table = _usable(synthesis, usable, None, gap, dyads=dyads)
        if _width(table) <= console.width:
            return table
    return _usable(synthesis, usable, None, 0, dyads=False, quality=False)


def _width(table: Table) -> int:
    """The columns that a table of `new_table` takes if no cell is wrapped, as Rich measures it."""
    cells = ([str(column.header), *map(str, column.cells)] for column in table.columns)
    wide = sum(max(cell_len(line) for cell in each for line in cell.split("\n")) for each in cells)
    between = table.padding[1] + 1
    return wide + between * (len(table.columns) - 1)


def _usable(
    synthesis: Synthesis,
    usable: Sequence[FoundLinkage],
    decimals: Sequence[Decimals] | None,
    gap: int,
    *,
    dyads: bool,
    quality: bool = True,
) -> Table:
    # Of the longest name, the second word stands under the first.
    types = [each.type.replace("inverted ", "inverted\n") for each in usable]
    doubts = [" ±" if each.other_types else "" for each in usable]
    columns: dict[str, Sequence[str]] = {"": [each.id for each in usable]}
    columns["type"] = [f"{kind}{doubt}" for kind, doubt in zip(types, doubts, strict=True)]
    if dyads:
        columns["dyads"] = [" ".join(each.ids) for each in usable]
    if decimals is not None:
        lengths = (links(each, own) for each, own in zip(usable, decimals, strict=True))
        columns |= zip(LINKS, zip(*lengths, strict=True), strict=True)
    errors = (worst_errors(synthesis, each) for each in usable)
    columns |= zip(("worst", "angle"), zip(*errors, strict=True), strict=True)
    columns["transm."] = [least_angle(each.least_transmission) for each in usable]
    if quality:
        figures = (in_short(each.quality) for each in usable)
        columns |= zip(("ext.", "sens."), zip(*figures, strict=True), strict=True)
    if synthesis.task.surroundings is not None:
        near = (each.clearance for each in usable)
        columns["clear"] = ["-" if each is None else figure(each.least) for each in near]
    rows = zip(*columns.values(), strict=True)
    return table_of(list(columns), rows, "Usable, the best first", left=2 + dyads, gap=gap)


def unusable(synthesis: Synthesis, found: Sequence[FoundLinkage], width: int) -> Group:
    """Unusable linkages in lines of `width` columns, each with its reasons under it."""
    rows: list[Text] = []
    for each in found:
        dyads = " ".join(dyad.id for dyad in each.dyads_driver_first)
        how = explanation.nearness(each, synthesis.task, synthesis.length)
        if each.error_before_rounding is not None:
            before = notation.length_of(each.error_before_rounding.worst, synthesis.task)
            how += f" (before rounding {before})"
        doubt = sentences.type_doubt(synthesis, each)
        kind = f"{each.type} ({doubt})" if doubt else each.type
        rows += wrapped(f"{kind}, {dyads}: {how}", width, f"{each.id:<{INDENT}}")
        reasons = "; ".join(explanation.reasons(each, synthesis.task))
        rows += wrapped(reasons, width, " " * INDENT)
    return Group(*rows)


def in_full(
    synthesis: Synthesis, best: FoundLinkage, console: Console, *, short: bool = False
) -> Iterator[Text | Table]:
    """One linkage: its dimensions, how certain they are, and what follows of that.

    Beside them, where a terminal can show it and has room, the linkage in braille; else above.
    short: without what a table of linkages says as well.
    """
    unit = in_unit(synthesis.task.length_unit)
    title = Text(f"\n{best.id} in full{unit and ','}{unit}", style="bold")
    table = _dimensions(synthesis, best)
    wide = _measured(table, console)
    if wide > console.width:
        table = _dimensions(synthesis, best, stacked=True)
    room = console.width - wide - GAP
    drawn = sketch(best, min(max(room, LEAST_SKETCH), MOST_SKETCH, console.width))
    if drawn is None or not _shows_braille(console):
        flat = _flat(synthesis, best)
        if flat is not None and _measured(flat, console) <= console.width:
            title, table = Text(), flat
        yield title
        yield table
    elif room < LEAST_SKETCH:
        yield title
        yield Text("\n".join(drawn))
        yield table
    else:
        yield title
        both = Table.grid(padding=(0, GAP, 0, 0))
        both.add_row(table, Text("\n".join(drawn)))
        yield both
    if not short and synthesis.task.gives_room and best.within_tolerance is not None:
        yield _shares(synthesis, best)
    quality = quality_note(best, synthesis.task, short=short)
    if quality is not None:
        yield Text(quality)
    uncertainty, of_type = sentences.uncertainty_note, sentences.type_note
    for note in sentences.NOTES:
        text = note(synthesis, best) if note is not sentences.standard_note else None
        if text is not None and (best.usable or note not in (uncertainty, of_type)):
            yield Text(text, style="dim" if note is uncertainty else "")
    for text in load_notes(best.loads, synthesis.task):
        yield Text(text)
    if lines := cognate_lines(synthesis, best):
        yield Text(f"\nThe curve of {best.id} by its cognates", style="bold")
        for line in lines:
            yield Text(f"- {line}")


def _dimensions(synthesis: Synthesis, best: FoundLinkage, stacked: bool = False) -> Table:
    """The dimensions of a linkage; stacked: the half-widths under the values."""
    table = Table.grid(padding=(0, 2, 0, 0))
    # What the poses leave open of a linkage says nothing where that one does not meet them.
    exact, last = certain(synthesis, best) or not best.usable, None
    for dyad, what, value, give in dimensions(synthesis, best):
        cells = (f"{value}\n{give}",) if stacked and give else (value, give)
        table.add_row("" if dyad == last else dyad, what, *(cells[:1] if exact else cells))
        last = dyad
    if best.linkage.links is not None:
        ground, _, coupler, _ = links(best, decimals_of(synthesis, best))
        table.add_row("", "ground link", ground)
        table.add_row("", "coupler", coupler)
    return table


def _measured(table: Table, console: Console) -> int:
    """The columns that a table would take if there were room for all."""
    unlimited = console.options.update(max_width=10 * console.width)
    return console.measure(table, options=unlimited).maximum


def _flat(synthesis: Synthesis, best: FoundLinkage) -> Table | None:
    """The dimensions of a linkage of pins without half-widths, a row a dyad; None of another."""
    if best.linkage.links is None or not (certain(synthesis, best) or not best.usable):
        return None
    table = Table.grid(padding=(0, 3, 0, 0))
    rows = dimensions(synthesis, best)
    heads = *(each.what for each in rows[:2]), f"length{in_unit(synthesis.task.length_unit)}"
    table.add_row(Text(best.id, style="bold"), *heads)
    for three in (rows[:3], rows[3:]):
        table.add_row(three[0].dyad, *(each.value for each in three))
    ground, _, coupler, _ = links(best, decimals_of(synthesis, best))
    table.add_row("", f"ground link  {ground}", f"coupler  {coupler}")
    return table


def _shares(synthesis: Synthesis, best: FoundLinkage) -> Table:
    """What each pose uses of its tolerances; of many poses those that use most."""
    task, texts = synthesis.task, share_texts(best, synthesis.task)
    assert best.within_tolerance is not None
    rows = np.arange(len(texts))
    if len(rows) > MAX_POSES:
        rows = np.sort(np.argsort(-best.within_tolerance.max(axis=1))[:MAX_POSES])
    labels = notation.pose_labels(task, rows.tolist(), "number and name")
    table = Table.grid(padding=(0, 2, 0, 0))
    most = " (those that use most)" if len(rows) < len(texts) else ""
    table.add_row(f"of the tolerance{most}", "x", "y", "angle", style="dim")
    for column in table.columns[1:]:
        column.justify = "right"
    for label, row in zip(labels, rows.tolist(), strict=True):
        noun = "point" if task.free_angles[row] else "pose"
        table.add_row(Text(f"{noun} {label}"), *texts[row])
    return table


def _shows_braille(console: Console) -> bool:
    return (
        console.is_terminal
        and not console.is_dumb_terminal
        and not console.legacy_windows
        and console.encoding.lower().startswith("utf")
    )


def sketch(found: FoundLinkage, columns: int) -> list[str] | None:
    """A linkage in lines of at most `columns` characters; None where it is nowhere near the poses.

    1 and the last pose's number stand at the origin of the body, where they have room.
    """
    places = found.error.places
    reached = np.flatnonzero(np.isfinite(places.angle))
    if not len(reached):
        return None
    first, last = int(reached[0]), int(reached[-1])
    origins = places.translation[reached]
    scenes = {k: scene_at(found, k) for k in (last, first)}
    middle = (origins.min(axis=0) + origins.max(axis=0)) / 2
    joints = [pivot.at for scene in scenes.values() for pivot in scene.pivots]
    size = float(np.ptp(origins, axis=0).max()) or float(
        max((np.abs(joint - middle).max() for joint in joints), default=1.0)
    )
    near = [each for each in joints if np.abs(each - middle).max() <= FAR * size]
    canvas = _Canvas.around(np.array([*origins, *near]), columns)
    for k, scene in scenes.items():
        for role, points in scene.shapes:
            if role in ("spring", "hand"):
                continue
            ends = np.vstack([points, points[:1]]) if role == "body" else points
            for line in pairwise(ends):
                canvas.draw(*line, every=1 if k == first else SPARSE)
    for k in dict.fromkeys((first, last)):
        canvas.put(places.translation[k], str(k + 1))
    for pivot in scenes[first].pivots:
        moving = MOVING if pivot.block is None else BLOCK
        canvas.put(pivot.at, FIXED if pivot.fixed else moving)
    return canvas.lines()


class _Canvas:
    """Dots in a grid, with characters over them."""

    def __init__(self, low: FloatArray, dot: float, columns: int, rows: int) -> None:
        self.low, self.dot = low, dot
        self.bits = np.zeros((rows, columns), dtype=np.int64)
        self.over: dict[tuple[int, int], str] = {}

    @classmethod
    def around(cls, points: FloatArray, columns: int) -> _Canvas:
        """A canvas for these points (n, 2), in all of its columns or all of its rows."""
        low, high = points.min(axis=0), points.max(axis=0)
        extent = np.maximum(high - low, 1e-3 * float((high - low).max()) or 1.0)
        room = np.array([WIDE * (columns - 1), HIGH * (MOST_ROWS - 1)])
        dot = float((extent / room).max())
        across, up = (int(each) for each in np.floor(extent / dot + 0.5))
        return cls(low, dot, across // WIDE + 1, up // HIGH + 1)

    def _dots(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Dots from the left and from the top of points (*, 2)."""
        at = np.floor((points - self.low) / self.dot + 0.5)
        return at[..., 0], HIGH * len(self.bits) - 1 - at[..., 1]

    def draw(self, start: FloatArray, end: FloatArray, every: int) -> None:
        """A straight line, one in `every` dots of it, as far as it is inside."""
        count = int(min(np.abs(end - start).max() / self.dot + 1, 1e5))
        share = np.linspace(0, 1, count + 1)[::every, None]
        for x, y in np.column_stack(self._dots(start + share * (end - start))).tolist():
            row, column = int(y // HIGH), int(x // WIDE)
            if 0 <= row < self.bits.shape[0] and 0 <= column < self.bits.shape[1]:
                self.bits[row, column] |= BITS[int(y % HIGH)][int(x % WIDE)]

    def put(self, point: FloatArray, text: str) -> None:
        """Characters at a point, unless it is outside."""
        x, y = self._dots(point)
        row, column = int(y // HIGH), int(x // WIDE)
        if not (0 <= row < self.bits.shape[0] and 0 <= column < self.bits.shape[1]):
            return
        column = max(0, min(column, self.bits.shape[1] - len(text)))
        beside = (self.over.get((row, column + k), "") for k in range(-1, len(text) + 1))
        if not (text.isdigit() and any(each.isdigit() for each in beside)):
            self.over |= {(row, column + k): char for k, char in enumerate(text)}

    def lines(self) -> list[str]:
        """The characters, line by line, without blanks at the ends."""
        return ["".join(self._row(row)).rstrip() for row in range(len(self.bits))]

    def _row(self, row: int) -> Iterable[str]:
        for column, bits in enumerate(self.bits[row].tolist()):
            yield self.over.get((row, column)) or (chr(0x2800 + bits) if bits else " ")
