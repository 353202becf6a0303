"""Points of the body on the page: marks without axes, and no angle that nobody asked for."""

from dataclasses import replace

import numpy as np
import pytest

from burmester import Polygon, read_task, synthesize
from burmester.report.page import page as page_of
from burmester.web.still import POSE, still
from tests.oracles import browser as browsers

POINTS = (1, 2, 4, 5)  # of the seven rows, which have no angle
NAMES = ("grip", "lift", "over", "turn", "pass", "near", "set down")
GROUND, CRANK, COUPLER, ROCKER, AT = 80.0, 26.0, 68.0, 60.0, 22 + 30j

DRAWN = """() => {
  const of = (name) => [...document.querySelectorAll(`.bm-plane .${name}`)].map((each) => ({
    axes: each.querySelectorAll("path").length, dots: each.querySelectorAll("circle").length }));
  return { wanted: of("bm-wanted"), achieved: of("bm-achieved"),
    key: [...document.querySelectorAll(".bm-keys li")].map((each) => each.textContent),
    ghosts: [...document.querySelectorAll(".bm-ghost[data-pose]")].map((each) => each.dataset.pose),
    images: document.querySelectorAll(".bm-space .bm-image-point").length,
    panels: [...document.querySelectorAll(".bm-plots .bm-title")].map((each) => each.textContent),
    dots: [...document.querySelectorAll(".bm-plots .bm-dot title")].map((each) => each.textContent),
    heads: [...document.querySelectorAll(".bm-pose-table thead th")].map((th) => th.textContent),
    rows: [...document.querySelectorAll(".bm-pose-table tbody tr")].map((row) =>
      [...row.children].map((cell) => cell.textContent)) };
}"""


def places(turns):
    """Places of the body on a crank-rocker, closed by the law of cosines; degrees."""
    joint = CRANK * np.exp(1j * turns)
    way = GROUND - joint
    bend = np.arccos((COUPLER**2 + abs(way) ** 2 - ROCKER**2) / (2 * COUPLER * abs(way)))
    angle = np.angle(way) + bend
    at = joint + AT * np.exp(1j * angle)
    return np.column_stack([at.real, at.imag, np.degrees(angle)])


SEVEN = places(np.linspace(0.3, 4.6, 7))
LOOP = places(np.linspace(0, 2 * np.pi, 31))


@pytest.fixture(scope="module")
def mixed():
    """Three poses and four points, and how they are solved."""
    rows = [
        f"{x:.6f},{y:.6f},{'' if k in POINTS else f'{a:.6f}'},{NAMES[k]}"
        for k, (x, y, a) in enumerate(SEVEN)
    ]
    text = "\n".join(["x_mm,y_mm,angle_deg,name", *rows])
    return synthesize(read_task("-", data=text.encode()))


@pytest.fixture(scope="module")
def path():
    text = "\n".join(["x_mm,y_mm", *(f"{x:.6f},{y:.6f}" for x, y, _ in LOOP)])
    return synthesize(read_task("-", data=text.encode()))


def written(folder, result):
    file = folder / "page.html"
    file.write_text(page_of(result, "points"), encoding="utf-8")
    return file


def test_points_have_no_frames_and_poses_have(browser, mixed, tmp_path):
    with browsers.opened(browser, written(tmp_path, mixed)) as (page, said, _):
        drawn = page.evaluate(DRAWN)
        for kind in ("wanted", "achieved"):
            assert drawn[kind] == [{"axes": int(k not in POINTS), "dots": 1} for k in range(7)]
        assert {"wanted pose", "wanted point"} <= set(drawn["key"])
        assert drawn["images"] == 7
        # The wanted angle, the body's own, and by how much it is missed.
        angle, own, turned = (drawn["heads"].index("angle"), 6, drawn["heads"].index("turned by"))
        for k, row in enumerate(drawn["rows"]):
            assert (row[angle] == "free") == (row[turned] == "free") == (k in POINTS)
            assert float(row[own].rstrip("°")) == pytest.approx(SEVEN[k, 2], abs=0.006)
        assert sum(each.startswith("point 2: lift") for each in drawn["dots"]) == 1
        assert sum(each.startswith("pose 4: turn") for each in drawn["dots"]) == 2
        page.click(".bm-next")
        assert page.locator(".bm-now").inner_text().endswith("at point 2: lift, exact")
        assert said == []


def test_a_body_is_drawn_at_points_only_where_a_linkage_takes_it(browser, mixed, tmp_path):
    body = Polygon(np.array([[0, 0], [9, 0], [9, 5.0]]))
    whole = synthesize(replace(mixed.task, body=body))
    for result, where in ((whole, (0, 6)), (replace(whole, linkages=(), dyads=()), (0, 3, 6))):
        with browsers.opened(browser, written(tmp_path, result)) as (page, _, _asked):
            drawn = page.evaluate(DRAWN)
            assert drawn["ghosts"] == [str(k + 1) for k in where]


def test_a_path_asks_for_no_angles_at_all(browser, path, tmp_path):
    with browsers.opened(browser, written(tmp_path, path)) as (page, said, _):
        drawn = page.evaluate(DRAWN)
        assert drawn["wanted"] == [{"axes": 0, "dots": 1}] * 30
        assert "wanted pose" not in drawn["key"]
        assert drawn["heads"][:4] == ["point", "wanted x", "y (mm)", "body x"]
        assert "turned by" not in drawn["heads"]
        assert not any("angle error" in each for each in drawn["panels"])
        line = page.locator(".bm-plane .bm-wanted-path").get_attribute("d")
        assert line.count("L") == 29
        assert line.endswith("Z")
        names = page.locator(".bm-pose-names text").all_text_contents()
        assert names == ["1", "5", "10", "15", "20", "25", "30"]
        assert page.locator(".bm-next").inner_text() == "Point ▶"
        assert "free" not in page.locator(".bm-numbers").inner_text()
        assert said == []


def test_a_still_drawing_has_frames_at_poses_and_dots_at_points(mixed):
    best = mixed.linkages[0]
    text = still(best, "points")
    assert text.count(f'fill="none" stroke="{POSE}"') == 3
    assert text.count(f'r="3.5" fill="{POSE}"') == len(POINTS)
