"""Refinement of function generators by the error of the true output angle, with bounded sizes.

Freudenstein's residual weighs an error by the links and by the transmission angle, so its minima
are starts only.  From them Levenberg's and Marquardt's steps lead to the least sum of squared
errors of the output angle; reweighting by Lawson's rule goes on to the least greatest error.
C. L. Lawson, Contributions to the theory of linear least maximum approximation, thesis, UCLA, 1961.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.functions.function_task import FunctionTask
from burmester.functions.generator import Generator
from burmester.numerics.arrays import FloatArray
from burmester.numerics.least_squares import Kernel, levenberg_marquardt
from burmester.numerics.unique_rows import unique_index

__all__ = ["MOST_SIZE", "at_bounds", "different", "least_squares", "minimax"]

MOST_SIZE: Final = 10.0  # ground links; no link is longer, and none shorter than its inverse
AT_BOUND = 1e-3  # of the logarithm of that; a length as near to it is at it
BEGIN_INSIDE = 0.999  # of the same; starts are brought within it
SAME_GENERATOR = 1e-5  # of a link, and radians; generators that differ less are one
LAWSON_STEPS = 12  # that tell which errors are the greatest
LEVELLING_STEPS = 20  # of Newton's method on these being equal, at most
LEVEL = 1e-9  # relative; greatest errors that differ less are equal
SINGULAR = 1e-10  # of the greatest singular value; below it one is zero
LEAST_WEIGHT = 1e-12  # of all; a pair's weight does not vanish, for its error may grow again


def least_squares(start: Generator, task: FunctionTask) -> tuple[Generator, NDArray[np.bool_]]:
    """Generators (k,) at the least sums of squares downhill of starts, and which have arrived.

    Of starts that are open at one of the pairs nothing comes of: they are left out of the second.
    """
    share = np.ones(len(task.inputs)) if task.weights is None else task.weights
    weights = np.broadcast_to(share / share.sum(), (len(start), len(share)))
    return _descended(start, task, weights)


def minimax(start: Generator, task: FunctionTask) -> Generator:
    """Generators (k,) whose greatest error over the pairs is least, from those of least squares.

    Lawson's rule tells which errors are the greatest, Newton's method makes them equal.  Of all
    steps the best counts, so no greatest error is above that of the start.
    """
    here, best, least = start, start, _worst(start, task)
    share = np.ones(len(task.inputs)) if task.weights is None else task.weights
    weights = np.tile(share / share.sum(), (len(start), 1))
    for _ in range(LAWSON_STEPS):
        error = np.abs(here.error(task.inputs, task.outputs))
        weights = weights * np.where(np.isfinite(error), error, 0.0)
        weights = np.maximum(weights / weights.sum(axis=1, keepdims=True), LEAST_WEIGHT)
        here, _ = _descended(here, task, weights)
        worst = _worst(here, task)
        best, least = _chosen(worst < least, here, best), np.minimum(worst, least)
    levelled = _levelled(best, task)
    return _chosen(_worst(levelled, task) < least, levelled, best)


def _levelled(start: Generator, task: FunctionTask) -> Generator:
    """Generators (k,) whose greatest errors alternate at one level, one by one, where that works.

    At each step the greatest error of every run of one sign is taken, one more than there are
    unknowns; Newton's method leads to where these are equal in size.
    """
    free = 3 + task.free_phases
    unknowns = _unknowns(start)
    kernel = _kernel(task, start.side, np.ones((len(start), len(task.inputs))))
    for row in range(len(start)):
        best, least = unknowns[row], np.inf
        here = best
        for _ in range(LEVELLING_STEPS):
            (error,), (jacobian,) = kernel(here[None])
            worst = np.abs(error).max()
            if not worst < (1 - LEVEL) * least:
                break
            best, least = here, worst
            at = _alternation(error, free + 1)
            if len(at) <= free:
                break
            sign = np.sign(error[at])
            matrix = np.concatenate([jacobian[at, :5], -sign[:, None]], axis=1)
            step = np.linalg.lstsq(matrix, -error[at], rcond=SINGULAR)[0]
            here = here + np.append(step[:5], 0.0)
        unknowns[row] = best
    return _generator(unknowns, start.side)


def _alternation(error: FloatArray, count: int) -> NDArray[np.intp]:
    """Where errors (N,) of alternate sign are the greatest, `count` places at most."""
    runs = np.split(np.arange(len(error)), np.flatnonzero(np.diff(np.sign(error))) + 1)
    at = np.array([run[np.abs(error[run]).argmax()] for run in runs])
    while len(at) > count:  # the signs alternate still if one of the ends goes
        at = at[1:] if np.abs(error[at[0]]) < np.abs(error[at[-1]]) else at[:-1]
    return at


def different(generators: Generator) -> NDArray[np.bool_]:
    """Which of generators (k,) repeat no earlier one."""
    g = generators
    angles = np.exp(1j * np.stack([g.input_phase, g.output_phase], axis=-1))
    columns = [np.log(g.sizes[..., 1:]), angles.real, angles.imag, g.side[..., None]]
    return unique_index(np.concatenate(columns, axis=-1), SAME_GENERATOR, "maximum")


def at_bounds(generators: Generator) -> NDArray[np.bool_]:
    """Which of generators (k,) have a link of the greatest or the least size allowed."""
    size = np.abs(np.log(generators.sizes)).max(axis=-1)
    return np.asarray(np.abs(size - np.log(MOST_SIZE)) < AT_BOUND * np.log(MOST_SIZE))


def _worst(generators: Generator, task: FunctionTask) -> FloatArray:
    """The greatest error (k,); infinite where the linkage is open at a pair."""
    error = np.abs(generators.error(task.inputs, task.outputs)).max(axis=-1)
    return np.where(np.isnan(error), np.inf, error)


def _chosen(mask: NDArray[np.bool_], one: Generator, other: Generator) -> Generator:
    names = Generator.__match_args__
    return Generator(*(np.where(mask, getattr(one, n), getattr(other, n)) for n in names))


def _descended(
    start: Generator, task: FunctionTask, weights: FloatArray
) -> tuple[Generator, NDArray[np.bool_]]:
    """Generators (k,) at the least sums of squared errors, with weights (k, N) of each."""
    kernel = _kernel(task, start.side, np.sqrt(weights))
    descent = levenberg_marquardt(kernel, _unknowns(start))
    return _generator(descent.x, start.side), np.isfinite(descent.cost)


def _unknowns(generators: Generator) -> FloatArray:
    """The unknowns (k, 6) of generators: see `_generator`; the last one is the number of the row.

    It tells the kernel, which sees some of the rows, which they are.
    """
    sizes = np.log(generators.sizes[:, 1:]) / np.log(MOST_SIZE)
    parts = [
        np.arcsin(np.clip(sizes, -BEGIN_INSIDE, BEGIN_INSIDE)),
        np.stack([generators.input_phase, generators.output_phase], axis=-1),
        np.arange(len(generators))[:, None],
    ]
    return np.concatenate(parts, axis=-1)


def _generator(x: FloatArray, side: FloatArray) -> Generator:
    """The generators of unknowns (k, 6): logarithms of the links over the bound, and phases."""
    # The sines of the first three are the logarithms, so no step leads beyond the bound.
    a, r, b = np.exp(np.log(MOST_SIZE) * np.sin(x[:, :3])).T
    return Generator(a, r, b, x[:, 3], x[:, 4], side)


def _kernel(task: FunctionTask, side: FloatArray, roots: FloatArray) -> Kernel:
    """The weighted errors (k, N) of unknowns (k, 6), and their derivatives (k, N, 6).

    The derivatives are those of the loop's equation |B - A|² = r², which holds throughout.
    """

    def errors(x: FloatArray) -> tuple[FloatArray, FloatArray]:
        row = x[:, 5].astype(int)
        here, root = _generator(x, side[row]), roots[row]
        error = here.error(task.inputs, task.outputs)
        theta = here.input_phase[:, None] + task.inputs
        phi = here.output_phase[:, None] + task.outputs + error
        a, r, b = (v[:, None] for v in (here.input_link, here.coupler, here.output_link))
        between = theta - phi
        by_phi = -2 * b * np.sin(phi) - 2 * a * b * np.sin(between)
        by_theta = 2 * a * np.sin(theta) + 2 * a * b * np.sin(between)
        by_a = 2 * a - 2 * np.cos(theta) - 2 * b * np.cos(between)
        by_b = 2 * b + 2 * np.cos(phi) - 2 * a * np.cos(between)
        jacobian = np.zeros((*error.shape, 6))
        slope = np.log(MOST_SIZE) * np.cos(x[:, None, :3])
        for k, by_length in enumerate((by_a * a, -2 * r * r, by_b * b)):
            jacobian[..., k] = -by_length / by_phi * slope[..., k]
        if task.input_phase is None:
            jacobian[..., 3] = -by_theta / by_phi
        if task.output_phase is None:
            jacobian[..., 4] = -1.0
        return root * error, root[..., None] * jacobian

    return errors
