"""A saved notebook, whose kernel is gone, in a browser."""

from pathlib import Path

import burmester
from burmester.notebook import Studio


def test_a_saved_widget_without_a_kernel_shows_its_drawing(browser):
    script = Path(burmester.__file__).parent / "web" / "assets" / "notebook.mjs"
    page = browser.new_page()
    page.route("http://saved/**", lambda route: route.fulfill(
        body=script.read_bytes() if route.request.url.endswith(".mjs") else "<div></div>",
        content_type="text/javascript" if route.request.url.endswith(".mjs") else "text/html",
    ))  # fmt: skip
    page.goto("http://saved/")
    page.evaluate(
        """async (still) => {
          const { default: widget } = await import("/notebook.mjs");
          const model = { get: () => still, on() {}, off() {}, send() {} };
          widget.render({ model, el: document.querySelector("div") });
        }""",
        Studio(burmester.read_task("case:motiongen-shoulder")).still,
    )
    page.get_by_text("No kernel answers").wait_for()
    drawn = page.locator(".bn-still svg").bounding_box()
    assert drawn["width"] > 300
    assert page.locator(".bn-still td").count() == 18
    page.close()
