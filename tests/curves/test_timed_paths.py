"""Five timed points, and start values for more."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.curves.crank_linkages import linkages_of_five_points
from burmester.curves.path_fit import PathSearch
from tests.oracles.coupler_curves import dyads_of, random_crank, traced
from tests.oracles.witness import places


def task(seed, count=5):
    rng = np.random.default_rng(seed)
    z, side = random_crank(rng)
    t = np.sort(rng.uniform(0, 2 * np.pi, count))
    p = traced(dyads_of(z), side, t)
    return rng, z, t, np.column_stack([p.real, p.imag])


@pytest.mark.parametrize("seed", range(4))
def test_five_points_are_met_at_their_crank_angles(seed):
    _, z, t, points = task(seed)
    batch, rows = linkages_of_five_points(points, t - t[0])
    assert len(batch) in (2, 6, 12)  # of two, three or four real dyads
    wanted = points[:, 0] + 1j * points[:, 1]
    for k in range(len(batch)):
        linkage = batch.linkage(k)
        # The witness turns the first link as the angles say, from where it is at the first point.
        pin = complex(*points[0]) + complex(*linkage.first.moving_pivot) * np.exp(
            1j * rows[k, 0, 2]
        )
        begin = np.angle(pin - complex(*linkage.first.fixed_pivot))
        where, _ = places(linkage.first, linkage.second, begin + t - t[0])
        assert np.abs(where - wanted).min(axis=0).max() < 1e-6 * (1 + linkage.second.radius)
    # The linkage that made the points is among them.
    made = np.abs(batch.dimensions[:, :, :2].reshape(-1, 4) - z[:4]).max(axis=1)
    assert made.min() < 1e-6


def test_random_starts_find_no_other_linkage_of_five_points():
    rng, _, t, points = task(1)
    batch, _ = linkages_of_five_points(points, t - t[0])
    known = batch.dimensions[:, 0, :2]
    wanted = points[:, 0] + 1j * points[:, 1]

    def residual(x):
        """Loop and coupler point with free coupler angles, in vectors (complex numbers)."""
        g1, g2, a, c, b = x[:10:2] + 1j * x[1:10:2]
        crank, turn = np.exp(1j * (t - t[0])), np.exp(1j * np.append(0.0, x[10:14]))
        pin = g1 + a * crank
        gap = pin + c * turn - wanted
        reach = np.abs(pin + b * turn - g2)
        return np.concatenate([gap.real, gap.imag, reach - reach.mean()])

    found = 0
    for _ in range(60):
        fit = least_squares(residual, rng.normal(size=14), max_nfev=300)
        x = fit.x
        if fit.cost > 1e-22 or np.abs(x).max() > 1e3 or np.hypot(x[4], x[5]) < 1e-3:
            continue
        if np.hypot(*(x[8:10])) < 1e-3 or np.hypot(*(x[6:8] - x[8:10])) < 1e-6:
            continue  # the coupler has no length
        found += 1
        assert np.abs(known - x[:2]).max(axis=1).min() < 1e-4
    assert found > 5


def test_more_points_than_five_with_noise():
    rng, _, t, points = task(2, 12)
    noisy = points + 0.003 * rng.normal(size=points.shape)
    fit = PathSearch.of(noisy, crank_angles=t).nearest()
    assert fit.cost[0] < 2 * 12 * 0.003**2
    at = fit.t[0]
    assert np.allclose(at - at[0], t - t[0])
    both = [traced(dyads_of(fit.linkages.dimensions[0]), side, at) for side in (0, 1)]
    wanted = noisy[:, 0] + 1j * noisy[:, 1]
    assert min((np.abs(each - wanted) ** 2).sum() for each in both) == pytest.approx(fit.cost[0])
