"""The 95 % regions of pivots, against refits that know no Jacobian of ours.

The other fit (`refitted`) has a driver's position for each pose among its unknowns, drives the
linkage joint by joint (`tests/oracles/witness.py`), and leaves the derivatives to SciPy.
"""

from dataclasses import replace

import numpy as np
import pytest
from benchmarks import coverage as campaign
from scipy.linalg import null_space

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_task import Task
from burmester.verdicts.uncertainty import (
    PivotRegion,
    covariance,
    line_middle,
    pose_sigma,
    uncertainties,
)
from tests.oracles.refits import LENGTH, USED, case, dyads_of, refitted, slopes
from tests.oracles.witness import places

SIGMA = (2e-6, 5e-6)


def in_use(kinds):
    """Where the numbers in use are among the ten of a batch."""
    return np.concatenate([5 * side + np.arange(USED[kind]) for side, kind in enumerate(kinds)])


def ours(dyads, rows, weights=None, held=None, sigma=SIGMA, *, free=None):
    batch = LinkageBatch.of([Linkage(*dyads)])
    at = Displacement.from_poses(rows[None])
    return (
        batch,
        at,
        covariance(batch, at, LENGTH, sigma, weights=weights, fixed=held, free_directions=free),
    )


@pytest.mark.parametrize(
    ("seed", "second", "weighted"), [(0, RR, False), (1, RR, True), (2, PR, True), (3, RP, False)]
)
def test_the_covariance_is_that_of_refits(seed, second, weighted):
    dyads, rows, drive = case(seed, second, 7)
    weights = np.random.default_rng(seed).uniform(0.2, 3, 7) if weighted else None
    slope = slopes(dyads, rows, drive, weights) * [SIGMA[0], SIGMA[0], SIGMA[1]]
    told = np.einsum("anc,bnc->ab", slope, slope)
    _, _, found = ours(dyads, rows, weights)
    use = in_use([type(d) for d in dyads])
    assert np.abs(found[0][np.ix_(use, use)] - told).max() < 1e-5 * np.abs(told).max()
    size = np.sqrt(np.diag(told))
    assert (
        np.abs(
            found[0][np.ix_(use, use)] / np.outer(size, size) - told / np.outer(size, size)
        ).max()
        < 1e-3
    )
    rest = np.setdiff1d(np.arange(10), use)
    assert not found[0][rest].any()
    assert not found[0][:, rest].any()


@pytest.mark.parametrize(("seed", "second"), [(6, RR), (7, PR)])
def test_what_is_free_at_poses_tells_nothing(seed, second):
    """Angles of three of them, and x of one."""
    dyads, rows, drive = case(seed, second, 8)
    counts = np.ones((8, 3))
    counts[[1, 4, 6], 2] = 0
    counts[3, 0] = 0
    slope = slopes(dyads, rows, drive, counts=counts) * [SIGMA[0], SIGMA[0], SIGMA[1]]
    told = np.einsum("anc,bnc->ab", slope, slope)
    _, _, found = ours(dyads, rows, free=np.eye(3) * (1 - counts)[..., None])
    use = in_use([type(d) for d in dyads])
    size = np.sqrt(np.diag(told))
    assert np.abs(found[0][np.ix_(use, use)] - told).max() < 1e-5 * np.abs(told).max()
    assert np.sqrt(np.diag(found[0]))[use] == pytest.approx(size, rel=1e-3)


@pytest.mark.parametrize("second", [RR, PR])
def test_what_is_held_does_not_move(second):
    dyads, rows, drive = case(4, second, 7)
    use = in_use([type(d) for d in dyads])
    held = np.zeros((1, 4, 10))  # the last row says nothing, the third what the first two say
    held[0, 0, 0] = 3.0
    held[0, 1, [1, 5]] = 1.0, -2.0
    held[0, 2, [0, 1, 5]] = 1.0, 1.0, -2.0
    free = null_space(held[0][:, use])
    slope = slopes(dyads, rows, drive, None, free) * [SIGMA[0], SIGMA[0], SIGMA[1]]
    told = np.einsum("anc,bnc->ab", slope, slope)
    _, _, found = ours(dyads, rows, None, held)
    assert np.abs(found[0][np.ix_(use, use)] - told).max() < 1e-5 * np.abs(told).max()
    assert np.abs(held[0] @ found[0]).max() < 1e-14 * np.abs(told).max()


def test_a_pose_of_large_weight_passes_its_errors_on():
    # Met nearly exactly: the fit does not smooth its errors, but they are not gone.
    dyads, rows, drive = case(5, RR, 7)
    weights = np.ones(7)
    weights[2] = 1e6
    slope = slopes(dyads, rows, drive, weights) * [SIGMA[0], SIGMA[0], SIGMA[1]]
    told = np.einsum("anc,bnc->ab", slope, slope)
    _, _, found = ours(dyads, rows, weights)
    assert np.abs(found[0] - told).max() < 1e-4 * np.abs(told).max()


@pytest.mark.parametrize("second", [RR, PR, RP])
def test_regions_hold_the_truth_in_95_of_100_draws(second):
    dyads, rows, drive = case({RR: 7, PR: 8, RP: 9}[second], second, 12)
    rng = np.random.default_rng(0)
    batch, at, spread = ours(dyads, rows)
    ((one, other),) = uncertainties(spread, batch, at)
    hits, draws = [], 120
    middle = line_middle(batch, at)[0, 1]
    for _ in range(draws):
        noise = rng.normal(size=rows.shape) * [SIGMA[0], SIGMA[0], SIGMA[1]]
        first, last = dyads_of([RR, second], refitted(dyads, rows + noise, drive))
        hits.append(one.fixed.contains(first.fixed_pivot - dyads[0].fixed_pivot))
        hits.append(one.moving.contains(first.moving_pivot - dyads[0].moving_pivot))
        hits.append(abs(first.radius - dyads[0].radius) < one.length)
        if other.fixed is not None:
            hits.append(other.fixed.contains(last.fixed_pivot - dyads[1].fixed_pivot))
        if other.moving is not None:
            hits.append(other.moving.contains(last.moving_pivot - dyads[1].moving_pivot))
        if other.line is not None:
            turned = last.normal_angle - dyads[1].normal_angle
            hits.append(abs(turned) < other.line.angle)
            # Where the true line crosses the normal of the fitted one, in the middle of its use.
            true = dyads[1]
            point = (true.offset + 1j * middle) * np.exp(1j * true.normal_angle)
            away = (point * np.exp(-1j * last.normal_angle)).real - last.offset
            hits.append(abs(away) < other.line.offset)
    share = np.reshape(hits, (draws, -1)).mean(axis=0)
    assert (share > 0.88).all()  # 95 % and three and a half deviations of a count of 120
    assert 0.925 < share.mean() < 0.98


def test_an_ellipse_holds_what_it_should():
    # The 95 % ellipse of a known covariance, against its level set written out.
    rng = np.random.default_rng(0)
    root = rng.normal(size=(2, 2))
    spread = np.zeros((1, 10, 10))
    spread[0, :2, :2] = root @ root.T
    batch = LinkageBatch.of([Linkage(RR([0, 0], [1, 0], 1.0), RR([2, 0], [0, 1], 1.0))])
    ((one, other),) = uncertainties(spread, batch, Displacement.identity((1, 3)), unit=3.0)
    draws = rng.normal(size=(40000, 2)) @ root.T
    level = np.einsum("ni,ni->n", draws, np.linalg.solve(root @ root.T, draws.T).T)
    assert np.array_equal(one.fixed.contains(3 * draws), level <= 5.991464547107979)
    assert abs(one.fixed.contains(3 * draws).mean() - 0.95) < 0.005
    assert one.half_width == one.fixed.half_width == one.fixed.major > one.fixed.minor
    assert other.half_width == 0
    assert PivotRegion(2, 1, np.pi / 2).contains(np.array([0.0, 1.9]))


def test_a_region_is_determined_where_first_order_is_trusted():
    """Up to 5 % of the motion's size and of the link, where no other region of it runs away."""
    batch = LinkageBatch.of([Linkage(RR([0, 0], [1, 0], 1.0), PR(0.3, 1.0, [0, 1]))])
    at = Displacement.identity((1, 3))

    def regions(first, across, turn, size, unit=1.0):
        """Half-widths of the first fixed pivot, across it, and of the line's direction."""
        spread = np.zeros((1, 10, 10))
        spread[0, 0, 0], spread[0, 1, 1] = (first / 2.4477) ** 2, (across / 2.4477) ** 2
        spread[0, 5, 5] = (turn / 1.96) ** 2
        spread[0, [2, 4, 7], [2, 4, 7]] = 1e-6
        return uncertainties(spread, batch, at, unit, size)[0]

    one, other = regions(0.03, 0.01, 0.04, 1.0)
    assert one.determined
    assert other.determined
    one, _ = regions(0.06, 0.04, 0.04, 1.0)
    assert (one.fixed.determined, one.fixed.determined_across) == (False, True)
    assert one.length_determined
    one, _ = regions(0.06, 0.055, 0.04, 1.0)
    assert not one.fixed.determined_across
    one, other = regions(0.06, 0.04, 0.06, 2.0)  # more than a twentieth of the link
    assert not one.fixed.determined
    assert not other.line.angle_determined
    one, _ = regions(0.03, 0.01, 0.04, 0.5)  # of the motion
    assert not one.fixed.determined
    one, _ = regions(0.03, 0.01, 0.04, 5.0, 10.0)  # the same in another unit: 0.3 of 5 and of 10
    assert not one.fixed.determined
    one, other = regions(0.31, 0.01, 0.04, 1.0)  # one region takes all of its linkage with it
    assert not other.line.angle_determined
    assert not other.line.offset_determined
    assert not other.moving.determined
    assert not one.moving.determined
    assert not one.length_determined
    assert one.fixed.major == pytest.approx(0.31, rel=1e-3)
    sure = replace(other.moving, major=0.0, minor=0.0)  # held by a limit: nothing can move it
    assert sure.determined


@pytest.mark.parametrize("second", [RR, PR, RP])
def test_regions_do_not_depend_on_frames_and_units(second):
    dyads, rows, _ = case(11, second, 9)
    batch, at, spread = ours(dyads, rows)
    plain = uncertainties(spread, batch, at)[0]
    poses = Displacement.from_poses(rows)
    unit = 0.37
    frames = CanonicalFrames(np.array([200.0, -50.0]), np.zeros(2), np.array(unit))
    seen = frames.to_canonical(poses)
    there = batch.to_canonical(frames)
    spread = covariance(there, seen[None], LENGTH / unit, (SIGMA[0] / unit, SIGMA[1]))
    for a, b in zip(plain, uncertainties(spread, there, seen[None], unit)[0], strict=True):
        for region, same in ((a.fixed, b.fixed), (a.moving, b.moving)):
            if region is not None:
                assert np.allclose(
                    [region.major, region.minor], [same.major, same.minor], rtol=1e-8
                )
                assert abs(np.sin(region.direction - same.direction)) < 1e-6
        if a.line is not None:
            assert np.allclose([a.line.angle, a.line.offset], [b.line.angle, b.line.offset])
        if a.length is not None:
            assert np.isclose(a.length, b.length)


@pytest.mark.parametrize("second", [RR, PR, RP])
def test_a_body_that_hardly_moves_leaves_its_pivots_open(second):
    # The same linkage, its driver turned by half a radian and by a thousandth of one.
    dyads, _, drive = case(3, second)
    wide, narrow = [], []
    for spread, out in ((0.5, wide), (1e-3, narrow)):
        turned = drive[0] + spread * np.linspace(-0.5, 0.5, 12)
        where, phi = places(*dyads, turned)
        rows = np.column_stack([where[0].real, where[0].imag, phi[0]])
        batch, at, found = ours(dyads, rows, sigma=(1e-4, 1e-4))
        out += [each.half_width for each in uncertainties(found, batch, at)[0]]
    assert min(narrow) > 10
    assert min(narrow) > 100 * max(wide)


@pytest.mark.parametrize(
    ("count", "second", "sides"), [(1, RR, 2), (4, RR, 2), (3, RP, 2), (4, RP, 1), (4, PR, 1)]
)
def test_too_few_poses_leave_dyads_open(count, second, sides):
    # A slider has four dimensions, and four poses determine it.
    dyads, rows, _ = case(6, second, 8)
    batch, at, found = ours(dyads, rows[:count])
    told = uncertainties(found, batch, at)[0]
    for each in told[:sides]:
        assert each.half_width > 100
        assert each.line is None or each.line.angle <= np.pi
    for each in told[sides:]:
        assert each.half_width < 1


def test_what_exact_poses_do_not_determine_is_unknown_all_the_same():
    # Errors as small as rounding, but nothing to divide them by.
    dyads, rows, _ = case(6)
    sigma = pose_sigma(Task(Displacement.from_poses(rows[:3])))
    batch, at, found = ours(dyads, rows[:3], sigma=sigma)
    assert min(each.half_width for each in uncertainties(found, batch, at)[0]) > 100
    batch, at, found = ours([dyads[0], dyads[0]], rows, sigma=sigma)
    one, other = uncertainties(found, batch, at)[0]
    assert one.half_width < 1e-9
    assert other.half_width > 100


def test_a_parallelogram_is_open_along_its_family():
    # All its poses have one angle: any two pivots with the same link serve.  The link is certain.
    dyads = [RR([0, 0], [1, 0], 1.3), RR([2, 0], [3, 0], 1.3)]
    turn = np.linspace(0.2, 2.5, 12)
    rows = np.column_stack([1.3 * np.cos(turn) - 1, 1.3 * np.sin(turn), 0 * turn])
    batch, at, found = ours(dyads, rows)
    for each in uncertainties(found, batch, at)[0]:
        assert each.fixed.half_width > 100
        assert each.moving.half_width > 100
        assert each.length < 1e-4


def test_one_dyad_twice_is_one_constraint():
    dyads, rows, _ = case(7)
    batch, at, found = ours([dyads[0], dyads[0]], rows)
    one, other = uncertainties(found, batch, at)[0]
    assert one.half_width < 1e-3
    assert other.half_width > 100


def test_a_pose_that_is_not_reached_says_nothing():
    dyads, rows, _ = case(8)
    _, _, found = ours(dyads, np.vstack([rows, np.full(3, np.nan)]))
    _, _, told = ours(dyads, rows)
    assert np.allclose(found, told, rtol=1e-12, atol=0)


def test_exact_poses_are_known_to_rounding():
    dyads, rows, _ = case(9)
    task = Task(Displacement.from_poses(rows))
    sigma = pose_sigma(task)
    assert 1e-16 < sigma[0] < 1e-14 * np.abs(rows).max()
    batch, at, found = ours(dyads, rows, sigma=sigma)
    assert max(each.half_width for each in uncertainties(found, batch, at)[0]) < 1e-11


def test_the_deviation_of_poses_is_that_of_rounding():
    values = np.random.default_rng(0).uniform(-3, 3, size=20000)
    off = np.std(np.round(values, 2) - values)
    rows = np.arange(9.0).reshape(3, 3)
    task = Task(Displacement.from_poses(rows), resolution=(0.005, 0.0005))
    position, angle = pose_sigma(task)
    assert abs(position / off - 1) < 0.02
    assert np.isclose(angle, position / 10)


def test_printed_regions_hold_the_truth_and_others_need_not():
    """A sample of `python -m benchmarks.coverage --fit refine --stretch 0.3`."""
    counts, others, missing, _ = campaign.counted(12, 3, 1, stretch=0.3)
    printed = counts["fixed pivot"] + counts["moving pivot"]
    assert missing <= 1
    assert len(printed) + len(others) >= 44
    assert len(others) > 10
    assert np.mean(printed) > 0.8
    assert np.mean(counts["link length"]) > 0.8
