"""Places that trace points, beside the crank angles at which other code made them."""

import numpy as np
import pytest

from burmester.fourbar.box_places import Boxes
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.traced_places import places_along
from tests.oracles.coupler_curves import dyads_of, random_crank, traced

ROUND = np.linspace(0, 2 * np.pi, 24, endpoint=False)


def drawn(seed, angles):
    """A linkage whose crank turns fully, and points (n, 2) of its curve at crank angles."""
    z, side = random_crank(np.random.default_rng(seed))
    dyads = dyads_of(z)
    points = traced(dyads, side, angles)
    return dyads, np.column_stack([points.real, points.imag])


def steps_of_crank(dyads, rows):
    """By how much the crank goes on from each row (n, 3) to the next, and to the first again."""
    crank = dyads[0]
    pin = rows[:, :2] @ [1, 1j] + np.exp(1j * rows[:, 2]) * (crank.moving_pivot @ [1, 1j])
    angle = np.angle(pin - crank.fixed_pivot @ [1, 1j])
    return (np.diff(angle, append=angle[0]) + np.pi) % (2 * np.pi) - np.pi


def places(dyads, points, bound):
    boxes = Boxes(
        np.column_stack([points, np.zeros(len(points))]),
        np.broadcast_to(np.eye(2), (len(points), 2, 2)),
        np.tile([bound, bound, np.inf], (len(points), 1)),
        1.0,
    )
    batch = LinkageBatch.of([Linkage(*dyads)])
    (rows,) = places_along(batch, points, 1.0, boxes=boxes)
    return rows, boxes


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("seed", range(4))
def test_points_of_the_curve_are_met_where_they_were_made(seed, sense):
    dyads, points = drawn(seed, sense * (0.3 + ROUND))
    rows, _ = places(dyads, points, 1e-3)
    assert np.abs(rows[:, :2] - points).max() < 1e-6
    assert sense * steps_of_crank(dyads, rows) == pytest.approx(np.full(24, np.pi / 12), abs=1e-4)


@pytest.mark.parametrize("at", [7, 23])
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("seed", range(4))
def test_exchanged_neighbours_share_a_place_inside_their_tolerances(seed, sense, at):
    """Also the last and the first of a closed path, and however the linkage goes round."""
    angles = sense * (0.3 + ROUND)
    angles[(at + 1) % 24] = angles[at] + sense * 0.02  # two that are close
    dyads, points = drawn(seed, angles)
    pair = [at, (at + 1) % 24]
    gap = np.abs(points[pair[0]] - points[pair[1]]).max()
    points[pair] = points[pair[::-1]]
    rows, boxes = places(dyads, points, 0.8 * gap)
    steps = sense * steps_of_crank(dyads, rows)
    assert steps.min() > -1e-9
    assert steps.sum() == pytest.approx(2 * np.pi)
    assert boxes.share(rows).max() <= 1
    rows, _ = places(dyads, points, 0.4 * gap)  # no place is inside both
    assert (sense * steps_of_crank(dyads, rows)).min() < -1e-4


@pytest.mark.parametrize("seed", range(4))
def test_feet_of_many_points_are_the_nearest_places(seed):
    """Beside a curve that is drawn by the witness in 20,000 places, on both sides and past ends."""
    dyads, fine = drawn(seed, np.linspace(0, 2 * np.pi, 20_000, endpoint=False))
    rng = np.random.default_rng(seed)
    at = np.sort(rng.integers(0, 20_000, 700))
    size = np.ptp(fine, axis=0).max()
    points = fine[at] + 1e-3 * size * rng.normal(size=(700, 2))
    (rows,) = places_along(LinkageBatch.of([Linkage(*dyads)]), points, 1.0)
    told = np.linalg.norm(rows[:, :2] - points, axis=1)
    beside = (at[:, None] + np.arange(-400, 401)) % 20_000
    chord = fine[(beside + 1) % 20_000] - fine[beside]
    to = points[:, None] - fine[beside]
    along = np.clip((to * chord).sum(axis=2) / (chord**2).sum(axis=2), 0, 1)
    least = np.linalg.norm(to - along[..., None] * chord, axis=2).min(axis=1)
    assert told == pytest.approx(least, abs=1e-7 * size)
