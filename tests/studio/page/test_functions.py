"""Functions of angles in the studio: typed, solved, dragged on the curve, and exported."""

from pathlib import Path

import numpy as np
import pytest

from burmester.io.reading.functions.function_file import read_function
from burmester.io.saved import read_result
from burmester.synthesis.function_generation import generate_function
from tests.oracles.browser import at_rest
from tests.oracles.studio_page import answered, choose


def taken(page, name):
    """The file that the page hands over: a format of its list, or the task."""
    with page.expect_download() as file:
        if name == "task":
            page.locator("[data-do=save-function]").click()
        else:
            page.locator("[data-do=export-function]").select_option(name)
    return Path(file.value.path())


def typed(page, key, text):
    page.locator(f".bs-function [data-key={key}]").fill(text)
    page.keyboard.press("Enter")
    page.wait_for_timeout(300)  # it rests before it looks
    answered(page)


def test_a_function_is_typed_and_a_pair_dragged_on_its_curve(page):
    choose(page, "task", "data-do=function")
    typed(page, "expression", "sin(x)")
    typed(page, "x", "0:pi/2")
    typed(page, "input_deg", "90 deg")
    saved = read_result(taken(page, "result")).synthesis
    assert saved.task.function.x == pytest.approx((0, np.pi / 2), abs=1e-15)
    direct = generate_function(saved.task).generators
    for one, other in zip(saved.generators, direct, strict=True):
        assert one.max_error == pytest.approx(other.max_error, rel=1e-9)
    cards = page.locator(".bs-function .bm-choice")
    assert cards.count() == len(direct)
    # A dot of the curve is pulled up: the output of its pair grows by as much as its axis says.
    dot = page.locator('.bs-function [data-panel="0"][data-dot="2"]')
    dot.scroll_into_view_if_needed()
    box, degrees = at_rest(dot), float(dot.get_attribute("data-of-pixel"))
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - 3, steps=3)
    page.mouse.up()
    page.wait_for_function("() => unanswered.size === 0")
    task = read_function(taken(page, "task").read_bytes(), "function.toml")
    moved = np.degrees(task.outputs - saved.task.outputs)
    assert moved == pytest.approx([0, 0, 3 * degrees, 0, 0], abs=0.02)
    typed_rows = page.locator("[data-key=cells]")
    typed_rows.fill("0,0\n30;20")
    typed_rows.blur()
    fault = page.locator(".bs-function-form [role=alert]")
    fault.filter(has_text="row 2").wait_for()
    page.wrong.clear()  # of what the server refused
    # A linkage that exists is judged in place of a search, and what is exported is its coupler.
    page.get_by_text("Judge a linkage that exists").click()
    typed(page, "links", "1, 2.2, 0.7, 2")
    lengths = read_result(taken(page, "result")).synthesis.generators[0].lengths
    assert [*lengths.values()] == pytest.approx([1, 2.2, 0.7, 2], rel=1e-12)
    assert b"<svg" in taken(page, "svg").read_bytes()
