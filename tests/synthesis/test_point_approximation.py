"""More poses and points than a four-bar can meet: the nearest, and what is assumed."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.point_approximation import nearest_linkage, with_nearest_angles
from burmester.synthesis.point_conditions import point_conditions
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.requirements import Requirements
from tests.oracles.witness import missed
from tests.samples import samples

LENGTH = 2.0  # that a radian counts as
OPTIONS = SynthesisOptions(length_per_radian=LENGTH)


def coupler(links, angles, sign=1):
    """Places of a crank-driven four-bar in closed form: points of the body, and its turn."""
    x, y, crank, coupler, follower, gx, gy, cx, cy, offset = links
    pin = x + 1j * y + crank * np.exp(1j * angles)
    to = gx + 1j * gy - pin
    cosine = (coupler**2 + abs(to) ** 2 - follower**2) / (2 * coupler * abs(to))
    turn = to / abs(to) * np.exp(1j * sign * np.arccos(np.clip(cosine, -1, 1)))
    return pin + (cx + 1j * cy) * turn, np.angle(turn) + offset


def noisy_task(seed, poses, points, noise):
    """Rows of a random crank-rocker, with noise; its links and crank angles."""
    rng = np.random.default_rng(seed)
    links = np.array([5, 3, 1, rng.uniform(2.4, 2.8), rng.uniform(2.2, 2.6), 7.8, 3, 1.2, 0.9, 0])
    angles = np.sort(rng.uniform(0.4, 3.6, poses + points))
    p, turn = coupler(links, angles)
    p = p + noise * (rng.normal(size=p.shape) + 1j * rng.normal(size=p.shape))
    turn = turn + noise / LENGTH * rng.normal(size=turn.shape)
    is_point = np.ones(len(p), dtype=bool)
    is_point[np.linspace(0, len(p) - 1, poses).astype(int)] = False
    rows = np.column_stack([p.real, p.imag, np.where(is_point, np.nan, turn)])
    tolerances = PoseTolerances(np.zeros((len(p), 2)), np.where(is_point, np.inf, 0.0))
    task = Task.from_rows(rows, angle_unit="rad", tolerances=tolerances)
    return task, links, angles


def rms(task, places):
    """The root of the mean squared error, a radian as LENGTH; points have no angle."""
    away = np.linalg.norm(places.translation - task.poses.translation, axis=-1)
    turn = np.angle(np.exp(1j * (places.angle - task.poses.angle)))
    return np.sqrt((away**2 + np.where(task.free_angles, 0, LENGTH * turn) ** 2).mean())


def least_of_scipy(task, links, angles):
    """The same of SciPy's local minimum near the linkage that made the rows."""
    p, free = task.poses.translation @ [1, 1j], task.free_angles

    def residual(v):
        at, turn = coupler(v[:10], v[10:])
        off = np.angle(np.exp(1j * (turn - task.poses.angle)))[~free] * LENGTH
        return np.concatenate([(at - p).real, (at - p).imag, off])

    found = least_squares(residual, np.concatenate([links, angles]), xtol=1e-12, ftol=1e-12)
    return np.sqrt((found.fun**2).sum() / len(p))


def test_a_descent_from_the_linkage_that_made_the_rows_ends_hardly_nearer():
    """Many linkages come near to few rows, and not all of them are found."""
    ratios = []
    for seed in samples(40, 4):
        poses, points = [(4, 8), (6, 6), (3, 10), (5, 3)][seed % 4]
        task, links, angles = noisy_task(seed, poses, points, 0.005)
        nearest = nearest_linkage(task, OPTIONS)
        assert nearest.usable
        ratios.append(rms(task, nearest.error.places) / least_of_scipy(task, links, angles))
    ratios = np.array(ratios)
    assert (ratios < 1.1).mean() > 0.9
    assert ratios.max() < 1.5


@pytest.fixture(scope="module")
def answer():
    task, *_ = noisy_task(0, 4, 8, 0.005)
    return task, synthesize(task, OPTIONS)


def test_what_is_listed_is_driven_within_the_tolerance_that_is_told(answer):
    task, synthesis = answer
    assert synthesis.outcome.code == "R300"
    stated = synthesis.problem.given.tolerances
    (assumed,) = [each for each in synthesis.warnings if each.code == "W226"]
    x, y, angle = map(float, assumed.help.split()[-1].split(","))
    assert (stated.position == [x, y]).all()
    assert np.degrees(stated.angle[~task.free_angles]) == pytest.approx(angle)
    for each in synthesis.usable:
        places = each.error.places
        rows = np.column_stack([places.translation, places.angle])
        assert max(missed(each.linkage, row) for row in rows) < 1e-6
        away = np.abs(places.translation - task.poses.translation)
        turn = np.abs(np.angle(np.exp(1j * (places.angle - task.poses.angle))))
        assert (away <= stated.position * (1 + 1e-6)).all()
        assert (turn[~task.free_angles] <= stated.angle[~task.free_angles] * (1 + 1e-6)).all()


def test_what_is_found_is_judged_as_usable(answer):
    task, synthesis = answer
    best = synthesis.usable[0]
    judged = judge_linkage(task, best.linkage, OPTIONS)
    assert judged.outcome.code == "R330"
    assert "W226" in [each.code for each in judged.warnings]
    assert judged.problem.given.tolerances.bounds.tolist() == (
        synthesis.problem.given.tolerances.bounds.tolist()
    )


@pytest.mark.parametrize("shift", [2.0, -2.5])
def test_what_angles_stand_at_points_counts_for_nothing(shift):
    """Those that a task has there, from a file or from neighbours, are replaced."""
    task, links, angles = noisy_task(1, 6, 6, 0.005)
    turned = np.where(task.free_angles, task.poses.angle + shift, task.poses.angle)
    other = replace(task, poses=Displacement(task.poses.translation, turned))
    found, _ = with_nearest_angles(other, OPTIONS)
    off = np.exp(1j * (found.poses.angle - coupler(links, angles)[1]))
    assert np.abs(np.angle(off)).max() < 0.03


def test_exact_rows_give_back_the_linkage():
    task, links, _ = noisy_task(2, 4, 8, 0.0)
    nearest = nearest_linkage(task, OPTIONS)
    made = [*links[2:5], np.hypot(links[5] - links[0], links[6] - links[1])]
    assert sorted(nearest.linkage.links) == pytest.approx(sorted(made), abs=1e-5)
    assert rms(task, nearest.error.places) < 1e-7


def test_of_many_rows_some_say_the_angles_at_all():
    task, links, angles = noisy_task(4, 8, 400, 0.001)
    nearest = nearest_linkage(task, OPTIONS)
    assert rms(task, nearest.error.places) < 0.002
    off = np.exp(1j * (nearest.error.places.angle - coupler(links, angles)[1]))
    assert np.abs(np.angle(off)).max() < 0.01


def test_pivots_and_marks_are_kept():
    task, links, _ = noisy_task(3, 4, 8, 0.005)
    at = Point((links[0] + 0.02, links[1]))
    given = replace(task, exact=np.arange(12) == 0, limits=(Limits(), Limits(fixed_pivot=at)))
    assert "more than a four-bar can meet" in point_conditions(given).in_words()
    nearest = nearest_linkage(given, OPTIONS)
    assert nearest.dyads[1].dyad.fixed_pivot == pytest.approx(at.at, abs=1e-9)
    assert nearest.error.position[0] < 1e-6
    assert nearest.error.angle[0] < 1e-6
    assert nearest.error.position[1:].max() > 1e-4
    stated = with_nearest_angles(given, OPTIONS)[0].tolerances
    assert stated.exact_poses.tolist() == [True] + 11 * [False]


def test_an_error_that_is_accepted_is_the_tolerance():
    """More room, more transmission: what free angles differ by does not end the search."""
    nan = np.nan
    rows = [(26.01, 37.28, 46.89), (27.14, 43.66, nan), (23.78, 47.6, 29.6), (17.47, 48.8, nan)]
    rows += [(10.05, 47.01, 24.46), (2.92, 42.56, nan), (-2.79, 36.18, 28.07), (-6.42, 28.96, nan)]
    free = np.where(np.isnan([row[2] for row in rows]), np.inf, 0.0)
    task = Task.from_rows(
        rows,
        angle_unit="deg",
        tolerances=PoseTolerances(np.zeros((8, 2)), free),
        requirements=Requirements(within=0.1),
    )
    synthesis = synthesize(task)
    assert "W226" not in [each.code for each in synthesis.warnings]
    best = synthesis.usable[0]
    assert best.error.worst <= 0.1
    near = nearest_linkage(replace(task, requirements=Requirements()), SynthesisOptions())
    assert np.degrees(best.driven.least_over_range - near.driven.least_over_range) > 4
