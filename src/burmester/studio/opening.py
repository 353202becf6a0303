"""The task that the studio opens on: read by a worker before it loads all that solves it."""

from __future__ import annotations

from contextlib import suppress
from pathlib import PurePath
from typing import Any, Final

from burmester.errors import InputError
from burmester.io import templates
from burmester.io.reading.file_content import read_source
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.functions.function_kind import is_function
from burmester.io.reading.link import is_link, read_link
from burmester.io.reading.outlines.outline_file import drawing_named
from burmester.io.reading.poses import read_task
from burmester.live.document import (
    document_of,
    function_document,
    options_of,
    picture_in,
    read_document,
)

EMPTY: Final = {"length_unit": "mm", "angle_unit": "deg", "poses": []}  # beside a function


def opening(head: dict[str, Any], data: bytes) -> dict[str, Any]:
    """A file of this machine or a link by its "path", or a "template"; data: of "-" (stdin).

    Raises what the readers raise.
    """
    if (path := head["path"]) is None:
        return template(head["template"])
    is_drawing = drawing_named(path) is not None  # maybe a part of it: its reader opens it
    named = PurePath(path.removeprefix("case:")).stem if path != "-" else "task"
    beside: dict[str, Any] = {"options": {}, "name": named}
    if is_link(path):
        link = read_link(path)
        options_of(link.options)  # what cannot be asked is refused here
        beside, data = link._asdict(), link.data
    elif path != "-" and not is_drawing:
        with suppress(InputError):  # the reader of poses says which file it is
            data = read_source(path)
    if not is_drawing and is_function(data, path):
        document = function_document(read_function(data, path))
        return {**beside, "document": EMPTY, "function": document["function"]}
    task = read_task(path, data=data or (b"" if path == "-" else None))
    if path.lower().endswith((".toml", ".json")) and not path.startswith("case:"):
        beside["picture"] = picture_in(path, data)
    return {**beside, "document": document_of(task)}


def template(name: str) -> dict[str, Any]:
    """A template as a document."""
    document, _ = read_document(f"{name}.toml", templates.text(name).encode())
    return {"document": document, "options": {}, "name": name}
