"""Which poses may be one and the same, in cases made for one rule each."""

import numpy as np
import pytest

from burmester import Displacement
from burmester.tasks.repeated_poses import distinguishable


@pytest.mark.parametrize(
    ("x", "degrees"),
    [
        # Each pose is known to one unit and to one degree: two of them come within twice that.
        ([0.0, 1.9, 4.1], [0.0, 0.0, 0.0]),
        ([0.0, 0.0, 0.0], [0.0, 1.9, 4.1]),
        ([0.0, 1.9, 4.1], [0.0, 1.9, 0.5]),
    ],
)
def test_poses_within_twice_their_errors_may_be_one(x, degrees):
    poses = Displacement(np.column_stack([x, np.zeros(3)]), np.radians(degrees))
    assert distinguishable(poses, 1.0, np.radians(1.0), 3).tolist() == [0, 2]
    assert distinguishable(poses, 0.9, np.radians(0.9), 3).tolist() == [0, 1, 2]
    assert distinguishable(poses, 0.9, np.radians(0.9), 2).tolist() == [0, 2]
