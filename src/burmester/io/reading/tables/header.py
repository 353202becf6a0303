"""The header of a CSV file: its separator, its columns, and where the rows begin.

The separator is the one that a first line `sep=;` states, or the first of comma, tab, semicolon,
bar and blank with which the line is a header.  Titles above the header are passed over, and a line
of units below it is read; both are said.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import (
    DIRECTION,
    HEADER,
    NUMBER,
    NUMBER_LIKE,
    NUMERIC,
    POINTS,
    Rows,
    Source,
    brief,
    decimals,
    no_poses,
    numeric_roles,
    plain_number,
    shown,
)
from burmester.io.reading.tables.column_words import known
from burmester.io.reading.tables.columns import has_poses, is_header, read_columns
from burmester.io.reading.tables.grid import (
    ROW_LINE,
    SPREADSHEET_ERRORS,
    Grid,
    Row,
    split_cells,
    unquoted,
    values_of,
)

MAX_NAMES = 20  # columns of a text without a header that are looked at
MAX_COMPARED_ROWS = 1000  # the same of rows
MAX_TITLE_LINES = 30  # lines with text above the header, at most
_MEASURED = NUMERIC[:3]  # roles whose columns have units, beside the coordinates of points
# A line that may be the header; also `#,x,y`.
_HEADER_LINE = re.compile(rf"(?m)^[^\S\n]*(?:[^\s#]|#[^\S\n]*[,;\t|]|{SPREADSHEET_ERRORS}).*$")
# The begin of a cell of a row, where a number belongs: its first digit, or an error value.
_ROW_CELL = re.compile(rf"[-+\u2212\u2013.,]*[0-9]|(?i:nan|[-+]?inf)|{SPREADSHEET_ERRORS}")
_SEPARATOR_LINE = re.compile(r'"?sep=([,;\t| ])"?[,;\t| ]*(?:\n|\Z)', re.IGNORECASE)


MAX_LENGTH_ERROR = 0.02  # of a direction's length 1, beyond what its digits explain
MOST_LENGTH_ERROR = 0.1  # the same with what digits explain, where these are few
MAX_COSINE = 1.1  # numbers beyond it are no cosines
LEAST_ROWS = 4  # of which all directions have length 1; fewer may do so by chance
MAX_CHANGE = 1e-3  # of z, over the larger change of x and y; up to it z is constant


def read_header(source: Source, given: str | None) -> Grid:
    """The rows of a text below its header; given: the names of --columns, if it has none."""
    stated = _SEPARATOR_LINE.match(source.text)
    part = stated[1] if stated else None
    start = stated.end() if stated else 0
    lines = _filled_lines(source.text, start, part, header=given is None)
    first = next(lines, None)
    if not first:
        raise no_poses("the file has only comments")
    following = itertools.islice(lines, MAX_TITLE_LINES)
    if given is not None:
        return _header_of_option(source, given, [first, *following], part)
    line = _header_below_titles(first, following, part)
    separator = part or _separator_of_header(line[0])
    row = Row(source, line.start(), split_cells(line[0], separator))
    names = row.values()
    _require_header(source, line)
    ignore = 'name it "#{}"' + " (with the quotes)" * (not source.sheet)
    columns = read_columns(names, row.where, ignore, may_be_named=not source.names_columns)
    angle = columns.indices.get("angle")
    notes = () if line is first else (_passed_over(source, first, line, "above the header"),)
    grid = Grid(
        source,
        separator,
        names,
        columns,
        row.where(angle, "angle"),
        begin=line.end() + 1,
        spare=len(row.cells) - len(names),
        line=source.line_number(line.start()),
        notes=notes,
    )
    return _with_units(grid)


def _filled_lines(
    text: str, start: int, part: str | None, *, header: bool
) -> Iterator[re.Match[str]]:
    """The lines with content; header: also comments that are a header, such as `#,x,y`."""
    for line in (_HEADER_LINE if header else ROW_LINE).finditer(text, start):
        names = values_of(line[0], part or _separator_of_header(line[0]))
        if is_header(names) or (names and ROW_LINE.fullmatch(line[0])):
            yield line


def _header_below_titles(
    first: re.Match[str], following: Iterator[re.Match[str]], part: str | None
) -> re.Match[str]:
    """The line that is the header: the first one, or one below a title without rows of numbers."""
    likely = None
    for line in itertools.chain((first,), following):
        names = values_of(line[0], part or _separator_of_header(line[0]))
        if is_header(names):
            return line
        if likely is None and has_poses(names):
            likely = line
        if _holds_numbers(line[0]):
            break
    return likely or first


def _passed_over(source: Source, first: re.Match[str], end: re.Match[str], which: str) -> Advice:
    """W213, for the lines from the first one to the one before `end`."""
    count = source.text.count("\n", first.start(), end.start())
    number, word = source.line_number(first.start()), source.line_word
    title = brief(f": `{first[0].strip()[:60]}`", "")
    lines = f"{word} {number}" if count == 1 else f"{word}s {number} to {number + count - 1}"
    return Advice(
        "W213",
        f"{lines} {which} {'is' if count == 1 else 'are'} passed over{title}",
        "delete such rows to have nothing said"
        if source.sheet
        else "begin such lines with # to have nothing said",
    )


def _with_units(grid: Grid) -> Grid:
    """The grid with the units of the line below its header, if that is a line of units."""
    source, names = grid.source, list(grid.names)
    line = ROW_LINE.search(source.text, grid.begin)
    row = Row(source, line.start(), split_cells(line[0], grid.separator)) if line else None
    if not line or not row or len(row.cells) != len(names) + grid.spare:
        return grid
    units = [unquoted(cell).strip("()[]<> ") for cell in row.cells]
    measured = {i for role, i in grid.columns.indices.items() if role in (*_MEASURED, *POINTS)}
    if not any(units[i] for i in measured) or re.search("[0-9]", "".join(units)):
        return grid
    for i in measured:
        word = known(names[i])
        stated = known(f"{word.word} [{units[i]}]") if word and units[i] else word
        if not word or not stated or stated.unit == "?":
            return grid
        if word.unit is None:
            names[i] = f"{word.word} [{units[i]}]" if units[i] else names[i]
        elif stated.unit != word.unit:
            message = f"the header has {shown(names[i])}, and the line below it {shown(units[i])}"
            help = "delete one of the two units"
            raise InputError("E108", message, where=row.where(i), help=help)
    columns = read_columns(names, row.where)
    angle = columns.indices.get("angle")
    note = Advice(
        "W213",
        f"{source.line_word} {source.line_number(line.start())} is read as the units of the "
        "columns",
        "write the units into the header, as in x_mm, and delete the line",
    )
    return grid._replace(
        begin=line.end() + 1,
        columns=columns,
        where=grid.where if angle is None else row.where(angle),
        notes=(*grid.notes, note),
    )


def _header_of_option(
    source: Source, given: str, lines: list[re.Match[str]], part: str | None
) -> Grid:
    """The columns that --columns names; a header and titles of the file are passed over."""
    row = Row(Source("--columns", given), 0, given.split(","))
    names = [cell.strip() for cell in row.cells]
    columns = read_columns(names, row.where, "name it #{}")
    numeric = [columns.indices[role] for role in numeric_roles(columns.indices)]
    first = _first_row(lines, numeric, len(names), part)
    separator = part or _separator_of_row(first[0], len(names), numeric)
    skipped = lines[0] is not first
    notes = (_passed_over(source, lines[0], first, "above the first row"),) if skipped else ()
    where = row.where(columns.indices.get("angle"), "angle")
    say_unit = "name the column `angle_deg` or `angle_rad` in --columns"
    return Grid(source, separator, names, columns, where, say_unit, first.start(), notes=notes)


def _first_row(
    lines: list[re.Match[str]], numeric: list[int], width: int, part: str | None
) -> re.Match[str]:
    """The first line with numbers where they belong, if no line above it has any."""
    for line in lines:
        cells = values_of(line[0], part or _separator_of_row(line[0], width, numeric))
        found = [bool(_ROW_CELL.match(cells[i])) for i in numeric if i < len(cells)]
        if len(cells) == width and all(found):
            return line
        if any(found) and not is_header(values_of(line[0], _separator_of_header(line[0]))):
            break
    return lines[0]


def _holds_numbers(line: str) -> bool:
    """Whether a line may be a pose, and so is no title: three numbers, or nothing but numbers."""
    for separator in "\t;|,":
        cells = map(unquoted, split_cells(line, separator))
        if sum(bool(NUMBER_LIKE.fullmatch(cell)) for cell in cells) >= len(_MEASURED):
            return True
    return _separator_of_numbers(line) is not None


def _separator_of_numbers(line: str) -> str | None:
    """The separator of a line that is numbers alone, and so no title and no header."""
    for separator in "\t;|, ":  # commas may be decimal marks
        cells = map(unquoted, split_cells(line, separator))
        if separator in line.strip() and all(map(NUMBER_LIKE.fullmatch, cells)):
            return separator
    return None


def _separator_of_row(line: str, width: int, numeric: list[int]) -> str:
    """The separator of a row with `width` cells and numbers at the indices `numeric`."""
    rows = {separator: values_of(line, separator) for separator in "\t;|, "}
    fits = [separator for separator, row in rows.items() if len(row) == width]
    for separator in fits:
        if all(NUMBER_LIKE.fullmatch(rows[separator][i]) for i in numeric):
            return separator
    return next(iter(fits), _separator_of_header(line))


def _separator_of_header(line: str) -> str:
    """The separator of a header."""
    for is_one in (is_header, has_poses):
        for separator in ",\t;| ":
            if is_one(values_of(line, separator)):
                return separator
    blank = " " if re.search(r"\S[ \t]+\S", line) else ","
    return next((s for s in ",\t;|" if s in line), blank)


def _require_header(source: Source, first: re.Match[str]) -> None:
    """Refuse a line of numbers on top: E105 with the header that would fit above it."""
    separator = _separator_of_numbers(first[0])
    if separator is None or source.names_columns:
        return
    count = len(split_cells(first[0], separator))
    names, what, why = HEADER.split(",")[: max(2, count)], "x and y of points", None
    direction = _direction_columns(source, first, separator, count)
    if direction is not None:
        names = ["x", "y", *(f"#{i}" for i in range(3, count + 1))]
        names[direction : direction + 2] = DIRECTION
        columns = f"columns {direction + 1} and {direction + 2}"
        why = f"the squares of {columns} add up to 1 in all rows: cosine and sine of an angle?"
        what = "x, y, the cosine and the sine of the angle"
    elif count == len(_MEASURED):
        what = "x, y and the angle in degrees"
    points = "`px,py,qx,qy`" if count == len(POINTS) else "px, py, qx and qy"
    help = (
        f"name the {count} columns in a line on top, or in --columns: x, y and angle_deg "
        f"(or angle_rad, or cos and sin), or {points} for two points; weight; and a name that "
        "begins with # for a column to be passed over"
    )
    if direction is not None or count <= len(_MEASURED):
        help = (
            f"if the columns are {what}, put this line on top: `{separator.join(names)}`"
            + " (or angle_rad in it)" * ("angle_deg" in names)
            + f", or pass --columns {','.join(names)}"
        )
    above = source.text[: first.start()].rstrip("\n").rpartition("\n")[2].strip()
    name_line = above.lstrip("# ")
    if above.startswith("#") and is_header(values_of(name_line, _separator_of_header(name_line))):
        line = brief(f"`{name_line}`", "the line above")
        help = f"delete the # in front of {line}, or pass --columns {HEADER}"
    message = "there is no header: the first line is all numbers"
    where = source.where(first.start(), len(first[0].rstrip()))
    raise InputError("E105", message, where=where, why=why, help=help)


def _direction_columns(
    source: Source, first: re.Match[str], separator: str, width: int
) -> int | None:
    """The first of two columns behind x and y that may be cosine and sine, by rows of numbers."""
    lines = itertools.islice(ROW_LINE.finditer(source.text, first.start()), MAX_COMPARED_ROWS)
    rows = []
    for line in lines:
        cells = [unquoted(cell) for cell in split_cells(line[0], separator)]
        plain = [plain_number(cell, separator) for cell in cells[:MAX_NAMES]]
        if len(cells) != width or any(mark is None for _, mark in plain):
            return None
        rows.append([text for text, _ in plain])
    columns = list(zip(*rows, strict=True))
    pairs = itertools.pairwise(range(2, len(columns)))
    return next((i for i, j in pairs if are_directions(columns[i], columns[j])), None)


def require_directions(rows: Rows, locate: Callable[[int | None], str]) -> None:
    """Refuse a row whose cosine and sine are far from those of an angle; raises E116."""
    if rows.lengths is None:
        return
    wrong = np.flatnonzero(np.abs(rows.lengths - 1) > _tolerance(rows.decimals[1]))
    if len(wrong):
        row = int(wrong[0])
        message = f"row {row + 1}: cos and sin are not those of an angle"
        why = f"the sum of their squares is {rows.lengths[row] ** 2:.3g}, and has to be 1"
        help = "give the cosine and the sine of the body's angle, or the angle as angle_deg"
        raise InputError("E116", message, where=locate(row), why=why, help=help)


def direction_notes(
    texts: Sequence[str], other: Sequence[str], names: Sequence[str]
) -> tuple[Advice, ...]:
    """W243, where the cells of angles and of a column that is passed over seem to be a direction.

    names: of the two columns.
    """
    if not are_directions(texts, other):
        return ()
    both = " and ".join(f"`{name.strip()}`" for name in names)
    return (
        Advice(
            "W243",
            f"the columns {both} look like the cosine and the sine of an angle",
            "if that is what they are, name the columns x,y,cos,sin in the header or by --columns",
            "their squares add up to 1 in all rows",
        ),
    )


def are_directions(cosine: Sequence[str], sine: Sequence[str]) -> bool:
    """Whether numbers look like the cosine and the sine of angles that are not all the same."""
    if len(cosine) < LEAST_ROWS or not all(map(NUMBER.fullmatch, (*cosine, *sine))):
        return False
    both = np.array([cosine, sine], dtype=float)
    printed = max(map(decimals, (*cosine, *sine)))
    return bool(
        np.ptp(both, axis=1).all() and (abs(np.hypot(*both) - 1) <= _tolerance(printed)).all()
    )


def _tolerance(printed: float) -> float:
    """Of a direction's length, printed with so many decimals."""
    last_digit: float = 10.0**-printed
    return min(MAX_LENGTH_ERROR + math.sqrt(0.5) * last_digit, MOST_LENGTH_ERROR)


def height_notes(heights: Sequence[str] | None, rows: Rows, grid: Grid) -> tuple[Advice, ...]:
    """W213, for a column z that is passed over; none without such a column.

    heights: the texts of z, with decimal points.  Raises E113 where z changes.
    """
    if heights is None:
        return ()
    ignore = grid.ignore.format("z")
    z = np.array([float(text) for text in heights])
    with np.errstate(over="ignore", invalid="ignore"):
        across = float(np.ptp(rows.values[:, :2], axis=0).max())
        change = float(np.ptp(z))
    least, most = float(z.min()), float(z.max())
    if not change <= MAX_CHANGE * across:
        odd = int(np.abs(z - np.median(z)).argmax())
        why = (
            f"it goes from {least:g} to {most:g}, and a planar linkage keeps its body in one plane"
        )
        help = f"give x and y in the plane of the motion; or if z says nothing, {ignore}"
        message = "z is not the same in all poses"
        raise InputError("E113", message, where=grid.locate(odd), why=why, help=help)
    why = f"it is {least:g} in all poses"
    if least < most:
        why = f"it stays between {least:.6g} and {most:.6g}, x and y change by {across:.3g}"
    help = f"to have nothing said, {ignore}"
    return (Advice("W213", "the column z is passed over", help, why),)
