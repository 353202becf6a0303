"""Batches that are killed at random times and begun again: what is left, and how it ends.

    python -m benchmarks.batch_kills [COUNT] [SEED]

A run is killed at a moment between its start and the time that a whole one takes; its workers see
to their own end.  After each kill every part in the folder must be whole, byte by byte that of a
run that nothing happened to, and the next run goes on in the same folder.  After so many kills a
run comes to its end, the folder must be the same as that of an unbroken run, and another one is
begun.
"""

from __future__ import annotations

import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from tests.oracles.batches import as_table, files_of, rows

TASKS, PART_TASKS = 40, 2
OFTEN = 10  # kills, then a run may come to its end


def command(tasks: Path, out: Path, *arguments: str) -> list[str]:
    """A batch as a command line."""
    line = [sys.executable, "-m", "burmester", "batch", str(tasks), "-o", str(out)]
    return [*line, *arguments]


def strays(out: Path) -> list[str]:
    """Files that no batch leaves in its folder."""
    known = (".lock", "_manifest.json", "_parts.jsonl")
    names = (each.name for each in out.iterdir()) if out.exists() else ()
    return [
        name
        for name in names
        if name not in known and not (name.startswith("part-") and name.endswith(".parquet"))
    ]


def campaign(count: int, seed: int, folder: Path) -> Counter[str]:
    """So many kills, and how often each thing was found after them.

    half files: parts that are not those of the unbroken run; other bytes: folders that ended
    otherwise; left behind: temporary files at the end of a run; unfinished: kills in time.
    """
    dice, found = random.Random(seed), Counter[str]()
    tasks, out = folder / "tasks.csv", folder / "out"
    tasks.write_text(as_table(rows(TASKS)))
    arguments = ["--depth", "pencil", "--part-tasks", str(PART_TASKS), "--workers", "1"]
    begun = time.monotonic()
    _ended(command(tasks, folder / "whole", *arguments))
    seconds = time.monotonic() - begun
    whole = files_of(folder / "whole")
    often = 0
    while found["kills"] < count:
        process = subprocess.Popen(
            command(tasks, out, *arguments),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            process.wait(dice.uniform(0.2, 0.9) * seconds)
        except subprocess.TimeoutExpired:
            _kill(process)
            found["unfinished"] += 1
        found["kills"] += 1
        often += 1
        found["half files"] += _differing(out, whole)
        if often >= OFTEN or found["kills"] == count:
            _ended(command(tasks, out, *arguments))
            found["other bytes"] += files_of(out) != whole
            found["left behind"] += len(strays(out))
            shutil.rmtree(out)
            often = 0
    return found


def _differing(out: Path, whole: dict[str, bytes]) -> int:
    """How many parts are not those of the unbroken run."""
    parts = out.glob("part-*.parquet")
    return sum(each.read_bytes() != whole.get(each.name) for each in parts)


def _kill(process: subprocess.Popen[bytes]) -> None:
    """Kill the run alone, or with its workers: who goes first is left to chance."""
    process.kill()
    process.wait()


def _ended(line: list[str]) -> None:
    subprocess.run(line, check=True, capture_output=True, timeout=300)


if __name__ == "__main__":
    COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 20261123
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as here:
        told = campaign(COUNT, SEED, Path(here))
    print(", ".join(f"{name} {number}" for name, number in told.items()))
    print(f"{time.monotonic() - started:.0f} s, process {os.getpid()}")
