"""A linkage as plates with holes and slots, in layers on each other: what the formats draw and cut.

Everything here is in millimetres.

E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.errors import InputError
from burmester.export.options import MILLIMETRES, Options, unit_of
from burmester.export.parts.dimensions import Dimensions, dimensions_of
from burmester.export.parts.features import Features, scaled
from burmester.export.parts.layers import arranged
from burmester.export.parts.outlines import slot_outline
from burmester.export.parts.plate import Pin, Plate, outline_points
from burmester.export.parts.stock import stock_for
from burmester.export.reference import require_places
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = [
    "Assembly",
    "Dimensions",
    "Pin",
    "Plate",
    "assembly_of",
    "in_millimetres",
    "outline_points",
    "places_of_motion",
    "slot_outline",
]

MOTION_SAMPLES = 721  # places along the motion at which plates are compared


@final
@dataclass(frozen=True, slots=True, eq=False)
class Assembly:
    """A linkage as plates and pins.

    scale: millimetres per unit of the task's lengths; unit: of those.
    assumed: whether the task names no unit, nor the options, so that mm was taken.
    places: (N,), of the coupler at the poses; motion: (n,), of the coupler along the stretch of
    the motion that holds the poses; both in millimetres.
    pose: index of the place at which the assembly is drawn.
    """

    plates: tuple[Plate, ...]
    pins: tuple[Pin, ...]
    dimensions: Dimensions
    scale: float
    unit: str
    assumed: bool
    places: Displacement
    motion: Displacement
    pose: int

    def plate(self, name: str) -> Plate | None:
        """The plate of a name, where there is one."""
        return next((each for each in self.plates if each.name == name), None)

    @property
    def drawn(self) -> Displacement:
        """The coupler's place at which the assembly is drawn."""
        return self.places[self.pose]


def in_millimetres(places: Displacement, scale: float) -> Displacement:
    """Places (*,) in millimetres; scale: millimetres per unit of theirs."""
    return Displacement(places.translation * scale, places.angle)


def assembly_of(chosen: SavedLinkage, options: Options) -> Assembly:
    """The plates and pins of a linkage; raises E162 and E163."""
    require_places(chosen)
    unit = unit_of(chosen, options)
    scale = MILLIMETRES[unit]
    first, second = (scaled(dyad, scale) for dyad in (chosen.linkage.first, chosen.linkage.second))
    number = chosen.error.places.shape[0]
    if not 1 <= options.pose <= number:
        raise InputError(
            "E162",
            f"there is no pose {options.pose} to draw",
            why=f"the task has {number} poses",
            help=f"give --pose 1, or another up to {number}",
        )
    places = in_millimetres(chosen.error.places, scale)
    motion = places_of_motion(Linkage(first, second), places)
    features = Features(first, second, motion)
    assumed = chosen.unit is None and options.unit is None
    made = dimensions_of(features, options, scale, unit, None if assumed else stock_for(unit))
    plates, pins = arranged(features, made)
    return Assembly(
        plates,
        pins,
        made,
        scale,
        unit,
        assumed,
        places,
        motion,
        options.pose - 1,
    )


def places_of_motion(
    linkage: Linkage, places: Displacement, looks: int = MOTION_SAMPLES
) -> Displacement:
    """Coupler places (n,) along each branch of a circuit from its first to its last of places (N,).

    The places themselves are among them, in their order along the way.  Whole turns are cut where
    the places leave the widest gap.
    """
    circuits = Circuits.of(linkage, as_given=True)
    here = circuit_of(linkage, places, as_given=True)
    rows: list[FloatArray] = []
    on = np.isfinite(here.parameter) & (here.circuit >= 0)
    for circuit, branch in sorted(set(zip(here.circuit[on], here.branch[on], strict=True))):
        own = circuits[int(circuit)]
        which = on & (here.circuit == circuit) & (here.branch == branch)
        s = here.parameter[which]
        if own.closed and own.branches == 1:
            order = np.sort(s % (2 * np.pi))
            gap = np.append(order[1:], order[0] + 2 * np.pi) - order
            cut = order[(int(gap.argmax()) + 1) % len(order)]
            s = cut + (s - cut) % (2 * np.pi)
        s = np.unique(np.concatenate([np.linspace(s.min(), s.max(), looks), s]))
        with np.errstate(invalid="ignore", divide="ignore"):
            along = own.couplers(s)
        rows.append(np.column_stack([along.translation, along.angle]))
    rows.append(np.column_stack([places.translation, places.angle]))
    table = np.concatenate(rows if len(rows) == 1 else rows[:-1])
    return Displacement.from_poses(table[np.isfinite(table).all(axis=1)])
