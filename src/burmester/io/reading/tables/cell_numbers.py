"""Numbers in cells: what they say where that is beyond doubt, else what to write in their place.

Beside plain digits is read what has one meaning: 1'234.5 and 1.234,5, where the decimal mark is
another one than the separator of thousands; blanks part thousands where they are no-break or thin
ones; a unit behind the number, 45° or 12,5 mm, if it is one of the column.  1,234 and 1 234 may be
something else and are refused, and so is every number that has to be guessed.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable, Iterator
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import (
    NOT_FINITE,
    NUMBER,
    POINTS,
    UNITS,
    brief,
    plain_number,
    shown,
    unheld,
)
from burmester.io.reading.stated_tolerances import TOLERANCE_ROLES
from burmester.io.reading.tables.column_words import unit_of
from burmester.wording import in_unit

MAX_CHARACTERS = 200  # characters of a cell; no number that people write has more
_LENGTH_ROLES = ("x", "y", *POINTS)
# Groups of three digits; the separator is the same between all of them.
_GROUPED = re.compile(
    r"(?P<whole>[+-]?[0-9]{1,3}(?P<part>[\s,.'’_])[0-9]{3}(?:(?P=part)[0-9]{3})*)"
    r"(?:(?P<mark>[.,])(?P<rest>[0-9]*))?"
)
_SURE = "'’\u00a0\u202f\u2009.,"  # separators of thousands that are nothing else
_MEASURE = re.compile(r"(?P<number>[-+.,0-9eE'’\s]*[0-9.,])\s*(?P<unit>[^\s\d.,'’+-][^\d,;]*)")
_FRACTION = re.compile(r"([+-]?)(?:([0-9]{1,9})\s+)?([0-9]{1,9})\s*[/⁄]\s*([0-9]{1,9})")
_DASHES = {
    "\u2010": "a hyphen (U+2010)",
    "\u2011": "a hyphen (U+2011)",
    "\u2012": "a figure dash",
    "\u2013": "an en dash",
    "\u2014": "an em dash",
    "\u2015": "a bar (U+2015)",
    "\ufe63": "a small hyphen (U+FE63)",
    "\uff0d": "a wide hyphen (U+FF0D)",
}


class _Written(NamedTuple):
    """A number in a cell: as digits with a point, its decimal mark, and the unit behind it."""

    plain: str
    mark: str  # as in `plain_number`
    unit: str | None = None


class CellNumbers:
    """The numbers of a file, read cell by cell: what their commas are, and which units they have.

    stored: whether numbers without quotes are stored as such, so that no one wrote their point.
    """

    def __init__(self, separator: str, *, stored: bool = False) -> None:
        self.separator, self.stored = separator, stored
        self.marks: dict[str, str] = {}  # mark of `plain_number` -> where it stands first
        self._units: dict[tuple[str, str], tuple[str, str, int]] = {}
        self._counts: dict[str, int] = {}
        self._example: tuple[str, str] | None = None

    def read(
        self,
        cell: str,
        row: int,
        where: Callable[[], str],
        role: str = "",
        unit: str | None = None,
        *,
        quoted: bool = False,
    ) -> str:
        """The number in a cell of a row (from 1) with a decimal point; raises E103 and E104.

        role: of the column, "" where its numbers have no units and no thousands; unit: that its
        name states.
        """
        plain, mark = plain_number(cell, self.separator)
        if mark and self.stored and not quoted:
            mark = ""
        if mark is None and role and (number := _written(cell, role, self.separator)):
            plain, mark = number.plain, number.mark
            if number.unit is None:
                self._example = self._example or (cell, plain)
            elif role in TOLERANCE_ROLES:
                mark = None
            else:
                self._counts[role] = self._counts.get(role, 0) + 1
                if (role, number.unit) not in self._units:
                    self._units[role, number.unit] = (cell, where(), row)
        if mark is None:
            raise not_a_number(cell, row, where(), self.separator, unit, of_pose=bool(role))
        if not self.marks.get(mark):
            self.marks[mark] = where()
        return plain

    def text(self, cell: str, role: str) -> str:
        """A cell of a column that is passed over, with a decimal point if it is a number."""
        plain, mark = plain_number(cell, self.separator)
        number = _written(cell, role, self.separator) if mark is None else None
        return number.plain if number else plain

    def require_one_mark(self) -> None:
        """Refuse commas that nothing proves to be decimal ones: E104."""
        where = self.marks.get("?") or self.marks.get(",")
        if where and "." in self.marks:
            why = "other numbers have a decimal point, so the comma may separate thousands"
        elif where and "," not in self.marks:
            why = "no number shows whether the comma is a decimal mark or separates thousands"
        else:
            return
        message = "a comma in a number can be read in two ways"
        help = "write every number with a decimal point, and none with a comma"
        raise InputError("E104", message, where=where, why=why, help=help)

    def units(self, stated: dict[str, str | None], rows: int) -> dict[str, str | None]:
        """The unit of every column, by the header and by the cells.

        stated: by the header; rows: the number of poses.  Raises E104, E108 and E110 where units
        contradict each other, and where only some numbers have one.
        """
        units = dict(stated)
        for roles in (_LENGTH_ROLES, ("angle",)):
            columns = [role for role in roles if role in stated]
            given = [key for key in self._units if key[0] in columns]
            for role, unit in given:
                cell, where, row = self._units[role, unit]
                header = stated[columns[0]]
                number = _MEASURE.fullmatch(cell.replace("\u2212", "-"))
                plain = number["number"].strip() if number else cell
                column = "angle_deg" if role == "angle" else "x_mm"
                edit = brief(f"write {plain}", "write the number alone")
                help = f"{edit}, and the unit in the header, as in {column}"
                other = header or next(other for _, other in given)
                if unit != other:
                    code = "E110" if role == "angle" else "E108"
                    said = UNITS.get(unit, unit), UNITS.get(other, other)
                    place = "the header" if header else "another cell"
                    message = f"row {row} has {shown(cell)} in {said[0]}, {place} says {said[1]}"
                    help = f"give all {'angles' if role == 'angle' else 'lengths'} in one unit"
                    raise InputError(code, message, where=where, help=help)
                if header is None and any(self._counts.get(c, 0) < rows for c in columns):
                    message = f"row {row} has {shown(cell)}, and not all numbers have a unit"
                    why = "the others may be in another unit"
                    raise InputError("E104", message, where=where, why=why, help=help)
                units |= dict.fromkeys(columns, unit)
        return units

    def notes(self) -> Iterator[Advice]:
        """W213, for separators of thousands and for units in cells."""
        if self._example:
            cell, plain = self._example
            yield Advice(
                "W213",
                f"`{cell}` is read as {plain}",
                "write numbers without separators of thousands to have nothing said",
                "three digits stand between its separators, and the decimal mark is another one",
            )
        if self._units:
            (role, unit), (cell, _, _) = next(iter(self._units.items()))
            yield Advice(
                "W213",
                f"units are read from the cells: {shown(cell)} is{in_unit(UNITS.get(unit, unit))}",
                f"write numbers alone, and the unit in the header, as in {role}_{unit}",
            )


def _written(cell: str, role: str, separator: str) -> _Written | None:
    """What a cell says that `plain_number` does not read; None if that is not beyond doubt."""
    cell = cell.replace("\u2212", "-")
    if len(cell) > MAX_CHARACTERS:
        return None
    if number := _grouped(cell, separator):
        return number
    found = _MEASURE.fullmatch(cell)
    if not found or (unit := unit_of(found["unit"], role)) is None:
        return None
    text = found["number"].strip()
    plain, mark = plain_number(text, separator)
    if mark is not None:
        return _Written(plain, mark, unit)
    number = _grouped(text, separator)
    return number and number._replace(unit=unit)


def _grouped(cell: str, separator: str) -> _Written | None:
    """A number with separated thousands; None if it has two meanings, as 1.234 and 1,234 have."""
    found = _GROUPED.fullmatch(cell)
    if not found or found["part"] not in _SURE or found["whole"].lstrip("+-").startswith("0"):
        return None
    if found["part"] in ".," and not found["mark"]:
        return None
    if found["mark"] and (found["part"] == found["mark"] or not found["rest"]):
        return None
    if found["mark"] == "," and separator == ",":
        return None  # a comma is no decimal mark in this file
    whole = re.sub(r"[^0-9+-]", "", found["whole"])
    return _Written(f"{whole}.{found['rest']}" if found["mark"] else whole, found["mark"] or "")


# --- what is wrong with text that stands where a number belongs


def not_a_number(
    cell: str,
    row: int,
    where: str,
    separator: str = ",",
    unit: str | None = None,
    *,
    of_pose: bool = True,
) -> InputError:
    """E103 or E104, for a cell in a row, from 1, that is no number; unit: of the column."""
    plain, _ = plain_number(cell, separator)
    code, fault, why = "E103", "a value that is not a finite number", None
    of = in_unit(unit and UNITS.get(unit, unit))
    help = f"give a number{of}, such as -12.5 or 3e-4, or delete the row"
    if NUMBER.fullmatch(plain):
        why = unheld(plain)
        if math.isfinite(float(plain)):
            fault, help = "a value that is too small", "write 0 if that is meant, or delete the row"
    elif not cell:
        code, fault = "E104", "an empty cell where a number belongs"
        if of_pose:
            help += "; for a component that is free, add the column free and write x, y or angle "
            help += "into this row"
    elif not NOT_FINITE.fullmatch(plain):
        code, fault = "E104", "text where a number belongs"
        why = f"{shown(cell)} is not digits with at most a decimal point and an exponent"
        looks = (_known_text, _other_signs, _parted, _fraction, _measure, _comma)
        if found := next(filter(None, (look(cell, separator) for look in looks)), None):
            why, help = f"{shown(cell)} {found[0]}", found[1]
    return InputError(code, f"row {row} has {fault}", where=where, why=why, help=help)


_KNOWN_TEXTS = {
    r"=.*": (
        "is a formula without a stored value",
        "open and save the file in the spreadsheet, so that it stores the values",
    ),
    r"\d{4}-\d\d-\d\d( \d\d:\d\d:\d\d.*)?|\d\d:\d\d:\d\d.*|a time of .*": (
        "is a date or a time; spreadsheets take numbers such as 3.5 for one",
        "give the cell the format of a number, and type the number again",
    ),
    r"#(N/A|REF!|DIV/0!|VALUE!|NAME\?|NUM!|NULL!)": (
        "is an error value of the spreadsheet",
        "correct the formula in the sheet, or delete the row",
    ),
}


def _is_number(text: str, separator: str) -> bool:
    return plain_number(text, separator)[1] is not None


def _known_text(cell: str, _: str) -> tuple[str, str] | None:
    return next((told for text, told in _KNOWN_TEXTS.items() if re.fullmatch(text, cell)), None)


def _other_signs(cell: str, separator: str) -> tuple[str, str] | None:
    if (dash := next((c for c in cell if c in _DASHES), None)) is not None:
        plain = re.sub(f"[{''.join(_DASHES)}]", "-", cell)
        edit = f"write {plain}" if _is_number(plain, separator) else "write a minus sign: -"
        return f"has {_DASHES[dash]} where a minus sign belongs", brief(
            edit, "write a minus sign: -"
        )
    if any(c.isdigit() and not c.isascii() for c in cell):
        plain = "".join(str(unicodedata.decimal(c, c)) for c in cell)
        edit = plain if _is_number(plain, separator) else "it with the digits 0 to 9"
        return "has digits other than 0 to 9", brief(f"write {edit}", "write the digits 0 to 9")
    return None


def _parted(cell: str, separator: str) -> tuple[str, str] | None:
    found = _GROUPED.fullmatch(cell.replace("\u2212", "-"))
    if not found or found["mark"] == found["part"]:
        return None
    if found["part"] == "," and cell.count(",") == 1 and not found["mark"]:
        return None  # 0,435 may as well have a decimal comma
    plain = re.sub(r"[^0-9+-]", "", found["whole"])
    if found["mark"]:
        plain += f"{',' if found['mark'] == ',' != separator else '.'}{found['rest']}"
    edit = brief(f"write {plain}", "write it without them")
    return "has separators between its thousands", edit


def _fraction(cell: str, _: str) -> tuple[str, str] | None:
    found = _FRACTION.fullmatch(cell)
    if not found or not int(found[4]):
        return None
    size = int(found[2] or 0) + Fraction(int(found[3]), int(found[4]))
    return "is a fraction", f"write {found[1]}{float(size)!r}"


def _measure(cell: str, separator: str) -> tuple[str, str] | None:
    found = _MEASURE.fullmatch(cell.replace("\u2212", "-"))
    if not found or not _is_number(number := found["number"].strip(), separator):
        return None
    if found["unit"] == "%" and len(cell) < 30 and "e" not in cell.lower():
        plain = format(Decimal(plain_number(number, separator)[0]).scaleb(-2), "f")
        mark = "," if "," in number else "."
        return "has a percent sign", f"write {plain.replace('.', mark)}"
    if re.fullmatch(r"[a-zA-Zµμ°\"'′″]+\.?", found["unit"]):
        column = "angle_deg" if found["unit"] == "°" else "x_mm"
        edit = brief(f"write {number}", "delete that")
        return (
            "has a unit or other text after the number",
            f"{edit}, and the unit in the header, as in {column}",
        )
    return None


def _comma(cell: str, separator: str) -> tuple[str, str] | None:
    if separator != "," or cell.count(",") != 1 or not _is_number(cell, ";"):
        return None
    return (
        "has a comma, which ends a cell in this file",
        brief(f"write {cell.replace(',', '.')}", "write a point for it")
        + ", or delete the comma if it separates thousands",
    )
