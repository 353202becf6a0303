"""Pose files made at random: sound ones whose numbers are known, faulty ones, and mangled bytes.

Everything comes from a `random.Random`, so that a seed names a file.
"""

import functools
import json
import math
import random
import re
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple

import pyarrow
import pyarrow.parquet

from tests.oracles import workbooks
from tests.oracles.plain_reader import LENGTHS, POINTS, TURNS, Plain

SUFFIXES = {"csv": (".csv", ".tsv", ".txt", ".dat"), "json": (".json", ".x"), "toml": (".toml",)}
SUFFIXES["parquet"] = (".parquet", ".pq")
_WORDS = (
    "nan inf -Infinity 1e400 1e-400 1e99999999999999999999 0x1F 1_000 1,234 1,234.5 1.234,5 1'000 "
    "12..5 1.2.3 -- +-1 1e 1e5.5 ٣ １２ −1 1\u00a0000 ½ 1/3 30° 30deg 1d5 =A1 #REF! N/A null None "
    'true "" " \'1\' x y yes , ; # | \u2028 \ufeff \0 \x1a \x85 1e+ 0b1 .e1 . - 9e307 5e-324 '
    "2026-11-21 12:30:00 12:30 1e1000000000 0e999999999999999999999 0,5 ,5 5, 1.e5 00 -0 1e05"
)
STRANGE_WORDS = _WORDS.split(" ")
TOKENS = [word.encode() for word in STRANGE_WORDS]
TOKENS += [
    b"\n",
    b"\r",
    b"\r\n",
    b"\t",
    b" ",
    b"\xff",
    b"\xfe",
    b"\xc3",
    b"\xef\xbb\xbf",
    b"{",
    b"}",
]
TOKENS += [
    b"[",
    b"]",
    b"[[",
    b"]]",
    b":",
    b"=",
    b"\\",
    b"\\ud800",
    b"\\u0000",
    b"poses",
    b"angle_deg",
]
TOKENS += [
    b"angle_rad",
    b"x_mm",
    b"task",
    b"limits",
    b"requirements",
    b"NaN",
    b"Infinity",
    b'"""',
    b"'''",
]


class File(NamedTuple):
    """A file to be read, and what it holds where that is known."""

    data: bytes
    suffix: str
    options: dict  # of read_task
    key: Plain | None
    maker: str  # what made it


def number(rng, language="csv", positive=False):
    """The text of a number; `Decimal` reads it once TOML's underscores are gone."""
    style = rng.randrange(12)
    digits = "".join(rng.choice("0123456789") for _ in range(rng.choice((1, 2, 3, 5, 17, 19, 40))))
    whole = str(int(digits[: rng.randint(1, 4)]))
    if style < 5:
        text = f"{whole}.{digits[-rng.randint(1, 5) :]}"
    elif style == 5:
        text = whole
    elif style == 6:
        text = f"{whole}.{digits}{rng.choice('eE')}{rng.choice(('', '+', '-'))}{rng.randrange(30)}"
    elif style == 7:  # right between two doubles, or a breath beside
        low = rng.uniform(0.1, 1000)
        half = (Fraction(low) + Fraction(low).limit_denominator(1)) / 2
        half = Fraction(low) + Fraction(2) ** -(53 + rng.randint(-9, 4))
        text = f"{half.numerator * 10**70 // half.denominator:0>71d}"
        text = f"{int(text[:-70])}.{text[-70:]}".rstrip("0") + rng.choice(("", "1"))
    elif style == 8:
        small = ("4.9e-324", "2.5e-324", "1e-310", "2.2250738585072011e-308")
        text = rng.choice((*small, "1e50", "9.999999999999999e49", "8.98846567431158e47"))
    elif style == 9:
        text = rng.choice(("0", "0.0", "0.000", "0e5", "0e400", "0.0e-400"))
    elif style == 10:
        text = digits if digits[0] != "0" or len(digits) == 1 else f"1{digits}"
    else:
        text = f"{whole}.{digits}"
    if language == "csv" and rng.random() < 0.1:
        text = rng.choice((f"00{text}", text.replace("0.", ".", 1) if text[:2] == "0." else text))
        text = f"{text}." if text.isdigit() else text
    if language == "toml" and rng.random() < 0.05 and text.isdigit() and len(text) > 2:
        text = f"{text[:-2]}_{text[-2:]}"
    if positive:
        return text if Decimal(text.replace("_", "")) > Decimal("1e-50") else "1"
    signs = ("", "", "-") if language == "json" else ("", "", "-", "+")
    return rng.choice(signs) + text


def angle_number(rng, language="csv"):
    """The text of an angle; those beyond 1e9 rad are refused."""
    while abs(value(text := number(rng, language))) > 10**9:
        pass
    return text


def tracked(rng, count):
    """Rows of texts px, py, qx, qy: two points of a body, one distance apart up to the digits."""
    length, size, digits = 10 ** rng.uniform(-2, 5), 10 ** rng.uniform(-2, 6), rng.randint(0, 12)
    rows = []
    for _ in range(count):
        px, py, turn = rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-7, 7)
        q = px + length * math.cos(turn), py + length * math.sin(turn)
        rows.append([f"{number:.{digits + 3}f}" for number in (px, py, *q)])
    return rows


def value(text):
    """What such a text says."""
    return Decimal(text.replace("_", ""))


def _name(rng):
    words = ("A", "open", "pose 3", "Mitte", "Ω", "1", "", "a'b", "x", "half-way", "名前")
    return rng.choice(words)


# CSV


class Sheet(NamedTuple):
    """A CSV file before it is written: cells with decimal points."""

    header: list
    rows: list
    separator: str
    mark: str


def sheet(rng):
    """A sound sheet and its key."""
    separator = rng.choice(",,;;\t\t| ")
    mark = "," if separator != "," and rng.random() < 0.5 else "."
    unit, length = rng.choice(("deg", "rad")), rng.choice((None, None, *LENGTHS))
    stated = rng.random() < 0.85
    angle = f"angle_{unit}" if stated else rng.choice(TURNS)
    header = [f"x_{length}" if length else "x", f"y_{length}" if length else "y", angle]
    extra = [word for word in ("weight", "name", "exact", "#note", "#") if rng.random() < 0.15]
    count = rng.choice((3, 3, 4, 5, 6, 9, 30))
    columns = {name: [number(rng) for _ in range(count)] for name in header}
    columns[angle] = [angle_number(rng) for _ in range(count)]
    if rng.random() < 0.15:  # whole numbers alone, and nothing to prove a decimal mark
        columns = {name: [str(rng.randint(-3000, 9000)) for _ in range(count)] for name in header}
    if points := rng.random() < 0.15:
        stated, angle = True, None
        header = [f"{axis}_{length}" if length else axis for axis in POINTS]
        columns = dict(zip(header, zip(*tracked(rng, count), strict=True), strict=True))
    key = list(zip(*([value(cell) for cell in columns[name]] for name in header), strict=True))
    for name in extra:
        if name == "weight":
            columns[name] = [number(rng, positive=True) for _ in range(count)]
        elif name == "exact":
            columns[name] = [rng.choice(("", "no", "No", "0", "false")) for _ in range(count)]
            columns[name][rng.randrange(count)] = rng.choice(("x", "X", "yes", "true", "1"))
        else:
            columns[name] = [_name(rng) for _ in range(count)]
    order = [*columns]
    rng.shuffle(order)
    while order[0].startswith("#"):  # the line would be a comment
        rng.shuffle(order)
    rows = [[columns[name][k] for name in order] for k in range(count)]
    weights = [value(w) for w in columns["weight"]] if "weight" in extra else None
    names = columns.get("name", columns.get("#"))
    if "name" not in columns and not any(names or ()):
        names = None  # a column of numbers without one
    options = {} if stated else {"angle_unit": unit}
    if rng.random() < 0.05 and "exact" not in extra:
        options["exact"] = [rng.choice(("1", "1,2", "3", f"{count}"))]
    if rng.random() < 0.05:
        options["pose_sigma"] = (rng.choice((0.0, 0.05, 1e-300)), rng.choice((0.0, 1e-3)))
    exact = [e.lower() in ("x", "yes", "true", "1") for e in columns.get("exact", [])] or None
    plain = Plain(key, weights, unit if stated and not points else None, length, names, exact)
    return Sheet(order, rows, separator, mark), plain, options


def write(rng, sheet, titles=(), encodings=("utf-8", "utf-8", "utf-8", "utf-8-sig", "utf-16")):
    """The bytes of a sheet, in one of the dialects that people have.

    titles: lines above its header.
    """
    quoting, blanks = rng.choice((0, 0, 0, 1, 2)), rng.random() < 0.2
    spare = sheet.separator * rng.choice((0, 0, 0, 0, 2)) * (sheet.separator != " ")
    numeric = re.compile("[-+]?[.0-9]+([eE][-+]?[0-9]+)?")

    def cell(text, head=False):
        if not head and numeric.fullmatch(text):
            text = text.replace(".", sheet.mark)
        quoted = quoting == 1 or (quoting == 2 and rng.random() < 0.5)
        if head and rng.random() < 0.2:
            text = text.upper()
        empty = sheet.separator == " " and not text
        if quoted or sheet.separator in text or '"' in text or empty:
            text = '"' + text.replace('"', '""') + '"'
        blank = rng.choice((" ", "  ", "\t")) if sheet.separator in ",;|" else " "
        pad = (blank if blanks and rng.random() < 0.5 else "" for _ in "12")
        return text.join(pad)

    lines = [sheet.separator.join(cell(name, True) for name in sheet.header) + spare]
    for row in sheet.rows:
        if rng.random() < 0.03:
            lines.append(rng.choice(("", "  ", "# a comment, with; all\tof it", '#"', " #")))
        lines.append(sheet.separator.join(map(cell, row)) + spare)
    lines = [""] * rng.choice((0, 0, 0, 1)) + [*titles, *lines] + [""] * rng.choice((0, 1, 1, 3))
    if rng.random() < 0.1:
        lines.insert(0, "# made by hand")
    text = rng.choice(("\n", "\n", "\r\n", "\r")).join(lines)
    return text.encode(rng.choice(encodings))


def csv_file(rng):
    """A sound CSV file."""
    made, key, options = sheet(rng)
    suffix = rng.choice(SUFFIXES["csv"])
    return File(write(rng, made), suffix, options, key, "sound")


_FOREIGN = {  # words above columns, by the role of the column
    "x": "X-Koordinate|Pos. X|Coordonnée X|Coordenada X|Posizione X|X坐标|Ｘ座標|abscisse",
    "y": "Y-Koordinate|Pos. Y|Coordonnée Y|Coordenada Y|Posizione Y|Y坐标|Ｙ座標|ordonnée",
    "angle": "Winkel|Drehwinkel|Angle de rotation|Ángulo|Angolo|角度|回転角|Rz|Verdrehung",
    "weight": "Gewicht|Poids|Peso|权重|重み",
    "name": "Punkt|Stellung|Bezeichnung|Repère|Punto|Nome|点名|名前",
}
_FOREIGN_UNITS = {
    "mm": "mm|Millimeter|毫米",
    "in": "in|Zoll|pouces|pulgadas",
    "m": "m|Meter|mètres",
    "deg": "°|deg|degrés|gradi|度",
    "rad": "rad|Bogenmaß|弧度",
}
_TITLES = ("Deckel, Stand 12.5.", "Prüfstand 7;;;", "Motion of the lid", "\u95e8", "Export 2.0 (x)")


def dialect_file(rng):
    """A sound CSV file in other languages, with titles, and units below the header or in cells."""
    made, key, options = sheet(rng)
    header, rows = made.header, [list(row) for row in made.rows]
    bases, units = zip(*((name.partition("_")[::2]) for name in header), strict=True)
    measured = [j for j, base in enumerate(bases) if base in ("x", "y", *TURNS, *POINTS)]
    where = rng.choice(("header", "header", "row", "cells"))
    if not all(units[j] for j in measured):
        where = "header"
    group = rng.choice(("", "", "'", "\u2019", "\u00a0", "\u202f", ",.".replace(made.mark, "")))
    minus = rng.choice("--\u2212")

    def cell(text, unit):
        text = text.replace(".", made.mark)
        whole, mark, rest = text.partition(made.mark)
        if group and re.fullmatch("[-+]?[1-9][0-9]{3,}", whole) and rest.isdigit():
            text = f"{int(whole):+,}".replace(",", group) + mark + rest
            text = text.removeprefix("+")
        if unit and where == "cells":
            text += rng.choice(("", " ")) + unit
        return text.replace("-", minus, 1) if text.startswith("-") else text

    numeric = [*measured, *(j for j, base in enumerate(bases) if base == "weight")]
    for row in rows:
        for j in numeric:
            unit = units[j] if units[j] != "deg" else rng.choice(("°", "deg"))
            row[j] = cell(row[j], unit)
    if where == "row":
        rows.insert(0, [units[j] if j in measured else "" for j in range(len(header))])
    names = []
    for j, base in enumerate(bases):
        word = rng.choice(_FOREIGN.get("angle" if base in TURNS else base, base).split("|"))
        unit = units[j] if where == "header" else ""
        if unit:
            unit = rng.choice(_FOREIGN_UNITS.get(unit, unit).split("|"))
            word = rng.choice(("{} [{}]", "{} ({})", "{}/{}", "{} in {}", "{}［{}］")).format(
                word, unit
            )
        names.append(word if base in (*_FOREIGN, *TURNS, *POINTS) else header[j])
    titles = rng.sample(_TITLES, rng.choice((0, 0, 1, 2)))
    made = made._replace(header=names, rows=rows)
    state = rng.getstate()
    try:
        data = write(rng, made, titles, ("cp1252",))
    except UnicodeEncodeError:
        rng.setstate(state)
        data = write(rng, made, titles)
    return File(data, rng.choice(SUFFIXES["csv"]), options, key, "sound")


def workbook_file(rng):
    """A sound workbook: numbers stored as such or as text, the table anywhere in its sheet."""
    made, key, options = sheet(rng)
    measured = {"x", "y", "angle", "weight", *TURNS, *POINTS}

    def cell(name, text):
        if name.partition("_")[0] not in measured:
            return workbooks.text(text) if text else None
        if rng.random() < 0.1:
            return workbooks.text(text.replace(".", made.mark))
        return workbooks.formula("A1", text) if rng.random() < 0.1 else workbooks.number(text)

    rows = [[cell(*each) for each in zip(made.header, row, strict=True)] for row in made.rows]
    aside, above = rng.choice((0, 0, 2)), rng.choice((0, 0, 3))
    rows = [[workbooks.text(name) for name in made.header], *rows]
    rows = [[None] * aside + row for row in rows]
    titles = [[workbooks.text(rng.choice(_TITLES))], *[[]] * (above - 1)] if above else []
    return File(workbooks.workbook([*titles, *rows]), ".xlsx", options, key, "sound")


def _blank_inside(rng, text):
    at = rng.randrange(len(text) + 1)
    return f"{text[:at]} {text[at:]}"


_CELL_FAULTS = {  # what becomes of one cell
    "empty": lambda rng, text: "",
    "twice": lambda rng, text: text * 2,
    "word": lambda rng, text: rng.choice(STRANGE_WORDS),
    "quote": lambda rng, text: f'"{text}',
    "null": lambda rng, text: f"{text}\0",
    "blank": _blank_inside,
}
_ROW_FAULTS = {  # what becomes of one row
    "short": lambda rng, row: row[1:],
    "cut": lambda rng, row: row[: rng.randrange(len(row))],
    "long": lambda rng, row: [*row, number(rng)],
    "inserted": lambda rng, row: [number(rng), *row],
    "tail": lambda rng, row: [*row, ""],
    "joined": lambda rng, row: [" ".join(row[:2]), *row[2:]],
}
_HEADER_FAULTS = {  # what becomes of one name
    "typo": lambda rng, name: rng.choice((name[:-1], f"{name}s", "", "angel_deg", "z", "X Y")),
    "unit": lambda rng, name: rng.choice(("x_m", "y_in", "angle_rad", "x [mm]", "angle (deg)")),
    "no unit": lambda rng, name: name.partition("_")[0],
    "strange": lambda rng, name: rng.choice(STRANGE_WORDS),
}


def _part_thousands(rng):
    part = rng.choice(",,,'\u202f\u00a0_")  # not a point: 8.004 may be meant

    def parted(text):
        whole, point, rest = text.partition(".")
        plain = re.fullmatch("[1-9][0-9]{3,}", whole) and rest.isdigit() | (not rest)
        return f"{int(whole):,}".replace(",", part) + point + rest if plain else text

    return parted


def _some_commas(rng):
    return lambda text: text.replace(".", ",") if rng.random() < 0.3 else text


_STYLES = {  # the numbers are still those of the key
    "thousands": _part_thousands,
    "mixed": _some_commas,
}
_WHOLE_FAULTS = ("doubled", "header only", "no header", "preamble", "separator", "comma", "option")


def csv_fault(rng):
    """A CSV file with one or two faults; the key is kept where its numbers are still meant."""
    made, key, options = sheet(rng)
    faults = []
    for _ in range(rng.choice((1, 1, 2))):
        groups = (_CELL_FAULTS, _CELL_FAULTS, _ROW_FAULTS, _HEADER_FAULTS, _STYLES, _WHOLE_FAULTS)
        group = rng.choice(groups)
        fault = rng.choice([*group])
        faults.append(fault)
        k = rng.randrange(len(made.rows))
        row = made.rows[k]
        if group is _STYLES:
            make = _STYLES[fault](rng)
            rows = [[make(cell) for cell in row] for row in made.rows]
            # beside decimal commas, 1,074 is 1.074
            made = made._replace(rows=rows, mark="." if fault == "thousands" else made.mark)
            continue
        if fault in ("separator", "comma"):
            made = made._replace(separator=rng.choice(",;\t| ")) if fault == "separator" else made
            made = made._replace(mark="." if "thousands" in faults else rng.choice(",."))
            continue
        key = key if fault == "preamble" else None
        if group is _CELL_FAULTS and row:
            j = rng.randrange(len(row))
            row[j] = _CELL_FAULTS[fault](rng, row[j])
        elif group is _ROW_FAULTS and row:
            made.rows[k] = _ROW_FAULTS[fault](rng, row)
        elif group is _HEADER_FAULTS:
            j = rng.randrange(len(made.header))
            made.header[j] = _HEADER_FAULTS[fault](rng, made.header[j])
        elif fault == "option":
            options = {"angle_unit": rng.choice(("deg", "rad"))}
        else:
            made = _whole_fault(rng, fault, made)
    return File(write(rng, made), rng.choice(SUFFIXES["csv"]), options, key, "+".join(faults))


def _split(rng, row, more=()):
    """A row in which a decimal mark ends a cell."""
    j = rng.choice([j for j, cell in enumerate(row) if re.fullmatch(r"[-+]?[0-9]+[.][0-9]+", cell)])
    return [*row[:j], *row[j].split("."), *row[j + 1 :], *more]


def _insert(rng, row):
    j = rng.randrange(len(row) + 1)
    return [*row[:j], "", *row[j:]]


def _lose(rng, row, count=1):
    kept = sorted(rng.sample(range(len(row)), len(row) - count))
    return [row[j] for j in kept]


_SHAPE_FAULTS = {  # what becomes of a row, so that its numbers may move to other columns
    "decimal comma": lambda rng, row: [_split(rng, row)],
    "decimal comma and a blank": lambda rng, row: [_split(rng, row, [""])],
    "blank behind": lambda rng, row: [[*row, ""]],
    "blanks behind": lambda rng, row: [[*row, "", ""]],
    "blank in front": lambda rng, row: [["", *row]],
    "blank": lambda rng, row: [_insert(rng, row)],
    "number behind": lambda rng, row: [[*row, number(rng)]],
    "lost": lambda rng, row: [_lose(rng, row)],
    "two lost": lambda rng, row: [_lose(rng, row, 2)],
    "cut in two": lambda rng, row: [row[: len(row) // 2], row[len(row) // 2 :]],
    "twice": lambda rng, row: [row + row],
}


def shape_fault(rng):
    """A CSV file with a row that is wider or narrower than the header; the key is what was meant.

    A row that has lost a cell and won another one has the right width; it is not made here, as
    nothing in its shape gives it away.
    """
    made, key, options = sheet(rng)
    k = rng.randrange(len(made.rows))
    while True:
        fault = rng.choice([*_SHAPE_FAULTS])
        try:
            rows = _SHAPE_FAULTS[fault](rng, made.rows[k])
        except IndexError:  # no number with a decimal mark
            continue
        made.rows[k : k + 1] = rows
        return File(write(rng, made), rng.choice(SUFFIXES["csv"]), options, key, f"shape {fault}")


def _whole_fault(rng, fault, made):
    header, rows = made.header, made.rows
    if fault == "doubled":
        header = [*header, rng.choice(header)]
        rows = [[*row, number(rng)] for row in rows]
    elif fault == "header only":
        rows = [[]]
    elif fault == "no header":
        header = rows[0] or [""]
    elif fault == "preamble":
        rows = [[*header], *rows]
        header = [rng.choice(("mm", "deg", "Motion of the lid", "1", "---", "sep=;"))]
    return made._replace(header=header, rows=rows)


_KEYS = (
    "poses task x y angle angle_deg angle_rad weight name exact angle_unit length_unit pose_sigma "
    "position limits limit fixed_pivot moving_pivot length kinds least most point line segment box "
    "polygon requirements transmission_deg types driver footprint link_ratio within any_order px "
    "py qx qy p q version __proto__ \ud800 \u0000 # a.b"
)
KEYS = _KEYS.split()

# JSON and TOML: a tree of pairs (key, value), so that a key may stand twice; Raw is written as is


class Raw(str):
    """A piece of text to be written without quotes."""


class Pairs(list):
    """An object or a table."""


def emit(node, language, rng):
    """A tree as JSON, or as a value of TOML."""
    gap = rng.choice(("", " "))
    if isinstance(node, Raw):
        return str(node)
    if isinstance(node, Pairs):
        sign = ":" if language == "json" else " = "
        pairs = (f"{quoted(k, language)}{sign}{gap}{emit(v, language, rng)}" for k, v in node)
        return "{" + f",{gap}".join(pairs) + "}"
    if isinstance(node, list):
        return "[" + f",{gap}".join(emit(v, language, rng) for v in node) + "]"
    if node is None:
        return "null"
    return json.dumps(node, ensure_ascii=False)


def quoted(key, language):
    """A key, bare where TOML likes it so."""
    bare = language == "toml" and re.fullmatch("[A-Za-z0-9_-]+", key)
    return key if bare else json.dumps(key, ensure_ascii=False)


def document(tree, language, rng):
    """The text of a whole file."""
    if language == "json":
        return emit(tree, language, rng)
    lines, tables = [], []
    for key, node in tree:
        many = key == "poses" and isinstance(node, list) and node and rng.random() < 0.5
        if many and all(isinstance(pose, Pairs) for pose in node):
            for pose in node:
                tables.append("[[poses]]")
                tables += [f"{quoted(k, language)} = {emit(v, language, rng)}" for k, v in pose]
            continue
        if isinstance(node, Pairs) and rng.random() < 0.5:
            tables.append(f"[{quoted(key, language)}]")
            tables += [f"{quoted(k, language)} = {emit(v, language, rng)}" for k, v in node]
        else:
            lines.append(f"{quoted(key, language)} = {emit(node, language, rng)}")
    return "\n".join(lines + tables) + "\n"


def tree(rng, language):
    """A sound tree, its key and its options."""
    unit, length = rng.choice(("deg", "rad")), rng.choice((None, None, "mm", "in", "Zoll"))
    count = rng.choice((3, 3, 4, 5, 6, 12))
    key = [
        [number(rng, language), number(rng, language), angle_number(rng, language)]
        for _ in range(count)
    ]
    weights = [number(rng, language, positive=True) for _ in range(count)]
    names = [_name(rng) for _ in range(count)]
    as_lists, by_name, with_weights = (rng.random() < part for part in (0.5, 0.2, 0.2))
    stated = rng.choice(("pose", "file", "file", "option"))
    angle = f"angle_{unit}" if stated == "pose" and not as_lists else "angle"
    stated = "file" if stated == "pose" and as_lists else stated
    poses = []
    if points := rng.random() < 0.1:
        key, as_lists, stated = tracked(rng, count), False, "nowhere"
    for k, row in enumerate(key):
        if as_lists:
            poses.append([Raw(cell) for cell in row])
            continue
        pose = Pairs(zip(POINTS if points else ("x", "y", angle), map(Raw, row), strict=True))
        if points and rng.random() < 0.5:
            pose = Pairs([("p", [*map(Raw, row[:2])]), ("q", [*map(Raw, row[2:])])])
        pose += [("weight", Raw(weights[k]))] if with_weights else []
        pose += [("name", names[k])] if by_name else []
        rng.shuffle(pose)
        poses.append(pose)
    out = Pairs([("poses", poses)])
    out += [("angle_unit", unit)] if stated == "file" else []
    out += [("length_unit", length)] if length else []
    out += [("source", "made up")] if rng.random() < 0.1 else []
    if rng.random() < 0.1:
        out.append(("pose_sigma", Pairs([("position", Raw("0.05")), ("angle_deg", Raw("0"))])))
    if rng.random() < 0.15:
        out.append(("limits", Pairs([("length", Pairs([("least", Raw("0.5"))]))])))
    if rng.random() < 0.15:
        out.append(("requirements", Pairs([("link_ratio", Raw("20")), ("any_order", True)])))
    rng.shuffle(out)
    only_list = language == "json" and len(out) == 1 and rng.random() < 0.5
    options = {"angle_unit": unit} if stated == "option" else {}
    with_weights, by_name = with_weights and not as_lists, by_name and not as_lists
    plain = Plain(
        [tuple(map(value, row)) for row in key],
        [value(weight) for weight in weights] if with_weights else None,
        None if stated in ("option", "nowhere") else unit,
        length,
        names if by_name else None,
        None,
    )
    made = poses if only_list else Pairs([("task", out)]) if rng.random() < 0.05 else out
    return made, plain, options


def _encoded(rng, text):
    text = rng.choice(("\n", "\n", "\r\n")).join(text.split("\n"))
    return text.encode(rng.choice(("utf-8", "utf-8", "utf-8-sig", "utf-16")), "surrogatepass")


def tree_file(rng, language):
    """A sound JSON or TOML file."""
    made, key, options = tree(rng, language)
    data = _encoded(rng, document(made, language, rng))
    return File(data, rng.choice(SUFFIXES[language]), options, key, "sound")


def _anything(rng, language, depth=0):  # noqa: PLR0911
    kind = rng.randrange(14 if depth < 3 else 10)
    if kind < 4:
        return Raw(number(rng, language))
    if kind == 4:
        return rng.choice((True, False, None) if language == "json" else (True, False))
    if kind == 5:
        return rng.choice(STRANGE_WORDS)
    if kind == 6:
        toml = (
            "2026-11-21",
            "12:30:00",
            "1979-05-27T07:32:00Z",
            "inf",
            "nan",
            "0xff",
            "'1'",
            "1_0",
        )
        return Raw(
            rng.choice(toml if language == "toml" else ("NaN", "-Infinity", "1e400", "null"))
        )
    if kind == 7:
        return Raw(rng.choice(("1" + "0" * rng.choice((30, 308, 309, 5000)), "1e999999999", "-0")))
    if kind == 8:
        return rng.choice(("deg", "rad", "RR", "crank-rocker", "any", "first", "mm", "\U0001f600"))
    if kind == 9:
        return []
    if kind < 12:
        return [_anything(rng, language, depth + 1) for _ in range(rng.randrange(4))]
    return Pairs(
        (k, _anything(rng, language, depth + 1)) for k in rng.sample(KEYS, rng.randrange(4))
    )


def _places(node):
    """Every (container, index) in a tree."""
    for i, each in enumerate(node):
        yield node, i
        child = each[1] if isinstance(node, Pairs) else each
        if isinstance(child, list):
            yield from _places(child)


def _random_limits(rng, language):
    def numbers(count):
        return [Raw(number(rng, language)) for _ in range(count)]

    def region():
        shape = rng.choice(("point", "line", "segment", "box", "polygon"))
        points = [numbers(2) for _ in range(rng.choice((2, 2, 3, 4)))]
        return Pairs([(shape, numbers(2) if shape == "point" else points)])

    table = Pairs()
    for key in ("fixed_pivot", "moving_pivot"):
        table += [(key, region())] if rng.random() < 0.5 else []
    if rng.random() < 0.5:
        table.append(("length", Pairs(zip(("least", "most"), numbers(2), strict=True))))
    if rng.random() < 0.3:
        table.append(("kinds", rng.sample(("RR", "PR", "RP", "PP", "rr", ""), rng.randrange(4))))
    return [table, table] if rng.random() < 0.2 else table


def _random_requirements(rng, language):
    words = (
        "crank-rocker",
        "grashof",
        "non-grashof",
        "slider-crank",
        "Crank-Rocker",
        "double slider",
    )
    made = {
        "transmission_deg": Raw(number(rng, language)),
        "types": [rng.choice(words) for _ in range(rng.randrange(3))],
        "driver": rng.choice(("any", "first", "second", "crank", "third")),
        "footprint": Pairs([("box", [[Raw(number(rng, language)) for _ in "xy"] for _ in "12"])]),
        "link_ratio": Raw(number(rng, language)),
        "within": Raw(number(rng, language)),
        "any_order": rng.random() < 0.5,
    }
    return Pairs((k, made[k]) for k in rng.sample([*made], rng.randrange(4)))


_FAULTS = "replace delete twice rename insert limits requirements deep unit option"
TREE_FAULTS = _FAULTS.split()


def tree_fault(rng, language):
    """A JSON or TOML file with a fault or two, mostly without a key."""
    made, key, options = tree(rng, language)
    top = made if isinstance(made, Pairs) else Pairs([("poses", made)])
    faults = []
    for _ in range(rng.choice((1, 1, 2))):
        fault = rng.choice(TREE_FAULTS)
        faults.append(fault)
        node, i = rng.choice([*_places(top)] or [(top, 0)])
        if fault in ("limits", "requirements"):
            make = _random_limits if fault == "limits" else _random_requirements
            top[:] = [pair for pair in top if pair[0] != fault]
            top.append((fault, make(rng, language)))
            continue
        if fault == "option":
            options, key = {"angle_unit": rng.choice(("deg", "rad"))}, None
            continue
        key = None
        if fault == "unit":
            top.append(("angle_unit", rng.choice(("deg", "rad", "degrees", " deg"))))
        elif fault == "delete" and node:
            del node[i]
        elif fault == "twice" and node:
            node.append(node[i])
        elif fault == "rename" and isinstance(node, Pairs) and node:
            node[i] = (rng.choice(KEYS), node[i][1])
        elif fault == "insert" and isinstance(node, Pairs):
            node.append((rng.choice(KEYS), _anything(rng, language)))
        elif fault == "deep" and node:
            depth = rng.choice((5, 100, 900, 1000, 3000, 20000))
            deep = Raw("[" * depth + "1" + "]" * depth)
            node[i] = (node[i][0], deep) if isinstance(node, Pairs) else deep
        elif node:
            new = _anything(rng, language)
            node[i] = (node[i][0], new) if isinstance(node, Pairs) else new
    data = _encoded(rng, document(top, language, rng))
    return File(data, rng.choice(SUFFIXES[language]), options, key, "+".join(faults))


# Bytes


def mangle(rng, file, other):
    """A file with a few bytes changed, or two files spliced."""
    data = bytearray(file.data)
    hows = []
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        how = rng.choice(("flip", "delete", "token", "digit", "cut", "splice", "repeat", "swap"))
        hows.append(how)
        at = rng.randrange(len(data) + 1)
        end = min(len(data), at + rng.choice((1, 1, 2, 5, 30)))
        if how == "flip" and at < len(data):
            data[at] ^= 1 << rng.randrange(8)
        elif how == "delete":
            del data[at:end]
        elif how == "token":
            data[at : rng.choice((at, end))] = rng.choice(TOKENS)
        elif how == "digit":
            data[at:end] = rng.choice(b'0123456789.,-+eE \t";#').to_bytes(1, "big")
        elif how == "cut":
            del data[at:]
        elif how == "splice":
            data[at:] = other.data[rng.randrange(len(other.data) + 1) :]
        elif how == "repeat":
            data[at:at] = bytes(data[at:end]) * rng.choice((1, 2, 50))
        elif how == "swap":
            start = rng.randrange(len(data) + 1)
            data[start:start] = data[at:end]
    return File(bytes(data), file.suffix, file.options, None, "bytes " + "+".join(hows))


# Parquet


def _stored(rng, count, kind, turn):
    """A column as Arrow has it, and its numbers as Decimals; whether of angles."""
    texts = [angle_number(rng) if turn else number(rng) for _ in range(count)]
    doubles = [float(text) for text in texts]
    if kind == "int":
        array = pyarrow.array(
            [rng.randint(-(2**63), 2**63 - 1) >> rng.randrange(34 * turn, 64) for _ in texts]
        )
    elif kind == "decimal":
        digits = [Decimal(rng.randint(-(10**9), 10**9)).scaleb(-4) for _ in texts]
        array = pyarrow.array(digits, pyarrow.decimal128(20, 4))
    elif kind == "float32":
        array = pyarrow.array([x if abs(x) < 1e38 else 1.5 for x in doubles], pyarrow.float32())
    elif kind == "text":
        array = pyarrow.array(texts)
    elif kind == "hole":
        array = pyarrow.array([None, *doubles[1:]])
    elif kind == "nan":
        array = pyarrow.array([math.nan, *doubles[1:]])
    else:
        array = pyarrow.array(doubles)
    good = kind not in ("text", "hole", "nan")
    return array, [Decimal(v) for v in array.to_pylist()] if good else None


def parquet_file(rng, faulty=False):
    """A sound Parquet file, or one with a column that is not numbers."""
    count, unit = rng.choice((3, 4, 6, 40)), rng.choice(("deg", "rad"))
    length = rng.choice((None, "mm", "in"))
    header = [f"x_{length}" if length else "x", f"y_{length}" if length else "y", f"angle_{unit}"]
    kinds = [rng.choice(("double", "double", "float32", "int", "decimal")) for _ in header]
    if faulty:
        kinds[rng.randrange(3)] = rng.choice(("text", "hole", "nan", "double"))
    made = [_stored(rng, count, kind, k == 2) for k, kind in enumerate(kinds)]
    columns = dict(zip(header, (array for array, _ in made), strict=True))
    if by_name := rng.random() < 0.3:
        columns["name"] = pyarrow.array([_name(rng) for _ in range(count)])
    if rng.random() < 0.3:
        columns["#note"] = pyarrow.array([[1]] * count)
    if faulty and rng.random() < 0.5:
        del columns[rng.choice([*columns])]
    names = rng.sample([*columns], len(columns))
    sink = pyarrow.BufferOutputStream()
    table = pyarrow.table({name: columns[name] for name in names})
    pyarrow.parquet.write_table(table, sink, compression=rng.choice(("snappy", "gzip", "none")))
    key = None
    if not faulty:
        rows = list(zip(*(numbers for _, numbers in made), strict=True))
        texts = columns["name"].to_pylist() if by_name else None
        key = Plain(rows, None, unit, length, texts, None)
    data = sink.getvalue().to_pybytes()
    return File(data, rng.choice(SUFFIXES["parquet"]), {}, key, "faulty" if faulty else "sound")


_ALIKE = {
    "dialects": dialect_file,
    "shapes": shape_fault,
    "workbooks": workbook_file,
}  # all files of a kind
_SOUND = {"csv": csv_file, "parquet": parquet_file}
_FAULTY = {"csv": csv_fault, "parquet": functools.partial(parquet_file, faulty=True)}
for _language in ("json", "toml"):
    _SOUND[_language] = functools.partial(tree_file, language=_language)
    _FAULTY[_language] = functools.partial(tree_fault, language=_language)


def sound_file(language, rng):
    """A sound file of a language."""
    return _SOUND[language](rng)


def any_file(language, seed):
    """The file of a seed: four in ten sound, three faulty, three mangled.

    The language "shapes" is CSV with a row of a wrong width; "dialects" is sound CSV as people
    of many countries have it, and "workbooks" are sound, too.
    """
    rng = random.Random(f"{language} {seed}")
    if language in _ALIKE:
        return _ALIKE[language](rng)
    sound, faulty = _SOUND[language], _FAULTY[language]
    kind = rng.random()
    if kind < 0.4:
        return sound(rng)
    if kind < 0.7:
        return faulty(rng)
    return mangle(rng, rng.choice((sound, sound, faulty))(rng), sound(rng))
