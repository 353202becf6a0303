"""Whether a file holds a function task: all of the reading of functions that other tasks need."""

from __future__ import annotations

import re
from pathlib import PurePath
from typing import Final

from burmester.errors import InputError
from burmester.io.reading.file_content import decode_text, is_archive, is_parquet
from burmester.io.reading.tables.columns import has_poses

__all__ = ["ANGLE_COLUMNS", "header", "is_function", "is_function_text"]

ANGLE_COLUMNS: Final = re.compile(r"(input|output)_(deg|rad)")


def is_function(data: bytes, path: str) -> bool:
    """Whether the bytes of a file are a function task, whatever is wrong with it."""
    if is_parquet(data) or is_archive(data):
        return False
    try:
        text, _ = decode_text(data)
    except InputError:
        return False
    return is_function_text(text, path)


def is_function_text(text: str, path: str) -> bool:
    """The same of the text in a file."""
    suffix = PurePath(path).suffix.lower()
    if suffix == ".toml":
        return bool(re.search(r"(?m)^\s*\[\s*function\s*\]", text))
    if suffix == ".json" or text.lstrip().startswith(("{", "[")):
        return bool(re.match(r'\s*\{\s*"(schema"\s*:\s*"burmester\.function/|function"\s*:)', text))
    names = header(text)[1]
    return any(map(ANGLE_COLUMNS.fullmatch, names)) and not has_poses(names)


def header(text: str) -> tuple[int, list[str], str]:
    """The first line that is no comment: its number from 0, its cells, and the separator."""
    for number, line in enumerate(text.split("\n")):
        if line.strip() and not line.lstrip().startswith("#"):
            separator = next((s for s in ";\t|," if s in line), ",")
            return number, [c.strip().strip('"').lower() for c in line.split(separator)], separator
    return 0, [], ","
