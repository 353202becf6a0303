"""A task from a file: poses in CSV, .xlsx, JSON, TOML, Parquet; a specification in JSON and TOML.

Recordings of markers are read as well, as motion capture exports them (`marker_header`).

A number is taken as the nearest double or refused, never changed: no guessed units, no guessed
decimal marks, thousands only where they have one meaning; digits beyond a double's are rounded,
but 1e-400 is refused as 1e400 is.  What is passed over or assumed is among the task's notes (W213).
An error's `where` holds
`file:line:column`, then the line with a caret below; the column is that of the first
character at fault, counted from 1.  Numbers in JSON and TOML are pointed at by their path,
`poses[3].x`, counted from 0 as in the file; those in Parquet by row, from 1, and column;
those in a sheet by their cell.

E101 not readable, or not text      E106 a row or pose of the wrong length
E102 no poses in it                 E107 a column or key that is not known
E103 a number that is not finite    E108 given twice, or contradictory
E104 not a number, or ambiguous     E109 not JSON or TOML at all
E105 header, column or key missing  E110 angle unit missing or contradicted
E111 points that give no pose       E122 no such pose to be exact, or left out
E113 not in one plane               E115 no such convention
E114 markers not known or chosen    E116 no cosine and sine of an angle
E117 a link that cannot be read
E130 a library is missing           E135 a malformed tolerance of a pose
E136 tolerances that contradict themselves
E170 to E176 drawings and surroundings
E186 to E188 paths
E193 the task of a function generator, not of poses
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING, Literal

import numpy as np

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.io.reading.conventions import convention_names, in_convention, with_stated_unit
from burmester.io.reading.file_content import read_source, require_moderate
from burmester.io.reading.markers.tracked_points import TrackedRows, tracked_poses
from burmester.io.reading.outline_options import OutlineOptions
from burmester.io.reading.pose_table import (
    UNITS,
    CrankOptions,
    PoseTable,
    Source,
    extent,
    resolution_by_digits,
)
from burmester.io.reading.row_selection import RowLabels, RowSelection, row_marks
from burmester.io.reading.specification import Specification, combined_requirements, one_line
from burmester.io.reading.stated_tolerances import DefaultTolerance, combined_tolerances
from burmester.io.reading.tables.text_source import label_of, text_source
from burmester.numerics.arrays import FloatArray
from burmester.printable import blanked, printable
from burmester.tasks.crank_timing import CrankTiming
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import nominal_rows
from burmester.tasks.traced_path import TracedPath

if TYPE_CHECKING:  # a reader is loaded with the first file that needs it
    from burmester.io.reading.markers.marker_recording import MarkerRecording

_DRAWING = re.compile(r"\.(?:svg|dxf)(?::|$)", re.IGNORECASE)
_FORMATS = {".csv": "CSV", ".tsv": "CSV", ".txt": "CSV", ".json": "JSON", ".toml": "TOML"}


def read_task(
    source: str | os.PathLike[str],
    *,
    angle_unit: Literal["deg", "rad"] | None = None,
    specification: Specification | None = None,
    exact: Sequence[str] = (),
    pose_sigma: tuple[float, float] | None = None,
    tolerance: DefaultTolerance | None = None,
    columns: str | None = None,
    sheet: str | None = None,
    points: str | None = None,
    plane: str | None = None,
    drop: Sequence[str] = (),
    every: int | None = None,
    first: str | None = None,
    last: str | None = None,
    closed: bool = False,
    absolute_crank: bool = False,
    within_crank_deg: float | None = None,
    convention: str | None = None,
    outlines: OutlineOptions = OutlineOptions(),  # noqa: B008  frozen
    data: bytes | None = None,
) -> Task:
    """Read the task in a file, in a link, on standard input or in a carried case.

    A file that begins as Parquet files and .xlsx workbooks do is read as such; .csv, .tsv and .txt
    are CSV; .json and .toml are JSON and TOML; of a .svg or .dxf drawing the curve is the path to
    trace; any other file is JSON if it begins with a bracket, else CSV.

    Parameters
    ----------
    source : str or path
        A file, a link (`#t1=...`, whole or without its address), "-" for standard input, or
        "case:NAME" for a carried case.
    angle_unit : "deg" or "rad", optional
        Unit of the angles where the file states none.  It is never guessed.
    specification : Specification, optional
        Limits and requirements in addition to those in the file.
    exact : sequence of str
        Poses to be met exactly, each text with numbers from 1 or names, separated by commas.
    pose_sigma : (float, float), optional
        Standard deviations of the positions (unit of the poses) and of the angles (radians).  The
        task's resolution is sqrt(3) times as much.  Without it, a standard deviation in the file
        is used, or for two tracked points one from the variation of their distance; else the
        resolution is half of the last digit printed, and 0 where that is coarse
        (`resolution_by_digits`).
    tolerance : DefaultTolerance, optional
        How far from a pose the body may be, for all poses that the file states nothing of.
    columns : str, optional
        The header of a CSV file or a sheet that has none, separated by commas: "x,y,angle_deg".
        It replaces a header that is there.
    sheet : str, optional
        The sheet of an .xlsx workbook, by its name or its number from 1.  By default the first
        that is not hidden.
    points : str, optional
        The markers of a recording that are on the body, separated by commas.  The first is its
        origin, and its x axis points to the second.  Three or more are fitted as a rigid body.
        By default the only two of a file.
    plane : str, optional
        The axes of a recording that become x and y, such as "XZ", or "fit" for the plane nearest
        to the motion.  By default the axis along which the markers hardly move is passed over.
    drop : sequence of str
        Poses to leave out, written as those of `exact`.
    every : int, optional
        Take every Nth pose only, beginning with the first one.
    first, last : str, optional
        Take the poses from the first to the last one, both included, written as those of `exact`,
        or as a time such as "1.5s" where the file has times.

    closed : bool
        The points of a path lead back to the first one, and the crank goes all the way round.
    absolute_crank : bool
        The crank angles of poses are directions in F, and not rotations from the first of them.
    within_crank_deg : float, optional
        How far each crank angle may be missed, in degrees.
    convention : str, optional
        What the file does otherwise than here, separated by commas: "clockwise" (its angles count
        clockwise), "y-down" (its y points down, its angles count counterclockwise), "swap-xy" (x
        and y are exchanged), "radians" or "degrees" (whatever its header says).  Limits and
        outlines are taken as they are given.

    Poses are numbered as in the file, whichever are left out, and take these numbers as their
    names if they have none.  In a recording they are the numbers of its frames.
    outlines : OutlineOptions
        Outlines in drawings: of the body, of keep-out regions; and the width of the links.
    data : bytes, optional
        The content of the source, if it has been read already.

    Returns
    -------
    Task
        The poses with weights, names, resolution, exact marks, limits and requirements.

    Raises
    ------
    InputError
        E101 to E116, E122, E130 and E170 to E176 as listed above, and the errors of `Limits`,
        `Requirements` and `Task`.

    Examples
    --------
    >>> from burmester import read_task
    >>> task = read_task("case:ge2012-exact")
    >>> task.poses.shape
    (10,)
    >>> read_task("case:ge2012-exact", drop=["2,4"]).poses.shape
    (8,)

    """
    if angle_unit not in (None, *UNITS):
        raise InputError("E110", f"there is no angle unit {angle_unit!r}", help="give deg or rad")
    names, path = convention_names(convention), os.fspath(source)
    label = label_of(path)
    try:
        table = _table(path, data, columns, sheet=sheet, points=points, closed=closed)
        if closed:
            table = _closed(table)
        return _task(
            *_selected(table, RowSelection(every, first, last, drop), exact, plane),
            angle_unit=angle_unit,
            specification=specification,
            pose_sigma=pose_sigma,
            outlines=outlines,
            tolerance=tolerance,
            convention=names,
            crank=CrankOptions(absolute_crank, within_crank_deg and math.radians(within_crank_deg)),
        )
    except InputError as error:
        error.where = blanked(error.where or label)
        error.message = printable(error.message)
        error.why = error.why and printable(error.why)
        if error.help:  # a tab may separate the cells of a line to be written
            error.help = "\t".join(map(printable, error.help.split("\t")))
        raise


def _refuse_function(label: str, text: str) -> None:
    """E193, for the task of a function generator, which has no poses."""
    from burmester.io.reading.functions.function_kind import is_function_text

    if is_function_text(text, label):
        raise InputError(
            "E193",
            "this is the task of a function generator, and poses are needed here",
            why="it has pairs of input and output angles, or a function, and no places of a body",
            help="solve it with `burmester function`, which also writes a result to export",
        )


def _closed(table: PoseTable | MarkerRecording) -> PoseTable:
    """The points of a table as a closed path; raises E187."""
    if not isinstance(table, PoseTable) or table.path is None:
        raise InputError(
            "E187",
            "--closed is for points that are traced, and this file has poses",
            why="the angle of the body counts, so that the points are no path alone",
            help="leave --closed out, or give the points alone, in columns x and y",
        )
    return table._replace(path=TracedPath(True, table.path.crank_angles))


def _table(
    path: str,
    data: bytes | None,
    columns: str | None,
    *,
    sheet: str | None,
    points: str | None,
    closed: bool,
) -> PoseTable | MarkerRecording:
    """The table in a file, by its first bytes and its suffix."""
    label = label_of(path)
    if _DRAWING.search(path):
        from burmester.io.reading.outlines.outline_file import drawing_named, read_drawn_path

        if (drawing := drawing_named(path)) is not None:
            for option, value in {"columns": columns, "sheet": sheet, "points": points}.items():
                if value is not None:
                    message = f"--{option} is for tables, and this file is a drawing"
                    raise InputError("E108", message, help=f"leave --{option} out")
            return read_drawn_path(drawing, data)
    data = read_source(path) if data is None else data
    if columns is not None and points is not None:
        message = "--columns names the columns of poses, --points markers of a recording"
        raise InputError("E108", message, where=label, help="leave one of the two out")
    suffix = PurePath(label).suffix.lower()
    source = text_source(data, path, sheet)
    del data  # a million poses are many bytes
    by_content = "JSON" if source.text.lstrip().startswith(("{", "[")) else "CSV"
    language = "CSV" if source.sheet else _FORMATS.get(suffix, by_content)
    require_moderate(source.text, tree=language != "CSV")
    if columns is not None and (source.names_columns or language != "CSV"):
        message = "--columns is for CSV files and sheets; this file names its columns itself"
        raise InputError("E108", message, help="leave --columns out")
    if columns is None:
        _refuse_function("" if source.sheet else label, source.text)
    if language == "CSV":
        return _rows(source, columns, points, closed=closed)
    from burmester.io.reading.trees.documents import read_json, read_toml

    _require_no_points(label, points)
    return read_json(source) if language == "JSON" else read_toml(source)


def _rows(
    source: Source, columns: str | None, points: str | None, *, closed: bool
) -> PoseTable | MarkerRecording:
    """The table in CSV or in a sheet: poses, markers, or rows pasted from CAD."""
    from burmester.io.reading.markers.marker_header import read_marker_header
    from burmester.io.reading.tables.cad_rows import is_cad_text, read_cad_rows
    from burmester.io.reading.tables.pose_rows import read_poses

    if columns is None and (header := read_marker_header(source)) is not None:
        from burmester.io.reading.markers.marker_recording import chosen_markers

        return chosen_markers(header, points)
    _require_no_points(source.label, points)
    if columns is None and is_cad_text(source.text):
        return read_cad_rows(source)
    return read_poses(source, columns, closed=closed)


def _require_no_points(label: str, points: str | None) -> None:
    """Refuse --points for a file without markers."""
    if points is None:
        return
    message = "--points names markers, and this file has no columns of markers"
    why = "columns of markers are M1:X, M1:Y, M2:X and so on, or names above a line of X, Y and Z"
    raise InputError("E114", message, where=label, why=why, help="leave --points out")


def _selected(
    table: PoseTable | MarkerRecording,
    selection: RowSelection,
    exact: Sequence[str],
    plane: str | None,
) -> tuple[PoseTable, TrackedRows, int]:
    """The rows that are asked for, of poses or of a recording, and how many are left out."""
    if not isinstance(table, PoseTable):
        from burmester.io.reading.markers.marker_poses import recorded_poses

        labels = table.labels
        usable = selection.in_range(labels) & ~row_marks("--drop", selection.drop, labels)
        poses, kept = recorded_poses(table, selection.kept(labels), usable, plane)
        frames = [labels.names[k] for k in kept] if labels.frames else None
        tracked = TrackedRows(kept, table.locate_row, table.names, frames)
        marks = row_marks("--exact", exact, labels)
    else:
        if plane is not None:
            message = "--plane is for recordings of markers, and this file has poses"
            raise InputError("E108", message, help="leave --plane out")
        labels = RowLabels(len(table.rows.values), table.rows.names, times=table.times)
        kept = np.flatnonzero(selection.kept(labels))
        poses = table
        if len(kept) < labels.size:
            path = table.path and table.path.at(kept)
            poses = table._replace(rows=table.rows.at(kept), path=path)
        tracked = TrackedRows(kept, table.locate_row)
        marks = row_marks("--exact", exact, labels)
        if any(table.rows.exact):
            if exact:
                message = "poses are marked exact in the file and by --exact"
                help = "leave --exact out, or the marks in the file"
                raise InputError("E108", message, help=help)
            marks = np.array(table.rows.exact)
    lost = marks.copy()
    lost[kept] = False
    if exact and lost.any():
        number = int(lost.argmax())
        name = labels.names[number] if labels.frames else str(number + 1)
        message = f"pose {name} is left out and marked by --exact"
        help = "leave it out of --exact, or take it in with --drop, --every, --from and --to"
        raise InputError("E108", message, help=help)
    rows = poses.rows._replace(names=labels.of_kept(kept), exact=marks[kept].tolist())
    return poses._replace(rows=rows), tracked, labels.size - len(kept)


def _task(
    table: PoseTable,
    tracked: TrackedRows,
    left_out: int,
    *,
    angle_unit: str | None,
    specification: Specification | None,
    pose_sigma: tuple[float, float] | None,
    outlines: OutlineOptions,
    tolerance: DefaultTolerance | None,
    convention: tuple[str, ...],
    crank: CrankOptions,
) -> Task:
    """The task in the rows of a table that are taken."""
    table = with_stated_unit(table, convention)
    rows = table.rows
    values, exact = rows.values, np.array(rows.exact) if any(rows.exact) else None
    measured = None
    if rows.points:
        coordinates = values[:, : 2 * rows.points]
        poses, resolution, measured = tracked_poses(coordinates, rows.decimals[0], tracked)
    else:
        unit = _angle_unit(table, values, angle_unit)
        nominal = nominal_rows(values[:, :3], np.isnan(values[:, :3]), unit)
        values = np.column_stack([nominal, values[:, 3:]])
        poses, resolution = _oriented(table, values, unit)
        poses = in_convention(poses, convention)
    for stated in (pose_sigma, table.pose_sigma, measured):
        if stated is not None:
            resolution = (math.sqrt(3) * stated[0], math.sqrt(3) * stated[1])
            break
    stated_in_file = table.specification
    whole = stated_in_file.merged(specification) if specification else stated_in_file
    body, body_notes = outlines.body_beside(table.body, table.length_unit)
    around, region_notes = outlines.surroundings_beside(table.surroundings, table.length_unit)
    numbers = 2 * rows.points or 3  # in a row, before its weight
    path, timing = _timing(table, tracked, crank, angle_unit, "clockwise" in convention)
    if table.tolerance and tolerance:
        message = "the tolerance of all poses is in the file and in --pose-tolerance"
        where = one_line(table.tolerance.where, tolerance.where)
        raise InputError("E108", message, where=where, help="leave one of the two out")
    try:
        tolerances = combined_tolerances(
            rows.tolerances,
            tolerance or table.tolerance,
            len(values),
            exact,
            table.angle_unit or angle_unit or "deg",
        )
        return Task(
            poses,
            weights=values[:, numbers] if values.shape[1] > numbers else None,
            names=tuple(rows.names) or None,
            length_unit=table.length_unit,
            resolution=resolution,
            exact=exact,
            limits=whole.limits(),
            requirements=combined_requirements(whole.requirements),
            body=body,
            surroundings=around.surroundings(),
            loads=table.loads,
            tolerances=tolerances,
            notes=table.notes + body_notes + region_notes,
            read_as=table.read_as,
            path=path,
            timing=timing,
        )
    except InputError as error:
        if error.code in ("E132", "E134"):  # limits and requirements, not the poses
            error.where = error.where or whole.locations
        elif error.code in ("E175", "E177", "E178", "E179"):  # outlines at a pose, or loads
            place = around.where if error.code == "E175" else table.where_loads
            error.where = error.where or place or None
        elif error.code == "E120" and table.locate_row and not error.where:  # too few poses
            error.where = table.locate_row(None)
        elif error.code in ("E135", "E136") and table.locate_row and not error.where:
            found = re.match("pose ([0-9]+)", error.message)
            row = int(tracked.numbers[int(found[1]) - 1]) if found else None
            error.where = table.locate_row(row)
            if found and row is not None:
                error.message = f"pose {row + 1}{error.message[found.end() :]}"
        if error.code == "E120" and left_out:
            error.why = f"{left_out} of {left_out + len(values)} poses of the file are left out"
            error.help = "take more of them with --every, --from, --to and --drop"
        raise


def _timing(
    table: PoseTable,
    tracked: TrackedRows,
    asked: CrankOptions,
    angle_unit: str | None,
    clockwise: bool,
) -> tuple[TracedPath | None, CrankTiming | None]:
    """How the crank times the rows: of points alone a path, else the poses; raises E186."""
    options = CrankOptions(
        asked.absolute or table.crank.absolute,
        table.crank.within if asked.within is None else asked.within,
    )
    path, given = table.path, table.rows.crank
    if given is None or not (np.isfinite(given).any() or path):
        if options != CrankOptions():
            raise InputError(
                "E186",
                "it is said how crank angles are meant, and no pose has one",
                help="give a column crank_deg, or leave out what is said of the crank",
            )
        return path, None
    unit = table.crank_unit or table.angle_unit or angle_unit
    if unit is None:
        raise InputError(
            "E186",
            "the unit of the crank angles is not stated",
            help="name the column crank_deg or crank_rad",
        )
    angles = (np.radians(given) if unit == "deg" else given) * (-1.0 if clockwise else 1.0)
    if not np.isnan(table.rows.values[:, 2]).all() or table.rows.points:
        return path, CrankTiming(angles, options.absolute, options.within)
    if (blank := np.isnan(angles)).any():
        row = int(tracked.numbers[blank.argmax()])
        message = f"row {row + 1} has no crank angle"
        help = "give every point its crank angle, or delete the column"
        where = table.locate_row(row) if table.locate_row else None
        raise InputError("E186", message, where=where, help=help)
    return TracedPath(path is not None and path.closed, angles), None


def _angle_unit(table: PoseTable, values: FloatArray, angle_unit: str | None) -> str:
    """The unit of the angles, if it is beyond doubt; raises E110."""
    angles, stated = values[:, 2][np.isfinite(values[:, 2])], table.angle_unit
    if stated and angle_unit and stated != angle_unit:
        message = f"the file states {UNITS[stated]}, --angle-unit states {UNITS[angle_unit]}"
        help = "leave --angle-unit out, or correct the unit in the file"
        raise InputError("E110", message, where=table.where, help=help)
    unit = stated or angle_unit
    if not unit and len(angles):
        message = "the angle unit is not stated and both readings are possible"
        why = _both_readings(float(angles.min()), float(angles.max()), len(angles))
        help = f"{table.say_unit}, or pass --angle-unit deg or --angle-unit rad"
        raise InputError("E110", message, where=table.where, why=why, help=help)
    return unit or "deg"


def _oriented(
    table: PoseTable, values: FloatArray, unit: str
) -> tuple[Displacement, tuple[float, float]]:
    """Poses from x, y, angle, and their resolution."""
    angles = values[:, 2]
    length, angle = (0.5 * 10.0**-printed for printed in table.rows.decimals)
    if unit == "deg":
        angles, angle = np.radians(angles), math.radians(angle)
    known = resolution_by_digits(length, extent(values[:, :2])), resolution_by_digits(angle, 1.0)
    return Displacement(values[:, :2], angles), known


def _both_readings(least: float, most: float, count: int) -> str:
    """How far the body turns if the angles are degrees, and if they are radians."""
    if count == 1:
        as_radians = f"{math.degrees(least):g} deg as radians"
        return f"the angle is {least:g}: {least:g} deg as degrees, {as_radians}"
    small = max(-least, most) <= 2 * math.pi
    lie = "within +-6.28" if small else f"between {least:g} and {most:g}"
    turns = (most - least, math.degrees(most - least))
    as_deg, as_rad = (f"{turn:.1f}" if 0.1 <= turn < 1e5 else f"{turn:.3g}" for turn in turns)
    return (
        f"all {count} angles lie {lie}. "
        f"As degrees the body turns {as_deg} deg in total, as radians {as_rad} deg"
    )
