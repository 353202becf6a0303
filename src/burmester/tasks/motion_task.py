"""A task: the poses a body must pass through, and how exactly they are known."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burmester.errors import InputError, printable
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Limits
from burmester.tasks.requirements import Requirements, require_possible

__all__ = ["COARSE", "CONDITIONS", "Task", "characteristic_length"]

COARSE = 1e-3  # coarser digits than this count as meant exactly, not as measured

CONDITIONS = 5  # that a dyad can meet exactly: it has five dimensions
MOST = 1e60  # beyond it, or all below its inverse, fourth powers leave a double's range
MOST_TURN = 1e9  # radians; of an angle beyond it few digits say where the body points
MOST_RATIO = 1e12  # of two weights; beyond it the lighter pose is lost in rounding
LEAST_POSES = 3  # two poses are met by every moving pivot with a whole line of fixed pivots


@final
@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """What a synthesis is asked for; whatever gets past here can be computed with.

    poses: (N,) displacements, N >= 3.
    weights: (N,) positive, or None for equal ones; a pose of weight 2 counts as if it were
        given twice.
    names: one name a pose, or None.
    length_unit: the unit of x and y as its user writes it ("mm"), or None.
    resolution: how exactly a pose is known, (length in the task's unit, angle in radians); the
        errors of poses are taken to be spread evenly up to it.  Half of the last digit that a
        file gives; sqrt(3) times the standard deviation where that is given instead
        (--pose-sigma), which is as wide a spread; 0 for exact numbers.
    exact: (N,), which poses must be met exactly, or None for none of them.
    limits: none; one for both dyads of a linkage; or two, one for each.
    requirements: what is asked of the whole linkage, nothing by default.
    Fewer than 3 poses are enough where a limit puts a pivot at a point or on a line.
    Raises InputError: E103 (a number that is not finite), E112 (one too large or too small to
    compute with, or weights too far apart), E120 (too few poses), E122
    (weights, names or marks that do not fit the poses), E132 (requirements that the limits
    contradict), E133 (more exact conditions than a dyad can meet), E134 (a driver named by limits
    that are not two).
    """

    poses: Displacement
    weights: FloatArray | None = None
    names: tuple[str, ...] | None = None
    length_unit: str | None = None
    resolution: tuple[float, float] = (0.0, 0.0)
    exact: NDArray[np.bool_] | None = None
    limits: tuple[Limits, ...] = ()
    requirements: Requirements = field(default=Requirements())

    def __post_init__(self) -> None:
        if len(self.poses.shape) != 1:
            raise ValueError(f"a task takes poses of shape (N,), not {self.poses.shape}")
        count = self.poses.shape[0]
        if len(self.limits) > 2:
            raise ValueError(
                f"a linkage has two dyads, and so at most two limits, not {len(self.limits)}"
            )
        conditions = max((limits.conditions for limits in self.limits), default=0)
        if count < (1 if conditions else LEAST_POSES):
            raise InputError(
                "E120",
                f"{count} pose{'' if count == 1 else 's'}: too few for a linkage",
                why="two poses or fewer leave the choice of every pivot open",
                help="give at least 3 poses; 5 are met exactly, 6 or more as closely as possible",
            )
        self.poses.require_finite()
        _require_computable(self.poses)
        if self.weights is not None:
            weights = np.asarray(self.weights, dtype=np.float64)
            if weights.shape != (count,) or not (np.isfinite(weights) & (weights > 0)).all():
                raise InputError(
                    "E122",
                    "the weights do not fit the poses",
                    why=f"{count} poses need {count} finite weights above zero",
                    help="give every pose a weight above zero; to drop a pose, delete it",
                )
            least, most = float(weights.min()), float(weights.max())
            if most > MOST_RATIO * least:
                raise InputError(
                    "E112",
                    "the weights are too far apart to compute with",
                    why=f"the greatest is {most:.3g}, the least {least:.3g}",
                    help="mark the heavy poses exact, or leave out the light ones",
                )
            object.__setattr__(self, "weights", weights)
        if self.exact is not None:
            exact = np.asarray(self.exact, dtype=np.bool_)
            if exact.shape != (count,):
                raise InputError(
                    "E122",
                    "the marks for exact poses do not fit the poses",
                    why=f"{count} poses need {count} marks, true or false",
                    help="mark every pose, or none",
                )
            object.__setattr__(self, "exact", exact)
            if (marked := int(exact.sum())) + conditions > CONDITIONS:
                raise InputError(
                    "E133",
                    f"{marked + conditions} exact conditions, and a dyad can meet {CONDITIONS}",
                    why=f"{marked} poses are marked exact"
                    + (
                        f", and pivots at points or on lines are {conditions} more conditions"
                        if conditions
                        else ""
                    ),
                    help=f"mark {CONDITIONS - conditions} poses or fewer",
                )
        if self.names is not None and len(self.names) != count:
            raise InputError(
                "E122",
                f"{len(self.names)} names for {count} poses",
                help="give one name a pose, or none",
            )
        if self.names is not None:
            object.__setattr__(self, "names", tuple(map(printable, self.names)))
        if self.length_unit is not None:
            object.__setattr__(self, "length_unit", printable(self.length_unit))
        require_possible(self.requirements, self.limits)

    @classmethod
    def from_degrees(cls, poses: ArrayLike, length_unit: str | None = None) -> Task:
        """A task from rows (x, y, angle in degrees), shape (N, 3)."""
        rows = np.array(poses, dtype=np.float64)
        if rows.ndim != 2 or rows.shape[1] != 3:
            raise ValueError(f"poses need shape (N, 3): x, y, angle in degrees; not {rows.shape}")
        return cls(Displacement(rows[:, :2], np.radians(rows[:, 2])), length_unit=length_unit)


def characteristic_length(task: Task) -> float:
    """The size of a task in its unit, the same in all frames (`CanonicalFrames`)."""
    return float(CanonicalFrames.of(task.poses, task.weights)[0].length)


def _require_computable(poses: Displacement) -> None:
    """Refuse numbers that cannot be computed with; raises E112."""
    reach, turn = np.abs(poses.translation).max(axis=1), np.abs(poses.angle)
    if (far := reach > MOST).any() or 0 < reach.max() < 1 / MOST:
        bad = int(far.argmax() if far.any() else reach.argmax())
        message = f"the lengths of pose {bad + 1} are too {'large' if far.any() else 'small'}"
        why = f"the fourth power of {reach[bad]:g} is beyond what a number can hold"
        help = "write the lengths in another unit"
    elif (far := turn > MOST_TURN).any():
        bad = int(far.argmax())
        message = f"the angle of pose {bad + 1} is too large"
        why = f"it is {turn[bad]:.3g} rad, {turn[bad] / (2 * np.pi):.3g} turns"
        help = "take whole turns off it"
    else:
        return
    raise InputError("E112", message, why=why, help=help)
