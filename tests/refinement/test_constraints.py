"""Conditions of the search, against a sweep of the linkage and against rules of their own."""

import itertools

import numpy as np
import pytest

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.instantaneous import transmission_angle
from burmester.fourbar.linkage import Linkage, Links, grashof
from burmester.fourbar.linkage_batch import LeastTransmission, LinkageBatch, Transmission
from burmester.fourbar.loop_closure import DrivenLoop
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Polygon, Segment
from burmester.refinement.constraints import (
    AllConstraints,
    BranchAndOrder,
    DrivenBranch,
    LeastLinks,
    LinkProportions,
    type_excess,
)
from burmester.refinement.kept_limits import DyadLimitsConstraint
from burmester.tasks.limits import Limits
from burmester.tasks.requirements import Requirements
from tests.oracles.hard_tasks import assembled, sines
from tests.oracles.random_dyads import random_dyad
from tests.oracles.witness import random_four_bar

PAIRS = list(itertools.product((RR, PR, RP), repeat=2))
LENGTH = 0.7  # what a radian counts as
PLAIN = CanonicalFrames.identity()
ANY = Requirements()


def swept(first, second, drive):
    """Rows (2, n, 3) on both assemblies along drives (n,)."""
    d, phi = assembled(first, second, drive)
    return np.stack([d.real, d.imag, LENGTH * phi], axis=-1)


def sine_of(linkage, rows, side=0):
    """The signed sine of the transmission angle of one linkage at rows (n, 3)."""
    batch = LinkageBatch.of([linkage])
    return Transmission.of(batch, rows[None], LENGTH, np.array([side])).sine[0]


@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: f"{pair[0].__name__}-{pair[1].__name__}")
def test_the_lever_is_the_sine_of_the_transmission_angle(pair):
    rng = np.random.default_rng(0)
    seen = 0
    for _ in range(30):
        linkage = Linkage(random_dyad(pair[0], rng), random_dyad(pair[1], rng))
        rows = swept(linkage.first, linkage.second, np.sort(rng.uniform(-2.5, 2.5, 25)))
        for side in (0, 1):
            own = rows[side][np.isfinite(rows[side]).all(axis=1)]
            seen += len(own)
            at = Displacement(own[:, :2], own[:, 2] / LENGTH)
            angle = transmission_angle(linkage, at)
            assert np.allclose(np.abs(sine_of(linkage, own)), np.sin(angle), atol=1e-7)
            other = Linkage(linkage.second, linkage.first)
            angle = transmission_angle(other, at)
            assert np.allclose(np.abs(sine_of(linkage, own, 1)), np.sin(angle), atol=1e-7)
    assert seen > 100


@pytest.mark.parametrize(
    "pair", [(RR, RR), (RR, PR), (RR, RP), (PR, RR), (PR, PR), (PR, RP), (RP, RR)]
)
def test_its_sign_tells_the_two_assemblies_apart(pair):
    rng = np.random.default_rng(1)
    seen = 0
    for _ in range(40):
        linkage = Linkage(random_dyad(pair[0], rng), random_dyad(pair[1], rng))
        rows = swept(linkage.first, linkage.second, rng.uniform(-2.5, 2.5, 40))
        sound = np.isfinite(rows).all(axis=(0, 2))
        if sound.any():
            seen += 1
            one, other = (np.sign(sine_of(linkage, rows[side][sound])) for side in (0, 1))
            assert (one == one[0]).all()
            assert (other == -one[0]).all()
    assert seen > 20


@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: f"{pair[0].__name__}-{pair[1].__name__}")
def test_drives_are_those_the_linkage_is_assembled_at(pair):
    rng = np.random.default_rng(2)
    seen = 0
    for _ in range(20):
        linkage = Linkage(random_dyad(pair[0], rng), random_dyad(pair[1], rng))
        drive = rng.uniform(-3, 3, 10)
        both = DrivenLoop.of(linkage).closed_at(drive)
        batch = LinkageBatch.of([linkage])
        for side in (0, 1):
            at = both.translation[:, side], both.angle[:, side]
            sound = np.isfinite(at[1])
            rows = np.column_stack([at[0], LENGTH * at[1]])[sound]
            _, told, turns = Transmission.of(batch, rows[None], LENGTH, np.array([0]))
            gap = told[0] - drive[sound]
            assert turns[0] == (pair[0] is not PR)
            assert np.abs(np.exp(1j * gap) - 1 if turns[0] else gap).max(initial=0) < 1e-7
            seen += sound.sum()
    assert seen > 20


@pytest.mark.parametrize(
    "pair", [(RR, RR), (RR, PR), (RR, RP), (PR, RR), (PR, PR), (PR, RP), (RP, RR)]
)
def test_the_least_sine_of_a_stretch_is_at_its_ends_or_where_it_is_said(pair):
    rng = np.random.default_rng(3)
    seen = inner = 0
    for _ in range(150):
        linkage = Linkage(random_dyad(pair[0], rng), random_dyad(pair[1], rng))
        start, reach = rng.uniform(-3, 3), rng.uniform(0.5, 5)
        drive = np.linspace(start, start + reach, 2001)
        rows = swept(linkage.first, linkage.second, drive)[0]
        at, cosine, _ = (
            part[0] for part in LeastTransmission.of(LinkageBatch.of([linkage]), np.array([0]))
        )
        if pair[0] is not PR:
            at = start + (at - start) % (2 * np.pi)
        within = (at > start) & (at < start + reach) & np.isfinite(cosine)
        # It closes all along just where it does at the ends and there.
        closes = np.isfinite(rows).all(axis=1)
        if not (closes[0] and closes[-1]):
            continue
        said = (np.abs(cosine[within]) <= 1).all()
        clear = (np.abs(np.abs(cosine[within]) - 1) > 1e-3).all()
        if clear:
            assert closes.all() == said
        if closes.all():
            sine = np.abs(sine_of(linkage, rows))
            wanted = np.sqrt(1 - cosine[within] ** 2).tolist()
            least = min([sine[0], sine[-1], *wanted])
            assert np.isclose(sine.min(), least, atol=2e-3)
            seen += 1
            inner += bool(wanted) and least < min(sine[0], sine[-1]) - 5e-3
    assert seen > 20
    assert inner or pair == (PR, PR)


def journey_of(linkage, rows, sign, asked=ANY, middle=np.nan):
    batch = LinkageBatch.of([linkage])
    return batch, BranchAndOrder.of(
        batch,
        rows[None],
        LENGTH,
        DrivenBranch(np.array([0]), np.array([sign]), np.array([middle])),
        asked,
    )


def test_a_journey_is_kept_just_where_a_sweep_keeps_to_it():
    """Random places of 4R linkages in some order: order, branch and clearance by brute force."""
    rng = np.random.default_rng(4)
    verdicts = []
    for number in range(400):
        first, second = random_four_bar(rng)
        start, reach = rng.uniform(-3, 3), rng.uniform(0.5, 6)
        drive = start + np.sort(rng.uniform(0, reach, 5)) * rng.choice([-1, 1])
        if number % 3 == 0:
            drive[[1, 2]] = drive[[2, 1]]
        rows = swept(first, second, drive)[0]
        if not np.isfinite(rows).all():
            continue
        fine = np.linspace(drive.min(), drive.max(), 3001)
        d, phi = (part[0] for part in assembled(first, second, fine))
        step = np.diff(drive)
        around = [(way * step) % (2 * np.pi) for way in (1, -1)]
        ordered = (step > 0.01).all() or (step < -0.01).all()
        if not ordered and min(turn.sum() for turn in around) < 2 * np.pi + 0.05:
            continue  # in order the other way round
        sine = np.abs(sines(first, second, d, phi)).min() if np.isfinite(phi).all() else 0.0
        if abs(sine - np.sin(np.radians(5))) < 5e-3 or np.abs(step).min() < 0.02:
            continue
        linkage = Linkage(first, second)
        sign = np.sign(sine_of(linkage, rows)[0])
        middle = (
            np.nan
            if np.isfinite(swept(first, second, np.linspace(-3.2, 3.2, 200))).all()
            else drive.mean()
        )
        batch, journey = journey_of(linkage, rows, sign, middle=middle)
        value, equal = journey(batch, rows[None], np.array([0]))
        assert not equal.any()
        kept = ordered and sine > np.sin(np.radians(5))
        assert (value <= 0).all() == kept
        verdicts.append(kept)
        if np.ptp(drive) < 3.0:  # in any order, only the branch counts
            batch, loose = journey_of(linkage, rows, sign, Requirements(any_order=True), middle)
            assert (loose(batch, rows[None], np.array([0]))[0] <= 0).all() == (
                sine > np.sin(np.radians(5))
            )
        # On the other branch nothing is right.
        batch, other = journey_of(linkage, rows, -sign, middle=middle)
        assert (other(batch, rows[None], np.array([0]))[0] > 0).any()
    assert 20 < sum(verdicts) < len(verdicts) - 20


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("step", [80.0, 100.0])
def test_a_crank_meets_all_poses_within_one_turn(step, sense):
    """Five poses at even crank angles, all in order: 400 degrees are 40 too many, 320 are none."""
    first, second = RR([0, 0], [0, 0], 1.0), RR([4, 0], [4, 0], 3.0)  # a crank-rocker
    drive = sense * np.radians(step) * np.arange(5)
    rows = swept(first, second, drive)[0]
    batch, journey = journey_of(
        Linkage(first, second), rows, np.sign(sine_of(Linkage(first, second), rows)[0])
    )
    value, equal = journey(batch, rows[None], np.array([0]))
    assert not equal.any()
    if step == 80.0:
        assert (value <= 0).all()
    else:
        assert value.max() == pytest.approx(np.radians(40.0), abs=0.01)


def test_types_are_grashofs():
    rng = np.random.default_rng(5)
    names = ["double-crank", "crank-rocker", "double-rocker", "rocker-crank", "triple-rocker"]
    met = set()
    for _ in range(200):
        linkage = Linkage(*random_four_bar(rng))
        ground = np.linalg.norm(linkage.second.fixed_pivot - linkage.first.fixed_pivot)
        coupler = np.linalg.norm(linkage.second.moving_pivot - linkage.first.moving_pivot)
        for driver in (0, 1):
            ends = linkage.first.radius, linkage.second.radius
            own = Links(ground, ends[driver], coupler, ends[1 - driver])
            name = grashof(own)
            met.add(name)
            batch = LinkageBatch.of([linkage] * 5)
            excess = type_excess(batch, np.full(5, driver), names)
            assert [names[k] for k in np.flatnonzero((excess <= 0).all(axis=1))] == [name]
    assert met == set(names)


def test_ratio_of_links_and_room_for_the_pivots():
    rng = np.random.default_rng(6)
    box = Polygon([[-1.5, -1.5], [1.5, -1.5], [1.5, 1.5], [-1.5, 1.5]])
    asked = Requirements(link_ratio=2.5, footprint=box)
    told = []
    for _ in range(300):
        linkage = Linkage(*random_four_bar(rng))
        rows = swept(linkage.first, linkage.second, rng.uniform(-3, 3, 3))[0]
        if not np.isfinite(rows).all():
            continue
        frames = CanonicalFrames(np.array([0.3, -0.2]), np.zeros(2), np.array(2.0))
        batch = LinkageBatch.of([linkage]).to_canonical(frames)
        seen = (rows - [0.3, -0.2, 0.0]) / 2.0
        part = LinkProportions(LENGTH / 2, frames, asked, np.array([0]), np.array([""]))
        only = {
            name: LinkProportions(LENGTH / 2, frames, each, np.array([0]), np.array([""]))
            for name, each in (
                ("ratio", Requirements(link_ratio=2.5)),
                ("room", Requirements(footprint=box)),
            )
        }
        links = [
            np.linalg.norm(linkage.second.fixed_pivot - linkage.first.fixed_pivot),
            np.linalg.norm(linkage.second.moving_pivot - linkage.first.moving_pivot),
            linkage.first.radius,
            linkage.second.radius,
        ]
        pivots = [linkage.first.fixed_pivot, linkage.second.fixed_pivot]
        for dyad in (linkage.first, linkage.second):
            pin = rows[:, :2] @ [1, 1j] + np.exp(1j * rows[:, 2] / LENGTH) * (
                dyad.moving_pivot @ [1, 1j]
            )
            pivots += [np.array([p.real, p.imag]) for p in pin]
        right = max(links) / min(links) <= 2.5, np.abs(pivots).max() <= 1.5
        here = batch, seen[None], np.array([0])
        assert (only["ratio"](*here)[0] <= 0).all() == right[0]
        assert (only["room"](*here)[0] <= 0).all() == right[1]
        value, equal = AllConstraints((part,))(*here)
        assert (value <= 0).all() == all(right)
        assert not equal.any()
        told.append(right)
    assert {True, False} == {a for a, _ in told} == {b for _, b in told}


def test_links_that_are_too_short_count_and_the_slopes_are_those_of_differences():
    """All kinds of linkages; each number is what a link lacks, and moves as the dimensions do."""
    rng, least = np.random.default_rng(4), np.array([0.5, 0.4, 0.3, 0.6])
    for second in (RR, PR, RP):
        linkage = Linkage(*random_four_bar(rng, second))
        batch = LinkageBatch.of([linkage])
        part, which, rows = LeastLinks(least), np.array([0]), np.zeros((1, 3, 3))
        value, equal = part(batch, rows, which)
        assert not equal.any()
        one, two = linkage.first, linkage.second
        assert value[0, 0] == pytest.approx(0.5 - one.radius, rel=1e-5)
        if second is RR:
            apart = [two.radius, np.linalg.norm(two.fixed_pivot - one.fixed_pivot)]
            apart.append(np.linalg.norm(two.moving_pivot - one.moving_pivot))
            assert value[0, 1:] == pytest.approx(least[1:] - apart, rel=1e-5)
        _, slope, _ = part.differentiated(batch, rows, which, np.zeros((1, 3, 3, 13)))
        for k in range(10):
            z = batch.dimensions.reshape(1, 10) + 1e-6 * (np.arange(10) == k)
            more = part(LinkageBatch(batch.kinds, z.reshape(1, 2, 5)), rows, which)[0]
            assert (more - value)[0] / 1e-6 == pytest.approx(slope[0, :, k], abs=1e-5)


def test_limits_count_in_the_frames_unit():
    """A line, a segment and a link's length: each number is the distance from being kept."""
    frames = CanonicalFrames(np.array([1.0, 2.0]), np.array([-0.5, 0.25]), np.array(4.0))
    dyad = RR([3.0, 1.0], [0.5, -2.0], 2.5)
    other = RR([0.0, 0.0], [1.0, 1.0], 1.0)
    batch = LinkageBatch.of([Linkage(dyad, other)]).to_canonical(frames)
    rows, which = np.zeros((1, 2, 3)), np.array([0])

    def held(side, **limits):
        return DyadLimitsConstraint(side, Limits(**limits), frames)(batch, rows, which)

    value, equal = held(0, length=(1.0, 2.0))
    assert np.allclose(value[0], [(1.0 - 2.5) / 4, (2.5 - 2.0) / 4])
    assert not equal.any()
    value, equal = held(0, fixed_pivot=Line((0, 0), (1, 0)))
    assert np.abs(value[0, equal]) == pytest.approx([1.0 / 4])
    assert (value[0, ~equal] <= 0).all()
    value, equal = held(0, fixed_pivot=Segment((0, 0), (2, 0)))
    assert np.abs(value[0, equal]) == pytest.approx([1.0 / 4])
    assert max(value[0, ~equal]) == pytest.approx(1.0 / 4)  # one beyond the end
    value, equal = held(0, moving_pivot=Polygon([[0, -1], [2, -1], [2, 1], [0, 1]]))
    assert max(value[0]) == pytest.approx(1.0 / 4)
    value, equal = held(1, moving_pivot=Polygon([[0, 0], [4, 0], [4, 4], [0, 4]]))
    assert max(value[0]) == pytest.approx(-1.0 / 4)


# A box, a triangle given clockwise, and an L; and whether x, y lies in it, by rules of its own.
REGIONS = {
    "box": (
        [[0, -1], [2, -1], [2, 1], [0, 1]],
        lambda x, y: (x >= 0) & (x <= 2) & (abs(y) <= 1),
    ),
    "triangle": ([[0, 0], [0, 2], [2, 0]], lambda x, y: (x >= 0) & (y >= 0) & (x + y <= 2)),
    "an L": (
        [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]],
        lambda x, y: (x >= 0) & (y >= 0) & (x <= 2) & (y <= 2) & ((x <= 1) | (y <= 1)),
    ),
}


@pytest.mark.parametrize("name", REGIONS)
def test_a_region_is_kept_just_where_its_points_are(name):
    corners, inside = REGIONS[name]
    at = np.random.default_rng(8).uniform(-1, 3, (300, 2))
    dyads = RR(at, np.zeros((300, 2)), np.ones(300))
    other = RR([9.0, 9.0], [1.0, 1.0], 1.0)
    batch = LinkageBatch.of([Linkage(each, other) for each in dyads])
    keep = DyadLimitsConstraint(0, Limits(fixed_pivot=Polygon(corners)), PLAIN)
    value, equal = keep(batch, np.zeros((300, 2, 3)), np.arange(300))
    assert not equal.any()
    assert ((value <= 0).all(axis=1) == inside(*at.T)).all()


def test_the_sides_of_a_box_hold_one_by_one():
    """At a corner both sides stand in the way, so that a descent need not run along one of them."""
    keep = DyadLimitsConstraint(0, Limits(fixed_pivot=Polygon(REGIONS["box"][0])), PLAIN)
    batch = LinkageBatch.of([Linkage(RR([2.25, 1.5], [0, 0], 1), RR([9, 9], [1, 1], 1))])
    value, _ = keep(batch, np.zeros((1, 2, 3)), np.array([0]))
    assert sorted(value[0][value[0] > 0]) == pytest.approx([0.25, 0.5])


def numerical_slopes(keep, kinds, z, rows, place_jacobian):
    """Derivatives of constraint values by all unknowns, by central differences of the values."""
    out = []
    for column in range(place_jacobian.shape[-1]):
        ends = []
        for h in (1e-6, -1e-6):
            moved = z + h * (np.arange(10) == column)
            there = rows + h * place_jacobian[..., column]
            batch = LinkageBatch(kinds, moved.reshape(-1, 2, 5))
            ends.append(keep(batch, there, np.arange(len(z)))[0])
        out.append((ends[0] - ends[1]) / 2e-6)
    return np.stack(out, axis=-1)


@pytest.mark.parametrize("ways", [True, False], ids=["places are unknowns", "nearest places"])
def test_derivatives_by_all_unknowns(ways):
    """Limits, branch, order, proportions and tolerances, against differences of their values."""
    rng = np.random.default_rng(12)
    frames = CanonicalFrames(np.array([0.3, -0.2]), np.array([0.1, 0.4]), np.array(2.0))
    corners, notched = REGIONS["box"][0], REGIONS["an L"][0]
    limits = (
        Limits(fixed_pivot=Polygon(corners), moving_pivot=Segment((0, 0), (2, 1))),
        Limits(fixed_pivot=Polygon(notched), moving_pivot=Line((0, 1), (1, 0)), length=(0.5, 3)),
    )
    number = 4
    for pair in PAIRS:
        if pair == (RP, RP):
            continue
        rows = np.full((1, number, 3), np.nan)
        while not np.isfinite(rows).all():
            linkage = Linkage(random_dyad(pair[0], rng), random_dyad(pair[1], rng))
            rows = swept(linkage.first, linkage.second, np.sort(rng.uniform(-2, 2, number)))[:1]
        batch = LinkageBatch.of([linkage])
        by_place = np.zeros((1, number, 3, 10 + number * ways))
        by_place[..., :10] = rng.normal(size=(1, number, 3, 10))
        if ways:
            each = np.arange(number)
            by_place[:, each, :, 10 + each] = rng.normal(size=(number, 1, 3))
        for driver in (np.array([0]), np.array([1])):
            for asked in (ANY, Requirements(any_order=True)):
                branch = DrivenBranch(driver, np.ones(1), np.full(1, np.nan))
                in_order = BranchAndOrder.of(batch, rows, LENGTH, branch, asked)
                box = Polygon(corners)
                proportions = LinkProportions(
                    LENGTH,
                    frames,
                    Requirements(link_ratio=2.5, footprint=box),
                    driver,
                    np.array(["crank-rocker"]),
                )
                parts = [DyadLimitsConstraint(side, limits[side], frames) for side in (0, 1)]
                keep = AllConstraints((in_order, proportions, *parts))
                value, slope, equal = keep.differentiated(batch, rows, np.array([0]), by_place)
                same, also = keep(batch, rows, np.array([0]))
                assert np.allclose(value, same, atol=1e-12)
                assert np.array_equal(equal, also)
                z = batch.dimensions.reshape(1, 10)
                numerical = numerical_slopes(keep, batch.kinds, z, rows, by_place)
                assert np.allclose(slope, numerical, rtol=1e-4, atol=1e-4)
