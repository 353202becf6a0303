"""Errors of rooms that the command shares, with the arguments of Python for its options."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from burmester.errors import InputError

_FLAG = re.compile(r"add --force\b")
_TEXT = re.compile(r"--(?:length-)?(to|unit) (?!out\b)(\w+)")
_NUMBER = re.compile(r"--(hole|width|thickness|gap|pose) ([\d.e+-]*\d)")
_NAME = re.compile(r"--(?:length-)?([a-z]+)")


@contextmanager
def in_python_words() -> Iterator[None]:
    """Let the help of an InputError say `force=True` where it says `--force`."""
    try:
        yield
    except InputError as error:
        if error.help:
            help = _FLAG.sub("give force=True", error.help)
            help = _NUMBER.sub(r"\1=\2", _TEXT.sub(r'\1="\2"', help))
            error.help = _NAME.sub(r"\1", help)
        raise
