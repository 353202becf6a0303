"""Springs that balance linkages, as a table and as plain data."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Console
from rich.text import Text

from burmester.describe.load_words import load_notes
from burmester.errors import InputError
from burmester.io.linkage_table import table_of
from burmester.io.loads_data import load_figures_data
from burmester.io.reading.pose_table import Source
from burmester.io.reading.trees.loads_tree import loads_data
from burmester.io.reading.trees.specification_tree import region_from_text
from burmester.loads.balance import Balanced
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Synthesis
from burmester.wording import count

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
                "spring": loads_data(each.found.task.loads)["springs"][-1],
                **load_figures_data(each.figures, each.found.task.names),
            }
            for each in found
            if each.found.task.loads is not None
        ],
    }


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
        f"{best.offer.name} on {best.found.id}: the {what} needs at most {best.worst:.3g} {unit}, "
        f"and {best.before:.3g} {unit} without it."
        + ("" if best.keeps else "  It does not keep all that is asked.")
    ))  # fmt: skip
    one, two = best.spring.ends
    console.print(Text(f"It goes from {_point(one.point)} on the ground to {_point(two.point)} on "
                       "the body."))  # fmt: skip
    for note in load_notes(best.figures, task):
        console.print(Text(note))
    rows = [
        [
            each.found.id,
            each.offer.name,
            _point(each.spring.ends[0].point),
            _point(each.spring.ends[1].point),
            f"{each.worst:.3g}",
            "yes" if each.keeps else "no",
        ]
        for each in found[:SHOWN]
    ]
    heads = ["", "spring", "ground", "body", f"most {unit}", "keeps all"]
    console.print()
    console.print(table_of(heads, rows, "Springs, the best first", left=2))
    console.print(Text(
        f"\nFound by a search among {count(offers, 'spring')}; that none is better is not proved."
    ))  # fmt: skip
    if file is not None:
        console.print(Text(f"Wrote the task with {best.offer.name} to {file}."))


def _point(at: tuple[float, float]) -> str:
    return f"({at[0]:.4g}, {at[1]:.4g})"
