"""Pivots put down by hand: in the plane, on the map, along curves of four poses, or anywhere."""

import math
import re

import numpy as np
import pytest

from burmester.dyads.pivot_map import fixed_pivot_map, moving_pivot_map
from burmester.geometry.displacement import Displacement
from tests.oracles.browser import at_rest
from tests.oracles.studio_page import answered, drag, open_tab, place_of, solved, view

FIXED = '.bs-pivot[data-pivot="{}"][data-plane="F"]'
MOVING = '.bs-pivot[data-pivot="{}"][data-plane="M"]'
POINT = r"\((-?[\d.]+), (-?[\d.]+)\)"


def poses_of(page):
    rows = page.locator("[data-row]")
    found = []
    for row in range(rows.count()):
        fields = [rows.nth(row).locator(f'[data-key="{key}"]') for key in ("x", "y", "angle")]
        found.append([float(each.input_value().replace("−", "-")) for each in fields])
    found = np.array(found)
    return Displacement(found[:, :2], np.radians(found[:, 2]))


def told(page, name):
    """Fixed pivot, moving pivot and greatest miss of a dyad, as the page tells them."""
    text = page.locator(".bs-placed-readout").inner_text()
    said = re.search(rf"{name}: fixed pivot {POINT}, moving pivot {POINT}, misses by (\S+)", text)
    values = [float(each) for each in said.groups()[:4]]
    miss = 0.0 if said[5] == "nothing" else float(said[5])
    return values[:2], values[2:], miss


def waits(page):
    page.wait_for_function(
        "() => /P1: /.test(document.querySelector('.bs-placed-readout').textContent)"
    )
    answered(page)


def test_a_fixed_pivot_that_is_dragged_costs_what_the_map_says(page):
    start = place_of(page, FIXED.format("D1"))
    scale = view(page)["scale"]
    drag(page, FIXED.format("D1"), 40, -15)
    waits(page)
    fixed, moving, miss = told(page, "P1")
    assert fixed == pytest.approx([start[0] + 40 / scale, start[1] + 15 / scale], abs=1 / scale)
    best = fixed_pivot_map(poses_of(page), np.array(fixed))
    assert moving == pytest.approx(best.dyads.moving_pivot.tolist(), abs=0.06)
    assert miss == pytest.approx(float(best.max_error), rel=0.06)
    # The linkage of both is drawn, with its card; the handle is where the hand let go.
    card = page.locator('[data-linkage="placed"]')
    assert card.locator("button").first.get_attribute("aria-pressed") == "true"
    assert place_of(page, FIXED.format("P1")) == pytest.approx(fixed, abs=0.06)
    drawn = page.locator(".bs-mechanism .bm-fixed-pin[data-dyad=P1]")
    at = view(page)
    assert (float(drawn.get_attribute("cx")) - at["left"]) / at["scale"] == pytest.approx(
        fixed[0], abs=0.06
    )
    # Escape on the handle lets go: the linkage that was chosen is back.
    page.locator(FIXED.format("P1")).focus()
    page.keyboard.press("Escape")
    page.wait_for_selector('[data-linkage="placed"]', state="detached")
    assert place_of(page, FIXED.format("D1")) == pytest.approx(start, abs=0.01)


def test_keys_move_a_pivot_of_the_body(page):
    page.locator(".bm-next").click()
    handle = page.locator(MOVING.format("D2"))
    own = [float(each) for each in re.search(POINT, handle.get_attribute("aria-label")).groups()]
    handle.focus()
    page.keyboard.press("ArrowRight")
    waits(page)
    _, moving, miss = told(page, "P2")
    step = moving[0] - own[0]
    assert 0 < step < 20
    assert moving[1] == pytest.approx(own[1], abs=0.06)
    best = moving_pivot_map(poses_of(page), np.array(moving))
    assert miss == pytest.approx(float(best.max_error), rel=0.06)


def test_a_press_on_the_map_puts_the_nearest_pivot_there(page):
    panel = open_tab(page, "pivots").locator(".bm-map svg")
    page.wait_for_selector(".bs-map-pivot")
    box = at_rest(panel)
    page.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + 0.35 * box["height"])
    page.mouse.down()
    waits(page)  # the first linkage of the hand may move what is below the plane
    box = at_rest(panel)
    page.mouse.move(box["x"] + 0.72 * box["width"], box["y"] + 0.4 * box["height"], steps=4)
    page.mouse.up()
    waits(page)
    texts = page.locator(".bs-placed-readout").inner_text()
    pivots = [told(page, name)[0] for name in ("P1", "P2")]
    marks = page.locator(".bs-map-pivot").evaluate_all(
        "all => all.map((e) => { const b = e.querySelector('circle').getBoundingClientRect();"
        " return [b.x + b.width / 2, b.y + b.height / 2]; })"
    )
    box = at_rest(panel)
    wanted = box["x"] + 0.72 * box["width"], box["y"] + 0.4 * box["height"]
    away = [math.dist(mark, wanted) for mark in marks]
    k = int(np.argmin(away))
    assert away[k] < 2, texts
    best = fixed_pivot_map(poses_of(page), np.array(pivots[k]))
    assert told(page, f"P{k + 1}")[2] == pytest.approx(float(best.max_error), rel=0.06)


def with_poses(page, rows):
    """Another task, from a file."""
    poses = ", ".join(f"{{x={x}, y={y}, angle={angle}}}" for x, y, angle in rows)
    text = f'length_unit = "mm"\nangle_unit = "deg"\nposes = [{poses}]\n'
    file = {"name": "few.toml", "mimeType": "application/toml", "buffer": text.encode()}
    page.locator("input[type=file]").first.set_input_files(file)
    page.wait_for_function(
        "(count) => document.querySelectorAll('[data-row]').length === count", arg=len(rows)
    )
    solved(page)


@pytest.mark.parametrize("plane", ["F", "M"])
def test_of_four_poses_a_pivot_slides_along_its_curve(page, plane):
    with_poses(page, [(0, 0, 0), (30, 12, 20), (55, 40, 45), (60, 75, 80)])
    handle = (FIXED if plane == "F" else MOVING).format("D1")
    drag(page, handle, 25, -10)
    waits(page)
    fixed, moving, miss = told(page, "P1")
    assert miss < 1e-6
    poses = poses_of(page)
    arms = poses.act(np.array(moving)) - np.array(fixed)
    assert np.ptp(np.hypot(*arms.T)) < 0.15  # as far as the digits that are told leave it
    assert page.locator(".bs-curve-F .bs-curve-works").get_attribute("d") != ""


def test_of_three_poses_a_pivot_goes_anywhere(page):
    with_poses(page, [(0, 0, 0), (30, 12, 20), (55, 40, 60)])
    before, scale = place_of(page, FIXED.format("D1")), view(page)["scale"]
    drag(page, FIXED.format("D1"), -31, 17)
    waits(page)
    fixed, moving, miss = told(page, "P1")
    assert fixed == pytest.approx([before[0] - 31 / scale, before[1] - 17 / scale], abs=1 / scale)
    assert miss == 0.0
    arms = poses_of(page).act(np.array(moving)) - np.array(fixed)
    assert np.ptp(np.hypot(*arms.T)) < 0.15
