"""Tasks in JSON and TOML: texts as trees, whose numbers keep the digits they are printed with.

`burmester.io.reading.trees.pose_tree` lists the keys of the trees.  The errors are those that
`burmester.io.reading.poses` lists.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from functools import partial
from typing import Any, Final

from burmester.errors import InputError
from burmester.io.reading.pose_table import PoseTable, Source, held_float, shown
from burmester.io.reading.trees.locations import Document, duplicate_key
from burmester.io.reading.trees.syntax_faults import syntax_fault

# A dotted key of TOML with so many parts takes the parser seconds: the square of their number.
_LONG_KEY: Final = re.compile(r"(?:[\w\"'-]{1,99}[ \t]*\.[ \t]*){100}")


def read_json(source: Source) -> PoseTable:
    """A list of poses, an object with "poses", or what `--json` prints; raises E103 to E110."""
    from burmester.io.reading.trees.pose_tree import read_tree

    return read_tree(*json_tree(source), '{"angle_unit": "deg", "poses": [[0.5, 2, 30], ...]}')


def read_toml(source: Source, others: tuple[str, ...] = ()) -> PoseTable:
    """`poses = [[x, y, angle], ...]` or tables `[[poses]]`; raises E103 to E110.

    others: names of further tables, which are not looked at.
    """
    from burmester.io.reading.trees.pose_tree import read_tree

    example = 'angle_unit = "deg" above poses = [[0.5, 2, 30], ...]'
    return read_tree(*toml_tree(source, others), example)


def json_tree(source: Source) -> tuple[Any, Document]:
    """The tree in a text in JSON, its numbers as Decimal; raises E103, E108 and E109."""

    def refuse(constant: str) -> Any:
        tokens = re.finditer(r'"[^"\\]*(?:\\.[^"\\]*)*"|-?Infinity|NaN', source.text)
        start = next(token.start() for token in tokens if token[0][0] != '"')
        where, help = source.where(start, len(constant)), "give a number, or delete the pose"
        raise InputError("E103", f"{constant} is not a finite number", where=where, help=help)

    def distinct_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        tree = dict(pairs)
        if len(tree) < len(pairs):
            raise _twice(source, [key for key, _ in pairs])
        return tree

    parse = partial(
        json.loads,
        parse_float=partial(_exact, source),
        parse_int=partial(_exact, source),
        parse_constant=refuse,
        object_pairs_hook=distinct_keys,
    )
    document = Document(source, "JSON")
    return _tree(document, parse), document


def toml_tree(source: Source, others: tuple[str, ...] = ()) -> tuple[Any, Document]:
    """The tree in a text in TOML, its numbers as Decimal or int; raises E103 and E109."""
    import tomllib

    if found := _LONG_KEY.search(source.text):
        where, why = source.where(found.start(), 1), "a task needs no more than three"
        help = "delete the parts that are not needed, with their dots"
        message = "a key has more than 100 parts, with dots between them"
        raise InputError("E109", message, where=where, why=why, help=help)
    document = Document(source, "TOML", others=others)
    return _tree(document, partial(tomllib.loads, parse_float=partial(_exact, source))), document


def _tree(document: Document, parse: Callable[[str], Any]) -> Any:
    source, language = document.source, document.language
    at: int | None = None
    report = ""
    try:
        return parse(source.text)
    except RecursionError:
        pass
    except json.JSONDecodeError as error:
        at, report = error.pos, error.msg
    except ValueError as error:
        report, _, position = str(error).partition(" (at")
        at = len(source.text)
        if found := re.fullmatch(r" line (\d+), column (\d+)\)", position):
            before = source.text.split("\n")[: int(found[1]) - 1]
            at = sum(len(line) + 1 for line in before) + int(found[2]) - 1
        elif not position:  # an integer of more digits than Python reads, in TOML
            digits = re.search(r'(?<![\w"])[-+]?[0-9][0-9_]{4300,}(?![\w"])', source.text)
            start, end = digits.span() if digits else (0, 1)
            message = f"a number of {end - start} digits is not a finite number"
            where, help = source.where(start, end - start), "give a number, or delete the pose"
            raise InputError("E103", message, where=where, help=help) from None
    fault = syntax_fault(language, source.text, at, report)
    where = source.where(fault.start, fault.width)
    raise InputError("E109", f"this is not {language}", where=where, why=fault.why, help=fault.help)


def _exact(source: Source, number: str) -> Decimal:
    """A number with the decimals it is printed with, which a float would forget; raises E103."""
    try:
        held_float(number)
    except InputError as error:
        found = re.search(rf"(?<![\w.]){re.escape(number)}", source.text)
        error.where = source.where(found.start(), len(number)) if found else source.label
        raise
    try:
        return Decimal(number)
    except InvalidOperation:  # its exponent has twenty digits
        return Decimal(float(number))


def _twice(source: Source, keys: list[str]) -> InputError:
    """E108, for an object of JSON in which a key stands twice."""
    key = next(key for k, key in enumerate(keys) if key in keys[:k])
    where, why = None, None
    if found := duplicate_key(source.text):
        (first, _), (start, end) = found
        where = source.where(start, end - start)
        line = source.text.count("\n", 0, first) + 1
        column = first - source.text.rfind("\n", 0, first)
        why = f"it stands at line {line}, column {column} already"
    message = f"the key {shown(key)} stands twice in one object"
    return InputError("E108", message, where=where, why=why, help="delete one of the two")
