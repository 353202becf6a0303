"""A six-bar at a place of its driver, and the whole picture of one at its poses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.artist import Artist
from matplotlib.colors import to_rgb
from matplotlib.patches import Polygon

from burmester.plot.plane import poses
from burmester.plot.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    figure,
    finish,
    label,
)
from burmester.tasks.motion_task import Task

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from burmester.sixbar.found import FoundSixBar

__all__ = ["six_bar", "six_bar_figure"]

PLATES = (ORANGE, GREEN, PURPLE)  # links of three joints; the body is blue
FAINT_INK = "#aab3bd"
GROUND = 0.035  # of the size of the picture: the triangle at a pivot on the ground
STEPS = 201  # places along the path of the body's origin


def six_bar(
    ax: Axes, found: FoundSixBar, drive: float, *, names: bool = False, faint: bool = False
) -> list[Artist]:
    """Draw a six-bar with its driver at an angle; returns what is drawn, but for names.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    found : FoundSixBar
        The six-bar.
    drive : float
        The driver's angle, radians.
    names : bool
        Write their letters beside the joints.
    faint : bool
        Thin lines, for further places of one six-bar.
    """
    at = {name: np.asarray(place) for name, place in found.joints(np.asarray(drive)).items()}
    corners = {**at, "M": found.body(np.asarray(drive)).translation}
    outlines = found.skeleton.corners(found.frames, found.carries)
    plates = [each for each, joints in outlines.items() if len(joints) > 2]
    colours, drawn = iter(PLATES), list[Artist]()
    for plate in plates:
        color = BLUE if plate == found.carries else next(colours)
        patch = Polygon(
            np.array([corners[joint] for joint in outlines[plate]]),
            closed=True,
            facecolor=(*to_rgb(color), 0.03 if faint else 0.18),
            edgecolor=FAINT_INK if faint else color,
            lw=0.6 if faint else 1.8,
            zorder=2.0 if faint else 3.2,
            joinstyle="round",
        )
        drawn.append(ax.add_patch(patch))
    for bar in (each for each in outlines if each not in plates):
        ends = np.array([at[joint] for joint in outlines[bar]])
        ink, width = (FAINT_INK, 0.6) if faint else (BLACK, 2.6)
        (line,) = ax.plot(*ends.T, color=ink, lw=width, zorder=2.1 if faint else 3.4)
        line.set_solid_capstyle("round")
        drawn.append(line)
    if faint:
        return drawn
    every = np.array(list(at.values()))
    size = GROUND * float(np.ptp(every, axis=0).max())
    for pivot in found.skeleton.links[found.skeleton.ground]:
        foot = at[pivot] + size * np.array([[0, 0], [-0.8, -1.4], [0.8, -1.4]])
        patch = Polygon(foot, facecolor="white", edgecolor=GREY, lw=1, zorder=3.0)
        drawn.append(ax.add_patch(patch))
    drawn += ax.plot(*every.T, "o", ms=4.5, mfc="white", mec=BLACK, mew=1.1, ls="", zorder=3.8)
    if names:
        for name, place in at.items():
            label(ax, name, place)
    return drawn


def six_bar_figure(
    found: FoundSixBar, task: Task, pose: int = 0, width: float = 6.4, ax: Axes | None = None
) -> Figure:
    """A six-bar at one of its poses (a number from 0), faintly at the others, with its path.

    width: of the figure, in inches.  ax: axes to draw on, in place of a new figure.
    """
    ax = figure(width, width).add_subplot() if ax is None else ax
    for k, drive in enumerate(found.drive.tolist()):
        if k != pose:
            six_bar(ax, found, drive, faint=True)
    path = found.body(found.along(STEPS)).translation
    ax.plot(*path.T, color=GREY, lw=0.9, ls=(0, (3, 2)), zorder=1.8)
    poses(ax, task.poses)
    six_bar(ax, found, float(found.drive[pose]), names=True)
    ax.set_title(f"{found.id}  {found.skeleton.name}", loc="left", fontsize=10)
    finish(ax, task.length_unit, room=0.04)
    drawn = ax.get_figure(root=True)
    assert drawn is not None
    return drawn
