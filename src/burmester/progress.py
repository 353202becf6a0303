"""What a computation is doing, for whoever waits for it.

Rooms of science say in plain words what they begin (`step`), and know nobody who listens.  A
command or a notebook listens with `shown`; where nobody does, nothing happens.

>>> from burmester.progress import shown, step
>>> with shown(print):
...     step("refining 12 linkages")
refining 12 linkages
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

__all__ = ["shown", "step"]

_listener: ContextVar[Callable[[str], object] | None] = ContextVar("progress", default=None)


def step(text: str) -> None:
    """Say what begins: "refining 12 linkages"."""
    if (listener := _listener.get()) is not None:
        listener(text)


@contextmanager
def shown(listener: Callable[[str], object]) -> Iterator[None]:
    """Call `listener` with the text of every step that is begun in this block."""
    token = _listener.set(listener)
    try:
        yield
    finally:
        _listener.reset(token)
