"""Paths, timed paths, poses and points: a linkage is judged as synthesis judged it, and by hand."""

import numpy as np
import pytest

from burmester.fourbar.cognates import cognates
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.traced_path import TracedPath
from tests.oracles.coupler_curves import dyads_of, random_crank, traced
from tests.oracles.witness import places

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


def told(found):
    kinds = [each.kind for each in found.defects], [each.kind for each in found.violations]
    return found.usable, *kinds, found.type


@pytest.mark.parametrize("name", TASKS)
def test_every_linkage_of_synthesis_is_judged_as_synthesis_did(name):
    task = TASKS[name]()
    synthesis = synthesize(task)
    assert synthesis.usable
    for found in synthesis.linkages:
        judged = judge_linkage(task, found.linkage)
        (own,) = judged.linkages
        assert judged.outcome.code == ("R330" if found.usable else "R331")
        assert told(own) == told(found)
        size = 1e-9 * synthesis.length
        assert own.error.position == pytest.approx(found.error.position, abs=size)
        assert own.within_tolerance == pytest.approx(found.within_tolerance, abs=1e-6)
        assert own.driven.least_over_range == pytest.approx(found.driven.least_over_range, abs=1e-7)
        codes = [{e.code for e in each.warnings} - {"W210"} for each in (judged, synthesis)]
        assert codes[0] == codes[1]
