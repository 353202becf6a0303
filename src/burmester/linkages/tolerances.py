"""How far from the poses a linkage comes that is made with tolerances.

Every dimension of the built linkage is off by up to a tolerance t, evenly spread and independent
of the others: each coordinate of a pivot and each link length by +-t; a slider's line by +-t across
it, in the middle of the stretch that the poses use, and by +-t / length in its angle.
The driver is adjusted: the built linkage meets a pose at the place of its coupler nearest to it.

Near, here and everywhere, means the least |position error|² + (length x angle error)².  All
arguments are in one frame and unit, where lengths are about 1 (`accuracy.error_frames`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import constraint_normals, newton_step, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, STACKED, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.uncertainty import line_middle
from burmester.numerics.arrays import FloatArray

__all__ = ["Built", "Spread", "monte_carlo", "sensitivity", "spread"]

DRAWS = 1000
SHARE = 95.0  # per cent of the built linkages
NUDGE = 1e-5  # lengths along the coupler's curve, for how the forces turn on the way
DIRECTIONS = 90  # in which the greatest error is looked for, on half a circle
STEPS = 30  # on the way to the nearest place of a built linkage
SETTLED = 1e-9  # lengths; a last step below this has arrived, for steps shrink by squares
BLOCK = 256  # poses looked at together


@final
@dataclass(frozen=True, slots=True, eq=False)
class Spread:
    """Position errors of built linkages at poses (N,), to first order in the tolerance.

    deviation: (k, N), rms distance between a built linkage's place and the nominal one.
    worst: (k, N), no linkage within the tolerance has a greater position error at that pose.
    rms: (k,), the root of the mean squared position error over built linkages and poses.
    greatest_95: (k,), 95 % of the built linkages come nearer than this to every pose; from
        1,000 draws, and so known to a few per cent.
    bound: (k,), the greatest `worst`.
    """

    deviation: FloatArray
    worst: FloatArray
    rms: FloatArray
    greatest_95: FloatArray
    bound: FloatArray

    def one(self, index: int, unit: float) -> Spread:
        """That of one linkage, in another unit: the one in which the length 1 is `unit`."""
        parts = (self.deviation, self.worst, self.rms, self.greatest_95, self.bound)
        return Spread(*(unit * part[index] for part in parts))


@final
@dataclass(frozen=True, slots=True, eq=False)
class Built:
    """Linkages built at random within a tolerance, and where they come.

    dimensions: (k, draws, 2, 5), as built, in the order of the stack.
    places: (k, draws, N), nearest to the poses; nan where the built linkage was not brought there.
    position: (k, draws, N), their position errors, infinite there.
    """

    dimensions: FloatArray
    places: Displacement
    position: FloatArray

    @property
    def lost(self) -> FloatArray:
        """The share (k,) of linkages that miss a pose altogether."""
        return np.asarray(np.isinf(self.position).any(axis=-1).mean(axis=-1))

    @property
    def greatest_95(self) -> FloatArray:
        """95 % of the linkages (k,) come nearer than this to every pose."""
        return _share(self.position.max(axis=-1))


def spread(  # noqa: PLR0917
    stack: LinkageBatch,
    poses: Displacement,
    places: Displacement,
    length: float,
    tolerance: float,
    seed: int = 0,
) -> Spread:
    """The position errors of linkages (k,) built within a tolerance, to first order.

    poses: (N,); places: (k, N), the nominal linkages' nearest to them.
    """
    slope = tolerance * sensitivity(stack, poses, places, length)
    gap = places.translation - poses.translation
    deviation = np.sqrt((slope**2).sum(axis=(-2, -1)) / 3)
    # The farthest point of a convex figure is that in the direction in which it reaches farthest.
    worst = np.zeros(gap.shape[:-1])
    for angle in np.arange(DIRECTIONS) * (np.pi / DIRECTIONS):
        to = np.array([np.cos(angle), np.sin(angle)])
        along = np.abs(np.einsum("c,kncj->knj", to, slope)).sum(axis=-1)
        worst = np.maximum(worst, np.abs(gap @ to) + along)
    worst /= np.cos(np.pi / (2 * DIRECTIONS))  # a bound between the directions tried as well
    square = (gap**2).sum(axis=-1) + deviation**2
    off = np.random.default_rng(seed).uniform(-1, 1, size=(DRAWS, slope.shape[-1]))
    greatest = np.zeros((len(stack), DRAWS))
    for at in _blocks(poses):
        moved = gap[:, None, at] + np.einsum("sj,kncj->ksnc", off, slope[:, at])
        greatest = np.maximum(greatest, np.hypot(moved[..., 0], moved[..., 1]).max(axis=-1))
    rms = np.sqrt(square.mean(axis=-1))
    return Spread(deviation, worst, rms, _share(greatest), worst.max(axis=-1))


def sensitivity(
    stack: LinkageBatch, poses: Displacement, places: Displacement, length: float
) -> FloatArray:
    """How the places nearest to poses (N,) move with what is built amiss: (k, N, 2, 10).

    Their positions by the errors of the dimensions in the order of the stack, each error as a
    length (see the module); zero for slots not in use.
    """
    miss, force, by_dimension = stack.bearing(places)
    at = constraint_normals(miss, force, length)
    tangent, here = at.tangent, rows_of(places, length)
    gap = here - rows_of(poses, length)
    # At the nearest place gap + pull J = 0, and along + pull J' = 0 where the forces J turn.
    pull = -at.solve(np.einsum("knac,knc->kna", at.force, gap))
    ahead, behind = (
        stack.bearing(_places(here + sign * NUDGE * length * tangent, length)) for sign in (1, -1)
    )
    step = 2 * NUDGE * length
    turning = np.einsum("kna,kanc->knc", pull, (ahead.force - behind.force) / step)
    turning[..., 2] /= length
    partial = (ahead.by_dimension - behind.by_dimension) / step
    curving = 1 + (turning * tangent).sum(axis=-1)  # how the distance bends: positive if least
    # One dimension after the other: back to the moved surface, then along to the nearest place.
    moved = np.zeros((*places.shape, 3, 2, DIMENSIONS))
    for side in (0, 1):
        for j in range(DIMENSIONS):
            values = np.zeros((*places.shape, 2))
            values[..., side] = by_dimension[:, side, :, j]
            back = -np.einsum("kna,knac->knc", at.solve(values), at.force)
            along = (turning * back).sum(axis=-1) + pull[..., side] * partial[:, side, :, j]
            moved[..., side, j] = back - (along / curving)[..., None] * tangent
    made = _made(stack, line_middle(stack, places), length)
    return np.asarray(np.einsum("kncsj,ksji->kncsi", moved[..., :2, :, :], made)).reshape(
        *places.shape, 2, 2 * DIMENSIONS
    )


def monte_carlo(  # noqa: PLR0917
    stack: LinkageBatch,
    poses: Displacement,
    places: Displacement,
    length: float,
    tolerance: float,
    draws: int = DRAWS,
    seed: int = 0,
) -> Built:
    """Linkages built at random, each led from the nominal places to its nearest ones.

    As in `spread`, but nothing is taken to be linear.  So every linkage stays on the circuit on
    which it is meant to be, as long as the circuits keep apart.
    """
    rng = np.random.default_rng(seed)
    made = _made(stack, line_middle(stack, places), length)
    off = tolerance * rng.uniform(-1, 1, size=(len(stack), draws, 2, DIMENSIONS))
    dimensions = stack.dimensions[:, None] + np.einsum("ksji,knsi->knsj", made, off)
    rows = np.empty((len(stack), draws, poses.shape[0], 3))
    for k in range(len(stack)):
        built = LinkageBatch(np.broadcast_to(stack.kinds[k], (draws, 2)), dimensions[k])
        for at in _blocks(poses):
            rows[k, :, at] = _nearest(built, poses[at], places[k, at], length)
    reached = _places(rows, length)
    gap = reached.translation - poses.translation
    position = np.nan_to_num(np.hypot(gap[..., 0], gap[..., 1]), nan=np.inf)
    return Built(dimensions, reached, position)


def _nearest(
    built: LinkageBatch, poses: Displacement, start: Displacement, length: float
) -> FloatArray:
    """The places (n, N, 3) of linkages (n,) nearest to poses (N,), by Newton's steps from (N,)."""
    shape = (len(built), poses.shape[0], 3)
    surfaces = built.surfaces()
    rows = np.broadcast_to(rows_of(start, length), shape)
    wanted = np.broadcast_to(rows_of(poses, length), shape)
    size = np.full(shape[:2], np.inf)
    for _ in range(STEPS):
        step, size = newton_step(surfaces, rows, wanted, length)
        rows = rows + step
        if not (size > SETTLED).any():
            break
    return np.where((size <= SETTLED)[..., None], rows, np.nan)


def _made(stack: LinkageBatch, middle: FloatArray, length: float) -> FloatArray:
    """How what is built amiss, as lengths, changes the dimensions of each dyad: (k, 2, 5, 5)."""
    made = np.zeros((*stack.kinds.shape, DIMENSIONS, DIMENSIONS))
    made[:] = np.eye(DIMENSIONS)
    made[stack.kinds != STACKED.index(RR), -1, -1] = 0.0
    for kind, at in ((PR, 0), (RP, 2)):
        rows = stack.kinds == STACKED.index(kind)
        made[rows, at, at] = 1 / length
        made[rows, at + 1, at] = middle[rows] / length  # turned about the middle
    return made


def _places(rows: FloatArray, length: float) -> Displacement:
    return Displacement(rows[..., :2], rows[..., 2] / length)


def _share(greatest: FloatArray) -> FloatArray:
    """The value (k,) that 95 % of (k, draws) are below; a draw counts as it is, nothing between."""
    return np.asarray(np.percentile(greatest, SHARE, axis=-1, method="higher"))


def _blocks(poses: Displacement) -> Iterator[slice]:
    return (slice(at, at + BLOCK) for at in range(0, poses.shape[0], BLOCK))
