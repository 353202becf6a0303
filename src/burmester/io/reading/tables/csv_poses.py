"""Poses in CSV: a header (`csv_header`), then one pose a line, with one separator between cells.

Where another separator is used, commas may be decimal marks, if the numbers prove it.  A line
whose cells are all empty is blank; every other row has as many cells as the header, empty ones at
the end counted: with one more or less, nobody knows which number belongs to which column.  A line
that starts with # is a comment, unless it starts with an error value of a spreadsheet (#N/A).
`tables.columns` lists the names of columns.  Blocks of plain rows are read at once,
other blocks cell by cell, so that an error names its cell.  `burmester.io.reading.poses` lists the
errors.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterable, Iterator

import numpy as np

from burmester.errors import Advice, InputError
from burmester.io.reading import pose_table
from burmester.io.reading.pose_table import PoseTable, Rows, Source, brief, numeric_roles
from burmester.io.reading.stated_tolerances import TOLERANCE_ROLES
from burmester.io.reading.tables.column_words import known
from burmester.io.reading.tables.csv_cells import (
    ROW_LINE,
    cell_location,
    row_values,
    split_cells,
    unquoted,
)
from burmester.io.reading.tables.csv_header import SEPARATOR_NAMES, Header, read_header
from burmester.io.reading.tables.direction_columns import (
    MAX_COSINE,
    direction_notes,
    require_directions,
)
from burmester.io.reading.tables.height import height_notes
from burmester.io.reading.tables.tolerance_cells import WORD_ROLES, read_words, special_text
from burmester.io.reading.tables.written_numbers import CellNumbers, written_number
from burmester.io.reading.tables.wrong_numbers import not_a_number
from burmester.numerics.arrays import FloatArray

__all__ = ["BLOCK", "read_csv", "require_one_mark"]

BLOCK = 1 << 20  # characters parsed at a time, so that a million rows need little memory

_MARK = f"(?i:{'|'.join(filter(None, pose_table.MARKS))})?"
_TINY = re.compile("[eE]-0*[0-9]{3}|0{300}")  # exponents and decimals that may be beyond a double
_SECONDS = {"s": 1.0, "ms": 1e-3, "min": 60.0}


def read_csv(source: Source, columns: str | None = None) -> PoseTable:
    """A header and a pose a line; raises E102 to E108.

    columns: the names of the columns, separated by commas, of a file without a header.
    """
    text, header = source.text, read_header(source, columns)
    marks: dict[str, str] = {}  # mark of `plain_number` -> location of its first occurrence
    written, blocks = CellNumbers(), list[Rows]()
    start, row = header.end, 1
    while start < len(text):
        end = text.find("\n", start + BLOCK)
        end = end if end >= 0 else len(text)
        rows = _plain_rows(text[start:end], header, marks)
        if rows is None:
            rows = _checked_rows(ROW_LINE.finditer(text, start, end), header, marks, written, row)
        if rows is not None:
            blocks.append(rows)
            row += len(rows.values)
        start = end + 1
    if not blocks:
        raise pose_table.no_poses("the file has only a header")
    require_one_mark(marks)
    rows, locate = Rows.joined(blocks), functools.partial(_row_location, header)
    units = written.units(header.columns.units, len(rows.values))
    notes = (*source.notes, *header.notes, *header.columns.notes(), *written.notes())
    notes += _direction_notes(header, rows)
    where = "in the header" if columns is None else "in --columns"
    names = header.columns.row_names(rows.names)
    require_directions(rows, locate)
    if rows.tolerances is not None:
        stated = rows.tolerances._replace(angle_unit=units.get("tol_angle"))
        rows = rows._replace(tolerances=stated)
    return PoseTable(
        rows._replace(names=names),
        length_unit=header.columns._replace(units=units).length_unit,
        angle_unit=header.columns._replace(units=units).angle_unit,
        where=header.where,
        say_unit=f"name the column `angle_deg` or `angle_rad` {where}",
        locate_row=locate,
        notes=(
            *notes,
            *_direction_notes(header, rows),
            *height_notes(_heights(header), rows, locate),
        ),
        read_as=header.described(decimal_commas="," in marks, named=bool(names)),
        times=functools.partial(_times, header),
        crank_unit=units.get("crank"),
    )


def _plain_rows(block: str, header: Header, marks: dict[str, str]) -> Rows | None:
    """The rows of a block in which nothing is unusual, fast; None if something is."""
    separator, indices = header.separator, header.columns.indices
    if header.columns.may_be_free:
        return None
    if separator == " ":
        block = re.sub(r"(?m)^[ \t]+|[ \t]+$", "", re.sub(r"[ \t]+", " ", block))
    mark = "," if "," in marks else "."  # a comma once it is proved to be a decimal one
    text, number = rf'[^{separator}\n"#]*+', rf"[-+{mark}0-9eE]*+"
    looks = {"name": text, "exact": _MARK}
    like = {index: looks.get(role, number) for role, index in indices.items()}
    part, width = re.escape(separator), len(header.names) + header.spare
    cell = [like.get(i, text if name else "") for i, name in enumerate(header.names)]
    cell += [""] * header.spare
    row = (
        cell[0]
        + "".join(  # a file may have thousands of columns that are ignored
            f"(?:{part}{look}){{{len(list(same))}}}" for look, same in itertools.groupby(cell[1:])
        )
    )
    if not re.fullmatch(rf"(?:{row}\n)*{row}", block):
        return None
    cells = block.replace("\n", separator).split(separator)
    columns = {role: cells[index::width] for role, index in indices.items()}
    for role, column in columns.items():
        if role == "name":
            columns[role] = [name.strip() for name in column]
        elif mark == ",":
            columns[role] = [cell.replace(",", ".") for cell in column]
        elif header.source.sheet is None and any("." in cell for cell in column):
            marks["."] = ""
    if _TINY.search(block):
        return None
    try:  # of these characters alone, float() takes exactly what plain_number() does
        rows = Rows.read(columns)
    except ValueError:
        return None
    given = np.isfinite(rows.values)
    if {"angle", "px", "cos"}.isdisjoint(indices):
        given[:, 2] = True  # a point: its angle is free
    return rows if given.all() else None


def _checked_rows(
    lines: Iterable[re.Match[str]],
    header: Header,
    marks: dict[str, str],
    written: CellNumbers,
    row: int,
) -> Rows | None:
    """The rows in any lines, cell by cell; the first of them is number `row` of the file."""
    indices, units = header.columns.indices, header.columns.units
    columns: dict[str, list[str]] = {role: [] for role in indices}
    tolerant, numeric = (
        header.columns.may_be_free,
        [*numeric_roles(indices), *TOLERANCE_ROLES, "crank"],
    )
    single = [(role, index) for role, index in indices.items() if role not in WORD_ROLES]
    if tolerant:
        columns |= {role: [] for role in WORD_ROLES}
    count = 0
    for line, cells in _rows(lines, header.separator):
        if len(cells) != len(header.names) or header.unnamed:
            _require_width(line, cells, header, row + count)
        for role, index in single:
            cell = unquoted(cells[index])
            if (tolerant or role in ("angle", "crank")) and (
                special := special_text(cell, role)
            ) is not None:
                columns[role].append(special)  # a blank angle is free: a point of the body
                continue
            if role == "exact" and cell.lower() not in pose_table.MARKS:
                where = cell_location(header.source, line.start(), cells, index, role)
                raise _not_a_mark(cell, row + count, where)
            if role in numeric:
                locate = functools.partial(
                    cell_location, header.source, line.start(), cells, index, role
                )
                plain, mark = pose_table.plain_number(cell, header.separator)
                if mark and header.source.sheet and '"' not in cells[index]:
                    mark = ""  # the point is not in the sheet: it holds a number, and no text
                number = written_number(cell, role, header.separator) if mark is None else None
                if number and (number.unit is None or role not in TOLERANCE_ROLES):
                    written.add(number, cell, role, row + count, locate)
                    plain, mark = number.plain, number.mark
                if mark not in marks:
                    if mark is None:
                        raise not_a_number(
                            cell,
                            plain,
                            row=row + count,
                            unit=units[role],
                            where=locate(),
                            separator=header.separator,
                        )
                    marks[mark] = locate()
                cell = plain
            columns[role].append(cell)
        if tolerant:
            at = functools.partial(_cell_of_role, header, line, cells)
            texts = {role: unquoted(cells[index]) for role, index in indices.items()}
            read_words(columns, texts, row + count, at)
        count += 1
    return Rows.read(columns) if count else None


def _rows(
    lines: Iterable[re.Match[str]], separator: str
) -> Iterator[tuple[re.Match[str], list[str]]]:
    """The lines in which a cell holds something, with their cells."""
    for line in lines:
        cells = split_cells(line[0], separator)
        if any(map(unquoted, cells)):
            yield line, cells


def _cell_of_role(header: Header, line: re.Match[str], cells: list[str], role: str) -> str:
    """The location of the cell of a role; of the whole row where it has no column."""
    index = header.columns.indices.get(role)
    if index is None:
        return header.source.where(line.start(), line.end() - line.start())
    return cell_location(header.source, line.start(), cells, index, role)


def _direction_notes(header: Header, rows: Rows) -> tuple[Advice, ...]:
    """W243, for angles beside a column that is passed over, if the two seem to be a direction."""
    index, found = header.columns.indices.get("angle"), tuple[Advice, ...]()
    if index is None or not (np.abs(rows.values[:, 2]) <= MAX_COSINE).all():
        return ()
    for other in (index + 1, index - 1):
        if 0 <= other < len(header.names) and other not in header.columns.indices.values():
            texts = _texts(header, index, "angle"), _texts(header, other, "angle")
            names = header.names[index], header.names[other]
            found = found or direction_notes(texts[0], names, texts[1])
    return found


def _heights(header: Header) -> list[str] | None:
    """The texts of a column z, with decimal points; None without one."""
    index = header.columns.indices.get("z")
    return None if index is None else _texts(header, index, "z")


def _times(header: Header) -> FloatArray | None:
    """The times of the rows in seconds (also where no unit is stated); None without a column."""
    words = map(known, header.names)
    found = ((i, word) for i, word in enumerate(words) if word and word.role == "time")
    index, word = next(found, (0, None))
    texts = _texts(header, index, "time") if word else []
    if word is None or not all(map(pose_table.NUMBER.fullmatch, texts)):
        return None
    return np.array([float(text) for text in texts]) * _SECONDS.get(word.unit or "s", 1.0)


def _texts(header: Header, index: int, role: str) -> list[str]:
    """The texts of a column that is passed over, numbers with decimal points."""
    lines = _rows(ROW_LINE.finditer(header.source.text, header.end), header.separator)
    texts = []
    for _, cells in lines:
        cell = unquoted(cells[index]) if index < len(cells) else ""
        plain, mark = pose_table.plain_number(cell, header.separator)
        number = written_number(cell, role, header.separator) if mark is None else None
        texts.append(number.plain if number else plain)
    return texts


def _row_location(header: Header, row: int | None) -> str:
    """Where a row stands, by its number from 0; the file for None."""
    if row is None:
        return header.source.label
    lines = _rows(ROW_LINE.finditer(header.source.text, header.end), header.separator)
    line = next(line for k, (line, _) in enumerate(lines) if k == row)
    start = line.start() + len(line[0]) - len(line[0].lstrip())
    return header.source.where(start, line.end() - start)


def _not_a_mark(cell: str, row: int, where: str) -> InputError:
    """E104, for a cell of the column `exact`."""
    message = f"row {row} has {pose_table.shown(cell)} where yes or no belongs"
    help = "write yes or x for a pose to be met exactly, no or nothing for one to come near"
    return InputError("E104", message, where=where, help=help)


def require_one_mark(marks: dict[str, str]) -> None:
    """Refuse commas that nothing proves to be decimal ones."""
    where = marks.get("?") or marks.get(",")
    if where and "." in marks:
        why = "other numbers have a decimal point, so the comma may separate thousands"
    elif where and "," not in marks:
        why = "no number shows whether the comma is a decimal mark or separates thousands"
    else:
        return
    message = "a comma in a number can be read in two ways"
    help = "write every number with a decimal point, and none with a comma"
    raise InputError("E104", message, where=where, why=why, help=help)


def _require_width(line: re.Match[str], cells: list[str], header: Header, row: int) -> None:
    """Refuse a row with more or fewer cells than the header (E106), or one below no name (E107)."""
    given, needed, separator = len(cells), len(header.names), header.separator
    width = needed + header.spare
    filled = max(len(row_values(cells)), min(given, needed))
    first = next((i for i in range(needed, filled) if unquoted(cells[i])), None)
    where = header.source.where(line.end())
    if first is not None or given > width:
        extra = width if first is None else first
        where = cell_location(header.source, line.start(), cells, extra)
    if given == width:
        nameless = (i for i, name in enumerate(header.names) if not name and unquoted(cells[i]))
        if (first := next(nameless, first)) is not None:
            where = cell_location(header.source, line.start(), cells, first)
            message = f"row {row} has {pose_table.shown(unquoted(cells[first]))} below no name"
            help = "give its column a name, or delete the cell's content"
            raise InputError("E107", message, where=where, help=help)
        return
    named = brief(f" ({', '.join(header.names)})", "")
    help, why = f"give {needed} cells{named}, or delete the row", None
    if separator == "," and given > width and (parts := _parted_number(cells)):
        why = "a comma ends a cell here, so it cannot be a decimal mark as well"
        help = "write decimal points, or separate all cells by semicolons, also those of the header"
        if given != 2 * needed:
            why += f"; perhaps {','.join(parts)} is one number"
            help = f"write {'.'.join(parts)} if it is, or delete the comma that is too many"
    elif given > width and first is None:
        why = (
            f"{SEPARATOR_NAMES[separator][0]} too many may stand anywhere, also between two numbers"
        )
        help = f"delete {SEPARATOR_NAMES[separator][0]}, so that the row has {width} cells{named}"
    elif needed <= given < width:
        why = f"{width - needed} of them, at its end, without a name"
        help = "end all rows and the header with the same number of empty cells, or with none"
    other = next((s for s in "\t;|," if len(row_values(split_cells(line[0], s))) == needed), None)
    if given == 1 and other:
        one, two = SEPARATOR_NAMES[separator][0], SEPARATOR_NAMES[other][0]
        why = f"{one} separates the cells of the header, {two} these"
        edit = brief(
            f"`{other.join(header.names)}`",
            f"its names with {two} between them",
        )
        help = f"write the header as {edit}"
    message = f"row {row} has {given} cell{'' if given == 1 else 's'}, the header has {width}"
    raise InputError("E106", message, where=where, why=why, help=help)


def _parted_number(cells: list[str]) -> tuple[str, str] | None:
    """Two cells that a decimal comma may have made of one number."""
    for one, two in itertools.pairwise(map(unquoted, cells)):
        if re.fullmatch("[-+\u2212]?[0-9]+", one) and re.fullmatch("[0-9]+", two):
            return one, two
    return None
