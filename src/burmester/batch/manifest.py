"""What a batch is, and which of its parts are done: so a run that was killed can go on.

`_manifest.json` says what the rows depend on, and the sums.  `_parts.jsonl` has a line for every
part that is done, written behind the others when it is; so the cost of a part does not grow with
their number.  Both are sealed: a digest stands in the file, and in each line.  A line that is
damaged, or whose part is, makes that part be done again; a damaged manifest is written anew.

E140 parts without a manifest      E180 the folder holds another batch
"""

from __future__ import annotations

import hashlib
import json
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from typing import Any, final

from burmester.batch.out_folder import OutFolder
from burmester.errors import InputError
from burmester.io.files import open_plain
from burmester.printable import printable
from burmester.wording import listed, shortened

OF_RECORD: Mapping[str, type] = {
    "run": str, "part": int, "tasks": int, "bytes": int, "sha256": str,
    "outcomes": dict, "failed": list,
}  # fmt: skip
OF_MANIFEST: Mapping[str, type] = {
    "identity": dict, "complete": bool, "parts": int, "tasks": int, "outcomes": dict,
    "failed": list, "parts_sha256": str,
}  # fmt: skip
NAMED = 100  # failed tasks that the manifest names; the parts name all


MOST_NAMED = 5  # files that a note names


@final
@dataclass(frozen=True, slots=True)
class PartRecord:
    """A part that is done: its number, its tasks, its file, its outcomes and what failed."""

    part: int
    tasks: int
    bytes: int
    sha256: str
    outcomes: Mapping[str, int]
    failed: list[dict[str, Any]] = field(default_factory=list)


def digest_of(data: Any) -> str:
    """The SHA-256 of plain data."""
    text = json.dumps(data, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _sealed(data: dict[str, Any]) -> dict[str, Any]:
    return {**data, "seal": digest_of(data)[:16]}


def read_sealed(text: bytes, kinds: Mapping[str, type]) -> dict[str, Any] | None:
    """The data in sealed JSON, values of these kinds by their keys; None where it is damaged."""
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        return None
    if not isinstance(data, dict) or data.pop("seal", None) != digest_of(data)[:16]:
        return None
    return data if all(type(data.get(key)) is kind for key, kind in kinds.items()) else None


class Manifest:
    """The manifest of a folder that this run holds.

    identity: all that the rows depend on, as plain data; done: the parts that are; notes: what
    was found damaged.
    """

    def __init__(self, folder: OutFolder, identity: dict[str, Any]) -> None:
        self.folder, self.identity = folder, identity
        self.run = digest_of(identity)[:16]
        self.done: dict[int, PartRecord] = {}
        self.notes: list[str] = []
        self._take_up()

    def _take_up(self) -> None:
        """Read what earlier runs left; raises E140 and E180."""
        folder = self.folder
        known, lines = _content(folder.manifest), _content(folder.parts)
        if known is None and lines is None and folder.part_names():
            message = f"{printable(folder.path)} holds parts without a manifest"
            help = "give another folder, or delete these parts"
            raise InputError("E140", message, why="they cannot be told apart", help=help)
        given = None if known is None else read_sealed(known, OF_MANIFEST)
        if given is not None:
            self._require_same(given["identity"])
        elif known is not None or lines is not None:
            self.notes.append("the manifest was damaged, and is written anew")
        damaged = False
        for line in (lines or b"").splitlines():
            record = self._record(line, strange=given is None)
            if record is not None and self._is_whole(record):
                self.done[record.part] = record
            else:
                damaged = True
        if damaged:
            self.notes.append("some parts were damaged or unfinished, and are done again")
        self._write(complete=False)

    def _record(self, line: bytes, *, strange: bool) -> PartRecord | None:
        data = read_sealed(line, OF_RECORD)
        if data is None:
            return None
        if data.pop("run") != self.run:
            if strange:
                raise self._other("its manifest is damaged, and its parts are of another batch")
            return None
        return PartRecord(**{each.name: data[each.name] for each in fields(PartRecord)})

    def _is_whole(self, record: PartRecord) -> bool:
        """Whether the file of a part is as it was written."""
        try:
            with open_plain(self.folder.part(record.part), "rb") as file:
                same = os.fstat(file.fileno()).st_size == record.bytes
                return same and hashlib.file_digest(file, "sha256").hexdigest() == record.sha256
        except OSError:
            return False

    def _require_same(self, other: dict[str, Any]) -> None:
        if other == self.identity:
            return
        ours, theirs = _flat(self.identity), _flat(other)
        differ = [
            f"{name} is {_shown(theirs.get(name))} there and {_shown(ours.get(name))} here"
            for name in {**theirs, **ours}
            if theirs.get(name) != ours.get(name)
        ]
        raise self._other("; ".join(differ))

    def _other(self, why: str) -> InputError:
        return InputError(
            "E180",
            f"{printable(self.folder.path)} holds another batch",
            why=why,
            help="give another folder, or run the batch as it was begun",
        )

    def add(self, number: int, data: bytes, record: PartRecord) -> None:
        """Keep a part: its file first, then its line."""
        self.folder.write(self.folder.part(number), data)
        self.folder.append(self.folder.parts, self._line(record))
        self.done[number] = record

    def finish(self, *, complete: bool) -> None:
        """Write both files as they are read: the lines in order, and the sums."""
        self._write(complete=complete)

    def _write(self, *, complete: bool) -> None:
        records = [self.done[number] for number in sorted(self.done)]
        lines = b"".join(map(self._line, records))
        told = {
            "identity": self.identity,
            "complete": complete,
            **_sums(records),
            "parts_sha256": hashlib.sha256(lines).hexdigest(),
        }
        text = json.dumps(_sealed(told), indent=1, ensure_ascii=True) + "\n"
        self.folder.write(self.folder.manifest, text)
        self.folder.write(self.folder.parts, lines)

    def _line(self, record: PartRecord) -> bytes:
        return json.dumps(_sealed({"run": self.run, **asdict(record)})).encode() + b"\n"


def _sums(records: Sequence[PartRecord]) -> dict[str, Any]:
    """The numbers of parts, tasks and outcomes, and the first tasks that failed."""
    outcomes, failed = Counter[str](), list[dict[str, Any]]()
    for record in records:
        outcomes.update(record.outcomes)
        failed += record.failed[: NAMED - len(failed)]
    return {
        "parts": len(records),
        "tasks": sum(record.tasks for record in records),
        "outcomes": dict(sorted(outcomes.items())),
        "failed": failed,
    }


def _content(path: str) -> bytes | None:
    try:
        with open_plain(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return None
    except OSError as error:
        message = f"{printable(path)} cannot be read"
        why = error.strerror or str(error)
        help = "give another folder, or take away what stands there"
        raise InputError("E141", message, why=why, help=help) from None


def _flat(data: Mapping[str, Any], front: str = "") -> dict[str, Any]:
    """Nested keys as one each: "versions.numpy"."""
    out: dict[str, Any] = {}
    for key, value in data.items():
        out |= _flat(value, f"{front}{key}.") if isinstance(value, dict) else {front + key: value}
    return out


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return printable(text if len(text) <= 60 else f"{text[:57]}...")


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
