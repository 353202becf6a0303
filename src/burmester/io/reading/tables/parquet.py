"""Poses in Parquet: columns as in the header of a CSV file, and every number as it is stored.

Integers, floats and decimals are numbers, and so is a column without any value; text is for names
alone.  A resolution is taken from the shortest decimals that a number can be printed with.
The errors are those that `burmester.io.reading.poses` lists.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from burmester.errors import InputError
from burmester.io.reading import pose_table
from burmester.io.reading.file_content import MAX_LINES, too_large
from burmester.io.reading.pose_table import (
    DIRECTION,
    PoseTable,
    Rows,
    decimals,
    numeric_roles,
    with_angles,
)
from burmester.io.reading.stated_tolerances import TOLERANCE_ROLES, StatedTolerances
from burmester.io.reading.tables.columns import Columns, read_columns
from burmester.io.reading.tables.direction_columns import require_directions
from burmester.io.reading.tables.tolerance_cells import WORD_ROLES, read_words, special_text
from burmester.numerics.arrays import FloatArray
from burmester.tasks.pose_tolerances import COMPONENTS

__all__ = ["read_parquet"]

_Where: TypeAlias = Callable[[int | None, int | None], str]  # the location of a column and a row


def read_parquet(label: str, data: bytes) -> PoseTable:
    """The poses in the bytes of a Parquet file; raises E101 to E108, and E130 without pyarrow."""
    file = _open(data)
    names = _read_or_refuse(lambda: file.schema_arrow.names)

    def where(i: int | None, row: int | None = None) -> str:
        parts = [f"row {row + 1}"] if row is not None else []
        if i is not None:
            parts.append(pose_table.brief(f"column {names[i]}", f"column number {i + 1}"))
        return f"{label}: {', '.join(parts)}" if parts else label

    columns = read_columns(names, where, 'name it "#{}"')
    indices = columns.indices
    if (count := file.metadata.num_rows) > MAX_LINES:  # a few bytes may stand for them all
        raise too_large(f"it has {count} rows, and {MAX_LINES} are the most")
    stored = _read_or_refuse(lambda: file.read(columns=[names[i] for i in indices.values()]))
    if not stored.num_rows:
        raise pose_table.no_poses("the file has no rows")
    numbers: list[FloatArray] = []
    printed: dict[str, float] = {}
    for role in numeric_roles(indices):
        i = indices[role]
        values, texts = _numbers(stored.column(names[i]), names[i], where(i))
        bad = ~np.isfinite(values)
        if columns.may_be_free and role in COMPONENTS:
            bad &= np.array([text is not None for text in texts])  # no value may be a free one
        if bad.any():
            row = int(bad.argmax())
            given = "no value" if texts[row] is None else "a value that is not a finite number"
            raise InputError(
                "E103",
                f"row {row + 1} has {given}",
                where=where(i, row),
                help="give a number, or delete the row",
            )
        numbers.append(values)
        printed[role] = 0.0
        if role != "weight":
            printed[role] = max((decimals(text) for text in texts if text), default=0.0)
    angle = max(printed.pop(role, 0.0) for role in ("angle", *DIRECTION))
    tolerances = lengths = None
    if "cos" in indices:
        values, lengths = with_angles(np.stack(numbers, axis=1))
        numbers = list(values.T)
    points = {"angle", "px", "cos"}.isdisjoint(indices)
    if points:  # of the body
        numbers.insert(2, np.full(stored.num_rows, np.nan))
    if columns.may_be_free:
        tolerances = _tolerances(stored, names, columns, where)
    if points:
        tolerances = tolerances or StatedTolerances.none(stored.num_rows)
        tolerances.bounds[:, 2] = np.inf
    given_names = _list(stored, names, indices.get("name"), where)
    names_of = columns.row_names([str(value) if value is not None else "" for value in given_names])
    exact = _marks(stored, names, indices.get("exact"), where)
    rows = Rows(
        np.stack(numbers, axis=1),
        (max(printed.values()), angle),
        names_of,
        exact,
        2 * ("px" in indices),
        tolerances,
        lengths,
        _crank(stored, names, indices.get("crank"), where),
    )
    require_directions(rows, lambda row: where(None, row))
    return PoseTable(
        rows,
        length_unit=columns.length_unit,
        angle_unit=columns.angle_unit,
        where=where(indices.get("angle")),
        say_unit="name the column angle_deg or angle_rad",
        locate_row=lambda row: where(None, row),  # where(None, None) is the file
        notes=columns.notes(),
        read_as=f"Parquet: {columns.described(names)}",
        crank_unit=columns.units.get("crank"),
    )


def _crank(stored: Any, names: list[str], index: int | None, where: _Where) -> FloatArray | None:
    """The angles of the driver, nan for no value; None without a column."""
    if index is None:
        return None
    return _numbers(stored.column(names[index]), names[index], where(index, None))[0]


def _tolerances(
    stored: Any, names: list[str], columns: Columns, where: _Where
) -> StatedTolerances | None:
    """The columns of tolerances, read as those of a CSV file."""
    cells: dict[str, list[str]] = {}
    for role, index in columns.indices.items():
        if role in (*COMPONENTS, *TOLERANCE_ROLES, *WORD_ROLES):
            values = _list(stored, names, index, where)
            cells[role] = ["" if value is None else str(value).strip() for value in values]
    texts: dict[str, list[str]] = {role: [] for role in (*cells, *WORD_ROLES)}
    for row in range(stored.num_rows):
        given = {role: cell[row] for role, cell in cells.items()}

        def at(role: str, row: int = row) -> str:
            return where(columns.indices.get(role), row)

        for role in TOLERANCE_ROLES:
            if role in given:
                text = special_text(given[role], role) or given[role]
                if text not in ("nan", "inf") and not pose_table.NUMBER.fullmatch(text):
                    message = f"row {row + 1} has {pose_table.shown(text)}, which is no tolerance"
                    help = "store a number, 0 for exact, or no value"
                    raise InputError("E104", message, where=at(role), help=help)
                texts[role].append(text)
        read_words(texts, given, row + 1, at)
    found = StatedTolerances.read(texts, stored.num_rows)
    return found and found._replace(angle_unit=columns.units.get("tol_angle"))


def _open(data: bytes) -> Any:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise InputError(
            "E130",
            "reading Parquet needs pyarrow",
            why="it cannot be imported",
            help='pip install "burmester[data]"',
        ) from None
    return _read_or_refuse(lambda: pyarrow.parquet.ParquetFile(pyarrow.BufferReader(data)))


def _read_or_refuse(read: Callable[[], Any]) -> Any:
    """The result of a pyarrow call, or E101."""
    try:
        return read()
    except Exception as error:  # of many kinds, for files that are damaged
        why = str(error).partition("\n")[0][:200]
        help = "write the file again, or save the poses as CSV"
        raise InputError("E101", "this Parquet file cannot be read", why=why, help=help) from None


def _numbers(column: Any, name: str, where: str) -> tuple[FloatArray, list[str | None]]:
    """A column as doubles (NaN for no value), and as its shortest texts."""
    from pyarrow import types

    kind = column.type
    if types.is_floating(kind):
        values: list[Any] = column.to_pylist()
        doubles = column.to_numpy().astype(np.float64)
        if not types.is_float64(kind):  # 0.1 in 32 bits is printed as 0.1
            short = np.float32 if types.is_float32(kind) else np.float16
            return doubles, [None if v is None else _short(str(short(v))) for v in values]
        return doubles, [None if v is None else _short(repr(v)) for v in values]
    if types.is_integer(kind) or types.is_decimal(kind) or types.is_null(kind):
        texts = [None if v is None else _short(str(v)) for v in column.to_pylist()]
        return np.array([np.nan if text is None else float(text) for text in texts]), texts
    message = f"the column {pose_table.shown(name)} holds {kind}, not numbers"
    raise InputError("E104", message, where=where, help="store it as float64")


def _short(text: str) -> str:
    """A number without the noughts behind its point: those are not stored."""
    mantissa, e, exponent = text.lower().partition("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return mantissa + e + exponent


def _list(stored: Any, names: list[str], index: int | None, where: _Where) -> list[Any]:
    """The values of a column that need not be there; raises E101 for what Python cannot hold.

    Damaged text is a ValueError, a date beyond the year 9999 an OverflowError, and more kinds come
    from types that a later Arrow may add.
    """
    if index is None:
        return []
    column, values = stored.column(names[index]), []
    with contextlib.suppress(Exception):
        return list(column.to_pylist())
    for row, each in enumerate(column):
        try:
            values.append(each.as_py())
        except Exception as error:
            why = str(error).partition("\n")[0][:200]
            message = f"row {row + 1} has a value that cannot be read"
            help = "write the file again with another text there, or without this column"
            raise InputError("E101", message, where=where(index, row), why=why, help=help) from None
    return values


def _marks(stored: Any, names: list[str], index: int | None, where: _Where) -> list[bool]:
    """The column `exact`: true and false, or what stands for them in a CSV file."""
    marks = []
    for row, value in enumerate(_list(stored, names, index, where)):
        text = "" if value is None else str(value).strip().lower()
        if text not in pose_table.MARKS:
            message = f"row {row + 1} has {pose_table.shown(value)} where yes or no belongs"
            help = "store true for a pose to be met exactly, false for one to come near"
            raise InputError("E104", message, where=where(index, row), help=help)
        marks.append(pose_table.MARKS[text])
    return marks
