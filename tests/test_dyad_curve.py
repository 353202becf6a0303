"""Burmester's curve of four poses: whole, without gaps, each dyad once."""

import numpy as np
import pytest
from scipy.optimize import brentq

from burmester.curve import dyad_curve
from burmester.displacement import Displacement
from burmester.errors import InputError
from burmester.exact import dyads_of_five
from tests.witness import random_four_bar, random_poses, span


def random_task(rng, kind):
    if kind == "any":
        return rng.normal(size=(4, 3)) * [1, 1, 1.5]
    if kind == "small turn":
        return rng.normal(size=(4, 3)) * [1, 1, 0.05]
    return random_poses(random_four_bar(rng), rng, 4)


def arms(rows, dyads):
    """|R m + d - c| over the poses, (n, 4), written out."""
    c, m = dyads.fixed_pivot @ [1, 1j], dyads.moving_pivot @ [1, 1j]
    d, turn = rows[:, :2] @ [1, 1j], np.exp(1j * rows[:, 2])
    return np.abs(m[:, None] * turn + d - c[:, None])


def on_sphere(points, centre, size):
    """Points as directions (X, Y, size), the metric in which infinity is a place like others."""
    v = np.column_stack([points - centre, np.full(len(points), size)])
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def apart(a, b):
    """Chordal distance between directions up to sign."""
    return np.minimum(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))


@pytest.mark.parametrize("kind", ["any", "small turn", "four-bar"])
@pytest.mark.parametrize("seed", range(25))
def test_every_sample_meets_the_four_poses(kind, seed):
    rng = np.random.default_rng(seed)
    rows = random_task(rng, kind)
    curve = dyad_curve(Displacement.from_poses(rows))
    assert curve.components
    for component in curve.components:
        lengths = arms(rows, component)
        allowed = 1e-9 * np.maximum(lengths.max(axis=1), span(rows))
        assert (np.ptp(lengths, axis=1) < allowed).all()
        assert np.allclose(lengths.mean(axis=1), component.radius, rtol=1e-9)


def determinant(rows, x, y):
    """Zero where (x, y) is a centre point: four circle equations linear in m and s."""
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    p, q = rows[:, 0] - x, rows[:, 1] - y
    table = np.stack([cos * p + sin * q, cos * q - sin * p, np.ones(4), p * p + q * q], axis=-1)
    return np.linalg.det(table)


@pytest.mark.parametrize("seed", range(12))
def test_centre_points_found_by_brute_force_are_on_it(seed):
    rng = np.random.default_rng(seed)
    rows = random_task(rng, "any")
    curve = dyad_curve(Displacement.from_poses(rows))
    sampled = np.vstack([component.fixed_pivot for component in curve.components])
    middle, size = np.median(sampled, axis=0), span(rows)
    known = on_sphere(sampled, middle, size)
    step = np.concatenate(
        [
            apart(v, np.roll(v, 1, axis=0))
            for v in (on_sphere(c.fixed_pivot, middle, size) for c in curve.components)
        ]
    ).max()
    found = []
    for _ in range(60):
        origin, turn = middle + size * rng.normal(size=2), rng.uniform(0, np.pi)
        along = np.array([np.cos(turn), np.sin(turn)])

        def on(t, origin=origin, along=along):
            return determinant(rows, *(origin + t * along))

        grid = np.linspace(-4 * size, 4 * size, 200)
        values = [on(t) for t in grid]
        for k in np.flatnonzero(np.diff(np.sign(values))):
            found.append(origin + brentq(on, grid[k], grid[k + 1]) * along)
    assert len(found) > 20
    for place in on_sphere(np.array(found), middle, size):
        assert apart(place, known).min() < 0.75 * step


@pytest.mark.parametrize("seed", range(15))
def test_dyads_of_a_fifth_pose_are_on_it(seed):
    rng = np.random.default_rng(seed)
    rows = random_poses(random_four_bar(rng), rng, 5)
    curve = dyad_curve(Displacement.from_poses(rows[:4]), samples=2000)
    five = dyads_of_five(Displacement.from_poses(rows))
    real = five.dyads[five.real]
    centre, size = rows[:, :2].mean(axis=0), span(rows)
    everything = np.vstack([c.fixed_pivot for c in curve.components])
    bodies = np.vstack([c.moving_pivot for c in curve.components])
    for c, m in zip(real.fixed_pivot, real.moving_pivot, strict=True):
        fixed = apart(on_sphere(c[None], centre, size), on_sphere(everything, centre, size))
        moving = apart(on_sphere(m[None], 0, size), on_sphere(bodies, 0, size))
        assert np.hypot(fixed, moving).min() < 0.05


@pytest.mark.parametrize("kind", ["any", "four-bar"])
@pytest.mark.parametrize("seed", range(10))
def test_neighbours_are_evenly_spaced_and_nothing_comes_twice(kind, seed):
    rng = np.random.default_rng(seed)
    curve = dyad_curve(Displacement.from_poses(random_task(rng, kind)))
    frames, places = curve.frames, []
    for component in curve.components:
        fixed = on_sphere(component.fixed_pivot, frames.fixed_origin, float(frames.length))
        moving = on_sphere(component.moving_pivot, frames.moving_origin, float(frames.length))

        def gap(i, j, fixed=fixed, moving=moving):
            return np.hypot(apart(fixed[i], fixed[j]), apart(moving[i], moving[j]))

        here = np.arange(len(fixed))
        step = gap(here, np.roll(here, 1))
        assert step.max() < 1.5 * np.median(step)  # closed: the last is next to the first
        assert step.min() > 0.3 * np.median(step)
        places.append(np.hstack([fixed, moving]))
    everything = np.vstack(places)
    for k, place in enumerate(everything):
        fixed = apart(place[:3], everything[:, :3])
        moving = apart(place[3:], everything[:, 3:])
        others = np.delete(np.hypot(fixed, moving), k)
        assert others.min() > 1e-6


def test_exchanging_frames_exchanges_the_curves():
    rng = np.random.default_rng(4)
    poses = Displacement.from_poses(rng.normal(size=(4, 3)))
    one, other = dyad_curve(poses, 3000), dyad_curve(poses.inverse(), 3000)
    centres = np.vstack([c.fixed_pivot for c in one.components])
    circles = np.vstack([c.moving_pivot for c in other.components])
    for place in on_sphere(centres[::50], 0, 1.0):
        assert apart(place, on_sphere(circles, 0, 1.0)).min() < 0.01


SPECIAL = {
    "a pose twice": [(0, 0, 0), (1, 0, 0.3), (1, 0, 0.3), (2, 1, 0.9)],
    "a translation": [(0, 0, 0.2), (1, 0, 0.2), (1, 2, 0.2), (3, 1, 0.2)],
    "a turn": [(0, 0, 0), (0, 0, 0.3), (0, 0, 1.1), (0, 0, 2)],
}


@pytest.mark.parametrize("name", SPECIAL)
def test_poses_without_a_curve_are_refused_in_words(name):
    with pytest.raises(InputError, match="do not determine") as caught:
        dyad_curve(Displacement.from_poses(SPECIAL[name]))
    assert caught.value.code == "E124"
    assert caught.value.why
    assert caught.value.help


def test_the_number_of_poses_is_checked():
    with pytest.raises(InputError, match="not 5") as caught:
        dyad_curve(Displacement.from_poses(np.zeros((5, 3))))
    assert caught.value.code == "E121"
