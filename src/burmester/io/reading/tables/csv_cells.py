"""The cells of a line of CSV, and their locations."""

from __future__ import annotations

import re

from burmester.io.reading.pose_table import Source

__all__ = [
    "ROW_LINE",
    "SPREADSHEET_ERRORS",
    "cell_location",
    "row_values",
    "split_cells",
    "unquoted",
]

# Error values of spreadsheets; a # that begins one of them begins no comment.
SPREADSHEET_ERRORS = r"#(?:N/A|REF!|DIV/0!|VALUE!|NAME\?|NUM!|NULL!)(?![^\s,;|])"
# A line that is neither blank nor a comment.
ROW_LINE = re.compile(rf"(?m)^[^\S\n]*(?:[^\s#]|{SPREADSHEET_ERRORS}).*$")


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


def row_values(cells: list[str]) -> list[str]:
    """The contents of cells, without blank ones at their end."""
    values = list(map(unquoted, cells))
    while values and not values[-1]:
        values.pop()
    return values


def cell_location(source: Source, start: int, cells: list[str], i: int, note: str = "") -> str:
    """The location of one of the cells that `split_cells` made of the line at `start`."""
    blanks = len(cells[i]) - len(cells[i].lstrip())
    start += sum(len(cell) + 1 for cell in cells[:i]) + blanks
    return source.where(start, len(cells[i].strip()), note)
