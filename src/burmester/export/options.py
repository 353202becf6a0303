"""The options of an export, and the unit of its lengths.

E162 dimensions that cannot be made
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.synthesis.result import Candidate
from burmester.tasks.length_units import MILLIMETRES
from burmester.wording import in_unit


@final
@dataclass(frozen=True, slots=True)
class Options:
    """The options of an export; a dimension that is None is chosen from the linkage's size.

    Where the unit of lengths is known, it is a size that shops have: see `parts.stock`.

    Attributes
    ----------
    unit : str or None
        Unit of the task's lengths, where the task states none or px; mm where both are None.
    hole, width, thickness, gap, pin : float or None
        Diameter of holes, width of links, thickness of plates, gap between plates that lie on each
        other, diameter of pins; in the unit of the task's lengths.
    pose : int
        The pose at which the assembly is drawn, from 1.
    dimensions : bool
        Whether drawings have dimension lines.
    assembled : bool
        Whether the parts of an STL are in their places, not flat beside each other.
    density : float
        Of the material of all plates and pins, kg/m³, for models with masses; aluminium.
    up : str
        The direction of the ground frame that gravity points away from: x, y, z, -x, -y or -z.
    seconds, frames_per_second, width_px : float, float, int
        Duration, frame rate and width of moving pictures.
    """

    unit: str | None = None
    hole: float | None = None
    width: float | None = None
    thickness: float | None = None
    gap: float | None = None
    pin: float | None = None
    pose: int = 1
    dimensions: bool = True
    assembled: bool = False
    density: float = 2700.0
    up: str = "y"
    seconds: float = 4.0
    frames_per_second: float = 25.0
    width_px: int = 800


def unit_cure(unit: str | None = None) -> Cure:
    """What states a unit of lengths."""
    named = f"the option unit {unit}" if unit else "the option unit"
    return Cure("unit", unit, "--length-unit", words=named)


def unit_of(chosen: Candidate, options: Options) -> str:
    """The unit of the linkage's lengths, a key of `MILLIMETRES`; raises E162.

    Lengths that the task states in another unit, such as px, count as one of the unit that the
    options state.
    """
    known = ", ".join(MILLIMETRES)
    own, stated = chosen.unit, options.unit
    if stated is not None and stated not in MILLIMETRES:
        raise InputError(
            "E162",
            f"there is no unit {stated!r}",
            why=f"the units are {known}",
            help=Help.of("give {}", unit_cure("mm")),
        )
    if own in MILLIMETRES and stated is not None and own != stated:
        raise InputError(
            "E162",
            f"the lengths of this linkage are{in_unit(own)}, not{in_unit(stated)}",
            why="the poses state that unit",
            help=Help.of("leave {} out", unit_cure()),
        )
    if stated is None and own is not None and own not in MILLIMETRES:
        raise InputError(
            "E162",
            f"how long one {own} is has to be known for this format",
            why=f"the lengths of this linkage are{in_unit(own)}, and the units are {known}",
            help=Help(f"say what one {own} counts as: ", unit_cure("mm")),
        )
    return own if own is not None and own in MILLIMETRES else stated or "mm"


def stated_unit(chosen: Candidate, options: Options) -> str | None:
    """The unit in which the task or the options say lengths are; None where nobody does.

    For formats that keep the task's lengths, which may be in px as well; raises E162.
    """
    if options.unit is None and chosen.unit in (None, "px"):
        return chosen.unit
    return unit_of(chosen, options)
