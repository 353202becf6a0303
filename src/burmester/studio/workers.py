"""Workers as the server sees them: processes that are lent to who has something to be done.

A worker keeps the answers of the last task it solved, so a page comes back to the one that holds
its own.  Where more are wanted than there may be, the one that was not used for longest is taken.
"""

from __future__ import annotations

import asyncio
import json
import os
import signal
import sys
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from typing import Any, TypeAlias

from burmester.errors import BurmesterError
from burmester.studio.message import LENGTHS, lengths, packed

Message: TypeAlias = tuple[dict[str, Any], bytes]

SHORT_S = 0.002  # between two looks whether a worker is free
GRACE_S = 0.4  # for a computation that was called off to end by itself
# Matrices are small here: more threads would only wait for each other.
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


class WorkerEndedError(Exception):
    """A worker that ended before it answered; code: with which it did."""

    def __init__(self, code: int | None = None) -> None:
        super().__init__("the process that computes ended before it answered")
        self.code = code

    @property
    def data(self) -> dict[str, Any]:
        """What happened, as messages are told."""
        why = f"its exit code is {self.code}"
        if self.code is not None and self.code < 0:  # as POSIX has it
            why = f"signal {-self.code} ended it; a system that is short of memory does that"
        help = "try it once more; another process takes its place"
        return BurmesterError("503", str(self), why=why, help=help).to_dict()


class Worker:
    """A process that does one thing after the other.

    key: of the task whose answers it holds; holder: who comes back to them.
    """

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self._process = process
        self._messages: asyncio.Queue[Message | None] = asyncio.Queue()
        self._reading = asyncio.create_task(self._read())
        self._job = 0
        self._done = False  # until it says that it is ready
        self._loaded = False
        self.key: str | None = None
        self.holder: object = None

    @classmethod
    async def start(cls, *words: str) -> Worker:
        """A new process; it is not waited for until it is ready.  words: what it does first."""
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-P", "-m", "burmester.studio.worker", *words),
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            env={**os.environ, **ENVIRONMENT},
        )
        return cls(process)

    @property
    def pid(self) -> int:
        """The number of the process."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether the process has not ended."""
        return self.code is None

    @property
    def idle(self) -> bool:
        """Whether it has answered everything."""
        return self._done or not self._loaded

    @property
    def code(self) -> int | None:
        """The exit code of a process that has ended."""
        return self._process.returncode

    async def ready(self) -> None:
        """Wait until it has loaded what it needs; raises WorkerEndedError."""
        if not self._loaded:
            await self._answer(None)
            self._loaded = True

    async def first(self, head: dict[str, Any], body: bytes = b"") -> Message:
        """The answer of a worker that was started with a word to what it does first."""
        self._write(packed(head | {"do": "first", "job": 0}, body))
        return await self._answer(None)

    async def ask(
        self, head: dict[str, Any], body: bytes = b"", piece: Callable[[Message], Any] | None = None
    ) -> Message:
        """The last message of an answer; those before it go to `piece`.

        Raises WorkerEndedError.  Who is cancelled while it waits calls `settle` before it is asked
        again.
        """
        await self.ready()
        assert self._done
        self._job, self._done = self._job + 1, False
        self._write(packed({**head, "job": self._job}, body))
        return await self._answer(piece)

    async def _read(self) -> None:
        """Take what it sends, message by message, whoever waits for it or does so no more."""
        source = self._process.stdout
        assert source is not None
        try:
            while True:
                front, rest = lengths(await source.readexactly(LENGTHS))
                head: dict[str, Any] = json.loads(await source.readexactly(front))
                self._messages.put_nowait((head, await source.readexactly(rest)))
        except asyncio.IncompleteReadError:
            self._messages.put_nowait(None)

    async def _answer(self, piece: Callable[[Message], Any] | None) -> Message:
        while True:
            if (message := await self._messages.get()) is None:
                self._messages.put_nowait(None)
                raise WorkerEndedError(await self._process.wait())
            if message[0]["last"]:
                self._done = True
                return message
            if piece is not None:
                piece(message)

    def _write(self, data: bytes) -> None:
        # Not waited for: a worker takes what it gets even while it computes.
        with suppress(OSError, RuntimeError):
            assert self._process.stdin is not None
            self._process.stdin.write(data)

    async def settle(self) -> None:
        """Call off what it still does; a worker that goes on all the same is killed."""
        if self.idle:
            return
        self._write(packed({"do": "cancel", "job": self._job}))
        try:
            async with asyncio.timeout(GRACE_S):
                await self._answer(None)
        except (TimeoutError, WorkerEndedError):
            await self.kill()

    async def kill(self) -> None:
        """End the process at once."""
        if self.alive:
            with suppress(ProcessLookupError):
                # Not by the process itself, which asks for its end first: so does who waits for
                # it, and one of the two would not find it.
                os.kill(self.pid, getattr(signal, "SIGKILL", signal.SIGTERM))
        await self._process.wait()
        await self._reading


class Workers:
    """At most so many workers, lent one by one; `spare` of them are kept ready."""

    def __init__(self, most: int, spare: int) -> None:
        self._most, self._spare = most, spare
        self._idle: list[Worker] = []  # those that rested for longest first
        self._lent: set[Worker] = set()
        self._starting = 0
        self._changed = asyncio.Event()  # a worker rests, or there is room for one more
        self._background: set[asyncio.Task[None]] = set()
        self._closed = False

    async def open(self, number: int, *words: str) -> None:
        """Start workers, so that there are so many at least; words: what each does first."""
        while not self._closed and self._size < min(number, self._most):
            await self._start(*words)

    async def close(self) -> None:
        """End all of them."""
        self._closed = True
        for task in self._background:
            task.cancel()
        await asyncio.gather(*(each.kill() for each in (*self._idle, *self._lent)))

    @asynccontextmanager
    async def lent(self, key: str | None = None) -> AsyncIterator[Worker]:
        """A worker for this block: one that holds the answers of `key`, if there is one.

        It is nobody's, if there may be one more.
        """
        worker = await self._borrow(key)
        try:
            yield worker
        finally:
            self._return(worker)

    @asynccontextmanager
    async def held(self, worker: Worker | None, holder: object) -> AsyncIterator[Worker | None]:
        """The same worker, when it is free; None where it holds the holder's answers no more."""
        while worker in self._lent and worker.holder is holder:
            await asyncio.sleep(SHORT_S)  # seldom, and not for long: a tab asks one thing at a time
        if worker not in self._idle or worker.holder is not holder or not worker.alive:
            yield None
            return
        self._idle.remove(worker)
        self._lent.add(worker)
        try:
            yield worker
        finally:
            self._return(worker)

    async def _borrow(self, key: str | None) -> Worker:
        while True:
            if self._closed:
                raise WorkerEndedError
            if (worker := self._choice(key)) is not None:
                self._idle.remove(worker)
                self._lent.add(worker)
                return worker
            if self._size < self._most:
                await self._start()
                continue
            self._changed.clear()
            await self._changed.wait()

    def _choice(self, key: str | None) -> Worker | None:
        """The idle worker that is to be had; None where another is to be started first."""
        for each in [each for each in self._idle if not each.alive]:
            self._idle.remove(each)
        if key is not None:
            for each in self._idle:
                if each.key == key and each.holder is None:
                    return each
        free = [each for each in self._idle if each.holder is None]
        if free:
            return next((each for each in free if each.key is None), free[0])
        return self._idle[0] if self._idle and self._size >= self._most else None

    @property
    def _size(self) -> int:
        return len(self._idle) + len(self._lent) + self._starting

    async def _start(self, *words: str) -> None:
        self._starting += 1
        try:
            worker = await Worker.start(*words)
        except BaseException:
            self._changed.set()  # there is room for one more
            raise
        finally:
            self._starting -= 1
        if self._closed:
            await worker.kill()
            return
        self._idle.append(worker)
        self._changed.set()

    def _return(self, worker: Worker) -> None:
        if worker.idle and worker.alive:
            self._rest(worker)
        else:
            self._later(self._settled(worker))

    def _rest(self, worker: Worker) -> None:
        self._lent.discard(worker)
        self._idle.append(worker)
        self._changed.set()

    async def _settled(self, worker: Worker) -> None:
        await worker.settle()
        if worker.alive:
            worker.key = worker.holder = None
            self._rest(worker)
            return
        self._lent.discard(worker)
        self._changed.set()
        if not self._closed:
            await self.open(self._spare)

    def _later(self, what: Any) -> None:
        task = asyncio.ensure_future(what)
        self._background.add(task)
        task.add_done_callback(self._background.discard)


class Turns:
    """At most so many at once; the others wait, first come, first served."""

    def __init__(self, at_once: int) -> None:
        self._free = asyncio.Semaphore(at_once)
        self._queue: list[Callable[[int], None]] = []

    @asynccontextmanager
    async def turn(self, told: Callable[[int], None]) -> AsyncIterator[None]:
        """Wait for a turn; told: how many are still before this one, whenever that changes."""
        if self._free.locked():
            self._queue.append(told)
            told(len(self._queue))
            try:
                await self._free.acquire()
            finally:
                place = self._queue.index(told)
                del self._queue[place]
                for before, each in enumerate(self._queue[place:], start=place + 1):
                    each(before)
        else:
            await self._free.acquire()
        try:
            yield
        finally:
            self._free.release()
