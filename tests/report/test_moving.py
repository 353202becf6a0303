"""What moves on the page: blocks on their rails, the scene that holds them, and what is played."""

import json
import re

import numpy as np
import pytest

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles import browser as browsers

SLIDERS = ["rail", "slot", "rail and slot", "two rails"]

# At shares of what is played: where the body and every block is, and what holds the blocks.
MOVED = """(shares) => shares.map((share) => {
  const slider = document.querySelector(".bm-slider"), low = +slider.min, high = +slider.max;
  slider.value = low + share * (high - low);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  const svg = document.querySelector(".bm-plane"), to = svg.getCTM().inverse();
  const { scale, left, top } = svg.dataset;
  const seen = (node, x = 0, y = 0) => {
    const m = to.multiply(node.getCTM());
    return [m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f];
  };
  const world = ([x, y]) => [(x - left) / scale, (top - y) / scale];
  const line = (node) => {
    // To the end of its first piece, which runs across (H) or to a point (L).
    const [, x, y, to, rest] = node.getAttribute("d").match(/^M(\\S+) ([^HL]+)([HL])([^M]+)/);
    const [u, v] = rest.trim().split(/\\s+/).map(Number);
    return [seen(node, +x, +y), seen(node, u, to === "H" ? +y : v)];
  };
  const stage = document.querySelector(".bm-stage");
  const all = (selector) => [...stage.querySelectorAll(selector)];
  const body = to.multiply(document.querySelector(".bm-plane .bm-coupler").getCTM());
  const frame = svg.viewBox.baseVal;
  return {
    origin: world(seen(document.querySelector(".bm-plane .bm-origin"))),
    turn: Math.atan2(-body.b, body.a),
    scale: +scale,
    blocks: all(".bm-block").map((node) => ({
      dyad: node.dataset.dyad, pixels: seen(node), at: world(seen(node)),
      ends: [seen(node, -node.getBBox().width / 2), seen(node, node.getBBox().width / 2)],
    })),
    rails: all(".bm-rail").map((node) => ({
      dyad: node.dataset.dyad, sides: [...node.children].map(line),
    })),
    slots: all(".bm-slot").map((node) => ({ dyad: node.dataset.dyad, ends: line(node) })),
    pins: all(".bm-linkage .bm-pin").map((node) => ({
      dyad: node.dataset.dyad, fixed: node.classList.contains("bm-fixed-pin"),
      pixels: seen(node, +node.getAttribute("cx"), +node.getAttribute("cy")),
    })),
    size: [frame.width, frame.height],
  };
})"""


def moved(page, count=13):
    return page.evaluate(MOVED, np.linspace(0, 1, count).tolist())


def away(point, ends):
    """The distance of a point from a line, and its place between the ends, from 0 to 1."""
    a, b = np.array(ends, dtype=float)
    along, to = b - a, np.array(point) - a
    length = np.hypot(*along)
    return abs(along[0] * to[1] - along[1] * to[0]) / length, along @ to / length**2


def on_every_way(page, found):
    """Every way of a linkage, between its poses and as a whole."""
    page.click(f"[data-linkage={found.id}]")
    for k in range(page.locator(".bm-ways input").count()):
        page.locator(".bm-ways input").nth(k).check()
        for whole in (False, True):
            if page.locator(".bm-whole input").is_enabled():
                page.locator(".bm-whole input").set_checked(whole)
            yield


@pytest.mark.parametrize("name", SLIDERS)
def test_a_block_is_on_its_rail_or_in_its_slot_all_the_way(browser, report, name):
    result, file = report(name)
    seen = set()
    with browsers.opened(browser, file) as (page, said, _):
        for found in result.linkages[:3]:
            dyads = {each.id: each.dyad for each in found.dyads}
            if all(isinstance(dyad, RR) for dyad in dyads.values()):
                continue
            for _ in on_every_way(page, found):
                for drawn in moved(page):
                    turn = np.exp(1j * drawn["turn"])
                    blocks = {each["dyad"]: each for each in drawn["blocks"]}
                    for rail in drawn["rails"]:
                        block, dyad = blocks[rail["dyad"]], dyads[rail["dyad"]]
                        assert isinstance(dyad, PR)
                        seen.add(PR)
                        pin = complex(*drawn["origin"]) + turn * complex(*dyad.moving_pivot)
                        assert abs(complex(*block["at"]) - pin) * drawn["scale"] < 0.01
                        across = []
                        for side in rail["sides"]:
                            distance, _ = away(block["pixels"], side)
                            across.append(distance)
                            # The whole block, not its centre alone, has the rail beside it.
                            for end in block["ends"]:
                                assert -0.001 < away(end, side)[1] < 1.001
                        assert across == pytest.approx([8, 8], abs=0.01)
                    for slot in drawn["slots"]:
                        block, dyad = blocks[slot["dyad"]], dyads[slot["dyad"]]
                        assert isinstance(dyad, RP)
                        seen.add(RP)
                        pivot = complex(*dyad.fixed_pivot)
                        assert abs(complex(*block["at"]) - pivot) * drawn["scale"] < 0.01
                        for end in block["ends"]:
                            distance, share = away(end, slot["ends"])
                            assert distance < 0.05
                            assert 0 < share < 1
        assert said == []
    assert seen <= {PR, RP}
    assert seen >= {"rail": {PR}, "slot": {RP}, "two rails": {PR}}.get(name, {PR, RP})


@pytest.mark.parametrize("name", ["four-bar", "slot", "apart"])
def test_the_scene_holds_all_pivots(browser, report, name):
    result, file = report(name)
    with browsers.opened(browser, file, width=1100) as (page, _, _asked):
        for found in result.linkages[:3]:
            page.click(f"[data-linkage={found.id}]")
            far = page.locator(".bm-far-pivots input")
            if far.is_visible():
                far.check()
            for _ in on_every_way(page, found):
                for drawn in moved(page, 5):
                    for pin in drawn["pins"]:
                        for at, size in zip(pin["pixels"], drawn["size"], strict=True):
                            assert 5 < at < size - 5, (found.id, pin)
            if far.is_visible():
                far.uncheck()


def test_pivots_far_from_the_poses_are_named_at_the_edge_and_shown_on_request(browser, report):
    result, file = report("hardly turning")
    poses = result.task.poses.translation
    size = np.ptp(poses, axis=0).max()

    def far(dyad):
        away = isinstance(dyad, RR) and np.hypot(*(dyad.fixed_pivot - poses.mean(axis=0)))
        return away > 5 * size

    found = next(each for each in result.linkages if all(far(one.dyad) for one in each.dyads))
    fixed = {each.id: each.dyad.fixed_pivot for each in found.dyads}
    with browsers.opened(browser, file) as (page, said, _):
        page.click(f"[data-linkage={found.id}]")
        texts = page.locator(".bm-far-name").all_text_contents()
        named = {re.match(r"D\d+", text)[0]: text for text in texts}
        assert set(named) == set(fixed)
        for name, text in named.items():
            numbers = [float(each) for each in re.findall(r"-?\d+\.\d+", text)]
            assert numbers == pytest.approx(fixed[name], abs=0.01)
        (drawn,) = moved(page, 1)
        assert drawn["scale"] * size > 150  # the poses can be seen
        page.locator(".bm-far-pivots input").check()
        assert page.locator(".bm-far-name").count() == 0
        for drawn in moved(page, 5):
            for pin in drawn["pins"]:
                assert 5 < pin["pixels"][0] < drawn["size"][0] - 5
                assert 5 < pin["pixels"][1] < drawn["size"][1] - 5
        assert said == []


PLAYED = """() => new Promise((done) => {
  const slider = document.querySelector(".bm-slider"), values = [];
  let looks = 0;
  document.querySelector(".bm-play").click();
  const look = () => {
    const at = +slider.value;
    looks += 1;
    if (values.at(-1) !== at) values.push(at);
    if (values.length > 78 || looks > 400) done(values);
    else requestAnimationFrame(look);
  };
  look();
})"""


@pytest.mark.parametrize("name", ["four-bar", "slot", "rail and slot"])
def test_play_runs_from_the_first_pose_to_the_last_and_back(browser, report, name):
    _, file = report(name)
    shown = json.loads(
        re.search(r'<script type="application/json"[^>]*>(.*?)</script>', file.read_text())[1]
    )["linkages"][0]
    frames = [row["frame"] for row in shown["pose_errors"]]
    first, last = frames[0], frames[-1]
    with browsers.opened(browser, file, before=browsers.QUICK) as (page, said, _):
        values = np.array(page.evaluate(PLAYED))
        assert values[0] == pytest.approx(first, abs=1e-6)
        turn = int(np.abs(values - last).argmin())
        assert values[turn] == pytest.approx(last, abs=1e-6)
        sense = np.sign(last - first)
        assert (sense * np.diff(values[: turn + 1]) > 0).all()
        back = values[turn:]
        end = int(np.abs(back - first).argmin())
        assert (sense * np.diff(back[: end + 1]) < 0).all()
        assert back[end] == pytest.approx(first, abs=1e-6)
        assert values.min() > min(first, last) - 1e-6
        assert values.max() < max(first, last) + 1e-6
        # All poses are on the way, in their order.
        assert (sense * np.diff(frames) > 0).all()
        assert said == []


def test_the_whole_branch_is_played_on_request_and_stays_for_other_cards(browser, report):
    _, file = report("four-bar")
    with browsers.opened(browser, file) as (page, said, _):
        whole, slider = page.locator(".bm-whole input"), page.locator(".bm-slider")

        def ends():
            return [float(slider.get_attribute(name)) for name in ("min", "max")]

        low, high = ends()
        assert low > 0
        whole.focus()
        page.keyboard.press("Space")
        assert whole.is_checked()
        assert page.locator(".bm-play").get_attribute("aria-label") == "Play"
        assert page.locator(".bm-play").inner_text() == "Play"
        every = ends()
        assert every[0] == 0
        assert every[1] > high
        page.click("[data-linkage=L2]")
        assert whole.is_checked()
        assert ends()[0] == 0
        page.click("[data-linkage=L1]")
        assert ends() == every
        whole.uncheck()
        assert ends() == [low, high]
        page.click("[data-linkage=L2]")
        assert not whole.is_checked()
        assert ends()[0] > 0
        assert said == []
