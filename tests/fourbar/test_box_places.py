"""Places deepest inside boxes, against linkages that are driven finely by other code."""

import numpy as np
import pytest

from burmester.fourbar.box_places import Boxes, places_in_boxes
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.tasks.pose_tolerances import PoseTolerances
from tests.oracles.tolerance_boxes import least_shares
from tests.oracles.witness import random_four_bar, random_poses

LENGTH = 0.7  # that a radian counts as in rows
INF = np.inf


def task(rng, dyads, count):
    """Poses beside those of a linkage, with tolerances of all sizes along either axes."""
    rows = random_poses(dyads, rng, count)
    bounds = rng.choice([0.03, 0.2, INF], size=(count, 3)) * rng.uniform(0.5, 2, (count, 3))
    bounds[np.isinf(bounds).all(axis=1), 0] = 0.1
    axes = np.where(np.isinf(bounds[:, 2]), "fixed", rng.choice(["fixed", "body"], size=count))
    off = rng.uniform(-1.5, 1.5, (count, 3)) * np.where(np.isinf(bounds), 1.0, bounds)
    return rows + off, bounds, axes.tolist()


@pytest.mark.parametrize("second", [RR, PR, RP])
def test_the_deepest_places_are_those_of_a_linkage_that_is_driven(second):
    rng = np.random.default_rng(5)
    seen = []
    for _ in range(4):
        dyads = random_four_bar(rng, second)
        rows, bounds, axes = task(rng, dyads, 6)
        poses = Displacement.from_poses(rows)
        linkage = Linkage(*dyads)
        tolerances = PoseTolerances(bounds[:, :2], bounds[:, 2], tuple(axes))
        boxes = Boxes(
            rows_of(poses, LENGTH),
            tolerances.directions(poses),
            tolerances.bounds * [1, 1, LENGTH],
            LENGTH,
        )
        found = places_in_boxes(LinkageBatch.of([linkage]), boxes)[0]
        on = np.isfinite(found.angle)
        for dyad in dyads:
            assert np.abs(dyad.residual(found[on])).max() < 1e-9
        share = np.where(on[..., None], tolerances.share(found, poses, [1e-9] * 3), INF)
        mine = np.nan_to_num(share, nan=INF).max(axis=-1).min(axis=0)
        driven = least_shares(linkage, rows, bounds, axes, size=2.0)
        assert mine == pytest.approx(driven, rel=1e-5, abs=1e-6)
        seen += mine.tolist()
    assert min(seen) < 0.9
    assert max(seen) > 1.05


def test_an_exact_point_is_met_where_the_rest_is_loose():
    link = Linkage(RR([0, 0], [10, 20], 30.0), RR([70, 5], [45, 25], 50.0))
    rng = np.random.default_rng(2)
    rows = random_poses((link.first, link.second), rng, 5)
    rows[:, 2] += rng.uniform(-0.2, 0.2, 5)
    poses = Displacement.from_poses(rows)
    bounds = np.tile([1e-7, 1e-7, INF], (5, 1))
    boxes = Boxes(rows_of(poses, 30.0), np.tile(np.eye(2), (5, 1, 1)), bounds, 30.0)
    found = places_in_boxes(LinkageBatch.of([link]), boxes)[0]
    away = np.linalg.norm(found.translation - poses.translation, axis=-1)
    assert np.nanmin(away, axis=0) == pytest.approx(np.zeros(5), abs=1e-7)
