"""The keys of a pose in a JSON or TOML file, and the errors for anything else.

Imported on first use, as pydantic is slow to import.
"""

from __future__ import annotations

import functools
import math
import operator
import re
from collections.abc import Iterable
from decimal import Decimal
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from burmester.errors import InputError
from burmester.io.reading.pose_table import NUMERIC, POINTS
from burmester.io.reading.trees.limits_tree import Number
from burmester.io.reading.trees.locations import Document, close_match
from burmester.io.reading.trees.plain_poses import POINT_KEYS, XY_ANGLE_KEYS
from burmester.io.reading.trees.tolerance_model import ToleranceModel, tolerance_fault
from burmester.tasks.pose_tolerances import COMPONENTS, Component

__all__ = ["pose_fault", "validated"]

_COMMON_KEYS = ("weight", "exact", "name", "tolerance", "free", "crank_deg", "crank_rad")
_SLICE = 1000  # poses checked at a time: all that is wrong in them is collected


class _Common(BaseModel):
    model_config = ConfigDict(strict=True, str_strip_whitespace=True, extra="forbid")
    weight: Decimal | None = None
    name: str | None = None
    exact: bool | None = None
    tolerance: ToleranceModel | None = None
    free: list[Component] | None = None
    crank_deg: Decimal | None = None
    crank_rad: Decimal | None = None

    def free_components(self) -> set[Component]:
        """Those that `free` names, or whose tolerance says so."""
        bounds = (math.nan,) * 3 if self.tolerance is None else self.tolerance.bounds(None)
        said = {each for each, bound in zip(COMPONENTS, bounds, strict=True) if math.isinf(bound)}
        return said | set(self.free or ())


class _Pose(_Common):
    x: Decimal | None = None
    y: Decimal | None = None
    angle: Decimal | None = None
    angle_deg: Decimal | None = None
    angle_rad: Decimal | None = None

    @model_validator(mode="before")
    @classmethod
    def _as_object(cls, pose: Any) -> Any:
        """[x, y, angle] as an object, and the integers of TOML as Decimal."""
        if isinstance(pose, list) and len(pose) == 3:
            pose = dict(zip(NUMERIC, pose, strict=False))
        if isinstance(pose, dict) and int in map(type, pose.values()):
            return {key: _decimal(value) for key, value in pose.items()}
        return pose

    @model_validator(mode="after")
    def _complete(self) -> Self:
        """Refuse a pose without x or y, if they are not free."""
        free = self.free_components()
        for key in ("x", "y"):
            if getattr(self, key) is None and key not in free:
                fault = "no_number" if key in self.model_fields_set else "missing"
                raise PydanticCustomError("incomplete", "{key}", {"key": key, "fault": fault})
        return self


_Point = Annotated[list[Decimal], Field(min_length=2, max_length=2)]


class _Tracked(_Common):
    px: Decimal | None = None
    py: Decimal | None = None
    qx: Decimal | None = None
    qy: Decimal | None = None
    p: _Point | None = None
    q: _Point | None = None

    @model_validator(mode="before")
    @classmethod
    def _in_decimals(cls, pose: Any) -> Any:
        """The integers of TOML as Decimal, those of points too."""
        if not isinstance(pose, dict):
            return pose
        return {
            key: [*map(_decimal, value)] if isinstance(value, list) else _decimal(value)
            for key, value in pose.items()
        }


_Sigma = Annotated[Number, Field(ge=0)]


class _PoseSigma(BaseModel):
    model_config = ConfigDict(extra="forbid")
    position: _Sigma
    angle_deg: _Sigma


class _Whole(BaseModel):
    model_config = ConfigDict(strict=True, str_strip_whitespace=True)
    poses: list[Any]
    pose_sigma: _PoseSigma | None = None
    angle_unit: Literal["deg", "rad"] | None = None
    length_unit: str | None = None


_XY_ANGLES: TypeAdapter[list[_Pose]] = TypeAdapter(list[_Pose])
_TRACKS: TypeAdapter[list[_Tracked]] = TypeAdapter(list[_Tracked])


def _decimal(value: Any) -> Any:
    return Decimal(value) if type(value) is int else value


def validated(document: Document, tree: Any, example: str, tracked: bool) -> tuple[Any, list[Any]]:
    """The values beside the poses, and the poses; raises E103 to E110 as `pose_fault` says.

    tracked: whether the poses are two points each, in place of x, y and an angle.
    """
    given = tree.get("poses") if isinstance(tree, dict) else None
    poses: list[Any] = []
    try:
        for start in range(0, len(given) if isinstance(given, list) else 0, _SLICE):
            some = given[start : start + _SLICE]  # type: ignore[index]  # it is a list here
            poses += (_TRACKS if tracked else _XY_ANGLES).validate_python(some)
        return _Whole.model_validate(tree), poses
    except ValidationError as error:
        fault: Any = error.errors(include_url=False)[0]
        if fault["loc"] and isinstance(fault["loc"][0], int):
            row, *keys = fault["loc"]
            fault["loc"] = ("poses", len(poses) + row, *keys)
            if keys[:1] in (["tolerance"], ["free"]):
                raise tolerance_fault(document, fault["loc"], fault) from None
            if fault["type"] == "incomplete":
                key, kind = fault["ctx"]["key"], fault["ctx"]["fault"]
                fault |= {"type": kind, "loc": (*fault["loc"], key), "input": None}
        raise pose_fault(document, tree, example, tracked, fault) from None


def pose_fault(
    document: Document, tree: Any, example: str, tracked: bool, fault: Any
) -> InputError:
    """The error for a fault reported by pydantic, in this package's words."""
    loc, given, kind = fault["loc"], fault.get("input"), fault["type"]
    if kind == "string_unicode" and document.is_key(given, *_as_written(tree, loc)):
        loc, kind = (*loc, given), "extra_forbidden"
    path = _as_written(tree, loc)
    name = document.named(*(loc if len(path) == len(loc) else path))
    value = document.shown(given, *path)
    known = "x, y, angle_deg or angle_rad (or angle, with angle_unit)"
    if tracked:
        known = "px, py, qx and qy (or p and q with two numbers each)"
    known += ", weight, exact, name, tolerance and free"
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
        why = f"{value} is beyond 1.8e308, the largest representable number"
    if kind == "missing" and loc[:1] == ("poses",) and len(loc) > 1:
        help = f"write it into the pose; a pose has {known}"
        if not tracked:
            help += f'. A component that is free is named by free = ["{loc[-1]}"]'
    if kind == "missing" and loc[:1] == ("pose_sigma",):
        help = "give pose_sigma both, position and angle_deg"
    if kind == "extra_forbidden" and len(loc) == 1:
        help = "delete it"
    elif kind == "extra_forbidden" and loc[0] == "poses":
        keys = (*POINTS, *POINT_KEYS) if tracked else (*XY_ANGLE_KEYS,)
        if near := close_match(str(loc[-1]), (*keys, *_COMMON_KEYS)):
            help = f"write {near} in its place; a pose has {known}"
    elif kind == "extra_forbidden":
        help = "delete it; pose_sigma has position and angle_deg"
    if kind == "model_type" and isinstance(given, list):
        code, message = "E106", f"has {len(given)} number{'s' * (len(given) != 1)}, not 3"
        help = "write [x, y, angle], with a point for the decimal mark of a number"
        if len(given) > 3:
            why = "a comma separates the numbers and is no decimal mark"
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
