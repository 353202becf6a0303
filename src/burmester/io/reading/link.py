"""A whole task in a link: `t1=` and a code, behind the `#` of an address or alone.

The code is JSON, deflated, in base64url: a list of the document (the keys of a task file), the
options of `burmester synthesize` by their long names, the name of the task, and the id of the
linkage that is chosen.  Links come from anybody: none unfolds to more than `MOST_BYTES`.

E117 the link cannot be read
"""

from __future__ import annotations

import base64
import json
import re
import zlib
from typing import Any, Final, NamedTuple

from burmester.errors import InputError

VERSION: Final = 1
MOST_CHARACTERS: Final = 20_000  # of a code
MOST_BYTES: Final = 200_000  # of the JSON in it
LABEL: Final = "<link>"  # what errors call it

_LINK = re.compile(r"(?:(?:https?://[^\s#]*)?#)?t([0-9]+)=(.*)", re.DOTALL | re.ASCII)
_HELP = "copy the link once more, to its end"


class LinkedTask(NamedTuple):
    """What a link holds; the document and the options may still be anything."""

    document: dict[str, Any]
    options: dict[str, Any] = {}  # noqa: RUF012  never changed
    name: str = "task"
    choice: str | None = None

    @property
    def data(self) -> bytes:
        """The document as a task file, in short lines: a message shows the line it is about."""
        return json.dumps(self.document, indent=1).encode("ascii")


def is_link(text: str) -> bool:
    """Whether a text is a link to a task, or means to be one.

    >>> is_link("https://example.org/studio/#t1=abc"), is_link("t2="), is_link("poses.csv")
    (True, True, False)
    """
    return _LINK.fullmatch(text.strip()) is not None


def write_link(task: LinkedTask) -> str:
    """The code of a task with its version, to be put behind the `#` of an address.

    Raises E117 where it would be too long to be read again.
    """
    text = json.dumps(task, separators=(",", ":"), ensure_ascii=False).encode(errors="replace")
    packer = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    code = base64.urlsafe_b64encode(packer.compress(text) + packer.flush()).rstrip(b"=").decode()
    if len(code) > MOST_CHARACTERS or len(text) > MOST_BYTES:
        raise _unread("the task is too large for a link", None, "send its file instead")
    return f"t{VERSION}={code}"


def read_link(link: str) -> LinkedTask:
    """The task in a link; raises E117."""
    found = _LINK.fullmatch(link.strip())
    if found is None:
        raise _unread("this is no link to a task", None, "a link has #t1= and a code behind it")
    version, code = found[1].lstrip("0")[:9], found[2]
    if version != str(VERSION):
        raise _unread(
            f"the link has version {version or 0}, and {VERSION} is read",
            "it was made by another version of burmester",
            "install the newest burmester, or ask for the task as a file",
        )
    if len(code) > MOST_CHARACTERS:
        why = f"it has {len(code)} characters, and {MOST_CHARACTERS} are the most"
        raise _unread("the link is too long", why, "ask for the task as a file")
    try:
        text = _unfolded(code)
        given = json.loads(text.decode(), parse_constant=_refuse)
    except (ValueError, zlib.error, RecursionError):
        raise _unread("the link is damaged", "its code does not unfold to a task", _HELP) from None
    parts = given if isinstance(given, list) else []
    document, options, name, choice = (*parts, *[None] * 4)[:4]
    if not isinstance(document, dict):
        raise _unread("the link holds no task", None, _HELP)
    return LinkedTask(
        document,
        options if isinstance(options, dict) else {},
        name if isinstance(name, str) and name else "task",
        choice if isinstance(choice, str) else None,
    )


def _unfolded(code: str) -> bytes:
    """What a code holds; ValueError or zlib.error where it is damaged."""
    if not re.fullmatch("[A-Za-z0-9_-]*", code):
        raise ValueError
    unpacker = zlib.decompressobj(-zlib.MAX_WBITS)
    packed = base64.urlsafe_b64decode(code + "=" * (-len(code) % 4))
    text = unpacker.decompress(packed, MOST_BYTES + 1)
    if len(text) > MOST_BYTES:
        why = f"it unfolds to more than {MOST_BYTES // 1000} kB"
        raise _unread("the link is too large", why, "ask for the task as a file")
    if not unpacker.eof or unpacker.unused_data:
        raise ValueError
    return text


def _refuse(constant: str) -> None:
    """NaN and Infinity, which are no JSON."""
    raise ValueError(constant)


def _unread(message: str, why: str | None, help: str) -> InputError:
    return InputError("E117", message, where=LABEL, why=why, help=help)
