"""Boxes and polygons thinner and thinner: the dyads of the segment, or of the point, in the end."""

import numpy as np
import pytest

from burmester import synthesize
from burmester.dyads.minima_within_limits import limited_dyads
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point, Polygon, Segment, box, narrowed
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.thin_regions import without_thin_regions
from tests.oracles.witness import random_four_bar, random_poses, span

WIDTHS = [1e-2, 1e-5, 1e-7, 3e-8, 1e-8, 1e-9, 1e-12, 1e-14, 1e-16, 0.0]  # of the motion


def rough_poses(seed, count=8):
    """Poses near those of a four-bar, their span, and the four-bar's first dyad."""
    rng = np.random.default_rng([11, seed])
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, count, ordered=True)
    size = span(rows)
    return rows + 0.02 * rng.normal(size=rows.shape) * [size, size, 1.0], size, dyads[0]


def corners_of(at, length, width, turn):
    """The corners of a box around a point, turned."""
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return at + np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * [length / 2, width / 2] @ axes


@pytest.mark.parametrize("pivot", ["fixed_pivot", "moving_pivot"])
@pytest.mark.parametrize("turn", [0.0, 0.4])
@pytest.mark.parametrize("both", [False, True])
def test_no_width_of_a_box_loses_its_dyads(pivot, turn, both):
    rows, size, dyad = rough_poses(1)
    poses, at = Displacement.from_poses(rows), np.asarray(getattr(dyad, pivot))
    ends = corners_of(at, 0.5 * size, 0.0, turn)[:2]
    alone = Point(at) if both else Segment(*ends)
    wanted = limited_dyads(poses, limits=Limits(**{pivot: alone}, kinds={"RR"}))
    expected = getattr(wanted.frames.circle_from_canonical(wanted.circles), pivot)
    for share in WIDTHS:
        width = share * size
        corners = corners_of(at, width if both else 0.5 * size, width, turn)
        if turn and share < 1e-11:
            continue  # a polygon without inside is refused, and the message names the segment
        region = Polygon(corners) if turn else box(corners[0], corners[2])
        found = limited_dyads(poses, limits=Limits(**{pivot: region}, kinds={"RR"}))
        assert (found.unsettled, found.lost) == (0, 0)
        places = getattr(found.frames.circle_from_canonical(found.circles), pivot)
        assert len(places) >= len(expected), share
        for place in expected:
            near = np.abs(places - place).max(axis=1).min()
            assert near < 3 * width + 1e-8 * size or share >= 1e-2
        assert (region.distance(places) < 1e-9 * max(size, np.abs(places).max())).all()


def test_a_box_that_is_taken_for_a_segment_has_its_linkages_and_says_so():
    rows, size, dyad = rough_poses(1)
    poses = Displacement.from_poses(rows)
    answers = []
    corners = corners_of(np.asarray(dyad.fixed_pivot), 0.5 * size, 1e-10 * size, 0.0)
    middle = (corners[:2] + corners[:1:-1]) / 2
    for region in (box(corners[0], corners[2]), Segment(*middle)):
        answers.append(synthesize(Task(poses, limits=(Limits(fixed_pivot=region),))))
    thin, segment = answers
    assert [each.code for each in thin.warnings if each.code == "W212"] == ["W212"]
    assert "W212" not in [each.code for each in segment.warnings]
    assert len(thin.dyads) == len(segment.dyads) > 0
    # Near misses, which lie outside the region, come from a search.
    inside = [[e for e in each.linkages if not e.violations] for each in answers]
    assert np.allclose(*([e.error.worst for e in each] for each in inside), rtol=1e-5)


def test_no_region_is_narrowed_into_a_condition_too_many():
    """Five exact poses leave no condition to a pivot: the box stays, and has the dyad."""
    rng = np.random.default_rng([12, 0])
    dyads = random_four_bar(rng)
    poses = Displacement.from_poses(random_poses(dyads, rng, 5, ordered=True))
    at = np.asarray(dyads[0].fixed_pivot)
    limits = Limits(box(at - 1e-10, at + 1e-10), kinds={"RR"})
    frames, _ = CanonicalFrames.of(poses)
    assert isinstance(without_thin_regions(limits, frames, 5).fixed_pivot, Polygon)
    assert isinstance(without_thin_regions(limits, frames, 3).fixed_pivot, Point)
    found = limited_dyads(poses, exact=np.ones(5, bool), limits=limits)
    pivots = found.frames.circle_from_canonical(found.circles).moving_pivot
    assert np.abs(pivots - dyads[0].moving_pivot).max(axis=1).min() < 1e-6


def test_a_thin_region_is_the_segment_through_its_middle():
    thin = narrowed(box((0, 0), (4, 1e-3)), 1e-2)
    assert isinstance(thin, Segment)
    ends = np.array(sorted([thin.start.tolist(), thin.end.tolist()]))
    assert np.allclose(ends, [(0, 5e-4), (4, 5e-4)], rtol=0, atol=1e-15)
    small = narrowed(Segment([1, 1], [1, 1.001]), 1e-2)
    assert isinstance(small, Point)
    assert np.allclose(small.at, [1, 1.0005], rtol=0, atol=1e-15)
    wide = box((0, 0), (4, 1))
    assert narrowed(wide, 1e-2) is wide
    flat = box((2, 3), (2, 7))
    assert isinstance(flat, Segment)
    assert isinstance(box((2, 3), (2, 3)), Point)
