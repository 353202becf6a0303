"""Tasks in texts of their own: the files of a folder, or the lines of a file of JSON.

A text is read by the worker that gets it, as `burmester synthesize` reads a file; one that cannot
be read is refused alone.

E101 not readable      E102 no tasks      E112 a task that is too large
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator

from burmester.batch.parts import Part, TextTasks
from burmester.errors import InputError
from burmester.printable import printable

SUFFIXES = (".csv", ".tsv", ".txt", ".json", ".toml", ".parquet", ".xlsx", ".svg", ".dxf")
MOST_BYTES = 50_000_000  # of one task, as for `burmester synthesize`


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
