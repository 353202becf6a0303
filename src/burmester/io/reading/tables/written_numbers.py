"""Numbers in cells as people write them: with separators of thousands, and with their unit.

Read is what has one meaning: 1'234.5 and 1.234,5, where the decimal mark is another one than the
separator; blanks part thousands where they are no-break or thin ones; a unit behind the number, 45°
or 12,5 mm, if it is one of the column.  1,234 and 1 234 may be something else and are refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import POINTS, UNITS, brief, plain_number, shown
from burmester.io.reading.tables.column_words import unit_of
from burmester.wording import in_unit

__all__ = ["CellNumbers", "WrittenNumber", "written_number"]

# Groups of three digits; the separator is the same between all of them.
_GROUPED = re.compile(
    r"(?P<whole>[+-]?[1-9][0-9]{0,2}(?:(?P<part>['’\u00a0\u202f\u2009.,])[0-9]{3})"
    r"(?:(?P=part)[0-9]{3})*)(?:(?P<mark>[.,])(?P<rest>[0-9]+))?"
)
_MEASURE = re.compile(r"(?P<number>[-+.,0-9eE'’\s]*[0-9.,])\s*(?P<unit>[^\s\d.,'’+-][^\d,;]*)")
MAX_CHARACTERS = 200  # characters of a cell; no number that people write has more
_LENGTH_ROLES = ("x", "y", *POINTS)


class WrittenNumber(NamedTuple):
    """A number in a cell: as digits with a point, its decimal mark, and the unit behind it."""

    plain: str
    mark: str  # as in `plain_number`
    unit: str | None


def written_number(cell: str, role: str, separator: str) -> WrittenNumber | None:
    """What a cell says that `plain_number` does not read; None if that is not beyond doubt."""
    cell = cell.replace("\u2212", "-")
    if len(cell) > MAX_CHARACTERS:
        return None
    if grouped := _grouped(cell, separator):
        return WrittenNumber(*grouped, None)
    found = _MEASURE.fullmatch(cell)
    unit = unit_of(found["unit"], role) if found else None
    if not found or unit is None:
        return None
    number = found["number"].strip()
    plain, mark = plain_number(number, separator)
    if mark is not None:
        return WrittenNumber(plain, mark, unit)
    grouped = _grouped(number, separator)
    return WrittenNumber(*grouped, unit) if grouped else None


def _grouped(cell: str, separator: str) -> tuple[str, str] | None:
    """A number with separated thousands as plain digits, and its decimal mark."""
    found = _GROUPED.fullmatch(cell)
    if not found or found["part"] == found["mark"]:
        return None
    if found["part"] in ".," and not found["mark"]:
        return None  # 1.234 and 1,234 have two meanings
    if found["mark"] == "," and separator == ",":
        return None  # a comma is no decimal mark in this file
    whole = re.sub(r"[^0-9+-]", "", found["whole"])
    return (f"{whole}.{found['rest']}" if found["mark"] else whole), found["mark"] or ""


class CellNumbers:
    """The numbers of a file that are written in such a way: their units, and an example."""

    def __init__(self) -> None:
        self._units: dict[tuple[str, str], tuple[str, str, int]] = {}
        self._counts: dict[str, int] = {}
        self._example: tuple[str, str] | None = None

    def add(
        self, number: WrittenNumber, cell: str, role: str, row: int, where: Callable[[], str]
    ) -> None:
        """Take note of a number in a row (counted from 1) and a column."""
        if number.unit is None:
            self._example = self._example or (cell, number.plain)
            return
        self._counts[role] = self._counts.get(role, 0) + 1
        if (role, number.unit) not in self._units:
            self._units[role, number.unit] = (cell, where(), row)

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
