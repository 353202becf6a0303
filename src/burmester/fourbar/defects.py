"""Defects: the reasons why a linkage does not lead its coupler through the poses.

Chase and Mirth's defects (Circuits and branches of single-degree-of-freedom planar linkages,
Journal of Mechanical Design 115, 1993): assembly (the linkage cannot be assembled at a pose),
circuit (the poses are on different circuits), branch (the driver locks at a dead point between
two poses), order (the poses come in another order).  All verdicts come from the exact circuits
(see `traversal`), none from sampling.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final, final

import numpy as np

from burmester.errors import Finding
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.traversal import DrivenView, PoseRange, Traversal, first_where, traversed
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.defect_messages import (
    UNSURE,
    PoseNames,
    assembly_defects,
    branch_defect,
    circuit_defect,
    in_another_order,
    undetermined_defect,
)
from burmester.mechanisms.pose_order import (
    CERTAIN_STEP_BACK,
    REPEATED_POSE_STEP,
    BoolArray,
    OrderTolerance,
)
from burmester.mechanisms.transmission import DEAD_POINT_ANGLE
from burmester.numerics.arrays import FloatArray, concatenate

# Degrees.  A smaller distance from a dead point is not worth a number in a message.
SHOWN_ANGLE: Final = 1e-4


@final
@dataclass(frozen=True, slots=True, eq=False)
class Driven:
    """The motion of a linkage between the first and the last pose, driven by one of its dyads.

    defects: branch and order.
    circuit: the number, in `Circuits.of` of this driver and as given, of the circuit with the most
        poses (of two with the same number, the one with the first pose); -1 if undetermined.
    turns_fully: whether the driver turns through full turns there, without dead points.
    transmission: (N,), transmission angles at the poses, radians, on either circuit; nan where
        there is no place.
    least_at_poses: the least of these.
    least_over_range: the least over the range between the poses of that circuit: exact, not
        sampled.
    parameter: (N,), of the poses along the circuit (see `Circuits`), unwrapped; nan for poses off
        the circuit.
    inputs: (N,), of the driver (see `loop_closure`) at the poses, unwrapped, radians or a length.
    input_range: (2,), the least and the greatest input in that range.

    Where the poses come in their order, the range runs through them in that order.  Else it is
    the smallest range that contains them all.  Where either sense, or any order, is allowed, a
    range that stays clear of dead points is preferred.
    """

    defects: tuple[Finding, ...]
    circuit: int
    turns_fully: bool
    transmission: FloatArray
    least_at_poses: float
    least_over_range: float
    inputs: FloatArray
    input_range: FloatArray
    parameter: FloatArray

    def rank(self, violated: int = 0) -> tuple[float, ...]:
        """By which the better of two drivers is told, the less the better; no rounding decides.

        violated: how many requirements it does not keep.
        """
        least, poses = self.least_over_range, sum(len(each.poses) for each in self.defects)
        weak = 0.0 if math.isnan(least) else -round(least, 6)
        return len(self.defects), violated, poses, 0.0 if self.turns_fully else 1.0, weak


@final
@dataclass(frozen=True, slots=True, eq=False)
class Verdict:
    """The defects of one linkage.

    defects: assembly and circuit, which do not depend on the driver.
    first, second: the motion driven by the first and by the second dyad.
    """

    defects: tuple[Finding, ...]
    first: Driven
    second: Driven


def judge(
    linkage: Linkage | LinkageBatch,
    places: Displacement,
    *,
    missed: FloatArray,
    reach: float | FloatArray,
    length: float | None = None,
    names: Sequence[str] | None = None,
    any_order: bool = False,
    order_slack: FloatArray | None = None,
) -> list[Verdict]:
    """The verdicts on linkages (k,), for either driver: a batch, or of one pair of kinds.

    places: (k, N), the coupler's places nearest to the poses, in their order; nan where there is
        none: such poses are left out of the other verdicts.
    missed: (k, N), the distances of the poses from their places; a distance above `reach` is an
        assembly defect.  Both in the unit in which distances between poses are measured; reach may
        be one of each linkage, (k, 1).
    length: the length that a radian counts as in `missed`; None: the poses have an order however
        far they are missed.
    names: names of the poses in messages, instead of their numbers from 1.
    any_order: whether the poses may be met in any order.
    order_slack: (k,), poses nearer than this along the circuit have no order; by default twice the
        greatest distance by which a pose is missed.  Needed where `missed` is no distance.

    A branch defect is certain except within DEAD_POINT_ANGLE of a dead point, and where a linkage
    within 1e-9 of a change point passes it.  Such a linkage is taken as given (see `Circuits.of`);
    poses on one piece of it between change points make no defect.

    Order is judged along the branch or, where the driver turns fully, in either sense within one
    turn; with a branch defect, along the circuit, as if the linkage were helped over the dead
    point.  Poses less than REPEATED_POSE_STEP apart have no order.  Nor do poses nearer to each
    other along the circuit than twice the greatest distance by which a pose is missed: at the place
    half way between them each would be missed by no more than that.  A step back of less than
    CERTAIN_STEP_BACK is an order defect that is not certain.
    """
    count = len(places.angle)
    if not count:
        return []
    rows = np.tile(np.arange(count), 2)
    view = DrivenView.along(_both_driven(linkage), places[rows])
    change = view.circuits.near_change_point[:count, 0]
    assembled = np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1)
    one, other = np.split(view.location.circuit, 2)
    labels = np.where(one < 0, other, one)
    least = np.fmin(*np.split(view.transmission, 2))
    weak = change[:, None] & (least < DEAD_POINT_ANGLE)
    clear = assembled & (labels >= 0) & ~weak
    met = [(clear & (labels == number)).sum(axis=1) for number in (0, 1)]
    first_met = np.take_along_axis(labels, first_where(clear, assembled)[:, None], axis=1)[:, 0]
    main = np.where(met[0] == met[1], first_met, met[1] > met[0])
    on = assembled & ((labels == main[:, None]) | weak)

    pose_names = PoseNames(names)
    common: list[list[Finding]] = [[] for _ in assembled]
    far = ~(missed <= reach) | ~assembled
    for k in np.flatnonzero(far.any(axis=1)):
        common[k] += assembly_defects(far[k], assembled[k], missed[k], pose_names)
    for k in np.flatnonzero((met[0] > 0) & (met[1] > 0)):
        common[k].append(
            circuit_defect(
                clear[k],
                labels[k],
                int(main[k]),
                change=bool(change[k]),
                any_order=any_order,
                names=pose_names,
            )
        )
    distance = np.zeros(len(assembled))
    if order_slack is not None:
        distance = order_slack
    elif length is not None:
        distance = 2 * np.where(assembled, np.minimum(missed, reach), 0.0).max(axis=1)
    tolerance = OrderTolerance(distance[rows], length or 0.0)
    motion = traversed(view, on[rows], tolerance, any_order)
    driven = _driven(motion, view, on[rows], any_order, pose_names)
    return [
        Verdict(tuple(defects), a, b)
        for defects, a, b in zip(common, driven[:count], driven[count:], strict=True)
    ]


def _both_driven(linkage: Linkage | LinkageBatch) -> Circuits:
    """The circuits (2 k, 2) of linkages (k,) driven by their first dyads, then by their second."""
    if isinstance(linkage, LinkageBatch):
        return Circuits.of(concatenate([linkage, linkage.exchanged()]), as_given=True)
    sides = (linkage, Linkage(linkage.second, linkage.first))
    return Circuits.joined([Circuits.of(side, as_given=True) for side in sides])


def _driven(
    motion: tuple[Traversal, PoseRange],
    view: DrivenView,
    on: BoolArray,
    any_order: bool,
    names: PoseNames,
) -> list[Driven]:
    """The motions of linkages (k,), each with one driver; on: the poses (k, N) that are judged."""
    traversal, ranged = motion
    on_circuit, circuits, order = traversal.on_circuit, traversal.circuits, traversal.order
    parameter = np.where(on_circuit, order.along, np.nan)
    some = on_circuit.any(axis=1)
    turns_fully = circuits.turns_fully & some
    lowest = np.fmin.reduce(view.transmission, axis=1)

    defects: list[list[Finding]] = [[] for _ in range(len(on_circuit))]
    close = some & (ranged.least_transmission < DEAD_POINT_ANGLE)
    for k in np.flatnonzero(traversal.crosses_branches | close).tolist():
        if traversal.crosses_branches[k]:
            defects[k].append(
                branch_defect(
                    traversal.clear[k],
                    traversal.branch_key[k],
                    change=bool(circuits.near_change_point[k]),
                    any_order=any_order,
                    names=names,
                )
            )
        else:
            defects[k].append(_near_dead_point_defect(traversal, ranged, k, names))
    for k in np.flatnonzero(some & order.is_another).tolist():
        defects[k].append(_order_defect(traversal, ranged, k, names))
    for k in np.flatnonzero(on.any(axis=1) & ~some).tolist():
        defects[k].append(undetermined_defect(on[k]))
    return [
        Driven(
            tuple(defects[k]),
            int(traversal.circuit[k]),
            bool(turns_fully[k]),
            view.transmission[k],
            float(lowest[k]),
            float(ranged.least_transmission[k]),
            ranged.inputs[k],
            ranged.input_range[k],
            parameter[k],
        )
        for k in range(len(on_circuit))
    ]


def _near_dead_point_defect(
    traversal: Traversal, ranged: PoseRange, k: int, names: PoseNames
) -> Finding:
    """The uncertain defect of linkage k, whose range comes too near to a dead point."""
    at, worst, count = ranged.along[k], ranged.worst[k], traversal.on_circuit.shape[1]
    least = np.degrees(ranged.least_transmission[k])
    if worst < count:
        poses: tuple[int, ...] = (int(worst),)
        place = f"at {names.phrase(poses)}"
    else:
        along = at[:count]
        before = int(np.nanargmax(np.where(along <= at[worst], along, np.nan)))
        after = int(np.nanargmin(np.where(along >= at[worst], along, np.nan)))
        poses = tuple(sorted((before, after)))
        place = names.between([(poses[0], poses[1])])
    if traversal.circuits.near_change_point[k]:
        text = f"{'is at' if worst < count else 'passes'} a change point {place}"
    else:
        within = f"within {least:.1g}° of" if least > SHOWN_ANGLE else "to"
        text = f"comes {within} a dead point {place}"
    return Finding("branch", text + UNSURE, poses, certain=False)


def _order_defect(traversal: Traversal, ranged: PoseRange, k: int, names: PoseNames) -> Finding:
    """The defect of linkage k, which meets its poses in another order."""
    on_circuit, order = traversal.on_circuit[k], traversal.order
    # At a change point the linkage may go either way: it passes one where the range comes to it,
    # and wherever it goes from one branch to another.
    passed = ranged.least_transmission[k] < DEAD_POINT_ANGLE or traversal.crosses_branches[k]
    passed = passed and traversal.circuits.near_change_point[k]
    certain = order.back[k] > CERTAIN_STEP_BACK and not traversal.order_doubtful[k] and not passed
    poses = np.flatnonzero(on_circuit)
    steps = np.round(order.along[k][on_circuit] / (REPEATED_POSE_STEP * traversal.step_unit[k]))
    defect = in_another_order(poses, steps, names, all_round=bool(traversal.all_round[k]))
    return replace(defect, message=defect.message + UNSURE * (not certain), certain=bool(certain))
