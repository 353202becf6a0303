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
from typing import Any, Final, NamedTuple

from burmester.errors import InputError
from burmester.io.reading.pose_table import PoseTable, Source, held_float, shown
from burmester.io.reading.trees.locations import LONG, SHORT, Document, Language, duplicate_key

# A dotted key of TOML with so many parts takes the parser seconds: the square of their number.
_LONG_KEY: Final = re.compile(r"(?:[\w\"'-]{1,99}[ \t]*\.[ \t]*){100}")


MAX_EXCERPT: Final = 40  # characters of the file that a message quotes


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


class SyntaxFault(NamedTuple):
    """A fault in a text that is not JSON or TOML: its span, why, and the edit that helps."""

    start: int
    width: int
    why: str
    help: str


class _Rule(NamedTuple):
    """A fault recognised by patterns; a blank pattern fits everything.

    {0} and {1} in why and help stand for what `ahead` matches, and for its first group.
    """

    report: str
    ahead: str
    why: str
    help: str
    language: str = ""
    before: str = ""  # pattern of the character right before
    last: str = ""  # pattern of the last character before that is no blank; it is the fault

    def __call__(self, language: Language, text: str, at: int, report: str) -> SyntaxFault | None:
        found = re.match(self.ahead, text[at : at + 1000])
        last = len(text[:at].rstrip()) - 1
        if (
            found is None
            or self.language not in ("", language)
            or not re.match(self.report, report)
            or not re.match(self.before, text[max(at - 1, 0) : at])
            or not re.match(self.last, text[max(last, 0) : last + 1])
        ):
            return None
        words = [_excerpt(each or "") for each in (found[0], *found.groups())]
        start, width = (last, 1) if self.last else (at, len(found[0].rstrip()) or 1)
        return SyntaxFault(start, width, self.why.format(*words), self.help.format(*words))


_QUOTES: Final = "[“”„«»‘’`']"
_RULES: Final = (
    _Rule("Invalid control", r"\n", "a text in quotes goes over a line's end", r"write \n for it"),
    _Rule("Invalid control", r"\t", "there is a tab in a text in quotes", r"write \t for it"),
    _Rule("", r"//.*|/\*.*|#.*", "JSON has no comments", "delete the comment", "JSON"),
    _Rule("", r"//|/\*", "a comment begins with # in TOML", "write # in place of {0}", "TOML"),
    _Rule("", r"[\]}]", "nothing follows this comma but {0}", "delete the comma", "JSON", last=","),
    _Rule(
        "",
        f"{_QUOTES}([^\n“”„«»‘’`'\"]*){_QUOTES}",
        "a text stands in double quotes",
        'write "{1}"',
    ),
    _Rule("Expecting property", r"[\w.-]+", "the key {0} has no quotes around it", 'write "{0}"'),
    _Rule(
        "Expecting ','|Unclosed",
        r'["\'\[{0-9+-]|true|false|null|[\w-]+(?=\s*=)',
        "there is no comma between this and what stands before it",
        "write a comma before this",
        before=r"[\s\]}\"']",
    ),
    _Rule(
        "Expected '='",
        ":",
        "a key and its value have = between them",
        "write = in place of the colon",
    ),
    _Rule(
        "Expected newline",
        r",([0-9]+)",
        "the comma before {1} is no decimal mark",
        "write .{1} in its place",
    ),
    _Rule(
        "Expecting value|Invalid value",
        r"[^\W\d][\w-]*",
        "a text has quotes around it, and true and false have small letters",
        'write "{0}", or true or false',
    ),
)


def syntax_fault(language: Language, text: str, at: int | None, report: str) -> SyntaxFault:
    """The fault in a text at which a parser gave up.

    at: the index of that place; None where the brackets are nested too deep for the parser.
    report: the parser's own words.
    """
    if at is None:
        why = "there are too many brackets inside each other"
        return SyntaxFault(0, 1, why, "delete the brackets that are not needed")
    if report.startswith("Illegal trailing comma"):  # others point behind it
        at, report = at + 1 + len(text[at + 1 :]) - len(text[at + 1 :].lstrip()), "Expecting value"
    at = min(at, len(text))
    if re.match("Cannot|Duplicate", report):  # of TOML; its line has been read
        start = text.rfind("\n", 0, max(at - 1, 0)) + 1
        key = re.match(r"[^=\n]*[^=\s]", text[start:])
        why = f"a key or a table stands twice: {report[:1].lower()}{report[1:]}"
        return SyntaxFault(start, len(key[0]) if key else 1, why, "delete one of the two")
    for rule in _RULES:
        if found := rule(language, text, at, report):
            return found
    if not text[at:].strip() and (still := _open(text)):
        closing = still[::-1].translate(str.maketrans("[{", "]}"))[:20]
        why, last = f"the text ends where {still[:20]} is still open", len(text.rstrip()) - 1
        return SyntaxFault(last, 1, why, f"write {closing} behind this")
    help = f"correct the {language} there, or save the poses as CSV"
    return SyntaxFault(at, 1, report[:1].lower() + report[1:], help)


def _open(text: str) -> str:
    """The brackets that a text leaves open, the outermost first."""
    still = ""
    for token in re.findall(rf"{LONG}|{SHORT}|#[^\n]*|[\[\]{{}}]", text):
        if token in ("[", "{"):
            still += token
        elif token in ("]", "}"):
            still = still[:-1]
    return still


def _excerpt(text: str) -> str:
    """The first line of a text as a message quotes it, shortened if it is long."""
    text = text.partition("\n")[0].rstrip()
    return text if len(text) <= MAX_EXCERPT else f"{text[: MAX_EXCERPT - 3]}..."
