"""Tables of poses: headers and numbers as people write them, two points, Parquet, rows left out."""

from __future__ import annotations

import functools
import io
import itertools
import math
import re
import sys
from collections.abc import Callable, Sequence
from decimal import Decimal
from itertools import product
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burmester.errors import InputError
from burmester.io.explain import pages
from burmester.io.reading.pose_table import POINTS
from burmester.io.reading.poses import read_task
from burmester.io.reading.tables import pose_rows
from burmester.io.reading.tables.column_words import UNITS, WORDS
from burmester.tasks.motion_task import Task
from tests.oracles.refusals import outcome, refusal
from tests.samples import share

Read = Callable[..., Task]

ROWS = "0.5,1.25,30\n-2,3.5,45.5\n4,-6,60\n7.25,8,90\n"
CSV = "x,y,angle_deg\n" + ROWS


def require_same(task: Task, other: Task, names: tuple[str, ...] | None = None) -> None:
    """The same tasks; names: of the first one, where the second has none."""
    assert task.poses.translation.tolist() == other.poses.translation.tolist()
    assert task.poses.angle.tolist() == other.poses.angle.tolist()
    for one, two in ((task.weights, other.weights), (task.exact, other.exact)):
        assert (None if one is None else one.tolist()) == (None if two is None else two.tolist())
    assert task.names == (names or other.names)
    assert task.resolution == other.resolution
    assert task.length_unit == other.length_unit


# Headers -----------------------------------------------------------------------------------

WITH_UNIT = ["{}_{}", "{} {}", "{} ({})", "{}({})", "{} [{}]", "{}[{}]", "{}/{}", "{} / {}"]
LENGTHS = {"um": "um", "µm": "um", "mm": "mm", "cm": "cm", "m": "m", "in": "in", "inch": "in"}
LENGTHS |= {"ft": "ft", "feet": "ft"}
ANGLES = {"deg": True, "degrees": True, "degree": True, "°": True, "rad": False, "radians": False}


@pytest.mark.parametrize("form", WITH_UNIT)
@pytest.mark.parametrize("change", [str.lower, str.upper, str.title])
def test_every_form_of_a_unit_is_read(read: Read, form: str, change: Callable[[str], str]) -> None:
    names = itertools.cycle(("angle", "theta", "phi", "rotation", "φ"))
    for length, angle, name in zip(LENGTHS, itertools.cycle(ANGLES), names):
        header = [form.format(*pair) for pair in (("x", length), ("y", length), (name, angle))]
        task = read(f"{','.join(map(change, header))}\n{ROWS}")
        assert task.length_unit == LENGTHS[length]
        assert task.poses.angle[1] == (np.radians(45.5) if ANGLES[angle] else 45.5)


HEADERS = [  # of x, y, angle, weight and name, in this order
    "X-Koordinate [mm];Y-Koordinate [mm];Drehwinkel [Grad];Gewicht;Stellung",
    "x in mm;y in mm;Winkel in °;Gewichtung;Punkt",
    "Pos. X (mm);Pos. Y (mm);Verdrehung [°];GEWICHT;Bezeichnung",
    "Coordonnée X (mm);Coordonnée Y (mm);Angle de rotation (degrés);Poids;Repère",
    "abscisse [mm];ordonnée [mm];orientation, °;pondération;nom",
    "Posición X [milímetros];Posición Y [mm];Ángulo de giro [grados];Peso;Punto",
    "coordenada x/mm;coordenada y/mm;angulo/°;peso;nombre",
    "Coordinata X [mm];Coordinata Y [mm];Angolo (gradi);Peso;Nome",
    "X坐标（毫米）;Y坐标（毫米）;角度（度）;权重;点名",
    "X座標[mm];Y座標[mm];回転角[°];重み;姿勢",
    "Ｘ ［ミリ］;Ｙ ［ミリ］;角度 ［度］;重み;名前",
    "X POSITION <mm>;Y-Position <mm>;Rz <deg>;Weight;Label",
    "x_mm;y_mm;Winkel°;weight;pose",
]


@pytest.mark.parametrize("header", HEADERS)
def test_headers_in_seven_languages(read: Read, header: str) -> None:
    rows = "".join(f"{row.replace(',', ';')};{k}.5;n{k}\n" for k, row in enumerate(ROWS.split(), 1))
    task = read(f"{header}\n{rows}")
    require_same(task, read(f"x_mm;y_mm;angle_deg;weight;name\n{rows}"))
    order = [3, 4, 2, 1, 0]
    text = [[line.split(";")[k] for k in order] for line in (header, *rows.split())]
    require_same(read("\n".join("\t".join(line) for line in text)), task)
    assert task.names == ("n1", "n2", "n3", "n4")


@pytest.mark.parametrize(
    "radians", ["Bogenmaß", "radiant", "radianes", "radianti", "弧度", "ラジアン"]
)
def test_radians_in_other_languages(read: Read, radians: str) -> None:
    task = read(CSV.replace("angle_deg", f"Winkel [{radians}]"))
    assert task.poses.angle[0] == 30


def test_the_page_of_e105_lists_all_that_is_understood() -> None:
    page = pages()["E105"].text
    for role, words in (WORDS | UNITS).items():  # those of y and z are those of x
        listed = re.search(rf"(?m)^- .*: `{re.escape(words)}`$", page)
        assert role in ("y", "z", *POINTS) or listed, role


def test_how_a_file_was_read_is_told(read: Read) -> None:
    text = "Titel\nNr.;X [mm];Y [mm];phi_deg;weight\n8;0,5;1;30;1\n9;1;1;40;1\n7;2;1;50;1\n"
    assert read(text).read_as == (
        "CSV with semicolons and decimal commas; header in line 2: name from `Nr.`, "
        "x from `X [mm]`, y from `Y [mm]`, angle from `phi_deg` and weight"
    )
    counted = read("No,x,y,angle_deg\n1,0,0,0\n2,1,1,40\n3,2,3,50\n")
    assert counted.read_as == "CSV with commas; header in line 1: x, y and angle_deg"
    assert read(CSV).read_as == "CSV with commas; header in line 1: x, y and angle_deg"
    task = read(ROWS.replace(",", "\t"), columns="x,y,angle_deg")
    assert task.read_as == "CSV with tabs; columns by --columns: x, y and angle_deg"
    stored = parquet({"Y": [1, 2, 3], "X": [1, 2, 4], "angle_rad": [1, 2, 3]})
    assert read(stored, ".parquet").read_as == "Parquet: Y, X and angle_rad"


@pytest.mark.parametrize("name", ["angle [grad]", "theta grad", "rotation/gon", "Winkel [gon]"])
def test_a_grad_is_a_degree_in_german_alone(read: Read, name: str) -> None:
    assert refusal(lambda: read(CSV.replace("angle_deg", name))).code == "E105"


@pytest.mark.parametrize(
    ("slip", "edit"),
    [
        ("angel_deg", "angle_deg"),
        ("rotaton (deg)", "rotation (deg)"),
        ("wieght", "weight"),
        ("Lable", "label"),
    ],
)
def test_a_slip_in_a_name_is_pointed_out(read: Read, slip: str, edit: str) -> None:
    header = f"x,y,{slip}" if "deg" in edit else f"x,y,angle_deg,{slip}"
    rows = ROWS if "deg" in edit else ROWS.replace("\n", ",2\n")
    error = refusal(lambda: read(f"{header}\n{rows}"))
    assert re.findall(r"write `([^`]*)`", str(error.help)) == [edit]
    assert read(f"{header.replace(slip, edit)}\n{rows}").poses.shape == (4,)


@pytest.mark.parametrize("name", ["angle_grad", "angle_gon", "theta [turns]", "x_nm", "Y (yd)"])
def test_another_unit_is_never_taken_for_a_slip(read: Read, name: str) -> None:
    header = CSV.split("\n")[0].replace(
        {"a": "angle_deg", "t": "angle_deg"}.get(name[0], "!"), name
    )
    header = header.replace("x", name) if name[0] == "x" else header
    header = header.replace("y", name) if name[0] == "Y" else header
    error = refusal(lambda: read(f"{header}\n{ROWS}"))
    assert error.code == "E105"
    assert "the units of" in str(error.why)
    assert "in place of '" not in str(error.help)


@pytest.mark.parametrize(
    "name", ["time", "Time (s)", "time_ms", "TIME [sec]", "frame", "Index", "Bemerkung"]
)
@pytest.mark.parametrize("place", [0, 2, 3])
def test_columns_that_count_or_clock_are_ignored(read: Read, name: str, place: int) -> None:
    lines = [line.split(",") for line in CSV.split()]
    lines = [[*cells[:place], f"{k}:,"[: 2 * k], *cells[place:]] for k, cells in enumerate(lines)]
    lines[0][place] = name
    text = "\n".join(";".join(line) for line in lines)
    task = read(text)
    require_same(task, read(CSV))
    assert [note.message for note in task.notes] == [f"the column `{name}` is passed over"]


@pytest.mark.parametrize(
    "name", ["no", "Nr.", "#", "Punkt-Nr.", "N°", "序号", "番号", "Punkt", "点名"]
)
def test_numbers_are_names_where_no_other_column_is(read: Read, name: str) -> None:
    lines = [f"{10 * k};{line}".replace(",", ";") for k, line in enumerate(CSV.split())]
    rows = "\n".join(lines[1:])
    task = read(f"{name};x;y;angle_deg\n{rows}")
    assert task.names == ("10", "20", "30", "40")
    assert task.poses.translation.tolist() == read(CSV).poses.translation.tolist()
    if known_numbers := name not in ("Punkt", "点名"):
        named = "\n".join(f"{line};n{k}" for k, line in enumerate(lines[1:]))
        task = read(f"{name};x;y;angle_deg;name\n{named}")
        assert task.names == ("n0", "n1", "n2", "n3")
        assert [note.message for note in task.notes] == [f"the column `{name}` is passed over"]
    counted = rows
    for k in (4, 3, 2, 1):
        counted = counted.replace(f"{10 * k};", f"{k};", 1)
    task = read(f"{name};x;y;angle_deg\n{counted}")
    assert task.names == (None if known_numbers else ("1", "2", "3", "4"))


def test_two_columns_of_one_role_are_refused_in_all_words(read: Read) -> None:
    for pair in (("angle_deg", "phi (rad)"), ("name", "label"), ("x", "X [mm]")):
        others = [name for name in ("x", "y", "angle_deg") if name not in pair]
        error = refusal(lambda pair=pair, others=others: read(",".join([*pair, *others]) + "\n"))
        assert error.code == "E108"


# Numbers -----------------------------------------------------------------------------------

READ = [  # a cell, the separator around it, and the only number it can mean
    ("1,234.5", ";", "1234.5"),
    ("1.234,5", ";", "1234.5"),
    ("-1.234.567,25", ";", "-1234567.25"),
    ("1'234.5", ",", "1234.5"),
    ("1’234.5", ",", "1234.5"),
    ("1\u00a0234.5", ",", "1234.5"),
    ("1\u202f234,5", ";", "1234.5"),
    ("1\u2009234\u2009567", ";", "1234567"),
    ('"1,234.5"', ",", "1234.5"),
]
WRITTEN = [  # a cell, the separator around it, and the number that its author had in mind
    ("1 234.5", ",", "1234.5"),
    ("1,234,567", ";", "1234567"),
    ("1.234.567", ",", "1234567"),
    ("1_000", ",", "1000"),
    ('"1.234,5"', ",", "1234.5"),
    ('"0,435"', ",", "0.435"),
    ("\u20133", ",", "-3"),
    ("\u20143.5", ",", "-3.5"),
    ("\u20100,25", ";", "-0.25"),
    ("1e\u20133", ",", "0.001"),
    ("30°", ",", "30"),
    ("30,5°", ";", "30.5"),
    ("12 mm", ",", "12"),
    ("-1e3 rad", ",", "-1000"),
    ("5%", ",", "0.05"),
    ("12,5 %", ";", "0.125"),
    ("1/2", ",", "0.5"),
    ("-1 3/4", ",", "-1.75"),
    ("\u0663\u0664", ",", "34"),
    ("\uff11.\uff15", ",", "1.5"),
]


@pytest.mark.parametrize(("cell", "separator", "meant"), WRITTEN)
def test_a_number_in_other_words_is_refused_and_the_help_says_the_right_one(
    read: Read, cell: str, separator: str, meant: str
) -> None:
    commas = separator == ";" and cell.rfind(",") > cell.rfind(".")
    other = "0,5" if commas else "0.5"  # with the decimal mark that the number had

    def text(cell: str) -> str:
        rows = [["x", "y", "angle_rad"], ["1", cell, other], *[["1", "2", "3"]] * 3]
        return "\n".join(separator.join(row) for row in rows)

    error = refusal(lambda: read(text(cell)))
    assert error.code == "E104"
    assert str(error.where).splitlines()[0].endswith("poses.csv:2:3")
    edit = re.match(r"write ([^\s,]*(?:,\d+)?)", str(error.help))
    assert edit
    assert read(text(edit[1])).poses.translation[0, 1] == float(meant)


@pytest.mark.parametrize(("cell", "separator", "meant"), READ)
def test_thousands_are_read_where_they_have_one_meaning(
    read: Read, cell: str, separator: str, meant: str
) -> None:
    rows = [["x", "y", "angle_rad"], ["1", cell, "5"], *[["1", "2", "3"]] * 3]
    task = read("\n".join(separator.join(row) for row in rows))
    assert task.poses.translation[0, 1] == float(meant)
    (note,) = task.notes
    assert note.message == f"`{cell.strip(chr(34))}` is read as {meant}"
    other = "0,5" if cell.rfind(".") > cell.rfind(",") else "0.5"
    if {".", ","} & {*cell[-4:]} and separator == ";":  # with another decimal mark it is refused
        rows[2][0] = other
        assert refusal(lambda: read("\n".join(map(separator.join, rows)))).code == "E104"


@pytest.mark.parametrize("cell", ["1.234.5", "1.234,567.8", "1'234'5", "1'23", "01'234", "1'2345"])
def test_groups_that_are_no_thousands_are_refused(read: Read, cell: str) -> None:
    error = refusal(lambda: read(f"x;y;angle_rad\n1;{cell};3\n{ROWS.replace(',', ';')}"))
    assert error.code == "E104"


SPACES = [" ", "\u00a0", "\u202f", "\u2009", "'", "’"]


@given(
    number=st.decimals(-(10**9), 10**9, places=2),
    marks=st.tuples(st.sampled_from([*SPACES, ",", "."]), st.sampled_from([".", ","])),
    separator=st.sampled_from([",", ";", "\t", "|", " "]),
    minus=st.sampled_from(["-", "\u2212", "\u2013"]),
    quote=st.sampled_from(["", '"']),
)
@settings(max_examples=share(400), deadline=None)
def test_a_number_is_read_as_it_was_meant_or_refused(  # noqa: PLR0917
    read: Read, number: Decimal, marks: tuple[str, str], separator: str, minus: str, quote: str
) -> None:
    cell = f"{number:,.2f}".replace(",", "_").replace(".", marks[1])
    cell = quote + cell.replace("_", marks[0]).replace("-", minus) + quote
    text = separator.join(("x", "y", "angle_rad")) + "\n"
    text += "".join(separator.join((cell, "2", "3")) + "\n" for _ in range(3))
    result = outcome(lambda: read(text))
    if isinstance(result, InputError):
        assert result.code in {"E104", "E106"}
    else:
        assert result.poses.translation[0, 0] == float(number)


def test_what_no_double_holds_is_the_nearest_one(read: Read) -> None:
    half = "1.00000000000000011102230246251565404236316680908203125"  # between two doubles
    task = read(f"x,y,angle_rad\n{half},{half}1,3e-324\n9007199254740993,0,0\n2,2,2\n")
    assert task.poses.translation.tolist()[:2] == [[1.0, 1.0000000000000002], [2.0**53, 0.0]]
    assert task.poses.angle[0] == 5e-324


def test_errors_of_a_spreadsheet_are_no_comments(read: Read) -> None:
    for fault in ("#N/A", "#REF!", "#DIV/0!", "#VALUE!", "#NAME?", "#NUM!", "#NULL!"):
        error = refusal(lambda fault=fault: read(CSV + f"{fault},1,2\n"))
        assert (error.code, "spreadsheet" in str(error.why)) == ("E104", True)
    assert read(CSV + "#N/Axx\n#NAME\n# #REF!\n").poses.shape == (4,)


# A header that the file lacks ----------------------------------------------------------------


@pytest.mark.parametrize(
    ("separator", "mark"),
    [pair for pair in product([",", "\t", ";", "|", " ", "   "], ".,") if pair != (",", ",")],
)
@pytest.mark.parametrize("end", ["", "\n", "\r\n", "\n\n  \n"])
def test_pasted_cells_with_columns_are_the_file_with_a_header(
    separator: str, mark: str, end: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = [row.split(",") for row in ROWS.split()]
    pasted = "\r\n".join(separator.join(row).replace(".", mark) for row in rows) + end
    stdin = SimpleNamespace(buffer=io.BytesIO(pasted.encode()))
    monkeypatch.setattr(sys, "stdin", stdin)
    task = read_task("-", columns="X, Y, Angle (deg)")
    assert task.poses.translation.tolist() == [[float(r[0]), float(r[1])] for r in rows]
    assert task.poses.angle.tolist() == np.radians([float(r[2]) for r in rows]).tolist()


def test_the_help_for_a_missing_header_gives_columns_that_work(read: Read) -> None:
    for rows in (ROWS, ROWS.replace(",", ";").replace(".", ","), ROWS.replace(",", " ")):
        error = refusal(lambda rows=rows: read(rows))
        assert error.code == "E105"
        columns = re.findall(r"--columns (\S+)", str(error.help))[0]
        require_same(read(rows, columns=columns), read(CSV))
    rows = "0 0 3 4\n1 0 4 4\n0 1 3 5\n"
    names = re.findall(r"`([pq,xy]+)`", str(refusal(lambda: read(rows)).help))[0]
    assert read(rows, columns=names).poses.angle[0] == pytest.approx(math.atan2(4, 3))


def test_faults_in_columns_are_shown_there(read: Read) -> None:
    error = refusal(lambda: read(ROWS, columns="x,y,angel_deg"))
    assert (error.code, "`angle_deg`" in str(error.help)) == ("E105", True)
    error = refusal(lambda: read(ROWS, columns="x,y_mm,angle_deg"))
    assert (error.code, str(error.where).splitlines()[0]) == ("E108", "--columns:1:3")
    error = refusal(lambda: read(ROWS, columns="x,y,angle"))
    assert (error.code, str(error.where).splitlines()[0]) == ("E110", "--columns:1:5")
    error = refusal(lambda: read(ROWS, columns="x,y,angle_deg,weight"))
    assert (error.code, str(error.where).splitlines()[0][-4:]) == ("E106", ":1:12"[-4:])


def test_a_header_behind_a_hash_is_shown(read: Read) -> None:
    rows = ROWS.replace(",", " ")
    error = refusal(lambda: read(f"# x y angle_deg\n{rows}"))
    header = re.findall(r"delete the # in front of `([^`]*)`", str(error.help))[0]
    require_same(read(f"{header}\n{rows}"), read(CSV))


def test_a_header_with_blanks_between_its_names_and_in_them(read: Read) -> None:
    for header in ("x (mm) y (mm) theta (deg)", "x [mm]  y [mm]  phi [deg]", "x/mm y/mm angle/°"):
        text = f"{header}\n{ROWS.replace(',', ' ')}"
        require_same(read(text), read(f"x_mm,y_mm,angle_deg\n{ROWS}"))


def test_the_separator_that_the_first_line_states_is_taken(read: Read) -> None:
    for stated in ("sep=;", "SEP=;", '"sep=;"', "sep=;,,"):
        require_same(read(f"{stated}\n{CSV.replace(',', ';')}"), read(CSV))
        error = refusal(lambda stated=stated: read(f"{stated}\nx;y;angle_deg;a,b,c\n1;2;3;4\n"))
        assert (error.code, str(error.where).splitlines()[0][-5:]) == ("E107", ":2:15")


@pytest.mark.parametrize("row", ["1;2;3", "1\t2\t3", "1|2|3"])
def test_a_header_with_another_separator_than_its_rows(read: Read, row: str) -> None:
    rows = f"{row}\n" * 3
    error = refusal(lambda: read(f"x,y,angle_deg\n{rows}"))
    assert error.code == "E106"
    header = re.findall(r"write the header as `([^`]*)`", str(error.help))[0]
    assert read(f"{header}\n{rows}").poses.translation.tolist() == [[1, 2]] * 3


# Titles, units below the header, encodings ---------------------------------------------------

TITLES = ["Lid of the box, 12 May", "Drawing;4711;rev. B;;", "", "Scale 1:2", "# a comment"]


@pytest.mark.parametrize("count", [1, 2, 4, 5])
@pytest.mark.parametrize("header", ["x;y;angle_deg", "Punkt;X [mm];Y [mm];Winkel [°]"])
def test_titles_above_the_header_are_passed_over_and_said(
    read: Read, count: int, header: str
) -> None:
    cells = ROWS.replace(",", ";").splitlines()
    rows = [f"P{k};{row}" if "P" in header else row for k, row in enumerate(cells)]
    table = "\n".join([header, *rows])
    task = read("\n".join([*TITLES[:count], table]))
    require_same(task, read(table))
    (note,) = task.notes
    last = {1: "line 1", 2: "lines 1 to 2", 4: "lines 1 to 4", 5: "lines 1 to 5"}[count]
    assert note.message.startswith(f"{last} above the header")
    assert read(table).notes == ()


@pytest.mark.parametrize("row", ["1;2;3", "1,5;2;3", "1;2;3;4", "0.5;1e3;-3", "P1;1;2;3;zu"])
def test_no_row_of_numbers_is_taken_for_a_title(read: Read, row: str) -> None:
    error = refusal(lambda: read(f"{row}\nx;y;angle_deg\n{ROWS.replace(',', ';')}"))
    assert error.code == "E105"
    error = refusal(lambda: read(f"x;y;spin\n{row}\nx;y;angle_deg\n{ROWS.replace(',', ';')}"))
    assert error.code == "E105"
    assert str(error.where).splitlines()[0].endswith(":1:1")


def test_the_line_that_is_meant_for_a_header_is_the_one_that_is_told(read: Read) -> None:
    error = refusal(lambda: read(f"A title\nx;y;angle_deg;speed\n{ROWS.replace(',', ';')}"))
    assert (error.code, str(error.where).splitlines()[0][-5:]) == ("E107", ":2:15")


@pytest.mark.parametrize(
    ("header", "units", "meant"),
    [
        ("x,y,angle", "mm,mm,°", "x_mm,y_mm,angle_deg"),
        ("x,y,Winkel", "[mm],[mm],[Grad]", "x_mm,y_mm,angle_deg"),
        ("x,y,angle", "m,m,rad", "x_m,y_m,angle_rad"),
        ("x_mm,y_mm,angle", ",,deg", "x_mm,y_mm,angle_deg"),
        ("x_mm,y_mm,angle", "mm,mm,deg", "x_mm,y_mm,angle_deg"),
    ],
)
def test_units_below_the_header_are_read(read: Read, header: str, units: str, meant: str) -> None:
    task = read(f"{header}\n{units}\n{ROWS}")
    require_same(task, read(f"{meant}\n{ROWS}"))
    assert [note.message for note in task.notes] == ["line 2 is read as the units of the columns"]


@pytest.mark.parametrize(
    ("header", "units", "code", "place"),
    [
        ("x_mm,y_mm,angle", "cm,cm,deg", "E108", ":2:1"),
        ("x,y,angle", "mm,cm,deg", "E108", ":2:4"),
        ("x,y,angle_deg", "mm,,", "E108", ":2:4"),
        ("x,y,angle_rad", ",,deg", "E108", ":2:3"),
        ("x,y,angle", "mm,mm,grad", "E104", ":2:1"),
        ("x,y,angle", "mm,mm,5", "E104", ":2:1"),
    ],
)
def test_units_that_contradict_or_are_none_are_refused(
    read: Read, header: str, units: str, code: str, place: str
) -> None:
    error = refusal(lambda: read(f"{header}\n{units}\n{ROWS}"))
    assert (error.code, str(error.where).splitlines()[0][-4:]) == (code, place)


@pytest.mark.parametrize("top", ["a,b,c", "px,py,qx", "x,y,angle_rad", "Title\n\nhor,ver,turn"])
def test_columns_replaces_what_stands_above_the_rows(read: Read, top: str) -> None:
    task = read(f"{top}\n{ROWS}", columns="y,x,angle_deg")
    require_same(task, read(ROWS, columns="y,x,angle_deg"))
    (note,) = task.notes
    assert "above the first row" in note.message


@pytest.mark.parametrize("row", ["1,two,3", "1,2", "#N/A,2,3", "nan,2,3"])
def test_columns_never_takes_a_row_with_a_fault_for_a_header(read: Read, row: str) -> None:
    error = refusal(lambda: read(f"{row}\n{ROWS}", columns="x,y,angle_deg"))
    assert error.code in ("E103", "E104", "E106")
    assert str(error.where).splitlines()[0].partition(".csv:")[2].startswith("1:")


@pytest.mark.parametrize("word", ["Grö\xdfe", "\xb5m", "d\xe9but", "fin \xab1\xbb", "a\xa0b"])
def test_ansi_text_is_read_and_said(read: Read, word: str) -> None:
    text = f"name;x;y;Winkel [°]\n{word};0,5;1,25;30\nb;-2;3;45\nc;4;5;60\n"
    task = read(text.encode("cp1252"))
    require_same(task, read(text))
    (note,) = task.notes
    assert "Windows-1252" in note.message


@pytest.mark.parametrize("byte", [b"\x81", b"\x8f", b"\x07", b"\x1b", b"\xa4", b"\xae"])
def test_bytes_that_are_no_letters_are_refused(read: Read, byte: bytes) -> None:
    text = f"name,x,y,angle_deg\n\xe4?,{ROWS}".encode("cp1252").replace(b"?", byte)
    assert refusal(lambda: read(text)).code == "E101"


# Poses left out ------------------------------------------------------------------------------

LONG = ["x,y,angle_deg,weight,name,exact"]
LONG += [f"{k}.5,{k * k},{7 * k},{k + 1},n{k},{'x' if k in (2, 5) else ''}" for k in range(9)]


@given(left=st.sets(st.integers(0, 8), max_size=6), by_name=st.booleans(), apart=st.booleans())
@settings(max_examples=share(60), deadline=None)
def test_leaving_a_pose_out_is_deleting_its_line(
    read: Read, left: set[int], by_name: bool, apart: bool
) -> None:
    words = [f"n{k}" if by_name else str(k + 1) for k in sorted(left)]
    drop = words if apart else [", ".join(words)] if words else []
    kept = [LONG[0], *(line for k, line in enumerate(LONG[1:]) if k not in left)]
    require_same(read("\n".join(LONG), drop=drop), read("\n".join(kept)))


def test_marks_by_number_count_the_poses_of_the_file(read: Read) -> None:
    lines = [line.rpartition(",")[0] for line in LONG]
    task = read("\n".join(lines), drop=["2", "n4"], exact=["3,n8"])
    assert task.exact is not None
    assert np.array(task.names)[task.exact].tolist() == ["n2", "n8"]
    error = refusal(lambda: read("\n".join(lines), drop=["3"], exact=["n2"]))
    assert (error.code, "pose 3" in error.message) == ("E108", True)


@pytest.mark.parametrize("word", ["0", "10", "n9", "", "-1", "1.0", "n"])
def test_a_pose_that_is_not_there_cannot_be_left_out(read: Read, word: str) -> None:
    error = refusal(lambda: read("\n".join(LONG), drop=[word]))
    assert error.code == "E122"
    edit = re.findall(r"as in (--drop) (\S+)", str(error.help))[0]
    assert read("\n".join(LONG), drop=[edit[1]]).names == tuple(f"n{k}" for k in range(1, 8))


def test_a_number_that_is_another_poses_name_is_refused(read: Read) -> None:
    text = "pose,x,y,angle_deg\n" + "".join(f"{k},{k},0,{k}\n" for k in range(6))
    assert refusal(lambda: read(text, drop=["3"])).code == "E122"
    assert read(text.replace("pose", '"#pose"'), drop=["3"]).poses.angle[2] == np.radians(3)


# Two points ----------------------------------------------------------------------------------


def moved(
    rng: np.random.Generator, count: int, scale: float, body: Sequence[complex]
) -> tuple[Any, Any, Any]:
    """Two points of a body in random poses, as complex numbers, and its rotations."""
    turn = np.exp(1j * rng.uniform(-np.pi, np.pi, count))
    shift = scale * (rng.normal(size=count) + 1j * rng.normal(size=count))
    return shift + turn * body[0], shift + turn * body[1], turn


def as_points(p: Any, q: Any, form: Callable[[float], str] = repr) -> str:
    rows = np.stack([p.real, p.imag, q.real, q.imag], axis=1).tolist()
    return "px,py,qx,qy\n" + "".join(",".join(map(form, row)) + "\n" for row in rows)


@pytest.mark.parametrize("comment", ["", "# by hand\n"])
def test_two_points_of_a_moved_body_give_its_rotation(read: Read, comment: str) -> None:
    rng = np.random.default_rng(5)
    for _ in range(20):
        body = rng.normal(size=4) @ np.array([[1, 0], [1j, 0], [0, 1], [0, 1j]])
        p, q, turn = moved(rng, 12, 10.0 ** rng.integers(-3, 4), body)
        task = read(as_points(p, q) + comment)
        assert task.poses.translation.tolist() == np.stack([p.real, p.imag], axis=1).tolist()
        direction = turn * (body[1] - body[0]) / abs(body[1] - body[0])
        off = abs(np.exp(1j * task.poses.angle) - direction)
        size = np.maximum(abs(p), abs(q)) / abs(body[1] - body[0])
        assert (off <= 1e-15 * (4 + 4 * size)).all()


def test_the_spread_of_the_distance_measures_the_noise(read: Read) -> None:
    rng = np.random.default_rng(6)
    p, q, _ = moved(rng, 4000, 50, (3 + 1j, 83 - 1j))
    noise = 0.03 * (rng.normal(size=(4, 4000)))
    p, q = p + noise[0] + 1j * noise[1], q + noise[2] + 1j * noise[3]
    task = read(as_points(p, q, "{:.4f}".format))
    position, angle = (r / math.sqrt(3) for r in task.resolution)
    assert position == pytest.approx(0.03, rel=0.03)
    exact = np.angle(q - p - noise[2] - 1j * noise[3] + noise[0] + 1j * noise[1])
    seen = np.angle(np.exp(1j * (task.poses.angle - exact)))
    assert angle == pytest.approx(float(np.std(seen)), rel=0.05)
    stated = read(as_points(p, q, "{:.4f}".format), pose_sigma=(0.5, 0.25))
    assert stated.resolution == pytest.approx((math.sqrt(3) * 0.5, math.sqrt(3) * 0.25))


def test_digits_alone_give_the_resolution_of_rounded_points(read: Read) -> None:
    rng = np.random.default_rng(7)
    for _ in range(50):
        p, q, _ = moved(rng, 30, 50, (0, 80))
        task = read(as_points(p, q, "{:.2f}".format))
        assert task.resolution == pytest.approx((0.005, 2 * 0.005 / 80), rel=1e-3)
    whole = read("px,py,qx,qy\n0,0,3,4\n1,1,6,1\n2,2,-1,-2\n")
    assert whole.resolution == (0, 0)


def test_every_digit_of_a_double_is_no_noise(read: Read) -> None:
    rng = np.random.default_rng(8)
    for _ in range(50):
        p, q, _ = moved(rng, 8, 1e3, (0, 2.5))
        assert max(read(as_points(p, q)).resolution) < 1e-11


def test_the_help_for_points_that_are_not_rigid_works(read: Read) -> None:
    good = ["0,0,3,4", "1.5,-2,5.5,1", "10,0.25,7,4.25", "2,2,2,7"]
    for bad in ("1,1,1,1", "1,1,1,7", "0,0,4.4,0", "5,5,5,1000"):
        for place in range(4):
            lines = ["px,py,qx,qy", *good[:place], "", bad, *good[place:]]
            error = refusal(lambda lines=lines: read("\n".join(lines)))
            assert error.code == "E111"
            assert str(error.where).splitlines()[0].endswith(f"poses.csv:{place + 3}:1")
            number = re.findall(r"--drop (\d+)", str(error.help))[0]
            task = read("\n".join(lines), drop=[number])
            names = tuple(str(k) for k in range(1, 6) if k != int(number))
            require_same(task, read("\n".join(["px,py,qx,qy", *good])), names)


def test_the_second_bad_row_is_told_by_its_number_in_the_file(read: Read) -> None:
    text = "px,py,qx,qy\n0,0,3,4\n1,1,1,1\n1.5,-2,5.5,1\n0,0,9,0\n2,2,2,7\n0,5,0,0\n"
    for second, edit in (("9,0", "--drop 4"), ("0,0", "--drop 4")):
        error = refusal(lambda second=second: read(text.replace("9,0", second), drop=["2"]))
        assert (error.code, edit in str(error.help)) == ("E111", True)
        assert str(error.where).splitlines()[0].endswith("poses.csv:5:1")
    assert read(text, drop=["2", "4"]).poses.shape == (4,)


def test_points_may_vary_by_ten_percent_and_not_more(read: Read) -> None:
    text = "px,py,qx,qy\n0,0,10,0\n0,0,0,{}\n1,1,11,1\n"
    assert read(text.format("10.99")).poses.shape == (3,)
    error = refusal(lambda: read(text.format("11.01")))
    assert "10 apart in row 1 and 11.01 apart in row 2" in str(error.why)


@pytest.mark.parametrize("far", ["1e308", "1.7976931348623157e308"])
def test_points_at_the_ends_of_the_numbers(read: Read, far: str) -> None:
    error = refusal(lambda: read(f"px,py,qx,qy\n{far},{far},-{far},-{far}\n0,0,1,0\n0,1,0,2\n"))
    assert error.code == "E111"
    small = "px,py,qx,qy\n0,0,5e-324,0\n0,0,0,5e-324\n1,1,1.5,1\n0,0,-5e-324,0\n"
    assert refusal(lambda: read(small)).code == "E111"
    assert read(small, drop=["3"]).poses.angle.tolist() == [0, math.pi / 2, math.pi]


@pytest.mark.parametrize("block", [1, 20, 1 << 20])
def test_points_are_the_same_from_all_blocks(
    read: Read, monkeypatch: pytest.MonkeyPatch, block: int
) -> None:
    rng = np.random.default_rng(9)
    p, q, _ = moved(rng, 25, 5, (0, 3))
    text = as_points(p, q).replace(",", ";").replace(".", ",")
    whole = read(text)
    monkeypatch.setattr(pose_rows, "BLOCK", block)
    require_same(read(text), whole)


# Parquet -------------------------------------------------------------------------------------


def parquet(columns: dict[str, Any], **options: Any) -> bytes:
    sink = io.BytesIO()
    pq.write_table(pa.table(columns), sink, **options)
    return sink.getvalue()


lengths = st.floats(-1e50, 1e50)  # others are refused
doubles = st.lists(st.tuples(lengths, lengths, st.floats(-1e9, 1e9)), min_size=3, max_size=9).map(
    lambda rows: [*rows, (1.0, 0.0, 0.0)]  # a length that is not tiny
)


@given(rows=doubles, group=st.integers(1, 9))
@settings(max_examples=share(60), deadline=None)
def test_every_double_comes_back_bit_by_bit(
    read: Read, rows: list[tuple[float, float, float]], group: int
) -> None:
    x, y, angle = zip(*rows, strict=True)
    data = parquet({"x": x, "y": y, "angle_rad": angle}, row_group_size=group)
    task = read(data, ".parquet")
    got = np.column_stack([task.poses.translation, task.poses.angle])
    assert got.tobytes() == np.array(rows).tobytes()


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.int8, np.int32, np.uint16, np.int64])
def test_other_kinds_of_numbers_are_exact_and_known_by_their_shortest_digits(
    read: Read, kind: Any
) -> None:
    rng = np.random.default_rng(4)
    values = (rng.integers(-100, 100, size=(6, 3)) / 8).astype(kind)
    values[0] = (kind(3.1), kind(2), kind(1))
    columns = {name: values[:, k] for k, name in enumerate(("x", "y", "phi (rad)"))}
    task = read(parquet(columns | {"weight": [1.0625] * 6}), ".parquet")
    got = np.column_stack([task.poses.translation, task.poses.angle])
    assert got.tolist() == [[float(value) for value in row] for row in values]
    text = "x,y,phi (rad)\n" + "".join(
        ",".join(re.sub(r"\.0$", "", str(value)) for value in row) + "\n" for row in values
    )
    assert task.resolution == read(text).resolution


def test_the_same_table_in_both_formats(read: Read) -> None:
    listed = [line.split(",") for line in LONG[1:]]
    columns: dict[str, Any] = {
        "X [mm]": pa.array([Decimal(row[0]) for row in listed], pa.decimal128(20, 6)),
        "time_s": [0.1 * k for k in range(9)],
        "y_mm": pa.array([int(row[1]) for row in listed], pa.int32()),
        "Theta (deg)": [float(row[2]) for row in listed],
        "weight": [int(row[3]) for row in listed],
        "label": pa.array([row[4] for row in listed]).dictionary_encode(),
        "exact": [bool(row[5]) for row in listed],
        "#note": [{"a": [1]}] * 9,
    }
    text = "\n".join(["x_mm,y_mm,angle_deg,weight,name,exact", *LONG[1:]])
    require_same(read(parquet(columns), ".parquet", drop=["n3"]), read(text, drop=["4"]))


@pytest.mark.parametrize(
    ("change", "code", "place"),
    [
        ({"y": [1.0, None, 3.0]}, "E103", ": row 2, column y"),
        ({"y": pa.array([None] * 3, pa.float64())}, "E103", ": row 1, column y"),
        ({"y": pa.array([None, 1, 2], pa.int64())}, "E103", ": row 1, column y"),
        ({"x": [1.0, 2.0, float("inf")]}, "E103", ": row 3, column x"),
        ({"x": [True, False, True]}, "E104", ": column x"),
        ({"x": ["1", "2", "3"]}, "E104", ": column x"),
        ({"x": [[1], [2], [3]]}, "E104", ": column x"),
        ({"exact": ["yes", "no", "perhaps"]}, "E104", ": row 3, column exact"),
        ({"speed": [1, 2, 3]}, "E107", ": column speed"),
        ({"X": [1, 2, 3]}, "E108", ": column X"),
        ({"px": [1, 2, 3]}, "E108", ": column px"),
        ({"angle_rad": None, "angle": [1, 2, 3]}, "E110", ": column angle"),
        ({"y": None}, "E105", ""),
    ],
)
def test_what_parquet_cannot_mean_is_refused(
    read: Read, change: dict[str, Any], code: str, place: str
) -> None:
    columns: dict[str, Any] = {"x": [1, 2, 3], "y": [1, 2, 3], "angle_rad": [1, 2, 3]} | change
    data = parquet({name: values for name, values in columns.items() if values is not None})
    error = refusal(lambda: read(data, ".parquet"))
    assert error.code == code
    assert str(error.where).endswith(f"poses.parquet{place}")


@pytest.mark.parametrize("column", ["x", "name", "exact"])
def test_text_in_parquet_that_is_no_text_is_told_with_its_row(read: Read, column: str) -> None:
    damaged = pa.array([b"", b"", b"\xc8\xff"])
    text = pa.Array.from_buffers(pa.string(), 3, damaged.buffers())
    columns = {name: [1.0, 2.0, 4.0] for name in ("x", "y", "angle_rad")} | {column: text}
    error = refusal(lambda: read(parquet(columns), ".parquet"))
    if column == "x":
        assert error.code == "E104"
        assert error.where.endswith("column x")
    else:
        assert error.code == "E101"
        assert error.where.endswith(f"row 3, column {column}")
    del columns[column]  # as the help says
    assert error.code == "E104" or len(read(parquet(columns), ".parquet").poses.angle) == 3


FAR = 2**63 - 1  # as a date it lies 292 thousand million years ahead, or 292 years
TEMPORAL = [pa.date64(), pa.time64("us"), pa.time64("ns")]
TEMPORAL += [pa.timestamp(unit, zone) for unit in ("ms", "us", "ns") for zone in (None, "UTC")]
TEMPORAL += [pa.timestamp("us", "Nowhere/Land"), *(pa.duration(unit) for unit in ("s", "ms", "us"))]
FAR_TIMES = {str(kind): pa.array([0, FAR, -FAR], pa.int64()).view(kind) for kind in TEMPORAL}
FAR_TIMES["date32"] = pa.array([0, 2**31 - 1, 1 - 2**31], pa.int32()).view(pa.date32())
FAR_TIMES["list"] = pa.ListArray.from_arrays([0, 1, 2, 3], FAR_TIMES["date32"])
FAR_TIMES["struct"] = pa.StructArray.from_arrays([FAR_TIMES["date64[ms]"]], ["day"])


@pytest.mark.parametrize("kind", FAR_TIMES)
@pytest.mark.parametrize("column", ["x", "angle_rad", "weight", "name", "exact", "#", "#k", "time"])
def test_times_that_python_cannot_hold_are_refused_where_they_matter(
    read: Read, column: str, kind: str
) -> None:
    columns = {name: [1.0, 2.0, 4.0] for name in ("x", "y", "angle_rad")}
    result = outcome(lambda: read(parquet(columns | {column: FAR_TIMES[kind]}), ".parquet"))
    if column in ("#k", "time"):
        assert isinstance(result, Task)
    elif column in ("#", "name"):  # some of these dates are of this age
        assert isinstance(result, Task) or result.code == "E101"
    else:
        assert isinstance(result, InputError)
        assert result.code in ("E101", "E104")
        assert str(result.where).endswith(f"column {column}")


def test_without_pyarrow_there_is_help(read: Read, monkeypatch: pytest.MonkeyPatch) -> None:
    data = parquet({"x": [1], "y": [1], "angle_rad": [1]})
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    error = refusal(lambda: read(data))
    assert (error.code, error.help) == ("E130", 'pip install "burmester[data]"')


# Files ---------------------------------------------------------------------------------------


def test_the_nearest_name_is_offered(tmp_path: Path) -> None:
    (tmp_path / "poses.csv").write_text(CSV)
    for name in ("pose.csv", "poses", "posse.csv", "Poses.CSV ", ""):
        path = tmp_path / name if name else tmp_path
        error = refusal(functools.partial(read_task, path))
        assert error.code == "E101"
        meant = re.findall(r"read (\S+) if that is meant", str(error.help))
        assert meant == [str(tmp_path / "poses.csv")]
        assert read_task(meant[0]).poses.shape == (4,)
    assert "if that is meant" not in str(refusal(lambda: read_task(tmp_path / "q.json")).help)


def test_the_help_for_a_spreadsheet_works(read: Read, monkeypatch: pytest.MonkeyPatch) -> None:
    for start in (b"PK\x03\x04", b"\xd0\xcf\x11\xe0", b"%PDF-1.7"):
        error = refusal(lambda start=start: read(start + bytes(40), ".xlsx"))
        assert error.code == "E101"
        columns = re.findall(r"burmester synthesize - --columns ([^\s`]+)", str(error.help))[0]
        stdin = SimpleNamespace(buffer=io.BytesIO(ROWS.replace(",", "\t").encode()))
        monkeypatch.setattr(sys, "stdin", stdin)
        require_same(read_task("-", columns=columns), read(CSV))


LONG_NAMES = [
    "a" + "_" * 50_000 + "b c",
    "x " * 50_000,
    "x(" * 50_000,
    "é" * 100_000,
    "x,y," * 50_000,
]
LONG_CELLS = ["1e" * 50_000, "1." * 50_000, "1 " * 50_000, "9" * 300_000, "1e-" + "9" * 5000 + "%"]


@pytest.mark.parametrize("text", LONG_NAMES + [f"x,y,angle_deg\n1,{cell},3" for cell in LONG_CELLS])
def test_long_names_and_cells_are_refused_at_once(read: Read, text: str) -> None:
    error = refusal(lambda: read(text))
    assert len(str(error)) < 2000
