"""Processes killed while they write: the file is absent, old or new, and never anything else.

Run as a script for more: python -m tests.oracles.kill COUNT SEED [naive]
where `naive` writes as open() does, to see that the campaign notices half a file.
"""

from __future__ import annotations

import hashlib
import os
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

SIZES = (3_000_000, 2_000_000)

# Writes two contents in turn for ever; "new": under a name that it has freed before.
CHILD = """
import hashlib, os, sys
from burmester.io.files import write

def naive(path, data, force):
    with open(path, "wb" if force else "xb") as file:
        file.write(data)
        os.fsync(file.fileno())

path, how = sys.argv[1:3]
put = naive if "naive" in how else write
bodies = [bytes([k]) * int(size) for k, size in enumerate(sys.argv[3:])]
sealed = [body + hashlib.sha256(body).digest() for body in bodies]
sys.stdout.write("ready")
sys.stdout.flush()
while True:
    for data in sealed:
        if "new" in how and os.path.exists(path):
            os.unlink(path)
        put(path, data, force="new" not in how)
"""


def state(path: Path) -> str:
    """What a reader finds: "absent", "0" or "1" for the two contents, or "broken"."""
    if not path.exists():
        return "absent"
    data = path.read_bytes()
    body, seal = data[:-32], data[-32:]
    sound = hashlib.sha256(body).digest() == seal and len(body) in SIZES
    return str(body[0]) if sound else "broken"


def campaign(count: int, seed: int, folder: Path, naive: bool = False) -> Counter[str]:
    """How often each state was found after a kill, and how many temporary files were left.

    Two children at a time, one with new names and one with a file to replace.
    """
    dice, found = random.Random(seed), Counter[str]()
    hows = [how + ("-naive" if naive else "") for how in ("new", "again")]
    for _ in range(count // 2):
        children = [_start(folder / how, how) for how in hows]
        for child in children:
            time.sleep(dice.uniform(0, 0.02))
            child.kill()
        for child, how in zip(children, hows, strict=True):
            child.communicate()
            found[state(folder / how)] += 1
        found["left over"] += len(leftovers(folder))
        for each in leftovers(folder):
            os.utime(each, (0, 0))  # of long ago: the next write is to sweep it
    return found


def _start(path: Path, how: str) -> subprocess.Popen[bytes]:
    """A child that is about to write."""
    command = [sys.executable, "-c", CHILD, str(path), how, *map(str, SIZES)]
    child = subprocess.Popen(command, stdout=subprocess.PIPE)
    assert child.stdout is not None
    assert child.stdout.read(5) == b"ready"
    return child


def leftovers(folder: Path) -> list[Path]:
    """The temporary files in a folder."""
    return sorted(folder.glob(".burmester-*"))


if __name__ == "__main__":
    COUNT, SEED = int(sys.argv[1]), int(sys.argv[2])
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as here:
        print(dict(campaign(COUNT, SEED, Path(here), "naive" in sys.argv)), end=" ")
        print(f"{len(leftovers(Path(here)))} left at the end")
    print(f"{time.monotonic() - begun:.1f} s")
