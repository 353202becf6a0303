"""Faults of JSON and TOML that take more than one pattern to recognise: a check for each.

A check takes the place at which the parser gave up and returns the fault, or None where it is
another one.
"""

from __future__ import annotations

import re

from burmester.io.reading.pose_table import brief, shown
from burmester.io.reading.trees.locations import LONG, SHORT, last_statement
from burmester.io.reading.trees.parser_stop import ParserStop, SyntaxFault, excerpt

__all__ = [
    "backslash",
    "duplicate",
    "malformed_number",
    "mismatched_bracket",
    "other_format",
    "unclosed_text",
    "unexpected_end",
    "unquoted_word",
]

_TOKENS = re.compile(rf"{LONG}|\"{{3}}|'{{3}}|{SHORT}|#[^\n]*+|[\[\]{{}}]|[\"']")
_NUMBER = re.compile(r"[-+]?(?=\.?[0-9])[\w.]+(?:(?<=[eE])[-+][0-9]+)?")
_PARTS = re.compile(r"([-+]?)0*+([0-9]*+)\.?([0-9]*+)((?:[eE][-+]?[0-9]++)?)")
_WORD = re.compile(r"[^\W\d][\w-]*")
_CONSTANTS = {"true": "true", "false": "false", "none": "null", "null": "null", "undefined": "null"}


def other_format(stop: ParserStop) -> SyntaxFault | None:
    """The file is in another format."""
    text = stop.text
    start = len(text) - len(text.lstrip())
    line = text[start : start + 1000].partition("\n")[0].rstrip()
    cells = [cell.strip() for cell in re.split(r"[,;\t]", line)]
    plain = [cell for cell in cells if re.fullmatch(r"\w*|[-+.]?[0-9][-+.0-9eE]*", cell)]
    if len(cells) > 2 and len(plain) == len(cells):
        why = f"the first line, {shown(line)}, looks like CSV"
        return SyntaxFault(start, len(line), why, "rename the file so that it ends in .csv")
    if stop.language == "TOML" and re.match(r"\{|\[\s*(\{|\[[\s\d.,+-]*\])", text[start:]):
        why = "it begins with a bracket, as JSON does"
        return SyntaxFault(start, 1, why, "rename the file so that it ends in .json")
    if stop.language == "JSON" and re.match(r"\[\[?[a-z_]+\]\]?\s*\n|[\w.]+ *=", text[start:]):
        why = "it looks like TOML"
        return SyntaxFault(start, len(line), why, "rename the file so that it ends in .toml")
    return None


def duplicate(stop: ParserStop) -> SyntaxFault | None:
    """A key or a table of TOML occurs twice."""
    if not re.match("Cannot|Duplicate", stop.report):
        return None
    text = stop.text
    start, end = last_statement(text, stop.at) or (stop.at, stop.at + 1)
    name = excerpt(text[start:end])
    if text[text.rfind("\n", 0, start) + 1 : start].lstrip().startswith("["):
        help = "delete one of the two"
        if stop.report.startswith("Cannot declare"):
            help += f", or write [[{name}]] each time for a list of tables"
        return SyntaxFault(start, end - start, f"the table {name} is there already", help)
    if stop.report.startswith("Duplicate inline") and (key := re.search(r"'(.*)'", stop.report)):
        why, start = f"the key {excerpt(key[1])} stands twice", text.rfind(key[1], 0, stop.at)
        return SyntaxFault(start, len(key[1]), why, "delete one of the two")
    why = f"the key {name} stands twice in one table"
    return SyntaxFault(start, end - start, why, "delete one of the two")


def unclosed_text(stop: ParserStop) -> SyntaxFault | None:
    """A text in quotes does not end."""
    if stop.language == "JSON" or not re.match("Unterminated|Expected \"'|Illegal", stop.report):
        return None
    if stop.report.startswith("Illegal") and stop.ahead[:1] not in ("\n", ""):
        return None
    for found in _TOKENS.finditer(stop.text):
        if found[0] in ("'", '"', 3 * "'", 3 * '"'):
            quote, start = found[0], found.start()
            line = "" if len(quote) == 3 else " on its line"
            why = f"the text that begins here does not end{line}"
            return SyntaxFault(start, len(quote), why, f"write {quote} at its end")
    return None


def backslash(stop: ParserStop) -> SyntaxFault | None:
    """A backslash in a text in double quotes, as in a file path."""
    if not re.match(r"Invalid \\|Unescaped|Invalid hex|Escaped", stop.report):
        return None
    start = stop.text.rfind("\\", 0, stop.at + 1)
    why = r"a backslash in a text in double quotes begins an escape such as \n"
    return SyntaxFault(start, 1, why, r"write \\ for the backslash itself")


def mismatched_bracket(stop: ParserStop) -> SyntaxFault | None:
    """[ is closed by }, or { by ]."""
    still, closing = _open(stop.text[: stop.at]), stop.ahead[:1]
    if (
        closing not in ("]", "}")
        or not still
        or not re.match("Expecting ','|Unclosed", stop.report)
    ):
        return None
    need = {"[": "]", "{": "}"}[still[-1]]
    why = f"the bracket still open is a {still[-1]}"
    return SyntaxFault(stop.at, 1, why, f"write {need} in place of the {closing}")


def malformed_number(stop: ParserStop) -> SyntaxFault | None:
    """A number is written in a form that the language lacks: .5, 1., +1, 01, 1_000, 1,5 or 5mm."""
    text, start = stop.text, stop.at
    while start and (text[start - 1].isalnum() or text[start - 1] in "._+-"):
        start -= 1
    found = _NUMBER.match(text, start)
    if not found or found.end() < stop.at:
        return None
    token, behind = found[0], text[found.end() : found.end() + 40]
    comma = re.match(r",([0-9]+)", behind)
    if stop.language == "TOML" and comma and stop.at == found.end():
        why = f"the comma in {excerpt(token + comma[0])} is no decimal mark"
        help = brief(f"write {token}.{comma[1]}", "write a decimal point in its place")
        return SyntaxFault(start, len(token + comma[0]), why, help)
    simple = _PARTS.fullmatch(token.replace("_", ""))
    if not simple:
        why, help = (
            f"{shown(token)} is not a number in {stop.language}",
            "write digits with at most a decimal point and an exponent, such as -12.5 or 3e-4",
        )
        return SyntaxFault(start, len(token), why, help)
    if behind[:1] in ("°", "%"):
        why = f"a number is written without {behind[0]}"
        return SyntaxFault(found.end(), 1, why, f"delete the {behind[0]}")
    sign, whole, digits, exponent = simple.groups()
    plain = f"{sign.strip('+')}{whole or '0'}{'.' * bool(digits)}{digits}{exponent}"
    if plain == token:
        return None
    why = f"{excerpt(token)} is not how {stop.language} writes a number"
    help = brief(f"write {plain}", "write digits with at most a decimal point and an exponent")
    return SyntaxFault(start, len(token), why, help)


def unexpected_end(stop: ParserStop) -> SyntaxFault | None:
    """The text ends too early."""
    if stop.ahead.strip():
        return None
    still = _open(stop.text)
    if (
        stop.text[stop.last : stop.last + 1] in tuple("=:,")
        or not still
        or stop.report.startswith("Expecting ':'")
    ):
        why = "the text ends where something belongs"
        return SyntaxFault(stop.last, 1, why, "write what is missing behind this")
    closing = still[::-1].translate(str.maketrans("[{", "]}"))
    why = f"the text ends where {still[:20]} is still open"
    return SyntaxFault(stop.last, 1, why, f"write {closing[:20]} behind this")


def unquoted_word(stop: ParserStop) -> SyntaxFault | None:
    """True, None, or a text without quotes."""
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
        return SyntaxFault(start, width, why, "give a number, or delete the pose")
    plain = _CONSTANTS.get(word[0].lower(), "")
    if plain == "null" and stop.language == "TOML":
        return SyntaxFault(start, width, f"TOML has no {word[0]}", "delete the key with it")
    if plain and plain != word[0]:
        why = f"{word[0]} is spelt {plain} in {stop.language}"
        return SyntaxFault(start, width, why, f"write {plain}")
    why = f"the text {excerpt(word[0])} has no quotes around it"
    help = brief(f'write "{word[0]}"', "write quotes around it")
    return None if plain else SyntaxFault(start, width, why, help)


def _open(text: str) -> str:
    """The brackets that a text leaves open, the outermost first."""
    still = ""
    for token in _TOKENS.findall(text):
        if token in ("[", "{"):
            still += token
        elif token in ("]", "}"):
            still = still[:-1]
    return still
