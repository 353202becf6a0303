"""The dyads of a fit, each as the circle or the slider that it is."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TypeAlias, final

import numpy as np

from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.local_minima import BestDyads
from burmester.dyads.minima_within_limits import LimitedDyads
from burmester.dyads.pencil import LEAST_POSES, Pencil, fit_pencil
from burmester.dyads.sliders import straightened
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry import constraint_manifold
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.tasks.motion_task import COARSE, Task, characteristic_length

__all__ = ["LONG", "Fit", "FoundDyad", "found_dyads", "known", "same_dyad"]

Fit: TypeAlias = Pencil | FivePoseDyads | BestDyads
Candidate: TypeAlias = tuple[Dyad, float, float]  # with its rms and greatest error

# In characteristic lengths of the task, where they are lengths.
NEARLY_STRAIGHT = 0.05  # a manifold nearer than this to a slider's may be that slider
LONG = 100.0  # a longer link is a slider if that fits half as well, or is called nearly one
LOST = 1e-6  # an error of this share is no longer rounding in a dyad that should be exact
ENDLESS = 1e9  # no link is longer, and no pivot farther away
SAME = 1e-6  # dyads with both pivots nearer than this are one
NULL = 1e-9  # what rounding leaves of a coefficient that is zero


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

    With them, how many solutions were left out because they are no dyads: the link would be
    infinitely long and no slider fits in its place, only the angle is said (`_two_angles`), or
    a dyad that should pass exactly does not, for rounding has eaten its digits.

    A long link is a slider where the line it nearly follows fits the poses as well as the
    circle does, or as well as the poses are known.  For noisy poses that is a heuristic.
    Sorted by rms error; where errors are mere rounding, by the length of the link.
    """
    length, unit = characteristic_length(task), float(fit.frames.length)
    seen = fit.frames.see(task.poses)
    limited = isinstance(fit, BestDyads) and isinstance(fit.search, LimitedDyads)
    near = 0.0 if limited else _nearly_straight(fit, task, length)
    found: list[Candidate] = []

    def add(dyad: Dyad, rms: float, worst: float) -> None:
        if not any(same_dyad(dyad, other, length) for other, *_ in found):
            found.append((dyad, rms, worst))

    def add_slider(line: PR | RP) -> None:
        slider = fit.frames.line_back(line)
        pivot = line.moving_pivot if isinstance(line, PR) else line.fixed_pivot
        if np.abs(pivot).max() < ENDLESS:
            miss = unit * line.residual(seen)
            add(slider, float(np.sqrt((miss**2).mean())), float(np.abs(miss).max()))

    solutions = np.flatnonzero(np.isfinite(fit.coefficients).all(axis=-1))
    sliders = fit.sliders if isinstance(fit, BestDyads) else ()
    left_out = 0
    for k in solutions:
        p, circle = fit.coefficients[k], fit.dyads[k]
        rms, worst = float(fit.rms_error[k]), float(fit.max_error[k])
        if not limited and abs(p[0]) < NEARLY_STRAIGHT * constraint_manifold.size(p):
            line, error, _, apart = straightened(p, seen, task.weights)
            share = 1 if circle.radius < LONG * length else 2
            rounding = np.finfo(float).eps * float(circle.radius)  # of a distance so great
            allowed = max(share * rms, known(task, length) * length, rounding)
            fits = unit * error <= allowed or not np.isfinite(allowed)
            if apart < near and fits:
                add_slider(line)
                continue
        if limited and circle.radius > LONG * length and sliders:
            continue  # on its way to one of them
        lost = isinstance(fit, FivePoseDyads) and rms > LOST * max(length, float(circle.radius))
        if lost or _two_angles(p) or not circle.radius < ENDLESS * length:
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
        if task.poses.shape[0] < LEAST_POSES:
            return NEARLY_STRAIGHT
        fit = fit_pencil(task.poses, task.weights)
    # Noise turns the null space, and so every manifold in it, by about this angle.
    blur = max(float(fit.noise), known(task, length) * np.sqrt(task.poses.shape[0]), NULL)
    return float(min(3 * blur / max(float(fit.gap), 1e-300), NEARLY_STRAIGHT))


def _two_angles(p: FloatArray) -> bool:
    """Whether p (8,) says nothing of places, only that the angle is one of two: no dyad.

    Such a quadric, two planes, holds the poses where they have but two different angles.  It
    is a double root, and so known to half the digits only.
    """
    return bool(np.linalg.norm(p[[0, 2, 3, 4, 5]]) < SAME * constraint_manifold.size(p))


def known(task: Task, length: float) -> float:
    """How exactly the poses are known, as a share of the characteristic length."""
    position, angle = task.resolution
    return max(min(position / length + angle, COARSE), ROUNDING)


def same_dyad(a: Dyad, b: Dyad, length: float) -> bool:
    """Whether two dyads are one up to rounding; `length` is the task's."""
    if type(a) is not type(b):
        return False
    gaps = [(np.abs(getattr(a, f.name) - getattr(b, f.name)).max(), f.name) for f in fields(a)]
    return all(gap < (SAME if name.endswith("angle") else SAME * length) for gap, name in gaps)
