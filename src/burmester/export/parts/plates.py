"""A linkage as plates with holes and slots, in layers on each other: what the formats draw and cut.

Everything here is in millimetres.

E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.options import Options, unit_of
from burmester.export.parts.dimensions import Dimensions, dimensions_of
from burmester.export.parts.layers import arranged
from burmester.export.parts.links import Links
from burmester.export.parts.plate import Pin, Plate
from burmester.export.parts.stock import stock_for
from burmester.export.reference import Reference
from burmester.mechanisms.bodies import LinkPlaces
from burmester.synthesis.result import Candidate


@final
@dataclass(frozen=True, slots=True, eq=False)
class Assembly:
    """A linkage as plates and pins.

    reference: the linkage in millimetres; motion: where its links are along the stretch of the
    motion (n,) that holds the poses.  pins: in the order of its joints.
    unit: of the task's lengths; assumed: whether the task names none, nor the options, so that mm
    was taken.  pose: index of the place at which the assembly is drawn.
    """

    reference: Reference
    motion: LinkPlaces
    plates: tuple[Plate, ...]
    pins: tuple[Pin, ...]
    dimensions: Dimensions
    unit: str
    assumed: bool
    pose: int

    @property
    def body(self) -> str:
        """The link whose frame is M."""
        return self.reference.body

    @property
    def moving(self) -> tuple[str, ...]:
        """All bodies that move."""
        return self.reference.moving

    def plate(self, name: str) -> Plate | None:
        """The plate of a name, where there is one."""
        return next((each for each in self.plates if each.name == name), None)

    @property
    def drawn(self) -> LinkPlaces:
        """Where the links are in the drawing of the assembly."""
        return self.reference.at_poses[self.pose]


def assembly_of(chosen: Candidate, options: Options) -> Assembly:
    """The plates and pins of a linkage; raises E162 and E163."""
    unit, reference = unit_of(chosen, options), Reference.of(chosen, options)
    number = reference.places.shape[0]
    if not 1 <= options.pose <= number:
        raise InputError(
            "E162",
            f"there is no pose {options.pose} to draw",
            why=f"the task has {number} poses",
            help=Help.of(f"give {{}}, or another up to {number}", Cure("pose", 1)),
        )
    links = Links.of(reference)
    assumed = chosen.unit is None and options.unit is None
    stock = None if assumed else stock_for(unit)
    made = dimensions_of(links, options, reference.scale, unit, stock)
    plates, pins = arranged(links, made)
    return Assembly(reference, links.motion, plates, pins, made, unit, assumed, options.pose - 1)
