"""Columns by the names that people give them: what stands in each, and in which unit.

Capitals do not count.  A unit stands in the name: x_mm, `x mm`, `x (mm)`, `x [mm]`, x/mm.

x, y and an angle (also theta, phi, rotation), or two points of the body: px, py, qx, qy
lengths: um, mm, cm, m, in, ft (also µm, inch, inches, feet); angles: deg, rad (also degree,
degrees, °, radian, radians)
weight; exact; name (also pose, label)
ignored: time (with or without a unit), frame, index, no, nr, and what begins with #
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import NamedTuple

from burmester.errors import InputError
from burmester.io.reading.pose_table import NUMERIC, POINTS, brief, shown

__all__ = ["HEADER", "Columns", "is_header", "read_columns"]

HEADER = "x,y,angle_deg"  # what a file may begin with

_LENGTHS = {unit: unit for unit in ("um", "mm", "cm", "m", "in", "ft")}
_LENGTHS |= {"\u00b5m": "um", "\u03bcm": "um", "inch": "in", "inches": "in", "feet": "ft"}
_ANGLES = dict.fromkeys(("deg", "degree", "degrees", "°"), "deg")
_ANGLES |= dict.fromkeys(("rad", "radian", "radians"), "rad")
_TIMES = dict.fromkeys(("s", "sec", "second", "seconds"), "s")
_TIMES |= {"ms": "ms", "milliseconds": "ms", "min": "min"}

_IGNORED = ""  # the role of a column that is left alone
_BASES: dict[str, tuple[str, dict[str, str]]] = {  # name -> role and units
    **{name: (name, _LENGTHS) for name in ("x", "y", *POINTS)},
    **dict.fromkeys(("angle", "theta", "phi", "rotation", "θ", "φ", "ϕ"), ("angle", _ANGLES)),
    **dict.fromkeys(("name", "pose", "label"), ("name", {})),
    "weight": ("weight", {}),
    "exact": ("exact", {}),
    "time": (_IGNORED, _TIMES),
    **dict.fromkeys(("frame", "index", "no", "nr", "no.", "nr."), (_IGNORED, {})),
    "__index_level_0__": (_IGNORED, {}),  # what pandas calls an index without a name
}
_NAME = re.compile(
    r"(?P<base>[^\W\d_]+\.?)"
    r"(?:[\s_]*\(\s*(?P<round>[^()\s]+)\s*\)|[\s_]*\[\s*(?P<square>[^\[\]\s]+)\s*\]"
    r"|\s*/\s*(?P<slash>\S+)|[\s_]+(?P<blank>\S+))"
)
MAX_NAME_CHARACTERS = 60  # characters of a name; a longer one is not compared with known ones
MAX_NAMES = 12  # names of columns that an error lists, or compares with known ones
_KNOWN = (
    "the known names are x, y (or x_mm, y_mm and so on), angle_deg, angle_rad, weight, exact and "
    "name, or px, py, qx, qy in place of x, y and the angle"
)


class Columns(NamedTuple):
    """What the names of columns say."""

    indices: dict[str, int]  # role -> index in a row
    units: dict[str, str | None]  # role -> unit

    @property
    def length_unit(self) -> str | None:
        return self.units["px" if "px" in self.units else "x"]


def is_header(names: Sequence[str]) -> bool:
    """Whether all these are names of columns, and of enough of them for a pose."""
    known = [_column(name) for name in names]
    roles = {column[0] for column in known if column}
    return None not in known and any(roles.issuperset(r) for r in (NUMERIC[:3], POINTS))


def read_columns(
    names: Sequence[str],
    where: Callable[[int | None], str],
    ignore: str = 'name it "#{}" (with the quotes)',
) -> Columns:
    """What columns of these names hold; raises E105, E107 and E108.

    where: the location of one of the names, or of all.
    ignore: how to have a column ignored, with {} for its name.
    """
    indices: dict[str, int] = {}
    units: dict[str, str | None] = {}
    unknown: list[int] = []
    for i, name in enumerate(names):
        column = _column(name)
        if column is None:
            unknown.append(i)
        elif column[0] in indices:
            message = f"two columns for {column[0]}: {names[indices[column[0]]]} and {name}"
            help = "delete one of the two columns"
            raise InputError("E108", message, where=where(i), help=help)
        elif column[0] != _IGNORED:
            indices[column[0]], units[column[0]] = i, column[1]
    lengths = _require_poses(names, indices, unknown, where)
    if unknown:
        raise _unknown(names, unknown[0], where, ignore)
    for role in lengths[1:]:
        if units[role] != units[first := lengths[0]]:
            message = (
                f"{first} is in {units[first] or 'no unit'}, {role} in {units[role] or 'no unit'}"
            )
            one = "both columns" if len(lengths) == 2 else "all four columns"
            where_role = where(indices[role])
            raise InputError("E108", message, where=where_role, help=f"give {one} the same unit")
    return Columns(indices, units)


def _column(name: str) -> tuple[str, str | None] | None:
    """The role and the unit that a name states, or None if it is not known."""
    name = name.strip().lower()
    if name.startswith("#"):
        return _IGNORED, None
    if name in _BASES:
        return _BASES[name][0], None
    base, unit = _parts(name)
    role, units = _BASES.get(base, ("", {}))
    return (role, units[unit]) if unit in units else None


def _parts(name: str) -> tuple[str, str]:
    """The base and the unit in a name, both empty if it is not made of the two."""
    found = _NAME.fullmatch(name.strip().lower()) if len(name) < MAX_NAME_CHARACTERS else None
    return (found["base"], next(filter(None, found.groups()[1:]))) if found else ("", "")


def _require_poses(
    names: Sequence[str],
    indices: dict[str, int],
    unknown: list[int],
    where: Callable[[int | None], str],
) -> tuple[str, ...]:
    """The roles of lengths, if the columns make poses; raises E105 and E108."""
    points = [role for role in POINTS if role in indices]
    body = [role for role in NUMERIC[:3] if role in indices]
    if points and body:
        mixed = [names[indices[role]] for role in (body[0], points[0])]
        message = f"two forms of a pose: the columns {' and '.join(mixed)}"
        help = "keep x, y and the angle, or px, py, qx and qy, and delete the other columns"
        where_point = where(indices[points[0]])
        raise InputError("E108", message, where=where_point, help=help)
    needed = POINTS if points else NUMERIC[:3]
    if missing := [role for role in needed if role not in indices]:
        message = f"the header has no column for {' and '.join(missing)}"
        more = f" and {len(names) - MAX_NAMES} more" if len(names) > MAX_NAMES else ""
        why = f"it has: {', '.join(map(shown, names[:MAX_NAMES]))}{more}"
        help = (
            "name the columns x, y and angle_deg (or angle_rad), with commas, semicolons or tabs "
            "between them; x_mm and y_mm (um, mm, cm, m, in, ft) state the length unit"
        )
        if points:
            help = "name the columns px, py, qx and qy, for two points of the body"
        if of_unit := next(filter(None, (_units(names[i]) for i in unknown[:MAX_NAMES])), None):
            why += f"; {of_unit}"
        near = {names[i]: _nearest(names[i]) for i in unknown[:MAX_NAMES]}
        meant = {column[0] for name in near.values() if name and (column := _column(name))}
        if meant.issuperset(missing):
            edits = [f"`{name}` in place of {shown(old)}" for old, name in near.items() if name]
            help = f"write {' and '.join(edits)}"
        raise InputError("E105", message, where=where(None), why=why, help=help)
    return POINTS if points else NUMERIC[:2]


def _nearest(name: str) -> str | None:
    """The known name that a name with a slip in it may stand for; its unit stays as it is."""
    from difflib import get_close_matches

    found = re.match(r"[^\W\d_]+", name.strip().lower())
    if not found or found[0] in _BASES or len(name) >= MAX_NAME_CHARACTERS:
        return None
    for base in get_close_matches(found[0], _BASES, 1, 0.7):
        if _column(near := base + name.strip().lower()[found.end() :]):
            return near
    return None


def _units(name: str) -> str | None:
    """The units that a known column may have, if it has another."""
    base, _ = _parts(name)
    units = _BASES.get(base, ("", {}))[1]
    return f"the units of {base} are {', '.join(dict.fromkeys(units.values()))}" if units else None


def _unknown(
    names: Sequence[str], i: int, where: Callable[[int | None], str], ignore: str
) -> InputError:
    """E107, for a column that is neither known nor to be ignored."""
    name = names[i].strip().replace('"', "")
    message = f"the column {shown(name.lower())} is not known"
    why = _units(name) or _KNOWN
    if not name:
        message = "a column has no name"
    edit = brief(ignore.format(name), "begin its name with # (and put it in quotes)")
    help = f"delete the column, or {edit} to have it ignored"
    if near := _nearest(name):
        help = f"write `{near}` if that is what it is; otherwise {help}"
    return InputError("E107", message, where=where(i), why=why, help=help)
