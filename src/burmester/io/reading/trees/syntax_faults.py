"""The usual faults in JSON and TOML: the report of a parser in a designer's words.

A fault is recognised by the parser's report and by the text before and behind the place where it
gave up; the help names the edit that mends it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

from burmester.io.reading.trees.locations import STRING, Language, deepest_bracket
from burmester.io.reading.trees.parser_stop import ParserStop, SyntaxFault, excerpt
from burmester.io.reading.trees.syntax_checks import (
    backslash,
    duplicate,
    malformed_number,
    mismatched_bracket,
    other_format,
    unclosed_text,
    unexpected_end,
    unquoted_word,
)

__all__ = ["long_integer", "syntax_fault"]

_INTEGER = re.compile(rf"{STRING}|#[^\n]*+|(?<![\w.+-])([-+]?[0-9][0-9_]{{4300,}})(?![\w.]|\s*=)")


def long_integer(text: str) -> tuple[int, int] | None:
    """The span of an integer in a TOML text that has more digits than Python reads."""
    return next((found.span(1) for found in _INTEGER.finditer(text) if found[1]), None)


def syntax_fault(language: Language, text: str, at: int | None, report: str) -> SyntaxFault:
    """The fault in a text at which a parser gave up.

    at: the index of that place; None where the brackets are nested too deep for the parser.
    report: the parser's own words.
    """
    if at is None:
        depth, at = deepest_bracket(text)
        why = f"too many brackets inside each other: {depth}"
        return SyntaxFault(at, 1, why, "delete the brackets that are not needed")
    if report.startswith("Illegal trailing comma"):  # others point behind it
        at, report = at + 1 + len(text[at + 1 :]) - len(text[at + 1 :].lstrip()), "Expecting value"
    stop = ParserStop(language, text, min(at, len(text)), report)
    for rule in _RULES:
        if found := rule(stop):
            return found
    help = f"correct the {language} there, or save the poses as CSV"
    return SyntaxFault(stop.at, 1, report[:1].lower() + report[1:], help)


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
    last: str = ""  # pattern of the last character before that is no blank
    back: bool = False  # whether that last character is the fault

    def __call__(self, stop: ParserStop) -> SyntaxFault | None:
        if self.language not in ("", stop.language) or not re.match(self.report, stop.report):
            return None
        found = re.match(self.ahead, stop.ahead)
        before = stop.text[stop.at - 1 : stop.at]
        last = stop.text[stop.last : stop.last + 1] if stop.at else ""
        if not found or not re.match(self.before, before) or not re.match(self.last, last):
            return None
        words = [excerpt(found[0]), *(excerpt(each or "") for each in found.groups())]
        start, width = (stop.last, 1) if self.back else (stop.at, len(found[0].rstrip()) or 1)
        return SyntaxFault(start, width, self.why.format(*words), self.help.format(*words))


_QUOTES = "[“”„«»‘’`']"
_NO_COMMA = "there is no comma between this and what stands before it"
_IN_TWO = "a key and its value have a colon between them"
_RULES: tuple[_Rule | Callable[[ParserStop], SyntaxFault | None], ...] = (
    duplicate,
    other_format,
    unclosed_text,
    backslash,
    _Rule("Unterminated", "", "the text that begins here does not end", 'write " at its end'),
    _Rule(
        "Invalid control", r"\n", "a text in quotes goes over the end of a line", r"write \n for it"
    ),
    _Rule("Invalid control", r"\t", "there is a tab in a text in quotes", r"write \t for it"),
    _Rule("Invalid control|Illegal", "", "an invisible character stands here", "delete it"),
    _Rule("", r"//.*|/\*.*|#.*", "JSON has no comments", "delete the comment", "JSON"),
    _Rule("", r"//|/\*", "a comment begins with # in TOML", "write # in place of {0}", "TOML"),
    _Rule(
        "",
        r"[\]}]",
        "nothing follows this comma but {0}",
        "delete the comma",
        "JSON",
        last=",",
        back=True,
    ),
    _Rule(
        "Extra data|Expected newline",
        r"[\]}]",
        "no bracket is open that this {0} could close",
        "delete the {0}",
    ),
    _Rule(
        "Extra data",
        r"[\[{]",
        "a second {0} begins behind the end of the first",
        "write [ before all of it, ] behind, and commas between",
    ),
    _Rule("Extra data", r".*", "this follows the end of the JSON text", "delete it"),
    _Rule("Expecting ':'", r"[=,;]", _IN_TWO, "write : in place of the {0}"),
    _Rule("Expecting ':'", r"\S", _IN_TWO, "write : before this"),
    _Rule("Expecting property", r"[\w.-]+", "the key {0} has no quotes around it", 'write "{0}"'),
    _Rule("Expected newline", ";", "no semicolon ends a line in TOML", "delete the semicolon"),
    _Rule(
        "", ";", "a semicolon does not separate values", "write a comma in place of the semicolon"
    ),
    _Rule("", ",", "nothing stands before this comma", "delete the comma", last=r"[\[{,]"),
    mismatched_bracket,
    _Rule(
        "Expecting ','|Unclosed",
        r'["\'\[{0-9+-]|true|false|null',
        _NO_COMMA,
        "write a comma before this",
        before=r"[\s\]}\"']",
    ),
    _Rule(
        "Unclosed inline", r"[\w-]+(?=\s*=)", _NO_COMMA, "write a comma before this", before=r"\s"
    ),
    _Rule(
        "Expected '='",
        ":",
        "a key and its value have = between them",
        "write = in place of the colon",
    ),
    _Rule(
        "Expected '='", r"\n|$", "no = follows this key", "write = and a value behind it", back=True
    ),
    _Rule(
        "Expected '='",
        r"\S[^=\n]*=",
        "a key of more words than one stands in quotes",
        "write quotes around the whole key",
    ),
    _Rule("Expected '='", r"\S", "a key and its value have = between them", "write = before this"),
    _Rule(
        "Invalid initial|Unclosed inline",
        r"\n",
        "a table in {{ }} is one line in TOML",
        "join this line and the next",
        back=True,
    ),
    _Rule(
        "Invalid value",
        r"\n|#|$",
        "no value follows the =",
        "write a value behind it, or delete the line",
        last="=",
        back=True,
    ),
    _Rule("Invalid statement", "=", "no key stands before this =", "write a key before it"),
    _Rule(
        r"Expected ']]'", r"\]", "a line that begins with [[ ends with ]]", "write ] behind this"
    ),
    _Rule(
        r"Expected ']]'",
        "",
        "a line that begins with [[ ends with ]]",
        "write ]] behind this",
        back=True,
    ),
    _Rule(
        r"Expected ']'",
        "",
        "a line that begins with [ ends with ]",
        "write ] behind this",
        back=True,
    ),
    malformed_number,
    unexpected_end,
    _Rule(
        "Expected newline",
        r"[\w\"'-]+(?=\s*=)",
        "a second key stands on this line",
        "begin a new line before this",
    ),
    unquoted_word,
    _Rule(
        "",
        f"({_QUOTES})([^\n“”„«»‘’`'\"]*){_QUOTES}",
        "text stands in double quotes, not in {1}",
        'write "{2}"',
    ),
    _Rule("", "[−–]", "{0} is a dash, not a minus sign", "write - in its place"),
)
