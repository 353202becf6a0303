"""One tab: what its page asks over its websocket, and the answers.

Three things go on at once: what the hand asks for (follow, place, curve, cognates), where only
the newest of each counts; the whole search, which a new one replaces; and what is looked for
besides (springs, six-bars), which a new one replaces as well.  Every message has one last answer.
"""

from __future__ import annotations

import asyncio
import json
import time
from contextlib import AbstractContextManager, suppress
from typing import Any, Literal, TypeAlias

from starlette.websockets import WebSocket, WebSocketDisconnect

from burmester.errors import InputError
from burmester.studio.access import PROTOCOL
from burmester.studio.message import as_json, from_json
from burmester.studio.server_state import Answer, ServerState
from burmester.studio.workers import Message, Worker, WorkerEndedError

HAND_S = 5.0  # for one follow; whoever takes longer is stuck
MOST_N = 2**53
HAND = ("follow", "place", "curve", "cognates")
SEARCH = ("solve", "cancel")
LOOK = ("balance", "six_bars", "function", "stop")
LOOK_S = 120.0  # for springs and six-bars, which a person waits for and can stop
# What a page is told; `web/widget/types.d.ts` says the same to the page.
Kind: TypeAlias = (
    Literal["solving", "waiting", "progress", "solved", "limit", "ended", "cancelled"]
    | Literal["superseded", "refused", "followed", "placed", "curve", "cognates", "looked"]
)


class Session:
    """A websocket, the worker that holds its answers, and what is under way."""

    def __init__(self, socket: WebSocket, state: ServerState) -> None:
        self._socket, self._state = socket, state
        self._live: Worker | None = None
        self._from = 0  # the number of the message that its answers are to
        self._newest: dict[str, tuple[int, str]] = {}  # of the hand: the newest of each kind
        self._hand: asyncio.Task[None] | None = None
        self._solving: tuple[int, asyncio.Task[None]] | None = None
        self._looking: tuple[int, asyncio.Task[None]] | None = None

    async def run(self) -> None:
        """Serve the tab until it is closed."""
        await self._socket.accept(subprotocol=PROTOCOL)
        try:
            while True:
                message = await self._socket.receive()
                if message["type"] == "websocket.disconnect":
                    return
                await self._take(message.get("text"))
        except WebSocketDisconnect:
            return
        finally:
            under_way = (each[1] for each in (self._solving, self._looking) if each)
            for task in (self._hand, *under_way):
                if task is not None:
                    task.cancel()
            if self._live is not None and self._live.holder is self:
                self._live.holder = None

    async def _take(self, text: str | None) -> None:
        """Do what a message asks for; a wrong one is refused with a message of its own."""
        try:
            given = from_json(text) if text is not None else None
        except (ValueError, RecursionError):
            given = None
        n = given.get("n") if isinstance(given, dict) else None
        if text is None or type(n) is not int or not 0 <= n < MOST_N:
            await self._refuse(0, "this is no message of the page")
            return
        assert isinstance(given, dict)
        do = given.get("do")
        if do in HAND:
            if (older := self._newest.get(do)) is not None:
                await self._tell(older[0], "superseded", by=n)
            self._newest[do] = n, text
            if self._hand is None or self._hand.done():
                self._hand = self._state.later(self._follow_hand())
        elif do in SEARCH:
            if self._solving is not None and not self._solving[1].done():
                self._solving[1].cancel()
                if do == "cancel":
                    await self._tell(n, "cancelled", message="called off")
                else:
                    await self._tell(self._solving[0], "superseded", by=n)
            if do == "solve":
                key = self._state.key_of(given)
                solving = self._solve(n, key, text, self._state.limits_of(given), "limit" in given)
                self._solving = n, self._state.later(solving)
        elif do in LOOK:
            await self._take_look(n, do, given, text)
        else:
            await self._refuse(n, "this is no message of the page")

    async def _take_look(self, n: int, do: str, given: dict[str, Any], text: str) -> None:
        """Look for what is asked in place of what was looked for, or only stop that."""
        if self._looking is not None and not self._looking[1].done():
            self._looking[1].cancel()
            await self._tell(self._looking[0], "cancelled", message="called off")
        if do == "stop":
            await self._tell(n, "cancelled", message="called off")
        else:
            self._looking = n, self._state.later(self._look(n, do, given, text.encode()))

    async def _follow_hand(self) -> None:
        """Answer the newest messages of the hand, until there are none; follow comes first."""
        while self._newest:
            do = next(each for each in HAND if each in self._newest)
            n, text = self._newest.pop(do)
            try:
                async with asyncio.timeout(HAND_S):
                    head, body = await self._by_hand(do, text)
            except TimeoutError:
                head, body = {"kind": "refused"}, _solve_first("that took too long to follow")
            except WorkerEndedError as error:
                head, body = {"kind": "ended"}, as_json({"messages": [error.data]})
            if head["kind"] == "frame":
                with _if_open():
                    await self._socket.send_bytes(body)
            else:
                kind = "refused" if head["kind"] == "failed" else head["kind"]
                await self._send(n, kind, body)

    async def _by_hand(self, do: str, text: str) -> Message:
        last = None
        while self._live is not last:  # while it waits, a search may bring another one
            last = self._live
            async with self._state.workers.held(last, self) as live:
                if live is not None:
                    return await live.ask({"do": do, "from": self._from}, text.encode())
        if do == "follow":
            if last is not None and not last.alive:
                self._live = None
                raise WorkerEndedError(last.code)
            return {"kind": "refused"}, _solve_first("there is nothing to follow yet")
        async with self._state.workers.lent() as worker:
            return await worker.ask({"do": do}, text.encode())

    async def _solve(
        self, n: int, key: str, text: str, limits_s: tuple[float, float], longer: bool
    ) -> None:
        """The whole search, when it is this one's turn; longer: also where it was made before."""
        state, start = self._state, time.monotonic()
        try:
            if state.is_opening(key):
                await self._tell(n, "solving", since=time.time())
                await state.opened()

            def waits(before: int) -> None:
                state.later(self._tell(n, "waiting", before=before))

            def said(text: str) -> None:
                state.later(self._tell(n, "progress", text=text))

            async with state.turns.turn(waits), state.workers.lent(key) as worker:
                is_own = worker is self._live and worker.holder is self
                before = await self._snapshot(worker, text) if is_own else None
                known = None if longer or worker.key != key else state.answers.get(key)
                if known is not None:
                    await worker.ask({"do": "again"}, b"{}")
                    body, advice = known.report, known.advice
                else:
                    await self._tell(n, "solving", since=time.time())
                    head, body = await state.solve(worker, key, text.encode(), said, limits_s)
                    if head["kind"] == "failed":
                        await self._send(n, "refused", body)
                        return
                    advice = head["advice"]
                was = await self._match_ids(worker, before, text)
                self._hold(worker, n)
            seconds = round(time.monotonic() - start, 3)
            await self._send(
                n, "solved", body, key="result", seconds=seconds, was=was, advice=advice
            )
        except TimeoutError:
            message = f"stopped after {limits_s[1]:g} s of computing, the limit"
            await self._tell(n, "limit", message=message)
        except WorkerEndedError as error:
            await self._tell(n, "ended", messages=[error.data])

    async def _look(self, n: int, do: str, given: dict[str, Any], body: bytes) -> None:
        """What is looked for besides, in a worker that is nobody's."""
        state = self._state
        key = state.key_of(given)
        result = b""

        def piece(message: Message) -> None:
            nonlocal result
            if message[0]["kind"] == "result":
                result = message[1]
            else:
                state.later(self._tell(n, "progress", text=message[1].decode()))

        try:
            head, data = await state.desk({"do": do}, body, key, piece, LOOK_S)
        except TimeoutError:
            await self._tell(n, "limit", message=f"stopped after {LOOK_S:g} s, the limit")
        except WorkerEndedError as error:
            await self._tell(n, "ended", messages=[error.data])
        else:
            if result:
                state.answers.keep(state.key_of({**given, "kind": do}), Answer(result, data))
            await self._send(n, "refused" if head["kind"] == "failed" else "looked", data)

    async def _snapshot(self, live: Worker, text: str) -> bytes | None:
        """Where the linkages of the page are at a task."""
        try:
            head, before = await live.ask({"do": "stand"}, text.encode())
        except WorkerEndedError:
            return None
        return None if head["kind"] == "failed" else before

    async def _match_ids(self, worker: Worker, before: bytes | None, text: str) -> dict[str, Any]:
        """For the new linkages the ids that they have on the page, where they are there already.

        before: where those are, if the worker that held them has the new ones by now.
        """
        if self._live is not worker:
            async with self._state.workers.held(self._live, self) as live:
                before = None if live is None else await self._snapshot(live, text)
        if before is None:
            return {}
        head, body = await worker.ask({"do": "match"}, before)
        was: dict[str, Any] = {} if head["kind"] == "failed" else json.loads(body)
        return was

    def _hold(self, worker: Worker, n: int) -> None:
        """Come back to this worker from now on, and leave the last one to others."""
        if self._live is not None and self._live is not worker and self._live.holder is self:
            self._live.holder = None
        self._live, self._from, worker.holder = worker, n, self

    async def _refuse(self, n: int, why: str) -> None:
        await self._send(n, "refused", as_json({"messages": [InputError("400", why).to_dict()]}))

    async def _tell(self, n: int, kind: Kind, **more: Any) -> None:
        with _if_open():
            await self._socket.send_text(as_json({"n": n, "kind": kind, **more}).decode())

    async def _send(
        self, n: int, kind: str, body: bytes, *, key: str | None = None, **more: Any
    ) -> None:
        """An object whose JSON is there already, or under `key` a piece of it."""
        front = as_json({"n": n, "kind": kind, **more}).decode()[:-1]
        rest = f',"{key}":{body.decode()}}}' if key else f",{body.decode()[1:]}"
        with _if_open():
            await self._socket.send_text(front + rest)


def _if_open() -> AbstractContextManager[None]:
    """Whoever has closed the tab need not be told any more."""
    return suppress(WebSocketDisconnect, RuntimeError)


def _solve_first(why: str) -> bytes:
    return as_json({"messages": [InputError("E157", why).to_dict()], "solve": True})
