"""Lengths, angles and errors as people read them: with the digits that the errors leave."""

from __future__ import annotations

import math

import numpy as np

from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.linkages.found_linkage import FoundLinkage
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import Synthesis
from burmester.tasks import notation

__all__ = [
    "angle_error",
    "decimals",
    "degrees",
    "dyad_error",
    "fixed",
    "links",
    "position_error",
    "short",
    "sides",
    "worst_errors",
]

FINEST_PLACE = 1e-4  # characteristic lengths: the last place of a dyad's pivots, however exact


def decimals(synthesis: Synthesis, error: float) -> int:
    """Decimals of a dyad's dimensions: down to its error, for the poses determine no more."""
    size = max(error if math.isfinite(error) else 0.0, FINEST_PLACE * (synthesis.length or 1.0))
    return int(np.clip(-math.floor(math.log10(size)), 0, 12))


def sides(dyad: Dyad, digits: int) -> tuple[str, str, str]:
    """A dyad's pivots or lines on the ground and on the body, and its link's length or "slider"."""

    def point(pivot: np.ndarray) -> str:
        return f"({fixed(pivot[0], digits)}, {fixed(pivot[1], digits)})"

    def line(side: PR | RP) -> str:
        angle = math.degrees(side.normal_angle)
        return f"normal {fixed(angle, 2)}°,\noffset {fixed(float(side.offset), digits)}"

    match dyad:
        case RR():
            return point(dyad.fixed_pivot), point(dyad.moving_pivot), f"{dyad.radius:.{digits}f}"
        case PR():
            return line(dyad), point(dyad.moving_pivot), "slider"
        case RP():
            return point(dyad.fixed_pivot), line(dyad), "slider"
        case PP():
            return f"angle {math.degrees(dyad.angle):.2f}°", "-", "slider"


def dyad_error(synthesis: Synthesis, value: float) -> str:
    """The error of a dyad alone, "exact" where it is rounding."""
    return "exact" if value < ROUNDING * (synthesis.length or 1.0) else short(value)


def short(value: float) -> str:
    """A number with two digits, or "never"."""
    return f"{value:.2g}" if math.isfinite(value) else "never"


def fixed(value: float, digits: int) -> str:
    """A number with this number of decimals, without a sign where it rounds to zero."""
    text = f"{value:.{digits}f}"
    return text.lstrip("-") if float(text) == 0 else text


def position_error(synthesis: Synthesis, error: float) -> str:
    """A position error of a linkage, "exact" where it is rounding."""
    return "exact" if error < ROUNDING * (synthesis.length or 1.0) else notation.figure(error)


def angle_error(angle: float) -> str:
    """An angle error in radians as degrees, "exact" where it is rounding."""
    return "exact" if angle < ROUNDING else degrees(angle)


def worst_errors(synthesis: Synthesis, found: FoundLinkage) -> tuple[str, str]:
    """The greatest position and angle errors at a pose."""
    angle = float(found.error.angle.max())
    return position_error(synthesis, found.error.worst), angle_error(angle)


def degrees(angle: float) -> str:
    """An angle in radians as degrees, "-" where there is none."""
    return f"{notation.figure(math.degrees(angle))}°" if math.isfinite(angle) else "-"


def links(synthesis: Synthesis, found: FoundLinkage) -> list[str]:
    """Ground, driver, coupler and follower; dashes where there are sliders."""
    digits = decimals(synthesis, max(dyad.rms_error for dyad in found.dyads))
    lengths = found.driver_first.links
    return ["-"] * 4 if lengths is None else [f"{length:.{digits}f}" for length in lengths]
