"""A function synthesis as plain data, and read back: the object of `synthesize --json`.

The contract is `function.schema.json` beside this file.  Reading takes from it the task and the
dimensions of a linkage alone, and judges both again: no number and no verdict is taken on trust.

E150 no result of this kind      E151 no such linkage, or none at all
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.functions.found_generator import FoundGenerator, found_generators
from burmester.functions.function_task import FunctionTask, chebyshev_spacing
from burmester.functions.generator import Generator
from burmester.io.linkage_data import number
from burmester.io.reading.functions.function_file import task_of_tree
from burmester.io.reading.pose_table import held_float
from burmester.io.result import message_data
from burmester.printable import printable
from burmester.synthesis.function_generation import FunctionSynthesis

__all__ = [
    "SCHEMA",
    "FunctionResult",
    "function_data",
    "function_task_data",
    "is_function_result",
    "read_function_result",
]

SCHEMA: Final = "burmester.function/1"
LINK_KEYS: Final = ("input", "coupler", "output")
SAME_SHARE = 1e-9  # of the range; shares that differ less are the same spacing


def function_data(synthesis: FunctionSynthesis) -> dict[str, Any]:
    """The synthesis as an object ready for JSON."""
    task = synthesis.task
    return {
        "schema": SCHEMA,
        "outcome": message_data(synthesis.outcome),
        "method": synthesis.method,
        "task": function_task_data(task),
        "search": {
            "kind": "phases" if synthesis.solutions is None else "solutions",
            "expected": synthesis.solutions,
            "found": synthesis.found,
            "real": synthesis.real,
        },
        "prices": [
            {
                "id": each.id,
                "min_transmission_angle_deg": _degrees(each.least_transmission),
                "max_error_deg": _degrees(each.max_error),
            }
            for each in synthesis.prices
        ],
        "linkages": [_linkage(each, task) for each in synthesis.generators],
        "warnings": list(map(message_data, synthesis.warnings)),
    }


def function_task_data(task: FunctionTask) -> dict[str, Any]:
    """A task: as a file may hold it, and its pairs."""
    return {"function": _task(task), "pairs": _pairs(task)}


def _task(task: FunctionTask) -> dict[str, Any]:
    """The task as a file may hold it, under `function`."""
    data: dict[str, Any] = {}
    function = task.function
    if function is None or not function.written:
        rows = zip(*(np.degrees(v).tolist() for v in (task.inputs, task.outputs)), strict=True)
        data["pairs"] = [list(row) for row in rows]
        if task.weights is not None:
            weighted = zip(data["pairs"], task.weights.tolist(), strict=True)
            data["pairs"] = [[*pair, weight] for pair, weight in weighted]
    else:
        shares = task.inputs / function.input_range
        spacing = chebyshev_spacing(len(shares))
        data |= {
            "expression": function.text,
            "x": list(function.x),
            "input_deg": _plain_degrees(function.input_range),
            "output_deg": _plain_degrees(abs(function.output_range)),
            "opposite": bool(function.output_range < 0),
            "pairs": len(shares),
            "spacing": "chebyshev" if np.abs(shares - spacing).max() < SAME_SHARE else "even",
        }
    angles = {
        "input_phase_deg": task.input_phase,
        "output_phase_deg": task.output_phase,
        "transmission_deg": task.least_transmission,
    }
    data |= {key: _plain_degrees(each) for key, each in angles.items() if each is not None}
    if task.link_ratio is not None:
        data["link_ratio"] = task.link_ratio
    if task.types is not None:
        data["types"] = sorted(task.types)
    return data | {"minimax": task.minimax, "ground": task.ground}


def _plain_degrees(angle: float) -> float:
    """Degrees without the rounding of having been radians: 60, not 59.99999999999999."""
    return round(math.degrees(angle), 12)


def _pairs(task: FunctionTask) -> list[dict[str, float]]:
    rows = zip(np.degrees(task.inputs).tolist(), np.degrees(task.outputs).tolist(), strict=True)
    return [{"input_deg": a, "output_deg": b} for a, b in rows]


def _linkage(found: FoundGenerator, task: FunctionTask) -> dict[str, Any]:
    one = found.generator
    links = (one.input_link, one.coupler, one.output_link)
    dyads = found.linkage(task)
    inputs, _ = task.compared()
    return {
        "id": found.id,
        "rank": found.rank,
        "type": found.type,
        "usable": found.usable,
        "links": {"ground": task.ground}
        | {key: float(each) * task.ground for key, each in zip(LINK_KEYS, links, strict=True)},
        "input_phase_deg": math.degrees(float(one.input_phase)) % 360,
        "output_phase_deg": math.degrees(float(one.output_phase)) % 360,
        "side": int(one.side),
        "dyads": [
            {
                "kind": "RR",
                "fixed_pivot": each.fixed_pivot.tolist(),
                "moving_pivot": each.moving_pivot.tolist(),
                "radius": float(each.radius),
            }
            for each in (dyads.first, dyads.second)
            if isinstance(each, RR)
        ],
        "structural_error_deg": {
            "max": _degrees(found.max_error),
            "rms": _degrees(found.rms_error),
            "max_percent": number(100 * found.max_error / task.output_span),
        },
        "pair_errors_deg": [_degrees(each) for each in found.errors.tolist()],
        "error_curve": {
            "input_deg": np.degrees(inputs).tolist(),
            "error_deg": [_degrees(each) for each in found.range_errors.tolist()],
        },
        "min_transmission_angle_deg": _degrees(found.least_transmission),
        "link_ratio": float(one.link_ratio),
        "extent": found.extent * task.ground,
        "defects": [{"kind": each.code, "message": each.message} for each in found.defects],
        "shortcomings": list(found.shortcomings),
    }


def _degrees(angle: float) -> float | None:
    return number(math.degrees(angle))


# --- read back


class FunctionResult(NamedTuple):
    """A result: where it came from, its task, and its linkages as the file has them."""

    label: str
    task: FunctionTask
    linkages: tuple[FoundGenerator, ...]

    def choose(self, id: str | None = None) -> FoundGenerator:
        """A linkage by its id, or the first; raises E151."""
        known = [each.id for each in self.linkages]
        for each in self.linkages:
            if id is None or each.id.lower() == id.lower():
                return each
        have = f"it has {', '.join(known)}" if known else "it has none"
        raise InputError(
            "E151",
            f"there is no linkage {id} in this result"
            if id
            else "there is no linkage in this result",
            where=self.label,
            why=have,
            help=f"give --linkage {known[0]}" if known else "`burmester explain R361` says more",
        )


def is_function_result(data: bytes) -> bool:
    """Whether bytes are a result of this kind, whatever is wrong with it."""
    return data[:200].lstrip().startswith(b'{"schema": "burmester.function/')


def read_function_result(data: bytes, path: str) -> FunctionResult:
    """The result in the bytes of a file; raises E109, E150 and what reading its task raises."""
    label = "<stdin>" if path == "-" else printable(path)
    try:
        tree = json.loads(data, parse_float=held_float)
    except InputError as error:
        error.where = label
        raise
    except (ValueError, RecursionError) as error:
        why = printable(str(error))
        raise InputError("E109", "this is not JSON", where=label, why=why, help=_HELP) from None
    if not isinstance(tree, Mapping) or tree.get("schema") != SCHEMA:
        message = f"this is no result of synthesize: its schema is not {SCHEMA}"
        raise InputError("E150", message, where=label, help=_HELP)
    stated = tree.get("task")
    if not isinstance(stated, Mapping) or not isinstance(tree.get("linkages"), list):
        raise _unlike("this result has no task, or no linkages", label)
    try:
        task = task_of_tree(stated.get("function"))
    except InputError as error:
        error.where = error.where or label
        raise
    every = [_generator(each, task, label) for each in tree["linkages"]]
    ids = [each["id"] for each in tree["linkages"]]
    exact = tree.get("method") in ("exact", "phases")
    found = []
    for rank, (id, one) in enumerate(zip(ids, every, strict=True), start=1):
        (judged,) = found_generators(one, task, exact=exact)
        names = FoundGenerator.__match_args__[2:]
        found.append(FoundGenerator(id, rank, *(getattr(judged, name) for name in names)))
    return FunctionResult(label, task, tuple(found))


_HELP = "make it with `burmester synthesize FILE -o result.json`"


def _generator(tree: Any, task: FunctionTask, label: str) -> Generator:
    """One generator, with a leading axis of one."""
    try:
        links = [float(tree["links"][key]) / task.ground for key in LINK_KEYS]
        phases = [math.radians(float(tree[f"{key}_phase_deg"])) for key in ("input", "output")]
        side, id = float(tree["side"]), tree["id"]
    except (KeyError, TypeError, ValueError, OverflowError):
        raise _unlike("a linkage of this result lacks a dimension", label) from None
    numbers = np.array([*links, *phases])
    if (
        not np.isfinite(numbers).all()
        or min(links) <= 0
        or max(links) > 1e9
        or side not in (1.0, -1.0)
        or not isinstance(id, str)
    ):
        raise _unlike("a linkage of this result has a dimension that no linkage has", label)
    a, r, b = links
    return Generator(*(np.array([v]) for v in (a, r, b, *phases, side)))


def _unlike(message: str, label: str) -> InputError:
    return InputError("E150", message, where=label, help=_HELP)
