"""The page as a whole: what it asks for, shows as text, and says when things end."""

import json
import signal
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from burmester.io import templates
from tests.oracles.browser import idle
from tests.oracles.studio import killed, served
from tests.oracles.studio_page import (
    choose,
    drag,
    drawn,
    drop,
    field,
    has_poses,
    kept,
    paste,
    pose,
    solved,
    studio_page,
)

NAMES = [
    "<img src=x onerror=alert(1)>",
    '=HYPERLINK("http://evil.example")',
    "two words",
    "&amp;<b>bold</b>",
]


# Of what can be reached, all that has no name of any kind.
UNNAMED = """() => {
  const reached = "button, input, select, summary, [tabindex='0'], [role]";
  const nameOf = (node) => [
    node.getAttribute("aria-label"), node.title, node.labels?.[0]?.textContent,
    node.textContent, node.querySelector("title")?.textContent,
  ].join("").trim();
  return [...document.querySelectorAll(reached)]
    .filter((node) => node.checkVisibility() && node.getAttribute("aria-hidden") !== "true")
    .filter((node) => node.getAttribute("role") !== "status" && !nameOf(node))
    .map((node) => node.outerHTML.slice(0, 200));
}"""


# Of the names of poses: which cover a handle or another name, and which stand nearer to another
# pose than to their own.  `letters` are the pixels that a box of text is wider than its letters.
CROWDED = """(letters) => {
  const boxOf = (node) => node.getBoundingClientRect();
  const named = (of) => [...document.querySelectorAll(of)].map((node) => {
    const { left, top, right, bottom } = boxOf(node);
    return { text: node.textContent, left, right, top: top + letters, bottom: bottom - letters };
  });
  const names = named(".bs-pose-name"), limits = named(".bs-limit-name:not([visibility=hidden])");
  const origins = [...document.querySelectorAll(".bs-origin .bs-dot")].map(boxOf);
  const tips = [...document.querySelectorAll(".bs-turn .bs-tip")].map(boxOf);
  const meet = (a, b) =>
    a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  const away = (box, dot) => {
    const x = (dot.left + dot.right) / 2, y = (dot.top + dot.bottom) / 2;
    return Math.hypot(
      Math.max(box.left - x, 0, x - box.right), Math.max(box.top - y, 0, y - box.bottom));
  };
  return names.filter((name, k) =>
    [...origins, ...tips].some((dot) => meet(name, dot)) ||
    [...names, ...limits].some((other) => other !== name && meet(name, other)) ||
    origins.some((dot) => away(name, dot) < away(name, origins[k]) - 1)
  ).map(({ text }) => text);
}"""


@pytest.mark.parametrize("size", [(1400, 900), (390, 844)])
def test_names_of_crowded_poses_stand_beside_their_own(browser, visitor, size):
    with studio_page(browser, visitor, width=size[0], height=size[1]) as page:
        drop(page, "lid-hinge.toml", templates.text("lid-hinge"))
        has_poses(page, 8)
        solved(page)
        idle(page, 300)  # names are placed when the picture has come to rest
        assert page.locator(".bs-pose-name").count() == 8
        assert page.evaluate(CROWDED, 4) == []
        assert page.wrong == []


def test_w9_names_are_shown_as_text_everywhere(page):
    poses = [
        {"x": 10 * k, "y": k * k, "angle": 15 * k, "name": name} for k, name in enumerate(NAMES)
    ]
    task = {
        "length_unit": "mm",
        "angle_unit": "deg",
        "poses": poses,
        "body": [[0, 0], [5, 0], [0, 5]],
        "keep_out": [{"name": NAMES[0], "box": [[200, 200], [210, 210]]}],
    }
    drop(page, "<i>odd</i> name.json", json.dumps(task))
    has_poses(page, 4)
    solved(page)
    page.locator('[data-row="1"] .bs-index').click()
    assert page.locator("#studio img, #studio b b, #studio i, #studio a[href^=http]").count() == 0
    shown = page.locator(".bs-name").evaluate_all("all => all.map((each) => each.value)")
    assert shown == NAMES
    assert NAMES[0] in page.locator(".bs-pose-title").inner_text()
    labels = page.locator(".bs-pose-name").all_text_contents()
    assert labels[0] == "<img src=x onerro…"
    assert page.locator(".bs-task-name").input_value() == "<i>odd</i> name"
    # Typing elsewhere in the row leaves the name alone.
    x = field(page, 4, "x")
    x.fill("31")
    x.press("Enter")
    assert kept(page)["poses"][3]["x"] == 31
    assert [each["name"] for each in kept(page)["poses"]] == NAMES
    # A mark that turns the direction stays in its own name: what stands before it is where it was.
    before = page.locator("[data-details=pose] h3").bounding_box()
    name = page.locator('[data-row="4"] .bs-name')
    name.fill("\u202eabc")
    name.press("Enter")
    title = page.locator(".bs-pose-title")
    assert title.inner_text() == "Pose 4: \u202eabc"
    assert title.locator("bdi").inner_text() == "\u202eabc"
    assert title.bounding_box()["x"] == before["x"]
    assert page.locator(".bs-pose-name").nth(3).text_content() == "\u202eabc"


def test_on_paper_stands_what_was_stated_and_every_number(page):
    """What is folded of the task says nothing; what is folded of the answers is unfolded."""
    limits, facts = page.locator("[data-section=limits]"), page.locator("[data-panel=facts] table")
    asked, compared = page.locator("[data-section=requirements]"), page.locator(".bs-compare")
    assert limits.is_visible()
    assert not facts.first.is_visible()
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert asked.is_visible()
    assert not limits.is_visible()
    assert facts.first.is_visible()
    assert not compared.is_visible()  # nothing is compared
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    page.emulate_media(media="screen")
    assert limits.is_visible()
    assert not facts.first.is_visible()
    for name in ("L1", "L2"):
        page.locator(f'[data-linkage="{name}"]').get_by_text("Pin").click()
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert page.locator(".bs-compare .bm-portrait-now .bm-coupler").count() == 2
    for each in page.locator(".bs-compare .bm-portrait").all():  # as wide and high as it is drawn
        box = each.bounding_box()
        width, height = map(float, each.get_attribute("viewBox").split()[2:])
        assert box["width"] / box["height"] == pytest.approx(width / height, rel=0.02)


def test_w15_a_reload_in_mid_solve_loses_nothing(page):
    drag(page, '.bs-origin[data-pose="8"]', 14, -9)
    moved = pose(page, 8)
    page.reload()
    page.wait_for_selector("html[data-ready]")
    assert pose(page, 8) == moved
    solved(page)
    page.evaluate("location.assign('about:blank')")
    page.wait_for_url("about:blank")
    page.go_back()
    page.wait_for_selector("html[data-ready]")
    assert pose(page, 8) == moved


def test_w15_two_tabs_have_two_tasks(page, visitor):
    drag(page, '.bs-origin[data-pose="8"]', 14, -9)
    moved = pose(page, 8)
    other = page.context.new_page()
    other.goto(f"{visitor.base}/")
    other.wait_for_selector("html[data-ready]")
    before = pose(other, 8)
    assert before != moved
    drag(other, '.bs-origin[data-pose="8"]', -20, -9)
    page.bring_to_front()
    assert pose(page, 8) == moved
    for each in (page, other):
        mine = pose(each, 8)
        each.reload()
        each.wait_for_selector("html[data-ready]")
        assert pose(each, 8) == mine


def test_w15_when_the_server_ends_nothing_is_lost_and_a_banner_says_how_to_go_on(browser, tmp_path):
    with served(home=tmp_path) as first, studio_page(browser, first) as page:
        drag(page, '.bs-origin[data-pose="8"]', 14, -9)
        solved(page)
        kept(page)
        moved = pose(page, 8)
        first.process.send_signal(signal.SIGTERM)
        first.process.wait(120)
        banner = page.locator("[data-banner=offline]")
        banner.wait_for()
        assert "Nothing is lost" in banner.inner_text()
        field(page, 1, "x").fill("1.5")  # it is edited all the same
        field(page, 1, "x").press("Enter")
        assert drawn(page, 1)[0] == pytest.approx(1.5, abs=0.01)
        with page.expect_download() as saved:
            page.locator("[data-do=save-json]").click()
        task = json.loads(saved.value.path().read_text(encoding="utf-8"))
        assert tuple(task["poses"][7][key] for key in ("x", "y", "angle")) == moved
        assert task["poses"][0]["x"] == 1.5
        with served("--port", str(first.port), home=tmp_path) as second:
            page.locator("[data-banner=expired]").wait_for()
            other = page.context.new_page()
            other.goto(second.address())  # in another tab: this one goes on, too
            page.bring_to_front()
            page.wait_for_function("() => !document.querySelector('[data-banner=expired]')")
            page.evaluate("to => location.hash = to", second.address().partition("#")[2])
            page.wait_for_function("() => location.hash === ''")
            idle(page, 300)
            solved(page)
            assert pose(page, 8) == moved


def told(page, address):
    """What a page says that is not let in."""
    page.goto(address)
    return page.locator(".bs-failed[role=alert]").inner_text()


def test_an_address_opens_one_browser_which_keeps_its_key_to_itself(browser, visitor):
    """It is loaded again and in other tabs; no other server of this machine is sent anything."""
    address = visitor.address()
    with studio_page(browser, visitor) as page:
        page.goto(address)
        page.wait_for_selector("html[data-ready]")
        assert page.url == f"{visitor.base}/"
        page.reload()
        page.wait_for_selector("html[data-ready]")
        for again in (address, visitor.base):
            tab = page.context.new_page()
            tab.goto(again)
            tab.wait_for_selector("html[data-ready]")
            assert tab.url == f"{visitor.base}/"
        assert page.context.cookies() == []
        with listener() as (port, heard):
            tab.goto(f"http://127.0.0.1:{port}/")
            assert tab.evaluate("[document.cookie, localStorage.length]") == ["", 0]
        assert heard
        assert all(visitor.key not in each for each in heard)
    other = browser.new_context()
    page = other.new_page()
    for each in (address, visitor.base):
        assert "press Enter in the terminal" in told(page, each)
    page.goto(visitor.address())
    page.wait_for_selector("html[data-ready]")
    other.close()


@contextmanager
def listener():
    """A server of somebody else on this machine: its port, and the heads of what it is asked."""
    heard = []

    class Listener(BaseHTTPRequestHandler):
        def do_GET(self):
            heard.append(f"{self.path} {self.headers}")
            self.send_response(200)
            self.end_headers()

        def log_message(self, *words):
            pass

    with HTTPServer(("127.0.0.1", 0), Listener) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server.server_address[1], heard
        server.shutdown()


def test_a_browser_that_keeps_nothing_is_let_in_until_it_loads_again(browser, visitor):
    context = browser.new_context()
    page = context.new_page()
    page.add_init_script(
        "Object.defineProperty(window, 'localStorage', { get() { throw new Error('none') } })"
    )
    page.goto(visitor.address())
    page.wait_for_selector("html[data-ready]")
    page.locator("[data-linkage]").first.wait_for()
    assert "press Enter in the terminal" in told(page, visitor.base)
    context.close()


def test_when_workers_are_killed_the_page_says_so_and_goes_on(browser, tmp_path):
    """At rest, noticed by a drag; and in the midst of a search."""
    with served(home=tmp_path) as visitor, studio_page(browser, visitor) as page:
        banner, before = page.locator("[data-banner=ended]"), pose(page, 8)
        killed(visitor)
        drag(page, '.bs-origin[data-pose="8"]', 14, -9)
        banner.wait_for()
        assert "Nothing of the task is lost" in banner.inner_text()
        assert "signal 9 ended it" in banner.inner_text()
        solved(page)
        assert pose(page, 8) != before
        assert page.locator("[data-linkage]").count() > 0
        banner.locator(".bs-close").click()
        drag(page, '.bs-origin[data-pose="8"]', 5, -3)
        page.wait_for_function("() => [...unanswered.values()].includes('solve')")
        killed(visitor)
        banner.locator("[data-do=solve-again]").click()
        solved(page)
        assert banner.count() == 0


def test_a_search_that_takes_too_long_is_told_and_nothing_is_lost(browser, tmp_path):
    with (
        served("--time-limit", "0.1", home=tmp_path) as visitor,
        studio_page(browser, visitor) as page,
    ):
        banner = page.locator("[data-banner=limit]")
        banner.wait_for()
        assert "took too long" in banner.inner_text()
        assert "0.1 s" in banner.inner_text()
        assert page.locator(".bs-pose-row").count() == 8
        page.locator("[data-do=solve-again]").click()
        assert banner.count() == 0
        banner.wait_for()


@pytest.mark.parametrize(("width", "scheme"), [(390, "light"), (1400, "dark")])
def test_no_width_needs_scrolling_sideways_and_every_control_has_a_name(
    browser, visitor, width, scheme
):
    with studio_page(browser, visitor, width=width, color_scheme=scheme) as page:
        if width < 760:
            page.locator("[data-sheet-of=task]").click()
        page.locator('[data-row="2"] .bs-index').click()
        page.locator("details").evaluate_all("all => all.forEach((each) => (each.open = true))")
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        unnamed = page.evaluate(UNNAMED)
        assert unnamed == []
        assert page.wrong == []


def test_an_empty_task_shows_nothing_of_the_one_before(page):
    choose(page, "task", "data-do=new")  # without the limits of the task that the studio opens on
    has_poses(page, 0)
    rows = ["x\ty\tangle", "0\t0\t0", "30\t20\t30", "60\t25\t60", "90\t10\t100"]
    paste(page, "\n".join(rows) + "\n")
    has_poses(page, 4)
    page.wait_for_selector("[data-linkage]", timeout=60_000)  # the page asks a moment later
    solved(page)
    curves = page.locator(".bs-burmester")
    assert curves.get_attribute("visibility") == "visible"
    count = page.locator("[data-linkage]").count()
    assert count > 0
    choose(page, "task", "data-do=new")
    has_poses(page, 0)
    page.wait_for_function("() => !document.querySelector('[data-linkage]')")
    assert curves.get_attribute("visibility") == "hidden"
    assert page.locator(".bs-mechanism").get_attribute("visibility") == "hidden"
    assert "Two poses or more" in page.locator(".bs-results-status").inner_text()
    page.locator("[data-do=undo]").click()
    has_poses(page, 4)
    page.wait_for_selector("[data-linkage]", timeout=60_000)  # the page asks a moment later
    solved(page)
    assert page.locator("[data-linkage]").count() == count
    assert curves.get_attribute("visibility") == "visible"
