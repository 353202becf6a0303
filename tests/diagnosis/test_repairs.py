"""Changes that make a pose agree, in cases made for one rule each."""

import numpy as np
import pytest
from scipy.stats import multivariate_t

from burmester import Displacement, Task
from burmester.diagnosis.odd_pose import odd_pose
from burmester.diagnosis.repairs import Repair, by_evidence
from burmester.io.cases import load
from tests.oracles.first_order import least_sum

RIGHT = np.array(load("ge2012-exact")["poses"])


def task_of(rows, resolution=(0.0, 0.0)):
    """Poses (N, 3), angles in degrees."""
    return Task(Displacement(rows[:, :2], np.radians(rows[:, 2])), resolution=resolution)


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


@pytest.mark.parametrize(("x", "first"), [(2e-6, "unit"), (2e-4, "slip")])
def test_the_likeliest_repair_comes_first(x, first):
    """Pose 3 has x of nearly nothing, and a tenth of its y: x and y times ten, or y alone.

    A unit comes first where it agrees as well, not where it misses by several deviations.
    """
    pose, rows = 2, RIGHT.copy()
    rows[:, 0] -= rows[pose, 0]
    rows[pose, 0] = x
    rows[pose, 1] /= 10
    task = task_of(rows, (5e-5, np.radians(5e-3)))
    odd = odd_pose(task)
    assert odd.pose == pose
    by_kind = {each.kind: each for each in odd.repairs}
    unit, slip = by_kind["unit"], by_kind["slip"]
    assert unit.values == pytest.approx([10 * x, RIGHT[pose, 1], np.radians(RIGHT[pose, 2])])
    assert slip.values == pytest.approx([x, RIGHT[pose, 1], np.radians(RIGHT[pose, 2])])
    assert (unit.miss > slip.miss + 1) == (first == "slip")
    assert odd.repairs[0].kind == first


def test_evidence_weighs_a_miss_by_how_well_the_deviation_is_known():
    """Student's distribution with 2 N - 12 degrees of freedom, against SciPy's."""
    values = np.zeros(3)
    for count in (7, 12, 40):
        at, off = (Repair("unit", "", values, miss).evidence(count) for miss in (0.0, 3.0))
        spare = 2 * count - 12  # two residuals
        density = multivariate_t(shape=np.eye(2), df=spare)
        assert at - off == pytest.approx(density.logpdf([0, 0]) - density.logpdf([3, 0]))
    exact, near, far = (Repair("slip", "", values, miss) for miss in (0.0, 2.0, 100.0))
    unit = Repair("unit", "", values, 100.0, prior=0.1)
    assert by_evidence([unit, far, near, exact], 10) == (exact, near, unit, far)


@pytest.mark.parametrize(
    ("pose", "number", "off", "strays"), [(4, 2, 3.0, False), (4, 0, 0.3, True), (6, 1, 0.2, True)]
)
def test_a_number_away_from_its_neighbours_is_told(pose, number, off, strays):
    """The turn lies between its neighbours; x and y are the extremes of the path."""
    rows = RIGHT.copy()
    rows[pose, number] += off
    odd = odd_pose(task_of(rows, (5e-5, np.radians(5e-3))))
    assert odd.pose == pose
    for each in odd.repairs:
        given, changed = rows[pose] * [1, 1, np.pi / 180], each.values
        beside = RIGHT[[pose - 1, pose + 1]] * [1, 1, np.pi / 180]

        def away(row, beside=beside):
            gap = row - beside
            turn = np.angle(np.exp(1j * gap[:, 2]))
            return np.linalg.norm(gap[:, :2], axis=1).sum(), np.abs(turn).sum()

        farther = any(b > a + 1e-9 for a, b in zip(away(given), away(changed), strict=True))
        assert each.strays == farther
        assert each.message.endswith(", but farther from its neighbours") == farther
    assert odd.repairs[0].strays == strays


def test_of_two_numbers_that_agree_the_one_near_its_neighbours_is_told():
    """A coupler passes most of the lines x = const twice; both places agree, one is near."""
    rows = RIGHT.copy()
    rows[4, 0] += 0.3
    odd = odd_pose(task_of(rows, (5e-5, np.radians(5e-3))))
    assert odd.pose == 4
    x = next(each for each in odd.repairs if each.kind == "x")
    assert x.values[0] == pytest.approx(RIGHT[4, 0], abs=1e-3)
