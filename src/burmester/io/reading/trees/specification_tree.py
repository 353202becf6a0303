"""Limits and requirements in JSON and TOML, and each kind of value there and in an option's text.

One table of limits is for both dyads of a linkage, a list of two has one for each.

In a text a region is X,Y (a point) or line:X,Y:X,Y, segment:X,Y:X,Y, box:X,Y:X,Y or
polygon:X,Y:X,Y:X,Y with any more corners; a length is MIN:MAX, either side may be empty; kinds
are RR,PR.  A rail or slot is direction:DEG+-DEG, through:REGION and travel:REGION, or some of them,
with blanks between.  What does not fit is E131, with a caret below the text.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Region, Segment, box
from burmester.io.reading.option_text import ANY, number_from_text, numbers_from_text, option_fault
from burmester.io.reading.pose_table import Source, shown
from burmester.io.reading.specification import (
    LIMITS,
    REQUIREMENTS,
    Specification,
    StatedRequirement,
    checked_requirement,
)
from burmester.io.reading.trees.node import (
    ABOVE_ZERO,
    BOUNDS,
    FLAG,
    NOT_NEGATIVE,
    NUMBER,
    PAIR,
    Field,
    Fields,
    Node,
    Schema,
    any_case,
    one_or_more,
    table_schema,
    words,
)
from burmester.io.reading.trees.node import listed as listed_of
from burmester.numerics.arrays import FloatArray
from burmester.requirements.requirement import Number, Requirement
from burmester.requirements.table import ASKED
from burmester.tasks.limits import KINDS, Kind, Limits
from burmester.tasks.option_table import LIMIT_OPTIONS
from burmester.tasks.rails import Rail
from burmester.wording import count, listed

LengthRange: TypeAlias = tuple[float, float]

# Name of a region: its number of points (None: any number), and its constructor.
SHAPES: Final[Mapping[str, tuple[int | None, Callable[[FloatArray], Region]]]] = {
    "point": (1, lambda points: Point(points[0])),
    "line": (2, lambda points: Line(*points)),
    "segment": (2, lambda points: Segment(*points)),
    "box": (2, lambda points: box(*points)),
    "polygon": (None, Polygon),
}
REGION_HELP: Final = (
    "write X,Y for a point, or line:X,Y:X,Y, segment:, box: or polygon: likewise, or any"
)
FOOTPRINT_HELP: Final = (
    "write box:X,Y:X,Y from lower left to upper right, or polygon:X,Y:X,Y:X,Y, or any"
)
RAIL_HELP: Final = (
    "write direction:DEG or direction:DEG+-DEG, through:REGION and travel:REGION, or some of them, "
    'such as "direction:0+-2 through:0,0", or any'
)
LENGTH_HELP: Final = "write 10:200, 10: for at least 10, :200 for at most 200, or any"


def region_from_text(source: Source, help: str = REGION_HELP) -> Region:
    """The region in a text; raises E131, or E132 for an empty box, with a caret."""
    head, colon, rest = source.text.partition(":")
    shape = head.strip() if colon else "point"
    if shape not in SHAPES:
        raise option_fault(source, f"there is no region {shown(shape)}", help, width=len(head))
    at = len(head) + 1 if colon else 0
    points, (number, make) = [], SHAPES[shape]
    for part in (rest if colon else source.text).split(":"):
        points.append(numbers_from_text(source, part, at, "a point X,Y", help))
        at += len(part) + 1
    if number not in (None, len(points)):
        message = f"a {shape} takes {count(number, 'point')}, not {len(points)}"
        raise option_fault(source, message, help)
    region: Region = _built(source, make, np.array(points))
    return region


def _built(source: Source, make: Callable[..., Any], *values: Any, **named: Any) -> Any:
    """What a maker makes of a text, which its errors then show."""
    try:
        return make(*values, **named)
    except InputError as error:
        error.where = error.where or source.where(0, len(source.text))
        raise


def _points(number: int | None, node: Node) -> Any:
    return [node.pair()] if number == 1 else node.points(number or 3, number)


SHAPE_FIELDS: Final[Fields] = {
    name: Field(
        partial(_points, number), "", PAIR if number == 1 else listed_of(PAIR, number or 3, number)
    )
    for name, (number, _) in SHAPES.items()
}
AREA_FIELDS: Final[Fields] = {name: SHAPE_FIELDS[name] for name in ("box", "polygon")}


def _region_schema(fields: Fields, but: str = "") -> Schema:
    fields = {name: field for name, field in fields.items() if name != but}
    return table_schema(fields, minProperties=1, maxProperties=1)


def read_region(node: Node, fields: Fields = SHAPE_FIELDS) -> Region:
    """The region in a table of one shape; raises E105, E108, E131 and E132."""
    shape, points = node.only(node.table(fields))
    return node.at(shape).build(SHAPES[shape][1], np.array(points))


def _length_from_text(source: Source) -> LengthRange:
    low, colon, high = source.text.partition(":")
    if not colon or ":" in high:
        raise option_fault(source, f"{shown(source.text)} is not a range MIN:MAX", LENGTH_HELP)
    least = number_from_text(source, low, 0) if low.strip() else 0.0
    most = number_from_text(source, high, len(low) + 1) if high.strip() else math.inf
    return least, most


def _corridor_from_text(source: Source) -> float | tuple[float, ...]:
    parts = source.text.split(":", 1)
    at = 0, len(parts[0]) + 1
    numbers = [number_from_text(source, *each, "E134") for each in zip(parts, at, strict=False)]
    return tuple(numbers) if len(numbers) > 1 else numbers[0]


_LENGTH_FIELDS: Final[Fields] = {
    "least": Field(Node.number, schema=NOT_NEGATIVE),
    "most": Field(Node.number, schema=ABOVE_ZERO),
}


def _read_length(node: Node) -> LengthRange:
    given = node.table(_LENGTH_FIELDS)
    return given.get("least", 0.0), given.get("most", math.inf)


def _kinds_from_text(source: Source) -> frozenset[Kind]:
    at, kinds = 0, set[Kind]()
    for item in source.text.split(","):
        known = [kind for kind in KINDS if kind == item.strip().upper()]
        if not known:
            message = f"there is no dyad kind {shown(item)}"
            help = f"choose among {', '.join(KINDS)}, with commas between them"
            raise option_fault(source, message, help, at=at, width=len(item))
        kinds.update(known)
        at += len(item) + 1
    return frozenset(kinds)


def _read_kinds(node: Node) -> frozenset[str]:
    kinds = [(each, each.text()) for each in node.items()]
    return frozenset(each.build(Limits, kinds={kind}) and kind for each, kind in kinds)


def _rail_from_text(source: Source) -> Rail:
    """The rail in a text; raises E131 and E137."""
    stated: dict[str, Any] = {}
    at = 0
    for word in source.text.split():
        at = source.text.index(word, at)
        name, _, rest = word.partition(":")
        begin, fault = at + len(name) + 1, None
        if name not in ("direction", "through", "travel") or not rest:
            fault = f"{shown(word)} says nothing of a rail"
        elif name in stated or f"{name}_deg" in stated:
            fault = f"{name} is given twice"
        if fault is not None:
            raise option_fault(source, fault, RAIL_HELP, at=at, width=len(word))
        if name == "direction":
            mark = "±" if "±" in rest else "+-"
            angle, within, tolerance = rest.partition(mark)
            stated["direction_deg"] = number_from_text(source, angle, begin)
            if within:
                place = begin + len(angle) + len(mark)
                stated["tolerance_deg"] = number_from_text(source, tolerance, place)
        else:
            stated[name] = region_from_text(Source(source.label, rest))
        at += len(word)
    if not stated:
        raise option_fault(source, "it is empty", RAIL_HELP)
    rail: Rail = _built(source, Rail, **stated)
    return rail


_REGION: Final = (
    "a region has one key: point with [X, Y]; line, segment or box with two points "
    "[[X, Y], [X, Y]]; polygon with three or more"
)
_RAIL_FIELDS: Final[Fields] = {
    "direction_deg": Field(Node.number),
    "tolerance_deg": Field(Node.number, schema=NOT_NEGATIVE | {"exclusiveMaximum": 90}),
    "through": Field(read_region, _REGION, _region_schema(SHAPE_FIELDS, but="line")),
    "travel": Field(read_region, _REGION, _region_schema(SHAPE_FIELDS, but="point")),
}


class ValueKind(NamedTuple):
    """A kind of value: how it is read from a text and from a tree, and what stands in a tree."""

    from_text: Callable[[Source], Any]
    from_tree: Callable[[Node], Any]
    such: str = ""
    schema: Schema | None = None


VALUE_KINDS: Final[Mapping[str, ValueKind]] = {
    "region": ValueKind(region_from_text, read_region, _REGION, _region_schema(SHAPE_FIELDS)),
    "range": ValueKind(
        _length_from_text,
        _read_length,
        "a length has the keys least and most, or one of them, with a number each",
        table_schema(_LENGTH_FIELDS),
    ),
    "kinds": ValueKind(
        _kinds_from_text,
        _read_kinds,
        'kinds is a list of some of "RR", "PR", "RP" and "PP"',
        listed_of(words(KINDS), 1),
    ),
    "line": ValueKind(
        _rail_from_text,
        lambda node: node.build(Rail, **node.table(_RAIL_FIELDS)),
        f"a rail or slot has {listed([*_RAIL_FIELDS])}, or some of them; through and travel are "
        "regions",
        table_schema(_RAIL_FIELDS, minProperties=1),
    ),
    "area": ValueKind(
        lambda source: (
            None if source.text.strip() == ANY else region_from_text(source, FOOTPRINT_HELP)
        ),
        partial(read_region, fields=AREA_FIELDS),
        schema=_region_schema(AREA_FIELDS),
    ),
    "number": ValueKind(
        lambda source: number_from_text(source, source.text, 0, "E134"), Node.number
    ),
    "corridor": ValueKind(
        _corridor_from_text,
        lambda node: tuple(node.pair()) if isinstance(node.value, list) else node.number(),
        schema={"anyOf": [ABOVE_ZERO, PAIR]},
    ),
    "choice": ValueKind(lambda source: source.text, Node.text),
    "flag": ValueKind(lambda source: source.text, Node.flag, schema=FLAG),
}


_LIMIT_FIELDS: Final[Fields] = {
    each.name: Field(
        kind.from_tree,
        kind.such,
        {"description": each.help, "$comment": kind.such} | (kind.schema or {}),
    )
    for each in LIMIT_OPTIONS
    for kind in (VALUE_KINDS[each.kind],)
}
LIMITS_SCHEMA: Final = one_or_more(table_schema(_LIMIT_FIELDS), 1, 2) | {
    "description": "What each dyad may be: one table for both dyads, or two, one for each."
}


def read_limits(node: Node) -> Specification:
    """The limits at `limits`.

    Raises E103 to E107 as for poses, E108 (a region of two shapes), E131 and E132.
    """
    node = node._replace(help=f"a table of limits has {listed(LIMITS)}, or some of them")
    tables = node.one_or_more()
    if not 0 < len(tables) <= 2:
        message = f"has {len(tables)} tables, and a linkage has two dyads"
        help = "give one table for both dyads, or two, one for each; or delete limits"
        error = node.fault("E106", message, help)
        error.where = (tables[2] if tables else node).place
        raise error
    stated = [_of_dyad(table) for table in tables]
    limits: dict[str, Any] = {}
    where = {}
    for name in LIMITS:
        values = tuple(each.get(name) for each in stated)
        if first := next((t for t, each in zip(tables, stated, strict=True) if name in each), None):
            limits[name], where[name] = values, first.document.where(*first.path, name, key=True)
    return Specification(**limits, where=where)


def _of_dyad(table: Node) -> dict[str, Any]:
    """The limits in one table; contradictions are refused here, where its location is known."""
    limits = table.table(_LIMIT_FIELDS)
    for name, value in limits.items():
        table.at(name).build(Limits, **{name: value})
    table.build(Limits, **limits)
    return limits


def _stated(asked: Requirement, node: Node) -> StatedRequirement:
    """A requirement that is valid by itself; raises the errors of `Requirements`, located."""
    if asked.form == "names":
        names = [
            each.build(checked_requirement, asked.name, [each.text()], "")
            for each in node.one_or_more()
        ]
        value = frozenset(name for each in names for name in each.value)
    else:
        value = VALUE_KINDS[asked.form or ""].from_tree(node)
    where = node.document.where(*node.path, key=True)
    return node.build(checked_requirement, asked.name, value, "")._replace(where=where)


def _schema_of(asked: Requirement) -> Schema:
    """What may stand at the key of a requirement."""
    kind = VALUE_KINDS.get(asked.form or "")
    out = (kind and kind.schema) or {}
    if isinstance(asked.checked, Number):
        out = NUMBER | {BOUNDS[name]: bound for name, bound in asked.checked.bounds.items()}
    elif asked.choices or asked.known:
        out = words(asked.choices) if asked.choices else one_or_more(any_case(asked.known), 1)
    return {"description": asked.help, "$comment": asked.such} | out


REQUIREMENT_FIELDS: Final[Fields] = {
    each.name: Field(partial(_stated, each), each.such, _schema_of(each)) for each in ASKED
}


REQUIREMENTS_SCHEMA: Final = table_schema(
    REQUIREMENT_FIELDS, description="What the whole linkage must be."
)


def read_requirements(node: Node) -> tuple[StatedRequirement, ...]:
    """The requirements at `requirements`.

    Raises E103 to E107 as for limits, E108 (a footprint of two shapes), E131, E132 and E134.
    """
    help = f"a table of requirements has {listed(REQUIREMENTS)}, or some of them"
    return tuple(node._replace(help=help).table(REQUIREMENT_FIELDS).values())
