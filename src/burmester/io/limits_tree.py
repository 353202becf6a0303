"""Limits in JSON and TOML: what may stand under `limits`, and what it comes to.

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
from burmester.io.asked import FILE_KEYS
from burmester.io.table import shown
from burmester.io.wanted import LIMIT_KEYS, SHAPES, Length, Wanted, WantedRegion
from burmester.limits import Limits

__all__ = ["Model", "Number", "Pair", "Two", "read", "unfit"]


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
Two = Annotated[list[Pair], Field(min_length=2, max_length=2)]


class Model(BaseModel):
    """A table that has no other keys."""

    model_config = ConfigDict(strict=True, str_strip_whitespace=True, extra="forbid")


class _Region(Model):
    point: Pair | None = None
    line: Two | None = None
    segment: Two | None = None
    box: Two | None = None
    polygon: Annotated[list[Pair], Field(min_length=3)] | None = None


class _Length(Model):
    least: Number | None = None
    most: Number | None = None


class _Limits(Model):
    fixed_pivot: _Region | None = None
    moving_pivot: _Region | None = None
    length: _Length | None = None
    kinds: list[str] | None = None


_TABLES: TypeAdapter[list[_Limits]] = TypeAdapter(list[_Limits])
_KEYS = tuple(_Limits.model_fields)
_REGION = (
    "a region has one key: point with [X, Y]; line, segment or box with two points "
    "[[X, Y], [X, Y]]; polygon with three or more"
)
_HELP = {
    "fixed_pivot": _REGION,
    "moving_pivot": _REGION,
    "length": "a length has the keys least and most, or one of them, with a number each",
    "kinds": 'kinds is a list of some of "RR", "PR", "RP" and "PP"',
}
_TABLE = f"a table of limits has {', '.join(_KEYS[:-1])} and {_KEYS[-1]}, or some of them"


def read(tree: dict[str, Any], path: str) -> Wanted:
    """What the tree of a task, at `path`, says of limits.

    Raises E103 to E107 as for poses, E108 (a region of two shapes), E131 and E132.
    """
    for key in LIMIT_KEYS[1:]:
        if key in tree:
            help = "write it into a pose" if key == "exact" else "write it under limits"
            message = f"{key} stands beside the poses, where it limits nothing"
            raise InputError("E107", message, where=f"{path}{key}", help=f"{help}, or delete it")
    given, path = tree.get("limits"), f"{path}limits"
    if given is None:
        return Wanted()
    tables = given if isinstance(given, list) else [given]
    places = [f"{path}[{k}]" for k in range(len(tables))] if tables is given else [path]
    if not 0 < len(tables) <= 2:
        raise InputError(
            "E106",
            f"limits has {len(tables)} tables, and a linkage has two dyads",
            where=path,
            help="give one table for both dyads, or two, one for each",
        )
    try:
        found = _TABLES.validate_python(tables)
    except ValidationError as error:
        raise _unfit(places, error.errors(include_url=False)[0]) from None
    said = [_said(table, place) for table, place in zip(found, places, strict=True)]
    by_key = {key: tuple(each[key] for each in said) for key in _KEYS}
    some = {key: values for key, values in by_key.items() if any(v is not None for v in values)}
    return Wanted(**some, where=path)


def _said(table: _Limits, place: str) -> dict[str, Any]:
    """What one table says; contradictions are refused here, where its place is known."""
    said: dict[str, Any] = {
        "fixed_pivot": _region(table.fixed_pivot, f"{place}.fixed_pivot"),
        "moving_pivot": _region(table.moving_pivot, f"{place}.moving_pivot"),
        "length": _length(table.length),
        "kinds": None if table.kinds is None else frozenset(table.kinds),
    }
    try:
        Limits(**{key: value for key, value in said.items() if value is not None})
    except InputError as error:
        error.where = place
        raise
    return said


def _region(tree: _Region | None, place: str) -> WantedRegion:
    if tree is None:
        return None
    given = tree.model_dump(exclude_none=True)
    if len(given) != 1:
        code, what = ("E108", " and ".join(given)) if given else ("E105", "no shape")
        name = place.rpartition(".")[2]
        raise InputError(code, f"{name} has {what}", where=place, help=_REGION)
    ((shape, points),) = given.items()
    try:
        return SHAPES[shape][1](np.atleast_2d(np.array(points)))
    except InputError as error:
        error.where = f"{place}.{shape}"
        raise


def _length(tree: _Length | None) -> Length | None:
    if tree is None:
        return None
    least, most = tree.least, tree.most
    return 0.0 if least is None else least, math.inf if most is None else most


def _unfit(places: list[str], fault: Any) -> InputError:
    """A fault that pydantic found in one of the tables."""
    k, *keys = fault["loc"]
    help = _HELP.get(str(keys[0]), _TABLE) if keys else _TABLE
    if fault["type"] == "extra_forbidden" and keys[-1] in FILE_KEYS:
        help = f"write {keys[-1]} under requirements, which speak of the whole linkage"
    return unfit(places[k], keys, fault, "limits", "a kind", help)


def unfit(  # noqa: PLR0917
    place: str, keys: list[int | str], fault: Any, head: str, item: str, help: str
) -> InputError:
    """A fault that pydantic found below the head of a table, in this house's words.

    place: the path of the table; keys: the way on from there; item: what stands in quotes.
    """
    place += "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in keys)
    value, context = shown(fault.get("input")), fault.get("ctx", {})
    code, message = {
        "finite_number": ("E103", "is not a finite number"),
        "no_number": ("E104", f"is {value}, not a number"),
        "string_type": ("E104", f"is {value}, not {item} in quotes"),
        "bool_type": ("E104", f"is {value}, neither true nor false"),
        "too_short": ("E106", f"has {context.get('actual_length')} of {context.get('min_length')}"),
        "too_long": ("E106", f"has more than {context.get('max_length')}"),
        "extra_forbidden": ("E107", "is not known"),
    }.get(fault["type"], ("E104", f"does not fit: {value}"))
    if fault["type"] == "extra_forbidden" and keys[-1] in ("poses", "angle_unit", "length_unit"):
        help = f"write {keys[-1]} above the head of {head}: what stands below it belongs to {head}"
    return InputError(code, f"{place.rpartition(': ')[2]} {message}", where=place, help=help)
