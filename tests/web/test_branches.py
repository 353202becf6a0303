"""The ways of a linkage as plain data, in a case made for one rule."""

from types import SimpleNamespace

import numpy as np
import pytest

from burmester import PR, RP, RR, Displacement, Linkage
from burmester.fourbar.circuits import Circuits
from burmester.verdicts.motion import Motion
from burmester.web.branches import branches_of
from tests.oracles import witness
from tests.oracles.page_modules import value
from tests.oracles.saved_linkages import saved


def test_a_way_with_one_dead_point_says_at_which_end():
    """A pin on the X axis drives a slot that passes 1 beside it, and 0.5 above the axis.

    The pin is no nearer to the slot's pivot than 1: beyond x = ±sqrt(0.75) it slides away without
    end, and on each side comes to one dead point.  The drive rises along both ways, so that one
    begins there and the other ends there, on either assembly.
    """
    rail, slot = PR(np.pi / 2, 0.0, [0.0, 0.0]), RP([0.0, 0.5], 0.0, 1.0)
    linkage = Linkage(rail, slot)
    places = Displacement(np.full((3, 2), np.nan), np.full(3, np.nan))
    found = SimpleNamespace(driver_first=linkage, error=SimpleNamespace(places=places))
    poses = Displacement(np.array([[1.0, 0.0], [2.0, 0.0], [-1.0, 0.0]]), np.zeros(3))
    ways = branches_of(found, poses, 4.0, 101).ways
    nearest = np.sqrt(0.75)
    told = []
    for way in ways:
        x, transmission = np.array(way["x"]), np.array(way["transmission"])
        assert (np.diff(way["drive"]) > 0).all()
        assert np.abs(way["y"]).max() < 1e-9
        at_rest = np.abs(np.abs(x[[0, -1]]) - nearest) < 1e-6
        assert way["dead"] == at_rest.tolist()
        assert transmission[[0, -1]][at_rest] == pytest.approx([0.0], abs=0.01)
        told.append((tuple(way["dead"]), bool(x.min() > 0)))
    assert len(told) == 4
    assert {dead for dead, _ in told} == {(True, False), (False, True)}
    assert len(set(told)) == 2  # the side of the axis says which end it is


def turned(phases):
    """The way of a crank-rocker through its places at these turns: their frames and drives."""
    linkage = Linkage(RR([0.0, 0.0], [0.0, 0.0], 1.0), RR([3.0, 0.0], [2.5, 0.0], 2.5))
    circuit = Circuits.of(linkage, as_given=True)[0]
    places = circuit.couplers(np.array(phases))
    found = SimpleNamespace(driver_first=linkage, error=SimpleNamespace(places=places))
    branches = branches_of(found, places, 4.0, 101)
    ways = {way for way, _ in branches.at}
    assert len(ways) == 1
    way = branches.ways[ways.pop()]
    assert way["round"]
    frames = np.array([frame for _, frame in branches.at])
    return frames, np.interp(frames, np.arange(101), way["drive"]), way


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("start", [0.0, 2.0, 4.0, 6.2])
def test_a_whole_turn_is_cut_where_no_pose_comes_between_the_last_and_the_first(start, sense):
    """The widest gap is between poses 2 and 3 here: cut there, the first would follow the last."""
    phases = start + sense * np.array([0.0, 0.5, 3.5, 4.0, 4.5])
    frames, drive, _ = turned(phases % (2 * np.pi))
    step = np.sign(frames[1] - frames[0])
    assert (step * np.diff(frames) > 0).all()
    assert np.abs(np.diff(drive)) == pytest.approx(np.degrees([0.5, 3.0, 0.5, 0.5]), abs=0.5)
    assert -180 <= drive[0] <= 180  # the angle that is told is an angle within a turn


def test_a_whole_turn_out_of_order_is_cut_in_its_widest_gap():
    frames, drive, way = turned([1.0, 2.0, 1.5, 2.2])
    assert np.ptp(drive) == pytest.approx(np.degrees(1.2), abs=0.5)
    ends = np.array(way["drive"])[[0, -1]]
    assert drive.min() - ends[0] == pytest.approx(ends[1] - drive.max(), abs=1)
    assert frames.min() > 20


def test_time_runs_from_the_first_pose_to_the_last():
    """On the page and in films, whichever way the driver turns: poses of the witness, in order."""
    rng = np.random.default_rng(5)
    given, rows = [], []
    while len(given) < 100:
        dyads = witness.random_four_bar(rng, (RR, PR, RP)[len(given) % 3])
        poses = witness.random_poses(dyads, rng, 5, ordered=True)[:: rng.choice([1, -1])]
        chosen = saved(*dyads, poses)
        branches = branches_of(chosen, chosen.task.poses, witness.span(poses), 61)
        if None in branches.at or len({way for way, _ in branches.at}) > 1:
            continue
        film = Motion.of(chosen, 2).places.translation
        np.testing.assert_allclose(film, poses[[0, -1], :2], atol=1e-7 * abs(poses).max())
        errors = [{"way": way, "frame": frame} for way, frame in branches.at]
        given.append({"ways": branches.ways, "pose_errors": errors})
        rows.append([errors[0]["frame"], errors[-1]["frame"]])
    script = """return all.map((linkage) => {
      const { low, high, sense } = m.stretchOf(linkage, linkage.pose_errors[0].way);
      return sense < 0 ? [high, low] : [low, high];
    });"""
    assert value("../widget/travel.mjs", script, all=given) == rows
    assert {a < b for a, b in rows} == {True, False}
