"""A mechanism that exists, at the poses of a task: where it is nearest to them, and if it works.

Nothing is refined.  For all its drivers every branch is looked at, and the body placed on it as
near to each pose as it comes.  What kind of mechanism it is does not matter here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Finding, InputError
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.linkages.misses import Misses
from burmester.mechanisms.branches import Branch, branches_of
from burmester.mechanisms.circuits import circuits_of
from burmester.mechanisms.contract import body_of
from burmester.mechanisms.defect_messages import (
    PoseNames,
    branch_defect,
    circuit_defect,
    in_another_order,
    pose_numbers,
)
from burmester.mechanisms.nearest_places import least_along, minima_of, nearest_shares
from burmester.mechanisms.pose_order import (
    REPEATED_POSE_STEP,
    OrderTolerance,
    PoseOrder,
    along_interval,
    around_circuit,
    smallest_arc,
    tolerated_step,
)
from burmester.mechanisms.transmission import DEAD_POINT_ANGLE, least_transmission_angle
from burmester.numerics.arrays import ComplexArray, FloatArray, weights_or_ones, wrapped_angle
from burmester.refinement.tolerance_boxes import EXACT_ROUNDING, counted_error, shares_used
from burmester.sixbar.candidates import box_diagonal, figures_of, merit_of, steps_along
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.kinds import SixBar
from burmester.sixbar.requirement_check import least_bars, shortcomings, violations
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import outside, too_far_from
from burmester.verdicts.requirement_check import too_short

ALIKE = 1e-6  # sizes of the motion; errors that differ by less are one
MERIT_DIGITS = 6  # decimals of a degree by which branches are compared


@final
class _OneDriver(NamedTuple):
    """What a mechanism does at poses (N,) on its branches (k,) with one driver.

    drive: (k, N), the driver's angle at the poses, without jumps; room: (k, 2), how far it goes on
    below and above.  missed: (k, N), in what is allowed.  combined: (k,), the error of all poses in
    one.  shares: (k, N, 3), of the tolerances that are used, where these decide.
    transmission, extent: (k,), over the range; at_poses: (k, N), the transmission there.
    """

    branches: tuple[Branch, ...]
    drive: FloatArray
    room: FloatArray
    errors: list[PoseError]
    missed: FloatArray
    combined: FloatArray
    shares: FloatArray | None
    out_of_order: NDArray[np.bool_]
    at_poses: FloatArray
    transmission: FloatArray
    extent: FloatArray


@final
class _Verdict(NamedTuple):
    """One branch, and what is wrong with it.

    far: how far the poses are on the whole, the mean of logarithms: of a branch that holds some
    poses the others, which are on another one, may be anywhere.
    """

    far: float
    combined: float
    merit: float
    driven: _OneDriver
    branch: int
    defects: tuple[Finding, ...]
    violations: tuple[Finding, ...]
    shortcomings: tuple[str, ...]


def judged_six_bar(
    linkage: SixBar, problem: SynthesisProblem, pivots: Sequence[str] | None = None
) -> FoundSixBar:
    """A six-bar on the branch where it works, else on that where it is nearest to the poses.

    Of branches on which it works the nearest one; of equally near ones, that with the greater least
    transmission angle, as a search chooses between drivers.
    pivots: of the drivers; all if None.  Raises E155 where it cannot be assembled.
    """
    task = problem.given
    number = task.poses.shape[0]
    measure = PoseMeasure(task.poses, task.tolerances, problem.length_per_radian, problem.length)
    circuits = circuits_of(linkage)
    if not len(circuits.first):
        raise InputError(
            "E155",
            "the six-bar cannot be assembled at any place",
            why=linkage.why_open(),
            help="measure its joints again; those of each link are in the frame of the link",
        )
    minima = minima_of(linkage, circuits, measure, number)
    every: list[_Verdict] = []
    for pivot in linkage.skeleton.drivers if pivots is None else pivots:
        branches = branches_of(linkage, circuits, pivot)
        if branches:
            near = nearest_shares(linkage, branches, minima, measure, number, tie=_tie(problem))
            driven = _driven(linkage, branches, *near, problem)
            every += [_verdict(linkage, driven, k, problem) for k in range(len(branches))]
    return _found(linkage, _best(every, problem), problem)


def _best(every: list[_Verdict], problem: SynthesisProblem) -> _Verdict:
    """The branch to tell of."""
    good = [each for each in every if not (each.defects or each.violations)]
    if good:
        most = min(each.combined for each in good) + _tie(problem)
        near = [each for each in good if each.combined <= most]
        return max(near, key=lambda each: round(each.merit, MERIT_DIGITS))  # of equals the first

    def order(each: _Verdict) -> tuple[float, int, int, float]:
        alike = round(each.far / ALIKE)
        merit = round(each.merit, MERIT_DIGITS)
        return alike, len(each.defects), len(each.violations), -merit

    return min(every, key=order)


def _driven(
    linkage: SixBar,
    branches: tuple[Branch, ...],
    shares: FloatArray,
    off: FloatArray,
    problem: SynthesisProblem,
) -> _OneDriver:
    """A mechanism on its branches (k,), at the shares (k, N) that are nearest to the poses."""
    task, rows = problem.given, list(enumerate(branches))
    joints = np.array([each.at_share(linkage, shares[k]) for k, each in rows])
    places = body_of(linkage, joints)
    errors = [counted_error(places[k], task) for k, _ in rows]
    size, radian = problem.length, problem.length_per_radian
    misses = Misses.of(places, errors, task, radian, size=size)
    at_poses = np.array([each.drive(linkage, shares[k]) for k, each in rows])
    turns = np.array([each.turns for each in branches])
    order = _along(at_poses, places, turns, misses.slack, problem)
    drive = order.along
    ranges = np.stack([drive.min(axis=-1), drive.max(axis=-1)], axis=-1)
    ends = np.array([each.ends for each in branches])
    weights = weights_or_ones(task.weights, task.poses.shape)
    ranged = [_over_range(linkage, each, ranges[k]) for k, each in rows]
    return _OneDriver(
        branches=branches,
        drive=drive,
        room=np.abs(ends - ranges),
        errors=errors,
        missed=misses.missed / misses.reach,
        combined=np.sqrt((off**2 @ weights) / weights.sum()),
        shares=misses.shares,
        out_of_order=order.is_another,
        at_poses=least_transmission_angle(linkage.skeleton, joints, branches[0].pivot),
        transmission=np.array([least for least, _ in ranged]),
        extent=np.array([extent for _, extent in ranged]),
    )


def _over_range(linkage: SixBar, branch: Branch, ends: FloatArray) -> tuple[float, float]:
    """The least transmission angle between two drives, and the box around all joints."""

    def transmission(joints: ComplexArray) -> FloatArray:
        return least_transmission_angle(linkage.skeleton, joints, branch.pivot)

    low, high = branch.share(linkage, ends).tolist()
    extent = box_diagonal(branch.at(linkage, steps_along(ends[None])[0]))
    return least_along(linkage, branch, low, high, transmission), float(extent)


def _along(
    drives: FloatArray,
    places: Displacement,
    turns: NDArray[np.int_],
    slack: FloatArray,
    problem: SynthesisProblem,
) -> PoseOrder:
    """The drives (k, N) of the poses without jumps, and how far they go back.

    A pose that comes again counts once.
    turns: (k,), of the driver until all is as it was, 0 between dead points.
    """
    motion = problem.motion
    if problem.is_merged and motion is not None:
        distinct = replace(problem, given=problem.task, motion=None)
        once = _along(drives[:, motion.first], places[:, motion.first], turns, slack, distinct)
        return once._replace(along=once.along[:, motion.group])
    ones, closed = np.ones(len(drives)), turns > 0
    period = np.maximum(turns, 1)[:, None]  # of a closed branch, in turns
    if problem.given.requirements.any_order:
        around = period * smallest_arc(drives / period)
        return PoseOrder(np.where(closed[:, None], around, drives), 0 * ones, 0 * ones)
    everywhere = np.ones(drives.shape, dtype=bool)
    tolerance = OrderTolerance(slack, problem.length_per_radian)
    step = tolerated_step(places, everywhere, drives, tolerance)
    lines = along_interval(drives, ones, step)
    rounds = around_circuit(drives / period, step / period[:, 0])
    return PoseOrder(
        np.where(closed[:, None], period * rounds.along, lines.along),
        np.where(closed, rounds.back, lines.back),
        np.where(closed, rounds.slack, lines.slack),
    )


def _verdict(linkage: SixBar, driven: _OneDriver, k: int, problem: SynthesisProblem) -> _Verdict:
    """What is wrong with one branch."""
    task, full = problem.given, driven.branches[k].turns > 0
    size, least = problem.motion_size, least_bars(problem, linkage.skeleton)
    figures = figures_of(linkage, driven.transmission[k], full, driven.extent[k])
    return _Verdict(
        far=float(np.log1p(driven.missed[k]).mean()),
        combined=float(driven.combined[k]),
        merit=float(merit_of(figures, size)),
        driven=driven,
        branch=k,
        defects=(
            *_defects(driven, k, task),
            *(Finding("degenerate", each) for each in too_short(linkage.lengths(), least, task)),
        ),
        violations=violations(linkage, figures, task, size),
        shortcomings=shortcomings(figures, size, task),
    )


def _defects(driven: _OneDriver, k: int, task: Task) -> Iterator[Finding]:
    """Why one branch does not lead through the poses of a task in order, missed poses first."""
    branch, met, any_order = driven.branches[k], ~(driven.missed > 1), task.requirements.any_order
    same = np.array([each.circuit == branch.circuit for each in driven.branches])
    here, missed = met[k], ~met[k]
    locked = missed & met[same].any(axis=0) & here.any()  # met on another branch of the circuit
    apart = missed & met.any(axis=0) & here.any() & ~locked  # on another circuit
    given = task.names or ("",) * len(here)
    names = tuple(name or str(number) for number, name in enumerate(given, start=1))
    told = PoseNames(names)
    if far := pose_numbers(missed & ~locked & ~apart):
        shares = driven.shares
        text = (
            too_far_from(far, driven.errors[k], task)
            if shares is None
            else outside(far, shares[k], names)
        )
        yield Finding("assembly", text, far)
    elsewhere = missed.astype(np.int8)
    if apart.any():
        on = here | apart
        yield circuit_defect(
            on, elsewhere, 0, any_order=any_order, names=told, other_name="another"
        )
    if locked.any():
        yield branch_defect(here | locked, elsewhere, any_order=any_order, names=told)
    if stuck := pose_numbers(here & (driven.at_poses[k] < DEAD_POINT_ANGLE)):
        text = f"is at a dead point at {told.phrase(stuck)}"
        yield Finding("branch", text, stuck, certain=False)
    if driven.out_of_order[k] and not (locked | apart).any():  # an order is that of one branch
        steps = np.round(driven.drive[k] / REPEATED_POSE_STEP)
        yield in_another_order(np.arange(len(steps)), steps, told, all_round=branch.turns > 0)


def _found(linkage: SixBar, best: _Verdict, problem: SynthesisProblem) -> FoundSixBar:
    driven, k, task = best.driven, best.branch, problem.given
    turns = float(np.round(driven.drive[k, 0] / (2 * np.pi)))
    found = FoundSixBar(
        id="S1",
        linkage=linkage,
        branch=driven.branches[k].moved(-turns),
        drive=driven.drive[k] - 2 * np.pi * turns,
        room=driven.room[k],
        transmission=float(driven.transmission[k]),
        extent=float(driven.extent[k]),
        error=driven.errors[k],
        shortcomings=best.shortcomings,
        chain=0,
        defects=best.defects,
        violations=best.violations,
        within_tolerance=None
        if task.tolerances is None
        else shares_used(driven.errors[k].places, task, problem.length),
        task=task,
    )
    if task.loads is None:
        return found
    from burmester.loads.load_figures import loaded  # noqa: PLC0415  few tasks have loads

    return loaded(found)


def _by_tolerances(problem: SynthesisProblem) -> bool:
    """Whether tolerances decide how far a pose may be missed."""
    tolerances = problem.given.tolerances
    return tolerances is not None and tolerances.gives_room


def _tie(problem: SynthesisProblem) -> float:
    """The difference below which distances from poses are one."""
    return ALIKE * (1.0 if _by_tolerances(problem) else problem.motion_size)


@final
class PoseMeasure(NamedTuple):
    """What is made least at poses (N,).

    The position error, and the angle's as if `length` a radian; components that tolerances leave
    free count as none.  Where these give room, the greatest share of a tolerance that is used.
    size: of the motion, by which the rounding of exact components is measured.
    """

    poses: Displacement
    tolerances: PoseTolerances | None
    length: float
    size: float

    def at(self, index: NDArray[np.intp]) -> PoseMeasure:
        """That of some poses."""
        some = None if self.tolerances is None else self.tolerances.at(index)
        return self._replace(poses=self.poses[index], tolerances=some)

    def __call__(self, places: Displacement) -> FloatArray:
        """Of places (*, N), or (*, 1) for all poses: (*, N); infinite where there is no place."""
        if self.tolerances is None:
            gap = places.translation - self.poses.translation
            turn = wrapped_angle(places.angle - self.poses.angle)
            off = np.hypot(np.hypot(gap[..., 0], gap[..., 1]), self.length * turn)
        elif self.tolerances.gives_room:
            rounding = EXACT_ROUNDING * np.array([self.size, self.size, 1.0])
            off = self.tolerances.share(places, self.poses, rounding).max(axis=-1)
        else:
            away = self.tolerances.deviations(places, self.poses)
            away = np.where(self.tolerances.free, 0.0, away)
            off = np.linalg.norm(away * [1.0, 1.0, self.length], axis=-1)
        off = np.where(np.isfinite(places.angle), off, np.inf)
        return np.asarray(np.nan_to_num(off, nan=np.inf))
