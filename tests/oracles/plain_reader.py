"""A second reader of pose files, which shares no code with the package and is dumb on purpose.

It knows Python's csv, json and tomllib, Decimal and Fraction, and says what a file means only
where it is sure: `read` returns None for everything unusual.  `wrong` then compares.
"""

import csv
import io
import json
import math
import re
import tomllib
import unicodedata
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple

import pyarrow
import pyarrow.parquet

LENGTHS = ("um", "mm", "cm", "m", "in", "ft")
TURNS = ("angle", "theta", "phi", "rotation")
POINTS = ("px", "py", "qx", "qy")
UNITS = dict.fromkeys(("x", "y", *POINTS), ("", *LENGTHS))
IGNORED = ("time", "frame", "index")
NUMBERS = ("#", "no", "nr")  # they name the poses where no column does
MARKS = {"": 0, "0": 0, "no": 0, "false": 0, "1": 1, "x": 1, "yes": 1, "true": 1}
UNITS |= {"angle": ("", "deg", "rad")} | dict.fromkeys(("weight", "name", "exact"), ("",))


class Plain(NamedTuple):
    """What a file says beyond doubt, as Decimals."""

    poses: list  # (x, y, angle), or (px, py, qx, qy) of two tracked points
    weights: list | None
    angle_unit: str | None
    length_unit: str | None
    names: list | None
    exact: list | None


def read(data, suffix):
    """The poses in the bytes of a file, or None where the meaning is not sure."""
    if data[:4] == b"PAR1":
        try:
            return _parquet(data)
        except (pyarrow.ArrowException, OSError, ValueError, LookupError):
            return None
    marks = {"utf-8-sig": b"", "utf-16-le": b"\xff\xfe", "utf-16-be": b"\xfe\xff", "cp1252": b""}
    for encoding, mark in marks.items():
        if data.startswith(mark):
            try:
                text = data.decode(encoding).removeprefix("\ufeff")
            except UnicodeDecodeError:
                continue
            break
    else:
        return None
    text = "\n".join(re.split("\r\n|\r|\n", text))
    if suffix not in (".json", ".toml", ".csv", ".tsv", ".txt"):
        suffix = ".json" if text.strip()[:1] in ("{", "[") else ".csv"
    reader = {".json": _json, ".toml": _toml}.get(suffix, _csv)
    try:
        return reader(text)
    except (
        ArithmeticError,
        RecursionError,
        csv.Error,
        AttributeError,
        LookupError,
        TypeError,
        ValueError,
    ):
        return None


def _csv(text):
    lines = [line for line in text.split("\n") if line.strip() and line.strip()[0] != "#"]
    if lines[0].strip('"').lower().startswith("sep="):
        del lines[0]
    found = [sep for sep in ",;\t|" if _header(_tried(lines[0], sep))] or [" "]
    if len(found) != 1:
        return None
    separator = found[0]
    names = _cells(lines[0], separator)
    roles = _header(names)
    if not roles:
        return None
    rows = [_cells(line, separator) for line in lines[1:]]
    rows = [row[: len(roles)] + [cell for cell in row[len(roles) :] if cell] for row in rows]
    rows = [row for row in rows if any(row)]
    if not rows or any(len(row) != len(roles) for row in rows):
        return None
    columns = {
        role[0]: (role[1], [row[i] for row in rows]) for i, role in enumerate(roles) if role[0]
    }
    numeric = [role for role in ("x", "y", "angle", *POINTS, "weight") if role in columns]
    cells = [cell for role in numeric for cell in columns[role][1]]
    comma = any("," in cell for cell in cells)
    if comma and (
        separator == ","
        or any("." in cell for cell in cells)
        # 1,234 may be a thousand: another number has to show what the comma is
        or all(re.fullmatch("[-+\u2212]?[1-9][0-9]?[0-9]?,[0-9]{3}", c) for c in cells if "," in c)
    ):
        return None
    given = {role: [_number(c.replace(",", ".")) for c in columns[role][1]] for role in numeric}
    return _plain(
        given,
        {role: columns[role][0] for role in columns},
        _names({role: cells for role, (_, cells) in columns.items()}),
        [MARKS[mark.lower()] for mark in columns["exact"][1]] if "exact" in columns else None,
    )


def _names(columns):
    """The names, or what numbers the rows otherwise than 1, 2, 3."""
    numbers = columns.get("number", [])
    if (
        "name" in columns
        or not any(numbers)
        or numbers == [str(k + 1) for k, _ in enumerate(numbers)]
    ):
        return columns.get("name")
    return numbers


def _plain(given, units, names, exact):
    """Columns of numbers by role, and the units of their names."""
    axes = POINTS if "px" in given else ("x", "y", "angle")
    if len({units[role] for role in axes if role != "angle"}) != 1:
        return None
    return Plain(
        list(zip(*(given[role] for role in axes), strict=True)),
        given.get("weight"),
        units.get("angle"),
        units[axes[0]],
        names,
        exact,
    )


def _cells(line, separator):
    """The cells of one line, blanks around them and around their quotes taken away."""
    if separator == " ":
        line = re.sub("[ \t]+", " ", line.strip(" \t"))
    blank = "" if separator == " " else "[ \t]*" if separator != "\t" else " *"
    if '"' in line:
        part = re.escape(separator)
        line = re.sub(rf'"{blank}({part}|$)', r'"\1', line)
        line = re.sub(rf'(^|{part}){blank}"', r'\1"', line)
    (row,) = csv.reader([line], delimiter=separator, strict=True)
    return [cell.strip() for cell in row]


def _tried(line, separator):
    try:
        return _cells(line, separator)
    except csv.Error:
        return []


def _header(cells):
    """(role, unit) of each column, no role for those to be ignored; [] if this is no header."""
    while cells and not cells[-1]:
        cells.pop()
    roles = []
    for cell in cells:
        word = re.sub(
            r"[\s_/]*[([]?\s*\b([a-z]+)\s*[)\]]?$", r" \1", cell.lower().replace("_", " ")
        )
        base, _, unit = word.strip().partition(" ")
        base = {"pose": "name", "label": "name"}.get("angle" if base in TURNS else base, base)
        base = "angle" if base in TURNS else base
        unit = {"degrees": "deg", "radians": "rad", "inch": "in"}.get(unit, unit)
        if base in NUMBERS and not unit:
            roles.append(("number", None))
        elif cell.startswith("#") or (base in IGNORED and not unit):
            roles.append(("", None))
        elif unit in UNITS.get(base, ()):
            roles.append((base, unit or None))
        else:
            return []
    known = [role[0] for role in roles if role[0]]
    poses, points = {"x", "y", "angle"} & {*known}, {*POINTS} & {*known}
    whole = (len(poses), len(points)) in ((3, 0), (0, 4))
    return roles if whole and len(known) == len({*known}) else []


def _parquet(data):
    stored = pyarrow.parquet.read_table(io.BytesIO(data))
    roles = _header(stored.column_names)
    columns = {role[0]: stored.column(i).to_pylist() for i, role in enumerate(roles) if role[0]}
    given = {}
    for role, values in columns.items():
        if role not in ("name", "number", "exact"):
            if any(isinstance(v, bool) or not isinstance(v, int | float | Decimal) for v in values):
                return None
            given[role] = [_finite(Decimal(v)) for v in values]
    exact = [MARKS[str(m).lower()] for m in columns["exact"]] if "exact" in columns else None
    if "number" in columns:
        columns["number"] = ["" if name is None else str(name) for name in columns["number"]]
    return _plain(given, dict(roles), _names(columns), exact)


def _number(text):
    """The Decimal of a plain ASCII number; Decimal alone would take underscores and words."""
    text = text.replace("\u2212", "-", 1)
    if not re.fullmatch("[-+.0-9eE]+", text):
        raise ValueError(text)
    return _finite(Decimal(text))


def _finite(number):
    if not number.is_finite():
        raise ValueError(number)
    return number


def _json(text):
    def once(pairs):
        if len({key for key, _ in pairs}) != len(pairs):
            raise ValueError("a key twice")
        return dict(pairs)

    def refuse(word):
        raise ValueError(word)

    return _tree(
        json.loads(
            text,
            parse_float=Decimal,
            parse_int=Decimal,
            parse_constant=refuse,
            object_pairs_hook=once,
        )
    )


def _toml(text):
    return _tree(tomllib.loads(text, parse_float=Decimal))


def _tree(tree):
    """The poses in a list of them, in an object, or in what `--json` prints."""
    if isinstance(tree, list):
        tree = {"poses": tree}
    if "poses" not in tree:
        tree = tree["task"]
    poses, weights, names, exact, units = [], [], [], [], set()
    for given in tree["poses"]:
        pose = _as_table(given)
        if extra := pose.keys() - {"x", "y", "weight", "name", "exact", *POINTS}:
            (angle,) = extra
            units.add(
                {"angle": tree.get("angle_unit"), "angle_deg": "deg", "angle_rad": "rad"}[angle]
            )
            keys = ("x", "y", angle)
        else:
            keys = POINTS
        if any(key in pose for key in {"x", "y", *POINTS} - {*keys}):
            return None
        poses.append(tuple(_taken(pose[key]) for key in keys))
        weights.append(pose.get("weight"))
        names.append(pose.get("name"))
        exact.append({None: False, True: True, False: False}[pose.get("exact")])
    units |= {tree["angle_unit"]} if "angle_unit" in tree and units else set()
    if not poses or len({len(pose) for pose in poses}) != 1 or len(units) > 1:
        return None
    if (unit := next(iter(units), None)) not in ("deg", "rad", None):
        return None
    some = any(weight is not None for weight in weights)
    return Plain(
        poses,
        [Decimal(1) if w is None else _taken(w) for w in weights] if some else None,
        unit,
        (tree.get("length_unit") or "").strip() or None,
        [(name or "").strip() for name in names] if any(n is not None for n in names) else None,
        exact,
    )


def _as_table(pose):
    """A pose as a table without p and q: those become px, py, qx and qy."""
    if isinstance(pose, list):
        return dict(zip(("x", "y", "angle"), pose, strict=True))
    pairs = [(key, value) for key, value in pose.items() if key not in ("p", "q")]
    for point in {"p", "q"} & pose.keys():
        pairs += zip((f"{point}x", f"{point}y"), pose[point], strict=True)
    if len(dict(pairs)) < len(pairs):
        raise ValueError("a number twice")
    return dict(pairs)


def _taken(number):
    if isinstance(number, bool) or not isinstance(number, int | Decimal):
        raise TypeError(number)
    return _finite(Decimal(number))


def nearest(number):
    """The double nearest to a Decimal, by exact division of whole numbers."""
    if not number or number.adjusted() < -400:
        return 0.0
    if number.adjusted() > 400:
        return math.copysign(math.inf, number)
    fraction = Fraction(number)
    try:
        return fraction.numerator / fraction.denominator
    except OverflowError:
        return math.copysign(math.inf, number)


UNTOLD = ("Cc", "Cf", "Cs", "Zl", "Zp")  # escape codes and the like, which are told as blanks


def told(name):
    return "".join(" " if unicodedata.category(char) in UNTOLD else char for char in name)


def extreme(plain):
    """Whether powers of numbers leave a double's range, or some are lost beside others."""
    points = len(plain.poses[0]) == 4
    lengths = [abs(nearest(n)) for pose in plain.poses for n in (pose if points else pose[:2])]
    turns = [] if points else [abs(nearest(pose[2])) for pose in plain.poses]
    weights = [nearest(weight) for weight in plain.weights or ()] or [1.0]
    apart = max(weights) > 1e11 * min(weights)
    far = max(lengths) > 1e50 or 0 < max(lengths) < 1e-50
    return far or apart or any(turn > 1e9 for turn in turns)


def wrong(task, plain, angle_unit=None):  # noqa: PLR0911
    """What in a task differs from the file, as a sentence; "" if nothing does.

    angle_unit: what the caller stated of a file that states none.
    """
    if task.poses.shape != (len(plain.poses),):
        return f"{task.poses.shape} poses, the file has {len(plain.poses)}"
    if task.length_unit != plain.length_unit:
        return f"the length unit is {task.length_unit!r}, the file says {plain.length_unit!r}"
    unit = plain.angle_unit or angle_unit
    for k, pose in enumerate(plain.poses):
        got = (*task.poses.translation[k].tolist(), float(task.poses.angle[k]))
        true = [nearest(number) for number in pose]
        if len(true) == 4:
            if why := _wrong_points(got, true):
                return f"pose {k + 1}: {why}"
            continue
        if unit is None or (plain.angle_unit and angle_unit not in (None, plain.angle_unit)):
            return "taken although the angle unit is not stated, or stated in two ways"
        # one multiplication by the double pi / 180, as np.radians has it
        true[2] = math.radians(true[2]) if unit == "deg" else true[2]
        if got != tuple(true):
            return f"pose {k + 1} is {got}, the file says {tuple(true)}"
    weights = None if plain.weights is None else [nearest(w) for w in plain.weights]
    if (None if task.weights is None else task.weights.tolist()) != weights:
        return f"the weights are {task.weights}, the file says {weights}"
    names = [told(name) for name in plain.names or ()] or None
    if names != (None if task.names is None else [*task.names]):
        return f"the names are {task.names}, the file says {plain.names}"
    marks = [False] * len(plain.poses) if task.exact is None else task.exact.tolist()
    if plain.exact is not None and marks != plain.exact:
        return f"exact are {marks}, the file says {plain.exact}"
    return ""


def _wrong_points(got, true):
    """The moving frame of two points: origin in the first, x axis towards the second."""
    px, py, qx, qy = true
    if got[:2] != (px, py):
        return f"the origin is {got[:2]}, the first point {(px, py)}"
    # differences of the doubles, exact as fractions and rounded once
    dx, dy = (float(Fraction(b) - Fraction(a)) for a, b in ((px, qx), (py, qy)))
    if abs(math.remainder(got[2] - math.atan2(dy, dx), math.tau)) > 1e-14:
        return f"the angle is {got[2]}, the points say {math.atan2(dy, dx)}"
    return ""
