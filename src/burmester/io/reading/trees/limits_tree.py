"""Limits in JSON and TOML: the keys under `limits`, and the limits they make.

One table is for both dyads of a linkage, a list of two has one for each.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any, Final

import numpy as np

from burmester.geometry.regions import Region
from burmester.io.reading.specification import LIMITS, SHAPES, LengthRange, Specification
from burmester.io.reading.trees.node import Field, Fields, Node
from burmester.tasks.limits import Limits
from burmester.tasks.rails import Rail
from burmester.wording import listed


def _points(count: int | None, node: Node) -> Any:
    return [node.pair()] if count == 1 else node.points(count or 3, count)


SHAPE_FIELDS: Final[Fields] = {
    name: Field(partial(_points, count)) for name, (count, _) in SHAPES.items()
}


def read_region(node: Node, fields: Fields = SHAPE_FIELDS) -> Region:
    """The region in a table of one shape; raises E105, E108, E131 and E132."""
    shape, points = node.only(node.table(fields))
    return node.at(shape).build(SHAPES[shape][1], np.array(points))


def _length(node: Node) -> LengthRange:
    given = node.table({"least": Field(Node.number), "most": Field(Node.number)})
    return given.get("least", 0.0), given.get("most", math.inf)


def _kinds(node: Node) -> frozenset[str]:
    kinds = [(each, each.text()) for each in node.items()]
    return frozenset(each.build(Limits, kinds={kind}) and kind for each, kind in kinds)


_REGION = (
    "a region has one key: point with [X, Y]; line, segment or box with two points "
    "[[X, Y], [X, Y]]; polygon with three or more"
)
_RAIL_FIELDS: Final[Fields] = {
    "direction_deg": Field(Node.number),
    "tolerance_deg": Field(Node.number),
    "through": Field(read_region, _REGION),
    "travel": Field(read_region, _REGION),
}


def _rail(node: Node) -> Rail:
    return node.build(Rail, **node.table(_RAIL_FIELDS))


_RAIL = (
    f"a rail or slot has {listed([*_RAIL_FIELDS])}, or some of them; through and travel are regions"
)
_FIELDS: Final[Fields] = {
    "fixed_pivot": Field(read_region, _REGION),
    "moving_pivot": Field(read_region, _REGION),
    "length": Field(
        _length, "a length has the keys least and most, or one of them, with a number each"
    ),
    "kinds": Field(_kinds, 'kinds is a list of some of "RR", "PR", "RP" and "PP"'),
    "rail": Field(_rail, _RAIL),
    "slot": Field(_rail, _RAIL),
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
    limits = table.table(_FIELDS)
    for name, value in limits.items():
        table.at(name).build(Limits, **{name: value})
    table.build(Limits, **limits)
    return limits
