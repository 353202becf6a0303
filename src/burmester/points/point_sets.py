"""Point sets that are special: on a line, on a circle, on another conic, all of them or too many.

A coupler curve is of the sixth degree and goes three times through both circular points.  So a line
and a circle meet it in six points at most, unless the curve holds the circle: those of cranks do,
and of parallelograms and kites, which fall apart.
"""

from __future__ import annotations

from itertools import combinations
from typing import Final, Literal, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

FLAT: Final = 1e-7  # of the points' radius of gyration; points as near to a curve are on it
WITHIN_DIGITS: Final = 2.0  # half of the last digit: x and y may both be off by it, and the curve
LEAST_CIRCLE, LEAST_CONIC = 4, 6  # points that are not on such a curve as a rule
LEAST_OF_NINE: Final = 8  # points of nine; then 10 of 1442 linkages are at infinity, of nine 104
MOST_MET: Final = 6  # points of a line, or a circle, that a coupler curve meets
MOST_BESIDE: Final = 2  # points beside a line or a circle that holds the others
FAR: Final = 20.0  # radii of gyration; a circle of a larger radius is told as no circle


@final
class PointSet(NamedTuple):
    """The curve that points (N,) lie on, and which of them do; of a circle centre and radius."""

    kind: Literal["line", "circle", "conic"]
    on: NDArray[np.bool_]
    centre: FloatArray | None = None
    radius: float = 0.0


def point_set(points: FloatArray, digits: float = 0.0) -> PointSet | None:
    """The simplest curve that points (N, 2) lie on; None where they are in general position.

    All of them, or of nine all but one on a conic.
    digits: how exactly x and y are known, half of the last digit; points as near are on the curve.
    """
    number = len(points)
    if number < LEAST_CIRCLE:
        return None
    simple = _line(points, digits) or _circle(points, digits)
    if simple is not None or number < LEAST_CONIC:
        return simple
    some = [np.ones(number, dtype=bool)]
    if number > LEAST_OF_NINE:
        some += list(~np.eye(number, dtype=bool))
    return next((PointSet("conic", on) for on in some if _is_conic(points[on], digits)), None)


def line_or_circle(points: FloatArray, digits: float = 0.0) -> PointSet | None:
    """The line or circle on which points (N, 2) lie that are more than a coupler curve meets.

    All of them, or of a few all but MOST_BESIDE.  None where no such curve is known.
    """
    number = len(points)
    fewest = max(MOST_MET + 1, number - MOST_BESIDE)
    if number > MOST_MET + 1 + MOST_BESIDE:  # a curve that is nearly met; all or none
        fewest = number
    for size in range(number, fewest - 1, -1):
        for some in combinations(range(number), size):
            index = np.array(some)
            found = _line(points[index], digits) or _circle(points[index], digits)
            if found is not None:
                on = np.zeros(number, dtype=bool)
                on[index] = True
                return found._replace(on=on)
    return None


def _standard(points: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Points (N, 2) about their middle in their radii of gyration, as (2, N); middle; radius."""
    middle = points.mean(axis=0)
    size = float(np.sqrt(((points - middle) ** 2).sum(axis=1).mean())) or 1.0
    return ((points - middle) / size).T, middle, size


def _line(points: FloatArray, digits: float) -> PointSet | None:
    xy, _, size = _standard(points)
    away = np.abs(np.linalg.svd(xy, full_matrices=False)[0][:, -1] @ xy)
    near = away <= max(FLAT, WITHIN_DIGITS * digits / size)
    return PointSet("line", near) if near.all() else None


def _circle(points: FloatArray, digits: float) -> PointSet | None:
    (x, y), middle, size = _standard(points)
    rows = np.column_stack([x * x + y * y, x, y, np.ones_like(x)])
    a, b, c, d = np.linalg.svd(rows, full_matrices=False)[2][-1]
    if abs(a) * FAR < np.hypot(b, c) / 2:
        return None
    centre = -np.array([b, c]) / (2 * a)
    radius = float(np.sqrt(max(centre @ centre - d / a, 0.0)))
    away = np.abs(np.hypot(x - centre[0], y - centre[1]) - radius)
    near = away <= max(FLAT, WITHIN_DIGITS * digits / size)
    if not (near.all() and 0 < radius < FAR):
        return None
    return PointSet("circle", near, middle + size * centre, size * radius)


def _is_conic(points: FloatArray, digits: float) -> bool:
    """Whether points (N, 2) are as near to the conic nearest to them as their digits say."""
    (x, y), _, size = _standard(points)
    rows = np.column_stack([x * x, x * y, y * y, x, y, np.ones_like(x)])
    a, b, c, d, e, _ = own = np.linalg.svd(rows, full_matrices=False)[2][-1]
    slope = np.hypot(2 * a * x + b * y + d, b * x + 2 * c * y + e)
    allowed = max(FLAT, WITHIN_DIGITS * digits / size)
    return bool((np.abs(rows @ own) <= allowed * slope).all())
