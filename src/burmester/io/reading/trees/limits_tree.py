"""Limits in JSON and TOML: the keys under `limits`, and the limits they make.

One table is for both dyads of a linkage, a list of two has one for each.  Imported on first
use, as pydantic is slow to import.
"""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Annotated, Any

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    TypeAdapter,
    ValidationError,
)
from pydantic_core import PydanticCustomError

from burmester.errors import InputError
from burmester.io.reading.specification import (
    LIMIT_KEYS,
    SHAPES,
    TOP_KEYS,
    LengthRange,
    OptionalRegion,
    Specification,
)
from burmester.io.reading.stated_requirements import FILE_KEYS
from burmester.io.reading.trees.locations import Document, Path, close_match
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.rails import Rail
from burmester.wording import listed

__all__ = ["Model", "Number", "Pair", "TwoPairs", "model_fault", "read_limits"]


def _number(value: Any) -> float:
    """The nearest double to a Decimal, or to an integer of TOML."""
    if type(value) is not int and not isinstance(value, Decimal):
        raise PydanticCustomError("no_number", "not a number")
    number = float(Decimal(value))
    if not math.isfinite(number):  # 1e400 is a finite Decimal
        raise PydanticCustomError("finite_number", "not finite")
    return number


Number = Annotated[float, BeforeValidator(_number)]
Pair = Annotated[list[Number], Field(min_length=2, max_length=2)]
TwoPairs = Annotated[list[Pair], Field(min_length=2, max_length=2)]


class Model(BaseModel):
    """A table that has no other keys."""

    model_config = ConfigDict(strict=True, str_strip_whitespace=True, extra="forbid")


class _Region(Model):
    point: Pair | None = None
    line: TwoPairs | None = None
    segment: TwoPairs | None = None
    box: TwoPairs | None = None
    polygon: Annotated[list[Pair], Field(min_length=3)] | None = None


class _Length(Model):
    least: Number | None = None
    most: Number | None = None


class _Rail(Model):
    direction_deg: Number | None = None
    tolerance_deg: Number | None = None
    through: _Region | None = None
    travel: _Region | None = None


class _Limits(Model):
    fixed_pivot: _Region | None = None
    moving_pivot: _Region | None = None
    length: _Length | None = None
    kinds: list[str] | None = None
    rail: _Rail | None = None
    slot: _Rail | None = None


_TABLES: TypeAdapter[list[_Limits]] = TypeAdapter(list[_Limits])
_KEYS = tuple(_Limits.model_fields)
_REGION = (
    "a region has one key: point with [X, Y]; line, segment or box with two points "
    "[[X, Y], [X, Y]]; polygon with three or more"
)
_RAIL_KEYS = tuple(_Rail.model_fields)
_RAIL = f"a rail or slot has {listed(_RAIL_KEYS)}, or some of them; through and travel are regions"
_HELP = {
    "fixed_pivot": _REGION,
    "moving_pivot": _REGION,
    "length": "a length has the keys least and most, or one of them, with a number each",
    "rail": _RAIL,
    "slot": _RAIL,
    "kinds": 'kinds is a list of some of "RR", "PR", "RP" and "PP"',
}
_TABLE = f"a table of limits has {listed(_KEYS)}, or some of them"


def read_limits(tree: dict[str, Any], document: Document) -> Specification:
    """The limits in the tree of a task.

    Raises E103 to E107 as for poses, E108 (a region of two shapes), E131 and E132.
    """
    for key in LIMIT_KEYS[1:]:
        if key in tree:
            help = "write limits in its place" if key == "limit" else "write it under limits"
            help = "write it into a pose" if key == "exact" else help
            message = f"{document.named(key)} stands beside the poses, where it has no effect"
            where = document.where(key, key=True)
            raise InputError("E107", message, where=where, help=f"{help}, or delete it")
    given = tree.get("limits")
    if given is None:
        return Specification()
    tables = given if isinstance(given, list) else [given]
    paths: list[Path] = [("limits",)]
    if tables is given:
        paths = [("limits", k) for k in range(len(tables))]
    if not 0 < len(tables) <= 2:
        raise InputError(
            "E106",
            f"{document.named('limits')} has {len(tables)} tables, and a linkage has two dyads",
            where=document.where("limits", *([2] if tables else [])),
            help="give one table for both dyads, or two, one for each; or delete limits",
        )
    try:
        found = _TABLES.validate_python(tables)
    except ValidationError as error:
        fault: Any = error.errors(include_url=False)[0]
        raise _limits_fault(document, paths[fault["loc"][0]], fault) from None
    stated = [
        _table_limits(table, document, path) for table, path in zip(found, paths, strict=True)
    ]
    by_key = {key: tuple(each[key] for each in stated) for key in _KEYS}
    limits = {key: values for key, values in by_key.items() if any(v is not None for v in values)}
    locations = {}
    for key, values in limits.items():
        first = next(k for k, value in enumerate(values) if value is not None)
        locations[key] = document.where(*paths[first], key, key=True)
    return Specification(**limits, where=locations)


def _table_limits(table: _Limits, document: Document, path: Path) -> dict[str, Any]:
    """The limits in one table; contradictions are refused here, where its location is known."""
    limits: dict[str, Any] = {
        "fixed_pivot": _region(table.fixed_pivot, document, (*path, "fixed_pivot")),
        "moving_pivot": _region(table.moving_pivot, document, (*path, "moving_pivot")),
        "length": _length(table.length),
        "kinds": None if table.kinds is None else frozenset(table.kinds),
        "rail": _rail(table.rail, document, (*path, "rail")),
        "slot": _rail(table.slot, document, (*path, "slot")),
    }
    given = {key: value for key, value in limits.items() if value is not None}
    for key, value in given.items():
        _require_valid({key: value}, document, (*path, key), table)
    _require_valid(given, document, path, table)
    return limits


def _require_valid(given: dict[str, Any], document: Document, path: Path, table: _Limits) -> None:
    """Refuse limits that `Limits` refuses."""
    try:
        Limits(**given)
    except InputError as error:
        if path[-1] == "kinds":
            for i, kind in enumerate(table.kinds or ()):
                if kind not in KINDS:
                    path = (*path, i)
                    break
        raise document.again(error, *path) from None


def _rail(tree: _Rail | None, document: Document, path: Path) -> Rail | None:
    if tree is None:
        return None
    regions: dict[str, Any] = {
        "through": _region(tree.through, document, (*path, "through")),
        "travel": _region(tree.travel, document, (*path, "travel")),
    }
    try:
        return Rail(tree.direction_deg, tree.tolerance_deg or 0.0, **regions)
    except InputError as error:
        raise document.again(error, *path) from None


def _region(tree: _Region | None, document: Document, path: Path) -> OptionalRegion:
    if tree is None:
        return None
    given = tree.model_dump(exclude_none=True)
    if len(given) != 1:
        code, what = ("E108", " and ".join(given)) if given else ("E105", "no shape")
        message = f"{document.named(*path)} has {what}"
        raise InputError(code, message, where=document.where(*path), help=_REGION)
    ((shape, points),) = given.items()
    try:
        return SHAPES[shape][1](np.atleast_2d(np.array(points)))
    except InputError as error:
        raise document.again(error, *path, shape) from None


def _length(tree: _Length | None) -> LengthRange | None:
    if tree is None:
        return None
    least, most = tree.least, tree.most
    return 0.0 if least is None else least, math.inf if most is None else most


def _limits_fault(document: Document, path: Path, fault: Any) -> InputError:
    """The error for a fault reported by pydantic in the table at a path."""
    _, *keys = fault["loc"]
    help = _HELP.get(str(keys[0]), _TABLE) if keys else _TABLE
    if fault["type"] == "extra_forbidden":
        known = _KEYS if len(keys) == 1 else (*SHAPES, "least", "most", *_RAIL_KEYS)
        if keys[-1] in FILE_KEYS:
            help = f"write {keys[-1]} under requirements, which holds for the whole linkage"
        elif near := close_match(str(keys[-1]), known):
            help = f"write {near} in its place; {help}"
    return model_fault(document, (*path, *keys), fault, "a kind", help)


def model_fault(document: Document, path: Path, fault: Any, item: str, help: str) -> InputError:
    """The error for a fault reported by pydantic at a path, in this package's words.

    item: the noun for a text in quotes there.
    """
    kind, given = fault["type"], fault.get("input")
    if kind == "string_unicode" and document.is_key(given, *path):
        path, kind = (*path, given), "extra_forbidden"
    value, context = document.shown(given, *path), fault.get("ctx", {})
    head, why = path[0], None
    extra = kind == "extra_forbidden"
    items = "points" if path[-1] in SHAPES and path[-1] != "point" else "numbers"
    code, message = {
        "finite_number": ("E103", "is not a finite number"),
        "no_number": ("E104", f"is {value}, not a number"),
        "string_type": ("E104", f"is {value}, not {item} in quotes"),
        "string_unicode": ("E104", f"is {value}, not {item} in quotes"),
        "bool_type": ("E104", f"is {value}, neither true nor false"),
        "too_short": (
            "E106",
            f"has {context.get('actual_length')} of {context.get('min_length')} {items}",
        ),
        "too_long": ("E106", f"has more than {context.get('max_length')} {items}"),
        "extra_forbidden": ("E107", "is not known"),
    }.get(kind, ("E104", f"does not fit: {value}"))
    if extra and path[-1] in TOP_KEYS:
        help = f"write {path[-1]} above the head of {head}: what stands below it belongs to {head}"
        if document.language == "JSON":
            help = f"write {path[-1]} beside {head}, not in it"
    if code == "E103" or kind == "no_number":
        help = "write a number without quotes, such as -12.5 or 3e-4"
    if code == "E103" and value[-1:].isdigit():
        why = f"{value} is beyond 1.8e308, the largest representable number"
    if kind == "too_long" and items == "numbers":
        why = "a comma separates numbers and is no decimal mark"
    where = document.where(*path, key=extra)
    return InputError(code, f"{document.named(*path)} {message}", where=where, why=why, help=help)
