"""A value in the tree of a JSON or TOML file, which knows its place and what belongs there."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from typing import Any, Final, NamedTuple, TypeAlias, TypeVar

from burmester.errors import InputError
from burmester.io.reading.specification import LIMITS, REQUIREMENTS
from burmester.io.reading.trees.locations import Document, Path, close_match
from burmester.tasks.option_table import TOP_KEYS

T = TypeVar("T")
NUMBER_HELP = "write a number without quotes, with a point for its decimal mark"


Schema: TypeAlias = dict[str, Any]

NUMBER: Final[Schema] = {"type": "number"}
NOT_NEGATIVE: Final[Schema] = {"type": "number", "minimum": 0}
ABOVE_ZERO: Final[Schema] = {"type": "number", "exclusiveMinimum": 0}
TEXT: Final[Schema] = {"type": "string"}
FLAG: Final[Schema] = {"type": "boolean"}
BOUNDS: Final = {"least": "minimum", "above": "exclusiveMinimum", "below": "exclusiveMaximum"}


class Node(NamedTuple):
    """A value at a path; help: what belongs there.

    Numbers are Decimal, int or float.  Each method raises an error with the place of the value.
    """

    document: Document
    path: Path
    value: Any
    help: str = ""

    def at(self, key: str | int, help: str = "") -> Node:
        """The value at a key or an index of this one."""
        return Node(self.document, (*self.path, key), self.value[key], help or self.help)

    def fault(
        self,
        code: str,
        message: str,
        help: str = "",
        *,
        why: str | None = None,
        key: bool | str = False,
    ) -> InputError:
        """An error at this place; message: what follows the path of the value.

        key: whether the key of the value is pointed at; or one of the keys in it.
        """
        path = (*self.path, key) if isinstance(key, str) else self.path
        where = self.document.where(*path, key=bool(key))
        message = f"{self.document.named(*self.path)} {message}"
        return InputError(code, message, where=where, why=why, help=help or self.help)

    def wrong(self, wanted: str, help: str = "") -> InputError:
        """E104: the value is another thing than wanted, such as "not a number"."""
        return self.fault("E104", f"is {self.shown}, {wanted}", help)

    @property
    def place(self) -> str:
        """Where the value stands."""
        return self.document.where(*self.path)

    @property
    def shown(self) -> str:
        """The value as a message shows it."""
        return self.document.shown(self.value, *self.path)

    def located(self, error: InputError) -> InputError:
        """An error that knows nothing of files, with this place."""
        return self.document.located(error, *self.path)

    def build(self, make: Callable[..., T], *values: Any, **named: Any) -> T:
        """What a maker makes; its errors, which know nothing of files, get this place."""
        try:
            return make(*values, **named)
        except InputError as error:
            raise self.located(error) from None

    def missing(self, key: str, help: str = "") -> InputError:
        """E105, for a key that this table lacks."""
        message = f"{self.document.named(*self.path, key)} is missing"
        return InputError("E105", message, where=self.place, help=help or self.help)

    def number(self) -> float:
        """The nearest double of a finite number; raises E103 and E104."""
        if type(self.value) not in (int, float, Decimal):
            raise self.wrong("not a number", NUMBER_HELP)
        number = float(Decimal(self.value))
        if not math.isfinite(number):  # 1e400 is a finite Decimal
            digits = self.shown[-1:].isdigit()
            why = f"{self.shown} is beyond 1.8e308, the largest representable number"
            message = "is not a finite number"
            raise self.fault("E103", message, NUMBER_HELP, why=why if digits else None)
        return number

    def digits(self) -> str:
        """A finite number as it is printed."""
        self.number()
        return str(self.value)

    def text(self) -> str:
        """A text without blanks around it; raises E104, for half characters as well."""
        if not isinstance(self.value, str) or any("\ud800" <= c <= "\udfff" for c in self.value):
            raise self.wrong("not a text in quotes")
        return self.value.strip()

    def word(self, known: tuple[str, ...]) -> str:
        """One of the known words; raises E104."""
        if self.value not in known:
            raise self.wrong("none of the words that may stand there")
        return str(self.value)

    def flag(self) -> bool:
        """True or false; raises E104."""
        if not isinstance(self.value, bool):
            raise self.wrong("neither true nor false")
        return self.value

    def items(self, least: int = 0, most: int | None = None, noun: str = "numbers") -> list[Node]:
        """The items of a list; raises E104, and E106 for too few or too many."""
        if not isinstance(self.value, list):
            raise self.fault("E104", f"does not fit: {self.shown}")
        count = len(self.value)
        if most is not None and count > most:
            why = "a comma separates numbers and is no decimal mark" if noun == "numbers" else None
            raise self.fault("E106", f"has more than {most} {noun}", why=why)
        if count < least:
            raise self.fault("E106", f"has {count} of {least} {noun}")
        return [self.at(k) for k in range(count)]

    def one_or_more(self) -> list[Node]:
        """The items of a list, or the value alone where it is no list."""
        return self.items() if isinstance(self.value, list) else [self]

    def pair(self) -> list[float]:
        """Two numbers."""
        return [each.number() for each in self.items(2, 2)]

    def points(self, least: int, most: int | None = None) -> list[list[float]]:
        """Points of two numbers each."""
        return [each.pair() for each in self.items(least, most, "points")]

    def table(self, fields: Fields) -> dict[str, Any]:
        """What the fields of a table read, but for those that are null; raises E104 and E107."""
        if not isinstance(self.value, dict):
            raise self.fault("E104", f"does not fit: {self.shown}")
        for key in self.value:
            if key not in fields:
                raise self.unknown(key, fields)
        return {
            key: field.read(self.at(key, field.help))
            for key, field in fields.items()
            if self.value.get(key) is not None
        }

    def unknown(self, key: str, known: Mapping[str, object]) -> InputError:
        """E107, for a key that is none of those known."""
        help, head = f"delete it; {self.help}", self.path[0]
        if key in TOP_KEYS and self.document.language == "JSON":
            help = f"write {key} beside {head}, not in it"
        elif key in TOP_KEYS:
            help = f"write {key} above the head of {head}: what stands below it belongs to {head}"
        elif near := close_match(key, known):
            help = f"write {near} in its place; {self.help}"
        elif key in LIMITS and head != "limits":
            help = f"write {key} under limits, which holds for single dyads"
        elif key in REQUIREMENTS and head != "requirements":
            help = f"write {key} under requirements, which holds for the whole linkage"
        return self.at(key).fault("E107", "is not known", help, key=True)

    def only(self, given: Mapping[str, T]) -> tuple[str, T]:
        """The one shape of those given, with its key; raises E105 where there is none, and E108."""
        if len(given) != 1:
            code, what = ("E108", " and ".join(given)) if given else ("E105", "no shape")
            raise self.fault(code, f"has {what}")
        return next(iter(given.items()))


class Field(NamedTuple):
    """What may stand at a key of a table: how it is read, help, and what a schema says of it.

    schema: where that is not what the reader says.
    """

    read: Callable[[Node], Any]
    help: str = ""
    schema: Schema | None = None

    @property
    def written(self) -> Schema:
        """What a schema says of it."""
        return self.schema or _OF_READERS[self.read]


def listed(item: Schema, least: int = 0, most: int | None = None) -> Schema:
    """A list of items, at least and at most so many."""
    out: Schema = {"type": "array", "items": item}
    out |= {"minItems": least} if least else {}
    return out if most is None else out | {"maxItems": most}


PAIR: Final[Schema] = listed(NUMBER, 2, 2)
_OF_READERS: dict[Callable[[Node], Any], Schema] = {
    Node.number: NUMBER,
    Node.digits: NUMBER,
    Node.text: TEXT,
    Node.flag: FLAG,
    Node.pair: PAIR,
}


Fields: TypeAlias = dict[str, Field]


def table_schema(fields: Fields, **more: Any) -> Schema:
    """A table with these keys and no others; more: that a schema says of it."""
    keys = {
        key: ({"description": field.help} if field.help else {}) | field.written
        for key, field in fields.items()
    }
    return {"type": "object", "properties": keys, "additionalProperties": False, **more}


def words(known: Iterable[str]) -> Schema:
    """One of the words, as it is written."""
    return {"enum": [*known]}


def any_case(known: Iterable[str]) -> Schema:
    """One of the words in letters of any case, with hyphens or blanks; editors propose these."""
    known = [*known]
    patterns = ("".join(map(_any_case, word)) for word in known)
    pattern = f"^[ -]*(?:{'|'.join(patterns)})[ -]*$"
    return {"type": "string", "anyOf": [words(known), {"pattern": pattern}]}


def _any_case(letter: str) -> str:
    both = letter.lower() + letter.upper()
    return f"[{both}]" if letter.isalpha() else "[ -]+" if letter in " -" else letter


def one_or_more(item: Schema, least: int = 0, most: int | None = None) -> Schema:
    """An item alone, or a list of such."""
    return {"anyOf": [item, listed(item, least, most)]}
