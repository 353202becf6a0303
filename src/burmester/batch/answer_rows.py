"""Answers as columns of the batch's table: those of stacks, those of whole syntheses, refusals."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, final

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from burmester.batch.schema import (
    ANSWER,
    DYAD,
    DYAD_COLUMNS,
    GENERATOR_COLUMNS,
    LINKAGE,
    LINKAGE_COLUMNS,
    SIX_BAR_COLUMNS,
    WATT_COLUMNS,
    Columns,
)
from burmester.stacked import DyadRows, LinkageRows, StackedAnswers

WATT = "Watt I six-bar"


@final
@dataclass(frozen=True, slots=True)
class Refusal:
    """A task that has no answer: the place in its part, its outcome, a code and a reason."""

    index: int
    outcome: str
    code: str | None
    reason: str


def stacked_rows(answers: StackedAnswers, indices: NDArray[np.intp]) -> pa.Table:
    """The answers of a stack; indices (T,): the places of its tasks in the part."""
    count = len(answers.outcome)
    linkages = answers.linkages
    codes = pa.array(answers.code.tolist(), pa.string())
    told: list[list[str]] = [[] for _ in range(count)]
    for task, code in answers.warnings:
        told[task].append(code)
    columns = {
        "index": indices,
        "outcome": _words(StackedAnswers.OUTCOMES, answers.outcome),
        "code": pc.if_else(pc.equal(codes, ""), None, codes),
        "dyads": _lists(answers.dyads.task, count, _dyads(answers.dyads)),
        "warnings": told,
    }
    if linkages is not None:
        columns["linkages"] = _lists(linkages.task, count, _linkages(linkages))
    return pa.table(_filled(ANSWER, count, columns), schema=ANSWER)


def refused_rows(refusals: Sequence[Refusal]) -> pa.Table:
    """The rows of tasks that have no answer."""
    rows = [{**asdict(each), "dyads": [], "warnings": []} for each in refusals]
    return pa.Table.from_pylist(rows, schema=ANSWER)


def solved_rows(found: Mapping[int, Mapping[str, Any]]) -> pa.Table:
    """Whole syntheses as the commands tell them with --json, by their places in the part."""
    rows = [
        {
            "index": index,
            "code": data["outcome"]["code"],
            "warnings": [each["code"] for each in data["warnings"]],
            **_found(data),
        }
        for index, data in found.items()
    ]
    return pa.Table.from_pylist(rows, schema=ANSWER)


def _found(data: Mapping[str, Any]) -> dict[str, Any]:
    """What was found for a task, and its outcome in one word."""
    if data.get("six_bars") is not None:
        found = [_six_bar(each) for each in data["six_bars"]["found"]]
        return {"outcome": "solved" if found else "none usable", "dyads": [], "six_bars": found}
    usable = any(each["usable"] for each in data["linkages"])
    if "function" in data["task"]:
        found = [_generator(each) for each in data["linkages"]]
        return {"outcome": "solved" if usable else "none usable", "dyads": [], "generators": found}
    ids = {each["id"]: number for number, each in enumerate(data["dyads"])}
    searches = data["search"]
    way = searches[0]["kind"] if searches else "family" if data["family"] else "motion"
    return {
        "outcome": "solved" if usable else _outcome(data),
        "dyads": [_dyad(each, way) for each in data["dyads"]],
        "linkages": [_linkage(each, ids, way) for each in data["linkages"]],
    }


def _row(columns: Columns, data: Mapping[str, Any], **made: Any) -> dict[str, Any]:
    """What the JSON of a result says by columns; made: of several of its values."""
    return {
        name: made[name] if name in made else _at(data, key if isinstance(key, str) else name)
        for name, key in columns.items()
    }


def _at(data: Any, path: str) -> Any:
    """What stands under keys or numbers, None where there is nothing."""
    for key in path.split("."):
        if data is None:
            return None
        data = data[int(key)] if key.isdigit() else data.get(key)
    return data


def _words(words: Sequence[str], codes: NDArray[np.integer[Any]]) -> Any:
    return pa.array(words, pa.string()).take(pa.array(codes, pa.int32()))


def _filled(fields: Iterable[Any], count: int, columns: Mapping[str, Any]) -> list[Any]:
    """Columns (count,) of these fields; null where there is no number, or no column."""
    out = []
    for field in fields:
        values = columns.get(field.name)
        if values is None:
            values = pa.nulls(count, field.type)
        elif isinstance(values, np.ndarray):
            missing = ~np.isfinite(values) if values.dtype.kind == "f" else None
            values = pa.array(values, field.type, mask=missing)
        out.append(values)
    return out


def structs(kind: Any, count: int, columns: Mapping[str, Any]) -> Any:
    """The same as an array of structs of this type."""
    return pa.StructArray.from_arrays(_filled(kind, count, columns), fields=list(kind))


def _lists(tasks: NDArray[np.intp], count: int, values: Any) -> Any:
    """The values as a list a task; tasks: of each value, rising."""
    offsets = np.searchsorted(tasks, np.arange(count + 1))
    return pa.ListArray.from_arrays(pa.array(offsets, pa.int32()), values)


def _dyads(rows: DyadRows) -> Any:
    columns = {name: getattr(rows, name, None) for name in DYAD_COLUMNS}
    for name in ("fixed", "moving", "point"):
        columns |= dict(zip((f"{name}_x", f"{name}_y"), getattr(rows, name).T, strict=True))
    columns["kind"] = _words(DyadRows.KINDS, rows.kind)
    columns["status"] = _words(DyadRows.STATUSES, rows.status)
    return structs(DYAD, len(rows.kind), columns)


def _linkages(rows: LinkageRows) -> Any:
    """Linkages of stacks: their dyads are those of the task itself, and poses are no path."""
    columns = {name: getattr(rows, name, None) for name in LINKAGE_COLUMNS}
    columns["verdict"] = _words(LinkageRows.VERDICTS, rows.verdict)
    columns["type"] = _words(LinkageRows.TYPES, rows.type)
    return structs(LINKAGE, len(rows), columns)


def _outcome(data: Mapping[str, Any]) -> str:
    """The outcome of a synthesis without a usable linkage, in one word."""
    code = data["outcome"]["code"]
    if data["linkages"]:
        return "none usable"
    words = {"R303": "infinitely many", "R318": "not determined"}
    special = code >= "R310"
    return words.get(code, "special motion" if special else "too few dyads")


_STATUSES = {
    "pencil": "pencil",
    "five poses": "exact",
    "family": "of a family",
    "motion": "of the motion",
}


def _dyad(data: Mapping[str, Any], way: str) -> dict[str, Any]:
    status = _STATUSES.get(way, "locally best") if data["minimum"] else "nearest"
    return _row(DYAD_COLUMNS, data, status=status)


def _linkage(data: Mapping[str, Any], ids: Mapping[str, int], way: str) -> dict[str, Any]:
    """A linkage whose driver comes first."""
    own = data["dyads"] if data["driver"] != "second" else data["dyads"][::-1]
    first, second = (ids.get(each["id"]) for each in own)
    # The first thing that is wrong: a defect, or a requirement that is not met.
    wrong = [each["kind"] for each in (*data["defects"], *data["unmet"])] or ["not usable"]
    verdict = "usable" if data["usable"] else wrong[0]
    dyads = [_dyad(each, way) for each in own]
    return _row(LINKAGE_COLUMNS, data, first=first, second=second, verdict=verdict, dyads=dyads)


def _generator(data: Mapping[str, Any]) -> dict[str, Any]:
    verdict = "usable" if data["usable"] else data["defects"][0]["kind"]
    return _row(GENERATOR_COLUMNS, data, verdict=verdict)


def _six_bar(data: Mapping[str, Any]) -> dict[str, Any]:
    keys = {link: link.replace(" ", "_") for link in data["joints_of_links"]}
    joints = [
        {"link": link, "joint": joint, "x": x, "y": y}
        for link, key in keys.items()
        for joint, (x, y) in data.get(key, {}).items()
    ]
    return _row(
        SIX_BAR_COLUMNS,
        data,
        verdict="not sound" if data["shortcomings"] else "sound",
        joints=joints,
        lengths=list(data["lengths"].items()),
        **({} if data["type"] == WATT else dict.fromkeys(WATT_COLUMNS)),
    )
