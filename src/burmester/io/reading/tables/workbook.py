"""A sheet of an .xlsx workbook as text with tabs between its cells, which is then read as CSV.

Numbers have all the digits that are stored, not those that are shown; formulas are read by the
values stored with them.  Only the parts of the file that hold cells are opened, after a look at
their size: XML with a document type is refused, so no entity is ever expanded.
"""

from __future__ import annotations

import datetime
import functools
import io
import re
import warnings
import zipfile
from collections.abc import Iterator
from typing import Any

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import (
    SHEET_HEAD,
    Sheet,
    Source,
    brief,
    cell_name,
    no_poses,
    shown,
)
from burmester.wording import listed, shortened

__all__ = ["may_hold", "read_sheet"]

MAX_TAGS = 1_500_000  # tags of XML; 100,000 poses have 900,000, and take 12 s and 250 MB
MAX_BYTES = 200_000_000  # bytes of XML, unpacked
MAX_CELLS = 20_000_000  # cells of the table, empty ones counted
MAX_MERGED = 100_000  # cells that are merged with others
MAX_NAMED = 6  # rows or sheets that a message names

_PARTS = re.compile(  # those that hold cells: no pictures, charts, links, queries and macros
    r"\[Content_Types\]\.xml|_rels/\.rels|xl/(workbook|styles|sharedStrings)\.xml"
    r"|xl/_rels/workbook\.xml\.rels|xl/worksheets/[^/]+\.xml",
    re.IGNORECASE,
)
_CSV = "save the sheet as CSV and read that"


def read_sheet(label: str, data: bytes, sheet: str | None) -> Source:
    """A sheet of a workbook: the one of a name or a number, or the first that is not hidden.

    Raises E101 for what is no workbook or too large, E102 for an empty sheet and E130 without
    openpyxl.
    """
    parts = _sheet_parts(data)
    values = _open(parts, values=True)
    formulas = None
    if any(b"<f" in text for name, text in parts.items() if "worksheets" in name.lower()):
        formulas = _open(parts, values=False)
    chosen, notes = _chosen(values, sheet)
    rows = list(_rows(chosen, formulas[chosen.title] if formulas else None))
    if not rows:
        others = [each.title for each in values.worksheets if each is not chosen]
        error = no_poses(f"the sheet {shown(chosen.title)} is empty")
        if others:
            error.help = f"read another sheet, such as --sheet {brief(_quoted(others[0]), '2')}"
        raise error
    width = max(len(cells) for _, cells in rows)
    if rows[-1][0] + len(rows) * width > MAX_CELLS:
        raise _too_large(f"{len(rows)} rows of {width} cells")
    lines = [""] * rows[-1][0]
    for number, cells in rows:
        lines[number - 1] = "\t".join(cells) + "\t" * (width - len(cells))
    merged = {
        (row, column): cell_name(area.min_row, area.min_col)
        for area in chosen.merged_cells.ranges
        for row, column in _covered(area)
    }
    hidden = _hidden(chosen, [number for number, _ in rows], width)
    return Source(
        label, SHEET_HEAD + "\n".join(lines), (*notes, *hidden), Sheet(chosen.title, merged)
    )


def may_hold(data: bytes, text: re.Pattern[bytes]) -> bool:
    """Whether a text that matches stands in a workbook; False where it cannot be read.

    It is looked for before the cells are read, which takes seconds of many.
    """
    try:
        return any(map(text.search, _sheet_parts(data).values()))
    except InputError:
        return False


def _sheet_parts(data: bytes) -> dict[str, bytes]:
    """The parts of the archive that hold cells, unpacked; raises E101."""
    parts: dict[str, bytes] = {}
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            wanted = [info for info in archive.infolist() if _PARTS.fullmatch(info.filename)]
            if not any(info.filename.lower() == "xl/workbook.xml" for info in wanted):
                raise _no_workbook("it has no xl/workbook.xml in it")
            if (size := sum(info.file_size for info in wanted)) > MAX_BYTES:
                raise _too_large(f"{size} bytes unpacked")
            for info in wanted:
                if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                    raise _no_workbook(f"{info.filename} is packed in an unusual way")
                with archive.open(info) as part:  # no more is unpacked than is asked for
                    parts[info.filename] = part.read(info.file_size)
    except InputError:
        raise
    except Exception as error:  # of many kinds, for archives that are damaged
        raise _no_workbook(str(error)) from None
    if (tags := sum(text.count(b"<") for text in parts.values())) > MAX_TAGS:
        raise _too_large(f"{tags} tags of XML")
    for name, text in parts.items():
        encoding = re.match(rb"(?:\xef\xbb\xbf)?\s*<\?xml[^>]*encoding\s*=\s*[\"']([^\"']*)", text)
        if b"\0" in text or (encoding and encoding[1].lower() not in (b"utf-8", b"us-ascii")):
            raise _no_workbook(f"{name} is not UTF-8")
        if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
            raise _no_workbook(f"{name} declares a document type")
        areas = re.findall(rb"mergeCell[^>]*ref\s*=\s*[\"']([A-Z]+)([0-9]+):([A-Z]+)([0-9]+)", text)
        if sum(map(_area, areas)) > MAX_MERGED:
            raise _too_large("more merged cells than a table of poses")
    return parts


def _area(corners: tuple[bytes, bytes, bytes, bytes]) -> int:
    """The number of cells between two corners, such as (b"A", b"1", b"C", b"2")."""
    left, top, right, bottom = (corner.decode() for corner in corners)
    columns = [
        functools.reduce(lambda n, c: 26 * n + ord(c) - 64, name, 0) for name in (left, right)
    ]
    return (abs(columns[1] - columns[0]) + 1) * (abs(int(bottom[:9]) - int(top[:9])) + 1)


def _open(parts: dict[str, bytes], *, values: bool) -> Any:
    """The workbook of these parts; with the values of formulas, or with their text."""
    try:
        import openpyxl
    except ImportError:
        raise InputError(
            "E130",
            "reading .xlsx needs openpyxl",
            why="it cannot be imported",
            help='pip install "burmester[data]"',
        ) from None
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, text in parts.items():
            archive.writestr(name, text)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles and validations, which do not matter
            return openpyxl.load_workbook(packed, data_only=values, keep_links=False)
    except Exception as error:  # of many kinds, for files that are damaged
        raise _no_workbook(str(error).partition("\n")[0][:200] or type(error).__name__) from None


def _chosen(workbook: Any, given: str | None) -> tuple[Any, tuple[Advice, ...]]:
    """The sheet to be read, and a note where there are others."""
    sheets = workbook.worksheets
    if not sheets:
        raise _no_workbook("it has no sheet with cells")
    if given is None:
        first = next((each for each in sheets if each.sheet_state == "visible"), sheets[0])
        if len(sheets) == 1:
            return first, ()
        others = [_quoted(each.title) for each in sheets if each is not first]
        are = "others are" if len(others) > 1 else "other is"
        note = Advice(
            "W213",
            f"the sheet {_quoted(first.title)} is read, one of {len(sheets)}",
            f"choose it with --sheet {brief(_quoted(first.title), str(sheets.index(first) + 1))}",
            f"the {are} {listed(shortened(others, MAX_NAMED))}",
        )
        return first, (note,)
    for alike in (str, str.casefold):
        for each in sheets:
            if alike(each.title) == alike(given.strip()):
                return each, ()
    if given.isascii() and given.isdigit() and 1 <= int(given[:9]) <= len(sheets):
        return sheets[int(given[:9]) - 1], ()
    names = [f"{k} {_quoted(each.title)}" for k, each in enumerate(sheets, 1)]
    raise InputError(
        "E101",
        f"there is no sheet {shown(given)}",
        why=f"the sheets are {listed(shortened(names, MAX_NAMED))}",
        help=f"give the name or the number of a sheet, such as --sheet 1 to {len(sheets)}"
        if len(sheets) > 1
        else "give --sheet 1",
    )


def _rows(sheet: Any, formulas: Any | None) -> Iterator[tuple[int, list[str]]]:
    """The rows with something in them: their numbers from 1, and the texts of their cells."""
    rows: dict[int, dict[int, str]] = {}
    # Only the cells in the file: iter_rows() would make all others up to the last one.
    for (row, column), cell in sheet._cells.items():
        formula = formulas._cells.get((row, column)) if formulas is not None else None
        if text := _text(cell, formula):
            rows.setdefault(row, {})[column] = text
    for row in sorted(rows):
        cells = rows[row]
        yield row, [cells.get(column, "") for column in range(1, max(cells) + 1)]


def _text(cell: Any, formula: Any | None) -> str:
    """A cell as text, as it would stand in a CSV file with tabs.

    formula: the same cell with its formula, if there are any.
    """
    value = cell.value
    if value is None:
        # A formula whose value is an empty text has the type of a text.
        if formula is not None and formula.data_type == "f" and cell.data_type == "n":
            text = getattr(formula.value, "text", formula.value)
            return _quoted_cell(f"={str(text).lstrip('=')}")
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, int | float):
        return repr(value).removesuffix(".0")
    if isinstance(value, datetime.timedelta):
        return f"a time of {value}"
    return _quoted_cell(str(value))


def _quoted_cell(text: str) -> str:
    """A text without tabs and line ends, in quotes where it might be taken for something else.

    A number that is stored as text has quotes: its decimal mark is one that somebody has written.
    """
    text = " ".join(text.split())
    if '"' in text or re.match(r"#|(?i:sep=)|[-+\u2212.,]*[0-9]", text):
        return '"' + text.replace('"', '""') + '"'
    return text


def _covered(area: Any) -> Iterator[tuple[int, int]]:
    """The cells of a merged area that show the first one's content."""
    for row in range(area.min_row, area.max_row + 1):
        for column in range(area.min_col, area.max_col + 1):
            if (row, column) != (area.min_row, area.min_col):
                yield row, column


def _hidden(sheet: Any, numbers: list[int], width: int) -> Iterator[Advice]:
    """W213, for rows and columns that are hidden, and read all the same."""
    rows = [f"{k}" for k in numbers if k in sheet.row_dimensions and sheet.row_dimensions[k].hidden]
    columns = [
        each.index
        for each in sheet.column_dimensions.values()
        if each.hidden and (each.min or 1) <= width
    ]
    for what, named in (("row", rows), ("column", columns)):
        if named:
            many = len(named) > 1
            yield Advice(
                "W213",
                f"{what}{'s' * many} {listed(shortened(named, MAX_NAMED))} of the sheet "
                f"{'are' if many else 'is'} hidden, and read like the others",
                "show what is hidden, or delete it",
            )


def _quoted(name: str) -> str:
    """A sheet's name as an option is written on a command line."""
    return name if re.fullmatch(r"[\w.-]+", name) else f'"{name}"'


def _no_workbook(why: str) -> InputError:
    from burmester.io.reading.file_content import ARCHIVE_HELP

    why = why[:200] or "the archive is damaged"
    return InputError(
        "E101", "this is no .xlsx workbook that can be read", why=why, help=ARCHIVE_HELP
    )


def _too_large(what: str) -> InputError:
    message = "the workbook is too large for a table of poses"
    return InputError("E101", message, why=f"it has {what}", help=_CSV)
