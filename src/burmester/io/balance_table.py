"""Springs that balance linkages, as a table and as plain data."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Console
from rich.text import Text

from burmester.describe.decimals import decimals_of_dyad
from burmester.describe.dimensions import sides_of
from burmester.describe.quality_words import load_notes
from burmester.errors import InputError
from burmester.io.linkage_data import dimensions_data, load_figures_data
from burmester.io.linkage_table import table_of
from burmester.io.reading.pose_table import Source
from burmester.io.reading.trees.loads_tree import loads_data
from burmester.io.reading.trees.specification_tree import region_from_text
from burmester.loads.balance import Balanced
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.synthesis.result import Synthesis
from burmester.tasks.notation import length_of, span
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import count, figure, listed

BALANCE_SCHEMA = "burmester.balance/1"
SHOWN = 6  # springs in the table


def corners_of(option: str, text: str | None) -> FloatArray | None:
    """The corners (2, 2) of a box in a text; raises E131 and E132."""
    if text is None:
        return None
    corners = region_from_text(Source(option, text if ":" not in text else f"box:{text}")).corners()
    if corners is None or len(corners) < 2:
        raise InputError(
            "E131",
            f"{option} is no box",
            where=f"{option} {text}",
            help="write X,Y:X,Y, two corners",
        )
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def balance_data(answer: Synthesis, found: Sequence[Balanced]) -> dict[str, Any]:
    """One object: the outcome of the linkages, and each spring with what it leaves."""
    return {
        "schema": BALANCE_SCHEMA,
        "outcome": answer.outcome.to_dict(),
        "springs": [
            {
                "linkage": each.found.id,
                "name": each.offer.name,
                "keeps_all": each.keeps,
                "greatest": each.worst,
                "greatest_without": each.before,
                **({} if each.reserve is None else {"reserve_N": each.reserve}),
                **_moved_data(each),
                "spring": loads_data(each.found.task.loads)["springs"][-1],
                **load_figures_data(each.figures, each.found.task.names),
            }
            for each in found
            if each.found.task.loads is not None
        ],
    }


def _moved_data(each: Balanced) -> dict[str, Any]:
    """Of a linkage whose pivots were moved: its dyads, its error, and what it was before."""
    if each.unmoved is None or not isinstance(each.found, FoundLinkage):
        return {}
    return {
        "dyads": [{"id": one.id, **dimensions_data(one.dyad)} for one in each.found.dyads],
        "error": _error(each),
        "unmoved": {"greatest": each.unmoved.worst, "error": _error(each.unmoved)},
    }


def _error(each: Balanced) -> dict[str, float]:
    error = each.found.error
    return {"position": error.worst, "angle_deg": float(np.degrees(error.angle.max()))}


def _moved(best: Balanced, unit: str) -> list[str]:
    """What moving its pivots gains and costs, and where they are."""
    if best.unmoved is None or not isinstance(best.found, FoundLinkage):
        return []
    task, before = best.found.task, best.unmoved
    dyads = [
        (one.id, *sides_of(one.dyad, decimals_of_dyad(one.dyad, task.poses, span(task))))
        for one in best.found.dyads
    ]
    at = [
        f"{id} from {ground} on the ground to {body} on the body" for id, ground, body, _ in dyads
    ]
    return [
        f"Its pivots were moved. Where they were, in {before.found.id}, the best spring leaves "
        f"{figure(before.worst, 3)} {unit}.",
        f"{best.found.id} meets the poses {_how(best)}, {before.found.id} {_how(before)}.",
        f"Its links are {listed(at)}.",
    ]


def _how(each: Balanced) -> str:
    task, error = each.found.task, _error(each)
    if error["position"] <= ROUNDING * span(task):
        return "exactly"
    return f"within {length_of(error['position'], task)} and {error['angle_deg']:.2g}°"


def show_balance(
    answer: Synthesis, found: Sequence[Balanced], offers: int, console: Console, file: str | None
) -> None:
    """The best spring in full, then a table of others."""
    if not found:
        console.print(Text(
            "No spring of the list fits between the ends that are allowed."
            if any(each.usable for each in answer.linkages)
            else f"No usable linkage to balance: {answer.outcome.message}"
        ))  # fmt: skip
        return
    best = found[0]
    task = best.found.task
    what = "hand" if best.figures.hand is not None else "driver"
    unit = "N" if what == "hand" or not best.figures.turns else "N·m"
    console.print(Text(
        f"{best.offer.name} on {best.found.id}: the {what} needs at most "
        f"{figure(best.worst, 3)} {unit}, and {figure(best.before, 3)} {unit} without it."
        + ("" if best.keeps else "  It does not keep all that is asked.")
    ))  # fmt: skip
    one, two = best.spring.ends
    console.print(Text(f"It goes from {_point(one.point)} on the ground to {_point(two.point)} on "
                       "the body."))  # fmt: skip
    for note in (*_reserve(best), *_moved(best, unit), *load_notes(best.figures, task)):
        console.print(Text(note))
    rows = [
        [
            each.found.id,
            each.offer.name,
            _point(each.spring.ends[0].point)[1:-1],
            _point(each.spring.ends[1].point)[1:-1],
            figure(each.worst, 3),
            "yes" if each.keeps else "no",
        ]
        for each in found[:SHOWN]
    ]
    heads = ["", "spring", "ground", "body", f"most {unit}", "kept"]
    console.print()
    console.print(table_of(heads, rows, "Springs, the best first", left=2))
    console.print(Text(
        f"\nFound by a search among {count(offers, 'spring')}; that none is better is not proved."
    ))  # fmt: skip
    if file is not None:
        what = best.found.id if is_result(file) else "the task"
        console.print(Text(f"Wrote {what} with {best.offer.name} to {file}."))
        if best.unmoved is not None and not is_result(file):
            console.print(Text("The task has no pivots: name a .json file to keep them."))


def is_result(file: str) -> bool:
    """Whether a file by its name is to hold a linkage, and not a task."""
    return file.lower().endswith(".json")


def _reserve(best: Balanced) -> list[str]:
    """How far the hand stays inside its corridor."""
    if best.reserve is None:
        return []
    least, most = (best.figures.measures[f"hand_{each}"] for each in ("least", "greatest"))
    where = "inside" if best.reserve >= 0 else "outside"
    return [
        f"On its way the hand pushes with {figure(least, 3)} to {figure(most, 3)} N, "
        f"{figure(abs(best.reserve))} N {where} its corridor."
    ]


def _point(at: tuple[float, float]) -> str:
    return f"({at[0]:.4g}, {at[1]:.4g})"
