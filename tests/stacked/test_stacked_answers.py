"""Answers of stacks are those of the road of one task, whatever the neighbours are."""

import math

import numpy as np
import pytest

from burmester.dyads import selection
from burmester.errors import InputError
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.geometry import constraint_manifold
from burmester.stacked import (
    DyadRows,
    StackedAnswers,
    TaskStack,
    joined,
    stacked_answers,
)
from burmester.synthesis.dyad_search import search_dyads, with_method
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.outcome import dyad_advice
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_kinds import Undetermined
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from tests.oracles.mixed_tasks import mixed_tasks

NEAR = 1e-9  # of the size of a dyad and its poses
STACKS = [("pencil", 6), ("pencil", 10), ("dyads", 5), ("dyads", 6), ("dyads", 10)]


def alone(stack, index, depth):
    """The outcome, the code, the dyads and the warnings of one task without a stack."""
    options = SynthesisOptions(method="pencil" if depth == "pencil" else "auto")
    try:
        task = stack.task(index)
    except InputError as error:
        return "refused", error.code, (), []
    problem = SynthesisProblem.of(task, classify_motion(task), options)
    kind, repeats = (
        problem.motion.kind,
        ["W208"] * (len(problem.motion.first) < stack.poses.shape[1]),
    )
    if problem.is_special:
        outcome = "not determined" if isinstance(kind, Undetermined) else "special motion"
        return outcome, kind.code, kind.dyads, []
    if depth != "pencil" and max(problem.missing_conditions) > 0:
        return "infinitely many", "R303", (), repeats
    try:
        problem = with_method(problem)
    except InputError as error:
        return "not at this depth", error.code, (), repeats
    found = search_dyads(problem)
    pairs, twice = found.pairs(problem.length)
    told = {each.code for each in dyad_advice(problem, found)} | ({"W205"} if twice else set())
    outcome = ("solved", "") if pairs else ("too few dyads", "R302")
    return *outcome, [each.dyad for each in found.dyads], [*repeats, *told]


def dyad_in(rows, at):
    """The dyad of a row, from the columns that its kind has."""
    kind = DyadRows.KINDS[rows.kind[at]]
    if kind == "RR":
        return RR(rows.fixed[at], rows.moving[at], rows.length[at])
    if kind == "PR":
        return PR(math.radians(rows.normal_deg[at]), rows.offset[at], rows.moving[at])
    if kind == "RP":
        return RP(rows.fixed[at], math.radians(rows.normal_deg[at]), rows.offset[at])
    return PP(math.radians(rows.angle_deg[at]))


def same_dyad(one, other, size):
    if type(one) is not type(other):
        return False
    size = size + (float(one.radius) if isinstance(one, RR) else 0.0)
    return all(
        np.abs(getattr(one, name) - getattr(other, name)).max() <= NEAR * size
        for name in one.__match_args__
    )


@pytest.mark.parametrize(
    ("depth", "count", "weighted"),
    [(*each, False) for each in STACKS]
    + [("pencil", 7, True), ("dyads", 5, True), ("dyads", 8, True)],
)
def test_each_task_of_a_stack_gets_the_answer_of_the_road_of_one_task(depth, count, weighted):
    rows, names = mixed_tasks(count, seed=weighted)
    weights = np.random.default_rng(1).uniform(0.5, 2.0, rows.shape[:2]) if weighted else None
    stack = TaskStack(rows, weights=weights)
    answers = stacked_answers(stack, depth)
    for k, name in enumerate(names):
        outcome, code, dyads, warnings = alone(stack, k, depth)
        told = StackedAnswers.OUTCOMES[answers.outcome[k]], answers.code[k]
        assert (name, *told) == (name, outcome, code)
        here = np.flatnonzero(answers.dyads.task == k)
        found = [dyad_in(answers.dyads, at) for at in here]
        size = np.abs(rows[k, :, :2]).max()
        assert [type(each) for each in found] == [type(each) for each in dyads], name
        for one, other in zip(found, dyads, strict=True):
            assert same_dyad(one, other, size), (name, one, other)
        assert sorted(c for task, c in answers.warnings if task == k) == sorted(warnings), name


@pytest.mark.parametrize(("depth", "count"), STACKS)
def test_tasks_that_no_stack_is_vouched_for_are_answered_alone_too(depth, count):
    rows, names = mixed_tasks(count)
    every = stacked_answers(TaskStack(rows), depth)
    hard = [names.index(each) for each in ("translation", "one pose twice", "two poses only")]
    for some in (hard, hard[:1]):
        answers = stacked_answers(TaskStack(rows[some]), depth)
        assert answers.outcome.tolist() == every.outcome[some].tolist()
        own = every.dyads.kind[np.isin(every.dyads.task, some)]
        assert sorted(answers.dyads.kind) == sorted(own)


@pytest.mark.parametrize(("depth", "method"), [("pencil", "pencil"), ("dyads", "auto")])
def test_a_stack_has_the_dyads_of_a_synthesis(depth, method):
    rows, names = mixed_tasks(10)
    wanted = [names.index(name) for name in ("noisy four-bar 1", "translation", "two sliders")]
    answers = stacked_answers(TaskStack(rows[wanted]), depth)
    for k, index in enumerate(wanted):
        task = Task.from_rows(rows[index], angle_unit="rad")
        whole = synthesize(task, SynthesisOptions(method=method))
        here = np.flatnonzero(answers.dyads.task == k)
        for at, other in zip(here, whole.dyads, strict=True):
            assert same_dyad(dyad_in(answers.dyads, at), other.dyad, np.abs(rows).max())
            assert answers.dyads.rms[at] == pytest.approx(other.rms_error, rel=1e-7, abs=NEAR)
            assert answers.dyads.worst[at] == pytest.approx(other.max_error, rel=1e-7, abs=NEAR)
        told = [each.code for each in whole.warnings if each.code in ("W205", "W206", "W207")]
        mine = [code for at, code in answers.warnings if at == k]
        assert [code for code in mine if code in told] == told


def test_distances_are_those_that_a_hand_would_reckon():
    rows, _ = mixed_tasks(10)
    answers = stacked_answers(TaskStack(rows), "dyads").dyads
    for at in np.flatnonzero(answers.kind < 3):
        x, y, angle = np.unique(rows[answers.task[at]], axis=0).T  # a repeated pose counts once
        turn, d = np.exp(1j * angle), x + 1j * y
        fixed, moving = (each[at] @ [1, 1j] for each in (answers.fixed, answers.moving))
        kind = DyadRows.KINDS[answers.kind[at]]
        if kind == "RR":
            miss = np.abs(d + turn * moving - fixed) - answers.length[at]
        else:
            point = d + turn * moving if kind == "PR" else (fixed - d) / turn
            along = np.exp(1j * np.radians(answers.direction_deg[at]))
            miss = ((point - answers.point[at] @ [1, 1j]) / along).imag
        size = np.abs(rows[answers.task[at], :, :2]).max()
        size = size + np.nan_to_num(answers.length[at])
        assert answers.rms[at] == pytest.approx(np.sqrt((miss**2).mean()), abs=1e-8 * size)
        assert answers.worst[at] == pytest.approx(np.abs(miss).max(), abs=1e-8 * size)


@pytest.mark.parametrize(("depth", "count"), STACKS)
def test_a_bad_task_leaves_the_bits_of_its_neighbours(depth, count):
    rng = np.random.default_rng(3)
    rows = rng.normal(size=(12, count, 3))
    before = stacked_answers(TaskStack(rows), depth)
    for bad in (0.0, 1e70, 1e-70, 1e58):
        spoilt = rows.copy()
        spoilt[5] *= bad
        spoilt[8] = spoilt[8, :1]
        after = stacked_answers(TaskStack(spoilt), depth)
        kept = [np.flatnonzero(~np.isin(each.dyads.task, [5, 8])) for each in (before, after)]
        for name in ("task", "kind", "fixed", "moving", "length", "point", "rms", "worst"):
            one, other = (
                getattr(each.dyads, name)[index]
                for each, index in zip((before, after), kept, strict=True)
            )
            assert one.tobytes() == other.tobytes(), (bad, name)


def test_stacks_one_after_the_other_are_one_stack():
    rows = np.random.default_rng(4).normal(size=(9, 7, 3))
    whole = stacked_answers(TaskStack(rows), "pencil")
    parts = joined([stacked_answers(TaskStack(rows[k : k + 4]), "pencil") for k in (0, 4, 8)])
    for name in ("task", "kind", "fixed", "rms"):
        np.testing.assert_array_equal(getattr(whole.dyads, name), getattr(parts.dyads, name))
    assert whole.outcome.tolist() == parts.outcome.tolist()
    assert whole.warnings == parts.warnings


def test_four_poses_are_a_family_and_five_no_pencil():
    four = stacked_answers(TaskStack(np.random.default_rng(5).normal(size=(2, 4, 3))), "dyads")
    assert [four.OUTCOMES[k] for k in four.outcome] == ["infinitely many"] * 2
    five = stacked_answers(TaskStack(np.random.default_rng(5).normal(size=(2, 5, 3))), "pencil")
    assert [five.OUTCOMES[k] for k in five.outcome] == ["not at this depth"] * 2
    assert five.code.tolist() == ["E121"] * 2


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ({"poses": np.zeros((2, 5))}, "E125"),
        ({"poses": np.full((2, 5, 3), np.nan)}, "E103"),
        ({"poses": np.zeros((2, 5, 3)), "weights": np.ones((2, 4))}, "E125"),
        ({"poses": np.zeros((2, 5, 3)), "exact": np.zeros((2, 5))}, "E125"),
    ],
)
def test_arrays_that_are_no_stack_are_refused(given, code):
    with pytest.raises(InputError) as caught:
        TaskStack(**given)
    assert caught.value.code == code


@pytest.mark.parametrize("noise", [0.0, 1e-5, 1e-3, 0.1])
def test_no_slider_is_ruled_out_that_stands_for_a_circle(noise, monkeypatch):
    """With every solution compared with its nearest slider the answers are the same bits."""
    rows, _ = mixed_tasks(9)
    rows = rows + noise * np.random.default_rng(6).normal(size=rows.shape)
    few = stacked_answers(TaskStack(rows), "pencil").dyads
    monkeypatch.setattr(selection, "least_slider_angle", lambda p: np.zeros(len(p)))
    every = stacked_answers(TaskStack(rows), "pencil").dyads
    assert (every.kind > 0).any()
    for name in ("task", "kind", "fixed", "moving", "length", "point", "rms", "worst"):
        assert getattr(few, name).tobytes() == getattr(every, name).tobytes(), name


@pytest.mark.parametrize("of", [PR, RP])
def test_no_slider_is_nearer_than_the_angle_that_rules_it_out(of):
    """The angles between sliders and manifolds beside them, in all directions and in each."""
    rng = np.random.default_rng(7)
    one, two = rng.normal(size=(2, 320, 2)), rng.normal(size=(2, 320))
    line = PR(two[0], two[1], one[0]) if of is PR else RP(one[0], two[0], two[1])
    beside = np.concatenate([rng.normal(size=(160, 8)), np.tile(np.eye(8), (20, 1))])
    size, metric = constraint_manifold.size, constraint_manifold.INVARIANT
    q = line.coefficients()
    # Of the two parts of p3 to p6, the one that a line of the other kind would have.
    sign = 1.0 if of is RP else -1.0
    beside[240:] = np.array([0, 0, 1, 0, 0, sign, 0, 0])
    p = q + 10 ** rng.uniform(-6, 0, (320, 1)) * beside
    own, line_own = (v / metric / size(v)[:, None] for v in (p, q))
    sine = np.linalg.norm(own - (own * line_own).sum(axis=1, keepdims=True) * line_own, axis=1)
    share = selection.least_slider_angle(p) / size(p) / sine
    assert share.max() <= 1 + 1e-9
    assert share.max() > 0.9
