"""Rounded linkages, against linkages driven joint by joint, and against all ways to round.

Only `simulated` says how near a rounded linkage comes to the poses: it drives
`tests/oracles/witness.py`'s linkages, and knows no derivative of ours.  More: `python -m
tests.refinement.test_rounding 100 0`.
"""

import sys
from dataclasses import replace
from decimal import Decimal
from itertools import product

import numpy as np
import pytest
from scipy.optimize import least_squares, minimize_scalar

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import on_circuits
from burmester.fourbar.pose_error import error_frames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Polygon
from burmester.refinement.dimension_grid import multiple
from burmester.refinement.kept_limits import DyadLimitsConstraint
from burmester.refinement.rounding import rounded
from burmester.refinement.target import Target
from burmester.tasks.limits import Limits
from burmester.tasks.requirements import Requirements
from tests.oracles.witness import places, random_four_bar, random_poses

LENGTH = 0.7
KINDS = (RR, PR, RP)
EACH = pytest.mark.parametrize("second", KINDS)
LINES = {1: 0, 2: 2}  # where the normal angle is, by the kind's number


def aim_at(rows, length=LENGTH, **how):
    poses = Displacement.from_poses(rows)
    frames = error_frames(poses, length)
    unit = length / float(frames.length)
    return poses, Target(frames.to_canonical(poses), unit, frames, Requirements(), **how)


def problem(seed, second, *, count=8, off=0.02, unit=1.0, shift=0.0):
    """Poses near a random linkage, what is aimed at, and the linkage fitted to them."""
    rng = np.random.default_rng(seed)
    while True:
        dyads = random_four_bar(rng, second)
        rows = random_poses(dyads, rng, count) + off * rng.normal(size=(count, 3))
        rows[:, :2] = unit * rows[:, :2] + shift
        poses, aim = aim_at(rows, LENGTH * unit)
        scaled = LinkageBatch.of([Linkage(*dyads)])
        moved = type(aim.frames)(np.full(2, shift), np.zeros(2), np.asarray(unit))
        batch = scaled.from_canonical(moved).to_canonical(aim.frames)
        found = rows_of(on_circuits(batch, aim.poses, aim.length), aim.length)
        found = found[:, np.nan_to_num(aim.cost(found), nan=np.inf)[0].argmin()]
        refined = aim.refine(batch, found)
        # What is fitted must not have lost its way, nor be a linkage of giants.
        if refined.settled[0] and np.abs(refined.batch.dimensions[0]).max() < 10:
            return poses, aim, refined.batch, refined.rows


def greatest(aim, rows):
    """The greatest distance in the task's unit, as the rows tell it."""
    gap = rows - rows_of(aim.poses, aim.length)
    return float(np.linalg.norm(gap, axis=-1).max() * aim.frames.length)


def simulated(linkage, poses, length):
    """The distance (N,) of each pose from the nearest place, either dyad driving."""
    best = np.full(poses.shape[0], np.inf)
    for first, second in ((linkage.first, linkage.second), (linkage.second, linkage.first)):
        if isinstance(first, RR):
            sweep = np.linspace(-np.pi, np.pi, 1441)
        else:
            sweep = 40 * length * np.linspace(-1, 1, 4001) ** 3
        for side in (0, 1):

            def far(t, k, first=first, second=second, side=side):
                where, phi = places(first, second, np.atleast_1d(t))
                d = complex(*poses.translation[k])
                turn = np.angle(np.exp(1j * (phi[side] - poses.angle[k])))
                return np.nan_to_num(abs(where[side] - d) ** 2 + (length * turn) ** 2, nan=1e99)

            for k in range(len(best)):
                gap = far(sweep, k)
                for at in np.argsort(gap)[:2]:
                    bounds = sweep[max(at - 1, 0)], sweep[min(at + 1, len(sweep) - 1)]
                    end = minimize_scalar(
                        lambda t, k=k, far=far: far(t, k)[0],
                        bounds=bounds,
                        method="bounded",
                        options={"xatol": 1e-10},
                    )
                    best[k] = min(best[k], np.sqrt(min(end.fun, gap[at])))
    return best


def turn_of(aim, step):
    """The decimal part of a degree: turning by half of it moves what is 1 away by step / 2."""
    size = float(aim.frames.length)
    turn = 10.0
    while np.radians(turn) * size > step:
        turn /= 10
    return turn


def places_in(batch, aim, step):
    """The unit of each of the ten dimensions of one linkage, 0 of those not in use."""
    out = np.full((2, 5), float(step))
    for side, kind in enumerate(batch.kinds[0]):
        if kind:
            out[side, 4] = 0.0
            out[side, LINES[kind]] = np.radians(turn_of(aim, step))
    return out


def all_at_once(batch, aim, step):
    """The linkage rounded naively."""
    unit = places_in(batch, aim, step)
    own = batch.from_canonical(aim.frames).dimensions[0]
    new = np.where(unit > 0, np.rint(own / np.where(unit > 0, unit, 1)) * unit, 0.0)
    return LinkageBatch(batch.kinds, new[None]).linkage(0)


def test_multiples_are_the_nearest_doubles():
    rng = np.random.default_rng(0)
    for step in (0.1, 0.05, 2.54, 1e-3, 0.3, 7.0, 25.4, 1e-25, 1 / 3):
        count = np.concatenate([rng.integers(-1000, 1000, 50), [10**9, 3 * 10**16 + 4]])
        told = [float(Decimal(repr(step)) * int(n)) for n in count]
        assert multiple(count.astype(float), step).tolist() == told
    assert repr(float(multiple(np.array(13.0), 0.1))) == "1.3"


@EACH
@pytest.mark.parametrize(("unit", "shift"), [(1.0, 0.0), (37.0, 5321.7)])
def test_numbers_are_multiples_to_the_last_digit(second, unit, shift):
    step = 0.1 * unit if unit == 1 else 0.5
    for seed in range(2):
        _, aim, batch, rows = problem(seed, second, unit=unit, shift=shift)
        own, _ = rounded(batch, rows, aim, step=step)
        turn = turn_of(aim, step)
        for kind, row in zip(own.kinds[0], own.dimensions[0], strict=True):
            line = LINES.get(int(kind))
            for j, value in enumerate(row):
                if j == line:
                    digits = round(-np.log10(turn))
                    assert value == np.radians(round(np.degrees(value), digits))
                else:
                    assert Decimal(repr(float(value))) % Decimal(repr(step)) == 0
        assert (own.dimensions[0, :, 4] > 0).tolist() == (own.kinds[0] == 0).tolist()


@EACH
def test_the_error_is_that_of_the_rounded_linkage_driven_again(second):
    for seed in range(3):
        poses, aim, batch, rows = problem(seed, second, count=6)
        own, rows = rounded(batch, rows, aim, step=0.05)
        told = np.linalg.norm(rows[0] - rows_of(aim.poses, aim.length), axis=-1)
        told = told * float(aim.frames.length)
        again = simulated(own.linkage(0), poses, LENGTH)
        assert np.abs(told - again).max() < 1e-9


def compared(seed, second, step, **how):
    """The greatest distance rounded here and all at once, by another simulation, and before."""
    poses, aim, batch, rows = problem(seed, second, **how)
    _, new = rounded(batch, rows, aim, step=step)
    naive = simulated(all_at_once(batch, aim, step), poses, LENGTH).max()
    return greatest(aim, new), naive, greatest(aim, rows)


@EACH
def test_it_is_never_worse_than_rounding_all_at_once(second):
    ratios = []
    for seed in range(5):
        new, naive, _ = compared(seed, second, 0.1)
        assert new <= naive * (1 + 1e-6)
        ratios.append(new / naive)
    assert np.median(ratios) < 0.6


def by_brute_force(poses, batch, aim, rows, step):
    """The least greatest distance of all floors and ceilings, crank driven by small steps."""
    unit = places_in(batch, aim, step).ravel()
    own = batch.from_canonical(aim.frames).dimensions.reshape(10)
    some = unit > 0
    at = Displacement.from_poses(np.c_[rows[0, :, :2], rows[0, :, 2] / aim.length])
    at = aim.frames.from_canonical(at)
    low = np.floor(own[some] / unit[some])
    d = poses.translation @ [1, 1j]
    best = np.inf
    for up in product((0, 1), repeat=int(some.sum())):
        z = np.zeros(10)
        z[some] = (low + up) * unit[some]
        linkage = LinkageBatch(batch.kinds, z.reshape(1, 2, 5)).linkage(0)
        arm = at.act(linkage.first.moving_pivot) - linkage.first.fixed_pivot
        drive = np.arctan2(arm[:, 1], arm[:, 0])[:, None] + np.linspace(-0.5, 0.5, 201)
        where, phi = places(linkage.first, linkage.second, drive)
        turn = np.angle(np.exp(1j * (phi - poses.angle[:, None])))
        gap = np.hypot(abs(where - d[:, None]), LENGTH * turn)
        best = min(best, np.nan_to_num(gap, nan=np.inf).min(axis=(0, 2)).max())
    return best


@EACH
def test_it_is_as_good_as_the_best_of_all_floors_and_ceilings(second):
    for seed, step in ((1, 0.02), (2, 0.1)):
        poses, aim, batch, rows = problem(seed, second, count=5)
        _, new = rounded(batch, rows, aim, step=step)
        assert greatest(aim, new) <= by_brute_force(poses, batch, aim, rows, step) * 1.001


def stock_fit(kinds, own, lengths, poses):
    """With links of given lengths all else fitted by SciPy: the greatest distance."""
    used = [j for j in range(10) if j % 5 != 4]
    z = LinkageBatch.of([own]).dimensions.reshape(10)
    links = np.array(lengths)
    turn = np.exp(1j * poses.angle)
    d = poses.translation @ [1, 1j]
    pin = d + (z[2] + 1j * z[3]) * turn
    drive = np.angle(pin - (z[0] + 1j * z[1]))
    best = np.inf
    for side in (0, 1):

        def gaps(x, side=side):
            full = np.zeros(10)
            full[used], full[4::5] = x[:8], links
            dyads = LinkageBatch(kinds, full.reshape(1, 2, 5)).linkage(0)
            where, phi = places(dyads.first, dyads.second, x[8:])
            gap = where[side] - d
            angle = LENGTH * np.angle(np.exp(1j * (phi[side] - poses.angle)))
            return np.nan_to_num(np.concatenate([gap.real, gap.imag, angle]), nan=10.0)

        fit = least_squares(gaps, np.concatenate([z[used], drive]), xtol=1e-13, ftol=1e-13)
        count = len(d)
        gap = fit.fun.reshape(3, count)
        best = min(best, np.linalg.norm(gap, axis=0).max())
    return best


@pytest.mark.parametrize("step", [None, 0.05])
def test_links_come_from_stock(step):
    stock = (0.5, 0.75, 1.1, 1.6, 2.5)
    for seed in range(3):
        poses, aim, batch, rows = problem(seed, RR)
        own, new = rounded(batch, rows, aim, step=step, stock=stock)
        links = own.dimensions[0, :, 4]
        assert set(links) <= set(stock)
        again = simulated(own.linkage(0), poses, LENGTH)
        assert abs(again.max() - greatest(aim, new)) < 1e-9
        pivots = own.dimensions[0, :, :4]
        digits = {Decimal(repr(float(x))) % Decimal("0.05") == 0 for x in pivots.ravel()}
        assert digits == {step is not None}


def test_of_stock_the_choice_is_the_best_of_four():
    stock = np.array([0.5, 0.75, 1.1, 1.6, 2.5])
    for seed in range(2):
        poses, aim, batch, rows = problem(seed, RR)
        before = batch.from_canonical(aim.frames)
        own, new = rounded(batch, rows, aim, step=None, stock=list(stock))
        sides = []
        for r in before.dimensions[0, :, 4]:
            at = np.searchsorted(stock, r)
            sides.append({stock[max(at - 1, 0)], stock[min(at, 4)]})
        told = {
            choice: stock_fit(batch.kinds, before.linkage(0), choice, poses)
            for choice in product(*sides)
        }
        assert tuple(own.dimensions[0, :, 4]) == min(told, key=told.__getitem__)
        # The reference keeps no order; ours may stop where the poses fill a whole turn.
        assert greatest(aim, new) <= min(told.values()) * 1.05


@EACH
def test_a_step_far_too_coarse_gives_a_great_error_or_no_place(second):
    for seed, step in ((0, 3.0), (1, 3.0), (0, 40.0)):
        poses, aim, batch, rows = problem(seed, second)
        own, new = rounded(batch, rows, aim, step=step)
        lengths = own.dimensions[0].copy()
        for side, kind in enumerate(own.kinds[0]):
            if kind:
                lengths[side, LINES[kind]] = 0.0
        assert not np.remainder(lengths, step).any()
        assert (lengths[own.kinds[0] == 0, 4] > 0).all()
        again = simulated(own.linkage(0), poses, LENGTH)
        assert again.max() > 0.1
        if np.isfinite(new).all():
            assert greatest(aim, new) >= again.max() - 1e-9
            at = aim.frames.from_canonical(Displacement(new[0, :, :2], new[0, :, 2] / aim.length))
            for dyad in (own.linkage(0).first, own.linkage(0).second):
                assert np.abs(dyad.residual(at)).max() < 1e-9 * step


def test_pivots_stay_in_their_regions():
    left = 0
    for seed in range(6):
        _, aim, batch, rows = problem(seed, RR)
        c = batch.from_canonical(aim.frames).dimensions[0, 0, :2]
        # The region ends just beyond the pivot, on the side to which it would be rounded.
        ends = np.where(np.rint(c / 0.1) * 0.1 > c, c + 1e-4, c + 1.0)
        x, y = np.stack([ends - 1.5, ends], axis=1)
        box = Polygon([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])])
        aim = replace(aim, kept=(DyadLimitsConstraint(0, Limits(fixed_pivot=box), aim.frames),))
        own, _ = rounded(batch, rows, aim, step=0.1)
        new, naive = own.dimensions[0, 0, :2], np.rint(c / 0.1) * 0.1
        left += bool((naive > ends + 1e-9).any())
        assert (new <= ends + 1e-9).all()
        assert (new >= ends - 1.5 - 1e-9).all()
    assert left >= 3


@pytest.mark.parametrize("seed", [2, 5])
def test_a_pivot_beside_its_line_is_no_excuse_to_pass_another_limit(seed):
    """No multiple lies on the line: it runs half way between two.  The link may be no longer.

    A pivot half a step off its line is as near as can be, so it breaks nothing, and the length
    that does break its limit is not taken, be it nearer to the poses.
    """
    _, aim, batch, rows = problem(seed, RR)
    own = batch.from_canonical(aim.frames).dimensions[0, 0]
    height, length = own[1], own[4]
    halves = abs(height) / (np.arange(1, 400) + 0.5)
    steps = [step for step in halves if 0.05 < step < 0.15 and 0.55 < (length / step) % 1 < 0.85]
    step = min(steps, key=lambda step: abs(step - 0.1))
    assert np.rint(length / step) * step > length + 0.1 * step  # the nearest multiple is too long
    limits = Limits(fixed_pivot=Line((0, height), (1, height)), length=(0.0, length + 1e-4))
    aim = replace(aim, kept=(DyadLimitsConstraint(0, limits, aim.frames),))
    new, _ = rounded(batch, rows, aim, step=step)
    at, radius = new.dimensions[0, 0, :2], new.dimensions[0, 0, 4]
    assert abs(at[1] - height) == pytest.approx(step / 2)
    assert radius < length


def test_poses_stay_in_order():
    """Poses near each other in the crank's turn; rounding alone confuses them."""
    confused = 0
    for seed in range(4):
        rng = np.random.default_rng(seed)
        first = RR([0.0, 0.0], [0.1, 0.2], 0.4)
        second = RR([1.3, 0.2], [1.2, 0.1], 0.9)
        drive = rng.uniform(0, 6) + np.linspace(0, 0.5, 6)
        where, phi = places(first, second, drive)
        rows = np.c_[where[0].real, where[0].imag, phi[0]] + 0.1 * rng.normal(size=(6, 3))

        def steps(own, rows, frames, length):
            at = frames.from_canonical(Displacement(rows[0, :, :2], rows[0, :, 2] / length))
            dyad = own.linkage(0).first
            arm = at.act(dyad.moving_pivot) - dyad.fixed_pivot
            return np.unwrap(np.arctan2(arm[:, 1], arm[:, 0]))

        linkage = LinkageBatch.of([Linkage(first, second)])
        for _ in range(2):  # the poses, put in the order in which they are met
            _, aim = aim_at(rows)
            batch = linkage.to_canonical(aim.frames)
            found = rows_of(on_circuits(batch, aim.poses, aim.length), aim.length)
            found = found[:, np.nan_to_num(aim.cost(found), nan=np.inf)[0].argmin()]
            here = steps(linkage, found, aim.frames, aim.length)
            rows = rows[np.argsort(here)]
        if (np.diff(here) < 4e-3).any():
            continue
        kept = steps(*rounded(batch, found, aim, step=0.2), aim.frames, aim.length)
        assert (np.diff(kept) > 0).all()
        free = replace(aim, requirements=Requirements(any_order=True))
        loose = steps(*rounded(batch, found, free, step=0.2), aim.frames, aim.length)
        confused += bool((np.diff(loose) <= 0).any())
    assert confused


def test_exact_poses_and_weights_count_more():
    plain, exact, heavy = [], [], []
    for seed in range(5):
        _, aim, batch, rows = problem(seed, RR, off=0.05)

        def first(aim, batch=batch, rows=rows):
            _, new = rounded(batch, rows, aim, step=0.1)
            return np.linalg.norm((new - rows_of(aim.poses, aim.length))[0, 0])

        plain.append(first(aim))
        exact.append(first(replace(aim, exact=np.arange(8) == 0)))
        heavy.append(first(replace(aim, weights=np.where(np.arange(8) == 0, 25.0, 1.0))))
    assert np.mean(exact) < 0.3 * np.mean(plain)
    assert np.mean(heavy) < 0.6 * np.mean(plain)


def test_linkages_together_are_as_one_by_one():
    _, aim, one, rows = problem(3, RR)
    many = [one]
    for second in (PR, RP):
        dyad = PR(0.3, 0.4, [0.2, 0.9]) if second is PR else RP([0.3, 0.2], 0.4, 0.5)
        many.append(LinkageBatch.of([Linkage(one.linkage(0).first, dyad)]))
    kinds = np.concatenate([each.kinds for each in many])
    batch = LinkageBatch(kinds, np.concatenate([each.dimensions for each in many]))
    found = rows_of(on_circuits(batch, aim.poses, aim.length), aim.length)[:, 0]
    found[0] = rows[0]
    own, new = rounded(batch, found, aim, step=0.1)
    for k in range(3):
        single, its = rounded(batch[k : k + 1], found[k : k + 1], aim, step=0.1)
        assert np.array_equal(single.dimensions[0], own.dimensions[k])
        assert np.array_equal(its[0], new[k], equal_nan=True)


if __name__ == "__main__":
    number, first = int(sys.argv[1]), int(sys.argv[2])
    for step, off in ((0.1, 0.02), (0.01, 0.0), (0.01, 0.02), (0.5, 0.02)):
        table = np.array(
            [
                compared(seed, KINDS[seed % 3], step, off=off)
                for seed in range(first, first + number)
            ]
        )
        share = table[:, 0] / table[:, 1]
        print("worse:", first + np.flatnonzero(share > 1 + 1e-6))
        print(
            f"step {step}, poses off by {off}: of the naive distance "
            f"{np.quantile(share, [0.1, 0.5, 0.9]).round(2)}, worse in {(share > 1 + 1e-6).sum()} "
            f"of {number}; median distances before, here, naive: "
            f"{np.median(table[:, [2, 0, 1]], axis=0).round(4)}"
        )
