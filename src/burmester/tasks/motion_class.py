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
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ROUNDING, ComplexArray, FloatArray, pairs_of
from burmester.tasks.motion_kinds import (
    FewPoses,
    General,
    MotionKind,
    Rest,
    TwoOrientations,
    Undetermined,
)
from burmester.tasks.motion_task import Task
from burmester.tasks.repeated_poses import (
    COORDINATE_ROUNDING,
    distinguishable,
    orientation_arc,
    repeats_in_sequence,
    rotation_range,
    spanning,
)
from burmester.tasks.rotation_fit import LARGE_ROTATION, RotationFit, residual_of_turn, rms
from burmester.tasks.scatter import SLIDERS, is_scatter, max_scatter, odd_one
from burmester.tasks.special_motions import (
    CircularTranslation,
    FreeTranslation,
    Rotation,
    StraightTranslation,
    TwoSliders,
)

MIN_NEXT_TERM_ERRORS = 100.0  # pose errors that one more term of a model makes, where it is sure
# Pose errors, the same where it is claimed within the digits, and the rms residual of such a model.
# By `benchmarks.two_slider_motions` up to 1 % of general motions are then taken for two sliders.
LIKELY_NEXT_TERM_ERRORS, LIKELY_RMS_ERRORS = 20.0, 1.0
# Scatter over the travel of M's origin: at most so much far from the pin, at least so much at it.
FAR_SHARE, PIN_SHARE = 0.02, 0.4
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
    motion = RotationFit.of(task.poses[first], task.resolution)
    design, padding = motion.design, np.zeros((max(0, 8 - len(first)), 8))
    values = np.linalg.svd(np.concatenate([design, padding]), compute_uv=False)[::-1]
    tolerance = float(motion.tolerance())
    nullity = int((values <= tolerance).sum())
    as_given = int((values <= motion.tolerance(as_given=True)).sum())
    kind = _kind(task, first, motion, nullity, as_given)
    by_five = nullity == as_given == 3 and isinstance(kind, General | TwoOrientations)
    five = spanning(design, 5) if by_five else None
    rotation = rotation_range(task.poses.angle)
    return MotionClass(kind, first, group, values, tolerance, nullity, five, rotation)


def _kind(
    task: Task, first: NDArray[np.int_], motion: RotationFit, nullity: int, as_given: int
) -> MotionKind:
    count, unit, distinct = task.poses.shape[0], task.length_unit, len(first)
    apart = distinguishable(
        task.poses[first], float(motion.error(0.0)), float(motion.angle_error), MAX_COUNTED_POSES
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
        kind = Undetermined(nullity, as_given, count, turned, float(motion.length), unit)
    elif motion.two_angles[1]:
        low, high = sorted(np.angle([motion.turn[0], motion.two_angles[0]]).tolist())
        kind = TwoOrientations((low, high), nullity)
    return kind


# --- the models


def _translation(motion: RotationFit, unit: str | None) -> MotionKind:
    angle_offsets = motion.angle_offsets
    angle = np.angle(motion.turn[0] * np.exp(0.5j * (angle_offsets.max() + angle_offsets.min())))
    points, spread = motion.residual / motion.length, float(motion.length)
    _, _, (along, across) = np.linalg.svd(pairs_of(points), full_matrices=False)
    if motion.explains(pairs_of(points) @ across * spread, 0.0):
        return StraightTranslation(float(angle), float(np.arctan2(along[1], along[0]) % np.pi))
    centre, radius = _circle(points)
    arm = points - centre
    # A long link rounds off more than its place does.
    rounding = motion.rounding + COORDINATE_ROUNDING * radius * spread
    if motion._replace(rounding=rounding).explains((np.abs(arm) - radius) * spread, 0.0):
        at, size = complex(motion.c) + centre * spread, radius * spread
        toward = float(np.angle(arm.mean()))
        return CircularTranslation(float(angle), pairs_of(at), size, 2 * spread, toward, unit)
    return FreeTranslation(float(angle))


def _rotation(motion: RotationFit, unit: str | None) -> Rotation | None:
    """The rotation about one point, if the poses are one; a small one only if no Cardan motion."""
    if not motion.about_point:
        return None
    lever, turned = float(abs(motion.minus_m)), rms(motion.turn - motion.turn.mean())
    more, _, _ = residual_of_turn(motion.turn.conj(), motion.turn)
    if turned < LARGE_ROTATION and lever * np.abs(more).max() < MIN_NEXT_TERM_ERRORS * motion.error(
        lever
    ):
        return None
    free, reach = float(motion.error(lever) / turned), float(abs(motion.c))
    size = float(motion.length) if motion.length > ROUNDING * reach else reach
    return Rotation(pairs_of(motion.c), pairs_of(-motion.minus_m), free, size, unit=unit)


def _scattered_rotation(
    motion: RotationFit,
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
        residual, centre, minus_m = residual_of_turn(d[kept], turn[kept])
    turned = rms(turn[kept] - turn[kept].mean())
    exact = (
        rms(residual) <= motion.error(float(abs(minus_m)))
        if odd >= 0
        else nullity > max(0, 8 - len(d))
    )
    if exact or turned < LARGE_ROTATION or rms(residual) > most_scatter:
        return None
    # Between the two lie poses that somebody sketched: there a pin would be a guess.
    size = float(rms(d[kept] - d[kept].mean()))
    share = rms(residual) / (size or 1.0)
    if FAR_SHARE < share < PIN_SHARE or not is_scatter(residual, turn[kept]):
        return None
    off = None
    if odd >= 0:
        off = int(first[odd]), float(abs(d[odd] - centre - minus_m * turn[odd]))
    centres = pairs_of(centre), pairs_of(-minus_m)
    free = float(rms(residual) / turned)
    return Rotation(*centres, free, size, float(np.abs(residual).max()), off, unit)


def _two_sliders(motion: RotationFit, most_scatter: float, unit: str | None) -> TwoSliders | None:
    """The two-slider motion or its inverse, if the poses are one.

    Fitted to the residual, where far origins of F and M cost no digits; neither motion has a part
    c + a turn of its own.  Three angles or fewer always fit, and prove nothing.
    """
    for inverse in (False, True):
        turn = motion.turn.conj() if inverse else motion.turn
        residual = -motion.residual * turn if inverse else motion.residual
        term, term_c, term_turn = residual_of_turn(turn.conj(), turn)
        more, _, _ = residual_of_turn(turn**2, turn)
        power = float(np.vdot(term, term).real)
        if not power > 0:
            continue
        b = complex(np.vdot(term, residual) / power)
        fixed, moving = (b * term_turn, -b * term_c) if inverse else (-b * term_c, b * term_turn)
        fixed, moving = motion.c + fixed, moving - motion.minus_m
        lever = float(abs(moving) + abs(b))
        shows = abs(b) * np.abs(more - term * (np.vdot(term, more) / power)).max()
        miss, error = residual - b * term, float(motion.error(lever))
        explained, scatter = bool(motion.explains(miss, lever)), 0.0
        if not explained and rms(miss) <= most_scatter and is_scatter(miss, turn, SLIDERS):
            explained, scatter = True, float(np.abs(miss).max())
            error = max(error, float(rms(miss)))
        sure = shows > MIN_NEXT_TERM_ERRORS * error
        likely = shows > LIKELY_NEXT_TERM_ERRORS * error and rms(miss) <= LIKELY_RMS_ERRORS * error
        if explained and (sure or likely):
            middle, rotation = orientation_arc(np.angle(motion.turn))
            centres = pairs_of(fixed), pairs_of(moving)
            phase = float(np.angle(b))
            swing = abs(b), phase, middle, rotation
            return TwoSliders(inverse, *centres, *swing, not sure, scatter, unit)
    return None


def _circle(points: ComplexArray) -> tuple[complex, float]:
    """Centre and radius of the circle nearest to centred points (N,), by squared distances."""
    rows = np.column_stack([2 * points.real, 2 * points.imag, np.ones(len(points))])
    x, y, s = np.linalg.lstsq(rows, np.abs(points) ** 2, rcond=None)[0]
    return complex(x, y), float(np.sqrt(s + x * x + y * y))
