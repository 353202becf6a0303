"""The few rules of English that messages share: articles, plurals, lists of names."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["count", "listed", "shortened", "with_article"]


def with_article(noun: str) -> str:
    """A noun with its article, by its first letter: "a crank-rocker", "an Oldham linkage"."""
    return f"{'an' if noun[0] in 'aeiouAEIOU' else 'a'} {noun}"


def count(number: int, noun: str) -> str:
    """A number of things: "no dyads", "1 dyad", "2 dyads"."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"


def listed(names: Sequence[str], last: str = "and") -> str:
    """Names in one phrase: "D1", "D1 and D2", "D1, D2 or D3" (last: the word before the end)."""
    *most, end = names
    return f"{', '.join(most)} {last} {end}" if most else end


def shortened(names: Sequence[str], most: int, rest: str = "others") -> list[str]:
    """At most `most` names, the last one a count where there are more: ["D1", "D2", "5 others"]."""
    if len(names) <= most:
        return list(names)
    return [*names[: most - 2], f"{len(names) - most + 2} {rest}"]
