"""Pairs of angles in tables: CSV, a sheet of a workbook, Parquet.

E101 not readable                  E105 a column is missing
E102 no rows                       E107 a column that is not known
E104 not a number                  E108 a column twice
E106 a row of the wrong length
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.functions.function_task import FunctionTask
from burmester.io.reading.functions.function_kind import ANGLE_COLUMNS, header_of
from burmester.io.reading.functions.function_options import FunctionSettings, task_of_pairs
from burmester.io.reading.pose_table import (
    NUMBER,
    Source,
    no_poses,
    plain_number,
    shown,
    unheld,
)
from burmester.numerics.arrays import FloatArray

__all__ = [
    "WEIGHT",
    "read_pair_parquet",
    "read_pair_text",
    "require_weights",
]

WEIGHT: Final = "weight"


class Column(NamedTuple):
    """Where the numbers of a role stand, and the unit of angles."""

    place: int
    unit: str


def _columns(names: Sequence[str], where: str | None) -> dict[str, Column]:
    """The columns by role: input, output and perhaps weight; raises E105, E107 and E108."""
    columns: dict[str, Column] = {}
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
        columns[role] = Column(index, found[2] if found else "")
    for needed in ("input", "output"):
        if needed not in columns:
            raise InputError(
                "E105",
                f"the column of the {needed} is missing",
                where=where,
                help=f"add a column {needed}_deg with the angles of the {needed} link",
            )
    return columns


def read_pair_text(source: Source, settings: FunctionSettings) -> FunctionTask:
    """The task in a text with a separator between its cells."""
    first, names, separator = header_of(source.text)
    lines = source.text.split("\n")
    starts = np.cumsum([0, *(len(line) + 1 for line in lines)]).tolist()
    head = source.where(starts[first], len(lines[first]))
    columns = _columns(names, head)
    numbers: dict[str, list[float]] = {role: [] for role in columns}
    places: list[str] = []
    for number, line in enumerate(lines[first + 1 :], start=first + 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        cells = line.split(separator)
        where = source.where(starts[number], len(line))
        if len(cells) != len(names):
            raise InputError(
                "E106",
                f"{len(cells)} cells where the header has {len(names)}",
                where=where,
                help=f"give {len(names)} cells in every row",
            )
        for role, (column, unit) in columns.items():
            cell = cells[column].strip().strip('"')
            plain, mark = plain_number(cell, separator)
            if mark is None:
                raise InputError(
                    "E104",
                    f"{shown(cell)} is not a number",
                    where=where,
                    why=unheld(plain) if NUMBER.fullmatch(plain) else None,
                    help="write a number with a decimal point, such as 12.5",
                )
            value = float(plain)
            numbers[role].append(math.degrees(value) if unit == "rad" else value)
        places.append(where)
    arrays = {role: np.array(values) for role, values in numbers.items()}
    weights = arrays.get(WEIGHT)
    require_weights(weights, head)
    inputs, outputs = arrays["input"], arrays["output"]
    return task_of_pairs(inputs, outputs, weights, settings, where=places.__getitem__)


def read_pair_parquet(label: str, data: bytes, settings: FunctionSettings) -> FunctionTask:
    """The task in the bytes of a Parquet file whose columns `is_pair_parquet` knows."""
    import pyarrow
    import pyarrow.parquet

    try:
        table = pyarrow.parquet.read_table(pyarrow.BufferReader(data))
    except Exception as error:  # of many kinds, for files that are damaged
        why = str(error).partition("\n")[0][:200]
        help = "write the file again, or save the pairs as CSV"
        raise InputError("E101", "this Parquet file cannot be read", why=why, help=help) from None
    if not table.num_rows:
        raise no_poses("the file has no rows")
    names = [str(name).strip().lower() for name in table.column_names]
    rows = zip(*(map(str, column.to_pylist()) for column in table.columns), strict=True)
    text = "\n".join(map(",".join, [names, *rows]))
    return read_pair_text(Source(label, text), settings)


def require_weights(weights: FloatArray | None, where: str | None) -> None:
    """Refuse weights below zero, and weights that are all zero: E191."""
    if weights is not None and not ((weights >= 0).all() and (weights > 0).any()):
        raise InputError(
            "E191",
            "a weight is below zero, or all are zero",
            where=where,
            help="give weights above zero, or leave them out",
        )
