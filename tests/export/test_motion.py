"""The way through the poses, against linkages driven joint by joint (tests/oracles/witness.py)."""

import sys

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.verdicts.motion import Motion
from tests.oracles import tracer, witness
from tests.oracles.handed_over import found
from tests.oracles.saved_linkages import PAPER, paper, saved


def driven_places(first, second, drive):
    """Both ways (2, n) to close, as x + iy and angle, at drives (n,) as `DrivenLoop` has them."""
    if isinstance(first, RP):
        phi = drive - float(first.normal_angle)
        where = witness.turned(first, second, phi)
        return where, np.broadcast_to(phi, where.shape)
    return witness.places(first, second, drive)


def off_witness(linkage, motion):
    """How far (2, n) the motion's places are from those that the witness has at its drives."""
    where, phi = driven_places(linkage.first, linkage.second, motion.drive)
    d = motion.places.translation @ [1, 1j]
    return np.hypot(abs(where - d), abs(np.exp(1j * phi) - np.exp(1j * motion.places.angle)))


def pairs(rng):
    """A linkage of each pair of kinds that can drive, with poses in the order they are met."""
    for second in (RR, PR, RP):
        dyads = witness.random_four_bar(rng, second)
        rows = witness.random_poses(dyads, rng, 6, ordered=True)
        yield dyads, rows
        if second is not RR:
            yield dyads[::-1], rows  # the slider drives: not always in one go


def check_linkage(dyads, rows):
    """A motion of a random linkage: on it, in small steps, through what it says it reaches."""
    chosen = saved(*dyads, rows)
    try:
        motion = Motion.of(chosen, 400)
    except InputError:  # "does not move": the slider reaches one pose only
        return False
    size = 1 + abs(rows[:, :2]).max() + abs(motion.places.translation).max()
    at = np.column_stack([motion.places.translation, motion.places.angle])
    for dyad in dyads:  # the tracer's own equations
        value, gradient = tracer.constraint(dyad, at)
        assert (abs(value) <= 1e-8 * size * (1 + abs(gradient).max())).all()
    off = off_witness(chosen.linkage, motion)
    assert np.nanmin(off, axis=0).max() < 2e-6 * size
    # One and the same way to close all along, so no dead point is passed.
    inner = off[:, 1:-1]
    apart = np.nanmax(inner, axis=0) > 1e-4 * size
    assert len(set(np.nanargmin(inner[:, apart], axis=0))) <= 1
    turn = np.diff(motion.drive)
    if not isinstance(dyads[0], PR):
        assert 0 <= motion.drive[0] < 2 * np.pi
    assert (turn > -1e-12).all() or (turn < 1e-12).all()
    reached = np.flatnonzero(np.isfinite(motion.pose_shares))
    share = motion.pose_shares[reached]
    assert share.min() == 0
    assert share.max() == pytest.approx(1, abs=1e-12)
    there = Motion.of(chosen, motion.pose_shares[reached]).places
    np.testing.assert_allclose(there.translation, rows[reached, :2], atol=1e-8 * size)
    whole = (there.angle - rows[reached, 2]) / (2 * np.pi)
    np.testing.assert_allclose(whole, np.round(whole), atol=1e-8)
    assert round(float(whole[0])) == 0  # as the task writes the first one
    return len(reached) == len(rows)


@pytest.mark.parametrize("seed", range(12))
def test_the_way_is_the_linkages_own(seed):
    rng = np.random.default_rng(seed)
    full = [check_linkage(dyads, rows) for dyads, rows in pairs(rng)]
    assert full[0]  # driven as the poses were made, all of them are reached
    assert full[1]
    assert full[3]


def test_the_paper_from_first_to_last():
    chosen = paper()
    motion = Motion.of(chosen, 101)
    # Made at even crank angles, so met at even shares of the way.
    np.testing.assert_allclose(motion.pose_shares, np.linspace(0, 1, 10), atol=1e-9)
    np.testing.assert_allclose(motion.drive, np.linspace(0.08, 5.74, 101), atol=1e-9)
    assert motion.turns_fully
    assert not motion.full_turn
    np.testing.assert_allclose(
        motion.places[0].translation, chosen.task.poses.translation[0], atol=1e-12
    )


def test_a_whole_turn_begins_at_the_first_pose_and_ends_there():
    motion = Motion.of(paper(), 73, whole=True)
    assert motion.full_turn
    np.testing.assert_allclose(motion.drive, 0.08 + np.linspace(0, 2 * np.pi, 73), atol=1e-9)
    np.testing.assert_allclose(motion.pose_shares, (np.linspace(0.08, 5.74, 10) - 0.08) / 2 / np.pi)
    first, last = motion.places.translation[[0, -1]]
    np.testing.assert_allclose(first, last, atol=1e-12)
    assert off_witness(paper().linkage, motion)[1].max() < 1e-9


def test_the_other_sense():
    chosen = paper()
    back = saved(
        *PAPER, np.column_stack([chosen.task.poses.translation, chosen.task.poses.angle])[::-1]
    )
    motion = Motion.of(back, 11, whole=True)
    np.testing.assert_allclose(motion.drive, 5.74 - np.linspace(0, 2 * np.pi, 11), atol=1e-9)
    assert (np.diff(motion.pose_shares) > 0).all()


def test_turns_of_the_coupler_are_counted():
    # A double crank: its coupler goes round once with the crank.
    dyads = RR([0, 0], [0, 0], 2.0), RR([1, 0], [2.2, 0], 2.0)
    where, phi = witness.places(*dyads, np.linspace(0, 5, 6))
    rows = np.column_stack([where[0].real, where[0].imag, phi[0] + 4 * np.pi])
    motion = Motion.of(saved(*dyads, rows), 3, whole=True)
    assert motion.places.angle[0] == pytest.approx(rows[0, 2], abs=1e-9)
    assert abs(motion.places.angle[-1] - motion.places.angle[0]) == pytest.approx(2 * np.pi)


def triple_rocker():
    return RR([0, 0], [0, 0], 1.0), RR([2.1, 0], [1.3, 0.2], 0.9)


def test_of_two_branches_the_one_with_more_poses():
    dyads = triple_rocker()
    sweep = np.linspace(-np.pi, np.pi, 721)
    where, phi = witness.places(*dyads, sweep)
    sound = np.flatnonzero(np.isfinite(phi[0]))
    # One stretch of the crank between its dead points.
    assert (np.diff(sound) == 1).all()
    drive = sweep[sound[10]], sweep[sound[-10]]
    drive = np.linspace(*drive, 7)
    side = np.array([0, 1, 1, 1, 0, 1, 0])
    where, phi = (both[side, np.arange(7)] for both in witness.places(*dyads, drive))
    rows = np.column_stack([where.real, where.imag, phi])
    motion = Motion.of(saved(*dyads, rows), 50)
    assert (
        np.flatnonzero(np.isfinite(motion.pose_shares)).tolist()
        == np.flatnonzero(side == 1).tolist()
    )
    assert motion.drive[0] == pytest.approx(drive[1] + 2 * np.pi)  # within the first turn
    assert motion.drive[-1] == pytest.approx(drive[5] + 2 * np.pi)
    assert off_witness(Linkage(*dyads), motion)[1].max() < 1e-9


def test_poses_on_two_circuits():
    where, phi = witness.places(*PAPER, np.linspace(0.1, 3, 6))
    side = np.array([0, 1, 1, 0, 1, 1])
    rows = np.column_stack([each[side, np.arange(6)] for each in (where.real, where.imag, phi)])
    motion = Motion.of(saved(*PAPER, rows), 50)
    assert np.flatnonzero(np.isfinite(motion.pose_shares)).tolist() == [1, 2, 4, 5]
    assert off_witness(Linkage(*PAPER), motion)[1].max() < 1e-9


def test_any_order():
    chosen = paper()
    rows = np.column_stack([chosen.task.poses.translation, chosen.task.poses.angle])
    mixed = [3, 0, 4, 1, 2]
    motion = Motion.of(saved(*PAPER, rows[mixed], any_order=True), 10)
    order = np.argsort(motion.pose_shares)
    assert [mixed[k] for k in order] in ([0, 1, 2, 3, 4], [4, 3, 2, 1, 0])
    # The first pose is met before the last one.
    assert motion.pose_shares[0] < motion.pose_shares[-1]


def test_a_body_that_only_translates_has_no_way():
    chosen = paper()
    other = found(Linkage(PP(0.0), PAPER[1]), chosen.task, chosen.error, "L9")
    with pytest.raises(InputError, match="L9 has no motion with one driver") as caught:
        Motion.of(other, 10)
    assert caught.value.code == "E163"


def test_one_pose_is_no_way():
    chosen = paper()
    rows = np.column_stack([chosen.task.poses.translation, chosen.task.poses.angle])
    with pytest.raises(InputError, match="does not move") as caught:
        Motion.of(saved(*PAPER, np.repeat(rows[:1], 3, axis=0)), 10)
    assert caught.value.code == "E163"


def campaign(count, seed):
    """Random linkages: `python -m tests.export.test_motion 1000 7`."""
    rng, full, every = np.random.default_rng(seed), 0, 0
    for _ in range(count):
        for dyads, rows in pairs(rng):
            full += check_linkage(dyads, rows)
            every += 1
    print(f"{every} linkages, {full} reach all of their poses")


if __name__ == "__main__":
    campaign(int(sys.argv[1]), int(sys.argv[2]))
