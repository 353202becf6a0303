"""A frame holds what was followed: its decoder in the page against the values in Python."""

import base64
import json
import math
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from burmester import Displacement, follow, read_task
from burmester.live.frames import followed_frame
from burmester.synthesis.motion_generation import synthesize
from burmester.web.branches import branches_of
from tests.oracles.studio import header_of

SCRIPT = """
import { decodeFrame } from %s;
const bytes = Buffer.from(require("fs").readFileSync(0, "utf8"), "base64");
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
const plain = (key, value) => value instanceof Float32Array ? Array.from(value, String) : value;
process.stdout.write(JSON.stringify(decodeFrame(buffer), plain));
"""


@pytest.fixture(scope="module")
def followed():
    task = read_task("case:ge2012-exact")
    moved = task.poses.translation.copy()
    moved[3] += [0.05, -0.02]
    poses = Displacement(moved, task.poses.angle)
    return follow(synthesize(task), replace(task, poses=poses, resolution=(0, 0)))


@pytest.fixture(scope="module")
def frame(followed):
    shown = [each for each in followed.linkages if each.id in ("L1", "L2")]
    motion = {each.id: branches_of(each, followed.task.poses, 20.0, 61) for each in shown}
    return followed_frame(7, followed, motion)[0]


@pytest.fixture(scope="module")
def decoded(frame):
    node = shutil.which("node")
    if node is None:
        pytest.skip("no Node on this machine")
    module = Path("src/burmester/web/studio/frames.mjs").resolve().as_uri()
    script = SCRIPT.replace("require(", "(await import('module')).createRequire('/')(")
    ran = subprocess.run(
        [node, "--input-type=module", "-e", script % json.dumps(module)],
        input=base64.b64encode(frame),
        capture_output=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr.decode()
    return json.loads(ran.stdout)


def near(texts, values):
    """Whether numbers that the page sees are those of Python in single precision."""
    seen = np.array([float(text) for text in texts])
    return np.array_equal(seen, np.asarray(values, dtype=np.float32), equal_nan=True)


def test_the_page_sees_every_linkage(decoded, followed):
    assert (decoded["n"], decoded["kind"]) == (7, "followed")
    assert [each["id"] for each in decoded["linkages"]] == [each.id for each in followed.linkages]
    for seen, found in zip(decoded["linkages"], followed.linkages, strict=True):
        assert seen["usable"] == found.usable
        assert (seen["reason"] is None) == found.usable
        assert seen["worst"] == found.error.worst
        first, second = found.dyads_driver_first
        assert [each["id"] for each in seen["led"]] == [first.id, second.id]
        for drawn, dyad in zip(seen["led"], (first.dyad, second.dyad), strict=True):
            pivots = {"RR": ("fixed_pivot", "moving_pivot"), "PR": ("moving_pivot",)}
            for name in pivots.get(drawn["kind"], ("fixed_pivot",)):
                assert drawn[name] == getattr(dyad, name).tolist()
    assert decoded["complete"] == followed.complete


def test_the_page_sees_the_ways_of_those_that_are_shown(decoded, followed):
    for seen, found in zip(decoded["linkages"], followed.linkages, strict=True):
        if found.id not in ("L1", "L2"):
            assert seen["ways"] is None
            continue
        ways = branches_of(found, followed.task.poses, 20.0, 61).ways
        assert len(seen["ways"]) == len(ways) > 0
        for one, way in zip(seen["ways"], ways, strict=True):
            assert one["poses"] == way["poses"]
            assert one["round"] == way["round"]
            for name in ("x", "y", "angle", "drive"):
                assert near(one[name], way[name]), name
            transmission = [math.nan if v is None else v for v in way["transmission"]]
            assert near(one["transmission"], transmission)


def test_the_page_sees_the_places_at_the_poses(decoded, followed):
    for seen, found in zip(decoded["linkages"], followed.linkages, strict=True):
        rows = seen["pose_errors"]
        places = found.error.places
        assert near([row["x"] for row in rows], places.translation[:, 0])
        assert near([row["y"] for row in rows], places.translation[:, 1])
        assert near([row["angle_deg"] for row in rows], np.degrees(places.angle))
        assert near([row["position"] for row in rows], found.error.position)
        assert near([row["turned_deg"] for row in rows], np.degrees(found.error.angle))
    shown = decoded["linkages"][0]
    for pose, row in enumerate(shown["pose_errors"]):
        assert (row["way"] is None) == (shown["at"][pose] is None)


def test_a_number_that_does_not_exist_is_null(followed):
    """A linkage that reaches no pose has no places."""
    found = followed.linkages[0]
    lost = np.full(len(found.error.position), np.nan)
    places = Displacement(np.stack([lost, lost], axis=-1), lost)
    error = replace(found.error, places=places, position=lost, angle=lost)
    gone = replace(followed, linkages=(replace(found, error=error),))
    header = header_of(followed_frame(1, gone, {})[0])
    (linkage,) = header["linkages"]
    assert linkage["worst"] is None
    assert linkage["worst_deg"] is None
    count = linkage["poses"]["count"]
    assert all(map(math.isnan, header["numbers"][: 5 * count]))


def test_the_numbers_begin_at_a_multiple_of_four(frame):
    header = header_of(frame)
    assert int.from_bytes(frame[:4], "little") % 4 == 0
    asked = [each["poses"] for each in header["linkages"]]
    ways = [way for each in header["linkages"] for way in each["ways"] or ()]
    ends = [each["start"] + 6 * each["count"] for each in asked]
    ends += [each["start"] + 5 * each["count"] for each in ways]
    assert max(ends) == len(header["numbers"])


def test_a_linkage_that_was_not_judged_is_as_it_was(followed, frame):
    """Of those that were, what is drawn is new; the others keep what was drawn of them."""
    _, drawn = followed_frame(1, followed, {})
    new = replace(followed.linkages[1], combined_error=123.0)
    later = replace(followed, linkages=(followed.linkages[0], new, *followed.linkages[2:]))
    header = header_of(followed_frame(2, later, {}, drawn)[0])
    assert [each["fresh"] for each in header["linkages"]] == [
        each is new for each in later.linkages
    ]
    assert header["linkages"][1]["combined"] == 123.0
    # Of the others the frame has the names only: the page has drawn them.
    assert header["linkages"][0] == {"id": followed.linkages[0].id, "fresh": False}
    assert len(header["numbers"]) == 6 * len(new.error.position)
