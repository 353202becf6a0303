"""Six-bars that exist, judged: against the search that made them, and against brute force."""

from dataclasses import replace

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.regions import Point, Segment, box
from burmester.mechanisms.branches import branches_of
from burmester.mechanisms.circuits import circuits_of
from burmester.sixbar.six_bars import SixBarOptions
from burmester.sixbar.watt import WattLinkage
from burmester.synthesis.six_bars import judge_six_bar, judged_at_poses, synthesize_six_bars
from burmester.tasks.limits import Limits
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.requirements import Requirements
from tests.oracles.six_bar_places import in_order, nearest, places, runs
from tests.sixbar.tasks import BENT, REACH, TURNING, task

RADIAN = 2.0
DRIVERS = ["first", "second"]
OPTIONS = SynthesisOptions(length_per_radian=RADIAN)


@pytest.fixture(scope="module")
def six_bars():
    """Some for each of two tasks."""
    some = SixBarOptions(kind="Watt I", chains=300, most=4)
    return [synthesize_six_bars(task(rows), some).six_bars.found for rows in (REACH, TURNING)]


def judged(given, linkage):
    answer = judge_six_bar(given, linkage, OPTIONS)
    (found,) = answer.six_bars.found
    assert (answer.outcome.code == "R330") == found.usable == answer.works
    return found, answer.outcome


def bent(linkage, random, share):
    """The six-bar with every number off by up to a share."""
    names = WattLinkage.__match_args__
    return WattLinkage(
        *(
            value * (1 + share * random.uniform(-1, 1, np.shape(value)))
            for value in (getattr(linkage, name) for name in names)
        )
    )


def rows_of(given):
    return np.column_stack([given.poses.translation, given.poses.angle])


@pytest.mark.parametrize("which", [0, 1])
def test_at_its_own_poses_it_is_what_the_search_said(six_bars, which):
    given = task((REACH, TURNING)[which])
    for made in six_bars[which]:
        found, outcome = judged(given, made.linkage)
        assert outcome.code == "R330"
        assert found.error.position.max() < 1e-9
        assert found.error.angle.max() < 1e-9
        assert found.driver == made.driver
        assert found.drive == pytest.approx(made.drive, abs=1e-8)
        assert found.room == pytest.approx(made.room, abs=1e-8)
        assert found.transmission == pytest.approx(made.transmission, abs=1e-8)
        assert found.extent == pytest.approx(made.extent, rel=1e-8)
        assert found.shortcomings == made.shortcomings


def test_of_two_drivers_with_which_it_works_the_better_one_is_told(six_bars):
    """Three of the poses are met by more of the branches than all five are."""
    seen = 0
    for rows, some in zip((REACH, TURNING), six_bars, strict=True):
        for made in some:
            answer = judge_six_bar(task(rows[1:4]), made.linkage, OPTIONS)
            both = [judged_at_poses(made.linkage, answer.problem, each) for each in DRIVERS]
            if [each.driver for each in both if each.usable] == DRIVERS:
                transmission = [each.transmission for each in both]
                seen += abs(np.subtract(*transmission)) > 0.05
                (found,) = answer.six_bars.found
                assert found.transmission == pytest.approx(max(transmission))
    assert seen >= 2


@pytest.mark.parametrize("seed", range(4))
def test_errors_and_verdict_are_those_of_brute_force(six_bars, seed):
    random = np.random.default_rng(seed)
    verdicts = []
    for which, rows in enumerate((REACH, TURNING)):
        asked = Requirements(within=0.4, within_deg=12)
        given = task([rows[k] for k in (0, 1, 2, 4)], requirements=asked)
        linkage = bent(six_bars[which][seed].linkage, random, 0.02 * (1 + seed))
        found, _ = judged(given, linkage)
        working = []
        wanted = rows_of(given)
        for run in runs(linkage):
            error, index, gap = nearest(run, wanted, RADIAN)
            turned = np.sqrt(np.maximum(error**2 - gap**2, 0)) / RADIAN
            if (gap <= 0.4).all() and (np.degrees(turned) <= 12).all() and in_order(run, index):
                working.append((np.sqrt((error**2).mean()), error))
        verdicts.append(found.usable)
        assert found.usable == bool(working)
        own = found.error.combined(RADIAN)
        if working:
            _, error = min(working, key=lambda each: each[0])
            assert (own <= error + 1e-9).all()
            assert own == pytest.approx(error, abs=5e-3)
        # The body is where brute force finds it at the told angle of the driver.
        sides = [(p, q) for p in (1, -1) for q in (1, -1)]
        there = [places(linkage, found.driver, found.drive, each) for each in sides]
        told = found.error.places
        assert (
            min(
                np.abs(origin - told.translation @ [1, 1j]).max()
                + np.abs(turn - np.exp(1j * told.angle)).max()
                for origin, turn in there
                if np.isfinite(origin).all()
            )
            < 1e-9
        )
    assert seed or any(verdicts)


def test_branches_are_those_of_brute_force(six_bars):
    for found in (*six_bars[0], *six_bars[1]):
        circuits = circuits_of(found.linkage)
        assert circuits.closed.all()
        seen = runs(found.linkage)
        for pivot, driver in (("A", "first"), ("B", "second")):
            branches = branches_of(found.linkage, circuits, pivot)
            assert all(each.certain for each in branches)
            own = [each for each in seen if each.driver == driver]
            assert len(branches) == len(own)
            ends = sorted(2 * np.pi if each.turns else np.ptp(each.drives) for each in branches)
            wide = sorted(
                2 * np.pi if each.full else np.ptp(np.unwrap(each.angles)) for each in own
            )
            assert ends == pytest.approx(wide, abs=2e-3)


@pytest.mark.parametrize(
    ("kind", "message"),
    [
        ("branch", "locks between poses 3 and 4, at a dead point"),
        ("circuit", "poses 1-3 are on one assembly, 4 and 5 on another"),
    ],
)
def test_poses_on_two_branches_do_not_work(six_bars, kind, message):
    linkage = six_bars[0][0].linkage
    found_on = [run for run in runs(linkage) if run.driver == "first" and len(run.angles) > 300]
    one, two = found_on[0], found_on[{"branch": 2, "circuit": 1}[kind]]
    spots = [(one, 0.3), (one, 0.5), (one, 0.7), (two, 0.4), (two, 0.6)]
    rows = []
    for run, share in spots:
        k = int(share * len(run.angles))
        rows.append((*run.origin[k : k + 1].view(float), np.degrees(np.angle(run.turn[k]))))
    given = task(rows)
    assert not any((nearest(run, rows_of(given), RADIAN)[0] < 0.4).all() for run in runs(linkage))
    found, outcome = judged(given, linkage)
    assert outcome.code == "R331"
    assert [each.kind for each in found.defects] == [kind]
    assert outcome.why.startswith(f"it meets every pose, but {message}")
    assert found.error.position[:3].max() < 1e-9


def test_another_order_works_only_where_any_is_allowed(six_bars):
    rows = [TURNING[k] for k in (0, 2, 1, 3, 4)]
    for made in six_bars[1][:1]:
        found, outcome = judged(task(rows), made.linkage)
        assert [each.kind for each in found.defects] == ["order"]
        assert "meets the poses in the order 1-3-2-4-5" in outcome.why
        assert "--any-order" in outcome.help
        asked = Requirements(any_order=True)
        found, outcome = judged(task(rows, requirements=asked), made.linkage)
        assert outcome.code == "R330"
        assert found.transmission == pytest.approx(made.transmission, abs=1e-8)


def test_of_branches_that_work_the_nearest_is_told(six_bars):
    anywhere = Requirements(within=100.0, within_deg=179.0)
    for made in six_bars[0]:
        found, _ = judged(task(REACH, requirements=anywhere), made.linkage)
        assert found.error.position.max() < 1e-9
    # In another order the branch through the poses does not work, and one beside them does.
    rows = [REACH[k] for k in (0, 2, 1, 3, 4)]
    found, _ = judged(task(rows, requirements=anywhere), six_bars[0][0].linkage)
    assert found.usable
    assert found.error.position.max() > 0.1


def test_the_angle_has_a_bound_of_its_own(six_bars):
    linkage = bent(six_bars[1][0].linkage, np.random.default_rng(1), 0.01)
    found, _ = judged(task(TURNING), linkage)
    turned = np.degrees(found.error.angle.max())
    assert turned > 0.01
    for share, usable in ((1.01, True), (0.99, False)):
        asked = Requirements(within=3.0, within_deg=share * turned)
        found, outcome = judged(task(TURNING, requirements=asked), linkage)
        assert found.usable is usable
    assert "too far from pose" in outcome.why
    assert "--within-angle" in outcome.help


def test_many_poses_a_repeated_one_and_one_that_locks(six_bars):
    made = six_bars[0][0]
    way = made.body(made.along(40))
    rows = np.column_stack([way.translation, np.degrees(way.angle)])
    rows = np.insert(rows, 20, rows[20], axis=0)
    found, _ = judged(task(rows), made.linkage)
    assert found.usable
    assert found.error.position.max() < 1e-9
    assert found.drive[20] == found.drive[21]
    # At the dead point itself, where nothing goes on.
    end = made.drive.min() - made.room[0] + 1e-12
    last = made.body(np.array([end]))
    locked = np.vstack([rows[:3], [[*last.translation[0], np.degrees(last.angle[0])]]])
    found, outcome = judged(task(locked), made.linkage)
    assert [each.kind for each in found.defects] == ["branch"]
    assert "dead point" in outcome.why


def test_points_without_an_angle(six_bars):
    rows = np.array(REACH, dtype=float)
    free = PoseTolerances(np.zeros((5, 2)), np.where([0, 1, 0, 1, 0], np.inf, 0.0))
    rows[[1, 3], 2] += 70.0  # nobody asks for these
    found, _ = judged(task(rows, tolerances=free), six_bars[0][1].linkage)
    assert found.usable
    assert found.error.position.max() < 1e-9


def test_tolerances_decide_where_a_task_has_them(six_bars):
    linkage = bent(six_bars[0][1].linkage, np.random.default_rng(5), 0.004)
    found, _ = judged(task(REACH), linkage)
    off = found.error
    for share, usable in ((1.3, True), (0.4, False)):
        bounds = share * off.position.max(), share * off.angle.max()
        room = PoseTolerances.uniform(5, bounds[0], bounds[0], bounds[1])
        found, outcome = judged(task(REACH, tolerances=room), linkage)
        assert found.usable is usable
        assert (found.within_tolerance.max() <= 1) is np.bool_(usable)
        # No place on any branch uses less of the tolerances, where all poses are on one.
        run = min(runs(linkage), key=lambda each: nearest(each, rows_of(task(REACH)), 2)[0].max())
        for k, (x, y, angle) in enumerate(rows_of(task(REACH))):
            turn = np.abs(np.angle(run.turn * np.exp(-1j * angle))) / bounds[1]
            gap = run.origin - (x + 1j * y)
            shares = np.maximum(np.abs(gap.real), np.abs(gap.imag)) / bounds[0]
            least = np.maximum(shares, turn).min()
            assert found.within_tolerance[k].max() == pytest.approx(least, rel=0.02)
            assert found.within_tolerance[k].max() <= least + 1e-6
    assert "outside the tolerance" in outcome.why


@pytest.mark.parametrize(
    ("limits", "asked", "message"),
    [
        ((Limits(box([50, 50], [60, 60])),), {}, "the fixed pivot A at"),
        ((Limits(moving_pivot=Point([9, 9])), Limits()), {}, "is {} outside its region"),
        ((Limits(length=(0.0, 0.1)), Limits()), {}, "the first crank AC is"),
        ((Limits(), Limits(length=(500.0, 600.0))), {}, "the second crank BD is"),
        ((), {"transmission_deg": 89}, "the transmission angle falls to"),
        ((), {"link_ratio": 1.1}, "at most 1.1 times is allowed"),
        ((), {"driver": "crank"}, "its driver does not turn fully"),
    ],
)
def test_limits_and_requirements_that_it_does_not_keep(six_bars, limits, asked, message):
    made = six_bars[0][0]
    given = task(REACH, limits=limits, requirements=Requirements(**asked))
    found, outcome = judged(given, made.linkage)
    assert outcome.code == "R331"
    assert not found.defects
    pivots = made.linkage.body_joint, made.linkage.link_joint
    least = min(float(np.hypot(*(each - 9))) for each in pivots)
    assert message.format(f"{least:.2g}") in outcome.why
    if asked:
        assert "it would do" in outcome.help


def test_two_regions_may_be_taken_in_either_order(six_bars):
    made = six_bars[1][0].linkage
    a, b = made.fixed_first, made.fixed_second
    for regions in ((Point(a), Segment(b, b + 1)), (Segment(b, b + 1), Point(a))):
        limits = tuple(Limits(each) for each in regions)
        assert judged(task(TURNING, limits=limits), made)[0].usable


def test_what_cannot_be_judged(six_bars):
    linkage = six_bars[0][0].linkage
    for wrong, code in (
        (replace(linkage, link_joint=linkage.body_joint), "E154"),
        (replace(linkage, first_crank=linkage.first_crank * 1e9), "E112"),
        (replace(linkage, floating_link=np.asarray(1e3)), "E155"),
        (replace(linkage, second_crank=np.asarray(1e3)), "E155"),
    ):
        with pytest.raises(InputError) as refused:
            judge_six_bar(task(REACH), wrong)
        assert refused.value.code == code
    with pytest.raises(InputError) as refused:
        judge_six_bar(task([REACH[1], REACH[1]]), linkage)
    assert refused.value.code == "E195"
    with pytest.raises(InputError) as refused:
        judge_six_bar(task(BENT, requirements=Requirements(types={"crank-rocker"})), linkage)
    assert refused.value.code == "E196"


def test_joints_of_a_link_that_nearly_fall_together_make_it_degenerate(six_bars):
    """The joints D and G of the second crank: far enough apart, and too near."""
    made = six_bars[0][0]
    joints = made.joints(made.drive[:1])
    floating = np.linalg.norm(joints["D"] - joints["H"])
    span = np.hypot(*np.ptp(np.array(REACH)[:, :2], axis=0))
    for apart, degenerate in ((span / 150, False), (span / 300, True)):
        at = np.array([float(made.linkage.second_crank) + apart, 0.0])
        near = replace(made.linkage, crank_joint=at, floating_link=np.array(floating))
        found, _ = judged(task(REACH), near)
        told = [each.message for each in found.defects if each.kind == "degenerate"]
        assert bool(told) == degenerate
        if degenerate:
            assert "shorter than 1/200 of the motion's span" in told[0]
            assert not found.usable
