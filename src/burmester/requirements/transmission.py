"""The least transmission angle over the range that the poses use."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from burmester.requirements.requirement import Looser, Number, Requirement
from burmester.wording import least_angle

if TYPE_CHECKING:
    from burmester.requirements.figures import Figures

SHOWN_ANGLE = 1e-6  # degrees; a message writes a smaller angle as 0


def _said(figures: Figures, bound: float, _unit: str) -> str:
    return (
        f"the transmission angle falls to {_degrees(figures.transmission)} between the "
        f"poses; at least {_degrees(math.radians(bound))} is asked for"
    )


def _degrees(angle: float) -> str:
    degrees = math.degrees(angle)
    return f"{degrees if degrees > SHOWN_ANGLE else 0:.3g}°" if math.isfinite(angle) else "nothing"


def _looser(bound: float, figures: Figures, share: float) -> Looser | None:
    least = math.degrees(figures.transmission)
    if not least < bound:
        return None
    angle = math.floor(10 * (bound - share * (bound - least))) / 10
    angle = max(angle, 0.1 if least > 0.1 else 0.0)
    words = f"a transmission angle of {angle:g}° instead of {bound:g}°"
    return Looser(angle, words, math.radians(bound - angle))


TRANSMISSION: Final = Requirement(
    name="transmission_deg",
    kind="transmission",
    excess=lambda figures, bound: figures.lack(figures.transmission, math.radians(bound), math.inf),
    said=_said,
    standard=30.0,  # degrees; below it friction and play grow quickly
    short=lambda figures, _: f"transmits at {least_angle(figures.transmission)} only",
    assumed=(30.0, 5.0),
    words="a transmission angle of {:g}° or more".format,
    useful=5.0,
    form="number",
    default=0.0,
    option="--min-transmission",
    label="transmission angle at least",
    metavar="DEG",
    help="Smallest transmission angle allowed while the linkage moves through the poses.",
    subject="the least transmission angle is",
    such="transmission_deg is one number, in degrees, such as 40",
    checked=Number(
        "angle",
        "the least transmission angle",
        "a least transmission angle of {:g}° is impossible",
        why="a transmission angle is between 0° and 90°",
        help="give an angle from 0° to below 90°",
        least=0,
        below=90,
    ),
    looser=_looser,
)
