"""The dyads of a fit: their order, and which of them are links and which are sliders."""

import re
from dataclasses import replace

import numpy as np
import pytest

from burmester import PR, RR, Displacement, Task, dyads_of_five
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.selection import found_dyads
from burmester.synthesis.dyad_search import search_dyads
from burmester.synthesis.outcome import dyad_advice
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from tests.oracles.five_poses import ROWS
from tests.oracles.witness import places


def test_dyads_that_are_all_exact_come_by_the_lengths_of_their_links():
    """Their errors are rounding, and say nothing; in whatever order the poses come."""
    rng = np.random.default_rng(0)
    for _ in range(6):
        task = Task.from_rows(rng.permutation(ROWS), angle_unit="deg")
        found, left_out = found_dyads(dyads_of_five(task.poses), task)
        assert [each.id for each in found] == ["D1", "D2", "D3", "D4"]
        assert left_out == 0
        assert max(each.rms_error for each in found) < 1e-10
        lengths = [float(each.dyad.radius) for each in found]
        assert lengths == sorted(lengths)


def hinge(rng, count):
    """Poses of a hinge-like body with two decimals: a turn about a point that wanders a little."""
    turn = np.radians(rng.uniform(45, 110))
    angle = np.append(np.sort(rng.uniform(0, turn, count - 1)), turn)
    radius, off = rng.uniform(50, 400), rng.uniform(2, 20)
    arm = radius + off * np.cos(rng.uniform(1, 3) * angle + rng.uniform(0, 6))
    at = arm * np.exp(1j * (angle + rng.uniform(-3, 3)))
    body = np.degrees(angle) * rng.uniform(0.8, 1.2)
    rows = np.column_stack([at.real, at.imag, body]).round(2)
    rows[:, 2] = np.radians(rows[:, 2])
    return Task(Displacement.from_poses(rows), resolution=(5e-3, np.radians(5e-3)))


def swings(link, poses):
    """The ranges of a link's direction over the poses, in degrees: against F, and against M."""
    d = poses.translation[:, 0] + 1j * poses.translation[:, 1]
    turned = np.exp(1j * poses.angle)
    arm = d + turned * complex(*link.moving_pivot) - complex(*link.fixed_pivot)
    return [
        float(np.degrees(np.ptp(np.unwrap(np.sort(np.angle(each / each[0]))))))
        for each in (arm, arm / turned)
    ]


def test_a_link_that_swings_and_meets_the_poses_is_no_slider():
    """Of hinges, whose motion is small against their links: every such link is listed as it is."""
    rng = np.random.default_rng(0)
    long = 0
    for _ in range(25):
        task = hinge(rng, 5)
        exact = dyads_of_five(task.poses)
        links = [each.dyad for each in found_dyads(exact, task)[0] if isinstance(each.dyad, RR)]
        for k in np.flatnonzero(np.isfinite(exact.coefficients).all(axis=-1)):
            link = exact.dyads[k]
            if min(swings(link, task.poses)) > 6:
                long += float(link.radius) > 100
                gaps = [
                    np.abs(np.subtract(link.fixed_pivot, other.fixed_pivot)).max()
                    for other in links
                ]
                assert min(gaps, default=np.inf) < 1e-9 * (1 + float(link.radius))
    assert long > 5


def test_a_link_that_hardly_swings_is_the_slider_that_the_digits_cannot_tell_from_it():
    """A driven slider-crank, printed: with four decimals, none of its sliders becomes a link."""
    rng = np.random.default_rng(1)
    kept = exact = 0
    for _ in range(20):
        slide = rng.uniform(-3, 3)
        pair = (
            RR([0, 0], [0, 0], 1.0),
            slider(slide, rng.uniform(-0.3, 0.3), [rng.uniform(2, 3), rng.uniform(-1, 1)]),
        )
        z, phi = (each[0] for each in places(*pair, slide + np.linspace(0, 4, 9)))
        rows = np.column_stack([z.real, z.imag, np.degrees(phi)])
        if not np.isfinite(rows).all():
            continue
        kept += 1
        rows = rows.round(4)
        rows[:, 2] = np.radians(rows[:, 2])
        task = Task(Displacement.from_poses(rows), resolution=(5e-5, np.radians(5e-5)))
        found, _ = found_dyads(best_dyads(task.poses), task)
        near = [each for each in found if each.rms_error < 1e-3]
        assert sorted(type(each.dyad).__name__ for each in near) == ["PR", "RR"]
        few = replace(task, poses=task.poses[::2])
        found, _ = found_dyads(dyads_of_five(few.poses), few)
        exact += any(isinstance(each.dyad, PR) and each.rms_error < 1e-3 for each in found)
    assert kept > 10
    assert exact > kept / 2  # of five poses the digits often leave a long link, too


def slider(normal, offset, pivot):
    """A slider with its line at `normal` (radians)."""
    return PR(np.array(normal), np.array(offset), np.array(pivot))


def test_a_very_long_link_is_told_with_its_length_and_its_swing():
    """W204, for links longer than ten spans of the poses that swing by less than 6 degrees."""
    rng = np.random.default_rng(3)
    told = 0
    for _ in range(12):
        task = hinge(rng, 5)
        # A hinge hardly has such a link: poses on a flat arc, turning by a few degrees, do.
        rows = rng.uniform(-5, 5, (5, 3)) * [1, 1, 0.02]
        for poses in (task.poses, Displacement.from_poses(rows)):
            task = Task(poses)
            problem = SynthesisProblem.of(
                task, classify_motion(task), SynthesisOptions(method="exact")
            )
            search = search_dyads(problem)
            size = max(np.linalg.norm(np.ptp(poses.translation, axis=0)), problem.length)
            advice = dyad_advice(problem, search)
            words = [each.message for each in advice if each.code == "W204"]
            for each in search.dyads:
                mine = [text for text in words if text.startswith(f"{each.id} ")]
                wanted = False
                if isinstance(each.dyad, RR):
                    swing = min(swings(each.dyad, poses))
                    wanted = each.dyad.radius > 10 * size and swing < np.degrees(0.1)
                assert bool(mine) == wanted
                if wanted:
                    told += 1
                    spans, by = map(float, re.findall(r" (\d[\d.]*)", mine[0]))
                    assert spans == pytest.approx(float(each.dyad.radius) / size, abs=0.51)
                    assert by == pytest.approx(swing, rel=0.06)
    assert told
