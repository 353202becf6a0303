"""Tasks with points: every four-bar through them, judged at its own angles."""

import json

import numpy as np
import pytest

from burmester.geometry.displacement import Displacement
from burmester.io.result import synthesis_data
from burmester.points.point_sets import point_set
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances
from tests.oracles.witness import missed

CRANK, COUPLER, FOLLOWER, GROUND, POINT = 1.0, 2.6, 2.4, 2.8, 1.2 + 0.9j


def of_crank_rocker(degrees, is_point):
    """A task that a known crank-rocker meets, driven here by its closed form."""
    a = CRANK * np.exp(1j * np.radians(degrees))
    to = GROUND - a
    open_ = np.arccos((COUPLER**2 + abs(to) ** 2 - FOLLOWER**2) / (2 * COUPLER * abs(to)))
    turn = to / abs(to) * np.exp(1j * open_)
    p = a + turn * POINT
    free = np.where(is_point, np.inf, 0.0)
    return Task(
        Displacement(np.column_stack([p.real, p.imag]), np.where(is_point, 0, np.angle(turn))),
        tolerances=PoseTolerances(np.zeros((len(p), 2)), free),
    )


def test_the_linkage_that_made_the_points_is_found_and_works():
    is_point = np.array([0, 0, 1, 0, 1, 0], dtype=bool)
    task = of_crank_rocker(np.array([20, 50, 85, 120, 160, 200]), is_point)
    synthesis = synthesize(task)
    assert synthesis.outcome.code == "R340"
    best = synthesis.linkages[0]
    assert best.usable
    assert sorted(best.linkage.links) == pytest.approx([1.0, 2.4, 2.6, 2.8], abs=1e-6)
    for each in synthesis.linkages:
        rows = np.column_stack([each.error.places.translation, each.error.places.angle])
        assert max(missed(each.linkage, row) for row in rows) < 1e-6
        assert np.abs(rows[:, :2] - task.poses.translation).max() < 1e-6
        assert each.error.angle.max() < 1e-6
    (search,) = synthesis_data(synthesis)["search"]
    assert (search["classes"], search["found"], search["lost"]) == (30, 30, 0)
    assert search["real"] == len(synthesis.linkages)
    json.dumps(search)


def test_nine_points_on_a_circle_are_told():
    angle = np.linspace(0, 3, 9)
    points = 2 + 5 * np.column_stack([np.cos(angle), np.sin(angle)])
    free = PoseTolerances(np.zeros((9, 2)), np.full(9, np.inf))
    synthesis = synthesize(Task(Displacement(points, np.zeros(9)), tolerances=free))
    assert synthesis.outcome.code == "R343"
    assert "(2, 2) with the length 5" in synthesis.outcome.why


def test_curves_that_points_lie_on_are_recognised():
    t = np.array([0.1, 0.4, 0.9, 1.7, 2.2, 3.1, 4.0])
    ellipse = np.column_stack([3 * np.cos(t) + 7, np.sin(t) + np.cos(t)])
    assert point_set(ellipse).kind == "conic"
    assert point_set(ellipse + 1e-3 * np.column_stack([t**3, t**2])) is None
    assert point_set(np.column_stack([t, 2 * t - 1])).kind == "line"
    assert point_set(np.column_stack([np.cos(t), np.sin(t)])).kind == "circle"
