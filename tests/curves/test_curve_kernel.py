"""The compiled descent: at its ends nothing that the witness measures leads further down."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.curves.crank_linkages import CrankLinkages
from burmester.curves.path_fit import CurveFit, PathTarget, descend
from tests.oracles.both_ways import from_segment
from tests.oracles.coupler_curves import dyads_of, random_crank, refined_from, traced

NOISE, STRIDE = 0.03, 1e-4


def path(seed, count=16):
    """A start beside a noisy curve, as a fit, its points, and which side the witness calls it."""
    rng = np.random.default_rng(seed)
    z, side = random_crank(rng)
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    z = z / np.sqrt(np.var(traced(dyads_of(z), side, t)))
    curve = traced(dyads_of(z), side, t)
    z[:4] -= np.tile([curve.mean().real, curve.mean().imag], 2)
    points = curve - curve.mean() + NOISE * (rng.normal(size=count) + 1j * rng.normal(size=count))
    for assembly in (1.0, -1.0):
        one = CrankLinkages(z[None], np.array([assembly]))
        if np.allclose(one.at(t[None]).point[0], curve - curve.mean()):
            return CurveFit(one, t[None], np.zeros(1)), points, side
    raise AssertionError


def measured(z, t, side, points, timed):
    """The sum of squared distances by the witness: timed, or of the feet near crank angles t."""
    if timed:
        return (np.abs(traced(dyads_of(z), side, t) - points) ** 2).sum()
    near = t + np.linspace(-0.02, 0.02, 41)[:, None]
    away = np.abs(traced(dyads_of(z), side, near.ravel()).reshape(near.shape) - points) ** 2
    k = np.clip(away.argmin(axis=0), 1, 39)
    low, at, high = (away[k + j, np.arange(len(t))] for j in (-1, 0, 1))
    return (at - (high - low) ** 2 / (8 * (high - 2 * at + low))).sum()  # of the parabola


def links(z):
    return np.array([np.hypot(z[2] - z[0], z[3] - z[1]), z[4], z[5], z[6]])


def built(z, target):
    """What the transmission over a whole turn and the proportions lack, by brute force."""
    g, a, b, r = links(z)
    away = np.sqrt(g * g + a * a - 2 * g * a * np.cos(np.linspace(0, np.pi, 181)))
    cosine = (b * b + r * r - away**2) / (2 * b * r)
    ends = np.maximum(np.abs(cosine[[0, -1]]) - np.cos(target.transmission), 0)
    over = max(np.log(links(z).max() / links(z).min() / target.ratio), 0)
    return 10 * len(target.points) * ((ends**2).sum() + over**2)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("kind", ["free", "timed", "built"])
def test_no_small_change_of_an_end_is_better(kind, seed):
    start, points, side = path(seed)
    timing = start.t[0] if kind == "timed" else None
    asked = (np.radians(50), 2.5) if kind == "built" else (None, np.inf)
    # At the bounds of a full turn and of an unbroken way the derivatives need not vanish.
    turns = kind == "built"
    target = PathTarget(points, np.ones(len(points)), turns, timing, *asked, unbroken=False)
    end = descend(start, target, 3000)
    z, t = end.linkages.dimensions[0], end.t[0]

    def cost(z, t):
        more = built(z, target) if kind == "built" else 0.0
        return measured(z, t, side, points, kind == "timed") + more

    least = cost(z, t)
    assert end.cost[0] == pytest.approx(least, rel=1e-5)
    assert least < cost(start.linkages.dimensions[0], start.t[0])
    for unit in np.eye(9):
        for sign in (1, -1):
            assert cost(z + sign * STRIDE * unit, t) > least * (1 - 1e-6)
    if kind == "timed":
        for sign in (1, -1):
            assert cost(z, t + sign * STRIDE) > least
    if kind == "free":
        pairs = np.column_stack([points.real, points.imag])
        assert least <= refined_from(start.linkages.dimensions[0], side, t, pairs) * (1 + 1e-6)
    if kind == "built":
        assert links(z).max() / links(z).min() < 2.6
        free = descend(start, target._replace(transmission=None), 3000)
        assert end.linkages.least_transmission() > free.linkages.least_transmission()
        assert np.degrees(end.linkages.least_transmission()) > 45


def test_an_end_assembles_between_the_points_too():
    """Of some starts the descent would end at linkages that have to be taken apart."""
    broken = 0
    for seed in range(12):
        start, points, side = path(seed)
        part = start._replace(t=start.t[:, 2:12])
        target = PathTarget(points[2:12] * (1 + 0.3j * np.arange(10)), np.ones(10), False)
        for unbroken in (True, False):
            end = descend(part, target._replace(unbroken=unbroken), 300)
            t = np.linspace(end.t[0].min(), end.t[0].max(), 2000)
            whole = np.isfinite(traced(dyads_of(end.linkages.dimensions[0]), side, t)).all()
            assert whole or not unbroken
            broken += not whole
    assert broken > 0


def test_arcs_between_points_leave_their_chords_by_no_more_than_is_allowed():
    """The curve of the start goes far around where points are left out of a path."""
    pulled = 0
    for seed in range(9):
        start, points, side = path(seed, 32)
        kept = np.r_[0:10, 24:32]
        part, some = start._replace(t=start.t[:, kept]), points[kept]
        most = 0.3 * np.ones((17, 2))
        target = PathTarget(some, np.ones(18), False)
        bulges = []
        for allowed in (None, most):
            end = descend(part, target._replace(allowed=allowed), 400)
            z, t = end.linkages.dimensions[0], end.t[0]
            arc = traced(dyads_of(z), side, np.linspace(t[9], t[10], 2000))
            bulges.append(from_segment(arc, some[9], some[10]).max())
        free, held = bulges
        # A descent that ends farther away says so in its cost.
        assert held < 0.33 or end.cost[0] > (held - 0.3) ** 2
        pulled += free > 0.5 and held < 0.33
    assert pulled > 2


def test_arcs_are_pulled_to_their_chords_as_near_as_scipy_pulls_them():
    """Without the right derivatives the ends cost hundreds of times as much."""
    near = 0
    for seed in range(9):
        start, points, side = path(seed, 32)
        kept = np.r_[0:10, 24:32]
        some, number = points[kept], 18
        allowed = np.full((number - 1, 2), 0.3)
        target = PathTarget(some, np.ones(number), False, unbroken=False, allowed=allowed)
        end = descend(start._replace(t=start.t[:, kept]), target, 400)

        def misses(x, some=some, side=side, number=number):
            z, t = dyads_of(x[:9]), x[9:]
            away = traced(z, side, t) - some
            looks = np.linspace(t[9], t[10], 18)[1:-1]  # as the kernel looks at a long arc
            arc = from_segment(traced(z, side, looks), some[9], some[10])
            every = np.concatenate([away.real, away.imag, 8 * np.maximum(arc - 0.3, 0)])
            return np.where(np.isfinite(every), every, 1e3)

        first = np.concatenate([start.linkages.dimensions[0], start.t[0, kept]])
        with np.errstate(invalid="ignore"):
            best = 2 * least_squares(misses, first, max_nfev=300).cost
        near += end.cost[0] < 3 * best
    assert near >= 7


def test_cranks_keep_turning_fully_and_links_keep_to_their_bounds():
    start, points, _ = path(3)
    line = np.linspace(-1.5, 1.5, len(points)) + 0.001j * points.imag
    for turns in (True, False):
        end = descend(start, PathTarget(line, np.ones(len(line)), turns), 500)
        z = end.linkages.dimensions[0]
        assert not turns or end.linkages.turns_fully(0.99e-4)[0]
        assert (z[4:7] >= 0.01 * (1 - 1e-9)).all()
        assert (z[4:7] <= 40 * (1 + 1e-9)).all()
        assert np.hypot(z[[0, 2, 7]], z[[1, 3, 8]]).max() <= 80 * (1 + 1e-3)


def test_a_linkage_that_does_not_assemble_costs_without_end():
    z = np.array([[0, 0, 10, 0, 1, 1, 1, 0.5, 0.5]])
    start = CurveFit(CrankLinkages(z, np.ones(1)), np.zeros((1, 1)), np.zeros(1))
    end = descend(start, PathTarget(np.array([1j]), np.ones(1), False), 10)
    assert end.cost[0] == np.inf
    assert (end.linkages.dimensions == z).all()
