"""What a reader sees first, on screens of any width, and what is there by keyboard and by ear."""

import re

import numpy as np
import pytest

from burmester.dyads.pivot_map import fixed_pivot_map, grid
from burmester.tasks.notation import figure
from burmester.web.pivot_map import pivot_map
from tests.oracles import browser as browsers
from tests.report.tasks import NAMES, TASKS

PHONE = {"width": 390, "height": 844, "has_touch": True}


def boxes(page, *selectors):
    return [page.locator(each).first.bounding_box() for each in selectors]


def test_the_answer_comes_first(browser, report):
    """On the first screen: which linkage, its picture whole, and its dimensions."""
    for name in ("four-bar", "rail and slot"):
        result, file = report(name)
        best = result.linkages[0]
        with browsers.opened(browser, file, width=1400) as (page, _, _asked):
            sentence = page.locator(".bm-outcome").text_content()
            assert re.search(rf"\b{best.id}\b", sentence)
            assert best.type in sentence
            assert not re.search("critical points|faces", sentence)
            head, plane, rows = boxes(page, ".bm-outcome", ".bm-plane", ".bm-dimensions tbody")
            assert head["y"] < plane["y"]
            assert head["y"] < rows["y"]
            assert plane["y"] + 0.9 * plane["height"] < 900
            assert rows["y"] + rows["height"] < 900
            assert f"Dimensions of {best.id}" in page.locator(".bm-dimensions").first.text_content()
            # How it was found is there to unfold, with the code of the outcome.
            assert not page.locator(".bm-found").is_visible()
            page.locator(".bm-about summary").click()
            assert page.locator(".bm-found").is_visible()
            assert result.outcome.code in page.locator(".bm-found").text_content()


def test_on_a_phone_the_answer_comes_before_the_choice(browser, report):
    _, file = report("four-bar")
    with browsers.opened(browser, file, **PHONE) as (page, _, _asked):
        tops = [
            each["y"]
            for each in boxes(
                page, ".bm-outcome", ".bm-plane", ".bm-dimensions", ".bm-list", ".bm-image"
            )
        ]
        assert tops == sorted(tops)
        page.locator("[data-linkage=L2]").tap()
        assert page.locator(".bm-stage-title").text_content().startswith("L2")
        # Who chose comes back to the picture.
        assert -5 < page.locator(".bm-stage").bounding_box()["y"] < 300


@pytest.mark.parametrize("name", list(TASKS))
def test_a_phone_shows_all_of_it_without_gaps(browser, report, name):
    result, file = report(name)
    with browsers.opened(browser, file, **PHONE) as (page, said, _):
        for found in result.linkages[:4]:
            page.evaluate("id => document.querySelector(`[data-linkage=${id}]`).click()", found.id)
            assert page.evaluate("document.documentElement.scrollWidth") <= 390
        # Only what scrolls by itself reaches beyond the screen.
        beyond = page.evaluate(
            """() => [...document.querySelectorAll(".bm *")].filter((node) =>
              !node.closest(".bm-scroll, .bm-choices, svg") && !node.closest("thead") &&
              node.getBoundingClientRect().right > 390.5).map((node) => node.className)"""
        )
        assert beyond == []
        # Cards: none with a gap under it, no row without a value.
        gaps = page.evaluate(
            """() => [...document.querySelectorAll(".bm-choice")].map((card) => {
              const bottom = (node) => node.getBoundingClientRect().bottom;
              const inner = [...card.children].filter((each) => each.offsetHeight);
              const own = bottom(card);
              return [bottom(card.parentElement) - own, own - bottom(inner.at(-1))];
            })"""
        )
        assert max(under for under, _ in gaps) < 25  # the scroll bar of the row
        assert max(within for _, within in gaps) < 45
        values = page.locator(".bm-choice dd").all_text_contents()
        assert all(value.strip() for value in values)
        # Tables: whatever stands in a row stands beside its name, and nothing stands for nothing.
        rows = page.evaluate(
            """() => [...document.querySelectorAll(".bm-stacks tbody td")]
              .filter((cell) => cell.offsetHeight)
              .map((cell) => [cell.dataset.head, cell.textContent.trim(), cell.offsetWidth])"""
        )
        assert rows
        for head, value, width in rows:
            assert head
            assert value not in ("", "–", "-")
            assert width <= 390
        assert said == []


def test_the_pivot_map_can_be_read_by_keyboard(browser, report):
    result, file = report("four-bar")
    task = result.task
    with browsers.opened(browser, file) as (page, said, _):
        shown = page.evaluate("JSON.parse(document.getElementById('data').textContent)")
        drawn = shown["pivot_map"]
        assert drawn == pivot_map(result, shown["scene"])
        places = grid(
            np.array(drawn["low"]), np.array(drawn["high"]), drawn["columns"], drawn["rows"]
        )
        chart = page.get_by_role("application", name=re.compile("pivot map", re.IGNORECASE))
        assert chart.count() == 1
        readout = page.locator(".bm-pivots .bm-readout")
        assert readout.evaluate("node => node.tagName") == "OUTPUT"  # it is told as it changes
        assert chart.get_attribute("aria-describedby") == readout.get_attribute("id")
        chart.focus()
        told = []
        for key in ["ArrowUp", "ArrowRight", "Shift+ArrowLeft", "Shift+ArrowDown", "ArrowDown"] * 2:
            page.keyboard.press(key)
            text = readout.text_content()
            x, y, value = re.search(r"\((\S+), (\S+)\).* by (\S+)", text).groups()
            points = places.reshape(-1, 2)
            nearest = points[np.hypot(*(points - [float(x), float(y)]).T).argmin()]
            assert np.abs(nearest - [float(x), float(y)]).max() < 0.0051  # as printed
            error = fixed_pivot_map(task.poses, nearest, task.weights).rms_error
            # The map holds logarithms to three decimals.
            ends = [figure(float(error) * 10**share) for share in (-6e-4, 0, 6e-4)]
            assert value in ends, (text, nearest)
            told.append((*nearest, value))
        assert len({each[:2] for each in told}) >= 8  # it stops at the edges
        # The first step is one away from the driver's pivot.
        step = np.diff(places.reshape(drawn["rows"], drawn["columns"], 2)[:2, 0, 1])[0]
        pivot = result.linkages[0].driver_first.first.fixed_pivot
        assert np.abs(np.array(told[0][:2]) - pivot).max() < 1.6 * step
        assert page.locator(".bm-map-cursor").get_attribute("visibility") == "visible"
        # Arrows on the map do not move the linkage.
        assert page.locator(".bm-now").text_content().count("at pose 1") == 1
        assert said == []


def test_whatever_takes_the_keyboard_has_a_name(browser, report):
    for name in ("four-bar", "hardly turning"):
        _, file = report(name)
        with browsers.opened(browser, file) as (page, _, _asked):
            nameless = page.evaluate(
                """() => {
                  const name = (node) => node.getAttribute("aria-label")
                    ?? node.labels?.[0]?.textContent ?? node.textContent;
                  const those = "button, input, select, summary, [tabindex]";
                  return [...document.querySelectorAll(those)]
                    .filter((node) => !name(node).trim()).map((node) => node.outerHTML);
                }"""
            )
            assert nameless == []


@pytest.mark.parametrize("width", [1400, 390])
def test_ticks_keep_the_names_of_their_poses(browser, report, width):
    _, file = report("long names")
    with browsers.opened(browser, file, width=width) as (page, _, _asked):
        for card in ("L1", "L2", "L1"):
            page.evaluate("id => document.querySelector(`[data-linkage=${id}]`).click()", card)
            ticks = page.locator(".bm-stops text").all_text_contents()
            assert len(ticks) == len(NAMES)
            by_number = {text.split(":")[0]: text for text in ticks}
            for k, name in enumerate(NAMES, 1):
                text = by_number[str(k)].split(": ")[1]
                assert name.startswith(text.rstrip("…"))
                assert len(text) >= 10 or text == name
            titles = page.locator(".bm-stops title").all_text_contents()
            assert {f"pose {k}: {name}" for k, name in enumerate(NAMES, 1)} == set(titles)
            stems = page.locator(".bm-plots .bm-upright").all_text_contents()
            assert [text.split(":")[0] for text in stems] == [str(k) for k in range(1, 11)]
        assert f"at pose 1: {NAMES[0]}" in page.locator(".bm-now").text_content()
        # None over another.
        overlap = page.evaluate(
            """() => {
              const texts = [...document.querySelectorAll(".bm-stops text")];
              const all = texts.map((node) => node.getBoundingClientRect());
              const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1
                && a.top < b.bottom - 3 && b.top < a.bottom - 3;
              return all.some((a, i) => all.some((b, k) => k < i && meet(a, b)));
            }"""
        )
        assert not overlap


@pytest.mark.parametrize("name", ["hardly turning", "four-bar"])
def test_pivots_that_may_be_moved_are_no_alarm(browser, report, name):
    result, file = report(name)
    free = [found for found in result.linkages if found.usable and not found.determined]
    assert bool(free) == (name == "hardly turning")
    with browsers.opened(browser, file) as (page, _, _asked):
        assert page.locator(".bm-outcome.bm-good").count() == 1
        for found in result.linkages:
            card = page.locator(f"[data-linkage={found.id}]")
            quiet = card.locator(".bm-quiet")
            assert ("bm-good" in card.get_attribute("class")) == found.usable
            assert card.locator(".bm-verdict").text_content()[0] == ("✓" if found.usable else "✕")
            assert bool(quiet.text_content()) == (found in free)
            if found in free:
                assert "pivots" in quiet.text_content()
                widest = max(each.half_width for each in found.uncertainty)
                told = re.search(r"±(\S+) mm", quiet.text_content())
                if told:
                    assert float(told[1]) == pytest.approx(widest, rel=0.05)


def test_the_transmission_angle_that_was_asked_for_is_called_so(browser, report):
    for name, text in (("four-bar", "40°, a usual limit"), ("asked", "20°, asked")):
        _, file = report(name)
        with browsers.opened(browser, file) as (page, _, _asked):
            plots = page.locator(".bm-plots")
            assert plots.locator("text", has_text="°, a").all_text_contents() == [text]
            # The line is at its angle on the axis from 0 to 90.
            heights = {
                at: float(
                    plots.locator(".bm-tick", has_text=re.compile(f"^{at}$")).get_attribute("y")
                )
                for at in (30, 60)
            }
            line = float(
                re.match(r"M\S+ ([\d.]+)", plots.locator(".bm-usual").get_attribute("d"))[1]
            )
            share = (float(text.split("°")[0]) - 30) / 30
            expected = heights[30] + share * (heights[60] - heights[30]) - 4
            assert line == pytest.approx(expected, abs=0.1)
