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
from tests.oracles.conics import as_rows, circle_equations
from tests.oracles.witness import span

from benchmarks.bounded import measured
from benchmarks.few_poses import brute_force, file_of
from benchmarks.many_poses import TABLE_5, design, in_one_task, near_table_5
from burmester import best_dyads, critical_dyads, dyads_of_five, fit_pencil, synthesize
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.io.reading.poses import read_task

ONE = pytest.mark.benchmark(group="1. one pencil fit with both dyads, 10 poses of Table 5")
MILLION = pytest.mark.benchmark(group="2. one fit of a million poses")
FIVE = pytest.mark.benchmark(group="3. five poses, all four dyads, motiongen-shoulder")
STACK = pytest.mark.benchmark(group="5. tasks of ten poses, 100,000 in one call: time of one task")
BEST = pytest.mark.benchmark(group="7. every locally best RR dyad, 10 poses of Table 5")
PEERS = pytest.mark.benchmark(group="9. all RR, PR and RP dyads, 10 poses of Table 5, and peers")
FEW = pytest.mark.benchmark(group="32. two, three and four poses with boxes, beside brute force")
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
    what = "`synthesize`: all dyads, every pair refined, judged and ranked"
    measure(what, synthesize, TABLE_5, goal="60 ms")


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


MAIN_JOB = (
    "from burmester import Task, synthesize; import burmester.io.reading.poses, burmester.io.result"
)
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


# 9 ------------------------------------------------------------------------------------------


def peer(name):
    """Another package, or a skip that says how to have it."""
    return pytest.importorskip(name, reason=f"{name} is not installed: see benchmarks/README.md")


def nearest(pairs, poses):
    """The least worst position error, in the task's unit, among linkages of pairs of dyads."""
    errors = [PoseError.of(Linkage(*pair), poses, 1.0).worst for pair in pairs]
    return {"linkages": len(errors), "worst_position_error": f"{min(errors, default=np.inf):.2g}"}


@PEERS
def test_all_dyads(measure):
    poses, fit = TABLE_5.poses, best_dyads(TABLE_5.poses)
    pairs = itertools.combinations([fit.dyads[k] for k in range(len(fit.rms_error))], 2)
    what = "`best_dyads`: all RR, the best PR and RP"
    measure(what, best_dyads, poses, goal="8 ms", **nearest(pairs, poses))


@PEERS
def test_all_dyads_of_the_pencil(measure):
    poses, fit = TABLE_5.poses, fit_pencil(TABLE_5.poses)
    pair = [fit.dyads[k] for k in np.flatnonzero(np.isfinite(fit.rms_error))]
    pairs = itertools.combinations(pair, 2)
    measure("`fit_pencil`, its dyads", fit_pencil, poses, **nearest(pairs, poses))


@PEERS
@pytest.mark.parametrize("count", [5, 10])
def test_pylinkage(measure, count):
    """It takes 3 to 5 poses, and the first 5 of more."""
    synthesis, poses = peer("pylinkage.synthesis"), TABLE_5.poses[:count]
    rows = [synthesis.Pose(*map(float, row)) for row in rows_of(poses)]
    first, pairs = poses[0].inverse(), []
    for four_bar in synthesis.motion_generation(rows).raw_solutions:
        ends = [
            (four_bar.ground_pivot_a, four_bar.crank_pivot_b),
            (four_bar.ground_pivot_d, four_bar.coupler_pivot_c),
        ]
        pairs.append([RR(a, first.act(b), np.hypot(*np.subtract(a, b))) for a, b in ends])
    what = f"pylinkage's `motion_generation`, {count} poses"
    measure(what, synthesis.motion_generation, rows, rounds=7, **nearest(pairs, poses))


@PEERS
def test_fourbarhinge(measure):
    """Two tracks of points of the body, and bounds of the lengths, which it asks for."""
    package, poses = peer("fourbarhinge"), TABLE_5.poses
    tracks = [poses.act([0.0, 0.0]), poses.act([1.0, 0.0])]

    def solve():
        bounds = package.LinkBounds(min_length=0.1, max_length=20)
        return package.CouplerMotionSynthesis(*tracks, bounds).solve()

    result = solve()
    # By its own account of where the two points go.
    gaps = [result.achieved_points - tracks[0], result.achieved_points_q - tracks[1]]
    worst = max(np.hypot(*gap.T).max() for gap in gaps)
    what = "fourbarhinge's `CouplerMotionSynthesis`, one linkage"
    measure(what, solve, rounds=3, linkages=1, worst_position_error=f"{worst:.2g}")


# 32 -----------------------------------------------------------------------------------------


@FEW
@pytest.mark.parametrize("count", [2, 3, 4])
def test_few_poses(measure, benchmark, tmp_path, count):
    """The cold command on the first task of so many poses, whose answer is a whole front."""
    (tmp_path / "task.toml").write_text(file_of(count + 1))
    arguments = ["synthesize", "task.toml"]
    notes = {} if benchmark.disabled else {"peak_MB": round(measured(arguments, tmp_path).peak)}
    command, goal = [sys.executable, "-m", "burmester", *arguments], "2 s" if count == 2 else "1 s"

    def call():
        subprocess.run(command, check=True, capture_output=True, cwd=tmp_path)

    measure(f"`burmester synthesize TOML`, {count} poses", call, rounds=7, goal=goal, **notes)


@FEW
@pytest.mark.parametrize("count", [2, 3, 4])
def test_few_poses_by_brute_force(measure, count):
    """One linkage, from one round of 24 starts of SLSQP, without an interpreter to start."""
    what = f"brute force of the tests, {count} poses, one linkage"
    measure(what, brute_force, count + 1, 1, 24, rounds=3)
