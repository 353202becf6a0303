"""Crank-driven linkages in closed form, against linkages that the witness drives."""

import numpy as np
import pytest

from burmester.curves.crank_linkages import CrankLinkages
from burmester.geometry.displacement import Displacement
from tests.oracles.coupler_curves import dyads_of, random_crank, traced

STEP = 1e-6


def drawn(seed):
    rng = np.random.default_rng(seed)
    z, side = random_crank(rng)
    linkages = CrankLinkages(z[None], np.array([1.0 if side == 0 else -1.0]))
    t = rng.uniform(0, 2 * np.pi, 7)
    if not np.allclose(linkages.at(t[None]).point[0], traced(dyads_of(z), side, t)):
        side = 1 - side  # which is which is the witness's own choice
    return rng, z, side, linkages, t


@pytest.mark.parametrize("seed", range(4))
def test_points_and_their_velocities(seed):
    _, z, side, linkages, t = drawn(seed)
    places = linkages.at(t[None])
    assert np.allclose(places.point[0], traced(dyads_of(z), side, t), atol=1e-12)
    change = traced(dyads_of(z), side, t + STEP) - traced(dyads_of(z), side, t - STEP)
    assert np.allclose(places.velocity[0], change / (2 * STEP), atol=1e-5)


def test_there_and_back_as_pairs_of_dyads():
    _, _, _, linkages, t = drawn(5)
    batch, rows = linkages.batch(), linkages.rows(t[None])
    places = Displacement(rows[..., :2], rows[..., 2])
    assert np.abs(batch.jacobians(places).residual).max() < 1e-12
    back, angles = CrankLinkages.of(batch, rows)
    assert np.allclose(back.dimensions, linkages.dimensions)
    assert back.assembly == linkages.assembly
    assert np.allclose(np.exp(1j * angles), np.exp(1j * t))


def test_moved_and_mirrored_curves():
    _, _, _, linkages, t = drawn(6)
    traced_here = linkages.at(t[None]).point
    factor, shift = np.array([0.4 - 1.1j]), np.array([3.0 + 2j])
    there = linkages.moved(factor, shift).at(t[None] + np.angle(factor))
    assert np.allclose(there.point, factor * traced_here + shift)
    assert np.allclose(linkages.mirrored().at(-t[None]).point, traced_here.conj())


def test_full_turns_by_trying_them():
    rng = np.random.default_rng(3)
    z = np.concatenate([np.zeros((200, 2)), rng.uniform(0.2, 1, (200, 7))], axis=1)
    z[:, 3] = 0
    wanted = [
        np.isfinite(traced(dyads_of(row), 0, np.linspace(0, 2 * np.pi, 361))).all() for row in z
    ]
    linkages = CrankLinkages(z, np.ones(200))
    clear = np.abs(linkages.fullness()).min(axis=1) > 1e-3
    assert clear.sum() > 150
    assert (linkages.turns_fully() == np.array(wanted))[clear].all()
