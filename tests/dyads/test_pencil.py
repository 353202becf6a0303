"""The paper's method: the pencil, its stationary points, and what does not change it."""

import json
from importlib import resources

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from burmester.dyads import pencil
from burmester.dyads.pencil import fit_pencil
from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from tests.oracles.witness import misses, random_four_bar, random_poses, span


def case(name):
    return json.loads(resources.files("burmester").joinpath(f"cases/{name}.json").read_text())


def poses_of(name):
    rows = np.array(case(name)["poses"])
    return Displacement(rows[:, :2], np.radians(rows[:, 2]))


def as_rows(dyads):
    """Dyads as rows Xc, Yc, x, y, r in an order of their own."""
    rows = np.column_stack([dyads.fixed_pivot, dyads.moving_pivot, dyads.radius])
    return rows[np.argsort(rows[:, 0])]


def test_table_6_from_the_raw_fit():
    fit = fit_pencil(poses_of("ge2012-approximate"), normalise=False)
    wanted = [1.75e-3, 3.01e-3, 6.92e-3, 0.1336, 0.1534, 1.1662, 1.5327, 9.7251]
    assert np.allclose(fit.singular_values, wanted, rtol=0, atol=[5e-6] * 3 + [5e-5] * 5)


def test_corrected_table_2_gives_the_published_linkage():
    poses = poses_of("ge2012-exact")
    for normalise in (True, False):
        fit = fit_pencil(poses, normalise=normalise)
        published = [[-2.2, 0.1, 1.24, 0.1, 1.2377], [1.15, 0.38, 4.59, 1.34, 4.6712]]
        # Four decimals in the poses leave the pivots uncertain in the third.
        assert np.allclose(as_rows(fit.dyads), published, rtol=0, atol=8e-3)
        linkage = Linkage(fit.dyads[0], fit.dyads[1])
        assert misses(linkage, poses, 1.0).max() < 4e-4


def test_refitted_radius_beats_the_radius_of_table_8():
    poses = poses_of("ge2012-approximate")
    fit = fit_pencil(poses, normalise=False)
    _, _, squared = constraint_manifold.circle(fit.at(fit.theta)[:2])
    paper = RR(fit.dyads.fixed_pivot, fit.dyads.moving_pivot, np.sqrt(squared).mean(axis=-1))
    for k in range(2):
        of_paper = np.sqrt((paper[k].residual(poses) ** 2).mean())
        assert of_paper > 5 * fit.rms_error[k]


@pytest.mark.parametrize("count", [6, 7, 8, 9, 30])
@pytest.mark.parametrize("seed", range(8))
def test_exact_motions_give_back_the_linkage_that_made_them(seed, count):
    rng = np.random.default_rng(seed)
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, count)
    poses = Displacement.from_poses(rows)
    fit = fit_pencil(poses)
    truth = np.array([[*d.fixed_pivot, *d.moving_pivot, d.radius] for d in dyads])
    truth = truth[np.argsort(truth[:, 0])]
    assert np.abs(as_rows(fit.dyads) - truth).max() < 1e-7 * span(rows)
    assert misses(Linkage(fit.dyads[0], fit.dyads[1]), poses, 1.0).max() < 1e-7 * span(rows)


def random_pencil(rng, kind):
    v = np.linalg.qr(rng.normal(size=(8, 2)))[0].T
    if kind == "exact":  # two true dyads: E has two zeros
        circles = RR(rng.normal(size=(2, 2)), rng.normal(size=(2, 2)), rng.uniform(0.2, 2, 2))
        v = np.linalg.qr(circles.coefficients().T)[0].T
    elif kind == "flat":  # both conditions nearly constant
        v[1] = v[0] + 1e-3 * v[1]
        v = np.linalg.qr(v.T)[0].T
    return v


@pytest.mark.parametrize("kind", ["generic", "exact", "flat"])
def test_stationary_angles_against_a_fine_grid(kind):
    rng = np.random.default_rng(1)
    grid = np.linspace(0, np.pi, 20000, endpoint=False)
    for _ in range(300):
        v = random_pencil(rng, kind)
        p = np.cos(grid)[:, None] * v[0] + np.sin(grid)[:, None] * v[1]
        e = (constraint_manifold.conditions(p) ** 2).sum(axis=-1)
        low = (e < np.roll(e, 1)) & (e <= np.roll(e, -1))
        high = (e > np.roll(e, 1)) & (e >= np.roll(e, -1))
        theta = pencil.stationary_angles(v[0], v[1])
        at = np.cos(theta)[:, None] * v[0] + np.sin(theta)[:, None] * v[1]
        error = (constraint_manifold.conditions(at) ** 2).sum(axis=-1)
        assert low.sum() == high.sum() == np.isfinite(theta[:2]).sum()
        tolerance = 1e-6 * e.max()
        assert np.allclose(np.sort(error[:2])[: low.sum()], np.sort(e[low]), rtol=0, atol=tolerance)
        assert error[0] <= e.min() + 1e-15
        assert error[3] >= e.max() - 1e-15
        if low.sum() == 2:
            assert np.isclose(error[2], np.sort(e[high])[0], rtol=0, atol=tolerance)


def noisy_rows(rng, count=10, noise=0.02):
    rows = random_poses(random_four_bar(rng), rng, count)
    return rows + noise * rng.normal(size=rows.shape)


def move(poses, fixed, moving, unit):
    """The same motion seen from other frames, in another unit."""
    seen = fixed @ poses @ moving.inverse()
    return Displacement(seen.translation * unit, seen.angle)


@given(
    st.integers(0, 2**32 - 1),
    st.tuples(*[st.floats(-1e3, 1e3)] * 4),
    st.floats(-10, 10),
    st.floats(-10, 10),
    st.sampled_from([1e-6, 1e-3, 1.0, 25.4, 1e6]),
)
def test_normalised_fit_goes_along_with_frames_and_units(seed, shifts, turn, turn_m, unit):
    rng = np.random.default_rng(seed)
    poses = Displacement.from_poses(noisy_rows(rng))
    fixed = Displacement(np.array(shifts[:2]), np.array(turn))
    moving = Displacement(np.array(shifts[2:]), np.array(turn_m))
    fit = fit_pencil(poses)
    moved = fit_pencil(move(poses, fixed, moving, unit))
    size = np.nanmax(fit.dyads.radius)
    for k in range(2):
        # Two minima of nearly the same height may exchange places.
        gaps = [
            np.abs(
                np.array(
                    [
                        *(moved.dyads.fixed_pivot[j] / unit - fixed.act(fit.dyads.fixed_pivot[k])),
                        *(
                            moved.dyads.moving_pivot[j] / unit
                            - moving.act(fit.dyads.moving_pivot[k])
                        ),
                        moved.dyads.radius[j] / unit - fit.dyads.radius[k],
                    ]
                )
            ).max()
            for j in range(2)
        ]
        if np.isnan(fit.dyads.radius[k]):
            assert np.isnan(moved.dyads.radius).any()
        else:
            assert np.nanmin(gaps) < 1e-8 * size**2 + 1e-9


def test_order_whole_turns_and_exchange_of_frames():
    rng = np.random.default_rng(7)
    rows = noisy_rows(rng)
    fit = fit_pencil(Displacement.from_poses(rows))
    shuffled = rows[rng.permutation(len(rows))]
    shuffled[:, 2] += 2 * np.pi * rng.integers(-3, 4, len(rows))
    again = fit_pencil(Displacement.from_poses(shuffled))
    inverse = fit_pencil(Displacement.from_poses(rows).inverse())
    for field in ("fixed_pivot", "moving_pivot", "radius"):
        assert np.allclose(getattr(fit.dyads, field), getattr(again.dyads, field), atol=1e-10)
    assert np.allclose(fit.dyads.fixed_pivot, inverse.dyads.moving_pivot, atol=1e-10)
    assert np.allclose(fit.dyads.moving_pivot, inverse.dyads.fixed_pivot, atol=1e-10)


def test_the_raw_fit_does_depend_on_the_unit():
    rng = np.random.default_rng(7)
    poses = Displacement.from_poses(noisy_rows(rng))
    large = Displacement(1000 * poses.translation, poses.angle)
    fit, other = (fit_pencil(p, normalise=False) for p in (poses, large))
    assert np.abs(other.dyads.radius / 1000 - fit.dyads.radius).max() > 1e-3


def test_weight_two_is_the_pose_given_twice():
    rng = np.random.default_rng(3)
    rows = noisy_rows(rng)
    weights = np.ones(10)
    weights[4] = 2
    weighted = fit_pencil(Displacement.from_poses(rows), weights)
    doubled = fit_pencil(Displacement.from_poses(np.vstack([rows, rows[4]])))
    assert np.allclose(as_rows(weighted.dyads), as_rows(doubled.dyads), atol=1e-10)
    assert np.allclose(weighted.singular_values, doubled.singular_values, atol=1e-12)


def test_a_stack_of_tasks_is_its_members():
    rng = np.random.default_rng(5)
    rows = np.stack([[noisy_rows(rng) for _ in range(3)] for _ in range(2)])
    batch = fit_pencil(Displacement.from_poses(rows))
    for i, j in np.ndindex(2, 3):
        one = fit_pencil(Displacement.from_poses(rows[i, j]))
        assert np.allclose(batch.theta[i, j], one.theta, atol=1e-12, equal_nan=True)
        assert np.allclose(batch.dyads[i, j].radius, one.dyads.radius, equal_nan=True)
        assert np.allclose(batch.dyads.fixed_pivot[i, j], one.dyads.fixed_pivot, equal_nan=True)
        assert np.allclose(batch.rms_error[i, j], one.rms_error, equal_nan=True)


def test_many_poses_block_by_block(monkeypatch):
    rng = np.random.default_rng(9)
    poses = Displacement.from_poses(noisy_rows(rng, 1000))
    whole = fit_pencil(poses)
    monkeypatch.setattr(pencil, "BLOCK_ROWS", 64)
    blocks = fit_pencil(poses)
    assert np.allclose(whole.singular_values, blocks.singular_values, rtol=1e-12)
    assert np.allclose(as_rows(whole.dyads), as_rows(blocks.dyads), atol=1e-10)


def test_poles_half_turns_and_rest_are_no_trouble():
    rng = np.random.default_rng(0)
    angles = np.array([0, np.pi, 0, np.pi, np.pi, 0, 0.0])
    for rows in (
        np.column_stack([rng.normal(size=(7, 2)), angles]),
        np.column_stack([np.zeros((7, 2)), rng.normal(size=7)]),
        np.zeros((7, 3)),
        np.column_stack([rng.normal(size=(7, 2)), np.full(7, np.pi)]),
    ):
        fit = fit_pencil(Displacement.from_poses(rows))
        assert np.isfinite(fit.singular_values).all()
        assert np.isfinite(fit.error[0])


@pytest.mark.parametrize("count", [0, 1, 5])
def test_too_few_poses_for_a_pencil(count):
    with pytest.raises(InputError, match="at least 6") as caught:
        fit_pencil(Displacement.from_poses(np.zeros((count, 3))))
    assert caught.value.code == "E121"


def test_an_infinite_number_is_refused_before_the_svd():
    rows = np.zeros((8, 3))
    rows[2, 0] = np.inf
    with pytest.raises(InputError) as caught:
        fit_pencil(Displacement.from_poses(rows))
    assert caught.value.code == "E103"
