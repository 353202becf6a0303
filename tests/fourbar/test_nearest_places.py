"""Pose errors: the nearest places on each circuit, against circuits swept by the witness.

    python -m tests.fourbar.test_nearest_places 3000 0

compares that many random linkages with one seed, and says how often a nearer place was missed.
"""

import json
import sys
from collections import Counter
from importlib import resources

import numpy as np
import pytest

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import on_circuits, on_own_circuits
from burmester.fourbar.pose_error import PoseError, error_frames
from burmester.geometry.displacement import Displacement
from tests.oracles.random_dyads import PAIRS, all_pairs, random_dyad
from tests.oracles.swept import TooFineError, circuits, on_both
from tests.oracles.witness import misses, places, random_four_bar, random_poses

FINE = 1e-6  # of a distance: a sweep is no finer at dead points


def random_task(pair, rng, count=5):
    """Two dyads, poses (count, 3) near and far, and what a radian counts."""
    while True:
        dyads = [random_dyad(kind, rng) for kind in pair]
        if pair in ((PR, PR), (RP, RP)):
            angle = dyads[0].normal_angle - dyads[1].normal_angle
            if abs(np.sin(angle)) < 0.2:
                continue
        far = rng.choice([0.5, 1.0, 3.0])
        rows = np.column_stack(
            [far * rng.normal(size=(count, 2)), rng.uniform(-np.pi, np.pi, count)]
        )
        return dyads, rows, rng.choice([0.3, 1.0])


def apart(rows, poses, length):
    """The distances (n,) of places from poses (n, 3)."""
    gap = rows - poses
    turn = np.angle(np.exp(1j * gap[:, 2]))
    return np.sqrt(gap[:, 0] ** 2 + gap[:, 1] ** 2 + (length * turn) ** 2)


def rows_at(places):
    return np.column_stack([places.translation, places.angle])


def compare(dyads, poses, length, told):
    """Both circuits' nearest places beside the sweep's; counts of those missed go to told."""
    found, which = circuits(*dyads)
    batch = LinkageBatch.of([Linkage(*dyads)])
    places = on_circuits(batch, Displacement.from_poses(poses), length)
    seen = []
    for side in (0, 1):
        rows = rows_at(places[0, side])
        if np.isnan(rows).all():
            continue
        assert np.isfinite(rows).all()
        assert on_both(dyads, rows) < 1e-9
        assert np.abs(rows[:, 2] - poses[:, 2]).max() < np.pi + 1e-9
        (number,) = set(which(rows))  # all on the circuit under which they are listed
        seen.append(number)
        ours, theirs = apart(rows, poses, length), found[number].nearest(poses, length)
        assert (ours < theirs + FINE).all() or told is not None
        assert (ours > theirs - FINE).all()
        if told is not None:
            told["places"] += len(ours)
            told["missed"] += int((ours > theirs + FINE).sum())
    assert sorted(seen) == list(range(len(found)))


@all_pairs
def test_nearest_places_on_each_circuit_against_a_sweep(pair):
    rng = np.random.default_rng(PAIRS.index(pair))
    for _ in range(8):
        compare(*random_task(pair, rng), None)


def test_of_two_minima_closer_together_than_samples_the_nearer_is_found():
    dyads = (
        RR([75.44495158, -43.82086339], [48.46236124, -34.60616374], 28.51264406),
        RR([5.0, -100.0], [35.49958244, -12.3133723], 92.83948086),
    )
    poses = np.array([[73.93, -78.07, np.radians(100)]])
    compare(dyads, poses, 187.99290766763872, None)


@pytest.mark.parametrize("second", [RR, PR, RP])
def test_poses_that_are_met_are_met(second):
    rng = np.random.default_rng(5)
    for _ in range(20):
        dyads = random_four_bar(rng, second)
        rows = random_poses(dyads, rng, 8)
        error = PoseError.of(Linkage(*dyads), Displacement.from_poses(rows), 1.0)
        assert error.worst < 1e-9
        assert error.angle.max() < 1e-9
        assert np.abs(rows_at(error.places) - rows).max() < 1e-9


@pytest.mark.parametrize("seed", range(30))
def test_nearest_place_against_the_driven_linkage(seed):
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng, (RR, PR, RP)[seed % 3])
    rows = random_poses(dyads, rng, 8)
    linkage = Linkage(*dyads)
    near = Displacement.from_poses(rows + 0.02 * rng.normal(size=rows.shape))
    error = PoseError.of(linkage, near, 1.0)
    ours, witness = np.hypot(error.position, error.angle), misses(linkage, near, 1.0)
    assert np.abs(ours - witness).max() < 1e-6
    assert on_both(dyads, rows_at(error.places)) < 1e-9
    gap = np.linalg.norm(error.places.translation - near.translation, axis=1)
    assert np.allclose(error.position, gap, rtol=0, atol=1e-15)
    assert np.isclose(error.worst, gap.max())
    assert np.isclose(error.rms, np.sqrt((gap**2).mean()))


@pytest.mark.parametrize("seed", range(30))
def test_nearest_place_is_a_foot_however_far_the_pose(seed):
    """The gap to the pose is square to the coupler's motion, taken from differences."""
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng, (RR, PR, RP)[seed % 3])
    rows = random_poses(dyads, rng, 20)
    poses = Displacement.from_poses(rows + 0.4 * rng.normal(size=rows.shape))
    at = rows_at(PoseError.of(Linkage(*dyads), poses, 1.0).places)
    step = 1e-6
    slopes = [
        np.stack(
            [
                dyad.residual(Displacement.from_poses(at + step * e))
                - dyad.residual(Displacement.from_poses(at - step * e))
                for e in np.eye(3)
            ],
            axis=-1,
        )
        / (2 * step)
        for dyad in dyads
    ]
    along = np.cross(*slopes)
    sound = np.linalg.norm(along, axis=1) > 1e-2  # elsewhere the motion has no direction
    along = along[sound] / np.linalg.norm(along[sound], axis=1, keepdims=True)
    gap = np.column_stack([poses.translation, poses.angle])[sound] - at[sound]
    assert sound.sum() > 10
    assert np.abs((along * gap).sum(axis=1)).max() < 1e-5


def test_published_linkage_of_table_8_misses_table_5_by_its_known_error():
    case = json.loads(
        resources.files("burmester").joinpath("cases/ge2012-approximate.json").read_text()
    )
    rows = np.array(case["poses"])
    poses = Displacement(rows[:, :2], np.radians(rows[:, 2]))
    dyads = [
        RR(d["fixed_pivot"], d["moving_pivot"], d["radius"])
        for d in case["printed"]["linkage_table8"]
    ]
    error = PoseError.of(Linkage(*dyads), poses, 1.0)
    assert np.isclose(error.rms, 0.114, atol=5e-4)
    assert np.isclose(error.worst, 0.216, atol=5e-4)
    assert np.isclose(np.degrees(np.sqrt((error.angle**2).mean())), 2.65, atol=5e-3)


# Circuits that come close, and that meet ----------------------------------------------------------


def test_a_place_does_not_leap_to_the_other_circuit():
    """Two circuits that pass each other: the nearest place on one is often beside the other."""
    rng = np.random.default_rng(8)
    told = Counter()
    for nearly in (0.05, 0.01, 0.002):
        # A ground link a little shorter than a change point asks for.
        dyads = [
            RR([0, 0], [0, 0], 1.0),
            RR([3 - nearly, 0], [2.5, 0], 1.5),
        ]
        swept, _ = circuits(*dyads)
        for circuit in swept:
            t = rng.uniform(circuit.low, circuit.high, 40)
            rows = circuit.rows(t)
            rows = rows[np.isfinite(rows).all(axis=1)]
            compare(dyads, rows + 0.02 * rng.normal(size=rows.shape), 1.0, told)
    assert told["missed"] <= told["places"] / 1000


PARALLELOGRAM = [RR([0, 0], [0, 0], 1.0), RR([3, 0], [3, 0], 1.0)]
KITE = [RR([0, 0], [0, 0], 1.0), RR([1, 0], [2.5, 0], 2.5)]


@pytest.mark.parametrize("dyads", [PARALLELOGRAM, KITE], ids=["parallelogram", "kite"])
def test_change_points_have_no_nearer_place_either(dyads):
    """Where the circuits meet only the nearer of both can be told."""
    rng = np.random.default_rng(2)
    where, phi = (np.concatenate(x) for x in _swept_places(dyads))
    rows = np.column_stack([where.real, where.imag, phi])[rng.integers(len(phi), size=20)]
    poses = Displacement.from_poses(rows)
    assert PoseError.of(Linkage(*dyads), poses, 1.0).worst < 1e-6
    off = rows + 0.1 * rng.normal(size=rows.shape)
    error = PoseError.of(Linkage(*dyads), Displacement.from_poses(off), 1.0)
    assert on_both(dyads, rows_at(error.places)) < 1e-9
    ours = np.hypot(error.position, error.angle)
    every = np.column_stack([where.real, where.imag, phi])
    theirs = np.array([apart(every, row[None], 1.0).min() for row in off])
    assert (ours < theirs + FINE).all()
    assert (ours > theirs - 1e-4).all()  # the sweep's step


def _swept_places(dyads):

    where, phi = places(*dyads, np.linspace(-np.pi, np.pi, 40_000))
    sound = np.isfinite(phi)
    return [where[0][sound[0]], where[1][sound[1]]], [phi[0][sound[0]], phi[1][sound[1]]]


@pytest.mark.parametrize("turned", [0.0, 0.3])
def test_the_parallelograms_circuit_is_all_of_it(turned):
    """Its two circuits meet; the one where nothing turns is found at every crank angle."""
    angle = np.linspace(0.2, 6.0, 17)
    rows = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(17)])
    frame = Displacement.from_poses([0.4, -2.0, turned])
    poses = frame @ Displacement.from_poses(rows)
    first, second = (RR(frame.act(d.fixed_pivot), d.moving_pivot, 1.0) for d in PARALLELOGRAM)
    assert PoseError.of(Linkage(first, second), poses, 1.0).worst < 1e-9


@pytest.mark.parametrize("second", [RR, PR, RP])
def test_a_place_in_another_valley_is_brought_to_the_nearest_of_its_circuit(second):
    """From any places on a circuit to the nearest ones there; of two circuits, on either."""
    rng = np.random.default_rng(7)
    told = Counter()
    while min(told["one"], told["moved"], told["both"]) < 10:
        dyads = random_four_bar(rng, second)
        try:
            swept, _ = circuits(*dyads)
        except TooFineError:
            continue
        poses = random_poses(dyads, rng, 5) + 0.05 * rng.normal(size=(5, 3))
        near = np.array([circuit.nearest(poses, 1.0) for circuit in swept])
        on = rng.integers(len(swept), size=5) if rng.random() < 0.5 else np.zeros(5, int)
        start = np.array(
            [swept[k].rows(rng.uniform(swept[k].low, swept[k].high, 1))[0] for k in on]
        )
        batch = LinkageBatch.of([Linkage(*dyads)])
        wanted_at = Displacement.from_poses(poses)
        both = rows_of(on_circuits(batch, wanted_at, 1.0), 1.0)
        ours = on_own_circuits(batch, start[None], both, wanted_at, 1.0)[0]
        assert on_both(dyads, ours) < 1e-9
        mixed = len(set(on)) > 1
        wanted = near.min(axis=0) if mixed else near[on[0]]
        assert np.abs(apart(ours, poses, 1.0) - wanted).max() < FINE
        told["both" if mixed else "one"] += 1
        told["moved"] += int((apart(start, poses, 1.0) > wanted + 0.1).any())
        if second is not RR:  # two circuits are rare enough there
            told["both"] += 1


# Frames and units ---------------------------------------------------------------------------------


def moved(dyad, frame, unit):
    """A dyad in a fixed frame that is moved, and in other units."""
    if isinstance(dyad, RR):
        fixed = unit * frame.act(dyad.fixed_pivot)
        return RR(fixed, unit * dyad.moving_pivot, unit * dyad.radius)
    if isinstance(dyad, RP):
        return RP(unit * frame.act(dyad.fixed_pivot), dyad.normal_angle, unit * dyad.offset)
    angle = dyad.normal_angle + frame.angle
    offset = dyad.offset + np.array([np.cos(angle), np.sin(angle)]) @ frame.translation
    return PR(angle, unit * offset, unit * dyad.moving_pivot)


@all_pairs
def test_errors_go_with_the_frame_and_the_unit(pair):
    rng = np.random.default_rng([1, PAIRS.index(pair)])
    told = 0
    for unit in (1e-4, 1.0, 1e5):
        dyads, rows, length = random_task(pair, rng)
        frame = Displacement.from_poses([3.0, -7.0, 2.0])
        poses = Displacement.from_poses(rows)
        one = PoseError.of(Linkage(*dyads), poses, length)
        placed = frame @ poses
        turns = 2 * np.pi * rng.integers(-2, 3, len(rows))
        there = Displacement(unit * placed.translation, placed.angle + turns)
        other = PoseError.of(Linkage(*(moved(d, frame, unit) for d in dyads)), there, unit * length)
        assert np.allclose(
            other.position, unit * one.position, rtol=0, atol=1e-8 * unit, equal_nan=True
        )
        assert np.allclose(other.angle, one.angle, rtol=0, atol=1e-8, equal_nan=True)
        # Angles come within half a turn of the pose's own, however often it is turned.
        assert (
            np.abs(other.places.angle - there.angle).max(initial=0, where=np.isfinite(other.angle))
            <= np.pi + 1e-9
        )
        told += int(np.isfinite(one.position).any())
    assert told


def test_errors_are_those_of_the_bodys_own_origin_however_far_it_lies():
    """The body's origin 1,000 from its pins: a nearest place is one for that origin."""
    rng = np.random.default_rng(4)
    for _ in range(10):
        first, second = random_four_bar(rng)
        rows = random_poses((first, second), rng, 6) + 0.01 * rng.normal(size=(6, 3))
        far = Displacement.from_poses([1e3, -2e2, 0.0])
        poses = Displacement.from_poses(rows) @ far
        pins = [d.moving_pivot - far.translation for d in (first, second)]
        linkage = Linkage(
            RR(first.fixed_pivot, pins[0], first.radius),
            RR(second.fixed_pivot, pins[1], second.radius),
        )
        error = PoseError.of(linkage, poses, 1.0)
        ours = np.hypot(error.position, error.angle)
        # No place of the driven linkage, refined around ours, is nearer.
        found, _ = circuits(linkage.first, linkage.second)
        theirs = np.min([c.nearest(rows_at(poses), 1.0) for c in found], axis=0)
        assert (ours < theirs + 1e-5).all()
        assert (ours > theirs - 1e-5).all()
        assert on_both((linkage.first, linkage.second), rows_at(error.places)) < 1e-6


# Nowhere, and many --------------------------------------------------------------------------------


def test_a_linkage_that_cannot_be_assembled_is_nowhere():
    open_ = Linkage(RR([0, 0], [0, 0], 1.0), RR([10, 0], [1, 0], 1.0))
    poses = Displacement.from_poses(np.zeros((3, 3)))
    error = PoseError.of(open_, poses, 1.0)
    assert np.isnan(error.places.translation).all()
    assert np.isnan(error.position).all()
    assert error.worst == error.rms == np.inf
    # Beside others, too, which are where they are alone.
    sound = Linkage(*PARALLELOGRAM)
    both = on_circuits(LinkageBatch.of([open_, sound]), poses, 1.0)
    alone = on_circuits(LinkageBatch.of([sound]), poses, 1.0)
    assert np.isnan(both.translation[0]).all()
    assert np.array_equal(both.translation[1], alone.translation[0], equal_nan=True)
    assert np.isfinite(alone.translation).any()


@pytest.mark.parametrize("count", [300, 2000])
def test_many_poses_are_each_as_near_as_alone(count):
    """Taken in blocks, and beyond 1,000 by fewer starts: poses near the linkage."""
    rng = np.random.default_rng(6)
    for second in (RR, PR, RP):
        dyads = random_four_bar(rng, second)
        rows = random_poses(dyads, rng, count)
        off = rows + 0.01 * rng.normal(size=rows.shape)
        error = PoseError.of(Linkage(*dyads), Displacement.from_poses(off), 1.0)
        assert on_both(dyads, rows_at(error.places)) < 1e-9
        ours = np.hypot(error.position, error.angle)
        some = rng.choice(count, 60, replace=False)
        found, _ = circuits(*dyads)
        theirs = np.min([c.nearest(off[some], 1.0) for c in found], axis=0)
        assert np.abs(ours[some] - theirs).max() < FINE
        assert (ours <= apart(off, rows, 1.0) + 1e-9).all()


def test_whole_stacks_are_what_their_linkages_are_alone():
    rng = np.random.default_rng(9)
    pairs = [PAIRS[k] for k in rng.permutation(27) % 9]
    linkages = [Linkage(*random_task(pair, rng)[0]) for pair in pairs]
    poses = Displacement.from_poses(rng.normal(size=(4, 3)))
    every = on_circuits(LinkageBatch.of(linkages), poses, 1.0)
    for k, linkage in enumerate(linkages):
        one = on_circuits(LinkageBatch.of([linkage]), poses, 1.0)
        assert np.allclose(every.translation[k], one.translation[0], atol=1e-9, equal_nan=True)
        assert np.allclose(every.angle[k], one.angle[0], atol=1e-9, equal_nan=True)


def test_error_frames_keep_the_bodys_origin():
    rows = np.array([[10, 5, 0.1], [14, 5, 0.2], [12, 9, 3.0]], float)
    poses = Displacement.from_poses(rows)
    frames = error_frames(poses, 1.0)
    seen = frames.to_canonical(poses)
    gaps = np.linalg.norm(seen.translation[:, None] - seen.translation, axis=-1)
    wanted = np.linalg.norm(rows[:, None, :2] - rows[:, :2], axis=-1)
    assert np.allclose(gaps * float(frames.length), wanted)
    assert np.allclose(seen.translation.mean(axis=0), 0)


if __name__ == "__main__":
    number, seed = map(int, sys.argv[1:])
    draws, counts = np.random.default_rng(seed), Counter()
    for k in range(number):
        task = random_task(PAIRS[k % 9], draws)
        try:
            compare(*task, counts)
        except TooFineError:
            counts["too fine"] += 1
        except AssertionError as error:
            counts["wrong"] += 1
            print(k, task, error)
    print(dict(counts))
