"""The walk through a pencil: from the eigen-quadrics to the constraint manifolds, as an animation.

Two quadrics p(theta) = cos(theta) v1 + sin(theta) v2 leave v1 and v2 and turn in the pencil until
they are the manifolds of two dyads.  The curve that they share stays where it is.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from io import BytesIO

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image

from burmester.geometry.displacement import Displacement
from burmester.io.files import write
from burmester.numerics.arrays import FloatArray
from burmester.plot.camera import Box, Camera
from burmester.plot.space import image_space
from burmester.plot.style import figure, house_style

PALETTE_SIZE = 256  # colours of a GIF


def steps(start: ArrayLike, end: ArrayLike, count: int = 40, hold: int = 10) -> FloatArray:
    """Angles of a walk through a pencil: slow at both ends, with a pause there.

    Parameters
    ----------
    start, end : (k,) array_like
        Angles of the quadrics, radians.
    count : int
        Steps from start to end.
    hold : int
        Steps of the pause: half as many at the start, all at the end.

    Returns
    -------
    (n, k) array
        Angles of each step, radians.

    Examples
    --------
    >>> from burmester import plot
    >>> plot.steps([0.0], [1.0], count=3, hold=2).round(3).ravel().tolist()
    [0.0, 0.0, 0.5, 1.0, 1.0, 1.0]
    """
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    share = (1 - np.cos(np.linspace(0, np.pi, count))) / 2
    share = np.concatenate([np.zeros(hold // 2), share, np.ones(hold)])
    return np.asarray(a + share[:, None] * (b - a))


def walk(
    basis: ArrayLike,
    theta: ArrayLike,
    *,
    poses: Displacement | None = None,
    box: Box | None = None,
    camera: Camera | None = None,
    curve: list[FloatArray] | None = None,
    size: tuple[int, int] = (640, 560),
    unit: str | None = None,
) -> Iterator[NDArray[np.uint8]]:
    """Pictures of the quadrics at angles theta of a pencil.

    Parameters
    ----------
    basis : (2, 8) array_like
        The singular vectors v1 and v2.
    theta : (n, k) array_like
        Angles of the k quadrics in each picture, radians.
    poses, box, camera, curve, unit
        As in `image_space`.
    size : (int, int)
        Columns and rows of a picture.

    Returns
    -------
    iterator of (rows, columns, 3) array
        One picture for each row of theta.

    Examples
    --------
    >>> from burmester import fit_pencil, plot, read_task
    >>> v = fit_pencil(read_task("case:ge2012-exact").poses).vectors[:2]
    >>> picture = next(plot.walk(v, [[0.0, 1.5]], size=(64, 56)))
    >>> picture.shape
    (56, 64, 3)
    """
    v, angles = np.asarray(basis, dtype=np.float64), np.asarray(theta, dtype=np.float64)
    last: tuple[FloatArray, NDArray[np.uint8]] | None = None
    with house_style():
        drawing = figure(size[0] / 100, size[1] / 100, 100)
        ax = drawing.add_axes((0.0, 0.0, 1.0, 0.96))
        for row in angles:
            if last is None or not np.array_equal(last[0], row):
                ax.clear()
                names = [f"θ = {np.degrees(t):.1f}°".replace("-", "−") for t in row]
                p = np.cos(row)[:, None] * v[0] + np.sin(row)[:, None] * v[1]
                image_space(
                    ax,
                    p,
                    poses=poses,
                    box=box,
                    camera=camera,
                    curve=curve,
                    names=names,
                    unit=unit,
                    numbers=False,
                )
                drawing.canvas.draw()
                picture = np.asarray(drawing.canvas.buffer_rgba())[..., :3]  # type: ignore[attr-defined]
                last = row, picture.copy()
            yield last[1]


def write_gif(
    path: str | os.PathLike[str],
    pictures: Iterable[NDArray[np.uint8]],
    *,
    seconds: float = 0.08,
    force: bool = False,
) -> None:
    """Write pictures as an endless GIF; equal pictures in a row are joined.

    Parameters
    ----------
    path : str or path
        The file.
    pictures : iterable of (rows, columns, 3) array
        Bytes of red, green and blue.
    seconds : float
        Duration of each picture.
    force : bool
        Replace a file that exists.

    Raises
    ------
    InputError
        E140 (the file exists) and E141 (it cannot be written).

    Examples
    --------
    >>> import numpy as np
    >>> from burmester import plot
    >>> pictures = [np.full((8, 8, 3), grey, dtype=np.uint8) for grey in (0, 255)]
    >>> plot.write_gif("blink.gif", pictures)  # doctest: +SKIP
    """
    kept, times = list[NDArray[np.uint8]](), list[int]()
    for picture in pictures:
        if kept and np.array_equal(kept[-1], picture):
            times[-1] += round(1000 * seconds)
        else:
            kept.append(picture)
            times.append(round(1000 * seconds))
    # One palette, so that nothing flickers, and paper stays white.
    # Every other pixel tells the colours in a quarter of the time, in which nothing can stop it.
    some = np.concatenate([kept[k][::2, ::2] for k in (0, len(kept) // 2, -1)])
    palette = Image.fromarray(some).quantize(PALETTE_SIZE - 1, kmeans=2)
    colours = [*(palette.getpalette() or [])[: 3 * (PALETTE_SIZE - 1)], 255, 255, 255]
    frames = []
    for each in kept:
        index = np.array(Image.fromarray(each).quantize(palette=palette, dither=Image.Dither.NONE))
        index[(each == 255).all(axis=-1)] = len(colours) // 3 - 1
        frame = Image.fromarray(index)
        frame.putpalette(colours)
        frames.append(frame)
    file = BytesIO()
    frames[0].save(
        file, "GIF", save_all=True, append_images=frames[1:], duration=times, loop=0, disposal=1
    )
    write(path, file.getvalue(), force=force)
