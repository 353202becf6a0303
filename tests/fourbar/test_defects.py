"""Verdicts on linkages, against walks along their motions by the constraints alone.

The poses are vertices of walks (see `tracer`): which circuit they are on is which walk they are
from, a dead point is where the driven coordinate turns back, order is the order along the walk.

    python -m tests.fourbar.test_defects 5000 0

compares that many random linkages, of all pairs of dyads, with one seed.
"""

import json
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.defects import judge
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.defect_messages import PoseNames
from burmester.mechanisms.pose_order import CERTAIN_STEP_BACK, REPEATED_POSE_STEP
from burmester.mechanisms.transmission import DEAD_POINT_ANGLE
from tests.oracles.random_dyads import (
    CHANGE,
    NAMES,
    PAIRS,
    all_pairs,
    circuits_of,
    four_bar,
    random_linkages,
    rows_of,
    some_places,
)
from tests.oracles.tracer import FAR, constraint, driven, gap, met_at, walks
from tests.oracles.tracer import TOO_CLOSE as NEAR_WALK

CASES = Path(__file__).parents[2] / "src" / "burmester" / "cases"
POSES = 8


# The walk as the judge ----------------------------------------------------------------------------


def angle_of_force(first, second, rows):
    """The transmission angle at rows (n, 3), from vectors."""
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])

    def seen(point):
        return rows[:, :2] + np.column_stack(
            [cos * point[0] - sin * point[1], sin * point[0] + cos * point[1]]
        )

    def normal(dyad, turn):
        return np.column_stack([np.cos(dyad.normal_angle + turn), np.sin(dyad.normal_angle + turn)])

    if isinstance(first, RP) and isinstance(second, RP):
        a, b = normal(first, rows[:, 2]), normal(second, rows[:, 2])
    elif isinstance(second, RP):
        a, b = normal(second, rows[:, 2]), seen(first.moving_pivot) - second.fixed_pivot
    else:
        pin = seen(second.moving_pivot)
        slot = isinstance(first, RP)
        a = normal(first, rows[:, 2]) if slot else pin - seen(first.moving_pivot)
        rail = isinstance(second, PR)
        b = normal(second, 0 * rows[:, 2]) if rail else pin - second.fixed_pivot
    cross, dot = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1)
    return np.arctan2(np.abs(cross), np.abs(dot))


class Walk:
    """A circuit as the tracer walks it: rows (n, 3), once round if it is closed."""

    def __init__(self, linkage, rows, closed):
        self.rows, self.closed, self.linkage = rows, closed, linkage
        self.drives = [driven(dyad, rows) for dyad in (linkage.first, linkage.second)]
        self.turns = []
        for drive in self.drives:
            sign = np.sign(np.diff(drive))
            turns = np.flatnonzero(sign[1:] != sign[:-1]) + 1
            if closed and sign[0] != sign[-1]:
                turns = np.append(0, turns)
            assert len(turns) <= 2
            self.turns.append(turns)
        inside = np.abs(rows[:, :2]).max(axis=1) < FAR / 2
        for turns in self.turns:
            for t in turns:
                away = np.abs(np.arange(len(rows)) - t)
                inside &= (np.minimum(away, len(rows) - 1 - away) if closed else away) > 1
        if closed:
            inside[-1] = False
        self.usable = np.flatnonzero(inside)

    def piece(self, side, at):
        """The number of the piece between dead points on which vertices are."""
        turns = self.turns[side]
        number = np.searchsorted(turns, at, side="right")
        return number % len(turns) if self.closed and len(turns) else number


def walks_of(linkage, rows):
    """The walks of linkages (k,) through rows (a list of (m, 3)); None where it is not clear."""
    found = [[] for _ in rows]
    unclear = np.zeros(len(rows), bool)
    left = [np.ones(len(r), bool) for r in rows]
    for _ in range(2):
        some = [k for k in range(len(rows)) if left[k].any() and not unclear[k]]
        if not some:
            break
        start = np.array([rows[k][np.argmax(left[k])] for k in some])
        both = np.concatenate([some, some])
        sense = np.repeat([1.0, -1.0], len(some))
        ways, closed = walks(
            Linkage(linkage.first[both], linkage.second[both]), np.concatenate([start] * 2), sense
        )
        for i, k in enumerate(some):
            walk, back = ways[i], ways[i + len(some)]
            if not closed[i]:
                walk = np.concatenate([back[:0:-1], walk])
            one = Linkage(linkage.first[k], linkage.second[k])
            found[k].append(Walk(one, walk, bool(closed[i])))
            far = met_at(walk, rows[k])[0]
            unclear[k] |= ((far > 1e-3) & (far < NEAR_WALK)).any()
            left[k] &= far > NEAR_WALK
    return [
        None if u or any(not len(w.usable) for w in f) else f
        for u, f in zip(unclear, found, strict=True)
    ]


def draw(found, rng):
    """Poses on walks: numbers of walk and vertex (n, 2), or fewer than POSES with -1 between."""
    count = int(rng.integers(3, POSES + 1))
    walk, side = found[0], int(rng.integers(2))
    at = walk.usable
    where = rng.integers(3)
    if where == 1:  # on one branch
        piece = walk.piece(side, at)
        at = at[piece == rng.choice(piece)]
    elif where == 2:  # on a stretch
        begin, long = rng.integers(len(at)), max(3, int(len(at) * rng.uniform(0.05, 0.9)))
        at = np.roll(at, -begin)[:long] if walk.closed else at[begin : begin + long]
    at = at[np.sort(rng.integers(len(at), size=count))]
    way = rng.integers(5)
    if way == 1:
        at = at[::-1]
    elif way == 2:
        at = np.roll(at, rng.integers(count))
    elif way == 3:
        at = rng.permutation(at)
    elif way == 4:
        a = rng.integers(count - 1)
        at[[a, a + 1]] = at[[a + 1, a]]
    poses = np.column_stack([np.zeros(count, int), at])
    if len(found) == 2 and rng.random() < 0.4:
        others = rng.choice(count, rng.integers(1, count), replace=False)
        poses[others] = np.column_stack(
            [np.ones(len(others), int), rng.choice(found[1].usable, len(others))]
        )
    out = np.full((POSES, 2), -1)
    out[np.sort(rng.choice(POSES, count, replace=False))] = poses
    return out


def in_order(at, period=None):
    """Whether vertices are met in order, in either sense; all round if there is a period."""
    for way in (at, at[::-1]):
        step = np.diff(way)
        if period is not None and (step % period).sum() <= period:
            return True
        if (step >= 0).all():
            return True
    return False


def sequence(poses, at, all_round):
    """The poses as they are met, from the first or from the end with the lower number."""
    ways = [[poses[i] for i in np.lexsort((poses, way))] for way in (at, -at)]
    if all_round:
        ways = [way[way.index(poses[0]) :] + way[: way.index(poses[0])] for way in ways]
    return "-".join(str(pose + 1) for pose in min(ways))


def expected(found, poses, side):
    """What a walk says of one driver: locks, order, vertices of the range, and more."""
    here = poses[:, 0] >= 0
    count = [(poses[:, 0] == number).sum() for number in (0, 1)]
    main = poses[here][0, 0] if count[0] == count[1] else int(count[1] > count[0])
    on = np.flatnonzero(poses[:, 0] == main)
    walk, at = found[main], poses[on, 1]
    piece = walk.piece(side, at)
    locks = [(on[i], on[i + 1]) for i in range(len(on) - 1) if piece[i] != piece[i + 1]]
    turns, period = walk.turns[side], len(walk.rows) - 1
    full = walk.closed and not len(turns)
    all_round = walk.closed and (full or bool(locks))
    along = at
    if walk.closed and not all_round:
        along = (at - turns[(piece[0] - 1) % 2]) % period
    good = in_order(along, period if all_round else None)
    stretch = range(at.min(), at.max() + 1)
    if all_round and len(at) > 1:
        # Between the two neighbours round the circuit where the range does not run.
        ordered = np.sort(at)
        u = walk.drives[side]
        gaps = np.diff(np.append(np.abs(u[ordered] - u[0]), abs(u[ordered[0]] - u[0]) + 2 * np.pi))
        after = int(gaps.argmax())
        if good and len(set(at.tolist())) > 2:
            neighbours = [
                {x, y} == {int(at[0]), int(at[-1])}
                for x, y in zip(ordered.tolist(), np.roll(ordered, -1).tolist(), strict=True)
            ]
            after = neighbours.index(True) if any(neighbours) else after
        begin, end = ordered[(after + 1) % len(at)], ordered[after]
        if good and at[0] == at[-1] and np.ptp(at):  # back to where it began
            begin, end = at[0], at[0] - 1
        stretch = [v % period for v in range(begin, end + 1 if end >= begin else end + period + 1)]
        if good and at[0] == at[-1] and np.ptp(at):
            stretch.append(begin)
    elif walk.closed:
        ends = [at[along.argmin()], at[along.argmax()]]
        stretch = [v % period for v in range(ends[0], ends[0] + np.ptp(along) + 1)]
    return main, on, at, locks, good, full, all_round, along, list(stretch)


def agree(found, poses, verdict, side):
    """What a verdict on one driver says otherwise than the walk, or nothing."""
    main, on, at, locks, good, full, all_round, along, stretch = expected(found, poses, side)
    walk = found[main]
    mine = (verdict.first, verdict.second)[side]
    dyads = (walk.linkage.first, walk.linkage.second)[:: 1 - 2 * side]
    force = angle_of_force(*dyads, walk.rows)
    if any(not defect.certain for defect in mine.defects):
        return _excused(mine, walk.drives[side][at], force[stretch].min())
    branch = [d for d in mine.defects if d.kind == "branch"]
    order = [d for d in mine.defects if d.kind == "order"]
    u, turns = walk.drives[side], not isinstance(dyads[0], PR)
    miss = mine.inputs[on] - u[at]
    if turns:
        miss = (miss + np.pi) % (2 * np.pi) - np.pi
    travel = np.ptp(np.unwrap(u[stretch]) if turns else u[stretch])
    least = 0.0 if locks else force[stretch].min()
    wanted = tuple(sorted({int(pose) for pair in locks for pose in pair}))
    met = sequence(on.tolist(), along, all_round)
    checks = {
        "BRANCH": bool(branch) == bool(locks),
        "BRANCH POSES": not (branch and locks) or branch[0].poses == wanted,
        "ORDER": bool(order) != good,
        "SEQUENCE": not order or order[0].message.endswith(" " + met),
        "FULL TURN": mine.turns_fully == full,
        "DRIVE": np.abs(miss).max() < 1e-6 and np.isfinite(mine.inputs).sum() == len(on),
        "TRAVEL": locks or abs(np.ptp(mine.input_range) - travel) < 1e-6 * (1 + travel),
        "FIRST": locks or np.isclose(mine.input_range[0], np.nanmin(mine.inputs), atol=1e-9),
        # A step of a walk is 0.05 at the most, and the least may be within one.
        "LEAST": least - 5e-3 < mine.least_over_range < least + (1e-6 if locks else 1e-9),
        "AT POSES": np.isclose(mine.least_at_poses, force_at(found, poses, side).min()),
    }
    return next((word for word, passed in checks.items() if not passed), "")


def _excused(mine, u, least):
    """Whether what is not certain is near a dead point, or drives of two poses are all but one."""
    branch = [d for d in mine.defects if d.kind == "branch" and not d.certain]
    order = [d for d in mine.defects if d.kind == "order" and not d.certain]
    apart = np.abs(np.subtract.outer(u, u)) + np.eye(len(u))
    good = (not branch or least < DEAD_POINT_ANGLE + 5e-3) and (not order or apart.min() < 1e-4)
    return "too close" if good else "CALLED TOO CLOSE FOR NOTHING"


def force_at(found, poses, side):
    out = []
    for number, vertex in poses[poses[:, 0] >= 0]:
        linkage = found[number].linkage
        dyads = (linkage.first, linkage.second)[:: 1 - 2 * side]
        out.append(angle_of_force(*dyads, found[number].rows[vertex : vertex + 1])[0])
    return np.array(out)


def compare(pair, rng, count):
    """Hold the verdicts on `count` random linkages of a pair against walks; what came of each."""
    linkage = random_linkages(pair, rng, count)
    rows = [some_places(linkage.first[k], linkage.second[k], rng)[0] for k in range(count)]
    margin = Circuits.of(linkage).loop.margin[:, 0]
    some = [k for k in range(count) if len(rows[k]) and margin[k] > 1e-3]
    linkage = Linkage(linkage.first[some], linkage.second[some])
    every = walks_of(linkage, [rows[k] for k in some])
    result = Counter({"near a change point, or nowhere": count - len(some)})
    clear = [k for k, found in enumerate(every) if found is not None]
    result["walk unclear"] = len(some) - len(clear)
    if not clear:
        return result
    drawn = [draw(every[k], rng) for k in clear]
    places = np.full((len(clear), POSES, 3), np.nan)
    for i, k in enumerate(clear):
        for j, (number, vertex) in enumerate(drawn[i]):
            if number >= 0:
                places[i, j] = every[k][number].rows[vertex]
    linkage = Linkage(linkage.first[clear], linkage.second[clear])
    missed = np.where(np.isnan(places[..., 0]), np.nan, 0.0)
    verdicts = judge(linkage, Displacement.from_poses(places), missed=missed, reach=1e-9)
    for i, k in enumerate(clear):
        poses, verdict = drawn[i], verdicts[i]
        result["linkages"] += 1
        result["poses"] += int((poses[:, 0] >= 0).sum())
        words = [agree(every[k], poses, verdict, side) for side in (0, 1)]
        both = len({number for number in poses[:, 0] if number >= 0}) == 2
        kinds = {defect.kind: defect for defect in verdict.defects}
        if ("circuit" in kinds) != both or (both and not kinds["circuit"].certain):
            words.append("CIRCUIT")
        elif both:
            main = expected(every[k], poses, 0)[0]
            wanted = np.flatnonzero((poses[:, 0] >= 0) & (poses[:, 0] != main))
            if kinds["circuit"].poses != tuple(wanted):
                words.append("CIRCUIT POSES")
        lost = tuple(np.flatnonzero(poses[:, 0] < 0))
        if (kinds["assembly"].poses if "assembly" in kinds else ()) != lost:
            words.append("ASSEMBLY")
        if not animates(linkage, i, places[i], verdict):
            words.append("PARAMETER")
        for word in words:
            result[word or "agrees"] += 1
        for driver in (verdict.first, verdict.second):
            result.update(f"{defect.kind} defects" for defect in driver.defects)
        result["circuit defects"] += both
    return result


def animates(linkage, k, rows, verdict):
    """Whether the parameters of both drivers lead through the poses."""
    one = Linkage(linkage.first[k], linkage.second[k])
    for driver, side in (
        (verdict.first, one),
        (verdict.second, Linkage(one.second, one.first)),
    ):
        on = np.isfinite(driver.parameter)
        place = Circuits.of(side)[driver.circuit].couplers(driver.parameter[on])
        if np.abs(gap(rows_of(place), rows[on])).max() > 1e-6:
            return False
    return True


def wrong(result):
    return {word: n for word, n in result.items() if word.isupper()}


@all_pairs
def test_verdicts_against_walks(pair):
    result = compare(pair, np.random.default_rng([7, PAIRS.index(pair)]), 26)
    assert not wrong(result)
    assert result["linkages"] >= 8
    assert result["agrees"] >= 1.8 * result["linkages"]


# Least transmission -------------------------------------------------------------------------------


@all_pairs
def test_the_least_transmission_of_a_range_is_exact(pair):
    """Against many samples, each valley of them refined; ranges as poses on one branch ask."""
    circuits, linkage, s, _ = circuits_of(pair, 31, 40)
    rng = np.random.default_rng([32, PAIRS.index(pair)])
    s = np.sort(s[:, :4], axis=1)
    full = circuits.closed & (circuits.branches == 1)
    branch = np.where(circuits.closed & ~full, np.pi * rng.integers(2, size=len(s)), 0)[:, None]
    s = np.where(full[:, None], s + 3 * rng.random((len(s), 1)), s % 3.1 + branch)
    s = np.sort(s, axis=1)
    both_ways = ~circuits.closed & (circuits.branches == 2)
    s = np.where(both_ways[:, None], np.abs(s) + 0.01, s)
    places = circuits.couplers(s)
    found = [
        v.first for v in judge(linkage, places, missed=np.zeros(s.shape), reach=1, any_order=False)
    ]
    inner = 0
    for k, mine in enumerate(found):
        circuit = circuits[k]
        low, high = np.nanmin(mine.parameter), np.nanmax(mine.parameter)
        dyads = (linkage.first[k], linkage.second[k])

        def force(x, circuit=circuit, dyads=dyads):
            return angle_of_force(*dyads, rows_of(circuit.couplers(np.atleast_1d(x))))

        x = np.linspace(low, high, 2001)
        values = force(x)
        at = int(values.argmin())
        least = values[at]
        if 0 < at < len(x) - 1:
            inner += 1
            # Its square is smooth where the angle has a corner.
            fine = minimize_scalar(
                lambda t, force=force: force(t)[0],
                bounds=(x[at - 1], x[at + 1]),
                method="bounded",
                options={"xatol": 1e-12},
            )
            least = min(least, fine.fun)
        assert abs(mine.least_over_range - least) < 1e-9
    if pair in ((RR, RR), (RR, PR), (RP, RR)):
        assert inner > 2


# Known tasks --------------------------------------------------------------------------------------


def task(name):
    """The poses and the exact dyads (radius by radius) of a task that comes with the package."""
    case = json.loads((CASES / f"{name}.json").read_text())
    poses = np.array(case["poses"])
    poses[:, 2] = np.radians(poses[:, 2])
    return poses, {round(row[2], 2): RR(row[:2], row[3:], row[2]) for row in case["exact_dyads"]}


def one_verdict(first, second, poses, **options):
    linkage = Linkage(first[None], second[None])
    places = Displacement.from_poses(np.asarray(poses)[None])
    missed = np.zeros(places.shape)
    return judge(linkage, places, missed=missed, reach=1e-6, **options)[0]


def said(defects):
    return [(d.kind, d.message, d.certain) for d in defects]


def test_the_shoulder_has_one_pair_with_a_circuit_defect():
    poses, dyads = task("motiongen-shoulder")
    radii = sorted(dyads)
    for i, a in enumerate(radii):
        for b in radii[i + 1 :]:
            verdict = one_verdict(dyads[a], dyads[b], poses)
            if (a, b) == (5.53, 8.04):
                text = (
                    "poses 1-3 are on one assembly, 4 and 5 on the other: "
                    "it must be taken apart between poses 3 and 4"
                )
                assert said(verdict.defects) == [("circuit", text, True)]
                assert verdict.defects[0].poses == (3, 4)
                assert np.isnan(verdict.first.parameter[3:]).all()
            else:
                assert not verdict.defects
    pair = one_verdict(dyads[8.04], dyads[11.33], poses)
    assert not pair.first.defects
    assert pair.first.turns_fully
    assert said(pair.second.defects) == [
        ("branch", "locks between poses 3 and 4, at a dead point", True)
    ]


def test_mixed5_locks_for_either_drive():
    poses, dyads = task("motiongen-mixed5")
    verdict = one_verdict(*dyads.values(), poses)
    assert not verdict.defects
    first = "locks between poses 2 and 3 and between poses 4 and 5, at dead points"
    assert said(verdict.first.defects) == [("branch", first, True)]
    second = "locks between poses 3 and 4, at a dead point"
    assert said(verdict.second.defects) == [("branch", second, True)]
    assert np.isclose(np.degrees(verdict.second.least_at_poses), 7.3, atol=0.05)
    assert verdict.first.least_over_range < 1e-6
    assert not verdict.first.turns_fully


# In words -----------------------------------------------------------------------------------------

CRANK = four_bar(4.0, 1.0, 3.5, 3.0)  # turns fully
ROCKER = four_bar(5.0, 2.0, 2.0, 2.5)  # has one circuit, of two branches


def at_parameters(linkage, s, circuit=0, **options):
    """The verdict on poses at parameters."""
    poses = rows_of(Circuits.of(linkage, as_given=True)[circuit].couplers(np.asarray(s, float)))
    return one_verdict(linkage.first, linkage.second, poses, **options)


def test_order_round_a_crank():
    for s in ([1, 2, 4], [4, 2, 1], [2, 4, 1], [5, 6, 1, 2], [1, 6, 5, 2], [3], [3, 1], [1, 3, 1]):
        assert not at_parameters(CRANK, s).first.defects
    bad = at_parameters(CRANK, [1, 3, 2, 4]).first
    assert said(bad.defects) == [("order", "meets the poses in the order 1-3-2-4", True)]
    assert bad.defects[0].poses == (1, 2)
    assert not at_parameters(CRANK, [1, 3, 2, 4], any_order=True).first.defects
    named = at_parameters(CRANK, [1, 3, 2, 4], names=["A", "B", "C", "D"]).first
    assert named.defects[0].message == "meets the poses in the order A-C-B-D"


def test_the_range_goes_the_way_of_the_poses():
    way = at_parameters(CRANK, [5, 6, 1, 2]).first
    assert np.allclose(way.parameter, [5, 6, 1 + 2 * np.pi, 2 + 2 * np.pi])
    assert np.isclose(np.ptp(way.input_range), 2 * np.pi - 3)
    back = at_parameters(CRANK, [0.5, 4.5, 2.5]).first  # the long way, though a shorter holds all
    assert np.isclose(np.ptp(back.input_range), 2 * np.pi - 2)
    assert back.parameter[0] > back.parameter[1] > back.parameter[2]
    smallest = at_parameters(CRANK, [0.5, 4.5, 1.5, 5.5], any_order=True).first
    assert np.isclose(np.ptp(smallest.input_range), 2 * np.pi - 3)
    assert np.isclose(np.ptp(at_parameters(CRANK, [1, 3, 5, 1]).first.input_range), 2 * np.pi)


def test_order_on_a_branch_and_past_a_dead_point():
    assert not at_parameters(ROCKER, [0.5, 1, 2.5]).first.defects
    assert not at_parameters(ROCKER, [5.5, 5, 3.5]).first.defects
    bad = at_parameters(ROCKER, [0.5, 2.5, 1.0]).first
    assert said(bad.defects) == [("order", "meets the poses in the order 1-3-2", True)]
    locks = at_parameters(ROCKER, [2.5, 3.5, 5]).first
    text = "locks between poses 1 and 2, at a dead point"
    assert said(locks.defects) == [("branch", text, True)]
    assert locks.defects[0].poses == (0, 1)
    both = at_parameters(ROCKER, [1, 4, 2, 5]).first
    assert [d.kind for d in both.defects] == ["branch", "order"]
    either = at_parameters(ROCKER, [1, 4, 2, 5], any_order=True).first
    text = "locks at a dead point between poses 1 and 3 and 2 and 4"
    assert said(either.defects) == [("branch", text, True)]


def test_the_same_pose_twice_has_no_order():
    rng = np.random.default_rng(0)
    for linkage in (CRANK, ROCKER, Linkage(ROCKER.second, ROCKER.first)):
        for _ in range(20):
            s = np.array([0.7, 0.7, 1.1, 1.1, 1.1, 2.3, 2.3])
            poses = rows_of(Circuits.of(linkage)[0].couplers(s))
            poses = poses + 1e-9 * rng.normal(size=poses.shape)
            assert not one_verdict(linkage.first, linkage.second, poses).first.defects
    steps = (REPEATED_POSE_STEP / 2, CERTAIN_STEP_BACK / 2, 2 * CERTAIN_STEP_BACK)
    for step, certain in zip(steps, (None, False, True), strict=True):
        for linkage in (CRANK, ROCKER):
            found = said(at_parameters(linkage, [0.7, 1.0, 1.0 - step, 2]).first.defects)
            assert [c for _, _, c in found] == ([] if certain is None else [certain])
            assert all(("too close to call" in text) is not sure for _, text, sure in found)


def test_near_a_dead_point_nothing_is_certain():
    for eps in (-1e-4, 1e-4, 0.0):
        for s in ([0.5, 1.5, np.pi - eps], [np.pi - eps, 4, 5]):
            (defect,) = at_parameters(ROCKER, s).first.defects
            assert (defect.kind, defect.certain) == ("branch", False)
            pose = 3 if s[0] == 0.5 else 1
            assert defect.poses == (pose - 1,)
            assert f"a dead point at pose {pose}: too close to call" in defect.message
    # Less than TOO_CLOSE within a range: a crank with hardly room to pass.
    tight = four_bar(4.0, 1.0, 2.0 + 1e-7, 3.0)
    (defect,) = at_parameters(tight, [5.5, 6, 0.5, 1]).first.defects
    assert (defect.kind, defect.poses, defect.certain) == ("branch", (1, 2), False)
    assert "of a dead point between poses 2 and 3: too close to call" in defect.message
    assert not at_parameters(tight, [5, 4, 2, 1]).first.defects


def test_a_crank_goes_the_other_way_round_where_that_is_allowed():
    tight = four_bar(4.0, 1.0, 2.0 + 1e-7, 3.0)
    for s, options, room in (([6, 0.5], {}, 0.5), ([6, 0.5, 5.5], {"any_order": True}, 0.5)):
        way = at_parameters(tight, s, **options).first
        assert not way.defects
        assert way.least_over_range > 0.1
        assert np.isclose(np.ptp(way.input_range), 6 - room)
    short = at_parameters(CRANK, [6, 0.5]).first
    assert np.isclose(np.ptp(short.input_range), 2 * np.pi - 5.5)


# Assembly -----------------------------------------------------------------------------------------


def test_lengths_that_cannot_close_are_never_called_usable():
    rng = np.random.default_rng(1)
    told = 0
    for _ in range(40):
        lengths = rng.uniform(0.5, 3, 4)
        circuits = Circuits.of(four_bar(*lengths))
        if not circuits.exists[0]:
            continue
        poses = circuits[0].couplers(np.sort(rng.uniform(0.2, 2.9, 5)))
        lengths[rng.integers(1, 4)] *= rng.choice([0.7, 0.9, 1.2])
        changed = four_bar(*lengths)
        places = PoseError.of(changed, poses, 1.0).places
        missed = np.linalg.norm(gap(rows_of(places), rows_of(poses)), axis=-1)
        linkage = Linkage(changed.first[None], changed.second[None])
        verdict = judge(linkage, places[None], missed=missed[None], reach=1e-3)[0]
        off = [np.abs(constraint(d, rows_of(poses))[0]) for d in (changed.first, changed.second)]
        # A residual changes by 4 at the most over a unit of places, here.
        sure = set(np.flatnonzero(np.max(off, axis=0) > 2e-2).tolist())
        named = {p for d in verdict.defects if d.kind == "assembly" for p in d.poses}
        assert sure <= named
        told += len(sure)
    assert told > 60


def test_a_missed_pose_is_told_with_its_gap():
    poses = rows_of(Circuits.of(CRANK)[0].couplers(np.array([1.0, 2, 3, 4])))
    poses[1] = np.nan
    linkage = Linkage(CRANK.first[None], CRANK.second[None])
    missed = np.array([[0.0, np.nan, 0.531, 1e-3]])
    verdict = judge(linkage, Displacement.from_poses(poses[None]), missed=missed, reach=1e-3)[0]
    assert said(verdict.defects) == [
        ("assembly", "it cannot be assembled near pose 2", True),
        ("assembly", "the coupler comes no nearer to pose 3 than 0.53", True),
    ]
    assert [d.poses for d in verdict.defects] == [(1,), (2,)]
    for driver in (verdict.first, verdict.second):
        assert np.isnan(driver.parameter).tolist() == [False, True, False, False]
        assert np.isfinite(driver.least_over_range)
    nothing = judge(
        linkage,
        Displacement.from_poses(np.full((1, 4, 3), np.nan)),
        missed=np.full((1, 4), np.nan),
        reach=1.0,
    )[0]
    text = "it cannot be assembled near poses 1-4"
    assert said(nothing.defects) == [("assembly", text, True)]
    assert nothing.first.circuit == nothing.second.circuit == -1
    assert not nothing.first.defects
    assert not nothing.first.turns_fully


# Change points ------------------------------------------------------------------------------------


def nudged(linkage, rng, count):
    """Linkages (count,) each number of which is changed by its last digit, or not."""
    dyads = []
    for dyad in (linkage.first, linkage.second):
        fields = []
        for name in type(dyad).__slots__:
            value = np.asarray(getattr(dyad, name))
            step = rng.choice([-1, 0, 1], (count, *value.shape))
            fields.append(value + step * np.spacing(np.maximum(np.abs(value), 1)))
        dyads.append(type(dyad)(*fields))
    return Linkage(*dyads)


def tied_linkages():
    out = []
    for name, linkage in CHANGE.items():
        for turned, either in (
            ("", linkage),
            (", from behind", Linkage(linkage.second, linkage.first)),
        ):
            if "parallel" not in name.replace("parallelogram", "") and name != "stretched":
                out.append(pytest.param(either, id=name + turned))
    return out


def verdicts_on(linkage, poses, count):
    places = Displacement.from_poses(np.broadcast_to(poses, (count, *poses.shape)))
    return judge(linkage, places, missed=np.zeros(places.shape), reach=1e-6)


def kinds_of(verdict):
    every = (verdict.defects, verdict.first.defects, verdict.second.defects)
    return [d for defects in every for d in defects]


@pytest.mark.parametrize("linkage", tied_linkages())
def test_a_last_digit_never_makes_or_mends_a_defect_at_a_change_point(linkage):
    rng = np.random.default_rng(3)
    circuits = Circuits.of(linkage, as_given=True)
    same = 0
    for number in np.flatnonzero(circuits.exists):
        # Within a quarter turn: on one piece.  As given, everything else turns there.
        piece = rows_of(circuits[number].couplers(np.array([0.2, 0.5, 0.9, 1.3])))
        for poses, order in ((piece, True), (piece[[0, 2, 1, 3]], False)):
            verdicts = verdicts_on(nudged(linkage, rng, 24), poses, 24)
            usable = [[not d for d in (v.defects, v.first.defects)] for v in verdicts]
            assert all(u == [True, order] for u in usable)
            others = {not v.second.defects for v in verdicts}
            assert len(others) == 1
            if others == {True} != {order} or (order and others == {False}):
                x = driven(linkage.second, piece)
                assert min(np.ptp(x), *np.abs(np.diff(x))) < 1e-9 or turns_back(linkage, piece)
            same += 1
    assert same >= 2


@pytest.mark.parametrize("seed", range(4))
def test_nor_does_it_on_random_ties(seed):
    rng = np.random.default_rng([6, seed])
    usable = 0
    for _ in range(25):
        s, p, q = rng.uniform(0.5, 2, 3)
        lengths = np.array([s, p, q, abs(p + q - s) + 1e-3])[rng.permutation(4)]
        if rng.random() < 0.2:
            lengths[2:] = lengths[:2][:: rng.choice([-1, 1])]
        lengths[int(lengths.argmax())] = lengths.sum() - lengths.max() - 2 * lengths.min()
        linkage = four_bar(*lengths)
        circuits = Circuits.of(linkage, as_given=True)
        if lengths.min() < 0.1 or not circuits.exists[0]:
            continue
        x = rng.uniform(0, 2 * np.pi) + rng.uniform(0, 2.5) * np.sort(rng.random(4))
        x = x[rng.permutation(4)] if rng.random() < 0.3 else x
        poses = rows_of(circuits[rng.integers(circuits.exists.sum())].couplers(x))
        verdicts = verdicts_on(nudged(linkage, rng, 16), poses, 16)
        for side in ("first", "second"):
            found = [not (v.defects or getattr(v, side).defects) for v in verdicts]
            assert len(set(found)) == 1
            usable += found[0]
    assert usable >= 6


def turns_back(linkage, poses):
    """Whether the other drive turns back between poses: a dead point of its own."""
    circuits = Circuits.of(linkage, as_given=True)
    number = circuit_of(linkage, Displacement.from_poses(poses), as_given=True).circuit[0]
    x = driven(linkage.second, rows_of(circuits[number].couplers(np.linspace(0.2, 1.3, 400))))
    return len(set(np.sign(np.diff(x)))) > 1


@pytest.mark.parametrize("name", ["parallelogram", "tie of four lengths", "slider-crank", "kite"])
def test_passing_a_change_point_is_a_defect_but_not_a_certain_one(name):
    linkage, rng = CHANGE[name], np.random.default_rng(4)
    told = Circuits.of(linkage, as_given=True)
    tie = {
        "parallelogram": 0.0,
        "tie of four lengths": np.pi,
        "slider-crank": 0.0,
        "kite": np.pi / 2,
    }
    for s in (tie[name] + np.array([0.4, 0.2, -0.2]), tie[name] + np.array([-0.3, 0.0, 0.5])):
        poses = rows_of(told[0].couplers(s))
        for verdict in verdicts_on(nudged(linkage, rng, 24), poses, 24):
            every = kinds_of(verdict)
            assert {d.kind for d in every} <= {"branch", "circuit", "order"}
            assert verdict.defects or verdict.first.defects
            assert not any(d.certain for d in every)
            assert all(d.message.endswith(": too close to call") for d in every)
            passing = [d for d in verdict.first.defects if d.kind == "branch"]
            if s[1] != tie[name] and passing and not verdict.defects:
                assert "passes a change point between poses" in passing[0].message
                assert 2 in passing[0].poses


def kite_at(ground, link, angles, spun):
    """The places of a kite (crank as long as the ground link), by circles: psi of the crank.

    spun: whether the crank lies on the ground and the kite's other links spin about its pin.
    """
    other = np.array([link, 0.0])
    pins = np.array([ground, 0.0]) + 0 * angles[:, None]
    if not spun:
        pins = ground * np.column_stack([np.cos(angles), np.sin(angles)])
        gap = np.array([ground, 0.0]) - pins
        reach = np.hypot(*gap.T)
        angles = np.arctan2(gap[:, 1], gap[:, 0]) + np.arccos(reach / (2 * link))
    return (RR([0, 0], [0, 0], ground), RR([ground, 0], other, link)), np.column_stack(
        [pins, angles]
    )


@pytest.mark.parametrize("driver", ["first", "second"])
def test_no_order_of_a_kite_that_passes_its_change_point_is_certain(driver):
    rng, orders = np.random.default_rng(5), 0
    for _ in range(30):
        ground, link = rng.choice(np.arange(1.0, 9.0), 2, replace=False)
        most = (
            2 * np.arcsin(min(1.0, link / ground)) - 0.2
        )  # where coupler and follower are in line
        angles = rng.uniform(0.1, most, 4) * rng.permutation([1, 1, -1, -1])
        angles[rng.integers(4)] = rng.choice([0.0, angles[0]])
        dyads, some = kite_at(ground, link, angles, spun=False)
        _, spin = kite_at(ground, link, rng.uniform(-2, 2, 1), spun=True)
        poses = np.concatenate([some, spin])[rng.permutation(5)]
        poses[:, 2] = np.unwrap(poses[:, 2])
        verdict = one_verdict(*dyads, poses)
        every = verdict.defects + getattr(verdict, driver).defects
        if any(defect.kind in ("branch", "circuit") for defect in every):  # it passes, or is there
            assert not any(defect.certain for defect in every)
            orders += any(defect.kind == "order" for defect in every)
    assert orders > 5


@pytest.mark.parametrize("name", ["parallelogram", "tie of four lengths", "Rapson slide"])
def test_the_order_is_not_certain_where_a_pose_is_beyond_the_change_point(name):
    """Four poses on one assembly out of order, a fifth on the other that meets it: which way?"""
    circuits = Circuits.of(CHANGE[name], as_given=True)
    one = rows_of(circuits[0].couplers(np.array([0.2, 0.9, 0.5, 1.3])))
    beyond = rows_of(circuits[1].couplers(np.array([0.7])))
    dyads = CHANGE[name].first, CHANGE[name].second
    for poses, certain in ((one, True), (np.concatenate([one, beyond]), False)):
        verdict = one_verdict(*dyads, poses)
        assert [d.kind for d in verdict.defects] == ([] if certain else ["circuit"])
        (defect,) = verdict.first.defects
        assert (defect.kind, defect.certain) == ("order", certain)
        doubt = "" if certain else ": too close to call"
        assert defect.message == f"meets the poses in the order 1-3-2-4{doubt}"


def test_a_pose_on_a_change_point_is_on_no_other_assembly():
    linkage, rng = CHANGE["parallelogram"], np.random.default_rng(7)
    poses = rows_of(Circuits.of(linkage, as_given=True)[0].couplers(np.array([0.0, 0.4, 0.9])))
    for verdict in verdicts_on(nudged(linkage, rng, 24), poses, 24):
        assert not verdict.defects
        for driver in (verdict.first, verdict.second):
            text = "is at a change point at pose 1: too close to call"
            assert ("branch", text, False) in said(driver.defects)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
@all_pairs
def test_the_unit_of_length_changes_no_verdict(pair, unit):
    circuits, linkage, s, _ = circuits_of(pair, 34, 30)
    rows = rows_of(circuits.couplers(s[:, :5]))
    rows[:, 3] = rows_of(circuits.couplers(s[:, 2:3] - 1e-3 * rng_signs(len(s))))[:, 0]
    scaled = []
    for dyad in (linkage.first, linkage.second):
        lengths = ("fixed_pivot", "moving_pivot", "radius", "offset")
        values = ((name, getattr(dyad, name)) for name in type(dyad).__slots__)
        scaled.append(type(dyad)(*(v * unit if name in lengths else v for name, v in values)))
    found = []
    for each, size in ((linkage, 1.0), (Linkage(*scaled), unit)):
        places = Displacement.from_poses(rows * [size, size, 1])
        verdicts = judge(each, places, missed=np.zeros(places.shape), reach=1e-6)
        found.append([said(kinds_of(verdict)) for verdict in verdicts])
    assert found[0] == found[1]


def rng_signs(count):
    return np.random.default_rng(8).choice([-1.0, 1.0], (count, 1))


@pytest.mark.parametrize("name", ["rails parallel by rounding", "Oldham with parallel slots"])
def test_guides_that_are_nearly_parallel_are_not_judged(name):
    verdict = one_verdict(CHANGE[name].first, CHANGE[name].second, [[0.0, 0, 0], [1, 0, 0]])
    for driver in (verdict.first, verdict.second):
        (defect,) = driver.defects
        assert (defect.kind, defect.certain, defect.poses) == ("branch", False, (0, 1))
        assert driver.circuit == -1


def test_many_linkages_are_judged_as_one_by_one():
    rng = np.random.default_rng(5)
    for pair in PAIRS:
        circuits, linkage, s, _ = circuits_of(pair, 33, 12)
        places = circuits.couplers(s[:, :6])
        rows = rows_of(places)
        rows[rng.random(rows.shape[:2]) < 0.1] = np.nan
        missed = np.where(np.isnan(rows[..., 0]), np.nan, rng.random(rows.shape[:2]))
        many = judge(linkage, Displacement.from_poses(rows), missed=missed, reach=0.9)
        for k, verdict in enumerate(many):
            one = judge(
                Linkage(linkage.first[k : k + 1], linkage.second[k : k + 1]),
                Displacement.from_poses(rows[k : k + 1]),
                missed=missed[k : k + 1],
                reach=0.9,
            )[0]
            assert said(kinds_of(one)) == said(kinds_of(verdict))
            for a, b in ((one.first, verdict.first), (one.second, verdict.second)):
                assert np.array_equal(a.parameter, b.parameter, equal_nan=True)
                assert np.array_equal(a.input_range, b.input_range, equal_nan=True)
                assert np.array_equal(a.least_over_range, b.least_over_range, equal_nan=True)


@pytest.mark.parametrize("branch", [False, True])
@pytest.mark.parametrize("share", [0.3, 3.0])
def test_poses_nearer_than_they_are_missed_have_no_order(share, branch):
    """Round a full turn (crank) and along a branch (rocker): a step back within the misses.

    Twice the greatest miss counts: on average over the way, which is uneven by less than three.
    """
    lengths = (3.0, 1.0, 2.5, 2.2)
    linkage = Linkage(RR([0, 0], [0, 0], lengths[1]), RR([3.0, 0], [2.5, 0], lengths[3]))
    linkage = Linkage(linkage.second, linkage.first) if branch else linkage
    s = np.array([0.6, 1.0, 0.95, 1.4, 2.0])
    one = Linkage(linkage.first[None], linkage.second[None])
    places = Circuits.of(one)[0, :1].couplers(s)
    length = 0.7
    step = places.translation[0, 2] - places.translation[0, 1]
    back = float(np.sqrt((step**2).sum() + (length * np.ptp(places.angle[0, 1:3])) ** 2))
    missed = np.full((1, 5), share * back / 2)
    for options, forgiven in (({"length": length}, share > 1), ({}, False)):
        verdict = judge(one, places, missed=missed, reach=1.0, **options)[0]
        kinds = [defect.kind for defect in verdict.first.defects]
        assert kinds == ([] if forgiven else ["order"])
    # Poses that are far apart keep their order, however much is missed.
    shuffled = places[:, [0, 3, 1, 4, 2]]
    verdict = judge(one, shuffled, missed=missed, reach=1.0, length=length)[0]
    assert [defect.kind for defect in verdict.first.defects] == ["order"]


if __name__ == "__main__":
    many, seed = (int(word) for word in sys.argv[1:])
    total = Counter()
    for index, each in enumerate(PAIRS):
        part, result = 0, Counter()
        while result["linkages"] < many / len(PAIRS):
            result += compare(each, np.random.default_rng([seed, index, part]), 100)
            part += 1
        print(NAMES[index], dict(result), flush=True)
        total += result
    print("all", dict(total))
    sys.exit(bool(wrong(total)))


def test_changes_in_a_row_are_one_in_messages():
    """As noise near a dead point makes them."""
    names = PoseNames(None)
    assert names.between([(3, 4)]) == "between poses 4 and 5"
    row = [(6, 7), (7, 8), (8, 9)]
    assert names.between(row) == "3 times between poses 7 and 10"
    assert names.between([*row, (20, 21)]) == (
        "3 times between poses 7 and 10 and between poses 21 and 22"
    )
    assert names.between([(0, 1), (2, 3)]) == "between poses 1 and 2 and between poses 3 and 4"


@pytest.mark.parametrize(
    ("order", "text"),
    [
        ([0, 1, 3, 2], "1-2-4-3"),
        ([*range(9), 10, 9, *range(11, 60)], "1 to 9, 11, 10, 12 to 60"),
        ([0, *range(59, 0, -1)], "1, 60 to 2"),
        ([*range(30, 45), *range(30)], "31 to 45, 1 to 30"),
        ([0, 20, 1, 21, 2, 22, 3, 23, 4, 24, 5, 25, 6], "1, 21, 2, 22, 3, 23, ..."),
    ],
)
def test_an_order_of_many_poses_is_told_by_runs(order, text):
    assert PoseNames(None).in_order(order) == text
