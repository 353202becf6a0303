"""The studio under a hand: how long a picture takes, and where that time goes.

    python -m benchmarks.studio_latency --task case:ge2012-exact --moves 240 --repeats 3

A browser opens the studio and drags one pose along a circle with real pointer events, 60 a second
whether or not the page keeps up.  Server, worker, browser and this script share the machine.

At starts, seconds are from the command: until the address is printed, the page shows the task, and
it shows the first linkage.

Times are from the pointer event to after the picture is painted: of the pose that is held, and of
the linkages that answer it.  The second is split into

    wait    until the page sends the task of that event
    answer  until the frame is there: server, worker, and what they wait for
    script  what the page does with the frame
    paint   until the picture is there

Processor times are those of whole processes: server and worker for each answer, page and browser
for each picture, of which most show the hand alone.

The worker's own work is measured once more without a browser: the same tasks, one after another, in
this process.  And the browser's own: an empty page draws the scene that the studio drew, element by
element, at each pointer event, without a server and without the studio's script.
"""

import argparse
import asyncio
import json
import math
import os
import statistics
import sys
import tempfile
import time
from collections import defaultdict
from contextlib import asynccontextmanager
from pathlib import Path
from unittest import mock

from playwright.async_api import async_playwright

from benchmarks.studio_drags import executable, percentile
from burmester.live import answers
from burmester.studio.session_worker import SessionWorker

# Processes by what their commands hold; the first that is found counts.
KINDS = {
    "worker": b"burmester.studio.worker",
    "server": b"burmester\0studio",
    "page": b"--type=renderer",
    "browser": b"/chromium",
}
VIEWPORT = {"width": 1400, "height": 1000}
HERTZ = 60
NEAR = 1.2  # pixels: of two moves of the hand, which are 2 pixels apart, one is nearer

# Written down in the page: events, when what they did to the pose was painted, and times of frames.
CLOCK = """
window.clock = { events: [], hand: [], sent: [], frames: [] };
const painted = (fn) => requestAnimationFrame(() => {
  const channel = new MessageChannel();
  channel.port1.onmessage = () => fn(performance.now());
  channel.port2.postMessage(0);
});
let open = null;
for (const name of ["pointermove", "pointerrawupdate"])
  addEventListener(name, ({ timeStamp, clientX, clientY }) => {
    clock.events.push([clientX, clientY, timeStamp]);
    if (name !== "pointermove") return;
    if (open === null) painted((now) => { clock.hand.push(now - open); open = null; });
    open = timeStamp;
  }, true);
const send = WebSocket.prototype.send;
WebSocket.prototype.send = function (data) {
  if (/"do":"follow"/.test(data)) clock.sent.push([performance.now(), data]);
  return send.call(this, data);
};
const own = Object.getOwnPropertyDescriptor(WebSocket.prototype, "onmessage");
Object.defineProperty(WebSocket.prototype, "onmessage", {
  get() { return own.get.call(this); },
  set(fn) {
    own.set.call(this, (message) => {
      const start = performance.now();
      fn.call(this, message);
      if (typeof message.data === "string") return;
      const end = performance.now(), head = new Uint8Array(message.data, 4, 40);
      const n = Number(/"n":(\\d+)/.exec(new TextDecoder().decode(head))[1]);
      painted((now) => clock.frames.push([n, start, end, now, message.data.byteLength]));
    });
  },
});
"""

# What changes in the scene, picture by picture: [element, attribute, value], [element, null, text].
RECORD = """() => {
  const svg = document.querySelector(".bs-scene"), all = [...svg.querySelectorAll("*")];
  const order = new Map(all.map((each, k) => [each, k]));
  window.recorded = { html: svg.outerHTML, pictures: [] };
  window.recorder = new MutationObserver((changes) => {
    const picture = [];
    for (const { type, target, attributeName: name } of changes) {
      const k = order.get(target);
      if (k === undefined) continue;
      if (type === "attributes") picture.push([k, name, target.getAttribute(name)]);
      else if (!target.children.length) picture.push([k, null, target.textContent]);
    }
    if (picture.length) recorded.pictures.push(picture);
  });
  recorder.observe(svg, { attributes: true, childList: true, subtree: true });
}"""
RECORDED = """() => {
  recorder.disconnect();
  const rules = [...document.styleSheets].flatMap((each) => [...each.cssRules]);
  const { left, top, width, height } = document.querySelector(".bs-plane").getBoundingClientRect();
  const styles = rules.map((each) => each.cssText).join("\\n");
  return { ...recorded, styles, box: [left, top, width, height] };
}"""
EMPTY = """<!doctype html><html class="bm bs"><style>{styles}</style><body class="bm bs">
<div class="bs-plane" style="position:fixed;left:{0}px;top:{1}px;width:{2}px;height:{3}px">
{html}</div>"""
WRITE = "(html) => { document.open(); document.write(html); document.close(); }"
REPLAY = """(pictures) => {
  const all = [...document.querySelectorAll(".bs-scene *")];
  let k = 0;
  addEventListener("pointermove", () => {
    for (const [which, name, value] of pictures[k++ % pictures.length]) {
      if (name === null) all[which].textContent = value;
      else if (value === null) all[which].removeAttribute(name);
      else all[which].setAttribute(name, value);
    }
  });
}"""


@asynccontextmanager
async def opened(playwright, task):
    """The studio on a task, its first answer there: browser, page, and seconds to each step."""
    browser = await playwright.chromium.launch(
        executable_path=executable(),
        args=["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
    )
    page = await browser.new_page(viewport=VIEWPORT, reduced_motion="reduce")
    await page.add_init_script(CLOCK)
    command = [sys.executable, "-m", "burmester", "studio", *([task] if task else [])]
    start = time.perf_counter()
    server = await asyncio.create_subprocess_exec(
        *command, "--no-browser", stdout=asyncio.subprocess.PIPE
    )
    try:
        address = (await server.stdout.readline()).decode().strip()
        told = time.perf_counter() - start
        await page.goto(address)
        await page.wait_for_selector("html[data-ready]")
        ready = time.perf_counter() - start
        await page.wait_for_selector("[data-linkage]")
        first = time.perf_counter() - start
        await page.wait_for_timeout(1500)  # workers are started ahead meanwhile
        yield browser, page, {"address": told, "task": ready, "first linkage": first}
    finally:
        await browser.close()
        server.terminate()
        await server.wait()


async def drag(page, start, moves):
    """Take hold of what is there and move it along a circle of 40 pixels, at a steady rate."""
    session = await page.context.new_cdp_session(page)
    x, y = start

    def at(kind, dx, dy, buttons):
        button = {"button": "left", "buttons": buttons, "clickCount": 1, "pointerType": "mouse"}
        return session.send(
            "Input.dispatchMouseEvent", {"type": kind, "x": x + dx, "y": y + dy, **button}
        )

    await at("mouseMoved", 0, 0, 0)
    await at("mousePressed", 0, 0, 1)
    begin, under_way = time.perf_counter(), []
    for k in range(moves):
        turn = 2 * math.pi * (k + 1) / 120
        under_way.append(
            asyncio.ensure_future(
                at("mouseMoved", 40 * math.sin(turn), 40 - 40 * math.cos(turn), 1)
            )
        )
        await asyncio.sleep(max(0, begin + (k + 1) / HERTZ - time.perf_counter()))
    await asyncio.gather(*under_way)
    await at("mouseReleased", 0, 0, 0)
    await session.detach()


def family(pid):
    """A process and all that it started: their numbers, with processor seconds and commands."""
    parents, facts = {}, {}
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                fields = (folder / "stat").read_text().rpartition(")")[2].split()
                words = (folder / "cmdline").read_bytes()
            except OSError:
                continue
            parents[int(folder.name)] = int(fields[1])
            ticks = int(fields[11]) + int(fields[12])
            facts[int(folder.name)] = ticks / os.sysconf("SC_CLK_TCK"), words
    found = {pid}
    while more := {each for each, parent in parents.items() if parent in found} - found:
        found |= more
    return {each: facts[each] for each in found if each in facts}


def kind_of(words):
    """What a process does for the studio, by the words of its command."""
    for kind, part in KINDS.items():
        if part in words:
            return kind
    return "hand"  # this script and the driver of the browser


def processor_seconds():
    """Seconds of this script and of all that it started, by what they do."""
    out = defaultdict(float)
    for seconds, words in family(os.getpid()).values():
        out[kind_of(words)] += seconds
    return out


def spent_on(before, after, count, *kinds):
    """Milliseconds of processes for each of `count` things."""
    return {name: 1000 * (after[name] - before[name]) / count for name in kinds}


async def handle_of(page, number):
    """The middle of a pose's handle."""
    found = page.locator(f'.bs-origin[data-pose="{number}"] .bs-hold').first
    box = await found.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def spread(values):
    """Median and 95th percentile."""
    return {"median": statistics.median(values), "95 %": percentile(values, 0.95)}


SCENE = """() => {
  const svg = document.querySelector(".bs-scene"), { x, y } = svg.getBoundingClientRect();
  return [x + Number(svg.dataset.left), y + Number(svg.dataset.top), Number(svg.dataset.scale)];
}"""


def event_of(pose, sent_at, events, scene):
    """When the hand was where it put this pose: the last event there before it was sent."""
    left, top, scale = scene
    x, y = left + scale * pose["x"], top - scale * pose["y"]
    near = [t for a, b, t in events if t <= sent_at and math.hypot(a - x, b - y) < NEAR]
    return near[-1] if near else math.nan


async def measure(page, moves):
    """One drag: its times in milliseconds, and the tasks that were sent."""
    number = max(1, await page.locator(".bs-origin").count() // 2)
    await page.evaluate("Object.values(clock).forEach((each) => (each.length = 0))")
    start, scene = await handle_of(page, number), await page.evaluate(SCENE)
    before = processor_seconds()
    await drag(page, start, moves)
    spent = processor_seconds()
    clock = await page.evaluate("clock")
    asked = {}
    for at, text in clock["sent"]:
        given = json.loads(text)
        pose = given["document"]["poses"][number - 1]
        asked[given["n"]] = event_of(pose, at, clock["events"], scene), at
    rows = [[*asked[n], *times] for n, *times in clock["frames"]]
    rows = [row for row in rows if math.isfinite(row[0])]
    steps = {
        name: [row[k + 1] - row[k] for row in rows]
        for k, name in enumerate(("wait", "answer", "script", "paint"))
    }
    seconds = (rows[-1][4] - rows[0][4]) / 1000
    out = {
        "linkages": spread([row[4] - row[0] for row in rows]),
        "hand": spread(clock["hand"]),
        **{f"  {name}": spread(values) for name, values in steps.items()},
        "pictures a second": {
            "linkages": (len(rows) - 1) / seconds,
            "hand": len(clock["hand"]) / (moves / HERTZ),
        },
        "bytes a frame": statistics.median(row[5] for row in rows),
        "processor ms an answer": spent_on(before, spent, len(rows), "worker", "server"),
        "processor ms a picture": spent_on(before, spent, len(clock["hand"]), "page", "browser"),
    }
    return out, [text for _, text in clock["sent"]]


class NoJob:
    """Who asks a worker, and hears nothing on the way."""

    def send(self, head, body=b""):
        """Nobody takes pieces."""

    def listen(self, said):
        """Nobody asks how far it is."""


def alone(sent):
    """Milliseconds that a worker works on each task, without a browser: whole, and its parts."""
    spent = defaultdict(float)

    def timed(name, fn):
        def run(*given, **more):
            start = time.process_time()
            try:
                return fn(*given, **more)
            finally:
                spent[name] += time.process_time() - start

        return run

    worker, totals, parts = SessionWorker(), [], defaultdict(list)
    head = {"do": "solve", "time_limit": 60}
    worker.do(head, json.dumps({**json.loads(sent[0]), "do": "solve"}).encode(), NoJob())
    names = {"follow": "follow", "followed_frame": "encode"}
    patches = [
        mock.patch.object(answers, each, timed(name, getattr(answers, each)))
        for each, name in names.items()
    ]
    for each in patches:
        each.start()
    for text in sent:
        spent.clear()
        start = time.process_time()
        worker.do({"do": "follow", "from": 0}, text.encode(), NoJob())
        totals.append(1000 * (time.process_time() - start))
        for name in names.values():
            parts[name].append(1000 * spent[name])
    for each in patches:
        each.stop()
    return {"whole": spread(totals), **{f"  {name}": spread(parts[name]) for name in parts}}


async def drawn_by_an_empty_page(browser, page, moves):
    """The scene alone: event to picture, and pictures a second."""
    count = await page.locator(".bs-origin").count()
    start = await handle_of(page, max(1, count // 2))
    await page.evaluate(RECORD)
    await drag(page, start, 120)
    found = await page.evaluate(RECORDED)
    empty = await browser.new_page(viewport=VIEWPORT)
    await empty.add_init_script(CLOCK)
    await empty.goto("about:blank")
    html = EMPTY.format(*found["box"], styles=found["styles"], html=found["html"])
    await empty.evaluate(WRITE, html)
    await empty.evaluate(CLOCK)
    await empty.evaluate(REPLAY, found["pictures"])
    before = processor_seconds()
    await drag(empty, start, moves)
    spent = processor_seconds()
    hand = await empty.evaluate("clock.hand")
    await empty.close()
    return {
        "event to picture": spread(hand),
        "pictures a second": len(hand) / (moves / HERTZ),
        "attributes a picture": statistics.mean(len(each) for each in found["pictures"]),
        "processor ms a picture": spent_on(before, spent, len(hand), "page", "browser"),
    }


def told(name, value):
    """A line for a figure."""
    if isinstance(value, dict):
        value = "  ".join(f"{key} {each:.1f}" for key, each in value.items())
    elif isinstance(value, float):
        value = f"{value:.1f}"
    print(f"  {name:26s} {value}", flush=True)


async def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--task", default="case:ge2012-exact", help="'' for the studio's own")
    parser.add_argument("--moves", type=int, default=240)
    parser.add_argument("--repeats", type=int, default=3, help="how often the pose is dragged")
    parser.add_argument("--without-split", action="store_true", help="only the studio itself")
    parser.add_argument("--starts", type=int, default=3, help="how often the studio is started")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as compiled:
        # As where it is installed: all modules are compiled by the first start, which is not told.
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = compiled
        async with async_playwright() as playwright:
            for k in range(given.starts):
                async with opened(playwright, given.task) as (_, _, start):
                    if k:
                        print(f"start {k}: seconds after the command")
                        print("  " + "  ".join(f"{key} {each:.2f}" for key, each in start.items()))
            async with opened(playwright, given.task) as (browser, page, _):
                for k in range(given.repeats):
                    print(f"drag {k + 1}: milliseconds")
                    found, sent = await measure(page, given.moves)
                    for name, value in found.items():
                        told(name, value)
                    await page.wait_for_timeout(2000)
                if given.without_split or not given.repeats:
                    return
                empty = await drawn_by_an_empty_page(browser, page, given.moves)
    print("an empty page that draws the same scene")
    for name, value in empty.items():
        told(name, value)
    print("the worker alone: processor milliseconds a task")
    for name, value in alone(sent).items():
        told(name, value)


if __name__ == "__main__":
    asyncio.run(main())
