"""The usual faults in JSON and TOML: the report of a parser in a designer's words.

A fault is recognised by the parser's report and by the text before and behind the place where it
gave up; the help names the edit that mends it.  Any other is told in the parser's own words.
"""

from __future__ import annotations

import re
from typing import Final, NamedTuple

from burmester.io.reading.trees.locations import LONG, SHORT, Language

MAX_EXCERPT: Final = 40  # characters of the file that a message quotes


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
