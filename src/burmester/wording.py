"""The few rules that messages share: articles, plurals, lists of names, figures."""

from __future__ import annotations

import math
from collections.abc import Sequence

UNIT_NAMES = {"in": "inches", "ft": "feet"}  # others go by their symbols
LEAST_RUN = 3  # successive numbers; from it on they are told as a range


def with_article(noun: str) -> str:
    """A noun with its article, by its first letter: "a crank-rocker", "an Oldham linkage"."""
    return f"{'an' if noun[:1].lower() in {*'aeiou'} else 'a'} {noun}"


def count(number: int, noun: str) -> str:
    """A number of things: "no dyads", "1 dyad", "2 dyads", "5,000 dyads"."""
    amount = f"{number:,}" if number else "no"
    return f"{amount} {noun}{'' if number == 1 else 's'}"


def listed(names: Sequence[str], last: str = "and") -> str:
    """Names in one phrase: "D1", "D1 and D2", "D1, D2 or D3" (last: the word before the end)."""
    *most, end = names
    return f"{', '.join(most)} {last} {end}" if most else end


def in_unit(unit: str | None) -> str:
    """The unit of lengths after a noun: " in mm", " in inches"; nothing where there is none."""
    return f" in {UNIT_NAMES.get(unit, unit)}" if unit else ""


def figure(value: float, digits: int = 2) -> str:
    """A figure with two digits, or its whole part if that has more: "0.00011", "4.5", "153"."""
    if not math.isfinite(value):
        return "-"
    if 10**digits - 0.5 <= abs(value) < 1e6:
        return f"{value:.0f}"
    return f"{value:.{digits}g}".replace("e+0", "e").replace("e+", "e")


def least_angle(angle: float) -> str:
    """A lower bound of an angle in degrees, rounded down."""
    if not math.isfinite(angle):
        return "-"
    return f"{math.floor(10 * math.degrees(angle) + 1e-6) / 10:g}°"


def spans(extent: float) -> str:
    """A length in spans of the motion: "1 span", "1.6 spans"."""
    return f"{figure(extent)} span{'' if figure(extent) == '1' else 's'}"


def in_runs(names: Sequence[str], most: int, last: str = "and") -> str:
    """Names in one phrase, successive numbers as ranges: "66-69, 71 and 40 others".

    At most `most` names or ranges; last: the word before the end.
    """
    runs: list[list[str]] = []
    for name in names:
        before = runs[-1][-1] if runs else ""
        if _is_number(name) and _is_number(before) and int(name) == int(before) + 1:
            runs[-1].append(name)
        elif len(runs) > most:  # what follows is among the others
            break
        else:
            runs.append([name])
    parts: list[list[str]] = []
    for run in runs:
        parts += [run] if len(run) >= LEAST_RUN else [[name] for name in run]
    texts = [f"{part[0]}-{part[-1]}" if len(part) > 1 else part[0] for part in parts]
    if len(parts) > most:
        rest = len(names) - sum(map(len, parts[: most - 1]))
        texts = [*texts[: most - 1], f"{rest} others"]
    return listed(texts, last)


def _is_number(name: str) -> bool:
    return name.isascii() and name.isdigit() and len(name) < 10


def shortened(names: Sequence[str], most: int, rest: str = "others") -> list[str]:
    """At most `most` names, the last one a count where there are more: ["D1", "D2", "5 others"]."""
    if len(names) <= most:
        return list(names)
    return [*names[: most - 2], f"{len(names) - most + 2} {rest}"]
