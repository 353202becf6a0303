"""Poses pasted from a CAD program's panels: labelled values, or points in brackets with an angle.

    X = 12.3 mm  Y = 4.5 mm  Angle = 30 deg      (12.3, 4.5, 0.0)  30°
    X: 12.3 mm                                   <12.3; 4.5; 0.0> 30 deg
    Y: 4.5 mm                                    P2 [12.3 mm, 4.5 mm] angle 0.52 rad
    Angle: 30 deg

A pose ends where its first label comes again.  Labels are names of columns (`columns`), and every
pose has the same ones.  A bracket holds two or three numbers; commas between them are followed by
blanks everywhere or nowhere, so that a decimal comma never passes for one of them.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from burmester.errors import InputError
from burmester.io.reading.pose_table import PoseTable, Source, shown
from burmester.io.reading.tables.cell_numbers import CellNumbers, not_a_number
from burmester.io.reading.tables.columns import read_columns
from burmester.io.reading.tables.grid import Grid, Row
from burmester.io.reading.tables.pose_rows import poses_of
from burmester.wording import listed

MAX_LINE_CHARACTERS = 500  # of a line; a longer one is no panel's

_LINE = re.compile(r"(?m)^[^\S\n]*[^\s#].*$")
_NUMBER = r"[-+\u2212]?[.,]?[0-9]+(?:[.,][0-9]+)*(?:[eE][-+]?[0-9]+)?"  # no comma at its end
_WORD = r"[^\W\d_]+"
_LABELLED = re.compile(
    rf"(?P<label>\u2206?{_WORD}(?:[ _]{_WORD})?)[ \t]*[:=][ \t]*(?P<value>{_NUMBER})"
    rf"(?:[ \t]*(?P<unit>°|\"|(?!{_WORD}[ \t]*[:=]){_WORD}))?"
)
_BETWEEN = re.compile(r"[\s,;|]*")
_BRACKETED = re.compile(
    r"(?P<name>[^()<>\[\]{}]*?)[\s:=]*[(<\[{](?P<point>[^()<>\[\]{}]*)[)>\]}]"
    rf"[\s,;@]*(?:angle|rotation|rot)?[\s:=]*(?P<angle>{_NUMBER})[ \t]*(?P<unit>°|{_WORD})?[\s,;]*",
    re.IGNORECASE,
)
_COORDINATE = re.compile(rf"(?P<value>{_NUMBER})(?:[ \t]*(?P<unit>{_WORD}|\"))?")
_DIFFERENCES = ("\u03b4", "\u2206", "delta", "d")  # what a distance begins with


class _Cell(NamedTuple):
    """A value as it stands."""

    label: str
    text: str
    unit: str
    at: int  # where it begins in the text

    @property
    def name(self) -> str:
        """The label with its unit, as the name of a column has it."""
        return f"{self.label} ({self.unit})" if self.unit else self.label


def is_cad_text(text: str) -> bool:
    """Whether the first line of a text is a labelled value or a point in brackets with an angle."""
    line = _LINE.search(text)
    if line is None:
        return False
    words = line[0].strip()
    if len(words) > MAX_LINE_CHARACTERS:
        return False
    return bool(_LABELLED.match(words) or _BRACKETED.fullmatch(words))


def read_cad_rows(source: Source) -> PoseTable:
    """The poses in such a text; raises E102 to E108, and E113 where z changes."""
    first = next(_LINE.finditer(source.text))
    labelled = _LABELLED.match(first[0].strip())
    poses = _labelled_poses(source) if labelled else _bracketed_poses(source)
    rows = tuple(
        Row(source, first.start(), [cell.text for cell in cells], tuple(cell.at for cell in cells))
        for cells in poses
    )
    names = [cell.name for cell in poses[0]]
    for i, cell in enumerate(poses[0]):
        if _is_difference(cell):
            message = f"{cell.label} is a difference of places, not a place"
            help = "paste the coordinates of the point itself"
            raise InputError("E107", message, where=rows[0].where(i), help=help)
    columns = read_columns(names, rows[0].where, "delete it from every pose: {}")
    for number, (cells, row) in enumerate(zip(poses, rows, strict=True), start=1):
        own = [cell.name for cell in cells]
        if list(map(str.lower, own)) != list(map(str.lower, names)):
            message = f"pose {number} has {listed(own)}, the first one {listed(names)}"
            help = "give every pose the same values in the same order, with the same units"
            raise InputError("E106", message, where=row.where(0), help=help)
    grid = Grid(
        source,
        ";",
        names,
        columns,
        rows[0].where(columns.indices.get("angle")),
        "write its unit behind every angle (30° or 0.5 rad)",
        listed=rows,
        ignore="leave it out of every pose",
    )
    return poses_of(grid, CellNumbers(";"))


def _labelled_poses(source: Source) -> list[list[_Cell]]:
    """Values with labels, a pose up to where the first label comes again."""
    poses: list[list[_Cell]] = []
    for line in _LINE.finditer(source.text):
        _require_short(source, line)
        at = line.start() + len(line[0]) - len(line[0].lstrip())
        while at < line.end():
            found = _LABELLED.match(source.text, at, line.end())
            if found is None:
                message = f"this is no labelled value: {shown(source.text[at : line.end()])}"
                help = "write every value as `X = 12.3 mm`, or put all poses into a CSV file"
                where = source.where(at, line.end() - at)
                raise InputError("E104", message, where=where, help=help)
            unit = "in" if found["unit"] == '"' else found["unit"] or ""
            cell = _Cell(found["label"].strip(), found["value"], unit, found.start("value"))
            if not poses or cell.label.lower() == poses[-1][0].label.lower():
                poses.append([])
            poses[-1].append(cell)
            between = _BETWEEN.match(source.text, found.end(), line.end())
            at = between.end() if between else found.end()
    return poses


def _bracketed_poses(source: Source) -> list[list[_Cell]]:
    """Points in brackets, each with its angle behind it, a pose a line."""
    poses: list[list[_Cell]] = []
    spaced: set[bool] = set()
    for line in _LINE.finditer(source.text):
        _require_short(source, line)
        found = _BRACKETED.fullmatch(line[0].rstrip())
        number, where = len(poses) + 1, source.where(line.start(), len(line[0].rstrip()))
        if found is None:
            message = f"row {number} is no point in brackets with an angle behind it"
            help = "write every pose as `(12.3, 4.5) 30°`, or put all poses into a CSV file"
            raise InputError("E106", message, where=where, help=help)
        point = found["point"]
        separator = ";" if ";" in point else ","
        parts = point.split(separator)
        if separator == ",":
            spaced |= {part[:1].isspace() for part in parts[1:]}
        start = line.start() + found.start("point")
        cells = []
        for label, part in zip("xyz", parts, strict=False):
            text = part.strip()
            coordinate = _COORDINATE.fullmatch(text)
            at = start + len(part) - len(part.lstrip())
            if coordinate is None or (separator == "," and "," in text):
                where = source.where(at, max(len(text), 1))
                raise not_a_number(text, number, where)
            unit = "in" if coordinate["unit"] == '"' else coordinate["unit"] or ""
            cells.append(_Cell(label, coordinate["value"], unit, at))
            start += len(part) + 1
        if len(parts) not in (2, 3) or len(spaced) > 1:
            message = f"row {number} has {len(parts)} numbers in its bracket"
            if len(parts) in (2, 3):
                message = "some commas in brackets have a blank behind them and some have none"
            why = "a comma may be a decimal mark, or stand between two numbers"
            help = "write decimal points, and semicolons between the numbers: (12.3; 4.5; 0)"
            raise InputError("E104", message, where=where, why=why, help=help)
        unit = found["unit"] or ""
        cells.append(_Cell("angle", found["angle"], unit, line.start() + found.start("angle")))
        cells.append(_Cell("name", found["name"].strip(), "", line.start()))
        poses.append(cells)
    return poses if any(cells[-1].text for cells in poses) else [cells[:-1] for cells in poses]


def _require_short(source: Source, line: re.Match[str]) -> None:
    if len(line[0]) > MAX_LINE_CHARACTERS:
        message = f"a line of {len(line[0])} characters is no pose from a panel"
        help = "put all poses into a CSV file, a pose a line"
        raise InputError("E106", message, where=source.where(line.start()), help=help)


def _is_difference(cell: _Cell) -> bool:
    label = cell.label.lower()
    return any(
        label.startswith(start) and label.removeprefix(start).strip(" _") in ("x", "y", "z")
        for start in _DIFFERENCES
    )
