"""Options of a batch from a TOML file: how its tasks are solved, and what stands beside all poses.

Keys at the top are the options of `burmester.synthesize` by their Python names; the others are
those that a task file holds beside its poses, such as `limits` and `requirements`, and hold for
every task; a table [function] holds the settings of tasks of pairs of angles, and a table
[six_bars] asks for six-bars.

E107 a key that is not known      E108 a key that has no effect here
E197 six-bars by options that make no sense
E134 a value that makes no sense, and what readers of task files raise
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import Any, Final, Literal, TypeAlias, final

from burmester.errors import InputError
from burmester.io.reading.functions.function_file import settings_of
from burmester.io.reading.functions.function_options import NOTHING, Stated
from burmester.io.reading.pose_table import PoseTable, Source, held_float
from burmester.io.reading.poses import read_task
from burmester.io.reading.trees.documents import read_toml
from burmester.io.reading.trees.locations import Document, close_match
from burmester.io.reading.trees.node import Field, Node
from burmester.sixbar.six_bars import SixBarOptions
from burmester.tasks.motion_task import Task
from burmester.tasks.option_table import OPTIONS, TOP_KEYS
from burmester.tasks.options import SynthesisOptions
from burmester.wording import listed

Depth: TypeAlias = Literal["pencil", "dyads", "linkages", "full"]
DEPTHS: Final[tuple[Depth, ...]] = ("pencil", "dyads", "linkages", "full")

# The keys of a task file that may stand here, and those that every depth takes account of.
FUNCTION: Final = "function"
SIX_BARS: Final = "six_bars"
OF_SIX_BARS: Final = tuple(each.name for each in fields(SixBarOptions))
BESIDE: Final = tuple(key for key in TOP_KEYS if key != "poses")
AT_EVERY_DEPTH: Final = ("angle_unit", "length_unit", "pose_sigma")
OF_SYNTHESIS: Final = tuple(
    each.name for each in fields(SynthesisOptions) if each.name != "time_limit"
)
# What the command calls otherwise.
ALIASES: Final = {
    each.option[2:].replace("-", "_"): f"{each.name} = false" if each.negated else each.name
    for each in OPTIONS
    if each.name not in ("time_limit", "manufacturing_tolerance")
}
# Poses without which no task is read; nobody sees them.
_POSES: Final = "\n[[poses]]\nx = {}\ny = 0\nangle = {}\n"


@final
@dataclass(frozen=True, slots=True)
class BatchOptions:
    """Options as a file states them; label: what messages call it.

    Raises
    ------
    InputError
        E107, E108, E109, E134, and what readers of limits and requirements raise.
    """

    text: str = ""
    label: str = "the options"

    def __post_init__(self) -> None:
        document = self.document
        for key in self.data:
            if key not in (*BESIDE, *OF_SYNTHESIS, FUNCTION, SIX_BARS):
                raise _unknown(key, document)
            if key in OF_SYNTHESIS and SIX_BARS in self.data:
                raise InputError(
                    "E108",
                    f"{key} has no effect on six-bars",
                    where=document.where(key, key=True),
                    help=f"delete {key}, or the table [{SIX_BARS}]",
                )
        _ = self.synthesis, self.beside, self.functions, self.six_bars

    @property
    def document(self) -> Document:
        """The text, for the places of what stands in it."""
        return Document(Source(self.label, self.text), "TOML")

    @property
    def data(self) -> dict[str, Any]:
        """The keys and values; raises E109."""
        return _parsed(self.text, self.label)

    @property
    def synthesis(self) -> SynthesisOptions:
        """How each task is solved."""
        given = {key: value for key, value in self.data.items() if key in OF_SYNTHESIS}
        try:
            return SynthesisOptions(**given)
        except InputError as error:
            error.where = error.where or self.label
            raise

    @property
    def functions(self) -> Stated:
        """What holds for each task of pairs of angles; raises E107 and E191."""
        whole = Node(self.document, (), self.data)
        return settings_of(whole) if FUNCTION in self.data else NOTHING

    @property
    def six_bars(self) -> SixBarOptions | None:
        """How six-bars are looked for; None where four-bars are.  Raises E107 and E197."""
        given = self.data.get(SIX_BARS)
        if given is None:
            return None
        help = f"write a line [{SIX_BARS}], and {listed(OF_SIX_BARS, 'or')} below it"
        node = Node(self.document, (), self.data).at(SIX_BARS, help)
        if not isinstance(given, dict):
            raise node.fault("E107", "is no table", key=True)
        values = node.table(dict.fromkeys(OF_SIX_BARS, Field(lambda each: each.value)))
        return node.build(SixBarOptions, **values)

    @property
    def beside(self) -> PoseTable:
        """What stands beside all poses."""
        return _beside(self.text, self.label)

    def require_depth(self, depth: Depth) -> None:
        """Refuse what the depth takes no account of; raises E108."""
        if depth == "full":
            return
        for key in self.data:
            if key not in AT_EVERY_DEPTH:
                raise InputError(
                    "E108",
                    f"{key} has no effect at the depth {depth}",
                    where=self.label,
                    why=f"stacks of tasks take account of {listed(AT_EVERY_DEPTH)} only",
                    help=f"say --depth full, or delete {key}",
                )


@lru_cache(maxsize=4)
def _parsed(text: str, label: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text, parse_float=held_float)
    except InputError as error:
        error.where = label
        raise
    except tomllib.TOMLDecodeError as error:
        help = 'write lines such as prefer = "size"'
        message = "the options are no TOML"
        raise InputError("E109", message, where=label, why=str(error), help=help) from None


@lru_cache(maxsize=4)
def _beside(text: str, label: str) -> PoseTable:
    poses = "".join(_POSES.format(k, 10 * k) for k in range(5))
    return read_toml(Source(label, text + poses), (FUNCTION, SIX_BARS))


def _unknown(key: str, document: Document) -> InputError:
    """A key that is none of those known."""
    plain, known = key.replace("-", "_"), (*OF_SYNTHESIS, *BESIDE, FUNCTION, SIX_BARS)
    where = document.where(key, key=True)
    if key == "time_limit":
        message = "a batch has no time limit for its tasks"
        why = "rows are the same on every machine, and a limit by the clock would change them"
        help = "delete it; --part-limit ends what never does"
        return InputError("E107", message, where=where, why=why, help=help)
    if key == "poses":
        help = "delete them: the tasks have their own"
        return InputError("E107", "poses stand among the options", where=where, help=help)
    near = ALIASES.get(plain) or close_match(plain, known)
    help = f"write {near} in its place" if near else f"the keys are {listed(known, 'or')}"
    return InputError("E107", f"{key} is not known", where=where, help=help)


def as_task(options: BatchOptions, label: str, data: bytes) -> Task:
    """A text as a task with what the options say of all tasks; raises what `read_task` does."""
    beside, unit = options.beside, options.data.get("angle_unit")
    stated: dict[str, Any] = {
        name: getattr(beside, name) for name in ("specification", "tolerance", "pose_sigma")
    }
    try:
        task = read_task(label, data=data, **stated)
    except InputError as error:
        if error.code != "E110" or unit is None:
            raise
        task = read_task(label, data=data, angle_unit=unit, **stated)
    around = beside.surroundings.surroundings()
    return replace(
        task,
        body=beside.body if task.body is None else task.body,
        surroundings=around if task.surroundings is None else task.surroundings,
        length_unit=task.length_unit or beside.length_unit,
    )
