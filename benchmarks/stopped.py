"""Commands that are stopped by a signal at a random moment, once or twice.

`python -m benchmarks.stopped --count 120 --seed 1` runs every export and the other commands that
write in turn.  A stopped command leaves no file that is not whole and no temporary one, says
nothing about itself that only its authors understand, and exits with the code of the signal; one
that was faster exits as usual.  How long it takes from the signal to the end of the process is
told, by command.
"""

import argparse
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from burmester.export import FORMATS

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")
CODES = {
    getattr(signal, name): 128 + getattr(signal, name) for name in _NAMES if hasattr(signal, name)
}
# As the script of an installed package starts it.
START = "from burmester.__main__ import main; main()"
EARLY = "<frozen site>"  # Python itself was not there yet, and has its own words
INTERNAL = re.compile(r"Traceback|Exception ignored|E900|KeyboardInterrupt|\.burmester-")


class Stopped(NamedTuple):
    """What came of one command: what is wrong with it, and whether the signal was in time.

    at, ended: seconds from the start to the signal, and from the signal to the end.
    """

    command: str
    faults: tuple[str, ...]
    in_time: bool
    said: str
    at: float
    ended: float


def commands(result):
    """The commands that write, each with the name of its file."""
    found = {
        name: (["export", str(result), "--to", name], f"x{form.suffix}")
        for name, form in FORMATS.items()
    }
    found["synthesize"] = (["synthesize", "case:motiongen-shoulder"], "x.json")
    found["report"] = (["report", "case:motiongen-shoulder"], "x.html")
    return found


def run(arguments, **streams):
    """The command as a process."""
    return subprocess.Popen([sys.executable, "-c", START, *arguments], **streams)


def stopped(name, arguments, wrote, number, *, seconds, again=None):
    """Send a signal after some seconds, and after `again` more seconds a second one."""
    folder = wrote.parent
    process = run(
        [*arguments, "-o", str(wrote)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    time.sleep(seconds)
    in_time = process.poll() is None
    if in_time:
        process.send_signal(number)
        if again is not None:
            time.sleep(again)
            process.send_signal(number)
    out, err = process.communicate(timeout=120)
    if EARLY in err:
        return Stopped(name, (), False, err)
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
    return Stopped(name, tuple(faults), in_time and code == CODES[number], err)


def campaign(count, seed, names=None, *, longest=1.0):
    """As many stopped commands; `longest`: of the usual time, the latest moment of the signal."""
    dice = random.Random(seed)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        result = folder / "result.json"
        run(
            ["synthesize", "case:ge2012-exact", "-o", str(result)], stdout=subprocess.DEVNULL
        ).wait()
        known = commands(result)
        usual = {}
        for k in range(count):
            name = (names or list(known))[k % len(names or known)]
            arguments, file = known[name]
            if name not in usual:
                begun = time.monotonic()
                run([*arguments, "-o", str(folder / file)], stdout=subprocess.DEVNULL).wait()
                usual[name] = time.monotonic() - begun
                (folder / file).unlink()
            number = dice.choice(list(CODES))
            seconds = dice.uniform(0.02, longest * usual[name])
            again = dice.choice((None, dice.uniform(0, 0.05)))
            yield stopped(name, arguments, folder / file, number, seconds=seconds, again=again)


def main():
    """Print a line a fault, and the counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=120)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append")
    given = parser.parse_args()
    counts = Counter()
    for each in campaign(given.count, given.seed, given.only):
        counts["commands"] += 1
        counts["stopped"] += each.in_time
        for fault in each.faults:
            counts[fault] += 1
            print(f"{each.command}: {fault}\n{each.said}", flush=True)
    print(dict(counts))


if __name__ == "__main__":
    main()
