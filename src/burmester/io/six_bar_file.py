"""A six-bar that exists, from a file: as an export to JSON has it, or as a person types it.

type = "Watt I six-bar"  where it is left out; it says which links there are
[ground]
A = [X, Y]               in F
B = [X, Y]
[coupler]
D = [x, y]               in any frame of the coupler; C is its origin where it is left out
E = [x, y]
[second_crank]
D = [x, y]               in any frame of this crank; B is its origin where it is left out
G = [x, y]
[body]
E = [x, y]               in M
H = [x, y]
[lengths]
AC = L                   of the first crank
GH = L                   of the floating link

In classes in which no link is called the body, `carries` names the one that is it.  Other lengths,
as an export has them, are compared with the joints.

E156 joints or lengths that are missing, or that contradict each other
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from burmester.io.linkage_values import fault, number, pair
from burmester.mechanisms.skeleton import Skeleton
from burmester.printable import printable
from burmester.synthesis.six_bars import KINDS
from burmester.values import shown
from burmester.wording import listed

if TYPE_CHECKING:
    from burmester.numerics.arrays import FloatArray
    from burmester.sixbar.kinds import SixBar

OWN: Final = ("coupler", "second_crank", "lengths")  # no other file of a linkage has them
SAME: Final = 1e-3  # relative; a length that a person typed beside the joints agrees as well


def is_six_bar(tree: dict[str, Any]) -> bool:
    """Whether an object is meant to be a six-bar."""
    return "dyads" not in tree and any(key in tree for key in OWN)


def six_bar_of(tree: dict[str, Any]) -> SixBar:
    """The six-bar of an object; raises E156."""
    usual = next(iter(KINDS))
    name = tree.get("type", usual)
    if not isinstance(name, str) or name not in KINDS:
        why = f"the types of six-bars are: {', '.join(KINDS)}"
        raise fault(f"there is no type {shown(name)}", f'give type = "{usual}"', why)
    skeleton = KINDS[name].skeleton
    carries = tree.get("carries", "body")
    if carries not in skeleton.moving:
        help = f"give carries, the link that is the body: {listed(skeleton.moving, 'or')}"
        raise fault(f"the {name} has no link {shown(carries)}", help)
    read = _Reading(tree, skeleton, carries)
    frames = {link: read.joints(link) for link in skeleton.held(carries)}
    lengths = read.table("lengths")
    for bar in lengths:
        if bar not in skeleton.bars:
            raise fault(f"lengths.{printable(str(bar))[:40]} is not known", read.help)
    for link in read.plain:
        one, two = tuple(skeleton.links[link])
        frames[link] = {one: np.zeros(2), two: np.array([read.length(lengths, one + two), 0.0])}
    for link in skeleton.held(carries):
        one, two = tuple(skeleton.axis(link))
        own = frames[link]
        if link not in (skeleton.ground, carries) and not np.hypot(*(own[two] - own[one])) > 0:
            message = f"joints {one} and {two} of {_key(link)} are at one place"
            raise fault(message, "give each joint of a link a place of its own")
    for bar, found in skeleton.lengths(frames).items():
        length = number(lengths[bar], f"lengths.{bar}") if bar in lengths else found
        if not abs(length - found) <= SAME * found:
            raise fault(
                f"lengths.{bar} contradicts the joints",
                f"leave {bar} out, or correct it",
                f"it is {shown(lengths[bar])}, and {bar[0]} and {bar[1]} are {found:.7g} apart",
            )
    return KINDS[name].of(carries, frames)


def _key(link: str) -> str:
    """What a link is called in a file."""
    return link.replace(" ", "_")


class _Reading:
    """An object of a file, read as a six-bar of a class, one of whose links is the body."""

    def __init__(self, tree: dict[str, Any], skeleton: Skeleton, carries: str) -> None:
        self._tree, self._skeleton = tree, skeleton
        held = skeleton.held(carries)
        self.plain = tuple(each for each in skeleton.links if each not in held)
        # The first joint of a link in any frame is the origin where it is left out.
        self._free = {each: skeleton.links[each][0] for each in held[1:] if each != carries}
        needed = {
            each: skeleton.links[each].replace(self._free.get(each, " "), "") for each in held
        }
        links = (f"[{_key(each)}] {', '.join(own)}" for each, own in needed.items())
        bars = ", ".join(skeleton.links[each] for each in self.plain)
        self.help = (
            f"give the joints {', '.join(links)}, each as [x, y] in the frame of its link, and "
            f"[lengths] {bars}"
        )

    def joints(self, link: str) -> dict[str, FloatArray]:
        """The joints of a link, by their letters."""
        key, joints = _key(link), self._skeleton.links[link]
        table = self.table(key)
        for joint in table:
            if joint not in joints:
                raise fault(f"{key}.{printable(str(joint))[:40]} is not known", self.help)
        out = {}
        for joint in joints:
            if joint in table:
                out[joint] = pair(table, joint, key)
            elif joint == self._free.get(link):
                out[joint] = np.zeros(2)
            else:
                raise fault(f"{key}.{joint} is missing", self.help)
        return out

    def table(self, name: str) -> dict[str, Any]:
        """An object in the object."""
        table = self._tree.get(name)
        if not isinstance(table, dict):
            why = "it is missing" if table is None else f"it is {shown(table)}"
            raise fault(f"{name} of this six-bar cannot be used", self.help, why)
        return table

    def length(self, lengths: dict[str, Any], bar: str) -> float:
        """The length of a link that has no more."""
        if bar not in lengths:
            raise fault(f"lengths.{bar} is missing", self.help)
        length = float(number(lengths[bar], f"lengths.{bar}"))
        if not length > 0:
            raise fault(f"lengths.{bar} is {length:g}", "give a length above zero")
        return length
