"""Drills, pins, sheets, bars and shims that a shop has, in millimetres or in inches.

Pins and the holes in which they turn: pins or screws of a size with the clearance hole of the fine
series of ISO 273; in inches with the close fit of ASME B18.2.8, whose step of 1/64 in is taken for
pins below 1/4 in, too, so that all inch holes are fractional drills (ASME B94.11M).
Widths: flat bars, from 10 mm on those of EN 10058.  Thicknesses: sheets and plates; thin ones in
inches by the Manufacturers' Standard Gauge for steel.  Gaps: shim rings and spacers.  Where no
standard is named, the list is what dealers commonly have.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, final

NEAR: Final = 1.5  # largest ratio of a size in stock and the one that is wanted
INCH: Final = 25.4  # mm
GAUGES: Final = {  # inches
    26: 0.0179,
    24: 0.0239,
    22: 0.0299,
    20: 0.0359,
    18: 0.0478,
    16: 0.0598,
    14: 0.0747,
    12: 0.1046,
    10: 0.1345,
}


@final
@dataclass(frozen=True, slots=True)
class Stock:
    """Sizes in millimetres, each list from small to large.

    joints: pins, each with the hole in which it turns; widths: of bars; sheets: thicknesses; shims:
    gaps between plates.  inches: whether they are sizes in inches.
    """

    joints: tuple[tuple[float, float], ...]
    widths: tuple[float, ...]
    sheets: tuple[float, ...]
    shims: tuple[float, ...]
    inches: bool = False

    @property
    def holes(self) -> tuple[float, ...]:
        """The holes in which the pins turn."""
        return tuple(hole for _, hole in self.joints)

    def pin_for(self, hole: float) -> float | None:
        """The pin that turns in a hole; None where the list does not have this hole."""
        return next((pin for pin, own in self.joints if _same(own, hole)), None)

    def hole_for(self, pin: float) -> float | None:
        """The hole in which a pin turns; None where the list does not have this pin."""
        return next((hole for own, hole in self.joints if _same(own, pin)), None)

    def has(self, size: float) -> bool:
        """Whether a size is in one of the lists."""
        lists = (self.widths, self.sheets, self.shims, *self.joints)
        return any(_same(each, size) for sizes in lists for each in sizes)

    def name(self, size: float) -> str:
        """A size as the shop calls it: 5.3 mm, 13/64 in, 16 gauge (0.0598 in)."""
        if not self.inches:
            return f"{size:g} mm"
        inches = size / INCH
        for gauge, thickness in GAUGES.items():
            if _same(thickness, inches):
                return f"{gauge} gauge ({inches:g} in)"
        whole, part = divmod(Fraction(round(inches * 64), 64), 1)
        if _same(float(whole + part), inches):
            return f"{' '.join(str(each) for each in (whole, part) if each)} in"
        return f"{inches:.4g} in"


def _same(one: float, two: float) -> bool:
    return abs(one - two) <= 1e-6 * two


def nearest(sizes: Iterable[float], wanted: float, most: float) -> float | None:
    """The size nearest to the wanted one by ratio, up to a largest; None where none is near."""

    def ratio(size: float) -> float:
        return max(size / wanted, wanted / size)

    within = [size for size in sizes if size <= most * (1 + 1e-9) and ratio(size) <= NEAR]
    return min(within, key=ratio, default=None)


def stock_for(unit: str) -> Stock:
    """The stock of a shop that works in a unit, one of `options.MILLIMETRES`."""
    return INCHES if unit in ("in", "ft") else METRIC


def _joints(text: str) -> tuple[tuple[float, float], ...]:
    pairs = (each.split(":") for each in text.split())
    return tuple((float(pin), float(hole)) for pin, hole in pairs)


def _in(text: str) -> tuple[float, ...]:
    """Inches, whole, decimal or as fractions, in millimetres."""
    return tuple(float(Fraction(each)) * INCH for each in text.split())


METRIC: Final = Stock(
    _joints(
        "1:1.1 1.2:1.3 1.6:1.7 2:2.2 2.5:2.7 3:3.2 4:4.3 5:5.3 6:6.4 8:8.4 10:10.5 12:13 14:15 "
        "16:17 20:21 24:25 30:31 36:37 42:43 48:50 56:58 64:66"
    ),
    (3, 4, 5, 6, 8, 10, 12, 15, 16, 20, 25, 30, 35, 40, 45, 50, 60, 70, 80, 90, 100, 120, 150),
    (0.5, 0.8, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 40, 50, 60),
    (0.1, 0.2, 0.3, 0.5, 1, 1.5, 2, 3, 4, 5),
)

INCHES: Final = Stock(
    tuple(
        zip(
            _in("1/16 3/32 1/8 5/32 3/16 1/4 5/16 3/8 7/16 1/2 5/8 3/4 7/8 1 5/4 3/2"),
            _in(
                "5/64 7/64 9/64 11/64 13/64 17/64 21/64 25/64 29/64 17/32 21/32 25/32 29/32 33/32 "
                "41/32 25/16"
            ),
            strict=True,
        )
    ),
    _in("1/8 3/16 1/4 3/8 1/2 5/8 3/4 1 5/4 3/2 7/4 2 5/2 3 7/2 4 5 6"),
    (
        *(thickness * INCH for thickness in GAUGES.values()),
        *_in("3/16 1/4 5/16 3/8 1/2 5/8 3/4 1 5/4 3/2 2 5/2"),
    ),
    _in("0.005 0.010 0.015 0.020 0.031 0.047 0.062 0.093 0.125 0.188 0.25"),
    inches=True,
)
