"""How linkages trace points, both ways, against the witness; and linkages that stray."""

import numpy as np
import pytest

from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.io.result import synthesis_data
from burmester.synthesis.judgement import judge_linkage
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.requirements import Requirements
from burmester.tasks.traced_path import TracedPath
from burmester.verdicts.tracing import Tracing
from tests.oracles.both_ways import from_path, from_segment, travelled
from tests.oracles.coupler_curves import dyads_of, random_crank, traced

VEE = np.column_stack([np.linspace(-1, 1, 17), np.abs(np.linspace(-2, 2, 17)) - 1])
# It passes all points of the vee within 0.003, and dives by 7 between two of them.
DIVER = Linkage(
    RR([-6.0348, -8.8757], [-5.4806, -8.8046], 4.7150),
    RR([1.2214, -1.0246], [-8.6965, -0.7595], 9.8335),
)


def task(points, *, path=True, closed=False, within=0.01, **given):
    poses = Displacement(points, np.zeros(len(points)))
    bounds = PoseTolerances.uniform(len(points), within, within, np.inf)
    return Task(poses, path=TracedPath(closed) if path else None, tolerances=bounds, **given)


def test_a_linkage_that_dives_between_two_points_is_not_usable():
    found = judge_linkage(task(VEE), DIVER)
    assert found.outcome.code == "R331"
    (one,) = found.linkages
    assert one.error.worst < 0.004
    (stray,) = one.defects
    assert stray.kind == "stray"
    assert stray.certain
    pieces = travelled(DIVER.first, DIVER.second, one.error.places, False)
    z = VEE @ [1, 1j]
    away = [from_segment(each, *z[k : k + 2]).max() for k, each in enumerate(pieces)]
    worst = int(np.argmax(away))
    assert stray.poses == (worst, worst + 1)
    assert f"between points {worst + 1} and {worst + 2}" in stray.message
    assert Tracing.of(one, found.task).to_path[1] == pytest.approx(away[worst], rel=1e-3)
    assert f"{away[worst]:.2g}" in stray.message


def test_points_in_any_order_have_no_path_between_them():
    asked = Requirements(any_order=True)
    found = judge_linkage(task(VEE, requirements=asked), DIVER)
    assert found.usable
    assert Tracing.of(found.linkages[0], found.task) is None


def test_of_few_points_a_stray_is_a_shortcoming():
    found = judge_linkage(task(VEE[::2], path=False), DIVER)
    (one,) = found.linkages
    assert one.usable
    assert any(each.startswith("leaves the path by 6") for each in one.shortcomings)


@pytest.mark.parametrize("closed", [True, False])
def test_both_ways_are_those_of_the_witness(closed):
    rng = np.random.default_rng(8)
    z, side = random_crank(rng)
    t = np.linspace(0, 2 * np.pi, 30, endpoint=False) if closed else np.linspace(1, 4, 30)
    curve = traced(dyads_of(z), side, t)
    curve = curve + 0.01 * (rng.normal(size=30) + 1j * rng.normal(size=30))
    points = np.column_stack([curve.real, curve.imag])
    asked = task(points, closed=closed, within=0.1)
    (one,) = judge_linkage(asked, Linkage(*dyads_of(z))).linkages
    assert not one.defects
    told, lead = Tracing.of(one, asked), one.driver_first
    pieces = travelled(lead.first, lead.second, one.error.places, closed)
    ends = np.append(curve, curve[:1])
    away = [from_segment(each, *ends[k : k + 2]) for k, each in enumerate(pieces)]
    share = np.concatenate([np.abs(np.diff(each)) for each in pieces])
    square = np.concatenate([(each[1:] ** 2 + each[:-1] ** 2) / 2 for each in away])
    rms = np.sqrt((square * share).sum() / share.sum())
    assert told.to_curve == pytest.approx((one.error.rms, one.error.worst))
    assert told.to_path == pytest.approx((rms, max(each.max() for each in away)), rel=0.02)
    assert told.to_path[1] >= from_path(np.concatenate(pieces), curve, closed).max() - 1e-6
    # Both of 100 points at equal steps, the warping path by brute recursion.
    lines = ends if closed else curve, np.concatenate(pieces)
    one_, two = (at_steps(each) for each in lines)
    apart = np.abs(one_[:, None] - two)
    chamfer = (apart.min(axis=1).mean() + apart.min(axis=0).mean()) / 2
    assert told.chamfer == pytest.approx(chamfer, rel=0.02)
    best = np.full((101, 101), np.inf)
    best[0, 0] = 0.0
    for i in range(100):
        for j in range(100):
            before = min(best[i, j], best[i, j + 1], best[i + 1, j])
            best[i + 1, j + 1] = apart[i, j] + before
    assert told.dtw == pytest.approx(best[100, 100] / 100, rel=0.02)


def at_steps(line):
    at = np.concatenate([[0], np.abs(np.diff(line)).cumsum()])
    return np.interp(np.linspace(0, at[-1], 100), at, line)


def test_the_json_tells_both_ways():
    (one,) = synthesis_data(judge_linkage(task(VEE), DIVER))["linkages"]
    assert [each["kind"] for each in one["defects"]] == ["stray"]
    assert one["tracing"]["curve_to_path"]["max"] > 6
    assert one["tracing"]["points_to_curve"] == one["position_error"]
