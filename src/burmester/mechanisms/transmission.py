"""The transmission angle of a mechanism of any kind: how well its driver moves the links beyond it.

Two legs that meet in a joint have the angle between them there.  A link on three legs has, at the
end of each, the angle between this leg and the line to where the other two meet.  The least of all
is told; it is zero at the driver's dead points and nowhere else.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.mechanisms.circles import acute_angle
from burmester.mechanisms.skeleton import Skeleton
from burmester.numerics.arrays import ComplexArray, FloatArray

# Radians (0.06°).  A place with a smaller transmission angle is beside a dead point: whether the
# linkage locks there is uncertain.
DEAD_POINT_ANGLE: Final = 1e-3


def least_transmission_angle(skeleton: Skeleton, joints: ComplexArray, pivot: str) -> FloatArray:
    """The least transmission angle (*,) where the joints are (*, j), in radians.

    pivot: of the driver.
    """
    return np.asarray(np.minimum.reduce(transmission_angles(skeleton, joints, pivot)))


def transmission_angles(skeleton: Skeleton, joints: ComplexArray, pivot: str) -> list[FloatArray]:
    """The same for each group of links beyond the driver, as `Skeleton.legs` has them."""
    at = {name: joints[..., k] for k, name in enumerate(skeleton.joints)}
    angles = list[FloatArray]()
    for group in skeleton.legs(pivot):
        legs = [tuple(at[joint] for joint in tuple(leg)) for leg in group]
        if len(legs) == 2:
            (one, tip), (other, _) = legs
            angles.append(acute_angle(one - tip, other - tip))
            continue
        ends = list[FloatArray]()
        for k in range(3):
            (base, tip), (p, q), (r, s) = legs[k], legs[k - 1], legs[k - 2]
            u, v = q - p, s - r
            # Where the other two meet, as seen from the tip and times the sine between them.
            meeting = (p - tip) * (u.conj() * v).imag + u * ((r - p).conj() * v).imag
            ends.append(acute_angle(meeting, tip - base))
        angles.append(np.asarray(np.minimum.reduce(ends)))
    return angles
