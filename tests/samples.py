"""How many random cases a test takes: a few in CI, and all of them where somebody asks.

`EVERY_SAMPLE=1 scripts/test` takes them all.
"""

import os
from collections.abc import Sequence
from typing import TypeVar

EVERY = bool(os.environ.get("EVERY_SAMPLE"))

Item = TypeVar("Item")


def samples(every: int, some: int) -> range:
    """The numbers of all cases, or of the first ones: 40 of 200 by `samples(200, 40)`."""
    return range(every if EVERY else some)


def some_of(cases: Sequence[Item], number: int) -> list[Item]:
    """All cases, or so many of them, evenly from the first to the last."""
    cases = list(cases)
    if EVERY or number >= len(cases):
        return cases
    return [cases[k * len(cases) // number] for k in range(number)]
