"""The place at which a parser of JSON or TOML gave up, and a fault found there."""

from __future__ import annotations

from typing import NamedTuple

from burmester.io.reading.trees.locations import Language

__all__ = ["ParserStop", "SyntaxFault", "excerpt"]

MAX_EXCERPT = 40  # characters of the file that a message quotes


class SyntaxFault(NamedTuple):
    """A fault in a text that is not JSON or TOML: its span, why, and the edit that helps."""

    start: int
    width: int
    why: str
    help: str


class ParserStop(NamedTuple):
    """The index at which a parser gave up, and its report."""

    language: Language
    text: str
    at: int
    report: str

    @property
    def ahead(self) -> str:
        """The text from there on, 1000 characters at most."""
        return self.text[self.at : self.at + 1000]

    @property
    def last(self) -> int:
        """The index of the last character before it that is no blank."""
        return max(len(self.text[: self.at].rstrip()) - 1, 0)


def excerpt(text: str) -> str:
    """The first line of a text as a message quotes it, shortened if it is long."""
    text = text.partition("\n")[0].rstrip()
    return text if len(text) <= MAX_EXCERPT else f"{text[: MAX_EXCERPT - 3]}..."
