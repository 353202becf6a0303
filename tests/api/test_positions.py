"""Where a linkage is for its driver's angle, against the witness that closes its loop alone."""

import numpy as np
import pytest

import burmester
from burmester import InputError
from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.common_tasks import in_line
from tests.oracles.witness import places

CASES = ("case:motiongen-shoulder", "case:motiongen-rrpr", "case:motiongen-mixed5")


def results():
    yield from (burmester.synthesize(burmester.read_task(case)) for case in CASES)
    rows = in_line(range(10, 370, 60), 6)
    yield burmester.synthesize(rows, angle_unit="deg")
    task = burmester.Task.from_rows(  # the slider drives
        rows[:3],
        angle_unit="deg",
        limits=(burmester.Limits(kinds={"RR"}), burmester.Limits(kinds={"PR"})),
        requirements=burmester.Requirements(driver="second"),
    )
    yield burmester.synthesize(task)


def test_body_and_joints_are_those_of_the_driven_loop():
    kinds = set()
    for found in (each for result in results() for each in result.usable):
        first, second = found.driver_first.first, found.driver_first.second
        kinds.add((type(first), type(second)))
        size = np.ptp(found.task.poses.translation, axis=0).max()
        motion = found.motion(40)
        assert motion.driver.shape == motion.body.angle.shape == (40,)
        for name, dyad in (("driver", first), ("follower", second)):
            assert np.abs(dyad.residual(motion.body)).max() < 1e-9 * size
            if isinstance(dyad, RR):
                arm = motion.joints[f"{name}_moving"] - motion.joints[f"{name}_fixed"]
                assert np.linalg.norm(arm, axis=-1) == pytest.approx(float(dyad.radius))
            if isinstance(dyad, PR):
                line = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
                on = motion.joints[f"{name}_moving"] @ line
                assert on == pytest.approx(np.full(40, float(dyad.offset)), abs=1e-9 * size)
            assert (f"{name}_fixed" in motion.joints) != isinstance(dyad, PR)
            assert (f"{name}_moving" in motion.joints) != isinstance(dyad, RP)
        # The same by the driver's angles, one and many, in any shape.
        here = found.at(motion.driver.reshape(8, 5))
        assert here.body.translation.reshape(40, 2) == pytest.approx(
            motion.body.translation, abs=1e-7 * size
        )
        one = found.at(motion.driver[7])
        assert one.body.translation == pytest.approx(motion.body.translation[7], abs=1e-7 * size)
        # At the poses it comes to its places there.
        at_poses = found.at(found.driven.inputs * (1 if isinstance(first, PR) else 180 / np.pi))
        gap = at_poses.body.translation - found.error.places.translation
        assert np.abs(gap).max() < 1e-6 * size
        if not isinstance(first, RR):
            continue
        arm = motion.joints["driver_moving"] - motion.joints["driver_fixed"]
        turned = np.exp(1j * (np.arctan2(arm[:, 1], arm[:, 0]) - np.radians(motion.driver)))
        assert turned == pytest.approx(np.ones(40), abs=1e-9)
        z, _ = places(first, second, np.radians(motion.driver))
        where = motion.body.translation @ [1, 1j]
        assert np.nanmin(np.abs(z - where), axis=0).max() < 1e-7 * size
    assert {(RR, RR), (RR, PR), (RR, RP)} <= kinds
    assert any(first is PR for first, _ in kinds)


def test_beyond_a_dead_point_there_is_no_place():
    every = (each for result in results() for each in result.usable)
    rocker = next(
        each
        for each in every
        if isinstance(each.driver_first.first, RR) and not each.driven.turns_fully
    )
    everywhere = rocker.at(np.linspace(0, 360, 73))
    lost = np.isnan(everywhere.body.angle)
    assert 0 < lost.sum() < 73
    z, _ = places(
        rocker.driver_first.first, rocker.driver_first.second, np.radians(everywhere.driver)
    )
    assert (np.isnan(z).all(axis=0) == lost).all()


def test_a_six_bar_too():
    rows = [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)]
    best = burmester.synthesize_six_bars(rows, angle_unit="deg", kind="Watt I", chains=500).best
    here = best.at(np.degrees(best.drive))
    assert here.body.translation == pytest.approx(np.array(rows)[:, :2], abs=1e-9)
    assert sorted(here.joints) == list("ABCDEGH")
    motion = best.motion(7)
    assert motion.body.translation[-1] == pytest.approx([4.2, 1.1], abs=1e-9)
    apart = np.linalg.norm(motion.joints["G"] - motion.joints["H"], axis=-1)
    assert apart == pytest.approx(np.full(7, best.lengths["GH"]))


def test_what_has_no_motion_says_so():
    shoulder = burmester.synthesize(burmester.read_task(CASES[0]))
    with pytest.raises(InputError) as refused:
        shoulder.best.at("north")
    assert refused.value.code == "E125"
