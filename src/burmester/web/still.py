"""A linkage at one of its poses as a still drawing: SVG as text, without any library.

Ground and links are dark, the coupler is blue, the poses are red frames, the way of the body's
origin is dashed; points, whose angle is free, are red dots; the body's outline is
green, regions to keep out of are grey.  Colours are chosen for light and dark pages alike.
"""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["own_circuit", "six_bar_still", "still"]

SIZE_PX = 420.0  # the longer side of the picture
MARGIN = 0.07  # share of the drawing's size that stays free on each side
SAMPLES = 361  # points of the coupler curve
REACH = 1.2  # sizes of what is drawn beside it, from which on the coupler curve is cut off
LINK, COUPLER, POSE, CURVE = "#5d6b7a", "#3f86d8", "#d0493c", "#8796a8"
BODY, KEEP_OUT = "#2f9583", "#8a8f98"


def still(linkage: Linkage, places: Displacement, task: Task, title: str) -> str:
    """An SVG of a linkage (its driver first) at the middle one of its places (N,) for a task.

    Places that do not exist are nan; where there is none at all only the task is drawn.
    """
    poses = task.poses
    there = np.flatnonzero(np.isfinite(places.angle))
    framed = np.flatnonzero(~task.free_angles)
    shapes: list[tuple[str, FloatArray]] = [_frame(poses[k], poses) for k in framed.tolist()]
    points = poses.translation[task.free_angles]
    if len(there):
        place = places[int(there[len(there) // 2])]
        travel = places[there]
        guides = [_guide(dyad, place, travel) for dyad in (linkage.first, linkage.second)]
        corners = [place.translation, *(pin for _, pin in guides)]
        shapes = [
            (
                f'fill="{COUPLER}" fill-opacity=".15" stroke="{COUPLER}" stroke-width="2"',
                np.array(corners),
            ),
            *shapes,
            *((f'fill="none" stroke="{LINK}" stroke-width="4"', ends) for ends, _ in guides),
        ]
        shapes[:0] = _body(task, travel, place)
        pins = [*_pivots(linkage, place)]
        seen = np.concatenate([points for _, points in shapes])
        shapes[:0] = [
            (f'fill="none" stroke="{CURVE}" stroke-width="1.5" stroke-dasharray="2 4"', piece)
            for piece in _curve(linkage, travel, seen)
        ]
    else:
        pins = []
        shapes[:0] = _body(task, poses[framed], None)
    shapes[:0] = _keep_out(task)
    return _svg(shapes, pins, title, points)


def six_bar_still(found: FoundSixBar, task: Task, title: str) -> str:
    """An SVG of a six-bar at the middle one of the poses of its task, with the body's path."""
    drive = found.drive[len(found.drive) // 2]
    joints, place = found.joints(drive), found.body(drive)
    path = found.body(found.along(SAMPLES)).translation
    filled = 'fill="{0}" fill-opacity=".15" stroke="{0}" stroke-width="2"'
    corners = {**joints, "M": place.translation}
    skeleton = found.skeleton
    outlines = skeleton.corners(found.frames, found.carries)
    plates = {each: own for each, own in outlines.items() if len(own) > 2}
    shapes = [
        *_body(task, found.body(found.drive), place),
        (f'fill="none" stroke="{CURVE}" stroke-width="1.5" stroke-dasharray="2 4"', path),
        *(
            (
                filled.format(COUPLER if link == found.carries else LINK),
                np.stack([corners[name] for name in own]),
            )
            for link, own in plates.items()
        ),
        *(_frame(task.poses[k], task.poses) for k in range(len(found.drive))),
        *(
            (f'fill="none" stroke="{LINK}" stroke-width="4"', np.stack([joints[at] for at in own]))
            for link, own in outlines.items()
            if link not in plates
        ),
    ]
    return _svg(
        shapes,
        [(at, name in skeleton.links[skeleton.ground]) for name, at in joints.items()],
        title,
    )


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


def _guide(dyad: Dyad, place: Displacement, travel: Displacement) -> tuple[FloatArray, FloatArray]:
    """The ends (2, 2) of a link, rail or slot with the coupler at a place, and its corner there."""
    match dyad:
        case RR():
            pin = place.act(dyad.moving_pivot)
            return np.stack([dyad.fixed_pivot, pin]), pin
        case PR():
            along, foot = _line(dyad)
            way = travel.act(dyad.moving_pivot) @ along
            return foot + np.array([[way.min()], [way.max()]]) * along, place.act(dyad.moving_pivot)
        case RP():
            along, foot = _line(dyad)
            way = travel.inverse().act(dyad.fixed_pivot) @ along
            ends = place.act(foot + np.array([[way.min()], [way.max()]]) * along)
            return ends, ends[0]
        case PP():
            here = place.translation
            return np.stack([here, here]), here


def _line(dyad: PR | RP) -> tuple[FloatArray, FloatArray]:
    """The direction (2,) of a line and its foot (2,), the point nearest to the origin."""
    c, s = float(np.cos(dyad.normal_angle)), float(np.sin(dyad.normal_angle))
    return np.array([-s, c]), float(dyad.offset) * np.array([c, s])


def _pivots(linkage: Linkage, place: Displacement) -> Iterable[tuple[FloatArray, bool]]:
    """Pins and blocks in F, and whether they stand on the ground."""
    for dyad in (linkage.first, linkage.second):
        if isinstance(dyad, RR | RP):
            yield dyad.fixed_pivot, True
        if isinstance(dyad, RR | PR):
            yield place.act(dyad.moving_pivot), False


def own_circuit(linkage: Linkage, places: Displacement) -> int:
    """The circuit, 0 or 1, on which most of the places (N,) are."""
    on = circuit_of(linkage, places, as_given=True).circuit
    return int(np.bincount(on[on >= 0], minlength=1).argmax())


def _curve(linkage: Linkage, places: Displacement, near: FloatArray) -> list[FloatArray]:
    """The way of the body's origin on the circuit of the places, in pieces near what is drawn."""
    if isinstance(linkage.first, PP) or isinstance(linkage.second, PP):
        return []
    own = Circuits.of(linkage, as_given=True)[own_circuit(linkage, places)]
    if not own.exists:
        return []
    low, high = near.min(axis=0), near.max(axis=0)
    size = REACH * float((high - low).max())
    if own.closed:
        parameter = np.linspace(0.0, 2 * np.pi, SAMPLES)
    elif own.loop.turns:
        parameter = np.linspace(0.0, np.pi, SAMPLES)
    else:
        parameter = np.linspace(-2 * size, 2 * size, SAMPLES)
    points = own.curve(np.zeros(2), parameter)
    inside = np.isfinite(points).all(axis=-1) & (np.abs(points - (low + high) / 2) < size).all(
        axis=-1
    )
    pieces = np.split(points, np.flatnonzero(np.diff(inside)) + 1)
    first = bool(inside[0])
    return [piece for k, piece in enumerate(pieces) if (k % 2 == 0) == first and len(piece) > 1]


def _svg(
    shapes: list[tuple[str, FloatArray]],
    pins: list[tuple[FloatArray, bool]],
    title: str,
    dots: FloatArray | None = None,
) -> str:
    """The document; dots (n, 2): points of the body, at any angle."""
    dots = np.zeros((0, 2)) if dots is None else dots
    every = np.concatenate([points for _, points in shapes] + [at[None] for at, _ in pins] + [dots])
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
    for point, ground in pins:
        x, y = at(point)
        if ground:
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
