"""Whether a file holds a function task: all of the reading of functions that other tasks need."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import PurePath
from typing import Final, NamedTuple

from burmester.errors import InputError
from burmester.io.reading.file_content import decode_text, is_archive, is_parquet
from burmester.io.reading.pose_table import SHEET_HEAD, Source
from burmester.io.reading.tables.columns import has_poses

ANGLE_COLUMNS: Final = re.compile(r"(input|output)_(deg|rad)")


class Header(NamedTuple):
    """The line with the names of columns: its place from 0, its cells, and the separator."""

    line: int
    names: list[str]
    separator: str


def header_of(text: str) -> Header:
    """The first line of a table that is no comment."""
    for number, line in enumerate(text.split("\n")):
        if line.strip() and not line.lstrip().startswith("#") and number_of_head(text) <= number:
            separator = next((s for s in ";\t|," if s in line), ",")
            return Header(number, [_word(cell) for cell in line.split(separator)], separator)
    return Header(0, [], ",")


def number_of_head(text: str) -> int:
    """How many lines stand before those of a table."""
    return int(text.startswith(SHEET_HEAD))


def has_pairs(names: Sequence[str]) -> bool:
    """Whether columns of these names are a function's, whatever is wrong with them."""
    return any(map(ANGLE_COLUMNS.fullmatch, names)) and not has_poses(names)


def _word(cell: str) -> str:
    return cell.strip().strip('"').lower()


def is_pair_parquet(data: bytes) -> bool:
    """Whether Parquet has the columns of pairs; False, too, where it cannot be read."""
    try:
        import pyarrow
        import pyarrow.parquet

        names = pyarrow.parquet.ParquetFile(pyarrow.BufferReader(data)).schema_arrow.names
    except Exception:  # of many kinds; it is read as poses then, and refused there
        return False
    return has_pairs([str(name).strip().lower() for name in names])


def is_function(data: bytes, path: str, sheet: str | None = None) -> bool:
    """Whether the bytes of a file are a function task, whatever is wrong with it."""
    if is_parquet(data):
        return is_pair_parquet(data)
    if is_archive(data):
        from burmester.io.reading.tables.workbook import may_hold

        if not may_hold(data, _IN_A_WORKBOOK):
            return False
    try:
        source = source_of(data, path, sheet)
    except InputError:
        return False
    if source.sheet is not None:
        return has_pairs(header_of(source.text).names)
    return is_function_text(source.text, path)


_IN_A_WORKBOOK: Final = re.compile(rb"(?i)(input|output)_(deg|rad)")


def source_of(data: bytes, path: str, sheet: str | None) -> Source:
    """The text in a file, or in a sheet of a workbook."""
    label = "<stdin>" if path == "-" else os.fspath(path)
    if is_archive(data):
        from burmester.io.reading.tables.workbook import read_sheet

        return read_sheet(label, data, sheet)
    if sheet is not None:
        message = "--sheet is for .xlsx workbooks; this file has one table"
        raise InputError("E108", message, where=label, help="leave --sheet out")
    text, notes = decode_text(data)
    return Source(label, text, notes)


def is_function_text(text: str, path: str) -> bool:
    """The same of the text in a file."""
    suffix = PurePath(path).suffix.lower()
    if suffix == ".toml":
        return bool(re.search(r"(?m)^\s*\[\s*function\s*\]", text))
    if suffix == ".json" or text.lstrip().startswith(("{", "[")):
        return bool(re.match(r'\s*\{\s*"(schema"\s*:\s*"burmester\.function/|function"\s*:)', text))
    return has_pairs(header_of(text).names)
