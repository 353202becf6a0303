"""A process of this machine that works on parts: one thread of BLAS, and never left behind.

This module loads no NumPy: how many threads that gets must be said before it is loaded.
"""

from __future__ import annotations

import os
import signal
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection

# Matrices are small here: more threads would only wait for each other.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
TIMED_OUT = 75  # exit code of a worker that ended itself as a part took too long


def serve(pipe: Connection, leash: Connection, memory: int | None) -> None:
    """Work on what comes through a pipe, and send back (True, result) or (False, error).

    leash: nothing is ever sent on it; it ends with who holds the other end, however that happens,
    and the worker ends with it.  memory: bytes of address space that it may have.
    """
    _prepare(leash, memory)
    with suppress(EOFError):
        while True:
            work, arguments = pipe.recv()
            try:
                answer = True, work(*arguments)
            except Exception as error:
                answer = False, error
            pipe.send(answer)


def _prepare(leash: Connection, memory: int | None) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a keyboard's is for who started the worker
    warnings.simplefilter("ignore")  # numbers that overflow are judged by what comes of them
    os.environ.update(ONE_THREAD)
    if memory is not None and os.name == "posix":
        import resource  # noqa: PLC0415  POSIX has it

        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    threading.Thread(target=_end_with, args=(leash,), daemon=True).start()


def _end_with(leash: Connection) -> None:
    with suppress(EOFError, OSError):
        leash.recv_bytes()
    os._exit(1)


def ready() -> str:
    """The version of burmester here."""
    from burmester import __version__  # noqa: PLC0415  the process is asked first

    return __version__


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """End this process if the block takes longer: nothing else ends what never does itself."""
    timer = threading.Timer(seconds, os._exit, (TIMED_OUT,))
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
