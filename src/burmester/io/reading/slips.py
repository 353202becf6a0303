"""The usual slips in JSON and TOML: what a parser that gives up says, in a designer's words.

A slip is told by what the parser says and by what stands before and behind the place where it
gave up; the help names the edit that mends it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

from burmester.io.reading.places import LONG, SHORT, STRING, Language, deepest, statement
from burmester.io.reading.table import brief, shown

__all__ = ["Slip", "long_integer", "slip"]


class Slip(NamedTuple):
    """Where a text stops being JSON or TOML, why, and what mends it."""

    start: int
    width: int
    why: str
    help: str


class _Stop(NamedTuple):
    """Where a parser gave up, and what it said."""

    language: Language
    text: str
    at: int
    said: str

    @property
    def ahead(self) -> str:
        return self.text[self.at : self.at + 1000]

    @property
    def last(self) -> int:
        """The place of the last character before it that is no blank."""
        return max(len(self.text[: self.at].rstrip()) - 1, 0)


class _Rule(NamedTuple):
    """A slip by its looks; a blank pattern fits everything.

    {0} and {1} in why and help stand for what `ahead` matches, and for its first group.
    """

    said: str
    ahead: str
    why: str
    help: str
    language: str = ""
    before: str = ""  # the character right before
    last: str = ""  # the last one before that is no blank
    back: bool = False  # whether it is that last character that is at fault

    def __call__(self, stop: _Stop) -> Slip | None:
        if self.language not in ("", stop.language) or not re.match(self.said, stop.said):
            return None
        found = re.match(self.ahead, stop.ahead)
        before = stop.text[stop.at - 1 : stop.at]
        last = stop.text[stop.last : stop.last + 1] if stop.at else ""
        if not found or not re.match(self.before, before) or not re.match(self.last, last):
            return None
        words = [_piece(found[0]), *(_piece(each or "") for each in found.groups())]
        start, width = (stop.last, 1) if self.back else (stop.at, len(found[0].rstrip()) or 1)
        return Slip(start, width, self.why.format(*words), self.help.format(*words))


def _piece(text: str) -> str:
    """A piece of the text as a message holds it, in one line of 40 characters at most."""
    text = text.partition("\n")[0].rstrip()
    return text if len(text) <= 40 else f"{text[:37]}..."


_TOKENS = re.compile(rf"{LONG}|\"{{3}}|'{{3}}|{SHORT}|#[^\n]*+|[\[\]{{}}]|[\"']")
_INTEGER = re.compile(rf"{STRING}|#[^\n]*+|(?<![\w.+-])([-+]?[0-9][0-9_]{{4300,}})(?![\w.]|\s*=)")
_NUMBER = re.compile(r"[-+]?(?=\.?[0-9])[\w.]+(?:(?<=[eE])[-+][0-9]+)?")
_PARTS = re.compile(r"([-+]?)0*+([0-9]*+)\.?([0-9]*+)((?:[eE][-+]?[0-9]++)?)")
_WORD = re.compile(r"[^\W\d][\w-]*")
_CONSTANTS = {"true": "true", "false": "false", "none": "null", "null": "null", "undefined": "null"}


def long_integer(text: str) -> tuple[int, int] | None:
    """Where an integer of more digits than are read stands in a TOML text."""
    return next((found.span(1) for found in _INTEGER.finditer(text) if found[1]), None)


def slip(language: Language, text: str, at: int | None, said: str) -> Slip:
    """What is wrong at the place where a parser gave up, and what it said then.

    at: that place; None where brackets inside each other are too many for the parser.
    """
    if at is None:
        depth, at = deepest(text)
        why = f"too many brackets inside each other: {depth}"
        return Slip(at, 1, why, "delete the brackets that nothing needs")
    if said.startswith("Illegal trailing comma"):  # others point behind it
        at, said = at + 1 + len(text[at + 1 :]) - len(text[at + 1 :].lstrip()), "Expecting value"
    stop = _Stop(language, text, min(at, len(text)), said)
    for rule in _RULES:
        if found := rule(stop):
            return found
    help = f"correct the {language} there, or save the poses as CSV"
    return Slip(stop.at, 1, said[:1].lower() + said[1:], help)


# The slips that more than a pattern tells -----------------------------------------------------


def _something_else(stop: _Stop) -> Slip | None:
    """A file of another format."""
    text = stop.text
    start = len(text) - len(text.lstrip())
    line = text[start : start + 1000].partition("\n")[0].rstrip()
    cells = [cell.strip() for cell in re.split(r"[,;\t]", line)]
    plain = [cell for cell in cells if re.fullmatch(r"\w*|[-+.]?[0-9][-+.0-9eE]*", cell)]
    if len(cells) > 2 and len(plain) == len(cells):
        why = f"the first line, {shown(line)}, looks like CSV"
        return Slip(start, len(line), why, "rename the file so that it ends in .csv")
    if stop.language == "TOML" and re.match(r"\{|\[\s*(\{|\[[\s\d.,+-]*\])", text[start:]):
        why = "it begins with a bracket, as JSON does"
        return Slip(start, 1, why, "rename the file so that it ends in .json")
    if stop.language == "JSON" and re.match(r"\[\[?[a-z_]+\]\]?\s*\n|[\w.]+ *=", text[start:]):
        why = "it looks like TOML"
        return Slip(start, len(line), why, "rename the file so that it ends in .toml")
    return None


def _twice(stop: _Stop) -> Slip | None:
    """A key or a table of TOML that stands twice."""
    if not re.match("Cannot|Duplicate", stop.said):
        return None
    text = stop.text
    start, end = statement(text, stop.at) or (stop.at, stop.at + 1)
    name = _piece(text[start:end])
    if text[text.rfind("\n", 0, start) + 1 : start].lstrip().startswith("["):
        help = "delete one of the two"
        if stop.said.startswith("Cannot declare"):
            help += f", or write [[{name}]] each time for a list of tables"
        return Slip(start, end - start, f"the table {name} is there already", help)
    if stop.said.startswith("Duplicate inline") and (key := re.search(r"'(.*)'", stop.said)):
        why, start = f"the key {_piece(key[1])} stands twice", text.rfind(key[1], 0, stop.at)
        return Slip(start, len(key[1]), why, "delete one of the two")
    why = f"the key {name} stands twice in one table"
    return Slip(start, end - start, why, "delete one of the two")


def _text_not_closed(stop: _Stop) -> Slip | None:
    """A text in quotes without an end."""
    if stop.language == "JSON" or not re.match("Unterminated|Expected \"'|Illegal", stop.said):
        return None
    if stop.said.startswith("Illegal") and stop.ahead[:1] not in ("\n", ""):
        return None
    for found in _TOKENS.finditer(stop.text):
        if found[0] in ("'", '"', 3 * "'", 3 * '"'):
            quote, start = found[0], found.start()
            line = "" if len(quote) == 3 else " on its line"
            why = f"the text that begins here does not end{line}"
            return Slip(start, len(quote), why, f"write {quote} at its end")
    return None


def _backslash(stop: _Stop) -> Slip | None:
    """A path of files, say."""
    if not re.match(r"Invalid \\|Unescaped|Invalid hex|Escaped", stop.said):
        return None
    start = stop.text.rfind("\\", 0, stop.at + 1)
    why = r"a backslash in a text in double quotes begins an escape such as \n"
    return Slip(start, 1, why, r"write \\ for the backslash itself")


def _other_bracket(stop: _Stop) -> Slip | None:
    """[ closed by } or { by ]."""
    still, closing = _open(stop.text[: stop.at]), stop.ahead[:1]
    if closing not in ("]", "}") or not still or not re.match("Expecting ','|Unclosed", stop.said):
        return None
    need = {"[": "]", "{": "}"}[still[-1]]
    why = f"the bracket to be closed is a {still[-1]}"
    return Slip(stop.at, 1, why, f"write {need} in place of the {closing}")


def _number(stop: _Stop) -> Slip | None:
    """A number that is none in the language: .5, 1., +1, 01, 1_000, 1,5 or 5mm."""
    text, start = stop.text, stop.at
    while start and (text[start - 1].isalnum() or text[start - 1] in "._+-"):
        start -= 1
    found = _NUMBER.match(text, start)
    if not found or found.end() < stop.at:
        return None
    token, behind = found[0], text[found.end() : found.end() + 40]
    comma = re.match(r",([0-9]+)", behind)
    if stop.language == "TOML" and comma and stop.at == found.end():
        why = f"the comma in {_piece(token + comma[0])} is no decimal mark"
        help = brief(f"write {token}.{comma[1]}", "write a decimal point in its place")
        return Slip(start, len(token + comma[0]), why, help)
    simple = _PARTS.fullmatch(token.replace("_", ""))
    if not simple:
        why, help = (
            f"{shown(token)} is not a number in {stop.language}",
            ("write digits with at most a decimal point and an exponent, such as -12.5 or 3e-4"),
        )
        return Slip(start, len(token), why, help)
    if behind[:1] in ("°", "%"):
        why = f"a number is written without {behind[0]}"
        return Slip(found.end(), 1, why, f"delete the {behind[0]}")
    sign, whole, digits, exponent = simple.groups()
    plain = f"{sign.strip('+')}{whole or '0'}{'.' * bool(digits)}{digits}{exponent}"
    if plain == token:
        return None
    why = f"{_piece(token)} is not how {stop.language} writes a number"
    help = brief(f"write {plain}", "write digits with at most a decimal point and an exponent")
    return Slip(start, len(token), why, help)


def _cut_off(stop: _Stop) -> Slip | None:
    """The end of a text that comes too early."""
    if stop.ahead.strip():
        return None
    still = _open(stop.text)
    if (
        stop.text[stop.last : stop.last + 1] in tuple("=:,")
        or not still
        or stop.said.startswith("Expecting ':'")
    ):
        why = "the text ends where something belongs"
        return Slip(stop.last, 1, why, "write what is missing behind this")
    closing = still[::-1].translate(str.maketrans("[{", "]}"))
    why = f"the text ends where {still[:20]} is still open"
    return Slip(stop.last, 1, why, f"write {closing[:20]} behind this")


def _word(stop: _Stop) -> Slip | None:
    """True, None, and text without quotes."""
    if not _WORD.match(stop.ahead):
        return None
    start = stop.at
    while start and (stop.text[start - 1].isalnum() or stop.text[start - 1] == "_"):
        start -= 1
    word = _WORD.match(stop.text, start)
    if not word:
        return None
    width = len(word[0])
    if word[0].lower() in ("nan", "inf", "infinity"):
        why = f"{word[0]} is not a finite number"
        return Slip(start, width, why, "give a number, or delete the pose")
    plain = _CONSTANTS.get(word[0].lower(), "")
    if plain == "null" and stop.language == "TOML":
        return Slip(start, width, f"TOML has no {word[0]}", "delete the key with it")
    if plain and plain != word[0]:
        why = f"{word[0]} is spelt {plain} in {stop.language}"
        return Slip(start, width, why, f"write {plain}")
    why = f"the text {_piece(word[0])} has no quotes around it"
    help = brief(f'write "{word[0]}"', "write quotes around it")
    return None if plain else Slip(start, width, why, help)


def _open(text: str) -> str:
    """The brackets that a text leaves open, the outermost first."""
    still = ""
    for token in _TOKENS.findall(text):
        if token in ("[", "{"):
            still += token
        elif token in ("]", "}"):
            still = still[:-1]
    return still


_QUOTES = "[“”„«»‘’`']"
_NO_COMMA = "there is no comma between this and what stands before it"
_IN_TWO = "a key and its value have a colon between them"
_RULES: tuple[_Rule | Callable[[_Stop], Slip | None], ...] = (
    _twice,
    _something_else,
    _text_not_closed,
    _backslash,
    _Rule("Unterminated", "", "the text that begins here does not end", 'write " at its end'),
    _Rule("Invalid control", r"\n", "a text in quotes goes over a line's end", r"write \n for it"),
    _Rule("Invalid control", r"\t", "there is a tab in a text in quotes", r"write \t for it"),
    _Rule("Invalid control|Illegal", "", "a sign that cannot be seen stands here", "delete it"),
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
    _Rule("", ";", "no semicolon parts values", "write a comma in place of the semicolon"),
    _Rule("", ",", "nothing stands before this comma", "delete the comma", last=r"[\[{,]"),
    _other_bracket,
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
        "what stands in {{ }} is one line in TOML",
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
    _number,
    _cut_off,
    _Rule(
        "Expected newline",
        r"[\w\"'-]+(?=\s*=)",
        "a second key stands on this line",
        "begin a new line before this",
    ),
    _word,
    _Rule(
        "",
        f"({_QUOTES})([^\n“”„«»‘’`'\"]*){_QUOTES}",
        "text stands in double quotes, not in {1}",
        'write "{2}"',
    ),
    _Rule("", "[−–]", "{0} is a dash, not a minus sign", "write - in its place"),
)
