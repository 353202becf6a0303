"""The check of a linkage against the requirements of its task."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias, final

import numpy as np

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.tasks.requirements import Requirements
from burmester.wording import figure, with_article

__all__ = [
    "REQUIREMENT_TOLERANCE",
    "Violation",
    "ViolationKind",
    "places_between",
    "violations",
    "weak_transmission",
]

ViolationKind: TypeAlias = Literal[
    "transmission",
    "type",
    "driver",
    "footprint",
    "link ratio",
    "limit",
    "clearance",
    "rounding",
    "timing",
]

# Relative, and radians for angles.  A requirement missed by less than this is met.
REQUIREMENT_TOLERANCE = 1e-9
SHOWN_ANGLE = 1e-6  # degrees; a message writes a smaller angle as 0
FOOTPRINT_SAMPLES = 181  # number of places between the poses checked against the footprint


@final
@dataclass(frozen=True, slots=True)
class Violation:
    """A requirement that a linkage does not meet, and by how much."""

    kind: ViolationKind
    message: str


def violations(
    linkage: Linkage, driven: Driven, asked: Requirements, unit: str | None = None
) -> tuple[Violation, ...]:
    """The requirements that a linkage, driven by its first dyad, violates.

    asked: the requirements; unit: the task's length unit, for messages.
    """
    if not asked.has_any:
        return ()
    missing: list[Violation] = []
    missing += weak_transmission(driven.least_over_range, asked)
    kind = linkage.type
    if not asked.allows(kind):
        missing.append(Violation("type", f"it is {with_article(kind)}"))
    if asked.driver == "crank" and not driven.turns_fully:
        missing.append(Violation("driver", "its driver does not turn fully"))
    if (links := linkage.links) is not None:
        lengths = [float(length) for length in links]
        ratio = max(lengths) / min(lengths)
        if ratio > asked.link_ratio * (1 + REQUIREMENT_TOLERANCE):
            missing.append(
                Violation(
                    "link ratio",
                    f"its longest link is {ratio:.3g} times its shortest; "
                    f"at most {asked.link_ratio:g} times is allowed",
                )
            )
    if asked.footprint is not None:
        out, what = _outside(linkage, driven, asked.footprint)
        if out > REQUIREMENT_TOLERANCE * float(np.ptp(asked.footprint.vertices, axis=0).max()):
            length = f"{figure(out)}{f' {unit}' if unit else ''}"
            missing.append(Violation("footprint", f"{what} leaves the footprint by {length}"))
    return tuple(missing)


def weak_transmission(least: float, asked: Requirements) -> list[Violation]:
    """The violation of a least transmission angle over the range, in radians, if it is one."""
    if least >= asked.transmission - REQUIREMENT_TOLERANCE:
        return []
    message = (
        f"the transmission angle falls to {_degrees(least)} between the poses; "
        f"at least {_degrees(asked.transmission)} is asked for"
    )
    return [Violation("transmission", message)]


def _degrees(angle: float) -> str:
    degrees = math.degrees(angle)
    return f"{degrees if degrees > SHOWN_ANGLE else 0:.3g}°" if math.isfinite(angle) else "nothing"


def places_between(linkage: Linkage, driven: Driven) -> Displacement | None:
    """FOOTPRINT_SAMPLES places of the body from pose to pose; None where they have no circuit.

    The linkage is driven by its first dyad.
    """
    ends = driven.parameter[np.isfinite(driven.parameter)]
    if not len(ends) or driven.circuit < 0:
        return None
    parameter = np.linspace(ends.min(), ends.max(), FOOTPRINT_SAMPLES)
    return Circuits.of(linkage, as_given=True)[driven.circuit].couplers(parameter)


def _outside(linkage: Linkage, driven: Driven, footprint: Polygon) -> tuple[float, str]:
    """The greatest distance of a pivot outside the footprint, and what the pivot is.

    At FOOTPRINT_SAMPLES places between the poses.
    """
    worst, what = 0.0, ""
    places = places_between(linkage, driven)
    for dyad in (linkage.first, linkage.second):
        points: list[tuple[str, FloatArray]] = []
        if isinstance(dyad, RR | RP):
            points.append(("a fixed pivot", dyad.fixed_pivot))
        if isinstance(dyad, RR | PR) and places is not None:
            points.append(("a moving pivot", places.act(dyad.moving_pivot)))
        for name, at in points:
            out = float(np.nanmax(footprint.signed_distance(np.asarray(at))))
            if out > worst:
                worst, what = out, name
    return worst, what
