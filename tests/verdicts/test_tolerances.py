"""The spread of built linkages, against linkages driven joint by joint and against all corners.

Where linkages come that are built amiss is found by `tests/oracles/built_amiss.py`; only the
dimensions as built are taken from the code under test.
"""

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from benchmarks import tolerances as campaign

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import places_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.verdicts.built_linkages import BuiltLinkages, percentile_95
from burmester.verdicts.tolerances import sensitivity, spread
from tests.oracles import built as brute_force
from tests.oracles.built_amiss import asked, built_amiss, driven, problem
from tests.oracles.refits import LENGTH, dyads_of, numbers_of
from tests.oracles.witness import misses, places, random_four_bar, random_poses
from tests.samples import samples

ROOT = Path(__file__).parents[2]
KINDS = pytest.mark.parametrize("second", [RR, PR, RP])


@KINDS
def test_places_move_as_those_of_a_linkage_that_is_driven(second):
    dyads, rows, drive, found = problem(0, second)
    slope = sensitivity(*asked(dyads, rows, found))[0]
    columns, slots = built_amiss(dyads, found)
    z, h = numbers_of(dyads), 1e-4
    for column, slot in zip(columns, slots, strict=True):
        ends = [
            driven(dyads_of([RR, second], z + sign * h * column), rows, drive) for sign in (1, -1)
        ]
        told = (ends[0] - ends[1])[:, :2] / (2 * h)
        assert np.abs(slope[:, :, slot] - told).max() < 1e-5 * max(1, np.abs(told).max())
    rest = np.setdiff1d(np.arange(10), slots)
    assert not slope[:, :, rest].any()


@KINDS
def test_built_linkages_come_where_a_witness_finds_them(second):
    dyads, rows, drive, found = problem(10, second)
    batch, poses, at, length = asked(dyads, rows, found)
    linkages = BuiltLinkages.of(batch, poses, at, length, 0.01)
    built = linkages.at_random(4, seed=3)
    assert built.assembled.all()
    for k in range(4):
        one = linkages.batch(built.off).linkage(k)
        told = driven((one.first, one.second), rows, drive)
        here = places_of(built.rows[k], length)
        assert np.abs(here.translation - told[:, :2]).max() < 1e-7
        assert np.abs(here.angle - told[:, 2]).max() < 1e-7
        assert np.allclose(built.position[k], np.hypot(*(told[:, :2] - rows[:, :2]).T), atol=1e-7)
        # The witness that looks on every circuit finds nothing farther away.
        gap = np.hypot(built.position[k], length * (here.angle - poses.angle))
        assert (misses(one, poses, length) < gap + 1e-7).all()


@KINDS
def test_what_is_built_is_spread_evenly_within_the_tolerance(second):
    dyads, rows, _, found = problem(2, second)
    batch, poses, at, length = asked(dyads, rows, found)
    linkages = BuiltLinkages.of(batch, poses, at, length, 0.01)
    made = linkages.batch(linkages.at_random(2000).off)
    off = (made.dimensions - batch.dimensions[0]).reshape(2000, 10)
    columns, slots = built_amiss(dyads, found)
    use = np.zeros((len(slots), 10))
    use[:, slots] = columns
    errors = np.linalg.lstsq(use.T, off.T, rcond=None)[0].T / 0.01
    assert np.allclose(errors @ use * 0.01, off, atol=1e-14)
    assert np.abs(errors).max() <= 1 + 1e-9
    assert np.allclose(errors.std(axis=0), 3**-0.5, atol=0.02)
    assert np.abs(np.corrcoef(errors.T) - np.eye(len(slots))).max() < 0.1


@KINDS
def test_the_greatest_error_is_that_of_the_worst_corner(second):
    dyads, rows, _, found = problem(3, second)
    batch, poses, at, length = asked(dyads, rows, found)
    tolerance = 1e-5  # so small that the tolerance's square does not count
    told = spread(batch, poses, at, length, tolerance)
    assert not told.monte_carlo[0]
    slope = tolerance * sensitivity(batch, poses, at, length)[0]
    gap = found[:, :2] - rows[:, :2]
    corners = np.array(list(product((-1, 1), repeat=10)))
    greatest = np.linalg.norm(gap + np.einsum("sj,ncj->snc", corners, slope), axis=-1).max(axis=0)
    assert (told.worst[0] >= greatest * (1 - 1e-12)).all()
    assert (told.worst[0] <= greatest * (1 + 2e-4)).all()
    # Without gaps the tolerance alone is left.
    dyads, rows, _, found = problem(3, second, off=0.0)
    told = spread(*asked(dyads, rows, found), tolerance)
    slope = tolerance * sensitivity(*asked(dyads, rows, found))[0]
    greatest = np.linalg.norm(np.einsum("sj,ncj->snc", corners, slope), axis=-1).max(axis=0)
    assert told.worst[0] == pytest.approx(greatest, rel=1e-3)
    assert told.bound[0] == told.worst[0].max()


@KINDS
def test_the_linear_spread_is_that_of_linkages_built(second):
    dyads, rows, _, found = problem(4, second)
    batch, poses, at, length = asked(dyads, rows, found)
    tolerance = 1e-3
    told = spread(batch, poses, at, length, tolerance)
    assert not told.monte_carlo[0]
    built = BuiltLinkages.of(batch, poses, at, length, tolerance).at_random(4000, seed=1)
    moved = np.linalg.norm(built.rows[..., :2] - found[:, :2], axis=-1)
    assert np.allclose(np.sqrt((moved**2).mean(axis=0)), told.deviation[0], rtol=0.04)
    assert np.isclose(np.sqrt((built.position**2).mean()), told.rms[0], rtol=0.01)
    greatest_95 = percentile_95(built.greatest)
    assert np.isclose(greatest_95, told.greatest_95[0], rtol=0.02)
    gap = np.linalg.norm(found[:, :2] - rows[:, :2], axis=-1)
    above = (greatest_95 - gap.max()) / (told.greatest_95[0] - gap.max())
    assert 0.85 < above < 1.15
    assert (built.position.max(axis=0) < told.worst[0] * 1.002).all()


def test_a_linkage_that_meets_its_poses_has_only_the_spread():
    dyads, rows, _, found = problem(5, RR, off=0.0)
    told = spread(*asked(dyads, rows, found), 0.01)
    assert np.isclose(told.rms[0] ** 2, (told.deviation[0] ** 2).mean(), rtol=1e-6)
    assert told.rms[0] < told.greatest_95[0] < told.bound[0]


def tenth(dyad):
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot / 10, dyad.moving_pivot / 10, dyad.radius / 10)
    return PR(dyad.normal_angle, dyad.offset / 10, dyad.moving_pivot / 10)


def test_several_linkages_of_several_kinds_at_once():
    one, rows, _, found = problem(6, RR)
    batch = LinkageBatch.of([Linkage(*one), Linkage(one[1], one[0])])
    poses, at = Displacement.from_poses(rows), Displacement.from_poses(np.stack([found, found]))
    both = sensitivity(batch, poses, at, LENGTH)
    assert np.allclose(both[0], both[1][..., [5, 6, 7, 8, 9, 0, 1, 2, 3, 4]], atol=1e-9)
    other, more, _, there = problem(7, PR)
    alone = spread(*asked(other, more, there), 0.01)
    mixed = LinkageBatch.of([Linkage(*one), Linkage(*other)])
    at = Displacement.from_poses(np.stack([found, there]))
    together = spread(mixed, Displacement.from_poses(more), at, LENGTH, 0.01)
    assert np.isclose(together.rms[1], alone.rms[0])
    assert np.isclose(together.greatest_95[1], alone.greatest_95[0])
    # Ten times smaller a unit, and ten times the numbers.
    tenfold = LinkageBatch.of([Linkage(*(tenth(d) for d in other))])
    small = spread(
        tenfold,
        Displacement(more[:, :2] / 10, more[:, 2]),
        Displacement(there[None, :, :2] / 10, there[None, :, 2]),
        LENGTH / 10,
        0.001,
    ).one(0, 10.0)
    assert np.allclose(small.worst, together.worst[1])
    assert np.isclose(small.bound, together.bound[1])
    assert np.isclose(small.rms, together.rms[1])


def errors_by_brute_force(dyads, rows, offs, tolerance):
    """The greatest errors (n,) of linkages with errors (n, 10), in tolerances."""
    return np.array(
        [
            brute_force.greatest_error(brute_force.built(dyads, off, tolerance), rows, LENGTH)
            for off in offs
        ]
    )


def test_a_linkage_that_cannot_be_assembled_is_counted():
    # Its follower can be too short to reach: a tolerance nearly as large as the shortest link.
    dyads, rows, _, found = problem(8, RR, off=0.0)
    tolerance = 0.97 * min(float(each.radius) for each in dyads)
    drawn = BuiltLinkages.of(*asked(dyads, rows, found), tolerance).at_random()
    told = spread(*asked(dyads, rows, found), tolerance)
    lost = np.isinf(errors_by_brute_force(dyads, rows, drawn.off[:500], tolerance))
    assert 0.02 < lost.mean() < 0.2
    assert (lost == ~drawn.assembled[:500]).all()
    assert told.monte_carlo[0]
    assert told.lost[0] == pytest.approx((~drawn.assembled).mean())
    # With negative lengths nothing can be built at all.
    none = BuiltLinkages.of(*asked(dyads, rows, found), 1e-9)
    assert not none.with_errors(np.array([[0, 0, 0, 0, -1e10, 0, 0, 0, 0, 0]])).assembled.any()


def near_dead_points(seed):
    """A four-bar with a link as short as a few tolerances, and poses that it meets on one way."""
    rng = np.random.default_rng(seed)
    while True:
        dyads = random_four_bar(rng)
        short = rng.uniform(2, 6) * TOLERANCE
        dyads[0] = RR(dyads[0].fixed_pivot, dyads[0].moving_pivot, short)
        where, _ = places(*dyads, np.linspace(-np.pi, np.pi, 181))
        if np.isfinite(where[0]).mean() > 0.2:
            rows = random_poses(dyads, rng, 5, side=0, ordered=True)
            return dyads, rows


TOLERANCE = 0.05


@pytest.mark.parametrize("seed", samples(6, 3))
def test_short_links_near_dead_points_err_as_those_that_are_driven(seed):
    """95 % within what is told, and none worse than the greatest one, by brute force."""
    dyads, rows = near_dead_points(seed)
    told = spread(*asked(dyads, rows, rows), TOLERANCE)
    rng = np.random.default_rng(100 + seed)
    offs = rng.uniform(-1, 1, size=(500, 10))
    greatest = errors_by_brute_force(dyads, rows, offs, TOLERANCE)
    there = np.isfinite(greatest)
    assert abs((~there).mean() - told.lost[0]) < 0.03
    assert 0.915 < (greatest[there] <= told.greatest_95[0]).mean() < 0.98
    assert greatest[there].max() <= told.bound[0] * 1.001


def test_first_order_is_kept_only_where_it_is_right():
    methods = set()
    for seed in range(6):
        dyads, rows = near_dead_points(seed)
        for tolerance in (TOLERANCE / 1000, TOLERANCE):
            told = spread(*asked(dyads, rows, rows), tolerance)
            methods.add((tolerance == TOLERANCE, bool(told.monte_carlo[0])))
            if told.monte_carlo[0]:
                continue
            made = BuiltLinkages.of(*asked(dyads, rows, rows), tolerance).at_random(400, seed=7)
            assert percentile_95(made.greatest) == pytest.approx(told.greatest_95[0], rel=0.15)
    assert {(False, False), (True, True)} <= methods


def test_what_is_told_holds_where_first_order_does_not():
    """A sample of `python -m benchmarks.tolerances`."""
    found = campaign.rows(4, 3, 300)
    covered, worst = (np.array([getattr(each, name) for each in found]) for name in campaign.HELD)
    assert {each.short for each in found} == {False, True}
    assert (np.abs(covered[:, 0] - 0.95) < 0.035).all()
    assert (worst[:, 0] < campaign.WORSE).all()
    assert (worst[:, 1] > campaign.WORSE).any()


def test_six_poses_of_the_readme():
    """Where the tolerance is a tenth of the links: 95 % within what is told, and lost ones told."""
    given = np.loadtxt(ROOT / "examples/poses.csv", delimiter=",", skiprows=3)[:6]
    task = Task.from_rows(given, angle_unit="deg")
    options = SynthesisOptions(manufacturing_tolerance=0.1, length_per_radian=LENGTH)
    rows = np.column_stack([task.poses.translation, task.poses.angle])
    rng = np.random.default_rng(0)
    found = [
        each
        for each in synthesize(task, options).linkages
        if each.linkage.links is not None and not any(d.kind == "circuit" for d in each.defects)
    ]
    assert any(each.spread.monte_carlo for each in found)
    for each in found:
        dyads, told = [dyad.dyad for dyad in each.dyads], each.spread
        greatest = errors_by_brute_force(dyads, rows, rng.uniform(-1, 1, size=(300, 10)), 0.1)
        there = np.isfinite(greatest)
        assert abs((~there).mean() - told.lost) < 0.09
        assert 0.9 < (greatest[there] <= told.greatest_95).mean() < 0.99
        assert greatest[there].max() <= told.bound * 1.01
