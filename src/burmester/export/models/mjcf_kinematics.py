"""The frames of the bodies of an MJCF model for given joints: its XML read as MuJoCo reads it."""

from __future__ import annotations

import math
from typing import NamedTuple
from xml.etree import ElementTree

from burmester.export.numbers import numbers_in


class Frames(NamedTuple):
    """The world coordinates of sites (complex) and the angles of bodies (radians), by name."""

    sites: dict[str, complex]
    angles: dict[str, float]


def frames_at(world: ElementTree.Element, joints: dict[str, float]) -> Frames:
    """The sites and bodies under a `worldbody`.

    joints: by name, radians or metres; a joint that is missing is as the model begins.
    """
    frames = Frames({}, {})
    _add(frames, world, 0j, 0.0, joints)
    return frames


def _add(
    frames: Frames,
    element: ElementTree.Element,
    origin: complex,
    angle: float,
    joints: dict[str, float],
) -> None:
    """Add what an element holds whose own frame is at an origin and an angle (radians)."""
    for each in element:
        if each.tag == "site" and each.get("name"):
            x, y, _ = numbers_in(each, "pos")
            turn = complex(math.cos(angle), math.sin(angle))
            frames.sites[str(each.get("name"))] = origin + complex(x, y) * turn
        elif each.tag == "body":
            x, y, _ = numbers_in(each, "pos")
            turn = complex(math.cos(angle), math.sin(angle))
            at = origin + complex(x, y) * turn
            spin = angle + (numbers_in(each, "euler")[2] if each.get("euler") else 0.0)
            joint = each.find("joint")
            assert joint is not None
            name = str(joint.get("name"))
            ref = numbers_in(joint, "ref")[0]
            by = joints.get(name, ref) - ref
            turn = complex(math.cos(spin), math.sin(spin))
            if joint.get("type") == "slide":
                ax, ay, _ = numbers_in(joint, "axis")
                at += by * complex(ax, ay) * turn
            else:
                px, py, _ = numbers_in(joint, "pos") if joint.get("pos") else (0.0, 0.0, 0.0)
                pin = at + complex(px, py) * turn
                spin += by
                at = pin - complex(px, py) * complex(math.cos(spin), math.sin(spin))
            frames.angles[str(each.get("name"))] = spin
            _add(frames, each, at, spin, joints)
