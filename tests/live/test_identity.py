"""Which linkage of a new answer is which of the one before: a card keeps its linkage."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from burmester import PP, PR, RP, RR, read_task, synthesize
from burmester.live.identity import match_ids, snapshot
from burmester.web.data import scene_of


@cache
def answer(name):
    return synthesize(read_task(name))


def moved(dyad, by, turn):
    """A dyad with its pivots elsewhere by so much; a line with the other one of its normals."""
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot + by, dyad.moving_pivot - by, dyad.radius)
    if isinstance(dyad, PR):
        return PR(dyad.normal_angle + np.pi, -dyad.offset - by[0], dyad.moving_pivot + by)
    if isinstance(dyad, RP):
        return RP(dyad.fixed_pivot + by, dyad.normal_angle - np.pi, -dyad.offset + by[1])
    assert isinstance(dyad, PP)
    return PP(dyad.angle + turn)


def elsewhere(linkage, by, turn=0.0):
    """A linkage that was moved, its dyads in the other order."""
    dyads = [replace(each, dyad=moved(each.dyad, by, turn)) for each in reversed(linkage.dyads)]
    return replace(linkage, dyads=tuple(dyads))


@pytest.mark.parametrize(
    "name", ["case:ge2012-exact", "case:motiongen-rrrp", "case:motiongen-prpr"]
)
def test_a_linkage_goes_on_as_the_one_where_it_was(name):
    found = answer(name)
    scene, rng = scene_of(found), np.random.default_rng(0)
    order = rng.permutation(len(found.linkages))
    near = [
        replace(elsewhere(found.linkages[k], 1e-5 * scene * rng.uniform(-1, 1, 2)), id=f"B{k}")
        for k in order
    ]
    was = match_ids(snapshot(near), found)
    assert was == {each.id: {"id": f"B{k}", "moved": 0} for k, each in enumerate(found.linkages)}
    # Farther off, none of them is the same.
    far = [elsewhere(each, 5 * scene * np.ones(2), 1.0) for each in found.linkages]
    assert match_ids(snapshot(far), found) == {}
    assert match_ids([], found) == {}


def test_how_far_a_search_moved_a_linkage_is_told_in_its_size():
    found = answer("case:ge2012-exact")
    scene, one = scene_of(found), found.linkages[0]

    def size(linkage):
        dyads = [each.dyad for each in linkage.dyads]
        parts = [np.abs([*each.fixed_pivot, *each.moving_pivot, each.radius]) for each in dyads]
        return max(scene, *(part.max() for part in parts))

    near = elsewhere(one, np.array([0.01 * size(one), 0.0]))
    told = match_ids(snapshot([near]), found)[one.id]
    assert told["moved"] == pytest.approx(0.01 * size(one) / size(near), abs=6e-5)


def test_where_it_was_seen_last_counts_for_what_is_told():
    """It goes on by where it stands, and tells how far that is from what the card said."""
    found = answer("case:ge2012-exact")
    one, by = found.linkages[0], np.array([0.01 * scene_of(found), 0.0])
    seen = replace(elsewhere(one, 5 * by), id="B")
    told = match_ids(snapshot([replace(one, id="B")], {"B": seen}), found)
    assert told == {one.id: {"id": "B", "moved": pytest.approx(5 * 0.01, rel=0.5)}}


def test_a_linkage_with_two_candidates_is_the_nearer_one():
    found = answer("case:ge2012-exact")
    size, one = scene_of(found), found.linkages[0]
    by = np.array([0.004 * size, 0.0])
    near = replace(elsewhere(one, by), id="A")
    nearer = replace(elsewhere(one, -0.6 * by), id="B")
    for both in ([near, nearer], [nearer, near]):
        was = match_ids(snapshot(both), found)
        assert was[one.id]["id"] == "B"
        assert "A" not in {each["id"] for each in was.values()}
