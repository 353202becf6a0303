"""Changes that make a pose agree, in cases made for one rule each."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester import Displacement, Task
from burmester.diagnosis.odd_pose import odd_pose
from burmester.diagnosis.repairs import Prediction, repairs_of
from burmester.diagnosis.sampson_fits import NormalizedPoses
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.io.cases import load

RIGHT = np.array(load("ge2012-exact")["poses"])


def task_of(rows, resolution=(0.0, 0.0)):
    """Poses (N, 3), angles in degrees."""
    return Task(Displacement(rows[:, :2], np.radians(rows[:, 2])), resolution=resolution)


def least_sum(odd, poses):
    """The least sum of squared distances of a pair of circles, to first order, by SciPy."""
    d, turn = poses.translation @ [1, 1j], np.exp(1j * poses.angle)

    def residual(z):
        forces, gaps = [], []
        for c1, c2, m1, m2, r in z.reshape(2, 5):
            arm = d + turn * (m1 + 1j * m2) - c1 - 1j * c2
            along = arm / abs(arm)
            moment = (np.conj(1j * turn * (m1 + 1j * m2)) * along).real / odd.length
            forces.append(np.stack([along.real, along.imag, moment], axis=-1))
            gaps.append(abs(arm) - r)
        force, gap = np.stack(forces, axis=1), np.stack(gaps, axis=1)
        lower = np.linalg.cholesky(force @ np.swapaxes(force, 1, 2))
        return np.linalg.solve(lower, gap[..., None]).ravel()

    dyads = odd.linkage.first, odd.linkage.second
    start = np.concatenate([[*d.fixed_pivot, *d.moving_pivot, d.radius] for d in dyads])
    end = least_squares(residual, start, x_scale="jac", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return 2 * end.cost


@pytest.mark.parametrize(("pose", "number"), [(7, 1), (8, 1), (4, 0)])
def test_what_a_repair_misses_counts_in_standard_deviations(pose, number):
    """Its square is what the repaired pose adds to the sum of squares, over the variance.

    Two misses a pose, ten dimensions: nine poses leave 2 x 9 - 10 = 8 for the variance.
    """
    noise = np.random.default_rng(0).normal(size=RIGHT.shape) * [2e-3, 2e-3, 0.02]
    rows = RIGHT + noise
    rows[pose, number] *= -1
    task = task_of(rows)
    odd = odd_pose(task)
    assert odd.pose == pose
    repair = next(each for each in odd.repairs if each.kind == "sign")
    keep = np.arange(10) != pose
    without = least_sum(odd, task.poses[keep])
    assert np.sqrt(without / 9) == pytest.approx(odd.error_without, rel=1e-3)
    given = np.column_stack([task.poses.translation, task.poses.angle])
    given[pose] = repair.values
    more = least_sum(odd, Displacement.from_poses(given)) - without
    assert repair.miss == pytest.approx(np.sqrt(more / (without / 8)), rel=0.04)


def test_a_unit_comes_before_a_number_that_fits_better():
    """Pose 3 has x of nearly nothing, and a tenth of its y: x and y times ten, or y alone."""
    pose, rows = 2, RIGHT.copy()
    rows[:, 0] -= rows[pose, 0]
    rows[pose, 0] = 2e-4
    rows[pose, 1] /= 10
    task = task_of(rows, (5e-5, np.radians(5e-3)))
    odd = odd_pose(task)
    assert odd.pose == pose
    seen = NormalizedPoses.of(task.poses, None)
    linkage = LinkageBatch.of([odd.linkage]).to_canonical(seen.frames)
    sigma = odd.error_without / odd.length * np.sqrt(9 / 8)
    unit, slip, *_ = repairs_of(seen, Prediction.of(seen, linkage, pose, sigma), pose, task)
    assert (unit.kind, slip.kind) == ("unit", "slip")
    assert unit.values == pytest.approx([2e-3, RIGHT[pose, 1], np.radians(RIGHT[pose, 2])])
    assert slip.values == pytest.approx([2e-4, RIGHT[pose, 1], np.radians(RIGHT[pose, 2])])
    assert unit.miss > 2 * slip.miss
    assert odd.repairs[0].kind == "unit"
