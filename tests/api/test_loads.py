"""What a linkage of a result says of its loads and of its motion in time."""

import numpy as np
import pytest

import burmester
from burmester import Drive, End, InputError, Loads, Mass, Plates, Spring

ROWS = [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)]
SIX = [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)]
SPRING = Spring(
    "extension",
    (End("ground", (0.0, -80.0)), End("body", (60.0, 0.0))),
    {"rate_N_per_mm": 0.5, "free_length": 10.0},
)


@pytest.fixture(scope="module", params=["four-bar", "six-bar"])
def best(request):
    """A linkage under weight, a spring and a hand, with a drive."""
    loads = Loads(
        body=Mass(4.0, [30.0, 0.0], 0.01),
        links=Plates("steel", 3.0, 20.0),
        hand=[70.0, 5.0],
        springs=(SPRING,),
        drive=Drive(2.0),
    )
    rows = ROWS if request.param == "four-bar" else SIX
    task = burmester.Task.from_rows(rows, angle_unit="deg", length_unit="mm", loads=loads)
    if request.param == "four-bar":
        return burmester.synthesize(task).best
    return burmester.synthesize_six_bars(task, kind="Watt I", chains=500).best


def test_curves_have_the_figures_as_their_extremes(best):
    curves, figures = best.loaded(), best.loads
    # Figures have further places about peaks: none is less than that of a curve, and none far off.
    near = np.ptp(curves.effort) / 1000
    assert curves.effort.min() - near < figures.effort.least <= curves.effort.min()
    assert curves.effort.max() <= figures.effort.greatest < curves.effort.max() + near
    assert curves.hand.max() <= figures.hand.greatest < 1.001 * curves.hand.max()
    for name, force in curves.pins.items():
        most = np.hypot(*force.T).max()
        assert most <= figures.pins[name] < 1.001 * most
    (spring,), (told,) = curves.springs, figures.springs
    assert (spring.length.min(), spring.length.max()) == pytest.approx(told.length, rel=1e-4)
    assert spring.force.max() == pytest.approx(told.tension[1], rel=1e-3)
    assert curves.moving.time[[0, -1]].tolist() == [0.0, 2.0]
    # Places of even steps are not those of even times, so the extremes only come near.
    size = np.ptp(curves.effort)
    assert curves.moving.effort.max() == pytest.approx(
        figures.drive.effort.greatest, abs=0.01 * size
    )
    assert curves.moving.body_speed.max() == pytest.approx(figures.drive.speed, rel=0.001)


def test_effort_is_the_slope_of_the_energy(best):
    curves = best.loaded(2001)
    slope = np.gradient(curves.energy, np.radians(curves.driver), edge_order=2)
    assert slope == pytest.approx(curves.effort, abs=1e-4 * np.abs(curves.effort).max())


def test_velocities_are_slopes_of_places(best):
    for drive in (None, Drive(3.0, "constant"), Drive(0.5, "trapezoid")):
        moved = best.kinematics(drive, count=1201)
        point = moved.point(np.array([70.0, 5.0]))
        assert moved.time[-1] == (drive or Drive(2.0)).duration_s
        inside = slice(3, -3)
        if moved.drive.profile == "trapezoid":  # away from the corners of its speed
            inside = np.r_[10:390, 410:790, 810:1190]
        for place, speed in (
            (moved.driver, moved.driver_speed),
            (moved.driver_speed, moved.driver_acceleration),
            (moved.body.angle, moved.turning),
            (moved.turning, moved.turning_acceleration),
            (moved.body.translation, moved.velocity),
            (moved.velocity, moved.acceleration),
            (point.place, point.velocity),
            (point.velocity, point.acceleration),
        ):
            slope = np.gradient(place, moved.time, axis=0)[inside]
            size = np.abs(speed).max() + np.abs(place).max() / moved.time[-1]
            assert slope == pytest.approx(speed[inside], abs=1e-3 * size)


def test_time_in_curves_is_that_of_the_motion(best):
    curves, moved = best.loaded(101).moving, best.kinematics(count=4001)
    driver = best.loaded(101).driver
    order = np.argsort(moved.driver)
    time = np.interp(driver, moved.driver[order], moved.time[order])
    assert time == pytest.approx(curves.time, abs=2e-3)
    speed = np.interp(curves.time, moved.time, moved.driver_speed)
    assert speed == pytest.approx(curves.driver_speed, abs=1e-4 * np.abs(speed).max())


def test_what_is_let_go_keeps_its_energy(best):
    for pose in (1, 2):
        swung = best.swing(pose, 0.1)
        assert swung.driver_speed[0] == 0
        assert np.ptp(swung.energy) < 1e-7 * (1 + np.abs(swung.energy).max())
        assert swung.ended == (len(swung.time) < 201)


def test_motion_in_time_needs_neither_loads_nor_a_known_unit():
    best = burmester.synthesize(burmester.read_task("case:motiongen-shoulder")).best
    assert best.task.loads is None
    moved = best.kinematics(Drive(1.0, "constant"), 11)
    assert np.ptp(moved.driver_speed) == pytest.approx(0, abs=1e-9)
    for refused in (best.kinematics, best.loaded, best.swing):
        with pytest.raises(InputError) as caught:
            refused()
        assert caught.value.code == "E177"


def test_a_pose_that_is_not_there_is_told(best):
    with pytest.raises(InputError) as caught:
        best.swing(17)
    assert caught.value.code == "E177"
    assert "1, 2" in caught.value.help
