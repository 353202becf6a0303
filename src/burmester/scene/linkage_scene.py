"""A linkage at a place as a display list: polygons, lines and pivots with their roles.

All is in F, in lengths of the task.  Matplotlib, SVG and the terminal draw the same list.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

MARGIN = 0.28  # of the linkage's size: half of a rail's or slot's length beyond the travel
SAMPLES = 361  # points of the body's path
REACH = 1.2  # sizes of what is drawn beside it, from which on a path is cut off


class Shape(NamedTuple):
    """A polygon, of the body or another plate; or a line, of whatever else: (n, 2)."""

    role: Literal["body", "plate", "link", "rail", "slot", "spring", "hand"]
    points: FloatArray


class Pivot(NamedTuple):
    """A pin: its name, where it is (2,), and whether it stands on the ground.

    block: of a slider where its block is, and in which direction it slides, (2, 2); or None.
    """

    name: str
    at: FloatArray
    fixed: bool
    block: FloatArray | None = None


class Scene(NamedTuple):
    """What is drawn of a linkage at a place.

    driven: (2,), the driver's moving pivot, or the body's origin where it has none.
    size: of the linkage, by which symbols are as large.
    """

    shapes: tuple[Shape, ...]
    pivots: tuple[Pivot, ...]
    driven: FloatArray
    size: float

    def of(self, *roles: str) -> list[FloatArray]:
        """The shapes (n, 2) that have one of these roles."""
        return [each.points for each in self.shapes if each.role in roles]


def scene_of(chosen: Candidate, place: Displacement, drive: float, travel: Displacement) -> Scene:
    """A linkage with its body at a place (), and its driver at an angle; travel: see below."""
    if isinstance(chosen, FoundLinkage):
        scene = scene_with(chosen.driver_first, place, travel)
    else:
        scene = _of_skeleton(chosen, drive)
    if chosen.loads is None:
        return scene
    from burmester.scene.load_marks import drawn_springs, hand_arrow  # noqa: PLC0415  few have any

    places = chosen.bodies_at(np.asarray(drive), place)
    marks = [Shape("spring", each) for each in drawn_springs(chosen, places, scene.size)]
    arrow = hand_arrow(chosen, places, scene.size)
    marks += [] if arrow is None else [Shape("hand", arrow)]
    return scene._replace(shapes=(*scene.shapes, *marks))


def scene_at(chosen: Candidate, pose: int) -> Scene:
    """A linkage where it is for a pose, a number from 0; rails and slots reach all poses."""
    places = chosen.error.places
    drive = math.nan if isinstance(chosen, FoundLinkage) else float(chosen.drive[pose])
    return scene_of(chosen, places[pose], drive, places[np.isfinite(places.angle)])


def scene_with(linkage: Linkage, place: Displacement, travel: Displacement) -> Scene:
    """A four-bar, its driver first, with its coupler at a place ().

    travel: (n,), further places that rails and slots have to reach.
    """
    shapes, pivots, corners = list[Shape](), list[Pivot](), [place.translation]
    size = longest(linkage)
    for dyad, letter in zip((linkage.first, linkage.second), "AB", strict=True):
        if isinstance(dyad, PP):
            continue
        fixed = moving = None
        if not isinstance(dyad, PR):
            fixed = dyad.fixed_pivot
        if not isinstance(dyad, RP):
            moving = place.act(dyad.moving_pivot)
        if isinstance(dyad, RR):
            assert fixed is not None
            assert moving is not None
            shapes.append(Shape("link", np.stack([fixed, moving])))
            corners.append(moving)
            pivots.append(Pivot(f"{letter}0", fixed, True))
            pivots.append(Pivot(letter, moving, False))
        elif isinstance(dyad, PR):
            assert moving is not None
            normal, along = _directions(dyad)
            every = np.append(dyad.along(travel), moving @ along)
            shapes.append(Shape("rail", _ends(dyad, every, size)))
            corners.append(moving)
            on_rail = dyad.offset * normal + along * (moving @ along)
            pivots.append(Pivot(letter, moving, False, np.stack([on_rail, along])))
        else:
            assert fixed is not None
            _, along = _directions(dyad)
            every = np.append(dyad.along(travel), place.inverse().act(fixed) @ along)
            ends = _ends(dyad, every, size)
            shapes.append(Shape("slot", place.act(ends)))
            corners.append(place.act(ends[int(np.hypot(*ends.T).argmin())]))
            pivots.append(Pivot(f"{letter}0", fixed, True, np.stack([fixed, place.rotate(along)])))
    shapes.append(Shape("body", np.stack(corners)))
    first = linkage.first
    driven = place.act(first.moving_pivot) if isinstance(first, RR | PR) else place.translation
    return Scene(tuple(shapes), tuple(pivots), driven, size)


def _directions(dyad: PR | RP) -> tuple[FloatArray, FloatArray]:
    """The normal of its line, and the direction along it."""
    c, s = float(np.cos(dyad.normal_angle)), float(np.sin(dyad.normal_angle))
    return np.array([c, s]), np.array([-s, c])


def _ends(dyad: PR | RP, along: FloatArray, size: float) -> FloatArray:
    """The ends (2, 2) of a rail or slot that holds all these coordinates along it."""
    normal, direction = _directions(dyad)
    ends = np.array([np.nanmin(along) - MARGIN * size, np.nanmax(along) + MARGIN * size])
    return np.asarray(dyad.offset * normal + direction * ends[:, None])


def _of_skeleton(found: FoundSixBar, drive: float) -> Scene:
    skeleton = found.skeleton
    at = {name: np.asarray(place) for name, place in found.joints(np.asarray(drive)).items()}
    corners = {**at, "M": found.body(np.asarray(drive)).translation}
    shapes = []
    for link, joints in skeleton.corners(found.frames, found.carries).items():
        role: Literal["body", "plate", "link"] = "plate" if len(joints) > 2 else "link"
        points = np.stack([corners[joint] for joint in joints])
        shapes.append(Shape("body" if link == found.carries else role, points))
    fixed = skeleton.links[skeleton.ground]
    return Scene(
        tuple(shapes),
        tuple(Pivot(name, place, name in fixed) for name, place in at.items()),
        at[skeleton.arm(found.driver_pivot)[1]],
        max(found.lengths.values()),
    )


def longest(linkage: Linkage) -> float:
    """The longest of a linkage's lengths, or 1: the same wherever its coupler is.

    Between pivots of one frame, and from the body's origin to what the body holds.
    """
    dyads: tuple[Dyad, Dyad] = (linkage.first, linkage.second)
    lengths = [0.0]
    for name in ("fixed_pivot", "moving_pivot"):
        pivots = [getattr(dyad, name) for dyad in dyads if hasattr(dyad, name)]
        if len(pivots) == 2:
            lengths.append(float(np.linalg.norm(pivots[1] - pivots[0])))
    for dyad in dyads:
        if isinstance(dyad, RR):
            lengths.append(float(dyad.radius))
        if isinstance(dyad, RR | PR):
            lengths.append(float(np.linalg.norm(dyad.moving_pivot)))
        if isinstance(dyad, RP):
            lengths.append(float(abs(dyad.offset)))
    return max(lengths) or 1.0


def own_circuit(linkage: Linkage, places: Displacement) -> int | None:
    """The circuit, 0 or 1, on which most of the places (N,) are; None without one driver."""
    if isinstance(linkage.first, PP) or isinstance(linkage.second, PP):
        return None
    on = circuit_of(linkage, places, as_given=True).circuit
    return int(np.bincount(on[on >= 0], minlength=1).argmax())


def path_of(chosen: Candidate, near: FloatArray) -> list[FloatArray]:
    """The path of the body's origin, in pieces near what is drawn: points (n, 2).

    Of a four-bar it is the whole circuit on which it meets most poses.
    """
    if not isinstance(chosen, FoundLinkage):
        return [chosen.body(chosen.along(SAMPLES)).translation]
    linkage, places = chosen.driver_first, chosen.error.places
    number = own_circuit(linkage, places[np.isfinite(places.angle)])
    if number is None:
        return []
    own = Circuits.of(linkage, as_given=True)[number]
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
