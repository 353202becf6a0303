"""Loads whose efforts have a formula: a hinge with a gas spring, a parallelogram in balance."""

import numpy as np
import pytest

from burmester import Polygon
from burmester.errors import InputError
from burmester.loads.load_figures import load_figures
from burmester.loads.loaded_motion import LoadedLinkage
from burmester.loads.masses import Masses
from burmester.mechanisms.bodies import GROUND, Bodies, Joint
from burmester.tasks.loads import STANDARD_GRAVITY as G
from burmester.tasks.loads import Drive, End, Force, Loads, Mass, Plates, Spring
from tests.oracles.handed_over import rr
from tests.oracles.heavy_links import away
from tests.oracles.loaded_linkages import METRE, driven_at

CRANK = (rr([0, 0], [0, 0], 100), rr([300, 0], [280, 0], 200))
PARALLEL = (rr([0, 0], [0, 0], 100), rr([300, 0], [300, 0], 100))
LID = np.radians([20, 50, 80, 100])


def ground(*point):
    return End("ground", point)


def crank(*point):
    return End("driver", point)


def lid(loads, dyads=CRANK, drives=LID, unit="mm"):
    return driven_at(dyads, drives, loads, unit, side=int(dyads is PARALLEL))


def hinged(count=1, celsius=20.0, friction=0.0):
    """A lid of 8 kg on the crank, whose other links weigh nothing, with gas springs."""
    gas = {"force_N": 350, "compressed_force_N": 480, "stroke": 100, "length": 260,
           "friction_N": friction}  # fmt: skip
    springs = (
        Spring("gas", (ground(-40, -180), crank(60, 20)), gas, count),
        Spring("counterweight", (ground(0, 0), crank(250, 30)), {"mass_kg": 8}),
    )
    return Loads(springs=springs, celsius=celsius)


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("celsius", [20.0, -10.0])
def test_a_hinge_with_a_gas_spring(count, celsius):
    """By the law of cosines, with the force of a maker's sheet."""
    linkage = LoadedLinkage.of(lid(hinged(count, celsius, friction=30)))
    loaded = linkage.at(101)
    q = loaded.drive
    assert (q[0], q[-1]) == pytest.approx((LID[0], LID[-1]), abs=1e-12)
    fixed, end = np.hypot(0.04, 0.18), np.hypot(0.06, 0.02)
    between = q + np.arctan2(20, 60) - np.arctan2(-180, -40)
    length = np.sqrt(fixed**2 + end**2 - 2 * fixed * end * np.cos(between))
    arm = fixed * end * np.sin(between) / length
    warm = (celsius + 273.15) / 293.15
    push = count * warm * (350 + (480 - 350) * (0.255 - length) / 0.09)
    weight = 8 * G * (0.25 * np.cos(q) - 0.03 * np.sin(q))
    (course,) = loaded.springs
    assert course.length == pytest.approx(length, rel=1e-12)
    assert course.tension == pytest.approx(-push, rel=1e-12)
    assert loaded.effort == pytest.approx(weight - push * arm, rel=1e-10, abs=1e-10)
    assert loaded.friction == pytest.approx(count * 30 * np.abs(arm), rel=1e-10)


@pytest.mark.parametrize("friction", [0.0, 300.0, 3000.0])
def test_it_stays_where_friction_is_enough(friction):
    figures = load_figures(lid(hinged(friction=friction)))
    loaded = LoadedLinkage.of(lid(hinged(friction=friction))).at(np.linspace(0, 1, 4))
    at_poses = LoadedLinkage.of(lid(hinged(friction=friction)))
    held = at_poses.at(at_poses.pose_shares)
    wanted = np.flatnonzero(np.abs(held.effort) <= held.friction)
    assert figures.stays == tuple(wanted)
    assert (len(wanted) == 4) == (friction == 3000.0)
    assert (len(wanted) == 0) == (friction == 0.0)
    assert np.isfinite(loaded.effort).all()


@pytest.mark.parametrize("unit", ["mm", "in", "m"])
def test_a_parallelogram_in_balance_rests_everywhere(unit):
    """By a spring of no free length, from above the pivot: k h s = m g a, wherever the crank is."""
    metre = METRE[unit]
    mass, above, along = 12.0, 150.0, 80.0
    rate = mass * G * 100 / (above * along * metre) / 1000  # N/mm
    spring = Spring(
        "extension", (ground(0, above), crank(along, 0)), {"rate_N_per_mm": rate, "free_length": 0}
    )
    loads = Loads(body=Mass(mass, [310, 40]), springs=(spring,))
    given = lid(loads, PARALLEL, np.radians([30, 60, 90, 130]), unit)
    loaded = LoadedLinkage.of(given).at(361)
    assert np.abs(loaded.effort).max() <= 1e-12 * mass * G * 100 * metre
    figures = load_figures(given)
    assert figures.stays == (0, 1, 2, 3)
    assert figures.rests == ()
    assert figures.effort.greatest == pytest.approx(0, abs=1e-12 * mass * G * 100 * metre)
    # A tenth more weight, and it rests nowhere but where the crank stands upright, not for long.
    heavier = Loads(body=Mass(1.1 * mass, [310, 40]), springs=(spring,))
    figures = load_figures(lid(heavier, PARALLEL, np.radians([30, 60, 80, 130]), unit))
    assert figures.stays == ()
    (rest,) = figures.rests
    assert not rest.stable
    assert rest.driver == pytest.approx(90, abs=1e-9)
    assert rest.between_poses == (3, 4)
    # A tenth less, and the spring pulls it there.
    lighter = Loads(body=Mass(0.9 * mass, [310, 40]), springs=(spring,))
    (rest,) = load_figures(lid(lighter, PARALLEL, np.radians([130, 60, 30]), unit)).rests
    assert rest.stable
    assert rest.between_poses == (1, 2)


def test_a_parallelogram_carries_a_weight_wherever_it_lies():
    """Its body only translates: the torque is the weight times the crank's reach."""
    for centre in ([0, 0], [310, 40], [-900, 777]):
        loads = Loads(body=Mass(3, centre, 5.0))
        loaded = LoadedLinkage.of(lid(loads, PARALLEL, np.radians([30, 60, 90, 130]))).at(50)
        assert loaded.effort == pytest.approx(3 * G * 0.1 * np.cos(loaded.drive), abs=1e-12)
        inertia, slope = loaded.inertia
        assert inertia == pytest.approx(np.full(50, 3 * 0.1**2), rel=1e-12)
        assert slope == pytest.approx(np.zeros(50), abs=1e-12)


def test_a_hand_pushes_along_the_path_of_its_point():
    """At the end of a crank, and in either direction: the force times the reach is the torque."""
    loads = Loads(body=Mass(3, [0, 0]), hand=[0, 0])
    for drives, sense in ((LID, 1), (LID[::-1], -1)):
        loaded = LoadedLinkage.of(lid(loads, drives=drives)).at(30)
        assert loaded.sense == sense
        weight = sense * 3 * G * np.cos(loaded.drive)
        assert loaded.hand_force(loaded.effort) == pytest.approx(weight, rel=1e-11)
        figures = load_figures(lid(loads, drives=drives))
        assert figures.hand.greatest == pytest.approx(sense * 3 * G * np.cos(LID[0 if sense > 0
                                                                              else 3]))  # fmt: skip
        assert figures.hand.at_poses == (((4, 4), (1, 1)))


def test_a_hand_where_its_point_stands_still_has_no_force():
    """The body's point at the pivot of the follower's end: no hand moves anything there."""
    loads = Loads(body=Mass(3, [100, 0]), hand=[0, 0])
    loaded = LoadedLinkage.of(lid(loads)).at(5)
    assert np.isfinite(loaded.hand_force(loaded.effort)).all()
    still = loaded.hand_force(np.zeros(5))
    assert not still.any()


@pytest.mark.parametrize(
    ("between", "acts"),
    [
        ((None, None), "1111"),
        ((2, None), "0111"),
        ((None, 2), "1100"),
        ((2, 3), "0110"),
        ((3, 2), "0110"),
        ((1, 4), "1111"),
        ((4, 4), "0001"),
    ],
)
@pytest.mark.parametrize("drives", [LID, LID[::-1]])
def test_a_force_acts_between_its_poses(between, acts, drives):
    force = Force([0, 0], [0, -40], "F", *between)
    loaded = LoadedLinkage.of(lid(Loads(forces=(force,)), drives=drives))
    at = loaded.at(loaded.pose_shares)
    wanted = 40 * 0.1 * np.cos(at.drive) * [float(each) for each in acts]
    assert at.effort == pytest.approx(wanted, abs=1e-11)
    # So it is wherever the driver goes to its poses in time.
    ends = loaded.at_driver(np.array([0.0, 1.0]))
    assert ends.effort == pytest.approx(wanted[[0, -1]], abs=1e-11)


def test_a_force_that_turns_with_the_body_and_one_that_does_not():
    """On a body that turns with the crank: across the crank's arm it has a constant torque."""
    turning = (rr([0, 0], [100, 0], 100), rr([300, 0], [300, 0], 100))
    kept = LoadedLinkage.of(lid(Loads(forces=(Force([50, 0], [0, 7], "F"),)), CRANK)).at(9)
    moved = LoadedLinkage.of(lid(Loads(forces=(Force([50, 0], [0, 7], "M"),)), CRANK)).at(9)
    place, (v, _) = kept.places["coupler"], kept.rates.of_body("coupler")
    arm = np.column_stack([np.cos(place.angle), np.sin(place.angle)]) * 0.05
    across = np.column_stack([-arm[:, 1], arm[:, 0]])
    speed = v[:, :2] + v[:, 2:] * across
    assert kept.effort == pytest.approx(-7 * speed[:, 1], rel=1e-11)
    along = (across / 0.05 * speed).sum(axis=1)
    assert moved.effort == pytest.approx(-7 * along, rel=1e-11)
    assert len(turning) == 2


def test_a_torsion_spring_about_the_drivers_pivot():
    """By its angle from where it is free, for each degree; and where it passes half a turn."""
    rate, free = 0.02, 15.0
    spring = Spring("torsion", (ground(0, 0), crank(0, 0)),
                    {"rate_Nm_per_deg": rate, "free_deg": free}, 2)  # fmt: skip
    wide = np.radians([20, 120, 200, 290])
    rocker = (rr([0, 0], [0, 0], 100), rr([300, 0], [280, 0], 200))
    linkage = LoadedLinkage.of(lid(Loads(springs=(spring,)), rocker, wide))
    loaded = linkage.at(50)
    wanted = 2 * rate * (np.degrees(loaded.drive) - free)
    assert loaded.effort == pytest.approx(wanted, rel=1e-11)
    for share in (0.3, 0.9, 1.0):
        alone = linkage.at(np.array([share]))
        assert alone.effort == pytest.approx(2 * rate * (np.degrees(alone.drive) - free), rel=1e-11)
    (figures,) = load_figures(lid(Loads(springs=(spring,)), rocker, wide)).springs
    assert figures.length == pytest.approx((20, 290), rel=1e-9)


def test_a_spring_whose_ends_meet_pulls_nowhere():
    """At one place of the motion a spring of no free length has no length at all."""
    at = 100 * np.array([np.cos(LID[1]), np.sin(LID[1])])
    spring = Spring("extension", (ground(*at), End("body", (0, 0))),
                    {"rate_N_per_mm": 1, "free_length": 0})  # fmt: skip
    linkage = LoadedLinkage.of(lid(Loads(springs=(spring,), gravity="none")))
    loaded = linkage.at(linkage.pose_shares)
    half = 2 * 0.1 * np.sin((loaded.drive - LID[1]) / 2)
    wanted = 1000 * half * 0.1 * np.cos((loaded.drive - LID[1]) / 2)
    assert loaded.effort == pytest.approx(wanted, abs=1e-9)
    (rest,) = load_figures(linkage.found).rests
    assert rest.stable
    assert rest.driver == pytest.approx(50, abs=1e-9)
    assert rest.between_poses == (2, 2)


def weighed(corners, width):
    """Area, centroid and polar moment of all within half a width of a polygon, by a grid."""
    corners = np.array(corners) @ [1, 1j]
    step, r = width / 60, width / 2
    x = np.arange(corners.real.min() - r + step / 2, corners.real.max() + r, step)
    y = np.arange(corners.imag.min() - r + step / 2, corners.imag.max() + r, step)
    points = (x[:, None] + 1j * y).ravel()
    gap = np.minimum(away(points, corners), away(points, corners[::-1]))  # either way round
    points = points[gap <= r]
    return (
        len(points) * step**2,
        points.mean(),
        (np.abs(points - points.mean()) ** 2).sum() * step**2,
    )


@pytest.mark.parametrize(
    "corners",
    [[(3, 4)], [(0, 0), (100, 30)], [(0, 0), (60, 0), (20, 50)], [(0, 0), (20, 50), (60, 9)]],
)
def test_plates_weigh_what_their_shapes_do(corners):
    """All that is within half a width of the pins' polygon, grain by grain."""
    joints = tuple(Joint({GROUND: np.zeros(2), "driver": np.array(at) / 1000}) for at in corners)
    bodies = Bodies(joints, {GROUND: (), "driver": joints}, ("driver",), "driver", "driver", (), ())
    for plates in (Plates("steel", 3, 20), Plates(7850.0, 3, 20)):
        mass, centre, inertia = (
            each[0] for each in Masses.of(bodies, Loads(links=plates), None, 1e-3)
        )
        area, middle, polar = weighed(corners, 20)
        assert mass == pytest.approx(7850 * 3e-3 * area * 1e-6, rel=2e-3)
        assert centre @ [1000, 1000j] == pytest.approx(middle, abs=0.1)
        assert inertia == pytest.approx(7850 * 3e-3 * polar * 1e-12, rel=5e-3)


def test_a_body_has_the_centre_and_the_inertia_of_its_outline():
    outline = Polygon([(0, 0), (60, 0), (60, 20), (0, 20)])
    loads = Loads(body=Mass(6))
    chosen = driven_at(CRANK, LID, loads, body=outline)
    mass, centre, inertia = (each[1] for each in LoadedLinkage.of(chosen).masses)
    assert mass == 6
    assert centre == pytest.approx([0.03, 0.01], abs=1e-15)
    assert inertia == pytest.approx(6 * (0.06**2 + 0.02**2) / 12, rel=1e-12)


def test_a_name_that_is_no_link_is_refused_with_those_that_are():
    with pytest.raises(InputError, match="no link 'rocker'") as caught:
        LoadedLinkage.of(lid(Loads(links={"rocker": 1.0})))
    assert caught.value.code == "E177"
    assert "follower" in caught.value.help


def test_a_drive_at_constant_speed_bears_what_inertia_costs():
    """A parallelogram again: its reduced inertia is constant, so only pushing costs."""
    loads = Loads(gravity="none", body=Mass(3, [0, 0]), drive=Drive(0.5, "trapezoid"))
    drives = np.radians([30, 60, 90, 130])
    figures = load_figures(lid(loads, PARALLEL, drives)).drive
    way = drives[-1] - drives[0]
    push = 4.5 * way / 0.5**2
    assert figures.effort.greatest == pytest.approx(3 * 0.1**2 * push, rel=1e-9)
    assert figures.effort.least == pytest.approx(-3 * 0.1**2 * push, rel=1e-9)
    assert figures.speed == pytest.approx(100 * 1.5 * way / 0.5, rel=1e-9)  # mm/s
    greatest = 100 * np.hypot(push, (1.5 * way / 0.5) ** 2)
    assert figures.acceleration == pytest.approx(greatest, rel=1e-6)
    even = Loads(gravity="none", body=Mass(3, [0, 0]), drive=Drive(0.5, "constant"))
    figures = load_figures(lid(even, PARALLEL, drives)).drive
    assert figures.effort.greatest == pytest.approx(0, abs=1e-10)
    assert figures.acceleration == pytest.approx(100 * (way / 0.5) ** 2, rel=1e-9)
