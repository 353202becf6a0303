"""Linkages of pairs of dyads, in cases made for one rule each."""

from dataclasses import replace

import numpy as np

from burmester import Displacement, read_task
from burmester.linkages.from_dyads import linkages_from_dyads
from burmester.progress import shown
from burmester.refinement.target import Target
from burmester.synthesis.dyad_search import search_dyads, with_method
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem


def misses_of(linkages, length):
    """The sum of squared distances of each linkage by the names of its dyads."""
    return {
        frozenset(dyad.id for dyad in each.dyads): float(
            (each.error.position**2 + (length * each.error.angle) ** 2).sum()
        )
        for each in linkages
    }


def test_a_refinement_that_comes_out_worse_is_not_taken(monkeypatch):
    """Refined for other poses on purpose, a linkage stays as its dyads make it."""
    task = read_task("case:ge2012-exact")
    problem = SynthesisProblem.of(task, classify_motion(task), SynthesisOptions())
    problem = with_method(problem)
    pairs, _ = search_dyads(problem).pairs(problem.length)

    def misses(**how):
        linkages = linkages_from_dyads(problem, pairs, **how)
        return misses_of(linkages, problem.length_per_radian)

    plain, better = misses(refine=False), misses()
    assert better.keys() == plain.keys()
    assert all(better[own] < plain[own] for own in plain)

    def astray(self, *linkages, refine=Target.refine, **how):
        away = np.array([0.3, 0.2]) * np.cos(np.arange(10))[:, None]
        poses = Displacement(self.poses.translation + away, self.poses.angle)
        return refine(replace(self, poses=poses), *linkages, **how)

    monkeypatch.setattr(Target, "refine", astray)
    kept = misses()
    assert kept.keys() == plain.keys()
    # One that is nowhere near the poses may be judged on another circuit than it was refined on.
    near = [own for own in plain if plain[own] < 10]
    assert len(near) == 9
    assert all(kept[own] <= plain[own] for own in near)
    assert kept[frozenset(("D1", "D2"))] == plain[frozenset(("D1", "D2"))]


def test_a_linkage_that_works_is_as_close_as_another_within_rounding():
    """All pairs of dyads of five poses meet them, and rounding alone says which is the closest."""
    poses, heard = read_task("case:motiongen-shoulder").poses, []
    with shown(heard.append):
        for k in range(6):
            turned = Displacement.from_poses([0.3 * k, -k, k]) @ poses
            found = synthesize(Task(turned)).linkages
            assert sum(each.usable for each in found) == 3
            assert not any(each.from_search for each in found)
    assert heard
    assert not any("linkages that work" in str(each) for each in heard)
