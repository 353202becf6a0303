"""What every pose file boils down to: numbers as printed, and where they stand in the text."""

from __future__ import annotations

import math
import re
from decimal import Decimal
from typing import NamedTuple

import numpy as np

from burmester.displacement import FloatArray
from burmester.errors import InputError
from burmester.io.wanted import Wanted

__all__ = [
    "MARKS",
    "NUMBER_LIKE",
    "NUMERIC",
    "UNITS",
    "PoseTable",
    "Rows",
    "Source",
    "empty",
    "not_a_number",
    "plain_number",
    "shown",
]

UNITS = {"deg": "degrees", "rad": "radians"}
NUMERIC = ("x", "y", "angle", "weight")
MARKS = {"yes": True, "true": True, "1": True, "x": True}  # of an exact pose, in small letters
MARKS |= {"no": False, "false": False, "0": False, "": False}

_NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE)
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2},[0-9]{3}")
NUMBER_LIKE = re.compile(rf"[-+.,]*[0-9][-+.,0-9eE]*|{_NOT_FINITE.pattern}", re.IGNORECASE)


class Rows(NamedTuple):
    """Some poses, as numbers."""

    values: FloatArray  # (N, 3) or (N, 4): x, y, angle in its own unit, and weight if given
    decimals: tuple[float, float]  # the most that a length and an angle are printed with
    names: list[str]  # one a pose, or none at all
    exact: list[bool]  # the same

    @classmethod
    def read(cls, columns: dict[str, list[str]]) -> Rows:
        """The rows in texts by role; raises ValueError where float() does."""
        numeric = [columns[role] for role in NUMERIC if role in columns]
        x, y, angle = (max(map(_decimals, column), default=0.0) for column in numeric[:3])
        values = np.array([[float(number) for number in column] for column in numeric]).T
        exact = [MARKS[mark.lower()] for mark in columns.get("exact", [])]
        return cls(values, (max(x, y), angle), columns.get("name", []), exact)

    @classmethod
    def joined(cls, parts: list[Rows]) -> Rows:
        """The rows of all parts, one after the other."""
        lengths, angles = zip(*(part.decimals for part in parts), strict=True)
        values = np.concatenate([part.values for part in parts])
        names = [name for part in parts for name in part.names]
        exact = [mark for part in parts for mark in part.exact]
        return cls(values, (max(lengths), max(angles)), names, exact)


class PoseTable(NamedTuple):
    """All that a file says about its poses."""

    rows: Rows
    length_unit: str | None
    angle_unit: str | None
    where: str  # the place where the angle unit is stated, or should be
    say_unit: str  # how to state it there
    wanted: Wanted = Wanted()
    sigma: tuple[float, float] | None = None  # standard deviations of the poses, if stated


class Source(NamedTuple):
    """A text and the file it comes from."""

    label: str
    text: str

    def where(self, position: int, width: int = 1, note: str = "") -> str:
        """`file:line:column` of a position in the text, that line, and carets below it."""
        start = self.text.rfind("\n", 0, position) + 1
        number, column = self.text.count("\n", 0, start) + 1, position - start
        start += max(0, column - 60)  # a whole JSON file may be one line
        line = self.text[start : start + 100].partition("\n")[0]
        line = "".join(c if c.isprintable() else " " for c in line)
        blanks, gutter = position - start, max(4, len(str(number)))
        carets = "^" * max(1, min(width, len(line) - blanks))
        return (
            f"{self.label}:{number}:{column + 1}\n{number:>{gutter}} | {line}\n"
            f"{'':>{gutter}} | {'':>{blanks}}{carets} {note}"
        ).rstrip()


def plain_number(cell: str, separator: str) -> tuple[str, str | None]:
    """A cell with a point for its decimal comma, and its mark: "", ".", "," or "?".

    "?" is a comma that may part thousands; the mark is None if this is no finite number.
    """
    plain = cell.replace(",", ".") if separator != "," and "." not in cell else cell
    if not _NUMBER.fullmatch(plain) or not math.isfinite(float(plain)):
        return plain, None
    if _THOUSANDS.fullmatch(cell):
        return plain, "?"
    return plain, "," if "," in cell else "." if "." in cell else ""


def not_a_number(cell: str, plain: str, row: int, unit: str | None, where: str) -> InputError:
    """E103 or E104, for a cell that `plain_number` made `plain` and gave no mark."""
    code, fault, why = "E103", "a value that is not a finite number", None
    if _NUMBER.fullmatch(plain):
        why = f"{shown(cell)} is beyond 1.8e308, the largest number there is"
    elif not _NOT_FINITE.fullmatch(cell):
        code, fault = "E104", f"{'text' if cell else 'an empty cell'} where a number belongs"
        why = f"{shown(cell)} is not digits with at most a decimal point and an exponent"
    in_unit = f" in {UNITS.get(unit, unit)}" if unit else ""
    help = f"give a number{in_unit}, such as -12.5 or 3e-4, or delete the row"
    return InputError(code, f"row {row} has {fault}", where=where, why=why, help=help)


def empty(message: str) -> InputError:
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


def _decimals(number: str) -> float:
    """The decimals a number is printed with, its exponent counted: 4 for "1.5e-3"."""
    mantissa, _, exponent = number.lower().partition("e")
    printed = len(mantissa.partition(".")[2])
    return max(0.0, printed - float(exponent)) if exponent else printed
