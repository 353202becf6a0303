"""Peaks narrower than the places that are looked at: against functions whose greatest is known."""

import numpy as np
import pytest

from burmester.loads.peaks import Seen, with_peaks

EVEN = np.linspace(0.0, 1.0, 361)


def about_peaks(force, apart):
    """The places and the forces there; what is seen beside them comes in their order as well."""
    places, seen = with_peaks(EVEN, lambda x: Seen(force(x)[None], apart(x)[None], x[None]))
    assert (seen.others[0] == places).all()
    assert (seen.values[0] == force(places)).all()
    return places, seen.values[0]


@pytest.mark.parametrize("width", [1e-1, 1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize("seed", range(8))
def test_a_force_near_a_dead_point_is_found(seed, width):
    """It is a smooth one divided by a distance that is nowhere zero, as near a dead point."""
    rng = np.random.default_rng(seed)
    at, sign = rng.uniform(0.01, 0.99), rng.choice([-1.0, 1.0])

    def apart(x):
        return np.hypot(x - at, width)

    def force(x):
        return sign / apart(x) + np.sin(9 * x)

    _, found = about_peaks(force, apart)
    dense = force(at + width * np.linspace(-1, 1, 20_001))
    assert np.abs(found).max() == pytest.approx(np.abs(dense).max(), rel=1e-3)
    if width < 1e-3:  # even places alone would not do in most of the cases
        assert len(found) > len(EVEN)


def test_a_smooth_force_needs_no_more_places():
    places, _ = about_peaks(lambda x: np.sin(7 * x), lambda x: 1 + x)
    assert places is EVEN


@pytest.mark.parametrize("kink", [0.1234, 0.5001, 0.9])
def test_a_kink_is_followed(kink):
    """A spring that goes slack: the greatest is where two slopes meet."""

    def force(x):
        return np.where(x < kink, 3 * x / kink, 3 - 40 * (x - kink))

    _, found = about_peaks(force, np.ones_like)
    assert found.max() == pytest.approx(3.0, rel=1e-3)
