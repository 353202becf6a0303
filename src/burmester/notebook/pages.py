"""What the pages of one widget ask, and what they are told.

A page is one view of the widget; there may be none, or several.  Messages are objects: `do` says
what a page wants, `kind` what it is told, `n` the page's number of the message that is answered,
`view` the page.

    open                         the document: "opened"
    follow  document, shown      a frame: "followed"; of several that wait only the newest counts
    solve   document             "progress" and "solved", which a newer one calls off
    cancel
    choose  id, basis            nothing; basis: the number of the solve that made the id

Nobody asked for "task" (another document, which a page solves for its answer) and "chosen".

A notebook may hear pages in another thread than the one that runs cells: `_lock` is held where
answers are followed or changed.  The whole search runs in a thread of its own, so that a hand is
followed meanwhile; without an event loop (a script, a test) it is gone at once.
"""

from __future__ import annotations

import asyncio
import sys
import threading
import time
import traceback
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from burmester.api.result import Result
from burmester.cures import for_page
from burmester.errors import InputError
from burmester.live.answers import LiveAnswers
from burmester.live.document import TaskReader
from burmester.live.fault import fault_data
from burmester.progress import Progress
from burmester.tasks.motion_task import Task
from burmester.web.data import report_data

if TYPE_CHECKING:
    from burmester.notebook.studio import Studio

PROGRESS_S: Final = 0.1  # between two words of progress
NOT_DRAWN: Final = ("pivot_map", "family_map")  # parts of a report that a widget has no room for

# One search after the other: what is called off ends at its next step.
_one_search = threading.Lock()


class _CalledOffError(Exception):
    """A newer task is there."""


class _Search:
    """One whole search: who wants it, and whether anybody does any more."""

    def __init__(self, view: str, n: int, document: Any) -> None:
        self.view, self.n, self.document = view, n, document
        self.is_wanted = True
        self.say: Callable[[str], object] = len
        self._told = time.monotonic()

    def listen(self, progress: Progress) -> None:
        """Hand on what is said of the progress; ends the computation where it was called off."""
        if not self.is_wanted:
            raise _CalledOffError
        if (now := time.monotonic()) - self._told >= PROGRESS_S:
            self._told = now
            self.say(str(progress))


class Pages:
    """The pages of one widget, and the answers that they share."""

    def __init__(self, studio: Studio) -> None:
        self._studio = studio
        self._live, self._reader = LiveAnswers(), TaskReader()
        self._lock = threading.RLock()
        self._result: Result | None = None
        self._document: Any = None  # of that result
        self._newest: Any = None  # the document of a hand, where that is another one
        self._report: dict[str, Any] | None = None
        self._was: dict[str, dict[str, Any]] = {}
        self._basis: dict[str, int] = {}  # by page: the number of the solve that has this answer
        self._waiting: dict[str, dict[str, Any]] = {}  # by page: the newest follow
        self._search: _Search | None = None
        self._under_way: set[asyncio.Task[None]] = set()
        self._hand: asyncio.Task[None] | None = None

    def begin(self, result: Result, document: Any) -> dict[str, dict[str, Any]]:
        """Another answer; for its linkages the ids before, where they are the same ones."""
        with self._lock:
            before = []
            with suppress(InputError):  # what cannot be followed there is another linkage
                before = self._live.stand(result.task, document)
            self._live.begin_at(result)
            self._result, self._document = result, document
            self._report, self._basis = None, {}
            self._was = self._live.match(before)
            return self._was

    # Told by Python

    def show(self, result: Result, document: Any) -> dict[str, dict[str, Any]]:
        """The same, set by Python: on every page."""
        self._call_off()
        self._newest = document
        was = self.begin(result, document)
        self._tell(None, kind="task", document=document)
        return was

    def choose(self, id: str | None) -> None:
        """Another linkage is selected."""
        self._tell(None, kind="chosen", id=id)

    # Asked by a page

    def hear(self, message: Any) -> None:
        """Do what a page asks for."""
        view, n = message["view"], message["n"]
        match message["do"]:
            case "open":
                self._tell(view, n=n, kind="opened", document=self._document)
            case "follow":
                if (older := self._waiting.get(view)) is not None:
                    self._tell(view, n=older["n"], kind="superseded", by=n)
                self._waiting[view] = message
                if self._hand is None or self._hand.done():
                    self._hand = self._later(self._follow_hand())
            case "solve":
                self._solve(view, n, message["document"])
            case "cancel":
                if self._call_off():
                    self._tell(view, n=n, kind="cancelled", message="called off")
            case "choose":
                self._choose(view, message["id"], message["basis"])

    def _choose(self, view: str, id: str, basis: int | None) -> None:
        known = [] if self._result is None else [each.id for each in self._result]
        if id in known and basis == self._basis.get(view):
            with _told():
                self._studio.follow_choice(id)
            self.choose(id)  # on the other pages

    async def _follow_hand(self) -> None:
        """Answer the newest follow of each page, until there are none."""
        while self._waiting:
            await asyncio.sleep(0)  # what waits is heard before: it may be newer
            if self._waiting:
                _, newest = self._waiting.popitem()
                self._follow(newest)

    def _follow(self, message: dict[str, Any]) -> None:
        view, n, document = message["view"], message["n"], message["document"]
        try:
            with self._lock:
                task = self._reader.task_of(document)
                self._newest = document
                start = self._basis.get(view, -1)
                answer = self._live.follow(n, task, document, set(message["shown"]), start=start)
                if self._result is not None and document == self._document:
                    task = self._result.task
        except Exception as error:
            self._refuse(view, n, error)
            return
        if isinstance(answer, str):
            said = InputError("E157", answer).to_dict()
            self._tell(view, n=n, kind="refused", messages=[said], solve=True)
        else:
            self._studio.send({"view": view, "n": n, "kind": "followed"}, [answer])
        with _told():
            self._studio.follow_hand(task)

    def _solve(self, view: str, n: int, document: Any) -> None:
        """The whole search, unless its answer is there."""
        self._call_off()
        self._newest = document
        if document == self._document:
            if (older := self._waiting.pop(view, None)) is not None:
                self._tell(view, n=older["n"], kind="superseded", by=n)
            with self._lock:
                self._live.restore()
            self._tell_solved(view, n)
            self._tell(view, kind="chosen", id=self._studio.selected)
            if self._result is not None:  # the hand is back where it was
                with _told():
                    self._studio.follow_hand(self._result.task)
            return
        self._search = _Search(view, n, document)
        self._tell(view, n=n, kind="solving", since=time.time())
        self._later(self._go(self._search))

    async def _go(self, search: _Search) -> None:
        """The whole search for a page, beside all else."""
        view, n, document = search.view, search.n, search.document
        loop, start = asyncio.get_running_loop(), time.monotonic()
        tell = partial(self._tell, view, n=n, kind="progress")
        search.say = lambda text: loop.call_soon_threadsafe(lambda: tell(text=text))

        def searched(task: Task) -> tuple[Result, dict[str, Any]]:
            with _one_search:
                if not search.is_wanted:
                    raise _CalledOffError
                result = self._studio.solved(task, progress=search.listen)
                return result, _report_of(result)

        try:
            task = self._reader.task_of(document)
            result, report = await asyncio.to_thread(searched, task)
        except Exception as error:
            if search.is_wanted:
                self._search = None
                self._refuse(view, n, error)
            return
        if not search.is_wanted:
            return
        self._search = None
        is_newest = self._newest == document  # or the hand has moved on
        was = self.begin(result, document)
        self._report = report
        self._tell_solved(view, n, time.monotonic() - start)
        self._tell(None, kind="task", document=document, by=view)
        with _told():
            self._studio.follow_answer(result, was, is_newest=is_newest)

    def _call_off(self) -> bool:
        """Nobody waits for the search any more; whether there was one."""
        search, self._search = self._search, None
        if search is None:
            return False
        search.is_wanted = False
        return True

    def _tell_solved(self, view: str, n: int, seconds: float = 0.0) -> None:
        with self._lock:
            assert self._result is not None
            if self._report is None:
                self._report = _report_of(self._result)
            self._basis[view] = n
            answer = {"result": self._report, "was": self._was}
        self._tell(view, n=n, kind="solved", seconds=round(seconds, 3), **answer)

    def _refuse(self, view: str, n: int, error: Exception) -> None:
        self._tell(view, n=n, kind="refused", messages=[fault_data(error)])

    def _tell(self, view: str | None, **message: Any) -> None:
        self._studio.send({"view": view, **message})

    def _later(self, what: Coroutine[Any, Any, None]) -> asyncio.Task[None] | None:
        """Do something beside all else; at once where there is nothing else."""
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            asyncio.run(what)
            return None
        task = loop.create_task(what)
        self._under_way.add(task)  # the loop itself does not keep it
        task.add_done_callback(self._under_way.discard)
        return task


def _report_of(result: Result) -> dict[str, Any]:
    return {**report_data(result, for_page), **dict.fromkeys(NOT_DRAWN)}


@contextmanager
def _told() -> Iterator[None]:
    """A time in which those who observe the widget are told; their errors end nothing here."""
    try:
        yield
    except Exception as error:
        traceback.print_exception(error, file=sys.stderr)
