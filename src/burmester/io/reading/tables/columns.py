"""Columns by the names that people give them: what stands in each, and in which unit.

`column_words` holds the names: x, y and an angle (without it: points of the body, at any angle), or
two points of the body (px, py, qx, qy); weight; exact; name.  A column of numbers, such as `Nr.`,
holds the names where no other does.
Times, frames and remarks are passed over, and so is what begins with #.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import DIRECTION, NUMERIC, PAIR, POINTS, brief, shown
from burmester.io.reading.stated_tolerances import TOLERANCE_ROLES
from burmester.io.reading.tables.column_words import (
    IGNORED,
    MAX_NAME_CHARACTERS,
    WORDS,
    Word,
    known,
)
from burmester.wording import in_unit, listed, shortened

_WITH_DIRECTION = (*NUMERIC[:2], *DIRECTION)
_PASSED_OVER = ("time", "frame", "remark")
_PLAIN = re.compile(r"#?\w{1,30}")
MAX_NAMES = 12  # names of columns that an error lists, or compares with known ones
MOST_TYPED = 20  # names of columns that an option is told with
_KNOWN = (
    "the known names are x, y (or x_mm, y_mm and so on), angle_deg, angle_rad (or cos and sin of "
    "the angle), weight, exact, name and crank_deg, tol_x, tol_y, tol_angle, tol_axes and free, or "
    "px, py, qx, qy in place of x, y and the angle"
)


class Columns(NamedTuple):
    """What the names of columns say."""

    indices: dict[str, int]  # role -> index in a row
    units: dict[str, str | None]  # role -> unit
    numbered: bool = False  # whether the names are a column of numbers
    passed_over: tuple[str, ...] = ()  # the names of columns that are known and not used

    def row_names(self, names: list[str]) -> list[str]:
        """The names of the rows; none where they are empty, or the numbers 1 to N."""
        counted = names == [str(k + 1) for k in range(len(names))]
        return [] if self.numbered and (counted or not any(names)) else names

    def described(self, names: Sequence[str], *, named: bool = True) -> str:
        """Which column gives what: "x from `X [mm]`, y from `Y [mm]` and angle_deg".

        named: whether the rows have names.
        """
        parts = []
        roles = [role for role in self.indices if named or role != "name"]
        for role in sorted(roles, key=self.indices.__getitem__):
            index = self.indices[role]
            name = names[index].strip()
            same = f"{name.lower()}_".startswith(f"{role}_")
            parts.append(name if same else f"{role} from `{name}`")
        return listed(parts)

    def notes(self) -> tuple[Advice, ...]:
        """W213, for what is passed over without having been asked for."""
        if not self.passed_over:
            return ()
        which = shortened([f"`{name.strip()}`" for name in self.passed_over], MAX_NAMES, "more")
        many = len(self.passed_over) > 1
        return (
            Advice(
                "W213",
                f"the column{'s' * many} {listed(which)} {'are' if many else 'is'} passed over",
                f"begin {'their names' if many else 'its name'} with # to have nothing said",
                "times, frames, remarks and second numbers say nothing about a pose",
            ),
        )

    @property
    def may_be_free(self) -> bool:
        """Whether a blank cell may stand for a free component of a pose."""
        return not self.indices.keys().isdisjoint((*TOLERANCE_ROLES, "free", "tol_axes"))

    @property
    def angle_unit(self) -> str | None:
        """The unit of the angles, as `Rows` holds them."""
        return "rad" if "cos" in self.indices else self.units.get("angle")

    @property
    def length_unit(self) -> str | None:
        return self.units["px" if "px" in self.units else "x"]


def is_header(names: Sequence[str]) -> bool:
    """Whether all these are names of columns, and of enough for a pose, a point or a pair."""
    words = list(map(_known, names))
    return None not in words and _have(words, NUMERIC[:2], POINTS, PAIR)


def has_poses(names: Sequence[str]) -> bool:
    """Whether enough of these are names of columns for a pose, whatever the others are."""
    return _have(map(_known, names[:1000]), NUMERIC[:3], _WITH_DIRECTION, POINTS)


def has_pairs(names: Sequence[str]) -> bool:
    """Whether these are the columns of a function's pairs, whatever is wrong with them."""
    return _have(map(_known, names[:1000]), PAIR[1:]) and not has_poses(names)


def _have(words: Iterable[Word | None], *some: tuple[str, ...]) -> bool:
    """Whether all of some roles are there."""
    roles = {word.role for word in words if word}
    return any(roles.issuperset(needed) for needed in some)


def _known(name: str) -> Word | None:
    """What a name says, None too if its unit is none of its role's."""
    word = known(name)
    return None if word is None or word.unit == "?" else word


def read_columns(
    names: Sequence[str],
    where: Callable[[int | None], str],
    ignore: str = 'name it "#{}" (with the quotes)',
    *,
    may_be_named: bool = False,
) -> Columns:
    """What columns of these names hold; raises E105, E107 and E108.

    where: the location of one of the names, or of all.
    ignore: how to have a column ignored, with {} for its name.
    may_be_named: whether --columns may name them.
    """
    indices: dict[str, int] = {}
    units: dict[str, str | None] = {}
    unknown: list[int] = []
    passed_over: list[str] = []
    for i, name in enumerate(names):
        word = _known(name)
        if word is None:
            unknown.append(i)
        elif word.role in _PASSED_OVER or (word.role == "number" and "number" in indices):
            passed_over.append(name)
        elif word.role in indices:
            message = f"two columns for {word.role}: {names[indices[word.role]]} and {name}"
            help = "delete one of the two columns"
            raise InputError("E108", message, where=where(i), help=help)
        elif word.role != IGNORED:
            indices[word.role], units[word.role] = i, word.unit
    option = _named(names, indices, unknown) if may_be_named else None
    lengths = _require_poses(names, indices, unknown, where, option)
    unknown += [indices["output"]] if lengths and "output" in indices else []  # of pairs alone
    if unknown:
        raise _unknown(names, unknown[0], where, ignore)
    tolerances = [role for role in TOLERANCE_ROLES[:2] if units.get(role) is not None]
    for role in (*lengths[1:], *tolerances):
        if units[role] != units[first := lengths[0]]:
            message = (
                f"{first} is{in_unit(units[first] or 'no unit')}, "
                f"{role}{in_unit(units[role] or 'no unit')}"
            )
            one = "both columns" if len(lengths) == 2 else "all four columns"
            if role in tolerances:
                one = "tolerances and positions"
            where_role = where(indices[role])
            raise InputError("E108", message, where=where_role, help=f"give {one} the same unit")
    numbers = indices.pop("number", None)
    numbered = numbers is not None and "name" not in indices
    if numbers is not None and numbered:
        indices["name"], units["name"] = numbers, None
    elif numbers is not None:
        passed_over.append(names[numbers])
    return Columns(indices, units, numbered, tuple(passed_over))


def _require_poses(
    names: Sequence[str],
    indices: dict[str, int],
    unknown: list[int],
    where: Callable[[int | None], str],
    option: str | None,
) -> tuple[str, ...]:
    """The roles of lengths, if the columns make poses; raises E105 and E108."""
    points = [role for role in POINTS if role in indices]
    direction = [role for role in DIRECTION if role in indices]
    if direction and "angle" in indices:
        index = indices[direction[0]]
        message = f"the angle is given twice: {names[indices['angle']]} and {names[index]}"
        help = "keep the angle, or its columns cos and sin, and delete the other"
        raise InputError("E108", message, where=where(index), help=help)
    body = [role for role in (*NUMERIC[:3], *DIRECTION) if role in indices]
    if points and body:
        mixed = [names[indices[role]] for role in (body[0], points[0])]
        message = f"two forms of a pose: the columns {' and '.join(mixed)}"
        help = "keep x, y and the angle, or px, py, qx and qy, and delete the other columns"
        where_point = where(indices[points[0]])
        raise InputError("E108", message, where=where_point, help=help)
    absent = [role for role in PAIR if role not in indices]
    if not (points or body or unknown) and len(absent) < len(PAIR):
        if absent:
            end = "input" if absent == ["crank"] else "output"
            message = f"the column of the {end} is missing"
            help = f"add a column {end}_deg with the angles of the {end} link"
            raise InputError("E105", message, where=where(None), help=help)
        return ()
    needed = POINTS if points else _WITH_DIRECTION if direction else NUMERIC[:3]
    missing = [role for role in needed if role not in indices]
    if missing == ["angle"] and not unknown:
        return NUMERIC[:2]
    if missing:
        message = f"the header has no column for {listed(missing)}"
        more = f" and {len(names) - MAX_NAMES} more" if len(names) > MAX_NAMES else ""
        why = f"it has: {', '.join(map(shown, names[:MAX_NAMES]))}{more}"
        help = (
            "name the columns x, y and angle_deg (or angle_rad), with commas, semicolons or tabs "
            "between them; x_mm and y_mm (um, mm, cm, m, in, ft) state the length unit"
        )
        if points:
            help = "name the columns px, py, qx and qy, for two points of the body"
        else:
            if direction:
                help = "name the columns x, y, cos and sin, for the cosine and sine of the angle"
            help += "; `burmester explain E105` lists the names that are understood"
            help = f"pass {option} if that is their order, or {help}" if option else help
        if of_unit := next(filter(None, (_units(names[i]) for i in unknown[:MAX_NAMES])), None):
            why += f"; {of_unit}"
        near = {names[i]: _nearest(names[i]) for i in unknown[:MAX_NAMES]}
        meant = {word.role for name in near.values() if name and (word := _known(name))}
        if meant.issuperset(missing):
            edits = [f"`{name}` in place of {shown(old)}" for old, name in near.items() if name]
            help = f"write {' and '.join(edits)}"
        raise InputError("E105", message, where=where(None), why=why, help=help)
    return POINTS if points else NUMERIC[:2]


def _named(names: Sequence[str], indices: dict[str, int], unknown: list[int]) -> str | None:
    """--columns with names for what is unknown, in the order of missing roles; None if too long."""
    if len(names) > MOST_TYPED:
        return None
    missing = iter([role for role in ("x", "y", "angle_deg") if role.split("_")[0] not in indices])
    known = {names[index].strip() for role, index in indices.items() if role != "number"}
    given = [
        next(missing, f"#{i + 1}") if i in unknown else name if name in known else f"#{i + 1}"
        for i, name in enumerate(map(str.strip, names))
    ]
    good = {*POINTS, *DIRECTION}.isdisjoint(indices) and all(map(_PLAIN.fullmatch, given))
    text = f'"{",".join(given)}"' if "#" in "".join(given) else ",".join(given)
    return f"--columns {text}" if good and not next(missing, None) else None


def _nearest(name: str) -> str | None:
    """The known name that a name with a slip in it may stand for; its unit stays as it is."""
    from difflib import get_close_matches

    found = re.match(r"[^\W\d_]+", name.strip().lower())
    if not found or len(name) >= MAX_NAME_CHARACTERS or known(name):
        return None
    rest = name.strip().lower()[found.end() :]
    words = {word.lower(): None for text in WORDS.values() for word in text.split(", ")}
    for base in get_close_matches(found[0], words, 3, 0.7):
        if base != found[0] and _known(base + rest):
            return base + rest
    return None


def _units(name: str) -> str | None:
    """The units that a known column may have, if it has another."""
    word = known(name)
    if word is None or word.unit != "?":
        return None
    return f"the units of {word.word} are {', '.join(word.units)}"


def _unknown(
    names: Sequence[str], i: int, where: Callable[[int | None], str], ignore: str
) -> InputError:
    """E107, for a column that is neither known nor to be ignored."""
    name = names[i].strip().replace('"', "")
    message = f"the column {shown(name.lower())} is not known"
    why = _units(name) or _KNOWN
    edit = brief(ignore.format(name), "begin its name with # (and put it in quotes)")
    help = f"delete the column, or {edit} to have it ignored"
    if near := _nearest(name):
        help = f"write `{near}` if that is what it is; otherwise {help}"
    return InputError("E107", message, where=where(i), why=why, help=help)
