"""A model read back: links with their joints, put to the poses and compared.

E160 the file does not contain the linkage
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from typing import Literal, NamedTuple

from burmester.export.models.body_tree import tree_of
from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.reference import PRECISION, require_equal
from burmester.mechanisms.bodies import GROUND


class Link(NamedTuple):
    """A link or a site as a file has it, and the joint of its name by which it is on another one.

    at, turn: its frame in that of the other one where the joint is at `zero`.  along: the place of
    a hinge in its frame, or the direction of a slide.
    """

    on: str
    at: complex
    turn: float = 0.0
    kind: Literal["fixed", "hinge", "slide"] = "fixed"
    along: complex = 0j
    zero: float = 0.0


def place_of(
    links: Mapping[str, Link], name: str, joints: Mapping[str, float]
) -> tuple[complex, complex]:
    """The origin of a link's frame in the ground's, and its turn as a complex number.

    joints: by name, radians or metres; one that is missing is as the model begins.
    """
    if name == GROUND:
        return 0j, 1 + 0j
    on, own, angle, kind, along, zero = links[name]
    at, turn = place_of(links, on, joints)
    by = joints.get(name, zero) - zero
    spin = cmath.rect(1.0, angle)
    if kind == "slide":
        own += spin * by * along
    elif kind == "hinge":
        own += spin * along * (1 - cmath.rect(1.0, by))
        spin *= cmath.rect(1.0, by)
    return at + turn * own, turn * spin


def require_pose(
    model: DynamicModel, links: Mapping[str, Link], joints: Mapping[str, float], pose: int
) -> None:
    """Raise E160 unless joints bring the body to a pose, a number from 0, with closed loops."""
    where, wanted = f"at pose {pose + 1}", model.reference.places[pose]
    tolerance = PRECISION * model.reference.span
    at, turn = place_of(links, "body", joints)
    require_equal(f"the body {where}", [at.real, at.imag], wanted.translation, tolerance)
    gap = abs(turn - cmath.rect(1.0, float(wanted.angle)))
    require_equal(f"the body's angle {where}", gap, 0, PRECISION)
    for loop in tree_of(model, pose).loops:
        one, two = (place_of(links, f"{loop.name}_{end}", joints)[0] for end in "ab")
        require_equal(f"the loop {where}", abs(one - two), 0, tolerance)
