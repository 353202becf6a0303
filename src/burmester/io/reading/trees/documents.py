"""Tasks in JSON and TOML: texts as trees, whose numbers keep the digits they are printed with.

`burmester.io.reading.trees.pose_tree` lists the keys of the trees.  The errors are those that
`burmester.io.reading.poses` lists.
"""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from typing import Any

from burmester.errors import InputError
from burmester.io.reading.pose_table import PoseTable, Source, held_float, shown
from burmester.io.reading.trees.locations import LONG, SHORT, UNCLOSED, Document, duplicate_key

__all__ = ["read_json", "read_toml"]

MAX_KEYS = 1000  # keys of a table, and tables: no task has as many
MAX_KEY_PARTS = 100  # parts of a dotted TOML key; the parsing time grows as their square
_PART = rf"(?:[\w-]++|{SHORT})"
_HEAD_OR_KEY = re.compile(  # the lines of TOML in which tables and keys begin
    r"^[ \t]*(?:(\[\[?[^][,\n]*\]\]?)[ \t]*(?:#|$)|[\w\"'.-][^=\n]*=)", re.MULTILINE
)
_KEYS = re.compile(rf"{LONG}|#[^\n]*+|({_PART}(?:[ \t]*\.[ \t]*{_PART})*)|{UNCLOSED}")


def read_json(source: Source) -> PoseTable:
    """A list of poses, an object with "poses", or what `--json` prints; raises E103 to E110."""

    def refuse(constant: str) -> Any:
        tokens = re.finditer(r'"[^"\\]*(?:\\.[^"\\]*)*"|-?Infinity|NaN', source.text)
        start = next(token.start() for token in tokens if token[0][0] != '"')
        where, help = source.where(start, len(constant)), "give a number, or delete the pose"
        raise InputError("E103", f"{constant} is not a finite number", where=where, help=help)

    def distinct_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        if len(pairs) > MAX_KEYS:
            raise _many_keys(source.label)
        tree = dict(pairs)
        if len(tree) < len(pairs):
            raise _twice(source, pairs)
        return tree

    parse = functools.partial(
        json.loads,
        parse_float=functools.partial(_exact, source),
        parse_int=functools.partial(_exact, source),
        parse_constant=refuse,
        object_pairs_hook=distinct_keys,
    )
    tree = _tree(Document(source, "JSON"), parse)
    from burmester.io.reading.trees.pose_tree import read_tree

    example = '{"angle_unit": "deg", "poses": [[0.5, 2, 30], ...]}'
    return read_tree(tree, Document(source, "JSON"), example)


def read_toml(source: Source, others: tuple[str, ...] = ()) -> PoseTable:
    """`poses = [[x, y, angle], ...]` or tables `[[poses]]`; raises E103 to E110.

    others: names of further tables, which are not looked at.
    """
    import tomllib

    document = Document(source, "TOML", others=others)
    _require_few_keys(source)
    _require_short_keys(source)
    tree = _tree(
        document, functools.partial(tomllib.loads, parse_float=functools.partial(_exact, source))
    )
    _require_narrow(tree, source.label)
    from burmester.io.reading.trees.pose_tree import read_tree

    return read_tree(tree, document, 'angle_unit = "deg" above poses = [[0.5, 2, 30], ...]')


def _require_few_keys(source: Source) -> None:
    """Refuse more keys and tables than a task has, before the parser takes seconds: E107."""
    if source.text.count("=") + source.text.count("[") <= MAX_KEYS:
        return
    heads: set[str] = set()
    keys = 0
    for found in _HEAD_OR_KEY.finditer(source.text):
        keys = 0 if found[1] else keys + 1
        if found[1]:
            heads.add(found[1])
        if max(keys, len(heads)) > MAX_KEYS:
            raise _many_keys(source.where(found.start()))


def _require_narrow(tree: Any, label: str) -> None:
    """The same of a tree, for tables that are written in one line."""
    stack = [tree]
    while stack:
        each = stack.pop()
        if isinstance(each, dict):
            if len(each) > MAX_KEYS:
                raise _many_keys(label)
            stack += each.values()
        elif isinstance(each, list):
            stack += each


def _many_keys(where: str) -> InputError:
    message, why = "there are too many keys", f"a task has no table of more than {MAX_KEYS}"
    return InputError("E107", message, where=where, why=why, help="delete those that are none")


def _require_short_keys(source: Source) -> None:
    """Refuse keys with more parts than the parser handles in seconds: E109."""
    if all(line.count(".") < MAX_KEY_PARTS for line in source.text.split("\n")):
        return
    for found in _KEYS.finditer(source.text):
        if found[1] and found[1].count(".") >= MAX_KEY_PARTS:
            count = len(re.findall(_PART, found[1]))
            if count > MAX_KEY_PARTS:
                where = source.where(found.start(), len(found[1]))
                why = f"at most {MAX_KEY_PARTS} are read, and a task needs no more than three"
                help = "delete the parts that are not needed, with their dots"
                message = f"a key has {count} parts, with dots between them"
                raise InputError("E109", message, where=where, why=why, help=help)


def _tree(document: Document, parse: Callable[[str], Any]) -> Any:
    """The tree that a parser makes of a text, or E109."""
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
            raise _too_long(source) from None
    from burmester.io.reading.trees.syntax_faults import syntax_fault

    fault = syntax_fault(language, source.text, at, report)
    raise InputError(
        "E109",
        f"this is not {language}",
        where=source.where(fault.start, fault.width),
        why=fault.why,
        help=fault.help,
    )


def _too_long(source: Source) -> InputError:
    """E103, for an integer of more digits than are read."""
    from burmester.io.reading.trees.syntax_faults import long_integer

    start, end = long_integer(source.text) or (0, 1)
    message = f"a number of {end - start} digits is not a finite number"
    why = (
        f"{source.text[start : start + 10]}... is beyond 1.8e308, the largest representable number"
    )
    help = "give a number, or delete the pose"
    return InputError("E103", message, where=source.where(start, end - start), why=why, help=help)


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


def _twice(source: Source, pairs: list[tuple[str, Any]]) -> InputError:
    """E108, for an object of JSON in which a key stands twice."""
    known: set[str] = set()
    key = next(key for key, _ in pairs if key in known or known.add(key))  # type: ignore[func-returns-value]
    where, why = None, None
    if found := duplicate_key(source.text):
        (first, _), (start, end) = found
        where = source.where(start, end - start)
        line = source.text.count("\n", 0, first) + 1
        column = first - source.text.rfind("\n", 0, first)
        why = f"it stands at line {line}, column {column} already"
    message = f"the key {shown(key)} stands twice in one object"
    return InputError("E108", message, where=where, why=why, help="delete one of the two")
