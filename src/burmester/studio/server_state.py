"""What all tabs share: workers, turns, the last answers, and the task that the studio opens on."""

from __future__ import annotations

import asyncio
import hashlib
import json
import os
import traceback
from collections import OrderedDict
from collections.abc import Callable, Coroutine, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from burmester.errors import InputError
from burmester.live.plain import plain
from burmester.studio.form import form_data
from burmester.studio.message import OVER, as_json
from burmester.studio.workers import Message, Turns, Worker, WorkerEndedError, Workers

ANSWER_BYTES = 64_000_000  # of all answers that are kept
SPARE = 2  # workers that are there before they are asked for
LONGEST_S = 600.0  # that a page may ask a search to take
DESK_S = 60.0  # for what is asked over HTTP, such as a solid part
POINTS_TIMES = 3  # the limit for points: what their search found is judged after it, however long
STARVED = 6  # times the limit; a worker that got no more of the processor by then is given up
SOFT = 0.8  # of the limit: after it nothing more is looked for, so that there is an answer


@dataclass(frozen=True)
class Answer:
    """The answer to a task: the result as a file holds it, what a page draws, and advice."""

    result: bytes
    report: bytes
    advice: Sequence[dict[str, Any]] = ()


class Answers:
    """Answers by the keys of their tasks; those not asked for longest go first."""

    def __init__(self) -> None:
        self._kept: OrderedDict[str, Answer] = OrderedDict()

    def get(self, key: str) -> Answer | None:
        """The answer of a task, if it is kept."""
        if key in self._kept:
            self._kept.move_to_end(key)
        return self._kept.get(key)

    def keep(self, key: str, answer: Answer) -> None:
        """Keep one more."""
        self._kept[key] = answer
        while len(self._kept) > 1 and self._bytes > ANSWER_BYTES:
            self._kept.popitem(last=False)

    @property
    def _bytes(self) -> int:
        return sum(len(each.result) + len(each.report) for each in self._kept.values())


class ServerState:
    """Workers, turns and answers.

    limit_s: seconds of its processor after which a whole search is killed.
    """

    def __init__(self, limit_s: float) -> None:
        cores = os.cpu_count() or 1
        self.limit_s = limit_s
        self.workers = Workers(2 * cores + 2, SPARE)
        self.turns = Turns(cores)
        self.answers = Answers()
        self.start: dict[str, Any] = {}
        self.progress: dict[str, str] = {}  # of what is done with a task at rest, as pages name it
        self._opening: tuple[str, asyncio.Task[None]] | None = None
        self._formats: asyncio.Future[Any]
        self._background: set[asyncio.Task[Any]] = set()

    async def begin(self) -> None:
        """Start the worker of the opening task: it loads while this process loads the server."""
        await self.workers.open(1, "opening")

    async def open(self, head: dict[str, Any], data: bytes = b"") -> None:
        """Read the task that the studio opens on, and begin to solve it; raises InputError."""
        async with self.workers.lent() as worker:
            answer, body = await worker.first(head, data)
        told = json.loads(body)
        if answer["kind"] == "failed":
            raise InputError(**told["messages"][0])
        self.start = told
        given = {"document": told["document"], "options": told["options"]}
        key = self.key_of(given)
        self._formats = asyncio.get_running_loop().create_future()
        self._opening = key, self.later(self._solve_opening(key, given))

    async def _solve_opening(self, key: str, given: dict[str, Any]) -> None:
        body, limits_s = as_json(given), self.limits_of(given)
        async with self.workers.lent() as worker:
            with suppress(WorkerEndedError):
                self._formats.set_result(
                    json.loads((await worker.ask({"do": "formats"}, b"{}"))[1])
                )
            with suppress(TimeoutError, WorkerEndedError):  # the page asks again, and is told
                await self.solve(worker, key, body, lambda text: None, limits_s)
        await self.workers.open(SPARE)  # not before: the page is being loaded

    async def beginning(self) -> dict[str, Any]:
        """What a page is told first."""
        assert self._opening is not None
        await asyncio.wait([self._formats, self._opening[1]], return_when=asyncio.FIRST_COMPLETED)
        formats = self._formats.result() if self._formats.done() else []
        if not formats:  # the worker that was asked has ended
            with suppress(TimeoutError, WorkerEndedError):
                formats = json.loads((await self.desk({"do": "formats"}, b"{}"))[1])
        return {**self.start, "exports": formats, "form": form_data()}

    def is_opening(self, key: str) -> bool:
        """Whether this is the key of the opening task, and it is still being solved."""
        return self._opening is not None and self._opening[0] == key and not self._opening[1].done()

    async def opened(self) -> None:
        """Wait until the opening task is solved."""
        if self._opening is not None:
            await asyncio.shield(self._opening[1])

    async def solve(
        self,
        worker: Worker,
        key: str,
        body: bytes,
        said: Callable[[str], object],
        limits_s: tuple[float, float],
    ) -> Message:
        """Search in a worker; raises TimeoutError at the limit, and WorkerEndedError."""
        result, (soft_s, limit_s) = b"", limits_s

        def piece(message: Message) -> None:
            nonlocal result
            if message[0]["kind"] == "result":
                result = message[1]
            else:
                said(message[1].decode())

        worker.key = worker.holder = None
        head = {"do": "solve", "time_limit": soft_s, "limit": limit_s}
        await worker.ready()
        try:
            async with asyncio.timeout(STARVED * limit_s):
                answer = await worker.ask(head, body, piece)
        except WorkerEndedError as error:
            if error.code == OVER:
                raise TimeoutError from None
            raise
        if answer[0]["kind"] == "solved":
            worker.key = key
            self.answers.keep(key, Answer(result, answer[1], answer[0]["advice"]))
        return answer

    async def desk(
        self,
        head: dict[str, Any],
        body: bytes,
        key: str | None = None,
        piece: Callable[[Message], object] | None = None,
        limit_s: float = DESK_S,
    ) -> Message:
        """What is done with a task at rest; raises TimeoutError and WorkerEndedError.

        key: of the task whose answer is wanted, if one is: it is not found twice.
        piece: what takes the pieces of the answer before the last.
        """
        if key is not None:
            head = {**head, "time_limit": SOFT * self.limit_s, "look_limit": SOFT * limit_s}
            if (known := self.answers.get(key)) is not None:
                head["known"] = [len(known.result), len(known.report)]
                body = known.result + known.report + body
        async with self.workers.lent() as worker, asyncio.timeout(limit_s):
            return await worker.ask(head, body, piece)

    def limits_of(self, given: dict[str, Any]) -> tuple[float, float]:
        """Seconds after which the search for a task looks for no more, and is killed."""
        asked = given.get("limit")
        whole = self.limit_s
        if isinstance(asked, int | float) and not isinstance(asked, bool):
            whole = max(whole, min(asked / SOFT, LONGEST_S))
        document = given.get("document")
        poses = document.get("poses") if isinstance(document, dict) else None
        free = (
            (e.get("free") for e in poses if isinstance(e, dict)) if isinstance(poses, list) else ()
        )
        return SOFT * whole, whole * (POINTS_TIMES if any(free) else 1)

    @staticmethod
    def key_of(given: dict[str, Any]) -> str:
        """The key of a task: the same for the same numbers, however they are written.

        "kind": of what was found besides four-bars, such as "six_bars".
        """
        both = [plain(given.get("document")), plain(given.get("options") or {})]
        both += [given["kind"]] if given.get("kind") else []
        return hashlib.sha256(json.dumps(both, sort_keys=True).encode()).hexdigest()

    def later(self, what: Coroutine[Any, Any, Any]) -> asyncio.Task[Any]:
        """Do something beside all else."""
        task = asyncio.create_task(what)
        self._background.add(task)
        task.add_done_callback(self._done)
        return task

    def _done(self, task: asyncio.Task[Any]) -> None:
        self._background.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            traceback.print_exception(error)  # a fault of ours, which nobody waits for
