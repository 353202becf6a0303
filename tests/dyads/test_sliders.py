"""Sliders in closed form."""

import json
from importlib import resources

import mpmath
import numpy as np
import pytest
from scipy.optimize import minimize

from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.fourbar.dyad import PR, RP
from burmester.geometry.displacement import Displacement


def poses_of(name):
    case = json.loads(resources.files("burmester").joinpath(f"cases/{name}.json").read_text())
    rows = np.array(case["poses"])
    return case, Displacement(rows[:, :2], np.radians(rows[:, 2]))


def same_line(found, normal_deg, offset, tolerance):
    n = np.array([np.cos(found.normal_angle), np.sin(found.normal_angle)])
    m = np.array([np.cos(np.radians(normal_deg)), np.sin(np.radians(normal_deg))])
    sign = np.sign(n @ m)
    assert np.allclose(n, sign * m, atol=tolerance)
    assert np.isclose(found.offset, sign * offset, atol=tolerance)


@pytest.mark.parametrize("name", ["motiongen-rrrp", "motiongen-prpr"])
def test_published_fixed_lines(name):
    case, poses = poses_of(name)
    (wanted,) = case["expected"]["PR"]
    lines, rms, worst = fixed_lines(poses)
    same_line(lines[0], wanted["normal_deg"], wanted["offset"], 1e-3)
    assert np.allclose(lines[0].moving_pivot, wanted["moving_pivot"], atol=2e-3)
    assert rms[0] <= worst[0] < 1e-3


@pytest.mark.parametrize("name", ["motiongen-rrpr", "motiongen-prpr"])
def test_published_moving_lines(name):
    case, poses = poses_of(name)
    (wanted,) = case["expected"]["RP"]
    lines, _, worst = moving_lines(poses)
    same_line(lines[0], wanted["normal_in_M_deg"], wanted["offset"], 1e-3)
    assert np.allclose(lines[0].fixed_pivot, wanted["fixed_pivot"], atol=1e-3)
    assert worst[0] < 1e-3


@pytest.mark.parametrize("seed", range(5))
def test_no_descent_finds_a_better_line(seed):
    rng = np.random.default_rng(seed)
    poses = Displacement.from_poses(rng.normal(size=(9, 3)))
    weights = rng.uniform(0.5, 2, 9)

    def cost(v):
        return (weights * PR(v[0], v[1], v[2:]).residual(poses) ** 2).sum()

    lines, rms, _ = fixed_lines(poses, weights)
    ours = (weights * lines[0].residual(poses) ** 2).sum()
    found = [minimize(cost, rng.normal(size=4), tol=1e-12).fun for _ in range(30)]
    assert np.isclose(min(found), ours, rtol=1e-8)
    assert np.isclose(rms[0], np.sqrt((lines[0].residual(poses) ** 2).mean()))


def test_two_fixed_lines_of_an_elliptic_trammel():
    a = np.linspace(0.2, 2.4, 7)
    # (0, 0) of M runs along the x axis, (2, 0) of M along the y axis.
    poses = Displacement(np.column_stack([-2 * np.cos(a), np.zeros(7)]), a)
    lines, _, worst = fixed_lines(poses)
    assert (worst < 1e-12).all()
    for line, pivot in zip((lines[0], lines[1]), lines.moving_pivot, strict=True):
        assert np.allclose(line.residual(poses), 0, atol=1e-12)
        assert isinstance(line, PR)
        # Every point of a trammel's two lines lies on the circle over their pivots' distance.
        assert np.isclose(np.linalg.norm(pivot - [1, 0]), 1.0)


def test_offsets_in_the_plane_do_not_matter():
    rng = np.random.default_rng(3)
    poses = Displacement.from_poses(rng.normal(size=(8, 3)))
    shift = np.array([1e6, -2e6])
    far = Displacement(poses.translation + shift, poses.angle)
    (near_lines, near_rms, _), (far_lines, far_rms, _) = fixed_lines(poses), fixed_lines(far)
    assert np.allclose(near_rms, far_rms, rtol=1e-6)
    assert np.allclose(near_lines.moving_pivot, far_lines.moving_pivot, atol=1e-8)
    assert isinstance(moving_lines(poses)[0], RP)


@pytest.mark.parametrize("turn", [1.0, 1e-3, 1e-5])
def test_small_turns_lose_no_digits(turn):
    """Elimination and eigenvectors with 60 digits."""
    rng = np.random.default_rng(9)
    poses = Displacement.from_poses(rng.normal(size=(7, 3)) * [1, 1, turn] + [0, 0, 2])
    weights = rng.uniform(0.5, 2, 7)
    with mpmath.workdps(60):
        angles = [mpmath.mpf(each) for each in poses.angle.tolist()]
        rows = mpmath.matrix([[mpmath.cos(each), mpmath.sin(each), -1] for each in angles])
        places = mpmath.matrix(poses.translation.tolist())
        share = mpmath.diag(weights.tolist())
        solved = mpmath.inverse(rows.T * share * rows) * rows.T * share * places
        left = places - rows * solved
        gram = left.T * share * left
        steep = mpmath.atan2(2 * gram[0, 1], gram[0, 0] - gram[1, 1]) / 2
        n = mpmath.matrix([-mpmath.sin(steep), mpmath.cos(steep)])
        n = n if n[1] >= 0 else -n
        u, w, h = -(solved * n)
        pivot = [n[0] * u + n[1] * w, n[1] * u - n[0] * w]
    lines, _, _ = fixed_lines(poses, weights)
    assert lines[0].normal_angle == pytest.approx(float(mpmath.atan2(n[1], n[0])), abs=1e-13)
    assert lines[0].moving_pivot == pytest.approx([float(each) for each in pivot], rel=1e-12)
    assert lines[0].offset == pytest.approx(float(h), rel=1e-12)


@pytest.mark.parametrize("other", [0.3, 2.0, 0.3 + np.pi])
def test_what_poses_of_two_angles_leave_open_is_the_shortest(other):
    """As the pseudoinverse has it."""
    angles, rng = [0.3] * 2 + [other] * 4, np.random.default_rng(10)
    rows = np.column_stack([rng.normal(size=(6, 2)), angles])
    poses = Displacement.from_poses(rows)
    lines, rms, _ = fixed_lines(poses)
    others = np.column_stack([np.cos(angles), np.sin(angles), -np.ones(6)])
    places = rows[:, :2] - rows[:, :2].mean(axis=0)
    solve = np.linalg.pinv(others, rcond=1e-12)
    rest = places - others @ solve @ places
    assert rms == pytest.approx(np.linalg.svd(rest, compute_uv=False)[::-1] / np.sqrt(6), abs=1e-12)
    for line in (lines[0], lines[1]):
        n = np.array([np.cos(line.normal_angle), np.sin(line.normal_angle)])
        u, w = n @ line.moving_pivot, n[::-1] @ (line.moving_pivot * [1, -1])
        h = line.offset - n @ rows[:, :2].mean(axis=0)
        wanted = -solve @ places @ n
        assert [u, w, h] == pytest.approx(wanted, abs=1e-12)
