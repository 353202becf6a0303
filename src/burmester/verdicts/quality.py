"""The quality of a linkage: what a designer pays for, once it meets its poses.

Three figures by which linkages are chosen: how well it transmits (greater is better), how much room
it takes, and how much worse it gets as it is built (less is better).  Others for who needs them.

One rule chooses by them: `best_first`, in words `rule`.  The smallest alone would have its pivots
side by side, where every error of a pin turns the body; the one that transmits best is often large.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven
from burmester.fourbar.instantaneous import mechanical_advantage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pivot_box import extent, reserve
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

SAME_TRANSMISSION = math.radians(0.5)  # an angle lower by no more counts as good
ENOUGH_TRANSMISSION = math.radians(60)  # beyond it a linkage runs no better
LEAST_EXTENT = 1.0  # spans of the motion; a smaller linkage is no better to build
PROPORTIONS = "product of extent (at least one span) and sensitivity"  # in words


def enough_transmission(asked: float) -> float:
    """The transmission angle beyond which more of it counts for nothing, in radians.

    asked: the least angle that a task asks for, radians; 0 where it asks for none.
    """
    return max(asked, ENOUGH_TRANSMISSION)


def proportions(extent: FloatArray, sensitivity: FloatArray) -> FloatArray:
    """The product (*,) of extent, in spans, and sensitivity, which is least in a good linkage.

    A linkage smaller than the motion counts as large as it: nothing is gained by one that is all
    but a single pin.
    """
    return np.asarray(np.maximum(extent, LEAST_EXTENT) * sensitivity)


def rule(enough: float = ENOUGH_TRANSMISSION) -> str:
    """The rule of `best_first`, as a sentence says it."""
    return (
        f"the one with the greatest least transmission angle, where more than "
        f"{math.degrees(enough):.3g}° counts as {math.degrees(enough):.3g}°; among those within "
        f"half a degree of it, the one with the least {PROPORTIONS}"
    )


@final
@dataclass(frozen=True, slots=True, eq=False)
class Quality:
    """Figures of linkages (*,), each with its driver, between the first and the last pose.

    Attributes
    ----------
    transmission : (*,) array of float
        The least transmission angle over the range, in radians: for sliders, too, the complement
        of the pressure angle.
    extent : (*,) array of float
        The diagonal of the box, parallel to the axes of F, that holds all pivots over the range,
        in sizes of the motion (`tasks.problem.SynthesisProblem.motion_size`).
    sensitivity : (*,) array of float
        The greatest position error at a pose per unit of error, to first order: all coordinates of
        pivots and all link lengths are off by up to that unit, in the worst way.  No unit.
    driver_turn : (*,) array of float
        How far the driver goes over the range, in radians, or a length where it slides.
    advantage : (*, 2) array of float
        The mechanical advantage at the first and at the last pose, as `mechanical_advantage` has
        it: the force at the origin of the body per torque of the driver (1 / length), or per force
        where the driver slides.
    reserve : (*, 2) array of float
        How far the driver goes on below and above the range of its input before it locks or comes
        to a change point, in radians or a length; infinite where nothing stops it.

    A figure that does not exist is nan: of a linkage whose motion is not determined.
    """

    transmission: FloatArray
    extent: FloatArray
    sensitivity: FloatArray
    driver_turn: FloatArray
    advantage: FloatArray
    reserve: FloatArray

    @classmethod
    def of(
        cls,
        batch: LinkageBatch,
        places: Displacement,
        driven: Sequence[Driven],
        sensitivity: FloatArray,
        *,
        size: float,
    ) -> Self:
        """The quality of linkages (k,) that their first dyads drive.

        places: (k, N), the linkages' nearest to the poses; driven: their motions there.
        sensitivity: (k,), the greatest of `tolerances.sensitivity_bound`; size: of the motion.
        """
        circuits, inputs, reach = reached(batch, driven)
        reach, room = reach / size, reserve(circuits, inputs)
        advantage, ends = np.empty((len(batch), 2)), places[:, [0, -1]]
        for index, linkage in batch.alike():
            advantage[index] = mechanical_advantage(linkage, ends[index])
        transmission = np.array([each.least_over_range for each in driven])
        turn = np.ptp(inputs, axis=1)
        return cls(transmission, reach, sensitivity, turn, advantage, room)


def reached(
    batch: LinkageBatch, driven: Sequence[Driven]
) -> tuple[Circuits, FloatArray, FloatArray]:
    """Where linkages (k,) go that their first dyads drive: circuits, ranges (k, 2) of the input.

    With the diagonals (k,) of the boxes that hold all pivots then.
    """
    inputs = np.array([each.input_range for each in driven]).reshape(-1, 2)
    along = np.array([each.parameter for each in driven]).reshape(len(batch), -1)
    ends = [end.reduce(along, axis=1, initial=np.nan) for end in (np.fmin, np.fmax)]
    number = np.array([max(each.circuit, 0) for each in driven], dtype=np.intp)
    circuits = Circuits.of(batch, as_given=True)[np.arange(len(batch)), number]
    return circuits, inputs, extent(circuits, np.stack(ends, axis=1), inputs)


def best_first(
    transmission: FloatArray,
    extent: FloatArray,
    sensitivity: FloatArray,
    *,
    enough: float = ENOUGH_TRANSMISSION,
) -> NDArray[np.intp]:
    """The order (n,) of linkages by the rule, the recommended one first.

    The rule is applied again to those that are left, so that each place has a linkage as the
    recommended one of the rest.  Equal ones stay as they come.
    transmission: (n,), radians; extent: (n,), spans of the motion; sensitivity: (n,), any unit.
    nan is the worst of all.
    enough: radians; more transmission counts as that much.
    """
    transmission = np.minimum(np.nan_to_num(transmission, nan=-np.inf), enough)
    left = np.argsort(np.nan_to_num(proportions(extent, sensitivity), nan=np.inf), kind="stable")
    order = []
    while len(left):
        near = transmission[left] >= transmission[left].max() - SAME_TRANSMISSION
        at = int(near.argmax())
        order.append(left[at])
        left = np.delete(left, at)
    return np.array(order, dtype=np.intp)
