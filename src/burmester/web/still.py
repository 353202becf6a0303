"""A linkage at one of its poses as a still drawing: SVG as text, without any library.

Ground and links are dark, the coupler is blue, the poses are red frames, the way of the body's
origin is dashed; points, whose angle is free, are red dots; the body's outline is green, regions to
keep out of are grey; springs are violet, the arrow of a hand is orange.  Colours are chosen for
light and dark pages alike.
"""

from __future__ import annotations

from html import escape

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.scene.linkage_scene import Pivot, path_of, scene_at
from burmester.synthesis.result import Candidate
from burmester.tasks.motion_task import Task

SIZE_PX = 420.0  # the longer side of the picture
MARGIN = 0.07  # share of the drawing's size that stays free on each side
LINK, COUPLER, POSE, CURVE = "#5d6b7a", "#3f86d8", "#d0493c", "#8796a8"
BODY, KEEP_OUT = "#2f9583", "#8a8f98"
SPRING, HAND = "#8a63c9", "#c9771f"
FILLED = 'fill="{0}" fill-opacity=".15" stroke="{0}" stroke-width="2"'
STYLES = {
    "body": FILLED.format(COUPLER),
    "plate": FILLED.format(LINK),
    "path": f'fill="none" stroke="{CURVE}" stroke-width="1.5" stroke-dasharray="2 4"',
    "line": f'fill="none" stroke="{LINK}" stroke-width="4"',
    "spring": f'fill="none" stroke="{SPRING}" stroke-width="1.6"',
    "hand": f'fill="none" stroke="{HAND}" stroke-width="2.2"',
}


def still(chosen: Candidate, title: str) -> str:
    """An SVG of a linkage at the middle one of the poses of its task.

    Where it reaches none of them, only the task is drawn.
    """
    task, places = chosen.task, chosen.error.places
    there = np.flatnonzero(np.isfinite(places.angle))
    framed = np.flatnonzero(~task.free_angles)
    points = task.poses.translation[task.free_angles]
    frames = [_frame(task.poses[k], task.poses) for k in framed.tolist()]
    if not len(there):
        body = _body(task, task.poses[framed], None)
        return _svg([*_keep_out(task), *body, *frames], (), title, points)
    pose = int(there[len(there) // 2])
    scene = scene_at(chosen, pose)
    plates = [(STYLES[role], at) for role, at in scene.shapes if role in ("body", "plate")]
    shapes = [*_body(task, places[there], places[pose]), *plates, *frames]
    shapes += [(STYLES["line"], points) for points in scene.of("link", "rail", "slot")]
    shapes += [(STYLES[role], at) for role in ("spring", "hand") for at in scene.of(role)]
    seen = np.concatenate([points for _, points in shapes])
    path = [(STYLES["path"], piece) for piece in path_of(chosen, seen)]
    return _svg([*_keep_out(task), *path, *shapes], scene.pivots, title, points)


def _body(
    task: Task, places: Displacement, here: Displacement | None
) -> list[tuple[str, FloatArray]]:
    """The body's outline at places (n,), faintly, and strongly where it is drawn."""
    if task.body is None:
        return []
    faint = f'fill="{BODY}" fill-opacity=".05" stroke="{BODY}" stroke-opacity=".6"'
    strong = f'fill="{BODY}" fill-opacity=".18" stroke="{BODY}" stroke-width="1.5"'
    corners = task.body.vertices
    drawn = [(faint, places[k].act(corners)) for k in range(len(places.angle))]
    return drawn + ([] if here is None else [(strong, here.act(corners))])


def _keep_out(task: Task) -> list[tuple[str, FloatArray]]:
    if task.surroundings is None:
        return []
    style = f'fill="{KEEP_OUT}" fill-opacity=".4" stroke="{KEEP_OUT}" stroke-width="1.5"'
    return [(style, each.polygon.vertices) for each in task.surroundings.keep_out]


def _frame(pose: Displacement, poses: Displacement) -> tuple[str, FloatArray]:
    """The axes of M at a pose, the x axis the longer one."""
    size = max(0.08 * float(np.ptp(poses.translation, axis=0).max()), np.finfo(float).tiny)
    axes = pose.act(np.array([[size, 0.0], [0.0, 0.0], [0.0, 0.6 * size]]))
    return f'fill="none" stroke="{POSE}" stroke-width="2"', axes


def _svg(
    shapes: list[tuple[str, FloatArray]],
    pins: tuple[Pivot, ...],
    title: str,
    dots: FloatArray,
) -> str:
    """The document; dots (n, 2): points of the body, at any angle."""
    every = np.concatenate([*(at for _, at in shapes), *(pin.at[None] for pin in pins), dots])
    low, high = every.min(axis=0), every.max(axis=0)
    size = max(float((high - low).max()), np.finfo(float).tiny)
    scale = SIZE_PX / size / (1 + 2 * MARGIN)
    low, high = low - MARGIN * size, high + MARGIN * size
    width, height = scale * (high - low)

    def at(point: FloatArray) -> tuple[float, float]:
        x, y = scale * (point - low)
        return float(x), float(height - y)

    parts = []
    for style, points in shapes:
        steps = " ".join("{:.1f},{:.1f}".format(*at(point)) for point in points)
        shape = "polygon" if "fill-opacity" in style else "polyline"
        parts.append(f'<{shape} points="{steps}" {style} stroke-linejoin="round"/>')
    for point in dots:
        x, y = at(point)
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{POSE}"/>')
    for pin in pins:
        x, y = at(pin.at)
        if pin.fixed:
            foot = f"{x:.1f},{y:.1f} {x - 8:.1f},{y + 14:.1f} {x + 8:.1f},{y + 14:.1f}"
            parts.append(f'<polygon points="{foot}" fill="{LINK}"/>')
        parts.append(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="#fff" stroke="{LINK}" '
            'stroke-width="2"/>'
        )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
        f'width="{width:.0f}" height="{height:.0f}" role="img"><title>{escape(title)}</title>'
        + "".join(parts)
        + "</svg>"
    )
