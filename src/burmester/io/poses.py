"""A task from a file: poses in CSV, JSON and TOML, limits and requirements in the latter two.

A number is taken as the nearest double or refused, never changed: no thousands separators,
no underscores, no guessed units, no guessed decimal marks.  An error's `where` holds
`file:line:column`, then the line with a caret below; the column is that of the first
character at fault, counted from 1.  Numbers in JSON and TOML are pointed at by their path,
`poses[3].x`, counted from 0 as in the file.

E101 not readable, or not text      E106 a row or pose of the wrong length
E102 no poses in it                 E107 a column or key that is not known
E103 a number that is not finite    E108 said twice, or in two ways that contradict
E104 not a number, or ambiguous     E109 not JSON or TOML at all
E105 header, column or key missing  E110 angle unit missing or contradicted
E122 no such pose to be met exactly
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Sequence
from pathlib import PurePath
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from burmester.displacement import Displacement
from burmester.errors import InputError
from burmester.io import cases
from burmester.io.asked import requirements
from burmester.io.csv_poses import read_csv
from burmester.io.documents import read_json, read_toml
from burmester.io.limits_text import exact_marks
from burmester.io.table import UNITS, PoseTable, Rows, Source, empty
from burmester.io.wanted import Wanted
from burmester.task import Task

__all__ = ["read_task"]

_READERS = dict.fromkeys((".csv", ".tsv", ".txt"), read_csv)
_READERS |= {".json": read_json, ".toml": read_toml}


def read_task(
    source: str | os.PathLike[str],
    *,
    angle_unit: Literal["deg", "rad"] | None = None,
    wanted: Wanted | None = None,
    exact: Sequence[str] = (),
    sigma: tuple[float, float] | None = None,
) -> Task:
    """Read the task in a file, on standard input ("-") or in a carried case ("case:NAME").

    .csv, .tsv and .txt are CSV; .json and .toml are what they say; anything else is JSON if
    it begins with a bracket, and CSV if not.  `angle_unit` (--angle-unit) states the unit
    where the file does not; `wanted` adds limits and requirements to those in the file, and `exact`
    (--exact) marks poses by their numbers from 1 or by their names.  The task's resolution is half
    of the last digit printed, x and y together; where only whole numbers are printed it is 0, as
    people mean them exactly.  `sigma` (--pose-sigma), the standard deviations of the poses'
    positions and angles in radians, sets it instead, to sqrt(3) times as much.
    Raises InputError E101 to E110 as listed above, and what `Limits`, `Requirements` and `Task`
    raise.
    """
    if angle_unit not in (None, *UNITS):
        raise InputError("E110", f"there is no angle unit {angle_unit!r}", help="say deg or rad")
    path = os.fspath(source)
    label = "<stdin>" if path == "-" else path
    try:
        text = _decode(_fetch(path))
        by_content = read_json if text.lstrip().startswith(("{", "[")) else read_csv
        read = _READERS.get(PurePath(label).suffix.lower(), by_content)
        return _task(read(Source(label, text)), angle_unit, wanted, exact, sigma)
    except InputError as error:
        error.where = error.where or label
        raise


def _fetch(source: str) -> bytes:
    if source == "-":
        return sys.stdin.buffer.read()
    if source.startswith("case:"):
        return cases.read_bytes(source.removeprefix("case:"))
    try:
        with open(source, "rb") as file:
            return file.read()
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        why = getattr(error, "strerror", None) or str(error)
        help = f"write case:{source}" if source in cases.names() else "check the path"
        raise InputError("E101", "the poses cannot be read", why=why, help=help) from None


def _decode(data: bytes) -> str:
    """Text with one line feed between its lines, from UTF-8 or from UTF-16 that says so."""
    wide = data[:2] in (b"\xff\xfe", b"\xfe\xff")
    try:
        text = data.decode("utf-16" if wide else "utf-8-sig")
        why = "there are null characters in it" if "\0" in text else ""
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        why = f"byte {error.start + 1}, in line {line}, is not UTF-{16 if wide else 8}"
    if why:
        raise InputError("E101", "the poses are not text", why=why, help="save the file as UTF-8")
    if not text.strip():
        raise empty("there is nothing in it")
    # splitlines() would also break a name at U+2028 and shift the line numbers
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\n")


def _task(
    table: PoseTable,
    angle_unit: str | None,
    wanted: Wanted | None,
    exact: Sequence[str],
    sigma: tuple[float, float] | None,
) -> Task:
    """The task in a table, once its angle unit is beyond doubt."""
    values, stated = table.rows.values, table.angle_unit
    angles = values[:, 2]
    if stated and angle_unit and stated != angle_unit:
        message = f"the angles are stated in {UNITS[stated]}, --angle-unit says {UNITS[angle_unit]}"
        help = "leave --angle-unit out, or correct the unit in the file"
        raise InputError("E110", message, where=table.where, help=help)
    unit = stated or angle_unit
    if not unit and len(angles):
        message = "the angle unit is not stated and both readings are possible"
        why = _both_readings(float(angles.min()), float(angles.max()), len(angles))
        help = f"{table.say_unit}, or pass --angle-unit deg or --angle-unit rad"
        raise InputError("E110", message, where=table.where, why=why, help=help)
    length, angle = (0.5 * 10.0**-printed if printed else 0.0 for printed in table.rows.decimals)
    degrees = unit == "deg"
    resolution = (length, math.radians(angle) if degrees else angle)
    sigma = table.sigma if sigma is None else sigma
    if sigma is not None:
        resolution = (math.sqrt(3) * sigma[0], math.sqrt(3) * sigma[1])
    said = table.wanted.joined(wanted) if wanted else table.wanted
    try:
        return Task(
            Displacement(values[:, :2], np.radians(angles) if degrees else angles),
            weights=values[:, 3] if values.shape[1] > 3 else None,
            names=tuple(table.rows.names) or None,
            length_unit=table.length_unit,
            resolution=resolution,
            exact=_marked(table.rows, exact),
            limits=said.limits(),
            requirements=requirements(said.asked),
        )
    except InputError as error:
        if error.code in ("E132", "E134"):  # limits and requirements, not the poses
            error.where = error.where or said.places
        raise


def _marked(rows: Rows, exact: Sequence[str]) -> NDArray[np.bool_] | None:
    """Which poses must be met exactly, as the file or --exact says."""
    marks = rows.exact
    if exact:
        if any(marks):
            message = "poses are marked exact in the file and by --exact"
            raise InputError("E108", message, help="leave --exact out, or the marks in the file")
        marks = exact_marks(exact, rows.names, len(rows.values))
    return np.array(marks) if any(marks) else None


def _both_readings(least: float, most: float, count: int) -> str:
    """How far the body turns if the angles are degrees, and if they are radians."""
    small = max(-least, most) <= 2 * math.pi
    lie = "within +-6.28" if small else f"between {least:g} and {most:g}"
    turns = (most - least, math.degrees(most - least))
    as_deg, as_rad = (f"{turn:.1f}" if 0.1 <= turn < 1e5 else f"{turn:.3g}" for turn in turns)
    return (
        f"all {count} angles lie {lie}. "
        f"As degrees the body turns {as_deg} deg in total, as radians {as_rad} deg"
    )
