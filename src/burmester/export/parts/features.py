"""The holes and slots of a linkage's plates, before their widths are chosen; millimetres.

E163 a linkage that plates cannot hold
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["Features", "scaled"]


class Features:
    """The holes and slots of two dyads whose coupler goes through places (n,).

    reach: of a PR's pin along its line, of an RP's along the slot: two ends, (2, 2), in F or M.
    """

    def __init__(self, first: RR | PR | RP, second: RR | PR | RP, motion: Displacement) -> None:
        self.dyads = (first, second)
        self.motion = motion
        self.reach = tuple(_reach(dyad, motion) for dyad in self.dyads)

    def of_link(self, on: Literal["ground", "coupler"]) -> list[FloatArray]:
        """Each dyad's hole, centre (1, 2), or slot, ends (2, 2), on the ground or the coupler."""
        slotted = PR if on == "ground" else RP
        ends: list[FloatArray] = []
        for dyad, reach in zip(self.dyads, self.reach, strict=True):
            if isinstance(dyad, slotted):
                assert reach is not None
                ends.append(reach)
            else:
                pivot = dyad.fixed_pivot if on == "ground" else dyad.moving_pivot  # type: ignore[union-attr]
                ends.append(pivot[None])
        return ends


def _reach(dyad: RR | PR | RP, motion: Displacement) -> FloatArray | None:
    """Both ends (2, 2) of what a slider's pin travels along its line."""
    if isinstance(dyad, RR):
        return None
    if isinstance(dyad, PR):
        points = motion.act(dyad.moving_pivot)
    else:
        points = motion.inverse().act(dyad.fixed_pivot)
    n = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    along = np.array([-n[1], n[0]])
    s = points @ along
    return np.asarray(n * dyad.offset + np.stack([s.min(), s.max()])[:, None] * along)


def scaled(dyad: Dyad, scale: float) -> RR | PR | RP:
    """A dyad with its lengths multiplied by a scale; raises E163 for a PP."""
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot * scale, dyad.moving_pivot * scale, dyad.radius * scale)
    if isinstance(dyad, PR):
        return PR(dyad.normal_angle, dyad.offset * scale, dyad.moving_pivot * scale)
    if isinstance(dyad, RP):
        return RP(dyad.fixed_pivot * scale, dyad.normal_angle, dyad.offset * scale)
    assert isinstance(dyad, PP)
    raise InputError(
        "E163",
        "this linkage cannot be made of plates with pins and slots",
        why="its body only translates, on two sliders of which one carries the other",
        help="choose another linkage, or a table of its places: --to csv",
    )
