"""A grid: cells with their places, from CSV, a sheet, Parquet or a pasted panel.

Every one of these is a text with a separator between its cells: sheets and Parquet are made one,
with tabs, and their `Source` tells where its cells come from.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from burmester.errors import Advice
from burmester.io.reading.pose_table import Source
from burmester.io.reading.tables.columns import Columns

# Error values of spreadsheets; a # that begins one of them begins no comment.
SPREADSHEET_ERRORS = r"#(?:N/A|REF!|DIV/0!|VALUE!|NAME\?|NUM!|NULL!)(?![^\s,;|])"
# A line that is neither blank nor a comment.
ROW_LINE = re.compile(rf"(?m)^[^\S\n]*(?:[^\s#]|{SPREADSHEET_ERRORS}).*$")
SEPARATOR_NAMES = {  # one of them, and many
    ",": ("a comma", "commas"),
    "\t": ("a tab", "tabs"),
    ";": ("a semicolon", "semicolons"),
    "|": ("a bar", "bars"),
    " ": ("a blank", "blanks"),
}


def split_cells(line: str, separator: str) -> list[str]:
    """The cells as they stand, with their blanks and quotes, so that columns can be counted."""
    if separator == " ":  # one blank separates two cells, further ones belong to the second
        line = line.rstrip(" \t")
        if '"' not in line or line.count('"') % 2:
            return re.split(r"(?<=[^ \t])[ \t](?![ \t]*[(\[])", line)  # `x (mm)` is one
        return re.findall(r'(?:^|[ \t])([ \t]*(?=[^ \t])[^" \t]*(?:"[^"]*"[^" \t]*)*)', line)
    if '"' not in line or line.count('"') % 2:
        return line.split(separator)
    part = re.escape(separator)
    return re.findall(rf'(?:^|{part})([^"{part}]*(?:"[^"]*"[^"{part}]*)*)', line)


def unquoted(cell: str) -> str:
    """A cell without the blanks around it, and without its quotes."""
    cell = cell.strip()
    if len(cell) > 1 and cell[0] == cell[-1] == '"':
        return cell[1:-1].replace('""', '"').strip()
    return cell


def values_of(line: str, separator: str) -> list[str]:
    """What the cells of a line hold, without blank ones at their end."""
    return _without_blanks(split_cells(line, separator))


def _without_blanks(cells: list[str]) -> list[str]:
    values = list(map(unquoted, cells))
    while values and not values[-1]:
        values.pop()
    return values


class Row(NamedTuple):
    """The cells of a row as they stand, and where they do."""

    source: Source
    start: int  # in the text
    cells: list[str]
    starts: tuple[int, ...] = ()  # of each cell, where more than a separator is between them

    def value(self, i: int | None) -> str:
        """What a cell holds; nothing for one that is not there."""
        return "" if i is None or i >= len(self.cells) else unquoted(self.cells[i])

    def values(self) -> list[str]:
        """What the cells hold, without blank ones at their end."""
        return _without_blanks(self.cells)

    def where(self, i: int | None = None, note: str = "") -> str:
        """The location of a cell; that of the row for None."""
        if i is None and not self.starts:
            text, end = self.source.text, self.source.text.find("\n", self.start)
            line = text[self.start : end if end >= 0 else len(text)]
            return self.source.where(self.start + len(line) - len(line.lstrip()), len(line.strip()))
        i = i or 0
        cell = self.cells[i]
        start = self.start + sum(len(each) + 1 for each in self.cells[:i])
        start = self.starts[i] if self.starts else start + len(cell) - len(cell.lstrip())
        return self.source.where(start, len(cell.strip()), note)


def rows_of(
    source: Source, separator: str, begin: int = 0, end: int | None = None
) -> Iterator[Row]:
    """The rows in a part of a text in which a cell holds something."""
    for line in ROW_LINE.finditer(source.text, begin, len(source.text) if end is None else end):
        row = Row(source, line.start(), split_cells(line[0], separator))
        if any(map(unquoted, row.cells)):
            yield row


class Grid(NamedTuple):
    """Rows below names of columns."""

    source: Source
    separator: str
    names: list[str]  # without the empty ones at the end
    columns: Columns
    where: str  # the angle column, if there is one, else the header
    say_unit: str = "name the column `angle_deg` or `angle_rad` in the header"
    begin: int = 0  # where the rows begin in the text
    spare: int = 0  # names that are empty, at the end of the header
    line: int = 0  # the number of the header's line, 0 where it is in no line of its own
    notes: tuple[Advice, ...] = ()  # what was passed over
    listed: tuple[Row, ...] | None = None  # the rows, where they are no lines of the text
    ignore: str = 'begin the name of its column with #: "#{}"'  # how to have a column passed over

    def rows(self) -> Iterator[Row]:
        """All rows."""
        if self.listed is not None:
            return iter(self.listed)
        return rows_of(self.source, self.separator, self.begin)

    def locate(self, row: int | None) -> str:
        """Where a row stands, by its number from 0; the file for None."""
        if row is None:
            return self.source.label
        return next(each for k, each in enumerate(self.rows()) if k == row).where()

    def described(self, *, decimal_commas: bool, named: bool) -> str:
        """The form of the file, and which column gives what; named: whether the rows are."""
        source, where = self.source, "columns by --columns"
        columns = self.columns.described(self.names, named=named)
        if self.line:
            where = f"header in {source.line_word} {self.line}"
        form = f"CSV with {SEPARATOR_NAMES[self.separator][1]}"
        if self.listed is not None:
            return f"values from a panel: {columns}"
        if source.names_columns:
            return f"Parquet: {columns}"
        if source.sheet:
            form = f"sheet {source.sheet.name}"
        elif decimal_commas:
            form += " and decimal commas"
        return f"{form}; {where}: {columns}"

    @property
    def unnamed(self) -> bool:
        """Whether columns have no name; their cells have to be empty."""
        return self.spare > 0 or "" in self.names
