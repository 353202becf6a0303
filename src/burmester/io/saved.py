"""What `burmester synthesize --json` printed, read back: the task and its linkages.

A result is input like any other.  `saved_model` says what may stand in it, and `agreement` computes
again what its dyads and poses determine: no number and no verdict is taken on trust.

E101 not readable                        E151 no such linkage, or none at all
E109 not JSON                            E152 a linkage that does not do what the file says
E150 JSON, but not of `synthesize`
"""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from burmester.errors import InputError
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.io.reading.file_content import read_source
from burmester.io.reading.pose_table import held_float
from burmester.io.reading.poses import read_task
from burmester.io.result import SCHEMA
from burmester.printable import printable
from burmester.synthesis.result import Outcome
from burmester.tasks.motion_task import Task
from burmester.verdicts.found_linkage import Side
from burmester.verdicts.quality import Quality

if TYPE_CHECKING:
    from burmester.io.saved_model import WrittenLinkage
    from burmester.io.saved_six_bars import SavedSixBar

__all__ = ["Result", "SavedLinkage", "read_result"]

HELP = "make it with `burmester synthesize POSES -o result.json`"
MOST_DIGITS = 20  # of a whole number; no longer one is written, and Python reads 4,300 at most


@dataclass(frozen=True, slots=True, eq=False)
class SavedLinkage:
    """A linkage of a result: its driver first, and its places for the poses.

    error: of the places at the poses.
    driver: which of the two dyads of the file is first here: the one that drives, or that would
    drive where the linkage is not usable.
    least_transmission: the least transmission angle between the poses, in radians.
    other_types: the other types that the uncertainty of the links leaves possible.
    quality: what a designer pays for; None where it has no places near the poses.
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
    quality: Quality | None = None

    @property
    def unit(self) -> str | None:
        """The unit of lengths."""
        return self.task.length_unit


class Result(NamedTuple):
    """A result: where it came from, its task, its linkages by rank, and its outcome.

    six_bars: the six-bars by rank, where these were looked for.
    """

    label: str
    task: Task
    linkages: tuple[SavedLinkage, ...]
    outcome: Outcome
    six_bars: tuple[SavedSixBar, ...] = ()

    def choose_six_bar(self, id: str | None = None) -> SavedSixBar | None:
        """A six-bar by its id, or the first one; None where this result is of four-bars.

        Raises E151 where it is of six-bars and has none of that id.
        """
        known = [each.id for each in self.six_bars]
        for each in self.six_bars:
            if id is None or each.id.lower() == id.lower():
                return each
        if not known:
            return None
        raise InputError(
            "E151",
            f"there is no six-bar {id} in this result",
            where=self.label,
            why=f"it has {', '.join(known)}",
            help=f"give --linkage {known[0]}",
        )

    def choose(self, id: str | None = None) -> SavedLinkage:
        """A linkage by its id, or the first; raises E151."""
        known = [each.id for each in self.linkages]
        if not known and self.six_bars:
            raise InputError(
                "E151",
                "this result has six-bars, and a four-bar is needed here",
                where=self.label,
                help="judge them by `burmester judge`, look at them by `burmester report "
                "--six-bars`, or hand them over by `burmester export`",
            )
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


def read_result(source: str | os.PathLike[str], data: bytes | None = None) -> Result:
    """The result in a file, or on standard input ("-"); data: its bytes, where they are known.

    Raises E101, E109, E150 and E152, and what reading the poses of its task raises.
    """
    path = os.fspath(source)
    label = "<stdin>" if path == "-" else printable(path)
    data = read_source(path) if data is None else data
    try:
        tree = json.loads(data, parse_int=_whole_number, parse_float=held_float)
    except InputError as error:
        error.where = label
        raise
    except (ValueError, RecursionError) as error:
        raise InputError(
            "E109", "this is not JSON", where=label, why=printable(str(error)), help=HELP
        ) from None
    try:
        if not isinstance(tree, dict) or tree.get("schema") != SCHEMA:
            message = f"this is no result of synthesize: its schema is not {SCHEMA}"
            raise InputError("E150", message, help=HELP)
        if tree.get("task") is None:
            message = "this result has no task: the poses could not be used"
            raise InputError("E150", message, help=HELP)
        if "poses" in tree:
            message = "$.poses stands beside the task of this result"
            raise InputError("E150", message, help=HELP)
        task = read_task("-", data=data)
        from burmester.io.saved_model import written_result

        written = written_result(tree, HELP)
        from burmester.io.agreement import judged_again

        judged = judged_again(written, task)
    except InputError as error:
        error.where = (error.where or label).replace("<stdin>", label)
        raise
    linkages = tuple(
        SavedLinkage(
            each.id,
            found.led,
            _ids(each, found.driver),
            found.usable,
            found.driver,
            found.led.type,
            task,
            found.error,
            found.driven.least_over_range,
            tuple((each.possible_types or ())[1:]),
            found.quality,
        )
        for each, found in zip(written.linkages, judged, strict=True)
    )
    said = written.outcome
    help, why = (text and printable(text) for text in (said.help, said.why))
    outcome = Outcome(said.code, printable(said.message), help, why)
    six_bars: tuple[SavedSixBar, ...] = ()
    if written.six_bars is not None:
        from burmester.io.saved_six_bars import saved_six_bars

        try:
            six_bars = saved_six_bars(written.six_bars, task, written.length_per_radian)
        except InputError as error:
            error.where = error.where or label
            raise
    return Result(label, task, linkages, outcome, six_bars)


def _ids(written: WrittenLinkage, driver: Side) -> tuple[str, str]:
    """The ids of its dyads, that of the driver first."""
    first, second = (each.id for each in written.dyads)
    return (first, second) if driver == "first" else (second, first)


def _whole_number(digits: str) -> int | float:
    """A whole number; one of more digits than any burmester writes is a float, or infinite."""
    return int(digits) if len(digits) <= MOST_DIGITS else float(digits)
