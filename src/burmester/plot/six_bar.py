"""A six-bar at a place of its driver, and the whole picture of one at its poses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Polygon

from burmester.numerics.arrays import FloatArray
from burmester.plot.plane import poses
from burmester.plot.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    figure,
    finish,
    label,
)
from burmester.sixbar.found import FoundSixBar
from burmester.tasks.motion_task import Task

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["limits_of", "six_bar", "six_bar_figure"]

# The links of three joints, and the body, each with its colour; the body ends at its origin.
PLATES = {"CDE": ORANGE, "BDG": GREEN, "EH": BLUE}
BARS = ("AC", "GH")
FAINT_INK = "#aab3bd"
GROUND = 0.035  # of the size of the picture: the triangle at a pivot on the ground
STEPS = 201  # places along the path of the body's origin


def six_bar(
    ax: Axes, found: FoundSixBar, drive: float, *, names: bool = False, faint: bool = False
) -> None:
    """Draw a six-bar with its driver at an angle.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    found : FoundSixBar
        The six-bar.
    drive : float
        The driver's angle, radians.
    names : bool
        Write A to H beside the joints.
    faint : bool
        Thin lines, for further places of one six-bar.
    """
    at = {name: np.asarray(place) for name, place in found.joints(np.asarray(drive)).items()}
    origin = found.body(np.asarray(drive)).translation
    for plate, color in PLATES.items():
        corners = [at[joint] for joint in plate] + ([origin] if plate == "EH" else [])
        ax.add_patch(
            Polygon(
                np.array(corners),
                closed=True,
                facecolor=(*to_rgb(color), 0.03 if faint else 0.18),
                edgecolor=FAINT_INK if faint else color,
                lw=0.6 if faint else 1.8,
                zorder=2.0 if faint else 3.2,
                joinstyle="round",
            )
        )
    for bar in BARS:
        ends = np.array([at[joint] for joint in bar])
        ink, width = (FAINT_INK, 0.6) if faint else (BLACK, 2.6)
        ax.plot(*ends.T, color=ink, lw=width, zorder=2.1 if faint else 3.4, solid_capstyle="round")
    if faint:
        return
    every = np.array(list(at.values()))
    size = GROUND * float(np.ptp(every, axis=0).max())
    for pivot in (at["A"], at["B"]):
        foot = pivot + size * np.array([[0, 0], [-0.8, -1.4], [0.8, -1.4]])
        ax.add_patch(Polygon(foot, facecolor="white", edgecolor=GREY, lw=1, zorder=3.0))
    ax.plot(*every.T, "o", ms=4.5, mfc="white", mec=BLACK, mew=1.1, ls="", zorder=3.8)
    if names:
        for name, place in at.items():
            label(ax, name, place)


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
    ax.set_title(f"{found.id}  six-bar, Watt I", loc="left", fontsize=10)
    finish(ax, task.length_unit, room=0.04)
    drawn = ax.get_figure(root=True)
    assert drawn is not None
    return drawn


def limits_of(found: FoundSixBar, drives: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The lower left and upper right corners (2,) of the box around all joints at drives (n,)."""
    joints = np.concatenate([*found.joints(drives).values(), found.body(drives).translation])
    return joints.min(axis=0), joints.max(axis=0)
