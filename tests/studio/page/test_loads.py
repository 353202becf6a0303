"""Loads in the studio: their panel, springs in the picture, and both while a hand drags."""

from tests.oracles.studio_page import choose, drag, drop, has_poses, open_tab, solved

LID = """length_unit = "mm"
angle_unit = "deg"
[[poses]]
x = 0
y = 0
angle = 0
[[poses]]
x = -20
y = -10
angle = 25
[[poses]]
x = -60
y = -5
angle = 60
[loads]
body = { mass_kg = 4, center = [30, 0] }
hand = { at = [70, 5] }
[[springs]]
kind = "extension"
ground_point = [0, -80]
body_point = [60, 0]
rate_N_per_mm = 0.5
free_length = 10
[drive]
duration_s = 2
"""


def test_the_panel_is_there_for_tasks_with_loads_only(page):
    panel = page.locator("[data-panel=loads]")
    assert panel.is_hidden()
    drop(page, "lid.toml", LID)
    has_poses(page, 3)
    solved(page)
    open_tab(page, "loads")
    panel.locator(".bm-cursor").wait_for()
    assert panel.locator(".bm-panel").count() == 4
    arrows = page.locator(".bs-scene .bm-pin-force")
    assert not arrows.first.is_visible()
    panel.locator(".bm-show-forces").check()
    assert [each.is_visible() for each in arrows.all()] == [True] * 4
    panel.get_by_text("Over time").click()
    assert "time (s)" in panel.inner_text()
    # The other driver bears something else, which nobody has computed.
    page.locator("[data-driver]").last.check()
    page.wait_for_function("() => !document.querySelector('[data-panel=loads] .bm-panel')")
    choose(page, "task", "data-do=new")
    has_poses(page, 0)
    assert panel.is_hidden()


def test_springs_follow_a_hand(page):
    drop(page, "lid.toml", LID)
    has_poses(page, 3)
    solved(page)
    spring = page.locator(".bs-scene .bm-spring")
    assert spring.count() == 1
    before = spring.get_attribute("d")
    assert page.locator(".bs-scene .bm-hand").get_attribute("d").startswith("M")
    page.locator('[data-row="2"] .bs-index').click()
    assert spring.get_attribute("d") != before
    before = spring.get_attribute("d")
    drag(page, '.bs-pose .bs-origin[data-pose="2"]', 12, 8)
    solved(page)
    assert spring.get_attribute("d") != before
    assert page.locator("[data-panel=loads] .bm-stale").count() == 0


def test_fields_for_what_is_asked_of_loads(page):
    """They are there where the task has loads; a least force makes the bound a corridor."""
    least, greatest = (
        page.locator(f"[data-key=hand_force_N-{name}]") for name in ("least", "greatest")
    )
    assert greatest.is_hidden()
    drop(page, "lid.toml", LID.replace("[loads]", "[requirements]\nhand_force_N = 400\n[loads]"))
    has_poses(page, 3)
    solved(page)
    assert (least.input_value(), greatest.input_value()) == ("", "400")
    least.fill("-50")
    least.press("Enter")
    solved(page)
    assert (least.input_value(), greatest.input_value()) == ("−50", "400")
