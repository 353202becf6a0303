"""Pivots that move for a spring: held against energies, the poses, the limits and random steps."""

from dataclasses import replace

import numpy as np
import pytest

from burmester import read_task
from burmester.io.spring_list import usual_springs
from burmester.synthesis import balanced
from tests.loads.test_balance import hand_by_energy, rub_at_hand
from tests.oracles import witness

SPRINGS = ["6-15 stroke 80, 100 N", "6-15 stroke 80, 150 N", "6-15 stroke 80, 200 N"]


@pytest.fixture(scope="module")
def found():
    """The lid of the examples without its spring, with one size of springs."""
    task = read_task("examples/sprung-lid.toml")
    task = replace(task, loads=replace(task.loads, springs=()))
    offers = [each for each in usual_springs("mm") if each.name in SPRINGS]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(balanced, "MOST_MOVED", 1)  # to be done soon
        patch.setattr(balanced, "TURNS", 2)
        return balanced.balance(task, offers, with_linkage=True)[1]


def test_less_force_is_left_and_all_else_is_kept(found):
    best = found[0]
    assert best.unmoved is not None
    assert best.keeps
    assert best.worst < 0.6 * best.unmoved.worst
    force = np.abs(hand_by_energy(best.found, best.spring)) + rub_at_hand(best.found, best.spring)
    assert best.worst == pytest.approx(force.max(), rel=1e-2)
    assert best.before == pytest.approx(np.abs(hand_by_energy(best.unmoved.found)).max(), rel=1e-3)
    poses, limits = best.found.task.poses, best.found.task.limits
    for each, limit in zip(best.found.dyads, limits, strict=True):
        pins = poses.act(each.dyad.moving_pivot) - each.dyad.fixed_pivot
        assert np.hypot(*pins.T) == pytest.approx(float(each.dyad.radius), abs=1e-9)
        for at, region in ((each.dyad.fixed_pivot, limit.fixed_pivot),
                           (each.dyad.moving_pivot, limit.moving_pivot)):  # fmt: skip
            assert float(region.distance(at)) <= 1e-6
    assert np.degrees(best.found.least_transmission) >= 40 - 1e-6


def test_of_each_linkage_the_best_stays_in_the_list(found):
    assert {each.found.id for each in found if each.unmoved is None} >= {
        each.unmoved.found.id for each in found if each.unmoved is not None
    }


def test_no_small_step_of_its_pivots_is_clearly_better(found):
    """Moving pivots about it, each with the centre of its three places; the spring stays."""
    best, rng = found[0], np.random.default_rng(2)
    task, spring = best.found.task, best.spring
    own = [each.dyad for each in best.found.dyads]
    assert _hand(own, task, spring) == pytest.approx(best.worst, rel=2e-2)
    tried = 0
    for _ in range(400):
        dyads = [_through(each.moving_pivot + rng.normal(0, 0.3, 2), task.poses, each)
                 for each in own]  # fmt: skip
        kept = all(
            float(limit.fixed_pivot.distance(each.fixed_pivot)) <= 0
            and float(limit.moving_pivot.distance(each.moving_pivot)) <= 0
            for each, limit in zip(dyads, task.limits, strict=True)
        )
        if kept:
            tried += 1
            assert _hand(dyads, task, spring) > 0.85 * best.worst
    assert tried > 30


def _through(moving, poses, dyad):
    """The dyad of a moving pivot: its three places are on a circle."""
    a, b, c = poses.act(moving)
    rows, right = 2 * np.array([b - a, c - a]), np.array([b @ b - a @ a, c @ c - a @ a])
    centre = np.linalg.solve(rows, right)
    return replace(dyad, moving_pivot=moving, fixed_pivot=centre,
                   radius=np.array(np.hypot(*(a - centre))))  # fmt: skip


def _hand(dyads, task, spring):
    """The greatest force of the hand of the linkage, driven by code of its own."""
    first, second = dyads
    arms = [task.poses.act(first.moving_pivot)[k] - first.fixed_pivot for k in (0, -1)]
    start, end = (np.arctan2(arm[1], arm[0]) for arm in arms)
    end = start + (end - start + np.pi) % (2 * np.pi) - np.pi
    origin, angle = witness.places(first, second, np.linspace(start, end, 801))
    wanted = task.poses.translation[0] @ [1, 1j]
    side = int(abs(origin[:, 0] - wanted).argmin())
    origin, turn = origin[side], np.exp(1j * angle[side])
    corners = task.body.vertices
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2 @ [1, 1j]
    one, two = (np.array(end.point) @ [1, 1j] for end in spring.ends)
    length = abs(origin + two * turn - one)
    rise = (spring["compressed_force_N"] - spring["force_N"]) / (spring["stroke"] - 10)
    push = spring.count * (spring["force_N"] + rise * (spring["length"] - 5 - length))
    gone = np.abs(np.diff(origin + (task.loads.hand @ [1, 1j]) * turn))
    lifted = task.loads.body.mass_kg * 9.80665 * np.diff((origin + middle * turn).imag)
    helped = (push[1:] + push[:-1]) / 2 * np.diff(length)
    rubbed = spring.count * spring["friction_N"] * np.abs(np.diff(length))
    return ((np.abs(lifted - helped) + rubbed) / gone).max()
