"""A linkage as plates with holes and slots, in layers on each other: what the formats draw and cut.

Everything here is in millimetres.  Outlines are closed polylines with bulges, as in DXF: rows
(x, y, bulge) whose bulge, the tangent of a quarter of the arc's angle, says how the way to the
next point bends (0 straight, 1 half a circle to the left).  So arcs are exact.

Layers: 0 is the ground, each further one lies on the one before.  A link hangs on its neighbours
by pins.  Where two links would meet in one layer, or a pin would be in a link's way, the next
arrangement is taken; the last of them has a second ground above, so that pins are short.

E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.circuit import Circuits, circuit_of
from burmester.displacement import Displacement, FloatArray
from burmester.dyad import PP, PR, RP, RR, Dyad
from burmester.errors import InputError
from burmester.export.options import MILLIMETRES, Options, unit_of
from burmester.io.saved import SavedLinkage
from burmester.linkage import Linkage

__all__ = [
    "Assembly",
    "Dimensions",
    "Pin",
    "Plate",
    "assembly_of",
    "in_millimetres",
    "outline_points",
    "places_of_motion",
    "slot_outline",
]

SHARE = 0.12  # of the middle link length: the width of links
OF_SHORTEST = 0.6  # of the least distance between two holes: the most that the width may be
HOLE = 0.4  # of the width
THICK = 0.4  # of the width
AIR = 0.1  # of the thickness, between plates
WALL = 0.1  # of a hole's diameter: the least metal beside it
RUN_OUT = 0.5  # of a hole's diameter, by which a slot goes on where the pin has come to its end
LOOKS = 721  # places along the motion at which plates are compared
NOTHING = 1e-6  # of the middle link length: a distance that leaves no room for holes
CLEAR = 0.05  # of the width, by which plates of one layer have to miss each other

Owner: TypeAlias = Literal["ground", "driver", "coupler", "follower"]


@final
@dataclass(frozen=True, slots=True)
class Dimensions:
    """What the plates are made with, in millimetres."""

    hole: float
    width: float
    thickness: float
    gap: float


@final
@dataclass(frozen=True, slots=True, eq=False)
class Plate:
    """A flat part in a frame of its own, millimetres.

    name: ground, ground-2 (the second one, above), driver, coupler or follower; owner: the link
    that it is of.  The frames: of ground plates F, of the coupler M, of driver and follower the
    fixed pivot with x towards the moving one.
    outline: (k, 3) x, y, bulge, counter-clockwise, closed from the last to the first.
    holes: (h, 3) x, y, diameter.  slots: (s, 5) x, y of both ends' centres, width.
    marks: (m, 2), points to be marked: the body's origin.
    layer: 0 and upwards.  skeleton: (n, 2), convex; the outline is all within `radius` of it.
    fixed, moving: the pivots of a driver or follower, in F and in M.
    """

    name: str
    owner: Owner
    outline: FloatArray
    holes: FloatArray
    slots: FloatArray
    marks: FloatArray
    layer: int
    skeleton: FloatArray
    radius: float
    fixed: FloatArray | None = None
    moving: FloatArray | None = None

    def at(self, places: Displacement) -> Displacement:
        """Where the plate lies (F <- plate) when the coupler is at places (*,), millimetres."""
        if self.owner == "ground":
            return Displacement.identity(places.shape)
        if self.owner == "coupler":
            return places
        assert self.fixed is not None
        assert self.moving is not None
        arm = places.act(self.moving) - self.fixed
        return Displacement(self.fixed, np.arctan2(arm[..., 1], arm[..., 0]))


@final
@dataclass(frozen=True, slots=True)
class Pin:
    """A pin through layers `low` to `high`, at (x, y) of the plate of that name that holds it.

    joins: the names of the plates that it joins.
    """

    plate: str
    x: float
    y: float
    diameter: float
    low: int
    high: int
    joins: tuple[str, str]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Assembly:
    """A linkage as plates and pins.

    scale: millimetres per unit of the task's lengths; unit: of those.
    assumed: whether the task names no unit, nor the options, so that mm was taken.
    places: (N,), of the coupler at the poses; motion: (n,), of the coupler along the stretch of
    the motion that holds the poses; both in millimetres.
    pose: index of the place at which the assembly is drawn.
    """

    plates: tuple[Plate, ...]
    pins: tuple[Pin, ...]
    dimensions: Dimensions
    scale: float
    unit: str
    assumed: bool
    places: Displacement
    motion: Displacement
    pose: int

    def plate(self, name: str) -> Plate | None:
        """The plate of a name, where there is one."""
        return next((each for each in self.plates if each.name == name), None)

    @property
    def drawn(self) -> Displacement:
        """The coupler's place at which the assembly is drawn."""
        return self.places[self.pose]


def in_millimetres(places: Displacement, scale: float) -> Displacement:
    """Places (*,) with so many millimetres per unit of theirs."""
    return Displacement(places.translation * scale, places.angle)


def assembly_of(chosen: SavedLinkage, options: Options) -> Assembly:
    """The plates and pins of a linkage; raises E162 and E163."""
    unit = unit_of(chosen, options)
    scale = MILLIMETRES[unit]
    first, second = (_scaled(dyad, scale) for dyad in (chosen.linkage.first, chosen.linkage.second))
    number = chosen.error.places.shape[0]
    if not 1 <= options.pose <= number:
        raise InputError(
            "E162",
            f"there is no pose {options.pose} to draw",
            why=f"the task has {number} poses",
            help=f"say --pose 1, or another up to {number}",
        )
    places = in_millimetres(chosen.error.places, scale)
    motion = places_of_motion(Linkage(first, second), places)
    parts = _Parts(first, second, motion)
    made = _dimensions(parts, options, scale, unit)
    plates, pins = _arranged(parts, made)
    return Assembly(
        plates,
        pins,
        made,
        scale,
        unit,
        chosen.unit is None and options.unit is None,
        places,
        motion,
        options.pose - 1,
    )


def places_of_motion(linkage: Linkage, places: Displacement, looks: int = LOOKS) -> Displacement:
    """Coupler places (n,) along each branch of a circuit from its first to its last of places (N,).

    The places themselves are among them, in their order along the way.  Whole turns are cut where
    the places leave the widest gap.
    """
    circuits = Circuits.of(linkage, as_given=True)
    here = circuit_of(linkage, places, as_given=True)
    rows: list[FloatArray] = []
    on = np.isfinite(here.parameter) & (here.circuit >= 0)
    for circuit, branch in sorted(set(zip(here.circuit[on], here.branch[on], strict=True))):
        own = circuits[int(circuit)]
        which = on & (here.circuit == circuit) & (here.branch == branch)
        s = here.parameter[which]
        if own.closed and own.branches == 1:
            order = np.sort(s % (2 * np.pi))
            gap = np.append(order[1:], order[0] + 2 * np.pi) - order
            cut = order[(int(gap.argmax()) + 1) % len(order)]
            s = cut + (s - cut) % (2 * np.pi)
        s = np.unique(np.concatenate([np.linspace(s.min(), s.max(), looks), s]))
        with np.errstate(invalid="ignore", divide="ignore"):
            along = own.couplers(s)
        rows.append(np.column_stack([along.translation, along.angle]))
    rows.append(np.column_stack([places.translation, places.angle]))
    table = np.concatenate(rows if len(rows) == 1 else rows[:-1])
    return Displacement.from_poses(table[np.isfinite(table).all(axis=1)])


def _scaled(dyad: Dyad, scale: float) -> RR | PR | RP:
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot * scale, dyad.moving_pivot * scale, dyad.radius * scale)
    if isinstance(dyad, PR):
        return PR(dyad.normal_angle, dyad.offset * scale, dyad.moving_pivot * scale)
    if isinstance(dyad, RP):
        return RP(dyad.fixed_pivot * scale, dyad.normal_angle, dyad.offset * scale)
    assert isinstance(dyad, PP)
    raise InputError(
        "E163",
        "this linkage cannot be made of plates with pins and slots",
        why="its body only translates, on two sliders of which one carries the other",
        help="choose another linkage, or a table of its places: --to csv",
    )


class _Parts:
    """What has to be in the plates, before it is known how wide they are.

    reach: of a PR's pin along its line, of an RP's along the slot: two ends, (2, 2), in F or M.
    """

    def __init__(self, first: RR | PR | RP, second: RR | PR | RP, motion: Displacement) -> None:
        self.dyads = (first, second)
        self.motion = motion
        self.reach = tuple(_reach(dyad, motion) for dyad in self.dyads)

    def features(self, on: Literal["ground", "coupler"]) -> list[FloatArray]:
        """What each dyad has on the ground or the coupler: ends (1, 2) of a hole, (2, 2) a slot."""
        slotted = PR if on == "ground" else RP
        found: list[FloatArray] = []
        for dyad, reach in zip(self.dyads, self.reach, strict=True):
            if isinstance(dyad, slotted):
                assert reach is not None
                found.append(reach)
            else:
                pivot = dyad.fixed_pivot if on == "ground" else dyad.moving_pivot  # type: ignore[union-attr]
                found.append(pivot[None])
        return found


def _reach(dyad: RR | PR | RP, motion: Displacement) -> FloatArray | None:
    """Both ends (2, 2) of what a slider's pin travels along its line."""
    if isinstance(dyad, RR):
        return None
    if isinstance(dyad, PR):
        points = motion.act(dyad.moving_pivot)
    else:
        points = motion.inverse().act(dyad.fixed_pivot)
    n = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    along = np.array([-n[1], n[0]])
    s = points @ along
    return np.asarray(n * dyad.offset + np.stack([s.min(), s.max()])[:, None] * along)


def _dimensions(parts: _Parts, options: Options, scale: float, unit: str) -> Dimensions:
    """The dimensions asked for or chosen, in millimetres; raises E162."""
    near = _distance(*parts.features("coupler"))
    lengths = [float(dyad.radius) for dyad in parts.dyads if isinstance(dyad, RR)]
    between = {
        f"{name} link": float(dyad.radius)
        for name, dyad in zip(("driver's", "follower's"), parts.dyads, strict=True)
        if isinstance(dyad, RR)
    }
    between["two joints of the coupler"] = near
    least_name, least = min(between.items(), key=lambda item: item[1])
    ground = [pivots.mean(axis=0) for pivots in parts.features("ground")]
    lengths += [near, float(np.linalg.norm(ground[1] - ground[0]))]
    travels = [float(np.linalg.norm(each[1] - each[0])) for each in parts.reach if each is not None]
    size = float(np.median([each for each in lengths + travels if each > 0] or [1.0]))

    if not least > NOTHING * size:
        raise InputError(
            "E163",
            "this linkage cannot be made of plates with pins and slots",
            why="both joints of the coupler would be at one place of it: a slot runs through them"
            if least_name.startswith("two")
            else f"the {least_name} has no length",
            help="choose another linkage, or a table of its places: --to csv",
        )
    asked = {
        name: None if value is None else value * scale
        for name, value in (
            ("hole", options.hole),
            ("width", options.width),
            ("thickness", options.thickness),
            ("gap", options.gap),
        )
    }
    for name, value in asked.items():
        if value is not None and not (math.isfinite(value) and value > 0):
            if name == "gap" and value == 0:
                continue
            raise InputError(
                "E162",
                f"a {name} of {value / scale:g} {unit} cannot be made",
                why="it has to be a number above 0",
                help=f"leave --{name} out, and it is chosen from the linkage's size",
            )
    width, hole = asked["width"], asked["hole"]
    if width is None:
        most = min(SHARE * size, OF_SHORTEST * least)
        width = _rounded(most if hole is None else hole / HOLE)
    if hole is None:
        hole = _rounded(min(HOLE * width, OF_SHORTEST * least))
    most_hole = width / (1 + 2 * WALL)
    if not hole <= most_hole * (1 + 1e-9):
        raise InputError(
            "E162",
            f"a hole of {hole / scale:.6g} {unit} is too wide for a link of width "
            f"{width / scale:.6g} {unit}",
            why=f"on each side {WALL:.0%} of the hole has to be left of the link, so the hole can "
            f"be {most_hole / scale:.6g} {unit} at most",
            help=f"say --hole {_down(most_hole / scale)}, or --width {_up(hole * 1.2 / scale)}",
        )
    most_hole = least / (1 + WALL)
    if not hole <= most_hole:
        what = least_name if least_name.startswith("two") else f"the {least_name}'s two holes"
        raise InputError(
            "E162",
            f"holes of {hole / scale:.6g} {unit} would run into each other",
            why=f"{what} are {least / scale:.6g} {unit} apart",
            help=f"say --hole {_down(most_hole / scale)}",
        )
    thickness = asked["thickness"] if asked["thickness"] is not None else _rounded(THICK * width)
    gap = asked["gap"] if asked["gap"] is not None else _rounded(AIR * thickness)
    return Dimensions(hole, width, thickness, gap)


def _rounded(value: float) -> float:
    """Down to two digits."""
    if not value > 0:
        return value
    digits = 1 - math.floor(math.log10(value))
    return float(_down(value, digits))


def _down(value: float, digits: int | None = None) -> str:
    digits = 1 - math.floor(math.log10(value)) if digits is None else digits
    step = 10.0**-digits
    return f"{round(math.floor(value / step + 1e-9) * step, max(digits, 0)):g}"


def _up(value: float) -> str:
    digits = 1 - math.floor(math.log10(value))
    step = 10.0**-digits
    return f"{round(math.ceil(value / step - 1e-9) * step, max(digits, 0)):g}"


def _arranged(parts: _Parts, made: Dimensions) -> tuple[tuple[Plate, ...], tuple[Pin, ...]]:
    """The plates in the first arrangement in which nothing meets."""
    links = [isinstance(dyad, RR) for dyad in parts.dyads]
    apart = _distance(*parts.features("ground")) >= made.hole * (1 + WALL)
    coupler = 2 if any(links) else 1
    # (layer of the first link, of the second, of the ground that each hangs on)
    tries: list[tuple[int, int, int, int]] = []
    if all(links):
        tries = [(1, 1, 0, 0), (1, 3, 0, 0), (1, 3, 0, 4)]
    elif links[0]:
        tries = [(1, 0, 0, 0), (1, 0, 0, 3)]
    elif links[1]:
        tries = [(0, 1, 0, 0), (0, 1, 3, 0)]
    else:
        tries = [(0, 0, 0, 0), (0, 0, 0, 2)]
    for number, (one, two, under, over) in enumerate(tries):
        plates, pins = _built(parts, made, coupler, (one, two), (under, over))
        one_ground = under == over
        if number == len(tries) - 1:
            break
        if one_ground and not apart:
            continue
        if not _meet(plates, pins, parts.motion, made):
            break
    return plates, pins


def _built(
    parts: _Parts,
    made: Dimensions,
    coupler_layer: int,
    links: tuple[int, int],
    grounds: tuple[int, int],
) -> tuple[tuple[Plate, ...], tuple[Pin, ...]]:
    radius, hole = made.width / 2, made.hole
    on_ground, on_coupler = parts.features("ground"), parts.features("coupler")
    plates: list[Plate] = []
    pins: list[Pin] = []
    names = {layer: "ground" if layer == 0 else "ground-2" for layer in grounds}
    for layer in sorted(names):
        own = [each for each, of in zip(on_ground, grounds, strict=True) if of == layer]
        plates.append(_plate(names[layer], "ground", own, layer, radius, hole))
    for k, (dyad, layer) in enumerate(zip(parts.dyads, links, strict=True)):
        name: Owner = "follower" if k else "driver"
        ground = names[grounds[k]]
        if isinstance(dyad, RR):
            far = np.array([[float(dyad.radius), 0.0]])
            plates.append(
                _plate(
                    name,
                    name,
                    [np.zeros((1, 2)), far],
                    layer,
                    radius,
                    hole,
                    fixed=dyad.fixed_pivot,
                    moving=dyad.moving_pivot,
                )
            )
            x, y = dyad.fixed_pivot.tolist()
            span = sorted((grounds[k], layer))
            pins.append(Pin(ground, x, y, hole, span[0], span[1], (ground, name)))
            x, y = dyad.moving_pivot.tolist()
            span = sorted((coupler_layer, layer))
            pins.append(Pin("coupler", x, y, hole, span[0], span[1], ("coupler", name)))
        else:
            span = sorted((grounds[k], coupler_layer))
            on = "coupler" if isinstance(dyad, PR) else ground
            x, y = (dyad.moving_pivot if isinstance(dyad, PR) else dyad.fixed_pivot).tolist()
            pins.append(Pin(on, x, y, hole, span[0], span[1], (ground, "coupler")))
    body = _plate("coupler", "coupler", on_coupler, coupler_layer, radius, hole, mark=True)
    plates.append(body)
    order = ["ground", "ground-2", "driver", "coupler", "follower"]
    return tuple(sorted(plates, key=lambda each: order.index(each.name))), tuple(pins)


def _plate(  # noqa: PLR0917
    name: str,
    owner: Owner,
    features: Sequence[FloatArray],
    layer: int,
    radius: float,
    hole: float,
    mark: bool = False,
    fixed: FloatArray | None = None,
    moving: FloatArray | None = None,
) -> Plate:
    holes = [[*each[0].tolist(), hole] for each in features if len(each) == 1]
    slots = []
    for each in features:
        if len(each) == 2:
            low, high = each
            size = float(np.linalg.norm(high - low))
            out = (high - low) / size * RUN_OUT * hole if size > 0 else np.array([0.0, 0.0])
            slots.append([*(low - out).tolist(), *(high + out).tolist(), hole])
    origin = np.zeros((1, 2)) if mark else np.empty((0, 2))
    ends = [np.reshape(slot[:4], (2, 2)) for slot in slots]
    points = np.concatenate([np.reshape(each[:2], (1, 2)) for each in holes] + ends + [origin])
    skeleton = _hull(points)
    return Plate(
        name,
        owner,
        _rounded_hull(skeleton, radius),
        np.reshape(np.array(holes, dtype=np.float64), (-1, 3)),
        np.reshape(np.array(slots, dtype=np.float64), (-1, 5)),
        origin,
        layer,
        skeleton,
        radius,
        fixed,
        moving,
    )


def _hull(points: FloatArray) -> FloatArray:
    """The corners (n, 2) of the convex hull of points (m, 2), counter-clockwise."""
    size = float(np.ptp(points, axis=0).max())
    rows: list[FloatArray] = []
    for point in points[np.lexsort((points[:, 1], points[:, 0]))]:
        if not any(np.linalg.norm(point - each) <= 1e-12 * size for each in rows):
            rows.append(point)
    if len(rows) < 3:
        return np.array(rows)

    def half(run: list[FloatArray]) -> list[FloatArray]:
        chain: list[FloatArray] = []
        for point in run:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-1] - chain[-2], point - chain[-1]
                if ax * by - ay * bx > 1e-12 * size * size:
                    break
                chain.pop()
            chain.append(point)
        return chain[:-1]

    return np.array(half(rows) + half(rows[::-1]))


def _rounded_hull(corners: FloatArray, radius: float) -> FloatArray:
    """The outline (k, 3), with bulges, of all that is within a radius of a convex polygon."""
    if len(corners) == 1:
        (x, y), r = corners[0], radius
        return np.array([[x + r, y, 1.0], [x - r, y, 1.0]])
    edge = np.roll(corners, -1, axis=0) - corners
    unit = edge / np.linalg.norm(edge, axis=1, keepdims=True)
    normal = np.stack([unit[:, 1], -unit[:, 0]], axis=1)
    before = np.roll(normal, 1, axis=0)
    cross = before[:, 0] * normal[:, 1] - before[:, 1] * normal[:, 0]
    turn = np.arctan2(np.abs(cross), (before * normal).sum(axis=1))
    into = np.column_stack([corners + radius * before, np.tan(turn / 4)])
    out = np.column_stack([corners + radius * normal, np.zeros(len(corners))])
    return np.stack([into, out], axis=1).reshape(-1, 3)


def slot_outline(slot: FloatArray) -> FloatArray:
    """The outline (k, 3) with bulges of a slot (5,)."""
    ends = _hull(np.reshape(slot[:4], (2, 2)))
    return _rounded_hull(ends, float(slot[4]) / 2)


def outline_points(shape: Plate | FloatArray, tolerance: float) -> FloatArray:
    """A polygon (n, 2) on the outline of a plate, or on an outline (k, 3), not closed again.

    Its sides leave the arcs by the tolerance at most; the ends of the arcs are among the points.
    """
    outline = shape.outline if isinstance(shape, Plate) else shape
    points: list[FloatArray] = []
    for start, end in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        points.append(start[:2])
        if (bulge := float(start[2])) == 0:
            continue
        chord = complex(*(end[:2] - start[:2]))
        centre = complex(*start[:2]) + chord * (0.5 + 0.25j * (1 / bulge - bulge))
        angle, r = 4 * math.atan(bulge), abs(complex(*start[:2]) - centre)
        step = 2 * math.acos(max(1 - tolerance / r, 0.0))
        count = max(math.ceil(abs(angle) / step), 1)
        arm = complex(*start[:2]) - centre
        for k in range(1, count):
            z = centre + arm * complex(math.cos(angle * k / count), math.sin(angle * k / count))
            points.append(np.array([z.real, z.imag]))
    return np.array(points)


def _meet(
    plates: Sequence[Plate], pins: Sequence[Pin], motion: Displacement, made: Dimensions
) -> bool:
    """Whether two plates of one layer, or a pin and a plate that it does not join, ever meet."""
    bodies = {each.name: each.at(motion) for each in plates}
    clear = CLEAR * made.width
    for k, one in enumerate(plates):
        for two in plates[k + 1 :]:
            if one.layer == two.layer:
                gap = _gaps(
                    _placed(one.skeleton, bodies[one.name]), _placed(two.skeleton, bodies[two.name])
                )
                if (gap < one.radius + two.radius + clear).any():
                    return True
    for pin in pins:
        at = _placed(np.array([[pin.x, pin.y]]), bodies[pin.plate])
        for plate in plates:
            if plate.name not in pin.joins and pin.low < plate.layer < pin.high:
                gap = _gaps(at, _placed(plate.skeleton, bodies[plate.name]))
                if (gap < pin.diameter / 2 + plate.radius + clear).any():
                    return True
    return False


def _placed(points: FloatArray, places: Displacement) -> FloatArray:
    """Points (k, 2) at places (n,): (n, k, 2)."""
    return places[:, None].act(points[None])


def _distance(one: FloatArray, two: FloatArray) -> float:
    """The distance of two features: points (1, 2) or segments (2, 2)."""
    return float(_gaps(one[None], two[None])[0])


def _gaps(one: FloatArray, two: FloatArray) -> FloatArray:
    """The distances (n,) of convex polygons, segments or points (n, k, 2) and (n, m, 2)."""
    gap = np.minimum(_corner_gap(one, two), _corner_gap(two, one))
    inside = _cross(one, two) | _within(one[:, 0], two) | _within(two[:, 0], one)
    return np.where(inside, 0.0, gap)


def _sides(shape: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Starts (n, s, 2) of the sides of shapes (n, k, 2), and the ways to their ends."""
    if shape.shape[1] <= 2:
        return shape[:, :1], shape[:, -1:] - shape[:, :1]
    return shape, np.roll(shape, -1, axis=1) - shape


def _corner_gap(points: FloatArray, shape: FloatArray) -> FloatArray:
    """The least distances (n,) of points (n, k, 2) from the sides of shapes (n, m, 2)."""
    start, way = (each[:, None] for each in _sides(shape))
    to = points[:, :, None] - start
    squared = (way * way).sum(axis=-1)
    share = np.divide(
        (to * way).sum(axis=-1),
        squared,
        out=np.zeros(np.broadcast_shapes(to.shape[:-1], squared.shape)),
        where=squared > 0,
    )
    away = to - np.clip(share, 0, 1)[..., None] * way
    return np.asarray(np.linalg.norm(away, axis=-1).min(axis=(1, 2)))


def _cross(one: FloatArray, two: FloatArray) -> NDArray[np.bool_]:
    """Whether (n,) any side of one crosses one of the other."""
    (a, u), (b, v) = _sides(one), _sides(two)
    a, u, b, v = a[:, :, None], u[:, :, None], b[:, None], v[:, None]
    meet = (_turn(u, b - a) * _turn(u, b + v - a) < 0) & (_turn(v, a - b) * _turn(v, a + u - b) < 0)
    return np.asarray(meet.any(axis=(1, 2)))


def _within(points: FloatArray, shape: FloatArray) -> NDArray[np.bool_]:
    """Whether points (n, 2) are inside counter-clockwise polygons (n, k, 2)."""
    if shape.shape[1] <= 2:
        return np.zeros(len(shape), dtype=bool)
    start, way = _sides(shape)
    return np.asarray((_turn(way, points[:, None] - start) > 0).all(axis=1))


def _turn(one: FloatArray, two: FloatArray) -> FloatArray:
    return np.asarray(one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0])
