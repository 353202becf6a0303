"""Parquet as text with tabs between its cells, which is then read as CSV.

Every number is the one that is stored: integers, floats and decimals, and a column without any
value; text is for names and words alone.  A resolution is taken from the shortest decimals that a
number can be printed with.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

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
from burmester.io.reading.tables.pose_rows import WORD_ROLES

_NUMBERS = (*NUMERIC, *DIRECTION, *POINTS, "crank")
_COARSE = ("float", "halffloat")  # types of fewer digits than a double has
_WORDS = ("name", "number", "exact", *TOLERANCE_ROLES, *WORD_ROLES)


def read_parquet(label: str, data: bytes) -> Source:
    """The table in the bytes of a Parquet file; raises E101, E102, E104, and E130 without pyarrow.

    Columns that are passed over are blank, unless they hold numbers.
    """
    library("pyarrow", "reading Parquet", "data")
    import pyarrow.compute
    import pyarrow.parquet

    file = _read_or_refuse(lambda: pyarrow.parquet.ParquetFile(pyarrow.BufferReader(data)))
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
    columns: list[Any] = [pyarrow.array([""] * count)] * len(names)
    for i in read:
        column, role = stored.column(names[i]), roles[i]
        if holds_numbers(kinds[i]):
            may_be_blank = role not in _NUMBERS or role == "crank"
            may_be_blank |= tolerant and role in NUMERIC[:3]
            exact = column.cast("float64") if kinds[i] in _COARSE else column
            columns[i] = _numbers(exact).fill_null("" if may_be_blank else "nan")
        else:
            place = functools.partial(_place, label, sheet, i)
            texts = ["" if value is None else str(value) for value in _values(column, place)]
            columns[i] = pyarrow.array(map(_cell, texts), pyarrow.string())
    if any(kinds[i] in _COARSE for i in read):
        printed = {i: _decimals(stored.column(names[i])) for i in read if holds_numbers(kinds[i])}
        sheet = sheet._replace(printed=printed)
    rows = pyarrow.compute.binary_join_element_wise(*columns, "\t").to_pylist()
    return Source(label, "\n".join([head, *rows]), (), sheet)


def _place(label: str, sheet: Sheet, column: int, row: int) -> str:
    return f"{label}: {sheet.place(row + 1, column + 1)}"


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


def _numbers(column: Any) -> Any:
    """A column as texts, without the noughts behind a point: those are not stored."""
    import pyarrow.compute

    texts = column.cast("string")
    return pyarrow.compute.replace_substring_regex(texts, r"(\.\d*[1-9])0+$|\.0+$", r"\1")


def _decimals(column: Any) -> float:
    """The most decimals of the shortest texts of its numbers: 0.1 in 32 bits is 0.1."""
    import pyarrow

    shortest = pyarrow.array(map(str, column.drop_null().to_numpy()), "string")
    return max(map(decimals, _numbers(shortest).to_pylist()), default=0.0)


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
