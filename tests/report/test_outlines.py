"""The body and its surroundings on the page: their places and names."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from burmester import KeepOut, Polygon, Surroundings, synthesize
from burmester.report.page import page as page_of
from tests.oracles import browser as browsers
from tests.oracles.bodies import BODY, HOSTILE, REGIONS, bodied, carried, same_ring

# The corners of all outlines, as they are seen: in pixels of the picture and in the plane.
OUTLINES = """() => {
  const svg = document.querySelector(".bm-plane"), to = svg.getCTM().inverse();
  const { scale, left, top } = svg.dataset;
  const corners = (node) => {
    const m = to.multiply(node.getCTM());
    return node.getAttribute("d").slice(1, -1).split("L").map((each) => {
      const [x, y] = each.trim().split(" ").map(Number);
      return [m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f];
    });
  };
  const all = (selector) => [...svg.querySelectorAll(selector)].map((node) => {
    const pixels = corners(node);
    return { pixels, plane: pixels.map(([x, y]) => [(x - left) / scale, (top - y) / scale]) };
  });
  const frame = svg.viewBox.baseVal;
  return { scale: +scale, size: [frame.width, frame.height],
    ghosts: all(".bm-ghost"), body: all(".bm-body-outline"), regions: all(".bm-region-edge") };
}"""

GO = """(share) => {
  const slider = document.querySelector(".bm-slider"), low = +slider.min, high = +slider.max;
  slider.value = low + share * (high - low);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""
PIXEL = 0.51  # paths are written to a hundredth, and the stroke's middle is what is meant


@pytest.fixture(scope="module")
def found():
    return synthesize(bodied())


@pytest.fixture(scope="module")
def file(found, tmp_path_factory):
    path = tmp_path_factory.mktemp("outlines") / "page.html"
    path.write_text(page_of(found, "outlines"), encoding="utf-8")
    return path


def test_the_body_is_drawn_at_every_pose_and_moves_with_the_linkage(browser, file, found):
    poses = found.task.poses
    wanted = carried(BODY, *poses.translation.T, poses.angle)
    best = found.linkages[0].linkage
    with browsers.opened(browser, file) as (page, said, _):
        drawn = page.evaluate(OUTLINES)
        near = PIXEL / drawn["scale"]
        wanted = wanted[[0, -1]]  # of many poses
        assert len(drawn["ghosts"]) == len(wanted)
        for ghost, corners in zip(drawn["ghosts"], wanted, strict=True):
            assert same_ring(ghost["plane"], corners) < near
        seen = []
        for share in np.linspace(0, 1, 7):
            page.evaluate(GO, share)
            (body,) = page.evaluate(OUTLINES)["body"]
            # Two of its corners tell where the body is; there it has to fit the links.
            z, own = np.array(body["plane"]) @ [1, 1j], np.array(BODY) @ [1, 1j]
            turn = (z[1] - z[0]) / (own[1] - own[0])
            assert abs(turn) == pytest.approx(1, abs=2 * near)
            turn /= abs(turn)
            origin = (z - turn * own).mean()
            assert np.abs(z - origin - turn * own).max() < near
            for dyad in (best.first, best.second):
                pin = origin + turn * (dyad.moving_pivot @ [1, 1j])
                assert abs(pin - dyad.fixed_pivot @ [1, 1j]) == pytest.approx(
                    float(dyad.radius), abs=3 * near
                )
            seen.append(origin)
        assert np.abs(np.diff(seen)).min() > 0.1
        assert said == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1400])
def test_everything_is_inside_the_picture(browser, file, width, scheme):
    with browsers.opened(browser, file, width=width, color_scheme=scheme) as (page, said, _):
        drawn = page.evaluate(OUTLINES)
        near = PIXEL / drawn["scale"]
        for region, (corners, _) in zip(drawn["regions"], REGIONS, strict=True):
            assert same_ring(region["plane"], corners) < near
        for each in (*drawn["ghosts"], *drawn["body"], *drawn["regions"]):
            assert (np.array(each["pixels"]) >= 0).all()
            assert (np.array(each["pixels"]) <= drawn["size"]).all()
        assert page.locator(".bm-far-pivots").is_hidden()
        assert "keep out" in page.locator(".bm-keys").inner_text()
        assert "body at the poses" in page.locator(".bm-keys").inner_text()
        assert said == []


def test_names_of_regions_are_texts_whatever_they_say(browser, file, found):
    kept = [each.name for each in found.task.surroundings.keep_out]
    assert kept[1].startswith(HOSTILE[:60])
    with browsers.opened(browser, file) as (page, said, _):
        titles = page.locator(".bm-region > title").all_text_contents()
        assert titles == ["bumper", kept[1], "keep out"]
        bumper, other = page.locator(".bm-region-name").all_text_contents()
        assert bumper == "bumper"
        assert other == kept[1][:27] + "…"
        assert page.locator("script").count() == 2  # the data and the page's own
        assert said == []


def test_a_body_much_larger_than_its_linkage_is_held_and_the_linkage_seen_alone_on_request(
    browser, tmp_path
):
    file = tmp_path / "large.html"
    file.write_text(page_of(synthesize(bodied(size=30, regions=())), "large"), encoding="utf-8")
    with browsers.opened(browser, file) as (page, said, _):
        before = page.evaluate(OUTLINES)
        corners = np.concatenate([each["pixels"] for each in before["ghosts"]])
        assert (corners >= 0).all()
        assert (corners <= before["size"]).all()
        page.locator(".bm-close-up input").check()
        assert page.evaluate(OUTLINES)["scale"] > 5 * before["scale"]
        assert said == []


def test_the_pages_data_carry_the_outlines(file, found):
    text = file.read_text(encoding="utf-8")
    data = json.loads(re.search(r'<script type="application/json"[^>]*>(.*?)</script>', text)[1])
    assert same_ring(data["body"], BODY) == 0
    for kept, (corners, name) in zip(data["keep_out"], REGIONS, strict=True):
        assert same_ring(kept["outline"], corners) == 0
        assert (kept["name"] == "") == (name is None)
        # Its name stands inside: the angles that its corners are seen under make a whole turn.
        z = np.array(kept["outline"]) @ [1, 1j] - complex(*kept["at"])
        assert abs(np.angle(np.roll(z, -1) / z).sum()) == pytest.approx(2 * np.pi)


def test_without_a_linkage_everything_is_shown(browser, tmp_path):
    task = bodied(size=30, regions=())
    file = tmp_path / "none.html"
    found = replace(synthesize(task), linkages=(), dyads=())
    file.write_text(page_of(found, "none"), encoding="utf-8")
    with browsers.opened(browser, file) as (page, said, _):
        drawn = page.evaluate(OUTLINES)
        wanted = carried(30 * np.array(BODY), *task.poses.translation.T, task.poses.angle)
        for ghost, corners in zip(drawn["ghosts"], wanted, strict=True):
            assert same_ring(ghost["plane"], corners) < PIXEL / drawn["scale"]
            assert (np.array(ghost["pixels"]) >= 0).all()
            assert (np.array(ghost["pixels"]) <= drawn["size"]).all()
        assert drawn["body"] == []
        assert said == []


def test_where_not_all_has_room_the_body_goes_before_the_regions(browser, tmp_path):
    """A wall much longer than the linkage is cut, the body is not."""
    task = bodied()
    wall = Polygon(np.array([(8, -400), (9, -400), (9, 400), (8, 400)]))
    file = tmp_path / "wall.html"
    task = replace(task, surroundings=Surroundings((KeepOut(wall, "wall"),)))
    file.write_text(page_of(synthesize(task), "wall"), encoding="utf-8")
    with browsers.opened(browser, file) as (page, said, _):
        drawn = page.evaluate(OUTLINES)
        (region,) = drawn["regions"]
        assert (np.array(region["pixels"]) < 0).any()
        for each in (*drawn["ghosts"], *drawn["body"]):
            assert (np.array(each["pixels"]) >= 0).all()
            assert (np.array(each["pixels"]) <= drawn["size"]).all()
        assert page.locator(".bm-far-pivots").is_visible()
        assert said == []
