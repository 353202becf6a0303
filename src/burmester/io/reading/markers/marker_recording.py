"""A recording of markers: which of them are on the body, and their places frame by frame.

The markers are those that --points names, or the only two.
A marker is missing where its place is blank, NaN, 0,0,0 as lost markers are exported, or of a low
likelihood.  Numbers are read as in any CSV file.
"""

from __future__ import annotations

import functools
import re
from array import array
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.io.files import quoted
from burmester.io.reading.markers.marker_header import AXES, CONFIDENCE, MarkerHeader
from burmester.io.reading.pose_table import (
    NUMBER_LIKE,
    Source,
    decimals,
    no_poses,
    plain_number,
    shown,
)
from burmester.io.reading.row_selection import RowLabels
from burmester.io.reading.tables.cell_numbers import CellNumbers
from burmester.io.reading.tables.grid import Row, split_cells
from burmester.numerics.arrays import FloatArray
from burmester.wording import listed, shortened

MIN_LIKELIHOOD = 0.6  # DeepLabCut's own default; a place less likely counts as missing
MAX_COORDINATE = 1e60  # beyond it, fourth powers leave a double's range

_LINE = re.compile(r"(?m)^.*\S.*$")
_PLAIN = re.compile(r"-?[0-9]{1,9}\.[0-9]{1,15}")
_MISSING = ("", "nan", "na", "n/a", "-nan", "-nan(ind)", "null", "none", "-")
MAX_SUGGESTED = 24  # markers among which a pair is looked for that stays on one body
MIN_MOTION = 0.1  # of the motion of the marker that moves most; one that moves less is at rest
MAX_LISTED = 12  # markers that a message lists


class MarkerRecording(NamedTuple):
    """The places of some markers in all frames of a file."""

    header: MarkerHeader
    names: tuple[str, ...]
    axes: tuple[str, ...]
    places: FloatArray  # (N, K, A), NaN where a marker is missing
    decimals: float  # the most that a coordinate is printed with
    labels: RowLabels
    starts: NDArray[np.intp]  # where the line of each frame begins in the text
    reasons: dict[str, NDArray[np.bool_]]  # why markers are missing, and in which frames
    chosen: bool = False  # whether these are the only markers, and nobody named them

    def locate_row(self, row: int | None) -> str:
        """Where a frame stands, by its number from 0; the file for None."""
        source = self.header.source
        return source.label if row is None else Row(source, int(self.starts[row]), []).where()

    def row_name(self, row: int) -> str:
        return self.labels.names[row] if self.labels.frames else str(row + 1)


def read_recording(
    header: MarkerHeader, names: tuple[str, ...], *, one_mark: bool = True
) -> MarkerRecording:
    """The places of markers in all rows; raises E102 to E106 and E112.

    one_mark: whether decimal commas have to be beyond doubt (E104).
    """
    axes = tuple(axis for axis in AXES if all(axis in header.markers[name] for name in names))
    if len(axes) < 2:
        message = f"{listed(names)} have no two axes in common"
        help = "export X and Y of every marker"
        raise InputError("E105", message, where=header.where, help=help)
    columns = [header.markers[name][axis] for name in names for axis in axes]
    sure = [header.markers[name].get(CONFIDENCE) for name in names]
    used = columns + [column for column in sure if column is not None]
    own = CellNumbers(header.separator)
    numbers, starts, most = array("d"), array("q"), 0.0
    frames: list[str] = []
    times: list[str] = []
    for number, row in enumerate(_rows(header), start=1):
        _require_width(header, row, number)
        for place, column in enumerate(used):
            text = _number(row, column, number, own)
            numbers.append(float(text))
            if place < len(columns) and "." in text:
                most = max(most, decimals(text))
        starts.append(row.start)
        frames.append(row.value(header.frame))
        times.append(row.value(header.time))
    if not starts:
        raise no_poses("the file has only a header")
    shown_marks = (plain_number(text, header.separator)[1] for text in times[:100])
    for mark in {".", ","}.intersection(filter(None, shown_marks)):
        own.marks.setdefault(mark, "")  # a time, too, shows what a comma is
    if one_mark:
        own.require_one_mark()
    values = np.array(numbers).reshape(len(starts), len(used))
    places, likely = values[:, : len(columns)].copy(), values[:, len(columns) :]
    _require_near(header, places, starts)
    places = places.reshape(len(starts), len(names), len(axes))
    reasons = _forget_lost(places, likely, [k for k, each in enumerate(sure) if each is not None])
    labels = _labels(frames, times, header.separator)
    return MarkerRecording(header, names, axes, places, most, labels, np.array(starts), reasons)


def _number(row: Row, column: int, number: int, own: CellNumbers) -> str:
    """A cell with a decimal point, "nan" where it is missing; number: of the row, from 1."""
    cell = row.value(column)
    if "." in own.marks and _PLAIN.fullmatch(cell):
        return cell
    if cell.lower() in _MISSING:
        return "nan"
    return own.read(cell, number, functools.partial(row.where, column))


def _require_near(header: MarkerHeader, places: FloatArray, starts: Sequence[int]) -> None:
    """Refuse places that cannot be computed with: E112."""
    far = np.abs(places) > MAX_COORDINATE
    if far.any():
        row, column = (int(k) for k in np.argwhere(far)[0])
        message = f"row {row + 1} has a place that is too far away to compute with"
        why = f"it is {places[row, column]:g}, the limit is {MAX_COORDINATE:g}"
        where = Row(header.source, starts[row], []).where()
        raise InputError("E112", message, where=where, why=why, help="write it in another unit")


def _rows(header: MarkerHeader) -> Iterator[Row]:
    """The lines with numbers; a blank line and a line of words end them."""
    text, end, separator = header.source.text, header.end, header.separator
    for line in _LINE.finditer(text, header.end):
        if not line[0].strip(f'{separator}" '):
            end = line.end()
            continue
        row = Row(header.source, line.start(), split_cells(line[0], separator))
        apart = text[end : line.start()].count("\n") > 1 and end > header.end
        if apart and not NUMBER_LIKE.fullmatch(next(filter(None, row.values()))):
            return
        yield row
        end = line.end()


def _require_width(header: MarkerHeader, row: Row, number: int) -> None:
    """Refuse a row with a number below no name (E106): a comma in a number may have split it."""
    # an unquoted decimal comma makes two cells of one, and the last of them may be blank
    given = len(row.cells) if header.separator == "," else len(row.values())
    if given > header.width:
        message = f"row {number} has {given} cells, the header has {header.width}"
        help = "delete what stands behind the last column, or write decimal points"
        raise InputError("E106", message, where=row.where(header.width), help=help)


def _forget_lost(
    places: FloatArray, likely: FloatArray, sure: list[int]
) -> dict[str, NDArray[np.bool_]]:
    """Set lost markers to NaN; the frames for each reason.  likely: (N, L), from 0 to 1."""
    reasons = {"has no value": _any(np.isnan(places), axis=(1, 2))}
    # a lost marker is exported as 0,0,0; one that never leaves 0 along an axis is in that plane
    zero = (places == 0) | np.isnan(places)
    planar = zero.all(axis=0).any(axis=1)
    lost = (places == 0).all(axis=2) & ~planar & (places.shape[2] == len(AXES))
    places[lost] = np.nan
    reasons["is at 0,0,0"] = _any(lost, axis=1)
    if sure:
        doubtful = np.zeros(places.shape[:2], dtype=np.bool_)
        doubtful[:, sure] = ~(likely >= MIN_LIKELIHOOD)
        places[doubtful] = np.nan
        reasons[f"has a likelihood below {MIN_LIKELIHOOD:g}"] = _any(doubtful, axis=1)
    return reasons


def _any(mask: NDArray[np.bool_], axis: int | tuple[int, ...]) -> NDArray[np.bool_]:
    return np.asarray(mask.any(axis=axis), dtype=np.bool_)


def _labels(frames: list[str], times: list[str], separator: str) -> RowLabels:
    """What the frames are called: by the numbers in the file if they are whole and differ."""
    are_frames = all(text.isascii() and text.isdigit() for text in frames)
    are_frames = are_frames and len(set(frames)) == len(frames)

    def seconds() -> FloatArray | None:
        plain = [plain_number(text, separator) for text in times]
        known = all(mark is not None for _, mark in plain)
        return np.array([float(text) for text, _ in plain]) if known else None

    return RowLabels(len(frames), frames if are_frames else (), are_frames, seconds)


def chosen_markers(header: MarkerHeader, points: str | None) -> MarkerRecording:
    """The recording of the markers that `points` names.

    points: names separated by commas; None takes the only two of a file.  Raises E102 to E108,
    and E114 where the markers are not known or not chosen.
    """
    if points is None:
        if len(header.markers) == 2:
            return read_recording(header, tuple(header.markers))._replace(chosen=True)
        raise _no_choice(header)
    names = tuple(_marker(word, header, points) for word in points.split(","))
    if len(names) < 2 or len(set(names)) < len(names):
        message = "a pose takes two different markers or more"
        raise _refusal(header, message, points)
    return read_recording(header, names)


def _marker(word: str, header: MarkerHeader, points: str) -> str:
    """The marker that a word names: by its name, without capitals, or without its subject."""
    word = word.strip()
    if word in header.markers:
        return word
    small, names = word.lower(), list(header.markers)
    for short in (names, [name.rpartition(":")[2] for name in names]):
        found = [name for name, each in zip(names, short, strict=True) if each.lower() == small]
        if len(found) == 1:
            return found[0]
    raise _refusal(header, f"there is no marker {shown(word)} in this file", points)


def _refusal(header: MarkerHeader, message: str, points: str) -> InputError:
    where = Source("--points", points).where(0, len(points))
    why, pair = _known_markers(header), _suggested(header)
    return InputError("E114", message, where=where, why=why, help=f"pass --points {_joined(pair)}")


def _no_choice(header: MarkerHeader) -> InputError:
    """E114, with a command that works: the pair whose distance varies least."""
    count, label = len(header.markers), header.source.label
    path = "-" if label == "<stdin>" else quoted(label)
    pair = _joined(_suggested(header))
    help = (
        "name two markers of the body (the origin first, the x axis points to the second), or "
        f"more to fit them all: `burmester synthesize {path} --points {pair}`"
    )
    message = f"this is a recording of {count} markers, and --points names none of them"
    return InputError("E114", message, where=header.where, why=_known_markers(header), help=help)


def _known_markers(header: MarkerHeader) -> str:
    return f"its markers are {listed(shortened(list(header.markers), MAX_LISTED))}"


def _joined(names: Sequence[str]) -> str:
    """Names as the option takes them, in quotes where a shell needs them."""
    return quoted(",".join(names))


def _suggested(header: MarkerHeader) -> tuple[str, str]:
    """The two moving markers whose distance varies least, among the first ones."""
    names = [name for name in header.markers if "," not in name][:MAX_SUGGESTED]
    best, pair = np.inf, tuple(names[:2])
    try:
        places = read_recording(header, tuple(names), one_mark=False).places
    except InputError:
        return pair[0], pair[1]
    moves = [_motion(places[:, k]) for k in range(len(names))]
    moving = [k for k in range(len(names)) if moves[k] > MIN_MOTION * max(moves)]
    for i, j in combinations(moving, 2):
        distance = np.linalg.norm(places[:, i] - places[:, j], axis=1)
        distance = distance[np.isfinite(distance)]
        # a pair that is seen in half of the frames is of little use
        if 2 * len(distance) >= len(places) and distance.size and distance.mean() > 0:
            change = float(distance.std() / distance.mean())
            if change < best:
                best, pair = change, (names[i], names[j])
    return pair[0], pair[1]


def _motion(places: FloatArray) -> float:
    """How far a marker moves about its mean, root mean square; 0 if it is never seen."""
    seen = places[np.isfinite(places).all(axis=1)]
    return float(np.sqrt(seen.var(axis=0).sum())) if len(seen) else 0.0
