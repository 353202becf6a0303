"""Paths, timed paths, poses and points: a linkage is judged as synthesis judged it, and by hand."""

from dataclasses import replace

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.fourbar.cognates import cognates
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.synthesis.given_linkage import OpenLink
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.requirements import Requirements
from burmester.tasks.traced_path import TracedPath
from tests.oracles.coupler_curves import distances, dyads_of, random_crank, traced
from tests.oracles.witness import missed, places

TURNS = np.array([0.0, 0.5, 1.1, 1.6, 2.4, 3.3, 4.1])
ROUND = np.linspace(0, 2 * np.pi, 24, endpoint=False)


def made(seed, t, noise=0.0):
    """A linkage that an independent code drives, and the points that it comes to, perhaps noisy."""
    rng = np.random.default_rng(seed)
    z, side = random_crank(rng)
    p = traced(dyads_of(z), side, t)
    p = p + noise * np.sqrt(np.var(p)) * (rng.normal(size=len(t)) + 1j * rng.normal(size=len(t)))
    return Linkage(*dyads_of(z)), np.column_stack([p.real, p.imag])


def path(points, *, closed=False, turns=None):
    return Task(Displacement(points, np.zeros(len(points))), path=TracedPath(closed, turns))


def mixed(seed, is_point):
    """Poses, and points among them, of a linkage that is driven here."""
    rng = np.random.default_rng(seed)
    z, side = random_crank(rng)
    where, phi = places(*dyads_of(z), np.linspace(0.3, 3.6, len(is_point)))
    d, angle = where[side], np.where(is_point, 0.0, phi[side])
    free = PoseTolerances(np.zeros((len(d), 2)), np.where(is_point, np.inf, 0.0))
    poses = Displacement(np.column_stack([d.real, d.imag]), angle)
    return Linkage(*dyads_of(z)), Task(poses, tolerances=free)


TASKS = {
    "closed": lambda: path(made(0, ROUND, 0.01)[1], closed=True),
    "open": lambda: path(made(3, 0.7 + np.linspace(0, 2.5, 12), 0.02)[1]),
    "timed": lambda: path(made(5, TURNS + 1.0, 0.02)[1], turns=TURNS),
    "four poses, two points": lambda: mixed(1, np.array([0, 1, 0, 0, 1, 0], dtype=bool))[1],
    "three poses, four points": lambda: mixed(2, np.array([0, 1, 1, 0, 1, 1, 0], dtype=bool))[1],
}


def linkage_sides(linkage):
    return linkage.first, linkage.second


def told(found):
    kinds = [each.kind for each in found.defects], [each.kind for each in found.violations]
    return found.usable, *kinds, found.type


@pytest.mark.parametrize("name", TASKS)
def test_every_linkage_of_synthesis_is_judged_as_synthesis_did(name):
    task = TASKS[name]()
    synthesis = synthesize(task)
    assert synthesis.usable
    for found in synthesis.linkages:
        # What synthesis assumed is stated then, and assumed again for the last one.
        asked = task if found is synthesis.linkages[-1] else synthesis.task
        judged = judge_linkage(asked, found.linkage)
        (own,) = judged.linkages
        assert judged.outcome.code == ("R330" if found.usable else "R331")
        assert told(own) == told(found)
        size = 1e-9 * synthesis.length
        assert own.error.position == pytest.approx(found.error.position, abs=size)
        assert own.error.angle == pytest.approx(found.error.angle, abs=1e-9)
        assert own.driven.least_over_range == pytest.approx(found.driven.least_over_range, abs=1e-7)
        if task.path is not None:
            assert own.within_tolerance == pytest.approx(found.within_tolerance, abs=1e-6)
    assumed = [{e.code for e in each.warnings} & {"W226"} for each in (judged, synthesis)]
    assert assumed[0] == assumed[1] == ({"W226"} if task.path is not None else set())


ASKED = Requirements(within=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_the_linkage_that_made_a_path_has_no_error_nor_have_its_cognates(seed):
    for t, closed in ((ROUND, True), (0.7 + np.linspace(0, 2.5, 12), False)):
        linkage, points = made(seed, t)
        task = replace(path(points, closed=closed), requirements=ASKED)
        judged = judge_linkage(task, linkage)
        assert judged.outcome.code == "R330"
        for each in (linkage, *cognates(linkage)):
            (own,) = judge_linkage(task, each).linkages
            assert own.error.worst < 1e-9
            # Driven by code of its own, it stands where it is said to stand.
            rows = np.column_stack([own.error.places.translation, own.error.places.angle])
            assert max(missed(each, row) for row in rows) < 1e-8
    back = replace(path(points[::-1]), requirements=ASKED)
    assert judge_linkage(back, linkage).outcome.code == "R330"  # either sense will do
    mixed_up = replace(path(points[np.argsort(points[:, 0] % 0.01)]), requirements=ASKED)
    assert judge_linkage(mixed_up, linkage).outcome.code == "R331"
    any_order = replace(mixed_up, requirements=replace(ASKED, any_order=True))
    assert judge_linkage(any_order, linkage).outcome.code == "R330"


@pytest.mark.parametrize("seed", range(3))
def test_a_timed_path_counts_at_the_angles_of_its_crank(seed):
    linkage, points = made(seed, TURNS + 1.0)
    task = replace(path(points, turns=TURNS), requirements=ASKED)
    for each in (linkage, Linkage(linkage.second, linkage.first)):
        judged = judge_linkage(task, each)
        (own,) = judged.linkages
        assert judged.outcome.code == "R330"
        assert own.error.worst < 1e-9
        assert own.driver_first.first.radius == linkage.first.radius  # the crank drives
    # The cognate with a crank that turns alike has the timing too, the others have not.
    errors = sorted(judge_linkage(task, each).linkages[0].error.worst for each in cognates(linkage))
    assert errors[0] < 1e-9
    assert errors[1] > 1e-3
    # Other timings of the same points: the least sum of squares over all phases, by brute force.
    late = TURNS + np.where(TURNS > 2, 0.2, 0.0)
    (own,) = judge_linkage(replace(task, path=TracedPath(False, late)), linkage).linkages
    wanted = points[:, 0] + 1j * points[:, 1]
    phases = np.linspace(0, 2 * np.pi, 20001)[:, None] + late
    sums = [
        (np.abs(places(*pair, phases.ravel())[0].reshape(2, *phases.shape) - wanted) ** 2).sum(-1)
        for pair in ((linkage.first, linkage.second), (linkage.second, linkage.first))
    ]
    assert (own.error.position**2).sum() == pytest.approx(np.nanmin(sums), rel=1e-4)


def test_pivots_alone_and_what_cannot_be_improved():
    linkage, points = made(3, TURNS)
    pivots = [OpenLink(each.fixed_pivot, each.moving_pivot) for each in linkage_sides(linkage)]
    for task in (path(points), path(points, turns=TURNS)):
        with pytest.raises(InputError, match="E158"):
            judge_linkage(task, pivots)
    with pytest.raises(InputError, match="E159"):
        judge_linkage(path(points, turns=TURNS), linkage, improve=True)
    # Poses say how long the links are, and points beside them do not.
    linkage, task = mixed(1, np.array([0, 1, 0, 0, 1, 0], dtype=bool))
    pivots = [OpenLink(each.fixed_pivot, each.moving_pivot) for each in linkage_sides(linkage)]
    (own,) = judge_linkage(task, pivots).linkages
    assert own.error.worst < 1e-9


def test_better_linkages_near_one_trace_the_path_by_hand():
    linkage, points = made(0, ROUND, 0.01)
    bent = Linkage(
        *(RR(e.fixed_pivot + 0.02, e.moving_pivot - 0.01, e.radius) for e in linkage_sides(linkage))
    )
    task = replace(path(points, closed=True), requirements=Requirements(within=0.01))
    given, *near = judge_linkage(task, bent, improve=True).linkages
    assert not given.usable
    assert near
    for each in near:
        assert each.usable
        one = each.driver_first
        assert distances((one.first, one.second), points).max() < 0.01 * np.sqrt(2)


@pytest.mark.parametrize("name", ["four poses, two points", "timed"])
def test_rounded_dimensions_miss_by_about_their_step(name):
    task, step = TASKS[name](), 1e-4
    if task.path is not None:
        task = replace(task, requirements=Requirements(within=0.02))
    for each in synthesize(task, SynthesisOptions(rounding_step=step)).linkages:
        before = each.error_before_rounding
        growth = each.error.worst - before.worst
        assert each.quality is None or growth < 2 * step * float(each.quality.sensitivity)
