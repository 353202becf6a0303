"""Poses in a grid: one a row, with one separator between cells.

Where another separator is used, commas may be decimal marks, if the numbers prove it.  A line
whose cells are all empty is blank; every other row has as many cells as the header, empty ones at
the end counted: with one more or less, nobody knows which number belongs to which column.  A line
that starts with # is a comment, unless it starts with an error value of a spreadsheet (#N/A).
`tables.columns` lists the names of columns.  Blocks of plain rows are read at once,
other blocks cell by cell, so that an error names its cell.  `burmester.io.reading.poses` lists the
errors.

A tolerance is a number, "free", or nothing.  A blank cell under x, y or the angle is a free
component where the header has the column `free` or one of a tolerance; then `free` names it, or its
tolerance is blank or says free.  A blank is never zero: without a default for all poses a blank
tolerance of a component that is given is refused.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterable, Mapping

import numpy as np

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import (
    MARKS,
    NUMBER,
    PoseTable,
    Rows,
    Source,
    brief,
    extent,
    no_poses,
    numeric_roles,
    shown,
)
from burmester.io.reading.stated_tolerances import FREE_WORDS, TOLERANCE_ROLES, free_components
from burmester.io.reading.tables.cell_numbers import CellNumbers
from burmester.io.reading.tables.column_words import known
from burmester.io.reading.tables.grid import SEPARATOR_NAMES, Grid, Row, rows_of, split_cells
from burmester.io.reading.tables.header import (
    MAX_COSINE,
    direction_notes,
    height_notes,
    read_header,
    require_directions,
)
from burmester.numerics.arrays import FloatArray
from burmester.tasks.pose_tolerances import COMPONENTS
from burmester.tasks.traced_path import TracedPath

BLOCK = 1 << 20  # characters parsed at a time, so that a million rows need little memory
LEAST_POINTS = 10  # of a path without crank angles; fewer points are met exactly
SAME_POINT = 1e-9  # of the path's extent; points that are nearer are one

_MARK = f"(?i:{'|'.join(filter(None, MARKS))})?"
_TINY = re.compile("[eE]-0*[0-9]{3}|0{300}")  # exponents and decimals that may be beyond a double
_SECONDS = {"s": 1.0, "ms": 1e-3, "min": 60.0}
WORD_ROLES = ("free", "tol_axes")  # columns of words, read together at the end of a row
_AXES = {"": "", "fixed": "fixed", "f": "fixed", "body": "body", "m": "body"}


def read_poses(source: Source, columns: str | None = None, *, closed: bool = False) -> PoseTable:
    """A header and a pose a line; raises E102 to E108, E113, E116 and E186.

    columns: the names of the columns, separated by commas, of a file without a header.
    closed: whether points alone are a closed path.
    """
    text, grid = source.text, read_header(source, columns)
    numbers = CellNumbers(grid.separator, stored=source.sheet is not None)
    blocks = list[Rows]()
    start, row = grid.begin, 1
    while start < len(text):
        end = text.find("\n", start + BLOCK)
        end = end if end >= 0 else len(text)
        rows = _plain_rows(text[start:end], grid, numbers.marks)
        if rows is None:
            lines = rows_of(source, grid.separator, start, end)
            rows = _checked_rows(lines, grid, numbers, row)
        if rows is not None:
            blocks.append(rows)
            row += len(rows.values)
        start = end + 1
    if not blocks:
        raise no_poses("the file has only a header")
    return _table(grid, Rows.joined(blocks), numbers, closed=closed)


def poses_of(grid: Grid, numbers: CellNumbers) -> PoseTable:
    """The poses in the rows of a grid that are no lines."""
    rows = _checked_rows(grid.rows(), grid, numbers, 1)
    if rows is None:
        raise no_poses("there are no rows")
    return _table(grid, rows, numbers, closed=False)


def _table(grid: Grid, rows: Rows, numbers: CellNumbers, *, closed: bool) -> PoseTable:
    """All that rows state, with what was passed over, and the path where they are points of one."""
    numbers.require_one_mark()
    units = numbers.units(grid.columns.units, len(rows.values))
    columns = grid.columns._replace(units=units)
    require_directions(rows, grid.locate)
    if rows.tolerances is not None:
        stated = rows.tolerances._replace(angle_unit=units.get("tol_angle"))
        rows = rows._replace(tolerances=stated)
    if grid.source.sheet and grid.source.sheet.printed:
        rows = rows._replace(decimals=_stored_decimals(grid))
    named = bool(columns.row_names(rows.names))
    height = columns.indices.get("z")
    heights = None if height is None else _texts(grid, numbers, height, "z")
    notes = (*grid.source.notes, *grid.notes, *columns.notes(), *numbers.notes())
    notes += (*_direction_notes(grid, numbers, rows), *height_notes(heights, rows, grid))
    table = PoseTable(
        rows._replace(names=columns.row_names(rows.names)),
        length_unit=columns.length_unit,
        angle_unit=columns.angle_unit,
        where=grid.where,
        say_unit=grid.say_unit,
        locate_row=grid.locate,
        notes=notes,
        read_as=grid.described(decimal_commas="," in numbers.marks, named=named),
        times=functools.partial(_times, grid, numbers),
        crank_unit=units.get("crank"),
    )
    return _as_path(table, grid, closed=closed)


def _plain_rows(block: str, grid: Grid, marks: dict[str, str]) -> Rows | None:
    """The rows of a block in which nothing is unusual, fast; None if something is."""
    separator, indices = grid.separator, grid.columns.indices
    if not indices.keys().isdisjoint(WORD_ROLES):
        return None
    if separator == " ":
        block = re.sub(r"(?m)^[ \t]+|[ \t]+$", "", re.sub(r"[ \t]+", " ", block))
    mark = "," if "," in marks else "."  # a comma once it is proved to be a decimal one
    text, number = rf'[^{separator}\n"#]*+', rf"[-+{mark}0-9eE]*+"
    looks = {"name": text, "exact": _MARK}
    like = {index: looks.get(role, number) for role, index in indices.items()}
    part, width = re.escape(separator), len(grid.names) + grid.spare
    cell = [like.get(i, text if name else "") for i, name in enumerate(grid.names)]
    cell += [""] * grid.spare
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
        elif grid.source.sheet is None and any("." in cell for cell in column):
            marks["."] = ""
    is_tiny = any(map(block.__contains__, ("e", "E", "0" * 300))) and _TINY.search(block)
    if is_tiny or not all(map(NUMBER.fullmatch, columns.get("z", ()))):
        return None
    try:  # of these characters alone, float() takes exactly what plain_number() does
        rows = Rows.read(columns)
    except ValueError:
        return None
    given = np.isfinite(rows.values)
    if {"angle", "px", "cos"}.isdisjoint(indices):
        given[:, 2] = True  # a point: its angle is free
    if rows.tolerances is not None:
        stated = rows.tolerances.bounds[:, rows.tolerances.columns]
        given = np.append(given, np.isfinite(stated))
    return rows if given.all() else None


def _checked_rows(
    lines: Iterable[Row], grid: Grid, numbers: CellNumbers, first: int
) -> Rows | None:
    """The rows in any lines, cell by cell; the first of them is number `first` of the file."""
    indices, units, tolerant = grid.columns.indices, grid.columns.units, grid.columns.may_be_free
    columns: dict[str, list[str]] = {role: [] for role in indices}
    numeric = {*numeric_roles(indices), *TOLERANCE_ROLES, "crank", "z"}
    if tolerant:
        columns["free"] = []
    count = 0
    for count, row in enumerate(lines, 1):
        number = first + count - 1
        if len(row.cells) != len(grid.names) or grid.unnamed:
            require_width(row, grid, number)
        for role, index in indices.items():
            if role == "free":
                continue
            cell = row.value(index)
            blank_may_be = tolerant or role in ("angle", "crank")
            special = _special_text(cell, role) if blank_may_be else None
            if special is not None:  # a blank angle is free: a point of the body
                cell = special
            elif role == "exact" and cell.lower() not in MARKS:
                message = f"row {number} has {shown(cell)} where yes or no belongs"
                help = "write yes or x for a pose to be met exactly, no or nothing for one to come "
                help += "near"
                raise InputError("E104", message, where=row.where(index, role), help=help)
            elif role == "tol_axes":
                if (axes := _AXES.get(cell.lower())) is None:
                    message = f"row {number} has {shown(cell)} where the axes of a tolerance belong"
                    help = "write fixed (along x and y of F) or body (along the body's own axes)"
                    raise InputError("E104", message, where=row.where(index, role), help=help)
                cell = axes
            elif role in numeric:
                where = functools.partial(row.where, index, role)
                quoted = '"' in row.cells[index]
                cell = numbers.read(cell, number, where, role, units[role], quoted=quoted)
            columns[role].append(cell)
        if tolerant:
            columns["free"].append(_free_in_row(row, indices, number))
    return Rows.read(columns) if count else None


def _as_path(table: PoseTable, grid: Grid, *, closed: bool) -> PoseTable:
    """Points alone as a path, where there are many, or the crank times them, or it is closed.

    The angles of all are blank or have no column, and they have no names of their own, no marks
    and no tolerances.  The path is closed where its last point repeats its first.
    """
    rows, roles = table.rows, grid.columns.indices.keys()
    beside = roles - {"x", "y", "angle", "weight", "crank", "z"}
    if beside - ({"name"} if grid.columns.numbered else set()) or "x" not in roles:
        return table
    timed = "crank" in roles and table.crank_unit is not None
    if np.isfinite(rows.values[:, 2]).any() or ("crank" in roles and not timed):
        return table
    points = rows.values[:, :2]
    gap = float(np.hypot(*(points[-1] - points[0])))
    repeats = len(points) > 3 and gap <= SAME_POINT * extent(points)
    if not (closed or timed or repeats or len(points) >= LEAST_POINTS):
        return table
    notes = table.notes
    if repeats:
        message = "the last point repeats the first: the path is taken as closed"
        notes += (Advice("W213", message, "delete the last point if the path is open"),)
        rows = rows.at(np.arange(len(points) - 1))
    return table._replace(
        rows=rows._replace(names=[]),
        angle_unit="deg",
        notes=notes,
        path=TracedPath(closed or repeats),
        read_as=table.read_as and f"points of a path in {table.read_as}",
    )


def _stored_decimals(grid: Grid) -> tuple[float, float]:
    """The most that a length and an angle are printed with, where numbers were stored in binary."""
    printed = (grid.source.sheet and grid.source.sheet.printed) or {}
    most = {role: printed.get(index, 0.0) for role, index in grid.columns.indices.items()}
    lengths = max(most.get(role, 0.0) for role in ("x", "y", "px", "py", "qx", "qy"))
    return lengths, max(most.get(role, 0.0) for role in ("angle", "cos", "sin"))


def _direction_notes(grid: Grid, numbers: CellNumbers, rows: Rows) -> tuple[Advice, ...]:
    """W243, for angles beside a column that is passed over, if the two seem to be a direction."""
    index = grid.columns.indices.get("angle")
    if index is None or not (np.abs(rows.values[:, 2]) <= MAX_COSINE).all():
        return ()
    for other in (index + 1, index - 1):
        if 0 <= other < len(grid.names) and other not in grid.columns.indices.values():
            cosine, sine = (_texts(grid, numbers, i, "angle") for i in (index, other))
            names = (grid.names[index], grid.names[other])
            if notes := direction_notes(cosine, sine, names):
                return notes
    return ()


def _times(grid: Grid, numbers: CellNumbers) -> FloatArray | None:
    """The times of the rows in seconds (also where no unit is stated); None without a column."""
    words = map(known, grid.names)
    found = ((i, word) for i, word in enumerate(words) if word and word.role == "time")
    index, word = next(found, (0, None))
    texts = _texts(grid, numbers, index, "time") if word else []
    if word is None or not all(map(NUMBER.fullmatch, texts)):
        return None
    return np.array([float(text) for text in texts]) * _SECONDS.get(word.unit or "s", 1.0)


def _texts(grid: Grid, numbers: CellNumbers, index: int, role: str) -> list[str]:
    """The texts of a column that is passed over, numbers with decimal points."""
    return [numbers.text(row.value(index), role) for row in grid.rows()]


def require_width(row: Row, grid: Grid, number: int) -> None:
    """Refuse a row with more or fewer cells than the header (E106), or one below no name (E107)."""
    cells, given, needed, separator = row.cells, len(row.cells), len(grid.names), grid.separator
    width = needed + grid.spare
    filled = max(len(row.values()), min(given, needed))
    first = next((i for i in range(needed, filled) if row.value(i)), None)
    if given == width:
        nameless = (i for i, name in enumerate(grid.names) if not name and row.value(i))
        if (first := next(nameless, first)) is not None:
            message = f"row {number} has {shown(row.value(first))} below no name"
            help = "give its column a name, or delete the cell's content"
            raise InputError("E107", message, where=row.where(first), help=help)
        return
    where = row.source.where(row.start + len("".join(cells)) + given - 1)
    if first is not None or given > width:
        where = row.where(width if first is None else first)
    named = brief(f" ({', '.join(grid.names)})", "")
    help, why = f"give {needed} cells{named}, or delete the row", None
    one = SEPARATOR_NAMES[separator][0]
    if separator == "," and given > width and (parts := _parted_number(row)):
        why = "a comma ends a cell here, so it cannot be a decimal mark as well"
        help = "write decimal points, or separate all cells by semicolons, also those of the header"
        if given != 2 * needed:
            why += f"; perhaps {','.join(parts)} is one number"
            help = f"write {'.'.join(parts)} if it is, or delete the comma that is too many"
    elif given > width and first is None:
        why = f"{one} too many may stand anywhere, also between two numbers"
        help = f"delete {one}, so that the row has {width} cells{named}"
    elif needed <= given < width:
        why = f"{width - needed} of them, at its end, without a name"
        help = "end all rows and the header with the same number of empty cells, or with none"
    line = separator.join(cells)
    others = ((s, Row(row.source, row.start, split_cells(line, s))) for s in "\t;|,")
    other = next((s for s, parted in others if len(parted.values()) == needed), None)
    if given == 1 and other:
        two = SEPARATOR_NAMES[other][0]
        why = f"{one} separates the cells of the header, {two} these"
        edit = brief(f"`{other.join(grid.names)}`", f"its names with {two} between them")
        help = f"write the header as {edit}"
    message = f"row {number} has {given} cell{'' if given == 1 else 's'}, the header has {width}"
    raise InputError("E106", message, where=where, why=why, help=help)


def _parted_number(row: Row) -> tuple[str, str] | None:
    """Two cells that a decimal comma may have made of one number."""
    for one, two in itertools.pairwise(map(row.value, range(len(row.cells)))):
        if re.fullmatch("[-+\u2212]?[0-9]+", one) and re.fullmatch("[0-9]+", two):
            return one, two
    return None


def _special_text(cell: str, role: str) -> str | None:
    """A blank cell is "nan", a word for free "inf"; None where a number or text belongs."""
    if not cell and role in (*COMPONENTS, *TOLERANCE_ROLES, "crank"):
        return "nan"
    return "inf" if role in TOLERANCE_ROLES and cell.lower() in FREE_WORDS else None


def _free_in_row(row: Row, indices: Mapping[str, int], number: int) -> str:
    """The components that a row leaves free, by its cells (by role); raises E104 and E136."""
    cells = {role: row.value(index) for role, index in indices.items()}
    named = free_components(cells.get("free", ""))
    if named is None:
        message = f"row {number} has {shown(cells['free'])} where free components belong"
        help = "name x, y, angle or two of them with a blank between, or leave the cell blank"
        where = row.where(indices["free"], "free")
        raise InputError("E104", message, where=where, help=help)
    out = []
    for component, role in zip(COMPONENTS, TOLERANCE_ROLES, strict=True):
        tolerance, blank = cells.get(role, ""), cells.get(component) == ""
        is_free = tolerance.lower() in FREE_WORDS
        if tolerance and not is_free and (blank or component in named):
            free = f"{component} among its free components" if component in named else component
            has = "has" if component in named else "has no"
            raise InputError(
                "E136",
                f"row {number} {has} {free}, and a tolerance of {tolerance} for it",
                where=row.where(indices[role], role),
                why="a component within a tolerance has a number, a free one has no tolerance",
                help=f"give {component} a number and take it out of free, or leave its tolerance "
                "blank",
            )
        says_free = component in named or is_free
        if blank and "free" in cells and not says_free:
            raise InputError(
                "E104",
                f"row {number} has no {component}, and its cell of free does not name it",
                where=row.where(indices[component], component),
                why="a blank is never zero, and means free where the row says so",
                help=f"write {component} into this row's cell of free, or give a number",
            )
        if blank or says_free:
            out.append(component)
    return " ".join(out)
