"""Widths, holes, pins and thicknesses of plates: as given, or chosen to suit the linkage.

What is chosen follows the linkage's size.  Where the unit is known, it is the nearest size that a
shop has in stock; where none is near, the number itself.

E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import final

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.options import Options
from burmester.export.parts.links import Links, Spacing
from burmester.export.parts.stock import INCH, Stock, nearest

WIDTH = 0.12  # of the median link length: width of links
MAX_WIDTH = 0.6  # of the shortest distance between two holes: largest width and hole
HOLE = 0.4  # of the width: diameter of holes
THICKNESS = 0.4  # of the width: thickness of plates
GAP = 0.1  # of the thickness: gap between plates
PIN_CLEARANCE = 0.02  # of a hole's diameter: a pin that no list has is thinner by this
WALL = 0.1  # of a hole's diameter: least material beside it
MIN_DISTANCE = 1e-6  # of the median link length: below it there is no room for two holes


@final
@dataclass(frozen=True, slots=True)
class Dimensions:
    """The dimensions of plates and pins, in millimetres."""

    hole: float
    width: float
    thickness: float
    gap: float
    pin: float


def dimensions_of(
    links: Links, options: Options, scale: float, unit: str, stock: Stock | None
) -> Dimensions:
    """The dimensions given or chosen, from a stock if there is one, in millimetres; raises E162."""
    least = _least(links)
    given = _given(options, scale, unit)
    hole, width, thickness, gap, pin = (
        given[each] for each in ("hole", "width", "thickness", "gap", "pin")
    )

    mark = INCH if stock and stock.inches else 1.0  # mm: of the rule that the shop uses

    def chosen(what: str, wanted: float, most: float = math.inf) -> float:
        in_stock = nearest(getattr(stock, what), wanted, most) if stock else None
        return _rounded(wanted / mark) * mark if in_stock is None else in_stock

    if hole is None and pin is not None:
        hole = (stock.hole_for(pin) if stock else None) or pin / (1 - PIN_CLEARANCE)
    most = MAX_WIDTH * least.apart
    if width is None and hole is not None:
        width = chosen("widths", hole / HOLE)
    elif width is None:
        width = chosen("widths", min(WIDTH * links.size, most), most)
    if hole is None:
        hole = chosen("holes", min(HOLE * width, most), min(most, width / (1 + 2 * WALL)))
    if pin is None:
        pin = (stock.pin_for(hole) if stock else None) or hole * (1 - PIN_CLEARANCE)
    if thickness is None:
        thickness = chosen("sheets", THICKNESS * width)
    if gap is None:
        gap = chosen("shims", GAP * thickness)
    made = Dimensions(hole, width, thickness, gap, pin)
    _require_room(made, least, scale, unit)
    return made


def _least(links: Links) -> Spacing:
    """The two holes of a moving link that are nearest to each other; raises E163."""
    least = min(links.spacings, key=lambda each: each.apart)
    if not least.apart > MIN_DISTANCE * links.size:
        raise InputError(
            "E163",
            "this linkage cannot be made of plates with pins and slots",
            why=f"{least.holes} are at one point",
            help=Help.of("choose another linkage, or a table of its places: {}", Cure("to", "csv")),
        )
    return least


def _given(options: Options, scale: float, unit: str) -> dict[str, float | None]:
    """The dimensions that the options state, in millimetres; raises E162."""
    given: dict[str, float | None] = {}
    for name in ("hole", "width", "thickness", "gap", "pin"):
        value: float | None = getattr(options, name)
        given[name] = None if value is None else value * scale
        if value is None or (math.isfinite(value * scale) and value * scale > 0):
            continue
        if not (name == "gap" and value == 0):
            raise InputError(
                "E162",
                f"a {name} of {value:g} {unit} cannot be made",
                why="the value has to be above 0",
                help=Help.of("leave {} out, and it is chosen from the linkage's size", Cure(name)),
            )
    return given


def _require_room(made: Dimensions, least: Spacing, scale: float, unit: str) -> None:
    """Raise E162 where a hole has no room in its link, beside another hole, or for its pin."""
    hole, width = made.hole, made.width
    most_hole = width / (1 + 2 * WALL)
    if not hole <= most_hole * (1 + 1e-9):
        raise InputError(
            "E162",
            f"a hole of {hole / scale:.6g} {unit} is too wide for a link of width "
            f"{width / scale:.6g} {unit}",
            why=f"on each side {WALL:.0%} of the hole has to be left of the link, so the hole can "
            f"be {most_hole / scale:.6g} {unit} at most",
            help=Help.of(
                "give {}, or {}",
                Cure("hole", _down(most_hole / scale)),
                Cure("width", _up(hole * 1.2 / scale)),
            ),
        )
    most_hole = least.apart / (1 + WALL)
    if not hole <= most_hole:
        raise InputError(
            "E162",
            f"holes of {hole / scale:.6g} {unit} would overlap",
            why=f"{least.holes} are {least.apart / scale:.6g} {unit} apart",
            help=Help.of("give {}", Cure("hole", _down(most_hole / scale))),
        )
    if not made.pin <= hole:
        raise InputError(
            "E162",
            f"a pin of {made.pin / scale:.6g} {unit} does not go into a hole of "
            f"{hole / scale:.6g} {unit}",
            why="the pin is the thicker one of the two",
            help=Help.of("give {}, or leave {} out", Cure("pin", _down(hole / scale)), Cure("pin")),
        )


def _rounded(value: float) -> float:
    """Down to two digits."""
    if not value > 0:
        return value
    digits = 1 - math.floor(math.log10(value))
    return float(_down(value, digits))


def _down(value: float, digits: int | None = None) -> float:
    digits = 1 - math.floor(math.log10(value)) if digits is None else digits
    step = 10.0**-digits
    return float(f"{round(math.floor(value / step + 1e-9) * step, max(digits, 0)):g}")


def _up(value: float) -> float:
    digits = 1 - math.floor(math.log10(value))
    step = 10.0**-digits
    return float(f"{round(math.ceil(value / step - 1e-9) * step, max(digits, 0)):g}")
