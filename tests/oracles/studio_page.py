"""The studio's page in a browser, driven by real pointer and key events."""

import math
import re
from contextlib import contextmanager

from tests.oracles.browser import SECONDS, at_rest, idle

# What the page has asked over its websocket and is not answered, by number: what it wants done.
# A hand that rests on a slow machine is answered to the end in the midst of a test that wants to
# see what is drawn before: `withhold("solve")` puts that off.
UNANSWERED = """(() => {
  window.unanswered = new Map();
  let withheld = null, held = [];
  window.withhold = (what) => { // what is asked of that kind goes out when this is called with null
    withheld = what;
    for (const send of held.splice(0)) send();
  };
  const more = ["solving", "progress", "waiting"]; // kinds that others follow
  const headOf = (frame) => new Uint8Array(frame, 4, new DataView(frame).getUint32(0, true));
  const answered = (n, kind) => {
    const what = unanswered.get(n);
    for (const [k, each] of unanswered)
      if (k <= n && (each === what || kind === "cancelled")) unanswered.delete(k);
  };
  window.WebSocket = class extends WebSocket {
    constructor(...given) {
      super(...given);
      unanswered.clear();
      this.addEventListener("close", () => unanswered.clear());
      this.addEventListener("message", ({ data }) => {
        const text = typeof data === "string" ? data : new TextDecoder().decode(headOf(data));
        const { n, kind } = JSON.parse(text);
        if (!more.includes(kind)) setTimeout(answered, 0, n, kind); // the page takes it first
      });
    }
    send(data) {
      const { n, do: what } = JSON.parse(data);
      if (what === withheld) return void held.push(() => this.send(data));
      super.send(data);
      if (what !== "cancel") unanswered.set(n, what);
    }
  };
})()"""


# Of a chest's lid, driven by a four-bar: five poses leave few linkages, found at once.
LID_OF_FIVE = """length_unit = "mm"
angle_unit = "deg"
poses = [
  { x = 0, y = 0, angle = 0 },
  { x = 2.91, y = -17.171, angle = 22.5 },
  { x = 10.949, y = -41.071, angle = 45 },
  { x = 23.907, y = -67.224, angle = 67.5 },
  { x = 43.763, y = -92.311, angle = 90 },
]
"""


@contextmanager
def studio_page(browser, visitor, *, width=1400, height=900, **options):
    """The page of a studio, solved once; its errors are in `wrong`, its requests in `asked`."""
    options.setdefault("reduced_motion", "reduce")
    context = browser.new_context(viewport={"width": width, "height": height}, **options)
    context.set_default_timeout(1000 * SECONDS)
    page = context.new_page()
    page.add_init_script(UNANSWERED)
    page.wrong, page.asked = [], []
    page.on("console", lambda said: page.wrong.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: page.wrong.append(str(error)))
    page.on("request", lambda request: page.asked.append(request.url))
    try:
        page.goto(visitor.address())
        page.wait_for_selector("html[data-ready]")
        page.locator("[data-do=snap]").click()  # a test says to the pixel where it drags
        solved(page)
        yield page
    finally:
        context.close()


def answered(page):
    """Wait until everything that was asked is answered, and shown."""
    page.wait_for_function("() => unanswered.size === 0")
    idle(page)


def solved(page):
    """Wait until the whole road has answered to the task as it is, and nothing else is asked."""
    page.wait_for_function(
        """() => {
          const status = document.querySelector(".bs-status");
          const rests = status.dataset.state === "resting" && status.textContent !== "";
          return rests && unanswered.size === 0;
        }"""
    )


def middle(page, selector):
    """The middle of an element, in pixels of the window."""
    at_rest(page.locator(".bs-scene"))
    box = at_rest(page.locator(selector).first)
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page, selector, dx, dy, steps=8):
    """Take hold of an element, move it by so many pixels, and let go."""
    x, y = middle(page, selector)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx, y + dy, steps=steps)
    page.mouse.up()


def view(page):
    """Scale and origin of the picture: a point of F is at (left + scale x, top - scale y)."""
    data = page.locator(".bs-scene").evaluate("node => ({...node.dataset})")
    return {name: float(data[name]) for name in ("scale", "left", "top")}


def choose(page, menu, what):
    """Choose something in a menu of the head."""
    page.locator(f"[data-menu={menu}] > summary").click()
    page.locator(f"[data-menu={menu}] [{what}]").click()


def open_tab(page, name):
    """Open a tab of the drawer, if it is not open."""
    if page.locator(f"[data-tab={name}]").get_attribute("aria-selected") != "true":
        page.locator(f"[data-tab={name}]").click()
    return page.locator(f"[data-panel={name}]")


def see(page, what):
    """Fit the picture until it shows this: "near" the poses and the pivots, or "all"."""
    while page.locator(".bs-scene").get_attribute("data-fit") != what:
        page.locator("[data-do=fit]").click()


def see_all(page):
    """Show all of the body and the regions; the page opens on the poses and the pivots."""
    see(page, "all")


def as_opened(page):
    """Undo all that was done, and look at it as the page did when it was opened."""
    page.mouse.move(2, 2)
    page.keyboard.press("Escape")
    closing = page.locator(".bs-banner .bs-close")
    closing.evaluate_all("all => all.forEach((each) => each.click())")
    undo = page.locator("[data-do=undo]")
    while undo.is_enabled():
        undo.click()
    page.locator(".bs-scene").focus()
    page.keyboard.press("Escape")
    see(page, "near")
    solved(page)


def on_screen(page, x, y):
    """Where a point of F is, in pixels of the window."""
    box, at = at_rest(page.locator(".bs-scene")), view(page)
    return box["x"] + at["left"] + at["scale"] * x, box["y"] + at["top"] - at["scale"] * y


def place_of(page, selector):
    """Where an element stands, as a point of F."""
    found = page.locator(selector).get_attribute("transform")
    x, y = map(float, re.match(r"translate\((\S+) (\S+)\)", found).groups())
    at = view(page)
    return (x - at["left"]) / at["scale"], (at["top"] - y) / at["scale"]


def field(page, row, key):
    """A field of the table of poses; rows count from 1."""
    return page.locator(f'[data-row="{row}"] [data-key="{key}"]')


def number(text):
    """A number as a field shows it."""
    return float(text.replace("−", "-"))


def pose(page, row):
    """x, y and angle of a pose, as the table shows them."""
    return tuple(number(field(page, row, key).input_value()) for key in ("x", "y", "angle"))


def drawn(page, row):
    """The same from the picture: the point and the direction of the handles."""
    found = page.locator(f'.bs-pose:has(.bs-origin[data-pose="{row}"])').get_attribute("transform")
    x, y, turn = map(
        float, re.fullmatch(r"translate\((\S+) (\S+)\) rotate\((\S+)\)", found).groups()
    )
    at = view(page)
    return (x - at["left"]) / at["scale"], (at["top"] - y) / at["scale"], -turn


def same_angle(one, other, within):
    """Whether two angles in degrees point the same way."""
    return abs(math.remainder(one - other, 360)) <= within


DROP = """([name, text]) => {
  const data = new DataTransfer(), target = document.querySelector("main");
  data.items.add(new File([text], name));
  const options = { dataTransfer: data, bubbles: true, cancelable: true };
  for (const kind of ["dragenter", "dragover", "drop"])
    target.dispatchEvent(new DragEvent(kind, options));
}"""
PASTE = """(text) => {
  const data = new DataTransfer();
  data.setData("text/plain", text);
  const options = { clipboardData: data, bubbles: true, cancelable: true };
  document.activeElement.dispatchEvent(new ClipboardEvent("paste", options));
}"""


def drop(page, name, text):
    """Drop a file on the page."""
    page.evaluate(DROP, [name, text])


def paste(page, text):
    """Paste a text where the focus is."""
    page.evaluate(PASTE, text)


def has_poses(page, count):
    """Wait until the table has so many rows."""
    rows = "document.querySelectorAll('.bs-pose-row').length"
    page.wait_for_function(f"() => {rows} === {count}")


def kept(page):
    """The task that this tab keeps, when what was done last is in it."""
    page.wait_for_function("() => document.documentElement.dataset.kept === 'true'")
    return page.evaluate("JSON.parse(sessionStorage.getItem('burmester.studio')).document")
