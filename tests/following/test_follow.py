"""Following answers, against SciPy's minimisation, the whole road, and a linkage driven anew.

Every drag moves one pose, or a limit, along a line in many steps.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import least_squares, minimize

import burmester
from burmester import RR, Displacement, InputError, Limits, Task, box, follow, synthesize
from burmester.dyads.selection import FoundDyad
from burmester.errors import Finding
from burmester.following.dyad_strands import identities
from burmester.following.follow import linkage_changes
from burmester.following.linkage_strands import Way
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.linkages.from_dyads import target_of
from burmester.synthesis.dyad_search import search_dyads
from tests.oracles.witness import places

SPAN = 10.0
# Two of four dyads of the first task's five poses are not real at first, and on the way become so.
FIVE = np.array(
    [
        [2.6087, 0.7671, -1.4763],
        [0.9612, 0.4066, -0.7429],
        [0.0194, 0.0027, -0.0112],
        [-0.7738, -0.9141, 0.7494],
        [-1.7815, -2.802, 1.4943],
    ]
)
FIVE_STEP = np.array([-0.0737, -0.0453, -0.0235]) / 60  # of the fourth pose
# Ten poses near a cubic; the third dyad meets a saddle on the way.
TEN = np.array(
    [
        [-5.8687, -3.0051, -1.249],
        [-4.6312, -2.0979, -0.9614],
        [-3.3454, -1.3062, -0.6863],
        [-2.034, -0.6677, -0.4101],
        [-0.6895, -0.1936, -0.1313],
        [0.6788, 0.1386, 0.1314],
        [1.9517, 0.3059, 0.3837],
        [3.1599, 0.2834, 0.6349],
        [4.2668, 0.0738, 0.8683],
        [5.2116, -0.324, 1.1006],
    ]
)
TEN_STEP = np.array([0.0781, 0.1247, 0.0089]) / 60  # of the second pose


def task_at(rows, pose, step, number, **more):
    """The task with one pose moved by a number of steps."""
    moved = rows.copy()
    moved[pose] += number * step
    return Task(Displacement.from_poses(moved), **more)


def circles(dyads):
    """The RR dyads by id, as (c, m, r)."""
    return {
        each.id: np.array([*each.dyad.fixed_pivot, *each.dyad.moving_pivot, each.dyad.radius])
        for each in dyads
        if isinstance(each.dyad, RR)
    }


def distances(z, task):
    """How far the moving pivot is from its circle at every pose."""
    cos, sin = np.cos(task.poses.angle), np.sin(task.poses.angle)
    x = cos * z[2] - sin * z[3] + task.poses.translation[:, 0] - z[0]
    y = sin * z[2] + cos * z[3] + task.poses.translation[:, 1] - z[1]
    return np.hypot(x, y) - z[4]


def same_dyads(here):
    """Whether the circles followed are all that the whole road finds, and no others."""
    search = search_dyads(here.problem)
    some, others = (list(circles(each).values()) for each in (here.dyads, search.dyads))
    near = [[np.abs(one - two).max() < 1e-8 * SPAN for two in others] for one in some]
    return len(some) == len(others) and all(map(any, near))


@pytest.fixture(scope="module")
def ten_dragged():
    """Ten poses dragged in 24 steps: the answers of every step."""
    start = synthesize(task_at(TEN, 1, TEN_STEP, 0))
    every = [follow(start, task_at(TEN, 1, TEN_STEP, 1))]
    for number in range(2, 25):
        every.append(follow(every[-1], task_at(TEN, 1, TEN_STEP, number)))
    return start, every


def test_dyads_stay_minima_and_keep_their_ids(ten_dragged):
    """Each goes where SciPy finds the minimum from its predecessor; none leaps."""
    start, every = ten_dragged
    before = circles(start.dyads)
    for step in every:
        now = circles(step.dyads)
        for id, z in now.items():
            assert np.abs(z - before[id]).max() < 0.03 * max(1, np.abs(z).max())
            assert not np.array_equal(z, before[id])
        before = now
    task = every[-1].task
    for id, z in circles(every[-1].dyads).items():
        found = least_squares(distances, z + 1e-4, args=(task,), xtol=1e-15, gtol=1e-15)
        assert (distances(z, task) ** 2).sum() <= 2 * found.cost * (1 + 1e-9), id
        assert np.abs(found.x - z).max() < 1e-5 * max(1, np.abs(z).max()), id


def test_dyads_are_seldom_found_anew(ten_dragged):
    """Only near a saddle, where this drag begins and ends: else the fit goes on in its frames."""
    _, every = ten_dragged
    fits = [step.dyad_strands.fits[0].search for step in every]
    assert sum(one is two for one, two in pairwise(fits)) >= len(fits) // 2


def test_the_whole_road_confirms_the_dyads(ten_dragged):
    _, every = ten_dragged
    assert same_dyads(every[-1])


def test_a_dyad_that_meets_a_saddle_is_told(ten_dragged):
    start, every = ten_dragged
    told = [each for step in every for each in step.changes if each.kind == "vanished"]
    assert [each.id for each in told if each.id[0] == "D"] == ["D3"]
    assert "D3" in circles(start.dyads)
    # A little before, SciPy comes to rest beside it; after, it goes elsewhere from there.
    at = next(k for k, step in enumerate(every) if step.changes and "D3" not in circles(step.dyads))
    z = circles(every[at - 1].dyads)["D3"]
    ends = [
        least_squares(distances, z, args=(every[k].task,), xtol=1e-15, max_nfev=2000).x
        for k in (at - 1, at)
    ]
    assert np.abs(ends[0] - z).max() < 1e-3 < np.abs(ends[1] - z).max()


def test_dyads_of_five_poses_appear_and_vanish():
    there = [task_at(FIVE, 3, FIVE_STEP, number) for number in range(61)]
    here, appeared = synthesize(there[0]), []
    assert len(here.dyads) == 2
    for task in there[1:]:
        here = follow(here, task)
        appeared += [each.id for each in here.changes if each.kind == "appeared"]
    assert [id for id in appeared if id[0] == "D"] == ["D3", "D4"]
    assert same_dyads(here)
    # Linkages of new dyads pass the poses exactly, driven by code of its own.
    new = [each for each in here.linkages if each.id in appeared]
    assert len(new) == 5
    for each in new:
        assert each.error.worst < 1e-6
    gone = []
    for task in there[-2::-1]:
        here = follow(here, task)
        gone += [each.id for each in here.changes if each.kind == "vanished"]
    assert {"D3", "D4"} <= set(gone)
    assert set(gone) >= {each.id for each in new}
    assert [each.id for each in here.dyads] == ["D1", "D2"]


def test_linkages_pass_five_poses_wherever_they_go():
    """The witness drives each at the end of the drag, and its verdict is that of `judge`."""
    poses = burmester.read_task("case:motiongen-shoulder").poses
    rows = np.column_stack([poses.translation, poses.angle])
    step = np.array([0.0004, -0.0002, 0.0001])
    here = synthesize(task_at(rows, 2, step, 0))
    ids = [each.id for each in here.linkages]
    for number in range(1, 31):
        here = follow(here, task_at(rows, 2, step, number))
    assert [each.id for each in here.linkages] == ids
    judged = 0
    for each in here.linkages:
        again = burmester.judge(here.task, each.linkage).linkages[0]
        assert each.usable == again.usable
        one, two = each.linkage.first, each.linkage.second
        drive = np.linspace(0, 2 * np.pi, 40001)
        at, turn = places(one, two, drive)
        for (x, y), angle in zip(here.task.poses.translation, here.task.poses.angle, strict=True):
            off = np.abs(at - x - 1j * y) + np.abs(np.exp(1j * turn) - np.exp(1j * angle))
            assert np.nanmin(off) < 1e-2
            judged += 1
    assert judged == 5 * len(ids)


def test_refined_linkages_stay_least_errors(ten_dragged):
    """A second refinement from where they are gains nothing."""
    _, every = ten_dragged
    here = every[-1]
    strands, target = here.linkage_strands, target_of(here.problem)
    least = np.flatnonzero(strands.way == Way.LEAST)
    assert len(least)
    rows = target.rows_at(strands.places[least])
    start = strands.own[least].to_canonical(target.frames)
    again = target.refine(start, rows, steps=60)
    assert (target.cost(rows) <= target.cost(again.rows) * (1 + 1e-5)).all()


CORNERS = [1.0, 0.3, -0.1, -0.5, -1.0, -0.6, -0.2, 0.2, 1.0]


@pytest.fixture(scope="module")
def over_a_pivot():
    """The edge of a box is dragged over a fixed pivot, and back: it ends so far to the right."""
    poses = Displacement.from_poses(TEN[::2])

    def task(beyond, z):
        region = box([z[0] - 6, z[1] - 6], [z[0] + beyond, z[1] + 6])
        return Task(poses, limits=(Limits(fixed_pivot=region, kinds=frozenset({"RR"})),))

    free = circles(synthesize(Task(poses), "exact").dyads)["D1"]
    here = synthesize(task(CORNERS[0], free))
    apart = {id: np.abs(z - free).max() for id, z in circles(here.dyads).items()}
    id, every = min(apart, key=apart.get), []
    for beyond in CORNERS[1:]:
        here = follow(here, task(beyond, free))
        every.append((beyond, here))
    return free, id, every


def test_a_dyad_takes_the_edge_of_its_limits_and_lets_it_go(over_a_pivot):
    free, id, every = over_a_pivot
    for beyond, here in every:
        z = circles(here.dyads)[id]
        if beyond > 0:
            assert np.abs(z - free).max() < 1e-6
        else:
            assert abs(z[0] - free[0] - beyond) < 1e-9


def test_on_the_edge_it_is_best_there(over_a_pivot):
    """SLSQP with the edge as a bound finds nothing better beside it."""
    free, id, every = over_a_pivot
    beyond, here = next(each for each in every if each[0] == -0.5)
    z = circles(here.dyads)[id]

    def cost(z):
        return 1e3 * (distances(z, here.task) ** 2).sum()

    found = minimize(
        cost,
        z + 1e-3 * np.array([-1, 1, 1, -1, 1]),
        bounds=[(None, free[0] + beyond)] + [(None, None)] * 4,
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert cost(z) <= found.fun * (1 + 1e-6)
    assert np.abs(found.x - z).max() < 0.02


def test_linkages_of_few_poses_go_with_them():
    """Three poses of a template: every linkage meets them still, its pivots inside the boxes."""
    rows = np.array([[0, 0, 0], [43.0, 150.0, 0.1], [0, 300.0, 0.25]])
    limits = Limits(
        fixed_pivot=box([-270, 60], [-150, 240]),
        moving_pivot=box([-60, -60], [30, 60]),
        kinds=frozenset({"RR"}),
    )
    here = synthesize(task_at(rows, 1, np.zeros(3), 0, limits=(limits,)))
    assert here.family is not None
    for number in range(1, 11):
        here = follow(here, task_at(rows, 1, np.array([0.5, 0.3, 0.001]), number, limits=(limits,)))
    assert here.linkages
    for each in here.linkages:
        for dyad in (each.linkage.first, each.linkage.second):
            z = np.array([*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius])
            assert np.abs(distances(z, here.task)).max() < 1e-7
            assert limits.fixed_pivot.distance(dyad.fixed_pivot) < 1e-6
            assert limits.moving_pivot.distance(dyad.moving_pivot) < 1e-6


def test_a_crossed_verdict_is_told():
    """Asking for more transmission than a linkage has makes it fail, and less lets it work."""
    task = burmester.read_task("case:motiongen-shoulder")
    here = synthesize(task)
    best = here.linkages[0]
    has = np.degrees(best.driven.least_over_range)

    def asking(degrees):
        asked = burmester.Requirements(transmission_deg=degrees)
        return replace(task, requirements=asked)

    here = follow(here, asking(has + 1))
    assert ("L1", "fails") in [(each.id, each.kind) for each in here.changes]
    assert not here["L1"].usable
    here = follow(here, asking(has - 1))
    assert ("L1", "works") in [(each.id, each.kind) for each in here.changes]


def test_weights_pull_the_dyads(ten_dragged):
    """With weights that grow they are those of the whole road."""
    here, _ = ten_dragged
    for heavy in np.geomspace(1.1, 1.5, 6):
        weights = np.ones(10)
        weights[4] = heavy
        here = follow(here, Task(Displacement.from_poses(TEN), weights=weights))
    assert same_dyads(here)


@pytest.mark.parametrize(
    ("options", "change", "why"),
    [
        ({}, {"poses": Displacement.from_poses(FIVE[:4])}, "4 poses instead of 5"),
        ({}, {"length_unit": "mm"}, "its lengths are in mm"),
        ({}, {"exact": np.arange(5) == 3}, "other poses are exact"),
        ({"rounding_step": 0.1}, {}, "rounded"),
    ],
)
def test_what_cannot_be_followed_is_refused(options, change, why):
    task = Task(Displacement.from_poses(FIVE))
    start = synthesize(task, **options)
    with pytest.raises(InputError) as refused:
        follow(start, replace(task, **change))
    assert refused.value.code == "E157"
    assert why in refused.value.why


def test_linkages_are_judged_where_it_is_asked_for():
    """The others are continued all the same: judged later they are as if they always had been."""
    start = synthesize(task_at(TEN, 1, TEN_STEP, 0))
    partly = wholly = start
    for number in range(1, 4):
        task = task_at(TEN, 1, TEN_STEP, number)
        partly, before = follow(partly, task, judged={"L2"}), partly
        wholly = follow(wholly, task)
        old = {each.id: each for each in before.linkages}
        assert [each.id for each in partly.linkages] == [each.id for each in wholly.linkages]
        for each in partly.linkages:
            if each.id == "L2":
                assert each.error.worst == wholly["L2"].error.worst
            else:
                assert each is old[each.id]
    last = follow(partly, task_at(TEN, 1, TEN_STEP, 4))
    for one, other in zip(last.linkages, follow(wholly, last.task).linkages, strict=True):
        assert one.error.worst == pytest.approx(other.error.worst, rel=1e-9)
        assert one.usable == other.usable
    assert follow(start, task_at(TEN, 1, TEN_STEP, 1), judged=()).linkages == start.linkages


def test_of_two_dyads_as_near_it_is_doubtful_which_went_on():
    """A circle between two: a quarter of the way is sure, four tenths is not."""
    task = task_at(TEN, 1, TEN_STEP, 0)
    frames, _ = CanonicalFrames.of(task.poses)

    def found(id, share):
        dyad = RR(np.array([2.0 + 0.1 * share, 5.0]), np.array([1.0, 1.0]), np.array(4.0))
        return FoundDyad.of(id, dyad, task.poses)

    before = found("D1", 0.0), found("D2", 1.0)
    for share, doubtful in ((0.0, []), (0.2, []), (0.4, [(0, 1)]), (0.6, [(1, 0)])):
        told = identities(before, [found("", share)], [], frames)
        assert told.old == [int(share > 0.5)]
        assert told.doubtful == doubtful, share


def test_another_reason_to_fail_is_told():
    here = synthesize(burmester.read_task("case:motiongen-shoulder"))
    found = here.linkages[0]
    ratio, other = Finding("link ratio", "is long"), Finding("footprint", "is wide")
    failing = replace(found, usable=False, violations=(ratio,))
    for violations, kinds in (((ratio,), []), ((other,), ["other defects"])):
        after = replace(failing, violations=violations)
        told = linkage_changes({found.id: failing}, [after], [], here.task)
        assert [each.kind for each in told] == kinds
