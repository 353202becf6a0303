"""Time and peak memory of commands on inputs that are larger than anybody needs.

`python -m benchmarks.bounded` makes each input, runs the command on it, and prints a row of the
table in README.md; `--only NAME` takes one.  The bounds that refuse what is larger stand in
`io/reading/file_content` and `export/films/film`.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.many_poses import in_one_task


class Measured(NamedTuple):
    """What a command took: its exit code, seconds, and megabytes at most."""

    code: int
    seconds: float
    peak: float


def noisy(count):
    """Poses near those of Table 5, as CSV."""
    poses = in_one_task(max(count, 10))[:count]
    rows = np.column_stack([poses.translation, np.degrees(poses.angle)])
    return "x,y,angle_deg\n" + "".join("{:.4f},{:.4f},{:.4f}\n".format(*row) for row in rows)


def as_json(count):
    """The same as JSON."""
    rows = ",".join(f"[{line}]" for line in noisy(count).splitlines()[1:])
    return f'{{"angle_unit": "deg", "poses": [{rows}]}}'


INPUTS = {  # name: the file, what makes it, the command on it
    "10,000 poses": ("a.csv", lambda: noisy(10_000), ["synthesize", "a.csv"]),
    "10,000 poses, the pencil": (
        "a.csv",
        lambda: noisy(10_000),
        ["synthesize", "a.csv", "--method", "pencil"],
    ),
    "100,000 poses": ("a.csv", lambda: noisy(100_000), ["synthesize", "a.csv"]),
    "100,000 poses, checked": ("a.csv", lambda: noisy(100_000), ["check", "a.csv"]),
    "1,000,000 poses": ("a.csv", lambda: noisy(1_000_000), ["synthesize", "a.csv"]),
    "1,000,000 poses, checked": ("a.csv", lambda: noisy(1_000_000), ["check", "a.csv"]),
    "400,000 poses in JSON, checked": ("a.json", lambda: as_json(400_000), ["check", "a.json"]),
    "1,000,000 poses in JSON": ("a.json", lambda: as_json(1_000_000), ["check", "a.json"]),
    "3,000,000 rows": (
        "a.csv",
        lambda: "x,y,angle_deg\n" + "1,2,3\n" * 3_000_000,
        ["check", "a.csv"],
    ),
    "a file of 1 GB": ("a.csv", None, ["check", "a.csv"]),
    "500,000 columns": (
        "a.csv",
        lambda: "x,y,angle_deg" + ",c" * 500_000 + "\n1,2,3" + ",4" * 500_000 + "\n",
        ["check", "a.csv"],
    ),
    "one line of 40 MB": ("a.csv", lambda: "x" * 40_000_000, ["check", "a.csv"]),
    "brackets 10,000,000 deep": ("a.json", lambda: "[" * 10_000_000, ["check", "a.json"]),
    "a polygon of 100,000 corners": (
        "a.json",
        lambda: (
            as_json(10)[:-1]
            + ', "limits": {"fixed_pivot": {"polygon": ['
            + ",".join(f"[{k}, {k * k}]" for k in range(100_000))
            + "]}}}"
        ),
        ["synthesize", "a.json"],
    ),
}


# A process counts the peak of the one that starts it as its own: so a small one starts the command.
STARTED = """
import os, subprocess, sys
silent = subprocess.DEVNULL
process = subprocess.Popen(sys.argv[1:], stdout=silent, stderr=silent)
_, status, used = os.wait4(process.pid, 0)
process.returncode = os.waitstatus_to_exitcode(status)
print(process.returncode, used.ru_maxrss)
"""


def measured(arguments, folder):
    """Run a command and wait for it."""
    command = [sys.executable, "-m", "burmester", *arguments]
    begun = time.monotonic()
    done = subprocess.run(
        [sys.executable, "-c", STARTED, *command],
        cwd=folder,
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    code, peak = map(int, done.stdout.split())
    return Measured(code, time.monotonic() - begun, peak * 1024 / 1e6)  # kibibytes on Linux


def of(name):
    """One of `INPUTS`, made and measured."""
    file, _, arguments = INPUTS[name]
    with tempfile.TemporaryDirectory() as folder:
        # By a process of its own: the peak of this one would count as that of its children.
        make = [sys.executable, "-m", "benchmarks.bounded", "--make", str(Path(folder, file))]
        subprocess.run([*make, "--only", name], check=True, cwd=Path(__file__).parents[1])
        return measured(arguments, folder)


def made(name, path):
    """Write the file of one of `INPUTS`."""
    text = INPUTS[name][1]
    if text is None:
        with open(path, "wb") as sparse:
            sparse.truncate(1_000_000_000)
    else:
        Path(path).write_text(text())


def main():
    """Print a row an input."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", action="append")
    parser.add_argument("--make", metavar="FILE", help="only write the input")
    given = parser.parse_args()
    for name in given.only or INPUTS:
        if given.make:
            made(name, given.make)
            continue
        found = of(name)
        print(
            f"| {name} | {found.seconds:.1f} s | {found.peak:.0f} MB | {found.code} |", flush=True
        )


if __name__ == "__main__":
    main()
