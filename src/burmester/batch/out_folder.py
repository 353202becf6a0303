"""The folder that a batch writes to: one run at a time, every file whole or not there.

E140 a folder that holds other parts      E141 it cannot be written
E181 another run works on it
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import final

from burmester.errors import InputError
from burmester.io import files
from burmester.printable import printable

LOCK = ".lock"
SYNC_S = 1.0  # between two times that lines are brought down to the disk


@final
class OutFolder:
    """A folder of parts, with the files beside them; their names begin with "_".

    Readers of Parquet folders pass over names that begin with "_" or ".".
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self._synced = 0.0

    @property
    def manifest(self) -> str:
        """The file that says what the batch is and how far it is."""
        return os.path.join(self.path, "_manifest.json")

    @property
    def parts(self) -> str:
        """The file with a line for every part that is done."""
        return os.path.join(self.path, "_parts.jsonl")

    @property
    def datasheet(self) -> str:
        """The file that says how tasks were drawn."""
        return os.path.join(self.path, "_datasheet.md")

    def part(self, number: int) -> str:
        """The file of a part."""
        return os.path.join(self.path, f"part-{number:06}.parquet")

    def part_names(self) -> list[str]:
        """The names of all that a reader of Parquet folders takes for parts."""
        names = os.listdir(self.path)
        return sorted(each for each in names if each.endswith(".parquet") and each[0] not in "_.")

    def write(self, path: str, data: bytes | str) -> None:
        """Write a file of this folder, or replace it; raises E141."""
        try:
            files.write(path, data, force=True, swept=True)
        except InputError as error:
            if os.path.exists(path) and not os.path.isfile(path):
                error.help = "take away what stands there, or give another folder"
            raise

    def append(self, path: str, line: bytes) -> None:
        """Write a line behind the others, and now and then all down to the disk; raises E141.

        One that is killed meanwhile leaves a piece of a line.  A power cut may take the lines of
        the last second: what they tell of is done again.
        """
        try:
            with files.open_plain(path, "ab") as file:
                while line:
                    line = line[file.write(line) :]
                if (now := monotonic()) - self._synced > SYNC_S:
                    os.fsync(file.fileno())
                    self._synced = now
        except OSError as error:
            raise files.cannot_write(path, error, Path(path)) from None

    @contextmanager
    def held(self) -> Iterator[None]:
        """The folder, made if it is not there, for this run alone; raises E141 and E181.

        However the run ends, the system takes the lock away.
        """
        try:
            os.makedirs(self.path, exist_ok=True)
            lock = files.open_plain(os.path.join(self.path, LOCK), "ab")
        except (OSError, ValueError) as error:
            raise self._refused(error) from None
        with lock:
            if not _locked(lock.fileno()):
                raise InputError(
                    "E181",
                    "another run works on this folder",
                    where=printable(self.path),
                    help="wait until it has ended, or give another folder",
                )
            files.sweep(self.path)
            yield

    def _refused(self, error: OSError | ValueError) -> InputError:
        if os.path.lexists(self.path) and not os.path.isdir(self.path):
            message, help = f"{printable(self.path)} cannot be written", "give the name of a folder"
            return InputError("E141", message, why="it is a file, not a folder", help=help)
        lock = os.path.join(self.path, LOCK)
        given = lock if os.path.lexists(lock) else self.path
        return files.cannot_write(given, error, Path(lock))


def _locked(descriptor: int) -> bool:
    """Take the lock on an open file; False: somebody has it."""
    try:
        if os.name == "nt":
            import msvcrt  # noqa: PLC0415  Windows has it

            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined, unused-ignore]
        else:
            import fcntl  # noqa: PLC0415  POSIX has it

            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
