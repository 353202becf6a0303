"""Where tasks come from: a long table, a file of JSON lines, a folder of files, or draws."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, final

from burmester.batch.long_tables import is_pair_table, is_parquet_file, table_parts
from burmester.batch.parts import Part, TextTasks
from burmester.errors import InputError
from burmester.printable import printable

LINES = (".jsonl", ".ndjson", ".jsonlines")


SUFFIXES = (".csv", ".tsv", ".txt", ".json", ".toml", ".parquet", ".xlsx", ".svg", ".dxf")
MOST_BYTES = 50_000_000  # of one task, as for `burmester synthesize`


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


def file_names(folder: str) -> list[str]:
    """The task files of a folder, in the order of their names; raises E101 and E102."""
    with os.scandir(folder) as entries:
        names = sorted(
            each.name
            for each in entries
            if each.is_file() and not each.name.startswith(".")
            if os.path.splitext(each.name)[1].lower() in SUFFIXES
        )
    if not names:
        why = f"task files end in {', '.join(SUFFIXES)}"
        help = "give a folder with a file for each task, or a table of tasks"
        message = "there are no task files in this folder"
        raise InputError("E102", message, where=printable(folder), why=why, help=help)
    return names


def files_digest(folder: str, names: list[str]) -> str:
    """The SHA-256 of all names and contents."""
    digest = hashlib.sha256()
    for name in names:
        with open(os.path.join(folder, name), "rb") as file:
            content = hashlib.file_digest(file, "sha256").hexdigest()
        digest.update(f"{content} {len(os.fsencode(name))} ".encode() + os.fsencode(name))
    return digest.hexdigest()


def file_parts(folder: str, names: list[str], size: int) -> Iterator[Part]:
    """The parts of a folder, each of `size` files but for the last."""
    for number, first in enumerate(range(0, len(names), size)):
        some = names[first : first + size]
        paths = [os.path.join(folder, name) for name in some]
        data = tuple(map(_content, paths))
        shown, labels = tuple(map(printable, some)), tuple(map(printable, paths))
        share = (first + len(some)) / len(names)
        yield Part(number, TextTasks(shown, labels, data), share)


def _content(path: str) -> bytes:
    with open(path, "rb") as file:
        data = file.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise _too_large(printable(path))
    return data


def line_parts(path: str, size: int) -> Iterator[Part]:
    """The parts of a file with a task a line, in JSON; tasks are named by their lines."""
    label, number = printable(path), 0
    total = max(1, os.path.getsize(path))
    held: list[tuple[str, str, bytes]] = []
    with open(path, "rb") as file:
        line, place = file.readline(MOST_BYTES + 1), 1
        while line:
            if len(line) > MOST_BYTES:
                raise _too_large(f"{label}:{place}")
            if text := line.strip():
                held.append((str(place), f"{label}, line {place}", text))
            if len(held) == size:
                yield Part(number, _together(held), file.tell() / total)
                number, held = number + 1, []
            line, place = file.readline(MOST_BYTES + 1), place + 1
    if held:
        yield Part(number, _together(held), 1.0)
    elif number == 0:
        raise InputError("E102", "there are no tasks: every line is blank", where=label)


def _together(held: list[tuple[str, str, bytes]]) -> TextTasks:
    names, labels, data = zip(*held, strict=True)
    return TextTasks(names, labels, data)


def _too_large(where: str) -> InputError:
    why = f"it has more than {MOST_BYTES / 1e6:.0f} MB"
    help = "take one pose in ten, say: so many hardly tell more"
    return InputError("E101", "a task is too large", where=where, why=why, help=help)
