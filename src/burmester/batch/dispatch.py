"""Parts go out, worked parts come back; what a part does to its worker ends with that part.

A part whose worker ended, or that raised an error, is set aside while the others go on, and then
tried alone.  If it fails alone as well, its tasks are tried in halves, until the tasks that fail
are known.  These are marked as failed, with the reason, and the part is worked on without them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import replace
from time import monotonic
from typing import Any, TypeAlias, final

from burmester.batch.engines import Engine
from burmester.batch.parts import Part
from burmester.errors import BurmesterError

Work: TypeAlias = Callable[[Part, Any, Mapping[int, str]], Any]

AHEAD = 4  # for so many workers one more part is handed out than is worked on, and two at least
PERIOD_S = 0.2  # between two looks whether to stop


@final
class Dispatch:
    """Hands out parts until there are none, or until somebody asks it to stop.

    work: done with each part, the plan, and the tasks that are to be left out; keep: takes each
    worked part; stopped: whether to stop; tick: called now and then; limit: seconds after which a
    worker gives a part up.
    """

    def __init__(
        self,
        engine: Engine,
        work: Work,
        plan: Any,
        keep: Callable[[Part, Any], None],
        *,
        stopped: Callable[[], bool] = lambda: False,
        tick: Callable[[], None] = lambda: None,
        limit: float = float("inf"),
    ) -> None:
        self._engine, self._work, self._plan, self._keep = engine, work, plan, keep
        self._stopped, self._tick, self._limit = stopped, tick, limit
        self._running: dict[Future[Any], Part] = {}
        self._aside: list[Part] = []
        self._left_out = False  # whether a part was given up as somebody asked to stop

    def run(self, parts: Iterator[Part]) -> bool:
        """Work on all parts; False: it was stopped before the last one."""
        more = True
        while more and not self._stopped():
            more = self._hand_out(parts)
            while self._aside and not self._stopped():
                self._alone(self._aside.pop(0))
        return not (more or self._aside or self._left_out)

    def _hand_out(self, parts: Iterator[Part]) -> bool:
        """Work on parts until none are left (False), or until many are set aside."""
        more = True
        while True:
            while more and not self._stopped() and len(self._aside) <= self._most:
                if len(self._running) >= self._most:
                    break
                part = next(parts, None)
                if part is None:
                    more = False
                    break
                self._running[self._begin(part, {})] = part
            if self._stopped():
                self._call_off()
            if not self._running:
                return more
            done, _ = wait(self._running, PERIOD_S, FIRST_COMPLETED)
            for future in done:
                self._take(future)
            self._tick()

    @property
    def _most(self) -> int:
        return self._engine.size + max(2, self._engine.size // AHEAD)

    def _begin(self, part: Part, left_out: Mapping[int, str]) -> Future[Any]:
        return self._engine.submit(self._work, part, self._plan, left_out)

    def _call_off(self) -> None:
        """Take back what nobody works on yet."""
        for future in [each for each in self._running if each.cancel()]:
            del self._running[future]
            self._left_out = True

    def _take(self, future: Future[Any]) -> None:
        """Keep what came of a part, or set the part aside."""
        part = self._running.pop(future)
        try:
            worked = future.result()
        except BurmesterError:
            raise
        except Exception:
            self._aside.append(part)
        else:
            self._keep(part, worked)

    def _alone(self, part: Part) -> None:
        """Work on a part that failed among others, with nothing beside it."""
        worked, _ = self._tried(part, {}, self._engine.tries)
        if worked is None and not self._stopped():
            failed = self._guilty(part, range(len(part.tasks)))
            if self._stopped():
                self._left_out = True
                return
            worked, reason = self._tried(part, failed, 1)
            if worked is None:  # tasks that fail together only
                every = dict.fromkeys(range(len(part.tasks)), reason)
                worked, reason = self._tried(part, {**every, **failed}, 1)
            if worked is None and not self._stopped():
                raise RuntimeError(f"part {part.number} cannot be written: {reason}")
        if worked is not None:
            self._keep(part, worked)
        else:
            self._left_out = True

    def _guilty(self, part: Part, indices: Sequence[int]) -> dict[int, str]:
        """Which of some tasks fail, with the reasons; together they do."""
        if len(indices) == 1:
            reason = self._reason(part, indices)
            return {} if reason is None else {indices[0]: reason}
        found: dict[int, str] = {}
        middle = len(indices) // 2
        for half in (indices[:middle], indices[middle:]):
            if self._stopped():
                break
            if len(half) == 1 or self._reason(part, half, 1) is not None:
                found |= self._guilty(part, half)
        return found

    def _reason(self, part: Part, indices: Sequence[int], tries: int | None = None) -> str | None:
        """Why some tasks of a part fail alone; None: they do not."""
        some = replace(part, tasks=part.tasks.only(indices))
        worked, reason = self._tried(some, {}, tries or self._engine.tries)
        return reason if worked is None else None

    def _tried(self, part: Part, left_out: Mapping[int, str], tries: int) -> tuple[Any, str]:
        """What comes of a part alone, or why nothing does."""
        reason = "it was stopped"
        for _ in range(tries):
            if self._stopped():
                break
            begun = monotonic()
            try:
                future = self._begin(part, left_out)
                while not future.done():
                    wait([future], PERIOD_S)
                    self._tick()
                return future.result(), ""
            except self._engine.lost:
                if monotonic() - begun >= self._limit:
                    return None, f"it takes longer than {self._limit:g} s"
                reason = "its worker ended each time: killed, or out of memory"
            except BurmesterError:
                raise
            except MemoryError:
                return None, "it needs more memory than its worker may have"
            except Exception as error:
                said = str(error).partition("\n")[0][:200]
                return None, f"burmester itself failed: {type(error).__name__}: {said}"
        return None, reason
