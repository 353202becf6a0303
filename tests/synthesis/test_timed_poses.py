"""Poses timed by the crank, against linkages that are driven by code of the tests' own."""

import itertools
import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester import (
    PR,
    RP,
    RR,
    CrankTiming,
    Displacement,
    InputError,
    Linkage,
    Task,
    judge,
    synthesize,
)
from burmester.tasks.limits import Limits
from burmester.tasks.requirements import Requirements
from tests.oracles import witness


def planted(seed, count, kind=RR, span=1.0):
    """A crank-driven linkage, poses that it goes through in order, and its crank angles there."""
    rng = np.random.default_rng(seed)
    for _ in itertools.count():
        a, b, c, g = rng.uniform([0.2, 0.8, 0.8, 0.8], [0.45, 1.5, 1.5, 1.6])
        fixed, moving = rng.normal(size=(2, 2)) * span
        first = RR(fixed, moving, np.array(a * span))
        way, hand = np.exp(1j * rng.uniform(0, 2 * np.pi, 2))
        other = moving + b * span * np.array([hand.real, hand.imag])
        if kind is RR:
            at = fixed + g * span * np.array([way.real, way.imag])
            second = RR(at, other, np.array(c * span))
        elif kind is PR:
            offset = float((np.conj(way) * (fixed @ [1, 1j])).real)
            second = PR(np.angle(way), offset + 0.3 * span * rng.normal(), other)
        else:
            at = fixed + g * span * np.array([way.real, way.imag])
            second = RP(at, np.angle(hand), float((np.conj(hand) * (moving @ [1, 1j])).real))
        sweep = np.linspace(0, 2 * np.pi, 721)
        d, phi = (each[0] for each in witness.places(first, second, sweep))
        if np.isfinite(d).all() and np.abs(np.diff(np.exp(1j * phi))).max() < 0.2:
            break
    begin, turn = rng.uniform(0, 2 * np.pi), rng.uniform(2, 5)
    beta = begin + np.sort(np.concatenate([[0, turn], rng.uniform(0, turn, count - 2)]))
    d, phi = (each[0] for each in witness.places(first, second, beta))
    poses = Displacement(np.stack([d.real, d.imag], axis=-1), phi)
    return Linkage(first, second), poses, beta


def away(linkage, poses, angles, length):
    """How far (N,) a linkage is from poses when its first link has turned by angles from the first.

    Places and turns, with `length` for a radian; by the witness, on the nearer assembly.
    """
    pin = poses.act(linkage.first.moving_pivot)[0] - linkage.first.fixed_pivot
    drive = np.arctan2(pin[1], pin[0]) + angles - angles[0]
    d, phi = witness.places(linkage.first, linkage.second, drive)
    gap = np.abs(d - poses.translation @ [1, 1j])
    turn = np.abs(np.angle(np.exp(1j * (phi - poses.angle))))
    return np.nanmin(np.hypot(gap, length * turn), axis=0)


@pytest.mark.parametrize("span", [3, 300])
@pytest.mark.parametrize("kind", [RR, PR, RP])
@pytest.mark.parametrize("count", [2, 3, 5, 9])
def test_linkages_are_at_the_poses_at_the_angles_of_their_crank(count, kind, span):
    linkage, poses, beta = planted(count + span, count, kind, span)
    timing = CrankTiming(beta - 0.4)
    result = synthesize(Task(poses, timing=timing))
    assert result.linkages
    if count >= 3:  # all timed poses have one driver
        best = result.linkages[0].dyads[0].dyad
        np.testing.assert_allclose(best.fixed_pivot, linkage.first.fixed_pivot, atol=1e-5 * span)
    exact = [each for each in result.usable if each.error.worst < 1e-9 * span]
    assert exact or count == 2
    for each in exact:
        assert each.preferred_driver == "first"
        assert np.abs(each.timing_error).max() < 1e-7
        assert away(each.linkage, poses, beta, span).max() < 1e-6 * span
    if count > 3:  # the linkage itself is among them
        fits = [
            each
            for each in result.linkages
            if type(each.linkage.second) is kind and each.error.worst < 1e-7 * span
        ]
        assert fits


@pytest.mark.parametrize(("count", "timed"), [(3, 2), (4, 2), (4, 4), (6, 3)])
def test_some_poses_may_have_no_angle(count, timed):
    _, poses, beta = planted(40 + count + timed, count)
    angles = np.where(np.arange(count) < timed, beta, np.nan)
    result = synthesize(Task(poses, timing=CrankTiming(angles)))
    assert result.linkages
    known = np.arange(timed)
    best = result.linkages[0]
    assert best.error.worst < 1e-7
    np.testing.assert_array_equal(np.isfinite(best.timing_error), np.arange(count) < timed)
    assert away(best.linkage, poses[known], beta[known], 1.0).max() < 1e-6


def test_directions_on_the_ground():
    _, poses, beta = planted(3, 3)
    angles = np.array([beta[0], beta[1], np.nan])
    result = synthesize(Task(poses, timing=CrankTiming(angles, absolute=True)))
    assert "by these crank angles, and no other" in result.outcome.message
    pivots = {tuple(each.dyads[0].dyad.fixed_pivot.round(6)) for each in result.linkages}
    assert len(pivots) <= 2
    for each in result.linkages:
        pin = poses.act(each.dyads[0].dyad.moving_pivot)[:2] - each.dyads[0].dyad.fixed_pivot
        turned = np.arctan2(pin[:, 1], pin[:, 0]) - beta[:2]
        assert np.abs(np.exp(1j * turned) - 1).max() < 1e-6


@pytest.mark.parametrize("seed", [1, 2])
def test_more_angles_than_a_linkage_can_have_are_met_as_nearly_as_can_be(seed):
    linkage, poses, beta = planted(seed, 8)
    rng = np.random.default_rng(seed)
    noisy = Displacement(
        poses.translation + 0.01 * rng.normal(size=(8, 2)), poses.angle + 0.01 * rng.normal(size=8)
    )
    result = synthesize(Task(noisy, timing=CrankTiming(beta)))
    length = json.loads(result.to_json())["length_per_radian"]
    d, turn = noisy.translation @ [1, 1j], noisy.angle

    def gaps(x):
        first = RR(x[:2], x[2:4], x[4])
        where, phi = witness.places(first, RR(x[5:7], x[7:9], x[9]), x[10] + beta)
        gap = np.stack([np.abs(where - d), length * np.abs(np.angle(np.exp(1j * (phi - turn))))])
        side = int(np.nan_to_num((gap**2).sum(axis=(0, 2)), nan=np.inf).argmin())
        off = where[side] - d
        own = np.concatenate([off.real, off.imag, length * np.sin(phi[side] - turn)])
        return np.nan_to_num(own, nan=1.0)

    both = (linkage.first, linkage.second)
    dims = [[*each.fixed_pivot, *each.moving_pivot, each.radius] for each in both]
    start = np.concatenate([*dims, [0.0]])
    nearest = least_squares(gaps, start, x_scale=0.1, xtol=1e-14, ftol=1e-14)
    least = np.sqrt(2 * nearest.cost / 8)
    found = min(each.combined_error for each in result.linkages)
    assert found <= least * 1.005


def test_a_linkage_that_exists_is_judged_by_the_angles_of_its_crank():
    linkage, poses, beta = planted(21, 5)
    right = judge(Task(poses, timing=CrankTiming(beta)), linkage).linkages[0]
    assert right.usable
    assert np.abs(right.timing_error).max() < 1e-9
    wrong = beta.copy()
    wrong[2] += np.radians(20)
    off = judge(Task(poses, timing=CrankTiming(wrong)), linkage).linkages[0]
    assert not off.usable
    assert [each.kind for each in off.violations] == ["timing"]
    assert "pose 3" in off.violations[0].message
    np.testing.assert_allclose(
        np.degrees(off.timing_error), np.where(np.arange(5) == 2, -20, 0), atol=1e-6
    )
    wide = CrankTiming(wrong, within=np.radians(20.1))
    assert judge(Task(poses, timing=wide), linkage).linkages[0].usable
    # Given the other way round, the link that has the angles drives.
    other = judge(Task(poses, timing=CrankTiming(beta)), Linkage(linkage.second, linkage.first))
    assert other.linkages[0].usable


def test_limits_keep_the_driver_that_the_angles_leave_open():
    _, poses, beta = planted(5, 3)
    task = Task(poses, timing=CrankTiming([beta[0], beta[1], np.nan]))
    free = synthesize(task).linkages[0]
    short = Limits(length=(0, 0.6 * float(free.dyads[0].dyad.radius)))
    kept = synthesize(replace(task, limits=(short, Limits())))
    for each in kept.usable:
        assert each.dyads[0].dyad.radius <= short.length[1] * (1 + 1e-9)
    crank = synthesize(replace(task, requirements=Requirements(driver="crank")))
    assert all(each.driven.turns_fully for each in crank.usable)


def test_only_sliders_turn_at_no_angle():
    _, poses, beta = planted(5, 3)
    task = Task(poses, timing=CrankTiming(beta), limits=(Limits(kinds={"PR"}),))
    with pytest.raises(InputError) as caught:
        synthesize(task)
    assert caught.value.code == "E186"
