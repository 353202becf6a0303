"""A linkage that exists gets the verdict that synthesis gives its own, and the witness agrees."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from benchmarks.judged_alike import differences, noisy_task

import burmester
from burmester import RR, InputError, Limits, Linkage, Point, Requirements, Task, box, read_task
from burmester.fourbar.dyad import PP, PR, RP
from burmester.geometry.displacement import Displacement
from burmester.io.cases import names
from burmester.synthesis.given_linkage import OpenLink
from burmester.synthesis.judgement import judge_linkage
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.surroundings import KeepOut, Surroundings
from tests.oracles import witness
from tests.oracles.saved_linkages import PAPER
from tests.samples import samples

# The others are much like these, and take longer.
CASES = [name for name in names() if name not in ("motiongen-mixed5", "motiongen-shoulder")]
TASKS = [*(f"case:{name}" for name in CASES), "lid-hinge", "task"]
TEMPLATES = Path(burmester.__file__).parent / "templates"
LID = OpenLink((100, -68), (53, -47)), OpenLink((12, -17), (80, -17))  # as its file says


def task_of(name):
    return read_task(name if ":" in name else TEMPLATES / f"{name}.toml")


def told(found):
    kinds = [each.kind for each in found.defects], [each.kind for each in found.violations]
    return found.usable, *kinds, found.type, found.driven.turns_fully


@pytest.mark.parametrize("name", TASKS)
def test_every_linkage_of_synthesis_is_judged_as_synthesis_did(name):
    task = task_of(name)
    for found in burmester.synthesize(task).linkages:
        judged = judge_linkage(task, found.linkage)
        (own,) = judged.linkages
        assert judged.outcome.code == ("R330" if found.usable else "R331")
        assert told(own) == told(found)
        one, other = (each.error.combined(judged.length_per_radian) for each in (own, found))
        assert one == pytest.approx(other, abs=1e-6 * judged.length, nan_ok=True)
        for least in ("least_over_range", "least_at_poses"):
            one, other = (getattr(each.driven, least) for each in (own, found))
            assert one == pytest.approx(other, abs=1e-5, nan_ok=True)
        assert own.determined == found.determined


# Two linkages were called not usable, and usable by `judge`: errors counted on two circuits.
CONTRADICTED = """
0.5368132880769431 -3.7660372856331827 3.137544346801753
0.4575521309050423 -3.790375400743279 3.1112335102722577
0.311566481633912 -3.8674785452315343 3.037782111770105
-0.1184085444578163 -4.001154139149173 2.831312131809489
-0.7333806844313832 -4.072600348402433 2.6044362809129207
-1.1428443434553812 -4.049469780634682 2.459770190420074
-1.2912792514681126 -4.02101294874651 2.393252852170793
-1.6879484425080482 -3.9180522653315917 2.282091270976191
"""


def test_errors_count_on_one_circuit_in_synthesis_as_in_judgement():
    rows = [list(map(float, line.split())) for line in CONTRADICTED.split("\n") if line]
    task = Task(Displacement.from_poses(rows))
    assert differences(task) == []
    crank = [
        found
        for found in burmester.synthesize(task).linkages
        if found.type == "double-crank" and found.usable
    ]
    errors = [(each.error.worst, np.degrees(each.error.angle.max())) for each in crank]
    assert any(
        far == pytest.approx(0.0097, abs=1e-4) and 1.85 < turn < 1.95 for far, turn in errors
    )


@pytest.mark.parametrize("number", samples(40, 3))
def test_noisy_tasks_are_judged_as_synthesis_judges_them(number):
    assert differences(noisy_task(number, 1)) == []


PUBLISHED = {  # pairs of the printed dyads: what their sources say of them
    # "non-Grashof, same circuit, order ok, branch change for either drive"
    ("motiongen-mixed5", 0, 1): (["branch"], "triple-rocker"),
    # "1 of 6 pairs has a circuit defect (the pair r=5.534 with r=8.043)"
    ("motiongen-shoulder", 0, 1): ([], "crank-rocker"),
    ("motiongen-shoulder", 0, 2): ([], "crank-rocker"),
    ("motiongen-shoulder", 0, 3): (["circuit"], "crank-rocker"),
    ("motiongen-shoulder", 2, 3): ([], "crank-rocker"),
    ("motiongen-three-pivots", 0, 1): ([], "double-rocker"),
}


@pytest.mark.parametrize(("name", "one", "other"), PUBLISHED)
def test_published_linkages(name, one, other):
    text = (TEMPLATES.parent / "cases" / f"{name}.json").read_text()
    rows = json.loads(text)["exact_dyads"]  # Xc, Yc, r, x, y
    dyads = [RR(rows[k][:2], rows[k][3:], rows[k][2]) for k in (one, other)]
    judged = judge_linkage(read_task(f"case:{name}"), dyads)
    (own,) = judged.linkages
    defects, type = PUBLISHED[name, one, other]
    assert judged.outcome.code == ("R331" if defects else "R330")
    assert [each.kind for each in own.defects] == defects
    assert own.type == type
    assert own.error.worst < 1e-12


# The radii of Table 8 are algebraic ones, shorter than the distances of the printed pivots.
@pytest.mark.parametrize(
    ("name", "printed_lengths", "own_lengths"),
    [("ge2012-exact", "R330", "R330"), ("ge2012-approximate", "R331", "R330")],
)
def test_the_printed_linkages_of_the_paper(name, printed_lengths, own_lengths):
    printed = json.loads((TEMPLATES.parent / "cases" / f"{name}.json").read_text())["printed"]
    rows = printed.get("linkage") or printed["linkage_table8"]
    pivots = [(each["fixed_pivot"], each["moving_pivot"]) for each in rows]
    dyads = [RR(*ends, each["radius"]) for ends, each in zip(pivots, rows, strict=True)]
    task = read_task(f"case:{name}")
    assert judge_linkage(task, [OpenLink(*ends) for ends in pivots]).outcome.code == own_lengths
    judged = judge_linkage(task, dyads)
    assert judged.outcome.code == printed_lengths
    assert judged.linkages[0].type == "crank-rocker"
    nearest = witness.misses(Linkage(*dyads), judged.task.poses, judged.length_per_radian)
    own = judged.linkages[0].error.combined(judged.length_per_radian)
    assert own == pytest.approx(nearest, abs=1e-6)


@pytest.mark.parametrize("second", [RR, PR, RP])
@pytest.mark.parametrize("seed", range(4))
def test_a_linkage_that_was_driven_through_the_poses_works(seed, second):
    rng = np.random.default_rng([seed, 7])
    dyads = witness.random_four_bar(rng, second)
    count = int(rng.integers(3, 9))
    task = Task(Displacement.from_poses(witness.random_poses(dyads, rng, count, ordered=True)))
    judged = judge_linkage(task, Linkage(*dyads), SynthesisOptions(norm="worst"))
    (own,) = judged.linkages
    assert judged.outcome.code == "R330"
    assert own.error.worst < 1e-9
    # Pivots alone: the lengths follow from the poses, which one linkage met.
    open_links = [
        OpenLink(each.fixed_pivot, each.moving_pivot) if isinstance(each, RR) else each
        for each in dyads
    ]
    again = judge_linkage(task, open_links)
    for one, other in zip(own.dyads, again.linkages[0].dyads, strict=True):
        if isinstance(one.dyad, RR):
            assert float(other.dyad.radius) == pytest.approx(float(one.dyad.radius), abs=1e-9)
    assert not [each for each in again.warnings if each.code == "W219"]


@pytest.mark.parametrize("seed", range(6))
def test_errors_are_those_of_a_linkage_that_is_driven(seed):
    rng = np.random.default_rng([seed, 11])
    dyads = witness.random_four_bar(rng, (RR, PR, RP)[seed % 3])
    rows = witness.random_poses(dyads, rng, 5, side=0)
    task = Task(Displacement.from_poses(rows + rng.normal(scale=0.02, size=rows.shape)))
    judged = judge_linkage(task, Linkage(*dyads))
    nearest = witness.misses(Linkage(*dyads), task.poses, judged.length_per_radian)
    own = judged.linkages[0].error.combined(judged.length_per_radian)
    assert (own > nearest - 1e-6).all()  # it may be held to one circuit
    assert np.median(own / nearest) == pytest.approx(1, abs=1e-4)


def test_a_lid_on_the_wrong_circuit():
    where, phi = witness.places(*PAPER, np.linspace(0.3, 2.5, 8))
    side = np.array([1, 1, 1, 1, 1, 0, 0, 0])
    every = np.arange(8)
    rows = np.column_stack([where.real[side, every], where.imag[side, every], phi[side, every]])
    judged = judge_linkage(Task(Displacement.from_poses(rows)), Linkage(*PAPER))
    assert judged.outcome.code == "R331"
    (defect,) = judged.linkages[0].verdict.defects
    assert (defect.kind, defect.poses) == ("circuit", (5, 6, 7))
    assert "poses 1-5 are on one assembly, 6-8 on the other" in judged.outcome.why
    one = judge_linkage(Task(Displacement.from_poses(rows[:5])), Linkage(*PAPER))
    assert one.outcome.code == "R330"


def test_the_lid_of_its_file():
    task = task_of("lid-hinge")
    judged = judge_linkage(task, LID)
    (own,) = judged.linkages
    assert judged.outcome.message == "the linkage works within the requirements"
    # Only the closed pose is exact, so both lengths are the distances there.
    assert [float(each.dyad.radius) for each in own.dyads] == pytest.approx(
        [math.hypot(47, 21), 68], abs=1e-12
    )
    assert own.error.position[0] == pytest.approx(0, abs=1e-9)
    assert own.error.worst < 0.012  # each position was moved by 0.01 mm at most
    assert witness.misses(own.linkage, task.poses, 1).max() < 0.02


def test_lengths_are_the_weighted_mean_of_the_distances():
    rows = [(3.0, 0, 0), (0, 5.0, 90), (-4.0, 0, 180)]
    even = Task.from_rows(rows, angle_unit="deg")
    link = OpenLink([0, 0], [0, 0])
    assert float(link.at(even).radius) == pytest.approx(4)
    heavy = Task(even.poses, weights=np.array([1.0, 2, 1]))
    assert float(link.at(heavy).radius) == pytest.approx(17 / 4)
    exact = Task(even.poses, exact=np.array([True, False, True]))
    assert float(link.at(exact).radius) == pytest.approx(3.5)
    judged = judge_linkage(even, [link, OpenLink([5, 1], [1, 1])])
    (advice,) = (each for each in judged.warnings if "D1" in each.message)
    assert advice.code == "W219"
    assert "from 3 to 5 apart" in advice.message


def limited(*limits, **more):
    return Task(task_of("lid-hinge").poses, length_unit="mm", limits=limits, **more)


def test_pivots_outside_their_limits_are_told():
    room = Limits(fixed_pivot=box((5, -100), (90, -10)), length=(10, 60))
    judged = judge_linkage(limited(room), LID)
    (own,) = judged.linkages
    assert (judged.outcome.code, own.defects) == ("R331", ())
    assert [each.message for each in own.violations] == [
        "the fixed pivot at (100, -68) is 10 mm outside its region",
        "a link is 68 long; at most 60 is allowed",
    ]
    only = Limits(kinds=frozenset({"PR", "RP"}))
    (own,) = judge_linkage(limited(only), LID).linkages
    assert [each.message for each in own.violations] == [
        "its RR dyad is not of a kind allowed (PR or RP)"
    ] * 2
    within = Limits(fixed_pivot=box((5, -100), (100, -10)), length=(10, 68.1))
    assert judge_linkage(limited(within), LID).outcome.code == "R330"


def test_dyads_are_held_against_two_limits_in_the_order_that_keeps_them():
    limits = Limits(fixed_pivot=Point((12, -17))), Limits(fixed_pivot=Point((100, -68)))
    for dyads in (LID, LID[::-1]):
        judged = judge_linkage(limited(*limits), dyads)
        assert judged.outcome.code == "R330"
        assert judged.linkages[0].linkage.first.fixed_pivot.tolist() == [12, -17]
    elsewhere = Limits(fixed_pivot=Point((12, -16))), limits[1]
    (own,) = judge_linkage(limited(*elsewhere), LID).linkages
    assert [each.message for each in own.violations] == [
        "the fixed pivot at (12, -17) is 1 mm outside its region"
    ]


def test_requirements_are_told():
    asked = Requirements(transmission_deg=50, types=("crank-rocker",))
    judged = judge_linkage(limited(requirements=asked), LID)
    assert [each.kind for each in judged.linkages[0].violations] == ["transmission", "type"]
    assert "the transmission angle falls to 47.2° between the poses" in judged.outcome.why


def test_repeated_poses_and_few_poses():
    poses = task_of("lid-hinge").poses
    twice = judge_linkage(Task(poses[[0, 0, 3, 3, 5, 7, 7]]), LID)
    once = judge_linkage(Task(poses[[0, 3, 5, 7]], weights=np.array([2.0, 2, 1, 2])), LID)
    assert twice.outcome.code == once.outcome.code == "R330"
    assert len(twice.linkages[0].error.position) == 7
    own = [judged.linkages[0] for judged in (twice, once)]
    assert own[0].error.position[[0, 2, 4, 5]] == pytest.approx(own[1].error.position, abs=1e-9)
    # Three poses determine no pivots, and nothing is said of their uncertainty.
    three = judge_linkage(Task(poses[[0, 4, 7]], resolution=(1e-3, 1e-3)), LID)
    assert three.linkages[0].uncertainty is None
    assert judge_linkage(Task(poses, resolution=(1e-3, 1e-3)), LID).linkages[0].uncertainty


@pytest.mark.parametrize(
    ("dyads", "code"),
    [
        ([RR((0, 0), (1, 0), 1), RR((0, 0), (2, 0), 1)], "E154"),
        ([RR((0, 0), (1, 0), 1), RR((3, 0), (1, 0), 1)], "E154"),
        ([RR((0, 0), (1, 0), 0), RR((3, 0), (2, 0), 1)], "E154"),
        ([RR((0, 0), (1, 0), -2), RR((3, 0), (2, 0), 1)], "E154"),
        ([RR((0, 0), (1, 0), 1), PP(0)], "E154"),
        ([RR((0, 0), (1, 0), 1), RR((90, 0), (2, 0), 1)], "E155"),
        ([RR((0, 0), (1, 0), 1), PR(0, 90, (2, 0))], "E155"),
        ([RR((0, 0), (1, np.nan), 1), RR((3, 0), (2, 0), 1)], "E112"),
        ([RR((0, 0), (1, 0), 1), RR((1e70, 0), (2, 0), 1)], "E112"),
    ],
)
def test_two_dyads_that_make_no_linkage(dyads, code):
    task = Task.from_rows([(3, 0, 0), (0, 3, 40), (-3, 0, 70)], angle_unit="deg")
    with pytest.raises(InputError) as caught:
        judge_linkage(task, dyads)
    assert caught.value.code == code
    assert caught.value.help
    if code == "E155":  # a linkage of a result may be one that reaches no pose
        assert judge_linkage(task, Linkage(*dyads)).outcome.code == "R331"


def test_an_exact_pose_that_is_missed_is_told():
    task = task_of("lid-hinge")
    dyads = RR((100, -68), (53, -47), 51.2), LID[1]
    judged = judge_linkage(task, dyads)
    assert judged.outcome.code == "R330"
    told = f"it misses pose closed, which is to be met exactly, by {0.6:g} mm"
    near = witness.misses(judged.linkages[0].linkage, task.poses, judged.length_per_radian)[0]
    assert 0.1 < near < 1
    assert judged.outcome.why.startswith(told[: told.index(" by ")])
    assert judge_linkage(task, LID).outcome.why is None


@pytest.mark.parametrize("count", [2, 3, 4])
@pytest.mark.parametrize("seed", [0])
def test_better_linkages_for_few_poses_work_where_the_witness_drives_them(seed, count):
    rng = np.random.default_rng([seed, count])
    poses = task_of("lid-hinge").poses
    few = Task(poses[np.sort(rng.choice(8, count, replace=False))])
    off = rng.normal(scale=12, size=(2, 2, 2))
    dyads = [
        OpenLink(each.fixed_pivot + one, each.moving_pivot + other)
        for each, (one, other) in zip(LID, off, strict=True)
    ]
    judged = judge_linkage(few, dyads, improve=True)
    given, *near = judged.linkages
    assert (judged.outcome.code == "R330") is given.usable
    assert given.usable or near
    for each in near:
        assert each.usable
        nearest = witness.misses(each.linkage, few.poses, judged.length_per_radian)
        own = each.error.combined(judged.length_per_radian)
        assert (nearest <= own + 1e-6).all()
        assert own.max() <= 0.1 * judged.problem.motion_size * 1.5


def test_tolerances_and_surroundings_of_the_task_are_checked():
    poses = task_of("lid-hinge").poses
    wide = PoseTolerances(np.full((8, 2), 0.02), np.full(8, np.radians(0.05)))
    tight = PoseTolerances(np.full((8, 2), 0.001), np.full(8, np.radians(0.001)))
    for tolerances, code in ((wide, "R330"), (tight, "R331")):
        judged = judge_linkage(Task(poses, tolerances=tolerances), LID)
        assert judged.outcome.code == code
    nearest = witness.misses(judged.linkages[0].linkage, poses, 24.0)
    assert nearest.max() > 0.001
    # A box around the middle of the coupler at the closed pose, where M lies on F.
    middle = np.array([66.5, -32])
    wall = KeepOut(box(middle - 1, middle + 1), "wall")
    judged = judge_linkage(Task(poses, surroundings=Surroundings((wall,))), LID)
    assert judged.outcome.code == "R331"
    assert "touches 'wall'" in judged.outcome.why
