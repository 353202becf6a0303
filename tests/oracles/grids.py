"""One table as the bytes of every kind of grid."""

import io
import math

import pyarrow
import pyarrow.parquet

from tests.oracles.workbooks import number, text, workbook

KINDS = ("commas", "decimal commas", "blanks", "sheet", "Parquet")


def grid(kind: str, header: list[str], rows: list[list[float]]) -> bytes:
    """A table of numbers; a nan is a blank cell."""
    cells = [["" if math.isnan(value) else repr(value) for value in row] for row in rows]
    if kind == "sheet":
        made = [[number(cell) if cell else None for cell in row] for row in cells]
        return workbook([list(map(text, header)), *made])
    if kind == "Parquet":
        columns = [
            [None if math.isnan(v) else v for v in column] for column in zip(*rows, strict=True)
        ]
        sink = io.BytesIO()
        table = pyarrow.table(dict(zip(header, columns, strict=True)))
        pyarrow.parquet.write_table(table, sink)
        return sink.getvalue()
    separator = {"commas": ",", "decimal commas": ";", "blanks": " "}[kind]
    body = "\n".join(separator.join(row) for row in cells)
    body = body.replace(".", ",") if kind == "decimal commas" else body
    return f"{separator.join(header)}\n{body}\n".encode()
