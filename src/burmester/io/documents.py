"""Tasks in JSON and TOML: trees of one shape, whose numbers keep the digits they are printed with.

At the top of a task other keys may stand (title, author, notes ...) and are not looked at, unless
they are known ones misspelt or belong elsewhere.  The errors are those that `burmester.io.poses`
lists.
"""

from __future__ import annotations

import functools
import json
import math
import operator
import re
import tomllib
from collections.abc import Callable, Iterable
from decimal import Decimal, InvalidOperation
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from burmester.errors import InputError
from burmester.io.asked import REQUIREMENT_KEYS
from burmester.io.places import Document, meant, repeated
from burmester.io.table import NUMERIC, POINTS, PoseTable, Rows, Source, shown
from burmester.io.wanted import LIMIT_KEYS, TOP_KEYS, Wanted

if TYPE_CHECKING:
    from pydantic import BaseModel

__all__ = ["read_json", "read_toml"]

_ANGLE_KEYS = {"angle": None, "angle_deg": "deg", "angle_rad": "rad"}
_POINT_KEYS = {"p": ("px", "py"), "q": ("qx", "qy")}
_PLACE_KEYS = frozenset({"x", "y", *_ANGLE_KEYS})
_TRACKED_KEYS = frozenset({*_POINT_KEYS, *POINTS})

_ELSEWHERE = {  # what may be met beside the poses by mistake, and where it belongs
    **dict.fromkeys(("weight", "weights"), "write each weight into its pose, as weight"),
    **dict.fromkeys(("names",), "write each name into its pose, as name"),
    **dict.fromkeys(
        ("x", "y", "angle", "angles", "angle_deg", "angle_rad", *_POINT_KEYS, *POINTS),
        "write the numbers into the poses, one by one",
    ),
    **dict.fromkeys(("unit", "units"), "say angle_unit for angles, length_unit for lengths"),
    **dict.fromkeys(("sigma",), "say pose_sigma, with position and angle_deg in it"),
}


def read_json(source: Source) -> PoseTable:
    """A list of poses, an object with "poses", or what `--json` prints; raises E103 to E110."""

    def refuse(constant: str) -> Any:
        tokens = re.finditer(r'"(?:[^"\\]|\\.)*+"|-?Infinity|NaN', source.text)
        start = next(token.start() for token in tokens if token[0][0] != '"')
        where, help = source.where(start, len(constant)), "give a number, or delete the pose"
        raise InputError("E103", f"{constant} is not a finite number", where=where, help=help)

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        tree = dict(pairs)
        if len(tree) < len(pairs):
            raise _twice(source, pairs)
        return tree

    parse = functools.partial(
        json.loads,
        parse_float=_exact,
        parse_int=_exact,
        parse_constant=refuse,
        object_pairs_hook=once,
    )
    tree = _tree(Document(source, "JSON"), parse)
    return _table(
        Document(source, "JSON"), tree, '{"angle_unit": "deg", "poses": [[0.5, 2, 30], ...]}'
    )


def read_toml(source: Source) -> PoseTable:
    """`poses = [[x, y, angle], ...]` or tables `[[poses]]`; raises E103 to E110."""
    document = Document(source, "TOML")
    tree = _tree(document, functools.partial(tomllib.loads, parse_float=_exact))
    return _table(document, tree, 'angle_unit = "deg" above poses = [[0.5, 2, 30], ...]')


def _tree(document: Document, parse: Callable[[str], Any]) -> Any:
    """What a parser makes of a text, or E109."""
    source, language = document.source, document.language
    at: int | None = None
    said = ""
    try:
        return parse(source.text)
    except RecursionError:
        pass
    except json.JSONDecodeError as error:
        at, said = error.pos, error.msg
    except ValueError as error:
        said, _, place = str(error).partition(" (at")
        at = len(source.text)
        if found := re.fullmatch(r" line (\d+), column (\d+)\)", place):
            before = source.text.split("\n")[: int(found[1]) - 1]
            at = sum(len(line) + 1 for line in before) + int(found[2]) - 1
        elif not place:  # an integer of more digits than Python reads, in TOML
            raise _too_long(source, said) from None
    from burmester.io.slips import slip

    found_slip = slip(language, source.text, at, said)
    raise InputError(
        "E109",
        f"this is not {language}",
        where=source.where(found_slip.start, found_slip.width),
        why=found_slip.why,
        help=found_slip.help,
    )


def _too_long(source: Source, said: str) -> InputError:
    """E103, for an integer of more digits than are read."""
    from burmester.io.slips import long_integer

    start, end = long_integer(source.text) or (0, 1)
    message = f"a number of {end - start} digits is not a finite number"
    why = f"{source.text[start : start + 10]}... is beyond 1.8e308, the largest number there is"
    help = "give a number, or delete the pose"
    return InputError("E103", message, where=source.where(start, end - start), why=why, help=help)


def _exact(number: str) -> Decimal:
    """A number with the decimals it is printed with, which a float would forget."""
    try:
        return Decimal(number)
    except InvalidOperation:  # its exponent has twenty digits
        return Decimal(float(number))


def _twice(source: Source, pairs: list[tuple[str, Any]]) -> InputError:
    """E108, for an object of JSON in which a key stands twice."""
    known: set[str] = set()
    key = next(key for key, _ in pairs if key in known or known.add(key))  # type: ignore[func-returns-value]
    where, why = None, None
    if found := repeated(source.text):
        (first, _), (start, end) = found
        where = source.where(start, end - start)
        line = source.text.count("\n", 0, first) + 1
        column = first - source.text.rfind("\n", 0, first)
        why = f"it stands at line {line}, column {column} already"
    message = f"the key {shown(key)} stands twice in one object"
    return InputError("E108", message, where=where, why=why, help="delete one of the two")


@functools.cache
def _model(tracked: bool) -> type[BaseModel]:
    """What may stand in a tree; made on first use, as pydantic is slow to import.

    tracked: whether the poses are two points each, in place of x, y and an angle.
    """
    from pydantic import BaseModel, ConfigDict, Field, model_validator

    from burmester.io.limits_tree import Number

    class Common(BaseModel):
        model_config = ConfigDict(strict=True, str_strip_whitespace=True, extra="forbid")
        weight: Decimal | None = None
        name: str | None = None
        exact: bool | None = None

        @model_validator(mode="before")
        @classmethod
        def take_lists(cls, pose: Any) -> Any:
            """[x, y, angle] as an object, and the integers of TOML as Decimal."""
            if isinstance(pose, list) and len(pose) == 3 and not tracked:
                pose = dict(zip(NUMERIC, pose, strict=False))
            if not isinstance(pose, dict):
                return pose
            if tracked:
                return {key: _decimal(value) for key, value in pose.items()}
            return {k: Decimal(v) if type(v) is int else v for k, v in pose.items()}

    class Pose(Common):
        x: Decimal
        y: Decimal
        angle: Decimal | None = None
        angle_deg: Decimal | None = None
        angle_rad: Decimal | None = None

    Point = Annotated[list[Decimal], Field(min_length=2, max_length=2)]

    class Tracked(Common):
        px: Decimal | None = None
        py: Decimal | None = None
        qx: Decimal | None = None
        qy: Decimal | None = None
        p: Point | None = None
        q: Point | None = None

    Sigma = Annotated[Number, Field(ge=0)]

    class PoseSigma(BaseModel):
        model_config = ConfigDict(extra="forbid")
        position: Sigma
        angle_deg: Sigma

    class Whole(BaseModel):
        model_config = ConfigDict(strict=True, str_strip_whitespace=True)
        poses: list[Tracked] if tracked else list[Pose]  # type: ignore[valid-type]
        pose_sigma: PoseSigma | None = None
        angle_unit: Literal["deg", "rad"] | None = None
        length_unit: str | None = None

    return Whole


def _decimal(value: Any) -> Any:
    """An integer of TOML, or those of a point, as Decimal."""
    if type(value) is int:
        return Decimal(value)
    return [_decimal(each) for each in value] if isinstance(value, list) else value


def _table(document: Document, tree: Any, example: str) -> PoseTable:
    """The table in a parsed tree, whose numbers are Decimal (or int, in TOML)."""
    from pydantic import ValidationError

    if isinstance(tree, list):
        tree, document = {"poses": tree}, document._replace(bare=True)
    elif isinstance(tree, dict) and "poses" not in tree and isinstance(tree.get("task"), dict):
        tree, document = tree["task"], document._replace(root=("task",))
    wanted = Wanted()
    if isinstance(tree, dict):
        _require_known(document, tree)
        if not tree.keys().isdisjoint(LIMIT_KEYS):
            from burmester.io.limits_tree import read

            wanted = read(tree, document)
        if not tree.keys().isdisjoint(REQUIREMENT_KEYS):
            from burmester.io.requirements_tree import read as read_requirements

            wanted = wanted._replace(asked=read_requirements(tree, document))
    tracked = _tracked(document, tree)
    try:
        whole: Any = _model(tracked).model_validate(tree)
    except ValidationError as error:
        faults: Any = error.errors(include_url=False)
        raise _unfit(document, tree, example, tracked, faults[0]) from None
    poses = whole.poses
    unit: str | None = None
    if tracked:
        columns, where = _points(document, poses), ""
    else:
        angles, unit = _angles(document, whole)
        columns = {"x": [str(pose.x) for pose in poses], "y": [str(pose.y) for pose in poses]}
        columns["angle"] = [str(angle) for angle in angles]
        where = _where_unit(document, whole)
    if any(pose.weight is not None for pose in poses):  # a pose without one counts once
        columns["weight"] = ["1" if pose.weight is None else str(pose.weight) for pose in poses]
    numeric = list(columns)
    if any(pose.name is not None for pose in poses):
        columns["name"] = [pose.name or "" for pose in poses]
    if any(pose.exact for pose in poses):
        columns["exact"] = ["x" if pose.exact else "" for pose in poses]
    rows = Rows.read(columns)
    for i, j in np.argwhere(~np.isfinite(rows.values)):  # 1e400 is a finite Decimal
        number = columns[numeric[j]][i]
        fault = {"type": "finite_number", "loc": ("poses", int(i), numeric[j]), "input": number}
        raise _unfit(document, tree, example, tracked, fault)
    given = whole.pose_sigma
    return PoseTable(
        rows,
        length_unit=whole.length_unit or None,
        angle_unit=unit,
        where=where,
        say_unit=f"write {example}",
        wanted=wanted,
        sigma=given and (given.position, math.radians(given.angle_deg)),
        place=lambda row: document.where("poses", row),
    )


def _require_known(document: Document, tree: dict[str, Any]) -> None:
    """Refuse what stands beside the poses and is misspelt, or belongs elsewhere."""
    for key in tree:
        if key in TOP_KEYS or key in LIMIT_KEYS or key in REQUIREMENT_KEYS:
            continue
        if key in _ELSEWHERE:
            message = f"{document.named(key)} stands beside the poses, where it says nothing"
            help = f"{_ELSEWHERE[key]}, or delete it"
        elif near := meant(key, TOP_KEYS):
            message, help = f"{document.named(key)} is not known", f"write {near} in its place"
        else:
            continue
        raise InputError("E107", message, where=document.where(key, key=True), help=help)


def _tracked(document: Document, tree: Any) -> bool:
    """Whether the poses are two points each; raises E108 where some are and some are not."""
    poses = tree.get("poses") if isinstance(tree, dict) else None
    form: tuple[str, int] | None = None
    for i, pose in enumerate(poses if isinstance(poses, list) else ()):
        if isinstance(pose, dict):
            points, place = (sorted(keys & pose.keys()) for keys in (_TRACKED_KEYS, _PLACE_KEYS))
            if points and place:
                message = f"pose {i + 1} has {' and '.join((points[0], place[0]))}"
                raise _two_forms(document, message, i, place[0])
            given = "points" if points else "place" if place else ""
        else:
            given = "place" if isinstance(pose, list) and len(pose) == 3 else ""
        if given and form and form[0] != given:
            first, last = ("two points", "x, y and an angle")[:: 1 if given == "place" else -1]
            message = f"pose {form[1] + 1} is {first}, pose {i + 1} is {last}"
            raise _two_forms(document, message, i)
        form = form or ((given, i) if given else None)
    return form is not None and form[0] == "points"


def _two_forms(document: Document, message: str, pose: int, key: str | None = None) -> InputError:
    path: tuple[str | int, ...] = ("poses", pose, *([key] if key else []))
    where = document.where(*path, key=key is not None)
    why = "a pose is given by x, y and an angle, or by two points p and q of the body"
    return InputError("E108", message, where=where, why=why, help="give all poses in one way")


def _points(document: Document, poses: list[Any]) -> dict[str, list[str]]:
    """The columns px, py, qx and qy; raises E105 and E108 where a point is not said once."""
    columns: dict[str, list[str]] = {role: [] for role in POINTS}
    for i, pose in enumerate(poses):
        for point, roles in _POINT_KEYS.items():
            pair = getattr(pose, point)
            single = {role: getattr(pose, role) for role in roles}
            given = [role for role, value in single.items() if value is not None]
            if pair is not None and given:
                message = f"pose {i + 1} has {point} and {given[0]}"
                where = document.where("poses", i, given[0], key=True)
                raise InputError(
                    "E108", message, where=where, help=f"delete {given[0]}, or {point}"
                )
            if pair is None and len(given) < 2:
                lacking = next((role for role in roles if given and role not in given), point)
                message = f"{document.named('poses', i, lacking)} is missing"
                x, y = roles
                help = f"give {x} and {y}, or {point} with two numbers in brackets"
                where = document.where("poses", i)
                raise InputError("E105", message, where=where, help=help)
            for role, value in zip(roles, pair or single.values(), strict=True):
                columns[role].append(str(value))
    return columns


def _where_unit(document: Document, whole: Any) -> str:
    """Where the angles' unit is stated, or should be."""
    if whole.angle_unit:
        return document.where("angle_unit")
    for key in ("angle_deg", "angle_rad"):
        if whole.poses and getattr(whole.poses[0], key) is not None:
            return document.where("poses", 0, key, key=True)
    return document.where("poses", key=True)


def _angles(document: Document, whole: Any) -> tuple[list[Decimal], str | None]:
    """The angles and their unit, if every pose has one angle and all are in one unit."""
    units = {whole.angle_unit} - {None}
    angles = []
    for i, pose in enumerate(whole.poses):
        given = [key for key in _ANGLE_KEYS if getattr(pose, key) is not None]
        if len(given) != 1:
            code = "E108" if given else "E105"
            message = f"pose {i + 1} has {' and '.join(given) or 'no angle'}"
            help = "give every pose one angle, as angle_deg or as angle_rad"
            where = document.where("poses", i)
            if given:
                where = document.where("poses", i, given[1], key=True)
            raise InputError(code, message, where=where, help=help)
        angles.append(getattr(pose, given[0]))
        units.add(_ANGLE_KEYS[given[0]] or whole.angle_unit)
        if len(units) > 1:
            message = "the angles are stated in different units"
            why = None
            if whole.angle_unit:
                why = f'angle_unit is "{whole.angle_unit}", pose {i + 1} has {given[0]}'
            elif i:
                why = f"pose {i + 1} has {given[0]}, the pose before has not"
            help = "state one unit: angle_deg in every pose, or angle_rad in every pose"
            keyed = {"key": True} if isinstance(_ANGLE_KEYS[given[0]], str) else {}
            where = document.where("poses", i, *([given[0]] if keyed else []), **keyed)
            raise InputError("E110", message, where=where, why=why, help=help)
    return angles, next(iter(units), None)


def _unfit(document: Document, tree: Any, example: str, tracked: bool, fault: Any) -> InputError:
    """A fault that pydantic found, in this house's words."""
    loc, given, kind = fault["loc"], fault.get("input"), fault["type"]
    if kind == "string_unicode" and document.is_key(given, *_as_written(tree, loc)):
        loc, kind = (*loc, given), "extra_forbidden"
    path = _as_written(tree, loc)
    name = document.named(*(loc if len(path) == len(loc) else path))
    value = document.shown(given, *path)
    known = "x, y, angle_deg or angle_rad (or angle, with angle_unit), weight, exact and name"
    if tracked:
        known = "px, py, qx and qy (or p and q with two numbers each), weight, exact and name"
    number = "write a number without quotes, with a point for its decimal mark"
    code, message, help = {
        "finite_number": ("E103", "is not a finite number", "give a number, or delete the pose"),
        "is_instance_of": ("E104", f"is {value}, not a number", number),
        "no_number": ("E104", f"is {value}, not a number", number),
        "bool_type": ("E104", f"is {value}, neither true nor false", "write true or false"),
        "string_unicode": ("E104", f"is {value}, no text", "write it in plain letters"),
        "string_type": ("E104", f"is {value}, not a text in quotes", "write a text in quotes"),
        "greater_than_equal": ("E104", "is below zero", "give 0 or more"),
        "too_short": ("E106", f"has {value}, not two numbers", "give two numbers, [X, Y]"),
        "too_long": ("E106", f"has {value}, not two numbers", "give two numbers, [X, Y]"),
        "missing": ("E105", "is missing", f"write {example}"),
        "extra_forbidden": ("E107", "is not known", f"delete it; a pose has {known}"),
        "literal_error": ("E110", f"is {value}, not an angle unit", 'write "deg" or "rad"'),
    }.get(kind, ("E104", f"does not fit: {value}", f"write {example}"))
    why = None
    if kind == "finite_number" and re.match(r"[-+]?\d", value):
        why = f"{value} is beyond 1.8e308, the largest number there is"
    if kind == "missing" and loc[:1] == ("poses",) and len(loc) > 1:
        help = f"write it into the pose; a pose has {known}"
    if kind == "missing" and loc[:1] == ("pose_sigma",):
        help = "give pose_sigma both, position and angle_deg"
    if kind == "extra_forbidden" and len(loc) == 1:
        help = "delete it"
    elif kind == "extra_forbidden" and loc[0] == "poses":
        keys = (*POINTS, *_POINT_KEYS) if tracked else (*_PLACE_KEYS,)
        if near := meant(str(loc[-1]), (*keys, "weight", "exact", "name")):
            help = f"write {near} in its place; a pose has {known}"
    elif kind == "extra_forbidden":
        help = "delete it; pose_sigma has position and angle_deg"
    if kind == "model_type" and isinstance(given, list):
        code, message = "E106", f"has {len(given)} number{'s' * (len(given) != 1)}, not 3"
        help = "write [x, y, angle], with a point for the decimal mark of a number"
        if len(given) > 3:
            why = "a comma parts the numbers, and is no decimal mark"
    path = path[:-1] if kind == "missing" else path
    where = document.where(*path, key=kind == "extra_forbidden")
    return InputError(code, f"{name} {message}", where=where, why=why, help=help)


def _as_written(tree: Any, path: Iterable[str | int]) -> tuple[str | int, ...]:
    """A path in which x, y and angle of a list are 0, 1 and 2, and qy is q[1] where there is q."""
    out: list[str | int] = []
    for key in path:
        steps: tuple[str | int, ...] = (key,)
        if isinstance(tree, list) and key in NUMERIC:
            steps = (NUMERIC.index(str(key)),)
        elif isinstance(tree, dict) and key in POINTS and key not in tree:
            steps = (str(key)[0], "xy".index(str(key)[1]))
        out += steps
        try:
            tree = functools.reduce(operator.getitem, steps, tree)
        except (LookupError, TypeError):
            tree = None
    return tuple(out)
