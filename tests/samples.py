"""How many cases of a campaign are run: a few, and all of them with `scripts/test --all`."""

import math
import os
from collections.abc import Sequence
from typing import TypeVar

EVERY = bool(os.environ.get("EVERY_SAMPLE"))
SHARE = 0.2  # of a campaign that is not told how many it takes

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


def share(count: int) -> int:
    """How many of so many cases are taken: a fifth, and both of two."""
    return count if EVERY or count <= 2 else math.ceil(SHARE * count)
