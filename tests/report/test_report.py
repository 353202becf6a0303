"""The report, opened in a browser as its readers open it, and checked against other sources.

What is drawn is read back from the page as the browser places it, and compared with the synthesis,
with linkages driven joint by joint (`tests/oracles/witness.py`) and with the bare constraints
(`tests/oracles/tracer.py`).
"""

import json
import re
import time
from dataclasses import replace

import numpy as np
import pytest

from burmester import Limits, Point, Task, synthesize
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.report.page import as_script
from burmester.report.page import page as page_of
from burmester.synthesis.result import Synthesis
from burmester.web import data as report_data_module
from burmester.web.branches import Branches
from burmester.web.data import report_data
from tests.oracles import browser as browsers
from tests.oracles import tracer, witness

TABLE_2 = [
    (-0.8253, -1.0329, 91.91),
    (-1.6554, -0.2721, 66.99),
    (-2.6392, 0.2920, 49.90),
    (-3.5027, 0.3088, 43.94),
    (-4.0549, -0.2141, 45.58),
    (-4.1022, -1.0521, 52.87),
    (-3.5805, -1.8708, 64.52),
    (-2.6250, -2.3408, 78.84),
    (-1.5557, -2.2742, 93.02),
    (-0.8016, -1.7382, 101.25),
]

# The points of the drawing, as the browser places them, in the task's plane.
DRAWN = """() => {
  const svg = document.querySelector(".bm-plane");
  const { scale, left, top } = svg.dataset;
  const to = svg.getCTM().inverse();
  const world = (node) => {
    const m = to.multiply(node.getCTM());
    const x = +(node.getAttribute("cx") ?? 0), y = +(node.getAttribute("cy") ?? 0);
    return [(m.a * x + m.c * y + m.e - left) / scale, (top - (m.b * x + m.d * y + m.f)) / scale];
  };
  const stage = document.querySelector(".bm-stage");
  const all = (selector) => [...stage.querySelectorAll(selector)].map((node) => ({
    dyad: node.dataset.dyad, at: world(node),
  }));
  const body = to.multiply(document.querySelector(".bm-plane .bm-coupler").getCTM());
  return {
    fixed: all(".bm-fixed-pin"), moving: all(".bm-coupler .bm-pin"),
    origin: world(document.querySelector(".bm-plane .bm-origin")),
    turn: Math.atan2(-body.b, body.a),
    said: document.querySelector(".bm-now").textContent, scale: +scale,
  };
}"""

# The same after each of some pushes of a button or places of the slider.
MANY_DRAWN = f"""([what, shares]) => shares.map((share) => {{
  const slider = document.querySelector(".bm-slider");
  if (what === "next") document.querySelector(".bm-next").click();
  else {{
    document.querySelector(".bm-whole input:not(:checked)")?.click();
    slider.value = share * slider.max;
    slider.dispatchEvent(new Event("input", {{ bubbles: true }}));
  }}
  return ({DRAWN})();
}})"""

PIXELS = """() => {
  const from = document.querySelector(".bm-space canvas");
  const canvas = document.createElement("canvas");
  canvas.width = 150;
  canvas.height = 120;
  const context = canvas.getContext("2d");
  context.drawImage(from, 0, 0, canvas.width, canvas.height);
  const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
  return { drawn: from.dataset.drawn, pixels: [...data] };
}"""


@pytest.fixture(scope="module")
def synthesis() -> Synthesis:
    poses = np.array(TABLE_2)
    known = Displacement(poses[:, :2], np.radians(poses[:, 2]))
    return synthesize(Task(known, resolution=(5e-5, np.radians(5e-3)), length_unit="mm"))


@pytest.fixture(scope="module")
def file(synthesis, tmp_path_factory):
    path = tmp_path_factory.mktemp("report") / "report.html"
    path.write_text(page_of(synthesis, "Ten poses"), encoding="utf-8")
    return path


def embedded(file):
    text = file.read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json"[^>]*>(.*?)</script>', text)[1])


def places_of(way):
    return np.column_stack([way["x"], way["y"], way["angle"]])


def witnessed(linkage, drive):
    """The body's places (x + iy) on both assemblies, by the witness, at drives (n,)."""
    if isinstance(linkage.first, RP):
        phi = drive - linkage.first.normal_angle
        return witness.turned(linkage.first, linkage.second, phi)
    return witness.places(linkage.first, linkage.second, drive)[0]


# ------------------------------------------------------------------------------------ the data


def test_every_frame_is_on_the_linkage_and_the_driver_is_where_it_says(synthesis, file):
    data = embedded(file)
    assert len(data["linkages"]) == len(synthesis.linkages) > 8
    kinds = set()
    for found, shown in zip(synthesis.linkages, data["linkages"], strict=True):
        led = found.driver_first
        kinds |= {type(led.first), type(led.second)}
        assert shown["ways"], found.id
        for way in shown["ways"]:
            at = places_of(way)
            for dyad in (led.first, led.second):
                miss, _ = tracer.constraint(dyad, at)
                assert np.abs(miss).max() < 1e-9, (found.id, way["circuit"])
            drive = np.array(way["drive"])
            assert (np.diff(drive) > 0).all()
            if not isinstance(led.first, PR):
                drive = np.radians(drive)
            both = witnessed(led, drive)
            away = np.fmin.reduce(np.abs(both - (at[:, 0] + 1j * at[:, 1])), axis=0)
            # Where a branch ends both assemblies meet, and the witness may see none.
            inner = slice(2, -2)
            assert (away[inner] < 1e-6).all(), (found.id, way["circuit"])
    assert kinds == {RR, PR, RP}


def test_branches_end_at_dead_points_and_do_not_jump(synthesis, file):
    data, seen = embedded(file), 0
    for found, shown in zip(synthesis.linkages, data["linkages"], strict=True):
        for way in shown["ways"]:
            at = places_of(way)
            step = np.linalg.norm(np.diff(at, axis=0), axis=1)
            assert step.max() < 0.05 * np.ptp(at, axis=0).max() + 0.06, found.id
            for end, dead in zip((0, -1), way["dead"], strict=True):
                if dead:
                    seen += 1
                    assert way["transmission"][end] < 1e-3
                    # The driver cannot go on: beyond, the witness finds no place to close.
                    drive = np.array([way["drive"][end] + (1e-3 if end else -1e-3)])
                    if not isinstance(found.driver_first.first, PR):
                        drive = np.radians(drive)
                    assert np.isnan(witnessed(found.driver_first, drive).real).all()
            if way["round"]:
                assert abs(way["drive"][-1] - way["drive"][0] - 360) < 1e-6
                gap = tracer.gap(at[-1:].copy(), at[:1])
                assert np.abs(gap).max() < 1e-9
    assert seen >= 8


def test_transmission_angles_are_those_between_the_links(synthesis, file):
    data = embedded(file)
    found, shown = synthesis.linkages[0], data["linkages"][0]
    one, other = found.driver_first.first, found.driver_first.second
    for way in shown["ways"]:
        at = places_of(way)
        turn = np.exp(1j * at[:, 2])
        pins = [at[:, 0] + 1j * at[:, 1] + turn * (d.moving_pivot @ [1, 1j]) for d in (one, other)]
        coupler, follower = pins[1] - pins[0], pins[1] - other.fixed_pivot @ [1, 1j]
        angle = np.degrees(np.abs(np.angle(coupler / follower)))
        angle = np.minimum(angle, 180 - angle)
        assert np.abs(angle - way["transmission"]).max() < 1e-3


def test_surfaces_hold_the_places_that_their_dyads_allow(synthesis, file):
    data, rng = embedded(file), np.random.default_rng(7)
    chart = data["chart"]
    for found, shown in zip(synthesis.linkages, data["linkages"], strict=True):
        space = shown["space"]
        for dyad, matrix in zip(
            (found.driver_first.first, found.driver_first.second), space["quadrics"], strict=True
        ):
            phi = chart["angle"] + rng.uniform(-1.5, 1.5, 50)
            turn, free = np.exp(1j * phi), rng.uniform(-3, 3, 50)
            if isinstance(dyad, RR):
                pin = dyad.fixed_pivot @ [1, 1j] + dyad.radius * np.exp(1j * free)
                d = pin - turn * (dyad.moving_pivot @ [1, 1j])
            elif isinstance(dyad, PR):
                pin = (dyad.offset + 1j * free) * np.exp(1j * dyad.normal_angle)
                d = pin - turn * (dyad.moving_pivot @ [1, 1j])
            else:
                on = (dyad.offset + 1j * free) * np.exp(1j * dyad.normal_angle)
                d = dyad.fixed_pivot @ [1, 1j] - turn * on
            values = []
            for off in (0.0, 0.05):
                # The paper's Eq. (2), in the report's frames.
                w = (d + off * (1 + 1j) - complex(*chart["origin"])) / chart["length"]
                half = (phi - chart["angle"]) / 2
                t = np.tan(half)
                z = np.stack([(w.real * t - w.imag) / 2, (w.real + w.imag * t) / 2, t], axis=-1)
                q = (z - space["centre"]) / space["half"]
                q = np.column_stack([q, np.ones(len(q))])
                c = np.reshape(matrix, (4, 4))
                values.append(np.einsum("ni,ij,nj->n", q, c, q) / (q * q).sum(axis=1))
            assert np.abs(values[0]).max() < 1e-12
            assert np.median(np.abs(values[1])) > 1e-5


def test_the_dyad_that_drives_is_the_better_one(synthesis):
    found = synthesis.linkages[0]
    other = replace(found, preferred_driver="second")
    data = report_data(replace(synthesis, linkages=(other,)))["linkages"][0]
    assert [dyad["id"] for dyad in data["led"]] == [dyad.id for dyad in found.dyads[::-1]]
    assert data["ways"]
    driver = found.linkage.second
    for way in data["ways"]:
        at = places_of(way)
        pin = at[:, 0] + 1j * at[:, 1] + np.exp(1j * at[:, 2]) * (driver.moving_pivot @ [1, 1j])
        arm = (pin - driver.fixed_pivot @ [1, 1j]) / driver.radius
        assert np.abs(arm - np.exp(1j * np.radians(way["drive"]))).max() < 1e-6
        assert not way["round"]  # a rocker


def test_poses_are_given_the_errors_that_were_found(synthesis, file):
    data = embedded(file)
    for found, shown in zip(synthesis.linkages, data["linkages"], strict=True):
        for pose, row in enumerate(shown["pose_errors"]):
            way = shown["ways"][row["way"]]
            assert pose + 1 in way["poses"]
            i = min(int(row["frame"]), len(way["x"]) - 2)
            # The pose's place lies between the two frames beside it.
            ends = [np.array([way["x"][k], way["y"][k]]) for k in (i, i + 1)]
            place = found.error.places.translation[pose]
            span = np.linalg.norm(ends[1] - ends[0])
            assert np.linalg.norm(place - ends[0]) <= 1.05 * span + 1e-9
            assert np.linalg.norm(place - ends[1]) <= 1.05 * span + 1e-9
            wanted = np.array(TABLE_2[pose][:2])
            assert row["position"] == pytest.approx(np.linalg.norm(place - wanted), abs=1e-12)


def test_strings_cannot_leave_their_script():
    held = {"</script><script>alert(1)</script>": ["<!--", "&amp;", "\u2028", "é"]}
    text = as_script(held)
    assert json.loads(text) == held
    assert not set("<>&\u2028") & set(text)


def test_size_and_time(synthesis):
    start = time.process_time()
    text = page_of(synthesis, "Ten poses")
    assert len(text.encode()) < 3e6
    assert time.process_time() - start < 2
    assert report_data(synthesis)["schema"] == "burmester.report/2"


# ---------------------------------------------------------------------------------- the page


def test_it_opens_in_silence_and_asks_for_nothing(browser, file):
    with browsers.opened(browser, file, reduced_motion="no-preference") as (page, said, asked):
        assert page.title() == "Ten poses"
        assert page.locator(".bm-play").get_attribute("aria-label") == "Pause"  # it shows itself
        before = page.evaluate(DRAWN)["turn"]
        page.wait_for_function(
            "text => document.querySelector('.bm-now').textContent !== text",
            arg=page.locator(".bm-now").text_content(),
        )
        assert page.evaluate(DRAWN)["turn"] != before
        # Nothing else may be asked for, whoever asks.
        refused = page.evaluate("fetch('https://example.org/').then(() => 'came', () => 'refused')")
        assert refused == "refused"
        assert all("example.org" in line for line in said)
        assert [each for each in asked if "example.org" not in each] == [file.as_uri()]
    with browsers.opened(browser, file) as (page, said, asked):
        assert page.locator(".bm-play").get_attribute("aria-label") == "Play"  # reduced motion
        assert page.locator(".bm-play").inner_text() == "Play"
        page.locator(".bm-play").click()
        browsers.idle(page, 200)
        assert (said, asked) == ([], [file.as_uri()])


def test_another_card_changes_the_drawing_to_its_numbers(browser, file, synthesis):
    with browsers.opened(browser, file) as (page, said, _):
        page.click("[data-linkage=L2]")
        assert page.locator(".bm-choice[aria-pressed=true]").get_attribute("data-linkage") == "L2"
        every = page.evaluate(
            f"""() => [...document.querySelectorAll(".bm-choice")].map((card) => {{
              card.click();
              const facts = document.querySelector(".bm-facts").textContent;
              return {{ ...({DRAWN})(), card: card.textContent, id: card.dataset.linkage, facts }};
            }})"""
        )
        seen = set()
        for found, drawn in zip(synthesis.linkages, every, strict=True):
            led = found.driver_first
            assert drawn["id"] == found.id
            pins = {each["dyad"]: each["at"] for each in drawn["fixed"]}
            seen.add(json.dumps(pins))
            first, second = found.dyads if found.preferred_driver == "first" else found.dyads[::-1]
            for one, dyad in ((first, led.first), (second, led.second)):
                if isinstance(dyad, PR):
                    assert one.id not in pins
                else:
                    assert pins[one.id] == pytest.approx(dyad.fixed_pivot, abs=1e-5)
            word = "usable" if found.usable else "not usable"
            assert f"{'✓' if found.usable else '✕'} {word}" in drawn["card"]
            if led.links is not None:
                assert f"driver link{led.links.driver:.1f}"[:14] in drawn["facts"]
        assert len(seen) == len(synthesis.linkages)
        assert said == []


def test_at_every_pose_the_body_is_within_the_reported_error(browser, file, synthesis):
    with browsers.opened(browser, file) as (page, _, _asked):
        for found in (synthesis.linkages[k] for k in (0, 1, 2, 5, 6)):
            page.click(f"[data-linkage={found.id}]")
            visited, led = [], found.driver_first
            for drawn in page.evaluate(MANY_DRAWN, ["next", [0] * len(TABLE_2)]):
                pose = int(re.search(r"at pose (\d+)", drawn["said"])[1]) - 1
                visited.append(pose)
                away = np.array(drawn["origin"]) - TABLE_2[pose][:2]
                assert np.hypot(*away) <= found.error.position[pose] + 2e-6
                turn = drawn["turn"] - np.radians(TABLE_2[pose][2])
                turn = abs((turn + np.pi) % (2 * np.pi) - np.pi)
                assert turn <= found.error.angle[pose] + 2e-6
                # Driven joint by joint to where the driver is drawn, the body comes there, too.
                drive = driver_of(led, drawn)
                if drive is not None:
                    both = witnessed(led, np.array([drive]))[:, 0]
                    assert np.nanmin(np.abs(both - complex(*drawn["origin"]))) < 1e-4
            assert sorted(visited) == list(range(len(TABLE_2)))


def driver_of(led, drawn):
    """The driver's angle, from what is drawn; None for slides."""
    if isinstance(led.first, RP):
        return drawn["turn"] + led.first.normal_angle
    if isinstance(led.first, PR):
        return None
    pins = [np.array(each["at"]) for each in drawn["moving"]]
    arms = [pin - led.first.fixed_pivot for pin in pins]
    arm = min(arms, key=lambda arm: abs(np.hypot(*arm) - led.first.radius))
    return np.arctan2(arm[1], arm[0])


def test_scrubbing_keeps_links_and_assembly(browser, tmp_path, monkeypatch, synthesis):
    """On every assembly of a crank-rocker and of linkages with dead points, all along it.

    With so few frames that what lies between them would miss the linkage, were it not put on it.
    """
    monkeypatch.setattr("burmester.web.data.FRAMES", 0)
    monkeypatch.setattr("burmester.web.data.LEAST_FRAMES", 25)
    file = tmp_path / "few.html"
    file.write_text(page_of(synthesis, "Few frames"), encoding="utf-8")
    with browsers.opened(browser, file) as (page, _, _asked):
        for found in (synthesis.linkages[k] for k in (0, 6, 7)):
            page.click(f"[data-linkage={found.id}]")
            led, sides = found.driver_first, []
            assemblies = page.locator(".bm-ways input")
            assert assemblies.count() == 2
            for which in range(2):
                assemblies.nth(which).check()
                side = set()
                shares = np.linspace(0.004, 0.996, 41).tolist()
                for drawn in page.evaluate(MANY_DRAWN, ["scrub", shares]):
                    at = np.array([[*drawn["origin"], drawn["turn"]]])
                    for dyad in (led.first, led.second):
                        assert abs(tracer.constraint(dyad, at)[0][0]) < 2e-6
                    both = witnessed(led, np.array([driver_of(led, drawn)]))[:, 0]
                    away = np.abs(both - complex(*drawn["origin"]))
                    assert away.min() < 1e-3
                    if away.max() > 1e-2:
                        side.add(int(away.argmin()))
                assert len(side) == 1, found.id
                sides.append(side)
            assert sides[0] != sides[1]


def test_it_plays_smoothly(browser, file, record_property):
    """What a frame costs; how many there are a second depends on who else uses the machine."""
    timed = """(() => {
      const own = window.requestAnimationFrame;
      window.costs = [];
      window.requestAnimationFrame = (what) => own.call(window, (now) => {
        const start = performance.now();
        what(now);
        window.costs.push(performance.now() - start);
      });
    })();"""
    with browsers.opened(browser, file, before=timed) as (page, said, _):
        page.click(".bm-play")
        browsers.idle(page, 200)
        frames, seconds = page.evaluate(
            """() => new Promise((done) => {
              window.costs.length = 0;
              const start = performance.now();
              const look = () => {
                const seconds = (performance.now() - start) / 1000, frames = window.costs.length;
                if ((seconds >= 1 && frames > 5) || seconds > 60) done([frames, seconds]);
                else setTimeout(look, 50);
              };
              look();
            })"""
        )
        costs = page.evaluate("window.costs")
        record_property("frames_per_second", round(frames / seconds, 1))
        print(f"{frames / seconds:.0f} frames a second, {np.median(costs):.2f} ms of script each")
        assert frames > 5
        page.click(".bm-play")
        rest = page.evaluate(DRAWN)
        browsers.idle(page, 100)
        assert page.evaluate(DRAWN) == rest
        assert said == []


def test_playing_turns_back_at_a_dead_point(browser, file, synthesis):
    found = synthesis.linkages[6]
    assert any(defect.kind == "branch" for defect in found.defects)
    with browsers.opened(browser, file) as (page, _, _asked):
        page.click(f"[data-linkage={found.id}]")
        slider, plane = page.locator(".bm-slider"), page.locator(".bm-plane")
        page.locator(".bm-whole input").check()
        last = float(slider.get_attribute("max"))
        page.evaluate(
            """(u) => {
              const slider = document.querySelector(".bm-slider");
              slider.value = u;
              slider.dispatchEvent(new Event("input", { bubbles: true }));
            }""",
            last - 8,
        )
        plane.focus()
        # The page looks from before it plays on: a slow machine might miss the end otherwise.
        page.evaluate(
            """() => {
              const slider = document.querySelector(".bm-slider"), values = [];
              const look = (done) => {
                values.push(+slider.value);
                const back = values.at(-1) < values[0] - 5;
                if (back || values.length > 400) done(values);
                else requestAnimationFrame(() => look(done));
              };
              window.played = new Promise(look);
            }"""
        )
        page.keyboard.press("Space")
        values = page.evaluate("() => window.played")
        assert max(values) > last - 2 or max(values) == last
        assert values[-1] < values[0] - 5  # it came back
        assert np.abs(np.diff(values)).max() < 0.1 * last  # and did not leap
        assert page.locator(".bm-ways input:checked").count() == 1


def test_all_of_it_by_keyboard(browser, file, synthesis):
    with browsers.opened(browser, file) as (page, said, _):
        where = "document.activeElement.className.baseVal ?? document.activeElement.className"
        reached = []
        for _ in range(60):
            page.keyboard.press("Tab")
            reached.append(page.evaluate(where) or page.evaluate("document.activeElement.tagName"))
            style = page.evaluate(
                """() => {
                  const own = document.activeElement, held = own.closest(".bm-ways label");
                  return getComputedStyle(held ?? own).outlineStyle;
                }"""
            )
            if page.evaluate("document.activeElement !== document.body"):
                assert style != "none", reached[-1]
            if page.evaluate("document.activeElement === document.body"):
                break
        text = " ".join(reached)
        for name in ("bm-choice", "bm-play", "bm-next", "bm-slider", "bm-plane", "bm-space"):
            assert name in text
        # Cards: arrows go from one to the other, Enter chooses.
        page.locator("[data-linkage=L1]").focus()
        page.keyboard.press("ArrowDown")
        page.keyboard.press("Enter")
        assert page.locator(".bm-stage-title").text_content().startswith("L2: ")
        assert page.evaluate("document.activeElement.dataset.linkage") == "L2"
        # The drawing: arrows move the driver, space plays and stops.
        plane = page.locator(".bm-plane")
        plane.focus()
        before = page.evaluate(DRAWN)["turn"]
        page.keyboard.press("ArrowRight")
        after = page.evaluate(DRAWN)["turn"]
        page.keyboard.press("ArrowLeft")
        assert after != pytest.approx(before, abs=1e-4)
        assert page.evaluate(DRAWN)["turn"] == pytest.approx(before, abs=1e-4)
        page.keyboard.press("Space")
        assert page.locator(".bm-play").get_attribute("aria-label") == "Pause"
        page.keyboard.press("Space")
        assert page.locator(".bm-play").get_attribute("aria-label") == "Play"
        # The slider says the driver's angle.
        page.locator(".bm-slider").focus()
        page.keyboard.press("ArrowRight")
        assert "°" in page.locator(".bm-slider").get_attribute("aria-valuetext")
        # Image space turns.
        page.locator(".bm-space").focus()
        corner = "document.querySelector('.bm-box').getAttribute('d')"
        before = page.evaluate(corner)
        page.keyboard.press("ArrowLeft")
        page.wait_for_function(f"before => {corner} !== before", arg=before)
        assert said == []


def test_light_and_dark_can_be_read(browser, file):
    """WCAG's contrast of all text colours with what is behind them, in both schemes."""
    names = ["ink", "muted", "driver", "follower", "error", "good", "bad"]
    seen = {}
    for scheme in ("light", "dark"):
        with browsers.opened(browser, file, color_scheme=scheme) as (page, _, _asked):
            style = page.evaluate(
                """(names) => {
                  const style = getComputedStyle(document.querySelector(".bm"));
                  const of = (name) => style.getPropertyValue("--bm-" + name).trim();
                  return Object.fromEntries(names.map((name) => [name, of(name)]));
                }""",
                [*names, "panel", "bg", "wash"],
            )
        seen[scheme] = style
        for name in names:
            for behind in ("panel", "bg", "wash"):
                assert contrast(style[name], style[behind]) > 4.5, (scheme, name, behind)
    assert luminance(seen["dark"]["bg"]) < 0.05
    assert luminance(seen["light"]["bg"]) > 0.8


def luminance(colour):
    rgb = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("width", [360, 700, 1000, 2000])
def test_it_fits_every_width(browser, file, width):
    with browsers.opened(browser, file, width=width) as (page, _, _asked):
        wide = page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
        assert wide[0] <= wide[1]
        for name in (".bm-plane", ".bm-space", ".bm-map", ".bm-plots"):
            box = page.locator(name).bounding_box()
            assert box["x"] >= 0
            assert box["x"] + box["width"] <= width
            assert box["width"] > 230
        drawn = page.evaluate(DRAWN)
        assert drawn["scale"] > 20


def test_the_picture_without_webgl_is_the_picture_with_it(browser, file):
    """Two programs, one in the shading language, draw the same surfaces."""
    none = """HTMLCanvasElement.prototype.getContext = ((own) => function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : own.call(this, kind, ...rest);
    })(HTMLCanvasElement.prototype.getContext);"""
    # The page does not know that this machine's WebGL is software.
    any_renderer = "WebGL2RenderingContext.prototype.getExtension = () => null;"
    pictures = {}
    for kind, before in (("still", none), ("webgl", any_renderer)):
        with browsers.opened(browser, file, before=before, width=700) as (page, said, _):
            browsers.idle(page, 300)
            if kind == "still":
                assert "still picture" in page.locator(".bm-image").first.text_content()
                assert said == []
            drawn = page.evaluate(PIXELS)
            if kind == "webgl" and drawn["drawn"] != "webgl":
                pytest.skip("this browser's WebGL gave up")
            assert drawn["drawn"] == kind
            pictures[kind] = np.reshape(drawn["pixels"], (120, 150, 4)) / 255
    still, webgl = pictures["still"], pictures["webgl"]
    filled = still[..., 3] > 0.3
    assert 0.15 < filled.mean() < 0.8
    assert (filled == (webgl[..., 3] > 0.3)).mean() > 0.97
    both = filled & (webgl[..., 3] > 0.3)
    away = np.abs(still - webgl)[both][:, :3].mean(axis=-1)
    assert np.median(away) < 0.05


def test_image_points_are_where_a_camera_sees_them(browser, file):
    """A pinhole looks at the middle of the box, from 4.6 halves of its edge away."""
    data = embedded(file)
    chart, space = data["chart"], data["linkages"][0]["space"]
    poses = np.array(TABLE_2)
    d = (poses[:, :2] - chart["origin"]) / chart["length"]
    z = Displacement(d, np.radians(poses[:, 2]) - chart["angle"]).as_image_point()
    q = (z[:, :3] / z[:, 3:] - space["centre"]) / space["half"]
    with browsers.opened(browser, file) as (page, _, _asked):
        seen = page.evaluate(
            """() => [...document.querySelectorAll(".bm-image-point")].map(
              (node) => [+node.getAttribute("cx"), +node.getAttribute("cy")])"""
        )
        box = page.evaluate(
            "document.querySelector('.bm-space svg').getAttribute('viewBox').split(' ').map(Number)"
        )
    around, above = -0.62, 0.38
    eye = -4.6 * np.array(
        [-np.cos(above) * np.sin(around), np.cos(above) * np.cos(around), -np.sin(above)]
    )
    ahead = -eye / 4.6
    right = np.cross(ahead, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    to = q - eye
    flat = np.column_stack([to @ right, -(to @ up)]) / (to @ ahead)[:, None]
    expected = flat * (min(box[2:]) / 2 * 2.3 * 1.02) + np.array(box[2:]) / 2
    assert np.abs(np.array(seen) - expected).max() < 1e-3


def test_paper_has_all_numbers(browser, file, synthesis):
    with browsers.opened(browser, file) as (page, said, _):
        slider, said_of_it = page.locator(".bm-slider"), page.locator(".bm-now")
        slider.evaluate(
            "node => (node.value = 0.98 * node.max, node.dispatchEvent(new Event('input')))"
        )
        between = slider.input_value()
        assert " from pose" in said_of_it.text_content()
        page.emulate_media(media="print")
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        assert f"at pose {len(synthesis.task.poses.angle)}, off by" in said_of_it.text_content()
        for name in (".bm-list", ".bm-play", ".bm-slider"):
            assert not page.locator(name).is_visible()
        tables = page.locator(".bm-every-one table")
        assert tables.count() == len(synthesis.linkages)
        for k, found in enumerate(synthesis.linkages):
            table = tables.nth(k)
            assert table.is_visible()
            assert f"Dimensions of {found.id}," in table.text_content()
            rows = page.locator(".bm-linkages tbody tr").nth(k)
            assert rows.is_visible()
            assert found.type in rows.text_content()
        page.evaluate("dispatchEvent(new Event('afterprint'))")
        assert slider.input_value() == between
        document = page.pdf()
        assert document.startswith(b"%PDF")
        assert said == []


CIRCLE = np.linspace(0, 1.2, 7)
OTHERS = {
    "R303": lambda: Task.from_rows(
        [(0, 0, 0), (12, 5, 20), (20, 14, 45), (24, 25, 70)],
        angle_unit="deg",
        length_unit="mm",
        limits=(Limits(fixed_pivot=Point(np.array([30.0, -9.0]))), Limits()),
    ),
    "R312": lambda: Task(
        Displacement(np.stack([10 * CIRCLE, 5 * CIRCLE], axis=-1), np.full(7, 0.3)),
        names=tuple(f"</script><b>pose {k}" for k in range(7)),
    ),
    "R313": lambda: Task(
        Displacement(10 * np.stack([np.cos(CIRCLE), np.sin(CIRCLE)], axis=-1), np.full(7, 0.3))
    ),
    "R310": lambda: Task(Displacement(np.zeros((5, 2)), np.zeros(5))),
    "R316": lambda: Task(
        Displacement(np.stack([30 * np.cos(CIRCLE), 12 * np.sin(CIRCLE)], axis=-1), CIRCLE)
    ),
}


@pytest.mark.parametrize("code", list(OTHERS))
def test_a_page_for_every_outcome(browser, tmp_path, code):
    result = synthesize(OTHERS[code]())
    assert result.outcome.code == code
    path = tmp_path / "report.html"
    path.write_text(page_of(result, f"{code} </title><b>"), encoding="utf-8")
    with browsers.opened(browser, path) as (page, said, asked):
        assert page.title() == f"{code} </title><b>"
        sentence = page.locator(".bm-head").text_content()
        assert result.outcome.message[1:] in sentence
        assert code in sentence
        assert page.locator(".bm-choice").count() == len(result.linkages)
        assert page.locator(".bm-plane .bm-wanted").count() == len(result.task.poses.angle)
        rows = page.locator(".bm-pose-table tbody tr")
        assert rows.count() == len(result.task.poses.angle)
        if result.task.names:
            assert result.task.names[0] in rows.first.text_content()
        if result.linkages:
            page.click(".bm-play")
            browsers.idle(page, 100)
        assert page.locator("main b", has_text="pose 1").count() == 0
        assert (said, asked) == ([], [path.as_uri()])


def test_a_linkage_that_cannot_be_driven_is_told_and_not_drawn_moving(
    browser, tmp_path, monkeypatch, synthesis
):
    still = Branches([], [None] * len(TABLE_2))
    own = report_data_module.branches_of
    monkeypatch.setattr(
        report_data_module,
        "branches_of",
        lambda found, *rest: still if found.id == "L2" else own(found, *rest),
    )
    path = tmp_path / "still.html"
    path.write_text(page_of(synthesis, "Still"), encoding="utf-8")
    with browsers.opened(browser, path) as (page, said, _):
        page.click(".bm-play")
        page.click("[data-linkage=L2]")
        assert "cannot be shown moving" in page.locator(".bm-stage").text_content()
        assert page.locator(".bm-play").is_disabled()
        assert page.locator(".bm-plane .bm-coupler").count() == 0
        assert page.locator(".bm-runner").get_attribute("visibility") == "hidden"
        page.click("[data-linkage=L1]")
        assert page.locator(".bm-play").is_enabled()
        assert page.locator(".bm-plane .bm-coupler").count() == 1
        assert said == []
