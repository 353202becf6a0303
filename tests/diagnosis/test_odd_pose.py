"""The one wrong pose, against forward simulation, brute force and SciPy's F distribution."""

import numpy as np
import pytest
from benchmarks import odd_pose as campaign
from scipy.stats import combine_pvalues, f

from burmester import Displacement, Task
from burmester.diagnosis.checks import (
    best_exchange,
    distances_between,
    path_length,
    swapped_poses,
)
from burmester.diagnosis.leave_one_out import LeaveOneOut
from burmester.diagnosis.noise_ratio import chance_of_number, chance_of_pose
from burmester.diagnosis.odd_pose import odd_pose
from burmester.diagnosis.repairs import Prediction
from burmester.diagnosis.sampson_fits import NormalizedPoses, sampson_residuals
from burmester.diagnosis.unit_errors import Multiple, coincidence_chance, combined_chance
from burmester.dyads.local_minima import best_dyads
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.io.cases import load
from burmester.io.reading.poses import read_task
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.requirements import Requirements
from burmester.wording import figure
from tests.oracles.first_order import least_sum
from tests.oracles.witness import misses, random_four_bar, random_poses

CASE = load("ge2012-exact")
RIGHT = np.array(CASE["poses"])
RESOLUTION = 5e-5, np.radians(5e-3)


def table(rows=RIGHT, **more):
    """Table 2 as a task, with its digits."""
    rows = np.asarray(rows)
    poses = Displacement(rows[:, :2], np.radians(rows[:, 2]))
    return Task(poses, **{"resolution": RESOLUTION, **more})


def changed(pose, **numbers):
    """Table 2 with numbers of one pose (from 0) changed."""
    rows = RIGHT.copy()
    for name, value in numbers.items():
        rows[pose, ("x", "y", "angle").index(name)] = value
    return rows


PRINTED = np.array(CASE["poses_as_printed"])


def test_the_wrong_row_of_table_2_is_named():
    odd = odd_pose(table(PRINTED))
    assert odd.pose == 5
    assert odd.others == ()
    assert odd.message == "pose 6 does not agree with the others"
    assert odd.help == ("check its angle 52.67°: 52.87° would agree; or leave it out with --drop 6")
    assert odd.why.startswith("leaving it out lowers the error from 0.00")
    assert odd.ratio > 15
    assert [each.kind for each in odd.repairs] == ["angle"]


def test_table_2_is_right():
    assert odd_pose(table()) is None
    assert odd_pose(table(resolution=(0.0, 0.0))) is None
    assert odd_pose(read_task("case:ge2012-exact")) is None


def test_errors_are_those_of_the_best_linkages():
    """By driving the linkage, and by minimising its dyads' distances with SciPy."""
    task = table(PRINTED)
    odd = odd_pose(task)
    away = misses(odd.linkage, task.poses, odd.length)
    keep = np.arange(10) != 5
    assert np.sqrt((away[keep] ** 2).mean()) == pytest.approx(odd.error_without, rel=1e-3)
    assert away[5] == pytest.approx(odd.miss, rel=1e-3)

    def rms(poses):
        return np.sqrt(least_sum(odd, poses) / len(poses.angle))

    assert rms(task.poses[keep]) == pytest.approx(odd.error_without, rel=0.01)
    assert rms(task.poses) == pytest.approx(odd.error, rel=0.05)


def test_distances_to_first_order_are_those_of_a_linkage_driven():
    rng = np.random.default_rng(4)
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, 6)
    batch, share = LinkageBatch.of([Linkage(*dyads)]), np.ones((1, 6))
    off = rows + 1e-3 * rng.normal(size=rows.shape)
    near = np.linalg.norm(sampson_residuals(batch, off, share)[0].reshape(6, 2), axis=1)
    assert near == pytest.approx(misses(Linkage(*dyads), Displacement.from_poses(off), 1.0), 0.03)
    miss, slope = sampson_residuals(batch, rows, share)  # on the linkage: there they are exact
    step = 1e-7 * rng.normal(size=(2, 5))
    moved = LinkageBatch(batch.kinds, batch.dimensions + step)
    change = sampson_residuals(moved, rows, share)[0] - miss
    assert change[0] == pytest.approx(slope[0] @ step.ravel(), abs=1e-11)


def test_the_chance_is_that_of_an_f_test():
    for count, without, of_all in ((8, 1.0, 90.0), (12, 2.0, 7.0), (15, 0.3, 1.0)):
        spare = 2 * count - 12
        value = (of_all - without) / 2 / (without / spare)
        expected = count * f.sf(value, 2, spare)
        assert chance_of_pose(count, without, of_all) == pytest.approx(min(1.0, expected))


def test_the_chance_of_one_number_is_that_of_an_f_test():
    """A bound, and a close one where it is small."""
    for count, mended, of_all in ((8, 1.0, 60.0), (12, 2.0, 7.0), (15, 0.3, 1.0)):
        spare = 2 * count - 11
        expected = 3 * count * f.sf((of_all - mended) / (mended / spare), 1, spare)
        assert 1 <= chance_of_number(count, mended, of_all) / min(1.0, expected) < 1.15
    assert chance_of_number(12, 6.9, 7.0) == 1.0


def test_dyads_that_are_given_are_taken_in_their_own_frames():
    """They start the same fits: what is found is the same, to the last digit."""
    best = best_dyads(table(PRINTED).poses)
    circles, line = best.dyads, best.frames.line_from_canonical
    dyads = [circles[k] for k in range(len(best.rms_error))] + [line(x) for x in best.sliders]
    for rows in (PRINTED, changed(2, x=-2.6392 * 25.4, y=0.292 * 25.4)):
        task = table(rows)
        plain, given = odd_pose(task), odd_pose(task, classify_motion(task), dyads)
        assert given.pose == plain.pose
        assert given.error_without == pytest.approx(plain.error_without, rel=1e-6)
    seen = NormalizedPoses.of(table(PRINTED).poses, None)
    pairs, _ = LeaveOneOut.fit_all(seen, dyads, table(PRINTED).poses)
    again, _ = LeaveOneOut.fit_all(seen, (), table(PRINTED).poses)
    assert pairs.dimensions == pytest.approx(again.dimensions, rel=1e-6)


def test_a_pose_far_beside_is_told_by_its_place():
    rows = changed(2, x=-2.6392 * 1000, y=0.292 * 1000)
    odd = odd_pose(table(rows))
    assert odd.extents > 100
    others = np.delete(RIGHT, 2, axis=0)[:, :2]
    around = others - others.mean(axis=0)
    extent = np.sqrt(12 * (around**2).sum(axis=1).mean())  # of poses spread evenly
    far = np.linalg.norm(rows[2, :2] - others.mean(axis=0)) / extent
    assert odd.extents == pytest.approx(far, rel=1e-6)
    assert odd.why.endswith("times the others' extent away; divided by 1000 it lies among them")
    assert odd.why.startswith(f"it lies {figure(far)} ")
    assert odd.help.startswith("check its unit: x and y divided by 1000 would agree")


def test_a_multiple_lands_by_chance_as_often_as_is_told():
    """Of poses at random about a linkage, so many come so near to its motion."""
    rng = np.random.default_rng(8)
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, 200)
    seen = NormalizedPoses.of(Displacement.from_poses(rows), None)
    batch = LinkageBatch.of([Linkage(*dyads)]).to_canonical(seen.frames)
    near = Prediction.of(seen, batch, 0, 1e-3)
    low, high = seen.rows.min(axis=0), seen.rows.max(axis=0)
    tries = rng.uniform(low, high, size=(20000, 3))
    miss, _ = sampson_residuals(batch, tries, np.ones((1, len(tries))))
    off = (miss.reshape(-1, 2) ** 2).sum(axis=1)
    for reach in (1e-4, 1e-3):
        told = coincidence_chance(seen, near, Multiple(0, 0, seen.rows[1]), reach)
        assert 1 < told / (off < reach).mean() < 4


def test_two_chances_are_joined_as_fisher_does():
    for first, second in ((0.3, 0.01), (1e-3, 1e-4), (1.0, 0.2)):
        expected = combine_pvalues([first, second], method="fisher").pvalue
        assert combined_chance(first, second) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("rows", "pose", "kind", "factor"),
    [
        (changed(3, angle=np.degrees(43.94)), 3, "radians", np.radians(1.0)),
        (changed(3, angle=np.radians(43.94)), 3, "radians", np.degrees(1.0)),
        (changed(7, y=2.3408), 7, "sign", 1.0),
        (changed(8, x=-2.2742, y=-1.5557), 8, "swap", 1.0),
        (changed(1, angle=6.699), 1, "slip", 10.0),
        (changed(2, x=-2.6392 * 25.4, y=0.292 * 25.4), 2, "unit", 1 / 25.4),
        (changed(0, x=-0.8253 / 10, y=-1.0329 / 10), 0, "unit", 10.0),
        (changed(4, x=-4054.9, y=-214.1), 4, "unit", 1 / 1000),
    ],
)
def test_slips_are_told(rows, pose, kind, factor):
    odd = odd_pose(table(rows))
    assert (odd.pose, odd.repairs[0].kind) == (pose, kind)
    assert odd.repairs[0].factor == pytest.approx(factor)
    given = RIGHT[pose] * [1, 1, np.pi / 180]
    assert odd.repairs[0].values == pytest.approx(given, rel=1e-6)
    assert "would agree" in odd.help
    x, y, turn = rows[pose] * [1, 1, np.pi / 180]
    for each in odd.repairs:
        if each.kind == "unit":
            assert each.values == pytest.approx([x * each.factor, y * each.factor, turn])


@pytest.mark.parametrize(("number", "name"), [(0, "x"), (1, "y"), (2, "angle")])
def test_one_number_is_mended_as_exactly_as_the_others_know_it(number, name):
    """From far off, too; and told with no more digits than that."""
    for off in (0.05, 40.0 if number == 2 else 1.7):
        rows = RIGHT.copy()
        rows[6, number] += off
        odd = odd_pose(table(rows))
        assert odd.pose == 6
        repair = next(each for each in odd.repairs if each.kind == name)
        scale = np.pi / 180 if number == 2 else 1.0
        told = repair.message.split(": ")[1].split("°" if number == 2 else " ")[0]
        digit = 10.0 ** -len(told.partition(".")[2])
        assert abs(float(told) - RIGHT[6, number]) < 2.5 * digit
        assert repair.values[number] / scale == pytest.approx(float(told))
        assert digit >= (0.01 if number == 2 else 1e-4)


def test_nothing_mends_a_pose_that_is_wrong_in_all():
    odd = odd_pose(table(changed(2, x=-2.5392, y=0.252, angle=52.9)))
    assert odd.pose == 2
    assert odd.repairs == ()
    assert odd.help == "check the numbers of pose 3; or leave it out with --drop 3"


def test_wrong_poses_are_named_and_right_ones_are_not():
    """A sample of `python -m benchmarks.odd_pose`."""
    found, _ = campaign.counted("wrong", 6, 3, least=10)
    named = sum(times for (_, what), times in found.items() if what == "right")
    assert named >= 5
    for kind in ("noisy", "rough"):
        found, _ = campaign.counted(kind, 3, 3, most=12)
        assert {what for _, what in found} == {"silent"}
    found, told = campaign.counted("unit", 4, 3, least=9)
    assert sum(times for (_, what), times in found.items() if what == "right") == 4
    assert told == 4


@pytest.mark.parametrize("count", [45, 150])
def test_one_of_many_is_named(count):
    rng = np.random.default_rng(count)
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, count)
    rows += 1e-4 * rng.normal(size=rows.shape)
    assert odd_pose(Task(Displacement.from_poses(rows))) is None
    rows[7] += [0.0, 0.02, 0.02]
    odd = odd_pose(Task(Displacement.from_poses(rows)))
    assert odd.pose == 7
    some = Displacement.from_poses(rows[8 :: count // 30 + 1])
    away = misses(Linkage(*dyads), some, odd.length)
    assert odd.error_without == pytest.approx(np.sqrt((away**2).mean()), rel=0.4)
    rows[7, :2] *= 1000
    assert odd_pose(Task(Displacement.from_poses(rows))).pose == 7


def test_frames_and_units_do_not_matter():
    plain = odd_pose(table(PRINTED))
    c, s = np.cos(1.2), np.sin(1.2)
    rows = PRINTED.copy()
    rows[:, :2] = 25.4 * (PRINTED[:, :2] @ np.array([[c, s], [-s, c]])) + [300.0, -80.0]
    rows[:, 2] += np.degrees(1.2)
    moved = odd_pose(table(rows, resolution=(25.4 * RESOLUTION[0], RESOLUTION[1])))
    assert moved.pose == plain.pose
    assert moved.error == pytest.approx(25.4 * plain.error, rel=1e-2)
    assert moved.error_without == pytest.approx(25.4 * plain.error_without, rel=1e-2)


def test_repeats_are_one_pose_and_names_are_told():
    rows = np.concatenate([PRINTED, PRINTED[[5, 2, 5]]])
    names = tuple("abcdefghijklm")
    odd = odd_pose(table(rows, names=names))
    assert odd.pose == 5
    assert odd.message == "pose 6 (f) does not agree with the others"


def test_a_pose_that_hardly_counts_does_no_harm():
    weights = np.ones(10)
    assert odd_pose(table(PRINTED, weights=weights)).pose == 5
    weights[5] = 1e-6
    assert odd_pose(table(PRINTED, weights=weights)) is None


def test_it_is_silent_where_nothing_can_be_told():
    assert odd_pose(table(PRINTED[:6])) is None
    assert odd_pose(table(PRINTED, resolution=(2e-3, 2e-3))) is None  # as coarse as the misprint
    turn = np.linspace(0, 2, 9)
    about = np.column_stack([np.cos(turn), np.sin(turn), np.degrees(turn)])
    assert odd_pose(table(about)) is None


# --- the order


def test_the_exchange_that_saves_most_is_found():
    """Against every exchange, one by one."""
    rng = np.random.default_rng(1)
    for count in (6, 9, 13):
        away, _ = distances_between(Displacement.from_poses(rng.normal(size=(count, 3))))
        order = rng.permutation(count)
        every = []
        for i in range(count):
            for j in range(i + 1, count):
                other = order.copy()
                other[[i, j]] = other[[j, i]]
                every.append((path_length(away, order) - path_length(away, other), (i, j)))
        every.sort(reverse=True)
        (pair, saved), second = best_exchange(away, order)
        assert pair == every[0][1]
        assert (saved, second) == pytest.approx((every[0][0], every[1][0]))


def test_exchanged_poses_are_told():
    rows = RIGHT.copy()
    rows[[2, 6]] = rows[[6, 2]]
    found = swapped_poses(table(rows, names=tuple("abcdefghij")))
    assert (found.first, found.second) == (2, 6)
    assert found.message == "poses 3 (c) and 7 (g) seem to be exchanged"
    assert rows[list(found.order)] == pytest.approx(RIGHT)
    step = np.diff(RIGHT, axis=0)
    spread = np.sqrt(((RIGHT[:, :2] - RIGHT[:, :2].mean(axis=0)) ** 2).sum(axis=1).mean())
    whole = np.linalg.norm(step * [1, 1, spread * np.pi / 180], axis=1).sum()
    assert found.path_exchanged == pytest.approx(whole)
    assert swapped_poses(table(rows, requirements=Requirements(any_order=True))) is None
    assert swapped_poses(table(np.concatenate([rows, rows[:1]]))) is None


def test_poses_in_order_are_left_alone():
    """A sample of what `python -m benchmarks.odd_pose` counts."""
    said, right = 0, 0
    for index in range(60):
        rng = np.random.default_rng([5, index])
        made = campaign.ordered(rng, int(rng.integers(6, 16)))
        said += swapped_poses(made.task) is not None
        mixed, pair = campaign.swapped(rng, int(rng.integers(6, 16)))
        found = swapped_poses(mixed.task)
        right += found is not None and (found.first, found.second) == pair
    assert said <= 1
    assert right >= 40
    assert swapped_poses(table()) is None
