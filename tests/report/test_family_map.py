"""The map of a family on the page: what it says and draws of a pair is what was judged."""

import re
from dataclasses import replace

import numpy as np
import pytest

from burmester import Task, synthesize
from burmester.families.pair_verdicts import CLASS_WORDS, PairClass
from burmester.io.cases import load
from burmester.report.page import page as page_of
from burmester.synthesis.family_map import family_map_of
from tests.oracles import browser as browsers

SAMPLES = 120
STEPS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, 1), "ArrowDown": (0, -1)}
CORNER = ["Shift+ArrowDown"] * 12 + ["Shift+ArrowLeft"] * 12
ROUND = ["Shift+ArrowRight"] * 11 + ["Shift+ArrowUp", "ArrowUp"] + ["Shift+ArrowLeft"] * 11
PICKED = """() => [...document.querySelectorAll('.bm-pair-link')].map((link) => {
  const box = link.getBBox(); return Math.hypot(box.width, box.height); })"""


@pytest.fixture(scope="module")
def four(tmp_path_factory):
    task = Task.from_rows(load("ge2012-exact")["poses"][:4], angle_unit="deg", length_unit="mm")
    file = tmp_path_factory.mktemp("family") / "four.html"
    result = synthesize(task)
    text = page_of(result, "four poses")
    assert len(text.encode()) < 1e6
    file.write_text(text, encoding="utf-8")
    return family_map_of(result, samples=SAMPLES), file


def test_each_pair_is_told_and_drawn_by_keyboard(browser, four):
    found, file = four
    with browsers.opened(browser, file) as (page, said, _):
        chart = page.get_by_role("application", name=re.compile("family map", re.IGNORECASE))
        assert chart.count() == 1
        readout = page.locator(".bm-family .bm-readout")
        assert readout.evaluate("node => node.tagName") == "OUTPUT"
        assert chart.get_attribute("aria-describedby") == readout.get_attribute("id")
        shown = page.evaluate("JSON.parse(document.getElementById('data').textContent)")
        i, j = shown["family_map"]["places"][0]  # the cursor starts at the linkage
        chart.focus()
        seen = set()
        for key in [*CORNER, *ROUND * 4]:
            page.keyboard.press(key)
            far, (di, dj) = 10 if "+" in key else 1, STEPS[key.split("+")[-1]]
            i, j = (int(np.clip(k + far * d, 0, SAMPLES - 1)) for k, d in ((i, di), (j, dj)))
            text, kind = readout.text_content(), PairClass(found.verdicts.classes[i, j])
            assert CLASS_WORDS[kind] in text, (i, j)
            seen.add(kind)
            told = re.search(r"angle (\d+)° or more, driven by the (first|second)", text)
            angle = np.degrees(found.verdicts.transmission[i, j])
            assert (told is None) == bool(np.isnan(angle))
            if told:
                assert int(told[1]) == int(angle + 1e-6)
                assert told[2] == ("first", "second")[found.verdicts.driver[i, j]]
            numbers = re.findall(r"fixed pivot \((\S+), (\S+)\)", text)
            pivots = np.array(numbers, dtype=float)
            assert pivots == pytest.approx(found.first.fixed_pivot[[i, j]], abs=0.0051, rel=1e-4)
            # The two links are drawn to one scale.
            radii = found.first.radius[[i, j]]
            drawn = page.evaluate(PICKED)
            assert drawn[0] / drawn[1] == pytest.approx(radii[0] / radii[1], rel=1e-3)
        assert len(seen) >= 4
        assert page.locator(".bm-family .bm-map-cursor").get_attribute("visibility") == "visible"
        page.keyboard.press("Escape")
        assert "Point at the map" in readout.text_content()
        assert said == []


def test_the_square_has_the_colours_of_its_pairs(browser, four):
    found, file = four
    with browsers.opened(browser, file) as (page, _, _asked):
        pixels = np.array(
            page.evaluate("""() => { const c = document.querySelector('.bm-pairs-map canvas');
            return [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data]; }""")
        ).reshape(SAMPLES, SAMPLES, 4)[::-1, :, :3]
    classes = found.verdicts.classes
    tints = {}
    for kind in set(np.unique(classes).tolist()) - {PairClass.WORKS, PairClass.FARTHER}:
        (tint,) = {tuple(each) for each in pixels[kind == classes.T].tolist()}
        tints[kind] = tint
    assert len(set(tints.values())) == len(tints)
    works = classes <= PairClass.FARTHER
    assert works.sum() > 100
    light = pixels[works.T] @ [0.2126, 0.7152, 0.0722]  # lighter throughout as the angle grows
    degrees = np.degrees(found.verdicts.transmission.T[works.T]).astype(int)
    shades = [set(light[degrees == each].tolist()) for each in np.unique(degrees)]
    assert len(shades) > 20
    assert all(len(each) == 1 for each in shades)
    assert (np.diff([each.pop() for each in shades]) > 0).all()


@pytest.mark.parametrize(
    ("width", "scheme"), [(360, "light"), (390, "dark"), (700, "dark"), (1440, "light")]
)
def test_it_fits_every_width_in_both_schemes(browser, four, width, scheme):
    with browsers.opened(browser, four[1], width=width, color_scheme=scheme) as (page, said, _):
        wide = page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
        assert wide[0] <= wide[1]
        for name in (".bm-pairs-map", ".bm-pairs-scene"):
            box = page.locator(name).bounding_box()
            assert box["x"] >= 0
            assert box["x"] + box["width"] <= width
            assert box["width"] > 230
        ends = page.evaluate(
            """() => {
            const box = document.querySelector('.bm-pairs-picture').getBoundingClientRect();
            return [...document.querySelectorAll('.bm-pairs-map text')]
              .map((text) => text.getBoundingClientRect())
              .map((text) => [text.left - box.left, box.right - text.right]); }"""
        )
        assert np.min(ends) > -1  # no tick is cut
        assert said == []


def test_the_plane_of_three_poses_is_told_by_keyboard_and_by_pointer(browser, tmp_path):
    rows = [(0, 0, 0), (30, 40, 25), (70, 55, 50)]
    task = Task.from_rows(rows, angle_unit="deg", length_unit="mm")
    task = replace(task, names=("shut", "half", "open"))
    result = synthesize(task)
    file = tmp_path / "three.html"
    file.write_text(page_of(result, "three poses"), encoding="utf-8")
    found = family_map_of(result, columns=96, rows=72)
    pivots = found.second.fixed_pivot
    with browsers.opened(browser, file) as (page, said, _):
        chart = page.get_by_role("application", name=re.compile("family map", re.IGNORECASE))
        readout = page.locator(".bm-family .bm-readout")

        def agrees():
            text = readout.text_content()
            pattern = r"Fixed pivot \((\S+), (\S+)\), moving pivot \((\S+), (\S+)\)"
            told = np.array(re.search(pattern, text).groups(), dtype=float)
            away = np.linalg.norm(pivots - told[:2], axis=-1)
            j, i = np.unravel_index(away.argmin(), away.shape)
            assert away[j, i] < 0.08  # as printed
            assert told[2:] == pytest.approx(found.second.moving_pivot[j, i], rel=2e-2, abs=0.3)
            kind = PairClass(found.verdicts.classes[j, i])
            assert CLASS_WORDS[kind] in text
            if angle := re.search(r"angle (\d+)° or more, driven by (the other|D\d+)", text):
                assert int(angle[1]) == int(np.degrees(found.verdicts.transmission[j, i]) + 1e-6)
                assert (angle[2] == "the other") == found.verdicts.driver[j, i]
            return i, j

        chart.focus()
        seen = []
        for key in ["ArrowRight", "Shift+ArrowDown", "ArrowLeft", "Shift+ArrowLeft", "ArrowUp"]:
            page.keyboard.press(key)
            seen.append(agrees())
        steps = np.diff(seen, axis=0).tolist()
        assert steps == [[0, -10], [-1, 0], [-10, 0], [0, 1]]
        box = chart.bounding_box()
        for across, down in ((0.1, 0.1), (0.5, 0.3), (0.9, 0.8)):
            page.mouse.move(box["x"] + across * box["width"], box["y"] + down * box["height"])
            i, j = agrees()
            assert abs(i - across * 96) < 1.5
            assert abs(j - (1 - down) * 72) < 1.5
        page.mouse.move(box["x"] - 20, box["y"] - 20)
        assert agrees() == seen[-1]  # back at the cursor
        assert page.locator(".bm-family .bm-pole").count() == 3
        assert "half" in page.locator(".bm-family").text_content()
        assert said == []
