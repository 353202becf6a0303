"""Linkages that bear what is asked, against energies along motions computed from circles alone."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from burmester import RR, Linkage, Task, read_task
from burmester.io.templates import text
from burmester.linkages.bearing_linkages import only_bears_too_much
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.limits import Limits
from burmester.tasks.loads import Loads, Mass
from burmester.tasks.requirements import Requirements

# A lid that a four-bar with pivots (35, -153), (104, -31) and (33, -45), (61, -14) opens.
LID = (
    *((0, 0, 0), (1.21, -10.5, 15), (5.12, -24.61, 30), (10.95, -41.07, 45)),
    *((18.92, -58.5, 60), (29.66, -75.81, 75), (43.76, -92.31, 90)),
)
MASS, CENTRE, HAND, GRAVITY = 4.0, 210 + 9j, 420 + 0j, 9.80665


def lid(bound, rows=LID, **asked):
    loads = Loads(body=Mass(MASS, np.array([CENTRE.real, CENTRE.imag])), hand=np.array([420.0, 0]))
    task = replace(Task.from_rows(list(rows), angle_unit="deg"), length_unit="mm")
    return replace(task, loads=loads, requirements=Requirements(hand_force_N=bound, **asked))


@cache
def answer(bound):
    return synthesize(lid(bound))


def pivots_of(linkage):
    """Fixed and moving pivots (2,), complex, and radii (2,)."""
    both = linkage.first, linkage.second
    points = [[each.fixed_pivot, each.moving_pivot] for each in both]
    fixed, moving = np.moveaxis(np.array(points) @ [1, 1j], 0, 1)
    return fixed, moving, np.array([float(each.radius) for each in both])


def origins(pivots, angle, near=0):
    """Where the body's origin is at angles (n,): circles about both pivots meet there."""
    fixed, moving, radius = pivots
    one, two = fixed[:, None] - moving[:, None] * np.exp(1j * angle)
    far = abs(two - one)
    along = (far**2 + radius[0] ** 2 - radius[1] ** 2) / (2 * far)
    with np.errstate(invalid="ignore"):
        across = np.sqrt(radius[0] ** 2 - along**2)
    ways = [one + (along + sign * 1j * across) * (two - one) / far for sign in (1, -1)]
    return min(ways, key=lambda way: abs(way[abs(angle).argmin()] - near))


def hand_force(pivots, angle):
    """The greatest force along the path of the hand: the slope of the energy by its length."""
    origin, turn = origins(pivots, angle), np.exp(1j * angle)
    height, hand = (origin + CENTRE * turn).imag, origin + HAND * turn
    return MASS * GRAVITY * np.abs(np.diff(height) / np.abs(np.diff(hand))).max()


def transmission(pivots, angle, driver):
    """The least angle, degrees, between the coupler and the link that follows."""
    fixed, moving, _ = pivots
    pins = origins(pivots, angle) + moving[:, None] * np.exp(1j * angle)
    coupler, link = pins[1] - pins[0], pins[1 - driver] - fixed[1 - driver]
    return np.degrees(np.arcsin(np.abs(np.sin(np.angle(coupler / link))))).min()


def error(pivots, length):
    """The root mean square over the poses, each at its nearest place."""
    x, y, degrees = np.array(LID).T
    angle = np.radians(np.linspace(-6, 96, 8001))
    off = np.abs(origins(pivots, angle) - (x + 1j * y)[:, None]) ** 2
    off = off + (length * (angle - np.radians(degrees)[:, None])) ** 2
    return np.sqrt(np.nanmin(off, axis=1).mean())


def test_a_lid_is_found_whose_hand_needs_less_than_any_nearer_one():
    """All that meet the poses better need some 18 N; one that needs 16 N misses by 0.7 mm."""
    found = answer(16.0)
    best, *others = found.linkages
    assert best.usable
    assert not best.shortcomings
    assert all(only_bears_too_much(each) for each in others[:5])
    angle = np.linspace(*best.error.places.angle[[0, -1]], 4001)
    pivots = pivots_of(best.linkage)
    assert hand_force(pivots, angle) == pytest.approx(
        best.loads.measures["hand_force"], rel=1e-3
    )  # fmt: skip
    assert hand_force(pivots, angle) <= 16
    for each in others[:5]:
        assert hand_force(pivots_of(each.linkage), angle) > 17
    assert best.error.worst < 1
    assert best.combined_error == pytest.approx(error(pivots, found.problem.length_per_radian),
                                                rel=1e-2)  # fmt: skip


def test_no_small_change_of_its_pivots_is_better():
    """Random steps of all pivots: none comes nearer to the poses under the same bounds."""
    found = answer(16.0)
    best, length = found.linkages[0], found.problem.length_per_radian
    driver = int(best.preferred_driver == "second")
    own, rng = pivots_of(best.linkage), np.random.default_rng(3)
    least, tried = error(own, length), 0
    angle = np.linspace(*best.error.places.angle[[0, -1]], 401)
    x, y, degrees = np.array(LID).T
    poses, turns = x + 1j * y, np.exp(1j * np.radians(degrees))
    most, lowest = hand_force(own, angle), transmission(own, angle, driver)
    for _ in range(1500):
        fixed, moving = 10 ** rng.uniform(-4, -1) * rng.normal(size=(2, 2, 2)) @ [1, 1j]
        fixed, moving = own[0] + fixed, own[1] + moving
        far = abs(poses + moving[:, None] * turns - fixed[:, None])
        old = abs(poses + own[1][:, None] * turns - own[0][:, None])
        moved = fixed, moving, own[2] + (far - old).mean(axis=1)
        if error(moved, length) < least * (1 - 1e-4):
            tried += 1
            bears = hand_force(moved, angle) <= most
            assert not (bears and transmission(moved, angle, driver) >= lowest)
    assert tried > 30  # there are nearer ones, and they bear more or transmit worse


def test_three_poses_are_met_exactly_by_one_that_bears_what_none_of_a_family_did():
    rows = LID[::3]
    found = synthesize(replace(lid(15.8, rows), limits=(Limits(kinds=frozenset({"RR"})),)))
    best = found.linkages[0]
    assert best.usable
    assert best.error.worst < 1e-9
    fixed, moving, radius = pivots_of(best.linkage)
    angle = np.radians(np.linspace(0, 90, 2001))
    assert hand_force((fixed, moving, radius), angle) <= 15.8
    for x, y, degrees in rows:
        pins = x + 1j * y + moving * np.exp(1j * np.radians(degrees))
        assert np.abs(abs(pins - fixed) - radius).max() < 1e-9


def test_near_a_given_linkage_one_is_found_that_bears_less():
    fixed, moving = np.array([[35, -153], [104, -31]]), np.array([[33, -45], [61, -14]])
    dyads = [RR(f, m, np.hypot(*(m - f))) for f, m in zip(fixed, moving, strict=True)]
    given, *better = judge_linkage(lid(16.0), Linkage(*dyads), improve=True).linkages
    assert only_bears_too_much(given)
    assert better
    for each in better:
        angle = np.linspace(*each.error.places.angle[[0, -1]], 2001)
        assert hand_force(pivots_of(each.linkage), angle) <= 16


def test_of_a_path_linkages_are_found_whose_pins_bear_less_than_the_weight(tmp_path):
    """A weight of 49 N hangs near a pin of all that come nearest: none bears less than that."""
    file = tmp_path / "line.toml"
    asked = text("straight-line").replace("[requirements]\n", "[requirements]\npin_force_N = 40\n")
    file.write_text(asked + "\n[loads]\nbody = { mass_kg = 5, center = [0, 0] }\n")
    found = synthesize(read_task(str(file)))
    usable = [each for each in found.linkages if each.usable]
    assert usable
    for each in found.linkages:
        force = _of_followers_pin(each)
        assert max(force) == pytest.approx(max(each.loads.pins.values()), rel=1e-2)
        assert (max(force) <= 40) == each.usable


def _of_followers_pin(found):
    """The greatest forces of both moving pins: the coupler bears a weight at its origin.

    The follower bears along itself alone; moments about the driver's pin give how much.
    """
    first, second = found.driver_first.first, found.driver_first.second
    places = found.travel()(np.linspace(0, 1, 721)).places
    pins = [places.act(each.moving_pivot) @ [1, 1j] for each in (first, second)]
    along = pins[1] - second.fixed_pivot @ [1, 1j]
    along /= abs(along)
    weight = -1j * 5 * GRAVITY
    arm = np.conj(places.translation @ [1, 1j] - pins[0])
    pull = -(arm * weight).imag / (np.conj(pins[1] - pins[0]) * along).imag
    return np.abs(pull).max(), np.abs(weight + pull * along).max()
