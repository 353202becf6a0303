"""Tasks in one long table, Parquet or CSV: a row a pose, the rows of a task together.

The columns are `task`, `x`, `y`, `angle_deg` or `angle_rad`, and `weight` and `exact` if wanted.
A row whose angle is missing (blank, null or nan) is a point of the body.  Without a column of
angles all rows are points, perhaps with `crank_deg` or `crank_rad`.  Or a row a pair of angles:
`task`, `input_deg`, `output_deg` (or both in `_rad`), and `weight`.
The table is read from front to back, a piece at a time; it may be larger than the memory.

E101 not readable      E103 a number that would become 0
E104 no numbers, or no names of tasks      E107 a column that is not known
E102 no rows           E105 a column is missing                   E108 a task or a column twice
"""

from __future__ import annotations

import hashlib
import mmap
import os
import re
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.batch.parts import Part, TableTasks
from burmester.errors import InputError
from burmester.io.reading.pose_table import MARKS, is_held, shown, unheld
from burmester.io.reading.tables.parquet import holds_numbers
from burmester.io.reading.trees.locations import close_match
from burmester.printable import printable
from burmester.wording import listed

CRANKS = ("crank_deg", "crank_rad")
COLUMNS = ("task", "x", "y", "angle_deg", "angle_rad", *CRANKS, "weight", "exact")
PAIR_COLUMNS = ("task", "input_deg", "output_deg", "input_rad", "output_rad", "weight")
EXAMPLE = "task,x,y,angle_deg"
PAIR_EXAMPLE = "task,input_deg,output_deg"
WHOLE = re.compile(r"[+-]?[0-9]{1,18}")  # a number that names a task
_TINY = re.compile(rb"(?<![^,\n])[+-]?[0-9.]*[0-9][0-9.]*[eE]-0*[0-9]{3,}(?![^,\r\n])")
_LINE_END = re.compile(rb"\n")
PIECE_ROWS = 1 << 16  # rows that are taken from a Parquet file at a time
PIECE_BYTES = 1 << 22  # bytes that are taken from a CSV file at a time


Digests: TypeAlias = NDArray[np.int64]


class _Piece(NamedTuple):
    """Some rows: their columns by name, and the share of the file up to their end."""

    columns: dict[str, Any]
    share: float


def is_parquet_file(path: str) -> bool:
    """Whether a file begins as Parquet files do."""
    with open(path, "rb") as file:
        return file.read(4) == b"PAR1"


def is_pair_table(path: str) -> bool:
    """Whether a table is one of pairs of angles, whatever is wrong with it."""
    import pyarrow.parquet as pq  # noqa: PLC0415  an extra

    try:
        if is_parquet_file(path):
            return _of_pairs(pq.read_schema(path).names)
        with open(path, "rb") as file:
            return _of_pairs(_cells(file))
    except (OSError, ValueError):  # what cannot be read is refused where it is read
        return False


def table_parts(path: str, size: int) -> Iterator[Part]:
    """The parts of a table, each of `size` tasks but for the last."""
    label, number, row = printable(path), 0, 0
    names = TaskNames(lambda before: _names_before(path, label, before))
    held: list[dict[str, Any]] = []
    begun = 0  # tasks in what is held, at most: one may go on in the next piece
    for piece in _pieces(path, label):
        held.append(piece.columns)
        begun += len(_starts(piece.columns["task"]))
        if begun <= size:
            continue
        columns = _joined(held)
        starts = _starts(columns["task"])
        whole = (len(starts) - 1) // size * size
        for first in range(0, whole, size):
            one = _cut(columns, starts[first], starts[first + size])
            yield Part(number, _tasks(one, label, row, names), piece.share)
            number, row = number + 1, row + len(one["task"])
        held, begun = [_cut(columns, starts[whole], None)], len(starts) - whole
    columns = _joined(held)
    if columns and len(columns["task"]):
        yield Part(number, _tasks(columns, label, row, names), 1.0)
    elif number == 0:
        raise InputError("E102", "there are no tasks: the table has no rows", where=label)


def _names_before(path: str, label: str, row: int) -> Iterator[Any]:
    """The column `task` up to a row."""
    for piece in _pieces(path, label):
        names = piece.columns["task"]
        yield names[:row]
        row -= len(names)
        if row <= 0:
            return


def _pieces(path: str, label: str) -> Iterator[_Piece]:
    """The table, piece by piece, its columns checked."""
    import pyarrow as pa  # noqa: PLC0415  an extra
    import pyarrow.csv as pc  # noqa: PLC0415
    import pyarrow.parquet as pq  # noqa: PLC0415

    try:
        if is_parquet_file(path):
            with pq.ParquetFile(path) as file:
                names = _required(file.schema_arrow.names, label)
                total, read = max(1, file.metadata.num_rows), 0
                # Group by group: the reader holds on to what it has read of those it is given.
                for group in range(file.metadata.num_row_groups):
                    for batch in file.iter_batches(
                        PIECE_ROWS, row_groups=[group], columns=names, use_threads=False
                    ):
                        read += batch.num_rows
                        yield _Piece(_columns(batch, label), read / total)
            return
        with open(path, "rb") as file:
            names = _required(_cells(file), label)
            first = dict(zip(names, _cells(file), strict=False)).get("task", "")
            task = pa.int64() if WHOLE.fullmatch(first) else pa.string()
            total = max(1, os.fstat(file.fileno()).st_size)
            file.seek(0)
            _require_held(file, total, label)
            numeric = {*COLUMNS, *PAIR_COLUMNS} - {"task", "exact"}
            kinds = dict.fromkeys(sorted(numeric), pa.float64())
            reader = pc.open_csv(
                file,
                read_options=pc.ReadOptions(block_size=PIECE_BYTES, use_threads=False),
                convert_options=pc.ConvertOptions(
                    column_types={**kinds, "task": task, "exact": pa.string()},
                    include_columns=names,
                    strings_can_be_null=False,
                ),
            )
            for batch in reader:
                yield _Piece(_columns(batch, label), file.tell() / total)
    except (pa.ArrowInvalid, pa.ArrowTypeError, UnicodeDecodeError) as error:
        why = printable(str(error).partition("\n")[0][:200])
        help = f"write a table with numbers below `{EXAMPLE}`, or save it as Parquet"
        message = "the table of tasks cannot be read"
        raise InputError("E101", message, where=label, why=why, help=help) from None


def _require_held(file: Any, size: int, label: str) -> None:
    """Refuse a number that would become 0, which pyarrow does not tell; raises E103."""
    with mmap.mmap(file.fileno(), size, access=mmap.ACCESS_READ) as text:
        for found in _TINY.finditer(text):
            if not is_held(number := found[0].decode()):
                where = f"{label}:{1 + sum(1 for _ in _LINE_END.finditer(text, 0, found.start()))}"
                message, help = f"{number} is too small", "write 0 if that is meant"
                raise InputError("E103", message, where=where, why=unheld(number), help=help)


def _cells(file: Any) -> list[str]:
    """The cells of the next line of a CSV file."""
    line = file.readline(1 << 16).decode("utf-8-sig").strip()
    return [each.strip().strip('"') for each in line.split(",")] if line else []


def _required(names: list[str], label: str) -> list[str]:
    """The names of the columns, if a table of tasks may have these; raises E102 to E108."""
    if not names:
        help = f"write `{EXAMPLE}` on line 1, and a pose on each line below"
        raise InputError("E102", "there are no tasks: the file is empty", where=label, help=help)
    pairs = _of_pairs(names)
    known = PAIR_COLUMNS if pairs else COLUMNS
    for name in names:
        if name not in known:
            near = close_match(name, known)
            help = f"write {near} in its place" if near else "delete it"
            message = f"the column {shown(name)} is not known"
            why = f"a table of tasks has the columns {listed(known)}"
            raise InputError("E107", message, where=label, why=why, help=help)
        if names.count(name) > 1:
            message = f"the column {name} is given twice"
            raise InputError("E108", message, where=label, help="leave one of the two out")
        if name.endswith("_deg") and name.replace("_deg", "_rad") in names:
            message = "the angles are given in degrees and in radians"
            raise InputError("E108", message, where=label, help="leave one of the two columns out")
    if {"angle_deg", "angle_rad"} & set(names) and (cranks := set(CRANKS) & set(names)):
        message = f"the column {cranks.pop()} stands beside angles of the body"
        why = "crank angles time points, whose angles are free"
        help = "leave one of the two columns out"
        raise InputError("E107", message, where=label, why=why, help=help)
    unit = "rad" if {"input_rad", "output_rad"} & set(names) else "deg"
    needed = ("task", f"input_{unit}", f"output_{unit}") if pairs else ("task", "x", "y")
    if lacking := [each for each in needed if each not in names]:
        row, example = ("pair of angles", PAIR_EXAMPLE) if pairs else ("pose", EXAMPLE)
        why = f"a table of tasks has a row for each {row}, with the name of its task"
        help = f"name the columns {example}; one task alone is for `burmester synthesize`"
        message = f"the column {lacking[0]} is missing"
        raise InputError("E105", message, where=label, why=why, help=help)
    return names


def _of_pairs(names: list[str]) -> bool:
    """Whether a table is one of pairs of angles."""
    return not {"x", "y"} & set(names) and bool({*PAIR_COLUMNS[1:5]} & set(names))


def _columns(batch: Any, label: str) -> dict[str, Any]:
    """The columns of some rows: names as Arrow or NumPy has them, the others as NumPy arrays."""
    import pyarrow as pa  # noqa: PLC0415
    from pyarrow import types  # noqa: PLC0415

    out: dict[str, Any] = {}
    for name in batch.schema.names:
        column = batch.column(name)
        kind = column.type
        if name == "task":
            if types.is_dictionary(kind):
                column = column.dictionary_decode()
                kind = column.type
            text = types.is_string(kind) or types.is_large_string(kind)
            if not (types.is_integer(kind) or text) or column.null_count:
                why = "some have none" if column.null_count else f"the column holds {kind}"
                help = "name each task by a whole number or a text"
                message = "the rows do not all name their task"
                raise InputError("E104", message, where=f"{label}, column task", why=why, help=help)
            out[name] = column.cast(pa.string() if text else pa.int64())
        elif name == "exact":
            out[name] = _marks(column, label)
        elif holds_numbers(kind):
            numbers = column.cast(pa.float64())
            out[name] = numbers.to_numpy(zero_copy_only=False)
        else:
            message = f"the column {name} holds {kind}, not numbers"
            where = f"{label}, column {name}"
            raise InputError("E104", message, where=where, help="store it as float64")
    return out


def _marks(column: Any, label: str) -> Any:
    """The column `exact` as an array of bool."""
    from pyarrow import types  # noqa: PLC0415

    if types.is_boolean(column.type):
        return column.fill_null(False).to_numpy(zero_copy_only=False)
    words = column.dictionary_encode()
    texts = [
        "" if each is None else str(each).strip().lower() for each in words.dictionary.to_pylist()
    ]
    for text in texts:
        if text not in MARKS:
            message = f"{shown(text)} stands where yes or no belongs"
            help = "write yes for a pose to be met exactly, no for one to come near"
            raise InputError("E104", message, where=f"{label}, column exact", help=help)
    known = np.array([MARKS[text] for text in texts] + [False])
    return known[words.indices.fill_null(len(texts)).to_numpy(zero_copy_only=False)]


def _joined(pieces: list[dict[str, Any]]) -> dict[str, Any]:
    import pyarrow as pa  # noqa: PLC0415

    if len(pieces) < 2:
        return pieces[0] if pieces else {}
    return {
        name: (pa.concat_arrays if name == "task" else np.concatenate)(
            [piece[name] for piece in pieces]
        )
        for name in pieces[0]
    }


def _starts(names: Any) -> list[int]:
    """The rows at which tasks begin."""
    import pyarrow.compute as pc  # noqa: PLC0415

    if not len(names):
        return [0]
    differ = pc.not_equal(names[1:], names[:-1]).to_numpy(zero_copy_only=False)
    return [0, *(np.flatnonzero(differ) + 1).tolist()]


def _cut(columns: dict[str, Any], first: int, end: int | None) -> dict[str, Any]:
    return {name: column[first:end] for name, column in columns.items()}


def _tasks(columns: dict[str, Any], label: str, row: int, before: TaskNames) -> TableTasks:
    """The tasks in rows that hold whole ones; `before`: names above; raises E108 for one twice."""
    from pyarrow import types  # noqa: PLC0415

    names = columns["task"]
    starts = _starts(names)
    first = names.take(np.array(starts))
    if len(first.unique()) < len(first):
        seen: set[Any] = set()
        for start, name in zip(starts, first.to_pylist(), strict=True):
            if name in seen:
                raise _apart(name, label, row + start)
            seen.add(name)
    if (again := before.repeated(first, row)) is not None:
        raise _apart(again, label, row + starts[first.to_pylist().index(again)])
    pairs = "x" not in columns
    unit = "deg" if "angle_deg" in columns or "input_deg" in columns else "rad"
    numeric = [f"input_{unit}", f"output_{unit}"] if pairs else ["x", "y", f"angle_{unit}"]
    points = not (pairs or numeric[-1] in columns)
    if points:
        cranks = [each for each in CRANKS if each in columns]
        numeric, unit = ["x", "y", *cranks], "rad" if "crank_rad" in cranks else "deg"
    return TableTasks(
        first.to_numpy() if types.is_int64(first.type) else tuple(first.to_pylist()),
        np.array([*starts, len(names)], dtype=np.int64),
        np.stack([columns[name] for name in numeric], axis=1),
        columns.get("weight"),
        columns.get("exact"),
        unit == "deg",
        label,
        pairs,
        points,
    )


def _apart(name: Any, label: str, row: int) -> InputError:
    message = f"the rows of task {shown(str(name))} do not stand together"
    help = "sort the table by its column task"
    return InputError("E108", message, where=f"{label}, row {row + 1}", help=help)


def digests(names: Any) -> Digests:
    """Eight bytes for each of some names (T,), an Arrow array: numbers are their own."""
    from pyarrow import types  # noqa: PLC0415  an extra

    if types.is_integer(names.type):
        own: Digests = names.to_numpy(zero_copy_only=False)
        return own
    texts = (name.encode() for name in names.to_pylist())
    bytes_of = b"".join(hashlib.blake2b(text, digest_size=8).digest() for text in texts)
    return np.frombuffer(bytes_of, dtype=np.int64)


@final
class TaskNames:
    """Which names there were.

    earlier: the names, in Arrow arrays, that stand before a row of the table.
    """

    def __init__(
        self,
        earlier: Callable[[int], Iterator[Any]],
        digests: Callable[[Any], Digests] = digests,
    ) -> None:
        self._earlier, self._digests = earlier, digests
        self._bounds: tuple[Any, Any] | None = None  # the least and the greatest name so far
        self._known: list[Digests] | None = None  # sorted, each longer than the next

    def repeated(self, names: Any, row: int) -> Any | None:
        """One of the names of a part that stands before the part's first row, too, if any does.

        names: an Arrow array, in which each is once.
        """
        if self._known is None:
            if self._beyond(names):
                return None
            self._known = []
            for some in self._earlier(row):
                self._keep(self._digests(some.unique()))
        new = self._digests(names)
        again = np.zeros(len(new), dtype=bool)
        for known in self._known:
            at = np.minimum(np.searchsorted(known, new), len(known) - 1)
            again |= known[at] == new
        self._keep(new)
        return self._confirmed(names.take(np.flatnonzero(again)), row) if again.any() else None

    def _beyond(self, names: Any) -> bool:
        """Whether all names of a part are above, or below, all before."""
        import pyarrow.compute as pc  # noqa: PLC0415

        found = pc.min_max(names).as_py()
        least, most = found["min"], found["max"]
        if self._bounds is None:
            self._bounds = (least, most)
        elif least > self._bounds[1]:
            self._bounds = (self._bounds[0], most)
        elif most < self._bounds[0]:
            self._bounds = (least, self._bounds[1])
        else:
            return False
        return True

    def _keep(self, new: Digests) -> None:
        assert self._known is not None
        new = np.sort(new)
        while self._known and len(self._known[-1]) <= len(new):
            new = np.sort(np.concatenate([self._known.pop(), new]), kind="stable")
        if len(new):
            self._known.append(new)

    def _confirmed(self, names: Any, row: int) -> Any | None:
        suspected = set(names.to_pylist())
        for some in self._earlier(row):
            if there := suspected.intersection(some.unique().to_pylist()):
                return min(there)
        return None
