"""All four-bars through poses and points: counted, driven, compared with five poses."""

import numpy as np
import pytest

from burmester.dyads.five_poses import dyads_of_five
from burmester.geometry.displacement import Displacement
from burmester.points import real_linkages
from burmester.points.alt_burmester import cognates, distinct
from burmester.points.real_linkages import linkages_through
from burmester.points.start_systems import CASES, Case, start_system
from tests.oracles import witness
from tests.oracles.points_by_descent import lacking, pivots_from_random_starts

CHEAP = [Case(5, 0), Case(4, 2), Case(3, 4), Case(1, 4, 2), Case(2, 2, 2), Case(3, 2, 1)]


def problem(case, seed):
    """Random real positions, which of them are points, and the pivots that are given."""
    rng = np.random.default_rng(seed)
    count = case.positions + 1
    poses = Displacement(rng.normal(size=(count, 2)), rng.uniform(-np.pi, np.pi, count))
    is_point = np.arange(count) >= case.poses
    if case.poses == 1:
        is_point[:] = True
    return poses, is_point, rng.normal(size=(case.pivots, 2)) if case.pivots else None


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_every_solved_problem_has_its_number_of_classes(case):
    """The two problems of a case were solved from seeds of their own, and agree."""
    for number in range(case.systems):
        start = start_system(case, number)
        assert len(distinct(start.x, start.positions)) == CASES[case]


@pytest.mark.parametrize("case", CHEAP, ids=lambda case: case.name)
def test_all_linkages_meet_their_positions(case):
    """Driven joint by joint by code of its own, each linkage traces its points."""
    poses, is_point, pivots = problem(case, 2)
    found = linkages_through(poses, is_point, pivots)
    assert (found.found, found.lost) == (CASES[case], 0)
    for k in range(len(found.batch)):
        linkage = found.batch.linkage(k)
        assert max(witness.missed(linkage, place) for place in found.places[k]) < 1e-6
    assert np.abs(found.places[..., :2] - poses.translation).max(initial=0) < 1e-12
    turned = np.abs(np.exp(1j * found.places[..., 2]) - np.exp(1j * poses.angle))
    assert turned[:, ~is_point].max(initial=0) < 1e-9
    if pivots is not None:
        fixed = found.batch.dimensions[:, : len(pivots), :2]
        assert np.abs(fixed - pivots).max(initial=0) < 1e-9


def test_from_the_second_solved_problem_come_the_same_linkages(monkeypatch):
    poses, is_point, _ = problem(Case(3, 4), 2)
    one = linkages_through(poses, is_point)
    monkeypatch.setattr(real_linkages, "start_system", lambda case, number: start_system(case, 1))
    other = linkages_through(poses, is_point)
    assert len(one.batch) == len(other.batch) > 0
    fixed = [
        np.sort_complex((each.batch.dimensions[..., :2] @ [1, 1j]).sum(axis=1))
        for each in (one, other)
    ]
    assert np.abs(fixed[0] - fixed[1]).max() < 1e-6


def test_five_poses_have_the_pairs_of_their_dyads():
    """(5, 0) is Burmester's own problem: pairs of at most four dyads."""
    for seed in (1, 3):
        poses, is_point, _ = problem(Case(5, 0), seed)
        found = linkages_through(poses, is_point)
        five = dyads_of_five(poses)
        count = int(five.real.sum())
        assert len(found.batch) == count * (count - 1) // 2
        known = five.dyads.fixed_pivot[five.real]
        for pivot in found.batch.dimensions[..., :2].reshape(-1, 2):
            assert np.linalg.norm(known - pivot, axis=1).min() < 1e-6 * (1 + np.abs(pivot).max())


def test_cognates_are_an_involution():
    """The cognate at the same pivot of a cognate is the linkage itself."""
    x = np.exp(1j * np.arange(8) ** 2)[None]
    again = cognates(cognates(x)[:, 1])[:, 1]
    assert np.abs(again - x).max() < 1e-12


def test_cognates_of_one_curve_are_one_class():
    start = start_system(next(case for case in CASES if case.poses == 1 and not case.pivots))
    assert start.positions.has_cognates
    some = start.x[:40]
    every = cognates(some)
    assert np.abs(every[:, 1:] - some[:, None]).max(axis=-1).min() > 1e-3
    assert len(distinct(every.reshape(-1, 8), start.positions)) == len(some)


def test_the_same_linkage_is_counted_once():
    start = start_system(Case(3, 4))
    exchanged = np.concatenate([start.x[:, 4:], start.x[:, :4]], axis=1)
    both = np.concatenate([start.x, exchanged])
    assert len(distinct(both, start.positions)) == 201


@pytest.mark.parametrize("case", [Case(4, 2), Case(3, 4)], ids=lambda case: case.name)
def test_random_starts_find_nothing_new(case):
    """Of real linkages that other code comes to by descents none is missing."""
    poses, is_point, _ = problem(case, 2)
    found = linkages_through(poses, is_point)
    positions, rng = poses.translation @ [1, 1j], np.random.default_rng(1)
    seen = pivots_from_random_starts(positions, poses.angle, is_point, 200, rng)
    assert len(seen) > 3
    assert not len(lacking(found.batch.dimensions[:, :, :4], seen, 1e-4))


@pytest.mark.parametrize("repeated", [False, True])
def test_a_family_is_told_where_one_condition_is_there_twice(repeated):
    """A point that is there twice leaves one condition too few: a curve of linkages."""
    poses, is_point, _ = problem(Case(4, 2), 2)
    if repeated:
        poses = poses[[0, 1, 2, 3, 4, 4]]
    found = linkages_through(poses, is_point)
    assert found.family == repeated
    assert bool(found.lost) == repeated
