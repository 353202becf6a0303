"""Requirements, and lengths to compute with, as the command line says them.

Angles are in degrees, lengths in the unit of the poses.  What does not fit is E134, with a caret
below the text (a malformed region is E131, as for pivots).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from burmester.io.reading.asked import Asked, ask
from burmester.io.reading.limits_text import ANY, fault, number, region, said
from burmester.io.reading.table import Source, shown
from burmester.tasks.requirements import Driver

__all__ = ["above_zero", "asked", "lengths", "pose_sigma"]

FOOTPRINT = "write box:X,Y:X,Y from lower left to upper right, or polygon:X,Y:X,Y:X,Y, or any"


def asked(
    *,
    min_transmission: str | None = None,
    types: Sequence[str] = (),
    driver: Driver | None = None,
    footprint: str | None = None,
    link_ratio: str | None = None,
    within: str | None = None,
    any_order: bool = False,
) -> tuple[Asked, ...]:
    """What the options of these names ask for; raises E134, E131 and E132 as `Requirements` does.

    The types' option is `--type`, and adds up where it is given more than once.
    """
    out = []
    if min_transmission is not None:
        out.append(_number("transmission", "--min-transmission", min_transmission, math.radians))
    if types:
        names = frozenset(name for text in types for name in _types(Source("--type", text)))
        out.append(Asked("types", names, said("--type", types)))
    if driver is not None:
        out.append(ask("driver", driver, said("--driver", [driver])))
    if footprint is not None:
        source = Source("--footprint", footprint)
        area = None if footprint.strip() == ANY else region(source, FOOTPRINT)
        where = said(source.label, [footprint])
        out.append(ask("footprint", area, where, source.where(0, len(footprint))))
    if link_ratio is not None:
        out.append(_number("link_ratio", "--link-ratio", link_ratio))
    if within is not None:
        out.append(_number("within", "--within", within))
    if any_order:
        out.append(ask("any_order", True, "--any-order"))
    return tuple(out)


def above_zero(option: str, text: str) -> float:
    """The one length that an option takes; raises E134 where it is not above zero."""
    (value,) = lengths(option, [text], one=True)
    return value


def lengths(option: str, texts: Sequence[str], *, one: bool = False) -> tuple[float, ...]:
    """Lengths with commas between them, in one text or in more; raises E134 as `above_zero`."""
    out = []
    for text in texts:
        source, at = Source(option, text), 0
        for cell in [text] if one else text.split(","):
            value = number(source, cell, at, "E134")
            if value <= 0:
                help = f"give a length above zero, in the unit of the poses, or leave {option} out"
                message = f"{shown(cell.strip())} is not above zero"
                raise fault(source, message, help, at, len(cell), "E134")
            out.append(value)
            at += len(cell) + 1
    return tuple(out)


def pose_sigma(text: str) -> tuple[float, float]:
    """Standard deviations LENGTH,DEG of positions and angles, as a length and in radians."""
    source = Source("--pose-sigma", text)
    cells = text.split(",")
    help = "write a length and an angle in degrees, such as 0.05,0.1; 0 is for exact numbers"
    if len(cells) != 2:
        raise fault(source, f"{shown(text)} is not LENGTH,DEG", help, code="E134")
    values, at = [], 0
    for cell in cells:
        values.append(number(source, cell, at, "E134"))
        if values[-1] < 0:
            message = f"{shown(cell.strip())} is below zero"
            raise fault(source, message, help, at, len(cell), "E134")
        at += len(cell) + 1
    return values[0], math.radians(values[1])


def _number(field: str, option: str, text: str, into: Callable[[float], float] = float) -> Asked:
    source = Source(option, text)
    value = into(number(source, text, 0, "E134"))
    return ask(field, value, said(option, [text]), source.where(0, len(text)))


def _types(source: Source) -> list[str]:
    names, at = [], 0
    for item in source.text.split(","):
        name = item.strip()
        place = source.where(at + len(item) - len(item.lstrip()), len(name))
        names.append(ask("types", [name], source.label, place).value[0])
        at += len(item) + 1
    return names
