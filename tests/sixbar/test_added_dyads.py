"""The dyads that are added to a 3R chain: they meet the poses, and there are no others."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from burmester.geometry.displacement import Displacement
from burmester.sixbar.added_dyads import ThreeRChain, added_dyads, with_first_dyad
from burmester.sixbar.watt import WATT_I
from tests.sixbar.tasks import BENT, REACH

CHAINS = [
    ((-1.0, -4.0), 7.0, 8.0, (1.0, 2.0), REACH, 1.0),
    ((9.0, -3.0), 6.5, 7.0, (-1.0, 1.5), REACH, -1.0),
    ((2.0, -1.0), 6.0, 5.0, (1.0, -0.5), BENT, 1.0),
]


def chain_of(numbers):
    fixed, first, second, moving, rows, side = numbers
    rows = np.array(rows, dtype=float)
    rows[:, 2] = np.radians(rows[:, 2])
    chain = ThreeRChain(
        np.array([fixed]), np.array([first]), np.array([second]), np.array([moving])
    )
    return chain, Displacement.from_poses(rows[None]), np.array([side])


def random_start_dyads(poses, seed, starts=30):
    """Every RR dyad that random starts find: rows of fixed pivot, moving pivot, radius."""
    d = poses.translation @ [1, 1j]
    turn = np.exp(1j * poses.angle)
    size = np.abs(d - d.mean()).max() + 1

    def gaps(x):
        ends = d + turn * complex(x[2], x[3]) - complex(x[0], x[1])
        return (np.abs(ends) ** 2 - x[4]) / size**2

    random, found = np.random.default_rng(seed), []
    for _ in range(starts):
        start = size * random.normal(0, 2, 4) + [d.mean().real, d.mean().imag, 0, 0]
        start = [*start, abs(d[0] + turn[0] * complex(*start[2:]) - complex(*start[:2])) ** 2]
        end = least_squares(gaps, start, xtol=1e-15, ftol=1e-15, gtol=1e-15, method="lm")
        if np.abs(end.fun).max() < 1e-13 and np.abs(end.x[:4]).max() < 300 * size:
            row = end.x[:4]
            if all(np.abs(row - each).max() > 1e-4 * size for each in found):
                found.append(row)
    return np.array(found)


@pytest.mark.parametrize("chain", CHAINS)
def test_both_steps_find_every_dyad_that_random_starts_find(chain):
    chains, poses, side = chain_of(chain)
    bars = with_first_dyad(chains, poses, side)
    elbow = chains.elbows(poses, side)
    middle = chains.middle_link(poses, elbow)[0]
    own = np.concatenate([bars.dyad.fixed_pivot, bars.dyad.moving_pivot], axis=-1)
    trivial = np.array([*chain[0], 0.0, 0.0])
    brute = random_start_dyads(middle, 1)
    assert 2 <= len(brute) <= len(own) + 1  # the chain's own link as well
    for row in brute:
        assert min(np.abs(each - row).max() for each in [*own, trivial]) < 1e-4
    # The second step, of the first four-bar: the body as its second crank sees it.
    b, d = bars.joints[0, :, 1], bars.joints[0, :, 3]
    at = poses[0].translation @ [1, 1j]
    seen = (at - b) / (d - b) * abs(d - b)
    relative = Displacement(
        np.stack([seen.real, seen.imag], axis=-1), poses[0].angle - np.angle(d - b)
    )
    added = added_dyads(chains, poses, side)
    same = np.abs(added.linkages.fixed_second - bars.dyad.fixed_pivot[0]).max(axis=-1) < 1e-9
    links = added.linkages[same]
    own = np.concatenate([links.crank_joint, links.link_joint], axis=-1)
    trivial = np.array([bars.dyad.radius[0], 0.0, *chain[3]])
    brute = random_start_dyads(relative, 2)
    assert 2 <= len(brute) <= len(own) + 1
    for row in brute:
        assert min(np.abs(each - row).max() for each in [*own, trivial]) < 1e-4


@pytest.mark.parametrize("chain", CHAINS)
def test_every_bar_keeps_its_length_at_the_poses(chain):
    chains, poses, side = chain_of(chain)
    added = added_dyads(chains, poses, side)
    assert 0 < len(added.task) <= 9
    linkages, there, at = added.linkages, added.joints, poses[added.task]
    ends = np.array([[WATT_I.joints.index(joint) for joint in bar] for bar in WATT_I.bars]).T
    off = np.abs(there[..., ends[0]] - there[..., ends[1]]) - linkages.lengths()[:, None]
    assert np.abs(off).max() < 1e-10
    on_ground = linkages.fixed_first[:, None], linkages.fixed_second[:, None]
    on_body = (at.act(each[:, None]) for each in (linkages.body_joint, linkages.link_joint))
    for joint, place in zip("ABEH", (*on_ground, *on_body), strict=True):
        assert np.abs(there[..., WATT_I.joints.index(joint)] - place @ [1, 1j]).max() < 1e-10
