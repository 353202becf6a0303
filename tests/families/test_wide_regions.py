"""Regions far wider than the motion: what there is near it is found as in narrow ones."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from benchmarks.few_poses import (
    ENOUGH,
    KEPT_WIDE,
    WIDE_NEAR,
    angle_of,
    compared_wide,
    kept,
    pivots_of,
    task_of,
)

from burmester import synthesize
from burmester.families.pivot_freedom import ZONES, PivotFreedom
from burmester.geometry.regions import Line, Polygon, Segment, box
from tests.oracles.few_pose_tasks import FewPoseTask, few_pose_task
from tests.oracles.few_poses import span_of
from tests.samples import some_of

SAME = 1.0  # degrees; an angle that is less by no more is as good
DENTED = Polygon(np.array([(-30, -8), (40, -9), (40, 30), (6, 30), (5, 2), (-2, 30), (-30, 30)]))
AROUND = box((-2, -1.5), (1, 1.5))


def recommended(rows, boxes):
    """The least transmission angle of the recommended linkage, up to ENOUGH, by the witness."""
    given = FewPoseTask("wide", np.asarray(rows), boxes, 0.0)
    usable = synthesize(task_of(given)).usable
    return min(angle_of(given, pivots_of(usable[0].linkage)), ENOUGH) if usable else 0.0


def test_boxes_of_forty_spans_that_had_no_linkage():
    rows = np.array([(0, 0, 0), (2.21, 6.72, 24.42), (2.88, 9.58, 68.54)]) * [1, 1, np.pi / 180]
    wide = np.array([(-200.0, -200.0), (200.0, 200.0)])
    assert recommended(rows, ((wide, wide),)) > ENOUGH - SAME


def test_boxes_of_thirty_spans_whose_linkages_have_moving_pivots_far_from_the_body():
    rows = np.array(
        [
            (0.0, 0.0, 0.0),
            (1.3370277681364595, -9.890349263088618, 55.31534837638487),
            (-4.260439634096747, 2.9030033286170376, 73.63787958381462),
        ]
    ) * [1, 1, np.pi / 180]
    fixed = np.array([(-130.90811, -249.55299), (313.15597, 194.51109)])
    moving = np.array([(-186.06562, -114.6263), (61.79647, 133.23579)])
    known = np.array([-43.377 - 36.1695j, -176.151 - 15.4815j])
    known = np.append(known, [-4.0808 - 1.3935j, -106.7498 + 83.6634j])
    given = FewPoseTask("wide", rows, ((fixed, moving),), 0.0)
    assert angle_of(given, known) == pytest.approx(85.35, abs=0.02)
    assert recommended(rows, ((fixed, moving),)) > ENOUGH - SAME


@pytest.mark.parametrize("seed", [31, 35])
def test_a_wider_box_is_never_worse(seed):
    """Three and four poses; each box holds the one before, and lies to another side of it."""
    given = few_pose_task(seed)
    span, reached = span_of(given.rows), []
    rng = np.random.default_rng(seed)
    fixed, moving = np.array(given.boxes[0])
    for reach in (0.0, 3.0, 12.0, 100.0):
        aside = reach * span * rng.uniform(0.4, 1.0, (2, 2))
        fixed, moving = fixed + aside * [[-1], [1]], moving + aside * [[-1], [1]]
        reached.append(recommended(given.rows, ((fixed, moving),)))
    assert all(wider > narrow - SAME for narrow, wider in pairwise(reached)), reached
    assert reached[0] > 20


@pytest.mark.parametrize("seed", some_of(sorted(kept(KEPT_WIDE)), 4))
def test_as_good_as_brute_force(seed):
    """A sample of the campaign: boxes, polygons and segments of 3 to 300 spans."""
    _, ours, _, theirs, _ = compared_wide(seed, kept(KEPT_WIDE)[seed])
    assert ours > min(theirs, ENOUGH) - WIDE_NEAR


@pytest.mark.parametrize(
    "region",
    [
        box((-900, -40), (30, 700)),
        DENTED,
        Segment(np.array([-70.0, 3]), np.array([400.0, -11])),
        Line(np.array([9.0, 3]), np.array([9.0, 4])),
        box((-1, -1), (0.5, 1)),
        box((500, 80), (900, 300)),
    ],
    ids=["box", "dented", "segment", "line", "small", "far"],
)
def test_zones_hold_what_they_cut_from_a_region_and_each_gets_its_share(region):
    freedom = PivotFreedom.of(region, AROUND, np.zeros(2), 1.0)
    zones = freedom.zones
    points = freedom.draw(600, np.random.default_rng(0))
    assert region.distance(points).max() < 1e-9
    ends = region.corners()
    if ends is None:  # the line is as good as a long segment
        ends = region.start + np.array([[-1e4], [1e4]]) * (region.end - region.start)
    shape = shapely.Polygon(ends) if isinstance(region, Polygon) else shapely.LineString(ends)
    middle, half = np.array([-0.5, 0]), np.array([1.5, 1.5])
    cuts = [
        shape.intersection(shapely.box(*middle - 2**k * half, *middle + 2**k * half)).bounds
        for k in range(12)
    ]
    for low, high in zones:
        assert any(
            np.allclose(np.append(low, high), cut) for cut in cuts if len(cut) and cut[0] == cut[0]
        )
        inside = ((points >= low - 1e-9) & (points <= high + 1e-9)).all(axis=1)
        assert np.count_nonzero(inside) >= 600 // len(zones)
    assert len(zones) <= ZONES


def test_what_lies_near_does_not_depend_on_how_far_a_region_reaches():
    near = [
        PivotFreedom.of(box((-side, -side), (side, side)), AROUND, np.zeros(2), 1.0).zones[:4]
        for side in (90.0, 9000.0)
    ]
    assert np.allclose(*near)
    small = PivotFreedom.of(box((-1, -1), (0.5, 1)), AROUND, np.zeros(2), 1.0)
    assert np.array_equal(small.zones, [[(-1, -1), (0.5, 1)]])
