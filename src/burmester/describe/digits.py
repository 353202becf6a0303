"""Lengths, angles and errors as people read them: with the digits that the errors leave."""

from __future__ import annotations

import math

from burmester.describe.decimals import Decimals
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.result import Synthesis
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import figure


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
