"""How fast stacks of tasks are, each figure beside a loop over stacks of one task.

    python -m benchmarks.many_tasks
    python -m benchmarks.many_tasks --only dyads --rounds 5
    python -m benchmarks.many_tasks --memory

Tasks are random usable four-bars (`burmester.stacked.random_linkages`, seed 7).  Times are CPU
seconds of one process with one BLAS thread; the stack and the loop take turns, and the medians
over rounds count.  The loop is over fewer tasks, which are among those of the stack.  `--memory`
tells the greatest memory of a process that computes 10,000 tasks, and of one that computes
200,000.
"""

import argparse
import os
import resource
import statistics
import subprocess
import sys
import time
from typing import NamedTuple

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402  after the number of threads

from burmester.linkages.from_dyads import linkages_from_dyads  # noqa: E402
from burmester.stacked import SampleOptions, TaskStack, random_linkages, stacked_answers  # noqa: E402
from burmester.synthesis.dyad_search import search_dyads, with_method  # noqa: E402
from burmester.tasks.motion_class import classify_motion  # noqa: E402
from burmester.tasks.options import SynthesisOptions  # noqa: E402
from burmester.tasks.problem import SynthesisProblem  # noqa: E402

SEED = 7
PART = 5_000  # tasks of one call, where the memory is measured


class Row(NamedTuple):
    """What is measured; goal: tasks a second of two cores; count, alone: those of stack, loop."""

    name: str
    depth: str
    poses: int
    noise: float
    count: int
    alone: int
    goal: float


ROWS = [
    Row("pencil, ten noisy poses", "pencil", 10, 1e-3, 20_000, 200, 150_000),
    Row("pencil, ten exact poses", "pencil", 10, 0.0, 20_000, 200, 150_000),
    Row("dyads, five exact poses", "dyads", 5, 0.0, 20_000, 100, 50_000),
    Row("dyads, five noisy poses", "dyads", 5, 1e-3, 20_000, 100, 50_000),
    Row("dyads, ten noisy poses", "dyads", 10, 1e-3, 1000, 40, 800),
    Row("dyads, ten exact poses", "dyads", 10, 0.0, 1000, 40, 800),
    Row("linkages, ten noisy poses", "linkages", 10, 1e-3, 500, 25, 300),
    Row("linkages, five exact poses", "linkages", 5, 0.0, 500, 25, 300),
]


def tasks(row, count):
    """The poses of a row's tasks."""
    options = SampleOptions(seed=SEED, poses=row.poses, noise=row.noise, curve=0)
    return TaskStack(random_linkages(options, np.arange(count)).poses)


def one_by_one(stack, depth):
    """The loop that nobody needs any more."""
    for k in range(len(stack)):
        if depth != "linkages":
            stacked_answers(stack[k : k + 1], depth)
            continue
        task = stack.task(k)
        problem = SynthesisProblem.of(task, classify_motion(task), SynthesisOptions())
        if not problem.is_special:
            problem = with_method(problem)
            pairs, _ = search_dyads(problem).pairs(problem.length)
            linkages_from_dyads(problem, pairs, refine=False)


def seconds(call, *arguments):
    start = time.process_time()
    call(*arguments)
    return time.process_time() - start


def measured(row, rounds):
    """Seconds of one task: in the stack, in the loop."""
    stack = tasks(row, row.count)
    some = stack[: row.alone]
    stacked_answers(some, row.depth)
    one_by_one(some[:3], row.depth)
    times = []
    for _ in range(rounds):
        together = seconds(stacked_answers, stack, row.depth)
        alone = seconds(one_by_one, some, row.depth)
        times.append((together / row.count, alone / row.alone))
    stacked, loop = (statistics.median(each) for each in zip(*times, strict=True))
    return stacked, loop


def greatest_memory(count):
    """The greatest memory, in MB, of a process that computes so many tasks, part by part."""
    code = f"from benchmarks.many_tasks import compute; compute({count})"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return float(done.stdout)


def compute(count):
    """Compute so many pencils, part by part, and print the greatest memory of this process."""
    options = SampleOptions(seed=SEED, poses=10, noise=1e-3, curve=0)
    for start in range(0, count, PART):
        number = np.arange(start, min(start + PART, count))
        stacked_answers(TaskStack(random_linkages(options, number).poses), "pencil")
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="rows whose name has this in it")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--memory", action="store_true", help="10 000 tasks against 200 000")
    asked = parser.parse_args()
    if asked.memory:
        few, many = greatest_memory(10_000), greatest_memory(200_000)
        print(f"10,000 tasks {few:.0f} MB, 200,000 tasks {many:.0f} MB: {many / few:.2f} times")
        return
    print("| | a second, one core | two cores, goal | one task in a loop | times as fast |")
    print("|---|---|---|---|---|")
    for row in ROWS:
        if asked.only in row.name:
            stacked, loop = measured(row, asked.rounds)
            rate = f"{1 / stacked:,.0f}"
            print(
                f"| {row.name} | {rate} | {row.goal:,.0f} | {loop * 1e3:.3g} ms "
                f"| {loop / stacked:.0f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
