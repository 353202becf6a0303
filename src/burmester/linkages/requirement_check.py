"""What is asked of a linkage and is not so."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias, final

import numpy as np

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.tasks.requirements import Requirements
from burmester.wording import with_article

__all__ = ["Violation", "ViolationKind", "violations"]

ViolationKind: TypeAlias = Literal[
    "transmission", "type", "driver", "footprint", "link ratio", "rounding"
]

ROUNDING = 1e-9  # relative, of what is asked
FLAT = 1e-6  # degrees; less is none
PLACES = 181  # looked at on the way between the poses, for the footprint


@final
@dataclass(frozen=True, slots=True)
class Violation:
    """A requirement that a linkage does not meet, and by how much."""

    kind: ViolationKind
    message: str


def violations(
    linkage: Linkage, driven: Driven, asked: Requirements, unit: str | None = None
) -> tuple[Violation, ...]:
    """What a linkage, driven by its first dyad, lacks of what is asked."""
    if not asked.asked:
        return ()
    found: list[Violation] = []
    least = driven.least_over_range
    if not least >= asked.transmission - ROUNDING:
        found.append(
            Violation(
                "transmission",
                f"the transmission angle falls to {_degrees(least)} between the poses; "
                f"{_degrees(asked.transmission)} is asked",
            )
        )
    kind = linkage.type
    if not asked.allows(kind):
        found.append(Violation("type", f"it is {with_article(kind)}"))
    if asked.driver == "crank" and not driven.turns_fully:
        found.append(Violation("driver", "its driver does not turn fully"))
    if (links := linkage.links) is not None:
        lengths = [float(length) for length in links]
        ratio = max(lengths) / min(lengths)
        if ratio > asked.link_ratio * (1 + ROUNDING):
            found.append(
                Violation(
                    "link ratio",
                    f"its longest link is {ratio:.3g} times its shortest; "
                    f"{asked.link_ratio:g} at most is asked",
                )
            )
    if asked.footprint is not None:
        out, what = _outside(linkage, driven, asked.footprint)
        if out > ROUNDING * float(np.ptp(asked.footprint.vertices, axis=0).max()):
            length = f"{out:.2g}{f' {unit}' if unit else ''}"
            found.append(Violation("footprint", f"{what} leaves the footprint by {length}"))
    return tuple(found)


def _degrees(angle: float) -> str:
    degrees = math.degrees(angle)
    return f"{degrees if degrees > FLAT else 0:.3g}°" if math.isfinite(angle) else "nothing"


def _outside(linkage: Linkage, driven: Driven, footprint: Polygon) -> tuple[float, str]:
    """How far the farthest pivot comes outside, at places close together, and which it is."""
    worst, what = 0.0, ""
    ends = driven.parameter[np.isfinite(driven.parameter)]
    circuits = Circuits.of(linkage, as_given=True)
    way = None
    if len(ends) and driven.circuit >= 0:
        way = circuits[driven.circuit].couplers(np.linspace(ends.min(), ends.max(), PLACES))
    for dyad in (linkage.first, linkage.second):
        points: list[tuple[str, FloatArray]] = []
        if isinstance(dyad, RR | RP):
            points.append(("a fixed pivot", dyad.fixed_pivot))
        if isinstance(dyad, RR | PR) and way is not None:
            points.append(("a moving pivot", way.act(dyad.moving_pivot)))
        for name, at in points:
            out = float(np.nanmax(footprint.signed_distance(np.asarray(at))))
            if out > worst:
                worst, what = out, name
    return worst, what
