"""Widths, holes and thicknesses of plates: as given, or chosen to suit the linkage.

E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.errors import InputError
from burmester.export.distances import distance
from burmester.export.features import Features
from burmester.export.options import Options
from burmester.fourbar.dyad import RR

__all__ = ["WALL", "Dimensions", "dimensions_of"]

WIDTH = 0.12  # of the median link length: width of links
MAX_WIDTH = 0.6  # of the shortest distance between two holes: largest width and hole
HOLE = 0.4  # of the width: diameter of holes
THICKNESS = 0.4  # of the width: thickness of plates
GAP = 0.1  # of the thickness: gap between plates
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


def dimensions_of(features: Features, options: Options, scale: float, unit: str) -> Dimensions:
    """The dimensions given or chosen, in millimetres; raises E162."""
    near = distance(*features.of_link("coupler"))
    lengths = [float(dyad.radius) for dyad in features.dyads if isinstance(dyad, RR)]
    between = {
        f"{name} link": float(dyad.radius)
        for name, dyad in zip(("driver's", "follower's"), features.dyads, strict=True)
        if isinstance(dyad, RR)
    }
    between["two joints of the coupler"] = near
    least_name, least = min(between.items(), key=lambda item: item[1])
    ground = [pivots.mean(axis=0) for pivots in features.of_link("ground")]
    lengths += [near, float(np.linalg.norm(ground[1] - ground[0]))]
    travels = [
        float(np.linalg.norm(each[1] - each[0])) for each in features.reach if each is not None
    ]
    size = float(np.median([each for each in lengths + travels if each > 0] or [1.0]))

    if not least > MIN_DISTANCE * size:
        raise InputError(
            "E163",
            "this linkage cannot be made of plates with pins and slots",
            why="both joints of the coupler are at one point of it: a slot runs through them"
            if least_name.startswith("two")
            else f"the {least_name} has no length",
            help="choose another linkage, or a table of its places: --to csv",
        )
    stated = {
        name: None if value is None else value * scale
        for name, value in (
            ("hole", options.hole),
            ("width", options.width),
            ("thickness", options.thickness),
            ("gap", options.gap),
        )
    }
    for name, value in stated.items():
        if value is not None and not (math.isfinite(value) and value > 0):
            if name == "gap" and value == 0:
                continue
            raise InputError(
                "E162",
                f"a {name} of {value / scale:g} {unit} cannot be made",
                why="the value has to be above 0",
                help=f"leave --{name} out, and it is chosen from the linkage's size",
            )
    width, hole = stated["width"], stated["hole"]
    if width is None:
        most = min(WIDTH * size, MAX_WIDTH * least)
        width = _rounded(most if hole is None else hole / HOLE)
    if hole is None:
        hole = _rounded(min(HOLE * width, MAX_WIDTH * least))
    most_hole = width / (1 + 2 * WALL)
    if not hole <= most_hole * (1 + 1e-9):
        raise InputError(
            "E162",
            f"a hole of {hole / scale:.6g} {unit} is too wide for a link of width "
            f"{width / scale:.6g} {unit}",
            why=f"on each side {WALL:.0%} of the hole has to be left of the link, so the hole can "
            f"be {most_hole / scale:.6g} {unit} at most",
            help=f"give --hole {_down(most_hole / scale)}, or --width {_up(hole * 1.2 / scale)}",
        )
    most_hole = least / (1 + WALL)
    if not hole <= most_hole:
        what = least_name if least_name.startswith("two") else f"the {least_name}'s two holes"
        raise InputError(
            "E162",
            f"holes of {hole / scale:.6g} {unit} would overlap",
            why=f"{what} are {least / scale:.6g} {unit} apart",
            help=f"give --hole {_down(most_hole / scale)}",
        )
    thickness = (
        stated["thickness"] if stated["thickness"] is not None else _rounded(THICKNESS * width)
    )
    gap = stated["gap"] if stated["gap"] is not None else _rounded(GAP * thickness)
    return Dimensions(hole, width, thickness, gap)


def _rounded(value: float) -> float:
    """Down to two digits."""
    if not value > 0:
        return value
    digits = 1 - math.floor(math.log10(value))
    return float(_down(value, digits))


def _down(value: float, digits: int | None = None) -> str:
    digits = 1 - math.floor(math.log10(value)) if digits is None else digits
    step = 10.0**-digits
    return f"{round(math.floor(value / step + 1e-9) * step, max(digits, 0)):g}"


def _up(value: float) -> str:
    digits = 1 - math.floor(math.log10(value))
    step = 10.0**-digits
    return f"{round(math.ceil(value / step - 1e-9) * step, max(digits, 0)):g}"
