"""Errors of rooms that the command shares, with the arguments of Python for its options."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from burmester.cures import for_python, said
from burmester.errors import InputError


@contextmanager
def in_python_words() -> Iterator[None]:
    """Let an InputError say `force=True` where it says `--force`."""
    try:
        yield
    except InputError as error:
        error.why = error.why and said(error.why, for_python)
        error.help = error.help and said(error.help, for_python)
        raise
