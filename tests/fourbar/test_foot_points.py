"""Nearest places of couplers, against sweeps of the linkage and a walk that shares no code."""

import itertools

import numpy as np
import pytest

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import foot_points, newton_steps
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from tests.oracles.hard_tasks import assembled
from tests.oracles.random_dyads import random_dyad

LENGTH = 0.7  # what a radian counts as
PAIRS = list(itertools.product((RR, PR, RP), repeat=2))


def a_stretch(pair, rng):
    """A linkage, and rows (n, 3) close together along one of its assemblies."""
    while True:
        linkage = Linkage(random_dyad(pair[0], rng), random_dyad(pair[1], rng))
        drive = rng.uniform(-3, 3) + np.linspace(0, 0.2, 2001)
        d, phi = assembled(linkage.first, linkage.second, drive)
        rows = np.stack([d.real, d.imag, LENGTH * np.unwrap(phi)], axis=-1)[0]
        way = np.linalg.norm(np.diff(rows, axis=0), axis=1)
        if np.isfinite(rows).all() and way.max() < 2e-3 and way.sum() > 0.1:
            return linkage, rows


@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: f"{pair[0].__name__}-{pair[1].__name__}")
def test_foot_points_are_the_nearest_places_of_a_sweep(pair):
    rng = np.random.default_rng(10)
    for _ in range(5):
        linkage, rows = a_stretch(pair, rng)
        middle = len(rows) // 2
        target = rows[middle] + 0.01 * rng.normal(size=3)
        away = np.linalg.norm(rows - target, axis=1)
        nearest = away.argmin()
        if not 0 < nearest < len(rows) - 1:
            continue
        foot = foot_points(LinkageBatch.of([linkage]), rows[None, None, middle], target, LENGTH)
        step = np.linalg.norm(np.diff(rows, axis=0), axis=1).max()
        assert np.linalg.norm(foot[0, 0] - rows[nearest]) < 2 * step
        assert np.linalg.norm(foot[0, 0] - target) <= away[nearest] + 1e-12


@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: f"{pair[0].__name__}-{pair[1].__name__}")
def test_steps_square_the_distance_from_the_foot_point(pair):
    """Along the linkage a step with a wrong curvature would only shorten the distance."""
    rng = np.random.default_rng(11)
    fall = []
    for _ in range(30):
        linkage, rows = a_stretch(pair, rng)
        batch, middle = LinkageBatch.of([linkage]), len(rows) // 2
        # Far enough that the curvature counts, and near enough for it to be positive.
        target = rows[middle] + 0.1 * rng.normal(size=3)
        end = foot_points(batch, rows[None, None, middle], target, LENGTH)[0, 0]
        if not (np.isfinite(end).all() and np.linalg.norm(end - rows[middle]) < 0.3):
            continue
        way, left = rng.normal(size=3), []
        for h in (1e-4, 1e-5):
            start, _ = newton_steps(batch, (end + h * way)[None, None], None, LENGTH, steps=9)
            there, size = newton_steps(batch, start, target, LENGTH)
            assert size[0, 0] == pytest.approx(np.abs(there - start).max())
            left.append(np.linalg.norm(there[0, 0] - end))
        fall.append(left[0] / left[1])
    assert len(fall) > 5
    assert np.median(fall) > 60  # 100 for the square of the distance, 10 for a share of it


def test_straight_ahead_is_the_shortest_way_onto_the_linkage():
    """Each step goes along the normals: across the direction in which the coupler can move."""
    rng = np.random.default_rng(12)
    for pair in PAIRS:
        linkage, rows = a_stretch(pair, rng)
        batch, middle = LinkageBatch.of([linkage]), len(rows) // 2
        along = rows[middle + 1] - rows[middle - 1]
        start = rows[middle] + 1e-4 * rng.normal(size=3)
        there, _ = newton_steps(batch, start[None, None], None, LENGTH, steps=8, close=1e-14)
        away = np.linalg.norm(rows - there[0, 0], axis=1).min()
        assert away < np.linalg.norm(along)
        shift = there[0, 0] - start
        assert abs(shift @ along) < 1e-2 * np.linalg.norm(shift) * np.linalg.norm(along)
