"""Watt I six-bars under other names: made-up classes of mechanisms, to see that no face knows one.

Joints and links get other names and another order, another link is the body, and another one may
be the ground: seen from the coupler there are three pivots on it.  Where all is follows from the
joints of the six-bar itself, so that what a file says is compared with what was there before.
"""

from dataclasses import replace
from functools import cached_property

import numpy as np

from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.skeleton import Skeleton, seen_along
from burmester.sixbar.found import FoundSixBar

LOOKS = 2001
MOVED = Displacement(np.array([0.3, -0.2]), np.array(0.7))  # of M in the link that is the body


class Relabelled:
    """What faces ask of a six-bar, of one with other names.

    joints: the new letter of each old one; links: the new name of each old one, in their new order,
    the ground first; body: the old name of the link that is the body.
    pivot: the old letter of the joint at which the driver is.
    """

    def __init__(self, found, joints, links, body, pivot, *, name="Relabelled six-bar"):
        self.own, self.names, self.renamed, self.old_body = found, joints, links, body
        own = {
            links[old]: "".join(joints[each] for each in found.skeleton.links[old]) for old in links
        }
        own[links[body]] = own[links[body]][::-1]
        base, *_ = links
        drivers = "".join(sorted(own[links[base]]))
        self.skeleton = Skeleton(name, "".join(sorted(joints.values())), own, drivers)
        self.base, self.carries, self.driver = base, links[body], joints[pivot]
        self.driver_pivot = self.driver
        self.size = found.extent

    def __getattr__(self, name):
        return getattr(self.own, name)

    type = property(lambda self: self.skeleton.name)
    unit = property(lambda self: self.own.task.length_unit)

    @cached_property
    def frames(self):
        new = {v: k for k, v in self.names.items()}
        out = {}
        for old, link in self.renamed.items():
            given = {each: self.own.frames[old][new[each]] for each in self.skeleton.links[link]}
            if link == self.carries:
                given = {each: self.moved.inverse().act(at) for each, at in given.items()}
            elif old != self.base:
                axis = self.skeleton.axis(link)
                given = {each: seen_along(given, axis, each) for each in given}
            out[link] = given
        return out

    bodies = FoundSixBar.bodies
    bodies_at = FoundSixBar.bodies_at
    joints_at = FoundSixBar.joints_at
    at_poses = FoundSixBar.at_poses
    all_places = FoundSixBar.all_places
    travel = FoundSixBar.travel

    @property
    def moved(self):
        return Displacement(MOVED.translation * self.size / 10, MOVED.angle)

    @property
    def lengths(self):
        return self.skeleton.lengths(self.frames)

    def _joints(self, old_drive):
        places = self.own.links(old_drive)[self.base].inverse()
        at = self.own.joints(old_drive)
        return {self.names[each]: places.act(at[each]) for each in sorted(at, key=self.names.get)}

    def _angle(self, old_drive):
        """The new driver's angle where the old one's is rising (n,)."""
        pivot, end = self.skeleton.arm(self.driver)
        at = self._joints(old_drive)
        return np.unwrap(np.angle((at[end] - at[pivot]) @ [1, 1j]))

    @cached_property
    def _table(self):
        below, above = np.minimum(self.own.room, 0.05)
        low, high = self.own.drive_range
        old = np.union1d(np.linspace(low - 0.9 * below, high + 0.9 * above, LOOKS), self.own.drive)
        return old, self._angle(old)

    @cached_property
    def drive(self):
        return np.interp(self.own.drive, *self._table)

    @property
    def drive_range(self):
        return float(self.drive.min()), float(self.drive.max())

    @property
    def room(self):
        angle = self._table[1]
        return np.array([self.drive.min() - angle.min(), angle.max() - self.drive.max()])

    turns = 0
    turns_fully = False

    def _old(self, drive):
        """The old driver's angle, by bisection in its table and the secant rule."""
        old, angle = self._table
        if angle[-1] < angle[0]:
            old, angle = old[::-1], angle[::-1]
        assert (np.diff(angle) > 0).all()
        out = np.interp(drive, angle, old)
        step = 1e-7
        for _ in range(4):
            there, beside = self._turned(out), self._turned(out + step)
            off = np.angle(np.exp(1j * (drive - there)))
            slope = np.angle(np.exp(1j * (beside - there))) / step
            out = out + off / slope
        return out

    def _turned(self, old):
        pivot, end = self.skeleton.arm(self.driver)
        at = self._joints(np.asarray(old))
        return np.angle((at[end] - at[pivot]) @ [1, 1j])

    def joints(self, drive):
        return self._joints(self._old(np.asarray(drive, dtype=float)))

    def links(self, drive):
        return self.skeleton.places(self.frames, self.joints(drive))

    def body(self, drive):
        return self.links(drive)[self.carries]

    def along(self, count):
        low, high = self.drive_range
        ends = (high, low) if self.drive[-1] < self.drive[0] else (low, high)
        return np.linspace(*ends, count)

    def transmission_at(self, drive):
        return np.full(np.shape(drive), self.own.transmission)

    @cached_property
    def task(self):
        return replace(self.own.task, poses=self.body(self.drive), weights=None)

    @property
    def error(self):
        return PoseError.at(self.body(self.drive), self.task.poses)

    def scaled(self, scale):
        own = self.own.scaled(scale)
        names = self.names, self.renamed, self.old_body
        pivot = next(old for old, new in self.names.items() if new == self.driver)
        out = Relabelled(own, *names, pivot, name=self.skeleton.name)
        out.size, out.__dict__["drive"] = own.extent, self.drive
        return out


def renamed(found):
    """The same under other names, the coupler the body."""
    joints = dict(zip("ABCDEGH", "FAKCLEG", strict=True))
    links = {
        "ground": "ground", "floating link": "EG", "second crank": "rocker", "body": "lever",
        "first crank": "FK", "coupler": "CKL",
    }  # fmt: skip
    pivot = {"first": "A", "second": "B"}[found.driver]
    return Relabelled(found, joints, links, "coupler", pivot)


def seen_from_coupler(found):
    """A mechanism with three pivots on the ground, the floating link its body."""
    joints = dict(zip("ABCDEGH", "CDABFEG", strict=True))
    links = {
        "coupler": "ground", "first crank": "AC", "second crank": "BDE", "ground": "CD",
        "body": "FG", "floating link": "EG",
    }  # fmt: skip
    pivot = "C" if found.driver == "first" else "D"
    return Relabelled(found, joints, links, "floating link", pivot, name="Watt II, seen so")
