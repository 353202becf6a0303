"""Transmission angles of links on three legs, against the motion that is left without one leg."""

import numpy as np
import pytest

from burmester.mechanisms.transmission import transmission_angles
from burmester.stephenson.linkage import CLASSES


@pytest.mark.parametrize("kind", CLASSES)
def test_a_leg_pushes_a_link_where_it_moves_without_that_leg(kind):
    """Joints anywhere: the angles are those of forces and of speeds there."""
    skeleton = CLASSES[kind].skeleton
    rng = np.random.default_rng(3)
    tried = 0
    for pivot in skeleton.drivers:
        for number, group in enumerate(skeleton.legs(pivot)):
            if len(group) != 3:
                continue
            for _ in range(20):
                joints = rng.normal(size=(len(skeleton.joints), 2))
                at = dict(zip(skeleton.joints, joints, strict=True))
                tips = np.array([at[leg[1]] for leg in group])
                legs = tips - [at[leg[0]] for leg in group]
                # What a speed (x, y, turn) of the link makes of each leg's length.
                rates = np.column_stack([legs, legs[:, 1] * tips[:, 0] - legs[:, 0] * tips[:, 1]])
                told = transmission_angles(skeleton, joints @ [1, 1j], pivot)[number]
                least = np.inf
                for k in range(3):
                    x, y, turn = np.linalg.svd(np.delete(rates, k, axis=0))[2][2]
                    speed = np.array([x - turn * tips[k, 1], y + turn * tips[k, 0]])
                    pushed = abs(speed @ legs[k]) / np.linalg.norm(speed)
                    least = min(least, np.arcsin(pushed / np.linalg.norm(legs[k])))
                assert told == pytest.approx(least, abs=1e-9)
                tried += 1
    if not tried:
        pytest.skip("it has no link on three legs")
