"""What shows answers: cards, the linkage in the plane, play, charts, comparison, tables."""

import json
import math
import random
import re
import subprocess
import sys

import numpy as np
import pytest

from burmester import read_task, synthesize
from burmester.fourbar.instantaneous import instant_centre
from burmester.geometry.displacement import Displacement
from tests.oracles.browser import idle
from tests.oracles.studio_page import (
    answered,
    drag,
    middle,
    on_screen,
    open_tab,
    place_of,
    solved,
    studio_page,
    view,
)

# A leg that folds up: its dyads turn far, so that rounded poses hardly move them.
FIVE = {
    "name": "leg.csv",
    "mimeType": "text/csv",
    "buffer": b"x_mm,y_mm,angle_deg\n"
    b"0,0,0\n41.9,-30.2,20\n45.9,-21.0,45\n23.8,-34.9,70\n-1.1,-62.1,90\n",
}
FIXED = '.bs-pivot[data-pivot="{}"][data-plane="F"]'
MOVING = '.bs-pivot[data-pivot="{}"][data-plane="M"]'


@pytest.fixture(scope="module")
def task(visitor, start, tmp_path_factory):
    """The file of the task on which the page opens."""
    path = tmp_path_factory.mktemp("task") / "lid.toml"
    sent = {"document": start["document"], "options": start["options"], "name": "lid"}
    answer = visitor.http.post("/task", json=sent)
    assert answer.status_code == 200, answer.text
    path.write_bytes(answer.content)
    return path


@pytest.fixture(scope="module")
def result(task):
    """What the command says of that task."""
    command = [sys.executable, "-m", "burmester", "synthesize", str(task), "--json"]
    ran = subprocess.run(command, capture_output=True, check=False, timeout=120)
    return json.loads(ran.stdout)


@pytest.fixture(scope="module")
def shared(browser, visitor):
    """A page for tests that leave it as it is."""
    with studio_page(browser, visitor) as found:
        yield found
        assert found.wrong == []


def card(page, name):
    return page.locator(f'[data-linkage="{name}"]')


def figure(page, name, key):
    return card(page, name).locator(f'[data-figure="{key}"]').inner_text()


def body(page):
    """The origin of M in F, and its angle in degrees, as they are drawn."""
    found = page.locator(".bs-mechanism .bm-coupler").get_attribute("transform")
    x, y, turn = map(
        float, re.fullmatch(r"translate\((\S+) (\S+)\) rotate\((\S+)\)", found).groups()
    )
    at = view(page)
    return (x - at["left"]) / at["scale"], (at["top"] - y) / at["scale"], -turn


def apart(page, *selectors):
    """Whether two elements do not cover each other."""
    one, other = (page.locator(each).bounding_box() for each in selectors)
    sides = (("x", "width"), ("y", "height"))
    return any(
        a[at] + a[size] <= b[at] for a, b in ((one, other), (other, one)) for at, size in sides
    )


def led(found):
    """The dyads of a linkage of the command's result, by their ids."""
    return {each["id"]: each for each in found["dyads"]}


def test_cards_say_what_the_command_says(shared, result):
    names = shared.locator("[data-linkage]").evaluate_all("all => all.map(e => e.dataset.linkage)")
    assert names == [each["id"] for each in result["linkages"]]
    poses = result["task"]["poses"]
    sides = [np.ptp([each[key] for each in poses]) for key in "xy"]
    span = max(math.hypot(*sides), result["length_per_radian"])
    for each in result["linkages"]:
        text = card(shared, each["id"]).inner_text()
        assert each["type"] in text
        assert ("✓ usable" if each["usable"] else "✕ not usable") in text
        worst = each["position_error"]["max"]
        assert float(figure(shared, each["id"], "worst").split()[0]) == pytest.approx(
            worst, rel=0.051
        )
        least = each["min_transmission_angle_deg"]["range"]
        said = re.search(r"[\d.]+", figure(shared, each["id"], "least"))[0]
        assert float(said) == pytest.approx(math.floor(10 * (least or 0)) / 10, abs=0.051)
        size = float(figure(shared, each["id"], "size").split()[0])
        assert size == pytest.approx(each["quality"]["extent"] * span, rel=0.051)
        moved = float(re.search(r"moves it (\S+)", figure(shared, each["id"], "sensitivity"))[1])
        assert moved == pytest.approx(0.1 * each["quality"]["sensitivity"], rel=0.051)  # by 0.1 mm
        for defect in [*each["defects"], *each["unmet"]]:
            if defect["kind"] in ("circuit", "branch"):
                assert defect["message"] in text
        assert ("What would help" in text) == (not each["usable"])


def test_the_linkage_is_drawn_where_its_numbers_say(shared, result):
    for found in result["linkages"][:3]:
        card(shared, found["id"]).locator("button").first.click()
        shared.locator(".bm-back").click()  # some pose: the linkage stands still
        x, y, angle = body(shared)
        turn = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
        for name, dyad in led(found).items():
            at = place_of(shared, FIXED.format(name))
            assert at == pytest.approx(dyad["fixed_pivot"], abs=1e-3)
            pin = shared.locator(f'.bs-mechanism .bm-fixed-pin[data-dyad="{name}"]')
            own = view(shared)
            drawn = [float(pin.get_attribute(key)) for key in ("cx", "cy")]
            assert (drawn[0] - own["left"]) / own["scale"] == pytest.approx(at[0], abs=1e-3)
            assert (own["top"] - drawn[1]) / own["scale"] == pytest.approx(at[1], abs=1e-3)
            pin = complex(x, y) + turn * complex(*dyad["moving_pivot"])
            assert place_of(shared, MOVING.format(name)) == pytest.approx(
                (pin.real, pin.imag), abs=2e-3
            )
            assert abs(pin - complex(*at)) == pytest.approx(dyad["radius"], abs=5e-3)
    card(shared, "L1").locator("button").first.click()


def test_steps_from_pose_to_pose_go_where_the_linkage_takes_the_body(shared, result):
    card(shared, "L1").locator("button").first.click()
    coupler = result["linkages"][0]["coupler"]
    count = len(coupler)
    seen = set()
    for _ in range(count):
        shared.locator(".bm-next").click()
        x, y, angle = body(shared)
        away = [math.hypot(x - each["x"], y - each["y"]) for each in coupler]
        pose = int(np.argmin(away))
        assert away[pose] < 1e-3
        assert abs(math.remainder(angle - coupler[pose]["angle_deg"], 360)) < 1e-3
        assert apart(shared, ".bs-mechanism .bm-letter", f".bs-pose-name >> nth={pose}")
        seen.add(pose)
    assert seen == set(range(count))


@pytest.mark.parametrize("driver", [0, 1])
def test_either_dyad_drives_and_the_readout_is_its_input(shared, result, driver):
    card(shared, "L1").locator("button").first.click()
    choices = open_tab(shared, "motion").locator(".bs-drivers input")
    choices.nth(driver).check()
    name = choices.nth(driver).get_attribute("data-driver")
    dyad = led(result["linkages"][0])[name]
    slider = shared.locator(".bs-player .bm-slider")
    slider.focus()
    for key in ("Home", "ArrowRight", "Shift+ArrowRight"):
        shared.keyboard.press(key)
        x, y = place_of(shared, MOVING.format(name))
        cx, cy = dyad["fixed_pivot"]
        wanted = math.degrees(math.atan2(y - cy, x - cx))
        said = float(re.match(r"driver (\S+)°", shared.locator(".bm-now").inner_text())[1])
        assert abs(math.remainder(said - wanted, 360)) < 0.11
    # The best linkage meets all poses with either driver, or says which lock it.
    drive = result["linkages"][0]["drives"]
    first = result["linkages"][0]["dyads"][0]["id"] == name
    defects = drive["first" if first else "second"]["defects"]
    note = shared.locator(".bs-driver-note").inner_text()
    assert note.startswith(f"Driven by {name}: ")
    assert all(each["message"] in note for each in defects)
    choices.nth(0).check()


def test_playing_moves_and_is_not_read_aloud(shared):
    card(shared, "L1").locator("button").first.click()
    shared.locator(".bm-play").click()
    assert shared.locator(".bm-now").get_attribute("aria-live") == "off"
    first = body(shared)
    shared.wait_for_function(
        "first => document.querySelector('.bs-mechanism .bm-coupler').getAttribute('transform')"
        " !== first",
        arg=shared.locator(".bs-mechanism .bm-coupler").get_attribute("transform"),
    )
    shared.locator(".bm-play").click()
    assert shared.locator(".bm-now").get_attribute("aria-live") == "polite"
    assert body(shared) != first
    shared.locator("h1").first.click()
    shared.keyboard.press(" ")
    assert shared.locator(".bm-play").get_attribute("aria-label") == "Pause"
    shared.keyboard.press(" ")
    assert shared.locator(".bm-play").get_attribute("aria-label") == "Play"
    assert shared.locator(".bm-play").inner_text() == "Play"


def test_the_instant_centre_is_where_the_body_turns(shared, task):
    card(shared, "L1").locator("button").first.click()
    open_tab(shared, "motion").locator("[data-tool=centrodes]").check()
    shared.locator(".bm-next").click()
    x, y, angle = body(shared)
    found = synthesize(read_task(str(task))).linkages[0]
    wanted = instant_centre(found.driver_first, Displacement([x, y], math.radians(angle)))
    drawn = place_of(shared, ".bs-instant-centre")
    size = np.abs(wanted).max() + 100
    assert drawn == pytest.approx(tuple(wanted), abs=2e-4 * size)
    # The moving centrode touches the fixed one there: both are drawn through that point.
    for name in (".bs-fixed-centrode", ".bs-moving-centrode"):
        near = shared.locator(name).evaluate(
            """(path, [x, y]) => {
              const to = path.ownerSVGElement.getCTM().inverse().multiply(path.getCTM());
              let least = Infinity;
              const length = path.getTotalLength();
              for (let k = 0; k <= 4000; k += 1) {
                const p = path.getPointAtLength((k / 4000) * length).matrixTransform(to);
                least = Math.min(least, Math.hypot(p.x - x, p.y - y));
              }
              return least;
            }""",
            [
                view(shared)["left"] + view(shared)["scale"] * drawn[0],
                view(shared)["top"] - view(shared)["scale"] * drawn[1],
            ],
        )
        assert near < 3
    shared.locator("[data-tool=centrodes]").uncheck()


def test_a_picked_point_draws_its_curve_and_goes_along(shared, result):
    card(shared, "L1").locator("button").first.click()
    shared.locator(".bm-next").click()
    open_tab(shared, "motion").locator("[data-tool=coupler-point]").click()
    x, y, angle = body(shared)
    at = (x + 30, y + 60)
    shared.mouse.click(*on_screen(shared, *at))
    shared.keyboard.press("Escape")
    assert shared.locator("[data-tool=coupler-point]").get_attribute("aria-pressed") == "false"
    point = shared.locator('[data-point="1"]')
    assert place_of(shared, '[data-point="1"]') == pytest.approx(at, abs=1 / view(shared)["scale"])
    back = complex(30, 60) * complex(math.cos(math.radians(angle)), -math.sin(math.radians(angle)))
    said = re.search(r"\((\S+), (\S+)\)", shared.locator(".bs-points li").inner_text())
    own = complex(float(said[1]), float(said[2]))
    assert abs(own - back) < 1.5 / view(shared)["scale"]
    for _ in range(3):
        shared.locator(".bm-next").click()
        x, y, angle = body(shared)
        turn = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
        seen = complex(x, y) + turn * own
        assert place_of(shared, '[data-point="1"]') == pytest.approx(
            (seen.real, seen.imag), abs=0.02
        )
    point.focus()
    shared.keyboard.press("Delete")
    assert shared.locator("[data-point]").count() == 0


def test_two_linkages_are_compared_at_the_same_pose(shared, result):
    card(shared, "L1").locator("button").first.click()
    shared.get_by_role("button", name="Next pose").click()
    for name in ("L1", "L2"):
        card(shared, name).get_by_text("Pin").click()
    shared.locator(".bs-compare").scroll_into_view_if_needed()
    shared.wait_for_selector(".bs-compare .bm-coupler")
    idle(shared, 100)
    places = shared.evaluate(
        """() => [...document.querySelectorAll(".bs-compare .bm-portrait")].map((svg) => {
          const found = svg.querySelector(".bm-portrait-now .bm-coupler").getAttribute("transform");
          const [x, y] = found.match(/-?[\\d.]+/g).map(Number);
          const { scale, left, top } = svg.dataset;
          return [(x - left) / scale, (top - y) / scale];
        })"""
    )
    one, other = (each["coupler"] for each in result["linkages"][:2])
    away = [math.hypot(places[0][0] - p["x"], places[0][1] - p["y"]) for p in one]
    pose = int(np.argmin(away))
    assert away[pose] < 0.01
    assert places[1] == pytest.approx([other[pose]["x"], other[pose]["y"]], abs=0.01)
    rows = shared.locator(".bs-compared tbody tr").all_inner_texts()
    worst = next(row for row in rows if row.startswith("misses by")).split("\t")[1:]
    for text, each in zip(worst, result["linkages"], strict=False):
        assert float(text.split()[0]) == pytest.approx(each["position_error"]["max"], rel=0.051)
    shared.get_by_text("End the comparison").click()
    assert shared.locator(".bs-compare").is_hidden()


def test_cards_are_sorted_filtered_and_pinned(shared, result):
    def names():
        return shared.locator("[data-linkage]").evaluate_all(
            "all => all.map(e => e.dataset.linkage)"
        )

    shared.locator("[data-choice=order]").select_option("size")
    extents = {each["id"]: each["quality"]["extent"] for each in result["linkages"]}
    assert names() == sorted(extents, key=extents.get)
    shared.locator("[data-choice=order]").select_option("worst")
    worst = {each["id"]: each["position_error"]["max"] for each in result["linkages"]}
    assert names() == sorted(worst, key=worst.get)
    status = shared.locator(".bs-results-status")
    assert "not shown" not in status.inner_text()
    shared.locator("[data-chip=usable]").click()
    assert names() == [each["id"] for each in result["linkages"] if each["usable"]]
    hidden = sum(not each["usable"] for each in result["linkages"])
    assert status.inner_text().startswith(f"{hidden} not shown by the filter. ")
    shared.locator("[data-chip=all]").click()
    assert "not shown" not in status.inner_text()
    last = names()[-1]
    card(shared, last).get_by_text("Pin").click()
    assert names()[0] == last
    card(shared, last).get_by_text("Pinned").click()
    shared.locator("[data-choice=order]").select_option("rank")
    assert names() == [each["id"] for each in result["linkages"]]
    shared.locator('[data-linkage="L1"] button').first.focus()
    shared.keyboard.press("ArrowDown")
    shared.keyboard.press("Enter")
    assert card(shared, "L2").locator("button").first.get_attribute("aria-pressed") == "true"
    card(shared, "L1").locator("button").first.click()


KEYS = """() => [...document.querySelectorAll("[data-linkage]")].map((card) => {
  card.key ??= (window.keys = (window.keys ?? 0) + 1);
  return [card.key, card.dataset.linkage, card.textContent];
})"""


def numbers(linkage):
    """Pivots and lengths of a linkage, in an order that does not depend on the driver."""
    return sorted(
        [*each.get("fixed_pivot", ()), *each.get("moving_pivot", ()), each.get("radius", 0.0)]
        for each in linkage["led"]
    )


def test_a_card_keeps_its_linkage_or_says_so(browser, visitor):
    """After each drag the linkage of a card is where the last followed frame had it."""
    rng, kept = random.Random(1), 0
    heard = {"followed": None, "solved": None, "count": 0}

    def received(payload):
        if isinstance(payload, bytes):
            length = int.from_bytes(payload[:4], "little")
            heard["followed"] = json.loads(payload[4 : 4 + length])
        elif (message := json.loads(payload))["kind"] == "solved":
            heard["solved"] = message["result"]
            heard["count"] += 1

    with studio_page(browser, visitor) as page:
        page.on("websocket", lambda socket: socket.on("framereceived", received))
        page.reload()
        page.wait_for_selector("[data-linkage]")
        solved(page)
        # Five poses have a few dyads that meet them all: most linkages go on.
        page.locator("input[type=file]").first.set_input_files(FIVE)
        page.wait_for_function("() => document.querySelectorAll('[data-row]').length === 5")
        solved(page)
        for _ in range(6):
            shown = {key: name for key, name, _ in page.evaluate(KEYS)}
            heard["followed"], heard["count"] = None, 0
            pose = f'.bs-origin[data-pose="{rng.randint(1, 5)}"]'
            drag(page, pose, rng.uniform(5, 9), rng.uniform(-6, 6), steps=5)
            solved(page)
            if heard["count"] != 1:
                continue  # the hand was slow, and ids changed on the way
            followed = {each["id"]: each for each in heard["followed"]["linkages"]}
            new = {each["id"]: each for each in heard["solved"]["linkages"]}
            for key, name, text in page.evaluate(KEYS):
                if key not in shown:
                    assert "new" in text
                elif shown[key] not in followed:
                    assert re.search(r"gone|new", text)
                else:
                    assert name == shown[key] or f"was {shown[key]}" in text
                    if followed[shown[key]]["fresh"]:
                        before, after = numbers(followed[shown[key]]), numbers(new[name])
                        assert np.concatenate(after) == pytest.approx(
                            np.concatenate(before), rel=2e-3, abs=0.1
                        )
                        kept += 1
        assert page.wrong == []
    assert kept >= 2


def test_while_a_pose_is_dragged_the_linkage_and_its_space_go_along(page, result):
    card(page, "L1").locator("button").first.click()
    x, y = middle(page, '.bs-origin[data-pose="4"]')
    first = place_of(page, FIXED.format("D1"))
    page.evaluate("withhold('solve')")
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 13):
        page.mouse.move(x + 0.5 * k, y - 0.5 * k)
        page.wait_for_timeout(30)
    page.wait_for_function(
        "() => document.querySelector('[data-linkage=L1]').classList.contains('bs-old')"
    )
    answered(page)
    # The pivots moved, and the drawing is that of one linkage still.
    at = {name: place_of(page, FIXED.format(name)) for name in led(result["linkages"][0])}
    assert at["D1"] != first
    x, y, angle = body(page)
    turn = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    pins = [complex(*place_of(page, MOVING.format(name))) for name in at]
    apart = abs(np.subtract(*[(pin - complex(x, y)) / turn for pin in pins]))
    dyads = led(result["linkages"][0]).values()
    own = [complex(*each["moving_pivot"]) for each in dyads]
    assert apart == pytest.approx(abs(own[0] - own[1]), rel=0.2)
    # Size and sensitivity are known to the whole search alone: they are grey.
    opacity = (
        card(page, "L1")
        .locator('[data-figure="size"]')
        .evaluate("e => getComputedStyle(e).opacity")
    )
    assert float(opacity) < 0.6
    page.mouse.up()
    page.evaluate("withhold(null)")
    solved(page)
    assert "bs-old" not in card(page, "L1").get_attribute("class")
    page.locator("[data-do=undo]").click()
    solved(page)


POINTS = """() => [...document.querySelectorAll("[data-panel=space] .bm-image-point")]
  .map((e) => [Number(e.getAttribute("cx")), Number(e.getAttribute("cy"))])"""


def test_image_space_goes_along_with_a_pose_and_turns(browser, visitor):
    with studio_page(browser, visitor) as page:
        open_tab(page, "space")
        page.wait_for_function("() => document.querySelectorAll('.bm-image-point').length === 8")
        start = np.array(page.evaluate(POINTS))
        x, y = middle(page, '.bs-origin[data-pose="8"]')
        page.mouse.move(x, y)
        page.mouse.down()
        for k in range(1, 9):
            page.mouse.move(x + 2 * k, y + k)
            page.wait_for_timeout(20)
        page.wait_for_function(
            "(was) => Math.hypot("
            "  +document.querySelectorAll('.bm-image-point')[7].getAttribute('cx') - was[0],"
            "  +document.querySelectorAll('.bm-image-point')[7].getAttribute('cy') - was[1]) > 1",
            arg=start[7].tolist(),
        )
        page.keyboard.press("Escape")
        solved(page)
        idle(page, 400)  # the picture is built anew when nothing has changed for a while
        box = page.locator("[data-panel=space] .bm-space")
        before = np.array(page.evaluate(POINTS))
        size = box.bounding_box()
        page.mouse.move(size["x"] + size["width"] / 2, size["y"] + size["height"] / 2)
        page.mouse.down()
        page.mouse.move(size["x"] + size["width"] / 2 + 60, size["y"] + size["height"] / 2, steps=4)
        page.mouse.up()
        idle(page, 100)
        turned = np.array(page.evaluate(POINTS))
        assert np.hypot(*(turned - before).T).max() > 20
        box.focus()
        page.keyboard.press("0")
        idle(page, 100)
        assert np.array(page.evaluate(POINTS)) == pytest.approx(before, abs=0.01)
        assert page.wrong == []


def test_every_drawn_number_is_in_a_table(shared, result):
    card(shared, "L1").locator("button").first.click()
    open_tab(shared, "facts")
    shared.wait_for_selector(".bs-facts table")
    idle(shared, 100)
    text = shared.locator(".bs-facts").inner_text()
    for dyad in result["linkages"][0]["dyads"]:
        x, y = dyad["fixed_pivot"]
        found = [(float(a), float(b)) for a, b in re.findall(r"\((-?[\d.]+), (-?[\d.]+)\)", text)]
        assert any(math.hypot(a - x, b - y) < 0.01 for a, b in found)
    assert "instant centre" in text
    for each in result["linkages"]:
        assert each["id"] in text
    assert shared.locator(".bs-facts caption").count() >= 5
