"""JupyterLab with one notebook in a browser, and a second hold on its kernel.

The widget is what the notebook's only cell shows.  Python's side is asked over the kernel's own
channels, beside the browser.
"""

import ast
import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

from tests.oracles import browser

SECONDS = browser.SECONDS


# Times in the page, by what goes over the websocket of the kernel.
CLOCK = """
window.clock = { pictures: [], flying: 0, most: 0, sent: 0, superseded: 0, last: null };
addEventListener("pointermove", (event) => (clock.last = event.timeStamp), true);
const asked = new Map(), send = WebSocket.prototype.send;
const textOf = (data) => typeof data === "string" ? data : new TextDecoder().decode(data);
WebSocket.prototype.send = function (data) {
  const text = textOf(data), found = /"n":(\\d+),"do":"follow"/.exec(text);
  if (found) {
    asked.set(Number(found[1]), clock.last);
    clock.sent += 1;
    clock.most = Math.max(clock.most, (clock.flying += 1));
  }
  return send.call(this, data);
};
const Own = WebSocket;
window.WebSocket = class extends Own {
  constructor(...given) {
    super(...given);
    this.addEventListener("message", ({ data }) => {
      const answer = /"n": ?(\\d+), ?"kind": ?"(followed|superseded|refused)"/;
      const found = answer.exec(textOf(data));
      const n = found && Number(found[1]);
      if (!asked.has(n)) return;
      clock.flying -= 1;
      const from = asked.get(n);
      asked.delete(n);
      if (found[2] === "superseded") clock.superseded += 1;
      if (found[2] !== "followed") return;
      setTimeout(() => requestAnimationFrame(() => {
        const channel = new MessageChannel();
        channel.port1.onmessage = () => {
          const now = performance.now();
          clock.pictures.push([now, now - from]);
        };
        channel.port2.postMessage(0);
      }));
    });
  }
};
"""


class Notebook:
    """The page of a notebook, and its kernel."""

    def __init__(self, page, client):
        self.page, self.client = page, client

    def run(self, code):
        """Run code in the kernel, for what it does."""
        reply = self.client.execute(code, reply=True, timeout=SECONDS, store_history=False)
        assert reply["content"]["status"] == "ok", "\n".join(reply["content"]["traceback"])

    def value(self, expression):
        """What an expression is worth there, by JSON."""
        code = f"import json as _json; _told = _json.dumps({expression})"
        reply = self.client.execute(
            code,
            user_expressions={"told": "_told"},
            reply=True,
            timeout=SECONDS,
            store_history=False,
        )
        assert reply["content"]["status"] == "ok", "\n".join(reply["content"]["traceback"])
        said = reply["content"]["user_expressions"]["told"]["data"]["text/plain"]
        return json.loads(ast.literal_eval(said))

    def until(self, expression, seconds=SECONDS):
        """Wait until an expression is true in the kernel."""
        end = time.monotonic() + seconds
        while not self.value(f"bool({expression})"):
            assert time.monotonic() < end, f"it never came true: {expression}"
            time.sleep(0.03)


def playwright_error():
    """What Playwright raises."""
    from playwright.sync_api import Error  # noqa: PLC0415  browsers are optional

    return Error


@contextmanager
def server(folder, *command):
    """The address of a JupyterLab on this machine that serves a folder, with its token."""
    state = Path(folder) / ".jupyter"
    env = {
        **os.environ,
        **{f"JUPYTER_{name}_DIR": str(state / name.lower()) for name in ("CONFIG", "RUNTIME")},
        "JUPYTER_DATA_DIR": str(state / "data"),
        "IPYTHONDIR": str(state / "ipython"),
        "JUPYTERLAB_SETTINGS_DIR": str(state / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(state / "workspaces"),
    }
    quiet = state / "settings" / "@jupyterlab" / "apputils-extension"
    quiet.mkdir(parents=True)
    (quiet / "notification.jupyterlab-settings").write_text('{"fetchNews": "false"}')
    command = command or ("-m", "jupyterlab")
    process = subprocess.Popen(
        [sys.executable, *command, "--no-browser", "--allow-root", "--port=0", "--port-retries=0",
         f"--ServerApp.root_dir={folder}", "--ServerApp.log_level=30",
         "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"],
        env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        yield address(state / "runtime", process), state / "runtime"
    finally:
        process.terminate()
        process.wait(60)


def address(runtime, process):
    """What the server writes about itself: its address and its token."""
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        assert process.poll() is None, "the server ended"
        for file in runtime.glob("jpserver-*.json"):
            try:
                said = json.loads(file.read_text())
            except ValueError:
                continue  # half written
            return said["url"], said["token"]
        time.sleep(0.05)
    raise AssertionError("the server did not start")


@contextmanager
def notebook(chromium, folder, code, *, width=1000, height=900, before=None, **options):
    """A notebook with one cell, which was run."""
    from jupyter_client import BlockingKernelClient  # noqa: PLC0415

    cell = {"cell_type": "code", "id": "cell", "execution_count": None, "metadata": {}}
    whole = {
        "cells": [{**cell, "outputs": [], "source": code}],
        "metadata": {"kernelspec": {"name": "python3", "display_name": "Python 3"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    (Path(folder) / "one.ipynb").write_text(json.dumps(whole))
    with server(folder) as ((url, token), runtime):
        options.setdefault("reduced_motion", "reduce")
        context = chromium.new_context(viewport={"width": width, "height": height}, **options)
        context.set_default_timeout(1000 * SECONDS)
        page, wrong, answered = context.new_page(), [], []
        page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: wrong.append(str(error)))
        if before:
            page.add_init_script(before)
        try:
            page.goto(f"{url}doc/tree/one.ipynb?token={token}")
            page.wait_for_selector(".jp-Notebook .jp-CodeCell .cm-content")
            # Before the kernel is there nothing is run; and it is to be run once.
            while not page.locator('.jp-Notebook-ExecutionIndicator[data-status="idle"]').count():
                _answer_dialogs(page, answered)
                page.wait_for_timeout(200)
            # It may be called idle before it takes cells: then nothing is run, and it is run again.
            prompt = page.locator(".jp-CodeCell .jp-InputPrompt").first
            end = time.monotonic() + SECONDS
            while prompt.inner_text() in ("[ ]:", ""):
                assert time.monotonic() < end, "the cell was not run"
                _answer_dialogs(page, answered)
                try:
                    page.locator(".jp-CodeCell .cm-content").click(timeout=3000)
                except playwright_error():
                    continue  # a dialog came in between
                page.keyboard.press("Control+Enter")
                begun = time.monotonic()
                while prompt.inner_text() in ("[ ]:", "") and time.monotonic() < begun + 3:
                    page.wait_for_timeout(100)
            page.wait_for_selector(".bn .bs-origin")
            (file,) = runtime.glob("kernel-*.json")
            client = BlockingKernelClient(connection_file=str(file))
            client.load_connection_file()
            client.start_channels()
            client.wait_for_ready(timeout=SECONDS)
            page.wrong = wrong
            yield Notebook(page, client)
            client.stop_channels()
        except Exception:
            print(wrong, answered)
            raise
        finally:
            context.close()


def _answer_dialogs(page, answered):
    """Accept what JupyterLab asks, such as which kernel it is to be; what it asked is noted."""
    for dialog in page.locator(".jp-Dialog").all():
        try:
            answered.append(dialog.inner_text(timeout=1000))
            dialog.locator("button.jp-mod-accept").first.click(timeout=3000)
        except playwright_error():
            continue  # it has gone of itself


def drag(page, number, path, pause):
    """One pose along a path of pixels from where it is, a step each `pause` seconds."""
    handle = page.locator(f'.bn .bs-origin[data-pose="{number}"]')
    browser.at_rest(page.locator(".bn .bs-scene"))
    box = browser.at_rest(handle.locator(".bs-hold"))
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    browser.press(page, handle, x, y)
    for dx, dy in path:
        start = time.perf_counter()
        page.mouse.move(x + dx, y + dy)
        left = pause - (time.perf_counter() - start)
        if left > 0:
            time.sleep(left)
    page.mouse.up()
