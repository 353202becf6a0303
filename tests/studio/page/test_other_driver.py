"""A linkage driven by its other dyad, instant centres and manifolds, as the page computes them."""

from functools import cache

import numpy as np
import pytest

from burmester import read_task, synthesize
from burmester.fourbar.instantaneous import centrodes, transmission_angle
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.web.data import report_data
from tests.oracles.page_modules import value

CASES = ("case:ge2012-exact", "case:motiongen-rrrp", "case:motiongen-rrpr", "case:motiongen-prpr")
LINKED = """
const linked = (each) => ({...each, pose_errors: each.pose_errors.map((row) =>
  ({...row, at: row.way === null ? null : each.ways[row.way]}))});
"""


@cache
def solved(name):
    result = synthesize(read_task(name))
    return result, report_data(result)


@pytest.mark.parametrize("name", CASES)
def test_the_other_driver_takes_the_same_motion_to_its_own_dead_points(name):
    result, data = solved(name)
    linkages = data["linkages"][:6]
    found = value(
        "other_driver.mjs",
        LINKED + "return all.map((each) => m.drivenByOther(linked(each), length));",
        all=linkages,
        length=data["chart"]["length"],
    )
    dead_ends = 0
    for drawn, before, own in zip(found, linkages, result.linkages, strict=False):
        other = Linkage(own.driver_first.second, own.driver_first.first)
        for way in drawn["ways"]:
            places = Displacement(np.array([way["x"], way["y"]]).T, np.array(way["angle"]))
            # The places are on both dyads, and the angle is that of the driver.
            for dyad in (other.first, other.second):
                assert np.abs(dyad.residual(places)).max() < 1e-7 * data["scene"]
            angle = np.degrees(transmission_angle(other, places))
            assert np.array(way["transmission"]) == pytest.approx(angle, abs=1e-9)
            drive = np.diff(way["drive"])
            assert (drive > -1e-9).all()
            ends = zip(way["dead"], (angle[0], angle[-1]), strict=True)
            for _, at in filter(lambda end: end[0], ends):
                assert at < 0.01
                dead_ends += 1
        for row, old in zip(drawn["pose_errors"], before["pose_errors"], strict=True):
            if old["way"] is None:
                continue
            way, frame = drawn["ways"][row["way"]], row["frame"]
            nearest = round(frame)
            step = np.hypot(*np.diff([way["x"], way["y"]], axis=1)).max()
            away = np.hypot(way["x"][nearest] - old["x"], way["y"][nearest] - old["y"])
            assert away <= step
        reached = sorted(pose for way in drawn["ways"] for pose in way["poses"])
        assert reached == sorted(pose for way in before["ways"] for pose in way["poses"])
    if name == "case:ge2012-exact":
        assert dead_ends >= 20


@pytest.mark.parametrize("name", CASES)
def test_instant_centres_are_those_of_python(name):
    result, data = solved(name)
    for number, own in enumerate(result.linkages[:5]):
        linkage = data["linkages"][number]
        way = max(linkage["ways"], key=lambda each: len(each["poses"]))
        places = Displacement(np.array([way["x"], way["y"]]).T, np.array(way["angle"]))
        rows = np.column_stack([places.translation, places.angle]).tolist()
        found = value(
            "../widget/instantaneous.mjs",
            "return rows.map(([x, y, a]) => m.centrodePoint(led, {x, y, a}));",
            led=linkage["led"],
            rows=rows,
        )
        both = centrodes(own.driver_first, places)
        near = np.abs(both.fixed).max(axis=1) < 100 * data["scene"]
        assert near.sum() > 10
        for k in np.flatnonzero(near).tolist():
            size = data["scene"] + np.abs(both.fixed[k]).max()
            assert found[k]["fixed"] == pytest.approx(both.fixed[k], abs=1e-7 * size)
            assert found[k]["moving"] == pytest.approx(both.moving[k], abs=1e-7 * size)


@pytest.mark.parametrize("name", CASES)
def test_manifolds_are_those_of_the_report(name):
    _, data = solved(name)
    for linkage in data["linkages"]:
        found = value(
            "manifold.mjs",
            "return led.map((dyad) => m.quadricOf(dyad, chart, box));",
            led=linkage["led"],
            chart=data["chart"],
            box=linkage["space"],
        )
        for one, other in zip(found, linkage["space"]["quadrics"], strict=True):
            sign = np.sign(np.dot(one, other))  # a manifold is the same with the other sign
            assert sign * np.array(one) == pytest.approx(np.array(other), abs=1e-9)
