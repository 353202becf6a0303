"""What is wrong with text that stands where a number belongs, and what to write in its place.

Nothing is taken for what it seems to mean: a number that has to be guessed is refused.
"""

from __future__ import annotations

import math
import re
import unicodedata
from decimal import Decimal
from fractions import Fraction

from burmester.errors import InputError
from burmester.io.reading.pose_table import (
    NOT_FINITE,
    NUMBER,
    UNITS,
    brief,
    plain_number,
    shown,
    unheld,
)
from burmester.wording import in_unit

__all__ = ["not_a_number"]

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
_PARTED = re.compile(r"([+-]?[0-9]{1,3}(?:([\s,.'’_])[0-9]{3})(?:\2[0-9]{3})*)(?:([.,])([0-9]*))?")
_MEASURE = re.compile(r"([-+.,0-9eE]*[0-9.])\s*([^\s\d.,+-][^\d,;]*)")
_FRACTION = re.compile(r"([+-]?)(?:([0-9]{1,9})\s+)?([0-9]{1,9})\s*[/⁄]\s*([0-9]{1,9})")


def not_a_number(
    cell: str, plain: str, *, row: int, unit: str | None, where: str, separator: str = ","
) -> InputError:
    """E103 or E104, for a cell that `plain_number` turned into `plain` without a mark.

    row: from 1; unit: of the column, if it names one.
    """
    code, fault, why = "E103", "a value that is not a finite number", None
    of = in_unit(unit and UNITS.get(unit, unit))
    help = f"give a number{of}, such as -12.5 or 3e-4, or delete the row"
    if NUMBER.fullmatch(plain):
        why = unheld(plain)
        if math.isfinite(float(plain)):
            fault, help = "a value that is too small", "write 0 if that is meant, or delete the row"
    elif not cell:
        code, fault = "E104", "an empty cell where a number belongs"
        help += "; for a component that is free, add the column free and write x, y or angle into "
        help += "this row"
    elif not NOT_FINITE.fullmatch(plain):
        code, fault = "E104", "text where a number belongs"
        why = f"{shown(cell)} is not digits with at most a decimal point and an exponent"
        for look in (
            _formula,
            _date,
            _dash,
            _spreadsheet,
            _digits,
            _parted,
            _fraction,
            _measure,
            _comma,
        ):
            if found := look(cell, separator):
                why, help = f"{shown(cell)} {found[0]}", found[1]
                break
    return InputError(code, f"row {row} has {fault}", where=where, why=why, help=help)


def _is_number(text: str, separator: str) -> bool:
    return plain_number(text, separator)[1] is not None


def _dash(cell: str, separator: str) -> tuple[str, str] | None:
    dash = next((c for c in cell if c in _DASHES), None)
    if dash is None:
        return None
    plain = re.sub(f"[{''.join(_DASHES)}]", "-", cell)
    edit = f"write {plain}" if _is_number(plain, separator) else "write a minus sign: -"
    return f"has {_DASHES[dash]} where a minus sign belongs", brief(edit, "write a minus sign: -")


def _spreadsheet(cell: str, separator: str) -> tuple[str, str] | None:
    if not re.fullmatch(r"#(N/A|REF!|DIV/0!|VALUE!|NAME\?|NUM!|NULL!)", cell):
        return None
    return (
        "is an error value of the spreadsheet",
        "correct the formula in the sheet, or delete the row",
    )


def _formula(cell: str, separator: str) -> tuple[str, str] | None:
    if not cell.startswith("="):
        return None
    return (
        "is a formula without a stored value",
        "open and save the file in the spreadsheet, so that it stores the values",
    )


def _date(cell: str, separator: str) -> tuple[str, str] | None:
    if not re.fullmatch(r"\d{4}-\d\d-\d\d( \d\d:\d\d:\d\d.*)?|\d\d:\d\d:\d\d.*|a time of .*", cell):
        return None
    return (
        "is a date or a time; spreadsheets take numbers such as 3.5 for one",
        "give the cell the format of a number, and type the number again",
    )


def _digits(cell: str, separator: str) -> tuple[str, str] | None:
    if not any(c.isdigit() and not c.isascii() for c in cell):
        return None
    plain = "".join(str(unicodedata.decimal(c, c)) for c in cell)
    edit = plain if _is_number(plain, separator) else "it with the digits 0 to 9"
    return "has digits other than 0 to 9", brief(f"write {edit}", "write the digits 0 to 9")


def _parted(cell: str, separator: str) -> tuple[str, str] | None:
    found = _PARTED.fullmatch(cell.replace("\u2212", "-"))
    if not found or found[3] == found[2]:
        return None
    if found[2] == "," and cell.count(",") == 1 and not found[3]:
        return None  # 0,435 may as well have a decimal comma
    whole = re.sub(r"[^0-9+-]", "", found[1])
    comma = found[3] == "," and separator != ","
    plain = whole + (f"{',' if comma else '.'}{found[4]}" if found[3] else "")
    edit = brief(f"write {plain}", "write it without them")
    return "has separators between its thousands", edit


def _fraction(cell: str, separator: str) -> tuple[str, str] | None:
    found = _FRACTION.fullmatch(cell)
    if not found or not int(found[4]):
        return None
    size = int(found[2] or 0) + Fraction(int(found[3]), int(found[4]))
    return "is a fraction", f"write {found[1]}{float(size)!r}"


def _measure(cell: str, separator: str) -> tuple[str, str] | None:
    found = _MEASURE.fullmatch(cell.replace("\u2212", "-"))
    if not found or not _is_number(found[1], separator):
        return None
    if found[2] == "%" and len(cell) < 30 and "e" not in cell.lower():
        plain = format(Decimal(plain_number(found[1], separator)[0]).scaleb(-2), "f")
        mark = "," if "," in found[1] else "."
        return "has a percent sign", f"write {plain.replace('.', mark)}"
    if re.fullmatch(r"[a-zA-Zµμ°\"'′″]+\.?", found[2]):
        column = "angle_deg" if found[2] == "°" else "x_mm"
        edit = brief(f"write {found[1]}", "delete that")
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


_LOOKS = (_formula, _date, _dash, _spreadsheet, _digits, _parted, _fraction, _measure, _comma)
