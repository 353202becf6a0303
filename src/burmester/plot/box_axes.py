"""The box around a piece of the image space: its edges, a grid behind, numbers and names."""

from __future__ import annotations

from itertools import product

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator

from burmester.numerics.arrays import FloatArray
from burmester.plot.camera import Box, Camera
from burmester.plot.style import BLACK, GREY, with_unit

NUMBER, NAME = 11.0, 27.0  # points from the box to the numbers and names beside it


def box_axes(ax: Axes, box: Box, camera: Camera, unit: str | None) -> list[Artist]:
    """The box: its edges, a grid on the sides behind, numbers and names along three edges."""
    half, out = box.half, list[Artist]()
    # A side faces the eye if the eye is beyond it.
    facing = {(i, s): bool(s * camera.eye[i] > half[i]) for i in range(3) for s in (-1, 1)}

    def flat(*points: FloatArray) -> FloatArray:
        return camera.project(np.stack(points))[:, :2]

    def line(a: FloatArray, b: FloatArray, **style: object) -> None:
        out.extend(ax.plot(*flat(a, b).T, **style))  # type: ignore[arg-type]

    middle = camera.project(np.zeros((1, 3)))[0, :2]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        values = np.array(MaxNLocator(5, steps=[1, 2, 5, 10]).tick_values(box.low[i], box.high[i]))
        values = values[(values >= box.low[i]) & (values <= box.high[i])]
        step = (values - (box.low[i] + box.high[i]) / 2) * box.scale[i]
        outline = []
        for sj, sk in product((-1, 1), repeat=2):
            end = np.zeros((2, 3))
            end[:, i], end[:, j], end[:, k] = [-half[i], half[i]], sj * half[j], sk * half[k]
            front = facing[j, sj] + facing[k, sk]
            style = {"color": GREY, "lw": 0.6, "zorder": 3 if front == 2 else 1}
            line(end[0], end[1], **style)
            if front == 1:
                outline.append(end)
        for a, sa, b in ((j, -1, k), (j, 1, k), (k, -1, j), (k, 1, j)):
            if facing[a, sa]:
                continue
            for at in step:
                ends = np.zeros((2, 3))
                ends[:, i], ends[:, a], ends[:, b] = at, sa * half[a], [-half[b], half[b]]
                line(ends[0], ends[1], color="#d5dae0", lw=0.5, zorder=0)
        if not outline:  # seen end on
            continue
        # Numbers stand along an edge of the outline: the lowest, or for Z3 the leftmost.
        by = [flat(*end).mean(axis=0)[0 if i == 2 else 1] for end in outline]
        edge = outline[int(np.argmin(by))]
        ends = flat(*edge)
        along = (ends[1] - ends[0]) / np.hypot(*(ends[1] - ends[0]))
        normal = np.array([-along[1], along[0]])
        normal *= np.sign(normal @ (ends.mean(axis=0) - middle))
        size = max(np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim()))
        power = _power(values)
        values = values / 10.0**power
        digits = max(0, -int(np.floor(np.log10(np.diff(values)[0])))) if len(values) > 1 else 1
        for value, at in zip(values, step, strict=True):
            point = edge[0].copy()
            point[i] = at
            foot = flat(point)[0]
            tick = np.stack([foot, foot + 0.012 * size * normal])
            out.extend(ax.plot(*tick.T, color=BLACK, lw=0.7, zorder=3))
            out.append(
                _text(
                    ax,
                    f"{value:.{digits}f}".replace("-", "\N{MINUS SIGN}"),
                    foot,
                    NUMBER * normal,
                    fontsize=7,
                )
            )
        turn = np.degrees(np.arctan2(along[1], along[0]))
        turn = (turn + 60) % 180 - 60  # a name along a steep edge is read upwards
        unit_here = None if i == 2 else unit
        if power:
            unit_here = f"$10^{{{power}}}$ {unit_here or ''}".strip()
        name = with_unit(f"$Z_{i + 1}\\,/\\,Z_4$", unit_here)
        out.append(
            _text(ax, name, ends.mean(axis=0), NAME * normal, fontsize=9, rotation=float(turn))
        )
    return out


def _power(values: FloatArray) -> int:
    """The power of ten that numbers are better written without; 0 for ordinary ones."""
    greatest = float(np.abs(values).max(initial=0.0))
    power = int(np.floor(np.log10(greatest))) if greatest > 0 else 0
    return 0 if -3 <= power <= 3 else power


def _text(ax: Axes, text: str, at: FloatArray, away: FloatArray, **style: object) -> Text:
    """A number or a name beside the box, so many points away from a place on its edge."""
    return ax.annotate(
        text,
        (float(at[0]), float(at[1])),
        xytext=(float(away[0]), float(away[1])),
        textcoords="offset points",
        ha="center",
        va="center",
        color=BLACK,
        zorder=3,
        annotation_clip=False,
        **style,  # type: ignore[arg-type]
    )
