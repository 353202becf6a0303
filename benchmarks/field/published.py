"""Published tasks: those of the package's cases, and paths from papers, each with its source."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.field import generated as kinds
from benchmarks.field.known import dyads_of_five, given_pivots, solving
from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import EXACT, NO_LINKAGE, FieldTask, Pivots

CASES = Path(__file__).parents[2] / "src" / "burmester" / "cases"
PAPERS = Path(__file__).with_name("published.json")
SHELF = {
    "ge2012-exact": (kinds.MANY, EXACT),
    "ge2012-approximate": (kinds.SMOOTH, NO_LINKAGE),
    "motiongen-shoulder": (kinds.FIVE, EXACT),
    "motiongen-mixed5": (kinds.DEFECTS, NO_LINKAGE),
    "motiongen-four-line": (kinds.BOX, EXACT),
    "motiongen-three-pivots": (kinds.GIVEN, EXACT),
    "motiongen-prpr": (kinds.SLIDERS, EXACT),
    "motiongen-rrpr": (kinds.SLIDERS, EXACT),
    "motiongen-rrrp": (kinds.SLIDERS, EXACT),
}


def published() -> Iterator[FieldTask]:
    for name, (kind, tolerance) in SHELF.items():
        yield _of_case(json.loads((CASES / f"{name}.json").read_text()), kind, tolerance)
    for data in json.loads(PAPERS.read_text()):
        pivots = _pivots(data["pivots"]) if "pivots" in data else None
        rows = np.array(data["rows"], dtype=float)
        if rows.shape[1] == 3:  # poses, their angles in degrees
            rows[:, 2] = np.unwrap(np.radians(rows[:, 2]))
        names = (data["name"], data["kind"], data["source"])
        crank = np.radians(data["crank_deg"]) if "crank_deg" in data else None
        yield FieldTask(*names, rows, data["tolerance"], pivots, crank=crank)


def _pivots(data: dict[str, Any]) -> Pivots:
    a, b = (complex(*place) for place in data["places"])
    return Pivots(data["kind"], (a, b))


def _of_case(data: dict[str, Any], kind: str, tolerance: float) -> FieldTask:
    rows = np.array(data["poses"], dtype=float)
    rows[:, 2] = np.unwrap(np.radians(rows[:, 2]))
    task = FieldTask(data["name"], kind, data["source"], rows, tolerance)
    if kind == kinds.FIVE:
        return replace(task, known=solving(task, dyads_of_five(task)))
    if kind == kinds.GIVEN:
        a, b = (complex(*each["fixed_pivot"]["point"]) for each in data["limits"])
        task = replace(task, pivots=Pivots("points", (a, b)))
        return replace(task, known=solving(task, given_pivots(task)))
    if kind == kinds.BOX:
        a, b = (complex(*place) for place in data["limits"]["fixed_pivot"]["line"])
        task = replace(task, pivots=Pivots("line", (a, b)))
        dyads = [_link(row) for row in data["exact_dyads"]]
        return replace(task, known=solving(task, dyads))
    if "linkage" in data.get("printed", {}):
        pair = [_printed(each) for each in data["printed"]["linkage"]]
        return replace(task, known=(FourBar(*pair),))
    if "expected" in data:
        found = [_of_kind(name, row) for name, all_of in data["expected"].items() for row in all_of]
        return replace(task, known=(FourBar(*found),))
    return task


def _link(row: list[float]) -> Dyad:
    xc, yc, r, x, y = row
    return Dyad("RR", complex(xc, yc), complex(x, y), r)


def _printed(each: dict[str, Any]) -> Dyad:
    fixed, moving = complex(*each["fixed_pivot"]), complex(*each["moving_pivot"])
    return Dyad("RR", fixed, moving, each["radius"])


def _of_kind(name: str, row: Any) -> Dyad:
    """A dyad as the presets have it."""
    if name == "RR":
        xc, yc, r, x, y = row
        return Dyad("RR", complex(xc, yc), complex(x, y), r)
    if name == "PR":
        moving = complex(*row["moving_pivot"])
        return Dyad("PR", 0j, moving, row["offset"], float(np.radians(row["normal_deg"])))
    normal = float(np.radians(row["normal_in_M_deg"]))
    return Dyad("RP", complex(*row["fixed_pivot"]), 0j, row["offset"], normal)
