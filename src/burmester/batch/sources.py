"""Where tasks come from: a long table, a file of JSON lines, a folder of files, or draws."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, final

from burmester.batch.long_tables import is_pair_table, is_parquet_file, table_parts
from burmester.batch.parts import Part
from burmester.batch.task_texts import file_names, file_parts, files_digest, line_parts
from burmester.errors import InputError
from burmester.printable import printable

LINES = (".jsonl", ".ndjson", ".jsonlines")


@final
@dataclass(frozen=True, slots=True)
class Source:
    """Tasks that are read from front to back.

    kind: in words; name: of the file or folder; digest: the SHA-256 of all that is read; parts:
    cuts them into parts of a size; unchanged: whether the file is still the one that the digest is
    of; told: what else the manifest says of them; pairs: whether they are pairs of angles.
    """

    kind: str
    name: str
    digest: str
    parts: Callable[[int], Iterator[Part]]
    unchanged: Callable[[], bool] = lambda: True
    told: Mapping[str, Any] = field(default_factory=dict)
    pairs: bool = False


def open_source(path: str) -> Source:
    """The tasks in a file or a folder; raises E101 and E102."""
    try:
        name = printable(os.path.basename(os.path.abspath(path)))
        if os.path.isdir(path):
            names = file_names(path)
            digest = files_digest(path, names)
            return Source("folder", name, digest, lambda size: file_parts(path, names, size))
        before = os.stat(path)
        with open(path, "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()

        def unchanged() -> bool:
            now = os.stat(path)
            return (now.st_size, now.st_mtime_ns) == (before.st_size, before.st_mtime_ns)

        lines = not is_parquet_file(path) and (
            os.path.splitext(path)[1].lower() in LINES or _begins_as_json(path)
        )
        cut, kind = (line_parts, "JSON lines") if lines else (table_parts, "table")
        pairs = not lines and is_pair_table(path)
        return Source(kind, name, digest, lambda size: cut(path, size), unchanged, pairs=pairs)
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        why = getattr(error, "strerror", None) or str(error)
        help = "give a table (.parquet, .csv), a file of JSON lines (.jsonl) or a folder"
        where = printable(path)
        message = "the tasks cannot be read"
        raise InputError("E101", message, where=where, why=why, help=help) from None


def _begins_as_json(path: str) -> bool:
    with open(path, "rb") as file:
        return file.read(1024).lstrip().startswith((b"{", b"["))
