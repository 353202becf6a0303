"""Locations of values and keys in the text of a JSON or TOML file, for errors that point at them.

The parsers report no locations, so the text is scanned again, only for an error, and without
checks, because it is known to be valid.  Nothing recurses: a file may hold a thousand brackets.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator
from typing import Literal, NamedTuple, TypeAlias

from burmester.errors import InputError
from burmester.io.reading.pose_table import NUMERIC, Source, shown

Path: TypeAlias = tuple[str | int, ...]
Language: TypeAlias = Literal["JSON", "TOML"]
_Part: TypeAlias = tuple[str | int, int, int]  # a key or an index, and where it stands

# Possessive groups would say it shorter, but match wrongly before Python 3.11.5.
LONG = (  # up to two quotes may stand before those that end it
    r'"""[^"\\]*(?:(?:\\[\s\S]|"{1,2}(?!"))[^"\\]*)*"{3,5}|'
    r"'''[^']*(?:'{1,2}(?!')[^']*)*'{3,5}"
)
SHORT = r'"[^"\\\n]*(?:\\.[^"\\\n]*)*"|' r"'[^'\n]*'"
STRING = f"{LONG}|{SHORT}"
_TOKEN = re.compile(rf"{STRING}|#[^\n]*|[\[\]{{}}]")
_BLANK = re.compile(r"(?:\s|#[^\n]*)*")
_SCALAR = re.compile(rf"{STRING}|[^\s,\]}}#][^,\]}}#\n]*+")
_KEY = re.compile(rf"{STRING}|[\w-]++")
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_JSON_TOKEN = re.compile(r'("[^"\\]*(?:\\.[^"\\]*)*")(\s*:)?|[{}]')


class Document(NamedTuple):
    """A text with a tree in it that a parser has taken, and the path of the task in that tree."""

    source: Source
    language: Language
    root: Path = ()
    bare: bool = False  # whether the tree is the list of poses itself
    others: tuple[str, ...] = ()  # tables at the top that somebody else reads

    def named(self, *path: str | int) -> str:
        """The path of a value in the task, as a message names it."""
        return dotted(self.root + path) or "the file"

    def where(self, *path: str | int, key: bool = False) -> str:
        """Where it stands, with carets below it; the file and its path where that is not known.

        key: whether it is its key that is pointed at.
        """
        full = self.root + (path[1:] if self.bare else path)
        found = span_of(self.source.text, self.language, full, key=key)
        if found is None:
            return f"{self.source.label}: {dotted(full)}".removesuffix(": ")
        return self.source.where(found[0], found[1] - found[0])

    def shown(self, value: object, *path: str | int) -> str:
        """A value as a message shows it: a text in quotes, anything else as the file has it."""
        full = self.root + (path[1:] if self.bare else path)
        found = None if isinstance(value, str) else span_of(self.source.text, self.language, full)
        piece = self.source.text[slice(*found)].partition("\n")[0] if found else ""
        if not piece or not piece.isprintable():
            return shown(value)
        return piece if len(piece) <= 40 else f"{piece[:37]}..."

    def located(self, error: InputError, *path: str | int) -> InputError:
        """An error that knows nothing of files, with the path and the place of its cause."""
        message = f"{self.named(*path)}: {error.message}"
        where = self.where(*path)
        return InputError(error.code, message, where=where, why=error.why, help=error.help)


def dotted(path: Path) -> str:
    """A path such as poses[3].x."""
    out = ""
    for key in path:
        if isinstance(key, int):
            out += f"[{key}]"
        else:
            out += f".{key if _BARE.fullmatch(key) and len(key) < 40 else shown(key)}"
    return out.removeprefix(".")


def close_match(word: str, known: Iterable[str], least: float = 0.75) -> str | None:
    """The one of the known words that is nearly the same, if one is; least: of likeness, to 1."""
    from difflib import get_close_matches

    found = get_close_matches(word.lower(), list(known), 1, least)
    return found[0] if found else None


def span_of(
    text: str, language: Language, path: Path, *, key: bool = False
) -> tuple[int, int] | None:
    """Where the value at a path of a valid text begins and ends, or its key; None if nowhere.

    A table of TOML is where its head is, or else where its name is first met in a longer one.
    """
    try:
        if language == "JSON":
            return _inside(text, _blank(text, 0), path, key)
        return _in_statements(text, path, key)
    except (AttributeError, IndexError, ValueError):  # the error then shows no line
        return None


def _in_statements(text: str, path: Path, key: bool) -> tuple[int, int] | None:
    if not path:
        return _blank(text, 0), len(text)
    implied = None
    for parts, own, value in _statements(text):
        words = tuple(word for word, _, _ in parts)
        if words[: len(path)] == path:
            if words == path and value is not None:
                return _inside(text, value, (), False) if not key else parts[-1][1:]
            if words == path or (value is None and words[:-1] == path and type(words[-1]) is int):
                return parts[len(path) - 1][1:]
            if implied is None and len(path) > own:
                implied = parts[len(path) - 1][1:]
        elif value is not None and words == path[: len(words)]:
            return _inside(text, value, path[len(words) :], key)
    return implied


def _statements(text: str) -> Iterator[tuple[list[_Part], int, int | None]]:
    """The heads and the keys of a TOML text in their order.

    Each with its whole path, how much of this is the head's above it, and where its value begins
    (None for a head).
    """
    head: list[_Part] = []
    counts: dict[Path, int] = {}  # of the tables in each array of tables
    at = _blank(text, 0)
    while at < len(text):
        if text[at] == "[":
            many = text.startswith("[[", at)
            parts, end = _key(text, _blank(text, at + 1 + many))
            end = text.index("]", end) + 1 + many
            head = []
            for i, part in enumerate(parts):
                head.append(part)
                name = tuple(word for word, _, _ in head)
                if many and i == len(parts) - 1:
                    counts[name] = counts.get(name, 0) + 1
                if name in counts:
                    head.append((counts[name] - 1, at, end))
            yield head, 0, None
        else:
            parts, end = _key(text, at)
            value = _blank(text, end + 1)
            yield head + parts, len(head), value
            end = _end(text, value)
        at = _blank(text, end)


def _inside(text: str, at: int, path: Path, key: bool) -> tuple[int, int] | None:
    """What lies at a path within the value that begins at a place."""
    span: tuple[int, int] | None = None  # of the key on the way, if there is one
    while path:
        implied = None
        if text[at] == "[" and path[0] in NUMERIC:  # a pose in brackets
            path = (NUMERIC.index(str(path[0])), *path[1:])
        for parts, value in _members(text, at):
            words = tuple(word for word, _, _ in parts)
            if words == path[: len(words)]:
                span = None if isinstance(words[0], int) else parts[-1][1:]
                at, path = value, path[len(words) :]
                break
            if words[: len(path)] == path:
                implied = implied or parts[len(path) - 1][1:]
        else:
            return implied
    return span if key and span else (at, _end(text, at))


def _members(text: str, at: int) -> Iterator[tuple[list[_Part], int]]:
    """The keys of a table, or the indices of a list, and where their values begin."""
    opening, index = text[at], 0
    at = _blank(text, at + 1)
    while opening in "[{" and text[at] not in "]}":
        parts: list[_Part] = [(index, at, at)]
        if opening == "{":
            parts, at = _key(text, at)
            at = _blank(text, at + 1)
        yield parts, at
        index, at = index + 1, _blank(text, _end(text, at))
        if text[at] == ",":
            at = _blank(text, at + 1)


def _key(text: str, at: int) -> tuple[list[_Part], int]:
    """The parts of a dotted key, and the place of what follows it."""
    parts: list[_Part] = []
    while True:
        found = _KEY.match(text, at)
        start, end = found.span()  # type: ignore[union-attr]  # `span_of` takes care of that
        parts.append((_word(text[start:end]), start, end))
        at = _blank(text, end)
        if text[at] != ".":
            return parts, at
        at = _blank(text, at + 1)


def _word(raw: str) -> str:
    """A key without its quotes."""
    if raw[0] not in "'\"":
        return raw
    if "\\" not in raw or raw[0] == "'":
        return raw[1:-1]
    try:
        return str(json.loads(raw))
    except ValueError:  # an escape that only TOML has
        import tomllib

        return str(tomllib.loads(f"{raw} = 0").popitem()[0])


def _end(text: str, at: int) -> int:
    """Where the value that begins at a place ends."""
    if text[at] not in "[{":
        found = _SCALAR.match(text, at)
        return at + len(found[0].rstrip())  # type: ignore[index]  # as in `_key`
    depth = 0
    for token in _TOKEN.finditer(text, at):
        depth += {"[": 1, "{": 1, "]": -1, "}": -1}.get(token[0], 0)
        if not depth:
            return token.end()
    raise ValueError("no end")


def _blank(text: str, at: int) -> int:
    """The place of what follows blanks and comments."""
    found = _BLANK.match(text, at)
    return found.end() if found else at


def duplicate_key(text: str) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """The two places of a key that stands twice in an object of a JSON text.

    It is that of the first object to end; the text need not be valid behind it.
    """
    objects: list[dict[str, tuple[int, int]]] = []
    twice: list[tuple[tuple[int, int], tuple[int, int]] | None] = []
    for token in _JSON_TOKEN.finditer(text):
        if token[0] == "{":
            objects.append({})
            twice.append(None)
        elif token[0] == "}":
            objects.pop()
            if found := twice.pop():
                return found
        elif token[2]:
            word, span = _word(token[1]), token.span(1)
            if word in objects[-1]:
                twice[-1] = twice[-1] or (objects[-1][word], span)
            objects[-1].setdefault(word, span)
    return None
