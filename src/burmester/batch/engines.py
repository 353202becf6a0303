"""Where parts are worked on: processes of this machine, or a Dask cluster, behind one interface.

Both hand out futures of `concurrent.futures`.

E130 a library is missing      E182 the workers cannot be started or reached
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from typing import Any, Protocol, final

from burmester.batch.worker import begin, ready
from burmester.errors import InputError

START_S = 120.0  # for a worker to begin
CONNECT_S = 10.0  # for a cluster to answer


class Engine(Protocol):
    """Who works on parts.

    lost: what the result of a future raises where its worker ended; breaks_all: whether all other
    futures are lost with it; tries: how often a part is tried alone before its worker's end is
    put down to it.
    """

    lost: tuple[type[BaseException], ...]
    breaks_all: bool
    tries: int

    @property
    def size(self) -> int:
        """How many parts are worked on at once."""
        ...

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin a call somewhere."""
        ...

    def renew(self) -> None:
        """Get workers in place of those that ended."""
        ...

    def close(self) -> None:
        """End the workers, also in the midst of work."""
        ...


@final
class Processes:
    """Processes of this machine, which end when this one does.

    workers: how many; memory: bytes that each may have.
    """

    lost: tuple[type[BaseException], ...] = (BrokenProcessPool,)
    breaks_all = True
    tries = 3

    def __init__(self, workers: int, memory: int | None = None) -> None:
        self.size = workers
        self._memory = memory
        self._pool: ProcessPoolExecutor | None = None
        self._leash: Any = None
        self.renew()

    def renew(self) -> None:
        """Start the processes anew; raises E182."""
        self.close()
        context = multiprocessing.get_context("spawn")
        held, self._leash = context.Pipe(duplex=False)
        self._pool = ProcessPoolExecutor(self.size, context, begin, (held, self._memory))
        try:
            self.submit(ready).result(START_S)
        except (BrokenProcessPool, TimeoutError):
            self.close()
            raise InputError(
                "E182",
                "the processes that are to work cannot be started",
                why="each of them ended before it began",
                help='call burmester.batch.run under `if __name__ == "__main__":`, and give the '
                "processes more memory if they have a limit",
            ) from None

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Begin a call in one of the processes."""
        assert self._pool is not None
        with _interrupts_held():  # a process that starts now never sees those of the keyboard
            return self._pool.submit(work, *arguments)

    def close(self) -> None:
        """End the processes at once."""
        if self._leash is not None:
            self._leash.close()  # they see it
        if self._pool is not None:
            self._pool.shutdown(wait=True, cancel_futures=True)
        self._pool = self._leash = None


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """A block in which SIGINT waits, and is blocked in processes that start."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@final
class Cluster:
    """A Dask cluster that runs already, by the address of its scheduler."""

    breaks_all = False
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

    def renew(self) -> None:
        """The cluster sees to its workers."""

    def close(self) -> None:
        """Leave the cluster; it goes on."""
        with suppress(Exception):
            self._executor.shutdown(wait=False)
        self._client.close(timeout=CONNECT_S)


def usual_workers() -> int:
    """As many as this process may use cores."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1
