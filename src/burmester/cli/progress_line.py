"""One line on the terminal that says what takes so long and how far it is, and goes at the end.

It stands on standard error, only where that is a terminal, and comes after half a second.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

from burmester.progress import Progress, shown

DELAY_S = 0.5  # seconds before the line comes
PERIOD_S = 0.25  # seconds between two looks at what is being done
TYPED = 4  # columns beyond the line, where a terminal shows ^C
USUAL_COLUMNS = 80  # of a terminal that does not tell them


@contextmanager
def working(text: str) -> Iterator[None]:
    """Show what the block is doing, `text` at first; nothing where no terminal could erase it."""
    if not sys.stderr.isatty() or os.environ.get("TERM") in ("dumb", "unknown"):
        yield
        return
    line = _Line(text, sys.stderr)
    line.thread.start()
    try:
        with shown(line.say):
            yield
    finally:
        line.done.set()
        line.thread.join()


class _Line:
    """What is being done since when, and the thread that shows it."""

    def __init__(self, text: str, stream: TextIO) -> None:
        self.doing, self.stream = Progress(text), stream
        self.done = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)

    def say(self, doing: Progress) -> None:
        self.doing = doing

    def _run(self) -> None:
        begun, line = time.monotonic(), ""
        if self.done.wait(DELAY_S):
            return
        while True:
            before, line = line, self._shown(time.monotonic() - begun)
            if line != before:
                self._write(f"\r{line.ljust(len(before))}")
            if self.done.wait(PERIOD_S):
                break
        size = min(len(line) + TYPED, self._columns() - 1)
        self._write(f"\r{' ' * size}\r")

    def _shown(self, seconds: float) -> str:
        """The text on one line of the terminal, whose last column stays free."""
        clock = f" ... {seconds:.0f} s" if seconds >= 1 else " ..."
        room = self._columns() - 1
        return str(self.doing)[: max(0, room - len(clock))] + clock[: max(0, room)]

    def _columns(self) -> int:
        try:
            return os.get_terminal_size(self.stream.fileno()).columns or USUAL_COLUMNS
        except OSError:
            return USUAL_COLUMNS

    def _write(self, text: str) -> None:
        self.stream.write(text)
        self.stream.flush()
