"""The map of a family, against linkages that are driven pose by pose by code of its own."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from burmester import (
    PR,
    RR,
    Displacement,
    InputError,
    Linkage,
    Polygon,
    Task,
    dyad_curve,
    synthesize,
)
from burmester.dyads.three_poses import dyad_with_fixed_pivot
from burmester.families.family_map import curve_map, family_map, plane_map
from burmester.families.pair_verdicts import PairBounds, PairClass, judged_pairs
from burmester.fourbar.defects import judge
from burmester.geometry.regions import Point
from burmester.io.cases import load
from burmester.requirements.types import GROUPS
from burmester.synthesis.family_map import family_map_of
from burmester.tasks.limits import Limits
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.requirements import Requirements
from tests.oracles.pair_verdicts import CLASSES, driven, verdict

RANDOM = range(8)


def random_task(rng, count, **more):
    turn = np.sort(rng.uniform(-1.2, 1.6, count))
    return Task(Displacement(rng.normal(size=(count, 2)), turn), **more)


def published_task(**more):
    """Four of five poses that a good four-bar meets: much of their family works."""
    return Task.from_rows(load("ge2012-exact")["poses"][:4], angle_unit="deg", **more)


def compared(found, task, pairs, areas=None):
    """How many verdicts on pairs (i, j) are the witness's own; asserts that no one differs."""
    span = float(np.hypot(*np.ptp(task.poses.translation, axis=0)))
    seen = Counter()
    for i, j in pairs:
        first = found.first[i] if found.kind == "curve" else found.first
        second = found.second[j] if found.kind == "curve" else found.second[i, j]
        told = verdict((first, second), task.poses, span, areas)
        if told is None:
            continue
        name, angle = told
        assert found.verdicts.classes[i, j] == CLASSES.index(name), (i, j, told)
        assert np.degrees(found.verdicts.transmission[i, j]) == pytest.approx(
            angle, abs=0.02, nan_ok=True
        )
        seen[name] += 1
    return seen


def some_pairs(found, rng, count):
    """Pairs of each class that there is, `count` of each at most, but for those of one dyad."""
    for kind in PairClass:
        if kind != PairClass.NO_LINKAGE:
            rows = np.argwhere(found.verdicts.classes == kind)
            yield from rng.permutation(rows)[:count].tolist()


def test_random_pairs_of_four_poses_are_as_a_witness_drives_them():
    rng, seen = np.random.default_rng(7), Counter()
    for _ in RANDOM:
        task = random_task(rng, 4)
        found = curve_map(task, samples=90)
        seen += compared(found, task, some_pairs(found, rng, 6))
    assert min(seen[name] for name in CLASSES if name != "farther") >= 10, seen


def test_pivots_beyond_what_is_assumed_are_a_class_of_their_own():
    task = published_task()
    areas = [(-4.0, -5.0), (2.5, 6.0)], [(-3.0, -4.0), (4.5, 2.0)]
    boxes = (Polygon([low, (high[0], low[1]), high, (low[0], high[1])]) for low, high in areas)
    bounds = replace(PairBounds.of(task), **dict(zip(("fixed", "moving"), boxes, strict=True)))
    found = curve_map(task, bounds, samples=90)
    rng = np.random.default_rng(9)
    seen = compared(found, task, some_pairs(found, rng, 40), areas)
    assert min(seen[name] for name in CLASSES) >= 10, seen
    # A limit of the task's own takes the place of what is assumed.
    own = Task(task.poses, limits=(Limits(fixed_pivot=BOX),))
    free = curve_map(own, replace(bounds, moving=None), samples=90)
    assert (free.verdicts.classes != PairClass.FARTHER).all()
    assert (free.verdicts.classes == PairClass.WORKS).any()


def test_random_pairs_of_three_poses_are_as_a_witness_drives_them():
    rng, seen = np.random.default_rng(8), Counter()
    for _ in RANDOM:
        task = random_task(rng, 3)
        chosen = dyad_with_fixed_pivot(task.poses, rng.normal(size=2))
        found = plane_map(task, chosen, [-4, -4], [4, 4], columns=30, rows=25)
        seen += compared(found, task, some_pairs(found, rng, 6))
    assert min(seen[name] for name in CLASSES if name != "farther") >= 10, seen


def test_a_curve_s_map_is_the_same_for_both_orders_of_a_pair():
    found = curve_map(published_task(), samples=60)
    classes, angle, driver = found.verdicts
    assert (classes == classes.T).all()
    assert np.array_equal(angle, angle.T, equal_nan=True)
    off = ~np.eye(len(classes), dtype=bool)
    worked = off & np.isfinite(angle)
    assert worked.any()
    assert (driver[worked] == 1 - driver.T[worked]).all()
    assert (classes.diagonal() == PairClass.NO_LINKAGE).all()
    best, greatest = found.best_partner()
    for k in range(len(best)):
        row = [
            (c, -t if np.isfinite(t) else 0.0) for c, t in zip(classes[k], angle[k], strict=True)
        ]
        assert (best[k], -np.nan_to_num(greatest[k])) == min(row)


def test_places_along_the_loops_are_even():
    task = published_task()
    found, curve = curve_map(task, samples=80), dyad_curve(task.poses, 80)
    sizes = [part.radius.size for part in curve.components]
    assert np.bincount(found.loop).tolist() == sizes
    start = 0
    for part, size in zip(curve.components, sizes, strict=True):
        own = slice(start, start + size)
        assert np.array_equal(found.first.fixed_pivot[own], part.fixed_pivot)
        assert np.diff(found.position[own]) == pytest.approx(1 / size)
        assert 0 <= found.position[own].min() < found.position[own].max() < 1
        start += size


BOX = Polygon([[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0]])
BODY_BOX = Polygon([[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]])


def inside(box, point):
    (x0, y0), (x1, y1) = box.vertices.min(axis=0), box.vertices.max(axis=0)
    return x0 <= point[0] <= x1 and y0 <= point[1] <= y1


@pytest.mark.parametrize("two", [False, True])
def test_pairs_outside_the_limits_are_outside_the_bounds(two):
    own = Limits(fixed_pivot=BOX, length=(0.3, 5.0))
    limits = (own, Limits(moving_pivot=BODY_BOX)) if two else (own,)
    free = published_task()
    task = Task(free.poses, limits=limits)
    before, after = (curve_map(each, samples=100) for each in (free, task))

    def meets(dyad, each):
        ok = each.fixed_pivot is None or inside(each.fixed_pivot, dyad.fixed_pivot)
        ok &= each.moving_pivot is None or inside(each.moving_pivot, dyad.moving_pivot)
        return ok and each.length[0] <= dyad.radius <= each.length[1]

    kept = lost = 0
    for i, j in np.argwhere(before.verdicts.classes == PairClass.WORKS):
        one, other = before.first[i], before.first[j]
        a, b = (limits * 2)[:2]
        ok = (meets(one, a) and meets(other, b)) or (meets(one, b) and meets(other, a))
        want = PairClass.WORKS if ok else PairClass.OUTSIDE_BOUNDS
        assert after.verdicts.classes[i, j] == want
        kept, lost = kept + ok, lost + (not ok)
    assert min(kept, lost) > 0


@pytest.mark.parametrize(
    ("asked", "holds"),
    [
        ({"transmission_deg": 45}, lambda links, angle, kind: angle >= np.radians(45)),
        ({"link_ratio": 3}, lambda links, angle, kind: max(links) <= 3 * min(links)),
        ({"types": {"grashof"}}, lambda links, angle, kind: kind in GROUPS["grashof"]),
    ],
)
def test_what_the_task_asks_is_asked_of_each_pair(asked, holds):
    free = published_task()
    task = Task(free.poses, requirements=Requirements(**asked))
    before, after = (curve_map(each, samples=100) for each in (free, task))
    kept = lost = 0
    for i, j in np.argwhere(before.verdicts.classes == PairClass.WORKS):
        pair = Linkage(before.first[i], before.first[j])
        ok = holds(pair.links, before.verdicts.transmission[i, j], pair.type)
        assert after.verdicts.classes[i, j] == (PairClass.WORKS if ok else PairClass.OUTSIDE_BOUNDS)
        kept, lost = kept + ok, lost + (not ok)
    assert min(kept, lost) > 0


def test_pivots_keep_to_the_footprint_along_the_motion():
    free = published_task()
    room = Polygon([[-6.0, -6.0], [6.0, -6.0], [6.0, 6.0], [-6.0, 6.0]])
    small = Polygon(room.vertices / 2)
    classes = [
        curve_map(Task(free.poses, requirements=Requirements(footprint=each)), samples=80)
        for each in (room, small)
    ]
    wide, narrow = (each.verdicts.classes == PairClass.WORKS for each in classes)
    assert wide.sum() > narrow.sum() > 0
    assert (narrow <= wide).all()
    for i, j in np.argwhere(narrow):
        for dyad in (classes[1].first[i], classes[1].first[j]):
            assert inside(small, dyad.fixed_pivot)
            assert all(inside(small, at) for at in free.poses.act(dyad.moving_pivot))


def test_any_order_leaves_no_order_defect():
    free = published_task()
    before = curve_map(free, samples=80).verdicts.classes
    after = curve_map(Task(free.poses, requirements=Requirements(any_order=True)), samples=80)
    assert (before == PairClass.ORDER).sum() > 100
    assert (after.verdicts.classes != PairClass.ORDER).all()
    assert ((after.verdicts.classes == PairClass.CIRCUIT) == (before == PairClass.CIRCUIT)).all()


def test_a_slider_may_be_the_chosen_dyad_of_three_poses():
    rng = np.random.default_rng(5)
    at = random_task(rng, 3).poses
    # A slider through three places in a row of one point of the body.
    slider = PR(0.3, 0.2, [0.4, -0.1])
    along = np.array([-1.0, 0.2, 1.3])[:, None] * [-np.sin(0.3), np.cos(0.3)]
    point = 0.2 * np.array([np.cos(0.3), np.sin(0.3)]) + along
    poses = Displacement(point - at.rotate(np.array([0.4, -0.1])), at.angle)
    found = plane_map(Task(poses), slider, [-4, -4], [4, 4], columns=20, rows=20)
    seen = set()
    for i, j in np.ndindex(20, 20):
        pair = Linkage(slider, found.second[i, j])
        (told,) = judge(
            Linkage(slider[None], found.second[i, j][None]),
            poses[None],
            missed=np.zeros((1, 3)),
            reach=1.0,
        )
        assert pair.type == "slider-crank"
        sides = [
            {d.kind for d in (*told.defects, *each.defects)} for each in (told.first, told.second)
        ]
        sound = any(not each for each in sides)
        kind = found.verdicts.classes[i, j]
        assert sound == (kind <= PairClass.OUTSIDE_BOUNDS)
        seen.add(int(kind))
    assert len(seen) > 2


def test_another_number_of_poses_is_refused():
    five = random_task(np.random.default_rng(1), 5)
    with pytest.raises(InputError, match="4 poses are needed"):
        curve_map(five)
    with pytest.raises(InputError, match="3 poses"):
        plane_map(five, RR([0, 0], [1, 0], 1.0), [-1, -1], [1, 1])


@pytest.mark.parametrize("driver", ["first", "second"])
def test_the_driver_that_is_asked_for_drives(driver):
    low, high = BOX.vertices.min(axis=0), BOX.vertices.max(axis=0)
    left = Polygon([low, [0, low[1]], [0, high[1]], [low[0], high[1]]])
    right = Polygon([[0, low[1]], [high[0], low[1]], high, [0, high[1]]])
    limits = Limits(fixed_pivot=left), Limits(fixed_pivot=right)
    task = published_task(limits=limits, requirements=Requirements(driver=driver))
    found = curve_map(task, samples=100)
    where = left if driver == "first" else right
    works = np.argwhere(found.verdicts.classes == PairClass.WORKS)
    assert len(works) > 0
    for i, j in works:
        drives = (found.first[i], found.first[j])[found.verdicts.driver[i, j]]
        assert inside(where, drives.fixed_pivot)


def published(name):
    data = load(name)
    task = Task.from_rows(data["poses"], angle_unit="deg")
    c, r, m = (np.array(data["exact_dyads"])[:, at] for at in ([0, 1], 2, [3, 4]))
    return task, RR(c, m, r)


def test_motiongen_s_dyads_on_a_line_are_on_the_curve_and_judged_as_they_are_driven():
    task, dyads = published("motiongen-four-line")
    found = curve_map(task, samples=300)
    for k in range(3):
        at = found.nearest(dyads[k])
        beside = found.first.fixed_pivot[[at - 1, at, (at + 1) % 300]]
        steps = np.diff(beside, axis=0)
        gap = dyads.fixed_pivot[k] - beside[:2]
        off = steps[:, 0] * gap[:, 1] - steps[:, 1] * gap[:, 0]
        assert (np.abs(off) / np.linalg.norm(steps, axis=1)).min() < 2e-3
    one, other = np.array([0, 0, 1]), np.array([1, 2, 2])
    told = judged_pairs(dyads[one], dyads[other], task, PairBounds.of(task))
    span = float(np.hypot(*np.ptp(task.poses.translation, axis=0)))
    for k in range(3):
        name, angle = verdict((dyads[one[k]], dyads[other[k]]), task.poses, span)
        assert told.classes[k] == CLASSES.index(name)
        degrees = np.degrees(told.transmission[k])
        assert degrees == pytest.approx(angle, abs=0.02, nan_ok=True)


def test_motiongen_s_three_poses_with_two_fixed_pivots_have_their_place_in_the_plane():
    task, dyads = published("motiongen-three-pivots")
    found = plane_map(task, dyads[0], [-5, -1], [-1, 3], columns=5, rows=5)
    own = found.second[2, 2]
    assert own.fixed_pivot == pytest.approx([-3, 1])
    assert own.moving_pivot == pytest.approx(dyads.moving_pivot[1])
    name, angle = driven(dyads[0], dyads[1], task.poses)
    assert name == "works"
    assert angle < 30  # so it is below the standard
    assert found.verdicts.classes[2, 2] == PairClass.OUTSIDE_BOUNDS
    assert found.verdicts.driver[2, 2] == 0
    assert np.degrees(found.verdicts.transmission[2, 2]) == pytest.approx(angle, abs=0.02)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("count", [3, 4])
def test_what_is_recommended_works_on_the_map_with_the_angle_that_is_told(count, seed):
    rng = np.random.default_rng(seed)
    poses = np.array([[0, 0, 0], [30, 40, 0.4], [70, 55, 0.8], [105, 50, 1.1]])[:count]
    poses = poses + rng.normal(scale=0.2, size=(count, 3)) * [10, 10, 0.3]
    result = synthesize(Task(Displacement(poses[:, :2], poses[:, 2]), length_unit="mm"))
    best = result.linkages[0]
    assert best.usable
    found = family_map_of(result, samples=60, columns=8, rows=6)
    first, second = (each[None] for each in (best.linkage.first, best.linkage.second))
    told = judged_pairs(first, second, result.problem.task, found.bounds)
    assert told.classes == PairClass.WORKS
    assert told.transmission >= best.driven.least_over_range - 1e-9  # by the better driver
    if count == 4:
        i, j = (found.nearest(each) for each in (best.linkage.first, best.linkage.second))
        assert found.verdicts.classes[i, j] <= PairClass.OUTSIDE_BOUNDS
    else:
        assert found.first in (best.linkage.first, best.linkage.second)


def test_the_rectangle_of_three_poses_is_where_pivots_may_be():
    poses = published_task().poses[:3]
    pair = Linkage(*(dyad_with_fixed_pivot(poses, at) for at in ([-2.0, -1.0], [1.0, 2.0])))
    boxes = [
        Polygon([low, (high[0], low[1]), high, (low[0], high[1])])
        for low, high in (((-3.0, -2.0), (0.0, 1.0)), ((0.0, 0.0), (2.0, 8.0)))
    ]
    tasks = {
        "regions": Task(poses, limits=tuple(Limits(fixed_pivot=box) for box in boxes)),
        "poses": Task(poses, limits=(Limits(fixed_pivot=boxes[0]), Limits())),
    }
    for name, task in tasks.items():
        found = family_map(task, pair, columns=41, rows=31)
        assert found.first is pair.first
        at = found.second.fixed_pivot
        low, high = at[0, 0], at[-1, -1]
        corners = np.concatenate([box.vertices for box in boxes])
        held = corners if name == "regions" else poses.translation
        held = np.concatenate([held, [[-2.0, -1.0], [1.0, 2.0]]])
        assert (held > low).all()
        assert (held < high).all()
        assert (high - low)[0] / (high - low)[1] == pytest.approx(4 / 3)
        if name == "regions":  # and no more than it takes
            assert (high - low).max() < 1.5 * np.ptp(held, axis=0).max()


def test_of_three_poses_the_dyad_at_its_place_is_chosen():
    poses = published_task().poses[:3]
    one, other = (dyad_with_fixed_pivot(poses, at) for at in ([-2.0, -1.0], [1.0, 2.0]))
    at_a_point = Limits(fixed_pivot=Point([1.0, 2.0])), Limits()
    found = family_map(Task(poses, limits=at_a_point), Linkage(one, other), columns=5, rows=4)
    assert found.first is other
    slider = Linkage(one, PR(0.1, 0.2, [0.0, 1.0]))
    assert isinstance(family_map(Task(poses), slider, columns=5, rows=4).first, PR)
    assert family_map(Task(poses)) is None
    with pytest.raises(InputError, match="no family to map"):
        family_map(Task(poses, limits=at_a_point[:1]), Linkage(one, other))
    tolerant = Task(poses, tolerances=PoseTolerances(np.full((3, 2), 0.1), np.full(3, 0.1)))
    with pytest.raises(InputError, match="met exactly"):
        family_map(tolerant, Linkage(one, other))
