"""The area that holds all pivots."""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.errors import InputError
from burmester.geometry.regions import Polygon, require_searchable
from burmester.requirements.requirement import Figures, Requirement
from burmester.wording import figure

__all__ = ["FOOTPRINT"]


def _checked(value: object) -> Polygon | None:
    if value is None:
        return None
    if not isinstance(value, Polygon):
        raise InputError(
            "E134",
            f"a footprint is a box or a polygon, not a {type(value).__name__.lower()}",
            why="the pivots must have room in it",
            help="give a box by two corners, or a polygon by three or more",
        )
    require_searchable(value)
    return value


def _said(figures: Figures, _bound: object, unit: str) -> str:
    length = f"{figure(figures.outside)}{f' {unit}' if unit else ''}"
    return f"{figures.pivot} leaves the footprint by {length}"


FOOTPRINT: Final = Requirement(
    name="footprint",
    kind="footprint",
    excess=lambda figures, _bound: np.maximum(figures.outside, 0.0),
    said=_said,
    slack=lambda area: 1e-9 * float(np.ptp(area.vertices, axis=0).max()) if area else 0.0,
    form="area",
    option="--footprint",
    metavar="REGION",
    help="A box or a polygon on the ground; all pivots stay inside it while the linkage moves "
    "through the poses.",
    subject="the footprint is",
    checked=_checked,
    plain=lambda area: {"polygon": area.vertices.tolist()} if area else None,
)
