"""What is in the folder of a batch: read from its manifest, or told by a run."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, final

from burmester.batch.manifest import read_sealed
from burmester.batch.out_folder import OutFolder
from burmester.errors import InputError
from burmester.printable import printable

__all__ = ["Summary", "read_summary"]


@final
@dataclass(frozen=True, slots=True)
class Summary:
    """A batch as far as it is done.

    Attributes
    ----------
    folder : str
    complete : bool
        Whether every task has a row.
    parts, tasks : int
        How many are done.
    outcomes : dict
        How often each outcome stands in the rows.
    failed : list of dict
        The first tasks that burmester could not compute, each with its part's name and the reason.
    identity : dict
        What the rows depend on: versions, tasks, depth, options, tasks of a part.
    notes : tuple of str
        What was found damaged when the run began, and what was done about it.
    """

    folder: str
    complete: bool
    parts: int
    tasks: int
    outcomes: Mapping[str, int]
    failed: Sequence[Mapping[str, Any]]
    identity: Mapping[str, Any]
    notes: tuple[str, ...] = ()

    @property
    def data(self) -> dict[str, Any]:
        """The same as plain data."""
        return {
            "folder": self.folder,
            "complete": self.complete,
            "parts": self.parts,
            "tasks": self.tasks,
            "outcomes": dict(self.outcomes),
            "failed": list(self.failed),
            "identity": dict(self.identity),
            "notes": list(self.notes),
        }


def read_summary(folder: str | os.PathLike[str], notes: tuple[str, ...] = ()) -> Summary:
    """What the manifest of a folder says; raises E101."""
    path = OutFolder(os.fspath(folder)).manifest
    try:
        with open(path, "rb") as file:
            data = read_sealed(file.read())
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        help = "give the folder that `burmester batch -o` wrote to"
        where = printable(path)
        raise InputError("E101", "no batch can be read", where=where, why=why, help=help) from None
    if data is None:
        help = "run the batch again: what is sound of it is kept"
        message = "the manifest of this batch is damaged"
        raise InputError("E101", message, where=printable(path), help=help)
    names = ("complete", "parts", "tasks", "outcomes", "failed", "identity")
    return Summary(
        printable(os.fspath(folder)), **{name: data[name] for name in names}, notes=notes
    )
