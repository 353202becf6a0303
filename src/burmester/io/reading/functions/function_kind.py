"""Whether a file holds a function task: all of the reading of functions that other tasks need."""

from __future__ import annotations

import re
from pathlib import PurePath
from typing import Final

from burmester.errors import InputError
from burmester.io.reading.file_content import ARCHIVE, PARQUET
from burmester.io.reading.pose_table import SHEET_HEAD
from burmester.io.reading.tables.columns import has_pairs
from burmester.io.reading.tables.grid import ROW_LINE, values_of
from burmester.io.reading.tables.text_source import text_source


def _is_head(text: str) -> bool:
    """Whether the first line of a table that is no comment names columns of pairs."""
    line = ROW_LINE.search(text, len(SHEET_HEAD) if text.startswith(SHEET_HEAD) else 0)
    separator = next((s for s in ";\t|," if line and s in line[0]), ",")
    return line is not None and has_pairs(values_of(line[0], separator))


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
    return is_function_text(source.text, "" if source.sheet else path)


_NAMES: Final = re.compile(rb"(?i)output|Abtrieb|sortie|salida|uscita")


def is_function_text(text: str, path: str) -> bool:
    """The same of the text in a file."""
    suffix = PurePath(path).suffix.lower()
    if suffix == ".toml":
        return bool(re.search(r"(?m)^\s*\[\s*function\s*\]", text))
    if suffix == ".json" or text.lstrip().startswith(("{", "[")):
        return bool(re.match(r'\s*\{\s*"(schema"\s*:\s*"burmester\.function/|function"\s*:)', text))
    return _is_head(text)
