"""Function tasks in files: columns input_deg and output_deg, or a [function] in TOML and JSON.

E102 no rows                         E106 a row of the wrong length
E103 and E104 not a number           E107 a column or key that is not known
E105 a column is missing             E108 a column twice
E109 not TOML or JSON                E191, E192, E194 as `function_options` says
"""

from __future__ import annotations

import math
import os
from dataclasses import replace
from functools import partial
from pathlib import PurePath
from typing import Final

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.file_content import require_moderate
from burmester.io.reading.functions.function_options import (
    KEPT,
    NOTHING,
    Stated,
    task_of_function,
    task_of_pairs,
)
from burmester.io.reading.pose_table import PAIR, Source, shown
from burmester.io.reading.tables.cell_numbers import CellNumbers
from burmester.io.reading.tables.header import read_header
from burmester.io.reading.tables.pose_rows import require_width
from burmester.io.reading.tables.text_source import text_source
from burmester.io.reading.trees.documents import json_tree, toml_tree
from burmester.io.reading.trees.node import (
    NOT_NEGATIVE,
    NUMBER,
    Field,
    Fields,
    Node,
    table_schema,
    words,
)
from burmester.io.reading.trees.specification_tree import REQUIREMENT_FIELDS
from burmester.numerics.arrays import FloatArray
from burmester.tasks.function_task import FunctionTask

WEIGHT: Final = "weight"


def read_pairs(source: Source, settings: Stated) -> FunctionTask:
    """The task in a header and a pair a line."""
    grid = read_header(source, None)
    indices, units = grid.columns.indices, grid.columns.units
    for role, index in indices.items():
        if role not in (*PAIR, WEIGHT) or (role in PAIR and units[role] is None):
            raise InputError(
                "E107",
                f"the column {shown(grid.names[index])} is not known here",
                where=grid.where,
                help="the columns of a function are input_deg, output_deg and, if wanted, weight; "
                f"name it `#{grid.names[index]}` to have it ignored",
            )
    numbers = CellNumbers(grid.separator, stored=source.sheet is not None)
    values: dict[str, list[float]] = {role: [] for role in indices}
    rows = list(grid.rows())
    for number, row in enumerate(rows, start=1):
        require_width(row, grid, number)
        for role, index in indices.items():
            where, quoted = partial(row.where, index, role), '"' in row.cells[index]
            text = numbers.read(row.value(index), number, where, unit=units[role], quoted=quoted)
            values[role].append(math.degrees(float(text)) if units[role] == "rad" else float(text))
    numbers.require_one_mark()
    inputs, outputs = (np.array(values[role]) for role in PAIR)
    weights = np.array(values[WEIGHT]) if WEIGHT in values else None
    require_weights(weights, grid.where)
    task = task_of_pairs(inputs, outputs, weights, settings, where=lambda k: rows[k].where())
    return replace(task, notes=(*source.notes, *grid.notes, *grid.columns.notes()))


def require_weights(weights: FloatArray | None, where: str | None) -> None:
    """Refuse weights below zero, and weights that are all zero: E191."""
    if weights is not None and not ((weights >= 0).all() and (weights > 0).any()):
        raise InputError(
            "E191",
            "a weight is below zero, or all are zero",
            where=where,
            help="give weights above zero, or leave them out",
        )


_NUMBER: Final = Field(Node.number)
_SETTINGS: Final[Fields] = {
    "input_phase_deg": _NUMBER,
    "output_phase_deg": _NUMBER,
    "ground": _NUMBER,
    "minimax": Field(Node.flag),
    **{each.name: REQUIREMENT_FIELDS[each.name] for each in KEPT},
}
_PAIRS_HELP = (
    "give a list of pairs in degrees, such as [[0, 0], [30, 20], [60, 50]], or an expression and "
    "the number of pairs to be taken from it, such as 5"
)


def read_function(
    data: bytes,
    path: str,
    settings: Stated = NOTHING,
    sheet: str | None = None,
) -> FunctionTask:
    """The function task in the bytes of a file.

    settings: of options, in place of what the file states.
    sheet: of a workbook, by its name or number.
    """
    label = "<stdin>" if path == "-" else os.fspath(path)
    suffix = PurePath(path).suffix.lower()
    try:
        source = text_source(data, path, sheet)
        require_moderate(source.text, tree=suffix in (".toml", ".json"))
        toml = suffix == ".toml"
        if source.sheet is None and (
            toml or suffix == ".json" or source.text.lstrip().startswith("{")
        ):
            tree, document = (toml_tree if toml else json_tree)(source)
            if isinstance(tree, dict) and isinstance(tree.get("task"), dict):
                tree, document = tree["task"], document._replace(root=("task",))
            return task_of(Node(document, (), tree), settings)
        return read_pairs(source, settings)
    except InputError as error:
        error.where = error.where or label
        raise


def settings_of(whole: Node) -> Stated:
    """The settings in a table [function] without pairs; raises E105, E107 and E191."""
    return _stated(whole, _SETTINGS)


def task_of(whole: Node, settings: Stated = NOTHING) -> FunctionTask:
    """The task of the table [function], with settings of options beside it."""
    stated = {**_stated(whole, _FIELDS), **settings}
    node, pairs = whole.at("function"), stated.get("pairs")
    if "expression" not in stated:
        if not isinstance(pairs, list) or not pairs:
            raise node.fault("E191", "has no pairs", _PAIRS_HELP)
        inputs, outputs, weights = np.array(pairs).T
        require_weights(weights, None)
        return task_of_pairs(inputs, outputs, None if (weights == 1).all() else weights, stated)
    if isinstance(pairs, list):
        raise node.at("pairs").fault("E191", "is a list beside an expression", _PAIRS_HELP)
    for key in ("x", "input_deg", "output_deg"):
        if key not in stated:
            raise node.fault("E191", f"has no {key}", _FIELDS[key].help)
    return task_of_function(stated, Source("expression", stated["expression"]))


def _stated(whole: Node, fields: Fields) -> Stated:
    """What the table [function] states; raises E105, E107, and E191 for what does not fit."""
    if not isinstance(whole.value, dict) or not isinstance(whole.value.get("function"), dict):
        help = "`burmester new log-generator` writes a file that has one"
        raise InputError("E105", "there is no table [function]", help=help)
    try:
        stated = whole.at("function", f"the keys are {', '.join(fields)}").table(fields)
        return {key: getattr(each, "value", each) for key, each in stated.items()}
    except InputError as error:
        if error.code in ("E103", "E104", "E105", "E106"):
            error.code = "E191"
        raise


PAIR_KEYS: Final = ("input_deg", "output_deg")
_PAIR_FIELDS: Final[Fields] = {
    **dict.fromkeys(PAIR_KEYS, _NUMBER),
    "weight": Field(Node.number, schema=NOT_NEGATIVE),
}


def _pairs(node: Node) -> list[list[float]] | int:
    """The pairs with their weights, or their number."""
    if isinstance(node.value, list):
        return [_pair(each) for each in node.items()]
    if (number := node.number()) != round(number):
        raise node.wrong("not a whole number")
    return round(number)


def _pair(node: Node) -> list[float]:
    if not isinstance(node.value, dict):
        return [*(each.number() for each in node.items(2, 3)), 1.0][:3]
    given = node.table(_PAIR_FIELDS)
    for key in PAIR_KEYS:
        if key not in given:
            raise node.missing(key)
    return [given["input_deg"], given["output_deg"], given.get("weight", 1.0)]


SPACINGS: Final = ("chebyshev", "even")
# A pair in a list, with a weight if wanted, or in a table.
_PAIR: Final = table_schema(_PAIR_FIELDS, required=[*PAIR_KEYS]) | {
    "type": ["array", "object"],
    "items": NUMBER,
    "minItems": 2,
    "maxItems": 3,
}
_FIELDS: Final[Fields] = {
    "expression": Field(Node.text, 'give a text, such as "log10(x)"'),
    "x": Field(Node.pair, "give the two ends of its range, such as [1, 2]"),
    **dict.fromkeys(
        PAIR_KEYS,
        Field(Node.number, "give the range of that link in degrees, such as 60"),
    ),
    "opposite": Field(Node.flag),
    "pairs": Field(_pairs, _PAIRS_HELP, {"type": ["integer", "array"], "items": _PAIR}),
    "spacing": Field(partial(Node.word, known=SPACINGS), "", words(SPACINGS)),
    **_SETTINGS,
}
FUNCTION_SCHEMA: Final = table_schema(
    _FIELDS, description="A function of angles, in place of poses."
)
