"""Tolerances in the cells of a table: numbers, "free", or nothing; and blank cells that mean free.

A blank cell under x, y or the angle is a free component where the header has the column `free` or
one of a tolerance; then `free` names it, or its tolerance is blank or says free.  A blank is never
zero: without a default for all poses a blank tolerance of a component that is given is refused.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from burmester.errors import InputError
from burmester.io.reading.pose_table import shown
from burmester.io.reading.stated_tolerances import FREE_WORDS, TOLERANCE_ROLES, free_components
from burmester.io.reading.tables.grid import Row
from burmester.tasks.pose_tolerances import COMPONENTS, Component

WORD_ROLES = ("free", "tol_axes")  # columns of words, read together at the end of a row

_AXES = {"": "", "fixed": "fixed", "f": "fixed", "body": "body", "m": "body"}


def special_text(cell: str, role: str) -> str | None:
    """The text of a cell that may hold no number; None where a number or text belongs.

    "nan" for a blank one, "inf" for a word for free.
    """
    if not cell and role in (*COMPONENTS, *TOLERANCE_ROLES, "crank"):
        return "nan"
    return "inf" if role in TOLERANCE_ROLES and _is_free(cell) else None


def read_words(
    columns: Mapping[str, list[str]], row: Row, indices: Mapping[str, int], number: int
) -> None:
    """Complete the columns `free` and `tol_axes` by the cells of a row.

    indices: of the cells by role; number: of the row, from 1.  Raises E104 and E136.
    """

    def where(role: str) -> str:
        return row.where(indices.get(role), role)

    cells = {role: row.value(index) for role, index in indices.items()}
    columns["free"].append(" ".join(_free_in_row(cells, number, where)))
    columns["tol_axes"].append(_axes_of_cell(cells.get("tol_axes", ""), number, where))


def _is_free(cell: str) -> bool:
    return cell.lower() in FREE_WORDS


def _axes_of_cell(cell: str, row: int, where: Callable[[str], str]) -> str:
    """The axes that a cell of `tol_axes` names, "" for none; raises E104."""
    axes = _AXES.get(cell.lower())
    if axes is None:
        message = f"row {row} has {shown(cell)} where the axes of a tolerance belong"
        help = "write fixed (along x and y of F) or body (along the body's own axes)"
        raise InputError("E104", message, where=where("tol_axes"), help=help)
    return axes


def _free_in_row(
    cells: Mapping[str, str], row: int, where: Callable[[str], str]
) -> tuple[Component, ...]:
    """The components that a row leaves free, by the texts of its cells (blank for no value).

    cells: by role; those of tolerances are numbers, blank or a word for free.  where: the location
    of a role's cell.  Raises E104 and E136.
    """
    named: tuple[Component, ...] = ()
    if "free" in cells:
        given = free_components(cells["free"])
        if given is None:
            message = f"row {row} has {shown(cells['free'])} where free components belong"
            help = "name x, y, angle or two of them with a blank between, or leave the cell blank"
            raise InputError("E104", message, where=where("free"), help=help)
        named = given
    out = []
    for component, role in zip(COMPONENTS, TOLERANCE_ROLES, strict=True):
        tolerance = cells.get(role, "")
        blank = cells.get(component) == ""
        says_free = component in named or _is_free(tolerance)
        if tolerance and not _is_free(tolerance) and (blank or component in named):
            free = f"{component} among its free components" if component in named else component
            has = "has" if component in named else "has no"
            raise InputError(
                "E136",
                f"row {row} {has} {free}, and a tolerance of {tolerance} for it",
                where=where(role),
                why="a component within a tolerance has a number, a free one has no tolerance",
                help=f"give {component} a number and take it out of free, or leave its tolerance "
                "blank",
            )
        if blank and "free" in cells and not says_free:
            raise InputError(
                "E104",
                f"row {row} has no {component}, and its cell of free does not name it",
                where=where(component),
                why="a blank is never zero, and means free where the row says so",
                help=f"write {component} into this row's cell of free, or give a number",
            )
        if blank or says_free:
            out.append(component)
    return tuple(out)
