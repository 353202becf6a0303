"""The table that every pose file is read into: numbers as printed, and their locations."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Container, Mapping
from decimal import Decimal
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Advice, InputError
from burmester.geometry.regions import Polygon
from burmester.io.reading.specification import Specification, StatedSurroundings
from burmester.io.reading.stated_tolerances import DefaultTolerance, StatedTolerances
from burmester.numerics.arrays import FloatArray
from burmester.printable import blanked
from burmester.tasks.loads import Loads
from burmester.tasks.traced_path import TracedPath

HEADER = "x,y,angle_deg"  # what a file may begin with
UNITS = {"deg": "degrees", "rad": "radians"}
NUMERIC = ("x", "y", "angle", "weight")
POINTS = ("px", "py", "qx", "qy")  # in place of x, y and angle
DIRECTION = ("cos", "sin")  # of the angle, in its place
PAIR = ("crank", "output")  # the input and the output angle of a function
MARKS = {"yes": True, "true": True, "1": True, "x": True}  # of an exact pose, in small letters
MARKS |= {"no": False, "false": False, "0": False, "": False}

# Of the motion, or radians; numbers whose last digit leaves more open are meant exactly.
MEANT_EXACTLY = 5e-4

NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE)
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2},[0-9]{3}")
NUMBER_LIKE = re.compile(rf"[-−+.,]*[0-9][-−+.,0-9eE]*|{NOT_FINITE.pattern}", re.IGNORECASE)


class Rows(NamedTuple):
    """Some poses, as numbers."""

    # (N, 3): x, y and angle in its own unit, or (N, 2K): K tracked points; then weight if given
    values: FloatArray
    decimals: tuple[float, float]  # the most that a length and an angle are printed with
    names: list[str]  # one a pose, or none at all
    exact: list[bool]  # the same
    points: int = 0  # the tracked points whose x and y the values are, in place of x, y, angle
    tolerances: StatedTolerances | None = None  # then x, y and angle may be nan, which is free
    lengths: FloatArray | None = None  # (N,), the roots of cos² + sin², where these are given
    crank: FloatArray | None = None  # (N,), angles of the driver in their own unit; nan: untimed

    @classmethod
    def read(cls, columns: dict[str, list[str]]) -> Rows:
        """The rows in texts by role; raises ValueError where float() does.

        The roles are x, y, angle (or its cos and sin: then it is in radians), or px, py, qx, qy;
        weight, name and exact if there are any;
        and those of tolerances.  Without an angle, or where it is nan, the angle is free.
        """
        columns, direction = _with_free_angles(columns), "cos" in columns
        numeric = [columns[role] for role in numeric_roles(columns)]
        points = 2 if "px" in columns else 0
        place = 2 * points or 3 + direction
        printed = [max(map(decimals, column), default=0.0) for column in numeric[:place]]
        most = (max(printed), 0.0) if points else (max(printed[:2]), max(printed[2:]))
        values = np.array([[float(number) for number in column] for column in numeric]).T
        lengths = None
        if direction:
            # Errors of both that are alike are errors of the angle as great, whatever it is.
            cosine, sine = values[:, 2], values[:, 3]
            lengths, angle = np.hypot(cosine, sine), np.arctan2(sine, cosine)
            values = np.column_stack([values[:, :2], angle, values[:, 4:]])
        exact = [MARKS[mark.lower()] for mark in columns.get("exact", [])]
        tolerances = StatedTolerances.read(columns, len(values))
        names = columns.get("name", [])
        crank = np.array(list(map(float, columns["crank"]))) if "crank" in columns else None
        return cls(values, most, names, exact, points, tolerances, lengths, crank)

    @classmethod
    def joined(cls, parts: list[Rows]) -> Rows:
        """The rows of all parts, one after the other."""

        def together(arrays: list[FloatArray | None]) -> FloatArray | None:
            given = [each for each in arrays if each is not None]
            return np.concatenate(given) if given else None

        lengths, angles = zip(*(part.decimals for part in parts), strict=True)
        tolerances = None
        if any(part.tolerances is not None for part in parts):
            tolerances = StatedTolerances.joined(
                [part.tolerances or StatedTolerances.none(len(part.values)) for part in parts]
            )
        return parts[0]._replace(
            values=np.concatenate([part.values for part in parts]),
            decimals=(max(lengths), max(angles)),
            names=[name for part in parts for name in part.names],
            exact=[mark for part in parts for mark in part.exact],
            tolerances=tolerances,
            lengths=together([part.lengths for part in parts]),
            crank=together([part.crank for part in parts]),
        )

    def at(self, kept: NDArray[np.intp]) -> Rows:
        """The rows at some numbers; names and marks stay those of all."""
        return self._replace(
            values=self.values[kept],
            tolerances=self.tolerances and self.tolerances.at(kept),
            crank=None if self.crank is None else self.crank[kept],
        )


def _with_free_angles(columns: dict[str, list[str]]) -> dict[str, list[str]]:
    """Texts by role, with angles, and a column `free` that names those that are blank (nan)."""
    if "px" in columns or "cos" in columns:
        return columns
    angle = columns.get("angle", ["nan"] * len(columns["x"]))
    free = columns.get("free", [""] * len(angle))
    if "nan" not in angle or ("angle" in columns and "free" in columns):
        return columns
    named = zip(angle, free, strict=True)
    return columns | {"angle": angle, "free": [f"{f} angle" if a == "nan" else f for a, f in named]}


class CrankOptions(NamedTuple):
    """How crank angles are meant: as directions in F, and how far they may be missed, radians."""

    absolute: bool = False
    within: float | None = None


class PoseTable(NamedTuple):
    """All that a file states about its poses."""

    rows: Rows
    length_unit: str | None
    angle_unit: str | None
    where: str  # the location where the angle unit is stated, or should be
    say_unit: str  # how to state it there
    specification: Specification = Specification()
    body: Polygon | None = None  # its outline, in M
    surroundings: StatedSurroundings = StatedSurroundings()
    loads: Loads | None = None
    where_loads: str = ""
    tolerance: DefaultTolerance | None = None  # of poses that state none
    pose_sigma: tuple[float, float] | None = None  # standard deviations of the poses, if stated
    # where a row stands, by its number from 0; None is for where they begin
    locate_row: Callable[[int | None], str] | None = None
    notes: tuple[Advice, ...] = ()  # what was assumed in reading
    read_as: str | None = None  # the form of the file and its columns, in words
    times: Callable[[], FloatArray | None] | None = None  # reads those of the rows, in seconds
    path: TracedPath | None = None  # how points without angles are traced
    crank_unit: str | None = None  # of the rows' crank angles; None: that of the poses
    crank: CrankOptions = CrankOptions()  # how crank angles are meant


SHEET_HEAD = "sep=\t\n"  # how the text of a sheet begins; row 1 is behind it


class Sheet(NamedTuple):
    """A sheet of a workbook, or Parquet, that was made a text with a tab between cells."""

    name: str
    merged: dict[tuple[int, int], str]  # (row, column) from 1 -> the cell that it is merged with
    columns: tuple[str, ...] = ()  # the names of the columns of Parquet; its row 0 are these
    printed: Mapping[int, float] | None = None  # column -> decimals, of what Parquet stores

    def place(self, row: int, column: int | None) -> str:
        """A cell by its numbers, or a row, in words; nothing for all names of columns."""
        if self.columns:
            parts = [f"row {row}"] if row else []
            if column is not None:
                name = brief(f"column {self.columns[column - 1]}", f"column number {column}")
                parts.append(name)
            return ", ".join(parts)
        if column is None:
            return f"row {row}"
        merged = self.merged.get((row, column))
        return f"cell {cell_name(row, column)}" + (f", merged with {merged}" if merged else "")


class Source(NamedTuple):
    """A text and the file it comes from."""

    label: str
    text: str
    notes: tuple[Advice, ...] = ()  # what was assumed to get the text
    sheet: Sheet | None = None  # where the text is that of a sheet, behind SHEET_HEAD

    @property
    def names_columns(self) -> bool:
        """Whether its columns have names that nothing can replace, as those of Parquet do."""
        return bool(self.sheet and self.sheet.columns)

    @property
    def line_word(self) -> str:
        return "row" if self.sheet else "line"

    def line_number(self, position: int) -> int:
        """The number of the line, or of the sheet's row, at a position in the text."""
        return self.text.count("\n", 0, position) + (self.sheet is None)

    def where(self, position: int, width: int = 1, note: str = "") -> str:
        """`file:line:column` of a position in the text, that line, and carets below it."""
        start = self.text.rfind("\n", 0, position) + 1
        number, column = self.line_number(start), position - start
        place = f"{self.label}:{number}:{column + 1}"
        if self.sheet:
            whole = "\t" in self.text[position : position + width]
            cell = None if whole else self.text.count("\t", start, position) + 1
            named = self.sheet.place(number - self.names_columns, cell)
            place = f"{self.label}: {named}" if named else self.label
            if self.names_columns:
                return place
        start += max(0, column - 60)  # a whole JSON file may be one line
        line = self.text[start : start + 100].partition("\n")[0]
        line = blanked(line)
        blanks, gutter = position - start, max(4, len(str(number)))
        carets = "^" * max(1, min(width, len(line) - blanks))
        return (
            f"{place}\n{number:>{gutter}} | {line}\n{'':>{gutter}} | {'':>{blanks}}{carets} {note}"
        ).rstrip()


def cell_name(row: int, column: int) -> str:
    """The name of a cell by its numbers from 1, such as "AB12"."""
    letters = ""
    while column:
        column, letter = divmod(column - 1, 26)
        letters = chr(ord("A") + letter) + letters
    return f"{letters}{row}"


def numeric_roles(columns: Container[str]) -> list[str]:
    """The roles of numbers among the columns, in the order in which `Rows.values` has them."""
    order = (*NUMERIC[:3], *DIRECTION, *POINTS, NUMERIC[3])
    return [role for role in order if role in columns]


def plain_number(cell: str, separator: str) -> tuple[str, str | None]:
    """A cell with a point for its decimal comma, and its mark: "", ".", "," or "?".

    "?" is a comma that may separate thousands; the mark is None if this is no finite number.  The
    minus sign U+2212 is a minus.  1e-400, which would become 0, is none that a double holds.
    """
    cell = cell.replace("\u2212", "-")
    plain = cell.replace(",", ".") if separator != "," and "." not in cell else cell
    if not NUMBER.fullmatch(plain) or not is_held(plain):
        return plain, None
    if _THOUSANDS.fullmatch(cell):
        return plain, "?"
    return plain, "," if "," in cell else "." if "." in cell else ""


def is_held(number: str) -> bool:
    """Whether a double is near a number: it is finite, and not 0 unless all its digits are."""
    value = float(number)
    return math.isfinite(value) and (
        value != 0 or not re.search("[1-9]", re.split("[eE]", number, maxsplit=1)[0])
    )


def unheld(number: str) -> str:
    """Why a number that `is_held` denies is refused."""
    if math.isfinite(float(number)):
        return f"{shown(number)} is nearer to 0 than 4.9e-324, the smallest representable number"
    return f"{shown(number)} is beyond 1.8e308, the largest representable number"


def held_float(number: str) -> float:
    """The double of a number in JSON or TOML; raises E103 for one that would become 0."""
    value = float(number)
    if value == 0 and not is_held(number):
        message, help = f"{shown(number)} is too small", "write 0 if that is meant"
        raise InputError("E103", message, why=unheld(number), help=help)
    return value


def resolution_by_digits(half: float, size: float) -> float:
    """How exactly numbers are known by their digits: half of the last one, or 0 if that is coarse.

    half: of the last digit; size: of what the numbers measure, in the same unit.
    People write 45 and 12.5 and mean these numbers; what a program prints or an instrument
    measures has finer digits.  Whether there is a decimal point says nothing: another unit would
    move it.
    """
    return half if half <= MEANT_EXACTLY * size else 0.0


def extent(points: FloatArray) -> float:
    """The diagonal of the box around points (N, 2), 0 without any."""
    with np.errstate(over="ignore"):
        return float(np.hypot(*np.ptp(points, axis=0))) if len(points) else 0.0


def no_poses(message: str) -> InputError:
    """E102, for a file without poses."""
    help = "write a CSV file: `x,y,angle_deg` on line 1, and a pose on each line below"
    return InputError("E102", f"no poses: {message}", help=help)


def shown(value: object) -> str:
    """A value as an error shows it, in 40 characters at most."""
    try:
        text = str(value) if isinstance(value, Decimal) else repr(value)
    except (ValueError, RecursionError):  # an integer of 5,000 digits, a thousand brackets
        text = f"a long {type(value).__name__}"
    return text if len(text) <= 40 else f"{text[:37]}..."


def brief(edit: str, otherwise: str) -> str:
    """An edit that holds a piece of a file, or the same in other words if that is long."""
    return edit if len(edit) <= 120 and edit.replace("\t", "").isprintable() else otherwise


def decimals(number: str) -> float:
    """The decimals a number is printed with, its exponent counted: 4 for "1.5e-3"."""
    if "e" in number or "E" in number:
        mantissa, _, exponent = number.lower().partition("e")
        return max(0.0, decimals(mantissa) - float(exponent))
    point = number.find(".")
    return len(number) - point - 1 if point >= 0 else 0
