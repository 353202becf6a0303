"""Linkages built in a physics simulator and driven by a motor: they do what is said of them here.

MuJoCo knows masses, hinges, slides and a loop that has to stay closed; see
`tests/oracles/simulation.py`.
"""

import numpy as np
import pytest
from benchmarks.round_trip import KINDS, poses_of, random_case, random_linkage

from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.dyad import PR
from burmester.fourbar.instantaneous import transmission_angle
from burmester.geometry.displacement import Displacement

pytest.importorskip(
    "mujoco",
    reason="the simulator MuJoCo is not there for this platform; its witness is left out",
    exc_type=ImportError,
)
from tests.oracles.simulation import MET, coordinates, driven, driven_either_way

LEAST = np.radians(15)  # transmission angle, all the way
TORN = 1e-4  # spans, of the simulated loop on its way
OVERRUN = 0.02  # of the circuit's parameter
STALLED = 2e-4  # from a dead point; all of the motor's force tears at the loop there
TRIES = 500  # at most, until a random linkage suits
MISSED = 1e-2  # by more than that, poses on another branch or circuit
LOCKED = ("rocker-crank", "double-rocker", "triple-rocker", "slider-crank", "rocker-slider",
          "slider-rocker")  # fmt: skip


def rows_of(places):
    return np.column_stack([places.translation, places.angle])


def stays_well_driven(linkage, s, number):
    """Whether the transmission angle is enough along a circuit, at and between parameters."""
    s = np.unwrap(s)
    dense = np.linspace(s.min(), s.max(), 400)
    places = Circuits.of(linkage)[number].couplers(dense % (2 * np.pi))
    return transmission_angle(linkage, places).min() > LEAST


def driven_case(kind, rng):
    """A linkage of a kind and 6 to 10 poses in order on a branch, none of them near its ends."""
    for _ in range(TRIES):
        linkage = random_linkage(rng, kind)
        poses = poses_of(linkage, "sound", rng, int(rng.integers(6, 11)))
        where = circuit_of(linkage, poses)
        if stays_well_driven(linkage, where.parameter, int(where.circuit[0])):
            return linkage, poses, where
    pytest.fail(f"no {kind} is driven well")


@pytest.mark.parametrize("seed", range(len(KINDS)), ids=[f"{k}-{n}" for n, k in enumerate(KINDS)])
def test_a_motor_drives_the_coupler_through_poses_on_one_branch(seed):
    linkage, poses, where = driven_case(KINDS[seed], np.random.default_rng([4, seed]))
    run = driven_either_way(linkage, rows_of(poses))
    assert not run.stalled
    assert run.missed.max() < MET
    assert run.torn < TORN
    # All the way it was on our circuit, and on one branch of it.
    path = Displacement.from_poses(run.path)
    on = circuit_of(linkage, path)
    assert set(on.circuit) == set(where.circuit)
    assert set(on.branch) == set(where.branch)
    ours = rows_of(Circuits.of(linkage)[int(where.circuit[0])].couplers(on.parameter))
    away = ours - run.path
    away[:, 2] = np.angle(np.exp(1j * away[:, 2]))
    span = np.hypot(*np.ptp(poses.translation, axis=0))
    assert np.abs(away / [span, span, 1]).max() < 10 * TORN
    # And it went from pose to pose without turning back, but for what a motor runs too far.
    along = np.unwrap(on.parameter)
    along = along * np.sign(along[-1] - along[0])
    assert (np.maximum.accumulate(along) - along).max() < OVERRUN


@pytest.mark.parametrize("kind", LOCKED)
def test_the_motor_stalls_at_the_dead_points(kind):
    rng = np.random.default_rng([5, LOCKED.index(kind)])
    linkage, poses, where = driven_case(kind, rng)
    rows = rows_of(poses)
    limits = Circuits.of(linkage)[int(where.circuit[0])].input_range
    start, unit = coordinates(linkage.first, rows[0])[0], 1.0
    if isinstance(linkage.first, PR):
        unit = np.hypot(*np.ptp(poses.translation, axis=0))
    else:
        limits = limits - 2 * np.pi * np.round((limits.mean() - start) / (2 * np.pi))
    for limit, beyond in zip(limits, (-0.3, 0.3), strict=True):
        run = driven(linkage, rows, np.full(len(rows), limit + beyond * unit))
        assert run.stalled
        assert abs(run.drive[0] - limit) < STALLED * unit


@pytest.mark.parametrize("kind", ["double-rocker", "triple-rocker", "rocker-slider"])
def test_poses_beyond_a_dead_point_are_not_met(kind):
    """A motor cannot push the linkage through; those on the branch where it began are met."""
    rng = np.random.default_rng([6, LOCKED.index(kind)])
    for _ in range(TRIES):
        case = random_case(rng, "branch", kind)
        where = circuit_of(case.linkage, case.poses)
        far = where.branch_margin > np.sin(LEAST)  # or its momentum takes it through
        both = [np.flatnonzero(far & (where.branch == k))[:5] for k in where.branch[[0, -1]]]
        if where.branch[0] != where.branch[-1] and min(map(len, both)) >= 2:
            break
    else:
        pytest.fail(f"no {kind} with poses on both branches")
    chosen = np.concatenate(both)
    rows, branch = rows_of(case.poses)[chosen], where.branch[chosen]
    assert not driven_either_way(case.linkage, rows).meets
    # Straight from pose to pose, within the range that a branch has.
    targets = np.array([coordinates(case.linkage.first, row)[0] for row in rows])
    if not isinstance(case.linkage.first, PR):
        middle = Circuits.of(case.linkage)[int(where.circuit[0])].input_range.mean()
        targets = np.angle(np.exp(1j * (targets - middle)))
        targets += coordinates(case.linkage.first, rows[0])[0] - targets[0]
    run = driven(case.linkage, rows, targets)
    assert not run.stalled
    assert (run.missed[branch == branch[0]] < MET).all()
    assert (run.missed[branch != branch[0]] > MISSED).all()


@pytest.mark.parametrize("kind", ["crank-rocker", "double-crank", "crank-slider", "crank-slot"])
def test_poses_on_the_other_circuit_are_not_met(kind):
    """However the crank turns; those on the circuit where it began are met."""
    rng = np.random.default_rng([7, KINDS.index(kind)])
    turn = np.linspace(0, 2 * np.pi, 9)[:-1]
    for _ in range(TRIES):
        case = random_case(rng, "circuit", kind)
        where = circuit_of(case.linkage, case.poses)
        if len(set(where.circuit[:6])) == 2 and stays_well_driven(
            case.linkage, turn, int(where.circuit[0])
        ):
            break
    else:
        pytest.fail(f"no {kind} with poses on both circuits")
    rows, same = rows_of(case.poses)[:6], (where.circuit == where.circuit[0])[:6]
    run = driven_either_way(case.linkage, rows)
    assert not run.meets
    assert not run.stalled
    assert (run.missed[same] < MET).all()
    assert (run.missed[~same] > MISSED).all()
