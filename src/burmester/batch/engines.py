"""Where parts are worked on: processes of this machine, or a Dask cluster, behind one interface.

Both hand out futures of `concurrent.futures`.

E130 a library is missing      E182 the workers cannot be started or reached
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from typing import Any, Protocol, final

from burmester.batch.worker import ready, serve
from burmester.errors import InputError

START_S = 120.0  # for the first worker to begin
CONNECT_S = 10.0  # for a cluster to answer


class WorkerEndedError(Exception):
    """A process ended before it had answered."""


class Engine(Protocol):
    """Who works on parts.

    lost: what the result of a future raises where its worker ended; tries: how often a part is
    tried alone before its worker's end is put down to it.
    """

    lost: tuple[type[BaseException], ...]
    tries: int

    @property
    def size(self) -> int:
        """How many parts are worked on at once."""
        ...

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin a call somewhere."""
        ...

    def close(self) -> None:
        """End the workers, also in the midst of work."""
        ...


@final
class Processes:
    """Processes of this machine, which end when this one does; a thread here speaks for each.

    Each process has a pipe of its own, so that one which is killed in the midst of a word ends
    its own answer only: with a queue for all, the others would wait for the rest of the word.

    workers: how many; memory: bytes that each may have; raises E182.
    """

    lost: tuple[type[BaseException], ...] = (WorkerEndedError,)
    tries = 3

    def __init__(self, workers: int, memory: int | None = None) -> None:
        self.size = workers
        self._memory = memory
        self._context = multiprocessing.get_context("spawn")
        self._held, self._leash = self._context.Pipe(duplex=False)
        self._own = threading.local()
        self._threads = ThreadPoolExecutor(workers, initializer=_leave_interrupts)
        try:
            self.submit(ready).result(START_S)
        except (WorkerEndedError, TimeoutError):
            self.close()
            raise InputError(
                "E182",
                "the processes that are to work cannot be started",
                why="the first of them ended before it began",
                help='call burmester.batch.run under `if __name__ == "__main__":`, and give the '
                "processes more memory if they have a limit",
            ) from None

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin a call in one of the processes."""
        return self._threads.submit(self._ask, work, arguments)

    def _ask(self, work: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """What the process of this thread answers; the next call gets a new one if it ended."""
        pipe: Connection | None = getattr(self._own, "pipe", None)
        if pipe is None:
            pipe = self._own.pipe = self._begun()
        try:
            pipe.send((work, arguments))
            well, answer = pipe.recv()
        except (EOFError, OSError):
            self._own.pipe = None
            pipe.close()
            raise WorkerEndedError from None
        if well:
            return answer
        raise answer

    def _begun(self) -> Connection:
        """The pipe to a new process."""
        pipe, its = self._context.Pipe()
        arguments = (its, self._held, self._memory)
        self._context.Process(target=serve, args=arguments, daemon=True).start()
        its.close()  # it ends with the process
        return pipe

    def close(self) -> None:
        """End the processes at once."""
        self._leash.close()  # they see it
        self._threads.shutdown(wait=True, cancel_futures=True)


def _leave_interrupts() -> None:
    """Block SIGINT in this thread and in what it starts: a keyboard's is for the main thread."""
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})


@final
class Cluster:
    """A Dask cluster that runs already, by the address of its scheduler."""

    tries = 1  # the scheduler has tried a part on several workers when it gives it up

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client  # noqa: PLC0415  an extra
            from distributed.scheduler import KilledWorker  # noqa: PLC0415
        except ImportError:
            raise InputError(
                "E130",
                "a cluster needs dask[distributed], which is not installed",
                help='pip install "burmester[cluster]"',
            ) from None
        self.lost: tuple[type[BaseException], ...] = (KilledWorker,)
        self._address = address
        help = "start one with `dask scheduler` and `dask worker`, or leave --dask out"
        with self._there("does not answer", help):
            self._client = Client(address, timeout=CONNECT_S, set_as_default=False)
        self._executor = self._client.get_executor(pure=False)

    @property
    def size(self) -> int:
        """The threads of all workers that are there now."""
        with self._there():
            threads: int = sum(self._client.nthreads().values())
        return max(1, threads)

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin a call on one of the workers."""
        with self._there():
            future: Future[Any] = self._executor.submit(work, *arguments)
        return future

    @contextmanager
    def _there(
        self,
        fault: str = "does not answer any more",
        help: str = "start it again, and run the batch again: it goes on",
    ) -> Iterator[None]:
        """A block that asks the scheduler; raises E182 where it does not answer."""
        try:
            yield
        except (OSError, RuntimeError, ValueError, CancelledError) as error:
            message = f"the cluster at {self._address} {fault}"
            why = str(error).partition("\n")[0][:200] or type(error).__name__
            raise InputError("E182", message, why=why, help=help) from None

    def close(self) -> None:
        """Leave the cluster; it goes on."""
        with suppress(Exception):
            self._executor.shutdown(wait=False)
        self._client.close(timeout=CONNECT_S)


def usual_workers() -> int:
    """As many as this process may use cores."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1
