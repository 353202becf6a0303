"""Many tasks: one call that cuts them into parts, works on these anywhere, and can go on.

`burmester.batch.run` is `burmester batch` from Python.  Names are loaded when they are first
used: a worker process starts here, and says how many threads NumPy gets before it is loaded.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from burmester.batch.job import run as run
    from burmester.batch.manifest import Summary as Summary
    from burmester.batch.manifest import read_summary as read_summary
    from burmester.batch.sample import Sample as Sample

_ROOMS = {"Sample": "sample", "Summary": "manifest", "read_summary": "manifest", "run": "job"}

__all__ = ["Sample", "Summary", "read_summary", "run"]


def __getattr__(name: str) -> Any:
    from importlib import import_module  # noqa: PLC0415  it is seldom needed

    if name in _ROOMS:
        return getattr(import_module(f"burmester.batch.{_ROOMS[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
