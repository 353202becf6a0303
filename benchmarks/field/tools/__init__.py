"""The tools, a module each: TITLE, PACKAGE, CALLED, `refuses(task)` and `solve(task, seconds)`.

`refuses` says in words why a tool takes no such task, or nothing.  `solve` returns the linkages it
answers with, the one it puts first at the front; it may use `seconds` of processor time.  A tool's
package is imported in there only.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import Protocol, cast

from benchmarks.field.linkage import FourBar
from benchmarks.field.task import FieldTask

NAMES = (
    "burmester_synthesize",
    "pencil",
    "scipy_starts",
    "evolution",
    "fourbarhinge_fit",
    "pylinkage_motion",
)


class Tool(Protocol):
    """What a tool's module has."""

    TITLE: str
    PACKAGE: str
    CALLED: Sequence[str]  # sentences

    @staticmethod
    def refuses(task: FieldTask) -> str | None: ...

    @staticmethod
    def solve(task: FieldTask, seconds: float) -> Sequence[FourBar]: ...


def tool(name: str) -> Tool:
    if name not in NAMES:
        raise ValueError(f"there is no tool {name}; there are {', '.join(NAMES)}")
    return cast("Tool", import_module(f"benchmarks.field.tools.{name}"))
