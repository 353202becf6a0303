"""A function synthesis as plain data: the object of `burmester function --json`.

The contract is `function.schema.json` beside this file; `saved` reads it back.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.functions.found_generator import FoundGenerator
from burmester.functions.generator import Generator
from burmester.io.linkage_data import FUNCTION_SCHEMA, dimensions_data, number
from burmester.io.reading.specification import requirements_data
from burmester.synthesis.function_generation import FunctionSynthesis
from burmester.tasks.function_task import FunctionTask, chebyshev_spacing

LINK_KEYS = ("input", "coupler", "output")
LONGEST = 1e9  # ground links; no link is longer
SAME_SHARE = 1e-9  # of the range; shares that differ less are the same spacing


def function_data(synthesis: FunctionSynthesis) -> dict[str, Any]:
    """The synthesis as an object ready for JSON."""
    task = synthesis.task
    return {
        "schema": FUNCTION_SCHEMA,
        "outcome": synthesis.outcome.to_dict(),
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
        "linkages": [_linkage(each) for each in synthesis.generators],
        "warnings": [each.to_dict() for each in synthesis.warnings],
    }


def function_task_data(task: FunctionTask) -> dict[str, Any]:
    """A task: as a file may hold it, and its pairs."""
    rows = zip(np.degrees(task.inputs).tolist(), np.degrees(task.outputs).tolist(), strict=True)
    pairs = [{"input_deg": one, "output_deg": other} for one, other in rows]
    return {"function": _task(task), "pairs": pairs}


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


def _linkage(found: FoundGenerator) -> dict[str, Any]:
    one, task, dyads = found.generator, found.task, found.linkage
    inputs, _ = task.compared()
    return {
        "id": found.id,
        "rank": found.rank,
        "type": found.type,
        "usable": found.usable,
        "links": {key.removesuffix(" link"): each for key, each in found.lengths.items()},
        "input_phase_deg": math.degrees(float(one.input_phase)) % 360,
        "output_phase_deg": math.degrees(float(one.output_phase)) % 360,
        "side": int(one.side),
        "dyads": [dimensions_data(dyads.first), dimensions_data(dyads.second)],
        "structural_error_deg": {
            "max": _degrees(found.max_error),
            "rms": _degrees(found.rms_error),
            "max_percent": number(found.percent),
        },
        "pair_errors_deg": [_degrees(each) for each in found.errors.tolist()],
        "error_curve": {
            "input_deg": np.degrees(inputs).tolist(),
            "error_deg": [_degrees(each) for each in found.range_errors.tolist()],
        },
        "min_transmission_angle_deg": _degrees(found.least_transmission),
        "link_ratio": float(one.link_ratio),
        "extent": found.extent * task.ground,
        "defects": [{"kind": each.code, "message": each.message} for each in found.faults],
        "shortcomings": list(found.shortcomings),
    }


def _degrees(angle: float) -> float | None:
    return number(math.degrees(angle))


def generator_of(tree: dict[str, Any], task: FunctionTask) -> Generator:
    """One generator, with a leading axis of one; raises ValueError."""
    try:
        links = [float(tree["links"][key]) / task.ground for key in LINK_KEYS]
        phases = [math.radians(float(tree[f"{key}_phase_deg"])) for key in ("input", "output")]
        side = float(tree["side"])
    except (KeyError, TypeError, ValueError, OverflowError):
        raise ValueError("a linkage of this result lacks a dimension") from None
    numbers = np.array([*links, *phases])
    sound = np.isfinite(numbers).all() and min(links) > 0 and max(links) <= LONGEST
    if not sound or side not in (1.0, -1.0):
        raise ValueError("a linkage of this result has a dimension that no linkage has")
    a, r, b = links
    return Generator(*(np.array([v]) for v in (a, r, b, *phases, side)))
