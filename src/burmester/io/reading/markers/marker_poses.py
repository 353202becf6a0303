"""A recording of markers as poses: in a plane, without the frames in which a marker is missing.

The plane is two of their axes, or the one nearest to their motion.  What is passed over and left
out is counted and said, and how rigid the markers are.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Advice, InputError
from burmester.io.reading.markers.marker_header import MarkerHeader
from burmester.io.reading.markers.marker_recording import MarkerRecording
from burmester.io.reading.markers.tracked_points import MAX_DISTANCE_CHANGE, fit_rigid_body
from burmester.io.reading.pose_table import (
    PoseTable,
    Rows,
    Source,
    extent,
    resolution_by_digits,
    shown,
)
from burmester.numerics.arrays import FloatArray
from burmester.wording import listed, shortened

MAX_LISTED = 12  # ranges of frames that a message lists
MIN_TRIPLES = 20  # of frames one after the other, to tell noise from slow changes of a shape
NOISE_RATIO = 2.0  # of a shape's changes to its noise from frame to frame; above it is no noise
MIN_CHANGE = 0.01  # of the body's size; lesser changes of its shape are not mentioned
NEAREST = "fit"  # the value of --plane that asks for the nearest plane
MAX_FLATNESS = 0.05  # of an axis' rms deviation to the largest; below it the axis is passed over


def recorded_poses(
    recording: MarkerRecording,
    selected: NDArray[np.bool_],
    usable: NDArray[np.bool_],
    plane: str | None,
) -> tuple[PoseTable, NDArray[np.intp]]:
    """The selected frames in which no marker is missing as a table, and their numbers from 0.

    usable: the frames by which the plane and the noise are judged, also those between the
    selected ones.  Raises E102, E108 and E113.
    """
    header = recording.header
    unit = _unit(header)
    behind = f" {unit}" if unit else ""
    seen = np.isfinite(recording.places).all(axis=(1, 2))
    kept, base = np.flatnonzero(selected & seen), np.flatnonzero(usable & seen)
    if not len(kept):
        message = f"no frame has {listed(recording.names)} together"
        help = "choose markers that are seen together with --points, or other frames with --from"
        raise InputError("E102", f"no poses: {message}", where=header.where, help=help)
    planar, sentence = planar_points(
        recording.places[base], recording.axes, plane, behind, header.where
    )
    flat = np.full((*recording.places.shape[:2], 2), np.nan)
    flat[base] = planar
    points = flat[kept]
    sentences = [sentence] if sentence else []
    sentences += _left_out(recording, selected & ~seen)
    rigid, warning, sigma = _rigidity(recording, flat, base, behind)
    sentences += rigid
    if unit == "px":
        sentences.append("y is taken as it stands; in pictures it counts downwards")
    who = listed(recording.names)
    message = f"{len(kept)} poses are those of the markers {who}"
    if recording.chosen:
        message = f"{message}, the only two of this file"
    help = "name other markers with --points, other frames with --from, --to and --drop"
    if len(recording.axes) > 2:
        help = f"{help}, another plane with --plane"
    own = Advice("W213", message, help, "; ".join(sentences) or None)
    notes = (*header.source.notes, own, *warning)
    rows = Rows(points.reshape(len(points), -1), (recording.decimals, 0.0), [], [], points.shape[1])
    table = PoseTable(
        rows,
        length_unit=unit,
        angle_unit=None,
        where=header.where,
        say_unit="",
        pose_sigma=sigma,
        locate_row=recording.locate_row,
        notes=notes,
    )
    return table, kept


def _unit(header: MarkerHeader) -> str | None:
    """The unit of lengths; raises E108 for two of them."""
    if len(header.units) > 1:
        message = f"two units of lengths: {listed(header.units)}"
        help = "export all markers in one unit"
        raise InputError("E108", message, where=header.where, help=help)
    return header.units[0] if header.units else None


def _left_out(recording: MarkerRecording, missing: NDArray[np.bool_]) -> list[str]:
    """How many frames are left out, which and why."""
    if not missing.any():
        return []
    rows = np.flatnonzero(missing)
    breaks = np.flatnonzero(np.diff(rows) > 1)
    ranges = zip(rows[[0, *(breaks + 1)]], rows[[*breaks, -1]], strict=True)
    name = recording.row_name
    texts = [name(a) if a == b else f"{name(a)} to {name(b)}" for a, b in ranges]
    count = len(rows)
    what = "frame is" if count == 1 else "frames are"
    why = [reason for reason, frames in recording.reasons.items() if (frames & missing).any()]
    return [
        f"{count} {what} left out, where a marker {listed(why, 'or')}: "
        f"{listed(shortened(texts, MAX_LISTED, 'other ranges'))}"
    ]


def _rigidity(
    recording: MarkerRecording, flat: FloatArray, base: NDArray[np.intp], unit: str
) -> tuple[list[str], list[Advice], tuple[float, float] | None]:
    """How rigid the markers are, a warning where they are not, and the noise where it shows."""
    names = listed(recording.names)
    fit = fit_rigid_body(flat[base])
    size = float(np.hypot(*fit.shape.T).max())
    off = np.sqrt((fit.residuals**2).sum(axis=2)).max(axis=1)
    if size > 0 and (sound := off <= 0.5 * MAX_DISTANCE_CHANGE * size).any() and not sound.all():
        base = base[sound]  # frames that are refused where they are selected
        fit = fit_rigid_body(flat[base])
    if len(base) < 3 or not size:
        return [], [], None
    if len(recording.names) == 2:
        rms = 2 * fit.rms  # of the distance: each point takes half of its change
        sentence = f"they are {size:.4g}{unit} apart, give or take {rms:.2g}{unit} (rms)"
    else:
        rms = fit.rms
        sentence = f"as a rigid body they are off by {rms:.2g}{unit} (rms)"
    series = np.full((len(flat), *fit.residuals.shape[1:]), np.nan)
    series[base] = fit.residuals
    jumps = series[2:] - 2 * series[1:-1] + series[:-2]
    jumps = jumps[np.isfinite(jumps).all(axis=(1, 2))]
    warning = []
    half_digit = resolution_by_digits(0.5 * 10.0**-recording.decimals, extent(flat[base, 0]))
    if len(jumps) >= MIN_TRIPLES and rms > max(MIN_CHANGE * size, 4 * half_digit):
        noise = float(np.sqrt((jumps**2).sum(axis=2).mean() / 6))
        if fit.rms > NOISE_RATIO * noise:
            apart = rms / fit.rms * noise
            warning.append(
                Advice(
                    "W214",
                    f"{names} move against each other: they are not on one rigid body, or not in "
                    "one plane",
                    "choose markers of one body with --points, or another plane with --plane",
                    f"they change by {rms:.2g}{unit} (rms), {100 * rms / size:.2g} % of "
                    f"{size:.4g}{unit}; of that {apart:.2g}{unit} is noise from frame to frame",
                )
            )
    if 2 * half_digit >= fit.noise:
        return [sentence], warning, None
    two = len(recording.names) == 2  # the origin is the first marker as it was seen
    return [sentence], warning, (fit.noise, fit.sigma[1]) if two else fit.sigma


def planar_points(
    points: FloatArray, axes: tuple[str, ...], plane: str | None, unit: str, where: str
) -> tuple[FloatArray, str]:
    """Points (N, K, A) along A axes as points in a plane, and what was passed over, with figures.

    plane: two letters, the axes that become x and y, or `NEAREST`; None passes over the one axis
    along which the markers hardly move.  unit: with a blank before it, or empty.
    Raises E113 where that is not one axis, and for a plane that the axes do not have.
    """
    deviation = points - points.mean(axis=0)
    size = np.sqrt((deviation**2).mean(axis=(0, 1)))
    figures = [f"{axis} by {value:.2g}{unit}" for axis, value in zip(axes, size, strict=True)]
    if plane is None and len(axes) == 2:
        return points, ""
    if plane is None:
        flat = size <= MAX_FLATNESS * size.max()
        if flat.sum() != 1:
            raise _no_plane(deviation, figures, int(flat.sum()), where)
        kept = [i for i in range(3) if not flat[i]]
        return points[..., kept], _passed_over(axes, figures, kept)
    if plane.lower() == NEAREST and len(axes) == 3:
        return _nearest_plane(points, deviation, axes, unit)
    letters = plane.upper()
    if len(letters) != 2 or len(set(letters)) != 2 or not set(letters) <= set(axes):
        message = f"there is no plane {shown(plane)} in this file"
        raise InputError(
            "E113",
            message,
            where=Source("--plane", plane).where(0, len(plane)),
            why=f"its markers have the axes {listed(axes)}",
            help=f"name two of them, the first for x: --plane {axes[0]}{axes[1]}",
        )
    kept = [axes.index(letter) for letter in letters]
    sentence = _passed_over(axes, figures, kept) if len(axes) > 2 else ""
    return points[..., kept], sentence


def _passed_over(axes: tuple[str, ...], figures: list[str], kept: list[int]) -> str:
    """Which of three axes is passed over, and how far markers move along each."""
    (rest,) = {0, 1, 2} - set(kept)
    own = figures[rest].removeprefix(f"{axes[rest]} ")
    others = listed([figures[i] for i in kept])
    return f"{axes[rest]} is passed over: it varies {own} (rms), {others}"


def _nearest_plane(
    points: FloatArray, deviation: FloatArray, axes: tuple[str, ...], unit: str
) -> tuple[FloatArray, str]:
    """Points in the plane that is nearest to all deviations from the markers' means."""
    normal, out = _normal(deviation)
    main = int(np.abs(normal).argmax())
    first, second = (i for i in range(3) if i != main)
    x = np.eye(3)[first] - normal[first] * normal
    x /= np.linalg.norm(x)
    y = np.cross(normal, x)
    y *= np.sign(y[second])
    tilt = np.degrees(np.arccos(min(1.0, float(abs(normal[main])))))
    sentence = (
        f"the markers are projected onto the nearest plane, {tilt:.2g}° off that of "
        f"{axes[first]} and {axes[second]}; they leave it by {out:.2g}{unit} (rms)"
    )
    return points @ np.stack([x, y], axis=1), sentence


def _normal(deviation: FloatArray) -> tuple[FloatArray, float]:
    """The direction in which deviations are least, and their root mean square along it."""
    rows = deviation.reshape(-1, 3)
    values, vectors = np.linalg.eigh(rows.T @ rows / max(len(rows), 1))
    return vectors[:, 0], float(np.sqrt(max(values[0], 0.0)))


def _no_plane(deviation: FloatArray, figures: list[str], still: int, where: str) -> InputError:
    """E113, where the file does not show which axis to pass over; still: how many do not move."""
    _, out = _normal(deviation)
    size = float(np.sqrt((deviation**2).mean(axis=(0, 1))).max())
    message = "the markers move along all three axes, and a planar linkage needs two"
    help = "choose the plane: pass --plane XY, --plane YZ or --plane XZ"
    if size and out <= MAX_FLATNESS * size:
        help = (
            f"pass --plane {NEAREST} to project them onto the plane nearest to their motion, or "
            "choose two axes: --plane XY, --plane YZ or --plane XZ"
        )
    if still > 1:
        message = "the markers move along one axis only, so that their plane is not known"
    return InputError(
        "E113", message, where=where, why=f"they move along {listed(figures)} (rms)", help=help
    )
