"""A keep-out region moved out of the way of a linkage, and what the linkage sweeps."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.wider_region import DIGITS
from burmester.tasks.motion_task import Task
from burmester.tasks.surroundings import KeepOut
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.requirement_check import places_between

DIRECTIONS: Final = 8  # number of directions in which a region is moved out of the way
HALVINGS: Final = 30  # number of steps that find how far
SPARE: Final = 1e-3  # motion sizes; more than the margin, for what comes nearer between the places


def cleared(
    task: Task, number: int, found: FoundLinkage, size: float, share: float
) -> tuple[Task, FloatArray] | None:
    """The task with a keep-out region moved out of the way of a linkage, and how far it is (2,).

    The shortest of some ways.  size: of the motion.  share: how much of the way.  None where the
    linkage does not come from pose to pose.
    """
    import shapely  # noqa: PLC0415  only tasks with surroundings need it

    around = task.surroundings
    assert around is not None
    one, parts = around.keep_out[number], _swept(task, found)
    if parts is None:
        return None
    room = around.margin + SPARE * size

    def touches(shift: FloatArray) -> bool:
        region = shapely.Polygon(one.polygon.vertices + shift)
        return bool((shapely.distance(parts, region) <= room).any())

    if not touches(np.zeros(2)):
        return None
    every = np.concatenate([shapely.get_coordinates(parts), one.polygon.vertices])
    best, ways = float(np.linalg.norm(np.ptp(every, axis=0))) + 2 * room, np.zeros(2)
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
    import shapely  # noqa: PLC0415  only tasks with surroundings need it

    around = task.surroundings
    assert around is not None
    pins = task.poses.act(dimensions[:, None, 2:4])
    fixed = np.broadcast_to(dimensions[:, None, :2], pins.shape)
    bars = shapely.linestrings(np.stack([fixed, pins], axis=2))
    away = shapely.distance(bars, shapely.Polygon(around.keep_out[number].polygon.vertices))
    return np.asarray(away > around.link_width / 2 + around.margin)


def _swept(task: Task, found: FoundLinkage) -> NDArray[np.object_] | None:
    """Body and links at places between the poses, as Shapely geometries."""
    import shapely  # noqa: PLC0415  only tasks with surroundings need it

    from burmester.clearance.moving_parts import bars_of  # noqa: PLC0415  the same

    places, around = places_between(found.driver_first, found.driven), task.surroundings
    if places is None or around is None:
        return None
    own = LinkageBatch.of([found.driver_first]).linkage_of_all()
    bars = bars_of(own, places[None]).reshape(-1, 2, 2)
    bars = bars[np.isfinite(bars).all(axis=(1, 2))]
    shapes = [shapely.buffer(shapely.linestrings(bars), max(around.link_width / 2, 1e-9))]
    if task.body is not None:
        shapes.append(shapely.polygons(places[:, None].act(task.body.vertices)))
    return np.concatenate(shapes)
