"""Where the time of a synthesis goes, and what of it linear algebra would need by itself.

    python -m benchmarks.where_time_goes
    python -m benchmarks.where_time_goes --task case:motiongen-mixed5 --task lid.toml

While a task is solved again and again a signal asks, each few milliseconds of CPU time, which room
the process is in: that of the innermost frame that is burmester's, so NumPy's share counts for the
room that calls it.  The same samples are counted by what the computation says that it does
(`burmester.progress`).

Beside it stands the limit of linear algebra.  In one run every call of a solver of `numpy.linalg`
is recorded with its arrays.  Then these calls are made again by themselves: as they were made, and
stacked, all of one shape in one call.  The second is what LAPACK itself takes on one thread, if
nobody had to wait for the result of a call to make the next; products of matrices, and everything
else that is computed, are not in it.  So it is no bound that could be reached, but nothing that
goes on like this comes below it.
"""

import argparse
import os
import signal
import statistics
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Callable
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

import numpy as np

# The solvers of `numpy.linalg`, with how many of their arguments are arrays.
SOLVERS = {
    **dict.fromkeys(("solve", "lstsq"), 2),
    **dict.fromkeys(("svd", "svdvals", "qr", "inv", "pinv", "det", "slogdet", "cholesky"), 1),
    **dict.fromkeys(("eig", "eigh", "eigvals", "eigvalsh"), 1),
}
PERIOD_S = 0.002  # CPU seconds between two samples, about
LEAST_S = 2.0  # CPU seconds in which samples are taken
REPLAYS = 5
PACKAGE = f"{os.sep}burmester{os.sep}"
LEAST_SHARE = 0.01  # of the time; less is not told by itself

recorded = []  # the calls of one run
recording = False


class Call(NamedTuple):
    """A call of a solver: its arrays, and what else it is told."""

    name: str
    solver: Callable
    arrays: list
    rest: tuple
    how: dict


def watch_solvers():
    """Put a recorder in the place of each solver; before burmester is loaded."""

    def watched(name, count, solver):
        def call(*args, **how):
            if recording:
                arrays = [np.array(each) for each in args[:count]]
                if all(each.size for each in arrays):
                    recorded.append(Call(name, solver, arrays, args[count:], how))
            return solver(*args, **how)

        return call

    for name, count in SOLVERS.items():
        if hasattr(np.linalg, name):
            setattr(np.linalg, name, watched(name, count, getattr(np.linalg, name)))


def room(frame):
    """The room of the innermost frame of burmester, "" where there is none."""
    while frame is not None:
        path = frame.f_code.co_filename
        if PACKAGE in path:
            inner = path.rpartition(PACKAGE)[2].split(os.sep)
            return inner[0] if len(inner) > 1 else inner[0].removesuffix(".py")
        frame = frame.f_back
    return ""


class Samples:
    """In which rooms and in which steps a computation was when it was looked at."""

    def __init__(self):
        self.rooms, self.steps, self.step = Counter(), Counter(), "reading"

    def hear(self, doing):
        self.step = doing.text.partition(", ")[0]

    def take(self, _, frame):
        self.rooms[room(frame)] += 1
        self.steps[self.step] += 1


@contextmanager
def sampled(samples):
    """Take samples in this block."""
    before = signal.signal(signal.SIGVTALRM, samples.take)
    signal.setitimer(signal.ITIMER_VIRTUAL, PERIOD_S, PERIOD_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def cpu(call):
    """The CPU seconds of a call."""
    begun = time.process_time()
    call()
    return time.process_time() - begun


def stacked():
    """The recorded calls as few: those of one solver and of arrays of one shape in one each."""
    alike = defaultdict(list)
    for number, call in enumerate(recorded):
        arrays = [each[:, None] if each.ndim == 1 else each for each in call.arrays]
        lead = np.broadcast_shapes(*(each.shape[:-2] for each in arrays))
        cells = [np.broadcast_to(each, (*lead, *each.shape[-2:])) for each in arrays]
        cells = [each.reshape(-1, *each.shape[-2:]) for each in cells]
        alone = number if call.name == "lstsq" else -1  # it takes one system at a time
        shapes = tuple((each.shape[1:], str(each.dtype)) for each in cells)
        key = call.name, shapes, repr((call.rest, call.how)), alone
        alike[key].append(call if alone >= 0 else call._replace(arrays=cells))
    return [
        calls[0]._replace(arrays=[np.concatenate(each) for each in zip(*parts, strict=True)])
        if len(parts := [call.arrays for call in calls]) > 1
        else calls[0]
        for calls in alike.values()
    ]


def again(calls):
    """Make calls again; an array that cannot be solved is passed over."""
    for call in calls:
        with suppress(np.linalg.LinAlgError):
            call.solver(*call.arrays, *call.rest, **call.how)


def analysed(source):
    """The figures of one task: seconds of a call, samples, seconds of the solvers alone."""
    global recording  # noqa: PLW0603  the recorders look at it
    from burmester import read_task, synthesize  # noqa: PLC0415  after the recorders are there

    task, samples = read_task(source), Samples()
    recorded.clear()
    recording = True
    synthesize(task)
    recording = False
    as_made = min(cpu(lambda: again(recorded)) for _ in range(REPLAYS))
    few = stacked()
    together = min(cpu(lambda: again(few)) for _ in range(REPLAYS))
    seconds, spent = [], 0.0
    while spent < LEAST_S:
        seconds.append(cpu(lambda: synthesize(task)))
        spent += seconds[-1]
        with sampled(samples):
            spent += cpu(lambda: synthesize(task, progress=samples.hear))
    return statistics.median(seconds), samples, as_made, together, len(recorded), len(few)


def shares(title, counts, seconds, names):
    """A table: milliseconds of each task in each of what was counted, the greatest first."""
    print(f"\n| {title} | {' | '.join(names)} |\n|---|{'--:|' * len(names)}")
    total = Counter()
    for count in counts:
        for key, number in count.items():
            total[key] = max(total[key], number / max(1, sum(count.values())))
    for key, share in total.most_common():
        if share < LEAST_SHARE:
            break
        parts = [
            second * count[key] / max(1, sum(count.values()))
            for count, second in zip(counts, seconds, strict=True)
        ]
        print(f"| {key or 'outside'} | {' | '.join(f'{1e3 * part:.1f}' for part in parts)} |")


def main():
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--task", action="append", help="a file, or case:NAME")
    given = parser.parse_args()
    watch_solvers()
    from burmester.io import templates  # noqa: PLC0415  after the recorders are there

    with tempfile.TemporaryDirectory() as folder:
        tasks = given.task or ["case:ge2012-exact", "case:motiongen-mixed5"]
        if not given.task:
            for name in ("lid-hinge", "gripper", "robot-intake"):
                path = Path(folder) / f"{name}.toml"
                path.write_text(templates.text(name))
                tasks.append(str(path))
        found = [analysed(task) for task in tasks]
    names = [Path(task.removeprefix("case:")).stem for task in tasks]
    seconds = [each[0] for each in found]
    print(f"| milliseconds of CPU | {' | '.join(names)} |\n|---|{'--:|' * len(names)}")
    for title, row in (
        ("the whole road", [f"{1e3 * each[0]:.1f}" for each in found]),
        ("calls of solvers, alone", [f"{1e3 * each[2]:.1f}" for each in found]),
        ("how many", [f"{each[4]:,}" for each in found]),
        ("the same stacked by shape: LAPACK alone", [f"{1e3 * each[3]:.1f}" for each in found]),
        ("how many", [f"{each[5]:,}" for each in found]),
    ):
        print(f"| {title} | {' | '.join(row)} |")
    shares("by room", [each[1].rooms for each in found], seconds, names)
    shares("by step", [each[1].steps for each in found], seconds, names)


if __name__ == "__main__":
    main()
