"""The area that holds all pivots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from burmester.errors import InputError
from burmester.requirements.requirement import Requirement
from burmester.wording import figure

if TYPE_CHECKING:
    from burmester.geometry.regions import Polygon
    from burmester.requirements.figures import Figures


def _checked(value: object) -> Polygon:
    # Options are told without NumPy.
    from burmester.geometry.regions import Polygon, require_searchable  # noqa: PLC0415

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
    excess=lambda figures, _bound: figures.none + figures.outside,
    said=_said,
    slack=lambda area: 1e-9 * float((area.vertices.max(axis=0) - area.vertices.min(axis=0)).max()),
    form="area",
    option="--footprint",
    label="Footprint: holds all pivots, wherever the poses take them",
    metavar="REGION",
    help="A box or a polygon on the ground; all pivots stay inside it while the linkage moves "
    "through the poses.",
    subject="the footprint is",
    such="a footprint has one key: box with two points [[X, Y], [X, Y]], or polygon with three or "
    "more",
    checked=_checked,
    plain=lambda area: {"polygon": area.vertices.tolist()} if area else None,
)
