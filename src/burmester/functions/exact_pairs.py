"""Three, four and five pairs of angles: all function generators that meet them exactly.

As many phases may be chosen as there are pairs beyond three.  With both phases given, three pairs
make Freudenstein's equation linear.  With one, four pairs leave a quadratic equation in the cosine
and sine of the other.  With none, five pairs are five poses of the output link as the input link
sees it, and the coupler is a dyad of these: of the four, one is always the ground link itself.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.five_poses import dyads_of_five
from burmester.functions.freudenstein import generators_of_ratios, ratios, rows
from burmester.functions.function_task import FunctionTask
from burmester.functions.generator import Generator
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["ExactGenerators", "exact_generators", "generators_of_phases", "other_phases"]

SINGULAR = 1e-9  # singular value of unit columns; below, infinitely many ratios fit the pairs
GROUND_LINK = 1e-5  # of the ground link: a dyad as near to it is the ground link itself
LONGEST = 1e6  # ground links; a longer link is a slider up to rounding


class ExactGenerators(NamedTuple):
    """All generators of exact pairs.

    generators: (k,), those of finite size.
    expected: how many solutions such pairs have, real or not.
    sliders: how many of the real ones have a link without end, or beyond LONGEST ground links.
    determined: False where there are infinitely many; then these are some of them at best.
    """

    generators: Generator
    expected: int
    sliders: int
    determined: bool


def exact_generators(task: FunctionTask) -> ExactGenerators:
    """All generators of a task with as many pairs as `exact_count` says.

    On the side of the diagonal where the errors are less: pairs on both sides are on two branches.
    """
    if task.input_phase is None and task.output_phase is None:
        return _five(task)
    if task.input_phase is not None and task.output_phase is not None:
        given, other = np.array([task.input_phase]), np.array([task.output_phase])
        found, determined = generators_of_phases(task, given, other)
        return _all(task, found, 1, determined=bool(determined.all()))
    known = "input" if task.input_phase is not None else "output"
    given = np.array([task.input_phase if known == "input" else task.output_phase], dtype=float)
    other, determined = other_phases(task, given, known)
    phases = (np.broadcast_to(given[:, None], other.shape), other)
    found, regular = generators_of_phases(task, *(phases if known == "input" else phases[::-1]))
    some = np.isfinite(other).ravel()
    sure = bool(determined.all() and regular.ravel()[some].all())
    return _all(task, found[np.nonzero(some[None])] if some.any() else found[:, :0][0], 2, sure)


def generators_of_phases(
    task: FunctionTask, input_phase: FloatArray, output_phase: FloatArray
) -> tuple[Generator, NDArray[np.bool_]]:
    """The generators (*,) with phases (*,), of the least residual, and whether they are determined.

    nan where the ratios have no linkage.
    """
    theta = input_phase[..., None] + task.inputs
    phi = output_phase[..., None] + task.outputs
    found, least = ratios(theta, phi, task.weights)
    return generators_of_ratios(found, input_phase, output_phase), least > SINGULAR


def other_phases(
    task: FunctionTask, given: FloatArray, known: str
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """The other phases (*, 2) with which four pairs fit a given phase (*,), within half a turn.

    The four equations have a solution where their determinant vanishes; two of its columns are
    linear in the cosine and sine of the phase.
    known: "input" or "output", the phase that is given.
    Returns nan where there are none, and whether the determinant is not zero throughout, (*,).
    """
    x, y = task.inputs, task.outputs
    columns = []
    for turn in (0.0, np.pi / 2):  # the phase's cosine is 1, its sine is 1
        if known == "input":
            columns.append(rows(given[..., None] + x, np.asarray(turn) + y))
        else:
            columns.append(rows(np.asarray(turn) + x, given[..., None] + y))
    moving = 0 if known == "input" else 1

    def determinant(first: int, second: int) -> FloatArray:
        matrix = columns[0].copy()
        matrix[..., moving] = columns[first][..., moving]
        matrix[..., 3] = columns[second][..., 3]
        return np.asarray(np.linalg.det(matrix))

    a, c = determinant(0, 0), determinant(1, 1)
    b = determinant(0, 1) + determinant(1, 0)
    # a cos² + b cos sin + c sin² = 0, in the double angle
    size = np.hypot(a - c, b)
    with np.errstate(invalid="ignore", divide="ignore"):
        half = np.arccos(-(a + c) / size)
    middle = np.arctan2(b, a - c)
    phases = np.stack([middle + half, middle - half], axis=-1) / 2
    return phases, size + np.abs(a + c) > SINGULAR**2


def _five(task: FunctionTask) -> ExactGenerators:
    """By the five poses of the output link in the frame of the input link."""
    turn = np.exp(-1j * task.inputs)
    poses = np.stack([turn.real, turn.imag, task.outputs - task.inputs], axis=-1)
    four = dyads_of_five(Displacement.from_poses(poses))
    dyads, real = four.dyads, four.real
    away = np.hypot(*dyads.fixed_pivot.T) + np.hypot(*dyads.moving_pivot.T)
    away = away + np.abs(dyads.radius - 1)
    other = real & ~(away < GROUND_LINK)
    fixed, moving = dyads.fixed_pivot[other], dyads.moving_pivot[other]
    found = Generator(
        np.hypot(*fixed.T),
        dyads.radius[other],
        np.hypot(*moving.T),
        np.arctan2(fixed[:, 1], fixed[:, 0]),
        np.arctan2(moving[:, 1], moving[:, 0]),
        np.ones(len(fixed)),
    )
    return _all(task, found, 3, determined=bool(four.determined))


def _all(task: FunctionTask, found: Generator, count: int, determined: bool) -> ExactGenerators:
    found = found[np.isfinite(found.coupler) & np.isfinite(found.output_link)]
    finite = (found.sizes < LONGEST).all(axis=-1) & (found.sizes > 1 / LONGEST).all(axis=-1)
    sliders = int((~finite).sum())
    found = found[finite].with_better_side(task.inputs, task.outputs)
    return ExactGenerators(found, count, sliders, determined)
