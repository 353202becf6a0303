"""The best of infinitely many: what is listed is driven, keeps its limits, and is no worse."""

from dataclasses import replace

import numpy as np
import pytest

from burmester import synthesize
from burmester.describe.dimensions import dimensions
from burmester.families.family import far_apart, front, recommended_first
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.synthesis import motion_generation
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.requirements import Requirements
from tests.oracles.few_pose_tasks import few_pose_task
from tests.oracles.pair_verdicts import verdict
from tests.oracles.witness import misses

OPENING = [(0, 0, 0), (30, 77, 45), (95, 110, 95)]
FOUR = [(0, 0, 0), (12.5, 40, 20), (30, 77, 45), (95, 110, 95)]
L_SHAPE = Polygon(np.array([(-60, -60), (160, -60), (160, 0), (40, 0), (40, 120), (-60, 120)]))


def task_of(rows, **more):
    return Task.from_rows(rows, angle_unit="deg", length_unit="mm", **more)


def span(poses):
    """The diagonal of the box that holds the poses' origins."""
    return float(np.hypot(*np.ptp(poses.translation, axis=0)))


def drawn(seed):
    """A random task of two, three or four poses with boxes."""
    given = few_pose_task(seed)
    limits = tuple(Limits(fixed_pivot=box(*c), moving_pivot=box(*m)) for c, m in given.boxes)
    return Task(Displacement(given.rows[:, :2], given.rows[:, 2]), limits=limits)


def moving_pivot_of(dyad):
    return None if isinstance(dyad, RP) else dyad.moving_pivot


@pytest.mark.parametrize("seed", [0, 1, 2, 6, 7, 14])
def test_every_linkage_listed_is_driven_through_the_poses(seed):
    task = drawn(seed)
    synthesis = synthesize(task)
    judged = 0
    for each in synthesis.usable:
        near = misses(each.linkage, task.poses, span(task.poses))
        assert near.max() < 1e-7 * span(task.poses)
        dyads = each.linkage.first, each.linkage.second
        for dyad, limits in zip(dyads, (task.limits * 2)[:2], strict=True):
            for at, region in (
                (getattr(dyad, "fixed_pivot", None), limits.fixed_pivot),
                (moving_pivot_of(dyad), limits.moving_pivot),
            ):
                if at is not None:
                    assert region.distance(at) <= 1e-9 * span(task.poses)
        if all(isinstance(dyad, RR) for dyad in dyads):
            told = verdict(dyads, task.poses, span(task.poses))
            if told is not None:
                judged += 1
                assert told[0] in {"works", "below"}
                least = np.degrees(each.quality.transmission)
                assert told[1] >= least - 0.02  # the better of both drivers, swept
    assert judged or not synthesis.usable


@pytest.mark.parametrize("rows", [OPENING[::2], OPENING, FOUR], ids=["two", "three", "four"])
@pytest.mark.parametrize(
    "limits",
    [
        (Limits(fixed_pivot=Line(np.array([0.0, -40]), np.array([90.0, -40]))),),
        (Limits(moving_pivot=Segment(np.array([-60.0, 10]), np.array([60.0, 20]))), Limits()),
        (Limits(fixed_pivot=L_SHAPE, length=(20, 160)),),
        (Limits(kinds={"PR"}), Limits(kinds={"RR"})),
        (Limits(kinds={"RP"}), Limits(kinds={"RR"}, moving_pivot=box((-80, -80), (80, 80)))),
    ],
    ids=["line", "segment", "L", "slider", "slot"],
)
def test_limits_of_every_sort_take_freedom_and_are_kept(rows, limits):
    task = task_of(rows, limits=limits)
    synthesis = synthesize(task)
    assert synthesis.outcome.code in {"R308", "R309", "R302"}
    kinds = {RR: "RR", PR: "PR", RP: "RP"}
    for each in synthesis.usable:
        assert misses(each.linkage, task.poses, span(task.poses)).max() < 1e-7 * span(task.poses)
        dyads = each.linkage.first, each.linkage.second
        for dyad, held in zip(dyads, (limits * 2)[:2], strict=True):
            assert kinds[type(dyad)] in held.allowed
            at = getattr(dyad, "fixed_pivot", None)
            if held.fixed_pivot is not None and at is not None:
                assert held.fixed_pivot.distance(at) < 1e-9 * 100
            if held.moving_pivot is not None and moving_pivot_of(dyad) is not None:
                assert held.moving_pivot.distance(dyad.moving_pivot) < 1e-9 * 100
            if isinstance(dyad, RR):
                least, most = held.length
                assert least * (1 - 1e-8) <= dyad.radius <= most * (1 + 1e-8)


def test_a_pivot_at_a_point_leaves_the_other_dyad_open():
    at = Point(np.array([20.0, 90.0]))
    task = task_of(OPENING, limits=(Limits(fixed_pivot=at), Limits()))
    synthesis = synthesize(task)
    assert synthesis.usable
    for each in synthesis.usable:
        assert np.allclose(each.linkage.first.fixed_pivot, [20, 90], rtol=0, atol=1e-9)
        assert misses(each.linkage, task.poses, 100.0).max() < 1e-6


@pytest.mark.parametrize(
    "asked",
    [
        {"types": {"crank-rocker"}},
        {"driver": "crank"},
        {"link_ratio": 2.5},
        {"transmission_deg": 50},
        {"footprint": box((-120, -120), (220, 220))},
    ],
    ids=str,
)
def test_requirements_are_kept(asked):
    task = task_of(OPENING, requirements=Requirements(**asked))
    synthesis = synthesize(task)
    assert synthesis.usable
    for each in synthesis.usable:
        assert not each.violations
        links = each.linkage.links
        if "types" in asked:
            assert each.type == "crank-rocker"
            # Grashof: the driver is shortest.
            assert min(links) == each.driver_first.links.driver
        if "link_ratio" in asked and links is not None:
            assert max(links) <= 2.5 * min(links) * (1 + 1e-9)
        if "transmission_deg" in asked:
            assert each.quality.transmission >= np.radians(50) - 1e-9
    # What is asked is not assumed again.
    assumed = " ".join(each.message for each in synthesis.warnings if each.code == "W215")
    assert ("link at most" in assumed) is False
    assert ("transmission" in assumed) == ("transmission_deg" not in asked)


def test_the_recommended_one_is_best_by_the_rule_and_no_other_is_surpassed():
    synthesis = synthesize(task_of(OPENING))
    pinned = [each for each in synthesis.usable if each.linkage.links is not None]
    assert synthesis.usable[0] is pinned[0]
    figures = np.array(
        [(e.quality.transmission, e.quality.extent, e.quality.sensitivity) for e in pinned]
    )
    figures[:, 0] = np.minimum(figures[:, 0], np.radians(60))
    near = figures[:, 0] >= figures[:, 0].max() - np.radians(0.5)
    assert near[0]
    product = figures[:, 1] * figures[:, 2]
    assert product[0] == product[near].min()
    worse = figures * [-1, 1, 1]
    for k, row in enumerate(worse):
        others = np.delete(worse, k, axis=0)
        assert not (others <= row - 1e-9).all(axis=1).any()


@pytest.mark.parametrize(("prefer", "figure"), [("size", "extent"), ("accuracy", "sensitivity")])
def test_what_is_preferred_comes_first(prefer, figure):
    task = task_of(OPENING)
    usual = synthesize(task).usable
    preferred = synthesize(task, prefer=prefer).usable
    least = min(
        float(getattr(each.quality, figure)) for each in preferred if each.linkage.links is not None
    )
    first = float(getattr(preferred[0].quality, figure))
    assert first <= 1.1 * least
    assert first < float(getattr(usual[0].quality, figure))


def test_the_front_is_what_comparing_all_with_all_leaves():
    rng = np.random.default_rng(5)
    rows = rng.normal(size=(300, 3)).round(1)
    kept = set(front(rows).tolist())
    for k, row in enumerate(rows):
        surpassed = ((rows <= row).all(axis=1) & (rows < row).any(axis=1)).any()
        assert not (surpassed and k in kept)
    assert {tuple(rows[k]) for k in kept} == {
        tuple(row)
        for row in rows
        if not ((rows <= row).all(axis=1) & (rows < row).any(axis=1)).any()
    }


def test_linkages_shown_are_far_apart_and_as_many_as_may_be():
    points = np.array([[0.0], [0.2], [1.0], [3.0], [3.1]])
    assert far_apart(points, [0, 1], most=4, least=0.5) == [0, 4, 2]
    assert far_apart(points, [0], most=2, least=0.5) == [0, 4]


def test_another_unit_and_other_frames_change_nothing():
    task = task_of(OPENING)
    moved = Displacement(np.array([30.0, -70.0]), np.array(0.7)) @ task.poses
    inches = replace(task, poses=Displacement(task.poses.translation / 25.4, task.poses.angle))
    one = synthesize(task).usable[0].quality
    small = synthesize(inches).usable[0].quality
    assert np.degrees(abs(one.transmission - small.transmission)) < 0.5
    # The box for pivots stands upright in F: a turned task has another one.
    turned = synthesize(replace(task, poses=moved)).usable[0].quality
    assert np.degrees(abs(one.transmission - turned.transmission)) < 8


def test_three_places_of_a_body_that_only_translates_get_parallelograms_within_limits():
    at = np.radians([35.0, 60.0, 100.0])
    rows = np.column_stack([80 * np.cos(at), 80 * np.sin(at), np.zeros(3)])
    limits = Limits(fixed_pivot=box((-60, -60), (60, 60)), moving_pivot=box((-60, -60), (60, 60)))
    synthesis = synthesize(task_of(rows, limits=(limits,)))
    best = synthesis.usable[0]
    for dyad in (best.linkage.first, best.linkage.second):
        assert np.isclose(dyad.radius, 80)
        assert limits.fixed_pivot.distance(dyad.fixed_pivot) < 1e-7
    # 35, 60, 100 degrees to a coupler of best direction: 25 degrees to either side of 67.5.
    assert np.isclose(np.degrees(best.quality.transmission), 57.5, atol=0.6)


def test_what_is_assumed_is_said_and_may_be_changed():
    few = synthesize(task_of(OPENING[:2]))
    (said,) = (each for each in few.warnings if each.code == "W215")
    for option in ("--fixed-pivot", "--moving-pivot", "--min-transmission", "--link-ratio"):
        assert option in said.help
    for each in few.usable:
        assert each.quality.transmission >= np.radians(30) - 1e-9
        if each.linkage.links is not None:
            assert max(each.linkage.links) <= 5 * min(each.linkage.links) * (1 + 1e-9)


def test_a_region_out_of_reach_has_no_linkage():
    limits = Limits(fixed_pivot=box((5000, 5000), (5010, 5010)), moving_pivot=box((0, 0), (10, 10)))
    synthesis = synthesize(task_of(FOUR, limits=(limits,)))
    assert not synthesis.usable
    assert synthesis.outcome.code in {"R303", "R309"}


def test_rounded_linkages_keep_the_order_of_the_rule_and_are_printed_whole():
    """Once the smallest error came first: 57 degrees before 77, and pivots were told as open."""
    poses = Displacement.from_poses(
        [(x, y, np.radians(a)) for x, y, a in [(0, 0, 5), (60, 180, 48), (20, 330, 92)]]
    )
    limits = Limits(
        fixed_pivot=box([-250, -200], [300, 300]), moving_pivot=box([-400, -60], [50, 60])
    )
    task = Task(poses, limits=(limits,), length_unit="mm")
    result = motion_generation.synthesize(task, SynthesisOptions(rounding_step=1.0))
    found = list(result.linkages)
    assert len(found) > 1
    assert recommended_first(found[::-1], result.problem) == found
    assert "W209" not in {each.code for each in result.warnings}
    for each in dimensions(result, found[0]):
        if each.what in ("fixed pivot", "moving pivot", "length"):
            assert "." not in each.value


def test_the_rule_orders_linkages_as_they_are_to_be_built():
    poses = Displacement.from_poses([(0, 0, 0), (3, 2, 0.6), (4, 5, 1.3)])
    result = motion_generation.synthesize(Task(poses))
    one = next(each for each in result.linkages if each.usable and not each.shortcomings)
    assert one.quality is not None

    def like(least, extent, **other):
        degrees = np.radians(least)
        figures = replace(one.quality, transmission=degrees, extent=extent, sensitivity=3.0)
        return replace(one, quality=figures, **other)

    slider = replace(one.dyads[0], dyad=PR(0.3, 1.0, [1, 2]))
    best, small = like(50, 4.0), like(49.7, 1.0)
    weak, sliding = like(40, 1.0), like(55, 1.0, dyads=(slider, one.dyads[1]))
    poor, broken = like(58, 1.0, shortcomings=("...",)), like(59, 1.0, usable=False)
    order = [small, best, weak, sliding, poor, broken]
    for mixed in (order[::-1], [best, broken, sliding, poor, weak, small]):
        assert recommended_first(mixed, result.problem) == order
