"""Driving links at given angles, against Norton's example and closed equations of other code."""

import numpy as np
import pytest
from scipy.optimize import fsolve

from burmester.dyads.timed_dyads import nearest_timed, timed_dyads, timing_equations
from burmester.geometry.displacement import Displacement
from burmester.tasks.crank_timing import CrankTiming

NORTON = [(0, 0, 0), (2.393562138, -1.449021839, -45), (3.760708125, -1.102558570, 9.3)]


def planted(seed, count, span=1.0):
    """A link (A, b, r) and poses whose place of b is on it, by complex numbers alone."""
    rng = np.random.default_rng(seed)
    pivot, pin, radius = *rng.normal(size=(2, 2)) @ [1, 1j] * span, rng.uniform(0.3, 2) * span
    beta, turn = rng.uniform(0, 2 * np.pi, (2, count))
    at = pivot + radius * np.exp(1j * beta) - pin * np.exp(1j * turn)
    return (pivot, pin, radius), Displacement(np.stack([at.real, at.imag], axis=-1), turn), beta


def timing_of(beta, timed, *, absolute=False):
    angles = np.full(len(beta), np.nan)
    angles[:timed] = beta[:timed] + (0.0 if absolute else 0.7)
    return CrankTiming(angles, absolute)


def roots(poses, timing):
    """All solutions of the equations as a designer writes them, by fsolve from many starts."""
    d, turn = poses.translation @ [1, 1j], np.exp(1j * poses.angle)
    known, size = timing.timed, np.abs(poses.translation).max()

    def equations(x):
        # Dimensions A, b, r and the phase, which an absolute timing has at 0.
        phase = 0.0 if timing.absolute else x[5]
        link = d + turn * complex(*x[2:4]) - complex(*x[:2])
        told = link[known] - x[4] * np.exp(1j * (timing.angles[known] + phase))
        loose = np.delete(np.abs(link) - x[4], known)
        return np.concatenate([told.real, told.imag, loose])

    rng, found = np.random.default_rng(0), []
    unknowns = 5 if timing.absolute else 6
    for _ in range(150):
        start = rng.normal(size=unknowns) * size
        x, _, ok, _ = fsolve(equations, start, full_output=True)
        x[4:] = x[4:] if timing.absolute or x[4] > 0 else (-x[4], x[5] + np.pi)
        sound = ok == 1 and np.abs(equations(x)).max() < 1e-9 * size and x[4] > 1e-3 * size
        if sound and not any(np.abs(x[:4] - other).max() < 1e-6 * size for other in found):
            found.append(x[:4])
    return np.array(sorted(found, key=tuple))


def test_nortons_dyad():
    poses = Displacement(np.array(NORTON)[:, :2], np.radians(np.array(NORTON)[:, 2]))
    (found,) = timed_dyads(poses, CrankTiming(np.radians([0, 342.3, 324.8])))
    np.testing.assert_allclose(found.fixed_pivot, (-1.23383, -7.77142), atol=5e-6)
    np.testing.assert_allclose(found.moving_pivot, (-1.17913, -0.93964), atol=5e-6)
    assert found.radius == pytest.approx(6.832, abs=5e-4)


@pytest.mark.parametrize("span", [3, 300])
@pytest.mark.parametrize(
    ("count", "timed", "absolute"), [(3, 3, False), (4, 2, False), (3, 2, True)]
)
@pytest.mark.parametrize("seed", range(4))
def test_all_dyads_at_the_angles_of_the_crank(seed, count, timed, absolute, span):
    (pivot, pin, _), poses, beta = planted(seed, count, span)
    timing = timing_of(beta, timed, absolute=absolute)
    found = timed_dyads(poses, timing)
    own = np.array([[*each.fixed_pivot, *each.moving_pivot] for each in found])
    own = own[np.lexsort(own.T[::-1])]
    wanted = [pivot.real, pivot.imag, pin.real, pin.imag]
    assert np.abs(own - wanted).max(axis=1).min() < 1e-9 * span
    np.testing.assert_allclose(own, roots(poses, timing), atol=1e-6 * span)


@pytest.mark.parametrize(("count", "timed"), [(2, 2), (3, 2), (4, 3), (5, 2)])
def test_too_few_and_too_many_angles_leave_no_finite_number(count, timed):
    _, poses, beta = planted(0, count)
    assert timed_dyads(poses, timing_of(beta, timed)) is None


@pytest.mark.parametrize("absolute", [False, True])
def test_equations_vanish_on_the_planted_link_and_are_differentiated(absolute):
    (pivot, pin, radius), poses, beta = planted(5, 6)
    timing = timing_of(beta, 4, absolute=absolute)
    z = np.array([[pivot.real, pivot.imag, pin.real, pin.imag, radius]])
    value, slope = timing_equations(z, poses, timing)
    np.testing.assert_allclose(value, 0, atol=1e-12)
    for k in range(5):
        step = np.zeros((1, 5))
        step[0, k] = 0.5  # affine: a long step is exact
        moved, _ = timing_equations(z + step, poses, timing)
        np.testing.assert_allclose(moved - value, 0.5 * slope[..., k], atol=1e-12)


def test_many_timed_poses_start_from_the_planted_link():
    (pivot, *_), poses, beta = planted(7, 8)
    for each in nearest_timed(poses, timing_of(beta, 6)):
        np.testing.assert_allclose(each.fixed_pivot, [pivot.real, pivot.imag], atol=1e-8)
