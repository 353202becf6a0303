"""The header of a recording of markers: their columns, their unit, and where the rows begin.

Two forms.  Names and axes in one line: M1:X, `M1 X`, M1_x, M1.x, X_M1, also with a unit behind
(`M1:X (mm)`), as C3D files are exported.  Or a line of names above a line of axes (X Y Z, x y, X1
Y1 Z1): Vicon Nexus (the section Trajectories), OptiTrack Motive, TRC, DeepLabCut, Tracker.  Their
units are stated below the axes, or in the lines above.
"""

from __future__ import annotations

import re
from collections import Counter
from itertools import chain, count, islice
from typing import NamedTuple

from burmester.io.reading.pose_table import Source
from burmester.io.reading.tables.column_words import LENGTHS
from burmester.io.reading.tables.columns import has_poses
from burmester.io.reading.tables.grid import split_cells, unquoted

AXES = ("X", "Y", "Z")
CONFIDENCE = "likelihood"  # the column by which DeepLabCut says how sure it is of a place
MAX_LINES = 16  # lines in which a header is looked for
MAX_LINE_CHARACTERS = 1_000_000  # of a line of the header: some 10,000 markers
MAX_NAME_CHARACTERS = 100  # of the name of a column
MIN_MARKERS = 2  # that make a header one of markers

_SHORT_UNITS = ("um", "mm", "cm", "m", "in", "ft", "px")
_LINE = re.compile(r"(?m)^.*$")
_SEPARATOR_LINE = re.compile(r'"?sep=.*\n', re.IGNORECASE)
_SECTION = re.compile(r'(?m)^"?Trajectories"?[,;\t ]*$')
_UNIT = (
    rf"(?:[\s_]*[(\[]\s*(?P<unit>[^()\[\]]+?)\s*[)\]]|[\s_]+(?P<word>{'|'.join(_SHORT_UNITS)}))?"
)
_AXIS = re.compile(rf"(?P<axis>[xyz])\d*{_UNIT}", re.IGNORECASE)
# An axis behind a name: set off from it, or a capital behind a digit.
_AXIS_LAST = re.compile(
    rf"(?P<name>.*\S)\s*(?:[\s_:./|-](?P<axis>[xyzXYZ])|(?<=\d)(?P<capital>[XYZ])){_UNIT}"
)
_AXIS_FIRST = re.compile(r"(?P<axis>[xyzXYZ])(?:[\s_:./|-]+(?P<name>\S.*)|(?P<number>\d+))")
_FRAMES = ("frame", "frames", "frame#", "frame no", "frame number", "field", "field #", "coords")
_TIME = re.compile(r"t|time(?:[\s_]*[(\[]?(?:s|sec|seconds)[)\]]?)?", re.IGNORECASE)
_UNIT_WORDS = {"px": "px", "pixels": "px", **LENGTHS}


class MarkerHeader(NamedTuple):
    """What the header of a recording says."""

    source: Source
    end: int  # where the rows begin in the text
    separator: str
    markers: dict[str, dict[str, int]]  # name -> axis or CONFIDENCE -> column
    width: int  # cells of a row
    units: tuple[str, ...]  # of the lengths, each once; more than one are contradictory
    frame: int | None  # the column with the numbers of the frames
    time: int | None  # the column with the times in seconds
    where: str  # the line with the names

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes that every marker has."""
        return tuple(
            axis for axis in AXES if all(axis in columns for columns in self.markers.values())
        )


def read_marker_header(source: Source) -> MarkerHeader | None:
    """The header of a recording; None for any other text."""
    section = _SECTION.search(source.text) if "Trajectories" in source.text else None
    stated = _SEPARATOR_LINE.match(source.text)  # a sheet of a workbook begins with it
    start = section.start() if section else stated.end() if stated else 0
    lines = list(islice(_LINE.finditer(source.text, start), MAX_LINES))
    if any(len(line[0]) > MAX_LINE_CHARACTERS for line in lines):
        return None
    for number, line in enumerate(lines[1:], start=1):
        for separator in "\t,;":
            cells = _cells(line[0], separator)
            axes = [found["axis"].upper() for cell in cells if (found := _AXIS.fullmatch(cell))]
            if min(Counter(axes)[axis] for axis in "XY") >= MIN_MARKERS:
                header = _of_two_lines(source, lines, number, separator)
                if header is not None:
                    return header
    first = next((line for line in lines if line[0].strip() and line[0].strip()[0] != "#"), None)
    return _of_one_line(source, first) if first else None


def _of_one_line(source: Source, line: re.Match[str]) -> MarkerHeader | None:
    """Names and axes in one line."""
    for separator in "\t,;":
        names = _cells(line[0], separator)
        if has_poses(names):
            return None
        columns: list[tuple[str, str, int, str]] = []
        for i, name in enumerate(names):
            if (found := _name_and_axis(name)) is not None:
                columns.append((found[0], found[1], i, found[2]))
            elif columns and name.lower() == CONFIDENCE:
                columns.append((columns[-1][0], CONFIDENCE, i, ""))
        markers = _markers(columns)
        if len(markers) >= MIN_MARKERS:
            units = tuple(dict.fromkeys(unit for *_, unit in columns if unit))
            frame, time = _frame_and_time([(name,) for name in names])
            where = source.where(line.start(), len(line[0].rstrip()))
            end = line.end() + 1
            return MarkerHeader(
                source, end, separator, markers, len(names), units, frame, time, where
            )
    return None


def _name_and_axis(text: str) -> tuple[str, str, str] | None:
    """The marker, the axis and the unit that the name of a column states."""
    if len(text) > MAX_NAME_CHARACTERS:
        return None
    if (found := _AXIS_LAST.fullmatch(text)) is not None:
        axis = found["axis"] or found["capital"]
        unit = (found["unit"] or found["word"] or "").lower()
        if unit and unit not in _UNIT_WORDS:
            return None
        return found["name"].rstrip(" _:./|-"), axis.upper(), _UNIT_WORDS.get(unit, "")
    found = _AXIS_FIRST.fullmatch(text)
    if found is None or (found["name"] or "").strip("()[] ").lower() in _UNIT_WORDS:
        return None
    return found["name"] or found["number"], found["axis"].upper(), ""


def _of_two_lines(
    source: Source, lines: list[re.Match[str]], number: int, separator: str
) -> MarkerHeader | None:
    """A line of names above that of the axes, which is lines[number]."""
    above = [_cells(line[0], separator) for line in lines[:number]]
    axes = _cells(lines[number][0], separator)
    at = _names_line(above)
    if at is None:
        return None
    width = len(axes)
    names = [*above[at], *[""] * width][:width]
    groups = _groups(above, width)
    kinds = next((row for row in reversed(above[at + 1 :]) if "Position" in row), None)
    columns: list[tuple[str, str, int, str]] = []
    current = ""
    for i, cell in enumerate(axes):
        current = names[i] or current
        axis = _AXIS.fullmatch(cell)
        if not current or (kinds is not None and [*kinds, *[""] * width][i] != "Position"):
            continue
        name = f"{groups[i]}:{current}" if groups[i] else current
        if axis:
            unit = (axis["unit"] or axis["word"] or "").lower()
            columns.append((name, axis["axis"].upper(), i, _UNIT_WORDS.get(unit, unit)))
        elif cell.lower() == CONFIDENCE:
            columns.append((name, CONFIDENCE, i, ""))
    markers = _markers(columns, _row_of("type", above))
    if len(markers) < MIN_MARKERS:
        return None
    stated = [unit for *_, unit in columns if unit] + _units_above(above)
    end = lines[number].end() + 1
    if number + 1 < len(lines):
        below = [cell.lower() for cell in _cells(lines[number + 1][0], separator)]
        if any(below) and all(not cell or cell in _UNIT_WORDS for cell in below):
            used = {i for axis_columns in markers.values() for i in axis_columns.values()}
            stated += [_UNIT_WORDS[cell] for i, cell in enumerate(below) if cell and i in used]
            end = lines[number + 1].end() + 1
    if any(CONFIDENCE in each for each in markers.values()):
        stated = ["px"]  # places in a picture
    frame, time = _frame_and_time(list(zip(axes, names, strict=True)))
    where = source.where(lines[at].start(), len(lines[at][0].rstrip()))
    units = tuple(dict.fromkeys(stated))
    width = max(width, len(above[at]))
    return MarkerHeader(source, end, separator, markers, width, units, frame, time, where)


def _names_line(above: list[list[str]]) -> int | None:
    """The line of the markers' names: the one that says so, or the last with content."""
    for at, row in enumerate(above):
        if {"name", "bodyparts"} & {cell.lower() for cell in row[:2]}:
            return at
    filled = [at for at, row in enumerate(above) if any(row)]
    if not filled or all(re.fullmatch(r"[-+.\d]*", cell) for cell in above[filled[-1]]):
        return None
    return filled[-1]


def _row_of(label: str, above: list[list[str]]) -> list[str]:
    """The line that begins with a label, none if there is none."""
    return next((row for row in above if label in [cell.lower() for cell in row[:2]]), [])


def _groups(above: list[list[str]], width: int) -> list[str]:
    """The animal (DeepLabCut) that each column belongs to, if the file has several."""
    row = _row_of("individuals", above)[1:]
    several = len(set(filter(None, row))) > 1
    return ["", *(row if several else []), *[""] * width][:width]


def _units_above(above: list[list[str]]) -> list[str]:
    """The unit that Motive (behind its label) or a TRC file (below its label) states."""
    for row, below in zip(above, [*above[1:], []], strict=True):
        labels = [cell.lower() for cell in row]
        if "length units" in labels:
            given = [*row, ""][labels.index("length units") + 1]
        elif "units" in labels and len(below) > labels.index("units"):
            given = below[labels.index("units")]
        else:
            continue
        return [_UNIT_WORDS.get(given.lower(), given)]
    return []


def _markers(
    columns: list[tuple[str, str, int, str]], types: list[str] | None = None
) -> dict[str, dict[str, int]]:
    """The markers with X and Y, or any two axes, and their columns; types tell names apart."""
    times = Counter((name, axis) for name, axis, *_ in columns)
    markers: dict[str, dict[str, int]] = {}
    for name, axis, i, _ in columns:
        kind = types[i] if types and i < len(types) and times[name, axis] > 1 else ""
        label = f"{name} ({kind})" if kind else name
        labels = chain((label,), (f"{label} #{number}" for number in count(2)))
        places = (markers.setdefault(each, {}) for each in labels)
        next(place for place in places if axis not in place)[axis] = i
    return {
        name: found for name, found in markers.items() if sum(axis in found for axis in AXES) > 1
    }


def _frame_and_time(labels: list[tuple[str, ...]]) -> tuple[int | None, int | None]:
    """The first columns of frame numbers and of times."""
    frames = (i for i, cell in enumerate(labels) if any(each.lower() in _FRAMES for each in cell))
    times = (i for i, cell in enumerate(labels) if any(map(_TIME.fullmatch, cell)))
    return next(frames, None), next(times, None)


def _cells(line: str, separator: str) -> list[str]:
    return [unquoted(cell) for cell in split_cells(line, separator)]
