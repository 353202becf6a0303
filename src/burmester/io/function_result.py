"""A function synthesis as plain data, and read back: the object of `burmester function --json`.

The contract is `function.schema.json` beside this file.  Reading takes from it the task and the
dimensions of linkages, and judges these anew, as `saved` does.

E150 no result of this kind      E151 no such linkage, or none at all
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final, NamedTuple, get_args

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.functions.found_generator import FoundGenerator, found_generators
from burmester.functions.function_task import FunctionTask, chebyshev_spacing
from burmester.functions.generator import Generator
from burmester.io.linkage_data import number
from burmester.io.reading.functions.function_file import task_of_tree
from burmester.io.reading.stated_requirements import requirements_data
from burmester.io.result import message_data
from burmester.io.saved import (
    judged_otherwise,
    linkages_by_id,
    named,
    outcome_of,
    result_tree,
    unlike,
    warnings_of,
)
from burmester.printable import printable
from burmester.synthesis.function_generation import (
    FunctionMethod,
    FunctionSynthesis,
    coupler_synthesis,
)
from burmester.values import shown
from burmester.verdicts.found_linkage import FoundLinkage

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
COUNTS: Final = ("expected", "found", "real")
LONGEST = 1e9  # ground links; no link is longer
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
    }
    data |= {key: _plain_degrees(each) for key, each in angles.items() if each is not None}
    return (
        data
        | requirements_data(task.requirements)
        | {"minimax": task.minimax, "ground": task.ground}
    )


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
    """A result that was read: where it came from, and its generators, judged anew.

    refused: the linkages of the file that cannot be used, by id, and why.
    """

    label: str
    synthesis: FunctionSynthesis
    refused: Mapping[str, InputError]

    def choose(self, id: str | None = None) -> FoundGenerator:
        """A linkage by its id, or the first; raises E150, E151."""
        every = self.synthesis.generators
        if not every:
            raise InputError(
                "E151",
                "there is no linkage in this result",
                where=self.label,
                why="it has none",
                help="`burmester explain R361` says more",
            )
        return named(every, id, self.label, self.refused)

    def exported(self, id: str | None = None) -> FoundLinkage:
        """A linkage as exports take it: the coupler is the body."""
        chosen = self.choose(id)
        judged = coupler_synthesis(self.synthesis.task, chosen)
        return replace(judged.linkages[0], id=chosen.id, usable=chosen.usable)


def is_function_result(data: bytes) -> bool:
    """Whether bytes are a result of this kind, whatever is wrong with it."""
    return data[:200].lstrip().startswith(b'{"schema": "burmester.function/')


def read_function_result(data: bytes, path: str) -> FunctionResult:
    """The result in the bytes of a file; raises E109, E150 and what reading its task raises."""
    label = "<stdin>" if path == "-" else printable(path)
    tree = result_tree(data, label)
    refused: dict[str, InputError] = {}
    try:
        synthesis = _synthesis(tree, refused)
    except InputError as error:
        error.where = error.where or label
        raise
    for each in refused.values():
        each.where = label
    return FunctionResult(label, synthesis, refused)


def _synthesis(tree: dict[str, Any], refused: dict[str, InputError]) -> FunctionSynthesis:
    """The task of a file and its linkages, judged anew; of the search what the file says."""
    if tree.get("schema") != SCHEMA:
        raise unlike(f"this is no result of function: its schema is not {SCHEMA}")
    stated = tree.get("task")
    if not isinstance(stated, dict) or not isinstance(tree.get("linkages"), list):
        raise unlike("this result has no task, or no linkages")
    method: FunctionMethod | None = next(
        (each for each in get_args(FunctionMethod) if each == tree.get("method")), None
    )
    if method is None:
        raise unlike("$.method of this result cannot be used", f"it is {shown(tree.get('method'))}")
    task = task_of_tree(stated.get("function"))
    found, others = list[FoundGenerator](), list[str]()
    for id, each in linkages_by_id(tree):
        try:
            one = _generator(each, task)
        except InputError as error:
            refused[id] = error
            continue
        (judged,) = found_generators(one, task, exact=method in ("exact", "phases"))
        judged = replace(judged, id=id, rank=len(found) + 1)
        found.append(judged)
        stated = each.get("usable")
        if isinstance(stated, bool) and stated is not judged.usable:
            others.append(f"{id} is {'' if judged.usable else 'not '}usable, otherwise than stated")
    if refused and not found:
        raise next(iter(refused.values()))
    search = tree.get("search")
    counts = (search.get(key) if isinstance(search, dict) else None for key in COUNTS)
    return FunctionSynthesis(
        task,
        method,
        outcome_of(tree),
        tuple(found),
        (*warnings_of(tree), *judged_otherwise(others, refused)),
        *(each if isinstance(each, int) else None for each in counts),
    )


def _generator(tree: dict[str, Any], task: FunctionTask) -> Generator:
    """One generator, with a leading axis of one; raises E150."""
    try:
        links = [float(tree["links"][key]) / task.ground for key in LINK_KEYS]
        phases = [math.radians(float(tree[f"{key}_phase_deg"])) for key in ("input", "output")]
        side = float(tree["side"])
    except (KeyError, TypeError, ValueError, OverflowError):
        raise unlike("a linkage of this result lacks a dimension") from None
    numbers = np.array([*links, *phases])
    sound = np.isfinite(numbers).all() and min(links) > 0 and max(links) <= LONGEST
    if not sound or side not in (1.0, -1.0):
        raise unlike("a linkage of this result has a dimension that no linkage has")
    a, r, b = links
    return Generator(*(np.array([v]) for v in (a, r, b, *phases, side)))
