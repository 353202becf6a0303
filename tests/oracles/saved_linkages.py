"""Linkages that pass exactly through given poses, as a result file would hold them."""

import numpy as np

from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements
from tests.oracles import witness
from tests.oracles.handed_over import found

PAPER = (
    RR([-2.2000733, 0.1000512], [1.2400295, 0.1000499], 1.2377093),
    RR([1.1476011, 0.382324], [4.5882873, 1.3360019], 4.6638224),
)


def saved(first, second, rows, *, unit=None, any_order=False):
    """A linkage that passes through poses (N, 3), as a result would hold it."""
    poses = Displacement.from_poses(rows)
    task = Task(poses, length_unit=unit, requirements=Requirements(any_order=any_order))
    return found(Linkage(first, second), task, PoseError.at(poses, poses))


def paper(**more):
    """The crank-rocker of the paper at ten crank angles."""
    where, phi = witness.places(*PAPER, np.linspace(0.08, 5.74, 10))
    return saved(*PAPER, np.column_stack([where[1].real, where[1].imag, phi[1]]), **more)
