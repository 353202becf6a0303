"""Workbooks: sheets read as the same CSV would be, and nothing hostile gets through."""

import io
import re
import sys
import time
import tracemalloc
import zipfile

import numpy as np
import openpyxl
import pytest

from burmester.io.reading.poses import read_task
from burmester.io.reading.tables import workbook as reader
from tests.oracles.refusals import refusal
from tests.oracles.workbooks import (
    DATE,
    HEAD,
    MAIN,
    PERCENT,
    formula,
    number,
    of_type,
    packed,
    parts,
    sheet_xml,
    text,
    workbook,
)

POSES = [("0.5", "1.25", "30"), ("-2", "3.5", "45.5"), ("4", "-6", "60"), ("7.25", "8", "90")]
HEADER = [text(name) for name in ("X [mm]", "Y [mm]", "Winkel [°]")]
ROWS = [[number(cell) for cell in row] for row in POSES]


@pytest.fixture
def read(tmp_path):
    def read(data, suffix=".xlsx", **options):
        path = tmp_path / f"poses{suffix}"
        path.write_bytes(data)
        return read_task(path, **options)

    return read


def require_poses(task, poses=POSES):
    assert task.poses.translation.tolist() == [[float(x), float(y)] for x, y, _ in poses]
    assert task.poses.angle.tolist() == np.radians([float(angle) for *_, angle in poses]).tolist()


def changed(row, column, cell):
    """The sheet with another cell in one place, counted from 0."""
    rows = [list(cells) for cells in ROWS]
    rows[row][column] = cell
    return [HEADER, *rows]


def test_a_sheet_is_the_csv_file_of_its_cells(read):
    task = read(workbook([HEADER, *ROWS]))
    require_poses(task)
    assert task.length_unit == "mm"
    assert task.notes == ()
    assert task.read_as == (
        "sheet Tabelle1; header in row 1: x from `X [mm]`, y from `Y [mm]` and angle from "
        "`Winkel [°]`"
    )
    csv = "X [mm],Y [mm],Winkel [°]\n" + "".join(",".join(row) + "\n" for row in POSES)
    assert task.resolution == read(csv.encode(), ".csv").resolution


def test_what_a_spreadsheet_program_writes_is_read(read):
    made = openpyxl.Workbook()
    made.active.append(["Punkt", "X-Koordinate\n[mm]", "Y-Koordinate [mm]", "Drehwinkel [°]"])
    for k, row in enumerate(POSES):
        made.active.append([f"P{k}", *map(float, row)])
    data = io.BytesIO()
    made.save(data)
    task = read(data.getvalue())
    require_poses(task)
    assert task.names == ("P0", "P1", "P2", "P3")


@pytest.mark.parametrize(
    ("cell", "meant"),
    [
        (number("12.300000000000001"), "12.300000000000001"),
        (number("1E-3"), "0.001"),
        (number("1e22"), "1e22"),
        (number("0.05", PERCENT), "0.05"),
        (formula("A2*2", "2.5"), "2.5"),
        (text("2.5"), "2.5"),
        (text("2,5"), "2.5"),
        (text("\u22122,5"), "-2.5"),
        (text("1.234,5"), "1234.5"),
    ],
)
def test_a_number_is_the_one_that_is_stored_or_written(read, cell, meant):
    task = read(workbook(changed(1, 1, cell)))
    require_poses(task, [POSES[0], ("-2", meant, "45.5"), *POSES[2:]])


@pytest.mark.parametrize(
    ("cell", "code", "why"),
    [
        (number("46143", DATE), "E104", "a date or a time"),
        (formula("A2*2"), "E104", "without a stored value"),
        (formula("A2*2", "", "str"), "E104", ""),
        (formula("A2/0", "#DIV/0!", "e"), "E104", "error value"),
        (of_type("e", "#N/A"), "E104", "error value"),
        (of_type("b", "1"), "E104", "TRUE"),
        (text("about 3"), "E104", "about 3"),
        (text("1,234"), "E104", "thousands"),
        (text("12 cm"), "E108", ""),
        (number("1e999"), "E103", ""),
        (number("1e-400"), "E103", "nearer to 0"),
        (text("1e-400"), "E103", "nearer to 0"),
        (number("1_000"), "E104", ""),
        (number("\uff11"), "E104", ""),
        (None, "E104", ""),
    ],
)
def test_what_is_no_number_is_refused_with_its_cell(read, cell, code, why):
    error = refusal(lambda: read(workbook(changed(2, 1, cell))))
    assert error.code == code
    assert error.where.splitlines()[0].endswith("poses.xlsx: cell B4")
    assert why in f"{error.why}"


def test_formulas_that_give_an_empty_text_are_blank(read):
    blank = [formula('IF(A9="","",A9)', "", "str")] * 3
    require_poses(read(workbook([HEADER, *ROWS, blank, blank])))


def test_a_table_may_stand_anywhere_in_its_sheet(read):
    title = [[text("Deckel, Stand 12.5.")], []]
    shifted = [[None, None, *row] for row in [HEADER, *ROWS]]
    task = read(workbook([*title, *shifted, [], []], merged=["A1:D1"]))
    require_poses(task)
    (note,) = task.notes
    assert note.message.startswith("rows 1 to 2 above the header are passed over")
    rows = [*title, *shifted]
    rows[4] = [text("see below"), *rows[4][1:]]
    error = refusal(lambda: read(workbook(rows)))
    assert error.code == "E107"
    assert error.where.splitlines()[0].endswith("cell A5")


def test_hidden_rows_and_columns_are_read_and_said(read):
    task = read(workbook([HEADER, *ROWS], hidden=(3, 4)))
    require_poses(task)
    assert [note.message for note in task.notes] == [
        "rows 3 and 4 of the sheet are hidden, and read like the others"
    ]
    columns = f'{HEAD}<worksheet xmlns="{MAIN}"><cols><col min="2" max="2" hidden="1"/></cols>'
    hidden = sheet_xml([HEADER, *ROWS]).replace(f'{HEAD}<worksheet xmlns="{MAIN}">', columns)
    task = read(packed(parts({"A": hidden})))
    assert [note.message for note in task.notes] == [
        "column B of the sheet is hidden, and read like the others"
    ]


def test_a_cell_below_merged_ones_is_told_with_them(read):
    rows = changed(2, 1, None)
    error = refusal(lambda: read(workbook(rows, merged=["B3:B4"])))
    assert error.where.splitlines()[0].endswith("cell B4, merged with B3")


SHEETS = {
    "Notes": sheet_xml([[text("of the lid")]]),
    "Poses": sheet_xml([HEADER, *ROWS]),
    "3": sheet_xml([HEADER, *ROWS[::-1]]),
}


@pytest.mark.parametrize(("sheet", "reverse"), [("Poses", 1), ("poses", 1), ("2", 1), ("3", -1)])
def test_a_sheet_is_chosen_by_name_or_number(read, sheet, reverse):
    task = read(packed(parts(SHEETS)), sheet=sheet)
    require_poses(task, POSES[::reverse])
    assert task.notes == ()


def test_the_first_sheet_that_is_not_hidden_is_read_and_said(read):
    task = read(packed(parts(SHEETS, ("hidden", "visible", "visible"))))
    require_poses(task)
    (note,) = task.notes
    assert note.message == "the sheet Poses is read, one of 3"
    assert note.help == "choose it with --sheet Poses"
    assert refusal(lambda: read(packed(parts(SHEETS)))).code == "E105"


@pytest.mark.parametrize("sheet", ["Pose", "0", "4", "", "²"])
def test_a_sheet_that_is_not_there_is_refused(read, sheet):
    error = refusal(lambda: read(packed(parts(SHEETS)), sheet=sheet))
    assert error.code == "E101"
    assert "1 Notes, 2 Poses and 3 3" in error.why


def test_an_empty_sheet_and_a_sheet_of_a_text_file_are_refused(read):
    sheets = {"A": sheet_xml([]), "B b": SHEETS["Poses"]}
    error = refusal(lambda: read(packed(parts(sheets))))
    assert (error.code, error.help) == ("E102", 'read another sheet, such as --sheet "B b"')
    require_poses(read(packed(parts(sheets)), sheet="B b"))
    assert refusal(lambda: read(b"x,y,angle_deg\n1,2,3\n", ".csv", sheet="1")).code == "E108"


def test_columns_replaces_a_header_in_a_sheet_too(read):
    task = read(workbook([[text("a"), text("b"), text("c")], *ROWS]), columns="x,y,angle_deg")
    require_poses(task)


def test_without_openpyxl_there_is_help(read, monkeypatch):
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    error = refusal(lambda: read(workbook([HEADER, *ROWS])))
    assert error.code == "E130"
    assert "burmester[data]" in error.help


# Hostile and damaged ones ----------------------------------------------------------------------


def with_part(change, name="xl/worksheets/sheet1.xml"):
    files = parts({"A": sheet_xml([HEADER, *ROWS])})
    files[name] = change(files[name])
    return files


def declaring(entities):
    return lambda xml: xml.replace(HEAD, f"{HEAD}<!DOCTYPE worksheet [{entities}]>")


LAUGHS = "".join(
    f'<!ENTITY l{k} "{f"&l{k - 1};" * 10 if k else "lol"}">' for k in range(10)
)  # a thousand million times, if it were expanded


def behind_rows(more):
    return lambda xml: xml.replace("</sheetData>", more)


def merging(area):
    merged = f"</sheetData><mergeCells><mergeCell ref='{area}'/></mergeCells>"
    return packed(with_part(behind_rows(merged)))


def sharing(texts, row):
    """A workbook whose cells share texts, with one more row."""
    files = with_part(behind_rows(f"{row}</sheetData>"))
    files["xl/sharedStrings.xml"] = f'{HEAD}<sst xmlns="{MAIN}">{texts}</sst>'
    return packed(files)


def styled(change):
    return packed(with_part(change, "xl/styles.xml"))


AREA = "A1:XFD1048576"
SHARED = '<row r="9"><c r="A9" t="s"><v>{}</v></c></row>'
FORMAT = f"<numFmts><numFmt numFmtId='10' formatCode='{'[' * 200_000}'/></numFmts><fonts "
FAR = '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData>'
BEYOND = reader.MAX_BYTES + 5_000_000
HOSTILE = {  # those of many megabytes are made when asked for
    "entities": packed(with_part(declaring(LAUGHS))),
    "a file from outside": packed(with_part(declaring('<!ENTITY x SYSTEM "file:///etc/passwd">'))),
    "a document type in UTF-16": packed(
        with_part(lambda xml: declaring(LAUGHS)(xml).replace("UTF-8", "UTF-16").encode("utf-16"))
    ),
    "another encoding": packed(with_part(lambda xml: xml.replace("UTF-8", "cp037"))),
    "a document type in the workbook": packed(with_part(declaring(LAUGHS), "xl/workbook.xml")),
    "a bomb": lambda: packed(with_part(lambda xml: xml + " " * BEYOND)),
    "many tags": lambda: packed(with_part(behind_rows("<row/>" * 2_000_000))),
    "merged everywhere": merging(AREA),
    "merged in small letters": merging(AREA.lower()),
    "merged with dollars": merging("$A$1:$XFD$1048576"),
    "merged with characters by number": merging("&#65;1:&#x58;FD1048576"),
    "merged in pieces": merging("A1:B40000'/><mergeCell ref='C1:D40000"),
    "merged nowhere": merging("A1:B"),
    "shared texts of many megabytes": lambda: sharing(
        f"<si><t>{'a' * BEYOND}</t></si>", SHARED.format(0)
    ),
    "a long shared text": sharing(f"<si><t>{'a' * 200_000}</t></si>", SHARED.format(0)),
    "a long text in many cells": sharing(
        f"<si><t>{'a' * 90_000}</t></si>",
        "".join(f'<row><c t="s"><v>{0 * k}</v></c></row>' for k in range(400)),
    ),
    "a shared text that is not there": sharing("<si><t>a</t></si>", SHARED.format(-1)),
    "a format that takes the square of its length": styled(
        lambda xml: xml.replace("<fonts ", FORMAT)
    ),
    "many styles": styled(
        lambda xml: xml.replace("<xf numFmtId='10'/>", "").replace(
            '<xf numFmtId="10"/>', '<xf numFmtId="10"/>' * 60_000
        )
    ),
    "a row beyond the last": packed(with_part(behind_rows('<row r="1e99"><c/></row></sheetData>'))),
    "a column beyond the last": packed(
        with_part(behind_rows('<row r="9"><c r="XFE9"/></row></sheetData>'))
    ),
    "a cell far away": packed(with_part(behind_rows(FAR))),
    "packed by lzma": packed(with_part(str), zipfile.ZIP_LZMA),
    "no workbook": packed({"mimetype": "application/vnd.oasis.opendocument.spreadsheet"}),
    "no sheet": packed({k: v for k, v in with_part(str).items() if "sheet1" not in k}),
    "no XML": packed(with_part(lambda _: "sheet")),
    "cut": workbook([HEADER, *ROWS])[:700],
    "empty": b"PK\x03\x04" + bytes(40),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_and_damaged_workbooks_are_refused_at_once(read, name):
    data = HOSTILE[name]
    data = data() if callable(data) else data
    begun = time.process_time()
    error = refusal(lambda: read(data))
    assert error.code == ("E107" if name == "a cell far away" else "E101")
    assert time.process_time() - begun < 10
    assert "lollol" not in str(error)
    assert "root:" not in str(error)


def test_ranges_cost_nothing_whatever_they_span():
    """Links, rules and formulas may span the sheet: no object is made of the cells in between."""
    area = "A1:Z9999"
    formula = f'<row r="9"><c r="D9"><f t="array" ref="{area}">A1</f><v>0</v></c></row>'
    more = (
        f"{formula}</sheetData><conditionalFormatting sqref='{'A1 ' * 100_000}'/>"
        f"<dataValidations><dataValidation sqref='{'A1 ' * 100_000}'/></dataValidations>"
        f"<hyperlinks><hyperlink ref='{area}' display='x'/></hyperlinks>"
    )
    data = packed(with_part(behind_rows(more)))
    reader.read_sheet("loads", workbook([HEADER, *ROWS]), None)
    tracemalloc.start()
    source = reader.read_sheet("poses", data, None)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert source.text.endswith("\t\t\t0")
    assert peak < 5_000_000


def test_what_is_below_merged_cells_is_not_read(read):
    rows = [[*row, number("7")] for row in ROWS]
    task = read(
        workbook(
            [[*HEADER, text("#")], *rows], merged=["F1:G9", *(f"C{k}:D{k}" for k in range(1, 6))]
        )
    )
    require_poses(task)


def test_an_archive_that_lies_about_its_size_is_not_unpacked_further(read):
    """A part of many megabytes whose directory says 1,000 bytes."""
    data = bytearray(packed(with_part(lambda xml: xml + " " * BEYOND)))
    size = len(sheet_xml([HEADER, *ROWS]).encode()) + BEYOND
    lie = (1000).to_bytes(4, "little")
    truth = size.to_bytes(4, "little")
    assert truth in data
    assert refusal(lambda: read(bytes(data).replace(truth, lie))).code == "E101"


def test_pictures_links_and_macros_are_never_opened(read, monkeypatch):
    files = parts({"A": sheet_xml([HEADER, *ROWS], more='<drawing r:id="rId1" xmlns:r="x"/>')})
    files |= {
        "xl/worksheets/_rels/sheet1.xml.rels": "no XML",
        "xl/drawings/drawing1.xml": "no XML",
        "xl/media/image1.png": b"no picture",
        "xl/vbaProject.bin": b"no macro",
        "docProps/core.xml": "no XML",
    }
    data = packed(files)
    opened, original = [], zipfile.ZipFile.open

    def noting(archive, name, *given, **more):
        opened.append(name if isinstance(name, str) else name.filename)
        return original(archive, name, *given, **more)

    monkeypatch.setattr(zipfile.ZipFile, "open", noting)
    require_poses(read(data))
    assert "xl/worksheets/sheet1.xml" in opened
    assert not [n for n in opened if re.search("drawing|media|vba|docProps|sheet1.xml.rels", n)]


def test_a_large_workbook_is_refused_with_its_size(read, monkeypatch):
    monkeypatch.setattr(reader, "MAX_TAGS", 50)
    error = refusal(lambda: read(workbook([HEADER, *ROWS])))
    assert "tags" in error.why
    assert error.help == "save the sheet as CSV and read that"
