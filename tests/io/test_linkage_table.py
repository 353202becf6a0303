"""The table of usable linkages takes as many columns as there is room for, as Rich measures it."""

from __future__ import annotations

import io
from functools import cache

import pytest
from rich.console import Console

from burmester.io.linkage_table import usable_table
from burmester.io.reading.poses import read_task
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.result import Synthesis


@cache
def synthesis_of(case: str) -> Synthesis:
    return synthesize(read_task(f"case:{case}"))


@pytest.mark.parametrize("case", ["ge2012-exact", "motiongen-rrrp", "motiongen-rrpr"])
def test_the_widest_table_that_fits_is_taken(case: str) -> None:
    widths = []
    for columns in range(50, 150, 5):
        console = Console(width=columns, file=io.StringIO())
        unlimited = console.options.update(max_width=10 * columns)
        synthesis = synthesis_of(case)
        table = usable_table(synthesis, synthesis.usable, console)
        widths.append(console.measure(table, options=unlimited).maximum)
        if columns >= 60:
            assert widths[-1] <= columns
    assert widths == sorted(widths)
    assert widths[-1] > widths[0]
