"""Poses in CSV: a header, then a pose a line, cells parted by one separator.

The separator is the first of comma, tab, semicolon, bar and blank that the header holds, or
what a first line `sep=;` says.  Where commas do not part the cells they may be decimal marks,
if the numbers prove it.  Lines without a cell that holds something are blank, and so are cells
beyond the header's.  A line that starts with # is a comment, unless it is an error of a
spreadsheet (#N/A).  `burmester.io.reading.columns` tells which headers are understood and which are
ignored.  Blocks of plain rows are read at once; the others cell by cell, to say what is wrong
and where.  The errors are those that `burmester.io.reading.poses` lists.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.io.reading import table
from burmester.io.reading.columns import HEADER, Columns, is_header, read_columns
from burmester.io.reading.table import PoseTable, Rows, Source, brief, numeric_roles
from burmester.io.reading.wrong_numbers import not_a_number

__all__ = ["BLOCK", "read_csv"]

BLOCK = 1 << 20  # characters parsed at a time, so that a million rows need little memory
_MANY = 20  # names of columns that a help writes out

_MARK = f"(?i:{'|'.join(filter(None, table.MARKS))})?"
# of a spreadsheet: these begin no comment
_FAULTS = r"#(?:N/A|REF!|DIV/0!|VALUE!|NAME\?|NUM!|NULL!)(?![^\s,;|])"
_LINE = re.compile(rf"(?m)^[^\S\n]*(?:[^\s#]|{_FAULTS}).*$")  # neither blank nor a comment
_TOP = re.compile(rf"(?m)^[^\S\n]*(?:[^\s#]|#[^\S\n]*[,;\t|]|{_FAULTS}).*$")  # also `#,x,y`
_SAID = {",": "a comma", "\t": "a tab", ";": "a semicolon", "|": "a bar", " ": "a blank"}
_SEPARATOR = re.compile(r'"?sep=([,;\t| ])"?[,;\t| ]*(?:\n|\Z)', re.IGNORECASE)


class _Header(NamedTuple):
    """What the header line says, or --columns."""

    source: Source
    end: int  # where the rows begin in the text
    separator: str
    names: list[str]  # without those at the end that are empty
    spare: int  # how many those are
    columns: Columns
    where: str  # the angle column, if there is one


def read_csv(source: Source, columns: str | None = None) -> PoseTable:
    """A header and a pose a line; raises E102 to E108.

    columns: the names of the columns, with commas between them, of a file without a header.
    """
    text, header = source.text, _header(source, columns)
    marks: dict[str, str] = {}  # what `plain_number` calls a mark -> where it is first seen
    blocks: list[Rows] = []
    start, row = header.end, 1
    while start < len(text):
        end = text.find("\n", start + BLOCK)
        end = end if end >= 0 else len(text)
        rows = _plain_rows(text[start:end], header, marks)
        if rows is None:
            rows = _checked_rows(_LINE.finditer(text, start, end), header, marks, row)
        if rows is not None:
            blocks.append(rows)
            row += len(rows.values)
        start = end + 1
    if not blocks:
        raise table.empty("there is only a header")
    _require_one_mark(marks)
    where = "in the header" if columns is None else "in --columns"
    return PoseTable(
        Rows.joined(blocks),
        length_unit=header.columns.length_unit,
        angle_unit=header.columns.units.get("angle"),
        where=header.where,
        say_unit=f"name the column `angle_deg` or `angle_rad` {where}",
        place=functools.partial(_place, header),
    )


def _header(source: Source, given: str | None) -> _Header:
    """The names of the columns, understood, and where the rows begin."""
    said = _SEPARATOR.match(source.text)
    part = said[1] if said else None
    first = next(_tops(source.text, said.end() if said else 0, part, given is None), None)
    if not first:
        raise table.empty("there are only comments")
    if given is not None:
        return _given(source, given, first, part)
    separator = part or _separator(first[0])
    cells = _split(first[0], separator)
    names = [_unquoted(cell) for cell in cells]
    while names and not names[-1]:
        names.pop()

    def where(i: int | None, note: str = "") -> str:
        if i is None:
            return source.where(first.start(), len(first[0].rstrip()))
        return _where_cell(source, first.start(), cells, i, note)

    _require_header(source, first, where(None))
    columns = read_columns(names, where)
    angle = where(columns.places["angle"], "angle") if "angle" in columns.places else where(None)
    spare = len(cells) - len(names)
    return _Header(source, first.end() + 1, separator, names, spare, columns, angle)


def _tops(text: str, start: int, part: str | None, header: bool) -> Iterator[re.Match[str]]:
    """The lines in which a cell holds something, and where a header may stand `#,x,y` too."""
    for line in (_TOP if header else _LINE).finditer(text, start):
        comment = not _LINE.fullmatch(line[0])
        cells = _split(line[0], part or _separator(line[0]))
        if is_header(_filled(list(map(_unquoted, cells)))) or (
            not comment and any(map(_unquoted, cells))
        ):
            yield line


def _given(source: Source, given: str, first: re.Match[str], separator: str | None) -> _Header:
    """The columns that --columns names; the first line of the file is a row."""
    option, cells = Source("--columns", given), given.split(",")

    def where(i: int | None, note: str = "") -> str:
        return option.where(0, len(given)) if i is None else _where_cell(option, 0, cells, i, note)

    names = [cell.strip() for cell in cells]
    columns = read_columns(names, where, "name it #{}")
    if _is_header(first[0]):
        where_line = source.where(first.start(), len(first[0]))
        message = "the file has a header, and --columns gives another"
        help = "leave --columns out, or delete this line"
        raise InputError("E108", message, where=where_line, help=help)
    numeric = [columns.places[role] for role in numeric_roles(columns.places)]
    separator = separator or _of_row(first[0], len(names), numeric)
    angle = where(columns.places["angle"], "angle") if "angle" in columns.places else where(None)
    return _Header(source, first.start(), separator, names, 0, columns, angle)


def _of_row(line: str, width: int, numeric: list[int]) -> str:
    """What parts the cells of a row that has so many, with numbers in these places."""
    rows = {s: list(map(_unquoted, _filled(_split(line, s)))) for s in "\t;|, "}
    fits = [s for s, row in rows.items() if len(row) == width]
    for separator in fits:
        if all(table.NUMBER_LIKE.fullmatch(rows[separator][i]) for i in numeric):
            return separator
    return next(iter(fits), _separator(line))


def _separator(line: str) -> str:
    """What parts the cells of a header."""
    for separator in ",\t;| ":
        if is_header(_filled(list(map(_unquoted, _split(line, separator))))):
            return separator
    blank = " " if re.search(r"\S[ \t]+\S", line) else ","
    return next((s for s in ",\t;|" if s in line), blank)


def _is_header(line: str) -> bool:
    return is_header(_filled(list(map(_unquoted, _split(line, _separator(line))))))


def _filled(cells: list[str]) -> list[str]:
    """Cells without the blank ones at their end."""
    count = len(cells)
    while count and not _unquoted(cells[count - 1]):
        count -= 1
    return cells[:count]


def _require_header(source: Source, first: re.Match[str], where: str) -> None:
    """Refuse a line of numbers on top: E105 with the header that would fit above it."""
    for separator in "\t;|, ":  # commas may be decimal marks
        cells = [_unquoted(cell) for cell in _split(first[0], separator)]
        if (separator in first[0].strip()) and all(map(table.NUMBER_LIKE.fullmatch, cells)):
            break
    else:
        return
    names = [*HEADER.split(","), *(f"#{i}" for i in range(4, len(cells) + 1))]
    points = " or `px,py,qx,qy` for two points" if len(cells) == 4 else ""
    help = (
        f"put this line on top: `{separator.join(names)}` (or angle_rad in it), or pass "
        f"--columns {','.join(names)}{points}"
    )
    if len(names) > _MANY:
        help = (
            f"put a line on top that names the {len(names)} columns: {HEADER} for those of the "
            f"poses, and #1, #2 and so on for the others"
        )
    above = source.text[: first.start()].rstrip("\n").rpartition("\n")[2].strip()
    if above.startswith("#") and _is_header(above.lstrip("# ")):
        line = brief(f"`{above.lstrip('# ')}`", "the line above")
        help = f"delete the # in front of {line}, or pass --columns {HEADER}"
    message = "there is no header: the first line is all numbers"
    raise InputError("E105", message, where=where, help=help)


def _plain_rows(block: str, header: _Header, marks: dict[str, str]) -> Rows | None:
    """The rows of a block in which nothing is unusual, fast; None if something is."""
    separator, places = header.separator, header.columns.places
    if separator == " ":
        block = re.sub(r"(?m)^[ \t]+|[ \t]+$", "", re.sub(r"[ \t]+", " ", block))
    mark = "," if "," in marks else "."  # a comma once it is proved to be a decimal one
    text, number = rf'[^{separator}\n"#]*+', rf"[-+{mark}0-9eE]*+"
    looks = {"name": text, "exact": _MARK}
    like = {place: looks.get(role, number) for role, place in places.items()}
    part, width = re.escape(separator), len(header.names) + header.spare
    cell = [like.get(i, text) for i in range(len(header.names))] + [""] * header.spare
    row = (
        cell[0]
        + "".join(  # a file may have thousands of columns that are ignored
            f"(?:{part}{look}){{{len(list(same))}}}" for look, same in itertools.groupby(cell[1:])
        )
    )
    if not re.fullmatch(rf"(?:{row}\n)*{row}", block):
        return None
    cells = block.replace("\n", separator).split(separator)
    columns = {role: cells[place::width] for role, place in places.items()}
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
) -> Rows | None:
    """The rows in any lines, cell by cell; the first of them is number `row` of the file."""
    places, units = header.columns.places, header.columns.units
    columns: dict[str, list[str]] = {role: [] for role in places}
    numeric = numeric_roles(places)
    count = 0
    for line, cells in _rows(lines, header.separator):
        if len(cells) != len(header.names):
            _require_width(line, cells, header, row + count)
        for role, place in places.items():
            cell = _unquoted(cells[place])
            if role == "exact" and cell.lower() not in table.MARKS:
                where = _where_cell(header.source, line.start(), cells, place, role)
                raise _not_a_mark(cell, row + count, where)
            if role in numeric:
                plain, mark = table.plain_number(cell, header.separator)
                if mark not in marks:
                    where = _where_cell(header.source, line.start(), cells, place, role)
                    if mark is None:
                        raise not_a_number(
                            cell, plain, row + count, units[role], where, header.separator
                        )
                    marks[mark] = where
                cell = plain
            columns[role].append(cell)
        count += 1
    return Rows.read(columns) if count else None


def _rows(
    lines: Iterable[re.Match[str]], separator: str
) -> Iterator[tuple[re.Match[str], list[str]]]:
    """The lines in which a cell holds something, with their cells."""
    for line in lines:
        cells = _split(line[0], separator)
        if any(map(_unquoted, cells)):
            yield line, cells


def _place(header: _Header, row: int | None) -> str:
    """Where a row stands, by its number from 0; the file for None."""
    if row is None:
        return header.source.label
    lines = _rows(_LINE.finditer(header.source.text, header.end), header.separator)
    line = next(line for k, (line, _) in enumerate(lines) if k == row)
    start = line.start() + len(line[0]) - len(line[0].lstrip())
    return header.source.where(start, line.end() - start)


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
    if separator == " ":  # one blank parts two cells, the others belong to the second
        line = line.rstrip(" \t")
        if '"' not in line or line.count('"') % 2:
            return re.split(r"(?<=[^ \t])[ \t](?![ \t]*[(\[])", line)  # `x (mm)` is one
        return re.findall(r'(?:^|[ \t])([ \t]*(?=[^ \t])[^" \t]*(?:"[^"]*"[^" \t]*)*)', line)
    if '"' not in line or line.count('"') % 2:
        return line.split(separator)
    part = re.escape(separator)
    return re.findall(rf'(?:^|{part})([^"{part}]*(?:"[^"]*"[^"{part}]*)*)', line)


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


def _require_width(line: re.Match[str], cells: list[str], header: _Header, row: int) -> None:
    """Refuse a row that lacks a cell (E106), or has one that no name stands above (E106, E107)."""
    given, needed = len(cells), len(header.names)
    filled = max(len(_filled(cells)), min(given, needed))
    if filled == needed:
        return
    where, why = header.source.where(line.end()), None
    named = brief(f" ({', '.join(header.names)})", "")
    help = f"give {needed} cells{named}, or delete the row"
    if filled > needed:
        extra = next(i for i in range(needed, filled) if _unquoted(cells[i]))
        where = _where_cell(header.source, line.start(), cells, extra)
        if extra < needed + header.spare:
            message = f"row {row} has {table.shown(_unquoted(cells[extra]))} below no name"
            help = "give its column a name, or delete what stands in it"
            raise InputError("E107", message, where=where, help=help)
    if given == 2 * needed and header.separator == ",":
        why = "a comma ends a cell here, so it cannot be a decimal mark as well"
        help = "write decimal points, or part all cells with semicolons, those of the header too"
    other = next((s for s in "\t;|," if len(_filled(_split(line[0], s))) == needed), None)
    if given == 1 and other:
        why = f"{_SAID[header.separator]} parts the cells of the header, {_SAID[other]} these"
        edit = brief(f"`{other.join(header.names)}`", f"its names with {_SAID[other]} between them")
        help = f"write the header as {edit}"
    message = f"row {row} has {given} cell{'' if given == 1 else 's'}, the header has {needed}"
    raise InputError("E106", message, where=where, why=why, help=help)
