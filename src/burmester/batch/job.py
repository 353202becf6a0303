"""A batch from its tasks to its folder."""

from __future__ import annotations

import hashlib
import os
import signal
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass, field
from itertools import chain
from time import monotonic
from types import FrameType
from typing import TYPE_CHECKING, Any, final

from burmester.batch.dispatch import Dispatch
from burmester.batch.engines import Cluster, Engine, Processes, usual_workers
from burmester.batch.manifest import Manifest, PartRecord, Summary, read_summary
from burmester.batch.options import DEPTHS, BatchOptions, Depth
from burmester.batch.out_folder import OutFolder
from burmester.batch.parts import Part
from burmester.batch.sources import Source, open_source
from burmester.errors import InputError

if TYPE_CHECKING:
    from burmester.batch.sample import Sample

# Tasks of a part that take some second on one core.
PART_TASKS: Mapping[Depth, int] = {"pencil": 50_000, "dyads": 1000, "linkages": 500, "full": 10}
PAIR_TASKS = 100  # the same of tasks of pairs of angles
SIX_BAR_TASKS = 1  # and where six-bars are looked for
MOST_DRAWN = 5000  # draws of a part: with their curves they are some megabytes
LIMITS_S: Mapping[Depth, float] = {"pencil": 120, "dyads": 120, "linkages": 120, "full": 600}


@final
@dataclass(frozen=True, slots=True)
class BatchProgress:
    """How far a run is.

    tasks: done by this run; before: done by those before it; total: how many there are, as far as
    the input tells so far, 0 where it does not; seconds: since it began; outcomes: of all tasks
    so far.
    """

    tasks: int
    before: int
    total: float
    seconds: float
    outcomes: Mapping[str, int]

    @property
    def rate(self) -> float:
        """Tasks a second."""
        return self.tasks / self.seconds if self.seconds > 0 else 0.0

    @property
    def seconds_left(self) -> float | None:
        """Until it ends, if it goes on like this; None: nobody can tell yet."""
        if not self.tasks or not self.total:
            return None
        return max(0.0, self.total - self.tasks - self.before) / self.rate


def run(
    tasks: str | os.PathLike[str] | Sample,
    output: str | os.PathLike[str],
    *,
    depth: Depth = "full",
    options: str | os.PathLike[str] | None = None,
    part_tasks: int | None = None,
    workers: int | None = None,
    dask: str | None = None,
    part_limit: float | None = None,
    worker_memory: float | None = None,
    progress: Callable[[BatchProgress], object] | None = None,
) -> Summary:
    """Work on many tasks, or go on with it, and write a row a task into a folder.

    Parameters
    ----------
    tasks : str, path or Sample
        A table with a row a pose (Parquet or CSV: task, x, y, angle_deg or angle_rad, and weight
        and exact if wanted; a row without an angle is a point) or a row a pair of angles (task,
        input_deg, output_deg), a file with a task a line in JSON, or a folder of task files.
        Or a `Sample`: linkages that are drawn at random, with poses on their way.
    output : str or path
        The folder of the parts.  Where it holds a part of this very batch, the rest is done.
    depth : {"pencil", "dyads", "linkages", "full"}
        How far each task is taken: the two dyads of the pencil; all dyads; their pairs, judged,
        not refined; what `burmester.synthesize` does.
    options : str or path, optional
        A TOML file with options of `burmester.synthesize`, and with what a task file holds beside
        its poses, for all tasks.
    part_tasks : int, optional
        Tasks of a part; by default as many as take some second.
    workers : int, optional
        Processes of this machine; by default one a core.
    dask : str, optional
        The scheduler of a Dask cluster, such as "tcp://host:8786", in place of processes.
    part_limit : float, optional
        Seconds after which a part is taken apart, and a single task that takes longer fails.
    worker_memory : float, optional
        Gigabytes of address space that each process may have.
    progress : callable, optional
        Called with a `BatchProgress` now and then.

    Returns
    -------
    Summary
        What is in the folder; `complete` is False where Ctrl-C ended the run.

    Raises
    ------
    InputError
        E101 to E112 (tasks or options that cannot be read), E130 (a library is missing), E134 (an
        argument that makes no sense), E140 and E141 (the folder), E180 (it holds another batch),
        E181 (another run works on it), E182 (the workers).
    """
    require_pyarrow()
    from burmester.batch.sample import Sample, sample_source  # noqa: PLC0415  they need it

    _require(depth in DEPTHS, f"there is no depth {depth!r}", f"choose one of {', '.join(DEPTHS)}")
    chosen = _options(options)
    chosen.require_depth(depth)
    drawn = isinstance(tasks, Sample)
    usual = min(PART_TASKS[depth], MOST_DRAWN) if drawn else PART_TASKS[depth]
    size = usual if part_tasks is None else part_tasks
    limit = LIMITS_S[depth] if part_limit is None else part_limit
    least = 0 < size <= MOST_TASKS and (workers is None or workers > 0) and limit > 0
    _require(
        least, "a number is out of range", "give part_tasks, workers and part_limit above zero"
    )
    folder = OutFolder(os.fspath(output))
    with folder.held():
        if isinstance(tasks, Sample):
            source = sample_source(tasks)
        else:
            source = open_source(os.fspath(tasks))
        if part_tasks is None and source.pairs:
            size = PAIR_TASKS
        elif part_tasks is None and chosen.six_bars is not None:
            size = SIX_BAR_TASKS
        sheet = tasks.datasheet if isinstance(tasks, Sample) else ""
        job = _Job(folder, source, depth, chosen, size, limit, progress, sheet)
        memory = None if worker_memory is None else int(worker_memory * 1e9)

        def engine() -> Engine:
            if dask is not None:
                return Cluster(dask)
            return Processes(workers or usual_workers(), memory)

        return job.run(engine)


MOST_TASKS = 1_000_000  # of a part: it is held in memory several times


def require_pyarrow() -> None:
    """Refuse to go on without pyarrow; raises E130."""
    try:
        import pyarrow  # noqa: F401, PLC0415
    except ImportError:
        raise InputError(
            "E130",
            "a batch needs pyarrow, which is not installed",
            help='pip install "burmester[batch]"',
        ) from None


def _require(good: bool, message: str, help: str) -> None:
    if not good:
        raise InputError("E134", message, help=help)


def _options(path: str | os.PathLike[str] | None) -> BatchOptions:
    """The options in a file; raises E101 and what `BatchOptions` does."""
    from burmester.io.reading.file_content import decode_text, read_source  # noqa: PLC0415
    from burmester.printable import printable  # noqa: PLC0415

    if path is None:
        return BatchOptions()
    label = printable(os.fspath(path))
    try:
        text, _ = decode_text(read_source(os.fspath(path)))
    except InputError as error:
        error.message, error.where = "the options cannot be read", error.where or label
        raise
    return BatchOptions(text, label)


@final
@dataclass
class _Job:
    """One run: what it is to do, and how far it is."""

    folder: OutFolder
    source: Source
    depth: Depth
    options: BatchOptions
    size: int
    limit: float
    progress: Callable[[BatchProgress], object] | None
    datasheet: str = ""
    total: float = 0.0
    tasks: int = 0
    before: int = 0
    begun: float = 0.0
    outcomes: Counter[str] = field(default_factory=Counter)

    def identity(self) -> dict[str, Any]:
        """All that the rows depend on."""
        from burmester.batch.part_file import versions  # noqa: PLC0415
        from burmester.batch.schema import VERSION  # noqa: PLC0415

        return {
            "schema": VERSION,
            "versions": versions(),
            "tasks": {
                "kind": self.source.kind,
                "sha256": self.source.digest,
                **self.source.told,
            },
            "depth": self.depth,
            "options": self.options.data,
            "part_tasks": self.size,
        }

    def run(self, engine: Callable[[], Engine]) -> Summary:
        """Do what is not done yet."""
        from burmester.batch.part_file import Plan, versions, work  # noqa: PLC0415  an extra

        manifest = Manifest(self.folder, self.identity())
        if self.datasheet:
            self.folder.write(self.folder.datasheet, self.datasheet)
        for record in manifest.done.values():
            self.outcomes.update(record.outcomes)
            self.before += record.tasks
        plan = Plan(self.depth, self.options, manifest.run, self.limit, versions())
        self.begun = monotonic()

        def keep(part: Part, worked: Any) -> None:
            record = PartRecord(
                part.number,
                worked.tasks,
                len(worked.data),
                hashlib.sha256(worked.data).hexdigest(),
                worked.outcomes,
                worked.failed,
            )
            manifest.add(part.number, worked.data, record)
            self.outcomes.update(record.outcomes)
            self.tasks += record.tasks

        complete = False
        parts = self._left(manifest)
        try:
            with stopping() as stopped:
                first = next(parts, None)
                complete = first is None
                if first is not None:
                    with closing(engine()) as started:
                        every = chain([first], parts)
                        dispatch = Dispatch(
                            started,
                            work,
                            plan,
                            keep,
                            stopped=stopped,
                            tick=self._tick,
                            limit=self.limit,
                        )
                        complete = dispatch.run(every)
                if not self.source.unchanged():
                    message = "the tasks were changed while they were read"
                    help = "run the batch again, into another folder"
                    raise InputError("E101", message, where=self.source.name, help=help)
        except BaseException:
            with suppress(InputError):  # a full disk, say: what ended the run is told
                manifest.finish(complete=False)
            raise
        manifest.finish(complete=complete)
        self._tick()
        return read_summary(self.folder.path, tuple(manifest.notes))

    def _left(self, manifest: Manifest) -> Iterator[Part]:
        """The parts that are not done."""
        read = 0
        try:
            for part in self.source.parts(self.size):
                read += len(part.tasks)
                self.total = read / part.share
                if part.number not in manifest.done:
                    yield part
        except OSError as error:
            why, help = error.strerror or str(error), "run the batch again: it goes on"
            message = "the tasks cannot be read any more"
            where = self.source.name
            raise InputError("E101", message, where=where, why=why, help=help) from None

    def _tick(self) -> None:
        if self.progress is not None:
            seconds = monotonic() - self.begun
            self.progress(
                BatchProgress(self.tasks, self.before, self.total, seconds, dict(self.outcomes))
            )


@contextmanager
def stopping() -> Iterator[Callable[[], bool]]:
    """Whether somebody has asked to stop, in this block.

    A second Ctrl-C does what the first would have done without this.
    """
    asked = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield asked.is_set
        return
    before = signal.getsignal(signal.SIGINT)
    if not callable(before):  # ignored, or nobody's in Python
        yield asked.is_set
        return

    def ask(number: int, frame: FrameType | None) -> None:
        asked.set()
        signal.signal(signal.SIGINT, before)

    signal.signal(signal.SIGINT, ask)
    try:
        yield asked.is_set
    finally:
        signal.signal(signal.SIGINT, before)
