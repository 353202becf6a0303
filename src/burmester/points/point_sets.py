"""Point sets that are special: on a line, on a circle, on another conic."""

from __future__ import annotations

from typing import Final, Literal, NamedTuple, final

import numpy as np

from burmester.numerics.arrays import FloatArray

__all__ = ["PointSet", "point_set"]

FLAT: Final = 1e-7  # relative; a singular value below this is rounding
LEAST_CIRCLE, LEAST_CONIC = 4, 6  # points that are not on such a curve as a rule


@final
class PointSet(NamedTuple):
    """The curve that points lie on; of a circle centre and radius."""

    kind: Literal["line", "circle", "conic"]
    centre: FloatArray | None = None
    radius: float = 0.0


def point_set(points: FloatArray) -> PointSet | None:
    """The simplest curve that points (N, 2) lie on; None where they are in general position."""
    if len(points) < LEAST_CIRCLE:
        return None
    middle = points.mean(axis=0)
    size = float(np.sqrt(((points - middle) ** 2).sum(axis=1).mean()))
    if not size:
        return None
    x, y = ((points - middle) / size).T
    one = np.ones_like(x)
    if _is_flat(np.column_stack([x, y])):
        return PointSet("line")
    circle = np.column_stack([x * x + y * y, x, y, one])
    if _is_flat(circle):
        a, b, c, d = np.linalg.svd(circle)[2][-1]
        centre = -np.array([b, c]) / (2 * a)
        radius = float(np.sqrt(centre @ centre - d / a))
        return PointSet("circle", middle + size * centre, size * radius)
    conic = np.column_stack([x * x, x * y, y * y, x, y, one])
    return PointSet("conic") if len(points) >= LEAST_CONIC and _is_flat(conic) else None


def _is_flat(rows: FloatArray) -> bool:
    """Whether rows (N, n) have a combination that vanishes."""
    singular = np.linalg.svd(rows, compute_uv=False)
    return bool(singular[-1] < FLAT * singular[0])
