"""Function tasks in files: CSV with the columns input_deg and output_deg, or a [function] in TOML
and JSON.

E104 not a number                  E106 a row of the wrong length
E107 a key that is not known       E191, E192, E194 as `function_options` says
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import Any, Final

import numpy as np

from burmester.errors import InputError
from burmester.functions.function_task import FunctionTask
from burmester.io.reading.file_content import decode_text
from burmester.io.reading.functions.function_kind import ANGLE_COLUMNS, header
from burmester.io.reading.functions.function_options import (
    FunctionSettings,
    task_of_function,
    task_of_pairs,
)
from burmester.io.reading.pose_table import Source, plain_number, shown

__all__ = ["read_function", "task_of_tree"]

WEIGHT: Final = "weight"
KEYS: Final = (
    "expression", "x", "input_deg", "output_deg", "opposite", "pairs", "spacing", "minimax",
    "input_phase_deg", "output_phase_deg", "ground", "transmission_deg", "link_ratio",
)  # fmt: skip
PAIR_KEYS: Final = ("input_deg", "output_deg", "weight")


def read_function(
    data: bytes,
    path: str,
    settings: FunctionSettings = FunctionSettings(),  # noqa: B008  frozen
) -> FunctionTask:
    """The function task in the bytes of a file.

    settings: of options; what the file states as well is refused (E194).
    """
    label = "<stdin>" if path == "-" else os.fspath(path)
    text, _ = decode_text(data)
    source, suffix = Source(label, text), PurePath(path).suffix.lower()
    try:
        if suffix == ".toml":
            return task_of_tree(_toml(source), settings)
        if suffix == ".json" or text.lstrip().startswith("{"):
            return task_of_tree(_json(source), settings)
        return _csv(source, settings)
    except InputError as error:
        error.where = error.where or label
        raise


# --- CSV


def _csv(source: Source, settings: FunctionSettings) -> FunctionTask:
    first, names, separator = header(source.text)
    lines = source.text.split("\n")
    starts = np.cumsum([0, *(len(line) + 1 for line in lines)]).tolist()
    head = source.where(starts[first], len(lines[first]))
    roles: dict[str, tuple[int, str]] = {}
    for column, name in enumerate(names):
        found = ANGLE_COLUMNS.fullmatch(name)
        if found is None and name != WEIGHT and not name.startswith("#"):
            raise InputError(
                "E107",
                f"the column {shown(name)} is not known here",
                where=head,
                help="the columns of a function are input_deg, output_deg and, if wanted, weight; "
                f"name it `#{name}` to have it ignored",
            )
        role = found[1] if found else name
        if role in roles:
            raise InputError(
                "E108", f"two columns for {role}", where=head, help="delete one of the two columns"
            )
        if not name.startswith("#"):
            roles[role] = (column, found[2] if found else "")
    for needed in ("input", "output"):
        if needed not in roles:
            raise InputError(
                "E105",
                f"the column of the {needed} is missing",
                where=head,
                help=f"add a column {needed}_deg with the angles of the {needed} link",
            )
    columns: dict[str, list[float]] = {role: [] for role in roles}
    places: list[str] = []
    for number, line in enumerate(lines[first + 1 :], start=first + 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        cells = line.split(separator)
        where = source.where(starts[number], len(line))
        if len(cells) != len(names):
            raise InputError(
                "E106",
                f"{len(cells)} cells where the header has {len(names)}",
                where=where,
                help=f"give {len(names)} cells in every row",
            )
        for role, (column, unit) in roles.items():
            plain, mark = plain_number(cells[column].strip(), separator)
            if mark is None:
                raise InputError(
                    "E104",
                    f"{shown(cells[column].strip())} is not a number",
                    where=where,
                    help="write a number with a decimal point, such as 12.5",
                )
            value = float(plain)
            columns[role].append(math.degrees(value) if unit == "rad" else value)
        places.append(where)
    weights = np.array(columns[WEIGHT]) if WEIGHT in columns else None
    _require_weights(weights, head)
    inputs, outputs = np.array(columns["input"]), np.array(columns["output"])
    return task_of_pairs(inputs, outputs, weights, settings, where=places.__getitem__)


# --- TOML and JSON


def _toml(source: Source) -> Any:
    import tomllib

    try:
        return tomllib.loads(source.text).get("function")
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(
            "E109", "this is not TOML", why=str(error), help="correct the file there"
        ) from None


def _json(source: Source) -> Any:
    try:
        tree = json.loads(source.text)
    except (ValueError, RecursionError) as error:
        raise InputError(
            "E109", "this is not JSON", why=str(error), help="correct the file there"
        ) from None
    return (
        tree.get("task", tree).get("function") if isinstance(tree.get("task", {}), dict) else None
    )


def task_of_tree(tree: Any, settings: FunctionSettings = FunctionSettings()) -> FunctionTask:  # noqa: B008
    """The task of the table [function], with settings of options beside it."""
    if not isinstance(tree, Mapping):
        raise InputError(
            "E105",
            "there is no table [function]",
            help="`burmester new log-generator` writes a file that has one",
        )
    for key in tree:
        if key not in KEYS:
            raise InputError(
                "E107",
                f"[function] has an unknown key {shown(key)}",
                help=f"the keys are {', '.join(KEYS)}",
            )
    stated = FunctionSettings(
        _number(tree, "input_phase_deg"),
        _number(tree, "output_phase_deg"),
        _number(tree, "ground") or 1.0,
        _flag(tree, "minimax"),
        _number(tree, "transmission_deg"),
        _number(tree, "link_ratio"),
    )
    given = {n: v for n, v in settings._asdict().items() if v != FunctionSettings()._asdict()[n]}
    merged = stated._replace(**given)
    pairs = tree.get("pairs")
    expression = tree.get("expression")
    if expression is None:
        return _tree_pairs(pairs, merged)
    if not isinstance(expression, str):
        raise _wrong("expression", expression, 'a text, such as "log10(x)"')
    ends = tree.get("x")
    if not (isinstance(ends, Sequence) and len(ends) == 2 and all(map(_is_number, ends))):
        raise _wrong("x", ends, "the two ends of its range, such as [1, 2]")
    spacing = tree.get("spacing")
    if spacing not in (None, "chebyshev", "even"):
        raise _wrong("spacing", spacing, '"chebyshev" or "even"')
    if isinstance(pairs, list):
        raise _wrong("pairs", pairs, "the number of pairs to be taken from the expression")
    if pairs is not None and (not isinstance(pairs, int) or isinstance(pairs, bool)):
        raise _wrong("pairs", pairs, "a whole number, such as 5")
    for key in ("input_deg", "output_deg"):
        if key not in tree:
            raise _wrong(key, None, "the range of that link in degrees, such as 60")
    return task_of_function(
        expression,
        (float(ends[0]), float(ends[1])),
        _number(tree, "input_deg") or 0.0,
        _number(tree, "output_deg") or 0.0,
        pairs=pairs,
        spacing=spacing,
        opposite=_flag(tree, "opposite"),
        settings=merged,
        source=Source("expression", expression),
    )


def _tree_pairs(pairs: Any, settings: FunctionSettings) -> FunctionTask:
    wanted = "a list of pairs in degrees, such as [[0, 0], [30, 20], [60, 50]], or an expression"
    if not isinstance(pairs, list) or not pairs:
        raise _wrong("pairs", pairs, wanted)
    rows = []
    for pair in pairs:
        if isinstance(pair, Mapping) and set(pair) <= set(PAIR_KEYS) and "input_deg" in pair:
            row = [pair.get("input_deg"), pair.get("output_deg"), pair.get("weight", 1.0)]
        elif isinstance(pair, list) and len(pair) in (2, 3):
            row = [*pair, 1.0][:3]
        else:
            raise _wrong("pairs", pair, wanted)
        if not all(map(_is_number, row)):
            raise _wrong("pairs", pair, wanted)
        rows.append([float(each) for each in row])
    inputs, outputs, weights = np.array(rows).T
    plain = bool((weights == 1).all())
    _require_weights(weights, None)
    return task_of_pairs(inputs, outputs, None if plain else weights, settings)


def _require_weights(weights: Any, where: str | None) -> None:
    if weights is not None and not ((weights >= 0).all() and (weights > 0).any()):
        raise InputError(
            "E191",
            "a weight is below zero, or all are zero",
            where=where,
            help="give weights above zero, or leave them out",
        )


def _is_number(value: Any) -> bool:
    try:
        return (
            isinstance(value, int | float)
            and not isinstance(value, bool)
            and math.isfinite(float(value))
        )
    except OverflowError:
        return False


def _number(tree: Mapping[str, Any], key: str) -> float | None:
    value = tree.get(key)
    if value is None:
        return None
    if not _is_number(value):
        raise _wrong(key, value, "a number")
    return float(value)


def _flag(tree: Mapping[str, Any], key: str) -> bool:
    value = tree.get(key, False)
    if not isinstance(value, bool):
        raise _wrong(key, value, "true or false")
    return value


def _wrong(key: str, value: Any, wanted: str) -> InputError:
    message = (
        f"[function] has no {key}" if value is None else f"{key} in [function] is {shown(value)}"
    )
    return InputError("E191", message, help=f"give {wanted}")
