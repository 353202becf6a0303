"""The dimensions of a linkage in words, each with the half-width that the poses leave open."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from burmester.describe.digits import fixed
from burmester.fourbar.dyad import PR, RP, RR
from burmester.linkages.found_linkage import FoundLinkage
from burmester.linkages.uncertainty import DyadUncertainty, PivotRegion
from burmester.synthesis.result import Synthesis

__all__ = ["Dimension", "certain", "dimensions"]

FINEST_PLACE = 1e-6  # characteristic lengths: the last place of a dimension, even if exact


class Dimension(NamedTuple):
    """A dimension in words: the dyad's id, its name, its value, and its half-width or ""."""

    dyad: str
    what: str
    value: str
    give: str


def certain(synthesis: Synthesis, found: FoundLinkage) -> bool:
    """Whether half-widths have no meaning: the poses are exact, or the dimensions are rounded."""
    return not any(synthesis.task.resolution) or found.error_before_rounding is not None


def dimensions(synthesis: Synthesis, found: FoundLinkage) -> list[Dimension]:
    """All dimensions of both dyads, with half-widths where they are known."""
    regions = (None if certain(synthesis, found) else found.uncertainty) or (None, None)
    return [
        Dimension(dyad.id, what, value, "" if region is None else give)
        for dyad, region in zip(found.dyads, regions, strict=True)
        for what, value, give in _of_dyad(synthesis, found, dyad.dyad, region)
    ]


def _of_dyad(
    synthesis: Synthesis, found: FoundLinkage, dyad: object, region: DyadUncertainty | None
) -> Iterator[tuple[str, str, str]]:
    """Each dimension of a dyad: its name, its value and its half-width."""
    error = found.error.worst
    turn = math.degrees(float(found.error.angle.max()))

    def known(give: float, unit: str = "") -> tuple[int, str]:
        digits = _digits(synthesis, max(error, give))
        return digits, _give(give, digits, unit)

    def point(pivot: np.ndarray, region: PivotRegion | None) -> tuple[str, str]:
        digits, give = known(region.half_width if region else 0.0)
        return f"({fixed(pivot[0], digits)}, {fixed(pivot[1], digits)})", give

    if isinstance(dyad, RR | RP):
        yield "fixed pivot", *point(dyad.fixed_pivot, region.fixed if region else None)
    if isinstance(dyad, RR | PR):
        yield "moving pivot", *point(dyad.moving_pivot, region.moving if region else None)
    if isinstance(dyad, RR):
        digits, give = known(region.length or 0.0 if region else 0.0)
        yield "length", f"{dyad.radius:.{digits}f}", give
    if isinstance(dyad, PR | RP):
        line = region.line if region else None
        swing = math.degrees(line.angle) if line else 0.0
        digits, angle = _places(max(turn, swing)), math.degrees(dyad.normal_angle)
        frame = "line in F" if isinstance(dyad, PR) else "line in M"
        yield f"{frame}, normal", f"{fixed(angle, digits)}°", _give(swing, digits, "°")
        digits, give = known(line.offset if line else 0.0, " at mid-travel")
        yield "offset", fixed(float(dyad.offset), digits), give


def _give(value: float, digits: int, what: str = "") -> str:
    """A half-width behind a number with `digits` decimals; what: its unit, and where it holds."""
    if not math.isfinite(value):
        return "-"
    if value < 0.5 * 10.0**-digits:
        return f"± under {10.0**-digits:.{digits}f}{what}"
    shown = f"{value:.{min(digits, _places(value))}f}" if value < 1e6 else f"{value:.1e}"
    return f"± {shown}{what}"


def _digits(synthesis: Synthesis, size: float) -> int:
    return _places(max(size if math.isfinite(size) else 0.0, FINEST_PLACE * synthesis.length))


def _places(size: float) -> int:
    """Decimals that show a size with one digit, or two where the first is 1 or 2; 12 at most."""
    if not size > 0:
        return 12
    return int(np.clip(math.ceil(-math.log10(size / 3)), 0, 12))
