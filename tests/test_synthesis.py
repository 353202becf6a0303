"""The whole road, from a task to ranked linkages, every one of them driven."""

import json
from importlib import resources

import numpy as np
import pytest

from burmester.displacement import Displacement
from burmester.dyad import PR, RP, RR
from burmester.errors import InputError
from burmester.io.poses import read_task
from burmester.synthesis import synthesize
from burmester.task import Task
from tests.witness import misses, random_four_bar, random_poses, span


def drive_all(synthesis, slack=0.0):
    """Every linkage is driven by the witness and comes as near as the synthesis says.

    Far from the poses the nearest place is a heuristic, and may be short of it by `slack`.
    """
    poses, length = synthesis.task.poses, synthesis.length
    assert synthesis.linkages
    for found in synthesis.linkages:
        ours = np.hypot(found.error.position, length * found.error.angle)
        witness = misses(found.linkage, poses, length)
        assert (ours <= witness * (1 + slack) + 1e-6 * length).all()
        for dyad in found.dyads:  # and its places are places of both dyads
            assert np.abs(dyad.dyad.residual(found.error.places)).max() < 1e-8 * length


@pytest.mark.parametrize("name", ["ge2012-exact", "ge2012-approximate"])
def test_the_papers_ten_poses(name):
    synthesis = synthesize(read_task(f"case:{name}"))
    drive_all(synthesis)
    (best,) = synthesis.linkages
    assert synthesis.method == "pencil"
    assert best.error.worst < {"ge2012-exact": 2e-4, "ge2012-approximate": 0.04}[name]


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("motiongen-rrrp", {RR, PR}),
        ("motiongen-rrpr", {RR, RP}),
        ("motiongen-prpr", {PR, RP}),
    ],
)
def test_published_sliders_are_called_sliders(name, kinds):
    case = json.loads(resources.files("burmester").joinpath(f"cases/{name}.json").read_text())
    synthesis = synthesize(read_task(f"case:{name}"))
    assert {type(found.dyad) for found in synthesis.dyads} == kinds
    drive_all(synthesis)
    assert synthesis.linkages[0].error.worst < 5e-4 * span(case["poses"])
    for found in synthesis.dyads:
        if isinstance(found.dyad, RR):
            (xc, yc, r, x, y), *_ = case["expected"]["RR"]
            assert np.allclose(found.dyad.fixed_pivot, [xc, yc], atol=2e-3)
            assert np.allclose(found.dyad.moving_pivot, [x, y], atol=2e-3)
            assert np.isclose(found.dyad.radius, r, atol=2e-3)


@pytest.mark.parametrize(("name", "dyads"), [("motiongen-shoulder", 4), ("motiongen-mixed5", 2)])
def test_published_five_pose_tasks_give_every_pair(name, dyads):
    synthesis = synthesize(read_task(f"case:{name}"))
    assert synthesis.method == "exact"
    assert len(synthesis.linkages) == dyads * (dyads - 1) // 2
    pairs = {frozenset(d.id for d in found.dyads) for found in synthesis.linkages}
    assert len(pairs) == len(synthesis.linkages)
    drive_all(synthesis)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("second", [RR, PR, RP])
@pytest.mark.parametrize("count", [5, 6, 12])
def test_round_trip_of_random_linkages(second, count, seed):
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng, second)
    rows = random_poses(dyads, rng, count)
    synthesis = synthesize(Task(Displacement.from_poses(rows)))
    drive_all(synthesis)
    true_kinds = sorted(type(d).__name__ for d in dyads)
    met = [
        found
        for found in synthesis.linkages
        if found.error.worst < 1e-7 * span(rows)
        and sorted(type(d.dyad).__name__ for d in found.dyads) == true_kinds
    ]
    for wanted in dyads:
        # The generating dyad is among those of the linkages that meet the poses.
        gaps = [
            np.abs(dyad.dyad.residual(Displacement.from_poses(rows))).max()
            + min(
                np.abs(getattr(dyad.dyad, field) - getattr(wanted, field)).max()
                for field in ("fixed_pivot", "moving_pivot")
                if hasattr(wanted, field)
            )
            for found in met
            for dyad in found.dyads
            if type(dyad.dyad) is type(wanted)
        ]
        assert min(gaps) < 1e-6 * span(rows)


def test_ranking_is_by_worst_error_and_does_not_depend_on_pose_order():
    rng = np.random.default_rng(5)
    rows = random_poses(random_four_bar(rng), rng, 5)
    first = synthesize(Task(Displacement.from_poses(rows)))
    again = synthesize(Task(Displacement.from_poses(rows[::-1])))
    assert [f.linkage.type for f in first.linkages] == [f.linkage.type for f in again.linkages]
    for one, other in zip(first.dyads, again.dyads, strict=True):
        assert np.allclose(one.dyad.fixed_pivot, other.dyad.fixed_pivot, atol=1e-7)
    noisy = rng.normal(scale=0.02, size=(20, 3)) + random_poses(random_four_bar(rng), rng, 20)
    ranked = synthesize(Task(Displacement.from_poses(noisy))).linkages
    worst = [found.error.worst for found in ranked]
    assert worst == sorted(worst)


@pytest.mark.parametrize(
    ("name", "worst", "rms"), [("ge2012-approximate", 0.0085, 0.0050), ("ge2012-exact", 2e-4, 1e-4)]
)
def test_complete_method_on_the_papers_poses(name, worst, rms):
    task = read_task(f"case:{name}")
    complete = synthesize(task, "complete")
    assert "25 of 25 critical points accounted for" in complete.outcome.message
    drive_all(complete)
    best = complete.linkages[0].error
    assert best.worst < worst
    assert np.sqrt((best.position**2).mean()) < rms
    assert best.worst <= synthesize(task, "pencil").linkages[0].error.worst * 1.2


@pytest.mark.parametrize("second", [RR, PR, RP])
@pytest.mark.parametrize("seed", range(6))
def test_complete_method_finds_the_linkage_behind_noisy_poses(second, seed):
    rng = np.random.default_rng(seed)
    rows = random_poses(random_four_bar(rng, second), rng, 12)
    noise = 1e-4 * span(rows)
    noisy = rows + noise * rng.normal(size=rows.shape)
    synthesis = synthesize(Task(Displacement.from_poses(noisy)), "complete")
    drive_all(synthesis, slack=0.05)
    # The linkage behind them misses by the noise; the best one found does hardly worse.
    assert synthesis.linkages[0].error.worst < 20 * noise
    assert len({found.id for found in synthesis.dyads}) == len(synthesis.dyads)


SPECIAL = {
    "a translation": lambda a: (np.column_stack([np.cos(a), a**2]), 0 * a + 0.4),
    "a translation without a turn": lambda a: (np.column_stack([np.exp(a), a**3]), 0 * a),
    "a turn about a point": lambda a: (np.full((len(a), 2), 3.5), a),
    "two sliders": lambda a: (np.column_stack([-2 * np.cos(a), 0 * a]), a),
    "a parallelogram": lambda a: (np.column_stack([np.cos(a), np.sin(a)]), 0 * a),
    "rest": lambda a: (np.ones((len(a), 2)), 0 * a + 1),
}


@pytest.mark.parametrize("count", [5, 6, 7, 9])
@pytest.mark.parametrize("name", SPECIAL)
def test_special_motions_are_named_and_nothing_is_invented(name, count):
    translation, angle = SPECIAL[name](np.linspace(0.1, 2.5, count))
    synthesis = synthesize(Task(Displacement(translation, angle)))
    assert synthesis.outcome.code == "R304"
    assert synthesis.linkages == ()
    assert synthesis.dyads == ()


def test_two_different_angles_are_no_dyad():
    rows = [(-8.2, 8.2, -0.3), (-2.2, 14.5, -0.3), (-12.8, -3.7, 2.8), (-5.3, -0.9, 2.8)]
    rows.append((-0.5, 5.5, -0.3))
    synthesis = synthesize(Task(Displacement.from_poses(rows)))
    assert [warning.code for warning in synthesis.warnings] == ["W206"]
    assert len(synthesis.dyads) == 2
    drive_all(synthesis)
    assert synthesis.linkages[0].error.worst < 1e-9


def test_repeated_poses_are_counted():
    rng = np.random.default_rng(1)
    rows = random_poses(random_four_bar(rng), rng, 5)
    synthesis = synthesize(Task(Displacement.from_poses(np.vstack([rows, rows]))))
    assert synthesis.outcome.code == "R304"
    assert "only 5 of the 10 poses are different" in synthesis.outcome.message


@pytest.mark.parametrize("count", [3, 4])
def test_three_and_four_poses_have_a_family(count):
    rng = np.random.default_rng(1)
    synthesis = synthesize(Task(Displacement.from_poses(rng.normal(size=(count, 3)))))
    assert synthesis.outcome.code == "R303"
    assert "infinitely many" in synthesis.outcome.message


def test_no_real_dyad_is_said():
    rng = np.random.default_rng(0)
    for _ in range(200):
        synthesis = synthesize(Task(Displacement.from_poses(rng.normal(size=(5, 3)))))
        assert synthesis.outcome.code == ("R300" if synthesis.dyads else "R302")
        if not synthesis.dyads:
            assert "no real dyads (of the 4" in synthesis.outcome.message
            return
    raise AssertionError("200 random tasks, and all had real dyads")


@pytest.mark.parametrize(
    ("count", "method"),
    [(5, "pencil"), (3, "pencil"), (5, "complete"), (4, "complete"), (6, "exact")],
)
def test_methods_refuse_numbers_of_poses_they_do_not_take(count, method):
    rng = np.random.default_rng(1)
    with pytest.raises(InputError) as caught:
        synthesize(Task(Displacement.from_poses(rng.normal(size=(count, 3)))), method)
    assert caught.value.code == "E121"


@pytest.mark.parametrize("count", [0, 1, 2])
def test_too_few_poses_are_no_task(count):
    with pytest.raises(InputError, match="too few") as caught:
        Task(Displacement.from_poses(np.zeros((count, 3))))
    assert caught.value.code == "E120"


@pytest.mark.parametrize("weights", [[1, 1], [1, 1, 0], [1, 1, np.nan]])
def test_weights_that_do_not_fit_are_refused(weights):
    with pytest.raises(InputError) as caught:
        Task(Displacement.from_poses(np.eye(3)), np.array(weights))
    assert caught.value.code == "E122"
