"""A path as a table: points x,y in the order in which they are traced, no angle of the body.

A column of angles may be there, if all of its cells are blank.

A column crank_deg or crank_rad says by how much the crank has turned at each point.  The path is
closed where its last point repeats its first.

E103 and E104 no number        E106 cells that are missing or too many
E186 crank angles that do not fit
"""

from __future__ import annotations

import functools
import re
from typing import NamedTuple

import numpy as np

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import (
    SHEET_HEAD,
    PoseTable,
    Rows,
    Source,
    decimals,
    extent,
    plain_number,
)
from burmester.io.reading.stated_tolerances import StatedTolerances
from burmester.io.reading.tables.column_words import known
from burmester.io.reading.tables.csv_cells import (
    ROW_LINE,
    cell_location,
    row_values,
    split_cells,
    unquoted,
)
from burmester.io.reading.tables.wrong_numbers import not_a_number
from burmester.numerics.arrays import FloatArray
from burmester.printable import printable
from burmester.tasks.traced_path import TracedPath
from burmester.wording import listed

__all__ = ["read_path_table"]

LEAST_POINTS = 10  # of a path without crank angles; fewer points are met exactly
SAME_POINT = 1e-9  # of the path's extent; points that are nearer are one


class _Columns(NamedTuple):
    """Where x, y, weight and the crank angle stand in a row, and their units.

    angle: where the angle of the body stands, which no row may have.
    """

    indices: dict[str, int]
    angle: int | None
    width: int
    separator: str
    length_unit: str | None
    crank_unit: str
    names: tuple[str, ...]


def read_path_table(source: Source, *, closed: bool = False) -> PoseTable | None:
    """The table of a path; None where the text is none.

    That is where a row has an angle of the body, or the header other columns than x, y, weight,
    numbers, times and crank angles; and of fewer than LEAST_POINTS points that are neither timed
    nor closed.
    """
    lines = ROW_LINE.finditer(source.text, len(SHEET_HEAD) if source.sheet else 0)
    head = next(lines, None)
    columns = None if head is None else _columns(head[0])
    if columns is None or head is None or _has_angles(source.text, head.end(), columns):
        return None
    rows: list[list[float]] = []
    starts: list[re.Match[str]] = []
    digits = 0.0
    for line in lines:
        cells = split_cells(line[0], columns.separator)
        if not row_values(cells):
            continue
        texts = _numbers(source, line, cells, columns, len(rows) + 1)
        digits = max(digits, *map(decimals, texts[:2]))
        rows.append(list(map(float, texts)))
        starts.append(line)
    values = np.array(rows)
    path = closed or "crank" in columns.indices or len(rows) >= LEAST_POINTS
    if not rows or not (path or _repeats(values)):
        return None
    repeats = len(rows) > 2 and _repeats(values)
    values = values[:-1] if repeats else values
    roles = list(columns.indices)
    crank = None
    if "crank" in columns.indices:
        crank = values[:, roles.index("crank")]
        crank = crank if columns.crank_unit == "rad" else np.radians(crank)
    count = len(values)
    numbers = [values[:, :2], np.full((count, 1), np.nan)]
    if "weight" in roles:
        numbers.append(values[:, [roles.index("weight")]])
    free = StatedTolerances(np.tile([np.nan, np.nan, np.inf], (count, 1)), [""] * count)
    notes: tuple[Advice, ...] = ()
    if repeats:
        notes = (
            Advice(
                "W213",
                "the last point repeats the first: the path is taken as closed",
                "delete the last point if the path is open",
            ),
        )
    return PoseTable(
        Rows(np.concatenate(numbers, axis=1), (digits, 0.0), [], [], tolerances=free),
        length_unit=columns.length_unit,
        angle_unit="deg",
        where=source.where(head.start(), len(head[0])),
        say_unit="",
        locate_row=functools.partial(_locate, source, starts),
        notes=(*source.notes, *notes),
        path=TracedPath(closed or repeats, crank),
        read_as=f"points of a path; columns {listed(columns.names)}",
    )


def _columns(line: str) -> _Columns | None:
    """The columns of a header of a path, by the separator with which it is one."""
    for separator in ",\t;| ":
        names = row_values(split_cells(line, separator))
        indices, units, crank_unit = dict[str, int](), dict[str, str | None](), "deg"
        for k, name in enumerate(names):
            word = known(name)
            if word is None or word.unit == "?":
                break
            role, unit = word.role, word.unit
            if role == "crank" and unit is None:
                break
            if role == "crank":
                crank_unit = unit or crank_unit
            if role in indices:
                break
            indices[role], units[role] = k, unit
        else:
            wanted = {"x", "y"} <= indices.keys()
            beside = indices.keys() - {"x", "y", "angle", "weight", "crank", "number", "time"}
            if wanted and not beside and units["x"] == units["y"]:
                roles: tuple[str, ...] = ("x", "y", "weight", "crank")
                chosen = {role: indices[role] for role in roles if role in indices}
                told = tuple(printable(names[at].strip()) for at in sorted(chosen.values()))
                angle, width = indices.get("angle"), len(names)
                return _Columns(chosen, angle, width, separator, units["x"], crank_unit, told)
    return None


def _has_angles(text: str, begin: int, columns: _Columns) -> bool:
    """Whether some row below the header, which ends at `begin`, has an angle, or too few cells."""
    if (angle := columns.angle) is None:
        return False
    rows = (split_cells(line[0], columns.separator) for line in ROW_LINE.finditer(text, begin))
    return any(len(cells) <= angle or unquoted(cells[angle]) for cells in rows)


def _numbers(
    source: Source, line: re.Match[str], cells: list[str], columns: _Columns, row: int
) -> list[str]:
    """The numbers of a row as texts with decimal points; raises E103, E104 and E106."""
    if len(row_values(cells)) > columns.width or len(cells) < columns.width:
        raise InputError(
            "E106",
            f"row {row} has {len(cells)} cell{'' if len(cells) == 1 else 's'}, the header has "
            f"{columns.width}",
            where=source.where(line.start(), len(line[0])),
            help=f"give {columns.width} cells, or delete the row",
        )
    texts = []
    for role, index in columns.indices.items():
        cell = unquoted(cells[index])
        plain, mark = plain_number(cell, columns.separator)
        if mark is None or mark == "?":
            where = cell_location(source, line.start(), cells, index, role)
            if role == "crank" and not cell:
                message = f"row {row} has no crank angle"
                help = "give every point its crank angle, or delete the column"
                raise InputError("E186", message, where=where, help=help)
            raise not_a_number(
                cell, plain, row=row, unit=None, where=where, separator=columns.separator
            )
        texts.append(plain)
    return texts


def _repeats(values: FloatArray) -> bool:
    """Whether the last of points (N, 2 or more) is the first again."""
    gap = float(np.hypot(*(values[-1, :2] - values[0, :2])))
    return len(values) > 3 and gap <= SAME_POINT * extent(values[:, :2])


def _locate(source: Source, lines: list[re.Match[str]], row: int | None) -> str:
    """Where a row stands, by its number from 0; the file for None."""
    if row is None:
        return source.label
    return source.where(lines[row].start(), len(lines[row][0]))
