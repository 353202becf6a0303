"""Commands that are stopped by a signal at a random moment, once or twice.

`python -m benchmarks.stopped --count 120 --seed 1` runs every export and the other commands that
write in turn.  A stopped command leaves no file that is not whole and no temporary one, says
nothing about itself that only its authors understand, and exits with the code of the signal; one
that was faster exits as usual.  How long it takes from the signal to the end of the process is
told, by command.
"""

import argparse
import math
import os
import random
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from burmester.export import FORMATS
from burmester.io import templates

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")
CODES = {
    getattr(signal, name): 128 + getattr(signal, name) for name in _NAMES if hasattr(signal, name)
}
# As the script of an installed package starts it.
HARD = {"limits": "lid-hinge", "family": "derailleur", "surroundings": "robot-intake"}
START = "from burmester.__main__ import main; main()"
# Python itself was not there yet, or was loading what handles signals, and has its own words.
EARLY = re.compile(r"<frozen site>|signals\.py\", line \d+, in <module>")
LATE_S = 0.2  # seconds; an end that takes longer is told
INTERNAL = re.compile(r"Traceback|Exception ignored|E900|KeyboardInterrupt|\.burmester-")


class Stopped(NamedTuple):
    """What came of one command: what is wrong with it, and whether the signal was in time.

    at, ended: seconds from the start to the signal, and from the signal to the end; cpu: seconds of
    the processor in the latter, which other work on the machine does not change.
    """

    command: str
    faults: tuple[str, ...]
    in_time: bool
    said: str
    at: float
    ended: float
    cpu: float


def commands(result, folder="."):
    """The commands that write, each with the name of its file."""
    found = {
        name: (["export", str(result), "--to", name], f"x{form.suffix}")
        for name, form in FORMATS.items()
    }
    found["synthesize"] = (["synthesize", "case:motiongen-shoulder"], "x.json")
    found["report"] = (["report", "case:motiongen-shoulder"], "x.html")
    for what, template in HARD.items():
        file = Path(folder) / f"{template}.toml"
        file.write_text(templates.text(template))
        found[what] = (["synthesize", str(file)], "x.json")
    found["tolerance"] = (
        ["synthesize", "case:ge2012-approximate", "--tolerance", "0.05", "--round", "0.1"],
        "x.json",
    )
    return found


def run(arguments, **streams):
    """The command as a process."""
    return subprocess.Popen([sys.executable, "-c", START, *arguments], **streams)


def stopped(name, arguments, wrote, number, *, seconds, again=None):
    """Send a signal after some seconds, and after `again` more seconds a second one."""
    import resource  # noqa: PLC0415  only systems as POSIX has them

    folder = wrote.parent
    process = run(
        [*arguments, "-o", str(wrote)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    time.sleep(seconds)
    in_time = process.poll() is None
    sent, spent = time.monotonic(), cpu_seconds(process.pid)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    if in_time:
        process.send_signal(number)
        if again is not None:
            time.sleep(again)
            process.send_signal(number)
    out, err = process.communicate(timeout=120)
    ended, after = time.monotonic() - sent, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime - spent
    if EARLY.search(err):
        return Stopped(name, (), False, err, seconds, ended, cpu)
    faults = []
    code = process.returncode
    # Before the first line of Python runs, and after the last, the system's own way is taken.
    ends = (CODES[number], -number) if in_time else ()
    if code not in (0, 1, *ends):
        faults.append(f"exit code {code}")
    if found := INTERNAL.search(out + err):
        faults.append(f"says {found[0]}")
    if list(folder.glob(".burmester-*")):
        faults.append("left a temporary file")
    for each in folder.glob(".burmester-*"):
        each.unlink()
    if code in (0, 1) and not wrote.exists():
        faults.append("no file, and no error")
    if wrote.exists() and not wrote.stat().st_size:
        faults.append("an empty file")
    wrote.unlink(missing_ok=True)
    in_time = in_time and code == CODES[number]
    return Stopped(name, tuple(faults), in_time, err, seconds, ended, cpu)


def cpu_seconds(pid):
    """Seconds of the processor that a running process has had; nan where nobody tells."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return math.nan
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def campaign(count, seed, names=None, *, longest=1.0, once=False):
    """As many stopped commands.

    longest: of the usual time, the latest moment of the signal; once: always SIGINT, and no second
    signal, as a single Ctrl-C is.
    """
    dice = random.Random(seed)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        result = folder / "result.json"
        run(
            ["synthesize", "case:ge2012-exact", "-o", str(result)], stdout=subprocess.DEVNULL
        ).wait()
        known = commands(result, folder)
        usual = {}
        for k in range(count):
            name = (names or list(known))[k % len(names or known)]
            arguments, file = known[name]
            if name not in usual:
                begun = time.monotonic()
                run([*arguments, "-o", str(folder / file)], stdout=subprocess.DEVNULL).wait()
                usual[name] = time.monotonic() - begun
                (folder / file).unlink()
            number = signal.SIGINT if once else dice.choice(list(CODES))
            seconds = dice.uniform(0.02, longest * usual[name])
            again = None if once else dice.choice((None, dice.uniform(0, 0.05)))
            yield stopped(name, arguments, folder / file, number, seconds=seconds, again=again)


def main():
    """Print a line a fault, the counts, and how long the ends took."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=120)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append")
    parser.add_argument("--once", action="store_true", help="a single Ctrl-C each")
    given = parser.parse_args()
    counts, ended = Counter(), {}
    for each in campaign(given.count, given.seed, given.only, once=given.once):
        counts["commands"] += 1
        counts["stopped"] += each.in_time
        for fault in each.faults:
            counts[fault] += 1
            print(f"{each.command}: {fault}\n{each.said}", flush=True)
        if each.in_time:
            ended.setdefault(each.command, []).append((each.ended, each.cpu))
            if each.ended > LATE_S:
                print(f"{each.command}: {each.ended:.2f} s after {each.at:.2f} s", flush=True)
    print(dict(counts))
    print("\n| command | stopped | median | worst | CPU, median | worst |")
    print("|---|--:|--:|--:|--:|--:|")
    for name, ends in sorted(ended.items(), key=lambda pair: max(pair[1])):
        figures = [
            f"{1e3 * of(each):.0f} ms"
            for each in zip(*ends, strict=True)
            for of in (statistics.median, max)
        ]
        print(f"| {name} | {len(ends)} | {' | '.join(figures)} |")


if __name__ == "__main__":
    main()
