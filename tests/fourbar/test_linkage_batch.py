"""Stacks of linkages of mixed kinds, against their dyads one by one and difference quotients."""

import itertools

import numpy as np
import pytest

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import concatenate

KINDS = (RR, PR, RP)
PAIRS = list(itertools.product(KINDS, KINDS))


def a_dyad(kind, rng):
    a, b = rng.normal(size=(2, 2))
    if kind is RR:
        return RR(a, b, rng.uniform(0.3, 2.0))
    if kind is PR:
        return PR(rng.uniform(-3, 3), rng.normal(), b)
    return RP(a, rng.uniform(-3, 3), rng.normal())


def all_pairs(rng, times=2):
    return [Linkage(a_dyad(a, rng), a_dyad(b, rng)) for a, b in PAIRS * times]


def some_places(rng, count, number):
    return Displacement(rng.normal(size=(count, number, 2)), rng.uniform(-6, 6, (count, number)))


def dyad_of(row, kind):
    """The dyad that a batch's five numbers stand for, as the docstring of LinkageBatch says."""
    if kind is RR:
        return RR(row[:2], row[2:4], row[4])
    if kind is PR:
        return PR(row[0], row[1], row[2:4])
    return RP(row[:2], row[2], row[3])


def equation(dyad, places):
    """Met exactly where the dyad is: the distance for lines, (distance² - r²) / (2 r) for RR."""
    if isinstance(dyad, RR):
        far = dyad.residual(places) + dyad.radius
        return (far**2 - dyad.radius**2) / (2 * dyad.radius)
    return dyad.residual(places)


def at(places, k):
    return Displacement(places.translation[k], places.angle[k])


def test_distances_of_all_dyads_at_once_are_those_of_each():
    rng = np.random.default_rng(8)
    linkages = all_pairs(rng)
    for shape in ((), (7,)):
        poses = Displacement(rng.normal(size=(*shape, 2)), rng.uniform(-6, 6, shape))
        distance = LinkageBatch.of(linkages).distances(poses)
        for k, linkage in enumerate(linkages):
            for side, dyad in enumerate((linkage.first, linkage.second)):
                assert np.allclose(distance[k, side], dyad.residual(poses), rtol=0, atol=1e-14)


def test_equations_of_every_pair_of_kinds():
    rng = np.random.default_rng(0)
    linkages = all_pairs(rng)
    places = some_places(rng, len(linkages), 7)
    jacobians = LinkageBatch.of(linkages).jacobians(places)
    for k, linkage in enumerate(linkages):
        for side, dyad in enumerate((linkage.first, linkage.second)):
            assert np.allclose(
                jacobians.residual[k, side], equation(dyad, at(places, k)), atol=1e-13
            )


def test_forces_are_gradients_of_the_equations_by_the_place():
    rng = np.random.default_rng(1)
    linkages = all_pairs(rng)
    places = some_places(rng, len(linkages), 5)
    force = LinkageBatch.of(linkages).jacobians(places).force
    h = 1e-6
    for k, linkage in enumerate(linkages):
        here = at(places, k)
        for side, dyad in enumerate((linkage.first, linkage.second)):
            for axis in range(3):
                step = h * np.eye(3)[axis]
                up, down = (
                    equation(
                        dyad,
                        Displacement(here.translation + s * step[:2], here.angle + s * step[2]),
                    )
                    for s in (1, -1)
                )
                slope = (up - down) / (2 * h)
                assert np.allclose(force[k, side, :, axis], slope, rtol=1e-7, atol=1e-8)


def test_on_the_linkage_the_force_is_the_dyads_own_gradient():
    rng = np.random.default_rng(2)
    linkages, rows = [], []
    for _ in range(40):  # dyads through a place
        place = Displacement(rng.normal(size=2), rng.uniform(-3, 3))
        c, m = rng.normal(size=2), rng.normal(size=2)
        normal = rng.uniform(-3, 3)
        circle = RR(c, m, np.linalg.norm(place.act(m) - c))
        rail = PR(normal, place.act(m) @ [np.cos(normal), np.sin(normal)], m)
        body = place.inverse().act(c)
        slot = RP(c, normal, body @ [np.cos(normal), np.sin(normal)])
        chosen = rng.permutation([0, 1, 2])[:2]
        linkages.append(Linkage(*((circle, rail, slot)[i] for i in chosen)))
        rows.append([*place.translation, place.angle])
    rows = np.array(rows)
    places = Displacement(rows[:, None, :2], rows[:, None, 2])
    jacobians = LinkageBatch.of(linkages).jacobians(places)
    assert np.abs(jacobians.residual).max() < 1e-13
    for k, linkage in enumerate(linkages):
        for side, dyad in enumerate((linkage.first, linkage.second)):
            assert np.allclose(jacobians.force[k, side], dyad.gradient(at(places, k)), atol=1e-12)


def test_derivatives_by_the_dimensions():
    """At places on the linkage, where the scale of RR's equation does not matter."""
    rng = np.random.default_rng(3)
    h = 1e-6
    for kind in KINDS:
        for _ in range(10):
            place = Displacement(rng.normal(size=(1, 2)), rng.uniform(-3, 3, 1))
            dyad = a_dyad(kind, rng)
            miss = dyad.residual(place)[0]  # moved onto the place
            if kind is RR:
                dyad = RR(dyad.fixed_pivot, dyad.moving_pivot, dyad.radius + miss)
            elif kind is PR:
                dyad = PR(dyad.normal_angle, dyad.offset + miss, dyad.moving_pivot)
            else:
                dyad = RP(dyad.fixed_pivot, dyad.normal_angle, dyad.offset + miss)
            for side in (0, 1):
                other = RR([0.3, 0.1], [1.0, 2.0], 1.0)
                pair = (dyad, other) if side == 0 else (other, dyad)
                batch = LinkageBatch.of([Linkage(*pair)])
                both = Displacement(place.translation[None], place.angle[None])
                slope = batch.jacobians(both).by_dimension[0, side, 0]
                row = batch.dimensions[0, side]
                used = DIMENSIONS if kind is RR else DIMENSIONS - 1
                for j in range(used):
                    step = h * np.eye(DIMENSIONS)[j]
                    up, down = (dyad_of(row + s * step, kind).residual(place)[0] for s in (1, -1))
                    assert np.isclose(slope[j], (up - down) / (2 * h), rtol=1e-6, atol=1e-8)
                assert (slope[used:] == 0).all()


def test_seen_in_other_frames_and_back():
    """A linkage meets the same places, seen in the frames, and everything comes back."""
    rng = np.random.default_rng(6)
    linkages = all_pairs(rng)
    frames = CanonicalFrames(np.array([2.0, -1.0]), np.array([0.7, 3.0]), np.array(2.5))
    places = some_places(rng, len(linkages), 6)
    batch = LinkageBatch.of(linkages)
    seen = batch.to_canonical(frames)
    there = seen.jacobians(frames.to_canonical(places)).residual
    assert np.allclose(2.5 * there, batch.jacobians(places).residual, atol=1e-12)
    assert (there != batch.jacobians(places).residual).any()
    assert np.allclose(seen.from_canonical(frames).dimensions, batch.dimensions, atol=1e-13)
    assert (seen.from_canonical(frames).kinds == batch.kinds).all()


def test_alike_are_all_linkages_once_in_groups_of_one_kind():
    rng = np.random.default_rng(7)
    linkages = [Linkage(a_dyad(a, rng), a_dyad(b, rng)) for a, b in PAIRS * 3]
    order = rng.permutation(len(linkages))
    linkages = [linkages[k] for k in order]
    places = some_places(rng, len(linkages), 3)
    met = []
    for index, group in LinkageBatch.of(linkages).alike():
        met += index.tolist()
        for side in ("first", "second"):
            dyads = getattr(group, side)
            for n, k in enumerate(index):
                own = getattr(linkages[k], side)
                assert type(dyads) is type(own)
                here = at(places, k)
                assert np.allclose(dyads[n].residual(here), own.residual(here), atol=1e-14)
    assert sorted(met) == list(range(len(linkages)))


def test_one_linkage_exchanged_picked_and_joined():
    rng = np.random.default_rng(8)
    linkages = all_pairs(rng, 1)
    batch = LinkageBatch.of(linkages)
    places = some_places(rng, 1, 4)
    for k, linkage in enumerate(linkages):
        back, swapped = batch.linkage(k), batch.exchanged().linkage(k)
        for mine, its in ((back.first, linkage.first), (back.second, linkage.second)):
            assert np.allclose(mine.residual(places), its.residual(places), atol=1e-14)
        for mine, its in ((swapped.first, linkage.second), (swapped.second, linkage.first)):
            assert np.allclose(mine.residual(places), its.residual(places), atol=1e-14)
    picked = batch[np.array([5, 2])]
    assert (picked.dimensions == batch.dimensions[[5, 2]]).all()
    both = concatenate([picked, batch[:1]])
    assert [type(both.linkage(k).first) for k in range(3)] == [
        type(linkages[k].first) for k in (5, 2, 0)
    ]
    assert (both.dimensions[2] == batch.dimensions[0]).all()


def test_a_coupler_that_cannot_turn_has_no_place_in_a_stack():
    with pytest.raises(TypeError):
        LinkageBatch.of([Linkage(PP(0.3), RR([0, 0], [1, 0], 1.0))])
