"""The dyads of a fit, each as the circle or the slider that it is."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TypeAlias, final

import numpy as np

from burmester.dyads.critical_points import CriticalDyads
from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.local_minima import BestDyads
from burmester.dyads.long_links import SENSIBLE_SWING, swing
from burmester.dyads.pencil import MIN_POSES, Pencil, fit_pencil
from burmester.dyads.sliders import nearest_slider
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry import constraint_manifold
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.tasks.motion_task import COARSE, Task, characteristic_length

__all__ = [
    "Fit",
    "FoundDyad",
    "found_dyads",
    "relative_resolution",
    "same_dyad",
    "within_digits",
]

Fit: TypeAlias = Pencil | FivePoseDyads | BestDyads
Candidate: TypeAlias = tuple[Dyad, float, float]  # with its rms and greatest error

# Lengths are in characteristic lengths of the task.
MAX_SLIDER_ANGLE = 0.05  # sine; a manifold at a greater angle to a slider's is not that slider
STRAIGHT_SWING = 0.02  # radians; a link that swings less is a slider if that fits half as well
SLIDER_AS_WELL = 1.01  # ratio of errors, up to which a slider stands for a long link beside it
LOST_SHARE = 1e-6  # of the size; a greater error of an exact dyad is no longer rounding
MAX_LENGTH = 1e9  # no link is longer, and no pivot farther away
SAME_DYAD = 1e-6  # length or angle; dyads whose dimensions differ by less are one
MAX_POSE_ERRORS = 2.0  # errors of a pose; a dyad that misses by no more meets it within its digits
DISTANCE_ROUNDING = 64.0  # units in the last place of all that a distance is made of
COEFFICIENT_ROUNDING = 1e-9  # share of a manifold's norm that rounding leaves of a zero


@final
@dataclass(frozen=True, slots=True, eq=False)
class FoundDyad:
    """A dyad with its distance from the poses, in the task's length unit.

    minimum: whether it is a local minimum of what the method minimises; the exact method's
    dyads pass through the poses and are minima all.
    limits: which of the two limits of a task it obeys, 1 or 2; 0 where both dyads have the same.
    """

    id: str
    dyad: Dyad
    rms_error: float
    max_error: float
    minimum: bool = True
    limits: int = 0


def found_dyads(fit: Fit, task: Task) -> tuple[list[FoundDyad], int]:
    """The dyads of a fit, each as the circle or the slider that it is, and each once.

    A long link is a slider where the line it nearly follows fits the poses as well as the
    circle does, or as well as the poses are known; for noisy poses that is a heuristic.  But a link
    that swings by SENSIBLE_SWING, and meets the poses as the line does, is kept.
    Sorted by rms error; where errors are mere rounding, by the length of the link.

    Returns the dyads, and how many solutions were left out because they are no dyads: the link
    would be infinitely long and no slider fits in its place, the manifold determines nothing but
    the angle (`_two_angles`), or a dyad that should be exact is not, as rounding took its digits.
    """
    length, unit = characteristic_length(task), float(fit.frames.length)
    seen = fit.frames.to_canonical(task.poses)
    limited = isinstance(fit, BestDyads) and not isinstance(fit.search, CriticalDyads)
    near = 0.0 if limited else None  # it takes a fit of its own, and is seldom asked for
    found: list[Candidate] = []

    def add(dyad: Dyad, rms: float, worst: float) -> None:
        if not any(same_dyad(dyad, other, length) for other, *_ in found):
            found.append((dyad, rms, worst))

    def add_slider(line: PR | RP) -> None:
        slider = fit.frames.line_from_canonical(line)
        pivot = line.moving_pivot if isinstance(line, PR) else line.fixed_pivot
        if np.abs(pivot).max() < MAX_LENGTH:
            distance = unit * line.residual(seen)
            add(slider, float(np.sqrt((distance**2).mean())), float(np.abs(distance).max()))

    solutions = np.flatnonzero(np.isfinite(fit.coefficients).all(axis=-1))
    sliders = fit.sliders if isinstance(fit, BestDyads) else ()
    left_out = 0
    for k in solutions:
        p, circle = fit.coefficients[k], fit.dyads[k]
        rms, worst = float(fit.rms_error[k]), float(fit.max_error[k])
        if not limited and abs(p[0]) < MAX_SLIDER_ANGLE * constraint_manifold.size(p):
            nearest = nearest_slider(p, seen, task.weights)
            swung = swing(circle, task.poses)
            share = 2 if swung < STRAIGHT_SWING else 1
            known = relative_resolution(task, length) * length
            rounding = np.finfo(float).eps * float(circle.radius)  # of a distance so great
            allowed, miss = max(share * rms, known, rounding), unit * nearest.rms_error
            fits = miss <= allowed or not np.isfinite(allowed)
            near = _nearly_straight(fit, task, length) if near is None else near
            sensible = swung > SENSIBLE_SWING and rms <= max(miss, known)
            # A long link that gains next to nothing is no other dyad than its slider.
            same = isinstance(fit, BestDyads) and share == 2 and miss <= SLIDER_AS_WELL * rms
            if (nearest.angle_sine < near and fits and not sensible) or same:
                add_slider(nearest.dyad)
                continue
        if limited and sliders and swing(circle, task.poses) < STRAIGHT_SWING:
            continue  # on its way to one of them
        lost = isinstance(fit, FivePoseDyads) and rms > LOST_SHARE * max(
            length, float(circle.radius)
        )
        if lost or _two_angles(p) or not circle.radius < MAX_LENGTH * length:
            left_out += 1
            continue
        if isinstance(fit, BestDyads):
            add(circle, rms, worst)
        else:
            found.append((circle, rms, worst))
    for slider in sliders:
        add_slider(slider)

    def order(item: Candidate) -> tuple[float, float]:
        size = float(item[0].radius) if isinstance(item[0], RR) else np.inf
        return np.round(item[1] / (ROUNDING * length)), size

    found.sort(key=order)
    return [FoundDyad(f"D{i}", *item) for i, item in enumerate(found, start=1)], left_out


def _nearly_straight(fit: Fit, task: Task, length: float) -> float:
    """The sine of the angle by which noise turns a manifold away from the slider that it is."""
    if isinstance(fit, BestDyads):
        if task.poses.shape[0] < MIN_POSES:
            return MAX_SLIDER_ANGLE
        fit = fit_pencil(task.poses, task.weights)
    # Noise turns the null space, and so every manifold in it, by about this angle.
    blur = max(
        float(fit.noise),
        relative_resolution(task, length) * np.sqrt(task.poses.shape[0]),
        COEFFICIENT_ROUNDING,
    )
    return float(min(3 * blur / max(float(fit.gap), 1e-300), MAX_SLIDER_ANGLE))


def _two_angles(p: FloatArray) -> bool:
    """Whether p (8,) holds the angle to one of two values and no place: it is no dyad.

    Such a quadric, two planes, holds the poses where they have but two different angles.  It
    is a double root, and so known to half the digits only.
    """
    return bool(np.linalg.norm(p[[0, 2, 3, 4, 5]]) < SAME_DYAD * constraint_manifold.size(p))


def relative_resolution(task: Task, length: float) -> float:
    """How exactly the poses are known, as a share of the characteristic length."""
    position, angle = task.resolution
    return max(min(position / length + angle, COARSE), ROUNDING)


def within_digits(found: FoundDyad, task: Task, times: float = 1.0) -> bool:
    """Whether a dyad meets all poses of a task within the errors, or a number of times as much,
    that their digits leave.
    """
    dyad, (position, angle) = found.dyad, task.resolution
    size = float(np.abs(task.poses.translation).max())
    parts = [float(np.abs(getattr(dyad, each.name)).max()) for each in fields(dyad)]
    lever = float(np.linalg.norm(dyad.moving_pivot)) if isinstance(dyad, RR | PR) else 0.0
    if isinstance(dyad, RP):
        lever = float(np.linalg.norm(dyad.fixed_pivot - task.poses.translation, axis=-1).max())
    turns = max(1.0, float(np.abs(task.poses.angle).max()))
    rounding = DISTANCE_ROUNDING * np.finfo(float).eps * (size + sum(parts) + lever * turns)
    allowed = MAX_POSE_ERRORS * (position + lever * angle) + rounding
    return bool(found.max_error <= times * allowed)


def same_dyad(a: Dyad, b: Dyad, length: float) -> bool:
    """Whether two dyads are one up to rounding; `length` is the task's."""
    if type(a) is not type(b):
        return False
    gaps = [(np.abs(getattr(a, f.name) - getattr(b, f.name)).max(), f.name) for f in fields(a)]
    return all(
        gap < (SAME_DYAD if name.endswith("angle") else SAME_DYAD * length) for gap, name in gaps
    )
