"""Linkages assessed in one batch, held against linkages that are driven over a fine sweep."""

import numpy as np

from burmester.dyads.three_poses import dyad_with_moving_pivot
from burmester.families.assessment import assessed
from burmester.families.open_task import OpenTask, Trials
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.from_dyads import target_of
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.assumptions import Assumptions
from tests.oracles.pair_verdicts import verdict

ROWS = [(0, 0, 0), (30, 77, 45), (95, 110, 95)]


def test_angles_and_branches_are_those_of_a_fine_sweep():
    task = Task.from_rows(ROWS, angle_unit="deg")
    problem = SynthesisProblem.of(task, None, SynthesisOptions())
    target = target_of(problem)
    open_task = OpenTask.of(problem, target, Assumptions.of(problem))
    pins = np.random.default_rng(8).uniform(-150, 150, (120, 2, 2))
    pairs = [tuple(dyad_with_moving_pivot(task.poses, pin) for pin in pair) for pair in pins]
    batch = LinkageBatch.of([Linkage(*pair) for pair in pairs]).to_canonical(target.frames)
    still = np.zeros((len(pairs), 3, 3))
    sides = [
        assessed(Trials(batch, still, np.full(len(pairs), side)), open_task) for side in (0, 1)
    ]
    transmission = np.max([side.transmission for side in sides], axis=0)
    seen = set()
    for k, pair in enumerate(pairs):
        told = verdict(pair, task.poses, float(np.hypot(95, 110)))
        if told is None:
            continue
        name, angle = told
        seen.add(name)
        if name in {"branch", "circuit"}:  # below zero: how far it is on the other side
            assert transmission[k] < 0
        elif name in {"works", "below"}:
            assert np.isclose(np.degrees(transmission[k]), angle, atol=0.05)
        if name != "works":
            assert not any(side.good[k] for side in sides)
    assert {"works", "below", "branch"} <= seen
