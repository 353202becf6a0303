"""How uncertain the pivots of a linkage are, because the poses are known to a few digits only.

A small error of a linkage does not mean certain pivots: where the body hardly turns, or nearly
as a parallelogram's coupler does, the error hardly changes as the pivots move together.

Poses x = (d1, d2, length x angle) pull at the linkage only across its coupler's curve.  With
J = L Qᵀ, the forces that the two dyads bear at a place (Q has two orthonormal columns, L is lower
triangular), and F the derivatives of the two equations by the dimensions z, the curve moves there
by -L⁻¹ F dz within the plane of Q.  So errors e of the poses move a linkage of least squares by
the least-squares solution of  -L⁻¹ F dz = Qᵀ e,  to first order and for small residuals.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import DIMENSIONS, STACKED, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import weights_or_ones
from burmester.tasks.motion_task import Task

__all__ = [
    "DyadUncertainty",
    "LineRegion",
    "PivotRegion",
    "covariance",
    "line_middle",
    "links_deviation",
    "pose_sigma",
    "uncertainties",
]

CIRCLE_95 = 2.4477468306808166  # standard deviations: sqrt(-2 ln 0.05), for two coordinates
NORMAL_95 = 1.959963984540054  # for one
ULPS = 4.0  # of the poses' own size, that they are known to at best
SINGULAR = 1e-7  # sine of the angle between two forces that say the same, up to rounding
LOST = 8 * float(np.finfo(np.float64).eps)  # a smaller singular value is rounding
UNKNOWN = 1e3  # standard deviation, in lengths, of what the poses say nothing about, at least
HELD = 1e-9  # sine of the angle between two held quantities that are one

_RR, _PR, _RP = (STACKED.index(kind) for kind in (RR, PR, RP))


@final
@dataclass(frozen=True, slots=True)
class PivotRegion:
    """The ellipse that holds a pivot with a probability of 95 %, around where it was found.

    major, minor: its semi-axes; direction: the angle of the major one in the pivot's own frame
    (F for a fixed pivot, M for a moving one), radians in (-pi/2, pi/2].
    """

    major: float
    minor: float
    direction: float

    @property
    def half_width(self) -> float:
        """How far the ellipse reaches in its worst direction."""
        return self.major

    def holds(self, offset: FloatArray) -> NDArray[np.bool_]:
        """Whether points (*, 2), relative to the centre, are within."""
        z = (offset[..., 0] + 1j * offset[..., 1]) * np.exp(-1j * self.direction)
        return (
            np.asarray((z.real * self.minor) ** 2 + (z.imag * self.major) ** 2)
            <= (self.major * self.minor) ** 2
        )


@final
@dataclass(frozen=True, slots=True)
class LineRegion:
    """95 % half-widths of a slider's line.

    angle: of its direction, radians, at most half a turn.  offset: across it, in the middle of the
    stretch that the poses use; so neither depends on where the origins of F and M are.
    """

    angle: float
    offset: float


@final
@dataclass(frozen=True, slots=True)
class DyadUncertainty:
    """What of a dyad is how uncertain; None for what the dyad does not have.

    length: the 95 % half-width of an RR dyad's link.
    """

    fixed: PivotRegion | None
    moving: PivotRegion | None
    line: LineRegion | None
    length: float | None

    @property
    def half_width(self) -> float:
        """Of its pivots and its line, the one that is known least: 95 % half-width."""
        parts = [each.half_width for each in (self.fixed, self.moving) if each is not None]
        return max([*parts, 0.0 if self.line is None else self.line.offset])


class _Across(NamedTuple):
    """How forces J (*, 2, 3) lie across the coupler's curve: J = [[first, 0], [mixed, second]] Q'.

    normals: Q' (*, 2, 3), orthonormal.  second is infinite where both forces are one: the curve has
    no normal plane there, and only one normal.
    """

    normals: FloatArray
    first: FloatArray
    mixed: FloatArray
    second: FloatArray

    @classmethod
    def of(cls, force: FloatArray, length: float) -> _Across:
        """From the forces (k, 2, *, 3) of both dyads, their moments divided by length."""
        a, b = np.moveaxis(force / np.array([1.0, 1.0, length]), 1, 0)
        first = np.linalg.norm(a, axis=-1)
        one = a / first[..., None]
        mixed = (b * one).sum(axis=-1)
        rest = b - mixed[..., None] * one
        rest -= (rest * one).sum(axis=-1)[..., None] * one  # once more: little may be left
        second = np.linalg.norm(rest, axis=-1)
        lost = second < SINGULAR * np.linalg.norm(b, axis=-1)
        other = np.where(lost, 0.0, 1 / np.where(lost, 1.0, second))[..., None] * rest
        return cls(np.stack([one, other], axis=-2), first, mixed, np.where(lost, np.inf, second))


def pose_sigma(task: Task) -> tuple[float, float]:
    """The standard deviations of a pose: a coordinate, in the task's unit, and the angle.

    Numbers rounded to their last digit err evenly within half of it.  Never less than a few units
    in the last place of what a double holds.
    """
    rounding = ULPS * np.finfo(np.float64).eps
    size = np.abs(task.poses.translation).max() or 1.0
    least = rounding * size, rounding * max(1.0, float(np.abs(task.poses.angle).max()))
    position, angle = (
        max(given / 3**0.5, float(floor))
        for given, floor in zip(task.resolution, least, strict=True)
    )
    return position, angle


def covariance(  # noqa: PLR0917
    stack: LinkageBatch,
    places: Displacement,
    length: float,
    sigma: tuple[float, float],
    weights: FloatArray | None = None,
    held: FloatArray | None = None,
) -> FloatArray:
    """Covariances (k, 10, 10) of the dimensions of linkages fitted to poses that err.

    stack: (k,) linkages, refined: least sum of w (|position error|² + (length x angle error)²).
    places: (k, N), nearest to the poses; one that is nan says nothing.
    sigma: standard deviations of a coordinate and of an angle, independent of each other.
    weights: (N,), how the fit weighs the poses, not how well they are known: a pose of large
        weight is met nearly exactly, and its errors are passed on whole.
    held: (k, m, 10), derivatives of quantities that do not change, such as limits that hold; zero
        rows mean nothing.  An exact pose whose own errors count is one of large weight instead.
    Order of the dimensions: dyad by dyad as in `LinkageBatch`; slots not in use are zero.  All in
    one frame and unit, where lengths are about 1: `accuracy.error_frames` with `LinkageBatch.seen`,
    and sigma in that unit; M must be as it is given, for pose errors are those of its origin.
    What the poses do not determine has a standard deviation of 1e3 lengths at least.
    """
    count = places.shape[1]
    _, force, by_dimension = stack.bearing(places)
    plane = _Across.of(force, length)
    # Rows of the poses: u by the dimensions, two a pose, and a root of the errors' covariance.
    a: FloatArray = np.zeros((len(stack), count, 2, 2, DIMENSIONS))
    a[..., 0, 0, :] = by_dimension[:, 0] / plane.first[..., None]
    a[..., 1, 0, :] = -(plane.mixed / plane.second)[..., None] * a[..., 0, 0, :]
    a[..., 1, 1, :] = by_dimension[:, 1] / plane.second[..., None]
    a = a.reshape(len(stack), count, 2, 2 * DIMENSIONS)
    noise = plane.normals * [sigma[0], sigma[0], length * sigma[1]]
    known = np.asarray(np.isfinite(a).all(axis=(-2, -1)))
    share = np.sqrt(weights_or_ones(weights, (count,))) * known
    share = share[..., None, None]
    a, noise = (share * np.where(known[..., None, None], each, 0.0) for each in (-a, noise))
    a = a.reshape(len(stack), 2 * count, -1)

    fast = _held(stack, held)
    free = np.eye(2 * DIMENSIONS) - fast
    a = a @ free
    size = np.linalg.norm(a, axis=(-2, -1), keepdims=True)
    size = np.where(size > 0, size, 1.0)
    # What is held becomes known, from rows without errors: so zeros left are not known at all.
    u, s, vt = np.linalg.svd(np.concatenate([a, size * fast], axis=1), full_matrices=False)
    lost = s < LOST * size[..., 0]
    u = u[:, : 2 * count].reshape(len(stack), count, 2, -1)
    moved = np.einsum("knac,knad->kcnd", u, noise).reshape(len(stack), 2 * DIMENSIONS, -1)
    moved = np.where(lost, 0.0, 1 / np.where(lost, 1.0, s))[..., None] * moved
    greatest = np.sqrt((noise**2).sum(axis=(-2, -1)).max(axis=-1, initial=0.0))[:, None]
    unknown = lost * np.maximum(greatest / (LOST * size[..., 0]), UNKNOWN * length)
    root = (
        free
        @ vt.swapaxes(1, 2)
        @ np.concatenate([moved, unknown[..., None] * np.eye(2 * DIMENSIONS)], -1)
    )
    return np.asarray(root @ root.swapaxes(1, 2))


def _held(stack: LinkageBatch, held: FloatArray | None) -> FloatArray:
    """Projectors (k, 10, 10) on the directions of what is held, unused slots among them."""
    unused = np.zeros((len(stack), 2, 2, DIMENSIONS))
    for side in (0, 1):
        unused[:, side, side, -1] = stack.kinds[:, side] != _RR
    rows = unused.reshape(len(stack), 2, -1)
    if held is not None:
        rows = np.concatenate([rows, held], axis=1)
    size = np.linalg.norm(rows, axis=-1, keepdims=True)
    _, s, vt = np.linalg.svd(rows / np.where(size > 0, size, 1.0), full_matrices=False)
    basis = vt * (s > HELD)[..., None]
    return np.asarray(basis.swapaxes(1, 2) @ basis)


def uncertainties(
    covariance: FloatArray, stack: LinkageBatch, places: Displacement, unit: float = 1.0
) -> list[tuple[DyadUncertainty, DyadUncertainty]]:
    """The 95 % regions of both dyads of linkages (k,), from `covariance` of the same stack.

    places: (k, N), as there; they tell which stretch of a line is used.
    unit: the length that is 1 there (the length of its frames): the result is in the task's unit.
    """
    middle = line_middle(stack, places)
    found = []
    for k in range(len(stack)):
        pair = []
        for side in (0, 1):
            slots = slice(DIMENSIONS * side, DIMENSIONS * (side + 1))
            pair.append(
                _of_dyad(covariance[k, slots, slots], stack.kinds[k, side], middle[k, side], unit)
            )
        found.append((pair[0], pair[1]))
    return found


def _of_dyad(spread: FloatArray, kind: int, middle: float, unit: float) -> DyadUncertainty:
    """From the covariance (5, 5) of one dyad."""
    fixed = None if kind == _PR else _ellipse(spread[:2, :2], unit)
    moving = None if kind == _RP else _ellipse(spread[2:4, 2:4], unit)
    if kind == _RR:
        return DyadUncertainty(fixed, moving, None, NORMAL_95 * unit * float(spread[4, 4]) ** 0.5)
    at = 0 if kind == _PR else 2
    part = spread[at : at + 2, at : at + 2]
    # n · X = h turns about the middle of the stretch, where it moves by dh - middle x dangle.
    to = np.array([-middle, 1.0])
    angle, offset = float(part[0, 0]) ** 0.5, float(max(to @ part @ to, 0.0)) ** 0.5
    line = LineRegion(min(NORMAL_95 * angle, float(np.pi)), NORMAL_95 * unit * offset)
    return DyadUncertainty(fixed, moving, line, None)


def _ellipse(spread: FloatArray, unit: float) -> PivotRegion:
    values, vectors = np.linalg.eigh(spread)
    minor, major = unit * CIRCLE_95 * np.sqrt(np.maximum(values, 0.0))
    x, y = vectors[:, 1]
    direction = float(np.arctan2(y, x)) if x > 0 else float(np.arctan2(-y, -x))
    return PivotRegion(float(major), float(minor), direction)


def line_middle(stack: LinkageBatch, places: Displacement) -> FloatArray:
    """For each dyad (k, 2) that is a slider, where along its line the middle of its travel is.

    From the foot of the normal through the origin, towards a quarter turn ahead of it; 0 for an RR.
    """
    middle = np.zeros(stack.kinds.shape)
    for index, pair in stack.alike():
        here = places[index]
        for side, dyad in enumerate((pair.first, pair.second)):
            if isinstance(dyad, RR):
                continue
            one = dyad[:, None]
            if isinstance(one, PR):
                point = here.act(one.moving_pivot)
            else:
                assert isinstance(one, RP)
                point = here.inverse().act(one.fixed_pivot)
            angle = one.normal_angle
            along = np.cos(angle) * point[..., 1] - np.sin(angle) * point[..., 0]
            low, high = np.fmin.reduce(along, axis=-1), np.fmax.reduce(along, axis=-1)
            middle[index, side] = np.nan_to_num((low + high) / 2)
    return middle


def links_deviation(stack: LinkageBatch, covariance: FloatArray) -> FloatArray:
    """Standard deviations (k,) of Grashof's excess s + l - p - q; nan where a dyad is a slider.

    An excess not beyond twice that is a change point as far as the poses can tell.
    """
    deviation = np.full(len(stack), np.nan)
    for index, pair in stack.alike():
        a, b = pair.first, pair.second
        if not (isinstance(a, RR) and isinstance(b, RR)):
            continue
        links = Linkage(a, b).links
        assert links is not None
        lengths = np.stack(links, axis=-1)
        sign = np.full(lengths.shape, -1.0)
        row = np.arange(len(index))
        sign[row, lengths.argmin(axis=-1)] = sign[row, lengths.argmax(axis=-1)] = 1.0
        slope = np.zeros((len(index), 2, DIMENSIONS))
        for link, at, gap in (
            (0, 0, b.fixed_pivot - a.fixed_pivot),
            (2, 2, b.moving_pivot - a.moving_pivot),
        ):
            size = lengths[:, link, None]
            toward = np.divide(gap, size, out=np.zeros_like(gap), where=size > 0)
            slope[:, 1, at : at + 2] = sign[:, link, None] * toward
            slope[:, 0, at : at + 2] = -slope[:, 1, at : at + 2]
        slope[:, :, 4] = sign[:, [1, 3]]
        flat = slope.reshape(len(index), -1)
        variance = np.einsum("ki,kij,kj->k", flat, covariance[index], flat)
        deviation[index] = np.sqrt(np.maximum(variance, 0.0))
    return deviation
