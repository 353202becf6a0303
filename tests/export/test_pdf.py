"""Pages at 1:1, read by pypdf: holes are as far apart on paper as the links are long."""

from dataclasses import replace

import numpy as np
import pypdf
import pytest

from burmester.errors import BurmesterError, InputError
from burmester.export import Options, export
from burmester.export.drawings import pdf
from burmester.export.parts.plates import assembly_of
from tests.oracles.handed_over import GIVEN, rr, saved, scale_of, written

MM = 25.4 / 72  # of a point
# Larger ones take many pages, which take long.
SMALL = ["crank-rocker, mm", "double-rocker, in", "slot drives, um", "trammel, mm"]


def circles_on(page):
    """Centres (x + iy) and diameters in mm of closed paths of curves alone, by pypdf."""
    found, points, curves, lines = [], [], 0, 0
    for operands, operator in page.get_contents().operations:
        numbers = [float(each) for each in operands if isinstance(each, int | float)]
        if operator == b"m":
            points, curves, lines = [complex(*numbers)], 0, 0
        elif operator == b"c":
            points.append(complex(*numbers[-2:]))
            curves += 1
        elif operator == b"l":
            lines += abs(complex(*numbers) - points[-1]) > 1e-9
        elif operator == b"h" and curves >= 4 and not lines:
            middle = sum(points[:-1]) / curves
            found.append((MM * middle, 2 * MM * abs(points[0] - middle)))
    return found


def pages_of(path):
    return list(pypdf.PdfReader(path).pages)


@pytest.mark.parametrize("name", SMALL)
def test_holes_are_as_far_apart_on_paper_as_links_are_long(name, tmp_path):
    chosen, path = written(name, "pdf", tmp_path)
    pages = pages_of(path)
    hole = assembly_of(chosen, Options()).dimensions.hole
    for dyad, plate in ((chosen.linkage.first, "driver"), (chosen.linkage.second, "follower")):
        if not hasattr(dyad, "radius"):
            continue
        length = float(dyad.radius) * scale_of(chosen)
        gaps = [
            abs(abs(one - two) - length)
            for page in pages
            if plate in page.extract_text()
            for one, d in circles_on(page)
            for two, e in circles_on(page)
            if abs(d - hole) < 1e-4 * hole and abs(e - hole) < 1e-4 * hole
        ]
        assert min(gaps) < 1e-5, plate
    width, height = (float(each) * MM for each in pages[0].mediabox[2:])
    letter = chosen.unit in ("in", "ft")
    assert sorted((width, height)) == pytest.approx([215.9, 279.4] if letter else [210, 297])
    text = pages[0].extract_text()
    assert chosen.id in text
    assert "Print at 100 %" in text
    assert ("4 in" if letter else "100 mm") in text


def test_the_ruler_is_as_long_as_it_says(tmp_path):
    for name, long in (("crank-rocker, mm", 100.0), ("double-rocker, in", 101.6)):
        folder = tmp_path / name[:5]
        folder.mkdir()
        _, path = written(name, "pdf", folder)
        for page in pages_of(path):
            level, start = [], None
            for operands, operator in page.get_contents().operations:
                if operator == b"m":
                    start = [float(each) for each in operands]
                elif operator == b"l" and abs(float(operands[1]) - start[1]) < 1e-6:
                    level.append(abs(float(operands[0]) - start[0]) * MM)
            assert min(abs(np.array(level) - long)) < 1e-5


def long_one():
    """A linkage whose follower is longer than a page."""
    given = (rr([0, 0], [30, -20], 90), rr([420, 40], [410, 60], 330), "mm", (0.5, 2.0))
    return saved("", given=given)


def test_a_plate_that_is_longer_than_a_page_goes_on_pages_that_fit_together(tmp_path):
    chosen = long_one()
    (path,) = export(chosen, "pdf", tmp_path / "a.pdf")
    pages = [page for page in pages_of(path) if "follower" in page.extract_text()]
    assert len(pages) > 1
    hole = assembly_of(chosen, Options()).dimensions.hole
    # Crosses of 4 mm circles: the right ones of a page are the left ones of the next.
    marks = [[z for z, d in circles_on(page) if abs(d - 4) < 1e-5] for page in pages]
    holes = [[z for z, d in circles_on(page) if abs(d - hole) < 1e-5] for page in pages]
    first, second = (
        sorted(marks[0], key=lambda z: -z.real)[:2],
        sorted(marks[1], key=lambda z: z.real),
    )
    first.sort(key=lambda z: z.imag)
    second = sorted(second[:2], key=lambda z: z.imag)
    shifts = [one - two for one, two in zip(first, second, strict=True)]
    assert abs(shifts[0] - shifts[1]) < 1e-5
    assert shifts[0].real > 100
    # Each hole that is on a page is there where the other pages, laid on crosses, have it.
    for one, two in zip(sorted(holes[0], key=abs), sorted(holes[1], key=abs), strict=True):
        assert abs(one - (two + shifts[0])) < 1e-5
    assert abs(holes[0][0] - holes[0][1]) == pytest.approx(330, abs=1e-5)
    assert "column 1 of" in pages[0].extract_text()
    assert "crosses" in pages[0].extract_text()


def test_more_pages_than_anybody_prints_are_refused(tmp_path):
    with pytest.raises(InputError, match="more than 60 pages of A4") as caught:
        export(saved("slider drives, m"), "pdf", tmp_path / "a.pdf")
    assert caught.value.code == "E162"
    assert caught.value.help.endswith("--to dxf")
    assert not list(tmp_path.iterdir())


def test_the_same_linkage_gives_the_same_pages(tmp_path, monkeypatch):
    one = export(saved("crank-rocker, mm"), "pdf", tmp_path / "1.pdf")[0].read_bytes()
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1000000000")
    two = export(saved("crank-rocker, mm"), "pdf", tmp_path / "2.pdf")[0].read_bytes()
    assert one == two
    assert b"CreationDate" not in one


def test_pages_without_dimensions_have_the_same_holes(tmp_path):
    chosen = saved("crank-rocker, mm")
    (plain,) = export(chosen, "pdf", tmp_path / "1.pdf", Options(dimensions=False))
    (full,) = export(chosen, "pdf", tmp_path / "2.pdf")
    counts = [len(circles_on(pages_of(path)[0])) for path in (plain, full)]
    assert counts[0] == counts[1] == 8
    assert "70.71" in pages_of(full)[0].extract_text()
    assert "70.71" not in pages_of(plain)[0].extract_text()


def test_a_task_without_a_unit_says_so(tmp_path):
    chosen = saved("crank-rocker, mm")
    bare = replace(chosen, task=replace(chosen.task, length_unit=None))
    (path,) = export(bare, "pdf", tmp_path / "a.pdf")
    assert "names no unit" in " ".join(pages_of(path)[0].extract_text().split())


@pytest.mark.parametrize("what", ["link", "hole", "scale", "dimension", "garbage"])
def test_pages_that_are_not_the_linkage_are_told(what, tmp_path, monkeypatch):
    chosen, path = saved("crank-rocker, mm"), tmp_path / "a.pdf"
    first, second, unit, span = GIVEN["crank-rocker, mm"]
    options = Options()
    if what == "link":
        other = saved("", given=(first, replace(second, radius=second.radius + 1e-3), unit, span))
        pdf.write(other, path, options)
    elif what == "hole":
        pdf.write(chosen, path, Options(hole=2.201))
    elif what == "scale":
        with monkeypatch.context() as patch:
            patch.setattr(pdf, "POINT", 1.0001 * pdf.POINT)
            pdf.write(chosen, path, options)
    elif what == "dimension":
        pdf.write(chosen, path, Options(dimensions=False))
    else:
        pdf.write(chosen, path, options)
        path.write_bytes(path.read_bytes().replace(b"/Type /Pages", b"/Type /Paper"))
    with pytest.raises(BurmesterError) as caught:
        pdf.check(chosen, path, options)
    assert caught.value.code == "E160"
