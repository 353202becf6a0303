"""The panel of loads of a page: curves, a cursor that goes with the picture, springs in it."""

import re

import numpy as np
import pytest

import burmester
from burmester import Drive, End, Loads, Mass, Spring
from burmester.report.page import page as page_of
from tests.oracles.browser import opened

SLIDE = """(share) => {
  const slider = document.querySelector(".bm-slider");
  slider.value = +slider.min + share * (slider.max - slider.min);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""
SPRING = """() => {
  const svg = document.querySelector(".bm-plane"), { scale, left, top } = svg.dataset;
  const path = svg.querySelector(".bm-spring").getAttribute("d");
  const numbers = path.match(/-?[\\d.]+/g).map(Number);
  const [x, y, u, v] = [...numbers.slice(0, 2), ...numbers.slice(-2)];
  return [(x - left) / scale, (top - y) / scale, (u - left) / scale, (top - v) / scale];
}"""
POINT = (60.0, 0.0)


@pytest.fixture(scope="module")
def lid(tmp_path_factory):
    """A linkage, and its page."""
    loads = Loads(
        body=Mass(4.0, [30.0, 0.0], 0.01),
        hand=[70.0, 5.0],
        springs=(
            Spring(
                "extension",
                (End("ground", (0.0, -80.0)), End("body", POINT)),
                {"rate_N_per_mm": 0.5, "free_length": 10.0},
            ),
        ),
        drive=Drive(2.0),
    )
    rows = [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)]
    task = burmester.Task.from_rows(rows, angle_unit="deg", length_unit="mm", loads=loads)
    result = burmester.synthesize(task)
    path = tmp_path_factory.mktemp("pages") / "lid.html"
    path.write_text(page_of(result, "lid"), encoding="utf-8")
    return result.best, path


def cursor(page):
    """How far the cursor of the loads is from the left; None where it is not shown."""
    mark = page.locator(".bm-loaded .bm-cursor")
    if mark.get_attribute("visibility") == "hidden":
        return None
    return float(re.search(r"-?[\d.]+", mark.get_attribute("transform")).group())


def test_curves_over_the_driver_and_over_time_with_one_cursor(browser, lid):
    _, path = lid
    with opened(browser, path) as (page, said, _):
        panel = page.locator(".bm-loaded")
        assert panel.locator(".bm-panel").count() == 4
        assert panel.locator(".bm-line").count() == 3 + 4
        at = []
        for share in (0.0, 0.5, 1.0):
            page.evaluate(SLIDE, share)
            at.append(cursor(page))
        assert at[0] < at[1] < at[2]
        panel.get_by_text("Over time").click()
        assert "speed" in panel.inner_text()
        assert "time (s)" in panel.inner_text()
        timed = []
        for share in (0.0, 0.5, 1.0):
            page.evaluate(SLIDE, share)
            timed.append(cursor(page))
        # From the first pose to the last, whichever way the driver's angle goes.  Where it starts
        # from rest, an angle between two frames is some hundredths of a second off.
        assert np.ptp(timed) == pytest.approx(np.ptp(at), rel=0.02)
        # The pointer moves the linkage.
        box = panel.locator(".bm-plots").bounding_box()
        page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 60)
        middle = cursor(page)
        page.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + 60)
        assert cursor(page) > middle + 20
        assert said == []


def test_beyond_the_poses_the_cursor_is_gone(browser, lid):
    _, path = lid
    with opened(browser, path) as (page, said, _):
        page.locator(".bm-whole input").check()
        page.evaluate(SLIDE, 0.0)
        assert cursor(page) is None
        assert said == []


def test_the_spring_goes_with_the_body(browser, lid):
    best, path = lid
    with opened(browser, path) as (page, said, _):
        for share in (0.0, 0.4, 1.0):
            page.evaluate(SLIDE, share)
            x, y, u, v = page.evaluate(SPRING)
            assert (x, y) == pytest.approx((0.0, -80.0), abs=0.05)
            ends = best.motion(2001).body.act(np.array(POINT))
            assert np.hypot(*(ends - [u, v]).T).min() < 0.1
        assert page.locator(".bm-plane .bm-hand").first.get_attribute("d").startswith("M")
        assert "extension spring" in page.locator(".bm-keys").first.inner_text()
        assert said == []


def test_a_phone_has_room_for_it(browser, lid):
    _, path = lid
    with opened(browser, path, width=390, height=800) as (page, said, _):
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        panel = page.locator(".bm-loaded").bounding_box()
        stage = page.locator(".bm-stage").bounding_box()
        assert panel["y"] > stage["y"]
        assert panel["width"] <= 390
        assert said == []
