"""What files say of a linkage: sentences, dimensions, names and numbers, as each language has."""

from __future__ import annotations

import math
import re
from decimal import Decimal
from typing import TYPE_CHECKING, Final
from xml.etree.ElementTree import Element
from xml.sax.saxutils import escape

from burmester.cures import Help
from burmester.describe import six_bar_words
from burmester.describe.decimals import Decimals, decimals_of_linkage, figures_of
from burmester.describe.dimensions import dimensions_of
from burmester.export.options import Options, Reference, stated_unit, unit_cure, unit_of
from burmester.fourbar.pose_error import PoseError
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.printable import printable
from burmester.synthesis.result import Candidate
from burmester.tasks.length_per_radian import default_length_per_radian
from burmester.tasks.motion_task import characteristic_length
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import in_unit, with_article

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

FINEST: Final = 1e-7  # of a six-bar's span: what the last decimal of its lengths is worth

ANCHOR_DIGITS: Final = 1e-4  # of the span: the last decimal of where a spring is attached


MOST_STEP = 60  # characters; a longer text is broken into lines
MOST = 1000  # characters; programs that read DXF take a little more than 2000
_DXF_CODES = re.compile(r"%(?=%)|\\(?=[UM]\+)|\^")


OF_LAST_DIGIT: Final = 1000.0  # units of the last digit that outlines of arcs and tangents lose
MOST_DECIMALS: Final = 25  # decimals of a rounded number, at most


def description(chosen: Candidate, options: Options, unit: str | None) -> list[str]:
    """Sentences on what a file holds, for its head; unit: of its lengths, None for the task's."""
    stated = stated_unit(chosen, options)
    own = stated if unit is None else unit_of(chosen, options)
    named = f" {own}" if own else ""
    if isinstance(chosen, FoundLinkage):
        sentences = _of_four_bar(chosen, named)
    else:
        sentences = _of_six_bar(chosen)
    if unit is None:
        lengths = f"Lengths are{in_unit(own)}." if own else "The task names no unit of length."
        sentences.append(lengths)
        return sentences
    if own == unit or chosen.unit != own:
        sentences.append(f"Lengths are{in_unit(unit)}.")
    else:
        sentences.append(f"Lengths are{in_unit(unit)}; the task's are{in_unit(own)}.")
    if chosen.unit != own:
        of = "names no unit of length" if chosen.unit is None else f"is{in_unit(chosen.unit)}"
        says = (", as ", unit_cure(own), " states.")
        if not options.unit:
            says = ("; ", unit_cure(), " states another.")
        sentences.append(Help(f"The task {of}: one of its units is taken for 1 {own}", *says))
    return sentences


def _of_four_bar(chosen: FoundLinkage, named: str) -> list[str]:
    """named: the unit of lengths, after a blank, or nothing."""
    number = chosen.error.places.shape[0]
    worst = float(chosen.error.position.max())
    passes = f"comes within {worst:.3g}{named} of every pose"
    if worst < ROUNDING * characteristic_length(chosen.task):
        passes = "passes every pose exactly, up to rounding"
    sentences = [
        f"Linkage {chosen.id}, {with_article(chosen.type)}, for {number} poses.",
        f"Its driver is {chosen.ids[0]} ({type(chosen.driver_first.first).__name__}), and "
        f"{chosen.ids[1]} ({type(chosen.driver_first.second).__name__}) follows.",
        f"The coupler {passes}.",
    ]
    if not chosen.usable:
        sentences.append("It is not usable as it is: it cannot go from pose to pose in one motion.")
    return sentences


def _of_six_bar(chosen: FoundSixBar) -> list[str]:
    return [
        f"Linkage {chosen.id}, {with_article(chosen.type)}, for {len(chosen.drive)} poses.",
        f"Its driver is the crank {six_bar_words.driver_name(chosen)}, at "
        f"{', '.join(f'{math.degrees(each):.2f}°' for each in chosen.drive)} for the poses.",
        "The body passes every pose.",
    ]


def length_decimals(chosen: Candidate, options: Options, unit: str = "mm") -> int:
    """With how many decimals lengths in a unit keep the linkage's error."""
    reference = Reference.of(chosen, options, unit)
    if reference.found is not None:
        return figures_of(FINEST * reference.span)
    return _decimals(chosen, reference).lengths


def _decimals(chosen: Candidate, reference: Reference) -> Decimals:
    """With how many decimals the dimensions of a four-bar keep its error."""
    assert isinstance(reference.own, FoundLinkage)
    linkage = reference.own.driver_first
    size = characteristic_length(chosen.task) * reference.scale
    error = PoseError.at(reference.places, reference.poses)
    length = default_length_per_radian(chosen.task) * reference.scale
    free = chosen.task.free_angles
    return decimals_of_linkage(linkage, reference.poses, error, length, size, free_angles=free)


def dimension_notes(chosen: Candidate, options: Options, unit: str = "mm") -> list[str]:
    """The dimensions in a unit, a line for each link, and what a builder gets of them."""
    reference = Reference.of(chosen, options, unit)
    if (found := reference.found) is not None:
        links = six_bar_words.dimension_rows(found)
        return [f"{name}: {' '.join(each for each in own if each)}." for name, *own in links]
    assert isinstance(chosen, FoundLinkage)
    decimals = _decimals(chosen, reference)
    linkage = chosen.scaled(reference.scale).driver_first
    rows = dimensions_of((linkage.first, linkage.second), chosen.ids, decimals)
    notes = []
    for name in chosen.ids:
        parts = ", ".join(f"{row.what} {row.value}" for row in rows if row.dyad == name)
        notes.append(f"{name}: {parts}.")
    position, angle = decimals.error
    if math.isfinite(position):
        turned = math.degrees(angle)
        notes.append(
            f"Built to these digits, it comes within {position:.2g} {unit} and {turned:.2g}° "
            "of them."
        )
    return notes


def spring_notes(chosen: Candidate, options: Options, unit: str = "mm") -> list[str]:
    """Where each spring and counterweight is attached, in a unit, a line each."""
    reference = Reference.of(chosen, options, unit)
    decimals, out = figures_of(ANCHOR_DIGITS * reference.span), []
    springs = chosen.task.loads.springs if chosen.task.loads is not None else ()
    for number, spring in enumerate(springs, start=1):
        kind = spring.kind if spring.kind == "counterweight" else f"{spring.kind} spring"
        ends = [
            f"({', '.join(f'{each * reference.scale:.{decimals}f}' for each in end.point)}) on the "
            + end.link
            for end in spring.ends
        ]
        if spring.kind == "torsion":
            where = f" between the {spring.ends[0].link} and the {spring.ends[1].link}"
        else:
            where = f" at {ends[1]}" if spring.kind == "counterweight" else f": {' to '.join(ends)}"
        many = f" ({spring.count} of them)" if spring.count > 1 else ""
        out.append(f"S{number}, {kind}{many}{where}.")
    return out


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
