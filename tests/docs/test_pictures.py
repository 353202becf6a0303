"""The pictures of the documents are those that their scripts draw today."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def script(name):
    return runpy.run_path(str(ROOT / "docs" / name))


def test_the_house_shows_the_floors_of_the_contract():
    contract, page = (ROOT / "pyproject.toml").read_text(), (ROOT / "ARCHITECTURE.md").read_text()
    assert (ROOT / "docs" / "floors.svg").read_text() == script("floors.py")["drawn"](
        contract, page
    )


def test_the_moving_picture_is_that_of_the_example():
    """Its words, and its numbers to the last printed digit but one."""
    for name, drawn in script("picture.py")["pictures"](ROOT / "examples" / "poses.csv").items():
        kept = (ROOT / "docs" / name).read_text()
        assert NUMBER.sub("#", kept) == NUMBER.sub("#", drawn)
        ours, theirs = (np.array(NUMBER.findall(each), dtype=float) for each in (kept, drawn))
        assert ours == pytest.approx(theirs, abs=0.11)


def frames(svg, name):
    """Key frames of a part of the moving picture: pixels (n, 2) and degrees (n,)."""
    block = re.search(rf"@keyframes {name}{{(.*)}}", svg)[1]
    at = re.findall(r"translate\(([-\d.]+)px,([-\d.]+)px\) rotate\(([-\d.]+)deg\)", block)
    values = np.array(at, dtype=float)
    return values[:, :2], values[:, 2]


def test_the_plate_stays_on_both_links_and_passes_the_poses():
    """From the file alone: circles of the plate's pins, and rows of the example."""
    svg = (ROOT / "docs" / "ten-poses.svg").read_text()
    place, angle = frames(svg, "body")
    pins = np.array(re.findall(r'<circle cx="([-\d.]+)" cy="([-\d.]+)" r="4.5"', svg), dtype=float)
    moving, fixed = pins[:2], pins[2:]
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    for (x, y), ground in zip(moving, fixed, strict=True):
        away = place + np.stack([c * x - s * y, s * x + c * y], axis=-1) - ground
        length = np.hypot(*away.T)
        assert np.ptp(length) < 0.4
    steps = np.diff(np.vstack([place, place[:1]]), axis=0)
    assert np.hypot(*steps.T).max() < 3 * np.hypot(*steps.T).mean()  # no jump, round the loop
    rows = np.loadtxt(ROOT / "examples" / "poses.csv", delimiter=",", skiprows=3)
    for x, y, turned in rows:
        near = np.hypot(*(place - 60 * np.array([x, -y])).T)
        k = int(near.argmin())
        assert near[k] < 3
        assert abs(angle[k] + turned) < 2
