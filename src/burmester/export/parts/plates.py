"""A linkage as plates with holes and slots, in layers on each other: what the formats draw and cut.

Everything here is in millimetres.

E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from burmester.errors import InputError
from burmester.export.options import MILLIMETRES, Options, unit_of
from burmester.export.parts.dimensions import Dimensions, dimensions_of
from burmester.export.parts.four_bar_links import four_bar_links, scaled
from burmester.export.parts.layers import arranged
from burmester.export.parts.links import LinkPlaces, Links
from burmester.export.parts.outlines import slot_outline
from burmester.export.parts.plate import Pin, Plate, outline_points
from burmester.export.parts.six_bar_links import six_bar_links
from burmester.export.parts.stock import stock_for
from burmester.export.reference import require_places
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage

__all__ = [
    "Assembly",
    "Dimensions",
    "Pin",
    "Plate",
    "assembly_of",
    "outline_points",
    "slot_outline",
]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Assembly:
    """A linkage as plates and pins.

    scale: millimetres per unit of the task's lengths; unit: of those.
    assumed: whether the task names no unit, nor the options, so that mm was taken.
    poses, motion: the frames of links at the poses (N,), and along the stretch of the motion (n,)
    that holds them.  body: the link whose frame is M.  moving: all links that move.
    pose: index of the place at which the assembly is drawn.
    """

    plates: tuple[Plate, ...]
    pins: tuple[Pin, ...]
    dimensions: Dimensions
    scale: float
    unit: str
    assumed: bool
    poses: LinkPlaces
    motion: LinkPlaces
    body: str
    moving: tuple[str, ...]
    pose: int

    def plate(self, name: str) -> Plate | None:
        """The plate of a name, where there is one."""
        return next((each for each in self.plates if each.name == name), None)

    @property
    def drawn(self) -> LinkPlaces:
        """Where the links are in the drawing of the assembly."""
        return self.poses[self.pose]


def assembly_of(chosen: Candidate, options: Options) -> Assembly:
    """The plates and pins of a linkage; raises E162 and E163."""
    unit = unit_of(chosen, options)
    scale = MILLIMETRES[unit]
    number = chosen.task.poses.shape[0]
    if isinstance(chosen, FoundLinkage):
        require_places(chosen)
        number = chosen.error.places.shape[0]
    if not 1 <= options.pose <= number:
        raise InputError(
            "E162",
            f"there is no pose {options.pose} to draw",
            why=f"the task has {number} poses",
            help=f"give --pose 1, or another up to {number}",
        )
    links = _links(chosen, scale)
    assumed = chosen.unit is None and options.unit is None
    made = dimensions_of(links, options, scale, unit, None if assumed else stock_for(unit))
    plates, pins = arranged(links, made)
    return Assembly(
        plates,
        pins,
        made,
        scale,
        unit,
        assumed,
        links.poses,
        links.motion,
        links.body,
        links.moving,
        options.pose - 1,
    )


def _links(chosen: Candidate, scale: float) -> Links:
    """The links of a linkage, in millimetres; raises E163."""
    if not isinstance(chosen, FoundLinkage):
        return six_bar_links(chosen.scaled(scale))
    both = chosen.driver_first
    first, second = scaled(both.first, scale), scaled(both.second, scale)
    places = chosen.error.places
    in_mm = Displacement(places.translation * scale, places.angle)
    return four_bar_links(Linkage(first, second), in_mm)
