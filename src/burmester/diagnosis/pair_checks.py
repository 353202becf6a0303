"""What looks wrong in pairs of angles, before any linkage is looked for.

W241 a pair that stands out, outputs that turn round too often, angles that may be radians
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Advice
from burmester.numerics.arrays import FloatArray
from burmester.tasks.function_task import FunctionTask
from burmester.wording import count, figure

MOST_REVERSALS: Final = 2  # of the output of a four-bar over a turn of its input
NEIGHBOURS: Final = 4  # pairs that a pair is compared with, by the cubic through them
FEWEST: Final = 8  # pairs; of fewer none stands out
STANDS_OUT: Final = 8.0  # times the median of the others' distances
LEAST_SHARE: Final = 0.005  # of the outputs' range; a smaller distance is none
EXPLAINS: Final = 0.3  # of its distance: what is left of the others' without that pair
SMALL_ANGLE: Final = 2 * math.pi  # degrees, of inputs and outputs; then they may be radians


def pair_findings(task: FunctionTask) -> tuple[Advice, ...]:
    """What stands out in the pairs of a task; nothing in those of a function."""
    if task.function is not None:
        return _turns(task)
    found = [*_turns(task)]
    if (odd := _odd_pair(task)) is not None:
        index, away = odd
        text = f"pair {index + 1} stands out, by {figure(math.degrees(away))} deg of its output"
        help = f"look at pair {index + 1} again, or leave it out"
        why = "the other pairs lie on a smooth curve, and it lies beside that"
        found = [Advice("W241", text, help, why)]
    inputs, outputs = np.degrees(task.inputs), np.degrees(task.outputs)
    if max(np.abs(inputs).max(), np.abs(outputs).max()) < SMALL_ANGLE:
        turned, made = figure(float(np.ptp(inputs))), figure(float(np.ptp(outputs)))
        found.append(
            Advice(
                "W241",
                f"the input turns by {turned} deg and the output by {made} deg",
                "if these are radians, name the columns input_rad and output_rad",
                "such small angles are often radians",
            )
        )
    return tuple(found)


def _turns(task: FunctionTask) -> tuple[Advice, ...]:
    inputs, outputs = task.compared()
    turns = reversals(inputs, outputs)
    if turns <= MOST_REVERSALS:
        return ()
    return (
        Advice(
            "W241",
            f"the output turns round {turns} times over the range",
            "take a shorter range of the input",
            "the output of a four-bar turns round where its input link and its coupler are in "
            f"line, {count(MOST_REVERSALS, 'time')} in a turn of the input at most; so no four-bar "
            "comes near all pairs",
        ),
    )


def reversals(inputs: FloatArray, outputs: FloatArray) -> int:
    """How often outputs (N,) turn round as the inputs (N,) grow; rounding is no turn."""
    steps = np.diff(outputs[np.argsort(inputs)])
    steps = steps[np.abs(steps) > 1e-9 * max(1e-300, float(np.ptp(outputs)))]
    return int((np.diff(np.sign(steps)) != 0).sum())


def _odd_pair(task: FunctionTask) -> tuple[int, float] | None:
    """The pair beside the curve of all others, and how far, radians; None where there is none.

    Each output is compared with the cubic through those of its four neighbours.  Beside an odd pair
    its neighbours are off as well, so it is odd only if without it none is.  Of the first and the
    last pair nothing is said: a curve may rise steeply there.
    """
    order = np.argsort(task.inputs)
    x, y = task.inputs[order], task.outputs[order]
    if len(x) < FEWEST:
        return None
    off = _distances(x, y)
    rest = np.arange(len(x))
    worst = max(rest[1:-1], key=lambda k: _left_without(x, y, int(k), off))
    kept = rest[rest != worst]
    after = np.abs(_distances(x[kept], y[kept]))
    away = abs(float(y[worst] - _predicted(x[kept], y[kept], float(x[worst]))))
    usual = max(float(np.median(after)), LEAST_SHARE * float(np.ptp(y)) / STANDS_OUT)
    if away > STANDS_OUT * usual and after.max() < EXPLAINS * away:
        return int(order[worst]), away
    return None


def _left_without(x: FloatArray, y: FloatArray, k: int, off: FloatArray) -> float:
    """How much less the squared distances of all are without pair k."""
    kept = np.arange(len(x)) != k
    return float((off**2).sum() - (_distances(x[kept], y[kept]) ** 2).sum())


def _distances(x: FloatArray, y: FloatArray) -> FloatArray:
    """How far each of y (N,), x rising, is from the cubic through its neighbours."""
    at = np.arange(len(x))
    return np.array([y[k] - _predicted(x[at != k], y[at != k], float(x[k])) for k in at])


def _predicted(x: FloatArray, y: FloatArray, at: float) -> float:
    """The cubic through the neighbours of a place: Lagrange's interpolation."""
    first = int(np.clip(np.searchsorted(x, at) - NEIGHBOURS // 2, 0, len(x) - NEIGHBOURS))
    near: NDArray[np.intp] = np.arange(first, first + NEIGHBOURS)
    total = 0.0
    for k in near:
        others = x[near[near != k]]
        total += float(y[k] * np.prod((at - others) / (x[k] - others)))
    return total
