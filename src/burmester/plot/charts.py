"""Numbers along the motion: the transmission angle over the drive, and the error at each pose."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Annotation
from matplotlib.ticker import MaxNLocator, NullFormatter

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven
from burmester.fourbar.dyad import PR
from burmester.fourbar.instantaneous import transmission_angle
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.functions.found_generator import ROUNDING, FoundGenerator
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.plane import parameters
from burmester.plot.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    VERMILION,
    figure,
    label,
    settle_labels,
    with_unit,
)
from burmester.synthesis.function_generation import FunctionSynthesis

USUAL_MIN_TRANSMISSION_DEG = 40.0  # degrees; below it friction may lock the linkage
ZERO_ERROR = 1e-16  # of the largest error, or of 1: height at which an error of zero is drawn


MOST_CURVES = 4  # linkages in one figure
FAR = 5.0  # times the greatest error of the first; worse linkages are left out


class DrawnTransmission(NamedTuple):
    """The transmission angle as drawn: a line a branch, the used range, the poses, their numbers.

    least: the limit that is drawn across.
    """

    branches: list[Line2D]
    used: Line2D | None
    poses: Line2D | None
    least: Line2D
    labels: list[Annotation]


class DrawnErrors(NamedTuple):
    """Errors as drawn: position on the given axes, angle on axes laid over them, `angle_axes`."""

    position: Line2D
    angle: Line2D
    angle_axes: Axes


def transmission(
    ax: Axes,
    linkage: Linkage,
    *,
    circuit: int = 0,
    driven: Driven | None = None,
    unit: str | None = None,
    samples: int = 721,
) -> DrawnTransmission:
    """The transmission angle over the first dyad's input along a circuit, in degrees.

    The second branch of a circuit is dashed.  A line across marks the usual limit of 40 degrees.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    linkage : Linkage
        Shape (), the driver first.
    circuit : int
        The number of the circuit, 0 or 1.
    driven : Driven, optional
        The verdict for this driver: its circuit is drawn instead, the range that the poses use in a
        thick line, and the poses are marked.
    unit : str, optional
        Unit of lengths, for the axis of a sliding input.
    samples : int
        Points of each branch.

    Raises
    ------
    InputError
        E401 where the first dyad cannot drive.

    Examples
    --------
    >>> from burmester import Displacement, Linkage, plot
    >>> from burmester.fourbar.dyad import RR
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> crank, rocker = RR([0, 0], [0, 0], 1.0), RR([4, 0], [3, 1], 5**0.5)
    >>> four_bar, place = Linkage(crank, rocker), Displacement([0, 1], 0.0)
    >>> len(plot.transmission(ax, four_bar).branches)
    1
    """
    circuit = circuit if driven is None or driven.circuit < 0 else driven.circuit
    own = Circuits.of(linkage, as_given=True)[circuit]
    slides = isinstance(linkage.first, PR)
    turn = 1.0 if slides else 180 / np.pi
    rows = parameters(own, samples)
    met = (
        np.zeros(0, dtype=np.intp)
        if driven is None
        else np.flatnonzero(np.isfinite(driven.parameter))
    )
    if driven is not None and met.size and len(rows) == 1 and bool(own.closed):
        # One turn, with the range of the poses in its middle.
        middle = (driven.parameter[met].min() + driven.parameter[met].max()) / 2
        rows = [rows[0] - np.pi + middle]

    def curve(row: FloatArray, **style: Any) -> Line2D:
        """The angle along parameters of the circuit."""
        places = own.couplers(row)
        drive = turn * _wound(own, row, places, driven, slides)
        angle = np.degrees(transmission_angle(linkage, places))
        (line,) = ax.plot(drive, angle, color=BLUE, **style)
        return line

    lines = [
        curve(
            row,
            ls=(0, (4, 1.6)) if branch else "-",
            lw=1.1,
            zorder=2,
            label=("transmission angle", "the same, other branch")[branch],
        )
        for branch, row in enumerate(rows)
    ]
    used, marks, labels = None, None, list[Annotation]()
    if driven is not None and met.size:
        row = np.linspace(driven.parameter[met].min(), driven.parameter[met].max(), samples)
        used = curve(row, lw=2.8, zorder=3, label="range of the poses")
        at = own.couplers(driven.parameter[met])
        x = turn * (driven.inputs[met] - _turns(driven, slides))
        y = np.degrees(transmission_angle(linkage, at))
        (marks,) = ax.plot(x, y, "o", ms=5, mfc="white", mec=BLACK, mew=1.2, zorder=4)
        labels = [
            label(ax, str(k + 1), (xx, yy), (0.0, 1.0)) for k, xx, yy in zip(met, x, y, strict=True)
        ]
    least = ax.axhline(USUAL_MIN_TRANSMISSION_DEG, color=GREY, lw=0.9, ls=(0, (1, 2)), zorder=1)
    ax.set_ylim(0, 95)
    ax.set_yticks(range(0, 91, 15))
    ax.set_ylabel("transmission angle (deg)")
    ax.set_xlabel(with_unit("drive", unit) if slides else "drive (deg)")
    settle_labels(ax)
    return DrawnTransmission(lines, used, marks, least, labels)


def _wound(
    own: Circuits,
    parameter: FloatArray,
    places: Displacement,
    driven: Driven | None,
    slides: bool,
) -> FloatArray:
    """The drive at places (n,), the turns counted so that it meets the driven range."""
    drive = own.inputs(parameter, places)
    if slides or driven is None or not np.isfinite(driven.inputs).any():
        return drive
    middle = (np.nanmin(driven.inputs) + np.nanmax(driven.inputs)) / 2 - _turns(driven, slides)
    centre = (np.nanmin(drive) + np.nanmax(drive)) / 2
    return np.asarray(drive + 2 * np.pi * np.round((middle - centre) / (2 * np.pi)))


def _turns(driven: Driven, slides: bool) -> float:
    """Whole turns to take off, so that the poses' range begins within the first."""
    if slides:
        return 0.0
    return float(2 * np.pi * np.floor(np.nanmin(driven.inputs) / (2 * np.pi)))


def pose_errors(ax: Axes, error: PoseError, unit: str | None = None) -> DrawnErrors:
    """Position error (filled, left axis) and angle error (hollow, right axis) of each pose.

    Both axes are logarithmic.  An error of zero is drawn at the bottom.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    error : PoseError
        Shape (N,), of a linkage at the poses.
    unit : str, optional
        Unit of lengths, for the label of the axis.

    Examples
    --------
    >>> from burmester import Displacement, PoseError, plot
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> poses = Displacement([[0, 0], [3, 1], [4, 3]], [0.0, 0.5, 1.0])
    >>> places = Displacement([[0, 0.1], [3, 1], [4, 3]], [0.0, 0.5, 1.1])
    >>> drawn = plot.pose_errors(ax, PoseError.at(places, poses))
    >>> drawn.angle_axes.get_yscale()
    'log'
    """
    number = np.arange(1, error.position.shape[-1] + 1)
    other = ax.twinx()
    out = []
    styles: tuple[tuple[Axes, FloatArray, dict[str, Any], float], ...] = (
        (ax, error.position, {"color": BLUE, "marker": "o", "mfc": BLUE}, -0.1),
        (other, np.degrees(error.angle), {"color": VERMILION, "marker": "^", "mfc": "white"}, 0.1),
    )
    for axes, values, style, shift in styles:
        greatest = float(np.nanmax(values)) if np.isfinite(values).any() else 1.0
        shown = np.maximum(values, ZERO_ERROR * (greatest or 1.0))
        (line,) = axes.plot(number + shift, shown, ls="none", ms=6, mew=1.3, zorder=3, **style)
        axes.set_yscale("log")
        finite = shown[np.isfinite(shown)]
        if finite.size:
            # Whole powers of ten, so that each has its number and nothing else has.
            low, high = np.log10(finite.min() / 1.2), np.log10(finite.max() * 1.2)
            axes.set_ylim(10 ** np.floor(low), 10 ** np.ceil(high))
            axes.yaxis.set_minor_formatter(NullFormatter())
        out.append(line)
    ax.set_xlabel("pose")
    ax.xaxis.set_major_locator(MaxNLocator(20, integer=True))
    ax.set_xlim(0.4, len(number) + 0.6)
    ax.set_ylabel(with_unit("position error", unit), color=BLUE)
    other.set_ylabel("angle error (deg)", color=VERMILION)
    out[0].set_label("position")
    out[1].set_label("angle")
    ax.legend(handles=out, loc="lower left", ncols=2, bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)
    ax.grid(axis="x", color="#e3e7eb", lw=0.6, zorder=0)
    return DrawnErrors(out[0], out[1], other)


def structural_error(ax: Axes, found: FoundGenerator, color: str = BLUE) -> list[Line2D]:
    """The error of the output over the input, in degrees: a curve for a function, else points."""
    task = found.task
    inputs = np.degrees(task.compared()[0])
    error = np.degrees(found.range_errors)
    name = f"{found.id}, {found.type}"
    if task.function is None:
        order = np.argsort(inputs)
        lines = ax.plot(inputs[order], error[order], "o-", color=color, lw=0.8, label=name)
    else:
        lines = ax.plot(inputs, error, color=color, lw=1.6, label=name)
        if len(task.inputs) <= 12:
            at = np.degrees(found.errors)
            lines += ax.plot(np.degrees(task.inputs), at, "o", color=color, ms=4)
    return lines


def structural_error_figure(synthesis: FunctionSynthesis) -> Figure:
    """The best linkages of a synthesis, each with its error."""
    task = synthesis.task
    drawing = figure(7.0, 4.2)
    ax = drawing.add_axes((0.12, 0.14, 0.84, 0.72))
    best = (synthesis.usable or synthesis.generators)[:MOST_CURVES]
    chosen = [c for c in best if not c.max_error > FAR * max(best[0].max_error, ROUNDING)]
    for found, color in zip(chosen, (BLUE, VERMILION, GREEN, GREY), strict=False):
        structural_error(ax, found, color)
    ax.axhline(0.0, color=BLACK, lw=0.6)
    ax.set_xlabel("input (deg)")
    ax.set_ylabel("structural error of the output (deg)")
    ax.grid(True, lw=0.4, alpha=0.5)
    name = task.function.text if task.function else f"{len(task.inputs)} pairs of angles"
    ax.set_title(f"{name}: the output less what is asked for", loc="left", pad=22)
    if chosen:
        ax.legend(
            loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, frameon=False, fontsize="small"
        )
    return drawing
