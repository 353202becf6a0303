"""Gaps of a path: bulges of arcs, against circles, dense curves of the witness, and its tips."""

import numpy as np
import pytest

from burmester.fourbar.path_gaps import PathGaps, are_drawing
from tests.oracles.both_ways import from_segment
from tests.oracles.coupler_curves import dyads_of, random_crank, traced


def pairs(z):
    return np.column_stack([z.real, z.imag])


def stepped(z, side, ends, number, closed):
    """Crank angles of points at equal steps of arc length along a curve."""
    fine = np.linspace(*ends, 4001)
    at = np.concatenate([[0], np.abs(np.diff(traced(dyads_of(z), side, fine))).cumsum()])
    return np.interp(np.linspace(0, at[-1], number, endpoint=not closed), at, fine)


@pytest.mark.parametrize("number", [3, 8, 200])
def test_bulge_of_a_circle(number):
    t = np.linspace(0, 2 * np.pi, number, endpoint=False)
    gaps = PathGaps.of(pairs(np.exp(1j * t)), closed=True)
    ends = gaps.ends(t[None], 2 * np.pi)
    bulges = gaps.bulges(lambda at: np.exp(1j * at), ends)
    chord = 2 * np.sin(np.pi / number)
    assert bulges == pytest.approx(np.full((1, number), np.tan(np.pi / 2 / number) / 2 * chord))
    assert (bulges < gaps.allowed()).all()
    assert gaps.diameter == pytest.approx(2.0, rel=0.14)
    # The other way round, or back from the last point to the first, each arc is another one.
    back = gaps.bulges(lambda at: np.exp(1j * at), gaps.ends(t[None]))
    assert back[0, -1] > gaps.allowed()[-1]


@pytest.mark.parametrize("closed", [True, False])
def test_bulges_are_those_of_dense_curves(closed):
    rng = np.random.default_rng(5)
    for _ in range(4):
        z, side = random_crank(rng)
        t = np.sort(rng.uniform(0, 2 * np.pi, 7))
        gaps = PathGaps.of(pairs(traced(dyads_of(z), side, t)), closed=closed)
        found = gaps.bulges(
            lambda at, z=z, side=side: traced(dyads_of(z), side, at.ravel()).reshape(at.shape),
            gaps.ends(t[None], 2 * np.pi),
        )[0]
        after = np.append(t[1:], t[0] + 2 * np.pi)[: len(gaps.begin)]
        for k, (low, high) in enumerate(zip(t, after, strict=False)):
            dense = traced(dyads_of(z), side, np.linspace(low, high, 4001))
            away = from_segment(dense, gaps.begin[k], gaps.end[k]).max()
            assert found[k] == pytest.approx(away, rel=1e-4, abs=1e-9)


def test_curves_stay_on_the_path_of_their_own_points_however_sharp_their_tips():
    rng, sharp = np.random.default_rng(6), 0
    for number in range(40):
        z, side = random_crank(rng)
        closed = number % 2 == 0
        begin = rng.uniform(0, 2 * np.pi)
        ends = (begin, begin + (2 * np.pi if closed else rng.uniform(1.5, 4)))
        t = stepped(z, side, ends, int(rng.integers(12, 41)), closed)
        gaps = PathGaps.of(pairs(traced(dyads_of(z), side, t)), closed=closed)
        bulges = gaps.bulges(
            lambda at, z=z, side=side: traced(dyads_of(z), side, at.ravel()).reshape(at.shape),
            gaps.ends(t[None], 2 * np.pi),
        )[0]
        assert (bulges <= gaps.allowed()).all()
        sharp += bool((bulges > np.abs(gaps.end - gaps.begin) / 2).any())
    assert sharp  # half the gap's own chord is not enough


def test_what_is_allowed():
    points = pairs(np.arange(21) * 0.1 + 0j)
    gaps = PathGaps.of(points, closed=False)
    assert gaps.allowed() == pytest.approx(np.full(20, 0.05), rel=1e-6)
    assert gaps.allowed(0.03) == pytest.approx(np.full(20, 0.08), rel=1e-6)
    assert gaps.allowed(np.inf) == pytest.approx(np.full(20, 0.2), rel=1e-6)  # a tenth
    coarse = PathGaps.of(points[::10], closed=False)
    assert coarse.allowed(np.inf) == pytest.approx([0.5, 0.5], rel=1e-6)
    assert are_drawing(10, closed=False, timed=True)
    assert not are_drawing(9, closed=False, timed=False)
    assert are_drawing(8, closed=True, timed=False)
    assert not are_drawing(8, closed=True, timed=True)


def test_of_very_many_gaps_the_one_that_strays_is_measured_to_its_peak():
    count, gap, height = 1000, 700, 0.01
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    step = t[1]
    points = np.column_stack([np.cos(t), np.sin(t)])

    def curve(parameter):
        away = (parameter - (gap + 0.6) * step) / (0.2 * step)
        return (1 + height * np.exp(-(away**2))) * np.exp(1j * parameter)

    gaps = PathGaps.of(points, closed=True)
    bulges = gaps.bulges(curve, gaps.ends(t[None], 2 * np.pi))[0]
    assert bulges.argmax() == gap
    assert bulges[gap] == pytest.approx(height, rel=2e-3)
