"""What a batch costs beside its work, how much memory it takes, and how many parts it can hand out.

    python -m benchmarks.batch overhead [DEPTH] [TASKS]
    python -m benchmarks.batch memory [DEPTH]
    python -m benchmarks.batch scheduler [PARTS]

overhead: the processor time of a whole batch, of all its processes, beside that of the same stacks
in a loop without files, in turn in one run; what starting and ending a batch takes is measured with
one task and told apart.  memory: the greatest resident memory of the run and of a worker, for ten
thousand tasks and for a million, in parts of the same size.  scheduler: parts that hold nothing,
through processes, through a Dask cluster on this machine, and through the files of a folder.
"""

from __future__ import annotations

import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from tests.oracles.batches import Numbers, as_file, rows

from burmester.batch.dispatch import Dispatch
from burmester.batch.engines import Cluster, Engine, Processes
from burmester.batch.job import PART_TASKS
from burmester.batch.manifest import Manifest, PartRecord
from burmester.batch.out_folder import OutFolder
from burmester.batch.parts import Part

USUAL = {"pencil": 200_000, "dyads": 2000, "linkages": 1000, "full": 20}
DIFFERENT = 1000  # tasks; more are these again, moved
ROUNDS = 3
SMALL = 2000  # tasks of a part, so that ten thousand tasks are several of them


def write_tasks(path: Path, count: int, poses: int) -> None:
    """A Parquet table of so many tasks, a piece at a time."""
    some = rows(min(count, DIFFERENT), poses, noise=1e-3)
    kinds = [("task", pa.int64())] + [(name, pa.float64()) for name in ("x", "y", "angle_deg")]
    with pq.ParquetWriter(path, pa.schema(kinds)) as writer:
        for first in range(0, count, DIFFERENT):
            size = min(DIFFERENT, count - first)
            numbers = some[:size].reshape(-1, 3) + np.array([first / DIFFERENT, 0, 0])
            names = np.repeat(np.arange(first, first + size), poses)
            writer.write_table(pa.table([names, *numbers.T], schema=pa.schema(kinds)))


BATCH = """
import json, resource, sys, time
from burmester.batch import run
if __name__ == "__main__":
    tasks, out, depth, workers, size = sys.argv[1:6]
    begun = time.monotonic()
    run(tasks, out, depth=depth, workers=int(workers), part_tasks=int(size) or None)
    usage = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    print(json.dumps({
        "seconds": time.monotonic() - begun,
        "processor": [each.ru_utime + each.ru_stime for each in usage],
        "memory": [each.ru_maxrss / 1024 for each in usage],
    }))
"""
# The same stacks without files, cut as the batch cuts them.
LOOP = """
import json, sys, time
import numpy as np
from burmester.batch.job import PART_TASKS
from burmester.batch.long_tables import table_parts
from burmester.numerics.linear_algebra import one_thread
from burmester.stacked import TaskStack, stacked_answers
tasks, depth = sys.argv[1:3]
used = 0.0
with one_thread(), np.errstate(all="ignore"):
    for part in table_parts(tasks, PART_TASKS[depth]):
        poses = part.tasks.poses * [1, 1, np.pi / 180]
        poses = poses.reshape(len(part.tasks), -1, 3)
        begun = time.process_time()
        stacked_answers(TaskStack(poses), depth)
        used += time.process_time() - begun
print(json.dumps({"processor": used}))
"""
# `burmester.synthesize` in a loop, over the same texts.
ALONE = """
import json, sys, time, warnings
from pathlib import Path
from burmester import read_task
from burmester.io.result import synthesis_data
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.options import SynthesisOptions
warnings.simplefilter("ignore")
texts = [each.encode() for each in Path(sys.argv[1]).read_text().split("\\n\\n")]
begun = time.process_time()
for text in texts:
    synthesis_data(synthesize(read_task("task.csv", data=text), SynthesisOptions()))
print(json.dumps({"processor": time.process_time() - begun}))
"""


def told(script: str, *arguments: object) -> dict[str, Any]:
    """What a script prints, run from a file of its own."""
    with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
        file.write(script)
        file.flush()
        command = [sys.executable, file.name, *map(str, arguments)]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
    data: dict[str, Any] = json.loads(done.stdout)
    return data


def overhead(depth: str, count: int) -> None:
    """Processor time of a batch beside that of its work."""
    with tempfile.TemporaryDirectory() as here:
        tasks, one = Path(here, "tasks.parquet"), Path(here, "one.parquet")
        write_tasks(tasks, count, 10)
        write_tasks(one, 1, 10)
        texts = Path(here, "texts")
        texts.write_text(
            "\n".join(map(as_file, rows(count, 10, noise=1e-3))) if depth == "full" else ""
        )
        found = []
        for k in range(ROUNDS):
            whole = told(BATCH, tasks, Path(here, f"out{k}"), depth, 1, 0)
            start = told(BATCH, one, Path(here, f"start{k}"), depth, 1, 0)
            alone = told(ALONE, texts) if depth == "full" else told(LOOP, tasks, depth)
            begun, used = sum(start["processor"]), sum(whole["processor"])
            found.append((used, begun, alone["processor"], whole["processor"][0]))
    used, begun, work, parent = (statistics.median(each) for each in zip(*found, strict=True))
    share = statistics.median((u - b - w) / w for u, b, w, _ in found)
    print(f"{depth}: {count} tasks, {PART_TASKS[depth]} a part")  # type: ignore[index]
    print(f"  the work {work:.2f} s ({count / work:.0f} tasks a second and core)")
    print(
        f"  the batch {used:.2f} s, of which {begun:.2f} s to start and end; parent {parent:.2f} s"
    )
    print(f"  overhead {share:.1%} of the work")


def memory(depth: str) -> None:
    """Resident memory for few tasks and for many."""
    peaks = []
    for count in (10_000, 1_000_000):
        with tempfile.TemporaryDirectory() as here:
            tasks = Path(here, "tasks.parquet")
            write_tasks(tasks, count, 6)
            told_of = told(BATCH, tasks, Path(here, "out"), depth, 2, SMALL)
        peaks.append(told_of["memory"])
        run, worker = peaks[-1]
        print(
            f"{count} tasks: run {run:.0f} MB, worker {worker:.0f} MB, {told_of['seconds']:.0f} s"
        )
    (run, worker), (later_run, later_worker) = peaks
    print(
        f"a million beside ten thousand: run {later_run / run:.2f}, "
        f"worker {later_worker / worker:.2f}"
    )


def nothing(part: Part, plan: object, left_out: object) -> bytes:
    """The work on a part that holds nothing."""
    return b""


def scheduler(count: int) -> None:
    """Parts a second, of parts that hold nothing."""

    def parts() -> Iterator[Part]:
        return (Part(k, Numbers((k,)), (k + 1) / count) for k in range(count))

    def timed(name: str, engine: Engine, keep: Callable[[Part, Any], None]) -> None:
        Dispatch(engine, nothing, None, lambda part, worked: None).run(
            iter([Part(0, Numbers((0,)), 1.0)])
        )
        begun, used = time.monotonic(), time.process_time()
        assert Dispatch(engine, nothing, None, keep).run(parts())
        seconds, used = time.monotonic() - begun, time.process_time() - used
        print(
            f"{name}: {count / seconds:.0f} parts a second, {1e3 * seconds / count:.2f} ms a part, "
            f"{1e3 * used / count:.2f} ms of processor here"
        )

    def into(folder: Path) -> Callable[[Part, Any], None]:
        manifest = Manifest(OutFolder(str(folder)), {"depth": "none"})

        def keep(part: Part, worked: bytes) -> None:
            manifest.add(
                part.number, worked, PartRecord(part.number, 1, 0, "0" * 64, {"solved": 1})
            )

        return keep

    with tempfile.TemporaryDirectory() as here:
        processes = Processes(2)
        try:
            timed("processes", processes, lambda part, worked: None)
            for name in ("first", "second"):  # whether it grows with what is there
                folder = Path(here, "out")
                folder.mkdir(exist_ok=True)
                timed(f"processes and files, {name} time", processes, into(folder))
        finally:
            processes.close()
        from distributed import LocalCluster  # noqa: PLC0415  an extra

        with LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
        ) as local:
            cluster = Cluster(local.scheduler_address)
            try:
                timed("a Dask cluster", cluster, lambda part, worked: None)
            finally:
                cluster.close()
    print(f"memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")


def main(what: str, *more: str) -> None:
    """One of the three."""
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    if what == "overhead":
        depth = more[0] if more else "dyads"
        overhead(depth, int(more[1]) if len(more) > 1 else USUAL[depth])
    elif what == "memory":
        memory(more[0] if more else "pencil")
    else:
        scheduler(int(more[0]) if more else 10_000)


if __name__ == "__main__":
    main(*sys.argv[1:])
