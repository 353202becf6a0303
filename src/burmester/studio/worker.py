"""A worker: a process that does the science of the studio, one thing after the other.

It is started by the server (`workers`), reads messages from its standard input and writes messages
to its standard output.  It ends when its input ends, also in the midst of a computation: so no
worker is left when the server ends, however that happens.
"""

from __future__ import annotations

import math
import os
import queue
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable
from typing import Any, BinaryIO

from burmester.live.fault import fault_data
from burmester.studio.message import OVER, as_json, packed, read_message

PROGRESS_S = 0.1  # between two words of progress
LIMIT_S = 0.05  # between two looks at the time that the processor has spent


class _CalledOffError(Exception):
    """Somebody wants this computation no more."""


class _Inbox:
    """What the server sent, in its order; `cancelled` is the number of the last call-off."""

    def __init__(self, source: BinaryIO) -> None:
        self.messages: queue.SimpleQueue[tuple[dict[str, Any], bytes]] = queue.SimpleQueue()
        self.cancelled = -1
        self._end = math.inf  # of the job in hand, in seconds of the processor
        self._source = source
        threading.Thread(target=self._read, daemon=True).start()
        threading.Thread(target=self._end_in_time, daemon=True).start()

    def begin(self, limit_s: float | None) -> None:
        """Another job begins, which may take so many seconds of the processor."""
        self._end = math.inf if limit_s is None else time.process_time() + limit_s

    def _end_in_time(self) -> None:
        while time.process_time() < self._end:
            time.sleep(LIMIT_S)
        os._exit(OVER)

    def _read(self) -> None:
        while (message := read_message(self._source)) is not None:
            if message[0]["do"] == "cancel":
                self.cancelled = message[0]["job"]
            else:
                self.messages.put(message)
        os._exit(0)  # the server is gone


def main(first: str | None = None) -> None:
    """Work until the server has gone; first: "opening" where that is to be done before all else."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a keyboard's is for the server, which ends us
    warnings.simplefilter("ignore")
    source = os.fdopen(os.dup(0), "rb")
    sink = os.fdopen(os.dup(1), "wb", buffering=0)
    os.dup2(2, 1)  # what anybody prints must not come between the messages
    null = os.open(os.devnull, os.O_RDONLY)
    os.dup2(null, 0)
    inbox = _Inbox(source)
    if first == "opening":
        from burmester.studio.opening import opening  # noqa: PLC0415  half of what follows

        _Job(0, inbox, sink).answer(
            lambda: ({"kind": "json"}, as_json(opening(*inbox.messages.get())))
        )

    from burmester.studio.session_worker import SessionWorker  # noqa: PLC0415  the reader looks for the end already

    worker = SessionWorker()
    _Job(0, inbox, sink).send({"kind": "ready"}, last=True)
    while True:
        head, body = inbox.messages.get()
        inbox.begin(head.get("limit"))
        _Job(head["job"], inbox, sink).run(worker, head, body)


class _Job:
    """One thing to do: its number, and where its answers go."""

    def __init__(self, number: int, inbox: _Inbox, sink: BinaryIO) -> None:
        self.number = number
        self._inbox, self._sink = inbox, sink
        self._told = 0.0

    def run(self, worker: Any, head: dict[str, Any], body: bytes) -> None:
        """Do what a message says."""
        self.answer(lambda: worker.do(head, body, self))

    def answer(self, work: Callable[[], tuple[dict[str, Any], bytes]]) -> None:
        """Do it, and say that it is done, whatever comes of it."""
        try:
            answer = work()
        except _CalledOffError:
            answer = {"kind": "cancelled"}, b""
        except Exception as error:
            answer = {"kind": "failed"}, as_json({"messages": [fault_data(error)]})
        self._inbox.begin(None)
        self.send(*answer, last=True)

    def send(self, head: dict[str, Any], body: bytes = b"", *, last: bool = False) -> None:
        """An answer, or a piece of one; last: the job is done."""
        data = memoryview(packed({**head, "job": self.number, "last": last}, body))
        while data:
            data = data[self._sink.write(data) :]

    def listen(self, said: object) -> None:
        """Hand on what is said of the progress; ends the computation where it was called off."""
        if self._inbox.cancelled >= self.number:
            raise _CalledOffError
        if (now := time.monotonic()) - self._told < PROGRESS_S:
            return  # every step is said, many a millisecond
        self._told = now
        self.send({"kind": "progress"}, str(said).encode(errors="replace"))


if __name__ == "__main__":
    main(*sys.argv[1:])
