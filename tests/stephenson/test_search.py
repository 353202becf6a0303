"""Six-bars of Stephenson's chain that a search finds, followed along their drive by bars alone."""

import json

import numpy as np
import pytest

from burmester.io.linkage_data import six_bar_data
from burmester.io.linkage_file import read_linkage
from burmester.mechanisms.branches import branches_of
from burmester.mechanisms.circuits import circuits_of
from burmester.mechanisms.contract import body_of
from burmester.sixbar.chain_search import search
from burmester.sixbar.judged import judged_six_bar
from burmester.sixbar.search_space import SearchSpace
from burmester.sixbar.six_bars import CHOICES, SixBarOptions
from burmester.synthesis.six_bars import judge_six_bar, synthesize_six_bars
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from tests.sixbar.tasks import REACH, TURNING, task, wandering
from tests.stephenson.made import CRANK_ROCKER, MANY, linkage


def signs_of_the_drive(found, drives):
    """The sign of the Jacobian of all bars and of the driver at drives: it changes where it locks.

    Also how far bars are off, and where the driver is less where it should be.
    """
    skeleton, lengths = found.skeleton, found.lengths
    joints = {name: at @ [1, 1j] for name, at in found.joints(drives).items()}
    ground = skeleton.links[skeleton.ground]
    moving = [name for name in skeleton.joints if name not in ground]
    bars = [bar for bar in skeleton.bars if not set(bar) <= set(ground)]
    start, end = skeleton.arm(found.driver_pivot)
    off = max(np.abs(np.abs(joints[p] - joints[q]) - lengths[p + q]).max() for p, q in bars)
    at_drive = np.angle((joints[end] - joints[start]) / np.exp(1j * drives))
    signs = []
    for k, drive in enumerate(drives):
        rows = []
        for p, q in bars:
            way = (joints[p] - joints[q])[k] / lengths[p + q]
            rows.append(_row(moving, {p: way, q: -way}))
        rows.append(_row(moving, {end: 1j * np.exp(1j * drive)}))
        signs.append(np.sign(np.linalg.det(np.array(rows))))
    return np.array(signs), off, np.abs(at_drive).max()


def _row(moving, ways):
    row = np.zeros(2 * len(moving))
    for name, way in ways.items():
        if name in moving:
            k = 2 * moving.index(name)
            row[k : k + 2] = way.real, way.imag
    return row


@pytest.mark.parametrize("kind", ["Stephenson I", "Stephenson III"])
def test_what_is_found_goes_through_the_poses_without_a_stop(kind):
    for given in (wandering(3), task(REACH)):
        options = SixBarOptions(chains=500, most=2, kind=kind)
        answer = synthesize_six_bars(given, options)
        assert answer.outcome.code == "R370"
        size = np.ptp(given.poses.translation, axis=0).max()
        for found in answer.six_bars.found:
            assert found.type == f"{kind} six-bar"
            steps = np.diff(found.drive)
            assert (steps > 0).all() or (steps < 0).all()
            places = found.body(found.drive)
            assert np.abs(places.translation - given.poses.translation).max() < 1e-9 * size
            assert np.abs(np.angle(np.exp(1j * (places.angle - given.poses.angle)))).max() < 1e-9
            drives = np.linspace(found.drive[0], found.drive[-1], 1500)
            signs, off, beside = signs_of_the_drive(found, drives)
            assert (signs == signs[0]).all()
            assert off < 1e-9 * size
            assert beside < 1e-9
            moved = np.abs(np.diff(found.joints(drives)["G"], axis=0)).max()
            assert moved < 0.05 * found.extent
            sampled = found.transmission_at(drives).min()
            assert found.transmission <= sampled + 1e-9
            assert sampled - found.transmission < 2e-3


@pytest.mark.parametrize("seed", [3, 30])
def test_a_dyad_drives_a_four_bar_past_its_dead_points(seed):
    """Its coupler is the body; driven by its own cranks it would lock between the poses."""
    given = wandering(seed)
    problem = SynthesisProblem.of(given, None, SynthesisOptions())
    _, driven = search(SearchSpace.of(problem), ["Stephenson III six-bar"], 300, 0, 3)
    for k in range(len(driven.best.chain)):
        found = judged_six_bar(driven.best.linkages[k], problem)
        assert found.usable
        assert (found.linkage.carries, found.driver) == ("coupler", "F")
        assert np.abs(found.error.position).max() < 1e-9 * problem.motion_size
        drives = np.linspace(found.drive[0], found.drive[-1], 1500)
        signs, off, beside = signs_of_the_drive(found, drives)
        assert (signs == signs[0]).all()
        assert max(off, beside) < 1e-9 * problem.motion_size
        a, b, c, d = (found.joints(drives)[joint] @ [1, 1j] for joint in "ABCD")
        by_ac, by_bd = ((d - b) * (c - d).conj()).imag, ((c - a) * (d - c).conj()).imag
        assert all(len(set(np.sign(each))) > 1 for each in (by_ac, by_bd))  # both would lock


def test_kinds_are_ranked_by_one_rule():
    every = [
        synthesize_six_bars(task(REACH), SixBarOptions(chains=300, kind=kind, most=4)).six_bars
        for kind in CHOICES
    ]
    found = every[0].found
    sound = [not each.shortcomings for each in found]
    assert sound == sorted(sound, reverse=True)
    assert [each.id for each in found] == ["S1", "S2", "S3", "S4"]
    assert every[0].working == sum(each.working for each in every[1:])
    best = [each.found[0] for each in every[1:]]
    good = [each.transmission for each in best if not each.shortcomings]
    assert found[0].transmission >= max(good) - np.radians(0.5)
    assert {each.type.removesuffix(" six-bar") for each in best} == set(CHOICES[1:])


def test_a_linkage_driven_over_more_than_a_turn_is_judged_at_its_third_crank():
    """A branch of F of 440 degrees: poses on it are met in order, though their angles repeat."""
    made = linkage(MANY)
    first = judge_six_bar(task(TURNING), made).six_bars.found[0]
    branches = branches_of(made, circuits_of(made), "F")
    (wide,) = [each for each in branches if not each.turns and np.ptp(each.drives) > 7]
    drives = np.linspace(wide.drives.min() + 0.2, wide.drives.max() - 0.2, 7)
    places = body_of(made, wide.at(made, drives))
    rows = np.column_stack([places.translation, np.degrees(places.angle)])
    found = judge_six_bar(task(rows), made).six_bars.found[0]
    assert found.usable
    assert found.driver == "F"
    assert np.ptp(found.drive) == pytest.approx(np.ptp(drives), abs=1e-6)
    assert found.error.position.max() < 1e-9
    assert not first.usable


@pytest.mark.parametrize("own", [CRANK_ROCKER, MANY], ids=["crank-rocker", "many branches"])
def test_places_that_a_branch_holds_twice_are_taken_in_order(own):
    """A coupler is at one place with G on either side; poses all along a branch are in order."""
    made = linkage(own, carries="coupler")
    wide = [b for b in branches_of(made, circuits_of(made), "F") if not b.turns]
    for branch in wide:
        for ends in ((0.04, 0.96), (0.96, 0.04)):
            drives = branch.drives.min() + np.ptp(branch.drives) * np.linspace(*ends, 9)
            places = body_of(made, branch.at(made, drives))
            rows = np.column_stack([places.translation, np.degrees(places.angle)])
            problem = SynthesisProblem.of(task(rows), None, SynthesisOptions())
            found = judged_six_bar(made, problem, ["F"])
            assert found.defects == ()
            assert found.error.position.max() < 1e-9
            there = found.body(found.drive).translation
            assert np.abs(there - places.translation).max() < 1e-8


def test_files_hold_it(tmp_path):
    found = synthesize_six_bars(
        wandering(3), SixBarOptions(chains=300, most=1, kind="Stephenson I")
    )
    (best,) = found.six_bars.found
    file = tmp_path / "six.json"
    file.write_text(json.dumps(six_bar_data(best)))
    again = read_linkage(file)
    for name, value in best.linkage.numbers().items():
        assert np.asarray(again.numbers()[name]) == pytest.approx(np.asarray(value), rel=1e-12)
