"""Poses in JSON and TOML: trees of one shape, whose numbers keep the digits they are printed with.

The errors are those that `burmester.io.poses` lists.
"""

from __future__ import annotations

import functools
import json
import math
import re
import tomllib
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from burmester.errors import InputError
from burmester.io.asked import REQUIREMENT_KEYS
from burmester.io.table import NUMERIC, PoseTable, Rows, Source, shown
from burmester.io.wanted import LIMIT_KEYS, Wanted

if TYPE_CHECKING:
    from pydantic import BaseModel

__all__ = ["read_json", "read_toml"]

_ANGLE_KEYS = {"angle": None, "angle_deg": "deg", "angle_rad": "rad"}


def read_json(source: Source) -> PoseTable:
    """A list of poses, an object with "poses", or what `--json` prints; raises E103 to E110."""

    def refuse(constant: str) -> Any:
        tokens = re.finditer(r'"(?:[^"\\]|\\.)*+"|-?Infinity|NaN', source.text)
        start = next(token.start() for token in tokens if token[0][0] != '"')
        where, help = source.where(start, len(constant)), "give a number, or delete the pose"
        raise InputError("E103", f"{constant} is not a finite number", where=where, help=help)

    parse = functools.partial(
        json.loads,
        parse_float=_exact,
        parse_int=_exact,
        parse_constant=refuse,
        object_pairs_hook=_once,
    )
    tree = _tree("JSON", source, parse)
    return _table(source.label, tree, '{"angle_unit": "deg", "poses": [[0.5, 2, 30], ...]}')


def read_toml(source: Source) -> PoseTable:
    """`poses = [[x, y, angle], ...]` or tables `[[poses]]`; raises E103 to E110."""
    tree = _tree("TOML", source, functools.partial(tomllib.loads, parse_float=_exact))
    return _table(source.label, tree, 'angle_unit = "deg" above poses = [[0.5, 2, 30], ...]')


def _tree(language: str, source: Source, parse: Callable[[str], Any]) -> Any:
    """What a parser makes of a text, or E109."""
    where = source.label
    try:
        return parse(source.text)
    except RecursionError:
        why = "too many brackets inside each other"
    except json.JSONDecodeError as error:
        why, where = error.msg, source.where(error.pos)
    except ValueError as error:
        why, _, place = str(error).partition(" (at")
        if found := re.fullmatch(r" line (\d+), column (\d+)\)", place):
            before = source.text.split("\n")[: int(found[1]) - 1]
            where = source.where(sum(len(line) + 1 for line in before) + int(found[2]) - 1)
    help = f"correct the {language}, or save the poses as CSV"
    raise InputError("E109", f"this is not {language}", where=where, why=why, help=help)


def _exact(number: str) -> Decimal:
    """A number with the decimals it is printed with, which a float would forget."""
    try:
        return Decimal(number)
    except InvalidOperation:  # its exponent has twenty digits
        return Decimal(float(number))


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object in which no key stands twice."""
    tree: dict[str, Any] = {}
    for key, value in pairs:
        if key in tree:
            message = f"the key {shown(key)} stands twice in one object"
            raise InputError("E108", message, help="delete one of the two")
        tree[key] = value
    return tree


@functools.cache
def _model() -> type[BaseModel]:
    """What may stand in a tree; made on first use, as pydantic is slow to import."""
    from pydantic import BaseModel, ConfigDict, Field, model_validator

    class Pose(BaseModel):
        model_config = ConfigDict(strict=True, str_strip_whitespace=True, extra="forbid")
        x: Decimal
        y: Decimal
        angle: Decimal | None = None
        angle_deg: Decimal | None = None
        angle_rad: Decimal | None = None
        weight: Decimal | None = None
        name: str | None = None
        exact: bool | None = None

        @model_validator(mode="before")
        @classmethod
        def take_lists(cls, pose: Any) -> Any:
            """[x, y, angle] as an object, and the integers of TOML as Decimal."""
            if isinstance(pose, list) and len(pose) == 3:
                pose = dict(zip(NUMERIC, pose, strict=False))
            if not isinstance(pose, dict):
                return pose
            return {k: Decimal(v) if type(v) is int else v for k, v in pose.items()}

    class PoseSigma(BaseModel):
        model_config = ConfigDict(extra="forbid")
        position: Annotated[float, Field(ge=0, allow_inf_nan=False)]
        angle_deg: Annotated[float, Field(ge=0, allow_inf_nan=False)]

    class Document(BaseModel):
        model_config = ConfigDict(strict=True, str_strip_whitespace=True)
        poses: list[Pose]
        pose_sigma: PoseSigma | None = None
        angle_unit: Literal["deg", "rad"] | None = None
        length_unit: str | None = None

    return Document


def _table(label: str, tree: Any, example: str) -> PoseTable:
    """The table in a parsed tree, whose numbers are Decimal (or int, in TOML)."""
    from pydantic import ValidationError

    tree = {"poses": tree} if isinstance(tree, list) else tree
    path = f"{label}: "
    if isinstance(tree, dict) and "poses" not in tree and isinstance(tree.get("task"), dict):
        tree, path = tree["task"], f"{label}: task."
    wanted = Wanted()
    if isinstance(tree, dict) and not tree.keys().isdisjoint(LIMIT_KEYS):
        from burmester.io.limits_tree import read

        wanted = read(tree, path)
    if isinstance(tree, dict) and not tree.keys().isdisjoint(REQUIREMENT_KEYS):
        from burmester.io.requirements_tree import read as read_requirements

        wanted = wanted._replace(asked=read_requirements(tree, path))
    try:
        document: Any = _model().model_validate(tree)
    except ValidationError as error:
        raise _unfit(path, example, error.errors(include_url=False)[0]) from None
    poses = document.poses
    angles, unit = _angles(document, path)
    columns = {"x": [str(pose.x) for pose in poses], "y": [str(pose.y) for pose in poses]}
    columns["angle"] = [str(angle) for angle in angles]
    if any(pose.weight is not None for pose in poses):  # a pose without one counts once
        columns["weight"] = ["1" if pose.weight is None else str(pose.weight) for pose in poses]
    if any(pose.name is not None for pose in poses):
        columns["name"] = [pose.name or "" for pose in poses]
    if any(pose.exact for pose in poses):
        columns["exact"] = ["x" if pose.exact else "" for pose in poses]
    rows = Rows.read(columns)
    for i, j in np.argwhere(~np.isfinite(rows.values)):  # 1e400 is a finite Decimal
        fault = {"type": "finite_number", "loc": ("poses", int(i), NUMERIC[j])}
        raise _unfit(path, example, fault)
    given = document.pose_sigma
    return PoseTable(
        rows,
        length_unit=document.length_unit or None,
        angle_unit=unit,
        where=f"{path}poses",
        say_unit=f"write {example}",
        wanted=wanted,
        sigma=given and (given.position, math.radians(given.angle_deg)),
    )


def _angles(document: Any, path: str) -> tuple[list[Decimal], str | None]:
    """The angles and their unit, if every pose has one angle and all are in one unit."""
    units = {document.angle_unit} - {None}
    angles = []
    for i, pose in enumerate(document.poses):
        given = [key for key in _ANGLE_KEYS if getattr(pose, key) is not None]
        if len(given) != 1:
            code = "E108" if given else "E105"
            message = f"pose {i + 1} has {' and '.join(given) or 'no angle'}"
            help = "give every pose one angle, as angle_deg or as angle_rad"
            raise InputError(code, message, where=f"{path}poses[{i}]", help=help)
        angles.append(getattr(pose, given[0]))
        units.add(_ANGLE_KEYS[given[0]] or document.angle_unit)
    if len(units) > 1:
        message = "the angles are stated in different units"
        help = "state one unit: angle_deg in every pose, or angle_rad in every pose"
        raise InputError("E110", message, where=f"{path}poses", help=help)
    return angles, next(iter(units), None)


def _unfit(path: str, example: str, fault: Any) -> InputError:
    """A fault that pydantic found, in this house's words."""
    place = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in fault["loc"])
    place, given = place.lstrip("."), fault.get("input")
    value = shown(given)
    known = "x, y, angle_deg or angle_rad (or angle, with angle_unit), weight, exact and name"
    code, message, help = {
        "finite_number": ("E103", "is not a finite number", "give a number, or delete the pose"),
        "is_instance_of": ("E104", f"is {value}, not a number", "write a number without quotes"),
        "bool_type": ("E104", f"is {value}, neither true nor false", "write true or false"),
        "missing": ("E105", "is missing", f"write {example}"),
        "extra_forbidden": ("E107", "is not known", f"delete it; a pose has {known}"),
        "literal_error": ("E110", f"is {value}, not an angle unit", 'write "deg" or "rad"'),
    }.get(fault["type"], ("E104", f"does not fit: {value}", f"write {example}"))
    if fault["type"] == "model_type" and isinstance(given, list):
        code, message = "E106", f"has {len(given)} numbers, not 3"
    where = (path + place).removesuffix(": ")
    return InputError(code, f"{place or 'the file'} {message}", where=where, help=help)
