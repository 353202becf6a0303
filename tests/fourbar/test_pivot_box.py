"""Where pivots go, how far drivers go on, and the force they pass on, against driven linkages."""

import numpy as np
import pytest

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import judge
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.instantaneous import mechanical_advantage
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pivot_box import extent, pivot_box, reserve
from burmester.geometry.displacement import Displacement
from tests.oracles.ranges import KINDS, DrivenRange

PAIRS = pytest.mark.parametrize("kinds", KINDS, ids=lambda k: "-".join(each.__name__ for each in k))
CASES = 30


def driven_ranges(kinds, seed=0, count=CASES):
    """Ranges that are driven, with what the package knows of each: its motion and circuit."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        there = DrivenRange(kinds, rng)
        first, second = (each[None] for each in there.dyads)
        linkage, poses = Linkage(first, second), Displacement.from_poses(there.poses()[None])
        (verdict,) = judge(linkage, poses, missed=np.zeros((1, 4)), reach=1.0)
        driven = verdict.first
        assert not verdict.defects
        assert not driven.defects
        circuits = Circuits.of(linkage, as_given=True)[:, driven.circuit]
        yield there, linkage, poses, driven, circuits


def ends_of(driven):
    parameter = np.array([[driven.parameter.min(), driven.parameter.max()]])
    return parameter, driven.input_range[None]


@PAIRS
def test_the_box_holds_all_pivots_and_no_more(kinds):
    for there, _, _, driven, circuits in driven_ranges(kinds):
        box = pivot_box(circuits, *ends_of(driven))[0]
        seen = there.pivots()
        low, high = (np.array([end(seen.real), end(seen.imag)]) for end in (np.min, np.max))
        size = np.linalg.norm(high - low)
        # Samples miss an extreme point by less than the square of their step.
        assert (box[0] <= low + 1e-9 * size).all()
        assert (box[1] >= high - 1e-9 * size).all()
        assert np.abs(box - [low, high]).max() < 1e-6 * size
        assert np.isclose(extent(circuits, *ends_of(driven))[0], size, rtol=1e-6)


@PAIRS
def test_the_driver_goes_on_until_it_locks(kinds):
    for there, _, _, driven, circuits in driven_ranges(kinds, seed=1, count=15):
        turns = kinds[0] is not PR
        told = reserve(circuits, driven.input_range[None])[0]
        for value, end, sense in zip(told, (there.low, there.high), (-1, 1), strict=True):
            found = there.stop(end, sense, turns)
            if np.isinf(value) or value > 190:
                assert np.isinf(found)
            elif kinds == (RP, PR):  # the witness leaps over infinity
                angle = end + sense * value
                along = there.places(angle - sense * np.array([1e-3, 1e-6]))[0]
                assert abs(along[1]) > 100 * abs(along[0])
            else:
                assert np.isclose(value, found, rtol=1e-6, atol=1e-6)


@PAIRS
def test_force_is_passed_on_as_virtual_work_says(kinds):
    for there, linkage, poses, _, _ in driven_ranges(kinds, seed=2, count=10):
        told = mechanical_advantage(linkage, poses)[0]
        step = 1e-6
        drive = np.linspace(there.low, there.high, 4)
        ahead, behind = (there.places(drive + sign * step)[0] for sign in (1, -1))
        moved = abs(ahead - behind) / (2 * step)
        ok = np.isfinite(moved)
        assert ok.sum() >= 2
        assert np.allclose(told[ok] * moved[ok], 1, rtol=1e-4)


def test_no_effort_moves_a_body_from_a_dead_point_and_a_toggle_holds_any_load():
    # A crank of 1 and a coupler of 3 in line with the rail: the slider is at rest there.
    crank, rail = RR([0, 0], [0, 0], 1.0), PR(np.pi / 2, 0.0, [3, 0])
    pose = Displacement([[1.0, 0.0]], [0.0])
    block = Displacement([[4.0, 0.0]], [0.0])  # the same place, with the origin of M at the pin
    toggle = Linkage(RR([0, 0], [-3, 0], 1.0)[None], PR(np.pi / 2, 0.0, [0, 0])[None])
    assert np.isinf(mechanical_advantage(toggle, block[None])).all()
    assert np.isclose(mechanical_advantage(Linkage(crank[None], rail[None]), pose[None]), 1.0)
    dead = Linkage(rail[None], crank[None])
    assert mechanical_advantage(dead, pose[None]) == 0.0


def parallelogram(low, high):
    """A parallelogram that its crank of 1 drives from low to high, degrees, and that circuit."""
    linkage = Linkage(RR([0, 0], [0, 0], 1.0)[None], RR([3, 0], [3, 0], 1.0)[None])
    angle = np.radians(np.linspace(low, high, 4))
    rows = np.stack([np.cos(angle), np.sin(angle), np.zeros(4)], axis=-1)
    poses = Displacement.from_poses(rows[None])
    (verdict,) = judge(linkage, poses, missed=np.zeros((1, 4)), reach=1.0)
    driven = verdict.first
    return driven, Circuits.of(linkage, as_given=True)[:, driven.circuit]


def test_a_parallelogram_goes_on_to_where_its_links_are_in_line():
    driven, circuits = parallelogram(30, 140)
    told = reserve(circuits, driven.input_range[None])[0]
    assert np.allclose(np.degrees(told), [30, 40], atol=1e-4)
    box = pivot_box(circuits, *ends_of(driven))[0]
    assert np.allclose(box[0], [np.cos(np.radians(140)), 0], atol=1e-4)
    assert np.allclose(box[1], [3 + np.cos(np.radians(30)), 1], atol=1e-4)


@PAIRS
def test_the_figures_of_many_are_those_of_each(kinds):
    every = [
        (Linkage(linkage.first[0], linkage.second[0]), *ends_of(driven), driven.circuit, circuits)
        for _, linkage, _, driven, circuits in driven_ranges(kinds, seed=3, count=6)
    ]
    linkages, parameters, inputs, number, alone = zip(*every, strict=True)
    ((_, linkage),) = LinkageBatch.of(linkages).alike()
    circuits = Circuits.of(linkage, as_given=True)[np.arange(6), list(number)]
    parameters, inputs = np.concatenate(parameters), np.concatenate(inputs)
    inputs[2], parameters[2] = np.nan, np.nan  # one of which nothing is known
    told = np.column_stack([extent(circuits, parameters, inputs), reserve(circuits, inputs)])
    for k, own in enumerate(alone):
        one = inputs[[k]]
        single = np.column_stack([extent(own, parameters[[k]], one), reserve(own, one)])[0]
        assert np.allclose(told[k], single, equal_nan=True)
    assert np.isnan(told[:, 0]).tolist() == [k == 2 for k in range(6)]
