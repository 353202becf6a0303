"""A real browser for tests of pages: Debian's chromium, driven by Playwright.

Where there is none, tests are skipped with a line that says so.
"""

import shutil
import time
from contextlib import contextmanager

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome")
SECONDS = 60.0  # that anything may take on a busy machine
# A picture follows what stands beside it one frame later: it has come to rest when an element has
# the same place and says the same of itself in three frames.
REST = """(node, most) => new Promise((done, fail) => {
  const seen = () => JSON.stringify([node.getBoundingClientRect(), { ...node.dataset }]);
  const start = performance.now();
  let before = null, same = 0;
  const look = () => {
    const now = seen();
    same = now === before ? same + 1 : 0;
    before = now;
    if (same >= 2) done();
    else if (performance.now() - start > most) fail(new Error(`it never came to rest: ${now}`));
    else requestAnimationFrame(look);
  };
  look();
})"""
# Every frame counts as a tenth of a second, however fast this machine draws.
QUICK = """(() => {
  const own = window.requestAnimationFrame;
  let now = 0;
  window.requestAnimationFrame = (what) => own.call(window, () => what((now += 100)));
})();"""
# What a press there would meet, in shadow roots, too.
MEETS = """(node, [x, y]) => {
  const hit = node.getRootNode().elementFromPoint(x, y);
  return hit === node || node.contains(hit) ? "" : hit ? hit.outerHTML.slice(0, 300) : "nothing";
}"""


def path():
    """Where the browser is; skips the test where there is none."""
    found = next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        pytest.skip("no browser: install Debian's package chromium")
    return found


@contextmanager
def launched(*arguments):
    """A browser that draws without a graphics card, and asks no sandbox of a container."""
    executable = path()
    driver = pytest.importorskip("playwright.sync_api", reason="no playwright for this machine")
    with driver.sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=executable,
            args=["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", *arguments],
        )
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def opened(browser, file, *, before=None, width=1440, height=900, **options):
    """A page of its own with the file open, and what it said and asked for.

    before: script that runs before those of the page.  Yields (page, said, asked): console messages
    and errors, and the addresses of all requests.
    """
    options.setdefault("reduced_motion", "reduce")
    context = browser.new_context(viewport={"width": width, "height": height}, **options)
    context.set_default_timeout(1000 * SECONDS)
    page, said, asked = context.new_page(), [], []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    if before:
        page.add_init_script(before)
    try:
        page.goto(file.as_uri())
        yield page, said, asked
    finally:
        context.close()


def at_rest(locator):
    """The box of an element, in pixels of the window, when it no longer moves."""
    locator.evaluate(REST, 1000 * SECONDS)
    return locator.bounding_box()


def settled(page, look, milliseconds=400):
    """What `look` finds when it finds the same again so much later.

    An answer that comes after the picture was at rest may give it another size, and it is fitted.
    """
    end, before, now = time.monotonic() + SECONDS, None, look()
    while now != before:
        assert time.monotonic() < end, f"it never settled: {now}"
        idle(page, milliseconds)
        before, now = now, look()
    return now


def idle(page, milliseconds=0):
    """Wait so long in the page, and until it has nothing to do; two seconds for one that plays."""
    page.evaluate(
        """(time) => new Promise((done) =>
          setTimeout(() => requestIdleCallback(done, { timeout: 2000 }), time))""",
        milliseconds,
    )


def press(page, locator, x, y):
    """Press the button there, where the element has to be what is pressed."""
    page.mouse.move(x, y)
    met = locator.evaluate(MEETS, [x, y])
    assert not met, f"pressed is not {locator}, but {met}"
    page.mouse.down()
