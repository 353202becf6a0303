"""Poses by hand: dragged, turned, moved by keys, typed, added and removed, undone and redone."""

import math
from itertools import pairwise

import pytest

from tests.oracles.browser import idle
from tests.oracles.studio_page import (
    drag,
    drawn,
    field,
    kept,
    number,
    on_screen,
    pose,
    same_angle,
    see_all,
    solved,
    view,
)

REST = 150  # milliseconds without an edit before the whole task is solved
ORIGIN, TURN = '.bs-origin[data-pose="{}"]', '.bs-turn[data-turn="{}"]'


@pytest.fixture
def page(same_page):
    return same_page


def test_a_drag_moves_the_pose_by_what_the_hand_moved(page):
    before, scale = pose(page, 8), view(page)["scale"]
    drag(page, ORIGIN.format(8), 40, -25)
    x, y, angle = pose(page, 8)
    assert (x - before[0], y - before[1]) == pytest.approx(
        (40 / scale, 25 / scale), abs=0.6 / scale
    )
    assert angle == before[2]
    assert drawn(page, 8)[:2] == pytest.approx((x, y), abs=0.1 / scale)
    page.keyboard.press("Control+z")  # one entry for all of the gesture
    assert pose(page, 8) == before
    assert page.locator("[data-do=undo]").is_disabled()
    page.keyboard.press("Control+Shift+z")
    assert pose(page, 8) == (x, y, angle)
    solved(page)


def test_a_pose_goes_with_the_hand_though_nobody_answers(page):
    """The picture of the hand is the page's own: it is there before any answer."""
    before, scale = pose(page, 8), view(page)["scale"]
    page.evaluate("""() => {
      window.sent = WebSocket.prototype.send;
      WebSocket.prototype.send = function (data) { (window.held ??= []).push([this, data]); };
    }""")
    x, y = on_screen(page, *before[:2])
    page.mouse.move(x, y)
    page.mouse.down()
    for k in (1, 2, 3):
        page.mouse.move(x + 10 * k, y - 5 * k)
        at = before[0] + 10 * k / scale, before[1] + 5 * k / scale
        assert drawn(page, 8)[:2] == pytest.approx(at, abs=0.6 / scale)
    page.mouse.up()
    assert pose(page, 8)[:2] == pytest.approx(at, abs=0.6 / scale)
    page.evaluate("""() => {
      WebSocket.prototype.send = window.sent;
      for (const [socket, data] of window.held) socket.send(data);
    }""")
    solved(page)


def test_a_task_is_sent_before_the_next_picture(page):
    """A browser hands a hand's moves on with its next picture; the server is asked before."""
    page.evaluate("""() => {
      window.log = [];
      const send = WebSocket.prototype.send;
      WebSocket.prototype.send = function (data) {
        if (JSON.parse(data).do === "follow") log.push("sent");
        return send.call(this, data);
      };
      window.unlisten = new AbortController();
      for (const name of ["pointerrawupdate", "pointermove"])
        addEventListener(name, () => log.push(name), { capture: true, signal: unlisten.signal });
      unlisten.signal.addEventListener("abort", () => (WebSocket.prototype.send = send));
    }""")
    x, y = on_screen(page, *pose(page, 8)[:2])
    page.mouse.move(x, y)
    page.mouse.down()
    idle(page)
    page.evaluate("log.length = 0")
    page.mouse.move(x + 20, y)
    page.mouse.up()
    assert page.evaluate("log.slice(0, 3)") == ["pointerrawupdate", "sent", "pointermove"]
    page.evaluate("unlisten.abort()")
    solved(page)


def test_what_is_shown_already_is_not_written_again(page):
    """Of a field that is written a browser goes through every field of the page."""
    page.evaluate("""() => {
      window.again = [];
      window.watch = new MutationObserver((records) => {
        for (const { target, attributeName: name, oldValue, addedNodes, removedNodes } of records) {
          const [now, before] = [addedNodes, removedNodes].map((all) =>
            all.length === 1 && all[0].nodeType === Node.TEXT_NODE ? all[0].data : all);
          if (name ? target.getAttribute(name) === oldValue : now === before)
            window.again.push(`${name ?? "text"} of ${target.outerHTML.slice(0, 99)}`);
        }
      });
      const all = { attributes: true, attributeOldValue: true, childList: true, subtree: true };
      window.watch.observe(document, all);
      const { get, set } = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value");
      Object.defineProperty(HTMLInputElement.prototype, "value", { get, set(value) {
        if (get.call(this) === String(value)) window.again.push(`value of ${this.className}`);
        set.call(this, value);
      } });
    }""")
    x, y = on_screen(page, *pose(page, 8)[:2])
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(10):
        page.mouse.move(x + 2 * k, y + k)
        page.wait_for_timeout(30)
    again = page.evaluate("window.watch.disconnect(), window.again")
    page.mouse.up()
    assert again == []
    solved(page)


def test_nothing_is_said_aloud_while_a_pose_is_dragged(page):
    page.evaluate("""() => {
      window.said = [];
      for (const each of document.querySelectorAll(".bs-head [role=status]"))
        new MutationObserver(() => window.said.push(each.textContent))
          .observe(each, { childList: true, characterData: true, subtree: true });
      window.moves = [];
      addEventListener("pointermove", () => window.moves.push(performance.now()), true);
    }""")
    for _ in range(50):  # on a slow machine the hand may rest on its way, which is answered
        x, y = on_screen(page, *pose(page, 8)[:2])
        page.mouse.move(x, y)
        page.mouse.down()
        page.evaluate("window.said = [], window.moves = []")
        page.mouse.move(x + 30, y + 10, steps=20)
        said, moves = page.evaluate("[window.said, [...window.moves, performance.now()]]")
        page.mouse.up()
        if max(after - before for before, after in pairwise(moves)) < REST:
            break
        solved(page)
    assert said == []
    solved(page)
    assert page.evaluate("window.said.length") > 0


def test_escape_gives_a_drag_up(page):
    before = pose(page, 8)
    x, y = on_screen(page, *before[:2])
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 50, y + 30, steps=4)
    assert drawn(page, 8)[0] > before[0] + 1  # the table may lag behind a hand
    page.keyboard.press("Escape")
    assert pose(page, 8) == before
    page.mouse.move(x + 90, y)
    page.mouse.up()
    assert pose(page, 8) == before
    assert page.locator("[data-do=undo]").is_disabled()


def test_the_handle_turns_the_pose_to_where_it_is_dragged(page):
    x, y, _ = before = pose(page, 8)
    box = page.locator(TURN.format(8)).bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    cx, cy = on_screen(page, x, y)
    page.mouse.move(cx + 80 * math.cos(0.7), cy - 80 * math.sin(0.7), steps=6)
    page.mouse.up()
    assert pose(page, 8)[:2] == (x, y)
    assert same_angle(pose(page, 8)[2], math.degrees(0.7), 1.0)
    assert same_angle(drawn(page, 8)[2], pose(page, 8)[2], 0.01)
    page.locator("[data-do=undo]").click()
    assert pose(page, 8) == before


def test_keys_move_turn_and_remove(page):
    x, y, angle = pose(page, 3)
    page.locator(ORIGIN.format(3)).focus()
    for key in ("ArrowRight", "Shift+ArrowUp", "Alt+ArrowUp", "ArrowLeft", "ArrowLeft"):
        page.keyboard.press(key)
    assert pose(page, 3) == pytest.approx((x - 1, y + 10.1, angle), abs=1e-9)
    page.locator(TURN.format(3)).focus()
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Alt+ArrowDown")
    assert pose(page, 3)[2] == pytest.approx(angle + 0.9, abs=1e-9)
    fourth = pose(page, 4)
    page.locator(ORIGIN.format(3)).focus()
    page.keyboard.press("Delete")
    assert page.locator(".bs-pose-row").count() == 7
    assert pose(page, 3) == fourth
    assert page.evaluate("document.activeElement.dataset.pose") == "3"
    page.keyboard.press("Control+z")
    assert page.locator(".bs-pose-row").count() == 8


def test_tab_walks_from_handle_to_handle(page):
    page.locator(ORIGIN.format(1)).focus()
    met = []
    for _ in range(4):
        page.keyboard.press("Tab")
        met.append(
            page.evaluate(
                "[document.activeElement.dataset.pose, document.activeElement.dataset.turn]"
            )
        )
    walked = [each for pair in met for each in pair if each]
    assert sorted(walked) == ["1", "2", "2", "3"]


def test_a_field_takes_a_unit_and_keeps_what_is_no_number(page):
    box = field(page, 4, "x")
    before = pose(page, 4)
    box.fill("abc")
    box.press("Enter")
    fault = page.locator('[data-row="4"] .bs-fault:visible')
    assert "“abc” is not a number" in fault.inner_text()
    assert box.input_value() == "abc"
    assert box.get_attribute("aria-invalid") == "true"
    assert drawn(page, 4)[0] == pytest.approx(before[0], abs=0.01)  # the task is as it was
    drag(page, ORIGIN.format(8), 20, 0)  # and another edit does not revert the text
    assert box.input_value() == "abc"
    box.fill("0.5 in")
    box.press("Enter")
    assert fault.count() == 0
    assert pose(page, 4) == (12.7, *before[1:])
    assert drawn(page, 4)[0] == pytest.approx(12.7, abs=0.01)
    turned = field(page, 4, "angle")
    turned.fill("0.2 rad")
    turned.press("Tab")
    assert pose(page, 4)[2] == pytest.approx(math.degrees(0.2), rel=1e-9)


def test_two_clicks_add_a_pose_that_the_second_one_turned(page):
    see_all(page)
    page.locator("[data-do=add-poses]").click()
    page.mouse.click(*on_screen(page, 150, 120))
    page.mouse.move(*on_screen(page, 180, 150), steps=3)
    page.mouse.click(*on_screen(page, 180, 150))
    page.keyboard.press("Escape")
    scale = view(page)["scale"]
    x, y, angle = pose(page, 9)
    assert (x, y) == pytest.approx((150, 120), abs=1 / scale)
    assert same_angle(angle, 45, 2.5)
    page.keyboard.press("Control+z")  # both clicks are one entry
    assert page.locator(".bs-pose-row").count() == 8


def test_rows_are_added_copied_and_put_in_another_order(page):
    page.locator('[data-row="2"] .bs-index').click()
    page.locator("[data-do=duplicate]").click()
    assert pose(page, 3) == pose(page, 2)
    field(page, 3, "x").fill("5")
    field(page, 3, "x").press("Enter")
    third, fourth = pose(page, 3), pose(page, 4)
    page.locator("[data-do=later]").click()
    assert (pose(page, 3), pose(page, 4)) == (fourth, third)
    page.locator("[data-do=delete-pose]").click()
    assert page.locator(".bs-pose-row").count() == 8
    page.locator("[data-do=add-pose-row]").click()
    assert page.locator(".bs-pose-row").count() == 9
    assert page.evaluate("document.activeElement.getAttribute('aria-label')") == "x of pose 9"
    page.keyboard.type("33 mm")
    page.keyboard.press("Enter")
    assert pose(page, 9)[0] == 33


def test_details_of_a_pose_are_those_of_the_task_file(page, visitor):
    page.locator('[data-row="2"] .bs-index').click()
    page.locator("[data-details=pose] [data-key=exact]").check()
    weight = page.locator("[data-details=pose] [data-key=weight]")
    weight.fill("0")
    weight.press("Enter")
    assert "greater than 0" in page.locator("[data-details=pose] .bs-fault:visible").inner_text()
    weight.fill("2.5")
    weight.press("Enter")
    page.locator('[data-row="3"] .bs-index').click()
    page.locator("[data-key=free-angle]").check()
    bound = page.locator("[data-key=tolerance-x]")
    bound.fill("0.3")
    bound.press("Enter")
    name = page.locator('[data-row="3"] .bs-name')
    name.fill("half")
    name.press("Enter")
    document = kept(page)
    assert document["poses"][1]["exact"] is True
    assert document["poses"][1]["weight"] == 2.5
    assert document["poses"][2]["free"] == ["angle"]
    assert document["poses"][2]["tolerance"] == {"x": 0.3}
    assert number(bound.input_value()) == 0.3


def test_text_that_is_no_number_waits_with_its_pose(page):
    page.locator('[data-row="2"] .bs-index').click()
    weight = page.locator("[data-details=pose] [data-key=weight]")
    weight.fill("heavy")
    weight.press("Enter")
    page.locator('[data-row="3"] .bs-index').click()
    assert weight.input_value() == ""
    page.locator('[data-row="2"] .bs-index').click()
    assert weight.input_value() == "heavy"
    assert "not a number" in page.locator("[data-details=pose] .bs-fault:visible").inner_text()
    page.locator("[data-details=pose] [data-key=exact]").check()
    assert kept(page)["poses"][1] == {"x": -3.28, "y": -2.82, "angle": 12, "exact": True}
