"""Signals that end a command: what it was writing is taken away first.

Only the command handles them (`handled`); a program that imports burmester keeps its own handlers.
The first signal is raised as an exception where the program stands, so that every `finally` is
done.  A second one ends the process at once, and so does a first one whose exception Python
drops, as it does in a destructor; unfinished files are removed then, too.
"""

from __future__ import annotations

import atexit
import os
import signal
import sys
from contextlib import contextmanager, suppress

TYPE_CHECKING = False  # nothing is loaded here that is not needed: signals come at any time
if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType
    from typing import Any, NoReturn

unfinished: set[str] = set()  # files that nobody is to find if the process ends now

_ENDING = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
]
_came: list[int] = []


def exit_code() -> int | None:
    """The exit code of the signal that came: 130 for SIGINT, 143 for SIGTERM; None if none did."""
    return 128 + _came[0] if _came else None


@contextmanager
def handled() -> Iterator[None]:
    """Raise KeyboardInterrupt at SIGINT, and SystemExit at SIGTERM and SIGHUP, in this block.

    A signal that somebody else handles or ignores, as `nohup` does SIGHUP, is left alone.
    """
    before, hook = {}, sys.unraisablehook
    with suppress(ValueError):  # not the main thread, which alone can handle signals
        for number in _ENDING:
            if signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler):
                before[number] = signal.signal(number, _raise)
    if before:  # not within a block like this one
        _came.clear()
    sys.unraisablehook = _end_or_show
    try:
        yield
    finally:
        sys.unraisablehook = hook
        _remove_unfinished()
        for number, handler in before.items():
            signal.signal(number, handler)


def end(code: int) -> NoReturn:
    """End the process with an exit code that is known; no signal changes it any more.

    What was registered for the end is done.  But the interpreter is not taken down piece by piece:
    that takes a tenth of a second, with solid parts a second, and nobody could stop it.
    """
    for number in _ENDING:
        signal.signal(number, signal.SIG_IGN)
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError, AttributeError):
            stream.flush()
    os._exit(code)


def _raise(number: int, frame: FrameType | None) -> None:
    if _came:
        _end()
    _came.append(number)
    if number == signal.SIGINT:
        raise KeyboardInterrupt
    raise SystemExit(128 + number)


def _end_or_show(dropped: Any) -> None:
    """What Python does with an exception that it has to drop, but for those of `_raise`."""
    if _came and isinstance(dropped.exc_value, KeyboardInterrupt | SystemExit):
        _end()
    sys.__unraisablehook__(dropped)


def _end() -> None:
    _remove_unfinished()
    os._exit(exit_code() or 1)


def _remove_unfinished() -> None:
    for path in tuple(unfinished):
        with suppress(OSError):
            os.unlink(path)
