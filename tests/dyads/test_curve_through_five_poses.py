"""Four poses and five: the dyads of a fifth pose are on the curve of the first four."""

import numpy as np
import pytest

from burmester.dyads.burmester_curve import dyad_curve
from burmester.dyads.five_poses import dyads_of_five
from burmester.geometry.displacement import Displacement
from tests.oracles.witness import random_four_bar, random_poses, span


def on_sphere(points, centre, size):
    """Points as directions (X, Y, size), so that infinity is a place like others."""
    v = np.column_stack([points - centre, np.full(len(points), size)])
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def apart(a, b):
    """Chordal distance between directions up to sign."""
    return np.minimum(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))


@pytest.mark.parametrize("seed", range(15))
def test_dyads_of_a_fifth_pose_are_on_the_curve_of_four(seed):
    rng = np.random.default_rng(seed)
    rows = random_poses(random_four_bar(rng), rng, 5)
    curve = dyad_curve(Displacement.from_poses(rows[:4]), samples=2000)
    five = dyads_of_five(Displacement.from_poses(rows))
    real = five.dyads[five.real]
    centre, size = rows[:, :2].mean(axis=0), span(rows)
    centres = np.vstack([component.fixed_pivot for component in curve.components])
    circles = np.vstack([component.moving_pivot for component in curve.components])
    for c, m in zip(real.fixed_pivot, real.moving_pivot, strict=True):
        fixed = apart(on_sphere(c[None], centre, size), on_sphere(centres, centre, size))
        moving = apart(on_sphere(m[None], 0, size), on_sphere(circles, 0, size))
        assert np.hypot(fixed, moving).min() < 0.05
