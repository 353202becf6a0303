"""The columns of dyads, from the dyads that were found for tasks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import CIRCLE, FIXED_LINE, KINDS, MOVING_LINE, Found
from burmester.fourbar.dyad import PP, PR, line_direction_deg
from burmester.geometry.displacement import Displacement
from burmester.stacked.answers import DyadRows

__all__ = ["rows_of_found"]


def rows_of_found(found: Found, poses: Displacement, status: NDArray[np.int8]) -> DyadRows:
    """The dyads (D,) of tasks with poses (T, N) as rows; status: (D,)."""
    rows, z, kind = DyadRows.blank(len(found.task)), found.dimensions, found.kind
    rows.task[:], rows.kind[:], rows.status[:] = found.task, kind, status
    rows.rms[:], rows.worst[:] = found.rms, found.worst
    circle, fixed, moving = (kind == each for each in (CIRCLE, FIXED_LINE, MOVING_LINE))
    rows.fixed[circle | moving] = z[circle | moving, :2]
    rows.moving[circle | fixed] = z[circle | fixed, 2:4]
    rows.length[circle] = z[circle, 4]
    angles = kind == KINDS.index(PP)
    rows.angle_deg[angles] = np.degrees(z[angles, 0])
    for of, normal, pivot in ((fixed, 0, 2), (moving, 2, 0)):
        if not len(index := np.flatnonzero(of)):
            continue
        line = PR(z[index, normal], z[index, normal + 1], z[index, pivot : pivot + 2])
        places = poses[found.task[index]]
        rows.direction_deg[index] = line_direction_deg(line.normal_angle)
        rows.normal_deg[index], rows.offset[index] = np.degrees(line.normal_angle), line.offset
        rows.point[index] = line.middle_of_travel(places.inverse() if normal else places)
    return rows
