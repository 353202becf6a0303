"""Burmester's curves of four poses: every link that meets them, coloured by what works."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from burmester.dyads.burmester_curve import dyad_curve
from burmester.families.family_map import curve_map
from burmester.families.pair_verdicts import CLASS_WORDS
from burmester.io.linkage_data import numbers
from burmester.tasks.motion_task import Task

SAMPLES: Final = 100  # dyads on all loops together, where they are judged: pairs are their square
DRAWN: Final = 200  # the same where they are only drawn


def curves(task: Task, *, judged: bool) -> dict[str, Any]:
    """The loops of dyads with their pivots and lengths.

    judged: whether to say of each dyad what it makes with its best partner: the class, a number
    of `words`, and the least transmission angle there.  Raises E121 and E124 as `dyad_curve`.
    """
    loops: list[tuple[Any, dict[str, Any]]]
    if judged:
        found = curve_map(task, samples=SAMPLES)
        classes, angle = found.best_partner()
        every = [np.flatnonzero(found.loop == k) for k in range(int(found.loop.max()) + 1)]
        degrees = np.degrees(angle)
        loops = [
            (
                found.second[own],
                {"class": classes[own].tolist(), "transmission_deg": numbers(degrees[own])},
            )
            for own in every
        ]
    else:
        loops = [(each, {}) for each in dyad_curve(task.poses, DRAWN).components]
    parts = [
        {
            "fixed": numbers(dyads.fixed_pivot),
            "moving": numbers(dyads.moving_pivot),
            "length": numbers(dyads.radius),
            **more,
        }
        for dyads, more in loops
    ]
    return {"loops": parts, "words": list(CLASS_WORDS.values())}
