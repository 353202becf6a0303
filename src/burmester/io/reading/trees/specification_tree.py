"""Limits and requirements in JSON and TOML: the keys under `limits` and `requirements`.

One table of limits is for both dyads of a linkage, a list of two has one for each.
"""

from __future__ import annotations

from functools import partial
from typing import Any, Final

from burmester.io.reading.specification import (
    LIMITS,
    REQUIREMENTS,
    Specification,
    StatedRequirement,
    checked_requirement,
)
from burmester.io.reading.trees.field_values import VALUE_KINDS
from burmester.io.reading.trees.node import Field, Fields, Node
from burmester.requirements.requirement import Requirement
from burmester.requirements.table import ASKED
from burmester.tasks.limits import Limits
from burmester.tasks.option_table import LIMIT_OPTIONS
from burmester.wording import listed

_LIMIT_FIELDS: Final[Fields] = {
    each.name: Field(VALUE_KINDS[each.kind].from_tree, VALUE_KINDS[each.kind].such)
    for each in LIMIT_OPTIONS
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


REQUIREMENT_FIELDS: Final[Fields] = {
    each.name: Field(partial(_stated, each), each.such) for each in ASKED
}


def read_requirements(node: Node) -> tuple[StatedRequirement, ...]:
    """The requirements at `requirements`.

    Raises E103 to E107 as for limits, E108 (a footprint of two shapes), E131, E132 and E134.
    """
    help = f"a table of requirements has {listed(REQUIREMENTS)}, or some of them"
    return tuple(node._replace(help=help).table(REQUIREMENT_FIELDS).values())
