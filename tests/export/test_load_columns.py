"""The columns of loads in a table of the motion, of a four-bar and of a six-bar."""

import csv

import numpy as np
import pytest

import burmester
from burmester import Drive, End, Loads, Mass, Spring

ROWS = {
    "four-bar": [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)],
    "six-bar": [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)],
}
LOADS = Loads(
    body=Mass(4.0, [30.0, 0.0], 0.01),
    hand=[70.0, 5.0],
    springs=(
        Spring(
            "extension",
            (End("ground", (0.0, -80.0)), End("body", (60.0, 0.0))),
            {"rate_N_per_mm": 0.5, "free_length": 10.0},
        ),
        Spring("torsion", (End("ground", (0, 0)), End("body", (0, 0))), {"rate_Nm_per_deg": 0.1}),
    ),
    drive=Drive(2.0),
)


def best_of(kind, loads):
    task = burmester.Task.from_rows(ROWS[kind], angle_unit="deg", length_unit="mm", loads=loads)
    if kind == "four-bar":
        return burmester.synthesize(task).best
    return burmester.synthesize_six_bars(task, kind="Watt I", chains=500).best


def table(best, path):
    best.export(path)
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("kind", ROWS)
def test_loads_have_columns_with_their_units(kind, tmp_path):
    best = best_of(kind, LOADS)
    rows = table(best, tmp_path / "motion.csv")
    pins = [f"pin_{name}_N" for name in best.loads.pins]
    expected = ["driver_torque_Nm", "hand_force_N", *pins, "spring_1_mm", "spring_1_N"]
    expected += ["spring_2_deg", "spring_2_Nm", "energy_J", "time_s", "driver_deg_per_s"]
    expected += ["speed_mm_per_s", "driver_torque_in_time_Nm", "pose"]
    assert list(rows[0])[-len(expected) :] == expected
    values = {name: np.array([float(row[name]) for row in rows]) for name in expected[:-1]}
    figures = best.loads
    torque = values["driver_torque_Nm"]
    size = max(abs(figures.effort.least), abs(figures.effort.greatest))
    # The extremes may stand between two rows.
    assert torque.max() == pytest.approx(figures.effort.greatest, abs=1e-4 * size)
    assert torque.min() == pytest.approx(figures.effort.least, abs=1e-4 * size)
    assert values["spring_1_mm"].min() == pytest.approx(figures.springs[0].length[0], rel=1e-6)
    time = values["time_s"]
    assert time[[0, -1]].tolist() == [0.0, 2.0]
    assert (np.diff(time) > 0).all()
    # The speed is what the driver goes in time.
    drive = np.array([float(row["drive_deg"]) for row in rows])
    inside = slice(20, -20)
    slope = np.gradient(drive, time)[inside]
    speed = values["driver_deg_per_s"]
    assert slope == pytest.approx(speed[inside], abs=2e-3 * np.abs(speed).max())
    # A hand and a driver do the same work.
    work = np.trapezoid(torque, np.radians(drive))
    assert work == pytest.approx(values["energy_J"][-1] - values["energy_J"][0], abs=1e-4 * size)


def test_without_a_drive_there_is_no_time_and_without_loads_nothing(tmp_path):
    still = Loads(body=Mass(4.0, [30.0, 0.0]))
    head = list(table(best_of("four-bar", still), tmp_path / "still.csv")[0])
    assert "energy_J" in head
    assert not {"time_s", "hand_force_N", "spring_1_mm"} & {*head}
    bare = list(table(best_of("four-bar", None), tmp_path / "bare.csv")[0])
    assert bare == ["drive_deg", "x_mm", "y_mm", "angle_deg", "pose"]
