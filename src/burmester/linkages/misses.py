"""By how much the poses are missed, in what is allowed: the same for linkages of any kind."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple, Self, final

import numpy as np

from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.refinement.tolerance_boxes import shares_used
from burmester.tasks.motion_task import Task
from burmester.verdicts.ranking import DEFAULT_TOLERANCE

SHARE_ROUNDING: Final = 1e-9  # relative; a tolerance that is exceeded by less is kept


@final
class Misses(NamedTuple):
    """What linkages (k,) miss the poses by.

    missed: (k, N), at most `reach` is allowed: both lengths or, where tolerances decide, shares.
    shares: (k, N, 3), of the tolerances that are used, where these decide.
    slack: (k,), a length; nearer to each other along a circuit poses have no order: twice the
        greatest distance by which one is missed.
    length: what a radian counts as in a distance.
    """

    missed: FloatArray
    reach: float
    shares: FloatArray | None
    slack: FloatArray
    length: float

    @classmethod
    def of(
        cls,
        places: Displacement,
        errors: Sequence[PoseError],
        task: Task,
        length_per_radian: float,
        *,
        size: float,
    ) -> Self:
        """Those of places (k, N) with their errors; size: of the motion."""
        asked = task.requirements
        position = np.array([each.position for each in errors]).reshape(places.shape)
        turn = np.array([each.angle for each in errors]).reshape(places.shape)
        reach, length = asked.reach(DEFAULT_TOLERANCE * size, length_per_radian)
        missed = np.maximum(position, length * turn)
        if task.tolerances is None or not task.tolerances.gives_room:  # the errors alone count
            near = np.where(np.isfinite(places.angle), np.minimum(missed, reach), 0.0)
            return cls(missed, reach, None, 2 * near.max(axis=1), length)
        shares = shares_used(places, task, size)
        stated = asked.within is not None or asked.within_deg is not None
        used = np.maximum(shares.max(axis=-1), missed / reach if stated else 0.0)
        slack = 2 * np.nan_to_num(np.hypot(position, length * turn)).max(axis=1)
        return cls(used, 1 + SHARE_ROUNDING, shares, slack, length)
