"""Tracked points of a body as its poses: two as they are, three or more as a rigid body."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.io.reading.pose_table import extent, resolution_by_digits
from burmester.numerics.arrays import FloatArray, complex_of, pairs_of
from burmester.wording import listed

MAX_ROUNDS = 100  # of turning all places to the mean shape; a few are enough where noise is small
TURN_TOLERANCE = 1e-14  # radians; the rounds end with a lesser turn
MAX_ODD_ROWS = 2  # of more rows that are not rigid the markers are to blame, and no row
MAX_DISTANCE_CHANGE = 0.1  # relative change of |pq|; above it the points are refused


class RigidFit(NamedTuple):
    """The places of a body, in its frame with origin at point 1 and x axis towards point 2."""

    poses: Displacement
    residuals: FloatArray  # (N, K, 2), measured minus fitted points, in the frame of the body
    shape: FloatArray  # (K, 2), the points in the frame of the body
    noise: float  # standard deviation of a coordinate

    @property
    def rms(self) -> float:
        """The root mean square distance between measured and fitted points."""
        return float(np.sqrt((self.residuals**2).sum(axis=2).mean()))

    @property
    def sigma(self) -> tuple[float, float]:
        """Standard deviations of a coordinate of the origin, and of the angle in radians."""
        about_centre = self.shape - self.shape.mean(axis=0)
        inertia = float((about_centre**2).sum())
        arm = float((about_centre[0] ** 2).sum())
        origin = self.noise * np.sqrt(1 / len(self.shape) + arm / (2 * inertia))
        return float(origin), float(self.noise / np.sqrt(inertia))


def fit_rigid_body(points: FloatArray) -> RigidFit:
    """The rigid body nearest to points, in the sense of least squares (Procrustes).

    points: (N, K, 2), K >= 2 points in N places; they do not all coincide.
    Shape and places are fitted together: the shape is the mean of the places turned onto it.
    """
    z = complex_of(points)
    centre = z.mean(axis=1, keepdims=True)
    z = z - centre
    shape = z[0]
    for _ in range(MAX_ROUNDS):
        turn = _direction(z @ shape.conj())
        mean = (z * turn.conj()[:, None]).mean(axis=0)
        change = _direction(np.vdot(shape, mean)[None])[0]
        moved = float(np.abs(mean - shape * change).max())
        shape = mean
        if moved <= TURN_TOLERANCE * float(np.abs(shape).max()):
            break
    axis = _direction((shape[1] - shape[0])[None])[0]
    shape = shape / axis
    turn = _direction(z @ shape.conj())
    origin = centre[:, 0] + turn * shape[0]
    residuals = z * turn.conj()[:, None] - shape
    count, size = z.shape
    freedom = 2 * count * size - 3 * count - (2 * size - 3)
    squares = float((np.abs(residuals) ** 2).sum())
    noise = float(np.sqrt(squares / freedom)) if freedom > 0 else 0.0
    return RigidFit(
        Displacement(pairs_of(origin), np.angle(turn)),
        pairs_of(residuals),
        pairs_of(shape - shape[0]),
        noise,
    )


def _direction(z: np.ndarray) -> np.ndarray:
    """Complex numbers divided by their sizes; 1 for 0."""
    size = np.abs(z)
    return np.where(size > 0, z / np.where(size > 0, size, 1), 1)


class Tracked(NamedTuple):
    """Poses from points, and how exactly they are known."""

    poses: Displacement
    resolution: tuple[float, float]  # from the digits: length, and angle in radians
    sigma: tuple[float, float] | None  # from the distance, if it varies more than that


class TrackedRows(NamedTuple):
    """What the rows and the points of a file are called."""

    numbers: NDArray[np.intp]  # (N,), of each row in its file, from 0
    locate: Callable[[int | None], str] | None = None  # where a row stands, by its number
    points: tuple[str, ...] = ("p", "q")
    frames: list[str] | None = None  # (N,), the numbers of the frames, in place of rows

    @property
    def are_markers(self) -> bool:
        """Whether other points can be chosen."""
        return self.points != ("p", "q")

    def name(self, row: int) -> tuple[str, str]:
        """What a row is called in words, and for --drop."""
        if self.frames is not None:
            return f"frame {self.frames[row]}", self.frames[row]
        number = str(self.numbers[row] + 1)
        return f"row {number}", number

    def refusal(self, message: str, why: str, row: int, odd: int = 1) -> InputError:
        """E111, with the row that is to be corrected or left out; odd: how many are like it."""
        words, drop = self.name(row)
        where = self.locate(int(self.numbers[row])) if self.locate else None
        help = f"correct {words}, or leave it out: delete it, or pass --drop {drop}"
        if self.are_markers and odd > MAX_ODD_ROWS:
            help = "name markers that are on one body with --points"
        return InputError("E111", message, where=where, why=why, help=help)


def tracked_poses(points: FloatArray, decimals: float, rows: TrackedRows) -> Tracked:
    """Poses whose origin is the first point, and whose x axis points to the second.

    points: (N, 2K), K >= 2 points as x and y, in one unit.
    decimals: the largest number of decimals that a coordinate is printed with.
    Two points are taken exactly as given.  Of three and more the rigid body that is nearest to
    them is placed; origin and axis are those of its points.
    The distance of two points of a rigid body is constant.  Where the points vary more than the
    digits explain, that measures the noise.
    Raises E111 where the first two points coincide, or where the distance of two varies by more
    than 10 percent, or one of more is as far from where the rigid body has it.
    """
    p, q = points[:, :2], points[:, 2:4]
    with np.errstate(over="ignore"):
        x, y = (q - p).T
        distance = np.hypot(x, y)
    if (bad := (distance == 0) | ~np.isfinite(distance)).any():
        row = int(bad.argmax())
        two = listed(rows.points[:2])
        why = f"{two} are the same point"
        if distance[row]:
            why = f"{two} are more than 1.8e308 apart, the largest representable number"
        raise rows.refusal(f"{rows.name(row)[0]} gives no angle", why, row)
    if not len(points):
        return Tracked(Displacement(p, np.arctan2(y, x)), (0.0, 0.0), None)
    half = resolution_by_digits(0.5 * 10.0**-decimals, extent(p))
    resolution = (half, min(2 * half / float(distance.min()), math.pi))
    # two coordinates a point, each within half a digit, and the rounding of doubles besides
    rounding = 4 * float(np.finfo(np.float64).eps * np.abs(points).max())
    if points.shape[1] > 4:
        fit = fit_rigid_body(points.reshape(len(points), -1, 2))
        _require_rigid(fit, rows)
        noisy = fit.noise > 2 * max(half / math.sqrt(3), rounding)
        return Tracked(fit.poses, resolution, fit.sigma if noisy else None)
    poses = Displacement(p, np.arctan2(y, x))
    least, most = distance.min(), distance.max()
    if most > (1 + MAX_DISTANCE_CHANGE) * least:
        raise _not_rigid(distance, rows)
    if len(points) < 2:
        return Tracked(poses, resolution, None)
    spread = float(np.std(distance / most, ddof=1)) * float(most)
    explained = max(math.sqrt(2 / 3) * half, rounding)
    sigma = (spread / math.sqrt(2), spread / float(most)) if spread > 2 * explained else None
    return Tracked(poses, resolution, sigma)


def _not_rigid(distance: FloatArray, rows: TrackedRows) -> InputError:
    """E111, at the row whose distance is furthest from the usual one."""
    short, long = int(distance.argmin()), int(distance.argmax())
    least, usual, most = (float(f(distance)) for f in (np.min, np.median, np.max))
    odd = short if usual / least > most / usual else long
    apart = [f"{distance[k]:.6g} apart in {rows.name(k)[0]}" for k in sorted((short, long))]
    why = f"they are {apart[0]} and {apart[1]}, a change of more than 10 percent"
    count = int((np.abs(distance - usual) > MAX_DISTANCE_CHANGE * usual).sum())
    return rows.refusal(f"{listed(rows.points)} do not stay on one rigid body", why, odd, count)


def _require_rigid(fit: RigidFit, rows: TrackedRows) -> None:
    """E111, at the row in which a point is farthest from where the rigid body has it."""
    size = float(np.hypot(*(fit.shape[:, None] - fit.shape[None]).T).max())
    off = np.hypot(*np.moveaxis(fit.residuals, -1, 0))
    if off.max() <= MAX_DISTANCE_CHANGE * size:
        return
    row, point = (int(k) for k in np.unravel_index(off.argmax(), off.shape))
    why = (
        f"{rows.points[point]} is {off[row, point]:.3g} from where the rigid body of all has it, "
        f"more than 10 percent of {size:.4g}, its size"
    )
    count = int((off > MAX_DISTANCE_CHANGE * size).any(axis=1).sum())
    raise rows.refusal(f"{listed(rows.points)} do not stay on one rigid body", why, row, count)
