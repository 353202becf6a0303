"""Standard streams as anybody may hand them over: closed, full, or with nobody reading.

What cannot be written does not stop a command on its way to its verdict.  A reader that has gone,
as `head` goes, wanted no more; any other reason is told at the end.
"""

from __future__ import annotations

import errno
import io
import os
import select
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO

_GONE = (errno.EPIPE, errno.ESHUTDOWN, errno.ECONNRESET)


class _Guard(io.RawIOBase):
    """A stream that takes all that is written, and keeps the reason why it could not pass it on."""

    def __init__(self, raw: Any) -> None:
        super().__init__()
        self.raw = raw
        self.failure: OSError | None = None

    def write(self, data: Any) -> int:
        """Pass bytes on, or drop them where that has failed; waits for a slow reader."""
        while self.failure is None:
            try:
                count: int | None = self.raw.write(data)
            except OSError as error:
                self.failure = error
            else:
                if count is not None:
                    return count
                select.select([], [self.raw], [])  # it does not wait by itself
        return len(data)

    def writable(self) -> bool:
        """It is."""
        return True

    def fileno(self) -> int:
        """The descriptor below."""
        number: int = self.raw.fileno()
        return number

    def isatty(self) -> bool:
        """Whether it leads to a terminal."""
        return bool(self.raw.isatty())


@contextmanager
def guarded() -> Iterator[None]:
    """Standard output and error behind guards, and no descriptor of the three left to a file.

    Where standard input is closed, `sys.stdin` stays None.
    """
    _occupy()
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = map(_behind_guard, before)
    try:
        yield
    finally:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        sys.stdout, sys.stderr = before


def failure() -> OSError | None:
    """Why standard output could not be written, if not because its reader has gone."""
    sys.stdout.flush()
    guard = getattr(getattr(sys.stdout, "buffer", None), "raw", None)
    if not isinstance(guard, _Guard) or guard.failure is None:
        return None
    return None if guard.failure.errno in _GONE else guard.failure


def _occupy() -> None:
    """Open the null device under each descriptor that is closed: the next file would get it."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)


def _behind_guard(stream: TextIO | None) -> TextIO:
    """The stream with what it cannot show escaped, and behind a guard if it leads to a system's."""
    if stream is None:
        return open(os.devnull, "w", encoding="utf-8")
    if not isinstance(stream, io.TextIOWrapper):
        return stream
    raw = getattr(stream.buffer, "raw", stream.buffer)
    if not isinstance(raw, io.RawIOBase):
        stream.reconfigure(errors="backslashreplace")
        return stream
    return io.TextIOWrapper(
        io.BufferedWriter(_Guard(raw)),
        encoding=stream.encoding,
        errors="backslashreplace",
        line_buffering=stream.line_buffering or stream.write_through,  # as PYTHONUNBUFFERED asks
    )
