"""What is drawn by mouse: regions, limits, the outline of the body; and what is met or broken."""

import math

import numpy as np
import pytest

from tests.oracles.studio_page import (
    drag,
    kept,
    middle,
    number,
    on_screen,
    pose,
    see_all,
    solved,
    view,
)


def section(page, name):
    """Open a part of the task's panel."""
    if not page.locator(f"[data-section={name}]").evaluate("node => node.open"):
        page.locator(f"[data-section={name}] > summary").click()


def draw_box(page, what, low, high):
    page.locator(f'[data-draw="{what}"]').click()
    page.mouse.move(*on_screen(page, *low))
    page.mouse.down()
    page.mouse.move(*on_screen(page, *high), steps=4)
    page.mouse.up()


@pytest.fixture
def page(same_page):
    return same_page


def test_a_region_is_drawn_named_moved_reshaped_and_deleted(page):
    see_all(page)
    section(page, "keep-out")
    draw_box(page, "region box", (-60, 100), (-20, 180))
    scale = view(page)["scale"]
    (region,) = kept(page)["keep_out"]
    assert region["box"][0] == pytest.approx([-60, 100], abs=1 / scale)
    assert region["box"][1] == pytest.approx([-20, 180], abs=1 / scale)
    name = page.locator('[data-key="region-name-0"]')
    name.fill("wall")
    name.press("Enter")
    drag(page, '[data-region="0"] .bs-shape-area', 30, 20)
    (moved,) = kept(page)["keep_out"]
    assert moved["name"] == "wall"
    assert moved["box"][0] == pytest.approx(
        [region["box"][0][0] + 30 / scale, region["box"][0][1] - 20 / scale], abs=1 / scale
    )
    # Corner 3 is the upper one on the right: the opposite one stays.
    drag(page, '[data-handles="region 0"] [data-corner="3"]', -15, 12)
    (smaller,) = kept(page)["keep_out"]
    assert smaller["box"][0] == moved["box"][0]
    assert smaller["box"][1] == pytest.approx(
        [moved["box"][1][0] - 15 / scale, moved["box"][1][1] - 12 / scale], abs=1 / scale
    )
    page.locator('[data-region="0"] .bs-shape-area').focus()
    page.keyboard.press("Shift+ArrowLeft")
    assert kept(page)["keep_out"][0]["box"][0][0] == pytest.approx(smaller["box"][0][0] - 10)
    page.keyboard.press("Delete")
    assert "keep_out" not in kept(page)
    assert page.locator("[data-region]").count() == 0
    page.keyboard.press("Control+z")
    assert page.locator("[data-region]").count() == 1


def test_a_rail_and_a_slot_are_stated_and_drawn(page):
    see_all(page)
    section(page, "limits")
    for line in ("rail", "slot"):
        page.locator(f"[data-line={line}-0] > summary").click()
    direction = page.locator("[data-key=rail-0-direction_deg]")
    direction.fill("90")
    direction.press("Enter")
    draw_box(page, "limit 0 rail travel box", (100, -80), (140, 60))
    draw_box(page, "limit 0 slot through box", (20, -10), (60, 20))
    near = 1 / view(page)["scale"]
    limits = kept(page)["limits"]
    assert limits["rail"]["direction_deg"] == 90
    assert np.array(limits["rail"]["travel"]["box"]) == pytest.approx(
        np.array([[100, -80], [140, 60]]), abs=near
    )
    # A slot is of the body: it is drawn, and stated, where the body stands at the first pose.
    low, high = np.array(limits["slot"]["through"]["box"])
    assert high - low == pytest.approx([40, 30], abs=2 * near)
    for mark in (".bs-rail-travel[data-plane=F]", ".bs-slot-through[data-plane=M]"):
        assert page.locator(f"{mark}:not(.bs-met, .bs-broken)").count() == 1
    page.locator(".bs-rail-travel .bs-shape-area").focus()
    page.keyboard.press("Shift+ArrowLeft")
    moved = np.array(kept(page)["limits"]["rail"]["travel"]["box"])
    assert moved == pytest.approx(np.array(limits["rail"]["travel"]["box"]) - [10, 0])
    page.locator("[data-do='delete-limit-0-slot through']").click()
    assert kept(page)["limits"].keys() & {"rail", "slot"} == {"rail"}


def test_a_region_in_the_way_is_seen_broken_and_the_task_is_refused(page):
    see_all(page)
    section(page, "keep-out")
    draw_box(page, "region box", (230, 100), (280, 140))
    assert "bs-broken" in page.locator('[data-region="0"]').get_attribute("class")
    assert (
        "The body touches it at pose"
        in page.locator('[data-region-row="0"] .bs-state').inner_text()
    )
    banner = page.locator("[data-banner=refused]")
    assert "keep-out region 1" in banner.inner_text()
    assert "E175" in banner.inner_text()
    page.keyboard.press("Control+z")
    solved(page)
    assert banner.count() == 0


def test_limits_are_dragged_and_seen_met_or_broken(page):
    section(page, "limits")
    limit = page.locator('.bs-limit[data-limit="0"]')
    state = page.locator("[data-section=limits] .bs-limit-box").first.locator(".bs-state")
    assert (limit.get_attribute("data-plane"), limit.get_attribute("data-shape")) == ("F", "box")
    assert "bs-met" in limit.get_attribute("class")
    # The task's limits hold for both dyads; each gets its own, and the first one's moves away.
    page.locator("[data-key=limits-apart]").check()
    scale = view(page)["scale"]
    x, y = middle(page, '.bs-limit[data-limit="0"] .bs-shape-area')
    area = page.locator('.bs-limit[data-limit="0"] .bs-shape-area')
    area.focus()
    before = kept(page)["limits"][0]["fixed_pivot"]["box"]
    for _ in range(8):
        page.keyboard.press("Shift+ArrowLeft")
    after = kept(page)["limits"][0]["fixed_pivot"]["box"]
    assert [
        a - b
        for one, other in zip(after, before, strict=True)
        for a, b in zip(one, other, strict=True)
    ] == [-80, 0, -80, 0]
    assert kept(page)["limits"][1]["fixed_pivot"]["box"] == before
    moved = middle(page, '.bs-limit[data-limit="0"] .bs-shape-area')
    assert moved == pytest.approx((x - 80 * scale, y), abs=1)
    assert "bs-broken" in limit.get_attribute("class") or "Solving" in page.inner_text(".bs-status")
    page.keyboard.press("Delete")
    assert "fixed_pivot" not in kept(page)["limits"][0]
    # A point in its place.
    page.locator('[data-draw="limit 0 fixed_pivot point"]').click()
    page.mouse.click(*on_screen(page, 120, -60))
    point = kept(page)["limits"][0]["fixed_pivot"]["point"]
    assert point == pytest.approx([120, -60], abs=1 / scale)
    assert state.count() == 1
    field = page.locator("[data-section=limits] .bs-limit-box").first.locator(".bs-number").first
    assert number(field.input_value()) == point[0]
    field.fill("110")
    field.press("Enter")
    assert kept(page)["limits"][0]["fixed_pivot"]["point"] == [110, point[1]]


def test_the_outline_is_drawn_by_clicks_and_seen_at_every_pose(page):
    see_all(page)
    section(page, "body")
    page.locator("[data-do=delete-body]").click()
    assert page.locator(".bs-ghost").count() == 0
    page.locator("[data-key=reference]").select_option(label="open")
    page.locator('[data-row="2"] .bs-index').click()  # which is not where it is drawn
    page.locator("[data-draw=body]").click()
    assert page.locator(".bs-line").inner_text().startswith("Drawn at pose open.")
    assert page.locator(".bs-pose-name.bs-reference").text_content() == "open: drawn here"
    x, y, angle = pose(page, 8)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    corners = [(20, 10), (120, 10), (120, 60), (70, 90)]
    for u, v in corners:
        page.mouse.click(*on_screen(page, x + c * u - s * v, y + s * u + c * v))
    page.keyboard.press("Backspace")
    page.keyboard.press("Enter")
    scale = view(page)["scale"]
    body = kept(page)["body"]
    assert [tuple(each) for each in body] == [
        pytest.approx(corner, abs=1.5 / scale) for corner in corners[:3]
    ]
    assert page.locator(".bs-ghost").count() == 2  # of eight: the first and the last one
    box = page.locator(".bs-ghost").first.bounding_box()  # at the first pose M is F
    left, top = on_screen(page, 20, 60)
    assert (box["x"], box["y"]) == pytest.approx((left, top), abs=3)
    # The middle of an edge makes a corner where it is dragged to, along the axes of M.
    drag(page, '[data-handles=body] [data-edge="1"]', 0, 30)
    longer = kept(page)["body"]
    assert len(longer) == 4
    down = -30 / scale
    assert longer[1] == pytest.approx([70 + s * down, 10 + c * down], abs=2 / scale)
    page.locator('[data-handles=body] [data-corner="2"]').focus()
    page.keyboard.press("Delete")
    assert kept(page)["body"] == body


def test_the_plane_is_panned_zoomed_and_fitted(page):
    first = view(page)
    box = page.locator(".bs-scene").bounding_box()
    x, y = round(box["x"] + 0.8 * box["width"]), round(box["y"] + 0.12 * box["height"])
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 70, y + 35, steps=5)
    page.mouse.up()
    panned = view(page)
    assert panned["scale"] == first["scale"]
    assert panned["left"] - first["left"] == pytest.approx(-70, abs=0.01)
    assert panned["top"] - first["top"] == pytest.approx(35, abs=0.01)
    under = (
        (x - box["x"] - panned["left"]) / panned["scale"],
        (panned["top"] - y + box["y"]) / panned["scale"],
    )
    page.mouse.move(x, y)
    page.mouse.wheel(0, -300)
    zoomed = view(page)
    assert zoomed["scale"] > 1.3 * panned["scale"]
    assert on_screen(page, *under) == pytest.approx((x, y), abs=0.01)  # what is under it stays
    page.locator("[data-do=fit]").click()
    assert view(page) == pytest.approx(first)
    page.locator(".bs-scene").focus()
    page.keyboard.press("+")
    page.keyboard.press("ArrowRight")
    assert view(page)["scale"] == pytest.approx(1.25 * first["scale"])
    page.keyboard.press("0")
    assert view(page) == pytest.approx(first)
    ghosts = page.locator(".bs-ghosts").bounding_box()  # the far end of the lid is inside
    assert ghosts["y"] > box["y"]
    assert ghosts["x"] + ghosts["width"] < box["x"] + box["width"]
    page.locator(".bs-scene").focus()
    page.keyboard.press("z")
    assert view(page)["scale"] > 1.5 * first["scale"]


def test_keys_alone_draw_a_shape_and_move_it(page):
    section(page, "keep-out")
    page.locator('[data-draw="region box"]').focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Enter")
    ((x, y), (u, v)) = kept(page)["keep_out"][0]["box"]
    box = page.locator(".bs-scene").bounding_box()
    centre = on_screen(page, (x + u) / 2, (y + v) / 2)
    assert centre == pytest.approx(
        (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2), abs=1
    )
    page.locator('[data-region="0"] .bs-shape-area').focus()
    page.keyboard.press("ArrowUp")
    assert kept(page)["keep_out"][0]["box"][0] == pytest.approx([x, y + 1])
    page.locator('[data-handles="region 0"] [data-corner="1"]').focus()
    page.keyboard.press("Shift+ArrowLeft")
    assert kept(page)["keep_out"][0]["box"] == [
        pytest.approx([x - 10, y + 1]),
        pytest.approx([u, v + 1]),
    ]
