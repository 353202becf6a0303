"""Circuits, branches and dead points of Stephenson's six-bars: exact cases and brute force."""

import numpy as np
import pytest

from burmester.mechanisms.branches import branches_of
from burmester.mechanisms.circuits import circuits_of
from burmester.mechanisms.contract import drive_of
from burmester.mechanisms.transmission import least_transmission_angle
from burmester.stephenson.linkage import CLASSES
from tests.oracles.stephenson import bars_off, drawn, held_at_f
from tests.stephenson.made import CRANK_ROCKER, FIRST, MANY, SECOND, THIRD, TWICE, linkage

# Circuits; branches of drivers A, B, F; dead points of F in degrees; spans of its branches.
KNOWN = [
    (
        CRANK_ROCKER,
        4,
        (4, 8, 8),
        [
            *(-152.328386509, -149.133038356, -109.237827131, -86.843540768),
            *(-53.414967088, -28.962780349, -3.606368618, 40.562083055),
        ],
        [43.09, 43.09, 49.81, 49.81, 62.29, 62.29, 69.52, 69.52],
    ),
    (
        MANY,
        3,
        (10, 10, 5),
        [-114.383037006, 3.695442766, 165.058819369, 169.412189154],
        [80.56, 194.28, 194.28, 360, 440.56],
    ),
    (TWICE, 4, (4, 4, 4), [], [360, 360, 720, 720]),
]
# Places of the first of them: angles of A and B and F, and the joints C, D, E, G.
PLACES = [
    (
        (10.0, 38.500876389, -121.460305408),
        [
            0.324986558494 + 0.05730389863j,
            1.313039453942 + 0.249010642897j,
            -0.634289270275 + 0.302027997033j,
            -1.899356357032 + 0.496977390478j,
        ],
    ),
    (
        (82.0, 82.824520158, -135.537061798),
        [
            0.045927123317 + 0.326788462685j,
            1.049963455671 + 0.396867299103j,
            -0.87645085544 + 0.686397784455j,
            -2.156362935676 + 0.701400013176j,
        ],
    ),
]


def test_places_are_those_of_an_independent_solution():
    made = linkage(CRANK_ROCKER)
    for angles, joints in PLACES:
        there = made.generated(np.radians(angles[0]), np.array([1.0, 1.0]))
        assert np.abs(there[[2, 3, 4, 6]] - joints).max() < 2e-12
        drives = [np.degrees(drive_of(made.skeleton, there, pivot)) for pivot in "ABF"]
        assert drives == pytest.approx(angles, abs=1e-8)


@pytest.mark.parametrize(("own", "circuits", "branches", "dead", "spans"), KNOWN)
def test_circuits_branches_and_dead_points_of_known_linkages(own, circuits, branches, dead, spans):
    made = linkage(own)
    found = circuits_of(made)
    assert len(found.first) == circuits
    assert found.closed.all()
    every = {pivot: branches_of(made, found, pivot) for pivot in "ABF"}
    assert tuple(len(each) for each in every.values()) == branches
    assert all(each.certain for some in every.values() for each in some)
    still = np.degrees(drive_of(made.skeleton, made.still("F"), "F"))
    assert np.sort(still) == pytest.approx(dead, abs=1e-8)
    wide = [np.degrees(np.ptp(each.drives)) for each in every["F"]]
    assert sorted(wide) == pytest.approx(spans, abs=6e-3)


@pytest.mark.parametrize("seed", range(6))
def test_branches_cover_each_angle_as_often_as_there_are_assemblies(seed):
    random = np.random.default_rng(seed)
    own = drawn(random)
    made = linkage(own)
    circuits = circuits_of(made)
    branches = branches_of(made, circuits, "F")
    for drive in random.uniform(-np.pi, np.pi, 12):
        held = held_at_f(own, drive)
        mine = []
        for each in branches:
            low, high = each.drives.min(), each.drives.max()
            rounds = np.arange(np.ceil((low - drive) / (2 * np.pi)), (high - drive) / (2 * np.pi))
            mine += [each.at(made, drive + 2 * np.pi * k) for k in rounds]
        assert len(mine) == len(held)
        for joints in mine:
            assert bars_off(own, joints) < 1e-12
            assert abs(np.angle(np.exp(1j * (drive_of(made.skeleton, joints, "F") - drive)))) < 1e-9
            assert min(np.abs(joints - each).max() for each in held) < 1e-6


@pytest.mark.parametrize("name", [THIRD, FIRST, SECOND])
@pytest.mark.parametrize("seed", range(4))
def test_no_driver_of_any_class_turns_back_but_at_its_dead_points(name, seed):
    made = linkage(drawn(np.random.default_rng(100 + seed)), name)
    circuits = circuits_of(made)
    assert circuits.closed.all()
    for pivot in made.skeleton.drivers:
        branches = branches_of(made, circuits, pivot)
        assert all(each.certain for each in branches)
        for each in branches:
            shares = np.linspace(each.low, each.high, 40_001)
            steps = np.diff(each.drive(made, shares))
            assert (steps > -1e-12).all() or (steps < 1e-12).all()
            if not each.turns:  # it ends where it transmits nothing, and there only
                ends = each.at_share(made, np.array([each.low, each.high]))
                assert least_transmission_angle(made.skeleton, ends, pivot).max() < 1e-5
            inside = each.at_share(made, shares[400:-400])
            assert least_transmission_angle(made.skeleton, inside, pivot).min() > 0


@pytest.mark.parametrize("name", list(CLASSES))
def test_frames_make_the_linkage_again(name):
    for carries in CLASSES[name].skeleton.moving:
        made = linkage(drawn(np.random.default_rng(5)), name, carries)
        again = CLASSES[name].of(carries, made.frames())
        for key, value in made.numbers().items():
            assert np.asarray(again.numbers()[key]) == pytest.approx(np.asarray(value), abs=1e-14)
