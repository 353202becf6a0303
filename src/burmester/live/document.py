"""A task as the page holds it: an object with the keys of a task file, always in one form.

Points are poses whose angle is free and not stated.  Angles are in degrees and poses are tables;
outlines are corners, never the name of a drawing: the page names no files of this machine.  What
comes from the page is read by the readers of task files.
"""

from __future__ import annotations

import json
import math
import re
import tomllib
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from burmester.errors import Advice, InputError
from burmester.geometry.regions import Polygon, box
from burmester.io.pose_data import degrees_of
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.functions.function_kind import is_function
from burmester.io.reading.functions.function_options import read_range
from burmester.io.reading.option_text import option_value
from burmester.io.reading.outlines.outline_file import FROM_PAGE
from burmester.io.reading.pose_table import Source
from burmester.io.reading.poses import read_task
from burmester.io.result import task_data
from burmester.live.plain import plain
from burmester.tasks.function_task import FunctionTask
from burmester.tasks.limits import KINDS
from burmester.tasks.motion_task import Task
from burmester.tasks.option_table import STUDIO_OPTIONS
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances, nominal_values

MOST_POSES = 100_000  # of a document
NAME = "task.json"  # what a document is called where a message says its place

_OF_POSES = ("poses", "path", "crank", "angle_unit", "length_unit", "pose_sigma", "tolerance")


def task_of(document: object) -> Task:
    """The task in a document; raises what reading a task file raises."""
    _require_moderate(document)
    try:
        return read_file(NAME, json.dumps(document).encode("ascii"))
    except InputError:
        # Once more in short lines: a message shows the line it is about.
        return read_file(NAME, json.dumps(document, indent=1).encode("ascii"))


def function_of(document: object) -> FunctionTask:
    """The function task in a document, whose `x` may be a text such as "0:pi/2".

    Raises what reading a file of a function raises.
    """
    stated = document.get("function") if isinstance(document, dict) else None
    if isinstance(stated, dict) and isinstance(x := stated.get("x"), str):
        stated = {**stated, "x": list(read_range(Source("x", x)))}
    return read_function(json.dumps({"function": stated}).encode("ascii"), NAME)


def is_of_function(document: object) -> bool:
    """Whether a document is a function task, whatever is wrong with it."""
    return isinstance(document, dict) and "function" in document


def read_document(name: str, data: bytes, **options: Any) -> tuple[dict[str, Any], list[Advice]]:
    """The task in a file that a page sent, of poses or a function, and how it was read."""
    if is_function(data, name):
        task = read_function(data, name)
        return function_document(task), list(task.notes)
    poses = read_file(name, data, **options)
    return document_of(poses), list(poses.notes)


def function_document(task: FunctionTask) -> dict[str, Any]:
    """A function task as a document."""
    from burmester.io.function_result import function_task_data  # noqa: PLC0415  loads its search

    stated = function_task_data(task)["function"]
    if isinstance(pairs := stated["pairs"], list):  # to the digits that a person wrote
        stated["pairs"] = [[float(f"{each:.12g}") for each in pair] for pair in pairs]
    return {"function": plain(stated)}


class TaskReader:
    """Reads documents one after the other, of which mostly the poses are others than before."""

    def __init__(self) -> None:
        self._beside: tuple[str, Task] | None = None

    def task_of(self, document: Any) -> Task:
        """The same as `task_of`: what stands beside the poses is read again if it has changed."""
        if not isinstance(document, dict):
            return task_of(document)
        beside = json.dumps({key: each for key, each in document.items() if key != "poses"})
        if self._beside is not None and self._beside[0] == beside:
            poses = {key: document[key] for key in _OF_POSES if key in document}
            known = self._beside[1]
            with suppress(InputError):  # the whole document says where
                return replace(
                    task_of(poses),
                    body=known.body,
                    surroundings=known.surroundings,
                    limits=known.limits,
                    requirements=known.requirements,
                    loads=known.loads,
                    notes=known.notes,
                )
        task = task_of(document)
        self._beside = beside, task
        return task


def read_file(name: str, data: bytes, **options: Any) -> Task:
    """The task in a file that a page sent; its name says what kind of file it is."""
    try:
        task = read_task(f"{FROM_PAGE}{name}", data=data, **options)
        notes = [replace(each, message=each.message.replace(FROM_PAGE, "")) for each in task.notes]
        return replace(task, notes=tuple(notes))
    except InputError as error:
        error.where = error.where and error.where.replace(FROM_PAGE, "")
        raise


def _require_moderate(document: object) -> None:
    poses = document.get("poses") if isinstance(document, dict) else None
    if isinstance(poses, list) and len(poses) > MOST_POSES:
        raise InputError(
            "E126",
            f"{len(poses)} poses are too many for a page",
            why=f"{MOST_POSES} are the most",
            help="use `burmester synthesize` with the file, or take fewer poses",
        )


def options_of(options: object, time_limit: float | None = None) -> SynthesisOptions:
    """How a task is to be solved: options of `burmester synthesize`, by their long names.

    Raises E100 for an option that the studio does not know, E134 for a value that cannot be.
    """
    given = {} if options is None else options
    if not isinstance(given, dict):
        raise InputError("E100", "the options are no object", help='give {"method": "auto"}')
    found: dict[str, Any] = {}
    for name, value in given.items():
        if name not in STUDIO_OPTIONS:
            message, help = f"there is no option {str(name)[:40]!r}", "the studio has "
            raise InputError("E100", message, help=help + ", ".join(STUDIO_OPTIONS))
        if value is not None:
            option = STUDIO_OPTIONS[name]
            text = value if option.known else str(value)
            if option.form == "flag":
                found[option.name] = value is not option.negated if type(value) is bool else value
            else:
                several = option.form == "lengths"
                found[option.name] = option_value(option, [text] if several else text)
    return SynthesisOptions(**found, time_limit=time_limit)


def document_of(task: Task) -> dict[str, Any]:
    """A task as a document: read again it is the same task."""
    stated, usual, blank = task_data(task), _usual_tolerance(task), _blank_angles(task)
    document: dict[str, Any] = {} if task.length_unit is None else {"length_unit": task.length_unit}
    document["angle_unit"] = "deg"
    document["poses"] = [
        _pose(each, blank=blank[number], usual=usual is not None)
        for number, each in enumerate(stated["poses"])
    ]
    if usual is not None:
        document["tolerance"] = usual
    document |= {key: stated[key] for key in _BESIDE_POSES if key in stated}
    for each in document.get("limits", ()):
        if len(each["kinds"]) == len(KINDS):
            del each["kinds"]
    return _with_digits(dict(plain(with_boxes(document))), task)


_BESIDE_POSES = (
    *("crank", "path", "body", "keep_out", "surroundings", "limits", "requirements"),
    *("loads", "springs", "drive"),
)
_NOT_STATED = {"name": "", "weight": 1, "exact": False}


def _pose(stated: dict[str, Any], *, blank: bool, usual: bool) -> dict[str, Any]:
    """A pose; blank: without its angle; usual: without its tolerance."""
    pose = {"x": stated["x"], "y": stated["y"]}
    if not blank:
        pose["angle"] = stated["angle_deg"]
    for key in (*_NOT_STATED, *(() if usual else ("tolerance",)), "free", "crank_deg"):
        if key in stated and stated[key] != _NOT_STATED.get(key):
            pose[key] = stated[key]
    return pose


def _blank_angles(task: Task) -> list[bool]:
    """Which angles a document does not state: free ones, where they are what a blank is read as."""
    count = task.poses.shape[0]
    free = np.zeros(count, bool) if task.tolerances is None else task.tolerances.free[:, 2]
    angles = np.array([degrees_of(float(each)) for each in task.poses.angle])
    read = np.radians(nominal_values(np.where(free, np.nan, angles), free, turn=360.0))
    same = bool(np.array_equal(read[free], task.poses.angle[free]))
    return free.tolist() if same else [False] * count


def _usual_tolerance(task: Task) -> dict[str, Any] | None:
    """The tolerance of all poses, where they have one and only angles are free; else None."""
    stated: PoseTolerances | None = task.tolerances
    if stated is None or task.exact is not None or set(stated.axes) != {"fixed"}:
        return None
    bounds, free = stated.bounds, stated.free
    if free[:, :2].any() or not free[:, 2].any() or (bounds[:, :2] != bounds[0, :2]).any():
        return None
    angles = np.unique(bounds[~free[:, 2], 2])
    if len(angles) > 1:
        return None
    x, y = bounds[0, :2].tolist()
    angle = degrees_of(float(angles[0])) if len(angles) else 0
    return {"x": plain(x), "y": plain(y), "angle_deg": plain(angle)}


def with_boxes(tree: Any) -> Any:
    """A tree of data whose polygons that a box makes are boxes."""
    if isinstance(tree, list):
        return [with_boxes(each) for each in tree]
    if not isinstance(tree, dict):
        return tree
    tree = {key: with_boxes(each) for key, each in tree.items()}
    if "polygon" in tree:
        corners = np.array(tree["polygon"])
        ends = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        same = box(*ends)
        if isinstance(same, Polygon) and np.array_equal(same.vertices, corners):
            del tree["polygon"]
            tree["box"] = list(ends)
    return tree


def _with_digits(document: dict[str, Any], task: Task) -> dict[str, Any]:
    """The document with `pose_sigma` where its digits say less, or more, than those of the task.

    12.00 says more than 12, and measured poses may state how exactly they are known.
    """
    if task_of(document).resolution == task.resolution:
        return document
    position, angle = (known / math.sqrt(3) for known in task.resolution)
    return {**document, "pose_sigma": {"position": position, "angle_deg": math.degrees(angle)}}


def picture_in(name: str, data: bytes) -> Any:
    """The picture behind the plane that a task file keeps, whatever it is; None where none is.

    Raises ValueError where it is no such file.
    """
    text = data.decode("utf-8-sig")
    tree = tomllib.loads(text) if name.lower().endswith(".toml") else json.loads(text)
    return tree.get("picture") if isinstance(tree, dict) else None


def task_file(document: dict[str, Any], picture: object = None) -> str:
    """A document as a task file in TOML, which `burmester` reads as the same task.

    picture: what lies behind the plane, with its place; only pages read it.
    """
    if is_of_function(document):
        document = function_document(function_of(document))
    else:
        task_of(document)  # what is not read is not written
    tree = plain(document | ({"picture": picture} if isinstance(picture, dict) else {}))
    lines = [f"{key} = {_toml(value)}" for key, value in tree.items() if key not in _TABLES]
    for key in _TABLES:
        if key not in tree:
            continue
        tables = tree[key] if isinstance(tree[key], list) else [tree[key]]
        head = f"[[{key}]]" if isinstance(tree[key], list) else f"[{key}]"
        for table in tables:
            lines += ["", head, *(f"{_key(name)} = {_toml(each)}" for name, each in table.items())]
    return "\n".join(lines) + "\n"


_TABLES = (
    *("function", "keep_out", "surroundings", "limits", "requirements", "loads", "springs"),
    *("drive", "picture"),
)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        inside = ", ".join(f"{_key(name)} = {_toml(each)}" for name, each in value.items())
        return f"{{ {inside} }}" if inside else "{}"
    if isinstance(value, list):
        texts = [_toml(each) for each in value]
        if value and isinstance(value[0], dict):
            return "[\n" + "".join(f"  {text},\n" for text in texts) + "]"
        return f"[{', '.join(texts)}]"
    return _quoted(value) if isinstance(value, str) else repr(value)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _quoted(name)


def _quoted(text: str) -> str:
    """A text in quotes: JSON's escapes are TOML's, but for half characters and DEL."""
    whole = text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    return json.dumps(whole, ensure_ascii=False).replace("\x7f", "\\u007f")
