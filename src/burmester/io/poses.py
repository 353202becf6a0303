"""Poses from a file: CSV, JSON and TOML into a `Task`.

A number is taken as the nearest double or refused, never changed: no thousands separators,
no underscores, no guessed units, no guessed decimal marks.  An error's `where` holds
`file:line:column`, then the line with a caret below; the column is that of the first
character at fault, counted from 1.  Numbers in JSON and TOML are pointed at by their path,
`poses[3].x`, counted from 0 as in the file.

E101 not readable, or not text      E106 a row or pose of the wrong length
E102 no poses in it                 E107 a column or key that is not known
E103 a number that is not finite    E108 said twice, or in two ways that contradict
E104 not a number, or ambiguous     E109 not JSON or TOML at all
E105 header, column or key missing  E110 angle unit missing or contradicted
"""

from __future__ import annotations

import decimal
import functools
import json
import math
import os
import re
import sys
import tomllib
from collections.abc import Callable, Iterator
from decimal import Decimal
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from burmester.displacement import Displacement, FloatArray
from burmester.errors import InputError
from burmester.io import cases
from burmester.task import Task

if TYPE_CHECKING:
    from pydantic import BaseModel

__all__ = ["read_task"]

UNITS = {"deg": "degrees", "rad": "radians"}
NUMERIC = ("x", "y", "angle", "weight")


class _Line(NamedTuple):
    """A line and where it stands."""

    label: str  # of the file
    number: int
    text: str

    def where(self, start: int, width: int, note: str = "") -> str:
        """`file:line:column`, the line and a caret below; `start` counts from 0."""
        left = max(0, start - 60)  # a whole JSON file may be one line
        shown = "".join(c if c.isprintable() else " " for c in self.text[left : left + 100])
        carets = "^" * max(1, min(width, len(shown) - (start - left)))
        gutter = max(4, len(str(self.number)))
        return (
            f"{self.label}:{self.number}:{start + 1}\n{self.number:>{gutter}} | {shown}\n"
            f"{'':>{gutter}} | {'':>{start - left}}{carets} {note}"
        ).rstrip()

    def where_cell(self, cells: list[str], i: int, note: str = "") -> str:
        """The same for one of the cells that `_split` made of the line."""
        start = sum(len(cell) + 1 for cell in cells[:i])
        blanks = len(cells[i]) - len(cells[i].lstrip())
        return self.where(start + blanks, len(cells[i].strip()), note)

    def where_all(self) -> str:
        return self.where(0, len(self.text))


class _Table(NamedTuple):
    """What every format boils down to."""

    values: FloatArray  # (N, 3) or (N, 4): x, y, angle in its own unit, and weight if given
    decimals: tuple[float, float]  # the most that a length and an angle are printed with
    names: tuple[str, ...] | None
    length_unit: str | None
    angle_unit: str | None
    where: str  # the place where the angle unit is stated, or should be
    say_unit: str  # how to state it there


def read_task(
    source: str | os.PathLike[str], *, angle_unit: Literal["deg", "rad"] | None = None
) -> Task:
    """Read the task in a file, on standard input ("-") or in a carried case ("case:NAME").

    .csv, .tsv and .txt are CSV; .json and .toml are what they say; anything else is JSON if
    it begins with a bracket, and CSV if not.  `angle_unit` (--angle-unit) states the unit
    where the file does not.  The task's resolution is half of the last digit printed.
    Raises InputError E101 to E110 as listed above, and what `Task` raises.
    """
    if angle_unit not in (None, *UNITS):
        raise InputError("E110", f"there is no angle unit {angle_unit!r}", help="say deg or rad")
    path = os.fspath(source)
    label = "<stdin>" if path == "-" else path
    try:
        text = _decode(_fetch(path))
        return _task(_reader(label, text)(label, text), angle_unit)
    except InputError as error:
        error.where = error.where or label
        raise


def _fetch(source: str) -> bytes:
    if source == "-":
        return sys.stdin.buffer.read()
    if source.startswith("case:"):
        return cases.read_bytes(source.removeprefix("case:"))
    try:
        with open(source, "rb") as file:
            return file.read()
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        raise InputError(
            "E101",
            "the poses cannot be read",
            why=getattr(error, "strerror", None) or str(error),
            help=f"write case:{source}" if source in cases.names() else "check the path",
        ) from None


def _decode(data: bytes) -> str:
    """Text with one line feed between its lines, from UTF-8 or from UTF-16 that says so."""
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        text, why = data.decode(encoding), ""
    except UnicodeDecodeError as error:
        text = ""
        line = data.count(b"\n", 0, error.start) + 1
        why = f"byte {error.start + 1}, in line {line}, is not {encoding[:6].rstrip('-').upper()}"
    if "\0" in text:
        why = "there are null characters in it"
    if why:
        raise InputError("E101", "the poses are not text", why=why, help="save the file as UTF-8")
    if not text.strip():
        raise _empty("there is nothing in it")
    # splitlines() would also break a name at U+2028 and shift the line numbers
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\n")


def _reader(label: str, text: str) -> Callable[[str, str], _Table]:
    """The reader for a file: by its suffix, else by its first character."""
    by_suffix = {".csv": _read_csv, ".tsv": _read_csv, ".txt": _read_csv}
    by_suffix |= {".json": _read_json, ".toml": _read_toml}
    by_content = _read_json if text.lstrip().startswith(("{", "[")) else _read_csv
    return by_suffix.get(PurePath(label).suffix.lower(), by_content)


def _task(table: _Table, angle_unit: str | None) -> Task:
    """The task in a table, once its angle unit is beyond doubt."""
    stated, angles = table.angle_unit, table.values[:, 2]
    if stated and angle_unit and stated != angle_unit:
        raise InputError(
            "E110",
            f"the angles are stated in {UNITS[stated]}, --angle-unit says {UNITS[angle_unit]}",
            where=table.where,
            help="leave --angle-unit out, or correct the unit in the file",
        )
    unit = stated or angle_unit
    if not unit and len(angles):
        raise InputError(
            "E110",
            "the angle unit is not stated and both readings are possible",
            where=table.where,
            why=_both_readings(float(angles.min()), float(angles.max()), len(angles)),
            help=f"{table.say_unit}, or pass --angle-unit deg or --angle-unit rad",
        )
    length, angle = (0.5 * 10.0**-decimals for decimals in table.decimals)
    degrees = unit == "deg"
    return Task(
        Displacement(table.values[:, :2], np.radians(angles) if degrees else angles),
        weights=table.values[:, 3] if table.values.shape[1] > 3 else None,
        names=table.names,
        length_unit=table.length_unit,
        resolution=(length, math.radians(angle) if degrees else angle),
    )


def _both_readings(least: float, most: float, count: int) -> str:
    """How far the body turns if the angles are degrees, and if they are radians."""
    small = max(-least, most) <= 2 * math.pi
    lie = "within +-6.28" if small else f"between {least:g} and {most:g}"
    turns = (most - least, math.degrees(most - least))
    as_deg, as_rad = (f"{turn:.1f}" if 0.1 <= turn < 1e5 else f"{turn:.3g}" for turn in turns)
    return (
        f"all {count} angles lie {lie}. "
        f"As degrees the body turns {as_deg} deg in total, as radians {as_rad} deg"
    )


def _decimals(number: str) -> float:
    """The decimals a number is printed with, its exponent counted: 4 for "1.5e-3"."""
    mantissa, _, exponent = number.lower().partition("e")
    printed = len(mantissa.partition(".")[2])
    return max(0.0, printed - float(exponent)) if exponent else printed


def _empty(message: str) -> InputError:
    return InputError(
        "E102",
        f"no poses: {message}",
        help="write a CSV file: `x,y,angle_deg` on line 1, and a pose on each line below",
    )


def _shown(value: object) -> str:
    try:
        text = str(value) if isinstance(value, Decimal) else repr(value)
    except (ValueError, RecursionError):  # an integer of 5,000 digits, a thousand brackets
        text = f"a long {type(value).__name__}"
    return text if len(text) <= 40 else f"{text[:37]}..."


def _where_at(label: str, text: str, position: int, width: int = 1) -> str:
    """`file:line:column` and the line for a position in the whole text."""
    start = text.rfind("\n", 0, position) + 1
    line = _Line(label, text.count("\n", 0, position) + 1, text[start:].partition("\n")[0])
    return line.where(position - start, width)


# CSV ----------------------------------------------------------------------------------------

_COLUMN = re.compile(
    r"(?P<place>[xy])(_(?P<length>um|mm|cm|m|in|ft))?|weight|name"
    r"|(?P<angle>angle(_(?P<unit>deg|rad))?|theta|phi|rotation)"
)
_NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE)
_NUMBER_LIKE = re.compile(rf"[-+.,]*[0-9][-+.,0-9eE]*|{_NOT_FINITE.pattern}", re.IGNORECASE)
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2},[0-9]{3}")
_BLOCK = 1 << 20  # characters parsed at a time, so that a million rows need little memory


class _Header(NamedTuple):
    """What the header line says."""

    line: _Line
    end: int  # where the rows begin in the text
    separator: str
    names: list[str]
    columns: dict[str, int]  # role -> place in a row
    length_unit: str | None
    angle_unit: str | None
    where: str  # the angle column


class _Rows(NamedTuple):
    """Some rows: their numbers, the most decimals in each column, their names."""

    values: FloatArray
    decimals: list[float]
    names: list[str]


def _read_csv(label: str, text: str) -> _Table:
    """CSV with a header; its separator and its decimal mark must show, or it is refused."""
    header = _header(label, text)
    marks: dict[str, str] = {}  # "." "," or "?" (a comma that may part thousands) -> first seen
    blocks: list[_Rows] = []
    number, row = header.line.number + 1, 1
    for block in _blocks(text, header.end):
        rows = _plain_rows(block, header, marks)
        if rows is None:  # slower, and says what is wrong
            rows = _checked_rows(block, header, marks, number=number, row=row)
        blocks.append(rows)
        number, row = number + block.count("\n") + 1, row + len(rows.values)
    if row == 1:
        raise _empty("there is only a header")
    _require_one_mark(marks)
    x, y, angle = (max(rows.decimals[i] for rows in blocks) for i in range(3))
    return _Table(
        values=np.concatenate([rows.values for rows in blocks]),
        decimals=(max(x, y), angle),
        names=tuple(n for rows in blocks for n in rows.names) if "name" in header.columns else None,
        length_unit=header.length_unit,
        angle_unit=header.angle_unit,
        where=header.where,
        say_unit="name the column `angle_deg` or `angle_rad` in the header",
    )


def _header(label: str, text: str) -> _Header:
    """The first line that is neither blank nor a comment, understood."""
    found = re.search(r"(?m)^[^\S\n]*[^\s#].*$", text)
    if not found:
        raise _empty("there are only comments")
    line = _Line(label, text.count("\n", 0, found.start()) + 1, found[0])
    _require_header(line)
    separator = next((s for s in ",\t;" if s in line.text), ",")
    cells = _split(line.text, separator)
    names = [_unquoted(cell).lower() for cell in cells]
    columns: dict[str, int] = {}
    units: dict[str, str | None] = {}
    unknown: list[int] = []
    for i, name in enumerate(names):
        match = _COLUMN.fullmatch(name)
        if match is None:
            unknown += [] if name.startswith("#") else [i]
            continue
        role = match["place"] or ("angle" if match["angle"] else name)
        if role in columns:
            raise InputError(
                "E108",
                f"two columns for {role}: {names[columns[role]]} and {name}",
                where=line.where_cell(cells, i),
                help="delete one of the two columns",
            )
        columns[role], units[role] = i, match["length"] or match["unit"]
    if missing := [role for role in NUMERIC[:3] if role not in columns]:
        raise InputError(
            "E105",
            f"the header has no column for {' and '.join(missing)}",
            where=line.where_all(),
            why=f"it has: {', '.join(map(_shown, names))}",
            help="name the columns x, y and angle_deg (or angle_rad), with commas, semicolons or "
            "tabs between them; x_mm and y_mm (um, mm, cm, m, in, ft) state the length unit",
        )
    if unknown:
        name = names[unknown[0]].replace('"', "")
        raise InputError(
            "E107",
            f"the column {_shown(name)} is not known",
            where=line.where_cell(cells, unknown[0]),
            why="known are x, y (or x_mm, y_mm and so on), angle_deg, angle_rad, weight and name",
            help=f'delete the column, or name it "#{name}" (with the quotes) to have it ignored',
        )
    if units["x"] != units["y"]:
        raise InputError(
            "E108",
            f"x is in {units['x'] or 'no unit'}, y in {units['y'] or 'no unit'}",
            where=line.where_cell(cells, columns["y"]),
            help="give both columns the same unit",
        )
    where = line.where_cell(cells, columns["angle"], "angle")
    end = found.end() + 1
    return _Header(line, end, separator, names, columns, units["x"], units["angle"], where)


def _require_header(line: _Line) -> None:
    """Refuse a first line of numbers, and give the header that would fit above it."""
    separator = next((s for s in "\t;," if s in line.text), ",")
    cells = [_unquoted(cell) for cell in _split(line.text, separator)]
    if all(_NUMBER_LIKE.fullmatch(cell) for cell in cells):
        names = ["x", "y", "angle_deg", *(f"#{i}" for i in range(4, len(cells) + 1))]
        raise InputError(
            "E105",
            "there is no header: the first line is all numbers",
            where=line.where_all(),
            help=f"put this line on top: `{separator.join(names)}` (or angle_rad in it)",
        )


def _blocks(text: str, start: int) -> Iterator[str]:
    """The lines from `start` on, many at a time."""
    while start < len(text):
        end = text.find("\n", start + _BLOCK)
        end = end if end >= 0 else len(text)
        yield text[start:end]
        start = end + 1


def _rows(columns: dict[str, list[str]]) -> _Rows:
    """Numbers from plain texts; raises ValueError for any other."""
    numeric = [columns[role] for role in NUMERIC if role in columns]
    values = np.array([[float(cell) for cell in column] for column in numeric]).T
    decimals = [max(map(_decimals, column), default=0.0) for column in numeric]
    return _Rows(values, decimals, columns.get("name", []))


def _plain_rows(block: str, header: _Header, marks: dict[str, str]) -> _Rows | None:
    """The rows of a block in which nothing is unusual, fast; None if something is."""
    separator, width = header.separator, len(header.names)
    if '"' in block or "#" in block:
        return None
    if any(line.count(separator) != width - 1 for line in block.split("\n")):
        return None
    cells = block.replace("\n", separator).split(separator)
    columns = {role: cells[i::width] for role, i in header.columns.items()}
    names = [name.strip() for name in columns.pop("name", [])]
    text = "\n".join("\n".join(column) for column in columns.values())
    if not re.fullmatch(r"[-+.,0-9eE\n]*", text):
        return None
    if "," in text:
        if "." in text or "," not in marks:
            return None
        columns = {role: [c.replace(",", ".") for c in column] for role, column in columns.items()}
    elif "." in text:
        marks.setdefault(".", "")
    try:  # of these characters alone, float() takes exactly what _NUMBER does
        rows = _rows(columns | {"name": names})
    except ValueError:
        return None
    return rows if np.isfinite(rows.values).all() else None


def _checked_rows(
    block: str, header: _Header, marks: dict[str, str], *, number: int, row: int
) -> _Rows:
    """The rows of any block, cell by cell; `number` and `row` are those of its first line."""
    columns: dict[str, list[str]] = {role: [] for role in header.columns}
    for i, text in enumerate(block.split("\n")):
        if not text.strip() or text.lstrip().startswith("#"):
            continue
        line, cells = _Line(header.line.label, number + i, text), _split(text, header.separator)
        if len(cells) != len(header.names):
            raise _wrong_width(line, cells, header, row)
        for role, place in header.columns.items():
            cell = _unquoted(cells[place])
            if role != "name":
                mark = _decimal_mark(cell, header.separator)
                if mark is None:
                    where = line.where_cell(cells, place, role)
                    raise _not_a_number(cell, row, role, header, where)
                if mark not in marks:
                    marks[mark] = line.where_cell(cells, place, role)
                cell = _plain(cell, header.separator)
            columns[role].append(cell)
        row += 1
    return _rows(columns)


def _plain(cell: str, separator: str) -> str:
    """A decimal comma made a point, where the comma does not separate the cells."""
    return cell.replace(",", ".") if separator != "," and "." not in cell else cell


def _decimal_mark(cell: str, separator: str) -> str | None:
    """The mark in a finite number: "", ".", "," or "?" (it may part thousands); None for others."""
    plain = _plain(cell, separator)
    if not _NUMBER.fullmatch(plain) or not math.isfinite(float(plain)):
        return None
    if _THOUSANDS.fullmatch(cell):
        return "?"
    return "," if "," in cell else "." if "." in cell else ""


def _require_one_mark(marks: dict[str, str]) -> None:
    """Refuse commas that nothing proves to be decimal ones."""
    if "." in marks and (where := marks.get("?") or marks.get(",")):
        why = "other numbers have a decimal point, so the comma may part thousands"
    elif "," not in marks and (where := marks.get("?")):
        why = "no number shows whether the comma is a decimal mark or parts thousands"
    else:
        return
    raise InputError(
        "E104",
        "a comma in a number can be read in two ways",
        where=where,
        why=why,
        help="write every number with a decimal point, and none with a comma",
    )


def _split(line: str, separator: str) -> list[str]:
    """The cells as they stand, with their blanks and quotes, so that places can be counted."""
    if '"' not in line or line.count('"') % 2:
        return line.split(separator)
    return re.findall(rf'(?:^|{separator})((?:"[^"]*"|[^"{separator}])*+)', line)


def _unquoted(cell: str) -> str:
    cell = cell.strip()
    if len(cell) > 1 and cell[0] == cell[-1] == '"':
        return cell[1:-1].replace('""', '"').strip()
    return cell


def _not_a_number(cell: str, row: int, role: str, header: _Header, where: str) -> InputError:
    unit = UNITS.get(header.angle_unit or "") if role == "angle" else header.length_unit
    in_unit = f" in {unit}" if unit and role != "weight" else ""
    help = f"give a number{in_unit}, such as -12.5 or 3e-4, or delete the row"
    if _NOT_FINITE.fullmatch(cell) or _NUMBER.fullmatch(_plain(cell, header.separator)):
        message, why = f"row {row} has a value that is not a finite number", None
        if not _NOT_FINITE.fullmatch(cell):
            why = f"{_shown(cell)} is beyond 1.8e308, the largest number there is"
        return InputError("E103", message, where=where, why=why, help=help)
    what = "text" if cell else "an empty cell"
    why = f"{_shown(cell)} is not digits with at most a decimal point and an exponent"
    return InputError(
        "E104", f"row {row} has {what} where a number belongs", where=where, why=why, help=help
    )


def _wrong_width(line: _Line, cells: list[str], header: _Header, row: int) -> InputError:
    given, needed = len(cells), len(header.names)
    split = "a comma ends a cell here, so it cannot be a decimal mark as well"
    more = given > needed
    return InputError(
        "E106",
        f"row {row} has {given} cell{'' if given == 1 else 's'}, the header has {needed}",
        where=line.where_cell(cells, needed) if more else line.where(len(line.text), 1),
        why=split if header.separator == "," and given == 2 * needed else None,
        help=f"give {needed} cells ({', '.join(header.names)}), or delete the row",
    )


# JSON and TOML ------------------------------------------------------------------------------

_ANGLE_KEYS = {"angle_deg": "deg", "angle_rad": "rad"}


def _read_json(label: str, text: str) -> _Table:
    """JSON: a list of poses, an object with "poses", or what `synthesize --json` prints."""

    def refuse(constant: str) -> Any:
        tokens = re.finditer(r'"(?:[^"\\]|\\.)*+"|-?Infinity|NaN', text)
        position = next(token.start() for token in tokens if token[0][0] != '"')
        raise InputError(
            "E103",
            f"{constant} is not a finite number",
            where=_where_at(label, text, position, len(constant)),
            help="give a number, or delete the pose",
        )

    try:
        tree = json.loads(
            text,
            parse_float=_exact,
            parse_int=_exact,
            parse_constant=refuse,
            object_pairs_hook=_without_repeats,
        )
    except json.JSONDecodeError as error:
        where = _where_at(label, text, error.pos)
        raise _not_written_in("JSON", error.msg, where) from None
    except RecursionError:
        raise _not_written_in("JSON", "too many brackets inside each other", label) from None
    return _from_tree(label, tree, '{"angle_unit": "deg", "poses": [[0.5, 2, 30], ...]}')


def _read_toml(label: str, text: str) -> _Table:
    """TOML: `poses = [[x, y, angle], ...]` or tables `[[poses]]`."""
    try:
        tree = tomllib.loads(text, parse_float=_exact)
    except ValueError as error:
        where = label
        if found := re.search(r"\(at line (\d+), column (\d+)\)", str(error)):
            number, column = int(found[1]), int(found[2])
            where = _Line(label, number, text.split("\n")[number - 1]).where(column - 1, 1)
        raise _not_written_in("TOML", str(error).partition(" (at")[0], where) from None
    except RecursionError:
        raise _not_written_in("TOML", "too many brackets inside each other", label) from None
    return _from_tree(label, tree, 'angle_unit = "deg" above poses = [[0.5, 2, 30], ...]')


def _not_written_in(language: str, why: str, where: str) -> InputError:
    help = f"correct the {language}, or save the poses as CSV"
    return InputError("E109", f"this is not {language}", where=where, why=why, help=help)


def _exact(number: str) -> Decimal:
    """A number with the decimals it is printed with, which a float would forget."""
    try:
        return Decimal(number)
    except decimal.InvalidOperation:  # its exponent has twenty digits
        return Decimal(float(number))


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    tree: dict[str, Any] = {}
    for key, value in pairs:
        if key in tree:
            raise InputError(
                "E108",
                f"the key {_shown(key)} stands twice in one object",
                help="delete one of the two",
            )
        tree[key] = value
    return tree


@functools.cache
def _model() -> type[BaseModel]:
    """What may stand in a tree; made on first use, as pydantic is slow to import."""
    from pydantic import BaseModel, ConfigDict  # noqa: PLC0415

    class Pose(BaseModel):
        model_config = ConfigDict(strict=True, str_strip_whitespace=True, extra="forbid")
        x: Decimal
        y: Decimal
        angle: Decimal | None = None
        angle_deg: Decimal | None = None
        angle_rad: Decimal | None = None
        weight: Decimal | None = None
        name: str | None = None

    class Document(BaseModel):
        model_config = ConfigDict(strict=True, str_strip_whitespace=True)
        poses: list[Pose]
        angle_unit: Literal["deg", "rad"] | None = None
        length_unit: str | None = None

    return Document


def _from_tree(label: str, tree: Any, example: str) -> _Table:
    """The table in parsed JSON or TOML, whose numbers are Decimal (or int, in TOML)."""
    from pydantic import ValidationError  # noqa: PLC0415

    tree = {"poses": tree} if isinstance(tree, list) else tree
    path = f"{label}: "
    if isinstance(tree, dict) and "poses" not in tree and isinstance(tree.get("task"), dict):
        tree, path = tree["task"], f"{label}: task."
    if isinstance(tree, dict) and isinstance(tree.get("poses"), list):
        tree = {**tree, "poses": [_as_object(pose) for pose in tree["poses"]]}
    try:
        document: Any = _model().model_validate(tree)
    except ValidationError as error:
        raise _unfit(path, example, error.errors(include_url=False)[0]) from None
    return _from_document(document, path, example)


def _from_document(document: Any, path: str, example: str) -> _Table:
    """The table in a document of the right shape, if its poses say everything once."""
    poses = document.poses
    units = {document.angle_unit} - {None}
    angles = []
    for i, pose in enumerate(poses):
        given = [key for key in ("angle", *_ANGLE_KEYS) if getattr(pose, key) is not None]
        if len(given) != 1:
            raise InputError(
                "E108" if given else "E105",
                f"pose {i + 1} has {' and '.join(given) or 'no angle'}",
                where=f"{path}poses[{i}]",
                help="give every pose one angle, as angle_deg or as angle_rad",
            )
        angles.append(getattr(pose, given[0]))
        units.add(_ANGLE_KEYS.get(given[0], document.angle_unit))
    if len(units) > 1:
        raise InputError(
            "E110",
            "the angles are stated in different units",
            where=f"{path}poses",
            help="state one unit: angle_deg in every pose, or angle_rad in every pose",
        )
    columns = [[pose.x for pose in poses], [pose.y for pose in poses], angles]
    if any(pose.weight is not None for pose in poses):  # a pose without one counts once
        columns.append([Decimal(1) if p.weight is None else p.weight for p in poses])
    values = np.array([[float(number) for number in column] for column in columns]).T
    for i, j in np.argwhere(~np.isfinite(values)):  # 1e400 is a finite Decimal
        fault = {"type": "finite_number", "loc": ("poses", int(i), NUMERIC[j])}
        raise _unfit(path, example, fault)
    x, y, angle = (max((_decimals(str(n)) for n in c), default=0.0) for c in columns[:3])
    named = any(pose.name is not None for pose in poses)
    return _Table(
        values=values,
        decimals=(max(x, y), angle),
        names=tuple(pose.name or "" for pose in poses) if named else None,
        length_unit=document.length_unit or None,
        angle_unit=next(iter(units), None),
        where=f"{path}poses",
        say_unit=f"write {example}",
    )


def _as_object(pose: Any) -> Any:
    """[x, y, angle] as an object, and the integers of TOML as Decimal; the rest as it is."""
    if isinstance(pose, list) and len(pose) == 3:
        pose = dict(zip(NUMERIC, pose, strict=False))
    if not isinstance(pose, dict):
        return pose
    return {k: Decimal(v) if type(v) is int else v for k, v in pose.items()}


def _unfit(path: str, example: str, fault: Any) -> InputError:
    """A fault that pydantic found, in this house's words."""
    place = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in fault["loc"])
    place, given = place.lstrip("."), fault.get("input")
    value = _shown(given)
    known = "x, y, angle_deg or angle_rad (or angle, with angle_unit), weight and name"
    code, message, help = {
        "finite_number": ("E103", "is not a finite number", "give a number, or delete the pose"),
        "is_instance_of": ("E104", f"is {value}, not a number", "write a number without quotes"),
        "missing": ("E105", "is missing", f"write {example}"),
        "extra_forbidden": ("E107", "is not known", f"delete it; a pose has {known}"),
        "literal_error": ("E110", f"is {value}, not an angle unit", 'write "deg" or "rad"'),
    }.get(fault["type"], ("E104", f"does not fit: {value}", f"write {example}"))
    if fault["type"] == "model_type" and isinstance(given, list):
        code, message = "E106", f"has {len(given)} numbers, not 3"
    where = (path + place).removesuffix(": ")
    return InputError(code, f"{place or 'the file'} {message}", where=where, help=help)
