"""Linkages of stacks: errors and verdicts of all pairs are those of the road of one task."""

from itertools import combinations

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.linkages.from_dyads import linkages_from_dyads
from burmester.stacked import LinkageRows, StackedAnswers, TaskStack, stacked_answers
from burmester.synthesis.dyad_search import search_dyads, with_method
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from tests.oracles.mixed_tasks import mixed_tasks

NEAR = 1e-7  # relative, of an error that is no rounding
MET = 1e-9  # of the size of the poses
CLEAR = 1e-3  # degrees; a linkage that transmits by less is at a dead point


def unrefined(task):
    """The pairs of dyads of one task, and the linkages that they are, not refined."""
    problem = SynthesisProblem.of(task, classify_motion(task), SynthesisOptions())
    if problem.is_special or max(problem.missing_conditions) > 0:
        return [], ()
    problem = with_method(problem)
    pairs, _ = search_dyads(problem).pairs(problem.length)
    return pairs, linkages_from_dyads(problem, pairs, refine=False)


def verdict_of(found):
    return found.defects[0].kind if found.defects else "usable"


@pytest.mark.parametrize(("count", "weighted"), [(5, False), (10, True)])
def test_pairs_are_judged_as_the_road_of_one_task_judges_them(count, weighted):
    rows, names = mixed_tasks(count, seed=2)
    weights = np.random.default_rng(1).uniform(0.5, 2.0, rows.shape[:2]) if weighted else None
    stack = TaskStack(rows, weights=weights)
    answers = stacked_answers(stack, "linkages")
    told, seen = answers.linkages, set()
    for k, name in enumerate(names):
        try:
            pairs, linkages = unrefined(stack.task(k))
        except InputError:
            pairs, linkages = [], ()
        here = np.flatnonzero(told.task == k)
        if answers.OUTCOMES[answers.outcome[k]] == "special motion":
            continue
        at = {frozenset((told.first[row], told.second[row])): row for row in here}
        assert len(at) == len(here) <= len(pairs), name
        size = np.abs(rows[k, :, :2]).max()
        for found in linkages:
            one, two = (int(each.id[1:]) - 1 for each in found.dyads)
            row = at[frozenset((one, two))]
            verdict = LinkageRows.VERDICTS[told.verdict[row]]
            seen.add(verdict)
            assert (name, verdict) == (name, verdict_of(found))
            # At a dead point rounding says which side drives better, and where it goes.
            clear = found.quality is None or np.degrees(found.quality.transmission) > CLEAR
            assert not clear or (told.first[row], told.second[row]) == (one, two), name
            assert LinkageRows.TYPES[told.type[row]] == found.type
            turn = np.degrees(found.error.angle.max())
            for mine, theirs in (
                (told.combined[row], found.combined_error),
                (told.worst[row], found.error.worst),
                (told.rms[row], found.error.rms),
                (told.angle_worst_deg[row], turn if np.isfinite(turn) else np.inf),
            ):
                assert mine == pytest.approx(theirs, rel=NEAR, abs=MET * size), name
            if found.quality is None:
                continue
            least = np.degrees(found.quality.transmission)
            assert told.transmission_deg[row] == pytest.approx(
                least, abs=1e-4 if clear else CLEAR, nan_ok=True
            )
            if clear:
                extent = float(found.quality.extent)
                assert told.extent[row] == pytest.approx(extent, rel=1e-5, nan_ok=True)
                sensitivity = float(found.quality.sensitivity)
                assert told.sensitivity[row] == pytest.approx(sensitivity, rel=1e-4)
    assert "usable" in seen
    assert len(seen) >= 4


def test_every_pair_is_there_once_and_the_best_usable_one_first():
    rows, _ = mixed_tasks(10, seed=3)
    answers = stacked_answers(TaskStack(rows), "linkages")
    told, count = answers.linkages, np.bincount(answers.dyads.task, minlength=len(rows))
    for k in np.flatnonzero(answers.outcome == StackedAnswers.OUTCOMES.index("solved")):
        here = told.task == k
        pairs = {tuple(sorted(p)) for p in zip(told.first[here], told.second[here], strict=True)}
        assert pairs <= set(combinations(range(count[k]), 2))
        assert len(pairs) >= count[k] - 1
        usable = told.verdict[here] == LinkageRows.VERDICTS.index("usable")
        assert usable[0]
        assert (np.diff(usable.astype(int)) <= 0).all()
        assert (np.diff(told.combined[here][usable]) >= 0).all()


def test_a_task_without_a_usable_pair_is_told():
    rows, names = mixed_tasks(10)
    answers = stacked_answers(TaskStack(rows), "linkages")
    for k, code in enumerate(answers.code):
        told = answers.linkages.verdict[answers.linkages.task == k]
        word = answers.OUTCOMES[answers.outcome[k]]
        if word in ("solved", "none usable"):
            works = (told == LinkageRows.VERDICTS.index("usable")).any()
            assert (names[k], word, code) == (names[k], *WORDS[bool(works)])


WORDS = {True: ("solved", "R300"), False: ("none usable", "R301")}
