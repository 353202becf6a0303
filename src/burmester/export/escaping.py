r"""Names and sentences inside the files of other programs: a helper for each language.

An id, a type or a unit may hold anything where a linkage is made in Python.  In none of these
languages does it end the text that it stands in, and no program obeys it.  All that a screen would
obey is escaped first (`printable`): what is left is one line, and at most `MOST` characters long.

Pictures: `plot.style.plain`.  JSON and CSV are written by Python's own writers.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from typing import Final
from xml.etree.ElementTree import Element
from xml.sax.saxutils import escape

from burmester.numerics.arrays import FloatArray
from burmester.printable import printable

MOST_STEP = 60  # characters; a longer text is broken into lines
MOST = 1000  # characters; programs that read DXF take a little more than 2000
_DXF_CODES = re.compile(r"%(?=%)|\\(?=[UM]\+)|\^")


OF_LAST_DIGIT: Final = 1000.0  # units of the last digit that outlines of arcs and tangents lose
MOST_DECIMALS: Final = 25  # decimals of a rounded number, at most


def one_line(text: str) -> str:
    """A text on one line: behind // in OpenSCAD, whose comment ends with it, and in a PDF."""
    plain = printable(text)
    return plain if len(plain) <= MOST else f"{plain[: MOST - 3]}..."


def python_docstring(text: str) -> str:
    '''A text inside """, where neither a quote nor a backslash ends or starts anything.'''
    return one_line(text).replace("\\", r"\\").replace('"', r"\"")


def xml_text(text: str) -> str:
    """A text between the tags of XML."""
    return escape(one_line(text))


def xml_attribute(text: str) -> str:
    """A value of an attribute of XML, its quotes around it."""
    return '"' + xml_text(text).replace('"', "&quot;") + '"'


def xml_comment(text: str) -> str:
    """A text inside a comment of XML, where two hyphens may not follow each other."""
    return re.sub("-(?=-|$)", "- ", one_line(text))


def dxf_text(text: str) -> str:
    r"""A TEXT of DXF without codes of its own: %%d, \U+00B0 and ^J get a blank between."""
    return _DXF_CODES.sub(lambda found: f"{found[0]} ", one_line(text))


def step_text(text: str) -> str:
    """A text of STEP: printable ASCII without quotes and backslashes, "_" for all else."""
    return re.sub(r"[^ -~]|['\"\\]", "_", one_line(text))[:MOST_STEP]


def number(value: float) -> str:
    """The shortest text that reads back as the same number; -0 is written as 0."""
    return repr(float(value) + 0.0)


def decimals_within(error: float) -> int:
    """The fewest decimals that change no number by more than this error."""
    if not error > 0:
        return MOST_DECIMALS
    return min(max(math.ceil(-math.log10(2 * error)), 0), MOST_DECIMALS)


def error_within(digits: int, largest: float) -> float:
    """How far off may be what is computed from numbers of a file.

    digits: with which the file carries them; largest: of these numbers.
    """
    return OF_LAST_DIGIT * 10.0 ** (1 - digits) * largest


def rounded(value: float, decimals: int) -> str:
    """A number to these decimals, without zeros behind them: 0.3 for 0.30000000000000004."""
    return format(Decimal(repr(round(float(value), decimals) + 0.0)), "f").removesuffix(".0")


def xy(point: FloatArray | list[float]) -> str:
    """The two coordinates of a point of the plane."""
    return f"{number(point[0])} {number(point[1])}"


def numbers_in(element: Element, key: str) -> list[float]:
    """The numbers in an attribute of an element, none where it has none."""
    return [float(part) for part in (element.get(key) or "").split()]
