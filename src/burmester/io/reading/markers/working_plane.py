"""The plane in which markers move: two of their axes, or the plane nearest to their motion."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.pose_table import Source, shown
from burmester.numerics.arrays import FloatArray
from burmester.wording import listed

NEAREST = "fit"  # the value of --plane that asks for the nearest plane
MAX_FLATNESS = 0.05  # of an axis' rms deviation to the largest; below it the axis is passed over


class PlanarPoints(NamedTuple):
    """Points in a plane, and what was done to have them there."""

    points: FloatArray  # (N, K, 2)
    sentence: str  # what was passed over, with figures; empty if nothing was


def planar_points(
    points: FloatArray, axes: tuple[str, ...], plane: str | None, unit: str, where: str
) -> PlanarPoints:
    """Points (N, K, A) along A axes as points in a plane.

    plane: two letters, the axes that become x and y, or `NEAREST`; None passes over the one axis
    along which the markers hardly move.  unit: with a blank before it, or empty.
    Raises E113 where that is not one axis, and for a plane that the axes do not have.
    """
    deviation = points - points.mean(axis=0)
    size = np.sqrt((deviation**2).mean(axis=(0, 1)))
    figures = [f"{axis} by {value:.2g}{unit}" for axis, value in zip(axes, size, strict=True)]
    if plane is None and len(axes) == 2:
        return PlanarPoints(points, "")
    if plane is None:
        flat = size <= MAX_FLATNESS * size.max()
        if flat.sum() != 1:
            raise _no_plane(deviation, figures, int(flat.sum()), where)
        kept = [i for i in range(3) if not flat[i]]
        return PlanarPoints(points[..., kept], _passed_over(axes, figures, kept))
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
    return PlanarPoints(points[..., kept], sentence)


def _passed_over(axes: tuple[str, ...], figures: list[str], kept: list[int]) -> str:
    """Which of three axes is passed over, and how far markers move along each."""
    (rest,) = {0, 1, 2} - set(kept)
    own = figures[rest].removeprefix(f"{axes[rest]} ")
    others = listed([figures[i] for i in kept])
    return f"{axes[rest]} is passed over: it varies {own} (rms), {others}"


def _nearest_plane(
    points: FloatArray, deviation: FloatArray, axes: tuple[str, ...], unit: str
) -> PlanarPoints:
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
    return PlanarPoints(points @ np.stack([x, y], axis=1), sentence)


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
