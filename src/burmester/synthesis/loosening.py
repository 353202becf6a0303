"""The limits that a task states, one by one, and how far each is loosened to let a linkage in.

Loosened is one limit alone: a region of pivots, a length, the kinds of dyads, a requirement, a
keep-out region.  The numbers of the looser limit are rounded to the safe side: the linkage for
which it is loosened keeps it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, Literal, TypeAlias, final

import numpy as np

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Region, Segment, box
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.requirements import TYPES
from burmester.tasks.surroundings import KeepOut
from burmester.verdicts.explanation import above, below
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import figure, listed

__all__ = ["Loosening", "StatedLimit", "loosened", "stated_limits", "without"]

LimitKind: TypeAlias = Literal[
    "fixed pivot", "moving pivot", "length", "kinds", "transmission", "link ratio", "type",
    "driver", "order", "footprint", "margin", "keep-out", "within",
]  # fmt: skip
PIVOTS: Final = ("fixed pivot", "moving pivot")
PLACES: Final = (
    181  # number of places between the poses at which pivots, body and links are looked at
)
DIGITS: Final = 2  # with which an amount is told; the looser limit is rounded by as many
DIRECTIONS: Final = 8  # number of directions in which a keep-out region is moved out of the way
HALVINGS: Final = 30  # number of steps that find how far
FEEL: Final = 1e-3  # of what moves; how much farther a region is moved than the places ask for
SIDES: Final = (("further left", "x"), ("lower", "y"), ("further right", "x"), ("higher", "y"))


@final
@dataclass(frozen=True, slots=True)
class StatedLimit:
    """One limit of a task; number: of the dyad's limits, or of the keep-out region, from 0."""

    kind: LimitKind
    number: int = 0


@final
@dataclass(frozen=True, slots=True, eq=False)
class Loosening:
    """One limit of a task loosened, the others as they are.

    message: what is looser, and by how much; option: what to type, or to write in the file.
    size: how much, in motion sizes, radians or as the logarithm of a ratio; 1 for what is allowed
        or not.
    task: with the looser limit.  found: a linkage that keeps all but that limit of the task as
        stated, judged by it.
    """

    limit: StatedLimit
    message: str
    option: str
    size: float
    task: Task
    found: FoundLinkage


def stated_limits(task: Task) -> Iterator[StatedLimit]:
    """Every limit and requirement that a task states."""
    asked, around = task.requirements, task.surroundings
    for number, limits in enumerate(task.limits):
        if limits.fixed_pivot is not None:
            yield StatedLimit("fixed pivot", number)
        if limits.moving_pivot is not None:
            yield StatedLimit("moving pivot", number)
        if limits.has_length:
            yield StatedLimit("length", number)
    if any({"RR", "PR", "RP"} - limits.kinds for limits in task.limits):
        yield StatedLimit("kinds")
    if asked.transmission_deg:
        yield StatedLimit("transmission")
    if math.isfinite(asked.link_ratio):
        yield StatedLimit("link ratio")
    if asked.types is not None:
        yield StatedLimit("type")
    if asked.driver != "any":
        yield StatedLimit("driver")
    if not asked.any_order:
        yield StatedLimit("order")
    if asked.footprint is not None:
        yield StatedLimit("footprint")
    if around is not None:
        if around.margin or around.link_width or around.body_in_plane:
            yield StatedLimit("margin")
        for number in range(len(around.keep_out)):
            yield StatedLimit("keep-out", number)
    if asked.within is not None or asked.within_deg is not None:
        yield StatedLimit("within")


def without(task: Task, limit: StatedLimit, room: Callable[[str], Polygon | None]) -> Task:
    """The task without one of its limits.

    room: for "fixed pivot" and "moving pivot", a box in which pivots are looked for instead of
    everywhere.
    """
    number = limit.number
    if limit.kind in PIVOTS:
        name = limit.kind.replace(" ", "_")
        one, wide = task.limits[number], room(limit.kind)
        region = _around(getattr(one, name), wide)
        return _with_limits(task, number, **{name: region}, kinds=one.allowed)  # no new sliders
    if limit.kind == "length":
        return _with_limits(task, number, length=(0.0, math.inf))
    if limit.kind == "kinds":
        every = tuple(replace(each, kinds=each.kinds | {"RR", "PR", "RP"}) for each in task.limits)
        return replace(task, limits=every)
    if limit.kind in ("margin", "keep-out"):
        around = task.surroundings
        assert around is not None
        if limit.kind == "margin":
            return replace(
                task, surroundings=replace(around, margin=0.0, link_width=0.0, body_in_plane=False)
            )
        rest = around.keep_out[:number] + around.keep_out[number + 1 :]
        none = not rest and not around.body_in_plane
        return replace(task, surroundings=None if none else replace(around, keep_out=rest))
    open_: dict[LimitKind, dict[str, object]] = {
        "transmission": {"transmission_deg": 0.0},
        "link ratio": {"link_ratio": math.inf},
        "type": {"types": None},
        "driver": {"driver": "any"},
        "order": {"any_order": True},
        "footprint": {"footprint": None},
        "within": {"within": None, "within_deg": None},
    }
    return replace(task, requirements=replace(task.requirements, **open_[limit.kind]))


def _with_limits(task: Task, number: int, **changes: object) -> Task:
    limits = list(task.limits)
    limits[number] = replace(limits[number], **changes)
    return replace(task, limits=tuple(limits))


def _around(region: Region, wide: Polygon | None) -> Polygon | None:
    """The box that holds a region and a wide box; None where there is no wide box."""
    if wide is None:
        return None
    corners = region.corners()
    points = wide.vertices if corners is None else np.concatenate([wide.vertices, corners])
    return _box(points.min(axis=0), points.max(axis=0))


def loosened(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float = 1.0
) -> Loosening | None:
    """The task with one limit loosened so far that a linkage keeps it; None where it needs nothing.

    size: of the motion.  share: how much of the way, above 1 for some room to spare.
    """
    if limit.kind in PIVOTS:
        return _pivots(task, limit, found, size, share)
    if limit.kind == "footprint":
        region = task.requirements.footprint
        assert region is not None
        points = np.concatenate(list(_swept_pivots(found)))
        told = _grown(region, points, share, task)
        if told is None:
            return None
        new, away, words, _ = told
        asked = replace(task.requirements, footprint=new)
        option = f"--footprint {_region_text(new)}"
        words = f"a footprint that reaches {words}"
        return Loosening(
            limit, words, option, away / size, replace(task, requirements=asked), found
        )
    if limit.kind == "length":
        return _length(task, limit, found, size, share)
    if limit.kind == "kinds":
        return _kinds(task, limit, found)
    if limit.kind == "keep-out":
        return _moved_away(task, limit, found, size, share)
    if limit.kind == "margin":
        return _margin(task, limit, found, size, share)
    return _requirement(task, limit, found, size, share)


def _dyads_of(task: Task, number: int, found: FoundLinkage) -> tuple[Dyad, ...]:
    """The dyads that a task's limits with this number are for."""
    both = found.linkage.first, found.linkage.second
    return both if len(task.limits) == 1 else both[number : number + 1]


def _pivots(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """Room for the pivots of a linkage."""
    fixed = limit.kind == "fixed pivot"
    name = "fixed_pivot" if fixed else "moving_pivot"
    region = getattr(task.limits[limit.number], name)
    holds = RR | RP if fixed else RR | PR
    dyads = _dyads_of(task, limit.number, found)
    points = [getattr(dyad, name) for dyad in dyads if isinstance(dyad, holds)]
    told = _grown(region, np.array(points), share, task) if points else None
    if told is None:
        return None
    new, away, words, near = told
    changed = _with_limits(task, limit.number, **{name: new})
    texts = [_region_text(getattr(each, name)) for each in changed.limits]
    option = " ".join(f"--{name.replace('_', '-')} {text}" for text in texts)
    x, y = (_plain(value) for value in near)
    what = f"{limit.kind}s" if len(dyads) > 1 else f"the {limit.kind}{_whose(task, limit.number)}"
    words = f"{what} {words}, near ({x}, {y})"
    return Loosening(limit, words, option, away / size, changed, found)


def _whose(task: Task, number: int) -> str:
    if len(task.limits) == 1:
        return ""
    return f" of the {('first', 'second')[number]} dyad"


def _grown(
    region: Region, points: FloatArray, share: float, task: Task
) -> tuple[Region, float, str, FloatArray] | None:
    """A region with room for points (k, 2), how much larger it is, in words, and the farthest point.

    None where it holds them.
    """
    nearest = _nearest(region, points)
    away = np.linalg.norm(points - nearest, axis=1)
    worst = int(away.argmax())
    if not away[worst] > 0:
        return None
    step = 10.0 ** (math.floor(math.log10(away[worst])) - DIGITS + 1)
    wanted = nearest + share * (points - nearest)
    low, high = np.floor(wanted / step - 1e-9) * step, np.ceil(wanted / step + 1e-9) * step
    if isinstance(region, Polygon) and _is_box(region):
        left, right = region.vertices.min(axis=0), region.vertices.max(axis=0)
        outside = away > 0
        first = np.where((wanted < left)[outside].any(axis=0), low[outside].min(axis=0), left)
        last = np.where((wanted > right)[outside].any(axis=0), high[outside].max(axis=0), right)
        words = []
        old, new = (*left, *right), (*first, *last)
        for k, (way, axis) in enumerate(SIDES):
            if (more := abs(new[k] - old[k])) > 0:
                words.append(f"{length_of(more, task)} {way}, to {axis} = {_plain(new[k])}")
        grown = _box(first, last)
        by = float(np.linalg.norm(np.array(new) - np.array(old)))
        return grown, by, listed(words), points[worst]
    by = float(away[worst]) * share
    if isinstance(region, Point):
        at = np.round(wanted[worst] / step) * step
        words = f"{length_of(float(np.linalg.norm(at - region.at)), task)} away, at {_at(at)}"
        return Point(at), by, words, points[worst]
    if isinstance(region, Line):
        shift = wanted[worst] - nearest[worst]
        grown = Line(region.start + shift, region.end + shift)
        return grown, by, f"on a line {length_of(by, task)} away", points[worst]
    import shapely  # noqa: PLC0415  seldom needed

    cells = [
        np.array([(a, b), (c, b), (c, d), (a, d)]) for (a, b), (c, d) in zip(low, high, strict=True)
    ]
    corners = np.concatenate([region.corners(), *cells])
    hull = shapely.convex_hull(shapely.multipoints(corners))
    grown = Polygon(shapely.get_coordinates(hull)[:-1])
    return grown, by, f"{length_of(by, task)} outside their region", points[worst]


def _nearest(region: Region, points: FloatArray) -> FloatArray:
    """The points (k, 2) of a region nearest to points (k, 2)."""
    if isinstance(region, Point):
        return np.broadcast_to(region.at, points.shape)
    if isinstance(region, Polygon):
        corners = region.vertices
        starts, ends = corners, np.roll(corners, -1, axis=0)
        inside = region.signed_distance(points) <= 0
    else:
        starts, ends, inside = region.start[None], region.end[None], np.zeros(len(points), bool)
    along = ends - starts
    share = ((points[:, None] - starts) * along).sum(axis=-1) / (along * along).sum(axis=-1)
    if not isinstance(region, Line):
        share = share.clip(0, 1)
    feet = starts + share[..., None] * along
    best = np.linalg.norm(feet - points[:, None], axis=-1).argmin(axis=1)
    feet = feet[np.arange(len(points)), best]
    return np.where(inside[:, None], points, feet)


def _length(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """A range of lengths that holds the links of a linkage."""
    dyads = _dyads_of(task, limit.number, found)
    radii = [float(dyad.radius) for dyad in dyads if isinstance(dyad, RR)]
    least, most = task.limits[limit.number].length
    if not radii or (least <= min(radii) and max(radii) <= most):
        return None
    words, range_ = [], [least, most]
    if min(radii) < least:
        low = _down(max(least - share * (least - min(radii)), 0.0), least - min(radii))
        range_[0] = low
        words.append(f"a link of {length_of_(low, task)} instead of at least {_plain(least)}")
    if max(radii) > most:
        high = _up(most + share * (max(radii) - most), max(radii) - most)
        range_[1] = high
        words.append(f"a link of up to {length_of_(high, task)} instead of {_plain(most)}")
    changed = _with_limits(task, limit.number, length=tuple(range_))
    texts = [_range_text(*each.length) for each in changed.limits]
    by = abs(range_[0] - least) + (range_[1] - most if math.isfinite(most) else 0.0)
    option = " ".join(f"--length {text}" for text in texts)
    whose = _whose(task, limit.number)
    return Loosening(limit, listed(words) + whose, option, by / size, changed, found)


def _kinds(task: Task, limit: StatedLimit, found: FoundLinkage) -> Loosening | None:
    """The kinds of the dyads of a linkage beside those allowed."""
    sides = (found.linkage.first, found.linkage.second)
    own = [type(dyad).__name__ for dyad in sides]
    limits = []
    for number, each in enumerate(task.limits):
        more = set(own) if len(task.limits) == 1 else {own[number]}
        limits.append(replace(each, kinds=each.kinds | more))
    new = sorted(
        {
            kind
            for each, old in zip(limits, task.limits, strict=True)
            for kind in each.kinds - old.kinds
        }
    )
    if not new:
        return None
    texts = [",".join(kind for kind in KINDS if kind in each.kinds) for each in limits]
    option = " ".join(f"--kinds {text}" for text in texts)
    words = f"a dyad of kind {listed(new, 'or')} as well"
    return Loosening(limit, words, option, 1.0, replace(task, limits=tuple(limits)), found)


def _requirement(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """A requirement that a linkage meets."""
    asked, kind = task.requirements, found.driver_first.type
    if limit.kind == "transmission":
        least = math.degrees(found.driven.least_over_range)
        if not least < asked.transmission_deg:
            return None
        angle = asked.transmission_deg - share * (asked.transmission_deg - least)
        angle = max(math.floor(10 * angle) / 10, 0.1)
        words = f"a transmission angle of {angle:g}° instead of {asked.transmission_deg:g}°"
        option = f"--min-transmission {angle:g}"
        by, new = (
            math.radians(asked.transmission_deg - angle),
            replace(asked, transmission_deg=angle),
        )
    elif limit.kind == "link ratio":
        links = found.linkage.links
        if links is None:
            return None
        ratio = max(map(float, links)) / min(map(float, links))
        if ratio <= asked.link_ratio:
            return None
        text = above(asked.link_ratio + share * (ratio - asked.link_ratio))
        words = f"a longest link of {text} times the shortest instead of {asked.link_ratio:g}"
        option, by = f"--link-ratio {text}", math.log(float(text) / asked.link_ratio)
        new = replace(asked, link_ratio=float(text))
    elif limit.kind == "type":
        if asked.allows(kind):
            return None
        types = frozenset({*(asked.types or ()), kind})
        names = ",".join(name for name in (*TYPES, "grashof", "non-grashof") if name in types)
        words = f"type {kind} as well"
        option = f'--type "{names}"' if " " in names else f"--type {names}"
        by, new = 1.0, replace(asked, types=types)
    elif limit.kind == "driver":
        words, option = "any driver", "--driver any"
        by, new = 1.0, replace(asked, driver="any")
    elif limit.kind == "order":
        words, option = "the poses in another order", "--any-order"
        by, new = 1.0, replace(asked, any_order=True)
    else:
        return _within(task, limit, found, size)
    return Loosening(limit, words, option, by, replace(task, requirements=new), found)


def _within(task: Task, limit: StatedLimit, found: FoundLinkage, size: float) -> Loosening | None:
    """Errors that a linkage keeps."""
    asked = task.requirements
    worst, turned = found.error.worst, math.degrees(float(found.error.angle.max()))
    text, angle = (
        above(max(worst, asked.within or 0.0)),
        above(max(turned, asked.within_deg or 0.0)),
    )
    new = replace(asked, within=float(text), within_deg=float(angle))
    words = f"errors of up to {length_of_(float(text), task)} and {angle}°"
    by = (float(text) - (asked.within or 0.0)) / size
    option = f"--within {text} --within-angle {angle}"
    return Loosening(limit, words, option, by, replace(task, requirements=new), found)


def _margin(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """Less room about what moves: a smaller margin, or thinner links."""
    around = task.surroundings
    assert around is not None
    if not around.margin or found.clearance is None or not found.clearance.least > 0:
        return None
    least = float(found.clearance.least)
    if least >= around.margin:
        return None
    margin = float(below(max(around.margin - share * (around.margin - least), 0.0)))
    words = f"a margin of {length_of_(margin, task)} instead of {_plain(around.margin)}"
    by = (around.margin - margin) / size
    changed = replace(task, surroundings=replace(around, margin=margin))
    return Loosening(limit, words, f"margin = {margin:g}", by, changed, found)


def _moved_away(
    task: Task, limit: StatedLimit, found: FoundLinkage, size: float, share: float
) -> Loosening | None:
    """A keep-out region moved out of the way of a linkage, the shortest way."""
    import shapely  # noqa: PLC0415  only tasks with surroundings need it

    around = task.surroundings
    assert around is not None
    one = around.keep_out[limit.number]
    swept = _swept(task, found)
    if swept is None:
        return None
    room = around.margin + FEEL * size
    parts = shapely.get_parts(swept)
    region, best = shapely.Polygon(one.polygon.vertices), None
    (x0, y0, x1, y1), (u0, v0, u1, v1) = shapely.bounds(region), shapely.bounds(swept)
    far = float(np.hypot(max(x1, u1) - min(x0, u0), max(y1, v1) - min(y0, v0))) + room
    for angle in np.arange(DIRECTIONS) * 2 * math.pi / DIRECTIONS:
        way = np.round([math.cos(angle), math.sin(angle)], 12)
        low, high = 0.0, 2 * far
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            at = shapely.Polygon(one.polygon.vertices + middle * way)
            clear = float(shapely.distance(parts, at).min()) > room
            low, high = (low, middle) if clear else (middle, high)
            if best is not None and low >= best[0]:
                break
        if best is None or high < best[0]:
            best = high, way
    assert best is not None
    away = _up(best[0] * share, best[0])
    shift = best[1] * away
    step = 10.0 ** (math.floor(math.log10(away)) - DIGITS)
    shift = np.sign(shift) * np.ceil(np.abs(shift) / step - 1e-6) * step
    regions = list(around.keep_out)
    regions[limit.number] = KeepOut(Polygon(one.polygon.vertices + shift), one.name)
    changed = replace(task, surroundings=replace(around, keep_out=tuple(regions)))
    name = around.names[limit.number]
    words = f"{name} moved by ({_plain(shift[0])}, {_plain(shift[1])})"
    if found.clearance is not None and found.clearance.touches:
        words += f", or out of the way of {found.clearance.part}"
    option = f"keep-out {name}: add ({_plain(shift[0])}, {_plain(shift[1])}) to its corners"
    return Loosening(limit, words, option, away / size, changed, found)


def _places(found: FoundLinkage) -> Displacement | None:
    """Places (PLACES,) of the coupler between the poses, or None where it does not go there."""
    driven = found.driven
    ends = driven.parameter[np.isfinite(driven.parameter)]
    if not len(ends) or driven.circuit < 0:
        return None
    circuits = Circuits.of(found.driver_first, as_given=True)
    parameter = np.linspace(ends.min(), ends.max(), PLACES)
    return circuits[driven.circuit].couplers(parameter)


def _swept_pivots(found: FoundLinkage) -> Iterator[FloatArray]:
    """All pivots (*, 2) in F, the moving ones wherever they come between the poses."""
    places = _places(found)
    for dyad in (found.linkage.first, found.linkage.second):
        if isinstance(dyad, RR | RP):
            yield np.asarray(dyad.fixed_pivot)[None]
        if isinstance(dyad, RR | PR) and places is not None:
            yield np.asarray(places.act(dyad.moving_pivot))


def _swept(task: Task, found: FoundLinkage) -> object | None:
    """Where the body and the links come between the poses, as a Shapely geometry."""
    import shapely  # noqa: PLC0415  only tasks with surroundings need it

    from burmester.clearance.moving_parts import bars_of  # noqa: PLC0415  the same

    places, around = _places(found), task.surroundings
    if places is None or around is None:
        return None
    own = found.driver_first
    bars = bars_of(own, places).reshape(-1, 2, 2)
    bars = bars[np.isfinite(bars).all(axis=(1, 2))]
    shapes = [shapely.buffer(shapely.linestrings(bars), max(around.link_width / 2, 1e-9))]
    if task.body is not None:
        shapes.append(shapely.polygons(places[:, None].act(task.body.vertices)))
    return shapely.union_all(np.concatenate(shapes))


def _is_box(region: Polygon) -> bool:
    """Whether a polygon is a box with sides along X and Y."""
    v = region.vertices
    return len(v) == 4 and bool(((v == np.roll(v, -1, axis=0)).sum(axis=1) == 1).all())


def _box(low: FloatArray, high: FloatArray) -> Polygon:
    made = box(low.tolist(), high.tolist())
    assert isinstance(made, Polygon)
    return made


def _up(value: float, amount: float) -> float:
    """The value rounded up, by the digits of an amount."""
    step = 10.0 ** (math.floor(math.log10(amount)) - DIGITS + 1)
    return float(f"{math.ceil(value / step - 1e-9) * step:.12g}")


def _down(value: float, amount: float) -> float:
    step = 10.0 ** (math.floor(math.log10(amount)) - DIGITS + 1)
    return float(f"{max(math.floor(value / step + 1e-9) * step, 0.0):.12g}")


def _plain(value: float) -> str:
    """A number with the digits that it has, up to six."""
    return f"{float(value) + 0.0:.6g}"


def length_of_(value: float, task: Task) -> str:
    """A length with the digits that it has, and its unit."""
    return _plain(value) + (f" {task.length_unit}" if task.length_unit else "")


def _at(point: FloatArray) -> str:
    return f"({_plain(point[0])}, {_plain(point[1])})"


def _region_text(region: Region | None) -> str:
    """A region as the command line states it."""
    if region is None:
        return "any"

    def points(rows: FloatArray) -> str:
        return ":".join(",".join(f"{float(value) + 0.0:.12g}" for value in row) for row in rows)

    if isinstance(region, Point):
        return points(region.at[None])
    if isinstance(region, Line | Segment):
        return f"{type(region).__name__.lower()}:{points(np.stack([region.start, region.end]))}"
    if _is_box(region):
        v = region.vertices
        return f"box:{points(np.stack([v.min(axis=0), v.max(axis=0)]))}"
    return f"polygon:{points(region.vertices)}"


def _range_text(least: float, most: float) -> str:
    if (least, most) == (0.0, math.inf):
        return "any"
    return f"{least:.12g}:" + (f"{most:.12g}" if math.isfinite(most) else "")
