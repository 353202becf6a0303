"""Poses in CSV: a header, then a pose a line, cells parted by commas, tabs or semicolons.

Where commas do not part the cells they may be decimal marks, if the numbers prove it.
Blocks of plain rows are read at once; the others cell by cell, to say what is wrong and where.
The errors are those that `burmester.io.poses` lists.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.io import table
from burmester.io.table import NUMERIC, PoseTable, Rows, Source

__all__ = ["BLOCK", "read_csv"]

BLOCK = 1 << 20  # characters parsed at a time, so that a million rows need little memory

_COLUMNS: dict[str, tuple[str, str | None]] = {  # name -> role and unit
    **{name: (name, None) for name in ("x", "y", "weight", "name", "exact")},
    **{f"{axis}_{u}": (axis, u) for axis in "xy" for u in ("um", "mm", "cm", "m", "in", "ft")},
    **dict.fromkeys(("angle", "theta", "phi", "rotation"), ("angle", None)),
    **{f"angle_{unit}": ("angle", unit) for unit in table.UNITS},
}
_MARK = f"(?i:{'|'.join(filter(None, table.MARKS))})?"
_LINE = re.compile(r"(?m)^[^\S\n]*[^\s#].*$")  # neither blank nor a comment


class _Header(NamedTuple):
    """What the header line says."""

    source: Source
    end: int  # where the rows begin in the text
    separator: str
    names: list[str]
    columns: dict[str, int]  # role -> place in a row
    units: dict[str, str | None]  # role -> unit
    where: str  # the angle column


def read_csv(source: Source) -> PoseTable:
    """A header and a pose a line; raises E102 to E108."""
    text, header = source.text, _header(source)
    marks: dict[str, str] = {}  # what `plain_number` calls a mark -> where it is first seen
    blocks: list[Rows] = []
    start, row = header.end, 1
    while start < len(text):
        end = text.find("\n", start + BLOCK)
        end = end if end >= 0 else len(text)
        rows = _plain_rows(text[start:end], header, marks)
        if rows is None:
            rows = _checked_rows(_LINE.finditer(text, start, end), header, marks, row)
        blocks.append(rows)
        start, row = end + 1, row + len(rows.values)
    if row == 1:
        raise table.empty("there is only a header")
    _require_one_mark(marks)
    return PoseTable(
        Rows.joined(blocks),
        length_unit=header.units["x"],
        angle_unit=header.units["angle"],
        where=header.where,
        say_unit="name the column `angle_deg` or `angle_rad` in the header",
    )


def _header(source: Source) -> _Header:
    """The first line that is neither blank nor a comment, understood."""
    found = _LINE.search(source.text)
    if not found:
        raise table.empty("there are only comments")
    separator = next((s for s in ",\t;" if s in found[0]), ",")
    cells = _split(found[0], separator)
    where = functools.partial(_where_cell, source, found.start(), cells)
    names = [_unquoted(cell).lower() for cell in cells]
    columns: dict[str, int] = {}
    units: dict[str, str | None] = {}
    unknown: list[int] = []
    for i, name in enumerate(names):
        if name not in _COLUMNS:
            unknown += [] if name.startswith("#") else [i]
            continue
        role, unit = _COLUMNS[name]
        if role in columns:
            message = f"two columns for {role}: {names[columns[role]]} and {name}"
            help = "delete one of the two columns"
            raise InputError("E108", message, where=where(i), help=help)
        columns[role], units[role] = i, unit
    if missing := [role for role in NUMERIC[:3] if role not in columns]:
        where_all = source.where(found.start(), len(found[0]))
        raise _no_header(found[0], names, missing, where_all)
    if unknown:
        name = names[unknown[0]].replace('"', "")
        message = f"the column {table.shown(name)} is not known"
        why = (
            "known are x, y (or x_mm, y_mm and so on), angle_deg, angle_rad, weight, exact and name"
        )
        help = f'delete the column, or name it "#{name}" (with the quotes) to have it ignored'
        raise InputError("E107", message, where=where(unknown[0]), why=why, help=help)
    if units["x"] != units["y"]:
        message = f"x is in {units['x'] or 'no unit'}, y in {units['y'] or 'no unit'}"
        help = "give both columns the same unit"
        raise InputError("E108", message, where=where(columns["y"]), help=help)
    angle = where(columns["angle"], "angle")
    return _Header(source, found.end() + 1, separator, names, columns, units, angle)


def _no_header(line: str, names: list[str], missing: list[str], where: str) -> InputError:
    """E105; a line of numbers is told the header that would fit above it."""
    message = f"the header has no column for {' and '.join(missing)}"
    why: str | None = f"it has: {', '.join(map(table.shown, names))}"
    help = (
        "name the columns x, y and angle_deg (or angle_rad), with commas, semicolons or tabs "
        "between them; x_mm and y_mm (um, mm, cm, m, in, ft) state the length unit"
    )
    separator = next((s for s in "\t;," if s in line), ",")  # commas may be decimal marks
    cells = [_unquoted(cell) for cell in _split(line, separator)]
    if all(table.NUMBER_LIKE.fullmatch(cell) for cell in cells):
        names = ["x", "y", "angle_deg", *(f"#{i}" for i in range(4, len(cells) + 1))]
        message, why = "there is no header: the first line is all numbers", None
        help = f"put this line on top: `{separator.join(names)}` (or angle_rad in it)"
    return InputError("E105", message, where=where, why=why, help=help)


def _plain_rows(block: str, header: _Header, marks: dict[str, str]) -> Rows | None:
    """The rows of a block in which nothing is unusual, fast; None if something is."""
    separator, width = header.separator, len(header.names)
    mark = "," if "," in marks else "."  # a comma once it is proved to be a decimal one
    text, number = rf'[^{separator}\n"#]*+', rf"[-+{mark}0-9eE]*+"
    looks = {"name": text, "exact": _MARK}
    like = {place: looks.get(role, number) for role, place in header.columns.items()}
    row = separator.join(like.get(i, text) for i in range(width))
    if not re.fullmatch(rf"(?:{row}\n)*+{row}", block):
        return None
    cells = block.replace("\n", separator).split(separator)
    columns = {role: cells[place::width] for role, place in header.columns.items()}
    for role, column in columns.items():
        if role == "name":
            columns[role] = [name.strip() for name in column]
        elif mark == ",":
            columns[role] = [cell.replace(",", ".") for cell in column]
        elif any("." in cell for cell in column):
            marks["."] = ""
    try:  # of these characters alone, float() takes exactly what plain_number() does
        rows = Rows.read(columns)
    except ValueError:
        return None
    return rows if np.isfinite(rows.values).all() else None


def _checked_rows(
    lines: Iterable[re.Match[str]], header: _Header, marks: dict[str, str], row: int
) -> Rows:
    """The rows in any lines, cell by cell; the first of them is number `row` of the file."""
    columns: dict[str, list[str]] = {role: [] for role in header.columns}
    for line in lines:
        cells = _split(line[0], header.separator)
        if len(cells) != len(header.names):
            raise _wrong_width(line, cells, header, row)
        for role, place in header.columns.items():
            cell = _unquoted(cells[place])
            if role == "exact" and cell.lower() not in table.MARKS:
                where = _where_cell(header.source, line.start(), cells, place, role)
                raise _not_a_mark(cell, row, where)
            if role in NUMERIC:
                plain, mark = table.plain_number(cell, header.separator)
                if mark not in marks:
                    where = _where_cell(header.source, line.start(), cells, place, role)
                    if mark is None:
                        raise table.not_a_number(cell, plain, row, header.units[role], where)
                    marks[mark] = where
                cell = plain
            columns[role].append(cell)
        row += 1
    return Rows.read(columns)


def _not_a_mark(cell: str, row: int, where: str) -> InputError:
    """E104, for a cell of the column `exact`."""
    message = f"row {row} has {table.shown(cell)} where yes or no belongs"
    help = "write yes or x for a pose to be met exactly, no or nothing for one to come near"
    return InputError("E104", message, where=where, help=help)


def _require_one_mark(marks: dict[str, str]) -> None:
    """Refuse commas that nothing proves to be decimal ones."""
    where = marks.get("?") or marks.get(",")
    if where and "." in marks:
        why = "other numbers have a decimal point, so the comma may part thousands"
    elif where and "," not in marks:
        why = "no number shows whether the comma is a decimal mark or parts thousands"
    else:
        return
    message = "a comma in a number can be read in two ways"
    help = "write every number with a decimal point, and none with a comma"
    raise InputError("E104", message, where=where, why=why, help=help)


def _split(line: str, separator: str) -> list[str]:
    """The cells as they stand, with their blanks and quotes, so that places can be counted."""
    if '"' not in line or line.count('"') % 2:
        return line.split(separator)
    return re.findall(rf'(?:^|{separator})((?:"[^"]*"|[^"{separator}])*+)', line)


def _unquoted(cell: str) -> str:
    cell = cell.strip()
    if len(cell) > 1 and cell[0] == cell[-1] == '"':
        return cell[1:-1].replace('""', '"').strip()
    return cell


def _where_cell(source: Source, start: int, cells: list[str], i: int, note: str = "") -> str:
    """The place of one of the cells that `_split` made of the line at `start`."""
    blanks = len(cells[i]) - len(cells[i].lstrip())
    start += sum(len(cell) + 1 for cell in cells[:i]) + blanks
    return source.where(start, len(cells[i].strip()), note)


def _wrong_width(line: re.Match[str], cells: list[str], header: _Header, row: int) -> InputError:
    """E106, at the first cell too many or at the end of the line."""
    given, needed = len(cells), len(header.names)
    where, why = header.source.where(line.end()), None
    if given > needed:
        where = _where_cell(header.source, line.start(), cells, needed)
    if given == 2 * needed and header.separator == ",":
        why = "a comma ends a cell here, so it cannot be a decimal mark as well"
    message = f"row {row} has {given} cell{'' if given == 1 else 's'}, the header has {needed}"
    help = f"give {needed} cells ({', '.join(header.names)}), or delete the row"
    return InputError("E106", message, where=where, why=why, help=help)
