"""Make the corpus: every dialect and every fault in a small file, and the key to them.

    python tests/io/corpus/make.py

Nothing of burmester is imported: the key holds the numbers below as they are written here, or the
code that a file must be refused with and where.  The files are kept as they are made.
"""

from __future__ import annotations

import gzip
import io
import json
import math
import re
import zipfile
from decimal import Decimal
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

HERE = Path(__file__).parent
KEY: dict[str, Any] = {}

POSES = [
    ["-0.8253", "-1.0329", "91.91"],
    ["-1.6554", "0", "66.99"],
    ["1e-05", "0.292", "49.9"],
    ["12.5", "-3.0625", "-17.25"],
]
RADIANS = [
    ["0.1", "-2", "0.5"],
    ["3", "0.4", "1.25"],
    ["5.75", "1", "-0.125"],
]
POINTS = [["0", "0", "3", "4"], ["1.5", "-2", "5.5", "1"], ["10", "0.25", "7", "4.25"]]
NOISY = [["0", "0", "30.1", "0"], ["5", "2", "5", "31.9"], ["1", "1", "-29", "1"]]
ROWS = "".join(",".join(row) + "\n" for row in POSES)
CSV = "x,y,angle_deg\n" + ROWS
COMMAS = CSV.replace(",", ";").replace(".", ",")


def good(
    name: str,
    content: str | bytes,
    poses: list[list[str]] = POSES,
    unit: str = "deg",
    options: dict[str, Any] | None = None,
    **more: Any,
) -> None:
    """A file that is read: poses as x, y, angle in a unit, or as px, py, qx, qy."""
    _write(name, content)
    entry: dict[str, Any] = {"unit": unit} if len(poses[0]) == 3 else {}
    entry |= {"poses": poses, **more}
    KEY[name] = entry | ({"options": options} if options else {})


def bad(
    name: str, content: str | bytes, code: str, where: str | None = "", options: Any = None
) -> None:
    """A file that is refused with a code, and the place that is told, behind its name."""
    _write(name, content)
    KEY[name] = {"refused": code} | ({} if where is None else {"where": f"{name}{where}"})
    KEY[name] |= {"options": options} if options else {}


def _write(name: str, content: str | bytes) -> None:
    assert name not in KEY, name
    (HERE / name).write_bytes(content if isinstance(content, bytes) else content.encode())


def rows(listed: list[list[str]], separator: str = ",") -> str:
    return "".join(separator.join(row) + "\n" for row in listed)


def dialects() -> None:
    good("plain.csv", CSV)
    good("no-newline-at-the-end.csv", CSV.rstrip())
    good("no-suffix", CSV)
    good("bom.csv", "\ufeff" + CSV)
    good("utf16.csv", b"\xff\xfe" + CSV.encode("utf-16-le"))
    good("utf16-big-endian.csv", b"\xfe\xff" + CSV.encode("utf-16-be"))
    good("crlf.csv", CSV.replace("\n", "\r\n"))
    good("cr.csv", CSV.replace("\n", "\r"))
    good("tabs.tsv", CSV.replace(",", "\t"))
    good("semicolons.csv", CSV.replace(",", ";"))
    good("decimal-commas.csv", COMMAS)
    good("decimal-commas-tabs.txt", COMMAS.replace(";", "\t"))
    good("sep-line.csv", "sep=;\r\n" + COMMAS.replace("\n", "\r\n"))
    good("bars.csv", CSV.replace(",", "|"))
    good("quoted.csv", re.sub(r"[^,\n]+", r'"\g<0>"', CSV))
    good("quoted-decimal-commas.csv", COMMAS.replace("91,91", '"91,91"').replace("x", '"x"'))
    good("comments.csv", "# by hand, 12 May\n" + CSV.replace("66.99\n", "66.99\n  # 1,2,3\n\n"))
    good("blank-lines-at-the-end.csv", CSV + "\n  \n\n\t\n")
    good("blank-cells-at-the-end.csv", COMMAS + ";;\n;;\n")
    good("blank-columns.csv", CSV.replace("\n", ",,\n") + ",,,,\n")
    good("blank-rows-between.csv", ",,\n" + CSV.replace("\n", "\n,,\n"))
    good("blank-cells-in-all-lines.csv", CSV.replace("\n", ",\n"))
    good("around-cells.csv", CSV.replace(",", " ,\u00a0"))
    body = "".join(" ".join(f"{float(v):.18e}" for v in row) + "\n" for row in RADIANS)
    good("savetxt.txt", "x y angle_rad\n" + body, RADIANS, "rad")
    good("blanks.txt", "  x   y  angle_deg \n" + ROWS.replace(",", "   "))
    good("blanks-decimal-commas.txt", "x y angle_deg\n" + rows(POSES, "  ").replace(".", ","))
    good("minus-sign.csv", CSV.replace("-", "\u2212"))
    good(
        "exponents.csv",
        "x,y,angle_rad\n1E-1,-.2e+1,+5.e-1\n3,4e-1,125E-2\n575e-2,1,-.125\n",
        RADIANS,
        "rad",
    )
    long = "0.1000000000000000055511151231257827021181583404541015625"
    good("many-digits.csv", CSV.replace("12.5", long), [*POSES[:3], [long, *POSES[3][1:]]])
    good(
        "tiny.csv",
        "x,y,angle_rad\n3e-324,2,3\n4,5e-324,6\n7,8,1e-310\n",
        [["3e-324", "2", "3"], ["4", "5e-324", "6"], ["7", "8", "1e-310"]],
        "rad",
    )
    good(
        "huge.csv",
        "x,y,angle_rad\n9.999999999999999e49,2,3\n4,9007199254740993,6\n7,8,9\n",
        [["9.999999999999999e49", "2", "3"], ["4", "9007199254740993", "6"], ["7", "8", "9"]],
        "rad",
    )


def headers() -> None:
    mm = {"length_unit": "mm"}
    good("upper-case.csv", CSV.replace("x,y,angle_deg", "X,Y,ANGLE_DEG"))
    good("units-underscore.csv", CSV.replace("x,y", "x_mm,y_mm"), **mm)
    good("units-round.csv", CSV.replace("x,y,angle_deg", "x (mm),y(mm),Theta (deg)"), **mm)
    good("units-square.csv", CSV.replace("x,y,angle_deg", "x [mm],y[mm],phi [°]"), **mm)
    good("units-slash.csv", CSV.replace("x,y,angle_deg", "X/mm,Y / mm,rotation/degrees"), **mm)
    good("units-blank.csv", CSV.replace("x,y,angle_deg", "x mm,y mm,angle degrees"), **mm)
    good(
        "units-blank.txt",
        "x (in) y (inch) angle (rad)\n" + rows(RADIANS, " "),
        RADIANS,
        "rad",
        length_unit="in",
    )
    good("micrometres.csv", CSV.replace("x,y", "x (\u00b5m),y (\u03bcm)"), length_unit="um")
    for unit in ("um", "cm", "m", "in", "ft"):
        good(
            f"unit-{unit}.csv",
            f"x_{unit},y_{unit},theta_rad\n{rows(RADIANS)}",
            RADIANS,
            "rad",
            length_unit=unit,
        )
    good("other-order.csv", "phi_deg,y,x\n" + rows([row[::-1] for row in POSES]))
    good(
        "time.csv",
        "Time (Seconds),Frame,#,x,y,angle_deg\n"
        + "".join(f"0.{k},,n{k},{','.join(row)}\n" for k, row in enumerate(POSES)),
        names=["n0", "n1", "n2", "n3"],
    )
    good(
        "numbered.csv",
        "No;x;y;angle_deg;#why\n"
        + "".join(f"{k + 1};{';'.join(row)};so\n" for k, row in enumerate(POSES)),
    )
    good(
        "hash-column.csv",
        "#,x,y,angle_deg\n" + "".join(f"{k}0,{','.join(row)}\n" for k, row in enumerate(POSES)),
        names=["00", "10", "20", "30"],
    )
    good(
        "names.csv",
        'x,y,angle_rad,Label\n0.1,-2,0.5, open\n3,0.4,1.25,"a, b"\n5.75,1,-0.125,07\n',
        RADIANS,
        "rad",
        names=["open", "a, b", "07"],
    )
    good(
        "weights-and-marks.csv",
        "pose;x;y;angle_rad;weight;exact\na;0,1;-2;0,5;1;yes\nb;3;0,4;1,25;2,5;\nc;5,75;1;-0,125;1e1;X\n",
        RADIANS,
        "rad",
        names=["a", "b", "c"],
        weights=["1", "2.5", "10"],
        exact=[1, 3],
    )
    good("angle-unit-option.csv", CSV.replace("_deg", ""), options={"angle_unit": "deg"})
    good("columns-option.csv", ROWS, options={"columns": "x,y,angle_deg"})
    good(
        "columns-option-cells.txt",
        rows(POSES, "\t").replace(".", ",").rstrip("\n"),
        options={"columns": "x_mm,y_mm,angle_deg"},
        **mm,
    )
    good(
        "columns-option-blanks.txt",
        rows(POSES, "  ").replace(".", ","),
        options={"columns": "x,y,theta (°)"},
    )
    good("columns-and-header.csv", CSV, options={"columns": "x,y,angle_deg"})
    good("latin1.csv", CSV.replace("angle_deg", "angle (°)").encode("latin-1"))
    good(
        "drop-option.csv",
        CSV,
        [POSES[0], *POSES[2:]],
        options={"drop": ["2"]},
        names=["1", "3", "4"],
    )
    good(
        "drop-option-names.csv",
        "name,x,y,angle_deg,weight,exact\na,-0.8253,-1.0329,91.91,1,\nbad,1,2,3,7,x\n"
        "c,1e-05,0.292,49.9,2,\nd,12.5,-3.0625,-17.25,3,yes\n",
        [POSES[0], *POSES[2:]],
        options={"drop": ["bad"]},
        names=["a", "c", "d"],
        weights=["1", "2", "3"],
        exact=[3],
    )
    good(
        "drop-and-exact-options.csv",
        CSV,
        [POSES[0], *POSES[2:]],
        options={"drop": ["2"], "exact": ["1,4"]},
        names=["1", "3", "4"],
        exact=[1, 3],
    )


def written_numbers() -> None:
    """Numbers that are not written plainly, where they have one meaning."""
    head = "x,y,angle_deg\n"
    big = [["1", "2", "3"], ["4", "1234.5", "6"], ["-7", "8.5", "9"]]
    for name, cell in (
        ("quoted", '"1,234.5"'),
        ("apostrophe", "1'234.5"),
        ("no-break", "1\u00a0234.5"),
        ("narrow", "1\u202f234.5"),
    ):
        good(f"thousands-{name}.csv", f"{head}1,2,3\n4,{cell},6\n-7,8.5,9\n", big)
    good("thousands-point.csv", "x;y;angle_deg\n1;2;3\n4;1.234,5;6\n\u22127;8,5;9\n", big)
    units = "x;y;angle\n1 mm;2mm;3\u00b0\n4 mm;1.234,5 mm;6 \u00b0\n-7 mm;8,5 mm;9\u00b0\n"
    good("cells-with-units.csv", units, big, length_unit="mm")
    bad("cells-some-with-units.csv", units.replace("2mm", "2"), "E104", ":2:1")
    bad("cells-in-two-units.csv", units.replace("2mm", "2cm"), "E108", ":2:6")
    bad("cells-against-header.csv", units.replace("angle", "angle_rad"), "E110", ":2:10")


def points() -> None:
    good("points.csv", "px,py,qx,qy\n" + rows(POINTS), POINTS, resolution=[0.005, 2 * 0.005 / 5])
    good(
        "points-mm.csv",
        "PX (mm);py_mm;qx/mm;Qy [mm];weight\n"
        + "".join(f"{';'.join(row)};2\n" for row in POINTS).replace(".", ","),
        POINTS,
        length_unit="mm",
        weights=["2", "2", "2"],
    )
    good(
        "points-noisy.csv",
        "time_s,px,py,qx,qy\n" + "".join(f"{k},{','.join(row)}\n" for k, row in enumerate(NOISY)),
        NOISY,
        resolution=[0.1 * 1.5**0.5, 0.1 * 3**0.5 / 30.1],  # |pq| is 30.1, 29.9 and 30
    )
    good(
        "points-angle-unit.csv",
        "px,py,qx,qy\n" + rows(POINTS),
        POINTS,
        options={"angle_unit": "rad"},
    )
    bad("points-same.csv", "px,py,qx,qy\n0,0,3,4\n1,2,1,2\n0,1,3,5\n", "E111", ":3:1")
    bad(
        "points-not-rigid.csv",
        "px,py,qx,qy\n0,0,3,4\n\n1,2,4,6\n0,0,6,0\n0,0,5,0\n",
        "E111",
        ":5:1",
    )
    good(
        "points-dropped.csv",
        "px,py,qx,qy\n0,0,3,4\n1.5,-2,5.5,1\n9,9,9,9\n10,0.25,7,4.25\n",
        POINTS,
        options={"drop": ["3"]},
        names=["1", "2", "4"],
    )
    bad("points-three.csv", "px,py,qx\n1,2,3\n", "E105", ":1:1")
    bad("points-and-angle.csv", "x,y,px,angle_deg\n1,2,3,4\n", "E108", ":1:5")
    bad("points-units.csv", "px_mm,py_mm,qx_mm,qy_cm\n1,2,3,4\n", "E108", ":1:19")


def faults() -> None:
    head = "x,y,angle_deg\n"
    bad("empty.csv", "", "E102")
    bad("only-blanks.csv", " \n\t\n", "E102")
    bad("only-comments.csv", "# x,y\n", "E102")
    bad("only-header.csv", head + "\n,,\n", "E102")
    bad("latin1-undefined.csv", b"x,y,angle (\x8d)\n1,2,3\n", "E101")
    bad("latin1-controls.csv", b"x,y,angle_deg,name\n1,2,3,\x07\xe4\n", "E101")
    bad("null.csv", head + "1,2\0,3\n", "E101")
    bad("utf16-without-bom.csv", CSV.encode("utf-16-le"), "E101")
    bad("utf16-cut.csv", b"\xff\xfex", "E101")
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr(zipfile.ZipInfo("xl/workbook.xml"), "<workbook/>")
    bad("sheet.xlsx", packed.getvalue(), "E101")
    bad("sheet.xls", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(64), "E101")
    bad("packed.csv", gzip.compress(CSV.encode(), mtime=0), "E101")
    bad("paper.pdf", b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n", "E101")
    for name, cell, code in (
        ("nan", "NaN", "E103"),
        ("inf", "-inf", "E103"),
        ("1e400", "1e400", "E103"),
        ("1e-400", "1e-400", "E103"),
        ("text", "seven", "E104"),
        ("empty-cell", "", "E104"),
        ("en-dash", "\u20133", "E104"),
        ("em-dash", "\u20143", "E104"),
        ("degree-sign", "30°", "E104"),
        ("unit", "12 mm", "E104"),
        ("percent", "5%", "E104"),
        ("fraction", "1/2", "E104"),
        ("mixed-fraction", "1 1/2", "E104"),
        ("thousands-blank", "1 234.5", "E104"),
        ("underscore", "1_000", "E104"),
        ("comma-quoted", '"0,435"', "E104"),
        ("arabic-digits", "\u0663", "E104"),
        ("wide-digits", "\uff13", "E104"),
        ("hexadecimal", "0x10", "E104"),
        ("spreadsheet-error", "#DIV/0!", "E104"),
    ):
        bad(f"cell-{name}.csv", f"{head}1,2,3\n4,{cell},6\n", code, ":3:3")
    bad("row-spreadsheet-error.csv", head + "1,2,3\n#N/A,2,3\n4,5,6\n", "E104", ":3:1")
    bad("comma-undecided.csv", "x;y;angle_deg\n1,234;2;3\n", "E104", ":2:1")
    bad("comma-and-point.csv", "x;y;angle_deg\n0,5;2;3\n1.5;2;3\n", "E104", ":2:1")
    bad("no-header.csv", ROWS, "E105", ":1:1")
    bad("no-header-cells.txt", rows(POSES, "\t").replace(".", ",").rstrip(), "E105", ":1:1")
    bad("header-in-comment.txt", "# x y angle_deg\n" + rows(POSES, " "), "E105", ":2:1")
    bad("other-words.csv", "hor,ver,angle_deg\n1,2,3\n", "E105", ":1:1")
    bad("slip.csv", "x,y,angel_deg\n1,2,3\n", "E105", ":1:1")
    bad("gradians.csv", "x,y,angle_grad\n1,2,3\n", "E105", ":1:1")
    bad("furlongs.csv", "x_furlong,y_furlong,angle_deg\n1,2,3\n", "E105", ":1:1")
    bad("unknown-column.csv", "x,y,angle_deg,speed\n1,2,3,4\n", "E107", ":1:15")
    bad("unnamed-first-column.csv", ",x,y,angle_deg\n0,1,2,3\n", "E107", ":2:1")
    bad("unnamed-column-holds.csv", "x,y,angle_deg,,\n1,2,3,,\n4,5,6,,7\n", "E107", ":3:8")
    bad("two-x.csv", "x,y,x_mm,angle_deg\n1,2,3,4\n", "E108", ":1:5")
    bad("two-names.csv", "name,x,y,angle_deg,label\na,1,2,3,b\n", "E108", ":1:20")
    bad("two-units.csv", "x (mm),y (cm),angle_deg\n1,2,3\n", "E108", ":1:8")
    bad("angle-without-unit.csv", CSV.replace("_deg", ""), "E110", ":1:5")
    bad("angle-unit-contradicted.csv", CSV, "E110", ":1:5", {"angle_unit": "rad"})
    bad("columns-json.json", "[]", "E108", "", {"columns": "x,y,angle_deg"})
    bad("drop-none-such.csv", CSV, "E122", "", {"drop": ["5"]})
    KEY["drop-none-such.csv"]["where"] = "--drop:1:1"
    bad("drop-too-many.csv", CSV, "E120", "", {"drop": ["1,2,3"]})
    bad("mark.csv", "x,y,angle_deg,exact\n1,2,3,maybe\n", "E104", ":2:7")
    bad("weight-nan.csv", "x,y,angle_deg,weight\n1,2,3,nan\n", "E103", ":2:7")
    bad("weight-zero.csv", "x,y,angle_deg,weight\n" + "1,2,3,0\n" * 3, "E122")
    bad("one-pose.csv", head + "1,2,3\n", "E120")


def shapes() -> None:
    head = "x,y,angle_deg\n"
    bad("decimal-commas-in-commas.csv", head + "0,8253,1,0329,91,91\n", "E106", ":2:10")
    bad("short-row.csv", CSV + "1,2\n", "E106", ":6:4")
    bad("long-row.csv", CSV + "1,2,3,4\n", "E106", ":6:7")
    bad("blank-cells-in-rows.csv", head + ROWS.replace("\n", ",\n"), "E106", ":2:23")
    weights = "x,y,angle_deg,weight\n1,2,3,1\n"
    bad("decimal-comma-for-a-weight.csv", weights + "1,5,50,120,\n", "E106", ":3:12")
    bad("decimal-comma-and-no-weight.csv", weights + "1,5,50,120\n7,8,9,\n", "E104", ":4:7")
    bad("shifted-by-a-semicolon.csv", "x;y;angle_deg;weight\n1,5;;50;120;\n", "E106", ":2:13")
    bad("shifted-by-a-tab.tsv", "x\ty\tangle_deg\tname\n1\t\t5\t50\t\n", "E106", ":2:9")
    bad("header-with-blank-cells.csv", "x,y,angle_deg,name,,\n1,50,7,,\n", "E106", ":2:9")
    bad("some-rows-with-blank-cells.csv", "x,y,angle_deg,\n1,2,3,\n4,5,6\n", "E106", ":3:6")
    bad("one-column.csv", head + "1;2;3\n", "E106", ":2:6")


def trees() -> None:
    listed = "[" + ", ".join(f"[{', '.join(row)}]" for row in POSES) + "]"
    as_json = f'{{"angle_unit": "deg", "poses": {listed}}}'
    good("poses.json", as_json)
    good("poses-bom.json", "\ufeff" + as_json)
    good("poses-no-suffix", "\n " + as_json)
    objects = [
        f'{{"x": {x}, "y": {y}, "angle_rad": {a}, "name": "n{k}", "weight": {k + 1}}}'
        for k, (x, y, a) in enumerate(RADIANS)
    ]
    good(
        "objects.json",
        f'{{"length_unit": "mm", "poses": [{", ".join(objects)}]}}',
        RADIANS,
        "rad",
        length_unit="mm",
        names=["n0", "n1", "n2"],
        weights=["1", "2", "3"],
    )
    good("poses.toml", f'angle_unit = "deg"\nposes = {listed}\n')
    good(
        "tables.toml",
        "\n".join(f"[[poses]]\nx = {x}\ny = {y}\nangle_rad = {a}" for x, y, a in RADIANS),
        RADIANS,
        "rad",
    )
    bad("comma.json", '{"poses": [[1, 2,, 3]]}', "E109", None)
    bad("nan.json", '{"angle_unit": "deg", "poses": [[1, 2, NaN]]}', "E103", None)
    bad("no-unit.json", f'{{"poses": {listed}}}', "E110", None)
    bad("short.json", '{"angle_unit": "deg", "poses": [[1, 2]]}', "E106", None)
    bad("nothing.json", "{}", "E105", None)
    bad("broken.toml", 'angle_unit = "deg"\nposes = [[1, 2, 3]', "E109", None)
    bad("inf.toml", 'angle_unit = "deg"\nposes = [[1, inf, 3]]', "E103", None)


def parquet() -> None:
    def stored(columns: dict[str, Any]) -> bytes:
        sink = io.BytesIO()
        pq.write_table(pa.table(columns), sink)
        return sink.getvalue()

    def column(j: int, kind: Any = None) -> Any:
        return pa.array([float(row[j]) for row in POSES], kind or pa.float64())

    xya = {"x": column(0), "y": column(1), "angle_deg": column(2)}
    good("doubles.parquet", stored(xya), resolution=[5e-6, math.radians(5e-3)])
    good("parquet-without-suffix", stored(xya))
    names = {"name": ["a", None, "c", "d"], "exact": [True, None, False, False]}
    good(
        "all-kinds.parquet",
        stored(
            {
                "Label": names["name"],
                "time_s": pa.array([0, 1, 2, 3], pa.timestamp("s")),
                "x (mm)": pa.array([0.5, -0.25, 3, 0.1], pa.float32()),
                "y (mm)": pa.array([1, -2, 3, 2**53 + 1], pa.int64()),
                "angle_deg": pa.array(
                    [Decimal("91.91"), Decimal("-0.10"), Decimal("7"), Decimal("1.5")],
                    pa.decimal128(10, 2),
                ),
                "weight": pa.array([1, 2, 3, 4], pa.uint8()),
                "exact": names["exact"],
            }
        ),
        [
            ["0.5", "1", "91.91"],
            ["-0.25", "-2", "-0.1"],
            ["3", "3", "7"],
            ["0.100000001490116119384765625", "9007199254740993", "1.5"],
        ],
        length_unit="mm",
        names=["a", "", "c", "d"],
        weights=["1", "2", "3", "4"],
        exact=[1],
    )
    four = {
        name: [float(row[j]) for row in POINTS] for j, name in enumerate(("px", "py", "qx", "qy"))
    }
    good("points.parquet", stored(four), POINTS)
    bad("null.parquet", stored(xya | {"y": [1.0, 2.0, None, 4.0]}), "E103", ": row 3, column y")
    bad(
        "nan.parquet",
        stored(xya | {"angle_deg": [1.0, 2.0, 3.0, float("nan")]}),
        "E103",
        ": row 4, column angle_deg",
    )
    bad("text.parquet", stored(xya | {"x": ["1", "2", "3", "4"]}), "E104", ": column x")
    bad("speed.parquet", stored(xya | {"speed": column(0)}), "E107", ": column speed")
    bad(
        "no-unit.parquet",
        stored({**{k: xya[k] for k in "xy"}, "angle": column(2)}),
        "E110",
        ": column angle",
    )
    bad("no-y.parquet", stored({"x": column(0), "angle_deg": column(2)}), "E105")
    bad("no-rows.parquet", stored({k: v[:0] for k, v in xya.items()}), "E102")
    bad("cut.parquet", stored(xya)[:400], "E101")
    broken = bytearray(stored(xya))
    broken[-300:-100] = b"\xff" * 200
    bad("broken.parquet", bytes(broken), "E101")
    bad("not-parquet.parquet", CSV, "E101")


# Three frames of two markers, as their files print them; the third marker is elsewhere.
FRAMES = [
    ["0.00", "0.00", "900.1", "3.00", "4.00", "900.0", "7.5", "1.25", "20"],
    ["1.50", "-2.00", "900.0", "5.50", "1.00", "900.1", "7.5", "1.25", "20"],
    ["10.00", "0.25", "900.1", "7.00", "4.25", "900.0", "7.5", "1.25", "20"],
]
PAIR = [[row[i] for i in (0, 1, 3, 4)] for row in FRAMES]


def recordings() -> None:
    mm, two = {"length_unit": "mm"}, {"points": "M1,M2"}
    nexus = "Trajectories\n100\n,,Lid:M1,,,Lid:M2,,,Lid:Base,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z,X,Y,Z\n"
    nexus += ",,mm,mm,mm,mm,mm,mm,mm,mm,mm\n"
    frames = [",".join(row) for row in FRAMES]
    numbered = "".join(f"{k},0,{row}\n" for k, row in enumerate(frames, start=401))
    names = ["401", "402", "403"]
    good("nexus.csv", nexus + numbered, PAIR, options=two, names=names, notes=["W213"], **mm)
    lost = nexus + numbered.replace("402,0,1.50,-2.00,900.0", "402,0,,,")
    lost += f"404,0,{frames[1]}\n405,0,{frames[2].replace('7.00', 'NaN')}\n"
    lost += f"406,0,0,0,0,{frames[0].partition('900.1,')[2]}\n"
    after = "\nDevices\n1000\n,,Force,,\nFrame,Sub Frame,Fx,Fy,Fz\n,,N,N,N\n401,0,1,2,3\n"
    good(
        "nexus-lost-markers.csv",
        f"Devices\n1000\n,,Force\nFrame,Sub Frame,Fx\n,,N\n401,0,1\n\n{lost}{after}",
        [PAIR[0], PAIR[2], PAIR[1]],
        options=two,
        names=["401", "403", "404"],
        notes=["W213"],
        **mm,
    )
    bad("nexus-not-chosen.csv", nexus + numbered, "E114", ":3:1")
    bad("nexus-unknown.csv", nexus + numbered, "E114", None, {"points": "M1,M3"})
    KEY["nexus-unknown.csv"]["where"] = "--points:1:1"
    bad("nexus-two-bodies.csv", nexus + numbered, "E111", ":8:1", {"points": "M1,Base"})
    moving = nexus + numbered.replace("900.1", "905").replace("900.0", "895")
    bad("nexus-no-plane.csv", moving, "E113", ":3:1", two)
    good(
        "nexus-plane.csv",
        moving,
        PAIR,
        options=two | {"plane": "XY"},
        names=names,
        notes=["W213"],
        **mm,
    )
    comma = nexus + numbered.replace("402,0,1.50", "402,0,1,50")
    bad("nexus-decimal-comma.csv", comma, "E106", ":7:49", two)
    word = nexus + numbered.replace("402,0,1.50", "402,0,left")
    bad("nexus-word.csv", word, "E104", ":7:7", two)
    kinds = ",Type" + ",Rigid Body" * 7 + ",Marker" * 6 + "\n,Name" + ",Lid" * 7
    kinds += ",M1" * 3 + ",M2" * 3 + "\n,ID" + ",77" * 13 + "\n,," + "Rotation," * 4
    kinds += ",".join(["Position"] * 9) + "\nFrame,Time (Seconds),X,Y,Z,W" + ",X,Y,Z" * 3 + "\n"
    good(
        "motive.csv",
        "Format Version,1.23,Take Name,Lid 3,Capture Frame Rate,120.000000,Length Units,Meters,"
        f"Coordinate Space,Global\n\n{kinds}"
        + "".join(
            f"{k},{k / 120:.6f},0.1,0.2,0.3,0.9,5,6,7,{','.join(row[:6])}\n"
            for k, row in enumerate(FRAMES)
        ),
        PAIR,
        options=two,
        names=["0", "1", "2"],
        length_unit="m",
        notes=["W213"],
    )
    trc = "PathFileType\t4\t(X/Y/Z)\tlid.trc\n"
    trc += "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n100.00\t100.00\t3\t2\tmm\n"
    trc += "Frame#\tTime\tM1\t\t\tM2\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
    tabs = ["\t".join(row[:6]) for row in FRAMES]
    trc += "".join(f"{k}\t{k / 100:.3f}\t{row}\n" for k, row in enumerate(tabs, start=1))
    good("lid.trc", trc, PAIR, notes=["W213"], **mm)
    good(
        "lid-frames.trc",
        trc + f"4\t0.040\t{tabs[0]}\n5\t0.050\t{tabs[1]}\n6\t0.060\t{tabs[2]}\n",
        [PAIR[1], PAIR[0], PAIR[2]],
        options={"every": 2, "first": "0.02s"} | two,
        names=["2", "4", "6"],
        **mm,
    )
    deeplabcut = "scorer" + ",net" * 6 + "\nbodyparts" + ",tip" * 3 + ",heel" * 3
    deeplabcut += "\ncoords" + ",x,y,likelihood" * 2 + "\n"
    sure = [[*row[:2], "0.99", *row[3:5], "0.61"] for row in FRAMES]
    sure.insert(1, ["400.1", "7.2", "0.2", "3.00", "4.00", "0.99"])
    good(
        "deeplabcut.csv",
        deeplabcut + "".join(f"{k},{','.join(row)}\n" for k, row in enumerate(sure)),
        PAIR,
        names=["0", "2", "3"],
        length_unit="px",
        notes=["W213"],
    )
    flat = [f"{k / 30:.3f}\t" + "\t".join(row[:2]) for k, row in enumerate(FRAMES)]
    flat = [f"{row}\t{row[:5]}\t" + "\t".join(FRAMES[k][3:5]) for k, row in enumerate(flat)]
    good(
        "tracker.txt",
        "mass_A\t\t\tmass_B\t\t\nt\tx\ty\tt\tx\ty\n" + "".join(f"{row}\n" for row in flat),
        PAIR,
        notes=["W213"],
    )
    head = ";".join(f"{name}:{axis}" for name in ("M1", "M2", "Base") for axis in "XYZ")
    good(
        "c3d-decimal-commas.csv",
        f"Time;{head}\n"
        + "".join(f"{k / 100};{';'.join(row)}\n" for k, row in enumerate(FRAMES)).replace(".", ","),
        PAIR,
        options={"points": "m1, m2"},
        notes=["W213"],
    )
    for name, form in (
        ("underscores", "{}_{}"),
        ("blanks", "{} {} [mm]"),
        ("points", "{}.{} (mm)"),
        ("capitals", "{}{}"),
    ):
        small = str.lower if form == "{}_{}" else str
        head = ",".join(form.format(f"Marker{k}", small(axis)) for k in (1, 2) for axis in "XYZ")
        good(
            f"markers-{name}.csv",
            f"Frame,{head}\n"
            + "".join(f"{k},{','.join(row[:6])}\n" for k, row in enumerate(FRAMES, start=1)),
            PAIR,
            length_unit="mm" if "mm" in form else None,
            notes=["W213"],
        )


def panels() -> None:
    flat = ["0.0"] * 4
    good(
        "cad-brackets.txt",
        "".join(f"({x}, {y}, 0.0)  {a}°\n" for x, y, a in POSES),
        notes=["W213"],
    )
    good(
        "cad-angle-brackets.txt",
        "".join(
            f"Point{k} <{x} mm; {y} mm> {a} deg\n".replace(".", ",")
            for k, (x, y, a) in enumerate(POSES, start=1)
        ),
        names=["Point1", "Point2", "Point3", "Point4"],
        length_unit="mm",
        notes=[],
    )
    good(
        "cad-labels.txt",
        "".join(f"X = {x} mm   Y = {y} mm\tAngle = {a} deg\n" for x, y, a in POSES),
        length_unit="mm",
        notes=[],
    )
    good(
        "cad-lines.txt",
        "".join(
            f"X: {x}mm\nY: {y}mm\nZ: {z}mm\nAngle: {a}°\n\n".replace(".", ",")
            for (x, y, a), z in zip(POSES, flat, strict=True)
        ),
        length_unit="mm",
        notes=["W213"],
    )
    bad("cad-decimal-commas.txt", "(12,3, 4,5, 0,0) 30°\n(13,3, 4,9, 0,0) 35°\n", "E104", ":1:1")
    bad("cad-thousands.txt", "(1,234, 5) 30°\n(1,235, 6) 35°\n", "E104", ":1:1")
    bad("cad-differences.txt", "dX = 1 mm  dY = 2 mm  Angle = 30 deg\n", "E107", ":1:6")
    bad("cad-no-unit.txt", "(1.5, 2) 30\n(2.5, 3) 40\n(3.5, 5) 45\n", "E110", ":1:10")
    bad("cad-other-unit.txt", "X=1mm Y=2mm Angle=3deg\nX=1in Y=2in Angle=3deg\n", "E106", ":2:3")
    bad("cad-heights.txt", "(1, 2, 0) 30°\n(2, 3, 0) 40°\n(3, 5, 1) 45°\n", "E113", ":3:2")
    z = "x,y,z,angle_deg\n" + "".join(f"{x},{y},12.70,{a}\n" for x, y, a in POSES)
    good("z-constant.csv", z, notes=["W213"])
    bad("z-changes.csv", z.replace("12.70,49", "12.90,49"), "E113", ":4:1")


def selections() -> None:
    five = [*POSES, ["7", "8", "9"]]
    text = "x,y,angle_deg\n" + rows(five)
    good(
        "every-second.csv",
        text,
        five[::2],
        options={"every": 2},
        names=["1", "3", "5"],
    )
    good(
        "from-to.csv",
        text,
        [five[1], five[3], five[4]],
        options={"first": "2", "last": "5", "drop": ["3"], "exact": ["4"]},
        names=["2", "4", "5"],
        exact=[2],
    )
    bad("from-none-such.csv", text, "E122", None, {"every": 2, "drop": ["6"]})
    KEY["from-none-such.csv"]["where"] = "--drop:1:1"


if __name__ == "__main__":
    makers = (dialects, headers, written_numbers, points, faults, shapes, trees, parquet)
    makers += (recordings, panels, selections)
    for make in makers:
        make()
    text = ",\n".join(
        f"{json.dumps(name)}: {json.dumps(entry, ensure_ascii=False)}"
        for name, entry in sorted(KEY.items())
    )
    (HERE / "key.json").write_text(f"{{\n{text}\n}}\n", encoding="utf-8")
