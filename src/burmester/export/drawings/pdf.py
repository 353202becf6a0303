"""PDF: the plates at 1:1 on pages of paper, to print, lay on the sheet and drill through.

Each page has a title and a ruler to check the print with.  The bytes depend on the linkage, the
options and the release of Matplotlib only.

E160 the file does not contain the linkage        E162 more pages than anybody prints
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_pdf import FigureCanvasPdf, PdfPages
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Curve
from matplotlib.text import Text
from matplotlib.transforms import Affine2D, Bbox, IdentityTransform
from pypdf import PageObject, PdfReader
from pypdf.errors import PyPdfError

from burmester.export.description import description, length_decimals, one_line
from burmester.export.drawings.drawing import (
    Item,
    Kind,
    Role,
    cross,
    halved,
    items_of_line,
    items_of_plate,
    require_items,
)
from burmester.export.drawings.pages import LETTERS, MARGIN, Page, Pages, pages_of
from burmester.export.drawings.sheet import notes_on
from burmester.export.options import Options, fault, require_equal
from burmester.export.parts.plates import Assembly, assembly_of, axis_deviation, pivots_of
from burmester.geometry.outlines import rounded_hull
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

POINT: Final = 25.4 / 72  # mm
TOLERANCE_MM: Final = 1e-5  # largest deviation of what is read back; written to 1e-6 points
FONT: Final = 1.15  # of the height of text: size of the font whose capitals have about that height
EIGHTH: Final = 0.2  # bulge above which an arc is drawn as two curves: one of an eighth of a turn
DIMENSION: Final = "#a65200"
CUT, FINE = ("#000000", 0.25), ("#777777", 0.1)  # colours, and widths in mm
INK: Final = {"mark": FINE, "dimension": (DIMENSION, 0.12)}
# Fills what is cut: Matplotlib shortens lines that are not filled at the page.
PAPER: Final = "#ffffff"
STYLE: Final[dict[Any, Any]] = {  # whatever a person's own style says
    "text.usetex": False,
    "font.family": ["DejaVu Sans"],
    "savefig.bbox": "standard",
    "pdf.compression": 6,
    "pdf.fonttype": 3,
    "path.simplify": False,
}


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the pages; raises E162."""
    assembly, pages = _pages(chosen, options)
    said = [one_line(each) for each in description(chosen, options, "mm")]
    head = [said[0].rstrip("."), notes_on(assembly)[0]]
    if assembly.assumed:
        head.append(said[-1])
    metadata = {"Title": said[0], "Creator": "burmester", "Producer": None, "CreationDate": None}
    with mpl.rc_context(STYLE), PdfPages(path, metadata=metadata) as file:
        for number, page in enumerate(pages.pages, start=1):
            figure = Figure(figsize=(pages.size[0] / 25.4, pages.size[1] / 25.4), dpi=72)
            FigureCanvasPdf(figure)
            figure.patch.set_visible(False)
            for item in _on_plates(pages, page):
                _draw(figure, item, (pages.low, pages.high) if page.tiled else None)
            for item in (*_frame(pages, page), *_head(pages, page, head, number)):
                _draw(figure, item)
            file.savefig(figure)


def _pages(chosen: Candidate, options: Options) -> tuple[Assembly, Pages]:
    assembly = assembly_of(chosen, options)
    return assembly, pages_of(assembly, length_decimals(chosen, options), options.dimensions)


def _on_plates(pages: Pages, page: Page) -> Iterable[Item]:
    """The plates of a page: crosses in holes, names, and dimension lines that are not elsewhere."""
    for part, label in zip(page.parts, page.labels, strict=True):
        plate, name = part.plate, part.plate.name
        yield from items_of_plate(plate, part.place, name)
        ends = plate.slots[:, :4].reshape(-1, 2)
        arm = max(0.8 * plate.holes[:, 2].max(initial=0.0), 0.6 * LETTERS)
        for centre in part.place.act(np.concatenate([plate.holes[:, :2], ends, plate.marks])):
            yield from cross(centre, arm, "mark", name)
        for line in part.lines:
            if (line.high >= pages.low).all() and (line.low <= pages.high).all():
                yield from items_of_line(line, name)
        yield Item("text", "name", label, name, part.label)


def _frame(pages: Pages, page: Page) -> Iterable[Item]:
    """The crosses and the border of a page that overlaps others, and the ruler."""
    for mark in page.marks:
        yield Item("circle", "mark", np.array([*mark, 4.0]))
        yield from cross(mark, 4.0, "overlap")
    if page.tiled:
        (x, y), (u, v) = pages.low, pages.high
        corners = np.array([[x, y], [u, y], [u, v], [x, v]])
        yield from _lines(np.stack([corners, np.roll(corners, -1, axis=0)], axis=1), "mark")
    length, divisions, _ = pages.ruler
    at = MARGIN + length * np.arange(divisions + 1) / divisions
    high = MARGIN + np.where(2 * np.arange(divisions + 1) % divisions == 0, 4.0, 2.0)
    low = np.full_like(at, MARGIN)
    yield Item("line", "ruler", np.array([[MARGIN, MARGIN], [MARGIN + length, MARGIN]]))
    yield from _lines(np.stack([at, low, at, high], axis=1).reshape(-1, 2, 2), "ruler")


def _lines(lines: FloatArray, role: Role) -> Iterable[Item]:
    """Lines (k, 2, 2)."""
    return (Item("line", role, ends) for ends in lines)


def _head(pages: Pages, page: Page, head: list[str], number: int) -> Iterable[Item]:
    """The title of a page, and the numbers of its ruler."""
    length, _, name = pages.ruler
    lines_of_text = [
        f"{head[0]}   scale 1:1   page {number} of {len(pages.pages)}",
        page.title + (": lay the crosses of neighbours on each other" if page.tiled else ""),
        f"Print at 100 % on {pages.paper}, not fitted to the page: the ruler is {name} long.",
        *head[1:],
    ]
    top = np.array([MARGIN, pages.size[1] - MARGIN - LETTERS])
    for row, text in enumerate(lines_of_text):
        yield Item("text", "note", top - [0, 1.7 * LETTERS * row], text=text)
    for text, way in (("0", [0.6, 2.2]), (name, [length + 1.0, 0.0])):
        yield Item("text", "note", MARGIN + np.array(way), text=text)


def _draw(figure: Figure, item: Item, clip: tuple[FloatArray, FloatArray] | None = None) -> None:
    """Draw an item; clip: two corners of the box that is drawn of it."""
    colour, width = INK.get(item.role, CUT)
    if item.kind == "text":
        centred = item.role == "dimension"
        x, y = (item.at / POINT).tolist()
        artist: Any = Text(
            x,
            y,
            item.text,
            transform=IdentityTransform(),
            fontsize=FONT * LETTERS / POINT,
            horizontalalignment="center" if centred else "left",
            verticalalignment="center" if centred else "baseline",
            color=colour,
            parse_math=False,
            clip_on=clip is not None,
        )
    else:
        artist = PathPatch(
            _curve(_divided(item)),
            transform=Affine2D().scale(1 / POINT),
            fill=item.kind != "line",
            facecolor=colour if item.kind == "arrow" else PAPER,
            edgecolor=colour,
            linewidth=width / POINT,
            capstyle="butt",
            joinstyle="round",
        )
    figure.add_artist(artist)
    if clip is not None:
        artist.set_clip_box(Bbox(np.array(clip) / POINT))


def _divided(item: Item) -> Item:
    """An item with arcs of an eighth of a turn at most; a circle is an outline then."""
    at = item.at
    if item.kind == "circle":
        at = rounded_hull(at[None, :2], at[2] / 2)
    elif item.kind != "outline":
        return item
    return item._replace(kind="outline", at=halved(at, EIGHTH))


def _curve(item: Item) -> Curve:
    """The path of a line, an arrow, or an outline, whose arcs are cubic curves."""
    if item.kind != "outline":
        return Curve(item.at, closed=False)
    start, bulge = item.at[:, :2] @ [1, 1j], item.at[:, 2]
    chord = np.roll(start, -1) - start
    rows, codes = [start[:1]], [Curve.MOVETO]
    for z, way, b in zip(start, chord, bulge, strict=True):
        first, second = way * (1 - b * b - 2j * b) / 3, way * (1 - b * b + 2j * b) / 3
        rows.append(np.array([z + first, z + way - second, z + way][0 if b else 2 :]))
        codes += [Curve.CURVE4] * 3 if b else [Curve.LINETO]
    points = np.concatenate([*rows, start[:1]])
    return Curve(np.stack([points.real, points.imag], axis=1), [*codes, Curve.CLOSEPOLY])


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the pages back and compare them; raises E160.

    Each page has its size and what is drawn on it; and the holes of each plate, put back to where
    the assembly has it, are at the pivots.  Of a plate on several pages lines may end at the edge
    of one, and are not compared.
    """
    assembly, pages = _pages(chosen, options)
    try:
        read = PdfReader(path).pages
        sizes = [np.array(page.mediabox[2:], dtype=np.float64) * POINT for page in read]
        paths = [list(_paths(page)) for page in read]
    except (PyPdfError, LookupError, TypeError, ValueError, AttributeError) as error:
        message = "what was written is no sound PDF, so nothing was kept"
        raise fault(f"its pages cannot be read: {error}", message) from None
    require_equal("the number of pages", len(read), len(pages.pages), 0)
    holes: dict[str, list[FloatArray]] = {}
    for page, size, found in zip(pages.pages, sizes, paths, strict=True):
        require_equal("the size of a page", size, pages.size, TOLERANCE_MM)
        drawn = map(_divided, (*_on_plates(pages, page), *_frame(pages, page)))
        kinds = ("outline",) if page.tiled else ("outline", "line", "arrow")
        wanted = [_with_rises(each) for each in drawn if each.kind in kinds]
        got = [each for each in found if each[0] in kinds]
        require_equal("the number of paths", len(got), len(wanted), 0)
        items = [
            own._replace(kind=kind, at=at) for own, (kind, at) in zip(wanted, got, strict=True)
        ]
        require_items(items, wanted, TOLERANCE_MM)
        for part in page.parts:
            name = part.plate.name
            own = [each.at for each in items if (each.group, each.role) == (name, "hole")]
            centres = np.array([each[:, :2].mean(axis=0) for each in own]).reshape(-1, 2)
            back = part.plate.at(assembly.drawn) @ part.place.inverse()
            holes.setdefault(name, []).append(back.act(centres))
    for joint in pivots_of(assembly):
        if joint.point is not None:
            gaps = [axis_deviation(joint, each) for name in joint.plates for each in holes[name]]
            require_equal(f"a pivot in the {joint.plates[0]}", min(gaps), 0, TOLERANCE_MM)


def _with_rises(item: Item) -> Item:
    """An outline with the rise of each arc above its chord in place of the bulge, in mm."""
    if item.kind != "outline":
        return item
    chord = np.roll(item.at[:, :2], -1, axis=0) - item.at[:, :2]
    rise = item.at[:, 2] * np.linalg.norm(chord, axis=1) / 2
    return item._replace(at=np.column_stack([item.at[:, :2], rise]))


def _paths(page: PageObject) -> Iterable[tuple[Kind, FloatArray]]:
    """What is drawn on a page, in its order: outlines with rises, lines and arrows; mm."""
    points, middles, closed = list[complex](), list[complex](), False
    content = page.get_contents()
    assert content is not None
    for operands, operator in content.operations:
        if operator in (b"m", b"l", b"c"):
            *inner, end = (np.array(operands, dtype=np.float64).reshape(-1, 2) @ [1, 1j]) * POINT
            if operator == b"m":
                points, middles, closed = [], [], False
            else:
                one, two = inner or (points[-1], end)
                middles.append((points[-1] + 3 * one + 3 * two + end) / 8)
            points.append(end)
        elif operator == b"h":
            closed = True
        elif operator in (b"S", b"B") and points:
            z = np.array(points)
            at = np.stack([z.real, z.imag], axis=1)
            if closed:
                chord, off = np.diff(z), np.array(middles) - (z[1:] + z[:-1]) / 2
                with np.errstate(invalid="ignore", divide="ignore"):
                    rise = -(off * chord.conj()).imag / np.abs(chord)
                yield "outline", np.column_stack([at[:-1], np.nan_to_num(rise)])
            else:
                yield "line" if len(z) == 2 else "arrow", at
            points = []
