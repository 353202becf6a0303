"""A sheet of an .xlsx workbook as text with tabs between its cells, which is then read as CSV.

Numbers have all the digits that are stored, not those that are shown; formulas are read by the
values stored with them.  Only the parts of the file that hold cells are opened, after a look at
their size; XML with a document type is refused before it is parsed, so no entity is expanded.
openpyxl reads which sheets and styles there are.  Cells are read here, one after the other:
openpyxl would make an object of every cell in a range that is merged or linked.
"""

from __future__ import annotations

import datetime
import functools
import io
import re
import warnings
import zipfile
from collections.abc import Iterator
from typing import Any, Final
from xml.etree import ElementTree

from burmester.errors import Advice, InputError, library
from burmester.io.reading.pose_table import (
    NUMBER,
    SHEET_HEAD,
    Sheet,
    Source,
    brief,
    cell_name,
    is_held,
    no_poses,
    shown,
)
from burmester.wording import listed, shortened

MAX_BYTES: Final = 60_000_000  # of XML, unpacked
MAX_TAGS: Final = 2_200_000  # of XML; 100,000 poses with names have 2,000,000
MAX_OUTLINE: Final = (5_000_000, 50_000)  # bytes and tags of what is neither cells nor texts
MAX_ATTRIBUTE: Final = 1000  # characters of an attribute there
MAX_CELLS: Final = 20_000_000  # cells of the table, empty ones counted
MAX_TEXT: Final = 30_000_000  # characters of all cells, and of texts that cells share
MAX_CELL: Final = 100_000  # characters of a cell; programs allow 32,767
MAX_MERGED: Final = 100_000  # cells that are merged with others
LAST: Final = (1_048_576, 16_384)  # row and column of a sheet
MAX_NAMED: Final = 6  # rows or sheets that a message names

_PARTS = re.compile(  # those that hold cells: no pictures, charts, links, queries and macros
    r"\[Content_Types\]\.xml|_rels/\.rels|xl/(workbook|styles|sharedStrings)\.xml"
    r"|xl/_rels/workbook\.xml\.rels|xl/worksheets/[^/]+\.xml",
    re.IGNORECASE,
)
_CELLS = re.compile(r"xl/(sharedStrings|worksheets/[^/]+)\.xml", re.IGNORECASE)
_LONG_ATTRIBUTE = re.compile(rb"=\s*(?:\"[^\"]{%d}|'[^']{%d})" % ((MAX_ATTRIBUTE + 1,) * 2))
_CORNER = re.compile(r"\$?([A-Za-z]{1,3})\$?([0-9]{1,7})")
_CSV: Final = "save the sheet as CSV and read that"


def read_sheet(label: str, data: bytes, sheet: str | None) -> Source:
    """A sheet of a workbook: the one of a name or a number, or the first that is not hidden.

    Raises E101 for what is no workbook or too large, E102 for an empty sheet and E130 without
    openpyxl.
    """
    parts = _sheet_parts(data)
    workbook = _outline(parts)
    chosen, notes = _chosen(workbook, sheet)
    cells = _Cells(workbook)
    for name, text in parts.items():
        if name.lower() == "xl/sharedstrings.xml":
            cells.read(name, text)
    cells.read(chosen._worksheet_path, parts[chosen._worksheet_path])
    rows = {row: texts for row, texts in cells.rows.items() if texts}
    if not rows:
        others = [each.title for each in workbook.worksheets if each is not chosen]
        error = no_poses(f"the sheet {shown(chosen.title)} is empty")
        if others:
            error.help = f"read another sheet, such as --sheet {brief(_quoted(others[0]), '2')}"
        raise error
    width, last = max(map(max, rows.values())), max(rows)
    if last + len(rows) * width > MAX_CELLS:
        raise _too_large(f"{len(rows)} rows of {width} cells")
    lines = [""] * last
    for row, texts in rows.items():
        lines[row - 1] = "\t".join(texts.get(column, "") for column in range(1, width + 1))
    hidden = cells.hidden(sorted(rows), width)
    return Source(
        label, SHEET_HEAD + "\n".join(lines), (*notes, *hidden), Sheet(chosen.title, cells.merged)
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
                raise _other_archive(archive.namelist())
            if (size := sum(info.file_size for info in wanted)) > MAX_BYTES:
                raise _too_large(f"{size} bytes unpacked")
            outline = (info.file_size for info in wanted if not _CELLS.fullmatch(info.filename))
            if (size := sum(outline)) > MAX_OUTLINE[0]:
                raise _too_large(f"{size} bytes of names and styles")
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
        if b"<!DOCTYPE" in text:
            raise _no_workbook(f"{name} declares a document type")
        encoding = re.match(rb"(?:\xef\xbb\xbf)?\s*<\?xml[^>]*encoding\s*=\s*[\"']([^\"']*)", text)
        if b"\0" in text or (encoding and encoding[1].lower() not in (b"utf-8", b"us-ascii")):
            raise _no_workbook(f"{name} is not UTF-8")
    return parts


def _outline(parts: dict[str, bytes]) -> Any:
    """The workbook of these parts without its cells: which sheets and styles there are."""
    openpyxl = library("openpyxl", "reading .xlsx", "data")
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, text in parts.items():
            if _CELLS.fullmatch(name):
                archive.writestr(name, "<worksheet/>")
                continue
            if len(re.findall(rb"<[^/?!]", text)) > MAX_OUTLINE[1]:
                raise _too_large(f"more than {MAX_OUTLINE[1]} names and styles")
            if _LONG_ATTRIBUTE.search(text):
                raise _too_large(f"a name or a style of more than {MAX_ATTRIBUTE} characters")
            archive.writestr(name, text)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles, which do not matter
            return openpyxl.load_workbook(packed, read_only=True, keep_links=False)
    except Exception as error:  # of many kinds, for files that are damaged
        raise _no_workbook(str(error).partition("\n")[0][:200] or type(error).__name__) from None


def _written(element: ElementTree.Element) -> str:
    """The text in an element with runs; how it is read aloud is no part of it."""
    runs = [part for each in element if each.tag.endswith("}r") for part in each]
    pieces = [each.text or "" for each in (*element, *runs) if each.tag.endswith("}t")]
    return "".join(pieces)


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


class _Cells:
    """The cells of a sheet as texts, as they would stand in a CSV file with tabs.

    rows: the texts that are not blank, by row and column from 1; merged: as in `Sheet`.
    """

    def __init__(self, workbook: Any) -> None:
        self.rows: dict[int, dict[int, str]] = {}
        self.merged: dict[tuple[int, int], str] = {}
        self._workbook = workbook
        self._shared: list[str] = []  # texts that cells name by their number
        self._row = self._column = 0
        self._size = 0  # characters of all cells
        self._hidden_rows: set[int] = set()
        self._hidden_columns: list[int] = []

    def read(self, name: str, text: bytes) -> None:
        """Go through a sheet, or through the shared texts, which come first; raises E101."""
        try:
            for _, element in ElementTree.iterparse(io.BytesIO(text)):
                match element.tag.rpartition("}")[2]:
                    case "row":
                        self._read_row(element)
                    case "si":
                        shared = _written(element).replace("x005F_", "")
                        self._shared.append(self._counted(shared))
                    case "col" if element.get("hidden") in ("1", "true"):
                        self._hidden_columns.append(int(element.attrib["min"]))
                    case "mergeCell":
                        self._merge(element.attrib["ref"])
                    case _:
                        continue
                element.clear()
        except (ElementTree.ParseError, LookupError, ValueError, OverflowError) as error:
            raise _no_workbook(f"{name} is damaged: {error}") from None
        for row, column in self.merged:  # no program shows what is below the first of them
            self.rows.get(row, {}).pop(column, None)

    def _read_row(self, row: ElementTree.Element) -> None:
        self._row, self._column = int(float(row.get("r", self._row + 1))), 0
        if row.get("hidden") in ("1", "true"):
            self._hidden_rows.add(self._row)
        for cell in row:
            self._place(cell.get("r"))
            if text := self._text(cell):
                self.rows.setdefault(self._row, {})[self._column] = self._counted(text)

    def _counted(self, text: str) -> str:
        if len(text) > MAX_CELL:
            raise _too_large(f"a cell of more than {MAX_CELL} characters")
        self._size += len(text) + 1
        if self._size > MAX_TEXT:
            raise _too_large(f"more than {MAX_TEXT / 1e6:.0f} million characters")
        return text

    def _place(self, name: str | None) -> None:
        """Go on to the cell of a name, or to the next one."""
        if name is None:
            self._column += 1
        else:
            self._row, self._column = _corner(name)
        if not (0 < self._row <= LAST[0] and self._column <= LAST[1]):
            where = f"row {self._row:g} and column {self._column}"
            raise ValueError(f"a sheet has no cell in {where}")

    def _merge(self, area: str) -> None:
        first, _, last = area.partition(":")
        (top, left), (bottom, right) = _corner(first), _corner(last or first)
        rows, columns = range(top, bottom + 1), range(left, right + 1)
        if len(self.merged) + len(rows) * len(columns) > MAX_MERGED:
            raise _too_large("more merged cells than a table of poses")
        named = cell_name(top, left)
        self.merged |= {(row, column): named for row in rows for column in columns}
        self.merged.pop((top, left), None)

    def _text(self, cell: ElementTree.Element) -> str:
        """A cell as text."""
        parts = {part.tag[part.tag.find("}") + 1 :]: part for part in cell}
        stored = (parts["v"].text or "") if "v" in parts else ""
        match cell.get("t", "n"):
            case "inlineStr" if "is" in parts:
                return _quoted_cell(_written(parts["is"]))
            case "n" if not stored and "f" in parts:  # one that is an empty text is of type str
                return _quoted_cell(f"={(parts['f'].text or '').lstrip('=')}")
            case "n" if stored:
                return self._number(stored.strip(), int(cell.get("s", 0)))
            case "s" if stored:
                if not 0 <= int(stored) < len(self._shared):
                    raise ValueError(f"there is no text {shown(stored)}")
                return _quoted_cell(self._shared[int(stored)])
            case "b" if stored:
                return str(bool(int(stored))).upper()
        return _quoted_cell(stored)

    def _number(self, text: str, style: int) -> str:
        if not NUMBER.fullmatch(text):
            return _quoted_cell(text)
        value = float(text)
        if style in self._workbook._date_formats:
            from openpyxl.utils.datetime import from_excel

            length = style in self._workbook._timedelta_formats
            try:
                when = from_excel(value, self._workbook.epoch, timedelta=length)
            except (OverflowError, ValueError):
                return "#VALUE!"
            is_time = isinstance(when, datetime.timedelta)
            return f"a time of {when}" if is_time else _quoted_cell(str(when))
        if "." not in text and "e" not in text.lower():
            return text
        # What a double cannot hold stays as it is written, to be refused.
        return repr(value).removesuffix(".0") if is_held(text) else text

    def hidden(self, rows: list[int], width: int) -> Iterator[Advice]:
        """W213, for rows and columns that are hidden, and read all the same."""
        lines = [f"{row}" for row in rows if row in self._hidden_rows]
        columns = [cell_name(1, k)[:-1] for k in self._hidden_columns if k <= width]
        for what, named in (("row", lines), ("column", columns)):
            if named:
                many = len(named) > 1
                yield Advice(
                    "W213",
                    f"{what}{'s' * many} {listed(shortened(named, MAX_NAMED))} of the sheet "
                    f"{'are' if many else 'is'} hidden, and read like the others",
                    "show what is hidden, or delete it",
                )


def _corner(name: str) -> tuple[int, int]:
    """Row and column of a cell by its name, as $B$7 too."""
    if not (found := _CORNER.fullmatch(name)):
        raise ValueError(f"{shown(name)} is no name of a cell")
    return int(found[2]), _column(found[1].upper())


@functools.cache
def _column(letters: str) -> int:
    return functools.reduce(lambda number, letter: 26 * number + ord(letter) - 64, letters, 0)


def _quoted_cell(text: str) -> str:
    """A text without tabs and line ends, in quotes where it might be taken for something else."""
    text = " ".join(text.split())
    if '"' in text or re.match(r"#|(?i:sep=)|[-+\u2212.,]*[0-9]", text):
        return '"' + text.replace('"', '""') + '"'
    return text


def _quoted(name: str) -> str:
    """A sheet's name as an option is written on a command line."""
    return name if re.fullmatch(r"[\w.-]+", name) else f'"{name}"'


def _other_archive(names: list[str]) -> InputError:
    """The error for an archive without a workbook: what it is, if it is one that people have."""
    kinds = {
        "word/": "it is a Word document (.docx)",
        "ppt/": "it is a presentation (.pptx)",
        "content.xml": "it is an OpenDocument file, such as .ods or .odt",
    }
    found = (kind for start, kind in kinds.items() if any(n.startswith(start) for n in names))
    return _no_workbook(next(found, "it has no xl/workbook.xml in it"))


def _no_workbook(why: str) -> InputError:
    from burmester.io.reading.file_content import ARCHIVE_HELP

    why = why[:200] or "the archive is damaged"
    return InputError(
        "E101", "this is no .xlsx workbook that can be read", why=why, help=ARCHIVE_HELP
    )


def _too_large(what: str) -> InputError:
    message = "the workbook is too large for a table of poses"
    return InputError("E101", message, why=f"it has {what}", help=_CSV)
