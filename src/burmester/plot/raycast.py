"""Quadrics as pictures: the ray of every pixel meets each quadric where a quadratic says so.

No mesh: a ray eye + t d meets the form u . A u, u = (point, 1), at the roots of

    (d . A d) t² + 2 (d . A e) t + e . A e = 0,                e = (eye, 1), d = (direction, 0),

both of them, exactly.  What lies outside the box is cut away, what is left is laid over each other
in its order along the ray.  Where the picture changes from one pixel to the next, more rays are
cast.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray, take
from burmester.plot.camera import Camera

BLOCK = 1 << 13  # rays at a time, so that their data stay in the cache
EDGE_SAMPLES = 3  # rays along each side of a pixel on an edge
LIGHT_DIRECTION = np.array([-0.45, 0.55, -0.70])  # towards the light: right, up, ahead
AMBIENT, DIFFUSE, SHINE = 0.40, 0.62, 0.22
RING, EDGE = 1.3, 1.6  # width of lines on surfaces, in pixels
MAX_GRAZING_THICKNESS = 4.0  # times the surface's thickness, for a grazing ray


@final
@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A quadric as it is to look.

    form: (4, 4), see `Box.forms`.  colour: (3,), from 0 to 1.  opacity: where it is seen from
    straight ahead.  rings: how far apart its lines of equal height are, and where one of them is;
    no lines for 0.
    """

    form: FloatArray
    colour: FloatArray
    opacity: float = 0.62
    rings: tuple[float, float] = (0.0, 0.0)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """Surfaces in a box (half: half of its sides, (3,)) before a camera."""

    camera: Camera
    half: FloatArray
    surfaces: tuple[Surface, ...]


class _Hit(NamedTuple):
    """Where rays (n,) meet a surface: directions and gradients, three (n,) each, d . g and t."""

    d: tuple[FloatArray, ...]
    g: tuple[FloatArray, ...]
    toward: FloatArray
    t: FloatArray


class Extent(NamedTuple):
    """The piece of the picture's plane that is drawn."""

    left: float
    right: float
    bottom: float
    top: float


def cast(
    camera: Camera, forms: FloatArray, half: FloatArray, x: FloatArray, y: FloatArray
) -> FloatArray:
    """Where the rays of picture points (n,) meet forms (k, 4, 4) in a box: t (2 k, n).

    half: (3,), half of the box's sides.  The roots of one form are neighbours, the nearer first;
    infinite where there is none in the box.
    """
    near, far = _box(camera, half, x, y)
    t = np.empty((2 * len(forms), x.size))
    for k, form in enumerate(forms):
        t[2 * k : 2 * k + 2] = _roots(camera, form, x, y)
    t[~((t >= near) & (t <= far))] = np.inf
    return t


def _roots(camera: Camera, form: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Both roots (2, n), ascending; nan where they are not real."""
    basis = np.stack([camera.ahead, camera.right, camera.up])
    square = basis @ form[:3, :3] @ basis.T
    at_eye = form[:3] @ np.append(camera.eye, 1.0)
    b0, b1, b2 = basis @ at_eye
    c = float(np.append(camera.eye, 1.0) @ form @ np.append(camera.eye, 1.0))
    a = square[0, 0] + x * (2 * square[0, 1] + square[1, 1] * x)
    a += y * (2 * square[0, 2] + 2 * square[1, 2] * x + square[2, 2] * y)
    b = b0 + b1 * x + b2 * y
    with np.errstate(invalid="ignore", divide="ignore"):
        # In this form nothing cancels, and a ray along a generator has one root at infinity.
        q = -(b + np.copysign(np.sqrt(b * b - a * c), b))
        one, two = q / a, c / q
        return np.stack([np.minimum(one, two), np.maximum(one, two)])


def _box(
    camera: Camera, half: FloatArray, x: FloatArray, y: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Between which t (n,) the rays are inside the box."""
    near, far = np.zeros_like(x), np.full_like(x, np.inf)
    for axis in range(3):
        d = camera.ahead[axis] + x * camera.right[axis] + y * camera.up[axis]
        with np.errstate(divide="ignore", invalid="ignore"):
            one = (-half[axis] - camera.eye[axis]) / d
            two = (half[axis] - camera.eye[axis]) / d
        near = np.fmax(near, np.fmin(one, two))
        far = np.fmin(far, np.fmax(one, two))
    return near, far


def render(scene: Scene, extent: Extent, size: tuple[int, int]) -> NDArray[np.uint8]:
    """The picture (rows, columns, 4) of a scene, RGBA, its first row at the top.

    size: columns and rows.  Clear where nothing is.
    """
    columns, rows = size
    width, height = (extent.right - extent.left) / columns, (extent.top - extent.bottom) / rows
    x = extent.left + (np.arange(columns) + 0.5) * width
    y = extent.top - (np.arange(rows) + 0.5) * height
    picture = np.zeros((rows * columns, 4), dtype=np.uint8)
    code = np.zeros(rows * columns, dtype=np.int16)
    step = max(1, BLOCK // columns)
    for start in range(0, rows, step):
        own_y = y[start : start + step]
        own = slice(start * columns, (start + own_y.size) * columns)
        xs, ys = np.tile(x, own_y.size), np.repeat(own_y, columns)
        code[own], some, colour = _shade(scene, width, xs, ys)
        picture[start * columns + some] = _bytes(colour)
    edges = np.flatnonzero(_changes(code.reshape(rows, columns)))
    inner = (np.arange(EDGE_SAMPLES) + 0.5) / EDGE_SAMPLES - 0.5
    dx, dy = (grid.ravel() for grid in np.meshgrid(inner * width, inner * height))
    many = max(1, BLOCK // EDGE_SAMPLES**2)
    for start in range(0, edges.size, many):
        some = edges[start : start + many]
        xs = (x[some % columns][:, None] + dx).ravel()
        ys = (y[some // columns][:, None] + dy).ravel()
        fine = np.zeros((xs.size, 4))
        _, met, colour = _shade(scene, width, xs, ys)
        fine[met] = colour
        picture[some] = _bytes(fine.reshape(some.size, -1, 4).mean(axis=1))
    return picture.reshape(rows, columns, 4)


def _bytes(colour: FloatArray) -> NDArray[np.uint8]:
    """Colours (n, 4) whose alpha is multiplied in, as bytes with the alpha beside."""
    out = colour * 255.0
    out[:, :3] /= np.maximum(colour[:, 3:], 1e-9)
    out += 0.5
    return out.astype(np.uint8)


def _changes(code: NDArray[np.int16]) -> NDArray[np.bool_]:
    """Pixels that differ from one beside, above or below them."""
    edge = np.zeros(code.shape, dtype=bool)
    down, right = code[1:] != code[:-1], code[:, 1:] != code[:, :-1]
    edge[1:] |= down
    edge[:-1] |= down
    edge[:, 1:] |= right
    edge[:, :-1] |= right
    return edge


def _shade(
    scene: Scene, pixel: float, x: FloatArray, y: FloatArray
) -> tuple[NDArray[np.int16], NDArray[np.intp], FloatArray]:
    """What each of n rays meets; which meet anything, (m,); their premultiplied colours (m, 4)."""
    t = cast(scene.camera, np.stack([s.form for s in scene.surfaces]), scene.half, x, y)
    met = np.isfinite(t)
    code = met.T @ (1 << np.arange(len(t))).astype(np.int16)
    some = np.flatnonzero(code)
    if not some.size:
        return code, some, np.zeros((0, 4))
    t, met, x, y = t[:, some], met[:, some], x[some], y[some]
    paint = np.zeros((len(t), some.size, 4))
    for k, surface in enumerate(scene.surfaces):
        for root in (2 * k, 2 * k + 1):
            here = np.flatnonzero(met[root])
            if here.size:
                rays = np.stack([x[here], y[here], t[root, here]])
                paint[root, here] = _paint(scene, surface, pixel, rays)
    order = np.argsort(t, axis=0)
    code[some] += (order[0] // 2 << 2 * len(scene.surfaces)).astype(np.int16)
    ray = np.arange(some.size)
    through = np.ones(some.size)
    total = np.zeros((some.size, 4))
    for layer in order:
        part = paint[layer, ray]
        total += through[:, None] * part
        through *= 1 - part[:, 3]
    return code, some, total


def _paint(scene: Scene, surface: Surface, pixel: float, rays: FloatArray) -> FloatArray:
    """The colour (n, 4), alpha multiplied in, of one surface that rays (x, y, t), (3, n), meet."""
    right, up, ahead = scene.camera.right, scene.camera.up, scene.camera.ahead
    x, y, t = rays
    d = [ahead[i] + x * right[i] + y * up[i] for i in range(3)]
    p = [scene.camera.eye[i] + t * d[i] for i in range(3)]
    a = surface.form
    g = [a[i, 0] * p[0] + a[i, 1] * p[1] + a[i, 2] * p[2] + a[i, 3] for i in range(3)]
    size = np.sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])
    size = np.where(size > 0, size, 1.0)
    far = np.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
    toward = g[0] * d[0] + g[1] * d[1] + g[2] * d[2]
    hit = _Hit(tuple(d), tuple(g), toward, t)
    cosine = np.abs(toward) / (size * far)
    side = -np.sign(toward) / size  # the normal turned to the eye
    forward = ahead / np.sqrt(ahead @ ahead)
    light = LIGHT_DIRECTION[0] * right + LIGHT_DIRECTION[1] * up + LIGHT_DIRECTION[2] * forward
    light /= np.sqrt(light @ light)
    lit = side * (g[0] * light[0] + g[1] * light[1] + g[2] * light[2])
    between = light - forward
    between /= np.sqrt(between @ between)
    shine = side * (g[0] * between[0] + g[1] * between[1] + g[2] * between[2])
    shine = np.maximum(shine, 0.0) ** 2
    shine *= shine
    shine *= shine  # to the power of 8
    shine *= SHINE * shine * shine
    value = (AMBIENT + DIFFUSE * (0.5 + 0.5 * lit)) * (0.72 + 0.28 * cosine)
    clear = (1 - surface.opacity) ** np.minimum(1 / np.maximum(cosine, 1e-9), MAX_GRAZING_THICKNESS)
    alpha = 1 - clear
    dark = _lines(scene, surface, pixel, p, hit)
    alpha = alpha + (1 - alpha) * dark * 0.8
    paint = np.empty((t.size, 4))
    for i in range(3):
        paint[:, i] = (surface.colour[i] * value * (1 - dark) + shine) * alpha
    paint[:, 3] = alpha
    np.minimum(paint[:, :3], alpha[:, None], out=paint[:, :3])
    return paint


def _lines(
    scene: Scene, surface: Surface, pixel: float, p: list[FloatArray], hit: _Hit
) -> FloatArray:
    """How dark the hits (n,) at points p are made by lines: rings, and where the box cuts."""
    dark = np.zeros_like(hit.t)
    if surface.rings[0] > 0:
        every, at = surface.rings
        phase = (p[2] - at) / every
        away = np.abs(phase - np.rint(phase)) * every
        slope = _slope(scene.camera, 2, hit) * pixel
        with np.errstate(divide="ignore", invalid="ignore"):
            near = np.flatnonzero(away < 2 * RING * slope)
            line = np.minimum(0.5 + RING / 2 - away[near] / slope[near], 1)
            # Rings too close to be distinguished would be a grey patch.
            line *= np.clip(every / (6 * slope[near]) - 0.5, 0, 1)
        dark[near] = 0.55 * np.maximum(np.nan_to_num(line), 0)
    for axis in range(3):
        edge = scene.half[axis] - np.abs(p[axis])
        close = np.flatnonzero(edge < 60 * pixel)
        if close.size:
            own = _slope(scene.camera, axis, take(hit, close)) * pixel
            with np.errstate(divide="ignore", invalid="ignore"):
                line = np.clip(EDGE + 0.5 - edge[close] / own, 0, 1)
            dark[close] = np.maximum(dark[close], 0.8 * np.nan_to_num(line))
    return dark


def _slope(camera: Camera, axis: int, hit: _Hit) -> FloatArray:
    """How fast a coordinate of the hits (n,) changes with the picture's coordinates."""
    g = hit.g
    with np.errstate(divide="ignore", invalid="ignore"):
        share = hit.d[axis] / hit.toward
        by_x, by_y = (
            v[axis] - share * (g[0] * v[0] + g[1] * v[1] + g[2] * v[2])
            for v in (camera.right, camera.up)
        )
        return np.asarray(hit.t * np.sqrt(by_x * by_x + by_y * by_y))
