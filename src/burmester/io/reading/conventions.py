"""Conventions in which a file may state its poses: --convention.

Here x points right, y up, and angles count counterclockwise.  A file that does otherwise is read as
it says, never as it seems to be.  Limits, outlines and tolerances stay as they are given.

E115 a convention that is not known, or has no meaning for the file
"""

from __future__ import annotations

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.io.reading.pose_table import PoseTable, Source, shown

# What each changes, as `check` says it.
CONVENTIONS = {
    "clockwise": "angles negated",
    "y-down": "y negated",
    "swap-xy": "x and y exchanged",
    "radians": "angles taken as radians",
    "degrees": "angles taken as degrees",
}


def convention_names(text: str | None) -> tuple[str, ...]:
    """The names in a text, separated by commas; raises E115."""
    names = tuple(name.strip() for name in text.split(",")) if text else ()
    source = Source("--convention", text or "")
    for name in names:
        if name not in CONVENTIONS or names.count(name) > 1:
            twice = " twice" if name in CONVENTIONS else ""
            message = f"there is no convention {shown(name)}{twice}"
            help = f"give one or several of {', '.join(CONVENTIONS)}"
            where = source.where((text or "").find(name), len(name))
            raise InputError("E115", message, where=where, help=help)
    if {"radians", "degrees"} <= {*names}:
        message = "--convention states radians and degrees"
        raise InputError("E115", message, help="leave one of the two out")
    return names


def with_stated_unit(table: PoseTable, names: tuple[str, ...]) -> PoseTable:
    """A table with the unit of angles that the convention states; raises E115.

    That is where its poses have no angles, or where x and y are exchanged and have tolerances.
    """
    if not names:
        return table
    message = why = ""
    if table.rows.points or table.path is not None:
        message = "--convention is for angles of the body, and this file has points alone"
        why = "a mirror image of all points has the same linkage, mirrored"
    elif "swap-xy" in names and (table.rows.tolerances is not None or table.tolerance is not None):
        message = "--convention swap-xy exchanges x and y, and the file names their tolerances"
        why = "it cannot be told whether the tolerances are exchanged as well"
    if message:
        help = "exchange the names of the columns in the file" if "swap-xy" in names else ""
        raise InputError("E115", message, why=why, help=help or "leave --convention out")
    unit = "rad" if "radians" in names else "deg" if "degrees" in names else table.angle_unit
    done = ", ".join(CONVENTIONS[name] for name in names)
    return table._replace(angle_unit=unit, read_as=f"{table.read_as or 'as stated'}; {done}")


def in_convention(poses: Displacement, names: tuple[str, ...]) -> Displacement:
    """Poses of a file that states them in a convention, as they are here."""
    d, angle = poses.translation, poses.angle
    if "y-down" in names:
        d = d * [1.0, -1.0]
    if "swap-xy" in names:
        d = d[..., ::-1]
    return Displacement(d, -angle if "clockwise" in names else angle)
