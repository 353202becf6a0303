"""Function tasks in files: tables with the columns input_deg and output_deg, or a [function] in
TOML and JSON.

E101 to E108 as `pair_table` says    E109 not TOML or JSON
E107 a key that is not known         E191, E192, E194 as `function_options` says
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
from burmester.io.reading.file_content import is_parquet, require_moderate
from burmester.io.reading.functions.function_kind import source_of
from burmester.io.reading.functions.function_options import (
    KEPT,
    FunctionSettings,
    task_of_function,
    task_of_pairs,
)
from burmester.io.reading.functions.pair_table import (
    read_pair_parquet,
    read_pair_text,
    require_weights,
)
from burmester.io.reading.pose_table import Source, held_float, shown

__all__ = ["read_function", "settings_of_tree", "task_of_tree"]

SETTINGS: Final = (*FunctionSettings._fields[:-1], *(each.name for each in KEPT))
KEYS: Final = (
    "expression", "x", "input_deg", "output_deg", "opposite", "pairs", "spacing", *SETTINGS,
)  # fmt: skip
PAIR_KEYS: Final = ("input_deg", "output_deg", "weight")


def read_function(
    data: bytes,
    path: str,
    settings: FunctionSettings = FunctionSettings(),  # noqa: B008  frozen
    sheet: str | None = None,
) -> FunctionTask:
    """The function task in the bytes of a file.

    settings: of options; what the file states as well is refused (E194).
    sheet: of a workbook, by its name or number.
    """
    label = "<stdin>" if path == "-" else os.fspath(path)
    suffix = PurePath(path).suffix.lower()
    try:
        if is_parquet(data):
            return read_pair_parquet(label, data, settings)
        source = source_of(data, path, sheet)
        require_moderate(source.text, tree=suffix in (".toml", ".json"))
        if source.sheet is None and suffix == ".toml":
            return task_of_tree(_toml(source), settings)
        if source.sheet is None and (suffix == ".json" or source.text.lstrip().startswith("{")):
            return task_of_tree(_json(source), settings)
        return read_pair_text(source, settings)
    except InputError as error:
        error.where = error.where or label
        raise


# --- TOML and JSON


def _toml(source: Source) -> Any:
    import tomllib

    try:
        return tomllib.loads(source.text, parse_float=held_float).get("function")
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(
            "E109", "this is not TOML", why=str(error), help="correct the file there"
        ) from None


def _json(source: Source) -> Any:
    try:
        tree = json.loads(source.text, parse_float=held_float)
    except (ValueError, RecursionError) as error:
        raise InputError(
            "E109", "this is not JSON", why=str(error), help="correct the file there"
        ) from None
    return (
        tree.get("task", tree).get("function") if isinstance(tree.get("task", {}), dict) else None
    )


def settings_of_tree(tree: Any, *, known: Sequence[str] = SETTINGS) -> FunctionSettings:
    """The settings of a table [function] beside its pairs; raises E107 for a key that is unknown.

    known: the keys that may stand there.
    """
    if not isinstance(tree, Mapping):
        raise InputError(
            "E105",
            "there is no table [function]",
            help="`burmester new log-generator` writes a file that has one",
        )
    for key in tree:
        if key not in known:
            raise InputError(
                "E107",
                f"[function] has an unknown key {shown(key)}",
                help=f"the keys are {', '.join(known)}",
            )
    read: dict[str, Any] = {"minimax": _flag, "types": _names}
    stated = {k: read.get(k, _number)(tree, k) for k in SETTINGS if tree.get(k) is not None}
    asked = {each.name: stated.pop(each.name) for each in KEPT if each.name in stated}
    return FunctionSettings(**stated, asked=asked)


def task_of_tree(tree: Any, settings: FunctionSettings = FunctionSettings()) -> FunctionTask:  # noqa: B008
    """The task of the table [function], with settings of options beside it."""
    stated = settings_of_tree(tree, known=KEYS)
    given = {n: v for n, v in settings._asdict().items() if v != FunctionSettings()._asdict()[n]}
    merged = stated._replace(**{**given, "asked": {**stated.asked, **settings.asked}})
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
    require_weights(weights, None)
    return task_of_pairs(inputs, outputs, None if plain else weights, settings)


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


def _names(tree: Mapping[str, Any], key: str) -> frozenset[str] | None:
    value = tree.get(key)
    if value is None:
        return None
    names = [value] if isinstance(value, str) else value
    if not (isinstance(names, list) and names and all(isinstance(each, str) for each in names)):
        raise _wrong(key, value, 'a list of types, such as ["double-rocker"]')
    return frozenset(names)


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
