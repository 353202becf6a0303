"""Linkages rebuilt from printed dimensions, and moved to their poses by the tracer's equations."""

import math
import re

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from tests.oracles.tracer import back_on, directions, gap

# Names of dimensions.
WHAT = r"(fixed pivot|moving pivot|length|line in [FM], through|direction)"
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
STEPS = 200  # along the coupler's motion, to the place nearest to a pose


def numbers(text):
    return [float(each) for each in NUMBER.findall(text)]


def dyad_of(rows):
    """A dyad from its printed dimensions: pairs of a name and a value."""
    told = {re.sub(r" in [FM], through", "", name): numbers(value) for name, value in rows}
    fixed, moving = (np.array(told.get(f"{each} pivot", ())) for each in ("fixed", "moving"))
    if "length" in told:
        return RR(fixed, moving, np.array(told["length"][0]))
    (direction,), through = told["direction"], complex(*told["line"])
    angle = math.radians(direction) - math.pi / 2
    line = np.array(angle), np.array((through * np.exp(-1j * angle)).real)
    return RP(fixed, *line) if len(fixed) else PR(*line, moving)


def dyads_of(rows):
    """Both dyads of a linkage from rows of a dyad's name, a dimension's name and its value."""
    names = list(dict.fromkeys(name for name, _, _ in rows))
    return [dyad_of([(what, value) for own, what, value in rows if own == each]) for each in names]


def in_full(text):
    """The rows under "L1 in full" on a terminal, or of L1 with a row a dyad."""
    rows, name = [], None
    if flat := re.search(r"\nL1 +fixed pivot .*\n((?:D.*\n)+)", text):
        names = "fixed pivot", "moving pivot", "length"
        for line in flat[1].splitlines():
            dyad, *values = re.split(r"  +", line)
            rows += [(dyad, *each) for each in zip(names, values, strict=True)]
        return rows
    for line in re.split(r"\nL1 in full.*\n", text)[1].splitlines():
        match = re.match(
            rf"(\w*) +{WHAT} +(.+?)(?: *±.*| *not determined.*)?$",
            line,
        )
        if match is None:
            break
        name = match[1] or name
        rows.append((name, match[2], match[3]))
    return rows


def in_drawing(text):
    """The rows of the lines of text in an SVG or DXF drawing."""
    rows = []
    # A description has both dyads in one line: each ends where the name of the next one begins.
    dyad = r"(\w+): ((?:(?:fixed|moving) pivot|line in) (?:(?! \w+: )[^<\n])*)"
    for name, line in re.findall(dyad, text):
        for what, value in re.findall(rf"{WHAT} (\([^)]*\)|[^,<]+)", line):
            rows.append((name, what, value.rstrip(".")))
    return rows


def errors_at(dyads, poses, length, start=None):
    """Position and angle errors (N,) at poses (N,), of the place of the coupler near each of them.

    Near by the squares of distances and of length times angles.  From the pose (or rows x, y,
    angle to start from) straight onto the linkage, then along its motion to the nearest place.
    """
    size = max(length, float(np.ptp(poses.translation, axis=0).max()))
    linkage = Linkage(*(in_units(each, size) for each in dyads))
    wanted = np.column_stack([poses.translation / size, poses.angle])
    weight = np.array([1.0, 1.0, (length / size) ** 2])
    at = wanted.copy() if start is None else start / [size, size, 1.0]
    at = back_on(linkage, at)
    for _ in range(STEPS):
        along = directions(linkage, at)
        off = gap(wanted.copy(), at)
        step = (weight * off * along).sum(axis=1) / (weight * along**2).sum(axis=1)
        at = back_on(linkage, at + np.clip(step, -0.05, 0.05)[:, None] * along)
    off = gap(wanted.copy(), at)
    return size * np.hypot(off[:, 0], off[:, 1]), np.abs(off[:, 2])


def most(text):
    """The greatest value that a printed figure can stand for."""
    mantissa, _, power = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return (float(mantissa) + 0.5 * 10.0**-decimals) * 10.0 ** int(power or 0)


def in_units(dyad, size):
    """A dyad in another unit of length."""
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot / size, dyad.moving_pivot / size, dyad.radius / size)
    if isinstance(dyad, PR):
        return PR(dyad.normal_angle, dyad.offset / size, dyad.moving_pivot / size)
    return RP(dyad.fixed_pivot / size, dyad.normal_angle, dyad.offset / size)
