"""Pairs of angles in a grid: CSV, a sheet of a workbook, Parquet.

E102 no rows                       E106 a row of the wrong length
E103 and E104 not a number         E107 a column that is not known
E105 a column is missing           E108 a column twice
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from burmester.errors import InputError
from burmester.functions.function_task import FunctionTask
from burmester.io.reading.functions.function_kind import ANGLE_COLUMNS, head_of
from burmester.io.reading.functions.function_options import FunctionSettings, task_of_pairs
from burmester.io.reading.pose_table import SHEET_HEAD, Source, no_poses, shown
from burmester.io.reading.tables.cell_numbers import CellNumbers
from burmester.io.reading.tables.grid import rows_of
from burmester.numerics.arrays import FloatArray

WEIGHT: Final = "weight"


def _columns(names: Sequence[str], where: str | None) -> dict[str, tuple[int, str | None]]:
    """The columns by role, input, output and perhaps weight, and their units.

    Raises E105, E107 and E108.
    """
    columns: dict[str, tuple[int, str | None]] = {}
    for index, name in enumerate(names):
        if name.startswith("#") or not name:
            continue
        found = ANGLE_COLUMNS.fullmatch(name)
        if found is None and name != WEIGHT:
            raise InputError(
                "E107",
                f"the column {shown(name)} is not known here",
                where=where,
                help="the columns of a function are input_deg, output_deg and, if wanted, weight; "
                f"name it `#{name}` to have it ignored",
            )
        role = found[1] if found else name
        if role in columns:
            raise InputError(
                "E108", f"two columns for {role}", where=where, help="delete one of the two columns"
            )
        columns[role] = index, found and found[2]
    for needed in ("input", "output"):
        if needed not in columns:
            raise InputError(
                "E105",
                f"the column of the {needed} is missing",
                where=where,
                help=f"add a column {needed}_deg with the angles of the {needed} link",
            )
    return columns


def read_pairs(source: Source, settings: FunctionSettings) -> FunctionTask:
    """The task in a header and a pair a line."""
    _, separator = head_of(source.text)
    rows = list(rows_of(source, separator, len(SHEET_HEAD) if source.sheet else 0))
    if not rows:
        raise no_poses("the file has only comments")
    head = rows.pop(0)
    names = [name.lower() for name in map(head.value, range(len(head.cells)))]
    columns = _columns(names, head.where())
    own = CellNumbers(separator, stored=source.sheet is not None)
    numbers: dict[str, list[float]] = {role: [] for role in columns}
    for number, row in enumerate(rows, start=1):
        if len(row.cells) != len(names):
            raise InputError(
                "E106",
                f"{len(row.cells)} cells where the header has {len(names)}",
                where=row.where(),
                help=f"give {len(names)} cells in every row",
            )
        for role, (column, unit) in columns.items():
            where = functools.partial(row.where, column, role)
            quoted = '"' in row.cells[column]
            text = own.read(row.value(column), number, where, unit=unit, quoted=quoted)
            numbers[role].append(math.degrees(float(text)) if unit == "rad" else float(text))
    own.require_one_mark()
    arrays = {role: np.array(values) for role, values in numbers.items()}
    weights = arrays.get(WEIGHT)
    require_weights(weights, head.where())
    inputs, outputs = arrays["input"], arrays["output"]
    return task_of_pairs(inputs, outputs, weights, settings, where=lambda k: rows[k].where())


def require_weights(weights: FloatArray | None, where: str | None) -> None:
    """Refuse weights below zero, and weights that are all zero: E191."""
    if weights is not None and not ((weights >= 0).all() and (weights > 0).any()):
        raise InputError(
            "E191",
            "a weight is below zero, or all are zero",
            where=where,
            help="give weights above zero, or leave them out",
        )
