"""Linkages refined as a whole, against SciPy on unknowns of its own: dimensions and drives.

`python -m tests.refinement.test_least_error 200 0` tells how many noisy tasks settle, and how well
the greatest distance is levelled.
"""

import sys

import numpy as np
import pytest
from scipy.optimize import least_squares, minimize

from burmester import synthesize
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import nearest, on_circuits
from burmester.fourbar.pose_error import error_frames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Segment
from burmester.io.reading.poses import read_task
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.kept_limits import DyadLimitsConstraint
from burmester.refinement.least_error import refine
from burmester.tasks.limits import Limits
from tests.oracles.witness import places

PAIRS = {"4R": (RR, RR), "slider-crank": (RR, PR), "RR-RP": (RR, RP), "PR-RP": (PR, RP)}
STEPS = 300  # at most: enough for nearly all
SIZES = {RR: 5, PR: 4, RP: 4}


# The independent formulation ------------------------------------------------------------------


def row_of(dyad):
    if isinstance(dyad, RR):
        return [*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius]
    if isinstance(dyad, PR):
        return [dyad.normal_angle, dyad.offset, *dyad.moving_pivot]
    return [*dyad.fixed_pivot, dyad.normal_angle, dyad.offset]


def dyad_of(kind, row):
    if kind is RR:
        return RR(row[:2], row[2:4], row[4])
    return PR(row[0], row[1], row[2:4]) if kind is PR else RP(row[:2], row[2], row[3])


def drives(first, rows):
    """Where `places` has to be driven to, to come to places (n, 3)."""
    d, turn = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    if isinstance(first, RR):
        pin = d + (first.moving_pivot @ [1, 1j]) * turn - first.fixed_pivot @ [1, 1j]
        return np.angle(pin)
    if isinstance(first, PR):
        on = d + (first.moving_pivot @ [1, 1j]) * turn
    else:
        on = (first.fixed_pivot @ [1, 1j] - d) / turn
    return (on * np.exp(-1j * first.normal_angle)).imag


class Witness:
    """Gaps (N, 3) as a function of all dimensions and one drive for each pose."""

    def __init__(self, linkage, rows, wanted, length):
        self.kinds = type(linkage.first), type(linkage.second)
        self.wanted, self.length = wanted, length
        start = drives(linkage.first, rows)
        near = places(linkage.first, linkage.second, start)[0]
        self.sides = np.abs(near - rows[:, :2] @ [1, 1j]).argmin(axis=0)
        self.start = np.concatenate([row_of(linkage.first), row_of(linkage.second), start])
        self.dimensions = len(self.start) - len(rows)

    def gaps(self, v):
        cut = SIZES[self.kinds[0]]
        first = dyad_of(self.kinds[0], v[:cut])
        second = dyad_of(self.kinds[1], v[cut : self.dimensions])
        where, phi = places(first, second, v[self.dimensions :])
        pick = self.sides, np.arange(len(self.wanted))
        turn = np.angle(np.exp(1j * (phi[pick] - self.wanted[:, 2])))
        gap = where[pick] - self.wanted[:, :2] @ [1, 1j]
        out = np.column_stack([gap.real, gap.imag, self.length * turn])
        return np.where(np.isfinite(out), out, 10.0)

    def least(self, share=None, loose=None):
        """Half the least sum of squares, all or some dimensions being free."""
        share = np.ones(len(self.wanted)) if share is None else share
        free = np.ones(len(self.start), bool)
        if loose is not None:
            free[: self.dimensions] = loose

        def residual(x):
            v = self.start.copy()
            v[free] = x
            return (np.sqrt(share)[:, None] * self.gaps(v)).ravel()

        end = least_squares(
            residual,
            self.start[free],
            x_scale="jac",
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
            max_nfev=2000,
        )
        return end.cost


def a_linkage(kinds, rng):
    """A random linkage and drives at which it is closed, away from dead points."""
    while True:
        dyads = []
        for kind in kinds:
            c, m, normal = rng.normal(size=2), rng.normal(size=2), rng.uniform(-np.pi, np.pi)
            dyads.append(
                RR(c, m, rng.uniform(0.5, 2))
                if kind is RR
                else PR(normal, rng.normal(), m)
                if kind is PR
                else RP(c, normal, rng.normal())
            )
        drive = rng.uniform(-1, 1) + np.linspace(0, 2.5, 12)
        where, phi = (
            part[0] for part in places(*dyads, np.linspace(drive[0] - 0.2, drive[-1] + 0.2, 60))
        )
        if not np.isfinite(phi).all() or np.abs(np.diff(np.unwrap(phi))).max() > 0.15:
            continue
        where, phi = (part[0] for part in places(*dyads, drive))
        if np.ptp(where.real) + np.ptp(where.imag) < 0.5 or np.ptp(phi) < 0.3:
            continue
        return Linkage(*dyads), np.column_stack([where.real, where.imag, np.unwrap(phi)])


def a_task(kinds, seed, noise=0.02):
    rng = np.random.default_rng(seed)
    linkage, rows = a_linkage(kinds, rng)
    return linkage, rows, rows + noise * rng.normal(size=rows.shape)


def as_places(rows, length=1.0):
    return Displacement(rows[..., :2], rows[..., 2] / length)


def refined(linkage, rows, wanted, length=1.0, **how):
    """Refined from where it is; rows and wanted with plain angles."""
    own = as_places(rows)
    start = Displacement(own.translation[None], own.angle[None])
    how = {"steps": STEPS, "constrained_steps": STEPS} | how
    return refine(LinkageBatch.of([linkage]), start, as_places(wanted), length, **how)


# Tests ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("length", [1.0, 0.4])
def test_least_squares_as_scipy_has_them(pair, length):
    done = 0
    for seed in range(4):
        linkage, rows, wanted = a_task(PAIRS[pair], seed)
        ours = refined(linkage, rows, wanted, length)
        witness = Witness(linkage, rows, wanted, length)
        theirs = witness.least()
        assert ours.cost[0] < theirs * 1.01
        done += bool(np.isclose(ours.cost[0], theirs, rtol=1e-6))
        # The cost is that of the linkage as it came out, driven by the witness.
        out = ours.batch.linkage(0)
        plain = ours.rows[0] / [1, 1, length]
        again = Witness(out, plain, wanted, length)
        assert np.isclose((again.gaps(again.start) ** 2).sum() / 2, ours.cost[0], rtol=1e-6)
        if ours.settled[0]:  # and no way leads down from there
            slope = []
            for j in range(len(again.start)):
                nudge = 1e-6 * np.eye(len(again.start))[j]
                up, down = ((again.gaps(again.start + s * nudge) ** 2).sum() / 2 for s in (1, -1))
                slope.append((up - down) / 2e-6)
            assert np.abs(slope).max() < 1e-5
    assert done >= 3


def test_weights_count_as_repeated_poses():
    linkage, rows, wanted = a_task((RR, RR), 1)
    weights = np.array([1.0, 3, 1, 1, 2, 1, 1, 1, 1, 1, 1, 2])
    ours = refined(linkage, rows, wanted, weights=weights)
    theirs = Witness(linkage, rows, wanted, 1.0).least(weights / weights.mean())
    assert np.isclose(ours.cost[0], theirs, rtol=1e-6)
    twice = np.repeat(np.arange(12), weights.astype(int))
    often = refined(linkage, rows[twice], wanted[twice])
    assert np.allclose(often.batch.dimensions, ours.batch.dimensions, atol=1e-6)
    plain = refined(linkage, rows, wanted)
    assert not np.allclose(plain.batch.dimensions, ours.batch.dimensions, atol=1e-3)


@pytest.mark.parametrize("pair", PAIRS)
def test_exact_poses_are_met_and_the_rest_as_near_as_scipy_comes(pair):
    linkage, rows, wanted = a_task(PAIRS[pair], 3)
    exact = np.zeros(12, bool)
    exact[[0, 7]] = True
    ours = refined(linkage, rows, wanted, exact=exact)
    assert ours.met[0]
    assert np.abs(ours.rows[0] - wanted)[exact].max() < 1e-10
    out = ours.batch.linkage(0)
    for dyad in (out.first, out.second):
        assert np.abs(dyad.residual(as_places(wanted[exact]))).max() < 1e-10
    witness = Witness(linkage, rows, wanted, 1.0)
    end = minimize(
        lambda v: (witness.gaps(v)[~exact] ** 2).sum() / 2,
        witness.start,
        method="SLSQP",
        constraints={"type": "eq", "fun": lambda v: witness.gaps(v)[exact].ravel()},
        options={"maxiter": 500, "ftol": 1e-14},
    )
    assert ours.cost[0] < end.fun * (1 + 1e-3)


def test_dimensions_that_are_not_free_stay():
    linkage, rows, wanted = a_task((RR, PR), 2)
    free = np.ones((1, 10), bool)
    free[0, [0, 3, 5]] = False
    ours = refined(linkage, rows, wanted, free=free)
    before = LinkageBatch.of([linkage]).dimensions.reshape(10)
    after = ours.batch.dimensions.reshape(10)
    assert (before[[0, 3, 5]] == after[[0, 3, 5]]).all()
    theirs = Witness(linkage, rows, wanted, 1.0).least(loose=free[0, :9])
    assert np.isclose(ours.cost[0], theirs, rtol=1e-6)
    assert ours.cost[0] > refined(linkage, rows, wanted).cost[0] * 1.001


def test_what_is_found_does_not_depend_on_the_others_beside_it():
    linkage, rows, wanted = a_task((RR, RR), 0)
    linkages, starts = [linkage], [rows]
    lost = np.full_like(rows, np.nan)
    for seed in range(1, 4):  # of other tasks; their places are far off
        other, own, _ = a_task(list(PAIRS.values())[seed], seed)
        linkages.append(other)
        starts.append(own)
    both = refine(
        LinkageBatch.of([*linkages, linkage]),
        as_places(np.array([*starts, lost])),
        as_places(wanted),
        1.0,
        steps=STEPS,
    )
    one = refined(linkage, rows, wanted)
    assert np.allclose(one.batch.dimensions[0], both.batch.dimensions[0], atol=1e-9)
    assert np.isnan(both.cost[-1])
    assert not both.settled[-1]
    alone = refine(  # nothing is left at all
        LinkageBatch.of([linkage]), as_places(lost[None]), as_places(wanted), 1.0
    )
    assert np.isnan(alone.cost[0])
    assert not alone.met[0]


def test_a_selection_gives_up_what_is_farther_or_the_same_and_changes_nothing_else():
    linkage, rows, wanted = a_task((RR, RR), 0)
    far, own = [], []
    for seed in (1, 2):  # of other tasks, from the places nearest to these poses
        other, _, _ = a_task((RR, RR), seed)
        far.append(other)
        own.append(rows)
    batch, places = (
        LinkageBatch.of([*far, linkage, linkage]),
        as_places(np.array([*own, rows, rows])),
    )
    exact = np.arange(len(wanted)) == 0
    how = {"exact": exact, "constrained_steps": STEPS}
    every = refine(batch, places, as_places(wanted), 1.0, **how)
    some = refine(batch, places, as_places(wanted), 1.0, selection=((3, 1),), **how)
    assert some.met.sum() == 1
    best = int(np.flatnonzero(some.met)[0])
    assert best == np.where(every.met, every.cost, np.inf).argmin()
    assert np.isclose(some.cost[best], every.cost[best], rtol=1e-9)
    both = refine(batch[[2, 3]], places[2:], as_places(wanted), 1.0, selection=((3, 2),), **how)
    assert both.met.tolist() == [True, False]


@pytest.mark.parametrize("seed", range(3))
def test_the_greatest_distance_is_levelled(seed):
    linkage, rows, wanted = a_task((RR, RR), seed)
    squares = refined(linkage, rows, wanted)
    ours = refined(linkage, rows, wanted, worst=True)
    gap = np.linalg.norm(ours.rows[0] - wanted, axis=1)
    assert np.isclose(gap.max(), ours.cost[0], rtol=1e-9)
    assert ours.cost[0] < np.linalg.norm(squares.rows[0] - wanted, axis=1).max()
    assert ours.cost[0] < 1.01 * minimax(ours.batch.linkage(0), ours.rows[0], wanted)


def minimax(linkage, rows, wanted, length=1.0):
    """SciPy's least greatest distance, from there."""
    witness = Witness(linkage, rows / [1, 1, length], wanted, length)
    top = np.linalg.norm(witness.gaps(witness.start), axis=1).max()
    end = minimize(
        lambda v: v[-1],
        np.append(witness.start, top),
        method="SLSQP",
        constraints={
            "type": "ineq",
            "fun": lambda v: (v[-1] ** 2 - (witness.gaps(v[:-1]) ** 2).sum(axis=1)) / top,
        },
        options={"maxiter": 500, "ftol": 1e-14},
    )
    return min(top, np.linalg.norm(witness.gaps(end.x[:-1]), axis=1).max())


C, M = np.array([0.2, -0.4]), np.array([0.5, 0.3])
BOX = Polygon([[-0.5, -0.5], [0.1, -0.5], [0.1, 0.3], [-0.5, 0.3]])
WITHIN = {
    "point": (Limits(fixed_pivot=Point((0.2, -0.4))), lambda z: [z[0] - 0.2, z[1] + 0.4], []),
    "line": (
        Limits(moving_pivot=Line((0.0, 0.1), (1.0, 0.5))),
        lambda z: [(z[2] * 0.4 - (z[3] - 0.1)) / np.hypot(1, 0.4)],
        [],
    ),
    "segment": (
        Limits(fixed_pivot=Segment((0.0, 0.0), (0.6, 0.0))),
        lambda z: [z[1]],
        lambda z: [-z[0], z[0] - 0.6],
    ),
    "polygon": (
        Limits(fixed_pivot=BOX),
        [],
        lambda z: [-0.5 - z[0], z[0] - 0.1, -0.5 - z[1], z[1] - 0.3],
    ),
    "length": (Limits(length=(0.7, 0.9)), [], lambda z: [0.7 - z[4], z[4] - 0.9]),
}


@pytest.mark.parametrize("what", WITHIN)
@pytest.mark.parametrize("seed", [0, 2])
def test_limits_hold_and_scipy_comes_no_lower(what, seed):
    limits, zero, below = WITHIN[what]
    linkage, rows, wanted = a_task((RR, RR), seed)
    frames = CanonicalFrames.identity()
    ours = refined(linkage, rows, wanted, constraints=DyadLimitsConstraint(0, limits, frames))
    assert ours.met[0]
    z = ours.batch.dimensions[0, 0]
    if zero:
        assert np.abs(zero(z)).max() < 1e-9
    if below:
        assert np.max(below(z)) < 1e-9
    witness = Witness(ours.batch.linkage(0), ours.rows[0], wanted, 1.0)
    kept = []
    if zero:
        kept.append({"type": "eq", "fun": lambda v: np.array(zero(v[:5]))})
    if below:
        kept.append({"type": "ineq", "fun": lambda v: -np.array(below(v[:5]))})
    end = minimize(
        lambda v: (witness.gaps(v) ** 2).sum() / 2,
        witness.start,
        method="SLSQP",
        constraints=kept,
        options={"maxiter": 300, "ftol": 1e-14},
    )
    sound = all(
        (np.abs(each["fun"](end.x)).max() if each["type"] == "eq" else -each["fun"](end.x).min())
        < 1e-8
        for each in kept
    )
    assert not sound or ours.cost[0] < end.fun * 1.03 + 1e-12
    assert ours.cost[0] > refined(linkage, rows, wanted).cost[0] * (1 - 1e-9)


@pytest.mark.parametrize("steps", [2, 5, 30])
def test_what_keeps_to_its_limits_at_the_start_does_so_at_the_end_and_is_no_farther(steps):
    """A star around the pivots, whose corners point inwards and outwards, holds many a descent."""
    turn = np.arange(10) * np.pi / 5
    arms = np.where(np.arange(10) % 2, 0.02, 0.2)
    star = np.column_stack([arms * np.cos(turn), arms * np.sin(turn)])
    for seed in range(12):
        linkage, rows, wanted = a_task((RR, RR), seed, noise=0.1)
        keep = AllConstraints(
            tuple(
                DyadLimitsConstraint(
                    side,
                    Limits(
                        fixed_pivot=Polygon(star + dyad.fixed_pivot + [0.015, 0]),
                        moving_pivot=Polygon(star + dyad.moving_pivot - [0, 0.015]),
                    ),
                    CanonicalFrames.identity(),
                )
                for side, dyad in enumerate((linkage.first, linkage.second))
            )
        )
        end = refined(linkage, rows, wanted, constraints=keep, constrained_steps=steps)
        assert end.met[0]
        assert end.cost[0] <= ((rows - wanted) ** 2).sum() / 2 * (1 + 1e-12)


def test_the_papers_ten_poses():
    """Table 5, with a radian as a length of 1: printed 0.216 and 0.114."""
    usable = synthesize(read_task("case:ge2012-approximate"), length_per_radian=1.0).usable
    best = min(usable, key=lambda found: found.combined_error)
    assert best.error.worst <= 0.0065
    assert best.error.rms <= 0.0037
    exact = synthesize(read_task("case:ge2012-exact"), length_per_radian=1.0).linkages[0]
    assert exact.error.worst <= 1e-4


def test_the_same_task_in_other_frames_and_units():
    linkage, _, wanted = a_task((RR, RR), 4)
    length = 1.0
    poses = Displacement(1000 * wanted[:, :2] + [2e4, -3e4], wanted[:, 2])
    here, there = as_places(wanted), poses
    costs = []
    moved = Linkage(
        *(
            RR(1000 * dyad.fixed_pivot + [2e4, -3e4], 1000 * dyad.moving_pivot, 1000 * dyad.radius)
            for dyad in (linkage.first, linkage.second)
        )
    )
    for each, own, unit in ((linkage, here, length), (moved, there, 1000 * length)):
        frames = error_frames(own, unit)
        batch, seen = LinkageBatch.of([each]).to_canonical(frames), frames.to_canonical(own)
        small = unit / float(frames.length)
        start = nearest(on_circuits(batch, seen, small), seen, small)
        costs.append(refine(batch, start, seen, small))
    assert np.isclose(costs[0].cost[0], costs[1].cost[0], rtol=1e-6)
    assert np.allclose(costs[0].batch.dimensions, costs[1].batch.dimensions, atol=1e-5)


def test_most_noisy_tasks_settle():
    settled, _, _ = statistics(24, 0, levelled=False)
    assert settled >= 0.9


def statistics(tasks, seed, levelled=True):
    """Shares that settled, by how much SciPy comes lower, and how far from level the worst is."""
    settled, ratio, level = [], [], []
    for number in range(seed, seed + tasks):
        kinds = list(PAIRS.values())[number % 4]
        linkage, rows, wanted = a_task(kinds, number)
        ours = refined(linkage, rows, wanted)
        settled.append(bool(ours.settled[0]))
        if levelled:
            ratio.append(ours.cost[0] / Witness(linkage, rows, wanted, 1.0).least() - 1)
            worst = refined(linkage, rows, wanted, worst=True)
            least = minimax(worst.batch.linkage(0), worst.rows[0], wanted)
            level.append(worst.cost[0] / least - 1)
    return np.mean(settled), np.array(ratio), np.array(level)


if __name__ == "__main__":
    share, more, off = statistics(*map(int, sys.argv[1:3]))
    print(f"settled {share:.3f}")
    print("cost over SciPy's, quantiles 0 to 1:", np.quantile(more, [0, 0.05, 0.5, 0.95, 1]))
    print("worst over SciPy's minimax:", np.quantile(off, [0, 0.5, 0.9, 0.95, 1]))
