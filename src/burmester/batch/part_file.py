"""A part worked off: its tasks in, the bytes of a Parquet file out.

The bytes are a function of the tasks, the plan and the versions of the programs that make them;
who works when, and on what else, does not change them.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from typing import Any, NamedTuple, TypeAlias, final

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
from numpy.typing import NDArray

from burmester import __version__
from burmester.batch import schema
from burmester.batch.answer_rows import Refusal, refused_rows, solved_rows, stacked_rows
from burmester.batch.options import BatchOptions, Depth, as_task
from burmester.batch.parts import DrawnTasks, Part, TableTasks, TextTasks
from burmester.batch.sample import DRAWN, drawn_columns, drawn_table
from burmester.batch.worker import within
from burmester.errors import BurmesterError, InputError
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.functions.function_kind import is_function
from burmester.io.result import synthesis_data
from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import one_thread
from burmester.stacked import TaskStack, stacked_answers
from burmester.synthesis.function_generation import AnySynthesis, generate_function
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.six_bars import synthesize_six_bars
from burmester.tasks.function_task import FunctionTask
from burmester.tasks.motion_task import Task

Counts: TypeAlias = NDArray[np.int32]
Tasks: TypeAlias = TableTasks | TextTasks

# Columns of a few words that are there many times.
WORDS = [
    "outcome",
    "code",
    "reason",
    *(f"dyads.list.element.{name}" for name in ("kind", "status")),
    *(f"linkages.list.element.{name}" for name in ("verdict", "type")),
    *(f"linkages.list.element.dyads.list.element.{name}" for name in ("kind", "status")),
    *(f"generators.list.element.{name}" for name in ("verdict", "type")),
]
NOT_STACKED = "pairs of angles are solved at the depth full only"
POINTS = "points are solved at the depth full"
TOLD = 20  # failed tasks of a part that the manifest names


@final
@dataclass(frozen=True, slots=True)
class Plan:
    """What is to be done with every part.

    run: the digest of what the rows depend on; limit: seconds after which a part is given up;
    versions: of the programs that make the rows.
    """

    depth: Depth
    options: BatchOptions
    run: str
    limit: float
    versions: dict[str, str]


class Sizes(NamedTuple):
    """The poses and the pairs of angles (T,) of each task of a part; 0: none, or nobody knows."""

    poses: Counts
    pairs: Counts


@final
@dataclass(frozen=True, slots=True)
class WorkedPart:
    """A Parquet file, how often each outcome stands in it, and the tasks that failed, with why."""

    data: bytes
    tasks: int
    outcomes: dict[str, int]
    failed: list[dict[str, Any]]


def versions() -> dict[str, str]:
    """Those of the programs that make the rows, here."""
    return {"burmester": __version__, "numpy": np.__version__, "pyarrow": pa.__version__}


def work(part: Part, plan: Plan, failed: Mapping[int, str]) -> WorkedPart:
    """The rows of a part; failed: tasks that are not tried again, by their places, with why.

    A computation that takes longer than the limit ends the process.
    """
    for name, version in versions().items():
        if plan.versions[name] != version:
            raise InputError(
                "E182",
                f"the workers have another version of {name}",
                why=f"theirs is {version}, here it is {plan.versions[name]}",
                help="install the same version on all machines",
            )
    with within(plan.limit), one_thread():
        if isinstance(part.tasks, DrawnTasks):
            tasks, drawn = drawn_table(part.tasks)
            columns = drawn_columns(drawn)
            return _written(part, plan, _answered(tasks, plan, failed), columns)
        return _written(part, plan, _answered(part.tasks, plan, failed), [])


def _answered(tasks: Tasks, plan: Plan, failed: Mapping[int, str]) -> tuple[pa.Table, Sizes]:
    """The answers of all tasks in their order, and the sizes of the tasks."""
    refusals = [Refusal(index, "failed", None, why) for index, why in failed.items()]
    wanted = [index for index in range(len(tasks)) if index not in failed]
    sizes = Sizes(np.zeros(len(tasks), dtype=np.int32), np.zeros(len(tasks), dtype=np.int32))
    if plan.depth == "full":
        blocks = _solved(tasks, plan, wanted, sizes, refusals)
    else:
        blocks = _stacked(tasks, plan, wanted, sizes, refusals)
    if refusals:
        blocks.append(refused_rows(refusals))
    table = pa.concat_tables(blocks)
    index = table.column("index").to_numpy()
    if (index[1:] >= index[:-1]).all():
        return table, sizes
    return table.take(pa.array(np.argsort(index, kind="stable"))), sizes


def _solved(
    tasks: Tasks, plan: Plan, wanted: list[int], sizes: Sizes, refusals: list[Refusal]
) -> list[pa.Table]:
    """Whole syntheses, a task after the other."""
    found = {}
    for index in wanted:
        try:
            task = _task(tasks, index, plan.options)
            if isinstance(task, FunctionTask):
                sizes.pairs[index] = len(task.inputs)
                answer: AnySynthesis = generate_function(task)
            else:
                sizes.poses[index] = len(task.poses.angle)
                how, six_bars = plan.options.synthesis, plan.options.six_bars
                answer = synthesize_six_bars(task, six_bars) if six_bars else synthesize(task, how)
            found[index] = synthesis_data(answer)
        except InputError as error:
            refusals.append(_refusal(tasks, index, error))
    return [solved_rows(found)]


def _refusal(tasks: Tasks, index: int, error: BurmesterError) -> Refusal:
    where = error.where.splitlines()[0] if error.where else ""
    if isinstance(tasks, TableTasks):  # lines and columns are those of a text that nobody has
        label = f"{tasks.label}, task {tasks.names[index]}"
        where = label if where.startswith(label) else where
    where = f" ({where})" if where else ""
    why = f": {error.why}" if error.why else ""
    return Refusal(index, "refused", error.code, f"{error.message}{where}{why}")


def _task(tasks: TableTasks | TextTasks, index: int, options: BatchOptions) -> Task | FunctionTask:
    """A task as `burmester synthesize` or `function` would read it from a file of its own."""
    if isinstance(tasks, TextTasks):
        label, data = tasks.labels[index], tasks.data[index]
        pairs = is_function(data, label)
    else:
        label, data = f"{tasks.label}, task {tasks.names[index]}", _lines(tasks.only([index]))
        pairs = tasks.pairs
    return read_function(data, label, options.functions) if pairs else as_task(options, label, data)


def _lines(one: TableTasks) -> bytes:
    """The one task of a table as a table of its own."""
    unit = "deg" if one.degrees else "rad"
    # Without any angle the rows are those of a path, as in a table without the column.
    columns = 2 if one.has_angles and np.isnan(one.poses[:, 2]).all() else one.poses.shape[1]
    names = ["x", "y", f"{'crank' if one.points else 'angle'}_{unit}"][:columns]
    if one.pairs:
        names = [f"input_{unit}", f"output_{unit}"]
    exact = one.exact if one.exact is not None and one.exact.any() else None
    names += ["weight"] * (one.weights is not None) + ["exact"] * (exact is not None)
    lines = [",".join(names)]
    for row, numbers in enumerate(one.poses.tolist()):
        cells = [repr(number).removesuffix(".0") for number in numbers[:columns]]
        # A free angle is a blank; a missing x or y is none, as a row of blanks is passed over.
        if columns == 3 and one.has_angles and cells[2] == "nan":
            cells[2] = ""
        if one.weights is not None:
            cells.append(repr(float(one.weights[row])))
        if exact is not None:
            cells.append("yes" if exact[row] else "no")
        lines.append(",".join(cells))
    return "\n".join([*lines, ""]).encode()


def _stacked(
    tasks: Tasks, plan: Plan, wanted: list[int], sizes: Sizes, refusals: list[Refusal]
) -> list[pa.Table]:
    """Tasks in stacks, by their numbers of poses."""
    if isinstance(tasks, TextTasks):
        table, kept = _as_table(tasks, plan, wanted, sizes, refusals)
    elif tasks.pairs or tasks.points:
        counted = sizes.pairs if tasks.pairs else sizes.poses
        counted[wanted] = tasks.counts[wanted]
        why = NOT_STACKED if tasks.pairs else POINTS
        refusals += [Refusal(k, "not at this depth", None, why) for k in wanted]
        return [refused_rows([])]
    else:
        some = tasks if len(wanted) == len(tasks) else tasks.only(wanted)
        table, kept = some, np.array(wanted, dtype=np.intp)
    if not len(kept):
        return [refused_rows([])]
    sizes.poses[kept] = counts = table.counts
    free = np.isnan(table.poses[:, 2])
    finite = np.isfinite(table.poses[:, :2]).all(axis=1) & (free | np.isfinite(table.poses[:, 2]))
    if table.weights is not None:
        finite &= np.isfinite(table.weights)
    readable = np.logical_and.reduceat(finite, table.starts[:-1])
    points = readable & np.logical_or.reduceat(free, table.starts[:-1])
    good = readable & ~points
    for index in kept[~readable].tolist():
        help = "a pose has a number that is missing, or not finite"
        refusals.append(Refusal(index, "refused", "E103", help))
    refusals += [Refusal(k, "not at this depth", None, POINTS) for k in kept[points].tolist()]
    assert plan.depth != "full"
    sigma = plan.options.beside.pose_sigma
    resolution = (0.0, 0.0) if sigma is None else (math.sqrt(3) * sigma[0], math.sqrt(3) * sigma[1])
    blocks, numbers = [], _radians(table)
    for count in np.unique(counts[good]).tolist():
        chosen = np.flatnonzero(good & (counts == count))
        rows = table.rows(chosen).reshape(-1, count)
        stack = TaskStack(
            numbers[rows],
            None if table.weights is None else table.weights[rows],
            None if table.exact is None else table.exact[rows],
            resolution,
        )
        blocks.append(stacked_rows(stacked_answers(stack, plan.depth), kept[chosen]))
    return blocks or [refused_rows([])]


def _radians(table: TableTasks) -> FloatArray:
    if not table.degrees:
        return table.poses
    return np.concatenate([table.poses[:, :2], np.radians(table.poses[:, 2:])], axis=1)


def _as_table(
    tasks: TextTasks, plan: Plan, wanted: list[int], sizes: Sizes, refusals: list[Refusal]
) -> tuple[TableTasks, NDArray[np.intp]]:
    """Texts that state poses alone as a table; those that state more are not for this depth."""
    read, kept = [], []
    for index in wanted:
        try:
            task = _task(tasks, index, plan.options)
        except InputError as error:
            refusals.append(_refusal(tasks, index, error))
            continue
        if isinstance(task, FunctionTask):
            sizes.pairs[index] = len(task.inputs)
            refusals.append(Refusal(index, "not at this depth", None, NOT_STACKED))
            continue
        sizes.poses[index] = len(task.poses.angle)
        if states := _beyond_poses(task):
            why = f"{states} of a task count at the depth full only"
            told = POINTS if task.free_angles.any() else why
            refusals.append(Refusal(index, "not at this depth", None, told))
            continue
        read.append(task)
        kept.append(index)
    counts = np.array([len(task.poses.angle) for task in read], dtype=np.int64)
    starts = np.concatenate([[0], np.cumsum(counts)])
    rows = np.zeros((starts[-1], 3))
    weights, exact = np.ones(len(rows)), np.zeros(len(rows), dtype=bool)
    for task, first, end in zip(read, starts[:-1].tolist(), starts[1:].tolist(), strict=True):
        rows[first:end] = np.column_stack([task.poses.translation, task.poses.angle])
        weights[first:end] = 1.0 if task.weights is None else task.weights
        exact[first:end] = False if task.exact is None else task.exact
    table = TableTasks(
        tuple(tasks.names[k] for k in kept),
        starts,
        rows,
        weights if any(task.weights is not None for task in read) else None,
        exact if any(task.exact is not None for task in read) else None,
        degrees=False,
        label="",
    )
    return table, np.array(kept, dtype=np.intp)


def _beyond_poses(task: Task) -> str:
    """What a task states that stacks take no account of, in words."""
    stated = {
        "limits": bool(task.limits),
        "requirements": task.requirements.has_any,
        "tolerances": task.tolerances is not None,
        "surroundings": task.surroundings is not None,
        "crank angles": task.timing is not None,
    }
    return " and ".join(name for name, given in stated.items() if given)


def _written(
    part: Part, plan: Plan, answered: tuple[pa.Table, Sizes], drawn: list[Any]
) -> WorkedPart:
    """The file of a part."""
    table, sizes = answered
    table = table.append_column("pairs", _known(sizes.pairs))
    given = part.tasks.numbers if isinstance(part.tasks, DrawnTasks) else part.tasks.names
    numbered = isinstance(part.tasks, DrawnTasks) or not isinstance(given, tuple)
    whole = schema.schema(numbered=numbered, drawn=DRAWN if drawn else None)
    names = pa.array(given, whole.field("task").type)
    columns = [names, _known(sizes.poses)]
    columns += [table.column(field.name) for field in list(schema.SCHEMA)[2:]] + drawn
    told = {
        "schema": schema.VERSION,
        "versions": plan.versions,
        "run": plan.run,
        "part": part.number,
    }
    metadata = {"burmester": json.dumps(told, sort_keys=True)}
    rows = pa.Table.from_arrays(columns, schema=whole.with_metadata(metadata))
    sink = BytesIO()
    pq.write_table(
        rows,
        sink,
        compression="zstd",
        use_dictionary=WORDS,
        write_statistics=["task", "outcome"],
    )
    outcomes = _counted(table.column("outcome"))
    lost = rows.filter(pc.equal(rows.column("outcome"), "failed")).slice(0, TOLD)
    failed = lost.select(["task", "reason"]).to_pylist()
    return WorkedPart(sink.getvalue(), len(names), outcomes, failed)


def _known(counts: Counts) -> Any:
    """Counts, null where there are none."""
    return pa.array(counts, mask=counts == 0)


def _counted(outcomes: Any) -> dict[str, int]:
    """How often each outcome is there, in the order of the schema."""
    counted = {each["values"]: each["counts"] for each in outcomes.value_counts().to_pylist()}
    return {name: counted[name] for name in schema.OUTCOMES if name in counted}
