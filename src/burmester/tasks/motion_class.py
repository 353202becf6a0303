"""The class of a task: what its motion is, known before any dyad is looked for.

How many independent quadrics hold the poses (the nullity of the design matrix) says how
special a motion is; which special one it is, a model says that is fitted to the poses: the
angle stays, or in complex numbers, with turn = exp(i angle),

    d = c - m turn                      a turn about one point,
    d = c - m turn + b / turn           two points of M on lines of F (Cardan's motion),

or the inverse of the last, two points of F on lines of M.  All are linear in c, m and b.  A
model holds where it misses no pose by more than the errors of the poses allow
(`Task.resolution`, taken as a bound).  So no special motion is read into a general one, and none
is missed for few digits.  Weights are left out: what a motion is does not depend on them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.tasks.motion_kinds import (
    FewPoses,
    General,
    MotionKind,
    Rest,
    TwoOrientations,
    Undetermined,
)
from burmester.tasks.motion_task import COARSE, Task
from burmester.tasks.repeated_poses import (
    ULPS,
    different,
    distinguishable,
    rotation_range,
    spanning,
)
from burmester.tasks.special_motions import (
    CircularTranslation,
    FreeTranslation,
    Rotation,
    StraightTranslation,
    TwoSliders,
)

__all__ = ["MotionClass", "classify_motion"]

ComplexArray = NDArray[np.complex128]

SLACK = 2.0  # a least-squares fit may miss by more than the errors that it fits
TELLING = 100.0  # errors; a model is claimed only where one more term would show by as much
LARGE = 0.1  # radians, rms; a turn that shows whether it is about one point
ENOUGH = 6  # poses told apart; how many more there are says nothing


@final
@dataclass(frozen=True, slots=True, eq=False)
class MotionClass:
    """What the motion of a task is.

    motion: its kind, with its numbers.
    first: (distinct,), the index of each different pose where it first comes.
    group: (N,), which of those each pose is: poses[first][group] are the poses, but for rounding
        and whole turns.  Exact repeats only, see `distinct`.
    singular_values: (8,) of the design matrix of the different poses, ascending, in canonical
        frames; nullity: how many of them are zero within `tolerance`, which follows the
        resolution of the task.
    five: (5,), which five of the different poses (indices into `first`) say what all of them say,
        where three quadrics hold the numbers as given: all dyads of the task are among theirs.
        None otherwise, and where it is three for want of digits only.
    rotation: the least arc that holds all orientations, in radians.
    """

    kind: MotionKind
    first: NDArray[np.int_]
    group: NDArray[np.int_]
    singular_values: FloatArray
    tolerance: float
    nullity: int
    five: NDArray[np.int_] | None
    rotation: float

    @property
    def distinct(self) -> int:
        """How many poses are different."""
        return len(self.first)

    @property
    def determined(self) -> bool:
        """Whether a fit is of use; else the kind of motion is the whole answer."""
        return isinstance(self.kind, General | TwoOrientations)


def classify_motion(task: Task) -> MotionClass:
    """What the motion of a task is, and how many of its poses differ."""
    first, group = different(task.poses)
    motion = _Motion.of(task.poses[first], task.resolution)
    seen = Displacement(_pair(motion.rest / (motion.length or 1.0)), np.angle(motion.turn))
    design = constraint_manifold.monomials(seen.as_image_point()) * constraint_manifold.INVARIANT
    padding = np.zeros((max(0, 8 - len(first)), 8))
    values = np.linalg.svd(np.concatenate([design, padding]), compute_uv=False)[::-1]
    tolerance = _tolerance(motion)
    nullity = int((values <= tolerance).sum())
    as_given = int((values <= _tolerance(motion.as_given())).sum())
    kind = _kind(task, first, motion, nullity, as_given)
    few = nullity == as_given == 3 and isinstance(kind, General | TwoOrientations)
    five = spanning(design, 5) if few else None
    rotation = rotation_range(task.poses.angle)
    return MotionClass(kind, first, group, values, tolerance, nullity, five, rotation)


# --- the poses in complex numbers, and how exactly they are known


@final
class _Motion(NamedTuple):
    """Different poses: d = c + minus_m turn + rest by least squares, and bounds on their errors.

    still: the angle is constant; then m is zero.  about_point: `rest` is no more than error.
    length: the size of what the canonical frames leave (see `frames`), the poses' own spread
    where that is nothing; zero where that is nothing too.
    """

    d: ComplexArray
    turn: ComplexArray
    still: bool
    about_point: bool
    c: complex
    minus_m: complex
    rest: ComplexArray
    length: float
    position_error: float
    turn_error: float
    rounding: float
    turn_rounding: float

    @classmethod
    def of(cls, poses: Displacement, resolution: tuple[float, float]) -> _Motion:
        d, turn = _complex(poses.translation), np.exp(1j * poses.angle)
        turns = max(1.0, float(np.abs(poses.angle).max()))
        spread = _rms(d - d.mean())
        position, angle = resolution
        position = min(position, COARSE * spread) if spread > 0 else position
        motion = cls(
            *(d, turn, True, False, complex(d.mean()), 0j, d - d.mean(), spread),
            *(position, min(angle, COARSE), ULPS * float(np.abs(d).max()), ULPS * turns),
        )
        if np.ptp(motion.away) <= 2 * SLACK * motion.angle_error:
            return motion
        rest, c, minus_m = _beyond(d, turn)
        moving = motion._replace(still=False, c=c, minus_m=minus_m, rest=rest, length=0.0)
        length = _rms(rest)
        if length <= ROUNDING * spread or moving.explains(rest, abs(minus_m)):
            return moving._replace(about_point=True, length=spread)
        return moving._replace(length=length)

    def as_given(self) -> _Motion:
        """The same numbers taken as exact."""
        return self._replace(position_error=0.0, turn_error=0.0)

    @property
    def away(self) -> FloatArray:
        """The angles from that of the first pose, in (-pi, pi]."""
        return np.asarray(np.angle(self.turn * self.turn[0].conj()))

    @property
    def angle_error(self) -> float:
        return max(self.turn_error, ROUNDING, self.turn_rounding)

    def error(self, lever: float) -> float:
        """How exactly the place of a point of M at `lever` from its origin is known."""
        printed = self.position_error + lever * self.turn_error
        return max(printed, ROUNDING * self.length, self.rounding + lever * self.turn_rounding)

    def explains(self, miss: ComplexArray | FloatArray, lever: float) -> bool:
        """Whether errors alone explain by how much a model misses the poses (N,)."""
        return bool(np.abs(miss).max() <= SLACK * self.error(lever))


def _tolerance(motion: _Motion) -> float:
    """What the errors of the poses can make of a singular value that is zero."""
    error = motion.error(abs(motion.minus_m)) / (motion.length or 1.0) + motion.angle_error
    return float(3 * min(error, COARSE) * np.sqrt(len(motion.d) / 3))


def _kind(
    task: Task, first: NDArray[np.int_], motion: _Motion, nullity: int, as_given: int
) -> MotionKind:
    count, unit, distinct = task.poses.shape[0], task.length_unit, len(first)
    apart = distinguishable(task.poses[first], motion.error(0.0), motion.angle_error, ENOUGH)
    kept = tuple(int(i) for i in first[apart])
    kind: MotionKind = General(nullity)
    if len(kept) == 1:
        kind = Rest(count)
    elif len(kept) == 2:
        kind = FewPoses(count, kept, len(kept) == distinct)
    elif motion.still:
        kind = _translation(motion, unit)
    elif (rotation := _rotation(motion, unit)) is not None:
        kind = rotation
    elif (sliders := _two_sliders(motion, unit)) is not None:
        kind = sliders
    elif len(kept) < min(ENOUGH, distinct):
        kind = FewPoses(count, kept, len(kept) == distinct)
    elif nullity > max(3, 8 - distinct):
        turned = rotation_range(task.poses.angle)
        kind = Undetermined(nullity, as_given, count, turned, motion.length, unit)
    elif (angles := _two_angles(motion)) is not None:
        kind = TwoOrientations(angles, nullity)
    return kind


# --- the models


def _translation(motion: _Motion, unit: str | None) -> MotionKind:
    away = motion.away
    angle = np.angle(motion.turn[0] * np.exp(0.5j * (away.max() + away.min())))
    points, spread = motion.rest / motion.length, motion.length
    _, _, (along, across) = np.linalg.svd(_pair(points), full_matrices=False)
    if motion.explains(_pair(points) @ across * spread, 0.0):
        return StraightTranslation(float(angle), float(np.arctan2(along[1], along[0]) % np.pi))
    centre, radius = _circle(points)
    arm = points - centre
    # A long link rounds off more than its place does.
    rounding = motion.rounding + ULPS * radius * spread
    if motion._replace(rounding=rounding).explains((np.abs(arm) - radius) * spread, 0.0):
        at, size = motion.c + centre * spread, radius * spread
        toward = float(np.angle(arm.mean()))
        return CircularTranslation(float(angle), _pair(at), size, 2 * spread, toward, unit)
    return FreeTranslation(float(angle))


def _rotation(motion: _Motion, unit: str | None) -> Rotation | None:
    """The turn about one point that the poses are, if they are one.

    Any little motion is nearly one; without a large turn it must be seen to be no Cardan motion.
    """
    if not motion.about_point:
        return None
    lever, turned = abs(motion.minus_m), _rms(motion.turn - motion.turn.mean())
    more, _, _ = _beyond(motion.turn.conj(), motion.turn)
    if turned < LARGE and lever * np.abs(more).max() < TELLING * motion.error(lever):
        return None
    free = motion.error(lever) / turned
    reach = abs(motion.c)
    size = motion.length if motion.length > ROUNDING * reach else reach
    return Rotation(_pair(motion.c), _pair(-motion.minus_m), free, size, unit)


def _two_sliders(motion: _Motion, unit: str | None) -> TwoSliders | None:
    """The two-slider motion that the poses are, or its inverse, if they are one.

    Fitted to `rest`, where far origins of F and M cost no digits; neither it nor its inverse has
    a part c + a turn of its own.  Three angles or fewer fit always, and show nothing.
    """
    for inverse in (False, True):
        turn = motion.turn.conj() if inverse else motion.turn
        rest = -motion.rest * turn if inverse else motion.rest
        term, term_c, term_turn = _beyond(turn.conj(), turn)
        more, _, _ = _beyond(turn**2, turn)
        power = np.vdot(term, term).real
        if not power > 0:
            continue
        b = complex(np.vdot(term, rest) / power)
        fixed, moving = (b * term_turn, -b * term_c) if inverse else (-b * term_c, b * term_turn)
        fixed, moving = motion.c + fixed, moving - motion.minus_m
        lever = abs(moving) + abs(b)
        shows = abs(b) * np.abs(more - term * (np.vdot(term, more) / power)).max()
        if motion.explains(rest - b * term, lever) and shows > TELLING * motion.error(lever):
            angles = float(np.angle(b)), float(np.angle(motion.turn.mean()))
            return TwoSliders(inverse, _pair(fixed), _pair(moving), abs(b), *angles, unit)
    return None


def _two_angles(motion: _Motion) -> tuple[float, float] | None:
    """The two angles, if there are no more."""
    away = motion.away
    second = motion.turn[np.abs(away).argmax()]
    other = np.angle(motion.turn * second.conj())
    if np.minimum(np.abs(away), np.abs(other)).max() > 2 * SLACK * motion.angle_error:
        return None
    low, high = sorted((float(np.angle(motion.turn[0])), float(np.angle(second))))
    return low, high


# --- kernels


def _beyond(values: ComplexArray, turn: ComplexArray) -> tuple[ComplexArray, complex, complex]:
    """What of values (N,) is beyond c + a turn, by least squares; c; a."""
    mean, mean_turn = values.mean(), turn.mean()
    spread = turn - mean_turn
    a = np.vdot(spread, values - mean) / np.vdot(spread, spread)
    return values - mean - a * spread, complex(mean - a * mean_turn), complex(a)


def _circle(points: ComplexArray) -> tuple[complex, float]:
    """Centre and radius of the circle nearest to centred points (N,), by squared distances.

    Its bias on a short arc is far below the errors wherever the arc is told from a line.
    """
    rows = np.column_stack([2 * points.real, 2 * points.imag, np.ones(len(points))])
    x, y, s = np.linalg.lstsq(rows, np.abs(points) ** 2, rcond=None)[0]
    return complex(x, y), float(np.sqrt(s + x * x + y * y))


def _complex(pairs: FloatArray) -> ComplexArray:
    return np.asarray(pairs[..., 0] + 1j * pairs[..., 1])


def _pair(values: ComplexArray | complex) -> FloatArray:
    z = np.asarray(values)
    return np.stack([z.real, z.imag], axis=-1)


def _rms(values: ComplexArray) -> float:
    return float(np.sqrt((np.abs(values) ** 2).mean()))
