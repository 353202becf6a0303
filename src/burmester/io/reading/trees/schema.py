"""Parts of the JSON schema of a task: what may stand where, in the words of the draft 07."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Final, TypeAlias

Schema: TypeAlias = dict[str, Any]

NUMBER: Final[Schema] = {"type": "number"}
NOT_NEGATIVE: Final[Schema] = {"type": "number", "minimum": 0}
ABOVE_ZERO: Final[Schema] = {"type": "number", "exclusiveMinimum": 0}
TEXT: Final[Schema] = {"type": "string"}
FLAG: Final[Schema] = {"type": "boolean"}
BOUNDS: Final = {"least": "minimum", "above": "exclusiveMinimum", "below": "exclusiveMaximum"}


def listed(item: Schema, least: int = 0, most: int | None = None) -> Schema:
    """A list of items, at least and at most so many."""
    out: Schema = {"type": "array", "items": item}
    out |= {"minItems": least} if least else {}
    return out if most is None else out | {"maxItems": most}


PAIR: Final = listed(NUMBER, 2, 2)


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
