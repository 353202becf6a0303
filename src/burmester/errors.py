"""What burmester raises, as a tree.

    BurmesterError
    └── InputError      something the caller gave cannot be used (exit code 2)

Every error says what happened, where, why and what to do.  The command line, the JSON
object and Python callers get the same five fields.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final
from unicodedata import category

_UNSHOWN = ("Cc", "Cf", "Cs", "Zl", "Zp")  # controls, half characters, foreign line ends

__all__ = ["Advice", "BurmesterError", "InputError", "printable"]


class BurmesterError(Exception):
    """An error that a user can act on.

    `code` is stable and may be relied on; `message` says what happened; `where` (a file
    with line and column, and the line itself), `why` (with numbers) and `help` (something
    that works when followed literally) are given where they are known.
    """

    exit_code = 3

    def __init__(
        self,
        code: str,
        message: str,
        *,
        where: str | None = None,
        why: str | None = None,
        help: str | None = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.message = message
        self.where = where
        self.why = why
        self.help = help

    def __str__(self) -> str:
        lines = [f"error[{self.code}]: {self.message}"]
        if self.where:
            lines.append(f"  --> {self.where}")
        if self.why:
            lines.append(f"  why: {self.why}")
        if self.help:
            lines.append(f"  help: {self.help}")
        return "\n".join(lines)


class InputError(BurmesterError):
    """Bad input or usage: nothing was computed and nothing was written."""

    exit_code = 2


def printable(text: str) -> str:
    """A text with blanks for what a terminal would obey (escape codes) or could not show."""
    if text.isprintable():
        return text
    return "".join(" " if category(c) in _UNSHOWN and c != "\n" else c for c in text)


@final
@dataclass(frozen=True, slots=True)
class Advice:
    """A warning with what to do about it; why: with numbers."""

    code: str
    message: str
    help: str
    why: str | None = None
