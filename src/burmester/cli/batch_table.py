"""What is in the folder of a batch, on a terminal."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from rich import box
from rich.table import Table

from burmester.printable import printable
from burmester.wording import count

if TYPE_CHECKING:
    from rich.console import Console

    from burmester.batch.manifest import Summary

SHOWN = 10  # failed tasks


def show_summary(summary: Summary, console: Console) -> None:
    """The numbers of tasks and parts, each outcome, what failed, and what the rows depend on."""

    def say(text: str) -> None:
        console.print(text, markup=False, soft_wrap=True)  # so that a path stays in one piece

    state = "complete" if summary.complete else "not complete yet"
    parts = count(summary.parts, "part")
    say(f"{summary.folder}: {count(summary.tasks, 'task')} in {parts}, {state}.")
    for note in summary.notes:
        say(f"note: {note}")
    if summary.outcomes:
        table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
        table.add_column("outcome")
        table.add_column("tasks", justify="right")
        table.add_column("share", justify="right")
        for name, number in sorted(summary.outcomes.items(), key=lambda each: -each[1]):
            table.add_row(name, str(number), f"{number / summary.tasks:.1%}")
        console.print()
        console.print(table)
    if summary.failed:
        say("\nfailed:")
        for each in summary.failed[:SHOWN]:
            say(f"  task {printable(str(each['task']))}: {printable(each['reason'])}")
        if (rest := summary.outcomes.get("failed", 0) - SHOWN) > 0:
            say(f"  and {rest} more, told in the rows")
    say("\n" + _identity(summary.identity))


def _identity(identity: Any) -> str:
    """What the rows depend on, in a few words."""
    versions = identity["versions"]
    told = ", ".join(f"{name} {versions[name]}" for name in versions)
    options = json.dumps(identity["options"]) if identity["options"] else "none"
    return f"depth {identity['depth']}; options {printable(options)}; {told}"
