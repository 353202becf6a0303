"""A linkage at its poses with the body it moves, drawn by Matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from burmester import plot
from burmester.errors import InputError
from burmester.export.coupler_motion import CouplerMotion
from burmester.fourbar.dyad import PP
from burmester.geometry.displacement import Displacement
from burmester.plot.plane import span_of
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.still import own_circuit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SWEPT_PLACES = 49  # of the body along the motion; each is a thin outline
MOST_PLACES = 12  # at which the linkage is drawn; a path has too many


def linkage_figure(saved: FoundLinkage, ax: Axes | None = None) -> Figure:
    """The linkage at the middle one of its places, faintly at others, over the poses."""
    linkage, places, poses = saved.driver_first, saved.error.places, saved.task.poses
    with plot.house_style():
        if ax is None:
            ax = plot.figure(7.0, 6.0).add_axes((0.1, 0.08, 0.86, 0.82))
        there = np.flatnonzero(np.isfinite(places.angle))
        travel = tuple(places[int(k)] for k in there)
        if not isinstance(linkage.first, PP) and not isinstance(linkage.second, PP):
            own = own_circuit(linkage, places[there])
            plot.coupler_curve(ax, linkage, only=own, size=span_of(poses))
        middle = int(there[len(there) // 2]) if len(there) else None
        if saved.task.surroundings is not None:
            plot.keep_out(ax, saved.task.surroundings.keep_out)
        if saved.task.body is not None:
            shown = places if len(there) else poses[~saved.task.free_angles]
            outline = saved.task.body.vertices
            plot.body(ax, outline, shown, at=middle, along=_along(saved))
        some = there[np.linspace(0, len(there) - 1, min(len(there), MOST_PLACES)).astype(np.intp)]
        for k in sorted({*some.tolist(), *([] if middle is None else [middle])}):
            plot.linkage(
                ax, linkage, places[k], travel=travel, faint=k != middle, names=k == middle
            )
        plot.poses(ax, poses, free=saved.task.free_angles)
        plot.legend(ax)
        plot.finish(ax, saved.unit)
    drawing = ax.get_figure(root=True)
    assert drawing is not None
    return drawing


def _along(saved: FoundLinkage) -> Displacement | None:
    """Places of the body from the first pose to the last; None where nothing leads there."""
    try:
        return CouplerMotion.of(saved, SWEPT_PLACES).places
    except InputError:
        return None
