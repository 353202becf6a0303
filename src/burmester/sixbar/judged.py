"""A six-bar that exists, at the poses of a task: where it is nearest to them, and whether it works.

Nothing is refined.  For both drivers every branch is looked at (`branches`), and the body placed
on it as near to each pose as it comes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.fourbar.defect_messages import Defect
from burmester.fourbar.pose_error import PoseError
from burmester.fourbar.pose_order import (
    REPEATED_POSE_STEP,
    OrderTolerance,
    PoseOrder,
    along_interval,
    around_circuit,
    smallest_arc,
    tolerated_step,
)
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import weights_or_ones
from burmester.refinement.tolerance_boxes import counted_error, shares_used
from burmester.requirements.table import Violation
from burmester.sixbar.branches import Branches, branches_of
from burmester.sixbar.candidates import DRIVERS, Candidates, extent_of
from burmester.sixbar.dead_points import FirstLoop
from burmester.sixbar.defects import ELSEWHERE, Course, defects_of
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.motion import joints_at, poses_of, transmission
from burmester.sixbar.nearest_places import PoseMeasure, nearest_drives
from burmester.sixbar.requirement_check import violations
from burmester.sixbar.standard import least_bars, shortcomings
from burmester.sixbar.travel import Travel, least_transmission
from burmester.sixbar.watt import Drive, WattLinkage
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.degeneracy import too_short
from burmester.verdicts.ranking import DEFAULT_TOLERANCE

__all__ = ["judged_six_bar"]

SHARE_ROUNDING = 1e-9  # relative; a tolerance that is exceeded by less is kept
ALIKE = 1e-6  # sizes of the motion; errors that differ by less are one
MERIT_DIGITS = 6  # decimals of a degree by which branches are compared


@final
class _OneDriver(NamedTuple):
    """What a six-bar does at poses (N,) on its branches (k,) with one driver.

    missed: (k, N), in what is allowed.  combined: (k,), the error of all poses in one.
    shares: (k, N, 3), of the tolerances that are used, where these decide.
    """

    branches: Branches
    candidates: Candidates
    errors: list[PoseError]
    missed: FloatArray
    combined: FloatArray
    shares: FloatArray | None
    out_of_order: NDArray[np.bool_]
    at_poses: FloatArray


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
    defects: tuple[Defect, ...]
    violations: tuple[Violation, ...]


def judged_six_bar(
    linkage: WattLinkage, problem: SynthesisProblem, drivers: Sequence[Drive] = DRIVERS
) -> FoundSixBar:
    """A six-bar on the branch where it works, else on that where it is nearest to the poses.

    Of branches on which it works the nearest one; of equally near ones, that with the greater least
    transmission angle, as a search chooses between both drivers.
    drivers: the cranks that may drive.  Raises E155 where it cannot be assembled.
    """
    every: list[_Verdict] = []
    for driver in drivers:
        branches = branches_of(linkage, driver)
        if len(branches.low):
            driven = _driven(linkage, branches, driver, problem)
            every += [_verdict(driven, k, problem) for k in range(len(branches.low))]
    if not every:
        raise _open(linkage)
    return _found(_best(every, problem), problem)


def _best(every: list[_Verdict], problem: SynthesisProblem) -> _Verdict:
    """The branch to tell of."""
    good = [each for each in every if not (each.defects or each.violations)]
    if good:
        alike = ALIKE * (1.0 if _by_tolerances(problem) else problem.motion_size)
        most = min(each.combined for each in good) + alike
        near = [each for each in good if each.combined <= most]
        return max(near, key=lambda each: round(each.merit, MERIT_DIGITS))  # of equals the first

    def order(each: _Verdict) -> tuple[float, int, int, float]:
        alike = round(each.far / ALIKE)
        merit = round(each.merit, MERIT_DIGITS)
        return alike, len(each.defects), len(each.violations), -merit

    return min(every, key=order)


def _driven(
    linkage: WattLinkage, branches: Branches, driver: Drive, problem: SynthesisProblem
) -> _OneDriver:
    """A six-bar on all its branches (k,) with one driver."""
    task, count = problem.given, len(branches.low)
    measure = PoseMeasure(task.poses, task.tolerances, problem.length_per_radian, problem.length)
    at_poses, off = nearest_drives(linkage, branches, driver, measure)
    links = linkage[None][np.zeros(count, dtype=np.intp)]
    sides = branches.sides
    joints = joints_at(links[:, None], at_poses, sides.at((slice(None), None)), driver)
    places = poses_of(linkage, joints)
    errors = [counted_error(places[k], task) for k in range(count)]
    missed, shares, slack = _missed(places, errors, problem)
    order = _along(at_poses, places, branches, slack, problem)
    drive = order.along
    low, high = drive.min(axis=-1), drive.max(axis=-1)
    room = np.stack([low - branches.low, branches.high - high], axis=-1)
    room = np.where(branches.full[:, None], np.inf, room)
    ordered = order.back <= np.maximum(REPEATED_POSE_STEP, order.slack)
    way = Travel(np.ones(count, dtype=bool), ordered, drive, room, sides)
    share = weights_or_ones(task.weights, task.poses.shape)
    return _OneDriver(
        branches=branches,
        candidates=Candidates(
            chain=np.zeros(count, dtype=np.intp),
            design=np.zeros(count, dtype=np.intp),
            linkages=links,
            joints=joints,
            driver=np.full(count, DRIVERS.index(driver)),
            drive=drive,
            room=room,
            sides=sides,
            transmission=least_transmission(links, way, driver, joints),
            extent=extent_of(links, drive, sides, driver),
            designs=1,
        ),
        errors=errors,
        missed=missed,
        combined=np.sqrt((off**2 @ share) / share.sum()),
        shares=shares,
        out_of_order=~ordered,
        at_poses=transmission(joints, driver),
    )


def _missed(
    places: Displacement, errors: list[PoseError], problem: SynthesisProblem
) -> tuple[FloatArray, FloatArray | None, FloatArray]:
    """How far places (k, N) miss the poses, in what is allowed: (k, N), as of four-bars.

    Then the shares of tolerances, where these decide, and (k,) how near to each other along a
    branch poses have no order: twice the distance by which one is missed.
    """
    task, asked = problem.given, problem.given.requirements
    position = np.array([each.position for each in errors])
    turn = np.array([each.angle for each in errors])
    reach, length = asked.reach(DEFAULT_TOLERANCE * problem.length, problem.length_per_radian)
    missed = np.maximum(position, length * turn)
    if not _by_tolerances(problem):
        return missed / reach, None, 2 * np.minimum(missed, reach).max(axis=-1)
    shares = shares_used(places, task, problem.length)
    stated = asked.within is not None or asked.within_deg is not None
    used = np.maximum(shares.max(axis=-1), missed / reach if stated else 0.0)
    distance = np.hypot(position, problem.length_per_radian * turn)
    return used / (1 + SHARE_ROUNDING), shares, 2 * distance.max(axis=-1)


def _along(
    drives: FloatArray,
    places: Displacement,
    branches: Branches,
    slack: FloatArray,
    problem: SynthesisProblem,
) -> PoseOrder:
    """The drives (k, N) of the poses without jumps, and how far they go back.

    A pose that comes again counts once.
    """
    motion = problem.motion
    if problem.is_merged and motion is not None:
        once = _along(
            drives[:, motion.first], places[:, motion.first], branches, slack, _distinct(problem)
        )
        return once._replace(along=once.along[:, motion.group])
    ones = np.ones(len(drives))
    if problem.given.requirements.any_order:
        along = np.where(branches.full[:, None], smallest_arc(drives), drives)
        return PoseOrder(along, 0 * ones, 0 * ones)
    everywhere = np.ones(drives.shape, dtype=bool)
    tolerance = OrderTolerance(slack, problem.length_per_radian)
    step = tolerated_step(places, everywhere, drives, tolerance)
    lines, rounds = along_interval(drives, ones, step), around_circuit(drives, step)
    return PoseOrder(
        *(
            np.where(branches.full.reshape(-1, *[1] * (one.ndim - 1)), one, other)
            for one, other in zip(rounds, lines, strict=True)
        )
    )


def _verdict(driven: _OneDriver, k: int, problem: SynthesisProblem) -> _Verdict:
    """What is wrong with one branch."""
    task, own, branches = problem.given, driven.candidates, driven.branches
    missed = driven.missed > 1
    met = ~missed
    same = branches.circuit == branches.circuit[k]
    elsewhere = np.zeros(len(missed[k]), dtype=np.intp)
    if met[k].any():
        elsewhere[missed[k] & met.any(axis=0)] = ELSEWHERE["circuit"]
        elsewhere[missed[k] & met[same].any(axis=0)] = ELSEWHERE["branch"]
    course = Course(
        missed[k],
        elsewhere,
        own.drive[k],
        bool(branches.full[k]),
        bool(driven.out_of_order[k]),
        driven.at_poses[k],
    )
    names = tuple(
        name or str(number)
        for number, name in enumerate(task.names or ("",) * len(missed[k]), start=1)
    )
    shares = None if driven.shares is None else driven.shares[k]
    full = bool(branches.full[k])
    return _Verdict(
        far=float(np.log1p(driven.missed[k]).mean()),
        combined=float(driven.combined[k]),
        merit=float(own.merit(problem.motion_size)[k]),
        driven=driven,
        branch=k,
        defects=(
            *defects_of(course, driven.errors[k], shares, task, names),
            *_degenerate(own.linkages[k], problem),
        ),
        violations=violations(
            own.linkages[k], float(own.transmission[k]), full, task, problem.motion_size
        ),
    )


def _degenerate(linkage: WattLinkage, problem: SynthesisProblem) -> list[Defect]:
    """That two joints of one link are too near to each other."""
    lengths, least = linkage.lengths(), least_bars(problem)
    short = lengths < least
    if not short.any():
        return []
    at = int(np.where(short, lengths, np.inf).argmin())
    message = too_short(float(lengths[at]), float(least[at]), problem.given)
    return [Defect("degenerate", message, ())]


def _found(best: _Verdict, problem: SynthesisProblem) -> FoundSixBar:
    driven, k, task = best.driven, best.branch, problem.given
    own = driven.candidates
    linkage, least, extent = own.linkages[k], float(own.transmission[k]), float(own.extent[k])
    turns = 2 * np.pi * np.round(own.drive[k, 0] / (2 * np.pi))
    return FoundSixBar(
        id="S1",
        linkage=linkage,
        driver=DRIVERS[int(own.driver[k])],
        drive=own.drive[k] - turns,
        room=own.room[k],
        sides=own.sides.at(k),
        transmission=least,
        extent=extent,
        error=driven.errors[k],
        shortcomings=shortcomings(linkage, least, extent, problem.motion_size, task),
        chain=0,
        defects=best.defects,
        violations=best.violations,
        within_tolerance=None
        if task.tolerances is None
        else shares_used(driven.errors[k].places, task, problem.length),
        task=task,
    )


def _by_tolerances(problem: SynthesisProblem) -> bool:
    """Whether tolerances decide how far a pose may be missed."""
    tolerances = problem.given.tolerances
    return tolerances is not None and tolerances.gives_room


def _distinct(problem: SynthesisProblem) -> SynthesisProblem:
    """The problem of the poses that are different."""
    return SynthesisProblem(
        problem.task,
        problem.task,
        None,
        problem.length,
        problem.options,
        problem.length_per_radian,
    )


def _open(linkage: WattLinkage) -> InputError:
    """E155 of a six-bar that cannot be assembled."""
    loop = FirstLoop.of(linkage)
    bars = {"AB": loop.ground, "AC": loop.crank, "CD": loop.coupler, "BD": loop.follower}
    lengths = {name: float(length) for name, length in bars.items()}
    longest = max(lengths, key=lambda name: lengths[name])
    rest = sum(lengths.values()) - lengths[longest]
    why = "wherever its first loop (A, C, D, B) closes, E and G are too far apart or too near"
    if lengths[longest] > rest:
        others = ", ".join(name for name in lengths if name != longest)
        why = f"{longest} is {lengths[longest]:.4g} long, and {others} together {rest:.4g}"
    return InputError(
        "E155",
        "the six-bar cannot be assembled at any place",
        why=why,
        help="measure its joints again; those of each link are in the frame of the link",
    )
