"""A drawing as a display list: the plates laid out for cutting, the assembly, and all that is told.

DXF and SVG write the same list, in millimetres, PDF its items page by page; their readers return
items, which are compared once.

E160 the file does not contain the linkage
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import chain, zip_longest
from typing import Literal, NamedTuple, Self, TypeAlias, final

import numpy as np

from burmester.export.description import description, dimension_notes, length_decimals, spring_notes
from burmester.export.drawings.dimension_lines import DimensionLine
from burmester.export.drawings.sheet import (
    Outlines,
    Sheet,
    beside,
    hatch,
    joint_names,
    name_start,
    notes_on,
    sheet_of,
)
from burmester.export.options import Options, require_equal
from burmester.export.parts.plate import Plate, moved, slot_outline
from burmester.export.parts.plates import Assembly, assembly_of, pivots_of
from burmester.geometry.displacement import Displacement
from burmester.loads.masses import body_named
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

MAX_BULGE = 0.57  # bulge above which an arc is drawn as two
TICK = 0.3  # of the height of text: half of a mark's arms

Kind: TypeAlias = Literal["outline", "circle", "line", "arrow", "text"]
Role: TypeAlias = Literal[
    "outline", "hole", "slot", "mark", "body", "keep-out", "hatch", "pose", "name", "note",
    "dimension", "ruler", "overlap",
]  # fmt: skip


@final
class Item(NamedTuple):
    """A closed outline (k, 3) with bulges, a circle (3,), a line (2, 2), an arrow or a text (2,).

    role: what it shows.  group: of what, the name of a plate, before which "placed-" stands in the
    assembly, or "".  text: of a text, which begins there; that of a dimension has its middle there.
    """

    kind: Kind
    role: Role
    at: FloatArray
    group: str = ""
    text: str = ""


@final
@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """A drawing, millimetres: what is on it, without dimension lines, and these by plate.

    notes: what is written below, the first a title.
    """

    assembly: Assembly
    sheet: Sheet
    notes: list[str]
    items: tuple[Item, ...]
    dimensions: tuple[tuple[str, DimensionLine], ...]

    @classmethod
    def of(cls, chosen: Candidate, options: Options, unit: str = "mm") -> Self:
        """The drawing of a linkage; unit: of the lengths that it tells.  Raises E162 and E163."""
        assembly = assembly_of(chosen, options)
        outlines = Outlines.of(chosen.task, assembly.reference)
        notes = description(chosen, options, unit) + dimension_notes(chosen, options, unit)
        notes += spring_notes(chosen, options, unit) + notes_on(assembly)
        decimals = length_decimals(chosen, options, unit)
        told = options.dimensions
        sheet = sheet_of(assembly, outlines, len(notes), decimals, dimensions=told, unit=unit)
        items = [
            *_parts(assembly, sheet),
            *_poses(assembly.reference.poses, sheet),
            *_anchors(chosen, assembly, sheet),
            *(
                Item("text", "note", sheet.notes - [0, 1.6 * k * sheet.letters], text=note)
                for k, note in enumerate(notes)
            ),
            *_outlines(outlines, sheet.letters),
        ]
        dimensions = [(part.plate.name, line) for part in sheet.parts for line in part.lines]
        return cls(assembly, sheet, notes, tuple(items), tuple(dimensions))


def items_of_line(line: DimensionLine, group: str) -> Iterable[Item]:
    """A dimension line of a plate."""
    yield from (Item("line", "dimension", ends, group) for ends in line.lines)
    yield from (Item("arrow", "dimension", corners, group) for corners in line.arrows)
    yield Item("text", "dimension", line.at, group, line.text)


def _parts(assembly: Assembly, sheet: Sheet) -> Iterable[Item]:
    """The plates laid out with their names, and in the assembly."""
    for part, label in zip(sheet.parts, sheet.labels, strict=True):
        yield from items_of_plate(part.plate, part.place, part.plate.name)
        yield from _marks(part.plate, part.place, sheet, part.plate.name)
        yield Item("text", "name", label, part.plate.name, part.label)
    for plate in assembly.plates:
        place, group = plate.at(assembly.drawn), f"placed-{plate.name}"
        yield from items_of_plate(plate, place, group)
        yield from _marks(plate, place, sheet, group)
    for name, at in joint_names(assembly, sheet):
        yield Item("text", "name", at, "joints", name)


def items_of_plate(plate: Plate, place: Displacement, group: str) -> Iterable[Item]:
    """What is cut of a plate at a place."""
    outline, holes, slots, _ = moved(plate, place)
    yield Item("outline", "outline", outline, group)
    yield from (Item("circle", "hole", hole, group) for hole in holes)
    yield from (Item("outline", "slot", slot_outline(slot), group) for slot in slots)


def cross(at: FloatArray, arm: float, role: Role, group: str = "") -> Iterable[Item]:
    """Two lines that cross at a point."""
    for way in arm * np.eye(2):
        yield Item("line", role, np.stack([at - way, at + way]), group)


def _marks(plate: Plate, place: Displacement, sheet: Sheet, group: str) -> Iterable[Item]:
    for mark in place.act(plate.marks):
        yield from cross(mark, TICK * sheet.letters, "mark", group)


def _outlines(outlines: Outlines, letters: float) -> Iterable[Item]:
    """The body at every pose, and the regions with hatches and names."""
    for corners in outlines.body if outlines.body.size else ():
        yield Item("outline", "body", _straight(corners))
    for k, (name, corners) in enumerate(outlines.regions):
        group = f"region-{k + 1}"
        yield Item("outline", "keep-out", _straight(corners), group)
        for ends in hatch(corners, letters):
            yield Item("line", "hatch", ends, group)
        if name:
            yield Item("text", "keep-out", name_start(name, corners, letters), group, name)


def _straight(corners: FloatArray) -> FloatArray:
    """Corners (k, 2) as an outline (k, 3) without arcs."""
    return np.column_stack([corners, np.zeros(len(corners))])


def _poses(poses: Displacement, sheet: Sheet) -> Iterable[Item]:
    axes = np.array([[0.0, 0.0], [sheet.axes, 0.0], [0.0, sheet.axes / 2]])
    for number in range(poses.shape[0]):
        origin, *ends = poses[number][None].act(axes)
        for end in ends:
            yield Item("line", "pose", np.stack([origin, end]))
        yield Item("text", "pose", beside(poses[number], sheet), text=str(number + 1))


def _anchors(chosen: Candidate, assembly: Assembly, sheet: Sheet) -> Iterable[Item]:
    """Crosses where springs are attached in the assembly, with their numbers, on the sheet."""
    springs = chosen.task.loads.springs if chosen.task.loads is not None else ()
    for number, spring in enumerate(springs, start=1):
        for end in () if spring.kind == "torsion" else spring.ends:
            body = assembly.drawn[body_named(end.link, assembly.reference)]
            at = body.act(np.array(end.point) * assembly.reference.scale)
            alone = spring.kind == "counterweight" and end is not spring.ends[1]
            if not alone and ((at > sheet.low) & (at < sheet.high)).all():
                yield from cross(at, TICK * sheet.letters, "pose")
                yield Item("text", "pose", at + TICK * sheet.letters, text=f"S{number}")


def halved(outline: FloatArray, largest: float = MAX_BULGE) -> FloatArray:
    """The outline with its arcs in two as long as one has a larger bulge.

    By itself arcs of a third of a turn or more: its ends and its radius determine half a circle to
    half the digits only.
    """
    rows: list[list[float]] = []
    for (x0, y0, bulge), (x, y, _) in zip(
        outline.tolist(), np.roll(outline, -1, axis=0).tolist(), strict=True
    ):
        if abs(bulge) < largest:
            rows.append([x0, y0, bulge])
            continue
        half = math.tan(math.atan(bulge) / 2)
        middle = (x0 + x + bulge * (y - y0)) / 2, (y0 + y - bulge * (x - x0)) / 2
        rows += [[x0, y0, half], [*middle, half]]
    small = all(abs(bulge) < largest for _, _, bulge in rows)
    return np.array(rows) if small else halved(np.array(rows), largest)


def require_drawing(
    read: Sequence[Item], drawing: Drawing, tolerance: float, escaped: Callable[[str], str]
) -> None:
    """Raise E160 unless a drawing that was read back is this one.

    The holes of the assembly are at the pivots of the linkage, too.  escaped: how the format
    writes a text.
    """
    lines = (items_of_line(line, plate) for plate, line in drawing.dimensions)
    require_items(read, [*drawing.items, *chain(*lines)], tolerance, escaped)
    holes = [each for each in read if each.role == "hole"]
    for pivot in pivots_of(drawing.assembly):
        if pivot.point is not None:
            groups = [f"placed-{name}" for name in pivot.plates]
            own = [each.at[:2] for each in holes if each.group in groups]
            gap = np.linalg.norm(np.reshape(own, (-1, 2)) - pivot.point, axis=1)
            require_equal(
                f"a pivot in the {pivot.plates[0]}", gap.min(initial=np.inf), 0, tolerance
            )


def require_items(
    read: Sequence[Item],
    wanted: Sequence[Item],
    tolerance: float,
    escaped: Callable[[str], str] = str,
) -> None:
    """Raise E160 unless every item is there and no other one, in the order of its role."""
    for role in dict.fromkeys(each.role for each in (*wanted, *read)):
        one, two = ([each for each in items if each.role == role] for items in (read, wanted))
        require_equal(f"how many items there are of {role}", len(one), len(two), 0)
        for got, own in zip_longest(one, two):
            what = f"{own.role} {own.group or own.text}"
            require_equal(f"the kind of {what}", got.kind == own.kind, True, 0)
            require_equal(f"the text of {what}", got.text == escaped(own.text), True, 0)
            at = halved(own.at) if got.kind == "outline" and len(got.at) != len(own.at) else own.at
            require_equal(f"{what}", got.at, at, tolerance)
