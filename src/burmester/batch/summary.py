"""What is in the folder of a batch: read from its manifest, or told by a run."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, final

from burmester.batch.manifest import OF_MANIFEST, read_sealed
from burmester.batch.out_folder import OutFolder
from burmester.errors import InputError
from burmester.io.files import open_plain
from burmester.printable import printable
from burmester.wording import listed, shortened

MOST_NAMED = 5  # files that a note names


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
        What was found damaged when the run began, and what was done about it; and files of a
        complete batch that are not of it, and that a reader of the folder would take for parts.
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
        return asdict(self) | {"notes": list(self.notes)}


def read_summary(folder: str | os.PathLike[str], notes: tuple[str, ...] = ()) -> Summary:
    """What the manifest of a folder says; raises E101."""
    path = OutFolder(os.fspath(folder)).manifest
    try:
        with open_plain(path, "rb") as file:
            data = read_sealed(file.read(), OF_MANIFEST)
        strange = _strange(OutFolder(os.fspath(folder)), data)
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
        printable(os.fspath(folder)), **{name: data[name] for name in names}, notes=notes + strange
    )


def _strange(folder: OutFolder, data: Mapping[str, Any] | None) -> tuple[str, ...]:
    """A note that names what is in a complete folder and not of its batch."""
    if data is None or not data["complete"]:
        return ()

    def own(name: str) -> bool:
        number = name.removeprefix("part-").removesuffix(".parquet")
        known = number.isdecimal() and int(number[:18]) < data["parts"]
        return known and os.path.basename(folder.part(int(number))) == name

    names = [printable(each) for each in folder.part_names() if not own(each)]
    if not names:
        return ()
    are = "is" if len(names) == 1 else "are"
    named = listed(shortened(names, MOST_NAMED))
    return (f"{named} {are} not of this batch; readers of the folder take it in: move it away",)
