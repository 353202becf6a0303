"""Six-bars of a result, read back and judged again.

E150 a six-bar that does not carry the body through the poses of its result, or one that was given
     and judged otherwise than its file says
E151 no such six-bar
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import final

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.io.saved_model import WrittenSixBar, WrittenSixBars
from burmester.io.six_bar_data import TYPE
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.motion import poses_of
from burmester.sixbar.travel import least_transmission, travel
from burmester.sixbar.watt import Drive, WattLinkage
from burmester.synthesis.six_bar_judgement import judge_six_bar
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions

__all__ = ["SavedSixBar", "saved_six_bars"]

HELP = "take the file as `burmester synthesize POSES --six-bars -o RESULT` wrote it"
OFF = 1e-6  # of the greatest length; bars and poses of a six-bar that works are off by less


@final
@dataclass(frozen=True, slots=True, eq=False)
class SavedSixBar:
    """A six-bar of a result, with its task."""

    found: FoundSixBar
    task: Task

    @property
    def id(self) -> str:
        """Its name: S1, S2, ..."""
        return self.found.id

    @property
    def type(self) -> str:
        """What it is, in words."""
        return TYPE

    @property
    def unit(self) -> str | None:
        """The unit of lengths."""
        return self.task.length_unit

    @property
    def usable(self) -> bool:
        """Whether it goes from pose to pose in one motion; one that was given need not."""
        return self.found.usable


def saved_six_bars(
    written: WrittenSixBars, task: Task, length_per_radian: float | None = None
) -> tuple[SavedSixBar, ...]:
    """Those of a result; raises E150.

    length_per_radian: what a radian of angle error counted as, where one was judged.
    """
    return tuple(
        SavedSixBar(
            _judged(each, k, task, length_per_radian) if each.given else _found(each, k, task), task
        )
        for k, each in enumerate(written.found)
    )


def _judged(
    written: WrittenSixBar, number: int, task: Task, length_per_radian: float | None
) -> FoundSixBar:
    """One that was given, judged again from its dimensions alone."""
    options = SynthesisOptions(length_per_radian=length_per_radian or None)
    try:
        judged = judge_six_bar(task, _linkage(written), options).six_bars
    except InputError as error:
        raise _amiss(number, error.message) from None
    assert judged is not None
    found = judged.found[0]
    if found.usable != written.usable:
        works = "works" if found.usable else "does not work"
        raise _amiss(number, f"its dimensions say that it {works}, and the file says otherwise")
    return replace(found, id=written.id)


def _linkage(written: WrittenSixBar) -> WattLinkage:
    return WattLinkage(
        fixed_first=np.array(written.ground.A),
        fixed_second=np.array(written.ground.B),
        first_crank=np.array(written.lengths.AC),
        coupler_arm=np.array(written.coupler.E[0]),
        coupler_joint=np.array(written.coupler.D),
        second_crank=np.array(written.second_crank.D[0]),
        crank_joint=np.array(written.second_crank.G),
        floating_link=np.array(written.lengths.GH),
        body_joint=np.array(written.body.E),
        link_joint=np.array(written.body.H),
    )


def _found(written: WrittenSixBar, number: int, task: Task) -> FoundSixBar:
    """One of them, from its dimensions and the drive at the poses alone."""
    linkage = _linkage(written)
    poses, drive = task.poses, np.radians(written.drive_deg)
    if len(drive) != poses.shape[0]:
        raise _amiss(number, f"it has {len(drive)} drives for {poses.shape[0]} poses")
    with np.errstate(all="ignore"):
        joints = _joints(linkage, poses, drive, written.driver)
        size = float(linkage.lengths().max())
        off = linkage.through(poses, joints).max()
    if not (size > 0 and off < OFF * size):
        raise _amiss(number, "its dimensions do not carry the body through the poses")
    way = travel(linkage[None], joints[None], written.driver, any_order=task.requirements.any_order)
    # Where the driver turns fully, the file says which way round.
    full, steps = bool(np.isinf(way.room).all()), np.diff(drive)
    one_way = task.requirements.any_order or bool((steps > 0).all() or (steps < 0).all())
    same = full or np.ptp(way.drive[0] - drive) < OFF
    if not (way.one_branch[0] and one_way and same and np.ptp(drive) < 2 * np.pi):
        raise _amiss(number, "it locks between the poses, or meets them in another order")
    way = way._replace(drive=drive[None])
    least = least_transmission(linkage[None], way, written.driver, joints[None])
    return FoundSixBar(
        id=written.id,
        linkage=linkage,
        driver=written.driver,
        drive=way.drive[0],
        room=way.room[0],
        sides=way.sides.at(0),
        transmission=float(least[0]),
        extent=written.extent,
        error=PoseError.at(poses_of(linkage, joints), poses),
        shortcomings=tuple(written.shortcomings),
        chain=0,
    )


def _joints(
    linkage: WattLinkage, poses: Displacement, drive: FloatArray, driver: Drive
) -> ComplexArray:
    """The joints (N, 7) at poses (N,), the coupler being known by E and the driver's end."""
    a, b = complex_of(linkage.fixed_first), complex_of(linkage.fixed_second)
    at_d, at_g = complex_of(linkage.coupler_joint), complex_of(linkage.crank_joint)
    e, h = (complex_of(poses.act(at)) for at in (linkage.body_joint, linkage.link_joint))
    arm = linkage.coupler_arm
    if driver == "first":
        c = a + linkage.first_crank * np.exp(1j * drive)
        d = c + (e - c) / arm * at_d
    else:
        d = b + linkage.second_crank * np.exp(1j * drive)
        c = d - (e - d) / (arm - at_d) * at_d
    g = b + (d - b) / linkage.second_crank * at_g
    return np.stack(np.broadcast_arrays(a, b, c, d, e, g, h), axis=-1)


def _amiss(number: int, why: str) -> InputError:
    message = f"$.six_bars.found[{number}] of this result cannot be used"
    return InputError("E150", message, why=why, help=HELP)
