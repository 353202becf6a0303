"""What a computation is doing, how far it is, and whether there is time to go on.

Rooms of science say in plain words what they begin: `step` for what has to be done, `time_for` for
what only makes the answer better.  Loops say how far they are (`goes_on`), and end where the time
is over.  They know nobody who listens.  A command or a notebook listens with `shown` and sets a
limit with `limited`; without these nothing happens, and nothing ends early.

>>> from burmester.progress import goes_on, shown, time_for
>>> with shown(print):
...     if time_for("refining 12 linkages"):
...         number = 1
...         while number <= 2 and goes_on(number, 60):
...             number += 1
refining 12 linkages
refining 12 linkages, step 1 of 60
refining 12 linkages, step 2 of 60
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from time import monotonic
from typing import NamedTuple, TypeAlias, final


@final
class Progress(NamedTuple):
    """What a computation is doing, and how far it is.

    text: "refining 12 linkages", or with the part of it that is in hand "looking for better
    linkages near it, search 3 of 16"; number, total: the step in hand, counted from 1, of so many
    at most, both 0 where nobody can tell; unit: what these count, "step" or "generation".

    >>> print(Progress("refining 12 linkages", 8, 60))
    refining 12 linkages, step 8 of 60
    """

    text: str
    number: int = 0
    total: int = 0
    unit: str = "step"

    def __str__(self) -> str:
        return (
            f"{self.text}, {self.unit} {self.number} of {self.total}" if self.total else self.text
        )


Listener: TypeAlias = Callable[[Progress], object]


@final
@dataclass(slots=True)
class Watch:
    """Who listens, when the time is over, and what it ended.

    clock: by which the end is told, in seconds; None: by that of the wall.
    text: what is being done; part: the part of it, such as ", search 3 of 16"; optional: whether
        it may be ended.
    cut: what was begun and ended by the limit; left_out: what was not begun.
    """

    listener: Listener | None = None
    end: float = math.inf
    clock: Callable[[], float] | None = None
    text: str = ""
    part: str = ""
    optional: bool = False
    cut: list[str] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)

    def begin(self, text: str, *, needed: bool, whole: bool) -> bool:
        """Whether there is time for what begins; for what is needed there always is."""
        self.text, self.part, self.optional = text, "", not whole
        if not needed and self.is_over():
            if text not in self.left_out:
                self.left_out.append(text)
            return False
        if self.listener is not None:
            self.listener(Progress(text))
        return True

    def now(self) -> float:
        """What the clock says."""
        return (self.clock or monotonic)()

    def is_over(self) -> bool:
        """Whether the time is over."""
        return self.end < math.inf and self.now() >= self.end


_watch: ContextVar[Watch | None] = ContextVar("progress", default=None)


def step(text: str, *, whole: bool = True) -> None:
    """Say what begins and has to be done: "looking for dyads"; whole: all of it."""
    if (watch := _watch.get()) is not None:
        watch.begin(text, needed=True, whole=whole)


def time_for(text: str, *, whole: bool = False) -> bool:
    """Say what begins and makes the answer better: "refining 12 linkages"; False: no time is left.

    It may be ended (`goes_on`) until something else begins.  whole: once begun it is not, as half
    of it would say something wrong.
    """
    watch = _watch.get()
    return watch is None or watch.begin(text, needed=False, whole=whole)


def goes_on(number: int, total: int, unit: str = "step", *, has_steps: bool = False) -> bool:
    """Say which step (counted from 1) of how many begins; False: the time for it is over.

    has_steps: whether it has steps itself, which say how far they are.
    """
    watch = _watch.get()
    if watch is None:
        return True
    if watch.optional and watch.is_over():
        if watch.text not in watch.cut:
            watch.cut.append(watch.text)
        return False
    if has_steps:
        watch.part = f", {unit} {number} of {total}"
    elif watch.listener is not None:
        watch.listener(Progress(watch.text + watch.part, number, total, unit))
    return True


@contextmanager
def shown(listener: Listener | None) -> Iterator[None]:
    """Call `listener` with what is begun in this block, and with every step of it; None: nobody.

    What it raises ends the computation, and comes through.
    """
    if listener is None:
        yield
        return
    with _watching(replace(_watch.get() or Watch(), listener=listener)):
        yield


@contextmanager
def limited(seconds: float | None) -> Iterator[Watch]:
    """End what may be ended, so many seconds after the block has begun; None: do not."""
    watch = replace(_watch.get() or Watch(), cut=[], left_out=[])
    watch.end = min(math.inf if seconds is None else watch.now() + seconds, watch.end)
    with _watching(watch):
        yield watch


@contextmanager
def timed_by(clock: Callable[[], float]) -> Iterator[None]:
    """Let limits within this block count another time, such as that of the processor."""
    with _watching(replace(_watch.get() or Watch(), clock=clock)):
        yield


@contextmanager
def _watching(watch: Watch) -> Iterator[None]:
    token = _watch.set(watch)
    try:
        yield
    finally:
        _watch.reset(token)
