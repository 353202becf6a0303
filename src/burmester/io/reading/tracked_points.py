"""Two tracked points of a body as its poses."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.io.reading.pose_table import extent, known_to
from burmester.numerics.arrays import FloatArray

__all__ = ["Tracked", "tracked_poses"]

MAX_DISTANCE_CHANGE = 0.1  # relative change of |pq|; above it the points are refused


_RowLocator: TypeAlias = Callable[[int | None], str]  # where a row stands


class Tracked(NamedTuple):
    """Poses from two points, and how exactly they are known."""

    poses: Displacement
    resolution: tuple[float, float]  # from the digits: length, and angle in radians
    sigma: tuple[float, float] | None  # from the distance, if it varies more than that


def tracked_poses(
    points: FloatArray,
    decimals: float,
    numbers: NDArray[np.intp],
    locate_row: _RowLocator | None = None,
) -> Tracked:
    """Poses whose origin is p, exactly as given, and whose x axis points from p to q.

    points: (N, 4) rows (px, py, qx, qy), in one unit.
    decimals: the largest number of decimals that a coordinate is printed with.
    numbers: (N,) the number of each row in its file, from 0; locate_row gives its location.
    The distance |pq| of a rigid body is constant.  Where it varies more than the digits
    explain, its standard deviation measures the noise: it is sqrt(2) times that of a coordinate,
    and |pq| times that of the angle.
    Raises E111 where p and q coincide, or where |pq| varies by more than 10 percent.
    """
    p, q = points[:, :2], points[:, 2:4]
    with np.errstate(over="ignore"):
        x, y = (q - p).T
        distance = np.hypot(x, y)
    if (bad := (distance == 0) | ~np.isfinite(distance)).any():
        row = int(numbers[bad.argmax()])
        why = "p and q are the same point"
        if distance[bad.argmax()]:
            why = "p and q are more than 1.8e308 apart, the largest representable number"
        raise _refusal(f"row {row + 1} gives no angle", why, row, locate_row)
    poses = Displacement(p, np.arctan2(y, x))
    if not len(points):
        return Tracked(poses, (0.0, 0.0), None)
    least, most = distance.min(), distance.max()
    if most > (1 + MAX_DISTANCE_CHANGE) * least:
        raise _not_rigid(distance, numbers, locate_row)
    half = known_to(0.5 * 10.0**-decimals, extent(p))
    resolution = (half, min(2 * half / float(least), math.pi))
    if len(points) < 2:
        return Tracked(poses, resolution, None)
    # two coordinates a point, each within half a digit, and the rounding of doubles besides
    spread = float(np.std(distance / most, ddof=1)) * float(most)
    explained = max(
        math.sqrt(2 / 3) * half, 4 * float(np.finfo(np.float64).eps * np.abs(points).max())
    )
    sigma = (spread / math.sqrt(2), spread / float(most)) if spread > 2 * explained else None
    return Tracked(poses, resolution, sigma)


def _not_rigid(
    distance: FloatArray, numbers: NDArray[np.intp], locate_row: _RowLocator | None
) -> InputError:
    """E111, at the row whose distance is furthest from the usual one."""
    short, long = int(distance.argmin()), int(distance.argmax())
    least, usual, most = (float(f(distance)) for f in (np.min, np.median, np.max))
    odd = short if usual / least > most / usual else long
    apart = [f"{distance[k]:.6g} apart in row {numbers[k] + 1}" for k in sorted((short, long))]
    why = f"they are {apart[0]} and {apart[1]}, a change of more than 10 percent"
    return _refusal("p and q do not stay on one rigid body", why, int(numbers[odd]), locate_row)


def _refusal(message: str, why: str, row: int, locate_row: _RowLocator | None) -> InputError:
    help = f"correct row {row + 1}, or leave it out: delete it, or pass --drop {row + 1}"
    return InputError(
        "E111", message, where=locate_row(row) if locate_row else None, why=why, help=help
    )
