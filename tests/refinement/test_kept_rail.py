"""Rails as constraints: what they say of linkages, and their derivatives."""

import numpy as np
import pytest

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.regions import Point, Polygon, Segment, box
from burmester.refinement.kept_limits import RailConstraint
from burmester.tasks.limits import Limits
from burmester.tasks.rails import Rail

FRAMES = CanonicalFrames(np.array([3.0, -1.0]), np.zeros(2), np.asarray(2.0))
LENGTH = 1.7  # what a radian counts as
STAR = Polygon([(0, 0), (6, 1), (8, 6), (5, 3), (-2, 6)])
RAILS = {
    "line": Rail(30, 5, Segment([0, 0], [1, 3])),
    "exact": Rail(30, 0, Point([1, 2]), box((-4, -2), (4, 2))),
    "hollow": Rail(travel=STAR),
    "thin": Rail(travel=Segment([0, 0], [4, 1])),
}


@pytest.mark.parametrize("name", RAILS)
@pytest.mark.parametrize("kind", ["rail", "slot"])
def test_values_by_hand_and_derivatives_by_quotients(name, kind):
    rng = np.random.default_rng(len(name))
    rail, side, count, number = RAILS[name], 1, 3, 4
    limits = Limits(**{kind: rail})
    constraint = RailConstraint.of(side, limits, FRAMES, LENGTH)
    own = 1 if kind == "rail" else 2
    kinds = np.array([[0, own]] * count, dtype=np.int8)
    z = rng.normal(size=(count, 2, DIMENSIONS))
    rows, which = rng.normal(size=(count, number, 3)), np.arange(count)
    unknowns = 2 * DIMENSIONS + number
    jacobian = rng.normal(size=(count, number, 3, unknowns))
    value, slope, equal = constraint.differentiated(LinkageBatch(kinds, z), rows, which, jacobian)
    # By hand, in the task's own frame.
    origin = FRAMES.fixed_origin if kind == "rail" else np.zeros(2)
    at = slice(0, 2) if kind == "rail" else slice(2, 4)
    pin = z[:, side, 2:4] if kind == "rail" else z[:, side, :2]
    for k in range(count):
        angle, offset = z[k, side, at]
        line = 2 * offset + np.array([np.cos(angle), np.sin(angle)]) @ origin
        expected, _ = rail.line_excess(angle, line)
        shares = np.ones(len(expected))
        turns = 0 if rail.heading is None else (1 if rail.heading[1] == 0 else 2)
        shares[turns:] = 0.5
        assert value[k, : len(expected)] == pytest.approx(expected * shares)
        if rail.travel is not None:
            turn = np.exp(1j * rows[k, :, 2] / LENGTH)
            place = rows[k, :, 0] + 1j * rows[k, :, 1]
            hand = complex(*pin[k])
            there = place + turn * hand if kind == "rail" else (hand - place) / turn
            points = np.stack([there.real, there.imag], axis=-1) * 2 + origin
            off = rail.travel_excess(points) / 2
            beyond = off > 0
            got = value[k, len(expected) :]
            assert (got > 0).tolist() == beyond.tolist()
            if name in ("hollow", "thin"):
                assert got[beyond] == pytest.approx(off[beyond])
    # Derivatives, along each unknown.
    step = 1e-6
    for unknown in range(unknowns):
        ends = []
        for sign in (1, -1):
            moved = z.reshape(count, -1).copy()
            if unknown < 2 * DIMENSIONS:
                moved[:, unknown] += sign * step
            batch = LinkageBatch(kinds, moved.reshape(z.shape))
            ends.append(constraint(batch, rows + sign * step * jacobian[..., unknown], which)[0])
        quotient = (ends[0] - ends[1]) / (2 * step)
        assert slope[..., unknown] == pytest.approx(quotient, abs=2e-5)
    assert equal.sum() == rail.conditions - 1


def test_a_dyad_of_another_kind_is_left_alone():
    constraint = RailConstraint.of(0, Limits(rail=RAILS["exact"]), FRAMES, LENGTH)
    batch = LinkageBatch(np.zeros((1, 2), dtype=np.int8), np.ones((1, 2, DIMENSIONS)))
    value, equal = constraint(batch, np.zeros((1, 2, 3)), np.arange(1))
    assert (value[:, equal] == 0).all()
    assert (value[:, ~equal] < 0).all()
    assert RailConstraint.of(0, Limits(), FRAMES, LENGTH) is None
