"""A region with room for points beside it, in words and as the command line states it."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.clearance.moving_parts import bars_of
from burmester.families.pivot_freedom import PivotFreedom
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.outlines import convex_hull, grown_hull
from burmester.geometry.regions import Line, Point, Polygon, Region, Segment, box
from burmester.geometry.shapes import distances
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.surroundings import KeepOut
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.requirement_check import places_between
from burmester.wording import listed

ROUNDING: Final = 1e-10  # of the coordinates; points farther out by less are inside
DIGITS: Final = 2  # with which an amount is told; the wider limit is rounded by as many
HERE: Final = Polygon(
    np.array([(0.0, 0), (1, 0), (0, 1)])
)  # cuts off nothing where no points are drawn
SIDES: Final = (("further left", "x"), ("lower", "y"), ("further right", "x"), ("higher", "y"))


DIRECTIONS: Final = 8  # number of directions in which a region is moved out of the way
HALVINGS: Final = 30  # number of steps that find how far
SPARE: Final = 1e-3  # motion sizes; more than the margin, for what comes nearer between the places


class WiderRegion(NamedTuple):
    """A region that holds what another one does not.

    by: how much wider it is, a length; words: the same; near: (2,), the farthest of the points.
    """

    region: Region
    by: float
    words: str
    near: FloatArray


def wider(region: Region, points: FloatArray, share: float, task: Task) -> WiderRegion | None:
    """A region with room for points (k, 2); None where it holds them.

    share: how much of the way to them, above 1 for some room to spare.  A box stays a box, a line a
    line, a point a point; others become the hull of themselves and the points.
    """
    near = PivotFreedom(region, HERE, np.zeros(2), 1.0).nearest(points)[0]
    away = np.linalg.norm(points - near, axis=1)
    worst = int(away.argmax())
    if not away[worst] > ROUNDING * np.abs(points).max():
        return None
    step = 10.0 ** (math.floor(math.log10(away[worst])) - DIGITS + 1)
    at, by = points[worst], share * float(away[worst])
    wanted = near + share * (points - near)
    if isinstance(region, Point):
        other = Point(np.round(wanted[worst] / step) * step)
        by = float(np.linalg.norm(other.at - region.at))
        return WiderRegion(other, by, f"{length_of(by, task)} away", at)
    if isinstance(region, Line):
        shift = wanted[worst] - near[worst]
        moved = Line(region.start + shift, region.end + shift)
        return WiderRegion(moved, by, f"on a line {length_of(by, task)} away", at)
    low, high = (turn(wanted / step) * step for turn in (np.floor, np.ceil))
    cells = np.concatenate([low, high])[away[[*range(len(away))] * 2] > 0]
    if isinstance(region, Polygon) and is_box(region):
        return _wider_box(region, cells, at, task)
    corners = region.corners()
    assert corners is not None
    more = [cells, np.stack([cells[:, 0], np.roll(cells[:, 1], len(cells) // 2)], axis=1)]
    grown = Polygon(convex_hull(np.concatenate([corners, *more])))
    return WiderRegion(grown, by, f"{length_of(by, task)} outside their region", at)


def _wider_box(region: Polygon, points: FloatArray, at: FloatArray, task: Task) -> WiderRegion:
    """A box with room for points (k, 2); at: (2,), the farthest of them."""
    old = np.concatenate([region.vertices.min(axis=0), region.vertices.max(axis=0)])
    first, last = np.minimum(old[:2], points.min(axis=0)), np.maximum(old[2:], points.max(axis=0))
    wanted = np.concatenate([first, last])
    rounded = np.array([float(f"{value:.12g}") for value in wanted])
    new = np.where(wanted == old, old, rounded)
    words = [
        f"{length_of(abs(side - before), task)} {way}, to {axis} = {plain(side)}"
        for (way, axis), before, side in zip(SIDES, old, new, strict=True)
        if side != before
    ]
    by = float(np.linalg.norm(new - old))
    grown = box(new[:2].tolist(), new[2:].tolist())
    return WiderRegion(grown, by, listed(words), at)


def wider_all_around(region: Region, by: float) -> Polygon | None:
    """A region wider by a length on all sides; None for an endless line."""
    corners = region.corners()
    if corners is None:
        return None
    return Polygon(grown_hull(corners, by))


def is_box(region: Polygon) -> bool:
    """Whether a polygon is a box with sides along X and Y."""
    v = region.vertices
    return len(v) == 4 and bool(((v == np.roll(v, -1, axis=0)).sum(axis=1) == 1).all())


def plain(value: float) -> str:
    """A number with the digits that it has, up to six."""
    return f"{float(value) + 0.0:.6g}"


def region_text(region: Region | None) -> str:
    """A region as the command line states it."""
    if region is None:
        return "any"

    def points(rows: FloatArray) -> str:
        return ":".join(",".join(f"{float(value) + 0.0:.12g}" for value in row) for row in rows)

    if isinstance(region, Point):
        return points(region.at[None])
    if isinstance(region, Line | Segment):
        return f"{type(region).__name__.lower()}:{points(np.stack([region.start, region.end]))}"
    if is_box(region):
        v = region.vertices
        return f"box:{points(np.stack([v.min(axis=0), v.max(axis=0)]))}"
    return f"polygon:{points(region.vertices)}"


def cleared(
    task: Task, number: int, found: FoundLinkage, size: float, share: float
) -> tuple[Task, FloatArray] | None:
    """The task with a keep-out region moved out of the way of a linkage, and how far it is (2,).

    The shortest of some ways.  size: of the motion.  share: how much of the way.  None where the
    linkage does not come from pose to pose.
    """
    around = task.surroundings
    assert around is not None
    one, parts = around.keep_out[number], _swept(task, found)
    if parts is None:
        return None
    room = around.margin + SPARE * size

    def touches(shift: FloatArray) -> bool:
        region = one.polygon.vertices + shift
        return any(
            bool((distances(shapes, region, room + half) <= room + half).any())
            for shapes, half in parts
        )

    if not touches(np.zeros(2)):
        return None
    every = [one.polygon.vertices, *(shapes.reshape(-1, 2) for shapes, _ in parts)]
    reach = float(np.linalg.norm(np.ptp(np.concatenate(every), axis=0)))
    best, ways = reach + 2 * room + around.link_width, np.zeros(2)
    for angle in np.arange(DIRECTIONS) * 2 * math.pi / DIRECTIONS:
        way = np.round([math.cos(angle), math.sin(angle)], 12)
        if touches(best * way):
            continue
        low, high = 0.0, best
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if touches(middle * way) else (low, middle)
        best, ways = high, way
    if not ways.any():
        return None
    away = share * best
    step = 10.0 ** (math.floor(math.log10(away)) - DIGITS + 1)
    shift = np.sign(ways) * np.ceil(np.abs(away * ways) / step - 1e-9) * step
    regions = list(around.keep_out)
    regions[number] = KeepOut(Polygon(one.polygon.vertices + shift), one.name)
    return replace(task, surroundings=replace(around, keep_out=tuple(regions))), shift


def bars_clear(task: Task, number: int, dimensions: FloatArray) -> NDArray[np.bool_]:
    """Whether the links of RR dyads (k, 5) are clear of a keep-out region at poses: (k, N)."""
    around = task.surroundings
    assert around is not None
    pins = task.poses.act(dimensions[:, None, 2:4])
    fixed = np.broadcast_to(dimensions[:, None, :2], pins.shape)
    free = around.link_width / 2 + around.margin
    bars, region = np.stack([fixed, pins], axis=2), around.keep_out[number].polygon.vertices
    return np.asarray(distances(bars, region, free) > free)


def _swept(task: Task, found: FoundLinkage) -> list[tuple[FloatArray, float]] | None:
    """Links and body at places between the poses: shapes (n, k, 2), and how thick they are."""
    places, around = places_between(found.driver_first, found.driven), task.surroundings
    if places is None or around is None:
        return None
    own = LinkageBatch.of([found.driver_first]).linkage_of_all()
    bars = bars_of(own, places[None]).reshape(-1, 2, 2)
    bars = bars[np.isfinite(bars).all(axis=(1, 2))]
    parts = [(bars, around.link_width / 2)]
    if task.body is not None:
        parts.append((places[:, None].act(task.body.vertices), 0.0))
    return parts
