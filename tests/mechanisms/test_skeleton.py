"""Skeletons: bars, frames and places of links, for a six-bar whose joints scipy finds."""

import numpy as np
import pytest

from burmester.mechanisms.skeleton import Skeleton
from burmester.sixbar.kinds import KINDS
from burmester.sixbar.six_bars import SixBarOptions
from burmester.sixbar.watt import WATT_I
from burmester.synthesis.six_bars import synthesize_six_bars
from tests.oracles.six_bars import dimensions
from tests.sixbar.tasks import TURNING, task

STEPHENSON = Skeleton(
    "Stephenson III six-bar",
    "ABCDEFG",
    {"ground": "ABF", "AC": "AC", "BD": "BD", "CDE": "CDE", "EG": "EG", "FG": "FG"},
    drivers="ABF",
)


@pytest.fixture(scope="module")
def found():
    return synthesize_six_bars(
        task(TURNING), SixBarOptions(kind="Watt I", chains=400, most=1)
    ).six_bars.found[0]


def test_bars_are_the_sides_of_links():
    assert WATT_I.bars == ("AB", "AC", "CD", "DE", "CE", "BD", "DG", "BG", "GH", "EH")
    assert STEPHENSON.bars[:3] == ("AB", "BF", "AF")
    assert [STEPHENSON.crank(pivot) for pivot in "ABF"] == ["AC", "BD", "FG"]
    assert (WATT_I.arm("B"), WATT_I.axis("coupler"), WATT_I.links_of("D")) == (
        "BD",
        "CE",
        ("coupler", "second crank"),
    )


def test_frames_carry_the_joints(found):
    drive = np.append(found.along(7), found.drive[2])
    joints, places = found.joints(drive), found.links(drive)
    for link, own in found.frames.items():
        for joint, at in own.items():
            assert np.abs(places[link].act(at) - joints[joint]).max() < 1e-9 * found.extent
    body = found.body(drive)
    assert np.array_equal(places[found.carries].translation, body.translation)
    assert np.array_equal(places[found.carries].angle, body.angle)
    arm = joints[WATT_I.arm(found.driver_pivot)[1]] - joints[found.driver_pivot]
    assert np.abs(np.exp(1j * drive) - arm @ [1, 1j] / np.hypot(*arm.T)).max() < 1e-12


def test_frames_make_the_linkage_again(found):
    """In any frame of a link but those of ground and body."""
    turn, shift = np.array([[0.6, -0.8], [0.8, 0.6]]), np.array([3.0, -5.0])
    frames = {
        link: {
            name: at if link in ("ground", found.carries) else turn @ at + shift
            for name, at in joints.items()
        }
        for link, joints in found.frames.items()
    }
    again = KINDS[found.skeleton.name].of(found.carries, frames)
    for name in again.__match_args__:
        assert getattr(again, name) == pytest.approx(getattr(found.linkage, name), rel=1e-12)
    for bar, length in dimensions(found.linkage).items():
        assert found.lengths[bar] == pytest.approx(length)
        assert found.scaled(10.0).lengths[bar] == pytest.approx(10 * length)
