"""What server and worker hand each other through a pipe: a head of a few keys, and a body.

Both lengths stand in front as four bytes each, little end first; the head is JSON in UTF-8, the
body is whatever the head says it is.  Nothing is pickled: what comes out of the pipe is data.
"""

from __future__ import annotations

import json
import struct
from typing import Any, Final, Protocol

_LENGTHS = struct.Struct("<II")
LENGTHS = _LENGTHS.size
OVER: Final = 75  # the exit code of a worker that has spent all its time
MOST_DEPTH: Final = 100  # of what the page sends; Python's own limit may be reached anywhere


class Stream(Protocol):
    """What bytes are read from, such as a file."""

    def read(self, size: int, /) -> bytes:
        """So many bytes, or fewer at the end."""


def as_json(data: object) -> bytes:
    """JSON that is plain ASCII, half characters and all: any decoder takes it."""
    return json.dumps(data, allow_nan=False, separators=(",", ":")).encode("ascii")


def from_json(text: str | bytes) -> Any:
    """What the page sent; raises ValueError where it is no JSON, and RecursionError if too deep."""
    given = json.loads(text)
    level = [given]
    for _ in range(MOST_DEPTH):
        nested = [each for each in level if isinstance(each, dict | list)]
        inner = (each.values() if isinstance(each, dict) else each for each in nested)
        level = [each for every in inner for each in every]
    if level:
        raise RecursionError
    return given


def packed(head: dict[str, Any], body: bytes = b"") -> bytes:
    """A message as bytes."""
    front = as_json(head)
    return _LENGTHS.pack(len(front), len(body)) + front + body


def lengths(front: bytes) -> tuple[int, int]:
    """The lengths of head and body, from the first `LENGTHS` bytes."""
    head, body = _LENGTHS.unpack(front)
    return head, body


def read_message(stream: Stream) -> tuple[dict[str, Any], bytes] | None:
    """The next message of a stream that waits for its bytes; None where it has ended."""
    front = stream.read(LENGTHS)
    if len(front) < LENGTHS:
        return None
    head, body = lengths(front)
    whole = stream.read(head + body)
    return None if len(whole) < head + body else (json.loads(whole[:head]), whole[head:])
