"""What files say of a linkage: sentences for their heads, dimensions with the digits that carry."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from burmester.cures import Help
from burmester.describe import six_bar_words
from burmester.describe.decimals import Decimals, decimals_of_linkage, figures_of
from burmester.describe.dimensions import dimensions_of
from burmester.export.options import Options, stated_unit, unit_cure, unit_of
from burmester.export.reference import Reference
from burmester.fourbar.pose_error import PoseError
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import Candidate
from burmester.tasks.length_per_radian import default_length_per_radian
from burmester.tasks.motion_task import characteristic_length
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import in_unit, with_article

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

FINEST: Final = 1e-7  # of a six-bar's span: what the last decimal of its lengths is worth

ANCHOR_DIGITS: Final = 1e-4  # of the span: the last decimal of where a spring is attached


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
