"""The dyads of the paper's pencil, for a stack of plain tasks."""

from __future__ import annotations

import numpy as np

from burmester.dyads.pencil import fit_pencil
from burmester.numerics.bundles import take
from burmester.stacked.found_dyads import Fits, Solutions, found_in_stack
from burmester.stacked.plain_tasks import plain_tasks
from burmester.stacked.task_stack import TaskStack
from burmester.stacked.vouched import Vouched

__all__ = ["pencil_dyads"]


def pencil_dyads(stack: TaskStack) -> Vouched:
    """The dyads of the pencils of tasks of six poses or more, which can be computed with."""
    fit = fit_pencil(stack.displacements, stack.weights)
    values = fit.singular_values if stack.weights is None else None
    plain, _ = plain_tasks(stack, values)
    index = np.flatnonzero(plain)
    if len(index) < len(stack):
        stack, fit = stack[index], take(fit, index)
    seen = fit.frames.to_canonical(stack.displacements)
    fits = Fits(stack, fit.frames, seen, fit.frames.length)
    found = found_in_stack(fits, Solutions.of(fit), fits.blur(fit.noise, fit.gap))
    return Vouched.of(index, "pencil", fits, found)
