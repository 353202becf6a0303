"""The best sliders on a rail, against SciPy from many starts."""

import numpy as np
import pytest
from scipy.optimize import minimize

from burmester.dyads.local_minima import best_dyads
from burmester.dyads.rail_sliders import sliders_on_rail
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point, Segment, box
from burmester.tasks.limits import Limits
from burmester.tasks.rails import Rail
from tests.samples import samples


def random_poses(rng, count, noise):
    """Poses near a slider's, and its line: a point and the direction."""
    turn, pin = np.cumsum(rng.uniform(0.1, 0.6, count)), rng.normal(size=2)
    angle, at = rng.uniform(-np.pi / 2, np.pi / 2), rng.normal(size=2)
    along = np.cumsum(rng.uniform(0.2, 0.8, count))
    pins = at + along[:, None] * [np.cos(angle), np.sin(angle)]
    c, s = np.cos(turn), np.sin(turn)
    arm = np.stack([c * pin[0] - s * pin[1], s * pin[0] + c * pin[1]], axis=-1)
    origins = pins - arm + noise * rng.normal(size=(count, 2))
    return Displacement(origins, turn), at, np.degrees(angle)


def by_scipy(poses, stated, rng, starts=12):
    """The least root mean square of a pin's distances from lines on the rail, by SLSQP."""
    direction, tolerance, ends, corners = stated
    cos, sin, d = np.cos(poses.angle), np.sin(poses.angle), poses.translation

    def pins(x):
        return np.stack(
            [cos * x[2] - sin * x[3] + d[:, 0], sin * x[2] + cos * x[3] + d[:, 1]], axis=-1
        )

    def cost(x):
        along = pins(x) @ [np.cos(x[0]), np.sin(x[0])] - x[1]
        return (along**2).mean()

    def kept(x):
        sides = ends @ [np.cos(x[0]), np.sin(x[0])]
        at = pins(x)
        room = np.concatenate([at - corners[0], corners[1] - at]).ravel()
        return np.concatenate([[x[1] - sides.min(), sides.max() - x[1]], room])

    middle, best = np.radians(direction + 90), np.inf
    bounds = [(middle - tolerance, middle + tolerance)] + [(None, None)] * 3
    for _ in range(starts):
        start = np.r_[middle + rng.uniform(-tolerance, tolerance), rng.normal(size=3)]
        found = minimize(
            cost, start, bounds=bounds, constraints={"type": "ineq", "fun": kept}, method="SLSQP"
        )
        if kept(found.x).min() > -1e-7:
            best = min(best, found.fun)
    return np.sqrt(best)


@pytest.mark.parametrize("number", samples(30, 2))
def test_no_slider_on_the_rail_is_nearer(number):
    rng = np.random.default_rng([number, 5])
    poses, at, angle = random_poses(rng, int(rng.integers(4, 10)), 0.05)
    tolerance = rng.uniform(1, 20)
    direction = angle + rng.uniform(-2, 2) * tolerance
    ends = at + rng.normal(size=(2, 2)) * 0.3
    corners = at - rng.uniform(1, 4, 2), at + rng.uniform(1, 4, 2)
    rail = Rail(direction, tolerance, Segment(*ends), box(*corners))
    stated = direction, np.radians(tolerance), ends, corners
    count = poses.shape[0]
    share, loose = np.full(count, 1 / count), np.zeros(count, dtype=bool)
    found = sliders_on_rail(poses, rail, None, share, loose)
    least = by_scipy(poses, stated, rng)
    assert np.isfinite(least) == bool(len(found))
    if len(found):
        normal = np.array([np.cos(found[0, 0]), np.sin(found[0, 0])])
        pins = poses.act(found[0, 2:])
        rms = np.sqrt(((pins @ normal - found[0, 1]) ** 2).mean())
        assert rms <= least * (1 + 1e-5) + 1e-9
        off = (np.degrees(found[0, 0]) - 90 - direction + 90) % 180 - 90
        assert abs(off) <= tolerance + 1e-5
        sides = ends @ normal
        assert sides.min() - 1e-6 <= found[0, 1] <= sides.max() + 1e-6
        assert (pins >= corners[0] - 1e-6).all()
        assert (pins <= corners[1] + 1e-6).all()


@pytest.mark.parametrize("kind", ["rail", "slot"])
def test_exact_poses_are_met_on_an_exact_line(kind):
    """Two exact poses and a line leave one slider; the others are met as nearly as can be."""
    rng = np.random.default_rng(8)
    poses, at, angle = random_poses(rng, 6, 0.03)
    given = poses if kind == "rail" else poses.inverse()
    limits = Limits(**{kind: Rail(angle, 0, Point(at))})
    exact = np.arange(6) < 2
    best = best_dyads(given, exact=exact, limits=limits)
    assert len(best.sliders) == 1
    slider = best.search.frames.line_from_canonical(best.sliders[0])
    assert abs(slider.residual(given)[:2]).max() < 1e-9
    assert abs(slider.residual(given)[2:]).max() > 1e-3
    assert np.sin(float(slider.normal_angle) - np.pi / 2 - np.radians(angle)) == pytest.approx(0)
