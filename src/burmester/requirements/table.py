"""The table of all that can be asked, and what is judged by it for linkages of any kind."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from typing import TYPE_CHECKING, Any, Final

from burmester.errors import Finding
from burmester.requirements.footprint import FOOTPRINT
from burmester.requirements.links import (
    CHANGE_POINT,
    EXTENT,
    LINK_RATIO,
    LONGEST_LINK,
    SHORTEST_LINK,
)
from burmester.requirements.loads import OF_LOADS
from burmester.requirements.poses import ANY_ORDER, WITHIN, WITHIN_ANGLE
from burmester.requirements.requirement import Bounds, Requirement
from burmester.requirements.transmission import TRANSMISSION
from burmester.requirements.types import DRIVER, TYPE

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from burmester.cures import Cure
    from burmester.numerics.arrays import FloatArray
    from burmester.requirements.figures import Figures

REQUIREMENTS: Final[tuple[Requirement, ...]] = (
    TRANSMISSION,
    TYPE,
    DRIVER,
    FOOTPRINT,
    LINK_RATIO,
    WITHIN,
    WITHIN_ANGLE,
    ANY_ORDER,
    SHORTEST_LINK,
    LONGEST_LINK,
    CHANGE_POINT,
    EXTENT,
    *OF_LOADS,
)
# Those that a task may state, in the order of options, keys and arguments.
ASKED: Final = tuple(each for each in REQUIREMENTS if each.form)
NOT_ASKED: Final = tuple(each for each in REQUIREMENTS if not each.form)
ROUNDING: Final = 2e-8  # excess; a linkage that falls short of the standard by less meets it


def _judged(bounds: Bounds) -> Iterator[tuple[Requirement, Any]]:
    return ((each, bounds[each]) for each in REQUIREMENTS if each in bounds)


def excess(bounds: Bounds, figures: Figures) -> FloatArray:
    """How far linkages (*,) are from keeping bounds: (*,), 0 keeps them all.

    Radians, logarithms of ratios, lengths, and 1 for what is kept or not, in one sum.
    """
    parts = (each.excess(figures, bound) for each, bound in _judged(bounds))
    return sum(parts, start=figures.none)


def keeps(bounds: Bounds, figures: Figures) -> NDArray[np.bool_]:
    """Whether linkages (*,) keep bounds but for rounding: (*,)."""
    out: NDArray[np.bool_] = figures.none == 0
    for each, bound in _judged(bounds):
        out = out & (each.excess(figures, bound) <= each.slack(bound))
    return out


def without(bounds: Bounds, kinds: Collection[str]) -> Bounds:
    """Bounds without those of some kinds, but for what is of use."""
    return {
        each: bound if each.kind not in kinds else min(bound, each.useful)
        for each, bound in bounds.items()
        if each.kind not in kinds or each.useful is not None
    }


def violations(bounds: Bounds, figures: Figures, unit: str | None) -> tuple[Finding, ...]:
    """The bounds that one linkage does not keep; unit: of lengths, for messages."""
    return tuple(
        Finding(each.kind, each.said(figures, bound, unit or ""))
        for each, bound in _judged(bounds)
        if not keeps({each: bound}, figures)
    )


def cured(violated: Sequence[Finding], asked: Bounds, figures: Figures) -> list[Cure] | None:
    """With what one linkage keeps what it violates; None where nothing helps."""
    of_kind = {each.kind: each for each in asked}
    cures = [
        each.kind in of_kind and of_kind[each.kind].cure(asked[of_kind[each.kind]], figures)
        for each in violated
    ]
    return [cure for cure in cures if cure] if all(cures) else None


def standard(asked: Bounds, span: float, beside: Collection[Requirement] = ()) -> Bounds:
    """The bounds of a linkage to build that a task does not set itself.

    A linkage that is closest to the poses may be one that nobody builds: it nearly locks, or its
    links are tiny beside the motion.  The bounds are those of practice, not of a proof.

    span: of the motion, a length; beside: what is not asked either.
    """
    return {
        each: each.standard * (span if each.scaled else 1.0)
        for each in REQUIREMENTS
        if each.standard is not None and each not in asked and each not in beside
    }


def shortcomings(
    bounds: Bounds, figures: Figures, length: Callable[[float], str]
) -> tuple[Finding, ...]:
    """Where one linkage falls short of bounds, in words that follow "it"; () is good.

    length: a length with its unit, in words.
    """
    out: dict[str, str] = {}  # of the shortest and the longest link one is told
    for each, bound in _judged(bounds):
        if not each.excess(figures, bound) <= ROUNDING:
            out.setdefault(each.kind, each.short(figures, length))
    return tuple(Finding(*each) for each in out.items())
