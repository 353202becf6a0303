r"""Names and sentences inside the files of other programs: a helper for each language.

An id, a type or a unit may hold anything where a linkage is made in Python.  In none of these
languages does it end the text that it stands in, and no program obeys it.  All that a screen would
obey is escaped first (`printable`): what is left is one line, and at most `MOST` characters long.

Pictures: `plot.style.plain`.  JSON and CSV are written by Python's own writers.
"""

from __future__ import annotations

import re
from xml.sax.saxutils import escape

from burmester.printable import printable

MOST_STEP = 60  # characters; a longer text is broken into lines
MOST = 1000  # characters; programs that read DXF take a little more than 2000
_DXF_CODES = re.compile(r"%(?=%)|\\(?=[UM]\+)|\^")


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
