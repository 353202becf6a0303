"""What `burmester synthesize --json` printed, read back: the task and its linkages.

The linkages are not taken on trust: each is driven anew, and has to come as near to the poses as
the file says.

E101 not readable                        E151 no such linkage, or none at all
E109 not JSON                            E152 a linkage that does not do what the file says
E150 JSON, but not of `synthesize`
"""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.io.reading.file_content import read_source
from burmester.io.reading.poses import read_task
from burmester.io.result import SCHEMA
from burmester.linkages.found_linkage import Side, with_driver_first
from burmester.synthesis.result import Outcome
from burmester.tasks.motion_task import Task, characteristic_length

__all__ = ["Result", "SavedLinkage", "read_result"]

ERROR_TOLERANCE = 1e-6  # characteristic lengths, between stated errors and those computed anew


@dataclass(frozen=True, slots=True, eq=False)
class SavedLinkage:
    """A linkage of a result: its driver first, and its places for the poses.

    error: of the places at the poses.
    driver: which of the two dyads of the file is first here; it is None in the file where the
    linkage is not usable, and then the first one.
    least_transmission: the least transmission angle between the poses, in radians.
    other_types: the other types that the uncertainty of the links leaves possible.
    """

    id: str
    linkage: Linkage
    ids: tuple[str, str]
    usable: bool
    driver: Side
    type: str
    task: Task
    error: PoseError
    least_transmission: float = math.nan
    other_types: tuple[str, ...] = ()

    @property
    def unit(self) -> str | None:
        """The unit of lengths."""
        return self.task.length_unit


class Result(NamedTuple):
    """A result: where it came from, its task, its linkages by rank, and its outcome."""

    label: str
    task: Task
    linkages: tuple[SavedLinkage, ...]
    outcome: Outcome

    def choose(self, id: str | None = None) -> SavedLinkage:
        """A linkage by its id, or the first; raises E151."""
        known = [each.id for each in self.linkages]
        if not known:
            raise InputError(
                "E151",
                "there is no linkage in this result",
                where=self.label,
                help="give poses that have one; `burmester explain R301` says more",
            )
        for each in self.linkages:
            if id is None or each.id.lower() == id.lower():
                return each
        raise InputError(
            "E151",
            f"there is no linkage {id} in this result",
            where=self.label,
            why=f"it has {', '.join(known)}",
            help=f"give --linkage {known[0]}",
        )


def read_result(source: str | os.PathLike[str]) -> Result:
    """The result in a file, or on standard input ("-"); raises E101, E109, E150 and E152."""
    path = os.fspath(source)
    label = "<stdin>" if path == "-" else path
    help = "make it with `burmester synthesize POSES -o result.json`"
    data = read_source(path)
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise InputError(
            "E109", "this is not JSON", where=label, why=str(error), help=help
        ) from None
    if not isinstance(tree, dict) or tree.get("schema") != SCHEMA:
        message = f"this is no result of synthesize: its schema is not {SCHEMA}"
        raise InputError("E150", message, where=label, help=help)
    if tree.get("task") is None:
        message = "this result has no task: the poses could not be used"
        raise InputError("E150", message, where=label, help=help)
    try:
        task = read_task("-", data=data)
    except InputError as error:
        error.where = (error.where or "").replace("<stdin>", label)
        raise
    linkages = []
    for number, each in enumerate(tree.get("linkages", [])):
        try:
            linkages.append(_linkage(each, task))
        except (KeyError, TypeError, ValueError) as error:
            message = f"linkage {number + 1} of this result cannot be read"
            raise InputError("E150", message, where=label, why=repr(error), help=help) from None
        except InputError as error:
            error.where = label
            raise
    try:
        outcome = Outcome(**{key: tree["outcome"].get(key) for key in Outcome.__slots__})
    except (KeyError, AttributeError) as error:
        message = "the outcome of this result cannot be read"
        raise InputError("E150", message, where=label, why=repr(error), help=help) from None
    return Result(label, task, tuple(linkages), outcome)


def _linkage(data: dict[str, Any], task: Task) -> SavedLinkage:
    first, second = (_dyad(each) for each in data["dyads"])
    side: Side = data["driver"] or "first"
    own = Linkage(first, second)
    stated = data["position_error"]["max"]
    size = characteristic_length(task)
    if "coupler" in data and stated is not None:
        places = Displacement(
            np.array([[place["x"], place["y"]] for place in data["coupler"]]),
            np.radians([place["angle_deg"] for place in data["coupler"]]),
        )
        error = PoseError.at(places, task.poses)
        off = max(float(np.abs(dyad.residual(places)).max()) for dyad in (first, second))
        if not (
            off <= ERROR_TOLERANCE * size and abs(error.worst - stated) <= ERROR_TOLERANCE * size
        ):
            raise InputError(
                "E152",
                f"linkage {data['id']} does not do what the file says of it",
                why=f"at the places that the file gives its links are off by {off:.2g}",
                help="the file has been changed: make it anew with "
                "`burmester synthesize POSES -o result.json`",
            )
    else:
        error = PoseError.of(own, task.poses, size)
    ids = (data["dyads"][0]["id"], data["dyads"][1]["id"])
    least = data.get("min_transmission_angle_deg", {}).get("range")
    return SavedLinkage(
        data["id"],
        with_driver_first(own, side),
        ids if side == "first" else ids[::-1],
        bool(data["usable"]),
        side,
        data["type"],
        task,
        error,
        math.nan if least is None else math.radians(least),
        tuple(map(str, data.get("possible_types", [])[1:])),
    )


def _dyad(data: dict[str, Any]) -> Dyad:
    """A dyad as `linkage_data.dyad_data` tells it."""

    def point(key: str) -> np.ndarray:
        values = np.array(data[key], dtype=np.float64)
        if values.shape != (2,) or not np.isfinite(values).all():
            raise ValueError(f"{key} is {data[key]}, not a point")
        return values

    kind = data["kind"]
    if kind == "PP":
        return PP(np.array(math.radians(data["angle_deg"])))
    if kind == "RR":
        return RR(point("fixed_pivot"), point("moving_pivot"), np.array(float(data["radius"])))
    line = data["line"]
    normal, offset = np.array(math.radians(line["normal_deg"])), np.array(float(line["offset"]))
    if kind == "PR":
        return PR(normal, offset, point("moving_pivot"))
    if kind == "RP":
        return RP(point("fixed_pivot"), normal, offset)
    raise ValueError(f"there is no dyad of kind {kind!r}")
