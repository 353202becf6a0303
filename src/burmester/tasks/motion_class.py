"""The motion class of a task, from its poses alone, before any dyad is computed.

The number of independent quadrics that hold the poses (the nullity of the design matrix) says how
special a motion is.  Which special one it is, models fitted to the poses say: the angle is
constant, or in complex numbers, with turn = exp(i angle),

    d = c - m turn                      a turn about one point,
    d = c - m turn + b / turn           two points of M on lines of F (Cardan's motion),

or the inverse of the last, two points of F on lines of M.  All are linear in c, m and b.  A
model holds where it misses no pose by more than the errors of the poses allow
(`Task.resolution`, taken as a bound).  So a general motion is never taken for a special one, and
few digits hide none.  Turns and two sliders are also claimed where the residuals are scatter
(`tasks/scatter`).  Weights have no part in it, nor has the origin of M: a body that turns about it
has no travel to compare errors with, so errors are compared with residuals alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, ComplexArray, FloatArray, complex_of
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
    COORDINATE_ROUNDING,
    distinguishable,
    orientation_arc,
    repeats_in_sequence,
    rotation_range,
    spanning,
)
from burmester.tasks.scatter import (
    MAX_RESIDUAL_ERRORS,
    SLIDERS,
    is_scatter,
    max_residual_errors,
    max_scatter,
    odd_one,
)
from burmester.tasks.special_motions import (
    CircularTranslation,
    FreeTranslation,
    Rotation,
    StraightTranslation,
    TwoSliders,
)

__all__ = ["LARGE_ROTATION", "MotionClass", "classify_motion"]

MIN_NEXT_TERM_ERRORS = 100.0  # pose errors that one more term of a model makes, where it is sure
# Pose errors, the same where it is claimed within the digits, and the rms residual of such a model.
# By `benchmarks.two_slider_motions` up to 1 % of general motions are then taken for two sliders.
LIKELY_NEXT_TERM_ERRORS, LIKELY_RMS_ERRORS = 20.0, 1.0
# Scatter over the travel of M's origin: at most so much far from the pin, at least so much at it.
FAR_SHARE, PIN_SHARE = 0.02, 0.4
LARGE_ROTATION = 0.1  # radians, rms; as large a one shows by itself whether it is about a point
MAX_COUNTED_POSES = 6  # that can be told apart; the class does not depend on more


@final
@dataclass(frozen=True, slots=True, eq=False)
class MotionClass:
    """What the motion of a task is.

    kind: its kind, with its numbers.
    first: (distinct,), the indices of the distinct poses, each where it first comes.
    group: (N,), which of those each pose is: poses[first][group] are the poses, but for rounding
        and whole turns.  Exact repeats only, see `exact_repeats`.
    singular_values: (8,) of the design matrix of the distinct poses, ascending, in canonical
        frames.
    tolerance: up to which a singular value counts as zero; it follows the task's resolution.
    nullity: the number of singular values that count as zero.
    five: (5,), five of the distinct poses (indices into `first`) that determine all the others,
        where three quadrics hold the numbers as given: all dyads of the task are among theirs.
        None otherwise, also where three quadrics hold the poses only within their digits.
    rotation: the least arc around all orientations, in radians.
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
        """The number of distinct poses."""
        return len(self.first)

    @property
    def determined(self) -> bool:
        """Whether a fit makes sense; else the kind of motion is the whole answer."""
        return isinstance(self.kind, General | TwoOrientations)


def classify_motion(task: Task) -> MotionClass:
    """The class of a task's motion, and its distinct poses.

    Formula `rotation-and-sliders` of the theory.
    """
    first, group = repeats_in_sequence(task.poses, task.free_angles)
    motion = _RotationFit.of(task.poses[first], task.resolution)
    canonical = Displacement(
        _pairs_of(motion.residual / (motion.length or 1.0)), np.angle(motion.turn)
    )
    design = (
        constraint_manifold.monomials(canonical.as_image_point()) * constraint_manifold.INVARIANT
    )
    padding = np.zeros((max(0, 8 - len(first)), 8))
    values = np.linalg.svd(np.concatenate([design, padding]), compute_uv=False)[::-1]
    tolerance = _tolerance(motion)
    nullity = int((values <= tolerance).sum())
    as_given = int((values <= _tolerance(motion.as_given())).sum())
    kind = _kind(task, first, motion, nullity, as_given)
    by_five = nullity == as_given == 3 and isinstance(kind, General | TwoOrientations)
    five = spanning(design, 5) if by_five else None
    rotation = rotation_range(task.poses.angle)
    return MotionClass(kind, first, group, values, tolerance, nullity, five, rotation)


# --- the poses in complex numbers, and how exactly they are known


@final
class _RotationFit(NamedTuple):
    """Distinct poses as d = c + minus_m turn + residual, by least squares; bounds on their errors.

    constant_angle: whether all angles are the same within their errors; then m is zero.
    about_point: whether errors explain the residual.
    length: the rms of the residual, which is the unit of the canonical frames; where errors explain
        it, the spread of the poses; zero where they do not spread either.
    """

    d: ComplexArray
    turn: ComplexArray
    constant_angle: bool
    about_point: bool
    c: complex
    minus_m: complex
    residual: ComplexArray
    length: float
    position_error: float
    turn_error: float
    rounding: float
    turn_rounding: float

    @classmethod
    def of(cls, poses: Displacement, resolution: tuple[float, float]) -> _RotationFit:
        d, turn = complex_of(poses.translation), np.exp(1j * poses.angle)
        # The travel depends on the origin of M, so errors of a large rotation count as stated.
        large = _rms(turn - turn.mean()) >= LARGE_ROTATION
        turns = max(1.0, float(np.abs(poses.angle).max()))
        spread = _rms(d - d.mean())
        position, angle = resolution
        if spread > 0 and not large:
            position = min(position, COARSE * spread)
        motion = cls(
            *(d, turn, True, False, complex(d.mean()), 0j, d - d.mean(), spread),
            *(
                position,
                angle if large else min(angle, COARSE),
                COORDINATE_ROUNDING * float(np.abs(d).max()),
                COORDINATE_ROUNDING * turns,
            ),
        )
        if np.ptp(motion.angle_offsets) <= 2 * MAX_RESIDUAL_ERRORS * motion.angle_error:
            return motion
        residual, c, minus_m = _rotation_residual(d, turn)
        moving = motion._replace(
            constant_angle=False, c=c, minus_m=minus_m, residual=residual, length=0.0
        )
        length = _rms(residual)
        if length <= ROUNDING * spread or moving.explains(residual, abs(minus_m)):
            return moving._replace(about_point=True, length=spread)
        return moving._replace(length=length)

    def as_given(self) -> _RotationFit:
        """The same numbers taken as exact."""
        return self._replace(position_error=0.0, turn_error=0.0)

    @property
    def angle_offsets(self) -> FloatArray:
        """The angles from that of the first pose, in (-pi, pi]."""
        return np.asarray(np.angle(self.turn * self.turn[0].conj()))

    @property
    def angle_error(self) -> float:
        return max(min(self.turn_error, COARSE), ROUNDING, self.turn_rounding)

    def error(self, lever: float) -> float:
        """The error of the place of a point of M at the distance `lever` from its origin."""
        printed = self.position_error + lever * self.turn_error
        return max(printed, ROUNDING * self.length, self.rounding + lever * self.turn_rounding)

    def explains(self, miss: ComplexArray | FloatArray, lever: float) -> bool:
        """Whether errors alone explain the residuals (N,) of a model."""
        return bool(np.abs(miss).max() <= max_residual_errors(len(self.d)) * self.error(lever))


def _tolerance(motion: _RotationFit) -> float:
    """The most that errors of the poses make of a singular value of zero."""
    error = motion.error(abs(motion.minus_m)) / (motion.length or 1.0) + motion.angle_error
    return float(3 * min(error, COARSE) * np.sqrt(len(motion.d) / 3))


def _kind(
    task: Task, first: NDArray[np.int_], motion: _RotationFit, nullity: int, as_given: int
) -> MotionKind:
    count, unit, distinct = task.poses.shape[0], task.length_unit, len(first)
    apart = distinguishable(
        task.poses[first], motion.error(0.0), motion.angle_error, MAX_COUNTED_POSES
    )
    representatives = tuple(int(i) for i in first[apart])
    kind: MotionKind = General(nullity)
    if len(representatives) == 1:
        kind = Rest(count)
    elif len(representatives) == 2:
        if distinct > 2:
            kind = FewPoses(count, representatives, repeats=False)
    elif motion.constant_angle:
        kind = _translation(motion, unit)
    elif (rotation := _rotation(motion, unit)) is not None:
        kind = rotation
    elif (sliders := _two_sliders(motion, max_scatter(task), unit)) is not None:
        kind = sliders
    elif scattered := _scattered_rotation(motion, first, nullity, max_scatter(task), unit):
        kind = scattered
    elif len(representatives) < min(MAX_COUNTED_POSES, distinct):
        kind = FewPoses(count, representatives, len(representatives) == distinct)
    elif nullity > max(3, 8 - distinct):
        turned = rotation_range(task.poses.angle)
        kind = Undetermined(nullity, as_given, count, turned, motion.length, unit)
    elif (angles := _two_angles(motion)) is not None:
        kind = TwoOrientations(angles, nullity)
    return kind


# --- the models


def _translation(motion: _RotationFit, unit: str | None) -> MotionKind:
    angle_offsets = motion.angle_offsets
    angle = np.angle(motion.turn[0] * np.exp(0.5j * (angle_offsets.max() + angle_offsets.min())))
    points, spread = motion.residual / motion.length, motion.length
    _, _, (along, across) = np.linalg.svd(_pairs_of(points), full_matrices=False)
    if motion.explains(_pairs_of(points) @ across * spread, 0.0):
        return StraightTranslation(float(angle), float(np.arctan2(along[1], along[0]) % np.pi))
    centre, radius = _circle(points)
    arm = points - centre
    # A long link rounds off more than its place does.
    rounding = motion.rounding + COORDINATE_ROUNDING * radius * spread
    if motion._replace(rounding=rounding).explains((np.abs(arm) - radius) * spread, 0.0):
        at, size = motion.c + centre * spread, radius * spread
        toward = float(np.angle(arm.mean()))
        return CircularTranslation(float(angle), _pairs_of(at), size, 2 * spread, toward, unit)
    return FreeTranslation(float(angle))


def _rotation(motion: _RotationFit, unit: str | None) -> Rotation | None:
    """The rotation about one point, if the poses are one.

    Any small motion nearly is one; a small rotation is claimed only where it differs from Cardan
    motion.
    """
    if not motion.about_point:
        return None
    lever, turned = abs(motion.minus_m), _rms(motion.turn - motion.turn.mean())
    more, _, _ = _rotation_residual(motion.turn.conj(), motion.turn)
    if turned < LARGE_ROTATION and lever * np.abs(more).max() < MIN_NEXT_TERM_ERRORS * motion.error(
        lever
    ):
        return None
    free = motion.error(lever) / turned
    reach = abs(motion.c)
    size = motion.length if motion.length > ROUNDING * reach else reach
    return Rotation(_pairs_of(motion.c), _pairs_of(-motion.minus_m), free, size, unit=unit)


def _scattered_rotation(
    motion: _RotationFit,
    first: NDArray[np.int_],
    nullity: int,
    most_scatter: float,
    unit: str | None,
) -> Rotation | None:
    """The rotation about which poses scatter, all or all but one, where none is exact."""
    d, turn, residual = motion.d, motion.turn, motion.residual
    centre, minus_m, odd = motion.c, motion.minus_m, int(odd_one(residual, turn))
    kept = np.arange(len(d)) != odd
    if odd >= 0:
        residual, centre, minus_m = _rotation_residual(d[kept], turn[kept])
    turned = _rms(turn[kept] - turn[kept].mean())
    exact = (
        _rms(residual) <= motion.error(abs(minus_m)) if odd >= 0 else nullity > max(0, 8 - len(d))
    )
    if exact or turned < LARGE_ROTATION or _rms(residual) > most_scatter:
        return None
    # Between the two lie poses that somebody sketched: there a pin would be a guess.
    share = _rms(residual) / (_rms(d[kept] - d[kept].mean()) or 1.0)
    if FAR_SHARE < share < PIN_SHARE or not is_scatter(residual, turn[kept]):
        return None
    off = None
    if odd >= 0:
        off = int(first[odd]), float(abs(d[odd] - centre - minus_m * turn[odd]))
    centres = _pairs_of(centre), _pairs_of(-minus_m)
    free, size = _rms(residual) / turned, _rms(d[kept] - d[kept].mean())
    return Rotation(*centres, free, size, float(np.abs(residual).max()), off, unit)


def _two_sliders(motion: _RotationFit, most_scatter: float, unit: str | None) -> TwoSliders | None:
    """The two-slider motion or its inverse, if the poses are one.

    Fitted to the residual, where far origins of F and M cost no digits; neither motion has a part
    c + a turn of its own.  Three angles or fewer always fit, and prove nothing.
    """
    for inverse in (False, True):
        turn = motion.turn.conj() if inverse else motion.turn
        residual = -motion.residual * turn if inverse else motion.residual
        term, term_c, term_turn = _rotation_residual(turn.conj(), turn)
        more, _, _ = _rotation_residual(turn**2, turn)
        power = np.vdot(term, term).real
        if not power > 0:
            continue
        b = complex(np.vdot(term, residual) / power)
        fixed, moving = (b * term_turn, -b * term_c) if inverse else (-b * term_c, b * term_turn)
        fixed, moving = motion.c + fixed, moving - motion.minus_m
        lever = abs(moving) + abs(b)
        shows = abs(b) * np.abs(more - term * (np.vdot(term, more) / power)).max()
        miss, error = residual - b * term, motion.error(lever)
        explained, scatter = motion.explains(miss, lever), 0.0
        if not explained and _rms(miss) <= most_scatter and is_scatter(miss, turn, SLIDERS):
            explained, scatter = True, float(np.abs(miss).max())
            error = max(error, _rms(miss))
        sure = shows > MIN_NEXT_TERM_ERRORS * error
        likely = shows > LIKELY_NEXT_TERM_ERRORS * error and _rms(miss) <= LIKELY_RMS_ERRORS * error
        if explained and (sure or likely):
            middle, rotation = orientation_arc(np.angle(motion.turn))
            centres = _pairs_of(fixed), _pairs_of(moving)
            phase = float(np.angle(b))
            swing = abs(b), phase, middle, rotation
            return TwoSliders(inverse, *centres, *swing, not sure, scatter, unit)
    return None


def _two_angles(motion: _RotationFit) -> tuple[float, float] | None:
    """The two angles of the poses, if there are no more."""
    angle_offsets = motion.angle_offsets
    second = motion.turn[np.abs(angle_offsets).argmax()]
    other = np.angle(motion.turn * second.conj())
    if (
        np.minimum(np.abs(angle_offsets), np.abs(other)).max()
        > 2 * MAX_RESIDUAL_ERRORS * motion.angle_error
    ):
        return None
    low, high = sorted((float(np.angle(motion.turn[0])), float(np.angle(second))))
    return low, high


# --- kernels


def _rotation_residual(
    values: ComplexArray, turn: ComplexArray
) -> tuple[ComplexArray, complex, complex]:
    """The residual (N,) of values - (c + a turn) by least squares, with c and a."""
    mean, mean_turn = values.mean(), turn.mean()
    spread = turn - mean_turn
    a = np.vdot(spread, values - mean) / np.vdot(spread, spread)
    return values - mean - a * spread, complex(mean - a * mean_turn), complex(a)


def _circle(points: ComplexArray) -> tuple[complex, float]:
    """Centre and radius of the circle nearest to centred points (N,), by squared distances.

    Its bias on a short arc is far below the errors wherever an arc differs from a line at all.
    """
    rows = np.column_stack([2 * points.real, 2 * points.imag, np.ones(len(points))])
    x, y, s = np.linalg.lstsq(rows, np.abs(points) ** 2, rcond=None)[0]
    return complex(x, y), float(np.sqrt(s + x * x + y * y))


def _pairs_of(values: ComplexArray | complex) -> FloatArray:
    z = np.asarray(values)
    return np.stack([z.real, z.imag], axis=-1)


def _rms(values: ComplexArray) -> float:
    return float(np.sqrt((np.abs(values) ** 2).mean()))
