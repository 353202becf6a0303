"""Parquet as text with tabs between its cells, which is then read as CSV.

Every number is the one that is stored: integers, floats and decimals, and a column without any
value; text is for names and words alone.  A resolution is taken from the shortest decimals that a
number can be printed with.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from burmester.errors import InputError, library
from burmester.io.reading.file_content import MAX_LINES, too_large
from burmester.io.reading.pose_table import (
    DIRECTION,
    NUMERIC,
    POINTS,
    SHEET_HEAD,
    Sheet,
    Source,
    decimals,
    no_poses,
    shown,
)
from burmester.io.reading.stated_tolerances import TOLERANCE_ROLES
from burmester.io.reading.tables.column_words import IGNORED, known
from burmester.io.reading.tables.tolerance_cells import WORD_ROLES

_NUMBERS = (*NUMERIC, *DIRECTION, *POINTS, "crank")
_WORDS = ("name", "number", "exact", *TOLERANCE_ROLES, *WORD_ROLES)


def read_parquet(label: str, data: bytes) -> Source:
    """The table in the bytes of a Parquet file; raises E101, E102, E104, and E130 without pyarrow.

    Columns that are passed over are blank, unless they hold numbers.
    """
    file = _open(data)
    names: list[str] = _read_or_refuse(lambda: file.schema_arrow.names)
    head = SHEET_HEAD + "\t".join(map(_cell, names))
    sheet = Sheet("Parquet", {}, tuple(names))
    roles = [None if (word := known(name)) is None else word.role for name in names]
    if (count := file.metadata.num_rows) > MAX_LINES:  # a few bytes may stand for them all
        raise too_large(f"it has {count} rows, and {MAX_LINES} are the most")
    kinds = _read_or_refuse(lambda: file.schema_arrow.types)
    for name, role, kind in zip(names, roles, kinds, strict=True):
        if role in _NUMBERS and not holds_numbers(kind):
            where = _place(label, sheet, names.index(name), -1)
            message = f"the column {shown(name)} holds {kind}, not numbers"
            raise InputError("E104", message, where=where, help="store it as float64")
    if not count:
        raise no_poses("the file has no rows")
    read = [
        i
        for i, (role, kind) in enumerate(zip(roles, kinds, strict=True))
        if role in _WORDS or (role != IGNORED and holds_numbers(kind))
    ]
    if len({names[i] for i in read}) < len(read):
        return Source(label, head, (), sheet)  # two columns of one name are refused by it
    stored = _read_or_refuse(lambda: file.read(columns=[names[i] for i in read]))
    tolerant = not {*TOLERANCE_ROLES, *WORD_ROLES}.isdisjoint(roles)
    columns: list[list[str]] = [[""] * count for _ in names]
    shortest: dict[int, list[str]] = {}
    for i in read:
        column, role = stored.column(names[i]), roles[i]
        if holds_numbers(kinds[i]):
            may_be_blank = role not in _NUMBERS or role == "crank"
            may_be_blank |= tolerant and role in NUMERIC[:3]
            columns[i], shortest[i] = _numbers(column, "" if may_be_blank else "nan")
        else:
            place = functools.partial(_place, label, sheet, i)
            columns[i] = [_cell("" if v is None else str(v)) for v in _values(column, place)]
    if any(texts is not columns[i] for i, texts in shortest.items()):
        printed = {i: max(map(decimals, texts), default=0.0) for i, texts in shortest.items()}
        sheet = sheet._replace(printed=printed)
    return Source(label, "\n".join([head, *map("\t".join, zip(*columns, strict=True))]), (), sheet)


def _place(label: str, sheet: Sheet, column: int, row: int) -> str:
    return f"{label}: {sheet.place(row + 1, column + 1)}"


def _open(data: bytes) -> Any:
    library("pyarrow", "reading Parquet", "data")
    import pyarrow.parquet

    return _read_or_refuse(lambda: pyarrow.parquet.ParquetFile(pyarrow.BufferReader(data)))


def _read_or_refuse(read: Callable[[], Any]) -> Any:
    """The result of a pyarrow call, or E101."""
    try:
        return read()
    except Exception as error:  # of many kinds, for files that are damaged
        why = str(error).partition("\n")[0][:200]
        help = "write the file again, or save the poses as CSV"
        raise InputError("E101", "this Parquet file cannot be read", why=why, help=help) from None


def holds_numbers(kind: Any) -> bool:
    """Whether a type of Arrow is one of numbers; null: a column that holds nothing at all."""
    from pyarrow import types

    tests = (types.is_floating, types.is_integer, types.is_decimal, types.is_null)
    return any(test(kind) for test in tests)


def _numbers(column: Any, blank: str) -> tuple[list[str], list[str]]:
    """A column as texts, and as the shortest texts of its numbers."""
    from pyarrow import types

    texts = [blank if value is None else _short(str(value)) for value in column.to_pylist()]
    if not types.is_floating(column.type) or types.is_float64(column.type):
        return texts, texts
    kind = np.float32 if types.is_float32(column.type) else np.float16  # 0.1 in 32 bits is 0.1
    return texts, [_short(str(kind(text))) for text in texts if text]


def _short(text: str) -> str:
    """A number without the noughts behind its point: those are not stored."""
    mantissa, e, exponent = text.lower().partition("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return mantissa + e + exponent


def _values(column: Any, where: Callable[[int], str]) -> list[Any]:
    """The values of a column; raises E101 for what Python cannot hold.

    Damaged text is a ValueError, a date beyond the year 9999 an OverflowError, and more kinds come
    from types that a later Arrow may add.
    """
    values = []
    for row, each in enumerate(column):
        try:
            values.append(each.as_py())
        except Exception as error:
            why = str(error).partition("\n")[0][:200]
            message = f"row {row + 1} has a value that cannot be read"
            help = "write the file again with another text there, or without this column"
            raise InputError("E101", message, where=where(row), why=why, help=help) from None
    return values


def _cell(text: str) -> str:
    """A text without tabs and line ends, in quotes where it might be taken for something else."""
    text = text.translate({ord(sign): " " for sign in "\t\n\r"})
    if '"' in text or text.lstrip().startswith("#") or text[:4].lower() == "sep=":
        return '"' + text.replace('"', '""') + '"'
    return text
