"""The uncertainty of a linkage's pivots, as poses are known to a few digits only.

A small error of a linkage does not mean certain pivots: where the body hardly turns, or moves
nearly as a parallelogram's coupler does, the error hardly changes as the pivots move together.

Poses x = (d1, d2, length x angle) determine a linkage only across its coupler's curve.  With
J = L Qᵀ, the forces that the two dyads bear at a place (Q has two orthonormal columns, L is lower
triangular), and F the derivatives of the two equations by the dimensions z, the curve moves there
by -L⁻¹ F dz within the plane of Q.  So errors e of the poses move a linkage of least squares by
the least-squares solution of  -L⁻¹ F dz = Qᵀ e,  to first order and for small residuals.

Grashof's type is that of the signs of three sums of the four links.  Errors of the poses leave each
sum a deviation, so near zero its sign is open, and with it the type.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import compress
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import GRASHOF_SUMS, TYPE_OF_SIGNS, Linkage, Links, grashof
from burmester.fourbar.linkage_batch import DIMENSIONS, DYAD_KINDS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray, weights_or_ones
from burmester.tasks.motion_task import Task

POSSIBLE_DEVIATIONS = 2.0  # standard deviations; a type farther off is taken as excluded

LEAST_VARIANCE = 1e-12  # of all variances together; a smaller one is rounding

CIRCLE_95 = 2.4477468306808166  # standard deviations: 95 % radius in a plane, sqrt(-2 ln 0.05)
NORMAL_95 = 1.959963984540054  # standard deviations: 95 % half-width in one coordinate
POSE_ULPS = 4.0  # units in the last place of the poses' size: floor on their standard deviation
# Sine of the angle between both dyads' forces; with a smaller one they count as one constraint.
PARALLEL_FORCES = 1e-7
LOST_SINGULAR_VALUE = 8 * float(np.finfo(np.float64).eps)  # relative; a smaller one is rounding
# Lengths: floor on the standard deviation of what the poses do not determine.
UNKNOWN_DEVIATION = 1e3
# Half-widths up to which the 95 % hold about: shares of the motion's size and of the link; radians.
DETERMINED_SHARE = 0.05
MAX_DETERMINED_ANGLE = 0.05
RUNAWAY_SHARE = 0.3  # of the motion's size; with a larger half-width no region of a linkage holds
DEPENDENT = 1e-9  # relative singular value; smaller ones mean that fixed quantities are dependent

_RR, _PR, _RP = (DYAD_KINDS.index(kind) for kind in (RR, PR, RP))


@final
@dataclass(frozen=True, slots=True)
class PivotRegion:
    """The ellipse that contains a pivot with a probability of 95 %, centred at its estimate.

    major, minor: its semi-axes; direction: the angle of the major one in the pivot's own frame
    (F for a fixed pivot, M for a moving one), radians in (-pi/2, pi/2].
    reach: how far first order is trusted; beyond it the probability need not hold.

    Formula `pivot-ellipse` of the theory.
    """

    major: float
    minor: float
    direction: float
    reach: float = np.inf

    @property
    def determined(self) -> bool:
        """Whether it is small enough for the 95 % to hold."""
        return self.major <= self.reach

    @property
    def determined_across(self) -> bool:
        """Whether it is small enough in one direction at least, at a right angle to the other."""
        return self.minor <= self.reach

    @property
    def half_width(self) -> float:
        """The half-width of the ellipse in its worst direction."""
        return self.major

    def contains(self, offset: FloatArray) -> NDArray[np.bool_]:
        """Whether points (*, 2), relative to the centre, are within the ellipse."""
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
    reach: how far first order is trusted, of the offset.
    """

    angle: float
    offset: float
    reach: float = np.inf

    @property
    def angle_determined(self) -> bool:
        """Whether the half-width of the direction is small enough for the 95 % to hold."""
        return self.angle <= (MAX_DETERMINED_ANGLE if self.reach > 0 else 0.0)

    @property
    def offset_determined(self) -> bool:
        """The same of the offset."""
        return self.offset <= self.reach


@final
@dataclass(frozen=True, slots=True)
class DyadUncertainty:
    """The 95 % regions of a dyad's dimensions; None for dimensions that its kind does not have.

    fixed, moving: of the pivots; line: of a slider's line.
    length: the half-width of an RR dyad's link length.
    reach: how far first order is trusted, of the length.
    """

    fixed: PivotRegion | None
    moving: PivotRegion | None
    line: LineRegion | None
    length: float | None
    reach: float = np.inf

    @property
    def determined(self) -> bool:
        """Whether all of its dimensions are."""
        pivots = all(each.determined for each in (self.fixed, self.moving) if each is not None)
        line = self.line is None or (self.line.angle_determined and self.line.offset_determined)
        return pivots and line and (self.length is None or self.length_determined)

    def beyond_first_order(self) -> DyadUncertainty:
        """The same regions, none of which counts as determined."""
        fixed, moving = (
            None if each is None else replace(each, reach=0.0) for each in (self.fixed, self.moving)
        )
        line = None if self.line is None else replace(self.line, reach=0.0)
        return DyadUncertainty(fixed, moving, line, self.length, 0.0)

    @property
    def length_determined(self) -> bool:
        """Whether there is a link length whose half-width is small enough for the 95 % to hold."""
        return self.length is not None and self.length <= self.reach

    @property
    def half_width(self) -> float:
        """The greatest 95 % half-width of its pivots and its line."""
        parts = [each.half_width for each in (self.fixed, self.moving) if each is not None]
        return max([*parts, 0.0 if self.line is None else self.line.offset])


class _Across(NamedTuple):
    """Forces J (*, 2, 3) across the coupler's curve: J = [[first, 0], [mixed, second]] Q'.

    normals: Q' (*, 2, 3), orthonormal.  Where both forces are parallel the curve has one normal
    only, and second is infinite.
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
        lost = second < PARALLEL_FORCES * np.linalg.norm(b, axis=-1)
        other = np.where(lost, 0.0, 1 / np.where(lost, 1.0, second))[..., None] * rest
        return cls(np.stack([one, other], axis=-2), first, mixed, np.where(lost, np.inf, second))


def pose_sigma(task: Task) -> tuple[float, float]:
    """The standard deviations of a pose: a coordinate, in the task's unit, and the angle.

    Numbers rounded to their last digit err evenly within half of it.  The deviations are never
    less than a few units in the last place of a double.
    """
    rounding = POSE_ULPS * np.finfo(np.float64).eps
    size = np.abs(task.poses.translation).max() or 1.0
    least = rounding * size, rounding * max(1.0, float(np.abs(task.poses.angle).max()))
    position, angle = (
        max(given / 3**0.5, float(floor))
        for given, floor in zip(task.resolution, least, strict=True)
    )
    return position, angle


def covariance(
    batch: LinkageBatch,
    places: Displacement,
    length: float,
    sigma: tuple[float, float],
    *,
    weights: FloatArray | None = None,
    fixed: FloatArray | None = None,
    free_directions: FloatArray | None = None,
) -> FloatArray:
    """Covariances (k, 10, 10) of the dimensions of linkages fitted to poses with errors.

    batch: (k,) linkages, refined: least sum of w (|position error|² + (length x angle error)²).
    places: (k, N), nearest to the poses; nan places are left out.
    sigma: standard deviations of a coordinate and of an angle, independent of each other.
    weights: (N,), of the poses in the fit, not of the knowledge of them: a pose of large weight is
        met nearly exactly, and its errors are passed on whole.
    fixed: (k, m, 10), derivatives of quantities that do not change, such as active limits; zero
        rows are left out.  An exact pose has a large weight instead, as its own errors count.
    free_directions: (N, *, 3), of x, y and length x angle, orthonormal or zero; along these a pose
        asks for nothing.
    Order of the dimensions: dyad by dyad as in `LinkageBatch`; unused slots are zero.  All in one
    frame and unit, where lengths are about 1: `pose_error.error_frames` with
    `LinkageBatch.to_canonical`, and sigma in that unit; the origin of M stays, as pose errors are
    those of this point.
    What the poses do not determine has a standard deviation of at least UNKNOWN_DEVIATION.

    Formula `covariance` of the theory.
    """
    count = places.shape[1]
    _, force, by_dimension = batch.jacobians(places)
    plane = _Across.of(force, length)
    # Two rows for each pose: the derivatives by the dimensions, and a root of its covariance.
    a: FloatArray = np.zeros((len(batch), count, 2, 2, DIMENSIONS))
    a[..., 0, 0, :] = by_dimension[:, 0] / plane.first[..., None]
    a[..., 1, 0, :] = -(plane.mixed / plane.second)[..., None] * a[..., 0, 0, :]
    a[..., 1, 1, :] = by_dimension[:, 1] / plane.second[..., None]
    a = a.reshape(len(batch), count, 2, 2 * DIMENSIONS)
    noise = plane.normals * [sigma[0], sigma[0], length * sigma[1]]
    if free_directions is not None:
        asked = _asked(plane.normals, free_directions)
        a, noise = asked @ a, asked @ noise
    known = np.asarray(np.isfinite(a).all(axis=(-2, -1)))
    share = np.sqrt(weights_or_ones(weights, (count,))) * known
    share = share[..., None, None]
    a, noise = (share * np.where(known[..., None, None], each, 0.0) for each in (-a, noise))
    a = a.reshape(len(batch), 2 * count, -1)

    fixed_part = _fixed_projector(batch, fixed)
    free = np.eye(2 * DIMENSIONS) - fixed_part
    a = a @ free
    size = np.linalg.norm(a, axis=(-2, -1), keepdims=True)
    size = np.where(size > 0, size, 1.0)
    # Rows without errors for the fixed directions: singular values that remain 0 are unknown.
    u, s, vt = np.linalg.svd(np.concatenate([a, size * fixed_part], axis=1), full_matrices=False)
    lost = s < LOST_SINGULAR_VALUE * size[..., 0]
    u = u[:, : 2 * count].reshape(len(batch), count, 2, -1)
    moved = np.einsum("knac,knad->kcnd", u, noise).reshape(len(batch), 2 * DIMENSIONS, -1)
    moved = np.where(lost, 0.0, 1 / np.where(lost, 1.0, s))[..., None] * moved
    greatest = np.sqrt((noise**2).sum(axis=(-2, -1)).max(axis=-1, initial=0.0))[:, None]
    unknown = greatest / (LOST_SINGULAR_VALUE * size[..., 0])
    unknown = lost * np.maximum(unknown, UNKNOWN_DEVIATION * length)
    root = (
        free
        @ vt.swapaxes(1, 2)
        @ np.concatenate([moved, unknown[..., None] * np.eye(2 * DIMENSIONS)], -1)
    )
    return np.asarray(root @ root.swapaxes(1, 2))


def _asked(normals: FloatArray, free: FloatArray) -> FloatArray:
    """Projectors (k, N, 2, 2), across the coupler's curve, on what poses ask for there.

    normals: (k, N, 2, 3); free: (N, *, 3).  Where a pose is free along a direction, its part
    across the curve counts as the curve itself does: not at all.
    """
    part = normals @ free.swapaxes(-1, -2)
    values, axes = np.linalg.eigh(np.nan_to_num(part @ part.swapaxes(-1, -2)))
    asked = axes * (values < DEPENDENT)[..., None, :]
    return np.asarray(asked @ axes.swapaxes(-1, -2))


def _fixed_projector(batch: LinkageBatch, fixed: FloatArray | None) -> FloatArray:
    """Projectors (k, 10, 10) on the directions in which dimensions are fixed, or unused."""
    unused = np.zeros((len(batch), 2, 2, DIMENSIONS))
    for side in (0, 1):
        unused[:, side, side, -1] = batch.kinds[:, side] != _RR
    rows = unused.reshape(len(batch), 2, -1)
    if fixed is not None:
        rows = np.concatenate([rows, fixed], axis=1)
    size = np.linalg.norm(rows, axis=-1, keepdims=True)
    _, s, vt = np.linalg.svd(rows / np.where(size > 0, size, 1.0), full_matrices=False)
    basis = vt * (s > DEPENDENT)[..., None]
    return np.asarray(basis.swapaxes(1, 2) @ basis)


def uncertainties(
    covariance: FloatArray,
    batch: LinkageBatch,
    places: Displacement,
    unit: float = 1.0,
    size: float = np.inf,
) -> list[tuple[DyadUncertainty, DyadUncertainty]]:
    """The 95 % regions of both dyads of linkages (k,), from `covariance` of the same batch.

    places: (k, N), as there; they bound the stretch of a line that is in use.
    unit: the length of its frames, in the task's unit, which is that of the result.
    size: of the motion, in the task's unit.  A region counts as determined up to a twentieth of it
        and of the link, and none does where one of the linkage's reaches over RUNAWAY_SHARE of it:
        `benchmarks.coverage` counts how often the 95 % hold.
    """
    middle = line_middle(batch, places)
    regions = []
    for k in range(len(batch)):
        pair = []
        for side in (0, 1):
            slots = slice(DIMENSIONS * side, DIMENSIONS * (side + 1))
            part, kind = covariance[k, slots, slots], batch.kinds[k, side]
            radius = unit * float(batch.dimensions[k, side, -1]) if kind == _RR else np.inf
            reach = DETERMINED_SHARE * min(size, radius)
            pair.append(_of_dyad(part, kind, middle[k, side], unit, reach))
        if max(each.half_width for each in pair) > RUNAWAY_SHARE * size:
            pair = [each.beyond_first_order() for each in pair]
        regions.append((pair[0], pair[1]))
    return regions


def _of_dyad(
    spread: FloatArray, kind: int, middle: float, unit: float, reach: float
) -> DyadUncertainty:
    """The 95 % regions of one dyad, from its covariance (5, 5)."""
    fixed = None if kind == _PR else _ellipse(spread[:2, :2], unit, reach)
    moving = None if kind == _RP else _ellipse(spread[2:4, 2:4], unit, reach)
    if kind == _RR:
        length = NORMAL_95 * unit * float(spread[4, 4]) ** 0.5
        return DyadUncertainty(fixed, moving, None, length, reach)
    at = 0 if kind == _PR else 2
    part = spread[at : at + 2, at : at + 2]
    # n · X = h turns about the middle of the stretch, where it moves by dh - middle x dangle.
    to = np.array([-middle, 1.0])
    angle, offset = float(part[0, 0]) ** 0.5, float(max(to @ part @ to, 0.0)) ** 0.5
    line = LineRegion(min(NORMAL_95 * angle, float(np.pi)), NORMAL_95 * unit * offset, reach)
    return DyadUncertainty(fixed, moving, line, None, reach)


def _ellipse(spread: FloatArray, unit: float, reach: float) -> PivotRegion:
    values, vectors = np.linalg.eigh(spread)
    minor, major = unit * CIRCLE_95 * np.sqrt(np.maximum(values, 0.0))
    x, y = vectors[:, 1]
    direction = float(np.arctan2(y, x)) if x > 0 else float(np.arctan2(-y, -x))
    return PivotRegion(float(major), float(minor), direction, reach)


def line_middle(batch: LinkageBatch, places: Displacement) -> FloatArray:
    """The middle of each slider's travel along its line, (k, 2); 0 for an RR.

    Measured from the foot of the normal through the origin, in the direction a quarter turn ahead
    of the normal.
    """
    middle = np.zeros(batch.kinds.shape)
    for index, pair in batch.alike():
        here = places[index]
        for side, dyad in enumerate((pair.first, pair.second)):
            if isinstance(dyad, PR | RP):
                along = dyad.along(here)
                low, high = np.fmin.reduce(along, axis=-1), np.fmax.reduce(along, axis=-1)
                middle[index, side] = np.nan_to_num((low + high) / 2)
    return middle


def possible_types(links: Links, covariance: FloatArray) -> tuple[str, ...]:
    """The types of one 4R linkage within the uncertainty of its links, its own type first.

    links: the four lengths; covariance: (4, 4) of them, in their order and unit.

    A pattern of signs is possible where the sums that would have to change theirs can be zero all
    at once within POSSIBLE_DEVIATIONS, to first order.  A change point is the border of types and
    listed only where the links themselves are at one; then it has no other types.
    """
    own = grashof(links)
    if own == "change-point":
        return (own,)
    lengths = np.array([float(length) for length in links])
    sums = GRASHOF_SUMS @ lengths
    spread = GRASHOF_SUMS @ covariance @ GRASHOF_SUMS.T
    # Rounding bounds the deviations from below, and keeps dependent sums apart.
    floor = (ROUNDING * lengths.sum()) ** 2 + LEAST_VARIANCE * np.trace(spread)
    spread = spread + floor * np.eye(len(sums))
    signs = np.sign(sums)
    others = []
    for pattern, name in TYPE_OF_SIGNS.items():
        changed = np.flatnonzero(signs != pattern)
        away = sums[changed] @ np.linalg.solve(spread[np.ix_(changed, changed)], sums[changed])
        others.append(name != own and bool(away <= POSSIBLE_DEVIATIONS**2))
    return (own, *dict.fromkeys(compress(TYPE_OF_SIGNS.values(), others)))


def links_covariance(batch: LinkageBatch, covariance: FloatArray) -> FloatArray:
    """Covariances (k, 4, 4) of the link lengths, in the order of `Links`, to first order.

    covariance: (k, 10, 10), of the dimensions (`uncertainty.covariance`).  nan where a dyad is a
    slider.
    """
    out = np.full((len(batch), 4, 4), np.nan)
    for index, pair in batch.alike():
        a, b = pair.first, pair.second
        if not (isinstance(a, RR) and isinstance(b, RR)):
            continue
        links = Linkage(a, b).links
        assert links is not None
        slope = np.zeros((len(index), 4, 2, DIMENSIONS))
        for link, at, gap, size in (
            (0, 0, b.fixed_pivot - a.fixed_pivot, links.ground),
            (2, 2, b.moving_pivot - a.moving_pivot, links.coupler),
        ):
            toward = np.divide(gap, size[:, None], out=np.zeros_like(gap), where=size[:, None] > 0)
            slope[:, link, 1, at : at + 2] = toward
            slope[:, link, 0, at : at + 2] = -toward
        slope[:, 1, 0, 4] = slope[:, 3, 1, 4] = 1.0  # driver and follower
        flat = slope.reshape(len(index), 4, -1)
        out[index] = flat @ covariance[index] @ flat.swapaxes(1, 2)
    return out
