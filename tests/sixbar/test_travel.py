"""Verdicts in closed form against linkages followed step by step."""

import numpy as np
import pytest

from burmester.geometry.displacement import Displacement
from burmester.mechanisms.contract import drive_of
from burmester.sixbar.added_dyads import ThreeRChain, added_dyads
from burmester.sixbar.travel import first_loop_works, least_transmission, travel
from burmester.sixbar.watt import WATT_I, Sides, joints_at, sides_of
from tests.sixbar.tasks import REACH, TURNING, task

STEPS = 1800


def designs(rows, seed, count=260):
    """All six-bars of random chains, working or not."""
    poses = task(rows).poses
    random = np.random.default_rng(seed)
    many = Displacement(
        np.broadcast_to(poses.translation, (count, 5, 2)), np.broadcast_to(poses.angle, (count, 5))
    )
    fixed, moving = random.uniform(-6, 12, (count, 2)), random.uniform(-4, 4, (count, 2))
    far = np.linalg.norm(many.act(moving[:, None]) - fixed[:, None], axis=-1)
    total, less = far.max(axis=1) * random.uniform(1.01, 2, count), far.min(axis=1) / 2
    chains = ThreeRChain(fixed, (total + less) / 2, (total - less) / 2, moving)
    return added_dyads(chains, many, random.choice([-1.0, 1.0], count))


def _circles(p, r, q, s, side):
    way = q - p
    along = (abs(way) ** 2 + r**2 - s**2) / (2 * abs(way))
    across = side * np.sqrt(np.maximum(r**2 - along**2, 0))
    with np.errstate(invalid="ignore"):  # of loops that are open
        return np.where(r**2 < along**2, np.nan, p + way / abs(way) * (along + 1j * across))


def followed(joints, driver, drives):
    """Both loops closed on the sides of the first pose, at drives; nan where they are open."""
    a, b, c, d, e, g, h = joints[0]
    if driver == "A":
        side = np.sign(((d - c) / (b - c)).imag)
        now_c = a + abs(c - a) * np.exp(1j * drives)
        now_d = _circles(now_c, abs(d - c), b, abs(d - b), side)
    else:
        side = np.sign(((c - d) / (a - d)).imag)
        now_d = b + abs(d - b) * np.exp(1j * drives)
        now_c = _circles(now_d, abs(d - c), a, abs(c - a), side)
    now_e = now_c + (e - c) * (now_d - now_c) / (d - c)
    now_g = b + (g - b) * (now_d - b) / (d - b)
    side = np.sign(((h - g) / (e - g)).imag)
    return np.stack([now_e, _circles(now_g, abs(h - g), now_e, abs(h - e), side)])


def works_step_by_step(joints, driver):
    """Whether the poses are met in order on one piece without a gap: None where too near to say."""
    start = drive_of(WATT_I, joints[0], driver)
    turns = np.arange(STEPS + 1) * 2 * np.pi / STEPS
    size = np.abs(joints).max()
    verdicts = []
    for way in (1, -1):
        places = followed(joints, driver, start + way * turns)
        open_ = np.isnan(places).any(axis=0)
        end = int(open_.argmax()) if open_.any() else STEPS
        met = []
        for pose in joints:
            asked = (way * (drive_of(WATT_I, pose, driver) - start)) % (2 * np.pi)
            asked = 0.0 if asked > 2 * np.pi - 1e-9 else asked
            there = followed(joints, driver, np.array([start + way * asked]))[:, 0]
            if not np.abs(there - pose[[4, 6]]).max() < 1e-6 * size:
                met.append(np.inf)
            else:
                met.append(asked * STEPS / (2 * np.pi))
        met = np.array(met)
        if np.isfinite(met).all() and (np.abs(met - end) < 2).any() and open_.any():
            return None
        verdicts.append(bool((met <= end).all() and (np.diff(met) > 0).all()))
    return any(verdicts)


@pytest.mark.parametrize("driver", ["A", "B"])
@pytest.mark.parametrize("rows", [REACH, TURNING])
def test_one_branch_and_order_are_those_of_the_motion(rows, driver):
    added = designs(rows, 3, 500)
    works = travel(added.linkages, added.joints, driver).works
    some = works | (np.arange(len(works)) % 6 == 0)
    joints, works = added.joints[some], works[some]
    truth = [works_step_by_step(each, driver) for each in joints]
    known = np.array([each is not None for each in truth])
    assert known.mean() > 0.95
    assert works.sum() > 3
    wrong = [k for k in np.flatnonzero(known) if truth[k] != works[k]]
    assert wrong == []
    # A loop that fails by itself fails the whole.
    assert not (works & ~first_loop_works(joints[..., :5], driver)).any()


@pytest.mark.parametrize("driver", ["A", "B"])
def test_the_room_beside_the_poses_ends_where_a_loop_opens(driver):
    added = designs(REACH, 5)
    way = travel(added.linkages, added.joints, driver)
    good = np.flatnonzero(way.works & np.isfinite(way.room).all(axis=-1))
    assert len(good) > 5
    low, high = way.drive[good].min(axis=1), way.drive[good].max(axis=1)
    below, above = low - way.room[good, 0], high + way.room[good, 1]
    sides = Sides(*(side[good, 0] for side in sides_of(added.joints, driver)))
    for inside, end in ((1, below), (-1, above)):
        for off, is_open in ((1e-7, False), (-1e-7, True)):
            there = joints_at(added.linkages[good], end + inside * off, sides, driver)
            assert (np.isnan(there).any(axis=-1) == is_open).all()


@pytest.mark.parametrize("driver", ["A", "B"])
def test_the_least_transmission_angle_is_that_of_a_fine_sampling(driver):
    added = designs(REACH, 7)
    way = travel(added.linkages, added.joints, driver)
    at = np.flatnonzero(way.works)
    least = least_transmission(added.linkages[at], way.drive[at], driver, added.joints[at])
    for k, exact in zip(at, least, strict=True):
        drives = np.linspace(way.drive[k].min(), way.drive[k].max(), 4001)
        e, h = followed(added.joints[k], driver, drives)
        a, b, c, d, _, g, _ = added.joints[k, 0]
        if driver == "A":
            now_c = a + abs(c - a) * np.exp(1j * drives)
            side = np.sign(((d - c) / (b - c)).imag)
            tip = _circles(now_c, abs(d - c), b, abs(d - b), side)
            first, now_d = (now_c - tip) / (b - tip), tip
        else:
            now_d = b + abs(d - b) * np.exp(1j * drives)
            tip = _circles(now_d, abs(d - c), a, abs(c - a), np.sign(((c - d) / (a - d)).imag))
            first = (now_d - tip) / (a - tip)
        now_g = b + (g - b) * (now_d - b) / (d - b)
        second = (now_g - h) / (e - h)
        sampled = min(
            np.nanmin(np.arcsin(np.minimum(abs(np.sin(np.angle(each))), 1)))
            for each in (first, second)
        )
        assert exact <= sampled + 1e-9
        assert sampled - exact < 2e-3
