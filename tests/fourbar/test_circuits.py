"""Circuits, branches, limits, curves and velocities, against a tracer that knows none of them.

The tracer walks along the coupler's motion in small steps (x, y, angle), by the constraints
alone; it does not know a drive, a dead point or a closing equation.

    python -m tests.fourbar.test_circuits 5000 0

compares that many random linkages, of all pairs of dyads, with one seed.
"""

import sys
from collections import Counter
from itertools import product

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.fourbar.instantaneous import (
    centrodes,
    instant_centre,
    transmission_angle,
    twist,
    velocity,
)
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch, Transmission
from burmester.fourbar.loop_closure import DrivenLoop
from burmester.geometry.displacement import Displacement
from tests.oracles.random_dyads import (
    CHANGE,
    HALF,
    NAMES,
    PAIRS,
    all_pairs,
    circuits_of,
    four_bar,
    random_dyad,
    random_linkages,
    rows_of,
    some_places,
)
from tests.oracles.tracer import NEAR, TOO_CLOSE, constraint, driven, gap, met_at, walks
from tests.oracles.witness import places


def cut_into_circuits(linkage, rows):
    """What walks tell of places (k linkages, a list of rows): see `compare`."""
    number = [np.full(len(r), -1) for r in rows]
    branch = [np.full(len(r), -1) for r in rows]
    least = np.full((len(rows), 2, 2), np.nan)
    doubtful = np.zeros(len(rows), bool)
    for circuit in range(3):
        left = [k for k in range(len(rows)) if (number[k] < 0).any() and not doubtful[k]]
        if not left:
            break
        assert circuit < 2, "three circuits"
        start = np.array([rows[k][np.argmax(number[k] < 0)] for k in left])
        both = np.concatenate([left, left])
        some = Linkage(linkage.first[both], linkage.second[both])
        sense = np.repeat([1.0, -1.0], len(left))
        found, closed = walks(some, np.concatenate([start, start]), sense)
        for i, k in enumerate(left):
            walk, back = found[i], found[i + len(left)]
            if not closed[i]:
                walk = np.concatenate([back[:0:-1], walk])
            drive = driven(linkage.first[k], walk)
            sign = np.sign(np.diff(drive))
            turns = np.flatnonzero(sign[1:] != sign[:-1]) + 1
            least[k, circuit] = [drive.min(), drive.max()]
            far, leg = met_at(walk, rows[k])
            on = far < NEAR
            if (~on & (far < TOO_CLOSE)).any() or (on & (number[k] >= 0)).any():
                doubtful[k] = True
                continue
            piece = np.searchsorted(turns, leg, side="right")
            if closed[i] and len(turns) == 2:
                piece %= 2
            # Legs beside a dead point are left out.
            beside = (np.abs(leg[:, None] - turns) <= 1).any(axis=1)
            number[k][on] = circuit
            branch[k][on] = np.where(beside, -1, piece)[on]
            assert len(turns) <= 2
    return number, branch, least, doubtful


def same_parts(ours, theirs):
    """Whether two lists of labels cut a set into the same parts."""
    pairs = set(zip(ours.tolist(), theirs.tolist(), strict=True))
    return len(pairs) == len({a for a, _ in pairs}) == len({b for _, b in pairs})


def compare(pair, rng, count):
    """Hold `count` random linkages of a pair against the tracer; what came of each."""
    linkage = random_linkages(pair, rng, count)
    rows, closes = zip(
        *(some_places(linkage.first[k], linkage.second[k], rng) for k in range(count)), strict=True
    )
    circuits = Circuits.of(linkage)
    verdicts = Counter()
    for k in range(count):
        if not len(rows[k]):
            # A sweep may step over a circuit that is nearly a point.
            tiny = circuits.loop.margin[k, 0] < 1e-3
            none = tiny or not circuits.exists[k].any()
            verdicts[
                "out of sight" if closes[k] else "cannot be assembled" if none else "MISSED"
            ] += 1
    some = [k for k in range(count) if len(rows[k]) and circuits.loop.margin[k, 0] > 1e-3]
    verdicts["near a change point"] += count - len(some) - sum(not len(r) for r in rows)
    part = Linkage(linkage.first[some], linkage.second[some])
    number, branch, least, doubtful = cut_into_circuits(part, [rows[k] for k in some])
    for i, k in enumerate(some):
        if doubtful[i]:
            verdicts["too close to tell"] += 1
            continue
        one = Linkage(linkage.first[k], linkage.second[k])
        ours = circuit_of(one, Displacement.from_poses(rows[k]))
        good = same_parts(ours.circuit, number[i])
        good &= circuits.exists[k].sum() == number[i].max() + 1
        for circuit in range(number[i].max() + 1):
            on = (number[i] == circuit) & (branch[i] >= 0)
            good &= same_parts(ours.branch[on], branch[i][on])
            mine = ours.circuit[number[i] == circuit][0]
            if circuits.branches[k, mine] == 2:
                good &= limits_agree(circuits[k, mine], least[i, circuit])
        verdicts["agrees" if good else "DIFFERS"] += 1
    return verdicts


def limits_agree(circuit, walked):
    """Whether exact limits are those of a walk, whose ends are rounded off by its steps."""
    exact = circuit.input_range
    shift = 0.0
    if circuit.loop.turns:
        turn = 2 * np.pi
        shift = turn * np.round((np.mean(walked) - np.mean(exact)) / turn)
    miss = np.abs(exact + shift - walked)
    return (miss[np.isfinite(exact)] < 2e-3).all()


@all_pairs
def test_circuits_branches_and_limits_against_the_tracer(pair):
    verdicts = compare(pair, np.random.default_rng(PAIRS.index(pair)), 40)
    assert verdicts["DIFFERS"] == verdicts["MISSED"] == 0
    assert verdicts["agrees"] >= 15


# In closed form ---------------------------------------------------------------------------------


def apart(a, b):
    """The greatest difference of two places, angles within half a turn."""
    return np.abs(gap(rows_of(a), rows_of(b))).max()


@all_pairs
def test_places_along_a_circuit_close_the_loop(pair):
    circuits, linkage, s, _ = circuits_of(pair, 1)
    place = circuits.couplers(s)
    for k in range(len(s)):
        rows = rows_of(place)[k]
        size = 1 + np.abs(rows[:, :2]).max(axis=1)
        for dyad in (linkage.first[k], linkage.second[k]):
            assert (np.abs(constraint(dyad, rows)[0]) < 1e-12 * size).all()


@all_pairs
def test_places_lie_where_they_were_put(pair):
    circuits, linkage, s, number = circuits_of(pair, 2)
    found = circuit_of(linkage, circuits.couplers(s))
    assert (found.circuit == number[:, None]).all()
    two = circuits.branches == 2
    second = two[:, None] & np.where(circuits.closed[:, None], s > np.pi, s > 0)
    first_is_negative = ~circuits.closed & two
    assert (found.branch == (second ^ first_is_negative[:, None])).all()
    miss = found.parameter - s
    miss = np.where(circuits.closed[:, None], np.angle(np.exp(1j * miss)), miss)
    assert np.abs(miss).max() < 1e-9


@all_pairs
def test_nothing_jumps_along_a_circuit(pair):
    """Second differences are small as squares, also at dead points and where a loop closes."""
    circuits, _, s, _ = circuits_of(pair, 3)
    middle = np.where(circuits.closed[:, None], np.array([0, np.pi, 2 * np.pi]), [-1, 0, 1])
    middle = np.where((circuits.range_type == HALF)[:, None], [1, 1.5, 2], middle)
    middle = np.concatenate([middle, s], axis=1)
    bends = []
    for h in (1e-3, 5e-4):
        before, at, after = (rows_of(circuits.couplers(middle + k * h)) for k in (-1, 0, 1))
        bends.append(np.linalg.norm(gap(after, at) - gap(at, before), axis=-1) / h**2)
    # A jump would make it four times as large, a corner twice.
    assert (bends[1] < 1.2 * bends[0] + 1e-3).all()


@all_pairs
def test_curve_is_that_of_the_places(pair):
    circuits, _, s, _ = circuits_of(pair, 4)
    points = np.random.default_rng(0).normal(size=(len(s), 2))
    place = circuits.couplers(s)
    d, t = place.translation @ [1, 1j], np.exp(1j * place.angle)
    wanted = d + t * (points @ [1, 1j])[:, None]
    found = circuits.curve(points, s) @ [1, 1j]
    assert (np.abs(found - wanted) < 1e-12 * (1 + np.abs(wanted))).all()


def test_a_batch_of_all_kinds_is_the_same_as_one_by_one():
    rng = np.random.default_rng(8)
    linkages = [
        Linkage(*(random_dyad(kind, rng) for kind in pair)) for pair in PAIRS for _ in range(6)
    ]
    batch = LinkageBatch.of([linkages[k] for k in rng.permutation(len(linkages))])
    every = Circuits.of(batch, as_given=True)
    s = rng.uniform(0.2, 3, (len(batch), 2, 7))
    couplers, inputs = every.couplers(s), every.input_range
    poses = Displacement.from_poses(rng.normal(size=(len(batch), 5, 3)))
    found, other = every.locate(poses), every[:, 0].exchanged().locate(poses)
    angle = every.loop[:, :1].transmission(poses)
    told = set()
    for k in range(len(batch)):
        one = batch.linkage(k)
        own = Circuits.of(one, as_given=True)
        told |= set(own.range_type.tolist())
        assert np.array_equal(own.range_type, every.range_type[k])
        there = own.couplers(s[k])
        assert np.allclose(there.translation, couplers.translation[k], 1e-9, 1e-9, equal_nan=True)
        assert np.allclose(own.input_range, inputs[k], 1e-9, 1e-9, equal_nan=True)
        turned = Linkage(one.second, one.first)
        for linkage, location in ((one, found), (turned, other)):
            here = circuit_of(linkage, poses[k], as_given=True)
            assert np.array_equal(here.circuit, location.circuit[k])
            assert np.array_equal(here.branch, location.branch[k])
            assert np.allclose(here.parameter, location.parameter[k], 1e-9, 1e-9, equal_nan=True)
        assert np.allclose(transmission_angle(one, poses[k]), angle[k], atol=1e-12)
    assert len(told) == 7


def test_no_linkages_have_no_circuits():
    none = Circuits.of(LinkageBatch.of([]), as_given=True)
    assert none.input_range.shape == (0, 2, 2)
    assert none[:, 0].exchanged().couplers(np.zeros((0, 2, 3))).shape == (0, 2, 3)
    assert none.locate(Displacement(np.zeros((0, 4, 2)), np.zeros((0, 4)))).circuit.shape == (0, 4)


def test_long_curves_and_many_linkages_are_the_same_as_one_by_one():
    rng = np.random.default_rng(5)
    linkage = random_linkages((RR, RR), rng, 30)
    s = np.linspace(0, 2 * np.pi, 20_001)
    every = Circuits.of(linkage)
    curves, few = every.curve([1.0, 2.0], s), every.curve([1.0, 2.0], s[::5000])
    assert np.array_equal(curves[:, :, ::5000], few, equal_nan=True)
    for k in range(30):
        one = Circuits.of(Linkage(linkage.first[k], linkage.second[k]))
        assert np.array_equal(one.curve([1.0, 2.0], s[::5000]), few[k], equal_nan=True)
        assert np.isnan(few[k][~one.exists]).all()
    place = every.couplers(np.arange(0.5, 6.0))
    found = circuit_of(linkage, place)
    there = np.isfinite(place.angle)
    assert np.array_equal(there.any(axis=-1), every.exists)
    assert (found.circuit == np.arange(2)[:, None])[there].all()


def test_every_course_is_met_here():
    met = {int(course) for pair in PAIRS for course in circuits_of(pair, 1)[0].range_type}
    assert met == set(range(1, 7))


@pytest.mark.parametrize("unit", [1e-6, 25.4, 1e6])
@all_pairs
def test_the_unit_of_length_does_not_matter(pair, unit):
    def in_unit(dyad):
        lengths = ("fixed_pivot", "moving_pivot", "radius", "offset")
        values = ((name, getattr(dyad, name)) for name in type(dyad).__slots__)
        return type(dyad)(*(v * unit if name in lengths else v for name, v in values))

    linkage = random_linkages(pair, np.random.default_rng(15), 40)
    mine = Circuits.of(linkage)
    other = Circuits.of(Linkage(in_unit(linkage.first), in_unit(linkage.second)))
    assert np.array_equal(mine.range_type, other.range_type)
    s = np.linspace(0.1, 3, 5)
    point = np.array([1.0, 2.0])
    mine, other = mine[mine.closed], other[other.closed]  # of open ones the parameter is a length
    curve = mine.curve(point, s)
    size = 1 + np.abs(curve)
    assert (np.abs(other.curve(unit * point, s) / unit - curve) < 1e-10 * size).all()


@all_pairs
def test_assembled_against_a_driven_linkage(pair):
    rng = np.random.default_rng(6)
    for _ in range(20):
        dyads = [random_dyad(kind, rng) for kind in pair]
        drive = DrivenLoop.of(Linkage(*dyads))
        if pair[0] is RP:  # the witness drives the slot, and its angle tells our drive
            where, phi = places(*dyads, rng.uniform(-3, 3, 40))
            ours = drive.closed_at(phi + dyads[0].normal_angle)
        else:
            x = rng.uniform(-3, 3, 40)
            where, phi = places(*dyads, x)
            ours = drive.closed_at(np.stack([x, x]))
        open_ = np.isnan(rows_of(ours))
        assert np.array_equal(open_.any(axis=-1), open_.all(axis=-1))
        both = np.isfinite(phi)
        if pair[0] is not RP:
            assert np.array_equal(both, np.isfinite(ours.angle[..., 0]))
        rows = np.stack([where.real, where.imag, phi], axis=-1)[both]
        away = gap(rows_of(ours)[both], rows[:, None])
        size = 1 + np.abs(rows).max(axis=1, initial=0)
        assert (np.nanmin(np.linalg.norm(away, axis=-1), axis=1) < 1e-6 * size).all()


@all_pairs
def test_limits_are_where_a_linkage_stops_to_close(pair):
    circuits, linkage, _, _ = circuits_of(pair, 7)
    dead = circuits.branches == 2
    drive = DrivenLoop.of(linkage)
    for end, inwards in ((0, 1), (1, -1)):
        limit = circuits.input_range[:, end]
        there = dead & np.isfinite(limit)
        step = inwards * 1e-9 * (1 + np.abs(limit))[there]
        inside, on, outside = (
            drive[there].closed_at(limit[there] + k * step).angle for k in (1, 0, -1)
        )
        assert np.isfinite(inside).all()
        assert np.isfinite(on).all()
        assert np.isnan(outside).all()
        # Both ways to close meet there.
        assert (np.abs(np.angle(np.exp(1j * (on[:, 0] - on[:, 1])))) < 1e-6).all()


@all_pairs
def test_circuits_are_the_same_from_either_ground_link(pair):
    circuits, linkage, s, number = circuits_of(pair, 8)
    found = circuit_of(Linkage(linkage.second, linkage.first), circuits.couplers(s))
    other = Circuits.of(Linkage(linkage.second, linkage.first))
    assert (found.circuit >= 0).all()
    assert (found.circuit == found.circuit[:, :1]).all()
    mine = Circuits.of(linkage)
    assert np.array_equal(mine.exists.sum(-1), other.exists.sum(-1))
    if pair not in ((PR, PR), (RP, RP)):
        assert np.allclose(mine.loop.margin, other.loop.margin, rtol=1e-9, atol=1e-14)
    twins = mine.exists.all(axis=-1)
    for k in np.flatnonzero(twins[:-1] & (number[:-1] == 0) & (number[1:] == 1)):
        assert found.circuit[k, 0] != found.circuit[k + 1, 0]


# Change points ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", CHANGE)
def test_a_change_point_is_said_and_nothing_guessed(name):
    linkage = CHANGE[name]
    for either in (linkage, Linkage(linkage.second, linkage.first)):
        circuits = Circuits.of(either)
        assert circuits.near_change_point.all()
        assert not circuits.exists.any()
        place = Displacement.from_poses(np.zeros((3, 3)))
        assert (circuit_of(either, place).circuit == -1).all()


NOTHING_AS_GIVEN = ("rails parallel by rounding", "Oldham with parallel slots")


def in_another_frame(dyad, shift):
    """A dyad, with the origin of M elsewhere."""
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot, dyad.moving_pivot + shift, dyad.radius)
    if isinstance(dyad, PR):
        return PR(dyad.normal_angle, dyad.offset, dyad.moving_pivot + shift)
    normal = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    return RP(dyad.fixed_pivot, dyad.normal_angle, dyad.offset + normal @ shift)


@pytest.mark.parametrize("name", CHANGE)
def test_a_change_point_as_given_has_places_with_no_gaps(name):
    first, second = (
        in_another_frame(d, np.array([0.5, -2.0]))
        for d in (CHANGE[name].first, CHANGE[name].second)
    )
    linkage = Linkage(first, second)
    for either in (CHANGE[name], linkage, Linkage(linkage.second, linkage.first)):
        every = Circuits.of(either, as_given=True)
        assert every.near_change_point.all()
        assert every.exists[0] == (name not in NOTHING_AS_GIVEN)
        for number in np.flatnonzero(every.exists):
            circuit = every[number]
            s = np.concatenate([np.arange(1, 3) * np.pi / 2, np.linspace(0.1, 3.1, 9)])
            if circuit.closed:
                s = np.concatenate([s, s + np.pi, [0.0]])
            place = circuit.couplers(s)
            rows = rows_of(place)
            for dyad in (either.first, either.second):
                size = 1 + np.abs(rows[:, :2]).max(axis=1)
                assert (np.abs(constraint(dyad, rows)[0]) < 1e-13 * size).all()
            curve = circuit.curve([1.0, 2.0], s)
            assert np.abs(curve - place.act(np.array([1.0, 2.0]))).max() < 1e-13 * np.max(size)
            found = circuit_of(either, place, as_given=True)
            assert np.isfinite(found.parameter).all()
            away = transmission_angle(either, place) > 1e-3
            assert (found.circuit == number)[away].all()
            miss = (found.parameter - s)[away]
            miss = np.angle(np.exp(1j * miss)) if circuit.closed else miss
            assert np.abs(miss).max(initial=0) < 1e-9


def test_as_given_a_place_is_found_whatever_the_last_digit():
    for k in (-1e-15, -3e-16, 0.0, 3e-16, 1e-15):  # one place only, or none by rounding
        for linkage in (four_bar(4.0 + k, 1.0, 2.0, 1.0), four_bar(4.0 + k, 2.0, 1.0, 1.0)):
            place = Circuits.of(linkage, as_given=True)[0].couplers(np.array([0.0, 1.0]))
            assert np.isfinite(place.angle).all()
            assert np.isfinite(circuit_of(linkage, place, as_given=True).parameter).all()
    # A slot through the pin, which is driven past the slot's pivot.
    slot = Linkage(PR(0.3, 0.0, [0, 0]), RP([0, 0], 0.5, 0.0))
    assert np.isfinite(Circuits.of(slot, as_given=True)[0].couplers(np.zeros(1)).angle).all()
    found = circuit_of(slot, Displacement.from_poses([[0.0, 0, 1]]), as_given=True)
    assert np.isfinite(found.branch_margin).all()
    # Half a turn on, from either side.
    rapson = CHANGE["Rapson slide"]
    for turn in (np.pi, -np.pi):
        found = circuit_of(rapson, Displacement.from_poses([[1.0, 0, turn]]), as_given=True)
        assert np.isclose(found.parameter[0], np.pi)


def test_elsewhere_as_given_is_the_same():
    for index, pair in enumerate(PAIRS):
        linkage = random_linkages(pair, np.random.default_rng([16, index]), 40)
        one, other = Circuits.of(linkage), Circuits.of(linkage, as_given=True)
        assert np.array_equal(one.range_type, other.range_type)
        s = np.linspace(0.1, 3, 5)
        assert np.array_equal(rows_of(one.couplers(s)), rows_of(other.couplers(s)), equal_nan=True)
        place = one[:, 0].couplers(s)
        for a, b in zip(circuit_of(linkage, place), circuit_of(linkage, place, True), strict=True):
            assert np.array_equal(a, b, equal_nan=True)


@pytest.mark.parametrize("seed", range(20))
def test_a_tie_does_not_flip_by_the_last_digit(seed):
    rng = np.random.default_rng(seed)
    s, p, q = rng.uniform(0.5, 2, 3)
    lengths = np.array([s, p, q, abs(p + q - s)])[rng.permutation(4)]
    nudged = np.nextafter(lengths, rng.choice([-9, 9], 4))
    assert Circuits.of(four_bar(*lengths)).near_change_point.all()
    assert Circuits.of(four_bar(*nudged)).near_change_point.all()


def test_links_changed_by_less_than_the_margin_keep_the_number_of_circuits():
    rng = np.random.default_rng(0)
    for _ in range(100):
        lengths = rng.uniform(0.2, 3, 4)
        before = Circuits.of(four_bar(*lengths))
        room = before.loop.margin[0] * lengths.sum()
        change = rng.normal(size=4)
        change *= room / np.abs(change).sum()
        inside, outside = (Circuits.of(four_bar(*(lengths + k * change))) for k in (0.999, -0.999))
        assert inside.exists.sum() == outside.exists.sum() == before.exists.sum()
        # By so much in the worst direction, there is a change point, or a link is no more.
        signs = np.array(list(product((-1, 1), repeat=4)))
        worst = lengths + signs * room / 4
        tied = Circuits.of(four_bar(*worst.T)).near_change_point.any()
        assert tied or np.isclose(room, lengths.min())


def test_a_linkage_that_cannot_be_assembled_has_no_circuit():
    linkage = four_bar(10.0, 1.0, 1.0, 1.0)
    circuits = Circuits.of(linkage)
    assert not circuits.exists.any()
    assert not circuits.near_change_point.any()
    assert np.isnan(circuits.input_range).all()
    assert np.isnan(circuits.curve([0.0, 1.0], np.linspace(0, 6, 5))).all()
    assert np.isnan(rows_of(DrivenLoop.of(linkage).closed_at(np.linspace(0, 6, 5)))).all()
    assert np.isnan(rows_of(circuits.couplers(np.linspace(0, 6, 5)))).all()


def test_grashofs_classes_and_their_circuits():
    """Grashof linkages have two circuits, others one; only cranks have no dead points."""
    for lengths, count, branches in [
        ((4.0, 1.0, 4.0, 4.0), 2, 1),
        ((4.0, 4.0, 4.0, 1.0), 2, 2),
        ((1.0, 3.0, 3.0, 3.0), 2, 1),
        ((3.0, 3.0, 1.0, 3.0), 2, 2),
        ((5.0, 2.0, 2.0, 2.5), 1, 2),
    ]:
        circuits = Circuits.of(four_bar(*lengths))
        assert circuits.exists.sum() == count
        assert (circuits.branches[circuits.exists] == branches).all()
        assert circuits.closed[circuits.exists].all()


def test_dead_points_of_a_triple_rocker_by_the_cosine_law():
    low, high = Circuits.of(four_bar(5.0, 2.0, 2.0, 2.5)).input_range[0]
    reach = 2.0 + 2.5  # the coupler and the follower in one line
    angle = np.arccos((25 + 4 - reach**2) / 20)
    assert np.allclose(np.sort(np.cos([low, high])), np.cos(angle))
    assert np.isclose(high - low, 2 * angle)


@all_pairs
def test_dragged_at_random_it_never_flips(pair):
    """Any jump of the drive: the loop stays closed, on the same circuit and branch."""
    circuits, linkage, _, number = circuits_of(pair, 21)
    rng = np.random.default_rng(21)
    low, high = (np.nan_to_num(circuits.input_range[:, k], neginf=-5, posinf=5) for k in (0, 1))
    width = (high - low)[:, None]
    drive = rng.uniform(low[:, None] - width / 2, high[:, None] + width / 2, (len(low), 60))
    for branch in (0, 1):
        place = circuits.at_inputs(drive, branch)
        rows = rows_of(place)
        for k in range(len(rows)):
            one = Linkage(linkage.first[k], linkage.second[k])
            size = 1 + np.abs(rows[k]).max()
            for dyad in (one.first, one.second):
                assert np.abs(constraint(dyad, rows[k])[0]).max() < 1e-9 * size
            # It goes to where it is asked to, or stops at a limit.
            reached = driven(one.first, rows[k])
            off = reached - drive[k]
            if circuits.turns.all():
                off = (off + np.pi) % (2 * np.pi) - np.pi
            stopped = np.minimum(
                *(
                    np.abs((reached - end + np.pi) % (2 * np.pi) - np.pi)
                    for end in (low[k], high[k])
                )
            )
            assert (
                (np.abs(off) < 1e-6)
                | (stopped < 1e-6)
                | (np.abs(reached - low[k]) < 1e-6)
                | (np.abs(reached - high[k]) < 1e-6)
            ).all()
        found = circuit_of(linkage, place)
        # The limits themselves are on both sides (and of a slide across a slot infinitely far).
        sound = (found.branch_margin > 1e-6) & (found.circuit_margin > 1e-9)
        assert sound.mean() > 0.3
        assert (found.circuit == number[:, None])[sound].all()
        if branch:
            wanted = circuits.branches == 2
            assert (found.branch == wanted[:, None])[sound].all()
        else:
            assert (found.branch == 0)[sound].all()


# Velocities ---------------------------------------------------------------------------------------


@all_pairs
def test_velocity_against_differences(pair):
    circuits, linkage, s, _ = circuits_of(pair, 9)
    place = circuits.couplers(s)
    found = velocity(linkage, place)
    h = 1e-5
    two = [circuits.couplers(s + k) for k in (-h, h)]
    step = gap(rows_of(two[1]), rows_of(two[0]))
    x = [np.stack([driven(linkage.first[k], r) for k, r in enumerate(rows_of(p))]) for p in two]
    speed = x[1] - x[0]
    if circuits.turns.all():
        speed = (speed + np.pi) % (2 * np.pi) - np.pi
    wanted = step / speed[..., None]
    size = np.linalg.norm(wanted, axis=-1, keepdims=True)
    sound = np.abs(speed) > 1e-3 * h
    assert sound.mean() > 0.9
    assert (np.abs(found - wanted) < 1e-5 * (size + size**2))[sound].all()


def pole(before, after):
    """The point that two places (*, 3) have in common in F, complex, from one turn to the other."""
    d = [p[..., 0] + 1j * p[..., 1] for p in (before, after)]
    turn = np.exp(1j * (after[..., 2] - before[..., 2]))
    return (d[1] - turn * d[0]) / (1 - turn)


@all_pairs
def test_centrodes_are_the_limits_of_poles(pair):
    circuits, linkage, s, _ = circuits_of(pair, 10)
    place = circuits.couplers(s)
    h = 1e-4
    before, after = (rows_of(circuits.couplers(s + k)) for k in (-h, h))
    wanted = pole(before, after)
    fixed, moving = (p @ [1, 1j] for p in centrodes(linkage, place))
    sound = np.abs(wanted) < 20
    turned = np.abs(gap(after, before)[..., 2]) > 1e-2 * h
    sound &= turned
    assert sound.mean() > 0.5
    assert (np.abs(fixed - wanted)[sound] < 1e-4 * (1 + np.abs(wanted[sound])) ** 2).all()
    assert np.allclose(fixed, instant_centre(linkage, place) @ [1, 1j], equal_nan=True)
    # The same in the inverse motion.
    back = (wanted - place.translation @ [1, 1j]) * np.exp(-1j * place.angle)
    assert (np.abs(moving - back)[sound] < 1e-4 * (1 + np.abs(wanted[sound])) ** 2).all()


@all_pairs
def test_centrodes_roll_without_slipping(pair):
    circuits, linkage, s, _ = circuits_of(pair, 11)
    h = 1e-5
    fixed, moving = (
        (b - a) @ [1, 1j] / (2 * h)
        for a, b in zip(
            *(centrodes(linkage, circuits.couplers(s + k)) for k in (-h, h)), strict=True
        )
    )
    seen = moving * np.exp(1j * circuits.couplers(s).angle)
    size = np.abs(fixed)
    sound = size < 1e3
    assert sound.mean() > 0.5
    assert (np.abs(seen - fixed)[sound] < 1e-4 * (1 + size[sound])).all()


def test_the_instant_centre_of_a_four_bar_is_where_its_links_cross():
    linkage = four_bar(4.0, 1.0, 3.5, 3.0)
    place = Circuits.of(linkage)[0].couplers(np.linspace(0.1, 6, 50))
    centre = instant_centre(linkage, place)
    for dyad in (linkage.first, linkage.second):
        link = place.act(dyad.moving_pivot) - dyad.fixed_pivot
        to = centre - dyad.fixed_pivot
        cross = link[:, 0] * to[:, 1] - link[:, 1] * to[:, 0]
        assert (np.abs(cross) < 1e-12 * (1 + np.linalg.norm(to, axis=1))).all()


def test_nothing_moves_in_a_certain_way_where_a_parallelogram_is_flat():
    flat = Displacement.from_poses([[1.0, 0.0, 0.0]])
    assert np.abs(twist(CHANGE["parallelogram"], flat)).max() < 1e-15


# Transmission -------------------------------------------------------------------------------------


def test_transmission_angle_by_the_cosine_law():
    rng = np.random.default_rng(0)
    for _ in range(50):
        g, r, a, b = rng.uniform(0.5, 3, 4)
        linkage = four_bar(g, r, a, b)
        x = rng.uniform(-np.pi, np.pi, 20)
        found = transmission_angle(linkage, DrivenLoop.of(linkage).closed_at(x))
        squared = g * g + r * r - 2 * g * r * np.cos(x)
        with np.errstate(invalid="ignore"):
            wanted = np.arccos(np.abs((a * a + b * b - squared) / (2 * a * b)))
        sound = np.isfinite(wanted)
        assert np.array_equal(sound, np.isfinite(found[:, 0]))
        assert np.allclose(found[sound], wanted[sound, None], atol=1e-6)


def test_transmission_angle_of_a_slider_crank_by_the_book():
    """The sine of the pressure angle is (r sin(crank) - offset) / coupler."""
    r, a, offset = 1.0, 3.0, 0.4
    linkage = Linkage(RR([0, 0], [0, 0], r), PR(0.5 * np.pi, offset, [a, 0]))
    x = np.linspace(0, 6, 40)
    found = transmission_angle(linkage, DrivenLoop.of(linkage).closed_at(x))
    pressure = np.abs(np.arcsin((r * np.sin(x) - offset) / a))
    assert np.allclose(found, (np.pi / 2 - pressure)[:, None])


def test_a_slot_through_the_driving_pin_transmits_best():
    linkage = Linkage(RR([0, 0], [0, 0], 1.0), RP([2.0, 0], 0.5, 0.0))
    place = DrivenLoop.of(linkage).closed_at(np.linspace(0, 6, 40))
    assert np.allclose(transmission_angle(linkage, place), np.pi / 2)


def wrench(force, at):
    """A force at a point, as a force and its moment about the origin of F."""
    return np.array([*force, at[0] * force[1] - at[1] * force[0]])


def worst_load(linkage, place):
    """The force in the second dyad while the driver holds the body against a unit force.

    That force is at the second dyad's pin, in the worst of many directions; friction there is none,
    so the forces on the body balance: the driver's effort and what each dyad can bear.
    """
    (x, y), turn = place.translation, float(place.angle)
    rotate = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])

    def bears(dyad):
        if isinstance(dyad, RP):
            angle = float(dyad.normal_angle) + turn
            return np.array([np.cos(angle), np.sin(angle)]), dyad.fixed_pivot
        pin = rotate @ dyad.moving_pivot + (x, y)
        if isinstance(dyad, RR):
            return (pin - dyad.fixed_pivot) / np.linalg.norm(pin - dyad.fixed_pivot), pin
        return np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)]), pin

    (one, at), (other, pin) = bears(linkage.first), bears(linkage.second)
    slot = isinstance(linkage.first, RP)
    effort = np.array([0, 0, 1.0]) if slot else wrench([-one[1], one[0]], at)
    forces = np.column_stack([effort, wrench(one, at), wrench(other, pin)])
    ways = np.linspace(0, np.pi, 2001)
    loads = np.array([wrench([np.cos(way), np.sin(way)], pin) for way in ways])
    return np.abs(np.linalg.solve(forces, -loads.T)[2]).max()


@all_pairs
def test_the_follower_bears_one_over_the_sine_of_the_transmission_angle(pair):
    rng, told = np.random.default_rng(8), 0
    while told < 6:
        many = random_linkages(pair, rng, 1)
        linkage = Linkage(many.first[0], many.second[0])
        rows, _ = some_places(linkage.first, linkage.second, rng)
        places = Displacement(rows[:, :2], rows[:, 2])
        angle = transmission_angle(linkage, places)
        batch, driver = LinkageBatch.of([linkage]), np.zeros(1, dtype=np.intp)
        sine = Transmission.of(batch, rows[None], 1.0, driver).sine[0]
        assert np.allclose(np.abs(sine), np.sin(angle))
        for k in np.flatnonzero(angle > 0.05):
            assert worst_load(linkage, places[k]) == pytest.approx(1 / np.sin(angle[k]), rel=1e-4)
            told += 1


@all_pairs
def test_transmission_is_lost_at_dead_points_and_only_there(pair):
    circuits, linkage, s, _ = circuits_of(pair, 12)
    dead = circuits.branches == 2
    at = np.where(circuits.closed[:, None], [0, np.pi], [0, 0])
    lost = transmission_angle(linkage, circuits.couplers(at))
    assert (lost[dead] < 1e-6).all()
    between = transmission_angle(linkage, circuits.couplers(s))
    assert (between > 1e-4).all()


@pytest.mark.parametrize("second", [RR, PR])
@pytest.mark.parametrize("first", [RR, PR])
def test_transmission_angle_is_what_the_force_in_the_coupler_does(first, second):
    """By virtual work: power into the follower = force in the coupler x speed x sine."""
    circuits, linkage, s, _ = circuits_of((first, second), 13)
    h = 1e-6
    place = circuits.couplers(s)
    pin, hand = (
        place.act(dyad.moving_pivot[:, None]) @ [1, 1j] for dyad in (linkage.second, linkage.first)
    )
    ends = [
        circuits.couplers(s + k).act(linkage.second.moving_pivot[:, None]) @ [1, 1j]
        for k in (-h, h)
    ]
    speed = (ends[1] - ends[0]) / (2 * h)
    force = (pin - hand) / np.abs(pin - hand)
    sound = np.abs(speed) > 1e-2
    wanted = np.abs((np.conj(force) * speed).real / np.abs(speed))
    # Where the pin stands still the direction of its path is the follower's all the same.
    found = np.sin(transmission_angle(linkage, place))
    assert sound.mean() > 0.8
    assert np.allclose(found[sound], wanted[sound], atol=1e-5)


# The rest -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", [RR, PR])
def test_a_body_that_only_translates(kind):
    rng = np.random.default_rng(14)
    linkage = Linkage(random_dyad(kind, rng), PP(0.7))
    circuits = Circuits.of(linkage)
    assert circuits.exists.tolist() == [True, False]
    assert circuits.closed[0] == (kind is RR)
    place = circuits[0].couplers(np.linspace(0, 6, 30))
    assert np.allclose(place.angle, 0.7)
    assert np.abs(constraint(linkage.first, rows_of(place))[0]).max() < 1e-14
    assert (circuit_of(linkage, place).circuit == 0).all()
    assert np.isnan(transmission_angle(linkage, place)).all()
    moved = velocity(linkage, place)
    assert np.abs(moved[:, 2]).max() < 1e-15
    assert np.allclose(np.linalg.norm(moved, axis=1), linkage.first.radius if kind is RR else 1)


def test_parallel_rails_carry_the_body_in_two_circuits_or_not_at_all():
    circuits = Circuits.of(Linkage(PR(0.3, 1.0, [0, 0]), PR(0.3 + np.pi, -1.5, [2.0, 0])))
    assert circuits.exists.all()
    assert not circuits.closed.any()
    place = circuits.couplers(np.linspace(-5, 5, 7))
    assert (np.ptp(place.angle, axis=-1) < 1e-12).all()
    too_far = Circuits.of(Linkage(PR(0.3, 1.0, [0, 0]), PR(0.3, 4.0, [2.0, 0])))
    assert not too_far.exists.any()
    assert not too_far.near_change_point.any()


@pytest.mark.parametrize("second", [RR([0, 0], [1, 0], 1.0), RP([0, 0], 0.0, 1.0), PP(0.0)])
def test_what_cannot_drive_is_refused(second):
    linkage = Linkage(PP(0.0), second)
    with pytest.raises(InputError, match="E401"):
        Circuits.of(linkage)
    with pytest.raises(InputError, match="E401"):
        velocity(linkage, Displacement.identity((3,)))


def test_margins_fall_to_nothing_at_a_dead_point():
    linkage = four_bar(5.0, 2.0, 2.0, 2.5)
    place = Circuits.of(linkage)[0].couplers(np.pi - 10.0 ** -np.arange(1, 9))
    found = circuit_of(linkage, place)
    assert (np.diff(found.branch_margin) < 0).all()
    assert found.branch_margin[-1] < 1e-7
    assert (found.branch == 0).all()
    assert np.allclose(found.circuit_margin, Circuits.of(linkage).loop.margin[0])


@all_pairs
def test_the_drive_along_a_circuit_is_the_joint_s_own_coordinate_and_never_jumps(pair):
    linkage = random_linkages(pair, np.random.default_rng(21), 40)
    circuits = Circuits.of(linkage)
    for k, c in zip(*np.nonzero(circuits.exists), strict=True):
        own, first = circuits[k, c], linkage.first[k]
        low, high = (0.3, 2 * np.pi - 0.3) if own.closed else (0.05, np.pi - 0.05)
        s = np.linspace(low, high, 4001)
        where = own.couplers(s)
        drive = own.inputs(s, where)
        if isinstance(first, PR):  # n . X = offset, and the drive runs along n turned
            pin = where.act(first.moving_pivot)
            n = np.array([np.cos(first.normal_angle), np.sin(first.normal_angle)])
            assert drive == pytest.approx(pin @ [-n[1], n[0]], abs=1e-9)
            continue
        if isinstance(first, RR):
            arm = (where.act(first.moving_pivot) - first.fixed_pivot) / first.radius
        else:
            normal = where.angle + first.normal_angle
            arm = np.stack([np.cos(normal), np.sin(normal)], axis=-1)
        assert np.abs(np.stack([np.cos(drive), np.sin(drive)], axis=-1) - arm).max() < 1e-9
        assert np.abs(np.diff(drive)).max() < 0.5


if __name__ == "__main__":
    many, seed = (int(word) for word in sys.argv[1:])
    bad = 0
    for index, each in enumerate(PAIRS):
        result = Counter()
        for part in range(0, many // len(PAIRS) + 1, 100):
            size = min(100, many // len(PAIRS) + 1 - part)
            result += compare(each, np.random.default_rng([seed, index, part]), size)
        print(NAMES[index], dict(result), flush=True)
        bad += result["DIFFERS"] + result["MISSED"]
    sys.exit(bad > 0)
