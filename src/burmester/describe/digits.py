"""Dimensions and errors as people read them: with the digits that the errors leave."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.linkages.found_linkage import FoundLinkage
from burmester.linkages.uncertainty import DyadUncertainty, PivotRegion
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import Synthesis
from burmester.tasks import wording

__all__ = ["decimals", "degrees", "links", "miss", "misses", "parts", "short", "sides"]

DIGITS = 1e-4  # of the characteristic length: what pivots are shown to, errors permitting
FINEST = 1e-6  # the same for the best linkage, however exact the poses are


def decimals(synthesis: Synthesis, error: float) -> int:
    """Decimals down to a dyad's error; the poses can tell no more, and JSON keeps them all."""
    size = max(error if math.isfinite(error) else 0.0, DIGITS * (synthesis.length or 1.0))
    return int(np.clip(-math.floor(math.log10(size)), 0, 12))


def sides(dyad: Dyad, digits: int) -> tuple[str, str, str]:
    """A dyad's pivots or lines on the ground and on the body, and its link's length or "slider"."""

    def point(pivot: np.ndarray) -> str:
        return f"({_fixed(pivot[0], digits)}, {_fixed(pivot[1], digits)})"

    def line(side: PR | RP) -> str:
        angle = math.degrees(side.normal_angle)
        return f"normal {_fixed(angle, 2)}°,\noffset {_fixed(float(side.offset), digits)}"

    match dyad:
        case RR():
            return point(dyad.fixed_pivot), point(dyad.moving_pivot), f"{dyad.radius:.{digits}f}"
        case PR():
            return line(dyad), point(dyad.moving_pivot), "slider"
        case RP():
            return point(dyad.fixed_pivot), line(dyad), "slider"
        case PP():
            return f"angle {math.degrees(dyad.angle):.2f}°", "-", "slider"


def miss(synthesis: Synthesis, value: float) -> str:
    """A dyad's miss, "exact" where it is rounding."""
    return "exact" if value < ROUNDING * (synthesis.length or 1.0) else short(value)


def short(value: float) -> str:
    """A number with two digits, or "never"."""
    return f"{value:.2g}" if math.isfinite(value) else "never"


def parts(
    synthesis: Synthesis, found: FoundLinkage, dyad: object, region: DyadUncertainty | None
) -> Iterator[tuple[str, str, str]]:
    """Of a dyad, each dimension: what it is, its value and how certain it is."""
    error = found.error.worst
    turn = math.degrees(float(found.error.angle.max()))

    def known(give: float, unit: str = "") -> tuple[int, str]:
        digits = _digits(synthesis, max(error, give))
        return digits, _give(give, digits, unit)

    def point(pivot: np.ndarray, region: PivotRegion | None) -> tuple[str, str]:
        digits, give = known(region.half_width if region else 0.0)
        return f"({_fixed(pivot[0], digits)}, {_fixed(pivot[1], digits)})", give

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
        yield f"{frame}, normal", f"{_fixed(angle, digits)}°", _give(swing, digits, "°")
        digits, give = known(line.offset if line else 0.0, " at mid-travel")
        yield "offset", _fixed(float(dyad.offset), digits), give


def _fixed(value: float, digits: int) -> str:
    """A number with so many decimals, and no sign where it is zero."""
    text = f"{value:.{digits}f}"
    return text.lstrip("-") if float(text) == 0 else text


def _give(value: float, digits: int, what: str = "") -> str:
    """A half-width, for a number with so many decimals."""
    if not math.isfinite(value):
        return "-"
    if value < 0.5 * 10.0**-digits:
        return f"± under {10.0**-digits:.{digits}f}{what}"
    shown = f"{value:.{min(digits, _places(value))}f}" if value < 1e6 else f"{value:.1e}"
    return f"± {shown}{what}"


def _digits(synthesis: Synthesis, size: float) -> int:
    return _places(max(size if math.isfinite(size) else 0.0, FINEST * synthesis.length))


def _places(size: float) -> int:
    """Decimals that show a size with one digit, or two where the first is 1 or 2; 12 at most."""
    if not size > 0:
        return 12
    return int(np.clip(math.ceil(-math.log10(size / 3)), 0, 12))


def misses(synthesis: Synthesis, found: FoundLinkage) -> tuple[str, str]:
    """The greatest position and angle errors at a pose."""
    angle, worst = float(found.error.angle.max()), found.error.worst
    return (
        "exact" if worst < ROUNDING * (synthesis.length or 1.0) else wording.figure(worst),
        "exact" if angle < ROUNDING else degrees(angle),
    )


def degrees(angle: float) -> str:
    """An angle in radians as degrees."""
    return f"{wording.figure(math.degrees(angle))}°"


def links(synthesis: Synthesis, found: FoundLinkage) -> list[str]:
    """Ground, driver, coupler and follower; dashes where there are sliders."""
    digits = decimals(synthesis, max(dyad.rms_error for dyad in found.dyads))
    lengths = found.driver_first.links
    return ["-"] * 4 if lengths is None else [f"{length:.{digits}f}" for length in lengths]
