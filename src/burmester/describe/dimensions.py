"""The dimensions of a linkage in words, each with the half-width that the poses leave open."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from decimal import Decimal
from typing import TYPE_CHECKING, NamedTuple

from burmester.describe.decimals import (
    Decimals,
    decimals_of_dyad,
    decimals_of_linkage,
    direction_deg,
    figures_of,
)
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_task import Task, characteristic_length
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.uncertainty import DyadUncertainty, PivotRegion
from burmester.wording import figure

if TYPE_CHECKING:
    from burmester.dyads.selection import FoundDyad

Regions = tuple[DyadUncertainty, DyadUncertainty] | tuple[None, None]
NOT_DETERMINED = "not determined"


class Dimension(NamedTuple):
    """A dimension in words: the dyad's id, its name, its value, and its half-width or "".

    Instead of a half-width it is said that the poses do not determine the dimension, and along
    which direction (of F for a fixed pivot, of M for a moving one) if across it they do.
    """

    dyad: str
    what: str
    value: str
    give: str


def certain(synthesis: Synthesis, found: FoundLinkage) -> bool:
    """Whether half-widths have no meaning: the poses are exact, or the dimensions are rounded."""
    return not any(synthesis.task.resolution) or found.error_before_rounding is not None


def decimals_of(synthesis: Synthesis, found: FoundLinkage) -> Decimals:
    """The decimals with which the printed linkage does what is said of it."""
    step = synthesis.options.rounding_step if found.error_before_rounding is not None else None
    grid = None if step is None else max(0, -int(Decimal(repr(step)).normalize().as_tuple()[2]))
    decimals = decimals_of_linkage(
        found.linkage,
        synthesis.task.poses,
        found.error,
        synthesis.problem.length_per_radian,
        synthesis.length,
        free_angles=synthesis.task.free_angles,
        at_least=grid or 0,
    )
    return replace(decimals, grid=grid)


def dimensions(synthesis: Synthesis, found: FoundLinkage) -> list[Dimension]:
    """All dimensions of both dyads, with half-widths where they are known."""
    regions = (None if certain(synthesis, found) else found.uncertainty) or (None, None)
    dyads, ids = [each.dyad for each in found.dyads], [each.id for each in found.dyads]
    return dimensions_of(dyads, ids, decimals_of(synthesis, found), regions)


def dimensions_of(
    dyads: Sequence[Dyad], ids: Sequence[str], decimals: Decimals, regions: Regions = (None, None)
) -> list[Dimension]:
    """All dimensions of two dyads to these decimals, with half-widths where regions are given."""
    return [
        Dimension(name, what, value, "" if region is None else give)
        for dyad, name, region, middle in zip(dyads, ids, regions, decimals.middles, strict=True)
        for what, value, give in _of_dyad(dyad, decimals, region, middle)
    ]


def _of_dyad(
    dyad: Dyad, decimals: Decimals, region: DyadUncertainty | None, middle: FloatArray | None
) -> Iterator[tuple[str, str, str]]:
    """Each dimension of a dyad: its name, value and half-width; middle: the point of its line."""
    digits = decimals.lengths

    def place(pivot: FloatArray) -> str:
        return f"({length_text(pivot[0], decimals)}, {length_text(pivot[1], decimals)})"

    def point(pivot: FloatArray, region: PivotRegion | None) -> tuple[str, str]:
        text = place(pivot)
        if region is not None and not region.determined:
            along = f" along {math.degrees(region.direction):.0f}°" * region.determined_across
            return text, NOT_DETERMINED + along
        return text, _give(region.half_width if region else 0.0, digits)

    def degrees(angle: float) -> str:
        return f"{fixed(angle, decimals.degrees)}°"

    if isinstance(dyad, RR | RP):
        yield "fixed pivot", *point(dyad.fixed_pivot, region.fixed if region else None)
    if isinstance(dyad, RR | PR):
        yield "moving pivot", *point(dyad.moving_pivot, region.moving if region else None)
    if isinstance(dyad, RR):
        give = _give(region.length or 0.0 if region else 0.0, digits)
        if region is not None and not region.length_determined:
            give = NOT_DETERMINED
        yield "length", length_text(float(dyad.radius), decimals), give
    if isinstance(dyad, PR | RP):
        line = region.line if region else None
        frame = "line in F" if isinstance(dyad, PR) else "line in M"
        give = _give(line.offset if line else 0.0, digits, " across")
        if line is not None and not line.offset_determined:
            give = NOT_DETERMINED
        assert middle is not None
        yield f"{frame}, through", place(middle), give
        give = _give(math.degrees(line.angle) if line else 0.0, decimals.degrees, "°")
        if line is not None and not line.angle_determined:
            give = NOT_DETERMINED
        yield "direction", degrees(direction_deg(dyad)), give
    if isinstance(dyad, PP):
        yield "angle", degrees(math.degrees(float(dyad.angle))), ""


def dyad_in_words(found: FoundDyad, task: Task) -> dict[str, str]:
    """A dyad alone: its sides on ground and body, its link's length or "slider", its errors.

    To the digits that keep its errors, which are "exact" where they are rounding, and "-" where
    angles are free: how far a dyad is from a point depends on the other one.
    """
    size = characteristic_length(task) or 1.0
    sides = sides_of(found.dyad, decimals_of_dyad(found.dyad, task.poses, size))
    errors = (
        "-" if task.free_angles.any() else "exact" if each < ROUNDING * size else short(each)
        for each in (found.rms_error, found.max_error)
    )
    return dict(zip(("ground", "body", "length", "rms", "worst"), (*sides, *errors), strict=True))


def sides_of(dyad: Dyad, decimals: Decimals) -> tuple[str, str, str]:
    """A dyad's pivots or lines on the ground and on the body, and its link's length or "slider"."""
    one, *others = [value for _, value, _ in _of_dyad(dyad, decimals, None, decimals.middles[0])]
    match dyad:
        case RR():
            return one, others[0], others[1]
        case PP():
            return f"angle {one}", "-", "slider"
    line = f"through {others[0]},\nat {others[1]}"
    return (line, one, "slider") if isinstance(dyad, PR) else (one, line, "slider")


def _give(value: float, digits: int, what: str = "") -> str:
    """A half-width behind a number with `digits` decimals; what: its unit, and where it holds."""
    if not math.isfinite(value):
        return "-"
    if value < 0.5 * 10.0**-digits:
        return f"± under {10.0**-digits:.{digits}f}{what}"
    shown = f"{value:.{min(digits, figures_of(value))}f}" if value < 1e6 else figure(value)
    return f"± {shown}{what}"


def short(value: float) -> str:
    """A number with two digits, or "never"."""
    return figure(value) if math.isfinite(value) else "never"


def fixed(value: float, digits: int) -> str:
    """A number with this number of decimals, without a sign where it rounds to zero."""
    text = f"{value:.{digits}f}"
    return text.lstrip("-") if float(text) == 0 else text


def position_error(synthesis: Synthesis, error: float) -> str:
    """A position error of a linkage, "exact" where it is rounding."""
    return "exact" if error < ROUNDING * (synthesis.length or 1.0) else figure(error)


def angle_error(angle: float) -> str:
    """An angle error in radians as degrees, "exact" where it is rounding."""
    return "exact" if angle < ROUNDING else degrees(angle)


def worst_errors(synthesis: Synthesis, found: FoundLinkage) -> tuple[str, str]:
    """The greatest position and angle errors at a pose; "free" where no angle is asked for."""
    free, angle = synthesis.task.angles_are_free, float(found.error.angle.max())
    return position_error(synthesis, found.error.worst), "free" if free else angle_error(angle)


def degrees(angle: float) -> str:
    """An angle in radians as degrees, "-" where there is none."""
    return f"{figure(math.degrees(angle))}°" if math.isfinite(angle) else "-"


def length_text(value: float, decimals: Decimals) -> str:
    """A length of a linkage: whole numbers where it was rounded to whole ones."""
    return fixed(value, decimals.of_length(value))


def links(found: FoundLinkage, decimals: Decimals) -> list[str]:
    """Ground, driver, coupler and follower; dashes where there are sliders."""
    lengths = found.driver_first.links
    return (
        ["-"] * 4 if lengths is None else [length_text(float(each), decimals) for each in lengths]
    )
