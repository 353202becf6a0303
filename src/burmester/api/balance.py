"""Springs that balance the linkages of a task, in one call."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from burmester.api.python_words import in_python_words
from burmester.io.spring_list import springs_of_file, usual_springs
from burmester.loads.balance import Balanced, Offer
from burmester.numerics.arrays import FloatArray
from burmester.progress import Listener, shown
from burmester.synthesis import balanced
from burmester.tasks.motion_task import Task
from burmester.values import real_numbers


def balance(
    task: Task,
    springs: str | os.PathLike[str] | Sequence[Offer] | None = None,
    *,
    ground: ArrayLike | None = None,
    body: ArrayLike | None = None,
    with_linkage: bool = False,
    progress: Listener | None = None,
) -> tuple[Balanced, ...]:
    """The springs with which a hand moves the usable linkages of a task with least force.

    A search over the ends of springs on the ground and on the body, for each usable linkage and
    each spring of a list; that none is better is not proved.

    Parameters
    ----------
    task : Task
        With `loads`: the mass of the body, and where the hand is.  Its bounds on the hand's force,
        on where it stays and from where it closes are aimed at.
    springs : path or sequence of Offer, optional
        A list in CSV, or offers; by default usual sizes.
    ground, body : (2, 2) array_like, optional
        Two corners of the boxes in which the ends may be, in F and in M; by default around the
        pivots, and around the body.
    with_linkage : bool
        Whether pivots move too: those of the best few linkages, for their springs, and the springs
        for them.  All else that is asked is kept.  Where no tolerance is stated, poses are missed
        by a hundredth of the motion at most, and not at all where linkages are a family.
    progress : callable, optional
        Told what is being done; see `synthesize`.

    Returns
    -------
    tuple of Balanced
        Those that keep all that is asked first, then by the greatest force that is left.  Each has
        `spring`, `worst` and `before` (the greatest force with and without it, N), `figures`, and
        `found`, the linkage whose task has the spring.  One whose pivots were moved has `unmoved`,
        the best with the pivots where they were.

    Raises
    ------
    InputError
        E101 and E177 (a list that cannot be used), E134 (a task without loads).
    """
    with in_python_words(), shown(progress):
        if springs is None:
            offers = usual_springs(task.length_unit or "mm")
        elif isinstance(springs, str | os.PathLike):
            offers = springs_of_file(os.fspath(springs))
        else:
            offers = list(springs)
        regions = balanced.BalanceRegions(_box(ground, "ground"), _box(body, "body"))
        return tuple(balanced.balance(task, offers, regions, with_linkage=with_linkage)[1])


def _box(corners: ArrayLike | None, what: str) -> FloatArray | None:
    if corners is None:
        return None
    given = real_numbers(corners, (2, 2), f"the box of the {what}")
    return np.array([given.min(axis=0), given.max(axis=0)])
