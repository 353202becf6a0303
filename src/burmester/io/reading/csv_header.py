"""The header of a CSV file: its separator, its columns, and where the rows begin.

The separator is the one that a first line `sep=;` states, or the first of comma, tab, semicolon,
bar and blank with which the first line is a header.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from burmester.errors import InputError
from burmester.io.reading import pose_table
from burmester.io.reading.columns import HEADER, Columns, is_header, read_columns
from burmester.io.reading.csv_cells import (
    ROW_LINE,
    SPREADSHEET_ERRORS,
    cell_location,
    row_values,
    split_cells,
    unquoted,
)
from burmester.io.reading.pose_table import Source, brief, numeric_roles

__all__ = ["Header", "read_header"]

MAX_NAMES = 20  # names of columns that a help text writes out
# A line that may be the header; also `#,x,y`.
_HEADER_LINE = re.compile(rf"(?m)^[^\S\n]*(?:[^\s#]|#[^\S\n]*[,;\t|]|{SPREADSHEET_ERRORS}).*$")
_SEPARATOR_LINE = re.compile(r'"?sep=([,;\t| ])"?[,;\t| ]*(?:\n|\Z)', re.IGNORECASE)


class Header(NamedTuple):
    """The columns by the header line, or by --columns."""

    source: Source
    end: int  # where the rows begin in the text
    separator: str
    names: list[str]  # without the empty ones at the end
    spare: int  # the number of those
    columns: Columns
    where: str  # the angle column, if there is one


def read_header(source: Source, given: str | None) -> Header:
    """The header of a text; given: the names of --columns, if the text has no header."""
    stated = _SEPARATOR_LINE.match(source.text)
    part = stated[1] if stated else None
    start = stated.end() if stated else 0
    first = next(_filled_lines(source.text, start, part, header=given is None), None)
    if not first:
        raise pose_table.no_poses("the file has only comments")
    if given is not None:
        return _header_of_option(source, given, first, part)
    separator = part or _separator_of_header(first[0])
    cells = split_cells(first[0], separator)
    names = [unquoted(cell) for cell in cells]
    while names and not names[-1]:
        names.pop()

    def where(i: int | None, note: str = "") -> str:
        if i is None:
            return source.where(first.start(), len(first[0].rstrip()))
        return cell_location(source, first.start(), cells, i, note)

    _require_header(source, first, where(None))
    columns = read_columns(names, where)
    angle = where(columns.indices["angle"], "angle") if "angle" in columns.indices else where(None)
    spare = len(cells) - len(names)
    return Header(source, first.end() + 1, separator, names, spare, columns, angle)


def _filled_lines(
    text: str, start: int, part: str | None, *, header: bool
) -> Iterator[re.Match[str]]:
    """The lines with content; header: also comments that are a header, such as `#,x,y`."""
    for line in (_HEADER_LINE if header else ROW_LINE).finditer(text, start):
        comment = not ROW_LINE.fullmatch(line[0])
        cells = split_cells(line[0], part or _separator_of_header(line[0]))
        if is_header(row_values(cells)) or (not comment and any(map(unquoted, cells))):
            yield line


def _header_of_option(
    source: Source, given: str, first: re.Match[str], separator: str | None
) -> Header:
    """The columns that --columns names; the first line of the file is a row."""
    option, cells = Source("--columns", given), given.split(",")

    def where(i: int | None, note: str = "") -> str:
        if i is None:
            return option.where(0, len(given))
        return cell_location(option, 0, cells, i, note)

    names = [cell.strip() for cell in cells]
    columns = read_columns(names, where, "name it #{}")
    if _is_header(first[0]):
        where_line = source.where(first.start(), len(first[0]))
        message = "the file has a header, and --columns gives another"
        help = "leave --columns out, or delete this line"
        raise InputError("E108", message, where=where_line, help=help)
    numeric = [columns.indices[role] for role in numeric_roles(columns.indices)]
    separator = separator or _separator_of_row(first[0], len(names), numeric)
    angle = where(columns.indices["angle"], "angle") if "angle" in columns.indices else where(None)
    return Header(source, first.start(), separator, names, 0, columns, angle)


def _separator_of_row(line: str, width: int, numeric: list[int]) -> str:
    """The separator of a row with `width` cells and numbers at the indices `numeric`."""
    rows = {s: row_values(split_cells(line, s)) for s in "\t;|, "}
    fits = [s for s, row in rows.items() if len(row) == width]
    for separator in fits:
        if all(pose_table.NUMBER_LIKE.fullmatch(rows[separator][i]) for i in numeric):
            return separator
    return next(iter(fits), _separator_of_header(line))


def _separator_of_header(line: str) -> str:
    """The separator of a header."""
    for separator in ",\t;| ":
        if is_header(row_values(split_cells(line, separator))):
            return separator
    blank = " " if re.search(r"\S[ \t]+\S", line) else ","
    return next((s for s in ",\t;|" if s in line), blank)


def _is_header(line: str) -> bool:
    return is_header(row_values(split_cells(line, _separator_of_header(line))))


def _require_header(source: Source, first: re.Match[str], where: str) -> None:
    """Refuse a line of numbers on top: E105 with the header that would fit above it."""
    for separator in "\t;|, ":  # commas may be decimal marks
        cells = [unquoted(cell) for cell in split_cells(first[0], separator)]
        if (separator in first[0].strip()) and all(map(pose_table.NUMBER_LIKE.fullmatch, cells)):
            break
    else:
        return
    names = [*HEADER.split(","), *(f"#{i}" for i in range(4, len(cells) + 1))]
    points = " or `px,py,qx,qy` for two points" if len(cells) == 4 else ""
    help = (
        f"put this line on top: `{separator.join(names)}` (or angle_rad in it), or pass "
        f"--columns {','.join(names)}{points}"
    )
    if len(names) > MAX_NAMES:
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
