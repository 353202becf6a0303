"""A real browser for tests of pages: Debian's chromium, driven by Playwright.

Where there is none, tests are skipped with a line that says so.
"""

import shutil
from contextlib import contextmanager

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome")


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
    context.set_default_timeout(20_000)
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
