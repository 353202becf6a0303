"""A six-bar with all that is known of it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from burmester.errors import Finding
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import Bodies, LinkPlaces, bodies_of_skeleton, plate_names
from burmester.mechanisms.branches import Branch
from burmester.mechanisms.contract import body_of
from burmester.mechanisms.skeleton import Frames, Skeleton
from burmester.mechanisms.transmission import least_transmission_angle
from burmester.numerics.arrays import ComplexArray, FloatArray, pairs_of
from burmester.requirements.figures import Figures
from burmester.sixbar.candidates import figures_of
from burmester.sixbar.kinds import KINDS, SixBar
from burmester.values import real_numbers
from burmester.verdicts.judged_linkage import LinkageAtPoses
from burmester.verdicts.motion import Configuration, Motion, Way


@dataclass(frozen=True, slots=True, eq=False)
class FoundSixBar(LinkageAtPoses):
    """A six-bar that carries the body through the poses, or one that was given, on one branch.

    Attributes
    ----------
    linkage : WattLinkage
        Its dimensions; no leading axes.
    branch : Branch
        On which it goes through the poses, and about which pivot its driver turns.
    drive : (N,) array
        The driver's angle at the poses, in radians, in F, without jumps.
    room : (2,) array
        How far the driver goes on below and above the range of the poses before the linkage locks,
        in radians; infinite where the driver turns fully.
    transmission : float
        The least transmission angle of both loops over the range, in radians.
    extent : float
        The diagonal of the box around all joints at places along the range, in the task's unit.
    chain : int
        The number of its chain in the search.
    defects : tuple of Finding
        Of one that was given: why it does not go through the poses on one branch and in order.
    id, error, violations, shortcomings, within_tolerance, task
        As in `LinkageAtPoses`.
    """

    linkage: SixBar
    branch: Branch
    drive: FloatArray
    room: FloatArray
    transmission: float
    extent: float
    chain: int
    defects: tuple[Finding, ...] = ()

    @property
    def type(self) -> str:
        """What it is, in words."""
        return self.skeleton.name

    @property
    def usable(self) -> bool:
        """Whether it goes through the poses on one branch and in order, and keeps all limits."""
        return not self.faults

    @property
    def on_branches(self) -> bool:
        """Whether it meets poses on other branches than this one, the errors being of this one."""
        return any(each.kind in ("circuit", "branch") and each.certain for each in self.defects)

    @property
    def figures(self) -> Figures:
        """What it measures and does."""
        figures = figures_of(self.linkage, self.transmission, self.turns_fully, self.extent)
        return self.with_loads(figures)

    @property
    def turns_fully(self) -> bool:
        """Whether the driver turns fully and nothing locks."""
        return bool(np.isinf(self.room).all())

    @property
    def skeleton(self) -> Skeleton:
        """Its joints and links."""
        return self.linkage.skeleton

    @property
    def carries(self) -> str:
        """The name of the link that is the body."""
        return self.linkage.carries

    @property
    def frames(self) -> Frames:
        """The joints (2,) of each link, in the frame of that link; of the body in M."""
        return self.linkage.frames()

    @property
    def driver_pivot(self) -> str:
        """The pivot on the ground about which the driver turns."""
        return self.branch.pivot

    @property
    def driver(self) -> str:
        """The driver as results name it: "first" or "second" of Watt's, else its pivot."""
        return self.linkage.driver_name(self.driver_pivot)

    @property
    def turns(self) -> int:
        """After how many turns of the driver all is as it was; 0 where it cannot turn fully."""
        return self.branch.turns

    @property
    def drive_range(self) -> tuple[float, float]:
        """The least and the greatest angle of the driver at the poses, in radians."""
        return float(self.drive.min()), float(self.drive.max())

    @property
    def link_ratio(self) -> float:
        """The greatest distance between two joints of a link over the least."""
        lengths = self.linkage.lengths()
        return float(lengths.max() / lengths.min())

    @property
    def lengths(self) -> dict[str, float]:
        """The distances between joints of one link: {"AB": 30.0, ...}."""
        return dict(zip(self.skeleton.bars, self.linkage.lengths().tolist(), strict=True))

    def joints(self, drive: FloatArray) -> dict[str, FloatArray]:
        """Where the joints are when the driver is at angles (*,) in radians: {"A": (*, 2), ...}.

        nan beyond where the linkage locks.
        """
        places = pairs_of(self._joints(drive))
        return {name: places[..., k, :] for k, name in enumerate(self.skeleton.joints)}

    def links(self, drive: FloatArray) -> dict[str, Displacement]:
        """Where the frames of all links are when the driver is at angles (*,), (*,) each."""
        return self.skeleton.places(self.frames, self.joints(drive))

    def body(self, drive: FloatArray) -> Displacement:
        """The poses (*,) of the body when the driver is at angles (*,) in radians."""
        return body_of(self.linkage, self._joints(drive))

    def at(self, driver: ArrayLike) -> Configuration:
        """Where body and joints are for the driver's angle, or for an array of angles, in degrees.

        As `burmester.ResultLinkage.at`; the joints are A to H of the drawing.
        """
        given = real_numbers(driver, (...,), "the driver")
        drive = np.radians(given)
        return Configuration(given, self.body(drive), self.joints(drive))

    def joints_at(self, drive: FloatArray, body: Displacement) -> dict[str, FloatArray]:
        """Its joints (*, 2) by name when the driver is at (*,)."""
        return self.joints(drive)

    def transmission_at(self, drive: FloatArray) -> FloatArray:
        """The lesser transmission angle of both loops when the driver is at angles (*,).

        Both in radians.
        """
        return least_transmission_angle(self.skeleton, self._joints(drive), self.driver_pivot)

    def scaled(self, scale: float) -> Self:
        """The same in another unit of length, `scale` of them for one."""
        frames = {
            link: {name: at * scale for name, at in joints.items()}
            for link, joints in self.frames.items()
        }
        linkage = KINDS[self.skeleton.name].of(self.carries, frames)
        error = self.error.scaled(scale)
        return replace(self, linkage=linkage, extent=self.extent * scale, error=error)

    def along(self, count: int) -> FloatArray:
        """So many angles of the driver, evenly over the range of the poses, in radians.

        From the first pose to the last, where these are met in their order.
        """
        low, high = self.drive_range
        ends = (high, low) if self.drive[-1] < self.drive[0] else (low, high)
        return np.linspace(*ends, count)

    @property
    def bodies(self) -> Bodies:
        """Its bodies and joints."""
        return bodies_of_skeleton(self.skeleton, self.frames, self.carries, self.driver_pivot)

    def bodies_at(self, drive: FloatArray, body: Displacement) -> LinkPlaces:
        """Where its bodies are when the driver is at (*,) and M at places (*,)."""
        return _named(self.skeleton, self.links(drive))

    def at_poses(self) -> LinkPlaces:
        """Where its bodies are for the poses (N,)."""
        return self.bodies_at(self.drive, self.error.places)

    def all_places(self, count: int) -> LinkPlaces:
        """Where its bodies are along the branch of the poses, and for these."""
        drive = np.union1d(self.along(count), self.drive)
        return self.bodies_at(drive, self.body(drive))

    def travel(self, whole: bool = False) -> Way:
        """Its motion, at whatever shares of it; see `Motion.of`."""
        start, end = self.along(2).tolist()
        full = whole and self.turns > 0
        if full:
            start = float(self.drive[0])
            end = start + math.copysign(2 * math.pi * self.turns, self.drive[-1] - start)
        met, frames = (self.drive - start) / (end - start), self.frames

        def at(share: FloatArray) -> Motion:
            drive = start + (end - start) * share
            links = self.skeleton.places(frames, self.joints(drive))
            there = _named(self.skeleton, links)
            return Motion(links[self.carries], drive, met, True, self.turns > 0, full, there)

        return at

    def _joints(self, drive: FloatArray) -> ComplexArray:
        return self.branch.at(self.linkage, drive)


def _named(skeleton: Skeleton, links: Mapping[str, Displacement]) -> LinkPlaces:
    """The places of links as those of bodies."""
    named = plate_names(skeleton)
    return LinkPlaces({named[link]: each for link, each in links.items()})
