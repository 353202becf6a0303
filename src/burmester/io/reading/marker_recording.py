"""A recording of markers: the places of those that are on the body, frame by frame, as poses.

A frame in which one of them is missing (blank, NaN, 0,0,0 as lost markers are exported, or a low
likelihood) is left out and counted, never filled.  Numbers are read as in any CSV file.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Advice, InputError
from burmester.io.files import quoted
from burmester.io.reading import pose_table
from burmester.io.reading.csv_cells import cell_location, row_values, split_cells, unquoted
from burmester.io.reading.csv_poses import require_one_mark
from burmester.io.reading.marker_header import AXES, CONFIDENCE, MarkerHeader
from burmester.io.reading.pose_table import PoseTable, Rows, decimals, extent, known_to, shown
from burmester.io.reading.rigid_body import fit_rigid_body
from burmester.io.reading.row_selection import RowLabels
from burmester.io.reading.tracked_points import MAX_DISTANCE_CHANGE
from burmester.io.reading.working_plane import planar_points
from burmester.io.reading.wrong_numbers import not_a_number
from burmester.numerics.arrays import FloatArray
from burmester.wording import listed, shortened

__all__ = ["MarkerRecording", "read_recording", "recorded_poses"]

MIN_LIKELIHOOD = 0.6  # DeepLabCut's own default; a place less likely counts as missing
MAX_SUGGESTED = 24  # markers among which a pair is looked for that stays on one body
MIN_MOTION = 0.1  # of the motion of the marker that moves most; one that moves less is at rest
MAX_LISTED = 12  # markers, or ranges of frames, that a message lists
MIN_TRIPLES = 20  # of frames one after the other, to tell noise from slow changes of a shape
NOISE_RATIO = 2.0  # of a shape's changes to its noise from frame to frame; above it is no noise
MIN_CHANGE = 0.01  # of the body's size; lesser changes of its shape are not mentioned

MAX_COORDINATE = 1e60  # beyond it, fourth powers leave a double's range

_LINE = re.compile(r"(?m)^.*\S.*$")
_PLAIN = re.compile(r"-?[0-9]{1,9}\.[0-9]{1,15}")
_MISSING = ("", "nan", "na", "n/a", "-nan", "-nan(ind)", "null", "none", "-")


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

    def locate_row(self, row: int | None) -> str:
        """Where a frame stands, by its number from 0; the file for None."""
        source = self.header.source
        if row is None:
            return source.label
        start = int(self.starts[row])
        end = source.text.find("\n", start)
        line = source.text[start : end if end >= 0 else len(source.text)]
        return source.where(start, len(line.strip()))

    def row_name(self, row: int) -> str:
        return self.labels.names[row] if self.labels.frames else str(row + 1)


# --- which markers


def read_recording(header: MarkerHeader, points: str | None) -> tuple[MarkerRecording, bool]:
    """The recording of the markers that `points` names, and whether they were chosen here.

    points: names separated by commas; None takes the only two of a file.  Raises E102 to E108,
    and E114 where the markers are not known or not chosen.
    """
    if points is None:
        if len(header.markers) == 2:
            return _recording(header, tuple(header.markers)), True
        raise _no_choice(header)
    names = tuple(_marker(word, header, points) for word in points.split(","))
    if len(names) < 2 or len(set(names)) < len(names):
        message = "a pose takes two different markers or more"
        raise _refusal(header, message, points)
    return _recording(header, names), False


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
    where = pose_table.Source("--points", points).where(0, len(points))
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
        places = _recording(header, tuple(names), whole=False).places
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


# --- their places


def _recording(
    header: MarkerHeader, names: tuple[str, ...], *, whole: bool = True
) -> MarkerRecording:
    """The places of markers in all rows; whole: cells of no other column are looked at."""
    axes = tuple(axis for axis in AXES if all(axis in header.markers[name] for name in names))
    if len(axes) < 2:
        message = f"{listed(names)} have no two axes in common"
        help = "export X and Y of every marker"
        raise InputError("E105", message, where=header.where, help=help)
    columns = [header.markers[name][axis] for name in names for axis in axes]
    sure = [header.markers[name].get(CONFIDENCE) for name in names]
    used = columns + [column for column in sure if column is not None]
    marks: dict[str, str] = {}  # mark of `plain_number` -> its first location
    numbers, starts, most = array("d"), array("q"), 0.0
    frames: list[str] = []
    times: list[str] = []
    for line, cells in _rows(header):
        _require_width(header, line, cells, len(starts) + 1)
        for place, column in enumerate(used):
            text = _number(header, (line, cells), column, len(starts) + 1, marks)
            numbers.append(float(text))
            if place < len(columns) and "." in text:
                most = max(most, decimals(text))
        starts.append(line.start())
        frames.append(_cell(cells, header.frame))
        times.append(_cell(cells, header.time))
    if not starts:
        raise pose_table.no_poses("the file has only a header")
    shown_marks = (pose_table.plain_number(text, header.separator)[1] for text in times[:100])
    for mark in {".", ","}.intersection(filter(None, shown_marks)):
        marks.setdefault(mark, "")  # a time, too, shows what a comma is
    if whole:
        require_one_mark(marks)
    values = np.array(numbers).reshape(len(starts), len(used))
    places, likely = values[:, : len(columns)].copy(), values[:, len(columns) :]
    _require_near(header, places, starts)
    places = places.reshape(len(starts), len(names), len(axes))
    reasons = _forget_lost(places, likely, [k for k, each in enumerate(sure) if each is not None])
    labels = _labels(frames, times, header.separator)
    return MarkerRecording(header, names, axes, places, most, labels, np.array(starts), reasons)


def _number(
    header: MarkerHeader,
    row: tuple[re.Match[str], list[str]],
    column: int,
    number: int,
    marks: dict[str, str],
) -> str:
    """A cell with a decimal point, "nan" where it is missing; raises E103 and E104.

    number: of the row, from 1.
    """
    line, cells = row
    cell = _cell(cells, column)
    if "." in marks and _PLAIN.fullmatch(cell):
        return cell
    if cell.lower() in _MISSING:
        return "nan"
    plain, mark = pose_table.plain_number(cell, header.separator)
    if mark is None or not marks.get(mark):
        where = cell_location(header.source, line.start(), cells, column)
        if mark is None:
            raise not_a_number(
                cell, plain, row=number, unit=None, where=where, separator=header.separator
            )
        marks[mark] = where
    return plain


def _require_near(header: MarkerHeader, places: FloatArray, starts: Sequence[int]) -> None:
    """Refuse places that cannot be computed with: E112."""
    far = np.abs(places) > MAX_COORDINATE
    if not far.any():
        return
    row, column = (int(k) for k in np.argwhere(far)[0])
    source, start = header.source, starts[row]
    end = source.text.find("\n", start)
    where = source.where(start, (end if end >= 0 else len(source.text)) - start)
    message = f"row {row + 1} has a place that is too far away to compute with"
    why = f"it is {places[row, column]:g}, the limit is {MAX_COORDINATE:g}"
    raise InputError("E112", message, where=where, why=why, help="write it in another unit")


def _rows(header: MarkerHeader) -> Iterator[tuple[re.Match[str], list[str]]]:
    """The lines with numbers, with their cells; a blank line and a line of words end them."""
    text, end, separator = header.source.text, header.end, header.separator
    for line in _LINE.finditer(text, header.end):
        cells = split_cells(line[0], separator) if '"' in line[0] else line[0].split(separator)
        if not line[0].strip(f'{separator}" '):
            end = line.end()
            continue
        apart = text[end : line.start()].count("\n") > 1 and end > header.end
        if apart and not pose_table.NUMBER_LIKE.fullmatch(next(filter(None, map(unquoted, cells)))):
            return
        yield line, cells
        end = line.end()


def _require_width(
    header: MarkerHeader, line: re.Match[str], cells: list[str], number: int
) -> None:
    """Refuse a row with a number below no name (E106): a comma in a number may have split it."""
    # an unquoted decimal comma makes two cells of one, and the last of them may be blank
    given = len(cells) if header.separator == "," else len(row_values(cells))
    if given > header.width:
        where = cell_location(header.source, line.start(), cells, header.width)
        message = f"row {number} has {given} cells, the header has {header.width}"
        help = "delete what stands behind the last column, or write decimal points"
        raise InputError("E106", message, where=where, help=help)


def _cell(cells: list[str], column: int | None) -> str:
    return unquoted(cells[column]) if column is not None and column < len(cells) else ""


def _forget_lost(
    places: FloatArray, likely: FloatArray, sure: list[int]
) -> dict[str, NDArray[np.bool_]]:
    """Set lost markers to NaN; returns the frames for each reason.

    likely: (N, L), how sure the places of the markers `sure` are, from 0 to 1.
    """
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
        plain = [pose_table.plain_number(text, separator) for text in times]
        known = all(mark is not None for _, mark in plain)
        return np.array([float(text) for text, _ in plain]) if known else None

    return RowLabels(len(frames), frames if are_frames else (), are_frames, seconds)


# --- poses


def recorded_poses(
    recording: MarkerRecording,
    selected: NDArray[np.bool_],
    usable: NDArray[np.bool_],
    plane: str | None,
    *,
    chosen: bool,
) -> tuple[PoseTable, NDArray[np.intp]]:
    """The selected frames in which no marker is missing as a table, and their numbers from 0.

    usable: the frames by which the plane and the noise are judged, also those between the
    selected ones.  chosen: whether the markers were chosen here.  Raises E102, E108 and E113.
    """
    header = recording.header
    unit = _unit(header)
    behind = f" {unit}" if unit else ""
    seen = np.isfinite(recording.places).all(axis=(1, 2))
    kept, base = np.flatnonzero(selected & seen), np.flatnonzero(usable & seen)
    if not len(kept):
        message = f"no frame has {listed(recording.names)} together"
        help = "choose markers that are seen together with --points, or other frames with --from"
        raise InputError("E102", f"no poses: {message}", where=header.where, help=help)
    planar = planar_points(recording.places[base], recording.axes, plane, behind, header.where)
    flat = np.full((*recording.places.shape[:2], 2), np.nan)
    flat[base] = planar.points
    points = flat[kept]
    sentences = [planar.sentence] if planar.sentence else []
    sentences += _left_out(recording, selected & ~seen)
    rigid, warning, sigma = _rigidity(recording, flat, base, behind)
    sentences += rigid
    if unit == "px":
        sentences.append("y is taken as it stands; in pictures it counts downwards")
    who = listed(recording.names)
    message = f"{len(kept)} poses are those of the markers {who}"
    if chosen:
        message = f"{message}, the only two of this file"
    help = "name other markers with --points, other frames with --from, --to and --drop"
    if len(recording.axes) > 2:
        help = f"{help}, another plane with --plane"
    own = Advice("W213", message, help, "; ".join(sentences) or None)
    notes = (*header.source.notes, own, *warning)
    rows = Rows(points.reshape(len(points), -1), (recording.decimals, 0.0), [], [], points.shape[1])
    table = PoseTable(
        rows,
        length_unit=unit,
        angle_unit=None,
        where=header.where,
        say_unit="",
        pose_sigma=sigma,
        locate_row=recording.locate_row,
        notes=notes,
    )
    return table, kept


def _unit(header: MarkerHeader) -> str | None:
    """The unit of lengths; raises E108 for two of them."""
    if len(header.units) > 1:
        message = f"two units of lengths: {listed(header.units)}"
        help = "export all markers in one unit"
        raise InputError("E108", message, where=header.where, help=help)
    return header.units[0] if header.units else None


def _left_out(recording: MarkerRecording, missing: NDArray[np.bool_]) -> list[str]:
    """How many frames are left out, which and why."""
    if not missing.any():
        return []
    rows = np.flatnonzero(missing)
    breaks = np.flatnonzero(np.diff(rows) > 1)
    ranges = zip(rows[[0, *(breaks + 1)]], rows[[*breaks, -1]], strict=True)
    name = recording.row_name
    texts = [name(a) if a == b else f"{name(a)} to {name(b)}" for a, b in ranges]
    count = len(rows)
    what = "frame is" if count == 1 else "frames are"
    why = [reason for reason, frames in recording.reasons.items() if (frames & missing).any()]
    return [
        f"{count} {what} left out, where a marker {listed(why, 'or')}: "
        f"{listed(shortened(texts, MAX_LISTED, 'other ranges'))}"
    ]


def _rigidity(
    recording: MarkerRecording, flat: FloatArray, base: NDArray[np.intp], unit: str
) -> tuple[list[str], list[Advice], tuple[float, float] | None]:
    """How rigid the markers are: in a sentence, a warning where that is no noise, and the noise.

    The standard deviations are None where the digits may explain what there is.
    """
    names = listed(recording.names)
    fit = fit_rigid_body(flat[base])
    size = float(np.abs(fit.shape).max())
    off = np.sqrt((fit.residuals**2).sum(axis=2)).max(axis=1)
    if size > 0 and (sound := off <= 0.5 * MAX_DISTANCE_CHANGE * size).any() and not sound.all():
        base = base[sound]  # frames that are refused where they are selected
        fit = fit_rigid_body(flat[base])
    if len(base) < 3 or not size:
        return [], [], None
    if len(recording.names) == 2:
        rms = 2 * fit.rms  # of the distance: each point takes half of its change
        sentence = f"they are {size:.4g}{unit} apart, give or take {rms:.2g}{unit} (rms)"
    else:
        rms = fit.rms
        sentence = f"as a rigid body they are off by {rms:.2g}{unit} (rms)"
    series = np.full((len(flat), *fit.residuals.shape[1:]), np.nan)
    series[base] = fit.residuals
    jumps = series[2:] - 2 * series[1:-1] + series[:-2]
    jumps = jumps[np.isfinite(jumps).all(axis=(1, 2))]
    warning = []
    half_digit = known_to(0.5 * 10.0**-recording.decimals, extent(flat[base, 0]))
    if len(jumps) >= MIN_TRIPLES and rms > max(MIN_CHANGE * size, 4 * half_digit):
        noise = float(np.sqrt((jumps**2).sum(axis=2).mean() / 6))
        if fit.rms > NOISE_RATIO * noise:
            apart = rms / fit.rms * noise
            warning.append(
                Advice(
                    "W214",
                    f"{names} move against each other: they are not on one rigid body, or not in "
                    "one plane",
                    "choose markers of one body with --points, or another plane with --plane",
                    f"they change by {rms:.2g}{unit} (rms), {100 * rms / size:.2g} % of "
                    f"{size:.4g}{unit}; of that {apart:.2g}{unit} is noise from frame to frame",
                )
            )
    if 2 * half_digit >= fit.noise:
        return [sentence], warning, None
    two = len(recording.names) == 2  # the origin is the first marker as it was seen
    return [sentence], warning, (fit.noise, fit.sigma[1]) if two else fit.sigma
