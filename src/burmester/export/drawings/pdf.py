"""PDF: the plates at 1:1 on pages of paper, to print, lay on the sheet and drill through.

Each page has a title and a ruler to check the print with.  The bytes depend on the linkage, the
options and the release of Matplotlib only.

E160 the file does not contain the linkage        E162 more pages than anybody prints
"""

from __future__ import annotations

import math
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

from burmester.export.description import description, length_decimals
from burmester.export.drawings.pages import LETTERS, MARGIN, Page, Pages, pages_of
from burmester.export.drawings.pdf_paths import read_pages
from burmester.export.drawings.sheet import notes_on
from burmester.export.escaping import pdf_text
from burmester.export.options import Options
from burmester.export.parts.holes import axis_deviation, pivots_of
from burmester.export.parts.outlines import slot_outline
from burmester.export.parts.plate import moved
from burmester.export.parts.plates import assembly_of
from burmester.export.reference import fault, require_equal
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

POINT: Final = 25.4 / 72  # mm
TOLERANCE_MM: Final = 1e-5  # largest deviation of what is read back; written to 1e-6 points
FONT: Final = 1.15  # of the height of text: size of the font whose capitals have about that height
INK: Final = {"cut": ("#000000", 0.25), "fine": ("#777777", 0.1), "dimension": ("#a65200", 0.12)}
PAPER: Final = (
    "#ffffff"  # fills what is cut: Matplotlib shortens lines that are not filled at the page
)
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
    assembly = assembly_of(chosen, options)
    pages = pages_of(assembly, length_decimals(chosen, options), options.dimensions)
    said = [pdf_text(each) for each in description(chosen, options, "mm")]
    head = [said[0].rstrip("."), notes_on(assembly)[0]]
    if assembly.assumed:
        head.append(said[-1])
    metadata = {"Title": said[0], "Creator": "burmester", "Producer": None, "CreationDate": None}
    with mpl.rc_context(STYLE), PdfPages(path, metadata=metadata) as file:
        for number, page in enumerate(pages.pages, start=1):
            figure = Figure(figsize=(pages.size[0] / 25.4, pages.size[1] / 25.4), dpi=72)
            FigureCanvasPdf(figure)
            _draw(figure, pages, page, head, number)
            file.savefig(figure)


def _draw(figure: Figure, pages: Pages, page: Page, head: list[str], number: int) -> None:
    clip = (pages.low, pages.high) if page.tiled else None
    for part, label in zip(page.parts, page.labels, strict=True):
        outline, holes, slots, marks = moved(part.plate, part.place)
        for rows in (outline, *map(slot_outline, slots)):
            _stroke(figure, _curve(rows), "cut", clip, PAPER)
        for x, y, diameter in holes.tolist():
            _stroke(figure, Curve.circle((x, y), diameter / 2), "cut", clip, PAPER)
        ends = slots[:, :4].reshape(-1, 2)
        for centre in (*holes[:, :2], *ends, *marks):
            arm = max(0.8 * part.plate.holes[:, 2].max(initial=0.0), 0.6 * LETTERS)
            _stroke(figure, _cross(centre, arm), "fine", clip)
        for line in part.lines:
            if clip and _apart(np.stack([line.low, line.high]), *clip):
                continue
            _stroke(figure, _lines(line.lines), "dimension", clip)
            for arrow in line.arrows:
                _stroke(figure, Curve(arrow, closed=False), "dimension", clip, INK["dimension"][0])
            _text(figure, line.text, line.at, clip, centred=True)
        _text(figure, part.label, label, clip)
    for mark in page.marks:
        _stroke(figure, _cross(mark, 4.0), "cut", None)
        _stroke(figure, Curve.circle(mark, 2.0), "fine", None)
    if page.tiled:
        (x, y), (u, v) = pages.low, pages.high
        frame = np.array([[[x, y], [u, y]], [[u, y], [u, v]], [[u, v], [x, v]], [[x, v], [x, y]]])
        _stroke(figure, _lines(frame), "fine", None)
    _frame(figure, pages, page, head, number)


def _apart(points: FloatArray, low: FloatArray, high: FloatArray) -> bool:
    """Whether the box around points (n, 2) is apart from a box."""
    return bool((points.max(axis=0) < low).any() or (points.min(axis=0) > high).any())


def _frame(figure: Figure, pages: Pages, page: Page, head: list[str], number: int) -> None:
    """The title and the ruler of a page."""
    _, height = pages.size
    top = height - MARGIN - LETTERS
    length, divisions, name = pages.ruler
    lines_of_text = [
        f"{head[0]}   scale 1:1   page {number} of {len(pages.pages)}",
        page.title + (": lay the crosses of neighbours on each other" if page.tiled else ""),
        f"Print at 100 % on {pages.paper}, not fitted to the page: the ruler is {name} long.",
        *head[1:],
    ]
    for row, text in enumerate(lines_of_text):
        _text(figure, text, np.array([MARGIN, top - 1.7 * LETTERS * row]), None)
    start = np.array([MARGIN, MARGIN])
    lines = [[start, start + np.array([length, 0])]]
    for k in range(divisions + 1):
        at = start + np.array([length * k / divisions, 0])
        lines.append([at, at + np.array([0, 4.0 if 2 * k % divisions == 0 else 2.0])])
    _stroke(figure, _lines(np.array(lines)), "cut", None)
    _text(figure, "0", start + np.array([0.6, 2.2]), None)
    _text(figure, name, start + np.array([length + 1.0, 0]), None)


def _stroke(
    figure: Figure,
    curve: Curve,
    ink: str,
    clip: tuple[FloatArray, FloatArray] | None,
    fill: str = "",
) -> None:
    """Draw a path; fill: the colour of its inside, if it has one."""
    colour, width = INK[ink]
    patch = PathPatch(
        curve,
        transform=Affine2D().scale(1 / POINT),
        fill=bool(fill),
        facecolor=fill or "none",
        edgecolor=colour,
        linewidth=width / POINT,
        capstyle="butt",
        joinstyle="round",
    )
    figure.add_artist(patch)
    if clip is not None:
        patch.set_clip_box(Bbox(np.array(clip) / POINT))


def _text(
    figure: Figure,
    text: str,
    at: FloatArray,
    clip: tuple[FloatArray, FloatArray] | None,
    centred: bool = False,
) -> None:
    x, y = (at / POINT).tolist()
    artist = Text(
        x,
        y,
        text,
        transform=IdentityTransform(),
        fontsize=FONT * LETTERS / POINT,
        horizontalalignment="center" if centred else "left",
        verticalalignment="center" if centred else "baseline",
        color=INK["dimension" if centred else "cut"][0],
        parse_math=False,
    )
    figure.add_artist(artist)
    if clip is not None:
        artist.set_clip_box(Bbox(np.array(clip) / POINT))
        artist.set_clip_on(True)


def _cross(at: FloatArray, arm: float) -> Curve:
    return _lines(at + arm * np.array([[[-1, 0], [1, 0]], [[0, -1], [0, 1]]]))


def _lines(lines: FloatArray) -> Curve:
    """Lines (k, 2, 2), each on its own."""
    codes = [Curve.MOVETO, Curve.LINETO] * len(lines)
    return Curve(lines.reshape(-1, 2), codes)


def _curve(outline: FloatArray) -> Curve:
    """A closed outline (k, 3); an arc is cubic curves of an eighth of a turn at most."""
    points: list[complex] = [complex(*outline[0, :2])]
    codes = [Curve.MOVETO]
    for (x, y, bulge), (u, v, _) in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        start, end = complex(x, y), complex(u, v)
        if bulge == 0:
            points.append(end)
            codes.append(Curve.LINETO)
            continue
        angle = 4 * math.atan(bulge)
        centre = start + (end - start) * (0.5 + 0.25j * (1 / bulge - bulge))
        count = math.ceil(abs(angle) / (math.pi / 4))
        step = angle / count
        reach = 4 / 3 * math.tan(step / 4) * 1j
        for k in range(count):
            one = (start - centre) * complex(math.cos(k * step), math.sin(k * step))
            two = one * complex(math.cos(step), math.sin(step))
            last = end if k == count - 1 else centre + two
            points += [centre + one * (1 + reach), centre + two * (1 - reach), last]
            codes += [Curve.CURVE4] * 3
    points.append(points[0])
    codes.append(Curve.CLOSEPOLY)
    return Curve(np.array([[each.real, each.imag] for each in points]), codes)


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the pages back and compare them; raises E160.

    Each page has its size and its ruler, each plate its outline, its slots and its dimension lines;
    and the holes of each plate, put back to where the assembly has it, are at the pivots.
    """
    assembly = assembly_of(chosen, options)
    pages = pages_of(assembly, length_decimals(chosen, options), options.dimensions)
    try:
        read = read_pages(path)
    except ValueError as error:
        message = "what was written is no sound PDF, so nothing was kept"
        raise fault(str(error), message) from None
    require_equal("the number of pages", len(read), len(pages.pages), 0)
    holes: dict[str, list[FloatArray]] = {}
    for page, paths in zip(pages.pages, read, strict=True):
        require_equal("the size of a page", paths.size, pages.size, TOLERANCE_MM)
        ruler = np.array([[MARGIN, MARGIN], [MARGIN + pages.ruler[0], MARGIN]])
        require_equal("the ruler", _nearest(paths.lines, ruler), 0, TOLERANCE_MM)
        for part in page.parts:
            outline, circles, slots, _ = moved(part.plate, part.place)
            for rows in (outline, *map(slot_outline, slots)):
                if len(rows) > 2:  # otherwise it is a circle
                    off = min((_corners_off(each, rows) for each in paths.outlines), default=np.inf)
                    require_equal(f"an outline of {part.plate.name}", off, 0, TOLERANCE_MM)
            for circle in circles:
                off = np.abs(paths.circles - circle).max(axis=1).min(initial=np.inf)
                require_equal(f"a hole of {part.plate.name}", off, 0, TOLERANCE_MM)
            back = part.plate.at(assembly.drawn) @ part.place.inverse()
            holes.setdefault(part.plate.name, []).append(back.act(paths.circles[:, :2]))
            for line in part.lines if not page.tiled else ():
                for ends in line.lines:
                    off = _nearest(paths.lines, ends)
                    require_equal(f"a dimension of {part.plate.name}", off, 0, TOLERANCE_MM)
    for joint in pivots_of(assembly):
        if joint.point is not None:
            gaps = [axis_deviation(joint, each) for name in joint.plates for each in holes[name]]
            require_equal(f"a pivot in the {joint.plates[0]}", min(gaps), 0, TOLERANCE_MM)


def _nearest(lines: FloatArray, ends: FloatArray) -> float:
    """How far the nearest of lines (n, 2, 2) is from one (2, 2)."""
    return float(np.abs(lines - ends).max(axis=(1, 2)).min(initial=np.inf))


def _corners_off(read: FloatArray, outline: FloatArray) -> float:
    """How far the corners of an outline (k, 3) are from the nearest of points (n, 2)."""
    gaps = np.linalg.norm(outline[:, None, :2] - read, axis=-1)
    return float(gaps.min(axis=1).max())
