"""How fast it is, each figure beside what it replaces in the same run.

Nothing here fails for being slow: the figures are there to be read, see README.md.
"""

import itertools
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from scipy.optimize import fsolve, least_squares
from tests.test_exact import as_rows, circle_equations
from tests.witness import span

from benchmarks.many_poses import TABLE_5, design, in_one_task, near_table_5
from burmester import best_dyads, critical_dyads, dyads_of_five, fit_pencil, synthesize
from burmester.io.poses import read_task

ONE = pytest.mark.benchmark(group="1. one pencil fit with both dyads, 10 poses of Table 5")
MILLION = pytest.mark.benchmark(group="2. one fit of a million poses")
FIVE = pytest.mark.benchmark(group="3. five poses, all four dyads, motiongen-shoulder")
STACK = pytest.mark.benchmark(group="5. tasks of ten poses, 100,000 in one call: time of one task")
BEST = pytest.mark.benchmark(group="7. every locally best RR dyad, 10 poses of Table 5")
COLD = pytest.mark.benchmark(group="6. a fresh interpreter")


def rows_of(poses):
    return np.column_stack([poses.translation, poses.angle])


# 1 ------------------------------------------------------------------------------------------


@ONE
def test_pencil(measure):
    measure("`fit_pencil`", fit_pencil, TABLE_5.poses, goal="0.5 ms")


@ONE
def test_pencil_bare_svd(measure):
    measure("NumPy's SVD of the design matrix, no dyads", np.linalg.svd, design(TABLE_5.poses))


@ONE
def test_pencil_before_the_paper(measure):
    """Levenberg and Marquardt on circles, from starts as good as a guess by eye can be."""
    rows = rows_of(TABLE_5.poses)
    starts = [[-2, 0, 1, 0, 1], [1, 1, 4, 1, 9]]  # Table 8 in whole numbers; r² comes last

    def fit():
        return [least_squares(circle_equations, v, args=(rows,), method="lm").x for v in starts]

    assert np.allclose(np.array(fit())[:, :4], np.array(starts)[:, :4], atol=0.6)
    measure("SciPy's LM on circles, from a good start for each dyad", fit)


@ONE
def test_whole_road(measure):
    measure("`synthesize`: the linkage and its pose errors, too", synthesize, TABLE_5)


# 2 ------------------------------------------------------------------------------------------


def peak_memory(method, count):
    """Of a fresh process in MB, see `many_poses`."""
    command = [sys.executable, "-m", "benchmarks.many_poses", method, str(count)]
    # A process inherits the peak of the one that starts it: the shell in between has little.
    shell = ["sh", "-c", '"$@" && exit', "sh", *command]
    done = subprocess.run(shell, check=True, capture_output=True, text=True)
    peak, before = map(int, done.stdout.split())
    return {"peak_MB": peak, "before_the_fit_MB": before}


@MILLION
def test_million(measure):
    memory, poses = peak_memory("pencil", 1_000_000), in_one_task(1_000_000)
    goal = "1 s, 500 MB"
    measure("`fit_pencil`, 1,000,000 poses", fit_pencil, poses, rounds=7, goal=goal, **memory)


@MILLION
@pytest.mark.parametrize(("kind", "count"), [("thin", 1_000_000), ("thin", 2_000), ("full", 2_000)])
def test_million_bare_svd(measure, kind, count):
    memory, whole = peak_memory(kind, count), design(in_one_task(count))
    what = f"NumPy's SVD of {count:,} x 8, {kind}, no dyads"
    measure(what, np.linalg.svd, whole, kind == "full", rounds=7, **memory)


# 3 ------------------------------------------------------------------------------------------


SHOULDER = read_task("case:motiongen-shoulder").poses


@FIVE
def test_five_poses(measure):
    measure("`dyads_of_five`", dyads_of_five, SHOULDER, goal="1 ms")


@FIVE
def test_five_poses_from_random_starts(measure, benchmark):
    """Until all four are met, which a solver without the answer could not know."""
    rows, known = rows_of(SHOULDER), as_rows(dyads_of_five(SHOULDER).dyads)
    seeds, starts = itertools.count(), []

    def search():
        rng, found = np.random.default_rng(next(seeds)), set()
        for count in itertools.count(1):
            start = rng.normal(scale=span(rows), size=5)
            start[4] **= 2
            root, _, status, _ = fsolve(circle_equations, start, (rows,), full_output=True)
            gap = np.abs(known[:, :4] - root[:4]).max(axis=1)
            if status == 1 and gap.min() < 1e-6:
                found.add(int(gap.argmin()))
            if len(found) == len(known):
                starts.append(count)
                return

    measure("SciPy's fsolve from random starts until all are met", search, rounds=100)
    benchmark.extra_info.update(searches=len(starts), median_starts=int(np.median(starts)))


# 5 ------------------------------------------------------------------------------------------


@STACK
def test_stack(measure):
    poses = near_table_5(100_000)
    measure("`fit_pencil`, one call", fit_pencil, poses, rounds=7, tasks=100_000, goal="15 µs")


@STACK
def test_stack_bare_svd(measure):
    whole, what = design(near_table_5(100_000)), "NumPy's SVD of the stack, no dyads"
    measure(what, np.linalg.svd, whole, False, rounds=7, tasks=100_000)


@STACK
def test_stack_in_a_loop(measure):
    tasks = [near_table_5(1_000)[i] for i in range(1_000)]
    what = "`fit_pencil` in a Python loop, 1,000 calls"
    measure(what, lambda: [fit_pencil(poses) for poses in tasks], rounds=7, tasks=1_000)


# 6 ------------------------------------------------------------------------------------------


MAIN_JOB = "from burmester import Task, synthesize; import burmester.io.poses, burmester.io.result"
COMMANDS = {
    '`python -c "import numpy"`': (["-c", "import numpy"], {}),
    "`python -c pass`": (["-c", "pass"], {}),
    "`import burmester` and its main job": (["-c", MAIN_JOB], {"goal": "0.1 s beyond NumPy"}),
    "`burmester --help`": (["-m", "burmester", "--help"], {"goal": "0.3 s"}),
    "`burmester synthesize CSV`, ten poses": (
        ["-m", "burmester", "synthesize", "CSV"],
        {"goal": "0.6 s"},
    ),
}


@COLD
@pytest.mark.parametrize("what", COMMANDS)
def test_cold(measure, benchmark, tmp_path, what):
    """Modules compiled, as an installer leaves them; the interpreter and all imports are new."""
    csv, rows, names = tmp_path / "poses.csv", rows_of(TABLE_5.poses), "x,y,angle_rad"
    np.savetxt(csv, rows, "%.4f", delimiter=",", header=names, comments="")
    env = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}

    def call(arguments):
        command = [sys.executable, *(str(csv) if word == "CSV" else word for word in arguments)]
        start = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True, env=env)
        return time.perf_counter() - start

    arguments, notes = COMMANDS[what]
    if MAIN_JOB in arguments and not benchmark.disabled:
        # In turns, so that what else the machine does in the meantime falls on both.
        beyond = [call(arguments) - call(["-c", "import numpy"]) for _ in range(21)]
        notes = {**notes, "milliseconds_beyond_NumPy": round(1e3 * float(np.median(beyond)), 1)}
    measure(what, call, arguments, rounds=21, **notes)


# 7 ------------------------------------------------------------------------------------------


@BEST
def test_every_critical_point(measure):
    """Once in every such process, before, 50 ms go into the pattern of the matrix."""
    found = critical_dyads(TABLE_5.poses)
    accounted = f"{found.found} of 25"
    measure("`critical_dyads`", critical_dyads, TABLE_5.poses, accounted_for=accounted)


@BEST
def test_best_by_distance(measure):
    measure("`best_dyads`: the minima, by true distance", best_dyads, TABLE_5.poses)


@BEST
def test_best_from_random_starts(measure):
    """A hundred starts of Levenberg and Marquardt, which prove nothing."""
    rows, rng = rows_of(TABLE_5.poses), np.random.default_rng(0)
    starts = np.column_stack([rng.normal(scale=3, size=(100, 4)), rng.uniform(1, 20, 100)])

    def fit():
        return [least_squares(circle_equations, v, args=(rows,), method="lm").x for v in starts]

    measure("SciPy's LM on circles from 100 random starts", fit, rounds=5)
