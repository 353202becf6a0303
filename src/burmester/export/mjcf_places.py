"""Where the bodies of an MJCF model are, for given joints: its XML read as MuJoCo reads it."""

from __future__ import annotations

import math
from xml.etree import ElementTree

from burmester.export.numbers import numbers_in

__all__ = ["walk"]


def walk(  # noqa: PLR0917
    element: ElementTree.Element,
    origin: complex,
    angle: float,
    q: dict[str, float],
    sites: dict[str, complex],
    turns: dict[str, float],
) -> None:
    """Add where the sites are, and the angles of the bodies, with joints at q or as they begin.

    origin, angle: the frame of the element in the world, as a complex number and in radians.
    q: by name of joint, radians or metres; one that is not in it is as the model begins.
    sites, turns: by name, what is found; complex numbers and radians.
    """
    for each in element:
        if each.tag == "site" and each.get("name"):
            x, y, _ = numbers_in(each, "pos")
            turn = complex(math.cos(angle), math.sin(angle))
            sites[str(each.get("name"))] = origin + complex(x, y) * turn
        elif each.tag == "body":
            x, y, _ = numbers_in(each, "pos")
            turn = complex(math.cos(angle), math.sin(angle))
            at = origin + complex(x, y) * turn
            spin = angle + (numbers_in(each, "euler")[2] if each.get("euler") else 0.0)
            joint = each.find("joint")
            assert joint is not None
            name = str(joint.get("name"))
            ref = numbers_in(joint, "ref")[0]
            by = q.get(name, ref) - ref
            turn = complex(math.cos(spin), math.sin(spin))
            if joint.get("type") == "slide":
                ax, ay, _ = numbers_in(joint, "axis")
                at += by * complex(ax, ay) * turn
            else:
                px, py, _ = numbers_in(joint, "pos") if joint.get("pos") else (0.0, 0.0, 0.0)
                pin = at + complex(px, py) * turn
                spin += by
                at = pin - complex(px, py) * complex(math.cos(spin), math.sin(spin))
            turns[str(each.get("name"))] = spin
            walk(each, at, spin, q, sites, turns)
