"""Degenerate linkages: links shorter than the play of any pin, or errors magnified beyond use.

Such a linkage meets its poses on paper only: it works by the difference of two pivots that fall
together.  The bounds are conventions, far below those of a linkage to build (`requirements.table`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from burmester.errors import Finding
from burmester.fourbar.linkage_batch import LinkageBatch, pin_distances
from burmester.geometry.regions import Point
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.problem import SynthesisProblem
from burmester.wording import figure

MIN_LINK_SHARE: Final = 1 / 200  # spans of the motion; a shorter link makes no usable linkage
# Position error at a pose per unit of error in all dimensions; a linkage above it is not usable.
MAX_SENSITIVITY: Final = 100.0


def least_link(problem: SynthesisProblem) -> float:
    """The length of the shortest link of a usable linkage, in the task's unit."""
    return MIN_LINK_SHARE * (span(problem.given) or problem.motion_size)


def least_cranks(problem: SynthesisProblem) -> tuple[float, float]:
    """The same of the dyads' own links: shorter where their limits state lengths as short."""
    least, limits = least_link(problem), problem.given.limits
    lengths = [each.length for each in (limits * 2)[:2]] or [(0.0, np.inf)] * 2
    one, two = (min(least, low) if low > 0 or high < least else least for low, high in lengths)
    return one, two


def least_links(problem: SynthesisProblem) -> FloatArray:
    """The least lengths (4,) of links as `pin_distances` has them.

    Two pivots at points that the task states are as near to each other as it says.
    """
    limits = (problem.given.limits * 2)[:2]
    fixed, moving = (
        0.0 if pivots and all(isinstance(at, Point) for at in pivots) else least_link(problem)
        for pivots in (
            [each.fixed_pivot for each in limits],
            [each.moving_pivot for each in limits],
        )
    )
    return np.array([*least_cranks(problem), fixed, moving])


def degenerate_defects(
    batch: LinkageBatch, sensitivity: FloatArray, problem: SynthesisProblem
) -> list[tuple[Finding, ...]]:
    """For each of linkages (k,), in the task's own frames, why it is degenerate; () is sound.

    sensitivity: (k,), as `quality.Quality` has it; nan where there is none.
    """
    lengths, least = pin_distances(batch), least_links(problem)
    out = []
    for length, each in zip(lengths, sensitivity, strict=True):
        reasons = list(too_short(length, least, problem.given))
        if each > MAX_SENSITIVITY:
            # At a change point it is infinite but for rounding, and its digits say nothing.
            times = f"up to {figure(each)}" if each < 1e6 else "over a million"
            reasons.append(f"magnifies errors of its pivots and lengths {times} times at a pose")
        out.append(tuple(Finding("degenerate", reason, ()) for reason in reasons))
    return out


def too_short(lengths: FloatArray, least: FloatArray, task: Task) -> Iterator[str]:
    """That of links (b,) some are shorter than the least lengths, the shortest of these; or not."""
    with np.errstate(invalid="ignore"):
        short = np.where(lengths < least, lengths, np.inf)
    if np.isfinite(short).any():
        at = int(short.argmin())
        share = f"1/{1 / MIN_LINK_SHARE:.0f}"
        yield (
            f"has a link of {length_of(float(lengths[at]), task)}, shorter than {share} of the "
            f"motion's span ({length_of(float(least[at]), task)})"
        )
