"""The pictures of the documents are those that their scripts draw today."""

import json
import re
import runpy
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

import burmester
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage

ROOT = Path(__file__).parents[2]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def script(name):
    return runpy.run_path(str(ROOT / "docs" / name))


def test_the_house_shows_the_floors_of_the_contract():
    contract, page = (ROOT / "pyproject.toml").read_text(), (ROOT / "ARCHITECTURE.md").read_text()
    assert (ROOT / "docs" / "floors.svg").read_text() == script("floors.py")["drawn"](
        contract, page
    )


def test_no_word_of_the_house_leaves_its_room():
    """By Matplotlib's metrics of DejaVu Sans, which is wider than the fonts of most screens."""
    svg = ElementTree.fromstring((ROOT / "docs" / "floors.svg").read_text())
    rooms = svg.findall("{*}rect")[1:]
    texts = [each for each in svg.findall("{*}text") if each.find("{*}tspan") is not None]
    assert len(rooms) == len(texts) > 20
    for room, text in zip(rooms, texts, strict=True):
        left, top, wide, high = (float(room.get(key)) for key in ("x", "y", "width", "height"))
        assert left < float(text.get("x"))
        right, low = float(text.get("x")), float(text.get("y"))
        for part in text:
            if part.get("x") is not None:  # a line of its own
                right, low = float(part.get("x")), low + float(part.get("dy"))
            size, weight = part.get("font-size", 15), part.get("font-weight", 400)
            font = FontProperties(family="DejaVu Sans", size=float(size), weight=int(weight))
            width = TextPath((0, 0), part.text, prop=font).get_extents().width
            right += float(part.get("dx", 0)) + width
            assert right < left + wide, part.text
            assert top < low < top + high - 3, part.text


def test_the_moving_picture_is_that_of_the_example():
    """Its words, and its numbers to the last printed digit but one."""
    for name, drawn in script("picture.py")["pictures"](ROOT / "examples" / "poses.csv").items():
        kept = (ROOT / "docs" / name).read_text()
        assert NUMBER.sub("#", kept) == NUMBER.sub("#", drawn)
        ours, theirs = (np.array(NUMBER.findall(each), dtype=float) for each in (kept, drawn))
        assert ours == pytest.approx(theirs, abs=0.11)


class _TaskIsKnownError(Exception):
    """The cells of a page have come as far as their task."""


def task_of(gallery, page, monkeypatch):
    """The task that the cells of a page hand to the first search; nothing is searched.

    A page that searches no poses has a function, and the motion of what makes it.
    """

    def stop(task, **_):
        raise _TaskIsKnownError(task)

    monkeypatch.setattr(burmester, "synthesize", stop)
    try:
        return gallery["run"](page)["motion"].task
    except _TaskIsKnownError as reached:
        return reached.args[0]


def test_the_pictures_of_the_gallery_are_those_of_its_tasks(tmp_path, monkeypatch):
    """Each shows a linkage that does what its task asks today, to a tenth of a pixel."""
    gallery = script("gallery/pictures.py")
    gallery["beside"](tmp_path)
    monkeypatch.chdir(tmp_path)
    linkages = json.loads(gallery["KEPT"].read_text(encoding="utf-8"))
    pages = gallery["pages"]()
    assert [page.stem for page in pages] == sorted(linkages)
    for page in pages:
        dyads = [RR(each["fixed"], each["moving"], each["length"]) for each in linkages[page.stem]]
        task = task_of(gallery, page, monkeypatch)
        chosen = burmester.judge(task, Linkage(*dyads)).best
        assert chosen.usable, page.stem
        kept = page.with_suffix(".svg").read_text(encoding="utf-8")
        drawn = gallery["drawn"](chosen, page.stem)
        assert NUMBER.sub("#", kept) == NUMBER.sub("#", drawn), page.stem
        ours, theirs = (np.array(NUMBER.findall(each), dtype=float) for each in (kept, drawn))
        assert ours == pytest.approx(theirs, abs=0.11), page.stem


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
