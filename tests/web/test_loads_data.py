"""Loads as a page gets them: curves over its own driver's angles, springs by their ends."""

import json

import numpy as np
import pytest

import burmester
from burmester import Drive, End, Loads, Mass, Spring
from burmester.web.data import report_data
from burmester.web.six_bar_data import six_bar_report

ROWS = {
    "four-bar": [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)],
    "six-bar": [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)],
}


def loads_on(link, drive=None):
    return Loads(
        body=Mass(4.0, [30.0, 0.0], 0.01),
        hand=[70.0, 5.0],
        springs=(
            Spring(
                "extension",
                (End("ground", (0.0, -80.0)), End(link, (12.0, 3.0))),
                {"rate_N_per_mm": 0.5, "free_length": 1.0},
            ),
            Spring("counterweight", (End("ground", (0, 0)), End("body", (-9, 0))), {"mass_kg": 1}),
        ),
        drive=drive,
    )


@pytest.fixture(scope="module", params=ROWS)
def solved(request):
    """A report, the synthesis and its linkages, with a spring on the driver."""
    link = {"four-bar": "driver", "six-bar": "second-crank"}[request.param]
    task = burmester.Task.from_rows(
        ROWS[request.param], angle_unit="deg", length_unit="mm", loads=loads_on(link, Drive(2.0))
    )
    if request.param == "four-bar":
        result = burmester.synthesize(task)
        return report_data(result), result.linkages
    result = burmester.synthesize_six_bars(task, kind="Watt I", chains=500)
    return six_bar_report(result), result.six_bars.found


def test_curves_are_those_of_python_over_the_angles_of_the_page(solved):
    report, linkages = solved
    told = 0
    for data, found in zip(report["linkages"], linkages, strict=True):
        loads = data["loads"]
        assert (loads is None) == (found.loads is None)
        if loads is None:
            continue
        told += 1
        way = data["ways"][loads["way"]]
        torque, hand, pins, energy = loads["panels"]
        assert torque["title"] == "driver torque that holds it (N·m)"
        assert hand["title"] == "hand force (N)"
        assert energy["title"] == "potential energy (J)"
        assert [each["name"] for each in pins["lines"]] == sorted(found.loads.pins)
        x = np.array(torque["x"])
        assert (np.diff(x) > 0).all()
        assert way["drive"][0] - 1e-6 <= x[0] < x[-1] <= way["drive"][-1] + 1e-6
        # They begin and end at poses of that way.
        at = [row["frame"] for row in data["pose_errors"] if row["way"] == loads["way"]]
        met = np.interp(at, np.arange(len(way["drive"])), way["drive"])
        for end in (x[0], x[-1]):
            assert np.abs(met - end).min() < 0.05
        figures, values = found.loads.effort, np.array(torque["lines"][0]["y"])
        size = max(abs(figures.least), abs(figures.greatest))
        assert values.max() == pytest.approx(figures.greatest, abs=2e-3 * size)
        timed = loads["timed"]
        assert timed["panels"][0]["x"][0] == 0
        assert timed["panels"][0]["x"][-1] == 2
        assert sorted([timed["time"]["y"][0], timed["time"]["y"][-1]]) == [0, 2]
        assert "speed" in timed["panels"][-1]["title"]
    assert told


def test_springs_are_drawn_between_their_ends(solved):
    report, linkages = solved
    spring, weight = report["loads"]["springs"]
    assert weight["ends"] == [{"link": "body", "point": [-9, 0]}]  # a counterweight has its own end
    assert spring["kind"] == "extension"
    assert report["loads"]["hand"] == [70.0, 5.0]
    for data, found in zip(report["linkages"], linkages, strict=True):
        if data["loads"] is None:
            continue
        (moved,) = data["loads"]["moved"]
        assert (moved["spring"], moved["end"]) == (0, 1)
        along = np.column_stack([each["y"] for each in moved["at"]])
        length = np.hypot(*(along - [0.0, -80.0]).T)
        told = found.loads.springs[0].length
        assert (length.min(), length.max()) == pytest.approx(told, rel=1e-3)


def test_numbers_are_rounded_and_plain(solved):
    report, _ = solved
    text = json.dumps(report["linkages"][0]["loads"], allow_nan=False)
    assert max(len(each.strip(" []}")) for each in text.split(",") if '"' not in each) <= 20


def test_without_loads_nothing_is_told():
    report = report_data(burmester.synthesize(burmester.read_task("case:motiongen-shoulder")))
    assert report["loads"] is None
    assert {each["loads"] for each in report["linkages"]} == {None}


def test_what_the_ground_bears_balances_weights_and_the_spring(solved):
    """The arrows of the pins on the ground, the weights and the pull of the spring sum to zero."""
    report, _ = solved
    told = 0
    for data in report["linkages"]:
        if (loads := data["loads"]) is None or any("P" in each["kind"] for each in data["led"]):
            continue
        told += 1
        (end,) = (each for each in loads["moved"] if each["spring"] == 0)
        apart = np.stack([each["y"] for each in end["at"]], axis=-1) - [0.0, -80.0]
        length = np.hypot(*apart.T)
        total = -apart / length[:, None] * 0.5 * (length - 1.0)[:, None]
        total[:, 1] -= (4 + 1) * 9.80665
        greatest = 0.0
        for pin in loads["pins"]:
            force = np.stack(pin["force"], axis=-1)
            greatest = max(greatest, np.hypot(*force.T).max())
            size = next(each["y"] for each in loads["panels"][2]["lines"]
                        if each["name"] == pin["name"])  # fmt: skip
            assert np.hypot(*force.T) == pytest.approx(size, rel=1e-4, abs=1e-4 * greatest)
            if max(np.ptp(each["y"]) for each in pin["at"]) < 1e-6:
                total += force
        assert np.abs(total).max() <= 1e-4 * greatest
    assert told
