"""The text with a separator between its cells that a file holds, whatever its bytes are."""

from __future__ import annotations

from pathlib import PurePath

from burmester.errors import InputError
from burmester.io.reading.file_content import ARCHIVE, PARQUET, decode_text
from burmester.io.reading.link import LABEL, is_link
from burmester.io.reading.pose_table import Source
from burmester.printable import printable


def label_of(path: str) -> str:
    """What errors call a file."""
    return "<stdin>" if path == "-" else LABEL if is_link(path) else printable(path)


def text_source(data: bytes, path: str, sheet: str | None = None) -> Source:
    """The text of a file, of a sheet of a workbook or of Parquet; raises E101, E102 and E108.

    sheet: by its name or its number; only a workbook has one.
    """
    label = label_of(path)
    if data.startswith(ARCHIVE):
        from burmester.io.reading.tables.workbook import read_sheet

        return read_sheet(label, data, sheet)
    if sheet is not None:
        message = "--sheet is for .xlsx workbooks; this file has one table"
        raise InputError("E108", message, where=label, help="leave --sheet out")
    if data.startswith(PARQUET) or (PurePath(path).suffix.lower() == ".parquet" and data):
        from burmester.io.reading.tables.parquet import read_parquet

        return read_parquet(label, data)
    return Source(label, *decode_text(data, label))
