"""Dyads as the command line states them: `--dyad` twice, and `--length` for their links.

A dyad is what stands on the ground, a colon, and what stands on the body:

FX,FY:MX,MY            RR: the fixed pivot in F, the moving pivot in M
line@DEG,X,Y:MX,MY     PR: a slider on the line through X,Y of F at DEG, the moving pivot in M
FX,FY:line@DEG,x,y     RP: the fixed pivot in F, a slot on the line through x,y of M at DEG

A length is a number, or `any` where it follows from the poses.  What does not fit is E153, with a
caret below the text.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RP, RR
from burmester.io.reading.option_text import (
    ANY,
    numbers_from_text,
    option_fault,
    option_text,
    positive_from_text,
)
from burmester.io.reading.pose_table import Source, shown
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.given_linkage import GivenDyad, OpenLink
from burmester.wording import count

LINE: Final = "line@"
DYAD_HELP = (
    "write FX,FY:MX,MY for a link (fixed pivot in F, moving pivot in M), "
    "line@DEG,X,Y:MX,MY for a slider or FX,FY:line@DEG,x,y for a slot"
)
EXAMPLE = "--dyad 100,-68:53,-47 --dyad 12,-17:80,-17"


def dyads_from_options(
    texts: Sequence[str], lengths: Sequence[str] = ()
) -> tuple[GivenDyad, GivenDyad]:
    """The two dyads in the texts of --dyad, with the lengths in those of --length; raises E153."""
    if len(texts) != 2:
        raise InputError(
            "E153",
            f"--dyad is given {'once' if len(texts) == 1 else f'{len(texts)} times'}, "
            "and a linkage has two dyads",
            where=option_text("--dyad", texts) or None,
            help=f"give two, such as {EXAMPLE}",
        )
    dyads = [_dyad(Source("--dyad", text)) for text in texts]
    links = [k for k, each in enumerate(dyads) if isinstance(each, OpenLink)]
    if lengths and len(lengths) != len(links):
        raise InputError(
            "E153",
            f"{count(len(lengths), 'length')} for {count(len(links), 'link')}",
            where=option_text("--length", lengths),
            why="a link (FX,FY:MX,MY) has a length, a slider and a slot have none",
            help="give --length once for each link, in their order (any: it follows from the "
            "poses), or not at all",
        )
    for k, text in zip(links, lengths, strict=False):
        link = dyads[k]
        if text.strip() != ANY and isinstance(link, OpenLink):
            help = "give a length above zero, or any where it follows from the poses"
            length = positive_from_text(Source("--length", text), text, help=help, code="E153")
            dyads[k] = RR(link.fixed_pivot, link.moving_pivot, np.asarray(length))
    return dyads[0], dyads[1]


def require_one_source(
    poses: str, linkage: str | None, dyads: Sequence[str], id: str | None
) -> None:
    """Refuse a linkage that is not given, given twice, or given where the poses are: E153."""
    if linkage is None and not dyads:
        raise InputError(
            "E153",
            "no linkage is given",
            help=f"give --linkage FILE, or two dyads such as {EXAMPLE}",
        )
    if linkage is not None and dyads:
        raise InputError(
            "E153",
            "the linkage is given twice: by --linkage and by --dyad",
            where=option_text("--dyad", dyads),
            help="leave one of the two out",
        )
    if linkage is None and id is not None:
        raise InputError(
            "E153",
            "--id chooses a linkage of a file, and no file is given",
            help="leave --id out, or give --linkage FILE",
        )
    if poses == "-" and linkage == "-":
        raise InputError(
            "E153",
            "the poses and the linkage cannot both come from standard input",
            help="save one of them to a file",
        )


def lengths_and_limits(
    texts: Sequence[str], *, typed: bool
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The texts of --length as lengths of links, or as limits MIN:MAX; raises E153 for both.

    typed: whether dyads are typed, so that there are links to have these lengths.
    """
    ranges = [text for text in texts if ":" in text]
    plain = [text for text in texts if ":" not in text and text.strip() != ANY]
    if ranges and plain:
        raise InputError(
            "E153",
            "--length is given as a length and as a limit",
            where=option_text("--length", texts),
            help="give lengths of links here, and limits MIN:MAX in the file of the poses",
        )
    if plain and not typed:
        raise InputError(
            "E153",
            "--length is that of a link of --dyad, and none is given",
            where=option_text("--length", texts),
            help="give the lengths in the file, or a limit as MIN:MAX",
        )
    return ((), tuple(texts)) if ranges or not plain else (tuple(texts), ())


def line_through(point: FloatArray, direction_deg: float) -> tuple[FloatArray, FloatArray]:
    """The normal's angle in radians and the offset of the line through a point at a direction."""
    normal = math.radians(direction_deg + 90.0)
    offset = math.cos(normal) * point[0] + math.sin(normal) * point[1]
    return np.asarray(normal), np.asarray(offset)


def _dyad(source: Source) -> GivenDyad:
    """The dyad in a text."""
    parts = source.text.split(":")
    if len(parts) != 2:
        message = f"{shown(source.text)} is not what is on the ground and what is on the body"
        found = "no colon" if len(parts) == 1 else f"{len(parts) - 1} colons"
        why = f"it has {found}, and one stands between the two"
        raise option_fault(source, message, DYAD_HELP, code="E153", why=why)
    ground, body = parts
    sliding = [part.strip().startswith(LINE) for part in parts]
    at = len(ground) + 1
    if all(sliding):
        help = "give a pivot on the ground or on the body"
        raise option_fault(source, "a dyad with two lines has no pivot", help, code="E153")
    if sliding[0]:
        return PR(*_line(source, ground, 0), _point(source, body, at))
    fixed = _point(source, ground, 0)
    if sliding[1]:
        return RP(fixed, *_line(source, body, at))
    return OpenLink(fixed, _point(source, body, at))


def _point(source: Source, text: str, at: int) -> FloatArray:
    """The point in a part of the text that begins at this place."""
    return np.array(numbers_from_text(source, text, at, "a point X,Y", DYAD_HELP, code="E153"))


def _line(source: Source, text: str, at: int) -> tuple[FloatArray, FloatArray]:
    """The line in a part of the text that begins at this place."""
    start = text.index(LINE) + len(LINE)
    what = "a direction and a point DEG,X,Y"
    angle, *point = numbers_from_text(
        source, text[start:], at + start, what, DYAD_HELP, code="E153"
    )
    if abs(angle) > 360:
        help = "give the direction of the line in degrees, from -180 to 180"
        message = f"a direction of {angle:g}° is more than a turn"
        raise option_fault(source, message, help, at=at + start, code="E153")
    return line_through(np.array(point), angle)
