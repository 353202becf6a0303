"""Clearance against sweeps with motion and drawings of the tests' own."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.clearance import campaign

from burmester import RR, Displacement, KeepOut, Linkage, Polygon, Surroundings, box
from burmester.clearance.least_clearance import Clearance, MotionFrames, clearance_between_poses
from burmester.clearance.many_linkages import shares_too_close
from burmester.clearance.moving_parts import bars_of
from burmester.fourbar.defects import Driven, judge
from tests.oracles.clearance_sweep import Moved, moved_four_bar, random_outline, sweep

CRANK = RR([0.0, 0.0], [0.0, 0.0], 30.0)
ROCKER = RR([80.0, 0.0], [70.0, 10.0], 60.0)
TURN = np.linspace(0.6, 1.8, 20001)  # of the crank; the poses are its ends and its middle


def places_at(moved: Moved, index: np.ndarray) -> Displacement:
    d = moved.d[index]
    return Displacement(np.stack([d.real, d.imag], axis=-1), moved.phi[index])


def driven_by_first(moved: Moved, index: list[int]) -> Driven:
    one = Linkage(moved.first[None], moved.second[None])
    missed = np.zeros((1, len(index)))
    poses = places_at(moved, np.array(index))[None]
    return judge(one, poses, missed=missed, reach=1e-3, length=30.0)[0].first


def told(
    moved: Moved, body: object, around: Surroundings, at: tuple[int, ...] = (0, 10000, 20000)
) -> Clearance:
    outline = None if body is None else Polygon(body)
    linkage = Linkage(moved.first, moved.second)
    out = clearance_between_poses(linkage, driven_by_first(moved, list(at)), outline, around)
    assert out is not None
    return out


@pytest.fixture(scope="module")
def moved() -> Moved:
    return Moved(CRANK, ROCKER, TURN, 1)


def test_a_dense_sweep_finds_nothing_less() -> None:
    for each in campaign(8, 20_000, 3):
        # The sweep is dense: it finds no less than the error told allows, and hardly more.
        assert each.told.least - each.told.error - 1e-9 <= each.swept
        assert each.told.least == pytest.approx(each.swept, abs=1e-4)
        assert each.there == pytest.approx(each.told.least, abs=1e-6)
        assert each.told.error < 0.01
        assert -1e-9 <= each.by_few - each.told.least < 1.0


def test_no_point_goes_farther_between_two_frames_than_is_told() -> None:
    rng = np.random.default_rng(8)
    done = 0
    while done < 12:
        moved = moved_four_bar(rng, 4000)
        driven = driven_by_first(moved, [0, 2000, 3999])
        if driven.defects or driven.circuit < 0:
            continue
        frames = MotionFrames.between_poses(Linkage(moved.first, moved.second), driven)
        assert frames is not None
        points = random_outline(rng, 50)
        ways = frames.ways().of_points(points)
        finer = np.linspace(frames.parameter[:-1], frames.parameter[1:], 200)
        d = frames.circuit.couplers(finer.T.reshape(-1))
        steps = np.diff(d[:, None].act(points).reshape(len(ways), 200, -1, 2), axis=1)
        gone = np.linalg.norm(steps, axis=-1).sum(axis=1).max(axis=1)
        assert (gone <= ways * (1 + 1e-9) + 1e-9).all()
        # Neither coupler nor links turn back between two frames: the sum of small turns is all.
        own = frames.ways()
        turned = np.abs(np.diff(np.unwrap(d.angle.reshape(len(ways), 200)), axis=1)).sum(axis=1)
        np.testing.assert_allclose(own.turn, turned, rtol=1e-6, atol=1e-6)
        for pivot, told in zip(own.pivots, own.travel, strict=True):
            path = np.diff(d.act(pivot).reshape(len(ways), 200, 2), axis=1)
            np.testing.assert_allclose(told, np.linalg.norm(path, axis=-1).sum(axis=1), rtol=1e-4)
        done += 1


def needle_beside(moved: Moved, body: np.ndarray, gap: float) -> Polygon:
    """A needle whose tip is a gap beyond the farthest that the body reaches in some direction.

    In a direction in which that is on the way, not at an end, and between two frames.
    """
    corners = moved.d[:, None] + (body @ [1, 1j]) * np.exp(1j * moved.phi)[:, None]
    for direction in np.exp(1j * np.linspace(0, 2 * np.pi, 72, endpoint=False)):
        reach = (corners * direction.conjugate()).real
        frame, corner = np.unravel_index(reach.argmax(), reach.shape)
        if 0.1 < frame / len(reach) < 0.9 and 0.4 < 64 * frame / len(reach) % 1 < 0.6:
            tip = corners[frame, corner] + gap * direction
            ends = np.array([tip, tip + (5 - 0.1j) * direction, tip + (5 + 0.1j) * direction])
            return Polygon(np.stack([ends.real, ends.imag], axis=-1))
    raise AssertionError("no direction in which the body is farthest on its way")


PLATE = np.array([[0, 0], [60, 0], [60, 25], [0, 25.0]])


def test_a_contact_between_all_frames_is_found(moved: Moved) -> None:
    needle = needle_beside(moved, PLATE, -1e-5)
    swept = sweep(moved, PLATE, [needle.vertices], 0.0)
    assert 0 < np.mean(swept == 0) < 0.01  # less than between two even frames
    assert sweep(moved_at(moved, 65), PLATE, [needle.vertices], 0.0).min() > 0
    out = told(moved, PLATE, Surroundings(KeepOut(needle, "needle")))
    assert out.touches
    assert (out.part, out.obstacle) == ("the body", "'needle'")


def moved_at(moved: Moved, count: int) -> Moved:
    few = Moved(moved.first, moved.second, moved.drive, 0)
    at = np.linspace(0, len(moved.d) - 1, count).astype(int)
    few.d, few.phi, few.drive = moved.d[at], moved.phi[at], moved.drive[at]
    return few


@pytest.mark.parametrize("gap", [1e-3, 0.02])
def test_a_needle_that_is_just_passed_does_not_touch(moved: Moved, gap: float) -> None:
    needle = needle_beside(moved, PLATE, gap)
    out = told(moved, PLATE, Surroundings(needle))
    assert out.least == pytest.approx(gap, abs=1e-4)
    assert out.least - out.error <= gap <= out.least
    assert out.obstacle == "region 1"
    assert not out.touches


def test_what_lies_in_the_hull_of_the_body_need_not_touch_it(moved: Moved) -> None:
    notched = [(0, 0), (90, 0), (90, 60), (80, 60), (80, 10), (10, 10), (10, 60), (0, 60)]
    middle = moved.d + (45 + 40j) * np.exp(1j * moved.phi)
    at, index = middle[100], np.array([0, 100, 200])
    region = box([at.real - 2, at.imag - 2], [at.real + 2, at.imag + 2])
    few = Moved(CRANK, ROCKER, TURN[:201], 1)
    out = told(few, np.array(notched, float), Surroundings(region), tuple(index))
    swept = sweep(few, np.array(notched, float), [region.vertices], 0.0)
    assert out.least == pytest.approx(swept.min(), abs=1e-4)
    assert out.least > 5
    filled = told(few, np.array(notched, float)[[0, 1, 2, 7]], Surroundings(region), tuple(index))
    assert filled.touches


def test_links_have_a_width(moved: Moved) -> None:
    region = box([-20, 35], [0, 40])
    thin = told(moved, None, Surroundings(region))
    assert thin.part in ("the driver", "the coupler")
    for width in (0.5, 1.0):
        wide = told(moved, None, Surroundings(region, link_width=width))
        assert wide.least == pytest.approx(thin.least - width / 2, abs=1e-3)
    assert told(moved, None, Surroundings(region, link_width=2 * thin.least + 1)).touches


def test_a_contact_is_told_where_it_begins(moved: Moved) -> None:
    last = moved.d[-1] + (60 + 25j) * np.exp(1j * moved.phi[-1])
    region = box([last.real - 2, last.imag - 2], [last.real + 2, last.imag + 2])
    swept = sweep(moved, PLATE, [region.vertices], 0.0)
    begins = int(np.flatnonzero(swept == 0)[0])
    assert 100 < begins < 10000
    out = told(moved, PLATE, Surroundings(region))
    assert out.touches
    assert out.poses == (0, 1)
    assert out.input - 2 * np.pi == pytest.approx(moved.drive[begins], abs=1e-3)
    backwards = told(moved, PLATE, Surroundings(region), (20000, 10000, 0))
    assert backwards.touches
    assert backwards.poses == (0, 0)


ABOVE = np.array([[8, 2], [62, 9], [62, 60], [8, 60.0]])
BELOW = np.array([[-5, 0], [75, 10], [75, -60], [-5, -60.0]])


def test_links_in_the_plane_of_the_body_must_not_cross_it(moved: Moved) -> None:
    # A plate above the coupler: links come from below.  One that hangs down lies over them.
    for body, touches in ((ABOVE, False), (BELOW, True)):
        out = clearance_between_poses(
            Linkage(CRANK, ROCKER),
            driven_by_first(moved, [0, 10000, 20000]),
            Polygon(body),
            Surroundings(body_in_plane=True, link_width=2),
        )
        assert out is not None
        assert out.touches == touches
        assert out.obstacle == "the body"
    free = clearance_between_poses(
        Linkage(CRANK, ROCKER),
        driven_by_first(moved, [0, 10000, 20000]),
        Polygon(BELOW),
        Surroundings(link_width=2),
    )
    assert free is None


def test_a_link_may_lie_over_the_body_on_its_shortest_way_out() -> None:
    # The pivots lie 6 within the lower edge, and the links come from below, steeply.
    steep = Moved(CRANK, ROCKER, np.linspace(1.2, 1.8, 2001), 1)
    deep = np.array([[-19, -8.8], [96, 7.6], [96, 60], [-19, 60]])
    around = Surroundings(body_in_plane=True, link_width=2)
    out = told(steep, deep, around, (0, 1000, 2000))
    assert 0 < out.least < 14
    aside = np.array([[-60, -8.8], [20, -8.8], [20, -60], [96, -60], [96, 60], [-60, 60]])
    assert told(steep, aside, around, (0, 1000, 2000)).touches
    places = places_at(steep, np.linspace(0, 2000, 36).astype(int))[None]
    bars = bars_of(Linkage(CRANK[None], ROCKER[None]), places)
    for slack, close in ((out.least - 0.01, False), (out.least + 0.3, True)):
        assert (shares_too_close(places, bars, Polygon(deep), around, slack)[0] > 0) == close


def test_many_linkages_at_once_are_each_at_its_frames() -> None:
    rng = np.random.default_rng(4)
    body, regions = random_outline(rng, 40), [random_outline(rng, 25) + 60, random_outline(rng, 20)]
    around = Surroundings(tuple(map(Polygon, regions)), link_width=3)
    every, swept = [], []
    while len(every) < 40:
        moved = moved_four_bar(rng, 30)
        if not (isinstance(moved.first, RR) and isinstance(moved.second, RR)):
            continue
        every.append(moved)
        swept.append(sweep(moved, body, regions, 3.0))
    linkages = Linkage(
        *(
            RR(*(np.stack([getattr(getattr(m, side), name) for m in every]) for name in names))
            for side in ("first", "second")
            for names in [("fixed_pivot", "moving_pivot", "radius")]
        )
    )
    d, phi = np.stack([m.d for m in every]), np.stack([m.phi for m in every])
    phi[3, :4] = np.nan
    swept[3][:4] = np.inf
    places = Displacement(np.stack([d.real, d.imag], axis=-1), phi)
    bars = bars_of(linkages, places)
    for slack in (1e-6, 0.5, 2.0, 10.0):
        shares = shares_too_close(places, bars, Polygon(body), around, slack)
        np.testing.assert_array_equal(shares, [(each <= slack).mean() for each in swept])
    assert ((shares > 0) & (shares < 1)).any()


def test_many_linkages_in_the_plane_of_the_body(moved: Moved) -> None:
    places = places_at(moved, np.linspace(0, 20000, 36).astype(int))[None]
    bars = bars_of(Linkage(CRANK[None], ROCKER[None]), places)
    for body, touches in ((ABOVE, False), (BELOW, True)):
        around = Surroundings(body_in_plane=True, link_width=2)
        assert (shares_too_close(places, bars, Polygon(body), around, 0.0)[0] > 0) == touches


def test_an_outline_of_many_corners_is_taken_with_fewer() -> None:
    angle = np.linspace(0, 2 * np.pi, 1500, endpoint=False)
    disc = Polygon(np.stack([20 * np.cos(angle), 20 * np.sin(angle)], axis=-1))
    places = Displacement(np.array([[[0.0, 0.0], [5.0, 0.0]]]), np.zeros((1, 2)))
    wall = Surroundings(box([40, -100], [50, 100]))
    bars = np.full((1, 2, 3, 2, 2), np.nan)
    shares = [shares_too_close(places, bars, disc, wall, slack)[0] for slack in (14.9, 15.1, 20.1)]
    assert shares == [0.0, 0.5, 1.0]
