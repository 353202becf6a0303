"""How a driver goes from pose to pose in time: rest at both ends, speeds, and power."""

from dataclasses import replace

import numpy as np
import pytest

from burmester.loads.drive_in_time import course_of
from burmester.loads.load_figures import load_figures
from burmester.tasks.loads import Drive
from tests.oracles.loaded_linkages import KINDS, loaded_linkage, random_loads

PROFILES = ["constant", "3-4-5", "trapezoid"]
GREATEST = {"constant": (1, 0), "3-4-5": (1.875, 10 / np.sqrt(3)), "trapezoid": (1.5, 4.5)}


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("duration", [0.3, 2.0])
def test_a_course_goes_all_the_way_and_its_derivatives_are_its_own(profile, duration):
    course = course_of(Drive(duration, profile), 30_001)
    assert course.share[[0, -1]] == pytest.approx([0, 1], abs=1e-15)
    assert (course.time[0], course.time[-1]) == (0, duration)
    assert (np.diff(course.share) > 0).all()
    step = course.time[1]
    speed = (course.share[2:] - course.share[:-2]) / (2 * step)
    assert course.speed[1:-1] == pytest.approx(speed, abs=2e-4 / duration)
    push = (course.speed[2:] - course.speed[:-2]) / (2 * step)
    off = np.abs(course.acceleration[1:-1] - push) > 1e-2 / duration**2
    assert off.sum() <= 4  # beside the steps of a trapezoid's acceleration
    most, hardest = GREATEST[profile]
    assert course.speed.max() == pytest.approx(most / duration, rel=1e-6)
    assert np.abs(course.acceleration).max() == pytest.approx(hardest / duration**2, rel=1e-6)
    if profile != "constant":
        assert course.speed[[0, -1]] == pytest.approx([0, 0], abs=1e-15)
    if profile == "3-4-5":
        assert course.acceleration[[0, -1]] == pytest.approx([0, 0], abs=1e-15)


def driven(rng, names, metre):
    """Loads without forces that turn, moved in some time."""
    loads = random_loads(rng, names, metre)
    drive = Drive(rng.uniform(0.2, 3), str(rng.choice(PROFILES)))
    return replace(loads, forces=(), drive=drive)


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("kind", KINDS)
def test_power_is_the_rate_of_all_energies(kind, seed):
    """The driver's torque times its speed: the rate of kinetic and potential energy, but for M."""
    _, linkage = loaded_linkage(kind, seed, driven)
    drive, torque = linkage.loads.drive, linkage.loads.torque
    course = course_of(drive, 3001)
    loaded = linkage.at_driver(course.share)
    way = float(loaded.drive[-1] - loaded.drive[0])
    speed, push = course.speed * way, course.acceleration * way
    resisted = loaded.carried(speed, push) - loaded.applied
    effort = loaded.rates.effort(resisted)
    body = np.unwrap(loaded.places[loaded.bodies.body].angle)
    energy = loaded.inertia[0] * speed**2 / 2 + loaded.energy - torque * body
    rate = np.gradient(energy, course.time)
    power = effort * speed
    size = np.abs(power).max() + np.abs(loaded.gross * speed).max()
    off = np.abs(rate - power)[1:-1] / size
    # Springs that go slack, and the steps of a trapezoid, are kinks between two places.
    assert np.quantile(off, 0.98) < 1e-4
    figures = load_figures(linkage.found)
    told = figures.drive
    assert (told.drive.duration_s, told.drive.profile) == (drive.duration_s, drive.profile)
    near = 2e-2 * np.ptp(effort) + 1e-9  # of a trapezoid the last look before a step may count
    assert told.effort.least == pytest.approx(effort.min(), abs=near)
    assert told.effort.greatest == pytest.approx(effort.max(), abs=near)


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("kind", KINDS)
def test_speed_and_acceleration_are_those_of_the_places_in_time(kind, seed):
    _, linkage = loaded_linkage(kind, seed, driven)
    drive = Drive(linkage.loads.drive.duration_s, "3-4-5")
    loads = replace(linkage.loads, drive=drive)
    found = replace(linkage.found, task=replace(linkage.found.task, loads=loads))
    course = course_of(drive, 4001)
    at = linkage.at_driver(course.share).places[linkage.bodies.body].translation / linkage.metre
    velocity = np.gradient(at, course.time, axis=0, edge_order=2)
    push = np.gradient(velocity, course.time, axis=0, edge_order=2)
    told = load_figures(found).drive
    assert told.speed == pytest.approx(np.hypot(*velocity.T).max(), rel=1e-3)
    assert told.acceleration == pytest.approx(np.hypot(*push.T).max(), rel=1e-2)
