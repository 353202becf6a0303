"""How a driver goes from pose to pose in time: rest at both ends, speeds, and power."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from burmester.errors import InputError
from burmester.loads.drive_in_time import Timing, course_of, course_through
from burmester.loads.kinematics import kinematics
from burmester.loads.load_figures import load_figures
from burmester.tasks.loads import Drive
from tests.oracles.loaded_linkages import KINDS, loaded_linkage, random_loads

PROFILES = ["constant", "3-4-5", "trapezoid"]
GREATEST = {"constant": (1, 0), "3-4-5": (1.875, 10 / np.sqrt(3)), "trapezoid": (1.5, 4.5)}


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("duration", [0.3, 2.0])
def test_a_course_goes_all_the_way_and_its_derivatives_are_its_own(profile, duration):
    course = course_of(Timing(Drive(duration, profile)), 30_001)
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
    course = course_of(Timing(drive), 3001)
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
    course = course_of(Timing(drive), 4001)
    at = linkage.at_driver(course.share).places[linkage.bodies.body].translation / linkage.metre
    velocity = np.gradient(at, course.time, axis=0, edge_order=2)
    push = np.gradient(velocity, course.time, axis=0, edge_order=2)
    told = load_figures(found).drive
    assert told.speed == pytest.approx(np.hypot(*velocity.T).max(), rel=1e-3)
    assert told.acceleration == pytest.approx(np.hypot(*push.T).max(), rel=1e-2)


def at_rows(times, shares):
    """A timing through shares at times: rows of degrees of a driver that turns by 100°."""

    class Motion:
        in_turns = True

        def __init__(self, at):
            self.pose_shares = np.array([0.0, 1.0])
            self.drive = np.radians(100) * np.asarray(at)

    return Timing.of(
        Drive.through([*zip(times, 100 * np.asarray(shares), strict=True)]), Motion, None
    )


def test_two_rows_are_the_polynomial_3_4_5():
    """Rest to rest without a jump of the acceleration has one polynomial of degree five."""
    one = course_of(at_rows([0, 2.5], [0, 1]), 101)
    for mine, other in zip(one, course_of(Timing(Drive(2.5, "3-4-5")), 101), strict=True):
        assert mine == pytest.approx(other, abs=1e-13)


def test_where_nothing_is_limited_it_is_a_cubic_spline():
    times = np.array([0, 1, 2, 2.5, 3.5, 5])
    shares = np.array([0, 0.15, 0.45, 0.6, 0.85, 1])
    timing = at_rows(times, shares)
    spline = CubicSpline(times, shares, bc_type="clamped")
    course = course_of(timing, 5001)
    inner = (course.time > times[1]) & (course.time < times[-2])
    for mine, order in zip(course[1:], range(3), strict=True):
        assert mine[inner] == pytest.approx(spline(course.time[inner], order), abs=1e-12)


@pytest.mark.parametrize("seed", range(40))
def test_tables_are_kept_smoothly_and_turn_back_nowhere_else(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 12))
    times = np.concatenate([[0], np.cumsum(rng.uniform(0.05, 2, count))])
    shares = rng.choice(np.linspace(0, 1, 5), count + 1)  # there and back, and holds
    if seed % 3 == 0:
        shares = np.sort(rng.uniform(size=count + 1))
    timing = at_rows(times, shares)
    course = course_of(timing, 100_001)
    assert np.interp(times, course.time, course.share) == pytest.approx(shares, abs=1e-6)
    step, size = course.time[1], np.abs(course.acceleration).max() + 1e-9
    speed = np.gradient(course.share, step)
    assert course.speed[1:-1] == pytest.approx(speed[1:-1], abs=1e-2 * size * step + 1e-9)
    push = np.gradient(course.speed, step)
    jerk = np.abs(np.diff(course.acceleration)).max()
    assert course.acceleration[1:-1] == pytest.approx(push[1:-1], abs=2 * jerk + 1e-9)
    assert jerk < 60 * size * step / np.diff(times).min()  # without jumps
    assert course.speed[[0, -1]] == pytest.approx([0, 0], abs=1e-12)
    assert course.acceleration[[0, -1]] == pytest.approx([0, 0], abs=1e-9)
    for k in range(count):
        inside = (course.time >= times[k]) & (course.time <= times[k + 1])
        way = shares[k + 1] - shares[k]
        if way:
            assert (course.speed[inside] * np.sign(way) >= -1e-7).all()
        else:
            assert np.abs(course.speed[inside]).max(initial=0.0) < 1e-9
    sought = np.linspace(0.013, 0.987, 24)  # at no row
    first = course_through(timing, sought)
    for share, time in zip(sought, first.time, strict=True):
        side = np.sign(course.share - share)
        met = np.flatnonzero(side[:-1] * side[1:] <= 0)
        if np.isnan(time):
            assert not len(met)
        else:
            assert time == pytest.approx(course.time[met[0]], abs=2 * step)


@pytest.mark.parametrize("kind", KINDS)
def test_a_table_of_poses_stops_at_each(kind):
    """There and back: at its times the driver is where the linkage meets the poses, and stands."""
    _, linkage = loaded_linkage(kind, 3, driven)
    last = len(linkage.at_poses)
    rows = [(0, "1"), (1.0, str(last)), (1.5, str(last)), (2.0, "2"), (2.25, "2"), (3.0, "1")]
    drive = Drive.through(rows)
    loads = replace(linkage.loads, drive=drive)
    found = replace(linkage.found, task=replace(linkage.found.task, loads=loads))
    moved = kinematics(found, drive, 1201)
    unit = np.degrees(1.0) if linkage.at(2).rates.turns else 1 / linkage.metre
    at = linkage.at_poses * unit
    for time, pose in rows:
        k = round(time * 400)
        assert moved.driver[k] == pytest.approx(at[int(pose) - 1], abs=1e-6 * np.ptp(at))
        assert abs(moved.driver_speed[k]) <= 1e-6 * np.ptp(at)
    assert np.ptp(moved.driver[400:601]) <= 1e-9 * np.ptp(at)
    told = load_figures(found).drive
    assert (told.drive.duration_s, told.drive.profile) == (3.0, "table")
    speeds = np.hypot(*moved.velocity.T)
    assert told.speed == pytest.approx(speeds.max(), rel=2e-2)


def test_what_a_linkage_cannot_keep_makes_it_unusable():
    _, linkage = loaded_linkage("RR-RR", 1, driven)
    turned = abs(np.degrees(linkage.at(2).drive @ [-1, 1]))
    for rows, why in (
        ([(0, 0.0), (1, turned * 1.01)], "turns its driver by"),
        ([(0, "1"), (1, "ajar")], "has no pose 'ajar'"),
    ):
        loads = replace(linkage.loads, drive=Drive.through(rows))
        found = replace(linkage.found, task=replace(linkage.found.task, loads=loads))
        figures = load_figures(found)
        assert figures.drive is None
        assert why in next(each.message for each in figures.findings if each.kind == "drive")
        with pytest.raises(InputError, match=why):
            kinematics(found, loads.drive, 11)
    half = replace(linkage.loads, drive=Drive.through([(0, 0.0), (1, turned / 2)]))
    found = replace(linkage.found, task=replace(linkage.found.task, loads=half))
    driver = kinematics(found, half.drive, 3).driver
    assert abs(driver[-1] - driver[0]) == pytest.approx(turned / 2, rel=1e-9)
