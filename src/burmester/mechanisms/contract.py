"""What a kind of mechanism tells of itself; all else is written once (`circuits`, `branches`).

A mechanism has one degree of freedom.  Its generator is an angle between two of its links, of which
all joints follow in closed form as soon as the side is known on which each loop is closed.  Kinds
say where the generator locks, and where each driver stands still.  A four-bar has one loop, Watt's
and Stephenson's six-bars two.
"""

from __future__ import annotations

from typing import ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.mechanisms.skeleton import Frames, Skeleton
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of


class Locked(NamedTuple):
    """The angles (m,) of a generator at which a loop locks, and which one: (m,)."""

    angle: FloatArray
    loop: NDArray[np.intp]


@runtime_checkable
class Mechanism(Protocol):
    """One mechanism, or many: leading axes (*,) are theirs.

    skeleton: joints and links; carries: the link that is the body.
    loops: how many sides tell where the joints are, beside the generator's angle.
    generator: the driver whose angle the generator is, "" where none's is.
    """

    loops: ClassVar[int]

    @property
    def skeleton(self) -> Skeleton: ...

    @property
    def carries(self) -> str: ...

    @property
    def generator(self) -> str: ...

    def frames(self) -> Frames:
        """The joints (*, 2) of each link in its own frame: of the ground in F, the body in M."""
        ...

    def lengths(self) -> FloatArray:
        """The distances between joints of one link, in the order of the skeleton's bars: (*, b)."""
        ...

    def generated(
        self, angle: FloatArray, sides: FloatArray, *, closed: bool = False
    ) -> ComplexArray:
        """The joints (*, j) at angles (*,) of the generator, loops closed on sides (*, loops).

        In F, in the order of the skeleton; nan where a loop cannot be closed.  closed: whether all
        are known to close, but for rounding.
        """
        ...

    def generator_angle(self, joints: ComplexArray) -> FloatArray:
        """The generator's angle (*,) where the joints are (*, j)."""
        ...

    def locked(self, sides: FloatArray) -> Locked:
        """Where one mechanism locks for the generator while its loops are on sides (loops,)."""
        ...

    def still(self, pivot: str) -> ComplexArray:
        """The joints (m, j) of one mechanism wherever a driver stands still: all its dead points.

        pivot: of a driver; not asked of the generator.
        """
        ...


def drive_of(skeleton: Skeleton, joints: ComplexArray, pivot: str) -> FloatArray:
    """The angle (*,) of a driver where the joints are (*, j), in F, within half a turn."""
    start, end = (skeleton.joints.index(joint) for joint in tuple(skeleton.arm(pivot)))
    return np.asarray(np.angle(joints[..., end] - joints[..., start]))


def body_of(mechanism: Mechanism, joints: ComplexArray) -> Displacement:
    """The poses (*,) of the body where the joints are (*, j); angles within half a turn."""
    skeleton, at = mechanism.skeleton, mechanism.frames()[mechanism.carries]
    near, far = tuple(skeleton.links[mechanism.carries][:2])
    own = [complex_of(at[joint]) for joint in (near, far)]
    there = [joints[..., skeleton.joints.index(joint)] for joint in (near, far)]
    turn = (there[1] - there[0]) / (own[1] - own[0])
    turn = turn / np.abs(turn)
    origin = there[0] - turn * own[0]
    return Displacement(np.stack([origin.real, origin.imag], axis=-1), np.angle(turn))
