"""Make files as people have them, and the key that was written by hand beside each.

    python -m tests.io.corpus.people.make_people

The numbers of a key are typed again, not taken from the content above it.  Nothing of burmester is
imported.  The files are kept as they are made.
"""

import json
from pathlib import Path

from tests.oracles.workbooks import DATE, formula, number, of_type, packed, parts, sheet_xml, text

HERE = Path(__file__).parent
KEY = {}


def file(name, origin, content, **key):
    """A file, what it comes from, and its key: poses and units, or the code of its refusal."""
    assert name not in KEY
    (HERE / name).write_bytes(content)
    KEY[name] = {"origin": origin, **key}


def lines(*rows, end="\r\n"):
    return "".join(row + end for row in rows)


def cells(*row):
    """A row of a sheet: numbers as they are stored, texts, and cells that are made already."""
    return [
        None if c is None else c if c.startswith("<c") else number(c) if _stored(c) else text(c)
        for c in row
    ]


def _stored(cell):
    return cell.lstrip("-").replace(".", "", 1).isdigit()


LID = [["0", "0", "0"], ["31.25", "10.5", "40"], ["40.125", "30.5", "70"], ["50", "35", "95.5"]]


def german():
    file(
        "deckel-ansi.csv",
        "Excel in German, saved as CSV (separated): ANSI, semicolons, decimal commas",
        lines(
            "Punkt;x [mm];y [mm];Winkel [°]",
            "geschlossen;0;0;0",
            "P2;31,25;10,5;40",
            "P3;40,125;30,5;70",
            "geöffnet;50;35;95,5",
        ).encode("cp1252"),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["geschlossen", "P2", "P3", "geöffnet"],
        said=["Windows-1252"],
    )
    file(
        "deckel-utf8.csv",
        "Excel in German, CSV UTF-8 with sep= on top and two columns that were formatted once",
        (
            "\ufeff"
            + lines(
                "sep=;",
                "Nr.;X-Koordinate (mm);Y-Koordinate (mm);Drehwinkel (Grad);Bemerkung;;",
                "10;0;0;0;zu;;",
                "20;31,25;10,5;40;;;",
                "30;40,125;30,5;70;;;",
                "40;50;35;95,5;offen;;",
                ";;;;;;",
            )
        ).encode(),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["10", "20", "30", "40"],
        said=["`Bemerkung`"],
    )
    file(
        "deckel-unicode.txt",
        "Excel in German, saved as Unicode text: UTF-16 and tabs",
        lines(
            "Stellung\tX in mm\tY in mm\tVerdrehung in °",
            "A\t0\t0\t0",
            "B\t31,25\t10,5\t40",
            "C\t40,125\t30,5\t70",
            "D\t50\t35\t95,5",
        ).encode("utf-16"),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["A", "B", "C", "D"],
        said=[],
    )
    file(
        "ohne-einheit.csv",
        "a table whose author knows that angles are degrees",
        lines("Punkt;X;Y;Winkel", "1;0;0;0", "2;3,5;1;40", "3;4;3;70").encode(),
        refused="E110",
        where=":1:11",
        words="the angle unit is not stated",
    )
    file(
        "gon.csv",
        "surveyors measure in gon",
        lines("Punkt;X [m];Y [m];Winkel [gon]", "1;0;0;0", "2;3,5;1;40", "3;4;3;70").encode(),
        refused="E105",
        where=":1:1",
        words="the units of winkel are deg, rad",
    )
    file(
        "einheiten-in-zellen.csv",
        "typed by hand, with the unit in every cell",
        lines(
            "Stellung;X;Y;Winkel",
            "1;0 mm;0 mm;0°",
            "2;31,25 mm;10,5mm;40°",
            "3;40,125 mm;30,5 mm;70 °",
            "4;50 mm;35 mm;95,5°",
        ).encode(),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["1", "2", "3", "4"],
        said=["units are read from the cells: '0 mm' is in mm"],
    )
    file(
        "einheiten-gemischt.csv",
        "the same, with a pose in centimetres",
        lines("Punkt;X;Y;Winkel", "1;0 mm;0 mm;0°", "2;3,5 cm;1 mm;40°", "3;4 mm;3 mm;7°").encode(),
        refused="E108",
        where=":3:3",
        words="'3,5 cm' in cm, another cell says mm",
    )
    file(
        "numbers.csv",
        "Apple Numbers: the table's name on top",
        lines(
            "Tabelle 1;;;",
            "Lage;x (mm);y (mm);phi (°)",
            "zu;0;0;0",
            "2;31,25;10,5;40",
            "3;40,125;30,5;70",
            "auf;50;35;95,5",
            end="\n",
        ).encode(),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["zu", "2", "3", "auf"],
        said=["line 1 above the header is passed over"],
    )


def romance():
    file(
        "capot-ansi.csv",
        "Excel in French, ANSI: no-break spaces between thousands",
        lines(
            "Repère;Abscisse (mm);Ordonnée (mm);Angle (degrés)",
            "fermé;0;0;0",
            "n° 2;1\u00a0031,25;10,5;40",
            "n° 3;1\u00a0040,125;30,5;70",
            "ouvert;1\u00a0050;35;95,5",
        ).encode("cp1252"),
        poses=[
            ["0", "0", "0"],
            ["1031.25", "10.5", "40"],
            ["1040.125", "30.5", "70"],
            ["1050", "35", "95.5"],
        ],
        unit="deg",
        length_unit="mm",
        names=["fermé", "n° 2", "n° 3", "ouvert"],
        said=["Windows-1252", "is read as 1031.25"],
    )
    file(
        "puerta.csv",
        "LibreOffice in Spanish",
        lines(
            "Punto;Coordenada X [mm];Coordenada Y [mm];Ángulo de giro [grados];Peso",
            "cerrada;0;0;0;1",
            "2;31,25;10,5;40;1",
            "3;40,125;30,5;70;0,5",
            "abierta;50;35;95,5;2",
            end="\n",
        ).encode(),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["cerrada", "2", "3", "abierta"],
        weights=["1", "1", "0.5", "2"],
        said=[],
    )
    file(
        "sportello.csv",
        "Excel in Italian, with titles above and minus signs of a text program",
        lines(
            "Sportello del vano;;;",
            "rilievo del 12 maggio;;;",
            ";;;",
            "Posizione;X [cm];Y [cm];Rotazione [gradi]",
            "chiuso;0;0;0",
            "2;\u22123,125;1,05;40",
            "3;\u22124,0125;3,05;70",
            "aperto;\u22125;3,5;95,5",
        ).encode(),
        poses=[
            ["0", "0", "0"],
            ["-3.125", "1.05", "40"],
            ["-4.0125", "3.05", "70"],
            ["-5", "3.5", "95.5"],
        ],
        unit="deg",
        length_unit="cm",
        names=["chiuso", "2", "3", "aperto"],
        said=["lines 1 to 3 above the header are passed over: `Sportello del vano;;;`"],
    )


def eastern():
    file(
        "chinese.csv",
        "WPS in Chinese, saved as UTF-8: wide brackets",
        lines(
            "点名,X坐标（毫米）,Y坐标（毫米）,角度（度）,备注",
            "关,0,0,0,",
            "2,31.25,10.5,40,",
            "3,40.125,30.5,70,",
            "开,50,35,95.5,极限",
        ).encode(),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["关", "2", "3", "开"],
        said=["`备注`"],
    )
    file(
        "japanese.csv",
        "Excel in Japanese, CSV UTF-8",
        (
            "\ufeff"
            + lines(
                "番号,X座標[mm],Y座標[mm],回転角度[°],重み",
                "1,0,0,0,1",
                "2,31.25,10.5,40,1",
                "3,40.125,30.5,70,1",
                "4,50,35,95.5,2",
            )
        ).encode(),
        poses=LID,
        unit="deg",
        length_unit="mm",
        weights=["1", "1", "1", "2"],
        said=[],
    )
    file(
        "japanese-sjis.csv",
        "the same, saved as CSV: Shift-JIS, which is not guessed",
        lines("番号,X座標[mm],Y座標[mm],回転角度[°]", "1,0,0,0", "2,31,10,40").encode("shift-jis"),
        refused="E101",
        where="",
        words="is not UTF-8",
    )


def english():
    file(
        "google-sheets.csv",
        "Google Sheets: thousands as they are shown",
        lines(
            "Pose,X (mm),Y (mm),Angle (deg),Comment",
            'closed,"1,000.0",0,0,',
            '2,"1,031.25",10.5,40,',
            '3,"1,040.125",30.5,70,"rattles, a bit"',
            'open,"1,050.0",35,95.5,',
        ).encode(),
        poses=[
            ["1000", "0", "0"],
            ["1031.25", "10.5", "40"],
            ["1040.125", "30.5", "70"],
            ["1050", "35", "95.5"],
        ],
        unit="deg",
        length_unit="mm",
        names=["closed", "2", "3", "open"],
        said=["`Comment`", "`1,000.0` is read as 1000.0"],
    )
    file(
        "swiss.txt",
        "Excel in Swiss German: apostrophes between thousands",
        lines(
            "Nr\tx [mm]\ty [mm]\tWinkel [°]",
            "1\t1'000\t0\t0",
            "2\t1'031.25\t10.5\t40",
            "3\t1'040.125\t30.5\t70",
        ).encode(),
        poses=[["1000", "0", "0"], ["1031.25", "10.5", "40"], ["1040.125", "30.5", "70"]],
        unit="deg",
        length_unit="mm",
        said=["`1'000` is read as 1000"],
    )
    file(
        "data-logger.txt",
        "a logger: comments, tabs, a line of units",
        lines(
            "# Logger 4711, 100 Hz",
            "# 12 May, run 3",
            "Time\tX\tY\tTheta",
            "s\tmm\tmm\tdeg",
            "0.00\t0.000\t0.000\t0.00",
            "0.01\t31.250\t10.500\t40.00",
            "0.02\t40.125\t30.500\t70.00",
            "0.03\t50.000\t35.000\t95.50",
            end="\n",
        ).encode(),
        poses=LID,
        unit="deg",
        length_unit="mm",
        said=["line 4 is read as the units", "`Time`"],
    )
    file(
        "matlab.csv",
        "writetable of MATLAB: all digits",
        lines(
            "x,y,theta_rad",
            "0,0,0",
            "31.25,10.5,0.698131700797732",
            "40.125,30.5,1.22173047639603",
            "50,35,1.66678943565458",
            end="\n",
        ).encode(),
        poses=[
            ["0", "0", "0"],
            ["31.25", "10.5", "0.698131700797732"],
            ["40.125", "30.5", "1.22173047639603"],
            ["50", "35", "1.66678943565458"],
        ],
        unit="rad",
        said=[],
    )
    file(
        "pandas.csv",
        "to_csv of pandas, with its index",
        lines(
            ",x,y,angle_deg", "0,0.0,0.0,0.0", "1,31.25,10.5,40.0", "2,40.125,30.5,70.0", end="\n"
        ).encode(),
        refused="E107",
        where=":2:1",
        words="'0' below no name",
    )
    file(
        "decimal-comma.csv",
        "typed by hand, with commas for everything",
        lines("x,y,angle_deg,weight", "0,0,0,1", "1,5,50,120,", "4,3,70,1", end="\n").encode(),
        refused="E106",
        where=":3:12",
        words="perhaps 1,5 is one number",
    )
    file(
        "thousands-or-decimals.csv",
        "what is 1,250?",
        lines("x;y;angle_deg", "1,250;0;0", "2,500;1;40", "4;3;70", end="\n").encode(),
        refused="E104",
        where=":2:1",
        words="a comma in a number can be read in two ways",
    )


def workbooks():
    head = cells("Punkt", "X-Koordinate\n[mm]", "Y-Koordinate\n[mm]", "Drehwinkel [°]", "Bemerkung")
    file(
        "klappe.xlsx",
        "a table from a CAD drawing: title, hidden row, remarks, a second sheet",
        packed(
            parts(
                {
                    "Stellungen": sheet_xml(
                        [
                            cells("Klappe 4711, Stand 12.5."),
                            [],
                            head,
                            cells("zu", "0", "0", "0"),
                            cells("P2", "31.25", "10.5", "40"),
                            cells("P3", "40.125", "30.5", "70", "geschätzt"),
                            cells("auf", "50", "35", "95.5"),
                        ],
                        hidden=(6,),
                        merged=("A1:E1",),
                    ),
                    "Stückliste": sheet_xml([cells("Teil", "Menge"), cells("Lasche", "2")]),
                }
            )
        ),
        poses=LID,
        unit="deg",
        length_unit="mm",
        names=["zu", "P2", "P3", "auf"],
        said=[
            "the sheet Stellungen is read, one of 2",
            "row 6 of the sheet is hidden",
            "rows 1 to 2 above the header",
            "`Bemerkung`",
        ],
    )
    file(
        "formeln.xlsx",
        "coordinates by formulas, and numbers that a spreadsheet took for text",
        packed(
            parts(
                {
                    "Tabelle1": sheet_xml(
                        [
                            cells("x [mm]", "y [mm]", "Winkel [°]"),
                            cells("0", "0", "0"),
                            [formula("A2+31.25", "31.25"), text("10,5"), number("40")],
                            [formula("A3+8.875", "40.125"), text("30,5"), number("70")],
                            [formula("SUM(A2,50)", "50"), number("35"), text("95,5")],
                            [formula('IF(A7="","",A7)', "", "str")] * 3,
                        ]
                    )
                }
            )
        ),
        poses=LID,
        unit="deg",
        length_unit="mm",
        said=[],
    )
    faults = {
        "datum.xlsx": (number("46143", DATE), "'2026-05-01 00:00:00' is a date or a time"),
        "division.xlsx": (of_type("e", "#DIV/0!"), "'#DIV/0!' is an error value"),
        "ungerechnet.xlsx": (formula("B2+10.5"), "'=B2+10.5' is a formula without a stored value"),
    }
    for name, (cell, words) in faults.items():
        rows = [cells("0", "0", "0"), [number("31.25"), cell, number("40")], cells("4", "3", "70")]
        table = sheet_xml([cells("x_mm", "y_mm", "angle_deg"), *rows])
        file(
            name,
            "a sheet with one cell that holds no number",
            packed(parts({"Tabelle1": table})),
            refused="E104",
            where=": cell B3",
            words=words,
        )


if __name__ == "__main__":
    for make in (german, romance, eastern, english, workbooks):
        make()
    entries = ",\n".join(
        f"{json.dumps(name)}: {json.dumps(entry, ensure_ascii=False)}"
        for name, entry in sorted(KEY.items())
    )
    (HERE / "key.json").write_text(f"{{\n{entries}\n}}\n", encoding="utf-8")
    print(len(KEY), "files")
