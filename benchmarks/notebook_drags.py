"""The widget in JupyterLab under a hand: how fast the picture follows, and what is on its way.

    python -m benchmarks.notebook_drags --moves 240

A browser opens JupyterLab on a notebook whose cell shows the widget, and drags one pose along a
circle with real pointer events; server, kernel and browser share this machine's cores.  A picture's
time is from the pointer event whose task it answers to after its frame is painted.  Processor
times are those of all processes of the browser, of the kernel and of the server, for one picture:
they say what a picture costs where the machine is busy with other things.  In flight are follows
that were sent and not yet answered; superseded are those that a newer one made needless before they
were looked at.
"""

import argparse
import math
import os
import statistics
import tempfile
from collections import Counter

import psutil
from tests.oracles import browser, jupyter

CODE = """import burmester
from burmester.notebook import Studio
widget = Studio(burmester.read_task({task!r}))
widget"""


def processor_ms():
    """Processor time so far of the browser, the kernel and the server, in milliseconds."""
    spent = Counter()
    for process in psutil.Process().children(recursive=True):
        try:
            words, times = " ".join(process.cmdline()), process.cpu_times()
        except psutil.Error:
            continue  # it ended
        names = {"ipykernel": "kernel", "jupyterlab": "server", "chrom": "browser"}
        name = next((name for mark, name in names.items() if mark in words), "other")
        spent[name] += 1000 * (times.user + times.system)
    return spent


def measured(notebook, moves, radius):
    """A pose in the middle along a circle."""
    page = notebook.page
    page.wait_for_selector(".bn [data-linkage]")
    page.wait_for_timeout(1500)
    turns = [2 * math.pi * k / 120 for k in range(moves)]
    path = [(radius * math.sin(turn), radius - radius * math.cos(turn)) for turn in turns]
    page.evaluate("Object.assign(clock, { pictures: [], most: 0, sent: 0, superseded: 0 })")
    before = processor_ms()
    jupyter.drag(page, max(1, page.locator(".bn .bs-origin").count() // 2), path, 1 / 60)
    after = processor_ms()
    clock = page.evaluate("clock")
    times = [each for _, each in clock["pictures"]]
    span = (clock["pictures"][-1][0] - clock["pictures"][0][0]) / 1000
    return {
        "pictures": len(times),
        "pictures a second": len(times) / span,
        "median ms": statistics.median(times),
        "95 % ms": sorted(times)[math.ceil(0.95 * len(times)) - 1],
        **{
            f"{name} processor ms a picture": (after[name] - before[name]) / len(times)
            for name in ("browser", "kernel", "server")
        },
        "most in flight": clock["most"],
        "sent": clock["sent"],
        "superseded": clock["superseded"],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--task", default="case:ge2012-exact")
    parser.add_argument("--moves", type=int, default=240)
    parser.add_argument("--radius", type=float, default=25.0, help="pixels")
    given = parser.parse_args()
    code = CODE.format(task=given.task)
    print(f"{given.task}, {os.cpu_count()} cores")
    with (
        tempfile.TemporaryDirectory() as folder,
        browser.launched() as chromium,
        jupyter.notebook(chromium, folder, code, before=jupyter.CLOCK) as notebook,
    ):
        for name, value in measured(notebook, given.moves, given.radius).items():
            print(f"  {name}: {value:.1f}")


if __name__ == "__main__":
    main()
