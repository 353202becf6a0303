"""The curves of an SVG file: paths and shapes with their transforms, y turned upwards.

SVG's y points down: it is turned round here, so that the upper left corner stays the origin.

E170 a drawing that cannot be read        E130 svgelements is missing
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterator
from itertools import islice
from typing import Any, Final
from xml.etree import ElementTree

import numpy as np

from burmester.errors import library
from burmester.io.reading.outlines.curves import FLATNESS, Curve, Drawing, unreadable
from burmester.numerics.arrays import FloatArray

PER_INCH: Final = 96.0  # pixels, as CSS has them
MILLIMETRES: Final = {"mm": 1.0, "cm": 10.0, "q": 0.25, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6}
FAR: Final = 1e60  # pixels; no coordinate of a drawing is as great
# What a drawing has at most, each element as often as it is used, in straight pieces: an element
# takes as long as ten of them, a curve or an arc as 5 for each of its numbers.  All take 5 s.
MAX_PIECES: Final = 200_000
MAX_STYLE: Final = 100_000  # characters of style sheets; the time grows as their square
MAX_TRANSFORM: Final = 10_000  # characters of a transform; the same
MAX_ATTRIBUTES: Final = 2_000_000  # characters of attributes that are no coordinates
MAX_DEPTH: Final = 200  # of groups in groups
MAX_CHORDS: Final = 1000  # of one arc or spline
LABEL: Final = "{http://www.inkscape.org/namespaces/inkscape}label"
HREF: Final = "{http://www.w3.org/1999/xlink}href"
PLAIN: Final = "save it as plain SVG, the outline alone"
MOST: Final = 2 * MAX_PIECES  # numbers of a command that are counted
CURVED: Final = frozenset("aAcCqQsStT")  # commands of a path that are no straight lines
ARCS: Final = frozenset({"circle", "ellipse", "rect"})  # elements with four arcs or fewer
COORDINATES: Final = frozenset({"d", "points"})
_COMMAND = re.compile(r"[A-DF-Za-df-z][^A-DF-Za-df-z]*|[^A-DF-Za-df-z]+")
_NUMBER = re.compile(r"[0-9]+\.?[0-9]*|\.[0-9]+")
_LENGTH = re.compile(r"\s*([0-9.eE+-]+)\s*([a-zA-Z%]*)\s*")


def read_svg(data: bytes, part: str | None) -> Drawing:
    """The curves of an SVG file, or those of one id; raises E170 and E130."""
    svgelements = library("svgelements", "reading SVG", "outlines")
    root = _root(data)
    try:
        unit = _with_size(root)
        sized = io.BytesIO(ElementTree.tostring(root))
        svg = svgelements.SVG.parse(sized, reify=True, ppi=PER_INCH)
        shapes = list(_shapes(svgelements, svg))
    except Exception as error:  # of many kinds, for files that are damaged
        said = str(error).partition("\n")[0][:150] or type(error).__name__
        raise unreadable(f"as SVG it is damaged: {said}", PLAIN) from None
    scale = 1.0 if unit == "px" else 25.4 / PER_INCH
    parts: dict[str, None] = {}
    chosen = []
    for path, kind, names in shapes:
        for name in names:
            parts.setdefault(name)
        if part is None or part in names:
            chosen.append((path, kind, names))
    curves = list(_curves(svgelements, chosen, scale))
    assumed = ["y points down in SVG and was turned round, so its upper left corner is the origin"]
    if unit == "px":
        assumed.append("it states no size, so a pixel counts as 1/96 inch, as CSS has it")
    return Drawing(curves, unit, "id", tuple(parts), tuple(assumed))


def _root(data: bytes) -> ElementTree.Element:
    """The root of a file that is SVG, and not too much of it."""
    if b"<!ENTITY" in data or "<!ENTITY".encode("utf-16-le") in data or b"\0" in data[:4]:
        why = "it defines entities, or is not in UTF-8"
        raise unreadable(why, PLAIN)
    try:
        root = ElementTree.fromstring(data)
    except (ElementTree.ParseError, ValueError, LookupError) as error:  # an encoding not known
        raise unreadable(f"it is not XML: {error}", "give a DXF or an SVG file") from None
    if root.tag.rpartition("}")[2] != "svg":
        raise unreadable("its root is no svg element", "give a DXF or an SVG file")
    level, depth = [root], 0
    while level:
        level, depth = [child for each in level for child in each], depth + 1
        if depth > MAX_DEPTH:
            raise unreadable(f"its groups are more than {MAX_DEPTH} deep", PLAIN)
    _require_few(root)
    return root


def _require_few(root: ElementTree.Element) -> None:
    """Refuse what is used too often, and what uses itself: E170."""
    by_id = {each.get("id"): each for each in root.iter() if each.get("id")}
    counts: dict[int, float] = {}
    pending: set[int] = set()

    def count(element: ElementTree.Element, depth: int) -> float:
        key = id(element)
        if key in counts:
            return counts[key]
        if key in pending or depth > 3 * MAX_DEPTH:
            raise unreadable("an element uses itself", PLAIN)
        pending.add(key)
        total = _pieces(element) + sum(count(child, depth + 1) for child in element)
        if element.tag.rpartition("}")[2] == "use":
            target = by_id.get((element.get("href") or element.get(HREF) or "").removeprefix("#"))
            if target is not None:
                total += count(target, depth + 1)
        pending.discard(key)
        counts[key] = total
        return total

    if count(root, 0) > MAX_PIECES:
        why = f"it is as much as {MAX_PIECES} straight pieces, each as often as it is used"
        raise unreadable(why, PLAIN)
    sheets = sum(len(each.text or "") for each in root.iter() if each.tag.endswith("style"))
    named = (pair for each in root.iter() for pair in each.items())
    attributes = sum(len(n) + len(v) for n, v in named if n not in {*COORDINATES, "href", HREF})
    transform = max(len(each.get("transform") or "") for each in root.iter())
    if sheets > MAX_STYLE or attributes > MAX_ATTRIBUTES or transform > MAX_TRANSFORM:
        why = f"it has {sheets} characters of style sheets, {attributes} of attributes"
        raise unreadable(f"{why} and {transform} of one transform", PLAIN)


def _pieces(element: ElementTree.Element) -> float:
    """How much an element is by itself, in straight pieces; counted until it is too much."""
    kind, total = element.tag.rpartition("}")[2], 10.0
    if kind in ARCS:
        total += 60
    for name in COORDINATES:
        for command in _COMMAND.finditer(element.get(name) or ""):
            letter, numbers = command[0][0], _NUMBER.finditer(command[0])
            total += 20 if letter in "zZ" else 0.5  # each looks for the last move before it
            total += (5 if letter in CURVED else 0.5) * sum(1 for _ in islice(numbers, MOST))
            if total > MAX_PIECES:
                return total
    return total


def _with_size(root: ElementTree.Element) -> str:
    """Give the root its width and height in pixels, by its view box; "mm" or "px"."""
    sizes = [_pixels(root.get(name)) for name in ("width", "height")]
    box = [
        float(number)
        for number in re.split(r"[\s,]+", (root.get("viewBox") or "").strip())
        if number
    ]
    stated = [size for size in sizes if size is not None]
    if not stated and len(box) == 4:
        lengths = box[2:]
    elif stated and len(box) == 4 and min(box[2:]) > 0:
        wide, high = (None if size is None else size[0] for size in sizes)
        shape = box[2] / box[3]
        lengths = [wide or (high or 0.0) * shape, high or (wide or 0.0) / shape]
    else:
        lengths = [size[0] if size else 1000.0 for size in sizes]
    for name, length in zip(("width", "height"), lengths, strict=True):
        root.set(name, repr(length))
    return "mm" if any(physical for _, physical in stated) else "px"


def _pixels(text: str | None) -> tuple[float, bool] | None:
    """A stated length in pixels, and whether it is one of a ruler; None for shares and none."""
    found = _LENGTH.fullmatch(text or "")
    if found is None or found[2] == "%":
        return None
    physical = MILLIMETRES.get(found[2].lower())
    length = float(found[1]) * (physical * PER_INCH / 25.4 if physical else 1.0)
    return (length, physical is not None) if length > 0 else None


def _shapes(svgelements: Any, svg: Any) -> Iterator[tuple[Any, str, tuple[str, ...]]]:
    """Paths with their kinds, and their ids and those of their groups, the nearest first."""
    stack: list[tuple[Any, tuple[str, ...]]] = [(svg, ())]
    while stack:
        element, above = stack.pop()
        values = getattr(element, "values", None) or {}
        own = values.get("attributes", {})
        names = [own.get("id") or getattr(element, "id", None), own.get(LABEL)]
        here = (*dict.fromkeys(name for name in names if name), *above)
        if isinstance(element, svgelements.Shape):
            # A rectangle that is turned keeps its transform until it is a path.
            yield abs(svgelements.Path(element)), type(element).__name__.lower(), here
        elif isinstance(element, list):
            stack += [(each, here) for each in reversed(element)]


def _curves(svgelements: Any, chosen: list[Any], scale: float) -> Iterator[Curve]:
    """The subpaths as polylines, y upwards."""
    points = [p for path, _, _ in chosen for segment in path for p in _control_points(segment)]
    xy = np.array(points, dtype=float).reshape(-1, 2)
    if not (np.abs(xy) < FAR).all():
        raise unreadable("it has a coordinate that is not finite, or too large", PLAIN)
    tolerance = FLATNESS * float(np.hypot(*np.ptp(xy, axis=0))) if len(xy) else 0.0
    for path, kind, names in chosen:
        corners: list[FloatArray] = []  # in blocks (n, 2)
        closed = False
        for segment in [*path, None]:
            if segment is None or isinstance(segment, svgelements.Move):
                if len(corners) > 1:
                    yield Curve(_upwards(corners, scale), closed, kind, names)
                corners, closed = [], False
                if segment is not None:
                    corners = [np.array(_control_points(segment)[-1:])]
            elif isinstance(segment, svgelements.Close):
                closed = True
                if len(corners) > 1:
                    yield Curve(_upwards(corners, scale), True, kind, names)
                corners, closed = corners[:1], False
            else:
                corners += _flattened(svgelements, segment, tolerance)


def _control_points(segment: Any) -> list[tuple[float, float]]:
    names = ("start", "control", "control1", "control2", "end")
    points = (getattr(segment, name, None) for name in names)
    return [(float(point.x), float(point.y)) for point in points if point is not None]


def _flattened(svgelements: Any, segment: Any, tolerance: float) -> list[FloatArray]:
    """The points behind the first one, in blocks, of chords that leave a segment by no more."""
    if isinstance(segment, svgelements.Arc):
        return [_chords(each, tolerance) for each in segment.as_cubic_curves()]
    return [_chords(segment, tolerance)]


def _chords(segment: Any, tolerance: float) -> FloatArray:
    """Chords of a line or of a Bézier curve: h²/8 of its second derivative is their error."""
    p = np.array(_control_points(segment))
    if len(p) <= 2:
        return p[-1:]
    degree = len(p) - 1
    bend = degree * (degree - 1) * float(np.hypot(*np.diff(p, 2, axis=0).T).max())
    count = MAX_CHORDS
    if bend <= 8 * tolerance * MAX_CHORDS**2:
        count = max(1, math.ceil(math.sqrt(bend / (8 * tolerance)))) if tolerance > 0 else 1
    t = np.arange(1, count + 1)[:, None] / count
    terms = [
        math.comb(degree, k) * t**k * (1 - t) ** (degree - k) * p[k] for k in range(degree + 1)
    ]
    return np.asarray(np.sum(terms, axis=0))


def _upwards(corners: list[FloatArray], scale: float) -> FloatArray:
    return np.asarray(np.concatenate(corners) * [scale, -scale] + 0.0)  # no -0
