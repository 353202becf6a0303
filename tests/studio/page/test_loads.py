"""Loads in the studio: their panel, springs in the picture, and both while a hand drags."""

import numpy as np
import pytest

from burmester import synthesize
from burmester.describe.quality_words import load_notes
from burmester.io.spring_list import in_pairs, usual_springs
from burmester.live.document import task_of
from burmester.synthesis.balanced import BalanceRegions, springs_for
from tests.oracles.studio_page import (
    LID_OF_FIVE,
    choose,
    drag,
    drop,
    has_poses,
    kept,
    middle,
    open_tab,
    see_all,
    solved,
    view,
)

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
    open_tab(page, "motion").locator("[data-driver]").last.check()
    open_tab(page, "loads")
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
    # A point that lies where a pose has its handle has its own beside it; it snaps as others do.
    page.locator("[data-section=loads] > summary").click()
    for axis in "xy":
        enter(page, f"loads.hand.at.{axis}", "0")
    poses = kept(page)["poses"]
    x, y = middle(page, "[data-load=hand] .bs-hold")
    page.mouse.move(x, y)
    page.mouse.down()
    page.keyboard.down("Shift")
    page.mouse.move(x + 3, y - 60, steps=4)
    page.mouse.up()
    page.keyboard.up("Shift")
    turn = np.exp(1j * np.radians(poses[1]["angle"]))
    put = complex(*kept(page)["loads"]["hand"]["at"]) * turn
    assert put == pytest.approx(60j / view(page)["scale"], abs=0.6)
    assert kept(page)["poses"] == poses


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
    enter(page, "hand_force_N-least", "-50")
    solved(page)
    assert (least.input_value(), greatest.input_value()) == ("−50", "400")
    # A least force without a greatest stays where it is, and says what it waits for.
    enter(page, "hand_force_N-least", "")
    enter(page, "hand_force_N-greatest", "")
    enter(page, "hand_force_N-least", "-40")
    assert "Write the greatest as well" in page.locator("label", has=least).inner_text()
    enter(page, "hand_force_N-greatest", "300")
    assert kept(page)["requirements"] == {"hand_force_N": [-40, 300]}


def enter(page, key, text):
    field = page.locator(f'[data-key="{key}"]')
    field.fill(text)
    field.press("Enter")


def test_a_lid_gets_its_weight_a_hand_and_the_spring_that_makes_it_light(page):
    """From bare poses to a balanced lid by fields and the mouse; Python finds the same spring."""
    drop(page, "lid.toml", LID_OF_FIVE)
    has_poses(page, 5)
    page.locator("[data-section=loads] > summary").click()
    enter(page, "mass_kg", "4")
    page.locator("[data-do=add-hand]").click()
    for axis, value in zip("xy", ("420", "0"), strict=True):
        enter(page, f"loads.hand.at.{axis}", value)
    solved(page)
    page.locator('[data-row="1"] .bs-index').click()
    see_all(page)
    before = kept(page)["loads"]["body"]["center"]
    drag(page, "[data-load=centre]", 40, 0)
    solved(page)
    document = kept(page)
    moved = [before[0] + 40 / view(page)["scale"], before[1]]
    assert document["loads"]["body"]["center"] == pytest.approx(moved, abs=1)
    bare = synthesize(task_of(document)).best
    expected, *_ = springs_for(bare, usual_springs("mm"))
    page.locator("[data-do=find-spring]").click()
    page.locator("[data-spring-name]").first.wait_for()
    # Two of each, within a box: again those that Python finds, then the usual ones once more.
    within = BalanceRegions(np.array([[-200, -260], [500, 60]]))
    other, *_ = springs_for(bare, in_pairs(usual_springs("mm")), within)
    page.locator("[data-section=balance] > summary").click()
    page.locator("[data-balance=pairs]").check()
    page.locator("[data-balance=ground]").fill("-200,-260:500,60")
    page.locator("[data-do=find-spring]").click()
    page.locator(f"[data-spring-name='{other.offer.name}']").first.wait_for()
    assert page.locator("[data-spring-name]").all_inner_texts()[0].startswith("two ")
    page.locator("[data-balance=pairs]").uncheck()
    page.locator("[data-balance=ground]").fill("")
    page.locator("[data-do=find-spring]").click()
    page.locator(f"[data-spring-name='{expected.offer.name}']").first.wait_for()
    first = page.locator("[data-spring-name]").first
    assert first.get_attribute("data-spring-name") == expected.offer.name
    first.click()
    solved(page)
    document = kept(page)
    (spring,) = document["springs"]
    assert spring["ground_point"] == pytest.approx(expected.spring.ends[0].point, abs=1e-9)
    # The answer follows: what the page says of the hand is what Python says of the sprung lid.
    sprung = synthesize(task_of(document)).best
    assert sprung.loads.hand.magnitude < 0.5 * bare.loads.hand.magnitude
    (said,) = (each for each in load_notes(sprung.loads, sprung.task) if "A hand moves it" in each)
    assert said in page.locator(".bs-load-notes").text_content()
    # What the fields cannot read stays in them, and what they do not show is not lost.
    enter(page, "spring-0-body_point-x", "far")
    assert "not a number" in page.locator("[data-spring='0']").inner_text()
    assert kept(page)["springs"] == [spring]
