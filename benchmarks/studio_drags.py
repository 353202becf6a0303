"""The studio under a hand: how fast the picture follows, what cards keep, and memory.

    python -m benchmarks.studio_drags --moves 240
    python -m benchmarks.studio_drags --drags 1000 --seed 0
    python -m benchmarks.studio_drags --memory 10000

A browser opens the studio on a task and drags poses with real pointer events; server, workers and
browser share this machine's cores.  What goes over the websocket is read beside the page, by code
of its own.

Speed: one pose is dragged along a circle.  A picture's time is from the pointer event whose task it
answers to after its frame is painted.  Script is the time in the page's handler of a frame, drawing
included.  Start is from the command to the first linkage on the page.

Cards: after each random drag of a pose the whole road answers.  A card counts as kept where its
linkage is the same as the one it had, in the coordinates of the last frame that was followed to
that very task; as told where the card says that it is gone or new, or how far the search moved its
linkage; as old frame where the last frame did not judge it; else as wrong.  A drag is slow where
the last frame was not of that task, or of another answer.  Cards that ended are named above the
list.

Memory: that of the server and of each of its workers, by the numbers of their processes, without
mapped files, which a system drops and loads as it likes, and the page's heap after a collection.  A
worker whose search was called off and does not end is killed, and another one is started when it is
wanted: only the sizes of processes that stay tell whether anything grows.
"""

import argparse
import json
import math
import os
import random
import re
import statistics
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import sync_playwright

SAME = 2e-3  # of the size of a linkage: dyads nearer than that are one
MOST_ASKED = 500  # messages whose tasks are kept
TELLTALE = re.compile(r"gone|new|was L\d+")
MOVED = re.compile(r"moved \d")

# Times in the page: which pointer event a followed task came from, and when its picture is there.
CLOCK = """
window.clock = { pictures: [], script: [], last: null };
addEventListener("pointermove", (event) => (clock.last = event.timeStamp), true);
const asked = new Map(), send = WebSocket.prototype.send;
WebSocket.prototype.send = function (data) {
  const found = /"n":(\\d+),"do":"follow"/.exec(data);
  if (found) asked.set(Number(found[1]), clock.last);
  return send.call(this, data);
};
const own = Object.getOwnPropertyDescriptor(WebSocket.prototype, "onmessage");
Object.defineProperty(WebSocket.prototype, "onmessage", {
  get() { return own.get.call(this); },
  set(fn) {
    own.set.call(this, (event) => {
      const start = performance.now();
      fn.call(this, event);
      if (typeof event.data === "string") return;
      clock.script.push(performance.now() - start);
      const head = new TextDecoder().decode(new Uint8Array(event.data, 4, 40));
      const from = asked.get(Number(/"n":(\\d+)/.exec(head)[1]));
      requestAnimationFrame(() => {
        const channel = new MessageChannel();
        channel.port1.onmessage = () => {
          const now = performance.now();
          clock.pictures.push([now, now - from]);
        };
        channel.port2.postMessage(0);
      });
    });
  },
});
"""


def executable():
    names = ("chromium", "chromium-browser", "google-chrome")
    folders = map(Path, os.environ["PATH"].split(os.pathsep))
    return next(
        str(folder / name) for folder in folders for name in names if (folder / name).exists()
    )


class Studio:
    """The command, the page, and what went over the websocket."""

    def __init__(self, task, server, page, url):
        self.task, self.server, self.page, self.url = task, server, page, url
        self.solved, self.followed, self.answers, self.asked = None, None, 0, {}
        self.devtools = page.context.new_cdp_session(page)

    def received(self, payload):
        if isinstance(payload, bytes):
            length = int.from_bytes(payload[:4], "little")
            self.followed = json.loads(payload[4 : 4 + length])
            return
        message = json.loads(payload)
        if message["kind"] == "solved":
            self.solved = message
            self.answers += 1

    def sent(self, payload):
        message = json.loads(payload)
        if message["do"] in ("follow", "solve"):
            self.asked[message["n"]] = message["document"]
            self.asked.pop(message["n"] - MOST_ASKED, None)

    @property
    def is_same(self):
        """Whether the last frame is of the task that was solved, and of the answer before."""
        frame = self.followed and self.asked.get(self.followed["n"])
        is_before = frame is not None and self.followed["from"] != self.solved["n"]
        return is_before and frame == self.asked.get(self.solved["n"])

    def rest(self, before, seconds=30):
        """Wait for a whole answer after the one before."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.page.wait_for_timeout(30)
            if self.solved is not before and self.solved is not None:
                self.page.wait_for_timeout(60)
                return True
        return False

    def handle(self, number):
        """The middle of a pose's handle, in pixels of the window."""
        box = self.page.locator(f'.bs-origin[data-pose="{number}"] .bs-hold').first.bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, number, path, pause=0.0):
        x, y = self.handle(number)
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        for dx, dy in path:
            start = time.perf_counter()
            mouse.move(x + dx, y + dy)
            left = pause - (time.perf_counter() - start)
            if left > 0:
                time.sleep(left)
        mouse.up()

    def resident(self):
        """Kilobytes of memory of the server and of each worker, by pid, without mapped files."""
        parents = {}
        for folder in Path("/proc").iterdir():
            if folder.name.isdigit():
                try:
                    fields = (folder / "stat").read_text().rpartition(")")[2].split()
                except OSError:
                    continue
                parents[int(folder.name)] = int(fields[1])
        family = {self.server.pid}
        while more := {pid for pid, parent in parents.items() if parent in family} - family:
            family |= more
        sizes = {}
        for pid in sorted(family):
            try:
                text = Path(f"/proc/{pid}/status").read_text()
            except OSError:
                continue
            if found := re.search(r"RssAnon:\s+(\d+)", text):  # a process that ends has none
                sizes[pid] = int(found[1])
        return sizes

    def heap(self):
        """Kilobytes of the page's heap after a collection."""
        self.devtools.send("HeapProfiler.collectGarbage")
        return self.devtools.send("Runtime.getHeapUsage")["usedSize"] / 1024

    def nodes(self):
        """Nodes of documents that the page holds, shown or not."""
        return self.devtools.send("Memory.getDOMCounters")["nodes"]


@contextmanager
def opened(task):
    """The studio on a task, its first answer there; with the seconds that took."""
    start = time.perf_counter()
    command = [sys.executable, "-m", "burmester", "studio", task, "--no-browser", "--port", "0"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=executable(),
            args=["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
        )
        page = browser.new_page(viewport={"width": 1400, "height": 1000}, reduced_motion="reduce")
        page.add_init_script(CLOCK)
        start = time.perf_counter()
        server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        url = server.stdout.readline().strip()
        studio = Studio(task, server, page, url)
        page.on("websocket", lambda socket: socket.on("framereceived", studio.received))
        page.on("websocket", lambda socket: socket.on("framesent", studio.sent))
        weight = []
        page.on("response", lambda response: weight.append(response))  # noqa: PLW0108
        try:
            page.goto(url)
            page.wait_for_selector("[data-linkage]", timeout=60_000)
            studio.start = time.perf_counter() - start
            page.wait_for_timeout(500)
            studio.weight = sum(
                len(each.body()) for each in weight if each.ok and each.request.method == "GET"
            )
            yield studio
        finally:
            browser.close()
            server.terminate()
            server.wait(20)


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, math.ceil(share * len(values)) - 1)]


def speed(studio, moves):
    """One pose along a circle of 40 pixels."""
    path = [
        (40 * math.sin(2 * math.pi * k / 120), 40 - 40 * math.cos(2 * math.pi * k / 120))
        for k in range(moves)
    ]
    studio.page.evaluate("clock.pictures.length = clock.script.length = 0")
    before = studio.solved
    count = studio.page.locator(".bs-origin").count()
    studio.drag(max(1, count // 2), path, 1 / 60)
    studio.rest(before)
    clock = studio.page.evaluate("clock")
    times = [each for _, each in clock["pictures"]]
    span = (clock["pictures"][-1][0] - clock["pictures"][0][0]) / 1000
    return {
        "pictures": len(times),
        "per second": len(times) / span,
        "median ms": statistics.median(times),
        "95 % ms": percentile(times, 0.95),
        "script median ms": statistics.median(clock["script"]),
        "script 95 % ms": percentile(clock["script"], 0.95),
    }


def coordinates(linkage):
    """The numbers of both dyads, in an order that does not depend on the driver."""
    rows = []
    for dyad in linkage["led"]:
        row = [*(dyad.get("fixed_pivot") or ()), *(dyad.get("moving_pivot") or ())]
        if "line" in dyad:
            angle, offset = math.radians(dyad["line"]["normal_deg"]), dyad["line"]["offset"]
            row += [offset * math.cos(angle), offset * math.sin(angle)]
        row.append(dyad.get("radius", 0.0))
        rows.append((dyad["kind"], row))
    return rows


def apart(one, other):
    """How far two linkages are from each other, relative to their size; infinite between kinds."""
    a, b = coordinates(one), coordinates(other)
    size = max(1e-300, *(abs(value) for _, row in a for value in row))

    def of(a, b):
        if a[0] != b[0]:
            return math.inf
        return max(abs(x - y) for x, y in zip(a[1], b[1], strict=True)) / size

    return min(max(of(a[0], b[0]), of(a[1], b[1])), max(of(a[0], b[1]), of(a[1], b[0])))


CARDS = """() => [...document.querySelectorAll("[data-linkage]")].map((card) => {
  card.key ??= (window.keys = (window.keys ?? 0) + 1);
  return [card.key, card.dataset.linkage, card.textContent];
})"""


def cards(studio):
    return {key: (name, text) for key, name, text in studio.page.evaluate(CARDS)}


def check(studio, drags, seed, seconds):
    """Random drags, as many as there is time for; what became of the cards after each."""
    rng, end = random.Random(seed), time.monotonic() + seconds
    count = studio.page.locator(".bs-origin").count()
    counted = ("kept", "told", "appeared", "ended", "old frame", "wrong", "not followed", "slow")
    out = dict.fromkeys(("drags", *counted), 0)
    for _ in range(drags):
        if time.monotonic() > end:
            break
        out["drags"] += 1
        if rng.random() < 0.15:
            studio.page.keyboard.press("Control+z")
            studio.rest(studio.solved)
        shown, before, studio.followed, studio.answers = cards(studio), studio.solved, None, 0
        turn, length, steps = rng.uniform(0, math.tau), rng.uniform(4, 30), rng.randint(6, 14)
        path = [
            (length * k / steps * math.cos(turn), length * k / steps * math.sin(turn))
            for k in range(1, steps + 1)
        ]
        studio.drag(rng.randint(1, count), path, 1 / 60)
        if not studio.rest(before):
            out["not followed"] += 1
            continue
        if studio.answers != 1 or not studio.is_same:
            out["slow"] += 1  # the whole road answered on the way, or before the last frame
            continue
        followed = {each["id"]: each for each in (studio.followed or {"linkages": []})["linkages"]}
        new = {each["id"]: each for each in studio.solved["result"]["linkages"]}
        now = cards(studio)
        for key, (name, text) in now.items():
            if key not in shown:
                out["appeared"] += 1
            elif shown[key][0] not in followed or name not in new:
                out["told" if TELLTALE.search(text) else "not followed"] += 1
            elif not followed[shown[key][0]]["fresh"]:
                out["old frame"] += 1
            elif apart(followed[shown[key][0]], new[name]) < SAME:
                out["kept"] += 1
            elif MOVED.search(text):
                out["told"] += 1
            else:
                out["wrong"] += 1
                away = apart(followed[shown[key][0]], new[name])
                print(f"  {shown[key][0]} is {name} now, {away:.1e} of its size away")
        out["ended"] += len(shown.keys() - now.keys())
    return out


def memory(studio, drags, seed, seconds):
    """Sizes at twenty times during many short drags, as many as there is time for."""
    rng, end = random.Random(seed), time.monotonic() + seconds
    count = studio.page.locator(".bs-origin").count()
    for k in range(drags + 1):
        over = k == drags or time.monotonic() > end
        if over or k % max(1, drags // 20) == 0:
            yield k, studio.resident(), studio.heap() / 1024, studio.nodes()
        if over:
            return
        before = studio.solved
        dx, dy = rng.uniform(-3, 3), rng.uniform(-3, 3)
        studio.drag(rng.randint(1, count), [(dx, dy), (5 * dx, 5 * dy), (0, 0)])
        if k % 20 == 0:
            studio.rest(before, 10)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--task", default="case:ge2012-exact")
    parser.add_argument("--moves", type=int, default=240)
    parser.add_argument("--drags", type=int, default=0)
    parser.add_argument("--memory", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=math.inf)
    given = parser.parse_args()
    with opened(given.task) as studio:
        print(f"first linkage {studio.start:.2f} s after the command")
        print(f"page {studio.weight / 1000:.0f} kB")
        if given.moves:
            for name, value in speed(studio, given.moves).items():
                print(f"  {name}: {value:.1f}")
        if given.drags:
            print(check(studio, given.drags, given.seed, given.seconds), flush=True)
        if given.memory:
            for k, sizes, page, nodes in memory(studio, given.memory, given.seed, given.seconds):
                each = ", ".join(f"{pid}: {size / 1024:.1f}" for pid, size in sizes.items())
                text = f"server {sum(sizes.values()) / 1024:.1f} MB ({each}), page {page:.1f} MB"
                text += f", {nodes} nodes"
                print(f"  {k:6d} drags: {text}", flush=True)


if __name__ == "__main__":
    main()
