"""A six-bar that exists, from a file: as an export to JSON has it, or as a person types it.

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

Other lengths, as an export has them, are compared with the joints.

E156 joints or lengths that are missing, or that contradict each other
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from burmester.io.linkage_values import fault, number, pair
from burmester.numerics.arrays import FloatArray, complex_of
from burmester.printable import printable
from burmester.sixbar.watt import BARS, WattLinkage
from burmester.values import shown

__all__ = ["DIMENSIONS", "is_six_bar", "six_bar_of"]

# The joints of each link in a file; the first one of three is the origin where it is left out.
JOINTS: Final = {"ground": "AB", "coupler": "CDE", "second_crank": "BDG", "body": "EH"}
LENGTHS: Final = ("AC", "GH")
DIMENSIONS: Final = (*JOINTS, "lengths")  # the keys of an object that hold them
OWN: Final = ("coupler", "second_crank", "lengths")  # no other file of a linkage has them
SAME: Final = 1e-3  # relative; a length that a person typed beside the joints agrees as well
HELP: Final = (
    "give the joints [ground] A, B, [coupler] D, E, [second_crank] D, G, [body] E, H, each as "
    "[x, y] in the frame of its link, and [lengths] AC, GH"
)


def is_six_bar(tree: dict[str, Any]) -> bool:
    """Whether an object is meant to be a six-bar."""
    return "dyads" not in tree and any(key in tree for key in OWN)


def six_bar_of(tree: dict[str, Any]) -> WattLinkage:
    """The six-bar of an object; raises E156."""
    at = {link: _joints(tree, link, joints) for link, joints in JOINTS.items()}
    lengths = _table(tree, "lengths")
    for bar in lengths:
        if bar not in BARS:
            raise fault(f"lengths.{printable(str(bar))[:40]} is not known", HELP)
    first_crank, floating_link = (_length(lengths, bar) for bar in LENGTHS)
    coupler, crank = at["coupler"], at["second_crank"]
    linkage = WattLinkage(
        fixed_first=at["ground"]["A"],
        fixed_second=at["ground"]["B"],
        first_crank=first_crank,
        coupler_arm=_apart(coupler, "C", "E", "coupler"),
        coupler_joint=_seen(coupler["D"], coupler["C"], coupler["E"]),
        second_crank=_apart(crank, "B", "D", "second_crank"),
        crank_joint=_seen(crank["G"], crank["B"], crank["D"]),
        floating_link=floating_link,
        body_joint=at["body"]["E"],
        link_joint=at["body"]["H"],
    )
    for bar, found in zip(BARS, linkage.lengths().tolist(), strict=True):
        length = number(lengths[bar], f"lengths.{bar}") if bar in lengths else found
        if not abs(length - found) <= SAME * found:
            raise fault(
                f"lengths.{bar} contradicts the joints",
                f"leave {bar} out, or correct it",
                f"it is {shown(lengths[bar])}, and {bar[0]} and {bar[1]} are {found:.7g} apart",
            )
    return linkage


def _joints(tree: dict[str, Any], link: str, joints: str) -> dict[str, FloatArray]:
    """The joints of a link, by their letters."""
    table = _table(tree, link)
    for joint in table:
        if joint not in joints:
            raise fault(f"{link}.{printable(str(joint))[:40]} is not known", HELP)
    out = {}
    for joint in joints:
        if joint in table:
            out[joint] = pair(table, joint, link)
        elif joint == joints[0] and len(joints) == 3:
            out[joint] = np.zeros(2)
        else:
            raise fault(f"{link}.{joint} is missing", HELP)
    return out


def _table(tree: dict[str, Any], name: str) -> dict[str, Any]:
    table = tree.get(name)
    if not isinstance(table, dict):
        why = "it is missing" if table is None else f"it is {shown(table)}"
        raise fault(f"{name} of this six-bar cannot be used", HELP, why)
    return table


def _length(lengths: dict[str, Any], bar: str) -> FloatArray:
    if bar not in lengths:
        raise fault(f"lengths.{bar} is missing", HELP)
    length = number(lengths[bar], f"lengths.{bar}")
    if not length > 0:
        raise fault(f"lengths.{bar} is {length:g}", "give a length above zero")
    return np.asarray(length)


def _apart(at: dict[str, FloatArray], one: str, other: str, link: str) -> FloatArray:
    """The distance between two joints of a link, the second of which lies on its x axis."""
    length = float(np.hypot(*(at[other] - at[one])))
    if not length > 0:
        message = f"joints {one} and {other} of {link} are at one place"
        raise fault(message, "give each joint of a link a place of its own")
    return np.asarray(length)


def _seen(point: FloatArray, origin: FloatArray, along: FloatArray) -> FloatArray:
    """A point (2,) in the frame with an origin, whose x axis goes through `along`."""
    way = complex_of(along - origin)
    at = complex_of(point - origin) * np.abs(way) / way
    return np.array([at.real, at.imag])
