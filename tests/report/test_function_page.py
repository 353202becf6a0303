"""The page of function generators in a browser: what it says is what a driven loop does."""

import re

import numpy as np
import pytest

import burmester
from burmester.web.function_data import function_report
from tests.oracles import function_loops

PAIRS = [(0, 0), (15, 10), (30, 25), (45, 45), (60, 75)]


@pytest.fixture(scope="module")
def page(browser, tmp_path_factory):
    """The page of five pairs, opened on a narrow screen."""
    found = burmester.synthesize_function(PAIRS, angle_unit="deg")
    path = tmp_path_factory.mktemp("functions") / "pairs.html"
    found.report(path, title="pairs")
    opened = browser.new_page(viewport={"width": 390, "height": 800}, reduced_motion="reduce")
    said = []
    opened.on("console", lambda each: said.append(each.text))
    opened.on("pageerror", lambda each: said.append(str(each)))
    opened.goto(path.as_uri())
    yield opened, found
    assert said == []
    opened.close()


def told(page):
    """The input, the output and the transmission angle that the page tells, in degrees."""
    text = page.locator(".bm-now").inner_text()
    return [
        float(re.search(rf"{name} (-?[\d.]+)°", text)[1])
        for name in ("input", "output", "transmission")
    ]


def test_the_linkage_moves_as_a_driven_loop_does(page):
    opened, found = page
    for id in ("L2", "L1"):
        opened.locator(f"[data-linkage={id}]").click()
        one = found[id].generator
        for share in (0.0, 0.31, 0.77, 1.0):
            opened.evaluate(
                """(share) => {
                  const slider = document.querySelector(".bm-slider");
                  slider.value = +slider.min + share * (slider.max - slider.min);
                  slider.dispatchEvent(new Event("input", { bubbles: true }));
                }""",
                share,
            )
            at, output, transmission = told(opened)
            inputs = np.radians([0.0, at]) if at else np.zeros(1)
            made = np.degrees(function_loops.outputs(one, inputs))[-1]
            if id == "L2" and share == 1.0:
                continue  # it is on another branch there
            assert abs((made - output + 180) % 360 - 180) < 0.02
            theta, phi = np.radians(at) + one.input_phase, np.radians(output) + one.output_phase
            pin = one.input_link * np.exp(1j * theta)
            other = 1 + one.output_link * np.exp(1j * phi)
            angle = np.degrees(np.angle((other - pin) / (other - 1))) % 180
            assert min(angle, 180 - angle) == pytest.approx(transmission, abs=0.1)


def test_pairs_stand_in_a_table_and_are_gone_to(page):
    opened, _ = page
    opened.locator("[data-linkage=L1]").click()
    opened.locator(".bm-next").click()
    assert told(opened)[:2] == [15.0, 10.0]
    assert opened.locator(".bm-now").inner_text().endswith("at pair 2")
    assert opened.locator(".bm-pair-table .bm-current th").inner_text() == "2"
    rows = opened.locator(".bm-pair-table tbody tr")
    assert rows.count() == 5
    assert rows.nth(4).inner_text().split() == ["5", "60°", "75°", "75.0000°", "exact"]
    assert opened.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_a_page_of_a_function_holds_its_structural_error():
    found = burmester.synthesize_function("sin(x)", (0, 1.5), input_deg=90, output_deg=90, pairs=4)
    data = function_report(found.synthesis)
    for each, known in zip(data["linkages"], found.generators, strict=False):
        panel = each["panels"][1]
        error = np.array(panel["y"], dtype=float)
        assert np.nanmax(np.abs(error)) == pytest.approx(np.degrees(known.max_error), rel=1e-9)
        inputs = np.radians(panel["x"])[:200]
        made = np.degrees(function_loops.outputs(known.generator, inputs))
        wanted = 90 * np.sin(inputs * 1.5 / np.radians(90)) / np.sin(1.5)
        off = made - wanted - error[:200]
        assert np.abs((off + 180) % 360 - 180).max() < 1e-6
        names = [pose["name"] for pose in each["picture"]["poses"]]
        assert names == ["start", "1", "2", "3", "4", "end"]
