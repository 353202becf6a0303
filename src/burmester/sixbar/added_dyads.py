"""RR dyads added to a 3R chain, until one degree of freedom is left: Watt's first six-bar.

The poses of the chain's middle link are known, so the first dyad, from the ground to that link, is
one through five poses.  With it the poses of the new crank are known, too.  The second dyad, from
this crank to the body, is one through five poses of the body as the crank sees them.  Of both the
chain itself is one solution; so at most three are left, and at most nine six-bars of a chain (Soh
and McCarthy, "The synthesis of six-bar linkages as constrained planar 3R chains", 2008).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.five_poses import dyads_of_five
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.circles import meeting
from burmester.numerics.arrays import ComplexArray, FloatArray, Indexed, complex_of
from burmester.sixbar.watt import WattLinkage


@final
@dataclass(frozen=True, slots=True, eq=False)
class ThreeRChain(Indexed):
    """3R chains (*,): A in F (*, 2), the lengths of AC and CE (*,), E in M (*, 2)."""

    fixed_pivot: FloatArray
    first_length: FloatArray
    second_length: FloatArray
    body_joint: FloatArray

    def elbows(self, poses: Displacement, side: FloatArray) -> ComplexArray:
        """Where C is at poses (*, N), to the left (+1) or right of AE: (*, N); nan out of reach.

        side: (*,), the same at all poses.
        """
        a, e = complex_of(self.fixed_pivot)[..., None], self._ends(poses)
        first, second = self.first_length[..., None], self.second_length[..., None]
        return meeting(a, first, e, second, side[..., None])

    def middle_link(self, poses: Displacement, elbow: ComplexArray) -> Displacement:
        """The poses (*, N) of the link CE, its origin C (`elbow`) and its x axis towards E."""
        origin = np.stack([elbow.real, elbow.imag], axis=-1)
        return Displacement(origin, np.angle(self._ends(poses) - elbow))

    def _ends(self, poses: Displacement) -> ComplexArray:
        return complex_of(poses.act(self.body_joint[..., None, :]))


TRIVIAL = 1e-5  # of a task's size: a dyad whose pivots are as near to the chain's is the chain
MISSED = 1e-7  # of a task's size; a dyad that misses a pose by more is lost to rounding
LONGEST = 1e3  # of a task's size; a longer link is none


@final
class FourBars(NamedTuple):
    """Chains with their first dyad, (n,): the four-bar A, C, D, B whose coupler carries E.

    task: which of the chains given; joints: (n, 5, 5), A, B, C, D, E at the poses.
    dyad: B in F, D in the coupler's frame, the length of BD.
    """

    task: NDArray[np.intp]
    joints: ComplexArray
    dyad: RR


@final
class Added(NamedTuple):
    """Six-bars (n,), and where their joints are at the five poses.

    task: which of the four-bars given; joints: (n, 5, 7).
    """

    task: NDArray[np.intp]
    linkages: WattLinkage
    joints: ComplexArray


def with_first_dyad(chains: ThreeRChain, poses: Displacement, side: FloatArray) -> FourBars:
    """All dyads between the ground and the middle link of chains (k,) at poses (k, 5).

    side: (k,), of the elbow; chains that do not reach a pose have none.
    """
    elbow = chains.elbows(poses, side)
    reached = np.flatnonzero(np.isfinite(elbow).all(axis=-1))
    chains, poses, elbow = chains[reached], poses[reached], elbow[reached]
    middle = chains.middle_link(poses, elbow)
    size = size_of(poses) + chains.first_length + chains.second_length
    row, dyad = dyads_but(middle, chains.fixed_pivot, np.zeros(2), size)
    a, b = complex_of(chains.fixed_pivot)[row, None], complex_of(dyad.fixed_pivot)[:, None]
    d = complex_of(middle[row].act(dyad.moving_pivot[:, None, :]))
    e = complex_of(poses[row].act(chains.body_joint[row, None, :]))
    joints = np.stack(np.broadcast_arrays(a, b, elbow[row], d, e), axis=-1)
    return FourBars(reached[row], joints, dyad)


def with_second_dyad(chains: ThreeRChain, poses: Displacement, bars: FourBars) -> Added:
    """All dyads between the second crank of four-bars (k,) and the body at poses (k, 5).

    chains: (k,), of these four-bars.
    """
    b, d = bars.joints[..., 1], bars.joints[..., 3]
    crank = Displacement(np.stack([b.real, b.imag], axis=-1), np.angle(d - b))
    size = size_of(poses) + chains.first_length + chains.second_length + bars.dyad.radius
    end = np.stack([bars.dyad.radius, np.zeros_like(bars.dyad.radius)], axis=-1)
    row, dyad = dyads_but(crank.inverse() @ poses, end, chains.body_joint, size)
    chains, first = chains[row], bars.dyad[row]
    linkages = WattLinkage(
        fixed_first=chains.fixed_pivot,
        fixed_second=first.fixed_pivot,
        first_crank=chains.first_length,
        coupler_arm=chains.second_length,
        coupler_joint=first.moving_pivot,
        second_crank=first.radius,
        crank_joint=dyad.fixed_pivot,
        floating_link=dyad.radius,
        body_joint=chains.body_joint,
        link_joint=dyad.moving_pivot,
    )
    g = complex_of(crank[row].act(dyad.fixed_pivot[:, None, :]))
    h = complex_of(poses[row].act(dyad.moving_pivot[:, None, :]))
    joints = np.concatenate([bars.joints[row], np.stack([g, h], axis=-1)], axis=-1)
    return Added(row, linkages, joints)


def added_dyads(chains: ThreeRChain, poses: Displacement, side: FloatArray) -> Added:
    """All six-bars of chains (k,) through poses (k, 5); `task` says of which chain.

    Formula `added-dyads` of the theory.
    side: (k,), +1 or -1, of the elbow of the chain at all poses.
    """
    bars = with_first_dyad(chains, poses, side)
    added = with_second_dyad(chains[bars.task], poses[bars.task], bars)
    return added._replace(task=bars.task[added.task])


def dyads_but(
    poses: Displacement, fixed: FloatArray, moving: FloatArray, size: FloatArray
) -> tuple[NDArray[np.intp], RR]:
    """The dyads through poses (k, 5) but the one that is there: their tasks (n,), and they.

    fixed, moving: (k, 2), the pivots of the one that is there, nan where none is; size: (k,), of
    the tasks.
    """
    if not len(size):
        empty = np.empty((0, 2))
        return np.empty(0, dtype=np.intp), RR(empty, empty, np.empty(0))
    four = dyads_of_five(poses)
    dyads, size = four.dyads, size[:, None]
    apart = np.hypot(
        np.linalg.norm(dyads.fixed_pivot - fixed[..., None, :], axis=-1),
        np.linalg.norm(dyads.moving_pivot - moving[..., None, :], axis=-1),
    )
    with np.errstate(invalid="ignore"):
        good = four.real & ~(apart <= TRIVIAL * size) & (dyads.radius < LONGEST * size)
        good &= (four.max_error < MISSED * size) & four.determined[:, None]
    task, root = np.nonzero(good)
    return task, dyads[task, root]


def size_of(poses: Displacement) -> FloatArray:
    """The span of the origins of poses (k, 5): (k,)."""
    return np.asarray(np.linalg.norm(np.ptp(poses.translation, axis=-2), axis=-1))
