"""How fast it is, each figure beside the same code at an earlier commit.

    python -m benchmarks.speed --before /path/to/before/.venv/bin/python
    python -m benchmarks.speed --before ... --only lid-hinge --only hard --rounds 5

`--before` is the Python of another checkout, installed in a virtual environment of its own (see
README.md).  Each figure is the median over rounds.  In a round a fresh process of either side
measures the task (`speed_worker`), before and after by turns, on one core and with one BLAS
thread.  What is slow has fewer rounds: they are told.  Times are CPU seconds of one call of
`synthesize`; only those of commands are seconds by the clock.

Of the hard tasks the median over the tasks counts, and the greatest ratio of the least sums of
squares of a linkage that works, after to before: above 1 something got worse.
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from tests.oracles.hard_tasks import noisy_task, rough_task
from tests.oracles.witness import places

from benchmarks.few_poses import file_of
from burmester.fourbar.dyad import RR
from burmester.io import templates

WORKER = Path(__file__).with_name("speed_worker.py")
OLDER = ("lid-hinge", "tailgate", "gripper", "folding-table", "prosthetic-knee", "landing-gear")
CORNERS = 16  # of both polygons
LEAST_ROUNDS = 3
HARD_TASKS, FEW_TASKS = 20, 5  # number of hard tasks, and of each number of few poses
MOST_S = 600.0  # seconds; a process that takes longer is stopped
ROUNDING = 1e-12  # of a combined error; what is nearer meets the poses
MOST_BEFORE = 10_000  # poses; more were refused before


class Row(NamedTuple):
    """What is measured: its tasks as files or `case:NAME`, or a command on one of them.

    goal: in seconds; group: rows whose median is told as well; alone: not measured before; nearer:
    whether it is told how much nearer the linkages come.
    """

    name: str
    tasks: tuple[str, ...]
    goal: float | None = None
    group: str = ""
    cold: bool = False
    alone: bool = False
    nearer: bool = False


def rows_in(folder):
    """All rows, with their files in a folder."""

    def written(name, text):
        path = Path(folder) / name
        path.write_text(text)
        return (str(path),)

    out = [
        Row("ten poses (ge2012-exact)", ("case:ge2012-exact",), 0.03),
        Row("twelve linkages of five kinds (motiongen-rrrp)", ("case:motiongen-rrrp",), 0.06),
        Row("five poses and a search (motiongen-mixed5)", ("case:motiongen-mixed5",), 0.25),
        Row("five poses and a search (motiongen-shoulder)", ("case:motiongen-shoulder",)),
        Row("ten rough poses (ge2012-approximate)", ("case:ge2012-approximate",)),
    ]
    for name in OLDER:
        file = written(f"{name}.toml", templates.text(name))
        five = name == "folding-table"
        told = f"{name}, five poses" if five else name
        out.append(Row(told, file, 0.01 if five else None, group="templates"))
    out += [
        Row("two polygons of 16 corners", written("polygons.toml", two_polygons()), 2.0),
        Row("exact poses and limits", written("exact.toml", exact_and_limits())),
        Row("hard tasks", hard_tasks(written), 0.3, nearer=True),
    ]
    for count, goal in ((60, 2.0), (1000, 5.0), (100_000, 15.0)):
        for what, poses in (("measured", recorded), ("measured, by hand", by_hand)):
            file = written(f"{poses.__name__}-{count}.csv", poses(count))
            out.append(Row(f"{count:,} poses {what}", file, goal, alone=count > MOST_BEFORE))
    for k, count in enumerate(("two", "three", "four")):
        some = [written(f"{count}-{s}.toml", file_of(s)) for s in range(k, k + 3 * FEW_TASKS, 3)]
        out.append(Row(f"{count} poses with boxes", tuple(file for (file,) in some)))
    out.append(
        Row("`burmester synthesize`, ten poses, cold", ("case:ge2012-exact",), 0.25, cold=True)
    )
    return out


def table(rows, digits=17):
    """Rows x, y, angle in radians as CSV."""
    lines = [",".join(f"{value:.{digits}g}" for value in row) for row in rows]
    return "\n".join(["x,y,angle_rad", *lines, ""])


def recorded(count):
    """A body on a crank-rocker, recorded with an error of 0.05 in lengths of 100 and more."""
    rng = np.random.default_rng(count)
    crank, rocker = (
        RR(np.array([0.0, 0.0]), np.array([0.0, 0.0]), 100.0),
        RR(np.array([400.0, 0.0]), np.array([350.0, 20.0]), 250.0),
    )
    where, angle = (part[0] for part in places(crank, rocker, np.linspace(0.3, 2.5, count)))
    rows = np.column_stack([where.real, where.imag, np.unwrap(angle)])
    return measured(rows + rng.normal(size=rows.shape) * [0.05, 0.05, 0.0004])


def by_hand(count):
    """A body moved by hand on a smooth way, recorded alike: no four-bar leads along it."""
    rng, t = np.random.default_rng(count), np.linspace(0, 1, count)
    x = 300 * np.cos(2.1 * t) + 50 * t**3
    y = 100 * np.sin(3.3 * t + 0.5) + 70 * np.sin(7 * t)
    rows = np.column_stack([x, y, 1.2 * np.sin(2.5 * t) + 0.3 * np.cos(6 * t)])
    return measured(rows + rng.normal(size=rows.shape) * [0.5, 0.5, 0.002])


def measured(rows):
    """Rows x, y, angle in radians as CSV, as a camera gives them."""
    lines = [f"{x:.3f},{y:.3f},{np.degrees(turn):.3f}" for x, y, turn in rows]
    return "\n".join(["x,y,angle_deg", *lines, ""])


def eight_poses():
    """Eight places of a four-bar a hundredth off, as the lines of a TOML array."""
    rng = np.random.default_rng(8)
    rows, _ = noisy_task(rng, 8, noise=0.01)
    rows = rows * [100, 100, 1]
    return rows, [f"[{x:.3f}, {y:.3f}, {np.degrees(turn):.3f}]" for x, y, turn in rows]


def corners(middle, radius):
    """The corners of a regular polygon, as TOML."""
    angle = 2 * np.pi * (np.arange(CORNERS) + 0.3) / CORNERS
    points = middle + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return ", ".join(f"[{x:.3f}, {y:.3f}]" for x, y in points)


def two_polygons():
    """Eight poses, and a regular polygon of 16 corners for either pivot."""
    rows, lines = eight_poses()
    size = np.ptp(rows[:, :2], axis=0).max()
    fixed, moving = rows[:, :2].mean(axis=0), np.zeros(2)
    return (
        f'angle_unit = "deg"\nposes = [{", ".join(lines)}]\n[limits]\n'
        f"fixed_pivot = {{ polygon = [{corners(fixed, size)}] }}\n"
        f"moving_pivot = {{ polygon = [{corners(moving, 0.7 * size)}] }}\n"
    )


def exact_and_limits():
    """Eight poses, two of them exact, with boxes for both pivots and bounds of the length."""
    rows, lines = eight_poses()
    size = float(np.ptp(rows[:, :2], axis=0).max())
    (x, y), lines = rows[:, :2].mean(axis=0), list(lines)
    for k in (0, 7):
        values = lines[k].strip("[]").split(", ")
        names = zip(("x", "y", "angle"), values, strict=True)
        lines[k] = f"{{ {', '.join(f'{a} = {b}' for a, b in names)}, exact = true }}"
    low, high = f"[{x - size:.3f}, {y - size:.3f}]", f"[{x + size:.3f}, {y + size:.3f}]"
    return (
        f'angle_unit = "deg"\nposes = [{", ".join(lines)}]\n[limits]\n'
        f"fixed_pivot = {{ box = [{low}, {high}] }}\n"
        f"moving_pivot = {{ box = [[{-size:.3f}, {-size:.3f}], [{size:.3f}, {size:.3f}]] }}\n"
        f"length = {{ least = {size / 4:.3f}, most = {4 * size:.3f} }}\n"
    )


def hard_tasks(written):
    """Tasks of `benchmarks/hard_tasks.py`: noisy and rough, five and eight poses by turns."""
    out = []
    for k in range(HARD_TASKS):
        draw, count = (noisy_task, rough_task)[k % 2], (5, 8)[k // 2 % 2]
        rows, _ = draw(np.random.default_rng(k // 4), count)
        out += written(f"hard-{k}.csv", table(rows))
    return tuple(out)


def environment(python):
    """Of a process of one side: one BLAS thread, and sources by path for this side only."""
    out = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    if python != sys.executable:
        out.pop("PYTHONPATH", None)
    return out


def process_of(row, python):
    """What one process measures of a row: a list of figures, one a task."""
    if row.cold:
        command = [python, "-m", "burmester", "synthesize", *row.tasks]
        begun = time.perf_counter()
        subprocess.run(
            command, env=environment(python), stdout=subprocess.DEVNULL, check=True, cwd="/"
        )
        return [{"seconds": time.perf_counter() - begun}]
    try:
        done = subprocess.run(
            [python, str(WORKER), *row.tasks],
            env=environment(python),
            stdout=subprocess.PIPE,
            text=True,
            check=True,
            cwd="/",
            timeout=MOST_S,
        )
    except subprocess.TimeoutExpired:
        return [{"error": f"not in {MOST_S:.0f} s"}]
    return [json.loads(line) for line in done.stdout.splitlines()]


class Measured(NamedTuple):
    """The median seconds of a side over rounds, and the figures of its last process."""

    seconds: float
    last: list
    rounds: int

    @property
    def error(self):
        """The code of an error that refused the task, or None."""
        return next((each["error"] for each in self.last if "error" in each), None)


def by_turns(row, pythons, most_rounds, budget):
    """Each side measured by turns; as many rounds as the budget in seconds allows.

    Three at least, but one where that alone is more than the budget.
    """
    pythons = pythons[-1:] if row.alone else pythons
    seconds, last, rounds = [[] for _ in pythons], [None] * len(pythons), 0
    begun = time.perf_counter()
    while rounds < most_rounds:
        for side, python in enumerate(pythons):
            last[side] = process_of(row, python)
            if not any("error" in each for each in last[side]):
                seconds[side].append(statistics.median(each["seconds"] for each in last[side]))
        rounds += 1
        spent = time.perf_counter() - begun
        least = 1 if spent / rounds > budget else LEAST_ROUNDS
        if rounds >= least and spent + spent / rounds > budget:
            break
    every = zip(seconds, last, strict=True)
    return [Measured(statistics.median(s) if s else math.nan, one, rounds) for s, one in every]


def shown(seconds):
    """Seconds with their unit, three digits."""
    if math.isnan(seconds):
        return ""
    return f"{seconds:.3g} s" if seconds >= 1 else f"{1e3 * seconds:.3g} ms"


def notes(row, sides):
    """What stands beside the times: what came back, how much memory, how much worse or better."""
    if row.cold:
        return "by the clock"
    if sides[-1].error is not None:
        return ""
    sides = [side for side in sides if side.error is None]
    after, out = sides[-1].last, []
    if len(after) > 1:
        usable = [sum(each["usable"] > 0 for each in side.last) for side in sides]
        out.append(f"{' and '.join(map(str, dict.fromkeys(usable)))} of {len(after)} have one")
        times = [each["seconds"] for each in after]
        out.append(f"slowest {shown(max(times))}")
        if len(sides) > 1 and row.nearer:
            both = zip(sides[0].last, after, strict=True)
            ratios = [
                (max(b["least"], ROUNDING) / max(a["least"], ROUNDING)) ** 2
                for a, b in both
                if math.isfinite(a["least"])
            ]
            out.append(f"squares at worst {max(ratios):.3g} times, at best {min(ratios):.3g}")
    else:
        kept = dict.fromkeys((side.last[0]["usable"], side.last[0]["linkages"]) for side in sides)
        out.append(", then ".join(f"{usable} of {count} usable" for usable, count in kept))
        if row.alone:
            out.append(f"peak {after[0]['peak_MB']:.0f} MB")
    return ", ".join(out)


def line(name, goal, sides, beside):
    """One line of the table; sides: seconds, or what stands in their place."""
    before, after = sides if len(sides) == 2 else ("", *sides)
    told = ""
    if isinstance(before, float) and isinstance(after, float):
        told = f"{after / before:.2f}"
    cells = [shown(each) if isinstance(each, float) else each for each in (before, after)]
    limit = "" if goal is None else shown(goal)
    return f"| {name} | {limit} | {cells[0]} | {cells[1]} | {told} | {beside} |"


def pinned():
    """Keep this process and those that it starts to one core, where that can be said."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def main():
    """Print the table, a line when it is measured."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--before", metavar="PYTHON", help="the Python of the earlier checkout")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--budget", type=float, default=60.0, help="seconds a row, about")
    parser.add_argument("--only", action="append", help="rows whose name holds this")
    given = parser.parse_args()
    pythons = [*([given.before] if given.before else []), sys.executable]
    pinned()
    print("| what | goal | before | after | ratio | beside it |\n|---|--:|--:|--:|--:|---|")
    groups = {}
    with tempfile.TemporaryDirectory() as folder:
        for row in rows_in(folder):
            if given.only and not any(each in row.name for each in given.only):
                continue
            sides = by_turns(row, pythons, given.rounds, given.budget)
            cells = [side.error or side.seconds for side in sides]
            beside = notes(row, sides)
            if sides[0].rounds < given.rounds:
                beside += f"; {sides[0].rounds} {'rounds' if sides[0].rounds > 1 else 'round'}"
            print(line(row.name, row.goal, cells, beside), flush=True)
            if row.group:
                groups.setdefault(row.group, []).append([side.seconds for side in sides])
    for name, every in groups.items():
        medians = [statistics.median(side) for side in zip(*every, strict=True)]
        print(line(f"median of the {len(every)} {name}", 0.15, medians, ""), flush=True)


if __name__ == "__main__":
    main()
