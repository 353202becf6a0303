"""Answers as columns of the batch's table: those of stacks, those of whole syntheses, refusals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, final

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from burmester.batch.schema import DYAD, LINKAGE, SCHEMA
from burmester.stacked import DyadRows, LinkageRows, StackedAnswers

__all__ = ["Refusal", "answer_table", "refused_rows", "solved_rows", "stacked_rows"]

_ANSWERS = ("outcome", "code", "reason", "dyads", "linkages", "warnings", "generators", "six_bars")
_WARNINGS = pa.list_(pa.string())


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
    return answer_table(
        indices,
        _words(StackedAnswers.OUTCOMES, answers.outcome),
        pc.if_else(pc.equal(codes, ""), None, codes),
        pa.nulls(count, pa.string()),
        _lists(answers.dyads.task, count, _dyads(answers.dyads)),
        _lists(linkages.task, count, _linkages(linkages))
        if linkages is not None
        else pa.nulls(count, pa.list_(LINKAGE)),
        pa.array(told, _WARNINGS),
    )


def refused_rows(refusals: Sequence[Refusal]) -> pa.Table:
    """The rows of tasks that have no answer."""
    count = len(refusals)
    return answer_table(
        np.array([each.index for each in refusals], dtype=np.intp),
        pa.array([each.outcome for each in refusals], pa.string()),
        pa.array([each.code for each in refusals], pa.string()),
        pa.array([each.reason for each in refusals], pa.string()),
        pa.array([[]] * count, pa.list_(DYAD)),
        pa.nulls(count, pa.list_(LINKAGE)),
        pa.array([[]] * count, _WARNINGS),
    )


def solved_rows(found: Mapping[int, Mapping[str, Any]]) -> pa.Table:
    """Whole syntheses as `burmester synthesize --json` tells them, by their places in the part."""
    dyads, linkages = [], []
    for data in found.values():
        ids = {each["id"]: number for number, each in enumerate(data["dyads"])}
        searches = data["search"]
        way = searches[0]["kind"] if searches else "family" if data["family"] else "motion"
        dyads.append([_dyad(each, way) for each in data["dyads"]])
        linkages.append([_linkage(each, ids, way) for each in data["linkages"]])
    return answer_table(
        np.array(list(found), dtype=np.intp),
        pa.array([_outcome(data) for data in found.values()], pa.string()),
        pa.array([data["outcome"]["code"] for data in found.values()], pa.string()),
        pa.nulls(len(found), pa.string()),
        pa.array(dyads, pa.list_(DYAD)),
        pa.array(linkages, pa.list_(LINKAGE)),
        pa.array(
            [[each["code"] for each in data["warnings"]] for data in found.values()], _WARNINGS
        ),
    )


def answer_table(indices: NDArray[np.intp], *columns: Any) -> pa.Table:
    """Columns of answers with the places of their tasks; the last ones, left out, are null."""
    every = [pa.array(indices, pa.int64()), *columns]
    for name in _ANSWERS[len(columns) :]:
        every.append(pa.nulls(len(indices), SCHEMA.field(name).type))
    return pa.table(every, names=["index", *_ANSWERS])


def _words(words: Sequence[str], codes: NDArray[np.integer[Any]]) -> Any:
    return pa.array(words, pa.string()).take(pa.array(codes, pa.int32()))


def _numbers(values: NDArray[np.float64]) -> Any:
    """Numbers, null where there is none."""
    return pa.array(values, mask=~np.isfinite(values))


def _lists(tasks: NDArray[np.intp], count: int, values: Any) -> Any:
    """The values as a list a task; tasks: of each value, rising."""
    offsets = np.searchsorted(tasks, np.arange(count + 1))
    return pa.ListArray.from_arrays(pa.array(offsets, pa.int32()), values)


def _struct(kind: Any, columns: Mapping[str, Any]) -> Any:
    return pa.StructArray.from_arrays([columns[field.name] for field in kind], fields=list(kind))


def _dyads(rows: DyadRows) -> Any:
    columns = {
        "kind": _words(DyadRows.KINDS, rows.kind),
        "status": _words(DyadRows.STATUSES, rows.status),
        **_pair("fixed", rows.fixed),
        **_pair("moving", rows.moving),
        **_pair("point", rows.point),
    }
    for name in ("length", "direction_deg", "normal_deg", "offset", "angle_deg", "rms", "worst"):
        columns[name] = _numbers(getattr(rows, name))
    return _struct(DYAD, columns)


def _pair(name: str, values: NDArray[np.float64]) -> dict[str, Any]:
    return {f"{name}_{axis}": _numbers(values[:, k]) for k, axis in enumerate("xy")}


def _linkages(rows: LinkageRows) -> Any:
    columns = {
        "first": pa.array(rows.first, pa.int32()),
        "second": pa.array(rows.second, pa.int32()),
        "verdict": _words(LinkageRows.VERDICTS, rows.verdict),
        "type": _words(LinkageRows.TYPES, rows.type),
        "dyads": pa.nulls(len(rows), pa.list_(DYAD)),  # those of the task itself
    }
    names = ("rms", "worst", "angle_rms_deg", "angle_worst_deg", "combined")
    for name in (*names, "transmission_deg", "extent", "sensitivity"):
        columns[name] = _numbers(getattr(rows, name))
    for name in ("path_rms", "path_worst", "chamfer", "dtw"):  # poses are no path
        columns[name] = pa.nulls(len(rows), pa.float64())
    return _struct(LINKAGE, columns)


def _outcome(data: Mapping[str, Any]) -> str:
    """The outcome of a synthesis in one word."""
    code = data["outcome"]["code"]
    if any(each["usable"] for each in data["linkages"]):
        return "solved"
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
    line = data.get("line", {})
    status = _STATUSES.get(way, "locally best")
    fixed, moving, point = (
        given if given is not None else (None, None)
        for given in (data.get("fixed_pivot"), data.get("moving_pivot"), line.get("point"))
    )
    return {
        "kind": data["kind"],
        "status": status if data["minimum"] else "nearest",
        "fixed_x": fixed[0],
        "fixed_y": fixed[1],
        "moving_x": moving[0],
        "moving_y": moving[1],
        "length": data.get("radius"),
        "point_x": point[0],
        "point_y": point[1],
        **{name: line.get(name) for name in ("direction_deg", "normal_deg", "offset")},
        "angle_deg": data.get("angle_deg"),
        "rms": data["rms_error"],
        "worst": data["max_error"],
    }


def _linkage(data: Mapping[str, Any], ids: Mapping[str, int], way: str) -> dict[str, Any]:
    """A linkage whose driver comes first."""
    quality = data["quality"] or {}
    kinds = [each["kind"] for each in (*data["defects"], *data["unmet"])]
    own = data["dyads"] if data["driver"] != "second" else data["dyads"][::-1]
    tracing = data.get("tracing") or {}
    path = tracing.get("curve_to_path") or {}
    return {
        "first": ids.get(own[0]["id"]),
        "second": ids.get(own[1]["id"]),
        "verdict": "usable" if data["usable"] else _verdict(kinds),
        "type": data["type"],
        "rms": data["position_error"]["rms"],
        "worst": data["position_error"]["max"],
        "angle_rms_deg": data["angle_error_deg"]["rms"],
        "angle_worst_deg": data["angle_error_deg"]["max"],
        "combined": data["combined_error"],
        **{name: quality.get(name) for name in ("transmission_deg", "extent", "sensitivity")},
        "dyads": [_dyad(each, way) for each in own],
        "path_rms": path.get("rms"),
        "path_worst": path.get("max"),
        "chamfer": tracing.get("chamfer"),
        "dtw": tracing.get("dtw"),
    }


def _verdict(kinds: Sequence[str]) -> str:
    """The first thing that is wrong: a defect, or a requirement that is not met."""
    return kinds[0] if kinds else "not usable"
