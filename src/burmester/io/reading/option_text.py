"""The text of an option: its numbers, and errors with carets below what is faulty.

Numbers have a decimal point.  What does not fit is E131, or a code that the caller names.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

from burmester.errors import InputError
from burmester.io.reading.pose_table import NUMBER, Source, plain_number, shown, unheld
from burmester.tasks.option_table import Option

ANY = "any"


def option_text(option: str, texts: Sequence[str]) -> str:
    """An option with its values as typed, in one line; empty where there is none."""
    return " ".join(f"{option} {_quoted(text)}" for text in texts)


def _quoted(text: str) -> str:
    """A text of the command line as one types it: in quotes if there is a blank in it."""
    plain = "".join(c if c.isprintable() else " " for c in text)
    plain = plain if len(plain) <= 60 else f"{plain[:57]}..."
    return plain if plain and plain.split() == [plain] else f'"{plain}"'


def option_fault(
    source: Source,
    message: str,
    help: str,
    *,
    at: int = 0,
    width: int | None = None,
    code: str = "E131",
    why: str | None = None,
) -> InputError:
    """An error with carets below the faulty part of an option's text.

    at, width: index and length of that part; the whole text by default.
    """
    where = source.where(at, len(source.text) if width is None else width)
    return InputError(code, f"{source.label}: {message}", where=where, why=why, help=help)


def number_from_text(source: Source, cell: str, at: int, code: str = "E131") -> float:
    """The finite number in a cell that begins `at` this place of a text, or an error."""
    text = cell.strip()
    plain, mark = plain_number(text, ",")
    if mark is not None:
        return float(plain)
    why: str | None = None
    such = "12.5 or 3e-4" if code == "E134" else "-12.5 or 3e-4"
    help = f"write digits with at most a decimal point and an exponent, such as {such}"
    if re.fullmatch(r"[-+]?[0-9]{1,20},[0-9]{1,20}", text):
        why, help = "a comma is no decimal mark here", f"write {text.replace(',', '.')}"
    elif found := re.fullmatch(r"([-+]?[0-9]*\.?[0-9]{1,20}) *([^\W\d_]{1,20}|°|%)", text):
        why, help = f"a number is written without {found[2]}", f"write {found[1]}"
    elif NUMBER.fullmatch(text):
        why = unheld(text)
    at += len(cell) - len(cell.lstrip())
    message = f"{shown(text)} is not a finite number"
    raise option_fault(source, message, help, at=at, width=len(text), code=code, why=why)


def numbers_from_text(
    source: Source,
    text: str,
    at: int,
    what: str,
    help: str,
    *,
    code: str = "E131",
    words: Sequence[str] = (),
    least: float = -math.inf,
) -> list[float]:
    """The numbers in a part of a text that begins at a place, with commas between them.

    what: they are, such as "a point X,Y", a name for each; words: each stands for infinity;
    least: minus infinity or 0.
    """
    cells, needed = text.split(","), what.count(",") + 1
    if len(cells) != needed:
        found = f"it has {len(cells)} numbers, and {needed} are needed; a comma is no decimal mark"
        why = found if len(cells) > 1 else None
        message = f"{shown(text)} is not {what}"
        raise option_fault(source, message, help, at=at, width=len(text), code=code, why=why)
    out = []
    for cell in cells:
        infinite = cell.strip().lower() in words
        out.append(math.inf if infinite else number_from_text(source, cell, at, code))
        if out[-1] < least:
            message = f"{shown(cell.strip())} is below zero"
            raise option_fault(source, message, help, at=at, width=len(cell), code=code)
        at += len(cell) + 1
    return out


def positive_from_text(
    source: Source, cell: str, at: int = 0, *, help: str = "", code: str = "E134"
) -> float:
    """The number above zero in a cell that begins `at` this place of a text, or an error.

    help: to give a length, where there is none.
    """
    value = number_from_text(source, cell, at, code)
    if value <= 0:
        message = f"{shown(cell.strip())} is not above zero"
        length = f"give a length above zero, in the unit of the poses, or leave {source.label} out"
        raise option_fault(source, message, help or length, at=at, width=len(cell), code=code)
    return value


def option_value(option: Option, given: Any) -> Any:
    """The value of an option of a synthesis, which is a text but for flags; raises E134."""
    match option.form:
        case "flag":
            return bool(given) is not option.negated
        case "length":
            return positive_from_text(Source(option.option, given), given)
        case "seconds":
            help = f"give seconds above zero, such as 2, or leave {option.option} out"
            return positive_from_text(Source(option.option, given), given, help=help)
        case "lengths":
            return lengths_from_texts(option.option, given)
    return given


def lengths_from_texts(option: str, texts: Sequence[str]) -> tuple[float, ...]:
    """Lengths separated by commas, in one text or several; raises E134."""
    out = []
    for text in texts:
        source, at = Source(option, text), 0
        for cell in text.split(","):
            out.append(positive_from_text(source, cell, at))
            at += len(cell) + 1
    return tuple(out)
