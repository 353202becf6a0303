"""The classical fits: their distances against brute force, their minima against other solvers."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.dyads.critical_points import critical_dyads
from burmester.dyads.image_space_fits import (
    ImagePoints,
    algebraic_distance,
    algebraic_fit,
    curve_distance,
    larochelle,
    manifold_distance,
    ravani_roth,
)
from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.io.cases import load
from tests.oracles.witness import misses, places, random_four_bar, random_poses, span

FITS = {"algebraic": algebraic_fit, "larochelle": larochelle, "ravani_roth": ravani_roth}
DISTANCES = {
    "algebraic": algebraic_distance,
    "larochelle": manifold_distance,
    "ravani_roth": curve_distance,
}


def frames_of(name):
    """A case's canonical frames, and its poses in them."""
    rows = np.array(load(f"ge2012-{name}")["poses"])
    return CanonicalFrames.of(Displacement(rows[:, :2], np.radians(rows[:, 2])))


def noisy_task(rng, noise):
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, 12)
    return dyads, Displacement.from_poses(rows + noise * rng.normal(size=rows.shape))


def starts(rng, shape, spread=2.0):
    c, m = rng.normal(scale=spread, size=(2, *shape, 2))
    return RR(c, m, rng.uniform(0.3, 4, shape))


def start_of(rng, name, count=None):
    lead = () if count is None else (count,)
    return starts(rng, (*lead, 2) if name == "ravani_roth" else lead)


def flat(dyads):
    """The parameters Xc, Yc, x, y, r on the last axis."""
    return np.concatenate([dyads.fixed_pivot, dyads.moving_pivot, dyads.radius[..., None]], axis=-1)


def dyad(x):
    return RR(x[..., :2], x[..., 2:4], x[..., 4])


def residuals(name, poses, x):
    return DISTANCES[name](ImagePoints.of(poses), x)[0]


def joined(dyads):
    """Two dyads as the witness drives them."""
    return SimpleNamespace(first=dyads[0], second=dyads[1])


# --- the distances, written again from Eq. (9) and from joints


def quadrics(x, poses):
    """G (k, N) and J (k, N, 3) of dyads x (k, 5), from the matrix of Eq. (9)."""
    z = poses.as_image_point()
    c = constraint_manifold.matrix(dyad(x).coefficients())
    slope = 2 * np.einsum("kij,nj->kni", c, z)
    by_psi = slope[..., 2] * z[:, 3] - slope[..., 3] * z[:, 2]
    value = np.einsum("ni,kij,nj->kn", z, c, z)
    return value, np.stack([slope[..., 0], slope[..., 1], by_psi], axis=-1)


def algebraic_misses(x, poses):
    """The circle equation over four, in complex numbers."""
    d = poses.translation @ [1, 1j]
    point = np.exp(1j * poses.angle) * complex(*x[2:4]) + d
    return (np.abs(point - complex(*x[:2])) ** 2 - x[4] ** 2) / 4


def curve_steps(x, poses):
    """The least steps in (Z1, Z2, psi), end to end, to where both tangent planes meet."""
    value, slope = quadrics(x.reshape(2, 5), poses)
    return (np.linalg.pinv(np.swapaxes(slope, 0, 1)) @ value.T[..., None]).ravel()


def crank_places(x, crank, half_angle):
    """Image points (Z1, Z2, psi) of displacements that a dyad reaches, put together by joints."""
    turn = np.exp(2j * half_angle)
    d = complex(*x[:2]) + x[4] * np.exp(1j * crank) - turn * complex(*x[2:4])
    s, c = np.sin(half_angle), np.cos(half_angle)
    z1, z2 = (d.real * s - d.imag * c) / 2, (d.real * c + d.imag * s) / 2
    return z1, z2, np.broadcast_to(half_angle, z1.shape)


def nearest_by_brute_force(x, pose):
    """The distance of one image point from a manifold: a grid over its joints, then refined."""
    z, psi = pose.as_image_point(), pose.angle / 2
    target = z[0], z[1], psi

    def gap(joints):
        return [a - b for a, b in zip(crank_places(x, *joints), target, strict=True)]

    crank = np.linspace(-np.pi, np.pi, 721)[:, None]
    half = psi + np.linspace(-np.pi, np.pi, 1441)
    grid = sum(part**2 for part in gap((crank, half)))
    dips = np.ones_like(grid, dtype=bool)
    for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
        dips &= grid <= np.roll(grid, step, axis)
    lowest = np.argwhere(dips)
    lowest = lowest[np.argsort(grid[tuple(lowest.T)])[:4]]
    fits = [least_squares(gap, [crank[i, 0], half[j]], method="lm", xtol=1e-15) for i, j in lowest]
    return np.sqrt(2 * min(fit.cost for fit in fits))


@pytest.mark.parametrize("seed", range(12))
def test_the_normal_distance_is_the_nearest_of_all_joint_angles(seed):
    rng = np.random.default_rng(seed)
    size = 10 ** rng.uniform(-1, 1)
    poses = Displacement(rng.normal(scale=size, size=(9, 2)), rng.uniform(-9, 9, 9))
    x = flat(starts(rng, (), spread=2 * size)) * [1, 1, 1, 1, size]
    fit = larochelle(poses, dyad(x))
    end = flat(fit.dyads)
    for at in (x, end) if np.abs(end).max() < 30 * size else (x,):
        brute = np.array([nearest_by_brute_force(at, poses[k]) for k in range(9)])
        np.testing.assert_allclose(np.abs(residuals("larochelle", poses, at)), brute, atol=1e-9)
    if at is end:
        assert fit.residual == pytest.approx(np.sqrt((brute**2).mean()))


@pytest.mark.parametrize("seed", range(4))
def test_distances_are_those_of_equation_9(seed):
    rng = np.random.default_rng(seed)
    poses = Displacement(rng.normal(size=(7, 2)), rng.uniform(-9, 9, 7))
    x = flat(starts(rng, (2,)))
    ours = residuals("algebraic", poses, x[0])
    np.testing.assert_allclose(ours, algebraic_misses(x[0], poses), rtol=1e-12, atol=1e-13)
    both = residuals("ravani_roth", poses, x.ravel()).reshape(2, -1)
    steps = curve_steps(x.ravel(), poses).reshape(-1, 3)
    np.testing.assert_allclose((both**2).sum(axis=0), (steps**2).sum(axis=1), rtol=1e-8)


@pytest.mark.parametrize("name", FITS)
@pytest.mark.parametrize("seed", range(5))
def test_derivatives_are_those_of_small_steps(name, seed):
    rng = np.random.default_rng(seed)
    poses = Displacement(rng.normal(size=(7, 2)), rng.uniform(-9, 9, 7))
    x = flat(start_of(rng, name)).ravel()
    ours = DISTANCES[name](ImagePoints.of(poses), x)[1]
    steps = [
        (residuals(name, poses, x + h) - residuals(name, poses, x - h)) / 2e-6
        for h in 1e-6 * np.eye(len(x))
    ]
    small = 1e-6 * (1 + np.abs(ours).max())
    np.testing.assert_allclose(ours, np.transpose(steps), atol=small, rtol=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_near_the_curve_the_first_order_is_the_distance_from_it(seed):
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, 8, side=0)
    noise = 1e-5 * rng.normal(size=rows.shape)
    poses = Displacement.from_poses(rows + noise)
    x = np.concatenate([flat(d) for d in dyads])
    both = residuals("ravani_roth", poses, x).reshape(2, -1)
    z, psi = poses.as_image_point(), poses.angle / 2
    # Drive the linkage closely around each pose and take the nearest image point it passes.
    pin = (poses.translation + poses.rotate(dyads[0].moving_pivot)) - dyads[0].fixed_pivot
    for k, (distance, asked) in enumerate(
        zip(np.hypot(*both), np.arctan2(pin[:, 1], pin[:, 0]), strict=True)
    ):
        d, phi = (v[0] for v in places(*dyads, asked + np.linspace(-1e-3, 1e-3, 40001)))
        half = psi[k] + ((phi / 2 - psi[k] + np.pi / 2) % np.pi - np.pi / 2)
        s, c = np.sin(half), np.cos(half)
        w = (d.real * s - d.imag * c) / 2, (d.real * c + d.imag * s) / 2
        true = np.nanmin(
            np.sqrt((w[0] - z[k, 0]) ** 2 + (w[1] - z[k, 1]) ** 2 + (half - psi[k]) ** 2)
        )
        assert distance == pytest.approx(true, rel=2e-2, abs=1e-9)


# --- the fits, against scipy from the same start


def scipy_cost(name, poses, x):
    """Where scipy gets from x, with residuals that share nothing with the package's."""
    if name == "algebraic":
        fit = least_squares(algebraic_misses, x, args=(poses,), method="lm", xtol=1e-12)
        return 2 * fit.cost
    if name == "ravani_roth":
        fit = least_squares(curve_steps, x, args=(poses,), method="lm", xtol=1e-12)
        return 2 * fit.cost
    # Orthogonal distance regression: a crank angle and a half angle of its own for each pose.
    z, psi = poses.as_image_point(), poses.angle / 2
    pin = poses.translation + poses.rotate(x[2:4]) - x[:2]
    joints = np.concatenate([np.arctan2(pin[:, 1], pin[:, 0]), psi])

    def gaps(v):
        crank, half = v[5:].reshape(2, -1)
        point = crank_places(v[:5], crank, half)
        return np.concatenate([point[0] - z[:, 0], point[1] - z[:, 1], point[2] - psi])

    fit = least_squares(gaps, np.concatenate([x, joints]), method="lm", xtol=1e-12)
    return 2 * fit.cost


@pytest.mark.parametrize("name", FITS)
@pytest.mark.parametrize("seed", range(8))
def test_scipy_gets_no_lower(name, seed):
    # From the same start and, as two methods may choose two valleys, from where ours ends.
    rng = np.random.default_rng(seed)
    dyads, poses = noisy_task(rng, 0.01)
    x = np.array([flat(d) for d in dyads]) + 0.03 * rng.normal(size=(2, 5))
    fit = FITS[name](poses, dyad(x if name == "ravani_roth" else x[0]))
    assert fit.converged
    cost = fit.residual**2 * len(poses.angle)
    at = flat(fit.dyads).ravel()
    assert scipy_cost(name, poses, at) == pytest.approx(cost, rel=1e-7)
    fresh = scipy_cost(name, poses, x.ravel() if name == "ravani_roth" else x[0])
    assert cost <= fresh * (1 + 1e-7)


@pytest.mark.parametrize("name", ["exact", "approximate"])
def test_the_algebraic_fit_ends_in_the_minima_that_are_all_there_are(name):
    poses = frames_of(name)[1]
    known = critical_dyads(poses)
    known = flat(known.dyads)[known.minimum]
    fit = algebraic_fit(poses, starts(np.random.default_rng(5), (60,), spread=3))
    assert fit.converged.all()
    apart = np.abs(flat(fit.dyads)[:, None] - known).max(axis=-1)
    assert apart.min(axis=1).max() < 1e-5
    assert set(apart.argmin(axis=1)) == set(range(len(known)))


@pytest.mark.parametrize("name", FITS)
def test_many_starts_at_once_go_where_each_goes_alone(name):
    poses = frames_of("approximate")[1]
    start = start_of(np.random.default_rng(1), name, 12)
    at_once = FITS[name](poses, start)
    assert len(set(at_once.evaluations)) > 3
    for k in range(12):
        alone = FITS[name](poses, start[k])
        assert alone.converged == at_once.converged[k]
        if alone.converged:
            assert alone.residual == pytest.approx(at_once.residual[k], rel=1e-6)


# --- motions of known linkages


@pytest.mark.parametrize("name", FITS)
@pytest.mark.parametrize("seed", range(6))
def test_an_exact_linkage_is_found_again_from_nearby(name, seed):
    rng = np.random.default_rng(100 + seed)
    dyads, poses = noisy_task(rng, 0)
    true = np.array([flat(d) for d in dyads])
    start = dyad(true + 0.02 * rng.normal(size=(2, 5)))
    fit = FITS[name](poses, start)
    assert fit.converged.all()
    np.testing.assert_allclose(flat(fit.dyads), true, atol=1e-7)
    assert fit.residual.max() < 1e-9
    length = span(np.column_stack([poses.translation, poses.angle]))
    assert misses(joined(fit.dyads), poses, length).max() < 1e-6 * length


@pytest.mark.parametrize("name", FITS)
def test_table_5_is_met_by_the_linkages_driven(name):
    frames, poses = frames_of("approximate")
    best = dyad(
        np.array(load("ge2012-approximate")["best_dyads_true_distance"])[:, [0, 1, 3, 4, 2]]
    )
    near = RR(
        (best.fixed_pivot - frames.fixed_origin) / frames.length,
        (best.moving_pivot - frames.moving_origin) / frames.length,
        best.radius / frames.length,
    )
    fit = FITS[name](poses, near)
    assert fit.converged.all()
    assert np.abs(flat(fit.dyads) - flat(near)).max() < 0.1
    assert misses(joined(fit.dyads), poses, 1.0).max() < 0.02


# --- what is refused, and what cannot start


@pytest.mark.parametrize("name", FITS)
def test_four_poses_are_too_few(name):
    poses = Displacement(np.zeros((4, 2)), np.arange(4.0))
    with pytest.raises(InputError, match="at least 5 poses, not 4"):
        FITS[name](poses, start_of(np.random.default_rng(0), name))


def test_one_manifold_twice_has_no_curve():
    poses = frames_of("approximate")[1]
    one = starts(np.random.default_rng(0), (1,))
    two = dyad(np.concatenate([flat(one), flat(one)]))
    fit = ravani_roth(poses, two)
    assert not fit.converged
    assert np.isinf(fit.residual)
    np.testing.assert_array_equal(flat(fit.dyads), flat(two))
