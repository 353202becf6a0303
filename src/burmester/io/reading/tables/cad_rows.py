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
from burmester.io.reading import pose_table
from burmester.io.reading.pose_table import PoseTable, Rows, Source, numeric_roles
from burmester.io.reading.tables.columns import read_columns
from burmester.io.reading.tables.csv_poses import require_one_mark
from burmester.io.reading.tables.direction_columns import require_directions
from burmester.io.reading.tables.height import height_notes
from burmester.io.reading.tables.wrong_numbers import not_a_number
from burmester.wording import listed

__all__ = ["is_cad_text", "read_cad_rows"]

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
    names = [cell.name for cell in poses[0][1]]

    def where(i: int | None) -> str:
        if i is None:
            return source.where(first.start(), len(first[0]))
        return _where(source, poses[0][1][i])

    for i, cell in enumerate(poses[0][1]):
        if _is_difference(cell):
            message = f"{cell.label} is a difference of places, not a place"
            help = "paste the coordinates of the point itself"
            raise InputError("E107", message, where=where(i), help=help)
    columns = read_columns(names, where, "delete it from every pose: {}")
    for number, (_, cells) in enumerate(poses, start=1):
        _require_alike(source, number, cells, names)
    texts = _plain(source, [cells for _, cells in poses])
    by_role = {role: [row[i] for row in texts] for role, i in columns.indices.items()}
    own = [name for name, _ in poses]
    if any(own) and "name" not in by_role:
        by_role["name"] = own
    numeric = {role: by_role[role] for role in numeric_roles(by_role)}
    rows = Rows.read(numeric | ({"name": by_role["name"]} if "name" in by_role else {}))

    def locate(row: int | None) -> str:
        return where(None) if row is None else _where(source, poses[row][1][0])

    require_directions(rows, locate)
    angle = columns.indices.get("angle")
    return PoseTable(
        rows,
        length_unit=columns.length_unit,
        angle_unit=columns.angle_unit,
        where=where(angle),
        say_unit="write its unit behind every angle (30° or 0.5 rad)",
        locate_row=locate,
        notes=(
            *source.notes,
            *height_notes(by_role.get("z"), rows, locate, "leave it out of every pose"),
        ),
    )


def _labelled_poses(source: Source) -> list[tuple[str, list[_Cell]]]:
    """Values with labels, a pose up to where the first label comes again."""
    poses: list[tuple[str, list[_Cell]]] = []
    for line in _LINE.finditer(source.text):
        _require_short(source, line)
        at = line.start() + len(line[0]) - len(line[0].lstrip())
        while at < line.end():
            found = _LABELLED.match(source.text, at, line.end())
            if found is None:
                message = (
                    f"this is no labelled value: {pose_table.shown(source.text[at : line.end()])}"
                )
                help = "write every value as `X = 12.3 mm`, or put all poses into a CSV file"
                where = source.where(at, line.end() - at)
                raise InputError("E104", message, where=where, help=help)
            unit = "in" if found["unit"] == '"' else found["unit"] or ""
            cell = _Cell(found["label"].strip(), found["value"], unit, found.start("value"))
            if not poses or cell.label.lower() == poses[-1][1][0].label.lower():
                poses.append(("", []))
            poses[-1][1].append(cell)
            between = _BETWEEN.match(source.text, found.end(), line.end())
            at = between.end() if between else found.end()
    return poses


def _bracketed_poses(source: Source) -> list[tuple[str, list[_Cell]]]:
    """Points in brackets, each with its angle behind it, a pose a line."""
    poses: list[tuple[str, list[_Cell]]] = []
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
                raise not_a_number(text, text, row=number, unit=None, where=where, separator=",")
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
        poses.append((found["name"].strip(), cells))
    return poses


def _require_short(source: Source, line: re.Match[str]) -> None:
    if len(line[0]) > MAX_LINE_CHARACTERS:
        message = f"a line of {len(line[0])} characters is no pose from a panel"
        help = "put all poses into a CSV file, a pose a line"
        raise InputError("E106", message, where=source.where(line.start()), help=help)


def _require_alike(source: Source, number: int, cells: list[_Cell], names: list[str]) -> None:
    """Refuse a pose with other labels or units than the first one: E106."""
    own = [cell.name for cell in cells]
    if [name.lower() for name in own] == [name.lower() for name in names]:
        return
    message = f"pose {number} has {listed(own)}, the first one {listed(names)}"
    help = "give every pose the same values in the same order, with the same units"
    raise InputError("E106", message, where=_where(source, cells[0]), help=help)


def _plain(source: Source, rows: list[list[_Cell]]) -> list[list[str]]:
    """The numbers with decimal points; raises E103 and E104."""
    marks: dict[str, str] = {}
    out = []
    for number, cells in enumerate(rows, start=1):
        plain_row = []
        for cell in cells:
            plain, mark = pose_table.plain_number(cell.text, ";")
            if mark is None:
                raise not_a_number(
                    cell.text,
                    plain,
                    row=number,
                    unit=None,
                    where=_where(source, cell),
                    separator=";",
                )
            marks.setdefault(mark, _where(source, cell))
            plain_row.append(plain)
        out.append(plain_row)
    require_one_mark(marks)
    return out


def _is_difference(cell: _Cell) -> bool:
    label = cell.label.lower()
    return any(
        label.startswith(start) and label.removeprefix(start).strip(" _") in ("x", "y", "z")
        for start in _DIFFERENCES
    )


def _where(source: Source, cell: _Cell) -> str:
    return source.where(cell.at, len(cell.text))
