"""The paper's method, as this package has it: one singular value decomposition."""

from __future__ import annotations

import numpy as np

from benchmarks.field.linkage import FourBar
from benchmarks.field.task import FieldTask
from benchmarks.field.tools.burmester_synthesize import plain

TITLE = "pencil of quadrics (Ge et al. 2012)"
PACKAGE = "burmester"
CALLED = (
    "Poses: `fit_pencil(poses)`, the paper's method, as burmester has it.",
    "Its two dyads are one linkage. What `burmester.synthesize` adds is left out.",
)
LEAST = 6


def refuses(task: FieldTask) -> str | None:
    if task.is_path or task.is_function:
        return "it takes poses only"
    if task.pivots is not None:
        return "it takes no limits"
    if len(task.rows) < LEAST:
        return "it takes six poses or more"
    return None


def solve(task: FieldTask, seconds: float) -> list[FourBar]:
    from burmester import Displacement, fit_pencil

    fit = fit_pencil(Displacement.from_poses(task.rows))
    pair = [plain(fit.dyads[k]) for k in np.flatnonzero(np.isfinite(fit.rms_error))]
    return [FourBar(*pair)] if len(pair) == 2 and all(pair) else []
