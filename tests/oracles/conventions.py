"""Poses of a crank-rocker, worked out by two circles, and the same as other programs write them."""

import cmath
import math

GROUND, CRANK, COUPLER, ROCKER = complex(100, 20), 35.0, 95.0, 80.0
ORIGIN = complex(30, 25)  # of the body: in axes along the coupler, from the crank's pin


def crank_rocker(count=12, first=20.0, step=24.0, decimals=4):
    """Poses (x, y, angle in degrees), rounded; the crank's fixed pivot is at 0, the other's GROUND.

    The moving pivots in the body are at -ORIGIN and COUPLER - ORIGIN.
    """
    rows = []
    for k in range(count):
        pin = CRANK * cmath.exp(1j * math.radians(first + step * k))
        to = GROUND - pin
        cosine = (COUPLER**2 + abs(to) ** 2 - ROCKER**2) / (2 * COUPLER * abs(to))
        angle = cmath.phase(to) + math.acos(cosine)
        place = pin + ORIGIN * cmath.exp(1j * angle)
        row = (place.real, place.imag, math.degrees(angle))
        rows.append(tuple(round(value, decimals) for value in row))
    return rows


def _rounded(turn, decimals=6):
    return round(turn.real, decimals), round(turn.imag, decimals)


def table(rows, header="x,y,angle_deg"):
    """Rows as a CSV file."""
    return header + "\n" + "".join(",".join(f"{v:.8g}" for v in row) + "\n" for row in rows)


def written(rows, *conventions):
    """The rows as a program writes them that does otherwise; right is what is in no convention."""
    change = {
        "clockwise": lambda x, y, a: (x, y, -a),
        "y-down": lambda x, y, a: (x, -y, a),
        "swap-xy": lambda x, y, a: (y, x, a),
        "radians": lambda x, y, a: (x, y, round(math.radians(a), 6)),
        "degrees": lambda x, y, a: (x, y, math.degrees(a)),
        "directions": lambda x, y, a: (x, y, *_rounded(cmath.rect(1, math.radians(a)))),
    }
    for name in conventions:
        rows = [change[name](*row) for row in rows]
    return rows
