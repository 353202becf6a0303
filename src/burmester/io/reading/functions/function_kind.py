"""Whether a file holds a function task: all of the reading of functions that other tasks need."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import PurePath
from typing import Final

from burmester.errors import InputError
from burmester.io.reading.file_content import ARCHIVE, PARQUET
from burmester.io.reading.pose_table import SHEET_HEAD
from burmester.io.reading.tables.columns import has_poses
from burmester.io.reading.tables.grid import ROW_LINE, values_of
from burmester.io.reading.tables.text_source import text_source

ANGLE_COLUMNS: Final = re.compile(r"(input|output)_(deg|rad)")


def head_of(text: str) -> tuple[list[str], str]:
    """The names in the first line of a table that is no comment, and their separator."""
    line = ROW_LINE.search(text, len(SHEET_HEAD) if text.startswith(SHEET_HEAD) else 0)
    separator = next((s for s in ";\t|," if line and s in line[0]), ",")
    return [name.lower() for name in values_of(line[0], separator)] if line else [], separator


def has_pairs(names: Sequence[str]) -> bool:
    """Whether columns of these names are a function's, whatever is wrong with them."""
    return any(map(ANGLE_COLUMNS.fullmatch, names)) and not has_poses(names)


def is_function(data: bytes, path: str, sheet: str | None = None) -> bool:
    """Whether the bytes of a file are a function task, whatever is wrong with it."""
    if data.startswith(ARCHIVE):
        from burmester.io.reading.tables.workbook import may_hold

        if not may_hold(data, _NAMES):
            return False
    elif data.startswith(PARQUET) and not _NAMES.search(data):
        return False
    try:
        source = text_source(data, path, sheet)
    except InputError:
        return False
    if source.sheet is not None:
        return has_pairs(head_of(source.text)[0])
    return is_function_text(source.text, path)


_NAMES: Final = re.compile(rb"(?i)(input|output)_(deg|rad)")


def is_function_text(text: str, path: str) -> bool:
    """The same of the text in a file."""
    suffix = PurePath(path).suffix.lower()
    if suffix == ".toml":
        return bool(re.search(r"(?m)^\s*\[\s*function\s*\]", text))
    if suffix == ".json" or text.lstrip().startswith(("{", "[")):
        return bool(re.match(r'\s*\{\s*"(schema"\s*:\s*"burmester\.function/|function"\s*:)', text))
    return has_pairs(head_of(text)[0])
