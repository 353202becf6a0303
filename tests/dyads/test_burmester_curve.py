"""Burmester's curve against brute force: all of it, in one piece or two, also for special poses.

The witness here shares nothing with the solver: a fixed pivot belongs to the curve where the
4 x 4 determinant of its circle equations vanishes, and its moving pivot is their solution.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from burmester.dyads.burmester_curve import dyad_curve
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from tests.oracles.witness import random_four_bar, random_poses
from tests.samples import samples


def curve_of(rows, samples=400):
    return dyad_curve(Displacement.from_poses(rows), samples)


def circle_equations(rows, c):
    """Rows [2 Rᵀ(d - c), 1, |d|² - 2 c·d] that multiply (m, s, 1), shape (..., 4, 4)."""
    x, y, angle = rows.T
    cos, sin = np.cos(angle), np.sin(angle)
    cx, cy = np.asarray(c)[..., :1], np.asarray(c)[..., 1:]
    p, q = x - cx, y - cy
    known = x * x + y * y - 2 * (x * cx + y * cy)
    table = 2 * (cos * p + sin * q), 2 * (cos * q - sin * p), np.ones_like(known), known
    return np.stack(table, axis=-1)


def brute_force(rows, rng, origin, size, lines):
    """Dyads (k, 2), (k, 2) whose fixed pivots are on random lines, out to infinity."""
    scaled = (rows - [*origin, 0]) / [size, size, 1]
    fixed, moving = [], []
    for _ in range(lines):
        turn = rng.uniform(0, np.pi)
        along = np.array([np.cos(turn), np.sin(turn)])
        start = np.tan(rng.uniform(-1.3, 1.3)) * np.array([-along[1], along[0]])

        def on(angle, start=start, along=along):
            c = start + np.multiply.outer(np.tan(angle), along)
            return np.linalg.det(circle_equations(scaled, c)) * np.cos(angle) ** 3

        grid = np.linspace(-1.569, 1.569, 300)
        values = on(grid)
        for k in np.flatnonzero(values[1:] * values[:-1] < 0):
            c = start + np.tan(brentq(on, grid[k], grid[k + 1], xtol=1e-15)) * along
            m1, m2, _, scale = np.linalg.svd(circle_equations(scaled, c))[2][3]
            if abs(scale) > 1e-9 * np.hypot(m1, m2):  # else a slider, not an RR dyad
                fixed.append(origin + size * c)
                moving.append(size * np.array([m1, m2]) / scale)
    return np.array(fixed), np.array(moving)


def places(fixed, moving, frames):
    """Both pivots as directions (X, Y, L), (n, 2, 3)."""
    pairs = ((fixed, frames.fixed_origin), (moving, frames.moving_origin))
    v = [np.column_stack([x - o, np.full(len(x), frames.length)]) for x, o in pairs]
    return np.stack([x / np.linalg.norm(x, axis=1, keepdims=True) for x in v], axis=1)


def apart(a, b):
    """Chordal distance of dyads, pivots being directions up to sign."""
    near = np.minimum(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))
    return np.hypot(near[..., 0], near[..., 1])


def samples_of(curve):
    return [places(c.fixed_pivot, c.moving_pivot, curve.frames) for c in curve.components]


def degrees(*rows):
    return np.array(rows, dtype=float) * [1, 1, np.pi / 180]


def pinned(c, m, angle):
    """The pose that carries the point m of M to the point c of F."""
    origin = complex(*c) - np.exp(1j * angle) * complex(*m)
    return [origin.real, origin.imag, angle]


CARDAN = np.array([[2 * np.cos(t), 0, -t] for t in (0.3, 0.9, 1.4, 2.5)])
CARDAN_BACK = np.column_stack(
    [
        Displacement.from_poses(CARDAN).inverse().translation,
        Displacement.from_poses(CARDAN).inverse().angle,
    ]
)
# Poses whose curve is special, and in how many loops it comes.
SPECIAL = {
    "mirror symmetry: a line and a circle": (
        degrees((-2, 0.3, -40), (-1, 1, -15), (1, 1, 15), (2, 0.3, 40)),
        2,
    ),
    "mirror symmetry, poles on the circle": (
        degrees((-2, 1, -10), (-1, 1.5, -80), (1, 1.5, 80), (2, 1, 10)),
        2,
    ),
    "a straight line, turning steadily": (
        degrees((0, 0, 0), (1, 0, 10), (2, 0, 20), (3, 0, 30)),
        2,
    ),
    "rolling": (np.array([[t, 0, -t] for t in (0, 0.5, 1, 1.5)]), 2),
    "orientations in pairs: a hyperbola": (
        degrees((0, 0, 0), (1, 0.2, 0), (2, 1, 60), (3, -1, 60)),
        1,
    ),
    "half turns": (degrees((0, 0, 0), (1, 0.3, 180), (2, -1, 0), (3, 0.5, 180)), 1),
    "quarter turns": (degrees((0, 0, 0), (1, 0.3, 180), (2, -1, 90), (3, 0.5, 270)), 2),
    "one orientation thrice: a circle": (
        degrees((0, 0, 0), (1, 0.2, 0), (2, 1, 0), (3, -1, 60)),
        1,
    ),
    "insert, turn, withdraw": (degrees((0, 1, 0), (0, 0, 0), (3, 0, 90), (3, 1, 90)), 2),
    "insert, turn, withdraw along the body": (
        degrees((0, 0, 0), (0, 1, 0), (2, 1, 90), (3, 1, 90)),
        2,
    ),
    "two sliders": (CARDAN, 1),
    "two sliders, backwards": (CARDAN_BACK, 1),
    "two turns about one point": (
        np.array(
            [
                pinned((1, 2), (0.5, 0.1), 0.0),
                pinned((1, 2), (0.5, 0.1), 0.8),
                pinned((1, 2), (-1.5, 0.7), 0.3),
                pinned((1, 2), (-1.5, 0.7), 1.7),
            ]
        ),
        2,
    ),
}


def assert_whole(rows, curve, rng, lines):
    """Each brute-force dyad is next to a sample, and each sample next to its neighbours."""
    samples = samples_of(curve)
    for loop in samples:
        steps = apart(loop, np.roll(loop, 1, axis=0))
        assert steps.max() < 1.1 * curve.spacing
    frames = curve.frames
    fixed, moving = brute_force(rows, rng, frames.fixed_origin, float(frames.length), lines)
    assert len(fixed) >= lines // 2
    everything = np.concatenate(samples)
    nearest = apart(places(fixed, moving, frames)[:, None], everything).min(axis=1)
    assert nearest.max() < 0.6 * curve.spacing


def test_every_sample_of_two_hundred_tasks_meets_the_four_poses():
    rng = np.random.default_rng(0)
    for _ in samples(200, 30):
        rows = np.column_stack([rng.normal(size=(4, 2)) * 3, rng.uniform(-3.1, 3.1, 4)])
        size = np.ptp(rows[:, :2], axis=0).max()
        for dyads in curve_of(rows, 100).components:
            c, m = dyads.fixed_pivot @ [1, 1j], dyads.moving_pivot @ [1, 1j]
            at = m[:, None] * np.exp(1j * rows[:, 2]) + rows[:, :2] @ [1, 1j]
            miss = np.abs(np.abs(at - c[:, None]) - dyads.radius[:, None]).max(axis=1)
            assert (miss < 1e-11 * np.maximum(size, dyads.radius)).all()


@pytest.mark.parametrize("seed", range(10))
def test_the_whole_curve_of_any_poses(seed):
    rng = np.random.default_rng(seed)
    rows = np.column_stack([rng.normal(size=(4, 2)) * 3 + 5, rng.uniform(-3.1, 3.1, 4)])
    assert_whole(rows, curve_of(rows), rng, lines=8)


@pytest.mark.parametrize("name", SPECIAL)
def test_the_whole_curve_of_special_poses(name):
    rows, loops = SPECIAL[name]
    curve = curve_of(rows)
    assert len(curve.components) == loops
    assert_whole(rows, curve, np.random.default_rng(1), lines=10)


@pytest.mark.parametrize("name", SPECIAL)
@pytest.mark.parametrize("noise", [1e-14, 1e-3])
def test_special_poses_with_a_little_noise(name, noise):
    rng = np.random.default_rng(2)
    rows = SPECIAL[name][0] + noise * rng.normal(size=(4, 3))
    curve = curve_of(rows)
    for loop in samples_of(curve):
        assert apart(loop, np.roll(loop, 1, axis=0)).max() < 1.5 * curve.spacing
    for dyads in curve.components:
        m = dyads.moving_pivot @ [1, 1j]
        at = m[:, None] * np.exp(1j * rows[:, 2]) + rows[:, :2] @ [1, 1j]
        miss = np.ptp(np.abs(at - (dyads.fixed_pivot @ [1, 1j])[:, None]), axis=1)
        assert (miss < 1e-9 * np.maximum(1, dyads.radius)).all()


@pytest.mark.parametrize("turn", [1e-2, 1e-4, 1e-5])
def test_a_body_that_hardly_turns(turn):
    rng = np.random.default_rng(4)
    for _ in range(8):
        rows = np.column_stack([rng.normal(size=(4, 2)), rng.uniform(-1, 1, 4) * turn])
        curve = curve_of(rows)
        for loop in samples_of(curve):
            assert apart(loop, np.roll(loop, 1, axis=0)).max() < 1.1 * curve.spacing
        for dyads in curve.components:
            c, m = dyads.fixed_pivot @ [1, 1j], dyads.moving_pivot @ [1, 1j]
            at = m[:, None] * np.exp(1j * rows[:, 2]) + rows[:, :2] @ [1, 1j]
            miss = np.ptp(np.abs(at - c[:, None]), axis=1)
            # The pivots are 1 / turn away, and so many digits their own numbers lack.
            assert (miss < 1e-14 * np.maximum(np.abs(c), 1 / turn)).all()


@pytest.mark.parametrize("share", [1, 0.03, 1e-3])
def test_the_number_of_loops_is_that_of_the_cubic(share):
    """Lines through a point of a smooth cubic touch it at 2 real points, or at 0 or 4: two loops.

    The point is the pole of the first two poses, and the cubic is sampled, not expanded.
    """
    rng = np.random.default_rng(7)
    seen = []
    for _ in range(12):
        rows = np.column_stack([rng.normal(size=(4, 2)), rng.uniform(-3.1, 3.1, 4) * share])
        (d1, d2), (t1, t2) = rows[:2, :2] @ [1, 1j], np.exp(1j * rows[:2, 2])
        pole = (d2 * t1 - d1 * t2) / (t1 - t2)
        size = np.ptp(rows[:, :2], axis=0).max() / share
        rows = (rows - [pole.real, pole.imag, 0]) / [size, size, 1]
        t = np.array([-1.5, -0.5, 0.5, 1.5])
        psi = np.linspace(0, np.pi, 2001)
        along = np.multiply.outer(t, np.stack([np.cos(psi), np.sin(psi)], axis=-1))
        values = np.linalg.det(circle_equations(rows, along))
        k3, k2, k1, _ = np.linalg.solve(np.vander(t, 4), values)
        zeros = np.count_nonzero(np.diff(np.sign(k2 * k2 - 4 * k1 * k3)))
        curve = curve_of(rows, 100)
        assert zeros in {0, 2, 4}
        assert len(curve.components) == (1 if zeros == 2 else 2)
        seen.append(len(curve.components))
    assert {1, 2} == set(seen)


def test_no_dyad_comes_twice():
    rng = np.random.default_rng(3)
    tasks = [rng.normal(size=(4, 3)) * [1, 1, 1.5] for _ in range(8)]
    for rows in [*tasks, *(rows for rows, _ in SPECIAL.values())]:
        curve = curve_of(rows, 150)
        loops = samples_of(curve)
        everything = np.concatenate(loops)
        distance = apart(everything[:, None], everything)
        np.fill_diagonal(distance, 9)
        # Where the curve nearly crosses itself a few samples come close; twice the same
        # stretch would bring close a great part of them.
        small = sum(len(x) for x in loops if len(x) < 20)
        close = np.count_nonzero(distance.min(axis=1) < 0.2 * curve.spacing)
        assert close <= 4 + small


def test_both_dyads_of_a_four_bar_are_on_the_curve_of_its_poses():
    rng = np.random.default_rng(5)
    for _ in range(15):
        dyads = random_four_bar(rng)
        curve = curve_of(random_poses(dyads, rng, 4))
        everything = np.concatenate(samples_of(curve))
        for dyad in dyads:
            here = places(dyad.fixed_pivot[None], dyad.moving_pivot[None], curve.frames)
            assert apart(here, everything).min() < 0.6 * curve.spacing


def test_the_inverse_motion_exchanges_the_two_curves():
    rng = np.random.default_rng(6)
    for rows in [rng.normal(size=(4, 3)) * [1, 1, 1.5] for _ in range(5)]:
        poses = Displacement.from_poses(rows)
        one, other = dyad_curve(poses), dyad_curve(poses.inverse())
        assert np.isclose(one.spacing, other.spacing, rtol=1e-3)
        swapped = [places(c.moving_pivot, c.fixed_pivot, one.frames) for c in other.components]
        everything = np.concatenate(swapped)
        for loop in samples_of(one):
            assert apart(loop[:, None], everything).min(axis=1).max() < 0.6 * one.spacing


def test_the_curve_goes_along_with_frames_and_unit():
    rng = np.random.default_rng(8)
    for _ in range(5):
        rows = rng.normal(size=(4, 3)) * [1, 1, 1.5]
        in_fixed, in_moving = Displacement([70, -30], 0.8), Displacement([-5, 90], 2.1)
        poses = in_fixed @ Displacement.from_poses(rows) @ in_moving.inverse()
        moved = dyad_curve(Displacement(poses.translation * 25.4, poses.angle))
        curve = curve_of(rows)
        assert np.isclose(moved.spacing, curve.spacing, rtol=1e-3)
        back = [
            places(
                in_fixed.inverse().act(c.fixed_pivot / 25.4),
                in_moving.inverse().act(c.moving_pivot / 25.4),
                curve.frames,
            )
            for c in moved.components
        ]
        everything = np.concatenate(back)
        for loop in samples_of(curve):
            assert apart(loop[:, None], everything).min(axis=1).max() < 0.6 * curve.spacing


REFUSED = {
    "nothing changes": degrees((0, 0, 0), (0, 0, 0), (2, 1, 60), (3, -1, 40)),
    "nothing changes, but for a full turn": degrees((0, 0, 0), (0, 0, 360), (2, 1, 60), (3, -1, 4)),
    "never turns": degrees((0, 0, 20), (1, 0, 20), (2, 1, 20), (3, -1, 20)),
    "never turns, on a circle": np.array([[np.cos(t), np.sin(t), 0.3] for t in (0, 1, 2, 4)]),
    "only turns about one point": np.array([pinned((1, 2), (3, 1), t) for t in (0, 0.5, 1.3, 2)]),
    "turns about the same point": degrees((0, 0, 0), (0, 0, 30), (0, 0, 70), (1, 1, 100)),
    "slider": degrees((0, 0, 0), (1, 0, 0), (2, 0, 0), (3, -1, 60)),
}


@pytest.mark.parametrize("why", REFUSED)
def test_poses_without_a_curve_are_refused_with_the_reason(why):
    with pytest.raises(InputError) as caught:
        curve_of(REFUSED[why])
    assert caught.value.code == "E124"
    assert why.split(",")[0] in str(caught.value.why)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_refused(bad):
    rows = np.arange(12.0).reshape(4, 3)
    rows[2, 1] = bad
    with pytest.raises(InputError) as caught:
        curve_of(rows)
    assert caught.value.code == "E103"
