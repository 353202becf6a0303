"""The locally best dyads of many plain tasks: `local_minima.best_dyads` for stacks.

The critical points of all tasks come from stacked eigenproblems; the ways down from them are made
by Newton's method on the circles of all tasks at once.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_descent import MAX_LENGTH, minima_of, reach
from burmester.dyads.critical_points import points_at_infinity
from burmester.dyads.local_minima import LITTLE_TURN, MAX_POSES_FOLLOWED
from burmester.dyads.many_critical_points import many_critical_points
from burmester.dyads.pencil import MIN_POSES, fit_pencil
from burmester.dyads.plain_circle_descent import plain_descent, steady_starts
from burmester.dyads.selection import MAX_SLIDER_ANGLE
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.dyads.starts_down import starts_down
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import take
from burmester.numerics.weights import shares
from burmester.stacked.advice import within_digits
from burmester.stacked.found_dyads import Fits, Solutions, found_in_stack
from burmester.stacked.plain_tasks import plain_tasks
from burmester.stacked.task_stack import TaskStack
from burmester.stacked.vouched import Vouched
from burmester.synthesis.dyad_search import LINKAGE_QUADRICS
from burmester.synthesis.outcome import NEAR_DIGITS

__all__ = ["best_dyads_in_stack"]

Indices = NDArray[np.intp]


def best_dyads_in_stack(stack: TaskStack) -> Vouched:
    """The locally best dyads of tasks that can be computed with, of five poses or more.

    Vouched for are plain tasks whose critical points are all found, and whose body does not turn
    so little that the ways down are long.
    """
    plain, nullity = plain_tasks(stack)
    count = stack.poses.shape[1]
    index = np.flatnonzero(plain & (count <= MAX_POSES_FOLLOWED))
    poses, weights = stack[index].displacements, stack[index].weights
    frames, seen = CanonicalFrames.of(poses, weights)
    share = shares(weights, seen.shape)
    far = points_at_infinity(poses, frames, seen, weights)
    points, all_found = many_critical_points(seen, weights, far)
    easy = all_found & (reach(seen, share) <= LITTLE_TURN)
    index, points, share, seen = index[easy], points[easy], share[easy], seen[easy]
    stack, frames = stack[index], take(frames, easy)
    lines = fixed_lines(seen, stack.weights)[0][:, 0], moving_lines(seen, stack.weights)[0][:, 0]
    task, z = starts_down(points, lines, seen, share)
    longest = MAX_LENGTH * reach(seen, share)
    descent = plain_descent(steady_starts(z), task, seen, share, longest)
    once, unfinished = minima_of(descent, task, len(index))
    task, z = task[once], descent.z[once]
    circles = RR(z[:, :2], z[:, 2:4], z[:, 4])
    distance = circles[:, None].residual(seen[task])
    unit = frames.length[task]
    own = take(frames, task).circle_from_canonical(circles[:, None])[:, 0]
    solutions = Solutions(
        task,
        circles.coefficients(),
        own,
        np.sqrt((distance**2).mean(axis=-1)) * unit,
        np.abs(distance).max(axis=-1) * unit,
    )
    fits = Fits(stack, frames, seen, frames.length, minima=True)
    found = found_in_stack(fits, solutions, _blur(fits), lines=True)
    vouched = Vouched.of(index, "locally best", fits, found)
    meeting = np.bincount(found.task[within_digits(fits, found, NEAR_DIGITS)], minlength=len(index))
    exact = (nullity[index] >= LINKAGE_QUADRICS) & (max(0, 8 - count) < LINKAGE_QUADRICS)
    missing = (exact & (meeting < LINKAGE_QUADRICS)) | (unfinished > 0)
    return vouched._replace(advice=vouched.advice._replace(missing=missing))


def _blur(fits: Fits) -> FloatArray:
    """The angles (T,) by which noise turns manifolds of sliders, by the pencils of the poses."""
    if fits.poses.shape[-1] < MIN_POSES:
        return np.full(len(fits.length), MAX_SLIDER_ANGLE)
    pencil = fit_pencil(fits.poses, fits.weights)
    return fits.blur(pencil.noise, pencil.gap)
