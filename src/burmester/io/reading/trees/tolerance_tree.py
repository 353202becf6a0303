"""A tolerance in JSON and TOML: of a pose, or of all poses of a task that state none.

    tolerance = { x = 0.1, y = "free", angle_deg = 0.5, axes = "body" }

A number, or "free".  `angle` is in the unit of the poses' angles.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any, Final

from burmester.io.reading.stated_tolerances import FREE_WORDS, DefaultTolerance
from burmester.io.reading.trees.node import Field, Fields, Node
from burmester.tasks.pose_tolerances import COMPONENTS

ANGLE_KEYS: Final = {"angle": None, "angle_deg": "deg", "angle_rad": "rad"}


def _bound(node: Node) -> float:
    """The nearest double of a number; infinite for "free"."""
    if isinstance(node.value, str):
        if node.value.strip().lower() in FREE_WORDS:
            return math.inf
        raise node.wrong("neither a number nor free")
    return node.number()


_FIELDS: Final[Fields] = {
    **{key: Field(_bound) for key in ("x", "y", *ANGLE_KEYS)},
    "axes": Field(partial(Node.word, known=("fixed", "body"))),
}


def _table(node: Node) -> dict[str, Any]:
    """The keys of a tolerance that are stated; raises E108 for an angle that is stated twice."""
    given = node.table(_FIELDS)
    twice = [key for key in ANGLE_KEYS if key in given]
    if len(twice) > 1:
        help = f"delete one of them, such as {twice[1]}"
        raise node.fault("E108", f"has {' and '.join(twice)}", help, key=twice[1])
    return given


TOLERANCE: Final = Field(
    _table,
    'a tolerance has x, y and angle_deg (or angle, angle_rad), each a number or "free", and axes, '
    '"fixed" or "body"',
)
FREE: Final = Field(
    lambda node: [each.word(COMPONENTS) for each in node.items()],
    'free is a list of some of "x", "y" and "angle"',
)


def bounds_of(given: dict[str, Any], unit: str | None) -> tuple[float, float, float]:
    """x, y and angle of a tolerance, the angle in `unit`; nan where nothing is stated."""
    angle = given.get("angle", math.nan)
    if "angle_deg" in given:
        angle = given["angle_deg"] if unit == "deg" else math.radians(given["angle_deg"])
    if "angle_rad" in given:
        angle = given["angle_rad"] if unit != "deg" else math.degrees(given["angle_rad"])
    return given.get("x", math.nan), given.get("y", math.nan), angle


def read_tolerance(node: Node, unit: str | None) -> DefaultTolerance:
    """The tolerance beside the poses; raises E103 to E108.  unit: of the poses' angles."""
    given = _table(node._replace(help=TOLERANCE.help))
    where = node.document.where(*node.path, key=True)
    return DefaultTolerance(bounds_of(given, unit), given.get("axes", "fixed"), unit, where)
