"""Requirements in JSON and TOML: the keys under `requirements`, and the values they give."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Final

from burmester.io.reading.stated_requirements import (
    FILE_KEYS,
    StatedRequirement,
    checked_requirement,
)
from burmester.io.reading.trees.limits_tree import SHAPE_FIELDS, read_region
from burmester.io.reading.trees.node import Field, Fields, Node
from burmester.requirements.requirement import Form, Requirement
from burmester.requirements.table import ASKED
from burmester.wording import listed

_AREAS: Final[Fields] = {name: SHAPE_FIELDS[name] for name in ("box", "polygon")}
_READ: Final[dict[Form | None, Callable[[Node], Any]]] = {
    "number": Node.number,
    "choice": Node.text,
    "area": partial(read_region, fields=_AREAS),
    "flag": Node.flag,
}


def _stated(asked: Requirement, node: Node) -> StatedRequirement:
    """A requirement that is valid by itself; raises the errors of `Requirements`, located."""
    if asked.form != "names":
        value = _READ[asked.form](node)
    else:
        names = [
            each.build(checked_requirement, asked.name, [each.text()], "")
            for each in node.one_or_more()
        ]
        value = frozenset(name for each in names for name in each.value)
    where = node.document.where(*node.path, key=True)
    return node.build(checked_requirement, asked.name, value, "")._replace(where=where)


REQUIREMENT_FIELDS: Final[Fields] = {
    each.name: Field(partial(_stated, each), each.such) for each in ASKED
}


def read_requirements(node: Node) -> tuple[StatedRequirement, ...]:
    """The requirements at `requirements`.

    Raises E103 to E107 as for limits, E108 (a footprint of two shapes), E131, E132 and E134.
    """
    help = f"a table of requirements has {listed(FILE_KEYS)}, or some of them"
    return tuple(node._replace(help=help).table(REQUIREMENT_FIELDS).values())
