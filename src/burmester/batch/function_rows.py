"""Function tasks of a batch: read as `burmester function` reads them, and their rows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import pyarrow as pa

from burmester.batch.answer_rows import answer_table
from burmester.batch.options import BatchOptions
from burmester.batch.parts import TableTasks, TextTasks
from burmester.batch.schema import DYAD, GENERATOR, LINKAGE
from burmester.functions.function_task import FunctionTask
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.functions.function_kind import is_function

__all__ = ["NOT_STACKED", "function_rows", "function_task"]

NOT_STACKED: Final = "pairs of angles are solved at the depth full only"


def function_task(
    tasks: TableTasks | TextTasks, index: int, options: BatchOptions
) -> FunctionTask | None:
    """A task of pairs of angles; None where it is one of poses.  Raises what its reader does."""
    if isinstance(tasks, TextTasks):
        label, data = tasks.labels[index], tasks.data[index]
        return read_function(data, label, options.functions) if is_function(data, label) else None
    if not tasks.pairs:
        return None
    one = tasks.only([index])
    unit = "deg" if one.degrees else "rad"
    weights = one.weights
    lines = [f"input_{unit},output_{unit}{',weight' if weights is not None else ''}"]
    for row, numbers in enumerate(one.poses.tolist()):
        cells = list(map(repr, numbers))
        if weights is not None:
            cells.append(repr(float(weights[row])))
        lines.append(",".join(cells))
    label = f"{one.label}, task {one.names[0]}"
    return read_function("\n".join(lines).encode(), label, options.functions)


def function_rows(found: Mapping[int, Mapping[str, Any]]) -> pa.Table:
    """Function syntheses as `burmester function --json` tells them, by their places in a part."""
    every = list(found.values())
    return answer_table(
        np.array(list(found), dtype=np.intp),
        pa.array(
            ["solved" if any(e["usable"] for e in d["linkages"]) else "none usable" for d in every],
            pa.string(),
        ),
        pa.array([data["outcome"]["code"] for data in every], pa.string()),
        pa.nulls(len(every), pa.string()),
        pa.array([[]] * len(every), pa.list_(DYAD)),
        pa.nulls(len(every), pa.list_(LINKAGE)),
        pa.array([[w["code"] for w in data["warnings"]] for data in every], pa.list_(pa.string())),
        pa.array([list(map(_generator, data["linkages"])) for data in every], pa.list_(GENERATOR)),
    )


def _generator(data: Mapping[str, Any]) -> dict[str, Any]:
    links, error = data["links"], data["structural_error_deg"]
    return {
        "verdict": "usable" if data["usable"] else data["defects"][0]["kind"],
        "type": data["type"],
        "ground": links["ground"],
        "input_link": links["input"],
        "coupler": links["coupler"],
        "output_link": links["output"],
        "input_phase_deg": data["input_phase_deg"],
        "output_phase_deg": data["output_phase_deg"],
        "side": data["side"],
        "max_error_deg": error["max"],
        "rms_error_deg": error["rms"],
        "transmission_deg": data["min_transmission_angle_deg"],
        "link_ratio": data["link_ratio"],
        "extent": data["extent"],
    }
